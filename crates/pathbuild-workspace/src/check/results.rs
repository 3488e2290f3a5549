//! Cached results of earlier checks: only drawings whose results no longer hold are checked again.

use std::borrow::Cow;
use std::collections::HashMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Db, SourceFile, Trace};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use super::changed::{ChangedDrawings, ReachedInputs};
use super::{EarlierFiles, Request, open};
use crate::session::timings::{KEEPING, VERIFYING};
use crate::session::{
    ArgumentMatches, Dependencies, Drawing, DrawingResult, Drawings, FreshResult, Pair, ResultStore, Scope,
    Selection, Session, q_project_pairs,
};

/// The cached results of earlier checks, if there is a cache.
pub(super) struct Results(Option<ResultStore>);

/// A Q-project pair by its subject in the cache, with its diagnostics.
type PairResult = (String, Vec<Diagnostic>);

impl Results {
    /// Loads the cached results of the drawings that the request may select.
    pub(super) fn open(session: &Session<'_>, request: &Request<'_>, found: &mut ArgumentMatches) -> Self {
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

    /// The cached result of a subject.
    pub(super) fn known(&self, subject: &str) -> Option<DrawingResult> {
        DrawingResult::decode(self.0.as_ref()?.payload(subject)?).ok()
    }

    /// The cached paths of a drawing.
    fn names(&self, drawing: &Utf8Path) -> Option<DrawingResult> {
        self.known(drawing.as_str()).or_else(|| self.known(&names_subject(drawing)))
    }

    /// Resolves the arguments. Also returns the results that had to be computed for that.
    pub(super) fn select(
        &self,
        session: &Session<'_>,
        found: &ArgumentMatches,
    ) -> (Selection, Vec<FreshResult>) {
        let db = session.db();
        let mut named: Vec<Utf8PathBuf> = found.candidates().map(|file| file.path(db).clone()).collect();
        named.sort_unstable_by(|a, b| a.as_str().cmp(b.as_str()));
        named.dedup();
        let named = Drawings::new(session, named, |drawing| self.names(drawing));
        let names =
            |file: SourceFile| named.get(file.path(db)).map_or(&[][..], |drawing| &drawing.result.names);
        let selection = session.select_arguments(found, &found.arguments, &names);
        let read = named.iter().filter(|drawing| drawing.is_read && session.is_traced());
        let fresh = read.map(|Drawing { path, result, .. }| {
            let trace = Trace { files: vec![session.file(path)], lookups: Vec::new() };
            new(&names_subject(path), vec![trace], result)
        });
        (selection, fresh.collect())
    }

    /// Reports, as a detail, how many drawings have cached results that still hold.
    pub(super) fn report_known(&self, session: &Session<'_>, known: usize, all: usize) {
        let context = session.workspace();
        if self.0.is_some() {
            let phrase = context
                .choose("drawings whose results still hold", "Zeichnungen, deren Ergebnisse noch gelten");
            context.reporter.detail(&format!("{phrase}: {known} / {all}"));
        }
    }

    /// Compares Q-projects with their drawings. Returns the diagnostics of each pair by its subject in the cache, and the results computed
    /// now.
    pub(super) fn q_projects(
        &self,
        session: &Session<'_>,
        selection: &Selection,
    ) -> (Vec<PairResult>, Vec<FreshResult>) {
        let (mut found, mut fresh) = (Vec::new(), Vec::new());
        let (mut open, mut names): (Vec<Pair>, Vec<String>) = (Vec::new(), Vec::new());
        let named = selection.named.iter().map(|file| file.path(session.db()));
        for [drawing, q_project] in q_project_pairs(selection.drawings.iter().chain(named)) {
            let subject = format!("{drawing}\0{q_project}");
            if let Some(result) = self.known(&subject) {
                found.push((subject, result.diagnostics));
            } else {
                open.push([drawing, q_project].map(|path| session.db().file(path)));
                names.push(subject);
            }
        }
        for ((diagnostics, subject), pair) in
            session.compare_q_projects(&open).into_iter().zip(names).zip(&open)
        {
            let result = DrawingResult { names: Vec::new(), diagnostics };
            if session.is_traced() {
                let trace = Trace { files: pair.to_vec(), lookups: Vec::new() };
                fresh.push(new(&subject, vec![trace], &result));
            }
            found.push((subject, result.diagnostics));
        }
        (found, fresh)
    }

    /// Stores the results computed in this run.
    pub(super) fn keep(&self, session: &Session<'_>, fresh: &[FreshResult]) {
        if let Some(result_store) = &self.0 {
            session.timings().measure(&KEEPING, || result_store.keep(session, fresh));
        }
    }
}

/// Cache subject of a drawing's result, or of the result of some of its paths.
pub(super) fn subject<'a>(drawing: &'a Utf8Path, paths: Option<&[PathName]>) -> Cow<'a, str> {
    let Some(paths) = paths else { return drawing.as_str().into() };
    let names: String = paths.iter().flat_map(|path| ["\0", path.as_str()]).collect();
    format!("{drawing}\0{names}").into()
}

/// Cache subject of the list of a drawing's paths.
fn names_subject(drawing: &Utf8Path) -> Cow<'_, str> {
    subject(drawing, Some(&[]))
}

/// Prepares a result for the cache.
pub(super) fn new(subject: &str, traces: Vec<Trace>, result: &DrawingResult) -> FreshResult {
    FreshResult { subject: subject.into(), traces, payload: result.encode(), ..FreshResult::default() }
}

/// Selects the results that are shown.
pub(super) struct ChangeFilter<'a> {
    session: &'a Session<'a>,
    results: &'a Results,
    fresh: HashMap<&'a str, &'a FreshResult>,
    /// `None` shows all results.
    changed: Option<ChangedDrawings>,
}

impl<'a> ChangeFilter<'a> {
    /// If `past` is given, selects those of the named results that depend on files changed since then.
    pub(super) fn new<'n>(
        session: &'a Session<'a>,
        results: &'a Results,
        fresh: &'a [FreshResult],
        past: Option<&dyn EarlierFiles>,
        names: impl Iterator<Item = Cow<'n, str>>,
    ) -> Self {
        let fresh = fresh.iter().map(|result| (&*result.subject, result)).collect();
        let mut filter = Self { session, results, fresh, changed: None };
        filter.changed = past.map(|past| ChangedDrawings::new(session, past, filter.reached(names)));
        filter
    }

    pub(super) fn contains(&self, subject: &str) -> bool {
        let Some(changed) = &self.changed else { return true };
        if let Some(result) = self.fresh.get(subject) {
            return changed.affects(self.session, &result.traces);
        }
        self.facts(subject).is_none_or(|facts| changed.affects_cached(&facts))
    }

    fn reached<'n>(&self, names: impl Iterator<Item = Cow<'n, str>>) -> ReachedInputs {
        let mut reached = ReachedInputs::default();
        for subject in names {
            if let Some(result) = self.fresh.get(&*subject) {
                reached.add(self.session, &result.traces);
            } else if let Some(facts) = self.facts(&subject) {
                reached.add_cached(&facts);
            }
        }
        reached
    }

    fn facts(&self, subject: &str) -> Option<Dependencies<'_>> {
        self.results.0.as_ref()?.facts(subject)
    }
}
