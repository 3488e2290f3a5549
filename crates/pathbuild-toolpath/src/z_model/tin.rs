use std::collections::BTreeMap;

use delaunator::{Point, triangulate};
use pathbuild_path::Xy;

/// Triangles between the probes.
#[derive(Clone, Debug)]
pub(crate) struct Tin {
    places: Vec<ProbedPoint>,
    triangles: Vec<[usize; 3]>,
    /// The edges of the hull; the pieces of the line where all probes lie on one.
    border: Vec<[usize; 2]>,
}

/// One or more probes at one place.
#[derive(Clone, Debug)]
struct ProbedPoint {
    at: Xy,
    probes: Vec<usize>,
}

/// How far outside a triangle a point may seem to be, as a part of the triangle, and still be taken for inside.
const ROUNDING: f64 = 1e-9;

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
        Self { places, triangles, border }
    }

    pub(crate) fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        let inside = self.triangles.iter().find_map(|corners| Some((corners, self.inside(*corners, at)?)));
        match inside {
            Some((corners, parts)) => self.shared(corners.iter().copied().zip(parts)),
            None => self.on_border(at),
        }
    }

    /// How far a point is from the triangles (or from the line, or the one probe), in mm; 0 inside.
    pub(crate) fn distance(&self, at: Xy) -> f64 {
        if self.triangles.iter().any(|corners| self.inside(*corners, at).is_some()) {
            return 0.0;
        }
        match self.nearest(at) {
            Some((_, _, distance)) => distance,
            None => self.places.first().map_or(0.0, |place| (place.at - at).norm()),
        }
    }

    /// The parts that a triangle's corners have in a point inside it.
    fn inside(&self, corners: [usize; 3], at: Xy) -> Option<[f64; 3]> {
        let [a, b, c] = corners.map(|corner| self.places[corner].at);
        let (ab, ac, ap) = (b - a, c - a, at - a);
        let area = ab.perp(&ac);
        let (of_b, of_c) = (ap.perp(&ac) / area, ab.perp(&ap) / area);
        let parts = [1.0 - of_b - of_c, of_b, of_c];
        // A triangle without area has parts that are no numbers, and nothing inside.
        parts.iter().all(|part| *part >= -ROUNDING).then_some(parts)
    }

    fn on_border(&self, at: Xy) -> Vec<(usize, f64)> {
        match self.nearest(at) {
            Some(([start, end], along, _)) => self.shared([(start, 1.0 - along), (end, along)]),
            None => self.shared(self.places.first().map(|_| (0, 1.0))),
        }
    }

    /// The nearest edge, the part of it at which its nearest point lies, and the distance; the first of several.
    fn nearest(&self, at: Xy) -> Option<([usize; 2], f64, f64)> {
        let edges = self.border.iter().map(|edge| {
            let [start, end] = edge.map(|place| self.places[place].at);
            let way = end - start;
            let along = ((at - start).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
            (*edge, along, (start + way * along - at).norm())
        });
        edges.reduce(|best, other| if other.2 < best.2 { other } else { best })
    }

    /// Probes at one place share its part.
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

/// The places of probes. Probes whose places a program would write alike are at one.
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
