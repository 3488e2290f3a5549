//! `pathbuild post`: rewrites a program for another machine, or shows the built-in posts. (book: program/posts)

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_post::BUILT_IN;
use serde_json::json;

use crate::args::{PostArgs, PostCommand};
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;
use pathbuild_workspace::config::number;
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor, run_post_build};
use pathbuild_workspace::rewrite::Request;

use super::report_output;

/// Runs the command: rewrites a program, or shows the built-in posts.
pub fn run(context: &Context, args: &PostArgs) -> ExitStatus {
    match (&args.command, &args.file) {
        (Some(PostCommand::List), _) => list(context),
        (Some(PostCommand::Show { name }), _) => show(context, name),
        (None, Some(file)) => rewrite(context, file, args),
        (None, None) => context.usage_error(context.choose(
            "post needs a program, or `list` or `show NAME`",
            "post braucht ein Programm, `list` oder `show NAME`",
        )),
    }
}

fn list(context: &Context) -> ExitStatus {
    for post in BUILT_IN {
        let language = post.language.name();
        if context.format == Format::Json {
            let row = json!({ "name": post.name, "language": language, "description": post.description });
            context.row("post", row);
            continue;
        }
        context.printer.result(format_args!("{:<10} {language:<14} {}\n", post.name, post.description));
    }
    ExitStatus::Success
}

fn show(context: &Context, name: &str) -> ExitStatus {
    match BUILT_IN.iter().find(|post| post.name == name) {
        Some(post) => {
            context.printer.result_bytes(post.text.as_bytes());
            ExitStatus::Success
        }
        None => context.fail(pathbuild_post::load(name).err().unwrap_or_default()),
    }
}

fn rewrite(context: &Context, file: &Utf8Path, args: &PostArgs) -> ExitStatus {
    if args.run_post_build && file_to_write(args).is_none() {
        return context.usage_error(context.choose(
            "--run-post-build needs a file: `-o FILE`",
            "--run-post-build braucht eine Datei: `-o DATEI`",
        ));
    }
    let arguments = PostArguments {
        date: args.date.map(|date| date.to_string().into()),
        dialect: args.target.as_deref().map(Into::into),
        run_post_build: args.run_post_build,
    };
    let post_processor = match PostProcessor::for_run(context, args.post.as_deref(), arguments) {
        Ok(Some(post_processor)) => post_processor,
        Ok(None) => {
            return context.usage_error(context.choose(
                "native programs can only be written from drawings: `pathbuild emit`",
                "native Programme lassen sich nur aus Zeichnungen schreiben: `pathbuild emit`",
            ));
        }
        Err(problems) => return context.fail(problems),
    };
    let surface = match args.surface.as_deref().map(|text| number("surface", text)).transpose() {
        Ok(surface) => surface,
        Err(fault) => return context.refuse(vec![*fault]),
    };
    let request = Request { file, reading: args.reading.options(), surface, to: file_to_write(args) };
    let mut diagnostics = Vec::new();
    if let Err(errors) = rewrite_and_report(context, &request, &post_processor, &mut diagnostics) {
        diagnostics.extend(errors);
        diagnostics.extend(context.lowered_error(&diagnostics));
        context.show(&context.findings(diagnostics));
        return ExitStatus::Errors;
    }
    context.conclude(diagnostics)
}

/// Rewrites the program and reports that it was written. Adds warnings to `diagnostics`. If there are errors, nothing is written.
fn rewrite_and_report(
    context: &Context,
    request: &Request<'_>,
    post_processor: &PostProcessor,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(), Vec<Diagnostic>> {
    let rewritten = request.run(context, post_processor, diagnostics)?;
    for note in &rewritten.output.notes {
        context.printer.status(note.text(context.lang()));
    }
    let Some(to) = request.to else {
        context.printer.result_bytes(&rewritten.output.text);
        return Ok(());
    };
    let written = rewritten.write(context, post_processor, to).map_err(|problem| vec![*problem])?;
    let state = report_output(context, to, written);
    context.printer.status(format_args!("{to}: {state}"));
    match &rewritten.output.post_build {
        Some(command) => run_post_build(command, to).map_err(|failure| vec![*failure]),
        None => Ok(()),
    }
}

/// Returns the file to write; `None` for standard output, which may also be given as `-o -`, as in `emit`.
fn file_to_write(args: &PostArgs) -> Option<&Utf8Path> {
    args.output.as_deref().filter(|file| *file != "-")
}
