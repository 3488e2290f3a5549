//! Arcs given by I J K or R. (book: program/reading)

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Arc, Move, MoveShape, Pace, Plane, Position};

use super::execute::{Interpreter, Slot, limits, whole};
use super::state::INCH;
use crate::dialect::RadiusTolerance;
use crate::read::{Block, Span};

/// An arc of almost 180 degrees given by R is doubtful if the last digit of R moves its centre by more than this, in mm.
const CENTRE_SHIFT: f64 = 0.05;

/// If the ends are different but closer than this, in mm, an almost full circle is doubtful, because the last digit decides.
const NEAR_ENDS: f64 = 0.002;

/// Maximum number of turns of an arc, so that a few bytes cannot describe days of milling. The message for a greater P contains it.
const MOST_TURNS: u32 = 100_000;

impl Interpreter<'_> {
    pub(super) fn arc(&mut self, block: &Block<'_>, clockwise: bool) {
        let plane = self.state.plane;
        let [first, second] = plane.axes();
        let coordinates = self.words.values.take_coordinates();
        if self.rules.arcs.axis_word && coordinates[first].is_none() && coordinates[second].is_none() {
            let axes = plane_words(plane, ["X", "Y", "Z"]);
            self.report(block, &say::ARC_WITHOUT_END, whole_line(block), |d| d.quoting("axes", axes));
        }
        if !self.rules.arcs.helix
            && coordinates[plane.third()].is_some_and(|slot| self.leaves_plane(slot, plane))
        {
            self.report(block, &say::HELIX_DOUBTFUL, whole_line(block), |d| d);
        }
        let from = self.state.position;
        let to = self.target(coordinates);
        let extra_turns = self.turns(block);
        let Some(centre) = self.centre(block, plane, clockwise, &from, &to) else {
            return self.leave_out(to);
        };
        let arc = Arc { plane, centre, clockwise, extra_turns };
        if arc.radius(&from) == 0.0 {
            self.report(block, &say::RADIUS_ZERO, whole_line(block), |d| d);
            return self.leave_out(to);
        }
        let mut movement = Move { from, to, shape: MoveShape::Arc(arc), pace: Pace::Feed(0.0), named: None };
        if from.known.and(to.known).has(plane.axes_of_plane()) {
            self.check_radii(block, &arc, &from, &to);
            self.check_ends(block, &arc, &movement);
        }
        movement.pace = Pace::Feed(self.feed(block, &movement));
        self.emit_move(block, movement);
    }

    /// Omits an impossible arc. The tool is assumed to be at its end.
    fn leave_out(&mut self, to: Position) {
        self.state.position = to;
        self.use_all_words();
    }

    fn leaves_plane(&self, slot: Slot, plane: Plane) -> bool {
        self.state.incremental && slot.value != 0.0
            || self.millimetres(slot) + self.state.offsets.shift(plane.third())
                != self.state.position.at[plane.third()]
    }

    /// Number of full turns in addition to the arc, from P.
    fn turns(&mut self, block: &Block<'_>) -> u32 {
        if !self.rules.arcs.turns {
            return 0;
        }
        let Some(slot) = self.words.values.take_slot(b'P') else { return 0 };
        match whole(slot.value) {
            Some(turns) if (1..=MOST_TURNS).contains(&turns) => turns - 1,
            _ => {
                self.out_of_range(block, "P", slot, &limits::TURNS);
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
        let radius = self.words.values.take_slot(b'R');
        match (offsets, radius) {
            ([None, None], None) => {
                self.report(block, &say::ARC_WITHOUT_CENTRE, whole_line(block), |d| {
                    d.quoting("centre", words)
                });
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
                self.report(block, &say::NEEDS, whole_line(block), |d| {
                    d.quoting("word", word).quoting("missing", words)
                });
                None
            }
            _ => Some(self.centre_by_offsets(plane, from, offsets)),
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
        let unit_of_last_digit = self.state.unit * libm::pow(10.0, -f64::from(slot.decimals));
        let shift = height_over_chord(radius + unit_of_last_digit, half) - height;
        if shift > CENTRE_SHIFT && half <= radius {
            self.report(block, &say::NEAR_HALF_CIRCLE, slot.span, |d| d.with("shift", shift));
        }
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
            self.report(block, &say::RADII_DIFFER, whole_line(block), |d| {
                d.with("start", start).with("end", end).with("difference", difference - most)
            });
        }
    }

    fn check_ends(&mut self, block: &Block<'_>, arc: &Arc, movement: &Move) {
        let (start, end) = (arc.plane.project(&movement.from.at), arc.plane.project(&movement.to.at));
        let gap = libm::hypot(end[0] - start[0], end[1] - start[1]);
        if gap > 0.0 && gap <= NEAR_ENDS && arc.sweep(&movement.from, &movement.to) > std::f64::consts::PI {
            let degrees = libm::round(arc.sweep(&movement.from, &movement.to).to_degrees());
            self.report(block, &say::NEAR_FULL_CIRCLE, whole_line(block), |d| {
                d.with("gap", gap).with("degrees", degrees)
            });
        }
    }
}

/// Distance from the centre of an arc to its chord.
fn height_over_chord(radius: f64, half_chord: f64) -> f64 {
    libm::sqrt((radius * radius - half_chord * half_chord).max(0.0))
}

fn plane_words(plane: Plane, letters: [&str; 3]) -> String {
    let [first, second] = plane.axes();
    format!("{}, {}", letters[first.min(second)], letters[first.max(second)])
}

fn whole_line(block: &Block<'_>) -> Span {
    Span::new(0, block.text.len())
}
