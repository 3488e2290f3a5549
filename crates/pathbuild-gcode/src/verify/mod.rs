//! Whether a program is what it should be: the same as another, and safe to run. (book: program/reading)
//!
//! The words of a program are judged when it is interpreted in the dialect of the machine; the rules here judge what it does. None of
//! them guesses: what is not known of stock and machine is not checked, because a false alarm that stops a good program is worse
//! than a warning that is missing.

mod against;
mod coarse;
mod compare;
mod height_map;
mod lines;
mod machine;
mod material;
mod pieces;
mod rapids;
mod rules;
mod stated;
mod stock;
mod tops;
mod walk;
mod words;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::Step;

pub use against::{Against, Clamps, Drawn, PastClamps, ToolUse};
pub use coarse::coarse_arcs;
pub use compare::{Difference, DifferenceKind, Ends, Tolerance, compare};
pub(crate) use compare::{is_near, is_same_move};
pub use lines::same_move_lines;
pub use machine::{Machine, MachineRules, Travel};
pub use rapids::{beyond_machine, rapids_into_material};
pub use rules::Rules;
pub use stated::StatedStatistics;
pub use stock::{Stock, StockSpan};
pub use words::{PostWords, WordRules};

use crate::interpret::Program;
use crate::read::Problems;

/// What a program is checked against.
#[derive(Clone, Copy, Debug, Default)]
pub struct Checks<'c> {
    /// The material, where it is known: rapid moves into it, tool changes in it.
    pub stock: Option<&'c Stock>,
    /// The machine, where it is known: its travel, feeds and speeds.
    pub machine: Option<&'c Machine>,
}

/// What is wrong with what a program does, by line.
pub fn verify(program: &(impl Program + ?Sized), checks: &Checks<'_>) -> Vec<Diagnostic> {
    verify_with(program, checks, &mut |_| {})
}

/// The same; each step goes to somebody else too, so that the program is not gone through once more for that. Only for the map of the
/// material it is gone through again.
pub fn verify_with(
    program: &(impl Program + ?Sized),
    checks: &Checks<'_>,
    each: &mut dyn FnMut(&Step),
) -> Vec<Diagnostic> {
    let mut rules = Rules::new(checks);
    program.each(&mut |step| {
        rules.step(step);
        each(step);
    });
    let mut found = rules.finish();
    if let Some(stock) = checks.stock {
        let mut problems = Problems::default();
        material::check(program, stock, &mut problems);
        found.append(&mut problems.into_diagnostics());
    }
    found.sort_by_key(|diagnostic| diagnostic.place.line);
    found
}
