//! The words of a line, and positions between them.

use crate::draw::DrawError;
use crate::draw::model::{Entity, Point};

/// A position between the tokens of a line.
#[derive(Debug)]
pub(crate) struct Cursor {
    tokens: std::vec::IntoIter<Token>,
    pub(crate) line: u32,
    /// The column of the last token taken.
    column: u32,
    /// The reference point for `@` and `to`.
    pub(crate) base: Option<Point>,
}

pub(crate) type Parsed<T> = Result<T, DrawError>;

impl Cursor {
    pub(crate) fn new(tokens: Vec<Token>, line: u32, base: Option<Point>) -> Self {
        Self { tokens: tokens.into_iter(), line, column: 1, base }
    }

    pub(crate) fn peek(&self) -> Option<&Token> {
        self.tokens.as_slice().first()
    }

    pub(crate) fn peek_word(&self) -> Option<&str> {
        self.peek().filter(|token| !token.quoted).map(|token| token.text.as_str())
    }

    pub(crate) fn is_at_string(&self) -> bool {
        self.peek().is_some_and(|token| token.quoted)
    }

    /// Whether the next token looks like a point or a number rather than a word.
    pub(crate) fn is_at_number(&self) -> bool {
        let starts = |c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | '@');
        self.peek_word().is_some_and(|word| word.starts_with(starts))
    }

    /// Returns an error at the last token taken.
    pub(crate) fn error(&self, message: impl Into<String>) -> DrawError {
        DrawError::new(self.line, self.column, message)
    }

    pub(crate) fn next(&mut self, expected: &str) -> Parsed<Token> {
        if let Some(token) = self.tokens.next() {
            self.column = token.column;
            return Ok(token);
        }
        Err(self.error(format!("the line ends here; expected {expected}")))
    }

    /// Takes the next word if it is `word`, and returns whether it is.
    pub(crate) fn take(&mut self, word: &str) -> bool {
        let found = self.peek_word() == Some(word);
        if found {
            _ = self.next(word);
        }
        found
    }

    pub(crate) fn keyword(&mut self, word: &str) -> Parsed<()> {
        let token = self.next(&format!("`{word}`"))?;
        if token.text == word && !token.quoted {
            return Ok(());
        }
        Err(self.error(format!("expected `{word}`, found {:?}", token.text)))
    }

    /// Takes a name: a word or a quoted string.
    pub(crate) fn name(&mut self, what: &str) -> Parsed<String> {
        self.next(what).map(|token| token.text)
    }

    pub(crate) fn string(&mut self, what: &str) -> Parsed<String> {
        let token = self.next(what)?;
        if token.quoted {
            return Ok(token.text);
        }
        Err(self.error(format!("expected {what} in quotation marks, found {:?}", token.text)))
    }

    pub(crate) fn number(&mut self, what: &str) -> Parsed<f64> {
        let token = self.next(what)?;
        number(&token.text).ok_or_else(|| {
            self.error(format!("{:?} is no number; expected {what}, with a decimal point", token.text))
        })
    }

    /// Takes a number, which must be positive.
    pub(crate) fn length(&mut self, what: &str) -> Parsed<f64> {
        let length = self.number(what)?;
        if length > 0.0 {
            return Ok(length);
        }
        Err(self.error(format!("{what} must be more than 0")))
    }

    pub(crate) fn integer<T: std::str::FromStr>(&mut self, what: &str) -> Parsed<T> {
        let token = self.next(what)?;
        token.text.parse().map_err(|_| self.error(format!("{:?} is no {what}", token.text)))
    }

    /// Takes `x,y` or `x,y,z`, or `@dx,dy` relative to the last point.
    pub(crate) fn point(&mut self, what: &str) -> Parsed<Point> {
        let token = self.next(what)?;
        let relative = token.text.strip_prefix('@');
        let parsed = point(relative.unwrap_or(&token.text)).ok_or_else(|| {
            self.error(format!("{:?} is no point; expected {what} as x,y such as 40,12.5", token.text))
        })?;
        let point = match (relative, self.base) {
            (None, _) => parsed,
            (Some(_), Some(base)) => base + parsed,
            (Some(_), None) => {
                return Err(self.error("there is no point before this that @ could be counted from"));
            }
        };
        self.base = Some(point);
        Ok(point)
    }

    /// Takes points as long as there are any.
    pub(crate) fn points(&mut self, what: &str) -> Parsed<Vec<Point>> {
        let mut points = Vec::new();
        while self.is_at_number() {
            points.push(self.point(what)?);
        }
        Ok(points)
    }

    /// Checks that no tokens are left.
    pub(crate) fn end(&mut self) -> Parsed<()> {
        match self.next("nothing") {
            Ok(token) => Err(self.error(format!("{:?} is not expected here", token.text))),
            Err(_) => Ok(()),
        }
    }
}

fn number(text: &str) -> Option<f64> {
    let plain = text.chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | 'E'));
    text.parse().ok().filter(|number: &f64| plain && number.is_finite())
}

fn point(text: &str) -> Option<Point> {
    let numbers: Vec<f64> = text.split(',').map(number).collect::<Option<_>>()?;
    match numbers[..] {
        [x, y] => Some(Point::new(x, y)),
        [x, y, z] => Some(Point::new(x, y).at_height(z)),
        _ => None,
    }
}

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

/// The entities that a line of the text form draws, and their end point.
pub(crate) struct ParsedEntities {
    pub(crate) entities: Vec<Entity>,
    pub(crate) end: Option<Point>,
}

pub(crate) fn choice<T: Copy>(cursor: &mut Cursor, what: &str, all: &[(&str, T)]) -> Parsed<T> {
    let word = cursor.name(what)?;
    let found = all.iter().find(|(name, _)| name.eq_ignore_ascii_case(&word));
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|(name, _)| *name).collect();
        cursor.error(format!("{word:?} is none of {}", names.join(", ")))
    })
}
