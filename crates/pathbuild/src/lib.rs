//! The program `pathbuild`: arguments, configuration, output and exit status. The meaning of drawings is decided in other crates; this one
//! holds none of that logic. (book: reference/commands, book: reference/configuration)

pub mod args;
pub mod commands;
mod completion;
mod context;
mod environment;
mod exit;
pub mod german;
mod numbers;
mod output;
pub mod printer;
pub mod progress;
pub mod render;
pub mod report;
#[cfg(feature = "serve")]
mod serving;
#[cfg(not(feature = "serve"))]
#[path = "serving/missing.rs"]
mod serving;
mod table;
mod usage;
mod watching;

use std::ffi::OsString;
use std::rc::Rc;

use camino::Utf8PathBuf;
use pathbuild_db::system::{OsSystem, spelt};
use pathbuild_diagnostic::{Diagnostic, Lang, shown};
use pathbuild_workspace::config::{Overrides, User};
use pathbuild_workspace::{Workspace, config};

pub use context::Context;
pub use exit::ExitStatus;

use args::{Cli, Command, CommonArgs, CompatArgs};
use commands::compat::{self, Translation};
use output::Output;
use printer::{ColorChoice, Printer};

/// Runs the program with its command-line arguments, of which the first is the program's own name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitStatus {
    let arguments = compat::with_separator(arguments.into_iter().collect());
    if let Some(status) = completion::answer(&arguments) {
        return status;
    }
    match Cli::read(&arguments) {
        Ok(Cli { command: Command::Compat(args), common }) => run_compat(&arguments, &args, &common),
        Ok(cli) => execute(&cli),
        Err(error) => {
            let lang = lang_of(&arguments);
            // Parse again with the German definition to get the error message in German.
            let message = Cli::matches(&german::command(lang), &arguments).err().unwrap_or(error);
            print(|printer| usage::answer(&message, lang, printer))
        }
    }
}

/// Translates a command line of another program and runs the resulting commands.
fn run_compat(arguments: &[OsString], args: &CompatArgs, common: &CommonArgs) -> ExitStatus {
    let lang = lang_of(arguments);
    let translated = match compat::translate(&args.arguments, lang) {
        Ok(Translation::Commands(translated)) => translated,
        Ok(Translation::Help(own)) => {
            return print(|printer| usage::help(compat::help(own.unwrap_or(lang)), printer));
        }
        Err(reason) => return print(|printer| usage::wrong(&reason, lang, printer)),
    };
    let line = |command: &Vec<String>| format!("pathbuild {}\n", compat::shown(command));
    if args.print {
        let lines: String = translated.iter().map(line).collect();
        return print(|printer| usage::help(&lines, printer));
    }
    let each = translated.iter().map(|command| {
        Printer::new(common.verbosity(), ColorChoice::Never).detail(line(command).trim_end());
        run(compat::replace_arguments(arguments, args.arguments.len(), command))
    });
    each.max().unwrap_or(ExitStatus::Success)
}

/// Language of messages about a command line that is not run; determined like that of any other.
pub(crate) fn lang_of(arguments: &[OsString]) -> Lang {
    let common = CommonArgs { lang: Cli::lang(arguments), ..CommonArgs::default() };
    context_of(&Cli { command: Command::Man, common }).0.lang()
}

/// Prints something that needs no configuration.
fn print(answer: impl FnOnce(&Printer) -> ExitStatus) -> ExitStatus {
    let printer = Printer::default();
    let status = answer(&printer);
    printer.finish(status)
}

fn execute(cli: &Cli) -> ExitStatus {
    if let Command::Watch(args) = &cli.command {
        return watching::run(cli, args);
    }
    let (context, faults) = context_of(cli);
    if let Some(refusal) = refusal(&context) {
        let status = context.usage(&refusal);
        return context.printer.finish(status);
    }
    context.begin();
    warn_about_unused_configuration(&context);
    if cli.command.reads_programs() {
        say_unexpected_configuration(&context);
    }
    let status = if faults.is_empty() || !cli.command.needs_configuration() {
        commands::run(&context, &cli.command)
    } else {
        context.refuse(faults)
    };
    let status = context.end(status);
    context.printer.finish(status)
}

/// Why options or the environment ask for something impossible.
fn refusal(context: &Context) -> Option<String> {
    context.output.refusal(context).or_else(|| environment::refusal(context))
}

/// Warns if the working directory's configuration does not apply to this run.
fn warn_about_unused_configuration(context: &Context) {
    if let Some(file) = context.unused_configuration() {
        let line = context.phrase(
            "note: {} does not apply to files outside its tree (give --config {} to apply it); no other configuration was found",
            "Hinweis: {} gilt nicht für Dateien außerhalb ihres Verzeichnisbaums (mit --config {} gilt sie doch); eine andere Konfiguration wurde nicht gefunden",
            file.as_str(),
        );
        context.printer.status(line);
    }
}

/// Tells which configuration applies to a program, unless it is obvious.
fn say_unexpected_configuration(context: &Context) {
    if let Some(file) = context.unexpected_configuration() {
        let configuration = context.choose("configuration", "Konfiguration");
        context.printer.status(format_args!("{configuration}: {}", shown::line(file.as_str())));
    }
}

/// Creates the context. Also returns diagnostics of the configuration.
fn context_of(cli: &Cli) -> (Context, Vec<Diagnostic>) {
    let Cli { command, common } = cli;
    let working_directory = working_directory();
    let (user, mut faults) =
        environment::user_configuration().map(|file| User::load(&OsSystem, &file)).unwrap_or_default();
    let overrides = Overrides { trusted: user.trusted, ..common.overrides() };
    let (settings, more) =
        config::load(&OsSystem::shared(), &overrides, &command.inputs(), &working_directory);
    faults.extend(more);
    let printer = Printer::new(common.verbosity(), common.color.unwrap_or_default());
    let printer = Rc::new(printer.with_stdout_taken(Output::new(command, common).takes_stdout()));
    let cache_home =
        || environment::cache_home(common.cache_dir.as_deref(), user.cache_dir, &working_directory);
    let workspace = Workspace {
        system: context::system_of(&settings),
        settings,
        own_lang: common.lang.map(Lang::from).or_else(environment::lang).or(user.lang),
        system_lang: environment::system_lang(),
        jobs: common.jobs,
        cache: if common.no_cache { None } else { cache_home() },
        working_directory,
        reporter: printer.clone(),
    };
    let context = Context::new(cli, overrides, printer, workspace);
    (context, faults)
}

/// The working directory; empty if it is unknown or not UTF-8, so that relative names stay relative.
#[expect(clippy::disallowed_methods, reason = "the only place where the program queries it")]
fn working_directory() -> Utf8PathBuf {
    let directory = std::env::current_dir().ok();
    directory.and_then(|directory| Utf8PathBuf::from_path_buf(directory).ok()).map(spelt).unwrap_or_default()
}
