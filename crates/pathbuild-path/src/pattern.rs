//! Regular expressions with groups, as path and file patterns are: matched as a whole, without regard to case.

use std::fmt;
use std::ops::Range;
use std::sync::OnceLock;

use regex::{Captures, Regex, RegexBuilder};

/// A pattern of the configuration, for matching a whole name and for searching in a text.
#[derive(Clone)]
pub(crate) struct Pattern {
    source: Box<str>,
    whole: LazyRegex,
    anywhere: LazyRegex,
}

/// A regular expression that is compiled when it is first used: compiling takes longer than reading most drawings, and a run that
/// embeds nothing needs only one of them.
#[derive(Clone)]
pub(crate) struct LazyRegex {
    source: Box<str>,
    compiled: OnceLock<Regex>,
}

/// Why a pattern cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PatternError {
    /// What is wrong, in the words of the regular expression parser.
    pub reason: Box<str>,
}

impl Pattern {
    /// A pattern that somebody gave: compiled at once, to see whether it can be.
    pub(crate) fn new(source: &str) -> Result<Self, PatternError> {
        let pattern = Self::known(source);
        pattern.anywhere.check()?;
        pattern.whole.check()?;
        if pattern.whole.get().is_match("") {
            return Err(PatternError { reason: "it matches an empty name".into() });
        }
        Ok(pattern)
    }

    /// A pattern that is known to compile.
    pub(crate) fn known(source: &str) -> Self {
        let whole = LazyRegex::new(format!("^(?:{source})$"));
        Self { source: source.into(), whole, anywhere: LazyRegex::new(source) }
    }

    pub(crate) fn as_str(&self) -> &str {
        &self.source
    }

    pub(crate) fn matches(&self, name: &str) -> bool {
        self.whole.get().is_match(name)
    }

    pub(crate) fn find(&self, text: &str) -> Option<Range<usize>> {
        self.anywhere.get().find(text).map(|found| found.range())
    }

    pub(crate) fn find_all<'t>(&self, text: &'t str) -> impl Iterator<Item = &'t str> {
        self.anywhere.get().find_iter(text).map(|found| found.as_str())
    }

    /// The groups of a name that matches as a whole; a group that takes no part is empty.
    pub(crate) fn groups<'t>(&self, name: &'t str) -> Option<Vec<&'t str>> {
        let captures = self.whole.get().captures(name)?;
        Some(captures.iter().skip(1).map(|group| group.map_or("", |found| found.as_str())).collect())
    }
}

impl LazyRegex {
    pub(crate) fn new(source: impl Into<Box<str>>) -> Self {
        Self { source: source.into(), compiled: OnceLock::new() }
    }

    /// Compiles it, to see whether it can be.
    pub(crate) fn check(&self) -> Result<(), PatternError> {
        let compiled = compile(&self.source)?;
        self.compiled.get_or_init(|| compiled);
        Ok(())
    }

    pub(crate) fn captures_all<'t>(&self, text: &'t str) -> impl Iterator<Item = Captures<'t>> {
        self.get().captures_iter(text)
    }

    fn get(&self) -> &Regex {
        self.compiled
            .get_or_init(|| compile(&self.source).expect("the pattern was checked, or is the default"))
    }
}

impl fmt::Debug for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "/{}/", self.source)
    }
}

impl fmt::Debug for LazyRegex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "/{}/", self.source)
    }
}

/// Compiles without regard to case. The size limit keeps a hostile pattern from taking the machine.
fn compile(source: &str) -> Result<Regex, PatternError> {
    RegexBuilder::new(source)
        .case_insensitive(true)
        .size_limit(1 << 20)
        .build()
        .map_err(|error| PatternError { reason: error.to_string().into() })
}
