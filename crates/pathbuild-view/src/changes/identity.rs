//! When two moves are the same.

use pathbuild_gcode::interpret::{Axes, Path, Position};

use super::super::scene::{Move, MoveKind};

/// What a move does in the plane, in µm. Two programs that were printed differ by less.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Trail {
    kind: MoveKind,
    ends: [[Option<i64>; 2]; 2],
    arc: Option<Turn>,
}

/// An arc without its ends.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Turn {
    axes: [usize; 2],
    centre: [i64; 2],
    is_clockwise: bool,
    extra_turns: u32,
}

/// All that a move does: where, how deep in µm, and how fast in µm/min.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Deed {
    trail: Trail,
    heights: [Option<i64>; 2],
    feed: Option<i64>,
}

impl Trail {
    /// That of a move which begins at (`origin`) of another program.
    pub(super) fn of(it: &Move, origin: [f64; 2]) -> Self {
        let arc = match it.way.path {
            Path::Line => None,
            Path::Arc(arc) => {
                let axes = arc.plane.axes();
                let at =
                    |index: usize| arc.centre[index] - origin.get(axes[index]).copied().unwrap_or_default();
                Some(Turn {
                    axes,
                    centre: [at(0), at(1)].map(micrometres),
                    is_clockwise: arc.clockwise,
                    extra_turns: arc.extra_turns,
                })
            }
        };
        let plane = |end: &Position| {
            [0, 1].map(|axis| known(end, axis).map(|value| micrometres(value - origin[axis])))
        };
        Self { kind: it.kind, ends: [&it.way.from, &it.way.to].map(plane), arc }
    }
}

impl Deed {
    pub(super) fn of(it: &Move, origin: [f64; 2]) -> Self {
        let height = |end: &Position| known(end, 2).map(micrometres);
        Self {
            trail: Trail::of(it, origin),
            heights: [&it.way.from, &it.way.to].map(height),
            feed: it.way.pace.feed().map(micrometres),
        }
    }
}

fn known(end: &Position, axis: usize) -> Option<f64> {
    end.known.has(Axes::of(axis)).then(|| end.at[axis])
}

#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn micrometres(value: f64) -> i64 {
    (value * 1000.0).round() as i64
}
