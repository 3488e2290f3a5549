//! Finds likely mistakes in control texts without running them.

use std::collections::BTreeSet;

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, messages::posts};

use super::control_text::{ControlText, ControlTextKind};
use super::definition::{Definition, Uncalled};
use super::expand::next_variable;
use super::report::locate;
use super::variables::Variable;
use crate::findings::MOST_FINDINGS;

/// Reports likely mistakes in a definition, including texts that no program calls: what they switch would never be switched.
pub(super) fn of(definition: &Definition, file: &Utf8Path) -> Vec<Diagnostic> {
    let uncalled = definition.texts().filter_map(|(kind, text)| {
        let diagnostic = match definition.called_instead(kind)? {
            Uncalled::Never => Diagnostic::new(&posts::TEXT_NEVER_CALLED),
            Uncalled::Instead(other) => {
                Diagnostic::new(&posts::TEXT_NOT_CALLED).quoting("other", other.name())
            }
        };
        Some(locate(diagnostic, kind, text, 0..text.line_around(0).1.len(), file))
    });
    uncalled.chain(definition.texts().flat_map(|(kind, text)| of_text(kind, text, file))).collect()
}

fn of_text(kind: ControlTextKind, text: &ControlText, file: &Utf8Path) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    let mut statements = Statements::default();
    let mut rest = text.text.as_str();
    // Invalid texts are reported when they are run.
    while let Ok(Some((before, name, after))) = next_variable(rest)
        && diagnostics.len() < MOST_FINDINGS
    {
        let at = text.text.len() - rest.len() + before.len();
        statements.pass(before);
        let message = if statements.assigned.contains(name) {
            Some(&posts::READ_AFTER_ASSIGNMENT)
        } else {
            (is_number(name) && statements.open.is_empty()).then_some(&posts::NUMBER_UNFORMATTED)
        };
        if let Some(message) = message {
            let diagnostic = Diagnostic::new(message).quoting("name", name);
            diagnostics.push(locate(diagnostic, kind, text, at..at + name.len() + 2, file));
        }
        rest = after;
    }
    diagnostics
}

fn is_number(name: &str) -> bool {
    Variable::named(name).is_some_and(|variable| !variable.is_text)
}

/// The statements that are open at a position of a text, and the variables assigned by those before it.
#[derive(Default)]
struct Statements<'a> {
    /// The variable assigned by each open statement, if it assigns one.
    open: Vec<Option<&'a str>>,
    assigned: BTreeSet<&'a str>,
}

impl<'a> Statements<'a> {
    fn pass(&mut self, text: &'a str) {
        for (at, brace) in text.match_indices(['{', '}']) {
            if brace == "{" {
                self.open.push(text[at + 1..].strip_prefix('=').map(leading_name));
            } else if let Some(Some(name)) = self.open.pop() {
                self.assigned.insert(name);
            }
        }
    }
}

fn leading_name(text: &str) -> &str {
    let length = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len());
    &text[..length]
}
