//! A progress bar on a terminal, for work that takes longer than half a second. (book: reference/commands)

use std::io::Write;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use pathbuild_workspace::Advance;

/// Time after which the bar appears.
const PATIENCE: Duration = Duration::from_millis(500);
/// Interval at which the bar is redrawn.
const INTERVAL: Duration = Duration::from_millis(100);
/// Width of the bar in columns.
const WIDTH: usize = 30;

/// A progress bar, drawn by its own thread and erased when dropped.
#[derive(Debug)]
pub struct Progress {
    counters: Arc<Counters>,
    drawing: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Counters {
    done: AtomicUsize,
    total: usize,
    is_over: Mutex<bool>,
    over: Condvar,
}

impl Progress {
    /// Counts up to `total` and draws on `stream`, if there is one.
    pub fn new(total: usize, stream: Option<Box<dyn Write + Send>>) -> Self {
        let over = Condvar::new();
        let counters =
            Arc::new(Counters { done: AtomicUsize::new(0), total, is_over: Mutex::new(false), over });
        let drawing = stream.map(|stream| {
            let counters = Arc::clone(&counters);
            thread::spawn(move || counters.draw(stream))
        });
        Self { counters, drawing }
    }
}

impl Advance for Progress {
    fn advance(&self) {
        if self.drawing.is_some() {
            self.counters.done.fetch_add(1, Ordering::Relaxed);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        *self.counters.is_over.lock().unwrap_or_else(PoisonError::into_inner) = true;
        self.counters.over.notify_all();
        if let Some(drawing) = self.drawing.take() {
            // A bar that could not be drawn is not worth reporting.
            _ = drawing.join();
        }
    }
}

impl Counters {
    fn draw(&self, mut stream: Box<dyn Write + Send>) {
        if self.is_over_after(PATIENCE) {
            return;
        }
        loop {
            let is_drawn = write!(stream, "\r\x1b[K{}", self.bar()).and_then(|()| stream.flush()).is_ok();
            if self.is_over_after(INTERVAL) || !is_drawn {
                break;
            }
        }
        _ = write!(stream, "\r\x1b[K").and_then(|()| stream.flush());
    }

    fn is_over_after(&self, time: Duration) -> bool {
        let is_over = self.is_over.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = self.over.wait_timeout_while(is_over, time, |is_over| !*is_over);
        *waited.unwrap_or_else(PoisonError::into_inner).0
    }

    /// `[#######-----------------------] 512/2014`
    fn bar(&self) -> String {
        let done = self.done.load(Ordering::Relaxed).min(self.total);
        let full = (done * WIDTH).checked_div(self.total).unwrap_or(WIDTH);
        format!("[{}{}] {done}/{}", "#".repeat(full), "-".repeat(WIDTH - full), self.total)
    }
}
