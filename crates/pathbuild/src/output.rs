//! The machine-readable output of a run: one document, on stdout unless the command needs stdout itself, and reports in files.

use std::cell::RefCell;
use std::collections::BTreeSet;

use camino::{Utf8Path, Utf8PathBuf};
use serde_json::{Map, Value, json};

use pathbuild_workspace::Workspace;
use pathbuild_workspace::config::clean;
use pathbuild_workspace::findings::Findings;

use crate::args::{Command, CommonArgs, ReportFile};
use crate::printer::Stream;
use crate::render::{Format, RenderedText, View, json as lines, page, pictures, render};

/// The machine-readable document of a run. Collects everything that is written when the run ends.
#[derive(Debug)]
pub(crate) struct Output {
    pub(crate) command: &'static str,
    pub(crate) format: Format,
    /// Stream on which machine-readable formats are written.
    pub(crate) stream: Stream,
    pub(crate) reports: Vec<ReportFile>,
    /// Whether the command has a machine-readable document.
    has_document: bool,
    found: RefCell<Findings>,
    figures: RefCell<Map<String, Value>>,
    /// Results for JSON reports, one per line.
    rows: RefCell<String>,
}

impl Output {
    pub(crate) fn new(command: &Command, common: &CommonArgs) -> Self {
        Self {
            command: command.name(),
            format: common.format.unwrap_or_default(),
            stream: if command.owns_stdout() { Stream::Stderr } else { Stream::Stdout },
            reports: common.report.clone(),
            has_document: command.has_document(),
            found: RefCell::default(),
            figures: RefCell::default(),
            rows: RefCell::default(),
        }
    }

    /// Returns the reason why the options are invalid; `None` if they are valid.
    pub(crate) fn refusal(&self, workspace: &Workspace) -> Option<String> {
        let on_stdout = self.reports.iter().filter(|report| report.is_stdout()).count();
        let taken = usize::from(self.format.is_for_machines() || self.stream == Stream::Stderr);
        let is_json = self.format == Format::Json && self.command != "config";
        if !self.has_document && (!self.reports.is_empty() || self.format.is_report() || is_json) {
            return Some(workspace.phrase(
                "`{}` has no findings to report",
                "`{}` hat keine Befunde für einen Bericht",
                self.command,
            ));
        }
        if on_stdout > 0 && on_stdout + taken > 1 {
            let reason = workspace.choose(
                "standard output can hold only one document: write the other report to a file",
                "die Standardausgabe fasst nur ein Dokument: für den anderen Bericht eine Datei angeben",
            );
            return Some(reason.to_owned());
        }
        if let Some(file) = self.file_of_two_reports(&workspace.working_directory) {
            return Some(workspace.phrase(
                "two reports would be written to {}: give each a file of its own",
                "zwei Berichte würden nach {} geschrieben: jedem eine eigene Datei geben",
                file.as_str(),
            ));
        }
        (self.command == "watch" && (self.format.needs_all_findings() || !self.reports.is_empty())).then(
            || {
                let reason = workspace.choose(
                "`watch` supports only the formats full, concise, json and github, because it never ends",
                "`watch` endet nie und kann Befunde deshalb nur als full, concise, json oder github zeigen",
            );
                reason.to_owned()
            },
        )
    }

    /// Returns a file that two reports would be written to.
    fn file_of_two_reports(&self, working_directory: &Utf8Path) -> Option<Utf8PathBuf> {
        let mut files = BTreeSet::new();
        let named = self.reports.iter().filter(|report| !report.is_stdout());
        named
            .map(|report| clean(&working_directory.join(&report.file)))
            .find(|file| !files.insert(file.clone()))
    }

    /// Whether the document or a report is written to stdout, so that results for users go to stderr.
    pub(crate) fn takes_stdout(&self) -> bool {
        let reports = self.reports.iter().any(ReportFile::is_stdout);
        self.has_document && self.stream == Stream::Stdout && (reports || self.format.is_for_machines())
    }

    /// Returns the first line of a JSON document; `None` if the run has none.
    pub(crate) fn header(&self) -> Option<String> {
        (self.has_document && self.format == Format::Json).then(|| lines::header(self.command))
    }

    /// Collects findings. Returns the text to show now and its stream; `None` if the format is only written at the end.
    pub(crate) fn collect_findings(
        &self,
        findings: &Findings,
        view: impl FnOnce(Stream) -> View,
    ) -> Option<(Stream, RenderedText)> {
        if !self.reports.is_empty() || self.format.needs_all_findings() || self.format == Format::Json {
            let mut found = self.found.borrow_mut();
            found.diagnostics.extend(findings.diagnostics.iter().cloned());
            found.checked.extend(findings.checked.iter().cloned());
            found.programs.extend(findings.programs.iter().cloned());
            found.waived.extend(findings.waived.iter().cloned());
        }
        if self.format.needs_all_findings() {
            return None;
        }
        let stream = if self.format.is_for_machines() { self.stream } else { Stream::Stderr };
        Some((stream, render(self.format, findings, &view(stream))))
    }

    /// Adds a value to the last line of the JSON document.
    pub(crate) fn add_figure(&self, name: &str, value: impl Into<Value>) {
        self.figures.borrow_mut().insert(name.to_owned(), value.into());
    }

    /// Whether the run writes a JSON document or report.
    pub(crate) fn writes_json(&self) -> bool {
        self.format == Format::Json || self.has_json_report()
    }

    fn has_json_report(&self) -> bool {
        self.reports.iter().any(|report| report.format == Format::Json)
    }

    /// Keeps a line with a result for the JSON reports.
    pub(crate) fn keep_row(&self, line: &str) {
        if self.has_json_report() {
            self.rows.borrow_mut().extend([line, "\n"]);
        }
    }

    /// Returns the rest of the document, which is printed at the end.
    pub(crate) fn end(&self, status: u8, view: &View) -> Option<RenderedText> {
        match self.format {
            _ if !self.has_document => None,
            Format::Json => Some(lines::escaped_lines(&self.summary(status))),
            format if format.needs_all_findings() => Some(self.whole_report(format, status, view)),
            _ => None,
        }
    }

    /// Returns the findings as an HTML report.
    pub(crate) fn page(&self, workspace: &Workspace, view: &View) -> RenderedText {
        let found = self.found.borrow();
        page(&found, &pictures(workspace, &found.diagnostics), view)
    }

    /// Returns the findings as a report in a format other than HTML.
    pub(crate) fn whole_report(&self, format: Format, status: u8, view: &View) -> RenderedText {
        let found = self.found.borrow();
        let rendered = render(format, &found, view);
        if format != Format::Json {
            return rendered;
        }
        lines::escaped_lines(&format!(
            "{}\n{}{}{}",
            lines::header(self.command),
            self.rows.borrow(),
            rendered.as_str(),
            self.summary(status)
        ))
    }

    fn summary(&self, status: u8) -> String {
        let found = self.found.borrow();
        let mut summary = json!({
            "errors": found.error_count(),
            "warnings": found.warning_count(),
            "exit_status": status,
        });
        if let Value::Object(object) = &mut summary {
            object.extend(self.figures.borrow().clone());
        }
        lines::serialize_with_type("summary", &summary) + "\n"
    }
}
