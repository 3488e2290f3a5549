//! `pathbuild check`: checks every path of drawings or of the library, without writing anything. (book: reference/commands)

use std::time::Instant;

use pathbuild_api::CheckOptions;

use crate::args::CheckArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::report::conclude;
use crate::waivers;

/// Runs the command: checks the drawings and reports findings. With `--changed-since`, checks only what depends on changed files.
pub fn run(context: &Context, args: &CheckArgs) -> ExitStatus {
    let begun = Instant::now();
    if args.inputs.is_empty() && !context.has_library() {
        return context.refuse_empty_input();
    }
    let options = options(args);
    match context.library().and_then(|library| library.check_with(&args.inputs.to_inputs().texts(), &options))
    {
        Ok(report) => conclude(context, args, report, begun.elapsed()),
        Err(error) => context.show_request_error(error),
    }
}

fn options(args: &CheckArgs) -> CheckOptions {
    let mut options = CheckOptions::new().baseline(waivers::options(&args.waivers));
    options = args.changed_since.iter().fold(options, CheckOptions::changed_since);
    if args.all_bindings {
        options = options.all_values();
    }
    if args.timings { options.timings() } else { options }
}
