//! Checking directories with what earlier runs found: only drawings whose results no longer hold are checked.

use std::collections::HashMap;

use camino::Utf8PathBuf;
use pathbuild_db::{Db, SourceFile, Trace};
use pathbuild_diagnostic::Diagnostic;

use super::changed::Changed;
use super::drawings::check_drawings;
use super::{Checked, CheckedFile, Request, leave, open};
use crate::session::timings::{KEEPING, VERIFYING};
use crate::session::{DrawingResult, Found, Keeper, Made, Pair, Scope, Session, q_project_pairs};

/// Checks drawings, and keeps what is found.
pub(super) fn check(session: &mut Session<'_>, request: &Request<'_>, found: Found) -> Checked {
    let context = session.workspace();
    let changed = request.changed.as_ref().map(|drawings| Changed::new(session, drawings));
    let scope = Scope::of(&found);
    let Found { drawings, listings, problems, .. } = found;
    let with_all_values = request.with_all_values;
    let opened = session.timings().measure(&VERIFYING, || open(context, with_all_values, scope, listings));
    let keeper = opened.as_ref();
    let mut results: Vec<Option<DrawingResult>> =
        drawings.iter().map(|drawing| kept(keeper, drawing.as_str())).collect();
    let open: Vec<usize> = (0..drawings.len()).filter(|index| results[*index].is_none()).collect();
    let phrase =
        context.choose("drawings whose results still hold", "Zeichnungen, deren Ergebnisse noch gelten");
    context.reporter.detail(&format!("{phrase}: {} / {}", drawings.len() - open.len(), drawings.len()));
    let files: Vec<SourceFile> =
        session.db().files(open.iter().map(|index| drawings[*index].clone()).collect());
    let mut made = Vec::new();
    let checked = session.settled(|session| check_drawings(session, &files, with_all_values));
    for ((result, traces), index) in checked.into_iter().zip(open) {
        made.push(new(drawings[index].as_str(), traces, &result));
        results[index] = Some(result);
    }
    let (q_projects, made_of_pairs) = session.settled(|session| q_projects(session, keeper, &drawings));
    made.extend(made_of_pairs);
    if let Some(keeper) = keeper {
        session.timings().measure(&KEEPING, || keeper.keep(session, &made));
    }
    let concerned = Concerned::new(session, keeper, &made, changed.as_ref());
    let mut checked = Checked { diagnostics: problems, ..Checked::default() };
    checked.diagnostics.extend(session.no_path_anywhere(results.iter().flatten().map(DrawingResult::parts)));
    for (drawing, result) in drawings.into_iter().zip(results.into_iter().flatten()) {
        if !concerned.contains(drawing.as_str()) {
            continue;
        }
        checked.files.push(CheckedFile { file: drawing, paths: result.names });
        checked.diagnostics.extend(result.diagnostics);
    }
    let q_projects = q_projects.into_iter().filter(|(of, _)| concerned.contains(of));
    checked.diagnostics.extend(q_projects.flat_map(|(_, found)| found));
    leave(opened);
    checked
}

/// Which results are shown.
struct Concerned<'a> {
    session: &'a Session<'a>,
    keeper: Option<&'a Keeper>,
    made: HashMap<&'a str, &'a Made>,
    changed: Option<&'a Changed>,
}

impl<'a> Concerned<'a> {
    fn new(
        session: &'a Session<'a>,
        keeper: Option<&'a Keeper>,
        made: &'a [Made],
        changed: Option<&'a Changed>,
    ) -> Self {
        let made = made.iter().map(|made| (&*made.of, made)).collect();
        Self { session, keeper, made, changed }
    }

    fn contains(&self, of: &str) -> bool {
        let Some(changed) = self.changed else { return true };
        match self.made.get(of) {
            Some(made) => changed.concerns(self.session, &made.traces),
            None => self
                .keeper
                .and_then(|keeper| keeper.facts(of))
                .is_none_or(|facts| changed.concerns_kept(&facts)),
        }
    }
}

fn kept(keeper: Option<&Keeper>, of: &str) -> Option<DrawingResult> {
    keeper?.payload(of).and_then(|payload| DrawingResult::decode(payload).ok())
}

fn new(of: &str, traces: Vec<Trace>, result: &DrawingResult) -> Made {
    Made { of: of.into(), traces, payload: result.encode(), ..Made::default() }
}

/// A pair by its name among the results, and what is said of it.
type Judged = (Box<str>, Vec<Diagnostic>);

/// What Q-projects and their drawings say against each other, each pair by its name among the results.
fn q_projects(
    session: &Session<'_>,
    keeper: Option<&Keeper>,
    drawings: &[Utf8PathBuf],
) -> (Vec<Judged>, Vec<Made>) {
    let (mut found, mut made) = (Vec::new(), Vec::new());
    let (mut open, mut names): (Vec<Pair>, Vec<Box<str>>) = (Vec::new(), Vec::new());
    for [drawing, q_project] in q_project_pairs(drawings.iter()) {
        let of: Box<str> = format!("{drawing}\0{q_project}").into();
        if let Some(result) = kept(keeper, &of) {
            found.push((of, result.diagnostics));
        } else {
            open.push([drawing, q_project].map(|path| session.db().file(path)));
            names.push(of);
        }
    }
    for ((diagnostics, of), pair) in session.judge_q_projects(&open).into_iter().zip(names).zip(&open) {
        let result = DrawingResult { names: Vec::new(), diagnostics };
        let trace = Trace { files: pair.to_vec(), lookups: Vec::new() };
        made.push(new(&of, vec![trace], &result));
        found.push((of, result.diagnostics));
    }
    (found, made)
}
