//! A comparison as Markdown for pull requests. Names come from drawings, so all markup in them is escaped.

use std::fmt::Write;

use pathbuild_diagnostic::{Lang, shown};
use pathbuild_workspace::diff::{Comparison, Outcome};

use super::text::{details, outcome, place, problems, summary};

/// A table with one row per path.
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
        table(&mut text, comparison, lang);
    }
    shown::lines(&text).into_owned()
}

fn table(text: &mut String, comparison: &Comparison, lang: Lang) {
    let head = lang.choose("| path | drawing | moves |", "| Pfad | Zeichnung | Bewegungen |");
    _ = writeln!(text, "\n{head}\n| --- | --- | --- |");
    for path in &comparison.paths {
        let mut cell = outcome(path, comparison, lang).to_owned();
        if let Outcome::Changed(program) = &path.outcome {
            cell = details(program, lang).iter().map(|line| escaped(line)).collect::<Vec<_>>().join("<br>");
        }
        _ = writeln!(text, "| {} | {} | {cell} |", cell_of(&path.name), cell_of(&place(path)));
    }
}

/// Escapes everything that could be markup or a mention as character references.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in shown::line(text).chars() {
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

/// Formats a name as code in a table cell.
fn cell_of(name: &str) -> String {
    code(name).replace('|', "\\|")
}

/// Formats a text as code, since GitHub turns addresses, numbers and hashes in ordinary text into links, however they are escaped.
fn code(text: &str) -> String {
    let text = shown::line(text);
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let ticks = "`".repeat(longest + 1);
    // Markdown strips the blanks next to the backticks.
    format!("{ticks} {text} {ticks}")
}
