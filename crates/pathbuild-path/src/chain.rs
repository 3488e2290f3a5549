//! What is done along a path, in order, with consecutive cuts grouped into milling chains. (book: language/chains-and-passes)

use std::ops::Range;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;

use crate::approx::above;
use crate::element::Origin;
use crate::geometry::{Curve, Xy};
use crate::letter::Letter;
use crate::path::{CutParameters, Path, SegmentKind};
use crate::walk::{Passage, Walked, curve};

/// One thing that is done. Segments are indices into [`Path::segments`], where it is drawn.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "glossary in book: reference/glossary")]
pub enum Item {
    Chain(Chain),
    /// The hole as an index into [`Path::holes`].
    Hole {
        segment: usize,
        hole: u32,
    },
    /// The circle as an index into [`Path::helices`].
    Helix {
        segment: usize,
        helix: u32,
    },
    Sweep(Sweep),
    Subpath(PlacedSubpath),
}

/// Milling, marking and support segments that follow each other, milled pass by pass together.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// I in mm.
    pub infeed: f64,
    /// W in mm: sweepless milling from this depth on.
    pub first_depth: Option<f64>,
    /// At least one, see [`Walked::members`](crate::Walked::members).
    pub(crate) members: Range<usize>,
}

/// A member of a chain.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainSegment {
    segment: u32,
    cut: u32,
    /// Whether it is the way back over a dead end.
    pub is_return: bool,
    is_turned: bool,
    moved: Option<Box<Curve>>,
}

/// A rapid move at sweep height. A drawn arc is swept straight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// Index into [`Path::segments`]: along which it goes.
    pub segment: usize,
    /// From where the tool is.
    pub start: Xy,
    /// To where it comes.
    pub end: Xy,
    /// Its own S in mm; else the path's.
    pub height: Option<f64>,
}

/// A subpath segment in the direction in which it is traversed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSubpath {
    /// Index into [`Path::segments`], where its parameters are.
    pub segment: usize,
    /// Where the embedded path's start comes to lie.
    pub start: Xy,
    /// Where the tool goes on from.
    pub end: Xy,
}

/// What was gone along so far. Chains without I, and letters without effect inside chains, are reported.
pub(crate) struct Grouped<'a> {
    path: &'a Path,
    walked: Walked,
    /// How many members belong to chains that are items. The others are of the chain that is not yet one.
    chained: usize,
}

impl<'a> Grouped<'a> {
    /// Nothing so far.
    pub(crate) fn new(path: &'a Path) -> Self {
        let members = Vec::with_capacity(path.cuts.len());
        Self { path, walked: Walked { members, ..Walked::default() }, chained: 0 }
    }

    /// Takes the next segment that is gone along.
    #[inline]
    pub(crate) fn add(&mut self, segment: usize, passage: Passage, is_return: bool) {
        if let SegmentKind::Cut(cut) = self.path.segments[segment].kind {
            let segment = u32::try_from(segment).unwrap_or(u32::MAX);
            let Passage { is_turned, moved, .. } = passage;
            return self.walked.members.push(ChainSegment { segment, cut, is_return, is_turned, moved });
        }
        self.finish_chain();
        self.walked.items.extend(self.single(segment, &passage, is_return));
    }

    /// All that was gone along, and what is wrong with it.
    pub(crate) fn finish(mut self) -> Walked {
        self.finish_chain();
        self.walked
    }

    /// What is done along a segment that is in no chain. Going back over it is a sweep.
    fn single(&self, segment: usize, passage: &Passage, is_return: bool) -> Option<Item> {
        let Passage { start, end, .. } = *passage;
        Some(match &self.path.segments[segment].kind {
            SegmentKind::Cut(_) => return None,
            SegmentKind::Sweep { height } => Item::Sweep(Sweep { segment, start, end, height: *height }),
            _ if is_return => Item::Sweep(Sweep { segment, start, end, height: None }),
            SegmentKind::Hole(hole) => Item::Hole { segment, hole: *hole },
            SegmentKind::Helix(helix) => Item::Helix { segment, helix: *helix },
            SegmentKind::Subpath(_) => Item::Subpath(PlacedSubpath { segment, start, end }),
        })
    }

    /// Ends the chain, if there is one.
    pub(crate) fn finish_chain(&mut self) {
        let Self { path, walked: Walked { items, members, diagnostics, .. }, chained } = self;
        let [first, ..] = &members[*chained..] else { return };
        let has_letters = |member: &ChainSegment| member.cut(path).chain_letters.is_some();
        for (before, member) in members[*chained..].iter().zip(&members[*chained + 1..]) {
            // A line that leads into an arc is the same segment as the arc.
            if !member.is_return && before.segment != member.segment && has_letters(member) {
                diagnostics.extend(member.letters_without_effect(path));
            }
        }
        let parameters = first.cut(path).chain;
        match parameters.infeed {
            Some(infeed) => {
                let chain =
                    Chain { infeed, first_depth: parameters.first_depth, members: *chained..members.len() };
                let doubt = chain.doubtful_first_depth(path, &members[*chained..]);
                diagnostics.extend(doubt.filter(|doubt| is_new(diagnostics, doubt)));
                items.push(Item::Chain(chain));
            }
            None => diagnostics.push(first.without_infeed(path)),
        }
        *chained = members.len();
    }
}

/// Whether a doubt about W is not yet among the diagnostics. The path's W is that of each of its chains.
fn is_new(diagnostics: &[Diagnostic], doubt: &Diagnostic) -> bool {
    let is_same = |known: &Diagnostic| {
        (known.message, &known.arguments, &known.text) == (doubt.message, &doubt.arguments, &doubt.text)
    };
    doubt.text.is_some() || !diagnostics.iter().any(is_same)
}

impl Chain {
    /// PB211 where W is outside of the material that the chain removes.
    fn doubtful_first_depth(&self, path: &Path, members: &[ChainSegment]) -> Option<Diagnostic> {
        // Others are reported as out of range.
        let depth = self.first_depth.filter(|depth| above(*depth, 0.0))?;
        let first = members.first()?;
        let bottom = members.iter().map(|member| member.cut(path).bottom).fold(f64::INFINITY, f64::min);
        let problem = if above(depth, path.thickness) {
            Diagnostic::new(&messages::FIRST_DEPTH_IN_AIR)
        } else if above(bottom, depth) {
            Diagnostic::new(&messages::FIRST_DEPTH_BELOW_BOTTOM)
                .with("bottom", bottom)
                .with("depth", path.thickness - bottom)
        } else {
            return None;
        };
        let problem = problem
            .with("value", depth)
            .with("thickness", path.thickness)
            .with("example", (path.thickness - self.infeed).max(bottom));
        let own = path.drawn.text(first.cut(path).chain_letters);
        let fault = own.and_then(|text| text.fault_of(Letter::W));
        let problem = first.origin(path).at(problem);
        Some(match fault {
            Some(fault) => problem.with_text(fault),
            None => problem,
        })
    }
}

impl Item {
    /// The segment along which it goes, where it is one: index into [`Path::segments`].
    pub fn segment(&self) -> Option<usize> {
        match self {
            Self::Chain(_) => None,
            Self::Hole { segment, .. } | Self::Helix { segment, .. } => Some(*segment),
            Self::Sweep(sweep) => Some(sweep.segment),
            Self::Subpath(subpath) => Some(subpath.segment),
        }
    }
}

impl ChainSegment {
    /// Where it is drawn.
    pub fn origin(&self, path: &Path) -> Origin {
        path.origin(&path.segments[self.segment as usize])
    }

    /// What it is: index into [`Drawn::elements`](crate::Drawn::elements).
    pub fn element(&self, path: &Path) -> u32 {
        path.segments[self.segment as usize].element
    }

    /// How it is milled.
    pub fn cut<'p>(&self, path: &'p Path) -> &'p CutParameters {
        &path.cuts[self.cut as usize]
    }

    /// What it is, from where the tool comes from. The path is the one that was walked along.
    pub fn curve(&self, path: &Path) -> Curve {
        let segment = &path.segments[self.segment as usize];
        curve(path, segment, self.is_turned, self.moved.as_deref()).expect("what is in a chain is a curve")
    }

    fn without_infeed(&self, path: &Path) -> Diagnostic {
        let problem = Diagnostic::new(&messages::MISSING).with("letter", 'I');
        self.origin(path).at(problem.with("element", self.cut(path).word()))
    }

    fn letters_without_effect(&self, path: &Path) -> impl Iterator<Item = Diagnostic> {
        let own = path.drawn.text(self.cut(path).chain_letters).into_iter();
        let faults = own.flat_map(|text| {
            [Letter::I, Letter::C, Letter::W].into_iter().filter_map(move |it| Some((it, text.fault_of(it)?)))
        });
        faults.map(|(letter, fault)| {
            let problem =
                Diagnostic::new(&messages::WITHOUT_EFFECT_IN_CHAIN).with("letter", letter.as_char());
            self.origin(path).at(problem.with_text(fault))
        })
    }
}
