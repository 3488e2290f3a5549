//! The program `pathbuild`: arguments, configuration, how results are shown, exit status. What drawings mean is decided in the
//! crates below; this one holds no logic of theirs. (spec/05-command-line.md, spec/06-configuration.md)

pub mod args;
mod cache;
pub mod commands;
mod context;
mod exit;
pub mod printer;
pub mod progress;
pub mod render;
pub mod report;
mod usage;
mod watching;

use std::ffi::OsString;

use camino::Utf8PathBuf;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_workspace::{Workspace, config};
use std::rc::Rc;

pub use context::Context;
pub use exit::ExitStatus;

use args::{Cli, Command, CommonArgs, CompatArgs};
use commands::compat::{self, Translated};
use printer::{ColorChoice, Printer};

/// Runs the program with the arguments that the shell gave it, the first being its own name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitStatus {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    match Cli::read(&arguments) {
        Ok(Cli { command: Command::Compat(args), common }) => run_compat(&arguments, &args, &common),
        Ok(cli) => execute(&cli),
        Err(error) => print(|printer| usage::answer(&error, printer)),
    }
}

/// Runs what a command line of another program comes to.
fn run_compat(arguments: &[OsString], args: &CompatArgs, common: &CommonArgs) -> ExitStatus {
    let translated = match compat::translate(&args.arguments) {
        Ok(Translated::Arguments(translated)) => translated,
        Ok(Translated::Help) => return print(|printer| usage::help(compat::HELP, printer)),
        Err(reason) => return print(|printer| usage::wrong(&reason, printer)),
    };
    let line = format!("pathbuild {}", compat::shown(&translated));
    if args.print {
        return print(|printer| usage::help(&format!("{line}\n"), printer));
    }
    Printer::new(common.verbosity(), ColorChoice::Never).detail(line);
    run(compat::spliced(arguments, args.arguments.len(), &translated))
}

/// Prints what needs no configuration.
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
    let status = if faults.is_empty() || !cli.command.needs_configuration() {
        commands::run(&context, &cli.command)
    } else {
        context.refuse(faults)
    };
    context.printer.finish(status)
}

/// The surroundings, and what is wrong with the configuration.
fn context_of(Cli { command, common }: &Cli) -> (Context, Vec<Diagnostic>) {
    let working_directory = working_directory();
    let (settings, faults) = config::load(&common.overrides(), &command.inputs(), &working_directory);
    let printer = Rc::new(Printer::new(common.verbosity(), common.color.unwrap_or_default()));
    let workspace = Workspace {
        settings,
        jobs: common.jobs,
        cache: if common.no_cache {
            None
        } else {
            cache::home(common.cache_dir.as_deref(), &working_directory)
        },
        working_directory,
        reporter: printer.clone(),
    };
    let context = Context { printer, format: common.format.unwrap_or_default(), workspace };
    (context, faults)
}

/// The working directory; empty, so that relative names stay relative, where the system does not tell it or it is no UTF-8.
#[expect(clippy::disallowed_methods, reason = "this is where the program asks once")]
fn working_directory() -> Utf8PathBuf {
    let directory = std::env::current_dir().ok();
    directory.and_then(|directory| Utf8PathBuf::from_path_buf(directory).ok()).unwrap_or_default()
}
