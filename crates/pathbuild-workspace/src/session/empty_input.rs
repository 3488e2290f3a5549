//! Warnings about empty input: missing directories, directories without drawings, drawings without paths. (book: reference/diagnostics)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Db;
use pathbuild_db::system::FileKind;
use pathbuild_diagnostic::messages::{configuration, outputs as messages};
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::PathName;

use super::Session;
use super::argument_matches::SearchedDirectory;
use crate::config::{Origin, SourcedValue};

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
            Diagnostic::new(&messages::NO_PATH_ANYWHERE)
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
    Diagnostic::new(&messages::NO_DRAWING).with("directories", directories)
}
