//! The program `pathbuild`: arguments, configuration, output and exit status. Other crates decide what drawings mean. (book:
//! reference/commands, book: reference/configuration)

pub mod args;
pub mod commands;
mod context;
mod environment;
mod exit;
pub mod german;
mod output;
pub mod printer;
pub mod render;
pub mod report;
#[cfg(feature = "serve")]
mod serving;
#[cfg(not(feature = "serve"))]
#[path = "serving/missing.rs"]
mod serving;
mod text;
mod waivers;
mod watching;

use std::ffi::OsString;

use clap_complete::env::CompleteEnv;
use pathbuild_diagnostic::{Lang, escaping};

pub use context::Context;
pub use exit::ExitStatus;

use args::completions::VARIABLE;
use args::{Cli, Command, CommonArgs, CompatArgs};
use commands::compat::{self, Translation};
use printer::{ColorChoice, Printer};

/// Runs the program with its command-line arguments, the first of which is the program's own name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitStatus {
    let arguments = compat::with_separator(arguments.into_iter().collect());
    if let Some(status) = complete(&arguments) {
        return status;
    }
    match Cli::read(&arguments) {
        Ok(Cli { command: Command::Compat(args), common }) => run_compat(&arguments, &args, &common),
        Ok(_) if let Some(number) = arguments.iter().position(|argument| argument.is_empty()) => {
            let lang = lang_of(&arguments);
            print_answer(|printer| {
                german::print_usage_error(&empty_argument_error(number, lang), lang, printer)
            })
        }
        Ok(cli) => execute(&cli),
        Err(error) => {
            let lang = lang_of(&arguments);
            // Parse again with the German definition to get the error message in German.
            let message = Cli::matches(&german::command(lang), &arguments).err().unwrap_or(error);
            print_answer(|printer| german::print_clap_error(&message, lang, printer))
        }
    }
}

/// Returns the error for an empty argument, as in a script with an unset variable. Taken as the name of a file, an empty argument would mean the
/// working directory, and the script would write all programs instead of one.
fn empty_argument_error(number: usize, lang: Lang) -> String {
    match lang {
        Lang::En => format!(
            "argument {number} is empty: write `.` for the working directory; in a script, check that all variables are set"
        ),
        Lang::De => format!(
            "Argument {number} ist leer: für das Arbeitsverzeichnis `.` schreiben; in einem Skript prüfen, ob alle Variablen gesetzt sind"
        ),
    }
}

/// Answers a shell's request for completions; `None` if this is an ordinary run.
fn complete(arguments: &[OsString]) -> Option<ExitStatus> {
    let definition = || german::command(lang_of(arguments));
    match CompleteEnv::with_factory(definition).var(VARIABLE).try_complete(arguments, None) {
        Ok(false) => None,
        Ok(true) => Some(ExitStatus::Success),
        Err(_) => Some(ExitStatus::Usage),
    }
}

/// Translates a command line of `PathDxf2GCode` or `PathGCodeAdjustZ` and runs the resulting commands.
fn run_compat(arguments: &[OsString], args: &CompatArgs, common: &CommonArgs) -> ExitStatus {
    let lang = lang_of(arguments);
    let translated = match compat::translate(&args.arguments, lang) {
        Ok(Translation::Commands(translated)) => translated,
        Ok(Translation::Help(own)) => {
            return print_answer(|printer| german::help(compat::help(own.unwrap_or(lang)), printer));
        }
        Err(reason) => return print_answer(|printer| german::print_usage_error(&reason, lang, printer)),
    };
    let line = |command: &Vec<String>| format!("pathbuild {}\n", compat::shell_command_line(command));
    if args.print {
        let lines: String = translated.iter().map(line).collect();
        return print_answer(|printer| german::help(&lines, printer));
    }
    let each = translated.iter().map(|command| {
        Printer::new(common.verbosity(), ColorChoice::Never).detail(line(command).trim_end());
        run(compat::replace_arguments(arguments, args.arguments.len(), command))
    });
    each.max().unwrap_or(ExitStatus::Success)
}

/// Returns the language of messages about a command line that is not run. It is determined like that of any other command line.
pub(crate) fn lang_of(arguments: &[OsString]) -> Lang {
    let common = CommonArgs { lang: Cli::lang(arguments), ..CommonArgs::default() };
    Context::of(&Cli { command: Command::Man, common }).0.lang()
}

/// Prints an answer that does not depend on the configuration.
fn print_answer(answer: impl FnOnce(&Printer) -> ExitStatus) -> ExitStatus {
    let printer = Printer::default();
    let status = answer(&printer);
    printer.finish(status)
}

fn execute(cli: &Cli) -> ExitStatus {
    if let Command::Watch(args) = &cli.command {
        return watching::run(cli, args);
    }
    let (context, faults) = Context::of(cli);
    if let Some(refusal) = context.refusal() {
        let status = german::print_usage_error(&refusal, context.lang(), &context.printer);
        return context.printer.finish(status);
    }
    context.begin();
    context.warn_about_unused_configuration();
    if cli.command.reads_programs() {
        report_unexpected_configuration(&context);
    }
    let status = if faults.is_empty() || !cli.command.needs_configuration() {
        commands::run(&context, &cli.command)
    } else {
        context.refuse(faults)
    };
    let status = context.end(status);
    context.printer.finish(status)
}

/// Reports which configuration applies to a program, unless it is obvious.
fn report_unexpected_configuration(context: &Context) {
    if let Some(file) = context.unexpected_configuration() {
        let configuration = context.choose("configuration", "Konfiguration");
        context.printer.status(format_args!("{configuration}: {}", escaping::line(file.as_str())));
    }
}
