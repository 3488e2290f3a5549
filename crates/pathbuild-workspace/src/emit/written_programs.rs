//! The programs of a long-lived session, which are written a few drawings at a time. (book: reference/commands, `watch`)
//!
//! The plans and outcomes of all programs are kept, so the findings that `emit` derives from all programs together can be updated after each change:
//! clashes of file names, stale programs, and targets that match no path.

use std::cell::LazyCell;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use camino::Utf8PathBuf;
use pathbuild_db::{Database, Db, SecondDefinition, SourceFile, Target};
use pathbuild_diagnostic::Diagnostic;

use super::options;
use super::outcome::{ProgramOutcome, Task};
use super::plan::{Job, JobBuilder, Plan, clashes, definitions_of, leave_out_clashes, warn_of_numbers};
use super::select::TargetPatterns;
use super::settle::build_and_settle;
use super::stale_programs::{EarlierPrograms, StaleProgram, UnselectedMoves, report_unselected};
use crate::memo::{Memo, read_drawings};
use crate::post_processor::PostProcessor;
use crate::session::{Session, compare_paths};

/// The programs that were written in a session, with the diagnostics about them.
#[derive(Debug, Default)]
pub struct WrittenPrograms {
    by_drawing: BTreeMap<Utf8PathBuf, Vec<(Target, Plan)>>,
    /// The targets that yield each file, by its path in lower case. A file with several targets is not written.
    owners: HashMap<String, Vec<Target>>,
    /// The targets that share a file name with another one.
    clashing: HashSet<Target>,
    /// The paths that two drawings define. They get no program.
    second_definitions: BTreeSet<SecondDefinition>,
    /// The moves of paths that are no targets but have programs on disk. A path is forgotten when its drawing is checked again.
    unselected_moves: UnselectedMoves,
}

/// The drawings that a session covers.
#[derive(Clone, Copy, Debug)]
pub struct CoveredDrawings<'a> {
    /// Whether these are the drawings of the library, among which each configured target must match a path.
    pub is_library: bool,
    /// Drawings that were found in directories, and whose paths were therefore all considered.
    pub drawings: &'a [Utf8PathBuf],
    /// Directories that were searched for drawings.
    pub directories: &'a [Utf8PathBuf],
}

impl WrittenPrograms {
    /// Writes the programs of these targets, which are all targets of these drawings. Returns the outcomes, and the other drawings whose programs may
    /// be written now because these drawings no longer claim their names.
    ///
    /// # Errors
    /// If options are missing, with a message that names them.
    pub fn write(
        &mut self,
        session: &mut Session<'_>,
        post_processor: Option<&PostProcessor>,
        drawings: &[SourceFile],
        targets: &[Target],
    ) -> (Result<Vec<ProgramOutcome>, String>, Vec<SourceFile>) {
        self.unselected_moves.retain(|target, _| !drawings.contains(&target.file(session.db())));
        let plans = session
            .with_stable_files(|session| self.plan_and_build(session, post_processor, drawings, targets));
        let (plans, refusal) = match plans {
            Ok(plans) => (plans, None),
            Err(refusal) => (targets.iter().map(|_| Plan::default()).collect(), Some(refusal)),
        };
        let outcomes = plans.iter().filter_map(|plan| plan.remaining_job()?.outcome.clone()).collect();
        let db = session.db();
        let mut programs: BTreeMap<&Utf8PathBuf, Vec<(Target, Plan)>> =
            drawings.iter().map(|drawing| (drawing.path(db), Vec::new())).collect();
        for (target, plan) in targets.iter().zip(plans) {
            programs.entry(target.file(db).path(db)).or_default().push((*target, plan));
        }
        let freed: BTreeSet<String> =
            programs.into_iter().flat_map(|(drawing, programs)| self.replace(drawing, programs)).collect();
        let mut rivals = self.drawings_of_sole_owners(db, &freed);
        rivals.retain(|rival| !drawings.contains(rival));
        (refusal.map_or(Ok(outcomes), Err), rivals)
    }

    fn plan_and_build(
        &self,
        session: &mut Session<'_>,
        post_processor: Option<&PostProcessor>,
        drawings: &[SourceFile],
        targets: &[Target],
    ) -> Result<Vec<Plan>, String> {
        let context = session.workspace();
        let checked = session.check(targets);
        let task = Task::Write { force: false };
        if let Some(refusal) = options::missing_options_error(context, task, &checked) {
            return Err(refusal);
        }
        let sheet = task.sheets(&context.settings);
        let builder = JobBuilder { session, post_processor, join: None, sheet };
        let mut plans: Vec<Plan> = checked.chunks(1).map(|checked| builder.plan(checked)).collect();
        // The clashes of all programs are reported together.
        leave_out_clashes(session, plans.iter_mut().filter_map(|plan| plan.job.as_mut()), &mut Vec::new());
        for plan in &mut plans {
            plan.leave_out_if_raised(context);
            if let Some(job) = &mut plan.job {
                job.leave_out_if_defined_twice(session.db(), &self.second_definitions);
            }
            // The errors of the drawings are dropped, because `check` reports them.
            plan.diagnostics.clear();
            // A job that is left out claims its names, too. Otherwise, which target may write them would depend on the drawing that was saved last.
            if let Some(job) = plan.job.as_mut().filter(|job| self.is_claimed(session.db(), job, drawings)) {
                job.leave_out();
            }
        }
        build_and_settle(
            session,
            plans.iter_mut().filter_map(|plan| plan.job.as_mut()),
            task,
            post_processor,
        );
        Ok(plans)
    }

    /// Whether a target in any drawing but these claims a file name of the job.
    fn is_claimed(&self, db: &Database, job: &Job, drawings: &[SourceFile]) -> bool {
        let owners = job.files.iter().filter_map(|(_, path)| self.owners.get(&path.as_str().to_lowercase()));
        owners.flatten().any(|owner| !drawings.contains(&owner.file(db)))
    }

    /// Sets the paths that two drawings define now. Returns the drawings for which that changed.
    pub fn set_second_definitions(
        &mut self,
        db: &Database,
        now: BTreeSet<SecondDefinition>,
    ) -> Vec<SourceFile> {
        let before = std::mem::replace(&mut self.second_definitions, now);
        let changed = before.symmetric_difference(&self.second_definitions);
        let drawings = changed.flat_map(|definition| &definition.files);
        let written = drawings.filter(|drawing| self.by_drawing.contains_key(*drawing));
        written.map(|drawing| db.file(drawing)).collect()
    }

    /// Returns the paths of targets that two drawings define, except those that share a file name, which is reported already.
    pub fn second_definitions(&self, db: &Database) -> BTreeSet<&SecondDefinition> {
        let targets = self.by_drawing.values().flatten().map(|(target, _)| *target);
        let targets: Vec<Target> = targets.filter(|target| !self.clashing.contains(target)).collect();
        definitions_of(db, &targets, &self.second_definitions).collect()
    }

    /// Forgets the programs of removed drawings. Returns the other drawings whose programs may be written now.
    pub fn forget(&mut self, db: &Database, removed: &BTreeSet<Utf8PathBuf>) -> Vec<SourceFile> {
        let freed: BTreeSet<String> =
            removed.iter().flat_map(|drawing| self.replace(drawing, Vec::new())).collect();
        self.drawings_of_sole_owners(db, &freed)
    }

    /// Replaces the programs of a drawing. Returns the file names that it no longer claims, in lower case.
    fn replace(&mut self, drawing: &Utf8PathBuf, programs: Vec<(Target, Plan)>) -> Vec<String> {
        let claims = |programs: &[(Target, Plan)]| -> HashSet<(String, Target)> {
            let jobs = programs.iter().filter_map(|(target, plan)| Some((*target, plan.job.as_ref()?)));
            let names = |(target, job): (Target, &Job)| {
                job.files.iter().map(|(_, path)| (path.as_str().to_lowercase(), target)).collect::<Vec<_>>()
            };
            jobs.flat_map(names).collect()
        };
        let now = claims(&programs);
        let before = if programs.is_empty() {
            self.by_drawing.remove(drawing)
        } else {
            self.by_drawing.insert(drawing.clone(), programs)
        };
        let before = claims(&before.unwrap_or_default());
        for (name, target) in now.difference(&before) {
            self.owners.entry(name.clone()).or_default().push(*target);
        }
        let mut freed = Vec::new();
        for (name, target) in before.difference(&now) {
            if let Some(owners) = self.owners.get_mut(name) {
                owners.retain(|owner| owner != target);
                if owners.is_empty() {
                    self.owners.remove(name);
                }
            }
            freed.push(name.clone());
        }
        freed
    }

    /// Returns the drawings of the targets that are the only ones to claim one of these file names.
    fn drawings_of_sole_owners(&self, db: &Database, names: &BTreeSet<String>) -> Vec<SourceFile> {
        let owners = names.iter().filter_map(|name| self.owners.get(name));
        owners.filter(|owners| owners.len() == 1).flatten().map(|owner| owner.file(db)).collect()
    }

    /// Returns the drawings with a program that has a diagnostic of this kind.
    pub fn drawings_with(
        &self,
        session: &Session<'_>,
        is_wanted: impl Fn(&Diagnostic) -> bool,
    ) -> BTreeSet<Utf8PathBuf> {
        let has_any = |plans: &[(Target, Plan)]| {
            plans.iter().any(|(_, plan)| plan.program_problems(session.workspace()).iter().any(&is_wanted))
        };
        let drawings = self.by_drawing.iter().filter(|(_, plans)| has_any(plans));
        drawings.map(|(drawing, _)| drawing.clone()).collect()
    }

    /// Returns the diagnostics of each program.
    pub fn problems(&self, session: &Session<'_>) -> Vec<Diagnostic> {
        let plans = self.by_drawing.values().flatten();
        plans.flat_map(|(_, plan)| plan.program_problems(session.workspace())).collect()
    }

    /// Returns the findings that `emit` derives from all programs together: file names that several targets claim, shared program numbers, stale
    /// programs on disk, and configured targets that match no path.
    pub fn common_problems(
        &mut self,
        session: &mut Session<'_>,
        post_processor: Option<&PostProcessor>,
        scope: &CoveredDrawings<'_>,
    ) -> Vec<Diagnostic> {
        let mut problems = Vec::new();
        let unselected = self.find_common_problems(session, post_processor, scope, &mut problems);
        problems.extend(report_unselected(session, &unselected, &mut self.unselected_moves));
        problems
    }

    /// Adds the findings except those about programs of paths that are no targets, and returns these programs.
    fn find_common_problems(
        &mut self,
        session: &Session<'_>,
        post_processor: Option<&PostProcessor>,
        scope: &CoveredDrawings<'_>,
        problems: &mut Vec<Diagnostic>,
    ) -> Vec<StaleProgram> {
        problems.extend(self.leave_out_clashes(session));
        let programs = self.sorted_programs();
        let targets: Vec<Target> = programs.iter().map(|(target, _)| *target).collect();
        let jobs: Vec<&Job> = programs.iter().filter_map(|(_, plan)| plan.job.as_ref()).collect();
        problems.extend(warn_of_numbers(session, post_processor, &jobs));
        let drawings = LazyCell::new(|| {
            read_drawings(session, &Memo::default(), scope.drawings, |path| path.as_str().into())
        });
        let earlier = EarlierPrograms {
            session,
            task: Task::Write { force: false },
            post_processor,
            join: None,
            targets: &targets,
            arguments: &[],
            named: &[],
            covered: &|| &drawings,
            directories: scope.directories,
            jobs: &jobs,
        };
        let outcome = earlier.find_and_settle(false, problems);
        problems.extend(outcome.older.into_iter().flat_map(|older| older.problems));
        if scope.is_library {
            let mut configured = TargetPatterns::new(&session.workspace().settings);
            for target in &targets {
                configured.matches(target.name(session.db()));
            }
            problems.extend(configured.unmatched(session));
        }
        outcome.unselected
    }

    /// Leaves out the jobs that share a file with another job, and returns PB514 for each clash.
    pub fn leave_out_clashes(&mut self, session: &Session<'_>) -> Vec<Diagnostic> {
        let jobs: Vec<&Job> =
            self.sorted_programs().into_iter().filter_map(|(_, plan)| plan.job.as_ref()).collect();
        let (clashing, problems) = clashes(session, &jobs);
        self.clashing = clashing.into_iter().map(|index| jobs[index].targets[0]).collect();
        if !self.clashing.is_empty() {
            let jobs = self.by_drawing.values_mut().flatten().filter_map(|(_, plan)| plan.job.as_mut());
            jobs.filter(|job| self.clashing.contains(&job.targets[0])).for_each(Job::leave_out);
        }
        problems
    }

    /// Returns the programs in the order in which `emit` reports them.
    fn sorted_programs(&self) -> Vec<&(Target, Plan)> {
        let mut drawings: Vec<_> = self.by_drawing.iter().collect();
        drawings.sort_by(|(a, _), (b, _)| compare_paths(a, b));
        drawings.into_iter().flat_map(|(_, programs)| programs).collect()
    }
}
