//! Resolves arguments to drawings and paths. (book: reference/commands)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Db, Role, SourceFile, Target, check_file, holders, path_names};
use pathbuild_diagnostic::messages::{outputs as messages, paths};
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::{PathName, with_near_names};
use rustc_hash::FxHashSet;

use super::argument_matches::{Argument, ArgumentMatches, SearchedDirectory};
use super::{Session, by_place};
use crate::inputs::Inputs;

/// The drawings and paths that arguments resolve to.
#[derive(Debug, Default)]
pub struct Selection {
    /// Drawings in named directories, sorted by place, without those that were named themselves.
    pub drawings: Vec<Utf8PathBuf>,
    /// Drawings that were named.
    pub named: Vec<SourceFile>,
    /// Paths that were named.
    pub paths: Vec<SelectedPath>,
    /// Directories that were named; without arguments, those of the library.
    pub directories: Vec<Utf8PathBuf>,
    /// These directories and all below them.
    pub below: Vec<Utf8PathBuf>,
    /// Names that are unknown or ambiguous.
    pub problems: Vec<Diagnostic>,
}

/// A path that was named.
#[derive(Clone, Debug)]
pub struct SelectedPath {
    /// The drawing that defines it.
    pub file: SourceFile,
    /// Its name as the drawing spells it.
    pub name: PathName,
}

/// Returns the names of a drawing's paths. A cached answer saves reading the drawing.
pub type NamesOf<'a> = &'a dyn Fn(SourceFile) -> &'a [PathName];

impl Session<'_> {
    /// Resolves the arguments; without any, selects the library.
    pub fn select(&self, inputs: &Inputs) -> Selection {
        let matches = self.match_arguments(inputs);
        let mut selection =
            self.select_arguments(&matches, &matches.arguments, &|file| path_names(&self.db, file));
        selection.problems.splice(..0, matches.problems);
        selection
    }

    /// Resolves some of the arguments.
    pub fn select_arguments(
        &self,
        found: &ArgumentMatches,
        arguments: &[Argument],
        names: NamesOf<'_>,
    ) -> Selection {
        let mut selection = Selection::default();
        let mut walked = Vec::new();
        for argument in arguments {
            walked.extend(self.add(argument, found, names, &mut selection));
        }
        let is_wrong = |problems: &[Diagnostic]| problems.iter().any(Diagnostic::is_error);
        if !is_wrong(&selection.problems) && !is_wrong(&found.problems) {
            selection.problems.extend(Self::without_drawings(found.is_library, &walked));
        }
        let named: FxHashSet<&Utf8PathBuf> = selection.named.iter().map(|file| file.path(&self.db)).collect();
        selection.drawings.retain(|drawing| !named.contains(drawing));
        selection.drawings.sort_by(|a, b| by_place(a, b));
        selection.drawings.dedup();
        selection.below.sort_by(|a, b| by_place(a, b));
        selection.below.dedup();
        selection
    }

    /// Adds the drawings and paths of an argument. Returns the directory if the argument is one.
    fn add<'f>(
        &self,
        argument: &'f Argument,
        found: &ArgumentMatches,
        names: NamesOf<'_>,
        selection: &mut Selection,
    ) -> Option<&'f SearchedDirectory> {
        match argument {
            Argument::Directory(directory) => {
                selection.add(directory);
                return Some(directory);
            }
            Argument::Drawing(file) => selection.name(*file),
            Argument::Name { name, candidates, drawing, directory } => {
                let defines = |file: &SourceFile| names(*file).contains(name);
                let files = self.distinct(candidates.iter().copied().filter(defines));
                if !files.is_empty() {
                    // Another definition may have been missed.
                    selection.problems.extend_from_slice(&found.name_problems);
                }
                match (files.as_slice(), drawing, directory) {
                    ([file], ..) => {
                        let spelled = names(*file).iter().find(|known| *known == name).unwrap_or(name);
                        selection.paths.push(SelectedPath { file: *file, name: spelled.clone() });
                    }
                    ([first, second, ..], ..) => {
                        selection.problems.push(self.defined_twice(name, *first, *second));
                    }
                    ([], Some(drawing), _) => selection.name(*drawing),
                    // Users type `check components`; nothing else has that name.
                    ([], None, Some(directory)) => {
                        selection.add(directory);
                        return Some(directory);
                    }
                    ([], None, None) => {
                        selection.problems.extend(self.name_problems(found));
                        let read_errors = self.read_errors(candidates, names);
                        if read_errors.is_empty() {
                            let known = candidates.iter().flat_map(|file| names(*file)).cloned().collect();
                            let problem = no_such_path(name, &found.name_directories);
                            selection.problems.push(with_near_names(problem, name, known));
                        }
                        selection.problems.extend(read_errors);
                    }
                }
            }
        }
        None
    }

    /// Errors that kept candidate drawings from being read. Only candidates without a known path matter: the wanted path may be in one of
    /// them.
    fn read_errors(&self, candidates: &[SourceFile], names: NamesOf<'_>) -> Vec<Diagnostic> {
        let is_unread = |file: &SourceFile| names(*file).is_empty();
        let files = self.distinct(candidates.iter().copied().filter(is_unread));
        let problems = files.iter().flat_map(|file| check_file(&self.db, *file));
        problems.filter(|problem| problem.is_error()).cloned().collect()
    }

    /// Errors that may have kept a name from being found.
    fn name_problems(&self, found: &ArgumentMatches) -> Vec<Diagnostic> {
        if self.has_library() { found.name_problems.clone() } else { self.all_drawings().1 }
    }

    /// The distinct drawings in these directories that define a path. Directories that cause an internal error are skipped: for arguments
    /// the error was already reported, and hints can do without.
    pub fn definitions(&self, name: &PathName, directories: &[Utf8PathBuf]) -> Vec<SourceFile> {
        let holders = |directory: &Utf8PathBuf| {
            self.query_directory(directory, |directory| holders(&self.db, directory, name))
        };
        self.distinct(directories.iter().flat_map(holders).flatten())
    }

    /// Removes drawings that are reached under a second name.
    fn distinct(&self, files: impl Iterator<Item = SourceFile>) -> Vec<SourceFile> {
        let mut seen = FxHashSet::default();
        files.filter(|file| seen.insert(self.db.system().canonical(file.path(&self.db)))).collect()
    }

    fn defined_twice(&self, name: &PathName, first: SourceFile, second: SourceFile) -> Diagnostic {
        let path = |file: SourceFile| file.path(&self.db).as_str();
        Diagnostic::new(&paths::DEFINED_TWICE)
            .quoting("name", name.as_str())
            .quoting("first", path(first))
            .quoting("second", path(second))
            .in_file(first.path(&self.db))
    }
}

impl Selection {
    /// All drawings that are selected as a whole.
    pub fn whole(&self, session: &Session<'_>) -> Vec<SourceFile> {
        let mut files = session.db().files(self.drawings.clone());
        files.extend(&self.named);
        files
    }

    fn add(&mut self, directory: &SearchedDirectory) {
        self.problems.extend_from_slice(&directory.problems);
        self.drawings.extend_from_slice(&directory.drawings);
        self.directories.push(directory.path.clone());
        self.below.extend_from_slice(&directory.directories);
    }

    fn name(&mut self, file: SourceFile) {
        if !self.named.contains(&file) {
            self.named.push(file);
        }
    }
}

fn no_such_path(name: &PathName, directories: &[Utf8PathBuf]) -> Diagnostic {
    let shown = |directory: &Utf8PathBuf| {
        if directory.as_str().is_empty() { ".".to_owned() } else { directory.to_string() }
    };
    let directories: Value = directories.iter().map(shown).collect();
    Diagnostic::new(&messages::NO_SUCH_PATH).quoting("name", name.as_str()).with("directories", directories)
}

/// A drawing with those of its paths that an argument means.
#[derive(Debug)]
pub struct NamedPaths {
    /// The drawing.
    pub file: SourceFile,
    /// The path that was named, or all paths of the drawing that was named.
    pub names: Vec<PathName>,
}

/// Why an argument does not name one path.
#[derive(Debug)]
pub enum NotOnePath {
    /// It names a directory.
    Directory,
    /// It names a drawing with several paths.
    Several(NamedPaths),
    /// It is unknown or ambiguous, or names a drawing without a path.
    Wrong(Vec<Diagnostic>),
}

impl Session<'_> {
    /// Resolves an argument to a drawing and its paths; `None` if it names a directory.
    ///
    /// # Errors
    /// The diagnostics of a name that is unknown or ambiguous.
    pub fn named_paths(&self, argument: &str) -> Result<Option<NamedPaths>, Vec<Diagnostic>> {
        let selection = self.select(&Inputs { inputs: vec![argument.to_owned()] });
        if !selection.problems.is_empty() {
            return Err(self.with_hints(selection.problems));
        }
        Ok(match (&*selection.directories, &*selection.paths, &*selection.named) {
            ([], [path], []) => Some(NamedPaths { file: path.file, names: vec![path.name.clone()] }),
            ([], [], [file]) => {
                Some(NamedPaths { file: *file, names: path_names(self.db(), *file).to_vec() })
            }
            _ => None,
        })
    }

    /// Resolves an argument to one path: its name, or that of a drawing with no other path.
    ///
    /// # Errors
    /// What it names instead.
    pub fn one_path(&self, argument: &str, role: Role) -> Result<Target, NotOnePath> {
        let named = self.named_paths(argument).map_err(NotOnePath::Wrong)?.ok_or(NotOnePath::Directory)?;
        match &*named.names {
            [name] => Ok(self.target_in(named.file, name, role)),
            [] => {
                let mut found = check_file(self.db(), named.file).to_vec();
                found.extend(self.no_path(named.file.path(self.db()), &named.names, &found));
                Err(NotOnePath::Wrong(found))
            }
            _ => Err(NotOnePath::Several(named)),
        }
    }

    /// PB513 for a drawing that was named but contains no path, unless its errors explain that.
    pub fn no_path(
        &self,
        drawing: &Utf8Path,
        names: &[PathName],
        found: &[Diagnostic],
    ) -> Option<Diagnostic> {
        let is_explained = !names.is_empty() || found.iter().any(Diagnostic::is_error);
        (!is_explained).then(|| {
            Diagnostic::new(&messages::NO_PATH)
                .quoting("pattern", &*self.context.settings.general.path_pattern.value)
                .in_file(drawing)
        })
    }
}

/// PB512 for a drawing that was named where one path is meant.
pub fn several_paths(drawing: &Utf8Path, names: &[PathName]) -> Diagnostic {
    let list: Value = names.iter().map(PathName::as_str).collect();
    Diagnostic::new(&messages::SEVERAL_PATHS)
        .with("names", list)
        .quoting("first", names.first().map_or("", PathName::as_str))
        .in_file(drawing)
}
