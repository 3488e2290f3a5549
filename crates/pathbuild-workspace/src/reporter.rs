//! Progress messages. Results are returned; these messages are for the waiting user.

use std::fmt::Debug;

/// Receives progress messages of a run.
pub trait Reporter: Debug {
    /// A line about the run.
    fn status(&self, line: &str);
    /// A line of detail, shown only on request.
    fn detail(&self, line: &str);
    /// Starts a progress display of `total` items; it ends when the returned value is dropped.
    fn progress(&self, total: usize) -> Box<dyn Advance>;
}

/// Counts finished items.
pub trait Advance: Debug + Send + Sync {
    /// Counts one more finished item. May be called from any thread.
    fn advance(&self);
}

/// Discards all messages.
#[derive(Clone, Copy, Debug, Default)]
pub struct SilentReporter;

impl Reporter for SilentReporter {
    fn status(&self, _: &str) {}

    fn detail(&self, _: &str) {}

    fn progress(&self, _: usize) -> Box<dyn Advance> {
        Box::new(Self)
    }
}

impl Advance for SilentReporter {
    fn advance(&self) {}
}
