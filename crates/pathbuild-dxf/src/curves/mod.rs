//! Curves that are no arcs, approximated by arcs. (spec/06-configuration.md, `approximate-curves`)

mod approximate;
mod biarc;
mod vector;

pub(crate) use approximate::{Curve, Tolerance, TooManyPieces, approximate};
pub(crate) use vector::Vector;
