//! Where texts stand, so that none is printed over another.

use std::collections::BTreeSet;

use super::frame::Frame;
use crate::scene::Point;

/// What is taken of a page: cells of a grid. Taking and asking cost as much as the text is large, however many there are.
#[derive(Default)]
pub(super) struct Room(BTreeSet<(i64, i64)>);

/// Width and height of a cell in px.
const CELL: f64 = 4.0;

/// A rectangle in px: left, top; right, bottom.
pub(super) type Rectangle = [Point; 2];

impl Room {
    /// Takes a rectangle.
    pub(super) fn take(&mut self, rectangle: Rectangle) {
        self.0.extend(cells(rectangle));
    }

    /// Takes the first of the rectangles that meets nothing, else that which meets least; its number.
    pub(super) fn choose(&mut self, candidates: &[Rectangle]) -> usize {
        let mut best = (usize::MAX, 0);
        for (number, rectangle) in candidates.iter().enumerate() {
            let met = self.met(*rectangle);
            if met < best.0 {
                best = (met, number);
            }
            if met == 0 {
                break;
            }
        }
        if let Some(rectangle) = candidates.get(best.1) {
            self.take(*rectangle);
        }
        best.1
    }

    /// Where a label beside a symbol begins, on its base line: at the offset that is preferred, or round the symbol.
    pub(super) fn beside(&mut self, [x, y]: Point, preferred: Point, size: f64, text: &str) -> Point {
        let width = width(text, size);
        let (near, row) = (8.0, size + 2.5);
        let mut offsets = vec![preferred, [-near, near + row * 0.75], [-near, -near]];
        offsets.extend([[near + 2.0, size * 0.35], [-near - 2.0 - width, size * 0.35]]);
        for rows in [0.0, 1.0, 2.0, 3.0] {
            let (below, above) = (near + row * (0.75 + rows), -near - row * rows);
            offsets.extend([-near, near - width].into_iter().flat_map(|left| [[left, below], [left, above]]));
        }
        let starts: Vec<Point> = offsets.iter().map(|[right, down]| [x + right, y + down]).collect();
        let candidates: Vec<Rectangle> = starts
            .iter()
            .map(|[left, base]| [[*left, base - 0.8 * size], [left + width, base + 0.2 * size]])
            .collect();
        starts[self.choose(&candidates)]
    }

    /// How many cells of a rectangle are taken; beside the page all are.
    fn met(&self, rectangle: Rectangle) -> usize {
        let [[left, top], [right, _]] = rectangle;
        let is_outside = left < 0.0 || top < 0.0 || right > Frame::WIDTH;
        let taken = cells(rectangle).filter(|cell| self.0.contains(cell)).count();
        if is_outside { taken + OUTSIDE } else { taken }
    }
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
