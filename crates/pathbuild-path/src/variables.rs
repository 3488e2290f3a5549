//! Variables: their definitions and permitted values, and the substitution of their values in texts. (book: language/variables)

use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt;

use pathbuild_diagnostic::limits::{TEXT_WITH_VALUES, bytes, limit_error};
use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use smol_str::{SmolStr, ToSmolStr};

use crate::approx::at_least;
use crate::numbers::parse_number;

/// The values bound to a path's variables, in order of their names.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Bindings(Vec<(char, SmolStr)>);

/// Substitution of values for references to variables.
pub(crate) struct Interpolation<'a> {
    pub(crate) bindings: &'a Bindings,
    /// Maximum length in bytes of a value with variables substituted.
    pub(crate) limit: usize,
    /// Variables with erroneous definitions, and therefore unknown values.
    pub(crate) unknown: &'a [char],
}

/// The reason why a value is undefined; `None` if the reason was reported with a definition.
type UndefinedReason = Option<Box<Diagnostic>>;

/// Maximum depth of references in values: more than there are letters and digits for names. Without a limit, thousands of variables would each
/// cause a pass over the whole text.
const MAX_REFERENCE_DEPTH: usize = 64;

impl Bindings {
    /// Binds names to values; the first value for a name wins.
    pub fn new(values: impl IntoIterator<Item = (char, SmolStr)>) -> Self {
        let mut values: Vec<_> = values.into_iter().collect();
        values.sort_by_key(|(name, _)| *name);
        values.dedup_by_key(|(name, _)| *name);
        Self(values)
    }

    /// Returns the example values for checking a path on its own. They depend on the position of each definition.
    pub fn check_values(definitions: &[Definition]) -> Self {
        let value = |(k, definition): (usize, &Definition)| (definition.name, definition.check_value(k));
        Self::new(definitions.iter().enumerate().map(value))
    }

    /// Returns the value of a variable; `None` if it is not bound.
    pub fn get(&self, name: char) -> Option<&str> {
        let index = self.0.binary_search_by_key(&name, |(known, _)| *known).ok()?;
        Some(&self.0[index].1)
    }

    /// Returns all names with their values, in order of name.
    pub fn iter(&self) -> impl Iterator<Item = (char, &str)> {
        self.0.iter().map(|(name, value)| (*name, value.as_str()))
    }

    /// Whether each of these variables has a value.
    pub fn has_all(&self, definitions: &[Definition]) -> bool {
        definitions.iter().all(|definition| self.get(definition.name).is_some())
    }

    /// Whether there are no bindings.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Interpolation<'_> {
    /// Replaces all references in a value repeatedly, until none are left.
    ///
    /// # Errors
    /// PB303, PB305 or PB005, without a place.
    pub(crate) fn fill<'t>(&self, value: &'t str) -> Result<Cow<'t, str>, UndefinedReason> {
        let mut filled = Cow::Borrowed(value);
        // Unless there is a cycle, each pass resolves at least one level, and there are at most as many levels as variables.
        for _ in 0..=self.bindings.0.len().min(MAX_REFERENCE_DEPTH) {
            if !filled.contains('=') {
                return Ok(filled);
            }
            filled = Cow::Owned(self.fill_once(&filled)?);
        }
        match filled.split_once('=') {
            None => Ok(filled),
            Some((_, rest)) => {
                let name = rest.chars().next().map(String::from).unwrap_or_default();
                Err(Some(self.endless_reference_error(name)))
            }
        }
    }

    /// Returns PB305 for a value in which references are left after all passes. `name` is the variable that the first of them names.
    fn endless_reference_error(&self, name: String) -> Box<Diagnostic> {
        let problem = if self.bindings.0.len() > MAX_REFERENCE_DEPTH {
            Diagnostic::new(&messages::TOO_DEEP).with("limit", MAX_REFERENCE_DEPTH)
        } else {
            Diagnostic::new(&messages::ENDLESS)
        };
        Box::new(problem.quoting("variable", name))
    }

    fn fill_once(&self, value: &str) -> Result<String, UndefinedReason> {
        let mut filled = String::with_capacity(2 * value.len());
        let mut rest = value;
        while let Some((before, after)) = rest.split_once('=') {
            let name = after.chars().next();
            // The variable's definition is invalid and was reported there; a project may still give the variable a value.
            if name.is_some_and(|name| self.unknown.contains(&name)) {
                return Err(None);
            }
            let replacement = name
                .and_then(|name| self.bindings.get(name))
                .ok_or_else(|| Some(self.undefined_variable_error(name)))?;
            filled.push_str(before);
            filled.push_str(replacement);
            if filled.len() > self.limit {
                return Err(Some(self.too_long_error()));
            }
            rest = &after[name.map_or(0, char::len_utf8)..];
        }
        filled.push_str(rest);
        Ok(filled)
    }

    fn undefined_variable_error(&self, name: Option<char>) -> Box<Diagnostic> {
        let known: Value = self.bindings.iter().map(|(name, _)| name.to_string()).collect();
        let message = if self.bindings.is_empty() {
            &messages::REFERENCE_WITHOUT_VARIABLES
        } else {
            &messages::UNKNOWN_REFERENCE
        };
        let problem =
            Diagnostic::new(message).quoting("variable", name.map(String::from).unwrap_or_default());
        Box::new(problem.with("known", known))
    }

    fn too_long_error(&self) -> Box<Diagnostic> {
        Box::new(limit_error(&TEXT_WITH_VALUES, bytes(self.limit as u64), "text-length"))
    }
}

/// A variable defined at the start of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// The variable's name, one character.
    pub name: char,
    /// The permitted values.
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
        let name =
            characters.next().ok_or_else(|| invalid_definition(&messages::INVALID_DEFINITION, value))?;
        let written = characters.as_str();
        Ok(Self { name, values: parse_allowed_values(written)?, written: written.into() })
    }

    /// Whether the variable may have this value: a number in the range, a text of the list, or one of the characters.
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

    /// Returns the first value that is in the list again; `None` if there is none.
    pub(crate) fn repeated_value(&self) -> Option<&str> {
        let AllowedValues::List(values) = &self.values else { return None };
        let mut seen = HashSet::new();
        values.iter().find(|value| !seen.insert(value.as_str())).map(SmolStr::as_str)
    }

    /// Returns the value with which a path is checked. `k` is the position of the variable in its path, so that neighbouring variables get different
    /// values.
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

/// Parses the permitted values. The order of the attempts matters: a range may contain decimal commas, and a list may begin with a question mark.
fn parse_allowed_values(written: &str) -> Result<AllowedValues, Box<Diagnostic>> {
    if let Some(range) = parse_range(written) {
        return range;
    }
    if written.contains(',') {
        let clean = written.replace('?', "");
        let values: Vec<SmolStr> = clean.split(',').map(|value| value.trim().into()).collect();
        if values.iter().any(SmolStr::is_empty) {
            return Err(invalid_definition(&messages::EMPTY_ELEMENT, written));
        }
        return Ok(AllowedValues::List(values));
    }
    match written.strip_prefix('?') {
        Some("") | None => Err(invalid_definition(&messages::INVALID_DEFINITION, written)),
        Some(characters) => Ok(AllowedValues::Characters(characters.chars().collect())),
    }
}

/// Parses a range; `None` if it is not one.
fn parse_range(written: &str) -> Option<Result<AllowedValues, Box<Diagnostic>>> {
    let (from_text, to_text) = written.split_once('~')?;
    let (from, to) = (parse_number(from_text)?, parse_number(to_text)?);
    if from > to {
        return Some(Err(invalid_definition(&messages::REVERSED_RANGE, written)));
    }
    Some(Ok(AllowedValues::Range { from, to, from_text: from_text.into(), to_text: to_text.into() }))
}

fn invalid_definition(message: &'static pathbuild_diagnostic::Message, written: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::new(message).quoting("definition", written))
}

/// Combinations of the values of a path's variables, up to a limit, and the number of all combinations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Combinations {
    /// The combinations, up to the limit, beginning with the example values. Every value of every variable occurs in one of them if the
    /// limit permits.
    pub chosen: Vec<Bindings>,
    /// The total number of combinations.
    pub all: u64,
}

impl Combinations {
    /// Combines all values of lists with both ends of ranges.
    pub fn new(definitions: &[Definition], limit: usize) -> Self {
        let values: Vec<(char, Vec<SmolStr>)> =
            definitions.iter().map(|definition| (definition.name, corners(definition))).collect();
        let counts = || values.iter().map(|(_, values)| values.len());
        let all = counts().fold(1_u64, |all, count| all.saturating_mul(count as u64));
        let longest = counts().max().unwrap_or(1);
        // Diagonal combinations first: number k takes value k + i of the i-th variable, as the example values do. Then all others in
        // counting order.
        let diagonal = (0..longest).map(|k| combination(&values, |index, count| (k + index) % count));
        let counted = (0..all).map(|number| {
            let mut rest = number;
            combination(&values, |_, count| {
                let index = rest % count as u64;
                rest /= count as u64;
                usize::try_from(index).unwrap_or_default()
            })
        });
        let mut seen = HashSet::new();
        let distinct = diagonal.chain(counted).filter(|bindings| seen.insert(bindings.clone()));
        Self { chosen: distinct.take(limit.min(usize::try_from(all).unwrap_or(limit))).collect(), all }
    }
}

/// Returns the values of a definition, without duplicates.
fn corners(definition: &Definition) -> Vec<SmolStr> {
    let mut values: Vec<SmolStr> = Vec::new();
    for value in definition.corner_values() {
        if !values.contains(&value) {
            values.push(value);
        }
    }
    values
}

/// Returns the combination in which `choose` selects the value of each variable, given the variable's index and number of values.
fn combination(values: &[(char, Vec<SmolStr>)], mut choose: impl FnMut(usize, usize) -> usize) -> Bindings {
    let value = |(index, (name, values)): (usize, &(char, Vec<SmolStr>))| {
        (*name, values[choose(index, values.len())].clone())
    };
    Bindings::new(values.iter().enumerate().map(value))
}
