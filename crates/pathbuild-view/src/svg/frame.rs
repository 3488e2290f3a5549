//! The position of the drawing on the page. Its y axis points up, that of the page points down.

use crate::scene::{Point, Scene, ScenePath, Shape};

/// Space for the drawing in px, without the legend.
const ROOM: Point = [1080.0, 720.0];

/// Margin around the drawing in px.
const MARGIN: f64 = 40.0;

/// Smallest extent shown in mm, for drawings without an extent, such as a single hole.
const LEAST: f64 = 10.0;

/// Transforms coordinates of the drawing to those of the page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    low: Point,
    high: Point,
    scale: f64,
    /// The position of the drawing's upper left corner.
    corner: Point,
}

/// Transforms coordinates of a path to those of the page.
#[derive(Clone, Copy, Debug)]
pub(super) struct PageTransform {
    frame: Frame,
    zero: Point,
}

impl Frame {
    /// The frame around paths and clamps; around other layers if there are no paths.
    pub(super) fn of(scene: &Scene) -> Self {
        let mut corners: Option<[Point; 2]> = None;
        for path in &scene.paths {
            for extent in corners_of(path) {
                widen(&mut corners, extent);
            }
        }
        if corners.is_none() {
            let shapes = scene.other_layers.iter().filter_map(|other| match other {
                crate::scene::OtherShape::Shape { shape, .. } => Some(shape.extent()),
                crate::scene::OtherShape::Text { .. } => None,
            });
            for extent in shapes {
                widen(&mut corners, extent);
            }
        }
        for shape in scene.keep_outs.iter().flat_map(|clamp| &clamp.outline) {
            widen(&mut corners, shape.extent());
        }
        for at in scene.findings.iter().filter_map(|finding| finding.at) {
            widen(&mut corners, [at, at]);
        }
        Self::around(corners)
    }

    /// The frame around the corners of a bounding box.
    pub(super) fn around(corners: Option<[Point; 2]>) -> Self {
        let [mut low, mut high] = corners.unwrap_or([[0.0; 2], [LEAST; 2]]);
        for axis in [0, 1] {
            let missing = (LEAST - (high[axis] - low[axis])).max(0.0) / 2.0;
            low[axis] -= missing;
            high[axis] += missing;
        }
        let scale = (ROOM[0] / (high[0] - low[0])).min(ROOM[1] / (high[1] - low[1]));
        let spare = (ROOM[0] - (high[0] - low[0]) * scale) / 2.0;
        Self { low, high, scale, corner: [MARGIN + spare, MARGIN] }
    }

    /// The frame of a bounding box at a scale, with its upper left corner at a given point.
    pub(super) fn at_scale([low, high]: [Point; 2], scale: f64, corner: Point) -> Self {
        Self { low, high, scale, corner }
    }

    /// Px per mm.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// The page's width in px.
    pub(super) const WIDTH: f64 = ROOM[0] + 2.0 * MARGIN;

    /// The lower edge of the drawing, with its margins.
    pub(super) fn bottom(&self) -> f64 {
        (self.high[1] - self.low[1]) * self.scale + 2.0 * MARGIN
    }

    /// The whole area except for a thin margin.
    pub(super) fn area(&self) -> [Point; 2] {
        [[0.0, 0.0], [Self::WIDTH, self.bottom() - MARGIN / 4.0]]
    }

    pub(super) fn of_path(&self, path: &ScenePath) -> PageTransform {
        PageTransform { frame: *self, zero: path.zero }
    }

    /// The transform for coordinates of the drawing.
    pub(super) fn of_drawing(&self) -> PageTransform {
        PageTransform { frame: *self, zero: [0.0; 2] }
    }
}

impl PageTransform {
    /// Px per mm.
    pub(super) fn scale(&self) -> f64 {
        self.frame.scale
    }

    /// Transforms a point.
    pub(super) fn at(&self, [x, y]: Point) -> Point {
        let Frame { low, high, scale, corner } = self.frame;
        [corner[0] + (x + self.zero[0] - low[0]) * scale, corner[1] + (high[1] - y - self.zero[1]) * scale]
    }
}

/// The bounding boxes of everything in a path, including the removed material, in coordinates of the drawing.
fn corners_of(path: &ScenePath) -> Vec<[Point; 2]> {
    let moved = |corners: [Point; 2]| corners.map(|[x, y]| [x + path.zero[0], y + path.zero[1]]);
    let shapes = path.elements.iter().map(|element| element.shape.extent());
    let moves = path
        .moves
        .iter()
        .filter(|movement| movement.kind.cuts())
        .filter_map(super::super::scene::Move::extent);
    let half = path.tool.unwrap_or(0.0) / 2.0;
    let moves = moves.map(|[low, high]| [low.map(|at| at - half), high.map(|at| at + half)]);
    let rapids = path.elements.is_empty().then_some(&path.moves).into_iter().flatten();
    let rapids = rapids.filter_map(super::super::scene::Move::extent);
    let circle = |centre, radius| Shape::Circle { centre, radius }.extent();
    let texts = path.texts.iter().map(|text| circle(text.at, text.radius));
    shapes.chain(moves).chain(rapids).chain(texts).map(moved).collect()
}

pub(super) fn widen(corners: &mut Option<[Point; 2]>, [low, high]: [Point; 2]) {
    if ![low, high].iter().flatten().all(|value| value.is_finite()) {
        return;
    }
    *corners = Some(match *corners {
        None => [low, high],
        Some([lowest, highest]) => [
            [lowest[0].min(low[0]), lowest[1].min(low[1])],
            [highest[0].max(high[0]), highest[1].max(high[1])],
        ],
    });
}
