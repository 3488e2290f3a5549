//! What a run found, made ready to be shown: severities applied, each finding once, in an order that does not depend on threads.
//! (spec/05-command-line.md, spec/80-diagnostics.md)

mod findings;

pub use findings::{CheckedFile, CheckedPath, Findings};
