//! Diagnostics as text: one file for each format, none of which decides what is shown. (spec/05-command-line.md)

mod concise;
mod full;
mod json;
mod place;
mod view;

use crate::args::Format;
use crate::report::Findings;

pub use view::View;

/// The findings in a format. A format of graphs shows no diagnostics and falls back on [`Format::Full`].
pub fn render(format: Format, findings: &Findings, view: &View) -> String {
    match format {
        Format::Concise => concise::render(findings, view),
        Format::Json => json::render(findings, view),
        _ => full::render(findings, view),
    }
}
