//! CamBam post-processor definitions (.cbpp): named templates with macros, and options. (book: program/posts)
//!
//! A [`Definition`] is read once. A `Plan` combines it with a program and checks all macros. A `Writer` expands the templates line by line
//! and reads each line back, because the next line depends on the state of the machine.

mod definition;
mod machine;
mod macros;
mod moves;
mod options;
pub(super) mod reference;
mod section;
mod template;
mod values;
mod writer;

use camino::Utf8Path;
use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Value};

use crate::PostOptions;
use crate::findings::EngineOutput;
use crate::job::{Job, Units};
use crate::line_words::words;
use crate::rs274_translation::{Rs274Translation, TranslatedText};
use crate::target::Target;
use definition::{Plan, is_built_in, macro_in_braces};
use macros::{Macro, State};
use template::Template;
use writer::Writer;

pub(super) use definition::Definition;

/// Writes a job, which must have at least one operation.
pub(super) fn write(
    definition: &Definition,
    file: &Utf8Path,
    job: &Job,
    target: Option<&Target>,
    options: &PostOptions<'_>,
) -> Result<EngineOutput, Vec<Diagnostic>> {
    let plan = Plan::new(definition, file, job, target, options)?;
    let one = |error: Box<Diagnostic>| vec![*error];
    let post_build = post_build(definition, file, job, options).map_err(one)?;
    let mut output = Writer::new(&plan).run().map_err(one)?;
    note_switches(&mut output, &plan);
    for ignored in options.macros.iter().filter(|own| is_built_in(&own.name)) {
        output.note(&posts::POST_SHADOWED_MACRO, "macro", &format!("${}", ignored.name));
    }
    match post_build {
        Some(command) if !options.run_post_build => {
            output.note(&posts::POST_BUILD_SKIPPED, "command", &command.join(" "));
        }
        command => output.post_build = command,
    }
    Ok(output)
}

/// Translates a program written with this definition into the words of RS274. A definition may have its own words for motions, which are not G words;
/// lines with such a word get the corresponding G word.
pub(super) fn translate(definition: &Definition, text: &[u8]) -> TranslatedText {
    let marks = definition.comment_marks();
    let own_words = definition.own_motions();
    let mut translation = Rs274Translation::new(Units::default(), definition.options.suppress_parser_errors);
    let has_bare_numbers =
        definition.options.add_line_numbers && definition.options.numbering.prefix.is_empty();
    let end = if definition.options.end_of_line.ends_with('\r') { b'\r' } else { b'\n' };
    for line in text.split(|&byte| byte == end) {
        let line = String::from_utf8_lossy(line);
        let code =
            if has_bare_numbers { line.trim_start_matches(|c: char| c.is_ascii_digit()) } else { &line };
        let motion =
            own_words.iter().find(|(_, word)| code.contains(word.as_str())).map(|(number, _)| *number);
        let mut words = words(code, &marks);
        if code.len() < line.len() {
            words.unusual_number_prefix = definition.options.numbering.unusual_number_prefix();
        }
        translation.line(code, &words, motion, false);
    }
    translation.finish()
}

/// Adds a note if the job states the coolant but no template contains `{$coolant}`, and one if the spindle needs time to reach its speed but no
/// template contains `{$spindle(up)}`.
fn note_switches(output: &mut EngineOutput, plan: &Plan<'_>) {
    let cools = plan.job.operations.iter().any(|operation| operation.coolant.is_some());
    let mut macros = plan.templates().flat_map(Template::macros);
    output.follows_coolant = macros.any(|(what, _)| *what == Macro::State(State::Coolant));
    if cools && !output.follows_coolant {
        output.note(&posts::COOLANT_NOT_WRITTEN, "macro", "{$coolant}");
    }
    let definition = plan.definition;
    if plan.options.spin_up > 0.0 && definition.switches_spindle() && !definition.waits_for_spindle() {
        output.note(&posts::SPIN_UP_NOT_WRITTEN, "macro", "{$spindle(up)}");
    }
}

/// Returns the command that a definition asks to run on the finished file, as a program and its arguments; `None` if the definition has no
/// command. This crate does not run it.
pub(super) fn post_build(
    definition: &Definition,
    file: &Utf8Path,
    job: &Job,
    options: &PostOptions<'_>,
) -> Result<Option<Vec<String>>, Box<Diagnostic>> {
    let command = definition.options.post_build_command.trim().trim_matches('"');
    if command.is_empty() {
        return Ok(None);
    }
    let default_output = || format!("{}.{}", job.name, definition.options.extension);
    let output = options.output.as_deref().map_or_else(default_output, str::to_owned);
    let mut words = vec![command.to_owned()];
    for argument in split_command_line(&definition.options.post_build_arguments) {
        // Macros are replaced after splitting, so that a path with spaces remains one argument.
        let argument = argument.replace("{$outfile}", &output).replace("{$cbfile.name}", &job.name);
        if let Some(start) = argument.find("{$") {
            let name = argument[start + 2..].split('}').next().unwrap_or("");
            let diagnostic = Diagnostic::new(&posts::UNKNOWN_COMMAND_MACRO)
                .quoting("macro", macro_in_braces(name))
                .quoting("section", "PostBuildCommandArgs");
            let known = ["outfile", "cbfile.name"].map(macro_in_braces);
            return Err(Box::new(diagnostic.with("known", known.iter().collect::<Value>()).in_file(file)));
        }
        words.push(argument);
    }
    Ok(Some(words))
}

/// Splits a command line at spaces. Double quotes group an argument. Backslashes are literal, as in Windows paths.
fn split_command_line(text: &str) -> Vec<String> {
    let mut arguments: Vec<String> = Vec::new();
    let mut is_quoted = false;
    let mut is_inside = false;
    for c in text.chars() {
        if c == '"' {
            is_quoted = !is_quoted;
        }
        let is_blank = c.is_whitespace() && !is_quoted;
        if !is_blank && !is_inside {
            arguments.push(String::new());
        }
        is_inside = !is_blank;
        if is_inside && c != '"' {
            arguments.last_mut().into_iter().for_each(|last| last.push(c));
        }
    }
    arguments
}

#[cfg(test)]
mod tests {
    use super::split_command_line;

    #[test]
    fn quotes_hold_an_argument_together() {
        assert_eq!(
            split_command_line(r#"TOUCH "C:\my files\x.nc"  -a"" "" b"#),
            ["TOUCH", r"C:\my files\x.nc", "-a", "", "b"]
        );
        assert!(split_command_line("  ").is_empty());
    }
}
