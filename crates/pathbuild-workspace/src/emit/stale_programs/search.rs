//! Finds out which programs on disk are stale, and why.

use std::cell::LazyCell;
use std::collections::{HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{Names, is_drawing, join};
use pathbuild_db::{Db, Role, program};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::adjust::{Source, has_differing_values, is_adjusted_from, listed_heights};
use pathbuild_gcode::native::{self, plain_title};
use pathbuild_gcode::provenance::Provenance;

use super::known_titles::KnownTitles;
use super::names::{has_name_of_title, is_gcode, is_sheet, possible_files};
use super::reason::{Reason, StaleProgram};
use super::{EarlierPrograms, file_name, has_title_of_job, provenance};
use crate::emit::options::Provenances;
use crate::emit::outcome::Task;
use crate::emit::plan::Job;
use crate::session::{OutputKind, OutputName, Session};

type Lazy<'a, T> = LazyCell<T, Box<dyn FnOnce() -> T + 'a>>;

pub(super) struct StaleSearch<'a> {
    run: &'a EarlierPrograms<'a>,
    outputs: HashSet<&'a Utf8Path>,
    /// Index of each job by the stem of its file names.
    by_stem: Lazy<'a, HashMap<&'a Utf8Path, usize>>,
    /// Indices of the jobs by the titles of their programs, normalised for comparison.
    by_title: Lazy<'a, HashMap<String, Vec<usize>>>,
    known_titles: Lazy<'a, KnownTitles>,
}

impl<'a> StaleSearch<'a> {
    pub(super) fn new(run: &'a EarlierPrograms<'a>) -> Self {
        let jobs = run.jobs;
        Self {
            run,
            outputs: jobs.iter().flat_map(|job| job.files.iter().map(|(_, path)| path.as_path())).collect(),
            by_stem: LazyCell::new(Box::new(move || {
                jobs.iter().enumerate().map(|(number, job)| (&*job.stem, number)).collect()
            })),
            by_title: LazyCell::new(Box::new(move || {
                let mut by_title: HashMap<String, Vec<usize>> = HashMap::new();
                for (number, job) in jobs.iter().enumerate() {
                    let drawing = file_name(job.drawing(run.session.db()).path(run.session.db()));
                    let title = plain_title(&native::title(drawing, &job.path));
                    by_title.entry(title).or_default().push(number);
                }
                by_title
            })),
            known_titles: LazyCell::new(Box::new(move || KnownTitles::new(run))),
        }
    }

    /// Returns the programs and setup sheets in a directory that the run does not generate.
    pub(super) fn candidates(
        &self,
        directory: &Utf8Path,
        names: &Names,
    ) -> impl Iterator<Item = Utf8PathBuf> {
        let programs = names.iter().filter(|name| is_gcode(name, self.run.post_processor) || is_sheet(name));
        let programs = programs.map(|name| join(directory, name));
        let mut programs: Vec<Utf8PathBuf> =
            programs.filter(|path| !self.outputs.contains(&**path)).collect();
        programs.sort_unstable();
        programs.into_iter()
    }

    /// Returns the paths to which earlier runs may have written files of the same jobs, except in `directories`, which are searched anyway.
    pub(super) fn former_files(&self, directories: &[Utf8PathBuf]) -> impl Iterator<Item = Utf8PathBuf> {
        let searched: HashSet<&Utf8Path> = directories.iter().map(|directory| &**directory).collect();
        let stems = self.run.jobs.iter().map(|job| &job.stem);
        let stems = stems.filter(move |stem| stem.parent().is_none_or(|parent| !searched.contains(parent)));
        let paths = stems.flat_map(|stem| possible_files(stem));
        paths.filter(|path| !self.outputs.contains(&**path))
    }

    /// Returns the stale programs and setup sheets outside the directories in which the run searches for programs of removed paths: those beside
    /// their drawings if programs are written into `out_dir`, and older ones of the jobs, which remain if `out-dir` is changed. `searched` lists the
    /// directories in which the run has searched already.
    pub(super) fn programs_elsewhere(
        &self,
        out_dir: Option<&Utf8Path>,
        searched: &[Utf8PathBuf],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<StaleProgram> {
        let EarlierPrograms { session, directories, .. } = *self.run;
        let mut seen: HashSet<&Utf8Path> = searched.iter().map(|directory| &**directory).collect();
        let mut stale = Vec::new();
        for directory in directories.iter().filter(|directory| seen.insert(directory)) {
            let names = self.run.file_names_in(directory, diagnostics);
            stale.extend(self.stale_programs_in(directory, &names, out_dir));
        }
        let former =
            if directories.is_empty() { Vec::new() } else { session.possible_output_directories(out_dir) };
        for directory in former.iter().filter(|directory| seen.insert(directory)) {
            // No programs are expected in this directory, so no error is reported if it cannot be listed.
            let names = session.file_names_in(directory).unwrap_or_default();
            stale.extend(self.stale_programs_in(directory, &names, None));
        }
        let Some(out_dir) = out_dir else { return stale };
        stale.extend(self.programs_beside_drawings(out_dir));
        // The output directory may have several names, and a link beside the drawing may lead to the program in it.
        let canonical = |path: &Utf8Path| session.db().system().canonical(path);
        stale.retain(|stale| canonical(&stale.path).parent() != Some(&canonical(out_dir)));
        stale
    }

    /// Returns the stale programs in a directory to which the run writes nothing. `names` lists its files.
    fn stale_programs_in(
        &self,
        directory: &Utf8Path,
        names: &Names,
        out_dir: Option<&Utf8Path>,
    ) -> Vec<StaleProgram> {
        let drawings = names.iter().filter(|name| is_drawing(Utf8Path::new(name)));
        let drawings: HashSet<String> = drawings.map(plain_title).collect();
        let stale = |path: Utf8PathBuf| {
            let (found, title) = provenance(self.run.session, &path)?;
            let is_beside = native::drawing_of_title(&plain_title(&title))
                .is_some_and(|drawing| drawings.contains(drawing));
            let reason = match out_dir {
                Some(out_dir) if is_beside => Reason::Beside { directory: out_dir.to_owned() },
                _ => self.reason_if_moved(&path, &found, &title, names)?,
            };
            Some(StaleProgram { path, reason })
        };
        self.candidates(directory, names).filter_map(stale).collect()
    }

    /// Returns the programs of the jobs that lie beside their drawings outside the searched directories, although programs are written into
    /// `out_dir`.
    fn programs_beside_drawings(&self, out_dir: &Utf8Path) -> Vec<StaleProgram> {
        let EarlierPrograms { session, directories, jobs, .. } = *self.run;
        let searched: HashSet<&Utf8Path> = directories.iter().map(|directory| &**directory).collect();
        let title = |path: &Utf8PathBuf| provenance(session, path).map(|(_, title)| title);
        let mut stale = Vec::new();
        for job in jobs {
            let drawing = job.drawing(session.db()).path(session.db());
            let directory = drawing.parent().unwrap_or(Utf8Path::new(""));
            if directory != out_dir && !searched.contains(directory) {
                let files = possible_files(&join(directory, file_name(&job.stem)));
                let own = files
                    .filter(|path| title(path).is_some_and(|title| has_title_of_job(job, session, &title)));
                let reason = || Reason::Beside { directory: out_dir.to_owned() };
                stale.extend(own.map(|path| StaleProgram { path, reason: reason() }));
            }
        }
        stale
    }

    /// Returns the program at `path` if it is stale. `beside` lists the files in its directory; `None` if programs of removed paths are not searched
    /// for.
    pub(super) fn program_if_stale(&self, path: Utf8PathBuf, beside: Option<&Names>) -> Option<StaleProgram> {
        let (found, title) = provenance(self.run.session, &path)?;
        match self.native_job_of(&path) {
            Some(own) if has_title_of_job(own.job, self.run.session, &title) => {
                own.stale_program(self.run.session, path, &found)
            }
            _ if self.is_converted(&path, &found, &title) => self.stale_converted_program(path),
            _ => self.program_of_other_post(&path, &found, &title).or_else(|| {
                let reason = match self.reason_without_job(&path, &found, &title, beside?)? {
                    Reason::Left | Reason::OtherJoined { .. } if !has_name_of_title(&path, &title) => {
                        self.reason_of_copy(&path, &found, &title)
                    }
                    reason => reason,
                };
                Some(StaleProgram { path, reason })
            }),
        }
    }

    /// Returns the reason why a program that the run does not write, and that may join several paths, is stale. `None` if it is not, or if that is
    /// unknown.
    fn reason_without_job(
        &self,
        path: &Utf8Path,
        found: &Provenance,
        title: &str,
        beside: &Names,
    ) -> Option<Reason> {
        if let Some((names, join)) = native::joined_paths(title) {
            return self.joined_reason(path, found, &names, &join);
        }
        let directory = path.parent().unwrap_or(Utf8Path::new(""));
        let gone = self.known_titles.stale_reason(directory, title, beside.iter());
        gone.or_else(|| self.reason_if_moved(path, found, title, beside))
            .or_else(|| self.reason_if_unselected(directory, found, title))
    }

    /// Returns the reason why a program with a name that `emit` does not give it is stale.
    fn reason_of_copy(&self, path: &Utf8Path, found: &Provenance, title: &str) -> Reason {
        let session = self.run.session;
        let limit = session.workspace().settings.limits.file_size.value;
        let read = |file: &Utf8Path| session.db().system().read(file, limit).ok();
        let is_current = |job: &Job| {
            let now = job.outcome.as_ref().and_then(|outcome| outcome.provenance.as_ref());
            let text = read(path).filter(|_| now.is_some_and(|now| now.is_same(found)));
            text.is_some_and(|text| job.files.iter().any(|(_, file)| read(file).as_ref() == Some(&text)))
        };
        let job = self.run.jobs.iter().find(|job| has_title_of_job(job, session, title));
        let current = job.filter(|job| is_current(job));
        current.map_or(Reason::Copied, |job| Reason::CurrentCopy { path: job.path.to_string() })
    }

    /// Returns the reason why a program may be stale if the run did not select its path. `None` if it did, or if the title does not identify a single
    /// path.
    fn reason_if_unselected(&self, directory: &Utf8Path, found: &Provenance, title: &str) -> Option<Reason> {
        let session = self.run.session;
        let (drawing, name) = self.known_titles.path_without_output(directory, title)?;
        let target = session.db().target(session.file(drawing), name.as_str(), Role::Emitted);
        let is_selected = self.run.targets.contains(&target);
        let path = name.to_string();
        (!is_selected).then(|| Reason::Unselected { path, target, moves: found.moves.clone() })
    }

    /// Returns the reason why a program without its drawing beside it is stale: the run writes the program of this path, which has other moves now,
    /// into another directory.
    fn reason_if_moved(
        &self,
        path: &Utf8Path,
        found: &Provenance,
        title: &str,
        beside: &Names,
    ) -> Option<Reason> {
        let plain = plain_title(title);
        let drawing = native::drawing_of_title(&plain)?;
        if beside.iter().any(|name| plain_title(name) == drawing) {
            return None;
        }
        let jobs = self.by_title.get(&plain)?.iter().map(|number| self.run.jobs[*number]);
        let written: Vec<(&Provenance, &Utf8PathBuf)> = jobs
            .filter_map(|job| Some((job.outcome.as_ref()?.provenance.as_ref()?, &job.files.first()?.1)))
            .collect();
        let is_current = written.iter().any(|(now, _)| now.moves == found.moves);
        let (_, program) = written.first()?;
        let is_elsewhere = program.parent() != path.parent();
        (is_elsewhere && !is_current).then(|| Reason::Elsewhere { program: (*program).clone() })
    }

    /// Returns the program at `path` as stale if it was written for one of the run's paths, natively or through another post-processor, and that path
    /// has other moves now.
    fn program_of_other_post(
        &self,
        path: &Utf8Path,
        found: &Provenance,
        title: &str,
    ) -> Option<StaleProgram> {
        let name = OutputName::parse(path.as_str())?;
        let job = self.job(name).filter(|_| OutputKind::GCODE.contains(&name.kind))?;
        let now = job.outcome.as_ref()?.provenance.as_ref()?;
        let is_meant = has_title_of_job(job, self.run.session, title) && now.moves != found.moves;
        let program = job.files.first()?.1.clone();
        is_meant.then(|| StaleProgram { path: path.to_owned(), reason: Reason::OtherMoves { program } })
    }

    /// Whether the program at `path` may have been converted, by the command `post`, from the current probing program or the adjusted program beside
    /// it.
    fn is_converted(&self, path: &Utf8Path, found: &Provenance, title: &str) -> bool {
        let posted = OutputName::parse(path.as_str()).filter(|name| !name.is_native);
        let Some((name, job)) = posted.and_then(|name| Some((name, self.job(name)?))) else { return false };
        let now = job.outcome.as_ref().and_then(|outcome| outcome.provenance.as_ref());
        self.run.post_processor.is_none()
            && name.kind != OutputKind::Clean
            && job.files.iter().any(|(kind, _)| *kind == OutputKind::Clean)
            && has_title_of_job(job, self.run.session, title)
            && now.is_some_and(|now| now.moves == found.moves)
            && provenance(self.run.session, &name.kind.file(name.stem))
                .is_some_and(|(beside, _)| beside.is_same(found))
    }

    /// Returns a converted program as stale if it states other measured heights than the native one beside it.
    fn stale_converted_program(&self, path: Utf8PathBuf) -> Option<StaleProgram> {
        let session = self.run.session;
        let name = OutputName::parse(path.as_str())?;
        let program = name.kind.file(name.stem);
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
            let files = self.known_titles.drawings_of(session, &plain_title(name), path.parent()?);
            let target = match &*files {
                [] if self.known_titles.has_broken => return Some(Reason::Unwritten { path: name.clone() }),
                [] => return self.known_titles.reason_if_gone(),
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
        let name = OutputName::parse(path.as_str()).filter(|name| name.is_native)?;
        let (job, kind) = (self.job(name)?, name.kind);
        let provenance = job.outcome.as_ref()?.provenance.as_ref()?;
        job.files.iter().all(|(present, _)| *present != kind).then_some(FormerFile { job, kind, provenance })
    }

    /// Returns the job with files of this stem.
    fn job(&self, name: OutputName<'_>) -> Option<&'a Job> {
        Some(self.run.jobs[*self.by_stem.get(Utf8Path::new(name.stem))?])
    }
}

/// A file that a job's path yielded earlier, but that the job does not generate: `_Milling` beside `_Clean` (adjusted from it, or written before the
/// path had probes), or `_Clean` and `_Probing` (written while the path had probes).
pub(super) struct FormerFile<'a> {
    pub(super) job: &'a Job,
    pub(super) kind: OutputKind,
    /// Provenance of the current program.
    pub(super) provenance: &'a Provenance,
}

impl FormerFile<'_> {
    /// Returns the former file as stale, unless it is the result of adjusting the current program with the current values.
    pub(super) fn stale_program(
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
        let is_other = has_differing_values(program, source(values, &read(values)?));
        is_other.then(|| Reason::OtherValues { values: values.to_owned() })
    }
}
