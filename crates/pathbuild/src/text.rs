//! Formats numbers and tables for users, by the conventions of their language.

use comfy_table::{Cell, CellAlignment, Table};
use pathbuild_diagnostic::{Lang, shown, with_decimal_separator};

/// Formats a count with thousands separators: `2,014`, in German `2.014`.
pub(crate) fn count(number: usize, lang: Lang) -> String {
    let separator = match lang {
        Lang::En => ',',
        Lang::De => '.',
    };
    let digits = number.to_string();
    let mut grouped = String::with_capacity(digits.len() + digits.len() / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            grouped.push(separator);
        }
        grouped.push(digit);
    }
    grouped
}

/// A noun in English and German, each in singular and plural.
pub(crate) type Noun = [[&'static str; 2]; 2];

pub(crate) const PATH: Noun = [["path", "paths"], ["Pfad", "Pfade"]];
pub(crate) const DRAWING: Noun = [["drawing", "drawings"], ["Zeichnung", "Zeichnungen"]];
pub(crate) const ERROR: Noun = [["error", "errors"], ["Fehler", "Fehler"]];
pub(crate) const WARNING: Noun = [["warning", "warnings"], ["Warnung", "Warnungen"]];

/// Formats a count with its noun: `1 path`, `2,014 paths`.
pub(crate) fn counted(number: usize, [en, de]: Noun, lang: Lang) -> String {
    let [one, many] = lang.choose(en, de);
    format!("{} {}", count(number, lang), if number == 1 { one } else { many })
}

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
        Cell::new(shown::line(text)).set_alignment(alignment)
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
