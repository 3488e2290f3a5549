//! The plain text of an MTEXT. (book: language/parameter-texts)

use smol_str::{SmolStr, SmolStrBuilder};

use crate::encoding::control;

/// Removes the formatting from joined, decoded chunks. Line breaks become `\n`.
///
/// A command without its end is kept as text: dropping the rest of a parameter text would be worse.
pub(crate) fn plain_text(raw: &str) -> SmolStr {
    if !raw.bytes().any(is_special) {
        return raw.into();
    }
    let mut plain = SmolStrBuilder::new();
    // Found once, since thousands of unterminated commands would each search the whole rest.
    let behind_last = raw.rfind(';').map_or(raw.len(), |last| raw.len() - last - 1);
    let mut rest = raw;
    while let Some(special) = rest.bytes().position(is_special) {
        plain.push_str(&rest[..special]);
        rest = &rest[special..];
        let length = match rest.as_bytes()[0] {
            b'\\' => command(rest, rest.len() > behind_last, &mut plain),
            b'^' => caret(rest, &mut plain),
            _ => 1,
        };
        rest = &rest[length..];
    }
    plain.push_str(rest);
    plain.finish()
}

/// Whether a byte may start something that is not plain text.
fn is_special(byte: u8) -> bool {
    matches!(byte, b'\\' | b'{' | b'}' | b'^')
}

/// Appends the meaning of the command at the start of `text` and returns its length. `may_end` tells whether a `;` follows.
fn command(text: &str, may_end: bool, plain: &mut SmolStrBuilder) -> usize {
    let Some(letter) = text[1..].chars().next() else {
        plain.push('\\');
        return 1;
    };
    let short = 1 + letter.len_utf8();
    match letter {
        // \N starts a new column.
        'P' | 'X' | 'N' => plain.push('\n'),
        '~' => plain.push('\u{a0}'),
        '\\' | '{' | '}' => plain.push(letter),
        'L' | 'l' | 'O' | 'o' | 'K' | 'k' => {}
        'S' => return short + stacked(&text[short..], plain),
        _ => {
            let Some(end) = may_end.then(|| text.find(';')).flatten() else {
                plain.push('\\');
                return 1;
            };
            return end + 1;
        }
    }
    short
}

/// Appends a stacked text up to its `;` and returns its length.
fn stacked(text: &str, plain: &mut SmolStrBuilder) -> usize {
    let mut characters = text.char_indices().peekable();
    while let Some((index, character)) = characters.next() {
        match character {
            ';' => return index + 1,
            '#' => plain.push('/'),
            '^' if characters.next_if(|(_, next)| *next == ' ').is_some() => {}
            '\\' => {
                if let Some((_, literal)) = characters.next() {
                    plain.push(literal);
                }
            }
            other => plain.push(other),
        }
    }
    text.len()
}

/// Appends the meaning of the caret code at the start of `text` and returns its length.
fn caret(text: &str, plain: &mut SmolStrBuilder) -> usize {
    if text.starts_with("^M^J") {
        plain.push('\n');
        return 4;
    }
    let (character, length) = control(text).unwrap_or(('^', 1));
    plain.push(character);
    length
}
