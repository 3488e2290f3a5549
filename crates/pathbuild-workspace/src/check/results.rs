//! What earlier checks found: only drawings whose results no longer hold are checked.

use std::borrow::Cow;
use std::collections::HashMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Db, SourceFile, Trace};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use super::changed::{Changed, Reached};
use super::{Past, Request, open};
use crate::session::timings::{KEEPING, VERIFYING};
use crate::session::{
    Dependencies, Drawing, DrawingResult, Drawings, Found, FreshResult, Pair, ResultStore, Scope, Session,
    Wanted, q_project_pairs,
};

/// What earlier checks kept; nothing where nothing is kept.
pub(super) struct Results(Option<ResultStore>);

/// A pair by its name among the results, and what is said of it.
type Judged = (String, Vec<Diagnostic>);

impl Results {
    /// What is known of the drawings that may be meant.
    pub(super) fn open(session: &Session<'_>, request: &Request<'_>, found: &mut Found) -> Self {
        if !session.is_traced() {
            return Self(None);
        }
        let (scope, listings) = (Scope::of(session, found), std::mem::take(&mut found.listings));
        let open = || open(session.workspace(), request.with_all_values, scope, listings);
        let results = Self(session.timings().measure(&VERIFYING, open));
        let is_known = |file: SourceFile| results.names(file.path(session.db())).is_some();
        session.prefetch(request.inputs, &is_known);
        results
    }

    /// What is known under a name.
    pub(super) fn known(&self, of: &str) -> Option<DrawingResult> {
        DrawingResult::decode(self.0.as_ref()?.payload(of)?).ok()
    }

    /// The names of a drawing's paths.
    fn names(&self, drawing: &Utf8Path) -> Option<DrawingResult> {
        self.known(drawing.as_str()).or_else(|| self.known(&of_names(drawing)))
    }

    /// What the arguments mean, and what was read for that.
    pub(super) fn wanted(&self, session: &Session<'_>, found: &Found) -> (Wanted, Vec<FreshResult>) {
        let db = session.db();
        let mut named: Vec<Utf8PathBuf> = found.candidates().map(|file| file.path(db).clone()).collect();
        named.sort_unstable_by(|a, b| a.as_str().cmp(b.as_str()));
        named.dedup();
        let named = Drawings::new(session, named, |drawing| self.names(drawing));
        let names =
            |file: SourceFile| named.get(file.path(db)).map_or(&[][..], |drawing| &drawing.said.names);
        let wanted = session.meant(found, &found.arguments, &names);
        let read = named.iter().filter(|drawing| drawing.is_read && session.is_traced());
        let made = read.map(|Drawing { path, said, .. }| {
            let trace = Trace { files: vec![session.file(path)], lookups: Vec::new() };
            new(&of_names(path), vec![trace], said)
        });
        (wanted, made.collect())
    }

    /// Says, to whoever wants to know more, how much is as it was in an earlier run.
    pub(super) fn tell_known(&self, session: &Session<'_>, known: usize, all: usize) {
        let context = session.workspace();
        if self.0.is_some() {
            let phrase = context
                .choose("drawings whose results still hold", "Zeichnungen, deren Ergebnisse noch gelten");
            context.reporter.detail(&format!("{phrase}: {known} / {all}"));
        }
    }

    /// What Q-projects and their drawings say against each other, each pair by its name among the results; and what was found now.
    pub(super) fn q_projects(
        &self,
        session: &Session<'_>,
        wanted: &Wanted,
    ) -> (Vec<Judged>, Vec<FreshResult>) {
        let (mut found, mut made) = (Vec::new(), Vec::new());
        let (mut open, mut names): (Vec<Pair>, Vec<String>) = (Vec::new(), Vec::new());
        let named = wanted.named.iter().map(|file| file.path(session.db()));
        for [drawing, q_project] in q_project_pairs(wanted.drawings.iter().chain(named)) {
            let of = format!("{drawing}\0{q_project}");
            if let Some(result) = self.known(&of) {
                found.push((of, result.diagnostics));
            } else {
                open.push([drawing, q_project].map(|path| session.db().file(path)));
                names.push(of);
            }
        }
        for ((diagnostics, of), pair) in session.judge_q_projects(&open).into_iter().zip(names).zip(&open) {
            let result = DrawingResult { names: Vec::new(), diagnostics };
            if session.is_traced() {
                let trace = Trace { files: pair.to_vec(), lookups: Vec::new() };
                made.push(new(&of, vec![trace], &result));
            }
            found.push((of, result.diagnostics));
        }
        (found, made)
    }

    /// Keeps what was found now.
    pub(super) fn keep(&self, session: &Session<'_>, made: &[FreshResult]) {
        if let Some(result_store) = &self.0 {
            session.timings().measure(&KEEPING, || result_store.keep(session, made));
        }
    }
}

/// The name of the results of a drawing, or of some of its paths.
pub(super) fn of<'a>(drawing: &'a Utf8Path, paths: Option<&[PathName]>) -> Cow<'a, str> {
    let Some(paths) = paths else { return drawing.as_str().into() };
    let names: String = paths.iter().flat_map(|path| ["\0", path.as_str()]).collect();
    format!("{drawing}\0{names}").into()
}

/// The name of what only says which paths a drawing has.
fn of_names(drawing: &Utf8Path) -> Cow<'_, str> {
    of(drawing, Some(&[]))
}

/// A result to be kept.
pub(super) fn new(of: &str, traces: Vec<Trace>, result: &DrawingResult) -> FreshResult {
    FreshResult { of: of.into(), traces, payload: result.encode(), ..FreshResult::default() }
}

/// Which results are shown.
pub(super) struct Concerned<'a> {
    session: &'a Session<'a>,
    results: &'a Results,
    made: HashMap<&'a str, &'a FreshResult>,
    /// `None`: all are.
    changed: Option<Changed>,
}

impl<'a> Concerned<'a> {
    /// Of the results of these names those that depend on what changed since then.
    pub(super) fn new<'n>(
        session: &'a Session<'a>,
        results: &'a Results,
        made: &'a [FreshResult],
        past: Option<&dyn Past>,
        names: impl Iterator<Item = Cow<'n, str>>,
    ) -> Self {
        let made = made.iter().map(|made| (&*made.of, made)).collect();
        let mut concerned = Self { session, results, made, changed: None };
        concerned.changed = past.map(|past| Changed::new(session, past, concerned.reached(names)));
        concerned
    }

    pub(super) fn contains(&self, of: &str) -> bool {
        let Some(changed) = &self.changed else { return true };
        if let Some(made) = self.made.get(of) {
            return changed.concerns(self.session, &made.traces);
        }
        self.facts(of).is_none_or(|facts| changed.concerns_kept(&facts))
    }

    fn reached<'n>(&self, names: impl Iterator<Item = Cow<'n, str>>) -> Reached {
        let mut reached = Reached::default();
        for of in names {
            if let Some(made) = self.made.get(&*of) {
                reached.add(self.session, &made.traces);
            } else if let Some(facts) = self.facts(&of) {
                reached.add_kept(&facts);
            }
        }
        reached
    }

    fn facts(&self, of: &str) -> Option<Dependencies<'_>> {
        self.results.0.as_ref()?.facts(of)
    }
}
