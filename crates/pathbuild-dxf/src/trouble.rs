//! Why a wanted entity does not become a shape.

use pathbuild_diagnostic::messages::reading::{GROUP_MISSING, NOT_POSITIVE};
use pathbuild_diagnostic::{Diagnostic, EntityKind, Message, Point, TextFault};

use crate::faults::{bad_value, shown};
use crate::fields::{BadGroup, Fields};

/// What is wrong with an entity.
#[derive(Clone, Debug)]
pub(crate) enum Trouble<'a> {
    /// It is broken: PB002.
    Group(BadGroup<'a>),
    /// Its extrusion is neither (0, 0, 1) nor (0, 0, -1): PB110.
    Tilted,
    /// Its numbers are beyond what can be computed with: PB002.
    TooLarge,
    /// It is nothing that can be milled: PB111.
    LeftOut {
        /// Why.
        message: &'static Message,
        /// Where it begins.
        point: Option<Point>,
        /// The block, if it is an insertion.
        block: Option<Box<str>>,
    },
    /// The insertion of a block, of this name, that contains itself or is nested too deep: PB002.
    Nested(Box<str>),
    /// It has more parts than the limit of entities: PB005, for the whole file.
    TooManyParts,
    /// A text is longer than the limit: PB005, for the whole file.
    TextTooLong,
}

impl<'a> From<BadGroup<'a>> for Trouble<'a> {
    fn from(group: BadGroup<'a>) -> Self {
        Self::Group(group)
    }
}

impl<'a> Trouble<'a> {
    /// It is left out for this reason; it begins at the point in 10/20, if it has one.
    pub(crate) fn left_out(message: &'static Message, fields: &Fields<'a>) -> Self {
        let point = fields.point(10).ok().map(|point| Point::new(point.x, point.y));
        Self::LeftOut { message, point, block: None }
    }
}

impl BadGroup<'_> {
    /// Says so, with the line if it is that of a value.
    pub(crate) fn diagnostic(&self, kind: EntityKind) -> Diagnostic {
        let entity = kind.name();
        match self {
            Self::Missing { code } => {
                Diagnostic::new(&GROUP_MISSING).with("entity", entity).with("code", code.to_string())
            }
            Self::Number { code, value, reason } => {
                bad_value(entity, *code, value.bytes, *reason).at_line(value.line.saturating_add(1), None)
            }
            Self::NotPositive { code, value } => {
                let text = shown(value.bytes);
                let fault = TextFault::new(&text, 0..text.len());
                Diagnostic::new(&NOT_POSITIVE)
                    .with("entity", entity)
                    .with("code", code.to_string())
                    .with("value", text)
                    .with_text(fault)
                    .at_line(value.line.saturating_add(1), None)
            }
        }
    }
}
