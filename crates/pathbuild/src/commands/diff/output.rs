//! Prints a comparison, and writes it to a file.

use std::fmt::Write;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Diagnostic, Lang, Number, escaping};
use pathbuild_path::{DrawnChange, ElementChange};
use pathbuild_view::{ChangeKind, Group, Totals, escaped, moves, phrase};
use pathbuild_workspace::diff::{
    Comparison, PathChangeKind, PathDiff, PictureSet, ProgramDiff, Reason, StateChange,
};
use pathbuild_workspace::files::write_error;
use serde::Serialize;
use serde_json::{Value, json};

use crate::commands::state_word;
use crate::context::Context;
use crate::text::counted;

/// The file to write with its format; `None` if the comparison is only printed.
pub(super) struct Output(Option<(Format, Utf8PathBuf)>);

#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Html,
    Markdown,
}

impl Output {
    /// Chooses the format of a file by its extension.
    ///
    /// # Errors
    /// The extension is unknown.
    pub(super) fn of(context: &Context, file: Option<&Utf8Path>) -> Result<Self, String> {
        let Some(file) = file else { return Ok(Self(None)) };
        let format = match file.extension().unwrap_or_default().to_ascii_lowercase().as_str() {
            "html" => Format::Html,
            "md" => Format::Markdown,
            _ => {
                return Err(context.phrase(
                    "-o {}: the name must end in .html or .md",
                    "-o {}: der Name muss auf .html oder .md enden",
                    &escaping::line(file.as_str()),
                ));
            }
        };
        Ok(Self(Some((format, file.to_owned()))))
    }

    pub(super) fn has_pictures(&self) -> bool {
        matches!(self.0, Some((Format::Html, _)))
    }

    /// Writes the file, if one was requested.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(super) fn deliver(&self, context: &Context, comparison: &Comparison) -> Result<(), Box<Diagnostic>> {
        let Some((format, file)) = &self.0 else { return Ok(()) };
        let text = match format {
            Format::Html => page(comparison, context.lang()),
            Format::Markdown => markdown(comparison, context.lang()),
        };
        let refused = |reason| Box::new(write_error(file, reason));
        let state = state_word(context, context.system.write(file, text.as_bytes()).map_err(refused)?);
        context.printer.status(format_args!("{}: {state}", escaping::line(file.as_str())));
        Ok(())
    }
}

/// Formats the whole comparison: the outcome of each path, and a summary.
pub(super) fn text(comparison: &Comparison, lang: Lang) -> String {
    let mut text = String::new();
    for path in &comparison.paths {
        _ = writeln!(
            text,
            "{} · {}: {}",
            escaping::line(&path.name),
            escaping::line(&place(path)),
            outcome(path, comparison, lang)
        );
        if let PathChangeKind::Changed(program) = &path.outcome {
            for line in details(program, lang) {
                _ = writeln!(text, "  {line}");
            }
            for (depth, line) in explanation(program, lang) {
                _ = writeln!(text, "  {}{line}", "  ".repeat(depth));
            }
        }
    }
    _ = writeln!(text, "{}", summary(comparison, lang));
    text
}

/// Returns the drawing of a path, or both drawings if the path moved to another one.
pub(super) fn place(path: &PathDiff) -> String {
    let [old, new] = path.files.each_ref().map(|file| file.as_deref().map(Utf8Path::as_str));
    match (old, new) {
        (Some(old), Some(new)) if old != new => format!("{old} → {new}"),
        (_, Some(file)) | (Some(file), None) => file.to_owned(),
        (None, None) => String::new(),
    }
}

/// Describes the outcome of a path in a few words.
pub(super) fn outcome(path: &PathDiff, comparison: &Comparison, lang: Lang) -> &'static str {
    let (en, de) = match &path.outcome {
        // The error is shown among the problems, so there is no need to refer to `check`, which would not report errors that only programs have.
        PathChangeKind::Broken if path.files[0].is_none() => ("new, has errors", "neu, hat Fehler"),
        PathChangeKind::Broken if comparison.has_error_of(path) => ("has errors now", "hat jetzt Fehler"),
        PathChangeKind::Added => ("new", "neu"),
        PathChangeKind::Removed => ("gone", "weg"),
        PathChangeKind::Broken => {
            ("has errors now (pathbuild check shows them)", "hat jetzt Fehler (pathbuild check zeigt sie)")
        }
        PathChangeKind::Mended => ("had errors, has none now", "hatte Fehler, jetzt keine mehr"),
        PathChangeKind::StillBroken => ("has errors, before and now", "hat Fehler, vorher und jetzt"),
        PathChangeKind::OtherDrawing => {
            ("the same moves, from another drawing", "dieselben Bewegungen, aus anderer Zeichnung")
        }
        PathChangeKind::Changed(_) => ("changed", "geändert"),
    };
    lang.choose(en, de)
}

/// Returns the errors that prevented comparing paths and drawings, one per line.
pub(super) fn problems(comparison: &Comparison, lang: Lang) -> Vec<String> {
    let errors = comparison.problems.iter().flatten().filter(|problem| problem.is_error());
    let line = |problem: &Diagnostic| {
        let file = problem.file.as_deref().map(Utf8Path::as_str);
        let places: Vec<&str> = [file, problem.path.as_deref()].into_iter().flatten().collect();
        let text = problem.text(lang);
        match problem.help(lang) {
            Some(help) => format!("{}: {}: {text} ({help})", places.join(" · "), problem.code()),
            None => format!("{}: {}: {text}", places.join(" · "), problem.code()),
        }
    };
    errors.map(line).collect()
}

/// Returns a line for each kind of change, a warning if there are too many cuts to divide them, a line for each changed state of the machine,
/// and one for the totals.
pub(super) fn details(program: &ProgramDiff, lang: Lang) -> Vec<String> {
    let mut lines: Vec<String> = program.groups.iter().map(|group| line(group, lang)).collect();
    if program.has_undivided_moves && !lines.is_empty() {
        let undivided = lang.choose(
            "too many cuts end on each other to divide them: they are compared as a whole, so more may be listed than has changed",
            "zu viele Schnitte enden aufeinander, um sie zu teilen: sie werden als Ganzes verglichen, daher ist vielleicht mehr aufgeführt, als sich geändert hat",
        );
        lines.push(undivided.to_owned());
    }
    lines.extend(program.states.iter().map(|change| state_line(change, lang)));
    if program.is_unwritten {
        let unwritten = lang.choose(
            "tools, spindle and other lines of the program were not compared, because a program cannot be written",
            "Werkzeuge, Spindel und andere Zeilen des Programms wurden nicht verglichen, weil ein Programm nicht geschrieben werden kann",
        );
        lines.push(unwritten.to_owned());
    }
    if let [Some(old), Some(new)] = program.totals {
        lines.push(totals(&old, &new, lang));
    }
    lines
}

/// Maximum number of lines of an explanation. Further lines are only counted.
const MAX_REASON_LINES: usize = 24;

/// Returns the lines that explain the changes, each with its indentation level: an introduction, then the reasons. A reason may have
/// reasons of its own, which follow it one level deeper. Empty if the reasons were not determined.
fn explanation(program: &ProgramDiff, lang: Lang) -> Vec<(usize, String)> {
    let Some(reasons) = &program.reasons else { return Vec::new() };
    if reasons.is_empty() {
        let unexplained = lang.choose(
            "no change of the drawings or of pathbuild.toml explains this",
            "keine Änderung der Zeichnungen oder von pathbuild.toml erklärt das",
        );
        return vec![(0, unexplained.to_owned())];
    }
    let mut lines = vec![(0, lang.choose("explained by:", "Ursache:").to_owned())];
    let mut open: Vec<(usize, &Reason)> = reasons.iter().rev().map(|reason| (1, reason)).collect();
    while let Some((depth, reason)) = open.pop() {
        lines.push((depth, message(reason, lang)));
        open.extend(reason.reasons().iter().rev().map(|reason| (depth + 1, reason)));
    }
    let left_out = lines.len().saturating_sub(1 + MAX_REASON_LINES);
    if left_out > 0 {
        lines.truncate(1 + MAX_REASON_LINES);
        lines.push((1, format!("{} {left_out}", lang.choose("and further:", "und weitere:"))));
    }
    lines
}

fn message(reason: &Reason, lang: Lang) -> String {
    pathbuild_diagnostic::Value::from(reason.sentence()).render(lang)
}

fn line(group: &Group, lang: Lang) -> String {
    let first = lang.choose("the first to", "die erste nach");
    let at = group.at.map(|[x, y]| format!(", {first} X{} Y{}", Number(x), Number(y))).unwrap_or_default();
    format!("{}: {}, {} mm{at}", phrase(group, lang), moves(group, lang), tenths(group.length).prose(lang))
}

fn state_line(change: &StateChange, lang: Lang) -> String {
    let [was, is] = change.words.each_ref().map(|words| match words.as_str() {
        "" => lang.choose("none", "nichts"),
        words => words,
    });
    let name = change.kind.text().in_lang(lang);
    let line =
        change.line.map(|line| format!(" ({} {line})", lang.choose("line", "Zeile"))).unwrap_or_default();
    format!("{name}: {is} {} {was}{line}", lang.choose("instead of", "statt"))
}

fn totals(old: &Totals, new: &Totals, lang: Lang) -> String {
    let length = |totals: &Totals| tenths(totals.milling + totals.drilling).prose(lang);
    let minutes = match (old.minutes, new.minutes) {
        (Some(old), Some(new)) if (old - new).abs() > f64::EPSILON => {
            format!(", {} → {} min", Number(old).prose(lang), Number(new).prose(lang))
        }
        (_, Some(new)) => format!(", {} min", Number(new).prose(lang)),
        _ => String::new(),
    };
    format!("{}: {} → {} mm{minutes}", lang.choose("cutting", "Fräsweg"), length(old), length(new))
}

/// Formats a summary such as "2 of 35 paths changed, 1 new".
pub(super) fn summary(comparison: &Comparison, lang: Lang) -> String {
    let count =
        |is: fn(&PathChangeKind) -> bool| comparison.paths.iter().filter(|path| is(&path.outcome)).count();
    let changed = count(|outcome| matches!(outcome, PathChangeKind::Changed(_)));
    let paths = counted(comparison.path_count, [["path", "paths"], ["Pfad", "Pfaden"]], lang);
    let mut parts = vec![match lang {
        Lang::En => format!("{changed} of {paths} changed"),
        Lang::De => format!("{changed} von {paths} geändert"),
    }];
    let mut add = |number: usize, en: &str, de: &str| {
        if number > 0 {
            parts.push(format!("{number} {}", lang.choose(en, de)));
        }
    };
    add(count(|outcome| matches!(outcome, PathChangeKind::Added)), "new", "neu");
    add(count(|outcome| matches!(outcome, PathChangeKind::Removed)), "gone", "weg");
    add(count(|outcome| matches!(outcome, PathChangeKind::Broken)), "with errors now", "jetzt mit Fehlern");
    add(
        count(|outcome| matches!(outcome, PathChangeKind::Mended)),
        "without errors now",
        "jetzt ohne Fehler",
    );
    add(
        count(|outcome| matches!(outcome, PathChangeKind::StillBroken)),
        "with errors before and now",
        "vorher und jetzt mit Fehlern",
    );
    add(
        count(|outcome| matches!(outcome, PathChangeKind::OtherDrawing)),
        "from another drawing",
        "aus anderer Zeichnung",
    );
    parts.join(", ")
}

fn tenths(value: f64) -> Number {
    Number((value * 10.0).round() / 10.0)
}

/// Formats the comparison as Markdown: a table with one row per path.
pub(super) fn markdown(comparison: &Comparison, lang: Lang) -> String {
    let mut text = format!("**pathbuild**: {}\n", summary(comparison, lang));
    let problems = problems(comparison, lang);
    if !problems.is_empty() {
        text.push('\n');
    }
    for problem in problems {
        _ = writeln!(text, "- {}", code(&problem));
    }
    if !comparison.paths.is_empty() {
        write_path_table(&mut text, comparison, lang);
    }
    escaping::lines(&text).into_owned()
}

fn write_path_table(text: &mut String, comparison: &Comparison, lang: Lang) {
    let head = lang.choose("| path | drawing | moves |", "| Pfad | Zeichnung | Bewegungen |");
    _ = writeln!(text, "\n{head}\n| --- | --- | --- |");
    for path in &comparison.paths {
        let mut cell = outcome(path, comparison, lang).to_owned();
        if let PathChangeKind::Changed(program) = &path.outcome {
            let reasons = explanation(program, lang).into_iter();
            let reasons = reasons.map(|(depth, line)| format!("{}{line}", "– ".repeat(depth)));
            let lines = details(program, lang).into_iter().chain(reasons);
            cell = lines.map(|line| escaped_markdown(&line)).collect::<Vec<_>>().join("<br>");
        }
        _ = writeln!(text, "| {} | {} | {cell} |", cell_of(&path.name), cell_of(&place(path)));
    }
}

/// Replaces every character that could be markup or begin a mention by a character reference.
fn escaped_markdown(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in escaping::line(text).chars() {
        let is_plain =
            character.is_alphanumeric() || matches!(character, ' ' | '.' | ',' | '/' | '-' | '(' | ')' | '→');
        if is_plain {
            escaped.push(character);
        } else {
            _ = write!(escaped, "&#{};", u32::from(character));
        }
    }
    escaped
}

/// Formats a name as code within a table cell.
fn cell_of(name: &str) -> String {
    code(name).replace('|', "\\|")
}

/// Formats a text as code, because GitHub turns addresses, numbers and hashes in ordinary text into links, even if they are escaped.
fn code(text: &str) -> String {
    let text = escaping::line(text);
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let ticks = "`".repeat(longest + 1);
    // Markdown removes the blanks next to the backticks.
    format!("{ticks} {text} {ticks}")
}

/// Prints a JSON row for each changed path, and one for the whole comparison.
pub(super) fn rows(context: &Context, comparison: &Comparison) {
    for changed in &comparison.paths {
        context.row("path_change", path_json(changed, context.lang()));
    }
    context.row("comparison", json!({ "paths": comparison.path_count, "changed": comparison.paths.len() }));
}

fn path_json(path: &PathDiff, lang: Lang) -> Value {
    let outcome = match &path.outcome {
        PathChangeKind::Added => "added",
        PathChangeKind::Removed => "removed",
        PathChangeKind::Broken => "broken",
        PathChangeKind::Mended => "mended",
        PathChangeKind::StillBroken => "still-broken",
        PathChangeKind::OtherDrawing => "other-drawing",
        PathChangeKind::Changed(_) => "changed",
    };
    let [old, new] = path.files.each_ref().map(|file| file.as_deref().map(Utf8Path::as_str));
    let mut value = json!({ "path": path.name, "old_file": old, "new_file": new, "outcome": outcome });
    if let PathChangeKind::Changed(program) = &path.outcome {
        value["changes"] = program.groups.iter().map(group_json).collect();
        if program.has_undivided_moves {
            value["has_undivided_moves"] = json!(true);
        }
        if program.is_unwritten {
            value["is_unwritten"] = json!(true);
        }
        if !program.states.is_empty() {
            value["states"] = program.states.iter().map(state_json).collect();
        }
        value["old"] = json!(program.totals[0]);
        value["new"] = json!(program.totals[1]);
        if let Some(reasons) = &program.reasons {
            value["explained_by"] = reasons.iter().map(|reason| reason_json(reason, lang)).collect();
        }
    }
    value
}

fn reason_json(reason: &Reason, lang: Lang) -> Value {
    let mut value = json!({ "message": message(reason, lang) });
    let kind = match reason {
        Reason::Drawn(DrawnChange { kind, change, count, at, end }) => {
            value["element"] = kind.name().into();
            value["count"] = json!(count);
            value["at"] = json!([at.x.0, at.y.0].map(thousandths));
            if let Some(end) = end {
                value["end"] = json!([end.x.0, end.y.0].map(thousandths));
            }
            match change {
                ElementChange::Moved(by) | ElementChange::EndMoved(by) => {
                    value["by"] = json!(by.map(thousandths));
                }
                ElementChange::Diameter(values) | ElementChange::Radius(values) => {
                    set_values(&mut value, values.map(thousandths));
                }
                ElementChange::LineType(names) => set_values(&mut value, *names),
                ElementChange::Text(texts) => set_values(&mut value, texts.each_ref()),
                ElementChange::Added | ElementChange::Removed | ElementChange::Reshaped => {}
            }
            change.name()
        }
        Reason::Reordered => "reordered",
        Reason::Variable(change) => {
            value["name"] = json!(change.name);
            set_values(&mut value, [&change.was, &change.now]);
            "variable"
        }
        Reason::Setting(change) => {
            value["name"] = json!(change.name);
            set_values(&mut value, [&change.was, &change.now]);
            "setting"
        }
        Reason::Embedded { path, reasons } => {
            value["path"] = json!(path);
            value["explained_by"] = reasons.iter().map(|inner| reason_json(inner, lang)).collect();
            "embedded"
        }
    };
    value["kind"] = kind.into();
    value
}

fn state_json(change: &StateChange) -> Value {
    let mut value = json!({ "kind": change.kind, "line": change.line });
    set_values(&mut value, change.words.each_ref());
    value
}

fn set_values(value: &mut Value, [was, now]: [impl Serialize; 2]) {
    value["was"] = json!(was);
    value["now"] = json!(now);
}

fn group_json(group: &Group) -> Value {
    let mut value =
        json!({ "moves": group.moves, "length": thousandths(group.length), "first_to": group.at });
    let kind = match group.kind {
        None => "rapids",
        Some(ChangeKind::Added) => "added",
        Some(ChangeKind::Removed) => "removed",
        Some(ChangeKind::Reordered) => "reordered",
        Some(ChangeKind::Shifted(by)) => {
            value["by"] = json!(by.map(thousandths));
            "shifted"
        }
        Some(ChangeKind::Altered { raised, feed, passes }) => {
            let [least, most] = raised;
            // The largest change of height, up or down.
            value["raised"] = json!(if -least > most { least } else { most });
            if least != most {
                value["raised_between"] = json!(raised);
            }
            value["feed"] = json!(feed);
            value["passes"] = json!(passes);
            "altered"
        }
    };
    value["kind"] = kind.into();
    value
}

fn thousandths(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

const TEMPLATE: &str = include_str!("page.html");

/// Renders the comparison as an HTML page.
pub(super) fn page(comparison: &Comparison, lang: Lang) -> String {
    let (before, behind) = TEMPLATE.split_once("{{paths}}").unwrap_or((TEMPLATE, ""));
    let code = lang.choose("en", "de");
    let title = format!("pathbuild diff: {}", summary(comparison, lang));
    let mut page = before.replace("{{lang}}", code).replace("{{title}}", &escaped(&title));
    for problem in problems(comparison, lang) {
        _ = writeln!(page, "<p>{}</p>", escaped(&problem));
    }
    for path in &comparison.paths {
        add_section(&mut page, path, comparison, lang);
    }
    page.push_str(behind);
    page
}

fn add_section(page: &mut String, path: &PathDiff, comparison: &Comparison, lang: Lang) {
    _ = writeln!(
        page,
        "<section>\n<h2>{} <small>{}</small></h2>\n<p>{}</p>",
        escaped(&path.name),
        escaped(&place(path)),
        outcome(path, comparison, lang)
    );
    if let PathChangeKind::Changed(program) = &path.outcome {
        page.push_str("<ul>\n");
        for line in details(program, lang) {
            _ = writeln!(page, "<li>{}</li>", escaped(&line));
        }
        page.push_str("</ul>\n");
        add_reasons(page, program, lang);
        if let Some(pictures) = &program.pictures {
            add_pictures(page, pictures, lang);
        }
    }
    page.push_str("</section>\n");
}

/// Adds nested lists of the reasons that explain the changes.
fn add_reasons(page: &mut String, program: &ProgramDiff, lang: Lang) {
    let mut open = 0;
    for (depth, line) in explanation(program, lang) {
        let line = escaped(&line);
        if depth == 0 {
            _ = writeln!(page, "<p>{line}</p>");
            continue;
        }
        // Levels increase one by one. A nested list belongs to the item before it.
        if depth > open {
            page.push_str("<ul>\n");
        } else {
            _ = writeln!(page, "</li>{}", "</ul></li>".repeat(open - depth));
        }
        _ = write!(page, "<li>{line}");
        open = depth;
    }
    _ = writeln!(page, "{}", "</li></ul>".repeat(open));
}

/// Adds the pictures of a change: the changes, the old and the new moves, and the stock if it changes. Without scripts, only the changes
/// are visible.
fn add_pictures(page: &mut String, PictureSet { changes, old, new, stock }: &PictureSet, lang: Lang) {
    let button = |way: &str, en, de| format!("<button data-way=\"{way}\">{}</button>", lang.choose(en, de));
    let label = lang.choose("old to new", "alt bis neu");
    _ = writeln!(
        page,
        "<div class=\"pictures\" data-way=\"changes\">\n<nav>{}{}{}{}</nav>\n<div class=\"changes\">{changes}</div>\n\
         <div class=\"beside\"><div>{old}</div><div>{new}</div></div>\n\
         <div class=\"over\"><input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"{label}\">\
         <div class=\"stack\"><div>{old}</div><div class=\"new\">{new}</div></div></div>\n\
         <div class=\"stock\">{}</div>\n</div>",
        button("changes", "changes", "Änderungen"),
        button("beside", "side by side", "nebeneinander"),
        button("over", "overlaid", "übereinander"),
        if stock.is_empty() { String::new() } else { button("stock", "stock", "Rohteil") },
        if stock.is_empty() { String::new() } else { format!("<div>{}</div>", stock.join("</div><div>")) },
    );
}
