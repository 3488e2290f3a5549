//! What may not be meant in control texts, found without running them.

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, messages::posts};

use super::control_text::{ControlText, ControlTextKind};
use super::definition::Definition;
use super::expand::next_variable;
use super::fault::Fault;
use super::report::locate;
use super::variables::{KNOWN, TEXTS};

/// The doubts about a definition, and what is broken in texts that no program calls: nobody else would say it.
pub(super) fn of(definition: &Definition, file: &Utf8Path) -> Vec<Diagnostic> {
    let uncalled = |kind| {
        matches!(
            kind,
            ControlTextKind::Bezier | ControlTextKind::SubprogramStart | ControlTextKind::SubprogramEnd
        )
    };
    let broken = definition.texts().filter(|(kind, _)| uncalled(*kind));
    let broken = broken.filter_map(|(kind, text)| {
        let fault = fault(&text.text)?;
        Some(locate(fault.diagnostic, kind, text, fault.span, file))
    });
    definition.texts().flat_map(|(kind, text)| of_text(kind, text, file)).chain(broken).collect()
}

/// A variable or a brace that is not closed.
fn fault(text: &str) -> Option<Box<Fault>> {
    let mut rest = text;
    loop {
        match next_variable(rest) {
            Ok(Some((_, _, after))) => rest = after,
            Ok(None) => break,
            Err(fault) => return Some(fault.shifted(text.len() - rest.len())),
        }
    }
    let mut open = Vec::new();
    let mut characters = text.char_indices();
    while let Some((at, c)) = characters.next() {
        match c {
            '\\' => _ = characters.next(),
            '{' => open.push(at),
            '}' if open.pop().is_none() => return Some(Fault::new(&posts::LONE_BRACE, at..at + 1)),
            _ => {}
        }
    }
    open.pop().map(|at| Fault::new(&posts::OPEN_BRACE, at..at + 1))
}

fn of_text(kind: ControlTextKind, text: &ControlText, file: &Utf8Path) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    let mut statements = Statements::default();
    let mut rest = text.text.as_str();
    // A text that is broken is reported when it is run.
    while let Ok(Some((before, name, after))) = next_variable(rest) {
        let at = text.text.len() - rest.len() + before.len();
        statements.pass(before);
        let message = if statements.assigned.contains(&name) {
            Some(&posts::READ_AFTER_ASSIGNMENT)
        } else {
            (is_number(name) && statements.open.is_empty()).then_some(&posts::NUMBER_UNFORMATTED)
        };
        if let Some(message) = message {
            let diagnostic = Diagnostic::new(message).with("name", name);
            diagnostics.push(locate(diagnostic, kind, text, at..at + name.len() + 2, file));
        }
        rest = after;
    }
    diagnostics
}

fn is_number(name: &str) -> bool {
    KNOWN.contains(&name) && !TEXTS.contains(&name)
}

/// The statements that are open at a place of a text, and what those that are over assigned.
#[derive(Default)]
struct Statements<'a> {
    /// The variable that each open statement assigns, if any.
    open: Vec<Option<&'a str>>,
    assigned: Vec<&'a str>,
}

impl<'a> Statements<'a> {
    fn pass(&mut self, text: &'a str) {
        for (at, brace) in text.match_indices(['{', '}']) {
            if brace == "{" {
                self.open.push(text[at + 1..].strip_prefix('=').map(leading_name));
            } else if let Some(Some(name)) = self.open.pop() {
                self.assigned.push(name);
            }
        }
    }
}

fn leading_name(text: &str) -> &str {
    let length = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len());
    &text[..length]
}
