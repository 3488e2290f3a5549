//! Values of variables, and their substitution in texts. (book: language/variables)

use std::borrow::Cow;

use pathbuild_diagnostic::limits::{TEXT_WITH_VALUES, bytes, exceeded};
use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use smol_str::SmolStr;

use crate::definition::Definition;
use crate::letter::Letter;
use crate::raw::RawPath;

/// The values bound to a path's variables, in order of their names.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Bindings(Vec<(char, SmolStr)>);

/// Substitutes values for references.
pub(crate) struct Interpolation<'a> {
    pub(crate) bindings: &'a Bindings,
    pub(crate) limit: usize,
    /// Variables with erroneous definitions, whose values are unknown.
    pub(crate) unknown: &'a [char],
}

/// The reason why a value is undefined; `None` if it was reported with a definition.
type Problem = Option<Box<Diagnostic>>;

/// Maximum depth of references in values. More than there are letters and digits for names; without a limit, thousands of variables would
/// each cause a pass over the whole text.
const MOST_LEVELS: usize = 64;

impl Bindings {
    /// Binds names to values; the first value for a name wins.
    pub fn new(values: impl IntoIterator<Item = (char, SmolStr)>) -> Self {
        let mut values: Vec<_> = values.into_iter().collect();
        values.sort_by_key(|(name, _)| *name);
        values.dedup_by_key(|(name, _)| *name);
        Self(values)
    }

    /// The example values for checking a path on its own; k counts the definitions from 0 as written.
    pub fn check_values(definitions: &[Definition]) -> Self {
        let value = |(k, definition): (usize, &Definition)| (definition.name, definition.check_value(k));
        Self::new(definitions.iter().enumerate().map(value))
    }

    /// The value of a variable.
    pub fn get(&self, name: char) -> Option<&str> {
        let index = self.0.binary_search_by_key(&name, |(known, _)| *known).ok()?;
        Some(&self.0[index].1)
    }

    /// All names with their values.
    pub fn iter(&self) -> impl Iterator<Item = (char, &str)> {
        self.0.iter().map(|(name, value)| (*name, value.as_str()))
    }

    /// Whether each of these variables has a value.
    pub fn cover(&self, definitions: &[Definition]) -> bool {
        definitions.iter().all(|definition| self.get(definition.name).is_some())
    }

    /// Whether there are no bindings.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl RawPath {
    /// PB302 for each variable without a value, since a path with variables cannot be emitted on its own.
    pub fn missing_values(&self, bindings: &Bindings) -> Vec<Diagnostic> {
        let missing = self.definitions.iter().filter(|definition| bindings.get(definition.name).is_none());
        let report = |definition: &Definition| {
            let problem = Diagnostic::new(&messages::MISSING_VALUE)
                .with("variable", definition.name)
                .quoting("definition", definition.to_string());
            let piece = self.parameters().pieces().iter().find(|piece| {
                piece.letter == Some(Letter::Variable)
                    && self.parameters().value(piece).starts_with(definition.name)
            });
            let problem = match piece {
                Some(piece) => problem.with_text(self.parameters().fault(piece)),
                None => problem,
            };
            self.at_parameters(problem)
        };
        missing.map(report).collect()
    }
}

impl Interpolation<'_> {
    /// Replaces all references in a value repeatedly, until none are left.
    ///
    /// # Errors
    /// PB303, PB305 or PB005, without a place.
    pub(crate) fn fill<'t>(&self, value: &'t str) -> Result<Cow<'t, str>, Problem> {
        let mut filled = Cow::Borrowed(value);
        // Unless there is a cycle, each pass resolves at least one level, and there are at most as many levels as variables.
        for _ in 0..=self.bindings.0.len().min(MOST_LEVELS) {
            if !filled.contains('=') {
                return Ok(filled);
            }
            filled = Cow::Owned(self.fill_once(&filled)?);
        }
        match filled.split_once('=') {
            None => Ok(filled),
            Some((_, rest)) => {
                let name = rest.chars().next().map(String::from).unwrap_or_default();
                Err(Some(self.endless(name)))
            }
        }
    }

    /// PB305 for the variable whose value still contains references.
    fn endless(&self, name: String) -> Box<Diagnostic> {
        let problem = if self.bindings.0.len() > MOST_LEVELS {
            Diagnostic::new(&messages::TOO_DEEP).with("limit", MOST_LEVELS)
        } else {
            Diagnostic::new(&messages::ENDLESS)
        };
        Box::new(problem.quoting("variable", name))
    }

    fn fill_once(&self, value: &str) -> Result<String, Problem> {
        let mut filled = String::with_capacity(2 * value.len());
        let mut rest = value;
        while let Some((before, after)) = rest.split_once('=') {
            let name = after.chars().next();
            let replacement =
                name.and_then(|name| self.bindings.get(name)).ok_or_else(|| self.unknown(name))?;
            filled.push_str(before);
            filled.push_str(replacement);
            if filled.len() > self.limit {
                return Err(Some(self.too_long()));
            }
            rest = &after[name.map_or(0, char::len_utf8)..];
        }
        filled.push_str(rest);
        Ok(filled)
    }

    fn unknown(&self, name: Option<char>) -> Problem {
        if name.is_some_and(|name| self.unknown.contains(&name)) {
            return None;
        }
        let known: Value = self.bindings.iter().map(|(name, _)| name.to_string()).collect();
        let problem = Diagnostic::new(&messages::UNKNOWN_REFERENCE)
            .quoting("variable", name.map(String::from).unwrap_or_default())
            .with("known", known);
        Some(Box::new(problem))
    }

    fn too_long(&self) -> Box<Diagnostic> {
        Box::new(exceeded(&TEXT_WITH_VALUES, bytes(self.limit as u64), "text-length"))
    }
}
