//! Annotations of a GitHub workflow: `::error file=...,line=...::message`.
//!
//! GitHub shows only ten errors and ten warnings per step, so further ones are written as plain log lines. Errors come first.

use pathbuild_diagnostic::{Diagnostic, Severity, escaping};

use super::{View, concise, view};
use pathbuild_workspace::findings::Findings;

/// Number of annotations per severity that GitHub shows for a step.
const MAX_ANNOTATIONS: usize = 10;

pub(super) fn render(findings: &Findings, view: &View) -> String {
    let of_severity =
        |severity| findings.diagnostics.iter().filter(move |diagnostic| diagnostic.severity == severity);
    let annotations = [Severity::Error, Severity::Warning]
        .into_iter()
        .flat_map(|severity| of_severity(severity).take(MAX_ANNOTATIONS));
    let lines = [Severity::Error, Severity::Warning]
        .into_iter()
        .flat_map(|severity| of_severity(severity).skip(MAX_ANNOTATIONS));
    let annotations = annotations.map(|diagnostic| annotation(diagnostic, view));
    let lines = lines.map(|diagnostic| escaping::lines(&concise::line(diagnostic, view)).into_owned());
    annotations.chain(lines).collect()
}

fn annotation(diagnostic: &Diagnostic, view: &View) -> String {
    let command = diagnostic.severity.name();
    let mut properties = Vec::new();
    if let Some(file) = view.file(diagnostic) {
        properties.push(format!("file={}", escape_property(&file)));
        properties.push(format!("line={}", diagnostic.place.line.unwrap_or(1)));
        properties.extend(diagnostic.place.column.map(|column| format!("col={column}")));
    }
    properties.push(format!(
        "title={}",
        escape_property(&format!("{} {}", diagnostic.code(), diagnostic.code().name()))
    ));
    format!("::{command} {}::{}\n", properties.join(","), escape_data(&view::message(diagnostic, view)))
}

/// Escapes the text after the second `::`.
fn escape_data(text: &str) -> String {
    escaping::lines(text).replace('%', "%25").replace('\n', "%0A")
}

/// Escapes the value of a property.
fn escape_property(text: &str) -> String {
    escape_data(text).replace(':', "%3A").replace(',', "%2C")
}
