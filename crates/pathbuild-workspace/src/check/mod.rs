//! Checking drawings, paths and directories. Writes nothing. (spec/05-command-line.md, `check`)

mod changed;
mod drawings;
mod kept;

use std::collections::HashSet;

use camino::Utf8PathBuf;
use pathbuild_cache::Listings;
use pathbuild_db::SourceFile;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use crate::Inputs;
use crate::config::Concerns;
use crate::session::timings::FINDING;
use crate::session::{DrawingResult, Keeper, Question, Scope, Session, Wanted, WantedPath, by_place};
use crate::workspace::Workspace;

pub(crate) use drawings::check_drawings;
use drawings::{Asked, check_paths};

/// What is to be checked.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// Drawings, paths and directories; without any, the library.
    pub inputs: &'a Inputs,
    /// Whether with every combination of the variables' values, not with one example of each.
    pub with_all_values: bool,
    /// Only what depends on these drawings is shown.
    pub changed: Option<Vec<Utf8PathBuf>>,
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

    /// Checks in its session; results of directories are taken from earlier runs, and kept for later ones.
    ///
    /// # Errors
    /// Only what depends on changed drawings is wanted, and the inputs are not directories only.
    pub fn run(&self, session: &mut Session<'_>) -> Result<Checked, NotDirectories> {
        let mut checked = self.checked(session)?;
        checked.diagnostics = session.with_elsewhere(checked.diagnostics);
        Ok(checked)
    }

    fn checked(&self, session: &mut Session<'_>) -> Result<Checked, NotDirectories> {
        if session.is_traced()
            && let Some(found) = session.timings().measure(&FINDING, || session.directories_only(self.inputs))
        {
            return Ok(kept::check(session, self, found));
        }
        if self.changed.is_some() {
            return Err(NotDirectories);
        }
        session.prefetch(self.inputs);
        Ok(session.settled(|session| {
            let wanted = session.timings().measure(&FINDING, || session.wanted(self.inputs));
            check(session, wanted, self.with_all_values)
        }))
    }
}

/// What the last checks of the library found, for telling why it no longer holds. `None` where no results are kept.
pub fn kept_results(workspace: &Workspace) -> Option<Keeper> {
    open(workspace, false, Scope::All, Listings::new())
}

fn open(workspace: &Workspace, with_all_values: bool, scope: Scope, listings: Listings) -> Option<Keeper> {
    let text = format!("check {with_all_values}");
    Keeper::open(workspace, Question { whose: Concerns::Check, text: &text, scope, listings })
}

/// The run is over: to take a million values apart would take longer than to end.
fn leave<T>(over: T) {
    std::mem::forget(over);
}

fn check(session: &mut Session<'_>, wanted: Wanted, with_all_values: bool) -> Checked {
    session.know_names(&wanted.listings);
    leave(wanted.listings);
    let whole: Vec<SourceFile> = wanted.drawings.iter().map(|drawing| drawing.file).collect();
    let mut asked: Vec<Asked> = whole.iter().map(|file| Asked { file: *file, names: None }).collect();
    asked.extend(single_paths(wanted.paths, &whole));
    let found = check_paths(session, &asked, with_all_values);
    let files = asked.iter().map(|asked| asked.file);
    let mut checked = Checked { diagnostics: wanted.problems, ..Checked::default() };
    if !session.is_compatible() {
        let named = wanted.drawings.iter().filter(|drawing| drawing.is_named);
        checked.diagnostics.extend(named.filter_map(|drawing| session.no_path(drawing.file)));
    }
    if !checked.diagnostics.iter().any(Diagnostic::is_error) {
        checked.diagnostics.extend(session.no_path_anywhere(found.iter().map(|(result, _)| result.parts())));
    }
    checked.files.reserve(found.len());
    for (file, (DrawingResult { names, diagnostics }, _)) in files.zip(found) {
        checked.files.push(CheckedFile { file: file.path(session.db()).clone(), paths: names });
        checked.diagnostics.extend(diagnostics);
    }
    checked.files.sort_by(|a, b| by_place(&a.file, &b.file));
    checked.diagnostics.extend(session.q_projects(&whole));
    checked
}

/// The paths that were named by themselves, drawing by drawing, without those of drawings that are checked as a whole.
fn single_paths(paths: Vec<WantedPath>, whole: &[SourceFile]) -> Vec<Asked> {
    if paths.is_empty() {
        return Vec::new();
    }
    let is_whole: HashSet<SourceFile> = whole.iter().copied().collect();
    let mut single: Vec<Asked> = Vec::new();
    for WantedPath { file, name } in paths.into_iter().filter(|path| !is_whole.contains(&path.file)) {
        match single.iter_mut().find(|asked| asked.file == file) {
            Some(asked) => asked.names.get_or_insert_default().push(name),
            None => single.push(Asked { file, names: Some(vec![name]) }),
        }
    }
    single
}
