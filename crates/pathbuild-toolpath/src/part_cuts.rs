//! Collects the cuts of a single path, for the check of its part. (book: language/part)

use pathbuild_path::{
    Bars, Curve, Cut, CutElement, EmbeddedPlace, Helix, Item, Line, MAX_WEAK_BRIDGE, PartCut, PartSweep,
    Path, PathCuts, PathTool, PlacedSubpath, Placement, Role, SegmentKind, Shape, StandingBar, TipMove,
    WalkedPath, Xy, approx,
};

use crate::chain::last_pass;
use crate::mill::{BarPlan, Section, axis_circle, last_turns};

/// Returns the cuts of a path without those of embedded paths, in the coordinates of its drawing. `tool` is the configured tool of the path.
pub fn part_cuts(path: &Path, walked: &WalkedPath, tool: Option<&PathTool>, is_compatible: bool) -> PathCuts {
    let drawn = path.drawn.elements.len();
    let (elements, cuts) = (Vec::with_capacity(drawn), Vec::with_capacity(drawn));
    let mut collector = CutCollector { path, numbers: vec![None; drawn], elements, cuts };
    let mut embedded = Vec::new();
    for item in &walked.items {
        match item {
            Item::Chain(chain) => {
                for member in walked.members(chain) {
                    let cut = member.cut(path);
                    let supported = cut.bars.as_ref().map(|_| (member.curve(path), cut.bottom));
                    collector.add(
                        member.element(path),
                        supported,
                        None,
                        last_pass(path, member, is_compatible),
                    );
                }
            }
            Item::Hole { segment, hole } => {
                let (segment, z) = (&path.segments[*segment], path.holes[*hole as usize].bottom);
                let [start, end] = path.ends(segment);
                let curve = Curve::Line(Line { start, end });
                collector.add(segment.element, None, None, [Section { curve, from_z: z, to_z: z }]);
            }
            Item::Helix { segment, helix } => {
                let helix = &path.helices[*helix as usize];
                let curve = drawn_circle(path, helix);
                let supported = helix.bars.as_ref().map(|(bottom, _)| (curve, *bottom));
                let turns = last_turns(helix, path.thickness, path.tool, &curve);
                collector.add(path.segments[*segment].element, supported, Some(helix.centre), turns);
            }
            Item::Subpath(placed) => embedded.extend(embedded_place(path, placed, collector.cuts.len())),
            Item::Sweep(_) => {}
        }
    }
    let sweeps = collector.sweeps();
    // The lists are stored as long as the drawing's index, so free their spare capacity.
    collector.cuts.shrink_to_fit();
    collector.elements.shrink_to_fit();
    PathCuts {
        name: path.name.clone(),
        radius: path.tool / 2.0,
        thickness: path.thickness,
        is_slot: tool.is_some_and(|tool| tool.is_slot_cutter),
        corner_radius: tool.map_or(0.0, |tool| tool.corner_radius),
        elements: collector.elements,
        cuts: collector.cuts,
        sweeps,
        bars: bars(path),
        ends: (path.start, path.end),
        embedded,
    }
}

struct CutCollector<'p> {
    path: &'p Path,
    /// The index into `elements` of each drawn element; `None` for those that have not been added.
    numbers: Vec<Option<u32>>,
    elements: Vec<CutElement>,
    cuts: Vec<PartCut>,
}

impl CutCollector<'_> {
    /// Adds those sections of an element that lie in the material. `supported` is the whole segment if it has bars, with B; `circle` the centre of
    /// a helical circle.
    fn add(
        &mut self,
        drawn: u32,
        supported: Option<(Curve, f64)>,
        circle: Option<Xy>,
        sections: impl IntoIterator<Item = Section>,
    ) {
        let next = u32::try_from(self.elements.len()).unwrap_or(u32::MAX);
        let element = self.numbers[drawn as usize].unwrap_or(next);
        let mut lowest = f64::INFINITY;
        for Section { curve, from_z, to_z } in sections {
            let way = TipMove { curve, from_z, to_z };
            if approx::above(self.path.thickness, way.lowest()) {
                lowest = lowest.min(way.lowest());
                self.cuts.push(PartCut { way, element });
            }
        }
        if lowest.is_infinite() {
            return;
        }
        if element == next {
            let bottom = supported.map_or(f64::INFINITY, |(_, bottom)| bottom);
            let supported = supported.map(|(segment, _)| segment);
            self.elements.push(CutElement { supported, bottom, circle, ..cut_element(self.path, drawn) });
            self.numbers[drawn as usize] = Some(element);
        }
        let element = &mut self.elements[element as usize];
        element.lowest = element.lowest.min(lowest);
    }

    /// Returns the sweeps of the path, and adds their elements.
    fn sweeps(&mut self) -> Vec<PartSweep> {
        let mut sweeps = Vec::new();
        for segment in &self.path.segments {
            let shape = self.path.drawn.elements[segment.element as usize].shape;
            let (SegmentKind::Sweep { .. }, Shape::Curve(curve)) = (&segment.kind, shape) else { continue };
            let element = u32::try_from(self.elements.len()).unwrap_or(u32::MAX);
            self.elements.push(cut_element(self.path, segment.element));
            sweeps.push(PartSweep { curve, element });
        }
        sweeps
    }
}

fn embedded_place(path: &Path, placed: &PlacedSubpath, cuts_before: usize) -> Option<EmbeddedPlace> {
    let PlacedSubpath { segment, start, end } = *placed;
    let SegmentKind::Subpath(subpath) = &path.segments[segment].kind else { return None };
    Some(EmbeddedPlace { segment, ends: (start, end), height: subpath.height, cuts_before })
}

/// Creates an element without cuts.
fn cut_element(path: &Path, number: u32) -> CutElement {
    let element = &path.drawn.elements[number as usize];
    let origin = path.drawn.origin(element);
    CutElement { origin, lowest: f64::INFINITY, supported: None, bottom: f64::INFINITY, circle: None }
}

/// Returns the circle along which a helix moves the cutter's axis, in the coordinates of the drawing. It begins where it does in a program of this
/// path alone.
fn drawn_circle(path: &Path, helix: &Helix) -> Curve {
    axis_circle(helix, path.tool, &Placement::from_origin(Xy::origin()))
}

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
                let of_segment = SegmentBars { bars, bottom: cut.bottom, curve, circle: None };
                halves.extend([curve.start(), curve.end()]);
                of_segment.add_places(path.tool, &mut all);
            }
            SegmentKind::Helix(number) => {
                let helix = &path.helices[*number as usize];
                let Some((bottom, bars)) = &helix.bars else { continue };
                let curve = drawn_circle(path, helix);
                halves.extend([curve.start(), curve.end()]);
                let circle = Some(helix.centre);
                SegmentBars { bars, bottom: *bottom, curve, circle }.add_places(path.tool, &mut all);
            }
            SegmentKind::Hole(_) | SegmentKind::Sweep { .. } | SegmentKind::Subpath(_) => {}
        }
    }
    // A half bar at the end of a segment either continues in another segment, or the cut that follows mills half of O away from it.
    let goes_on = |at: Xy| halves.iter().filter(|half| approx::coincide(**half, at)).count() > 1;
    all.into_iter().map(|bar: BarPlace| bar.standing_bar(path.tool / 2.0, &goes_on)).collect()
}

struct SegmentBars<'b> {
    bars: &'b Bars,
    bottom: f64,
    curve: Curve,
    /// The centre of a helical circle.
    circle: Option<Xy>,
}

/// A bar, and its position along its segment in mm.
struct BarPlace {
    curve: Curve,
    from: f64,
    to: f64,
    /// Upper bound on the length in mm of the slopes beside the bar.
    slope: f64,
    top: f64,
    /// Length P of the bar in mm, as drawn.
    length: f64,
    circle: Option<Xy>,
}

impl SegmentBars<'_> {
    fn add_places(&self, tool: f64, all: &mut Vec<BarPlace>) {
        let length = self.curve.length();
        let place = |(from, to)| BarPlace {
            curve: self.curve,
            from,
            to,
            slope: self.bars.top - self.bottom,
            top: self.bars.top,
            length: self.bars.length,
            circle: self.circle,
        };
        match BarPlan::new(self.bars, self.bottom, tool, length) {
            Some(plan) => all.extend(plan.bars().map(place)),
            None => all.push(place((0.0, length))),
        }
    }
}

impl BarPlace {
    /// Returns the bar as the cuts beside it leave it.
    fn standing_bar(&self, radius: f64, goes_on: &dyn Fn(Xy) -> bool) -> StandingBar {
        let length = self.curve.length();
        let ends = [(self.from, self.curve.start()), (length - self.to, self.curve.end())];
        let is_at_end = ends.map(|(end, _)| approx::near(end, 0.0));
        let is_whole = [0, 1].map(|end| is_at_end[end] && goes_on(ends[end].1));
        let from = if is_whole[0] { 0.0 } else { self.from + radius };
        let to = if is_whole[1] { length } else { self.to - radius };
        let foot = self.curve.section((self.from - self.slope).max(0.0), (self.to + self.slope).min(length));
        let middle = if to - from > MAX_WEAK_BRIDGE {
            Some(self.curve.section(from, to))
        } else {
            // A segment that is a bar from end to end keeps its middle, however short it is. If the segment stands alone, it was drawn for the
            // sake of the bar, so cuts that leave nothing of the bar must be reported; between two other such segments, the bar stands anyway.
            (is_at_end == [true; 2] && is_whole[0] == is_whole[1]).then_some(self.curve)
        };
        StandingBar { middle, foot, top: self.top, required: self.length, circle: self.circle }
    }
}
