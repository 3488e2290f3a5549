//! Why a request has no outcome, for all requests alike.

use pathbuild_diagnostic::Diagnostic;

/// Why a request has no outcome.
#[derive(Debug)]
pub enum Failure {
    /// The request is invalid, for this reason in the language of messages.
    Usage(String),
    /// The post-processor does not exist, or is broken.
    Post(Vec<Diagnostic>),
    /// What the request is about has these errors, or is unknown.
    Found(Vec<Diagnostic>),
}
