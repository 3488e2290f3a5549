//! Rapid moves through material that is still there. (spec/90-gcode-import.md, "verify")

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Message, Point, Severity};

use super::height_map::{Capsule, HeightMap};
use super::pieces::{self, Piece};
use super::stock::{self, Stock};
use crate::interpret::{Axes, Move, Pace};
use crate::read::Problems;

/// Material that stands less than this above the tip, in mm, is rounding.
const RESIDUE: f64 = 0.002;

/// The most cells that are kept, and that are visited, cells that many moves visit counted as often. Where the stock's resolution gives
/// more, it is made coarser.
const MOST_KEPT: f64 = 16e6;
const MOST_VISITED: f64 = 1e9;

/// Cells across the cutter that it takes to tell anything at all.
const FEWEST_ACROSS: f64 = 4.0;

/// Runs the moves over the stock and reports rapid ones that meet material.
pub(super) fn check(moves: &[(u32, Move)], stock: &Stock, problems: &mut Problems) {
    let Some(mut bench) = Bench::new(moves, stock) else {
        return problems.add_at_line(
            &say::TOO_LARGE_TO_FOLLOW,
            moves.last().map_or(0, |(line, _)| *line),
            |mut diagnostic| {
                diagnostic.severity = Severity::Warning;
                diagnostic
            },
        );
    };
    for (line, it) in moves {
        bench.lay(*line, it);
    }
    for (line, it) in moves {
        if it.from.known.and(it.to.known) != Axes::ALL {
            continue;
        }
        match it.pace {
            Pace::Rapid => bench.pass(*line, it, problems),
            Pace::Feed(_) | Pace::Probe { .. } => bench.mill(*line, it),
        }
    }
}

/// The material on the machine, as far as it is known.
struct Bench<'s> {
    stock: &'s Stock,
    resolution: f64,
    map: HeightMap,
}

impl<'s> Bench<'s> {
    /// `None` if the program is too large for a map that tells anything.
    fn new(moves: &[(u32, Move)], stock: &'s Stock) -> Option<Self> {
        let area: f64 = moves.iter().map(|(line, it)| covered_area(*line, it, stock)).sum();
        let kept = area.min(box_area(moves, stock));
        let resolution =
            stock.resolution().max(libm::sqrt(area / MOST_VISITED)).max(libm::sqrt(kept / MOST_KEPT));
        let is_of_use = stock.narrowest().is_none_or(|cutter| resolution * FEWEST_ACROSS <= cutter);
        is_of_use.then(|| Self { stock, resolution, map: HeightMap::new(resolution) })
    }

    /// There is material within O of where a move cuts.
    fn lay(&mut self, line: u32, it: &Move) {
        let Some(piece) = cutting_piece(line, it, self.stock) else { return };
        for part in self.parts(it) {
            if part.lowest() < piece.surface {
                self.map.add(&capsule(&part, piece.cutter), piece.surface);
            }
        }
    }

    /// A cutting move takes away what it meets. Cells that it only touches count as cut, so that the grid is never the reason of a report.
    fn mill(&mut self, line: u32, it: &Move) {
        let Some(piece) = cutting_piece(line, it, self.stock) else { return };
        for part in self.parts(it) {
            self.map.cut(&capsule(&part, piece.cutter / 2.0 + self.slack()), part.lowest());
        }
    }

    /// A rapid move reports what it meets. Cells that it only touches do not count.
    fn pass(&mut self, line: u32, it: &Move, problems: &mut Problems) {
        let Some(piece) = self.stock.at(line) else { return };
        let is_above = self.stock.highest().is_none_or(|highest| it.from.z().min(it.to.z()) >= highest);
        let goes_up = it.from.at[..2] == it.to.at[..2] && it.to.z() >= it.from.z();
        if is_above || goes_up {
            return;
        }
        let is_plunge = it.from.at[..2] == it.to.at[..2];
        let met = self.parts(it).find_map(|part| {
            let z = if is_plunge { part.lowest() } else { part.highest() };
            let cutter = capsule(&part, piece.cutter / 2.0 - self.slack());
            self.map.highest_above(&cutter, z + RESIDUE).map(|(height, place)| (z, height, place))
        });
        if let Some((z, height, [x, y])) = met {
            let message: &'static Message =
                if is_plunge { &say::RAPID_PLUNGE } else { &say::RAPID_IN_MATERIAL };
            let resolution = self.resolution;
            problems.add_at_line(message, line, |diagnostic| {
                diagnostic
                    .with("z", z)
                    .with("height", height)
                    .with("point", Point::new(x, y))
                    .with("resolution", resolution)
                    .at_point(Point::new(x, y))
            });
        }
    }

    /// Half the diagonal of a cell, and how far chords leave their arc.
    fn slack(&self) -> f64 {
        self.resolution
    }

    fn parts(&self, it: &Move) -> impl Iterator<Item = Piece> + use<> {
        pieces::pieces(it, self.resolution / 4.0)
    }
}

fn capsule(part: &Piece, radius: f64) -> Capsule {
    let plane = |at: &[f64; 3]| [at[0], at[1]];
    Capsule { from: plane(&part.from), to: plane(&part.to), radius }
}

/// What holds where a move cuts; `None` where nothing is known or the move does not cut below the surface.
fn cutting_piece(line: u32, it: &Move, stock: &Stock) -> Option<stock::Piece> {
    let is_known = it.from.known.and(it.to.known) == Axes::ALL;
    let piece = stock.at(line).filter(|_| is_known && matches!(it.pace, Pace::Feed(_)))?;
    (it.from.z().min(it.to.z()) < piece.surface).then_some(*piece)
}

/// The area in mm² of the box round everything within O of cutting moves.
fn box_area(moves: &[(u32, Move)], stock: &Stock) -> f64 {
    let mut sides = [(f64::INFINITY, f64::NEG_INFINITY); 2];
    for (line, it) in moves {
        let Some(piece) = cutting_piece(*line, it, stock) else { continue };
        for (side, extent) in sides.iter_mut().zip(it.extent()) {
            let Some((low, high)) = extent else { continue };
            *side = (side.0.min(low - piece.cutter), side.1.max(high + piece.cutter));
        }
    }
    sides.iter().map(|(low, high)| (high - low).max(0.0)).product()
}

/// At most the area in mm² within O of a cutting move.
fn covered_area(line: u32, it: &Move, stock: &Stock) -> f64 {
    cutting_piece(line, it, stock)
        .map_or(0.0, |piece| 2.0 * piece.cutter * (it.length() + 2.0 * piece.cutter))
}
