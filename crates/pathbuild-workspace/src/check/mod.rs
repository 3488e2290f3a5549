//! Checking drawings, paths and directories. Writes nothing. (book: reference/commands, `check`)

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
use crate::config::Concerns;
use crate::session::timings::FINDING;
use crate::session::{
    DrawingResult, Found, FreshResult, Question, ResultStore, Scope, Session, Wanted, WantedPath, by_place,
    relative,
};
use crate::workspace::Workspace;

pub use drawings::check_drawings;
use drawings::check_paths;
use results::{Concerned, Results, of};

/// What is to be checked.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// Drawings, paths and directories; without any, the library.
    pub inputs: &'a Inputs,
    /// Whether with every combination of the variables' values, not with one example of each.
    pub with_all_values: bool,
    /// Only what depends on drawings that changed since then is shown.
    pub changed: Option<&'a dyn Past>,
}

/// The files as they were at another time, such as in a revision.
pub trait Past: Debug {
    /// Of each file whether it was another one then, or none. What is not known has changed.
    fn changed(&self, files: &[Utf8PathBuf]) -> Vec<bool>;

    /// The names of the drawings that were in a directory.
    fn drawings(&self, directory: &Utf8Path) -> &[String];

    /// A file that says what is checked and how, or where links lead, and says something else now. These directories were walked through.
    fn changed_rule(&self, directories: &[Utf8PathBuf]) -> Option<Utf8PathBuf>;
}

/// What came of a check.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// Everything that was found, in any order and as often as it was met.
    pub diagnostics: Vec<Diagnostic>,
    /// What was looked at, in order of name.
    pub files: Vec<CheckedFile>,
}

/// A drawing that was checked.
#[derive(Clone, Debug)]
pub struct CheckedFile {
    /// The drawing.
    pub file: Utf8PathBuf,
    /// Its paths, as the drawing spells them, in file order.
    pub paths: Vec<PathName>,
}

/// A drawing, or some of its paths.
struct CheckTarget {
    drawing: Utf8PathBuf,
    /// `None`: all.
    names: Option<Vec<PathName>>,
}

impl CheckTarget {
    fn file(&self, session: &Session<'_>) -> SourceFile {
        session.file(&self.drawing)
    }
}

/// A request for drawings that changed names single drawings or paths: what depends on others is only looked for in directories.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotDirectories;

impl Request<'_> {
    /// A session for it.
    pub fn session<'w>(&self, workspace: &'w Workspace) -> Session<'w> {
        if workspace.keeps_results() || self.changed.is_some() {
            Session::traced(workspace)
        } else {
            Session::new(workspace)
        }
    }

    /// Checks in its session; results are taken from earlier runs, and kept for later ones.
    ///
    /// # Errors
    /// Only what depends on changed drawings is wanted, and the inputs are not directories only.
    pub fn run(&self, session: &mut Session<'_>) -> Result<Checked, NotDirectories> {
        if !session.is_traced() {
            session.prefetch(self.inputs, &|_| false);
        }
        let mut found = session.timings().measure(&FINDING, || session.found(self.inputs));
        let results = Results::open(session, self, &mut found);
        let mut checked = check(session, self, &found, &results)?;
        checked.diagnostics = session.with_hints(checked.diagnostics);
        leave((results, found));
        Ok(checked)
    }
}

/// Checks what is not known.
fn check(
    session: &mut Session<'_>,
    request: &Request<'_>,
    found: &Found,
    results: &Results,
) -> Result<Checked, NotDirectories> {
    let Answers { wanted, each: answers, mut made } =
        session.settled(|session| answers(session, request, found, results));
    if request.changed.is_some() && !(wanted.named.is_empty() && wanted.paths.is_empty()) {
        return Err(NotDirectories);
    }
    let (q_projects, made_of_pairs) = session.settled(|session| results.q_projects(session, &wanted));
    made.extend(made_of_pairs);
    results.keep(session, &made);
    let names = answers.iter().map(|(asked, _)| of(&asked.drawing, asked.names.as_deref()));
    let names = names.chain(q_projects.iter().map(|(of, _)| Cow::Borrowed(&**of)));
    let concerned = Concerned::new(session, results, &made, since(session, request, found), names);
    let mut checked = Checked { diagnostics: found.problems.clone(), ..Checked::default() };
    checked.diagnostics.extend(wanted.problems);
    if !session.is_compatible() {
        let named = answers.iter().skip(wanted.drawings.len()).take(wanted.named.len());
        checked.diagnostics.extend(named.filter_map(|(asked, said)| session.no_path(&asked.drawing, said)));
    }
    if !checked.diagnostics.iter().any(Diagnostic::is_error) {
        let parts = answers.iter().map(|(_, result)| result.parts());
        checked.diagnostics.extend(session.no_path_anywhere(parts));
    }
    for (CheckTarget { drawing, names }, result) in answers {
        if !concerned.contains(&of(&drawing, names.as_deref())) {
            continue;
        }
        checked.files.push(CheckedFile { file: drawing, paths: result.names });
        checked.diagnostics.extend(result.diagnostics);
    }
    checked.files.sort_by(|a, b| by_place(&a.file, &b.file));
    let q_projects = q_projects.into_iter().filter(|(of, _)| concerned.contains(of));
    checked.diagnostics.extend(q_projects.flat_map(|(_, found)| found));
    leave(made);
    Ok(checked)
}

/// Since when drawings have to be told apart: not at all where something changed that concerns all of them.
fn since<'a>(session: &Session<'_>, request: &Request<'a>, found: &Found) -> Option<&'a dyn Past> {
    let past = request.changed?;
    let directories: Vec<Utf8PathBuf> =
        found.directories().flat_map(|directory| &directory.directories).cloned().collect();
    let Some(rule) = past.changed_rule(&directories) else { return Some(past) };
    let context = session.workspace();
    context.reporter.status(&context.phrase(
        "everything is checked: {} has changed since the revision",
        "alles wird geprüft: {} hat sich seit der Revision geändert",
        relative(&rule, &context.working_directory).as_str(),
    ));
    None
}

/// What the arguments mean, and what is found in that.
struct Answers {
    wanted: Wanted,
    each: Vec<(CheckTarget, DrawingResult)>,
    /// What this run found itself.
    made: Vec<FreshResult>,
}

fn answers(session: &mut Session<'_>, request: &Request<'_>, found: &Found, results: &Results) -> Answers {
    let (wanted, mut made) = results.wanted(session, found);
    let asked = asked(session, &wanted);
    let mut known: Vec<Option<DrawingResult>> =
        asked.iter().map(|asked| results.known(&of(&asked.drawing, asked.names.as_deref()))).collect();
    let open: Vec<usize> = (0..asked.len()).filter(|index| known[*index].is_none()).collect();
    results.tell_known(session, asked.len() - open.len(), asked.len());
    let paths: Vec<(SourceFile, Option<&[PathName]>)> =
        open.iter().map(|index| (asked[*index].file(session), asked[*index].names.as_deref())).collect();
    let checked = check_paths(session, &paths, request.with_all_values);
    for ((result, traces), index) in checked.into_iter().zip(open) {
        let CheckTarget { drawing, names } = &asked[index];
        if session.is_traced() {
            made.push(results::new(&of(drawing, names.as_deref()), traces, &result));
        }
        known[index] = Some(result);
    }
    Answers { wanted, each: asked.into_iter().zip(known.into_iter().flatten()).collect(), made }
}

/// Each drawing, and for the paths that were named by themselves the drawings that define them, without those that are checked as a whole.
fn asked(session: &Session<'_>, wanted: &Wanted) -> Vec<CheckTarget> {
    let db = session.db();
    let named = wanted.named.iter().map(|file| file.path(db));
    let whole = wanted.drawings.iter().chain(named);
    let mut asked: Vec<CheckTarget> =
        whole.map(|drawing| CheckTarget { drawing: drawing.clone(), names: None }).collect();
    if !wanted.paths.is_empty() {
        let is_whole: HashSet<Utf8PathBuf> = asked.iter().map(|asked| asked.drawing.clone()).collect();
        let mut single: BTreeMap<&Utf8PathBuf, Vec<PathName>> = BTreeMap::new();
        for WantedPath { file, name } in &wanted.paths {
            single.entry(file.path(db)).or_default().push(name.clone());
        }
        let single = single.into_iter().filter(|(drawing, _)| !is_whole.contains(*drawing));
        asked.extend(
            single.map(|(drawing, names)| CheckTarget { drawing: drawing.clone(), names: Some(names) }),
        );
    }
    asked
}

/// What the last checks found, for telling why it no longer holds. `None` where no results are kept.
pub fn kept_results(workspace: &Workspace) -> Option<ResultStore> {
    open(workspace, false, Scope::All, Listings::new())
}

fn open(
    workspace: &Workspace,
    with_all_values: bool,
    scope: Scope,
    listings: Listings,
) -> Option<ResultStore> {
    let text = format!("check {with_all_values}");
    ResultStore::open(workspace, Question { whose: Concerns::Check, text: &text, scope, listings })
}

/// The run is over: to take a million values apart would take longer than to end.
fn leave<T>(over: T) {
    std::mem::forget(over);
}
