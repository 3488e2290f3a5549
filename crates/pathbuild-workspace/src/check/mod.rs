//! `check`: checks drawings, paths and directories, without writing anything. (book: reference/commands, `check`)

mod changed;

use std::collections::{BTreeMap, HashSet};
use std::fmt::Debug;

use camino::Utf8PathBuf;
use pathbuild_db::{Database, Db, Role, SourceFile, Trace, check_file, path_names};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use crate::Inputs;
use crate::config::ResultKind;
use crate::memo::{Answer, DrawingResult, Memo, check_query, find, read_drawings, subject};
use crate::session::timings::{FINDING, KEEPING, VERIFYING};
use crate::session::{
    ArgumentMatches, Checker, Pair, SelectedPath, Selection, Session, by_place, q_project_pairs,
};
use crate::workspace::{Workspace, relative};

use changed::ChangeFilter;
pub use changed::EarlierFiles;

/// A request to check drawings.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// The drawings, paths and directories to check; if empty, the whole library.
    pub inputs: &'a Inputs,
    /// Whether to check all combinations of the variables' values instead of one example value of each.
    pub with_all_values: bool,
    /// If set, show only results that depend on drawings changed since that state.
    pub changed: Option<&'a dyn EarlierFiles>,
}

/// The outcome of a check.
#[derive(Clone, Debug, Default)]
pub struct CheckOutcome {
    /// All diagnostics, unsorted, with duplicates.
    pub diagnostics: Vec<Diagnostic>,
    /// The checked drawings, sorted by name.
    pub files: Vec<CheckedFile>,
}

/// A drawing that was checked.
#[derive(Clone, Debug)]
pub struct CheckedFile {
    /// The drawing.
    pub file: Utf8PathBuf,
    /// Its paths in file order, as the drawing spells them.
    pub paths: Vec<PathName>,
}

/// A drawing, or some of its paths.
#[derive(Debug)]
struct CheckTarget {
    drawing: Utf8PathBuf,
    /// `None` means all paths.
    names: Option<Vec<PathName>>,
}

impl CheckTarget {
    fn subject(&self) -> Box<str> {
        subject(&self.drawing, self.names.as_deref())
    }
}

/// A request limited to changed drawings names single drawings or paths. Dependents are found only for whole directories.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InputsNotDirectories;

impl Request<'_> {
    /// Opens a session that suits this request.
    pub fn session<'w>(&self, workspace: &'w Workspace) -> Session<'w> {
        if workspace.keeps_results() || self.changed.is_some() {
            Session::traced(workspace)
        } else {
            Session::new(workspace)
        }
    }

    /// Runs the check. Results are taken from the cache where they still hold, and new ones are stored.
    ///
    /// # Errors
    /// If the request is limited to changed drawings and the inputs are not all directories.
    pub fn run(&self, session: &mut Session<'_>) -> Result<CheckOutcome, InputsNotDirectories> {
        if !session.is_traced() {
            session.prefetch(self.inputs, &|_| false);
        }
        let mut matches = session.timings().measure(&FINDING, || session.match_arguments(self.inputs));
        let query = check_query(self.with_all_values);
        let open = || Memo::open(session, ResultKind::Check, &query, self.inputs, &mut matches);
        let memo = session.timings().measure(&VERIFYING, open);
        let mut checked = self.check(session, &matches, &memo)?;
        checked.diagnostics = session.with_hints(checked.diagnostics);
        leak((memo, matches));
        Ok(checked)
    }

    /// Checks whatever no earlier run knows.
    fn check(
        &self,
        session: &mut Session<'_>,
        matches: &ArgumentMatches,
        memo: &Memo,
    ) -> Result<CheckOutcome, InputsNotDirectories> {
        let Results { selection, named, each } =
            session.with_stable_files(|session| self.results(session, matches, memo));
        if self.changed.is_some() && !(selection.named.is_empty() && selection.paths.is_empty()) {
            return Err(InputsNotDirectories);
        }
        let q_projects = session.with_stable_files(|session| compare_q_projects(session, memo, &selection));
        let answers = named.iter().chain(&each).chain(&q_projects);
        session.timings().measure(&KEEPING, || memo.keep(session, answers.filter_map(Answer::fresh)));
        let past = self.since(session, matches);
        let filter = ChangeFilter::new(session, memo, past, each.iter().chain(&q_projects));
        let mut checked = CheckOutcome { diagnostics: matches.problems.clone(), ..CheckOutcome::default() };
        checked.diagnostics.extend(selection.problems);
        if !session.is_compatible() {
            let named = each.iter().skip(selection.drawings.len()).take(selection.named.len());
            checked.diagnostics.extend(named.filter_map(|answer| {
                session.no_path(answer.drawing(), &answer.value.names, &answer.value.diagnostics)
            }));
        }
        if !checked.diagnostics.iter().any(Diagnostic::is_error) {
            let parts = each.iter().map(|answer| answer.value.parts());
            checked.diagnostics.extend(session.no_path_anywhere(parts));
        }
        for answer in each.into_iter().filter(|answer| filter.contains(answer)) {
            let (file, DrawingResult { names, diagnostics }) = (answer.drawing().to_owned(), answer.value);
            checked.files.push(CheckedFile { file, paths: names });
            checked.diagnostics.extend(diagnostics);
        }
        checked.files.sort_by(|a, b| by_place(&a.file, &b.file));
        let q_projects = q_projects.into_iter().filter(|answer| filter.contains(answer));
        checked.diagnostics.extend(q_projects.flat_map(|answer| answer.value.diagnostics));
        Ok(checked)
    }

    /// Resolves the arguments and checks the drawings.
    fn results(&self, session: &mut Session<'_>, matches: &ArgumentMatches, memo: &Memo) -> Results {
        let mut named: Vec<Utf8PathBuf> =
            matches.candidates().map(|file| file.path(session.db()).clone()).collect();
        named.sort_unstable_by(|a, b| a.as_str().cmp(b.as_str()));
        named.dedup();
        let known = |path: &Utf8PathBuf| {
            if memo.holds(path.as_str()) { path.as_str().into() } else { subject(path, Some(&[])) }
        };
        let named = read_drawings(session, memo, &named, known);
        let names =
            |file: SourceFile| find(&named, file.path(session.db())).map_or(&[][..], |it| &it.value.names);
        let selection = session.select_arguments(matches, &matches.arguments, &names);
        let targets = targets(session, &selection);
        let check = |open: &[&CheckTarget]| {
            if memo.is_some() {
                report_known(session.workspace(), targets.len() - open.len(), targets.len());
            }
            let paths = open.iter().map(|target| (session.file(&target.drawing), target.names.as_deref()));
            let paths: Vec<(SourceFile, Option<&[PathName]>)> = paths.collect();
            let checked = check_paths(session, &paths, self.with_all_values);
            checked.into_iter().map(|(result, traces)| result.with_inputs(traces)).collect()
        };
        let each = memo.get_or(&targets, CheckTarget::subject, |_, result| Some(result), check);
        Results { selection, named, each }
    }

    /// The state since which changed drawings are selected; `None` if everything is selected because a change affects all drawings.
    fn since(&self, session: &Session<'_>, matches: &ArgumentMatches) -> Option<&dyn EarlierFiles> {
        let past = self.changed?;
        let directories: Vec<Utf8PathBuf> =
            matches.directories().flat_map(|directory| &directory.directories).cloned().collect();
        let Some(rule) = past.changed_rule(&directories) else { return Some(past) };
        let context = session.workspace();
        context.reporter.status(&context.phrase(
            "checking everything: {} has changed since the revision",
            "alles wird geprüft: {} hat sich seit der Revision geändert",
            relative(&rule, &context.working_directory).as_str(),
        ));
        None
    }
}

/// The resolved arguments, and the results of drawings.
struct Results {
    selection: Selection,
    /// Drawings that may define a named path.
    named: Vec<Answer<DrawingResult>>,
    /// Drawings that were to be checked.
    each: Vec<Answer<DrawingResult>>,
}

/// Reports, as a detail, how many drawings have cached results that still hold.
fn report_known(context: &Workspace, known: usize, all: usize) {
    let phrase =
        context.choose("drawings whose results still hold", "Zeichnungen, deren Ergebnisse noch gelten");
    context.reporter.detail(&format!("{phrase}: {known} / {all}"));
}

/// The targets to check: each drawing, and for paths named individually the drawings that define them, unless these are checked as a whole.
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

/// Compares Q-projects with their drawings.
fn compare_q_projects(
    session: &Session<'_>,
    memo: &Memo,
    selection: &Selection,
) -> Vec<Answer<DrawingResult>> {
    let named = selection.named.iter().map(|file| file.path(session.db()));
    let pairs = q_project_pairs(selection.drawings.iter().chain(named));
    let compare = |open: &[&[&Utf8PathBuf; 2]]| {
        let open: Vec<Pair> = open.iter().map(|pair| pair.map(|path| session.db().file(path))).collect();
        let found = session.compare_q_projects(&open).into_iter().zip(&open);
        let result = |(diagnostics, pair): (_, &Pair)| {
            let trace = Trace { files: pair.to_vec(), lookups: Vec::new() };
            DrawingResult { names: Vec::new(), diagnostics }.with_inputs(vec![trace])
        };
        found.map(result).collect()
    };
    let subject = |[drawing, q_project]: &[&Utf8PathBuf; 2]| format!("{drawing}\0{q_project}").into();
    memo.get_or(&pairs, subject, |_, result| Some(result), compare)
}

/// Leaks instead of dropping: freeing a million values takes longer than process exit.
fn leak<T>(value: T) {
    std::mem::forget(value);
}

/// Number of drawings checked between evictions of parsed data.
const BATCH: usize = 512;

/// Checks all paths of the drawings. Returns each result with its inputs.
pub fn check_drawings(
    session: &mut Session<'_>,
    files: &[SourceFile],
    with_all_values: bool,
) -> Vec<(DrawingResult, Vec<Trace>)> {
    let targets: Vec<NamedDrawing<'_>> = files.iter().map(|file| (*file, None)).collect();
    check_paths(session, &targets, with_all_values)
}

/// A drawing, with the requested paths unless all are requested.
type NamedDrawing<'a> = (SourceFile, Option<&'a [PathName]>);

/// Like [`check_drawings`], for drawings of which only some paths may be requested.
fn check_paths(
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
    let mut traces = own_trace(checker.is_traced(), file);
    for name in names {
        let (targets, warning) = if with_all_values {
            checker.combined_targets(file, name)
        } else {
            (vec![db.target(file, name.as_str(), Role::Checked)], None)
        };
        let checked = targets.into_iter().map(|target| checker.check(target)).collect::<Vec<_>>();
        diagnostics.extend(warning);
        if with_all_values {
            diagnostics.extend(checker.merged(&checked));
        }
        for checked in checked {
            if !with_all_values {
                diagnostics.extend(checked.diagnostics);
            }
            reached.extend(checked.files);
            traces.extend(checked.trace);
        }
    }
    (result(db, names, diagnostics, reached), traces)
}

/// Adds to the diagnostics of a drawing's paths those of the files that the paths reach.
fn result(
    db: &Database,
    names: &[PathName],
    mut diagnostics: Vec<Diagnostic>,
    mut reached: Vec<SourceFile>,
) -> DrawingResult {
    // Most files have no diagnostics; skipping them first makes the sort cheap.
    reached.retain(|file| !check_file(db, *file).is_empty());
    reached.sort_by(|a, b| by_place(a.path(db), b.path(db)));
    reached.dedup();
    diagnostics.extend(reached.iter().flat_map(|file| check_file(db, *file)).cloned());
    DrawingResult { names: names.to_vec(), diagnostics }
}

/// Inputs of a drawing's result that do not depend on its paths; empty if inputs are not traced.
fn own_trace(is_traced: bool, file: SourceFile) -> Vec<Trace> {
    if is_traced { vec![Trace { files: vec![file], lookups: Vec::new() }] } else { Vec::new() }
}
