//! Support bars that other cuts take away. (book: language/part)

use std::collections::BTreeMap;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::part as messages;

use super::cuts::{CutIndex, StandingBar};
use super::intervals::{GAP, Stretch, at as at_along, joined, within};
use crate::element::shown;
use crate::geometry::Curve;
use crate::keep_out::around;

/// Share of a bar that may be cut away.
const BAR_LOSS: f64 = 0.05;

/// PB218 for each element that cuts a bar away, with its path.
pub(super) fn bars_cut_away(cuts: &CutIndex<'_>, tolerance: f64) -> Vec<(usize, Diagnostic)> {
    let mut found = Vec::new();
    for path in cuts.paths {
        for bar in &path.bars {
            let Some(middle) = &bar.middle else { continue };
            for ((cutting, element), lost) in (BarLoss { bar, middle, cuts, tolerance }).elements() {
                let problem = Diagnostic::new(&messages::BAR_CUT_AWAY)
                    .with("lost", lost)
                    .with("length", middle.length())
                    .with("point", shown(at_along(middle, middle.length() / 2.0)))
                    .quoting("other", path.name.as_str());
                found.push((cutting, cuts.paths[cutting].at_element(element, problem)));
            }
        }
    }
    found
}

/// A bar, and the cuts that may take it away.
struct BarLoss<'b> {
    bar: &'b StandingBar,
    middle: &'b Curve,
    cuts: &'b CutIndex<'b>,
    tolerance: f64,
}

impl BarLoss<'_> {
    /// What each element of each path takes of the bar, in mm, if it is too much.
    fn elements(&self) -> Vec<((usize, u32), f64)> {
        let mut gone: BTreeMap<(usize, u32), Vec<Stretch>> = BTreeMap::new();
        for number in self.cuts.near(around(self.middle, 0.0)) {
            let cut = &self.cuts.cuts[number];
            let Some(below) = cut.cut.way.below(self.bar.top - self.tolerance) else { continue };
            let mut stretches = Vec::new();
            within(self.middle, &below, cut.radius - self.tolerance, &mut stretches);
            if !stretches.is_empty() {
                gone.entry((cut.path, cut.cut.element)).or_default().append(&mut stretches);
            }
        }
        let lost = |stretches| joined(stretches, GAP).iter().map(|(from, to)| to - from).sum::<f64>();
        let all = gone.into_iter().map(|(element, stretches)| (element, lost(stretches)));
        all.filter(|(_, lost)| *lost > BAR_LOSS * self.middle.length()).collect()
    }
}
