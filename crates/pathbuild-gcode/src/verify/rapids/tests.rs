//! Tests that the grid is never lower than the obstacles.

use pathbuild_motion::{Move, MoveShape, Pace, Position};

use super::{CELLS_PER_SIDE, CutGrid};

/// The sides in X and Y of an obstacle of 1 mm by 1 mm, 9 mm high, far from the origin.
const OBSTACLE: [(f64, f64); 2] = [(130.0, 131.0), (-20.0, -19.0)];

fn rapid([x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) -> Move {
    let [from, to] = [Position::known(x, y, 1.0), Position::known(to_x, to_y, 1.0)];
    Move { from, to, shape: MoveShape::Line, pace: Pace::Rapid, named: None }
}

/// Checks moves in all directions that pass the obstacle on either side.
#[test]
fn what_stands_within_the_radius_of_a_move_is_seen() {
    let mut tops = CutGrid {
        corner: [100.0, -40.0],
        cell: [1.0, 0.5],
        heights: vec![f64::NEG_INFINITY; CELLS_PER_SIDE * CELLS_PER_SIDE],
    };
    tops.raise(OBSTACLE, 9.0);
    for step in 0..48 {
        let (sin, cos) = libm::sincos(f64::from(step) * std::f64::consts::TAU / 48.0);
        let at =
            |along: f64, aside: f64| [130.5 + along * cos - aside * sin, -19.5 + along * sin + aside * cos];
        let along = |aside: f64| tops.highest_along(&rapid(at(-9.0, aside), at(7.0, aside)), 3.0);
        assert_eq!([along(-2.9), along(0.0), along(2.9)], [9.0; 3], "{step}");
        assert_eq!(along(9.0), f64::NEG_INFINITY, "{step}: far beside it");
        assert_eq!(
            tops.highest_along(&rapid(at(9.0, 0.0), at(14.0, 0.0)), 3.0),
            f64::NEG_INFINITY,
            "{step}: past it"
        );
    }
}
