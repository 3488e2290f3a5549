//! Generates the moves of milling chains. An edge is a segment at one of its depths. The next edge to be milled is always the nearest one that has
//! nothing left to mill above it; a chain with W is instead milled back and forth without lifting. (book: program/gcode)

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Bound;

use pathbuild_path::approx::{above, at_least, coincide, is_negligible, near};
use pathbuild_path::{Chain, ChainSegment, Curve, Cut, CutParameters, Line, Path, Xy};
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::fold::{Fold, FoldPaths, PlacedPath, distance};
use crate::mill::{BarPlan, Section};
use crate::program::{Comment, ElementKind, Tip};

/// A segment of the chain in program coordinates, with the depths of its edges from top to bottom.
pub(crate) struct Strand<'a> {
    /// The drawing's comment for the operator (Q).
    comment: Option<&'a str>,
    pub(crate) curve: Curve,
    depths: Vec<f64>,
    /// Depth of the segment in mm: h + B, or h + D for a marking segment, where h is the height by which the path is raised.
    bottom: f64,
    /// For segments with support bars, the height h + D of their top and the positions of the bars.
    bars: Option<PlannedBars>,
    feed: f64,
    /// Index into [`DrawnElements::elements`](pathbuild_path::DrawnElements::elements).
    element: u32,
}

/// An edge to be milled: a segment at one of its depths, in one of the two directions.
#[derive(Clone, Copy)]
pub(crate) struct EdgePass {
    strand: usize,
    pub(crate) edge: usize,
    is_backwards: bool,
}

impl<P: FoldPaths> Fold<'_, P> {
    pub(crate) fn mill_chain(&mut self, place: &PlacedPath<'_>, chain: &Chain, members: &[ChainSegment]) {
        let first = chain.first_depth.map_or(place.surface - chain.infeed, |depth| place.raised + depth);
        let strands: Vec<Strand<'_>> =
            members.iter().map(|member| self.strand(place, member, first, chain.infeed)).collect();
        let bottom = strands.iter().map(|strand| strand.bottom).fold(f64::INFINITY, f64::min);
        self.begin_element(strands[0].element);
        self.add_element_comment(
            ElementKind::MillingChain,
            &members[0].origin(place.path),
            bottom,
            place,
            None,
        );
        if chain.first_depth.is_some() {
            self.mill_in_groove(place, &strands);
        } else {
            self.mill_nearest_first(place, &strands);
        }
    }

    fn strand<'p>(
        &self,
        place: &PlacedPath<'p>,
        member: &ChainSegment,
        first: f64,
        infeed: f64,
    ) -> Strand<'p> {
        let (cut, curve) = (member.cut(place.path), member.curve(place.path));
        let bottom = place.raised + cut.bottom;
        let bars = planned_bars(cut, place.path.tool, &curve);
        let mut placed = place.placement.place_curve(&curve);
        // The ends of an arc without length are equally near to the tool, so all its passes run in the same direction. If the ends were printed
        // 0.001 mm apart, each pass would begin where the previous one ended, and the arcs would drift away from their place. A line cannot drift.
        if is_negligible(placed.length()) {
            placed = Curve::Line(Line { start: placed.start(), end: placed.end() });
        }
        Strand {
            comment: cut.comment.as_deref(),
            curve: placed,
            depths: depths(first, infeed, bottom),
            bottom,
            bars: bars.map(|(top, plan)| (place.raised + top, plan)),
            feed: self.feed_or_default(cut.feed),
            element: member.element(place.path),
        }
    }

    /// Mills the edge with the end nearest to the tool first, but each edge only after the edge above it.
    fn mill_nearest_first(&mut self, place: &PlacedPath<'_>, strands: &[Strand<'_>]) {
        let mut open = OpenEdges::new(strands);
        let mut tip = Tip { at: strands[0].curve.start(), z: strands[0].depths[0] };
        let mut last_pass = None;
        while let Some(run) = open.take_nearest(tip) {
            self.checkpoint();
            let strand = &strands[run.strand];
            self.begin_element(strand.element);
            let z = strand.depths[run.edge];
            if last_pass != Some(run.edge) {
                let number = u32::try_from(run.edge + 1).unwrap_or(u32::MAX);
                self.comment(Comment::Pass { number, z });
                last_pass = Some(run.edge);
            }
            let (from, to) = strand.ends(run.is_backwards);
            let entry = strand.entry(z, self.compatible);
            let feed = self.entry_feed(place, strand);
            self.travel(Tip { at: from, z: entry }, place.surface, place.sweep_height, feed);
            self.mill_edge(place, strand, z, run.is_backwards);
            tip = Tip { at: to, z };
        }
        let end = strands[strands.len() - 1].curve.end();
        self.travel(Tip { at: end, z: place.sweep_height }, place.surface, place.sweep_height, place.feed);
    }

    /// Mills a chain with W, for cutters that cannot leave their groove: every pass follows the whole chain and, if the chain is open, all passes but
    /// the last also lead back. The tool is not lifted.
    fn mill_in_groove(&mut self, place: &PlacedPath<'_>, strands: &[Strand<'_>]) {
        let runs = strands.iter().map(|strand| strand.depths.len()).max().unwrap_or(0);
        let (start, end) = (strands[0].curve.start(), strands[strands.len() - 1].curve.end());
        let goes_back = runs > 1 && !coincide(start, end);
        for run in 0..runs {
            self.checkpoint();
            let mut way = Vec::with_capacity(strands.len());
            for (index, strand) in strands.iter().enumerate() {
                let edge = run.min(strand.depths.len() - 1);
                let is_backwards = !strand.starts_nearer(self.tip.at);
                way.push(EdgePass { strand: index, edge, is_backwards });
                self.mill_pass_in_groove(place, strands, way[index]);
            }
            if goes_back && run + 1 < runs {
                for forth in way.into_iter().rev() {
                    self.mill_pass_in_groove(
                        place,
                        strands,
                        EdgePass { is_backwards: !forth.is_backwards, ..forth },
                    );
                }
            }
        }
    }

    fn mill_pass_in_groove(&mut self, place: &PlacedPath<'_>, strands: &[Strand<'_>], run: EdgePass) {
        let strand = &strands[run.strand];
        self.begin_element(strand.element);
        let z = strand.depths[run.edge];
        self.plunge(strand.entry(z, self.compatible), place.surface, self.entry_feed(place, strand));
        self.mill_edge(place, strand, z, run.is_backwards);
    }

    /// Returns the feed of the plunge to the start of an edge.
    fn entry_feed(&self, place: &PlacedPath<'_>, strand: &Strand<'_>) -> f64 {
        if self.compatible { place.feed } else { place.feed.min(strand.feed) }
    }

    /// Mills a segment at one depth, except for its bars.
    fn mill_edge(&mut self, place: &PlacedPath<'_>, strand: &Strand<'_>, z: f64, is_backwards: bool) {
        self.add_question_comment(strand.comment);
        for section in strand.sections(z, is_backwards) {
            self.mill_section(&section, place.surface, strand.feed);
        }
    }
}

impl Strand<'_> {
    /// Returns the start and the end of the segment in this direction.
    fn ends(&self, is_backwards: bool) -> (Xy, Xy) {
        let (start, end) = (self.curve.start(), self.curve.end());
        if is_backwards { (end, start) } else { (start, end) }
    }

    /// Returns the height at which the tool arrives at the start of the segment for a pass at depth `z`.
    fn entry(&self, z: f64, compatible: bool) -> f64 {
        match &self.bars {
            Some((top, _)) if !compatible => z.max(*top),
            _ => z,
        }
    }

    fn starts_nearer(&self, at: Xy) -> bool {
        above((self.curve.end() - at).norm(), (self.curve.start() - at).norm())
    }

    fn sections(&self, z: f64, is_backwards: bool) -> Vec<Section> {
        let mut sections = sections(&self.curve, z.max(self.bottom), self.bars.as_ref());
        if is_backwards {
            sections.reverse();
            for section in &mut sections {
                *section = section.reversed();
            }
        }
        sections
    }
}

/// The height of the bars' top in mm, and the plan of a segment's bars. The plan is `None` if nothing is milled below the top.
type PlannedBars = (f64, Option<BarPlan>);

fn planned_bars(cut: &CutParameters, tool: f64, curve: &Curve) -> Option<PlannedBars> {
    let bars = cut.bars.as_ref().filter(|_| cut.cut == Cut::Support)?;
    Some((bars.top, BarPlan::new(bars, cut.bottom, tool, curve.length())))
}

/// Returns the sections of a curve that are milled at depth `z`, which leave its bars standing.
fn sections(curve: &Curve, z: f64, bars: Option<&PlannedBars>) -> Vec<Section> {
    let whole = |z: f64| vec![Section { curve: *curve, from_z: z, to_z: z }];
    match bars {
        Some((top, Some(plan))) if above(*top, z) => plan.sections(curve, z, *top),
        Some((top, _)) => whole(z.max(*top)),
        None => whole(z),
    }
}

/// Returns the sections of a segment as its last pass mills them, in the coordinates of its drawing. In compatible mode the tool plunges to the
/// bottom even at a bar, as in [`Strand::entry`].
pub(crate) fn last_pass(path: &Path, member: &ChainSegment, is_compatible: bool) -> Vec<Section> {
    let (cut, curve) = (member.cut(path), member.curve(path));
    let bars = planned_bars(cut, path.tool, &curve);
    let mut sections = sections(&curve, cut.bottom, bars.as_ref());
    if bars.is_some() && is_compatible {
        let here = Curve::Line(Line { start: curve.start(), end: curve.start() });
        sections.push(Section { curve: here, from_z: cut.bottom, to_z: cut.bottom });
    }
    sections
}

/// Returns the depths from the first to the bottom, computed by repeated subtraction.
fn depths(first: f64, infeed: f64, bottom: f64) -> Vec<f64> {
    let mut depths = Vec::new();
    let mut z = first;
    while at_least(z, bottom) {
        depths.push(z);
        z -= infeed;
    }
    if depths.last().is_none_or(|last| !near(*last, bottom)) {
        depths.push(bottom);
    }
    depths
}

// Finds the edge nearest to the tool tip. (book: program/gcode)
//
// Distances are compared approximately, which is not transitive, so the result is defined by a single scan in segment order. Only edges
// near the tip can affect that scan, and only the first of the edges that begin at the same point and depth. An R-tree of points finds
// them, which avoids quadratic time for chains or stars of many thousand segments.

/// The edges of a chain that have not been milled yet.
pub(crate) struct OpenEdges<'a> {
    strands: &'a [Strand<'a>],
    /// Number of milled edges of each segment, counted from the top.
    done: Vec<usize>,
    /// Both ends of each segment, as indices into `points`.
    ends: Vec<[usize; 2]>,
    /// End points of one or more segments.
    points: Vec<Xy>,
    tree: RTree<GeomWithData<[f64; 2], usize>>,
    /// The next edges of all segments, at both ends. A set for each point would take most of the memory of a long chain.
    next: BTreeSet<NextEdge>,
}

/// The next edge of a segment at one of its ends: the point, the depth and the segment.
type NextEdge = (usize, Coordinate, usize);

/// A coordinate in mm that can be used as a key.
#[derive(Clone, Copy)]
struct Coordinate(f64);

impl<'a> OpenEdges<'a> {
    pub(crate) fn new(strands: &'a [Strand<'a>]) -> Self {
        let (mut points, mut known) = (Vec::new(), BTreeMap::new());
        let mut point = |at: Xy| {
            *known.entry((Coordinate(at.x), Coordinate(at.y))).or_insert_with(|| {
                points.push(at);
                points.len() - 1
            })
        };
        let ends = strands.iter().map(|strand| [strand.curve.start(), strand.curve.end()].map(&mut point));
        let ends: Vec<[usize; 2]> = ends.collect();
        let entry = |(number, at): (usize, &Xy)| GeomWithData::new([at.x, at.y], number);
        let tree = RTree::bulk_load(points.iter().enumerate().map(entry).collect());
        let mut open =
            Self { strands, done: vec![0; strands.len()], ends, points, tree, next: BTreeSet::new() };
        (0..strands.len()).for_each(|strand| open.insert_edge(strand));
        open
    }

    /// Takes the next edge: among the edges with nothing left to mill above them, the first one with the end nearest to the tip.
    pub(crate) fn take_nearest(&mut self, tip: Tip) -> Option<EdgePass> {
        let mut best: Option<(f64, EdgePass)> = None;
        for index in self.candidate_edges(tip) {
            let (least, run) = self.next_pass(index, tip);
            if best.is_none_or(|(nearest, _)| above(nearest, least)) {
                best = Some((least, run));
            }
        }
        let (_, run) = best?;
        self.remove_edge(run.strand);
        self.done[run.strand] += 1;
        if self.is_open(run.strand) {
            self.insert_edge(run.strand);
        } else {
            self.forget_points(run.strand);
        }
        Some(run)
    }

    /// Returns the distance to the nearer end of a segment's next edge, and that edge.
    fn next_pass(&self, index: usize, tip: Tip) -> (f64, EdgePass) {
        let (strand, edge) = (&self.strands[index], self.done[index]);
        let to = |at: Xy| distance(tip, Tip { at, z: strand.depths[edge] });
        let (to_start, to_end) = (to(strand.curve.start()), to(strand.curve.end()));
        let is_backwards = !above(to_end, to_start);
        let least = if is_backwards { to_end } else { to_start };
        (least, EdgePass { strand: index, edge, is_backwards })
    }

    /// Returns the segments that can affect the scan, in segment order: the nearest one, and all that approximate comparison cannot tell from it,
    /// directly or through others in between. Segments beyond the first distinguishable gap between distances never win, and neither do those with a
    /// next edge that begins at the same point and depth as that of an earlier segment.
    fn candidate_edges(&self, tip: Tip) -> Vec<usize> {
        let place = [tip.at.x, tip.at.y];
        let mut found: Vec<(f64, usize)> = Vec::new();
        let mut reach = f64::INFINITY;
        if let Some(nearest) = self.tree.nearest_neighbor(place) {
            self.add_nearest_at_point(nearest.data, tip, &mut found, &mut reach);
        }
        // The distance in space is at least the distance in the plane, so this search misses nothing. Requesting points one by one would sort all
        // those at equal distance.
        for point in self.tree.locate_within_distance(place, reach * reach) {
            self.add_nearest_at_point(point.data, tip, &mut found, &mut reach);
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let gap = found.windows(2).position(|pair| above(pair[1].0, pair[0].0));
        let last = gap.unwrap_or(found.len().saturating_sub(1));
        let mut contenders: Vec<usize> = match found.get(last) {
            Some((farthest, _)) if above(reach, *farthest) => {
                found[..=last].iter().map(|(_, strand)| *strand).collect()
            }
            // There is no distinguishable gap within reach of the search: scan all edges.
            _ => (0..self.strands.len()).filter(|index| self.is_open(*index)).collect(),
        };
        contenders.sort_unstable();
        contenders.dedup();
        contenders
    }

    /// Finds the first segment of each depth at a point within the reach, and reduces the reach accordingly.
    fn add_nearest_at_point(&self, point: usize, tip: Tip, found: &mut Vec<(f64, usize)>, reach: &mut f64) {
        let mut is_near = |(_, depth, first): NextEdge| {
            let is_near = distance(tip, Tip { at: self.points[point], z: depth.0 }) <= *reach;
            if is_near {
                let (least, _) = self.next_pass(first, tip);
                found.push((least, first));
                *reach = reach.min(least * (1.0 + SEARCH_MARGIN) + SEARCH_MARGIN);
            }
            is_near
        };
        let (lowest, here) = (Coordinate(f64::NEG_INFINITY), Coordinate(tip.z));
        let first_at = |depth| self.next.range((point, depth, 0)..).next().copied();
        let mut above = (point, here, usize::MAX);
        let mut below = above;
        while let Some((_, depth, _)) = self.next.range((point, lowest, 0)..below).next_back().copied()
            && first_at(depth).is_some_and(&mut is_near)
        {
            below = (point, depth, 0);
        }
        while let Some(edge) = self.next.range((Bound::Excluded(above), Bound::Unbounded)).next().copied()
            && edge.0 == point
            && is_near(edge)
        {
            above = (point, edge.1, usize::MAX);
        }
    }

    fn is_open(&self, strand: usize) -> bool {
        self.done[strand] < self.strands[strand].depths.len()
    }

    /// Inserts the next edge of a segment at both its ends.
    fn insert_edge(&mut self, strand: usize) {
        let depth = Coordinate(self.strands[strand].depths[self.done[strand]]);
        self.next.extend(self.ends[strand].map(|end| (end, depth, strand)));
    }

    fn remove_edge(&mut self, strand: usize) {
        let depth = Coordinate(self.strands[strand].depths[self.done[strand]]);
        for end in self.ends[strand] {
            self.next.remove(&(end, depth, strand));
        }
    }

    /// Removes the ends of a completed segment from the tree, if no other segment has an edge left there.
    fn forget_points(&mut self, strand: usize) {
        for end in self.ends[strand] {
            let at = self.points[end];
            if self
                .next
                .range((end, Coordinate(f64::NEG_INFINITY), 0)..)
                .next()
                .is_none_or(|next| next.0 != end)
            {
                self.tree.remove(&GeomWithData::new([at.x, at.y], end));
            }
        }
    }
}

/// Distance beyond the nearest edge to search, as a fraction of that edge's distance and in mm: many times the tolerance of comparisons.
const SEARCH_MARGIN: f64 = 1e-4;

impl PartialEq for Coordinate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Coordinate {}

impl PartialOrd for Coordinate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Coordinate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}
