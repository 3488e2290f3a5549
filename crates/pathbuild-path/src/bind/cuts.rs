//! The parameters of cuts: milled curves, holes and helical circles. (book: language/letters, book: language/support-bars)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{drawing, paths};

use crate::approx::{above, at_least};
use crate::bind::uncut_runs::missing_gap;
use crate::bind::{Binder, FaultSite, Scope, push_indexed};
use crate::element::{Cut, Element};
use crate::geometry::{Curve, Xy};
use crate::letter::{ElementClass, Letter};
use crate::path::{Bars, ChainParameters, CutParameters, Helix, Hole, SegmentKind};
use crate::text::TextId;
use crate::values::{check_bar, check_bar_length};

impl Binder<'_> {
    /// Adds the cut of a segment in a milling chain. Returns the segment's order among the segments that meet at a point, and the cut's index in the
    /// path.
    pub(super) fn cut(
        &mut self,
        element: &Element,
        cut: Cut,
        curve: &Curve,
        tool: Option<f64>,
    ) -> (f64, u32) {
        let (class, text) = (element.class(tool), self.raw.drawn.text(element.text));
        let values = self.element_values(FaultSite::Element(element), text, class);
        let scope = Scope { at: FaultSite::Element(element), class, values: &values };
        let parameters = self.cut_parameters(&scope, element.text, cut, curve, tool);
        let order = self.order(&scope);
        (order, push_indexed(&mut self.cuts, parameters))
    }

    fn cut_parameters(
        &mut self,
        scope: &Scope<'_>,
        text: Option<TextId>,
        cut: Cut,
        curve: &Curve,
        tool: Option<f64>,
    ) -> CutParameters {
        let bottom = self.bottom(scope, cut);
        let bars = (cut == Cut::Support).then(|| self.bars(scope, curve.length(), tool)).flatten();
        CutParameters {
            cut,
            feed: self.value(scope, Letter::F),
            bottom: bottom.unwrap_or_default(),
            bars,
            chain: ChainParameters {
                infeed: self.value(scope, Letter::I),
                first_depth: self.value(scope, Letter::W),
            },
            chain_letters: text.filter(|_| scope.values.letters().iter().any(Letter::is_of_chain)),
            comment: scope.values.text(Letter::Q).map(Into::into),
        }
    }

    /// Returns the support bars of a segment of this length. Reports bars that are thin or short, or leave no room for the
    /// cutter beside them.
    pub(super) fn bars(&mut self, scope: &Scope<'_>, length: f64, tool: Option<f64>) -> Option<Bars> {
        let [top, bar, distance] = [Letter::D, Letter::P, Letter::U].map(|letter| self.value(scope, letter));
        let bars = Bars { top: top?, length: bar?, distance: distance? };
        self.report_doubt(scope, Letter::D, check_bar(bars.top, &self.values));
        self.report_doubt(scope, Letter::P, check_bar_length(bars.length));
        let (tool, count) = (tool?, bars.count(length));
        let pitch = length / count;
        if count > 0.0 && !at_least(pitch, bars.length + tool) {
            let message = if count > 1.0 { &paths::NO_ROOM_BETWEEN_BARS } else { &paths::NO_ROOM_BESIDE_BAR };
            let problem = Diagnostic::new(message)
                .with("count", count)
                .with("gap", pitch - bars.length)
                .with("tool", tool);
            self.report(scope.at, problem);
        }
        Some(bars)
    }
}

/// Order of a hole among the segments that meet at a point: holes come first, then circles from small to large. (book: language/chains-and-passes)
const CIRCLE_ORDER_OFFSET: f64 = -1_000_000.0;

impl Binder<'_> {
    /// Returns the segment for a circle, with its order among the segments that meet at a point.
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
                (CIRCLE_ORDER_OFFSET, SegmentKind::Hole(push_indexed(&mut self.holes, hole)))
            }
            (ElementClass::UnknownCircle, _) | (_, None) => {
                if let Some(tool) = tool.filter(|_| !self.raw.uncertainty.is_in_other_unit) {
                    let problem = Diagnostic::new(&drawing::CIRCLE_TOO_SMALL)
                        .with("diameter", 2.0 * radius)
                        .with("tool", tool);
                    self.report(scope.at, problem);
                }
                // Continue as if the circle were a hole: its depth is still checked, and the walk passes through it.
                let class =
                    if cut == Cut::Mark { ElementClass::DrilledMark } else { ElementClass::DrilledHole };
                let hole = self.hole(&Scope { class, ..scope }, cut);
                (CIRCLE_ORDER_OFFSET, SegmentKind::Hole(push_indexed(&mut self.holes, hole)))
            }
            (_, Some(tool)) => {
                let helix = self.helix(&scope, cut, centre, radius, tool);
                (CIRCLE_ORDER_OFFSET + radius, SegmentKind::Helix(push_indexed(&mut self.helices, helix)))
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
        if let Some(bars) = bars.filter(|bars| bars.count(length) == 0.0) {
            self.report(scope.at, missing_gap(&bars, length));
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

    /// Reports PB118 if a circle was probably meant as a drilled hole.
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
