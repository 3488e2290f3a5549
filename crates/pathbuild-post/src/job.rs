//! The input of a post-processor: operations in order, each with its tool, spindle, feeds, heights and moves.
//!
//! Lengths are in millimetres and feeds in mm/min. A post converts them if [`Job::units`] or its definition requires inches.
//! (book: program/posts)

use std::collections::HashSet;

use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_gcode::interpret::PECK_CLEARANCE;
use pathbuild_motion::{Coolant, Move, MoveShape, Pace, Plane, Position, Turning};

use crate::arcs;

/// A program to be written by a post.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Job {
    /// Name of the program, for the macros `{$cbfile.name}` and `~PrgName~`.
    pub name: Box<str>,
    /// Name of the drawing's file, without directory; empty if the job comes from a parsed program.
    pub drawing: Box<str>,
    /// Unit of the output.
    pub units: Units,
    /// The operations in order. A job without operations cannot be written.
    pub operations: Vec<Operation>,
    /// Comments to be written at the beginning of the text.
    pub remarks: Vec<Box<str>>,
    /// Whether the upper face of the material is unknown and assumed to be at Z 0.
    pub has_no_surface: bool,
}

/// Returns the program number to use if none is configured: the first number in the program's name, such as 8001 in 8001.1P.
/// No program has the number 0.
pub fn program_number(name: &str) -> Option<u32> {
    let first = name.split(|c: char| !c.is_ascii_digit()).find_map(|digits| digits.parse().ok());
    first.filter(|number| *number > 0)
}

impl Job {
    /// Returns the program number: the first number in the job's name, or else in the name of its first part.
    pub(super) fn number(&self) -> Option<u32> {
        program_number(&self.name).or_else(|| program_number(&self.operations.first()?.part))
    }

    /// Checks that the job can be written: it has operations, all its numbers are finite, and no operation begins to cut within the material right
    /// after a tool change, or after a stop or dwell with the spindle off.
    pub(super) fn check(&self) -> Result<(), Box<Diagnostic>> {
        if self.operations.is_empty() {
            return Err(Box::new(Diagnostic::new(&posts::JOB_EMPTY)));
        }
        if let Some(broken) = self.operations.iter().find(|operation| !operation.is_finite()) {
            return Err(Box::new(
                Diagnostic::new(&posts::JOB_NOT_FINITE).quoting("operation", &*broken.name),
            ));
        }
        self.check_changes()
    }

    /// Checks that no operation with a newly inserted tool, the first one included, or with a spindle that must be started again, has to begin its
    /// cuts within the material.
    fn check_changes(&self) -> Result<(), Box<Diagnostic>> {
        let mut before: Option<&Operation> = None;
        for operation in &self.operations {
            let is_new = before.is_none_or(|before| before.tool.index != operation.tool.index);
            let is_stopped =
                before.is_some_and(Operation::switches_spindle_off) && operation.begins_with_cut();
            before = Some(operation);
            match operation.entry {
                Entry::At([.., z])
                    if (is_new || is_stopped)
                        && z < operation.surface.min(operation.clearance)
                        && operation.cuts() =>
                {
                    let message = if is_new { &posts::CUT_AFTER_CHANGE } else { &posts::CUT_AFTER_STOP };
                    let diagnostic = Diagnostic::new(message).quoting("operation", &*operation.name);
                    let diagnostic = diagnostic.with("z", z).with("surface", operation.surface);
                    return Err(Box::new(diagnostic.with("index", u64::from(operation.tool.index))));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Returns the feeds of each operation. A missing feed is replaced by the other feed of the operation, or else by the first feed that its steps
    /// state, or else by the first one in the job.
    pub(super) fn feeds(&self) -> Vec<Feeds> {
        let own = |operation: &Operation| operation.steps.iter().find_map(JobStep::stated_feed);
        let any = self.operations.iter().find_map(own);
        let feeds = |operation: &Operation| {
            let (plunge, cut) = (operation.plunge_feed, operation.cut_feed);
            let other = || own(operation).or(any);
            Feeds { plunge: plunge.or(cut).or_else(other), cut: cut.or(plunge).or_else(other) }
        };
        self.operations.iter().map(feeds).collect()
    }

    /// Returns, for each step of the job in order, the operation that it belongs to.
    pub(super) fn operations_by_step(&self) -> Vec<&Operation> {
        self.operations.iter().flat_map(|operation| operation.steps.iter().map(move |_| operation)).collect()
    }

    /// Returns the height in mm of the lowest upper face of the material; `None` if it is unknown.
    pub(super) fn lowest_surface(&self) -> Option<f64> {
        let surfaces = self.operations.iter().map(|operation| operation.surface);
        surfaces.reduce(f64::min).filter(|_| !self.has_no_surface)
    }

    /// Whether the program must switch the spindle on for an operation.
    pub(super) fn starts_spindle(&self) -> bool {
        self.operations.iter().any(|operation| operation.spindle.is_some_and(Turning::is_on))
    }

    /// Sets a feed in mm/min for cuts without one. Programs for XpertMILL's layers, for example, contain no feeds.
    pub fn set_missing_feeds(&mut self, feed: f64) {
        for operation in &mut self.operations {
            for step in &mut operation.steps {
                match step {
                    JobStep::Move(movement) => movement.pace.set_missing_feed(feed),
                    JobStep::Hole(hole) => _ = hole.feed.get_or_insert(feed),
                    JobStep::Dwell { .. }
                    | JobStep::Stop
                    | JobStep::SpindleOff { .. }
                    | JobStep::Comment(_) => {}
                }
            }
        }
    }

    /// Makes the centres of arcs equidistant from both ends where the rounding of a program in inches has displaced them. Such programs are rounded
    /// to multiples of 0.0025 mm, which exceeds the tolerance for arcs in millimetres.
    pub fn centre_arcs(&mut self) {
        for step in self.operations.iter_mut().flat_map(|operation| &mut operation.steps) {
            if let JobStep::Move(movement) = step {
                arcs::equalize_radii(movement);
            }
        }
    }

    /// Returns the distinct tools, in order of first use.
    pub fn tools(&self) -> Vec<&Tool> {
        let mut seen = HashSet::new();
        let tools = self.operations.iter().map(|operation| &operation.tool);
        tools.filter(|tool| seen.insert(tool.index)).collect()
    }
}

/// The feeds of an operation, in mm/min.
#[derive(Clone, Copy, Debug)]
pub(super) struct Feeds {
    /// Feed downwards; `None` if the job specifies none.
    pub(super) plunge: Option<f64>,
    /// Feed in the plane; `None` if the job specifies none.
    pub(super) cut: Option<f64>,
}

/// Unit of lengths in a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Units {
    #[default]
    Millimetres,
    Inches,
}

impl Units {
    /// The length of the unit in mm.
    pub(super) fn millimetres(self) -> f64 {
        match self {
            Self::Millimetres => 1.0,
            Self::Inches => 25.4,
        }
    }
}

/// The moves of one embedded path, or of a part of it, during which no setting changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Operation {
    /// Name of the embedded path.
    pub name: Box<str>,
    /// Name of the emitted path, which contains the embedded one.
    pub part: Box<str>,
    /// The cutter used for all moves.
    pub tool: Tool,
    /// State of the spindle; `None` if it is unspecified.
    pub spindle: Option<Turning>,
    /// Spindle speed in 1/min, if it is known.
    pub speed: Option<f64>,
    /// State of the coolant; `None` if it is unspecified.
    pub coolant: Option<Coolant>,
    /// Feed in the plane in mm/min, if the operation has one.
    pub cut_feed: Option<f64>,
    /// Feed downwards in mm/min, if the operation has one.
    pub plunge_feed: Option<f64>,
    /// Clearance plane: height (S) in mm at which the tool is above everything.
    pub clearance: f64,
    /// Height in mm down to which the tool moves by rapid (R of a drilling cycle).
    pub retract: f64,
    /// Upper face (T) of the material in mm.
    pub surface: f64,
    /// Height in mm of the deepest point; `None` if the operation does not cut.
    pub target_depth: Option<f64>,
    /// Largest infeed in mm, if there is one.
    pub depth_increment: Option<f64>,
    /// Plane of the arcs.
    pub plane: Plane,
    /// Behaviour of the machine at corners.
    pub velocity: VelocityMode,
    /// Position that the tool must reach before the first step.
    pub entry: Entry,
    /// The moves and other actions, in order.
    pub steps: Vec<JobStep>,
}

impl Operation {
    /// Creates an operation without moves. All other settings are unspecified or zero.
    pub fn new(name: &str, tool: Tool) -> Self {
        Self { name: name.into(), part: name.into(), tool, ..Self::default() }
    }

    fn switches_spindle_off(&self) -> bool {
        self.steps.iter().any(|step| matches!(step, JobStep::SpindleOff { .. }))
    }

    fn begins_with_cut(&self) -> bool {
        let is_cut = |step: &JobStep| match step {
            JobStep::Move(movement) => Some(movement.pace != Pace::Rapid),
            JobStep::Hole(_) => Some(true),
            _ => None,
        };
        self.steps.iter().find_map(is_cut) == Some(true)
    }

    /// Returns the first position reached by the moves. Each coordinate comes from the first move that specifies it, or else from the
    /// entry.
    pub fn first_point(&self) -> Position {
        let target = |step: &JobStep| match step {
            JobStep::Move(movement) => Some(movement.to.axes()),
            JobStep::Hole(hole) => Some([hole.at[0], hole.at[1], hole.level].map(Some)),
            JobStep::Dwell { .. } | JobStep::Stop | JobStep::SpindleOff { .. } | JobStep::Comment(_) => None,
        };
        let places = self.steps.iter().filter_map(target);
        let begin = match self.entry {
            Entry::At(at) => at.map(Some),
            Entry::Clearance => [None, None, Some(self.clearance)],
        };
        places
            .chain([begin])
            .fold([None; 3], |first, next| [0, 1, 2].map(|axis| first[axis].or(next[axis])))
            .into()
    }

    fn is_finite(&self) -> bool {
        let heights = [self.clearance, self.retract, self.surface, self.tool.diameter];
        let known = [self.speed, self.cut_feed, self.plunge_feed, self.target_depth, self.depth_increment];
        heights.iter().chain(known.iter().flatten()).all(|number| number.is_finite())
            && self.steps.iter().all(JobStep::is_finite)
    }

    /// Whether the operation cuts anything.
    pub fn cuts(&self) -> bool {
        self.steps.iter().any(|step| matches!(step, JobStep::Hole(_)) || step.as_cut().is_some())
    }

    /// Whether the operation probes and cuts nothing. The tool touches the material, so the spindle must not turn.
    pub fn only_probes(&self) -> bool {
        !self.cuts()
            && self
                .steps
                .iter()
                .any(|step| matches!(step, JobStep::Move(Move { pace: Pace::Probe { .. }, .. })))
    }

    /// The holes of the operation.
    pub fn holes(&self) -> impl Iterator<Item = &Hole> {
        self.steps.iter().filter_map(|step| match step {
            JobStep::Hole(hole) => Some(hole),
            _ => None,
        })
    }
}

/// A cutter. Tools with the same index are the same tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tool {
    /// Number in T words.
    pub index: u32,
    /// Whether the program names the tool. Otherwise it has no number, and CamBam definitions write no tool change.
    pub is_named: bool,
    /// Cutter diameter (O) in mm.
    pub diameter: f64,
    /// Name in the tool table.
    pub name: Box<str>,
    /// Whether the tool table has no tool for the path, but tools of this diameter for other paths.
    pub is_for_other_paths: bool,
}

impl Tool {
    /// Creates a tool that the program names.
    pub fn new(index: u32, diameter: f64, name: &str) -> Self {
        Self { index, is_named: true, diameter, name: name.into(), is_for_other_paths: false }
    }

    /// Returns the tool of a program that does not name any.
    pub fn unnamed() -> Self {
        Self { is_named: false, ..Self::new(0, 0.0, "") }
    }
}

/// Behaviour of the machine at corners: it stops at them, or rounds them to keep its speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum VelocityMode {
    ExactStop,
    #[default]
    ConstantVelocity,
}

/// Position at which an operation begins.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Entry {
    /// At the clearance plane, at any X and Y.
    #[default]
    Clearance,
    /// Exactly at this position in mm, which may be deep in the material (sweepless milling). The tool is already there, unless it was
    /// changed.
    At([f64; 3]),
}

/// Derives the feeds and depths of an operation from its steps, and its retract height from its surface. An unspecified surface is set to
/// `thickness`.
pub(super) fn derive_feeds_and_depths(operation: &mut Operation, thickness: f64) {
    if operation.surface == f64::NEG_INFINITY {
        operation.surface = thickness;
    }
    operation.retract = operation.surface;
    let depth_of = |step: &JobStep| match step {
        JobStep::Hole(hole) => Some(hole.bottom),
        _ => step.as_cut().and_then(|movement| movement.to.axes()[2]),
    };
    let feed_where = |is_meant: &dyn Fn(&JobStep, &JobStep) -> bool| {
        operation
            .steps
            .windows(2)
            .find(|pair| is_meant(&pair[0], &pair[1]))
            .and_then(|pair| pair[1].stated_feed())
    };
    let plunge_feed = feed_where(&is_straight_down).or(operation.holes().find_map(|hole| hole.feed));
    let cut_feed = feed_where(&|before, step| step.as_cut().is_some() && !is_straight_down(before, step));
    operation.plunge_feed = plunge_feed;
    operation.cut_feed = cut_feed;
    operation.target_depth = operation.steps.iter().filter_map(depth_of).reduce(f64::min);
    let mut depths: Vec<f64> = operation.steps.iter().filter_map(depth_of).collect();
    depths.push(operation.surface);
    depths.sort_by(|a, b| b.total_cmp(a));
    let infeeds = depths.windows(2).map(|pair| pair[0] - pair[1]);
    operation.depth_increment = infeeds.filter(|infeed| *infeed > 0.0).reduce(f64::max);
}

/// Whether a step descends at feed, without moving in X and Y from the end of the previous step.
fn is_straight_down(before: &JobStep, step: &JobStep) -> bool {
    let end_of = |step: &JobStep| match step {
        JobStep::Move(movement) if !matches!(movement.pace, Pace::Probe { .. }) => movement.to.axes(),
        _ => [None; 3],
    };
    let (from, to) = (end_of(before), end_of(step));
    let is_line = step.as_cut().is_some_and(|movement| movement.shape == MoveShape::Line);
    is_line && from[..2] == to[..2] && to[2] < from[2]
}

/// An action of the machine. Lengths are in mm, feeds in mm/min.
#[derive(Clone, Debug, PartialEq)]
pub enum JobStep {
    /// A move of the tool. A straight move begins where the previous step ended; its `from` is ignored.
    Move(Move),
    /// A hole, regardless of how it is drilled.
    Hole(Hole),
    /// A pause of the machine.
    Dwell {
        /// Duration in seconds.
        seconds: f64,
    },
    /// A stop that waits for the operator.
    Stop,
    /// Switches the spindle off for a stop or a dwell, if it is on. The next operation switches it on again.
    SpindleOff {
        /// Whether the coolant goes off too.
        coolant: bool,
    },
    /// A comment for the operator.
    Comment(Box<str>),
}

/// A drilled hole. The tool moves to its position, down, and up again to `exit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// X and Y in mm.
    pub at: [f64; 2],
    /// Height in mm from which the tool descends, and at which it moves between holes.
    pub level: f64,
    /// Height down to which the tool moves by rapid, in mm.
    pub retract: f64,
    /// Z of the bottom, in mm.
    pub bottom: f64,
    /// Height to which the tool is retracted afterwards, in mm.
    pub exit: f64,
    /// Feed downwards in mm/min, if it is known.
    pub feed: Option<f64>,
    /// Method of drilling.
    pub kind: HoleKind,
}

/// The methods of drilling a hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HoleKind {
    /// The hole is drilled in one go.
    Plain,
    /// The hole is drilled in one go, with a dwell at the bottom.
    Dwell {
        /// Duration in seconds.
        seconds: f64,
    },
    /// The hole is drilled in several pecks. After each, the tool is retracted out of the hole.
    Peck {
        /// Depth of a peck in mm, greater than 0.
        depth: f64,
    },
}

impl JobStep {
    /// Creates a rapid straight move.
    pub fn rapid(to: impl Into<Position>) -> Self {
        Self::straight(to, Pace::Rapid)
    }

    /// Creates a straight cut. `feed` is in mm/min; `None` if the parsed program does not specify it.
    pub fn feed(to: impl Into<Position>, feed: Option<f64>) -> Self {
        Self::straight(to, Pace::Feed(feed.unwrap_or_default()))
    }

    /// Creates a straight move that ends when the probe makes contact. `feed` is in mm/min.
    pub fn probe(to: impl Into<Position>, feed: Option<f64>) -> Self {
        Self::straight(to, Pace::Probe { feed: feed.unwrap_or_default(), toward: true, must_answer: true })
    }

    fn straight(to: impl Into<Position>, pace: Pace) -> Self {
        let from = Position::default();
        Self::Move(Move { from, to: to.into(), shape: MoveShape::Line, pace, named: None })
    }

    fn as_cut(&self) -> Option<&Move> {
        match self {
            Self::Move(movement) if matches!(movement.pace, Pace::Feed(_)) => Some(movement),
            _ => None,
        }
    }

    /// Returns the feed in mm/min, if the step specifies one.
    pub(super) fn stated_feed(&self) -> Option<f64> {
        match self {
            Self::Move(movement) => movement.pace.stated_feed(),
            Self::Hole(hole) => hole.feed,
            Self::Dwell { .. } | Self::Stop | Self::SpindleOff { .. } | Self::Comment(_) => None,
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        match self {
            Self::Move(movement) => movement.is_finite(),
            Self::Hole(hole) => hole.is_finite(),
            Self::Dwell { seconds } => seconds.is_finite(),
            Self::Stop | Self::SpindleOff { .. } | Self::Comment(_) => true,
        }
    }
}

impl Hole {
    fn is_finite(&self) -> bool {
        let kind = match self.kind {
            HoleKind::Plain => 0.0,
            HoleKind::Dwell { seconds: number } | HoleKind::Peck { depth: number } => number,
        };
        let numbers = [self.at[0], self.at[1], self.level, self.retract, self.bottom, self.exit, kind];
        numbers.into_iter().chain(self.feed).all(f64::is_finite)
    }
}

/// Maximum number of pecks per hole. More are taken for an error.
const MAX_PECKS: usize = 1_000;

impl Hole {
    /// Returns the moves that drill the hole: to its position at the start level, down, and up to its exit level.
    pub(crate) fn moves(&self) -> Result<Vec<JobStep>, Box<Diagnostic>> {
        let [x, y] = self.at;
        let to = |z| [x, y, z];
        let mut steps = vec![JobStep::rapid(to(self.level))];
        if self.retract < self.level {
            steps.push(JobStep::rapid(to(self.retract)));
        }
        let depths = self.depths()?;
        for (index, &depth) in depths.iter().enumerate() {
            if index > 0 {
                let reached = depths[index - 1];
                steps.push(JobStep::rapid(to(self.retract)));
                steps.push(JobStep::rapid(to((reached + PECK_CLEARANCE).min(self.retract))));
            }
            steps.push(JobStep::feed(to(depth), self.feed));
        }
        if let HoleKind::Dwell { seconds } = self.kind {
            steps.push(JobStep::Dwell { seconds });
        }
        steps.push(JobStep::rapid(to(self.exit)));
        Ok(steps)
    }

    /// Returns the depths reached by successive pecks, as Z in mm. The last one is the bottom.
    fn depths(&self) -> Result<Vec<f64>, Box<Diagnostic>> {
        let HoleKind::Peck { depth } = self.kind else { return Ok(vec![self.bottom]) };
        let mut depths = Vec::new();
        let mut z = self.retract - depth;
        while z > self.bottom {
            if depths.len() == MAX_PECKS {
                let place = Point::new(self.at[0], self.at[1]);
                let diagnostic =
                    Diagnostic::new(&posts::TOO_MANY_PECKS).with("limit", MAX_PECKS).with("place", place);
                return Err(Box::new(diagnostic));
            }
            depths.push(z);
            z -= depth;
        }
        depths.push(self.bottom);
        Ok(depths)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heights(kind: HoleKind) -> Vec<f64> {
        heights_from(20.0, kind)
    }

    fn heights_from(level: f64, kind: HoleKind) -> Vec<f64> {
        let hole =
            Hole { at: [1.0, 2.0], level, retract: 10.0, bottom: 4.0, exit: 20.0, feed: Some(60.0), kind };
        let z = |step: &JobStep| match step {
            JobStep::Move(movement) => Some(movement.to.z()),
            _ => None,
        };
        hole.moves().unwrap().iter().filter_map(z).collect()
    }

    #[test]
    fn a_plain_hole_is_drilled_in_one_go() {
        assert_eq!(heights(HoleKind::Plain), [20.0, 10.0, 4.0, 20.0]);
        assert_eq!(heights_from(10.0, HoleKind::Plain), [10.0, 4.0, 20.0], "it is there already");
    }

    #[test]
    fn pecks_leave_the_hole_and_come_back_just_above_where_they_were() {
        let expected = [20.0, 10.0, 7.0, 10.0, 7.254, 4.0, 20.0];
        assert_eq!(heights(HoleKind::Peck { depth: 3.0 }), expected, "exactly two goes");
        assert_eq!(heights(HoleKind::Peck { depth: 2.9 }).len(), 10, "a third for the rest");
        let shallow = heights(HoleKind::Peck { depth: 0.2 });
        assert!(shallow[1..shallow.len() - 1].iter().all(|z| *z <= 10.0), "no higher than it goes up");
    }

    #[test]
    fn endless_pecks_are_refused() {
        let hole = |bottom: f64| Hole {
            at: [0.0, 0.0],
            level: 1.0,
            retract: 0.0,
            bottom,
            exit: 1.0,
            feed: None,
            kind: HoleKind::Peck { depth: 1.0 },
        };
        assert!(hole(-1001.0).moves().is_ok());
        assert!(hole(-1002.0).moves().is_err());
        let kind = HoleKind::Peck { depth: 0.0 };
        assert!(Hole { kind, ..hole(-1.0) }.moves().is_err());
    }
}
