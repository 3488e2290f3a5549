//! Renders diagnostics as text, with one module per format. The selection of what is shown is made elsewhere. (book: reference/commands)

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
use pathbuild_diagnostic::shown;
use pathbuild_workspace::findings::Findings;

pub(crate) use html::page;
pub(crate) use pictures::{pictures, write as write_pictures};
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

/// How something is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Format {
    /// With the faulty text underlined, help and notes
    #[default]
    Full,
    /// One line each
    Concise,
    /// One JSON object a line
    Json,
    /// SARIF 2.1.0
    Sarif,
    /// Annotations of a GitHub workflow
    Github,
    /// GitLab code quality
    Gitlab,
    /// `JUnit` XML, a test case for each path
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
    /// Whether the format shows diagnostics; the others show graphs.
    pub fn shows_diagnostics(self) -> bool {
        !matches!(self, Self::Dot | Self::Mermaid)
    }

    /// Whether the format is machine-readable, so that it is the result of a run.
    pub fn is_for_machines(self) -> bool {
        self == Self::Json || self.is_report()
    }

    /// Whether the format contains only findings.
    pub fn is_report(self) -> bool {
        matches!(self, Self::Sarif | Self::Github | Self::Gitlab | Self::Junit)
    }

    /// Whether the format can only be written once all findings are known.
    pub fn is_whole(self) -> bool {
        matches!(self, Self::Sarif | Self::Gitlab | Self::Junit)
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
