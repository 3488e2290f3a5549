//! An upper bound of the height of the material near a position, on a coarse grid.
//!
//! It is never lower than the detailed map of the material, and very fast, because most rapid moves pass above it.

#[cfg(test)]
mod tests;

use pathbuild_motion::Move;
use pathbuild_toolpath::Program;

use super::material::cutting_piece;
use super::stock::Stock;

/// Number of cells along a side.
const SIDE: usize = 64;

/// A grid over everything that is cut.
#[derive(Debug)]
pub(super) struct Tops {
    /// The corner with the least X and Y, in mm.
    corner: [f64; 2],
    /// The sides of a cell, in mm.
    cell: [f64; 2],
    /// By row, then column: the highest surface in mm; `-inf` where there is no material.
    heights: Vec<f64>,
}

impl Tops {
    /// Creates the grid for the program of a drawing.
    pub(super) fn of(drawn: &Program, stock: &Stock) -> Self {
        let cuts: Vec<Cut> = cuts(drawn, stock).collect();
        let mut sides = [(f64::INFINITY, f64::NEG_INFINITY); 2];
        for (ends, _) in &cuts {
            for (side, (low, high)) in sides.iter_mut().zip(ends) {
                *side = (side.0.min(*low), side.1.max(*high));
            }
        }
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let cell = sides.map(|(low, high)| ((high - low) / SIDE as f64).max(f64::MIN_POSITIVE));
        let corner = sides.map(|(low, _)| low);
        let mut tops = Self { corner, cell, heights: vec![f64::NEG_INFINITY; SIDE * SIDE] };
        for (ends, surface) in cuts {
            tops.raise(ends, surface);
        }
        tops
    }

    /// The highest surface within `radius` mm of a straight move.
    pub(super) fn along(&self, it: &Move, radius: f64) -> f64 {
        let [(from_x, to_x), (from_y, to_y)] = [0, 1].map(|axis| (it.from.at[axis], it.to.at[axis]));
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
                highest = highest.max(self.heights[row * SIDE + column]);
            }
        }
        highest
    }

    fn raise(&mut self, [across, up]: [(f64, f64); 2], surface: f64) {
        for row in self.indices(1, up) {
            for column in self.indices(0, across) {
                let height = &mut self.heights[row * SIDE + column];
                *height = height.max(surface);
            }
        }
    }

    /// The cells between two coordinates, inclusive; those outside the grid are omitted.
    fn indices(&self, axis: usize, (low, high): (f64, f64)) -> std::ops::Range<usize> {
        let index = |coordinate: f64| ((coordinate - self.corner[axis]) / self.cell[axis]).floor();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "negative ones become 0")]
        let (first, last) = (index(low) as usize, (index(high) + 1.0) as usize);
        first.min(SIDE)..last.min(SIDE)
    }
}

/// The bounding box in the plane of the material implied by a cut, with its surface.
type Cut = ([(f64, f64); 2], f64);

fn cuts(drawn: &Program, stock: &Stock) -> impl Iterator<Item = Cut> {
    drawn.moves().filter_map(|(line, it)| {
        let piece = cutting_piece(line, &it, stock)?;
        let [Some((left, right)), Some((low, high)), _] = it.extent() else { return None };
        let cutter = piece.cutter;
        Some(([(left - cutter, right + cutter), (low - cutter, high + cutter)], piece.surface))
    })
}
