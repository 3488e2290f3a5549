//! Finds moves in the plane at a height that only the controller knows: at the beginning of a program, and after a tool change by hand.
//! (book: program/reading, "Tool changes by hand")
//!
//! At a stop the operator may change the tool and set the zero, or only clean: then the tool is where the program left it. A stop is treated as a
//! tool change if T, or the message of the post for Marlin, names a tool other than that of the last cut, if M6 precedes or follows it without a move
//! in between, or if the program sets a zero or another tool length after it. With M6, a tool that was raised to a machine position stays there.

use pathbuild_diagnostic::Message;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Axes, Change, Move, NamedPosition, Step, ToolLength};

use super::tool_to_insert;
use crate::dialect::{Dialect, ToolChanger};

/// Knowledge about the height of the tool's tip: pass every step of a program to [`step`](Self::step).
#[derive(Clone, Debug)]
pub struct TipHeight {
    changer: ToolChanger,
    height: Height,
    /// Number of the tool that the last T has selected.
    selected: Option<u32>,
    /// Number of the tool that was selected at the last cut.
    cutting: Option<u32>,
    /// Whether the program has M6, so that T alone prepares the next change.
    has_inserted: bool,
    /// Whether M6 has been executed since the last move, and no tool length has been set after it.
    is_beside_change: bool,
    /// Whether the last move in Z went to a machine position, whose height in the program's coordinates is unknown.
    is_homed: bool,
    /// The tool length that the program has set last.
    length: Option<ToolLength>,
    /// Line of the last move, if it was the first one in the plane after a stop and stated the height as well.
    moved_aslant: Option<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Height {
    /// The program has stated no height yet.
    Unstated,
    /// The height is known, or has been reported as unknown.
    Known,
    /// The program has stopped and stated no height since. The height is known unless the stop turns out to be a tool change.
    Stopped {
        /// Line of the first move in the plane since the stop.
        moved: Option<u32>,
    },
    /// The operator has changed the tool, and the program has stated no height since.
    Changed,
}

impl TipHeight {
    /// Creates the state at the beginning of a program.
    pub fn new(dialect: Dialect) -> Self {
        Self {
            changer: dialect.rules().changer,
            height: Height::Unstated,
            selected: None,
            cutting: None,
            has_inserted: false,
            is_beside_change: false,
            is_homed: false,
            length: None,
            moved_aslant: None,
        }
    }

    /// Processes the next step of the program. Returns a finding, with its line, about the first move in the plane at an unknown height.
    pub fn step(&mut self, step: &Step) -> Option<(u32, &'static Message)> {
        match &step.action {
            Action::Move(movement) => return self.add_move(step, movement),
            Action::Stop { optional: false } => self.stop(),
            Action::SelectTool(number) => return self.select(*number),
            Action::Comment(text) => return tool_to_insert(text).and_then(|number| self.select(number)),
            Action::ChangeTool(number) => self.insert(*number),
            Action::Change(Change::Offsets { code: 100 | 920, is_followed: false, .. })
                if self.height == (Height::Stopped { moved: None }) =>
            {
                self.height = Height::Changed;
            }
            Action::Change(Change::ToolLength(length)) => {
                self.is_beside_change = false;
                let is_other = matches!(length, ToolLength::Other(_)) || self.length != Some(*length);
                self.length = Some(*length);
                if is_other && *length != ToolLength::Off {
                    return self.change_at_stop();
                }
            }
            _ => {}
        }
        None
    }

    /// Returns the line of the first move in the plane since the last stop, if it began at the height of that stop, and if the program has neither
    /// stated a height in a later move nor cut since.
    pub fn first_move_since_stop(&self) -> Option<u32> {
        match self.height {
            Height::Stopped { moved } => moved,
            _ => self.moved_aslant,
        }
    }

    fn select(&mut self, number: u32) -> Option<(u32, &'static Message)> {
        self.selected = Some(number);
        if self.is_other_tool() { self.change_at_stop() } else { None }
    }

    /// Whether T has selected a tool other than that of the last cut, for a tool change without M6.
    fn is_other_tool(&self) -> bool {
        !self.has_inserted && self.selected.is_some() && self.selected != self.cutting
    }

    fn stop(&mut self) {
        if self.height == Height::Unstated {
            return;
        }
        let is_change = self.is_other_tool() || self.is_beside_change;
        self.height = if is_change { Height::Changed } else { Height::Stopped { moved: None } };
    }

    /// Treats the last stop, if no height has been stated since, as a tool change.
    fn change_at_stop(&mut self) -> Option<(u32, &'static Message)> {
        let Height::Stopped { moved } = self.height else { return None };
        self.height = moved.map_or(Height::Changed, |_| Height::Known);
        moved.map(|line| (line, &say::CHANGE_NOT_RAISED))
    }

    fn insert(&mut self, number: Option<u32>) {
        self.selected = number.or(self.selected);
        self.has_inserted = true;
        self.height = match (self.changer, self.height) {
            (ToolChanger::Machine, _) => Height::Known,
            (_, Height::Unstated) => Height::Unstated,
            (ToolChanger::Operator, _) => Height::Changed,
            (ToolChanger::Either, Height::Stopped { moved: None }) if !self.is_homed => Height::Changed,
            (ToolChanger::Either, Height::Stopped { .. }) => Height::Known,
            (ToolChanger::Either, height) => height,
        };
        self.is_beside_change = self.changer != ToolChanger::Machine && !self.is_homed;
    }

    fn add_move(&mut self, step: &Step, movement: &Move) -> Option<(u32, &'static Message)> {
        self.is_beside_change = false;
        self.moved_aslant = None;
        self.is_homed = !movement.to.known.has(Axes::Z) && (self.is_homed || movement.homes_z());
        let found = match self.height {
            Height::Known => None,
            Height::Unstated => self.handle_move_without_height(movement),
            Height::Stopped { .. } | Height::Changed => self.handle_move_after_stop(step, movement),
        };
        if movement.is_cut() {
            self.cutting = self.selected;
            if matches!(self.height, Height::Stopped { .. }) {
                self.height = Height::Known;
            }
        }
        found.map(|message| (step.line, message))
    }

    /// Handles a move before any height is known. A move to a machine position that does not change X or Y, such as `G53 Z0` or `G28 Z0`, is assumed
    /// to raise the tool, although the height is unknown.
    fn handle_move_without_height(&mut self, movement: &Move) -> Option<&'static Message> {
        let is_raised = movement.to.known.has(Axes::Z) || (movement.homes_z() && movement.keeps_xy());
        let moves_in_plane = !movement.to.known.and(Axes::XY).is_empty() || homes_in_plane(movement);
        if is_raised || moves_in_plane {
            self.height = Height::Known;
        }
        (moves_in_plane && !is_raised).then_some(&say::START_NOT_RAISED)
    }

    /// Handles a move after a stop or a tool change. A coordinate that has not changed is treated as a move too, since the operator may have moved
    /// the axes.
    fn handle_move_after_stop(&mut self, step: &Step, movement: &Move) -> Option<&'static Message> {
        let stated = step.stated_since_stop;
        let rises = movement.keeps_xy() && (movement.homes_z() || movement.to.z() > movement.from.z());
        let is_height_known = rises || stated.has(Axes::Z);
        let stays = movement.keeps_xy() && stated.and(Axes::XY).is_empty() && !homes_in_plane(movement);
        if stays || matches!(self.height, Height::Stopped { moved: Some(_) }) {
            if is_height_known {
                self.height = Height::Known;
            }
            return None;
        }
        // A move that also states Z begins at the unknown height, and leads through whatever is in its way there.
        if let Height::Stopped { moved } = &mut self.height {
            *moved = Some(step.line);
            if is_height_known {
                (self.height, self.moved_aslant) = (Height::Known, Some(step.line));
            }
            return None;
        }
        self.height = Height::Known;
        Some(&say::CHANGE_NOT_RAISED)
    }
}

/// Whether a move goes to a machine position in the plane alone, which does not determine the height.
fn homes_in_plane(movement: &Move) -> bool {
    let homed = movement.named.filter(|_| !movement.homes_z()).map_or(Axes::NONE, NamedPosition::axes);
    !homed.and(Axes::XY).is_empty()
}
