//! Checks the direction in which the spindle turns against those of the tools. (book: reference/configuration, `[tool]`)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Pace, Step, Turning};

/// Finds cuts during which the spindle turns against the direction of the tool: pass every step of a program, then call
/// [`finish`](Self::finish). Each tool is reported at most once.
#[derive(Debug)]
pub struct DirectionRules {
    /// The directions of the tools, each with the line from which it cuts, in the order of the lines.
    tools: Vec<(u32, Option<Turning>)>,
    turning: Turning,
    found: Vec<(usize, Diagnostic)>,
}

impl DirectionRules {
    /// Rules for tools, each with the line from which it cuts, in the order of the lines.
    pub fn new(tools: Vec<(u32, Option<Turning>)>) -> Self {
        Self { tools, turning: Turning::Unstated, found: Vec::new() }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::Spindle(spindle) => self.turning = spindle.turning,
            Action::Move(motion) if matches!(motion.pace, Pace::Feed(_)) && !motion.is_nothing() => {
                self.check(step.line);
            }
            _ => {}
        }
    }

    fn check(&mut self, line: u32) {
        let Some(tool) = self.tools.partition_point(|(from, _)| *from <= line).checked_sub(1) else { return };
        let Some(wanted) = self.tools[tool].1 else { return };
        let is_known = self.found.iter().any(|(known, _)| *known == tool);
        if self.turning.is_on() && self.turning != wanted && !is_known {
            let (found, expected, direction) = match wanted {
                Turning::CounterClockwise => ("M3", "M4", "ccw"),
                _ => ("M4", "M3", "cw"),
            };
            let problem = Diagnostic::new(&say::SPINDLE_DIRECTION).quoting("direction", direction);
            let problem = problem.quoting("found", found).quoting("expected", expected);
            self.found.push((tool, problem.at_line(line, None)));
        }
    }

    /// Returns all findings.
    pub fn finish(self) -> impl Iterator<Item = Diagnostic> {
        self.found.into_iter().map(|(_, problem)| problem)
    }
}
