//! What a run found, made ready to be shown: severities applied, each finding once, in an order that does not depend on threads.
//! (book: reference/commands, book: reference/diagnostics)

mod baseline;
mod conclude;
mod findings;
mod fingerprint;
mod judge;
mod summary;

pub use baseline::Baseline;
pub use conclude::conclude;
pub use findings::Findings;
pub use fingerprint::Fingerprint;
pub use judge::judge;
pub use pathbuild_workspace::check::CheckedFile;
pub use summary::summary;
