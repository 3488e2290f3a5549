//! Cuts of one placed path into the parts and support bars of another, and whether the remaining material holds the parts. (book: language/part)

use rstar::{AABB, Envelope as _};

use super::bars::{LostBar, lost_bars};
use super::cuts::{CutIndex, PartCut, PathCuts, StandingBar};
use super::enclosure::{Enclosure, reach};
use super::gouge::{classify_cuts, gouges, level_for_cuts};
use super::prepared::PreparedPart;
use super::{Part, placed_part};
use crate::boxes::{widened, widened_box};
use crate::geometry::{Curve, Placement, Xy};
use crate::keep_out::TipMove;

/// A path at its place in a program.
#[derive(Clone, Debug)]
pub struct PlacedCuts<'c> {
    /// The path, as drawn.
    pub cuts: &'c PathCuts,
    /// The parts that are placed with the path, as drawn.
    pub parts: Vec<&'c Part>,
    /// The path's placement in the program.
    pub placement: Placement,
    /// The height in mm by which the path is raised.
    pub raised: f64,
    /// The bounding box of the area that the cutter covers, as placed; `None` if the path cuts nothing.
    pub(super) swept: Option<AABB<[f64; 2]>>,
    /// The bounding box of the path's parts and bars, as placed; `None` if it has none.
    kept: Option<AABB<[f64; 2]>>,
}

/// A cut into a part of another path.
#[derive(Clone, Debug, PartialEq)]
pub struct NeighbourGouge {
    /// Index into [`PlacedCuts::parts`] of the other path.
    pub part: usize,
    /// Index into [`PathCuts::elements`] of the path that cuts.
    pub element: u32,
    /// The centre of the cutter at the place where it goes deepest into the part, as placed.
    pub at: Xy,
    /// The depth at that place, in mm.
    pub depth: f64,
}

/// The cuts of a path into the parts and support bars of another one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NeighbourCuts {
    /// Cuts into the other path's parts.
    pub gouges: Vec<NeighbourGouge>,
    /// The other path's bars that are cut away.
    pub bars: Vec<LostBar>,
}

/// A part that the cuts of other paths separate from the material that its support bars connect it to.
#[derive(Clone, Debug, PartialEq)]
pub struct SeveredPart {
    /// Index of the part in [`PlacedCuts::parts`].
    pub part: usize,
    /// Index of the other path with the cut that closes the ring round the part.
    pub path: usize,
    /// Index of the cutting element in [`PathCuts::elements`] of that path.
    pub element: u32,
}

/// Distance in mm up to which two outlines are considered the same.
const SAME_PART_DISTANCE: f64 = 0.01;

impl<'c> PlacedCuts<'c> {
    /// Places a path and its parts, and computes their bounding boxes.
    pub fn new(cuts: &'c PathCuts, parts: Vec<&'c Part>, placement: Placement, raised: f64) -> Self {
        let merged = |one: AABB<[f64; 2]>, other: AABB<[f64; 2]>| one.merged(&other);
        let mut new = Self { cuts, parts, placement, raised, swept: None, kept: None };
        let swept = cuts.cuts.iter().map(|cut| new.place(&cut.way.curve, new.circle_of(cut)));
        let rims = new.parts.iter().flat_map(|part| &part.rings[0].curves);
        let rims = rims.map(|curve| placement.place_curve(curve));
        let bars = cuts.bars.iter().filter_map(|bar| Some(new.place(&bar.middle?, bar.circle)));
        let kept = rims.chain(bars).map(|curve| widened_box(&curve, 0.0)).reduce(merged);
        new.swept = swept.map(|curve| widened_box(&curve, cuts.radius)).reduce(merged);
        new.kept = kept;
        new
    }

    /// Returns a curve of the path as placed. `circle` is the centre of the helical circle to which it belongs.
    pub(super) fn place(&self, curve: &Curve, circle: Option<Xy>) -> Curve {
        let placement = circle.map_or(self.placement, |centre| self.placement.of_circle(centre));
        placement.place_curve(curve)
    }

    pub(super) fn circle_of(&self, cut: &PartCut) -> Option<Xy> {
        self.cuts.elements[cut.element as usize].circle
    }

    /// Whether support bars on helical circles stand elsewhere than in the path's drawing, because the path is turned and they are not.
    pub fn has_displaced_bars(&self) -> bool {
        self.placement.is_turned() && self.cuts.bars.iter().any(|bar| bar.circle.is_some())
    }

    /// Whether cuts of another path may reach the parts or bars of this one.
    pub fn is_reached_by(&self, other: &Self) -> bool {
        self.kept.zip(other.swept).is_some_and(|(kept, swept)| kept.intersects(&swept))
    }

    /// Returns the cuts that another path makes into the parts and bars of this one.
    pub fn cuts_made_by(&self, other: &Self, tolerance: f64) -> NeighbourCuts {
        if !self.is_reached_by(other) {
            return NeighbourCuts::default();
        }
        let level = level_for_cuts(self.raised, self.cuts.thickness, other.raised);
        let (own, mut cutting) = (self.placed(self.raised), other.placed(level));
        // What the other path mills above the plate of this one spoils nothing.
        cutting.thickness = self.raised + self.cuts.thickness - level;
        let paths = [&own, &cutting];
        let cuts = CutIndex::new(&paths);
        let mut gouged = Vec::new();
        for (number, part) in self.parts.iter().enumerate() {
            let part = placed_part(part, &self.placement);
            let prepared = PreparedPart::new(&part);
            let near = cuts.near(prepared.extent()).filter(|cut| cuts.cuts[*cut].path == 1);
            let judged = classify_cuts(&prepared, &cuts, near, tolerance);
            gouged.extend(gouges(&prepared, &cuts, &judged).into_iter().map(|((_, element), gouge)| {
                NeighbourGouge { part: number, element, at: gouge.at, depth: gouge.depth }
            }));
        }
        NeighbourCuts { gouges: gouged, bars: bars_taken(&own, &other.placed(self.raised), tolerance) }
    }

    /// Returns the support bars of this path that another path takes away.
    pub fn bars_taken_by(&self, other: &Self, tolerance: f64) -> Vec<LostBar> {
        bars_taken(&self.placed(self.raised), &other.placed(self.raised), tolerance)
    }

    /// Returns the support bars of this path that a path of the same drawing at the same place takes away because helical circles do not turn with
    /// them. Bars that it takes away in the drawing as well are reported there.
    pub fn bars_lost_by_turning(&self, other: &Self, tolerance: f64) -> Vec<LostBar> {
        if !self.has_displaced_bars() && !other.has_displaced_bars() {
            return Vec::new();
        }
        let drawn = [self, other].map(|path| path.placed_as_drawn(self.raised));
        let drawn = bars_taken(&drawn[0], &drawn[1], tolerance);
        let is_new = |lost: &LostBar| {
            !drawn.iter().any(|known| (known.bar, known.element) == (lost.bar, lost.element))
        };
        self.bars_taken_by(other, tolerance).into_iter().filter(is_new).collect()
    }

    /// Returns the parts that come loose because of cuts of other paths beside them, or because helical circles with support bars do not turn with
    /// them: in their drawing, the cuts of `own` alone leave material that holds them. `own` are the paths that belong to the same drawing at the
    /// same place, including this one; `others` are the remaining paths. Both are given with their index.
    pub fn severed_by(&self, own: &[(usize, &Self)], others: &[(usize, &Self)]) -> Vec<SeveredPart> {
        let is_near = |(_, other): &&(usize, &Self)| {
            let reach = reach(self.cuts.radius.max(other.cuts.radius));
            self.kept.zip(other.swept).is_some_and(|(kept, swept)| widened(&kept, reach).intersects(&swept))
        };
        let others: Vec<&(usize, &Self)> = others.iter().filter(is_near).collect();
        let is_displaced = own.iter().any(|(_, path)| path.has_displaced_bars());
        if self.parts.is_empty() || others.is_empty() && !is_displaced {
            return Vec::new();
        }
        let all: Vec<&(usize, &Self)> = own.iter().chain(others).collect();
        let placed: Vec<PathCuts> = all.iter().map(|(_, path)| path.placed(self.raised)).collect();
        let paths: Vec<&PathCuts> = placed.iter().collect();
        let cuts = CutIndex::new(&paths);
        let contours = cuts.contours.iter().enumerate();
        let is_own: Vec<bool> = contours.map(|(path, is_contour)| *is_contour && path < own.len()).collect();
        let as_drawn: Vec<PathCuts> = own.iter().map(|(_, path)| path.placed_as_drawn(self.raised)).collect();
        let as_drawn: Vec<&PathCuts> = as_drawn.iter().collect();
        let severed = self.parts.iter().enumerate().filter_map(|(number, part)| {
            let part = placed_part(part, &self.placement);
            let prepared = PreparedPart::new(&part);
            let enclosure = Enclosure::new(&prepared, &cuts, &is_own);
            let is_held_as_drawn = || {
                let cuts = CutIndex::new(&as_drawn);
                Enclosure::new(&prepared, &cuts, &is_own[..own.len()]).own_cut().is_none()
            };
            let of_own = || enclosure.own_cut().filter(|_| is_displaced && is_held_as_drawn());
            let cut = enclosure.severing_cut().or_else(of_own)?;
            Some(SeveredPart { part: number, path: all[cut.path].0, element: cut.cut.element })
        });
        severed.collect()
    }

    /// Whether a part of this path is equal to a part of another path, or contains it, as placed. Its outline then shows the other part once more, or
    /// the sheet from which the other part is cut.
    pub fn shows_part_of(&self, part: usize, other: &Self) -> bool {
        let is_near = self.kept.zip(other.kept).is_some_and(|(own, other)| own.intersects(&other));
        if !is_near {
            return false;
        }
        let own = placed_part(self.parts[part], &self.placement);
        let own = PreparedPart::new(&own);
        let is_on_rim =
            |at: Xy| own.part.rings[0].curves.iter().any(|curve| curve.distance_to(at) <= SAME_PART_DISTANCE);
        other.parts.iter().any(|inner| {
            let rim = placed_part(inner, &other.placement).rings.swap_remove(0).curves;
            let samples = rim.iter().flat_map(|curve| [curve.start(), curve.middle()]);
            samples.into_iter().all(|at| own.is_material(at) || is_on_rim(at))
        })
    }

    /// Returns the start of a part's outermost ring, as placed.
    pub fn start_of(&self, part: usize) -> Xy {
        self.placement.place(self.parts[part].rings[0].curves[0].start())
    }

    /// Returns the path as placed, with heights above a level.
    fn placed(&self, level: f64) -> PathCuts {
        self.placed_with(level, |curve, circle| self.place(curve, circle))
    }

    /// Returns the path as if its helical circles turned with it, so that everything lies as in its drawing.
    fn placed_as_drawn(&self, level: f64) -> PathCuts {
        self.placed_with(level, |curve, _| self.place(curve, None))
    }

    fn placed_with(&self, level: f64, place: impl Fn(&Curve, Option<Xy>) -> Curve) -> PathCuts {
        let raised = self.raised - level;
        let way = |cut: &PartCut| TipMove {
            curve: place(&cut.way.curve, self.circle_of(cut)),
            from_z: cut.way.from_z + raised,
            to_z: cut.way.to_z + raised,
        };
        let mut placed = PathCuts { sweeps: Vec::new(), ..self.cuts.clone() };
        placed.cuts.iter_mut().for_each(|cut| *cut = PartCut { way: way(cut), ..*cut });
        placed.elements.iter_mut().for_each(|element| {
            element.lowest += raised;
            element.bottom += raised;
            element.supported = element.supported.map(|segment| place(&segment, element.circle));
        });
        placed.bars.iter_mut().for_each(|bar| {
            let StandingBar { middle, foot, top, circle, .. } = *bar;
            *bar = StandingBar {
                middle: middle.map(|middle| place(&middle, circle)),
                foot: place(&foot, circle),
                top: top + raised,
                ..*bar
            };
        });
        placed
    }
}

/// Returns the support bars of one path that another one takes away.
fn bars_taken(own: &PathCuts, cutting: &PathCuts, tolerance: f64) -> Vec<LostBar> {
    let paths = [own, cutting];
    let is_taken = |lost: &LostBar| (lost.path, lost.cut_by) == (0, 1);
    lost_bars(&CutIndex::new(&paths), tolerance).into_iter().filter(is_taken).collect()
}
