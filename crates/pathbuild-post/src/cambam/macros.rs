//! The meaning of the macros in CamBam definitions.

use pathbuild_diagnostic::Text;

use super::registers::{Code, Form, Register};
use super::section::Section;

/// What a macro expands to.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Macro {
    /// The text of a section, regardless of the state.
    Section(Section),
    /// A number or name of the program, without a letter.
    Value(Value),
    /// A letter with its number.
    Register(Register, Form),
    /// `S` with the spindle speed.
    Speed,
    /// The direction of the spindle with its speed, and the time to get there, if either changes (extension of pathbuild).
    SpindleUp,
    /// The word of a motion or cycle; if `modal`, only when it is not active already.
    Code {
        code: Code,
        /// Whether the macro is of the form `{$_g1}`.
        modal: bool,
    },
    /// The section selected by the unit of the program or an option of the definition.
    Choice(Choice),
    /// The state required by the operation, if the machine is not in it.
    State(State),
    /// Entire lines.
    Block(Block),
    /// `{$check(x,y,z)}`: moves there unless the tool is there already.
    Check([Argument; 3]),
    /// `{$set(x,value)}`: sets a register without writing anything; `None` is `NaN`.
    Set(Register, Option<f64>),
    /// `{$set(tool)}`: assumes the tool of the operation without writing anything, although there is no M6 (extension of pathbuild).
    SetTool,
    /// A macro defined by the definition or the configuration.
    User(Box<str>),
}

/// A coordinate passed to `{$check}`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Argument {
    /// Any position will do.
    Any,
    /// The coordinate of the current move.
    Own,
    /// A coordinate in the unit of the program.
    Number(f64),
}

/// What selects one of two sections.
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

/// Macros that expand to lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Block {
    /// All operations, each through the MOP section.
    Mops,
    /// The moves of the current operation.
    Blocks,
    /// One line per tool.
    ToolTable,
    /// Changes to the tool of the operation, unless it is in the spindle.
    ToolChange,
    /// Changes to the tool of the first operation, unless it is in the spindle.
    FirstToolChange,
    /// Moves up to the clearance plane, unless the tool is there.
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
    /// Whether the value is a text from the drawing, the configuration or the command line, not a number.
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
    /// Whether drawings and programs do not provide the value, or not always, so that the definition or the configuration may.
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

impl Value {
    /// Description for the book.
    pub(super) fn word(self) -> Text {
        let word = |en, de| Text { en, de };
        match self {
            Self::FileName => word("the program's name", "der Name des Programms"),
            Self::ProgramNumber => word(
                "`program-number`, else the first number in the name",
                "`program-number`, sonst die erste Zahl im Namen",
            ),
            Self::Date => {
                word("`--date`, else left out with its line", "`--date`, sonst entfällt es mit seiner Zeile")
            }
            Self::OutFile => word("the file that is written", "die geschriebene Datei"),
            Self::PartName => word("the requested path", "der angeforderte Pfad"),
            Self::MopName => {
                word("the operation: the path that is embedded", "die Operation: der eingebettete Pfad")
            }
            Self::MopTag => {
                word("where the operation's path is drawn", "wo der Pfad der Operation gezeichnet ist")
            }
            Self::MopClearancePlane => {
                word("the height of rapid moves in the plane", "die Höhe der Eilgänge in der Ebene")
            }
            Self::MopRetractHeight => word(
                "the height at which a rapid move down ends",
                "die Höhe, in der der Eilgang abwärts endet",
            ),
            Self::MopPlungeFeedrate => {
                word("the plunge feed, if one is given", "der Vorschub beim Eintauchen, wenn einer vorliegt")
            }
            Self::MopCutFeedrate => word("the feed, if one is given", "der Vorschub, wenn einer vorliegt"),
            Self::MopDepthIncrement => word("I, else 0", "I, sonst 0"),
            Self::MopDwell => word(
                "seconds of the first hole that waits, else 0",
                "Sekunden der ersten Bohrung, die verweilt, sonst 0",
            ),
            Self::MopHoleDiameter => word("diameter of a hole: O", "Durchmesser einer Bohrung: O"),
            Self::MopPeckDistance => word(
                "depth of a plunge of the first hole with chip breaking, else 0",
                "Tiefe je Stich der ersten Bohrung mit Spanbruch, sonst 0",
            ),
            Self::MopStockSurface => word("T", "T"),
            Self::MopTargetDepth => {
                word("the lowest Z that is cut, else T", "das tiefste gefräste Z, sonst T")
            }
            Self::MopFirst(_) => word(
                "where the operation begins, if that is known",
                "wo die Operation beginnt, wenn das bekannt ist",
            ),
            Self::ToolIndex => word("the tool's number", "die Nummer des Werkzeugs"),
            Self::ToolDiameter => word("O", "O"),
            Self::ToolName => word("the tool's name", "der Name des Werkzeugs"),
            Self::ToolRadius => word("half of O", "die Hälfte von O"),
            Self::ToolLength => word("length in the tool table", "Länge in der Werkzeugtabelle"),
            Self::ToolProfile => word("profile in the tool table", "Form in der Werkzeugtabelle"),
            Self::ToolComment => word("comment in the tool table", "Kommentar in der Werkzeugtabelle"),
            Self::ToolVeeAngle => word("angle in the tool table", "Winkel in der Werkzeugtabelle"),
            Self::MoveAxis(_) => word("the number of the present move", "die Zahl der laufenden Bewegung"),
            Self::ArcOffset(_) => word(
                "from the start of the present arc to its centre",
                "vom Anfang des laufenden Bogens zum Mittelpunkt",
            ),
            Self::ArcRadius => word("radius of the present arc", "Radius des laufenden Bogens"),
            Self::ArcStart => {
                word("where the present arc starts, degrees", "Anfang des laufenden Bogens in Grad")
            }
            Self::ArcEnd => word("where the present arc ends, degrees", "Ende des laufenden Bogens in Grad"),
            Self::ArcSweep => word(
                "degrees, clockwise positive, of the present arc",
                "Grad, im Uhrzeigersinn positiv, des laufenden Bogens",
            ),
            Self::StockSize(_) => word(
                "size of the stock, if the program says it",
                "Maß des Rohteils, wenn das Programm es nennt",
            ),
            Self::StockCorner(_) => word(
                "corner of the stock, if the program says it",
                "Ecke des Rohteils, wenn das Programm sie nennt",
            ),
            Self::StockCornerReversed(_) => {
                word("the same with the other sign", "dasselbe mit umgekehrtem Vorzeichen")
            }
        }
    }
}

impl Block {
    /// Description for the book.
    pub(super) fn word(self) -> Text {
        let word = |en, de| Text { en, de };
        match self {
            Self::Mops => {
                word("each operation through the section `MOP`", "jede Operation durch den Abschnitt `MOP`")
            }
            Self::Blocks => word("the moves of the operation", "die Bewegungen der Operation"),
            Self::ToolTable => word("`ToolTableItem` for each tool", "`ToolTableItem` für jedes Werkzeug"),
            Self::ToolChange => word(
                "the section `ToolChange`, unless the tool is in",
                "den Abschnitt `ToolChange`, wenn das Werkzeug nicht steckt",
            ),
            Self::FirstToolChange => word(
                "the same for the first operation's tool",
                "dasselbe für das Werkzeug der ersten Operation",
            ),
            Self::Clearance => word(
                "a rapid move up to the clearance plane, unless the tool is there",
                "einen Eilgang zur Sicherheitsebene, wenn das Werkzeug nicht dort ist",
            ),
            Self::FileHeader => word(
                "custom text before the program; drawings have none",
                "eigener Text vor dem Programm; Zeichnungen haben keinen",
            ),
            Self::FileFooter => word(
                "custom text after the program; drawings have none",
                "eigener Text nach dem Programm; Zeichnungen haben keinen",
            ),
            Self::MopHeader => word(
                "custom text before the operation; drawings have none",
                "eigener Text vor der Operation; Zeichnungen haben keinen",
            ),
            Self::MopFooter => word(
                "custom text after the operation; drawings have none",
                "eigener Text nach der Operation; Zeichnungen haben keinen",
            ),
        }
    }
}

impl State {
    /// Description for the book.
    pub(super) fn word(self) -> Text {
        let word = |en, de| Text { en, de };
        match self {
            Self::Velocity => word(
                "the `VelocityMode...` that the operation needs, if it changes",
                "das `VelocityMode...`, das die Operation braucht, wenn es wechselt",
            ),
            Self::WorkPlane => word("`WorkPlane...`, where it changes", "`WorkPlane...`, wo sie wechselt"),
            Self::Spindle => word(
                "`SpindleCW`, `SpindleCCW` or `SpindleOff`, where it changes",
                "`SpindleCW`, `SpindleCCW` oder `SpindleOff`, wo sich etwas ändert",
            ),
            Self::Coolant => word(
                "`CoolantFlood`, `CoolantMist` or `CoolantOff`, where it changes",
                "`CoolantFlood`, `CoolantMist` oder `CoolantOff`, wo sich etwas ändert",
            ),
        }
    }
}

impl Choice {
    /// Description for the book.
    pub(super) fn word(self) -> Text {
        let word = |en, de| Text { en, de };
        match self {
            Self::Units => word(
                "`UnitsMM` or `UnitsInches`, by the program",
                "`UnitsMM` oder `UnitsInches`, nach dem Programm",
            ),
            Self::ArcCentre => word(
                "`ArcCenterAbsolute` or `ArcCenterIncremental`, by the element `ArcCenterMode`",
                "`ArcCenterAbsolute` oder `ArcCenterIncremental`, nach dem Element `ArcCenterMode`",
            ),
            Self::LatheX => word("`XModeRadius`", "`XModeRadius`"),
        }
    }
}

/// Values written without a letter.
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
