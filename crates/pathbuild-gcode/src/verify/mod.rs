//! Checks whether a program is equal to another one, and whether it is safe to run. (book: program/reading)
//!
//! The words of a program are checked when it is interpreted in the dialect of the machine; the rules in this module check its effects.
//! They do not guess: unknown properties of stock and machine are not checked, because a false alarm that stops a good program is worse
//! than a missing warning.

mod against;
mod bent_rapids;
mod blind_rapids;
mod chip_load;
mod coarse_arcs;
mod compare;
mod corners;
mod cutting_length;
mod depth;
mod direction;
mod excursion;
mod frames;
mod height_map;
mod lengths;
mod machine;
mod material;
mod rapids;
mod rules;
mod stated_statistics;
mod tip_height;
mod tool_state;
mod words;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::Step;

pub use self::compare::same_move_lines;
pub use against::{Clamps, ComparisonResult, DrawingComparison, ExpectedProgram, ToolUse};
pub use bent_rapids::BentRapidRules;
pub use blind_rapids::{BlindRapidRules, BlindRapids};
pub use chip_load::ChipLoadRules;
pub use coarse_arcs::coarse_arc_finding;
pub use compare::{Difference, DifferenceKind, Ends, Tolerance, compare};
pub(crate) use compare::{is_near, is_same_move};
pub use corners::CornerRules;
pub use cutting_length::CuttingLengthRules;
pub use depth::DepthRules;
pub use direction::DirectionRules;
pub use lengths::LengthRules;
pub use machine::{Machine, MachineRules, Travel, text_beyond_machine};
pub use material::{Cutter, Stock, StockSpan, rapid_hits};
pub use rapids::{beyond_machine, rapids_into_joined_material, rapids_into_material};
pub use rules::Rules;
pub(crate) use rules::tool_to_insert;
pub use stated_statistics::StatedStatistics;
pub use tip_height::TipHeight;
pub use tool_state::{LengthFit, ToolState};
pub use words::{PostWords, ProgramStart, WordRules, foreign_modes};

use self::frames::Frames;
use crate::dialect::Dialect;
use crate::interpret::Program;
use crate::read::Problems;

/// A property of the tools of a program, each with the position in the order of execution from which the tool is in the spindle.
pub type ByTool<T> = Vec<(u32, T)>;

/// Returns the index of the tool that is in the spindle at a position in the order of execution; `None` before the first one.
fn tool_at<T>(tools: &[(u32, T)], order: u32) -> Option<usize> {
    tools.partition_point(|(from, _)| *from <= order).checked_sub(1)
}

/// Reports problems in the effects of a program, ordered by line. If the material is known, this includes rapid moves and tool changes in it. Each
/// step is also passed to `each`, so that the program need not be processed again for another purpose; only the map of the material requires further
/// passes.
pub fn verify(
    program: &(impl Program + ?Sized),
    dialect: Dialect,
    stock: Option<&Stock>,
    each: &mut dyn FnMut(&Step),
) -> Vec<Diagnostic> {
    let mut rules = Rules::new(stock).in_dialect(dialect);
    let mut frames = Frames::default();
    program.each(&mut |step| {
        rules.step(step);
        frames.step(step);
        each(step);
    });
    let mut found = rules.finish();
    if let Some(stock) = stock {
        let mut problems = Problems::default();
        frames.check(program, stock, &mut problems);
        found.append(&mut problems.into_diagnostics());
    }
    found.sort_by_key(|diagnostic| diagnostic.place.line);
    found
}
