//! Stale programs: G-code that was written earlier and that no path yields any more. (PB520, book: reference/commands)
//!
//! Each program names its drawing and path, and has a hash of its moves. Programs of removed paths are searched for only where the run
//! knows every drawing that could have produced them: beside the drawings of named directories, or in the output directory. Former files of
//! the run's own paths are always searched for.

use std::cell::LazyCell;
use std::collections::{BTreeSet, HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Db;
use pathbuild_db::system::join;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{files, outputs as messages};
use pathbuild_gcode::adjust::{Source, is_adjusted_from, states_other_values};
use pathbuild_gcode::native::{self, plain_title};
use pathbuild_gcode::provenance::{HEAD, Provenance};

use super::deliver::ProgramOutcome;
use super::job::Job;
use super::targets::TargetSelection;
use crate::posting::PostProcessor;
use crate::session::{Drawing, OutputKind, Session};

/// A program that must not be taken to the machine.
#[derive(Debug)]
pub(super) struct StaleProgram {
    path: Utf8PathBuf,
    reason: Reason,
}

/// Why a program is stale.
#[derive(Debug)]
enum Reason {
    /// No path yields it any more.
    Left,
    /// It was adjusted from a program that has changed since.
    Adjusted { clean: Utf8PathBuf },
    /// It is not the result of adjusting that program with the measured heights that it states.
    Edited { clean: Utf8PathBuf },
    /// It was adjusted with heights other than those in this file.
    OtherValues { values: Utf8PathBuf },
    /// It was written through another post-processor when the path had other moves than this program.
    OtherMoves { program: Utf8PathBuf },
}

impl StaleProgram {
    fn diagnostic(&self) -> Diagnostic {
        let name = |path: &Utf8Path| path.file_name().unwrap_or_default().to_owned();
        let problem = match &self.reason {
            Reason::Left => Diagnostic::new(&messages::STALE),
            Reason::Adjusted { clean } => {
                Diagnostic::new(&messages::STALE_ADJUSTED).quoting("clean", name(clean))
            }
            Reason::Edited { clean } => {
                Diagnostic::new(&messages::STALE_EDITED).quoting("clean", name(clean))
            }
            Reason::OtherValues { values } => {
                Diagnostic::new(&messages::STALE_VALUES).quoting("values", name(values))
            }
            Reason::OtherMoves { program } => {
                Diagnostic::new(&messages::STALE_OTHER_MOVES).quoting("program", name(program))
            }
        };
        problem.quoting("name", name(&self.path)).in_file(&self.path)
    }

    /// Whether the path exists but has other moves now; a comparison reports such a program as out of date.
    fn is_outdated(&self) -> bool {
        !matches!(self.reason, Reason::Left)
    }
}

/// The outcome of handling stale programs.
#[derive(Debug, Default)]
pub(super) struct StaleOutcome {
    pub(super) removed: Vec<Utf8PathBuf>,
    /// Programs whose paths have other moves now.
    pub(super) outdated: Vec<Utf8PathBuf>,
}

/// Reports stale programs, or removes them.
pub(super) fn settle(
    session: &Session<'_>,
    stale: Vec<StaleProgram>,
    is_removed: bool,
    diagnostics: &mut Vec<Diagnostic>,
) -> StaleOutcome {
    let mut dealt = StaleOutcome::default();
    for stale in stale {
        if !is_removed {
            diagnostics.push(stale.diagnostic());
            dealt.outdated.extend(stale.is_outdated().then_some(stale.path));
            continue;
        }
        match session.db().system().remove(&stale.path) {
            Ok(()) => dealt.removed.push(stale.path),
            Err(reason) => {
                let name = stale.path.file_name().unwrap_or_default();
                let problem = Diagnostic::new(&files::CANNOT_REMOVE).quoting("name", name);
                diagnostics.push(problem.with("reason", reason).in_file(&stale.path));
            }
        }
    }
    dealt
}

/// Finds the stale programs. `delivered` has the outcome of each job.
pub(super) fn stale(
    session: &Session<'_>,
    selection: &TargetSelection,
    jobs: &[Job],
    delivered: &[ProgramOutcome],
    post_processor: Option<&PostProcessor>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<StaleProgram> {
    let settings = &session.workspace().settings;
    let out_dir = settings.general.out_dir.value.as_ref().map(|directory| session.normal(directory));
    let is_wide = selection.covered.iter().len() > 0 || !selection.directories.is_empty();
    let directories: &[Utf8PathBuf] = match &out_dir {
        _ if !is_wide => &[],
        Some(directory) => std::slice::from_ref(directory),
        None => &selection.directories,
    };
    let finding = StaleSearch {
        session,
        post_processor,
        jobs,
        outputs: jobs.iter().flat_map(|job| job.files.iter().map(|(_, path)| path.as_path())).collect(),
        delivered,
        by_stem: LazyCell::new(Box::new(|| {
            jobs.iter().enumerate().map(|(number, job)| (&*job.stem, number)).collect()
        })),
        writers: LazyCell::new(Box::new(|| Writers::new(session, selection, jobs))),
    };
    let mut stale = Vec::new();
    for directory in directories {
        match finding.in_directory(directory) {
            Ok(found) => stale.extend(found),
            Err(problem) => diagnostics.push(*problem),
        }
    }
    stale.extend(finding.individual_paths(directories));
    stale
}

/// A former file of a job's path, or one adjusted from it: `_Milling` beside `_Clean`, or `_Clean` and `_Probing` from when the path had
/// probes.
struct FormerFile<'a> {
    job: &'a Job,
    kind: OutputKind,
    /// Provenance of the current program.
    provenance: &'a Provenance,
}

/// A value computed on first use.
type Lazy<'a, T> = LazyCell<T, Box<dyn FnOnce() -> T + 'a>>;

struct StaleSearch<'a> {
    session: &'a Session<'a>,
    post_processor: Option<&'a PostProcessor>,
    jobs: &'a [Job],
    outputs: HashSet<&'a Utf8Path>,
    delivered: &'a [ProgramOutcome],
    /// Index of each job by the stem of its file names.
    by_stem: Lazy<'a, HashMap<&'a Utf8Path, usize>>,
    writers: Lazy<'a, Writers>,
}

impl<'a> StaleSearch<'a> {
    fn in_directory(&self, directory: &Utf8Path) -> Result<Vec<StaleProgram>, Box<Diagnostic>> {
        let names = self.session.file_names_in(directory)?;
        let programs = names.iter().filter(|name| is_gcode(name, self.post_processor) || is_sheet(name));
        let programs = programs.map(|name| join(directory, name));
        let mut programs: Vec<Utf8PathBuf> =
            programs.filter(|path| !self.outputs.contains(&**path)).collect();
        programs.sort_unstable();
        let stale = |path: Utf8PathBuf| {
            let (found, title) = self.provenance(&path)?;
            match self.own(&path) {
                Some(own) if is_of(own.job, self.session, &title) => own.stale(self.session, path, &found),
                _ => self.of_other_post(&path, &found, &title).or_else(|| {
                    let is_left = self.writers.are_gone(directory, &title, names.iter());
                    is_left.then_some(StaleProgram { path, reason: Reason::Left })
                }),
            }
        };
        Ok(programs.into_iter().filter_map(stale).collect())
    }

    /// Checks paths that were named individually: only the names that their own files would have.
    fn individual_paths(&self, directories: &[Utf8PathBuf]) -> Vec<StaleProgram> {
        let searched: HashSet<&Utf8Path> = directories.iter().map(|directory| &**directory).collect();
        let is_elsewhere = |job: &&Job| job.stem.parent().is_none_or(|parent| !searched.contains(parent));
        let stems = self.jobs.iter().filter(is_elsewhere).map(|job| &job.stem);
        let paths = stems.flat_map(|stem| {
            let native = OutputKind::ALL.map(|kind| Utf8PathBuf::from(format!("{stem}{}", kind.suffix())));
            let posted =
                EXTENSIONS[1..].iter().map(move |extension| format!("{stem}_Milling.{extension}").into());
            native.into_iter().chain(posted)
        });
        let stale = |path: Utf8PathBuf| {
            if self.outputs.contains(&*path) {
                return None;
            }
            let (found, title) = self.provenance(&path)?;
            match self.own(&path) {
                Some(own) if is_of(own.job, self.session, &title) => own.stale(self.session, path, &found),
                _ => self.of_other_post(&path, &found, &title),
            }
        };
        paths.filter_map(stale).collect()
    }

    /// A program of one of the run's paths that was written through another post-processor, or natively, if the path has other moves now.
    fn of_other_post(&self, path: &Utf8Path, found: &Provenance, title: &str) -> Option<StaleProgram> {
        let name = path.with_extension("");
        let stem = PROGRAMS.iter().find_map(|kind| name.as_str().strip_suffix(kind))?;
        let number = *self.by_stem.get(Utf8Path::new(stem))?;
        let (job, now) = (&self.jobs[number], self.delivered[number].provenance.as_ref()?);
        let is_meant = is_of(job, self.session, title) && now.moves != found.moves;
        let program = job.files.first()?.1.clone();
        is_meant.then(|| StaleProgram { path: path.to_owned(), reason: Reason::OtherMoves { program } })
    }

    /// The native job whose path may have produced this file earlier.
    fn own(&self, path: &Utf8Path) -> Option<FormerFile<'a>> {
        if self.post_processor.is_some() {
            return None;
        }
        let of_kind = |kind: OutputKind| Some((kind, path.as_str().strip_suffix(kind.suffix())?));
        let (kind, stem) = OutputKind::ALL.into_iter().find_map(of_kind)?;
        let number = *self.by_stem.get(Utf8Path::new(stem))?;
        let job = &self.jobs[number];
        let provenance = self.delivered[number].provenance.as_ref()?;
        job.files.iter().all(|(present, _)| *present != kind).then_some(FormerFile { job, kind, provenance })
    }

    /// Provenance and title from the head of a program.
    fn provenance(&self, path: &Utf8Path) -> Option<(Provenance, Box<str>)> {
        Provenance::of_head(&self.session.db().system().head(path, HEAD).ok()?)
    }
}

impl FormerFile<'_> {
    /// Whether a former file is stale: always, unless it was adjusted from the current program.
    fn stale(&self, session: &Session<'_>, path: Utf8PathBuf, found: &Provenance) -> Option<StaleProgram> {
        if self.kind != OutputKind::Milling {
            return Some(StaleProgram { path, reason: Reason::Left });
        }
        let reason = match self.file(OutputKind::Clean) {
            None if self.provenance.is_same(found) => return None,
            None => Reason::Left,
            Some(clean) if !self.provenance.is_same(found) => Reason::Adjusted { clean: clean.to_owned() },
            Some(clean) => self.edited(session, &path, clean)?,
        };
        Some(StaleProgram { path, reason })
    }

    fn file(&self, kind: OutputKind) -> Option<&Utf8Path> {
        self.job.files.iter().find(|(present, _)| *present == kind).map(|(_, path)| path.as_path())
    }

    /// Why a program with the current provenance is not the result of adjusting the current program. Unreadable files are not judged.
    fn edited(&self, session: &Session<'_>, path: &Utf8Path, clean: &Utf8Path) -> Option<Reason> {
        let limit = session.workspace().settings.limits.file_size.value;
        let read = |file: &Utf8Path| session.db().system().read(file, limit).ok();
        let (program_text, clean_text) = (read(path)?, read(clean)?);
        let source = |file, bytes| Source { file, bytes };
        let program = source(path, &program_text);
        if !is_adjusted_from(program, source(clean, &clean_text)) {
            return Some(Reason::Edited { clean: clean.to_owned() });
        }
        let values = self.file(OutputKind::Values)?;
        let is_other = states_other_values(program, source(values, &read(values)?));
        is_other.then(|| Reason::OtherValues { values: values.to_owned() })
    }
}

/// Whether the title is that of the job's path.
fn is_of(job: &Job, session: &Session<'_>, title: &str) -> bool {
    let db = session.db();
    let drawing = job.drawing(db).path(db).file_name().unwrap_or_default();
    native::is_title(title, drawing, &job.path)
}

/// Extensions of programs: the native one, then those of the built-in posts. Another extension of a definition is known only while that
/// definition is in use.
const EXTENSIONS: [&str; 4] = ["gcode", "nc", "ngc", "tap"];

/// Endings of program names, without extension.
const PROGRAMS: [&str; 3] = ["_Milling", "_Clean", "_Probing"];

pub(super) fn is_gcode(name: &str, post_processor: Option<&PostProcessor>) -> bool {
    let is_like = |extension: &str, other: &str| extension.eq_ignore_ascii_case(other);
    Utf8Path::new(name).extension().is_some_and(|extension| {
        EXTENSIONS.iter().any(|known| is_like(extension, known))
            || post_processor.is_some_and(|post_processor| is_like(extension, post_processor.extension()))
    })
}

/// Whether `emit` gives this name to a setup sheet.
fn is_sheet(name: &str) -> bool {
    OutputKind::ALL.iter().any(|kind| kind.sheet().is_some() && name.ends_with(kind.suffix()))
}

/// Which drawings and paths may have written a program.
struct Writers {
    /// Paths of covered drawings for which the run generates nothing, because they have errors or are no targets. Existing files may still
    /// belong to them.
    idle: BTreeSet<Title>,
    /// Drawings of which all paths are known.
    covered: BTreeSet<Title>,
    /// Other existing drawings.
    others: BTreeSet<Title>,
    /// Whether all drawings of the library, or beside the program, are known, so that any other drawing no longer exists.
    knows_all: bool,
}

/// Title of a program in plain characters.
fn title(drawing: &str, path: &str) -> String {
    plain_title(&native::title(drawing, path))
}

fn file_name(drawing: &Utf8Path) -> &str {
    drawing.file_name().unwrap_or_default()
}

/// Output directory of programs, and their title or drawing in plain characters.
type Title = (Utf8PathBuf, String);

impl Writers {
    fn new(session: &Session<'_>, selection: &TargetSelection, jobs: &[Job]) -> Self {
        let db = session.db();
        let out_dir = session.workspace().settings.general.out_dir.value.as_ref();
        let out_dir = out_dir.map(|directory| session.normal(directory));
        let place = |drawing: &Utf8Path| {
            let beside = || drawing.parent().unwrap_or(Utf8Path::new("")).to_owned();
            out_dir.clone().unwrap_or_else(beside)
        };
        let written = |drawing: &Utf8Path| (place(drawing), plain_title(file_name(drawing)));
        let path = |drawing: &Utf8Path, path: &str| (place(drawing), title(file_name(drawing), path));
        let generated: BTreeSet<Title> =
            jobs.iter().map(|job| path(job.drawing(db).path(db), &job.path)).collect();
        let of_covered = selection
            .covered
            .iter()
            .flat_map(|drawing| drawing.result.names.iter().map(|name| path(&drawing.path, name.as_str())));
        let (broken, sound): (Vec<&Drawing>, Vec<&Drawing>) = selection
            .covered
            .iter()
            .partition(|drawing| drawing.result.diagnostics.iter().any(Diagnostic::is_error));
        let covered: HashSet<&Utf8Path> = sound.iter().map(|drawing| &*drawing.path).collect();
        let has_library = session.has_library();
        let (library, problems) = if has_library { session.library() } else { Default::default() };
        let others = library.iter().filter(|drawing| !covered.contains(&***drawing));
        let others = others.map(|drawing| &**drawing).chain(broken.iter().map(|drawing| &*drawing.path));
        Self {
            idle: of_covered.filter(|title| !generated.contains(title)).collect(),
            covered: covered.iter().map(|drawing| written(drawing)).collect(),
            others: others.map(written).collect(),
            knows_all: if has_library { problems.is_empty() } else { out_dir.is_none() },
        }
    }

    /// Whether no drawing yields this program any more, given that no path of the run does. `beside` lists the files in its directory.
    fn are_gone<'n>(
        &self,
        directory: &Utf8Path,
        title: &str,
        mut beside: impl Iterator<Item = &'n str>,
    ) -> bool {
        let title = plain_title(title);
        let Some(drawing) = native::drawing_of_title(&title) else { return false };
        let named = |text: &str| (directory.to_owned(), text.to_owned());
        let drawing = named(drawing);
        let is_beside = beside.any(|name| plain_title(name) == drawing.1);
        if self.idle.contains(&named(&title)) || self.others.contains(&drawing) {
            return false;
        }
        // A drawing that exists but is unknown to the run, such as an ignored one, is left alone.
        self.covered.contains(&drawing) || (self.knows_all && !is_beside)
    }
}
