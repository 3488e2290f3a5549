//! Cancels paths that take longer than `seconds-per-path`. (book: reference/configuration, `[limits]`)

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use pathbuild_db::{Database, WorkInProgress};

/// Background thread that cancels work exceeding its time limit; stops when dropped, and is never joined.
#[derive(Debug)]
pub(super) struct Watchdog(Arc<SharedState>);

#[derive(Debug)]
struct SharedState {
    limit: Duration,
    state: Mutex<WorkList>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct WorkList {
    underway: Vec<Option<WorkInProgress>>,
    is_over: bool,
}

/// Work item being watched; dropping it ends the watch.
pub(super) struct WatchGuard<'a> {
    watchdog: &'a Watchdog,
    db: &'a Database,
    place: usize,
}

impl Watchdog {
    /// Starts the thread. If the system has no thread left, work is not limited in time.
    pub(super) fn start(limit: Duration) -> Self {
        let shared = Arc::new(SharedState { limit, state: Mutex::default(), changed: Condvar::new() });
        let watching = Arc::clone(&shared);
        _ = thread::Builder::new().name("watchdog".into()).spawn(move || watching.watch());
        Self(shared)
    }

    pub(super) fn begin<'a>(&'a self, db: &'a Database) -> WatchGuard<'a> {
        let mut state = self.0.state();
        let free = state.underway.iter().position(Option::is_none);
        let place = free.unwrap_or_else(|| {
            state.underway.push(None);
            state.underway.len() - 1
        });
        state.underway[place] = Some(db.underway());
        WatchGuard { watchdog: self, db, place }
    }
}

impl Drop for Watchdog {
    fn drop(&mut self) {
        self.0.state().is_over = true;
        self.0.changed.notify_all();
    }
}

impl Drop for WatchGuard<'_> {
    fn drop(&mut self) {
        self.watchdog.0.state().underway[self.place] = None;
        // The work may have been cancelled at the very moment when it ended.
        self.db.clear_cancellation();
    }
}

impl SharedState {
    fn watch(&self) {
        // Poll rarely enough to be free, but often enough to enforce one-second limits.
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

    fn state(&self) -> MutexGuard<'_, WorkList> {
        // Nothing panics while the lock is held, so the list is consistent even if the lock is poisoned.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
