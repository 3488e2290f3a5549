//! The request to watch, the signals that end or wake the watcher, and the events that it reports.

use std::collections::BTreeSet;
use std::sync::mpsc::Sender;
use std::time::Duration;

use camino::Utf8PathBuf;
use notify::Event;
use pathbuild_db::SourceFile;
use pathbuild_diagnostic::Diagnostic;

use crate::Inputs;
use crate::emit::ProgramOutcome;
use crate::findings::Findings;
use crate::post_processor::PostProcessor;
use crate::session::Session;

/// A request to watch drawings.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// The drawings, paths and directories to watch; if empty, the library.
    pub inputs: &'a Inputs,
    /// Whether to write the programs of `[emit] targets`.
    pub emits: bool,
    /// Whether the listener lists paths and therefore needs the post-processor.
    pub lists: bool,
    /// Whether to poll for changes, on systems that send no events.
    pub polls: bool,
}

/// A receiver of reports from the watch loop. Callbacks get the session, so that they can query more than the findings.
pub trait Listener {
    /// Whether the files of the configuration still have the contents that were loaded. Called when watching begins, because they may have changed
    /// since they were loaded, and at intervals while polling.
    fn is_configuration_current(&self) -> bool {
        true
    }
    /// Receives the handle that wakes the watcher from other threads.
    fn set_wake_handle(&self, _: WakeHandle) {}
    /// Called after the drawings have been found and read, before they are checked. The diagnostics are those of arguments and directories.
    fn drawings_found(&self, _: &mut Session<'_>, _: &[SourceFile], _: &[Diagnostic]) {}
    /// Called after drawings have been checked. If programs are requested, they have been written through this post-processor; the first check writes
    /// them last, and then passes their drawings once more.
    fn drawings_checked(&self, _: &mut Session<'_>, _: &[SourceFile], _: Option<&PostProcessor>) {}
    /// Called after a wake-up has been requested through the [`WakeHandle`].
    fn woken(&self, _: &mut Session<'_>) {}
    /// Called after all drawings have been checked for the first time.
    fn first_check_done(&self, _: &FirstCheck) {}
    /// Called after a batch of changes has been processed.
    fn batch_done(&self, _: &Update) {}
    /// Called for links to targets that cannot be watched, with the system's reason.
    fn not_watched(&self, _: &[(Utf8PathBuf, String)]) {}
    /// Called after programs have been written.
    fn programs_written(&self, _: Vec<ProgramOutcome>) {}
    /// Called when programs cannot be written because options are missing; the text names them.
    fn options_missing(&self, _: &str) {}
}

/// Ignores all events.
impl Listener for () {}

/// The result of the first check.
#[derive(Debug)]
pub struct FirstCheck {
    /// Number of drawings that were checked.
    pub drawings: usize,
    /// Number of paths in these drawings.
    pub paths: usize,
    /// All diagnostics of the first check.
    pub diagnostics: Vec<Diagnostic>,
    /// The findings as `check` reports them: with configured severities, without those that waivers and the baseline accept.
    pub findings: Findings,
    /// The diagnostics that belong to no single drawing; they are part of `diagnostics` as well.
    pub problems: Vec<Diagnostic>,
    /// Duration of the first check.
    pub time: Duration,
}

/// The result of a batch of changes.
#[derive(Clone, Debug, Default)]
pub struct Update {
    /// Number of the revision, counted from 1. A batch that only tries drawings again has the number of the batch before it.
    pub revision: u64,
    /// The changed files that caused the batch.
    pub changed: BTreeSet<Utf8PathBuf>,
    /// Those of the changed files that no longer exist.
    pub removed: BTreeSet<Utf8PathBuf>,
    /// Whether diagnostics that belong to no single drawing have changed.
    pub has_other_problems: bool,
    /// All diagnostics that belong to no single drawing, if they have changed; they are part of `now` as well.
    pub problems: Vec<Diagnostic>,
    /// Unchanged drawings that were checked again because of transient diagnostics, and directories that can be listed again.
    pub tried_again: BTreeSet<Utf8PathBuf>,
    /// The drawings that were checked.
    pub checked_files: Vec<SourceFile>,
    /// Number of drawings still to be checked, because more changes arrived.
    pub open: usize,
    /// Previous diagnostics of everything that was checked again or removed: drawings, Q-projects, programs, directories.
    pub before: Vec<Diagnostic>,
    /// Current diagnostics of everything that was checked: drawings, Q-projects, programs, directories.
    pub now: Vec<Diagnostic>,
    /// The findings that are reported now and were not before, as `check` reports them.
    pub new: Vec<Diagnostic>,
    /// The findings that were reported before and are not any more.
    pub fixed: Vec<Diagnostic>,
    /// The numbers of all findings.
    pub counts: FindingCounts,
    /// Time that the batch took.
    pub time: Duration,
}

impl Update {
    /// Whether there is anything to report besides the drawings still to be checked.
    pub(super) fn has_news(&self) -> bool {
        !self.removed.is_empty() || self.has_other_problems
    }
}

/// The numbers of all current findings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FindingCounts {
    /// Number of reported errors.
    pub errors: usize,
    /// Number of reported warnings.
    pub warnings: usize,
    /// Number of findings that waivers or the baseline accept.
    pub known: usize,
}

impl FindingCounts {
    /// Counts findings.
    pub fn of(findings: &Findings) -> Self {
        Self {
            errors: findings.error_count(),
            warnings: findings.warning_count(),
            known: findings.waived.len(),
        }
    }
}

/// The reason why watching ended.
#[derive(Debug)]
pub enum WatchEnd {
    /// The end was requested, or no more changes can arrive.
    Over,
    /// The configuration, a file of the configured post-processor or the baseline has changed: watching must start again.
    ConfigurationChanged,
    /// A watched directory, or a parent of one, appeared, disappeared or was replaced: the system still watches the old one.
    DirectoriesChanged,
    /// There are no arguments, and the configuration names no library.
    NothingNamed,
    /// Programs are to be written, but the configuration names no targets.
    NoTargets,
    /// The post-processor has these errors.
    BadPost(Vec<Diagnostic>),
    /// The baseline cannot be read, or has these errors.
    BadBaseline(Vec<Diagnostic>),
    /// The system cannot report changes, for this reason.
    CannotWatch(String),
}

/// Messages to the watching thread.
pub(super) enum Signal {
    Changed(notify::Result<Event>),
    WokenUp,
    Over,
}

/// A handle that wakes or stops the watching thread. May be cloned and used by any thread.
#[derive(Clone, Debug)]
pub struct WakeHandle(pub(super) Sender<Signal>);

impl WakeHandle {
    /// Requests a call of [`Listener::woken`] as soon as the session is idle. Has no effect once watching has ended.
    pub fn wake(&self) {
        _ = self.0.send(Signal::WokenUp);
    }

    /// Ends watching as soon as the current work is done.
    pub fn end(&self) {
        _ = self.0.send(Signal::Over);
    }
}

/// The reason why watching must start again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Restart {
    /// A watched directory, or a parent of one, appeared, disappeared or was replaced.
    Directories,
    /// The configuration, a file of the post-processor or the baseline changed.
    Configuration,
}

/// Changed paths: normalized names of files and directories that were written, created, renamed or removed.
#[derive(Debug, Default)]
pub(super) struct Changes {
    pub(super) paths: BTreeSet<Utf8PathBuf>,
    /// Whether events were lost, so that more may have changed.
    pub(super) is_incomplete: bool,
    /// The reason why watching must start again; `None` if it can go on.
    pub(super) restart: Option<Restart>,
}

impl Changes {
    pub(super) fn is_empty(&self) -> bool {
        self.paths.is_empty() && !self.is_incomplete && self.restart.is_none()
    }
}
