//! The numbers that registers have in a move.

use super::registers::Register;

/// The numbers that registers have in a move.
#[derive(Debug, Default)]
pub(super) struct MoveValues {
    registers: [Option<f64>; Register::ALL.len()],
    /// The arc that the move is.
    pub(super) arc: Option<ArcValues>,
}

/// The numbers of an arc: a length in the unit that is written, and degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcValues {
    pub(super) radius: f64,
    pub(super) start: f64,
    pub(super) end: f64,
    /// Clockwise is positive.
    pub(super) sweep: f64,
}

impl MoveValues {
    pub(super) fn get(&self, register: Register) -> Option<f64> {
        self.registers[register as usize]
    }

    pub(super) fn set(&mut self, register: Register, value: Option<f64>) {
        self.registers[register as usize] = value;
    }
}
