//! Fits arcs to the numbers that a post writes: splits them, replaces them by chords, and moves centres so that they are still arcs after
//! rounding.

use std::f64::consts::PI;

use pathbuild_diagnostic::{Diagnostic, Point, messages::posts};
use pathbuild_motion::{
    Course, MAX_RADIUS_DIFFERENCE_INCHES, MAX_RADIUS_DIFFERENCE_MM, Move, MoveShape, WrittenArc, widest_chord,
};

/// Maximum number of chords per arc.
pub(crate) const MAX_CHORDS: u32 = 100_000;

/// Greatest distance in mm between an arc and the chords that replace it, whatever a definition permits.
pub(crate) const MAX_CHORD_DISTANCE: f64 = 0.05;

/// Returns the number of chords needed to stay within `tolerance` mm of the arc, or `None` if that would be too many.
pub(crate) fn chords(course: &Course, tolerance: f64) -> Option<u32> {
    let count = (course.sweep() / widest_chord(course.radius(), tolerance)).ceil().max(1.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    (count <= f64::from(MAX_CHORDS)).then_some(count as u32)
}

/// Returns the number of equal parts into which an arc must be split so that none sweeps more than `widest` radians. It is at most 255.
pub(crate) fn arc_piece_count(course: &Course, widest: f64) -> u32 {
    (1..u32::from(u8::MAX))
        .find(|count| f64::from(*count) * widest >= course.sweep())
        .unwrap_or(u8::MAX.into())
}

/// Moves the centre of an arc so that it is equidistant from start and end, if the radii differ by more than is permitted in programs in mm, but by
/// no more than is permitted in programs in inches.
pub(crate) fn equalize_radii(movement: &mut Move) {
    let MoveShape::Arc(arc) = &mut movement.shape else { return };
    let difference = (arc.radius(&movement.from) - arc.radius(&movement.to)).abs();
    let [from, to] = [movement.from, movement.to].map(|end| arc.plane.project(&end.at));
    let chord = [to[0] - from[0], to[1] - from[1]];
    let square = chord[0] * chord[0] + chord[1] * chord[1];
    if !(MAX_RADIUS_DIFFERENCE_MM..=MAX_RADIUS_DIFFERENCE_INCHES * 25.4).contains(&difference)
        || square == 0.0
    {
        return;
    }
    let middle = [0, 1].map(|axis| f64::midpoint(from[axis], to[axis]));
    let aside = [arc.centre[0] - middle[0], arc.centre[1] - middle[1]];
    let share = (aside[0] * chord[0] + aside[1] * chord[1]) / square;
    arc.centre[0] -= share * chord[0];
    arc.centre[1] -= share * chord[1];
}

/// The rules by which a post rounds the numbers of an arc.
pub(crate) struct ArcRounding<'r> {
    /// Converts a length in mm to the number that is written, in the output unit.
    pub(crate) length: &'r dyn Fn(f64) -> f64,
    /// Whether centres are absolute instead of relative to the start of the arc.
    pub(crate) is_absolute: bool,
}

impl ArcRounding<'_> {
    /// Whether the arc, which covers less than half a circle, would be read as a full circle because its ends are equal after rounding.
    pub(crate) fn becomes_full_circle(&self, movement: &Move) -> bool {
        let MoveShape::Arc(arc) = movement.shape else { return false };
        let alike =
            |axis: usize| (self.length)(movement.from.at[axis]) == (self.length)(movement.to.at[axis]);
        arc.sweep(&movement.from, &movement.to) < PI && arc.plane.axes().into_iter().all(alike)
    }

    /// Adjusts the centre so that after rounding it is equidistant from start and end: see [`WrittenArc::centre_correction`].
    pub(crate) fn fit_centre(&self, movement: &Move, unit: f64) -> Result<Move, Box<Diagnostic>> {
        let MoveShape::Arc(mut arc) = movement.shape else { return Ok(*movement) };
        let [from, to] = [movement.from, movement.to].map(|end| arc.plane.project(&end.at));
        let origin = if self.is_absolute { [0.0; 2] } else { from };
        let written = WrittenArc {
            from,
            to,
            centre: [arc.centre[0] - origin[0], arc.centre[1] - origin[1]],
            length: self.length,
            is_absolute: self.is_absolute,
            unit,
        };
        let by = written.centre_correction().map_err(|radii| unequal_radii_error(movement, radii))?;
        arc.centre = [arc.centre[0] + by[0], arc.centre[1] + by[1]];
        Ok(Move { shape: MoveShape::Arc(arc), ..*movement })
    }
}

fn unequal_radii_error(movement: &Move, radii: [f64; 2]) -> Box<Diagnostic> {
    let [start, end] = radii.map(|radius| format!("{radius:.4}"));
    let diagnostic =
        Diagnostic::new(&posts::ARC_ROUNDED).with("place", Point::new(movement.to.x(), movement.to.y()));
    Box::new(diagnostic.quoting("start", start).quoting("end", end))
}
