//! Circles: drilled holes, of which many say the same, and helical circles.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{drawing, walk};

use super::cuts::key;
use super::segments::Scope;
use super::{At, Binder};
use crate::approx::{above, near};
use crate::element::{Cut, Element};
use crate::geometry::Xy;
use crate::letter::{ElementClass, Letter};
use crate::path::{Helix, Hole, SegmentKind};
use crate::values::Given;

/// Orders at a star: holes come first, then circles, small ones before large ones. (spec/50-path-building.md, "Segments")
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
        let is_hole = tool.is_some_and(|tool| near(radius, tool / 2.0));
        let key = key(element, cut);
        if let Some((order, number)) = self.known.get(key).filter(|_| is_hole) {
            return Some((order, SegmentKind::Hole(number)));
        }
        let reported = self.reported;
        let (class, text) = (element.class(tool), self.raw.drawn.text(element.text));
        let values = self.element_values(At::Element(element), text, class == ElementClass::HelicalSupport);
        let scope = Scope { element, class, values: &values, tool };
        let tool = tool?;
        if is_hole {
            let hole = self.hole(&scope, cut)?;
            let number = u32::try_from(self.holes.len()).unwrap_or(u32::MAX);
            self.holes.push(hole);
            if self.reported == reported {
                self.known.insert(key, (BEFORE_ALL, number));
            }
            return Some((BEFORE_ALL, SegmentKind::Hole(number)));
        }
        if radius < tool / 2.0 {
            let problem =
                Diagnostic::new(&drawing::CIRCLE_TOO_SMALL).with("diameter", 2.0 * radius).with("tool", tool);
            self.report(At::Element(element), problem);
            return None;
        }
        let helix = self.helix(&scope, cut, centre, radius, tool)?;
        let number = u32::try_from(self.helices.len()).unwrap_or(u32::MAX);
        self.helices.push(helix);
        Some((BEFORE_ALL + radius, SegmentKind::Helix(number)))
    }

    fn hole(&mut self, scope: &Scope<'_>, cut: Cut) -> Option<Hole> {
        let bottom = self.needed(scope, if cut == Cut::Mark { Letter::D } else { Letter::B })?;
        Some(Hole {
            bottom,
            feed: self.allowed(scope, Letter::F),
            peck: self.allowed(scope, Letter::C),
            comment: scope.values.text(Letter::Q).map(Into::into),
        })
    }

    fn helix(&mut self, scope: &Scope<'_>, cut: Cut, centre: Xy, radius: f64, tool: f64) -> Option<Helix> {
        self.check_size(scope, radius, tool);
        let infeed = self.needed(scope, Letter::I);
        let bottom = self.needed(scope, if cut == Cut::Mark { Letter::D } else { Letter::B });
        let bars = if cut == Cut::Support {
            let inner = radius - tool / 2.0;
            Some(self.bars(scope, 2.0 * std::f64::consts::PI * inner)?)
        } else {
            None
        };
        let bottom = bottom?;
        Some(Helix {
            centre,
            radius,
            bottom: bars.map_or(bottom, |bars| bars.top),
            bars: bars.map(|bars| (bottom, bars)),
            feed: self.allowed(scope, Letter::F),
            infeed: infeed?,
            comment: scope.values.text(Letter::Q).map(Into::into),
        })
    }

    fn check_size(&mut self, scope: &Scope<'_>, radius: f64, tool: f64) {
        let largest = match self.values.number(Letter::A) {
            Given::Absent => 4.0 * tool,
            Given::Number(largest) => largest,
            Given::Faulty => return,
        };
        if above(2.0 * radius, largest) {
            let problem =
                Diagnostic::new(&walk::HELIX_TOO_LARGE).with("diameter", 2.0 * radius).with("limit", largest);
            self.report(At::Element(scope.element), problem);
        }
    }
}
