//! Suggestions for misspelled names on the command line.

use std::cell::LazyCell;
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{Entry, EntryKind, FileKind, join};
use pathbuild_db::{Db, SourceFile, catch_bugs};
use pathbuild_diagnostic::messages::{files, outputs, paths};
use pathbuild_diagnostic::{Diagnostic, Message, Value, nearest};
use pathbuild_path::PathName;

use super::{Session, library};
use crate::list::MOST_UNKNOWN;

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
