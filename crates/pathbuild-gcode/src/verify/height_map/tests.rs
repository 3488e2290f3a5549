//! Tests which cells a cutter covers along a move.

use super::Capsule;

fn distance([from, to]: [[f64; 2]; 2], [x, y]: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let share = ((x - from[0]) * along[0] + (y - from[1]) * along[1]) / square;
    let share = if square > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(x - from[0] - share * along[0], y - from[1] - share * along[1])
}

/// Checks in all directions that both ends of each row are at a distance of one radius from the segment, and that points beyond them are farther.
#[test]
fn rows_of_a_capsule_reach_as_far_as_its_radius() {
    const RADIUS: f64 = 1.5;
    for to in [[7.0, 0.0], [0.0, 7.0], [5.0, 3.0], [-3.0, 6.0], [4.0, -4.5], [-6.0, -1.0], [0.0, 0.0]] {
        let segment = [[0.0, 0.0], to].map(|[x, y]| [x + 20.0, y - 30.0]);
        let capsule = Capsule::new(segment[0], segment[1], RADIUS);
        let (low, high) = capsule.rows();
        assert_eq!([low, high], [to[1].min(0.0) - RADIUS - 30.0, to[1].max(0.0) + RADIUS - 30.0]);
        for part in 1..40 {
            let y = low + (high - low) * f64::from(part) / 40.0;
            let (left, right) = capsule.row(y).expect("it is between the lowest and the highest");
            for (x, outside) in [(left, left - 0.01), (right, right + 0.01)] {
                assert!((distance(segment, [x, y]) - RADIUS).abs() < 1e-9, "{to:?} {y}: {x}");
                assert!(distance(segment, [outside, y]) > RADIUS, "{to:?} {y}: {outside}");
            }
        }
        assert_eq!([capsule.row(low - 0.01), capsule.row(high + 0.01)], [None; 2], "{to:?}");
    }
}
