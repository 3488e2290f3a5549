//! Guarding work on one target: what takes too long is given up, what panics is reported, and neither keeps the others from being done.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files as messages;
use salsa::{CancellationToken, Cancelled, Database as _};

use crate::bugs::{TooLong, internal_error};
use crate::database::Database;
use crate::db::Db as _;
use crate::drift::Drifted;

/// Work that is under way over one handle of the database.
#[derive(Debug)]
pub struct Underway {
    /// `None`: there is no clock.
    begun: Option<Instant>,
    token: CancellationToken,
}

impl Underway {
    /// Gives up the work if it has taken longer than this.
    pub fn stop_after(&self, limit: Duration) {
        if self.begun.is_some_and(|begun| begun.elapsed() > limit) {
            self.token.cancel();
        }
    }
}

impl Database {
    /// Forgets that work was given up which has ended: what is asked next is not meant.
    pub fn forget_given_up(&self) {
        // Salsa does so whenever a query ends that no other asked for.
        self.attach(|_| ());
    }

    /// Gives up the work here, between two queries, if it has taken too long.
    pub fn give_up_if_late(&self) {
        self.unwind_if_revision_cancelled();
    }

    /// Work that begins now on this handle.
    pub fn underway(&self) -> Underway {
        Underway { begun: self.system().now(), token: self.cancellation_token() }
    }

    /// Does some work on this handle.
    ///
    /// # Errors
    /// PB005 when it was given up, PB001 when a drawing changed meanwhile, PB006 when it panicked; without a place.
    pub fn guarded<R>(&self, limit: Duration, work: impl Fn() -> R) -> Result<R, Box<Diagnostic>> {
        loop {
            let payload = match catch_unwind(AssertUnwindSafe(&work)) {
                Ok(result) => return Ok(result),
                Err(payload) => payload,
            };
            let problem = match payload.downcast_ref::<Cancelled>() {
                // A query that another thread was running has panicked there. If it panics here too, it is known why.
                Some(Cancelled::PropagatedPanic) => continue,
                Some(_) => too_slow(limit),
                None if payload.is::<Drifted>() => {
                    Diagnostic::new(&messages::UNREADABLE).with("reason", "it changes while it is being read")
                }
                None if payload.is::<TooLong>() => too_slow(limit),
                None => internal_error(&*payload),
            };
            return Err(Box::new(problem));
        }
    }
}

/// PB005 for work that took longer than this, without a place.
pub fn too_slow(limit: Duration) -> Diagnostic {
    Diagnostic::new(&messages::LIMIT)
        .with("what", "the time that this path takes")
        .with("limit", format!("{} s", limit.as_secs_f64()))
        .with("key", "seconds-per-path")
}
