//! The canonical steps that a program consists of.

use pathbuild_diagnostic::Text;

use super::codes::{Group, Plane, WorkSystem};

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

/// A move of the tool's tip.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub struct Move {
    pub from: Position,
    pub to: Position,
    pub path: Path,
    pub pace: Pace,
    /// Where it goes, when the program says it by name.
    pub named: Option<Named>,
}

/// A place in the coordinates of the program's first coordinate system, in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Position {
    /// X, Y, Z.
    pub at: [f64; 3],
    /// The axes of which that is known: at the program's beginning, and behind a move to a named place or a probe, it is not.
    pub known: Axes,
}

impl Position {
    /// A place that is wholly known.
    pub fn known(x: f64, y: f64, z: f64) -> Self {
        Self { at: [x, y, z], known: Axes::ALL }
    }

    /// X in mm.
    pub fn x(&self) -> f64 {
        self.at[0]
    }

    /// Y in mm.
    pub fn y(&self) -> f64 {
        self.at[1]
    }

    /// Z in mm.
    pub fn z(&self) -> f64 {
        self.at[2]
    }
}

/// A set of the axes X, Y, Z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Axes(u8);

impl Axes {
    /// No axis.
    pub const NONE: Self = Self(0);
    /// X, Y and Z.
    pub const ALL: Self = Self(7);
    /// X and Y.
    pub const XY: Self = Self(3);
    /// Z.
    pub const Z: Self = Self(4);

    /// The axis with index 0 (X), 1 (Y) or 2 (Z).
    pub fn of(index: usize) -> Self {
        Self(1 << index)
    }

    /// Whether all of `other` are in it.
    pub fn has(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Both sets together.
    pub fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Those that are not in `other`.
    pub fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Those that are in both.
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Whether there is none.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

/// The way from one end of a move to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub enum Path {
    Line,
    Arc(Arc),
}

/// An arc in a plane; the third axis goes evenly from one end to the other (a helix).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Which plane.
    pub plane: Plane,
    /// The centre in mm, as the plane's first and second axis.
    pub centre: [f64; 2],
    /// Seen from the third axis' positive end.
    pub clockwise: bool,
    /// Whole turns beside the arc itself.
    pub extra_turns: u32,
}

/// How fast a move is, and what for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// As fast as the machine can.
    Rapid,
    /// Cutting, at so many mm/min. 0 where the program says none, which is reported.
    Feed(f64),
    /// Until the probe answers, at most to the end.
    Probe {
        /// mm/min.
        feed: f64,
        /// Towards the material; else away from it.
        toward: bool,
        /// No answer is an alarm.
        must_answer: bool,
    },
}

impl Pace {
    /// The feed in mm/min, unless it is a rapid move.
    pub fn feed(self) -> Option<f64> {
        match self {
            Self::Rapid => None,
            Self::Feed(feed) | Self::Probe { feed, .. } => Some(feed),
        }
    }

    /// What a move at this pace is called in messages.
    pub fn word(self) -> &'static Text {
        match self {
            Self::Rapid => &Text { en: "a rapid move", de: "eine Eilgangbewegung" },
            Self::Feed(_) => &Text { en: "a cutting move", de: "eine Fräsbewegung" },
            Self::Probe { .. } => &Text { en: "a probing move", de: "eine Messbewegung" },
        }
    }
}

/// Places that a program calls by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// G53: coordinates of the machine. Where its zero is not known, the numbers of the unknown axes are the machine's.
    Machine,
    /// G28.
    Home1,
    /// G30.
    Home2,
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

/// The coolant's state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Coolant {
    /// M7.
    pub mist: bool,
    /// M8.
    pub flood: bool,
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
