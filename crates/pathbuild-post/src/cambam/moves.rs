//! The moves of an operation: entry, rapids, feeds, arcs, drilling cycles, dwells, probes.

use std::f64::consts::PI;
use std::mem::discriminant;

use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_gcode::dialect::DwellUnit;
use pathbuild_motion::{Arc, Coolant, Course, Move, Pace, Plane, Turning};
use pathbuild_path::approx::{at_least, near};

use super::machine::{ArcValues, MoveValues, Register};
use super::macros::{Argument, Macro, Value};
use super::section::Section;
use super::writer::{ROTARY, WriteResult, Writer};
use crate::arcs::{ArcRounding, MAX_CHORDS, arc_piece_count, chords};
use crate::job::{Entry, Hole, HoleKind, JobStep};

impl Writer<'_> {
    /// Writes the moves of the current operation.
    pub(super) fn blocks(&mut self) -> WriteResult {
        match self.operation().entry {
            Entry::Clearance => self.move_to_clearance()?,
            Entry::At(start) => self.move_via_clearance(start.map(Some))?,
        }
        let steps = &self.operation().steps;
        let mut rest = steps.as_slice();
        while let Some((step, after)) = rest.split_first() {
            rest = match step {
                JobStep::Hole(hole) if self.plan.options.cycles && fits_canned_cycle(hole) => {
                    self.cycles(rest)?
                }
                _ => {
                    self.step(step)?;
                    after
                }
            };
        }
        Ok(())
    }

    /// Writes a step. A hole is written as moves, not as a canned cycle.
    pub(super) fn step(&mut self, step: &JobStep) -> WriteResult {
        match step {
            JobStep::Move(movement) => self.move_to(movement),
            JobStep::Hole(hole) => hole.moves()?.iter().try_for_each(|step| self.step(step)),
            JobStep::Dwell { seconds } => {
                let mut values = MoveValues::default();
                values.set(Register::P, Some(self.dwell(*seconds)));
                self.write_move(Section::Dwell, [None; 3], values)
            }
            JobStep::Stop => {
                self.write_section_lines(Section::Stop)?;
                // The operator may have moved the tool, so the next height is written in full.
                self.machine.forget(&[Register::Z]);
                Ok(())
            }
            JobStep::SpindleOff { coolant } => self.switch_spindle_off(*coolant),
            JobStep::Comment(text) => self.write_comment(text, " "),
        }
    }

    /// Switches off the spindle, and the coolant if `coolant`, unless they are off.
    fn switch_spindle_off(&mut self, coolant: bool) -> WriteResult {
        if self.machine.spindle != Some(Turning::Off) {
            self.write_named_section(Section::SpindleOff)?;
            self.end_line();
        }
        if coolant && self.machine.coolant.is_some_and(Coolant::is_on) {
            self.write_named_section(Section::CoolantOff)?;
            self.end_line();
        }
        Ok(())
    }

    fn move_to(&mut self, movement: &Move) -> WriteResult {
        match (movement.course(), movement.pace) {
            (Some(course), _) => self.arc(movement, &course),
            (None, Pace::Rapid) => self.write_move(Section::Rapid, movement.to.axes(), MoveValues::default()),
            (None, Pace::Feed(_)) => self.feed(movement.to.axes(), movement.pace.stated_feed()),
            (None, Pace::Probe { .. }) => {
                let values = self.with_feed(movement.pace.stated_feed());
                self.write_move(Section::Probe, movement.to.axes(), values)?;
                // Only the machine knows where the probe stopped, so the next coordinates are written in full.
                self.machine.forget(&[Register::X, Register::Y, Register::Z]);
                Ok(())
            }
        }
    }

    /// Converts a time in seconds to milliseconds if a setting of the control requires this.
    pub(super) fn dwell(&self, seconds: f64) -> f64 {
        let has_choice =
            self.plan.target.is_some_and(|target| target.reader.rules().dwell.p == DwellUnit::BySetting);
        if self.plan.options.milliseconds && has_choice { 1000.0 * seconds } else { seconds }
    }

    /// Whether the control always reads P as milliseconds, not by a setting. `{$move.p}` is still in seconds, for controls that have another letter
    /// for seconds.
    pub(super) fn counts_milliseconds(&self) -> bool {
        self.plan.target.is_some_and(|target| target.reader.rules().dwell.p == DwellUnit::Milliseconds)
    }

    /// Writes a straight cut.
    pub(super) fn feed(&mut self, to: [Option<f64>; 3], feed: Option<f64>) -> WriteResult {
        let values = self.with_feed(feed);
        self.write_move(Section::FeedMove, to, values)
    }

    fn with_feed(&self, feed: Option<f64>) -> MoveValues {
        let mut values = MoveValues::default();
        values.set(Register::F, feed.map(|feed| self.scaled(feed)));
        values
    }

    /// Writes a move through a section: sets the register values, and adds the definition's texts for the start and end of cutting.
    ///
    /// An axis without a target keeps its position, if it is known from the lines written so far.
    pub(super) fn write_move(
        &mut self,
        section: Section,
        to: [Option<f64>; 3],
        values: MoveValues,
    ) -> WriteResult {
        let was_cutting = self.is_cutting;
        if let Some(z) = to[2] {
            self.is_cutting = self.is_below_surface(z);
        }
        if self.is_cutting && !was_cutting {
            self.write_section_lines(Section::StartCut)?;
        }
        self.set_move(to, values)?;
        self.write_section_lines(section)?;
        self.record_position(to);
        if was_cutting && !self.is_cutting {
            self.write_section_lines(Section::EndCut)?;
        }
        Ok(())
    }

    fn set_move(&mut self, to: [Option<f64>; 3], values: MoveValues) -> WriteResult {
        self.move_values = values;
        for (axis, target) in to.into_iter().enumerate() {
            let value = target.map(|target| self.scaled(target)).or_else(|| self.current_position(axis));
            self.move_values.set(Register::AXES[axis], value);
        }
        self.wrap_around_cylinder(to)
    }

    /// Records the intended position of the tool, and for each axis the text written for it.
    fn record_position(&mut self, to: [Option<f64>; 3]) {
        for (axis, target) in to.into_iter().enumerate() {
            if let Some(target) = target {
                let text = self.machine.last_text(Register::AXES[axis]).map(Into::into);
                self.intended[axis] = Some((self.scaled(target), text));
            }
        }
    }

    /// Returns the current position of the tool in the output unit: that of the program's moves, because a template may write them with reversed
    /// sign; or the number last written, if a line of another kind has moved the tool since.
    fn current_position(&self, axis: usize) -> Option<f64> {
        let register = Register::AXES[axis];
        match &self.intended[axis] {
            Some((at, text)) if text.as_deref() == self.machine.last_text(register) => Some(*at),
            _ => self.machine.number(register),
        }
    }

    /// Whether the tool is at a coordinate, compared after rounding.
    fn is_at(&self, axis: usize, target: f64) -> bool {
        let rotary = self.plan.definition.options.rotary;
        let register = if rotary.wrap && axis == 1 - rotary.along {
            ROTARY[rotary.letter]
        } else {
            Register::AXES[axis]
        };
        self.machine.last_text(register).is_some()
            && self
                .current_position(axis)
                .is_some_and(|at| self.number_format().format(at) == self.length(target))
    }

    /// Writes a section that consists of entire lines.
    fn write_section_lines(&mut self, section: Section) -> WriteResult {
        self.write_section(section)?;
        self.end_line();
        Ok(())
    }

    /// Whether a height in mm is below the stock surface, compared after rounding.
    fn is_below_surface(&self, z: f64) -> bool {
        let format = self.number_format();
        format.round(self.scaled(z)) < format.round(self.scaled(self.operation().surface))
    }

    /// Converts the coordinate perpendicular to the cylinder's axis to an angle around it, if the definition wraps paths around a cylinder.
    fn wrap_around_cylinder(&mut self, to: [Option<f64>; 3]) -> WriteResult {
        let rotary = self.plan.definition.options.rotary;
        if !rotary.wrap {
            return Ok(());
        }
        let radius = self.operation().surface;
        if radius <= 0.0 {
            let diagnostic = Diagnostic::new(&posts::NO_RADIUS).quoting("operation", &*self.operation().name);
            return Err(Box::new(diagnostic.in_file(self.plan.file)));
        }
        let replaced = 1 - rotary.along;
        let angle = to[replaced].map(|across| (across / radius).to_degrees());
        if let Some(angle) = angle {
            let [least, most] = self.angles.get_or_insert([angle; 2]);
            (*least, *most) = (least.min(angle), most.max(angle));
        }
        // The angle replaces the coordinate.
        self.move_values.set(Register::AXES[replaced], None);
        let register = ROTARY[rotary.letter];
        self.move_values.set(register, angle.or_else(|| self.machine.number(register)));
        Ok(())
    }

    /// Writes a move to the clearance plane, unless the tool is already there.
    pub(super) fn move_to_clearance(&mut self) -> WriteResult {
        let clearance = self.operation().clearance;
        if self.is_at(2, clearance) {
            return Ok(());
        }
        let to = [None, None, Some(clearance)];
        let is_down = self.current_position(2).is_some_and(|now| now > self.scaled(clearance));
        if is_down && !self.plan.definition.options.rapid_down {
            return self.feed(to, self.operation().plunge_feed);
        }
        self.write_move(Section::Rapid, to, MoveValues::default())
    }

    /// Expands `{$check(x,y,z)}`.
    pub(super) fn check_macro(&mut self, target: [Argument; 3]) -> WriteResult {
        let unit = self.plan.unit();
        let mut to = [None; 3];
        for ((coordinate, argument), register) in to.iter_mut().zip(target).zip(Register::AXES) {
            *coordinate = match argument {
                Argument::Any => None,
                Argument::Own => self.move_values.get(register).map(|value| value * unit),
                Argument::Number(value) => Some(value * unit),
            };
        }
        self.move_via_clearance(to)
    }

    /// Writes the moves to a position via the clearance plane, unless the tool is already there.
    pub(super) fn move_via_clearance(&mut self, target: [Option<f64>; 3]) -> WriteResult {
        let is_there =
            target.iter().enumerate().all(|(axis, target)| target.is_none_or(|at| self.is_at(axis, at)));
        if is_there {
            return Ok(());
        }
        self.move_to_clearance()?;
        self.write_move(Section::Rapid, [target[0], target[1], None], MoveValues::default())?;
        match target[2] {
            Some(z) if self.is_below_surface(z) => {
                self.feed([None, None, Some(z)], self.operation().plunge_feed)
            }
            z => self.write_move(Section::Rapid, [None, None, z], MoveValues::default()),
        }
    }
}

const CENTRE_REGISTERS: [Register; 3] = [Register::I, Register::J, Register::K];

impl Writer<'_> {
    /// Writes an arc in the form required by the options of the definition. An arc that is too short or too large for them, or that would be read as
    /// a full circle after rounding, becomes a single line. An arc in a plane that the output does not state becomes chords.
    pub(super) fn arc(&mut self, movement: &Move, course: &Course) -> WriteResult {
        let options = &self.plan.definition.options;
        let has_plane = course.arc().plane == Plane::Xy || self.plan.states_plane();
        if options.arcs_as_lines || options.rotary.wrap || !has_plane {
            return self.chords(movement, course);
        }
        let is_short = self.scaled(course.radius() * course.sweep()) < options.least_arc_length;
        let closes = self.with_rounding(|rounding| rounding.becomes_full_circle(movement));
        if is_short || closes || self.scaled(course.radius()) > options.greatest_arc_radius {
            self.warn_of_line(movement, course);
            return self.line(movement);
        }
        if self.is_written_by_radius(course) {
            return movement
                .split(arc_piece_count(course, MAX_ANGLE_BY_RADIUS))
                .try_for_each(|piece| self.circle(&piece));
        }
        let fitted =
            self.with_rounding(|rounding| rounding.fit_centre(movement, self.plan.job.units.millimetres()));
        self.circle(&fitted.map_err(|error| Box::new(error.in_file(self.plan.file)))?)
    }

    fn line(&mut self, movement: &Move) -> WriteResult {
        self.feed(movement.to.axes(), movement.pace.stated_feed())
    }

    fn chords(&mut self, movement: &Move, course: &Course) -> WriteResult {
        let Some(count) = chords(course, self.plan.arc_tolerance()) else {
            let diagnostic = Diagnostic::new(&posts::TOO_MANY_CHORDS).with("limit", u64::from(MAX_CHORDS));
            return Err(Box::new(diagnostic.with("radius", course.radius()).in_file(self.plan.file)));
        };
        movement.split(count).try_for_each(|piece| self.line(&piece))
    }

    fn warn_of_line(&mut self, movement: &Move, course: &Course) {
        if course.sagitta() > self.plan.arc_tolerance() {
            let diagnostic = Diagnostic::new(&posts::ARC_FLATTENED)
                .with("place", Point::new(movement.to.x(), movement.to.y()));
            self.warn(diagnostic.with("radius", course.radius()).with("distance", course.sagitta()));
        }
    }

    /// Whether the template writes the radius but no centre. Such an arc is unambiguous only if it sweeps less than half a turn.
    fn is_written_by_radius(&self, course: &Course) -> bool {
        let template = self.plan.definition.section(self.arc_section(&course.arc()));
        let has_centre = template.macros().any(|(what, _)| match what {
            Macro::Register(register, _) | Macro::Value(Value::ArcOffset(register)) => {
                CENTRE_REGISTERS.contains(register)
            }
            _ => false,
        });
        !has_centre && template.macros().any(|(what, _)| *what == Macro::Value(Value::ArcRadius))
    }

    fn arc_section(&self, arc: &Arc) -> Section {
        let is_inverted = self.plan.definition.options.invert_arcs && arc.plane == Plane::Zx;
        if arc.clockwise == is_inverted { Section::ArcCcw } else { Section::ArcCw }
    }

    /// Calls a function with the rounding rules for arcs.
    fn with_rounding<T>(&self, ask: impl FnOnce(&ArcRounding<'_>) -> T) -> T {
        let length = |length: f64| self.number_format().round(self.scaled(length));
        ask(&ArcRounding { length: &length, is_absolute: self.is_absolute() })
    }

    fn is_absolute(&self) -> bool {
        self.plan.definition.options.absolute_centres
    }

    fn circle(&mut self, movement: &Move) -> WriteResult {
        let Some(course) = movement.course() else { return self.line(movement) };
        let mut values = self.with_feed(movement.pace.stated_feed());
        let arc = course.arc();
        let origin = if self.is_absolute() { [0.0; 3] } else { movement.from.at };
        for (axis, centre) in arc.plane.axes().into_iter().zip(arc.centre) {
            values.set(CENTRE_REGISTERS[axis], Some(self.scaled(centre - origin[axis])));
        }
        values.arc = Some(self.arc_values(&course));
        self.write_move(self.arc_section(&arc), movement.to.axes(), values)
    }

    fn arc_values(&self, course: &Course) -> ArcValues {
        let [start, end] = course.directions().map(|angle| angle.to_degrees().rem_euclid(360.0));
        let clockwise = if course.arc().clockwise { 1.0 } else { -1.0 };
        let sweep = clockwise * course.sweep().to_degrees();
        ArcValues { radius: self.scaled(course.radius()), start, end, sweep }
    }
}

/// Maximum angle in radians of an arc written by its radius. Larger arcs are split.
const MAX_ANGLE_BY_RADIUS: f64 = PI * 2.0 / 3.0;

/// Registers that the first canned cycle of a group must write even if they are unchanged. Controls keep R, P and Q only until the end of a cycle.
const CYCLE_REGISTERS: [Register; 6] =
    [Register::X, Register::Y, Register::Z, Register::R, Register::P, Register::Q];

impl<'a> Writer<'a> {
    /// Writes the holes at the beginning of `steps` as one group of canned cycles and returns the remaining steps.
    pub(super) fn cycles(&mut self, steps: &'a [JobStep]) -> Result<&'a [JobStep], Box<Diagnostic>> {
        let (group, rest) = steps.split_at(group_length(steps));
        let holes = || group.iter().filter_map(as_hole);
        let Some(first) = holes().next() else { return Ok(rest) };
        self.write_move(Section::Rapid, [None, None, Some(first.level)], MoveValues::default())?;
        self.write_move(Section::Rapid, [Some(first.at[0]), Some(first.at[1]), None], MoveValues::default())?;
        self.write_section_lines(Section::CannedCycleStart)?;
        self.machine.forget(&CYCLE_REGISTERS);
        for step in group {
            match as_hole(step) {
                Some(hole) => self.cycle(hole)?,
                None => self.step(step)?,
            }
        }
        self.write_section_lines(Section::CannedCycleEnd)?;
        let exit = holes().next_back().map(|hole| hole.exit);
        self.write_move(Section::Rapid, [None, None, exit], MoveValues::default())?;
        Ok(rest)
    }

    fn cycle(&mut self, hole: &Hole) -> WriteResult {
        let section = match hole.kind {
            HoleKind::Plain => Section::Drill,
            HoleKind::Dwell { .. } => Section::DrillDwell,
            HoleKind::Peck { .. } => Section::DrillPeck,
        };
        let is_below = self.is_below_surface(hole.bottom);
        if is_below {
            self.write_section_lines(Section::StartCut)?;
        }
        let to = [Some(hole.at[0]), Some(hole.at[1]), Some(hole.bottom)];
        self.set_move(to, self.cycle_values(hole))?;
        self.empty_code = None;
        self.write_section_lines(section)?;
        self.check_drilled(hole, section)?;
        if is_below {
            self.write_section_lines(Section::EndCut)?;
        }
        Ok(())
    }

    fn cycle_values(&self, hole: &Hole) -> MoveValues {
        let mut values = self.with_feed(hole.feed);
        values.set(Register::R, Some(self.scaled(hole.retract)));
        match hole.kind {
            HoleKind::Plain => {}
            HoleKind::Dwell { seconds } => values.set(Register::P, Some(self.dwell(seconds))),
            HoleKind::Peck { depth } => values.set(Register::Q, Some(self.scaled(depth))),
        }
        values
    }

    /// Checks that the definition writes the hole: neither its section nor the word of its cycle may be empty.
    fn check_drilled(&self, hole: &Hole, section: Section) -> WriteResult {
        let is_blank = self.plan.definition.section(section).is_blank();
        let Some(empty) = is_blank.then_some(section).or(self.empty_code) else { return Ok(()) };
        let diagnostic =
            Diagnostic::new(&posts::DRILLING_LOST).with("place", Point::new(hole.at[0], hole.at[1]));
        Err(Box::new(self.plan.locate(diagnostic, empty, 0)))
    }
}

/// Whether a hole can be written as a canned cycle, which retracts at least to the height where it started.
fn fits_canned_cycle(hole: &Hole) -> bool {
    at_least(hole.exit, hole.level)
}

/// Returns the number of steps in the group at the beginning of `steps`. A group consists of holes between which the tool stays at the same level,
/// and comments among them.
fn group_length(steps: &[JobStep]) -> usize {
    let mut length = 0;
    let mut last: Option<&Hole> = None;
    // A control forgets R when the word of the cycle changes, so cycles of different kinds form different groups.
    let continues = |last: &Hole, hole: &Hole| {
        near(last.exit, hole.level) && discriminant(&last.kind) == discriminant(&hole.kind)
    };
    for (index, step) in steps.iter().enumerate() {
        match step {
            JobStep::Hole(hole)
                if fits_canned_cycle(hole) && last.is_none_or(|last| continues(last, hole)) =>
            {
                last = Some(hole);
                length = index + 1;
            }
            JobStep::Comment(_) => {}
            _ => break,
        }
    }
    length
}

fn as_hole(step: &JobStep) -> Option<&Hole> {
    match step {
        JobStep::Hole(hole) => Some(hole),
        _ => None,
    }
}
