//! Texts of others in comments: names, remarks, dates. Whatever comes from a drawing, a file's name or an option passes here.
//! (book: program/gcode; book: program/reading)

use std::borrow::Cow;

use pathbuild_diagnostic::shown;

use super::{Dialect, Percent, Style};
use crate::native::{Charset, transliterated};

impl Dialect {
    /// A comment as the dialect spells it. Its text begins with a word of ours.
    pub fn comment(self, text: &str, charset: Charset) -> String {
        let spelling = &self.rules().spelling;
        let text = within_comment(text, Some(self), charset);
        match spelling {
            spelling if spelling.round_comments == Style::Usual => format!("({text})"),
            spelling if spelling.slash_comments == Style::Usual => format!("// {text}"),
            _ => format!("; {text}"),
        }
    }
}

/// A text that neither ends a comment of the dialect nor makes the control act. Without a dialect it is harmless in all.
pub fn within_comment(text: &str, dialect: Option<Dialect>, charset: Charset) -> String {
    let spelling = dialect.map(|dialect| &dialect.rules().spelling);
    let acts_at_once = spelling.is_none_or(|spelling| spelling.real_time_bytes);
    let knows_percent = spelling.is_some_and(|spelling| spelling.percent != Percent::Refused);
    // Senders cut lines at semicolons, within round brackets, too. The native program is as its page says.
    let keeps_semicolons = dialect == Some(Dialect::Native);
    let harmless = |c: char| match c {
        '(' => '[',
        ')' => ']',
        '\\' => '/',
        ';' if !keeps_semicolons => ',',
        '%' if !knows_percent => '-',
        '!' | '?' if acts_at_once => '.',
        '~' if acts_at_once => '-',
        c if shown::acts(c) => ' ',
        c => c,
    };
    let is_ascii = charset == Charset::Ascii || spelling.is_some_and(|spelling| spelling.real_time_bytes);
    let text: Cow<'_, str> = if is_ascii && !text.is_ascii() { ascii(text).into() } else { text.into() };
    if text.bytes().all(is_harmless_everywhere) {
        return text.into_owned();
    }
    let mut all = String::with_capacity(text.len());
    for c in text.chars().map(harmless) {
        // A program may be printed where a CI runner looks for `##[` anywhere in a line.
        if c == '#' && all.ends_with('#') {
            all.push(' ');
        }
        all.push(c);
    }
    all
}

/// As nearly all characters of nearly all comments are.
fn is_harmless_everywhere(byte: u8) -> bool {
    matches!(byte, b' '..=b'~')
        && !matches!(byte, b'#' | b'(' | b')' | b'\\' | b';' | b'%' | b'!' | b'?' | b'~')
}

/// A text with transliterated umlauts and the like, in capitals among capitals.
pub fn ascii(text: &str) -> String {
    let mut ascii = String::with_capacity(text.len());
    let mut characters = text.chars().peekable();
    let mut is_after_capital = false;
    while let Some(c) = characters.next() {
        let is_before_letter = characters.peek().is_some_and(|next| next.is_alphabetic());
        let is_among_capitals = characters.peek().is_some_and(|next| next.is_uppercase())
            || (is_after_capital && !is_before_letter);
        match c {
            c if c.is_ascii() => ascii.push(c),
            c if shown::acts(c) => ascii.push(' '),
            c if c.is_uppercase() && is_among_capitals => ascii.push_str(&transliterated(c).to_uppercase()),
            c => ascii.push_str(transliterated(c)),
        }
        is_after_capital = c.is_uppercase();
    }
    ascii
}

/// Whether a control acts on a comment with this text: it opens a file, prints, hides moves or runs a program.
pub fn is_active_comment(text: &str) -> bool {
    beginning_of(text, OBEYED).or_else(|| beginning_of(text, SHOWN)).is_some()
}

/// The word with which a comment begins, blanks and capitals aside.
pub(crate) fn beginning_of(text: &str, words: &[&'static str]) -> Option<&'static str> {
    let begins = |word: &str| {
        let mut letters = text.chars().filter(|c| !c.is_whitespace());
        word.chars().all(|letter| letters.next().is_some_and(|c| c.eq_ignore_ascii_case(&letter)))
    };
    words.iter().copied().find(|word| begins(word))
}

/// What LinuxCNC obeys: it writes files, runs programs or stops. With the comma where it acts with one only.
pub(super) const OBEYED: &[&str] = &[
    "LOG,",
    "LOGOPEN,",
    "LOGAPPEND,",
    "LOGCLOSE",
    "PROBEOPEN",
    "PROBECLOSE",
    "PY,",
    "PYRUN,",
    "PYRELOAD",
    "ABORT,",
];

/// What changes what somebody sees, at one control or another: messages, and which moves a preview shows.
const SHOWN: &[&str] = &["MSG", "DEBUG", "PRINT", "AXIS", "PREVIEW,", "STAT", "TOUCH", "PAUSE"];
