//! `pathbuild cache`: manages the cached results. (book: reference/configuration)

use pathbuild_cache::{CacheFault, Entry, Key, RemoveError};
use pathbuild_db::system::with_forward_slashes;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files;

use serde_json::json;

use crate::args::{CacheArgs, CacheCommand};
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;
use pathbuild_workspace::memo::BUILD;

/// Runs one of the subcommands.
pub fn run(context: &Context, args: &CacheArgs) -> ExitStatus {
    if context.settings.directory().is_none() {
        return context.usage_error(context.choose(
            "there is no pathbuild.toml here or above, and without one no results are cached",
            "hier und darüber gibt es keine pathbuild.toml, und ohne sie werden keine Ergebnisse gespeichert",
        ));
    }
    let (Some(home), Some(place)) = (&context.cache, context.cache_store()) else {
        return context.usage_error(context.choose(
            "no results are cached: there is no cache directory, or --no-cache was given",
            "es werden keine Ergebnisse gespeichert: es gibt kein Cache-Verzeichnis, oder --no-cache ist angegeben",
        ));
    };
    let build = Key::new(BUILD, "");
    let directory = with_forward_slashes(place.directory().to_owned());
    match args.command {
        CacheCommand::Dir if context.format == Format::Json => {
            context.row("cache", json!({ "directory": directory.as_str() }));
        }
        CacheCommand::Dir => context.printer.result_line(directory),
        CacheCommand::Size => {
            let size: u64 = place.entries(&build).iter().map(|entry| entry.size).sum();
            if context.format == Format::Json {
                context.row("cache", json!({ "bytes": size }));
            } else {
                context.printer.result_line(format_args!("{size} {}", context.choose("bytes", "Bytes")));
            }
        }
        CacheCommand::Prune => {
            let (others, own) = (home.prune(), place.prune(&build));
            return report(context, others.and_then(|others| Ok(others + own?)));
        }
        CacheCommand::Clean => {
            let cleaned = place.clean().map(usize::from);
            return report(context, cleaned);
        }
        CacheCommand::Verify => return verify(context, &place.entries(&build)),
    }
    ExitStatus::Success
}

fn report(context: &Context, removed: Result<usize, RemoveError>) -> ExitStatus {
    match removed {
        Ok(count) => {
            context.json_row(|| ("cache", json!({ "removed": count })));
            context.printer.status(format_args!("{}: {count}", context.choose("removed", "entfernt")));
            ExitStatus::Success
        }
        Err(RemoveError { path, reason }) => {
            let problem =
                Diagnostic::new(&files::CANNOT_REMOVE).quoting("name", with_forward_slashes(path).as_str());
            context.fail(vec![problem.with("reason", reason)])
        }
    }
}

/// Reports the state of each results file. A file of another build is not an error; this build just cannot read it.
fn verify(context: &Context, entries: &[Entry]) -> ExitStatus {
    let mut is_whole = true;
    for Entry { path, size, fault } in entries {
        let (key, en, de) = match fault {
            None => ("whole", "intact", "unversehrt"),
            Some(CacheFault::Foreign) => {
                ("foreign", "written by another build", "von einer anderen Programmfassung")
            }
            Some(CacheFault::Damaged) => ("damaged", "damaged", "beschädigt"),
        };
        is_whole &= !matches!(fault, Some(CacheFault::Damaged));
        let name = path.file_name().unwrap_or_default();
        if context.format == Format::Json {
            context.row("cache_file", json!({ "name": name, "state": key, "bytes": size }));
            continue;
        }
        let (state, bytes) = (context.choose(en, de), context.choose("bytes", "Bytes"));
        context.printer.result_line(format_args!("{name}: {state}, {size} {bytes}"));
    }
    if is_whole { ExitStatus::Success } else { ExitStatus::Errors }
}
