//! `watch`: checks drawings and writes programs whenever drawings change. (book: reference/commands, `watch`)
//!
//! A single loop waits for changes, debounces them, applies them to the database as one revision, and checks only the drawings that the
//! reverse index names. Reports carry the number of the revision. Drawings are checked in portions: if more changes arrive in the meantime,
//! the remaining drawings are checked together with those that the new changes affect.

mod changes;
mod directories;
mod events;
mod library;
#[cfg(test)]
mod tests;
mod writing;

use std::collections::HashSet;
use std::hash::{Hash, Hasher};
use std::time::Instant;

use pathbuild_db::SourceFile;
use pathbuild_diagnostic::Diagnostic;
use rustc_hash::FxHashMap;

use crate::baseline::Baseline;
use crate::findings::{Findings, identity};
use crate::session::Session;
use crate::workspace::Workspace;

use changes::{WaitOutcome, Watcher};
use events::{Changes, Restart};
pub use events::{FindingCounts, FirstCheck, Listener, Request, Update, WakeHandle, WatchEnd};
use library::Library;
use writing::Writer;

impl Request<'_> {
    /// Watches until the end is requested, or until watching must start again.
    pub fn run(&self, workspace: &Workspace, listener: &dyn Listener) -> WatchEnd {
        let session = Session::open(workspace, true);
        if self.inputs.inputs.is_empty() && !session.has_library() {
            return WatchEnd::NothingNamed;
        }
        let writer = match Writer::new(workspace, listener, self) {
            Ok(writer) => writer,
            Err(problems) => return WatchEnd::BadPost(problems),
        };
        if self.emits && workspace.settings.emit.targets.value.is_empty() {
            return WatchEnd::NoTargets;
        }
        let baseline = match workspace.read_baseline(None) {
            Ok(baseline) => baseline,
            Err(problems) => return WatchEnd::BadBaseline(problems),
        };
        let mut sources = writer.sources();
        sources.extend(workspace.settings.file.is_some().then(|| workspace.baseline_file(None)));
        // Start watching before anything is read, so that no change is missed.
        match Watcher::new(&session, self, &sources) {
            Ok(_) if !listener.is_configuration_current() => WatchEnd::ConfigurationChanged,
            Ok(watcher) => {
                let library = Library::new(session, self.inputs);
                let (tally, reported) = Default::default();
                WatchLoop { listener, library, writer, watcher, baseline, tally, reported, revision: 0 }.run()
            }
            Err(reason) => WatchEnd::CannotWatch(reason.to_string()),
        }
    }
}

struct WatchLoop<'a> {
    listener: &'a dyn Listener,
    library: Library<'a>,
    writer: Writer<'a>,
    watcher: Watcher,
    baseline: Option<Baseline>,
    tally: FindingTally,
    /// The findings that were reported last.
    reported: Findings,
    revision: u64,
}

/// Number of drawings that the first check processes before it handles a pending wake-up or the end of watching.
const FIRST_PORTION: usize = 512;

/// Number of drawings checked between polls for new changes.
const DRAWINGS_PER_POLL: usize = 64;

impl WatchLoop<'_> {
    fn run(mut self) -> WatchEnd {
        self.listener.set_wake_handle(self.watcher.wake_handle.clone());
        self.begin();
        loop {
            match self.watcher.next(&self.library) {
                WaitOutcome::Restart(Restart::Configuration) => return WatchEnd::ConfigurationChanged,
                WaitOutcome::Restart(Restart::Directories) => return WatchEnd::DirectoriesChanged,
                WaitOutcome::ConfigurationInDoubt if !self.listener.is_configuration_current() => {
                    return WatchEnd::ConfigurationChanged;
                }
                WaitOutcome::ConfigurationInDoubt => {}
                WaitOutcome::Over => return WatchEnd::Over,
                WaitOutcome::WokenUp => self.listener.woken(self.library.session_mut()),
                WaitOutcome::Changes(changes) => self.update(&changes),
            }
        }
    }

    fn begin(&mut self) {
        let begun = Instant::now();
        let mut found = self.library.find();
        self.follow_links();
        let drawings: Vec<SourceFile> = self.library.unchecked_drawings().collect();
        self.listener.drawings_found(self.library.session_mut(), &drawings, &found.now);
        while self.library.has_backlog() && !self.watcher.is_over(self.library.session()) {
            let portion = self.library.check_portion(FIRST_PORTION, &mut found);
            self.follow_links();
            self.report_checked(&portion);
        }
        self.library.check_common(&mut found);
        self.writer.set_second_definitions(&self.library);
        self.writer.write(self.library.session_mut(), &found.checked_files);
        let (session, scope) = self.library.session_and_scope();
        self.writer.update_problems(session, Some(&scope), &mut found);
        let programs = self.writer.target_drawings(self.library.session(), &found.checked_files);
        if !programs.is_empty() {
            self.report_checked(&programs);
        }
        let time = begun.elapsed();
        let (drawings, paths) = self.library.counts();
        let diagnostics = self.library.session().with_hints(found.now);
        self.tally.replace(&[], &diagnostics);
        self.reported = self.findings();
        let (findings, problems) = (self.reported.clone(), self.common_problems());
        self.listener.first_check_done(&FirstCheck {
            drawings,
            paths,
            diagnostics,
            findings,
            problems,
            time,
        });
    }

    fn update(&mut self, changes: &Changes) {
        let affected = self.library.apply(changes);
        if !self.library.has_backlog() && !affected.has_news() {
            return;
        }
        self.revision += 1;
        let checked_files = self.work_on(affected);
        // Drawings and programs with transient diagnostics, such as an exceeded time limit, may exceed the limit again, so they must not delay the
        // results of the change itself.
        if !self.library.has_backlog() && !self.watcher.has_news(self.library.session()) {
            let unwritten = self.writer.transient_drawings(self.library.session());
            let again = self.library.mark_transient(&unwritten, &checked_files);
            if self.library.has_backlog() || again.has_news() {
                self.work_on(again);
            }
        }
    }

    /// Checks the remaining drawings, writes their programs, and reports the outcome. Returns the checked drawings.
    fn work_on(&mut self, mut found: Update) -> Vec<SourceFile> {
        let begun = Instant::now();
        let rivals = self.writer.forget(self.library.session(), &found.removed);
        self.library.schedule_check(rivals);
        let other = self.writer.set_second_definitions(&self.library);
        self.library.schedule_check(other);
        self.follow_links();
        while self.library.has_backlog() {
            let portion = self.library.check_portion(DRAWINGS_PER_POLL, &mut found);
            self.follow_links();
            let mut again = self.writer.set_second_definitions(&self.library);
            again.retain(|drawing| !portion.contains(drawing));
            again.extend(self.writer.write(self.library.session_mut(), &portion));
            self.library.schedule_check(again);
            self.report_checked(&portion);
            // The remaining drawings may have changed in the meantime.
            if self.watcher.has_news(self.library.session()) {
                break;
            }
        }
        self.library.check_common(&mut found);
        self.library.postpone_rest(&mut found);
        let is_complete = !self.library.has_backlog();
        let (session, scope) = self.library.session_and_scope();
        self.writer.update_problems(session, is_complete.then_some(&scope), &mut found);
        found.time = begun.elapsed();
        if found.has_other_problems {
            found.problems = self.common_problems();
        }
        for diagnostics in [&mut found.before, &mut found.now] {
            *diagnostics = self.library.session().with_hints(std::mem::take(diagnostics));
        }
        self.tally.replace(&found.before, &found.now);
        let earlier = std::mem::take(&mut self.reported);
        self.reported = self.findings();
        found.new = difference(&self.reported.diagnostics, &earlier.diagnostics);
        found.fixed = difference(&earlier.diagnostics, &self.reported.diagnostics);
        found.counts = FindingCounts::of(&self.reported);
        found.revision = self.revision;
        self.listener.batch_done(&found);
        found.checked_files
    }

    /// Returns all findings as `check` reports them.
    fn findings(&self) -> Findings {
        let workspace = self.library.session().workspace();
        let findings = workspace.findings(self.tally.all());
        workspace.without_accepted(findings, self.baseline.as_ref(), || self.library.coverage())
    }

    /// Returns the diagnostics that belong to no single drawing.
    fn common_problems(&self) -> Vec<Diagnostic> {
        [self.library.all_problems(), self.writer.common_problems().to_vec()].concat()
    }

    /// Watches the targets of links, if possible before the linked files are read.
    fn follow_links(&mut self) {
        let files = self.library.take_new_dependencies();
        let refused = self.watcher.watch_link_targets(self.library.session(), files);
        if !refused.is_empty() {
            self.listener.not_watched(&refused);
        }
    }

    /// Reports checked drawings, and handles a pending wake-up.
    fn report_checked(&mut self, checked: &[SourceFile]) {
        let session = self.library.session_mut();
        self.listener.drawings_checked(session, checked, self.writer.post_processor());
        _ = self.watcher.is_over(session);
        if self.watcher.take_wake_up() {
            self.listener.woken(session);
        }
    }
}

/// The number of checks that report each finding. Several drawings may have the same finding.
#[derive(Debug, Default)]
struct FindingTally(FxHashMap<CountedFinding, usize>);

impl FindingTally {
    /// Replaces previous findings by current ones. A finding that is in both gets its current trace and notes.
    fn replace(&mut self, before: &[Diagnostic], now: &[Diagnostic]) {
        for found in now.iter().cloned().map(CountedFinding) {
            let count = self.0.remove(&found).unwrap_or_default();
            self.0.insert(found, count + 1);
        }
        for found in before.iter().cloned().map(CountedFinding) {
            match self.0.get_mut(&found) {
                Some(count) if *count > 1 => *count -= 1,
                _ => _ = self.0.remove(&found),
            }
        }
    }

    /// Returns all findings, each once.
    fn all(&self) -> Vec<Diagnostic> {
        self.0.keys().map(|found| found.0.clone()).collect()
    }
}

/// Returns the findings that are not among `others`. A finding with other notes counts as another finding.
fn difference(findings: &[Diagnostic], others: &[Diagnostic]) -> Vec<Diagnostic> {
    let others: HashSet<_> = others.iter().map(shown_parts).collect();
    findings.iter().filter(|found| !others.contains(&shown_parts(found))).cloned().collect()
}

fn shown_parts(found: &Diagnostic) -> impl Eq + Hash + '_ {
    (identity(found), &found.notes)
}

/// A finding that is compared by its identity, without trace and notes.
#[derive(Debug)]
struct CountedFinding(Diagnostic);

impl PartialEq for CountedFinding {
    fn eq(&self, other: &Self) -> bool {
        identity(&self.0) == identity(&other.0)
    }
}

impl Eq for CountedFinding {}

impl Hash for CountedFinding {
    fn hash<H: Hasher>(&self, state: &mut H) {
        identity(&self.0).hash(state);
    }
}
