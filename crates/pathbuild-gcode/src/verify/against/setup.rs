//! Everything that is no move: tool and its length, spindle, coordinate systems, corners, dwells.

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message, Severity};

use super::ToolUse;
use crate::dialect::Dialect;
use crate::interpret::{
    Action, Axes, Change, Corners, Move, Named, Pace, Plane, Position, Spindle, Step, ToolLength, Turning,
    WorkSystem, code_name,
};
use crate::read::Problems;

/// Corners may be rounded by so many mm: that of the built-in posts.
const CORNERS: f64 = 0.01 * (1.0 + 1e-6);

/// Heights that differ by less, in mm, are one.
const SAME_HEIGHT: f64 = 0.002;

/// Speeds that differ by less are one.
const SAME_SPEED: f64 = 0.01;

#[derive(Debug)]
pub(super) struct Setup {
    dialect: Dialect,
    clearance: f64,
    expected: ToolUse,
    spin_up: f64,
    at: Position,
    /// The tool that M6 put in.
    inserted: Option<u32>,
    /// The length that counts, and its line.
    length: Option<(ToolLength, u32)>,
    spindle: Spindle,
    spindle_line: u32,
    /// Seconds that passed since the spindle was switched on.
    running: f64,
    /// Corners are rounded by so many mm at most.
    is_limited: bool,
    /// What has been said of the state that holds.
    said: Said,
}

/// Each is said once, until the state changes.
#[derive(Debug, Default)]
struct Said {
    spindle: bool,
    length: bool,
}

impl Setup {
    pub(super) fn new(dialect: Dialect, clearance: f64, tool: ToolUse, spin_up: f64) -> Self {
        let expected = if dialect == Dialect::Native {
            // The native program names T1 and leaves the spindle to the machine's operator.
            ToolUse { number: Some(1), turning: Some(Turning::Unstated), speed: None }
        } else {
            tool
        };
        let spin_up = if dialect == Dialect::Native { 0.0 } else { spin_up };
        Self {
            dialect,
            clearance,
            expected,
            spin_up,
            at: Position::default(),
            inserted: None,
            length: None,
            spindle: Spindle { turning: Turning::Unstated, speed: 0.0 },
            spindle_line: 0,
            running: 0.0,
            is_limited: false,
            said: Said::default(),
        }
    }

    pub(super) fn step(&mut self, step: &Step, problems: &mut Problems) {
        let line = step.line;
        match &step.action {
            Action::Move(it) => self.moves(line, it, problems),
            Action::Dwell(seconds) => self.dwell(line, *seconds, problems),
            Action::SelectTool(number) => self.select(line, *number, problems),
            Action::ChangeTool(number) => {
                let number = number.unwrap_or(0);
                self.select(line, number, problems);
                self.inserted = Some(number);
            }
            Action::Spindle(spindle) => self.switch_spindle(line, *spindle, problems),
            Action::System(system) if *system != WorkSystem::default() => {
                extra(line, system.name().to_owned(), problems);
            }
            Action::Change(change) => self.change(line, *change, problems),
            _ => {}
        }
    }

    pub(super) fn finish(&mut self, problems: &mut Problems) {
        if matches!(self.spindle.turning, Turning::Clockwise | Turning::Counterclockwise) {
            extra(self.spindle_line, "M3, M4".to_owned(), problems);
        }
    }

    fn change(&mut self, line: u32, change: Change, problems: &mut Problems) {
        match change {
            Change::ToolLength(ToolLength::Other) => extra(line, "G43.1".to_owned(), problems),
            Change::ToolLength(ToolLength::OfTool(entry)) if !self.is_inserted(entry) => {
                problems.add_at_line(&say::LENGTHS_DIFFER, line, |d| d);
            }
            Change::ToolLength(length) => {
                self.length = Some((length, line));
                self.said.length = false;
            }
            Change::Offsets { code, .. } => extra(line, code_name('G', code), problems),
            Change::Corners(Corners::Rounded(Some(most))) if most <= CORNERS => self.is_limited = true,
            Change::Corners(Corners::Rounded(Some(_))) => extra(line, "G64 P".to_owned(), problems),
            Change::Corners(Corners::Rounded(None)) if self.is_limited => {
                extra(line, "G64".to_owned(), problems);
            }
            Change::Corners(_) | Change::Plane(Plane::Xy) => {}
            Change::Plane(_) => extra(line, "G18, G19".to_owned(), problems),
            Change::Parameter => extra(line, "#".to_owned(), problems),
            Change::Switch(code) => extra(line, code_name('M', code), problems),
        }
    }

    /// Whether a length is that of the tool that M6 put in.
    fn is_inserted(&self, entry: Option<u32>) -> bool {
        self.inserted.is_some_and(|tool| entry.is_none_or(|entry| entry == tool))
    }

    fn select(&mut self, line: u32, number: u32, problems: &mut Problems) {
        let expected = *self.expected.number.get_or_insert(number);
        self.said.length = false;
        if number != expected {
            problems.add_at_line(&say::TOOLS_DIFFER, line, |d| {
                d.with("found", u64::from(number)).with("expected", u64::from(expected))
            });
        }
    }

    fn switch_spindle(&mut self, line: u32, spindle: Spindle, problems: &mut Problems) {
        let is_started = spindle.turning != self.spindle.turning || spindle.speed != self.spindle.speed;
        (self.spindle, self.spindle_line) = (spindle, line);
        if is_started {
            self.running = 0.0;
            self.said.spindle = false;
        }
        // A program whose drawing leaves the spindle alone does not name it at all: S0 would stop one that runs.
        let is_left_alone = self.expected.turning == Some(Turning::Unstated);
        let is_foot =
            self.dialect != Dialect::Native && spindle.turning == Turning::Unstated && spindle.speed == 0.0;
        if is_left_alone && !is_foot {
            extra(line, "M3, M4, M5, S".to_owned(), problems);
        }
    }

    fn dwell(&mut self, line: u32, seconds: f64, problems: &mut Problems) {
        self.running += seconds;
        if self.at.known.has(Axes::Z) && self.at.z() < self.clearance - SAME_HEIGHT {
            extra(line, "G4".to_owned(), problems);
        }
    }

    fn moves(&mut self, line: u32, it: &Move, problems: &mut Problems) {
        self.at = it.to;
        if it.named == Some(Named::Machine) && !it.to.known.has(Axes::Z) && it.to.z() != 0.0 {
            extra(line, "G53 Z".to_owned(), problems);
        }
        if matches!(it.pace, Pace::Feed(_)) && !it.is_nothing() {
            self.cutting_spindle(line, problems);
            self.cutting_length(line, problems);
        }
    }

    fn cutting_spindle(&mut self, line: u32, problems: &mut Problems) {
        if self.said.spindle {
            return;
        }
        let message = if self.turns_otherwise() {
            &say::SPINDLES_DIFFER
        } else if self.running < self.spin_up && self.turns() {
            &say::SPUN_UP_TOO_SHORT
        } else {
            return;
        };
        self.said.spindle = true;
        self.spindle_differs(line, message, problems);
    }

    fn turns(&self) -> bool {
        matches!(self.spindle.turning, Turning::Clockwise | Turning::Counterclockwise)
    }

    fn turns_otherwise(&self) -> bool {
        // XpertMILL ties the spindle to its own events; the speed belongs to the layer.
        let is_tied = self.dialect == Dialect::Xpertmill;
        let turning = self.expected.turning.filter(|_| !is_tied);
        let differs = turning.is_some_and(|turning| turning != self.spindle.turning);
        let speed = self.expected.speed.filter(|_| self.expected.turning != Some(Turning::Unstated));
        differs || speed.is_some_and(|speed| libm::fabs(speed - self.spindle.speed) > SAME_SPEED)
    }

    fn spindle_differs(&self, line: u32, message: &'static Message, problems: &mut Problems) {
        let (expected, found) = (self.expected, self.spindle);
        problems.add_at_line(message, line, |d| {
            d.with("found", spindle_text(Some(found.turning), Some(found.speed)))
                .with("expected", spindle_text(expected.turning, expected.speed))
                .with("seconds", self.spin_up)
        });
    }

    /// Where M6 puts tools in, the length that counts is that of the tool in the spindle. The native program and others count none.
    fn cutting_length(&mut self, line: u32, problems: &mut Problems) {
        if self.length.is_none() && self.keeps_lengths() {
            // Said once: from here on it is as if it stood there.
            self.length = Some((ToolLength::Off, line));
            problems.add_at_line(&say::MODES_NOT_STATED, line, |d| {
                let d = d.with("words", "G49").with("taken", "G49");
                Diagnostic { severity: Severity::Error, ..d }
            });
        }
        let fits = match self.length {
            None | Some((ToolLength::Off, _)) => !self.must_count(),
            Some((ToolLength::OfTool(entry), _)) => {
                self.dialect != Dialect::Native && self.is_inserted(entry)
            }
            Some((ToolLength::Other, _)) => false,
        };
        if !fits && !std::mem::replace(&mut self.said.length, true) {
            let at = self.length.map_or(line, |(_, line)| line);
            problems.add_at_line(&say::LENGTHS_DIFFER, at, |d| d);
        }
    }

    /// Controls on which the length of the program before still counts, unless a program says otherwise.
    fn keeps_lengths(&self) -> bool {
        matches!(self.dialect, Dialect::Native | Dialect::Rs274 | Dialect::LinuxCnc | Dialect::Grbl)
    }

    /// Controls whose tools have lengths in a table.
    fn must_count(&self) -> bool {
        matches!(self.dialect, Dialect::Fanuc | Dialect::Haas | Dialect::Mach3)
    }
}

fn spindle_text(turning: Option<Turning>, speed: Option<f64>) -> String {
    let word = match turning {
        Some(Turning::Clockwise) => "M3",
        Some(Turning::Counterclockwise) => "M4",
        Some(Turning::Off) => "M5",
        Some(Turning::Unstated) | None => "",
    };
    let speed = speed.map(|speed| format!("S{}", pathbuild_diagnostic::Number(speed))).unwrap_or_default();
    [word, &speed].join(" ").trim().to_owned()
}

fn extra(line: u32, word: String, problems: &mut Problems) {
    problems.add_at_line(&say::NOT_IN_DRAWING, line, |d| d.with("word", word));
}
