//! The values of the registers in a move.

use super::registers::Register;

/// The values of the registers in a move.
#[derive(Debug, Default)]
pub(super) struct MoveValues {
    registers: [Option<f64>; Register::ALL.len()],
    /// Set if the move is an arc.
    pub(super) arc: Option<ArcValues>,
}

/// The values of an arc: lengths in the output unit, angles in degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcValues {
    pub(super) radius: f64,
    pub(super) start: f64,
    pub(super) end: f64,
    /// Positive if clockwise.
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
