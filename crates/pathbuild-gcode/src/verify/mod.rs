//! Whether a program is what it should be: the same as another, and safe to run. (spec/90-gcode-import.md, "verify")
//!
//! The words of a program are judged when it is interpreted in the dialect of the machine; the rules here judge what it does. None of
//! them guesses: what is not known of stock and machine is not checked, because a false alarm that stops a good program is worse
//! than a warning that is missing.

mod coarse;
mod compare;
mod height_map;
mod lines;
mod machine;
mod material;
mod pieces;
mod rules;
mod stock;
mod walk;

use pathbuild_diagnostic::Diagnostic;

pub use coarse::coarse_arcs;
pub use compare::{Difference, Ends, Kind, Tolerance, compare};
pub(crate) use compare::{is_near, is_same_move};
pub use lines::same_move_lines;
pub use machine::{Machine, Travel};
pub use stock::{Piece, Stock};

use crate::interpret::{Move, Step};
use crate::read::Problems;

/// What a program is checked against.
#[derive(Clone, Copy, Debug, Default)]
pub struct Checks<'c> {
    /// The material, where it is known: rapid moves into it, tool changes in it.
    pub stock: Option<&'c Stock>,
    /// The machine, where it is known: its travel, feeds and speeds.
    pub machine: Option<&'c Machine>,
}

/// What of a program a machine cannot do, by line.
pub fn verify_machine(steps: &[Step], machine: &Machine) -> Vec<Diagnostic> {
    let mut problems = Problems::default();
    machine::check(steps, machine, &mut problems);
    problems.into_diagnostics()
}

/// What is wrong with what a program does, by line.
pub fn verify(steps: &[Step], checks: &Checks<'_>) -> Vec<Diagnostic> {
    let mut problems = Problems::default();
    rules::check(steps, checks.stock, &mut problems);
    if let Some(machine) = checks.machine {
        machine::check(steps, machine, &mut problems);
    }
    if let Some(stock) = checks.stock {
        let moves: Vec<(u32, Move)> = steps.iter().filter_map(Step::as_move).collect();
        material::check(&moves, stock, &mut problems);
    }
    problems.into_diagnostics()
}
