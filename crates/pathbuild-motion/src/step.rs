//! The canonical steps of a program.

use std::fmt;

use crate::moves::Move;
use crate::position::{Axes, Plane};

/// An action of the machine, with the line that causes it.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub struct Step {
    /// Line number, counted from 1, or the step number for a program that does not exist as text.
    pub line: u32,
    pub action: Action,
    /// The axes whose position has been specified since the last tool change, during which the machine may have moved the tool.
    pub stated: Axes,
}

impl Step {
    /// Creates a move in a program without tool changes.
    pub fn of_move(line: u32, movement: Move) -> Self {
        Self { line, action: Action::Move(movement), stated: Axes::ALL }
    }

    /// The move and its line, if the step is a move.
    pub fn as_move(&self) -> Option<(u32, Move)> {
        match self.action {
            Action::Move(movement) => Some((self.line, movement)),
            _ => None,
        }
    }
}

/// What the machine does.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// The tool moves, or would if it were not there already.
    Move(Move),
    /// O: the number by which the control knows the program.
    ProgramNumber(u32),
    /// A dwell, in seconds.
    Dwell(f64),
    /// T: selects the next tool.
    SelectTool(u32),
    /// M6: inserts this tool, `None` if no T has selected one. For XpertMILL, moves belong to this layer from here on.
    ChangeTool(Option<u32>),
    /// Changes the state of the spindle.
    Spindle(Spindle),
    /// Changes the state of the coolant.
    Coolant(Coolant),
    /// Selects a coordinate system. Positions remain in the program's first system.
    System(WorkSystem),
    /// A G or M word other than a motion, regardless of its effect.
    Word(StatedWord),
    /// Another change that may affect where, how deep or how fast the tool goes.
    Change(Change),
    /// A comment.
    Comment(Box<str>),
    /// M0, M60, or M1 if optional: waits for the operator.
    Stop {
        /// Whether a switch on the machine decides.
        optional: bool,
    },
    /// M2, M30.
    End,
}

/// A G or M word other than a motion. Its effects, if any, are in other steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StatedWord {
    /// `G` or `M`; `O` for a call of a subroutine.
    pub letter: char,
    /// The number times ten: `G38.2` is 382.
    pub code: u16,
    /// Modal group of a G word.
    pub group: Option<Group>,
    /// How far its effect is followed.
    pub effect: WordEffect,
}

/// How far the effect of a word is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordEffect {
    /// Other steps and positions reflect it.
    Followed,
    /// It selects a coordinate system, which the control may not have.
    System,
    /// It goes to a machine position or refers to machine zero, which no program contains.
    Place,
    /// It runs a subprogram of the file, whose steps come next.
    Call,
    /// It is not followed.
    NotFollowed,
}

/// State of the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Spindle {
    pub turning: Turning,
    /// Speed in 1/min, as set by S.
    pub speed: f64,
}

/// Whether the spindle turns, and in which direction. The names are part of the hash of options in programs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Turning {
    /// The program has not specified it.
    #[default]
    Unstated,
    /// M5.
    Off,
    /// M3.
    Clockwise,
    /// M4.
    CounterClockwise,
}

impl Turning {
    /// Whether it is known to turn.
    pub fn is_on(self) -> bool {
        matches!(self, Self::Clockwise | Self::CounterClockwise)
    }
}

/// State of the coolant.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct Coolant {
    /// M7.
    pub mist: bool,
    /// M8.
    pub flood: bool,
}

/// The names are part of the hash of options in programs: changing one makes existing programs stale.
impl fmt::Debug for Coolant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match (self.flood, self.mist) {
            (false, false) => "Off",
            (true, false) => "Flood",
            (false, true) => "Mist",
            (true, true) => "FloodAndMist",
        })
    }
}

impl Coolant {
    /// M8.
    pub const FLOOD: Self = Self { mist: false, flood: true };
    /// M7.
    pub const MIST: Self = Self { mist: true, flood: false };
    /// M9.
    pub const OFF: Self = Self { mist: false, flood: false };

    /// Whether any coolant flows.
    pub fn is_on(self) -> bool {
        self.mist || self.flood
    }
}

/// Changes besides position, spindle, tool and coordinate system. Positions in steps reflect all of them except the tool length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// G43, G43.1, G43.2, G44, G49.
    ToolLength(ToolLength),
    /// G10, G52, G92 and others: moves the coordinate systems.
    Offsets {
        /// The number of the G code times ten.
        code: u16,
        /// Whether G52 or G92 is active from here on; `None` if the command does not change that.
        are_shifted: Option<bool>,
    },
    /// G61, G64: behaviour at corners.
    Corners(Corners),
    /// A plane of arcs other than XY.
    Plane(Plane),
    /// The feed of rapid moves in mm/min from here on, on controls where it is given by F; 0 before any F.
    RapidFeed(f64),
    /// `#5221=...`: sets a parameter.
    Parameter,
    /// An M code without a step of its own, times ten.
    Switch(u16),
}

/// The active tool length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolLength {
    /// G49: none.
    Off,
    /// G43 H: that of an entry in the tool table, or without H that of the tool in the spindle.
    OfTool(Option<u32>),
    /// Others: G43.1, G43.2, G44, or G43 with only X or Y.
    Other,
}

/// Behaviour at corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Corners {
    /// G61: stops there, or keeps to the path.
    Exact,
    /// G64: rounds them, by at most this many mm if P is given. (Q, the tolerance for joining lines, counts in the same way.)
    Rounded(Option<f64>),
}

/// G54 (index 0) to G59 (5), and G59.1 to G59.3 (8).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WorkSystem(u8);

impl WorkSystem {
    /// The system with this number, from 1 (G54) to 9 (G59.3).
    pub fn from_number(number: u32) -> Option<Self> {
        u8::try_from(number).ok().filter(|number| (1..=9).contains(number)).map(|number| Self(number - 1))
    }

    /// From 0 (G54) to 8 (G59.3).
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// Such as `G54`.
    pub fn name(self) -> &'static str {
        ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"][self.index()]
    }
}

/// Groups of G words, of which only one may occur in a line. (NIST RS274/NGC, table 4)
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Group {
    NonModal,
    Motion,
    Plane,
    Distance,
    ArcDistance,
    FeedMode,
    Units,
    CutterCompensation,
    ToolLength,
    Retract,
    System,
    PathControl,
    SpindleMode,
    LatheMode,
    /// Scaling, mirroring, rotation, polar coordinates.
    Transform,
    /// G53, which accompanies a motion.
    MachineCoordinates,
    /// G4, which does not use coordinates.
    Dwell,
}
