//! Positions texts so that they do not overlap and are not cut off.

use std::collections::BTreeSet;

use crate::scene::Point;

/// Occupied space of a picture as cells of a grid. The cost of an operation depends on the size of the text, not on the number of texts.
pub(super) struct Room {
    area: Rectangle,
    taken: BTreeSet<(i64, i64)>,
}

/// Width and height of a cell in px.
const CELL: f64 = 4.0;

/// Maximum distance at which a text is placed, in multiples of its height.
const FARTHEST: u32 = 6;

/// Number of candidate positions so near to a symbol that the label cannot be mistaken for another's.
const NEAREST: usize = 13;

/// A rectangle in px: left, top; right, bottom.
pub(super) type Rectangle = [Point; 2];

impl Room {
    /// Creates the free space of a picture.
    pub(super) fn new(area: Rectangle) -> Self {
        Self { area, taken: BTreeSet::new() }
    }

    /// Occupies a rectangle.
    pub(super) fn take(&mut self, rectangle: Rectangle) {
        self.taken.extend(cells(rectangle));
    }

    /// Occupies the first of the rectangles that is free, and returns its index.
    pub(super) fn find(&mut self, candidates: &[Rectangle]) -> Option<usize> {
        let found = candidates.iter().position(|rectangle| self.met(*rectangle) == 0)?;
        self.take(candidates[found]);
        Some(found)
    }

    /// Occupies the free rectangle of this size that is nearest to a point, and returns its centre.
    pub(super) fn find_near(&mut self, at: Point, [width, height]: Point) -> Option<Point> {
        let [low, high] = self.area;
        let inside = |axis: usize, value: f64, size: f64| {
            value.min(high[axis] - size / 2.0).max(low[axis] + size / 2.0)
        };
        let at = [inside(0, at[0], width), inside(1, at[1], height)];
        let middles: Vec<Point> =
            steps().map(|[across, down]| [at[0] + across * width / 2.0, at[1] + down * height]).collect();
        let rectangle =
            |[x, y]: &Point| [[x - width / 2.0, y - height / 2.0], [x + width / 2.0, y + height / 2.0]];
        self.find(&middles.iter().map(rectangle).collect::<Vec<_>>()).map(|found| middles[found])
    }

    /// Occupies space for a label beside a symbol, preferably at the given offset, and returns the start of its baseline. `None` if there
    /// is no room.
    pub(super) fn find_beside(
        &mut self,
        at: Point,
        preferred: Point,
        size: f64,
        text: &str,
    ) -> Option<Point> {
        let (starts, candidates) = beside(at, preferred, size, text);
        self.find(&candidates[..NEAREST]).map(|found| starts[found])
    }

    /// Like [`find_beside`](Self::find_beside), but also farther away. Without any room, the label is placed where it overlaps least.
    pub(super) fn beside(&mut self, at: Point, preferred: Point, size: f64, text: &str) -> Point {
        let (starts, candidates) = beside(at, preferred, size, text);
        let least = || (0..candidates.len()).min_by_key(|number| self.met(candidates[*number]));
        let least = least().unwrap_or_default();
        self.take(candidates[least]);
        starts[least]
    }

    /// Number of occupied cells in a rectangle. Outside of the picture, all are occupied.
    fn met(&self, rectangle: Rectangle) -> usize {
        let [[left, top], [right, bottom]] = rectangle;
        let [[leftmost, topmost], [rightmost, lowest]] = self.area;
        let is_outside = left < leftmost || top < topmost || right > rightmost || bottom > lowest;
        let taken = cells(rectangle).filter(|cell| self.taken.contains(cell)).count();
        if is_outside { taken + OUTSIDE } else { taken }
    }
}

/// Offsets in rows and columns, nearest first.
fn steps() -> impl Iterator<Item = Point> {
    let rows = (0..=FARTHEST).flat_map(|row| [f64::from(row), -f64::from(row)]);
    let mut steps: Vec<Point> =
        rows.flat_map(|row| [0.0, 1.0, -1.0, 2.0, -2.0].map(|across| [across, row])).collect();
    steps.sort_by(|a, b| libm::hypot(a[0] * 2.0, a[1]).total_cmp(&libm::hypot(b[0] * 2.0, b[1])));
    steps.into_iter()
}

/// Candidate start points and rectangles for a label beside a symbol.
fn beside([x, y]: Point, preferred: Point, size: f64, text: &str) -> (Vec<Point>, Vec<Rectangle>) {
    let width = width(text, size);
    let (near, row) = (8.0, size + 2.5);
    let mut offsets = vec![preferred, [-near, near + row * 0.75], [-near, -near - 3.0]];
    offsets.extend([[near + 2.0, size * 0.35], [-near - 2.0 - width, size * 0.35]]);
    for rows in [0.0, 1.0, 2.0, 3.0] {
        let (below, above) = (near + row * (0.75 + rows), -near - row * rows);
        offsets.extend([-near, near - width].into_iter().flat_map(|left| [[left, below], [left, above]]));
    }
    let starts: Vec<Point> = offsets.iter().map(|[right, down]| [x + right, y + down]).collect();
    let taken = |[left, base]: &Point| [[*left, base - 0.8 * size], [left + width, base + 0.2 * size]];
    let candidates = starts.iter().map(taken).collect();
    (starts, candidates)
}

/// Larger than the number of cells of any text.
const OUTSIDE: usize = 1 << 20;

/// Approximate width of a text in px.
pub(super) fn width(text: &str, size: f64) -> f64 {
    0.62 * size * text.chars().count() as f64
}

/// The square around a point with this half width in px.
pub(super) fn around([x, y]: Point, half: f64) -> Rectangle {
    [[x - half, y - half], [x + half, y + half]]
}

#[expect(clippy::cast_possible_truncation, reason = "px of a page")]
fn cells([low, high]: Rectangle) -> impl Iterator<Item = (i64, i64)> {
    let cell = |at: f64| (at / CELL).floor() as i64;
    let (columns, rows) = (cell(low[0])..=cell(high[0]), cell(low[1])..=cell(high[1]));
    columns.flat_map(move |column| rows.clone().map(move |row| (column, row)))
}
