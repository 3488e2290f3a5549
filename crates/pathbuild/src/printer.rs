//! Prints all output of the program; no other module prints. (book: reference/commands)
//!
//! | what | stream | at |
//! | --- | --- | --- |
//! | results: the output that the command was asked for | stdout | always |
//! | the machine-readable document of a run | stdout, unless that holds a program | always |
//! | all other diagnostics | stderr | without `-qq` |
//! | wrong usage | stderr | always |
//! | status: the summary, files written; a progress bar on a terminal | stderr | without `-q` |
//! | details, such as files read and results taken from the cache | stderr | with `-v` |
//!
//! All output passes through `pathbuild_diagnostic::escaping`, so that names and texts from untrusted files can neither move the cursor nor
//! start a command of a CI runner. Status lines and single-line results stay single lines whatever names they contain; names within longer
//! results are escaped by the caller. Bytes that are requested unchanged (a program, a shell script) are printed unchanged.
//!
//! A closed pipe is not an error: the rest of that stream is dropped (`pathbuild check --format concise 2>&1 | head`). Any other write error is
//! remembered and makes the run end with [`ExitStatus::Errors`].

use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use pathbuild_diagnostic::escaping;
use pathbuild_workspace::{ProgressCounter, Reporter, SilentReporter};

use crate::exit::ExitStatus;
use crate::render::RenderedText;

/// When to use colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum ColorChoice {
    /// On a terminal.
    #[default]
    Auto,
    /// Also into a file or pipe.
    Always,
    /// Nowhere.
    Never,
}

/// The amount of output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verbosity {
    /// `-qq`: results only.
    Silent,
    /// `-q`: results and diagnostics.
    Quiet,
    /// Results, diagnostics and the status of the run.
    #[default]
    Normal,
    /// `-v`: everything of `Normal`, and details.
    Verbose,
}

impl Verbosity {
    /// Returns the level for these numbers of `-q` and `-v`.
    pub fn from_counts(quiet: u8, verbose: u8) -> Self {
        match (quiet, verbose) {
            (0, 0) => Self::Normal,
            (0, _) => Self::Verbose,
            (1, _) => Self::Quiet,
            _ => Self::Silent,
        }
    }
}

/// Printer for stdout and stderr, with a verbosity and a choice of colours.
#[derive(Debug, Default)]
pub struct Printer {
    verbosity: Verbosity,
    color: ColorChoice,
    /// Whether stdout carries a machine-readable document, so that results for users go to stderr.
    is_stdout_taken: bool,
    failures: Mutex<Failures>,
}

/// The first write error of each stream. After it, nothing more is written to that stream.
#[derive(Debug, Default)]
struct Failures {
    stdout: Option<io::Error>,
    stderr: Option<io::Error>,
}

/// An output stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// The stream for results.
    Stdout,
    /// The stream for messages about the run.
    Stderr,
}

impl Stream {
    /// Whether the stream is a terminal.
    pub fn is_terminal(self) -> bool {
        match self {
            Self::Stdout => io::stdout().is_terminal(),
            Self::Stderr => io::stderr().is_terminal(),
        }
    }
}

impl Printer {
    /// Creates a printer with this verbosity and choice of colours.
    pub fn new(verbosity: Verbosity, color: ColorChoice) -> Self {
        Self { verbosity, color, ..Self::default() }
    }

    /// Redirects results for users to stderr if stdout carries a machine-readable document.
    pub(crate) fn with_stdout_taken(self, is_stdout_taken: bool) -> Self {
        Self { is_stdout_taken, ..self }
    }

    fn results(&self) -> Stream {
        if self.is_stdout_taken { Stream::Stderr } else { Stream::Stdout }
    }

    /// Returns the amount of output.
    pub fn verbosity(&self) -> Verbosity {
        self.verbosity
    }

    /// Whether text on the stream is coloured.
    pub fn is_colored(&self, stream: Stream) -> bool {
        match self.color {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => stream.is_terminal(),
        }
    }

    /// Returns the width of the stream's terminal in columns; `None` if the stream is not a terminal.
    pub fn width(&self, stream: Stream) -> Option<usize> {
        let size = match stream {
            Stream::Stdout => terminal_size::terminal_size_of(io::stdout()),
            Stream::Stderr => terminal_size::terminal_size_of(io::stderr()),
        };
        size.map(|(width, _)| usize::from(width.0))
    }

    /// Prints results that consist of whole lines.
    pub fn result(&self, text: impl Display) {
        self.write(self.results(), &escaping::lines(&text.to_string()));
    }

    /// Prints a single-line result.
    pub fn result_line(&self, line: impl Display) {
        self.write_line(self.results(), line);
    }

    pub(crate) fn json(&self, stream: Stream, json: impl Display) {
        self.write(stream, &escaping::json(&format!("{json}\n")));
    }

    /// Prints a result to stdout, byte for byte.
    pub fn result_bytes(&self, bytes: &[u8]) {
        write_unless(&mut self.failures().stdout, io::stdout().lock(), bytes);
    }

    /// Prints rendered diagnostics. On stderr, they are suppressed with `-qq`.
    pub fn diagnostics(&self, stream: Stream, text: &RenderedText) {
        if stream == Stream::Stdout || self.verbosity >= Verbosity::Quiet {
            self.write(stream, text.as_str());
        }
    }

    /// Prints a machine-readable document, regardless of verbosity.
    pub(crate) fn document(&self, stream: Stream, text: &RenderedText) {
        self.write(stream, text.as_str());
    }

    /// Prints a line about the status of the run.
    pub fn status(&self, line: impl Display) {
        if self.verbosity >= Verbosity::Normal {
            self.write_line(Stream::Stderr, line);
        }
    }

    pub(crate) fn status_lines(&self, lines: impl Display) {
        if self.verbosity >= Verbosity::Normal {
            self.write(Stream::Stderr, &escaping::lines(&lines.to_string()));
        }
    }

    /// Prints a line of detail, shown with `-v` only.
    pub fn detail(&self, line: impl Display) {
        if self.verbosity >= Verbosity::Verbose {
            self.write_line(Stream::Stderr, line);
        }
    }

    /// Prints a usage error.
    pub fn usage(&self, text: impl Display) {
        self.write(Stream::Stderr, &escaping::lines(&text.to_string()));
    }

    /// Reports write errors, and returns the final status.
    pub fn finish(&self, status: ExitStatus) -> ExitStatus {
        let failures = std::mem::take(&mut *self.failures());
        let is_serious = |error: &io::Error| error.kind() != io::ErrorKind::BrokenPipe;
        if let Some(error) = failures.stdout.filter(is_serious) {
            self.write_line(Stream::Stderr, format_args!("error: cannot write to standard output: {error}"));
            return status.max(ExitStatus::Errors);
        }
        match failures.stderr.filter(is_serious) {
            Some(_) => status.max(ExitStatus::Errors),
            None => status,
        }
    }

    /// Whether writing to standard output or standard error has failed, usually because their reader has ended.
    pub fn has_failed(&self) -> bool {
        let failures = self.failures();
        failures.stdout.is_some() || failures.stderr.is_some()
    }

    fn failures(&self) -> MutexGuard<'_, Failures> {
        self.failures.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn write_line(&self, stream: Stream, line: impl Display) {
        let line = format!("{}\n", escaping::line(&line.to_string()));
        self.write(stream, &escaping::lines(&line));
    }

    fn write(&self, stream: Stream, text: &str) {
        let mut failures = self.failures();
        match stream {
            Stream::Stdout => write_unless(&mut failures.stdout, io::stdout().lock(), text.as_bytes()),
            Stream::Stderr => write_unless(&mut failures.stderr, io::stderr().lock(), text.as_bytes()),
        }
    }
}

impl Reporter for Printer {
    fn status(&self, line: &str) {
        Self::status(self, line);
    }

    fn detail(&self, line: &str) {
        Self::detail(self, line);
    }

    /// Returns a counter. It shows a progress bar if stderr is a terminal and neither `-q` nor `-qq` is given.
    fn progress(&self, total: usize) -> Box<dyn ProgressCounter> {
        if self.verbosity < Verbosity::Normal || !Stream::Stderr.is_terminal() {
            return Box::new(SilentReporter);
        }
        Box::new(Progress::new(total, Box::new(io::stderr())))
    }
}

fn write_unless(failed: &mut Option<io::Error>, mut stream: impl Write, bytes: &[u8]) {
    if failed.is_none() {
        // Write the bytes in one piece, because stderr is unbuffered, and lines of concurrent processes must not mix.
        *failed = stream.write_all(bytes).and_then(|()| stream.flush()).err();
    }
}

/// Time after which a progress bar appears. Shorter work shows none.
const BAR_DELAY: Duration = Duration::from_millis(500);
const REDRAW_INTERVAL: Duration = Duration::from_millis(100);
/// Width of the progress bar in columns.
const BAR_WIDTH: usize = 30;

/// A progress bar on a terminal. It is drawn by a thread of its own, and erased when dropped.
#[derive(Debug)]
pub struct Progress {
    counters: Arc<Counters>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Counters {
    done: AtomicUsize,
    total: usize,
    is_over: Mutex<bool>,
    over: Condvar,
}

impl Progress {
    /// Creates a progress bar that counts up to `total` and draws on `stream`.
    pub fn new(total: usize, stream: Box<dyn Write + Send>) -> Self {
        let over = Condvar::new();
        let counters =
            Arc::new(Counters { done: AtomicUsize::new(0), total, is_over: Mutex::new(false), over });
        let drawn = Arc::clone(&counters);
        Self { counters, thread: Some(thread::spawn(move || drawn.draw(stream))) }
    }
}

impl ProgressCounter for Progress {
    fn advance(&self) {
        self.counters.done.fetch_add(1, Ordering::Relaxed);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        *self.counters.is_over.lock().unwrap_or_else(PoisonError::into_inner) = true;
        self.counters.over.notify_all();
        if let Some(thread) = self.thread.take() {
            // A panic of the drawing thread is ignored: the progress bar does not affect the results.
            _ = thread.join();
        }
    }
}

impl Counters {
    fn draw(&self, mut stream: Box<dyn Write + Send>) {
        if self.is_over_after(BAR_DELAY) {
            return;
        }
        loop {
            let is_drawn = write!(stream, "\r\x1b[K{}", self.bar()).and_then(|()| stream.flush()).is_ok();
            if self.is_over_after(REDRAW_INTERVAL) || !is_drawn {
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

    /// Formats the progress bar: `[#######-----------------------] 512/2014`.
    fn bar(&self) -> String {
        let done = self.done.load(Ordering::Relaxed).min(self.total);
        let full = (done * BAR_WIDTH).checked_div(self.total).unwrap_or(BAR_WIDTH);
        format!("[{}{}] {done}/{}", "#".repeat(full), "-".repeat(BAR_WIDTH - full), self.total)
    }
}
