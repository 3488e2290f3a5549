//! Equality of moves, and of the lines that they follow.

use std::collections::HashMap;

use pathbuild_motion::{Axes, Path, Position};

use crate::scene::{Move, MoveKind, Point};

/// Everything that a move does, in µm and µm/min, which hides differences from printing numbers.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct MoveIdentity {
    kind: MoveKind,
    ends: [[Option<i64>; 3]; 2],
    arc: Option<Turn>,
    feed: Option<i64>,
}

/// An arc without its end points.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Turn {
    axes: [usize; 2],
    centre: [i64; 2],
    is_clockwise: bool,
    extra_turns: u32,
}

impl MoveIdentity {
    /// The identity of a move, relative to a point in the plane.
    pub(super) fn of(movement: &Move, origin: Point) -> Self {
        let shift = |axis: usize| origin.get(axis).copied().unwrap_or_default();
        let end =
            |end: &Position| [0, 1, 2].map(|axis| known(end, axis).map(|at| micrometres(at - shift(axis))));
        // A rapid move is identified by its end only: it starts where the previous move ends, which is unknown at the beginning of a
        // program.
        let (kind, from) = if is_rapid(movement) {
            (MoveKind::Sweep, [None; 3])
        } else {
            (movement.kind, end(&movement.way.from))
        };
        let arc = match movement.way.path {
            Path::Line => None,
            Path::Arc(arc) => {
                let axes = arc.plane.axes();
                let centre = [0, 1].map(|index| micrometres(arc.centre[index] - shift(axes[index])));
                let (is_clockwise, extra_turns) = (arc.clockwise, arc.extra_turns);
                Some(Turn { axes, centre, is_clockwise, extra_turns })
            }
        };
        Self {
            kind,
            ends: [from, end(&movement.way.to)],
            arc,
            feed: movement.way.pace.feed().map(micrometres),
        }
    }
}

/// The line of a move in the plane, regardless of direction and height.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Line {
    kind: MoveKind,
    ends: [[i64; 2]; 2],
    centre: Option<[i64; 2]>,
    /// Distinguishes the two arcs with these ends and this centre: whether it runs clockwise from the first end.
    is_clockwise: bool,
}

impl Line {
    pub(super) fn of(movement: &Move) -> Self {
        let drawn = [movement.from(), movement.to()].map(|end| end.map(micrometres));
        let mut ends = drawn;
        ends.sort_unstable();
        let (centre, is_clockwise) = match movement.way.path {
            Path::Line => (None, false),
            Path::Arc(arc) => (Some(arc.centre.map(micrometres)), arc.clockwise == (drawn == ends)),
        };
        Self { kind: movement.kind, ends, centre, is_clockwise }
    }
}

/// The result of milling along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MillingResult {
    /// The lowest Z in mm.
    pub(super) bottom: f64,
    /// The feed of the deepest pass in mm/min.
    pub(super) feed: f64,
    /// The number of passes.
    pub(super) passes: u32,
}

/// The result of milling along each line of a program. Rapid moves are ignored.
pub(super) fn lines(moves: &[Move]) -> HashMap<Line, MillingResult> {
    let mut lines: HashMap<Line, MillingResult> = HashMap::new();
    for movement in moves.iter().filter(|movement| !is_rapid(movement)) {
        let (bottom, feed) =
            (movement.depth().unwrap_or_default(), movement.way.pace.feed().unwrap_or_default());
        let milled = lines.entry(Line::of(movement)).or_insert(MillingResult { bottom, feed, passes: 0 });
        milled.passes += 1;
        if bottom < milled.bottom {
            (milled.bottom, milled.feed) = (bottom, feed);
        }
    }
    lines
}

/// Whether a move is rapid, in any direction.
pub(super) fn is_rapid(movement: &Move) -> bool {
    matches!(movement.kind, MoveKind::Sweep | MoveKind::Lift)
}

fn known(end: &Position, axis: usize) -> Option<f64> {
    end.known.has(Axes::of(axis)).then(|| end.at[axis])
}

#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn micrometres(value: f64) -> i64 {
    (value * 1000.0).round() as i64
}
