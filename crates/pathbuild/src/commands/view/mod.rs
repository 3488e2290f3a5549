//! `pathbuild view`: shows a path, a drawing or a program. (docs: "Pictures")

mod output;
mod target;

use crate::args::ViewArgs;
use crate::context::Context;
use crate::exit::ExitStatus;

use output::Output;
use target::Failure;

/// Runs the command. Errors are shown in the picture.
pub fn run(context: &Context, args: &ViewArgs) -> ExitStatus {
    let output = match Output::of(context, args.output.as_deref()) {
        Ok(output) => output,
        Err(reason) => return context.usage(&reason),
    };
    let target = match target::target_scene(context, args) {
        Ok(scene) => scene,
        Err(Failure::Usage(reason)) => return context.usage(&reason),
        Err(Failure::Found(problems)) => return context.fail(problems),
    };
    let (scene, findings) = target.report.with_findings(context, &target.file);
    context.show(&findings);
    if let Err(problem) = output.deliver(context, &scene) {
        return context.fail(vec![*problem]);
    }
    if findings.errors() > 0 { ExitStatus::Errors } else { ExitStatus::Success }
}
