//! Embedding: what a path shows to the paths that embed it, and whether a path may stand where a subpath segment names it. Values in,
//! diagnostics out: where the paths come from is the caller's business. (book: language/embedding)

mod judge;
mod near;
mod raised;
mod restriction;
mod signature;
mod sweep;

pub use judge::Judge;
pub use near::near_names;
pub use raised::ProbeTop;
pub use restriction::Restriction;
pub use signature::{PathHeader, PathSignature, SubpathCall};
pub use sweep::SweepLimits;
