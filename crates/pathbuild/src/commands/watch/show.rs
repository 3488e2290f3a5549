//! What is said: at the beginning what a check says, then a line for each file that changed.

use std::collections::HashSet;
use std::time::Duration;

use pathbuild_diagnostic::Diagnostic;

use super::library::{Library, Update};
use crate::context::Context;
use crate::report::Findings;

/// Says how things stand at the beginning.
pub(super) fn begun(
    context: &Context,
    library: &Library<'_>,
    update: Update,
    written: Vec<Diagnostic>,
    time: Duration,
) {
    let mut found = update.now;
    found.extend(written);
    let findings = context.findings(library.session().with_elsewhere(found));
    context.show_as_result(&findings);
    let (drawings, paths) = library.counts();
    let (errors, warnings) = (findings.errors(), findings.warnings());
    let milliseconds = time.as_secs_f64() * 1000.0;
    context.printer.status(match context.lang() {
        pathbuild_diagnostic::Lang::En => format!(
            "watching {paths} paths in {drawings} drawings: {errors} errors, {warnings} warnings ({milliseconds:.0} ms)"
        ),
        pathbuild_diagnostic::Lang::De => format!(
            "{paths} Pfade in {drawings} Zeichnungen werden beobachtet: {errors} Fehler, {warnings} Warnungen ({milliseconds:.0} ms)"
        ),
    });
}

/// Says what a batch of changes did: what is newly found, and a line for each file that changed.
pub(super) fn updated(
    context: &Context,
    library: &Library<'_>,
    update: Update,
    written: Vec<Diagnostic>,
    revision: u64,
    time: Duration,
) {
    let judged =
        |found: Vec<Diagnostic>| context.findings(library.session().with_elsewhere(found)).diagnostics;
    let (before, now) = (judged(update.before), judged([update.now, written].concat()));
    let known: HashSet<&Diagnostic> = before.iter().collect();
    let still: HashSet<&Diagnostic> = now.iter().collect();
    let gone = before.iter().filter(|found| !still.contains(found)).count();
    let new: Vec<Diagnostic> = now.iter().filter(|found| !known.contains(found)).cloned().collect();
    context.show_as_result(&Findings { diagnostics: new.clone(), checked: Vec::new() });
    let count = update.asked.len();
    let milliseconds = time.as_secs_f64() * 1000.0;
    let phrase = |en, de| context.choose(en, de);
    let open = match update.open {
        0 => String::new(),
        open => format!(", {open} {}", phrase("to follow", "folgen")),
    };
    let tail = format!(
        "{count} {}{open}, {} {}, {gone} {} ({milliseconds:.1} ms)",
        phrase("drawings checked", "Zeichnungen geprüft"),
        new.len(),
        phrase("new findings", "neue Meldungen"),
        phrase("gone", "erledigt"),
    );
    for path in &update.changed {
        let what = if update.removed.contains(path) {
            phrase("removed", "entfernt")
        } else {
            phrase("changed", "geändert")
        };
        context.printer.status(format_args!("[{revision}] {path}: {what}; {tail}"));
    }
}
