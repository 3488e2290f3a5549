//! Support bars that other cuts take away. (book: language/part)

use std::collections::BTreeMap;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::part as messages;

use super::cuts::{CutIndex, PathCuts, StandingBar};
use super::intervals::{JOIN_GAP, Stretch, add_stretches_within, at as at_along, join_stretches};
use crate::element::diagnostic_point;
use crate::geometry::{Curve, Xy};
use crate::keep_out::widened_box;

/// Share of a bar's length up to which its loss is not reported.
const BAR_LOSS: f64 = 0.05;

/// A support bar that the cuts of an element take away.
#[derive(Clone, Debug, PartialEq)]
pub struct LostBar {
    /// Index of the path to which the bar belongs.
    pub of: usize,
    /// Index of the path that cuts the bar away.
    pub by: usize,
    /// Index into [`PathCuts::elements`] of the path that cuts the bar away.
    pub element: u32,
    /// The length in mm that is cut away.
    pub lost: f64,
    /// The length of the bar in mm.
    pub length: f64,
    /// The midpoint of the bar.
    pub at: Xy,
    /// The middle line of the bar.
    pub middle: Curve,
}

/// Returns the bars of all paths that are cut away, once for each element that cuts one away.
pub(super) fn lost_bars(cuts: &CutIndex<'_>, tolerance: f64) -> Vec<LostBar> {
    let mut found = Vec::new();
    for (of, path) in cuts.paths.iter().enumerate() {
        for bar in &path.bars {
            let Some(middle) = &bar.middle else { continue };
            let length = middle.length();
            let at = at_along(middle, length / 2.0);
            let elements = BarLoss { bar, middle, cuts, tolerance }.elements();
            let lost = |((by, element), lost)| LostBar { of, by, element, lost, length, at, middle: *middle };
            found.extend(elements.into_iter().map(lost));
        }
    }
    found
}

impl LostBar {
    /// Returns PB218. `path` is the path to which the bar belongs.
    pub fn problem(&self, path: &PathCuts) -> Diagnostic {
        Diagnostic::new(&messages::BAR_CUT_AWAY)
            .with("lost", self.lost)
            .with("length", self.length)
            .with("point", diagnostic_point(self.at))
            .quoting("other", path.name.as_str())
    }
}

/// A bar, and the cuts that may take it away.
struct BarLoss<'b> {
    bar: &'b StandingBar,
    middle: &'b Curve,
    cuts: &'b CutIndex<'b>,
    tolerance: f64,
}

impl BarLoss<'_> {
    /// Returns the elements that cut too much of the bar away, by path and element, each with the length that it cuts away in mm.
    fn elements(&self) -> Vec<((usize, u32), f64)> {
        let mut gone: BTreeMap<(usize, u32), Vec<Stretch>> = BTreeMap::new();
        for number in self.cuts.near(widened_box(self.middle, 0.0)) {
            let cut = &self.cuts.cuts[number];
            let Some(below) = cut.cut.way.part_below(self.bar.top - self.tolerance) else { continue };
            let mut stretches = Vec::new();
            add_stretches_within(self.middle, &below, cut.radius - self.tolerance, &mut stretches);
            if !stretches.is_empty() {
                gone.entry((cut.path, cut.cut.element)).or_default().append(&mut stretches);
            }
        }
        let lost =
            |stretches| join_stretches(stretches, JOIN_GAP).iter().map(|(from, to)| to - from).sum::<f64>();
        let all = gone.into_iter().map(|(element, stretches)| (element, lost(stretches)));
        all.filter(|(_, lost)| *lost > BAR_LOSS * self.middle.length()).collect()
    }
}
