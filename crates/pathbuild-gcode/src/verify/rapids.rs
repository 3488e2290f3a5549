//! Rapid moves into material, looked for in every program that is about to be written. (book: program/reading)
//!
//! What it costs grows with the moves: only a rapid move below a surface is looked at, and is fine where the last cuts before it have made
//! room. Where they have not, the map of the whole material decides.

use std::cell::LazyCell;
use std::collections::VecDeque;
use std::f64::consts::TAU;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_toolpath::Program as Drawn;

use super::machine::{Machine, MachineRules};
use super::material;
use super::stock::{Stock, StockSpan};
use super::tops::Tops;
use crate::interpret::{Action, Move, Pace, Path, Position, Program, Step, each_move_of};
use crate::read::Problems;

/// So many cuts at most are looked at for a rapid move: the last turns of a helical circle, the end of a chain.
const MOST_CUTS: usize = 64;

/// So many cells at most are visited for a rapid move.
const MOST_CELLS: u64 = 1_000_000;

/// What of a drawing's program a machine cannot do, by the number of its step.
pub fn beyond_machine(drawn: &Drawn, machine: &Machine) -> Vec<Diagnostic> {
    let mut rules = MachineRules::new(machine);
    Moves(drawn).each(&mut |step| rules.step(step));
    rules.finish()
}

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
    let tops = LazyCell::new(|| Tops::of(drawn, stock));
    let mut recent: VecDeque<(u32, Move)> = VecDeque::with_capacity(MOST_CUTS);
    let mut before = None;
    for (line, it) in each_move_of(drawn) {
        let last = before.replace((line, it));
        if it.pace == Pace::Rapid {
            if last.is_some_and(|(line, down)| is_dip(line, &down, &it, stock)) {
                return false;
            }
            let Some((piece, surface)) = low_at(line, &it, stock, &tops) else { continue };
            let is_in_circle = is_in_circle(&it, piece.cutter, &recent);
            if !is_in_circle && !material::has_room(line, &it, surface, &recent, stock, MOST_CELLS) {
                return false;
            }
        } else {
            if recent.len() == MOST_CUTS {
                recent.pop_front();
            }
            recent.push_back((line, it));
        }
    }
    true
}

/// What holds for a rapid move that goes below a surface near its way, with the highest of these.
fn low_at<'s>(
    line: u32,
    it: &Move,
    stock: &'s Stock,
    tops: &LazyCell<Tops, impl FnOnce() -> Tops>,
) -> Option<(&'s StockSpan, f64)> {
    let low = it.from.z().min(it.to.z()) + material::RESIDUE;
    let goes_up = stays(it) && it.to.z() >= it.from.z();
    if goes_up || stock.highest().is_none_or(|highest| low >= highest) {
        return None;
    }
    let piece = stock.at(line)?;
    let surface = tops.along(it, piece.cutter / 2.0);
    (low < surface).then_some((piece, surface))
}

/// Whether a rapid move stays inside the circle that the cuts before it have gone all round, and no core stands in that: the end of a
/// helical circle.
fn is_in_circle(it: &Move, cutter: f64, recent: &VecDeque<(u32, Move)>) -> bool {
    let Some(Path::Arc(last)) = recent.back().map(|(_, cut)| cut.path) else { return false };
    let from_centre = |at: &Position| libm::hypot(at.x() - last.centre[0], at.y() - last.centre[1]);
    let radius = from_centre(&it.from);
    let low = it.from.z().min(it.to.z()) + material::RESIDUE;
    // The angle of a cut on that circle, low enough to make room.
    let angle = |(_, cut): &(u32, Move)| match cut.path {
        Path::Arc(arc) => {
            let is_on_circle = [cut.from, cut.to].iter().all(|end| is_same(from_centre(end), radius));
            let is_round_centre = (0..2).all(|axis| is_same(arc.centre[axis], last.centre[axis]));
            let is_low = cut.from.z().max(cut.to.z()) <= low;
            (is_on_circle && is_round_centre && is_low).then(|| arc.sweep(&cut.from, &cut.to))
        }
        Path::Line => None,
    };
    let turned: f64 = recent.iter().rev().map_while(angle).sum();
    turned >= TAU - EXACT && radius <= cutter / 2.0 + EXACT && from_centre(&it.to) <= radius + EXACT
}

/// Places in mm and angles that differ by less are one.
const EXACT: f64 = 1e-6;

fn is_same(one: f64, other: f64) -> bool {
    libm::fabs(one - other) < EXACT
}

/// Whether two rapid moves after each other go below the surface and up again.
fn is_dip(line: u32, down: &Move, up: &Move, stock: &Stock) -> bool {
    let is_down = down.pace == Pace::Rapid && stays(down) && down.to.z() < down.from.z();
    let is_below = || stock.at(line).is_some_and(|piece| down.to.z() < piece.surface - material::RESIDUE);
    is_down && stays(up) && up.to.z() > up.from.z() && is_below()
}

fn stays(it: &Move) -> bool {
    it.from.at[..2] == it.to.at[..2]
}

/// A drawing's program as steps.
struct Moves<'d>(&'d Drawn);

impl Program for Moves<'_> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        each_move_of(self.0).for_each(|(line, it)| take(&Step { line, action: Action::Move(it) }));
    }
}
