//! Limits how much a post may write, so that macros that multiply text come to an end.

use super::plan::Plan;
use crate::arcs::chords;
use crate::holes;
use crate::job::Operation;
use crate::step::Step;

/// Number of bytes allowed regardless of the program; each move adds more.
const FUEL: usize = 1 << 20;
const FUEL_PER_MOVE: usize = 1 << 12;

/// Number of bytes that a program may produce; each macro costs one more.
pub(super) fn fuel(plan: &Plan<'_>) -> usize {
    let moves = |operation: &Operation| -> usize {
        let of_steps: usize = operation.steps.iter().map(|step| moves_of(step, plan)).sum();
        of_steps + 1
    };
    let moves: usize = plan.job.operations.iter().map(moves).sum();
    FUEL + FUEL_PER_MOVE.saturating_mul(moves)
}

/// Maximum number of moves that a step can become.
fn moves_of(step: &Step, plan: &Plan<'_>) -> usize {
    match step {
        Step::Move(movement) => {
            let count = movement.course().and_then(|course| chords(&course, plan.arc_tolerance()));
            count.map_or(1, |count| count as usize)
        }
        Step::Hole(hole) => holes::moves(hole).map_or(1, |moves| moves.len()),
        _ => 1,
    }
}
