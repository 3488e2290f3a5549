//! Formats numbers and tables for users, by the conventions of their language.

use comfy_table::{Cell, CellAlignment, Table};
use pathbuild_diagnostic::{Lang, escaping, with_decimal_separator};
pub(crate) use pathbuild_diagnostic::{Noun, counted, format_count};

pub(crate) const PATH: Noun = [["path", "paths"], ["Pfad", "Pfade"]];
pub(crate) const DRAWING: Noun = [["drawing", "drawings"], ["Zeichnung", "Zeichnungen"]];
pub(crate) const MOVE: Noun = [["move", "moves"], ["Bewegung", "Bewegungen"]];
pub(crate) const ERROR: Noun = [["error", "errors"], ["Fehler", "Fehler"]];
pub(crate) const WARNING: Noun = [["warning", "warnings"], ["Warnung", "Warnungen"]];

/// Formats a number with up to `places` decimals and without trailing zeros: `12.5`, in German `12,5`.
pub(crate) fn decimal(number: f64, places: usize, lang: Lang) -> String {
    let text = format!("{number:.places$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    // A small negative number is rounded to -0.
    let text = if text == "-0" { "0" } else { text };
    with_decimal_separator(text.to_owned(), lang)
}

/// The heading of a column, and whether the column contains numbers, which are aligned to the right.
pub(crate) type Column<'a> = (&'a str, bool);

/// Formats a table with headings: one line per row, columns separated by two blanks, without trailing blanks. Names are escaped.
pub(crate) fn table(columns: &[Column<'_>], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let aligned = |(text, (_, is_number)): (&str, &Column<'_>)| {
        let alignment = if *is_number { CellAlignment::Right } else { CellAlignment::Left };
        Cell::new(escaping::line(text)).set_alignment(alignment)
    };
    let mut table = Table::new();
    table.load_style(comfy_table::presets::NOTHING);
    table.set_header(columns.iter().map(|column| aligned((column.0, column))));
    for row in rows {
        table.add_row(row.iter().map(String::as_str).zip(columns).map(aligned));
    }
    for column in table.column_iter_mut() {
        column.set_padding((0, 2));
    }
    table.lines().map(|line| line.trim_end().to_owned() + "\n").collect()
}
