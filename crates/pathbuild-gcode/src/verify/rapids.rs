//! Rapid moves into material, looked for in every program that is about to be written. (spec/90-gcode-import.md, "verify")
//!
//! What it costs grows with the moves: only a rapid move below a surface is looked at, and is fine where the cuts straight before it have
//! made room. Where they have not, the map of the whole material decides.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_toolpath::Program as Drawn;

use super::material;
use super::stock::Stock;
use crate::interpret::{Action, Move, Pace, Program, Step, each_move_of};
use crate::read::Problems;

/// So many cuts at most are looked at for a rapid move.
const MOST_CUTS: usize = 256;

/// So many cells at most are visited for a rapid move.
const MOST_CELLS: u64 = 1_000_000;

/// The rapid moves of a drawing's program that go into material, by the number of its step.
pub fn rapids_into_material(drawn: &Drawn) -> Vec<Diagnostic> {
    let stock = Stock::of(drawn);
    if all_have_room(drawn, &stock) {
        return Vec::new();
    }
    let mut problems = Problems::default();
    material::check(&Moves(drawn), &stock, &mut problems);
    problems.into_diagnostics()
}

fn all_have_room(drawn: &Drawn, stock: &Stock) -> bool {
    let mut recent: Vec<(u32, Move)> = Vec::new();
    for (line, it) in each_move_of(drawn) {
        match it.pace {
            Pace::Rapid if !is_low(line, &it, stock) => {
                if stock.highest().is_none_or(|highest| it.to.z() >= highest) {
                    recent.clear();
                }
            }
            Pace::Rapid => {
                if recent.len() > MOST_CUTS || !material::has_room(line, &it, &recent, stock, MOST_CELLS) {
                    return false;
                }
            }
            Pace::Feed(_) | Pace::Probe { .. } if recent.len() <= MOST_CUTS => recent.push((line, it)),
            Pace::Feed(_) | Pace::Probe { .. } => {}
        }
    }
    true
}

/// Whether a rapid move may meet material: in the plane below the highest surface, or down below its own path's.
fn is_low(line: u32, it: &Move, stock: &Stock) -> bool {
    let stays = it.from.at[..2] == it.to.at[..2];
    if stays && it.to.z() >= it.from.z() {
        return false;
    }
    let surface = if stays { stock.at(line).map(|piece| piece.surface) } else { stock.highest() };
    surface.is_some_and(|surface| it.from.z().min(it.to.z()) < surface - material::RESIDUE)
}

/// A drawing's program as steps.
struct Moves<'d>(&'d Drawn);

impl Program for Moves<'_> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        each_move_of(self.0).for_each(|(line, it)| take(&Step { line, action: Action::Move(it) }));
    }
}
