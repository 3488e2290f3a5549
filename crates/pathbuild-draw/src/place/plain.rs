/// The lines of an MTEXT as plain text: without formatting codes, but with `%%c` and the like unchanged.
pub(crate) fn lines(value: &str) -> Vec<String> {
    let mut plain = String::new();
    let mut chars = value.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '{' | '}' => {}
            '\\' => escape(&mut chars, &mut plain),
            '^' => caret(&mut chars, &mut plain),
            _ => plain.push(c),
        }
    }
    plain.split('\n').map(str::to_owned).collect()
}

type Chars<'a> = std::iter::Peekable<std::str::Chars<'a>>;

fn escape(chars: &mut Chars<'_>, plain: &mut String) {
    match chars.next() {
        Some('P' | 'X') => plain.push('\n'),
        Some(c @ ('\\' | '{' | '}')) => plain.push(c),
        Some('~') => plain.push('\u{a0}'),
        Some('L' | 'l' | 'O' | 'o' | 'K' | 'k') | None => {}
        Some('S') => stacked(chars, plain),
        Some('U') if chars.peek() == Some(&'+') => unicode(chars, plain),
        Some(_) => while !matches!(chars.next(), Some(';') | None) {},
    }
}

fn stacked(chars: &mut Chars<'_>, plain: &mut String) {
    while let Some(c) = chars.next() {
        match c {
            ';' => break,
            '#' => plain.push('/'),
            '^' if chars.peek() == Some(&' ') => _ = chars.next(),
            '\\' => plain.extend(chars.next()),
            _ => plain.push(c),
        }
    }
}

/// Replaces `\U+XXXX` by one character, since the reader decodes it before the formatting.
fn unicode(chars: &mut Chars<'_>, plain: &mut String) {
    chars.next();
    let digits: String = chars.by_ref().take(4).collect();
    let decoded = u32::from_str_radix(&digits, 16).ok().and_then(char::from_u32);
    plain.push(decoded.unwrap_or('?'));
}

fn caret(chars: &mut Chars<'_>, plain: &mut String) {
    match chars.peek() {
        Some('J') => plain.push('\n'),
        Some('I') => plain.push('\t'),
        Some(' ') => plain.push('^'),
        _ => return plain.push('^'),
    }
    chars.next();
}
