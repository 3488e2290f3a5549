//! Cuts in waste that earlier cuts have separated from the plate. (book: language/part)

use std::cell::OnceCell;
use std::ops::Range;

use rstar::{AABB, Envelope as _};

use super::cuts::{MIN_CUT_DEPTH, THROUGH_HEIGHT};
use super::intervals::{Stretch, add_stretches_within, gaps_between, join_stretches};
use super::loose::is_enclosed;
use super::neighbours::PlacedCuts;
use super::placed_part;
use super::prepared::{PreparedPart, Side};
use crate::boxes::widened_box;
use crate::geometry::{Curve, Xy};

/// The first cuts of a placed path.
#[derive(Clone, Copy, Debug)]
pub struct EarlierCuts<'p, 'c> {
    /// The path.
    pub path: &'p PlacedCuts<'c>,
    /// The number of cuts, from the start of [`PathCuts::cuts`](super::PathCuts::cuts).
    pub count: usize,
}

/// A cut in a piece of waste that earlier cuts have separated from the plate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WasteCut {
    /// Index of the cutting element in [`PathCuts::elements`](super::PathCuts::elements).
    pub element: u32,
    /// The start of the outline of the opening from which the waste comes, as placed.
    pub opening: Xy,
}

/// Length in mm from which a stretch of a cut in waste counts.
const MIN_STRETCH: f64 = 0.01;

impl PlacedCuts<'_> {
    /// Returns the first cut of the path `later` that lies in the waste of an opening of this path's parts after the earlier cuts in that opening
    /// have left nothing that holds the waste. A cut where they have removed the waste does not count. `cuts` are the cuts to check, as indices into
    /// [`PathCuts::cuts`](super::PathCuts::cuts).
    pub fn cut_in_loose_waste(
        &self,
        later: &Self,
        cuts: Range<usize>,
        earlier: &[EarlierCuts<'_, '_>],
    ) -> Option<WasteCut> {
        let mut parts = self.parts.iter().filter(|part| part.rings.len() > 1);
        parts.find_map(|part| {
            let part = placed_part(part, &self.placement);
            let part = PreparedPart::new(&part);
            let openings = part.part.rings.iter().enumerate().skip(1);
            let mut outermost = openings.filter(|(_, drawn)| drawn.around.is_empty());
            outermost.find_map(|(ring, _)| {
                let through_cuts = OnceCell::new();
                Opening { owner: self, part: &part, ring, earlier, through_cuts }
                    .cut_in_loose_waste(later, cuts.clone())
            })
        })
    }

    /// Returns the sections of these cuts below a height in the program, as placed, each with its element.
    fn curves_below(&self, cuts: Range<usize>, height: f64) -> impl Iterator<Item = (u32, Curve)> {
        self.cuts.cuts.iter().take(cuts.end).skip(cuts.start).filter_map(move |cut| {
            let below = cut.way.part_below(height - self.raised)?;
            Some((cut.element, self.place(&below, self.circle_of(cut))))
        })
    }
}

/// An opening of a placed part, with the cuts that may have separated its waste from the plate.
struct Opening<'o> {
    owner: &'o PlacedCuts<'o>,
    part: &'o PreparedPart<'o>,
    /// Index of the opening's ring.
    ring: usize,
    earlier: &'o [EarlierCuts<'o, 'o>],
    /// The earlier cuts in the opening that go through the plate, each with its cutter radius. Computed when first needed.
    through_cuts: OnceCell<Vec<(Curve, f64)>>,
}

impl Opening<'_> {
    fn cut_in_loose_waste(&self, later: &PlacedCuts<'_>, cuts: Range<usize>) -> Option<WasteCut> {
        let top = self.owner.raised + self.owner.cuts.thickness - MIN_CUT_DEPTH;
        let extent = self.extent();
        let cuts = later.curves_below(cuts, top);
        let mut near = cuts.filter(|(_, curve)| widened_box(curve, 0.0).intersects(&extent));
        near.find_map(|(element, curve)| {
            let is_loose = self.points_in_waste(&curve).any(|at| is_enclosed(at, self.through_cuts()));
            let opening = self.part.part.rings[self.ring].curves[0].start();
            is_loose.then_some(WasteCut { element, opening })
        })
    }

    fn extent(&self) -> AABB<[f64; 2]> {
        self.part.ring_extent(self.ring)
    }

    /// Returns a point of each stretch of a cut that lies in waste of the opening.
    fn points_in_waste(&self, curve: &Curve) -> impl Iterator<Item = Xy> {
        let mut removed: Vec<Stretch> = Vec::new();
        for (other, radius) in self.through_cuts() {
            add_stretches_within(curve, other, *radius, &mut removed);
        }
        let length = curve.length();
        let mut stretches = gaps_between(&join_stretches(removed, MIN_STRETCH), (0.0, length));
        stretches.retain(|(from, to)| to - from > MIN_STRETCH.min(length / 2.0));
        if length == 0.0 {
            stretches.push((0.0, 0.0));
        }
        let along = *curve;
        let middles = stretches.into_iter().map(move |(from, to)| along.at(f64::midpoint(from, to)));
        let is_removed =
            |at: Xy| self.through_cuts().iter().any(|(cut, radius)| cut.distance_to(at) < *radius);
        middles.filter(move |at| self.contains(*at) && !is_removed(*at))
    }

    fn contains(&self, at: Xy) -> bool {
        matches!(self.part.side(at), Side::Openings(openings) if openings.contains(&self.ring))
    }

    /// Returns the earlier cuts in the opening that go through the plate.
    fn through_cuts(&self) -> &[(Curve, f64)] {
        self.through_cuts.get_or_init(|| {
            let extent = self.extent();
            let is_near = |earlier: &&EarlierCuts<'_, '_>| {
                earlier.path.swept.is_some_and(|swept| swept.intersects(&extent))
            };
            let through = self.earlier.iter().filter(is_near).flat_map(|EarlierCuts { path, count }| {
                let curves = path.curves_below(0..*count, self.owner.raised + THROUGH_HEIGHT);
                curves.map(|(_, curve)| (curve, path.cuts.radius))
            });
            let is_inside = |(curve, _): &(Curve, f64)| self.contains(curve.middle());
            through.filter(is_inside).collect()
        })
    }
}
