//! The plain text of an MTEXT. (book: language/parameter-texts)

use smol_str::{SmolStr, SmolStrBuilder};

use crate::encoding::control;

/// Removes the formatting from joined and decoded chunks. Line breaks become `\n`.
///
/// A command that never ends stays as it stands: it is no command, and to drop the rest of a parameter text would be worse.
pub(crate) fn plain_text(raw: &str) -> SmolStr {
    if !raw.bytes().any(is_special) {
        return raw.into();
    }
    let mut plain = SmolStrBuilder::new();
    // Looked for once: thousands of commands that never end would each look through all the rest.
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

/// Whether a byte may begin something that is not to be taken as it stands.
fn is_special(byte: u8) -> bool {
    matches!(byte, b'\\' | b'{' | b'}' | b'^')
}

/// A command, which `text` begins with: adds what it stands for, and returns its length. `may_end`: whether there is a `;` in the text.
fn command(text: &str, may_end: bool, plain: &mut SmolStrBuilder) -> usize {
    let Some(letter) = text[1..].chars().next() else {
        plain.push('\\');
        return 1;
    };
    let short = 1 + letter.len_utf8();
    match letter {
        // \N begins a new column.
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

/// A stacked text up to its `;`: adds it, and returns the length.
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

/// A caret, which `text` begins with: adds what it stands for, and returns its length.
fn caret(text: &str, plain: &mut SmolStrBuilder) -> usize {
    if text.starts_with("^M^J") {
        plain.push('\n');
        return 4;
    }
    let (character, length) = control(text).unwrap_or(('^', 1));
    plain.push(character);
    length
}
