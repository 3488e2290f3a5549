//! `check`: checks drawings, paths and directories, without writing anything. (book: reference/commands, `check`)

mod changed;
mod drawings;
mod results;

use std::borrow::Cow;
use std::collections::{BTreeMap, HashSet};
use std::fmt::Debug;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::Listings;
use pathbuild_db::SourceFile;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use crate::Inputs;
use crate::config::ResultKind;
use crate::session::timings::FINDING;
use crate::session::{
    ArgumentMatches, CacheQuery, DrawingResult, FreshResult, ResultStore, Scope, SelectedPath, Selection,
    Session, by_place, relative,
};
use crate::workspace::Workspace;

pub use drawings::check_drawings;
use drawings::check_paths;
use results::{ChangeFilter, Results, subject};

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

/// The files at an earlier time, such as in a Git revision.
pub trait EarlierFiles: Debug {
    /// For each file, whether it has changed since or did not exist. Files about which nothing is known count as changed.
    fn changed(&self, files: &[Utf8PathBuf]) -> Vec<bool>;

    /// File names of the drawings that the directory contained.
    fn drawings(&self, directory: &Utf8Path) -> &[String];

    /// A file that has changed and affects all results, such as a configuration or a symbolic link. `directories` are those that were
    /// searched.
    fn changed_rule(&self, directories: &[Utf8PathBuf]) -> Option<Utf8PathBuf>;
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
struct CheckTarget {
    drawing: Utf8PathBuf,
    /// `None` means all paths.
    names: Option<Vec<PathName>>,
}

impl CheckTarget {
    fn file(&self, session: &Session<'_>) -> SourceFile {
        session.file(&self.drawing)
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
        let results = Results::open(session, self, &mut matches);
        let mut checked = check(session, self, &matches, &results)?;
        checked.diagnostics = session.with_hints(checked.diagnostics);
        leak((results, matches));
        Ok(checked)
    }
}

/// Checks whatever the cache does not answer.
fn check(
    session: &mut Session<'_>,
    request: &Request<'_>,
    found: &ArgumentMatches,
    results: &Results,
) -> Result<CheckOutcome, InputsNotDirectories> {
    let Answers { selection, each: answers, mut fresh } =
        session.with_stable_files(|session| answers(session, request, found, results));
    if request.changed.is_some() && !(selection.named.is_empty() && selection.paths.is_empty()) {
        return Err(InputsNotDirectories);
    }
    let (q_projects, fresh_pairs) =
        session.with_stable_files(|session| results.q_projects(session, &selection));
    fresh.extend(fresh_pairs);
    results.keep(session, &fresh);
    let names = answers.iter().map(|(target, _)| subject(&target.drawing, target.names.as_deref()));
    let names = names.chain(q_projects.iter().map(|(subject, _)| Cow::Borrowed(&**subject)));
    let filter = ChangeFilter::new(session, results, &fresh, since(session, request, found), names);
    let mut checked = CheckOutcome { diagnostics: found.problems.clone(), ..CheckOutcome::default() };
    checked.diagnostics.extend(selection.problems);
    if !session.is_compatible() {
        let named = answers.iter().skip(selection.drawings.len()).take(selection.named.len());
        checked.diagnostics.extend(named.filter_map(|(target, result)| {
            session.no_path(&target.drawing, &result.names, &result.diagnostics)
        }));
    }
    if !checked.diagnostics.iter().any(Diagnostic::is_error) {
        let parts = answers.iter().map(|(_, result)| result.parts());
        checked.diagnostics.extend(session.no_path_anywhere(parts));
    }
    for (CheckTarget { drawing, names }, result) in answers {
        if !filter.contains(&subject(&drawing, names.as_deref())) {
            continue;
        }
        checked.files.push(CheckedFile { file: drawing, paths: result.names });
        checked.diagnostics.extend(result.diagnostics);
    }
    checked.files.sort_by(|a, b| by_place(&a.file, &b.file));
    let q_projects = q_projects.into_iter().filter(|(subject, _)| filter.contains(subject));
    checked.diagnostics.extend(q_projects.flat_map(|(_, diagnostics)| diagnostics));
    leak(fresh);
    Ok(checked)
}

/// The state since which changed drawings are selected; `None` if everything is selected because a change affects all drawings.
fn since<'a>(
    session: &Session<'_>,
    request: &Request<'a>,
    found: &ArgumentMatches,
) -> Option<&'a dyn EarlierFiles> {
    let past = request.changed?;
    let directories: Vec<Utf8PathBuf> =
        found.directories().flat_map(|directory| &directory.directories).cloned().collect();
    let Some(rule) = past.changed_rule(&directories) else { return Some(past) };
    let context = session.workspace();
    context.reporter.status(&context.phrase(
        "checking everything: {} has changed since the revision",
        "alles wird geprüft: {} hat sich seit der Revision geändert",
        relative(&rule, &context.working_directory).as_str(),
    ));
    None
}

/// The resolved arguments, and the result of each drawing.
struct Answers {
    selection: Selection,
    each: Vec<(CheckTarget, DrawingResult)>,
    /// Results computed in this run.
    fresh: Vec<FreshResult>,
}

fn answers(
    session: &mut Session<'_>,
    request: &Request<'_>,
    found: &ArgumentMatches,
    results: &Results,
) -> Answers {
    let (selection, mut fresh) = results.select(session, found);
    let targets = targets(session, &selection);
    let mut known: Vec<Option<DrawingResult>> = targets
        .iter()
        .map(|target| results.known(&subject(&target.drawing, target.names.as_deref())))
        .collect();
    let open: Vec<usize> = (0..targets.len()).filter(|index| known[*index].is_none()).collect();
    results.report_known(session, targets.len() - open.len(), targets.len());
    let paths: Vec<(SourceFile, Option<&[PathName]>)> =
        open.iter().map(|index| (targets[*index].file(session), targets[*index].names.as_deref())).collect();
    let checked = check_paths(session, &paths, request.with_all_values);
    for ((result, traces), index) in checked.into_iter().zip(open) {
        let CheckTarget { drawing, names } = &targets[index];
        if session.is_traced() {
            fresh.push(results::new(&subject(drawing, names.as_deref()), traces, &result));
        }
        known[index] = Some(result);
    }
    Answers { selection, each: targets.into_iter().zip(known.into_iter().flatten()).collect(), fresh }
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

/// Results of the last checks, to explain why they no longer hold. `None` if no results are cached.
pub fn cached_results(workspace: &Workspace) -> Option<ResultStore> {
    open(workspace, false, Scope::All, Listings::new())
}

fn open(
    workspace: &Workspace,
    with_all_values: bool,
    scope: Scope,
    listings: Listings,
) -> Option<ResultStore> {
    let text = format!("check {with_all_values}");
    ResultStore::open(workspace, CacheQuery { result_kind: ResultKind::Check, text: &text, scope, listings })
}

/// Leaks instead of dropping: freeing a million values takes longer than process exit.
fn leak<T>(value: T) {
    std::mem::forget(value);
}
