//! The number of ends examined, and the search distance.

use nalgebra::Vector2;
use proptest::prelude::*;

use super::{Ends, Squares};
use crate::approx::coincide;
use crate::geometry::Xy;

/// The number of ends examined when each end is queried for its neighbours.
fn looked_at(points: &[Xy]) -> usize {
    let ends = Ends::of_segments(points.iter().map(|point| [*point; 2]));
    let mut count = 0;
    for point in points {
        for square in Squares::around(*point).each() {
            ends.each_in(square, |_, _| count += 1);
        }
    }
    count
}

/// Points in a grid in a tiny part of a mm, none of which coincide.
fn crowd(side: u32) -> Vec<Xy> {
    const APART: f64 = 0.000_04;
    let at = |number: u32| APART * f64::from(number);
    let point = |number: u32| Xy::new(at(number % side), at(number / side));
    let points: Vec<Xy> = (0..side * side).map(point).collect();
    assert!(!coincide(points[0], points[1]));
    points
}

/// Four times as many points in four times the area, all within a thousandth of a mm² or less.
#[test]
fn ends_that_lie_close_but_do_not_meet_are_not_looked_at() {
    let (one, four) = (looked_at(&crowd(50)), looked_at(&crowd(100)));
    assert!(four <= 5 * one, "{one}, {four}");
    assert!(one <= 100 * 2500, "{one}");
}

/// A point, and another one at this distance in a random direction.
fn apart(distance: f64) -> impl Strategy<Value = [Xy; 2]> {
    let coordinate =
        || prop_oneof![-0.01..0.01, -9000.0..9000.0, (-90..90).prop_map(|tenths| f64::from(tenths) / 10.0)];
    (coordinate(), coordinate(), 0.0..360.0_f64).prop_map(move |(x, y, angle)| {
        let direction = Vector2::new(libm::cos(angle.to_radians()), libm::sin(angle.to_radians()));
        [Xy::new(x, y), Xy::new(x, y) + direction * distance]
    })
}

/// Approximate distance in mm below which points coincide.
const MEETING: f64 = 0.000_031_6;

fn ends([one, other]: [Xy; 2]) -> Ends {
    Ends::of_segments([[one; 2], [other; 2]].into_iter())
}

fn found(points: [Xy; 2]) -> Vec<usize> {
    let mut found = Vec::new();
    ends(points).find_near(points[0], |_| true, &mut found);
    found.sort_unstable();
    found.dedup();
    found
}

fn is_alone(points: [Xy; 2]) -> bool {
    ends(points).crowd(points[0], |_| true).is_some_and(|crowd| crowd.segments == [0])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn ends_that_meet_are_found_whatever_square_they_are_in(
        inside in apart(0.999 * MEETING),
        outside in apart(1.003 * MEETING),
    ) {
        prop_assert_eq!(found(inside), [0, 1]);
        prop_assert_eq!(found(outside), [0]);
    }

    #[test]
    fn who_may_meet_a_third_at_a_point_is_seen(
        inside in apart(2.99 * MEETING),
        outside in apart(3.01 * MEETING),
    ) {
        prop_assert!(!is_alone(inside));
        prop_assert!(is_alone(outside));
    }
}
