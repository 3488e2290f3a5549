//! `pathbuild post`: rewrites a program for another machine, or shows the built-in posts. (book: program/posts)

use camino::Utf8Path;
use pathbuild_diagnostic::messages::{gcode, posts};
use pathbuild_diagnostic::{Code, Diagnostic, Severity};
use pathbuild_gcode::adjust::first_open_formula;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::{CuttingTool, HeaderReader};
use pathbuild_gcode::native::path_of_title;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_motion::{Action, Step};
use pathbuild_post::{
    BUILT_IN, Job, NativeCutter, Output, Remark, ToolTable, altered_words, is_of_head, native_remark,
};
use serde_json::json;

use crate::args::{PostArgs, PostCommand};
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;
use pathbuild_workspace::Failure;
use pathbuild_workspace::config::number;
use pathbuild_workspace::emit::program_of_other_path;
use pathbuild_workspace::files::write_error;
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor, complete_tools, run_post_build};
use pathbuild_workspace::program::Program;
use pathbuild_workspace::protected_files::{reason_to_keep_input, reason_to_keep_source, replace_error};
use pathbuild_workspace::session::Session;
use pathbuild_workspace::verify::{Verifier, VerifyOptions};

use super::output_state;

/// Runs the command: rewrites a program, or shows the built-in posts.
pub fn run(context: &Context, args: &PostArgs) -> ExitStatus {
    match (&args.command, &args.file) {
        (Some(PostCommand::List), _) => list(context),
        (Some(PostCommand::Show { name }), _) => show(context, name),
        (None, Some(file)) => rewrite(context, file, args),
        (None, None) => context.usage(context.choose(
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
        return context.usage(context.choose(
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
            return context.usage(context.choose(
                "native programs can only be written from drawings: `pathbuild emit`",
                "native Programme lassen sich nur aus Zeichnungen schreiben: `pathbuild emit`",
            ));
        }
        Err(problems) => return context.fail(problems),
    };
    let mut diagnostics = Vec::new();
    if let Err(errors) = rewrite_and_report(context, file, args, &post_processor, &mut diagnostics) {
        diagnostics.extend(errors);
        diagnostics.extend(context.lowered_error(&diagnostics));
        context.show(&context.findings(diagnostics));
        return ExitStatus::Errors;
    }
    context.conclude(diagnostics)
}

/// Reads the program, writes its new version and reports that it was written. Adds warnings to `diagnostics`. If there are errors, nothing
/// is written.
fn rewrite_and_report(
    context: &Context,
    file: &Utf8Path,
    args: &PostArgs,
    post_processor: &PostProcessor,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(), Vec<Diagnostic>> {
    let mut program =
        Program::open(context, file, args.reading.options()).map_err(|problem| vec![*problem])?;
    program.read.problems.iter_mut().for_each(refuse_machine_value);
    refuse_cut_off(&mut program);
    if program.read.problems.iter().any(Diagnostic::is_error) {
        return Err(program.read.problems);
    }
    let given = args.surface.as_deref().map(|text| number("surface", text)).transpose();
    let given = given.map_err(|fault| vec![*fault])?;
    diagnostics.extend(findings(context, args, &program, given, post_processor.reader())?);
    if context.has_error(&*diagnostics) {
        return Err(Vec::new());
    }
    let steps = std::mem::take(&mut program.read.steps);
    // In native programs only G38.3 can be replaced, which `emit` also does without a warning.
    if program.dialect != Dialect::Native {
        let mut altered = altered_words(&steps);
        program.place_own(&mut altered);
        diagnostics.extend(altered);
    }
    let of_header = || Provenance::of_head(&program.text).and_then(|(provenance, _)| provenance.thickness);
    let surface = given.or_else(of_header);
    let to = file_to_write(args);
    let output = output(&program, steps, post_processor, surface, to).map_err(|mut problems| {
        program.place_own(&mut problems);
        problems
    })?;
    diagnostics.extend(output.warnings.iter().cloned());
    if context.has_error(&*diagnostics) {
        return Err(Vec::new());
    }
    for note in &output.notes {
        context.printer.status(note.text(context.lang()));
    }
    let Some(to) = to else {
        context.printer.result_bytes(&output.text);
        return Ok(());
    };
    let reason = reason_to_keep_source(context, Some(post_processor), to)
        .or_else(|| reason_to_keep_input(context, file, to))
        .or_else(|| program_of_other_path(context, to, &program.text));
    if let Some(reason) = reason {
        return Err(vec![replace_error(to, reason)]);
    }
    let written = context.system.write(to, &output.text).map_err(|reason| vec![write_error(to, reason)])?;
    let state = output_state(context, to, written);
    context.printer.status(format_args!("{to}: {state}"));
    match &output.post_build {
        Some(command) => run_post_build(command, to).map_err(|failure| vec![*failure]),
        None => Ok(()),
    }
}

/// Returns the findings of `verify` about the program, except those about things that the post-processor adds or completes. Rapid moves are judged
/// as the target makes them.
fn findings(
    context: &Context,
    args: &PostArgs,
    program: &Program,
    surface: Option<f64>,
    target: Option<Dialect>,
) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
    let reading = args.reading.options();
    let options = VerifyOptions { reading, surface, target, ..VerifyOptions::default() };
    let mut session = Session::new(context);
    // Usage errors only concern the drawing to compare with, and there is none.
    let verifier = Verifier::new(&mut session, options).map_err(Failure::into_diagnostics)?;
    let mut found = verifier.findings(program);
    found.retain(|problem| !is_judged_in_output(problem) && problem.message != &gcode::BYTE_ORDER_MARK);
    found.iter_mut().for_each(report_as_left_out);
    let is_bent = |problem: &&mut Diagnostic| problem.message == &gcode::BENT_RAPID;
    for bent in found.iter_mut().filter(is_bent).filter(|_| target.is_some()) {
        bent.severity = Severity::Error;
    }
    Ok(found)
}

/// Whether a finding is about something that the post-processor adds or completes (the spindle, tools of the table, the end of the
/// program), that it judges in its own output (the travel of the machine), or that is an error of `post` (heights to be corrected).
fn is_judged_in_output(problem: &Diagnostic) -> bool {
    matches!(
        problem.code(),
        Code::EndNotRaised
            | Code::SpindleOff
            | Code::SpindleSpeed
            | Code::OutsideMachine
            | Code::UnknownTool
            | Code::SpindleLeftOn
            | Code::UncorrectedHeights
    )
}

/// Returns the file to write; `None` for standard output, which may also be given as `-o -`, as in `emit`.
fn file_to_write(args: &PostArgs) -> Option<&Utf8Path> {
    args.output.as_deref().filter(|file| *file != "-")
}

/// Replaces the message that a word is not checked with the message that it is left out, because the post does not write it either.
fn report_as_left_out(problem: &mut Diagnostic) {
    if problem.message == &gcode::FOREIGN_WORD {
        problem.message = &gcode::WORD_LEFT_OUT;
    }
}

/// Converts the warnings about a value or a height that only the machine knows to errors, because the post would write an assumed number.
fn refuse_machine_value(problem: &mut Diagnostic) {
    if problem.message == &gcode::MACHINE_VALUE {
        problem.message = &posts::JOB_MACHINE_VALUE;
        problem.severity = Severity::Error;
    } else if problem.message == &gcode::RETRACT_NOT_STATED {
        problem.severity = Severity::Error;
    }
}

/// Makes it an error that a program of pathbuild has no end: the file was cut off, and its new version would look complete.
fn refuse_cut_off(program: &mut Program) {
    if Provenance::of_head(&program.text).is_none() {
        return;
    }
    let problems = program.read.problems.iter_mut();
    for problem in problems.filter(|problem| problem.message == &gcode::NO_END) {
        problem.severity = Severity::Error;
    }
}

/// Returns the output of the post-processor for an error-free program. `surface` is the height in mm of the material's upper face, if it
/// is known.
fn output(
    program: &Program,
    steps: Vec<Step>,
    post_processor: &PostProcessor,
    surface: Option<f64>,
    to: Option<&Utf8Path>,
) -> Result<Output, Vec<Diagnostic>> {
    if let Some(line) = first_open_formula(&program.text).filter(|_| program.dialect == Dialect::Native) {
        return Err(vec![Diagnostic::new(&posts::POST_UNADJUSTED).at_line(line, None)]);
    }
    let head = Provenance::of_head(&program.text);
    let remark: fn(&str) -> Remark<'_> = match (program.dialect, &head) {
        (Dialect::Native, _) => native_remark,
        (_, Some(_)) => |text| if is_of_head(text) { Remark::Goes } else { Remark::Stays },
        (_, None) => |_| Remark::Stays,
    };
    let native_cutters = if program.dialect == Dialect::Native { native_cutters(&steps) } else { Vec::new() };
    let name = program.file.file_stem().unwrap_or_default();
    let mut job = Job::from_steps(name, &steps, program.dialect, &remark)?;
    let mut header = HeaderReader::default();
    for step in &steps {
        header.step(step);
    }
    drop(steps);
    if let Some((provenance, title)) = head {
        // The new program has the same provenance as the one that was read, except for the dialect.
        job.remarks =
            vec![Provenance { dialect: post_processor.reader(), ..provenance }.to_string().into(), title];
    }
    if let Some(surface) = surface {
        job.set_surface(surface);
    }
    job.centre_arcs();
    if let Some(feed) = post_processor.feed() {
        job.set_missing_feeds(feed);
    }
    let stated = header.finish(program.inch_word()).tools;
    let unknown = complete_tools_of_job(&mut job, &native_cutters, &post_processor.tools, &stated)
        .map_err(|problem| vec![*problem])?;
    let mut output = post_processor.write(&job, to, &mut Vec::new())?;
    let located = |warning: Diagnostic| post_processor.locate(warning.in_file(&program.file));
    output.warnings.extend(unknown.into_iter().map(located));
    Ok(output)
}

/// Returns the cutters that the heads of native programs state. A file has several heads if programs were joined by hand.
fn native_cutters(steps: &[Step]) -> Vec<NativeCutter> {
    let comments = steps.iter().filter_map(|step| match &step.action {
        Action::Comment(text) => Some((step.line, &**text)),
        _ => None,
    });
    let mut cutters: Vec<NativeCutter> = Vec::new();
    let mut is_after_head = false;
    for (line, text) in comments {
        if let Some(cutter) = text.trim().parse().ok().and_then(|head: Provenance| head.cutter) {
            cutters.push(NativeCutter { line, path: None, diameter: cutter });
            is_after_head = true;
        } else if let Some(cutter) = cutters.last_mut().filter(|_| is_after_head) {
            cutter.path = path_of_title(text.trim()).map(str::to_owned);
            is_after_head = false;
        }
    }
    cutters
}

/// Completes the tools of a job from the tool table: by their numbers, or for a native program by the path and the cutter O in its header. Tools that
/// the table lacks are as the program states them. Returns warnings about the tools.
///
/// # Errors
/// PB765 if the tool of a native program is unclear.
fn complete_tools_of_job(
    job: &mut Job,
    native_cutters: &[NativeCutter],
    tools: &ToolTable,
    stated: &[CuttingTool],
) -> Result<Vec<Diagnostic>, Box<Diagnostic>> {
    let tools = tools.with_numbers();
    if native_cutters.is_empty() {
        return Ok(complete_tools(job, &tools, stated));
    }
    let unknown = job.set_cutter(native_cutters, &tools)?;
    let by_number = complete_tools(job, &tools, &[]);
    Ok(if unknown.is_empty() { by_number } else { unknown })
}
