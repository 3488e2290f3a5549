//! Escapes untrusted text for display. A file name may contain escape sequences for the terminal, a line feed followed by a command for a
//! CI runner, or marks that reverse the direction of writing. All such characters are escaped when displayed, and only this module
//! decides which they are.
//!
//! | function | for | line feeds | special characters |
//! | --- | --- | --- | --- |
//! | [`line()`] | a name or a text within a line | `\n` | `\u{1b}` |
//! | [`framed`] | a text in a frame | kept | `\u{1b}` |
//! | [`lines`] | a complete output for humans | kept | `\u{1b}` |
//! | [`colored_lines`] | a complete output with colours | kept | `\u{1b}`, except for colours |
//! | [`json`] | a complete output in JSON | kept | `\u001b` |

use std::borrow::Cow;
use std::fmt::Write;

/// Whether a character has an effect other than being displayed: control characters, line and paragraph separators, direction marks,
/// zero-width characters, and tags.
pub fn is_active(character: char) -> bool {
    // The first comparison is fast and decides most characters.
    !matches!(character, ' '..='~')
        && matches!(
            character,
            '\0'..='\u{9f}'
                | '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}'
                | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}' | '\u{3164}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}' | '\u{ffa0}'
                | '\u{fff0}'..='\u{fffb}' | '\u{fffe}' | '\u{ffff}' | '\u{13430}'..='\u{1343f}'
                | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e0fff}'
        )
}

/// Escapes a name or a text within a line.
pub fn line(text: &str) -> Cow<'_, str> {
    escaped(text, is_active, escape)
}

/// Escapes a text of several lines that is displayed within a frame.
pub fn framed(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c != '\n' && is_active(c), escape)
}

/// Escapes an output of whole lines for humans. No line of the result is a command to a CI runner.
pub fn lines(text: &str) -> Cow<'_, str> {
    harmless_lines(framed(text))
}

/// Like [`lines`], but keeps sequences that set colours. Untrusted parts must have passed [`line()`] before.
pub fn colored_lines(text: &str) -> Cow<'_, str> {
    let acts = |c| !matches!(c, '\n' | '\u{1b}') && is_active(c);
    let escaped = escaped(text, acts, escape);
    let is_color = |rest: &str| {
        rest.strip_prefix("\u{1b}[").is_some_and(|codes| {
            codes.trim_start_matches(|c: char| c.is_ascii_digit() || c == ';').starts_with('m')
        })
    };
    if escaped.match_indices('\u{1b}').all(|(at, _)| is_color(&escaped[at..])) {
        return harmless_lines(escaped);
    }
    let mut all = String::with_capacity(escaped.len() + 16);
    for (at, character) in escaped.char_indices() {
        if character == '\u{1b}' && !is_color(&escaped[at..]) {
            escape(&mut all, character);
        } else {
            all.push(character);
        }
    }
    harmless_lines(all.into()).into_owned().into()
}

/// Escapes JSON without changing its meaning. Special characters only occur in strings, apart from line feeds between values.
pub fn json(text: &str) -> Cow<'_, str> {
    let escaped = escaped(
        text,
        |c| c != '\n' && is_active(c),
        |escaped, character| {
            for unit in character.encode_utf16(&mut [0; 2]) {
                _ = write!(escaped, "\\u{unit:04x}");
            }
        },
    );
    without_runner_commands(escaped, "\\u0023")
}

fn escape(escaped: &mut String, character: char) {
    escaped.extend(character.escape_default());
}

fn escaped(text: &str, acts: impl Fn(char) -> bool, escape: impl Fn(&mut String, char)) -> Cow<'_, str> {
    let Some(first) = text.find(&acts) else { return text.into() };
    let mut escaped = String::with_capacity(text.len() + 16);
    escaped.push_str(&text[..first]);
    for character in text[first..].chars() {
        if acts(character) {
            escape(&mut escaped, character);
        } else {
            escaped.push(character);
        }
    }
    escaped.into()
}

/// Escapes commands to CI runners: GitHub's runner obeys lines that begin with `::` or contain `##[`, Azure's those with `##vso[`.
fn harmless_lines(text: Cow<'_, str>) -> Cow<'_, str> {
    let text = without_runner_commands(text, "\\u{23}");
    if !text.contains("::") {
        return text;
    }
    let mut all = String::with_capacity(text.len() + 16);
    for line in text.split_inclusive('\n') {
        let start = text_start(line);
        match line[start..].strip_prefix("::") {
            Some(rest) => all.extend([&line[..start], "\\u{3a}:", rest]),
            None => all.push_str(line),
        }
    }
    all.into()
}

/// Returns the offset at which the text of a line starts, after spaces and colour sequences.
fn text_start(line: &str) -> usize {
    let mut rest = line;
    loop {
        let trimmed = rest.trim_start();
        match trimmed.strip_prefix("\u{1b}[").and_then(|codes| codes.split_once('m')) {
            Some((_, behind)) => rest = behind,
            None => return line.len() - trimmed.len(),
        }
    }
}

/// Breaks up the commands that CI runners find anywhere in a line: `##`, optional letters, and `[`.
fn without_runner_commands<'a>(text: Cow<'a, str>, hash: &str) -> Cow<'a, str> {
    let is_command =
        |rest: &str| rest[2..].trim_start_matches(|c: char| c.is_ascii_alphabetic()).starts_with('[');
    let commands: Vec<usize> = hashes(&text).filter(|at| is_command(&text[*at..])).collect();
    if commands.is_empty() {
        return text;
    }
    let mut all = String::with_capacity(text.len() + 16);
    let mut done = 0;
    for at in commands {
        all.extend([&text[done..=at], hash]);
        done = at + 2;
    }
    all.push_str(&text[done..]);
    all.into()
}

/// Returns, for each run of at least two `#`, the offset of the last two.
fn hashes(text: &str) -> impl Iterator<Item = usize> {
    text.match_indices('#').map(|(at, _)| at).filter(|at| {
        let rest = &text.as_bytes()[at + 1..];
        rest.first() == Some(&b'#') && rest.get(1) != Some(&b'#')
    })
}
