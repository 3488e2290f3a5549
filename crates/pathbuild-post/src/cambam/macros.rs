//! What the macros of CamBam definitions stand for.

use super::registers::{Code, Form, Register};
use super::section::Section;

/// What a macro stands for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Macro {
    /// The text of a section, whatever the state.
    Section(Section),
    /// A number or name of the program, without a letter.
    Value(Value),
    /// A letter with its number.
    Register(Register, Form),
    /// `S` with the spindle speed.
    Speed,
    /// The spindle's direction with its speed, and the time that it takes, when either changes (pathbuild's own).
    SpindleUp,
    /// The word of a motion or cycle; `modal`: only when it is not the one in force.
    Code {
        /// Which.
        code: Code,
        /// `{$_g1}`.
        modal: bool,
    },
    /// The section that the program's unit or an option of the definition chooses.
    Choice(Choice),
    /// The state that the operation wants, when the machine is not in it.
    State(State),
    /// Whole lines.
    Block(Block),
    /// `{$check(x,y,z)}`: goes there unless the tool is there.
    Check([Argument; 3]),
    /// `{$set(x,value)}`: writes nothing; `None` is `NaN`.
    Set(Register, Option<f64>),
    /// `{$set(tool)}`: writes nothing; the operation's tool is in, though no M6 says so (pathbuild's own).
    SetTool,
    /// A macro that the definition or the configuration defines.
    User(Box<str>),
}

/// A coordinate given to `{$check}`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Argument {
    /// Wherever it is.
    Any,
    /// That of the present move.
    Own,
    /// This, in the program's unit.
    Number(f64),
}

/// What decides between two sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    Units,
    ArcCentre,
    LatheX,
}

/// States of the machine that are written only when they change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Velocity,
    WorkPlane,
    Spindle,
    Coolant,
}

/// Macros that stand for lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Block {
    /// Every operation through the MOP section.
    Mops,
    /// The present operation's moves.
    Blocks,
    /// A line for each tool.
    ToolTable,
    /// The change to the operation's tool, unless it is in.
    ToolChange,
    /// The change to the first operation's tool, unless it is in.
    FirstToolChange,
    /// Up to the clearance plane, unless the tool is there.
    Clearance,
    /// Custom text before the program.
    FileHeader,
    /// Custom text after the program.
    FileFooter,
    /// Custom text before the operation.
    MopHeader,
    /// Custom text after the operation.
    MopFooter,
}

impl Value {
    /// Whether it is no number but a text of the drawing, the configuration or the command line.
    pub(super) fn is_text(self) -> bool {
        matches!(
            self,
            Self::FileName
                | Self::Date
                | Self::OutFile
                | Self::PartName
                | Self::MopName
                | Self::MopTag
                | Self::ToolName
                | Self::ToolProfile
                | Self::ToolComment
        )
    }
}

impl Value {
    /// Whether neither drawings nor programs say it, or only in part: the definition or the configuration may.
    pub(super) fn is_open(self) -> bool {
        matches!(
            self,
            Self::StockSize(_)
                | Self::StockCorner(_)
                | Self::StockCornerReversed(_)
                | Self::ToolLength
                | Self::ToolProfile
                | Self::ToolComment
                | Self::ToolVeeAngle
        )
    }
}

/// Values that are written bare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Value {
    FileName,
    ProgramNumber,
    Date,
    OutFile,
    PartName,
    MopName,
    MopTag,
    MopClearancePlane,
    MopRetractHeight,
    MopPlungeFeedrate,
    MopCutFeedrate,
    MopDepthIncrement,
    MopDwell,
    MopHoleDiameter,
    MopPeckDistance,
    MopStockSurface,
    MopTargetDepth,
    MopFirst(Register),
    ToolIndex,
    ToolDiameter,
    ToolName,
    ToolRadius,
    ToolLength,
    ToolProfile,
    ToolComment,
    ToolVeeAngle,
    MoveAxis(Register),
    ArcOffset(Register),
    ArcRadius,
    ArcStart,
    ArcEnd,
    ArcSweep,
    StockSize(usize),
    StockCorner(usize),
    StockCornerReversed(usize),
}
