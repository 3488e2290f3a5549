//! Handwritten matchers for the default patterns of path names and file names. They match the same texts as the regular expressions in a
//! tenth of the time, which dominates listing a directory of ten thousand drawings. (book: language/layers-and-names)

use std::ops::Range;

use crate::group::Groups;
use crate::number_range::NumberPart;

/// A pattern with a handwritten matcher.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DefaultPattern {
    /// `2913.2P`
    Path,
    /// `1234` or `1234.5`
    File,
}

/// A match with its groups. A group that does not participate is empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Match {
    pub(crate) range: Range<usize>,
    first: Range<usize>,
    second: Range<usize>,
    /// The letters at the end of a path name; the file pattern has no third group.
    third: Option<Range<usize>>,
}

impl DefaultPattern {
    /// The pattern as a regular expression.
    pub(crate) const fn source(self) -> &'static str {
        match self {
            Self::Path => "([0-9]{4})[.]([0-9]+)([A-Z])",
            Self::File => "([0-9]{4})(?:[.]([0-9]+))?",
        }
    }

    /// The match of the whole text.
    pub(crate) fn whole(self, text: &str) -> Option<Match> {
        self.at(text, 0).filter(|found| found.range.end == text.len())
    }

    /// The first match at or after a byte offset.
    pub(crate) fn find(self, text: &str, from: usize) -> Option<Match> {
        (from..text.len()).find_map(|start| self.at(text, start))
    }

    /// All non-overlapping matches from left to right.
    pub(crate) fn find_all(self, text: &str) -> impl Iterator<Item = Match> {
        let mut from = 0;
        std::iter::from_fn(move || {
            let found = self.find(text, from)?;
            from = found.range.end;
            Some(found)
        })
    }

    /// The match of the file pattern at the beginning of a text, if the rest cannot contain a range or another match.
    pub(crate) fn lone_numbers(self, text: &str) -> Option<NumberPart> {
        let (first, rest) = text.as_bytes().split_first_chunk::<4>()?;
        if self != Self::File || !first.iter().all(u8::is_ascii_digit) {
            return None;
        }
        let (second, rest) = match rest {
            [b'.', second @ ..] => second.split_at(digits(second, 0, second.len())),
            _ => (&[][..], rest),
        };
        (!rest.iter().any(u8::is_ascii_digit)).then(|| NumberPart::new(first, second))?
    }

    /// All non-overlapping pairs of matches with a hyphen between them, from left to right.
    pub(crate) fn find_ranges(self, text: &str) -> impl Iterator<Item = (Match, Match)> {
        let mut from = 0;
        let pair = move |start| {
            let first = self.at(text, start)?;
            let second = first.range.end + behind_dash(&text[first.range.end..])?;
            Some((first, self.at(text, second)?))
        };
        std::iter::from_fn(move || {
            let found = (from..text.len()).find_map(pair)?;
            from = found.1.range.end;
            Some(found)
        })
    }

    /// The match that begins at a byte offset. It is the one that a regular expression prefers, since digits are matched greedily.
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
    /// The groups of a match as numbers. Only for the file pattern, whose groups consist of digits.
    pub(crate) fn numbers(&self, text: &str) -> Option<NumberPart> {
        let bytes = text.as_bytes();
        match self.third {
            None => NumberPart::new(&bytes[self.first.clone()], &bytes[self.second.clone()]),
            Some(_) => None,
        }
    }

    /// The groups of a match.
    pub(crate) fn groups(&self, text: &str) -> Groups {
        let (first, second) = (&text[self.first.clone()], &text[self.second.clone()]);
        match &self.third {
            None => [first, second].into(),
            Some(third) => [first, second, &text[third.clone()]].into(),
        }
    }
}

/// The length of the separator of a range at the beginning of a text: an optional letter, and a hyphen or an en dash surrounded by optional
/// spaces.
fn behind_dash(text: &str) -> Option<usize> {
    let rest = &text[letter(text.as_bytes()).unwrap_or_default()..];
    let rest = rest.trim_start_matches(' ').strip_prefix(DASHES)?.trim_start_matches(' ');
    Some(text.len() - rest.len())
}

/// The separators of ranges: hyphen and en dash.
pub(crate) const DASHES: [char; 2] = ['-', '\u{2013}'];

/// The end of the digits that begin at a byte offset, limited to another offset.
fn digits(bytes: &[u8], from: usize, to: usize) -> usize {
    (from..to).find(|at| !bytes.get(*at).is_some_and(u8::is_ascii_digit)).unwrap_or(to)
}

/// The length of the letter at the beginning of a text. Regular expressions that ignore case also match two letters outside ASCII as S and
/// K: ſ and K.
fn letter(bytes: &[u8]) -> Option<usize> {
    let others = ["\u{17f}", "\u{212a}"].map(str::as_bytes);
    match bytes.first()? {
        letter if letter.is_ascii_alphabetic() => Some(1),
        _ => others.iter().find(|other| bytes.starts_with(other)).map(|other| other.len()),
    }
}
