//! Checks the chip load of a program against the limits of its tools. (book: reference/configuration, `[tool]`)

use std::collections::BTreeSet;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::{Action, ChipLoad, Pace, Step, Turning};

use super::{ByTool, tool_at};
use crate::read::Problems;

/// Rule that finds chip loads outside the limits of the tools: pass every step of a program, then call [`finish`](Self::finish). A feed is
/// reported at its first cut, once for each tool and each speed.
#[derive(Debug)]
pub struct ChipLoadRules {
    tools: ByTool<Option<ChipLoad>>,
    /// The spindle speed in 1/min that the program has set: 0 if it has stopped the spindle, `None` if it has set no speed.
    speed: Option<f64>,
    /// The tool, the feed and the speed of the last cut, which need not be checked again.
    last: Option<CutKey>,
    reported: BTreeSet<CutKey>,
    problems: Problems,
}

/// Tool, feed and speed of a cut, as bits.
type CutKey = (usize, u64, Option<u64>);

impl ChipLoadRules {
    /// Creates the rule for the limits of the tools.
    pub fn new(tools: ByTool<Option<ChipLoad>>) -> Self {
        Self { tools, speed: None, last: None, reported: BTreeSet::new(), problems: Problems::default() }
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
                if feed > 0.0 && motion.axis_speed_fractions()[2] == 0.0 && motion.length() > 0.0 {
                    self.check(step, feed);
                }
            }
            _ => {}
        }
    }

    fn check(&mut self, step: &Step, feed: f64) {
        let Some(tool) = tool_at(&self.tools, step.order) else { return };
        let cut = (tool, feed.to_bits(), self.speed.map(f64::to_bits));
        if self.last.replace(cut) == Some(cut) {
            return;
        }
        let Some(problem) = self.tools[tool].1.and_then(|limits| limits.check(feed, self.speed)) else {
            return;
        };
        if self.reported.insert(cut) {
            self.problems.add_at_line(problem.message, step.line, |_| problem);
        }
    }

    /// Returns all findings, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        self.problems.into_diagnostics()
    }
}
