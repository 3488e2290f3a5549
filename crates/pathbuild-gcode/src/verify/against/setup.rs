//! Checks everything besides the moves: initial modes, tool and tool length, spindle, coolant, corners, dwells.

use std::collections::BTreeMap;

use pathbuild_diagnostic::Message;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{
    Action, Axes, Change, Coolant, Corners, Group, Move, NamedPosition, Pace, Plane, Position, Spindle,
    StatedWord, Step, ToolLength, Turning,
};

use super::ToolUse;
use crate::dialect::Dialect;
use crate::interpret::code_name;
use crate::read::Problems;
use crate::verify::corners::{BUILT_IN_ROUNDING, MARGIN};
use crate::verify::rules::HEIGHT_TOLERANCE;
use crate::verify::tool_state::{LengthFit, ToolState};
use crate::verify::words::PostWords;

/// Tolerance in 1/min within which speeds are equal.
const SPEED_TOLERANCE: f64 = 0.01;

#[derive(Debug)]
pub(super) struct Setup<'w> {
    dialect: Dialect,
    words: &'w PostWords,
    /// The height in mm from which the program may wait.
    lowest_wait: f64,
    expected: ToolUse,
    spin_up: f64,
    at: Position,
    /// Words that the post writes before the first move and that the program has not contained yet.
    missing: BTreeMap<Group, u16>,
    tools: ToolState,
    coolant: Coolant,
    coolant_line: u32,
    /// Whether the program has switched coolant on although the drawing does not say whether it must.
    has_uncompared_coolant: bool,
    /// The control's behaviour at corners, if the program has specified it.
    corners: Option<Corners>,
    spindle_line: u32,
    /// The line of the last step.
    line: u32,
    /// Time in seconds that the program has dwelt since it last changed the state of the spindle.
    dwelt: f64,
    reported: ReportedFaults,
    problems: Problems,
}

/// Problems that have been reported. Each is reported once, until the state changes.
#[derive(Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
struct ReportedFaults {
    spindle: bool,
    length: bool,
    /// Whether it was reported that the program sets no length.
    no_length: bool,
    tool: bool,
    coolant: bool,
    corners: bool,
}

impl<'w> Setup<'w> {
    pub(super) fn new(
        dialect: Dialect,
        words: &'w PostWords,
        lowest_wait: f64,
        tool: ToolUse,
        spin_up: f64,
    ) -> Self {
        let expected = if dialect == Dialect::Native {
            // The native program contains T1 and leaves switching the spindle to the operator.
            ToolUse { number: Some(1), turning: Some(Turning::Unstated), speed: None, coolant: None }
        } else {
            tool
        };
        let spin_up = if dialect == Dialect::Native || words.leaves_spin_up { 0.0 } else { spin_up };
        let missing = words.lead.clone();
        Self {
            dialect,
            words,
            missing,
            tools: ToolState::new(dialect),
            coolant: Coolant::default(),
            coolant_line: 0,
            has_uncompared_coolant: false,
            corners: None,
            lowest_wait,
            expected,
            spin_up,
            at: Position::default(),
            spindle_line: 0,
            line: 0,
            dwelt: 0.0,
            reported: ReportedFaults::default(),
            problems: Problems::default(),
        }
    }

    pub(super) fn step(&mut self, step: &Step) {
        let line = step.line;
        self.line = line;
        let spindle_before = self.tools.spindle();
        self.tools.step(step);
        match &step.action {
            Action::Move(movement) => self.check_move(line, movement),
            Action::Dwell(seconds) => self.check_dwell(line, *seconds),
            Action::Stop { optional } if self.is_low() => {
                let word = if *optional { "M1" } else { "M0" };
                self.report_extra_word(line, word.to_owned());
            }
            Action::Word(StatedWord { group: Some(group), .. }) => _ = self.missing.remove(group),
            Action::SelectTool(number) => self.check_selected_tool(line, *number),
            Action::ChangeTool(number) => {
                let number = number.unwrap_or(0);
                self.check_selected_tool(line, number);
                if self.has_post() && !self.words.has('M', 60) {
                    self.report_extra_word(line, "M6".to_owned());
                }
            }
            Action::Spindle(spindle) => self.switch_spindle(line, spindle_before, *spindle),
            Action::Coolant(coolant) => {
                (self.coolant, self.coolant_line) = (*coolant, line);
                self.reported.coolant = false;
                if coolant.is_on() && !self.may_use_coolant() {
                    self.report_extra_word(line, coolant_text(*coolant).to_owned());
                } else if coolant.is_on() {
                    self.has_uncompared_coolant |= self.expected.coolant.is_none();
                }
            }
            Action::Change(change) => self.check_change(line, *change),
            _ => {}
        }
    }

    /// Returns the findings at the end of the program.
    pub(super) fn finish(mut self) -> Problems {
        if self.is_spindle_on() {
            if self.expected.turning.is_some_and(Turning::is_on) {
                self.problems.add_at_line(&say::STOP_MISSING, self.line, |d| d.quoting("word", "M5"));
            } else {
                let word = spindle_text(Some(self.tools.spindle().turning), None);
                self.report_extra_word(self.spindle_line, word);
            }
        }
        if self.coolant != Coolant::default() && self.may_use_coolant() {
            if self.expected.coolant.is_some_and(|expected| expected != Coolant::default()) {
                self.problems.add_at_line(&say::STOP_MISSING, self.line, |d| d.quoting("word", "M9"));
            } else {
                self.report_extra_word(self.coolant_line, coolant_text(self.coolant).to_owned());
            }
        }
        self.problems
    }

    fn report_extra_word(&mut self, line: u32, word: String) {
        self.problems.add_at_line(&say::NOT_IN_DRAWING, line, |d| d.quoting("word", word));
    }

    fn check_change(&mut self, line: u32, change: Change) {
        match change {
            Change::ToolLength(ToolLength::Other(code)) => {
                self.report_extra_word(line, code_name('G', code));
            }
            Change::ToolLength(ToolLength::OfTool(_)) if self.tools.length_fit() != LengthFit::Fits => {
                self.reported.length = true;
                self.problems.add_at_line(&say::LENGTHS_DIFFER, line, |d| d);
            }
            Change::ToolLength(_) => self.reported.length = false,
            Change::Offsets { code, .. } => self.report_extra_word(line, code_name('G', code)),
            Change::Corners(corners) => {
                self.corners = Some(corners);
                match corners {
                    // G64 P0 sets no limit, as if there were no P.
                    Corners::Rounded(Some(most)) if !(most > 0.0 && most <= BUILT_IN_ROUNDING * MARGIN) => {
                        self.report_extra_word(line, "G64 P".to_owned());
                    }
                    Corners::Rounded(None) if self.words.rounds_freely => {}
                    Corners::Rounded(None) => self.report_extra_word(line, "G64".to_owned()),
                    Corners::Rounded(Some(_)) | Corners::Exact => {}
                }
            }
            Change::RapidFeed(feed) => {
                let most = self.words.rapid_feed.unwrap_or(f64::INFINITY);
                if feed == 0.0 {
                    self.problems.add_at_line(&say::MODE_MISSING, line, |d| d.quoting("word", "F"));
                } else if feed > most + SPEED_TOLERANCE {
                    self.report_extra_word(line, "G0 F".to_owned());
                }
            }
            Change::Plane(Plane::Xy) | Change::Switch(_) => {}
            Change::Plane(Plane::Zx) => self.report_extra_word(line, "G18".to_owned()),
            Change::Plane(Plane::Yz) => self.report_extra_word(line, "G19".to_owned()),
            Change::Parameter => self.report_extra_word(line, "#".to_owned()),
        }
    }

    fn check_selected_tool(&mut self, line: u32, number: u32) {
        if !self.words.chooses_tools && self.has_post() {
            return self.report_extra_word(line, "T".to_owned());
        }
        let expected = *self.expected.number.get_or_insert(number);
        self.reported.length = false;
        if number != expected {
            self.problems.add_at_line(&say::TOOLS_DIFFER, line, |d| {
                d.with("found", u64::from(number)).with("expected", u64::from(expected))
            });
        }
    }

    fn switch_spindle(&mut self, line: u32, before: Spindle, spindle: Spindle) {
        self.spindle_line = line;
        if spindle != before {
            self.dwelt = 0.0;
            self.reported.spindle = false;
        }
        // If the drawing does not control the spindle, the program must not mention it at all: even a speed of 0 would stop a running spindle.
        let is_left_alone = self.expected.turning == Some(Turning::Unstated);
        let is_foot = self.dialect != Dialect::Native
            && spindle.turning == Turning::Unstated
            && spindle.speed.unwrap_or_default() == 0.0;
        if is_left_alone && !is_foot {
            self.report_extra_word(line, spindle_text(Some(spindle.turning), spindle.speed));
        }
    }

    fn check_dwell(&mut self, line: u32, seconds: f64) {
        self.dwelt += seconds;
        if self.is_low() {
            self.report_extra_word(line, "G4".to_owned());
        }
    }

    /// Whether the tool is below the height from which the program may wait.
    fn is_low(&self) -> bool {
        self.at.known.has(Axes::Z) && self.at.z() < self.lowest_wait - HEIGHT_TOLERANCE
    }

    fn check_move(&mut self, line: u32, movement: &Move) {
        // Only the machine knows the height at which a probe has stopped. A program may wait there: nothing turns in the material.
        self.at = if matches!(movement.pace, Pace::Probe { .. }) { Position::default() } else { movement.to };
        self.check_setup_words(line);
        if matches!(movement.named, Some(NamedPosition::Machine(_)))
            && !movement.to.known.has(Axes::Z)
            && movement.to.z() != 0.0
        {
            self.report_extra_word(line, "G53 Z".to_owned());
        }
        if movement.pace != Pace::Rapid && !movement.is_standstill() {
            self.check_cutting_tool(line);
            self.check_cutting_length(line);
        }
        if movement.is_cut() {
            self.check_cutting_spindle(line);
            self.check_cutting_coolant(line);
            self.check_cutting_corners(line);
        }
    }

    /// Whether pathbuild has a post that writes programs for this dialect.
    fn has_post(&self) -> bool {
        !self.words.lead.is_empty()
    }

    /// Reports the words that the post writes before the first move and the program lacks.
    fn check_setup_words(&mut self, line: u32) {
        for code in std::mem::take(&mut self.missing).into_values() {
            self.problems.add_at_line(&say::MODE_MISSING, line, |d| d.quoting("word", code_name('G', code)));
        }
    }

    /// Checks that the selected tool or layer is that of the drawing.
    fn check_cutting_tool(&mut self, line: u32) {
        // If the post inserts its tool by M6, T alone only selects the next tool.
        let chosen = self.tools.inserted().or(self.tools.selected().filter(|_| !self.words.has('M', 60)));
        // On XpertMILL, the layer takes the place of the tool. On other controls, a wrong tool has already been reported where it was selected.
        let fits = |chosen| {
            !self.dialect.rules().layers || self.expected.number.is_none_or(|number| number == chosen)
        };
        let is_chosen = chosen.is_some_and(fits);
        if !is_chosen && self.words.chooses_tools && !std::mem::replace(&mut self.reported.tool, true) {
            let expected = self.expected.number.map_or("T".to_owned(), |number| format!("T{number}"));
            self.problems.add_at_line(&say::TOOL_NOT_CHOSEN, line, |d| d.quoting("expected", expected));
        }
    }

    /// Whether programs of the post may switch coolant on; any program of a dialect that no post writes may.
    fn may_use_coolant(&self) -> bool {
        !self.has_post() || self.words.has('M', 70) || self.words.has('M', 80)
    }

    /// Whether the program switches coolant on although it is unknown whether the program must do so.
    pub(super) fn has_uncompared_coolant(&self) -> bool {
        self.has_uncompared_coolant
    }

    fn check_cutting_coolant(&mut self, line: u32) {
        let differs = |expected: &Coolant| *expected != self.coolant && self.may_use_coolant();
        let Some(expected) = self.expected.coolant.filter(differs) else { return };
        if !std::mem::replace(&mut self.reported.coolant, true) {
            let found = coolant_text(self.coolant);
            self.problems.add_at_line(&say::COOLANT_DIFFERS, line, |d| {
                d.quoting("found", found).quoting("expected", coolant_text(expected))
            });
        }
    }

    /// Checks that the program sets the behaviour at corners if the post does, because a control otherwise keeps that of the previous program.
    fn check_cutting_corners(&mut self, line: u32) {
        let is_stated = self.corners.is_some() || !self.words.has('G', 640);
        if !is_stated && !std::mem::replace(&mut self.reported.corners, true) {
            self.problems.add_at_line(&say::MODE_MISSING, line, |d| d.quoting("word", "G64 P"));
        }
    }

    fn check_cutting_spindle(&mut self, line: u32) {
        if self.reported.spindle {
            return;
        }
        let message = if self.has_other_spindle_state() {
            &say::SPINDLES_DIFFER
        } else if self.dwelt < self.spin_up && self.is_spindle_on() {
            &say::SPUN_UP_TOO_SHORT
        } else {
            return;
        };
        self.reported.spindle = true;
        self.report_spindle(line, message);
    }

    fn is_spindle_on(&self) -> bool {
        self.tools.spindle().turning.is_on()
    }

    fn has_other_spindle_state(&self) -> bool {
        self.tools.has_other_spindle_state(self.expected.turning, self.expected.speed, SPEED_TOLERANCE)
    }

    fn report_spindle(&mut self, line: u32, message: &'static Message) {
        let (expected, found) = (self.expected, self.tools.spindle());
        let running = spindle_text(Some(found.turning), found.speed);
        let message = if running.is_empty() { &say::SPINDLE_NOT_SWITCHED } else { message };
        self.problems.add_at_line(message, line, |d| {
            d.quoting("found", running)
                .quoting("expected", spindle_text(expected.turning, expected.speed))
                .with("seconds", self.spin_up)
        });
    }

    /// Checks that the active length is that of the tool in the spindle if M6 inserts tools. Programs without M6, such as the native one, apply no
    /// length.
    fn check_cutting_length(&mut self, line: u32) {
        let fit = self.tools.length_fit();
        if fit == LengthFit::Unstated
            && self.keeps_lengths()
            && !std::mem::replace(&mut self.reported.no_length, true)
        {
            self.problems.add_at_line(&say::MODES_NOT_STATED, line, |d| {
                d.quoting("words", "G49").quoting("taken", "G49").as_error()
            });
        }
        let fits = match fit {
            LengthFit::Unstated | LengthFit::Off => !self.must_apply_length(),
            LengthFit::Fits => self.must_apply_length() || !self.has_post(),
            LengthFit::Outdated | LengthFit::OfEntry(_) | LengthFit::Unknown => false,
        };
        if !fits && !std::mem::replace(&mut self.reported.length, true) {
            let at = self.tools.length_line().unwrap_or(line);
            if fit == LengthFit::Fits {
                return self.report_extra_word(at, "G43".to_owned());
            }
            self.problems.add_at_line(&say::LENGTHS_DIFFER, at, |d| d);
        }
    }

    fn keeps_lengths(&self) -> bool {
        self.dialect.rules().lengths.keeps_length
            && (!self.words.is_of_definition() || self.words.has('G', 490) || self.must_apply_length())
    }

    /// Whether the program must apply the length of the tool inserted by M6, because programs of the post do.
    fn must_apply_length(&self) -> bool {
        self.words.has('G', 430)
    }
}

fn coolant_text(coolant: Coolant) -> &'static str {
    match (coolant.mist, coolant.flood) {
        (true, true) => "M7 M8",
        (true, false) => "M7",
        (false, true) => "M8",
        (false, false) => "M9",
    }
}

fn spindle_text(turning: Option<Turning>, speed: Option<f64>) -> String {
    let word = match turning {
        Some(Turning::Clockwise) => "M3",
        Some(Turning::CounterClockwise) => "M4",
        Some(Turning::Off) => "M5",
        Some(Turning::Unstated) | None => "",
    };
    let speed = speed.map(|speed| format!("S{}", pathbuild_diagnostic::Number(speed))).unwrap_or_default();
    [word, &speed].join(" ").trim().to_owned()
}
