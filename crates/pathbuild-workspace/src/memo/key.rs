//! What results depend on besides files, as a part of the cache key, and which results concern a run.

use std::collections::HashSet;
use std::fmt::Write;

use camino::Utf8Path;
use pathbuild_db::system::{FileKind, System};
use pathbuild_path::{FilePattern, PathKey, PathPattern, RangeTable};

use crate::config::ResultKind;
use crate::session::{ArgumentMatches, Session};
use crate::workspace::Workspace;

/// Identifies this build of the program.
pub const BUILD: &str = env!("PATHBUILD_BUILD");

/// The query with all settings that results depend on. Directories are relative to the configuration, so that a tree keeps its results when
/// it is moved or copied as a whole.
pub(super) fn query_text(context: &Workspace, result_kind: ResultKind, query: &str) -> String {
    let mut text = query.to_owned();
    let base = context.settings.directory().map(|base| format!("\"{base}/")).unwrap_or_default();
    context.settings.visit_inputs(result_kind, &mut |name, value| {
        let value = format!("{value:?}");
        let value = if base.is_empty() { value } else { value.replace(&base, "\"./") };
        _ = write!(text, "\n{name} = {value}");
    });
    if result_kind == ResultKind::Emit {
        // These depend on whether a key is set, not only on its value.
        _ = write!(text, "\n{:?}", (context.settings.comment_lang(), context.settings.z_split()));
    }
    // Untrusted trees are checked more strictly than the user's own.
    _ = write!(text, "\n{}\n{}", context.settings.confined.is_some(), place_of(context));
    text
}

/// The working directory relative to the configuration, because names in results are relative to the working directory.
fn place_of(context: &Workspace) -> &str {
    let directory = &context.working_directory;
    let base = context.settings.directory();
    base.and_then(|base| directory.strip_prefix(base).ok()).unwrap_or(directory).as_str()
}

/// Decides which files may contain which paths, by their names.
#[derive(Clone, Debug)]
pub struct Coverage {
    paths: PathPattern,
    files: FilePattern,
}

impl Coverage {
    /// Takes the patterns from the configuration.
    pub fn new(context: &Workspace) -> Self {
        let general = &context.settings.general;
        Self {
            paths: PathPattern::new(&general.path_pattern.value).unwrap_or_default(),
            files: FilePattern::new(&general.file_pattern.value).unwrap_or_default(),
        }
    }

    /// Whether a drawing of this name may contain the path of that name.
    pub fn may_hold(&self, file: &str, path: &str) -> bool {
        self.of_files([file]).may_hold(path)
    }

    /// The paths that drawings of these names may contain.
    pub fn of_files<'f>(&self, files: impl IntoIterator<Item = &'f str>) -> CoveredPaths<'_> {
        let stem = |file: &'f str| file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        let ranges = files.into_iter().flat_map(|file| self.files.ranges(stem(file)));
        CoveredPaths { paths: &self.paths, ranges: ranges.map(|range| (range, 0)).collect() }
    }
}

/// The paths that some drawings may contain, judging by their names.
#[derive(Debug)]
pub struct CoveredPaths<'a> {
    paths: &'a PathPattern,
    ranges: RangeTable,
}

impl CoveredPaths<'_> {
    /// Whether any of the drawings may contain the path of this name.
    pub fn may_hold(&self, path: &str) -> bool {
        PathKey::new(path, self.paths).is_some_and(|key| !self.ranges.files(&key).is_empty())
    }
}

/// The drawings of a run. The subject of a result is a drawing, or something in it whose description follows the drawing's path after a
/// NUL.
#[derive(Debug)]
pub(super) enum Scope {
    /// All drawings.
    All,
    /// Certain drawings.
    Drawings {
        /// Paths of the drawings.
        drawings: HashSet<String>,
        /// Directories that were listed completely: they contain no other drawings.
        directories: HashSet<String>,
    },
}

impl Scope {
    /// The drawings that the arguments may refer to.
    pub(super) fn of(session: &Session<'_>, found: &ArgumentMatches) -> Self {
        let named = found.named().map(|file| file.path(session.db()).to_string());
        let drawings = found.directories().flat_map(|directory| &directory.drawings);
        let directories = found.directories().flat_map(|directory| &directory.directories);
        Self::Drawings {
            drawings: drawings.map(ToString::to_string).chain(named).collect(),
            directories: directories.map(ToString::to_string).collect(),
        }
    }

    /// Whether the run uses a result.
    pub(super) fn holds(&self, subject: &str) -> bool {
        match self {
            Self::All => true,
            Self::Drawings { drawings, .. } => drawings.contains(drawing(subject)),
        }
    }

    /// Whether a result may be needed again because its drawing still exists. A run over single drawings keeps the results of others.
    pub(super) fn may_return(&self, subject: &str, system: &dyn System) -> bool {
        let drawing = Utf8Path::new(drawing(subject));
        let is_file = || system.kind(drawing) == FileKind::File;
        match self {
            Self::All => is_file(),
            Self::Drawings { directories, .. } => {
                let is_below = |parent: &Utf8Path| directories.contains(parent.as_str());
                let was_looked_through = drawing.parent().is_some_and(is_below);
                self.holds(subject) || directories.is_empty() || !was_looked_through && is_file()
            }
        }
    }
}

fn drawing(subject: &str) -> &str {
    subject.split('\0').next().unwrap_or_default()
}
