//! `pathbuild check`: checks every path of drawings or of the library, without writing anything. (book: reference/commands)

mod git;

use std::time::Instant;

use pathbuild_workspace::check::{EarlierFiles, InputsNotDirectories, Request};

use crate::args::CheckArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::report::conclude;

use git::RevisionFiles;

/// Runs the command.
pub fn run(context: &Context, args: &CheckArgs) -> ExitStatus {
    let begun = Instant::now();
    if args.inputs.inputs.is_empty() && !context.has_library() {
        return context.refuse_empty_input();
    }
    let revision_files = |revision: &String| RevisionFiles::new(context, &args.inputs, revision);
    let revision_files = match args.changed_since.as_ref().map(revision_files).transpose() {
        Ok(revision_files) => revision_files,
        Err(reason) => return context.usage(&reason),
    };
    let changed = revision_files.as_ref().map(|revision_files| revision_files as &dyn EarlierFiles);
    let request = Request { inputs: &args.inputs, with_all_values: args.all_bindings, changed };
    let mut session = request.session(context);
    if args.timings {
        session.timings().switch_on();
    }
    let checked = match request.run(&mut session) {
        Ok(checked) => checked,
        Err(InputsNotDirectories) => {
            return context.usage(context.choose(
                "--changed-since is for directories or the library, not for single drawings or paths",
                "--changed-since ist für Verzeichnisse oder die Bibliothek, nicht für einzelne Zeichnungen oder Pfade",
            ));
        }
    };
    let status = conclude(context, args, checked, begun.elapsed());
    if args.timings {
        for line in session.timings().lines(context.lang()) {
            context.printer.status(line);
        }
    }
    // Leak instead of dropping: freeing a million values takes longer than process exit.
    std::mem::forget(session);
    status
}
