//! Compares programs on disk with their drawings. Programs that differ are also compared with those that `--compatible` would write. (book:
//! language/probes, book: program/compatible)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, join};
use pathbuild_db::{Db, MissingOption, Role, Target, program};
use pathbuild_diagnostic::messages::outputs;
use pathbuild_diagnostic::{Diagnostic, Note};
use pathbuild_gcode::native::{
    OtherLine, Parts, drawing_of_title, first_other_line, is_title, path_of_title,
};
use pathbuild_gcode::provenance::Provenance;
use pathbuild_path::PathName;
use pathbuild_toolpath::Program;

use super::options::{Provenances, write_settings};
use super::outcome::{ProgramOutcome, State};
use super::plan::Job;
use crate::config::Settings;
use crate::session::{OutputKind, SelectedPath, Session};
use crate::workspace::Workspace;

/// The result of comparing a program with its drawing.
#[derive(Debug)]
pub enum DrawingComparison {
    /// The drawing produces the same program, which is that of this target.
    Same(Target),
    /// The drawing produces different moves.
    Other {
        /// Path of the drawing's file.
        drawing: Utf8PathBuf,
    },
    /// The drawing produces the same moves, but `emit` writes different lines.
    Edited {
        /// Path of the drawing's file.
        drawing: Utf8PathBuf,
        /// The first line that differs.
        other: OtherLine,
    },
    /// The drawing has these errors, so its program is unknown.
    Wrong(Vec<Diagnostic>),
    /// The moves depend on these options, which are not given.
    NeedsOptions(Vec<MissingOption>),
    /// The drawing was not found.
    NoDrawing {
        /// Name of the drawing, as the program states it.
        drawing: Box<str>,
    },
    /// The program does not identify its drawing.
    Unknown,
}

/// Compares a native program with its drawing. The drawing is `named`, or else the one in the program's title, which is searched for beside the
/// program and then where paths are looked up.
pub fn compare_with_drawing(
    session: &mut Session<'_>,
    text: &[u8],
    beside: &Utf8Path,
    named: Option<&Utf8Path>,
) -> DrawingComparison {
    let Some((found, title)) = Provenance::of_head(text) else { return DrawingComparison::Unknown };
    let (Some(path), Some(drawing)) = (path_of_title(&title), drawing_of_title(&title)) else {
        return DrawingComparison::Unknown;
    };
    session.with_stable_files(|session| match find_titled_path(session, path, &title, beside, named) {
        Ok(Some(path)) => compare_with_path(session, &path, &found, text),
        Ok(None) => DrawingComparison::NoDrawing { drawing: drawing.into() },
        Err(problem) => DrawingComparison::Wrong(vec![*problem]),
    })
}

/// Finds the path that a program's title refers to.
///
/// # Errors
/// PB001 if the program's directory cannot be listed, PB006 if this triggers a bug.
fn find_titled_path(
    session: &Session<'_>,
    path: &str,
    title: &str,
    beside: &Utf8Path,
    named: Option<&Utf8Path>,
) -> Result<Option<SelectedPath>, Box<Diagnostic>> {
    let db = session.db();
    let name = PathName::new(path);
    let is_there = |drawing: &&Utf8Path| db.system().kind(&session.normalize(drawing)) == FileKind::File;
    let is_meant = |file: &str| is_title(title, file, path);
    let file = if let Some(drawing) = named.filter(is_there) {
        Some(session.file(drawing))
    } else {
        let names = session.file_names_in(beside)?;
        names.iter().find(|file| is_meant(file)).map(|file| session.file(&join(beside, file)))
    };
    let file = file.or_else(|| {
        let files = session.definitions(&name, &session.name_directories());
        files.into_iter().find(|file| is_meant(file.path(db).file_name().unwrap_or_default()))
    });
    Ok(file.map(|file| SelectedPath { file, name }))
}

fn compare_with_path(
    session: &Session<'_>,
    path: &SelectedPath,
    found: &Provenance,
    text: &[u8],
) -> DrawingComparison {
    let db = session.db();
    let target = db.target(path.file, path.name.as_str(), Role::Emitted);
    let checked = session.check(&[target]);
    let wrong: Vec<Diagnostic> =
        checked.iter().flat_map(|checked| session.path_diagnostics(checked)).collect();
    if wrong.iter().any(Diagnostic::is_error) {
        return DrawingComparison::Wrong(wrong);
    }
    if let Some(checked) = checked.iter().find(|checked| !checked.missing_options.is_empty()) {
        return DrawingComparison::NeedsOptions(checked.missing_options.clone());
    }
    let now = match session.query_target(target, |db| program(db, target).clone()) {
        Ok(now) => now,
        Err(problem) => return DrawingComparison::Wrong(vec![*problem]),
    };
    let drawing = || path.file.path(db).clone();
    let Some(now) = now else { return DrawingComparison::Other { drawing: drawing() } };
    let provenance = Provenances::new(&session.workspace().settings, None).of(&[&*now]);
    if provenance.moves != found.moves {
        return DrawingComparison::Other { drawing: drawing() };
    }
    let kind = if now.probes.is_empty() { OutputKind::Milling } else { OutputKind::Clean };
    match native_text(&session.workspace().settings, &now, kind) {
        Ok(expected) => match first_other_line(text, expected.as_bytes(), Parts::Code) {
            None => DrawingComparison::Same(target),
            Some(other) => DrawingComparison::Edited { drawing: drawing(), other },
        },
        Err(problem) => DrawingComparison::Wrong(vec![*problem]),
    }
}

/// Returns the text of a native program as `emit` would write it with the current options; empty for setup sheets.
///
/// # Errors
/// PB005 if it is too large.
pub fn native_text(
    settings: &Settings,
    program: &Program,
    kind: OutputKind,
) -> Result<String, Box<Diagnostic>> {
    let provenance = Provenances::new(settings, None).of(&[program]);
    let text = kind.text(program, &provenance.to_string(), &write_settings(settings))?;
    Ok(text.unwrap_or_default())
}

/// Adds a note to each problem of a file that differs from its drawing but equals the program written with `--compatible`. To find out, `emit`
/// generates the programs a second time in that mode, if there are any problems.
pub(super) fn add_compatible_notes<'p>(
    workspace: &Workspace,
    jobs: impl Iterator<Item = &'p mut Job>,
    emit: impl FnOnce(&Workspace) -> Vec<ProgramOutcome>,
) {
    let problems: Vec<&mut Diagnostic> =
        jobs.filter_map(|job| job.outcome.as_mut()).flat_map(|outcome| &mut outcome.problems).collect();
    if problems.is_empty() || workspace.settings.general.compatible.value {
        return;
    }
    let files = emit(&workspace.with_compatible_mode(true)).into_iter().flat_map(|outcome| outcome.files);
    let same = files.filter(|(_, state)| matches!(state, State::Current)).map(|(file, _)| file);
    let same: Vec<Utf8PathBuf> = same.collect();
    for problem in problems {
        if problem.file.as_ref().is_some_and(|file| same.contains(file)) {
            problem.notes.push(Note { message: &outputs::SAME_IF_COMPATIBLE, arguments: Vec::new() });
        }
    }
}
