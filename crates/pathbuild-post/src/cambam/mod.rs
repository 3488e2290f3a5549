//! CamBam post-processor definitions (.cbpp): named templates with macros, and options. (book: program/posts)
//!
//! A [`Definition`] is read once. A `Plan` combines it with a program and checks all macros. A `Writer` expands the templates line by line
//! and reads each line back, because the next line depends on the state of the machine.

mod circular;
mod command;
mod cycles;
mod definition;
mod fuel;
mod line;
mod lines;
mod machine;
mod macros;
mod move_values;
mod moves;
mod names;
mod options;
mod plan;
pub(super) mod reference;
mod registers;
mod section;
mod states;
mod template;
mod values;
mod writer;

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;

pub(super) use definition::Definition;
use macros::{Macro, State};
use plan::Plan;
use template::Template;
use writer::{Writer, WrittenText};

use super::PostOptions;
use super::job::{Job, Units};
use super::shadow::{Shadow, TranslatedText};
use super::target::Target;
use super::words::words;

/// Writes a job, which must contain operations.
pub(super) fn write(
    definition: &Definition,
    file: &Utf8Path,
    job: &Job,
    target: Option<&Target>,
    options: &PostOptions<'_>,
) -> Result<EngineOutput, Vec<Diagnostic>> {
    let plan = Plan::new(definition, file, job, target, options)?;
    let one = |error: Box<Diagnostic>| vec![*error];
    let post_build = command::post_build(definition, file, job, options).map_err(one)?;
    let text = Writer::new(&plan).run().map_err(one)?;
    Ok(EngineOutput { text, post_build, leaves_out_coolant: leaves_out_coolant(&plan) })
}

/// What a text of this definition says, in the words of RS274. A line that has the definition's own word for a motion, which is no G word,
/// moves so.
pub(super) fn translate(definition: &Definition, text: &[u8]) -> TranslatedText {
    let marks = definition.comment_marks();
    let own_words = definition.own_motions();
    let mut shadow = Shadow::new(Units::default(), definition.options.absolute_centres);
    for line in text.split(|&byte| byte == b'\n') {
        let line = String::from_utf8_lossy(line);
        let motion =
            own_words.iter().find(|(_, word)| line.contains(word.as_str())).map(|(number, _)| *number);
        shadow.line(&words(&line, &marks), motion, false);
    }
    shadow.finish()
}

/// The output of the engine.
pub(super) struct EngineOutput {
    pub(super) text: WrittenText,
    /// The command given in the definition.
    pub(super) post_build: Option<Vec<String>>,
    /// Whether the program sets the coolant, but the definition has no macro for it.
    pub(super) leaves_out_coolant: bool,
}

fn leaves_out_coolant(plan: &Plan<'_>) -> bool {
    let writes_it =
        || plan.templates().flat_map(Template::macros).any(|(what, _)| *what == Macro::State(State::Coolant));
    plan.job.operations.iter().any(|operation| operation.coolant.is_some()) && !writes_it()
}
