//! The moves of an operation: entry, rapids, feeds, dwells, probes.

use pathbuild_diagnostic::{Diagnostic, messages::posts};
use pathbuild_gcode::dialect::DwellUnit;
use pathbuild_motion::{Move, Pace};

use super::cycles::can_be_canned;
use super::macros::Argument;
use super::move_values::MoveValues;
use super::registers::Register;
use super::section::Section;
use super::writer::{ROTARY, WriteResult, Writer};
use crate::holes;
use crate::job::Entry;
use crate::step::Step;

impl Writer<'_> {
    /// Writes the moves of the current operation.
    pub(super) fn blocks(&mut self) -> WriteResult {
        match self.operation().entry {
            Entry::Clearance => self.clearance()?,
            Entry::At(start) => self.check(start.map(Some))?,
        }
        let steps = &self.operation().steps;
        let mut rest = steps.as_slice();
        while let Some((step, after)) = rest.split_first() {
            rest = match step {
                Step::Hole(hole) if self.plan.options.cycles && can_be_canned(hole) => self.cycles(rest)?,
                _ => {
                    self.step(step)?;
                    after
                }
            };
        }
        Ok(())
    }

    /// Writes any step except a canned cycle.
    pub(super) fn step(&mut self, step: &Step) -> WriteResult {
        match step {
            Step::Move(movement) => self.move_to(movement),
            Step::Hole(hole) => holes::moves(hole)?.iter().try_for_each(|step| self.step(step)),
            Step::Dwell { seconds } => {
                let mut values = MoveValues::default();
                values.set(Register::P, Some(self.dwell(*seconds)));
                self.go(Section::Dwell, [None; 3], values)
            }
            Step::Stop => self.lines_of(Section::Stop),
            Step::Comment(text) => self.comment(text, " "),
        }
    }

    fn move_to(&mut self, movement: &Move) -> WriteResult {
        match (movement.course(), movement.pace) {
            (Some(course), _) => self.arc(movement, &course),
            (None, Pace::Rapid) => self.go(Section::Rapid, movement.to.axes(), MoveValues::default()),
            (None, Pace::Feed(_)) => self.feed(movement.to.axes(), movement.pace.stated_feed()),
            (None, Pace::Probe { .. }) => {
                let values = self.with_feed(movement.pace.stated_feed());
                self.go(Section::Probe, movement.to.axes(), values)?;
                // Only the machine knows where the probe stopped, so the next coordinates are written in full.
                self.machine.forget(&[Register::X, Register::Y, Register::Z]);
                Ok(())
            }
        }
    }

    /// Converts a time to the unit in which the control counts it.
    pub(super) fn dwell(&self, seconds: f64) -> f64 {
        let has_choice =
            self.plan.target.is_some_and(|target| target.reader.rules().dwell.p == DwellUnit::BySetting);
        if self.plan.options.milliseconds && has_choice { 1000.0 * seconds } else { seconds }
    }

    /// Writes a straight cut.
    pub(super) fn feed(&mut self, to: [Option<f64>; 3], feed: Option<f64>) -> WriteResult {
        let values = self.with_feed(feed);
        self.go(Section::FeedMove, to, values)
    }

    /// The register values of a move that has none besides the feed.
    pub(super) fn with_feed(&self, feed: Option<f64>) -> MoveValues {
        let mut values = MoveValues::default();
        values.set(Register::F, feed.map(|feed| self.scaled(feed)));
        values
    }

    /// Writes a move through a section: sets the register values, and adds the texts for the start and end of cutting.
    ///
    /// Axes without a target stay at their position, as far as it is known from the lines written so far.
    pub(super) fn go(&mut self, section: Section, to: [Option<f64>; 3], values: MoveValues) -> WriteResult {
        let was_cutting = self.is_cutting;
        if let Some(z) = to[2] {
            self.is_cutting = self.is_below_surface(z);
        }
        if self.is_cutting && !was_cutting {
            self.lines_of(Section::StartCut)?;
        }
        self.set_move(to, values)?;
        self.lines_of(section)?;
        self.remember(to);
        if was_cutting && !self.is_cutting {
            self.lines_of(Section::EndCut)?;
        }
        Ok(())
    }

    /// Sets the register values for a move.
    pub(super) fn set_move(&mut self, to: [Option<f64>; 3], values: MoveValues) -> WriteResult {
        self.move_values = values;
        for (axis, target) in to.into_iter().enumerate() {
            let value = target.map(|target| self.scaled(target)).or_else(|| self.present(axis));
            self.move_values.set(Register::AXES[axis], value);
        }
        self.wrap(to)
    }

    /// Records the position of the tool according to the program.
    pub(super) fn remember(&mut self, to: [Option<f64>; 3]) {
        for (axis, target) in to.into_iter().enumerate() {
            if let Some(target) = target {
                let text = self.machine.written(Register::AXES[axis]).map(Into::into);
                self.own[axis] = Some((self.scaled(target), text));
            }
        }
    }

    /// The current position of the tool in the output unit. It follows from the moves of the program, which a template may write with
    /// reversed sign, unless another kind of line has moved the tool since.
    fn present(&self, axis: usize) -> Option<f64> {
        let register = Register::AXES[axis];
        match &self.own[axis] {
            Some((at, text)) if text.as_deref() == self.machine.written(register) => Some(*at),
            _ => self.machine.number(register),
        }
    }

    /// Whether the tool is at a coordinate after rounding.
    fn is_at(&self, axis: usize, target: f64) -> bool {
        let rotary = self.plan.definition.options.rotary;
        let register = if rotary.wrap && axis == 1 - rotary.along {
            ROTARY[rotary.letter]
        } else {
            Register::AXES[axis]
        };
        self.machine.written(register).is_some()
            && self.present(axis).is_some_and(|at| self.number_format().format(at) == self.length(target))
    }

    /// Writes a section on lines of its own.
    pub(super) fn lines_of(&mut self, section: Section) -> WriteResult {
        self.section(section)?;
        self.end_line();
        Ok(())
    }

    /// Whether a height is below the stock surface after rounding.
    pub(super) fn is_below_surface(&self, z: f64) -> bool {
        let format = self.number_format();
        format.round(self.scaled(z)) < format.round(self.scaled(self.operation().surface))
    }

    /// Converts the coordinate across a rotary axis to its angle.
    fn wrap(&mut self, to: [Option<f64>; 3]) -> WriteResult {
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

    /// Moves up to the clearance plane, unless the tool is there.
    pub(super) fn clearance(&mut self) -> WriteResult {
        let clearance = self.operation().clearance;
        if self.is_at(2, clearance) {
            return Ok(());
        }
        let to = [None, None, Some(clearance)];
        let is_down = self.present(2).is_some_and(|now| now > self.scaled(clearance));
        if is_down && !self.plan.definition.options.rapid_down {
            return self.feed(to, self.operation().plunge_feed);
        }
        self.go(Section::Rapid, to, MoveValues::default())
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
        self.check(to)
    }

    /// Moves to a position by way of the clearance plane, unless the tool is there.
    pub(super) fn check(&mut self, target: [Option<f64>; 3]) -> WriteResult {
        let is_there =
            target.iter().enumerate().all(|(axis, target)| target.is_none_or(|at| self.is_at(axis, at)));
        if is_there {
            return Ok(());
        }
        self.clearance()?;
        self.go(Section::Rapid, [target[0], target[1], None], MoveValues::default())?;
        match target[2] {
            Some(z) if self.is_below_surface(z) => {
                self.feed([None, None, Some(z)], self.operation().plunge_feed)
            }
            z => self.go(Section::Rapid, [None, None, z], MoveValues::default()),
        }
    }
}
