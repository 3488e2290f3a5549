//! Checks drawings and records the inputs of each result.

use crate::session::{Checker, DrawingResult, Session, by_place};
use pathbuild_db::{Database, Role, SourceFile, Trace, check_file, path_names};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

/// Number of drawings checked between evictions of parsed data.
const BATCH: usize = 512;

/// Checks all paths of the drawings. Returns each result with its inputs.
pub fn check_drawings(
    session: &mut Session<'_>,
    files: &[SourceFile],
    with_all_values: bool,
) -> Vec<(DrawingResult, Vec<Trace>)> {
    let targets: Vec<CheckTarget<'_>> = files.iter().map(|file| (*file, None)).collect();
    check_paths(session, &targets, with_all_values)
}

/// A drawing, with the requested paths unless all are requested.
type CheckTarget<'a> = (SourceFile, Option<&'a [PathName]>);

/// Like [`check_drawings`], for drawings of which only some paths may be requested.
pub(super) fn check_paths(
    session: &mut Session<'_>,
    targets: &[CheckTarget<'_>],
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
    (file, names): &CheckTarget<'_>,
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
