//! The command that a definition asks to run on the finished file, as a list of arguments. It is not run here.

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, messages::posts};

use super::definition::Definition;
use super::plan::framed;
use crate::PostOptions;
use crate::job::Job;

/// Returns the program and its arguments, or `None` if the definition has no command.
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
    for argument in split(&definition.options.post_build_arguments) {
        // Macros are replaced after splitting, so that a path with spaces remains one argument.
        let argument = argument.replace("{$outfile}", &output).replace("{$cbfile.name}", &job.name);
        if let Some(start) = argument.find("{$") {
            let name = argument[start + 2..].split('}').next().unwrap_or("");
            let diagnostic = Diagnostic::new(&posts::UNKNOWN_MACRO).quoting("macro", framed(name));
            return Err(Box::new(diagnostic.quoting("section", "PostBuildCommandArgs").in_file(file)));
        }
        words.push(argument);
    }
    Ok(Some(words))
}

/// Splits a command line at spaces. Double quotes group an argument. Backslashes are literal, as in Windows paths.
fn split(text: &str) -> Vec<String> {
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
    use super::split;

    #[test]
    fn quotes_hold_an_argument_together() {
        assert_eq!(
            split(r#"TOUCH "C:\my files\x.nc"  -a"" "" b"#),
            ["TOUCH", r"C:\my files\x.nc", "-a", "", "b"]
        );
        assert!(split("  ").is_empty());
    }
}
