//! Checking drawings: what is found in each, with what it was found from.

use crate::session::{Asking, DrawingResult, Session, by_place};
use pathbuild_db::{Database, Role, SourceFile, Trace, check_file, path_names};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

/// So many drawings are checked before what was read from them is dropped.
const BATCH: usize = 512;

/// What is found in drawings, each with what it was found from.
pub fn check_drawings(
    session: &mut Session<'_>,
    files: &[SourceFile],
    with_all_values: bool,
) -> Vec<(DrawingResult, Vec<Trace>)> {
    let asked: Vec<CheckTarget<'_>> = files.iter().map(|file| (*file, None)).collect();
    check_paths(session, &asked, with_all_values)
}

/// A drawing, with the paths that are asked for if that is not all.
type CheckTarget<'a> = (SourceFile, Option<&'a [PathName]>);

/// The same of drawings of which only some paths may be asked for.
pub(super) fn check_paths(
    session: &mut Session<'_>,
    asked: &[CheckTarget<'_>],
    with_all_values: bool,
) -> Vec<(DrawingResult, Vec<Trace>)> {
    let files: Vec<SourceFile> = asked.iter().map(|(file, _)| *file).collect();
    session.read_ahead(&files);
    session.in_batches(asked, BATCH, |session, asked| {
        session.each(asked, |asking, asked| check_drawing(asking, asked, with_all_values))
    })
}

fn check_drawing(
    asking: &Asking<'_>,
    (file, names): &CheckTarget<'_>,
    with_all_values: bool,
) -> (DrawingResult, Vec<Trace>) {
    let (db, file) = (asking.db(), *file);
    let names = names.unwrap_or_else(|| path_names(db, file));
    let mut diagnostics = Vec::new();
    let mut reached = vec![file];
    let mut traces = own_trace(asking.is_traced(), file);
    for name in names {
        let (targets, warning) = if with_all_values {
            asking.combined_targets(file, name)
        } else {
            (vec![db.target(file, name.as_str(), Role::Checked)], None)
        };
        let checked = targets.into_iter().map(|target| asking.check(target)).collect::<Vec<_>>();
        diagnostics.extend(warning);
        if with_all_values {
            diagnostics.extend(asking.merged(&checked));
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
/// Adds to what is found in a drawing's paths what is wrong with the files that they reach.
fn result(
    db: &Database,
    names: &[PathName],
    mut diagnostics: Vec<Diagnostic>,
    mut reached: Vec<SourceFile>,
) -> DrawingResult {
    // Of most there is nothing to say, so that there is nothing to put in order.
    reached.retain(|file| !check_file(db, *file).is_empty());
    reached.sort_by(|a, b| by_place(a.path(db), b.path(db)));
    reached.dedup();
    diagnostics.extend(reached.iter().flat_map(|file| check_file(db, *file)).cloned());
    DrawingResult { names: names.to_vec(), diagnostics }
}

/// What a drawing's results were found from whatever its paths are, where that is noted.
fn own_trace(is_traced: bool, file: SourceFile) -> Vec<Trace> {
    if is_traced { vec![Trace { files: vec![file], lookups: Vec::new() }] } else { Vec::new() }
}
