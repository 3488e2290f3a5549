//! `post`: rewrites a program for another machine. (book: program/posts)

use camino::Utf8Path;
use pathbuild_db::system::WriteOutcome;
use pathbuild_diagnostic::messages::{gcode, posts};
use pathbuild_diagnostic::{Code, Diagnostic, Severity};
use pathbuild_gcode::adjust::first_unapplied_formula;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::CuttingTool;
use pathbuild_gcode::native::path_of_title;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_motion::{Action, Step};
use pathbuild_post::{
    Job, NativeCutter, Output, Remark, ToolTable, altered_word_warnings, is_head_comment, native_remark,
};

use crate::emit::program_of_other_path;
use crate::files::write_error;
use crate::post_processor::{PostProcessor, complete_tools};
use crate::program::{Program, ReadingOptions};
use crate::protected_files::{reason_to_keep_input, reason_to_keep_source, replace_error};
use crate::session::Session;
use crate::verify::{Verifier, VerifyOptions};
use crate::workspace::{Failure, Workspace};

/// A request to rewrite a program for another machine.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// The program to read.
    pub file: &'a Utf8Path,
    /// Options for reading it.
    pub reading: ReadingOptions,
    /// Height in mm of the material's upper face; if `None`, it is taken from the program, provided that the program states it.
    pub surface: Option<f64>,
    /// The file that is going to be written; `None` for standard output.
    pub to: Option<&'a Utf8Path>,
}

/// The new version of a program, which is not written yet.
#[derive(Debug)]
pub struct NewVersion {
    /// What the post-processor wrote.
    pub output: Output,
    /// The program that was read.
    program: Program,
}

impl NewVersion {
    /// Replaces a file, unless it is a source, the program that was read, or the program of another path.
    ///
    /// # Errors
    /// PB004 with the reason why the file cannot be written.
    pub fn write(
        &self,
        workspace: &Workspace,
        post_processor: &PostProcessor,
        to: &Utf8Path,
    ) -> Result<WriteOutcome, Box<Diagnostic>> {
        let reason = reason_to_keep_source(workspace, Some(post_processor), to)
            .or_else(|| reason_to_keep_input(workspace, &self.program.file, to))
            .or_else(|| program_of_other_path(workspace, to, &self.program.text));
        if let Some(reason) = reason {
            return Err(Box::new(replace_error(to, reason)));
        }
        workspace.system.write(to, &self.output.text).map_err(|reason| Box::new(write_error(to, reason)))
    }
}

impl Request<'_> {
    /// Reads the program and generates its new version. Adds warnings to `diagnostics`.
    ///
    /// # Errors
    /// The errors of the program or of its new version; an empty list if `diagnostics` already contains the error.
    pub fn run(
        &self,
        workspace: &Workspace,
        post_processor: &PostProcessor,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<NewVersion, Vec<Diagnostic>> {
        let mut program =
            Program::open(workspace, self.file, self.reading).map_err(|problem| vec![*problem])?;
        program.read.problems.iter_mut().for_each(refuse_machine_value);
        refuse_cut_off(&mut program);
        if program.read.problems.iter().any(Diagnostic::is_error) {
            return Err(program.read.problems);
        }
        diagnostics.extend(self.findings(workspace, &program, post_processor.reading_dialect())?);
        if workspace.has_error(&*diagnostics) {
            return Err(Vec::new());
        }
        // In native programs only G38.3 can be replaced, which `emit` also does without a warning.
        if program.dialect != Dialect::Native {
            let mut altered = altered_word_warnings(&program.read.steps);
            program.attach_own_source(&mut altered);
            diagnostics.extend(altered);
        }
        let output = self.output(&mut program, post_processor).map_err(|mut problems| {
            program.attach_own_source(&mut problems);
            problems
        })?;
        diagnostics.extend(output.warnings.iter().cloned());
        if workspace.has_error(&*diagnostics) {
            return Err(Vec::new());
        }
        Ok(NewVersion { output, program })
    }

    /// Returns the findings of `verify` about the program, except those about things that the post-processor adds or completes. Rapid moves are
    /// judged as the target makes them.
    fn findings(
        &self,
        workspace: &Workspace,
        program: &Program,
        target: Option<Dialect>,
    ) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
        let options = VerifyOptions {
            reading: self.reading,
            surface: self.surface,
            target,
            ..VerifyOptions::default()
        };
        let mut session = Session::new(workspace);
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

    /// Returns the output of the post-processor for an error-free program. Removes the steps from `program`, because they take much memory.
    fn output(
        &self,
        program: &mut Program,
        post_processor: &PostProcessor,
    ) -> Result<Output, Vec<Diagnostic>> {
        if let Some(line) =
            first_unapplied_formula(&program.text).filter(|_| program.dialect == Dialect::Native)
        {
            return Err(vec![Diagnostic::new(&posts::POST_UNADJUSTED).at_line(line, None)]);
        }
        let stated = program.header().tools;
        let steps = std::mem::take(&mut program.read.steps);
        let head = Provenance::of_head(&program.text);
        let remark: fn(&str) -> Remark<'_> = match (program.dialect, &head) {
            (Dialect::Native, _) => native_remark,
            (_, Some(_)) => |text| if is_head_comment(text) { Remark::Goes } else { Remark::Stays },
            (_, None) => |_| Remark::Stays,
        };
        let is_native = program.dialect == Dialect::Native;
        let native_cutters = if is_native { native_cutters(&steps) } else { Vec::new() };
        let name = program.file.file_stem().unwrap_or_default();
        let mut job = Job::from_steps(name, &steps, program.dialect, &remark)?;
        drop(steps);
        let stated_surface = head.as_ref().and_then(|(provenance, _)| provenance.thickness);
        if let Some(surface) = self.surface.or(stated_surface) {
            job.set_surface(surface);
        }
        if let Some((provenance, title)) = head {
            // The new program has the same provenance as the one that was read, except for the dialect.
            let provenance = Provenance { dialect: post_processor.reading_dialect(), ..provenance };
            job.remarks = vec![provenance.to_string().into(), title];
        }
        job.centre_arcs();
        if let Some(feed) = post_processor.feed() {
            job.set_missing_feeds(feed);
        }
        let unknown = complete_tools_of_job(&mut job, &native_cutters, &post_processor.tools, &stated)
            .map_err(|problem| vec![*problem])?;
        let mut output = post_processor.write(&job, self.to, &mut Vec::new())?;
        let located = |warning: Diagnostic| post_processor.locate(warning.in_file(&program.file));
        output.warnings.extend(unknown.into_iter().map(located));
        Ok(output)
    }
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

/// Turns the finding that a word is not checked into the finding that the word is left out, because the post-processor does not write it.
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
/// the table lacks keep the diameter that the program states. Returns warnings about the tools.
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
