//! Determines the order in which a program calls its control texts. (book: reference/post-definitions)
//!
//! A CAD6 program consists of contours: move above a point at safety height, descend to working height, plunge, cut the elements, and
//! retract to safety height. The rapids of a job are combined into such moves. Rapids that cannot be expressed in this way are an error;
//! they are never dropped.

use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Message};
use pathbuild_motion::{Course, Move, Pace, Plane, Position};
use pathbuild_path::approx::at_least;

use super::control_text::ControlTextKind;
use super::definition::{Abilities, Definition};
use crate::arcs::{ArcRounding, MAX_CHORDS, arc_piece_count, chords};
use crate::job::{Entry, Hole, HoleKind, Job, JobStep, Operation, Units};

type CallResult = Result<(), Box<Diagnostic>>;

/// Returns the calls for a job, except those for the start and the end of the program.
pub(super) fn calls<'a>(job: &'a Job, definition: &Definition) -> Result<Vec<Call<'a>>, Box<Diagnostic>> {
    let mut builder = Builder::new(job, definition);
    builder.begin();
    for index in 0..job.operations.len() {
        builder.operation(index)?;
    }
    builder.close_contour()?;
    Ok(builder.calls)
}

struct Builder<'a> {
    job: &'a Job,
    abilities: Abilities,
    units: Units,
    index: usize,
    calls: Vec<Call<'a>>,
    at: Point,
    /// Ends of the rapids since the last cut. These rapids are pending: only the next cut decides how they are written.
    ways: Vec<Point>,
    /// Comments, dwells and stops among the pending rapids.
    asides: Vec<CallContent<'a>>,
    is_open: bool,
    is_first: bool,
    /// Index in `calls` of the last element, as long as a contour may still end with it.
    last_element: Option<usize>,
    feed: Option<f64>,
}

impl<'a> Builder<'a> {
    fn new(job: &'a Job, definition: &Definition) -> Self {
        let first = &job.operations[0];
        let at = match first.entry {
            Entry::At(at) => at,
            Entry::Clearance => [0.0, 0.0, first.clearance],
        };
        Self {
            job,
            abilities: Abilities::of(definition),
            units: definition.units().unwrap_or(job.units),
            index: 0,
            calls: Vec::new(),
            at,
            ways: Vec::new(),
            asides: Vec::new(),
            is_open: false,
            is_first: true,
            last_element: None,
            feed: None,
        }
    }

    /// Adds the moves to the start of the job, for definitions with a text for rapid moves. The first tool change leaves the tool at the clearance
    /// plane, above an unknown position.
    fn begin(&mut self) {
        if !self.abilities.rapid {
            return;
        }
        let ([x, y, z], clearance) = (self.at, self.current_operation().clearance);
        if z < clearance {
            self.push_call(CallContent::Rapid { to: [x, y, clearance] });
        }
        self.push_call(CallContent::Rapid { to: self.at });
    }

    fn current_operation(&self) -> &'a Operation {
        &self.job.operations[self.index]
    }

    fn push_call(&mut self, content: CallContent<'a>) {
        match content {
            CallContent::Line { .. } | CallContent::Arc { .. } => self.last_element = Some(self.calls.len()),
            CallContent::Comment(_)
            | CallContent::Dwell(_)
            | CallContent::Stop
            | CallContent::Rapid { .. } => {}
            _ => self.last_element = None,
        }
        self.calls.push(Call { operation: self.index, content });
    }

    fn operation(&mut self, index: usize) -> CallResult {
        let is_new_tool =
            index > 0 && self.job.operations[index - 1].tool.index != self.job.operations[index].tool.index;
        if is_new_tool {
            self.close_contour()?;
            if self.job.operations[index].entry == Entry::Clearance {
                let [x, y, z] = self.pending_end();
                self.rapid([x, y, self.current_operation().clearance.max(z)]);
            }
        }
        self.index = index;
        self.approach_operation();
        self.current_operation().steps.iter().try_for_each(|step| self.step(step))
    }

    /// Adds moves to the start of an operation, unless the tool is already there.
    fn approach_operation(&mut self) {
        let [x, y, z] = self.pending_end();
        let clearance = self.current_operation().clearance;
        match self.current_operation().entry {
            Entry::At(at) if at != [x, y, z] => {
                for way in [[x, y, clearance.max(z)], [at[0], at[1], clearance.max(z)], at] {
                    self.rapid(way);
                }
            }
            Entry::At(_) => {}
            Entry::Clearance => self.rapid([x, y, clearance]),
        }
    }

    /// Returns the position of the tool after the pending rapids.
    fn pending_end(&self) -> Point {
        self.ways.last().copied().unwrap_or(self.at)
    }

    fn resolve(&self, to: Position) -> Point {
        let [x, y, z] = self.pending_end();
        let [to_x, to_y, to_z] = to.axes();
        [to_x.unwrap_or(x), to_y.unwrap_or(y), to_z.unwrap_or(z)]
    }

    fn step(&mut self, step: &'a JobStep) -> CallResult {
        match step {
            JobStep::Move(movement) => return self.move_along(movement),
            JobStep::Hole(hole) => return self.hole(hole),
            JobStep::SpindleOff { .. } => {
                return Err(Box::new(self.operation_error(&posts::JOB_SPINDLE_OFF)));
            }
            JobStep::Comment(text) => self.add_stationary_call(CallContent::Comment(text)),
            JobStep::Dwell { seconds } => self.add_stationary_call(CallContent::Dwell(*seconds)),
            JobStep::Stop => self.add_stationary_call(CallContent::Stop),
        }
        Ok(())
    }

    /// Returns an error of the current operation.
    fn operation_error(&self, message: &'static Message) -> Diagnostic {
        Diagnostic::new(message).quoting("operation", &*self.current_operation().name)
    }

    fn move_along(&mut self, movement: &Move) -> CallResult {
        match (movement.course(), movement.pace) {
            (Some(course), _) => self.arc(movement, &course),
            (None, Pace::Rapid) => {
                self.rapid(self.resolve(movement.to));
                Ok(())
            }
            (None, Pace::Feed(_)) => self.feed(self.resolve(movement.to), movement.pace.stated_feed()),
            (None, Pace::Probe { .. }) => {
                Err(Box::new(self.operation_error(&posts::NO_TEXT_FOR).quoting("text", "probe")))
            }
        }
    }

    /// Adds a call that neither moves the tool nor ends a contour. While rapids are pending, the call is held back with them.
    fn add_stationary_call(&mut self, content: CallContent<'a>) {
        if self.ways.is_empty() {
            self.push_call(content);
        } else {
            self.asides.push(content);
        }
    }

    fn rapid(&mut self, to: Point) {
        if self.abilities.rapid {
            if to != self.at {
                self.push_call(CallContent::Rapid { to });
                self.finish_contour();
            }
            self.at = to;
        } else {
            self.ways.push(to);
        }
    }

    fn hole(&mut self, hole: &Hole) -> CallResult {
        let is_kind_supported = match hole.kind {
            HoleKind::Plain => true,
            HoleKind::Peck { .. } => self.abilities.peck,
            HoleKind::Dwell { .. } => self.abilities.dwell,
        };
        if !self.abilities.hole || !is_kind_supported {
            for step in hole.moves()? {
                match step {
                    JobStep::Move(movement) => self.move_along(&movement)?,
                    JobStep::Dwell { seconds } => self.add_stationary_call(CallContent::Dwell(seconds)),
                    _ => {}
                }
            }
            return Ok(());
        }
        self.ways.push([hole.at[0], hole.at[1], hole.level]);
        let clearance = self.travel_height().max(hole.exit);
        self.close_contour()?;
        self.push_call(CallContent::Hole { hole: *hole, clearance });
        self.at = [hole.at[0], hole.at[1], hole.exit];
        Ok(())
    }

    /// Adds a straight cut.
    fn feed(&mut self, to: Point, feed: Option<f64>) -> CallResult {
        let way_end = self.pending_end();
        let is_plunge = same_xy(way_end, to) && to[2] < way_end[2];
        let is_start = !self.is_open || !self.ways.is_empty();
        self.complete_rapids(is_plunge.then_some((to, feed)))?;
        if is_plunge && is_start && self.at == to {
            return Ok(());
        }
        self.line(to, feed)
    }

    fn line(&mut self, to: Point, feed: Option<f64>) -> CallResult {
        if to[2] != self.at[2] && !self.abilities.line_z {
            if !(same_xy(self.at, to) && self.abilities.lift_between_passes) {
                return Err(self.missing_z_error(to, ControlTextKind::Line));
            }
            let (clearance, working) = (self.current_operation().clearance, self.at[2].max(to[2]));
            self.end_contour(clearance);
            self.start_contour(to, clearance, working, feed);
            return Ok(());
        }
        let place = self.contour_position(feed);
        self.push_call(CallContent::Line { to, feed, place });
        self.at = to;
        Ok(())
    }

    fn missing_z_error(&self, to: Point, kind: ControlTextKind) -> Box<Diagnostic> {
        let diagnostic =
            self.operation_error(&posts::NO_Z_IN_TEXT).with("from", self.at[2]).with("to", to[2]);
        Box::new(diagnostic.quoting("text", kind.name()))
    }

    fn contour_position(&mut self, feed: Option<f64>) -> ContourPosition {
        let is_first = self.is_first || feed != self.feed;
        self.is_first = false;
        self.feed = feed;
        ContourPosition { is_first, is_last: false }
    }

    fn arc(&mut self, movement: &Move, course: &Course) -> CallResult {
        self.complete_rapids(None)?;
        let is_level = movement.to.z() == movement.from.z();
        let is_writable =
            self.abilities.arc && course.arc().plane == Plane::Xy && (is_level || self.abilities.arc_z);
        if is_writable {
            for piece in movement.split(arc_piece_count(course, self.abilities.arc_sweep)) {
                let Some(movement) = self.rounded_arc(&piece)? else {
                    self.line(piece.to.at, piece.pace.stated_feed())?;
                    continue;
                };
                let place = self.contour_position(movement.pace.stated_feed());
                self.push_call(CallContent::Arc { movement, place });
                self.at = movement.to.at;
            }
            return Ok(());
        }
        if self.abilities.arc && !is_level && !self.abilities.line_z {
            let diagnostic = self.operation_error(&posts::NO_Z_IN_ARC);
            return Err(Box::new(diagnostic.with("from", movement.from.z()).with("to", movement.to.z())));
        }
        let Some(count) = chords(course, self.abilities.arc_tolerance) else {
            let diagnostic = Diagnostic::new(&posts::TOO_MANY_CHORDS).with("limit", u64::from(MAX_CHORDS));
            return Err(Box::new(diagnostic.with("radius", course.radius())));
        };
        movement.split(count).try_for_each(|piece| self.line(piece.to.at, piece.pace.stated_feed()))
    }

    /// Adjusts an arc so that it is still an arc after its numbers are rounded. Returns `None` if it would be read as a full circle
    /// because its rounded ends are equal.
    fn rounded_arc(&self, movement: &Move) -> Result<Option<Move>, Box<Diagnostic>> {
        let unit = self.units.millimetres();
        let digits = libm::pow(10.0, self.abilities.decimals as f64);
        let length = |length: f64| (length / unit * digits).round() / digits;
        let rounding = ArcRounding { length: &length, is_absolute: !self.abilities.has_relative_centres };
        if rounding.becomes_full_circle(movement) {
            return Ok(None);
        }
        if self.abilities.has_relative_centres || self.abilities.has_absolute_centres {
            return rounding.fit_centre(movement, self.units.millimetres()).map(Some);
        }
        Ok(Some(*movement))
    }

    /// Completes the pending rapids. If a contour is open and all of them are within the material, they become its elements; otherwise they lead to a
    /// new contour, which may begin with a plunge.
    fn complete_rapids(&mut self, plunge: Option<(Point, Option<f64>)>) -> CallResult {
        if self.abilities.rapid {
            return Ok(());
        }
        let surface = self.current_operation().surface;
        let is_within = self.is_open && self.ways.iter().all(|way| !at_least(way[2], surface));
        if is_within {
            self.write_stationary_calls();
            return self.add_rapids_to_contour(self.ways.len());
        }
        let (to, working, clearance) = (self.pending_end(), self.pending_end()[2], self.travel_height());
        self.close_contour()?;
        let (to, feed) = plunge.unwrap_or((to, None));
        self.start_contour(to, clearance, working, feed);
        Ok(())
    }

    /// Turns the first `count` pending rapids into elements of the contour.
    fn add_rapids_to_contour(&mut self, count: usize) -> CallResult {
        let ways: Vec<Point> = self.ways.drain(..count).collect();
        ways.into_iter().try_for_each(|way| self.line(way, self.feed))
    }

    /// Returns the number of pending rapids up to and including the last one that moves sideways within the material.
    fn count_sideways_rapids(&self) -> usize {
        let surface = self.current_operation().surface;
        let (mut before, mut count) = (self.at, 0);
        for (index, &way) in self.ways.iter().enumerate().take_while(|(_, way)| !at_least(way[2], surface)) {
            if !same_xy(before, way) {
                count = index + 1;
            }
            before = way;
        }
        count
    }

    /// Returns the greatest height in mm that the pending rapids reach. Unless a contour is open, their start counts as well.
    fn highest(&self) -> f64 {
        let start = if self.is_open { f64::NEG_INFINITY } else { self.at[2] };
        self.ways.iter().map(|way| way[2]).fold(start, f64::max)
    }

    /// Returns the height in mm at which the tool travels to the end of the pending rapids: their highest point or, if they do not lead there in a
    /// straight line and it is higher, the clearance plane.
    fn travel_height(&self) -> f64 {
        let (from, to) = (self.at, self.pending_end());
        let is_straight = |way: &Point| {
            let [along, across] = [[to[0] - from[0], to[1] - from[1]], [way[0] - from[0], way[1] - from[1]]];
            let square = along[0] * along[0] + along[1] * along[1];
            let share = along[0] * across[0] + along[1] * across[1];
            let aside = along[0] * across[1] - along[1] * across[0];
            aside.abs() <= 1e-9 * square.max(1.0) && (-1e-9..=square + 1e-9).contains(&share)
        };
        let highest = self.highest();
        if self.ways.iter().all(is_straight) {
            highest
        } else {
            highest.max(self.current_operation().clearance)
        }
    }

    fn start_contour(&mut self, at: Point, clearance: f64, working: f64, feed: Option<f64>) {
        self.push_call(CallContent::Start { at, clearance, working, feed });
        self.at = at;
        self.is_open = true;
        self.is_first = true;
    }

    /// Ends the open contour at a height from which the end of the pending rapids can be reached.
    fn close_contour(&mut self) -> CallResult {
        let end = self.pending_end();
        if self.is_open && !self.abilities.rapid {
            self.add_rapids_to_contour(self.count_sideways_rapids())?;
            let height = self.travel_height();
            self.end_contour(if height.is_finite() { height } else { self.current_operation().clearance });
        } else if !self.ways.is_empty() {
            self.raise_safety_height_of_hole();
        }
        self.finish_contour();
        self.at = end;
        self.ways.clear();
        self.write_stationary_calls();
        Ok(())
    }

    /// Raises the safety height of the last hole to the height of the following moves, because the text of a hole ends at its safety
    /// height.
    fn raise_safety_height_of_hole(&mut self) {
        let height = self.travel_height();
        let is_aside = |what: &CallContent<'_>| {
            matches!(what, CallContent::Comment(_) | CallContent::Dwell(_) | CallContent::Stop)
        };
        let last = self.calls.iter_mut().rev().find(|call| !is_aside(&call.content));
        if let Some(Call { content: CallContent::Hole { clearance, .. }, .. }) = last {
            *clearance = clearance.max(height);
        }
    }

    fn write_stationary_calls(&mut self) {
        for aside in std::mem::take(&mut self.asides) {
            self.push_call(aside);
        }
    }

    fn end_contour(&mut self, clearance: f64) {
        self.finish_contour();
        self.push_call(CallContent::End { clearance });
        self.is_open = false;
    }

    /// Marks the last element as the end of the contour.
    fn finish_contour(&mut self) {
        self.is_first = true;
        let last = self.last_element.map(|index| &mut self.calls[index].content);
        if let Some(CallContent::Line { place, .. } | CallContent::Arc { place, .. }) = last {
            place.is_last = true;
        }
    }
}

fn same_xy(a: Point, b: Point) -> bool {
    a[..2] == b[..2]
}

/// X, Y, Z in mm.
pub(super) type Point = [f64; 3];

/// A call of a control text before its variables are set, and the index of the operation that it belongs to.
#[derive(Debug)]
pub(super) struct Call<'a> {
    pub(super) operation: usize,
    pub(super) content: CallContent<'a>,
}

/// The action that a called text must write.
#[derive(Debug)]
pub(super) enum CallContent<'a> {
    /// Moves to the start of a contour at safety height (`clearance`), by rapid down to working height, and at feed down to `at`. Heights
    /// are in mm.
    Start { at: Point, clearance: f64, working: f64, feed: Option<f64> },
    /// Cuts a straight element of a contour.
    Line { to: Point, feed: Option<f64>, place: ContourPosition },
    /// Cuts a circular element of a contour.
    Arc { movement: Move, place: ContourPosition },
    /// Retracts from the end of a contour.
    End { clearance: f64 },
    /// Drills a hole, from and to the height `clearance` in mm.
    Hole { hole: Hole, clearance: f64 },
    /// A rapid move, for definitions with a text for rapid moves.
    Rapid { to: Point },
    /// A dwell, in seconds.
    Dwell(f64),
    /// A stop that waits for the operator.
    Stop,
    /// A comment for the operator.
    Comment(&'a str),
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContourPosition {
    /// Whether the element is the first one of the contour, or the first one after a change of feed.
    pub(super) is_first: bool,
    pub(super) is_last: bool,
}
