//! Generates the files of one program, and writes, compares or prints them. Runs on worker threads and prints nothing itself.

use std::ops::Add;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::WriteOutcome;
use pathbuild_db::{Database, System, program};
use pathbuild_diagnostic::limits::{exceeded, moves_cut};
use pathbuild_diagnostic::messages::{files, probes};
use pathbuild_diagnostic::{Diagnostic, Lang, Note, Point, Severity, Value};
use pathbuild_gcode::native::{self, probe_name};
use pathbuild_gcode::provenance::{HEAD, Provenance, VERSION, is_same_program};
use pathbuild_gcode::read::LONGEST_LINE;
use pathbuild_gcode::statistics::statistics;
use pathbuild_gcode::verify::{Machine, beyond_machine, rapids_into_material};
use pathbuild_post::Job as PostJob;
use pathbuild_toolpath::{Correction, Outside, Program, Step, Total, memory};

use super::job::Job;
use super::provenance::Provenances;
use super::sheet::SheetSettings;
use super::{compare, options, sheet};
use crate::config::Settings;
use crate::config::types::SheetFormat;
use crate::machine::machine;
use crate::posting::{InsertedFile, PostProcessor, tool_table};
use crate::session::{OutputKind, WriteSettings, hash_output, without_places, without_values};
use crate::workspace::Workspace;

/// What to do with the generated files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// Write them.
    Write {
        /// Whether to overwrite measured values.
        force: bool,
    },
    /// Compare them with the files on disk.
    Compare {
        /// Whether to compare moves only instead of bytes.
        moves_only: bool,
    },
    /// Print them.
    Print,
}

/// The outcome of generating the files of one program.
#[derive(Debug, Default)]
pub struct ProgramOutcome {
    /// Name of the path, or of the joined program.
    pub path: Box<str>,
    /// Each file with its outcome.
    pub files: Vec<(Utf8PathBuf, State)>,
    /// Expected content of each file, hashed by [`hash_output`].
    pub(super) hashes: Vec<[u8; 32]>,
    /// Length of the program in mm.
    pub length: f64,
    /// Machining time in minutes.
    pub minutes: f64,
    /// Errors, and differences in moves.
    pub problems: Vec<Diagnostic>,
    /// Whether the program itself has errors, so that nothing is written.
    pub(super) is_refused: bool,
    /// Identifies the inputs of the program; `None` if there is no program.
    pub(super) provenance: Option<Provenance>,
    /// Notes of the post-processor.
    pub notes: Vec<Note>,
    /// The command that the post-processor wants to run, with its output file.
    pub post_build: Option<(Vec<String>, Utf8PathBuf)>,
    /// Files that the post-processor inserted or failed to insert.
    pub(super) inserted: Vec<InsertedFile>,
}

impl ProgramOutcome {
    /// Adds the outcome of each file after writing.
    pub(super) fn add(&mut self, written: Self) {
        self.files.extend(written.files);
        self.hashes.extend(written.hashes);
        self.problems.extend(written.problems);
    }

    /// Whether the file on disk is now up to date.
    pub fn has_written(&self, file: &Utf8Path) -> bool {
        let is_there = |state: &State| matches!(state, State::Written | State::Unchanged);
        self.files.iter().any(|(path, state)| path == file && is_there(state))
    }
}

/// The outcome of a single file.
#[derive(Debug)]
pub enum State {
    /// Written.
    Written,
    /// Already up to date, not written.
    Unchanged,
    /// Compared: equal to what would be written.
    Current,
    /// Compared: different.
    Outdated,
    /// Compared: does not exist.
    Missing,
    /// Content to print.
    Printed(Vec<u8>),
}

impl Task {
    /// Whether this task covers files of this kind. A comparison of moves skips measured values and setup sheets.
    pub(super) fn compares(self, kind: OutputKind) -> bool {
        self != Self::Compare { moves_only: true } || (kind != OutputKind::Values && kind.sheet().is_none())
    }

    /// Sheet formats that belong to this task. Printing outputs the program alone.
    pub(super) fn sheets(self, settings: &Settings) -> SheetFormat {
        if self == Self::Print { SheetFormat::No } else { settings.emit.sheet.value }
    }

    /// Whether the results contain times.
    pub(super) fn writes_times(self) -> bool {
        self != Self::Compare { moves_only: true }
    }
}

/// How programs are written: natively or through a post-processor.
pub(super) struct OutputSettings<'a> {
    pub(super) writing: WriteSettings,
    pub(super) post_processor: Option<&'a PostProcessor>,
    pub(super) provenances: Provenances,
    pub(super) sheets: SheetSettings,
    machine: Option<Machine>,
}

impl<'a> OutputSettings<'a> {
    /// Takes the settings from the configuration.
    pub(super) fn new(workspace: &Workspace, post_processor: Option<&'a PostProcessor>) -> Self {
        let provenances = Provenances::new(&workspace.settings, post_processor);
        let sheets = SheetSettings::new(&workspace.settings, tool_table(workspace), post_processor);
        Self {
            writing: options::writing(workspace),
            post_processor,
            provenances,
            sheets,
            machine: machine(workspace),
        }
    }
}

/// The generated files of a job; empty if any of them cannot be written.
#[derive(Default)]
pub(super) struct JobFiles {
    /// Everything about the program except the outcome of its files.
    pub(super) delivered: ProgramOutcome,
    pub(super) outputs: Vec<Output>,
}

/// Generates the files of a job. Native files are read back and compared with the program. (book: program/reading)
pub(super) fn make(db: &Database, job: &Job, settings: &OutputSettings<'_>) -> JobFiles {
    let programs = job.targets.iter().map(|target| program(db, *target).clone());
    let Some(programs) = programs.collect::<Option<Vec<_>>>() else { return JobFiles::default() };
    let mut delivered = ProgramOutcome::default();
    let time = total(&programs, settings.writing.options.rapid);
    (delivered.length, delivered.minutes) = (time.length, time.minutes());
    let provenance = settings.provenances.of(&programs);
    let line = provenance.to_string();
    delivered.provenance = Some(provenance);
    let machine = settings.machine.as_ref();
    let unsafe_moves = programs.iter().find_map(|program| unsafe_moves(db, job, program, machine));
    let result =
        unsafe_moves.map_or_else(|| outputs(db, job, &programs, &line, settings, &mut delivered), Err);
    let result = result.and_then(|mut outputs| {
        outputs.extend(sheets(db, job, settings).map_err(|problem| vec![*problem])?);
        let too_large = outputs.iter().find(|output| output.text.len() > settings.writing.most_bytes);
        too_large.map_or(Ok(()), |output| Err(vec![file_too_large(db, job, output, &settings.writing)]))?;
        Ok(outputs)
    });
    let outputs = result.unwrap_or_else(|problems| {
        delivered.is_refused = true;
        delivered.problems.extend(problems);
        Vec::new()
    });
    JobFiles { delivered, outputs }
}

/// Sum of the programs' lengths and times; `rapid` is the feed of rapid moves in mm/min.
pub(super) fn total(programs: &[Arc<Program>], rapid: f64) -> Total {
    programs.iter().map(|program| statistics(program, rapid).sum()).fold(Total::default(), Add::add)
}

/// PB005: the output file is too large. Files on disk are not read beyond this limit either.
fn file_too_large(db: &Database, job: &Job, output: &Output, writing: &WriteSettings) -> Diagnostic {
    Diagnostic::new(&files::FILE_TOO_LARGE)
        .quoting("name", output.path.file_name().unwrap_or_default())
        .with("limit", writing.most_bytes)
        .quoting("key", "output-size")
        .in_file(job.drawing(db).path(db))
        .in_path(&job.path)
}

/// Generates the setup sheets of a job.
fn sheets(db: &Database, job: &Job, settings: &OutputSettings<'_>) -> Result<Vec<Output>, Box<Diagnostic>> {
    let mut outputs = Vec::new();
    for (kind, path) in &job.files {
        if let Some(format) = kind.sheet()
            && let Some(text) = sheet::bytes(db, job, format, settings)?
        {
            outputs.push(Output { kind: *kind, path: path.clone(), text });
        }
    }
    Ok(outputs)
}

/// Errors that keep a program from being written: rapid moves into material, and moves beyond the machine's capabilities.
fn unsafe_moves(
    db: &Database,
    job: &Job,
    program: &Program,
    machine: Option<&Machine>,
) -> Option<Vec<Diagnostic>> {
    let mut errors = rapids_into_material(program);
    errors.extend(machine.into_iter().flat_map(|machine| beyond_machine(program, machine)));
    errors.retain(Diagnostic::is_error);
    for problem in &mut errors {
        // The line is a step number here, which says nothing to the user.
        problem.place.line = None;
        problem.file = Some(job.drawing(db).path(db).clone());
        problem.path = Some(job.path.clone());
    }
    (!errors.is_empty()).then_some(errors)
}

/// Writes, compares or prints the files of a job.
pub(super) fn finish(
    system: &dyn System,
    mut outputs: Vec<Output>,
    task: Task,
    settings: &OutputSettings<'_>,
    delivered: &mut ProgramOutcome,
) {
    let (post_processor, limit) = (settings.post_processor, settings.writing.most_bytes as u64);
    // Hash what this version writes, not a kept file of another version: that file must not become the expected content.
    let hashes: Vec<[u8; 32]> =
        outputs.iter().map(|output| hash_output(&output.path, &output.text)).collect();
    if task != Task::Print {
        for output in &mut outputs {
            keep_other_version(system, output, limit);
        }
    }
    let hashed = outputs.iter().zip(hashes);
    match task {
        Task::Write { force } => {
            if let Err(problem) = write(system, hashed, force, delivered) {
                delivered.problems.push(*problem);
            }
        }
        Task::Compare { moves_only } => {
            for (output, hash) in hashed.filter(|(output, _)| task.compares(output.kind)) {
                let (state, problems) = compare::compare(system, output, limit, moves_only, post_processor);
                delivered.hashes.push(hash);
                delivered.files.push((output.path.clone(), state));
                delivered.problems.extend(problems);
            }
        }
        Task::Print => {
            delivered.files =
                outputs.into_iter().map(|output| (output.path, State::Printed(output.text))).collect();
        }
    }
}

/// Keeps the file of another pathbuild version if it contains the same program.
fn keep_other_version(system: &dyn System, output: &mut Output, limit: u64) {
    if is_of_other_version(system, &output.path)
        && let Ok(present) = system.read(&output.path, limit)
        && is_same_program(&present, &output.text)
    {
        output.text = present;
    }
}

/// Whether a program on disk was written by another version of pathbuild.
pub(super) fn is_of_other_version(system: &dyn System, program: &Utf8Path) -> bool {
    let head = system.head(program, HEAD).unwrap_or_default();
    Provenance::of_head(&head).is_some_and(|(found, _)| *found.version != *VERSION)
}

/// PB005: cutting moves into pieces (z-split) exceeds a limit. Moves were counted before cutting, so the pieces are counted here. `steps`
/// is the number of pieces and of the comments between them.
fn too_many_pieces(steps: u64, program: &Program, writing: &WriteSettings) -> Option<Diagnostic> {
    if steps <= program.steps.len() as u64 {
        return None;
    }
    let comments = program.steps.iter().filter(|step| matches!(step, Step::Comment(_))).count() as u64;
    let moves = steps - comments;
    // The limit is defined for moves that each have a comment; these steps have none.
    let size = memory(steps) / 2;
    if moves > writing.most_moves {
        Some(exceeded(moves_cut(moves), writing.most_moves, "embedding-moves"))
    } else if size > writing.most_memory {
        let problem = Diagnostic::new(&files::TOO_MUCH_MEMORY).quoting("key", "program-memory");
        Some(problem.with("count", moves).with("size", size).with("limit", writing.most_memory))
    } else {
        None
    }
}

fn outside_probes(outside: &Outside) -> Diagnostic {
    Diagnostic::new(&probes::OUTSIDE)
        .with("distance", outside.distance)
        .with("at", Point::new(outside.at.x, outside.at.y))
}

/// A generated file.
pub(super) struct Output {
    pub(super) kind: OutputKind,
    pub(super) path: Utf8PathBuf,
    pub(super) text: Vec<u8>,
}

fn outputs(
    db: &Database,
    job: &Job,
    programs: &[Arc<Program>],
    provenance: &str,
    settings: &OutputSettings<'_>,
    delivered: &mut ProgramOutcome,
) -> Result<Vec<Output>, Vec<Diagnostic>> {
    let drawing = job.drawing(db).path(db);
    let at = |problem: Diagnostic| problem.in_file(drawing).in_path(&job.path);
    match (settings.post_processor, programs) {
        (Some(post_processor), programs) => {
            posted(job, programs, provenance, post_processor, settings.writing.options.lang, at, delivered)
                .map(|output| vec![output])
        }
        (None, [program]) => {
            native(job, program, provenance, settings, at, delivered).map_err(|problem| vec![*problem])
        }
        // Only a post-processor can join paths.
        (None, _) => Ok(Vec::new()),
    }
}

fn native(
    job: &Job,
    program: &Program,
    provenance: &str,
    settings: &OutputSettings<'_>,
    at: impl Fn(Diagnostic) -> Diagnostic,
    delivered: &mut ProgramOutcome,
) -> Result<Vec<Output>, Box<Diagnostic>> {
    let correction = settings.writing.options.correction;
    let steps = correction.count(program);
    if let Some(problem) = too_many_pieces(steps, program, &settings.writing) {
        return Err(Box::new(at(problem)));
    }
    match correction.outside(program) {
        Some(outside) => delivered.problems.push(at(outside_probes(&outside))),
        // Probes outside the program are reported already; that some of them are unused follows from it.
        None => delivered.problems.extend(unused_probes(program, correction).map(&at)),
    }
    let output = |(kind, path): &(OutputKind, Utf8PathBuf)| {
        let text =
            kind.text(program, provenance, &settings.writing).map_err(|problem| Box::new(at(*problem)))?;
        let Some(text) = text else { return Ok(None) };
        too_long_line(&text, path).map_or(Ok(()), |problem| Err(Box::new(at(problem))))?;
        kind.read_back(&text, program).map_err(|problem| Box::new(at(*problem)))?;
        Ok(Some(Output { kind: *kind, path: path.clone(), text: text.into_bytes() }))
    };
    job.files.iter().map(output).filter_map(Result::transpose).collect()
}

/// PB609: warns about probes that correct no move.
fn unused_probes(program: &Program, correction: Correction) -> impl Iterator<Item = Diagnostic> {
    let unused = native::unused_probes(program, correction).into_iter();
    unused.map(|probe| Diagnostic {
        severity: Severity::Warning,
        ..Diagnostic::new(&probes::WILL_BE_UNUSED).quoting("probe", probe_name(&program.probes[probe]))
    })
}

/// PB005: a line is so long that neither pathbuild nor any other program would read it back.
fn too_long_line(text: &str, path: &Utf8Path) -> Option<Diagnostic> {
    let (number, line) = (1_u64..).zip(text.split('\n')).find(|(_, line)| line.len() > LONGEST_LINE)?;
    let problem = Diagnostic::new(&files::OUTPUT_LINE_TOO_LONG).with("line", number);
    let problem = problem.quoting("name", path.file_name().unwrap_or_default());
    Some(problem.with("length", line.len()).with("limit", LONGEST_LINE))
}

/// Generates the program through the post-processor, which reads its output back itself.
fn posted(
    job: &Job,
    programs: &[Arc<Program>],
    provenance: &str,
    post_processor: &PostProcessor,
    lang: Lang,
    at: impl Fn(Diagnostic) -> Diagnostic,
    delivered: &mut ProgramOutcome,
) -> Result<Output, Vec<Diagnostic>> {
    let program = job.files.iter().find(|(kind, _)| kind.is_program());
    let Some((kind, path)) = program else { return Err(Vec::new()) };
    let (mut program, warnings) =
        PostJob::from_programs(&job.path, programs, post_processor.tools(), post_processor.cycles());
    program.remarks = vec![provenance.into(), job.title.as_str().into()];
    let left_out = programs.iter().flat_map(|program| native::left_out_lines(program, lang));
    program.remarks.extend(left_out.map(Into::into));
    let located = |problem: Diagnostic| if problem.file.is_none() { at(problem) } else { problem };
    let output = post_processor.write(&program, Some(path), &mut delivered.inserted);
    let output = output
        .map_err(|problems| problems.into_iter().map(|problem| in_job(problem, job)).collect::<Vec<_>>())?;
    delivered.problems.extend(warnings.into_iter().chain(output.warnings).map(located));
    delivered.notes.extend(output.notes);
    delivered.post_build = output.post_build.map(|command| (command, path.clone()));
    Ok(Output { kind: *kind, path: path.clone(), text: output.text })
}

/// Adds the path to a diagnostic of the post-processor.
fn in_job(problem: Diagnostic, job: &Job) -> Diagnostic {
    if problem.path.is_none() { problem.in_path(&job.path) } else { problem }
}

/// Writes files; each comes with the hash of the content that this version generates.
fn write<'a>(
    system: &dyn System,
    outputs: impl Iterator<Item = (&'a Output, [u8; 32])> + Clone,
    force: bool,
    delivered: &mut ProgramOutcome,
) -> Result<(), Box<Diagnostic>> {
    let mut values =
        outputs.clone().map(|(output, _)| output).filter(|output| output.kind == OutputKind::Values);
    if !force && let Some(lost) = values.find(|output| would_lose_values(system, output)) {
        let name = lost.path.file_name().unwrap_or_default();
        return Err(Box::new(
            Diagnostic::new(&probes::VALUES_PRESENT).quoting("name", name).in_file(&lost.path),
        ));
    }
    for (output, hash) in outputs {
        let is_kept = output.kind == OutputKind::Values && !force && has_same_probes(system, output);
        let written =
            if is_kept { Ok(WriteOutcome::Unchanged) } else { system.write(&output.path, &output.text) };
        let written = written.map_err(|reason| Box::new(cannot_write(output.path.as_str(), reason)))?;
        let state = if written == WriteOutcome::Changed { State::Written } else { State::Unchanged };
        delivered.hashes.push(hash);
        delivered.files.push((output.path.clone(), state));
    }
    Ok(())
}

/// Whether the file contains measured values for other probes than the current ones.
fn would_lose_values(system: &dyn System, output: &Output) -> bool {
    let Some(present) = present(system, &output.path) else { return false };
    let has_values = without_values(present.as_bytes()) != present.trim_end();
    has_values && !is_for_probes(&present, &output.text)
}

/// Whether the file of values exists and matches the current probes.
pub(super) fn has_same_probes(system: &dyn System, output: &Output) -> bool {
    present(system, &output.path).is_some_and(|present| is_for_probes(&present, &output.text))
}

/// Whether two files of values are for the same probes. A file without the probes' places in the emitted drawing was written by an older
/// version or by the original tool.
fn is_for_probes(present: &str, written: &[u8]) -> bool {
    let (present, written) = (without_values(present.as_bytes()), without_values(written));
    present == written || present == without_places(&written)
}

fn present(system: &dyn System, path: &Utf8Path) -> Option<String> {
    let bytes = system.read(path, 1 << 24).ok()?;
    Some(String::from_utf8_lossy(&bytes).replace("\r\n", "\n"))
}

/// PB004: a file cannot be written.
pub(super) fn cannot_write(name: &str, reason: impl Into<Value>) -> Diagnostic {
    Diagnostic::new(&files::CANNOT_WRITE).quoting("name", name).with("reason", reason)
}
