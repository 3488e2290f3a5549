//! Cuts into a part. (book: language/part)

use std::collections::BTreeMap;

use rstar::Envelope as _;

use super::cuts::{CutIndex, IndexedCut, MIN_CUT_DEPTH, THROUGH_HEIGHT};
use super::intervals::{JOIN_GAP, Stretch, joined_length, stretch_of_section};
use super::prepared::{CutterPassage, PreparedPart, Side};
use super::{Part, placed_part};
use crate::boxes::widened_box;
use crate::geometry::{Curve, Placement, Xy};
use crate::keep_out::TipMove;

/// A cut that may go into the part, or that may shape its outline.
pub(super) struct ClassifiedCut<'c> {
    /// Number of the cut in the index.
    number: usize,
    pub(super) cut: &'c IndexedCut<'c>,
    /// The section that goes through the plate, or the whole curve if the cut does not go through it.
    pub(super) curve: Curve,
    /// The side of the part on which the middle of the curve lies.
    pub(super) side: Side,
    /// Whether the cutter goes into the part somewhere on the curve.
    pub(super) is_entering: bool,
}

/// A section of a cut that spoils the part.
pub(super) struct SpoilingSection<'c> {
    pub(super) cut: &'c IndexedCut<'c>,
    curve: Curve,
    /// The stretches of the curve on which the cutter goes into the part.
    entered: Vec<Stretch>,
}

/// The cuts near a part.
pub(super) struct ClassifiedCuts<'c> {
    /// The cuts that may shape an outline, in ascending order of their numbers.
    shaping: Vec<ClassifiedCut<'c>>,
    /// The sections that go into the part and must not.
    pub(super) spoiling: Vec<SpoilingSection<'c>>,
}

/// The damage that the cuts of one element do to a part.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Gouge {
    /// The centre of the cutter at the place where it goes deepest into the part.
    pub(super) at: Xy,
    /// The depth at that place, in mm.
    pub(super) depth: f64,
    /// The first cut or, with support bars, the whole segment.
    curve: Curve,
    /// The stretches along that curve on which the cutter goes into the part. Those of a helix and of passes at several heights lie on each other.
    entered: Vec<Stretch>,
}

/// Determines the side of the part on which each cut lies, and where the cut goes into the part. `numbers` are the numbers of the cuts to examine, in
/// ascending order. A cut that does not go through the plate may shape the outline only at the lowest depth of its element.
pub(super) fn classify_cuts<'c>(
    part: &PreparedPart<'_>,
    index: &'c CutIndex<'c>,
    numbers: impl Iterator<Item = usize>,
    tolerance: f64,
) -> ClassifiedCuts<'c> {
    let mut judged = ClassifiedCuts { shaping: Vec::new(), spoiling: Vec::new() };
    // Most segments with bars touch no ring. All cuts of such a segment are on one side, which is computed only once.
    let mut last: Option<((usize, u32), Option<Side>)> = None;
    for number in numbers {
        let cut = &index.cuts[number];
        let element = cut.element(index);
        let shapes = || cut.cut.way.lowest() <= element.lowest + JOIN_GAP;
        let shaping = cut.through_section().or_else(|| shapes().then_some(cut.cut.way.curve));
        let spoiling = cut.spoiling_section(index);
        if shaping.is_none() && spoiling.is_none() {
            continue;
        }
        let known = last.take().filter(|(number, _)| *number == cut.number()).map(|(_, side)| side);
        let clear = known.unwrap_or_else(|| {
            element.supported.and_then(|segment| part.clear_side(&segment, cut.radius, tolerance))
        });
        let passage = |curve: &Curve| match &clear {
            Some(side) => CutterPassage::on_side(side.clone(), curve),
            None => part.passage(curve, cut.radius, tolerance),
        };
        let shaping = shaping.map(|curve| (curve, passage(&curve)));
        if let Some(curve) = spoiling {
            let known = shaping.as_ref().filter(|(shaping, _)| *shaping == curve);
            let entered = known.map_or_else(|| passage(&curve).entered, |(_, known)| known.entered.clone());
            judged.spoiling.extend((!entered.is_empty()).then_some(SpoilingSection { cut, curve, entered }));
        }
        judged.shaping.extend(shaping.map(|(curve, CutterPassage { side, entered })| {
            let is_entering = !entered.is_empty();
            ClassifiedCut { number, cut, curve, side, is_entering }
        }));
        last = Some((cut.number(), clear));
    }
    judged
}

impl ClassifiedCut<'_> {
    /// Whether no material lies between the cut and a ring near it: the cut is on the ring's waste side, or in the material itself.
    pub(super) fn faces(&self, ring: usize) -> bool {
        self.side == Side::Material || self.side.is_beside(ring)
    }
}

impl<'c> ClassifiedCuts<'c> {
    pub(super) fn get(&self, number: usize) -> Option<&ClassifiedCut<'c>> {
        let place = self.shaping.binary_search_by_key(&number, |judged| judged.number).ok()?;
        self.shaping.get(place)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &ClassifiedCut<'c>> {
        self.shaping.iter()
    }
}

/// Returns the cuts into a part, one for each path and element.
pub(super) fn gouges(
    part: &PreparedPart<'_>,
    index: &CutIndex<'_>,
    judged: &ClassifiedCuts<'_>,
) -> BTreeMap<(usize, u32), Gouge> {
    let mut found: BTreeMap<(usize, u32), Gouge> = BTreeMap::new();
    for SpoilingSection { cut, curve, entered } in &judged.spoiling {
        for stretch in entered {
            let (at, depth) = part.deepest(curve, *stretch, cut.radius);
            let gouge = found.entry(cut.number()).or_insert_with(|| {
                let segment = cut.element(index).supported;
                Gouge { at, depth, curve: segment.unwrap_or(cut.cut.way.curve), entered: Vec::new() }
            });
            if gouge.is_exceeded_by(at, depth) {
                (gouge.at, gouge.depth) = (at, depth);
            }
            gouge.entered.push(stretch_of_section(&gouge.curve, &curve.section(stretch.0, stretch.1)));
        }
    }
    found
}

/// A milling move of a program.
#[derive(Clone, Copy, Debug)]
pub struct MilledMove {
    /// The path of the tool tip.
    pub way: TipMove,
    /// The height in mm by which the path of the move is raised.
    pub raised: f64,
    /// For an element with support bars, B in the program: Z in mm. Infinite without bars.
    pub bottom: f64,
}

/// Returns the stretches of moves on which a cutter goes into a part, for pictures. `ways` are the moves of the program in which the part is
/// placed and raised. `thickness` is that of the part's plate.
pub fn gouging_moves<'w>(
    part: &Part,
    placement: &Placement,
    [raised, thickness]: [f64; 2],
    ways: impl IntoIterator<Item = &'w MilledMove>,
    [radius, tolerance]: [f64; 2],
) -> Vec<Curve> {
    let part = placed_part(part, placement);
    let part = PreparedPart::new(&part);
    let through = ways.into_iter().filter_map(|MilledMove { way, raised: height, bottom }| {
        let through = level_for_cuts(raised, thickness, *height) + THROUGH_HEIGHT;
        let is_outline = *bottom <= through;
        way.part_below(if is_outline { through.max(raised + thickness - MIN_CUT_DEPTH) } else { through })
    });
    let near = through.filter(|way| widened_box(way, radius).intersects(&part.extent()));
    let stretches = near.flat_map(|way| {
        let CutterPassage { entered, .. } = part.passage(&way, radius, tolerance);
        entered.into_iter().map(move |(from, to)| way.section(from, to))
    });
    stretches.collect()
}

/// Returns the level, in the program, from which cuts are measured to tell whether they spoil a part on a plate of this thickness. It is the level of
/// the cutting path, which is raised by `height`, but not below the level of the part, and not above its material. So a cut through the plate of a
/// path on shims that ends in this part spoils it, and is not taken for one of its grooves.
pub(super) fn level_for_cuts(raised: f64, thickness: f64, height: f64) -> f64 {
    let highest = (thickness - MIN_CUT_DEPTH).max(0.0);
    raised + (height - raised).clamp(0.0, highest)
}

impl Gouge {
    /// Returns the length in mm on which the cutter goes into the part, as seen from above.
    pub(super) fn length(&self) -> f64 {
        joined_length(&self.entered)
    }

    /// Whether another place is deeper. Of places with the same depth, the leftmost wins, so that the order of the cuts does not matter.
    fn is_exceeded_by(&self, at: Xy, depth: f64) -> bool {
        let is_left = || (at.x, at.y) < (self.at.x, self.at.y);
        depth > self.depth + JOIN_GAP || (depth >= self.depth - JOIN_GAP && is_left())
    }
}
