//! Path names, and the layers they are on. (book: language/layers-and-names)

use std::borrow::Cow;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::Deref;

use regex::Regex;
use smol_str::SmolStr;

use crate::default_pattern::DefaultPattern;
use crate::group::Groups;
use crate::pattern::{Pattern, PatternError};

/// A path's name as its layer spells it, with points. Equal without regard to case; shown as spelt. Every stage hands it on: a short
/// one, as all are, needs no memory of its own.
#[derive(Clone)]
pub struct PathName(SmolStr);

/// A path's name of which the spelling counts: whatever shows it is made again when only its case changes.
#[derive(Clone)]
pub struct SpeltName(PathName);

/// What makes a layer a path layer: its name matches as a whole, without regard to case.
#[derive(Clone, Debug)]
pub struct PathPattern(Pattern);

/// A layer that holds a path, or parts of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathLayer {
    /// The path.
    pub path: PathName,
    /// Whether it is a tilde layer (`2916.1P~A`), whose texts and elements find only each other.
    pub tilde: bool,
}

impl From<PathName> for SpeltName {
    fn from(name: PathName) -> Self {
        Self(name)
    }
}

impl Deref for SpeltName {
    type Target = PathName;

    fn deref(&self) -> &PathName {
        &self.0
    }
}

impl PartialEq for SpeltName {
    fn eq(&self, other: &Self) -> bool {
        self.as_str() == other.as_str()
    }
}

impl Eq for SpeltName {}

impl fmt::Display for SpeltName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Debug for SpeltName {
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
    /// The default: `2913.2P`.
    pub const DEFAULT: &str = DefaultPattern::Path.source();

    /// A pattern from the configuration or the command line.
    ///
    /// # Errors
    /// When it is no regular expression, or matches an empty name.
    pub fn new(pattern: &str) -> Result<Self, PatternError> {
        Pattern::new(pattern, DefaultPattern::Path).map(Self)
    }

    /// The path that a layer belongs to; `None` for a layer that is no path layer.
    pub fn layer(&self, layer: &str) -> Option<PathLayer> {
        let name = without_tilde(layer);
        let path = with_points(name);
        self.0
            .matches(&path)
            .then(|| PathLayer { path: PathName(path.into()), tilde: name.len() != layer.len() })
    }

    /// Whether a layer belongs to a path.
    pub fn is_layer(&self, layer: &str) -> bool {
        self.0.may_begin(layer) && self.0.matches(&with_points(without_tilde(layer)))
    }

    /// Whether a layer's name begins as those of path layers do: `false` is certain.
    pub fn may_begin(&self, layer: &str) -> bool {
        self.0.may_begin(layer)
    }

    /// Whether a name is a path's.
    pub fn matches(&self, name: &str) -> bool {
        self.0.matches(name)
    }

    /// The first path name in a subpath's text, and the byte range it stands at.
    pub fn find(&self, text: &str) -> Option<(PathName, std::ops::Range<usize>)> {
        let found = self.0.find(text)?;
        Some((PathName(text[found.clone()].into()), found))
    }

    /// The groups of a name, by which it is compared with file names. `None` when it does not match.
    pub(crate) fn groups(&self, name: &str) -> Option<Groups> {
        self.0.groups(name)
    }

    /// The regular expression as it was given.
    pub fn as_str(&self) -> &str {
        self.0.as_str()
    }
}

impl PathName {
    /// A name as a person gave it.
    pub fn new(name: &str) -> Self {
        Self(name.into())
    }

    /// As it is spelt.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// In the one spelling by which equal names are found and ordered.
    pub fn folded(&self) -> String {
        if self.0.is_ascii() { self.0.to_ascii_uppercase() } else { self.0.to_uppercase() }
    }

    /// Whether letters or digits stand directly before or behind the name in a text, so that another name is meant.
    pub(crate) fn is_part_of_word(&self, text: &str) -> bool {
        text.split_once(self.as_str()).is_some_and(|(before, behind)| {
            before.ends_with(char::is_alphanumeric) || behind.starts_with(char::is_alphanumeric)
        })
    }

    /// Whether a regular expression of E or --restrict is found anywhere in it, with regard to case.
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

/// A layer's name with `_` read as `.`.
fn with_points(layer: &str) -> Cow<'_, str> {
    if layer.contains('_') { Cow::Owned(layer.replace('_', ".")) } else { Cow::Borrowed(layer) }
}

/// A layer's name without a trailing `~` and letters.
fn without_tilde(layer: &str) -> &str {
    match layer.bytes().rposition(|byte| byte == b'~') {
        Some(at) if layer[at + 1..].chars().all(char::is_alphabetic) => &layer[..at],
        _ => layer,
    }
}
