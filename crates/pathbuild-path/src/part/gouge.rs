//! Cuts into a part. (book: language/part)

use std::collections::BTreeMap;

use rstar::Envelope as _;

use super::cuts::{CutIndex, IndexedCut, THROUGH_HEIGHT};
use super::intervals::{JOIN_GAP, Stretch};
use super::prepared::{CutterPassage, PreparedPart, Side};
use super::{Part, placed_part};
use crate::geometry::{Curve, Placement, Xy};
use crate::keep_out::{TipMove, widened_box};

/// A cut that may go into the part, or that may shape its outline.
pub(super) struct ClassifiedCut<'c> {
    /// Number of the cut in the index.
    number: usize,
    pub(super) cut: &'c IndexedCut<'c>,
    /// The section that goes through the plate, or the whole curve if the cut does not go through it.
    pub(super) curve: Curve,
    /// The side of the part on which the middle of the curve lies.
    pub(super) side: Side,
    /// The stretches of the curve on which the cutter goes into the part.
    pub(super) entered: Vec<Stretch>,
}

/// Classified cuts in ascending order of their numbers.
pub(super) struct ClassifiedCuts<'c>(Vec<ClassifiedCut<'c>>);

/// The damage that the cuts of one element do to a part.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Gouge {
    /// The centre of the cutter at the place where it goes deepest into the part.
    pub(super) at: Xy,
    /// The depth at that place, in mm.
    pub(super) depth: f64,
    /// The length in mm, along the path of the cutter, on which it goes into the part.
    pub(super) length: f64,
}

/// Determines the side of the part on which each cut lies, and where the cut goes into the part. `numbers` are the numbers of the cuts to examine, in
/// ascending order. A cut that does not go through the plate is included only at the lowest depth of its element, where it may shape the outline.
pub(super) fn classify_cuts<'c>(
    part: &PreparedPart<'_>,
    index: &'c CutIndex<'c>,
    numbers: impl Iterator<Item = usize>,
    tolerance: f64,
) -> ClassifiedCuts<'c> {
    let mut judged = Vec::new();
    // Most segments with bars touch no ring. All cuts of such a segment are on one side, which is computed only once.
    let mut last: Option<((usize, u32), Option<Side>)> = None;
    for number in numbers {
        let cut = &index.cuts[number];
        let element = cut.element(index);
        let shapes = || cut.cut.way.lowest() <= element.lowest + JOIN_GAP;
        let Some(curve) = cut.through.or_else(|| shapes().then_some(cut.cut.way.curve)) else { continue };
        let known = last.take().filter(|(number, _)| *number == cut.number()).map(|(_, side)| side);
        let clear = known.unwrap_or_else(|| {
            element.supported.and_then(|segment| part.clear_side(&segment, cut.radius, tolerance))
        });
        let CutterPassage { side, entered } = match &clear {
            Some(side) => CutterPassage::on_side(side.clone(), &curve),
            None => part.passage(&curve, cut.radius, tolerance),
        };
        last = Some((cut.number(), clear));
        judged.push(ClassifiedCut { number, cut, curve, side, entered });
    }
    ClassifiedCuts(judged)
}

impl ClassifiedCut<'_> {
    /// Whether no material lies between the cut and a ring near it: the cut is on the ring's waste side, or in the material itself.
    pub(super) fn faces(&self, ring: usize) -> bool {
        self.side == Side::Material || self.side.is_beside(ring)
    }
}

impl<'c> ClassifiedCuts<'c> {
    pub(super) fn get(&self, number: usize) -> Option<&ClassifiedCut<'c>> {
        let place = self.0.binary_search_by_key(&number, |judged| judged.number).ok()?;
        self.0.get(place)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &ClassifiedCut<'c>> {
        self.0.iter()
    }
}

/// Returns the cuts into a part, one for each path and element.
pub(super) fn gouges<'j>(
    part: &PreparedPart<'_>,
    judged: impl Iterator<Item = &'j ClassifiedCut<'j>>,
) -> BTreeMap<(usize, u32), Gouge> {
    let mut found: BTreeMap<(usize, u32), Gouge> = BTreeMap::new();
    for cut in judged.filter(|judged| judged.cut.through.is_some()) {
        for stretch in &cut.entered {
            let (at, depth) = part.deepest(&cut.curve, *stretch, cut.cut.radius);
            let new = Gouge { at, depth, length: 0.0 };
            let gouge = found.entry((cut.cut.path, cut.cut.cut.element)).or_insert(new);
            if gouge.is_exceeded_by(at, depth) {
                (gouge.at, gouge.depth) = (at, depth);
            }
            gouge.length += stretch.1 - stretch.0;
        }
    }
    found
}

/// Returns the stretches of moves on which a cutter goes into a part, for pictures. `ways` are the moves of the program in which the part is
/// placed and raised, each with the height by which its path is raised. `thickness` is that of the part's plate.
pub fn gouging_moves<'w>(
    part: &Part,
    placement: &Placement,
    [raised, thickness]: [f64; 2],
    ways: impl IntoIterator<Item = &'w (TipMove, f64)>,
    [radius, tolerance]: [f64; 2],
) -> Vec<Curve> {
    let part = placed_part(part, placement);
    let part = PreparedPart::new(&part);
    let through = ways.into_iter().filter_map(|way| {
        let (way, height) = way;
        way.part_below(level_for_cuts(raised, thickness, *height) + THROUGH_HEIGHT)
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

/// Depth in mm below a plate's upper face from which a cut is considered a cut into the plate.
pub(super) const MIN_CUT_DEPTH: f64 = 0.01;

impl Gouge {
    /// Whether another place is deeper. Of places with the same depth, the leftmost wins, so that the order of the cuts does not matter.
    fn is_exceeded_by(&self, at: Xy, depth: f64) -> bool {
        let is_left = || (at.x, at.y) < (self.at.x, self.at.y);
        depth > self.depth + JOIN_GAP || (depth >= self.depth - JOIN_GAP && is_left())
    }
}
