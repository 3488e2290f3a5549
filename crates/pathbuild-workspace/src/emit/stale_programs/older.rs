//! Finds programs of paths that the run could not write (PB522), because the paths have errors, or their drawing cannot be read or is gone.

use std::collections::{BTreeSet, HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{Names, join};
use pathbuild_db::{SourceFile, Target};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_gcode::native::{self, plain_title};

use super::names::is_gcode;
use super::{EarlierPrograms, file_name, provenance};
use crate::emit::outcome::{ProgramOutcome, State, Task};
use crate::emit::plan::{Job, output_directory, post_output_file};
use crate::memo::find;
use crate::post_processor::PostProcessor;
use crate::session::Argument;

impl<'a> EarlierPrograms<'a> {
    /// Finds the programs on disk of targets for which nothing was written or compared. Each becomes a separate outcome; a comparison reports it as
    /// out of date.
    pub(super) fn earlier_outcomes(&self, diagnostics: &mut Vec<Diagnostic>) -> Vec<ProgramOutcome> {
        let targets = self.targets;
        let is_done = |job: &&&Job| job.outcome.as_ref().is_some_and(|outcome| !outcome.files.is_empty());
        if let (Some(name), Some(post_processor)) = (self.join, self.post_processor) {
            let joined = targets.first().filter(|_| !self.jobs.iter().any(|job| is_done(&job)));
            let program = joined.and_then(|first| self.joined_program(*first, name, post_processor));
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
                let drawing = DrawingOrPath::Drawing(file_name(file.path(db)));
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
                Some(LostName { name: DrawingOrPath::Path(name.as_str()), directories, has_drawing })
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
        // As long as the drawing in the title exists, the program may be current, although no argument led to this drawing.
        let is_gone = |program: &Utf8Path, title: &str| {
            let plain = plain_title(title);
            let drawing = native::drawing_of_title(&plain).unwrap_or_default();
            let beside = self.session.file_names_in(program.parent().unwrap_or(Utf8Path::new("")));
            let mut beside = beside.iter().flat_map(Names::iter);
            lost.has_drawing || !beside.any(|name| plain_title(name) == drawing)
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
    fn joined_program(
        &self,
        first: Target,
        name: &str,
        post_processor: &PostProcessor,
    ) -> Option<Utf8PathBuf> {
        let db = self.session.db();
        let directory = output_directory(self.session.out_dir().as_deref(), first.file(db).path(db));
        let program = post_output_file(&join(&directory, name), post_processor);
        let (_, title) = provenance(self.session, &program)?;
        native::joined_paths(&title).map(|_| program)
    }
}

/// A drawing or path that an argument names, and that cannot be read or is gone.
struct LostName<'a> {
    name: DrawingOrPath<'a>,
    /// The directories in which its programs may be.
    directories: Vec<Utf8PathBuf>,
    /// Whether the argument names a drawing, or a path that a drawing may define judging by its file name.
    has_drawing: bool,
}

#[derive(Clone, Copy)]
enum DrawingOrPath<'a> {
    Drawing(&'a str),
    Path(&'a str),
}

impl<'a> DrawingOrPath<'a> {
    /// Returns the text with which the names of its programs begin: of a path's name, the part before the first dot, which the names of its drawing
    /// and of its own programs have in common. Empty for a drawing, because the names of its paths are unknown.
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
