//! The two definition languages as tables, which the book includes. (book: reference/post-definitions)

use pathbuild_diagnostic::Lang;

use super::{cad6, cambam};

/// Cells of a row, in Markdown.
pub type Row = Vec<String>;

/// The rows of a table of the book, or `None` if there is no such table.
pub fn reference_table(name: &str, lang: Lang) -> Option<Vec<Row>> {
    Some(match name {
        "post-keys" => cad6::reference::settings(lang),
        "control-texts" => cad6::reference::texts(lang),
        "control-variables" => cad6::reference::variables(lang),
        "control-statements" => cad6::reference::statements(lang),
        "control-operators" => cad6::reference::operators(),
        "control-functions" => cad6::reference::functions(lang),
        "cambam-sections" => cambam::reference::sections(lang),
        "cambam-options" => cambam::reference::options(lang),
        "cambam-macros" => cambam::reference::macros(lang),
        "cambam-calls" => cambam::reference::macros_with_arguments(lang),
        _ => return None,
    })
}

/// Formats a text as code. Line breaks are shown as `\n`.
pub(crate) fn code(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("`{}`", text.replace('\n', "\\n")) }
}
