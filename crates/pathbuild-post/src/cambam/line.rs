//! The line that is being written.

use super::registers::{Code, Register};
use super::section::Section;

/// The line that is being written.
#[derive(Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "facts that do not depend on each other")]
pub(super) struct Line {
    pub(super) text: String,
    /// What did not come from macros of motion codes.
    pub(super) rest: String,
    /// What is added comes from such a macro.
    pub(super) is_in_code: bool,
    /// A register was asked for.
    pub(super) asked: bool,
    /// A register was written.
    pub(super) answered: bool,
    /// Registers that were written with the other sign.
    pub(super) turned: Vec<Register>,
    /// The motion that a macro stood for.
    pub(super) code: Option<Code>,
    /// The section and the line of the definition's file that begin it.
    pub(super) origin: Option<(Section, u32)>,
    /// It asks for the number of a tool where the program names none: such a line is not written.
    pub(super) names_no_tool: bool,
    /// Something was left out at the end of the text; whether blanks stood before it.
    gap: Option<bool>,
}

impl Line {
    /// Adds text without line feeds.
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

    /// Leaves something out, with the blanks round it: one stays where both neighbours had one.
    pub(super) fn leave_out(&mut self) {
        let length = self.text.trim_end_matches([' ', '\t']).len();
        self.gap = Some(length < self.text.len());
        self.text.truncate(length);
    }
}

/// One blank where there are several, none at the ends.
pub(super) fn collapse(text: &str) -> String {
    text.split([' ', '\t', '\r']).filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
}
