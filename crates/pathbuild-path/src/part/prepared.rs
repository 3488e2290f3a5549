//! A part prepared for queries: on which side of it a point lies, and how deep a cutter at that point goes into the part.

use std::cell::OnceCell;

use rstar::{AABB, Envelope as _};

use super::intervals::{JOIN_GAP, Stretch, add_stretches_within, join_stretches};
use super::{Part, PartRing};
use crate::boxes::{BoxIndex, square, widened_box};
use crate::geometry::{Curve, Xy};
use crate::keep_out::Outline;

/// A part with its rings indexed.
pub(crate) struct PreparedPart<'p> {
    pub(crate) part: &'p Part,
    rings: Vec<PreparedRing>,
    /// The curves of all rings, each with its ring.
    curves: Vec<(usize, Curve)>,
    curve_boxes: BoxIndex,
}

/// A ring with its outline, which is computed only when a point in the ring's box is looked up.
struct PreparedRing {
    extent: AABB<[f64; 2]>,
    length: f64,
    outline: OnceCell<Outline>,
}

/// The result of moving a cutter past a part or into it.
pub(crate) struct CutterPassage {
    /// The side of the part on which the midpoint of the cutter's path lies.
    pub(crate) side: Side,
    /// The stretches on which the cutter goes into the part.
    pub(crate) entered: Vec<Stretch>,
}

/// The position of a point relative to a part.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Side {
    Outside,
    Material,
    /// Inside these openings, given as indices into [`Part::rings`].
    Openings(Vec<usize>),
}

impl Side {
    /// Whether this is the side of a ring on which waste lies.
    pub(crate) fn is_beside(&self, ring: usize) -> bool {
        match self {
            Self::Outside => ring == 0,
            Self::Openings(openings) => openings.contains(&ring),
            Self::Material => false,
        }
    }
}

impl CutterPassage {
    /// Returns the passage along a curve that lies entirely on one side.
    pub(crate) fn on_side(side: Side, way: &Curve) -> Self {
        let entered = if side == Side::Material { vec![(0.0, way.length())] } else { Vec::new() };
        Self { side, entered }
    }
}

impl<'p> PreparedPart<'p> {
    pub(crate) fn new(part: &'p Part) -> Self {
        let ring = |ring: &PartRing| {
            let boxes = ring.curves.iter().map(|curve| widened_box(curve, BOX_MARGIN));
            let extent = boxes.reduce(|one, other| one.merged(&other)).unwrap_or_else(AABB::new_empty);
            PreparedRing {
                extent,
                length: ring.curves.iter().map(Curve::length).sum(),
                outline: OnceCell::new(),
            }
        };
        let numbered = (0..).zip(&part.rings);
        let curves: Vec<(usize, Curve)> =
            numbered.flat_map(|(ring, drawn)| drawn.curves.iter().map(move |curve| (ring, *curve))).collect();
        Self {
            part,
            rings: part.rings.iter().map(ring).collect(),
            curve_boxes: BoxIndex::new(curves.iter().map(|(_, curve)| widened_box(curve, BOX_MARGIN))),
            curves,
        }
    }

    pub(crate) fn extent(&self) -> AABB<[f64; 2]> {
        self.rings[0].extent
    }

    pub(crate) fn ring_extent(&self, ring: usize) -> AABB<[f64; 2]> {
        self.rings[ring].extent
    }

    /// Returns the length of a ring in mm.
    pub(crate) fn ring_length(&self, ring: usize) -> f64 {
        self.rings[ring].length
    }

    /// Returns the curves of a ring, each with the distance in mm along the ring at which it begins.
    pub(crate) fn ring_curves(&self, ring: usize) -> impl Iterator<Item = (f64, &'p Curve)> {
        self.part.rings[ring].curves.iter().scan(0.0, |end, curve| {
            let start = *end;
            *end += curve.length();
            Some((start, curve))
        })
    }

    /// Returns the curves of a stretch of a ring. The stretch may begin below 0 if it runs across the ring's start.
    pub(crate) fn ring_section(&self, ring: usize, (from, to): Stretch) -> Vec<Curve> {
        let mut begin = -self.ring_length(ring);
        let curves = &self.part.rings[ring].curves;
        let section = |curve: &Curve| {
            let length = curve.length();
            let (first, last) = ((from - begin).max(0.0), (to - begin).min(length));
            begin += length;
            (first < last).then(|| curve.section(first, last))
        };
        curves.iter().chain(curves).filter_map(section).collect()
    }

    /// Returns the point of a ring at a distance along the ring, which may be below 0 for a stretch across the ring's start.
    pub(crate) fn ring_point(&self, ring: usize, along: f64) -> Xy {
        let (curve, along) = self.ring_place(ring, along);
        curve.at(along)
    }

    /// Returns the curve of a ring at a distance along the ring, as in [`Self::ring_point`], and the distance along that curve.
    pub(crate) fn ring_place(&self, ring: usize, along: f64) -> (&'p Curve, f64) {
        let curves = &self.part.rings[ring].curves;
        let mut along = if along < 0.0 { along + self.ring_length(ring) } else { along };
        for curve in curves {
            let length = curve.length();
            if along <= length {
                return (curve, along);
            }
            along -= length;
        }
        (&curves[0], 0.0)
    }

    /// Returns the curves near a box, with their rings.
    pub(crate) fn curves_near(&self, extent: AABB<[f64; 2]>) -> impl Iterator<Item = (usize, &Curve)> {
        let near = self.curve_boxes.near(extent);
        near.map(|number| (self.curves[number].0, &self.curves[number].1))
    }

    pub(crate) fn side(&self, at: Xy) -> Side {
        let inside: Vec<usize> = (0..self.rings.len()).filter(|ring| self.contains(*ring, at)).collect();
        match inside.split_first() {
            Some((0, [])) => Side::Material,
            Some((0, openings)) => Side::Openings(openings.to_vec()),
            _ => Side::Outside,
        }
    }

    pub(crate) fn contains(&self, ring: usize, at: Xy) -> bool {
        let PreparedRing { extent, outline, .. } = &self.rings[ring];
        extent.contains_point(&[at.x, at.y])
            && outline.get_or_init(|| Outline::new(&self.part.rings[ring].curves)).contains(at)
    }

    /// Whether a curve comes nearer to the outermost ring than `reach` mm.
    pub(crate) fn is_near_rim(&self, curve: &Curve, reach: f64) -> bool {
        let mut near = self.curves_near(widened_box(curve, reach));
        near.any(|(ring, rim)| ring == 0 && rim.distance(curve) < reach)
    }

    /// Returns the distance in mm between a curve and the outermost ring.
    pub(crate) fn distance_to_rim(&self, curve: &Curve) -> f64 {
        let rim = self.part.rings[0].curves.iter();
        rim.map(|rim| rim.distance(curve)).fold(f64::INFINITY, f64::min)
    }

    pub(crate) fn is_material(&self, at: Xy) -> bool {
        self.side(at) == Side::Material
    }

    /// Returns the distance in mm from a point to the nearest ring, or to the given ring; a result above `reach` may be too large, or infinite.
    fn distance(&self, at: Xy, ring: Option<usize>, reach: f64) -> f64 {
        let curves = self.curves_near(square(at, reach));
        let of_ring = curves.filter(|(own, _)| ring.is_none_or(|ring| ring == *own));
        of_ring.map(|(_, curve)| curve.distance_to(at)).fold(f64::INFINITY, f64::min)
    }

    /// Returns the depth in mm to which a cutter of this radius goes into the part with its centre at a point; negative if the cutter stays outside.
    /// A cutter in nested openings needs to stay inside only one of them.
    pub(crate) fn depth(&self, at: Xy, radius: f64) -> f64 {
        match self.side(at) {
            Side::Outside => radius - self.distance(at, Some(0), radius),
            Side::Openings(openings) => {
                let depth = |ring: usize| radius - self.distance(at, Some(ring), radius);
                openings.into_iter().map(depth).fold(f64::INFINITY, f64::min)
            }
            Side::Material => {
                let mut reach = radius.max(1.0);
                loop {
                    let distance = self.distance(at, None, reach);
                    if distance <= reach || reach > MAX_DISTANCE {
                        return radius + distance.min(MAX_DISTANCE);
                    }
                    reach *= 4.0;
                }
            }
        }
    }

    /// Returns the side on which a whole curve lies; `None` if the curve comes nearer to a ring than `radius - tolerance`.
    pub(crate) fn clear_side(&self, way: &Curve, radius: f64, tolerance: f64) -> Option<Side> {
        let reach = (radius - tolerance).max(JOIN_GAP);
        let mut near = self.curves_near(widened_box(way, radius));
        (!near.any(|(_, curve)| curve.distance(way) < reach)).then(|| self.side(way.start()))
    }

    /// Returns the passage of a cutter of this radius along a curve: the stretches are those on which it goes deeper than `tolerance` into the part.
    pub(crate) fn passage(&self, way: &Curve, radius: f64, tolerance: f64) -> CutterPassage {
        match self.clear_side(way, radius, tolerance) {
            Some(side) => CutterPassage::on_side(side, way),
            None => CutterPassage {
                side: self.side(way.middle()),
                entered: self.entered_stretches(way, radius, tolerance),
            },
        }
    }

    /// Returns the stretches of a curve on which a cutter of this radius goes deeper than `tolerance` into the part. A curve without length gives a
    /// stretch without length.
    fn entered_stretches(&self, way: &Curve, radius: f64, tolerance: f64) -> Vec<Stretch> {
        let length = way.length();
        if length == 0.0 {
            let is_deep = self.depth(way.start(), radius) > tolerance;
            return if is_deep { vec![(0.0, 0.0)] } else { Vec::new() };
        }
        // The depth of the cutter in the part changes continuously along the way. It can cross the tolerance only where the distance to a ring is
        // `radius - tolerance`, so the way is divided there.
        let mut cuts = Vec::new();
        for (_, curve) in self.curves_near(widened_box(way, radius)) {
            add_stretches_within(way, curve, radius - tolerance, &mut cuts);
        }
        let mut ends: Vec<f64> = cuts.into_iter().flat_map(|(from, to)| [from, to]).collect();
        ends.extend([0.0, length]);
        ends.sort_by(f64::total_cmp);
        let is_deep = |cut: &&[f64]| {
            let middle = way.at(f64::midpoint(cut[0], cut[1]));
            cut[1] - cut[0] > JOIN_GAP && self.depth(middle, radius) > tolerance
        };
        join_stretches(ends.windows(2).filter(is_deep).map(|cut| (cut[0], cut[1])).collect(), JOIN_GAP)
    }

    /// Returns the deepest place of a stretch, and the depth there. The stretch is sampled, and the search is refined around the best sample.
    pub(crate) fn deepest(&self, way: &Curve, (from, to): Stretch, radius: f64) -> (Xy, f64) {
        let place = |along: f64| way.at(along);
        let depth = |along: f64| self.depth(place(along), radius);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let samples = ((to - from) / SAMPLE_DISTANCE).ceil().clamp(8.0, 64.0) as u32;
        let step = (to - from) / f64::from(samples);
        let sampled = (0..=samples).map(|number| from + step * f64::from(number));
        let deeper = |best: (f64, f64), next: (f64, f64)| if next.0 > best.0 { next } else { best };
        let best = sampled.map(|along| (depth(along), along)).fold((f64::NEG_INFINITY, from), deeper);
        let (mut low, mut high) = ((best.1 - step).max(from), (best.1 + step).min(to));
        for _ in 0..REFINEMENT_STEPS {
            let third = (high - low) / 3.0;
            if depth(low + third) < depth(high - third) { low += third } else { high -= third }
        }
        let middle = f64::midpoint(low, high);
        let best = deeper(best, (depth(middle), middle));
        (place(best.1), best.0)
    }
}

/// Margin in mm around bounding boxes, larger than the gap that rounding leaves between ends that meet.
const BOX_MARGIN: f64 = 1e-4;

/// Upper bound in mm on distances: no part is larger.
const MAX_DISTANCE: f64 = 1e7;

/// Intended distance in mm between the samples of a stretch, of which there are 8 to 64.
const SAMPLE_DISTANCE: f64 = 0.5;

/// Number of steps of the search beside the best sample, each of which reduces the range by a third.
const REFINEMENT_STEPS: usize = 20;
