//! Panics: bugs that one drawing shows must not keep the others from being compiled.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::time::Duration;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files as messages;
use salsa::Cancelled;

use crate::guard::too_slow;

/// What work unwinds with that has taken longer than this.
pub(crate) struct TooLong(pub(crate) Duration);

/// Does some work, mostly without queries: what a query unwinds with where a drawing changes meanwhile counts as a bug here. Where it is given
/// up because its result is no longer wanted, that is passed on.
///
/// # Errors
/// PB006 when it panicked, PB005 when it took too long; without a place.
pub fn catch_bugs<R>(work: impl FnOnce() -> R) -> Result<R, Box<Diagnostic>> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| {
        if payload.is::<Cancelled>() {
            resume_unwind(payload);
        }
        let too_long = payload.downcast_ref().map(|TooLong(limit)| too_slow(*limit));
        Box::new(too_long.unwrap_or_else(|| internal_error(&*payload)))
    })
}

/// PB006 for a panic.
pub(crate) fn internal_error(payload: &(dyn Any + Send)) -> Diagnostic {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let reason = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
    bug(&reason)
}

/// PB006, without a place.
pub fn bug(reason: &str) -> Diagnostic {
    Diagnostic::new(&messages::INTERNAL).with("reason", reason)
}
