use std::fmt::{self, Write};
use std::hash::{Hash, Hasher};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::location::{Number, Point, with_decimal_separator};
use crate::words::{Lang, NONE, Text, interned_str, interned_text};
use crate::{Code, Severity, escaping};

/// A [`Text`] with the values of its arguments, for use in another message: "it has 17219 bytes, the limit is 1000".
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Sentence {
    #[serde(deserialize_with = "interned_text")]
    text: &'static Text,
    #[serde(deserialize_with = "deserialize_arguments")]
    arguments: Arguments,
}

impl Sentence {
    /// Creates a sentence without values for its arguments.
    pub fn new(text: &'static Text) -> Self {
        Self { text, arguments: Vec::new() }
    }

    /// Sets the value of an argument.
    pub fn with(mut self, name: &'static str, value: impl Into<Value>) -> Self {
        self.arguments.push((name, value.into()));
        self
    }

    /// Sets the value of an argument to a name or a piece of source text.
    pub fn quoting(self, name: &'static str, text: impl AsRef<str>) -> Self {
        self.with(name, Value::quoted(text))
    }
}

/// The values in a message, each with the name of its argument.
pub(crate) type Arguments = Vec<(&'static str, Value)>;

/// A message that belongs to a code. A code has one message for each situation that it covers.
///
/// Messages are statics declared by the `messages!` macro in [`crate::messages`]; two messages are equal if they are the same static.
#[derive(Debug)]
pub struct Message {
    /// Code under which the message is reported. A note has the code of the diagnostics that it usually accompanies.
    pub code: Code,
    /// Default severity, usually that of the code. The stage that reports the message may change the severity.
    pub severity: Severity,
    /// Unique name, derived from the names of the static and its module. It is stable within a version, for caches and tests.
    pub key: &'static str,
    /// Description of the problem.
    pub text: Text,
    /// Advice on how to solve the problem; empty if the description makes it obvious.
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

impl Serialize for Message {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.key)
    }
}

/// A value in a message. There is no conversion from strings, so that their kind must be stated: a name or a piece of source text is
/// [`quoted`](Value::quoted), prose is a [`Text`] or a [`Sentence`], and the error text of a library is [`foreign`](Value::foreign).
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Value {
    /// A name or a piece of source text, the same in every language.
    Quoted(Box<str>),
    /// A measured or computed number, such as a length in mm, a feed in mm/min or a spindle speed in 1/min.
    Number(Number),
    /// A number of things, without a unit.
    Count(u64),
    /// A point in the drawing.
    Point(Point),
    /// Names, displayed as a comma-separated list.
    List(Box<[Box<str>]>),
    /// Prose without arguments.
    Prose(#[serde(deserialize_with = "interned_text")] &'static Text),
    /// Prose with arguments of its own.
    Sentence(Box<Sentence>),
    /// The error text of a library or of the operating system. It is English, so it is put in quotes in other languages.
    Foreign(Box<str>),
}

impl Value {
    /// Returns the points in this value, including those within a sentence.
    pub fn points(&self) -> Vec<Point> {
        match self {
            Self::Point(point) => vec![*point],
            Self::Sentence(sentence) => {
                sentence.arguments.iter().flat_map(|(_, value)| value.points()).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Creates a value from a name or a piece of source text.
    pub fn quoted(text: impl AsRef<str>) -> Self {
        Self::Quoted(text.as_ref().into())
    }

    /// Creates a value from the error text of a library or of the operating system.
    pub fn foreign(text: impl fmt::Display) -> Self {
        Self::Foreign(text.to_string().into())
    }

    /// Replaces each text for which `replacement` returns another one, including those in lists and sentences. Prose is not replaced.
    pub(crate) fn replace_texts(&mut self, replacement: &dyn Fn(&str) -> Option<String>) {
        let replace = |text: &mut Box<str>| {
            if let Some(new) = replacement(text) {
                *text = new.into();
            }
        };
        match self {
            Self::Quoted(text) | Self::Foreign(text) => replace(text),
            Self::List(texts) => texts.iter_mut().for_each(replace),
            Self::Sentence(sentence) => {
                sentence.arguments.iter_mut().for_each(|(_, value)| value.replace_texts(replacement));
            }
            Self::Number(_) | Self::Count(_) | Self::Point(_) | Self::Prose(_) => {}
        }
    }

    /// Returns the number of a [`Value::Number`].
    pub fn number(&self) -> Option<Number> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    fn point(&self) -> Option<Point> {
        match self {
            Self::Point(point) => Some(*point),
            _ => None,
        }
    }

    /// Renders the value for a message: on one line, with special characters escaped.
    pub fn render(&self, lang: Lang) -> String {
        match self {
            Self::Quoted(text) => escaping::line(text).into_owned(),
            Self::Number(number) => number.prose(lang),
            Self::Count(count) => count.to_string(),
            Self::Point(point) => format!("({}, {})", point.x, point.y),
            Self::List(items) if items.is_empty() => NONE.in_lang(lang).to_owned(),
            Self::List(items) => escaping::line(&items.join(", ")).into_owned(),
            Self::Prose(text) => text.in_lang(lang).to_owned(),
            Self::Sentence(sentence) => fill(sentence.text.in_lang(lang), &sentence.arguments, lang),
            Self::Foreign(text) => {
                let text = escaping::line(text);
                lang.choose(text.to_string(), format!("„{text}“"))
            }
        }
    }
}

impl From<char> for Value {
    fn from(letter: char) -> Self {
        Self::Quoted(letter.to_string().into())
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

impl From<&'static Text> for Value {
    fn from(text: &'static Text) -> Self {
        Self::Prose(text)
    }
}

impl From<Sentence> for Value {
    fn from(sentence: Sentence) -> Self {
        Self::Sentence(Box::new(sentence))
    }
}

impl<S: AsRef<str>> FromIterator<S> for Value {
    fn from_iter<I: IntoIterator<Item = S>>(items: I) -> Self {
        Self::List(items.into_iter().map(|item| item.as_ref().into()).collect())
    }
}

/// Replaces the placeholders of a template by their values. A placeholder without a value is not replaced; tests fail if that happens.
pub(crate) fn fill(template: &str, arguments: &[(&'static str, Value)], lang: Lang) -> String {
    let mut filled = String::with_capacity(template.len() + 32);
    let mut rest = template;
    while let Some(open) = rest.find('{') {
        let Some(length) = rest[open..].find('}') else { break };
        let name = &rest[open + 1..open + length];
        filled.push_str(&rest[..open]);
        match arguments.iter().find(|(argument, _)| *argument == name) {
            Some((_, Value::Number(number))) => {
                let text = number.distinct_from(arguments.iter().filter_map(|(_, value)| value.number()));
                // A number directly after a letter is a parameter or a word of G-code, for example `O2.5`.
                let is_word = filled.ends_with(|before: char| before.is_ascii_uppercase());
                filled.push_str(&if is_word { text } else { with_decimal_separator(text, lang) });
            }
            Some((_, Value::Point(point))) => {
                let others: Vec<Point> = arguments.iter().filter_map(|(_, value)| value.point()).collect();
                filled.push_str(&point.distinct_from(&others));
            }
            Some((_, value)) => filled.push_str(&value.render(lang)),
            None => {
                debug_assert!(!is_placeholder(name), "{template:?} lacks {name:?}");
                _ = write!(filled, "{{{name}}}");
            }
        }
        rest = &rest[open + length + 1..];
    }
    filled.push_str(rest);
    filled
}

/// Whether the text between two braces is the name of an argument. Messages about control texts also contain braces of control texts.
fn is_placeholder(name: &str) -> bool {
    !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'_')
}

pub(crate) fn deserialize_arguments<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Arguments, D::Error> {
    let arguments = Vec::<(&str, Value)>::deserialize(deserializer)?;
    Ok(arguments.into_iter().map(|(name, value)| (interned_str(name), value)).collect())
}
