//! Arcs of an operation: as arcs where their written numbers still are a circle, else as lines where the definition says so.

use std::f64::consts::PI;

use pathbuild_diagnostic::{Diagnostic, Point, messages::posts};

use super::macros::{Macro, Value};
use super::move_values::ArcValues;
use super::registers::Register;
use super::section::Section;
use super::writer::{Writer, Written};
use crate::arcs::{MOST_CHORDS, Polar, Rounding, pieces};
use crate::job::Plane;
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
        let closes = self.rounded(|rounding| rounding.closes(arc, plane));
        if is_short || closes {
            self.warn_of_line(arc, polar);
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
        let fitted = self.rounded(|rounding| rounding.fitted(arc, plane, self.plan.job.units));
        let fitted = fitted.map_err(|error| Box::new(error.in_file(self.plan.file)))?;
        self.circle(&fitted, plane)
    }

    fn chords(&mut self, arc: &Arc, plane: Plane, polar: Polar) -> Written {
        let Some(count) = polar.chords(self.plan.arc_tolerance()) else {
            let diagnostic = Diagnostic::new(&posts::TOO_MANY_CHORDS).with("limit", MOST_CHORDS);
            return Err(Box::new(diagnostic.with("radius", polar.radius).in_file(self.plan.file)));
        };
        pieces(arc, plane, count).iter().try_for_each(|piece| self.feed(piece.to.map(Some), arc.feed))
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

    /// How the numbers of arcs are rounded.
    fn rounded<T>(&self, ask: impl FnOnce(&Rounding<'_>) -> T) -> T {
        let length = |length: f64| self.number_format().round(self.scaled(length));
        ask(&Rounding { length: &length, is_absolute: self.is_absolute() })
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
