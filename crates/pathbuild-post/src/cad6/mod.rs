//! Control texts as CAD6's CAM module has them: texts with variables and statements, called in a fixed order.
//! (`reference/cad6_xpertmill_gcode.md`, section 1)
//!
//! A [`Definition`] is read once. `calls` turns a job into calls, `program` sets the variables of each, and a `Runner` makes it in two
//! phases: variables are replaced by their texts, then statements by their results.

mod abilities;
mod call;
mod calls;
mod control_text;
mod definition;
mod evaluate;
mod expand;
mod fault;
mod functions;
mod insert;
mod lints;
mod marks;
mod numbers;
mod program;
mod report;
mod runner;
mod settings;
mod statements;
mod term;
mod variables;

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;

pub(super) use definition::Definition;
use runner::Runner;

use super::PostOptions;
use super::job::Job;

/// What the engine wrote.
pub(super) struct Written {
    pub(super) text: Vec<u8>,
    /// What is doubtful in it.
    pub(super) warnings: Vec<Diagnostic>,
    /// Files that are part of it.
    pub(super) inserted: Vec<Box<str>>,
}

/// Writes a job that has operations.
pub(super) fn write(
    definition: &Definition,
    file: &Utf8Path,
    job: &Job,
    options: &PostOptions<'_>,
) -> Result<Written, Vec<Diagnostic>> {
    let mut runner = Runner::new(definition, file, options.files);
    program::run(job, options, &mut runner).map_err(|error| vec![*error])?;
    let (text, warnings, inserted) = runner.finish();
    Ok(Written { text, warnings, inserted })
}
