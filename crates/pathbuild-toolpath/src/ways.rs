//! The movement of the tool tip in each move of a program.

use pathbuild_diagnostic::{Text, words};
use pathbuild_path::{Arc, Curve, Line, Way, Xy};

use crate::program::{Comment, Move, Program, Step};

/// Iterates over the moves of a program: index of the step, name and movement.
#[derive(Debug)]
pub struct Ways<'p> {
    steps: std::iter::Enumerate<std::slice::Iter<'p, Step>>,
    at: Xy,
    z: f64,
}

impl<'p> Ways<'p> {
    /// Starts at the beginning of a program, above X0 Y0.
    pub fn of(program: &'p Program) -> Self {
        Self { steps: program.steps.iter().enumerate(), at: Xy::origin(), z: program.start_height() }
    }

    fn go(&mut self, to: &Move, length: f64) -> (&'static Text, Way) {
        let straight = |to: Xy| Curve::Line(Line { start: self.at, end: to });
        let (what, curve, z) = match to {
            Move::Sweep { to } => (&words::RAPID_MOVE, straight(*to), self.z),
            Move::Lift { z } => (&words::RAPID_MOVE, straight(self.at), z.z),
            Move::Drill { z, .. } => (&words::PLUNGE, straight(self.at), z.z),
            Move::Line { to, z, .. } => (&words::CUT, straight(*to), z.z),
            Move::Arc { clockwise, centre, to, z, .. } => {
                let radius = centre.coords.norm();
                let degrees = (length / radius).to_degrees().min(360.0);
                let centre = self.at + centre.coords;
                let arc = Arc { centre, radius, start: self.at, end: *to, clockwise: *clockwise, degrees };
                (&words::CUT, if radius > 0.0 { Curve::Arc(arc) } else { straight(*to) }, z.z)
            }
        };
        let way = Way { curve, from_z: self.z, to_z: z };
        (self.at, self.z) = (curve.end(), z);
        (what, way)
    }
}

impl Iterator for Ways<'_> {
    type Item = (usize, &'static Text, Way);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let (number, Step::Move { to, count }) = self.steps.next()? {
                let (what, way) = self.go(to, count.length);
                return Some((number, what, way));
            }
        }
    }
}

impl Program {
    /// The largest cutter diameter O in mm used for milling.
    pub fn largest_cutter(&self) -> f64 {
        let cutters = self.steps.iter().filter_map(|step| match step {
            Step::Comment(Comment::Element { cutter, .. }) => Some(*cutter),
            _ => None,
        });
        cutters.fold(self.tool, f64::max)
    }
}
