//! Coordinate systems, G92, G52, G28, G30: converts numbers of the program to positions. (book: program/reading)
//!
//! Positions are given in the coordinate system that is active at the first move. The file does not tell where its origin is on the
//! machine, so
//! machine coordinates are only known if they are configured.

use pathbuild_motion::{Axes, Position, WorkSystem};

use super::options::MachineOffsets;

/// The active and the stored offsets, in mm.
#[derive(Debug)]
pub(super) struct Offsets {
    systems: [System; 9],
    active: WorkSystem,
    /// G92, which is added to the active system.
    origin: [f64; 3],
    suspended: [f64; 3],
    /// G52.
    local: [f64; 3],
    /// The sum of all offsets at the first move; `None` until then.
    base: Option<[f64; 3]>,
    home: [Option<[f64; 3]>; 2],
    /// Whether the configuration contains the offsets.
    is_configured: bool,
}

#[derive(Clone, Copy, Debug, Default)]
struct System {
    zero: [f64; 3],
    /// Whether the origin is known, from the configuration or from G10.
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

    /// Fixes the current origin as that of all positions.
    pub(super) fn fix_base(&mut self) {
        if self.base.is_none() {
            self.base = Some(self.sum());
        }
    }

    /// The amount added to the program's number of an axis to get its position.
    pub(super) fn shift(&self, axis: usize) -> f64 {
        self.sum()[axis] - self.base(axis)
    }

    /// Activates a system. Returns false if its origin is unknown and the program has moved in another system.
    pub(super) fn select(&mut self, system: WorkSystem) -> bool {
        let is_other = self.active != system;
        self.active = system;
        !is_other || self.base.is_none() || self.systems[system.index()].is_known
    }

    /// G10 L2: sets the origin of a system in machine coordinates.
    pub(super) fn place(&mut self, system: Option<WorkSystem>, axis: usize, at: f64) {
        let system = &mut self.systems[system.unwrap_or(self.active).index()];
        system.zero[axis] = at;
        system.is_known = true;
    }

    /// G10 L20: sets the coordinate of the tool in a system.
    pub(super) fn place_here(&mut self, system: Option<WorkSystem>, axis: usize, coordinate: f64, here: f64) {
        let zero = here + self.base(axis) - self.origin[axis] - self.local[axis] - coordinate;
        self.place(system, axis, zero);
    }

    /// G92: sets the coordinate of the tool at this position.
    pub(super) fn set_origin(&mut self, axis: usize, coordinate: f64, here: f64) {
        self.origin[axis] = here + self.base(axis)
            - self.systems[self.active.index()].zero[axis]
            - self.local[axis]
            - coordinate;
    }

    /// G92.1, and G92.2 if it can be resumed.
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

    /// Converts a machine coordinate to a position, if the machine's origin is known.
    pub(super) fn of_machine(&self, axis: usize, coordinate: f64) -> Option<f64> {
        self.is_configured.then(|| coordinate - self.base(axis))
    }

    /// G28.1, G30.1: stores a position, if it is completely known.
    pub(super) fn store_home(&mut self, which: usize, here: &Position) {
        self.home[which] =
            (here.known == Axes::ALL).then(|| std::array::from_fn(|axis| here.at[axis] + self.base(axis)));
    }

    /// The target of G28 or G30, as far as it is known.
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
