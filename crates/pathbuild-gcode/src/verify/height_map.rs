//! A map of the heights of the material over the plane, where they are known.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

/// Height in mm above the tip up to which material is attributed to rounding.
pub(super) const RESIDUE_HEIGHT: f64 = 0.002;

/// Number of cells along the side of a tile.
const CELLS_PER_SIDE: i32 = 64;
const CELLS: usize = (CELLS_PER_SIDE * CELLS_PER_SIDE) as usize;

/// Cost of each row of a capsule, in cells, besides the cells that are visited in it. A capsule without material costs as much as one row.
const ROW_COST: u64 = 16;

/// A sparse grid of heights. Each cell has a single height.
#[derive(Debug)]
pub(super) struct HeightMap {
    /// Side of a cell in mm.
    resolution: f64,
    /// Tiles by row and column, with `NaN` where nothing is known.
    tiles: BTreeMap<(i32, i32), Box<[f32; CELLS]>>,
    /// Number of cells that may still be visited before the map is exhausted.
    remaining: u64,
}

/// The key of a tile, a row, and the first and last column of the row.
type TileRowSpan = ((i32, i32), i32, (i32, i32));

impl HeightMap {
    /// Creates a map on which at most `cells` cells may be visited, counting repeated visits. After that, nothing changes and
    /// nothing is found: see [`is_exhausted`](Self::is_exhausted).
    pub(super) fn new(resolution: f64, cells: u64) -> Self {
        Self { resolution, tiles: BTreeMap::new(), remaining: cells }
    }

    pub(super) fn is_exhausted(&self) -> bool {
        self.remaining == 0
    }

    /// Adds material up to `surface` within the capsule. Where material is already known, the lower of the two heights applies.
    pub(super) fn add(&mut self, capsule: &Capsule, surface: f64) {
        self.merge(capsule, surface, f32::min);
    }

    /// Like [`add`](Self::add), but the higher of the two heights applies.
    pub(super) fn raise(&mut self, capsule: &Capsule, surface: f64) {
        self.merge(capsule, surface, f32::max);
    }

    fn merge(&mut self, capsule: &Capsule, surface: f64, merged: fn(f32, f32) -> f32) {
        let surface = rounded(surface);
        let (first, last) = self.centres_within(capsule.rows());
        for row in first..=last {
            let Some((column, last)) = self.columns(capsule, row) else { continue };
            if !self.spend(column, last) {
                return;
            }
            for tile_column in column.div_euclid(CELLS_PER_SIDE)..=last.div_euclid(CELLS_PER_SIDE) {
                let key = (row.div_euclid(CELLS_PER_SIDE), tile_column);
                let tile = self.tiles.entry(key).or_insert_with(|| Box::new([f32::NAN; CELLS]));
                for height in &mut tile[cells(row, column, last, tile_column)] {
                    *height = if height.is_nan() { surface } else { merged(*height, surface) };
                }
            }
        }
    }

    /// Removes material within the capsule down to `z`.
    pub(super) fn cut(&mut self, capsule: &Capsule, z: f64) {
        let z = rounded(z);
        for (key, row, (column, last)) in self.stretches(capsule) {
            let Some(tile) = self.tiles.get_mut(&key) else { continue };
            for height in &mut tile[cells(row, column, last, key.1)] {
                if *height > z {
                    *height = z;
                }
            }
        }
    }

    /// Returns the height and the position of the highest material within the capsule that is above `z`.
    pub(super) fn highest_above(&mut self, capsule: &Capsule, z: f64) -> Option<(f64, [f64; 2])> {
        let mut highest = rounded(z);
        let mut place = None;
        for (key, row, (column, last)) in self.stretches(capsule) {
            let Some(tile) = self.tiles.get(&key) else { continue };
            for column in
                column.max(key.1 * CELLS_PER_SIDE)..=last.min(key.1 * CELLS_PER_SIDE + CELLS_PER_SIDE - 1)
            {
                let height = tile[cell(row, column)];
                if height > highest {
                    highest = height;
                    place = Some([column, row].map(|index| (f64::from(index) + 0.5) * self.resolution));
                }
            }
        }
        place.map(|place| (f64::from(highest), place))
    }

    /// Splits the rows of a capsule into stretches, one for each existing tile that a row may cross. A stretch is the tile's key, the row, and the
    /// capsule's columns in that row.
    ///
    /// The loop visits tiles, so that the cost of a long move depends on the known material and not on the length of the move.
    fn stretches(&mut self, capsule: &Capsule) -> Vec<TileRowSpan> {
        let (first, last) = self.centres_within(capsule.rows());
        let mut found = Vec::new();
        self.remaining = self.remaining.saturating_sub(ROW_COST);
        let mut row = first;
        while row <= last {
            let Some(((known, _), _)) = self.tiles.range((row.div_euclid(CELLS_PER_SIDE), i32::MIN)..).next()
            else {
                break;
            };
            let (begin, end) =
                (row.max(known * CELLS_PER_SIDE), last.min(known * CELLS_PER_SIDE + CELLS_PER_SIDE - 1));
            for row in begin..=end {
                if let Some((column, last)) = self.columns(capsule, row) {
                    self.stretches_of_row(row, column, last, &mut found);
                }
                if self.is_exhausted() {
                    return Vec::new();
                }
            }
            row = end.max(begin) + 1;
        }
        found
    }

    fn stretches_of_row(&mut self, row: i32, column: i32, last: i32, found: &mut Vec<TileRowSpan>) {
        let tile_row = row.div_euclid(CELLS_PER_SIDE);
        let tiles =
            (tile_row, column.div_euclid(CELLS_PER_SIDE))..=(tile_row, last.div_euclid(CELLS_PER_SIDE));
        let before = found.len();
        if column <= last {
            found.extend(self.tiles.range(tiles).map(|(key, _)| (*key, row, (column, last))));
        }
        let known = CELLS_PER_SIDE.saturating_mul(i32::try_from(found.len() - before).unwrap_or(i32::MAX));
        self.spend(0, (last - column).min(known));
    }

    /// Deducts a row and its cells between two columns from the limit on visited cells. Returns false if the limit is reached, so that the row must
    /// not be visited.
    fn spend(&mut self, column: i32, last: i32) -> bool {
        let cells = u64::try_from(i64::from(last) - i64::from(column)).unwrap_or(0);
        self.remaining = self.remaining.saturating_sub(ROW_COST + cells);
        !self.is_exhausted()
    }

    /// Returns the first and last column of a row with cell centres inside the capsule.
    fn columns(&self, capsule: &Capsule, row: i32) -> Option<(i32, i32)> {
        capsule.row((f64::from(row) + 0.5) * self.resolution).map(|ends| self.centres_within(ends))
    }

    /// Returns the first and last index of cells with centres between two coordinates. If the last is less than the first, there are no such cells.
    fn centres_within(&self, (low, high): (f64, f64)) -> (i32, i32) {
        let index = |coordinate: f64| coordinate / self.resolution - 0.5;
        (to_index(index(low).ceil()), to_index(index(high).floor()))
    }
}

/// Returns the indices, within a tile, of a row's cells from one column to another. Cells outside the tile are omitted.
fn cells(row: i32, column: i32, last: i32, tile_column: i32) -> std::ops::Range<usize> {
    let first = column.max(tile_column * CELLS_PER_SIDE);
    let last = last.min(tile_column * CELLS_PER_SIDE + CELLS_PER_SIDE - 1);
    if last < first { 0..0 } else { cell(row, first)..cell(row, last) + 1 }
}

fn cell(row: i32, column: i32) -> usize {
    let within = row.rem_euclid(CELLS_PER_SIDE) * CELLS_PER_SIDE + column.rem_euclid(CELLS_PER_SIDE);
    usize::try_from(within).unwrap_or(0)
}

/// Rounds to single precision: at 1000 mm, its steps are 0.06 micrometres.
fn rounded(height: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "less exact, as said")]
    let rounded = height as f32;
    rounded
}

/// Maximum absolute value of a cell's index, far enough from the limits of its type to prevent overflow.
const MAX_CELL_INDEX: f64 = 1e9;

/// Converts an index to an integer, clamping extreme values.
fn to_index(index: f64) -> i32 {
    #[expect(clippy::cast_possible_truncation, reason = "cut to the range")]
    let whole = index.clamp(-MAX_CELL_INDEX, MAX_CELL_INDEX) as i32;
    whole
}

/// The area covered by a cutter along a straight move: all points within a distance of a segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Capsule {
    from: [f64; 2],
    to: [f64; 2],
    radius: f64,
    /// Vector from the segment to one of the straight sides, in mm; NaN if the segment has no length.
    beside: [f64; 2],
}

impl Capsule {
    pub(super) fn new(from: [f64; 2], to: [f64; 2], radius: f64) -> Self {
        let [x, y] = [0, 1].map(|axis| to[axis] - from[axis]);
        let share = radius / libm::hypot(x, y);
        Self { from, to, radius, beside: [-y * share, x * share] }
    }

    /// Returns the least and greatest y of the capsule.
    fn rows(&self) -> (f64, f64) {
        if self.radius < 0.0 {
            return (0.0, -1.0);
        }
        (self.from[1].min(self.to[1]) - self.radius, self.from[1].max(self.to[1]) + self.radius)
    }

    /// Returns the least and greatest x of the capsule at this y; `None` if the capsule does not extend to this y.
    fn row(&self, y: f64) -> Option<(f64, f64)> {
        let ends = [self.from, self.to].into_iter().filter_map(|centre| disc_row(centre, self.radius, y));
        let sides = [1.0, -1.0].into_iter().filter_map(|side| {
            let share = (y - self.from[1] - side * self.beside[1]) / (self.to[1] - self.from[1]);
            let x = self.from[0] + side * self.beside[0] + share * (self.to[0] - self.from[0]);
            (0.0..=1.0).contains(&share).then_some((x, x))
        });
        ends.chain(sides).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }
}

fn disc_row(centre: [f64; 2], radius: f64, y: f64) -> Option<(f64, f64)> {
    let above = y - centre[1];
    let half = radius * radius - above * above;
    (half >= 0.0).then(|| libm::sqrt(half)).map(|half| (centre[0] - half, centre[0] + half))
}
