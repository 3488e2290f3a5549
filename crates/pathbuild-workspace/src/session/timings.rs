//! The time spent in each phase of a run: `check --timings`.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use pathbuild_diagnostic::Text;

/// The times of phases, and of the slowest paths.
#[derive(Debug, Default)]
pub struct Timings {
    /// Whether times are recorded. In a long-lived session, the list of paths would otherwise grow without end.
    is_on: AtomicBool,
    phases: Mutex<Vec<(&'static Text, Duration)>>,
    paths: Mutex<Vec<(String, Duration)>>,
}

/// Phase in which the arguments are matched with drawings.
pub static FINDING_DRAWINGS: Text = Text { en: "finding drawings", de: "Zeichnungen suchen" };
/// Phase in which cached results are compared with the files.
pub static VERIFYING_CACHE: Text =
    Text { en: "verifying cached results", de: "gespeicherte Ergebnisse prüfen" };
/// Phase in which drawings are read.
pub static READING_DRAWINGS: Text = Text { en: "reading drawings", de: "Zeichnungen lesen" };
/// Phase in which paths are checked.
pub static CHECKING_PATHS: Text = Text { en: "checking paths", de: "Pfade prüfen" };
/// Phase in which results are stored in the cache.
pub static STORING_RESULTS: Text = Text { en: "storing results", de: "Ergebnisse speichern" };

/// Number of slowest paths that are listed.
const MAX_LISTED_PATHS: usize = 10;

impl Timings {
    /// Starts recording times.
    pub fn switch_on(&self) {
        self.is_on.store(true, Ordering::Relaxed);
    }

    fn is_on(&self) -> bool {
        self.is_on.load(Ordering::Relaxed)
    }

    /// Runs some work and adds its time to a phase.
    pub fn measure<R>(&self, phase: &'static Text, work: impl FnOnce() -> R) -> R {
        if !self.is_on() {
            return work();
        }
        let begun = Instant::now();
        let result = work();
        let time = begun.elapsed();
        let mut phases = lock(&self.phases);
        match phases.iter_mut().find(|(known, _)| *known == phase) {
            Some((_, sum)) => *sum += time,
            None => phases.push((phase, time)),
        }
        result
    }

    pub(super) fn measure_path<R>(&self, name: impl FnOnce() -> String, work: impl FnOnce() -> R) -> R {
        if !self.is_on() {
            return work();
        }
        let begun = Instant::now();
        let result = work();
        lock(&self.paths).push((name(), begun.elapsed()));
        result
    }

    /// Returns one line per phase, followed by one line for each of the slowest paths.
    pub fn lines(&self, lang: pathbuild_diagnostic::Lang) -> Vec<String> {
        let line = |time: Duration, what: &str| format!("{:>10.1} ms  {what}", time.as_secs_f64() * 1000.0);
        let mut lines: Vec<String> =
            lock(&self.phases).iter().map(|(phase, time)| line(*time, phase.in_lang(lang))).collect();
        let mut paths = lock(&self.paths).clone();
        paths.sort_by(|(a, slow), (b, slower)| slower.cmp(slow).then_with(|| a.cmp(b)));
        lines.extend(paths.iter().take(MAX_LISTED_PATHS).map(|(name, time)| line(*time, name)));
        lines
    }
}

fn lock<T>(measured: &Mutex<T>) -> MutexGuard<'_, T> {
    measured.lock().unwrap_or_else(PoisonError::into_inner)
}
