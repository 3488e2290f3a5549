//! Rapid moves into material, looked for in every program that is about to be written. (book: program/reading)
//!
//! What it costs grows with the moves: only a rapid move below a surface is looked at, and is fine where the last cuts before it have made
//! room. Where they have not, a map of the material near them decides.

use std::cell::LazyCell;
use std::collections::VecDeque;
use std::f64::consts::TAU;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::{Move, Pace, Path, Position, Step};
use pathbuild_toolpath::Program as Drawn;

use super::machine::{Machine, MachineRules};
use super::material;
use super::stock::{Stock, StockSpan};
use super::tops::Tops;
use crate::interpret::{Program, each_move_of};
use crate::read::Problems;

/// So many cuts at most are looked at for a rapid move: the last turns of a helical circle, the end of a chain.
const MOST_CUTS: usize = 64;

/// Where more rapid moves than that are in doubt, all moves are looked at.
const MOST_SUSPECTS: usize = 16;

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
    let suspects = suspects(drawn, &stock);
    if suspects.is_empty() {
        return Vec::new();
    }
    let places = (suspects.len() <= MOST_SUSPECTS).then(|| suspects.iter().map(sides).collect());
    let mut problems = Problems::default();
    material::check(&Near { drawn, places, reach: 2.0 * stock.widest() }, &stock, &mut problems);
    problems.into_diagnostics()
}

/// The rapid moves for which the last cuts before them have not made room.
fn suspects(drawn: &Drawn, stock: &Stock) -> Vec<Move> {
    let tops = LazyCell::new(|| Tops::of(drawn, stock));
    let mut recent: VecDeque<(u32, Move)> = VecDeque::with_capacity(MOST_CUTS);
    let (mut before, mut found) = (None, Vec::new());
    for (line, it) in each_move_of(drawn) {
        let last = before.replace((line, it));
        if it.pace == Pace::Rapid {
            let is_dip = last.is_some_and(|(line, down)| is_dip(line, &down, &it, stock));
            let has_room = || {
                let Some((piece, surface)) = low_at(line, &it, stock, &tops) else { return true };
                is_in_circle(&it, piece.cutter, &recent)
                    || material::has_room(line, &it, surface, &recent, stock, MOST_CELLS)
            };
            if is_dip || !has_room() {
                found.push(it);
            }
            if found.len() > MOST_SUSPECTS {
                break;
            }
        } else {
            if recent.len() == MOST_CUTS {
                recent.pop_front();
            }
            recent.push_back((line, it));
        }
    }
    found
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
        each_move_of(self.0).for_each(|(line, it)| take(&Step::of_move(line, it)));
    }
}

/// The sides of a box in the plane, as lowest and highest coordinates in mm.
type Sides = [(f64, f64); 2];

/// The moves that have to do with the material at some places; nobody knows of another one whether it meets any.
struct Near<'d> {
    drawn: &'d Drawn,
    /// `None`: anywhere.
    places: Option<Vec<Sides>>,
    /// So far beside its way, in mm, a move has to do with places: material is known within O of a cut, and what passes has a radius.
    reach: f64,
}

impl Near<'_> {
    fn is_near(&self, it: &Move) -> bool {
        let own = sides(it).map(|(low, high)| (low - self.reach, high + self.reach));
        let meets =
            |place: &Sides| own.iter().zip(place).all(|(own, place)| own.0 <= place.1 && place.0 <= own.1);
        self.places.as_ref().is_none_or(|places| places.iter().any(meets))
    }
}

impl Program for Near<'_> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        let near = each_move_of(self.drawn).filter(|(_, it)| self.is_near(it));
        near.for_each(|(line, it)| take(&Step::of_move(line, it)));
    }
}

/// The moves of a drawing are known in all axes.
fn sides(it: &Move) -> Sides {
    let [across, up, _] = it.extent();
    [across, up].map(|side| side.unwrap_or((f64::NEG_INFINITY, f64::INFINITY)))
}
