//! Worker threads, which start and reserve their memory before there is work for them.

use std::hint::black_box;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::{ThreadPool, ThreadPoolBuilder};

/// A pool of worker threads.
#[derive(Debug)]
pub(super) struct Workers {
    pool: ThreadPool,
    /// Set once there is work.
    is_wanted: Arc<AtomicBool>,
}

/// Stack size of worker threads in bytes. Queries recurse once per level of embedding.
const STACK_SIZE: usize = 16 << 20;

impl Workers {
    /// Starts `count` threads, or one per core, without waiting for them; `None` if the system provides none. The calling thread is not
    /// part of the pool: on two cores, the other thread often started on the caller's core and stayed there for 5 to 10 ms.
    pub(super) fn start(count: Option<u16>) -> Option<Self> {
        let is_wanted = Arc::new(AtomicBool::new(false));
        let until = Arc::clone(&is_wanted);
        let threads = usize::from(count.unwrap_or(0));
        let pool = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_SIZE);
        let pool = pool.start_handler(move |_| reserve_memory(&until)).build().ok()?;
        Some(Self { pool, is_wanted })
    }

    /// Number of threads.
    pub(super) fn count(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Runs work that uses the threads through rayon.
    pub(super) fn work<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.is_wanted.store(true, Ordering::Relaxed);
        self.pool.install(work)
    }
}

/// Allocates the memory that a thread will need in one piece and frees it at once, so that it is at hand later. Otherwise glibc requests a
/// thread's memory page by page while all other threads wait. glibc keeps at most twice the size of the largest piece that was returned to
/// the system, which is why memory is allocated and freed once before.
fn reserve_memory(is_wanted: &AtomicBool) {
    drop(reserved());
    touch(&mut reserved(), is_wanted);
}

/// A block of untouched memory; smaller if the system has less.
fn reserved() -> Vec<u8> {
    const RESERVED: usize = 16 << 20;
    let mut memory = Vec::new();
    _ = black_box(&mut memory).try_reserve_exact(RESERVED);
    memory
}

/// Touches the first pages of the block until there is work, so that the work need not wait for each page.
fn touch(memory: &mut Vec<u8>, is_wanted: &AtomicBool) {
    const PAGE: usize = 4 << 10;
    /// Roughly the size of the results of a few hundred drawings.
    const PAGES: usize = 384;
    for page in memory.spare_capacity_mut().chunks_mut(PAGE).take(PAGES) {
        if is_wanted.load(Ordering::Relaxed) {
            break;
        }
        page[0].write(0);
    }
    black_box(memory);
}
