//! Tables for users: one line per row, columns separated by two blanks, numbers aligned to the right.

use comfy_table::{Cell, CellAlignment, Table};
use pathbuild_diagnostic::shown;

/// A column's heading, and whether the column holds numbers.
pub(crate) type Column<'a> = (&'a str, bool);

/// Formats a table with headings, without trailing blanks. Names are escaped.
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
