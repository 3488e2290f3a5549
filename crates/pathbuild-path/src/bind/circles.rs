//! Binds circles: drilled holes and helical circles.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{drawing, paths};

use super::cuts::no_gap;
use super::segments::{Scope, pushed};
use super::{Binder, FaultSite};
use crate::approx::above;
use crate::element::{Cut, Element};
use crate::geometry::Xy;
use crate::letter::Letter;
use crate::matrix::ElementClass;
use crate::path::{Helix, Hole, SegmentKind};

/// Orders at a star: holes come first, then circles, from small to large. (book: language/chains-and-passes)
const BEFORE_ALL: f64 = -1_000_000.0;

impl Binder<'_> {
    /// The segment for a circle, with its order at a star.
    pub(super) fn circle(
        &mut self,
        element: &Element,
        cut: Cut,
        centre: Xy,
        radius: f64,
        tool: Option<f64>,
    ) -> (f64, SegmentKind) {
        let (class, text) = (element.class(tool), self.raw.drawn.text(element.text));
        let values = self.element_values(FaultSite::Element(element), text, class);
        let scope = Scope { at: FaultSite::Element(element), class, values: &values };
        match (class, tool) {
            (ElementClass::DrilledHole | ElementClass::DrilledMark, _) => {
                let hole = self.hole(&scope, cut);
                (BEFORE_ALL, SegmentKind::Hole(pushed(&mut self.holes, hole)))
            }
            (ElementClass::UnknownCircle, _) | (_, None) => {
                if let Some(tool) = tool {
                    let problem = Diagnostic::new(&drawing::CIRCLE_TOO_SMALL)
                        .with("diameter", 2.0 * radius)
                        .with("tool", tool);
                    self.report(scope.at, problem);
                }
                // Even so, it needs its depth, and it is a point of the walk.
                let class =
                    if cut == Cut::Mark { ElementClass::DrilledMark } else { ElementClass::DrilledHole };
                let hole = self.hole(&Scope { class, ..scope }, cut);
                (BEFORE_ALL, SegmentKind::Hole(pushed(&mut self.holes, hole)))
            }
            (_, Some(tool)) => {
                let helix = self.helix(&scope, cut, centre, radius, tool);
                (BEFORE_ALL + radius, SegmentKind::Helix(pushed(&mut self.helices, helix)))
            }
        }
    }

    fn hole(&mut self, scope: &Scope<'_>, cut: Cut) -> Hole {
        Hole {
            bottom: self.bottom(scope, cut).unwrap_or_default(),
            feed: self.value(scope, Letter::F),
            peck: self.value(scope, Letter::C),
            comment: scope.values.text(Letter::Q).map(Into::into),
        }
    }

    fn helix(&mut self, scope: &Scope<'_>, cut: Cut, centre: Xy, radius: f64, tool: f64) -> Helix {
        self.check_size(scope, radius);
        self.check_margin(scope, radius, tool);
        let (infeed, bottom) = (self.value(scope, Letter::I), self.bottom(scope, cut));
        let length = std::f64::consts::TAU * Helix::radius_of_axis(radius, tool);
        let bars = (cut == Cut::Support).then(|| self.bars(scope, length, Some(tool))).flatten();
        if let Some(problem) = bars.as_ref().and_then(|bars| no_gap(bars, length)) {
            self.report(scope.at, problem);
        }
        let bottom = bottom.unwrap_or_default();
        Helix {
            centre,
            radius,
            bottom: bars.map_or(bottom, |bars| bars.top),
            bars: bars.map(|bars| (bottom, bars)),
            feed: self.value(scope, Letter::F),
            infeed: infeed.unwrap_or_default(),
            comment: scope.values.text(Letter::Q).map(Into::into),
        }
    }

    /// PB118 if a circle was probably meant as a drilled hole.
    fn check_margin(&mut self, scope: &Scope<'_>, radius: f64, tool: f64) {
        let difference = 2.0 * radius - tool;
        if above(difference, self.language.doubts.hole_margin) {
            return;
        }
        let problem = Diagnostic::new(&drawing::NEARLY_DRILLED)
            .with("diameter", 2.0 * radius)
            .with("difference", difference)
            .with("tool", tool)
            .with("radius", Helix::radius_of_axis(radius, tool));
        self.report(scope.at, problem);
    }

    fn check_size(&mut self, scope: &Scope<'_>, radius: f64) {
        let Some(largest) = scope.texts(&self.values).number_or_default(Letter::A) else { return };
        if above(2.0 * radius, largest) {
            let problem = Diagnostic::new(&paths::HELIX_TOO_LARGE)
                .with("diameter", 2.0 * radius)
                .with("limit", largest);
            self.report(scope.at, problem);
        }
    }
}
