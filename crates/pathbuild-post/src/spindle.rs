//! Checks that a parsed text turns the spindle wherever the job cuts, and in the required direction.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{gcode, posts};
use pathbuild_motion::{Action, Move, Pace, Step, Turning};

use super::job::{Job, Operation};

/// Finds the first cut before which the spindle was not switched on, or turns in the wrong direction. Jobs that leave the spindle to the
/// operator in some operation are not checked.
pub(super) fn check(steps: &[Step], job: &Job, is_flat: bool) -> Option<Diagnostic> {
    let cutting = || job.operations.iter().filter(|operation| operation.cuts());
    let turning = |operation: &Operation| operation.spindle.filter(|turning| turning.is_on());
    let mut expected: Vec<Turning> = cutting().map(turning).collect::<Option<_>>()?;
    expected.dedup();
    // A move at feed above the material is not a cut.
    let surface = cutting().map(|operation| operation.surface).reduce(f64::max);
    let surface = surface.filter(|_| !job.has_no_surface && !is_flat).unwrap_or(f64::INFINITY);
    let (mut now, mut index) = (Turning::Unstated, 0);
    for step in steps {
        match &step.action {
            Action::Spindle(spindle) => now = spindle.turning,
            Action::Move(movement) if is_cut(movement, surface) => {
                let wanted = *expected.get(index)?;
                if now == wanted {
                    continue;
                }
                if expected.get(index + 1) == Some(&now) {
                    index += 1;
                    continue;
                }
                let message = match now {
                    Turning::Unstated => &posts::SPINDLE_NOT_STARTED,
                    // Reported by the rules of `verify`.
                    Turning::Off => return None,
                    Turning::Clockwise | Turning::CounterClockwise => &posts::SPINDLE_OTHER_WAY,
                };
                return Some(Diagnostic::new(message).at_line(step.line, None));
            }
            _ => {}
        }
    }
    None
}

/// Finds the first rapid during which the beam, which is controlled by the spindle words, may be on.
pub(super) fn check_beam(steps: &[Step]) -> Option<Diagnostic> {
    let mut is_on = false;
    for step in steps {
        match &step.action {
            Action::Spindle(spindle) => {
                is_on = spindle.turning.is_on();
            }
            Action::Move(movement) if is_on && movement.pace == Pace::Rapid && !movement.is_nothing() => {
                return Some(Diagnostic::new(&posts::BEAM_ON).at_line(step.line, None));
            }
            _ => {}
        }
    }
    None
}

/// Whether the spindle is ever switched on.
pub(super) fn is_started(steps: &[Step]) -> bool {
    steps.iter().any(|step| match step.action {
        Action::Spindle(spindle) => spindle.turning.is_on(),
        _ => false,
    })
}

/// Whether a rule of `verify` concerns the spindle.
pub(super) fn is_rule_of_spindle(problem: &Diagnostic) -> bool {
    [&gcode::SPINDLE_OFF, &gcode::SPINDLE_WITHOUT_SPEED, &gcode::SPINDLE_LEFT_ON].contains(&problem.message)
}

fn is_cut(movement: &Move, surface: f64) -> bool {
    matches!(movement.pace, Pace::Feed(_))
        && !movement.is_nothing()
        && movement.from.z().min(movement.to.z()) < surface
}
