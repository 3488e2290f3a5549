//! Closed rings of lines and arcs: the outlines of clamps. (book: language/keep-outs)

use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::approx::coincide;
use crate::geometry::{Arc, Curve, Xy};

/// A curve that may be a part of a ring.
#[derive(Clone, Copy)]
pub(crate) struct Part {
    pub(crate) curve: Curve,
    /// Parts of one polyline follow each other and have the same number.
    pub(crate) group: Option<u32>,
    /// Which entity it is.
    pub(crate) entity: usize,
}

/// What curves make.
pub(crate) enum Ring {
    /// Curves that meet, end to start, all around.
    Closed(Vec<Part>),
    /// Curves that meet, but not all around; both ends.
    Open { part: Part, end: Xy, other: Xy },
    /// A point in which the ends of more than two curves meet.
    Branch { part: Part, at: Xy },
}

/// The rings that curves make: polylines that are closed by themselves, and what else closes.
pub(crate) fn rings(parts: &[Part]) -> Vec<Ring> {
    let (mut rings, mut loose) = (Vec::new(), Vec::new());
    for polyline in parts.chunk_by(|one, other| one.group.is_some() && one.group == other.group) {
        if is_closed(polyline) {
            rings.push(Ring::Closed(polyline.to_vec()));
        } else {
            loose.extend_from_slice(polyline);
        }
    }
    rings.extend(Joining::new(&loose).rings());
    rings
}

/// Whether curves meet, end to start, all around. A line without length goes round nothing.
fn is_closed(parts: &[Part]) -> bool {
    let next = parts.iter().cycle().skip(1);
    let is_whole = |part: &Part| matches!(part.curve, Curve::Arc(Arc { degrees: 360.0, .. }));
    (parts.len() > 1 || parts.iter().all(is_whole))
        && parts.iter().zip(next).all(|(one, next)| coincide(one.curve.end(), next.curve.start()))
}

/// Which end of which curve: twice its number, and one more where it ends.
type End = usize;

/// What an end meets.
#[derive(Clone, Copy, PartialEq)]
enum Meets {
    Nothing,
    One(End),
    Several,
}

/// Curves while those that meet are joined.
struct Joining<'p> {
    parts: &'p [Part],
    /// By end.
    meets: Vec<Meets>,
    is_done: Vec<bool>,
}

/// So near in mm are ends looked for that may coincide.
const NEAR: f64 = 1e-3;

impl<'p> Joining<'p> {
    fn new(parts: &'p [Part]) -> Self {
        let ends = || (0..2 * parts.len()).map(|end| (end, at(parts, end)));
        let tree = RTree::bulk_load(ends().map(|(end, at)| GeomWithData::new([at.x, at.y], end)).collect());
        let meets = |(end, place): (End, Xy)| {
            let near = tree.locate_within_distance([place.x, place.y], NEAR * NEAR).map(|other| other.data);
            let mut others = near.filter(|other| *other != end && coincide(place, at(parts, *other)));
            match (others.next(), others.next()) {
                (None, _) => Meets::Nothing,
                (Some(other), None) => Meets::One(other),
                (Some(_), Some(_)) => Meets::Several,
            }
        };
        Self { parts, meets: ends().map(meets).collect(), is_done: vec![false; parts.len()] }
    }

    fn rings(mut self) -> Vec<Ring> {
        let mut rings = Vec::new();
        for first in 0..self.parts.len() {
            if !self.is_done[first] {
                rings.push(self.ring(first));
            }
        }
        rings
    }

    /// Goes along from a curve's end until that is where it starts, or until nothing more, or too much, meets.
    fn ring(&mut self, first: usize) -> Ring {
        let start = 2 * first;
        let (ring, last) = self.follow(start + 1);
        match self.next(last) {
            Some(next) if next == start => return Ring::Closed(ring),
            _ => {}
        }
        // The other way as well: all of it is one fault.
        let (_, other) = self.follow(start);
        let several = [last, other].into_iter().find(|end| self.meets[*end] != Meets::Nothing);
        let (end, part) = (several.unwrap_or(last), self.parts[several.unwrap_or(last) / 2]);
        match several {
            Some(_) => Ring::Branch { part, at: at(self.parts, end) },
            None => Ring::Open { part, end: at(self.parts, end), other: at(self.parts, other) },
        }
    }

    /// The curves from an end on, each run away from it, and the end of the last.
    fn follow(&mut self, from: End) -> (Vec<Part>, End) {
        let mut ring = vec![self.run_to(from)];
        let mut end = from;
        while let Some(next) = self.next(end).filter(|next| !self.is_done[next / 2]) {
            end = next ^ 1;
            ring.push(self.run_to(end));
        }
        (ring, end)
    }

    /// The end that one meets, where each meets no other.
    fn next(&self, end: End) -> Option<End> {
        let Meets::One(next) = self.meets[end] else { return None };
        (self.meets[next] == Meets::One(end)).then_some(next)
    }

    /// A curve, run to that end.
    fn run_to(&mut self, end: End) -> Part {
        let part = self.parts[end / 2];
        self.is_done[end / 2] = true;
        Part { curve: if end % 2 == 1 { part.curve } else { part.curve.reversed() }, ..part }
    }
}

fn at(parts: &[Part], end: End) -> Xy {
    let curve = &parts[end / 2].curve;
    if end % 2 == 1 { curve.end() } else { curve.start() }
}
