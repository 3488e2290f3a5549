//! Arcs of an operation. They are written as arcs if they are still circular after rounding, otherwise as lines if the definition permits
//! it.

use std::f64::consts::PI;

use pathbuild_diagnostic::{Diagnostic, Point, messages::posts};
use pathbuild_motion::{Arc, Course, Move, Plane};

use super::macros::{Macro, Value};
use super::move_values::ArcValues;
use super::registers::Register;
use super::section::Section;
use super::writer::{WriteResult, Writer};
use crate::arcs::{MOST_CHORDS, Rounding, chords, pieces_of};

const OFFSETS: [Register; 3] = [Register::I, Register::J, Register::K];

impl Writer<'_> {
    /// Writes a circular move in the form required by the options of the definition.
    pub(super) fn arc(&mut self, movement: &Move, course: &Course) -> WriteResult {
        let options = &self.plan.definition.options;
        if options.arcs_as_lines || options.rotary.wrap {
            return self.chords(movement, course);
        }
        let is_short = self.scaled(course.radius() * course.sweep()) < options.least_arc_length;
        let closes = self.rounded(|rounding| rounding.closes(movement));
        if is_short || closes || self.scaled(course.radius()) > options.greatest_arc_radius {
            self.warn_of_line(movement, course);
            return self.line(movement);
        }
        if self.is_written_by_radius(course) {
            return movement
                .split(pieces_of(course, WIDEST_BY_RADIUS))
                .try_for_each(|piece| self.circle(&piece));
        }
        let fitted = self.rounded(|rounding| rounding.fitted(movement, self.plan.job.units));
        self.circle(&fitted.map_err(|error| Box::new(error.in_file(self.plan.file)))?)
    }

    fn line(&mut self, movement: &Move) -> WriteResult {
        self.feed(movement.to.axes(), movement.pace.stated_feed())
    }

    fn chords(&mut self, movement: &Move, course: &Course) -> WriteResult {
        let Some(count) = chords(course, self.plan.arc_tolerance()) else {
            let diagnostic = Diagnostic::new(&posts::TOO_MANY_CHORDS).with("limit", u64::from(MOST_CHORDS));
            return Err(Box::new(diagnostic.with("radius", course.radius()).in_file(self.plan.file)));
        };
        movement.split(count).try_for_each(|piece| self.line(&piece))
    }

    fn warn_of_line(&mut self, movement: &Move, course: &Course) {
        if course.sagitta() > self.plan.arc_tolerance() {
            let diagnostic = Diagnostic::new(&posts::ARC_FLATTENED)
                .with("place", Point::new(movement.to.x(), movement.to.y()));
            self.warn(diagnostic.with("radius", course.radius()).with("distance", course.sagitta()));
        }
    }

    /// Whether the template uses the radius but no centre. Then the arc is only unambiguous if it sweeps less than half a turn.
    fn is_written_by_radius(&self, course: &Course) -> bool {
        let template = self.plan.definition.section(self.arc_section(&course.arc()));
        let has_centre = template.macros().any(|(what, _)| match what {
            Macro::Register(register, _) | Macro::Value(Value::ArcOffset(register)) => {
                OFFSETS.contains(register)
            }
            _ => false,
        });
        !has_centre && template.macros().any(|(what, _)| *what == Macro::Value(Value::ArcRadius))
    }

    fn arc_section(&self, arc: &Arc) -> Section {
        let is_inverted = self.plan.definition.options.invert_arcs && arc.plane == Plane::Zx;
        if arc.clockwise == is_inverted { Section::ArcCcw } else { Section::ArcCw }
    }

    /// Passes the rounding rules of arcs to a function.
    fn rounded<T>(&self, ask: impl FnOnce(&Rounding<'_>) -> T) -> T {
        let length = |length: f64| self.number_format().round(self.scaled(length));
        ask(&Rounding { length: &length, is_absolute: self.is_absolute() })
    }

    fn is_absolute(&self) -> bool {
        self.plan.definition.options.absolute_centres
    }

    fn circle(&mut self, movement: &Move) -> WriteResult {
        let Some(course) = movement.course() else { return self.line(movement) };
        let mut values = self.with_feed(movement.pace.stated_feed());
        let arc = course.arc();
        let origin = if self.is_absolute() { [0.0; 3] } else { movement.from.at };
        for (axis, centre) in arc.plane.axes().into_iter().zip(arc.centre) {
            values.set(OFFSETS[axis], Some(self.scaled(centre - origin[axis])));
        }
        values.arc = Some(self.arc_values(&course));
        self.go(self.arc_section(&arc), movement.to.axes(), values)
    }

    fn arc_values(&self, course: &Course) -> ArcValues {
        let [start, end] = course.directions().map(|angle| angle.to_degrees().rem_euclid(360.0));
        let clockwise = if course.arc().clockwise { 1.0 } else { -1.0 };
        let sweep = clockwise * course.sweep().to_degrees();
        ArcValues { radius: self.scaled(course.radius()), start, end, sweep }
    }
}

/// Arcs written by radius are split into parts of at most this angle.
const WIDEST_BY_RADIUS: f64 = PI * 2.0 / 3.0;
