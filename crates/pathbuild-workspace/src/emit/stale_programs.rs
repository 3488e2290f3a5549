//! Finds stale programs: G-code of earlier runs that no path yields any more (PB520), or that shows an earlier state of its drawing because this run
//! could not write the path again (PB522). (book: reference/commands)
//!
//! Each program names its drawing and path, and has a hash of its moves. Programs of removed paths are searched for only where the run knows every
//! drawing that could have produced them: beside the drawings of named directories, or in the output directory. Former files of the run's own paths
//! are always searched for, and so are programs that remain beside their drawings although `out-dir` is configured now.

use std::cell::LazyCell;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, Names, is_drawing, join, or_current_directory};
use pathbuild_db::{Db, Role, SourceFile, Target, program};
use pathbuild_diagnostic::messages::{files, outputs as messages};
use pathbuild_diagnostic::reasons::PROGRAM_OF_OTHER_PATH;
use pathbuild_diagnostic::{Diagnostic, Text, Value};
use pathbuild_gcode::adjust::{Source, is_adjusted_from, listed_heights, states_other_values};
use pathbuild_gcode::native::{self, plain_title};
use pathbuild_gcode::provenance::{HEAD_BYTES, Provenance};
use pathbuild_path::PathName;

use super::options::Provenances;
use super::outcome::{ProgramOutcome, State, Task};
use super::plan::{Job, output_directory, program_name};
use crate::files::{PROGRAM_EXTENSIONS, is_program};
use crate::memo::{Answer, DrawingResult, find};
use crate::post_processor::PostProcessor;
use crate::session::{Argument, OutputKind, Session};
use crate::workspace::Workspace;

/// A program on disk that must not be run on the machine.
#[derive(Debug)]
struct StaleProgram {
    path: Utf8PathBuf,
    reason: Reason,
}

/// The reason why a program is stale.
#[derive(Debug)]
enum Reason {
    /// No path yields the program any more.
    Left,
    /// No path yields the program any more, and `emit` would give it another name, so a person may have copied it.
    Copied,
    /// The program's drawing cannot be read, so it is unknown whether its path still yields the program.
    Unread { drawing: String },
    /// The program lies beside its drawing, but programs are written into `directory` now.
    Beside { directory: Utf8PathBuf },
    /// The program's drawing exists, but an ignore file or its hidden name excludes it from the search.
    Ignored { drawing: String },
    /// The program's drawing is not in this library, but may be in another library that shares the output directory.
    OfOthers,
    /// The program was adjusted from the program `clean`, which has changed since.
    Adjusted { clean: Utf8PathBuf },
    /// The program is not the result of adjusting `clean` with the measured heights that it states.
    Edited { clean: Utf8PathBuf },
    /// The program was adjusted with heights other than those in the file `values`.
    OtherValues { values: Utf8PathBuf },
    /// The program was converted from the adjusted `program` before that got other heights.
    OtherHeights { program: Utf8PathBuf },
    /// The program joins paths that yield another program now.
    OtherJoined { paths: Vec<String> },
    /// The program joins paths, of which `path` cannot be written now.
    Unwritten { path: String },
    /// The program was written through another post-processor, and its moves differ from those of the current `program`.
    OtherMoves { program: Utf8PathBuf },
}

impl StaleProgram {
    fn diagnostic(&self) -> Diagnostic {
        let name = |path: &Utf8Path| path.file_name().unwrap_or_default().to_owned();
        let problem = match &self.reason {
            Reason::Left => Diagnostic::new(&messages::STALE),
            Reason::Copied => Diagnostic::new(&messages::STALE_COPY),
            Reason::Unread { drawing } => {
                Diagnostic::new(&messages::OUTPUT_OF_UNREAD).quoting("drawing", drawing.as_str())
            }
            Reason::Beside { directory } => {
                let directory = or_current_directory(directory).as_str();
                Diagnostic::new(&messages::STALE_BESIDE).quoting("directory", directory)
            }
            Reason::Ignored { drawing } => {
                Diagnostic::new(&messages::STALE_OF_IGNORED).quoting("drawing", drawing.as_str())
            }
            Reason::OfOthers => Diagnostic::new(&messages::STALE_OR_OF_OTHERS),
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
            Reason::OtherHeights { program } => {
                Diagnostic::new(&messages::STALE_CONVERTED).quoting("program", name(program))
            }
            Reason::OtherJoined { paths } => {
                let stem = self.path.file_stem().unwrap_or_default();
                let mut suffixes = PROGRAM_SUFFIXES.into_iter().chain([SHEET_SUFFIX]);
                let join = suffixes.find_map(|suffix| stem.strip_suffix(suffix)).unwrap_or(stem);
                let command = format!("emit {} --join {join}", paths.join(" "));
                let problem = Diagnostic::new(&messages::STALE_JOINED).quoting("command", command);
                problem.with("paths", paths.iter().map(String::as_str).collect::<Value>())
            }
            Reason::Unwritten { path } => {
                Diagnostic::new(&messages::OLDER_OUTPUT).quoting("path", path.as_str())
            }
        };
        problem.quoting("name", name(&self.path)).in_file(&self.path)
    }
}

/// The outcome of searching for stale programs of earlier runs.
#[derive(Debug, Default)]
pub(super) struct StaleOutcome {
    /// Earlier programs, still on disk, of paths that this run could not write.
    pub(super) older: Vec<ProgramOutcome>,
    pub(super) removed: Vec<Utf8PathBuf>,
    /// Stale programs that are reported as errors.
    pub(super) outdated: Vec<Utf8PathBuf>,
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
    /// Returns the drawings whose paths were all considered.
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
        let stale = self.find_stale_programs(diagnostics);
        StaleOutcome { older, ..self.settle(stale, is_removed, diagnostics) }
    }

    fn settle(
        &self,
        stale: Vec<StaleProgram>,
        is_removed: bool,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> StaleOutcome {
        let mut dealt = StaleOutcome::default();
        for stale in stale {
            if !is_removed || self.is_kept(&stale) {
                let finding = self.judge(&stale);
                if self.session.workspace().has_error([&finding]) {
                    dealt.outdated.push(stale.path);
                }
                diagnostics.push(finding);
                continue;
            }
            match self.session.db().system().remove(&stale.path) {
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

    /// Whether a program is never removed: one that may belong to another library, one of a drawing that can still be emitted by its name, one that
    /// was copied or edited, because that work would be lost, one whose drawing may become readable again, and one without a successor in the output
    /// directory.
    fn is_kept(&self, stale: &StaleProgram) -> bool {
        match &stale.reason {
            Reason::Copied
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
    fn judge(&self, stale: &StaleProgram) -> Diagnostic {
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
        let finding = StaleSearch::new(self);
        let mut stale = Vec::new();
        for directory in directories {
            let names = self.file_names_in(directory, diagnostics);
            let candidates = finding.candidates(directory, &names);
            stale.extend(candidates.filter_map(|path| finding.program_if_stale(path, Some(&names))));
        }
        let former = finding.former_files(directories);
        stale.extend(former.filter_map(|path| finding.program_if_stale(path, None)));
        // An output directory on the command line is for this run only.
        let is_configured = self.session.workspace().settings.general.out_dir.origin.line().is_some();
        if let Some(out_dir) = out_dir.filter(|_| is_configured) {
            let beside = finding.programs_beside_drawings(&out_dir, diagnostics).into_iter();
            stale.extend(
                beside
                    .map(|path| StaleProgram { path, reason: Reason::Beside { directory: out_dir.clone() } }),
            );
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

    /// Finds the programs on disk of targets for which nothing was written or compared. Each becomes a separate outcome; a comparison reports it as
    /// out of date.
    fn earlier_outcomes(&self, diagnostics: &mut Vec<Diagnostic>) -> Vec<ProgramOutcome> {
        let targets = self.targets;
        let is_done = |job: &&&Job| job.outcome.as_ref().is_some_and(|outcome| !outcome.files.is_empty());
        if let (Some(name), Some(post_processor)) = (self.join, self.post_processor) {
            let joined = targets.first().filter(|_| !self.jobs.iter().any(|job| is_done(&job)));
            let program = joined.and_then(|first| self.of_joined(*first, name, post_processor));
            return program.map(|program| earlier_outcome(program, name, self.task)).into_iter().collect();
        }
        let done = self.jobs.iter().filter(is_done);
        let done: HashSet<Target> = done.flat_map(|job| job.targets.iter().copied()).collect();
        let open = targets.iter().filter(|target| !done.contains(target));
        let mut listings = ProgramListings::default();
        // Two drawings may yield the same program.
        let mut known = HashSet::new();
        let older = |target: &Target| {
            let programs = self.programs_of_target(*target, &mut listings).into_iter();
            let programs = programs.filter(|program| known.insert(program.clone()));
            let name = target.name(self.session.db());
            programs.map(|program| earlier_outcome(program, name, self.task)).collect::<Vec<_>>()
        };
        let mut older: Vec<ProgramOutcome> = open.flat_map(older).collect();
        let lost = self.arguments.iter().filter_map(|argument| self.lost_name(argument));
        for (path, program) in lost.flat_map(|lost| self.programs_of_lost(&lost, &mut listings)) {
            if known.insert(program.clone()) {
                older.push(earlier_outcome(program, &path, self.task));
            }
        }
        diagnostics.append(&mut listings.problems);
        older
    }

    /// Returns the programs on disk that belong to a target. Their names begin with the name of the drawing or of the path, and the head of each
    /// program names its path.
    fn programs_of_target(&self, target: Target, listings: &mut ProgramListings) -> Vec<Utf8PathBuf> {
        let db = self.session.db();
        let (drawing, path) = (target.file(db).path(db), &**target.name(db));
        let directory = output_directory(self.session.out_dir().as_deref(), drawing);
        let stems = [drawing.file_stem().unwrap_or_default(), path];
        let drawing = drawing.file_name().unwrap_or_default();
        let is_of_target = |program: &Utf8PathBuf| {
            provenance(self.session, program)
                .is_some_and(|(_, found)| native::is_title(&found, drawing, path))
        };
        let mut programs = BTreeSet::new();
        for stem in stems {
            programs.extend(listings.programs_beginning_with(self, &directory, stem).cloned());
        }
        programs.into_iter().filter(is_of_target).collect()
    }

    /// Returns the drawing or path that an argument names, if the drawing has no known path because it cannot be read, or if it is gone.
    fn lost_name(&self, argument: &'a Argument) -> Option<LostName<'a>> {
        let db = self.session.db();
        let out_dir = self.session.out_dir();
        let is_known = |file: &SourceFile| {
            find(self.named, file.path(db)).is_some_and(|drawing| !drawing.value.names.is_empty())
        };
        let directory = |file: &SourceFile| output_directory(out_dir.as_deref(), file.path(db));
        match argument {
            Argument::Drawing(file) | Argument::Name { drawing: Some(file), .. } if !is_known(file) => {
                let drawing = Lost::Drawing(file_name(file.path(db)));
                Some(LostName { name: drawing, directories: vec![directory(file)], has_drawing: true })
            }
            Argument::Name { name, candidates, drawing: None, directory: None }
                if !candidates.iter().any(is_known) =>
            {
                let has_drawing = !candidates.is_empty();
                let mut directories = match &out_dir {
                    None if !has_drawing => self.session.name_directories(),
                    Some(directory) => vec![directory.clone()],
                    None => candidates.iter().map(directory).collect(),
                };
                directories.dedup();
                Some(LostName { name: Lost::Path(name.as_str()), directories, has_drawing })
            }
            _ => None,
        }
    }

    /// Returns the programs on disk of a lost drawing or path, each with its path.
    fn programs_of_lost(
        &self,
        lost: &LostName<'_>,
        listings: &mut ProgramListings,
    ) -> Vec<(String, Utf8PathBuf)> {
        // A drawing that exists although no argument led to it may still yield its program.
        let is_gone = |program: &Utf8Path, title: &str| {
            let drawing = native::drawing_of_title(title).unwrap_or_default();
            let beside = program.with_file_name(drawing);
            lost.has_drawing || self.session.db().system().kind(&beside) == FileKind::Missing
        };
        let mut programs = Vec::new();
        for directory in &lost.directories {
            for program in listings.programs_beginning_with(self, directory, lost.name.stem()) {
                let Some((_, title)) = provenance(self.session, program) else { continue };
                if lost.name.is_in(&title) && is_gone(program, &title) {
                    let path = native::path_of_title(&title).unwrap_or_default();
                    programs.push((path.to_owned(), program.clone()));
                }
            }
        }
        programs
    }

    /// Returns the program into which the targets were joined earlier.
    fn of_joined(&self, first: Target, name: &str, post_processor: &PostProcessor) -> Option<Utf8PathBuf> {
        let db = self.session.db();
        let directory = output_directory(self.session.out_dir().as_deref(), first.file(db).path(db));
        let program = join(&directory, program_name(name, post_processor));
        let (_, title) = provenance(self.session, &program)?;
        native::joined_paths(&title).map(|_| program)
    }
}

/// A drawing or path that an argument names, and that cannot be read or is gone.
struct LostName<'a> {
    name: Lost<'a>,
    /// The directories in which its programs may be.
    directories: Vec<Utf8PathBuf>,
    /// Whether the argument names a drawing, or a path that a drawing may define judging by its file name.
    has_drawing: bool,
}

#[derive(Clone, Copy)]
enum Lost<'a> {
    Drawing(&'a str),
    Path(&'a str),
}

impl<'a> Lost<'a> {
    /// Returns the text with which the names of its programs begin: the name of a path, or the number that is common to it and its drawing.
    fn stem(self) -> &'a str {
        match self {
            Self::Drawing(_) => "",
            Self::Path(name) => name.split('.').next().unwrap_or_default(),
        }
    }

    fn is_in(self, title: &str) -> bool {
        match self {
            Self::Drawing(drawing) => native::is_title_of(title, drawing),
            Self::Path(path) => native::is_title_of_path(title, path),
        }
    }
}

/// Whether a program on disk was adjusted from an earlier state of the job's program or with heights other than those measured now, or was edited
/// since. Such a program is the one that is milled.
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
    let path = Utf8PathBuf::from(format!("{}{}", job.stem, OutputKind::Milling.suffix()));
    let Some((found, title)) = provenance(session, &path) else { return false };
    let former = FormerFile { job, kind: OutputKind::Milling, provenance: now };
    let stale = former.stale_program(session, path, &found).filter(|_| is_of(job, session, &title));
    stale.is_some_and(|stale| {
        matches!(stale.reason, Reason::Adjusted { .. } | Reason::Edited { .. } | Reason::OtherValues { .. })
    })
}

/// Reads the provenance and the title from the head of a program.
fn provenance(session: &Session<'_>, program: &Utf8Path) -> Option<(Provenance, Box<str>)> {
    Provenance::of_head(&session.db().system().read_head(program, HEAD_BYTES).ok()?)
}

/// A file that a job's path yielded earlier, but that the job does not generate: `_Milling` beside `_Clean` (adjusted from it, or written before the
/// path had probes), or `_Clean` and `_Probing` (written while the path had probes).
struct FormerFile<'a> {
    job: &'a Job,
    kind: OutputKind,
    /// Provenance of the current program.
    provenance: &'a Provenance,
}

type Lazy<'a, T> = LazyCell<T, Box<dyn FnOnce() -> T + 'a>>;

struct StaleSearch<'a> {
    run: &'a EarlierPrograms<'a>,
    outputs: HashSet<&'a Utf8Path>,
    /// Index of each job by the stem of its file names.
    by_stem: Lazy<'a, HashMap<&'a Utf8Path, usize>>,
    writers: Lazy<'a, KnownTitles>,
}

impl<'a> StaleSearch<'a> {
    fn new(run: &'a EarlierPrograms<'a>) -> Self {
        let jobs = run.jobs;
        Self {
            run,
            outputs: jobs.iter().flat_map(|job| job.files.iter().map(|(_, path)| path.as_path())).collect(),
            by_stem: LazyCell::new(Box::new(move || {
                jobs.iter().enumerate().map(|(number, job)| (&*job.stem, number)).collect()
            })),
            writers: LazyCell::new(Box::new(move || KnownTitles::new(run))),
        }
    }

    /// Returns the programs and setup sheets in a directory that the run does not generate.
    fn candidates(&self, directory: &Utf8Path, names: &Names) -> impl Iterator<Item = Utf8PathBuf> {
        let programs = names.iter().filter(|name| is_gcode(name, self.run.post_processor) || is_sheet(name));
        let programs = programs.map(|name| join(directory, name));
        let mut programs: Vec<Utf8PathBuf> =
            programs.filter(|path| !self.outputs.contains(&**path)).collect();
        programs.sort_unstable();
        programs.into_iter()
    }

    /// Returns the names that former files of the jobs would have, outside the searched directories.
    fn former_files(&self, directories: &[Utf8PathBuf]) -> impl Iterator<Item = Utf8PathBuf> {
        let searched: HashSet<&Utf8Path> = directories.iter().map(|directory| &**directory).collect();
        let stems = self.run.jobs.iter().map(|job| &job.stem);
        let stems = stems.filter(move |stem| stem.parent().is_none_or(|parent| !searched.contains(parent)));
        let paths = stems.flat_map(|stem| possible_files(stem));
        paths.filter(|path| !self.outputs.contains(&**path))
    }

    /// Returns the programs and setup sheets that lie beside their drawings although programs are written into `out_dir`: all in the searched
    /// directories, and those of the jobs in other directories.
    fn programs_beside_drawings(
        &self,
        out_dir: &Utf8Path,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Utf8PathBuf> {
        let EarlierPrograms { session, directories, jobs, .. } = *self.run;
        let title = |path: &Utf8PathBuf| provenance(session, path).map(|(_, title)| title);
        let mut programs = Vec::new();
        for directory in directories.iter().filter(|directory| *directory != out_dir) {
            let names = self.run.file_names_in(directory, diagnostics);
            let drawings = names.iter().filter(|name| is_drawing(Utf8Path::new(name)));
            let drawings: HashSet<String> = drawings.map(plain_title).collect();
            let is_beside = |title: Box<str>| {
                native::drawing_of_title(&plain_title(&title))
                    .is_some_and(|drawing| drawings.contains(drawing))
            };
            programs
                .extend(self.candidates(directory, &names).filter(|path| title(path).is_some_and(is_beside)));
        }
        let searched: HashSet<&Utf8Path> = directories.iter().map(|directory| &**directory).collect();
        for job in jobs {
            let drawing = job.drawing(session.db()).path(session.db());
            let directory = drawing.parent().unwrap_or(Utf8Path::new(""));
            if directory != out_dir && !searched.contains(directory) {
                let files = possible_files(&join(directory, file_name(&job.stem)));
                programs.extend(
                    files.filter(|path| title(path).is_some_and(|title| is_of(job, session, &title))),
                );
            }
        }
        // The output directory may have several names, and a link beside the drawing may lead to the program in it.
        let canonical = |path: &Utf8Path| session.db().system().canonical(path);
        let is_current = |path: &Utf8PathBuf| canonical(path).parent() == Some(&canonical(out_dir));
        programs.retain(|path| !is_current(path));
        programs
    }

    /// Returns the program at `path` if it is stale. `beside` lists the files in its directory; `None` if programs of removed paths are not searched
    /// for.
    fn program_if_stale(&self, path: Utf8PathBuf, beside: Option<&Names>) -> Option<StaleProgram> {
        let (found, title) = provenance(self.run.session, &path)?;
        match self.native_job_of(&path) {
            Some(own) if is_of(own.job, self.run.session, &title) => {
                own.stale_program(self.run.session, path, &found)
            }
            _ if self.is_converted(&path, &found, &title) => self.if_other_heights(path),
            _ => self.of_other_post(&path, &found, &title).or_else(|| {
                let directory = path.parent().unwrap_or(Utf8Path::new(""));
                let reason = match native::joined_paths(&title) {
                    Some((names, join)) => {
                        beside?;
                        self.joined_reason(&path, &found, &names, &join)
                    }
                    None => self.writers.removal_reason(directory, &title, beside?.iter()),
                };
                let reason = match reason? {
                    Reason::Left | Reason::OtherJoined { .. } if !has_name_of_title(&path, &title) => {
                        Reason::Copied
                    }
                    reason => reason,
                };
                Some(StaleProgram { path, reason })
            }),
        }
    }

    /// Returns the program at `path` as stale if it was written for one of the run's paths, natively or through another post-processor, and that path
    /// has other moves now.
    fn of_other_post(&self, path: &Utf8Path, found: &Provenance, title: &str) -> Option<StaleProgram> {
        let name = path.with_extension("");
        let stem = PROGRAM_SUFFIXES.iter().find_map(|kind| name.as_str().strip_suffix(kind))?;
        let number = *self.by_stem.get(Utf8Path::new(stem))?;
        let job = self.run.jobs[number];
        let now = job.outcome.as_ref()?.provenance.as_ref()?;
        let is_meant = is_of(job, self.run.session, title) && now.moves != found.moves;
        let program = job.files.first()?.1.clone();
        is_meant.then(|| StaleProgram { path: path.to_owned(), reason: Reason::OtherMoves { program } })
    }

    /// Whether the program at `path` may have been converted from the current probing program or the adjusted program beside it, which `post` is for.
    fn is_converted(&self, path: &Utf8Path, found: &Provenance, title: &str) -> bool {
        let native = path.with_extension(NATIVE_EXTENSION);
        let stem = CONVERTED.iter().find_map(|kind| native.as_str().strip_suffix(kind.suffix()));
        let number = stem.and_then(|stem| self.by_stem.get(Utf8Path::new(stem)));
        let Some(job) = number.map(|number| self.run.jobs[*number]) else { return false };
        let now = job.outcome.as_ref().and_then(|outcome| outcome.provenance.as_ref());
        self.run.post_processor.is_none()
            && native != path
            && job.files.iter().any(|(kind, _)| *kind == OutputKind::Clean)
            && is_of(job, self.run.session, title)
            && now.is_some_and(|now| now.moves == found.moves)
            && provenance(self.run.session, &native).is_some_and(|(beside, _)| beside.is_same(found))
    }

    /// Returns a converted program as stale if it states other measured heights than the native one beside it.
    fn if_other_heights(&self, path: Utf8PathBuf) -> Option<StaleProgram> {
        let session = self.run.session;
        let program = path.with_extension(NATIVE_EXTENSION);
        let limit = session.workspace().settings.limits.file_size.value;
        let heights = |file: &Utf8Path| Some(listed_heights(&session.db().system().read(file, limit).ok()?));
        let (converted, now) = (heights(&path)?, heights(&program)?);
        let is_other = !converted.is_empty() && converted != now;
        is_other.then_some(StaleProgram { path, reason: Reason::OtherHeights { program } })
    }

    /// Returns the reason why the program at `path`, which joins the paths `names` as `join`, is stale; `None` if it is not, or if that is unknown.
    fn joined_reason(
        &self,
        path: &Utf8Path,
        found: &Provenance,
        names: &[String],
        join: &str,
    ) -> Option<Reason> {
        let EarlierPrograms { session, post_processor, task, .. } = *self.run;
        // The program that the run itself writes is not stale.
        if self.run.join.is_some_and(|own| plain_title(own) == join) {
            return None;
        }
        let db = session.db();
        let (mut programs, mut paths) = (Vec::new(), Vec::new());
        for name in names {
            let files = self.writers.drawings_of(session, name, path.parent()?);
            let target = match &*files {
                [] if self.writers.has_broken => return Some(Reason::Unwritten { path: name.clone() }),
                [] => return self.writers.reason_if_gone(),
                [(file, spelled)] => db.target(*file, spelled.as_str(), Role::Emitted),
                _ => return None,
            };
            match session.query_target(target, |db| program(db, target).clone()).ok()? {
                Some(program) => programs.push(program),
                None => return Some(Reason::Unwritten { path: target.name(db).to_string() }),
            }
            paths.push(target.name(db).to_string());
        }
        let now = Provenances::new(&session.workspace().settings, post_processor).of(&programs);
        let is_of_this_post = now.dialect == found.dialect
            && post_processor.is_some_and(|post| path.extension() == Some(post.extension()));
        let is_current = now.moves == found.moves
            && (!is_of_this_post || task == Task::Compare { moves_only: true } || now.is_same(found));
        (!is_current).then_some(Reason::OtherJoined { paths })
    }

    /// Finds the native job of the path that may have produced this file earlier.
    fn native_job_of(&self, path: &Utf8Path) -> Option<FormerFile<'a>> {
        if self.run.post_processor.is_some() {
            return None;
        }
        let of_kind = |kind: OutputKind| Some((kind, path.as_str().strip_suffix(kind.suffix())?));
        let (kind, stem) = OutputKind::ALL.into_iter().find_map(of_kind)?;
        let number = *self.by_stem.get(Utf8Path::new(stem))?;
        let job = self.run.jobs[number];
        let provenance = job.outcome.as_ref()?.provenance.as_ref()?;
        job.files.iter().all(|(present, _)| *present != kind).then_some(FormerFile { job, kind, provenance })
    }
}

impl FormerFile<'_> {
    /// Returns the former file as stale, unless it is the result of adjusting the current program with the current values.
    fn stale_program(
        &self,
        session: &Session<'_>,
        path: Utf8PathBuf,
        found: &Provenance,
    ) -> Option<StaleProgram> {
        if self.kind != OutputKind::Milling {
            return Some(StaleProgram { path, reason: Reason::Left });
        }
        let reason = match self.file(OutputKind::Clean) {
            None if self.provenance.is_same(found) => return None,
            None => Reason::Left,
            Some(clean) if !self.provenance.is_same(found) => Reason::Adjusted { clean: clean.to_owned() },
            Some(clean) => self.edit_reason(session, &path, clean)?,
        };
        Some(StaleProgram { path, reason })
    }

    fn file(&self, kind: OutputKind) -> Option<&Utf8Path> {
        self.job.files.iter().find(|(present, _)| *present == kind).map(|(_, path)| path.as_path())
    }

    /// Returns the reason why an adjusted program with the current provenance is stale: it was edited, or the measured values have changed. `None`
    /// also for unreadable files.
    fn edit_reason(&self, session: &Session<'_>, path: &Utf8Path, clean: &Utf8Path) -> Option<Reason> {
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

/// Returns the files that a path with this stem may have, with every post that has a usual extension.
fn possible_files(stem: &Utf8Path) -> impl Iterator<Item = Utf8PathBuf> + use<> {
    let stem = stem.to_owned();
    let native = OutputKind::ALL.map(|kind| Utf8PathBuf::from(format!("{stem}{}", kind.suffix())));
    let posted = PROGRAM_EXTENSIONS[1..].iter();
    native.into_iter().chain(posted.map(move |extension| format!("{stem}_Milling.{extension}").into()))
}

/// Whether a program's title names the path of this job.
fn is_of(job: &Job, session: &Session<'_>, title: &str) -> bool {
    let db = session.db();
    let drawing = job.drawing(db).path(db).file_name().unwrap_or_default();
    native::is_title(title, drawing, &job.path)
}

const SHEET_SUFFIX: &str = "_Sheet";

const NATIVE_EXTENSION: &str = "gcode";

/// The kinds of native programs that are converted for the machine.
const CONVERTED: [OutputKind; 2] = [OutputKind::Milling, OutputKind::Probing];

const PROGRAM_SUFFIXES: [&str; 3] = ["_Milling", "_Clean", "_Probing"];

/// Whether a program is named after the drawing or path in this title, as `emit` names the programs of paths without R.
fn has_name_of_title(program: &Utf8Path, title: &str) -> bool {
    let title = plain_title(title);
    let joined = native::joined_paths(&title).map(|(_, name)| name);
    let drawing = native::drawing_of_title(&title).and_then(|drawing| Utf8Path::new(drawing).file_stem());
    let path = title.split_once(' ').and_then(|(_, rest)| rest.split_once(',')).map(|(path, _)| path);
    let name = plain_title(program.file_stem().unwrap_or_default());
    let suffixes = PROGRAM_SUFFIXES.into_iter().chain([SHEET_SUFFIX]).map(str::to_lowercase);
    let stem = suffixes.into_iter().find_map(|suffix| name.strip_suffix(&*suffix));
    stem.is_some() && [drawing, path, joined.as_deref()].contains(&stem)
}

/// Returns the reason if a file is named after another path than that of `program` and contains the program of that path: `program` must not
/// replace it.
pub fn program_of_other_path(
    workspace: &Workspace,
    file: &Utf8Path,
    program: &[u8],
) -> Option<&'static Text> {
    let owner = |title: &str| match native::joined_paths(title) {
        Some((_, name)) => name,
        None => plain_title(title),
    };
    let (_, current) = Provenance::of_head(&workspace.system.read_head(file, HEAD_BYTES).ok()?)?;
    let (_, new) = Provenance::of_head(program)?;
    (owner(&new) != owner(&current) && has_name_of_title(file, &current)).then_some(&PROGRAM_OF_OTHER_PATH)
}

/// Whether this is the file name of a program. The extension that a post definition chooses is recognised only while that definition is in use.
fn is_gcode(name: &str, post_processor: Option<&PostProcessor>) -> bool {
    let name = Utf8Path::new(name);
    is_program(name) || post_processor.is_some_and(|post| post.has_extension(name))
}

fn is_sheet(name: &str) -> bool {
    OutputKind::ALL.iter().any(|kind| kind.sheet().is_some() && name.ends_with(kind.suffix()))
}

/// The drawings and paths that may have produced a program.
struct KnownTitles {
    /// Titles of paths in covered drawings for which the run generates nothing, because they have errors or are not selected. Existing files may
    /// still belong to them.
    idle: BTreeSet<Title>,
    /// Drawings whose paths are all known to the run.
    covered: BTreeSet<Title>,
    /// Drawings that cannot be read, with their file names.
    unread: BTreeMap<Title, String>,
    /// Existing drawings whose paths the run does not know.
    others: BTreeSet<Title>,
    /// Names of the drawings in the search directories, which `emit` finds although they may not be in the library.
    searched: BTreeSet<String>,
    /// Names of all drawings in the directories of the library, even if they are ignored, by the names normalised for comparison.
    in_library: BTreeMap<String, Box<str>>,
    /// Whether all programs are written into an output directory.
    has_out_dir: bool,
    /// The paths of covered drawings, by their names, normalised for comparison.
    paths: Vec<(String, Utf8PathBuf, PathName)>,
    /// Whether a covered drawing has errors, which may hide paths.
    has_broken: bool,
    /// Whether the run knows all drawings of the library, or all drawings beside the program. If so, a drawing that it does not know does not exist
    /// any more.
    knows_all: bool,
    /// Whether the output directory lies outside the configuration's directory, where other libraries may use it.
    is_shared: bool,
}

/// Returns the title of a program, normalised for comparison.
fn title(drawing: &str, path: &str) -> String {
    plain_title(&native::title(drawing, path))
}

fn file_name(drawing: &Utf8Path) -> &str {
    drawing.file_name().unwrap_or_default()
}

/// Output directory of a program, and its title or drawing, normalised for comparison (see [`plain_title`]).
type Title = (Utf8PathBuf, String);

impl KnownTitles {
    fn new(run: &EarlierPrograms<'_>) -> Self {
        let EarlierPrograms { session, jobs, .. } = run;
        let out_dir = session.out_dir();
        let all_covered = (run.covered)();
        let db = session.db();
        let place = |drawing: &Utf8Path| output_directory(out_dir.as_deref(), drawing);
        let written = |drawing: &Utf8Path| (place(drawing), plain_title(file_name(drawing)));
        let path = |drawing: &Utf8Path, path: &str| (place(drawing), title(file_name(drawing), path));
        let generated: BTreeSet<Title> =
            jobs.iter().map(|job| path(job.drawing(db).path(db), &job.path)).collect();
        let names = |drawing: &'_ Answer<DrawingResult>| {
            let file = drawing.drawing().to_owned();
            let named = |name: &PathName| (plain_title(name.as_str()), file.clone(), name.clone());
            drawing.value.names.iter().map(named).collect::<Vec<_>>()
        };
        let paths: Vec<_> = all_covered.iter().flat_map(names).collect();
        let of_covered = paths.iter().map(|(_, drawing, name)| path(drawing, name.as_str()));
        let is_broken =
            |drawing: &&Answer<DrawingResult>| drawing.value.diagnostics.iter().any(Diagnostic::is_error);
        let (broken, sound): (Vec<_>, Vec<_>) = all_covered.iter().partition(is_broken);
        let unread =
            broken.iter().filter(|drawing| drawing.value.is_unread() && drawing.value.names.is_empty());
        let unread =
            unread.map(|drawing| (written(drawing.drawing()), file_name(drawing.drawing()).to_owned()));
        let covered: HashSet<&Utf8Path> = sound.iter().map(|drawing| drawing.drawing()).collect();
        let has_library = session.has_library();
        let (library, problems) = if has_library { session.library() } else { Default::default() };
        let others = library.iter().filter(|drawing| !covered.contains(&***drawing));
        let others = others.map(|drawing| &**drawing).chain(broken.iter().map(|drawing| drawing.drawing()));
        Self {
            idle: of_covered.filter(|title| !generated.contains(title)).collect(),
            covered: covered.iter().map(|drawing| written(drawing)).collect(),
            unread: unread.collect(),
            others: others.map(written).collect(),
            searched: searched_drawings(session),
            has_out_dir: out_dir.is_some(),
            in_library: session.names_in_library().map(|name| (plain_title(&name), name)).collect(),
            has_broken: !broken.is_empty(),
            paths,
            knows_all: if has_library {
                !library.is_empty() && problems.is_empty() && session.missing_directories().is_empty()
            } else {
                out_dir.is_none()
            },
            is_shared: out_dir.as_ref().is_some_and(|directory| is_outside(session, directory)),
        }
    }

    /// Returns the reason why a program that no path of the run yields is stale; `None` if a path that the run does not generate may yield it.
    /// `beside` lists the files in its directory.
    fn removal_reason<'n>(
        &self,
        directory: &Utf8Path,
        title: &str,
        mut beside: impl Iterator<Item = &'n str>,
    ) -> Option<Reason> {
        let title = plain_title(title);
        let named = |text: &str| (directory.to_owned(), text.to_owned());
        let drawing = named(native::drawing_of_title(&title)?);
        if let Some(drawing) = self.unread.get(&drawing) {
            return Some(Reason::Unread { drawing: drawing.clone() });
        }
        let beside = beside.find(|name| plain_title(name) == drawing.1);
        if self.idle.contains(&named(&title)) || self.others.contains(&drawing) {
            return None;
        }
        if self.covered.contains(&drawing) {
            return Some(Reason::Left);
        }
        // A drawing that exists although the run does not know it is ignored, unless the search finds it or another library may have it.
        let in_library = self.in_library.get(&drawing.1).map(|name| &**name);
        let ignored = if self.has_out_dir { in_library.filter(|_| !self.is_shared) } else { beside };
        if let Some(drawing) = ignored {
            return Some(Reason::Ignored { drawing: drawing.to_owned() });
        }
        let is_there = beside.is_some() || in_library.is_some() || self.searched.contains(&drawing.1);
        if is_there { None } else { self.reason_if_gone() }
    }

    /// Returns the reason why a program is stale if its drawing was not found.
    fn reason_if_gone(&self) -> Option<Reason> {
        self.knows_all.then_some(if self.is_shared { Reason::OfOthers } else { Reason::Left })
    }

    /// Returns the drawings that define a path, among those of the run, those beside the program and those where paths are looked up, with the path's
    /// name as spelled there. `name` is normalised for comparison.
    fn drawings_of(
        &self,
        session: &Session<'_>,
        name: &str,
        directory: &Utf8Path,
    ) -> Vec<(SourceFile, PathName)> {
        let covered = self.paths.iter().filter(|(plain, ..)| plain == name);
        let covered: Vec<_> =
            covered.map(|(_, drawing, spelled)| (session.file(drawing), spelled.clone())).collect();
        if !covered.is_empty() {
            return covered;
        }
        let mut directories = session.name_directories();
        directories.push(directory.to_owned());
        let name = PathName::new(name);
        let files = session.definitions(&name, &directories);
        files.into_iter().map(|file| (file, name.clone())).collect()
    }
}

/// Returns the names of the files in the search directories, normalised for comparison.
fn searched_drawings(session: &Session<'_>) -> BTreeSet<String> {
    let directories = session.workspace().settings.general.search.value.iter();
    let listed = directories.filter_map(|directory| session.file_names_in(&session.normal(directory)).ok());
    listed.flat_map(|names| names.iter().map(plain_title).collect::<Vec<_>>()).collect()
}

/// Whether a directory lies outside the directory of the configuration.
fn is_outside(session: &Session<'_>, directory: &Utf8Path) -> bool {
    let workspace = session.workspace();
    let own = session.normal(workspace.settings.directory().unwrap_or(&workspace.working_directory));
    let rest = directory.strip_prefix(own);
    !rest.is_ok_and(|rest| rest.is_relative() && !rest.starts_with(".."))
}

/// The programs in output directories. Each directory is listed at most once, when its programs are first requested.
#[derive(Default)]
struct ProgramListings {
    programs: HashMap<Utf8PathBuf, Vec<(String, Utf8PathBuf)>>,
    problems: Vec<Diagnostic>,
}

impl ProgramListings {
    /// Returns the programs in a directory with names that begin with `stem`, ignoring case.
    fn programs_beginning_with(
        &mut self,
        run: &EarlierPrograms<'_>,
        directory: &Utf8PathBuf,
        stem: &str,
    ) -> impl Iterator<Item = &Utf8PathBuf> {
        let programs = self.programs.entry(directory.clone()).or_insert_with(|| {
            let names = run.file_names_in(directory, &mut self.problems);
            let programs = names.iter().filter(|name| is_gcode(name, run.post_processor));
            let mut programs: Vec<_> =
                programs.map(|name| (name.to_lowercase(), join(directory, name))).collect();
            programs.sort_unstable();
            programs
        });
        let stem = stem.to_lowercase();
        let first = programs.partition_point(|(name, _)| *name < stem);
        programs[first..]
            .iter()
            .take_while(move |(name, _)| name.starts_with(&stem))
            .map(|(_, program)| program)
    }
}

fn earlier_outcome(program: Utf8PathBuf, path: &str, task: Task) -> ProgramOutcome {
    let problem = Diagnostic::new(&messages::OLDER_OUTPUT)
        .quoting("name", program.file_name().unwrap_or_default())
        .quoting("path", path)
        .in_file(&program);
    let problem = task.error_if_compared(problem);
    let files = task.is_comparison().then_some((program, State::Outdated)).into_iter().collect();
    ProgramOutcome { path: path.into(), files, problems: vec![problem], ..ProgramOutcome::default() }
}
