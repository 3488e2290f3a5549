//! Coordinate systems, G92, G52, G28, G30: from the program's numbers to places. (book: program/reading)
//!
//! Places are given in the coordinates that the program has at its first move. Where its zero lies on the machine is in no file, so
//! the machine's own coordinates are known only where they are configured.

use pathbuild_motion::{Axes, Position, WorkSystem};

use super::options::MachineOffsets;

/// The offsets that hold, and those that are stored, in mm.
#[derive(Debug)]
pub(super) struct Offsets {
    systems: [System; 9],
    active: WorkSystem,
    /// G92: added to the active system's.
    origin: [f64; 3],
    suspended: [f64; 3],
    /// G52.
    local: [f64; 3],
    /// The sum of all that when the program first moved; `None` until then.
    base: Option<[f64; 3]>,
    home: [Option<[f64; 3]>; 2],
    /// The configuration says where everything lies.
    is_configured: bool,
}

#[derive(Clone, Copy, Debug, Default)]
struct System {
    zero: [f64; 3],
    /// Where it lies is known, from the configuration or from G10.
    is_known: bool,
}

impl Offsets {
    pub(super) fn new(configured: Option<&MachineOffsets>) -> Self {
        let system = |index: usize| System {
            zero: configured.map_or([0.0; 3], |offsets| offsets.systems[index]),
            is_known: configured.is_some(),
        };
        Self {
            systems: std::array::from_fn(system),
            active: WorkSystem::default(),
            origin: [0.0; 3],
            suspended: [0.0; 3],
            local: [0.0; 3],
            base: None,
            home: [0, 1].map(|index| configured.map(|offsets| offsets.home[index])),
            is_configured: configured.is_some(),
        }
    }

    pub(super) fn active(&self) -> WorkSystem {
        self.active
    }

    /// From now on, places are counted from where zero is now.
    pub(super) fn fix_base(&mut self) {
        if self.base.is_none() {
            self.base = Some(self.sum());
        }
    }

    /// What is added to the program's number of an axis to give its place.
    pub(super) fn shift(&self, axis: usize) -> f64 {
        self.sum()[axis] - self.base(axis)
    }

    /// Makes a system the active one; false if where it lies is unknown while the program has moved in another.
    pub(super) fn select(&mut self, system: WorkSystem) -> bool {
        let is_other = self.active != system;
        self.active = system;
        !is_other || self.base.is_none() || self.systems[system.index()].is_known
    }

    /// G10 L2: the system's zero in machine coordinates.
    pub(super) fn place(&mut self, system: Option<WorkSystem>, axis: usize, at: f64) {
        let system = &mut self.systems[system.unwrap_or(self.active).index()];
        system.zero[axis] = at;
        system.is_known = true;
    }

    /// G10 L20: the tool is at this coordinate of the system.
    pub(super) fn place_here(&mut self, system: Option<WorkSystem>, axis: usize, coordinate: f64, here: f64) {
        let zero = here + self.base(axis) - self.origin[axis] - self.local[axis] - coordinate;
        self.place(system, axis, zero);
    }

    /// G92: the tool, at this place, is at this coordinate.
    pub(super) fn set_origin(&mut self, axis: usize, coordinate: f64, here: f64) {
        self.origin[axis] = here + self.base(axis)
            - self.systems[self.active.index()].zero[axis]
            - self.local[axis]
            - coordinate;
    }

    /// G92.1, and G92.2 if it may be resumed.
    pub(super) fn clear_origin(&mut self, resumable: bool) {
        self.suspended = if resumable { self.origin } else { [0.0; 3] };
        self.origin = [0.0; 3];
    }

    /// G92.3.
    pub(super) fn resume_origin(&mut self) {
        self.origin = self.suspended;
    }

    /// G52.
    pub(super) fn set_local(&mut self, axis: usize, offset: f64) {
        self.local[axis] = offset;
    }

    /// A machine coordinate as a place, where the machine's zero is known.
    pub(super) fn of_machine(&self, axis: usize, coordinate: f64) -> Option<f64> {
        self.is_configured.then(|| coordinate - self.base(axis))
    }

    /// G28.1, G30.1: remembers a place that is wholly known.
    pub(super) fn store_home(&mut self, which: usize, here: &Position) {
        self.home[which] =
            (here.known == Axes::ALL).then(|| std::array::from_fn(|axis| here.at[axis] + self.base(axis)));
    }

    /// Where G28 or G30 goes, as far as it is known.
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
