//! Where the time of a run went: `check --timings`.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use pathbuild_diagnostic::Word;

/// What was measured.
#[derive(Debug, Default)]
pub struct Timings {
    /// Whether somebody wants to know. A run that goes on would gather paths without end.
    is_on: AtomicBool,
    phases: Mutex<Vec<(&'static Word, Duration)>>,
    paths: Mutex<Vec<(String, Duration)>>,
}

/// Finding the drawings that the arguments mean.
pub static FINDING: Word = Word { en: "finding drawings", de: "Zeichnungen suchen" };
/// Holding kept results against the files.
pub static VERIFYING: Word = Word { en: "looking at kept results", de: "frühere Ergebnisse prüfen" };
/// Reading drawings.
pub static READING: Word = Word { en: "reading drawings", de: "Zeichnungen lesen" };
/// Checking their paths.
pub static CHECKING: Word = Word { en: "checking paths", de: "Pfade prüfen" };
/// Keeping results for the next run.
pub static KEEPING: Word = Word { en: "keeping results", de: "Ergebnisse aufheben" };

/// How many paths are named.
const SLOWEST: usize = 10;

impl Timings {
    /// Begins to measure.
    pub fn switch_on(&self) {
        self.is_on.store(true, Ordering::Relaxed);
    }

    fn is_on(&self) -> bool {
        self.is_on.load(Ordering::Relaxed)
    }

    /// Does some work and notes how long it took.
    pub fn measure<R>(&self, phase: &'static Word, work: impl FnOnce() -> R) -> R {
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

    /// Works on a path and notes how long it took.
    pub(super) fn measure_path<R>(&self, name: impl FnOnce() -> String, work: impl FnOnce() -> R) -> R {
        if !self.is_on() {
            return work();
        }
        let begun = Instant::now();
        let result = work();
        lock(&self.paths).push((name(), begun.elapsed()));
        result
    }

    /// A line for each phase, then one for each of the slowest paths, the slowest first.
    pub fn lines(&self, lang: pathbuild_diagnostic::Lang) -> Vec<String> {
        let line = |time: Duration, what: &str| format!("{:>10.1} ms  {what}", time.as_secs_f64() * 1000.0);
        let word = |word: &Word| match lang {
            pathbuild_diagnostic::Lang::En => word.en,
            pathbuild_diagnostic::Lang::De => word.de,
        };
        let mut lines: Vec<String> =
            lock(&self.phases).iter().map(|(phase, time)| line(*time, word(phase))).collect();
        let mut paths = lock(&self.paths).clone();
        paths.sort_by(|(a, slow), (b, slower)| slower.cmp(slow).then_with(|| a.cmp(b)));
        lines.extend(paths.iter().take(SLOWEST).map(|(name, time)| line(*time, name)));
        lines
    }
}

fn lock<T>(measured: &Mutex<T>) -> MutexGuard<'_, T> {
    measured.lock().unwrap_or_else(PoisonError::into_inner)
}
