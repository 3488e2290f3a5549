//! The geometry of circular moves: sweeps, chords, pieces.

use std::f64::consts::{PI, TAU};

use pathbuild_diagnostic::{Diagnostic, Point, messages::posts};
use pathbuild_gcode::WrittenArc;

use super::job::{Plane, Units};
use super::step::Arc;

/// An arc is cut into at most so many chords.
pub(crate) const MOST_CHORDS: usize = 100_000;

/// An arc in polar coordinates of its plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polar {
    /// In mm, at the start.
    pub(crate) radius: f64,
    /// Direction from the centre to the start, radians.
    pub(crate) start: f64,
    /// The angle turned through, radians, greater than 0 and at most a full turn.
    pub(crate) sweep: f64,
}

impl Polar {
    /// The arc as angles. Start and end at the same point are a full circle.
    pub(crate) fn of(arc: &Arc, plane: Plane) -> Self {
        let [u, v, _] = plane.axes();
        let angle = |point: [f64; 3]| libm::atan2(point[v] - arc.centre[v], point[u] - arc.centre[u]);
        let (start, end) = (angle(arc.from), angle(arc.to));
        let turned = if arc.clockwise { start - end } else { end - start };
        let is_closed = arc.from[u] == arc.to[u] && arc.from[v] == arc.to[v];
        let sweep = if is_closed { TAU } else { turned.rem_euclid(TAU) };
        let radius = libm::hypot(arc.from[u] - arc.centre[u], arc.from[v] - arc.centre[v]);
        Self { radius, start, sweep: if sweep > 0.0 { sweep } else { TAU } }
    }

    /// Greatest distance between the arc and the line from its start to its end.
    pub(crate) fn height(self) -> f64 {
        self.radius * (1.0 - libm::cos(self.sweep / 2.0))
    }

    /// How many equal pieces of at most that angle (radians, not small) it takes.
    pub(crate) fn pieces_of(self, widest: f64) -> usize {
        (1..=u8::MAX)
            .find(|&count| f64::from(count) * widest >= self.sweep)
            .map_or(usize::from(u8::MAX), usize::from)
    }

    /// How many lines stay within the tolerance of the arc; `None` when they are too many.
    pub(crate) fn chords(self, tolerance: f64) -> Option<usize> {
        if self.radius <= tolerance {
            // Even a point would do, but a circle must not become one.
            return Some(4);
        }
        let widest = 2.0 * libm::acos(1.0 - tolerance / self.radius);
        let count = (self.sweep / widest.min(PI / 2.0)).ceil().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
        (count <= MOST_CHORDS as f64).then_some(count as usize)
    }
}

impl Arc {
    /// Moves the centre as far from the end as from the start, if it is nearly that.
    pub(crate) fn centre(&mut self, plane: Plane) {
        let [u, v, _] = plane.axes();
        let radius = |end: [f64; 3]| libm::hypot(end[u] - self.centre[u], end[v] - self.centre[v]);
        let difference = (radius(self.from) - radius(self.to)).abs();
        let chord = [self.to[u] - self.from[u], self.to[v] - self.from[v]];
        let square = chord[0] * chord[0] + chord[1] * chord[1];
        if !(WIDEST_OF_MM..=WIDEST_OF_INCHES).contains(&difference) || square == 0.0 {
            return;
        }
        let middle = [u, v].map(|axis| f64::midpoint(self.from[axis], self.to[axis]));
        let aside = [self.centre[u] - middle[0], self.centre[v] - middle[1]];
        let share = (aside[0] * chord[0] + aside[1] * chord[1]) / square;
        self.centre[u] -= share * chord[0];
        self.centre[v] -= share * chord[1];
    }
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
    pub(crate) fn closes(&self, arc: &Arc, plane: Plane) -> bool {
        let alike = |axis: usize| (self.length)(arc.from[axis]) == (self.length)(arc.to[axis]);
        Polar::of(arc, plane).sweep < PI && plane.axes()[..2].iter().all(|axis| alike(*axis))
    }

    /// The arc with a centre whose rounded numbers are as far from its end as from its start: see [`WrittenArc::fit`].
    pub(crate) fn fitted(&self, arc: &Arc, plane: Plane, units: Units) -> Result<Arc, Box<Diagnostic>> {
        let [u, v, _] = plane.axes();
        let origin = if self.is_absolute { [0.0; 3] } else { arc.from };
        let written = WrittenArc {
            from: [arc.from[u], arc.from[v]],
            to: [arc.to[u], arc.to[v]],
            centre: [arc.centre[u] - origin[u], arc.centre[v] - origin[v]],
            length: self.length,
            is_absolute: self.is_absolute,
            unit: units.millimetres(),
        };
        let by = written.fit().map_err(|radii| not_round(arc, radii))?;
        let mut fitted = *arc;
        fitted.centre[u] += by[0];
        fitted.centre[v] += by[1];
        Ok(fitted)
    }
}

fn not_round(arc: &Arc, radii: [f64; 2]) -> Box<Diagnostic> {
    let [start, end] = radii.map(|radius| format!("{radius:.4}"));
    let diagnostic = Diagnostic::new(&posts::ARC_ROUNDED).with("place", Point::new(arc.to[0], arc.to[1]));
    Box::new(diagnostic.quoting("start", start).quoting("end", end))
}

/// The arc in that many equal pieces, each beginning where the one before ends.
pub(crate) fn pieces(arc: &Arc, plane: Plane, count: usize) -> Vec<Arc> {
    let polar = Polar::of(arc, plane);
    let mut from = arc.from;
    let cut = |index| {
        let to = if index == count { arc.to } else { point(arc, plane, polar, index as f64 / count as f64) };
        let piece = Arc { from, to, ..*arc };
        from = to;
        piece
    };
    (1..=count).map(cut).collect()
}

/// The point where a part of the sweep is done; 0 is the start, 1 the end.
fn point(arc: &Arc, plane: Plane, polar: Polar, part: f64) -> [f64; 3] {
    let [u, v, across] = plane.axes();
    let turn = if arc.clockwise { -polar.sweep } else { polar.sweep };
    let (sin, cos) = libm::sincos(polar.start + turn * part);
    let mut point = [0.0; 3];
    point[u] = arc.centre[u] + polar.radius * cos;
    point[v] = arc.centre[v] + polar.radius * sin;
    point[across] = arc.from[across] + (arc.to[across] - arc.from[across]) * part;
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quarter(clockwise: bool) -> Arc {
        Arc { clockwise, from: [10.0, 0.0, 0.0], centre: [0.0; 3], to: [0.0, 10.0, -1.0], feed: None }
    }

    #[test]
    fn the_sweep_follows_the_direction() {
        assert!((Polar::of(&quarter(false), Plane::Xy).sweep - PI / 2.0).abs() < 1e-12);
        assert!((Polar::of(&quarter(true), Plane::Xy).sweep - 1.5 * PI).abs() < 1e-12);
    }

    #[test]
    fn an_arc_that_ends_where_it_begins_is_a_full_circle() {
        let circle = Arc { to: [10.0, 0.0, -1.0], ..quarter(true) };
        assert_eq!(Polar::of(&circle, Plane::Xy).sweep, TAU);
    }

    #[test]
    fn chords_stay_within_the_tolerance() {
        let polar = Polar::of(&quarter(false), Plane::Xy);
        let chords = polar.chords(0.01).unwrap();
        let height = |count: usize| Polar { sweep: polar.sweep / count as f64, ..polar }.height();
        assert!(height(chords) <= 0.01 && height(chords - 1) > 0.01, "{chords} is just enough");
        assert_eq!(polar.chords(1e-12), None);
    }

    #[test]
    fn pieces_join_and_end_exactly_where_the_arc_does() {
        let pieces = pieces(&quarter(false), Plane::Xy, 2);
        assert_eq!(pieces[0].to, pieces[1].from);
        assert_eq!(pieces[1].to, [0.0, 10.0, -1.0]);
        let side = 10.0 * std::f64::consts::FRAC_1_SQRT_2;
        assert!((pieces[0].to[0] - side).abs() < 1e-12 && (pieces[0].to[1] - side).abs() < 1e-12);
        assert_eq!(pieces[0].to[2], -0.5);
    }
}
