//! The moves of a program that was never text.

use std::f64::consts::PI;

use pathbuild_motion::{Arc, Move, Pace, Path, Plane, Position};
use pathbuild_toolpath as toolpath;
use pathbuild_toolpath::{Program, Xy};

use crate::native::{is_doubtful, is_point};

/// The moves of a program as an interpreter of its native text would see them, from (0, 0, S0) to the last lift to S0; each with the
/// number of its step, from 1, in place of a line.
pub fn moves_of(program: &Program) -> Vec<(u32, Move)> {
    let mut moves = Vec::with_capacity(program.steps.len() + 1);
    moves.extend(each_move_of(program));
    moves
}

/// The same one by one.
pub fn each_move_of(program: &Program) -> impl Iterator<Item = (u32, Move)> {
    let height = program.start_height();
    let mut tool = Tool { position: Position::known(0.0, 0.0, height) };
    let last = u32::try_from(program.steps.len()).unwrap_or(u32::MAX).saturating_add(1);
    let steps = (1_u32..).zip(program.steps.iter().map(Some)).chain(std::iter::once((last, None)));
    steps.filter_map(move |(number, step)| match step {
        Some(toolpath::Step::Move { to, count }) => Some((number, tool.go(to, count.length))),
        Some(toolpath::Step::Comment(_)) => None,
        None => Some((number, tool.straight(tool.at(None, height), Pace::Rapid))),
    })
}

struct Tool {
    position: Position,
}

impl Tool {
    /// Makes a move that the statistics count with this length, in mm.
    fn go(&mut self, to: &toolpath::Move, length: f64) -> Move {
        match *to {
            toolpath::Move::Sweep { to } => self.straight(self.at(Some(to), self.position.z()), Pace::Rapid),
            toolpath::Move::Lift { z } => self.straight(self.at(None, z.z), Pace::Rapid),
            toolpath::Move::Drill { feed, z } => self.straight(self.at(None, z.z), Pace::Feed(feed)),
            toolpath::Move::Line { feed, to, z } => self.straight(self.at(Some(to), z.z), Pace::Feed(feed)),
            toolpath::Move::Arc { feed, clockwise, centre, to, z, .. } => {
                let relative = centre;
                let centre = [self.position.x() + centre.x, self.position.y() + centre.y];
                let arc = Arc { plane: Plane::Xy, centre, clockwise, extra_turns: 0 };
                let to = self.at(Some(to), z.z);
                // Ends that coincide, or nearly so, may mean next to nothing or a full circle: the length tells. Only an end that says
                // otherwise than the length does is put right: one just short of a full circle is where it is.
                let (radius, sweep) = (arc.radius(&self.position), arc.sweep(&self.position, &to));
                let is_whole = length > (sweep + PI) * radius && is_doubtful(relative, length);
                let is_next_to_nothing = length < radius && sweep > PI || is_point(relative);
                let path = if is_next_to_nothing { Path::Line } else { Path::Arc(arc) };
                let to = if is_whole { self.at(None, z.z) } else { to };
                self.along(to, path, Pace::Feed(feed))
            }
        }
    }

    fn at(&self, plane: Option<Xy>, z: f64) -> Position {
        let plane = plane.unwrap_or(Xy::new(self.position.x(), self.position.y()));
        Position::known(plane.x, plane.y, z)
    }

    fn straight(&mut self, to: Position, pace: Pace) -> Move {
        self.along(to, Path::Line, pace)
    }

    fn along(&mut self, to: Position, path: Path, pace: Pace) -> Move {
        let from = std::mem::replace(&mut self.position, to);
        Move { from, to, path, pace, named: None }
    }
}
