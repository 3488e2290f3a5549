//! Patterns with groups for names of paths and files. They match whole names, ignoring case.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;
use std::sync::OnceLock;

use regex::{Regex, RegexBuilder};
use smol_str::SmolStr;

/// The groups that a pattern matched in a name, by which paths and files are compared. A group that took no part in the match is empty.
pub(crate) type Groups = Box<[SmolStr]>;

/// A pattern, for matching whole names and for searching texts.
#[derive(Clone)]
pub(crate) enum Pattern {
    /// A default pattern with a handwritten matcher.
    Default(DefaultPattern),
    /// A pattern from the configuration.
    Regex(Box<RegexPattern>),
}

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

/// The pattern for names of layers with clamps or with finished parts. It must match the whole name, ignoring case.
#[derive(Clone, Debug)]
pub struct LayerPattern {
    whole: LazyRegex,
    /// The first character of all names that match, if the pattern begins with it. Most names of layers begin with another one.
    first: Option<char>,
    /// The letters of the expression, each once.
    letters: Box<str>,
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

    /// Whether a name may match, judged by its first character. Most names of layers cannot.
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

    /// Returns the groups of a name; `None` if the pattern does not match the whole name.
    pub(crate) fn groups(&self, name: &str) -> Option<Groups> {
        match self {
            Self::Default(pattern) => pattern.whole(name).map(|found| found.groups(name)),
            Self::Regex(pattern) => pattern.groups(name),
        }
    }

    /// Calls `take` with the groups of each name in a text.
    pub(crate) fn each(&self, text: &str, take: impl FnMut(Groups)) {
        match self {
            Self::Default(pattern) => pattern.find_all(text).map(|found| found.groups(text)).for_each(take),
            Self::Regex(pattern) => {
                let names = pattern.anywhere.get().find_iter(text);
                names.filter_map(|found| pattern.groups(found.as_str())).for_each(take);
            }
        }
    }

    /// Calls `take` with both ends of each range in a text: two names separated by a hyphen or an en dash.
    pub(crate) fn each_range(&self, text: &str, mut take: impl FnMut(Groups, Groups)) {
        match self {
            Self::Default(pattern) => {
                pattern.find_ranges(text).for_each(|(from, to)| take(from.groups(text), to.groups(text)));
            }
            Self::Regex(pattern) => {
                for found in pattern.range.get().captures_iter(text) {
                    let end = |name| pattern.groups(found.name(name)?.as_str());
                    if let (Some(from), Some(to)) = (end("from"), end("to")) {
                        take(from, to);
                    }
                }
            }
        }
    }

    /// Returns the byte ranges of the name ranges in a text.
    pub(crate) fn range_spans(&self, text: &str) -> Vec<Range<usize>> {
        match self {
            Self::Default(pattern) => {
                pattern.find_ranges(text).map(|(from, to)| from.range.start..to.range.end).collect()
            }
            Self::Regex(pattern) => pattern.range.get().find_iter(text).map(|found| found.range()).collect(),
        }
    }
}

impl RegexPattern {
    /// Compiles all expressions except the one for ranges immediately, to validate them.
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
        Some(captures.iter().skip(1).map(|group| group.map_or("", |found| found.as_str()).into()).collect())
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

impl LayerPattern {
    /// Creates a pattern from the configuration.
    ///
    /// # Errors
    /// If it is not a valid regular expression.
    pub fn new(pattern: &str) -> Result<Self, PatternError> {
        let whole = LazyRegex::new(format!("^(?:{pattern})$"));
        whole.check()?;
        let letters: BTreeSet<char> = pattern.chars().filter(|letter| letter.is_alphabetic()).collect();
        Ok(Self { whole, first: first_character(pattern), letters: letters.into_iter().collect() })
    }

    /// Returns the letters of the expression, for guessing which letter is missing in a name.
    pub(crate) fn letters(&self) -> &str {
        &self.letters
    }

    /// Whether the pattern matches a layer.
    pub fn is_layer(&self, layer: &str) -> bool {
        layer.chars().next().is_none_or(|first| self.may_begin_with(first))
            && self.whole.get().is_match(layer)
    }

    /// Whether a name that begins with this character may match. A letter outside ASCII may stand for S or K, see [`letter`].
    pub(crate) fn may_begin_with(&self, first: char) -> bool {
        self.first.is_none_or(|known| known.eq_ignore_ascii_case(&first) || !first.is_ascii())
    }

    /// Returns the text of the first group that captures any of a layer's name.
    pub(crate) fn captured_text<'l>(&self, layer: &'l str) -> Option<&'l str> {
        let captures = self.whole.get().captures(layer)?;
        captures.iter().skip(1).flatten().map(|found| found.as_str()).find(|text| !text.is_empty())
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

/// Returns the character with which all matches of an expression begin; `None` unless that is obvious.
fn first_character(source: &str) -> Option<char> {
    let mut characters = source.chars();
    let first = characters.next().filter(char::is_ascii_alphanumeric)?;
    let may_be_missing = matches!(characters.next(), Some('?' | '*' | '{')) || source.contains('|');
    (!may_be_missing).then_some(first)
}

fn compile(source: &str) -> Result<Regex, PatternError> {
    name_regex(source).map_err(|error| PatternError { reason: error.to_string().into() })
}

/// Compiles an expression for names, which ignores case as names do. The size limit prevents a hostile pattern from exhausting memory.
///
/// # Errors
/// If the expression is not valid, or too large.
pub fn name_regex(source: &str) -> Result<Regex, regex::Error> {
    RegexBuilder::new(source).case_insensitive(true).size_limit(1 << 20).build()
}

/// A default pattern. Its handwritten matcher finds the same matches as the regular expression in a tenth of the time, which saves 4 % of a cold
/// check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DefaultPattern {
    /// The pattern for path names such as `2913.2P`.
    Path,
    /// The pattern for names in file names, such as `1234` or `1234.5`.
    File,
}

/// A match with its groups. A group that took no part in the match is empty.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Match {
    range: Range<usize>,
    first: Range<usize>,
    second: Range<usize>,
    /// The letters at the end of a path name; the file pattern has no third group.
    third: Option<Range<usize>>,
}

impl DefaultPattern {
    /// Returns the pattern as a regular expression.
    pub(crate) const fn source(self) -> &'static str {
        match self {
            Self::Path => "([0-9]{4})[.]([0-9]+)([A-Z])",
            Self::File => "([0-9]{4})(?:[.]([0-9]+))?",
        }
    }

    fn whole(self, text: &str) -> Option<Match> {
        self.at(text, 0).filter(|found| found.range.end == text.len())
    }

    /// Returns the first match at or after a byte offset.
    fn find(self, text: &str, from: usize) -> Option<Match> {
        (from..text.len()).find_map(|start| self.at(text, start))
    }

    /// Returns all non-overlapping matches from left to right.
    fn find_all(self, text: &str) -> impl Iterator<Item = Match> {
        let mut from = 0;
        std::iter::from_fn(move || {
            let found = self.find(text, from)?;
            from = found.range.end;
            Some(found)
        })
    }

    /// Returns all non-overlapping pairs of matches that a hyphen or an en dash separates, from left to right.
    fn find_ranges(self, text: &str) -> impl Iterator<Item = (Match, Match)> {
        let mut from = 0;
        let pair = move |start| {
            let first = self.at(text, start)?;
            let second = first.range.end + separator_length(&text[first.range.end..])?;
            Some((first, self.at(text, second)?))
        };
        std::iter::from_fn(move || {
            let found = (from..text.len()).find_map(pair)?;
            from = found.1.range.end;
            Some(found)
        })
    }

    /// Returns the match that begins at a byte offset. A regular expression would prefer the same match, since digits are matched greedily.
    fn at(self, text: &str, start: usize) -> Option<Match> {
        let bytes = text.as_bytes();
        let point = start + 4;
        if digits(bytes, start, point) != point {
            return None;
        }
        let second = match bytes.get(point) {
            Some(b'.') => point + 1..digits(bytes, point + 1, bytes.len()),
            _ => point..point,
        };
        match self {
            Self::File if second.is_empty() => {
                Some(Match { range: start..point, first: start..point, second: point..point, third: None })
            }
            Self::File => Some(Match { range: start..second.end, first: start..point, second, third: None }),
            Self::Path => {
                let letter = (!second.is_empty()).then(|| letter(&bytes[second.end..]))??;
                let third = second.end..second.end + letter;
                Some(Match { range: start..third.end, first: start..point, second, third: Some(third) })
            }
        }
    }
}

impl Match {
    fn groups(&self, text: &str) -> Groups {
        let groups = [Some(&self.first), Some(&self.second), self.third.as_ref()];
        groups.into_iter().flatten().map(|group| text[group.clone()].into()).collect()
    }
}

/// Returns the length in bytes of a range's separator at the beginning of a text: an optional letter, then a hyphen or an en dash surrounded by
/// optional spaces.
fn separator_length(text: &str) -> Option<usize> {
    let rest = &text[letter(text.as_bytes()).unwrap_or_default()..];
    let rest = rest.trim_start_matches(' ').strip_prefix(DASHES)?.trim_start_matches(' ');
    Some(text.len() - rest.len())
}

/// The separators of ranges: hyphen and en dash.
pub(crate) const DASHES: [char; 2] = ['-', '\u{2013}'];

/// Returns the byte offset at which the digits from `from` end, but at most `to`.
fn digits(bytes: &[u8], from: usize, to: usize) -> usize {
    (from..to).find(|at| !bytes.get(*at).is_some_and(u8::is_ascii_digit)).unwrap_or(to)
}

/// Returns the length in bytes of the letter at the beginning of a text. Regular expressions that ignore case also match two letters outside ASCII as
/// S and K: ſ and K.
fn letter(bytes: &[u8]) -> Option<usize> {
    let others = ["\u{17f}", "\u{212a}"].map(str::as_bytes);
    match bytes.first()? {
        letter if letter.is_ascii_alphabetic() => Some(1),
        _ => others.iter().find(|other| bytes.starts_with(other)).map(|other| other.len()),
    }
}
