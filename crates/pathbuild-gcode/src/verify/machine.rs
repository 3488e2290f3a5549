//! Checks that a machine is capable of the moves and speeds of a program. (book: reference/configuration, `[machine]`)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Axes, Frame, Move, MoveShape, NamedPosition, Pace, Position, Step, Turning};

use crate::dialect::Dialect;
use crate::interpret::{Options, interpret_each};
use crate::read::Problems;

/// The limits of a machine. Unknown limits are not checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Machine {
    /// Travel of the machine's axes.
    pub travel: Option<Travel>,
    /// Maximum cutting feed, in mm/min.
    pub feed: Option<f64>,
    /// Maximum cutting feed of each axis, in mm/min.
    pub rates: [Option<f64>; 3],
    /// Minimum and maximum spindle speed, in 1/min.
    pub spindle: Option<(f64, f64)>,
}

/// Returns the moves and speeds of a native text that exceed the machine's capabilities, by line. Heights are those to which the tool moves.
pub fn text_beyond_machine(text: &[u8], machine: &Machine) -> Vec<Diagnostic> {
    let mut rules = MachineRules::new(machine);
    interpret_each(text, Dialect::Native, &Options::default(), &mut |step| rules.step(&step));
    rules.finish()
}

/// The travel of the axes, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Travel {
    /// Least and greatest coordinates of X, Y, Z in program coordinates, for parts clamped at a fixed position. Unlimited ends are
    /// infinite.
    Placed([(f64, f64); 3]),
    /// The length of travel in X, Y, Z, if the part may be clamped anywhere.
    Size([f64; 3]),
}

impl Travel {
    /// Returns the length of travel of an axis in mm.
    fn size(&self, axis: usize) -> f64 {
        match self {
            Self::Placed(limits) => limits[axis].1 - limits[axis].0,
            Self::Size(sizes) => sizes[axis],
        }
    }
}

/// Amount in mm by which rounding to three decimals may move a coordinate of a program. `emit` compares the exact coordinates, and `verify` those of
/// the text; both must come to the same result.
const ROUNDING: f64 = 0.0005 + 1e-9;

const AXES: [char; 3] = ['X', 'Y', 'Z'];

/// Rule that finds moves and speeds beyond the limits of a machine: pass every step of a program, then call [`finish`](Self::finish).
#[derive(Debug)]
pub struct MachineRules<'m> {
    machine: &'m Machine,
    reach: Reach,
    last_feed: Option<f64>,
    last_speed: Option<f64>,
    problems: Problems,
}

impl<'m> MachineRules<'m> {
    /// Creates the rule for the beginning of a program.
    pub fn new(machine: &'m Machine) -> Self {
        Self {
            machine,
            reach: Reach::default(),
            last_feed: None,
            last_speed: None,
            problems: Problems::default(),
        }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::System { frame, .. } => self.reach.enter(*frame),
            Action::Move(movement) => {
                if let Some(travel) = &self.machine.travel {
                    for found in self.reach.check(movement, travel) {
                        self.problems.add_at_line(found.message, step.line, |_| found);
                    }
                }
                self.check_feed(step.line, movement);
            }
            // The speed is checked with M3 as well, because S and M3 may be in different lines.
            Action::Spindle(spindle)
                if spindle.turning != Turning::Off
                    && std::mem::replace(&mut self.last_speed, spindle.speed) != spindle.speed =>
            {
                self.check_speed(step.line, spindle.speed.unwrap_or_default());
            }
            _ => {}
        }
    }

    /// Whether the program moves in coordinate systems whose positions relative to each other are not known, so nothing is known about the travel
    /// that they need together.
    pub fn has_several_frames(&self) -> bool {
        self.reach.frames.len() > 1
    }

    /// Whether the program moves an axis by a distance (G91) from a position that it has not stated, so only the length of such moves is known. A
    /// rapid move straight up does not count: it is the usual lift at the beginning of a program or after a move to a machine position.
    pub fn has_unknown_axis(&self) -> bool {
        self.reach.has_unknown_axis
    }

    /// Returns all problems, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        self.problems.into_diagnostics()
    }

    /// Reports a feed that exceeds the limit, or has a component that exceeds the limit of its axis. The feed reported last is not reported
    /// again until another one has been.
    fn check_feed(&mut self, line: u32, movement: &Move) {
        let Some(feed) = movement.pace.feed().filter(|feed| Some(*feed) != self.last_feed) else { return };
        if let Some(most) = self.machine.feed.filter(|most| feed > *most) {
            self.last_feed = Some(feed);
            return self
                .problems
                .add_at_line(&say::FEED_ABOVE_MOST, line, |d| d.with("feed", feed).with("most", most));
        }
        for (axis, share) in movement.axis_speed_fractions().into_iter().enumerate() {
            if let Some(most) = self.machine.rates[axis].filter(|most| feed * share > most * (1.0 + 1e-9)) {
                self.last_feed = Some(feed);
                return self.problems.add_at_line(&say::FEED_TOO_HIGH, line, |d| {
                    d.with("feed", feed).with("axis", AXES[axis]).with("most", most)
                });
            }
        }
    }

    fn check_speed(&mut self, line: u32, speed: f64) {
        let Some((least, most)) = self.machine.spindle else { return };
        if speed != 0.0 && !(least..=most).contains(&speed) {
            self.problems.add_at_line(&say::SPINDLE_SPEED, line, |d| {
                d.with("speed", speed).with("least", least).with("most", most)
            });
        }
    }
}

/// The extents of the moves so far, and the ends of axes that have been reported as exceeded.
#[derive(Debug, Default)]
struct Reach {
    current: Frame,
    /// Whether the next move begins in another frame.
    is_entering: bool,
    /// The extents in the frames with moves, in the order of use. Positions in different frames cannot be compared.
    frames: Vec<(Frame, Extent)>,
    /// The extent of positions in machine coordinates. It includes machine zero, because that is within the travel of every machine.
    machine: Extent,
    reported: [[bool; 2]; 3],
    /// The extent of moves by distances since the position of the axis became unknown. Only its size is known.
    relative: Extent,
    /// Whether such a move, apart from a lift, has changed the position of an axis.
    has_unknown_axis: bool,
}

/// Least and greatest coordinates of X, Y and Z, in mm.
type Extent = [Option<(f64, f64)>; 3];

fn widen(extent: &mut Option<(f64, f64)>, (low, high): (f64, f64)) -> (f64, f64) {
    let known = extent.get_or_insert((low, high));
    *known = (known.0.min(low), known.1.max(high));
    *known
}

impl Reach {
    fn enter(&mut self, frame: Frame) {
        let is_other = std::mem::replace(&mut self.current, frame) != frame;
        self.is_entering |= is_other;
        if is_other {
            self.relative = Extent::default();
        }
    }

    /// Takes a move into account and returns the findings about it, without places.
    fn check(&mut self, movement: &Move, travel: &Travel) -> Vec<Diagnostic> {
        let mut found = self.check_machine_position(movement, travel);
        found.extend(self.check_relative_move(movement, travel));
        let mut movement = *movement;
        if std::mem::take(&mut self.is_entering) && movement.shape == MoveShape::Line {
            movement.from.known = Axes::NONE;
        }
        let moved = movement.extent();
        if moved.iter().all(Option::is_none) {
            return found;
        }
        let index = self.frames.iter().position(|(frame, _)| *frame == self.current).unwrap_or_else(|| {
            self.frames.push((self.current, Extent::default()));
            self.frames.len() - 1
        });
        for (axis, range) in moved.into_iter().enumerate() {
            let Some(range) = range else { continue };
            let whole = widen(&mut self.frames[index].1[axis], range);
            match travel {
                // The limits are those of the system in which the program begins.
                Travel::Placed(limits) if index == 0 => {
                    found.extend(self.outside_findings(axis, range, limits[axis]));
                }
                Travel::Placed(_) => {}
                Travel::Size(sizes) => found.extend(self.size_finding(axis, whole, sizes[axis])),
            }
        }
        found
    }

    /// Checks a position in machine coordinates that is unknown in the program's coordinates.
    fn check_machine_position(&mut self, movement: &Move, travel: &Travel) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        let Some(NamedPosition::Machine(axes)) = movement.named else { return found };
        for axis in 0..3 {
            let is_machine = axes.has(Axes::of(axis)) && !movement.to.known.has(Axes::of(axis));
            if !is_machine {
                continue;
            }
            let at = movement.to.at[axis];
            let whole = widen(&mut self.machine[axis], (at.min(0.0), at.max(0.0)));
            found.extend(self.size_finding(axis, whole, travel.size(axis)));
        }
        found
    }

    /// Checks the length of moves by distances from an unknown position. Wherever they begin, they must fit into the travel.
    fn check_relative_move(&mut self, movement: &Move, travel: &Travel) -> Vec<Diagnostic> {
        let named = movement.named.map_or(Axes::NONE, NamedPosition::axes);
        let is_lift =
            movement.pace == Pace::Rapid && movement.keeps_xy() && movement.to.z() > movement.from.z();
        let known_ends = [movement.from, movement.to].map(|end| Position { known: Axes::ALL, ..end });
        let extent = Move { from: known_ends[0], to: known_ends[1], ..*movement }.extent();
        let mut found = Vec::new();
        for (axis, range) in extent.into_iter().enumerate() {
            let is_known = |end: &Position| end.known.has(Axes::of(axis));
            if named.has(Axes::of(axis)) || is_known(&movement.from) || is_known(&movement.to) {
                self.relative[axis] = None;
                continue;
            }
            let Some(range) = range.filter(|(low, high)| low < high) else { continue };
            self.has_unknown_axis |= !is_lift;
            let whole = widen(&mut self.relative[axis], range);
            found.extend(self.size_finding(axis, whole, travel.size(axis)));
        }
        found
    }

    /// Returns findings about the ends of a move that are outside the limits of an axis. Each end of an axis is reported once.
    fn outside_findings(
        &mut self,
        axis: usize,
        extent: (f64, f64),
        limits: (f64, f64),
    ) -> impl Iterator<Item = Diagnostic> {
        let ends = [(extent.0, extent.0 < limits.0 - ROUNDING), (extent.1, extent.1 > limits.1 + ROUNDING)];
        ends.into_iter().zip(&mut self.reported[axis]).filter_map(
            move |((value, is_outside), is_reported)| {
                let is_new = is_outside && !std::mem::replace(is_reported, true);
                let found =
                    || Diagnostic::new(&say::OUTSIDE_MACHINE).with("axis", AXES[axis]).with("value", value);
                is_new.then(|| found().with("least", limits.0).with("most", limits.1))
            },
        )
    }

    /// Returns a finding about an extent that is larger than the travel of an axis. Each axis is reported once.
    fn size_finding(&mut self, axis: usize, (low, high): (f64, f64), most: f64) -> Option<Diagnostic> {
        let size = high - low;
        let is_new = size > most + 2.0 * ROUNDING && !std::mem::replace(&mut self.reported[axis][0], true);
        let found = || Diagnostic::new(&say::LARGER_THAN_MACHINE).with("axis", AXES[axis]);
        is_new.then(|| found().with("size", size).with("most", most))
    }
}
