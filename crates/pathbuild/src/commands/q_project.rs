//! `pathbuild q-project`: writes a drawing that embeds all paths of another drawing. (book: language/q-projects)

use std::collections::VecDeque;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, with_forward_slashes};
use pathbuild_db::{Db, Role, Settings, SourceFile, check_file, path_names, q_project};
use pathbuild_diagnostic::messages::{files, outputs};
use pathbuild_diagnostic::reasons::DRAWN_BY_USER;
use pathbuild_diagnostic::{Code, Diagnostic, Lang, Value, escaping};
use pathbuild_draw::EmbeddingPath;
use pathbuild_path::{PathName, PathTools, QProject, q_project_name};

use super::report_output;
use crate::args::QProjectArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::files::write_error;
use pathbuild_workspace::protected_files::replace_error;
use pathbuild_workspace::session::{NamedPaths, Session};

/// Runs the command. Nothing is written if the drawing has errors, or if the resulting drawing would have any.
pub fn run(context: &Context, args: &QProjectArgs) -> ExitStatus {
    // `-` usually means stdout, but CAD programs read drawings from files.
    if args.output.as_deref() == Some(Utf8Path::new("-")) {
        return context.usage_error(context.choose(
            "`-o -`: q-project writes a drawing, which needs a file name",
            "`-o -`: q-project schreibt eine Zeichnung und braucht dafür einen Dateinamen",
        ));
    }
    let mut session = Session::new(context);
    let drawing = match session.with_stable_files(|session| named_drawing(session, &args.drawing)) {
        Ok(Some(drawing)) => drawing,
        Ok(None) => {
            return context.usage_error(&context.phrase(
                "q-project embeds all paths of one drawing: name the drawing instead of {}",
                "q-project bettet alle Pfade einer Zeichnung ein: statt {} die Zeichnung nennen",
                &escaping::line(&args.drawing),
            ));
        }
        Err(problems) => return context.fail(problems),
    };
    let is_unread = |problem: &&Diagnostic| problem.code() == Code::UnreadableFile;
    let unread: Vec<Diagnostic> = session.with_stable_files(|session| {
        check_file(session.db(), drawing).iter().filter(is_unread).cloned().collect()
    });
    if !unread.is_empty() {
        return context.fail(session.with_hints(unread));
    }
    let name = session.with_stable_files(|session| path_name(session, drawing, args.path_name.as_deref()));
    let name = match name {
        Ok(name) => name,
        Err(reason) => return context.usage_error(&reason),
    };
    let output =
        session.normalize(args.output.as_deref().unwrap_or(&q_project_file(drawing.path(session.db()))));
    if output == *drawing.path(session.db()) {
        return context.usage_error(context.choose(
            "the Q-project would overwrite its own drawing",
            "das Q-Projekt würde seine eigene Zeichnung überschreiben",
        ));
    }
    match session.with_stable_files(|session| draw_q_project(context, session, drawing, &output, &name)) {
        Ok((bytes, count)) => write(context, &session, &output, &bytes, count),
        Err(problems) => {
            _ = context.conclude(session.with_hints(problems));
            ExitStatus::Errors
        }
    }
}

/// Returns the drawing that an argument names: by its file, by a pattern, or by the name of its only path. `None` for a directory, and for one of several
/// paths.
fn named_drawing(session: &Session<'_>, argument: &str) -> Result<Option<SourceFile>, Vec<Diagnostic>> {
    let named = session.named_paths(argument)?;
    let is_whole = |named: &NamedPaths| named.names.len() == path_names(session.db(), named.file).len();
    Ok(named.filter(is_whole).map(|named| named.file))
}

/// Returns `NAME_Q.dxf` in the directory of the drawing `NAME.dxf`.
fn q_project_file(drawing: &Utf8Path) -> Utf8PathBuf {
    with_forward_slashes(
        drawing.with_file_name(format!("{}.dxf", q_project_name(drawing.file_stem().unwrap_or_default()))),
    )
}

/// Returns the name of the Q-project's path: the given one, or the drawing's first number with `.0Q`.
fn path_name(session: &Session<'_>, drawing: SourceFile, given: Option<&str>) -> Result<PathName, String> {
    let name = given.map_or_else(|| default_name(drawing.path(session.db())), str::to_owned);
    let pattern = &Settings::get(session.db()).language(session.db()).path_pattern;
    if !pattern.matches(&name) {
        let pattern = pattern.as_str();
        return Err(match session.workspace().lang() {
            Lang::En => {
                format!("{name:?} is not a path name: give one that matches {pattern} with --path-name")
            }
            Lang::De => {
                format!("{name:?} ist kein Pfadname: mit --path-name einen angeben, auf den {pattern} passt")
            }
        });
    }
    let name = PathName::new(&name);
    if path_names(session.db(), drawing).contains(&name) {
        return Err(session.workspace().phrase(
            "{} is a path of the drawing itself: give another name with --path-name",
            "{} ist ein Pfad der Zeichnung selbst: mit --path-name einen anderen Namen angeben",
            name.as_str(),
        ));
    }
    Ok(name)
}

/// Returns the first number in the drawing's name, followed by `.0Q`.
fn default_name(drawing: &Utf8Path) -> String {
    let stem = drawing.file_stem().unwrap_or_default();
    let is_digit = |character: char| character.is_ascii_digit();
    let number = stem.trim_start_matches(|character| !is_digit(character));
    let end = number.find(|character| !is_digit(character)).unwrap_or(number.len());
    format!("{}.0Q", &number[..end])
}

/// Draws the Q-project. Returns the DXF and the number of embedded paths.
fn draw_q_project(
    context: &Context,
    session: &Session<'_>,
    drawing: SourceFile,
    output: &Utf8Path,
    name: &PathName,
) -> Result<(Vec<u8>, usize), Vec<Diagnostic>> {
    let problems = all_diagnostics(session, drawing);
    if problems.iter().any(Diagnostic::is_error) {
        return Err(problems);
    }
    let planned = q_project(session.db(), drawing);
    let language = Settings::get(session.db()).language(session.db());
    let is_free = |name: &PathName| {
        language.path_pattern.matches(name.as_str()) && !path_names(session.db(), drawing).contains(name)
    };
    let Some(names) = names(name, planned, &language.tools, is_free) else {
        let problem = Diagnostic::new(&outputs::NO_NAME_FOR_CUTTER).quoting("name", name.as_str());
        return Err(vec![problem.in_file(drawing.path(session.db()))]);
    };
    let bytes = dxf(planned, &names).map_err(|reason| {
        let problem = Diagnostic::new(&files::CANNOT_WRITE)
            .quoting("name", output.file_name().unwrap_or_default())
            .with("reason", Value::foreign(reason));
        vec![problem.in_file(drawing.path(session.db()))]
    })?;
    let mut preview = Session::with_drawing(context, output, bytes.clone());
    let (original, written) = (preview.file(drawing.path(session.db())), preview.file(output));
    let problems = preview.with_stable_files(|preview| {
        let compared = pathbuild_db::q_project_findings(preview.db(), original, written);
        // Errors of proxy lines recur in the Q-project, but must be corrected in the drawing, so that only the comparison reports them.
        let copied = if compared.iter().any(Diagnostic::is_error) {
            Vec::new()
        } else {
            all_diagnostics(preview, written)
        };
        [copied, compared.clone()].concat()
    });
    let is_wrong = |problem: &Diagnostic| problem.is_error() || problem.code() == Code::QProjectDiffers;
    let count = planned.iter().map(|path| path.lines.len()).sum();
    if problems.iter().any(is_wrong) { Err(problems) } else { Ok((bytes, count)) }
}

/// Returns the names of a Q-project's paths, one per cutter. The candidates are the given name and free names whose last number is higher. Each path
/// gets the first candidate that selects its tool (`paths` of a `[tool]`), or else the first that is left. `None` if there are not enough candidates.
fn names(
    first: &PathName,
    planned: &[QProject],
    tools: &PathTools,
    is_free: impl Fn(&PathName) -> bool,
) -> Option<Vec<PathName>> {
    let is_digit = |character: char| character.is_ascii_digit();
    let text = first.as_str();
    let end = text.rfind(is_digit).map_or(0, |last| last + 1);
    let start = text[..end].trim_end_matches(is_digit).len();
    let number = u64::from(text[start..end].parse::<u32>().unwrap_or_default());
    let next = |offset: u64| PathName::new(&format!("{}{}{}", &text[..start], number + offset, &text[end..]));
    let others = (1..=MAX_TRIED_NAMES).filter(|_| start < end).map(next).filter(is_free);
    let mut free: VecDeque<PathName> = std::iter::once(first.clone()).chain(others).collect();
    let take = |path: &QProject| {
        let suitable = free.iter().position(|name| path.has_tool_of(name, tools));
        free.remove(suitable.unwrap_or_default())
    };
    planned.iter().map(take).collect()
}

const MAX_TRIED_NAMES: u64 = 1000;

/// Returns the diagnostics of a drawing and of all its paths, including PB513 if there are no paths.
fn all_diagnostics(session: &Session<'_>, drawing: SourceFile) -> Vec<Diagnostic> {
    let db = session.db();
    let mut problems = check_file(db, drawing).to_vec();
    let targets = session.targets(drawing, &Role::Checked);
    problems.extend(session.no_path_error(drawing.path(db), path_names(db, drawing), &problems));
    problems.extend(session.check(&targets).into_iter().flat_map(|checked| checked.diagnostics));
    problems
}

fn dxf(planned: &[QProject], names: &[PathName]) -> Result<Vec<u8>, String> {
    let mut paths = Vec::new();
    for (path, name) in planned.iter().zip(names) {
        let segments = path.lines.iter().map(|line| (line.length, line.text.as_str())).collect();
        paths.push(EmbeddingPath { layer: name.as_str(), parameters: &path.parameters, segments });
    }
    let drawing = pathbuild_draw::q_project(&paths).map_err(|reasons| reasons.join("; "))?;
    Ok(with_mark(&drawing))
}

fn write(
    context: &Context,
    session: &Session<'_>,
    output: &Utf8Path,
    bytes: &[u8],
    count: usize,
) -> ExitStatus {
    if is_drawn_by_user(session, output, bytes) {
        return context.fail(vec![replace_error(output, &DRAWN_BY_USER)]);
    }
    let state = match session.db().system().write(output, bytes) {
        Ok(written) => report_output(context, output, written),
        Err(reason) => return context.fail(vec![write_error(output, reason)]),
    };
    let paths = match count {
        1 => context.choose("path", "Pfad"),
        _ => context.choose("paths", "Pfade"),
    };
    context.printer.status(format_args!("{output}: {state}, {count} {paths}"));
    ExitStatus::Success
}

/// Whether the output file is a drawing that q-project did not write, or that was edited since.
fn is_drawn_by_user(session: &Session<'_>, output: &Utf8Path, bytes: &[u8]) -> bool {
    let system = session.db().system();
    let limit = session.workspace().settings.limits.file_size.value;
    let is_there = system.kind(output) == FileKind::File;
    is_there && !system.read(output, limit).is_ok_and(|old| is_unedited(&with_written_line_ends(&old), bytes))
}

/// Returns a text with the line ends that q-project writes. Git and archive programs convert them.
fn with_written_line_ends(text: &[u8]) -> Vec<u8> {
    let lines = text.split(|byte| *byte == b'\n').map(|line| line.strip_suffix(b"\r").unwrap_or(line));
    lines.collect::<Vec<_>>().join(LINE_END)
}

/// Whether `old` is unchanged since q-project wrote it. `new` is the drawing that q-project writes now.
fn is_unedited(old: &[u8], new: &[u8]) -> bool {
    let Some(rest) = old.strip_prefix(Q_PROJECT_MARK) else {
        // The first versions wrote no mark.
        return with_mark(old) == new;
    };
    // The mark of 0.2.0 has no hash, so edits are not noticed.
    let is_without_hash = rest.starts_with(LINE_END);
    let drawing = rest.get(1 + HASH_LENGTH + LINE_END.len()..);
    is_without_hash || drawing.is_some_and(|drawing| with_mark(drawing) == old)
}

/// Returns a Q-project with its mark, which ends with a hash of the drawing, so that edits are noticed.
fn with_mark(drawing: &[u8]) -> Vec<u8> {
    let hash = blake3::hash(drawing).to_hex();
    [Q_PROJECT_MARK, b" ", hash[..HASH_LENGTH].as_bytes(), LINE_END, drawing].concat()
}

/// Beginning of every Q-project: a DXF comment that marks it. CAD programs drop it when they save.
const Q_PROJECT_MARK: &[u8] = b"999\r\npathbuild q-project";

/// Number of hexadecimal digits of the hash in the mark.
const HASH_LENGTH: usize = 32;

const LINE_END: &[u8] = b"\r\n";
