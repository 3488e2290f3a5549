//! `check`: checks drawings, paths and directories without writing anything. Variables get example values, or all combinations of their values. On
//! request, only results that depend on changed drawings are shown. (book: reference/commands, `check`; book: language/variables)

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fmt::Debug;
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, is_drawing, join};
use pathbuild_db::{
    Database, Db, Role, SecondDefinition, SourceFile, Target, Trace, check_file, combinations, locate,
    path_names,
};
use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Message, Place, TextFault, Value};
use pathbuild_path::{Bindings, PathName};

use crate::common_findings::{globs_without_file, patterns_without_layer, unused_configurations};
use crate::config::ResultKind;
use crate::memo::{
    Answer, Coverage, Dependencies, DrawingResult, Memo, NamedLayers, check_query, find, read_named, subject,
};
use crate::post_processor::PostProcessor;
use crate::session::timings::{FINDING_DRAWINGS, STORING_RESULTS, VERIFYING_CACHE};
use crate::session::{
    ArgumentMatches, CheckedTarget, Checker, QProjectPair, SelectedPath, Selection, Session, compare_paths,
    q_project_pairs,
};
use crate::workspace::Failure;
use crate::workspace::{Workspace, relative};
use crate::{Input, Inputs, waivers};

/// A request to check drawings.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// The drawings, paths and directories to check; if empty, the whole library.
    pub inputs: &'a Inputs,
    /// Whether to check all combinations of the variables' values instead of one example value of each.
    pub with_all_values: bool,
    /// The state of the files at an earlier time. If set, only results that depend on drawings changed since then are shown.
    pub changed: Option<&'a dyn EarlierFiles>,
}

/// The diagnostics of a check, and the drawings that were checked.
#[derive(Clone, Debug, Default)]
pub struct CheckOutcome {
    /// All diagnostics, unsorted, with duplicates.
    pub diagnostics: Vec<Diagnostic>,
    /// The checked drawings, sorted by path.
    pub files: Vec<CheckedFile>,
    /// The checked drawings all of whose findings are in `diagnostics`. If only changed drawings are shown, findings of an unchanged drawing may
    /// belong to results that are left out.
    pub covered: Vec<Utf8PathBuf>,
}

/// A checked drawing with the names of its paths.
#[derive(Clone, Debug)]
pub struct CheckedFile {
    /// Path of the drawing's file.
    pub file: Utf8PathBuf,
    /// Names of the drawing's paths in file order, as the drawing spells them.
    pub paths: Vec<PathName>,
}

#[derive(Debug)]
struct CheckTarget {
    drawing: Utf8PathBuf,
    /// The paths to check; `None` means all.
    names: Option<Vec<PathName>>,
}

impl CheckTarget {
    fn subject(&self) -> Box<str> {
        subject(&self.drawing, self.names.as_deref())
    }
}

impl Request<'_> {
    /// Runs the check. Results are taken from the cache if they are still valid, and new ones are stored. The session must trace inputs if results
    /// are to be cached, or if they are limited to changed drawings.
    ///
    /// # Errors
    /// If the request is limited to changed drawings and the inputs are not all directories.
    pub fn run(&self, session: &mut Session<'_>) -> Result<CheckOutcome, Failure> {
        if !session.is_traced() {
            session.prefetch(self.inputs, &|_| false);
        }
        let mut matches = session.timings.measure(&FINDING_DRAWINGS, || session.match_arguments(self.inputs));
        let query = check_query(self.with_all_values);
        let open = || Memo::open(session, ResultKind::Check, &query, self.inputs, &mut matches);
        let memo = session.timings.measure(&VERIFYING_CACHE, open);
        let mut checked = self.check(session, &matches, &memo)?;
        checked.diagnostics = session.with_hints(checked.diagnostics);
        // Freeing a million values takes longer than process exit.
        std::mem::forget((memo, matches));
        Ok(checked)
    }

    /// Returns what the run covered, which decides whether a waiver without a match is reported. A run on single paths covers no drawing completely,
    /// and a run on some drawings does not cover the whole library.
    pub fn coverage(&self, workspace: &Workspace, files: Vec<Utf8PathBuf>) -> waivers::Coverage {
        let is_directory = |name: &Utf8Path| workspace.system.kind(name) == FileKind::Directory;
        let mut inputs = self.inputs.iter();
        let has_paths = inputs.any(|input| matches!(input, Input::Name(name) if !is_directory(name.into())));
        if has_paths {
            return waivers::Coverage::default();
        }
        let mut places = self.inputs.iter().map(|input| match input {
            Input::Place(place) => place,
            Input::Name(name) => Utf8Path::new(name),
        });
        waivers::Coverage {
            files,
            has_directories: places.all(is_directory),
            is_library: self.inputs.inputs.is_empty() && self.changed.is_none(),
        }
    }

    /// Checks the drawings that have no valid cached result.
    fn check(
        &self,
        session: &mut Session<'_>,
        matches: &ArgumentMatches,
        memo: &Memo,
    ) -> Result<CheckOutcome, Failure> {
        let Results { selection, named, selected } =
            session.with_stable_files(|session| self.check_or_take_cached(session, matches, memo));
        if self.changed.is_some() && !(selection.named.is_empty() && selection.paths.is_empty()) {
            // A drawing that depends on a changed one is only found if whole directories are checked.
            let reason = session.workspace().choose(
                "--changed-since is for directories or the library, not for single drawings or paths",
                "--changed-since ist für Verzeichnisse oder die Bibliothek, nicht für einzelne Zeichnungen oder Pfade",
            );
            return Err(Failure::Usage(reason.to_owned()));
        }
        let q_projects = session.with_stable_files(|session| compare_q_projects(session, memo, &selection));
        let answers = named.iter().chain(&selected).chain(&q_projects);
        session
            .timings
            .measure(&STORING_RESULTS, || memo.store_results(session, answers.filter_map(Answer::fresh)));
        let past = self.earlier_state(session, matches);
        let filter = ChangeFilter::new(session, memo, past, selected.iter().chain(&q_projects));
        let mut checked = CheckOutcome { diagnostics: matches.problems.clone(), ..CheckOutcome::default() };
        checked.diagnostics.extend(selection.problems);
        if !selection.below.is_empty() {
            let settings = &session.workspace().settings;
            checked.diagnostics.extend(PostProcessor::unknown_name(settings));
        }
        checked.diagnostics.extend(unused_configurations(session, &selection.below));
        if !session.is_compatible() {
            let named = selected.iter().skip(selection.drawings.len()).take(selection.named.len());
            checked.diagnostics.extend(named.filter_map(|answer| {
                session.no_path_error(answer.drawing(), &answer.value.names, &answer.value.diagnostics)
            }));
        }
        if !checked.diagnostics.iter().any(Diagnostic::is_error) {
            let parts = selected.iter().map(|answer| answer.value.parts());
            checked.diagnostics.extend(session.no_path_anywhere_error(parts));
        }
        checked.diagnostics.extend(second_definitions(session, &selected, &filter));
        if self.inputs.inputs.is_empty() {
            let results = selected.iter().map(|answer| &answer.value);
            checked.diagnostics.extend(patterns_without_layer(session, results));
            let drawings = selected.iter().map(Answer::drawing);
            checked.diagnostics.extend(globs_without_file(session, drawings));
        }
        for answer in selected.into_iter().filter(|answer| filter.contains(answer)) {
            let (file, DrawingResult { names, diagnostics, .. }) =
                (answer.drawing().to_owned(), answer.value);
            checked.covered.extend(filter.knows_all_findings(&file).then(|| file.clone()));
            checked.files.push(CheckedFile { file, paths: names });
            checked.diagnostics.extend(diagnostics);
        }
        checked.files.sort_by(|a, b| compare_paths(&a.file, &b.file));
        let q_projects = q_projects.into_iter().filter(|answer| filter.contains(answer));
        checked.diagnostics.extend(q_projects.flat_map(|answer| answer.value.diagnostics));
        Ok(checked)
    }

    fn check_or_take_cached(
        &self,
        session: &mut Session<'_>,
        matches: &ArgumentMatches,
        memo: &Memo,
    ) -> Results {
        let known = |path: &Utf8PathBuf| {
            if memo.holds(path.as_str()) { path.as_str().into() } else { subject(path, Some(&[])) }
        };
        let named = read_named(session, memo, matches.candidates(), known);
        let names = |file: SourceFile| {
            find(&named, file.path(session.db())).map_or(&[][..], |answer| &answer.value.names)
        };
        let selection = session.select_arguments(matches, &matches.arguments, &names);
        let targets = targets(session, &selection);
        let check = |open: &[&CheckTarget]| {
            if memo.is_some() {
                let known = targets.len() - open.len();
                session.workspace().report_cached(["drawings", "Zeichnungen"], known, targets.len());
            }
            let paths = open.iter().map(|target| (session.file(&target.drawing), target.names.as_deref()));
            let paths: Vec<(SourceFile, Option<&[PathName]>)> = paths.collect();
            let checked = check_drawings(session, &paths, self.with_all_values);
            checked.into_iter().map(|(result, traces)| result.with_inputs(traces)).collect()
        };
        let selected = memo.get_or(&targets, CheckTarget::subject, |_, result| Some(result), check);
        Results { selection, named, selected }
    }

    /// Returns the earlier state with which drawings are compared. `None` if all drawings are selected, because the request does not ask for changed
    /// ones only or because a file that affects all results has changed.
    fn earlier_state(&self, session: &Session<'_>, matches: &ArgumentMatches) -> Option<&dyn EarlierFiles> {
        let past = self.changed?;
        let directories: Vec<Utf8PathBuf> =
            matches.directories().flat_map(|directory| &directory.directories).cloned().collect();
        let Some(rule) = past.changed_common_file(&directories) else { return Some(past) };
        let context = session.workspace();
        context.reporter.status(&context.phrase(
            "checking everything: {} has changed since the revision",
            "alles wird geprüft: {} hat sich seit der Revision geändert",
            relative(&rule, &context.working_directory).as_str(),
        ));
        None
    }
}

struct Results {
    selection: Selection,
    /// Results of the drawings that may define a path named in the arguments.
    named: Vec<Answer<DrawingResult>>,
    /// Results of the drawings and paths that the arguments select.
    selected: Vec<Answer<DrawingResult>>,
}

/// Returns the targets to check: each drawing as a whole, and the drawings that define individually named paths, unless these are checked as a
/// whole.
fn targets(session: &Session<'_>, selection: &Selection) -> Vec<CheckTarget> {
    let db = session.db();
    let named = selection.named.iter().map(|file| file.path(db));
    let whole = selection.drawings.iter().chain(named);
    let mut targets: Vec<CheckTarget> =
        whole.map(|drawing| CheckTarget { drawing: drawing.clone(), names: None }).collect();
    if !selection.paths.is_empty() {
        let is_whole: HashSet<Utf8PathBuf> = targets.iter().map(|target| target.drawing.clone()).collect();
        let mut single: BTreeMap<&Utf8PathBuf, Vec<PathName>> = BTreeMap::new();
        for SelectedPath { file, name } in &selection.paths {
            single.entry(file.path(db)).or_default().push(name.clone());
        }
        let single = single.into_iter().filter(|(drawing, _)| !is_whole.contains(*drawing));
        targets.extend(
            single.map(|(drawing, names)| CheckTarget { drawing: drawing.clone(), names: Some(names) }),
        );
    }
    targets
}

fn compare_q_projects(
    session: &Session<'_>,
    memo: &Memo,
    selection: &Selection,
) -> Vec<Answer<DrawingResult>> {
    let named = selection.named.iter().map(|file| file.path(session.db()));
    let pairs = q_project_pairs(session.db().system(), selection.drawings.iter().chain(named));
    let compare = |open: &[&[Utf8PathBuf; 2]]| {
        let open: Vec<QProjectPair> =
            open.iter().map(|pair| pair.each_ref().map(|path| session.db().file(path))).collect();
        let found = session.compare_q_projects(&open).into_iter().zip(&open);
        let result = |(diagnostics, pair): (_, &QProjectPair)| {
            let trace = Trace { files: pair.to_vec(), lookups: Vec::new() };
            DrawingResult { diagnostics, ..DrawingResult::default() }.with_inputs(vec![trace])
        };
        found.map(result).collect()
    };
    let subject = |[drawing, q_project]: &[Utf8PathBuf; 2]| format!("{drawing}\0{q_project}").into();
    memo.get_or(&pairs, subject, |_, result| Some(result), compare)
}

/// Returns PB504 for each path that two of the checked drawings define, if the filter selects either drawing.
fn second_definitions(
    session: &Session<'_>,
    selected: &[Answer<DrawingResult>],
    filter: &ChangeFilter<'_>,
) -> Vec<Diagnostic> {
    let drawings = selected.iter().map(|answer| (answer.drawing(), &*answer.value.names));
    let found = pathbuild_db::second_definitions(session.db(), drawings, false);
    if found.is_empty() {
        return Vec::new();
    }
    let shown = selected.iter().filter(|answer| filter.contains(answer)).map(Answer::drawing);
    let shown: HashSet<&Utf8Path> = shown.collect();
    let found = found.iter().filter(|found| found.files.iter().any(|file| shown.contains(&**file)));
    found.map(SecondDefinition::diagnostic).collect()
}

/// Number of drawings checked between evictions of parsed data.
const BATCH: usize = 512;

/// A drawing with the paths in it to check; `None` means all.
pub type NamedDrawing<'a> = (SourceFile, Option<&'a [PathName]>);

/// Checks paths of drawings. Returns the result of each drawing with its inputs.
pub fn check_drawings(
    session: &mut Session<'_>,
    targets: &[NamedDrawing<'_>],
    with_all_values: bool,
) -> Vec<(DrawingResult, Vec<Trace>)> {
    let files: Vec<SourceFile> = targets.iter().map(|(file, _)| *file).collect();
    session.parse_ahead(&files);
    session.in_batches(targets, BATCH, |session, targets| {
        session.map_with_checker(targets, |checker, target| check_drawing(checker, target, with_all_values))
    })
}

fn check_drawing(
    checker: &Checker<'_>,
    (file, names): &NamedDrawing<'_>,
    with_all_values: bool,
) -> (DrawingResult, Vec<Trace>) {
    let (db, file) = (checker.db(), *file);
    let names = names.unwrap_or_else(|| path_names(db, file));
    let mut diagnostics = Vec::new();
    let mut reached = vec![file];
    let own = Trace { files: vec![file], lookups: Vec::new() };
    let mut traces = if checker.is_traced() { vec![own] } else { Vec::new() };
    for name in names {
        let (targets, warning) = if with_all_values {
            checker.combined_targets(file, name)
        } else {
            (vec![db.target(file, name.as_str(), Role::Checked)], None)
        };
        let checked = targets.into_iter().map(|target| checker.check(target)).collect::<Vec<_>>();
        diagnostics.extend(warning);
        if with_all_values {
            diagnostics.extend(checker.merge_combinations(&checked));
        }
        for checked in checked {
            if !with_all_values {
                diagnostics.extend(checked.diagnostics);
            }
            reached.extend(checked.files);
            traces.extend(checked.trace);
        }
    }
    let result = combine_result(db, names, diagnostics, reached);
    (DrawingResult { layers: NamedLayers::of(db, file), ..result }, traces)
}

fn combine_result(
    db: &Database,
    names: &[PathName],
    mut diagnostics: Vec<Diagnostic>,
    mut reached: Vec<SourceFile>,
) -> DrawingResult {
    // Most files have no diagnostics; skipping them first makes the sort cheap.
    reached.retain(|file| !check_file(db, *file).is_empty());
    reached.sort_by(|a, b| compare_paths(a.path(db), b.path(db)));
    reached.dedup();
    diagnostics.extend(reached.iter().flat_map(|file| check_file(db, *file)).cloned());
    DrawingResult { names: names.to_vec(), diagnostics, ..DrawingResult::default() }
}

/// Upper bound on the combinations of values that are checked per path.
const MAX_COMBINATIONS: usize = 1000;

impl Checker<'_> {
    /// Returns one target per combination of values, and a warning if there are too many combinations. A path without variables has a single
    /// target.
    pub fn combined_targets(&self, file: SourceFile, name: &PathName) -> (Vec<Target>, Option<Diagnostic>) {
        let target = |role| self.db().target(file, name.as_str(), role);
        match combinations(self.db(), file, name, MAX_COMBINATIONS) {
            None => (vec![target(Role::Checked)], None),
            Some((values, warning)) => {
                let targets = values.into_iter().map(|values| target(Role::CheckedWith(values))).collect();
                (targets, warning.map(|warning| locate(self.db(), warning)))
            }
        }
    }

    /// Merges the results of all combinations of a path. Each fault is reported once, and with the first values that cause it unless it occurs in all
    /// combinations.
    pub fn merge_combinations(&self, results: &[CheckedTarget]) -> Vec<Diagnostic> {
        let mut merged: Vec<MergedFault<'_>> = Vec::new();
        let mut indices: BTreeMap<Identity<'_>, usize> = BTreeMap::new();
        for result in results {
            for diagnostic in &result.diagnostics {
                let index = *indices.entry(Identity::of(diagnostic)).or_insert(merged.len());
                match merged.get_mut(index) {
                    // One combination may yield the same fault several times, with different arguments.
                    Some(combination) if combination.last.target == result.target => {}
                    Some(combination) => {
                        combination.count += 1;
                        combination.last = result;
                    }
                    None => merged.push(MergedFault { diagnostic, first: result, last: result, count: 1 }),
                }
            }
        }
        merged.iter().map(|merged| self.with_values(merged, results.len())).collect()
    }

    fn with_values(&self, merged: &MergedFault<'_>, all: usize) -> Diagnostic {
        let diagnostic = merged.diagnostic.clone();
        let target = merged.first.target;
        let Role::CheckedWith(values) = target.role(self.db()) else { return diagnostic };
        let named = vec![
            ("values", Value::quoted(format_values(values))),
            ("name", Value::quoted(&**target.name(self.db()))),
        ];
        match merged.count {
            count if count == all => diagnostic,
            1 => diagnostic.note(&messages::WITH_VALUES, named),
            count => {
                let counts = [("others", (count - 1).into()), ("all", all.into())];
                diagnostic.note(&messages::WITH_MORE_VALUES, named.into_iter().chain(counts).collect())
            }
        }
    }
}

struct MergedFault<'a> {
    diagnostic: &'a Diagnostic,
    first: &'a CheckedTarget,
    last: &'a CheckedTarget,
    count: usize,
}

/// Identity of a diagnostic, without the values in its message: diagnostics with the same identity are the same fault.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Identity<'a> {
    message: &'static str,
    file: Option<&'a str>,
    path: Option<&'a str>,
    place: &'a Place,
    text: Option<&'a TextFault>,
}

impl<'a> Identity<'a> {
    fn of(diagnostic: &'a Diagnostic) -> Self {
        let Message { key, .. } = diagnostic.message;
        Self {
            message: key,
            file: diagnostic.file.as_ref().map(|file| file.as_str()),
            path: diagnostic.path.as_deref(),
            place: &diagnostic.place,
            text: diagnostic.text.as_ref(),
        }
    }
}

/// Formats values as in the text of a subpath: `:A0,5 :BX`.
fn format_values(values: &Bindings) -> String {
    let values: Vec<String> = values.iter().map(|(name, value)| format!(":{name}{value}")).collect();
    values.join(" ")
}

/// The state of files at an earlier time, such as a Git revision.
pub trait EarlierFiles: Debug {
    /// Returns, for each file, whether it has changed since that time or did not exist then. Files about which nothing is known are reported as
    /// changed.
    fn changed(&self, files: &[Utf8PathBuf]) -> Vec<bool>;

    /// Returns the file names of the drawings that the directory contained at that time.
    fn drawings(&self, directory: &Utf8Path) -> &[String];

    /// Returns a changed file that affects all results, such as a configuration or a symbolic link; `None` if there is none. `directories` are the
    /// searched directories.
    fn changed_common_file(&self, directories: &[Utf8PathBuf]) -> Option<Utf8PathBuf>;
}

/// A filter for the results that are shown: all of them, or only those that depend on changed drawings.
pub(super) struct ChangeFilter<'a> {
    session: &'a Session<'a>,
    memo: &'a Memo,
    /// Drawings on which a shown result must depend; `None` shows all results.
    changed: Option<ChangedDrawings>,
}

impl<'a> ChangeFilter<'a> {
    /// Creates a filter for these results. If `past` is given, only results that depend on files changed since then pass.
    pub(super) fn new<'r>(
        session: &'a Session<'a>,
        memo: &'a Memo,
        past: Option<&dyn EarlierFiles>,
        results: impl Iterator<Item = &'r Answer<DrawingResult>>,
    ) -> Self {
        let changed = past.map(|past| {
            let mut reached = ReachedInputs::default();
            for answer in results {
                if let Some(inputs) = memo.dependencies(session.db(), answer) {
                    reached.add(&inputs);
                }
            }
            ChangedDrawings::new(session, past, reached)
        });
        Self { session, memo, changed }
    }

    pub(super) fn contains(&self, answer: &Answer<DrawingResult>) -> bool {
        let Some(changed) = &self.changed else { return true };
        let inputs = self.memo.dependencies(self.session.db(), answer);
        inputs.is_none_or(|inputs| changed.affects(&inputs))
    }

    /// Whether every result that may contain findings of this drawing passes the filter. If the drawing has changed, they all do, because they depend
    /// on the drawing.
    fn knows_all_findings(&self, drawing: &Utf8Path) -> bool {
        self.changed.as_ref().is_none_or(|changed| changed.files.contains(drawing))
    }
}

/// The files and directories that the results depend on, before it is known which of them have changed.
#[derive(Debug, Default)]
struct ReachedInputs {
    files: BTreeSet<Utf8PathBuf>,
    /// Directories in which lookups were made.
    directories: BTreeSet<Utf8PathBuf>,
}

/// Drawings that were changed, added or removed.
struct ChangedDrawings {
    files: BTreeSet<Utf8PathBuf>,
    /// File names of the changed drawings, by directory.
    names: BTreeMap<Utf8PathBuf, Vec<String>>,
    coverage: Coverage,
}

impl ReachedInputs {
    fn add(&mut self, facts: &Dependencies<'_>) {
        facts.files.iter().for_each(|file| add(&mut self.files, file));
        facts.lookups.iter().for_each(|(directory, _)| add(&mut self.directories, directory));
    }
}

/// Inserts a path; copies it only if it is new, because most paths are already in the set.
fn add(paths: &mut BTreeSet<Utf8PathBuf>, path: &Utf8Path) {
    if !paths.contains(path) {
        paths.insert(path.to_owned());
    }
}

impl ChangedDrawings {
    fn new(session: &Session<'_>, past: &dyn EarlierFiles, reached: ReachedInputs) -> Self {
        let ReachedInputs { mut files, directories } = reached;
        let mut gone = BTreeSet::new();
        for directory in &directories {
            let now = drawings(session, directory);
            let old = past.drawings(directory).iter().filter(|name| !now.contains(*name));
            gone.extend(old.map(|name| join(directory, name)));
            files.extend(now.iter().map(|name| join(directory, name)));
        }
        let files: Vec<Utf8PathBuf> = files.into_iter().collect();
        let changed = past.changed(&files).into_iter().zip(files);
        let changed = changed.filter_map(|(is_changed, file)| is_changed.then_some(file));
        let files: BTreeSet<Utf8PathBuf> = changed.chain(gone).collect();
        Self { names: by_directory(&files), files, coverage: Coverage::new(session.workspace()) }
    }

    fn affects(&self, facts: &Dependencies<'_>) -> bool {
        facts.files.iter().any(|file| self.files.contains(*file))
            || facts.lookups.iter().any(|(directory, name)| self.may_find_changed_drawing(directory, name))
    }

    /// Whether a lookup of `name` in this directory may find one of the changed drawings.
    fn may_find_changed_drawing(&self, directory: &Utf8Path, name: &str) -> bool {
        let names = self.names.get(directory);
        names.is_some_and(|names| names.iter().any(|file| self.coverage.may_hold(file, name)))
    }
}

/// Returns the file names of the drawings in a directory, including hidden ones.
fn drawings(session: &Session<'_>, directory: &Utf8Path) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    // Errors are ignored here: the lookups in this directory report them.
    _ = session.db().system().each_entry(directory, &mut |entry| {
        if entry.is_exact && is_drawing(Utf8Path::new(entry.name)) {
            names.insert(entry.name.to_owned());
        }
        ControlFlow::Continue(())
    });
    names
}

fn by_directory(files: &BTreeSet<Utf8PathBuf>) -> BTreeMap<Utf8PathBuf, Vec<String>> {
    let mut names: BTreeMap<Utf8PathBuf, Vec<String>> = BTreeMap::new();
    for file in files {
        if let (Some(directory), Some(name)) = (file.parent(), file.file_name()) {
            names.entry(directory.to_owned()).or_default().push(name.to_owned());
        }
    }
    names
}
