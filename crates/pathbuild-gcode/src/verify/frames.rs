//! Splits a program by the coordinate systems whose places relative to each other are not known. (book: program/reading)
//!
//! Two vises have two systems, G54 and G55. What has been cut in one is not cut in the other, although both have the same coordinates.

use pathbuild_motion::{Action, Axes, Step, WorkSystem};

use crate::interpret::Program;

/// The frames in which a program moves. Coordinate systems whose positions relative to each other are known share a frame. Pass every step to
/// [`step`](Self::step).
#[derive(Debug, Default)]
pub(super) struct Frames {
    current: WorkSystem,
    /// The frames with moves, in the order of use.
    used: Vec<WorkSystem>,
}

impl Frames {
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

    /// Passes the program to `take` as a whole, or the moves in each frame if there are several.
    pub(super) fn each<P: Program + ?Sized>(self, program: &P, take: &mut dyn FnMut(&dyn Program)) {
        if self.used.len() <= 1 {
            return take(&Whole(program));
        }
        for frame in self.used {
            take(&InFrame { program, frame });
        }
    }
}

struct Whole<'p, P: ?Sized>(&'p P);

impl<P: Program + ?Sized> Program for Whole<'_, P> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        self.0.each(take);
    }
}

/// The moves of a program in one frame. The first move after those in another frame has an unknown start.
struct InFrame<'p, P: ?Sized> {
    program: &'p P,
    frame: WorkSystem,
}

impl<P: Program + ?Sized> Program for InFrame<'_, P> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        let mut current = WorkSystem::default();
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
