//! `pathbuild watch`: keeps checking, and writing with `--emit`, as drawings change. (book: reference/commands)

use std::collections::HashSet;

use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_workspace::emit::Delivered;
use pathbuild_workspace::watch::{Beginning, Ended, Listener, Request, Update};

use super::emit::show_all;
use crate::args::WatchArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::report::Findings;

/// Runs the command. No status: the configuration changed, and everything has to begin anew.
pub fn run(context: &Context, args: &WatchArgs) -> Option<ExitStatus> {
    let request = Request { inputs: &args.inputs, emits: args.emit, polls: args.poll };
    match request.run(context, &Shown { context }) {
        Ended::ConfigurationChanged => None,
        Ended::Over => Some(ExitStatus::Success),
        Ended::NothingNamed => Some(context.nothing_named("watch")),
        Ended::NoTargets => Some(context.usage("nothing to emit: set `[emit] targets` in pathbuild.toml")),
        Ended::BadPost(problems) => Some(context.fail(problems)),
        Ended::CannotWatch(reason) => {
            let advice = context.choose(
                "--poll looks for changes from time to time",
                "--poll sieht von Zeit zu Zeit nach Änderungen",
            );
            Some(context.usage(&format!("cannot watch: {reason}; {advice}")))
        }
    }
}

/// Prints at the beginning what a check prints, then a line for each file that changed.
struct Shown<'a> {
    context: &'a Context,
}

impl Listener for Shown<'_> {
    fn begun(&self, Beginning { drawings, paths, diagnostics, time }: Beginning) {
        let context = self.context;
        let findings = context.findings(diagnostics);
        context.show(&findings);
        let (errors, warnings) = (findings.errors(), findings.warnings());
        let milliseconds = time.as_secs_f64() * 1000.0;
        context.printer.status(match context.lang() {
            Lang::En => format!(
                "watching {paths} paths in {drawings} drawings: {errors} errors, {warnings} warnings ({milliseconds:.0} ms)"
            ),
            Lang::De => format!(
                "{paths} Pfade in {drawings} Zeichnungen werden beobachtet: {errors} Fehler, {warnings} Warnungen ({milliseconds:.0} ms)"
            ),
        });
    }

    fn updated(&self, update: Update) {
        let context = self.context;
        let judged = |found: Vec<Diagnostic>| context.findings(found).diagnostics;
        let (before, now) = (judged(update.before), judged(update.now));
        let known: HashSet<&Diagnostic> = before.iter().collect();
        let still: HashSet<&Diagnostic> = now.iter().collect();
        let gone = before.iter().filter(|found| !still.contains(found)).count();
        let new: Vec<Diagnostic> = now.iter().filter(|found| !known.contains(found)).cloned().collect();
        context.show(&Findings { diagnostics: new.clone(), checked: Vec::new() });
        let (count, revision) = (update.checked, update.revision);
        let milliseconds = update.time.as_secs_f64() * 1000.0;
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

    fn written(&self, delivered: &[Delivered]) {
        show_all(self.context, delivered);
    }

    fn refused(&self, reason: &str) {
        _ = self.context.usage(reason);
    }
}
