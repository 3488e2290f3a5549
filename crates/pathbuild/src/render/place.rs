//! Describes where a diagnostic is.

use std::fmt::Write;

use pathbuild_diagnostic::{Diagnostic, Severity, TraceStep, Value, shown};

use super::View;

/// `parts/2913.dxf:1234:5`, as far as known; editors can open this place.
pub(super) fn location(diagnostic: &Diagnostic, view: &View) -> Option<String> {
    let mut location = view.file(diagnostic)?.into_owned();
    for number in [diagnostic.place.line, diagnostic.place.column].into_iter().flatten() {
        _ = write!(location, ":{number}");
    }
    Some(location)
}

/// `path 2913.1P, LINE 4A1 on layer 2913.1P~A at (12.5, 30)`, as far as known; may be empty.
pub(super) fn element(diagnostic: &Diagnostic, view: &View) -> String {
    let place = &diagnostic.place;
    let mut parts = Vec::new();
    if let Some(path) = &diagnostic.path {
        parts.push(format!("{} {}", view.choose("path", "Pfad"), shown::line(path)));
    }
    let mut words = Vec::new();
    words.extend(place.entity.map(|kind| kind.name().to_owned()));
    words.extend(place.handle.map(|handle| handle.to_string()));
    words.extend(
        place
            .layer
            .as_deref()
            .map(|layer| format!("{} {}", view.choose("on layer", "auf Layer"), shown::line(layer))),
    );
    words.extend(
        place
            .point
            .map(|point| format!("{} {}", view.choose("at", "bei"), Value::from(point).render(view.lang))),
    );
    if !words.is_empty() {
        parts.push(words.join(" "));
    }
    parts.join(", ")
}

/// `embedded by 8001.1P at (10, 20), projects/8001.dxf`
pub(super) fn embedding(step: &TraceStep, view: &View) -> String {
    let (by, at) = (view.choose("embedded by", "eingebettet von"), view.choose("at", "bei"));
    format!(
        "{by} {} {at} {}, {}",
        shown::line(&step.path),
        Value::from(step.point).render(view.lang),
        view.name(&step.file)
    )
}

/// `error` or `warning`
pub(super) fn severity(severity: Severity, view: &View) -> &'static str {
    match severity {
        Severity::Error => view.choose("error", "Fehler"),
        Severity::Warning => view.choose("warning", "Warnung"),
    }
}
