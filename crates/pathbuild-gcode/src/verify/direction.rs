//! Checks that the spindle turns in the direction that each tool requires. (book: reference/configuration, `[tool]`)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Step, Turning};

use super::{ByTool, tool_at};

/// Rule that finds cuts during which the spindle turns against the direction of the tool, and programs that cut without ever starting the spindle:
/// pass every step of a program, then call [`finish`](Self::finish). Each tool is reported at most once.
#[derive(Debug)]
pub struct DirectionRules {
    tools: ByTool<Option<Turning>>,
    turning: Turning,
    has_speed: bool,
    /// The lines of the first cut, and of the first cut of a tool with a direction, before the program switches the spindle.
    unstarted: [Option<u32>; 2],
    found: Vec<(usize, Diagnostic)>,
}

impl DirectionRules {
    /// Creates the rule for the directions of the tools.
    pub fn new(tools: ByTool<Option<Turning>>) -> Self {
        Self { tools, turning: Turning::Unstated, has_speed: false, unstarted: [None; 2], found: Vec::new() }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::Spindle(spindle) => {
                self.turning = spindle.turning;
                self.has_speed |= spindle.speed.is_some_and(|speed| speed > 0.0);
            }
            Action::Move(motion) if motion.is_cut() => {
                self.check(step.line);
            }
            _ => {}
        }
    }

    fn check(&mut self, line: u32) {
        if self.turning == Turning::Unstated {
            self.unstarted[0].get_or_insert(line);
        }
        let Some(tool) = tool_at(&self.tools, line) else { return };
        let Some(required) = self.tools[tool].1 else { return };
        if self.turning == Turning::Unstated {
            self.unstarted[1].get_or_insert(line);
        }
        let is_known = self.found.iter().any(|(known, _)| *known == tool);
        if self.turning.is_on() && self.turning != required && !is_known {
            let (found, expected, direction) = match required {
                Turning::CounterClockwise => ("M3", "M4", "ccw"),
                _ => ("M4", "M3", "cw"),
            };
            let problem = Diagnostic::new(&say::SPINDLE_DIRECTION).quoting("direction", direction);
            let problem = problem.quoting("found", found).quoting("expected", expected);
            self.found.push((tool, problem.at_line(line, None)));
        }
    }

    /// Returns all findings about directions.
    pub fn finish(self) -> impl Iterator<Item = Diagnostic> {
        self.found.into_iter().map(|(_, problem)| problem)
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
