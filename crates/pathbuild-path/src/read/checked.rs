//! Checks a path once all its elements and texts are known, independently of values.

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, Number};

use crate::approx::coincide;
use crate::element::{Element, Role, Shape};
use crate::geometry::{Curve, Xy};
use crate::raw::RawPath;

/// Length in mm below which a line is no move, and two circles are one: programs have three decimals.
const SHORTEST: f64 = 0.0005;

/// A raw path being checked.
pub(super) struct PathCheck<'r> {
    pub(super) raw: &'r mut RawPath,
}

impl PathCheck<'_> {
    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        let name = self.raw.name.as_str();
        let is_placed = diagnostic.path.is_some();
        self.raw.diagnostics.push(if is_placed { diagnostic } else { diagnostic.in_path(name) });
    }

    /// PB121: lines without length, and circles that lie on others of their kind.
    pub(super) fn check_leftovers(&mut self) {
        let drawn = &self.raw.drawn;
        let at = |element: &Element, problem: Diagnostic| drawn.origin(element).at(problem);
        let mut found = Vec::new();
        for element in &drawn.elements {
            let Shape::Curve(Curve::Line(line)) = element.shape else { continue };
            let is_short = (line.end - line.start).norm() < SHORTEST;
            let message = match element.role {
                Role::Cut(_) if is_short => &messages::CUT_WITHOUT_LENGTH,
                // A shorter one connects two ends.
                Role::Sweep | Role::SilentSweep if coincide(line.start, line.end) => {
                    &messages::SWEEP_WITHOUT_LENGTH
                }
                _ => continue,
            };
            found.push(at(element, Diagnostic::new(message)));
        }
        let circles = drawn.elements.iter().enumerate();
        let mut circles: Vec<(usize, Xy, f64)> = circles
            .filter_map(|(index, element)| Some((index, element.shape.point(), element.shape.radius()?)))
            .collect();
        circles.sort_by_cached_key(|(index, centre, radius)| {
            ([centre.x, centre.y, *radius].map(|length| Number((length / SHORTEST).round())), *index)
        });
        for pair in circles.windows(2) {
            let [(first, centre, radius), (second, other, other_radius)] = *pair else { continue };
            let [first, second] = [first, second].map(|index| &drawn.elements[index]);
            let is_same = (other - centre).norm() < SHORTEST && (other_radius - radius).abs() < SHORTEST;
            if is_same && first.role == second.role {
                let problem = Diagnostic::new(&messages::CIRCLE_TWICE).with("diameter", 2.0 * radius);
                found.push(at(second, problem));
            }
        }
        for problem in found {
            self.report(problem);
        }
    }

    /// Reports missing markers.
    pub(super) fn check_markers(&mut self) {
        if self.raw.start.is_some() && self.raw.end.is_some() {
            return;
        }
        let missing = |message| {
            Diagnostic::new(message)
                .quoting("name", self.raw.name.as_str())
                .quoting("layer", self.raw.layer())
        };
        let start = self.raw.start.is_none().then(|| missing(&messages::MISSING_START));
        let end = self.raw.end.is_none().then(|| missing(&messages::MISSING_END));
        let somewhere = self.raw.drawn.elements.first().map(|element| self.raw.drawn.origin(element));
        for diagnostic in start.into_iter().chain(end) {
            let placed = match &somewhere {
                Some(origin) => origin.at(diagnostic),
                None => diagnostic,
            };
            self.report(placed);
        }
    }
}
