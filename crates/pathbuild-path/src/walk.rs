//! The walk: from loose segments to one order from the start to the end. (spec/50-path-building.md, "The walk")

mod ends;
mod failure;
mod join;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing as messages;

use crate::approx::{coincide, near};
use crate::chain::{Item, items};
use crate::geometry::Xy;
use crate::path::{Path, Segment, SegmentKind, Sweep};

use ends::Ends;

/// A path in the order of milling.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Walked {
    /// What is done, in order. Complete only when no diagnostic is an error.
    pub items: Vec<Item>,
    /// One of PB401 to PB404, or PB201 for each chain without I; PB114 and PB210.
    pub diagnostics: Vec<Diagnostic>,
}

/// A segment as it is traversed.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// Its index in the path.
    pub(crate) segment: usize,
    /// From where the tool is to where it comes; `None` for the return over a drilled hole, which only ends the chain.
    pub(crate) traversed: Option<Segment>,
    /// Whether it is gone back over.
    pub(crate) is_return: bool,
}

/// Orders the segments of a path. Ends within `join_tolerance` mm are joined with a warning each, where none coincide.
pub fn walk(path: &Path, join_tolerance: f64) -> Walked {
    let mut walk = Walk::new(path, join_tolerance);
    let (items, mut diagnostics) = match walk.run() {
        Ok(()) => items(&walk.steps),
        Err(problem) => (Vec::new(), vec![*problem]),
    };
    diagnostics.append(&mut walk.joined);
    if !items.is_empty() {
        diagnostics.extend(walk.idle_markers());
    }
    for diagnostic in &mut diagnostics {
        diagnostic.path = Some(path.name.as_str().into());
    }
    Walked { items, diagnostics }
}

struct Walk<'a> {
    path: &'a Path,
    ends: Ends,
    is_traversed: Vec<bool>,
    left: usize,
    at: Xy,
    steps: Vec<Step>,
    /// Steps taken forwards and not yet gone back over. They always lead from the start to `at`.
    way_back: Vec<Step>,
    has_acted: Vec<bool>,
    join_tolerance: f64,
    /// PB115 for each join.
    joined: Vec<Diagnostic>,
}

impl<'a> Walk<'a> {
    fn new(path: &'a Path, join_tolerance: f64) -> Self {
        Self {
            path,
            join_tolerance,
            joined: Vec::new(),
            ends: Ends::new(&path.segments),
            is_traversed: vec![false; path.segments.len()],
            left: path.segments.len(),
            at: path.start,
            steps: Vec::new(),
            way_back: Vec::new(),
            has_acted: vec![false; path.turns.len()],
        }
    }

    fn run(&mut self) -> Result<(), Box<Diagnostic>> {
        if self.path.segments.is_empty() {
            return Err(self.empty().into());
        }
        while self.left > 0 {
            if let Some(segment) = self.next().or_else(|| self.next_within_tolerance()) {
                self.take(segment);
            } else if let Some(marker) = self.turn_marker() {
                self.go_back(Self::has_next).map_err(|()| self.turn_found_nothing(marker))?;
            } else if self.is_at_end() {
                return Err(self.unreached().into());
            } else {
                return Err(self.nothing_continues().into());
            }
        }
        if self.is_at_end() || self.joins_end() {
            return Ok(());
        }
        let stopped_at = self.at;
        if self.turn_marker().is_none() || self.go_back(Self::is_at_end).is_err() {
            return Err(self.end_not_reached(stopped_at).into());
        }
        Ok(())
    }

    /// The segment that is next at the current point: the least by order, preference and length.
    fn next(&self) -> Option<usize> {
        let near = self.ends.near(self.at, &self.path.segments);
        let mut candidates: Vec<usize> = near.filter(|segment| !self.is_traversed[*segment]).collect();
        // One scan in segment order: lengths are compared approximately, which is not transitive.
        candidates.sort_unstable();
        candidates.into_iter().reduce(|best, other| if self.comes_before(other, best) { other } else { best })
    }

    fn comes_before(&self, a: usize, b: usize) -> bool {
        let (first, second) = (&self.path.segments[a], &self.path.segments[b]);
        let rank = |segment: &Segment| (segment.order, segment.preference());
        if rank(first) != rank(second) {
            return rank(first) < rank(second);
        }
        let (length, other) = (first.chord(), second.chord());
        if near(length, other) { a < b } else { length < other }
    }

    fn take(&mut self, index: usize) {
        let segment = self.path.segments[index].clone();
        let step = Step { segment: index, traversed: Some(self.as_met_here(segment)), is_return: false };
        self.is_traversed[index] = true;
        self.left -= 1;
        self.way_back.push(step.clone());
        self.follow(step);
    }

    /// A segment is turned round when its end is where the tool is, and begins exactly there where it is joined.
    fn as_met_here(&self, segment: Segment) -> Segment {
        let (to_start, to_end) = ((segment.start() - self.at).norm(), (segment.end() - self.at).norm());
        let is_joined = !coincide(segment.start(), self.at) && !coincide(segment.end(), self.at);
        let is_turned = if is_joined { to_end < to_start } else { coincide(segment.end(), self.at) };
        let segment = if is_turned { segment.turned_round() } else { segment };
        if is_joined { segment.starting_at(self.at) } else { segment }
    }

    fn follow(&mut self, step: Step) {
        if let Some(segment) = &step.traversed {
            self.at = segment.end();
        }
        self.steps.push(step);
    }

    fn turn_marker(&mut self) -> Option<usize> {
        let found = self.path.turns.iter().position(|turn| coincide(turn.at, self.at))?;
        // Several at one point are one.
        for (turn, has_acted) in self.path.turns.iter().zip(&mut self.has_acted) {
            *has_acted |= coincide(turn.at, self.at);
        }
        Some(found)
    }

    /// Goes back over the way until something is found; an error when the way back is used up.
    fn go_back(&mut self, is_found: impl Fn(&Self) -> bool) -> Result<(), ()> {
        loop {
            let step = self.way_back.pop().ok_or(())?;
            let traversed = step.traversed.and_then(returned).map(|segment| self.as_met_here(segment));
            self.follow(Step { segment: step.segment, traversed, is_return: true });
            if is_found(self) {
                return Ok(());
            }
        }
    }

    fn has_next(&self) -> bool {
        self.next().is_some()
    }

    fn is_at_end(&self) -> bool {
        coincide(self.at, self.path.end)
    }

    fn idle_markers(&self) -> Vec<Diagnostic> {
        let idle = self.path.turns.iter().zip(&self.has_acted).filter(|(_, has_acted)| !**has_acted);
        idle.map(|(turn, _)| turn.origin.at(Diagnostic::new(&messages::TURN_WITHOUT_EFFECT))).collect()
    }
}

/// What going back over a segment is. (spec/50-path-building.md, "Turn markers")
fn returned(segment: Segment) -> Option<Segment> {
    let sweep = |start, end, height| SegmentKind::Sweep(Sweep { start, end, height });
    let kind = match &segment.kind {
        SegmentKind::Cut(_) => return Some(segment.turned_round()),
        SegmentKind::Hole(_) => return None,
        SegmentKind::Helix(helix) => sweep(helix.centre, helix.centre, None),
        SegmentKind::Sweep(forwards) => sweep(forwards.end, forwards.start, forwards.height),
        SegmentKind::Subpath(subpath) => sweep(subpath.end, subpath.start, None),
    };
    Some(Segment { kind, ..segment })
}
