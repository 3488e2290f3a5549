//! The query part of the cache key: a text with everything that a result depends on and that is in no drawing.

use std::fmt::Write;

use pathbuild_path::{FilePattern, PathKey, PathPattern, RangeTable};

use crate::config::ResultKind;
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
