//! The cuts that may close a ring round a part, together with the cuts of other paths beside it. (book: language/part)

use super::cuts::{CutIndex, IndexedCut};
use super::loose::is_cut_out;
use super::prepared::PreparedPart;
use crate::boxes::{widened, widened_box};
use crate::geometry::Curve;

/// A part with the paths that may cut it loose.
pub(super) struct Enclosure<'s> {
    part: &'s PreparedPart<'s>,
    cuts: &'s CutIndex<'s>,
    /// For each path, whether it cuts the part out. If so, all of its through cuts are considered.
    own: &'s [bool],
    /// The through cuts of other paths near the part's rim. The material that holds the part may end at them.
    beside: Vec<Cut<'s>>,
}

/// A through cut, with the section that goes through the plate.
type Cut<'s> = (&'s IndexedCut<'s>, Curve);

/// Returns the distance in mm from the rim of a part within which cuts of other paths are considered: twice O. `radius` is half of O.
pub(super) fn reach(radius: f64) -> f64 {
    4.0 * radius
}

impl<'s> Enclosure<'s> {
    pub(super) fn new(part: &'s PreparedPart<'s>, cuts: &'s CutIndex<'s>, own: &'s [bool]) -> Self {
        let owners = cuts.paths.iter().zip(own).filter(|(_, is_own)| **is_own);
        let largest = owners.map(|(path, _)| path.radius).fold(0.0, f64::max);
        let farthest = reach(cuts.paths.iter().map(|path| path.radius).fold(0.0, f64::max));
        let near = cuts.near(widened(&part.extent(), farthest)).map(|number| &cuts.cuts[number]);
        let others = near.filter(|cut| !own[cut.path] && cuts.contours[cut.path]);
        let is_beside = |(cut, curve): &Cut<'_>| part.is_near_rim(curve, reach(cut.radius.max(largest)));
        let beside = others.filter_map(with_through_section).filter(is_beside).collect();
        Self { part, cuts, own, beside }
    }

    /// If the cuts of the paths that cut the part out close a ring on their own, returns the first of these cuts within O of the rim, or else the
    /// first of all.
    pub(super) fn own_cut(&self) -> Option<&'s IndexedCut<'s>> {
        let through = self.own_cuts();
        if !self.is_closed(&through) {
            return None;
        }
        let near = through.iter().filter(|(cut, curve)| self.part.is_near_rim(curve, 2.0 * cut.radius));
        let (cut, _) = near.min_by_key(|(cut, _)| cut.number()).or(through.first())?;
        Some(cut)
    }

    /// Returns the cut of another path that closes a ring, if the cuts of the paths that cut the part out do not close one on their own: of the first
    /// other path that suffices, the cut that is nearest to the rim. If several other paths are needed to close the ring, the nearest of all their
    /// cuts.
    pub(super) fn severing_cut(&self) -> Option<&'s IndexedCut<'s>> {
        if self.beside.is_empty() {
            return None;
        }
        let own = self.own_cuts();
        let with = |others: &[Cut<'s>]| self.is_closed(&[&own, others].concat());
        if !with(&self.beside) || with(&[]) {
            return None;
        }
        let of_one_path = self.beside.chunk_by(|(one, _), (other, _)| one.path == other.path);
        let closing = of_one_path.into_iter().find(|cuts| with(cuts)).unwrap_or(&self.beside);
        let distance = |(_, curve): &Cut<'_>| self.part.distance_to_rim(curve);
        let (cut, _) = closing.iter().min_by(|one, other| {
            distance(one).total_cmp(&distance(other)).then_with(|| one.0.number().cmp(&other.0.number()))
        })?;
        Some(cut)
    }

    fn own_cuts(&self) -> Vec<Cut<'s>> {
        self.cuts.cuts.iter().filter(|cut| self.own[cut.path]).filter_map(with_through_section).collect()
    }

    fn is_closed(&self, through: &[Cut<'_>]) -> bool {
        let sweeps: Vec<(Curve, f64)> = through.iter().map(|(cut, curve)| (*curve, cut.radius)).collect();
        let extent = self.part.extent();
        let is_near = |curve: &Curve, radius: f64| {
            rstar::Envelope::intersects(&widened_box(curve, 2.0 * radius), &extent)
        };
        let paths = self.cuts.paths.iter().zip(&self.cuts.contours).filter(|(_, is_contour)| **is_contour);
        let bars = paths.flat_map(|(path, _)| path.bars.iter().map(|bar| (bar, path.radius)));
        is_cut_out(self.part, &sweeps, &bars.filter(|(bar, radius)| is_near(&bar.foot, *radius)))
    }
}

fn with_through_section<'s>(cut: &'s IndexedCut<'s>) -> Option<Cut<'s>> {
    Some((cut, cut.through_section()?))
}
