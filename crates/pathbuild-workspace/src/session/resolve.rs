//! Which drawings and paths the arguments mean. (book: reference/commands)

use camino::Utf8PathBuf;
use pathbuild_db::{Db, SourceFile, check_file, holders, path_names};
use pathbuild_diagnostic::messages::{outputs as messages, subpaths};
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::PathName;
use rustc_hash::FxHashSet;

use super::found::{Argument, Found, FoundDirectory};
use super::{Session, by_place};
use crate::inputs::Inputs;

/// What arguments come to.
#[derive(Debug, Default)]
pub struct Wanted {
    /// Drawings that lie in directories that were named, in order of place, without those that were named themselves.
    pub drawings: Vec<Utf8PathBuf>,
    /// Drawings that were named.
    pub named: Vec<SourceFile>,
    /// Paths that were named.
    pub paths: Vec<WantedPath>,
    /// Directories that were named; without arguments, those of the library.
    pub directories: Vec<Utf8PathBuf>,
    /// These, and all below them.
    pub below: Vec<Utf8PathBuf>,
    /// Names that mean nothing, or too much.
    pub problems: Vec<Diagnostic>,
}

/// A path that was asked for by its name.
#[derive(Clone, Debug)]
pub struct WantedPath {
    /// The drawing that defines it.
    pub file: SourceFile,
    /// As the drawing spells it.
    pub name: PathName,
}

/// The names of the paths in a drawing: whoever knows them from an earlier run need not read it.
pub type NamesOf<'a> = &'a dyn Fn(SourceFile) -> &'a [PathName];

impl Session<'_> {
    /// What the arguments mean; without any, the library.
    pub fn wanted(&self, inputs: &Inputs) -> Wanted {
        let found = self.found(inputs);
        let mut wanted = self.meant(&found, &found.arguments, &|file| path_names(&self.db, file));
        wanted.problems.splice(..0, found.problems);
        wanted
    }

    /// What some of the arguments mean.
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

    /// Adds what an argument means; a directory, if it is one.
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
                    // It may be there once more.
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
                    // `check components` is what people type; nothing else of that name was meant.
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

    /// What kept drawings from being read that may define a path: those of which no path is known. The path may well be in one of them.
    fn unread(&self, candidates: &[SourceFile], names: NamesOf<'_>) -> Vec<Diagnostic> {
        let is_unread = |file: &SourceFile| names(*file).is_empty();
        let files = self.different(candidates.iter().copied().filter(is_unread));
        let problems = files.iter().flat_map(|file| check_file(&self.db, *file));
        problems.filter(|problem| problem.is_error()).cloned().collect()
    }

    /// What may have kept a name from being found.
    fn name_problems(&self, found: &Found) -> Vec<Diagnostic> {
        if self.has_library() { found.name_problems.clone() } else { self.everything().1 }
    }

    /// The drawings in some directories that define a path, each once. A directory that shows a bug has none: of arguments it was said when they
    /// were looked for, else nothing but a hint is wanted.
    pub fn definitions(&self, name: &PathName, directories: &[Utf8PathBuf]) -> Vec<SourceFile> {
        let holders = |it: &Utf8PathBuf| self.of_directory(it, |it| holders(&self.db, it, name));
        self.different(directories.iter().flat_map(holders).flatten())
    }

    /// Each drawing once, by whatever names it is reached.
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
    /// Every drawing of which all is wanted.
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
