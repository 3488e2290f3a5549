//! The watched drawings with their results. Determines which drawings a change affects: by the files that their results depend on, and by the names
//! that they look up in directories.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, is_drawing, join};
use pathbuild_db::{Db, SecondDefinition, SourceFile, Trace, drawing_names, second_definitions};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use super::events::{Changes, Update};
use crate::check::{self, NamedDrawing, check_drawings};
use crate::common_findings::{globs_without_file, patterns_without_layer, unused_configurations};
use crate::emit::CoveredDrawings;
use crate::files::FILE_NAME;
use crate::memo::{Coverage, DrawingResult, is_transient};
use crate::session::{IGNORE_FILES, QProjectPair, Selection, Session, is_ignore_file, q_project_pairs};
use crate::{Inputs, waivers};

/// The watched drawings with their results.
pub(super) struct Library<'a> {
    session: Session<'a>,
    inputs: &'a Inputs,
    coverage: Coverage,
    drawings: BTreeMap<Utf8PathBuf, DrawingResult>,
    /// Drawings that were found in directories, which excludes those that arguments name.
    found_drawings: Vec<Utf8PathBuf>,
    /// The directories that were searched.
    directories: Vec<Utf8PathBuf>,
    /// Diagnostics of arguments and directories.
    problems: Vec<Diagnostic>,
    /// Diagnostics that follow from all drawings together.
    common_problems: Vec<Diagnostic>,
    /// Whether drawings, paths or layers have come or gone since the common diagnostics were determined.
    has_other_content: bool,
    q_projects: BTreeMap<[Utf8PathBuf; 2], Vec<Diagnostic>>,
    /// Each drawing that has a Q-project, with that Q-project; computed on demand.
    pairs: Option<BTreeSet<[Utf8PathBuf; 2]>>,
    reverse: ReverseIndex,
    names: NameSnapshots,
    /// Drawings yet to be checked, sorted by path.
    open: BTreeMap<Utf8PathBuf, SourceFile>,
    /// The changed files that require checking the drawings in `open`.
    backlog_cause: BTreeSet<Utf8PathBuf>,
    /// Dependencies that have not yet been checked for links.
    unfollowed: BTreeSet<Utf8PathBuf>,
}

impl<'a> Library<'a> {
    /// Creates a library without drawings; [`find`](Self::find) adds them.
    pub(super) fn new(session: Session<'a>, inputs: &'a Inputs) -> Self {
        Self {
            coverage: Coverage::new(session.workspace()),
            session,
            inputs,
            drawings: BTreeMap::new(),
            found_drawings: Vec::new(),
            directories: Vec::new(),
            problems: Vec::new(),
            common_problems: Vec::new(),
            has_other_content: true,
            q_projects: BTreeMap::new(),
            pairs: None,
            reverse: ReverseIndex::default(),
            names: NameSnapshots::default(),
            open: BTreeMap::new(),
            backlog_cause: BTreeSet::new(),
            unfollowed: BTreeSet::new(),
        }
    }

    pub(super) fn session(&self) -> &Session<'a> {
        &self.session
    }

    pub(super) fn session_mut(&mut self) -> &mut Session<'a> {
        &mut self.session
    }

    /// Returns the numbers of drawings and of paths.
    pub(super) fn counts(&self) -> (usize, usize) {
        (self.drawings.len(), self.drawings.values().map(|result| result.names.len()).sum())
    }

    /// Finds and reads the drawings, and marks all of them to be checked. Returns diagnostics of arguments and directories.
    pub(super) fn find(&mut self) -> Update {
        let selection = self.session.select(self.inputs);
        let mut drawings = selection.whole_drawings(&self.session);
        drawings.extend(selection.paths.iter().map(|path| path.file));
        self.session.parse_ahead(&drawings);
        let db = self.session.db();
        self.open = drawings.into_iter().map(|file| (file.path(db).clone(), file)).collect();
        self.unfollowed.extend(self.open.keys().cloned().chain(ignore_files(&self.session, &selection)));
        self.problems = self.store_selection(selection);
        Update { now: self.problems.clone(), ..Update::default() }
    }

    /// Stores the selection, and returns the diagnostics of arguments and directories.
    fn store_selection(&mut self, selection: Selection) -> Vec<Diagnostic> {
        let mut problems = selection.problems;
        problems.extend(unused_configurations(&self.session, &selection.below));
        (self.found_drawings, self.directories) = (selection.drawings, selection.below);
        problems
    }

    /// Returns what the checks cover, which decides whether a waiver without a match is reported.
    pub(super) fn coverage(&self) -> waivers::Coverage {
        let request = check::Request { inputs: self.inputs, with_all_values: false, changed: None };
        request.coverage(self.session.workspace(), self.drawings.keys().cloned().collect())
    }

    /// Returns the session, and the drawings and directories that are watched.
    pub(super) fn session_and_scope(&mut self) -> (&mut Session<'a>, CoveredDrawings<'_>) {
        let scope = CoveredDrawings {
            is_library: self.inputs.inputs.is_empty(),
            drawings: &self.found_drawings,
            directories: &self.directories,
        };
        (&mut self.session, scope)
    }

    /// Returns the diagnostics that belong to no single drawing.
    pub(super) fn all_problems(&self) -> Vec<Diagnostic> {
        [&*self.problems, &*self.common_problems].concat()
    }

    /// Applies changes to the database and marks the affected drawings to be checked.
    pub(super) fn apply(&mut self, changes: &Changes) -> Update {
        let mut update = Update::default();
        let mut concerned: HashSet<SourceFile> = HashSet::new();
        let files = self.changed_files(changes);
        let mut is_other_library = self.apply_names(changes, &files, &mut concerned) || changes.is_incomplete;
        for path in &files {
            concerned.extend(self.reverse.dependents_of_file(self.session.db().file(path)));
            self.session.touch_file(path);
        }
        is_other_library |= changes.paths.iter().any(|path| self.may_be_other_library(path));
        if is_other_library {
            self.find_drawings(&mut concerned, &mut update);
        }
        let db = self.session.db();
        let concerned = concerned.into_iter().filter(|file| {
            self.drawings.contains_key(file.path(db)) && !update.removed.contains(file.path(db))
                || update.changed.contains(file.path(db))
        });
        self.open.extend(concerned.map(|file| (file.path(db).clone(), file)));
        self.open.retain(|path, _| !update.removed.contains(path));
        self.unfollowed.extend(self.open.keys().chain(&files).cloned());
        update.changed.extend(files);
        let configurations = changes.paths.iter().filter(|path| path.file_name() == Some(FILE_NAME));
        update.changed.extend(configurations.cloned());
        update.changed.append(&mut self.backlog_cause);
        update
    }

    /// Marks drawings with transient diagnostics to be checked again, except those just checked, and lists unreadable directories again. `further`
    /// names drawings with programs that have transient diagnostics or could not be written.
    pub(super) fn mark_transient(
        &mut self,
        further: &BTreeSet<Utf8PathBuf>,
        checked_files: &[SourceFile],
    ) -> Update {
        let (mut update, mut concerned) = (Update::default(), HashSet::new());
        let may_pass = |result: &DrawingResult| result.diagnostics.iter().any(is_transient);
        let system = &*self.session.workspace().system;
        let is_missing = |path: &Utf8PathBuf| system.kind(path) == FileKind::Missing;
        let has_missing = self.drawings.iter().any(|(path, result)| may_pass(result) && is_missing(path));
        // A drawing may have been removed before its directory was watched, so that no event reports it.
        if has_missing || self.problems.iter().any(is_transient) {
            self.find_drawings(&mut concerned, &mut update);
        }
        let db = self.session.db();
        let unsure = self.drawings.iter().filter(|(_, result)| may_pass(result));
        let unsure: Vec<SourceFile> = unsure.map(|(path, _)| db.file(path)).collect();
        let found = self.drawings.values().flat_map(|result| &result.diagnostics);
        let found = found.filter(|found| is_transient(found)).filter_map(|found| found.file.as_ref());
        let files: BTreeSet<Utf8PathBuf> = found.chain(further).cloned().collect();
        concerned.extend(
            files.iter().flat_map(|path| self.reverse.dependents_of_file(db.file(path))).chain(unsure),
        );
        concerned.retain(|drawing| !checked_files.contains(drawing));
        if !concerned.is_empty() {
            // A diagnostic about a directory means that the directory could not be listed.
            for path in &files {
                self.session.touch_file(path);
                let directory = without_dot(path);
                if self.names.has(directory) {
                    self.relist_names(directory, &mut concerned);
                } else {
                    self.session.touch_directory(directory);
                }
            }
        }
        let db = self.session.db();
        self.open = concerned.into_iter().map(|drawing| (drawing.path(db).clone(), drawing)).collect();
        let again = self.open.keys().filter(|path| !update.changed.contains(*path)).cloned();
        let listed = update.before.iter().filter(|problem| !update.now.contains(problem));
        update.tried_again = again.chain(listed.filter_map(|problem| problem.file.clone())).collect();
        update
    }

    /// Takes the dependencies that were found or changed since the last call.
    pub(super) fn take_new_dependencies(&mut self) -> BTreeSet<Utf8PathBuf> {
        std::mem::take(&mut self.unfollowed)
    }

    pub(super) fn has_backlog(&self) -> bool {
        !self.open.is_empty()
    }

    pub(super) fn unchecked_drawings(&self) -> impl Iterator<Item = SourceFile> {
        self.open.values().copied()
    }

    /// Returns the files on which results depend, and the drawings still to be checked; a file may occur twice.
    pub(super) fn known_files(&self) -> impl Iterator<Item = SourceFile> {
        self.reverse.files().chain(self.unchecked_drawings())
    }

    pub(super) fn schedule_check(&mut self, drawings: Vec<SourceFile>) {
        let db = self.session.db();
        self.open.extend(drawings.into_iter().map(|file| (file.path(db).clone(), file)));
    }

    /// Checks up to `most` of the drawings still to be checked, and returns them.
    pub(super) fn check_portion(&mut self, most: usize, update: &mut Update) -> Vec<SourceFile> {
        let portion: Vec<SourceFile> =
            std::iter::from_fn(|| self.open.pop_first()).map(|(_, file)| file).take(most).collect();
        self.check_and_record(portion.clone(), update);
        portion
    }

    /// Leaves the remaining drawings to the next batch.
    pub(super) fn postpone_rest(&mut self, update: &mut Update) {
        update.open = self.open.len();
        if self.has_backlog() {
            self.backlog_cause.clone_from(&update.changed);
        }
    }

    /// Whether a drawing was checked or is to be checked.
    fn holds(&self, drawing: &Utf8Path) -> bool {
        self.drawings.contains_key(drawing) || self.open.contains_key(drawing)
    }

    /// Whether a change of this file or directory may add or remove drawings or configurations, even if no drawing changed.
    fn may_be_other_library(&self, path: &Utf8Path) -> bool {
        let decides = |name: &str| is_ignore_file(name) || name == FILE_NAME;
        let mut named = self.problems.iter().filter_map(|problem| problem.file.as_ref());
        path.file_name().is_some_and(decides)
            || self.session.is_directory(path)
            || named.any(|file| file.starts_with(path))
    }

    /// Returns the files that the changes affect: changed files, and the files in changed directories.
    fn changed_files(&self, changes: &Changes) -> BTreeSet<Utf8PathBuf> {
        let db = self.session.db();
        let mut files: BTreeSet<Utf8PathBuf> = BTreeSet::new();
        if changes.is_incomplete {
            files.extend(self.known_files().map(|file| file.path(db).clone()));
        }
        for path in &changes.paths {
            if is_drawing(path) {
                files.insert(path.clone());
            } else {
                let below = self.known_files().filter(|file| file.path(db).starts_with(path));
                files.extend(below.map(|file| file.path(db).clone()));
                if self.session.is_directory(path) {
                    let drawings = self.session.drawings_below(path);
                    files.extend(drawings.map(|drawing| self.session.normalize(&drawing)));
                }
            }
        }
        files
    }

    /// Lists again the directories in which files were added or removed, and collects the drawings that looked up a name that has appeared or
    /// disappeared there. Returns whether any file name has changed.
    fn apply_names(
        &mut self,
        changes: &Changes,
        files: &BTreeSet<Utf8PathBuf>,
        concerned: &mut HashSet<SourceFile>,
    ) -> bool {
        let system = &*self.session.workspace().system;
        let is_there = |path: &Utf8Path| system.kind(path) == FileKind::File;
        let mut have_changed = files.iter().any(|path| is_there(path) != self.holds(path));
        let mut directories: BTreeSet<Utf8PathBuf> = BTreeSet::new();
        for path in files {
            let (directory, name) = (parent(path), path.file_name().unwrap_or_default());
            if self.names.has(directory) && self.names.holds(directory, name) != is_there(path) {
                directories.insert(directory.to_owned());
            }
        }
        // If a directory appeared or disappeared as a whole, or events were lost, the individual names are unknown.
        let is_doubtful = |directory: &Utf8PathBuf| {
            changes.is_incomplete || changes.paths.iter().any(|path| directory.starts_with(path))
        };
        directories.extend(self.names.directories().filter(|directory| is_doubtful(directory)).cloned());
        for directory in directories {
            have_changed |= self.relist_names(&directory, concerned);
        }
        have_changed
    }

    /// Lists a directory again, and collects the drawings that looked up a name that has appeared or disappeared. Returns whether any names changed.
    fn relist_names(&mut self, directory: &Utf8Path, concerned: &mut HashSet<SourceFile>) -> bool {
        let changed = self.names.relist(&mut self.session, directory);
        let names = changed.iter().map(|name| &**name);
        concerned.extend(self.reverse.dependents_on_names(directory, names, &self.coverage));
        !changed.is_empty()
    }

    /// Searches for drawings again: marks new ones to be checked, and drops missing ones.
    fn find_drawings(&mut self, concerned: &mut HashSet<SourceFile>, update: &mut Update) {
        let selection = self.session.select(self.inputs);
        self.unfollowed.extend(ignore_files(&self.session, &selection));
        let db = self.session.db();
        let named = selection.named.iter().copied().chain(selection.paths.iter().map(|path| path.file));
        let named = named.map(|file| file.path(db));
        let existing: BTreeSet<&Utf8PathBuf> = selection.drawings.iter().chain(named).collect();
        for drawing in &existing {
            if !self.drawings.contains_key(*drawing) {
                concerned.insert(db.file(drawing));
                update.changed.insert((*drawing).clone());
            }
        }
        // Drawings in an unreadable directory may still exist.
        let unlisted: Vec<&Utf8PathBuf> = selection
            .problems
            .iter()
            .filter(|problem| is_transient(problem))
            .filter_map(|problem| problem.file.as_ref())
            .collect();
        let is_unsure =
            |drawing: &Utf8PathBuf| unlisted.iter().any(|place| drawing.starts_with(without_dot(place)));
        let is_gone = |drawing: &Utf8PathBuf| !existing.contains(drawing) && !is_unsure(drawing);
        // Drawings may have been removed before they were checked for the first time.
        let unchecked = self.open.extract_if(.., |drawing, _| is_gone(drawing));
        update.removed.extend(unchecked.map(|(drawing, _)| drawing));
        update.changed.extend(update.removed.iter().cloned());
        let gone: Vec<(Utf8PathBuf, DrawingResult)> =
            self.drawings.extract_if(.., |drawing, _| is_gone(drawing)).collect();
        for (drawing, result) in gone {
            self.reverse.remove(db.file(&drawing));
            self.pairs = None;
            let compared = self.q_projects.extract_if(.., |pair, _| pair.contains(&drawing));
            update.before.extend(compared.flat_map(|(_, found)| found));
            self.has_other_content = true;
            update.before.extend(result.diagnostics);
            update.changed.insert(drawing.clone());
            update.removed.insert(drawing);
        }
        let problems = self.store_selection(selection);
        if self.problems != problems {
            update.now.extend_from_slice(&problems);
            update.before.extend(std::mem::replace(&mut self.problems, problems));
            update.has_other_problems = true;
        }
    }

    /// Whether drawings, paths or layers have come or gone since [`check_common`](Self::check_common).
    pub(super) fn has_other_content(&self) -> bool {
        self.has_other_content
    }

    pub(super) fn second_definitions(&self, are_together: bool) -> BTreeSet<SecondDefinition> {
        let drawings = self.drawings.iter().map(|(file, result)| (&**file, &*result.names));
        second_definitions(self.session.db(), drawings, are_together)
    }

    /// Determines the diagnostics that follow from all drawings together, once all are checked.
    pub(super) fn check_common(&mut self, update: &mut Update) {
        if self.has_backlog() || !std::mem::take(&mut self.has_other_content) {
            return;
        }
        let mut found: Vec<Diagnostic> =
            self.second_definitions(false).iter().map(SecondDefinition::diagnostic).collect();
        if self.inputs.inputs.is_empty() {
            found.extend(patterns_without_layer(&self.session, self.drawings.values()));
            found.extend(globs_without_file(&self.session, self.drawings.keys().map(|file| &**file)));
        }
        if self.common_problems != found {
            update.now.extend_from_slice(&found);
            update.before.extend(std::mem::replace(&mut self.common_problems, found));
            update.has_other_problems = true;
        }
    }

    fn check_and_record(&mut self, checked_files: Vec<SourceFile>, update: &mut Update) {
        let all: Vec<NamedDrawing<'_>> = checked_files.iter().map(|file| (*file, None)).collect();
        let results = self.session.with_stable_files(|session| check_drawings(session, &all, false));
        for (file, (result, traces)) in checked_files.iter().zip(results) {
            for directory in searched_directories(&traces) {
                self.names.add_missing(&self.session, directory);
            }
            let files =
                traces.iter().flat_map(|trace| &trace.files).filter(|read| !self.reverse.knows(**read));
            self.unfollowed.extend(
                files.filter(|read| **read != *file).map(|read| read.path(self.session.db()).clone()),
            );
            self.reverse.set(*file, traces);
            update.now.extend_from_slice(&result.diagnostics);
            let path = file.path(self.session.db());
            self.has_other_content |=
                self.drawings.get(path).is_none_or(|before| has_other_content(before, &result));
            let before = self.drawings.insert(path.clone(), result);
            if before.is_none() {
                self.pairs = None;
            }
            update.before.extend(before.into_iter().flat_map(|result| result.diagnostics));
        }
        self.compare_q_projects(&checked_files, update);
        update.checked_files.extend(checked_files);
    }

    /// Compares drawings with their Q-projects, if one of the two was checked or the pair is new.
    fn compare_q_projects(&mut self, checked_files: &[SourceFile], update: &mut Update) {
        if self.pairs.is_none() {
            self.update_q_project_pairs(update);
        }
        let Some(pairs) = self.pairs.as_ref().filter(|pairs| !pairs.is_empty()) else { return };
        let db = self.session.db();
        let checked_files: HashSet<&Utf8PathBuf> = checked_files.iter().map(|file| file.path(db)).collect();
        let is_open = |pair: &&[Utf8PathBuf; 2]| {
            !self.q_projects.contains_key(*pair) || pair.iter().any(|path| checked_files.contains(path))
        };
        let open: Vec<[Utf8PathBuf; 2]> = pairs.iter().filter(is_open).cloned().collect();
        let files: Vec<QProjectPair> =
            open.iter().map(|pair| [db.file(&pair[0]), db.file(&pair[1])]).collect();
        let found = self.session.with_stable_files(|session| session.compare_q_projects(&files));
        for (pair, found) in open.into_iter().zip(found) {
            update.now.extend_from_slice(&found);
            update.before.extend(self.q_projects.insert(pair, found).into_iter().flatten());
        }
    }

    /// Finds the drawings that have a Q-project. Among ten thousand drawings, this takes as long as processing an edit, so the pairs are kept until
    /// drawings come or go.
    fn update_q_project_pairs(&mut self, update: &mut Update) {
        let pairs = q_project_pairs(self.session.db().system(), self.drawings.keys()).into_iter();
        let pairs: BTreeSet<[Utf8PathBuf; 2]> = pairs.collect();
        let gone: Vec<_> = self.q_projects.extract_if(.., |pair, _| !pairs.contains(pair)).collect();
        update.before.extend(gone.into_iter().flat_map(|(_, found)| found));
        self.pairs = Some(pairs);
    }
}

/// Whether the common diagnostics may change because of a drawing's new result.
fn has_other_content(before: &DrawingResult, now: &DrawingResult) -> bool {
    let content = |result: &DrawingResult| (result.layers, result.is_unread());
    before.names != now.names || content(before) != content(now)
}

/// Returns the directory that a diagnostic names; the empty path for `.`, the working directory.
fn without_dot(directory: &Utf8Path) -> &Utf8Path {
    if directory == "." { Utf8Path::new("") } else { directory }
}

/// Returns the directories in which lookups were made.
fn searched_directories(traces: &[Trace]) -> impl Iterator<Item = &Utf8PathBuf> {
    traces.iter().flat_map(|trace| &trace.lookups).flat_map(|lookup| &lookup.directories)
}

/// Returns the directory of a file; the working directory is the empty path.
fn parent(path: &Utf8Path) -> &Utf8Path {
    path.parent().unwrap_or(Utf8Path::new(""))
}

/// Returns the paths that ignore files have or would have in the searched directories and in that of the configuration. Such files may be links,
/// whose targets must be watched as well.
fn ignore_files(session: &Session<'_>, selection: &Selection) -> Vec<Utf8PathBuf> {
    let top = session.workspace().settings.directory().map(|directory| session.normalize(directory));
    let directories = selection.below.iter().chain(&top);
    directories.flat_map(|directory| IGNORE_FILES.map(|name| join(directory, name))).collect()
}

/// The drawings that depend on each input.
#[derive(Default)]
pub(super) struct ReverseIndex {
    by_file: HashMap<SourceFile, HashSet<SourceFile>>,
    by_lookup: HashMap<Utf8PathBuf, BTreeMap<PathName, HashSet<SourceFile>>>,
    /// The inputs of each drawing's results, needed to remove the drawing.
    traces: HashMap<SourceFile, Vec<Trace>>,
}

impl ReverseIndex {
    /// Records the inputs of a drawing's results, and replaces earlier ones.
    pub(super) fn set(&mut self, drawing: SourceFile, traces: Vec<Trace>) {
        // Fast path: most edits change geometry but not the embedded paths.
        if self.traces.get(&drawing) == Some(&traces) {
            return;
        }
        self.remove(drawing);
        for trace in &traces {
            for file in &trace.files {
                self.by_file.entry(*file).or_default().insert(drawing);
            }
            for (directory, name) in lookups(trace) {
                let names = self.by_lookup.entry(directory.clone()).or_default();
                names.entry(name.clone()).or_default().insert(drawing);
            }
        }
        self.traces.insert(drawing, traces);
    }

    pub(super) fn remove(&mut self, drawing: SourceFile) {
        for trace in self.traces.remove(&drawing).unwrap_or_default() {
            for file in &trace.files {
                if let Some(drawings) = self.by_file.get_mut(file) {
                    drawings.remove(&drawing);
                }
            }
            for (directory, name) in lookups(&trace) {
                if let Some(drawings) =
                    self.by_lookup.get_mut(directory).and_then(|names| names.get_mut(name))
                {
                    drawings.remove(&drawing);
                }
            }
        }
    }

    /// Returns the drawings that depend on the contents of a file.
    pub(super) fn dependents_of_file(&self, file: SourceFile) -> impl Iterator<Item = SourceFile> {
        self.by_file.get(&file).into_iter().flatten().copied()
    }

    /// Returns the drawings that looked up names in a directory and may get other results if files of these names appear or disappear.
    pub(super) fn dependents_on_names<'n>(
        &self,
        directory: &Utf8Path,
        names: impl IntoIterator<Item = &'n str>,
        coverage: &Coverage,
    ) -> Vec<SourceFile> {
        let covered = coverage.of_files(names);
        let lookups = self.by_lookup.get(directory).into_iter().flatten();
        let concerned = lookups.filter(|(path, _)| covered.may_hold(path.as_str()));
        concerned.flat_map(|(_, drawings)| drawings).copied().collect()
    }

    /// Whether any drawing's result depends on the file.
    pub(super) fn knows(&self, file: SourceFile) -> bool {
        self.by_file.contains_key(&file)
    }

    /// Iterates over all files that some drawing's result depends on.
    pub(super) fn files(&self) -> impl Iterator<Item = SourceFile> {
        self.by_file.keys().copied()
    }
}

fn lookups(trace: &Trace) -> impl Iterator<Item = (&Utf8PathBuf, &PathName)> {
    trace
        .lookups
        .iter()
        .flat_map(|lookup| lookup.directories.iter().map(|directory| (directory, &lookup.name)))
}

/// The drawing names in each directory, as seen by all results that depend on them.
#[derive(Default)]
pub(super) struct NameSnapshots(BTreeMap<Utf8PathBuf, BTreeSet<Box<str>>>);

impl NameSnapshots {
    /// Stores the names in a directory, unless they are stored already. Must be called in the revision of the results that depend on the directory.
    pub(super) fn add_missing(&mut self, session: &Session<'_>, directory: &Utf8Path) {
        if !self.0.contains_key(directory) {
            self.0.insert(directory.to_owned(), names_of(session, directory));
        }
    }

    pub(super) fn has(&self, directory: &Utf8Path) -> bool {
        self.0.contains_key(directory)
    }

    pub(super) fn directories(&self) -> impl Iterator<Item = &Utf8PathBuf> {
        self.0.keys()
    }

    pub(super) fn holds(&self, directory: &Utf8Path, name: &str) -> bool {
        self.0.get(directory).is_some_and(|names| names.contains(name))
    }

    /// Lists a directory again, in the database as well, and returns the names that were added or removed. Later results see the new names.
    pub(super) fn relist(&mut self, session: &mut Session<'_>, directory: &Utf8Path) -> Vec<Box<str>> {
        session.touch_directory(directory);
        let names = names_of(session, directory);
        let before = self.0.insert(directory.to_owned(), names.clone()).unwrap_or_default();
        before.symmetric_difference(&names).cloned().collect()
    }
}

fn names_of(session: &Session<'_>, directory: &Utf8Path) -> BTreeSet<Box<str>> {
    let db = session.db();
    drawing_names(db, db.directory(directory)).iter().map(Box::from).collect()
}
