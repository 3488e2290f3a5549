//! Binds milling, marking and support segments.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::paths;

use super::segments::{Scope, pushed};
use super::{Binder, FaultSite};
use crate::approx::at_least;
use crate::element::{Cut, Element};
use crate::geometry::Curve;
use crate::letter::{CHAIN_LETTERS, Letter};
use crate::path::{Bars, ChainParameters, CutParameters};
use crate::text::TextId;

impl Binder<'_> {
    /// Adds the cut of a segment in a milling chain. Returns its order at a star, and its index among the path's cuts.
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
        (order, pushed(&mut self.cuts, parameters))
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
        if let Some(bars) = &bars {
            self.note_gap(scope, bars, curve.length());
        }
        CutParameters {
            cut,
            feed: self.value(scope, Letter::F),
            bottom: bottom.unwrap_or_default(),
            bars,
            chain: ChainParameters {
                infeed: self.value(scope, Letter::I),
                peck: self.value(scope, Letter::C),
                first_depth: self.value(scope, Letter::W),
            },
            chain_letters: text.filter(|_| scope.values.letters().has_any(CHAIN_LETTERS)),
            comment: scope.values.text(Letter::Q).map(Into::into),
        }
    }

    /// The bars of a segment of this length, with room for the cutter between consecutive bars.
    pub(super) fn bars(&mut self, scope: &Scope<'_>, length: f64, tool: Option<f64>) -> Option<Bars> {
        let [top, bar, distance] = [Letter::D, Letter::P, Letter::U].map(|letter| self.value(scope, letter));
        let bars = Bars { top: top?, length: bar?, distance: distance? };
        let (tool, count) = (tool?, bars.count(length));
        let gap = length / count - bars.length;
        if count > 0.0 && !at_least(gap, tool) {
            let problem = Diagnostic::new(&paths::NO_ROOM_BETWEEN_BARS)
                .with("count", count)
                .with("gap", gap)
                .with("tool", tool);
            self.report(scope.at, problem);
        }
        Some(bars)
    }

    fn note_gap(&mut self, scope: &Scope<'_>, bars: &Bars, length: f64) {
        match no_gap(bars, length) {
            None => self.has_gap = true,
            Some(problem) if self.gapless.is_none() => {
                let problem = problem.in_path(self.raw.name.as_str());
                self.gapless = Some(self.origin(scope.at).at(problem));
            }
            Some(_) => {}
        }
    }
}

/// The finding about bars that leave no gap on this length.
pub(super) fn no_gap(bars: &Bars, length: f64) -> Option<Diagnostic> {
    (bars.count(length) == 0.0).then(|| {
        Diagnostic::new(&paths::NO_GAP_BETWEEN_BARS)
            .with("length", length)
            .with("pitch", bars.length + bars.distance)
            .with("top", bars.top)
    })
}
