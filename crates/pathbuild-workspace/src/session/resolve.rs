//! Resolves arguments to drawings and paths. Diagnostics get hints: paths that exist elsewhere in the library, misspelled names on the command
//! line, missing directories, directories without drawings, drawings without paths. (book: reference/commands; book: language/embedding;
//! book: reference/diagnostics)

use std::cell::LazyCell;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{Entry, EntryKind, FileKind, is_drawing, is_hidden, join};
use pathbuild_db::{
    Db, Role, SecondDefinition, SourceFile, Target, catch_bugs, check_file, defining_files, path_names,
};
use pathbuild_diagnostic::messages::{configuration, files, outputs, outputs as messages, paths};
use pathbuild_diagnostic::{Diagnostic, Message, Value, nearest};
use pathbuild_path::{PathName, with_near_names};
use rustc_hash::FxHashSet;

use super::argument_matches::{Argument, ArgumentMatches, SearchedDirectory};
use super::library::FileFilter;
use super::{Session, compare_paths};
use crate::config::SourcedValue;
use crate::inputs::Inputs;
use crate::workspace::relative;

/// The drawings and paths that arguments resolve to.
#[derive(Debug, Default)]
pub struct Selection {
    /// Drawings in named directories, in the order of their paths, except for those that the arguments also name individually.
    pub drawings: Vec<Utf8PathBuf>,
    /// Drawings that the arguments name.
    pub named: Vec<SourceFile>,
    /// Paths that the arguments name.
    pub paths: Vec<SelectedPath>,
    /// Directories that were named; without arguments, those of the library.
    pub directories: Vec<Utf8PathBuf>,
    /// The named directories and all directories below them.
    pub below: Vec<Utf8PathBuf>,
    /// Diagnostics of the arguments, such as unknown or ambiguous names and directories that cannot be listed.
    pub problems: Vec<Diagnostic>,
}

/// A path that an argument names.
#[derive(Clone, Debug)]
pub struct SelectedPath {
    /// The drawing that defines the path.
    pub file: SourceFile,
    /// Name of the path, as the drawing spells it.
    pub name: PathName,
}

/// A function that returns the names of a drawing's paths, from the cache if possible, so that the drawing need not be read.
pub type NamesOf<'a> = &'a dyn Fn(SourceFile) -> &'a [PathName];

impl Session<'_> {
    /// Resolves the arguments; without any, selects the library.
    pub fn select(&self, inputs: &Inputs) -> Selection {
        self.select_matches(self.match_arguments(inputs))
    }

    /// Resolves the arguments from the files and directories that match them.
    pub fn select_matches(&self, matches: ArgumentMatches) -> Selection {
        let mut selection =
            self.select_arguments(&matches, &matches.arguments, &|file| path_names(&self.db, file));
        selection.problems.splice(..0, matches.problems);
        selection
    }

    /// Resolves some or all of the arguments in `found`.
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
            selection.problems.extend(Self::empty_directory_errors(found.is_library, &walked));
        }
        let named: FxHashSet<&Utf8PathBuf> = selection.named.iter().map(|file| file.path(&self.db)).collect();
        selection.drawings.retain(|drawing| !named.contains(drawing));
        selection.drawings.sort_by(|a, b| compare_paths(a, b));
        selection.drawings.dedup();
        selection.below.sort_by(|a, b| compare_paths(a, b));
        selection.below.dedup();
        selection
    }

    /// Adds the drawings and paths of an argument. Returns the directory if the argument is a directory.
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
            Argument::Drawing(file) => selection.add_named(*file),
            Argument::Name { name, candidates, drawing, directory } => {
                let defines = |file: &SourceFile| names(*file).contains(name);
                let files = self.distinct_files(candidates.iter().copied().filter(defines));
                if !files.is_empty() {
                    // These errors may have hidden another definition of the path.
                    selection.problems.extend_from_slice(&found.name_problems);
                }
                match (files.as_slice(), drawing, directory) {
                    ([file], ..) => {
                        let spelled = names(*file).iter().find(|known| *known == name).unwrap_or(name);
                        selection.paths.push(SelectedPath { file: *file, name: spelled.clone() });
                    }
                    ([first, second, ..], ..) => {
                        let files = [first, second].map(|file| file.path(&self.db).clone());
                        let found = SecondDefinition { name: name.clone(), files };
                        selection.problems.push(found.diagnostic());
                    }
                    ([], Some(drawing), _) => selection.add_named(*drawing),
                    // A directory in the working directory, as in `check components`, if neither a path nor a drawing has that name.
                    ([], None, Some(directory)) => {
                        selection.add(directory);
                        return Some(directory);
                    }
                    ([], None, None) => {
                        selection.problems.extend(self.name_problems(found));
                        let read_errors = self.read_errors(candidates, names);
                        if read_errors.is_empty() {
                            let known = candidates.iter().flat_map(|file| names(*file)).cloned().collect();
                            let problem = no_such_path_error(name, &found.name_directories);
                            selection.problems.push(with_near_names(problem, name, known));
                        }
                        selection.problems.extend(read_errors);
                    }
                }
            }
        }
        None
    }

    /// Returns the errors that kept candidate drawings from being read. Only candidates without a known path matter, because any of them may
    /// contain the requested path.
    fn read_errors(&self, candidates: &[SourceFile], names: NamesOf<'_>) -> Vec<Diagnostic> {
        let is_unread = |file: &SourceFile| names(*file).is_empty();
        let files = self.distinct_files(candidates.iter().copied().filter(is_unread));
        files.into_iter().flat_map(|file| self.errors_without_paths(file)).cloned().collect()
    }

    /// Returns the errors of a drawing without any known path: they may hide its paths. Other errors of a drawing do not keep questions about its
    /// paths from being answered.
    pub fn errors_without_paths(&self, file: SourceFile) -> impl Iterator<Item = &Diagnostic> {
        let is_unread = path_names(&self.db, file).is_empty();
        let found = is_unread.then(|| check_file(&self.db, file)).into_iter().flatten();
        found.filter(|problem| problem.is_error())
    }

    /// Returns the errors that may have kept a name from being found.
    fn name_problems(&self, found: &ArgumentMatches) -> Vec<Diagnostic> {
        if self.has_library() { found.name_problems.clone() } else { self.all_drawings().1 }
    }

    /// Returns the distinct drawings in these directories that define a path. Directories that cannot be queried are skipped: for arguments, the
    /// reason was already reported, and hints are not essential.
    pub fn definitions(&self, name: &PathName, directories: &[Utf8PathBuf]) -> Vec<SourceFile> {
        let defining_files = |directory: &Utf8PathBuf| {
            self.query_directory(directory, |directory| defining_files(&self.db, directory, name))
        };
        self.distinct_files(directories.iter().flat_map(defining_files).flatten())
    }

    /// Removes drawings that occur again under another file name.
    fn distinct_files(&self, files: impl Iterator<Item = SourceFile>) -> Vec<SourceFile> {
        let mut seen = FxHashSet::default();
        files.filter(|file| seen.insert(self.db.system().canonical(file.path(&self.db)))).collect()
    }
}

impl Selection {
    /// Returns all drawings that are selected as a whole.
    pub fn whole_drawings(&self, session: &Session<'_>) -> Vec<SourceFile> {
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

    fn add_named(&mut self, file: SourceFile) {
        if !self.named.contains(&file) {
            self.named.push(file);
        }
    }
}

fn no_such_path_error(name: &PathName, directories: &[Utf8PathBuf]) -> Diagnostic {
    let shown = |directory: &Utf8PathBuf| {
        if directory.as_str().is_empty() { ".".to_owned() } else { directory.to_string() }
    };
    let directories: Value = directories.iter().map(shown).collect();
    Diagnostic::new(&messages::NO_SUCH_PATH).quoting("name", name.as_str()).with("directories", directories)
}

/// A drawing with the paths in it that an argument selects.
#[derive(Debug)]
pub struct NamedPaths {
    /// The drawing that contains the paths.
    pub file: SourceFile,
    /// The path that the argument names, or all paths if it names the drawing.
    pub names: Vec<PathName>,
}

/// The reason why an argument does not name exactly one path.
#[derive(Debug)]
pub enum NotOnePath {
    /// The argument names a directory.
    Directory,
    /// The argument names a drawing with several paths.
    Several(NamedPaths),
    /// The argument is unknown or ambiguous, or names a drawing without a path.
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
            ([], paths, named) if paths.len() + named.len() > 1 => {
                let named = named.iter().map(|file| file.path(self.db()).as_str());
                let names: Value = paths.iter().map(|path| path.name.as_str()).chain(named).collect();
                let problem = Diagnostic::new(&messages::SEVERAL_MATCHES).quoting("pattern", argument);
                return Err(vec![problem.with("names", names)]);
            }
            _ => None,
        })
    }

    /// Resolves an argument to one path, which it names directly or by a drawing with no other path.
    ///
    /// # Errors
    /// If the argument does not name exactly one path, with the reason.
    pub fn one_path(&self, argument: &str, role: Role) -> Result<Target, NotOnePath> {
        let named = self.named_paths(argument).map_err(NotOnePath::Wrong)?.ok_or(NotOnePath::Directory)?;
        match &*named.names {
            [name] => Ok(self.db.target(named.file, name.as_str(), role)),
            [] => {
                let mut found = check_file(self.db(), named.file).to_vec();
                found.extend(self.no_path_error(named.file.path(self.db()), &named.names, &found));
                Err(NotOnePath::Wrong(found))
            }
            _ => Err(NotOnePath::Several(named)),
        }
    }

    /// Returns PB513 for a drawing that was named but contains no path, unless the drawing's errors explain that.
    pub fn no_path_error(
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

/// Returns PB512 for a drawing with several paths that was named where one path is needed.
pub fn several_paths_error(drawing: &Utf8Path, names: &[PathName]) -> Diagnostic {
    let list: Value = names.iter().map(PathName::as_str).collect();
    Diagnostic::new(&messages::SEVERAL_PATHS)
        .with("names", list)
        .quoting("first", names.first().map_or("", PathName::as_str))
        .in_file(drawing)
}

impl Session<'_> {
    /// Adds to each PB503 about a subpath the place in the library where that path is defined. The library is searched only if there is such a
    /// diagnostic.
    pub(super) fn with_library_hints(&self, diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
        let directories = LazyCell::new(|| self.library_directories());
        let mut definitions: BTreeMap<PathName, Option<Utf8PathBuf>> = BTreeMap::new();
        let with_library_hints = |diagnostic: Diagnostic| {
            let Some(name) = missing_path(&diagnostic) else { return diagnostic };
            let file = definitions.entry(name.clone()).or_insert_with(|| {
                let files = self.definitions(&name, &directories);
                files.first().map(|file| file.path(self.db()).clone())
            });
            match file {
                Some(file) => self.note(diagnostic, file),
                None => diagnostic,
            }
        };
        diagnostics.into_iter().map(with_library_hints).collect()
    }

    fn note(&self, diagnostic: Diagnostic, file: &Utf8Path) -> Diagnostic {
        let directory = self.as_configured(file.parent().unwrap_or(Utf8Path::new("")));
        let arguments =
            vec![("file", Value::quoted(file.as_str())), ("directory", Value::quoted(directory.as_str()))];
        diagnostic.note(&paths::ELSEWHERE, arguments)
    }

    /// Formats a directory as it would be written in the configuration.
    fn as_configured(&self, directory: &Utf8Path) -> Utf8PathBuf {
        let working_directory = &self.context.working_directory;
        let base = self.context.settings.directory().unwrap_or(working_directory);
        relative(&working_directory.join(directory), base)
    }
}

/// Returns the path that a subpath segment names, if the diagnostic says that it was not found.
fn missing_path(diagnostic: &Diagnostic) -> Option<PathName> {
    let name = diagnostic.quoted("name").filter(|_| *diagnostic.message == paths::NOT_FOUND);
    name.map(PathName::new)
}

impl Session<'_> {
    /// Adds suggestions to diagnostics about missing files and paths: another location, or a similar name.
    pub fn with_hints(&self, diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
        let known = LazyCell::new(|| KnownNames {
            paths: self.paths_of_library(MAX_READ_FOR_NAMES),
            entries: self.entries(Utf8Path::new(""), &is_drawing),
        });
        let with_near = |mut diagnostic: Diagnostic| {
            let is_dangling = |file: &Utf8PathBuf| crate::files::is_named(file);
            if *diagnostic.message == files::MISSING && diagnostic.file.as_ref().is_some_and(is_dangling) {
                diagnostic.message = &files::DANGLING_LINK;
            }
            let near = match (diagnostic.message, &diagnostic.file) {
                (message, Some(file)) if *message == files::MISSING => {
                    let near = self.near_file(file).map(Utf8PathBuf::into_string);
                    near.map(|near| {
                        let is_alike = has_combining_marks(&near) == has_combining_marks(file.as_str());
                        (if is_alike { &files::NEAR_FILE } else { &files::NEAR_FILE_OTHER_CHARACTERS }, near)
                    })
                }
                (message, _) if *message == outputs::NO_SUCH_PATH || *message == outputs::NO_PATH_LIKE => {
                    self.near_path(diagnostic.quoted("name").unwrap_or_default(), &known)
                }
                _ => None,
            };
            let is_told = diagnostic.notes.iter().any(|note| *note.message == paths::NEAR_NAMES);
            match near.filter(|(message, _)| **message != outputs::NEAR_PATH || !is_told) {
                Some((message, near)) => diagnostic.note(message, vec![("near", Value::quoted(near))]),
                None => diagnostic,
            }
        };
        self.with_library_hints(diagnostics).into_iter().map(with_near).collect()
    }

    /// Finds a missing path elsewhere: in the library, in a drawing that is not searched or whose file name does not cover the path, or under a
    /// similar name.
    fn near_path(&self, name: &str, known: &KnownNames) -> Option<(&'static Message, String)> {
        let path = PathName::new(name);
        let in_drawing = |message, file: SourceFile| Some((message, file.path(self.db()).to_string()));
        let defined = self.definitions(&path, &self.library_directories());
        if let Some(file) = defined.first() {
            return in_drawing(&outputs::DEFINED_IN, *file);
        }
        if let Some((_, file)) = known.paths.iter().find(|(known, _)| *known == path) {
            let directory = file.path(self.db()).parent().map(Utf8Path::to_owned).unwrap_or_default();
            let is_named = !self.definitions(&path, &[directory]).is_empty();
            let message = if is_named { &outputs::NOT_SEARCHED } else { &outputs::NOT_IN_FILE_NAME };
            return in_drawing(message, *file);
        }
        let paths = known.paths.iter().map(|(name, _)| name.as_str());
        let others = paths.chain(known.entries.iter().map(String::as_str)).filter(|other| *other != name);
        nearest(name, others).map(|near| (&outputs::NEAR_PATH, near.to_owned()))
    }

    /// Returns the existing drawing or directory with the most similar name, if the first missing component of the path is misspelled.
    fn near_file(&self, file: &Utf8Path) -> Option<Utf8PathBuf> {
        let is_there = |directory: &&Utf8Path| {
            directory.as_str().is_empty() || self.db().system().kind(directory) == FileKind::Directory
        };
        let directory = file.ancestors().skip(1).find(is_there)?;
        let mut missing = file.strip_prefix(directory).ok()?.components();
        let name = missing.next()?;
        let entries = self.entries(directory, &is_drawing);
        let near = join(directory, nearest(name.as_str(), entries.iter().map(String::as_str))?);
        let whole = join(&near, missing.as_path());
        // The components after the misspelled one may exist in the directory with the similar name.
        Some(if self.db().system().kind(&whole) == FileKind::Missing { near } else { whole })
    }

    /// Returns the sorted names of the entries of a directory that are directories themselves or files that `is_wanted` accepts, without hidden ones.
    pub(super) fn entries(&self, directory: &Utf8Path, is_wanted: FileFilter<'_>) -> Vec<String> {
        let mut names = Vec::new();
        let mut take = |entry: Entry<'_>| {
            let counts = entry.kind == EntryKind::Directory || is_wanted(Utf8Path::new(entry.name));
            if counts && entry.is_exact && !is_hidden(entry.name) {
                names.push(entry.name.to_owned());
            }
            ControlFlow::Continue(())
        };
        // A directory that cannot be listed offers no suggestions.
        _ = catch_bugs(|| self.db().system().each_entry(directory, &mut take));
        names.sort_unstable();
        names
    }
}

/// Whether a name has letters that are composed of a base letter and a mark above or below it, as macOS writes them.
fn has_combining_marks(name: &str) -> bool {
    name.chars().any(|character| matches!(character, '\u{300}'..='\u{36f}'))
}

/// Everything that a name without a separator may refer to.
struct KnownNames {
    /// Paths of the library, with their drawings.
    paths: Vec<(PathName, SourceFile)>,
    /// Drawings and directories in the working directory.
    entries: Vec<String>,
}

impl Session<'_> {
    /// Returns PB003 for each missing directory of the keys `library` and `search`.
    pub(crate) fn missing_directories(&self) -> Vec<Diagnostic> {
        let general = &self.context.settings.general;
        let library = self.missing_directory_errors(
            "library",
            &general.library,
            &[FileKind::Directory, FileKind::File],
        );
        library
            .chain(self.missing_directory_errors("search", &general.search, &[FileKind::Directory]))
            .collect()
    }

    fn missing_directory_errors<'a>(
        &'a self,
        key: &'static str,
        directories: &'a SourcedValue<Vec<Utf8PathBuf>>,
        expected: &'a [FileKind],
    ) -> impl Iterator<Item = Diagnostic> + 'a {
        let is_missing = |(_, directory): &(usize, &Utf8PathBuf)| {
            !expected.contains(&self.db.system().kind(&self.normalize(directory)))
        };
        directories.value.iter().enumerate().filter(is_missing).map(move |(index, directory)| {
            let problem = Diagnostic::new(&configuration::NO_DIRECTORY)
                .quoting("key", key)
                .quoting("directory", self.normalize(directory).as_str());
            self.context.settings.locate(problem, directories.origin.of_item(index))
        })
    }

    /// Returns PB518 for each named directory without drawings. A new library may have directories without drawings, so for a library, PB518 is
    /// returned only if none of its directories has any.
    pub(super) fn empty_directory_errors(
        is_library: bool,
        directories: &[&SearchedDirectory],
    ) -> Vec<Diagnostic> {
        let empty = directories.iter().filter(|directory| directory.drawings.is_empty());
        let empty: Vec<&Utf8Path> = empty.map(|directory| directory.path.as_path()).collect();
        match empty.as_slice() {
            [] => Vec::new(),
            all if is_library && all.len() == directories.len() => vec![no_drawing_error(all)],
            _ if is_library => Vec::new(),
            each => each.iter().map(|directory| no_drawing_error(&[*directory])).collect(),
        }
    }

    /// Returns PB518 if there are drawings, but none of them contains a path. Returns `None` if a drawing has an error of its own, because it may
    /// contain a path, and in compatible mode, because PathDxf2GCode accepts such a library. `drawings` has the paths and the diagnostics of each
    /// drawing.
    pub fn no_path_anywhere_error<'a>(
        &self,
        drawings: impl IntoIterator<Item = (&'a [PathName], &'a [Diagnostic])>,
    ) -> Option<Diagnostic> {
        let mut count = 0_usize;
        for (names, found) in drawings {
            count += 1;
            if !names.is_empty() || found.iter().any(Diagnostic::is_error) {
                return None;
            }
        }
        (count > 0 && !self.is_compatible()).then(|| {
            Diagnostic::new(&outputs::NO_PATH_ANYWHERE)
                .with("count", count)
                .quoting("pattern", &*self.context.settings.general.path_pattern.value)
        })
    }

    /// Whether the run must behave as PathDxf2GCode does.
    pub fn is_compatible(&self) -> bool {
        self.context.settings.general.compatible.value
    }
}

/// Returns PB518 for directories without drawings.
pub(crate) fn no_drawing_error(directories: &[&Utf8Path]) -> Diagnostic {
    let shown = directories.iter().map(|path| if path.as_str().is_empty() { "." } else { path.as_str() });
    let directories: Value = shown.collect();
    Diagnostic::new(&outputs::NO_DRAWING).with("directories", directories)
}

/// Upper bound on the number of drawings that are read only for the names of their paths. Reading that many takes half a second.
pub(crate) const MAX_READ_FOR_NAMES: usize = 2000;
