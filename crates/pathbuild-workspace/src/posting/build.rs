//! Runs the command that a post-processor requests for its output. (book: program/posts: as a list of arguments, no shell)

use std::process::{Command, Stdio};

use camino::Utf8Path;
use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Value};

/// Runs the command in the directory of the file and waits for it. Its output goes to stderr, since stdout is for results.
///
/// # Errors
/// If it cannot be started, or exits with a status other than 0.
pub fn run_post_build(command: &[String], file: &Utf8Path) -> Result<(), Box<Diagnostic>> {
    let Some((program, arguments)) = command.split_first() else { return Ok(()) };
    let mut run = Command::new(program);
    run.args(arguments).stdin(Stdio::null()).stdout(std::io::stderr());
    let failed = |reason: Value| {
        let diagnostic = Diagnostic::new(&posts::POST_BUILD_FAILED).quoting("command", command.join(" "));
        Box::new(diagnostic.with("reason", reason).in_file(file))
    };
    match run.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(failed(Value::foreign(status))),
        Err(error) => Err(failed(Value::foreign(error))),
    }
}
