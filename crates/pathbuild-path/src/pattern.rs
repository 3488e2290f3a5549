//! Regular expressions with groups, as path and file patterns are: matched as a whole, without regard to case.

use std::fmt;
use std::ops::Range;

use regex::{Regex, RegexBuilder};

/// A pattern of the configuration, compiled for matching a whole name and for searching in a text.
#[derive(Clone)]
pub(crate) struct Pattern {
    source: Box<str>,
    whole: Regex,
    anywhere: Regex,
}

/// Why a pattern cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PatternError {
    /// What is wrong, in the words of the regular expression parser.
    pub reason: Box<str>,
}

impl Pattern {
    pub(crate) fn new(source: &str) -> Result<Self, PatternError> {
        let whole = compile(&format!("^(?:{source})$"))?;
        if whole.is_match("") {
            return Err(PatternError { reason: "it matches an empty name".into() });
        }
        Ok(Self { source: source.into(), whole, anywhere: compile(source)? })
    }

    pub(crate) fn as_str(&self) -> &str {
        &self.source
    }

    pub(crate) fn matches(&self, name: &str) -> bool {
        self.whole.is_match(name)
    }

    pub(crate) fn find(&self, text: &str) -> Option<Range<usize>> {
        self.anywhere.find(text).map(|found| found.range())
    }

    pub(crate) fn find_all<'t>(&self, text: &'t str) -> impl Iterator<Item = &'t str> {
        self.anywhere.find_iter(text).map(|found| found.as_str())
    }

    /// The groups of a name that matches as a whole; a group that takes no part is empty.
    pub(crate) fn groups<'t>(&self, name: &'t str) -> Option<Vec<&'t str>> {
        let captures = self.whole.captures(name)?;
        Some(captures.iter().skip(1).map(|group| group.map_or("", |found| found.as_str())).collect())
    }
}

impl fmt::Debug for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "/{}/", self.source)
    }
}

impl PartialEq for Pattern {
    fn eq(&self, other: &Self) -> bool {
        self.source == other.source
    }
}

/// Compiles without regard to case. The size limit keeps a hostile pattern from taking the machine.
pub(crate) fn compile(source: &str) -> Result<Regex, PatternError> {
    RegexBuilder::new(source)
        .case_insensitive(true)
        .size_limit(1 << 20)
        .build()
        .map_err(|error| PatternError { reason: error.to_string().into() })
}
