//! Builds the files of one program, natively or through a post-processor. This code runs on worker threads. (book: language/keep-outs)

use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Database, Target, check_joined_parts, locate, program, traced_program};
use pathbuild_diagnostic::messages::gcode::{CUT_IN_HIGHER_MATERIAL, FEED_TOO_HIGH};
use pathbuild_diagnostic::messages::{files, parameters, posts, probes};
use pathbuild_diagnostic::{Diagnostic, Lang, Point, Value};
use pathbuild_gcode::native::{self, probe_name};
use pathbuild_gcode::read::LONGEST_LINE;
use pathbuild_gcode::verify::{
    Machine, beyond_machine, rapids_into_joined_material, rapids_into_material, text_beyond_machine,
};
use pathbuild_path::Letter;
use pathbuild_post::Job as PostJob;
use pathbuild_toolpath::{Correction, Program, ProgramStep, UnprobedPoint, estimated_bytes};

use super::joined::{joining_warnings, moves_into_clamps, total};
use super::options::OutputSettings;
use super::outcome::ProgramOutcome;
use super::plan::Job;
use super::sheet;
use crate::post_processor::PostProcessor;
use crate::session::{OutputKind, WriteSettings};

/// The outcome of building a program, and the generated files. There are no files if one of them cannot be generated, or if
/// the configuration turns a warning about the program into an error.
#[derive(Default)]
pub(super) struct BuiltProgram {
    /// The outcome of the program. Its `files` are filled in when they are written.
    pub(super) outcome: ProgramOutcome,
    pub(super) outputs: Vec<Output>,
}

/// Generates the files of a job. Native files are read back and compared with the program. (book: program/reading)
pub(super) fn build(db: &Database, job: &Job, settings: &OutputSettings<'_>) -> BuiltProgram {
    let programs = job.targets.iter().map(|target| program(db, *target).clone());
    let Some(programs) = programs.collect::<Option<Vec<_>>>() else { return BuiltProgram::default() };
    let mut outcome = ProgramOutcome::default();
    let time = total(&programs, settings.writing.options.rapid);
    (outcome.length, outcome.minutes) = (time.length, time.minutes());
    let provenance = settings.provenances.of(&programs);
    let line = provenance.to_string();
    outcome.provenance = Some(provenance);
    let at = |problem: Diagnostic| problem.in_file(job.drawing(db).path(db)).in_path(&job.path);
    let blocking_errors = blocking_errors(db, job, &programs, settings, &mut outcome.problems);
    let result = match (settings.post_processor, &*programs) {
        _ if !blocking_errors.is_empty() => Err(blocking_errors),
        (Some(post_processor), programs) => {
            let lang = settings.writing.options.lang;
            write_through_post(job, programs, &line, post_processor, lang, at, &mut outcome)
        }
        (None, [program]) => write_native(job, program, &line, settings, at, &mut outcome),
        // Native programs are never joined: only a post-processor can do that.
        (None, _) => Ok(Vec::new()),
    };
    let result = result.and_then(|outputs| with_sheets(outputs, db, job, settings));
    let mut outputs = result.unwrap_or_else(|problems| {
        outcome.is_refused = true;
        outcome.problems.extend(problems);
        Vec::new()
    });
    if settings.severities.has_error(&outcome.problems) {
        outputs.clear();
    }
    BuiltProgram { outcome, outputs }
}

/// Returns the errors that keep programs from being written: those of the first program that has any, or else those of joining the programs. Adds the
/// warnings of all programs to `problems`.
fn blocking_errors(
    db: &Database,
    job: &Job,
    programs: &[Arc<Program>],
    settings: &OutputSettings<'_>,
    problems: &mut Vec<Diagnostic>,
) -> Vec<Diagnostic> {
    let of_programs = programs
        .iter()
        .zip(&job.targets)
        .map(|(program, target)| move_problems(db, *target, program, settings.machine.as_ref()));
    let found = of_programs.chain([problems_of_joining(db, job, programs)]);
    let mut blocking_errors = Vec::new();
    for (errors, warnings) in found {
        problems.extend(warnings);
        if blocking_errors.is_empty() {
            blocking_errors = errors;
        }
    }
    blocking_errors
}

/// Adds the setup sheets to the files of a program.
///
/// # Errors
/// PB005 if any of the files is too large, or the error that kept a sheet from being rendered.
fn with_sheets(
    mut outputs: Vec<Output>,
    db: &Database,
    job: &Job,
    settings: &OutputSettings<'_>,
) -> Result<Vec<Output>, Vec<Diagnostic>> {
    for (kind, path) in &job.files {
        if let Some(format) = kind.sheet()
            && let Some(text) = sheet::bytes(db, job, format, settings).map_err(|problem| vec![*problem])?
        {
            outputs.push(Output { kind: *kind, path: path.clone(), text });
        }
    }
    match outputs.iter().find(|output| output.text.len() > settings.writing.most_bytes) {
        Some(output) => Err(vec![file_too_large(db, job, output, &settings.writing)]),
        None => Ok(outputs),
    }
}

/// Returns PB005 for an output file that is too large. The limit is the same for reading files on disk, so a larger file could not be compared.
fn file_too_large(db: &Database, job: &Job, output: &Output, writing: &WriteSettings) -> Diagnostic {
    Diagnostic::new(&files::FILE_TOO_LARGE)
        .quoting("name", output.path.file_name().unwrap_or_default())
        .with("limit", writing.most_bytes)
        .quoting("key", "output-size")
        .in_file(job.drawing(db).path(db))
        .in_path(&job.path)
}

/// Returns errors that keep a program from being written, which are rapid moves into material and moves beyond the machine's capabilities, and
/// warnings about cuts in higher material and about feeds beyond the rates of an axis. A feed above `maximum-feed` is a warning about the element
/// that gives it (PB211).
fn move_problems(
    db: &Database,
    target: Target,
    program: &Program,
    machine: Option<&Machine>,
) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let mut problems = rapids_into_material(program);
    problems.extend(machine.into_iter().flat_map(|machine| beyond_machine(program, machine)));
    let is_shown =
        |key: &str| [&FEED_TOO_HIGH, &CUT_IN_HIGHER_MATERIAL].iter().any(|message| message.key == key);
    problems.retain(|problem| problem.is_error() || is_shown(problem.message.key));
    let located = problems.into_iter().map(|problem| at_element_of_step(db, target, problem));
    located.partition(Diagnostic::is_error)
}

/// Moves a finding about a step of a target's program to the drawn element of the step. In the finding, `line` is the number of the step.
fn at_element_of_step(db: &Database, target: Target, mut problem: Diagnostic) -> Diagnostic {
    let step = problem.place.line.take();
    match step.zip(traced_program(db, target).as_deref()) {
        Some((step, traced)) => locate(db, traced.at_element_of_step(db, step, problem)),
        None => problem.in_file(target.file(db).path(db)).in_path(target.name(db)),
    }
}

/// Returns the errors and warnings that arise only from joining programs.
fn problems_of_joining(
    db: &Database,
    job: &Job,
    programs: &[Arc<Program>],
) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    if programs.len() < 2 {
        return (Vec::new(), Vec::new());
    }
    let mut found = joining_warnings(db, job, programs);
    found.extend(moves_into_clamps(db, job, programs));
    let rapids = rapids_into_joined_material(programs).into_iter();
    found.extend(rapids.map(|(program, problem)| at_element_of_step(db, job.targets[program], problem)));
    found.extend(check_joined_parts(db, &job.targets));
    found.into_iter().partition(Diagnostic::is_error)
}

/// Returns PB005 if splitting moves into pieces (z-split) exceeds a limit. Moves were counted before splitting, so the pieces are counted here.
/// `steps` is the number of pieces plus the comments between them.
fn too_many_pieces_error(steps: u64, program: &Program, writing: &WriteSettings) -> Option<Diagnostic> {
    if steps <= program.steps.len() as u64 {
        return None;
    }
    let comments = program.steps.iter().filter(|step| matches!(step, ProgramStep::Comment(_))).count() as u64;
    let moves = steps - comments;
    // `estimated_bytes` adds a comment to each move, but `steps` already includes the comments.
    let size = estimated_bytes(steps) / 2;
    if moves > writing.most_moves {
        let problem = Diagnostic::new(&files::TOO_MANY_PIECES).quoting("key", "embedding-moves");
        Some(problem.with("count", moves).with("limit", writing.most_moves))
    } else if size > writing.most_memory {
        let problem = Diagnostic::new(&files::TOO_MUCH_MEMORY).quoting("key", "program-memory");
        Some(problem.with("count", moves).with("size", size).with("limit", writing.most_memory))
    } else {
        None
    }
}

fn unprobed_point_warning(outside: &UnprobedPoint) -> Diagnostic {
    Diagnostic::new(&probes::OUTSIDE)
        .with("distance", outside.distance)
        .with("at", Point::new(outside.at.x, outside.at.y))
}

pub(super) struct Output {
    pub(super) kind: OutputKind,
    pub(super) path: Utf8PathBuf,
    pub(super) text: Vec<u8>,
}

fn write_native(
    job: &Job,
    program: &Program,
    provenance: &str,
    settings: &OutputSettings<'_>,
    at: impl Fn(Diagnostic) -> Diagnostic,
    outcome: &mut ProgramOutcome,
) -> Result<Vec<Output>, Vec<Diagnostic>> {
    let correction = settings.writing.options.correction;
    let steps = correction.count(program);
    if let Some(problem) = too_many_pieces_error(steps, program, &settings.writing) {
        return Err(vec![at(problem)]);
    }
    if correction.lacks_slope(program) {
        outcome.problems.push(at(Diagnostic::new(&probes::WITHOUT_SLOPE)));
    }
    match correction.farthest_unprobed_point(program) {
        Some(outside) => outcome.problems.push(at(unprobed_point_warning(&outside))),
        // Unused probes are reported only if no move lies outside the probes: otherwise, the warning above suffices.
        None => outcome.problems.extend(unused_probes(program, correction).map(&at)),
    }
    // If `cycles` is off, `check` reports each C instead. In a program without probes, C is not useless: a post-processor can write its pecks.
    let has_pecks = || program.pecks().iter().any(|(_, depth)| depth.is_some());
    if settings.has_cycles && !program.probes.is_empty() && has_pecks() {
        let problem = Diagnostic::new(&parameters::PECKS_WITH_PROBES).with("letter", Letter::C.as_char());
        outcome.problems.push(at(problem));
    }
    let fault = |problem: Box<Diagnostic>| vec![at(*problem)];
    let output = |(kind, path): &(OutputKind, Utf8PathBuf)| {
        let text = kind.text(program, provenance, &settings.writing).map_err(fault)?;
        let Some(text) = text else { return Ok(None) };
        too_long_line_error(&text, path).map_or(Ok(()), |problem| Err(vec![at(problem)]))?;
        kind.read_back(&text, program).map_err(fault)?;
        if *kind == OutputKind::Probing {
            let beyond = probing_beyond_machine(&text, path, settings.machine.as_ref());
            let (errors, warnings): (Vec<_>, Vec<_>) = beyond.map(&at).partition(Diagnostic::is_error);
            outcome.problems.extend(warnings);
            if !errors.is_empty() {
                return Err(errors);
            }
        }
        Ok(Some(Output { kind: *kind, path: path.clone(), text: text.into_bytes() }))
    };
    job.files.iter().map(output).filter_map(Result::transpose).collect()
}

/// Returns a diagnostic for each move of a probing program that exceeds the machine's capabilities. It names the line of the output file, because
/// such a move comes from the probes and not from a step of the path's program.
fn probing_beyond_machine(
    text: &str,
    path: &Utf8Path,
    machine: Option<&Machine>,
) -> impl Iterator<Item = Diagnostic> {
    let found = machine.map(|machine| text_beyond_machine(text.as_bytes(), machine));
    let name = path.file_name().unwrap_or_default().to_owned();
    found.into_iter().flatten().map(move |mut problem| {
        let line = u64::from(problem.place.line.take().unwrap_or_default());
        problem.note(&posts::IN_OUTPUT_FILE, vec![("line", line.into()), ("name", Value::quoted(&name))])
    })
}

fn unused_probes(program: &Program, correction: Correction) -> impl Iterator<Item = Diagnostic> {
    let unused = native::unused_probes(program, correction).into_iter();
    unused.map(|probe| {
        Diagnostic::new(&probes::WILL_BE_UNUSED).quoting("probe", probe_name(&program.probes[probe]))
    })
}

/// Returns PB005 for a line that is longer than the longest line that pathbuild reads.
fn too_long_line_error(text: &str, path: &Utf8Path) -> Option<Diagnostic> {
    let (number, line) = (1_u64..).zip(text.split('\n')).find(|(_, line)| line.len() > LONGEST_LINE)?;
    let problem = Diagnostic::new(&files::OUTPUT_LINE_TOO_LONG).with("line", number);
    let problem = problem.quoting("name", path.file_name().unwrap_or_default());
    Some(problem.with("length", line.len()).with("limit", LONGEST_LINE))
}

/// Returns the comments at the head of a program that a post-processor writes.
pub fn program_remarks<'p>(
    provenance: &str,
    title: &str,
    programs: impl IntoIterator<Item = &'p Program>,
    lang: Lang,
) -> Vec<Box<str>> {
    let left_out = programs.into_iter().flat_map(|program| native::left_out_lines(program, lang));
    [provenance.into(), title.into()].into_iter().chain(left_out.map(Into::into)).collect()
}

/// Generates the program through the post-processor, which reads its output back itself.
fn write_through_post(
    job: &Job,
    programs: &[Arc<Program>],
    provenance: &str,
    post_processor: &PostProcessor,
    lang: Lang,
    at: impl Fn(Diagnostic) -> Diagnostic,
    outcome: &mut ProgramOutcome,
) -> Result<Vec<Output>, Vec<Diagnostic>> {
    let program = job.files.iter().find(|(kind, _)| kind.is_program());
    let Some((kind, path)) = program else { return Err(Vec::new()) };
    let (mut program, warnings) =
        PostJob::from_programs(&job.path, programs, &post_processor.tools, post_processor.options.cycles);
    let drawn = programs.iter().map(|program| &**program);
    program.remarks = program_remarks(provenance, &job.title, drawn, lang);
    let located = |problem: Diagnostic| {
        let problem = post_processor.locate(problem);
        if problem.file.is_none() { at(problem) } else { problem }
    };
    let output = post_processor.write(&program, Some(path), &mut outcome.inserted);
    let output = output.map_err(|problems| {
        problems.into_iter().map(|problem| about_job(problem, job)).collect::<Vec<_>>()
    })?;
    outcome.problems.extend(warnings.into_iter().chain(output.warnings).map(located));
    outcome.notes.extend(output.notes);
    outcome.post_build = output.post_build.map(|command| (command, path.clone()));
    Ok(vec![Output { kind: *kind, path: path.clone(), text: output.text }])
}

fn about_job(problem: Diagnostic, job: &Job) -> Diagnostic {
    if problem.path.is_none() { problem.in_path(&job.path) } else { problem }
}
