//! The modal state of a control, and the options for interpreting a file.

use pathbuild_motion::{Axes, Coolant, Frame, Plane, Position, Spindle, WorkSystem};

use super::codes::{FeedUnit, Motion};
use crate::dialect::{Rules, StartMotion};

/// Length of an inch in mm.
pub(crate) const INCH: f64 = 25.4;

#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent modes")]
pub(super) struct State {
    pub(super) position: Position,
    /// The axes whose position has been specified since the last tool change; all axes before the first tool change.
    pub(super) stated_axes: Axes,
    /// The axes along which the program has moved to a stated position since the last tool change or stop for the operator and, along Z, since the
    /// last change of the tool length; before the first of these, all axes.
    pub(super) stated_since_stop: Axes,
    /// The axes whose position G92 or G10 L20 has stated since the last tool change or stop for the operator.
    pub(super) zeroed_since_stop: Axes,
    /// Line and code (times ten) of a move to a machine position that is unknown in the program's coordinates.
    pub(super) lost: Option<(u32, u16)>,
    /// Whether a move at feed has been made.
    pub(super) has_cut: bool,
    /// Whether a rapid move has raised the tool since the last cut, or nothing has been cut yet.
    pub(super) is_lifted: bool,
    /// Line and code (times ten) of a move to the reference switches after the first cut, until the next cut.
    pub(super) referenced: Option<(u32, u16)>,
    /// The word that has cleared a zero which the operator had touched off, until a cut follows or the zero is set again.
    pub(super) cleared_zero: Option<ClearedZero>,
    pub(super) motion: Motion,
    /// Code of the motion (times ten), for messages.
    pub(super) motion_code: u16,
    /// The motion that was in effect before the drilling cycle, and its code (times ten).
    pub(super) motion_before_cycle: (Motion, u16),
    pub(super) plane: Plane,
    pub(super) incremental: bool,
    pub(super) incremental_centres: bool,
    /// Length of the program's unit in mm.
    pub(super) unit: f64,
    pub(super) feed_unit: FeedUnit,
    /// F in the unit given by [`feed_unit`](Self::feed_unit), with lengths in mm.
    pub(super) feed: f64,
    /// The line that stated F, with the unit in effect there; `None` if F is an inverse time, or the line has been reported.
    pub(super) feed_stated: Option<StatedLength>,
    /// Line and code (times ten) of the feed mode word that cleared F.
    pub(super) feed_cleared: Option<(u32, u16)>,
    pub(super) spindle: Spindle,
    pub(super) coolant: Coolant,
    /// The number of the last T word.
    pub(super) tool: Option<u32>,
    /// Number of the selected layer (XpertMILL).
    pub(super) layer: u32,
    /// Spindle speeds of the layers, each with the number of its layer.
    pub(super) layer_speeds: Vec<(u32, f64)>,
    /// Feed of the last rapid move in mm/min, if it depends on F.
    pub(super) rapid_feed: Option<f64>,
    /// Whether holes retract to R (G99). A program that does not state the mode may find either, and R is the more dangerous one.
    pub(super) retract_to_r: bool,
    /// The line of a tool change at which a drilling cycle was in effect, if there has been no motion word since then.
    pub(super) change_within_cycle: Option<u32>,
    /// The line that stated the active G52 or G92, with the unit in effect there.
    pub(super) shift_stated: Option<StatedLength>,
    pub(super) cycle: CycleState,
    pub(super) offsets: Offsets,
    pub(super) stated: StatedModes,
}

/// A line of the program that stated lengths, and the unit in mm in effect there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StatedLength {
    pub(super) line: u32,
    pub(super) unit: f64,
}

/// A G92.1 or G92.2 that clears a zero which the operator had touched off.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClearedZero {
    pub(super) line: u32,
    /// Number of the G code times ten.
    pub(super) code: u16,
    /// The axes whose positions are unknown from here on.
    pub(super) axes: Axes,
    /// Whether a rapid move has gone to a position on one of these axes since.
    pub(super) has_moved: bool,
}

/// The values of a drilling cycle, which are kept until a word sets another motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CycleState {
    /// Position before the first cycle of the series.
    pub(super) initial: [f64; 3],
    /// R as a height in mm.
    pub(super) r: Option<f64>,
    /// Z as a height in mm.
    pub(super) z: Option<f64>,
    /// P, the dwell in seconds.
    pub(super) p: Option<f64>,
    /// Q, the depth of a peck in mm.
    pub(super) q: Option<f64>,
    /// The last line that stated R, Z or Q.
    pub(super) stated: Option<StatedLength>,
}

/// The settings that the program has specified, and the missing ones that have been reported.
#[derive(Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub(super) struct StatedModes {
    pub(super) units: bool,
    pub(super) distance: bool,
    pub(super) plane: bool,
    pub(super) centres: bool,
    pub(super) retract_mode: bool,
    pub(super) feed_missing: bool,
    pub(super) program_number: bool,
    /// Whether a refused change of the unit has been reported.
    pub(super) other_unit: bool,
    /// Whether a low height of G53 has been reported.
    pub(super) machine_height: bool,
}

impl State {
    pub(super) fn new(rules: &Rules, offsets: Option<&MachineOffsets>) -> Self {
        Self {
            position: Position::default(),
            stated_axes: Axes::ALL,
            stated_since_stop: Axes::ALL,
            zeroed_since_stop: Axes::NONE,
            lost: None,
            has_cut: false,
            is_lifted: true,
            referenced: None,
            cleared_zero: None,
            motion: match rules.start_motion {
                StartMotion::Rapid => Motion::Rapid,
                StartMotion::None => Motion::None,
            },
            motion_code: 0,
            motion_before_cycle: (Motion::None, 0),
            plane: Plane::Xy,
            incremental: false,
            incremental_centres: true,
            unit: 1.0,
            feed_unit: FeedUnit::PerMinute,
            feed: 0.0,
            feed_stated: None,
            feed_cleared: None,
            spindle: Spindle::UNSTATED,
            coolant: Coolant::default(),
            tool: None,
            layer: 1,
            layer_speeds: Vec::new(),
            rapid_feed: None,
            retract_to_r: rules.words.has_g(990),
            change_within_cycle: None,
            shift_stated: None,
            cycle: CycleState::default(),
            offsets: Offsets::new(offsets),
            stated: StatedModes::default(),
        }
    }
}

impl State {
    /// Returns the coordinate of the tool along an axis in the program's system and unit, if the program determines it.
    pub(super) fn coordinate(&self, axis: usize) -> Option<f64> {
        let is_known = self.position.known.and(self.stated_axes).has(Axes::of(axis));
        is_known.then(|| (self.position.at[axis] - self.offsets.shift(axis)) / self.unit)
    }

    /// Forgets which positions are stated, because the operator may move the axes or change the tool.
    pub(super) fn forget_stated_positions(&mut self) {
        self.stated_since_stop = Axes::NONE;
        self.zeroed_since_stop = Axes::NONE;
        self.offsets.clear_reference_length();
    }

    /// Returns the axes on which the program knows where the tool is: it has stated the position since the last stop, and no probe has made contact
    /// since.
    pub(super) fn located_axes(&self) -> Axes {
        self.position.known.and(self.stated_since_stop.with(self.zeroed_since_stop))
    }
}

/// The active and the stored offsets, in mm.
#[derive(Debug)]
pub(super) struct Offsets {
    systems: [System; WorkSystem::COUNT],
    pub(super) active: WorkSystem,
    /// Offset of G92, which is added to the active system.
    origin: [f64; 3],
    /// The offset of G92 that G92.3 restores; `None` until the program sets it, because the control keeps the offset of the previous program.
    saved: Option<[f64; 3]>,
    /// The axes whose offset of G92 only the machine knows, because the operator, or a probe, has moved the tool to the new zero.
    pub(super) touched_off: Axes,
    /// Offset of G52.
    local: [f64; 3],
    length: AppliedLength,
    /// The sum of all offsets at the first move; `None` until then.
    base: Option<[f64; 3]>,
    /// The system that was active at the first move.
    first: Option<WorkSystem>,
    /// Number of times that the operator has moved the zero in the plane.
    zero_moves: u32,
    /// Whether `base` is known in machine coordinates.
    is_base_known: bool,
    home: [Option<[f64; 3]>; 2],
    /// Whether the offsets come from the configuration.
    is_configured: bool,
}

#[derive(Clone, Copy, Debug, Default)]
struct System {
    zero: [f64; 3],
    origin: SystemOrigin,
}

/// Whether the origin of a coordinate system is known, and in which coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum SystemOrigin {
    #[default]
    Unknown,
    /// Known in machine coordinates, from the configuration or from G10 L2.
    Machine,
    /// Known relative to the positions of the program, from G10 L20.
    Program,
}

impl Offsets {
    pub(super) fn new(configured: Option<&MachineOffsets>) -> Self {
        let system = |index: usize| {
            let zero = configured.and_then(|offsets| offsets.systems.get(index)).copied();
            let origin = if zero.is_some() { SystemOrigin::Machine } else { SystemOrigin::Unknown };
            System { zero: zero.unwrap_or_default(), origin }
        };
        Self {
            systems: std::array::from_fn(system),
            active: WorkSystem::default(),
            origin: [0.0; 3],
            saved: None,
            touched_off: Axes::NONE,
            local: [0.0; 3],
            length: AppliedLength::default(),
            base: None,
            first: None,
            zero_moves: 0,
            is_base_known: false,
            home: [0, 1].map(|index| configured.map(|offsets| offsets.home[index])),
            is_configured: configured.is_some(),
        }
    }

    /// Makes the current origin the zero of all positions, unless that zero has been fixed before.
    pub(super) fn fix_base(&mut self) {
        if self.base.is_none() {
            self.base = Some(self.sum());
            self.first = Some(self.active);
            self.is_base_known = self.systems[self.active.index()].origin == SystemOrigin::Machine;
        }
    }

    pub(super) fn is_fixed(&self) -> bool {
        self.base.is_some()
    }

    pub(super) fn is_fixed_to_machine(&self) -> bool {
        self.is_fixed() && self.is_base_known
    }

    pub(super) fn is_shifted_by_origin(&self) -> bool {
        self.origin != [0.0; 3]
    }

    pub(super) fn local(&self, axis: usize) -> f64 {
        self.local[axis]
    }

    /// Returns the amount added to an axis value of the program to get its position.
    pub(super) fn shift(&self, axis: usize) -> f64 {
        self.sum()[axis] - self.base(axis) + self.length.shift(axis)
    }

    /// Sets the tool length along all axes; `None` if only the machine knows it.
    pub(super) fn set_length(&mut self, length: Option<f64>) {
        self.length.current = [length; 3];
    }

    /// Sets the tool length along the axes for which the entry is `Some`.
    pub(super) fn set_length_along(&mut self, lengths: [Option<f64>; 3]) {
        for (current, new) in self.length.current.iter_mut().zip(lengths) {
            *current = new.or(*current);
        }
    }

    /// Whether the tool has cut with a length that is unknown along an axis, so another length displaces its tip by an unknown amount.
    pub(super) fn is_length_unknown(&self, axis: usize) -> bool {
        self.length.at_cut.is_some_and(|lengths| lengths[axis].is_none())
    }

    pub(super) fn has_cut_with_length(&self) -> bool {
        self.length.at_cut.is_some()
    }

    /// Makes the current tool length the reference for all positions of this tool, unless a reference has been fixed before.
    pub(super) fn set_reference_length(&mut self) {
        self.length.at_cut.get_or_insert(self.length.current);
    }

    /// Discards the reference length, because another tool with a length of its own may be in the spindle.
    pub(super) fn clear_reference_length(&mut self) {
        self.length.at_cut = None;
    }

    /// Activates a system. Returns false if its origin is unknown and the program has moved in another system.
    pub(super) fn select(&mut self, system: WorkSystem) -> bool {
        let is_other = self.active != system;
        self.active = system;
        !is_other || self.base.is_none() || self.is_placed(system)
    }

    /// Whether the origin of a system is known relative to that of the program's first system.
    fn is_placed(&self, system: WorkSystem) -> bool {
        match self.systems[system.index()].origin {
            SystemOrigin::Unknown => false,
            SystemOrigin::Machine => self.is_base_known,
            SystemOrigin::Program => true,
        }
    }

    /// Returns the frame of a system: that of the program's first system if the position relative to it is known.
    pub(super) fn frame(&self, system: WorkSystem) -> Frame {
        let system = self.first.filter(|_| self.is_placed(system)).unwrap_or(system);
        Frame { system, zero_moves: self.zero_moves }
    }

    /// Begins another frame in the active system, because the operator has set its zero in the plane. Positions before cannot be compared with those
    /// after.
    pub(super) fn begin_frame(&mut self) -> Frame {
        self.zero_moves += 1;
        self.frame(self.active)
    }

    /// Marks the position of a system as unknown, because the operator has moved the tool to the place whose coordinate G10 L20 sets.
    pub(super) fn mark_position_unknown(&mut self, system: WorkSystem) {
        self.systems[system.index()].origin = SystemOrigin::Unknown;
    }

    /// Executes G10 L2: sets the origin of a system in machine coordinates. Returns false if the system is active and the preceding positions are not
    /// known in machine coordinates.
    pub(super) fn place(&mut self, system: Option<WorkSystem>, axis: usize, at: f64) -> bool {
        let system = system.unwrap_or(self.active);
        self.set_zero(system, axis, at, SystemOrigin::Machine);
        system != self.active || self.base.is_none() || self.is_base_known
    }

    fn set_zero(&mut self, system: WorkSystem, axis: usize, at: f64, origin: SystemOrigin) {
        let system = &mut self.systems[system.index()];
        system.zero[axis] = at;
        system.origin = origin;
    }

    /// Executes G10 L20: sets the coordinate of the tool in a system.
    pub(super) fn place_here(&mut self, system: Option<WorkSystem>, axis: usize, coordinate: f64, here: f64) {
        let here = here - self.length.shift(axis);
        let zero = here + self.base(axis) - self.origin[axis] - self.local[axis] - coordinate;
        let origin = if self.is_base_known { SystemOrigin::Machine } else { SystemOrigin::Program };
        self.set_zero(system.unwrap_or(self.active), axis, zero, origin);
    }

    /// Executes G92: sets the coordinate of the tool at this position.
    pub(super) fn set_origin(&mut self, axis: usize, coordinate: f64, here: f64) {
        self.origin[axis] = here - self.length.shift(axis) + self.base(axis)
            - self.systems[self.active.index()].zero[axis]
            - self.local[axis]
            - coordinate;
        self.saved = Some(self.origin);
    }

    /// Executes G92.2, which keeps the offset for G92.3, if `resumable`; otherwise G92.1.
    pub(super) fn clear_origin(&mut self, resumable: bool) {
        if !resumable {
            self.saved = Some([0.0; 3]);
            self.touched_off = Axes::NONE;
        }
        self.origin = [0.0; 3];
    }

    /// Executes G92.3. Returns false if only the control knows the offset that it restores.
    pub(super) fn resume_origin(&mut self) -> bool {
        self.origin = self.saved.unwrap_or(self.origin);
        self.saved.is_some()
    }

    /// Executes G52: sets the local offset of an axis.
    pub(super) fn set_local(&mut self, axis: usize, offset: f64) {
        self.local[axis] = offset;
    }

    /// Converts a machine coordinate to a position, if the machine's origin is known.
    pub(super) fn position_of_machine_coordinate(&self, axis: usize, coordinate: f64) -> Option<f64> {
        self.is_configured.then(|| coordinate - self.base(axis))
    }

    /// Executes G28.1 or G30.1: stores a position, if it is completely known.
    pub(super) fn store_home(&mut self, which: usize, here: &Position) {
        self.home[which] =
            (here.known == Axes::ALL).then(|| std::array::from_fn(|axis| here.at[axis] + self.base(axis)));
    }

    /// Returns the target of G28 or G30 along an axis, if it is known.
    pub(super) fn home(&self, which: usize, axis: usize) -> Option<f64> {
        self.home[which].map(|at| at[axis] - self.base(axis))
    }

    fn base(&self, axis: usize) -> f64 {
        self.base.unwrap_or_else(|| self.sum())[axis]
    }

    fn sum(&self) -> [f64; 3] {
        let zero = self.systems[self.active.index()].zero;
        std::array::from_fn(|axis| zero[axis] + self.origin[axis] + self.local[axis])
    }
}

/// The tool lengths along the axes, in mm; `None` where only the machine knows them.
#[derive(Debug, Default)]
struct AppliedLength {
    current: [Option<f64>; 3],
    /// The lengths at the first cut of the tool in the spindle; `None` before it.
    at_cut: Option<[Option<f64>; 3]>,
}

impl AppliedLength {
    /// Returns the distance by which changes of the length have moved the tip since the first cut, as far as it is known.
    fn shift(&self, axis: usize) -> f64 {
        let at_cut = self.at_cut.and_then(|lengths| lengths[axis]);
        self.current[axis].zip(at_cut).map_or(0.0, |(current, at_cut)| current - at_cut)
    }
}

/// Options for interpreting a file. The default relies on the file alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The height that a number with a correction formula represents.
    pub heights: Heights,
    /// The offsets of the machine, if they are known.
    pub offsets: Option<MachineOffsets>,
    /// XpertMILL: meaning of G70 and G71.
    pub unit_codes: UnitCodes,
    /// XpertMILL: whether I and J are the centre itself instead of its distance from the start of the arc.
    pub absolute_arc_centres: bool,
    /// XpertMILL: whether F is ignored, so that the feeds of the layers apply.
    pub ignore_feed: bool,
    /// Mach3: whether P of G4 is in milliseconds.
    pub milliseconds: bool,
}

impl Options {
    /// Returns the G codes (times ten) for inches and for millimetres.
    pub fn unit_words(&self, rules: &Rules) -> [u16; 2] {
        let [inch, mm] = rules.unit_words;
        if rules.layers && self.unit_codes == UnitCodes::Table { [mm, inch] } else { [inch, mm] }
    }
}

/// The height that is read from `Z1.023(==1.000+0.5*[#51-2.000])`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heights {
    /// The number before the formula, to which the tool moves.
    #[default]
    AsWritten,
    /// The number before the formula minus the correction, which is the difference between the formula's values with the measured and with the drawn
    /// heights. The tool would move to this height if the material were as thick as drawn.
    Nominal,
}

/// Meaning of G70 and G71. (book: program/reading)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UnitCodes {
    /// G70 is inches and G71 millimetres, as in DIN 66025 and in the examples of XpertMILL's import filter.
    #[default]
    Din,
    /// G70 is millimetres and G71 inches, as in the table of codes of XpertMILL's import filter.
    Table,
}

/// The origins of coordinate systems and the named positions, in machine coordinates and mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MachineOffsets {
    /// The origins of G54, G55 ... G59, G59.1, G59.2, G59.3.
    pub systems: [[f64; 3]; 9],
    /// The targets of G28 and G30.
    pub home: [[f64; 3]; 2],
}
