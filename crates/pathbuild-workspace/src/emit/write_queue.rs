//! Generates files on all cores and writes them on a separate thread: replacing a file waits for the disk, and the cores need not.

use std::panic::resume_unwind;
use std::sync::mpsc::{Receiver, SendError, sync_channel};
use std::thread::{self, Builder};

use pathbuild_db::Database;
use pathbuild_diagnostic::Diagnostic;

use super::deliver::{JobFiles, Output, OutputSettings, ProgramOutcome, Task, finish, make};
use super::job::Job;
use crate::session::Session;

/// Generates and writes the files of all jobs. If one file of a job cannot be written, none of its files is.
pub(super) fn deliver_all(
    session: &mut Session<'_>,
    jobs: &[&Job],
    task: Task,
    settings: &OutputSettings<'_>,
) -> Vec<ProgramOutcome> {
    let system = session.db().shared_system();
    let finished = |outputs| {
        let mut delivered = ProgramOutcome::default();
        finish(&*system, outputs, task, settings, &mut delivered);
        delivered
    };
    let write = |generated: Receiver<NumberedOutputs>| -> Vec<(usize, ProgramOutcome)> {
        generated.into_iter().map(|(index, outputs)| (index, finished(outputs))).collect()
    };
    let (sender, receiver) = sync_channel(QUEUE_LENGTH);
    let numbered: Vec<(usize, &Job)> = jobs.iter().copied().enumerate().collect();
    let (mut generated, written) = thread::scope(|scope| {
        let writer = Builder::new().name("writer".into()).spawn_scoped(scope, move || write(receiver));
        let generated = |db: &Database, (index, job): &(usize, &Job)| {
            let JobFiles { mut delivered, outputs } = make(db, job, settings);
            // Last point to give up: after this, all files of the job are written.
            db.check_time_limit();
            // Without a receiver (the system had no thread left), write here.
            if let Err(SendError((_, outputs))) = sender.send((*index, outputs)) {
                delivered.add(finished(outputs));
            }
            delivered
        };
        let generated =
            session.in_batches_of_programs(&numbered, |session, jobs| session.map_guarded(jobs, generated));
        drop(sender);
        let written = writer.map(|writer| writer.join().unwrap_or_else(|panic| resume_unwind(panic)));
        (generated, written.unwrap_or_default())
    });
    for (index, written) in written {
        if let Ok(generated) = &mut generated[index] {
            generated.add(written);
        }
    }
    let aborted = |(delivered, job): (Result<ProgramOutcome, Box<Diagnostic>>, &&Job)| {
        delivered.unwrap_or_else(|problem| job.aborted(session, *problem))
    };
    generated.into_iter().zip(jobs).map(aborted).collect()
}

/// Number of jobs that may wait to be written. Their files are held in memory.
const QUEUE_LENGTH: usize = 32;

/// The generated files of a job, with its index.
type NumberedOutputs = (usize, Vec<Output>);
