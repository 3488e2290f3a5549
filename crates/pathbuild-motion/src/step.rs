//! The steps of a program in canonical form, and the moves of the tool tip.

use std::borrow::Cow;
use std::fmt;

use pathbuild_diagnostic::Text;

use crate::geometry::{Arc, Axes, Course, Plane, Position};

/// An action of the machine, with the line that causes it.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub struct Step {
    /// Line number, counted from 1, or the step number for a program that does not exist as text.
    pub line: u32,
    /// Position in the order of execution: the line, or a number that counts on from there once a call, a loop or a branch has been executed.
    pub order: u32,
    pub action: Action,
    /// The axes for which the program has stated a position since the last tool change. The machine may have moved the other axes during the change.
    pub stated: Axes,
    /// The axes for which a move has stated a position since the last tool change or stop (the operator may have moved the axes during a stop); for
    /// Z, also since the last change of the tool length.
    pub stated_since_stop: Axes,
}

impl Step {
    /// Creates a move in a program without tool changes and stops.
    pub fn of_move(line: u32, movement: Move) -> Self {
        let action = Action::Move(movement);
        Self { line, order: line, action, stated: Axes::ALL, stated_since_stop: Axes::ALL }
    }

    /// Returns the line and the move, if the step is a move.
    pub fn as_move(&self) -> Option<(u32, Move)> {
        match self.action {
            Action::Move(movement) => Some((self.line, movement)),
            _ => None,
        }
    }
}

/// An action of the machine.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Moves the tool to a position, which may be the current one.
    Move(Move),
    /// O: states the number by which the control identifies the program.
    ProgramNumber(u32),
    /// G4: dwells for this time in seconds.
    Dwell(f64),
    /// T: selects the next tool.
    SelectTool(u32),
    /// M6: inserts this tool, `None` if no T has selected one. In programs for XpertMILL, tools are layers: the moves from here on belong to this
    /// layer.
    ChangeTool(Option<u32>),
    /// Changes the state of the spindle.
    Spindle(Spindle),
    /// Changes the state of the coolant.
    Coolant(Coolant),
    /// Selects a coordinate system. Positions remain in the program's first system.
    System {
        /// The system.
        system: WorkSystem,
        /// The frame of the following positions. Positions in different frames cannot be compared.
        frame: Frame,
    },
    /// A G or M word other than a motion, regardless of its effect.
    Word(StatedWord),
    /// Another change that may affect where, how deep or how fast the tool goes.
    Change(Change),
    /// The text of a comment, without comment marks.
    Comment(Box<str>),
    /// M0, M60, or M1 if optional: waits for the operator.
    Stop {
        /// Whether a switch on the machine decides if the program stops here (M1).
        optional: bool,
    },
    /// M2, M30: ends the program.
    End,
}

/// A G or M word other than a motion, or a call of a subroutine. `effect` tells whether other steps show what it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StatedWord {
    /// `G` or `M`; `O` for a call of a subroutine.
    pub letter: char,
    /// The number times ten: `G38.2` is 382.
    pub code: u16,
    /// Modal group of a G word.
    pub group: Option<Group>,
    /// Extent to which other steps show the word's effect.
    pub effect: WordEffect,
}

/// The extent to which the other steps of a program show the effect of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordEffect {
    /// Other steps and positions reflect the word.
    Followed,
    /// The word selects a coordinate system that the control may not have.
    System,
    /// The word moves to a machine position or refers to machine zero, neither of which a program states.
    Place,
    /// The word runs a subprogram of the file; the subprogram's steps come next.
    Call,
    /// The word's effect is not shown by other steps.
    NotFollowed,
}

/// State of the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Spindle {
    pub turning: Turning,
    /// Speed in 1/min, as set by S; `None` before any S.
    pub speed: Option<f64>,
}

impl Spindle {
    /// The state before the program sets it.
    pub const UNSTATED: Self = Self { turning: Turning::Unstated, speed: None };
}

/// The rotation of the spindle. The names of the variants go into the hash of the options that each program states, so renaming one makes existing
/// programs stale.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Turning {
    /// The program has not set the state.
    #[default]
    Unstated,
    /// The spindle stands still (M5).
    Off,
    /// The spindle turns clockwise (M3).
    Clockwise,
    /// The spindle turns counterclockwise (M4).
    CounterClockwise,
}

impl Turning {
    /// Whether the spindle is known to turn.
    pub fn is_on(self) -> bool {
        matches!(self, Self::Clockwise | Self::CounterClockwise)
    }
}

/// State of the coolant.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct Coolant {
    /// Whether mist is on (M7).
    pub mist: bool,
    /// Whether flood coolant is on (M8).
    pub flood: bool,
}

/// Formats the state for the hash of options in programs. Changing a name makes existing programs stale.
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
    /// Flood coolant alone (M8).
    pub const FLOOD: Self = Self { mist: false, flood: true };
    /// Mist alone (M7).
    pub const MIST: Self = Self { mist: true, flood: false };
    /// No coolant (M9).
    pub const OFF: Self = Self { mist: false, flood: false };

    /// Whether any coolant flows.
    pub fn is_on(self) -> bool {
        self.mist || self.flood
    }
}

/// A change of something other than position, spindle, coolant, tool and coordinate system. Positions in steps reflect all of these changes except
/// that of the tool length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// G43, G43.1, G43.2, G44, G49: sets the tool length.
    ToolLength(ToolLength),
    /// G10, G52, G92 and others: moves the origins of coordinate systems.
    Offsets {
        /// The number of the G code times ten.
        code: u16,
        /// Whether G52 or G92 is active from here on; `None` if the command does not change that.
        are_shifted: Option<bool>,
        /// Whether later positions have the same zero as earlier ones. They do not if the command sets the zero before the first move,
        /// or at a position that only the machine knows.
        is_followed: bool,
    },
    /// G61, G64: sets the behaviour at corners.
    Corners(Corners),
    /// G18, G19: selects a plane of arcs other than XY.
    Plane(Plane),
    /// Sets the feed of rapid moves in mm/min from here on, on controls where F determines it; 0 before any F.
    RapidFeed(f64),
    /// `#5221=...`: sets a parameter.
    Parameter,
    /// An M code that has no step of its own, given as its number times ten.
    Switch(u16),
}

/// The active tool length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolLength {
    /// No tool length applies (G49).
    Off,
    /// G43 H: the length in an entry of the tool table or, without H, the length of the tool in the spindle.
    OfTool(Option<u32>),
    /// Any other length, with the number of the G code times ten: G43.1, G43.2, G44, or G43 with only X or Y.
    Other(u16),
}

/// Behaviour at corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Corners {
    /// G61: the tool stops at corners, or keeps to the path.
    Exact,
    /// G64: the control rounds corners, by at most this many mm if P is given: P, or Q (the tolerance for joining lines) if Q is greater.
    Rounded(Option<f64>),
}

/// A coordinate system by its index: G54 (0) to G59 (5), G59.1 to G59.3 (8), and the additional systems that a control numbers by P (9 and up).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WorkSystem(u8);

impl WorkSystem {
    /// Returns the system with this number, from 1 (G54) to 9 (G59.3).
    pub fn from_number(number: u32) -> Option<Self> {
        u8::try_from(number).ok().filter(|number| (1..=9).contains(number)).map(|number| Self(number - 1))
    }

    /// Number of systems, including additional ones.
    pub const COUNT: usize = 256;

    /// Returns the additional system with this number, from 1 to 247.
    pub fn additional(number: u32) -> Option<Self> {
        u8::try_from(number.saturating_add(8)).ok().filter(|_| number > 0).map(Self)
    }

    /// Returns the number, from 1 (G54) to 9 (G59.3); greater for an additional system.
    pub fn number(self) -> u16 {
        u16::from(self.0) + 1
    }

    /// Returns the index, from 0 (G54) to 8 (G59.3); greater for an additional system.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// Returns the name of the system, such as `G54`, or `P1` for an additional one.
    pub fn name(self) -> Cow<'static, str> {
        const NAMES: [&str; 9] = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"];
        match NAMES.get(self.index()) {
            Some(name) => Cow::Borrowed(*name),
            None => Cow::Owned(format!("P{}", self.0 - 8)),
        }
    }
}

/// Coordinate systems whose places relative to each other are known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Frame {
    /// The first system of the program whose place relative to the selected one is known: usually the selected one itself, and the program's first
    /// one if G10 has stated both places.
    pub system: WorkSystem,
    /// Number of times that the operator has moved the zero in X or Y during the program.
    pub zero_moves: u32,
}

/// A group of G words. A line may contain only one word of each group. (NIST RS274/NGC, table 4)
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
    /// G words for scaling, mirroring, rotation and polar coordinates.
    Transform,
    /// G words for look-ahead and smoothing by the control.
    LookAhead,
    /// G53, which accompanies a motion.
    MachineCoordinates,
    /// G4, which does not use coordinates.
    Dwell,
}

// Moves of the tool tip.

/// A move of the tool tip.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub struct Move {
    pub from: Position,
    pub to: Position,
    pub shape: MoveShape,
    pub pace: Pace,
    /// The position that the program specifies by name as the target; `None` if it specifies none.
    pub named: Option<NamedPosition>,
}

/// The shape of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub enum MoveShape {
    Line,
    Arc(Arc),
}

/// Speed and purpose of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// A rapid move, at full speed.
    Rapid,
    /// A cutting move, with the feed in mm/min; 0 if the program does not specify it, which is reported.
    Feed(f64),
    /// A probing move: the tool moves until the probe makes contact, at most to the end of the move.
    Probe {
        /// Probing feed in mm/min.
        feed: f64,
        /// Whether the tool moves towards the material, and not away from it.
        toward: bool,
        /// Whether a missing contact is an alarm.
        must_answer: bool,
    },
}

impl Pace {
    /// Returns the feed in mm/min; `None` for a rapid move.
    pub fn feed(self) -> Option<f64> {
        match self {
            Self::Rapid => None,
            Self::Feed(feed) | Self::Probe { feed, .. } => Some(feed),
        }
    }

    /// Returns the feed in mm/min if the program specifies one.
    pub fn stated_feed(self) -> Option<f64> {
        self.feed().filter(|feed| *feed > 0.0)
    }

    /// Sets the feed in mm/min unless the program specifies one or the move is a rapid.
    pub fn set_missing_feed(&mut self, missing: f64) {
        match self {
            Self::Feed(feed) | Self::Probe { feed, .. } if *feed == 0.0 => *feed = missing,
            _ => {}
        }
    }

    /// Returns the name for moves of this kind in messages.
    pub fn word(self) -> &'static Text {
        match self {
            Self::Rapid => &Text { en: "a rapid move", de: "ein Eilgang" },
            Self::Feed(_) => &Text { en: "a cutting move", de: "eine Fräsbewegung" },
            Self::Probe { toward: true, must_answer: true, .. } => {
                &Text { en: "a probing move (G38.2)", de: "eine Antastbewegung (G38.2)" }
            }
            Self::Probe { toward: true, must_answer: false, .. } => {
                &Text { en: "a probing move (G38.3 or G31)", de: "eine Antastbewegung (G38.3 oder G31)" }
            }
            Self::Probe { toward: false, .. } => &Text {
                en: "a probing move away (G38.4 or G38.5)",
                de: "eine Antastbewegung von etwas weg (G38.4 oder G38.5)",
            },
        }
    }
}

/// A position that a program specifies by name, with the axes that move there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NamedPosition {
    /// G53: machine coordinates. If the machine's origin is unknown, the axes of the target that are not `known` hold machine coordinates.
    Machine(Axes),
    /// The first stored position (G28).
    Home1(Axes),
    /// The second stored position (G30).
    Home2(Axes),
}

impl NamedPosition {
    /// Returns the axes that move to the named position.
    pub fn axes(self) -> Axes {
        let (Self::Machine(axes) | Self::Home1(axes) | Self::Home2(axes)) = self;
        axes
    }
}

impl Move {
    /// Returns the length in space, in mm. Axes that are unknown at either end are ignored.
    pub fn length(&self) -> f64 {
        let known = self.from.known.and(self.to.known);
        let step =
            |axis: usize| if known.has(Axes::of(axis)) { self.to.at[axis] - self.from.at[axis] } else { 0.0 };
        match self.shape {
            MoveShape::Arc(arc) if known.has(arc.plane.axes_of_plane()) => {
                libm::hypot(Course::new(arc, &self.from, &self.to).length_in_plane(), step(arc.plane.third()))
            }
            _ => libm::hypot(libm::hypot(step(0), step(1)), step(2)),
        }
    }

    /// Whether all axes are known at both ends.
    pub fn is_known(&self) -> bool {
        self.from.known.and(self.to.known) == Axes::ALL
    }

    /// Whether the move takes the Z axis to a position that the program specifies by name, which is assumed to be above everything.
    pub fn homes_z(&self) -> bool {
        self.named.is_some_and(|named| named.axes().has(Axes::Z))
    }

    /// Whether the move goes somewhere at a cutting feed.
    pub fn is_cut(&self) -> bool {
        matches!(self.pace, Pace::Feed(_)) && !self.is_standstill()
    }

    /// Whether the move probes straight down.
    pub fn probes_down(&self) -> bool {
        matches!(self.pace, Pace::Probe { toward: true, .. })
            && self.keeps_xy()
            && self.to.z() < self.from.z()
    }

    /// Whether X and Y are the same at both ends.
    pub fn keeps_xy(&self) -> bool {
        self.from.at[..2] == self.to.at[..2]
    }

    /// Whether the move is vertical: its length in the plane XY is below 0.0005 mm, less than a program with three decimals can express.
    pub fn is_vertical(&self) -> bool {
        let in_plane = match self.shape {
            MoveShape::Arc(arc) if arc.plane == Plane::Xy => {
                Course::new(arc, &self.from, &self.to).length_in_plane()
            }
            MoveShape::Arc(_) => return false,
            MoveShape::Line => libm::hypot(self.to.x() - self.from.x(), self.to.y() - self.from.y()),
        };
        self.from.known.and(self.to.known).has(Axes::XY) && in_plane < 0.0005
    }

    /// Returns the bounding box, as least and greatest coordinates in mm. Unknown ends are ignored; an axis without known ends is `None`.
    pub fn extent(&self) -> [Option<(f64, f64)>; 3] {
        let mut extent = [0, 1, 2].map(|axis| {
            let known = |end: &Position| end.known.has(Axes::of(axis)).then(|| end.at[axis]);
            match (known(&self.from), known(&self.to)) {
                (Some(from), Some(to)) => Some((from.min(to), from.max(to))),
                (from, to) => from.or(to).map(|at| (at, at)),
            }
        });
        if let MoveShape::Arc(arc) = self.shape {
            arc.widen(&self.from, &self.to, &mut extent);
        }
        extent
    }

    /// Returns the lowest height of the tip in mm. An arc in G18 or G19 may dip below its ends; if its Z is unknown, the result is negative infinity.
    pub fn lowest(&self) -> f64 {
        match self.shape {
            MoveShape::Arc(arc) if arc.plane != Plane::Xy => {
                self.extent()[2].map_or(f64::NEG_INFINITY, |(low, _)| low)
            }
            _ => self.from.z().min(self.to.z()),
        }
    }

    /// Returns the maximum speed of each axis as a fraction of the speed of the move, from 0 to 1; for an arc, an upper bound.
    pub fn axis_speed_fractions(&self) -> [f64; 3] {
        let length = self.length();
        if length == 0.0 {
            return [0.0; 3];
        }
        let known = self.from.known.and(self.to.known);
        let mut shares = [0, 1, 2].map(|axis| {
            let way = if known.has(Axes::of(axis)) { self.to.at[axis] - self.from.at[axis] } else { 0.0 };
            libm::fabs(way) / length
        });
        if let MoveShape::Arc(arc) = self.shape {
            // An arc may be parallel to either axis of its plane at some point.
            let across = shares[arc.plane.third()];
            for axis in arc.plane.axes() {
                shares[axis] = libm::sqrt((1.0 - across * across).max(0.0));
            }
        }
        shares
    }

    /// Whether all numbers of the move are finite.
    pub fn is_finite(&self) -> bool {
        let centre = match self.shape {
            MoveShape::Line => [0.0; 2],
            MoveShape::Arc(arc) => arc.centre,
        };
        let places = self.from.at.into_iter().chain(self.to.at);
        places.chain(centre).chain(self.pace.feed()).all(f64::is_finite)
    }

    /// Whether the tool stays where it is.
    pub fn is_standstill(&self) -> bool {
        matches!(self.shape, MoveShape::Line) && self.from == self.to
    }

    /// Returns the course of the arc, if the move is one.
    pub fn course(&self) -> Option<Course> {
        match self.shape {
            MoveShape::Line => None,
            MoveShape::Arc(arc) => Some(Course::new(arc, &self.from, &self.to)),
        }
    }

    /// Returns the position at a fraction (0 to 1) of the move.
    pub fn point(&self, share: f64) -> [f64; 3] {
        let (from, to) = (&self.from.at, &self.to.at);
        match self.shape {
            _ if share >= 1.0 => *to,
            MoveShape::Line => std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis])),
            MoveShape::Arc(arc) => Course::new(arc, &self.from, &self.to).point(share),
        }
    }

    /// Splits the move into equal parts. The last one ends exactly at the end of the move.
    pub fn split(&self, count: u32) -> impl Iterator<Item = Self> + use<> {
        let (movement, course) = (*self, self.course());
        let mut from = movement.from;
        (1..=count).map(move |number| {
            let share = f64::from(number) / f64::from(count);
            let at = course
                .filter(|_| number < count)
                .map_or_else(|| movement.point(share), |movement| movement.point(share));
            let piece = Self { from, to: Position { at, ..movement.to }, ..movement };
            from = piece.to;
            piece
        })
    }

    /// Returns one of the pieces of [`split`](Self::split), by its number from 0.
    pub fn piece(&self, number: u32, count: u32) -> Self {
        let end = |number: u32| Position { at: self.point(f64::from(number) / f64::from(count)), ..self.to };
        Self { from: if number == 0 { self.from } else { end(number) }, to: end(number + 1), ..*self }
    }
}
