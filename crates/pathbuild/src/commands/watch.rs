//! `pathbuild watch`: checks drawings, and with `--emit` writes programs, whenever drawings change. (book: reference/commands)

use std::cell::OnceCell;
use std::collections::BTreeSet;

use camino::Utf8PathBuf;
use pathbuild_api::OutputFile;
use pathbuild_db::SourceFile;
use pathbuild_diagnostic::{Diagnostic, escaping, with_decimal_separator};
use pathbuild_workspace::Inputs;
use pathbuild_workspace::emit::ProgramOutcome;
use pathbuild_workspace::post_processor::PostProcessor;
use pathbuild_workspace::session::Session;
use pathbuild_workspace::watch::{
    FindingCounts, FirstCheck, Listener, Request, Update, WakeHandle, WatchEnd,
};

use serde_json::{Value, json};

use super::emit::show_all;
use crate::args::WatchArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::serving::Server;
use crate::text::{DRAWING, ERROR, PATH, WARNING, counted};
use pathbuild_workspace::findings::Findings;

/// Watches until the user ends the program or a problem prevents watching.
///
/// # Errors
/// The reason, as a sentence, why the configuration must be loaded again and watching restarted.
pub(crate) fn run(
    context: &Context,
    args: &WatchArgs,
    server: Option<&Server>,
    is_configuration_current: &dyn Fn() -> bool,
) -> Result<ExitStatus, &'static str> {
    let page = server.map(|server| server.page(context));
    // Without a library, show all drawings that `list` would list.
    let is_everything = page.is_some() && args.inputs.is_empty() && !context.has_library();
    let here = Inputs { inputs: vec![".".to_owned()] };
    let inputs = if is_everything { &here } else { &args.inputs.to_inputs() };
    let request = Request { inputs, emits: args.emit, lists: page.is_some(), polls: args.poll };
    let page = page.unwrap_or_else(|| Box::new(()));
    let wake_handle = OnceCell::new();
    let has_page = server.is_some();
    let printer = WatchPrinter { context, page, has_page, wake_handle, is_configuration_current };
    Ok(match request.run(context, &printer) {
        WatchEnd::ConfigurationChanged => {
            return Err(context.choose(
                "the configuration, its post-processor or its baseline has changed",
                "die Konfiguration, ihr Postprozessor oder ihre Liste bekannter Befunde wurde geändert",
            ));
        }
        WatchEnd::DirectoriesChanged => {
            return Err(context.choose(
                "a watched directory appeared, disappeared or was replaced",
                "ein beobachtetes Verzeichnis ist hinzugekommen, verschwunden oder ersetzt worden",
            ));
        }
        WatchEnd::Over => ExitStatus::Success,
        WatchEnd::NothingNamed => context.refuse_empty_input(),
        WatchEnd::NoTargets => {
            let reason = context.choose(
                "nothing to emit: set `[emit] targets` in pathbuild.toml",
                "nichts zu schreiben: `[emit] targets` in pathbuild.toml setzen",
            );
            halt(server, &[], reason);
            context.usage_error(reason)
        }
        WatchEnd::BadPost(problems) => {
            halt(server, &problems, "");
            context.fail(problems)
        }
        WatchEnd::BadBaseline(problems) => {
            halt(server, &problems, "");
            context.refuse(problems)
        }
        WatchEnd::CannotWatch(reason) => {
            let advice = context.choose(
                "--poll checks for changes at intervals instead",
                "--poll sucht stattdessen in festen Abständen nach Änderungen",
            );
            halt(server, &[], &reason);
            let cannot = context.choose("cannot watch", "kann nicht beobachten");
            context.usage_error(&format!("{cannot}: {reason}; {advice}"))
        }
    })
}

/// Shows on the page, if there is one, the reason why nothing is checked.
pub(crate) fn halt(server: Option<&Server>, problems: &[Diagnostic], reason: &str) {
    if let Some(server) = server {
        server.halt(problems, reason);
    }
}

/// Listener that prints the first check as `check` does, and for each later batch the new and the fixed findings and one line per changed file.
/// It forwards to the page the events that the page uses; without a page, `page` is `()`, which ignores them.
struct WatchPrinter<'a> {
    context: &'a Context,
    page: Box<dyn Listener + 'a>,
    has_page: bool,
    wake_handle: OnceCell<WakeHandle>,
    is_configuration_current: &'a dyn Fn() -> bool,
}

impl WatchPrinter<'_> {
    /// Writes the numbers of findings after the first check or a change as a line of JSON, and adds them to the last line of the document.
    fn write_counts(&self, number: u64, mut row: Value, counts: FindingCounts, new: usize) {
        let FindingCounts { errors, warnings, known } = counts;
        for (name, count) in [("errors", errors), ("warnings", warnings), ("known", known)] {
            self.context.output.add_figure(name, count);
            row[name] = count.into();
        }
        row["number"] = number.into();
        row["new"] = new.into();
        self.context.json_row(|| ("watch_change", row));
    }

    /// Ends watching if writing to a stream has failed, usually because its reader has ended, unless a page is served.
    fn end_without_reader(&self) {
        if let Some(wake_handle) = self.wake_handle.get()
            && self.context.printer.has_failed()
            && !self.has_page
        {
            wake_handle.end();
        }
    }
}

impl Listener for WatchPrinter<'_> {
    fn is_configuration_current(&self) -> bool {
        (self.is_configuration_current)()
    }

    fn set_wake_handle(&self, bell: WakeHandle) {
        _ = self.wake_handle.set(bell.clone());
        self.page.set_wake_handle(bell);
    }

    fn drawings_found(&self, session: &mut Session<'_>, drawings: &[SourceFile], problems: &[Diagnostic]) {
        self.page.drawings_found(session, drawings, problems);
    }

    fn drawings_checked(
        &self,
        session: &mut Session<'_>,
        drawings: &[SourceFile],
        post_processor: Option<&PostProcessor>,
    ) {
        self.page.drawings_checked(session, drawings, post_processor);
    }

    fn woken(&self, session: &mut Session<'_>) {
        self.page.woken(session);
    }

    fn first_check_done(&self, beginning: &FirstCheck) {
        self.page.first_check_done(beginning);
        let FirstCheck { drawings, paths, findings, time, .. } = beginning;
        let context = self.context;
        context.show(findings);
        context.report_date();
        let counts = FindingCounts::of(findings);
        let checked = json!({ "paths": paths, "drawings": drawings });
        self.write_counts(0, checked, counts, findings.diagnostics.len());
        let counted = |number, noun| counted(number, noun, context.lang());
        let milliseconds = time.as_secs_f64() * 1000.0;
        let (paths, drawings) = (counted(*paths, PATH), counted(*drawings, DRAWING));
        let (errors, warnings) = (counted(counts.errors, ERROR), counted(counts.warnings, WARNING));
        let known = match counts.known {
            0 => String::new(),
            known => format!(", {known} {}", context.choose("known", "bekannt")),
        };
        let begin = context.choose("watching", "beobachtet:");
        context.printer.status(format_args!(
            "{begin} {paths} in {drawings}: {errors}, {warnings}{known} ({milliseconds:.0} ms)"
        ));
        self.end_without_reader();
    }

    fn batch_done(&self, update: &Update) {
        self.page.batch_done(update);
        let context = self.context;
        let (new, gone) = (&update.new, update.fixed.len());
        context.show(&Findings { diagnostics: new.clone(), ..Findings::default() });
        context.show_fixed(&update.fixed);
        context.report_date();
        let names =
            |files: &BTreeSet<Utf8PathBuf>| files.iter().map(|file| context.file(file)).collect::<Vec<_>>();
        let change = json!({
            "changed": names(&update.changed),
            "removed": names(&update.removed),
            "checked": update.checked_files.len(),
            "open": update.open,
            "fixed": gone,
        });
        self.write_counts(update.revision, change, update.counts, new.len());
        let (count, revision) = (update.checked_files.len(), update.revision);
        let milliseconds = update.time.as_secs_f64() * 1000.0;
        let phrase = |en, de| context.choose(en, de);
        let open = match update.open {
            0 => String::new(),
            open => format!(", {open} {}", phrase("still to check", "noch zu prüfen")),
        };
        let counted = |number, noun| counted(number, noun, context.lang());
        let checked = [["drawing checked", "drawings checked"], ["Zeichnung geprüft", "Zeichnungen geprüft"]];
        let checked = counted(count, checked);
        let has_news = !new.is_empty() || gone > 0;
        let new = counted(new.len(), [["new finding", "new findings"], ["neuer Befund", "neue Befunde"]]);
        let time = with_decimal_separator(format!("{milliseconds:.1}"), context.lang());
        let tail = format!("{checked}{open}, {new}, {gone} {} ({time} ms)", phrase("fixed", "behoben"));
        let changed = update.changed.iter().map(|path| {
            let is_gone = update.removed.contains(path);
            (path, if is_gone { phrase("removed", "entfernt") } else { phrase("changed", "geändert") })
        });
        let tried_again = update.tried_again.iter().filter(|_| has_news);
        let tried_again = tried_again.map(|path| (path, phrase("checked again", "noch einmal geprüft")));
        for (path, what) in changed.chain(tried_again) {
            context.printer.status(format_args!("[{revision}] {path}: {what}; {tail}"));
        }
        self.end_without_reader();
    }

    fn not_watched(&self, drawings: &[(Utf8PathBuf, String)]) {
        let cannot = self.context.choose(
            "this is a link, and changes to the file behind it cannot be watched",
            "das ist eine Verknüpfung, und Änderungen an der Datei dahinter lassen sich nicht beobachten",
        );
        for (drawing, reason) in drawings {
            let line = format!("{drawing}: {cannot}: {reason}");
            self.context.printer.status(escaping::line(&line));
        }
    }

    fn programs_written(&self, outcomes: Vec<ProgramOutcome>) {
        let (files, notes) = OutputFile::of_programs(outcomes, self.context.lang());
        show_all(self.context, &files, &notes);
    }

    fn options_missing(&self, reason: &str) {
        _ = self.context.usage_error(reason);
    }
}
