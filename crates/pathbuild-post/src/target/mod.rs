//! The controls that posts write for: what they accept, and the check of a text before it is written.

mod check;
mod plain;

pub(super) use check::check;
pub(super) use plain::plain;

use pathbuild_gcode::dialect::{Acceptance, Dialect, LineLength, Percent, Style, Words};

/// What a control accepts.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "controls differ in each by itself")]
pub(super) struct Target {
    /// Name of its dialect.
    pub(super) name: &'static str,
    words: &'static Words,
    comments: Comments,
    /// Whether `!`, `?`, `~` and bytes above 127 act immediately, even in comments.
    has_real_time_bytes: bool,
    /// Whether a line may begin with `%`.
    percent: bool,
    /// Whether the rest of a line after `%` is the name of the program, even after a block number.
    titles: bool,
    longest: Option<LineLength>,
    /// Whether the tool number follows M6 without a letter.
    bare_tool_number: bool,
    /// M codes that are followed by a text for the display.
    message_codes: &'static [u16],
    /// Whether lines may begin with N.
    line_numbers: bool,
    /// The dialect in which the output is read back.
    pub(super) reader: Dialect,
}

/// The comment notations of a control.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "controls differ in each by itself")]
struct Comments {
    /// `( )`.
    round: bool,
    /// Whether `(` is an ordinary character within a round comment.
    nested: bool,
    /// `;` to the end of the line.
    semicolon: bool,
    /// `//` to the end of the line.
    slashes: bool,
}

impl Target {
    /// Finds the target by the name of its dialect.
    pub(super) fn of(name: &str) -> Option<Self> {
        name.parse().ok().map(Self::of_dialect)
    }

    /// The names of all targets, for messages.
    pub(super) fn names() -> Vec<&'static str> {
        Dialect::ALL.iter().map(|dialect| dialect.name()).collect()
    }

    fn of_dialect(dialect: Dialect) -> Self {
        let rules = dialect.rules();
        let spelling = &rules.spelling;
        Self {
            name: dialect.name(),
            words: rules.words,
            comments: Comments {
                round: spelling.round_comments == Style::Usual,
                nested: spelling.nested_comments,
                semicolon: spelling.semicolon_comments == Style::Usual,
                slashes: spelling.slash_comments == Style::Usual,
            },
            has_real_time_bytes: spelling.real_time_bytes,
            percent: spelling.percent != Percent::Refused,
            titles: spelling.percent == Percent::Title,
            longest: spelling.line_length,
            bare_tool_number: spelling.bare_tool_number,
            message_codes: spelling.message_codes,
            line_numbers: spelling.block_numbers.is_some(),
            reader: dialect,
        }
    }

    /// Whether the control supports the cycle G81.
    pub(super) fn has_cycles(&self) -> bool {
        self.words.g(810) == Acceptance::Taken
    }

    /// Whether the control supports M3.
    pub(super) fn switches_spindle(&self) -> bool {
        self.words.m(30) == Acceptance::Taken
    }

    /// Whether only ASCII may be written, regardless of the configuration.
    pub(super) fn needs_ascii(&self) -> bool {
        self.has_real_time_bytes
    }

    /// Length of the mark that opens a comment at the beginning of a text, and the mark that closes it, unless it extends to the end of the
    /// line.
    pub(super) fn comment_marks(&self, text: &str) -> Option<(usize, &'static str)> {
        let Comments { round, semicolon, slashes, .. } = self.comments;
        let signs = [(round, "(", ")"), (semicolon, ";", ""), (slashes, "//", "")];
        let found = signs.into_iter().find(|(is_known, open, _)| *is_known && text.starts_with(open));
        found.map(|(_, open, close)| (open.len(), close))
    }

    /// Length of the comment at the beginning of a text, or `None` if there is none.
    fn comment_length(&self, text: &str) -> Option<usize> {
        let (open, close) = self.comment_marks(text)?;
        let end = text[open..].find(close).filter(|_| !close.is_empty());
        Some(end.map_or(text.len(), |end| open + end + close.len()))
    }

    /// Length of the code at the beginning of a line. M0 and M117 are followed by a text for the display.
    pub(crate) fn code_length(&self, line: &str) -> usize {
        let digits = line
            .strip_prefix('M')
            .map_or("", |rest| &rest[..rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())]);
        let shows = digits.parse().is_ok_and(|code: u16| self.message_codes.contains(&code));
        if shows { 1 + digits.len() } else { line.len() }
    }

    /// Splits a line.
    fn pieces<'a>(&self, line: &'a str) -> Vec<LinePart<'a>> {
        let mut pieces = Vec::new();
        let mut begins = 0;
        let mut at = 0;
        if self.titles
            && let Some(percent) = line.find('%').filter(|at| is_block_number(&line[..*at]))
        {
            return vec![LinePart::Code(&line[..percent]), LinePart::Comment(&line[percent..])];
        }
        let code = self.code_length(line);
        if code < line.len() {
            return vec![LinePart::Code(&line[..code]), LinePart::Comment(&line[code..])];
        }
        while at < line.len() {
            match self.comment_length(&line[at..]) {
                Some(length) => {
                    pieces.push(LinePart::Code(&line[begins..at]));
                    pieces.push(LinePart::Comment(&line[at..at + length]));
                    at += length;
                    begins = at;
                }
                None => at += line[at..].chars().next().map_or(1, char::len_utf8),
            }
        }
        pieces.push(LinePart::Code(&line[begins..]));
        pieces
    }
}

/// Whether a text is empty or a block number.
fn is_block_number(text: &str) -> bool {
    let text = text.trim();
    text.is_empty()
        || text.strip_prefix('N').is_some_and(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()))
}

/// A part of a line.
#[derive(Clone, Copy, Debug)]
enum LinePart<'a> {
    Code(&'a str),
    Comment(&'a str),
}
