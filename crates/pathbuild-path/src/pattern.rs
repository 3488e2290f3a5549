//! Patterns with groups for names of paths and files. They match whole names, ignoring case.

use std::fmt;
use std::ops::Range;
use std::sync::OnceLock;

use regex::{Regex, RegexBuilder};

use crate::default_pattern::{DefaultPattern, Match};
use crate::group::Groups;
use crate::number_range::NumberPart;

/// A pattern, for matching whole names and for searching texts.
#[derive(Clone)]
pub(crate) enum Pattern {
    /// A default pattern with a handwritten matcher.
    Default(DefaultPattern),
    /// A pattern from the configuration.
    Regex(Box<RegexPattern>),
}

/// A pattern as a regular expression.
#[derive(Clone)]
pub(crate) struct RegexPattern {
    source: Box<str>,
    whole: LazyRegex,
    anywhere: LazyRegex,
    /// Two matches separated by a hyphen or an en dash.
    range: LazyRegex,
}

/// A regular expression that is compiled on first use: compiling takes longer than reading most drawings, and a run without embeddings
/// needs only one of them.
#[derive(Clone)]
pub(crate) struct LazyRegex {
    source: Box<str>,
    compiled: OnceLock<Regex>,
}

/// A name that a pattern found in a text.
pub(crate) enum Name<'t> {
    /// A match of a default pattern, with its text.
    Default(Match, &'t str),
    /// The groups of any other match.
    Groups(Groups),
}

/// The reason why a pattern is invalid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PatternError {
    /// The message of the regular expression parser.
    pub reason: Box<str>,
}

impl Pattern {
    /// Creates a pattern, using the handwritten matcher if it is the default one.
    pub(crate) fn new(source: &str, default: DefaultPattern) -> Result<Self, PatternError> {
        if source == default.source() {
            return Ok(Self::Default(default));
        }
        RegexPattern::new(source).map(|pattern| Self::Regex(Box::new(pattern)))
    }

    /// Checks that the pattern also works for ranges. Only needed for patterns of file names.
    pub(crate) fn check_ranges(&self) -> Result<(), PatternError> {
        match self {
            Self::Default(_) => Ok(()),
            Self::Regex(pattern) => pattern.range.check(),
        }
    }

    pub(crate) fn as_str(&self) -> &str {
        match self {
            Self::Default(pattern) => pattern.source(),
            Self::Regex(pattern) => &pattern.source,
        }
    }

    /// Whether a name begins like one that matches. Most layers do not.
    pub(crate) fn may_begin(&self, name: &str) -> bool {
        match self {
            Self::Default(_) => name.as_bytes().first().is_some_and(u8::is_ascii_digit),
            Self::Regex(_) => true,
        }
    }

    pub(crate) fn matches(&self, name: &str) -> bool {
        match self {
            Self::Default(pattern) => pattern.whole(name).is_some(),
            Self::Regex(pattern) => pattern.whole.get().is_match(name),
        }
    }

    pub(crate) fn find(&self, text: &str) -> Option<Range<usize>> {
        match self {
            Self::Default(pattern) => pattern.find(text, 0).map(|found| found.range),
            Self::Regex(pattern) => pattern.anywhere.get().find(text).map(|found| found.range()),
        }
    }

    /// The groups of a name that matches as a whole. A group that does not participate is empty.
    pub(crate) fn groups(&self, name: &str) -> Option<Groups> {
        match self {
            Self::Default(pattern) => pattern.whole(name).map(|found| found.groups(name)),
            Self::Regex(pattern) => pattern.groups(name),
        }
    }

    /// Calls `take` for each name in a text.
    pub(crate) fn each(&self, text: &str, mut take: impl FnMut(Name<'_>)) {
        match self {
            Self::Default(pattern) => {
                pattern.find_all(text).for_each(|found| take(Name::Default(found, text)));
            }
            Self::Regex(pattern) => {
                let names = pattern.anywhere.get().find_iter(text);
                names.filter_map(|found| pattern.groups(found.as_str())).map(Name::Groups).for_each(take);
            }
        }
    }

    /// The only name in a text, if the text begins with it and no digits follow. Most files are named this way, and this test takes a tenth
    /// of the time.
    pub(crate) fn lone_numbers(&self, text: &str) -> Option<NumberPart> {
        match self {
            Self::Default(pattern) => pattern.lone_numbers(text),
            Self::Regex(_) => None,
        }
    }

    /// Calls `take` with both ends of each range in a text: two names separated by nothing but a hyphen.
    pub(crate) fn each_range(&self, text: &str, mut take: impl FnMut(Name<'_>, Name<'_>)) {
        match self {
            Self::Default(pattern) => {
                let name = |found| Name::Default(found, text);
                pattern.find_ranges(text).for_each(|(from, to)| take(name(from), name(to)));
            }
            Self::Regex(pattern) => {
                for found in pattern.range.get().captures_iter(text) {
                    let end = |name| pattern.groups(found.name(name)?.as_str());
                    if let (Some(from), Some(to)) = (end("from"), end("to")) {
                        take(Name::Groups(from), Name::Groups(to));
                    }
                }
            }
        }
    }

    /// The positions of the ranges.
    pub(crate) fn range_spans(&self, text: &str) -> Vec<Range<usize>> {
        match self {
            Self::Default(pattern) => {
                pattern.find_ranges(text).map(|(from, to)| from.range.start..to.range.end).collect()
            }
            Self::Regex(pattern) => pattern.range.get().find_iter(text).map(|found| found.range()).collect(),
        }
    }
}

impl Name<'_> {
    /// Its groups as numbers, if they are numbers.
    pub(crate) fn numbers(&self) -> Option<NumberPart> {
        match self {
            Self::Default(found, text) => found.numbers(text),
            Self::Groups(groups) => NumberPart::of(groups),
        }
    }

    pub(crate) fn groups(self) -> Groups {
        match self {
            Self::Default(found, text) => found.groups(text),
            Self::Groups(groups) => groups,
        }
    }
}

impl RegexPattern {
    /// Compiles the expressions immediately, to validate them.
    fn new(source: &str) -> Result<Self, PatternError> {
        let pattern = Self {
            source: source.into(),
            whole: LazyRegex::new(format!("^(?:{source})$")),
            anywhere: LazyRegex::new(source),
            range: LazyRegex::new(format!("(?P<from>{source})[A-Z]? *[-\u{2013}] *(?P<to>{source})")),
        };
        pattern.anywhere.check()?;
        pattern.whole.check()?;
        if pattern.whole.get().is_match("") {
            return Err(PatternError { reason: "it matches an empty name".into() });
        }
        Ok(pattern)
    }

    fn groups(&self, name: &str) -> Option<Groups> {
        let captures = self.whole.get().captures(name)?;
        Some(captures.iter().skip(1).map(|group| group.map_or("", |found| found.as_str())).collect())
    }
}

impl LazyRegex {
    pub(crate) fn new(source: impl Into<Box<str>>) -> Self {
        Self { source: source.into(), compiled: OnceLock::new() }
    }

    /// Compiles the expression, to validate it.
    pub(crate) fn check(&self) -> Result<(), PatternError> {
        let compiled = compile(&self.source)?;
        self.compiled.get_or_init(|| compiled);
        Ok(())
    }

    pub(crate) fn get(&self) -> &Regex {
        self.compiled.get_or_init(|| compile(&self.source).expect("the pattern was checked"))
    }
}

impl fmt::Debug for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "/{}/", self.as_str())
    }
}

impl fmt::Debug for LazyRegex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "/{}/", self.source)
    }
}

/// Compiles an expression that ignores case. The size limit prevents a hostile pattern from exhausting memory.
fn compile(source: &str) -> Result<Regex, PatternError> {
    RegexBuilder::new(source)
        .case_insensitive(true)
        .size_limit(1 << 20)
        .build()
        .map_err(|error| PatternError { reason: error.to_string().into() })
}
