//! Checks whether the statistics in the comments of a native program agree with its moves. (book: program/gcode, "Statistics")

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Step};

use crate::native::stated_length;
use crate::read::Problems;
use crate::statistics::{LengthFilter, Tally};

/// Permitted difference of lengths in mm, because they are written without decimals, and correction by probes changes heights slightly.
const LENGTH_TOLERANCE: f64 = 1.0;

/// Permitted relative difference of lengths.
const RELATIVE_TOLERANCE: f64 = 0.01;

/// Comparison of the statistics stated in a program with its moves: pass every step, then call [`finish`](Self::finish).
#[derive(Debug, Default)]
pub struct StatedStatistics {
    counting: LengthFilter,
    tally: Tally,
    /// The stated lengths: line, label, and length in mm.
    stated: Vec<(u32, String, f64)>,
}

impl StatedStatistics {
    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        let has_length = self.counting.includes_length(step);
        match &step.action {
            Action::Move(movement) => self.tally.add(movement, has_length),
            Action::Comment(text) => {
                let stated = stated_length(text).map(|(label, length)| (step.line, label.to_owned(), length));
                self.stated.extend(stated);
            }
            _ => {}
        }
    }

    /// Reports the lengths stated incorrectly, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        let Tally { rapid, milling, drilling, .. } = self.tally;
        let mut problems = Problems::default();
        for (line, label, stated) in self.stated {
            let length = match crate::native::kind_of_label(&label) {
                Some(0) => milling.total.length,
                Some(1) => drilling.total.length,
                Some(2) => rapid.total.length,
                Some(3) => milling.total.length + drilling.total.length + rapid.total.length,
                _ => continue,
            };
            if libm::fabs(stated - length) > LENGTH_TOLERANCE + RELATIVE_TOLERANCE * length {
                problems.add_at_line(&say::LENGTH_DIFFERS, line, |d| {
                    d.quoting("label", label).with("stated", stated).with("length", libm::round(length))
                });
            }
        }
        problems.into_diagnostics()
    }
}
