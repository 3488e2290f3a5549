//! `pathbuild why`: shows why drawings would be compiled again. (book: reference/commands)

use std::collections::HashSet;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::Reason;
use pathbuild_db::check_file;
use pathbuild_db::system::FileKind;
use pathbuild_diagnostic::escaping;
use serde_json::{Value, json};

use crate::args::GraphArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;
use pathbuild_workspace::memo::Memo;
use pathbuild_workspace::session::Session;

/// Runs the command. For each drawing, shows whether the result of the last `check` of the library is still valid, or which inputs have
/// changed since then.
pub fn run(context: &Context, args: &GraphArgs) -> ExitStatus {
    let mut session = Session::new(context);
    if args.inputs.is_empty() && !session.has_library() {
        return context.refuse_empty_input();
    }
    let Some(memo) = Memo::of_checks(context) else {
        return context.usage_error(context.choose(
            "why needs cached results: there are none without a pathbuild.toml, or with --no-cache",
            "why braucht gespeicherte Ergebnisse: ohne pathbuild.toml oder mit --no-cache gibt es keine",
        ));
    };
    let selection = session.with_stable_files(|session| session.select(&args.inputs.to_inputs()));
    let named = selection.named.iter().copied().chain(selection.paths.iter().map(|path| path.file));
    let mut problems = selection.problems.clone();
    let mut listed = HashSet::new();
    let all = selection.drawings.iter().chain(named.map(|file| file.path(session.db())));
    for drawing in all.filter(|drawing| listed.insert(*drawing)) {
        let answer = DrawingState { drawing, reasons: memo.invalidation_reasons(drawing.as_str()) };
        if answer.reasons.is_none() && context.system.kind(drawing) == FileKind::Missing {
            problems.extend_from_slice(check_file(session.db(), session.file(drawing)));
            continue;
        }
        match context.format {
            Format::Json => context.row("result", answer.json(context)),
            _ => context.printer.result(answer.text(context)),
        }
    }
    context.conclude(session.with_hints(problems))
}

/// The state of a drawing's cached result.
struct DrawingState<'a> {
    drawing: &'a Utf8PathBuf,
    /// Reasons why the result is no longer valid; empty if it is valid, and `None` if nothing is cached.
    reasons: Option<Vec<Reason>>,
}

impl DrawingState<'_> {
    fn text(&self, context: &Context) -> String {
        let state = match self.reasons.as_deref() {
            None => context.choose(
                "would be compiled: there is no cached result from this build of pathbuild with these settings",
                "würde übersetzt: es gibt kein gespeichertes Ergebnis dieser Programmfassung mit diesen Einstellungen",
            ),
            Some([]) => context.choose("up to date", "aktuell"),
            Some(_) => context.choose("would be compiled again", "würde neu übersetzt"),
        };
        let reasons = self.reasons.iter().flatten();
        let lines = reasons.map(|reason| format!("  {}\n", escaping::line(&describe(context, reason))));
        format!("{}: {state}\n", escaping::line(self.drawing.as_str())) + &lines.collect::<String>()
    }

    fn json(&self, context: &Context) -> Value {
        let reasons = self.reasons.iter().flatten().map(|reason| object(context, reason));
        // `holds` is null if nothing is cached.
        let holds = self.reasons.as_ref().map(Vec::is_empty);
        json!({ "file": context.file(self.drawing), "holds": holds, "reasons": reasons.collect::<Value>() })
    }
}

fn describe(context: &Context, reason: &Reason) -> String {
    match reason {
        Reason::File { path, is_gone: false } => {
            format!("{path} {}", context.choose("has changed", "hat sich geändert"))
        }
        Reason::File { path, is_gone: true } => format!("{path} {}", context.choose("is gone", "ist weg")),
        Reason::Name { file, path, is_gone } => {
            let state = match is_gone {
                true => context.choose(
                    "is gone and may have contained",
                    "ist weg und kann diesen Pfad enthalten haben:",
                ),
                false => context.choose("is new and may contain", "ist neu und kann diesen Pfad enthalten:"),
            };
            format!("{file} {state} {path}")
        }
        Reason::Links { directory } => {
            let directory = if directory.as_str().is_empty() { "." } else { directory.as_str() };
            format!(
                "{directory} {}",
                context.choose(
                    "contains a symbolic link, or is reached through one, that leads elsewhere now; or it could not be listed",
                    "enthält einen symbolischen Link, der jetzt woandershin führt, oder wird über einen solchen erreicht; oder es ließ sich nicht auflisten",
                )
            )
        }
    }
}

/// Returns the JSON object of a reason. `change` is `changed`, `gone`, `new` or `links`. `path` is the path that the file, judging by its
/// name, contains or contained; null if the reason is not about such a file.
fn object(context: &Context, reason: &Reason) -> Value {
    let (file, change, path) = match reason {
        Reason::File { path, is_gone } => (&**path, if *is_gone { "gone" } else { "changed" }, None),
        Reason::Name { file, path, is_gone } => {
            (Utf8Path::new(file.as_str()), if *is_gone { "gone" } else { "new" }, Some(path))
        }
        Reason::Links { directory } => (&**directory, "links", None),
    };
    json!({ "file": context.file(file), "change": change, "path": path })
}
