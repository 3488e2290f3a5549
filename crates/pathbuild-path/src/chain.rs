//! The operations along a path, in order, with consecutive cuts grouped into milling chains. (book: language/chains-and-passes)

use std::ops::Range;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;

use crate::approx::above;
use crate::element::{Cut, Origin};
use crate::geometry::{Curve, Line, Xy};
use crate::letter::Letter;
use crate::path::{CutParameters, Path, Segment, SegmentKind};

/// A path in milling order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WalkedPath {
    /// The operations in order. Complete only if no diagnostic is an error.
    pub items: Vec<Item>,
    /// The members of all chains, in walking order.
    pub(crate) members: Vec<ChainSegment>,
    /// The findings of the walk: PB401 to PB404, PB201 for chains without I, and PB114, PB115, PB121, PB210 and PB211.
    pub diagnostics: Vec<Diagnostic>,
    /// The last point of a path without an end marker.
    pub open_end: Option<Xy>,
}

/// An operation. Its segment is an index into [`Path::segments`].
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "glossary in book: reference/glossary")]
pub enum Item {
    Chain(Chain),
    /// A drilled hole, by its index into [`Path::holes`].
    Hole {
        segment: usize,
        hole: u32,
    },
    /// A helical circle, by its index into [`Path::helices`].
    Helix {
        segment: usize,
        helix: u32,
    },
    Sweep(Sweep),
    Subpath(PlacedSubpath),
}

/// Consecutive milling, marking and support segments, which are milled together pass by pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Infeed (I) in mm.
    pub infeed: f64,
    /// W: Z in mm of the first pass of a chain that is milled without lifting; `None` for ordinary milling. (book: language/sweepless)
    pub first_depth: Option<f64>,
    /// Range of the chain's members in [`WalkedPath::members`]; never empty.
    pub(crate) members: Range<usize>,
}

/// A segment that belongs to a chain, in walking direction.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainSegment {
    segment: u32,
    cut: u32,
    /// Whether the segment leads back out of a dead end.
    pub is_return: bool,
    is_turned: bool,
    moved: Option<Box<Curve>>,
}

/// A rapid move at sweep height. Drawn arcs are swept in a straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// The drawn segment, as an index into [`Path::segments`].
    pub segment: usize,
    /// The point at which the move starts.
    pub start: Xy,
    /// The point at which the move ends.
    pub end: Xy,
    /// The sweep's own height (S) in mm; `None` if it has the path's.
    pub height: Option<f64>,
}

/// A subpath segment in walking direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSubpath {
    /// The segment with its parameters, as an index into [`Path::segments`].
    pub segment: usize,
    /// The position of the embedded path's start.
    pub start: Xy,
    /// The point from which the walk continues.
    pub end: Xy,
}

impl WalkedPath {
    /// Creates the result of a walk that failed with this problem: it has no items.
    pub fn from_failure(problem: Diagnostic) -> Self {
        Self { diagnostics: vec![problem], ..Self::default() }
    }

    /// Returns the members of one of this walk's chains, in walking order and each in walking direction. A chain has at least one.
    pub fn members(&self, chain: &Chain) -> &[ChainSegment] {
        &self.members[chain.members.clone()]
    }
}

/// Groups the traversed segments into items. Reports chains without I, letters without effect inside chains, and doubtful values of W.
pub(crate) struct ChainBuilder<'a> {
    path: &'a Path,
    walked: WalkedPath,
    /// Number of members that belong to finished chains; the remaining ones form the current chain.
    chained: usize,
}

impl<'a> ChainBuilder<'a> {
    pub(crate) fn new(path: &'a Path) -> Self {
        let members = Vec::with_capacity(path.cuts.len());
        Self { path, walked: WalkedPath { members, ..WalkedPath::default() }, chained: 0 }
    }

    #[inline]
    pub(crate) fn add(&mut self, segment: usize, passage: Passage, is_return: bool) {
        if let SegmentKind::Cut(cut) = self.path.segments[segment].kind {
            let segment = u32::try_from(segment).unwrap_or(u32::MAX);
            let Passage { is_turned, moved, .. } = passage;
            return self.walked.members.push(ChainSegment { segment, cut, is_return, is_turned, moved });
        }
        self.finish_chain();
        self.walked.items.extend(self.single_item(segment, &passage, is_return));
    }

    /// Adds a sweep across the gap before or after a segment.
    pub(crate) fn add_sweep(&mut self, segment: usize, start: Xy, end: Xy) {
        self.finish_chain();
        self.walked.items.push(Item::Sweep(Sweep { segment, start, end, height: None }));
    }

    pub(crate) fn finish(mut self) -> WalkedPath {
        self.finish_chain();
        self.walked
    }

    /// Returns the item for a segment outside of chains. Going back over such a segment is a sweep.
    fn single_item(&self, segment: usize, passage: &Passage, is_return: bool) -> Option<Item> {
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

    pub(crate) fn finish_chain(&mut self) {
        let Self { path, walked: WalkedPath { items, members, diagnostics, .. }, chained } = self;
        let [first, ..] = &members[*chained..] else { return };
        let has_letters = |member: &ChainSegment| member.cut(path).chain_letters.is_some();
        for (before, member) in members[*chained..].iter().zip(&members[*chained + 1..]) {
            // An arc and the line that leads into it belong to the same segment.
            if !member.is_return && before.segment != member.segment && has_letters(member) {
                diagnostics.extend(member.letters_without_effect(path));
            }
        }
        let parameters = first.cut(path).chain;
        match parameters.infeed {
            Some(infeed) => {
                let chain =
                    Chain { infeed, first_depth: parameters.first_depth, members: *chained..members.len() };
                let doubt = chain.first_depth_problem(path, &members[*chained..]);
                diagnostics.extend(doubt.filter(|doubt| is_new(diagnostics, doubt)));
                diagnostics.extend(chain.rise_in_groove_problem(path, &members[*chained..]));
                items.push(Item::Chain(chain));
            }
            None => diagnostics.push(first.missing_infeed(path)),
        }
        *chained = members.len();
    }
}

/// Whether a doubt about W has not been reported yet. The path's W applies to each of its chains, so the same doubt can come up several times.
fn is_new(diagnostics: &[Diagnostic], doubt: &Diagnostic) -> bool {
    let is_same = |known: &Diagnostic| {
        (known.message, &known.arguments, &known.text) == (doubt.message, &doubt.arguments, &doubt.text)
    };
    doubt.text.is_some() || !diagnostics.iter().any(is_same)
}

impl Chain {
    /// Returns PB211 if W is above the material or below the bottom of the chain.
    fn first_depth_problem(&self, path: &Path, members: &[ChainSegment]) -> Option<Diagnostic> {
        // A W of 0 or less is reported as out of range (PB203).
        let depth = self.first_depth.filter(|depth| above(*depth, 0.0))?;
        let first = members.first()?;
        let bottom = members.iter().map(|member| member.cut(path).bottom).fold(f64::INFINITY, f64::min);
        let example = (path.thickness - self.infeed).max(bottom);
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
            .with("example", if above(example, 0.0) { example } else { path.thickness / 2.0 });
        let own = path.drawn.text(first.cut(path).chain_letters);
        let fault = own.and_then(|text| text.fault_of(Letter::W));
        Some(first.origin(path).at(problem).with_text(fault))
    }

    /// Returns PB211 if a slot cutter would rise in the groove that it mills: to the support bars of a segment, or to one with a higher bottom.
    fn rise_in_groove_problem(&self, path: &Path, members: &[ChainSegment]) -> Option<Diagnostic> {
        self.first_depth.filter(|_| path.may_be_slot_cutter)?;
        let top = |cut: &CutParameters| {
            let bars = cut.bars.as_ref().filter(|_| cut.cut == Cut::Support);
            bars.map_or(cut.bottom, |bars| bars.top.max(cut.bottom))
        };
        let lowest = members.iter().map(|member| member.cut(path).bottom).fold(f64::INFINITY, f64::min);
        let higher = members.iter().find(|member| above(top(member.cut(path)), lowest))?;
        let problem = Diagnostic::new(&messages::RISE_IN_GROOVE).with("height", top(higher.cut(path)));
        Some(higher.origin(path).at(problem))
    }
}

impl Item {
    /// The item's segment, as an index into [`Path::segments`]; `None` for a chain, which consists of several.
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
    /// Returns the location of the segment's element.
    pub fn origin(&self, path: &Path) -> Origin {
        path.origin(&path.segments[self.segment as usize])
    }

    /// Returns the segment's element, as an index into [`DrawnElements::elements`](crate::DrawnElements::elements).
    pub fn element(&self, path: &Path) -> u32 {
        path.segments[self.segment as usize].element
    }

    /// Returns the parameters for milling the segment.
    pub fn cut<'p>(&self, path: &'p Path) -> &'p CutParameters {
        &path.cuts[self.cut as usize]
    }

    /// Returns the segment's curve in walking direction. `path` must be the walked path.
    pub fn curve(&self, path: &Path) -> Curve {
        let segment = &path.segments[self.segment as usize];
        curve(path, segment, self.is_turned, self.moved.as_deref()).expect("what is in a chain is a curve")
    }

    fn missing_infeed(&self, path: &Path) -> Diagnostic {
        let problem = Diagnostic::new(&messages::MISSING).with("letter", 'I');
        self.origin(path).at(problem.with("element", self.cut(path).word()))
    }

    fn letters_without_effect(&self, path: &Path) -> impl Iterator<Item = Diagnostic> {
        let own = path.drawn.text(self.cut(path).chain_letters).into_iter();
        let faults = own.flat_map(|text| {
            Letter::all()
                .filter(|letter| letter.is_of_chain())
                .filter_map(move |letter| Some((letter, text.fault_of(letter)?)))
        });
        faults.map(|(letter, fault)| {
            let problem =
                Diagnostic::new(&messages::WITHOUT_EFFECT_IN_CHAIN).with("letter", letter.as_char());
            self.origin(path).at(problem.with_text(fault))
        })
    }
}

/// A segment in walking direction.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    pub(crate) start: Xy,
    pub(crate) end: Xy,
    /// Whether the passage runs against the drawn direction.
    pub(crate) is_turned: bool,
    /// The milled curve if it differs from the drawn one, because the start was moved to close a gap.
    pub(crate) moved: Option<Box<Curve>>,
}

impl Passage {
    pub(crate) fn in_drawn_direction([start, end]: [Xy; 2]) -> Self {
        Self { start, end, is_turned: false, moved: None }
    }

    /// Returns the passage in the opposite direction. A subpath is then embedded the other way round, so that its start is where the walk comes from.
    pub(crate) fn reversed(self) -> Self {
        self.reversed_if(true)
    }

    /// Returns the passage, reversed if `is_turned`. Ends are selected by index and not by an `if`, which the processor would often mispredict.
    #[inline]
    pub(crate) fn reversed_if(mut self, is_turned: bool) -> Self {
        let (ends, first) = ([self.start, self.end], usize::from(is_turned));
        (self.start, self.end) = (ends[first], ends[1 - first]);
        self.is_turned ^= is_turned;
        if let Some(moved) = self.moved.as_mut().filter(|_| is_turned) {
            **moved = moved.reversed();
        }
        self
    }

    /// Returns the passage with its start moved to a nearby point; a cut then runs straight from there to its end.
    pub(crate) fn starting_at(self, start: Xy, segment: &Segment) -> Self {
        let line = Curve::Line(Line { start, end: self.end });
        let moved = matches!(segment.kind, SegmentKind::Cut(_)).then(|| Box::new(line));
        Self { start, moved, ..self }
    }

    /// Returns a short line from a nearby point to the start of the passage.
    pub(crate) fn lead_in(&self, from: Xy) -> Self {
        let line = Curve::Line(Line { start: from, end: self.start });
        Self { start: from, end: self.start, is_turned: false, moved: Some(Box::new(line)) }
    }
}

/// Returns the curve of a segment in walking direction; `None` for circles.
pub(crate) fn curve(path: &Path, segment: &Segment, is_turned: bool, moved: Option<&Curve>) -> Option<Curve> {
    if let Some(moved) = moved {
        return Some(*moved);
    }
    let drawn = path.curve(segment)?;
    Some(if is_turned { drawn.reversed() } else { drawn })
}
