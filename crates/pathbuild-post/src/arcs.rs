//! Arcs as a post writes them: whole, in pieces, as chords, or with numbers that were rounded.

use std::f64::consts::PI;

use pathbuild_diagnostic::{Diagnostic, Point, messages::posts};
use pathbuild_motion::{Course, Move, Path, WrittenArc, widest_chord};

use super::job::Units;

/// Upper bound on the chords of an arc.
pub(crate) const MOST_CHORDS: u32 = 100_000;

/// How many lines stay within the tolerance in mm of an arc; `None` when they are too many.
pub(crate) fn chords(course: &Course, tolerance: f64) -> Option<u32> {
    let count = (course.sweep() / widest_chord(course.radius(), tolerance)).ceil().max(1.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    (count <= f64::from(MOST_CHORDS)).then_some(count as u32)
}

/// How many equal pieces of at most that angle (radians, not small) an arc takes.
pub(crate) fn pieces_of(course: &Course, widest: f64) -> u32 {
    (1..u32::from(u8::MAX))
        .find(|count| f64::from(*count) * widest >= course.sweep())
        .unwrap_or(u8::MAX.into())
}

/// Moves the centre of an arc as far from the end as from the start, if it is nearly that.
pub(crate) fn centre(it: &mut Move) {
    let Path::Arc(arc) = &mut it.path else { return };
    let difference = (arc.radius(&it.from) - arc.radius(&it.to)).abs();
    let [from, to] = [it.from, it.to].map(|end| arc.plane.project(&end.at));
    let chord = [to[0] - from[0], to[1] - from[1]];
    let square = chord[0] * chord[0] + chord[1] * chord[1];
    if !(WIDEST_OF_MM..=WIDEST_OF_INCHES).contains(&difference) || square == 0.0 {
        return;
    }
    let middle = [0, 1].map(|axis| f64::midpoint(from[axis], to[axis]));
    let aside = [arc.centre[0] - middle[0], arc.centre[1] - middle[1]];
    let share = (aside[0] * chord[0] + aside[1] * chord[1]) / square;
    arc.centre[0] -= share * chord[0];
    arc.centre[1] -= share * chord[1];
}

/// By how many mm the radii of an arc may differ that is written in mm (NIST RS274/NGC).
const WIDEST_OF_MM: f64 = 0.002;
/// The same, of one in inches.
const WIDEST_OF_INCHES: f64 = 0.005_08;

/// How an arc's numbers are written.
pub(crate) struct Rounding<'r> {
    /// A length in mm as the number that is written, in the unit that is written.
    pub(crate) length: &'r dyn Fn(f64) -> f64,
    /// Centres are absolute, not relative to where arcs begin.
    pub(crate) is_absolute: bool,
}

impl Rounding<'_> {
    /// Whether an arc would be read as a full circle because its ends are written alike.
    pub(crate) fn closes(&self, it: &Move) -> bool {
        let Path::Arc(arc) = it.path else { return false };
        let alike = |axis: usize| (self.length)(it.from.at[axis]) == (self.length)(it.to.at[axis]);
        arc.sweep(&it.from, &it.to) < PI && arc.plane.axes().into_iter().all(alike)
    }

    /// The arc with a centre whose rounded numbers are as far from its end as from its start: see [`WrittenArc::fit`].
    pub(crate) fn fitted(&self, it: &Move, units: Units) -> Result<Move, Box<Diagnostic>> {
        let Path::Arc(mut arc) = it.path else { return Ok(*it) };
        let [from, to] = [it.from, it.to].map(|end| arc.plane.project(&end.at));
        let origin = if self.is_absolute { [0.0; 2] } else { from };
        let written = WrittenArc {
            from,
            to,
            centre: [arc.centre[0] - origin[0], arc.centre[1] - origin[1]],
            length: self.length,
            is_absolute: self.is_absolute,
            unit: units.millimetres(),
        };
        let by = written.fit().map_err(|radii| not_round(it, radii))?;
        arc.centre = [arc.centre[0] + by[0], arc.centre[1] + by[1]];
        Ok(Move { path: Path::Arc(arc), ..*it })
    }
}

fn not_round(it: &Move, radii: [f64; 2]) -> Box<Diagnostic> {
    let [start, end] = radii.map(|radius| format!("{radius:.4}"));
    let diagnostic = Diagnostic::new(&posts::ARC_ROUNDED).with("place", Point::new(it.to.x(), it.to.y()));
    Box::new(diagnostic.quoting("start", start).quoting("end", end))
}
