//! The moves of a program that does not exist as text.

use std::f64::consts::PI;

use pathbuild_motion::{Arc, Move, Pace, Path, Plane, Position};
use pathbuild_toolpath as toolpath;
use pathbuild_toolpath::{Program, Xy};

use crate::native::{is_doubtful, is_point};

/// The moves of a program as an interpreter of its native text would see them, from (0, 0, S0) to the last lift to S0. Instead of a line,
/// each
/// has the number of its step, counted from 1.
pub fn moves_of(program: &Program) -> Vec<(u32, Move)> {
    let mut moves = Vec::with_capacity(program.steps.len() + 1);
    moves.extend(each_move_of(program));
    moves
}

/// Like [`moves_of`], but as an iterator.
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
    /// Adds a move that is counted with this length in the statistics, in mm.
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
                // Ends that coincide or almost coincide may stand for an arc of almost no length or for a full circle, which the length
                // tells. Only ends that
                // contradict the length are corrected; an arc that is not quite a full circle remains.
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
