//! Renders one JSON object per line. All objects of a type have the same keys; unknown values are `null`. Keys and codes are English in
//! every language.
//!
//! `span` is the faulty part of `text`: the position of its first character, and the position after its last one, counted in characters
//! from 0. `x` and `y` are in mm, in the drawing. `trace` lists the embeddings that led to the path, outermost first.

use pathbuild_diagnostic::{Diagnostic, EntityKind, TextFault, TraceStep, escaping};
use serde::Serialize;
use serde_json::Value;

use super::{RenderedText, View};
use pathbuild_workspace::findings::Findings;

#[derive(Serialize)]
struct Object<'a> {
    r#type: &'static str,
    code: String,
    name: &'static str,
    severity: &'static str,
    message: String,
    help: Option<String>,
    notes: Vec<String>,
    file: Option<String>,
    line: Option<u32>,
    path: Option<&'a str>,
    layer: Option<&'a str>,
    handle: Option<String>,
    entity: Option<&'static str>,
    x: Option<f64>,
    y: Option<f64>,
    text: Option<&'a str>,
    span: Option<[usize; 2]>,
    trace: Vec<Step<'a>>,
}

/// The JSON object of a finding that is accepted for a stated reason.
#[derive(Serialize)]
struct AcceptedFinding<'a> {
    #[serde(flatten)]
    finding: Object<'a>,
    reason: &'a str,
    until: Option<String>,
}

#[derive(Serialize)]
struct Step<'a> {
    file: String,
    path: &'a str,
    x: f64,
    y: f64,
}

pub(super) fn render(findings: &Findings, view: &View) -> String {
    let waived = findings.waived.iter().filter_map(|waived| {
        Some(AcceptedFinding {
            finding: Object { r#type: "waived", ..object(&waived.diagnostic, view) },
            reason: waived.waiver.reason.as_deref()?,
            until: waived.waiver.until.map(|date| date.to_string()),
        })
    });
    let reported = findings.diagnostics.iter().map(|diagnostic| line(&object(diagnostic, view)));
    reported.chain(waived.map(|waived| line(&waived))).collect()
}

/// Renders findings that a change of the drawings has fixed.
pub(crate) fn fixed(findings: &[Diagnostic], view: &View) -> RenderedText {
    let fixed = |diagnostic| line(&Object { r#type: "fixed", ..object(diagnostic, view) });
    escaped_lines(&findings.iter().map(fixed).collect::<String>())
}

/// Returns the first line of a document, with the version of the format and the name of the command.
pub(crate) fn header(command: &str) -> String {
    let header =
        Header { r#type: "header", schema_version: VERSION, pathbuild: env!("CARGO_PKG_VERSION"), command };
    // Serialization fails only for maps with keys that are not strings.
    serde_json::to_string(&header).unwrap_or_default()
}

/// Serializes an object with at least one key so that its type is the first key.
pub(crate) fn serialize_with_type(kind: &str, object: &Value) -> String {
    format!("{{\"type\":\"{kind}\",{}", object.to_string().trim_start_matches('{'))
}

/// Escapes characters with special effects in lines of JSON.
pub(crate) fn escaped_lines(lines: &str) -> RenderedText {
    RenderedText(escaping::json(lines).into_owned())
}

/// Version of the format that docs/schemas/output.json describes.
const VERSION: u32 = 2;

#[derive(Serialize)]
struct Header<'a> {
    r#type: &'static str,
    schema_version: u32,
    pathbuild: &'static str,
    command: &'a str,
}

fn line(object: &impl Serialize) -> String {
    // Serialization fails only for maps with keys that are not strings.
    format!("{}\n", serde_json::to_string(object).unwrap_or_default())
}

fn object<'a>(diagnostic: &'a Diagnostic, view: &View) -> Object<'a> {
    let place = &diagnostic.place;
    Object {
        r#type: "finding",
        code: diagnostic.code().to_string(),
        name: diagnostic.code().name(),
        severity: diagnostic.severity.name(),
        message: diagnostic.text(view.lang),
        help: diagnostic.help(view.lang),
        notes: diagnostic.notes.iter().map(|note| note.text(view.lang)).collect(),
        file: view.raw_file(diagnostic).map(Into::into),
        line: place.line,
        path: diagnostic.path.as_deref(),
        layer: place.layer.as_deref(),
        handle: place.handle.map(|handle| handle.to_string()),
        entity: place.entity.map(EntityKind::name),
        x: place.point.map(|point| point.x.0),
        y: place.point.map(|point| point.y.0),
        text: diagnostic.text.as_ref().map(|fault| &*fault.text),
        span: diagnostic.text.as_ref().map(span),
        trace: trace(diagnostic, view),
    }
}

fn trace<'a>(diagnostic: &'a Diagnostic, view: &View) -> Vec<Step<'a>> {
    let step = |step: &'a TraceStep| Step {
        file: view.raw_name(&step.file).into_owned(),
        path: &step.path,
        x: step.point.x.0,
        y: step.point.y.0,
    };
    diagnostic.trace.iter().map(step).collect()
}

fn span(fault: &TextFault) -> [usize; 2] {
    let characters_before = |byte: usize| fault.text[..byte].chars().count();
    [characters_before(fault.span().start), characters_before(fault.span().end)]
}
