//! The height of the material between probes. (book: language/probes)
//!
//! What is modelled is the correction: how much higher than drawn the material lies. At any point it is a linear combination of the
//! corrections at the probes, so a [`Surface`] knows the probes' places only, and a program made with it holds until they move.

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

/// How heights between probes are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ZModel {
    /// The four nearest probes, weighted by the inverse of their distance. Bends a plane, and jumps where the four change.
    #[default]
    Idw4,
    /// The plane that fits best (least squares). One probe: as high everywhere. Two, or all on a line: no slope across the line.
    Plane,
    /// Triangles between the probes (Delaunay); outside of them as on the nearest edge. Probes on a line: as on the nearest point of it.
    Tin,
}

/// A model over the places of probes.
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
    /// Fits a model to probes at these places.
    pub fn new(model: ZModel, places: &[Xy]) -> Self {
        let model = match model {
            ZModel::Idw4 => Model::Nearest(Nearest::new(places)),
            ZModel::Plane => Model::Plane(Plane::new(places)),
            ZModel::Tin => Model::Tin(Tin::new(places)),
        };
        Self { model }
    }

    /// How much each probe counts at a point: numbers of probes with weights that sum to 1. Probes that do not count may be left out.
    /// Empty where there are no probes.
    pub fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        match &self.model {
            Model::Nearest(nearest) => nearest.weights(at),
            Model::Plane(plane) => plane.weights(at),
            Model::Tin(tin) => tin.weights(at),
        }
    }
}
