//! Renders findings as SARIF 2.1.0, for GitHub code scanning and other tools. File names are relative to the source root, the path is a
//! logical location, and the point and the handle are properties.

use std::collections::BTreeSet;

use pathbuild_diagnostic::{Code, Diagnostic};
use serde_json::{Value as Json, json};

use super::{View, view};
use pathbuild_workspace::files::FILE_NAME;
use pathbuild_workspace::findings::{Findings, Fingerprint};
use pathbuild_workspace::waivers::Waiver;

/// Maximum number of results. GitHub refuses runs with more.
const MAX_RESULTS: usize = 25_000;

pub(super) fn render(findings: &Findings, view: &View) -> String {
    let mut results = reported_findings(findings);
    results.extend(accepted_findings(findings));
    let rules: BTreeSet<Code> = results.iter().map(|result| result.diagnostic.code()).collect();
    let rules: Vec<Code> = rules.into_iter().collect();
    let left_out = results.len().saturating_sub(MAX_RESULTS);
    if left_out > 0 {
        results.sort_by_key(|result| (result.waiver.is_some(), result.diagnostic.severity));
        results.truncate(MAX_RESULTS);
    }
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "pathbuild",
                "version": env!("CARGO_PKG_VERSION"),
                "informationUri": env!("CARGO_PKG_REPOSITORY"),
                "rules": rules.iter().map(|code| rule(*code, view)).collect::<Vec<_>>(),
            } },
            "automationDetails": { "id": "pathbuild/" },
            "columnKind": "unicodeCodePoints",
            "invocations": [invocation(findings, left_out, view)],
            "results": results.iter().map(|shown| result(shown, &rules, view)).collect::<Vec<_>>(),
        }],
    });
    format!("{log:#}\n")
}

/// A finding to be shown. An accepted one has a waiver.
struct ShownFinding<'a> {
    diagnostic: &'a Diagnostic,
    fingerprint: Fingerprint,
    waiver: Option<&'a Waiver>,
}

fn reported_findings(findings: &Findings) -> Vec<ShownFinding<'_>> {
    let shown = |(diagnostic, fingerprint)| ShownFinding { diagnostic, fingerprint, waiver: None };
    findings.diagnostics.iter().zip(Fingerprint::of(&findings.diagnostics)).map(shown).collect()
}

/// Returns the findings that are accepted for a stated reason.
fn accepted_findings(findings: &Findings) -> impl Iterator<Item = ShownFinding<'_>> {
    let all: Vec<Diagnostic> = findings.waived.iter().map(|waived| waived.diagnostic.clone()).collect();
    let accepted = findings.waived.iter().zip(Fingerprint::of(&all));
    accepted.filter(|(waived, _)| waived.waiver.reason.is_some()).map(|(waived, fingerprint)| ShownFinding {
        diagnostic: &waived.diagnostic,
        fingerprint,
        waiver: Some(&waived.waiver),
    })
}

fn rule(code: Code, view: &View) -> Json {
    let mut rule = json!({
        "id": code.to_string(),
        "name": code.name(),
        "shortDescription": { "text": code.name().replace('-', " ") },
        "defaultConfiguration": { "level": code.severity().name() },
    });
    let page = code.page(view.lang);
    rule["fullDescription"] = json!({ "text": description(page) });
    rule["help"] = json!({ "text": page, "markdown": page });
    rule
}

/// Returns the first paragraph of a page.
fn description(page: &str) -> String {
    let text = page.lines().skip_while(|line| line.starts_with('#') || line.trim().is_empty());
    let text: Vec<&str> = text.take_while(|line| !line.trim().is_empty()).collect();
    text.join(" ")
}

fn invocation(findings: &Findings, left_out: usize, view: &View) -> Json {
    let stops = |found: &Diagnostic| found.is_error() && found.code() == Code::InvalidConfiguration;
    let mut invocation = json!({ "executionSuccessful": !findings.diagnostics.iter().any(stops) });
    if left_out > 0 {
        let text = view.choose("further results left out: {n}", "weitere Ergebnisse, weggelassen: {n}");
        let text = text.replace("{n}", &left_out.to_string());
        invocation["toolExecutionNotifications"] =
            json!([{ "level": "warning", "message": { "text": text } }]);
    }
    invocation
}

fn result(shown: &ShownFinding<'_>, rules: &[Code], view: &View) -> Json {
    let ShownFinding { diagnostic, fingerprint, waiver } = shown;
    let at = &diagnostic.place;
    let mut result = json!({
        "ruleId": diagnostic.code().to_string(),
        "ruleIndex": rules.binary_search(&diagnostic.code()).unwrap_or_default(),
        "level": diagnostic.severity.name(),
        "message": { "text": view::message(diagnostic, view) },
        "locations": [location(diagnostic, view)],
        "relatedLocations": diagnostic.trace.iter().map(|step| json!({
            "message": { "text": view::embedding(step, view) },
            "physicalLocation": { "artifactLocation": artifact(&view.raw_name(&step.file)) },
        })).collect::<Vec<_>>(),
        "partialFingerprints": { "pathbuild/v1": fingerprint.to_string() },
        "properties": {
            "layer": at.layer,
            "handle": at.handle.map(|handle| handle.to_string()),
            "entity": at.entity.map(pathbuild_diagnostic::EntityKind::name),
            "x": at.point.map(|point| point.x.0),
            "y": at.point.map(|point| point.y.0),
        },
    });
    if let Some(waiver) = waiver {
        result["suppressions"] = json!([{
            "kind": "external",
            "status": "accepted",
            "justification": waiver.reason,
            "properties": { "until": waiver.until.map(|date| date.to_string()) },
        }]);
    }
    result
}

/// Returns the location of a finding. One without a file refers to the configuration, because GitHub refuses reports with a result that has no
/// location.
fn location(diagnostic: &Diagnostic, view: &View) -> Json {
    let file = view.raw_file(diagnostic).unwrap_or(FILE_NAME.into());
    let mut region = json!({ "startLine": diagnostic.place.line.unwrap_or(1) });
    if let Some(column) = diagnostic.place.column {
        region["startColumn"] = json!(column);
    }
    let mut location =
        json!({ "physicalLocation": { "artifactLocation": artifact(&file), "region": region } });
    if let Some(path) = &diagnostic.path {
        location["logicalLocations"] = json!([{ "name": path, "kind": "function" }]);
    }
    location
}

fn artifact(file: &str) -> Json {
    match file.strip_prefix('/') {
        Some(_) => json!({ "uri": format!("file://{}", percent_encoded(file)) }),
        None => json!({ "uri": percent_encoded(file), "uriBaseId": "%SRCROOT%" }),
    }
}

fn percent_encoded(name: &str) -> String {
    let encode = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' | b'~' => {
            char::from(byte).to_string()
        }
        _ => format!("%{byte:02X}"),
    };
    name.bytes().map(encode).collect()
}
