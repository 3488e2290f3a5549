//! Compares the name of a file with the paths in it. (book: language/layers-and-names)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs as messages;

use crate::files::{FilePattern, PathKey};
use crate::name::{PathName, PathPattern};

/// PB519 for paths in the file's name that are on no layer, and PB521 for paths that are never searched in a file of this name. Q-projects
/// are exempt, since they are named after the drawing that they test. `stem`: the name without `.dxf`.
pub fn judge_file_name(
    stem: &str,
    held: &[PathName],
    files: &FilePattern,
    paths: &PathPattern,
) -> Vec<Diagnostic> {
    if is_q_project(stem) {
        return Vec::new();
    }
    let key = |name: &PathName| PathKey::new(name.as_str(), paths);
    let ranges = files.ranges(stem);
    let is_covered =
        |name: &PathName| key(name).is_some_and(|key| ranges.iter().any(|range| range.holds(&key)));
    let keys: Vec<PathKey> = held.iter().filter_map(key).collect();
    let is_held = |name: &PathName| key(name).is_some_and(|key| keys.iter().any(|held| held.is_like(&key)));
    let promised = promised(stem, files, paths).into_iter().filter(|name| !is_held(name));
    let broken =
        promised.map(|name| Diagnostic::new(&messages::PROMISED_PATH).quoting("name", name.as_str()));
    let strays = held.iter().filter(|name| !is_covered(name)).map(|name| {
        let stray = Diagnostic::new(&messages::STRAY_PATH).quoting("name", name.as_str());
        stray.in_path(name.as_str())
    });
    broken.chain(strays).collect()
}

/// Whether the name of a drawing is that of a Q-project. Names of files here are without `.dxf`.
pub fn is_q_project(stem: &str) -> bool {
    tested_by_q_project(stem).is_some()
}

/// The name of the drawing that a Q-project tests; `None` if the name is not that of a Q-project.
pub fn tested_by_q_project(stem: &str) -> Option<&str> {
    stem.strip_suffix("_Q").or_else(|| stem.strip_suffix("_q"))
}

/// The name of the Q-project that tests a drawing.
pub fn q_project_name(stem: &str) -> String {
    format!("{stem}_Q")
}

/// The full path names in a file's name, without duplicates. The ends of a range do not count.
fn promised(stem: &str, files: &FilePattern, paths: &PathPattern) -> Vec<PathName> {
    let ranges = files.range_spans(stem);
    let mut promised: Vec<PathName> = Vec::new();
    let mut from = 0;
    while let Some((name, found)) = stem.get(from..).and_then(|rest| paths.find(rest)) {
        let found = from + found.start..from + found.end;
        let is_end = ranges.iter().any(|range| range.start < found.end && found.start < range.end);
        let is_whole = !stem[..found.start].ends_with(char::is_alphanumeric)
            && !stem[found.end..].starts_with(char::is_alphanumeric);
        if is_whole && !is_end && !promised.contains(&name) {
            promised.push(name);
        }
        from = found.end.max(from + 1);
    }
    promised
}
