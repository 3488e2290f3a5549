//! Checks that the tool length in effect is that of the tool that cuts. (book: program/reading)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Change, Move, Pace, Step, ToolLength};

use crate::read::Problems;

/// Finds cuts with the length of another tool, or with none, in programs that use G43: pass every step of a program, then call
/// [`finish`](Self::finish).
#[derive(Debug, Default)]
pub struct ToolLengthRules {
    /// The tool in the spindle, as far as it is stated.
    tool: Option<u32>,
    length: LengthInEffect,
    problems: Problems,
}

/// The tool length in effect.
#[derive(Clone, Copy, Debug, Default)]
enum LengthInEffect {
    /// The program has not stated any yet, or it is a doubtful one that has been reported.
    #[default]
    Unstated,
    /// It is that of the tool in the spindle.
    OfTool,
    /// It is that of the tool before the last change.
    OfEarlierTool,
    /// The number of another tool, and the line of G43.
    OfOther(u32, u32),
    /// G49 in this line has cancelled it.
    Cancelled(u32),
}

impl ToolLengthRules {
    /// Passes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::ChangeTool(tool) => self.change(*tool),
            Action::Change(Change::ToolLength(length)) => self.length(step.line, *length),
            Action::Move(movement) if is_cut(movement) => self.cut(step.line),
            _ => {}
        }
    }

    /// Returns all problems, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        self.problems.into_diagnostics()
    }

    fn change(&mut self, tool: Option<u32>) {
        if tool != self.tool && matches!(self.length, LengthInEffect::OfTool) {
            self.length = LengthInEffect::OfEarlierTool;
        }
        self.tool = tool;
    }

    fn length(&mut self, line: u32, length: ToolLength) {
        self.length = match (length, self.tool) {
            (ToolLength::OfTool(Some(number)), Some(tool)) if number != tool => {
                LengthInEffect::OfOther(number, line)
            }
            (ToolLength::OfTool(_), _) => LengthInEffect::OfTool,
            (ToolLength::Off, _) if matches!(self.length, LengthInEffect::Unstated) => {
                LengthInEffect::Unstated
            }
            (ToolLength::Off, _) => LengthInEffect::Cancelled(line),
            (ToolLength::Other, _) => LengthInEffect::Unstated,
        };
    }

    fn cut(&mut self, line: u32) {
        let tool = u64::from(self.tool.unwrap_or_default());
        match self.length {
            LengthInEffect::Unstated | LengthInEffect::OfTool => return,
            LengthInEffect::OfEarlierTool => {
                self.problems.add_at_line(&say::LENGTH_OF_EARLIER_TOOL, line, |d| d.with("tool", tool));
            }
            LengthInEffect::OfOther(number, stated) => {
                self.problems.add_at_line(&say::LENGTH_OF_OTHER_TOOL, stated, |d| {
                    d.with("number", u64::from(number)).with("tool", tool)
                });
            }
            LengthInEffect::Cancelled(stated) => {
                self.problems
                    .add_at_line(&say::LENGTH_CANCELLED, line, |d| d.with("line", u64::from(stated)));
            }
        }
        self.length = LengthInEffect::Unstated;
    }
}

fn is_cut(movement: &Move) -> bool {
    matches!(movement.pace, Pace::Feed(_)) && !movement.is_nothing()
}
