//! Patterns with groups, as those of paths and files are: matched as a whole, without regard to case.

use std::fmt;
use std::ops::Range;
use std::sync::OnceLock;

use regex::{Regex, RegexBuilder};

use crate::default_pattern::{DefaultPattern, Match};
use crate::group::Groups;
use crate::number_range::NumberPart;

/// A pattern for matching a whole name and for searching in a text.
#[derive(Clone)]
pub(crate) enum Pattern {
    /// One that is read by hand.
    Default(DefaultPattern),
    /// One of the configuration.
    Regex(Box<RegexPattern>),
}

/// A pattern as a regular expression.
#[derive(Clone)]
pub(crate) struct RegexPattern {
    source: Box<str>,
    whole: LazyRegex,
    anywhere: LazyRegex,
    /// Two of them with a hyphen or an en dash between.
    range: LazyRegex,
}

/// A regular expression that is compiled when it is first used: compiling takes longer than reading most drawings, and a run that
/// embeds nothing needs only one of them.
#[derive(Clone)]
pub(crate) struct LazyRegex {
    source: Box<str>,
    compiled: OnceLock<Regex>,
}

/// A name that a pattern found in a text.
pub(crate) enum Name<'t> {
    /// By the default pattern, with the text.
    Default(Match, &'t str),
    /// By another one.
    Groups(Groups),
}

/// Why a pattern cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PatternError {
    /// What is wrong, in the words of the regular expression parser.
    pub reason: Box<str>,
}

impl Pattern {
    /// A pattern that somebody gave, or the default where it is that.
    pub(crate) fn new(source: &str, default: DefaultPattern) -> Result<Self, PatternError> {
        if source == default.source() {
            return Ok(Self::Default(default));
        }
        RegexPattern::new(source).map(|pattern| Self::Regex(Box::new(pattern)))
    }

    /// Whether ranges can be looked for, which is asked of the patterns of file names alone.
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

    /// Whether a name begins as one that matches may: nearly all layers do not.
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

    /// The groups of a name that matches as a whole; a group that takes no part is empty.
    pub(crate) fn groups(&self, name: &str) -> Option<Groups> {
        match self {
            Self::Default(pattern) => pattern.whole(name).map(|found| found.groups(name)),
            Self::Regex(pattern) => pattern.groups(name),
        }
    }

    /// Each name in a text.
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

    /// The one name in a text that begins with it and has no digits behind it, which is how nearly all files are named: found in a tenth
    /// of the time.
    pub(crate) fn lone_numbers(&self, text: &str) -> Option<NumberPart> {
        match self {
            Self::Default(pattern) => pattern.lone_numbers(text),
            Self::Regex(_) => None,
        }
    }

    /// Both ends of each range in a text: two names with nothing but a hyphen between.
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

    /// Where each range stands.
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
    /// Its groups as numbers, where they are some.
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
    /// Compiles at once, to see whether it can be.
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

    /// Compiles it, to see whether it can be.
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

/// Compiles without regard to case. The size limit keeps a hostile pattern from taking the machine.
fn compile(source: &str) -> Result<Regex, PatternError> {
    RegexBuilder::new(source)
        .case_insensitive(true)
        .size_limit(1 << 20)
        .build()
        .map_err(|error| PatternError { reason: error.to_string().into() })
}
