//! Milling chains, milled pass by pass. (book: program/gcode)

use pathbuild_path::approx::{above, at_least, coincide, near};
use pathbuild_path::{Chain, ChainSegment, Curve, Cut};

use crate::bars::BarPlan;
use crate::fold::{Fold, Parts, PlacedPath, Tip};
use crate::mill::Section;
use crate::nearest::OpenEdges;
use crate::program::ElementKind;

/// A segment of the chain in program coordinates, with the depths of its edges from top to bottom.
pub(crate) struct Strand<'a> {
    /// The comment (Q).
    comment: Option<&'a str>,
    pub(crate) curve: Curve,
    pub(crate) depths: Vec<f64>,
    /// Depth of the segment: h + B, or h + D for a mark.
    bottom: f64,
    /// For segments with bars, h + D and the positions of the bars. The plan is `None` if nothing is milled below D.
    bars: Option<(f64, Option<BarPlan>)>,
    feed: f64,
    /// Index into [`DrawnElements::elements`](pathbuild_path::DrawnElements::elements).
    element: u32,
}

/// An edge to be milled: a strand at one of its depths, in one of the two directions.
#[derive(Clone, Copy)]
pub(crate) struct Run {
    pub(crate) strand: usize,
    pub(crate) edge: usize,
    pub(crate) is_backwards: bool,
}

impl<P: Parts> Fold<'_, P> {
    pub(crate) fn chain(&mut self, place: &PlacedPath<'_>, chain: &Chain, members: &[ChainSegment]) {
        let first = chain.first_depth.map_or(place.surface - chain.infeed, |depth| place.raised + depth);
        let strands: Vec<Strand<'_>> =
            members.iter().map(|member| self.strand(place, member, first, chain.infeed)).collect();
        let bottom = strands.iter().map(|strand| strand.bottom).fold(f64::INFINITY, f64::min);
        self.along(strands[0].element);
        self.element(ElementKind::MillingChain, &members[0].origin(place.path), bottom, place, None);
        if chain.first_depth.is_some() {
            self.sweepless(place, &strands);
        } else {
            self.pass_by_pass(place, &strands);
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
        let bars = cut.bars.as_ref().filter(|_| cut.cut == Cut::Support).map(|bars| {
            let plan = BarPlan::new(bars, cut.bottom, place.path.tool, curve.length());
            (place.raised + bars.top, plan)
        });
        Strand {
            comment: cut.comment.as_deref(),
            curve: place.placement.place_curve(&curve),
            depths: depths(first, infeed, bottom),
            bottom,
            bars,
            feed: self.feed(cut.feed),
            element: member.element(place.path),
        }
    }

    /// Mills the edge with the nearest end first; each edge only after the one above it.
    fn pass_by_pass(&mut self, place: &PlacedPath<'_>, strands: &[Strand<'_>]) {
        let mut open = OpenEdges::new(strands);
        let mut tip = Tip { at: strands[0].curve.start(), z: strands[0].depths[0] };
        let mut last_pass = None;
        while let Some(run) = open.take_nearest(tip) {
            self.checkpoint();
            let strand = &strands[run.strand];
            self.along(strand.element);
            let z = strand.depths[run.edge];
            if last_pass != Some(run.edge) {
                self.pass(u32::try_from(run.edge + 1).unwrap_or(u32::MAX), z);
                last_pass = Some(run.edge);
            }
            let (from, to) = strand.ends(run.is_backwards);
            let entry = strand.entry(z, self.compatible);
            let feed = self.entry_feed(place, strand);
            self.travel(Tip { at: from, z: entry }, place.surface, place.sweep_height, feed);
            self.edge(place, strand, z, run.is_backwards);
            tip = Tip { at: to, z };
        }
        let end = strands[strands.len() - 1].curve.end();
        self.travel(Tip { at: end, z: place.sweep_height }, place.surface, place.sweep_height, place.feed);
    }

    /// Mills to and fro in the groove without leaving it.
    fn sweepless(&mut self, place: &PlacedPath<'_>, strands: &[Strand<'_>]) {
        let runs = strands.iter().map(|strand| strand.depths.len()).max().unwrap_or(0);
        let (start, end) = (strands[0].curve.start(), strands[strands.len() - 1].curve.end());
        let goes_back = runs > 1 && !coincide(start, end);
        for run in 0..runs {
            self.checkpoint();
            let mut way = Vec::with_capacity(strands.len());
            for (index, strand) in strands.iter().enumerate() {
                let edge = run.min(strand.depths.len() - 1);
                let is_backwards = !strand.starts_nearer(self.tip.at);
                way.push(Run { strand: index, edge, is_backwards });
                self.run_in_groove(place, strands, way[index]);
            }
            if goes_back && run + 1 < runs {
                for forth in way.into_iter().rev() {
                    self.run_in_groove(place, strands, Run { is_backwards: !forth.is_backwards, ..forth });
                }
            }
        }
    }

    fn run_in_groove(&mut self, place: &PlacedPath<'_>, strands: &[Strand<'_>], run: Run) {
        let strand = &strands[run.strand];
        self.along(strand.element);
        let z = strand.depths[run.edge];
        self.plunge(strand.entry(z, self.compatible), place.surface, self.entry_feed(place, strand));
        self.edge(place, strand, z, run.is_backwards);
    }

    /// The feed of the plunge to the start of an edge.
    fn entry_feed(&self, place: &PlacedPath<'_>, strand: &Strand<'_>) -> f64 {
        if self.compatible { place.feed } else { place.feed.min(strand.feed) }
    }

    /// Mills a segment at one depth, except for its bars.
    fn edge(&mut self, place: &PlacedPath<'_>, strand: &Strand<'_>, z: f64, is_backwards: bool) {
        self.question(strand.comment);
        for section in strand.sections(z, is_backwards) {
            self.mill(&section, place.surface, strand.feed);
        }
    }
}

impl Strand<'_> {
    /// Start and end of a run.
    fn ends(&self, is_backwards: bool) -> (pathbuild_path::Xy, pathbuild_path::Xy) {
        let (start, end) = (self.curve.start(), self.curve.end());
        if is_backwards { (end, start) } else { (start, end) }
    }

    /// The height at which the tool arrives at the start of a run at depth `z`.
    fn entry(&self, z: f64, compatible: bool) -> f64 {
        match &self.bars {
            Some((top, _)) if !compatible => z.max(*top),
            _ => z,
        }
    }

    fn starts_nearer(&self, at: pathbuild_path::Xy) -> bool {
        above((self.curve.end() - at).norm(), (self.curve.start() - at).norm())
    }

    fn sections(&self, z: f64, is_backwards: bool) -> Vec<Section> {
        let whole = |z: f64| vec![Section { curve: self.curve, from_z: z, to_z: z }];
        let mut sections = match &self.bars {
            Some((top, Some(plan))) if above(*top, z) => plan.sections(&self.curve, z.max(self.bottom), *top),
            Some((top, _)) => whole(z.max(*top)),
            None => whole(z.max(self.bottom)),
        };
        if is_backwards {
            sections.reverse();
            for section in &mut sections {
                *section = section.reversed();
            }
        }
        sections
    }
}

/// Depths from the first to the bottom, computed by repeated subtraction.
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
