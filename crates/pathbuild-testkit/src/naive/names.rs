//! Finds the files of paths by comparing file names with path names. (book: language/layers-and-names)

use std::cmp::Ordering;
use std::sync::LazyLock;

use pathbuild_path::PathName;
use regex::Regex;

use super::Model;

static PATH: LazyLock<Regex> = LazyLock::new(|| pattern("(?i)^([0-9]{4})[.]([0-9]+)([A-Z])$"));
static PART: LazyLock<Regex> = LazyLock::new(|| pattern(r"([0-9]{4})(?:[.]([0-9]+))?"));
static RANGE: LazyLock<Regex> =
    LazyLock::new(|| pattern(r"([0-9]{4})(?:[.]([0-9]+))?-([0-9]{4})(?:[.]([0-9]+))?"));

pub(super) fn pattern(text: &str) -> Regex {
    Regex::new(text).expect("a regular expression of the model's own")
}

impl Model {
    /// The drawings that define a path which a drawing refers to.
    pub(super) fn holders(&self, from: usize, name: &PathName) -> Vec<usize> {
        if self.defines(from, name) {
            return vec![from];
        }
        let own = directory(&self.drawings[from].path);
        let is_searched = |at: &str| at == own || self.rules.search.iter().any(|searched| searched == at);
        let may_hold = |number: &usize| {
            let path = &self.drawings[*number].path;
            is_searched(directory(path)) && may_hold(stem(path), name.as_str())
        };
        (0..self.drawings.len()).filter(may_hold).filter(|number| self.defines(*number, name)).collect()
    }

    fn defines(&self, drawing: usize, name: &PathName) -> bool {
        self.drawings[drawing].content.paths.iter().any(|(raw, _)| *raw.name == *name)
    }
}

pub(super) fn directory(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(directory, _)| directory)
}

pub(super) fn stem(path: &str) -> &str {
    let name = path.rsplit('/').next().unwrap_or_default();
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// Whether a file with this stem may define a path, by the default patterns.
pub(super) fn may_hold(stem: &str, path: &str) -> bool {
    let Some(path) = PATH.captures(path) else { return false };
    let path: Vec<&str> = (1..=3).map(|group| &path[group]).collect();
    let end = |found: &regex::Captures<'_>, first: usize| -> Vec<String> {
        let group =
            |number: usize| found.get(number).map_or(String::new(), |group| group.as_str().to_owned());
        vec![group(first), group(first + 1)]
    };
    let mut ranges = RANGE.captures_iter(stem).map(|found| (end(&found, 1), end(&found, 3)));
    let mut parts = PART.captures_iter(stem).map(|found| end(&found, 1));
    ranges.any(|(from, to)| compare(&from, &path).is_le() && compare(&to, &path).is_ge())
        || parts.any(|part| compare(&part, &path).is_eq())
}

/// Compares a part of a file name with a path name.
fn compare(file: &[String], path: &[&str]) -> Ordering {
    for (file, path) in file.iter().zip(path) {
        if file.is_empty() {
            // The rest of the path is covered by a file name that does not specify it.
            return Ordering::Equal;
        }
        let order = match (file.parse::<u64>(), path.parse::<u64>()) {
            (Ok(file), Ok(path)) => file.cmp(&path),
            _ => file.to_uppercase().cmp(&path.to_uppercase()),
        };
        if order.is_ne() {
            return order;
        }
    }
    Ordering::Equal
}
