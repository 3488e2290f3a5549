//! The cuts of a single path, for the check of its part. (book: language/part)

use std::collections::BTreeMap;

use pathbuild_motion::{Move, Pace};
use pathbuild_path::{
    Arc as CurveArc, Bars, Curve, Cut, CutElement, EmbeddedPlace, Item, Line, PartCut, Path, PathCuts,
    PathOptions, PlacedSubpath, Role, SegmentKind, Shape, StandingBar, WalkedPath, Way, Xy, approx,
};

use crate::fold::{Parts, fold_in_one_pass};
use crate::mill::BarPlan;
use crate::moves::way;

/// The cuts of a path without the paths that it embeds, in the coordinates of its drawing. `is_slot`: whether a slot cutter mills it.
pub fn part_cuts(path: &Path, walked: &WalkedPath, is_slot: bool, is_compatible: bool) -> PathCuts {
    let options = PathOptions {
        feed: Some(1.0),
        sweep_height: Some(path.embedded_sweep_height()),
        compatible: is_compatible,
        ..PathOptions::default()
    };
    let (program, trace) = fold_in_one_pass(&LonePath { path, walked }, (), options);
    let mut found = PathCuts {
        name: path.name.clone(),
        radius: path.tool / 2.0,
        is_slot,
        elements: Vec::new(),
        cuts: Vec::with_capacity(program.steps.len()),
        bars: bars(path),
        ends: (path.start, path.end),
        embedded: walked.items.iter().filter_map(|item| embedded(path, item)).collect(),
    };
    let mut numbers = BTreeMap::new();
    for (number, movement) in program.moves() {
        let Some(drawn) = trace.steps.get(number as usize - 1).and_then(|step| step.element) else {
            continue;
        };
        let way = cutting_way(&movement).filter(|way| approx::above(path.thickness, way.lowest()));
        let Some(way) = way else { continue };
        let element = *numbers.entry(drawn).or_insert_with(|| {
            found.elements.push(cut_element(path, drawn));
            found.elements.len() - 1
        });
        let lowest = &mut found.elements[element].lowest;
        *lowest = lowest.min(way.lowest());
        let element = u32::try_from(element).unwrap_or(u32::MAX);
        found.cuts.push(PartCut { way: Way { curve: shifted(&way.curve, path.start), ..way }, element });
    }
    // The cuts are kept as long as the drawing's index, so free the spare capacity.
    found.cuts.shrink_to_fit();
    found
}

fn embedded(path: &Path, item: &Item) -> Option<EmbeddedPlace> {
    let Item::Subpath(PlacedSubpath { segment, start, end }) = item else { return None };
    let SegmentKind::Subpath(subpath) = &path.segments[*segment].kind else { return None };
    Some(EmbeddedPlace { segment: *segment, ends: (*start, *end), height: subpath.height })
}

/// An element that has not cut anything yet.
fn cut_element(path: &Path, number: u32) -> CutElement {
    let element = &path.drawn.elements[number as usize];
    CutElement {
        origin: path.drawn.origin(element),
        is_mark: element.role == Role::Cut(Cut::Mark),
        lowest: f64::INFINITY,
    }
}

/// The [`Way`] of a move; `None` for a rapid move, which does not cut.
pub fn cutting_way(movement: &Move) -> Option<Way> {
    if movement.pace == Pace::Rapid { None } else { way(movement) }
}

/// A path that embeds nothing.
struct LonePath<'p> {
    path: &'p Path,
    walked: &'p WalkedPath,
}

impl Parts for LonePath<'_> {
    type Id = ();

    fn path(&self, (): ()) -> &Path {
        self.path
    }

    fn walked(&self, (): ()) -> &WalkedPath {
        self.walked
    }

    fn embedded(&self, (): (), _: usize) -> Option<()> {
        None
    }
}

/// Undoes the placement of an emitted path, which begins at (0, 0).
fn shifted(curve: &Curve, by: Xy) -> Curve {
    let by = by.coords;
    match curve {
        Curve::Line(line) => Curve::Line(Line { start: line.start + by, end: line.end + by }),
        Curve::Arc(arc) => {
            Curve::Arc(CurveArc { centre: arc.centre + by, start: arc.start + by, end: arc.end + by, ..*arc })
        }
    }
}

/// The support bars of a path.
fn bars(path: &Path) -> Vec<StandingBar> {
    let mut all = Vec::new();
    let mut halves = Vec::new();
    for segment in &path.segments {
        match &segment.kind {
            SegmentKind::Cut(cut) => {
                let cut = &path.cuts[*cut as usize];
                let element = &path.drawn.elements[segment.element as usize];
                let (Some(bars), Role::Cut(Cut::Support), Shape::Curve(curve)) =
                    (&cut.bars, element.role, element.shape)
                else {
                    continue;
                };
                let of_segment = BarsAlong { bars, bottom: cut.bottom, curve };
                halves.extend([curve.start(), curve.end()]);
                all.extend(of_segment.places(path.tool));
            }
            SegmentKind::Helix(number) => {
                let helix = &path.helices[*number as usize];
                let Some((bottom, bars)) = &helix.bars else { continue };
                let radius = helix.axis_radius(path.tool);
                let low = Xy::new(helix.centre.x, helix.centre.y - radius);
                let centre = helix.centre;
                let curve = Curve::Arc(CurveArc {
                    centre,
                    radius,
                    start: low,
                    end: low,
                    clockwise: true,
                    degrees: 360.0,
                });
                halves.extend([low, low]);
                all.extend(BarsAlong { bars, bottom: *bottom, curve }.places(path.tool));
            }
            SegmentKind::Hole(_) | SegmentKind::Sweep { .. } | SegmentKind::Subpath(_) => {}
        }
    }
    // A half bar at the end of a segment either continues in another segment, or the cut that follows mills half of O away from it.
    let goes_on = |at: Xy| halves.iter().filter(|half| approx::coincide(**half, at)).count() > 1;
    all.into_iter().map(|bar: BarPlace| bar.standing(path.tool / 2.0, &goes_on)).collect()
}

/// The bars of a segment.
struct BarsAlong<'b> {
    bars: &'b Bars,
    bottom: f64,
    curve: Curve,
}

/// A bar, and its position along its segment in mm.
struct BarPlace {
    curve: Curve,
    from: f64,
    to: f64,
    /// Upper bound on the length in mm of the slopes beside it.
    slope: f64,
    top: f64,
}

impl BarsAlong<'_> {
    fn places(&self, tool: f64) -> Vec<BarPlace> {
        let length = self.curve.length();
        let plan = BarPlan::new(self.bars, self.bottom, tool, length);
        let spans = plan.map_or_else(|| vec![(0.0, length)], |plan| plan.bars().collect());
        let place = |(from, to)| BarPlace {
            curve: self.curve,
            from,
            to,
            slope: self.bars.top - self.bottom,
            top: self.bars.top,
        };
        spans.into_iter().map(place).collect()
    }
}

impl BarPlace {
    /// The bar as the cuts beside it leave it.
    fn standing(&self, radius: f64, goes_on: &dyn Fn(Xy) -> bool) -> StandingBar {
        let length = self.curve.length();
        let is_whole = |end: f64, at: Xy| approx::near(end, 0.0) && goes_on(at);
        let from = if is_whole(self.from, self.curve.start()) { 0.0 } else { self.from + radius };
        let to = if is_whole(length - self.to, self.curve.end()) { length } else { self.to - radius };
        let foot = self.curve.section((self.from - self.slope).max(0.0), (self.to + self.slope).min(length));
        let middle = (to - from > SHORTEST).then(|| self.curve.section(from, to));
        StandingBar { middle, foot, top: self.top }
    }
}

/// Length in mm up to which what is left of a bar does not count.
const SHORTEST: f64 = 0.01;
