//! Divides cuts where other cuts end on them, so that two programs can be compared piece by piece, however their moves are divided.

use std::collections::HashMap;
use std::f64::consts::TAU;

use pathbuild_motion::{Move, MoveShape, Plane, Position};

use super::is_rapid;
use crate::scene::{Point, SceneMove};

/// Distance in mm up to which two ends are the same. Coordinates in programs are rounded to three or four decimals, so the same end may differ by 1
/// µm; a difference of 2 µm is intended.
pub(super) const END_TOLERANCE: f64 = 0.0011;

/// Distance in mm up to which two points between ends are the same. The centre of an arc is the sum of two rounded numbers, and the far side of a
/// circle moves twice as far as its centre.
pub(super) const CURVE_TOLERANCE: f64 = 3.0 * END_TOLERANCE;

/// Maximum number of pieces that dividing adds to the moves of two programs. Beyond it, moves stay whole, so that many long moves on top of each
/// other take no more time and memory than others.
const MAX_ADDITIONAL_PIECES: usize = 1_000_000;

/// Maximum number of steps along moves, and of points near them, examined to find the ends of cuts on moves. Beyond it, moves stay whole.
const MAX_SEARCHED: usize = 20_000_000;

/// Assigns the same number to points that are the same within a tolerance.
#[derive(Debug)]
pub(super) struct Snapper {
    tolerance: f64,
    points: Vec<[f64; 3]>,
    cells: HashMap<[i64; 3], Vec<u32>>,
}

impl Snapper {
    pub(super) fn new(tolerance: f64) -> Self {
        Self { tolerance, points: Vec::new(), cells: HashMap::new() }
    }

    /// Returns the number of a point: that of an earlier point within the tolerance, or a new one.
    pub(super) fn number(&mut self, point: [f64; 3]) -> u32 {
        let cell = |offset: f64| point.map(|at| floor((at + offset) / (8.0 * self.tolerance)));
        let [low, high] = [cell(-self.tolerance), cell(self.tolerance)];
        let is_near = |number: &&u32| {
            let known = self.points[**number as usize];
            (0..3).all(|axis| (known[axis] - point[axis]).abs() <= self.tolerance)
        };
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let numbers = self.cells.get(&[x, y, z]).into_iter().flatten();
                    if let Some(number) = numbers.copied().find(|number| is_near(&number)) {
                        return number;
                    }
                }
            }
        }
        let number = u32::try_from(self.points.len()).unwrap_or(u32::MAX);
        self.points.push(point);
        self.cells.entry(cell(0.0)).or_default().push(number);
        number
    }
}

/// Divides cuts at given points.
#[derive(Debug)]
pub(super) struct Divider {
    points: Vec<Point>,
    cells: HashMap<[i64; 2], Vec<u32>>,
    cell_size: f64,
    additional: usize,
    searched: usize,
    /// Whether a limit was exceeded; all further moves stay whole.
    is_exhausted: bool,
}

impl Divider {
    /// Creates a divider at the ends of some cuts.
    pub(super) fn new<'m>(cuts: impl Iterator<Item = &'m SceneMove>) -> Self {
        let mut snapper = Snapper::new(END_TOLERANCE);
        for movement in cuts.filter(|movement| !is_rapid(movement) && movement.is_placed()) {
            for [x, y] in [movement.from(), movement.to()] {
                if x.is_finite() && y.is_finite() {
                    snapper.number([x, y, 0.0]);
                }
            }
        }
        let points: Vec<Point> = snapper.points.iter().map(|[x, y, _]| [*x, *y]).collect();
        let extent = |axis: usize| {
            let (low, high) = points.iter().fold((f64::MAX, f64::MIN), |(low, high), point| {
                (low.min(point[axis]), high.max(point[axis]))
            });
            (high - low).max(0.0)
        };
        // With as many cells as points, a cell has one point on average, and a long move crosses few cells.
        let cell_size =
            (extent(0).max(extent(1)) / (points.len().max(1) as f64).sqrt()).max(10.0 * END_TOLERANCE);
        let mut cells: HashMap<[i64; 2], Vec<u32>> = HashMap::new();
        for (number, point) in (0..).zip(&points) {
            cells.entry(point.map(|at| floor(at / cell_size))).or_default().push(number);
        }
        Self { points, cells, cell_size, additional: 0, searched: 0, is_exhausted: false }
    }

    /// Whether a limit was exceeded, so that all further moves stay whole.
    pub(super) fn is_exhausted(&self) -> bool {
        self.is_exhausted
    }

    /// Resets the counters that are compared with the limits. Moves whose first division stayed within the limits can then be divided again, with
    /// the same result.
    pub(super) fn restart(&mut self) {
        (self.additional, self.searched) = (0, 0);
    }

    /// Returns the pieces of a move, in its direction. Rapid moves, vertical moves, and arcs in other planes than XY stay whole.
    pub(super) fn divide(&mut self, movement: &SceneMove) -> Vec<SceneMove> {
        let way = &movement.way;
        let is_divisible = !self.is_exhausted
            && !is_rapid(movement)
            && way.is_known()
            && way.named.is_none()
            && way.is_finite()
            && !way.is_vertical()
            && matches!(
                way.shape,
                MoveShape::Line | MoveShape::Arc(pathbuild_motion::Arc { plane: Plane::Xy, .. })
            );
        let cuts = if is_divisible { self.division_points(way) } else { Vec::new() };
        self.is_exhausted |=
            self.searched > MAX_SEARCHED || self.additional + cuts.len() > MAX_ADDITIONAL_PIECES;
        if cuts.is_empty() || self.is_exhausted {
            return vec![movement.clone()];
        }
        self.additional += cuts.len();
        let mut from = way.from;
        let ends =
            cuts.into_iter().map(|(share, [x, y])| Position { at: [x, y, way.point(share)[2]], ..way.to });
        let ways = ends.chain([way.to]).map(|to| {
            let piece = Move { from, to, shape: single_turn(way.shape), ..*way };
            from = to;
            piece
        });
        ways.map(|way| SceneMove { way, length: way.length(), ..movement.clone() }).collect()
    }

    /// Returns the points strictly within a move, each with the fraction of the move that precedes it, in the order of the move.
    fn division_points(&mut self, way: &Move) -> Vec<(f64, Point)> {
        let mut cuts: Vec<(f64, Point)> = Vec::new();
        let near = self.near(way);
        for number in near {
            let point = self.points[number as usize];
            let is_on_way = |share: &f64| {
                let [x, y, _] = way.point(*share);
                libm::hypot(x - point[0], y - point[1]) <= CURVE_TOLERANCE
            };
            let remaining = MAX_ADDITIONAL_PIECES.saturating_sub(self.additional + cuts.len());
            cuts.extend(
                fractions_nearest_to(way, point)
                    .take(remaining + 1)
                    .filter(is_on_way)
                    .map(|share| (share, point)),
            );
        }
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        cuts
    }

    /// Returns the points in the cells that a move crosses, each once.
    fn near(&mut self, way: &Move) -> Vec<u32> {
        let course = way.course();
        let (length, turn) = match &course {
            None => (libm::hypot(way.to.x() - way.from.x(), way.to.y() - way.from.y()), 1.0),
            Some(course) => {
                let turn = (TAU / course.sweep()).min(1.0);
                (course.length_in_plane() * turn, turn)
            }
        };
        let count = (length / self.cell_size).ceil().clamp(if course.is_some() { 8.0 } else { 1.0 }, 65536.0);
        let point = |step: f64| {
            let share = turn * step / count;
            let [x, y, _] = course.as_ref().map_or_else(|| way.point(share), |course| course.point(share));
            [x, y]
        };
        let (mut near, mut step, mut from) = (Vec::new(), 0.0, point(0.0));
        while step < count {
            step += 1.0;
            self.searched += 1;
            let to = point(step);
            // An eighth of a circle deviates from its chord by at most a tenth of the chord's length.
            let margin = CURVE_TOLERANCE + 0.1 * libm::hypot(to[0] - from[0], to[1] - from[1]);
            let cell = |at: f64| floor(at / self.cell_size);
            let [xs, ys] = [0, 1].map(|axis| {
                cell(from[axis].min(to[axis]) - margin)..=cell(from[axis].max(to[axis]) + margin)
            });
            for x in xs {
                for y in ys.clone() {
                    near.extend(self.cells.get(&[x, y]).into_iter().flatten());
                }
            }
            from = to;
        }
        self.searched += near.len();
        near.sort_unstable();
        near.dedup();
        near
    }
}

/// Returns the fractions of a move, strictly between its ends, at which it passes the point of its line or circle that is nearest to a point.
fn fractions_nearest_to(way: &Move, point: Point) -> impl Iterator<Item = f64> + use<> {
    let (first, period, length) = if let (Some(course), MoveShape::Arc(arc)) = (way.course(), way.shape) {
        let ahead = arc.angle_ahead(&way.from.at, &[point[0], point[1], 0.0]);
        let sweep = course.sweep();
        ((ahead + if ahead < 0.0 { TAU } else { 0.0 }) / sweep, TAU / sweep, course.length_in_plane())
    } else {
        let [x, y] = [0, 1].map(|axis| way.to.at[axis] - way.from.at[axis]);
        let length = libm::hypot(x, y);
        let along = (point[0] - way.from.x()) * x + (point[1] - way.from.y()) * y;
        (along / (length * length), f64::INFINITY, length)
    };
    let margin = END_TOLERANCE / length;
    let times = std::iter::successors(Some(first), move |share| Some(share + period));
    times.take_while(move |share| *share < 1.0 - margin).filter(move |share| *share > margin)
}

/// Returns the shape of a piece of a move. A piece makes at most one full turn.
fn single_turn(shape: MoveShape) -> MoveShape {
    match shape {
        MoveShape::Arc(arc) => MoveShape::Arc(pathbuild_motion::Arc { extra_turns: 0, ..arc }),
        MoveShape::Line => MoveShape::Line,
    }
}

#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn floor(value: f64) -> i64 {
    value.floor() as i64
}

#[cfg(test)]
mod tests {
    use super::super::tests::moves;
    use super::{Divider, MAX_ADDITIONAL_PIECES, MAX_SEARCHED};

    /// Divides a cut on which two others end, with counters that have these values before. Returns the number of its pieces, and the divider.
    fn divide(additional: usize, searched: usize) -> (usize, Divider) {
        let cuts = "G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F150\nG1 X10\nG1 X20\nG1 X30\nG1 X0\n";
        let moves = moves(cuts);
        let mut divider = Divider { additional, searched, ..Divider::new(moves.iter()) };
        (divider.divide(moves.last().unwrap()).len(), divider)
    }

    #[test]
    fn beyond_a_limit_moves_stay_whole() {
        let (pieces, divider) = divide(0, 0);
        assert_eq!((pieces, divider.is_exhausted(), divider.additional), (3, false, 2));
        let searched = MAX_SEARCHED - divider.searched;
        let outcome = |(pieces, divider): (usize, Divider)| (pieces, divider.is_exhausted());
        assert_eq!(outcome(divide(MAX_ADDITIONAL_PIECES - 2, searched)), (3, false));
        assert_eq!(outcome(divide(MAX_ADDITIONAL_PIECES - 1, 0)), (1, true));
        assert_eq!(outcome(divide(0, searched + 1)), (1, true));
    }
}
