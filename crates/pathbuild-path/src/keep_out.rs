//! Clamps: their outlines and heights, and the search for those that the tool hits. (book: language/keep-outs)

use std::iter;

use either::Either;
use pathbuild_diagnostic::Diagnostic;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, Envelope as _, RTree};
use smol_str::SmolStr;

use crate::approx::{above, is_negligible};
use crate::boxes::{BoxIndex, widened_box};
use crate::geometry::{Arc, Curve, Line, Placement, Xy};

/// A clamp: an area that the tool must not enter below a given height.
#[derive(Clone, Debug, PartialEq)]
pub struct KeepOut {
    /// Name of the clamp's layer.
    pub layer: SmolStr,
    /// The start of the clamp's outline; for a circle, the centre.
    pub at: Xy,
    /// The clamp's height in mm, above the plate or above the level that its drawing is raised to.
    pub height: f64,
    /// The clamp's outline: a closed sequence of curves. A circle is a single arc.
    pub outline: Vec<Curve>,
}

/// The clamps of a drawing, with findings about them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KeepOuts {
    /// The valid clamps, layer by layer in file order.
    pub all: Vec<KeepOut>,
    /// Findings with their positions in the file. If any is an error, the clamps are not fully known.
    pub problems: Vec<Diagnostic>,
}

impl KeepOut {
    /// Returns the clamp after its drawing is placed and raised.
    pub fn placed(&self, placement: &Placement, raised: f64) -> Self {
        Self {
            layer: self.layer.clone(),
            at: placement.place(self.at),
            height: self.height + raised,
            outline: self.outline.iter().map(|curve| placement.place_curve(curve)).collect(),
        }
    }
}

/// The movement of the tool tip in one move: along a curve in the plane, with a constant slope. A vertical move is a line without length. Lengths are
/// in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct TipMove {
    pub curve: Curve,
    pub from_z: f64,
    pub to_z: f64,
}

/// A spatial index of clamps.
#[derive(Clone, Debug)]
pub struct KeepOutMap {
    clamps: Vec<Clamp>,
    boxes: BoxIndex,
}

#[derive(Clone, Debug)]
struct Clamp {
    height: f64,
    outline: Outline,
}

impl KeepOutMap {
    /// Creates a map from the heights and outlines of clamps.
    pub fn new<'k>(clamps: impl IntoIterator<Item = (f64, &'k [Curve])>) -> Self {
        let clamp = |(height, outline)| Clamp { height, outline: Outline::new(outline) };
        let clamps: Vec<Clamp> = clamps.into_iter().map(clamp).collect();
        Self { boxes: BoxIndex::new(clamps.iter().map(|clamp| clamp.outline.extent())), clamps }
    }

    /// Whether there are no clamps.
    pub fn is_empty(&self) -> bool {
        self.clamps.is_empty()
    }

    /// Returns the indices of the clamps that a tool of this radius hits in a move, in ascending order. A tool that comes no more than `slack` mm too
    /// near or too low does not count as hitting a clamp, since that may be a rounding error.
    pub fn entered_clamps(&self, way: &TipMove, radius: f64, slack: f64) -> Vec<usize> {
        let radius = (radius - slack).max(0.0);
        let is_entered = |number: &usize| {
            let clamp = &self.clamps[*number];
            let below = way.part_below(clamp.height - slack);
            below.is_some_and(|curve| clamp.outline.is_entered(&curve, radius))
        };
        self.boxes.near(widened_box(&way.curve, radius)).filter(is_entered).collect()
    }
}

impl TipMove {
    /// Whether only Z changes.
    pub fn is_vertical(&self) -> bool {
        is_negligible(self.curve.length())
    }

    /// The lowest Z of the move.
    pub fn lowest(&self) -> f64 {
        self.from_z.min(self.to_z)
    }

    /// Returns the part of the move below a height, as a curve in the plane; `None` if no part is.
    pub(crate) fn part_below(&self, height: f64) -> Option<Curve> {
        let (from, to) = (above(height, self.from_z), above(height, self.to_z));
        if from == to {
            return from.then_some(self.curve);
        }
        let length = self.curve.length();
        if length == 0.0 {
            return Some(self.curve);
        }
        let cut = length * ((height - self.from_z) / (self.to_z - self.from_z)).clamp(0.0, 1.0);
        let (begin, end) = if from { (0.0, cut) } else { (cut, length) };
        Some(self.curve.section(begin, end))
    }
}

/// A closed outline, prepared for queries.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    pieces: RTree<IndexedPiece>,
}

type IndexedPiece = GeomWithData<Rectangle<[f64; 2]>, OutlinePiece>;

/// A part of the outline that rises or falls monotonically.
#[derive(Clone, Copy, Debug)]
struct OutlinePiece {
    curve: Curve,
    /// Y at the start and end of the piece. `from` is `to` of the previous piece, so that rounding leaves no gap between them.
    from: f64,
    to: f64,
}

/// Margin in mm around bounding boxes, larger than the gap between ends that meet.
const BOX_MARGIN: f64 = 1e-4;

impl Outline {
    /// Creates an outline from a closed, non-empty sequence of curves.
    pub(crate) fn new(curves: &[Curve]) -> Self {
        let monotone: Vec<Curve> = curves.iter().flat_map(monotone_pieces).collect();
        let mut from = monotone.last().map_or(0.0, |last| last.end().y);
        let pieces = monotone.into_iter().map(|curve| {
            let piece = OutlinePiece { curve, from, to: curve.end().y };
            from = piece.to;
            GeomWithData::new(Rectangle::from_aabb(widened_box(&curve, BOX_MARGIN)), piece)
        });
        Self { pieces: RTree::bulk_load(pieces.collect()) }
    }

    pub(crate) fn extent(&self) -> AABB<[f64; 2]> {
        self.pieces.root().envelope()
    }

    /// Whether any part of a disc enters the outline while its centre moves along a curve. Touching the outline is not entering. The radius
    /// is in mm.
    fn is_entered(&self, way: &Curve, radius: f64) -> bool {
        let mut near = self.pieces.locate_in_envelope_intersecting(widened_box(way, radius + BOX_MARGIN));
        near.any(|piece| above(radius, way.distance(&piece.data.curve))) || self.contains(way.start())
    }

    /// Whether a point that is not on the outline is inside, that is, whether a ray to the right crosses different numbers of upward and downward
    /// pieces.
    pub(crate) fn contains(&self, point: Xy) -> bool {
        let [right, _] = self.extent().upper();
        let ray = AABB::from_corners([point.x, point.y], [right.max(point.x), point.y]);
        let crossings = self.pieces.locate_in_envelope_intersecting(ray);
        crossings.map(|piece| piece.data.crossing(point)).sum::<i32>() != 0
    }

    /// Whether a ring lies inside, judged by four points of each of its curves.
    pub(crate) fn encloses(&self, ring: &[Curve]) -> bool {
        let extent = self.extent();
        let mut points = ring.iter().flat_map(Curve::quarters);
        points.all(|at| extent.contains_point(&[at.x, at.y]) && self.contains(at))
    }
}

impl OutlinePiece {
    /// Returns 1 if the piece crosses the ray to the right of a point upwards, -1 if downwards, 0 if not at all.
    fn crossing(&self, point: Xy) -> i32 {
        let up = self.from <= point.y && point.y < self.to;
        let down = self.to <= point.y && point.y < self.from;
        if (up || down) && self.x_at(point.y) > point.x { i32::from(up) - i32::from(down) } else { 0 }
    }

    fn x_at(&self, y: f64) -> f64 {
        match &self.curve {
            Curve::Line(Line { start, end }) => {
                let share = ((y - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
                start.x + (end.x - start.x) * share
            }
            Curve::Arc(Arc { centre, radius, start, end, clockwise, .. }) => {
                let up = y - centre.y;
                let out = libm::sqrt((radius * radius - up * up).max(0.0));
                // The right half of a circle runs downwards when clockwise.
                if (start.y > end.y) == *clockwise { centre.x + out } else { centre.x - out }
            }
        }
    }
}

/// Returns the monotone pieces of a curve: arcs are split at their highest and lowest points.
fn monotone_pieces(curve: &Curve) -> impl Iterator<Item = Curve> {
    let Curve::Arc(arc) = curve else { return Either::Left(iter::once(*curve)) };
    let out = arc.start - arc.centre;
    let start = libm::atan2(out.y, out.x).to_degrees();
    // The angle from the start to a point of the circle; 0 for a point that is not on the arc.
    let ahead = |angle: f64| {
        let ahead = if arc.clockwise { start - angle } else { angle - start };
        let ahead = ahead - 360.0 * (ahead / 360.0).floor();
        if ahead < arc.degrees { ahead } else { 0.0 }
    };
    let (highest, lowest) = (ahead(90.0), ahead(270.0));
    let ends = [0.0, highest.min(lowest), highest.max(lowest), arc.degrees];
    let along = |degrees: f64| degrees.to_radians() * arc.radius;
    let pieces = [0, 1, 2].into_iter().filter(move |piece| ends[*piece] < ends[piece + 1]);
    Either::Right(pieces.map(move |piece| curve.section(along(ends[piece]), along(ends[piece + 1]))))
}
