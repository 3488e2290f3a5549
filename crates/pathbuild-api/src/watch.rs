//! Watches a library for changes.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_workspace::watch::{FirstCheck, Listener, Update, WakeHandle};
use pathbuild_workspace::{SilentReporter, Workspace};

use crate::Finding;

/// The findings after changes of some files; the first report covers the whole library. Findings that the baseline accepts are among them.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct WatchReport {
    /// Names of the files that changed. Empty in the first report.
    pub changed: Vec<String>,
    /// Names of the changed files that no longer exist.
    pub removed: Vec<String>,
    /// The earlier findings about the drawings that depend on the changed files.
    pub before: Vec<Finding>,
    /// The current findings about the drawings that depend on the changed files.
    pub now: Vec<Finding>,
}

/// The reason why watching ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WatchEnd {
    /// The caller stopped watching.
    Stopped,
    /// The configuration, a file of the post-processor or the baseline has changed, so the library must be opened again.
    ConfigurationChanged,
    /// A watched directory was replaced, or has appeared or disappeared, so [`watch`](crate::Library::watch) must be called again.
    DirectoriesChanged,
}

/// Makes all paths absolute, because the system watches directories relative to the working directory of the process.
pub(crate) fn with_absolute_paths(workspace: &Workspace) -> Workspace {
    Workspace {
        system_lang: None,
        working_directory: Utf8PathBuf::new(),
        reporter: Arc::new(SilentReporter),
        ..workspace.clone()
    }
}

/// Forwarder of reports to the caller, until the caller stops watching.
pub(crate) struct ReportForwarder<'w, F> {
    /// The workspace of the library, which names files relative to its directory.
    workspace: &'w Workspace,
    on_report: RefCell<F>,
    bell: RefCell<Option<WakeHandle>>,
}

impl<'w, F: FnMut(WatchReport) -> bool> ReportForwarder<'w, F> {
    pub(crate) fn new(workspace: &'w Workspace, on_report: F) -> Self {
        Self { workspace, on_report: RefCell::new(on_report), bell: RefCell::default() }
    }

    fn forward(&self, report: WatchReport) {
        let goes_on = (self.on_report.borrow_mut())(report);
        if let Some(bell) = self.bell.borrow().as_ref().filter(|_| !goes_on) {
            bell.end();
        }
    }

    fn findings(&self, diagnostics: &[Diagnostic]) -> Vec<Finding> {
        let mut diagnostics = diagnostics.to_vec();
        for diagnostic in &mut diagnostics {
            let files = diagnostic.trace.iter_mut().map(|step| &mut step.file);
            files.chain(&mut diagnostic.file).for_each(|file| *file = self.relative(file));
        }
        Finding::from_diagnostics(self.workspace, diagnostics)
    }

    fn names(&self, files: &BTreeSet<Utf8PathBuf>) -> Vec<String> {
        files.iter().map(|file| self.relative(file).into_string()).collect()
    }

    fn relative(&self, file: &Utf8Path) -> Utf8PathBuf {
        file.strip_prefix(&self.workspace.working_directory).unwrap_or(file).to_owned()
    }
}

impl<F: FnMut(WatchReport) -> bool> Listener for ReportForwarder<'_, F> {
    fn set_wake_handle(&self, bell: WakeHandle) {
        *self.bell.borrow_mut() = Some(bell);
    }

    fn first_check_done(&self, check: &FirstCheck) {
        self.forward(WatchReport {
            changed: Vec::new(),
            removed: Vec::new(),
            before: Vec::new(),
            now: self.findings(&check.diagnostics),
        });
    }

    fn batch_done(&self, update: &Update) {
        self.forward(WatchReport {
            changed: self.names(&update.changed),
            removed: self.names(&update.removed),
            before: self.findings(&update.before),
            now: self.findings(&update.now),
        });
    }
}
