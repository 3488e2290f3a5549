use pathbuild_draw::DrawError;

/// A word or a quoted string.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Token {
    pub(crate) text: String,
    pub(crate) quoted: bool,
    /// The column in characters, counted from 1.
    pub(crate) column: u32,
}

/// Splits a line into tokens. A `#` at the start of a word begins a comment; `""` in a string is a quotation mark.
pub(crate) fn tokens(line: &str, number: u32) -> Result<Vec<Token>, DrawError> {
    let mut tokens = Vec::new();
    let mut chars = (1..).zip(line.chars()).peekable();
    while let Some((column, c)) = chars.next() {
        match c {
            '#' => break,
            _ if c.is_whitespace() => {}
            '"' => {
                let text = string(&mut chars)
                    .ok_or_else(|| DrawError::new(number, column, "this quotation mark is never closed"))?;
                tokens.push(Token { text, quoted: true, column });
            }
            _ => {
                let mut text = String::from(c);
                while let Some((_, next)) = chars.next_if(|(_, next)| !next.is_whitespace()) {
                    text.push(next);
                }
                tokens.push(Token { text, quoted: false, column });
            }
        }
    }
    Ok(tokens)
}

fn string(chars: &mut std::iter::Peekable<impl Iterator<Item = (u32, char)>>) -> Option<String> {
    let mut text = String::new();
    loop {
        match chars.next()?.1 {
            '"' if chars.next_if(|(_, next)| *next == '"').is_none() => return Some(text),
            c => text.push(c),
        }
    }
}
