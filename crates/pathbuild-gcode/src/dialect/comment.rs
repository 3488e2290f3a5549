//! Writes comments with text from outside: names, remarks, dates. All text from drawings, file names and options goes through this module. (book:
//! program/gcode; book: program/reading)

use std::borrow::Cow;

use pathbuild_diagnostic::escaping;

use super::rules::OBEYED_COMMENTS;
use super::{Dialect, NotationSupport, Percent};

/// The characters that may be written in comments. (book: reference/configuration, `charset`)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Charset {
    /// ASCII only, because some controllers take bytes above 127 for commands. Umlauts and the like are transliterated; anything else becomes `?`.
    #[default]
    Ascii,
    /// All characters are written as they are.
    Utf8,
}

impl Dialect {
    /// Formats a comment in the dialect. The text must begin with a word chosen by pathbuild, because some controls act on comments that
    /// begin with certain words.
    pub fn comment(self, text: &str, charset: Charset) -> String {
        let spelling = &self.rules().spelling;
        let text = comment_safe_text(text, Some(self), charset);
        match spelling {
            spelling if spelling.round_comments == NotationSupport::Usual => format!("({text})"),
            spelling if spelling.slash_comments == NotationSupport::Usual => format!("// {text}"),
            _ => format!("; {text}"),
        }
    }
}

/// Changes a text so that it neither ends a comment of the dialect nor makes the control act. If `dialect` is `None`, the result is safe in all
/// dialects.
pub fn comment_safe_text(text: &str, dialect: Option<Dialect>, charset: Charset) -> String {
    let spelling = dialect.map(|dialect| &dialect.rules().spelling);
    let acts_at_once = spelling.is_none_or(|spelling| spelling.real_time_bytes);
    let knows_percent = spelling.is_some_and(|spelling| spelling.percent != Percent::Refused);
    // Senders cut lines at semicolons, even within round brackets. Native programs keep semicolons, as documented.
    let keeps_semicolons = dialect == Some(Dialect::Native);
    let harmless = |c: char| match c {
        '(' => '[',
        ')' => ']',
        '\\' => '/',
        ';' if !keeps_semicolons => ',',
        '%' if !knows_percent => '-',
        '!' | '?' if acts_at_once => '.',
        '~' if acts_at_once => '-',
        c if escaping::is_active(c) => ' ',
        c => c,
    };
    let is_ascii = charset == Charset::Ascii || spelling.is_some_and(|spelling| spelling.real_time_bytes);
    let text: Cow<'_, str> = if is_ascii && !text.is_ascii() { ascii(text).into() } else { text.into() };
    if text.bytes().all(is_harmless_everywhere) {
        return text.into_owned();
    }
    let mut all = String::with_capacity(text.len());
    for c in text.chars().map(harmless) {
        // CI runners take `##[` anywhere in a printed line for a command, and a program may be printed there.
        if c == '#' && all.ends_with('#') {
            all.push(' ');
        }
        all.push(c);
    }
    all
}

/// Whether a byte is harmless in all dialects, as almost all characters are in practice.
fn is_harmless_everywhere(byte: u8) -> bool {
    matches!(byte, b' '..=b'~')
        && !matches!(byte, b'#' | b'(' | b')' | b'\\' | b';' | b'%' | b'!' | b'?' | b'~')
}

/// Transliterates umlauts and the like, with capitals if the surrounding letters are capitals.
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
            c if escaping::is_active(c) => ascii.push(' '),
            c if c.is_uppercase() && is_among_capitals => ascii.push_str(&transliterated(c).to_uppercase()),
            c => ascii.push_str(transliterated(c)),
        }
        is_after_capital = c.is_uppercase();
    }
    ascii
}

fn transliterated(character: char) -> &'static str {
    match character {
        'ä' | 'æ' => "ae",
        'ö' | 'œ' => "oe",
        'ü' => "ue",
        'Ä' | 'Æ' => "Ae",
        'Ö' | 'Œ' => "Oe",
        'Ü' => "Ue",
        'ß' => "ss",
        'à' | 'á' | 'â' | 'ã' | 'å' => "a",
        'è' | 'é' | 'ê' | 'ë' => "e",
        'ì' | 'í' | 'î' | 'ï' => "i",
        'ò' | 'ó' | 'ô' | 'õ' | 'ø' => "o",
        'ù' | 'ú' | 'û' | 'µ' | 'μ' => "u",
        'À' | 'Á' | 'Â' | 'Ã' | 'Å' => "A",
        'È' | 'É' | 'Ê' | 'Ë' => "E",
        'Ì' | 'Í' | 'Î' | 'Ï' => "I",
        'Ò' | 'Ó' | 'Ô' | 'Õ' | 'Ø' => "O",
        'Ù' | 'Ú' | 'Û' => "U",
        'ç' => "c",
        'Ç' => "C",
        'ñ' => "n",
        'Ñ' => "N",
        '°' => "deg",
        '±' => "+-",
        '⌀' => "D",
        '×' => "x",
        '–' | '—' => "-",
        '\u{a0}' => " ",
        _ => "?",
    }
}

/// Whether some control acts on a comment with this text, for example by opening a file, printing, hiding moves or running a program.
pub fn is_active_comment(text: &str) -> bool {
    leading_word(text, OBEYED_COMMENTS).or_else(|| leading_word(text, DISPLAY_WORDS)).is_some()
}

/// Returns the word from `words` with which a comment begins, ignoring blanks and case.
pub(crate) fn leading_word(text: &str, words: &[&'static str]) -> Option<&'static str> {
    let begins = |word: &str| {
        let mut letters = text.chars().filter(|c| !c.is_whitespace());
        word.chars().all(|letter| letters.next().is_some_and(|c| c.eq_ignore_ascii_case(&letter)))
    };
    words.iter().copied().find(|word| begins(word))
}

/// Words at the start of a comment that change what some control displays: messages, and which moves a preview shows.
const DISPLAY_WORDS: &[&str] = &["MSG", "DEBUG", "PRINT", "AXIS", "PREVIEW,", "STAT", "TOUCH", "PAUSE"];
