//! Expands drilling cycles into rapid moves to the holes and moves along the axis perpendicular to the plane. (RS274/NGC, 3.5.16)
//!
//! Names such as "height" and Z assume the plane XY, which is almost always the active one.

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Axes, Move, MoveShape, Pace, Position};

use super::codes::{self, Cycle, Motion};
use super::execute::{Interpreter, Slot, limits, whole_number};
use super::state::{CycleState, StatedLength};
use crate::read::Block;

/// Distance above the last depth at which a pecking cycle stops its rapid descent, and by which a chip-breaking cycle retracts: 0.010
/// inches, as in LinuxCNC. Posts drill with the same distance where they write the moves.
pub const PECK_CLEARANCE: f64 = 0.254;

/// Maximum number of moves per line, so that `Q0.000001 L99999` cannot exhaust the memory.
const MAX_MOVES_PER_LINE: f64 = 100_000.0;

/// The values of a cycle, in mm and seconds.
#[derive(Clone, Copy, Debug)]
struct Hole {
    cycle: Cycle,
    /// Height in mm at which the rapid descent above the material ends.
    r: f64,
    bottom: f64,
    /// Height in mm of the final retraction.
    clear: f64,
    /// Depth of a peck in mm.
    step: f64,
    dwell: f64,
}

impl Interpreter<'_> {
    /// Clears the values of the previous cycle. The initial height is kept for a whole series of cycles.
    pub(super) fn begin_cycle(&mut self, series_goes_on: bool) {
        let initial = if series_goes_on { self.state.cycle.initial } else { self.state.position.at };
        self.state.cycle = CycleState { initial, ..CycleState::default() };
    }

    pub(super) fn cycle(&mut self, block: &Block<'_>, cycle: Cycle) {
        let coordinates = self.words.values.take_coordinates();
        let axis = self.state.plane.third();
        if self.drills_nothing() {
            return self.move_without_drilling(block, coordinates);
        }
        let repeats = self.take_repeat_count(block);
        self.check_change_within_cycle(block);
        self.check_unit_of_cycle(block, coordinates[axis].is_some());
        self.store_cycle_words(block, coordinates[axis]);
        let Some(hole) = self.hole(block, cycle) else { return };
        self.check_retract_mode_stated(block, &hole);
        let retracted = self.retract_height();
        let mut old = self.approach_height();
        self.mark_axis_stated(axis);
        if old < hole.r && self.rules.rises_before_holes {
            self.lift_to(block, hole.r);
            old = hole.r;
        }
        let initial = if self.rules.rises_before_holes { retracted.max(hole.r) } else { retracted };
        let hole = Hole { clear: if self.state.retract_to_r { hole.r } else { initial }, ..hole };
        if f64::from(repeats) * moves_of(&hole) > MAX_MOVES_PER_LINE {
            let count = f64::from(repeats) * moves_of(&hole);
            return self.report(block, &say::TOO_MANY_STROKES, block.span(), |d| {
                d.with("count", count).with("most", MAX_MOVES_PER_LINE)
            });
        }
        for _ in 0..repeats {
            let over = self.position_over_hole(coordinates, old);
            self.rapid(block, over);
            if old != hole.r {
                self.lift_to(block, hole.r);
            }
            self.drill(block, &hole);
            old = hole.clear;
        }
    }

    /// Reports that the program has not stated the height to which holes retract, if it matters and the control keeps it from the previous program.
    fn check_retract_mode_stated(&mut self, block: &Block<'_>, hole: &Hole) {
        let is_same = self.state.cycle.initial[self.state.plane.third()] <= hole.r;
        if is_same || !self.rules.keeps_retract_mode {
            return;
        }
        if !std::mem::replace(&mut self.state.stated.retract_mode, true) {
            self.report(block, &say::RETRACT_NOT_STATED, block.span(), |d| d);
        }
    }

    /// Whether the line states 0 repetitions (K0, L0): it stores the cycle, or leads the tool around an obstacle, and drills nothing.
    fn drills_nothing(&self) -> bool {
        let repeats = self.words.values.peek(self.rules.repeats);
        self.rules.stores_cycles && repeats.is_some_and(|slot| slot.value == 0.0)
    }

    /// Stores the values of the cycle, and moves to the position in the line without drilling there.
    fn move_without_drilling(&mut self, block: &Block<'_>, coordinates: [Option<Slot>; 3]) {
        self.words.values.take(self.rules.repeats);
        let height = self.approach_height();
        self.store_cycle_words(block, coordinates[self.state.plane.third()]);
        if self.state.plane.axes().iter().any(|axis| coordinates[*axis].is_some()) {
            let over = self.position_over_hole(coordinates, height);
            self.rapid(block, over);
        }
    }

    /// Returns the position over a hole, at a height in mm.
    fn position_over_hole(&mut self, mut coordinates: [Option<Slot>; 3], height: f64) -> Position {
        let axis = self.state.plane.third();
        coordinates[axis] = None;
        let mut over = self.target(coordinates);
        over.at[axis] = height;
        over.known = over.known.with(Axes::of(axis));
        over
    }

    /// Reports the first hole of a cycle that was in effect before a tool change.
    fn check_change_within_cycle(&mut self, block: &Block<'_>) {
        let Some(line) = self.state.change_within_cycle.take() else { return };
        let word = codes::name('G', self.state.motion_code);
        self.report(block, &say::CYCLE_LEFT_ON, block.span(), |d| {
            d.quoting("word", word).with("line", u64::from(line))
        });
    }

    /// Reports the first hole whose R, Z or Q was stated before the unit changed. LinuxCNC keeps these numbers: `Z-2` in mm becomes `Z-2` in inches.
    fn check_unit_of_cycle(&mut self, block: &Block<'_>, is_z_given: bool) {
        let CycleState { r, z, q, stated, .. } = self.state.cycle;
        let Some(stated) = stated.filter(|stated| stated.unit != self.state.unit) else { return };
        let (has_r, has_q) = (self.words.values.has(b'R'), self.words.values.has(b'Q'));
        let kept = [("R", r, has_r), ("Z", z, is_z_given), ("Q", q, has_q)];
        let kept = kept.iter().filter(|(_, value, is_given)| value.is_some() && !is_given);
        let letters: Vec<&str> = kept.map(|(letter, ..)| *letter).collect();
        if letters.is_empty() {
            return;
        }
        self.state.cycle.stated = None;
        self.report_other_unit(block, &say::CYCLE_IN_OTHER_UNIT, stated, |d| {
            d.quoting("word", letters.join(", "))
        });
    }

    fn take_repeat_count(&mut self, block: &Block<'_>) -> u32 {
        let letter = self.rules.repeats;
        let Some(slot) = self.words.values.take_slot(letter) else { return 1 };
        match whole_number(slot.value) {
            Some(repeats) if repeats >= 1 => repeats,
            _ => {
                let letter = if letter == b'L' { "L" } else { "K" };
                self.report_out_of_range(block, letter, slot, &limits::HOLES);
                1
            }
        }
    }

    /// Stores R, Z, P and Q for this line and the following lines of the same cycle. R and Z are stored as heights, so that in relative mode the next
    /// line drills to the same depth.
    fn store_cycle_words(&mut self, block: &Block<'_>, z: Option<Slot>) {
        let shift = self.state.offsets.shift(self.state.plane.third());
        let old = self.retract_height();
        let r = self.words.values.take_slot(b'R').map(|slot| self.millimetres(slot));
        let q = self.take_cycle_word(b'Q').map(|slot| self.millimetres(slot));
        let p = self.take_cycle_word(b'P').map(|slot| self.seconds(block, slot));
        let z = z.map(|slot| self.millimetres(slot));
        let incremental = self.state.incremental;
        let stated = StatedLength { line: block.line, unit: self.state.unit };
        let kept = &mut self.state.cycle;
        if r.or(q).or(z).is_some() {
            kept.stated = Some(stated);
        }
        kept.r = r.map(|r| if incremental { old + r } else { r + shift }).or(kept.r);
        kept.z = z.map(|z| if incremental { kept.r.unwrap_or(old) + z } else { z + shift }).or(kept.z);
        kept.p = p.or(kept.p);
        kept.q = q.or(kept.q);
    }

    /// Returns P or Q, if the cycle takes it.
    fn take_cycle_word(&mut self, letter: u8) -> Option<Slot> {
        let takes = match (self.state.motion, letter) {
            (Motion::Cycle(Cycle::ChipBreaking | Cycle::Pecking), b'Q')
            | (Motion::Cycle(Cycle::Dwelling | Cycle::BoringDwelling), b'P') => true,
            _ => !self.rules.refuses_idle_words,
        };
        if takes { self.words.values.take_slot(letter) } else { None }
    }

    fn hole(&mut self, block: &Block<'_>, cycle: Cycle) -> Option<Hole> {
        let CycleState { r, z, p, q, .. } = self.state.cycle;
        let needs_step = matches!(cycle, Cycle::ChipBreaking | Cycle::Pecking);
        let needs_dwell = matches!(cycle, Cycle::Dwelling | Cycle::BoringDwelling);
        let missing = [
            ("R", r.is_none()),
            ("Z", z.is_none()),
            ("Q", needs_step && q.is_none()),
            ("P", needs_dwell && p.is_none()),
        ];
        if let Some((letter, _)) = missing.into_iter().find(|(_, is_missing)| *is_missing) {
            let word = codes::name('G', self.state.motion_code);
            self.report(block, &say::NEEDS, block.span(), |d| {
                d.quoting("word", word).quoting("missing", letter)
            });
            return None;
        }
        let step = if needs_step { q? } else { f64::INFINITY };
        let dwell = if needs_dwell { p? } else { 0.0 };
        if step <= 0.0 || dwell < 0.0 {
            let (word, value, limits) = if step <= 0.0 {
                ("Q", step, &limits::POSITIVE)
            } else {
                ("P", dwell, &limits::NOT_NEGATIVE)
            };
            self.report(block, &say::OUT_OF_RANGE, block.span(), |d| {
                d.quoting("word", word).with("value", value).with("limits", limits)
            });
            return None;
        }
        let (r, bottom) = (r?, z?);
        if bottom > r {
            self.report(block, &say::OUT_OF_RANGE, block.span(), |d| {
                d.quoting("word", "R").with("value", r).with("limits", &limits::NOT_BELOW_Z)
            });
            return None;
        }
        Some(Hole { cycle, r, bottom, clear: r, step, dwell })
    }

    /// Returns the height in mm to which the tool has risen from the previous hole: with G98, its height at the start of the series; with G99, its
    /// current height.
    fn retract_height(&self) -> f64 {
        let axis = self.state.plane.third();
        if self.state.retract_to_r { self.state.position.at[axis] } else { self.state.cycle.initial[axis] }
    }

    /// Returns the height at which the tool moves to the next hole.
    fn approach_height(&self) -> f64 {
        if self.rules.rises_on_way_to_holes {
            self.retract_height()
        } else {
            self.state.position.at[self.state.plane.third()]
        }
    }

    fn drill(&mut self, block: &Block<'_>, hole: &Hole) {
        let mut depth = hole.r - hole.step;
        while depth > hole.bottom {
            self.feed_to(block, depth);
            if hole.cycle == Cycle::Pecking {
                self.lift_to(block, hole.r);
            }
            self.lift_to(block, (depth + PECK_CLEARANCE).min(hole.r));
            depth -= hole.step;
        }
        self.feed_to(block, hole.bottom);
        if matches!(hole.cycle, Cycle::Dwelling | Cycle::BoringDwelling) {
            self.step(block, Action::Dwell(hole.dwell));
        }
        match hole.cycle {
            Cycle::Boring => self.feed_to(block, hole.r),
            Cycle::BoringDwelling => return self.feed_to(block, hole.clear),
            _ => {}
        }
        self.lift_to(block, hole.clear);
    }

    fn feed_to(&mut self, block: &Block<'_>, z: f64) {
        let movement = self.vertical(Pace::Feed(0.0), z);
        let feed = self.feed(block, &movement);
        self.emit_move(block, Move { pace: Pace::Feed(feed), ..movement });
    }

    fn lift_to(&mut self, block: &Block<'_>, z: f64) {
        let movement = self.vertical(Pace::Rapid, z);
        self.emit_move(block, movement);
    }

    fn vertical(&self, pace: Pace, z: f64) -> Move {
        let from = self.state.position;
        let mut to = from;
        let axis = self.state.plane.third();
        to.at[axis] = z;
        to.known = to.known.with(Axes::of(axis));
        Move { from, to, shape: MoveShape::Line, pace, named: None }
    }

    fn rapid(&mut self, block: &Block<'_>, to: Position) {
        let from = self.state.position;
        self.emit_move(block, Move { from, to, shape: MoveShape::Line, pace: Pace::Rapid, named: None });
    }
}

fn moves_of(hole: &Hole) -> f64 {
    5.0 + 3.0 * (hole.r - hole.bottom) / hole.step
}
