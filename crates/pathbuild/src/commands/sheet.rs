//! `pathbuild sheet`: creates a path's setup sheet for the machine operator. (book: program/sheet)

use pathbuild_diagnostic::escaping;
use pathbuild_workspace::Failure;
use pathbuild_workspace::config::types::SheetFormat;
use pathbuild_workspace::emit::{SheetOutcome, sheet_bytes, sheet_of};
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor};
use pathbuild_workspace::session::Session;

use super::picture_output::deliver;
use crate::args::SheetArgs;
use crate::context::Context;
use crate::exit::ExitStatus;

/// Runs the command. A path with errors gets no setup sheet.
///
/// # Errors
/// If the path, the format or the post-processor is unknown or broken.
pub fn run(context: &Context, args: &SheetArgs) -> Result<ExitStatus, Failure> {
    let format = match &args.output {
        None => SheetFormat::Html,
        Some(file) => match file.extension().unwrap_or_default().to_ascii_lowercase().as_str() {
            "pdf" => SheetFormat::Pdf,
            "html" => SheetFormat::Html,
            "svg" => SheetFormat::Svg,
            _ => {
                return Err(Failure::Usage(context.phrase(
                    "-o {}: the name must end in .pdf, .html or .svg",
                    "-o {}: der Name muss auf .pdf, .html oder .svg enden",
                    &escaping::line(file.as_str()),
                )));
            }
        },
    };
    let post_processor = PostProcessor::for_run(context, args.post.as_deref(), PostArguments::default());
    let post_processor = post_processor.map_err(Failure::Post)?;
    let outcome = sheet_of(&mut Session::new(context), post_processor.as_ref(), &args.what);
    let SheetOutcome { sheet, diagnostics } = outcome.map_err(Failure::Usage)?;
    let findings = context.findings(diagnostics);
    context.show(&findings);
    let Some(sheet) = sheet else { return Ok(ExitStatus::Errors) };
    let bytes = sheet_bytes(&sheet, format, context.lang());
    Ok(deliver(context, args.output.as_deref(), bytes, &findings))
}
