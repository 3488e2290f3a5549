//! Arcs of an operation: as arcs where their written numbers still are a circle, else as lines where the definition says so.

use std::f64::consts::PI;

use pathbuild_diagnostic::{Diagnostic, Point, messages::posts};

use super::macros::{Macro, Value};
use super::move_values::ArcValues;
use super::registers::Register;
use super::section::Section;
use super::writer::{Writer, Written};
use crate::arcs::{MOST_CHORDS, Polar, pieces};
use crate::job::{Plane, Units};
use crate::step::Arc;

const OFFSETS: [Register; 3] = [Register::I, Register::J, Register::K];

impl Writer<'_> {
    /// A circular move, in the form that the definition's options ask for.
    pub(super) fn arc(&mut self, arc: &Arc) -> Written {
        let plane = self.operation().plane;
        let polar = Polar::of(arc, plane);
        let options = &self.plan.definition.options;
        if options.arcs_as_lines || options.rotary.wrap {
            return self.chords(arc, plane, polar);
        }
        let is_short = self.scaled(polar.radius * polar.sweep) < options.least_arc_length;
        if is_short || self.closes_when_rounded(arc, plane, polar) {
            return self.feed(arc.to.map(Some), arc.feed);
        }
        if self.scaled(polar.radius) > options.greatest_arc_radius {
            self.warn_of_line(arc, polar);
            return self.feed(arc.to.map(Some), arc.feed);
        }
        if self.is_written_by_radius(arc) {
            return pieces(arc, plane, polar.pieces_of(WIDEST_BY_RADIUS))
                .iter()
                .try_for_each(|piece| self.circle(piece, plane));
        }
        self.check_rounded(arc, plane)?;
        self.circle(arc, plane)
    }

    fn chords(&mut self, arc: &Arc, plane: Plane, polar: Polar) -> Written {
        let Some(count) = polar.chords(self.plan.arc_tolerance()) else {
            let diagnostic = Diagnostic::new(&posts::TOO_MANY_CHORDS).with("limit", MOST_CHORDS);
            return Err(Box::new(diagnostic.with("radius", polar.radius).in_file(self.plan.file)));
        };
        pieces(arc, plane, count).iter().try_for_each(|piece| self.feed(piece.to.map(Some), arc.feed))
    }

    /// Whether an arc would be read as a full circle because its ends are written alike.
    fn closes_when_rounded(&self, arc: &Arc, plane: Plane, polar: Polar) -> bool {
        let [u, v, _] = plane.axes();
        let alike = |axis: usize| self.length(arc.from[axis]) == self.length(arc.to[axis]);
        polar.sweep < PI && alike(u) && alike(v)
    }

    fn warn_of_line(&mut self, arc: &Arc, polar: Polar) {
        if polar.height() > self.plan.arc_tolerance() {
            let diagnostic = Diagnostic::new(&posts::ARC_FLATTENED).with("place", place(arc));
            self.warn(diagnostic.with("radius", polar.radius).with("distance", polar.height()));
        }
    }

    /// Whether the template has the radius and no centre: then the way round is only clear for less than half a turn.
    fn is_written_by_radius(&self, arc: &Arc) -> bool {
        let template = self.plan.definition.section(self.arc_section(arc));
        let has_centre = template.macros().any(|(what, _)| match what {
            Macro::Register(register, _) | Macro::Value(Value::ArcOffset(register)) => {
                OFFSETS.contains(register)
            }
            _ => false,
        });
        !has_centre && template.macros().any(|(what, _)| *what == Macro::Value(Value::ArcRadius))
    }

    fn arc_section(&self, arc: &Arc) -> Section {
        let is_inverted = self.plan.definition.options.invert_arcs && self.operation().plane == Plane::Xz;
        if arc.clockwise == is_inverted { Section::ArcCcw } else { Section::ArcCw }
    }

    /// Controls refuse an arc, or run a wild one, when the rounded centre is not as far from the end as from the start.
    fn check_rounded(&self, arc: &Arc, plane: Plane) -> Written {
        let format = self.number_format();
        let rounded = |point: [f64; 3]| point.map(|at| format.round(self.scaled(at)));
        let (from, to) = (rounded(arc.from), rounded(arc.to));
        let centre = self.offsets(arc).map(|offset| format.round(offset));
        let centre = |axis: usize| if self.is_absolute() { centre[axis] } else { from[axis] + centre[axis] };
        let [u, v, _] = plane.axes();
        let radius = |point: [f64; 3]| libm::hypot(point[u] - centre(u), point[v] - centre(v));
        let (start, end) = (radius(from), radius(to));
        let tolerance = match self.plan.job.units {
            Units::Millimetres => 0.002,
            Units::Inches => 0.000_2,
        };
        if (start - end).abs() <= tolerance {
            return Ok(());
        }
        let diagnostic = Diagnostic::new(&posts::ARC_ROUNDED).with("place", place(arc));
        let text = |radius: f64| format!("{radius:.4}");
        Err(Box::new(diagnostic.with("start", text(start)).with("end", text(end)).in_file(self.plan.file)))
    }

    fn is_absolute(&self) -> bool {
        self.plan.definition.options.absolute_centres
    }

    /// I, J, K in the unit that is written.
    fn offsets(&self, arc: &Arc) -> [f64; 3] {
        let origin = if self.is_absolute() { [0.0; 3] } else { arc.from };
        [0, 1, 2].map(|axis| self.scaled(arc.centre[axis] - origin[axis]))
    }

    fn circle(&mut self, arc: &Arc, plane: Plane) -> Written {
        let polar = Polar::of(arc, plane);
        let mut values = self.with_feed(arc.feed);
        let offsets = self.offsets(arc);
        for axis in &plane.axes()[..2] {
            values.set(OFFSETS[*axis], Some(offsets[*axis]));
        }
        values.arc = Some(self.arc_values(arc, polar));
        self.go(self.arc_section(arc), arc.to.map(Some), values)
    }

    fn arc_values(&self, arc: &Arc, polar: Polar) -> ArcValues {
        let turn = if arc.clockwise { -polar.sweep } else { polar.sweep };
        ArcValues {
            radius: self.scaled(polar.radius),
            start: polar.start.to_degrees().rem_euclid(360.0),
            end: (polar.start + turn).to_degrees().rem_euclid(360.0),
            sweep: -turn.to_degrees(),
        }
    }
}

/// Arcs written by radius are cut into pieces of at most this angle.
const WIDEST_BY_RADIUS: f64 = PI * 2.0 / 3.0;

fn place(arc: &Arc) -> Point {
    Point::new(arc.to[0], arc.to[1])
}
