use nalgebra::{Matrix2, Vector2};
use pathbuild_path::Xy;

/// If the extent of points across their main direction is less than this fraction of their extent along it, they are treated as collinear,
/// because they say nothing reliable about the slope across.
const FLAT: f64 = 0.01;

/// Points whose average distance from their mean is less than this, in mm, are treated as a single point.
const NOTHING: f64 = 0.001;

/// The distribution of points around their mean, as a matrix of second moments in mm².
#[derive(Clone, Copy, Debug)]
pub(super) struct Scatter {
    pub(super) count: f64,
    pub(super) middle: Xy,
    moments: Matrix2<f64>,
}

impl Scatter {
    /// Computes it for one or more points.
    pub(super) fn new(points: &[Xy]) -> Self {
        let count = points.len() as f64;
        let sum = points.iter().fold(Vector2::zeros(), |sum, point| sum + point.coords);
        let middle = Xy::from(sum / count);
        let moments = points.iter().map(|point| point - middle).map(|d| d * d.transpose()).sum();
        Self { count, middle, moments }
    }

    /// The distribution without one of the points.
    pub(super) fn without(&self, point: Xy) -> Self {
        let (d, count) = (point - self.middle, self.count - 1.0);
        let moments = self.moments - d * d.transpose() * (self.count / count);
        Self { count, middle: self.middle - d / count, moments }
    }

    /// Whether the points span a plane.
    pub(super) fn is_wide(&self) -> bool {
        let (long, short) = self.principal();
        short > FLAT * FLAT * long && !self.is_point()
    }

    /// The matrix that converts a position to the contribution of each point to the slope: the inverse of the moments. For collinear points
    /// it
    /// only has a component along the line, and for a single point it is zero.
    pub(super) fn inverse(&self) -> Matrix2<f64> {
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
        self.moments.trace() <= self.count * NOTHING * NOTHING
    }

    /// The moments along the main direction and across it.
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

    /// The main direction.
    fn direction(&self) -> Vector2<f64> {
        let (difference, eccentricity) = (self.difference(), self.eccentricity());
        // Of the two forms of the eigenvector, use the one without cancellation.
        let along = if difference >= 0.0 {
            Vector2::new(eccentricity + difference, self.moments.m12)
        } else {
            Vector2::new(self.moments.m12, eccentricity - difference)
        };
        along / along.norm()
    }
}
