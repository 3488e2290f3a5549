//! Renders findings as a GitLab Code Quality report: a JSON list. GitLab requires a location, so a diagnostic without a file, such as one about
//! an option's value, refers to the project itself (`.`).

use pathbuild_diagnostic::{Diagnostic, Severity};
use serde_json::{Value as Json, json};

use super::{View, view};
use pathbuild_workspace::findings::{Findings, Fingerprint};

pub(super) fn render(findings: &Findings, view: &View) -> String {
    let fingerprints = Fingerprint::of(&findings.diagnostics);
    let issues = findings
        .diagnostics
        .iter()
        .zip(fingerprints)
        .map(|(diagnostic, fingerprint)| issue(diagnostic, fingerprint, view));
    format!("{:#}\n", issues.collect::<Json>())
}

fn issue(diagnostic: &Diagnostic, fingerprint: Fingerprint, view: &View) -> Json {
    let element = view::element(diagnostic, view);
    let element = if element.is_empty() { element } else { format!(" ({element})") };
    let help = view.help(diagnostic).unwrap_or_default();
    json!({
        "content": { "body": help },
        "description": format!("{}: {}{element}", diagnostic.code(), diagnostic.text(view.lang)),
        "check_name": diagnostic.code().name(),
        "fingerprint": fingerprint.to_string(),
        "severity": match diagnostic.severity {
            Severity::Error => "major",
            Severity::Warning => "minor",
        },
        "location": {
            "path": view.raw_file(diagnostic).map_or_else(|| ".".to_owned(), Into::into),
            "lines": { "begin": diagnostic.place.line.unwrap_or(1) },
        },
    })
}
