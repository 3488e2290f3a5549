//! Models the height of the material between probes. (book: language/probes)
//!
//! The models describe the correction, that is, by how much the material is higher than drawn. At each point it is a linear combination of
//! the
//! corrections at the probes. Therefore a [`Surface`] depends only on their positions, and a program made with it is valid until they move.

mod nearest;
mod odd;
mod plane;
mod scatter;
mod tin;

use pathbuild_path::Xy;

use nearest::Nearest;
use plane::Plane;
pub(crate) use tin::Tin;

pub use odd::{OddProbe, odd_probes};

/// How heights between probes are interpolated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ZModel {
    /// The four nearest probes, weighted by the inverse of their distance. It distorts planes, and it is discontinuous where the selection
    /// changes.
    #[default]
    Idw4,
    /// The best-fitting plane (least squares). One probe gives a constant height; two probes, or probes on a line, give no slope across the
    /// line.
    Plane,
    /// Triangles between the probes (Delaunay); outside of them the value at the nearest edge. For probes on a line, the value at its
    /// nearest
    /// point.
    Tin,
}

/// A model for probes at given positions.
#[derive(Clone, Debug)]
pub struct Surface {
    model: Model,
}

#[derive(Clone, Debug)]
enum Model {
    Nearest(Nearest),
    Plane(Plane),
    Tin(Tin),
}

impl Surface {
    /// Creates a model for probes at these positions.
    pub fn new(model: ZModel, places: &[Xy]) -> Self {
        let model = match model {
            ZModel::Idw4 => Model::Nearest(Nearest::new(places)),
            ZModel::Plane => Model::Plane(Plane::new(places)),
            ZModel::Tin => Model::Tin(Tin::new(places)),
        };
        Self { model }
    }

    /// The weight of each probe at a point: indices of probes with weights whose sum is 1. Probes with weight 0 may be omitted. Empty if
    /// there
    /// are no probes.
    pub fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        match &self.model {
            Model::Nearest(nearest) => nearest.weights(at),
            Model::Plane(plane) => plane.weights(at),
            Model::Tin(tin) => tin.weights(at),
        }
    }
}
