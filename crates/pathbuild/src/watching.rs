//! Runs `watch` across changes of the configuration. Each change restarts `watch`, and a temporarily invalid configuration does not end
//! it.

use std::thread;
use std::time::Duration;

use crate::args::{Cli, WatchArgs};
use crate::commands::watch;
use crate::context::Context;
use crate::environment::{user_configuration, working_directory};
use crate::exit::ExitStatus;
use crate::german;
use crate::serving::Server;
use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::escaping;

/// Interval at which an invalid configuration is checked again.
const CONFIGURATION_INTERVAL: Duration = Duration::from_millis(200);

/// Runs `watch` until it ends. An invalid configuration at the beginning ends the run, unless the user sees only the page; later, the run
/// waits until the configuration is valid again.
pub(crate) fn run(cli: &Cli, args: &WatchArgs) -> ExitStatus {
    let mut has_begun = false;
    let mut had_file = false;
    let mut server = None;
    let home = working_directory();
    loop {
        if has_begun && !return_to_working_directory(cli, &home, server.as_ref()) {
            return Context::of(cli).0.printer.finish(ExitStatus::Success);
        }
        // Read the sources before the configuration is loaded, so that later changes are noticed.
        let sources = Sources::of(&Context::of(cli).0);
        let (context, faults) = Context::of(cli);
        if let Some(refusal) = context.refusal() {
            let status = german::print_usage_error(&refusal, context.lang(), &context.printer);
            return context.printer.finish(status);
        }
        if !has_begun && server.is_none() {
            context.begin();
            context.warn_about_unused_configuration();
            match Server::start(&context, &args.serving) {
                Ok(started) => server = started,
                Err(reason) => return context.printer.finish(context.usage_error(&reason)),
            }
        }
        let waits = server.as_ref().is_some_and(Server::waits_for_fixes);
        let is_lost = had_file && context.settings.file.is_none() && cli.common.config.is_none();
        let ended = match faults.is_empty() {
            // An editor may remove the configuration before it writes the new one.
            true if is_lost => {
                let reason = context.choose("pathbuild.toml is missing", "pathbuild.toml fehlt");
                watch::halt(server.as_ref(), &[], reason);
                Ok(ExitStatus::Usage)
            }
            true => {
                let is_current = || Sources::of(&Context::of(cli).0) == sources;
                watch::run(&context, args, server.as_ref(), &is_current)
            }
            false => {
                watch::halt(server.as_ref(), &faults, "");
                Ok(context.refuse(faults))
            }
        };
        match ended {
            Ok(status) if !has_begun && !waits || status == ExitStatus::Success => {
                return context.printer.finish(status);
            }
            Ok(_) => {
                if !wait_for_fix(cli, &context, &sources, &home, server.as_ref()) {
                    return context.printer.finish(ExitStatus::Success);
                }
            }
            Err(because) => {
                has_begun = true;
                had_file |= context.settings.file.is_some();
                context.printer.status(because);
                report_restart(&context, because);
            }
        }
    }
}

/// Waits until the configuration changes. Returns false if the user has ended watching meanwhile.
fn wait_for_fix(
    cli: &Cli,
    context: &Context,
    sources: &Sources,
    home: &Utf8Path,
    server: Option<&Server>,
) -> bool {
    context.printer.status(context.choose(
        "the configuration, its post-processor or its baseline is missing or invalid: nothing is checked until this is fixed",
        "die Konfiguration, ihr Postprozessor oder ihre Liste bekannter Befunde fehlt oder ist fehlerhaft: es wird erst weiter geprüft, wenn das behoben ist",
    ));
    while Sources::of(&Context::of(cli).0) == *sources {
        if server.is_some_and(Server::is_over) {
            return false;
        }
        thread::sleep(CONFIGURATION_INTERVAL);
        change_directory(home);
    }
    let reason = context.choose("the configuration was corrected", "die Konfiguration wurde berichtigt");
    report_restart(context, reason);
    true
}

/// Tells readers of JSON that all findings so far are void, because watching starts again.
fn report_restart(context: &Context, reason: &str) {
    context.json_row(|| ("watch_restart", serde_json::json!({ "reason": reason })));
}

/// Changes back to the working directory, which may have been replaced. Unless all arguments are absolute, waits until it exists again.
/// Returns false if the user has ended watching meanwhile.
fn return_to_working_directory(cli: &Cli, home: &Utf8Path, server: Option<&Server>) -> bool {
    let inputs = cli.command.inputs();
    let is_named = inputs.inputs.iter().all(|input| Utf8Path::new(input).is_absolute());
    let is_configured = cli.common.config.as_ref().is_none_or(|file| file.is_absolute());
    if change_directory(home) || is_named && is_configured && !inputs.inputs.is_empty() {
        return true;
    }
    let (context, _) = Context::of(cli);
    let line = context.phrase(
        "the working directory {} is missing: nothing is checked until it is there again",
        "das Arbeitsverzeichnis {} fehlt: nichts wird geprüft, bis es wieder da ist",
        &escaping::line(home.as_str()),
    );
    watch::halt(server, &[], &line);
    context.printer.status(line);
    while !change_directory(home) {
        if server.is_some_and(Server::is_over) {
            return false;
        }
        thread::sleep(CONFIGURATION_INTERVAL);
    }
    true
}

/// Changes the working directory. Returns whether that succeeded.
fn change_directory(home: &Utf8Path) -> bool {
    // `home` is empty if the system could not determine the working directory.
    home.as_str().is_empty() || std::env::set_current_dir(home).is_ok()
}

/// The files that a configuration consists of, with their contents.
#[derive(PartialEq, Eq)]
struct Sources(Vec<(Utf8PathBuf, Option<Vec<u8>>)>);

impl Sources {
    fn of(context: &Context) -> Self {
        let settings = &context.settings;
        let beside = settings.directory().unwrap_or(&context.working_directory);
        let post = beside.join(&*settings.general.post.value.name);
        let limit = settings.limits.file_size.value;
        let read = |file: Utf8PathBuf| {
            let bytes = context.system.read(&file, limit).ok();
            (file, bytes)
        };
        let baseline = context.baseline_file(None);
        let files = settings.file.clone().into_iter().chain([post, baseline]).chain(user_configuration());
        Self(files.map(read).collect())
    }
}
