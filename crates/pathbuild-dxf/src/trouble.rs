//! Why a wanted entity has no shape.

use pathbuild_diagnostic::messages::reading::{GROUP_MISSING, NOT_POSITIVE};
use pathbuild_diagnostic::{Diagnostic, EntityKind, Message, Point, TextFault};

use crate::faults::{bad_value, shown};
use crate::fields::{BadGroup, Fields};

/// A fault of an entity.
#[derive(Clone, Debug)]
pub(crate) enum EntityError<'a> {
    /// A broken group: PB002.
    Group(BadGroup<'a>),
    /// An extrusion other than (0, 0, 1) or (0, 0, -1): PB110.
    Tilted,
    /// Coordinates too large to compute with: PB002.
    TooLarge,
    /// A shape that cannot be milled: PB111.
    LeftOut {
        /// The reason.
        message: &'static Message,
        /// Its first point, if known.
        point: Option<Point>,
        /// The name of the block, for an insertion.
        block: Option<Box<str>>,
    },
    /// The insertion of this block, which contains itself or is nested too deep: PB002.
    Nested(Box<str>),
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
    /// Leaves an entity out for this reason; its point is 10/20, if present.
    pub(crate) fn left_out(message: &'static Message, fields: &Fields<'a>) -> Self {
        Self::LeftOut { message, point: first_point(fields), block: None }
    }
}

/// The point 10/20 of an entity, if present.
pub(crate) fn first_point(fields: &Fields<'_>) -> Option<Point> {
    fields.point(10).ok().map(|point| Point::new(point.x, point.y))
}

impl BadGroup<'_> {
    /// The diagnostic, with the line if a value is at fault.
    pub(crate) fn diagnostic(&self, kind: EntityKind) -> Diagnostic {
        let entity = kind.name();
        match self {
            Self::Missing { code } => {
                Diagnostic::new(&GROUP_MISSING).quoting("entity", entity).quoting("code", code.to_string())
            }
            Self::Number { code, value, reason } => {
                bad_value(entity, *code, value.bytes, *reason).at_line(value.line.saturating_add(1), None)
            }
            Self::NotPositive { code, value } => {
                let text = shown(value.bytes);
                let fault = TextFault::new(&text, 0..text.len());
                Diagnostic::new(&NOT_POSITIVE)
                    .quoting("entity", entity)
                    .quoting("code", code.to_string())
                    .quoting("value", text)
                    .with_text(fault)
                    .at_line(value.line.saturating_add(1), None)
            }
        }
    }
}
