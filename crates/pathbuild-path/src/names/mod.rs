//! Path names and path layers, and the patterns by which layers and files are named after paths. (book: language/layers-and-names)

pub(crate) mod files;
mod pattern;

use std::borrow::Cow;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::{Deref, Range};

use regex::Regex;
use smol_str::SmolStr;

use crate::look_alikes;
use pattern::{DefaultPattern, Groups, Pattern};

pub use pattern::{LayerPattern, PatternError, name_regex};

/// A path name, written as on its layer, but with `.` in place of `_`. Comparison ignores case. Short names are stored inline, since every stage copies them.
#[derive(Clone)]
pub struct PathName(SmolStr);

/// A path name that is compared with regard to case, so that results that show the name are recomputed when only its case changes.
#[derive(Clone)]
pub struct CaseSensitiveName(PathName);

/// The pattern for names of path layers. It must match the whole name, ignoring case.
#[derive(Clone, Debug)]
pub struct PathPattern(Pattern);

/// A layer that contains a path or part of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathLayer {
    /// Name of the path.
    pub path: PathName,
    /// Whether the layer is a tilde layer (`2916.1P~A`), which keeps its texts apart from the elements of the path's other layers.
    pub is_tilde: bool,
}

impl From<PathName> for CaseSensitiveName {
    fn from(name: PathName) -> Self {
        Self(name)
    }
}

impl Deref for CaseSensitiveName {
    type Target = PathName;

    fn deref(&self) -> &PathName {
        &self.0
    }
}

impl PartialEq for CaseSensitiveName {
    fn eq(&self, other: &Self) -> bool {
        self.as_str() == other.as_str()
    }
}

impl Eq for CaseSensitiveName {}

impl fmt::Display for CaseSensitiveName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Debug for CaseSensitiveName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Default for PathPattern {
    fn default() -> Self {
        Self(Pattern::Default(DefaultPattern::Path))
    }
}

impl PathPattern {
    /// The default pattern, for names like `2913.2P`.
    pub const DEFAULT: &str = DefaultPattern::Path.source();

    /// Creates a pattern from the configuration or the command line.
    ///
    /// # Errors
    /// If it is not a valid regular expression, or matches an empty name.
    pub fn new(pattern: &str) -> Result<Self, PatternError> {
        Pattern::new(pattern, DefaultPattern::Path).map(Self)
    }

    /// Returns the path of a layer; `None` if it is not a path layer.
    pub fn layer(&self, layer: &str) -> Option<PathLayer> {
        let name = without_tilde(layer);
        let path = with_points(name);
        self.0
            .matches(&path)
            .then(|| PathLayer { path: PathName(path.into()), is_tilde: is_tilde_layer(layer) })
    }

    /// Whether a layer is a path layer.
    pub fn is_layer(&self, layer: &str) -> bool {
        self.0.may_begin(layer) && self.0.matches(&with_points(without_tilde(layer)))
    }

    /// Whether the name of a layer may resemble that of a path, judged by how it begins.
    pub fn may_resemble(&self, layer: &str) -> bool {
        self.0.may_begin(&look_alikes::plain_name(layer))
    }

    /// Whether a name is a path name.
    pub fn matches(&self, name: &str) -> bool {
        self.0.matches(name)
    }

    /// Returns the path name that a text becomes if its underscores and commas are replaced by points; `None` if that is no path name.
    pub(crate) fn corrected_name(&self, text: &str) -> Option<PathName> {
        let meant = text.replace(['_', ','], ".");
        self.matches(&meant).then(|| PathName(meant.into()))
    }

    /// Returns the first path name in the text of a subpath, with its byte range.
    pub fn first_in(&self, text: &str) -> Option<(PathName, Range<usize>)> {
        let found = self.0.find(text)?;
        Some((PathName(text[found.clone()].into()), found))
    }

    /// Returns the groups of a name, for comparison with file names. `None` if the pattern does not match the name.
    pub(crate) fn groups(&self, name: &str) -> Option<Groups> {
        self.0.groups(name)
    }

    /// The regular expression as given.
    pub fn as_str(&self) -> &str {
        self.0.as_str()
    }
}

impl PathName {
    /// Creates a name as given by a user.
    pub fn new(name: &str) -> Self {
        Self(name.into())
    }

    /// Returns the name in the spelling of the layer or the user.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The canonical form, which is equal for equal names and determines their order.
    pub fn canonical(&self) -> String {
        if self.0.is_ascii() { self.0.to_ascii_uppercase() } else { self.0.to_uppercase() }
    }

    /// Whether a text without spaces contains letters or digits before or after the name, so that it means another name, or a parameter follows
    /// without a space.
    pub(crate) fn is_part_of(&self, text: &str) -> bool {
        let is_meant = |rest: &str| rest.contains(char::is_alphanumeric);
        text.split_once(self.as_str()).is_some_and(|(before, behind)| is_meant(before) || is_meant(behind))
    }

    /// Whether a regular expression of E or `--restrict`, compiled with [`name_regex`], matches anywhere in the name.
    pub fn is_match(&self, pattern: &Regex) -> bool {
        pattern.is_match(&self.0)
    }
}

impl fmt::Display for PathName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Debug for PathName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.0)
    }
}

impl PartialEq for PathName {
    fn eq(&self, other: &Self) -> bool {
        if self.0.is_ascii() && other.0.is_ascii() {
            return self.0.eq_ignore_ascii_case(&other.0);
        }
        self.cmp(other).is_eq()
    }
}

impl Eq for PathName {}

impl Hash for PathName {
    fn hash<H: Hasher>(&self, state: &mut H) {
        // Fast path. It must give the same hash as the code below, since a name with letters outside ASCII may equal a name in ASCII.
        if self.0.is_ascii() {
            self.0.bytes().for_each(|byte| char::from(byte.to_ascii_uppercase()).hash(state));
            return;
        }
        for letter in self.0.chars().flat_map(char::to_uppercase) {
            letter.hash(state);
        }
    }
}

impl PartialOrd for PathName {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for PathName {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        if self.0.is_ascii() && other.0.is_ascii() {
            let folded = |byte: u8| byte.to_ascii_uppercase();
            return self.0.bytes().map(folded).cmp(other.0.bytes().map(folded));
        }
        self.0.chars().flat_map(char::to_uppercase).cmp(other.0.chars().flat_map(char::to_uppercase))
    }
}

/// Replaces underscores by points: some CAD programs allow no points in the names of layers.
pub(crate) fn with_points(layer: &str) -> Cow<'_, str> {
    if layer.contains('_') { Cow::Owned(layer.replace('_', ".")) } else { Cow::Borrowed(layer) }
}

/// Whether the name of a layer ends with a `~` and letters.
pub(crate) fn is_tilde_layer(layer: &str) -> bool {
    without_tilde(layer).len() != layer.len()
}

/// Returns a layer's name without a trailing `~` and letters.
fn without_tilde(layer: &str) -> &str {
    match layer.bytes().rposition(|byte| byte == b'~') {
        Some(at) if layer[at + 1..].chars().all(char::is_alphabetic) => &layer[..at],
        _ => layer,
    }
}
