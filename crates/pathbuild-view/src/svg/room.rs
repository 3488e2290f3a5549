//! Where texts stand, so that none is printed over another or cut off.

use std::collections::BTreeSet;

use crate::scene::Point;

/// What is taken of a picture: cells of a grid. Taking and asking cost as much as the text is large, however many there are.
pub(super) struct Room {
    area: Rectangle,
    taken: BTreeSet<(i64, i64)>,
}

/// Width and height of a cell in px.
const CELL: f64 = 4.0;

/// A text is looked for a place at most so many of its heights away.
const FARTHEST: u32 = 6;

/// So many places beside a symbol are so near that the label is not taken for that of another.
const NEAREST: usize = 13;

/// A rectangle in px: left, top; right, bottom.
pub(super) type Rectangle = [Point; 2];

impl Room {
    /// All of a picture.
    pub(super) fn new(area: Rectangle) -> Self {
        Self { area, taken: BTreeSet::new() }
    }

    /// Takes a rectangle.
    pub(super) fn take(&mut self, rectangle: Rectangle) {
        self.taken.extend(cells(rectangle));
    }

    /// Takes the first of the rectangles that meets nothing; its number.
    pub(super) fn find(&mut self, candidates: &[Rectangle]) -> Option<usize> {
        let found = candidates.iter().position(|rectangle| self.met(*rectangle) == 0)?;
        self.take(candidates[found]);
        Some(found)
    }

    /// The middle of a rectangle of this size that meets nothing, as near to a point as there is one; it is taken.
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

    /// Where a label beside a symbol begins, on its base line: at the offset that is preferred, or round the symbol. `None`: there is no
    /// room.
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

    /// The same, farther away too, for a label that must be seen: where there is no room it stands where it meets least.
    pub(super) fn beside(&mut self, at: Point, preferred: Point, size: f64, text: &str) -> Point {
        let (starts, candidates) = beside(at, preferred, size, text);
        let least = || (0..candidates.len()).min_by_key(|number| self.met(candidates[*number]));
        let least = least().unwrap_or_default();
        self.take(candidates[least]);
        starts[least]
    }

    /// How many cells of a rectangle are taken; beside the picture all are.
    fn met(&self, rectangle: Rectangle) -> usize {
        let [[left, top], [right, bottom]] = rectangle;
        let [[leftmost, topmost], [rightmost, lowest]] = self.area;
        let is_outside = left < leftmost || top < topmost || right > rightmost || bottom > lowest;
        let taken = cells(rectangle).filter(|cell| self.taken.contains(cell)).count();
        if is_outside { taken + OUTSIDE } else { taken }
    }
}

/// Steps away from a place, the nearest first.
fn steps() -> impl Iterator<Item = Point> {
    let rows = (0..=FARTHEST).flat_map(|row| [f64::from(row), -f64::from(row)]);
    let mut steps: Vec<Point> =
        rows.flat_map(|row| [0.0, 1.0, -1.0, 2.0, -2.0].map(|across| [across, row])).collect();
    steps.sort_by(|a, b| libm::hypot(a[0] * 2.0, a[1]).total_cmp(&libm::hypot(b[0] * 2.0, b[1])));
    steps.into_iter()
}

/// Where a label beside a symbol may begin, and what it takes there.
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

/// More cells than any text has.
const OUTSIDE: usize = 1 << 20;

/// About how wide a text is, in px.
pub(super) fn width(text: &str, size: f64) -> f64 {
    0.62 * size * text.chars().count() as f64
}

/// The rectangle of so many px round a point.
pub(super) fn around([x, y]: Point, half: f64) -> Rectangle {
    [[x - half, y - half], [x + half, y + half]]
}

#[expect(clippy::cast_possible_truncation, reason = "px of a page")]
fn cells([low, high]: Rectangle) -> impl Iterator<Item = (i64, i64)> {
    let cell = |at: f64| (at / CELL).floor() as i64;
    let (columns, rows) = (cell(low[0])..=cell(high[0]), cell(low[1])..=cell(high[1]));
    columns.flat_map(move |column| rows.clone().map(move |row| (column, row)))
}
