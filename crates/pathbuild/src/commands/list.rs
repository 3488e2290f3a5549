//! `pathbuild list` and `stats`: show the paths of a library, and their totals. (book: reference/commands)

use std::fmt::Write;

use pathbuild_api::{ListOptions, PathSummary};
use pathbuild_diagnostic::Lang;
use pathbuild_path::PathName;
use pathbuild_workspace::list::{
    Figures, ListedPath, ProgramState, Row, State, Stats, Total, path_json, stats_json,
};

use crate::args::ListArgs;
use crate::context::{Context, for_rendering};
use crate::exit::ExitStatus;
use crate::render::Format;
use crate::text::{Column, ERROR, WARNING, counted, decimal, format_count, table};

/// Prints one line per path.
pub fn list(context: &Context, args: &ListArgs) -> ExitStatus {
    show(context, args, |context, rows, _| match context.format {
        Format::Json => rows.iter().for_each(|row| {
            context.row("path", path_json(&context.file(&row.path.drawing), row));
        }),
        _ if rows.is_empty() => {}
        _ => {
            let cells = rows.iter().map(|row| cells(row, context));
            context.printer.result(table(&columns(context), cells));
        }
    })
}

/// Prints the totals of the paths.
pub fn stats(context: &Context, args: &ListArgs) -> ExitStatus {
    show(context, args, |context, rows, drawings| {
        let stats = Stats::of(rows, drawings);
        match context.format {
            Format::Json => context.row("statistics", stats_json(&stats)),
            _ => context.printer.result(text(&stats, context)),
        }
    })
}

/// Lists the paths and shows them with `print`. Errors of paths are part of the list, so only findings about directories and drawings are
/// shown separately.
fn show(context: &Context, args: &ListArgs, print: impl FnOnce(&Context, &[Row], usize)) -> ExitStatus {
    let options = args.post.iter().fold(ListOptions::new(), ListOptions::post);
    let listed = context.library().and_then(|library| library.paths_with(&args.inputs().texts(), &options));
    let listed = match listed {
        Ok(listed) => listed,
        Err(error) => return context.show_request_error(error),
    };
    let rows: Vec<Row> = listed.paths.into_iter().map(row).collect();
    print(context, &rows, listed.drawings);
    context.conclude_findings(&for_rendering(listed.findings, listed.accepted))
}

/// Converts the summary of a path to a row, which HTML pages show as well.
fn row(path: PathSummary) -> Row {
    let errors = path.findings.iter().filter(|finding| finding.is_error()).count();
    let warnings = path.findings.len() - errors;
    let figures = Figures {
        material: path.material.map(Into::into),
        thickness: path.thickness,
        tool: path.tool,
        cutting_box: path.cutting_box,
        length: path.length,
        minutes: path.minutes,
    };
    let program = match path.program {
        pathbuild_api::ProgramState::Current => ProgramState::Current,
        pathbuild_api::ProgramState::Stale => ProgramState::Stale,
        pathbuild_api::ProgramState::Unknown => ProgramState::Unknown,
        _ => ProgramState::None,
    };
    let (name, drawing) = (PathName::new(&path.name), path.file.into());
    Row { path: ListedPath { name, drawing, diagnostics: Vec::new(), figures, program }, errors, warnings }
}

fn state_word(state: State, context: &Context) -> &'static str {
    match state {
        State::Errors => context.choose("errors", "Fehler"),
        State::Stale => context.choose("program not current", "Programm nicht aktuell"),
        State::Unknown => context.choose("program not compared", "Programm nicht verglichen"),
        State::Current => context.choose("program current", "Programm aktuell"),
        State::Ok => context.choose("ok", "in Ordnung"),
    }
}

fn columns(context: &Context) -> [Column<'static>; 9] {
    let heading = |en, de| context.choose(en, de);
    [
        (heading("path", "Pfad"), false),
        (heading("drawing", "Zeichnung"), false),
        ("M", false),
        ("T", true),
        ("O", true),
        (heading("size", "Größe"), true),
        (heading("length", "Länge"), true),
        ("min", true),
        (heading("state", "Zustand"), false),
    ]
}

fn cells(row: &Row, context: &Context) -> Vec<String> {
    let path = &row.path;
    let number = |number: Option<f64>, places| {
        number.map_or_else(|| "-".to_owned(), |number| decimal(number, places, context.lang()))
    };
    let size =
        row.size().map(|[width, height]| format!("{} x {}", number(Some(width), 1), number(Some(height), 1)));
    vec![
        path.name.as_str().to_owned(),
        path.drawing.to_string(),
        path.figures.material.as_deref().unwrap_or("-").to_owned(),
        number(path.figures.thickness, 3),
        number(path.figures.tool, 3),
        size.unwrap_or_else(|| "-".to_owned()),
        number(path.figures.length, 0),
        number(path.figures.minutes, 0),
        state_text(row, context),
    ]
}

fn state_text(row: &Row, context: &Context) -> String {
    let lang = context.lang();
    let errors = match row.state() {
        State::Errors => counted(row.errors, ERROR, lang),
        state => state_word(state, context).to_owned(),
    };
    if row.warnings == 0 {
        return errors;
    }
    format!("{errors}, {}", counted(row.warnings, WARNING, lang))
}

fn text(stats: &Stats, context: &Context) -> String {
    let lang = context.lang();
    let say = |en, de| context.choose(en, de);
    let mut text = format!(
        "{}: {}, {}: {}, {}: {} mm, {}: {}\n",
        say("drawings", "Zeichnungen"),
        format_count(stats.drawings, lang),
        say("paths", "Pfade"),
        format_count(stats.all.paths, lang),
        say("length", "Länge"),
        decimal(stats.all.length, 0, lang),
        say("minutes", "Minuten"),
        minutes(&stats.all, lang),
    );
    for (state, number) in &stats.states {
        _ = writeln!(text, "  {}: {}", state_word(*state, context), format_count(*number, lang));
    }
    _ = writeln!(
        text,
        "  {}: {}",
        say("paths with warnings", "Pfade mit Warnungen"),
        format_count(stats.warnings, lang)
    );
    let none = || say("none", "keins").to_owned();
    let materials =
        stats.materials.iter().map(|(name, total)| (name.as_deref().map_or_else(none, str::to_owned), total));
    text.push_str(&table_by(context, say("material M", "Material M"), materials));
    let cutters = stats.cutters.iter().map(|(tool, total)| {
        #[expect(clippy::cast_precision_loss, reason = "a diameter within a drawing's limits")]
        let shown = tool.map_or_else(none, |tool| decimal(tool as f64 / 1000.0, 3, lang));
        (shown, total)
    });
    text.push_str(&table_by(context, say("cutter O", "Fräser O"), cutters));
    text
}

/// Formats the time of several paths; a hyphen if it is unknown.
fn minutes(total: &Total, lang: Lang) -> String {
    total.minutes().map_or_else(|| "-".to_owned(), |minutes| decimal(minutes, 0, lang))
}

fn table_by<'a>(
    context: &Context,
    heading: &str,
    totals: impl Iterator<Item = (String, &'a Total)>,
) -> String {
    let lang = context.lang();
    let columns = [
        (heading, false),
        (context.choose("paths", "Pfade"), true),
        (context.choose("length", "Länge"), true),
        ("min", true),
    ];
    let rows = totals.map(|(name, total)| {
        vec![name, format_count(total.paths, lang), decimal(total.length, 0, lang), minutes(total, lang)]
    });
    format!("\n{}", table(&columns, rows))
}
