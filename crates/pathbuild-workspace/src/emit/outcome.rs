//! The task of `emit`, which decides what is done with generated files, and the outcome for each program.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_diagnostic::messages::outputs;
use pathbuild_diagnostic::reasons::cannot_write;
use pathbuild_diagnostic::{Diagnostic, Note, Value};
use pathbuild_gcode::provenance::{HEAD_BYTES, Provenance, VERSION};
use serde::{Deserialize, Serialize};

use crate::config::Settings;
use crate::config::types::SheetFormat;
use crate::files::ExtraInput;
use crate::memo::{GeneratedFile, OutputState};
use crate::session::OutputKind;

/// A task that `emit` performs with the generated files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// Writes the files.
    Write {
        /// Whether to overwrite files with measured values.
        force: bool,
    },
    /// Compares the generated files with those on disk.
    Compare {
        /// Whether to compare moves only instead of bytes.
        moves_only: bool,
    },
    /// Prints the programs.
    Print,
}

/// The outcome of generating and then writing, comparing or printing the files of one program.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct ProgramOutcome {
    /// Name of the path, or of the joined program.
    #[serde(skip)]
    pub path: Box<str>,
    /// Each file with its outcome.
    #[serde(skip)]
    pub files: Vec<(Utf8PathBuf, State)>,
    /// Hash of the expected content of each file, computed by [`hash_output`].
    #[serde(skip)]
    pub(super) hashes: Vec<[u8; 32]>,
    /// Length of the program in mm.
    pub length: f64,
    /// Machining time of the program in minutes.
    pub minutes: f64,
    /// Diagnostics of the program, and differences between its moves and those of the file on disk.
    pub problems: Vec<Diagnostic>,
    /// Whether the program itself has errors, which prevent writing it.
    #[serde(skip)]
    pub(super) is_refused: bool,
    /// Identifies the inputs of the program; `None` if there is no program.
    pub(super) provenance: Option<Provenance>,
    /// Notes of the post-processor.
    pub notes: Vec<Note>,
    /// The command that the post-processor requests, with its output file.
    #[serde(skip)]
    pub post_build: Option<(Vec<String>, Utf8PathBuf)>,
    /// Files that the post-processor inserted or failed to insert.
    #[serde(skip)]
    pub(super) inserted: Vec<ExtraInput>,
}

impl ProgramOutcome {
    /// Whether all `files` files of a program were written or compared without errors. A program with errors is not complete, because the errors may
    /// not recur in another run.
    pub(super) fn is_complete(&self, files: usize) -> bool {
        self.files.len() == files
            && self.hashes.len() == files
            && !self.problems.iter().any(Diagnostic::is_error)
    }

    pub(super) fn generated(&self, task: Task) -> Vec<GeneratedFile> {
        // A comparison of moves alone does not show whether the bytes are equal.
        let is_compared_whole = task != Task::Compare { moves_only: true };
        let is_there = |state: &State| {
            matches!(state, State::Written | State::Overwritten | State::Unchanged | State::Current)
        };
        let file = |((path, state), hash): (&(Utf8PathBuf, State), &[u8; 32])| GeneratedFile {
            path: path.clone(),
            hash: *hash,
            is_there: is_compared_whole && is_there(state),
        };
        self.files.iter().zip(&self.hashes).map(file).collect()
    }

    /// Returns PB528 for each compared file that is missing or not current.
    pub(super) fn not_current_findings(&self) -> impl Iterator<Item = Diagnostic> {
        self.files.iter().filter_map(|(file, state)| {
            let message = match state {
                State::Missing => &outputs::MISSING_OUTPUT,
                State::Outdated => &outputs::OTHER_OUTPUT,
                State::Written
                | State::Overwritten
                | State::Unchanged
                | State::Current
                | State::Printed(_) => return None,
            };
            let finding = Diagnostic::new(message).quoting("name", file.file_name().unwrap_or_default());
            Some(finding.in_file(file).in_path(&self.path))
        })
    }

    /// Whether the file on disk is up to date because this run wrote it or found it unchanged.
    pub fn has_written(&self, file: &Utf8Path) -> bool {
        let is_there =
            |state: &State| matches!(state, State::Written | State::Overwritten | State::Unchanged);
        self.files.iter().any(|(path, state)| path == file && is_there(state))
    }
}

/// The outcome of a single file.
#[derive(Clone, Debug)]
pub enum State {
    /// The file was written by this run.
    Written,
    /// The file was written over a program that had been edited.
    Overwritten,
    /// The file was up to date before this run, so it was not written.
    Unchanged,
    /// The file on disk was compared and is equal.
    Current,
    /// The file on disk was compared and differs.
    Outdated,
    /// There is no file on disk to compare with.
    Missing,
    /// The file is not written; this content is to be printed.
    Printed(Vec<u8>),
}

impl Default for Task {
    fn default() -> Self {
        Self::Write { force: false }
    }
}

impl Task {
    /// Whether this task compares files with those on disk.
    pub(super) fn is_comparison(self) -> bool {
        matches!(self, Self::Compare { .. })
    }

    /// Turns a warning about a program on disk into an error if this task is a comparison.
    pub(super) fn error_if_compared(self, finding: Diagnostic) -> Diagnostic {
        if self.is_comparison() { finding.as_error() } else { finding }
    }

    /// Whether this task covers files of this kind. A comparison of moves alone skips measured values and setup sheets.
    pub(super) fn covers(self, kind: OutputKind) -> bool {
        self != Self::Compare { moves_only: true } || (kind != OutputKind::Values && kind.sheet().is_none())
    }

    /// Returns the format of the setup sheets that this task generates. Printing generates none.
    pub(super) fn sheets(self, settings: &Settings) -> SheetFormat {
        if self == Self::Print { SheetFormat::No } else { settings.emit.sheet.value }
    }

    /// Returns the outcome of a file with a state known from an earlier run. This run then neither writes nor compares the file.
    pub(super) fn state_from_cache(self, state: OutputState) -> State {
        match state {
            OutputState::Current if matches!(self, Self::Write { .. }) => State::Unchanged,
            OutputState::Current => State::Current,
            OutputState::Outdated => State::Outdated,
            OutputState::Missing => State::Missing,
        }
    }

    pub(super) fn writes_times(self) -> bool {
        self != Self::Compare { moves_only: true }
    }
}

pub(super) fn write_error(name: &str, reason: impl Into<Value>) -> Diagnostic {
    cannot_write(name, reason)
}

/// Whether a program on disk was written by another version of pathbuild.
pub(super) fn is_of_other_version(system: &dyn System, program: &Utf8Path) -> bool {
    let head = system.read_head(program, HEAD_BYTES).unwrap_or_default();
    Provenance::of_head(&head).is_some_and(|(found, _)| *found.version != *VERSION)
}
