//! Models the height of the material between probes. (book: language/probes)
//!
//! The models describe the correction, that is, by how much the material is higher than drawn. At each point it is a linear combination of the
//! corrections at the probes. Therefore a [`Surface`] depends only on the probes' positions, and a program made with it remains valid until a probe
//! is moved.

use std::collections::BTreeMap;

use delaunator::{Point, triangulate};
use nalgebra::{Matrix2, Vector2};
use pathbuild_path::Xy;
use rstar::primitives::{GeomWithData, Line, Rectangle};
use rstar::{AABB, RTree};

/// The method by which heights between probes are interpolated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ZModel {
    /// The four nearest probes, weighted by the inverse of their distance. This distorts planes, and it is discontinuous where the selection changes.
    #[default]
    Idw4,
    /// The best-fitting plane (least squares). One probe gives a constant height; two probes, or probes on a line, give no slope across the
    /// line.
    Plane,
    /// Triangles between the probes (Delaunay); outside of them the value at the nearest edge. If all probes are on a line, the value at the nearest
    /// point of that line.
    Tin,
}

/// A model for probes at given positions.
#[derive(Clone, Debug)]
pub struct Surface {
    model: Model,
}

#[derive(Clone, Debug)]
enum Model {
    Nearest(NearestProbes),
    Plane(Plane),
    Tin(Triangulation),
}

impl ZModel {
    /// Whether the model needs a slope that the probes at these positions do not determine, because they lie on a line or at a single point. False if
    /// there are no probes.
    pub(super) fn lacks_slope(self, places: &[Xy]) -> bool {
        self != Self::Idw4 && !places.is_empty() && !Scatter::new(places).is_wide()
    }
}

impl Surface {
    /// Creates a model for probes at these positions.
    pub fn new(model: ZModel, places: &[Xy]) -> Self {
        let model = match model {
            ZModel::Idw4 => Model::Nearest(NearestProbes::new(places)),
            ZModel::Plane => Model::Plane(Plane::new(places)),
            ZModel::Tin => Model::Tin(Triangulation::new(places)),
        };
        Self { model }
    }

    /// Returns the weight of each probe at a point, as indices of probes with weights that add up to 1. Probes with weight 0 may be omitted. Empty if
    /// there are no probes.
    pub fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        match &self.model {
            Model::Nearest(nearest) => nearest.weights(at),
            Model::Plane(plane) => plane.weights(at),
            Model::Tin(tin) => tin.weights(at),
        }
    }
}

/// Ratio of the extent of points across their main direction to that along it, below which they are treated as collinear, because they do not
/// reliably determine the slope across that direction.
const COLLINEAR_RATIO: f64 = 0.01;

/// Root mean square of the distances of points from their mean, in mm, up to which they are treated as a single point.
const SINGLE_POINT_SPREAD: f64 = 0.001;

/// The distribution of points around their mean, as a matrix of second moments in mm².
#[derive(Clone, Copy, Debug)]
pub(super) struct Scatter {
    pub(super) count: f64,
    middle: Xy,
    moments: Matrix2<f64>,
}

impl Scatter {
    /// Computes the mean and the second moments of one or more points.
    pub(super) fn new(points: &[Xy]) -> Self {
        let count = points.len() as f64;
        let sum = points.iter().fold(Vector2::zeros(), |sum, point| sum + point.coords);
        let middle = Xy::from(sum / count);
        let moments = points.iter().map(|point| point - middle).map(|d| d * d.transpose()).sum();
        Self { count, middle, moments }
    }

    pub(super) fn without(&self, point: Xy) -> Self {
        let (d, count) = (point - self.middle, self.count - 1.0);
        let moments = self.moments - d * d.transpose() * (self.count / count);
        Self { count, middle: self.middle - d / count, moments }
    }

    /// Whether the points neither lie on a line nor coincide.
    fn is_wide(&self) -> bool {
        let (long, short) = self.principal();
        short > COLLINEAR_RATIO * COLLINEAR_RATIO * long && !self.is_point()
    }

    /// Returns the matrix that converts the position of a point, relative to the mean, to what the point adds to the slope per mm of height: the
    /// inverse of the moments. For collinear points it only has a component along the line, and for a single point it is zero.
    fn inverse(&self) -> Matrix2<f64> {
        if self.is_point() {
            return Matrix2::zeros();
        }
        if self.is_wide() {
            return self.moments.try_inverse().unwrap_or_else(Matrix2::zeros);
        }
        let along = self.direction();
        along * along.transpose() / self.principal().0
    }

    fn is_point(&self) -> bool {
        self.moments.trace() <= self.count * SINGLE_POINT_SPREAD * SINGLE_POINT_SPREAD
    }

    /// Returns the moments along the main direction and across it, in mm².
    fn principal(&self) -> (f64, f64) {
        let half = self.moments.trace() / 2.0;
        let long = half + self.eccentricity();
        (long, self.moments.determinant() / long)
    }

    fn eccentricity(&self) -> f64 {
        let (difference, mixed) = (self.difference(), self.moments.m12);
        libm::sqrt(difference * difference + mixed * mixed)
    }

    fn difference(&self) -> f64 {
        (self.moments.m11 - self.moments.m22) / 2.0
    }

    /// Returns the direction in which the points extend farthest.
    fn direction(&self) -> Vector2<f64> {
        let (difference, eccentricity) = (self.difference(), self.eccentricity());
        // Use the form of the eigenvector in which no digits cancel.
        let along = if difference >= 0.0 {
            Vector2::new(eccentricity + difference, self.moments.m12)
        } else {
            Vector2::new(self.moments.m12, eccentricity - difference)
        };
        along / along.norm()
    }
}

/// The least-squares plane for probes at given positions. Its height at a point depends linearly on the heights at the probes.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    middle: Xy,
    inverse: Matrix2<f64>,
    /// Positions of the probes relative to their mean.
    offsets: Vec<Vector2<f64>>,
}

impl Plane {
    pub(super) fn new(places: &[Xy]) -> Self {
        let scatter = Scatter::new(places);
        let offsets = places.iter().map(|place| place - scatter.middle).collect();
        Self { middle: scatter.middle, inverse: scatter.inverse(), offsets }
    }

    fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        let even = 1.0 / self.offsets.len() as f64;
        let slope = self.inverse * (at - self.middle);
        self.offsets.iter().map(|offset| even + slope.dot(offset)).enumerate().collect()
    }
}

/// Number of probes that determine the height at a point.
const PROBES_PER_POINT: usize = 4;

/// Relative difference of weights below which the tree may order them wrongly, so that they are ordered by index.
const WEIGHT_TOLERANCE: f64 = 1e-12;

/// The model of PathDxf2GCode ([`ZModel::Idw4`]): the four nearest probes, weighted by the inverse of their distance. (book: language/probes)
#[derive(Clone, Debug)]
pub(super) struct NearestProbes {
    /// Positions with the indices of their probes, at most [`PROBES_PER_POINT`] at each: no more can be used.
    places: RTree<GeomWithData<[f64; 2], Vec<usize>>>,
}

impl NearestProbes {
    pub(super) fn new(probes: &[Xy]) -> Self {
        let mut places: BTreeMap<[u64; 2], GeomWithData<[f64; 2], Vec<usize>>> = BTreeMap::new();
        for (number, at) in probes.iter().enumerate() {
            let place = places
                .entry([at.x.to_bits(), at.y.to_bits()])
                .or_insert_with(|| GeomWithData::new([at.x, at.y], Vec::new()));
            if place.data.len() < PROBES_PER_POINT {
                place.data.push(number);
            }
        }
        Self { places: RTree::bulk_load(places.into_values().collect()) }
    }

    /// Returns the probes with the greatest weights in descending order; equal weights are ordered by index.
    fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        let mut weights: Vec<(usize, f64)> = Vec::new();
        for place in self.places.nearest_neighbor_iter([at.x, at.y]) {
            let weight = 1.0 / ((Xy::from(*place.geom()) - at).norm() + 0.001);
            // All further probes have lower weights.
            if weights
                .get(PROBES_PER_POINT - 1)
                .is_some_and(|(_, least)| weight < least * (1.0 - WEIGHT_TOLERANCE))
            {
                break;
            }
            weights.extend(place.data.iter().map(|probe| (*probe, weight)));
        }
        weights.sort_unstable_by(|(a, of_a), (b, of_b)| of_b.total_cmp(of_a).then(a.cmp(b)));
        weights.truncate(PROBES_PER_POINT);
        let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
        weights.into_iter().map(|(probe, weight)| (probe, weight / sum)).collect()
    }
}

// Finds probes that do not fit the others. (PB607)
//
// Each probe is compared with the best-fitting plane (least squares) of all the others. It is odd if its distance from that plane exceeds
// [`MIN_REPORTED_DEVIATION`] and also [`MIN_ODD_RATIO`] times the scatter of the others around the plane (externally studentized residual). So a bent
// sheet, on which all probes scatter, has no odd probes, but a single typing error stands out. This requires five probes: with four, the three others
// always lie on a plane, so that it is impossible to tell which one is wrong.

/// Deviation of a height or of a correction in mm, from the one that the probes suggest, up to which nothing is reported.
pub const MIN_REPORTED_DEVIATION: f64 = 0.1;

/// Minimum ratio of a probe's distance from the plane to the scatter of the other probes.
const MIN_ODD_RATIO: f64 = 4.0;

const PLANE_DEGREES_OF_FREEDOM: f64 = 3.0;

/// A probe that does not fit the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OddProbe {
    /// Index of the probe, in the given order.
    pub probe: usize,
    /// How much higher the probe was measured than the best-fitting plane of the others, in mm.
    pub off: f64,
}

/// Returns the odd probes in order. Each probe is given by its position and by how much higher than drawn it was measured, in mm.
pub fn odd_probes(probes: &[(Xy, f64)]) -> Vec<OddProbe> {
    if probes.len() < 5 {
        return Vec::new();
    }
    let fit = PlaneFit::new(probes);
    let odd = probes.iter().enumerate().filter_map(|(probe, measured)| {
        let off = fit.distance_if_odd(*measured)?;
        Some(OddProbe { probe, off })
    });
    odd.collect()
}

/// The plane with the smallest sum of squared distances from all probes.
struct PlaneFit {
    scatter: Scatter,
    inverse: Matrix2<f64>,
    mean: f64,
    slope: Vector2<f64>,
    /// Sum of squared distances, in mm².
    residue: f64,
}

impl PlaneFit {
    fn new(probes: &[(Xy, f64)]) -> Self {
        let places: Vec<Xy> = probes.iter().map(|(place, _)| *place).collect();
        let scatter = Scatter::new(&places);
        let inverse = scatter.inverse();
        let mean = probes.iter().map(|(_, off)| off).sum::<f64>() / scatter.count;
        let slope = inverse
            * probes.iter().map(|(place, off)| (place - scatter.middle) * (off - mean)).sum::<Vector2<f64>>();
        let mut fit = Self { scatter, inverse, mean, slope, residue: 0.0 };
        fit.residue = probes.iter().map(|probe| fit.residual(*probe)).map(|off| off * off).sum();
        fit
    }

    fn residual(&self, (place, off): (Xy, f64)) -> f64 {
        off - self.mean - self.slope.dot(&(place - self.scatter.middle))
    }

    /// Returns the distance of a probe from the best-fitting plane of the others, if the probe is odd. That plane need not be computed: it follows
    /// from the influence of the probe on the plane of all probes.
    fn distance_if_odd(&self, probe: (Xy, f64)) -> Option<f64> {
        let place = probe.0 - self.scatter.middle;
        if !self.scatter.without(probe.0).is_wide() {
            return None;
        }
        let free = 1.0 - 1.0 / self.scatter.count - place.dot(&(self.inverse * place));
        let residual = self.residual(probe);
        let off = residual / free;
        let others =
            (self.residue - residual * off).max(0.0) / (self.scatter.count - 1.0 - PLANE_DEGREES_OF_FREEDOM);
        let expected = libm::sqrt(others / free);
        (off.abs() > MIN_REPORTED_DEVIATION && off.abs() > MIN_ODD_RATIO * expected).then_some(off)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Triangulation {
    places: Vec<ProbedPoint>,
    triangles: Vec<[usize; 3]>,
    /// The edges of the hull, or the segments of the line if all probes are collinear.
    border: Vec<[usize; 2]>,
    /// Bounding boxes of the triangles, with their indices.
    boxes: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
    edges: RTree<GeomWithData<Line<[f64; 2]>, usize>>,
}

/// One or more probes at the same position.
#[derive(Clone, Debug)]
struct ProbedPoint {
    at: Xy,
    probes: Vec<usize>,
}

/// Distance outside a triangle, as a fraction of its size, up to which a point is considered inside.
const ROUNDING: f64 = 1e-9;

/// Difference of squared distances in mm² below which the tree may order edges wrongly, so that they are compared exactly.
const DISTANCE_TOLERANCE: f64 = 1e-12;

impl Triangulation {
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
        let boxes =
            triangles.iter().map(|corners| enlarged(AABB::from_points(&corners.each_ref().map(corner))));
        let edges =
            border.iter().map(|edge| edge.each_ref().map(corner)).map(|[from, to]| Line::new(from, to));
        Self { boxes: indexed_tree(boxes), edges: indexed_tree(edges), places, triangles, border }
    }

    fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        match self.containing_triangle(at) {
            Some((number, parts)) => self.shared_weights(self.triangles[number].into_iter().zip(parts)),
            None => self.border_weights(at),
        }
    }

    /// Returns the distance in mm from the triangles (or from the line or the single probe); 0 inside.
    pub(crate) fn distance(&self, at: Xy) -> f64 {
        if self.containing_triangle(at).is_some() {
            return 0.0;
        }
        match self.nearest(at) {
            Some((_, _, distance)) => distance,
            None => self.places.first().map_or(0.0, |place| (place.at - at).norm()),
        }
    }

    /// Returns the first triangle that contains a point, with the barycentric coordinates of the point.
    fn containing_triangle(&self, at: Xy) -> Option<(usize, [f64; 3])> {
        let near = self.boxes.locate_in_envelope_intersecting(AABB::from_point([at.x, at.y]));
        let around = near.filter_map(|candidate| {
            Some((candidate.data, self.barycentric(self.triangles[candidate.data], at)?))
        });
        around.min_by_key(|(number, _)| *number)
    }

    /// Returns the barycentric coordinates of a point with respect to a triangle, if the point is inside.
    fn barycentric(&self, corners: [usize; 3], at: Xy) -> Option<[f64; 3]> {
        let [a, b, c] = corners.map(|corner| self.places[corner].at);
        let (ab, ac, ap) = (b - a, c - a, at - a);
        let area = ab.perp(&ac);
        let (of_b, of_c) = (ap.perp(&ac) / area, ab.perp(&ap) / area);
        let parts = [1.0 - of_b - of_c, of_b, of_c];
        // A triangle without area contains nothing, because at least one of the coordinates is NaN or negative infinity.
        parts.iter().all(|part| *part >= -ROUNDING).then_some(parts)
    }

    fn border_weights(&self, at: Xy) -> Vec<(usize, f64)> {
        match self.nearest(at) {
            Some(([start, end], along, _)) => self.shared_weights([(start, 1.0 - along), (end, along)]),
            None => self.shared_weights(self.places.first().map(|_| (0, 1.0))),
        }
    }

    /// Returns the nearest edge (the first if there are several), the fraction along it of its nearest point, and the distance in mm.
    fn nearest(&self, at: Xy) -> Option<([usize; 2], f64, f64)> {
        let mut near = self.edges.nearest_neighbor_iter_with_distance_2([at.x, at.y]).peekable();
        let (_, least) = *near.peek()?;
        let near =
            near.take_while(|(_, distance)| *distance <= least * (1.0 + ROUNDING) + DISTANCE_TOLERANCE);
        let nearest = near.map(|(edge, _)| (self.along(edge.data, at), edge.data));
        let first =
            nearest.min_by(|((_, a), first), ((_, b), second)| a.total_cmp(b).then(first.cmp(second)));
        first.map(|((along, distance), edge)| (self.border[edge], along, distance))
    }

    /// Returns the fraction along an edge of its point nearest to `at`, and the distance in mm.
    fn along(&self, edge: usize, at: Xy) -> (f64, f64) {
        let [start, end] = self.border[edge].map(|place| self.places[place].at);
        let way = end - start;
        let along = ((at - start).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
        (along, (start + way * along - at).norm())
    }

    /// Divides the weight of a position among its probes.
    fn shared_weights(&self, parts: impl IntoIterator<Item = (usize, f64)>) -> Vec<(usize, f64)> {
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
fn enlarged(tight: AABB<[f64; 2]>) -> Rectangle<[f64; 2]> {
    let (lower, upper) = (tight.lower(), tight.upper());
    let margin = 4.0 * ROUNDING * (upper[0] - lower[0]).max(upper[1] - lower[1]);
    Rectangle::from_corners(
        lower.map(|coordinate| coordinate - margin),
        upper.map(|coordinate| coordinate + margin),
    )
}

fn indexed_tree<T: rstar::RTreeObject>(shapes: impl Iterator<Item = T>) -> RTree<GeomWithData<T, usize>> {
    RTree::bulk_load(shapes.enumerate().map(|(number, shape)| GeomWithData::new(shape, number)).collect())
}

/// Groups probes by position. Positions that would be written identically in a program are the same.
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

#[expect(clippy::cast_possible_truncation, reason = "saturates: no program reaches so far")]
fn micrometres(millimetres: f64) -> i64 {
    (millimetres * 1000.0).round_ties_even() as i64
}
