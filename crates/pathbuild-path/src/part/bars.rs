//! Support bars that cuts of their own path or of another one take away. (book: language/part)

use std::collections::BTreeMap;

use pathbuild_diagnostic::{Diagnostic, Message, Severity};

use super::cuts::{CutIndex, PathCuts, StandingBar};
use super::intervals::{JOIN_GAP, Stretch, add_stretches_within, joined_length};
use super::loose::MAX_WEAK_BRIDGE;
use crate::approx;
use crate::boxes::{BoxIndex, widened_box};
use crate::element::diagnostic_point;
use crate::geometry::{Curve, Xy};

/// Share of a bar's length up to which its loss is not reported.
const BAR_LOSS: f64 = 0.05;

/// A support bar that the cuts of a path take away.
#[derive(Clone, Debug, PartialEq)]
pub struct LostBar {
    /// Index of the path to which the bar belongs.
    pub path: usize,
    /// Number of the bar among the bars of its path.
    pub bar: usize,
    /// Index of the path that cuts the bar away.
    pub cut_by: usize,
    /// The element that takes most of the bar, as an index into [`PathCuts::elements`] of the path that cuts the bar away.
    pub element: u32,
    /// The length in mm that is cut away.
    pub lost: f64,
    /// The length of the bar in mm.
    pub length: f64,
    /// The midpoint of the bar; for a bar at a corner, the corner.
    pub at: Xy,
    /// The centre line of the bar. A bar at a corner has a section on each side of the corner.
    pub sections: Vec<Curve>,
    /// Whether the bar is a whole segment so short that cuts of its own path on both sides leave nothing of it.
    pub is_too_short: bool,
}

/// Returns the bars of all paths that are cut away, once for each path that cuts one away. A bar is left out if all cuts together leave P of it,
/// which suffices to hold the part: for example, a long bar round a corner to which a cut leads.
pub(super) fn lost_bars(cuts: &CutIndex<'_>, tolerance: f64) -> Vec<LostBar> {
    let mut found = Vec::new();
    for (path, own) in cuts.paths.iter().enumerate() {
        // In most drawings no cut takes anything of a bar, so nothing needs to be grouped.
        let is_untouched = |bar| BarLoss { cuts, tolerance, bar: &[bar] }.losses().is_empty();
        if standing_bars(own).all(is_untouched) {
            continue;
        }
        for (bar, whole) in whole_bars(own).into_iter().enumerate() {
            let losses = BarLoss { cuts, tolerance, bar: &whole }.losses();
            let sections: Vec<Curve> = whole.iter().map(|(_, middle)| *middle).collect();
            let length = sections.iter().map(Curve::length).sum();
            let remaining = length - joined_length(losses.values().flat_map(BTreeMap::values).flatten());
            let required = whole.iter().map(|(bar, _)| bar.required).fold(0.0, f64::max).min(length);
            if remaining >= (1.0 - BAR_LOSS) * required {
                continue;
            }
            found.extend(losses.into_iter().filter_map(|(cut_by, elements)| {
                let (lost, element) = total_loss(&elements)?;
                let at = middle_of(&sections);
                let is_lost = lost > BAR_LOSS * length;
                let is_segment = matches!(&whole[..], [(bar, _)] if bar.foot.length() <= length + JOIN_GAP);
                let is_too_short =
                    cut_by == path && is_segment && length <= 2.0 * own.radius + MAX_WEAK_BRIDGE;
                let sections = sections.clone();
                is_lost.then_some(LostBar {
                    path,
                    bar,
                    cut_by,
                    element,
                    lost,
                    length,
                    at,
                    sections,
                    is_too_short,
                })
            }));
        }
    }
    found
}

impl LostBar {
    /// Returns PB218 for bars that the same element takes away from a path: a warning if all of them are too short, otherwise an error. The bar that
    /// loses most is named.
    pub fn problem<'l>(
        bars: impl IntoIterator<Item = &'l Self>,
        path: &PathCuts,
        message: &'static Message,
    ) -> Option<Diagnostic> {
        let bars: Vec<&Self> = bars.into_iter().collect();
        let worst = bars
            .iter()
            .copied()
            .reduce(|worst, next| if worst.is_exceeded_by(next) { next } else { worst })?;
        let problem = Diagnostic::new(message)
            .with("lost", worst.lost)
            .with("length", worst.length)
            .with("point", diagnostic_point(worst.at))
            .quoting("other", path.name.as_str());
        let mut problem = problem.with("count", bars.len());
        if bars.iter().all(|bar| bar.is_too_short) {
            problem.severity = Severity::Warning;
        }
        Some(problem)
    }

    /// Whether another bar loses more. Of equal losses, the leftmost counts, as for cuts into the part.
    pub fn is_exceeded_by(&self, other: &Self) -> bool {
        let is_left = || (other.at.x, other.at.y) < (self.at.x, self.at.y);
        other.lost > self.lost + JOIN_GAP || (other.lost >= self.lost - JOIN_GAP && is_left())
    }
}

/// Returns the bars of a path of which something stands, each with the section of its centre line that stands.
fn standing_bars(path: &PathCuts) -> impl Iterator<Item = (&StandingBar, Curve)> {
    path.bars.iter().filter_map(|bar| Some((bar, bar.middle?)))
}

/// Groups the standing bars of a path: those on both sides of a corner are a single bar.
fn whole_bars(path: &PathCuts) -> Vec<Vec<(&StandingBar, Curve)>> {
    let bars: Vec<(&StandingBar, Curve)> = standing_bars(path).collect();
    let extent = |number: usize| widened_box(&bars[number].1, BOX_MARGIN);
    let boxes = BoxIndex::new((0..bars.len()).map(extent));
    let mut is_grouped = vec![false; bars.len()];
    let mut found = Vec::new();
    for first in 0..bars.len() {
        if std::mem::replace(&mut is_grouped[first], true) {
            continue;
        }
        let mut group = vec![first];
        let mut next = 0;
        while let Some(member) = group.get(next).copied() {
            for other in boxes.near(extent(member)) {
                if !is_grouped[other] && common_end(&bars[member].1, &bars[other].1).is_some() {
                    is_grouped[other] = true;
                    group.push(other);
                }
            }
            next += 1;
        }
        found.push(group.into_iter().map(|number| bars[number]).collect());
    }
    found
}

/// Margin in mm around the boxes of bars, larger than the distance up to which ends coincide.
const BOX_MARGIN: f64 = 0.01;

fn common_end(one: &Curve, other: &Curve) -> Option<Xy> {
    let ends = [one.start(), one.end()];
    ends.into_iter().find(|end| [other.start(), other.end()].iter().any(|at| approx::coincide(*end, *at)))
}

/// Returns the midpoint of a bar, or the first corner round which it stands.
fn middle_of(sections: &[Curve]) -> Xy {
    let corner = sections.windows(2).find_map(|pair| common_end(&pair[0], &pair[1]));
    let middle = || sections.first().map(Curve::middle);
    corner.or_else(middle).unwrap_or_else(Xy::origin)
}

/// The stretches of a bar that are cut away, by path and element.
type Losses = BTreeMap<usize, BTreeMap<u32, Vec<Stretch>>>;

/// A bar, and the cuts that may take it away.
struct BarLoss<'b> {
    cuts: &'b CutIndex<'b>,
    tolerance: f64,
    /// The sections of the bar.
    bar: &'b [(&'b StandingBar, Curve)],
}

impl BarLoss<'_> {
    /// Returns what is cut away, as stretches along all sections of the bar, one after another.
    fn losses(&self) -> Losses {
        let mut losses = Losses::new();
        let mut start = 0.0;
        for (bar, middle) in self.bar {
            for number in self.cuts.possibly_covering_cuts(middle, self.tolerance) {
                let cut = &self.cuts.cuts[number];
                let Some(below) = cut.cut.way.part_below(bar.top - self.tolerance) else { continue };
                let mut stretches = Vec::new();
                add_stretches_within(middle, &below, cut.radius - self.tolerance, &mut stretches);
                if !stretches.is_empty() {
                    let of_path = losses.entry(cut.path).or_default();
                    let along = stretches.into_iter().map(|(from, to)| (from + start, to + start));
                    of_path.entry(cut.cut.element).or_default().extend(along);
                }
            }
            start += middle.length();
        }
        losses
    }
}

/// Returns the length in mm that the elements of a path cut away, and the element that cuts most of it away.
fn total_loss(elements: &BTreeMap<u32, Vec<Stretch>>) -> Option<(f64, u32)> {
    let lengths = elements.iter().map(|(element, stretches)| (joined_length(stretches), *element));
    let (_, element) = lengths.reduce(|most, next| if next.0 > most.0 + JOIN_GAP { next } else { most })?;
    Some((joined_length(elements.values().flatten()), element))
}
