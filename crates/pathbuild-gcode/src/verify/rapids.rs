//! Finds rapid moves into material in every program that is about to be written. (book: program/reading)
//!
//! The cost is proportional to the number of moves: only rapid moves below a surface are examined, and accepted if the preceding cuts have cleared
//! their path. Otherwise a map of the material near them decides.

#[cfg(test)]
mod tests;

use std::cell::LazyCell;
use std::collections::VecDeque;
use std::f64::consts::TAU;
use std::sync::Arc;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::{Move, MoveShape, Pace, Position, Step};
use pathbuild_toolpath as toolpath;
use pathbuild_toolpath::{Comment, Count, ElementKind, Height, MoveClass, PlannedMove, ProgramStep, Xy};

use super::excursion::Excursions;
use super::height_map::RESIDUE_HEIGHT;
use super::machine::{Machine, MachineRules};
use super::material;
use super::material::{Stock, StockSpan, cutting_piece};
use crate::interpret::Program;
use crate::read::Problems;

/// Maximum number of preceding cuts examined for a rapid move. It covers the last turns of a helical circle and the end of a chain.
const MAX_EXAMINED_CUTS: usize = 64;

/// Number of suspect rapid moves above which all moves are examined.
const MAX_SUSPECTS: usize = 16;

/// Maximum number of cells visited for a rapid move.
const MAX_VISITED_CELLS: u64 = 1_000_000;

/// Returns the moves of a drawing's program that exceed the machine's capabilities, by step number.
pub fn beyond_machine(drawn: &toolpath::Program, machine: &Machine) -> Vec<Diagnostic> {
    let mut rules = MachineRules::new(machine);
    ProgramMoves(drawn).each(&mut |step| rules.step(step));
    rules.finish()
}

/// Returns the rapid moves into material in a drawing's program, and the cuts through material above their own surface, by step number.
pub fn rapids_into_material(drawn: &toolpath::Program) -> Vec<Diagnostic> {
    let stock = Stock::of(drawn);
    let suspects = suspects(drawn, &stock);
    if suspects.is_empty() {
        return Vec::new();
    }
    let places = (suspects.len() <= MAX_SUSPECTS).then(|| suspects.iter().map(sides).collect());
    let mut problems = Problems::default();
    material::check(&NearbyMoves { drawn, places, reach: 2.0 * stock.widest() }, &stock, &mut problems);
    problems.into_diagnostics()
}

/// Returns the rapid moves into material in programs that are milled one after the other, by the index of their program and its step number. Each
/// program alone must have none.
pub fn rapids_into_joined_material(programs: &[Arc<toolpath::Program>]) -> Vec<(usize, Diagnostic)> {
    let clearance = programs.iter().map(|program| program.sweep_height).fold(f64::NEG_INFINITY, f64::max);
    let mut joined = toolpath::Program { sweep_height: clearance, ..toolpath::Program::default() };
    let origin = Xy::origin();
    let mut starts = Vec::with_capacity(programs.len());
    for program in programs {
        let element = Comment::Element {
            kind: ElementKind::Sweep,
            at: origin,
            bottom: program.thickness,
            surface: program.thickness,
            cutter: program.tool,
            peck: None,
        };
        let lift = |z| PlannedMove::Lift { z: Height { z, at: origin } };
        let approach = [lift(clearance), PlannedMove::Sweep { to: origin }, lift(program.start_height())];
        let count = Count { class: MoveClass::Sweep, length: 0.0, feed: None };
        joined.steps.push(ProgramStep::Comment(element));
        joined.steps.extend(approach.map(|to| ProgramStep::Move { to, count }));
        starts.push(u32::try_from(joined.steps.len()).unwrap_or(u32::MAX));
        joined.steps.extend(&program.steps);
    }
    (joined.thickness, joined.tool) =
        programs.first().map_or((0.0, 0.0), |first| (first.thickness, first.tool));
    if Stock::of(&joined).is_level() {
        return Vec::new();
    }
    let located = rapids_into_material(&joined).into_iter().map(|mut problem| {
        let step = problem.place.line.unwrap_or_default();
        let program = starts.partition_point(|start| *start < step).saturating_sub(1);
        problem.place.line = Some(step.saturating_sub(starts[program]).max(1));
        (program, problem)
    });
    located.collect()
}

/// Returns the rapid moves whose path the preceding cuts may not have cleared, and the cuts near a higher surface than their own.
fn suspects(drawn: &toolpath::Program, stock: &Stock) -> Vec<Move> {
    let tops = LazyCell::new(|| CutGrid::of(drawn, stock));
    let mut recent: VecDeque<(u32, Move)> = VecDeque::with_capacity(MAX_EXAMINED_CUTS);
    let (mut excursions, mut found) = (Excursions::default(), Vec::new());
    let lowest = stock.lowest();
    for (line, movement) in drawn.moves() {
        let ended = excursions.step(line, &movement, lowest, |_| true);
        found.extend(ended.into_iter().flat_map(|excursion| excursion.moves));
        if movement.pace == Pace::Rapid {
            let has_room = || {
                let Some((piece, surface)) = stock_below_surface(line, &movement, stock, &tops) else {
                    return true;
                };
                is_in_circle(&movement, piece.cutter.diameter, &recent)
                    || material::have_cleared_path(
                        line,
                        &movement,
                        surface,
                        &recent,
                        stock,
                        MAX_VISITED_CELLS,
                    )
            };
            if !has_room() {
                found.push(movement);
            }
        } else {
            if let Some(piece) = cutting_piece(line, &movement, stock)
                && stock.highest().is_some_and(|highest| piece.surface < highest)
                && tops.highest_within(sides(&movement), piece.cutter.diameter / 2.0) > piece.surface
            {
                found.push(movement);
            }
            if recent.len() == MAX_EXAMINED_CUTS {
                recent.pop_front();
            }
            recent.push_back((line, movement));
        }
        if found.len() > MAX_SUSPECTS {
            break;
        }
    }
    found
}

/// Returns the stock at a rapid move and the highest surface along it; `None` if the move goes straight up or stays above that surface.
fn stock_below_surface<'s>(
    line: u32,
    movement: &Move,
    stock: &'s Stock,
    tops: &LazyCell<CutGrid, impl FnOnce() -> CutGrid>,
) -> Option<(&'s StockSpan, f64)> {
    let low = movement.from.z().min(movement.to.z()) + RESIDUE_HEIGHT;
    let goes_up = movement.keeps_xy() && movement.to.z() >= movement.from.z();
    if goes_up || stock.highest().is_none_or(|highest| low >= highest) {
        return None;
    }
    let piece = stock.at(line)?;
    let surface = tops.highest_along(movement, piece.cutter.diameter / 2.0);
    (low < surface).then_some((piece, surface))
}

/// Whether a rapid move stays inside the circle milled by the preceding cuts, in which no core is left. This is the case at the end of a helical
/// circle.
fn is_in_circle(movement: &Move, cutter: f64, recent: &VecDeque<(u32, Move)>) -> bool {
    let Some(MoveShape::Arc(last)) = recent.back().map(|(_, cut)| cut.shape) else { return false };
    let from_centre = |at: &Position| libm::hypot(at.x() - last.centre[0], at.y() - last.centre[1]);
    let radius = from_centre(&movement.from);
    let low = movement.from.z().min(movement.to.z()) + RESIDUE_HEIGHT;
    // The angle of a cut, if the cut is on the circle around the centre of the last arc through the start of the rapid move, and deep enough for that
    // move.
    let angle = |(_, cut): &(u32, Move)| match cut.shape {
        MoveShape::Arc(arc) => {
            let is_on_circle = [cut.from, cut.to].iter().all(|end| is_same(from_centre(end), radius));
            let is_round_centre = (0..2).all(|axis| is_same(arc.centre[axis], last.centre[axis]));
            let is_low = cut.from.z().max(cut.to.z()) <= low;
            (is_on_circle && is_round_centre && is_low).then(|| arc.sweep(&cut.from, &cut.to))
        }
        MoveShape::Line => None,
    };
    let turned: f64 = recent.iter().rev().map_while(angle).sum();
    turned >= TAU - TOLERANCE
        && radius <= cutter / 2.0 + TOLERANCE
        && from_centre(&movement.to) <= radius + TOLERANCE
}

/// Positions in mm and angles that differ by less than this are equal.
const TOLERANCE: f64 = 1e-6;

fn is_same(one: f64, other: f64) -> bool {
    libm::fabs(one - other) < TOLERANCE
}

/// The program of a drawing, which passes on its moves as steps.
struct ProgramMoves<'d>(&'d toolpath::Program);

impl Program for ProgramMoves<'_> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        self.0.moves().for_each(|(line, movement)| take(&Step::of_move(line, movement)));
    }
}

/// The sides of a box in the plane, as least and greatest coordinates in mm.
type Sides = [(f64, f64); 2];

/// The moves that affect the material near some positions.
struct NearbyMoves<'d> {
    drawn: &'d toolpath::Program,
    /// The boxes that contain the positions; `None` means everywhere.
    places: Option<Vec<Sides>>,
    /// Distance in mm within which a move affects a position: material is known within the cutter's diameter of a cut, and a passing cutter has a
    /// radius.
    reach: f64,
}

impl NearbyMoves<'_> {
    fn is_near(&self, movement: &Move) -> bool {
        let own = sides(movement).map(|(low, high)| (low - self.reach, high + self.reach));
        let meets =
            |place: &Sides| own.iter().zip(place).all(|(own, place)| own.0 <= place.1 && place.0 <= own.1);
        self.places.as_ref().is_none_or(|places| places.iter().any(meets))
    }
}

impl Program for NearbyMoves<'_> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        let near = self.drawn.moves().filter(|(_, movement)| self.is_near(movement));
        near.for_each(|(line, movement)| take(&Step::of_move(line, movement)));
    }
}

/// Returns the bounding box of a move in the plane; infinite along an axis without a known position, which no move of a drawing has.
fn sides(movement: &Move) -> Sides {
    let [across, up, _] = movement.extent();
    [across, up].map(|side| side.unwrap_or((f64::NEG_INFINITY, f64::INFINITY)))
}

const CELLS_PER_SIDE: usize = 64;

/// A grid over the cut area with the highest surface of the stock in each cell.
#[derive(Debug)]
pub(super) struct CutGrid {
    /// The corner with the least X and Y, in mm.
    corner: [f64; 2],
    /// The sides of a cell, in mm.
    cell: [f64; 2],
    /// The highest surface in each cell in mm, row by row; `-inf` where there is no material.
    heights: Vec<f64>,
}

impl CutGrid {
    pub(super) fn of(drawn: &toolpath::Program, stock: &Stock) -> Self {
        let cuts: Vec<Cut> = cuts(drawn, stock).collect();
        let mut sides = [(f64::INFINITY, f64::NEG_INFINITY); 2];
        for (ends, _) in &cuts {
            for (side, (low, high)) in sides.iter_mut().zip(ends) {
                *side = (side.0.min(*low), side.1.max(*high));
            }
        }
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let cell = sides.map(|(low, high)| ((high - low) / CELLS_PER_SIDE as f64).max(f64::MIN_POSITIVE));
        let corner = sides.map(|(low, _)| low);
        let mut tops =
            Self { corner, cell, heights: vec![f64::NEG_INFINITY; CELLS_PER_SIDE * CELLS_PER_SIDE] };
        for (ends, surface) in cuts {
            tops.raise(ends, surface);
        }
        tops
    }

    /// Returns the highest surface within `radius` mm of a straight move; `-inf` where there is no material.
    pub(super) fn highest_along(&self, movement: &Move, radius: f64) -> f64 {
        let [(from_x, to_x), (from_y, to_y)] =
            [0, 1].map(|axis| (movement.from.at[axis], movement.to.at[axis]));
        let rows = self.indices(1, (from_y.min(to_y) - radius, from_y.max(to_y) + radius));
        let mut highest = f64::NEG_INFINITY;
        for row in rows {
            #[expect(clippy::cast_precision_loss, reason = "a small number")]
            let low = self.corner[1] + row as f64 * self.cell[1];
            // The fractions of the move between which its Y is within the radius of this row.
            let share = |y: f64| if to_y == from_y { f64::NAN } else { (y - from_y) / (to_y - from_y) };
            let (one, other) = (share(low - radius), share(low + self.cell[1] + radius));
            let x = |share: f64| from_x + share * (to_x - from_x);
            let (one, other) = (x(one.min(other).max(0.0)), x(one.max(other).min(1.0)));
            for column in self.indices(0, (one.min(other) - radius, one.max(other) + radius)) {
                highest = highest.max(self.heights[row * CELLS_PER_SIDE + column]);
            }
        }
        highest
    }

    /// Returns the highest surface within `radius` mm of a box; `-inf` where there is no material.
    fn highest_within(&self, sides: Sides, radius: f64) -> f64 {
        let [across, up] = sides.map(|(low, high)| (low - radius, high + radius));
        let rows = self.indices(1, up);
        let cells = rows.flat_map(|row| {
            self.indices(0, across).map(move |column| self.heights[row * CELLS_PER_SIDE + column])
        });
        cells.fold(f64::NEG_INFINITY, f64::max)
    }

    fn raise(&mut self, [across, up]: [(f64, f64); 2], surface: f64) {
        for row in self.indices(1, up) {
            for column in self.indices(0, across) {
                let height = &mut self.heights[row * CELLS_PER_SIDE + column];
                *height = height.max(surface);
            }
        }
    }

    /// Returns the indices along an axis of the cells between two coordinates, inclusive; those outside the grid are omitted.
    fn indices(&self, axis: usize, (low, high): (f64, f64)) -> std::ops::Range<usize> {
        let index = |coordinate: f64| ((coordinate - self.corner[axis]) / self.cell[axis]).floor();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "negative ones become 0")]
        let (first, last) = (index(low) as usize, (index(high) + 1.0) as usize);
        first.min(CELLS_PER_SIDE)..last.min(CELLS_PER_SIDE)
    }
}

/// The bounding box in the plane of the material implied by a cut, with its surface.
type Cut = ([(f64, f64); 2], f64);

fn cuts(drawn: &toolpath::Program, stock: &Stock) -> impl Iterator<Item = Cut> {
    drawn.moves().filter_map(|(line, movement)| {
        let piece = cutting_piece(line, &movement, stock)?;
        let [Some((left, right)), Some((low, high)), _] = movement.extent() else { return None };
        let cutter = piece.cutter.diameter;
        Some(([(left - cutter, right + cutter), (low - cutter, high + cutter)], piece.surface))
    })
}
