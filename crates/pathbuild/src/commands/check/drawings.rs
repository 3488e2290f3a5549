//! Checking drawings: what is found in each, with what it was found from.

use std::borrow::Cow;

use pathbuild_db::{Database, Role, SourceFile, Target, Trace, check_file, clear, path_names, survey};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use pathbuild_workspace::session::{Asking, CheckedTarget, DrawingResult, Session, by_place};

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
    let names = |file: &SourceFile| Cow::Borrowed(path_names(session.db(), *file));
    let whole = |file: &SourceFile| Asked { file: *file, names: names(file) };
    let asked: Vec<Asked<'_>> = files.iter().map(whole).collect();
    check_paths(session, &asked, with_all_values)
}

/// What is found in drawings by a run that goes through all of them once.
pub(super) fn check_library(
    session: &mut Session<'_>,
    files: &[SourceFile],
    with_all_values: bool,
) -> Vec<(DrawingResult, Vec<Trace>)> {
    // Whoever wants to know where the time goes gets it stage by stage, and of one drawing all has been asked stage by stage while its directory was listed.
    if with_all_values || session.timings().is_on() || files.len() <= 1 {
        return session.in_batches(files, |session, files| check_drawings(session, files, with_all_values));
    }
    session.survey_drawings();
    session
        .in_batches(files, |session, files| session.each(files, |asking, file| check_surveyed(asking, *file)))
}

/// What is found in a drawing that is surveyed: only of paths that are not clear more is asked.
fn check_surveyed(asking: &Asking<'_>, file: SourceFile) -> (DrawingResult, Vec<Trace>) {
    let db = asking.db();
    let survey = survey(db, file);
    let mut diagnostics = Vec::new();
    let mut reached: Vec<SourceFile> =
        (!survey.diagnostics().is_empty()).then_some(file).into_iter().collect();
    let mut traces = own_trace(asking.is_traced(), file);
    for name in survey.names() {
        if let Some(clear) = clear(db, file, survey, name, asking.is_traced()) {
            reached.extend(clear.faulty);
            traces.extend(clear.trace);
        } else {
            let checked = asking.check(Target::new(db, file, name.as_str().into(), Role::Checked));
            diagnostics.extend(checked.diagnostics);
            reached.extend(checked.files);
            traces.extend(checked.trace);
        }
    }
    (result(db, survey.names(), diagnostics, reached), traces)
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
        let mut diagnostics = questions.warnings;
        diagnostics.extend(found(session, &checked, with_all_values));
        let files = checked.iter().flat_map(|checked| &checked.files);
        let reached = std::iter::once(&asked.file).chain(files).copied().collect();
        let mut traces = own_trace(session.is_traced(), asked.file);
        traces.extend(checked.iter().filter_map(|checked| checked.trace.clone()));
        (result(session.db(), &asked.names, diagnostics, reached), traces)
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

/// What is found in a drawing's paths, said once of each path.
fn found(session: &Session<'_>, checked: &[CheckedTarget], with_all_values: bool) -> Vec<Diagnostic> {
    if !with_all_values {
        return checked.iter().flat_map(|checked| &checked.diagnostics).cloned().collect();
    }
    let db = session.db();
    // Those of a path stand together.
    let paths = checked.chunk_by(|a, b| a.target.name(db) == b.target.name(db));
    paths.flat_map(|of_path| session.merged(of_path)).collect()
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
