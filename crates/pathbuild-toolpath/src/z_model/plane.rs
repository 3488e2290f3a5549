use nalgebra::{Matrix2, Vector2};
use pathbuild_path::Xy;

use super::scatter::Scatter;

/// The least-squares plane.
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

    pub(super) fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        let even = 1.0 / self.offsets.len() as f64;
        let slope = self.inverse * (at - self.middle);
        self.offsets.iter().map(|offset| even + slope.dot(offset)).enumerate().collect()
    }
}
