//! Executes moves: straight lines, arcs given by I J K or R, probing, named positions, and commands that use coordinates without moving. (book:
//! program/reading)

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{
    Action, Arc, Axes, Change, Group, Move, MoveShape, NamedPosition, Pace, Plane, Position, WorkSystem,
};

use super::codes::{self, Command, Motion, Origin};
use super::execute::{Interpreter, Slot, Values, limits, whole_number};
use super::half_circles::{ArcByRadius, height_over_chord};
use super::state::{ClearedZero, INCH, State, StatedLength};
use crate::dialect::RadiusTolerance;
use crate::read::{Block, SourcePosition, Span};

/// The lowest height of G53, in mm, that is accepted as a retract. Posts stay some millimetres below machine zero, to keep clear of the switches:
/// Carbide Create writes `G53G0Z-5.000`, `OpenBuilds` `G53 G0 Z-10`.
pub(crate) const LOWEST_RETRACT: f64 = -10.0;

impl Interpreter<'_> {
    /// Executes the motion of the block, if it has one. Returns whether it moves.
    pub(super) fn motion(&mut self, block: &Block<'_>) -> bool {
        let stated = self.words.command_of_group(Group::Motion);
        let has_coordinates = self.words.values.has_coordinates();
        if let Some((command, code, span)) = stated {
            self.change_motion(block, command, code, span);
        }
        let motion = self.state.motion;
        let is_machine = self.words.command_of_group(Group::MachineCoordinates);
        if let Some((.., span)) = is_machine {
            self.check_machine_coordinates(block, motion, span);
            let is_idle = !has_coordinates && !stated.is_some_and(|(_, code, _)| matches!(code, 0 | 10));
            if is_idle && self.rules.refuses_idle_words && matches!(motion, Motion::Rapid | Motion::Feed) {
                self.report(block, &say::MACHINE_COORDINATES_MOTION, span, |d| d);
            }
        }
        let moves_without_coordinates =
            stated.is_some() && matches!(motion, Motion::Arc { .. } | Motion::Cycle(_));
        if !has_coordinates && !moves_without_coordinates {
            if let Some((_, code, span)) = stated {
                self.check_idle_motion_word(block, motion, code, span);
            }
            return false;
        }
        self.check_stated(block, stated.is_some(), motion);
        self.state.offsets.fix_base();
        if is_machine.is_none() {
            self.check_unit_of_shift(block);
        }
        match motion {
            Motion::None => {
                self.report(block, &say::NO_MOTION, self.coordinates_span(block), |d| d);
                self.words.values.take_coordinates();
            }
            Motion::Rapid => self.straight(block, Pace::Rapid, is_machine.is_some()),
            Motion::Feed => self.straight(block, Pace::Feed(0.0), is_machine.is_some()),
            Motion::Arc { clockwise } => self.arc(block, clockwise),
            Motion::Probe { toward, must_answer } => {
                self.straight(block, Pace::Probe { feed: 0.0, toward, must_answer }, false);
            }
            Motion::Cycle(cycle) => self.cycle(block, cycle),
            Motion::Unfollowed => self.update_after_unsupported_motion(),
        }
        motion != Motion::None
    }

    pub(super) fn change_motion(&mut self, block: &Block<'_>, command: Command, code: u16, span: Span) {
        let motion = if let Command::Motion(motion) = command {
            motion
        } else {
            self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", codes::name('G', code)));
            Motion::Unfollowed
        };
        let (motion, code) = self.resolve_motion(motion, code);
        if motion != self.state.motion {
            let goes_on = matches!((self.state.motion, motion), (Motion::Cycle(_), Motion::Cycle(_)));
            self.begin_cycle(goes_on);
        }
        self.state.change_within_cycle = None;
        self.state.motion = motion;
        self.state.motion_code = code;
    }

    /// Returns the motion that a word puts into effect. Where cycles are a modal group of their own, G80 restores the motion that was in effect
    /// before the cycle.
    fn resolve_motion(&mut self, motion: Motion, code: u16) -> (Motion, u16) {
        let present = (self.state.motion, self.state.motion_code);
        let is_in_cycle = matches!(present.0, Motion::Cycle(_));
        if matches!(motion, Motion::Cycle(_)) && !is_in_cycle {
            self.state.motion_before_cycle = present;
        }
        let left = if is_in_cycle { self.state.motion_before_cycle } else { present };
        let is_kept = matches!(left.0, Motion::Rapid | Motion::Feed | Motion::Arc { .. });
        if motion == Motion::None && self.rules.cycles_are_apart && is_kept { left } else { (motion, code) }
    }

    /// Reports a probing word without coordinates. In dialects where each line states its motion, also warns about G0 and G1 without coordinates or
    /// F, which have no effect on later lines.
    fn check_idle_motion_word(&mut self, block: &Block<'_>, motion: Motion, code: u16, span: Span) {
        let sets_feed = self.words.values.has(b'F') && !self.rules.layers;
        let is_straight = matches!(motion, Motion::Rapid | Motion::Feed);
        if self.rules.motion_is_stated && is_straight && !sets_feed {
            self.report(block, &say::NEEDS, span, |d| {
                d.quoting("word", codes::name('G', code)).with("missing", &limits::ANY_AXIS).as_warning()
            });
        } else if matches!(code, 382..=385) {
            self.report(block, &say::NEEDS, span, |d| {
                d.quoting("word", codes::name('G', code)).with("missing", &limits::ANY_AXIS)
            });
        }
    }

    fn check_machine_coordinates(&mut self, block: &Block<'_>, motion: Motion, span: Span) {
        if self.state.incremental && !self.rules.absolute_machine_coordinates {
            self.report(block, &say::MACHINE_COORDINATES_RELATIVE, span, |d| d);
        } else if !matches!(motion, Motion::Rapid | Motion::Feed) {
            self.report(block, &say::MACHINE_COORDINATES_MOTION, span, |d| d);
        }
    }

    pub(super) fn coordinates_span(&self, block: &Block<'_>) -> Span {
        let span = Values::AXES.iter().find_map(|axis| self.words.values.peek(*axis)).map(|slot| slot.span);
        span.unwrap_or_else(|| block.span())
    }

    /// Reports settings that the program should have specified before a move.
    fn check_stated(&mut self, block: &Block<'_>, motion_is_stated: bool, motion: Motion) {
        let span = self.coordinates_span(block);
        if !std::mem::replace(&mut self.state.stated.units, true) {
            let [inch, mm] = self.rules.unit_words.map(|code| codes::name('G', code));
            self.report(block, &say::UNITS_NOT_STATED, span, |d| d.quoting("inch", inch).quoting("mm", mm));
        }
        let is_followed = !matches!(motion, Motion::None | Motion::Unfollowed);
        if !motion_is_stated && is_followed && self.rules.motion_is_stated {
            let word = codes::name('G', self.state.motion_code);
            self.report(block, &say::MOTION_NOT_STATED, span, |d| d.quoting("word", word));
        }
        if self.rules.layers {
            return;
        }
        if !std::mem::replace(&mut self.state.stated.distance, true) {
            self.report(block, &say::DISTANCE_NOT_STATED, span, |d| d);
        }
        let depends_on_plane = matches!(motion, Motion::Arc { .. }) && !self.rules.one_command;
        if depends_on_plane && !std::mem::replace(&mut self.state.stated.plane, true) {
            self.report(block, &say::MODES_NOT_STATED, span, |d| {
                d.quoting("words", "G17").quoting("taken", "G17")
            });
        }
    }

    /// Returns the position that these coordinates specify. Axes without a coordinate keep their current position.
    pub(super) fn target(&mut self, coordinates: [Option<Slot>; 3]) -> Position {
        let mut to = self.state.position;
        for (axis, slot) in coordinates.into_iter().enumerate() {
            let Some(slot) = slot else { continue };
            if self.state.incremental {
                to.at[axis] += self.millimetres(slot);
            } else {
                to.at[axis] = self.millimetres(slot) + self.state.offsets.shift(axis);
                to.known = to.known.with(Axes::of(axis));
                self.mark_axis_stated(axis);
            }
        }
        to
    }

    pub(super) fn mark_axis_stated(&mut self, axis: usize) {
        let State { stated_axes, stated_since_stop, .. } = &mut self.state;
        *stated_axes = stated_axes.with(Axes::of(axis));
        *stated_since_stop = stated_since_stop.with(Axes::of(axis));
    }

    fn machine_target(&mut self, block: &Block<'_>, coordinates: [Option<Slot>; 3]) -> Position {
        self.check_machine_height(block, coordinates[2]);
        let mut to = self.state.position;
        for (axis, slot) in coordinates.into_iter().enumerate() {
            let Some(slot) = slot else { continue };
            self.mark_axis_stated(axis);
            if let Some(at) = self.state.offsets.position_of_machine_coordinate(axis, self.millimetres(slot))
            {
                to.at[axis] = at;
                to.known = to.known.with(Axes::of(axis));
            } else {
                to.at[axis] = self.millimetres(slot);
                to.known = to.known.without(Axes::of(axis));
            }
        }
        if to.known != Axes::ALL {
            self.state.lost = Some((block.line, 530));
        }
        to
    }

    /// Reports the first move that goes to a low height in machine coordinates from a known X and Y, where the part may be. If the machine's offsets
    /// are known, nothing is reported.
    fn check_machine_height(&mut self, block: &Block<'_>, z: Option<Slot>) {
        let Some(slot) = z.filter(|_| self.state.offsets.position_of_machine_coordinate(2, 0.0).is_none())
        else {
            return;
        };
        let is_over_part = self.state.position.known.has(Axes::XY);
        let is_low = self.millimetres(slot) < LOWEST_RETRACT;
        if is_over_part && is_low && !std::mem::replace(&mut self.state.stated.machine_height, true) {
            let z = slot.value;
            self.report(block, &say::LOW_MACHINE_HEIGHT, slot.span, |d| d.with("z", z));
        }
    }

    fn straight(&mut self, block: &Block<'_>, pace: Pace, is_machine: bool) {
        let coordinates = self.words.values.take_coordinates();
        let to = if is_machine { self.machine_target(block, coordinates) } else { self.target(coordinates) };
        let from = self.state.position;
        let named = is_machine.then(|| NamedPosition::Machine(given_axes(&coordinates)));
        let mut movement = Move { from, to, shape: MoveShape::Line, pace, named };
        movement.pace = match pace {
            Pace::Rapid => {
                self.record_rapid_feed(block);
                Pace::Rapid
            }
            Pace::Feed(_) => Pace::Feed(self.feed(block, &movement)),
            Pace::Probe { toward, must_answer, .. } => {
                Pace::Probe { feed: self.feed(block, &movement), toward, must_answer }
            }
        };
        self.emit_move(block, movement);
        if matches!(pace, Pace::Probe { .. }) {
            // A probe may stop anywhere on the way. Only an axis that has the same known position at both ends is certain to be at that position.
            let stays = |axis: usize| from.known.has(Axes::of(axis)) && from.at[axis] == to.at[axis];
            let moved: [_; 3] = std::array::from_fn(|axis| coordinates[axis].filter(|_| !stays(axis)));
            self.state.position.known = to.known.without(given_axes(&moved));
        }
    }

    /// Updates the position after an unsupported motion, as far as the block's words state it. A cycle returns to a height above its Z.
    fn update_after_unsupported_motion(&mut self) {
        let mut coordinates = self.words.values.take_coordinates();
        if codes::is_cycle(self.state.motion_code) {
            coordinates[2] = None;
        }
        self.state.position = self.target(coordinates);
        self.mark_all_used();
    }
}

impl Interpreter<'_> {
    /// Executes the command of the block that uses coordinates without being a motion. Returns whether there is one.
    pub(super) fn execute_coordinate_command(&mut self, block: &Block<'_>) -> bool {
        let Some((command, code, span)) = self.words.command_of_group(Group::NonModal) else { return false };
        if !matches!(command, Command::Home(_) | Command::Reference) {
            let are_shifted = self.are_shifted(command);
            if let Some(are_shifted) = are_shifted {
                let stated = StatedLength { line: block.line, unit: self.state.unit };
                self.state.shift_stated = are_shifted.then_some(stated);
            }
            let is_followed = self.keeps_zero(command);
            self.step(block, Action::Change(Change::Offsets { code, are_shifted, is_followed }));
        }
        match command {
            Command::SetOffsets => self.set_offsets(block, span),
            Command::Home(which) => self.home(block, which, code),
            Command::Reference => self.move_to_reference(block, code),
            Command::StoreHome(which) => {
                let here = self.state.position;
                self.state.offsets.store_home(which, &here);
                self.report(block, &say::HOME_STORED, span, |d| {
                    d.quoting("word", codes::name('G', code)).quoting("home", codes::name('G', code - 1))
                });
                return false;
            }
            Command::LocalOffset => self.local_offset(),
            Command::SetOrigin => self.set_origins(block, span),
            Command::Origin(other) => {
                self.change_origin(block, span, other);
                return false;
            }
            _ => return false,
        }
        // A motion word in the same block still sets the mode, but the coordinates have been used.
        if let Some((command @ Command::Motion(_), code, span)) = self.words.command_of_group(Group::Motion) {
            self.change_motion(block, command, code, span);
        }
        true
    }

    /// Whether G52 or G92 shifts coordinates after a command; `None` if the command does not change that.
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

    /// Whether the positions after a command that moves origins count from the same zero as those before it.
    fn keeps_zero(&self, command: Command) -> bool {
        let offsets = &self.state.offsets;
        let value = |letter: u8| self.words.values.peek(letter).map(|slot| slot.value);
        match command {
            Command::SetOffsets => {
                let number = value(b'P').and_then(whole_number).filter(|number| *number > 0);
                let is_active =
                    number.is_none_or(|number| WorkSystem::from_number(number) == Some(offsets.active));
                let is_here = value(b'L').and_then(whole_number) == Some(20);
                is_active && if is_here { self.is_position_known() } else { offsets.is_fixed_to_machine() }
            }
            Command::SetOrigin => self.is_position_known(),
            Command::LocalOffset => {
                let keeps = |(axis, letter): (usize, u8)| {
                    value(letter).is_none_or(|value| value * self.state.unit == offsets.local(axis))
                };
                offsets.is_fixed() || Values::AXES.into_iter().enumerate().all(keeps)
            }
            Command::Origin(_) if offsets.is_fixed() => offsets.touched_off.is_empty(),
            Command::Origin(_) => !offsets.is_shifted_by_origin(),
            _ => true,
        }
    }

    /// Whether the position of the tool is known along the axes in the block.
    fn is_position_known(&self) -> bool {
        let known = self.state.located_axes();
        let given = |axis: &usize| self.words.values.has(Values::AXES[*axis]);
        self.state.offsets.is_fixed() && (0..3).filter(given).all(|axis| known.has(Axes::of(axis)))
    }

    fn set_offsets(&mut self, block: &Block<'_>, span: Span) {
        let kind = self.words.values.take(b'L').and_then(whole_number);
        let slot = self.words.values.take_slot(b'P');
        let coordinates = self.words.values.take_coordinates();
        let number = slot.and_then(|slot| whole_number(slot.value));
        let system = number.and_then(WorkSystem::from_number);
        // P0 and L20 set other offsets on Fanuc and its relatives, where G91 also adds to the offset.
        let is_own =
            self.rules.keeps_offsets && (kind == Some(20) || number == Some(0) || self.state.incremental);
        let (Some(kind @ (2 | 20)), Some(number), false) = (kind, number, is_own) else {
            self.mark_all_used();
            return self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", "G10"));
        };
        if self.rules.offsets_need_axis && given_axes(&coordinates).is_empty() {
            self.report(block, &say::NEEDS, span, |d| {
                d.quoting("word", "G10").with("missing", &limits::ANY_AXIS)
            });
        }
        if number > 9 {
            return self.report(block, &say::OUT_OF_RANGE, span, |d| {
                d.quoting("word", "P").with("value", f64::from(number)).with("limits", &limits::OFFSETS)
            });
        }
        if self.words.values.take(b'R').is_some() {
            self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", "G10 R"));
        }
        let mut is_followed = true;
        for (axis, slot) in coordinates.into_iter().enumerate() {
            let Some(coordinate) = slot.map(|slot| self.millimetres(slot)) else { continue };
            if kind == 2 {
                is_followed &= self.state.offsets.place(system, axis, coordinate);
            } else if self.state.located_axes().has(Axes::of(axis)) {
                let here = self.state.position.at[axis];
                self.forget_cleared_zero(axis);
                self.state.offsets.place_here(system, axis, coordinate, here);
            } else if let Some(system) = system.filter(|system| *system != self.state.offsets.active) {
                self.state.offsets.mark_position_unknown(system);
            } else {
                self.set_origin(block, axis, coordinate);
            }
        }
        if !is_followed {
            let system = self.system_name(self.state.offsets.active);
            self.report(block, &say::ORIGIN_UNKNOWN, span, |d| d.quoting("system", system));
        }
    }

    fn home(&mut self, block: &Block<'_>, which: usize, code: u16) {
        self.state.offsets.fix_base();
        let is_other = self.is_other_reference(block, code);
        let coordinates = self.words.values.take_coordinates();
        let given = given_axes(&coordinates);
        if !given.is_empty() {
            let to = self.target(coordinates);
            let from = self.state.position;
            self.emit_move(block, Move { from, to, shape: MoveShape::Line, pace: Pace::Rapid, named: None });
        }
        let from = self.state.position;
        let axes = if given.is_empty() { Axes::ALL } else { given };
        let mut to = from;
        for axis in (0..3).filter(|axis| axes.has(Axes::of(*axis))) {
            self.mark_axis_stated(axis);
            match self.state.offsets.home(which, axis).filter(|_| !is_other) {
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
        let named = Some(if which == 0 { NamedPosition::Home1(axes) } else { NamedPosition::Home2(axes) });
        self.emit_move(block, Move { from, to, shape: MoveShape::Line, pace: Pace::Rapid, named });
    }

    /// Whether P of G30 selects a reference point other than the second one. The position of such a point is unknown.
    fn is_other_reference(&mut self, block: &Block<'_>, code: u16) -> bool {
        if code != 300 || !self.rules.numbers_references {
            return false;
        }
        let Some(slot) = self.words.values.take_slot(b'P') else { return false };
        let number = whole_number(slot.value);
        if !matches!(number, Some(2..=4)) {
            self.report_out_of_range(block, "P", slot, &limits::REFERENCES);
        }
        number != Some(2)
    }

    /// Moves the axes in the line, or all of them, to their reference switches. Their positions in the program are unknown afterwards.
    fn move_to_reference(&mut self, block: &Block<'_>, code: u16) {
        self.state.offsets.fix_base();
        let given = given_axes(&self.words.values.take_coordinates());
        let axes = if given.is_empty() { Axes::ALL } else { given };
        let from = self.state.position;
        let to = Position { known: from.known.without(axes), ..from };
        self.state.stated_axes = self.state.stated_axes.with(axes);
        self.state.lost = Some((block.line, code));
        if self.state.has_cut && self.rules.reference.loses_zero {
            self.state.referenced = Some((block.line, code));
        }
        let named = Some(NamedPosition::Home1(axes));
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

    fn change_origin(&mut self, block: &Block<'_>, span: Span, origin: Origin) {
        let code = match origin {
            Origin::Clear => Some(921),
            Origin::Suspend => Some(922),
            Origin::Resume => None,
        };
        let axes = self.state.offsets.touched_off;
        if !axes.is_empty() && self.state.has_cut {
            self.state.cleared_zero =
                code.map(|code| ClearedZero { line: block.line, code, axes, has_moved: false });
        }
        match origin {
            Origin::Clear => self.state.offsets.clear_origin(false),
            Origin::Suspend => self.state.offsets.clear_origin(true),
            Origin::Resume if self.state.offsets.resume_origin() => {}
            // The offsets are stored in #5211 and the parameters after it, which keep their values between programs.
            Origin::Resume => self.report(block, &say::MACHINE_VALUE, span, |d| {
                d.quoting("parameter", "#5211").with("value", 0.0)
            }),
        }
    }

    fn set_origins(&mut self, block: &Block<'_>, span: Span) {
        if !self.words.values.has_coordinates() {
            self.report(block, &say::NEEDS, span, |d| {
                d.quoting("word", "G92").with("missing", &limits::ANY_AXIS)
            });
        }
        for (axis, slot) in self.words.values.take_coordinates().into_iter().enumerate() {
            if let Some(slot) = slot {
                let coordinate = self.millimetres(slot);
                if !self.state.located_axes().has(Axes::of(axis)) {
                    self.state.offsets.touched_off = self.state.offsets.touched_off.with(Axes::of(axis));
                }
                self.set_origin(block, axis, coordinate);
            }
        }
    }

    /// Sets the coordinate of the current position. If only the machine knows this position, after a probe or after a stop at which the operator may
    /// have touched off, all later coordinates are relative to this position.
    fn set_origin(&mut self, block: &Block<'_>, axis: usize, coordinate: f64) {
        let is_followed = self.state.located_axes().has(Axes::of(axis));
        let is_moved_by_hand = self.state.position.known.has(Axes::of(axis)) && !is_followed;
        self.forget_cleared_zero(axis);
        self.state.stated_axes = self.state.stated_axes.with(Axes::of(axis));
        self.state.zeroed_since_stop = self.state.zeroed_since_stop.with(Axes::of(axis));
        let position = &mut self.state.position;
        if is_followed {
            return self.state.offsets.set_origin(axis, coordinate, position.at[axis]);
        }
        position.at[axis] = coordinate + self.state.offsets.shift(axis);
        position.known = position.known.with(Axes::of(axis));
        if is_moved_by_hand && Axes::XY.has(Axes::of(axis)) {
            let frame = self.state.offsets.begin_frame();
            self.step(block, Action::System { system: self.state.offsets.active, frame });
        }
    }

    fn forget_cleared_zero(&mut self, axis: usize) {
        if let Some(cleared) = &mut self.state.cleared_zero {
            cleared.axes = cleared.axes.without(Axes::of(axis));
        }
    }

    /// Returns the coordinate system that P selects in this block, or `default` if there is no P.
    pub(super) fn numbered_system(
        &mut self,
        block: &Block<'_>,
        code: u16,
        span: Span,
        default: Option<WorkSystem>,
    ) -> Option<WorkSystem> {
        let numbers = self.rules.systems.as_ref().filter(|numbers| numbers.code == code);
        let Some((numbers, slot)) = numbers.zip(self.words.values.peek(b'P')) else {
            if default.is_none() {
                let word = codes::name('G', code);
                self.report(block, &say::NEEDS, span, |d| d.quoting("word", word).quoting("missing", "P"));
            }
            return default;
        };
        self.words.values.take(b'P');
        let number = whole_number(slot.value).filter(|number| (1..=numbers.most).contains(number));
        let system = number.and_then(|number| match number.checked_sub(numbers.regular) {
            None | Some(0) => WorkSystem::from_number(number),
            Some(additional) => WorkSystem::additional(additional),
        });
        if system.is_none() {
            self.report_out_of_range(block, "P", slot, &limits::SYSTEMS);
        }
        system
    }

    /// Returns the name of a system on this control: its word, or the value of P that selects it.
    fn system_name(&self, system: WorkSystem) -> String {
        let regular = self.rules.systems.as_ref().map_or(0, |numbers| numbers.regular);
        match u32::from(system.number()).checked_sub(9) {
            Some(additional) if additional > 0 => format!("P{}", additional + regular),
            _ => system.name().into_owned(),
        }
    }

    pub(super) fn select_system(&mut self, block: &Block<'_>, system: WorkSystem, span: Span) {
        let before = self.state.offsets.active;
        if before == system {
            return;
        }
        if !self.state.offsets.select(system) {
            let [name, base] = [system, before].map(|system| self.system_name(system));
            self.report(block, &say::OFFSET_UNKNOWN, span, |d| {
                d.quoting("system", name).quoting("base", base)
            });
        }
        let frame = self.state.offsets.frame(system);
        self.step(block, Action::System { system, frame });
    }
}

fn given_axes(coordinates: &[Option<Slot>; 3]) -> Axes {
    let given = (0..3).filter(|axis| coordinates[*axis].is_some());
    given.fold(Axes::NONE, |axes, axis| axes.with(Axes::of(axis)))
}

/// Maximum distance in mm between different ends at which an almost full circle is doubtful: their last digit decides whether nearly all of it
/// is milled or nearly nothing.
const NEAR_ENDS_DISTANCE: f64 = 0.002;

/// Maximum number of turns of an arc, so that a few bytes cannot describe days of milling. The message for a greater P states this number.
const MAX_TURNS: u32 = 100_000;

impl Interpreter<'_> {
    pub(super) fn arc(&mut self, block: &Block<'_>, clockwise: bool) {
        let plane = self.state.plane;
        let [first, second] = plane.axes();
        let coordinates = self.words.values.take_coordinates();
        if self.rules.arcs.axis_word && coordinates[first].is_none() && coordinates[second].is_none() {
            let axes = plane_words(plane, ["X", "Y", "Z"]);
            self.report(block, &say::ARC_WITHOUT_END, block.span(), |d| d.quoting("axes", axes));
        }
        let from = self.state.position;
        let to = self.target(coordinates);
        if !self.rules.arcs.helix && from.at[plane.third()] != to.at[plane.third()] {
            self.report(block, &say::HELIX_DOUBTFUL, block.span(), |d| d);
        }
        let extra_turns = self.extra_turns(block);
        let Some(centre) = self.centre(block, plane, clockwise, &from, &to) else {
            return self.omit_arc(to);
        };
        let arc = Arc { plane, centre, clockwise, extra_turns };
        if arc.radius(&from) == 0.0 {
            let words = plane_words(plane, ["I", "J", "K"]);
            self.report(block, &say::RADIUS_ZERO, block.span(), |d| d.quoting("centre", words));
            return self.omit_arc(to);
        }
        let mut movement = Move { from, to, shape: MoveShape::Arc(arc), pace: Pace::Feed(0.0), named: None };
        if from.known.and(to.known).has(plane.axes_of_plane()) {
            self.check_radii(block, &arc, &from, &to);
            self.check_ends(block, &arc, &movement);
        }
        movement.pace = Pace::Feed(self.feed(block, &movement));
        self.emit_move(block, movement);
    }

    /// Omits an impossible arc and continues as if the tool were at the arc's end.
    fn omit_arc(&mut self, to: Position) {
        self.state.position = to;
        self.mark_all_used();
    }

    /// Reads P, the number of turns, and returns the number of full turns in addition to the arc.
    fn extra_turns(&mut self, block: &Block<'_>) -> u32 {
        if !self.rules.arcs.turns {
            return 0;
        }
        let Some(slot) = self.words.values.take_slot(b'P') else { return 0 };
        if self.rules.unusual.turns {
            self.report(block, &say::OFF_IN_BUILDS, slot.span, |d| d.quoting("word", "P"));
        }
        match whole_number(slot.value) {
            Some(turns) if (1..=MAX_TURNS).contains(&turns) => turns - 1,
            _ => {
                self.report_out_of_range(block, "P", slot, &limits::TURNS);
                0
            }
        }
    }

    fn centre(
        &mut self,
        block: &Block<'_>,
        plane: Plane,
        clockwise: bool,
        from: &Position,
        to: &Position,
    ) -> Option<[f64; 2]> {
        let letters = plane.axes().map(|axis| b"IJK"[axis]);
        let words = plane_words(plane, ["I", "J", "K"]);
        let offsets = letters.map(|letter| self.words.values.take_slot(letter));
        self.take_zero_of_third_centre(plane, offsets.iter().any(Option::is_some));
        let radius = self.words.values.take_slot(b'R');
        match (offsets, radius) {
            ([None, None], None) => {
                self.report(block, &say::ARC_WITHOUT_CENTRE, block.span(), |d| d.quoting("centre", words));
                None
            }
            ([None, None], Some(radius)) => self.centre_by_radius(block, plane, clockwise, from, to, radius),
            (_, Some(radius)) => {
                self.report(block, &say::ARC_WITH_CENTRE_AND_RADIUS, radius.span, |d| {
                    d.quoting("centre", words)
                });
                Some(self.centre_by_offsets(plane, from, offsets))
            }
            ([None, _] | [_, None], None) if !self.state.incremental_centres => {
                let word = "G90.1";
                self.report(block, &say::NEEDS, block.span(), |d| {
                    d.quoting("word", word).quoting("missing", words)
                });
                None
            }
            _ => {
                self.check_centres_stated(block);
                Some(self.centre_by_offsets(plane, from, offsets))
            }
        }
    }

    /// Reports that the program has not stated what the centres of arcs count from, if the control may count from either point.
    fn check_centres_stated(&mut self, block: &Block<'_>) {
        if self.rules.arcs.centres_by_setting && !std::mem::replace(&mut self.state.stated.centres, true) {
            let word = "G91.1";
            self.report(block, &say::MODES_NOT_STATED, block.span(), |d| {
                d.quoting("words", word).quoting("taken", word)
            });
        }
    }

    /// Accepts a 0 for the centre word of the third axis. Any other value was probably meant for another plane; it remains unused, which is
    /// reported.
    fn take_zero_of_third_centre(&mut self, plane: Plane, has_centre: bool) {
        let letter = b"IJK"[plane.third()];
        let is_zero = self.words.values.peek(letter).is_some_and(|slot| slot.value == 0.0);
        if self.rules.arcs.ignores_third_centre && has_centre && is_zero {
            self.words.values.take_slot(letter);
        }
    }

    fn centre_by_offsets(&self, plane: Plane, from: &Position, offsets: [Option<Slot>; 2]) -> [f64; 2] {
        let is_absolute =
            !self.state.incremental_centres || (self.rules.layers && self.options.absolute_arc_centres);
        let [first, second] = plane.axes();
        let along = |axis: usize, slot: Option<Slot>| match slot {
            Some(slot) if is_absolute => slot.value * self.state.unit + self.state.offsets.shift(axis),
            Some(slot) => from.at[axis] + slot.value * self.state.unit,
            None => from.at[axis],
        };
        [along(first, offsets[0]), along(second, offsets[1])]
    }

    fn centre_by_radius(
        &mut self,
        block: &Block<'_>,
        plane: Plane,
        clockwise: bool,
        from: &Position,
        to: &Position,
        slot: Slot,
    ) -> Option<[f64; 2]> {
        let words = plane_words(plane, ["I", "J", "K"]);
        let (radius, is_long) = ((slot.value * self.state.unit).abs(), slot.value < 0.0);
        let (start, end) = (plane.project(&from.at), plane.project(&to.at));
        let chord = [end[0] - start[0], end[1] - start[1]];
        let length = libm::hypot(chord[0], chord[1]);
        if length == 0.0 {
            self.report(block, &say::RADIUS_FULL_CIRCLE, slot.span, |d| d.quoting("centre", words));
            return None;
        }
        let half = length / 2.0;
        if half > radius + self.rules.arcs.short_radius {
            self.report(block, &say::RADIUS_TOO_SMALL, slot.span, |d| {
                d.with("radius", radius).with("chord", length)
            });
        }
        let height = height_over_chord(radius, half);
        let arc = ArcByRadius { radius, half_chord: half, unit: self.state.unit, decimals: slot.decimals };
        self.half_circles.add_arc(arc, SourcePosition::block(block, slot.span));
        // The centre of a short clockwise arc is to the right of its chord.
        let side = if clockwise == is_long { -height / length } else { height / length };
        Some([
            f64::midpoint(start[0], end[0]) + side * chord[1],
            f64::midpoint(start[1], end[1]) - side * chord[0],
        ])
    }

    fn check_radii(&mut self, block: &Block<'_>, arc: &Arc, from: &Position, to: &Position) {
        let (start, end) = (arc.radius(from), arc.radius(to));
        let difference = libm::fabs(start - end);
        let most = match self.rules.arcs.radius {
            RadiusTolerance::Fixed { inch, .. } if self.state.unit == INCH => inch,
            RadiusTolerance::Fixed { mm, .. } => mm,
            RadiusTolerance::Relative { most, least, share } => most.min(least.max(share * start.max(end))),
        };
        if difference > most {
            let words = plane_words(arc.plane, ["I", "J", "K"]);
            self.report(block, &say::RADII_DIFFER, block.span(), |d| {
                let d = d.with("start", start).with("end", end).with("difference", difference - most);
                d.quoting("centre", words)
            });
        }
    }

    fn check_ends(&mut self, block: &Block<'_>, arc: &Arc, movement: &Move) {
        let (start, end) = (arc.plane.project(&movement.from.at), arc.plane.project(&movement.to.at));
        let gap = libm::hypot(end[0] - start[0], end[1] - start[1]);
        if gap > 0.0
            && gap <= NEAR_ENDS_DISTANCE
            && arc.sweep(&movement.from, &movement.to) > std::f64::consts::PI
        {
            let degrees = libm::round(arc.sweep(&movement.from, &movement.to).to_degrees());
            self.report(block, &say::NEAR_FULL_CIRCLE, block.span(), |d| {
                d.with("gap", gap).with("degrees", degrees)
            });
        }
    }
}

fn plane_words(plane: Plane, letters: [&str; 3]) -> String {
    let [first, second] = plane.axes();
    format!("{}, {}", letters[first.min(second)], letters[first.max(second)])
}
