//! Checks how far the control may round corners (G64 P). (book: program/reading, "Rounded corners")

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Change, Corners, Step};

/// Rounding of corners in mm that the built-in posts permit.
pub(super) const BUILT_IN_ROUNDING: f64 = 0.01;

/// Factor by which corners may be rounded more than a limit permits, because converted numbers, such as those of a program in inches, are not exact.
pub(super) const MARGIN: f64 = 1.0 + 1e-6;

/// Rule that finds cuts whose corners the control may round by more than a limit: pass every step of a program, then call
/// [`finish`](Self::finish). Only the largest rounding is reported.
#[derive(Debug)]
pub struct CornerRules {
    /// Largest permitted rounding in mm.
    limit: f64,
    /// The behaviour at corners with the line that set it; `None` until the program sets it.
    corners: Option<(u32, Corners)>,
    /// The largest rounding above the limit in mm, with the line that set it.
    largest: Option<(u32, f64)>,
    has_limit: bool,
}

impl CornerRules {
    /// Creates the rule for parts that may differ from their drawing by `part_tolerance` mm. The limit is never lower than the rounding of the
    /// built-in posts.
    pub fn new(part_tolerance: f64) -> Self {
        Self { limit: part_tolerance.max(BUILT_IN_ROUNDING), corners: None, largest: None, has_limit: true }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::Change(Change::Corners(corners)) => self.corners = Some((step.line, *corners)),
            Action::Move(motion) if motion.is_cut() => {
                self.cut();
            }
            _ => {}
        }
    }

    fn cut(&mut self) {
        match self.corners {
            // LinuxCNC treats P0 as no limit.
            Some((line, Corners::Rounded(Some(most)))) if most > 0.0 => {
                let is_largest = self.largest.is_none_or(|(_, largest)| most > largest);
                if most > self.limit * MARGIN && is_largest {
                    self.largest = Some((line, most));
                }
            }
            Some((_, Corners::Exact)) => {}
            Some((_, Corners::Rounded(_))) | None => self.has_limit = false,
        }
    }

    /// Whether the program limits the rounding of corners in all its cuts.
    pub fn has_limit(&self) -> bool {
        self.has_limit
    }

    /// Returns the finding about the largest rounding, if it exceeds the limit.
    pub fn finish(self) -> Option<Diagnostic> {
        let (line, most) = self.largest?;
        let problem = Diagnostic::new(&say::CORNERS_ROUNDED).with("most", most).with("limit", self.limit);
        Some(problem.at_line(line, None))
    }
}
