//! Hints about what is missing: paths that exist elsewhere in the library (book: language/embedding), misspelled names on the command line,
//! and empty input: missing directories, directories without drawings, drawings without paths. (book: reference/diagnostics)

use std::cell::LazyCell;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{Entry, EntryKind, FileKind, join};
use pathbuild_db::{Db, SourceFile, catch_bugs};
use pathbuild_diagnostic::messages::{configuration, files, outputs, paths};
use pathbuild_diagnostic::{Diagnostic, Message, Value, nearest};
use pathbuild_path::PathName;

use super::argument_matches::SearchedDirectory;
use super::{Session, library};
use crate::config::{Origin, SourcedValue};
use crate::workspace::relative;

impl Session<'_> {
    /// Adds to each PB503 of a subpath where in the library the path is defined. The library is searched only if there is such a
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

/// The path that a subpath segment names and that was not found.
fn missing_path(diagnostic: &Diagnostic) -> Option<PathName> {
    if *diagnostic.message != paths::NOT_FOUND {
        return None;
    }
    diagnostic.arguments.iter().find_map(|(argument, value)| match value {
        Value::Quoted(name) if *argument == "name" => Some(PathName::new(name)),
        _ => None,
    })
}

impl Session<'_> {
    /// Adds suggestions to diagnostics about missing files and paths: another location, or a similar name.
    pub fn with_hints(&self, diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
        let known = LazyCell::new(|| self.known());
        let with_near = |diagnostic: Diagnostic| {
            let near = match (diagnostic.message, &diagnostic.file) {
                (message, Some(file)) if *message == files::MISSING => {
                    self.near_file(file).map(|near| (&files::NEAR_FILE, near.into_string()))
                }
                (message, _) if *message == outputs::NO_SUCH_PATH || *message == outputs::NO_PATH_LIKE => {
                    self.near_path(missing_name(&diagnostic), &known)
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

    /// Finds a missing path elsewhere: in the library, in a drawing whose file name does not cover it, or under a similar name.
    fn near_path(&self, name: &str, known: &KnownNames) -> Option<(&'static Message, String)> {
        let path = PathName::new(name);
        let in_drawing = |message, file: SourceFile| Some((message, file.path(self.db()).to_string()));
        let defined = self.definitions(&path, &self.library_directories());
        if let Some(file) = defined.first() {
            return in_drawing(&outputs::DEFINED_IN, *file);
        }
        if let Some((_, file)) = known.paths.iter().find(|(known, _)| *known == path) {
            return in_drawing(&outputs::NOT_IN_FILE_NAME, *file);
        }
        let paths = known.paths.iter().map(|(name, _)| name.as_str());
        let others = paths.chain(known.entries.iter().map(String::as_str)).filter(|other| *other != name);
        nearest(name, others).map(|near| (&outputs::NEAR_PATH, near.to_owned()))
    }

    /// Everything that a name without a separator may refer to.
    fn known(&self) -> KnownNames {
        KnownNames { paths: self.paths_of_library(MOST_UNKNOWN), entries: self.entries(Utf8Path::new("")) }
    }

    /// The existing drawing or directory with the most similar name, if the first missing component of the path is misspelled.
    fn near_file(&self, file: &Utf8Path) -> Option<Utf8PathBuf> {
        let is_there = |directory: &&Utf8Path| {
            directory.as_str().is_empty() || self.db().system().kind(directory) == FileKind::Directory
        };
        let directory = file.ancestors().skip(1).find(is_there)?;
        let mut missing = file.strip_prefix(directory).ok()?.components();
        let name = missing.next()?;
        let entries = self.entries(directory);
        let near = join(directory, nearest(name.as_str(), entries.iter().map(String::as_str))?);
        let whole = join(&near, missing.as_path());
        // The components after the misspelled one may exist.
        Some(if self.db().system().kind(&whole) == FileKind::Missing { near } else { whole })
    }

    /// Sorted names of the drawings and directories in a directory, without hidden ones.
    pub(super) fn entries(&self, directory: &Utf8Path) -> Vec<String> {
        let mut names = Vec::new();
        let mut take = |entry: Entry<'_>| {
            let counts = entry.kind == EntryKind::Directory || library::is_drawing(Utf8Path::new(entry.name));
            if counts && entry.is_exact && !entry.name.starts_with('.') {
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

/// Everything that a name without a separator may refer to.
struct KnownNames {
    /// Paths of the library, with their drawings.
    paths: Vec<(PathName, SourceFile)>,
    /// Drawings and directories in the working directory.
    entries: Vec<String>,
}

/// The missing name that a diagnostic reports.
fn missing_name(diagnostic: &Diagnostic) -> &str {
    let missing_name = diagnostic.arguments.iter().find_map(|(argument, value)| match value {
        Value::Quoted(name) if *argument == "name" => Some(&**name),
        _ => None,
    });
    missing_name.unwrap_or_default()
}

impl Session<'_> {
    /// PB003 for each missing directory of the keys `library` and `search`.
    pub(super) fn missing_directories(&self) -> Vec<Diagnostic> {
        let general = &self.context.settings.general;
        let library = self.missing("library", &general.library, &[FileKind::Directory, FileKind::File]);
        library.chain(self.missing("search", &general.search, &[FileKind::Directory])).collect()
    }

    fn missing<'a>(
        &'a self,
        key: &'static str,
        directories: &'a SourcedValue<Vec<Utf8PathBuf>>,
        expected: &'a [FileKind],
    ) -> impl Iterator<Item = Diagnostic> + 'a {
        let is_missing =
            |directory: &&Utf8PathBuf| !expected.contains(&self.db.system().kind(&self.normal(directory)));
        directories.value.iter().filter(is_missing).map(move |directory| {
            let problem = Diagnostic::new(&configuration::NO_DIRECTORY)
                .quoting("key", key)
                .quoting("directory", self.normal(directory).as_str());
            match (&self.context.settings.file, directories.origin) {
                (Some(file), Origin::File(line)) => problem.in_file(file).at_line(line, None),
                _ => problem,
            }
        })
    }

    /// PB518 for each named directory without drawings. A library may be new, so for it only if all its directories are empty.
    pub(super) fn without_drawings(is_library: bool, directories: &[&SearchedDirectory]) -> Vec<Diagnostic> {
        let empty = directories.iter().filter(|directory| directory.drawings.is_empty());
        let empty: Vec<&Utf8Path> = empty.map(|directory| directory.path.as_path()).collect();
        match empty.as_slice() {
            [] => Vec::new(),
            all if is_library && all.len() == directories.len() => vec![no_drawing(all)],
            _ if is_library => Vec::new(),
            each => each.iter().map(|directory| no_drawing(&[*directory])).collect(),
        }
    }

    /// PB518 if there are drawings, but none of them contains a path. A drawing with an error of its own may contain one. PathDxf2GCode
    /// accepts such a library. `drawings` has the paths and the diagnostics of each drawing.
    pub fn no_path_anywhere<'a>(
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

    /// Whether the run mimics PathDxf2GCode.
    pub fn is_compatible(&self) -> bool {
        self.context.settings.general.compatible.value
    }
}

fn no_drawing(directories: &[&Utf8Path]) -> Diagnostic {
    let shown = directories.iter().map(|path| if path.as_str().is_empty() { "." } else { path.as_str() });
    let directories: Value = shown.collect();
    Diagnostic::new(&outputs::NO_DRAWING).with("directories", directories)
}

/// Upper bound on the number of drawings that are read just for the names of their paths; takes half a second.
pub(crate) const MOST_UNKNOWN: usize = 2000;
