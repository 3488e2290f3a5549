//! Help for names on the command line that are nearly right.

use std::cell::LazyCell;
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Db;
use pathbuild_db::system::{EntryKind, FileKind, join};
use pathbuild_diagnostic::messages::{files, outputs};
use pathbuild_diagnostic::{Diagnostic, Message, Value};
use pathbuild_path::PathName;

use super::{Session, library};
use crate::config::nearest::nearest;

impl Session<'_> {
    /// Adds to what is not found where else it is, or which name is nearly the same.
    pub fn with_hints(&self, diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
        let names = LazyCell::new(|| self.known_names());
        let with_near = |diagnostic: Diagnostic| {
            let near = match (diagnostic.message, &diagnostic.file) {
                (message, Some(file)) if *message == files::MISSING => {
                    self.near_file(file).map(|near| (&files::NEAR_FILE, near.into_string()))
                }
                (message, _) if *message == outputs::NO_SUCH_PATH || *message == outputs::NO_PATH_LIKE => {
                    self.near_path(named(&diagnostic), &names)
                }
                _ => None,
            };
            match near {
                Some((message, near)) => diagnostic.note(message, vec![("near", near.into())]),
                None => diagnostic,
            }
        };
        self.with_elsewhere(diagnostics).into_iter().map(with_near).collect()
    }

    /// The drawing that defines a path which is looked for elsewhere; else the name that is nearest.
    fn near_path(&self, name: &str, names: &[String]) -> Option<(&'static Message, String)> {
        let path = PathName::new(name);
        let defined = self.definitions(&path, &self.library_directories());
        if let Some(file) = defined.first() {
            return Some((&outputs::DEFINED_IN, file.path(self.db()).to_string()));
        }
        let others = names.iter().map(String::as_str).filter(|other| *other != name);
        nearest(name, others).map(|near| (&outputs::NEAR_PATH, near.to_owned()))
    }

    /// What a name without a separator may mean: paths, and directories of the working directory.
    fn known_names(&self) -> Vec<String> {
        let paths = self.names_of_library().into_iter().map(|name| name.as_str().to_owned());
        paths.chain(self.entries(Utf8Path::new(""))).collect()
    }

    /// The existing drawing or directory whose name is nearest, where the first part of a path that does not exist is nearly right.
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
        // What follows the mistyped part may be right.
        Some(if self.db().system().kind(&whole) == FileKind::Missing { near } else { whole })
    }

    /// The names of drawings and directories in a directory.
    fn entries(&self, directory: &Utf8Path) -> Vec<String> {
        let mut names = Vec::new();
        // What cannot be listed has no names to offer.
        _ = self.db().system().each_entry(directory, &mut |entry| {
            let counts = entry.kind == EntryKind::Directory || library::is_drawing(Utf8Path::new(entry.name));
            if counts && entry.is_exact && !entry.name.starts_with('.') {
                names.push(entry.name.to_owned());
            }
            ControlFlow::Continue(())
        });
        names.sort_unstable();
        names
    }
}

/// The name that was looked for.
fn named(diagnostic: &Diagnostic) -> &str {
    let named = diagnostic.arguments.iter().find_map(|(argument, value)| match value {
        Value::Text(name) if *argument == "name" => Some(&**name),
        _ => None,
    });
    named.unwrap_or_default()
}
