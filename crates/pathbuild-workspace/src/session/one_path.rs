//! One argument that names one drawing or one path. (book: reference/commands)

use camino::Utf8Path;
use pathbuild_db::{Role, SourceFile, Target, check_file, path_names};
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::PathName;

use super::Session;
use crate::inputs::Inputs;

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
