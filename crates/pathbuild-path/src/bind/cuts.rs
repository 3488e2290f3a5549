//! Milling, marking and support segments: most of a path's segments, many of them milled alike.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::walk;

use super::segments::{Scope, UNNUMBERED};
use super::{At, Binder};
use crate::approx::at_least;
use crate::element::{Cut, Element, Shape};
use crate::geometry::Curve;
use crate::letter::{CHAIN_LETTERS, ElementClass, Letter};
use crate::packed::Recent;
use crate::path::{Bars, ChainParameters, CutParameters};

/// How segments are milled, or holes drilled, that say the same: their order at a star, and the index into the path's cuts or holes. Only
/// what nothing was wrong with is known.
pub(super) type Known = Recent<(f64, u32)>;

/// What an element says, as a number.
pub(super) fn key(element: &Element, cut: Cut) -> u128 {
    let wording = element.text.map_or(0, |text| u128::from(text.wording) + 1);
    let is_circle = matches!(element.shape, Shape::Circle { .. });
    (wording << 1 | u128::from(is_circle)) << 2 | (cut as u128 + 1)
}

impl Binder<'_> {
    /// How a segment of a milling chain is milled, after its order at a star: index into the path's cuts.
    pub(super) fn cut(
        &mut self,
        element: &Element,
        cut: Cut,
        curve: &Curve,
        tool: Option<f64>,
    ) -> Option<(f64, u32)> {
        let key = key(element, cut);
        let Some((order, number)) = self.known.get(key) else {
            return self.new_cut(element, cut, curve, tool, key);
        };
        if let (Some(bars), Some(tool)) = (self.cuts[number as usize].bars, tool) {
            self.check_room(element, &bars, curve.length(), tool);
        }
        Some((order, number))
    }

    fn new_cut(
        &mut self,
        element: &Element,
        cut: Cut,
        curve: &Curve,
        tool: Option<f64>,
        key: u128,
    ) -> Option<(f64, u32)> {
        let reported = self.reported;
        let class = element.class(tool);
        let text = self.raw.drawn.text(element.text);
        let values = self.element_values(At::Element(element), text, class == ElementClass::Support);
        let scope = Scope { element, class, values: &values, tool };
        let parameters = self.cut_parameters(&scope, cut, curve)?;
        let number = u32::try_from(self.cuts.len()).unwrap_or(u32::MAX);
        self.cuts.push(parameters);
        let order = values.number(Letter::N).number().unwrap_or(UNNUMBERED);
        if self.reported == reported {
            self.known.insert(key, (order, number));
        }
        Some((order, number))
    }

    fn cut_parameters(&mut self, scope: &Scope<'_>, cut: Cut, curve: &Curve) -> Option<CutParameters> {
        let bottom = self.needed(scope, if cut == Cut::Mark { Letter::D } else { Letter::B });
        let bars = if cut == Cut::Support { Some(self.bars(scope, curve.length())?) } else { None };
        let own = scope.values;
        Some(CutParameters {
            cut,
            feed: self.allowed(scope, Letter::F),
            bottom: bottom?,
            bars,
            chain: ChainParameters {
                infeed: self.allowed(scope, Letter::I),
                peck: self.allowed(scope, Letter::C),
                first_depth: self.allowed(scope, Letter::W),
            },
            chain_letters: scope.element.text.filter(|_| own.letters().has_any(CHAIN_LETTERS)),
            comment: own.text(Letter::Q).map(Into::into),
        })
    }

    /// The bars of a segment of this length, with room for the cutter between each two.
    pub(super) fn bars(&mut self, scope: &Scope<'_>, length: f64) -> Option<Bars> {
        let (top, bar, distance) =
            (self.needed(scope, Letter::D), self.needed(scope, Letter::P), self.needed(scope, Letter::U));
        let bars = Bars { top: top?, length: bar?, distance: distance? };
        self.check_room(scope.element, &bars, length, scope.tool?);
        Some(bars)
    }

    fn check_room(&mut self, element: &Element, bars: &Bars, length: f64, tool: f64) {
        let count = bars.count(length);
        let gap = length / count - bars.length;
        if count > 0.0 && !at_least(gap, tool) {
            let problem = Diagnostic::new(&walk::NO_ROOM_BETWEEN_BARS)
                .with("count", count)
                .with("gap", gap)
                .with("tool", tool);
            self.report(At::Element(element), problem);
        }
    }
}
