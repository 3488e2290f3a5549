//! One JSON object a line, always with the same keys; what is not known is `null`. The keys and codes are English in any language.
//!
//! `span` is the faulty part of `text`: its first character and the one after its last, counted in characters from 0. `x` and `y`
//! are millimetres in the drawing. `trace` lists the embeddings that led to the path, outermost first.

use pathbuild_diagnostic::{Diagnostic, EntityKind, Severity, TextFault, TraceStep};
use serde::Serialize;

use super::View;
use crate::report::Findings;

#[derive(Serialize)]
struct Object<'a> {
    code: String,
    name: &'static str,
    severity: &'static str,
    message: String,
    help: Option<String>,
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

#[derive(Serialize)]
struct Step<'a> {
    file: String,
    path: &'a str,
    x: f64,
    y: f64,
}

pub(super) fn render(findings: &Findings, view: &View) -> String {
    findings.diagnostics.iter().map(|diagnostic| line(diagnostic, view)).collect()
}

fn line(diagnostic: &Diagnostic, view: &View) -> String {
    let place = &diagnostic.place;
    let object = Object {
        code: diagnostic.code().to_string(),
        name: diagnostic.code().name(),
        severity: severity(diagnostic.severity),
        message: diagnostic.text(view.lang),
        help: view.help(diagnostic),
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
    };
    // Only maps with keys that are no text can fail to become JSON.
    format!("{}\n", serde_json::to_string(&object).unwrap_or_default())
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

fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}
