use std::fmt::Write;
use std::hash::{Hash, Hasher};

use serde::{Deserialize, Serialize};

use crate::{Code, Number, Point, in_prose, kept, shown};

/// The supported languages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lang {
    /// English.
    #[default]
    En,
    /// German.
    De,
}

/// A sentence in every language, with `{name}` as placeholders for arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Text {
    /// English.
    pub en: &'static str,
    /// German.
    pub de: &'static str,
}

impl Text {
    /// The sentence in one language, with placeholders.
    pub fn template(&self, lang: Lang) -> &'static str {
        match lang {
            Lang::En => self.en,
            Lang::De => self.de,
        }
    }
}

/// A message of the catalogue. A code has one message for each way in which the problem occurs.
///
/// Messages are statics declared by the `messages!` macro in [`crate::messages`]; two messages are equal if they are the same static.
#[derive(Debug)]
pub struct Message {
    /// The code under which it is reported. A note has the code of the diagnostics that it usually accompanies.
    pub code: Code,
    /// A unique name, derived from that of the static and its module. It is stable within a version, for caches and tests.
    pub key: &'static str,
    /// The problem.
    pub text: Text,
    /// Advice for the CAD program or the file. Empty if the message says it all.
    pub help: Text,
}

impl PartialEq for Message {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

impl Eq for Message {}

impl Hash for Message {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key.hash(state);
    }
}

/// A value in a message.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Value {
    /// A name or a piece of source text.
    Text(Box<str>),
    /// A number in mm or mm/min.
    Number(Number),
    /// A count.
    Count(u64),
    /// A point in the drawing.
    Point(Point),
    /// Names, displayed as a comma-separated list.
    List(Box<[Box<str>]>),
    /// A word with a translation of its own.
    Word(#[serde(deserialize_with = "kept::word")] &'static Word),
}

/// A word or short phrase in every language.
#[derive(Debug, PartialEq, Eq, Hash, Serialize)]
pub struct Word {
    /// English.
    pub en: &'static str,
    /// German.
    pub de: &'static str,
}

impl Word {
    /// The word in one language.
    pub fn in_lang(&self, lang: Lang) -> &'static str {
        match lang {
            Lang::En => self.en,
            Lang::De => self.de,
        }
    }
}

impl Value {
    fn number(&self) -> Option<Number> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// Renders the value for a message: on one line, with special characters escaped.
    pub fn render(&self, lang: Lang) -> String {
        match self {
            Self::Text(text) => shown::line(text).into_owned(),
            Self::Number(number) => number.prose(lang),
            Self::Count(count) => count.to_string(),
            Self::Point(point) => format!("({}, {})", point.x, point.y),
            Self::List(items) if items.is_empty() => Self::Word(&crate::words::NONE).render(lang),
            Self::List(items) => shown::line(&items.join(", ")).into_owned(),
            Self::Word(word) => match lang {
                Lang::En => word.en.to_owned(),
                Lang::De => word.de.to_owned(),
            },
        }
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text.into())
    }
}

impl From<char> for Value {
    fn from(letter: char) -> Self {
        Self::Text(letter.to_string().into())
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(Number(number))
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<u64> for Value {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<Point> for Value {
    fn from(point: Point) -> Self {
        Self::Point(point)
    }
}

impl From<&'static Word> for Value {
    fn from(word: &'static Word) -> Self {
        Self::Word(word)
    }
}

impl<S: AsRef<str>> FromIterator<S> for Value {
    fn from_iter<I: IntoIterator<Item = S>>(items: I) -> Self {
        Self::List(items.into_iter().map(|item| item.as_ref().into()).collect())
    }
}

/// Fills in the placeholders of a template. A `{name}` without an argument is left as it is, so that tests can find it.
pub(crate) fn fill(template: &str, arguments: &[(&'static str, Value)], lang: Lang) -> String {
    let mut filled = String::with_capacity(template.len() + 32);
    let mut rest = template;
    while let Some(open) = rest.find('{') {
        let Some(length) = rest[open..].find('}') else { break };
        let name = &rest[open + 1..open + length];
        filled.push_str(&rest[..open]);
        match arguments.iter().find(|(argument, _)| *argument == name) {
            Some((_, Value::Number(number))) => {
                let text = number.apart_from(arguments.iter().filter_map(|(_, value)| value.number()));
                // A number directly after a letter is a parameter or a word of G-code, for example `O2.5`.
                let is_word = filled.ends_with(|before: char| before.is_ascii_uppercase());
                filled.push_str(&if is_word { text } else { in_prose(text, lang) });
            }
            Some((_, value)) => filled.push_str(&value.render(lang)),
            None => _ = write!(filled, "{{{name}}}"),
        }
        rest = &rest[open + length + 1..];
    }
    filled.push_str(rest);
    filled
}
