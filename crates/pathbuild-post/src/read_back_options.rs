//! What a text is checked against before it is written. (book: program/posts, "Before a program is written")

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::verify::{Machine, Tolerance};

use crate::rs274_translation::TranslatedText;
use crate::target::Target;

/// How the words of a text are understood.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wording<'a> {
    /// As words of this control.
    Control(&'a Target),
    /// By this translation to RS274, which is checked instead of the text: no dialect defines the words, or the definition has its own axes.
    Translated(&'a TranslatedText),
}

impl<'a> Wording<'a> {
    pub(super) fn control(self) -> Option<&'a Target> {
        match self {
            Self::Control(target) => Some(target),
            Self::Translated(_) => None,
        }
    }

    pub(super) fn translation(self) -> Option<&'a TranslatedText> {
        match self {
            Self::Control(_) => None,
            Self::Translated(translated) => Some(translated),
        }
    }

    /// Returns the dialect in which the text is read.
    pub(super) fn reader(self) -> Dialect {
        self.control().map_or(Dialect::LinuxCnc, |target| target.reader)
    }
}

/// The expectations that a text is checked against.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub(super) struct ReadBackOptions<'a> {
    pub(super) wording: Wording<'a>,
    /// Permitted deviation of the moves from the job. `None` if the user takes responsibility for the moves.
    pub(super) tolerance: Option<Tolerance>,
    pub(super) machine: Option<&'a Machine>,
    /// Maximum distance in mm by which cuts may miss the outline of a part.
    pub(super) part_tolerance: f64,
    /// Whether the program need not switch the spindle, because the operator does it or the target has no word for it.
    pub(super) is_manual: bool,
    /// Whether the text never moves in Z, because a beam cuts at all depths.
    pub(super) is_for_beam: bool,
    /// Whether the texts of the definition switch the coolant as the job says.
    pub(super) follows_coolant: bool,
    /// Whether the machine counts P of dwells in milliseconds. Only for controls where this is a setting.
    pub(super) milliseconds: bool,
}
