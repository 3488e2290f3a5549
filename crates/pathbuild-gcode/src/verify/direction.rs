//! Checks that the spindle turns in the direction that each tool requires. (book: reference/configuration, `[tool]`)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Step, Turning};

use super::{ByTool, tool_at};
use crate::read::Problems;

/// Rule that finds cuts during which the spindle turns against the direction of the tool, and programs that cut without ever starting the spindle:
/// pass every step of a program, then call [`finish`](Self::finish). Each tool is reported at most once.
#[derive(Debug, Default)]
pub struct DirectionRules {
    tools: ByTool<Option<Turning>>,
    turning: Turning,
    has_speed: bool,
    /// The lines of the first cut, and of the first cut of a tool with a direction, before the program switches the spindle.
    unstarted: [Option<u32>; 2],
    /// The last tool that was reported.
    reported: Option<usize>,
    problems: Problems,
}

impl DirectionRules {
    /// Creates the rule for the directions of the tools.
    pub fn new(tools: ByTool<Option<Turning>>) -> Self {
        Self { tools, ..Self::default() }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::Spindle(spindle) => {
                self.turning = spindle.turning;
                self.has_speed |= spindle.speed.is_some_and(|speed| speed > 0.0);
            }
            Action::Move(motion) if motion.is_cut() => {
                self.check(step);
            }
            _ => {}
        }
    }

    fn check(&mut self, step: &Step) {
        if self.turning == Turning::Unstated {
            self.unstarted[0].get_or_insert(step.line);
        }
        let Some(tool) = tool_at(&self.tools, step.order) else { return };
        let Some(required) = self.tools[tool].1 else { return };
        if self.turning == Turning::Unstated {
            self.unstarted[1].get_or_insert(step.line);
        }
        if self.turning.is_on() && self.turning != required && self.reported.replace(tool) != Some(tool) {
            let (found, expected, direction) = match required {
                Turning::CounterClockwise => ("M3", "M4", "ccw"),
                _ => ("M4", "M3", "cw"),
            };
            self.problems.add_at_line(&say::SPINDLE_DIRECTION, step.line, |d| {
                d.quoting("direction", direction).quoting("found", found).quoting("expected", expected)
            });
        }
    }

    /// Returns all findings about directions, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        self.problems.into_diagnostics()
    }

    /// Reports a program that cuts but never switches the spindle, although the direction of a tool or an S shows that it should. Only for programs
    /// in dialects that can switch the spindle. (A spindle that is switched later is reported by [`Rules`](super::Rules).)
    pub fn never_started_finding(&self) -> Option<Diagnostic> {
        if self.turning != Turning::Unstated {
            return None;
        }
        let of_table =
            self.unstarted[1].map(|line| Diagnostic::new(&say::SPINDLE_NEVER_STARTED).at_line(line, None));
        let of_speed = || {
            let line = self.unstarted[0].filter(|_| self.has_speed)?;
            Some(Diagnostic::new(&say::SPINDLE_SPEED_WITHOUT_START).at_line(line, None))
        };
        of_table.or_else(of_speed)
    }
}
