//! Finds stale programs: G-code of earlier runs that no path yields any more (PB520), or that shows an earlier state of its drawing because this run
//! could not write the path again (PB522). (book: reference/commands)
//!
//! Each program names its drawing and path, and has a hash of its moves. Programs of removed paths are searched for only where the run knows every
//! drawing that could have produced them: beside the drawings of named directories, or in the output directory. Former files of the run's own paths
//! are always searched for, and so are programs that remain beside their drawings or in a former output directory after `out-dir` was changed.

mod known_titles;
mod names;
mod older;
mod reason;
mod search;

use std::collections::{HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, Names, join};
use pathbuild_db::{Database, Db, Target, check_target, program};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files;
use pathbuild_gcode::native;
use pathbuild_gcode::provenance::{HEAD_BYTES, Provenance};

use super::options::Provenances;
use super::outcome::{ProgramOutcome, Task};
use super::plan::Job;
use crate::memo::{Answer, DrawingResult};
use crate::post_processor::PostProcessor;
use crate::session::{Argument, OutputKind, Session};

pub(crate) use names::program_of_other_path;
use reason::Reason;
pub(super) use reason::StaleProgram;
use search::{FormerFile, StaleSearch};

/// The outcome of searching for stale programs of earlier runs.
#[derive(Debug, Default)]
pub(super) struct StaleOutcome {
    /// Earlier programs, still on disk, of paths that this run could not write.
    pub(super) older: Vec<ProgramOutcome>,
    pub(super) removed: Vec<Utf8PathBuf>,
    /// Stale programs that are reported as errors.
    pub(super) outdated: Vec<Utf8PathBuf>,
    /// Programs of paths that the run did not select, for [`report_unselected`].
    pub(super) unselected: Vec<StaleProgram>,
}

/// The search for programs of earlier runs in the directories of this run's programs.
pub(super) struct EarlierPrograms<'a> {
    pub(super) session: &'a Session<'a>,
    pub(super) task: Task,
    pub(super) post_processor: Option<&'a PostProcessor>,
    /// Name of the program into which all paths are joined; `None` for one program per path.
    pub(super) join: Option<&'a str>,
    /// All paths of the run.
    pub(super) targets: &'a [Target],
    pub(super) arguments: &'a [Argument],
    /// Drawings that the arguments name, or that may define a named path.
    pub(super) named: &'a [Answer<DrawingResult>],
    /// Returns the drawings of which all paths were considered.
    pub(super) covered: &'a dyn Fn() -> &'a [Answer<DrawingResult>],
    /// Directories that were searched for drawings.
    pub(super) directories: &'a [Utf8PathBuf],
    pub(super) jobs: &'a [&'a Job],
}

impl<'a> EarlierPrograms<'a> {
    /// Finds programs that show another state of the drawings. Stale programs are reported; if `is_removed`, they are removed instead, except those
    /// that may still be needed.
    pub(super) fn find_and_settle(
        &'a self,
        is_removed: bool,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> StaleOutcome {
        if self.task == Task::Print {
            return StaleOutcome::default();
        }
        let older = self.earlier_outcomes(diagnostics);
        let reported: HashSet<&Utf8PathBuf> = older
            .iter()
            .flat_map(|older| &older.problems)
            .filter_map(|problem| problem.file.as_ref())
            .collect();
        let mut stale = self.find_stale_programs(diagnostics);
        stale.retain(|program| !reported.contains(&program.path));
        let (unselected, stale) =
            stale.into_iter().partition(|stale| matches!(stale.reason, Reason::Unselected { .. }));
        StaleOutcome { older, unselected, ..self.report_or_remove(stale, is_removed, diagnostics) }
    }

    fn report_or_remove(
        &self,
        stale: Vec<StaleProgram>,
        is_removed: bool,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> StaleOutcome {
        let mut outcome = StaleOutcome::default();
        for stale in stale {
            if !is_removed || self.is_kept(&stale) {
                let finding = self.finding_about(&stale);
                if self.session.workspace().has_error([&finding]) {
                    outcome.outdated.push(stale.path);
                }
                diagnostics.push(finding);
                continue;
            }
            match self.session.db().system().remove(&stale.path) {
                Ok(()) => outcome.removed.push(stale.path),
                Err(reason) => {
                    let name = stale.path.file_name().unwrap_or_default();
                    let problem = Diagnostic::new(&files::CANNOT_REMOVE).quoting("name", name);
                    diagnostics.push(problem.with("reason", reason).in_file(&stale.path));
                }
            }
        }
        outcome
    }

    /// Whether a program is kept even if stale programs are to be removed: because it may belong to another library, because its drawing can still be
    /// emitted by name or may become readable again, because it was copied, edited or left in another directory and that work would be lost, or
    /// because it has no successor in the output directory.
    fn is_kept(&self, stale: &StaleProgram) -> bool {
        match &stale.reason {
            Reason::Copied
            | Reason::CurrentCopy { .. }
            | Reason::Unselected { .. }
            | Reason::Broken { .. }
            | Reason::Elsewhere { .. }
            | Reason::Ignored { .. }
            | Reason::OfOthers
            | Reason::Edited { .. }
            | Reason::Unread { .. }
            | Reason::Unwritten { .. } => true,
            Reason::Beside { directory } => {
                let successor = join(directory, file_name(&stale.path));
                self.session.db().system().kind(&successor) != FileKind::File
            }
            Reason::Left
            | Reason::Adjusted { .. }
            | Reason::OtherValues { .. }
            | Reason::OtherHeights { .. }
            | Reason::OtherJoined { .. }
            | Reason::OtherMoves { .. } => false,
        }
    }

    /// Returns the finding about a stale program. In a comparison it is an error, unless the program may belong to another library, or may have been
    /// emitted from an ignored drawing by its name.
    fn finding_about(&self, stale: &StaleProgram) -> Diagnostic {
        let finding = stale.diagnostic();
        match stale.reason {
            Reason::OfOthers | Reason::Ignored { .. } => finding,
            _ => self.task.error_if_compared(finding),
        }
    }

    /// Finds the stale programs: among all files of the searched directories, and among former files of the jobs in other directories.
    fn find_stale_programs(&'a self, diagnostics: &mut Vec<Diagnostic>) -> Vec<StaleProgram> {
        let out_dir = self.session.out_dir();
        let directories: &[Utf8PathBuf] = match &out_dir {
            Some(directory) if !self.directories.is_empty() => std::slice::from_ref(directory),
            _ => self.directories,
        };
        let search = StaleSearch::new(self);
        let mut stale = Vec::new();
        for directory in directories {
            let names = self.file_names_in(directory, diagnostics);
            let candidates = search.candidates(directory, &names);
            stale.extend(candidates.filter_map(|path| search.program_if_stale(path, Some(&names))));
        }
        let former = search.former_files(directories);
        stale.extend(former.filter_map(|path| search.program_if_stale(path, None)));
        // An output directory on the command line is for this run only, so it does not make programs elsewhere stale.
        let is_configured = self.session.workspace().settings.general.out_dir.origin.line().is_some();
        if out_dir.is_none() || is_configured {
            stale.extend(search.programs_elsewhere(out_dir.as_deref(), directories, diagnostics));
        }
        stale
    }

    /// Returns the names of the files in a directory; none if it cannot be listed, which is reported.
    fn file_names_in(&self, directory: &Utf8Path, diagnostics: &mut Vec<Diagnostic>) -> Names {
        self.session.file_names_in(directory).unwrap_or_else(|problem| {
            diagnostics.push(*problem);
            Names::default()
        })
    }
}

/// Hashes of the moves that paths which the run did not select have now; `None` for a path with errors.
pub(super) type UnselectedMoves = HashMap<Target, Option<Box<str>>>;

/// Returns warnings about programs of paths that the run did not select, if these paths have other moves now, or errors. To find out, builds those of
/// these paths that are not in `known`, and adds them; builds no other paths that were not selected.
pub(super) fn report_unselected(
    session: &mut Session<'_>,
    programs: &[StaleProgram],
    known: &mut UnselectedMoves,
) -> Vec<Diagnostic> {
    let mut seen = HashSet::new();
    let targets = programs.iter().filter_map(StaleProgram::unselected_target);
    let is_open = |target: &Target| !known.contains_key(target) && seen.insert(*target);
    let targets: Vec<Target> = targets.filter(is_open).collect();
    let provenances = Provenances::new(&session.workspace().settings, None);
    let moves = |db: &Database, target: &Target| match program(db, *target) {
        Some(program) => Some(Some(provenances.of(&[&**program]).moves)),
        None => check_target(db, *target).any(Diagnostic::is_error).then_some(None),
    };
    let size = session.programs_per_batch(targets.len());
    let built = session.in_batches(&targets, size, |session, batch| session.map_guarded(batch, moves));
    known.extend(targets.into_iter().zip(built).filter_map(|(target, moves)| Some((target, moves.ok()??))));
    programs.iter().filter_map(|program| program.finding_if_unselected(known)).collect()
}

/// Whether the adjusted program on disk, which is the one that is milled, is stale: it was adjusted from an earlier state of the job's program or
/// with heights other than those measured now, or was edited since.
pub(super) fn has_stale_adjusted_program(
    session: &Session<'_>,
    post_processor: Option<&PostProcessor>,
    job: &Job,
) -> bool {
    let is_generated = job.files.iter().any(|(kind, _)| *kind == OutputKind::Milling);
    let provenance_now = job.outcome.as_ref().and_then(|outcome| outcome.provenance.as_ref());
    let Some(now) = provenance_now.filter(|_| post_processor.is_none() && !is_generated) else {
        return false;
    };
    let path = OutputKind::Milling.file(&job.stem);
    let Some((found, title)) = provenance(session, &path) else { return false };
    let former = FormerFile { job, kind: OutputKind::Milling, provenance: now };
    let stale =
        former.stale_program(session, path, &found).filter(|_| has_title_of_job(job, session, &title));
    stale.is_some_and(|stale| {
        matches!(stale.reason, Reason::Adjusted { .. } | Reason::Edited { .. } | Reason::OtherValues { .. })
    })
}

/// Reads the provenance and the title from the head of a program.
fn provenance(session: &Session<'_>, program: &Utf8Path) -> Option<(Provenance, Box<str>)> {
    Provenance::of_head(&session.db().system().read_head(program, HEAD_BYTES).ok()?)
}

/// Whether a program's title names the path of this job.
fn has_title_of_job(job: &Job, session: &Session<'_>, title: &str) -> bool {
    let db = session.db();
    let drawing = job.drawing(db).path(db).file_name().unwrap_or_default();
    native::is_title(title, drawing, &job.path)
}

fn file_name(drawing: &Utf8Path) -> &str {
    drawing.file_name().unwrap_or_default()
}
