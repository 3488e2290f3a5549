//! Definitions of variables: their permitted values, and the values for checking. (book: language/variables)

use std::fmt;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;
use smol_str::{SmolStr, ToSmolStr};

use crate::approx::at_least;
use crate::number::parse_number;

/// A variable defined at the start of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// Its name, one character.
    pub name: char,
    /// Its permitted values.
    pub values: AllowedValues,
    written: SmolStr,
}

/// The values that a definition permits.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the ends as written and as numbers")]
pub enum AllowedValues {
    /// `-0.5~1,2`: numbers in a range that includes both ends.
    Range { from: f64, to: f64, from_text: SmolStr, to_text: SmolStr },
    /// `P1,P2,P3`: exactly these texts.
    List(Vec<SmolStr>),
    /// `?PQRS`: exactly one of these characters.
    Characters(Vec<char>),
}

impl Definition {
    /// Parses the `:` piece of a path's start: a name, followed by the permitted values.
    ///
    /// # Errors
    /// PB301, without a place.
    pub fn parse(value: &str) -> Result<Self, Box<Diagnostic>> {
        let mut characters = value.chars();
        let name = characters.next().ok_or_else(|| invalid(&messages::INVALID_DEFINITION, value))?;
        let written = characters.as_str();
        Ok(Self { name, values: allowed(written)?, written: written.into() })
    }

    /// Whether a value is permitted.
    pub fn allows(&self, value: &str) -> bool {
        match &self.values {
            AllowedValues::Range { from, to, .. } => {
                parse_number(value).is_some_and(|number| at_least(number, *from) && at_least(*to, number))
            }
            AllowedValues::List(values) => values.iter().any(|allowed| allowed == value),
            AllowedValues::Characters(characters) => {
                let mut value = value.chars();
                value.next().is_some_and(|character| characters.contains(&character))
                    && value.next().is_none()
            }
        }
    }

    /// The example value for checking, if the variable is the `k`-th of its path.
    pub fn check_value(&self, k: usize) -> SmolStr {
        match &self.values {
            AllowedValues::Range { from_text, .. } if k.is_multiple_of(2) => from_text.clone(),
            AllowedValues::Range { to_text, .. } => to_text.clone(),
            AllowedValues::List(values) => values[k % values.len()].clone(),
            AllowedValues::Characters(characters) => characters[k % characters.len()].to_smolstr(),
        }
    }

    /// The values that `check --all-bindings` uses: all values of a list, both ends of a range.
    pub fn corner_values(&self) -> Vec<SmolStr> {
        match &self.values {
            AllowedValues::Range { .. } => vec![self.check_value(0), self.check_value(1)],
            AllowedValues::List(values) => values.clone(),
            AllowedValues::Characters(characters) => characters.iter().map(ToSmolStr::to_smolstr).collect(),
        }
    }
}

/// The definition as written at the path's start.
impl fmt::Display for Definition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written)
    }
}

/// Tries the forms in this order: a range may contain decimal commas, and a list may begin with a question mark.
fn allowed(written: &str) -> Result<AllowedValues, Box<Diagnostic>> {
    if let Some(range) = range(written) {
        return range;
    }
    if written.contains(',') {
        let clean = written.replace('?', "");
        let values: Vec<SmolStr> = clean.split(',').map(|value| value.trim().into()).collect();
        if values.iter().any(SmolStr::is_empty) {
            return Err(invalid(&messages::EMPTY_ELEMENT, written));
        }
        return Ok(AllowedValues::List(values));
    }
    match written.strip_prefix('?') {
        Some("") => Err(invalid(&messages::EMPTY_ELEMENT, written)),
        Some(characters) => Ok(AllowedValues::Characters(characters.chars().collect())),
        None => Err(invalid(&messages::INVALID_DEFINITION, written)),
    }
}

/// Parses a range; `None` if it is not one.
fn range(written: &str) -> Option<Result<AllowedValues, Box<Diagnostic>>> {
    let (from_text, to_text) = written.split_once('~')?;
    let (from, to) = (parse_number(from_text)?, parse_number(to_text)?);
    if from > to {
        return Some(Err(invalid(&messages::REVERSED_RANGE, written)));
    }
    Some(Ok(AllowedValues::Range { from, to, from_text: from_text.into(), to_text: to_text.into() }))
}

fn invalid(message: &'static pathbuild_diagnostic::Message, written: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::new(message).quoting("definition", written))
}
