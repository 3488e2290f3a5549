//! Embedding: the properties of a path that matter to embedding paths, and whether a path fits a subpath segment. These are pure functions
//! from values to diagnostics; callers provide the paths. (book: language/embedding)

mod judge;
mod near;
mod raised;
mod restriction;
mod signature;
mod sweep;

pub use judge::Judge;
pub use near::with_near_names;
pub use raised::ProbeTop;
pub use restriction::Restriction;
pub use signature::{PathHeader, PathSignature, SubpathCall};
pub use sweep::SweepLimits;
