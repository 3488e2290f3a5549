//! Approximates curves other than arcs by arcs. (book: reference/configuration, `approximate-curves`)

mod approximate;
mod biarc;
mod vector;

pub(crate) use approximate::{Curve, NoPieces, Tolerance, approximate};
pub(crate) use vector::Vector;
