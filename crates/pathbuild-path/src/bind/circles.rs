//! Circles: drilled holes and helical circles.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{drawing, walk};

use super::cuts::no_gap;
use super::segments::{Scope, pushed};
use super::{At, Binder};
use crate::approx::above;
use crate::element::{Cut, Element};
use crate::geometry::Xy;
use crate::letter::Letter;
use crate::matrix::ElementClass;
use crate::path::{Helix, Hole, SegmentKind};

/// Orders at a star: holes come first, then circles, small ones before large ones. (book: language/chains-and-passes)
const BEFORE_ALL: f64 = -1_000_000.0;

impl Binder<'_> {
    /// What a circle is in the path, with its order at a star.
    pub(super) fn circle(
        &mut self,
        element: &Element,
        cut: Cut,
        centre: Xy,
        radius: f64,
        tool: Option<f64>,
    ) -> Option<(f64, SegmentKind)> {
        let (class, text) = (element.class(tool), self.raw.drawn.text(element.text));
        let values = self.element_values(At::Element(element), text, class);
        let scope = Scope { at: At::Element(element), class, values: &values };
        let tool = tool?;
        match class {
            ElementClass::DrilledHole | ElementClass::DrilledMark => {
                let hole = self.hole(&scope, cut)?;
                Some((BEFORE_ALL, SegmentKind::Hole(pushed(&mut self.holes, hole))))
            }
            ElementClass::UnknownCircle => {
                let problem = Diagnostic::new(&drawing::CIRCLE_TOO_SMALL)
                    .with("diameter", 2.0 * radius)
                    .with("tool", tool);
                self.report(scope.at, problem);
                None
            }
            _ => {
                let helix = self.helix(&scope, cut, centre, radius, tool)?;
                Some((BEFORE_ALL + radius, SegmentKind::Helix(pushed(&mut self.helices, helix))))
            }
        }
    }

    fn hole(&mut self, scope: &Scope<'_>, cut: Cut) -> Option<Hole> {
        Some(Hole {
            bottom: self.bottom(scope, cut)?,
            feed: self.value(scope, Letter::F),
            peck: self.value(scope, Letter::C),
            comment: scope.values.text(Letter::Q).map(Into::into),
        })
    }

    fn helix(&mut self, scope: &Scope<'_>, cut: Cut, centre: Xy, radius: f64, tool: f64) -> Option<Helix> {
        self.check_size(scope, radius);
        let (infeed, bottom) = (self.value(scope, Letter::I), self.bottom(scope, cut));
        let bars = if cut == Cut::Support {
            let length = 2.0 * std::f64::consts::PI * (radius - tool / 2.0);
            let bars = self.bars(scope, length, Some(tool))?;
            if let Some(problem) = no_gap(&bars, length) {
                self.report(scope.at, problem);
            }
            Some(bars)
        } else {
            None
        };
        let bottom = bottom?;
        Some(Helix {
            centre,
            radius,
            bottom: bars.map_or(bottom, |bars| bars.top),
            bars: bars.map(|bars| (bottom, bars)),
            feed: self.value(scope, Letter::F),
            infeed: infeed?,
            comment: scope.values.text(Letter::Q).map(Into::into),
        })
    }

    fn check_size(&mut self, scope: &Scope<'_>, radius: f64) {
        let Some(largest) = scope.texts(&self.values).number_or_default(Letter::A) else { return };
        if above(2.0 * radius, largest) {
            let problem =
                Diagnostic::new(&walk::HELIX_TOO_LARGE).with("diameter", 2.0 * radius).with("limit", largest);
            self.report(scope.at, problem);
        }
    }
}
