//! The diagnostics that the reader makes, without what only their place knows: layer, line, handle.

use pathbuild_diagnostic::messages::reading::{
    BAD_GROUP_CODE, DECIMAL_COMMA, NUMBER_NOT_FINITE, SECTION_NOT_ENDED, TRUNCATED, VALUE_NOT_A_NUMBER,
};
use pathbuild_diagnostic::{Diagnostic, Message, TextFault};

use crate::number::NotANumber;
use crate::pairs::{Pair, Stop};

/// What stops the reading of a file.
pub(crate) type Fatal = Box<Diagnostic>;

/// A value that is no number.
pub(crate) fn bad_value(entity: &str, code: i32, value: &[u8], reason: NotANumber) -> Diagnostic {
    let text = shown(value);
    let (message, fault) = match (reason, text.find(',')) {
        (NotANumber::Comma, Some(comma)) => (&DECIMAL_COMMA, comma..comma + 1),
        (NotANumber::NotFinite, _) => (&NUMBER_NOT_FINITE, 0..text.len()),
        _ => (&VALUE_NOT_A_NUMBER, 0..text.len()),
    };
    let fault = TextFault::new(&text, fault);
    Diagnostic::new(message)
        .with("entity", entity)
        .with("code", code.to_string())
        .with("value", text)
        .with_text(fault)
}

/// The pairs stop inside a section.
pub(crate) fn stopped(stop: Stop<'_>, section: &str) -> Fatal {
    Box::new(match stop {
        Stop::End { line } => Diagnostic::new(&TRUNCATED).with("section", section).at_line(line, None),
        Stop::BadCode { line, found } => bad_code(found, line),
    })
}

/// This pair stands where none of the sort may.
pub(crate) fn at_pair(message: &'static Message, pair: &Pair<'_>) -> Fatal {
    Box::new(Diagnostic::new(message).with("found", shown(pair.value)).at_line(pair.line, None))
}

/// This pair stands where the end of a section is missing.
pub(crate) fn not_ended(section: &str, found: &Pair<'_>) -> Fatal {
    let mut diagnostic = at_pair(&SECTION_NOT_ENDED, found);
    diagnostic.arguments.push(("section", section.into()));
    diagnostic
}

fn bad_code(found: &[u8], line: u32) -> Diagnostic {
    let found = shown(found);
    let fault = TextFault::new(&found, 0..found.len());
    Diagnostic::new(&BAD_GROUP_CODE).with("found", found).at_line(line, None).with_text(fault)
}

/// A value as it is shown: trimmed, cut, whatever its encoding.
pub(crate) fn shown(value: &[u8]) -> String {
    let value = value.trim_ascii();
    String::from_utf8_lossy(&value[..value.len().min(MOST_SHOWN)]).into_owned()
}

const MOST_SHOWN: usize = 60;
