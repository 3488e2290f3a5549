//! Looks for rapid moves that hit material, separately in each coordinate system whose position relative to the others is not known. (book:
//! program/reading)
//!
//! For example, parts in two vises are milled in G54 and G55. A cut in one part leaves the other untouched, although both have the same coordinates.
//! The same holds after a stop at which the operator sets the zero for the next part.

use std::collections::BTreeSet;

use pathbuild_motion::{Action, Axes, Frame, Move, Pace, Step};

use super::material::{self, Stock};
use crate::interpret::Program;
use crate::read::Problems;

/// The frames in which a program moves. Coordinate systems whose positions relative to each other are known share a frame. Pass every step to
/// [`step`](Self::step).
#[derive(Debug, Default)]
pub(super) struct Frames {
    current: Frame,
    /// The frames with moves, in the order of use.
    used: Vec<Frame>,
}

impl Frames {
    /// The frame of the next move.
    pub(super) fn current(&self) -> Frame {
        self.current
    }

    /// Processes the next step of the program. Returns whether it begins another frame.
    pub(super) fn step(&mut self, step: &Step) -> bool {
        match step.action {
            Action::System { frame, .. } => std::mem::replace(&mut self.current, frame) != frame,
            Action::Move(_) => {
                if !self.used.contains(&self.current) {
                    self.used.push(self.current);
                }
                false
            }
            _ => false,
        }
    }

    /// Reports rapid moves that hit material, in the program as a whole, or in each frame if there are several.
    pub(super) fn check<P: Program + ?Sized>(self, program: &P, stock: &Stock, problems: &mut Problems) {
        let mut check = |program: &dyn Program| material::check(program, stock, problems);
        if self.used.len() <= 1 {
            return check(&WholeProgram(program));
        }
        for frame in self.used {
            check(&MovesInFrame { program, frame });
        }
    }

    /// Like [`check`](Self::check), but only for the rapid moves with these indices among all moves. `legs` returns the moves to be checked in place
    /// of one of them. If there are no such rapid moves, the program is not processed.
    pub(super) fn check_rapids<P: Program + ?Sized>(
        self,
        rapids: &BTreeSet<usize>,
        legs: fn(&Move) -> Vec<Move>,
        program: &P,
        stock: &Stock,
        problems: &mut Problems,
    ) {
        if !rapids.is_empty() {
            self.check(&CutsAndRapids { program, rapids, legs }, stock, problems);
        }
    }
}

struct WholeProgram<'p, P: ?Sized>(&'p P);

impl<P: Program + ?Sized> Program for WholeProgram<'_, P> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        self.0.each(take);
    }
}

/// A program reduced to its cuts, to some of its rapid moves, and to its coordinate systems.
struct CutsAndRapids<'p, P: ?Sized> {
    program: &'p P,
    rapids: &'p BTreeSet<usize>,
    legs: fn(&Move) -> Vec<Move>,
}

impl<P: Program + ?Sized> Program for CutsAndRapids<'_, P> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        let mut index = 0;
        self.program.each(&mut |step| match &step.action {
            Action::Move(movement) => {
                if movement.pace != Pace::Rapid {
                    take(step);
                } else if self.rapids.contains(&index) {
                    let legs = (self.legs)(movement).into_iter();
                    legs.for_each(|leg| take(&Step { action: Action::Move(leg), ..step.clone() }));
                }
                index += 1;
            }
            Action::System { .. } => take(step),
            _ => {}
        });
    }
}

/// The moves of a program in one frame. The first move after those in another frame has an unknown start.
struct MovesInFrame<'p, P: ?Sized> {
    program: &'p P,
    frame: Frame,
}

impl<P: Program + ?Sized> Program for MovesInFrame<'_, P> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        let mut current = Frame::default();
        let mut is_entered = true;
        self.program.each(&mut |step| match &step.action {
            Action::System { frame, .. } => is_entered |= std::mem::replace(&mut current, *frame) != *frame,
            Action::Move(movement) if current == self.frame => {
                let mut movement = *movement;
                if std::mem::take(&mut is_entered) {
                    movement.from.known = Axes::NONE;
                }
                take(&Step { action: Action::Move(movement), ..step.clone() });
            }
            _ => {}
        });
    }
}
