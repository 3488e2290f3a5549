//! Commands other than motions that use the coordinates of a block (G10, G28, G30, G52, G92), and coordinate systems.

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Axes, Change, Group, Move, MoveShape, Named, Pace, WorkSystem};

use super::codes::{Command, Origin};
use super::execute::{Interpreter, whole};
use super::gather::Values;
use super::limits;
use crate::read::{Block, Span};

impl Interpreter<'_> {
    /// Executes the command of the block that uses coordinates without being a motion. Returns whether there is one.
    pub(super) fn coordinates_taken(&mut self, block: &Block<'_>) -> bool {
        let Some((command, code, span)) = self.words.of_group(Group::NonModal) else { return false };
        if !matches!(command, Command::Home(_)) {
            let are_shifted = self.are_shifted(command);
            self.step(block, Action::Change(Change::Offsets { code, are_shifted }));
        }
        match command {
            Command::SetOffsets => self.set_offsets(block, span),
            Command::Home(which) => self.home(block, which, code),
            Command::StoreHome(which) => {
                let here = self.state.position;
                self.state.offsets.store_home(which, &here);
                return false;
            }
            Command::LocalOffset => self.local_offset(),
            Command::SetOrigin => self.set_origins(block, span),
            Command::Origin(other) => {
                self.change_origin(other);
                return false;
            }
            _ => return false,
        }
        // A motion word in the same block still sets the mode, but the coordinates have been used.
        if let Some((command @ Command::Motion(_), code, span)) = self.words.of_group(Group::Motion) {
            self.change_motion(block, command, code, span);
        }
        true
    }

    /// Whether G52 or G92 is active after a command.
    fn are_shifted(&self, command: Command) -> Option<bool> {
        match command {
            Command::LocalOffset => {
                let values = Values::AXES.iter().filter_map(|axis| self.words.values.peek(*axis));
                Some(values.into_iter().any(|slot| slot.value != 0.0))
            }
            Command::SetOrigin | Command::Origin(Origin::Resume) => Some(true),
            Command::Origin(Origin::Clear | Origin::Suspend) => Some(false),
            _ => None,
        }
    }

    fn set_offsets(&mut self, block: &Block<'_>, span: Span) {
        let kind = self.words.values.take(b'L').and_then(whole);
        let slot = self.words.values.take_slot(b'P');
        let coordinates = self.words.values.take_coordinates();
        let number = slot.and_then(|slot| whole(slot.value));
        let system = number.and_then(WorkSystem::from_number);
        let (Some(kind @ (2 | 20)), Some(number)) = (kind, number) else {
            self.use_all_words();
            return self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", "G10"));
        };
        if number > 9 {
            return self.report(block, &say::OUT_OF_RANGE, span, |d| {
                d.quoting("word", "P").with("value", f64::from(number)).with("limits", &limits::OFFSETS)
            });
        }
        if self.words.values.take(b'R').is_some() {
            self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", "G10 R"));
        }
        for (axis, slot) in coordinates.into_iter().enumerate() {
            let Some(coordinate) = slot.map(|slot| self.millimetres(slot)) else { continue };
            if kind == 2 {
                self.state.offsets.place(system, axis, coordinate);
            } else {
                let here = self.state.position.at[axis];
                self.state.offsets.place_here(system, axis, coordinate, here);
            }
        }
    }

    fn home(&mut self, block: &Block<'_>, which: usize, code: u16) {
        self.state.offsets.fix_base();
        let coordinates = self.words.values.take_coordinates();
        let given = (0..3)
            .filter(|axis| coordinates[*axis].is_some())
            .fold(Axes::NONE, |axes, axis| axes.with(Axes::of(axis)));
        if !given.is_empty() {
            let to = self.target(coordinates);
            let from = self.state.position;
            self.emit_move(block, Move { from, to, shape: MoveShape::Line, pace: Pace::Rapid, named: None });
        }
        let from = self.state.position;
        let mut to = from;
        for axis in (0..3).filter(|axis| given.is_empty() || given.has(Axes::of(*axis))) {
            self.state_axis(axis);
            match self.state.offsets.home(which, axis) {
                Some(at) => {
                    to.at[axis] = at;
                    to.known = to.known.with(Axes::of(axis));
                }
                None => to.known = to.known.without(Axes::of(axis)),
            }
        }
        if to.known != Axes::ALL {
            self.state.lost = Some((block.line, code));
        }
        let named = Some(if which == 0 { Named::Home1 } else { Named::Home2 });
        self.emit_move(block, Move { from, to, shape: MoveShape::Line, pace: Pace::Rapid, named });
    }

    fn local_offset(&mut self) {
        for (axis, slot) in self.words.values.take_coordinates().into_iter().enumerate() {
            if let Some(slot) = slot {
                let offset = self.millimetres(slot);
                self.state.offsets.set_local(axis, offset);
            }
        }
    }

    fn change_origin(&mut self, origin: Origin) {
        match origin {
            Origin::Clear => self.state.offsets.clear_origin(false),
            Origin::Suspend => self.state.offsets.clear_origin(true),
            Origin::Resume => self.state.offsets.resume_origin(),
        }
    }

    fn set_origins(&mut self, block: &Block<'_>, span: Span) {
        if !self.words.values.has_coordinates() {
            self.report(block, &say::NEEDS, span, |d| d.quoting("word", "G92").quoting("missing", "X, Y, Z"));
        }
        for (axis, slot) in self.words.values.take_coordinates().into_iter().enumerate() {
            if let Some(slot) = slot {
                let coordinate = self.millimetres(slot);
                self.set_origin(axis, coordinate);
            }
        }
    }

    /// Sets the coordinate of the current position. If it was unknown, it becomes known, because the program counts from it.
    fn set_origin(&mut self, axis: usize, coordinate: f64) {
        self.state_axis(axis);
        let position = &mut self.state.position;
        if position.known.has(Axes::of(axis)) {
            self.state.offsets.set_origin(axis, coordinate, position.at[axis]);
        } else {
            position.at[axis] = coordinate + self.state.offsets.shift(axis);
            position.known = position.known.with(Axes::of(axis));
        }
    }

    pub(super) fn select_system(&mut self, block: &Block<'_>, system: WorkSystem, span: Span) {
        let before = self.state.offsets.active();
        if before == system {
            return;
        }
        if !self.state.offsets.select(system) {
            self.report(block, &say::OFFSET_UNKNOWN, span, |d| {
                d.quoting("system", system.name()).quoting("base", before.name())
            });
        }
        self.step(block, Action::System(system));
    }
}
