//! The first phase of a call: every variable is replaced by its text, over the whole control text. (section 1.4)

use pathbuild_diagnostic::messages::posts;

use super::fault::{Evaluated, Fault};
use super::marks::{UNDEFINED, VARIABLE};
use super::variables::Variables;

/// Variables may name others so deep.
const MOST_DEPTH: usize = 32;
/// A call resolves at most so many variables.
const MOST_VARIABLES: usize = 10_000;
/// No line of a program is as long as this text of one call, in bytes.
const LONGEST: usize = 1 << 16;

/// A control text without variables.
#[derive(Debug, Default)]
pub(super) struct Expanded {
    pub(super) text: String,
    /// Where pieces begin, here and in the control text; between two of them the texts are the same or a variable's.
    pieces: Vec<ExpandedPart>,
    /// The variables that do not exist, by where they stood.
    undefined: Vec<(usize, String)>,
    /// How many variables were resolved.
    resolved: usize,
}

#[derive(Clone, Copy, Debug)]
struct ExpandedPart {
    here: usize,
    there: usize,
    /// The piece is a variable's text: all of it stands for one place of the control text.
    is_variable: bool,
}

impl Expanded {
    /// Replaces the variables of a control text.
    pub(super) fn new(text: &str, variables: &Variables) -> Evaluated<Self> {
        let mut expanded = Self::default();
        let mut rest = text;
        while let Some((before, name, after)) =
            next_variable(rest).map_err(|fault| fault.shifted(text.len() - rest.len()))?
        {
            let start = text.len() - rest.len() + before.len();
            let span = start..text.len() - after.len();
            expanded.begin(text.len() - rest.len(), false);
            expanded.text.push_str(before);
            expanded.begin(start, true);
            expanded.text.push(VARIABLE);
            expanded.variable(name, variables, 0).map_err(|mut fault| {
                fault.span = span;
                fault
            })?;
            rest = after;
        }
        expanded.begin(text.len() - rest.len(), false);
        expanded.text.push_str(rest);
        Ok(expanded)
    }

    fn begin(&mut self, there: usize, is_variable: bool) {
        self.pieces.push(ExpandedPart { here: self.text.len(), there, is_variable });
    }

    fn variable(&mut self, name: &str, variables: &Variables, depth: usize) -> Evaluated<()> {
        if depth == MOST_DEPTH {
            return Err(Fault::new(&posts::VARIABLE_DEPTH, 0..0)
                .quoting("name", name)
                .with("limit", MOST_DEPTH));
        }
        self.resolved += 1;
        if self.resolved > MOST_VARIABLES {
            return Err(Fault::new(&posts::TEXT_LENGTH, 0..0).with("limit", LONGEST));
        }
        let Some(value) = variables.get(name) else {
            self.undefined.push((self.text.len(), name.to_owned()));
            self.text.push(UNDEFINED);
            return Ok(());
        };
        let mut rest = value;
        while let Some((before, inner, after)) = next_variable(rest)? {
            self.push(before)?;
            self.variable(inner, variables, depth + 1)?;
            rest = after;
        }
        self.push(rest)
    }

    fn push(&mut self, text: &str) -> Evaluated<()> {
        if self.text.len() + text.len() > LONGEST {
            return Err(Fault::new(&posts::TEXT_LENGTH, 0..0).with("limit", LONGEST));
        }
        self.text.push_str(text);
        Ok(())
    }

    /// The byte of the control text that a byte of this one stands for.
    pub(super) fn origin(&self, here: usize) -> usize {
        let after = self.pieces.partition_point(|piece| piece.here <= here);
        match after.checked_sub(1).map(|index| self.pieces[index]) {
            Some(piece) if piece.is_variable => piece.there,
            Some(piece) => piece.there + (here - piece.here),
            None => here,
        }
    }

    /// The name of the variable that does not exist and stood at a byte.
    pub(super) fn undefined_at(&self, here: usize) -> &str {
        self.undefined.iter().find(|(at, _)| *at == here).map_or("", |(_, name)| name)
    }
}

/// The text before the next variable, its name, and the text after it. Escapes are passed over.
pub(super) fn next_variable(text: &str) -> Evaluated<Option<(&str, &str, &str)>> {
    let mut at = 0;
    while let Some(found) = text[at..].find(['~', '\\']) {
        at += found;
        if let Some(length) = escape_length(&text[at..]) {
            at += length;
            continue;
        }
        if text[at..].starts_with('\\') {
            at += 1;
            continue;
        }
        let inside = &text[at + 1..];
        let length = inside.find(|c: char| !is_name_character(c)).unwrap_or(inside.len());
        if !is_name(&inside[..length]) || !inside[length..].starts_with('~') {
            return Err(Fault::new(&posts::LONE_TILDE, at..at + 1));
        }
        return Ok(Some((&text[..at], &inside[..length], &inside[length + 1..])));
    }
    Ok(None)
}

/// The length of the escape at the beginning of a text, as far as it hides characters from being variables.
fn escape_length(text: &str) -> Option<usize> {
    ["\\\\\\~", "\\~", "\\{", "\\}", "\\\\"]
        .iter()
        .find(|escape| text.starts_with(**escape))
        .map(|escape| escape.len())
}

fn is_name_character(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// A letter, then letters, digits and underscores.
pub(super) fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic()) && text.chars().all(is_name_character)
}
