//! What is said while work goes on. Results are returned; this is for whoever waits for them.

use std::fmt::Debug;

/// Hears how a run goes on.
pub trait Reporter: Debug {
    /// A line about the run.
    fn status(&self, line: &str);
    /// A line that few want to know.
    fn detail(&self, line: &str);
    /// So many pieces of work begin, and are over when what is given back is dropped.
    fn progress(&self, total: usize) -> Box<dyn Advance>;
}

/// Counts pieces of work.
pub trait Advance: Debug + Send + Sync {
    /// One more is done. Any thread may say so.
    fn advance(&self);
}

/// Tells nobody.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Reporter for Silent {
    fn status(&self, _: &str) {}

    fn detail(&self, _: &str) {}

    fn progress(&self, _: usize) -> Box<dyn Advance> {
        Box::new(Self)
    }
}

impl Advance for Silent {
    fn advance(&self) {}
}
