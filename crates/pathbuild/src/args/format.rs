//! The formats of diagnostics and of graphs, which share one option.

use camino::Utf8PathBuf;
use clap::ValueEnum;

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

/// A report to write besides the printed output: `FORMAT=FILE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReportFile {
    /// Format of the report.
    pub format: Format,
    /// File to write.
    pub file: Utf8PathBuf,
}

impl ReportFile {
    /// Whether it goes to standard output: `FORMAT=-`.
    pub fn is_stdout(&self) -> bool {
        self.file == "-"
    }

    /// Parses `FORMAT=FILE`.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let (format, file) = text.split_once('=').ok_or("expected FORMAT=FILE")?;
        let format = Format::from_str(format, false).ok().filter(|format| format.shows_diagnostics());
        let format =
            format.ok_or("the format is full, concise, json, sarif, github, gitlab, junit or html")?;
        if file.is_empty() {
            return Err("the name of the file is missing".to_owned());
        }
        Ok(Self { format, file: file.into() })
    }
}
