//! Diagnostics of the reader. Layer, line and handle are filled in where the place is known.

use pathbuild_diagnostic::messages::reading::{
    BAD_GROUP_CODE, DECIMAL_COMMA, NUMBER_NOT_FINITE, SECTION_NOT_ENDED, TRUNCATED, VALUE_NOT_A_NUMBER,
};
use pathbuild_diagnostic::{Diagnostic, Message, TextFault, Value};

use crate::number::NotANumber;
use crate::pairs::{Pair, Stop};

/// An error that ends the reading of a file.
pub(crate) type Fatal = Box<Diagnostic>;

/// PB002: a value is not a number.
pub(crate) fn bad_value(entity: &str, code: i32, value: &[u8], reason: NotANumber) -> Diagnostic {
    let text = shown(value);
    let (message, fault) = match (reason, text.find(',')) {
        (NotANumber::Comma, Some(comma)) => (&DECIMAL_COMMA, comma..comma + 1),
        (NotANumber::NotFinite, _) => (&NUMBER_NOT_FINITE, 0..text.len()),
        _ => (&VALUE_NOT_A_NUMBER, 0..text.len()),
    };
    let fault = TextFault::new(&text, fault);
    Diagnostic::new(message)
        .quoting("entity", entity)
        .quoting("code", code.to_string())
        .quoting("value", text)
        .with_text(fault)
}

/// PB002: the file ends inside a section.
pub(crate) fn stopped(stop: Stop<'_>, section: &str) -> Fatal {
    Box::new(match stop {
        Stop::End { line } => Diagnostic::new(&TRUNCATED).quoting("section", section).at_line(line, None),
        Stop::BadCode { line, found } => bad_code(found, line),
    })
}

/// PB002: a pair where none of its kind may stand.
pub(crate) fn at_pair(message: &'static Message, pair: &Pair<'_>) -> Fatal {
    Box::new(Diagnostic::new(message).quoting("found", shown(pair.value)).at_line(pair.line, None))
}

/// PB002: a pair where the end of a section is missing.
pub(crate) fn not_ended(section: &str, found: &Pair<'_>) -> Fatal {
    let mut diagnostic = at_pair(&SECTION_NOT_ENDED, found);
    diagnostic.arguments.push(("section", Value::quoted(section)));
    diagnostic
}

fn bad_code(found: &[u8], line: u32) -> Diagnostic {
    let found = shown(found);
    let fault = TextFault::new(&found, 0..found.len());
    Diagnostic::new(&BAD_GROUP_CODE).quoting("found", found).at_line(line, None).with_text(fault)
}

/// A value for a message: trimmed, shortened, in any encoding.
pub(crate) fn shown(value: &[u8]) -> String {
    let value = value.trim_ascii();
    String::from_utf8_lossy(&value[..value.len().min(MOST_SHOWN)]).into_owned()
}

const MOST_SHOWN: usize = 60;
