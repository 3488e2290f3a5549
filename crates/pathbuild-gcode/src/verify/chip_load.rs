//! Checks the chip load of a program against the limits of its tools. (book: reference/configuration, `[tool]`)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::{Action, ChipLoad, Pace, Step, Turning};

/// Rule that finds chip loads outside the limits of the tools: pass every step of a program, then call [`finish`](Self::finish). Each tool is
/// reported at most once for too small and once for too large a chip load.
#[derive(Debug)]
pub struct ChipLoadRules {
    /// The limits of the tools, each with the line from which it cuts, in the order of the lines.
    tools: Vec<(u32, Option<ChipLoad>)>,
    /// The spindle speed in 1/min that the program has set; `None` if it has set none.
    speed: Option<f64>,
    found: Vec<(usize, Diagnostic)>,
}

impl ChipLoadRules {
    /// Creates the rule for tools, each with the line from which it cuts, in the order of the lines.
    pub fn new(tools: Vec<(u32, Option<ChipLoad>)>) -> Self {
        Self { tools, speed: None, found: Vec::new() }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::Spindle(spindle) => {
                self.speed = match spindle.turning {
                    Turning::Off => Some(0.0),
                    _ => spindle.speed.filter(|speed| *speed > 0.0),
                };
            }
            Action::Move(motion) => {
                let Pace::Feed(feed) = motion.pace else { return };
                // Moves that change the height are not checked, because feeds into the material are lower on purpose.
                if feed > 0.0 && motion.axis_shares()[2] == 0.0 && motion.length() > 0.0 {
                    self.check(step.line, feed);
                }
            }
            _ => {}
        }
    }

    fn check(&mut self, line: u32, feed: f64) {
        let Some(tool) = self.tools.partition_point(|(from, _)| *from <= line).checked_sub(1) else { return };
        let Some(problem) = self.tools[tool].1.and_then(|limits| limits.check(feed, self.speed)) else {
            return;
        };
        let is_known =
            |(known, other): &(usize, Diagnostic)| *known == tool && other.message.key == problem.message.key;
        if !self.found.iter().any(is_known) {
            self.found.push((tool, problem.at_line(line, None)));
        }
    }

    /// Returns all findings.
    pub fn finish(self) -> impl Iterator<Item = Diagnostic> {
        self.found.into_iter().map(|(_, problem)| problem)
    }
}
