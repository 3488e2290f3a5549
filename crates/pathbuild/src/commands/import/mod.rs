//! `pathbuild import`: summarizes a G-code program. (book: program/reading)

mod facts;
mod json;
mod text;

use crate::args::{Format, ImportArgs};
use crate::context::Context;
use crate::exit::ExitStatus;

use super::program::Program;
use facts::Facts;

/// Runs the command: prints the summary and the diagnostics of each program. A program with errors is summarized as far as it was read.
pub fn run(context: &Context, args: &ImportArgs) -> ExitStatus {
    let mut diagnostics = Vec::new();
    for file in &args.files {
        match Program::open(context, file, &args.reading) {
            Ok(program) => {
                let facts = Facts::new(context, &program);
                match context.format {
                    Format::Json => context.row("program", json::json(context, &facts)),
                    _ => context.printer.result(text::text(context, &facts)),
                }
                diagnostics.extend(program.read.problems);
            }
            Err(problem) => diagnostics.push(*problem),
        }
    }
    let findings = context.findings(diagnostics);
    context.show(&findings);
    if findings.errors() > 0 { ExitStatus::Errors } else { ExitStatus::Success }
}
