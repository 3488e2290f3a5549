//! Guards work on one target with a time limit and a panic handler, so that one target cannot stop the others.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::limits::{TIME_OF_PATH, exceeded, seconds};
use pathbuild_diagnostic::messages::files as messages;
use pathbuild_diagnostic::reasons::CHANGES_WHILE_READ;
use salsa::{CancellationToken, Cancelled, Database as _};

use crate::bugs::{TimeoutPanic, internal_error};
use crate::database::Database;
use crate::db::Db as _;
use crate::drift::DriftPanic;

/// Work in progress on one handle of the database.
#[derive(Debug)]
pub struct WorkInProgress {
    /// Start time; `None` without a clock.
    begun: Option<Instant>,
    token: CancellationToken,
}

impl WorkInProgress {
    /// Cancels the work if it exceeds this time limit.
    pub fn stop_after(&self, limit: Duration) {
        if self.begun.is_some_and(|begun| begun.elapsed() > limit) {
            self.token.cancel();
        }
    }
}

impl Database {
    /// Clears a cancellation whose work has ended, so that it does not cancel the next query.
    pub fn clear_cancellation(&self) {
        // Salsa clears it at the end of every query that was not called by another.
        self.attach(|_| ());
    }

    /// Cancels the current work, between two queries, if it exceeds its time limit.
    pub fn check_time_limit(&self) {
        self.unwind_if_revision_cancelled();
    }

    /// Starts the clock for work on this handle.
    pub fn underway(&self) -> WorkInProgress {
        WorkInProgress { begun: self.system().now(), token: self.cancellation_token() }
    }

    /// Runs work on this handle.
    ///
    /// # Errors
    /// PB005 if it exceeded the time limit, PB001 if a drawing changed meanwhile, PB006 if it panicked; all without a place.
    pub fn guarded<R>(&self, limit: Duration, work: impl Fn() -> R) -> Result<R, Box<Diagnostic>> {
        loop {
            let payload = match catch_unwind(AssertUnwindSafe(&work)) {
                Ok(result) => return Ok(result),
                Err(payload) => payload,
            };
            let problem = match payload.downcast_ref::<Cancelled>() {
                // The query panicked on another thread. Running it here gives the reason, if it panics again.
                Some(Cancelled::PropagatedPanic) => continue,
                Some(_) => too_slow(limit),
                None if payload.is::<DriftPanic>() => {
                    Diagnostic::new(&messages::UNREADABLE).with("reason", &CHANGES_WHILE_READ)
                }
                None if payload.is::<TimeoutPanic>() => too_slow(limit),
                None => internal_error(&*payload),
            };
            return Err(Box::new(problem));
        }
    }
}

/// PB005 for work beyond this time limit, without a place.
pub fn too_slow(limit: Duration) -> Diagnostic {
    exceeded(&TIME_OF_PATH, seconds(limit), "seconds-per-path")
}
