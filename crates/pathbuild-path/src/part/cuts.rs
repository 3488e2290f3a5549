//! The cuts of paths, in the form that the part check needs. (book: language/part)

use pathbuild_diagnostic::Diagnostic;
use rstar::{AABB, Envelope as _};

use super::intervals::JOIN_GAP;
use crate::boxes::{BoxIndex, widened, widened_box};
use crate::element::Origin;
use crate::geometry::{Curve, Xy};
use crate::keep_out::TipMove;
use crate::names::CaseSensitiveName;

/// The cuts of a path, in the coordinates and heights of its own drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct PathCuts {
    /// Name of the path.
    pub name: CaseSensitiveName,
    /// Half of O in mm.
    pub radius: f64,
    /// T in mm: the height of the material's upper face.
    pub thickness: f64,
    /// Whether the path is milled with a slot cutter.
    pub is_slot: bool,
    /// Corner radius of the cutter in mm; 0 for a flat tip.
    pub corner_radius: f64,
    /// The elements of the path that cut, then those of its sweeps.
    pub elements: Vec<CutElement>,
    /// The moves in the material, as if each element were milled in a single pass.
    pub cuts: Vec<PartCut>,
    /// The sweeps that the path draws.
    pub sweeps: Vec<PartSweep>,
    /// The support bars that the path leaves.
    pub bars: Vec<StandingBar>,
    /// The start and the end of the path.
    pub ends: (Xy, Xy),
    /// The paths that the path embeds. Their own `PathCuts` contain their cuts.
    pub embedded: Vec<EmbeddedPlace>,
}

/// The place of an embedded path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmbeddedPlace {
    /// Index of the embedding segment in [`Path::segments`](crate::Path::segments).
    pub segment: usize,
    /// The positions of the embedded path's start and end in this path's drawing.
    pub ends: (Xy, Xy),
    /// H in mm: the height by which the embedded path is raised.
    pub height: f64,
    /// The number of [cuts](PathCuts::cuts) of this path that come before the embedded path.
    pub cuts_before: usize,
}

/// A drawn element, with its depth.
#[derive(Clone, Debug, PartialEq)]
pub struct CutElement {
    /// Location of the drawn element.
    pub origin: Origin,
    /// Z of the element's lowest cut in mm; infinite for a sweep.
    pub lowest: f64,
    /// For an element with support bars, its whole segment: the cuts, and the sections with bars.
    pub supported: Option<Curve>,
    /// For an element with support bars, B: Z in mm down to which it mills between the bars. Infinite without bars.
    pub bottom: f64,
    /// The centre of a helical circle. Its cuts and bars are placed by [`Placement::of_circle`](crate::Placement::of_circle).
    pub circle: Option<Xy>,
}

/// A move in the material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartCut {
    /// The path of the tool tip.
    pub way: TipMove,
    /// Index into [`PathCuts::elements`].
    pub element: u32,
}

/// A sweep, above the material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartSweep {
    /// The sweep as drawn.
    pub curve: Curve,
    /// Index into [`PathCuts::elements`].
    pub element: u32,
}

/// A support bar that a path leaves standing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandingBar {
    /// The section of the bar's centre line that the cuts beside the bar leave; `None` if they leave nothing. If the bar is a whole segment of which
    /// cuts on both sides would leave nothing, the whole segment.
    pub middle: Option<Curve>,
    /// The section of the segment along which the bar and its slopes keep the tool above B.
    pub foot: Curve,
    /// Z of the bar's top in mm.
    pub top: f64,
    /// P: the length in mm that the bar needs in order to hold.
    pub required: f64,
    /// The centre of the helical circle on which the bar stands.
    pub circle: Option<Xy>,
}

/// Z in mm up to which a cut is considered to go through the plate: a cut that ends at Z0.001 still does.
pub const THROUGH_HEIGHT: f64 = 0.001 + 1e-6;

/// Depth in mm below a plate's upper face from which a cut is considered a cut into the plate.
pub(super) const MIN_CUT_DEPTH: f64 = 0.01;

impl PathCuts {
    /// Places a finding at an element, which is given as an index into [`Self::elements`].
    pub fn at_element(&self, element: u32, problem: Diagnostic) -> Diagnostic {
        self.elements[element as usize].origin.at(problem).in_path(self.name.as_str())
    }

    /// Whether the path cuts parts out: one of its cuts goes through the plate or leaves support bars, which hold nothing where the plate is whole,
    /// and it is not milled with a slot cutter.
    pub fn is_contour(&self) -> bool {
        let cuts_out = |element: &CutElement| element.lowest <= THROUGH_HEIGHT || element.supported.is_some();
        !self.is_slot && self.elements.iter().any(cuts_out)
    }
}

/// A cut of one of several paths.
pub(super) struct IndexedCut<'c> {
    pub(super) path: usize,
    pub(super) cut: &'c PartCut,
    pub(super) radius: f64,
}

/// A sweep of one of several paths.
pub(super) struct IndexedSweep<'c> {
    pub(super) path: usize,
    pub(super) sweep: &'c PartSweep,
    pub(super) radius: f64,
}

/// The cuts of all paths of a drawing, with an index of their boxes.
pub(super) struct CutIndex<'c> {
    pub(super) paths: &'c [&'c PathCuts],
    /// For each path, whether it cuts parts out. Of all other paths, only cuts into parts and into bars matter.
    pub(super) contours: Vec<bool>,
    pub(super) cuts: Vec<IndexedCut<'c>>,
    boxes: BoxIndex,
    pub(super) sweeps: Vec<IndexedSweep<'c>>,
    sweep_boxes: BoxIndex,
    largest_radius: f64,
}

impl<'c> CutIndex<'c> {
    pub(super) fn new(paths: &'c [&'c PathCuts]) -> Self {
        let of_path = |(path, cuts): (usize, &'c &'c PathCuts)| {
            cuts.cuts.iter().map(move |cut| IndexedCut { path, cut, radius: cuts.radius })
        };
        let mut cuts = Vec::with_capacity(paths.iter().map(|path| path.cuts.len()).sum());
        paths.iter().enumerate().for_each(|path| cuts.extend(of_path(path)));
        let sweeps_of_path = |(path, cuts): (usize, &'c &'c PathCuts)| {
            cuts.sweeps.iter().map(move |sweep| IndexedSweep { path, sweep, radius: cuts.radius })
        };
        let sweeps: Vec<_> = paths.iter().enumerate().flat_map(sweeps_of_path).collect();
        Self {
            paths,
            contours: paths.iter().map(|path| path.is_contour()).collect(),
            boxes: BoxIndex::new(cuts.iter().map(|cut| widened_box(&cut.cut.way.curve, 0.0))),
            cuts,
            sweep_boxes: BoxIndex::new(sweeps.iter().map(|sweep| widened_box(&sweep.sweep.curve, 0.0))),
            sweeps,
            largest_radius: paths.iter().map(|path| path.radius).fold(0.0, f64::max),
        }
    }

    /// Returns the numbers of the cuts that may come within the cutter's diameter of a box, in ascending order.
    pub(super) fn near(&self, extent: AABB<[f64; 2]>) -> impl Iterator<Item = usize> {
        let reach = |radius: f64| 2.0 * radius + JOIN_GAP;
        let is_near = move |number: &usize| {
            let IndexedCut { cut, radius, .. } = &self.cuts[*number];
            *radius >= self.largest_radius || widened_box(&cut.way.curve, reach(*radius)).intersects(&extent)
        };
        self.boxes.near(widened(&extent, reach(self.largest_radius))).filter(is_near)
    }

    /// Whether a cut may cut out an outline beside it: it goes through the plate, belongs to a segment with support bars, or is milled
    /// with a slot cutter.
    pub(super) fn may_cut_out(&self, cut: &IndexedCut<'c>) -> bool {
        cut.through_section().is_some()
            || cut.element(self).supported.is_some()
            || self.paths[cut.path].is_slot
    }

    /// Returns the numbers of the sweeps that may run beside a curve at a distance of half of O, in ascending order.
    pub(super) fn sweeps_beside(&self, curve: &Curve, tolerance: f64) -> impl Iterator<Item = usize> {
        self.sweep_boxes.near(widened_box(curve, self.largest_radius + tolerance))
    }

    /// Returns the numbers of the cuts that may cover part of a curve by more than `tolerance` mm, in ascending order.
    pub(super) fn possibly_covering_cuts(
        &self,
        curve: &Curve,
        tolerance: f64,
    ) -> impl Iterator<Item = usize> {
        self.boxes.near(widened_box(curve, self.largest_radius - tolerance))
    }
}

impl IndexedCut<'_> {
    /// Returns the index of the cut's path, and the index of the cut's element in that path.
    pub(super) fn number(&self) -> (usize, u32) {
        (self.path, self.cut.element)
    }

    /// Returns the section that goes through the plate.
    pub(super) fn through_section(&self) -> Option<Curve> {
        self.cut.way.part_below(THROUGH_HEIGHT)
    }

    /// Returns the section that must not enter a part: the one that goes through the plate. An element with support bars that goes through the plate
    /// between them is part of an outline and no groove, so everything that it mills in the material counts.
    pub(super) fn spoiling_section(&self, index: &CutIndex<'_>) -> Option<Curve> {
        if self.element(index).bottom > THROUGH_HEIGHT {
            return self.through_section();
        }
        let top = index.paths[self.path].thickness - MIN_CUT_DEPTH;
        self.cut.way.part_below(top.max(THROUGH_HEIGHT))
    }

    pub(super) fn element<'c>(&self, index: &CutIndex<'c>) -> &'c CutElement {
        &index.paths[self.path].elements[self.cut.element as usize]
    }
}
