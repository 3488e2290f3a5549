//! Checking drawings: what is found in each, with what it was found from.

use std::borrow::Cow;

use pathbuild_db::{Role, SourceFile, Target, Trace, check_file, path_names};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use crate::session::{CheckedTarget, DrawingResult, Session, by_place};

/// A drawing, or some of its paths.
pub(super) struct Asked<'a> {
    pub(super) file: SourceFile,
    pub(super) names: Cow<'a, [PathName]>,
}

/// What is found in drawings, each with what it was found from.
pub(in crate::commands) fn check_drawings(
    session: &Session<'_>,
    files: &[SourceFile],
    with_all_values: bool,
) -> Vec<(DrawingResult, Vec<Trace>)> {
    session.read_ahead(files);
    let names = |file: &SourceFile| Cow::Borrowed(&**path_names(session.db(), *file));
    let whole = |file: &SourceFile| Asked { file: *file, names: names(file) };
    let asked: Vec<Asked<'_>> = files.iter().map(whole).collect();
    check_paths(session, &asked, with_all_values)
}

/// What is found in paths of drawings, and in the drawings.
pub(super) fn check_paths(
    session: &Session<'_>,
    asked: &[Asked<'_>],
    with_all_values: bool,
) -> Vec<(DrawingResult, Vec<Trace>)> {
    let questions: Vec<Questions> =
        asked.iter().map(|asked| Questions::new(session, asked, with_all_values)).collect();
    let targets: Vec<Target> = questions.iter().flat_map(|of_file| &of_file.targets).copied().collect();
    let mut results = session.check(&targets).into_iter();
    let mut of_drawing = |(asked, questions): (&Asked<'_>, Questions)| {
        let checked: Vec<CheckedTarget> = results.by_ref().take(questions.targets.len()).collect();
        result(session, asked, checked, questions.warnings, with_all_values)
    };
    asked.iter().zip(questions).map(&mut of_drawing).collect()
}

/// What is asked of a drawing's paths.
#[derive(Default)]
struct Questions {
    targets: Vec<Target>,
    warnings: Vec<Diagnostic>,
}

impl Questions {
    fn new(session: &Session<'_>, Asked { file, names }: &Asked<'_>, with_all_values: bool) -> Self {
        let mut questions = Self::default();
        for name in &**names {
            if with_all_values {
                let (combined, warning) = session.combined_targets(*file, name);
                questions.targets.extend(combined);
                questions.warnings.extend(warning);
            } else {
                questions.targets.push(session.target_in(*file, name, Role::Checked));
            }
        }
        questions
    }
}

fn result(
    session: &Session<'_>,
    asked: &Asked<'_>,
    checked: Vec<CheckedTarget>,
    warnings: Vec<Diagnostic>,
    with_all_values: bool,
) -> (DrawingResult, Vec<Trace>) {
    let db = session.db();
    let mut diagnostics = warnings;
    if with_all_values {
        // Those of a path stand together.
        for of_path in checked.chunk_by(|a, b| a.target.name(db) == b.target.name(db)) {
            diagnostics.extend(session.merged(of_path));
        }
    } else {
        diagnostics.extend(checked.iter().flat_map(|checked| &checked.diagnostics).cloned());
    }
    let mut reached = vec![asked.file];
    reached.extend(checked.iter().flat_map(|checked| &checked.files).copied().filter(|it| *it != asked.file));
    if reached.len() > 1 {
        reached.sort_by(|a, b| by_place(a.path(db), b.path(db)));
        reached.dedup();
    }
    diagnostics.extend(reached.iter().flat_map(|file| check_file(db, *file)).cloned());
    let names = asked.names.iter().map(|name| name.as_str().into()).collect();
    let traces = if session.is_traced() { traces(asked.file, checked) } else { Vec::new() };
    (DrawingResult { names, diagnostics }, traces)
}

/// What a drawing's results were found from.
fn traces(file: SourceFile, checked: Vec<CheckedTarget>) -> Vec<Trace> {
    let own = Trace { files: vec![file], lookups: Vec::new() };
    std::iter::once(own).chain(checked.into_iter().filter_map(|checked| checked.trace)).collect()
}
