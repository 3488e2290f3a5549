//! The only place of the program that prints. (book: reference/commands)
//!
//! | what | stream | at |
//! | --- | --- | --- |
//! | results: what the command was asked for | stdout | always |
//! | the document of a run in a machine's format | stdout, unless that holds a program | always |
//! | all other diagnostics | stderr | up to `-q` |
//! | wrong usage | stderr | always |
//! | status: the summary, files written; a progress bar on a terminal | stderr | without `-q` |
//! | details: what was found, read, taken from the cache | stderr | with `-v` |
//!
//! Everything passes `pathbuild_diagnostic::shown` on the way: names and texts of strangers can neither move the cursor nor begin a
//! command of a CI runner. A status line and a line of results stay one line whatever names hold; names within longer results are
//! escaped by who puts them there. Bytes that are asked for as they are (a program, a script for the shell) are printed as they are.
//!
//! A closed pipe is no error: what is left of that stream is dropped (`pathbuild check --format concise 2>&1 | head`). Any other
//! failure to write is kept and makes the run end with [`ExitStatus::Errors`].

use std::cell::RefCell;
use std::fmt::Display;
use std::io::{self, IsTerminal, Write};

use pathbuild_diagnostic::shown;
use pathbuild_workspace::{Advance, Reporter, Silent};

use crate::exit::ExitStatus;
use crate::progress::Progress;
use crate::render::Rendered;

/// When to colour.
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

/// How much is said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verbosity {
    /// `-qq`: results only.
    Silent,
    /// `-q`: results and diagnostics.
    Quiet,
    /// Also the status of the run.
    #[default]
    Normal,
    /// `-v`: also details.
    Verbose,
}

impl Verbosity {
    /// The level for so many `-q` and so many `-v`.
    pub fn from_counts(quiet: u8, verbose: u8) -> Self {
        match (quiet, verbose) {
            (0, 0) => Self::Normal,
            (0, _) => Self::Verbose,
            (1, _) => Self::Quiet,
            _ => Self::Silent,
        }
    }
}

/// The two streams, and what may be shown on them.
#[derive(Debug, Default)]
pub struct Printer {
    verbosity: Verbosity,
    color: ColorChoice,
    /// Stdout is a document that a program reads: people's results go to stderr.
    is_stdout_taken: bool,
    failures: RefCell<Failures>,
}

/// Why a stream no longer takes text.
#[derive(Debug, Default)]
struct Failures {
    stdout: Option<io::Error>,
    stderr: Option<io::Error>,
}

/// One of the two streams.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// For results.
    Stdout,
    /// For everything said about the run.
    Stderr,
}

impl Stream {
    /// Whether a person looks at it.
    pub fn is_terminal(self) -> bool {
        match self {
            Self::Stdout => io::stdout().is_terminal(),
            Self::Stderr => io::stderr().is_terminal(),
        }
    }
}

impl Printer {
    /// A printer that says so much, in such colours.
    pub fn new(verbosity: Verbosity, color: ColorChoice) -> Self {
        Self { verbosity, color, ..Self::default() }
    }

    /// The same where stdout is a document that a program reads.
    pub(crate) fn with_stdout_taken(self, is_stdout_taken: bool) -> Self {
        Self { is_stdout_taken, ..self }
    }

    fn results(&self) -> Stream {
        if self.is_stdout_taken { Stream::Stderr } else { Stream::Stdout }
    }

    /// How much is said.
    pub fn verbosity(&self) -> Verbosity {
        self.verbosity
    }

    /// Whether text for that stream is coloured.
    pub fn is_colored(&self, stream: Stream) -> bool {
        match self.color {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => stream.is_terminal(),
        }
    }

    /// The width of that stream in columns, where a person looks at it.
    pub fn width(&self, stream: Stream) -> Option<usize> {
        let size = match stream {
            Stream::Stdout => terminal_size::terminal_size_of(io::stdout()),
            Stream::Stderr => terminal_size::terminal_size_of(io::stderr()),
        };
        size.map(|(width, _)| usize::from(width.0))
    }

    /// Prints a result of whole lines to stdout.
    pub fn result(&self, text: impl Display) {
        self.write(self.results(), &shown::lines(&text.to_string()));
    }

    /// Prints a result of one line to stdout.
    pub fn result_line(&self, line: impl Display) {
        self.write_line(self.results(), line);
    }

    /// Prints a result in JSON to stdout.
    pub fn result_json(&self, json: impl Display) {
        self.json(Stream::Stdout, json);
    }

    /// Prints a line in JSON.
    pub(crate) fn json(&self, stream: Stream, json: impl Display) {
        self.write(stream, &shown::json(&format!("{json}\n")));
    }

    /// Prints a result that is wanted byte for byte to stdout.
    pub fn result_bytes(&self, bytes: &[u8]) {
        let failed = &mut self.failures.borrow_mut().stdout;
        if failed.is_none() {
            let mut stdout = io::stdout().lock();
            *failed = stdout.write_all(bytes).and_then(|()| stdout.flush()).err();
        }
    }

    /// Prints rendered diagnostics.
    pub fn diagnostics(&self, stream: Stream, text: &Rendered) {
        if stream == Stream::Stdout || self.verbosity >= Verbosity::Quiet {
            self.write(stream, text.as_str());
        }
    }

    /// Prints what a program reads, at any verbosity.
    pub(crate) fn document(&self, stream: Stream, text: &Rendered) {
        self.write(stream, text.as_str());
    }

    /// Prints a line about the run.
    pub fn status(&self, line: impl Display) {
        if self.verbosity >= Verbosity::Normal {
            self.write_line(Stream::Stderr, line);
        }
    }

    /// Prints whole lines about the run.
    pub(crate) fn status_lines(&self, lines: impl Display) {
        if self.verbosity >= Verbosity::Normal {
            self.write(Stream::Stderr, &shown::lines(&lines.to_string()));
        }
    }

    /// Prints a line that few want to know.
    pub fn detail(&self, line: impl Display) {
        if self.verbosity >= Verbosity::Verbose {
            self.write_line(Stream::Stderr, line);
        }
    }

    /// Prints what is wrong about the way the program was called.
    pub fn usage(&self, text: impl Display) {
        self.write(Stream::Stderr, &shown::lines(&text.to_string()));
    }

    /// Ends the output: says what could not be written, and lets that decide over the status.
    pub fn finish(&self, status: ExitStatus) -> ExitStatus {
        let failures = self.failures.take();
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

    fn write_line(&self, stream: Stream, line: impl Display) {
        let line = format!("{}\n", shown::line(&line.to_string()));
        self.write(stream, &shown::lines(&line));
    }

    fn write(&self, stream: Stream, text: &str) {
        let mut failures = self.failures.borrow_mut();
        match stream {
            Stream::Stdout => write_unless(&mut failures.stdout, io::stdout().lock(), text),
            Stream::Stderr => write_unless(&mut failures.stderr, io::stderr().lock(), text),
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

    /// A progress bar, where somebody looks at it.
    fn progress(&self, total: usize) -> Box<dyn Advance> {
        if self.verbosity < Verbosity::Normal || !Stream::Stderr.is_terminal() {
            return Box::new(Silent);
        }
        Box::new(Progress::new(total, Some(Box::new(io::stderr()))))
    }
}

fn write_unless(failed: &mut Option<io::Error>, mut stream: impl Write, text: &str) {
    if failed.is_none() {
        // In one piece: standard error has no buffer, and lines of programs side by side must not mix.
        *failed = stream.write_all(text.as_bytes()).and_then(|()| stream.flush()).err();
    }
}
