//! Tools, spindle, coolant, dwells, modes, stops: everything of a block that is no move.

use pathbuild_diagnostic::messages::gcode as say;

use super::codes::{self, Command, Group};
use super::execute::{Interpreter, whole};
use super::step::{Action, Coolant, Turning};
use crate::read::Block;

/// M codes of the spindle, and of stops and ends.
pub(super) const SPINDLE: &[u16] = &[30, 40, 50, 190];
pub(super) const STOPS: &[u16] = &[0, 10, 20, 300, 600];
pub(super) const TOOL: &[u16] = &[60, 610];
pub(super) const COOLANT: &[u16] = &[70, 80, 90];
/// M codes that change which line is run next, or what G words mean.
const M_NOT_FOLLOWED: &[u16] = &[610, 700, 710, 720, 730, 980, 990];

impl Interpreter<'_> {
    pub(super) fn tool(&mut self, block: &Block<'_>) {
        let change = self.words.m_code(&[60]);
        if let Some(slot) = self.words.values.take_slot(b'T') {
            match whole(slot.value) {
                Some(number) => {
                    self.state.tool = Some(number);
                    if change.is_none() {
                        self.step(block, Action::SelectTool(number));
                    }
                }
                None => self.out_of_range(block, "T", slot, "a whole number, 0 or more"),
            }
        }
        let Some((_, span)) = change else { return };
        if self.rules.layers && self.state.tool.is_none() {
            return self.report(block, &say::NEEDS, span, |d| {
                d.with("word", "M6").with("missing", "the number of a layer")
            });
        }
        let tool = self.state.tool.unwrap_or(0);
        if self.rules.layers {
            self.state.layer = tool;
            self.state.layer_speed = None;
        }
        self.step(block, Action::ChangeTool(tool));
        let is_turning = matches!(self.state.spindle.turning, Turning::Clockwise | Turning::Counterclockwise);
        if is_turning && !self.rules.layers {
            self.state.spindle.turning = Turning::Off;
            self.step(block, Action::Spindle(self.state.spindle));
        }
    }

    pub(super) fn spindle_and_coolant(&mut self, block: &Block<'_>) {
        let turning = self.words.m_code(SPINDLE).and_then(|(code, _)| match code {
            30 => Some(Turning::Clockwise),
            40 => Some(Turning::Counterclockwise),
            50 => Some(Turning::Off),
            _ => None,
        });
        if let Some(turning) = turning {
            self.state.spindle.turning = turning;
        }
        if turning.is_some() || self.words.values.has(b'S') {
            self.step(block, Action::Spindle(self.state.spindle));
        }
        let before = self.state.coolant;
        for &(code, _) in &self.words.m_codes {
            match code {
                70 => self.state.coolant.mist = true,
                80 => self.state.coolant.flood = true,
                90 => self.state.coolant = Coolant::default(),
                _ => {}
            }
        }
        if self.state.coolant != before {
            self.step(block, Action::Coolant(self.state.coolant));
        }
        if let Some((code, span)) = self.words.m_codes.iter().find(|(code, _)| is_unfollowed(*code)).copied()
        {
            self.report(block, &say::NOT_FOLLOWED, span, |d| d.with("word", codes::name('M', code)));
            self.use_all_words();
        }
    }

    pub(super) fn dwell(&mut self, block: &Block<'_>) {
        let Some((.., span)) = self.words.of_group(Group::Dwell) else { return };
        match self.words.values.take_slot(b'P') {
            Some(slot) if slot.value < 0.0 => self.out_of_range(block, "P", slot, "0 seconds or more"),
            Some(slot) => self.step(block, Action::Dwell(slot.value)),
            None => self.report(block, &say::NEEDS, span, |d| d.with("word", "G4").with("missing", "P")),
        }
    }

    pub(super) fn modes(&mut self, block: &Block<'_>) {
        for index in 0..self.words.commands.len() {
            let (command, code, span) = self.words.commands[index];
            match command {
                Command::Plane(plane) => {
                    self.state.plane = plane;
                    self.state.stated.plane = true;
                }
                Command::Inches(inches) => self.units(block, inches, code, span),
                Command::NoEffect(Group::ToolLength) => self.use_tool_length_words(),
                Command::NoEffect(Group::PathControl) => {
                    self.words.values.take(b'P');
                    self.words.values.take(b'Q');
                }
                Command::Incremental(incremental) => {
                    self.state.incremental = incremental;
                    self.state.stated.distance = true;
                }
                Command::IncrementalCentres(incremental) => self.state.incremental_centres = incremental,
                Command::RetractToR(to_r) => self.state.retract_to_r = to_r,
                Command::System(system) => self.select_system(block, system, span),
                Command::NotFollowed(group) if group != Group::Motion => {
                    self.report(block, &say::NOT_FOLLOWED, span, |d| d.with("word", codes::name('G', code)));
                    self.use_all_words();
                }
                _ => {}
            }
        }
    }

    /// G43 with H and axis words: the tool's length, which the position of its tip does not depend on.
    fn use_tool_length_words(&mut self) {
        self.words.values.take(b'H');
        self.words.values.take(b'D');
        if self.words.of_group(Group::Motion).is_none()
            && self.words.commands.iter().any(|(_, code, _)| *code == 431)
        {
            self.words.values.discard_coordinates();
        }
    }

    /// Of a command that is not followed, no word is reported as unused.
    pub(super) fn use_all_words(&mut self) {
        for letter in b'D'..=b'W' {
            self.words.values.take(letter);
        }
    }

    pub(super) fn stop(&mut self, block: &Block<'_>) {
        match self.words.m_code(STOPS) {
            Some((20 | 300, _)) => {
                self.ended = true;
                self.step(block, Action::End);
            }
            Some((10, _)) => self.step(block, Action::Stop { optional: true }),
            Some(_) => self.step(block, Action::Stop { optional: false }),
            None => {}
        }
    }

    pub(super) fn check_stop_before_motion(&mut self, block: &Block<'_>) {
        if let Some((code, span)) = self.words.m_code(&[50, 90]) {
            self.report(block, &say::STOP_BEFORE_MOTION, span, |d| d.with("word", codes::name('M', code)));
        }
    }
}

fn is_unfollowed(m_code: u16) -> bool {
    M_NOT_FOLLOWED.contains(&m_code) || (1000..2000).contains(&m_code)
}
