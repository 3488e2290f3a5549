//! Converts the steps of a program to moves, and moves to the curves that are checked against clamps. (book: program/gcode)

use std::f64::consts::{PI, TAU};

use pathbuild_diagnostic::{Text, words};
use pathbuild_motion::{Arc, Axes, Move, MoveShape, Pace, Plane, Position};
use pathbuild_path::{Curve, Line, TipMove, Xy};

use crate::program::{PlannedMove, Program, ProgramStep};

impl Program {
    /// Returns the moves as an interpreter of the native text sees them, from (0, 0, S0) to the last lift to S0. Each comes with the number of its
    /// step, counted from 1, in place of a line number.
    pub fn moves(&self) -> impl Iterator<Item = (u32, Move)> {
        let height = self.start_height();
        let mut tool = ToolTip::new(height);
        let last = u32::try_from(self.steps.len()).unwrap_or(u32::MAX).saturating_add(1);
        let steps = (1_u32..).zip(self.steps.iter().map(Some)).chain(std::iter::once((last, None)));
        steps.filter_map(move |(number, step)| match step {
            Some(ProgramStep::Move { to, count }) => Some((number, tool.make_move(to, count.length))),
            Some(ProgramStep::Comment(_)) => None,
            None => Some((number, tool.lift(height))),
        })
    }

    /// Returns the moves of the probing program, each with the index of the probe that it goes to or comes from. Empty without probes.
    pub fn probing_moves(&self) -> impl Iterator<Item = (usize, Move)> {
        let clearance = self.sweep_height;
        let mut tool = ToolTip::new(clearance);
        let last = self.probes.len().checked_sub(1);
        let mut moves = Vec::with_capacity(4 * self.probes.len() + 1);
        for (number, probe) in self.probes.iter().enumerate() {
            moves.push((number, tool.straight(place(probe.at, clearance), Pace::Rapid)));
            moves.push((number, tool.lift(probe.height + self.tool)));
            let pace = Pace::Probe { feed: probe.feed, toward: true, must_answer: !self.compatible };
            moves.push((number, tool.straight(tool.at_height(0.0), pace)));
            moves.push((number, tool.lift(clearance)));
        }
        moves.extend(last.map(|number| (number, tool.straight(place(Xy::origin(), clearance), Pace::Rapid))));
        moves.into_iter()
    }
}

/// The position of the tool tip, which is updated by each move that is made.
#[derive(Clone, Copy, Debug)]
pub struct ToolTip {
    /// The current position.
    pub at: Position,
}

impl ToolTip {
    /// Creates a tool tip above (0, 0) at this height in mm.
    pub fn new(height: f64) -> Self {
        Self { at: Position::known(0.0, 0.0, height) }
    }

    /// Makes a planned move and returns it. `length` is its planned length in mm ([`Count::length`](crate::Count::length)).
    pub fn make_move(&mut self, to: &PlannedMove, length: f64) -> Move {
        match *to {
            PlannedMove::Sweep { to } => self.straight(place(to, self.at.z()), Pace::Rapid),
            PlannedMove::Lift { z } => self.lift(z.z),
            PlannedMove::Drill { feed, z } => self.straight(self.at_height(z.z), Pace::Feed(feed)),
            PlannedMove::Line { feed, to, z } => self.straight(place(to, z.z), Pace::Feed(feed)),
            PlannedMove::Arc { feed, clockwise, centre, to, z, .. } => {
                let relative_centre = centre;
                let centre = [self.at.x() + centre.x, self.at.y() + centre.y];
                let arc = Arc { plane: Plane::Xy, centre, clockwise, extra_turns: 0 };
                let to = place(to, z.z);
                // An arc whose ends (almost) coincide either has almost no length or is a full circle: its length decides. Ends are corrected only if
                // they contradict the length, so an arc that is not quite a full circle is kept.
                let (radius, sweep) = (arc.radius(&self.at), arc.sweep(&self.at, &to));
                let is_whole = length > (sweep + PI) * radius && is_doubtful_arc(relative_centre, length);
                let has_no_length = length < radius && sweep > PI || is_point_arc(relative_centre);
                let path = if has_no_length { MoveShape::Line } else { MoveShape::Arc(arc) };
                let to = if is_whole { self.at_height(z.z) } else { to };
                self.move_along(to, path, Pace::Feed(feed))
            }
        }
    }

    /// Makes a rapid move to a height and returns it.
    pub fn lift(&mut self, z: f64) -> Move {
        self.straight(self.at_height(z), Pace::Rapid)
    }

    fn at_height(&self, z: f64) -> Position {
        Position::known(self.at.x(), self.at.y(), z)
    }

    fn straight(&mut self, to: Position, pace: Pace) -> Move {
        self.move_along(to, MoveShape::Line, pace)
    }

    fn move_along(&mut self, to: Position, shape: MoveShape, pace: Pace) -> Move {
        let from = std::mem::replace(&mut self.at, to);
        Move { from, to, shape, pace, named: None }
    }
}

fn place(at: Xy, z: f64) -> Position {
    Position::known(at.x, at.y, z)
}

/// Whether the centre of an arc, relative to its start, is printed as zero. Controllers do not accept such an arc, so it is written as a line.
pub fn is_point_arc(centre: Xy) -> bool {
    centre.coords.amax() < LAST_DIGIT / 2.0
}

/// Whether an arc of this length in mm is so short, or so close to a full turn, that rounding to three decimals may turn one into the other.
pub fn is_doubtful_arc(centre: Xy, length: f64) -> bool {
    is_short_arc(length) || length > TAU * centre.coords.norm() - DOUBTFUL_ARC_LENGTH
}

/// Whether an arc of this length in mm is so short that its end may be printed like its start.
pub fn is_short_arc(length: f64) -> bool {
    length < DOUBTFUL_ARC_LENGTH
}

/// Unit of the last printed digit, in mm.
pub const LAST_DIGIT: f64 = 0.001;

/// Permitted difference of two printed numbers that may be rounded differently, in mm or mm/min: one unit of the last digit, plus the error of doubles.
pub const LAST_DIGIT_SLACK: f64 = LAST_DIGIT * (1.0 + 1e-6);

/// Difference in mm from an empty arc or a full circle up to which an arc is doubtful: several times the distance by which rounding moves an end
/// along the arc.
const DOUBTFUL_ARC_LENGTH: f64 = 10.0 * LAST_DIGIT;

/// Returns the [`TipMove`] of a move. If only the end of the move is known, it is a curve without length at that point; `None` if even the end is
/// unknown.
pub fn tip_move(movement: &Move) -> Option<TipMove> {
    let [from, to] = [movement.from, movement.to].map(|end| Xy::new(end.x(), end.y()));
    if !movement.to.known.has(Axes::ALL) {
        return None;
    }
    let to_z = movement.to.z();
    let from_z = if movement.from.known.has(Axes::Z) { movement.from.z() } else { to_z };
    if !movement.from.known.has(Axes::XY) {
        return Some(TipMove { curve: Curve::Line(Line { start: to, end: to }), from_z, to_z });
    }
    let straight = Curve::Line(Line { start: from, end: to });
    let Some(course) = movement.course() else { return Some(TipMove { curve: straight, from_z, to_z }) };
    let (arc, radius) = (course.arc(), course.radius());
    if arc.plane != Plane::Xy {
        // An arc in another plane is treated as a straight line as seen from above, at a height that no point of the arc is below.
        let lowest = from_z.min(to_z).min(arc.centre[1] - radius).min(arc.centre[0] - radius);
        return Some(TipMove { curve: straight, from_z: lowest, to_z: lowest });
    }
    let degrees = course.sweep().to_degrees().min(360.0);
    let (centre, clockwise) = (Xy::new(arc.centre[0], arc.centre[1]), arc.clockwise);
    let curve = Curve::Arc(pathbuild_path::Arc { centre, radius, start: from, end: to, clockwise, degrees });
    let lowest = from_z.min(to_z);
    // An arc with several turns reaches each point at several heights.
    let (from_z, to_z) = if arc.extra_turns > 0 { (lowest, lowest) } else { (from_z, to_z) };
    Some(TipMove { curve, from_z, to_z })
}

/// Returns the name of a move in findings about clamps.
pub fn kind_of_move(movement: &Move) -> &'static Text {
    match movement.pace {
        Pace::Rapid => &words::RAPID_MOVE,
        Pace::Probe { .. } => &words::PROBING_MOVE,
        Pace::Feed(_) if movement.keeps_xy() && movement.shape == MoveShape::Line => &words::PLUNGE,
        Pace::Feed(_) => &words::CUT,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Height;

    fn arc(centre: Xy, to: Xy, length: f64) -> Move {
        let z = Height { z: 1.0, at: to };
        let planned = PlannedMove::Arc { feed: 1.0, clockwise: false, centre, to, z, is_spiral: false };
        ToolTip::new(1.0).make_move(&planned, length)
    }

    #[test]
    fn a_radius_that_is_printed_as_zero_makes_a_line() {
        let path = |radius: f64| arc(Xy::new(radius, 0.0), Xy::new(2.0 * radius, 0.0), PI * radius).shape;
        assert_eq!(path(0.000_49), MoveShape::Line);
        assert!(matches!(path(0.000_5), MoveShape::Arc(_)));
    }

    #[test]
    fn the_length_tells_a_full_circle_from_an_arc_of_almost_no_length() {
        let sweep = |to: Xy, length: f64| {
            let movement = arc(Xy::new(10.0, 0.0), to, length);
            movement.course().map(|course| course.sweep())
        };
        let ahead = Xy::new(0.0, -0.004);
        assert!(sweep(ahead, 0.004).unwrap() < 0.001, "an arc");
        assert_eq!(sweep(ahead, TAU * 10.0), Some(TAU), "a circle that ends past its start");
        assert!(
            sweep(Xy::new(0.0, 0.004), TAU * 10.0 - 0.004).unwrap() < TAU,
            "an arc that is not quite a circle"
        );
        assert_eq!(
            sweep(Xy::new(0.0, 1e-9), 1e-9),
            None,
            "an arc of almost no length that ends before its start"
        );
    }
}
