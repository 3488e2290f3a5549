//! Builds programs on all cores, and writes, compares or prints their files. (book: reference/commands, `emit`)

use std::panic::resume_unwind;
use std::sync::mpsc::{Receiver, SendError, sync_channel};
use std::thread::{self, Builder};

use camino::Utf8Path;
use pathbuild_db::system::{ReadError, WriteOutcome};
use pathbuild_db::{Database, System};
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_gcode::adjust::{self, Source};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{self, interpret};
use pathbuild_gcode::provenance::{HEAD_BYTES, Provenance, is_same_program};
use pathbuild_gcode::verify::{self, Ends, PostWords, Tolerance};
use pathbuild_toolpath::LAST_DIGIT_SLACK;

use super::build::{BuiltProgram, Output, build};
use super::options::OutputSettings;
use super::outcome::{ProgramOutcome, State, Task, is_of_other_version, write_error};
use super::plan::Job;
use crate::memo::hash_output;
use crate::post_processor::PostProcessor;
use crate::session::{OutputKind, OutputName, Session, without_positions, without_values};

/// Builds and settles the jobs that are not cached. If one file of a job cannot be generated, none of its files is written. Files are written on a
/// separate thread, so that the other cores do not wait for the disk.
pub(super) fn build_and_settle<'j>(
    session: &mut Session<'_>,
    jobs: impl Iterator<Item = &'j mut Job>,
    task: Task,
    post_processor: Option<&PostProcessor>,
) {
    let mut jobs: Vec<&mut Job> = jobs.filter(|job| !job.is_left_out && job.outcome.is_none()).collect();
    let settings = &OutputSettings::new(session.workspace(), post_processor);
    let system = session.db().shared_system();
    let settled = |outputs| settle(&*system, outputs, task, settings);
    let write = |generated: Receiver<NumberedOutputs>| -> Vec<(usize, ProgramOutcome)> {
        generated.into_iter().map(|(index, outputs)| (index, settled(outputs))).collect()
    };
    let (sender, receiver) = sync_channel(QUEUE_LENGTH);
    let numbered: Vec<(usize, &Job)> = jobs.iter().map(|job| &**job).enumerate().collect();
    let (mut generated, written) = thread::scope(|scope| {
        let writer = Builder::new().name("writer".into()).spawn_scoped(scope, move || write(receiver));
        let generated = |db: &Database, (index, job): &(usize, &Job)| {
            let BuiltProgram { mut outcome, outputs } = build(db, job, settings);
            // Last chance to time out: from here on, all files of the job are written.
            db.check_time_limit();
            // If there is no receiver, because the system had no thread left, write the files here.
            if let Err(SendError((_, outputs))) = sender.send((*index, outputs)) {
                add_files(&mut outcome, settled(outputs));
            }
            outcome
        };
        let size = session.programs_per_batch(numbered.len());
        let generated =
            session.in_batches(&numbered, size, |session, jobs| session.map_guarded(jobs, generated));
        drop(sender);
        let written = writer.map(|writer| writer.join().unwrap_or_else(|panic| resume_unwind(panic)));
        (generated, written.unwrap_or_default())
    });
    for (index, written) in written {
        if let Ok(generated) = &mut generated[index] {
            add_files(generated, written);
        }
    }
    let db = session.db();
    for (job, generated) in jobs.iter_mut().zip(generated) {
        let mut outcome = generated.unwrap_or_else(|problem| {
            let problem = problem.in_file(job.drawing(db).path(db)).in_path(&job.path);
            ProgramOutcome { problems: vec![problem], ..ProgramOutcome::default() }
        });
        for file in &mut outcome.inserted {
            file.path = session.normalize(&file.path);
        }
        job.outcome = Some(ProgramOutcome { path: job.path.clone(), ..outcome });
    }
}

/// Number of jobs that may wait to be written. Bounded because their files are held in memory.
const QUEUE_LENGTH: usize = 32;

/// The generated files of a job, with its index.
type NumberedOutputs = (usize, Vec<Output>);

fn add_files(generated: &mut ProgramOutcome, written: ProgramOutcome) {
    generated.files.extend(written.files);
    generated.hashes.extend(written.hashes);
    generated.problems.extend(written.problems);
}

/// Writes, compares or prints the files of a program.
fn settle(
    system: &dyn System,
    mut outputs: Vec<Output>,
    task: Task,
    settings: &OutputSettings<'_>,
) -> ProgramOutcome {
    let mut outcome = ProgramOutcome::default();
    let (post_processor, limit) = (settings.post_processor, settings.writing.most_bytes as u64);
    // Hash this version's text even if another version's file is kept: otherwise, that file would become the expected content.
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
            if let Err(problem) = write(system, hashed, force, limit, &mut outcome) {
                outcome.problems.push(*problem);
            }
        }
        Task::Compare { moves_only } => {
            for (output, hash) in hashed.filter(|(output, _)| task.covers(output.kind)) {
                let (state, problems) = compare(system, output, limit, moves_only, post_processor);
                outcome.hashes.push(hash);
                outcome.files.push((output.path.clone(), state));
                outcome.problems.extend(problems);
            }
        }
        Task::Print => {
            outcome.files =
                outputs.into_iter().map(|output| (output.path, State::Printed(output.text))).collect();
        }
    }
    outcome
}

/// Replaces the generated text by the file on disk if another pathbuild version wrote the same program to it.
fn keep_other_version(system: &dyn System, output: &mut Output, limit: u64) {
    if is_of_other_version(system, &output.path)
        && let Ok(present) = system.read(&output.path, limit)
        && is_same_program(&present, &output.text)
    {
        output.text = present;
    }
}

/// Writes files, each with the hash of the content that this version generates. Without `force`, writes none if measured values would be lost.
fn write<'a>(
    system: &dyn System,
    outputs: impl Iterator<Item = (&'a Output, [u8; 32])> + Clone,
    force: bool,
    limit: u64,
    outcome: &mut ProgramOutcome,
) -> Result<(), Box<Diagnostic>> {
    let values = outputs.clone().map(|(output, _)| output).filter(|output| output.kind == OutputKind::Values);
    let mut replaced = values.filter(|output| !has_same_probes(system, output));
    if !force && let Some(problem) = replaced.find_map(|output| lost_values_problem(system, &output.path)) {
        return Err(Box::new(problem));
    }
    for (output, hash) in outputs {
        let is_kept = output.kind == OutputKind::Values && !force && has_same_probes(system, output);
        let is_edited = is_edited(system, output, limit);
        let written =
            if is_kept { Ok(WriteOutcome::Unchanged) } else { system.write(&output.path, &output.text) };
        let written = written.map_err(|reason| Box::new(write_error(output.path.as_str(), reason)))?;
        let state = match written {
            WriteOutcome::Changed if is_edited => State::Overwritten,
            WriteOutcome::Changed => State::Written,
            WriteOutcome::Unchanged => State::Unchanged,
        };
        outcome.hashes.push(hash);
        outcome.files.push((output.path.clone(), state));
    }
    Ok(())
}

/// Whether the file on disk has the header of a generated program, but other lines that determine moves: it was edited after it had been written.
fn is_edited(system: &dyn System, output: &Output, limit: u64) -> bool {
    let head = system.read_head(&output.path, HEAD_BYTES).unwrap_or_default();
    let [present, written] =
        [&head, &output.text].map(|text| Provenance::of_head(text).map(|(found, _)| found));
    let is_own = present
        .zip(written)
        .is_some_and(|(present, written)| present.is_same(&written) && present.version == written.version);
    let has_other_moves = |present: Vec<u8>| {
        let [shown, written] = [&present, &output.text].map(|text| String::from_utf8_lossy(text));
        present != output.text && !verify::same_move_lines(&shown, &written)
    };
    is_own && system.read(&output.path, limit).is_ok_and(has_other_moves)
}

/// Returns PB605 if a file on disk, which is for probes other than those of the drawing, contains measured values, or lines that may contain some.
pub(super) fn lost_values_problem(system: &dyn System, file: &Utf8Path) -> Option<Diagnostic> {
    OutputName::parse(file.as_str()).filter(|name| name.kind == OutputKind::Values)?;
    let present = text_on_disk(system, file)?;
    let message = adjust::lost_values_message(Source { file, bytes: present.as_bytes() })?;
    let name = file.file_name().unwrap_or_default();
    Some(Diagnostic::new(message).quoting("name", name).in_file(file))
}

/// Whether the file of measured values exists and is for the same probes as the generated one.
fn has_same_probes(system: &dyn System, output: &Output) -> bool {
    text_on_disk(system, &output.path).is_some_and(|present| is_for_same_probes(&present, &output.text))
}

/// Whether two files of measured values are for the same probes. The file on disk may lack the positions of the probes in the emitted drawing, if an
/// older version or PathDxf2GCode wrote it.
fn is_for_same_probes(present: &str, written: &[u8]) -> bool {
    let (present, written) = (without_values(present.as_bytes()), without_values(written));
    present == written || present == without_positions(&written)
}

fn text_on_disk(system: &dyn System, path: &Utf8Path) -> Option<String> {
    let bytes = system.read(path, 1 << 24).ok()?;
    Some(String::from_utf8_lossy(&bytes).replace("\r\n", "\n"))
}

/// Compares a file on disk with the generated one: byte for byte, or by its moves only, ignoring comments, formulas, line ends, tool and spindle.
/// Also returns the [`difference`] between the moves. A file that cannot be read, or is larger than `limit`, is treated as different.
fn compare(
    system: &dyn System,
    output: &Output,
    limit: u64,
    moves_only: bool,
    post_processor: Option<&PostProcessor>,
) -> (State, Vec<Diagnostic>) {
    let present = match system.read(&output.path, limit) {
        Ok(bytes) => bytes,
        Err(ReadError::Missing) => return (State::Missing, Vec::new()),
        Err(_) => return (State::Outdated, Vec::new()),
    };
    let is_same =
        present == output.text || output.kind == OutputKind::Values && has_same_probes(system, output);
    if is_same {
        return (State::Current, Vec::new());
    }
    if !moves_only {
        return (State::Outdated, Vec::new());
    }
    // If the dialect cannot be read, only bytes can be compared.
    let dialect = post_processor.map_or(Some(Dialect::Native), PostProcessor::reading_dialect);
    let Some(dialect) = dialect else { return (State::Outdated, Vec::new()) };
    let problems = difference(&present, &output.text, dialect);
    let problems = problems.into_iter().map(|problem| problem.in_file(&output.path)).collect::<Vec<_>>();
    let state = if problems.is_empty() { State::Current } else { State::Outdated };
    (state, problems)
}

/// Compares a program on disk with the expected one. Returns the problems that make its moves uncertain, or else its words that change the meaning of
/// moves, or else the first move that differs. Lines are compared before moves: numbers that differ by one unit of their last digit are equal however
/// they are interpreted, even where rounding turns a very short arc into a full circle. Only programs with different lines are interpreted.
fn difference(present: &[u8], expected: &[u8], dialect: Dialect) -> Vec<Diagnostic> {
    let [found_text, expected_text] = [present, expected].map(String::from_utf8_lossy);
    if verify::same_move_lines(&found_text, &expected_text) {
        return Vec::new();
    }
    let read = |text| interpret(text, dialect, &interpret::Options::default());
    let (found, written) = (read(present), read(expected));
    let is_new = |problem: &Diagnostic| {
        let is_written = || written.problems.iter().any(|known| known.message == problem.message);
        let is_of_moves = matches!(
            problem.code(),
            Code::OptionalLine | Code::MachineValue | Code::UnknownOffset | Code::ForeignWord
        );
        problem.is_error() || is_of_moves && !is_written()
    };
    let problems: Vec<Diagnostic> =
        found.problems.iter().filter(|problem| is_new(problem)).cloned().collect();
    if !problems.is_empty() {
        return problems.into_iter().map(Diagnostic::as_error).collect();
    }
    let words = PostWords::of_programs([expected], dialect);
    let modes = verify::foreign_modes(&found.steps, &words, dialect);
    if !modes.is_empty() {
        return modes;
    }
    let difference = verify::compare(&found.moves(), &written.moves(), &LAST_DIGIT_TOLERANCE);
    difference.iter().map(verify::Difference::diagnostic).collect()
}

/// Two programs may round the same value differently.
const LAST_DIGIT_TOLERANCE: Tolerance =
    Tolerance { place: LAST_DIGIT_SLACK, feed: LAST_DIGIT_SLACK, chord: 0.0, ends: Ends::All };
