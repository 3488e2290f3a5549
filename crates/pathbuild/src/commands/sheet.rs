//! `pathbuild sheet`: creates a path's setup sheet for the machine operator. (book: program/sheet)

use pathbuild_diagnostic::shown;
use pathbuild_workspace::config::types::SheetFormat;
use pathbuild_workspace::emit::{SheetOutcome, sheet_bytes, sheet_of};
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor};
use pathbuild_workspace::session::Session;

use super::picture_output::deliver;
use crate::args::SheetArgs;
use crate::context::Context;
use crate::exit::ExitStatus;

/// Runs the command. A path with errors gets no setup sheet.
pub fn run(context: &Context, args: &SheetArgs) -> ExitStatus {
    let format = match &args.output {
        None => SheetFormat::Html,
        Some(file) => match file.extension().unwrap_or_default().to_ascii_lowercase().as_str() {
            "pdf" => SheetFormat::Pdf,
            "html" => SheetFormat::Html,
            "svg" => SheetFormat::Svg,
            _ => {
                let file = shown::line(file.as_str());
                return context.usage(&context.phrase(
                    "-o {}: the name must end in .pdf, .html or .svg",
                    "-o {}: der Name muss auf .pdf, .html oder .svg enden",
                    &file,
                ));
            }
        },
    };
    let post_processor = match PostProcessor::for_run(context, args.post.as_deref(), PostArguments::default())
    {
        Ok(post_processor) => post_processor,
        Err(problems) => return context.fail(problems),
    };
    let mut session = Session::new(context);
    let outcome = match sheet_of(&mut session, post_processor.as_ref(), &args.what) {
        Ok(outcome) => outcome,
        Err(refusal) => return context.usage(&refusal),
    };
    let SheetOutcome { sheet, diagnostics } = outcome;
    let findings = context.findings(diagnostics);
    context.show(&findings);
    let Some(sheet) = sheet else { return ExitStatus::Errors };
    let bytes = sheet_bytes(&sheet, format, context.lang());
    deliver(context, args.output.as_deref(), bytes, &findings)
}
