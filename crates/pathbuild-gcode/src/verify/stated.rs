//! Whether the statistics in a native program's comments are what its moves come to. (book: program/gcode, "Statistics")

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Step};

use crate::native::stated_length;
use crate::read::Problems;
use crate::statistics::{Counting, Tally};

/// Lengths may differ by so many mm, because they are written without decimals and heights that probes correct move a little.
const SLACK: f64 = 1.0;

/// And by this share.
const SHARE: f64 = 0.01;

/// Holds the statistics that a program states against its moves: give it every step, then [`finish`](Self::finish) it.
#[derive(Debug, Default)]
pub struct StatedStatistics {
    counting: Counting,
    tally: Tally,
    /// Line, label, and length in mm.
    stated: Vec<(u32, String, f64)>,
}

impl StatedStatistics {
    /// The next step of the program.
    pub fn step(&mut self, step: &Step) {
        let has_length = self.counting.counts(step);
        match &step.action {
            Action::Move(it) => self.tally.add(it, has_length),
            Action::Comment(text) => {
                let stated = stated_length(text).map(|(label, length)| (step.line, label.to_owned(), length));
                self.stated.extend(stated);
            }
            _ => {}
        }
    }

    /// The lengths that are stated wrongly, by line.
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
            if libm::fabs(stated - length) > SLACK + SHARE * length {
                problems.add_at_line(&say::LENGTH_DIFFERS, line, |d| {
                    d.quoting("label", label).with("stated", stated).with("length", libm::round(length))
                });
            }
        }
        problems.into_diagnostics()
    }
}
