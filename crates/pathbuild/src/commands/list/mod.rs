//! `pathbuild list` and `stats`: the paths of a library, and their totals. (book: reference/commands)

mod row;
mod stats;

use pathbuild_workspace::list::{PathListing, Request, Row, Stats, path_json, stats_json};
use pathbuild_workspace::posting::{PostArguments, PostProcessor};
use pathbuild_workspace::session::Session;

use crate::args::{Format, ListArgs};
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::table::table;

/// Prints one line per path.
pub fn list(context: &Context, args: &ListArgs) -> ExitStatus {
    show(context, args, |context, rows, _| match context.format {
        Format::Json => rows.iter().for_each(|row| {
            context.row("path", path_json(&context.file(&row.path.drawing), row));
        }),
        _ if rows.is_empty() => {}
        _ => {
            let cells = rows.iter().map(|row| row::cells(row, context));
            context.printer.result(table(&row::columns(context), cells));
        }
    })
}

/// Prints the totals of the paths.
pub fn stats(context: &Context, args: &ListArgs) -> ExitStatus {
    show(context, args, |context, rows, drawings| {
        let stats = Stats::of(rows, drawings);
        match context.format {
            Format::Json => context.row("statistics", stats_json(&stats)),
            _ => context.printer.result(stats::text(&stats, context)),
        }
    })
}

/// Lists and shows the paths. Only findings of directories and drawings are shown separately, since the errors of paths are part of the
/// list.
fn show(context: &Context, args: &ListArgs, print: impl FnOnce(&Context, &[Row], usize)) -> ExitStatus {
    let inputs = args.inputs();
    let post_processor = match PostProcessor::for_run(context, args.post.as_deref(), PostArguments::default())
    {
        Ok(post_processor) => post_processor,
        Err(problems) => return context.fail(problems),
    };
    let mut session = Session::new(context);
    let listed = Request { inputs: &inputs, post_processor: post_processor.as_ref() }.run(&mut session);
    // Leak instead of dropping: freeing all query results takes longer than process exit.
    std::mem::forget(session);
    let PathListing { paths, drawings, diagnostics } = match listed {
        Ok(listed) => listed,
        Err(reason) => return context.usage(&reason),
    };
    let rows: Vec<Row> = paths.into_iter().map(|path| Row::new(context, path)).collect();
    print(context, &rows, drawings);
    let findings = context.findings(diagnostics);
    context.show(&findings);
    if findings.errors() > 0 { ExitStatus::Errors } else { ExitStatus::Success }
}
