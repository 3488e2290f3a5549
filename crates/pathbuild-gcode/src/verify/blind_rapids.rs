//! Counts rapid moves whose start is unknown and that may therefore pass through material. (book: program/reading)
//!
//! After a move to a machine position, a tool change or a probe, and at the beginning of a program, the start of a move is known only in part. Only
//! its end is then compared with the map of the material. That suffices for a vertical move, and for a move above the material.

use pathbuild_motion::{Action, Axes, Move, NamedPosition, Pace, Position, Step};
use serde::{Deserialize, Serialize};

use super::height_map::RESIDUE_HEIGHT;
use super::material::Stock;
use crate::interpret::LOWEST_RETRACT;

/// Number and first line of the rapid moves with unknown start that may pass through material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BlindRapids {
    /// Number of blind rapid moves.
    pub count: usize,
    /// Line of the first blind rapid move.
    pub line: u32,
}

/// Rule that finds blind rapid moves: pass every step of a program, then call [`finish`](Self::finish).
#[derive(Debug)]
pub struct BlindRapidRules {
    /// The highest surface of the material, in mm.
    surface: f64,
    /// The axes that the program has stated since the last tool change.
    stated: Axes,
    /// Whether an unknown height is above everything, because the operator, a move to a machine position or a tool changer has raised the tool. False
    /// after a probe, and after a move down by a distance (G91).
    is_raised: bool,
    found: Option<BlindRapids>,
}

impl BlindRapidRules {
    /// Creates the rule for the beginning of a program; `None` if the height of the material is unknown.
    pub fn new(stock: &Stock) -> Option<Self> {
        let surface = stock.highest().filter(|surface| surface.is_finite())?;
        Some(Self { surface, stated: Axes::ALL, is_raised: true, found: None })
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        let stated = std::mem::replace(&mut self.stated, step.stated);
        match &step.action {
            Action::Move(movement) => {
                let is_low = is_low_in_machine(movement);
                let is_doubtful = match movement.named {
                    None => movement.pace == Pace::Rapid && self.is_blind(movement, stated),
                    // There may be material below a known position. At an unknown one, the machine is assumed to have a tool setter or a magazine.
                    Some(_) => is_low && known_axes(&movement.from, stated).has(Axes::XY),
                };
                if is_doubtful {
                    let found = self.found.get_or_insert(BlindRapids { count: 0, line: step.line });
                    found.count += 1;
                }
                let is_known = movement.to.known.has(Axes::Z);
                let descends = movement.named.is_none() && !is_known && movement.to.z() < movement.from.z();
                self.is_raised = match movement.pace {
                    Pace::Probe { .. } => false,
                    _ if is_low || descends => false,
                    _ => self.is_raised || movement.homes_z() || is_known,
                };
            }
            Action::ChangeTool(_) => self.is_raised = true,
            _ => {}
        }
    }

    /// Returns the blind rapid moves, if there are any.
    pub fn finish(self) -> Option<BlindRapids> {
        self.found
    }

    fn is_blind(&self, movement: &Move, stated: Axes) -> bool {
        let (from, to) = (known_axes(&movement.from, stated), known_axes(&movement.to, self.stated));
        let is_whole = from.and(to) == Axes::ALL;
        let is_vertical = movement.keeps_xy() && from.and(Axes::XY) == to.and(Axes::XY);
        let is_judged_by_end = is_vertical && to == Axes::ALL;
        let rises = is_vertical && from.and(to).has(Axes::Z) && movement.to.z() >= movement.from.z();
        if is_whole || is_judged_by_end || rises {
            return false;
        }
        let unknown = self.is_raised.then_some(f64::INFINITY);
        let height = |at: &Position, known: Axes| if known.has(Axes::Z) { Some(at.z()) } else { unknown };
        let is_above = |height: Option<f64>| height.is_some_and(|z| z >= self.surface - RESIDUE_HEIGHT);
        let begins_above = is_above(height(&movement.from, from)) || is_vertical;
        !(begins_above && is_above(height(&movement.to, to)))
    }
}

/// Whether a move ends at a machine height that is too low for a retract and unknown in program coordinates.
fn is_low_in_machine(movement: &Move) -> bool {
    let machine = matches!(movement.named, Some(NamedPosition::Machine(axes)) if axes.has(Axes::Z));
    // Where the program coordinate of a G53 move is unknown, its position holds the machine coordinate.
    machine && !movement.to.known.has(Axes::Z) && movement.to.z() < LOWEST_RETRACT
}

/// Returns the axes of a position that are known and that the program has stated since the last tool change.
fn known_axes(at: &Position, stated: Axes) -> Axes {
    at.known.and(stated)
}
