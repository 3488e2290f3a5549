//! Renders diagnostics as text, with one module per format. The selection of what is shown is made elsewhere. (book: reference/commands)

mod concise;
mod full;
mod github;
mod gitlab;
mod html;
pub(crate) mod json;
mod junit;
mod sarif;
mod view;

use pathbuild_diagnostic::shown;

use crate::args::Format;
use crate::report::Findings;

pub(crate) use html::page;
pub use view::View;

/// Rendered findings. Only [`render`] creates them; they contain no control sequences except our own colours, so that they are safe to
/// print.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RenderedText(String);

impl RenderedText {
    /// The text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// Renders findings in a format. Graph formats show no diagnostics, and an HTML page needs pictures (see `page`): both fall back to
/// [`Format::Full`].
pub fn render(format: Format, findings: &Findings, view: &View) -> RenderedText {
    let text = match format {
        Format::Concise => shown::lines(&concise::render(findings, view)).into_owned(),
        Format::Json => shown::json(&json::render(findings, view)).into_owned(),
        Format::Sarif => shown::json(&sarif::render(findings, view)).into_owned(),
        // This format consists of lines beginning with `::`, and escapes all other such lines itself.
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
    RenderedText(text)
}
