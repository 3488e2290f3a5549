//! Renders one line per diagnostic, which editors and `grep` understand: `FILE:LINE: error[PB203] message (path, element, place)`.

use pathbuild_diagnostic::Diagnostic;

use super::{View, view};
use pathbuild_workspace::findings::Findings;

pub(super) fn render(findings: &Findings, view: &View) -> String {
    findings.diagnostics.iter().map(|diagnostic| line(diagnostic, view)).collect()
}

pub(super) fn line(diagnostic: &Diagnostic, view: &View) -> String {
    let location =
        view::location(diagnostic, view).map(|location| format!("{location}: ")).unwrap_or_default();
    let severity = diagnostic.severity.word(view.lang);
    let element = view::element(diagnostic, view);
    let element = if element.is_empty() { element } else { format!(" ({element})") };
    format!("{location}{severity}[{}] {}{element}\n", diagnostic.code(), diagnostic.text(view.lang))
}
