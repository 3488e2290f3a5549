//! What is done along a path, in order, with consecutive cuts grouped into milling chains. (spec/50-path-building.md, "Chains")

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::words;

use crate::element::{Cut, Origin};
use crate::geometry::Xy;
use crate::path::{CutSegment, Helix, Hole, Segment, SegmentKind, Sweep};
use crate::walk::Step;

/// One thing that is done.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "glossary in spec/00-overview.md")]
pub enum Item {
    Chain(Chain),
    Hole { origin: Origin, hole: Hole },
    Helix { origin: Origin, helix: Helix },
    Sweep { origin: Origin, sweep: Sweep },
    Subpath(PlacedSubpath),
}

/// Milling, marking and support segments that follow each other, milled pass by pass together.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// I in mm.
    pub infeed: f64,
    /// W in mm: sweepless milling from this depth on.
    pub first_depth: Option<f64>,
    /// In walking order, each from where the tool comes from; at least one.
    pub segments: Vec<ChainSegment>,
}

/// A member of a chain.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainSegment {
    /// Where it is drawn.
    pub origin: Origin,
    /// What it is, from where the tool comes from.
    pub cut: CutSegment,
    /// Whether it is the way back over a dead end.
    pub is_return: bool,
}

/// A subpath segment in the direction in which it is traversed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSubpath {
    /// Index into [`Path::segments`](crate::Path::segments), where its parameters are.
    pub segment: usize,
    /// Where the embedded path's start comes to lie.
    pub start: Xy,
    /// Where the tool goes on from.
    pub end: Xy,
}

/// Groups the steps of a walk; chains without I, and letters without effect inside chains, are reported.
pub(crate) fn items(steps: &[Step]) -> (Vec<Item>, Vec<Diagnostic>) {
    let (mut items, mut diagnostics) = (Vec::new(), Vec::new());
    let mut chain: Vec<ChainSegment> = Vec::new();
    for step in steps {
        let Some(Segment { origin, kind, .. }) = &step.traversed else {
            items.extend(finish(&mut chain, &mut diagnostics));
            continue;
        };
        if let SegmentKind::Cut(cut) = kind {
            chain.push(ChainSegment { origin: origin.clone(), cut: cut.clone(), is_return: step.is_return });
            continue;
        }
        items.extend(finish(&mut chain, &mut diagnostics));
        items.extend(single(step.segment, origin, kind));
    }
    items.extend(finish(&mut chain, &mut diagnostics));
    (items, diagnostics)
}

fn single(segment: usize, origin: &Origin, kind: &SegmentKind) -> Option<Item> {
    let origin = origin.clone();
    Some(match kind {
        SegmentKind::Cut(_) => return None,
        SegmentKind::Hole(hole) => Item::Hole { origin, hole: hole.clone() },
        SegmentKind::Helix(helix) => Item::Helix { origin, helix: helix.clone() },
        SegmentKind::Sweep(sweep) => Item::Sweep { origin, sweep: *sweep },
        SegmentKind::Subpath(subpath) => {
            Item::Subpath(PlacedSubpath { segment, start: subpath.start, end: subpath.end })
        }
    })
}

/// The chain of the segments so far, if there are any.
fn finish(segments: &mut Vec<ChainSegment>, diagnostics: &mut Vec<Diagnostic>) -> Option<Item> {
    let segments = std::mem::take(segments);
    let first = segments.first()?;
    for member in segments[1..].iter().filter(|member| !member.is_return) {
        diagnostics.extend(member.letters_without_effect());
    }
    let parameters = first.cut.chain;
    let Some(infeed) = parameters.infeed else {
        diagnostics.push(first.without_infeed());
        return None;
    };
    Some(Item::Chain(Chain { infeed, first_depth: parameters.first_depth, segments }))
}

impl ChainSegment {
    fn without_infeed(&self) -> Diagnostic {
        let element = match self.cut.cut {
            Cut::Mill => &words::MILLING_SEGMENT,
            Cut::Mark => &words::MARKING_SEGMENT,
            Cut::Support => &words::SUPPORT_SEGMENT,
        };
        self.origin.at(Diagnostic::new(&messages::MISSING).with("letter", 'I').with("element", element))
    }

    fn letters_without_effect(&self) -> impl Iterator<Item = Diagnostic> {
        self.cut.own_chain_letters.iter().map(|(letter, fault)| {
            let problem = Diagnostic::new(&messages::WITHOUT_EFFECT_IN_CHAIN).with("letter", *letter);
            self.origin.at(problem.with_text(fault.clone()))
        })
    }
}
