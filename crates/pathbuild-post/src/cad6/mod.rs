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

pub(super) use definition::Definition;
pub(super) use program::foreseen;
use runner::Runner;

use super::PostOptions;
use super::job::{Job, Units};
use super::shadow::{Shadow, TranslatedText};
use super::target::Target;
use crate::findings::LineOrigin;
use crate::shadow::{CommentMarks, words};
use crate::target::Guard;

/// The output of the engine.
pub(super) struct EngineOutput {
    pub(super) text: Vec<u8>,
    /// The translation of the text to RS274.
    pub(super) shadow: TranslatedText,
    /// The origin of each line.
    pub(super) origins: Vec<LineOrigin>,
    /// Doubtful constructs.
    pub(super) warnings: Vec<Diagnostic>,
    /// The switch variables used by the texts that were called.
    pub(super) switches: Vec<&'static str>,
}

/// The variables that describe the state of spindle and coolant.
const SWITCHES: &[&str] = &["ToolControl1", "ToolControl2", "MillingSpindleDir", "SpinUpTime"];

/// Writes a job, which must contain operations.
pub(super) fn write(
    definition: &Definition,
    file: &Utf8Path,
    job: &Job,
    target: Option<&Target>,
    options: &PostOptions<'_>,
) -> Result<EngineOutput, Vec<Diagnostic>> {
    let guard = Guard::new(target, CommentMarks::default(), options.charset);
    let mut runner = Runner::new(definition, file, options.files, guard, options.most_bytes);
    program::run(job, target, options, &mut runner).map_err(|error| vec![*error])?;
    let called = &runner.called;
    let switches = SWITCHES.iter().copied().filter(|name| definition.uses_in(called, name)).collect();
    let (text, origins, warnings) = runner.finish();
    let shadow = translate(definition, &text, job.units);
    Ok(EngineOutput { text, shadow, origins, warnings, switches })
}

/// Translates a text to the words of RS274. `units` are those of the job, which apply if the definition names none.
pub(super) fn translate(definition: &Definition, text: &[u8], units: Units) -> TranslatedText {
    let mut shadow = Shadow::new(definition.units().unwrap_or(units), false);
    for line in text.split(|&byte| byte == b'\n') {
        let line = String::from_utf8_lossy(line);
        let code = line.find("//").map_or(&*line, |comment| &line[..comment]);
        shadow.line(&words(code, &CommentMarks::default()), None, false);
    }
    shadow.finish()
}
