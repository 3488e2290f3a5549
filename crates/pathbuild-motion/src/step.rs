//! The canonical steps that a program consists of.

use crate::moves::Move;
use crate::position::{Axes, Plane};

/// One thing that the machine does, and the line that makes it.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub struct Step {
    /// From 1. Of a program that was never text, the number of the step.
    pub line: u32,
    pub action: Action,
    /// The axes whose position the program has stated since the last tool change, during which the machine may have moved the tool.
    pub stated: Axes,
}

impl Step {
    /// A move in a program without tool changes.
    pub fn of_move(line: u32, it: Move) -> Self {
        Self { line, action: Action::Move(it), stated: Axes::ALL }
    }

    /// The move, if it is one, with its line.
    pub fn as_move(&self) -> Option<(u32, Move)> {
        match self.action {
            Action::Move(it) => Some((self.line, it)),
            _ => None,
        }
    }
}

/// What the machine does.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// The tool moves, or would if it were not there already.
    Move(Move),
    /// It waits so many seconds.
    Dwell(f64),
    /// T: this tool is wanted next.
    SelectTool(u32),
    /// M6: this tool is put in, `None` where no T has named any; of XpertMILL, the moves go to this layer.
    ChangeTool(Option<u32>),
    /// The spindle from here on.
    Spindle(Spindle),
    /// The coolant from here on.
    Coolant(Coolant),
    /// The coordinate system from here on. Positions do not jump: they stay those of the program's first system.
    System(WorkSystem),
    /// A G or M word that is no motion, whatever it does.
    Word(StatedWord),
    /// Something else that may change where, how deep or how fast the tool goes from here on.
    Change(Change),
    /// A remark.
    Comment(Box<str>),
    /// M0, M60; M1 if optional: it waits for a person.
    Stop {
        /// A switch at the machine decides.
        optional: bool,
    },
    /// M2, M30.
    End,
}

/// A G or M word of a program that is no motion. What it does is in other steps, if anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StatedWord {
    /// `G` or `M`.
    pub letter: char,
    /// Ten times the number: `G38.2` is 382.
    pub code: u16,
    /// The modal group of a G word.
    pub group: Option<Group>,
    /// How far its effect is followed.
    pub effect: WordEffect,
}

/// How far the effect of a word is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordEffect {
    /// Other steps and positions take account of it.
    Followed,
    /// It chooses a coordinate system, which a control may not have.
    System,
    /// It goes to a place of the machine, or counts from its zero: where that is, is in no program.
    Place,
    /// Not at all.
    NotFollowed,
}

/// The spindle's state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Spindle {
    pub turning: Turning,
    /// Turns a minute, as set by S.
    pub speed: f64,
}

/// Whether the spindle turns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Turning {
    /// The program has not said.
    #[default]
    Unstated,
    /// M5.
    Off,
    /// M3.
    Clockwise,
    /// M4.
    Counterclockwise,
}

impl Turning {
    /// Whether it is known to turn.
    pub fn is_on(self) -> bool {
        matches!(self, Self::Clockwise | Self::Counterclockwise)
    }
}

/// The coolant's state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Coolant {
    /// M7.
    pub mist: bool,
    /// M8.
    pub flood: bool,
}

impl Coolant {
    /// M8.
    pub const FLOOD: Self = Self { mist: false, flood: true };
    /// M7.
    pub const MIST: Self = Self { mist: true, flood: false };
    /// M9.
    pub const OFF: Self = Self { mist: false, flood: false };

    /// Whether anything flows.
    pub fn is_on(self) -> bool {
        self.mist || self.flood
    }
}

/// What changes beside position, spindle, tool and coordinate system. Positions in steps take account of all of it but the tool's length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// G43, G43.1, G43.2, G44, G49.
    ToolLength(ToolLength),
    /// G10, G52, G92 and their kin: the coordinate systems move.
    Offsets {
        /// Ten times the number of the G code.
        code: u16,
        /// Whether G52 or G92 hold from here on; `None` where the command says nothing on that.
        are_shifted: Option<bool>,
    },
    /// G61, G64: how near the tool keeps to corners.
    Corners(Corners),
    /// An arc's plane other than XY.
    Plane(Plane),
    /// From here on rapid moves have this feed in mm/min, on controls that move as fast as F says; 0 before
    /// any F.
    RapidFeed(f64),
    /// `#5221=...`: a parameter is set.
    Parameter,
    /// An M code that no other step stands for, times ten.
    Switch(u16),
}

/// Which tool length is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolLength {
    /// None: G49.
    Off,
    /// G43 H: that of the table's entry; without H that of the tool in the spindle.
    OfTool(Option<u32>),
    /// Another: G43.1, G43.2, G44, or G43 beside X or Y alone.
    Other,
}

/// How near the tool keeps to corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Corners {
    /// G61: it stops there, or keeps to the path.
    Exact,
    /// G64: it rounds them, by so many mm at most where P says so. (Q, by how much lines may be joined, counts likewise.)
    Rounded(Option<f64>),
}

/// G54 (index 0) to G59 (5), G59.1 to G59.3 (8).
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

/// Groups of G words, of each of which one may stand in a line. (NIST RS274/NGC, table 4)
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
    /// G53 goes beside a motion.
    MachineCoordinates,
    /// G4, which takes no coordinates.
    Dwell,
}
