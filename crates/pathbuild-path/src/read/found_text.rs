//! The texts of a drawing, TEXT or MTEXT, before they are assigned.

use pathbuild_dxf::{Geometry, MText, Text};

use super::meaning::xy;
use crate::element::Source;
use crate::geometry::Xy;
use crate::text_circle::TextCircle;

/// A text of the drawing.
#[derive(Clone, Copy)]
pub(super) struct FoundText<'d> {
    pub(super) source: Source,
    pub(super) text: AnyText<'d>,
}

/// TEXT or MTEXT.
#[derive(Clone, Copy)]
pub(super) enum AnyText<'d> {
    Text(&'d Text),
    MText(&'d MText),
}

impl<'d> FoundText<'d> {
    /// The string as in the drawing.
    pub(super) fn string(&self) -> &'d str {
        self.text.string()
    }

    pub(super) fn circle(&self) -> TextCircle {
        self.text.circle()
    }

    pub(super) fn anchor(&self) -> Xy {
        self.text.anchor()
    }

    pub(super) fn is_mtext(&self) -> bool {
        matches!(self.text, AnyText::MText(_))
    }
}

impl<'d> AnyText<'d> {
    /// The text, if the entity is one.
    pub(super) fn of(geometry: &'d Geometry) -> Option<Self> {
        match geometry {
            Geometry::Text(text) => Some(Self::Text(text)),
            Geometry::MText(text) => Some(Self::MText(text)),
            Geometry::Line(_) | Geometry::Arc(_) | Geometry::Circle(_) => None,
        }
    }

    /// The string as in the drawing.
    pub(super) fn string(self) -> &'d str {
        match self {
            Self::Text(text) => &text.string,
            Self::MText(text) => &text.plain,
        }
    }

    pub(super) fn circle(self) -> TextCircle {
        match self {
            Self::Text(text) => TextCircle::of_text(text),
            Self::MText(text) => TextCircle::of_mtext(text),
        }
    }

    pub(super) fn anchor(self) -> Xy {
        let (Self::Text(Text { anchor, .. }) | Self::MText(MText { anchor, .. })) = self;
        xy(*anchor)
    }
}
