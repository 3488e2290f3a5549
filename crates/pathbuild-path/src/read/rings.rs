//! Finds closed rings of lines and arcs, the outlines of clamps. (book: language/keep-outs)

use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::approx::coincide;
use crate::geometry::{Arc, Curve, Xy};

/// A curve that may be part of a ring.
#[derive(Clone, Copy)]
pub(crate) struct Part {
    pub(crate) curve: Curve,
    /// Number of its polyline; the parts of a polyline are consecutive.
    pub(crate) group: Option<u32>,
    /// The index of its entity.
    pub(crate) entity: usize,
}

/// The result of joining curves.
pub(crate) enum Ring {
    /// A closed sequence of curves.
    Closed(Vec<Part>),
    /// An open sequence of curves, with both ends.
    Open { part: Part, end: Xy, other: Xy },
    /// A point where more than two curves end.
    Branch { part: Part, at: Xy },
}

/// The rings formed by curves: first polylines that are closed themselves, then everything else.
pub(crate) fn rings(parts: &[Part]) -> Vec<Ring> {
    let (mut rings, mut loose) = (Vec::new(), Vec::new());
    for polyline in parts.chunk_by(|one, other| one.group.is_some() && one.group == other.group) {
        if is_closed(polyline) {
            rings.push(Ring::Closed(polyline.to_vec()));
        } else {
            loose.extend_from_slice(polyline);
        }
    }
    rings.extend(RingBuilder::new(&loose).rings());
    rings
}

/// Whether the curves form a closed sequence. A line without length encloses nothing.
fn is_closed(parts: &[Part]) -> bool {
    let next = parts.iter().cycle().skip(1);
    let is_whole = |part: &Part| matches!(part.curve, Curve::Arc(Arc { degrees: 360.0, .. }));
    (parts.len() > 1 || parts.iter().all(is_whole))
        && parts.iter().zip(next).all(|(one, next)| coincide(one.curve.end(), next.curve.start()))
}

/// The end of a curve: twice the index of the curve, plus one for its second end.
type End = usize;

/// The other ends that an end coincides with.
#[derive(Clone, Copy, PartialEq)]
enum Junction {
    Nothing,
    One(End),
    Several,
}

/// State of joining curves.
struct RingBuilder<'p> {
    parts: &'p [Part],
    /// What each end meets.
    meets: Vec<Junction>,
    is_done: Vec<bool>,
}

/// Search radius in mm for ends that may coincide.
const NEAR: f64 = 1e-3;

impl<'p> RingBuilder<'p> {
    fn new(parts: &'p [Part]) -> Self {
        let ends = || (0..2 * parts.len()).map(|end| (end, at(parts, end)));
        let tree = RTree::bulk_load(ends().map(|(end, at)| GeomWithData::new([at.x, at.y], end)).collect());
        let meets = |(end, place): (End, Xy)| {
            let near = tree.locate_within_distance([place.x, place.y], NEAR * NEAR).map(|other| other.data);
            let mut others = near.filter(|other| *other != end && coincide(place, at(parts, *other)));
            match (others.next(), others.next()) {
                (None, _) => Junction::Nothing,
                (Some(other), None) => Junction::One(other),
                (Some(_), Some(_)) => Junction::Several,
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

    /// Follows curves from an end until the ring closes, or until no curve or several curves continue.
    fn ring(&mut self, first: usize) -> Ring {
        let start = 2 * first;
        let (ring, last) = self.follow(start + 1);
        match self.next(last) {
            Some(next) if next == start => return Ring::Closed(ring),
            _ => {}
        }
        // Follow the other direction as well, since all of it is a single problem.
        let (_, other) = self.follow(start);
        let several = [last, other].into_iter().find(|end| self.meets[*end] != Junction::Nothing);
        let (end, part) = (several.unwrap_or(last), self.parts[several.unwrap_or(last) / 2]);
        match several {
            Some(_) => Ring::Branch { part, at: at(self.parts, end) },
            None => Ring::Open { part, end: at(self.parts, end), other: at(self.parts, other) },
        }
    }

    /// The curves that continue from an end, in that direction, and the final end.
    fn follow(&mut self, from: End) -> (Vec<Part>, End) {
        let mut ring = vec![self.run_to(from)];
        let mut end = from;
        while let Some(next) = self.next(end).filter(|next| !self.is_done[next / 2]) {
            end = next ^ 1;
            ring.push(self.run_to(end));
        }
        (ring, end)
    }

    /// The only end that this end meets, if that meets no other.
    fn next(&self, end: End) -> Option<End> {
        let Junction::One(next) = self.meets[end] else { return None };
        (self.meets[next] == Junction::One(end)).then_some(next)
    }

    /// A curve in the direction that ends there.
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
