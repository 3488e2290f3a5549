//! Findings at the end of a run: baseline, display, summary, pictures. (book: reference/commands, book: reference/diagnostics)

mod baseline;
mod conclude;
mod fingerprint;
mod pictures;
mod summary;

pub use baseline::Baseline;
pub use conclude::conclude;
pub use fingerprint::Fingerprint;
pub use pathbuild_workspace::check::CheckedFile;
pub use pathbuild_workspace::findings::{Findings, judge};
pub(crate) use pictures::{pictures, write as write_pictures};
pub use summary::summary;
