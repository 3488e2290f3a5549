//! Stretches of a curve that are near another curve, found exactly.

use nalgebra::Vector2;

use crate::boxes::may_be_near;
use crate::geometry::{Arc, Curve, Line, Xy};

/// A stretch of a curve: its start and end, in mm along the curve.
pub(crate) type Stretch = (f64, f64);

/// Gap in mm below which two stretches of a curve are joined.
pub(crate) const JOIN_GAP: f64 = 1e-9;

/// Gap in mm below which stretches of consecutive curves are joined.
pub(crate) const NEIGHBOUR_JOIN_GAP: f64 = 1e-6;

/// Adds the stretches of `along` that are nearer to `other` than `reach` mm.
///
/// Candidates for their ends are the places where `along` crosses the border of the shape that a disc sweeps along `other`. Between two
/// neighbouring candidates the distance of the middle decides, so that curves that touch or coincide need no special case.
pub(crate) fn add_stretches_within(along: &Curve, other: &Curve, reach: f64, found: &mut Vec<Stretch>) {
    if !may_be_near(along, other, reach) {
        return;
    }
    let length = along.length();
    let mut cuts = BoundaryCandidates::default();
    cuts.extend([0.0, length]);
    cross_circle(along, other.start(), reach, &mut cuts);
    cross_circle(along, other.end(), reach, &mut cuts);
    match other {
        Curve::Line(Line { start, end }) => {
            if let Some(direction) = (end - start).try_normalize(0.0) {
                let aside = Vector2::new(-direction.y, direction.x) * reach;
                cross_line(along, &Line { start: start + aside, end: end + aside }, &mut cuts);
                cross_line(along, &Line { start: start - aside, end: end - aside }, &mut cuts);
            }
        }
        Curve::Arc(Arc { centre, radius, .. }) => {
            cross_circle(along, *centre, radius + reach, &mut cuts);
            cross_circle(along, *centre, (radius - reach).abs(), &mut cuts);
        }
    }
    for cut in cuts.sorted(length).windows(2) {
        let (from, to) = (cut[0], cut[1]);
        if to > from && other.distance_to(along.at(f64::midpoint(from, to))) < reach {
            found.push((from, to));
        }
    }
}

/// Places along a curve at which a stretch may begin or end: its ends, and two for each circle and line that borders a swept shape.
#[derive(Default)]
struct BoundaryCandidates {
    places: [f64; 10],
    count: usize,
}

impl BoundaryCandidates {
    fn extend(&mut self, places: impl IntoIterator<Item = f64>) {
        for place in places {
            self.places[self.count] = place;
            self.count += 1;
        }
    }

    /// Returns the places that lie on the curve, in order.
    fn sorted(&mut self, length: f64) -> &[f64] {
        let mut kept = 0;
        for number in 0..self.count {
            if (0.0..=length).contains(&self.places[number]) {
                self.places[kept] = self.places[number];
                kept += 1;
            }
        }
        self.places[..kept].sort_unstable_by(f64::total_cmp);
        &self.places[..kept]
    }
}

/// Sorts stretches and joins those that overlap or are at most `gap` mm apart.
pub(crate) fn join_stretches(mut stretches: Vec<Stretch>, gap: f64) -> Vec<Stretch> {
    stretches.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    stretches.dedup_by(|next, last| {
        let is_joined = next.0 <= last.1 + gap;
        if is_joined {
            last.1 = last.1.max(next.1);
        }
        is_joined
    });
    stretches
}

/// Returns the total length in mm of stretches that may overlap.
pub(crate) fn joined_length<'s>(stretches: impl IntoIterator<Item = &'s Stretch>) -> f64 {
    let joined = join_stretches(stretches.into_iter().copied().collect(), JOIN_GAP);
    joined.iter().map(|(from, to)| to - from).sum()
}

/// Returns the gaps between joined stretches within a range.
pub(crate) fn gaps_between(stretches: &[Stretch], (start, end): Stretch) -> Vec<Stretch> {
    let mut at = start;
    let mut gaps = Vec::new();
    for (from, to) in stretches {
        if *from > at {
            gaps.push((at, from.min(end)));
        }
        at = at.max(*to);
    }
    if at < end {
        gaps.push((at, end));
    }
    gaps.retain(|(from, to)| to > from);
    gaps
}

/// Returns the intersection of two sequences of joined stretches.
pub(crate) fn intersection(one: &[Stretch], other: &[Stretch]) -> Vec<Stretch> {
    let mut all = Vec::new();
    let (mut a, mut b) = (one.iter().peekable(), other.iter().peekable());
    while let (Some(first), Some(second)) = (a.peek(), b.peek()) {
        let stretch = (first.0.max(second.0), first.1.min(second.1));
        if stretch.1 > stretch.0 {
            all.push(stretch);
        }
        if first.1 < second.1 {
            a.next()
        } else {
            b.next()
        };
    }
    all
}

/// Returns the difference of two sequences of joined stretches: the stretches in the first but not in the second.
pub(crate) fn difference(one: &[Stretch], other: &[Stretch]) -> Vec<Stretch> {
    one.iter().flat_map(|stretch| gaps_between(other, *stretch)).collect()
}

/// Joins the last stretch of a ring with the first if they meet at the ring's start. `whole`: the length of the ring in mm.
pub(crate) fn join_ends(mut stretches: Vec<Stretch>, whole: f64) -> Vec<Stretch> {
    let meets = |stretches: &[Stretch]| {
        stretches.len() > 1
            && stretches[0].0 < NEIGHBOUR_JOIN_GAP
            && stretches[stretches.len() - 1].1 > whole - NEIGHBOUR_JOIN_GAP
    };
    if meets(&stretches)
        && let Some(last) = stretches.pop()
    {
        stretches[0].0 = last.0 - whole;
    }
    stretches
}

/// Returns a curve shifted to the right, out of the material, by `distance` mm. `None` for an arc whose radius would vanish and for a line without
/// length.
pub(crate) fn offset_curve(curve: &Curve, distance: f64) -> Option<Curve> {
    match curve {
        Curve::Line(Line { start, end }) => {
            let way = (end - start).try_normalize(0.0)?;
            let aside = Vector2::new(way.y, -way.x) * distance;
            Some(Curve::Line(Line { start: start + aside, end: end + aside }))
        }
        Curve::Arc(arc) => {
            let radius = if arc.clockwise { arc.radius - distance } else { arc.radius + distance };
            let scaled = |at: Xy| arc.centre + (at - arc.centre) * (radius / arc.radius);
            (radius > JOIN_GAP)
                .then(|| Curve::Arc(Arc { radius, start: scaled(arc.start), end: scaled(arc.end), ..*arc }))
        }
    }
}

/// Returns the position, in mm along an arc, of its point in a direction from the centre; `None` if the arc has no point in this direction.
fn along_arc(arc: &Arc, out: Vector2<f64>) -> Option<f64> {
    arc.spans(out).then(|| along_circle(arc, out))
}

/// Returns the position, in mm from the start of an arc, of the point of its circle in a direction from the centre.
fn along_circle(arc: &Arc, out: Vector2<f64>) -> f64 {
    let from = arc.start - arc.centre;
    let angle = libm::atan2(from.perp(&out), from.dot(&out));
    let ahead = if arc.clockwise { -angle } else { angle };
    arc.radius * if ahead < 0.0 { ahead + std::f64::consts::TAU } else { ahead }
}

/// Returns the stretch that a section of the same line or circle covers, in mm from the start of a curve. It may lie beyond the ends of the curve.
pub(crate) fn stretch_of_section(curve: &Curve, section: &Curve) -> Stretch {
    let (middle, half) = (section.middle(), section.length() / 2.0);
    let along = match curve {
        Curve::Line(Line { start, end }) => {
            (end - start).try_normalize(0.0).map_or(0.0, |direction| direction.dot(&(middle - start)))
        }
        Curve::Arc(arc) => along_circle(arc, middle - arc.centre),
    };
    (along - half, along + half)
}

fn cross_circle(along: &Curve, centre: Xy, radius: f64, cuts: &mut BoundaryCandidates) {
    match along {
        Curve::Line(line) => cuts.extend(line_and_circle(line, centre, radius).into_iter().flatten()),
        Curve::Arc(arc) => {
            let way = centre - arc.centre;
            let squared = way.norm_squared();
            if squared == 0.0 {
                return;
            }
            let share = (squared + arc.radius * arc.radius - radius * radius) / (2.0 * squared);
            let half = arc.radius * arc.radius / squared - share * share;
            if half < 0.0 {
                return;
            }
            let across = Vector2::new(-way.y, way.x) * libm::sqrt(half);
            cuts.extend([across, -across].into_iter().filter_map(|side| along_arc(arc, way * share + side)));
        }
    }
}

/// Returns the places where the infinite line through a line crosses a circle, in mm along the line.
fn line_and_circle(line: &Line, centre: Xy, radius: f64) -> Option<[f64; 2]> {
    let way = line.end - line.start;
    let squared = way.norm_squared();
    if squared == 0.0 {
        return None;
    }
    let out = line.start - centre;
    let foot = -way.dot(&out) / squared;
    let half = radius * radius - (out + way * foot).norm_squared();
    if half < 0.0 {
        return None;
    }
    let (half, length) = (libm::sqrt(half / squared), libm::sqrt(squared));
    Some([(foot - half) * length, (foot + half) * length])
}

fn cross_line(along: &Curve, line: &Line, cuts: &mut BoundaryCandidates) {
    let way = line.end - line.start;
    match along {
        Curve::Line(own) => {
            let direction = own.end - own.start;
            let across = direction.perp(&way);
            if across != 0.0 {
                cuts.extend([(line.start - own.start).perp(&way) / across * direction.norm()]);
            }
        }
        Curve::Arc(arc) => {
            let places = line_and_circle(line, arc.centre, arc.radius).into_iter().flatten();
            let length = way.norm();
            let outwards = places.map(|place| line.start + way * (place / length) - arc.centre);
            cuts.extend(outwards.filter_map(|out| along_arc(arc, out)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(a: [f64; 2], b: [f64; 2]) -> Curve {
        Curve::Line(Line { start: Xy::new(a[0], a[1]), end: Xy::new(b[0], b[1]) })
    }

    fn stretches(along: &Curve, other: &Curve, reach: f64) -> Vec<Stretch> {
        let mut found = Vec::new();
        add_stretches_within(along, other, reach, &mut found);
        join_stretches(found, JOIN_GAP)
    }

    #[test]
    fn a_parallel_line_is_near_all_along_or_nowhere() {
        let along = line([0.0, 0.0], [10.0, 0.0]);
        let other = line([2.0, 1.0], [8.0, 1.0]);
        assert_eq!(stretches(&along, &other, 1.0), [], "it only touches");
        let [(from, to)] = stretches(&along, &other, 1.25)[..] else { panic!("one stretch") };
        assert!((from - 1.25).abs() < 1e-12 && (to - 8.75).abs() < 1e-12, "{from} {to}");
    }

    /// Compares with the distances of sample points, for pairs on a coarse grid, where curves often touch or coincide.
    #[test]
    fn stretches_agree_with_sampled_distances() {
        let mut state = 7_u64;
        let mut number = |count: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % count
        };
        for round in 0..2000 {
            let mut curve = || {
                let mut half = |count| number(count) as f64 / 2.0;
                let at = Xy::new(half(12), half(12));
                if number(2) == 0 {
                    let mut half = |count| number(count) as f64 / 2.0;
                    Curve::Line(Line { start: at, end: Xy::new(half(12), half(12)) })
                } else {
                    let (radius, from, span) = (
                        1.0 + number(6) as f64 / 2.0,
                        45.0 * number(8) as f64,
                        45.0 * (1 + number(8)) as f64,
                    );
                    Curve::Arc(Arc::from_angles(at, radius, from, from + span, number(2) == 0))
                }
            };
            let (along, other) = (curve(), curve());
            let reach = 0.25 + number(6) as f64 / 4.0;
            let found = stretches(&along, &other, reach);
            let length = along.length();
            for sample in 1..100 {
                let place = length * f64::from(sample) / 100.0;
                let distance = other.distance_to(along.at(place));
                let is_found = found.iter().any(|(from, to)| *from < place && place < *to);
                let is_clear = (distance - reach).abs() > 1e-9;
                assert!(!is_clear || is_found == (distance < reach), "{round}: {along:?} {other:?} {place}");
            }
        }
    }
}
