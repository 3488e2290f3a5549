//! Guarding work on one target: what takes too long is given up, what panics is reported, and neither keeps the others from being done.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files as messages;
use salsa::{CancellationToken, Cancelled, Database as _};

use crate::database::Database;
use crate::queries::internal_error;

/// Work that is under way over one handle of the database.
#[derive(Debug)]
pub struct Underway {
    begun: Instant,
    token: CancellationToken,
}

impl Underway {
    /// Gives up the work if it has taken longer than this.
    pub fn stop_after(&self, limit: Duration) {
        if self.begun.elapsed() > limit {
            self.token.cancel();
        }
    }
}

impl Database {
    /// Work that begins now on this handle.
    pub fn underway(&self) -> Underway {
        Underway { begun: Instant::now(), token: self.cancellation_token() }
    }

    /// Does some work on this handle.
    ///
    /// # Errors
    /// PB005 when it was given up, PB006 when it panicked; without a place.
    pub fn guarded<R>(&self, limit: Duration, work: impl FnOnce() -> R) -> Result<R, Box<Diagnostic>> {
        catch_unwind(AssertUnwindSafe(work))
            .map_err(|payload| match payload.downcast_ref::<Cancelled>() {
                Some(_) => Diagnostic::new(&messages::LIMIT)
                    .with("what", "the time that this path takes")
                    .with("limit", format!("{} s", limit.as_secs_f64()))
                    .with("key", "seconds-per-path"),
                None => internal_error(&*payload),
            })
            .map_err(Box::new)
    }
}
