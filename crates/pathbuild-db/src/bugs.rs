//! Ends of queries other than a result: bugs, time limits, and drawings that change during a run.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::time::Duration;

use pathbuild_diagnostic::limits::{TIME_OF_PATH, exceeded, seconds};
use pathbuild_diagnostic::messages::files as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use salsa::Cancelled;

/// Panic payload of work that exceeded this time limit.
pub(crate) struct TimeoutPanic(pub(crate) Duration);

/// Runs work that usually makes no queries. If it makes one that unwinds because its drawing has changed, that counts as a bug here.
/// Cancellation is passed on.
///
/// # Errors
/// PB006 if it panicked, PB005 if it exceeded its time limit; both without a place.
pub fn catch_bugs<R>(work: impl FnOnce() -> R) -> Result<R, Box<Diagnostic>> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| {
        if payload.is::<Cancelled>() {
            resume_unwind(payload);
        }
        let too_long = payload.downcast_ref().map(|TimeoutPanic(limit)| too_slow(*limit));
        Box::new(too_long.unwrap_or_else(|| internal_error(&*payload)))
    })
}

/// PB006 for the payload of a panic.
pub(crate) fn internal_error(payload: &(dyn Any + Send)) -> Diagnostic {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let reason = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
    bug(&reason)
}

/// PB006 with this reason, without a place.
pub fn bug(reason: &str) -> Diagnostic {
    Diagnostic::new(&messages::INTERNAL).with("reason", Value::foreign(reason))
}

/// Panic payload of a query that read other bytes than those the drawing was indexed by. No result may mix the two.
pub(crate) struct DriftPanic;

/// PB005 for work beyond this time limit, without a place.
pub fn too_slow(limit: Duration) -> Diagnostic {
    exceeded(&TIME_OF_PATH, seconds(limit), "seconds-per-path")
}
