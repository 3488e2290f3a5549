use std::collections::BTreeMap;

use delaunator::{Point, triangulate};
use pathbuild_path::Xy;
use rstar::primitives::{GeomWithData, Line, Rectangle};
use rstar::{AABB, RTree};

/// A triangulation of the probes.
#[derive(Clone, Debug)]
pub(crate) struct Tin {
    places: Vec<ProbedPoint>,
    triangles: Vec<[usize; 3]>,
    /// The edges of the hull, or the segments of the line if all probes are collinear.
    border: Vec<[usize; 2]>,
    /// Bounding boxes of the triangles, with their indices.
    boxes: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
    /// The edges with their indices.
    edges: RTree<GeomWithData<Line<[f64; 2]>, usize>>,
}

/// One or more probes at the same position.
#[derive(Clone, Debug)]
struct ProbedPoint {
    at: Xy,
    probes: Vec<usize>,
}

/// How far outside a triangle, as a fraction of it, a point is still considered to be inside.
const ROUNDING: f64 = 1e-9;

/// Edges whose squared distances in mm² differ by less are considered equal by the tree and compared exactly.
const AS_NEAR: f64 = 1e-12;

impl Tin {
    pub(crate) fn new(probes: &[Xy]) -> Self {
        let places = places(probes);
        let points: Vec<Point> = places.iter().map(|place| Point { x: place.at.x, y: place.at.y }).collect();
        let net = triangulate(&points);
        let triangles: Vec<[usize; 3]> = net.triangles.as_chunks().0.to_vec();
        let mut border: Vec<[usize; 2]> = net.hull.windows(2).map(|edge| [edge[0], edge[1]]).collect();
        if let ([first, .., last], false) = (&*net.hull, triangles.is_empty()) {
            border.push([*last, *first]);
        }
        let corner = |place: &usize| [places[*place].at.x, places[*place].at.y];
        let boxes = triangles.iter().map(|corners| wide(AABB::from_points(&corners.each_ref().map(corner))));
        let edges =
            border.iter().map(|edge| edge.each_ref().map(corner)).map(|[from, to]| Line::new(from, to));
        Self { boxes: numbered(boxes), edges: numbered(edges), places, triangles, border }
    }

    pub(crate) fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        match self.around(at) {
            Some((number, parts)) => self.shared(self.triangles[number].into_iter().zip(parts)),
            None => self.on_border(at),
        }
    }

    /// Distance in mm from the triangles (or from the line or the single probe); 0 inside.
    pub(crate) fn distance(&self, at: Xy) -> f64 {
        if self.around(at).is_some() {
            return 0.0;
        }
        match self.nearest(at) {
            Some((_, _, distance)) => distance,
            None => self.places.first().map_or(0.0, |place| (place.at - at).norm()),
        }
    }

    /// The first triangle that contains a point, with the barycentric coordinates of the point.
    fn around(&self, at: Xy) -> Option<(usize, [f64; 3])> {
        let near = self.boxes.locate_in_envelope_intersecting(AABB::from_point([at.x, at.y]));
        let around = near
            .filter_map(|candidate| Some((candidate.data, self.inside(self.triangles[candidate.data], at)?)));
        around.min_by_key(|(number, _)| *number)
    }

    /// Barycentric coordinates of a point with respect to a triangle, if the point is inside.
    fn inside(&self, corners: [usize; 3], at: Xy) -> Option<[f64; 3]> {
        let [a, b, c] = corners.map(|corner| self.places[corner].at);
        let (ab, ac, ap) = (b - a, c - a, at - a);
        let area = ab.perp(&ac);
        let (of_b, of_c) = (ap.perp(&ac) / area, ab.perp(&ap) / area);
        let parts = [1.0 - of_b - of_c, of_b, of_c];
        // The coordinates are NaN for a triangle without area, so that nothing is inside.
        parts.iter().all(|part| *part >= -ROUNDING).then_some(parts)
    }

    fn on_border(&self, at: Xy) -> Vec<(usize, f64)> {
        match self.nearest(at) {
            Some(([start, end], along, _)) => self.shared([(start, 1.0 - along), (end, along)]),
            None => self.shared(self.places.first().map(|_| (0, 1.0))),
        }
    }

    /// The nearest edge (the first if there are several), the fraction along it of its nearest point, and the distance.
    fn nearest(&self, at: Xy) -> Option<([usize; 2], f64, f64)> {
        let mut near = self.edges.nearest_neighbor_iter_with_distance_2([at.x, at.y]).peekable();
        let (_, least) = *near.peek()?;
        let near = near.take_while(|(_, distance)| *distance <= least * (1.0 + ROUNDING) + AS_NEAR);
        let nearest = near.map(|(edge, _)| (self.along(edge.data, at), edge.data));
        let first =
            nearest.min_by(|((_, a), first), ((_, b), second)| a.total_cmp(b).then(first.cmp(second)));
        first.map(|((along, distance), edge)| (self.border[edge], along, distance))
    }

    /// The fraction along an edge of its point nearest to `at`, and the distance.
    fn along(&self, edge: usize, at: Xy) -> (f64, f64) {
        let [start, end] = self.border[edge].map(|place| self.places[place].at);
        let way = end - start;
        let along = ((at - start).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
        (along, (start + way * along - at).norm())
    }

    /// Divides the weight of a position among its probes.
    fn shared(&self, parts: impl IntoIterator<Item = (usize, f64)>) -> Vec<(usize, f64)> {
        let mut weights = Vec::new();
        for (place, part) in parts {
            let probes = &self.places[place].probes;
            weights.extend(probes.iter().map(|probe| (*probe, part / probes.len() as f64)));
        }
        weights.sort_unstable_by_key(|(probe, _)| *probe);
        weights
    }
}

/// Enlarges a rectangle so that no point considered to be inside is missed.
fn wide(tight: AABB<[f64; 2]>) -> Rectangle<[f64; 2]> {
    let (lower, upper) = (tight.lower(), tight.upper());
    let margin = 4.0 * ROUNDING * (upper[0] - lower[0]).max(upper[1] - lower[1]);
    Rectangle::from_corners(
        lower.map(|coordinate| coordinate - margin),
        upper.map(|coordinate| coordinate + margin),
    )
}

/// Builds a tree of shapes with their indices.
fn numbered<T: rstar::RTreeObject>(shapes: impl Iterator<Item = T>) -> RTree<GeomWithData<T, usize>> {
    RTree::bulk_load(shapes.enumerate().map(|(number, shape)| GeomWithData::new(shape, number)).collect())
}

/// The positions of probes. Probes whose positions would be written identically in a program are at the same position.
fn places(probes: &[Xy]) -> Vec<ProbedPoint> {
    let mut places: Vec<ProbedPoint> = Vec::new();
    let mut known = BTreeMap::new();
    for (number, at) in probes.iter().enumerate() {
        let place = *known.entry([at.x, at.y].map(micrometres)).or_insert_with(|| {
            places.push(ProbedPoint { at: *at, probes: Vec::new() });
            places.len() - 1
        });
        places[place].probes.push(number);
    }
    places
}

#[expect(clippy::cast_possible_truncation, reason = "saturates: nobody mills so far out")]
fn micrometres(millimetres: f64) -> i64 {
    (millimetres * 1000.0).round_ties_even() as i64
}
