//! `pathbuild diff`: shows how changed drawings change the moves. (docs: "Comparing")

mod json;
mod markdown;
mod output;
mod page;
mod revision;
mod side;
mod text;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_workspace::diff::{Comparison, Outcome, PathDiff, Pictures, Tree, programs, trees};
use pathbuild_workspace::session::Session;

use crate::args::{DiffArgs, Format};
use crate::context::Context;
use crate::exit::ExitStatus;

use output::Output;
use side::{Drawings, Failure, Side};

/// Runs the command. Changes are not errors, but paths that can no longer be compared are.
pub fn run(context: &Context, args: &DiffArgs) -> ExitStatus {
    let output = match Output::of(context, args.output.as_deref()) {
        Ok(output) => output,
        Err(reason) => return context.usage(&reason),
    };
    let pictures = output.has_pictures().then(|| Pictures { lang: context.lang() });
    let compared = match side::sides(context, args) {
        Ok([Side::Drawings(old), Side::Drawings(new)]) => Ok(drawings(context, &old, &new, pictures)),
        Ok([Side::Program(old), Side::Program(new)]) => Ok(single(*old, *new, pictures)),
        Ok(_) => {
            return context.usage(context.choose(
                "a program is compared with a path or another program",
                "ein Programm wird mit einem Pfad oder einem anderen Programm verglichen",
            ));
        }
        Err(failure) => Err(failure),
    };
    let comparison = match compared {
        Ok(comparison) => comparison,
        Err(Failure::Usage(reason)) => return context.usage(&reason),
        Err(Failure::Refused(faults)) => return context.refuse(faults),
        Err(Failure::Found(problems)) => return context.fail(problems),
    };
    finish(context, &output, &comparison)
}

fn drawings(context: &Context, old: &Drawings, new: &Drawings, pictures: Option<Pictures>) -> Comparison {
    let mut sessions = [Session::new(&old.workspace), Session::new(&new.workspace)];
    let [before, after] = &mut sessions;
    let mut before = Tree { session: before, inputs: &old.inputs, root: &old.root };
    let mut after = Tree { session: after, inputs: &new.inputs, root: &new.root };
    let mut comparison = trees(&mut before, &mut after, pictures);
    for (problems, side) in comparison.problems.iter_mut().zip([old, new]) {
        side.name(context, problems);
    }
    comparison
}

/// Compares two programs, or a program and a path.
fn single(old: side::ComparedProgram, new: side::ComparedProgram, pictures: Option<Pictures>) -> Comparison {
    let changed = programs(&old.path, &new.path, pictures);
    let is_same = changed.groups.is_empty();
    let files = [&old, &new].map(|seen| Some(seen.path.file.clone().into()));
    let name = new.path.name.clone();
    let path = PathDiff { name, files, outcome: Outcome::Changed(Box::new(changed)) };
    let paths = if is_same { Vec::new() } else { vec![path] };
    Comparison { paths, looked_at: 1, problems: [old.problems, new.problems] }
}

fn finish(context: &Context, output: &Output, comparison: &Comparison) -> ExitStatus {
    let findings = context.findings(comparison.problems.concat());
    match context.format {
        Format::Json => json::rows(context, comparison),
        format if format.is_for_machines() => {}
        _ => context.printer.result(text::text(comparison, context.lang())),
    }
    context.show(&findings);
    if let Err(problem) = output.deliver(context, comparison) {
        return context.fail(vec![*problem]);
    }
    let is_broken = |path: &PathDiff| matches!(path.outcome, Outcome::Broken | Outcome::StillBroken);
    let has_errors = findings.diagnostics.iter().any(Diagnostic::is_error);
    if has_errors || comparison.paths.iter().any(is_broken) {
        ExitStatus::Errors
    } else {
        ExitStatus::Success
    }
}
