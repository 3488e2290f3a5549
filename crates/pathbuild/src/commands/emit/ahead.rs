//! The files of a single path, made in advance while the names of drawings are being listed, and used if it turns out that they were made from
//! the right ones.

use std::sync::Arc;

use pathbuild_db::{Database, Db};
use pathbuild_toolpath::Program;

use super::asked::Asked;
use super::deliver::{Delivered, Made, Means, Task, finish, make, programs};
use super::job::{Job, Maker};
use crate::args::EmitArgs;
use pathbuild_workspace::session::Session;

/// What a job becomes, as far as one knows.
pub(super) struct Ahead {
    job: Job,
    /// That of each of its paths.
    programs: Vec<Arc<Program>>,
    /// Not read back yet, or only on a thread of its own: meanwhile one looks whether it was made from the right drawings.
    made: Made,
}

impl Ahead {
    /// Makes what `emit` of a single path writes; `None` where that is not one job.
    pub(super) fn make(maker: &Maker<'_>, args: &EmitArgs, means: &Means<'_>) -> Option<Self> {
        let session = maker.session;
        let asked = Asked::new(maker.context, session, &args.inputs, &mut Vec::new())?;
        let checked = session.check(&asked.targets);
        let mut jobs = maker.jobs(&checked, &mut Vec::new());
        let job = jobs.pop().filter(|_| jobs.is_empty())?;
        let means = Means { is_followed: true, ..*means };
        let make = |db: &Database, job: &&Job| Some((programs(db, job)?, make(db, job, &means)));
        let made = session.guarded(&[&job], make).pop()?;
        // What went wrong goes wrong again when it counts.
        let (programs, made) = made.ok()??;
        Some(Self { job, programs, made })
    }

    /// Does what is to be done with the files, if these are the jobs that they were made for, and their programs the same.
    pub(super) fn finish(
        self,
        session: &Session<'_>,
        jobs: &[Job],
        task: Task,
        means: &Means<'_>,
    ) -> Option<Delivered> {
        let [job] = jobs else { return None };
        let now = programs(session.db(), job)?;
        // Nobody had to make them again.
        let is_same = now.len() == self.programs.len()
            && now.iter().zip(&self.programs).all(|(now, before)| Arc::ptr_eq(now, before));
        if *job != self.job || !is_same {
            return None;
        }
        let Made { mut delivered, outputs, .. } = self.made.read_back();
        finish(session.db().system(), outputs, task, means.poster, &mut delivered);
        Some(delivered)
    }
}
