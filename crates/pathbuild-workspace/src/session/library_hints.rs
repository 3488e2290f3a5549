//! Hints for embedded paths that are not found, but exist elsewhere in the library. (book: language/embedding)

use std::cell::LazyCell;
use std::collections::BTreeMap;

use camino::{Utf8Component, Utf8Path, Utf8PathBuf};
use pathbuild_db::system::spelt;
use pathbuild_diagnostic::messages::paths as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::PathName;

use super::Session;

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
        diagnostic.note(&messages::ELSEWHERE, arguments)
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
    if *diagnostic.message != messages::NOT_FOUND {
        return None;
    }
    diagnostic.arguments.iter().find_map(|(argument, value)| match value {
        Value::Quoted(name) if *argument == "name" => Some(PathName::new(name)),
        _ => None,
    })
}

/// Path to a directory relative to another, both absolute. Returns the directory itself if there is no relative path, as between drives.
pub(crate) fn relative(directory: &Utf8Path, base: &Utf8Path) -> Utf8PathBuf {
    let (target, start): (Vec<_>, Vec<_>) = (directory.components().collect(), base.components().collect());
    let common = target.iter().zip(&start).take_while(|(a, b)| a == b).count();
    if common == 0 {
        return directory.to_owned();
    }
    let up = start[common..].iter().map(|_| Utf8Component::ParentDir);
    let relative: Utf8PathBuf = up.chain(target[common..].iter().copied()).collect();
    if relative.as_str().is_empty() { Utf8PathBuf::from(".") } else { spelt(relative) }
}
