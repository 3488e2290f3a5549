//! Jobs: a program to be generated, and the files that it consists of.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::join;
use pathbuild_db::{Database, SourceFile, Target, path_names, trace};
use pathbuild_diagnostic::messages::{outputs as messages, posts};
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_gcode::native;

use super::FileOwners;
use super::deliver::{ProgramOutcome, cannot_write};
use super::store::{CachedJob, CachedProgram};
use crate::config::types::SheetFormat;
use crate::posting::PostProcessor;
use crate::session::{CheckedTarget, OutputKind, ProgramFacts, Session, stem_fault};

/// A path without errors, or several that are joined into one program, with the files to generate.
#[derive(Debug, PartialEq)]
pub(super) struct Job {
    /// What is cached of it.
    pub(super) known: CachedOutcome,
    /// The paths in milling order; never empty.
    pub(super) targets: Vec<Target>,
    /// The drawings that were read for them, starting with the first path's own. Includes drawings that were searched without success.
    pub(super) sources: Vec<SourceFile>,
    /// Name of the path as the drawing spells it, or the name of the joined program.
    pub(super) path: Box<str>,
    /// Output directory and common stem of the file names.
    pub(super) stem: Utf8PathBuf,
    /// The files, with their kinds.
    pub(super) files: Vec<(OutputKind, Utf8PathBuf)>,
    /// Title of the program, which follows its provenance.
    pub(super) title: String,
}

impl Job {
    /// A job whose paths have a cached result.
    pub(super) fn known(targets: Vec<Target>, CachedJob { path, stem, files, program }: CachedJob) -> Self {
        let known = program.map_or(CachedOutcome::Plan, |program| CachedOutcome::Program(Box::new(program)));
        Self { known, targets, sources: Vec::new(), path, stem, files, title: String::new() }
    }

    /// The drawing of the first path.
    pub(super) fn drawing(&self, db: &Database) -> SourceFile {
        self.targets[0].file(db)
    }

    /// The path and its drawing, for messages.
    fn name(&self, session: &Session<'_>) -> String {
        let db = session.db();
        format!("{} ({})", self.path, self.drawing(db).path(db))
    }

    /// Claims the job's file names. PB514 if another target that still yields a program has claimed one of them.
    pub(super) fn claim(
        &self,
        session: &Session<'_>,
        owners: &mut FileOwners,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> bool {
        let names = || self.files.iter().map(|(_, path)| path.as_str().to_lowercase());
        let other =
            names().find_map(|name| owners.get(&name).copied().filter(|owner| *owner != self.targets[0]));
        let db = session.db();
        if let Some(other) = other {
            let name = format!("{} ({})", other.name(db), other.file(db).path(db));
            let problem = Diagnostic::new(&messages::SAME_OUTPUT)
                .quoting("name", self.files[0].1.file_name().unwrap_or_default())
                .quoting("first", name)
                .quoting("second", self.name(session))
                .in_file(self.drawing(db).path(db));
            diagnostics.push(problem);
            return false;
        }
        owners.extend(names().map(|name| (name, self.targets[0])));
        true
    }

    /// The outcome of a job that was aborted.
    pub(super) fn aborted(&self, session: &Session<'_>, problem: Diagnostic) -> ProgramOutcome {
        let problem = problem.in_file(self.drawing(session.db()).path(session.db())).in_path(&self.path);
        ProgramOutcome { problems: vec![problem], ..ProgramOutcome::default() }
    }
}

/// What earlier runs left in the cache about a job.
#[derive(Debug, PartialEq)]
pub(super) enum CachedOutcome {
    Nothing,
    /// Only the names of its files: the job was dropped because another path claims one of them.
    Plan,
    /// Its outcome.
    Program(Box<CachedProgram>),
}

/// Turns checked paths into jobs.
pub(super) struct JobBuilder<'a> {
    pub(super) session: &'a Session<'a>,
    /// The post-processor to write programs through.
    pub(super) post_processor: Option<&'a PostProcessor>,
    /// Name of the one program that all paths are joined into.
    pub(super) join: Option<&'a str>,
    /// Format of the setup sheet.
    pub(super) sheet: SheetFormat,
}

impl JobBuilder<'_> {
    /// The job for the paths of one program; `None` if any of them has errors.
    ///
    /// # Errors
    /// Why no program can be generated from error-free paths.
    pub(super) fn job(&self, checked: &[CheckedTarget]) -> Result<Option<Job>, Vec<Diagnostic>> {
        match (self.join, checked) {
            (Some(name), checked) => self.joined_job(name, checked),
            (None, [checked]) => {
                let Some(emitted) = &checked.emitted else { return Ok(None) };
                self.single_job(checked, emitted).map(Some).map_err(|problem| vec![*problem])
            }
            (None, _) => Ok(None),
        }
    }

    fn joined_job(&self, name: &str, checked: &[CheckedTarget]) -> Result<Option<Job>, Vec<Diagnostic>> {
        let right = || checked.iter().filter_map(|checked| Some((checked, checked.emitted.as_ref()?)));
        let refused = right().filter_map(|(checked, emitted)| self.refuse_probes(checked, emitted).err());
        let refused: Vec<Diagnostic> = refused.map(|problem| *problem).collect();
        if !refused.is_empty() {
            return Err(refused);
        }
        let Some(first) = checked.first().filter(|_| right().count() == checked.len()) else {
            return Ok(None);
        };
        let directory = output_directory(self.session, first.target.file(self.session.db()));
        let stem = named(name, name, &directory).map_err(|problem| vec![*problem])?;
        let title = joined_title(name, checked);
        Ok(Some(Job { title, ..self.with_files(stem, name, checked, &[OutputKind::Milling]) }))
    }

    fn single_job(&self, checked: &CheckedTarget, emitted: &ProgramFacts) -> Result<Job, Box<Diagnostic>> {
        let db = self.session.db();
        let file = checked.target.file(db);
        let at = |problem: Box<Diagnostic>| Box::new(problem.in_file(file.path(db)).in_path(&emitted.path));
        let is_alone = path_names(db, file).len() == 1;
        let name = if is_alone { file.path(db).file_stem().unwrap_or_default() } else { &emitted.path };
        let directory = output_directory(self.session, file);
        let full = format!("{name}{}", emitted.suffix);
        let stem = named(&full, if is_alone { &emitted.suffix } else { &full }, &directory).map_err(at)?;
        self.refuse_probes(checked, emitted)?;
        let kinds = OutputKind::of(emitted.has_probes);
        Ok(self.with_files(stem, &emitted.path, std::slice::from_ref(checked), kinds))
    }

    /// Refuses probes with a post-processor: its output cannot contain formulas, so they would be measured for nothing.
    fn refuse_probes(&self, checked: &CheckedTarget, emitted: &ProgramFacts) -> Result<(), Box<Diagnostic>> {
        if self.post_processor.is_none() || !emitted.has_probes {
            return Ok(());
        }
        let db = self.session.db();
        let problem = Diagnostic::new(&posts::POST_WITH_PROBES).in_path(&emitted.path);
        Err(Box::new(problem.in_file(checked.target.file(db).path(db))))
    }

    fn with_files(
        &self,
        stem: Utf8PathBuf,
        path: &str,
        checked: &[CheckedTarget],
        kinds: &[OutputKind],
    ) -> Job {
        let name = |kind: &OutputKind| match self.post_processor {
            Some(post_processor) if kind.is_program() => program_name(stem.as_str(), post_processor).into(),
            _ => Utf8PathBuf::from(format!("{stem}{}", kind.suffix())),
        };
        let kinds = kinds.iter().copied().chain(OutputKind::of_sheet(self.sheet));
        let db = self.session.db();
        let drawing = checked[0].target.file(db).path(db).file_name().unwrap_or_default();
        Job {
            known: CachedOutcome::Nothing,
            title: native::title(drawing, path),
            targets: checked.iter().map(|checked| checked.target).collect(),
            path: path.into(),
            files: kinds.map(|kind| (kind, name(&kind))).collect(),
            stem,
            sources: sources(db, checked),
        }
    }
}

/// The drawings that were read for the paths, without duplicates.
fn sources(db: &Database, checked: &[CheckedTarget]) -> Vec<SourceFile> {
    let mut seen = HashSet::new();
    let read = checked.iter().flat_map(|checked| &trace(db, checked.target).files).copied();
    read.filter(|file| seen.insert(*file)).collect()
}

/// Contains neither a comma nor a drawing's name, so that the program is not mistaken for a single drawing's stale program.
fn joined_title(name: &str, checked: &[CheckedTarget]) -> String {
    let paths = checked.iter().filter_map(|checked| checked.emitted.as_ref()).map(|emitted| &*emitted.path);
    format!("Paths {} joined as {name}", paths.collect::<Vec<_>>().join(" + ")).replace(',', " ")
}

/// File name of a program written through a post-processor.
pub(super) fn program_name(stem: &str, post_processor: &PostProcessor) -> String {
    format!("{stem}_Milling.{}", post_processor.extension())
}

/// Directory of the files of a drawing's paths: that of the drawing, unless the configuration names one.
pub(super) fn output_directory(session: &Session<'_>, drawing: SourceFile) -> Utf8PathBuf {
    match &session.workspace().settings.general.out_dir.value {
        Some(directory) => session.normal(directory),
        None => drawing.path(session.db()).parent().unwrap_or(Utf8Path::new("")).to_owned(),
    }
}

/// Removes jobs of which two would write the same file, and returns them (PB514).
pub(super) fn take_clashes(
    session: &Session<'_>,
    jobs: &mut Vec<Job>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Job> {
    let refused = clashes(session, jobs, diagnostics);
    let mut index = 0..;
    jobs.extract_if(.., |_| index.next().is_some_and(|index| refused.contains(&index))).collect()
}

/// Indices of jobs that would write the same file as another. Case is ignored, as some file systems do.
fn clashes(session: &Session<'_>, jobs: &[Job], diagnostics: &mut Vec<Diagnostic>) -> BTreeSet<usize> {
    let mut owners: BTreeMap<String, (&Utf8Path, Vec<usize>)> = BTreeMap::new();
    for (index, job) in jobs.iter().enumerate() {
        for (_, path) in &job.files {
            owners.entry(path.as_str().to_lowercase()).or_insert((path, Vec::new())).1.push(index);
        }
    }
    let mut refused = BTreeSet::new();
    for (path, owners) in owners.into_values().filter(|(_, owners)| owners.len() > 1) {
        // For two jobs that share several files, the first file is enough.
        if owners.iter().any(|owner| !refused.contains(owner)) {
            let db = session.db();
            let problem = Diagnostic::new(&messages::SAME_OUTPUT)
                .quoting("name", path.file_name().unwrap_or_default())
                .quoting("first", jobs[owners[0]].name(session))
                .quoting("second", jobs[owners[1]].name(session))
                .in_file(jobs[owners[0]].drawing(db).path(db));
            diagnostics.push(problem);
        }
        refused.extend(owners);
    }
    refused
}

/// Joins a file name to a directory, unless the system forbids the name. `rest` is the part that does not stem from the drawing's name.
fn named(name: &str, rest: &str, directory: &Utf8Path) -> Result<Utf8PathBuf, Box<Diagnostic>> {
    if let Some(fault) = stem_fault(name, rest) {
        return Err(Box::new(cannot_write(name, Value::Prose(fault))));
    }
    Ok(join(directory, name))
}
