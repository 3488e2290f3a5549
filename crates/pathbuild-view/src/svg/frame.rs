//! Places the drawing and its texts on the page. The y axis of the drawing points up, that of the page points down.

use std::collections::BTreeSet;

use pathbuild_diagnostic::Lang;

use crate::extent::{Corners, bounding_box, with_margin, with_min_extent};
use crate::scene::{KeepOut, OtherShape, Point, Scene, SceneMove, ScenePath};

/// The parts of a scene that a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a layer of its own")]
pub struct VisibleParts {
    /// Language of the legend and of the findings.
    pub lang: Lang,
    /// Whether rapid moves are shown.
    pub rapids: bool,
    /// Whether the numbers of the cutting order are shown.
    pub order: bool,
    /// Whether arrows in the direction of moves are shown.
    pub arrows: bool,
    /// Whether parameter texts are shown.
    pub texts: bool,
    /// Whether the stock after all moves is shown instead of the drawing and the moves.
    pub stock: bool,
}

impl VisibleParts {
    /// Returns a selection with everything of the drawing and the moves, but not the stock.
    pub fn all(lang: Lang) -> Self {
        Self { lang, rapids: true, order: true, arrows: true, texts: true, stock: false }
    }

    pub(super) fn choose(self, en: &'static str, de: &'static str) -> &'static str {
        self.lang.choose(en, de)
    }
}

/// Height in px of a line of the legend.
pub(super) const LINE_HEIGHT: f64 = 17.0;

/// Space in px for the drawing, without the legend.
const DRAWING_SIZE: Point = [1080.0, 720.0];

/// Margin in px around the drawing.
const MARGIN: f64 = 40.0;

/// Minimum extent shown in mm, for drawings without an extent, such as a single hole.
const MIN_EXTENT: f64 = 10.0;

/// Transform from coordinates of the drawing to those of the page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    low: Point,
    high: Point,
    scale: f64,
    /// Position on the page of the drawing's upper left corner, in px.
    corner: Point,
}

/// Transform from coordinates of a path to those of the page.
#[derive(Clone, Copy, Debug)]
pub(super) struct PageTransform {
    frame: Frame,
    zero: Point,
}

impl Frame {
    /// Returns the frame around the paths (or the other layers, if the paths have no extent), the clamps and the places of findings.
    pub(super) fn of(scene: &Scene) -> Self {
        let other_shapes = scene.other_layers.iter().filter_map(|other| match other {
            OtherShape::Shape { shape, .. } => Some(shape.extent()),
            OtherShape::Text { .. } => None,
        });
        let drawn = bounding_box(scene.paths.iter().flat_map(extents)).or_else(|| bounding_box(other_shapes));
        let clamps = scene.keep_outs.iter().filter_map(KeepOut::extent);
        Self::around(bounding_box(drawn.into_iter().chain(clamps).chain(scene.finding_places())))
    }

    /// Returns the frame around a bounding box, at the scale at which the box fills the available space.
    pub(super) fn around(corners: Option<Corners>) -> Self {
        let [low, high] = with_min_extent(corners.unwrap_or([[0.0; 2], [MIN_EXTENT; 2]]), MIN_EXTENT);
        let scale = (DRAWING_SIZE[0] / (high[0] - low[0])).min(DRAWING_SIZE[1] / (high[1] - low[1]));
        let spare = (DRAWING_SIZE[0] - (high[0] - low[0]) * scale) / 2.0;
        Self { low, high, scale, corner: [MARGIN + spare, MARGIN] }
    }

    /// Returns the frame of a bounding box at a given scale, with its upper left corner at a given point of the page.
    pub(super) fn at_scale([low, high]: Corners, scale: f64, corner: Point) -> Self {
        Self { low, high, scale, corner }
    }

    /// Returns the scale in px per mm.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// Width of the page in px.
    pub(super) const WIDTH: f64 = DRAWING_SIZE[0] + 2.0 * MARGIN;

    /// Returns the lower edge of the drawing in px, with its margins.
    pub(super) fn bottom(&self) -> f64 {
        (self.high[1] - self.low[1]) * self.scale + 2.0 * MARGIN
    }

    /// Returns the area in px in which texts may be placed: everything except for a thin strip at the bottom.
    pub(super) fn area(&self) -> [Point; 2] {
        [[0.0, 0.0], [Self::WIDTH, self.bottom() - MARGIN / 4.0]]
    }

    pub(super) fn of_path(&self, path: &ScenePath) -> PageTransform {
        PageTransform { frame: *self, zero: path.zero }
    }

    pub(super) fn of_drawing(&self) -> PageTransform {
        PageTransform { frame: *self, zero: [0.0; 2] }
    }
}

impl PageTransform {
    /// Returns the scale in px per mm.
    pub(super) fn scale(&self) -> f64 {
        self.frame.scale
    }

    pub(super) fn to_page(self, [x, y]: Point) -> Point {
        let Frame { low, high, scale, corner } = self.frame;
        [corner[0] + (x + self.zero[0] - low[0]) * scale, corner[1] + (high[1] - y - self.zero[1]) * scale]
    }
}

/// Returns the bounding boxes of the elements, the texts and the removed material of a path, in coordinates of the drawing; those of rapid moves only
/// if the path has no elements.
fn extents(path: &ScenePath) -> impl Iterator<Item = Corners> {
    let moved = |corners: Corners| corners.map(|[x, y]| [x + path.zero[0], y + path.zero[1]]);
    let shapes = path.elements.iter().map(|element| element.shape.extent());
    let moves = path.moves.iter().filter(|movement| movement.kind.cuts()).filter_map(|movement| {
        let half = path.cutter(movement).map_or(0.0, |(diameter, _)| diameter / 2.0);
        Some(with_margin(movement.extent()?, half))
    });
    let rapids = path.elements.is_empty().then_some(&path.moves).into_iter().flatten();
    let rapids = rapids.filter_map(SceneMove::extent);
    let texts = path.texts.iter().map(|text| with_margin([text.at; 2], text.radius));
    shapes.chain(moves).chain(rapids).chain(texts).map(moved)
}

/// The occupied space of a picture, as cells of a grid, for placing texts that do not overlap. The cost of an operation depends on the
/// size of the text, not on the number of texts.
pub(super) struct OccupiedSpace {
    area: Rectangle,
    taken: BTreeSet<(i64, i64)>,
    /// Lines that labels should not cover.
    pub(super) lines: Vec<[Point; 2]>,
}

/// Width and height of a cell in px.
const CELL: f64 = 4.0;

/// Maximum vertical distance of a text from its preferred position, in multiples of its height.
const MAX_TEXT_DISTANCE: u32 = 6;

/// Number of candidate positions, counted from the first, that are so near to the symbol of a label that the label cannot be mistaken for that of
/// another symbol.
const NEAR_CANDIDATES: usize = 13;

/// Upper left and lower right corner of a rectangle in px.
pub(super) type Rectangle = [Point; 2];

impl OccupiedSpace {
    pub(super) fn new(area: Rectangle) -> Self {
        Self { area, taken: BTreeSet::new(), lines: Vec::new() }
    }

    pub(super) fn occupy(&mut self, rectangle: Rectangle) {
        self.taken.extend(self.cells(rectangle));
    }

    /// Occupies the first of the rectangles that is free, and returns its index; `None` if none of them is.
    pub(super) fn occupy_first_free(&mut self, candidates: &[Rectangle]) -> Option<usize> {
        let found = candidates.iter().position(|rectangle| self.occupied_cells(*rectangle) == 0)?;
        self.occupy(candidates[found]);
        Some(found)
    }

    /// Occupies the free rectangle of this size that is nearest to a point, and returns its centre; `None` if no position nearby is free.
    pub(super) fn occupy_near(&mut self, at: Point, [width, height]: Point) -> Option<Point> {
        let [low, high] = self.area;
        let inside = |axis: usize, value: f64, size: f64| {
            value.min(high[axis] - size / 2.0).max(low[axis] + size / 2.0)
        };
        let at = [inside(0, at[0], width), inside(1, at[1], height)];
        let middles: Vec<Point> =
            offsets().map(|[across, down]| [at[0] + across * width / 2.0, at[1] + down * height]).collect();
        let rectangle =
            |[x, y]: &Point| [[x - width / 2.0, y - height / 2.0], [x + width / 2.0, y + height / 2.0]];
        self.occupy_first_free(&middles.iter().map(rectangle).collect::<Vec<_>>()).map(|found| middles[found])
    }

    /// Finds space for a label beside a symbol, occupies it, and returns the start of the label's baseline. The position that covers the
    /// fewest lines is chosen; among equal ones, the given offset is preferred. Returns `None` if all positions near the symbol are
    /// occupied.
    pub(super) fn occupy_beside(
        &mut self,
        at: Point,
        preferred: Point,
        size: f64,
        text: &str,
    ) -> Option<Point> {
        let (starts, candidates) = candidates_beside(at, preferred, size, text);
        let is_free = |number: &usize| self.occupied_cells(candidates[*number]) == 0;
        let free = (0..NEAR_CANDIDATES).filter(is_free);
        let found = free.min_by_key(|number| self.crossed_length(candidates[*number]))?;
        self.occupy(candidates[found]);
        Some(starts[found])
    }

    /// Like [`occupy_beside`](Self::occupy_beside), but also tries positions farther away. If all are occupied, the label is placed where it
    /// overlaps least.
    pub(super) fn place_beside(&mut self, at: Point, preferred: Point, size: f64, text: &str) -> Point {
        let (starts, candidates) = candidates_beside(at, preferred, size, text);
        let cost = |number: &usize| {
            (self.occupied_cells(candidates[*number]), self.crossed_length(candidates[*number]))
        };
        let least = || (0..candidates.len()).min_by_key(cost);
        let least = least().unwrap_or_default();
        self.occupy(candidates[least]);
        starts[least]
    }

    pub(super) fn is_crossed_by(&self, [from, to]: [Point; 2]) -> bool {
        let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few px")]
        let count = (length / CELL).ceil().max(1.0) as u32;
        let at = |step: u32| {
            [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * f64::from(step) / f64::from(count))
        };
        (0..=count).any(|step| self.cells([at(step), at(step)]).any(|cell| self.taken.contains(&cell)))
    }

    /// Returns the number of occupied cells in a rectangle. If it extends beyond the picture, [`OUTSIDE_COST`] is added.
    fn occupied_cells(&self, rectangle: Rectangle) -> usize {
        let [[left, top], [right, bottom]] = rectangle;
        let [[leftmost, topmost], [rightmost, lowest]] = self.area;
        let is_outside = left < leftmost || top < topmost || right > rightmost || bottom > lowest;
        let taken = self.cells(rectangle).filter(|cell| self.taken.contains(cell)).count();
        if is_outside { taken + OUTSIDE_COST } else { taken }
    }

    /// Returns the total length of lines within a rectangle, in cells.
    #[expect(clippy::cast_possible_truncation, reason = "px of a page")]
    fn crossed_length(&self, rectangle: Rectangle) -> i64 {
        let length: f64 = self.lines.iter().map(|line| length_within(line, rectangle)).sum();
        (length / CELL).ceil() as i64
    }

    /// Returns the cells of a rectangle that lie in the picture. The rectangle is clipped first, because a text of another layer may be a
    /// thousand times as large as the picture.
    #[expect(clippy::cast_possible_truncation, reason = "px of a page")]
    fn cells(&self, [low, high]: Rectangle) -> impl Iterator<Item = (i64, i64)> + use<> {
        let [lowest, highest] = self.area;
        let cell = |at: f64| (at / CELL).floor() as i64;
        let range = |axis: usize| cell(low[axis].max(lowest[axis]))..=cell(high[axis].min(highest[axis]));
        let (columns, rows) = (range(0), range(1));
        columns.flat_map(move |column| rows.clone().map(move |row| (column, row)))
    }
}

fn length_within([from, to]: &[Point; 2], [low, high]: Rectangle) -> f64 {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in [0, 1] {
        let way = to[axis] - from[axis];
        if way == 0.0 {
            if from[axis] < low[axis] || from[axis] > high[axis] {
                return 0.0;
            }
            continue;
        }
        let shares = [low, high].map(|side| (side[axis] - from[axis]) / way);
        enters = enters.max(shares[0].min(shares[1]));
        leaves = leaves.min(shares[0].max(shares[1]));
    }
    (leaves - enters).max(0.0) * libm::hypot(to[0] - from[0], to[1] - from[1])
}

/// Returns the offsets at which a text is tried, nearest first: x in half widths of the text, y in heights.
fn offsets() -> impl Iterator<Item = Point> {
    let rows = (0..=MAX_TEXT_DISTANCE).flat_map(|row| [f64::from(row), -f64::from(row)]);
    let mut steps: Vec<Point> =
        rows.flat_map(|row| [0.0, 1.0, -1.0, 2.0, -2.0].map(|across| [across, row])).collect();
    steps.sort_by(|a, b| libm::hypot(a[0] * 2.0, a[1]).total_cmp(&libm::hypot(b[0] * 2.0, b[1])));
    steps.into_iter()
}

/// Returns the candidate positions for a label beside a symbol: the starts of the baseline, and the rectangles that the label would
/// occupy.
fn candidates_beside([x, y]: Point, preferred: Point, size: f64, text: &str) -> (Vec<Point>, Vec<Rectangle>) {
    let width = text_width(text, size);
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

/// Cost in cells of a text that extends beyond the picture. It is larger than the number of cells of any text.
const OUTSIDE_COST: usize = 1 << 20;

/// Returns the approximate width of a text in px.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    0.62 * size * text.chars().count() as f64
}
