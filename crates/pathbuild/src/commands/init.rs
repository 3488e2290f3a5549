//! `pathbuild init`: a configuration with every key, commented.

use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::config::{FILE_NAME, template};
use pathbuild_workspace::files;

/// Writes it into the working directory, unless there is one.
pub fn run(context: &Context) -> ExitStatus {
    let file = context.working_directory.join(FILE_NAME);
    match files::create(&file, &template()) {
        Ok(()) => {
            context.printer.result_line(FILE_NAME);
            ExitStatus::Success
        }
        Err(reason) => context.fail(vec![*reason]),
    }
}
