//! Resolves arguments to drawings and paths. (book: reference/commands)

use camino::Utf8PathBuf;
use pathbuild_db::{Db, SourceFile, check_file, holders, path_names};
use pathbuild_diagnostic::messages::{outputs as messages, subpaths};
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::PathName;
use rustc_hash::FxHashSet;

use super::found::{Argument, Found, FoundDirectory};
use super::{Session, by_place};
use crate::inputs::Inputs;

/// The drawings and paths that arguments resolve to.
#[derive(Debug, Default)]
pub struct Wanted {
    /// Drawings in named directories, sorted by place, without those that were named themselves.
    pub drawings: Vec<Utf8PathBuf>,
    /// Drawings that were named.
    pub named: Vec<SourceFile>,
    /// Paths that were named.
    pub paths: Vec<WantedPath>,
    /// Directories that were named; without arguments, those of the library.
    pub directories: Vec<Utf8PathBuf>,
    /// These directories and all below them.
    pub below: Vec<Utf8PathBuf>,
    /// Names that are unknown or ambiguous.
    pub problems: Vec<Diagnostic>,
}

/// A path that was named.
#[derive(Clone, Debug)]
pub struct WantedPath {
    /// The drawing that defines it.
    pub file: SourceFile,
    /// Its name as the drawing spells it.
    pub name: PathName,
}

/// Returns the names of a drawing's paths. A cached answer saves reading the drawing.
pub type NamesOf<'a> = &'a dyn Fn(SourceFile) -> &'a [PathName];

impl Session<'_> {
    /// Resolves the arguments; without any, selects the library.
    pub fn wanted(&self, inputs: &Inputs) -> Wanted {
        let found = self.found(inputs);
        let mut wanted = self.meant(&found, &found.arguments, &|file| path_names(&self.db, file));
        wanted.problems.splice(..0, found.problems);
        wanted
    }

    /// Resolves some of the arguments.
    pub fn meant(&self, found: &Found, arguments: &[Argument], names: NamesOf<'_>) -> Wanted {
        let mut wanted = Wanted::default();
        let mut walked = Vec::new();
        for argument in arguments {
            walked.extend(self.add(argument, found, names, &mut wanted));
        }
        let is_wrong = |problems: &[Diagnostic]| problems.iter().any(Diagnostic::is_error);
        if !is_wrong(&wanted.problems) && !is_wrong(&found.problems) {
            wanted.problems.extend(Self::without_drawings(found.is_library, &walked));
        }
        let named: FxHashSet<&Utf8PathBuf> = wanted.named.iter().map(|file| file.path(&self.db)).collect();
        wanted.drawings.retain(|drawing| !named.contains(drawing));
        wanted.drawings.sort_by(|a, b| by_place(a, b));
        wanted.drawings.dedup();
        wanted.below.sort_by(|a, b| by_place(a, b));
        wanted.below.dedup();
        wanted
    }

    /// Adds the drawings and paths of an argument. Returns the directory if the argument is one.
    fn add<'f>(
        &self,
        argument: &'f Argument,
        found: &Found,
        names: NamesOf<'_>,
        wanted: &mut Wanted,
    ) -> Option<&'f FoundDirectory> {
        match argument {
            Argument::Directory(directory) => {
                wanted.add(directory);
                return Some(directory);
            }
            Argument::Drawing(file) => wanted.name(*file),
            Argument::Name { name, candidates, drawing, directory } => {
                let defines = |file: &SourceFile| names(*file).contains(name);
                let files = self.different(candidates.iter().copied().filter(defines));
                if !files.is_empty() {
                    // Another definition may have been missed.
                    wanted.problems.extend_from_slice(&found.name_problems);
                }
                match (files.as_slice(), drawing, directory) {
                    ([file], ..) => {
                        let spelt = names(*file).iter().find(|known| *known == name).unwrap_or(name);
                        wanted.paths.push(WantedPath { file: *file, name: spelt.clone() });
                    }
                    ([first, second, ..], ..) => {
                        wanted.problems.push(self.defined_twice(name, *first, *second));
                    }
                    ([], Some(drawing), _) => wanted.name(*drawing),
                    // Users type `check components`; nothing else has that name.
                    ([], None, Some(directory)) => {
                        wanted.add(directory);
                        return Some(directory);
                    }
                    ([], None, None) => {
                        wanted.problems.extend(self.name_problems(found));
                        let unread = self.unread(candidates, names);
                        if unread.is_empty() {
                            wanted.problems.push(nowhere(name, &found.name_directories));
                        }
                        wanted.problems.extend(unread);
                    }
                }
            }
        }
        None
    }

    /// Errors that kept candidate drawings from being read. Only candidates without a known path matter: the wanted path may be in one of
    /// them.
    fn unread(&self, candidates: &[SourceFile], names: NamesOf<'_>) -> Vec<Diagnostic> {
        let is_unread = |file: &SourceFile| names(*file).is_empty();
        let files = self.different(candidates.iter().copied().filter(is_unread));
        let problems = files.iter().flat_map(|file| check_file(&self.db, *file));
        problems.filter(|problem| problem.is_error()).cloned().collect()
    }

    /// Errors that may have kept a name from being found.
    fn name_problems(&self, found: &Found) -> Vec<Diagnostic> {
        if self.has_library() { found.name_problems.clone() } else { self.everything().1 }
    }

    /// The distinct drawings in these directories that define a path. Directories that cause an internal error are skipped: for arguments
    /// the error was already reported, and hints can do without.
    pub fn definitions(&self, name: &PathName, directories: &[Utf8PathBuf]) -> Vec<SourceFile> {
        let holders = |directory: &Utf8PathBuf| {
            self.of_directory(directory, |directory| holders(&self.db, directory, name))
        };
        self.different(directories.iter().flat_map(holders).flatten())
    }

    /// Removes drawings that are reached under a second name.
    fn different(&self, files: impl Iterator<Item = SourceFile>) -> Vec<SourceFile> {
        let mut seen = FxHashSet::default();
        files.filter(|file| seen.insert(self.db.system().canonical(file.path(&self.db)))).collect()
    }

    fn defined_twice(&self, name: &PathName, first: SourceFile, second: SourceFile) -> Diagnostic {
        let path = |file: SourceFile| file.path(&self.db).as_str();
        Diagnostic::new(&subpaths::DEFINED_TWICE)
            .with("name", name.as_str())
            .with("first", path(first))
            .with("second", path(second))
            .in_file(first.path(&self.db))
    }
}

impl Wanted {
    /// All drawings that are selected as a whole.
    pub fn whole(&self, session: &Session<'_>) -> Vec<SourceFile> {
        let mut files = session.db().files(self.drawings.clone());
        files.extend(&self.named);
        files
    }

    fn add(&mut self, directory: &FoundDirectory) {
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

fn nowhere(name: &PathName, directories: &[Utf8PathBuf]) -> Diagnostic {
    let shown = |directory: &Utf8PathBuf| {
        if directory.as_str().is_empty() { ".".to_owned() } else { directory.to_string() }
    };
    let directories: Value = directories.iter().map(shown).collect();
    Diagnostic::new(&messages::NO_SUCH_PATH).with("name", name.as_str()).with("directories", directories)
}
