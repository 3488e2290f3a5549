//! The line that is being written.

use super::registers::{Code, Register};
use super::section::Section;

/// The line that is being written.
#[derive(Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "facts that do not depend on each other")]
pub(super) struct Line {
    pub(super) text: String,
    /// The text that does not come from macros of motion codes.
    pub(super) rest: String,
    /// Whether the text added at the moment comes from such a macro.
    pub(super) is_in_code: bool,
    /// Whether a register macro was expanded.
    pub(super) asked: bool,
    /// Whether a register was written.
    pub(super) answered: bool,
    /// Registers written with reversed sign.
    pub(super) turned: Vec<Register>,
    /// The motion of a code macro in this line.
    pub(super) code: Option<Code>,
    /// Section and line of the definition's file where the line begins.
    pub(super) origin: Option<(Section, u32)>,
    /// Whether the line requires a tool number that the program does not have. Such lines are not written.
    pub(super) names_no_tool: bool,
    /// Set if something was omitted at the end of the text: whether it was preceded by blanks.
    gap: Option<bool>,
}

impl Line {
    /// Adds text without line breaks.
    pub(super) fn push(&mut self, text: &str) {
        if text.is_empty() {
            return;
        }
        let text = match self.gap.take() {
            Some(blank_before) => {
                let after = text.trim_start_matches([' ', '\t']);
                if blank_before && after.len() < text.len() {
                    self.text.push(' ');
                }
                after
            }
            None => text,
        };
        self.text.push_str(text);
        if !self.is_in_code {
            self.rest.push_str(text);
        }
    }

    /// Omits something together with the blanks around it; one blank remains if there were blanks on both sides.
    pub(super) fn leave_out(&mut self) {
        let length = self.text.trim_end_matches([' ', '\t']).len();
        self.gap = Some(length < self.text.len());
        self.text.truncate(length);
    }
}

/// Replaces runs of blanks by one blank and removes those at the ends.
pub(super) fn collapse(text: &str) -> String {
    text.split([' ', '\t', '\r']).filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
}
