//! Worker threads, which start and reserve their memory before there is work for them, and the watchdog that cancels work exceeding its time
//! limit.

use std::hint::black_box;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use pathbuild_db::{Database, WorkInProgress};
use rayon::{ThreadPool, ThreadPoolBuilder};

#[derive(Debug)]
pub(super) struct Workers {
    pool: ThreadPool,
    /// Becomes true when there is work, so that the threads stop reserving memory.
    has_work: Arc<AtomicBool>,
}

/// Stack size of worker threads in bytes. Queries recurse once per level of embedding.
const STACK_SIZE: usize = 16 << 20;

impl Workers {
    /// Starts `count` threads, or one per core, without waiting for them; `None` if the system provides none. The calling thread is not part of the
    /// pool: when it was, the only other thread on a machine with two cores often started on the caller's core and stayed there for 5 to 10 ms.
    pub(super) fn start(count: Option<u16>) -> Option<Self> {
        let has_work = Arc::new(AtomicBool::new(false));
        let until = Arc::clone(&has_work);
        let threads = usize::from(count.unwrap_or(0));
        let pool = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_SIZE);
        let pool = pool.start_handler(move |_| reserve_memory(&until)).build().ok()?;
        Some(Self { pool, has_work })
    }

    pub(super) fn count(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Runs work that uses the threads through rayon.
    pub(super) fn work<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.has_work.store(true, Ordering::Relaxed);
        self.pool.install(work)
    }
}

/// Allocates the memory that a thread will need in one piece and frees it again, so that it is available later. Otherwise glibc requests a thread's
/// memory page by page while all other threads wait. glibc keeps at most twice the size of the largest piece that it has returned to the system,
/// which is why one piece is allocated and freed first.
fn reserve_memory(has_work: &AtomicBool) {
    drop(allocate_block());
    touch_pages(&mut allocate_block(), has_work);
}

/// Allocates a block of memory without touching it; a smaller one if the system has less.
fn allocate_block() -> Vec<u8> {
    const RESERVED: usize = 16 << 20;
    let mut memory = Vec::new();
    _ = black_box(&mut memory).try_reserve_exact(RESERVED);
    memory
}

/// Touches the first pages of the block until there is work, so that the work does not have to wait for each page.
fn touch_pages(memory: &mut Vec<u8>, has_work: &AtomicBool) {
    const PAGE: usize = 4 << 10;
    /// Number of pages touched: roughly the size of the results of a few hundred drawings.
    const PAGES: usize = 384;
    for page in memory.spare_capacity_mut().chunks_mut(PAGE).take(PAGES) {
        if has_work.load(Ordering::Relaxed) {
            break;
        }
        page[0].write(0);
    }
    black_box(memory);
}

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
    in_progress: Vec<Option<WorkInProgress>>,
    is_over: bool,
}

/// A guard for work that is being watched; dropping it ends the watch.
pub(super) struct WatchGuard<'a> {
    watchdog: &'a Watchdog,
    db: &'a Database,
    place: usize,
}

impl Watchdog {
    /// Starts the thread. If the system has no thread left, work has no time limit.
    pub(super) fn start(limit: Duration) -> Self {
        let shared = Arc::new(SharedState { limit, state: Mutex::default(), changed: Condvar::new() });
        let watching = Arc::clone(&shared);
        _ = thread::Builder::new().name("watchdog".into()).spawn(move || watching.watch());
        Self(shared)
    }

    pub(super) fn begin<'a>(&'a self, db: &'a Database) -> WatchGuard<'a> {
        let mut state = self.0.state();
        let free = state.in_progress.iter().position(Option::is_none);
        let place = free.unwrap_or_else(|| {
            state.in_progress.push(None);
            state.in_progress.len() - 1
        });
        state.in_progress[place] = Some(db.begin_work());
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
        self.watchdog.0.state().in_progress[self.place] = None;
        // Clear a cancellation that arrived at the very moment when the work ended.
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
            for work in state.in_progress.iter().flatten() {
                work.stop_after(self.limit);
            }
        }
    }

    fn state(&self) -> MutexGuard<'_, WorkList> {
        // Nothing panics while the lock is held, so the list is consistent even if the lock is poisoned.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
