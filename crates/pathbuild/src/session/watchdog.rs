//! Gives up paths that take longer than `seconds-per-path`. (spec/06-configuration.md, `[limits]`)

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use pathbuild_db::{Database, Underway};

/// What is being worked on, for a thread that looks at it now and then.
pub(super) struct Watchdog {
    limit: Duration,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    underway: Vec<Option<Underway>>,
    is_over: bool,
}

/// Work that is watched until this is dropped.
pub(super) struct Watched<'a> {
    watchdog: &'a Watchdog,
    place: usize,
}

impl Watchdog {
    pub(super) fn new(limit: Duration) -> Self {
        Self { limit, state: Mutex::default(), changed: Condvar::new() }
    }

    /// Runs some work while a thread watches what it begins.
    pub(super) fn during<R>(&self, work: impl FnOnce() -> R) -> R {
        std::thread::scope(|scope| {
            scope.spawn(|| self.watch());
            let over = Over(self);
            let result = work();
            drop(over);
            result
        })
    }

    pub(super) fn begin(&self, db: &Database) -> Watched<'_> {
        let mut state = self.state();
        let free = state.underway.iter().position(Option::is_none);
        let place = free.unwrap_or_else(|| {
            state.underway.push(None);
            state.underway.len() - 1
        });
        state.underway[place] = Some(db.underway());
        Watched { watchdog: self, place }
    }

    fn watch(&self) {
        // Seldom enough to cost nothing, often enough for limits of a second.
        let pause = (self.limit / 4).clamp(Duration::from_millis(10), Duration::from_millis(500));
        let mut state = self.state();
        while !state.is_over {
            let waited = self.changed.wait_timeout(state, pause).unwrap_or_else(PoisonError::into_inner);
            state = waited.0;
            for underway in state.underway.iter().flatten() {
                underway.stop_after(self.limit);
            }
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // The list is whole whenever the lock is free: nothing panics in between.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Watched<'_> {
    fn drop(&mut self) {
        self.watchdog.state().underway[self.place] = None;
    }
}

/// Tells the watching thread that the work is over, also when it panics.
struct Over<'a>(&'a Watchdog);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.state().is_over = true;
        self.0.changed.notify_all();
    }
}
