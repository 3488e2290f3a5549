//! A text of the drawing, TEXT or MTEXT, before it is known what it belongs to.

use pathbuild_dxf::{MText, Text};

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
    /// As the drawing has it.
    pub(super) fn string(&self) -> &'d str {
        match self.text {
            AnyText::Text(text) => &text.string,
            AnyText::MText(text) => &text.plain,
        }
    }

    pub(super) fn circle(&self) -> TextCircle {
        match self.text {
            AnyText::Text(text) => TextCircle::of_text(text),
            AnyText::MText(text) => TextCircle::of_mtext(text),
        }
    }

    pub(super) fn anchor(&self) -> Xy {
        let (AnyText::Text(Text { anchor, .. }) | AnyText::MText(MText { anchor, .. })) = self.text;
        xy(*anchor)
    }

    pub(super) fn is_mtext(&self) -> bool {
        matches!(self.text, AnyText::MText(_))
    }
}
