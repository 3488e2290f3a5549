//! What a drawing's file name says of its paths, against the paths that it holds. (book: language/layers-and-names)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs as messages;

use crate::files::{FilePattern, PathKey};
use crate::name::{PathName, PathPattern};

/// Paths that the file's name names and that no layer has (PB519), and paths that are not looked for in a file of that name (PB521). Nothing of
/// Q-projects, which are named after the drawing that they test. `stem`: the name without `.dxf`.
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
    let broken = promised.map(|name| Diagnostic::new(&messages::PROMISED_PATH).with("name", name.as_str()));
    let strays = held.iter().filter(|name| !is_covered(name)).map(|name| {
        let stray = Diagnostic::new(&messages::STRAY_PATH).with("name", name.as_str());
        stray.in_path(name.as_str())
    });
    broken.chain(strays).collect()
}

/// Whether a drawing is a Q-project by its name.
pub fn is_q_project(stem: &str) -> bool {
    stem.ends_with("_Q") || stem.ends_with("_q")
}

/// The full path names in a file's name, each once. The ends of a range promise nothing.
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
