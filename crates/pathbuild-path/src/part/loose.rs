//! Determines whether cuts form a closed ring around a part. (book: language/part)

use std::cell::LazyCell;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

use super::cuts::StandingBar;
use super::intervals::offset_curve;
use super::prepared::PreparedPart;
use crate::boxes::{BoxIndex, may_be_near, square, widened_box};
use crate::geometry::{Curve, Line, Xy};

/// Largest distance in mm between an arc and the chords that replace it.
const MAX_SAGITTA: f64 = 0.02;

/// Width in mm up to which material between two cuts holds nothing.
pub const MAX_WEAK_BRIDGE: f64 = 0.1;

/// The area that a cutter covers while it moves in a straight line.
#[derive(Clone, Copy)]
struct SweptLine {
    line: Line,
    radius: f64,
}

/// Whether the through cuts, each with its cutter radius, enclose a part. `bars` are the bars near the part, each with its cutter radius.
pub(super) fn is_cut_out<'b>(
    part: &PreparedPart<'_>,
    cuts: &[(Curve, f64)],
    bars: &(impl Iterator<Item = (&'b StandingBar, f64)> + Clone),
) -> bool {
    let beside = || {
        let beside = bars.clone().flat_map(|(bar, radius)| points_beside_bar(bar, radius));
        beside.filter(|(at, _)| part.is_material(*at))
    };
    // For most bars a cheap test suffices: a straight line across the bar meets no cut.
    if beside().any(|(at, bar)| leads_straight_out(at, bar, cuts)) {
        return false;
    }
    let sweeps = swept_by(cuts);
    if beside().any(|(at, _)| can_escape(at, &sweeps)) {
        return false;
    }
    let boxes = BoxIndex::new(cuts.iter().map(|(curve, radius)| widened_box(curve, *radius)));
    let Some(centre) = point_in_material(part, cuts, &boxes) else { return false };
    is_in_ring(centre, &sweeps)
}

/// Whether through cuts, each with its cutter radius, close a ring round a point that none of them covers.
pub(super) fn is_enclosed(at: Xy, cuts: &[(Curve, f64)]) -> bool {
    is_in_ring(at, &swept_by(cuts))
}

/// Returns the index of the first through cut beside which the cuts, each with its cutter radius, close a ring round material.
pub(crate) fn first_enclosing(cuts: &[(Curve, f64)]) -> Option<usize> {
    let sweeps = swept_by(cuts);
    let points = || (0..).zip(cuts).flat_map(|(cut, (curve, radius))| points_beside_cut(cut, curve, *radius));
    let is_removed = |at: Xy| cuts.iter().any(|(curve, radius)| curve.distance_to(at) < *radius);
    let contacts = LazyCell::new(|| contacts(&sweeps));
    let is_enclosed = |at: Xy| !can_escape(at, &sweeps) && is_ring_closed(at, &sweeps, &contacts);
    let step = points().count() * sweeps.len() / MAX_TESTED_SWEEPS + 1;
    points().step_by(step).find(|(_, at)| !is_removed(*at) && is_enclosed(*at)).map(|(cut, _)| cut)
}

/// Upper bound on the sweeps that are tested for all points beside cuts together. Among more cuts, only some of the points are tested.
const MAX_TESTED_SWEEPS: usize = 300_000;

/// Distance in mm between the points beside a cut; more for a cut so long that it would have more than [`MAX_POINTS`] on each side.
const POINT_DISTANCE: f64 = 5.0;

/// Maximum number of points on each side of a cut.
const MAX_POINTS: f64 = 200.0;

/// Returns points on both sides of a cut just beyond its edge, each with the number of the cut.
fn points_beside_cut(cut: usize, curve: &Curve, radius: f64) -> impl Iterator<Item = (usize, Xy)> {
    let away = radius + MAX_WEAK_BRIDGE;
    [away, -away].into_iter().filter_map(|away| offset_curve(curve, away)).flat_map(move |beside| {
        let length = beside.length();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small number from 1 up"
        )]
        let count = (length / POINT_DISTANCE).ceil().clamp(1.0, MAX_POINTS) as u32;
        let along = move |number: u32| length * (f64::from(number) + 0.5) / f64::from(count);
        (0..count).map(move |number| (cut, beside.at(along(number))))
    })
}

fn is_in_ring(at: Xy, sweeps: &[SweptLine]) -> bool {
    !can_escape(at, sweeps) && is_ring_closed(at, sweeps, &contacts(sweeps))
}

/// Whether cuts, each with its cutter radius, close a ring round a part.
pub(super) fn is_surrounded(part: &PreparedPart<'_>, cuts: &[(Curve, f64)]) -> bool {
    is_cut_out(part, cuts, &std::iter::empty())
}

/// Returns the points on both sides of a bar where the part may begin, each with the middle of the bar.
fn points_beside_bar(bar: &StandingBar, radius: f64) -> impl Iterator<Item = (Xy, Xy)> {
    bar.middle.into_iter().flat_map(move |middle| {
        let aside = [radius, -radius]
            .into_iter()
            .filter_map(move |radius| offset_curve(&middle, radius * BESIDE_BAR_RADII));
        aside.map(move |curve| (curve.middle(), middle.middle()))
    })
}

/// Distance in cutter radii between a bar's centre line and the part: just beyond the edge of the cut that the bar interrupts.
const BESIDE_BAR_RADII: f64 = 1.01;

/// Whether the straight line from a point beside a bar across the bar's middle meets no cut.
fn leads_straight_out(at: Xy, bar: Xy, cuts: &[(Curve, f64)]) -> bool {
    let Some(direction) = (bar - at).try_normalize(0.0) else { return false };
    let farthest = |curve: &Curve| (curve.start() - at).norm() + curve.length();
    let reach = cuts.iter().map(|(curve, radius)| farthest(curve) + radius).fold(0.0, f64::max);
    let way = Curve::Line(Line { start: at, end: at + direction * reach });
    let meets = |(curve, radius): &(Curve, f64)| {
        let radius = bridged_radius(*radius);
        may_be_near(curve, &way, radius) && curve.distance(&way) <= radius
    };
    !cuts.iter().any(meets)
}

/// Whether a straight line leads from a point to the border of the plate without meeting a cut.
fn can_escape(at: Xy, sweeps: &[SweptLine]) -> bool {
    let Some(mut hidden) = sweeps.iter().map(|sweep| sweep.angles_seen_from(at)).collect::<Option<Vec<_>>>()
    else {
        return false;
    };
    // A range that reaches beyond pi also hides directions from -pi on.
    let beyond = hidden.iter().filter(|(_, to)| *to > PI).map(|(from, to)| (from - TAU, to - TAU));
    hidden.extend(beyond.collect::<Vec<_>>());
    hidden.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
    let mut end = -PI;
    for (from, to) in hidden {
        if from > end {
            return true;
        }
        end = end.max(to);
    }
    end < PI
}

/// Two sweeps that overlap, by their numbers, and their points that are nearest to each other.
struct Contact {
    sweeps: [usize; 2],
    points: [Xy; 2],
}

fn contacts(sweeps: &[SweptLine]) -> Vec<Contact> {
    let boxes = BoxIndex::new(sweeps.iter().map(|sweep| widened_box(&Curve::Line(sweep.line), sweep.radius)));
    let mut contacts = Vec::new();
    for (number, sweep) in sweeps.iter().enumerate() {
        for other in boxes.near(widened_box(&Curve::Line(sweep.line), sweep.radius)) {
            if other <= number {
                continue;
            }
            let met = &sweeps[other];
            let (here, there) = nearest_points(&sweep.line, &met.line);
            if (there - here).norm() <= sweep.radius + met.radius - MIN_OVERLAP {
                contacts.push(Contact { sweeps: [number, other], points: [here, there] });
            }
        }
    }
    contacts
}

/// Whether sweeps close a ring around a point that none of them covers.
///
/// Groups overlapping sweeps by union-find. Each sweep stores its angle around the point relative to its parent. If two sweeps of one group overlap
/// at an angle that differs from the stored one, they close a ring.
fn is_ring_closed(centre: Xy, sweeps: &[SweptLine], contacts: &[Contact]) -> bool {
    let mut groups = SweepGroups { parents: (0..sweeps.len()).collect(), angles: vec![0.0; sweeps.len()] };
    contacts.iter().any(|Contact { sweeps: [one, other], points: [here, there] }| {
        let way = [sweeps[*one].line.start, *here, *there, sweeps[*other].line.start];
        let angle = way.windows(2).map(|step| angle_between(centre, step[0], step[1])).sum();
        groups.unite(*one, *other, angle)
    })
}

/// Minimum overlap in mm of two sweeps that are considered connected.
const MIN_OVERLAP: f64 = 1e-6;

/// Returns the angle from one point to another as seen from `centre`, from -pi to pi.
fn angle_between(centre: Xy, from: Xy, to: Xy) -> f64 {
    let (from, to) = (from - centre, to - centre);
    libm::atan2(from.perp(&to), from.dot(&to))
}

impl SweptLine {
    /// Returns the range of directions in which the sweep is seen from a point. It begins between -pi and pi, and may be a little larger than needed.
    /// `None` if the sweep covers the point.
    fn angles_seen_from(&self, at: Xy) -> Option<(f64, f64)> {
        let radius = self.radius + MAX_SAGITTA;
        if Curve::Line(self.line).distance_to(at) <= radius {
            return None;
        }
        let width = |end: Xy| libm::asin((radius / (end - at).norm()).min(1.0));
        let (start, end) = (width(self.line.start), width(self.line.end));
        let out = self.line.start - at;
        let direction = libm::atan2(out.y, out.x);
        let turn = angle_between(at, self.line.start, self.line.end);
        let (from, to) = (direction + (-start).min(turn - end), direction + start.max(turn + end));
        let whole = if from < -PI { TAU } else { 0.0 };
        Some((from + whole, to + whole))
    }
}

/// Union-find of sweeps that overlap, directly or through others.
struct SweepGroups {
    parents: Vec<usize>,
    /// The angle by which each sweep is ahead of its parent.
    angles: Vec<f64>,
}

impl SweepGroups {
    /// Unites two sweeps; `angle` is the angle by which the second is ahead of the first. Returns whether that closes a ring.
    fn unite(&mut self, one: usize, other: usize, angle: f64) -> bool {
        let ((root, ahead), (other_root, other_ahead)) = (self.root(one), self.root(other));
        let difference = ahead + angle - other_ahead;
        if root == other_root {
            return difference.abs() > PI;
        }
        self.parents[other_root] = root;
        self.angles[other_root] = difference;
        false
    }

    fn root(&mut self, sweep: usize) -> (usize, f64) {
        let mut way = Vec::new();
        let mut root = sweep;
        while self.parents[root] != root {
            way.push(root);
            root = self.parents[root];
        }
        let mut angle = 0.0;
        for step in way.into_iter().rev() {
            angle += self.angles[step];
            self.angles[step] = angle;
            self.parents[step] = root;
        }
        (root, angle)
    }
}

/// Returns a point of the part near its edge that no cut covers.
fn point_in_material(part: &PreparedPart<'_>, cuts: &[(Curve, f64)], boxes: &BoxIndex) -> Option<Xy> {
    let mut curves: Vec<&Curve> = part.part.rings[0].curves.iter().collect();
    curves.sort_by(|one, other| other.length().total_cmp(&one.length()));
    let is_free = |at: Xy| {
        let mut over = boxes.near(square(at, 0.0)).map(|number| &cuts[number]);
        part.is_material(at) && !over.any(|(curve, radius)| curve.distance_to(at) < *radius)
    };
    let depths = [0.001, 0.05, 0.3, 1.0, 3.0];
    depths.into_iter().find_map(|depth| {
        curves.iter().take(6).find_map(|curve| {
            let inside = offset_curve(curve, -depth)?;
            Some(inside.middle()).filter(|at| is_free(*at))
        })
    })
}

fn swept_by(cuts: &[(Curve, f64)]) -> Vec<SweptLine> {
    cuts.iter().flat_map(|(curve, radius)| swept_lines(curve, bridged_radius(*radius))).collect()
}

/// Returns the radius in mm of a cutter that also takes away half of a weak bridge on each side.
fn bridged_radius(radius: f64) -> f64 {
    radius + MAX_WEAK_BRIDGE / 2.0
}

fn swept_lines(curve: &Curve, radius: f64) -> Vec<SweptLine> {
    let Curve::Arc(arc) = curve else {
        let line = Line { start: curve.start(), end: curve.end() };
        return vec![SweptLine { line, radius }];
    };
    let step = 2.0 * libm::acos((1.0 - MAX_SAGITTA / arc.radius).clamp(-1.0, 1.0)).min(FRAC_PI_4);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small number from 1 up")]
    let count = (arc.degrees.to_radians() / step).ceil().max(1.0) as u32;
    let length = arc.length();
    let place = |number: u32| curve.at(length * f64::from(number) / f64::from(count));
    (0..count)
        .map(|number| SweptLine { line: Line { start: place(number), end: place(number + 1) }, radius })
        .collect()
}

fn nearest_points(one: &Line, other: &Line) -> (Xy, Xy) {
    if one.crosses(other) {
        let (along, across) = (one.end - one.start, other.end - other.start);
        let share = (other.start - one.start).perp(&across) / along.perp(&across);
        let crossing = one.start + along * share;
        return (crossing, crossing);
    }
    let pairs = [
        (one.start, other.nearest(one.start)),
        (one.end, other.nearest(one.end)),
        (one.nearest(other.start), other.start),
        (one.nearest(other.end), other.end),
    ];
    let distance = |pair: &(Xy, Xy)| (pair.1 - pair.0).norm_squared();
    pairs.into_iter().fold(pairs[0], |best, next| if distance(&next) < distance(&best) { next } else { best })
}
