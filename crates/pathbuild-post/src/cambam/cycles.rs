//! Canned drilling cycles.

use std::mem::discriminant;

use pathbuild_diagnostic::{Diagnostic, Point, messages::posts};
use pathbuild_path::approx::{at_least, near};

use super::move_values::MoveValues;
use super::registers::Register;
use super::section::Section;
use super::writer::{WriteResult, Writer};
use crate::step::{Hole, HoleKind, Step};

/// What a control keeps of a cycle only until its end: the next one states it again.
const FORGOTTEN: [Register; 6] =
    [Register::X, Register::Y, Register::Z, Register::R, Register::P, Register::Q];

impl<'a> Writer<'a> {
    /// Writes the holes at the beginning of some steps as one group and returns the remaining steps.
    pub(super) fn cycles(&mut self, steps: &'a [Step]) -> Result<&'a [Step], Box<Diagnostic>> {
        let (group, rest) = steps.split_at(group_length(steps));
        let holes = || group.iter().filter_map(as_hole);
        let Some(first) = holes().next() else { return Ok(rest) };
        self.go(Section::Rapid, [None, None, Some(first.level)], MoveValues::default())?;
        self.go(Section::Rapid, [Some(first.at[0]), Some(first.at[1]), None], MoveValues::default())?;
        self.lines_of(Section::CannedCycleStart)?;
        self.machine.forget(&FORGOTTEN);
        for step in group {
            match as_hole(step) {
                Some(hole) => self.cycle(hole)?,
                None => self.step(step)?,
            }
        }
        self.lines_of(Section::CannedCycleEnd)?;
        let exit = holes().next_back().map(|hole| hole.exit);
        self.go(Section::Rapid, [None, None, exit], MoveValues::default())?;
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
            self.lines_of(Section::StartCut)?;
        }
        let to = [Some(hole.at[0]), Some(hole.at[1]), Some(hole.bottom)];
        self.set_move(to, self.cycle_values(hole))?;
        self.empty_code = None;
        self.lines_of(section)?;
        self.check_drilled(hole, section)?;
        if is_below {
            self.lines_of(Section::EndCut)?;
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

    /// Checks that a hole does not vanish because its section or the word of its cycle is empty.
    fn check_drilled(&self, hole: &Hole, section: Section) -> WriteResult {
        let is_blank = self.plan.definition.section(section).is_blank();
        let Some(empty) = is_blank.then_some(section).or(self.empty_code) else { return Ok(()) };
        let diagnostic =
            Diagnostic::new(&posts::DRILLING_LOST).with("place", Point::new(hole.at[0], hole.at[1]));
        Err(Box::new(self.plan.locate(diagnostic, empty, 0)))
    }
}

/// Whether a hole can be written as a canned cycle, which ends at the height where it started.
pub(super) fn can_be_canned(hole: &Hole) -> bool {
    at_least(hole.exit, hole.level)
}

/// Number of steps in the group: holes between which the tool stays at the same level, and comments among them.
fn group_length(steps: &[Step]) -> usize {
    let mut length = 0;
    let mut last: Option<&Hole> = None;
    // Different kinds of cycles are different groups, because a control forgets R when the word of the cycle changes.
    let continues = |last: &Hole, hole: &Hole| {
        near(last.exit, hole.level) && discriminant(&last.kind) == discriminant(&hole.kind)
    };
    for (index, step) in steps.iter().enumerate() {
        match step {
            Step::Hole(hole) if can_be_canned(hole) && last.is_none_or(|last| continues(last, hole)) => {
                last = Some(hole);
                length = index + 1;
            }
            Step::Comment(_) => {}
            _ => break,
        }
    }
    length
}

fn as_hole(step: &Step) -> Option<&Hole> {
    match step {
        Step::Hole(hole) => Some(hole),
        _ => None,
    }
}
