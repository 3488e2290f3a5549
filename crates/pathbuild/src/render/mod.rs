//! Diagnostics as text: one file for each format, none of which decides what is shown. (book: reference/commands)

mod concise;
mod full;
mod github;
mod gitlab;
mod html;
pub(crate) mod json;
mod junit;
mod place;
mod sarif;
mod view;

use pathbuild_diagnostic::shown;

use crate::args::Format;
use crate::report::Findings;

pub(crate) use html::page;
pub use view::View;

/// Findings as text that may be printed: only [`render`] makes it, and nothing in it acts on who shows it but colours of ours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rendered(String);

impl Rendered {
    /// The text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// The findings in a format. A format of graphs shows no diagnostics, a page needs pictures (the module `page`): they fall back on [`Format::Full`].
pub fn render(format: Format, findings: &Findings, view: &View) -> Rendered {
    let text = match format {
        Format::Concise => shown::lines(&concise::render(findings, view)).into_owned(),
        Format::Json => shown::json(&json::render(findings, view)).into_owned(),
        Format::Sarif => shown::json(&sarif::render(findings, view)).into_owned(),
        // Lines that begin with `::` are what it is made of; it keeps all others harmless itself.
        Format::Github => shown::framed(&github::render(findings, view)).into_owned(),
        Format::Gitlab => shown::json(&gitlab::render(findings, view)).into_owned(),
        Format::Junit => shown::lines(&junit::render(findings, view)).into_owned(),
        Format::Full | Format::Html | Format::Dot | Format::Mermaid if view.color => {
            shown::colored_lines(&full::render(findings, view)).into_owned()
        }
        Format::Full | Format::Html | Format::Dot | Format::Mermaid => {
            shown::lines(&full::render(findings, view)).into_owned()
        }
    };
    Rendered(text)
}
