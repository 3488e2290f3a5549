//! Renders diagnostics as text, with one module per format. Callers select the diagnostics to show. (book: reference/commands)

mod concise;
mod full;
mod github;
mod gitlab;
mod html;
pub(crate) mod json;
mod junit;
mod pictures;
mod sarif;
mod view;

use clap::ValueEnum;
use pathbuild_diagnostic::escaping;
use pathbuild_workspace::findings::Findings;

pub(crate) use html::page;
pub(crate) use pictures::{WrittenPictures, pictures, write as write_pictures};
pub use view::View;

/// The text of rendered findings. Only this module and its renderers create it. It contains no control sequences except pathbuild's own
/// colours, so that it is safe to print.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RenderedText(String);

impl RenderedText {
    /// Returns the text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// The format of diagnostics or graphs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Format {
    /// With the faulty text underlined, help and notes
    #[default]
    Full,
    /// One line each
    Concise,
    /// One JSON object per line
    Json,
    /// SARIF 2.1.0
    Sarif,
    /// Annotations of a GitHub workflow
    Github,
    /// GitLab Code Quality report
    Gitlab,
    /// `JUnit` XML, a test case for each path or program
    Junit,
    /// A page with pictures: for `--report` only
    #[value(hide = true)]
    Html,
    /// A graph for Graphviz
    #[value(hide = true)]
    Dot,
    /// A graph for Mermaid
    #[value(hide = true)]
    Mermaid,
}

impl Format {
    /// Whether the format shows diagnostics. The other formats show graphs.
    pub fn shows_diagnostics(self) -> bool {
        !matches!(self, Self::Dot | Self::Mermaid)
    }

    /// Whether the format is machine-readable, so that findings are written as the result of the run.
    pub fn is_for_machines(self) -> bool {
        self == Self::Json || self.is_report()
    }

    /// Whether the format contains only findings, but not other results of commands.
    pub fn is_report(self) -> bool {
        matches!(self, Self::Sarif | Self::Github | Self::Gitlab | Self::Junit)
    }

    /// Whether the format can only be written when all findings are known.
    pub fn needs_all_findings(self) -> bool {
        matches!(self, Self::Sarif | Self::Gitlab | Self::Junit)
    }
}

/// Renders findings in a format. [`Format::Full`] is used for formats of graphs, which show no diagnostics, and for HTML, which needs
/// pictures (see `page`).
pub fn render(format: Format, findings: &Findings, view: &View) -> RenderedText {
    let text = match format {
        Format::Concise => escaping::lines(&concise::render(findings, view)).into_owned(),
        Format::Json => escaping::json(&json::render(findings, view)).into_owned(),
        Format::Sarif => escaping::json(&sarif::render(findings, view)).into_owned(),
        // This format consists of lines that begin with `::`. Its renderer escapes that beginning in all other lines.
        Format::Github => escaping::framed(&github::render(findings, view)).into_owned(),
        Format::Gitlab => escaping::json(&gitlab::render(findings, view)).into_owned(),
        Format::Junit => escaping::lines(&junit::render(findings, view)).into_owned(),
        Format::Full | Format::Html | Format::Dot | Format::Mermaid if view.color => {
            escaping::colored_lines(&full::render(findings, view)).into_owned()
        }
        Format::Full | Format::Html | Format::Dot | Format::Mermaid => {
            escaping::lines(&full::render(findings, view)).into_owned()
        }
    };
    RenderedText(text)
}
