//! Control texts as in CAD6's CAM module: texts with variables and statements that are called in a fixed order.
//! (book: reference/post-definitions)
//!
//! A [`Definition`] is read once. `calls` turns a job into calls, `program` sets the variables of each call, and a `Runner` executes it in
//! two phases: it replaces variables by their values, then statements by their results.

mod calls;
mod control_text;
mod definition;
mod evaluate;
mod expand;
mod numbers;
mod program;
pub(super) mod reference;
mod runner;
mod term;
mod variables;

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::posts;
use pathbuild_motion::{Coolant, Turning};

pub(super) use definition::Definition;
pub(super) use program::inserted_files;
use runner::Runner;

use super::PostOptions;
use super::job::{Job, Units};
use super::rs274_translation::{Rs274Translation, TranslatedText};
use super::target::Target;
use crate::findings::EngineOutput;
use crate::line_words::{CommentMarks, words};
use crate::target::TextInserter;

/// Writes a job, which must have at least one operation.
pub(super) fn write(
    definition: &Definition,
    file: &Utf8Path,
    job: &Job,
    target: Option<&Target>,
    options: &PostOptions<'_>,
) -> Result<EngineOutput, Vec<Diagnostic>> {
    let inserter = TextInserter::new(target, CommentMarks::default(), options.charset);
    let mut runner = Runner::new(definition, file, options.files, inserter, options.most_bytes);
    program::run(job, target, options, &mut runner).map_err(|error| vec![*error])?;
    let called = std::mem::take(&mut runner.called);
    let mut output = runner.finish(job.units);
    let uses = |name: &str| definition.uses_in(&called, name);
    note_switches(&mut output, uses, job, options.spin_up);
    Ok(output)
}

/// Adds a note for each function that the job switches (coolant, spindle) but the called texts do not. `uses` returns whether the texts
/// use a variable.
fn note_switches(output: &mut EngineOutput, uses: impl Fn(&str) -> bool, job: &Job, spin_up: f64) {
    let cools = job.operations.iter().any(|operation| operation.coolant.is_some_and(Coolant::is_on));
    let turns = job.operations.iter().any(|operation| operation.spindle.is_some_and(Turning::is_on));
    output.follows_coolant = uses("ToolControl1") || uses("ToolControl2");
    if cools && !output.follows_coolant {
        output.note(&posts::COOLANT_NOT_WRITTEN, "macro", "~ToolControl1~");
    }
    if turns && spin_up > 0.0 && uses("MillingSpindleDir") && !uses("SpinUpTime") {
        output.note(&posts::SPIN_UP_NOT_WRITTEN, "macro", "~SpinUpTime~");
    }
    if turns && !uses("MillingSpindleDir") {
        output.note(&posts::SPINDLE_NOT_WRITTEN, "macro", "~MillingSpindleDir~");
    }
}

/// Translates a text to the words of RS274. `units` are the units of the job, which apply if the definition names none.
pub(super) fn translate(definition: &Definition, text: &[u8], units: Units) -> TranslatedText {
    let has_other_lines = definition.settings.suppress_parser_errors;
    let mut translation = Rs274Translation::new(definition.units().unwrap_or(units), has_other_lines);
    for line in text.split(|&byte| byte == b'\n') {
        let line = String::from_utf8_lossy(line);
        let code = line.find("//").map_or(&*line, |comment| &line[..comment]);
        translation.line(&line, &words(code, &CommentMarks::default()), None, false);
    }
    translation.finish()
}
