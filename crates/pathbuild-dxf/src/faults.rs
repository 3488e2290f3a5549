//! Diagnostics of the reader. Layer, line and handle are filled in where the place is known.

use std::sync::Arc;

use pathbuild_diagnostic::messages::drawing::{
    BAD_GROUP_CODE, DECIMAL_COMMA, GROUP_MISSING, NOT_POSITIVE, NUMBER_NOT_FINITE, SECTION_NOT_ENDED,
    TRUNCATED, VALUE_NOT_A_NUMBER, VERTEX_COUNT,
};
use pathbuild_diagnostic::{Diagnostic, EntityKind, Message, Point, TextFault, Value};
use smol_str::SmolStr;

use crate::fields::{BadGroup, Fields};
use crate::number::NotANumber;
use crate::pairs::{Pair, Stop};

/// An error that ends the reading of a file.
pub(crate) type FatalError = Box<Diagnostic>;

/// Returns PB002 for a value that is not a number.
pub(crate) fn bad_value_error(entity: &str, code: i32, value: &[u8], reason: NotANumber) -> Diagnostic {
    let text = value_excerpt(value);
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

/// Returns PB002 for a section that the end of the file cuts off, or that has something else where a group code should be.
pub(crate) fn stop_error(stop: Stop<'_>, section: &str) -> FatalError {
    Box::new(match stop {
        Stop::End { line } => Diagnostic::new(&TRUNCATED).quoting("section", section).at_line(line, None),
        Stop::BadCode { line, found } => bad_code_error(found, line),
    })
}

/// Returns PB002 for a pair that is not allowed in its place.
pub(crate) fn pair_error(message: &'static Message, pair: &Pair<'_>) -> FatalError {
    Box::new(Diagnostic::new(message).quoting("found", value_excerpt(pair.value)).at_line(pair.line, None))
}

/// Returns PB002 for a pair found where a section should end.
pub(crate) fn missing_end_error(section: &str, found: &Pair<'_>) -> FatalError {
    let mut diagnostic = pair_error(&SECTION_NOT_ENDED, found);
    diagnostic.arguments.push(("section", Value::quoted(section)));
    diagnostic
}

fn bad_code_error(found: &[u8], line: u32) -> Diagnostic {
    let found = value_excerpt(found);
    let fault = TextFault::new(&found, 0..found.len());
    Diagnostic::new(&BAD_GROUP_CODE).quoting("found", found).at_line(line, None).with_text(fault)
}

/// Formats a value for a message: trims and shortens it, whatever its encoding.
pub(crate) fn value_excerpt(value: &[u8]) -> String {
    let value = value.trim_ascii();
    String::from_utf8_lossy(&value[..value.len().min(MAX_EXCERPT_BYTES)]).into_owned()
}

const MAX_EXCERPT_BYTES: usize = 60;

#[derive(Clone, Debug)]
pub(crate) enum EntityError<'a> {
    /// A broken group: PB002.
    Group(BadGroup<'a>),
    /// An extrusion other than (0, 0, 1) or (0, 0, -1): PB110.
    Tilted,
    /// Coordinates or lengths that are too large to compute with, or a length of 0: PB002.
    TooLarge,
    /// An unsupported shape or insertion, which is left out: PB111.
    LeftOut {
        /// The message, which gives the reason.
        message: &'static Message,
        /// First point of the entity, if known.
        point: Option<Point>,
        /// The name of the block, for an insertion.
        block: Option<Box<str>>,
        /// The layers that the block draws on, for [`OmittedCurve::layers`](crate::OmittedCurve::layers).
        layers: Arc<[SmolStr]>,
    },
    /// The insertion of this block, which contains itself or is nested too deep: PB002.
    Nested(Box<str>),
    /// The insertion of this block, which the file defines twice: PB002.
    DefinedTwice(Box<str>),
    /// A layer with broken or contradictory records, so that its line type or visibility is unknown: PB002, with the line of the record.
    Layer(Box<Diagnostic>),
    /// More parts than the limit of entities: PB005, for the whole file.
    TooManyParts,
    /// A text longer than the limit: PB005, for the whole file.
    TextTooLong,
}

impl<'a> From<BadGroup<'a>> for EntityError<'a> {
    fn from(group: BadGroup<'a>) -> Self {
        Self::Group(group)
    }
}

impl<'a> EntityError<'a> {
    /// Creates the error of an entity that is left out for this reason. Its place is the entity's first point.
    pub(crate) fn omitted(message: &'static Message, fields: &Fields<'a>) -> Self {
        Self::LeftOut { message, point: first_point(fields), block: None, layers: Arc::default() }
    }
}

/// Returns the point 10/20 of an entity, or else 11/21, which is the first fit point of a spline without control points.
pub(crate) fn first_point(fields: &Fields<'_>) -> Option<Point> {
    fields.point(10).or_else(|_| fields.point(11)).ok().map(|point| Point::new(point.x, point.y))
}

impl BadGroup<'_> {
    /// Returns the diagnostic, with the line if a value is at fault.
    pub(crate) fn diagnostic(&self, kind: EntityKind) -> Diagnostic {
        let entity = kind.name();
        match self {
            Self::Missing { code } => {
                Diagnostic::new(&GROUP_MISSING).quoting("entity", entity).quoting("code", code.to_string())
            }
            Self::Number { code, value, reason } => bad_value_error(entity, *code, value.bytes, *reason)
                .at_line(value.line.saturating_add(1), None),
            Self::NotPositive { code, value } => {
                let text = value_excerpt(value.bytes);
                let fault = TextFault::new(&text, 0..text.len());
                Diagnostic::new(&NOT_POSITIVE)
                    .quoting("entity", entity)
                    .quoting("code", code.to_string())
                    .quoting("value", text)
                    .with_text(fault)
                    .at_line(value.line.saturating_add(1), None)
            }
            Self::VertexCount { value, found } => Diagnostic::new(&VERTEX_COUNT)
                .quoting("entity", entity)
                .quoting("stated", value_excerpt(value.bytes))
                .with("found", *found)
                .at_line(value.line.saturating_add(1), None),
        }
    }
}
