//! Worker threads. They come to life, and get their memory ready, while nobody has work for them yet.

use std::hint::black_box;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::{ThreadPool, ThreadPoolBuilder};

/// Threads that work is shared out among.
#[derive(Debug)]
pub(super) struct Workers {
    pool: ThreadPool,
    /// Whether there is work.
    is_wanted: Arc<AtomicBool>,
}

/// Stacks of worker threads: queries call each other once for each level of embedding.
const STACK_SIZE: usize = 16 << 20;

impl Workers {
    /// So many threads, or as many as there are cores; `None` where the system gives none. It is not waited for them. This one is not among them:
    /// where it was, and there were two cores, the other was often begun on the core of this one and stayed there for 5 to 10 ms.
    pub(super) fn start(count: Option<u16>) -> Option<Self> {
        let is_wanted = Arc::new(AtomicBool::new(false));
        let until = Arc::clone(&is_wanted);
        let threads = usize::from(count.unwrap_or(0));
        let pool = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_SIZE);
        let pool = pool.start_handler(move |_| reserve_memory(&until)).build().ok()?;
        Some(Self { pool, is_wanted })
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Does work that shares itself out.
    pub(super) fn work<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.is_wanted.store(true, Ordering::Relaxed);
        self.pool.install(work)
    }
}

/// Takes at one go what a thread will need, and gives it back at once, so that it is at hand. glibc asks the system for a thread's memory page by
/// page as it is used, each time while all other threads wait, unless there was more than that; and it keeps no more than twice the largest piece
/// that was given back to the system itself, as the first one here is.
fn reserve_memory(is_wanted: &AtomicBool) {
    drop(reserved());
    touch(&mut reserved(), is_wanted);
}

/// Memory of which nothing is used before it is needed. Where there is not as much, it comes as it is needed.
fn reserved() -> Vec<u8> {
    const RESERVED: usize = 16 << 20;
    let mut memory = Vec::new();
    _ = black_box(&mut memory).try_reserve_exact(RESERVED);
    memory
}

/// Uses the first pages of memory once, until there is work: it would wait for each of them.
fn touch(memory: &mut Vec<u8>, is_wanted: &AtomicBool) {
    const PAGE: usize = 4 << 10;
    /// What the results of some hundred drawings take.
    const PAGES: usize = 384;
    for page in memory.spare_capacity_mut().chunks_mut(PAGE).take(PAGES) {
        if is_wanted.load(Ordering::Relaxed) {
            break;
        }
        page[0].write(0);
    }
    black_box(memory);
}
