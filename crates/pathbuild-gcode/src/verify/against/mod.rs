//! Whether a program does what a drawing says, from its first line to its last. (book: program/reading, `verify --against`)
//!
//! The drawing's program says where the tool goes, in one coordinate system and in XY, with one tool at one spindle speed. Whatever else a
//! program says that could change where, how deep or how fast the tool cuts is a difference. What its header claims counts for nothing.

mod chain;
mod clamps;
mod cuts;
mod setup;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::{Action, Coolant, Move, Step, Turning};

use super::words::{PostWords, WordRules};
use crate::dialect::Dialect;
use crate::read::Problems;

pub use clamps::{Clamps, PastClamps};
use cuts::Cuts;
use setup::Setup;

/// What a drawing and the configuration say of a program.
#[derive(Debug)]
pub struct Drawn<M> {
    /// The moves that are expected, from above the path's zero at the height `clearance` on.
    pub moves: M,
    /// S0: the height in mm at and above which nothing is in the way.
    pub clearance: f64,
    /// The cutter as the machine knows it.
    pub tool: ToolUse,
    /// Seconds that the spindle is given before it cuts.
    pub spin_up: f64,
}

/// How a drawing's cutter is used; what is not known is not compared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolUse {
    /// T.
    pub number: Option<u32>,
    /// What the spindle does while cutting; [`Turning::Unstated`] where the program leaves it alone.
    pub turning: Option<Turning>,
    /// Turns a minute.
    pub speed: Option<f64>,
    /// The coolant while cutting.
    pub coolant: Option<Coolant>,
}

/// How far a program does what a drawing says.
#[derive(Clone, Debug)]
pub struct Agreement {
    /// Every difference that was found, by line; of the moves the first one.
    pub differences: Vec<Diagnostic>,
    /// How many of the drawing's moves the program has, before the first that differs.
    pub equal: usize,
}

/// Compares a program's steps with what the drawing says; give it every step, then [`finish`](Self::finish) it.
#[derive(Debug)]
pub struct Against<'w, M: Iterator<Item = (u32, Move)>> {
    setup: Setup<'w>,
    words: WordRules<'w>,
    cuts: Cuts<M>,
    problems: Problems,
}

impl<'w, M: Iterator<Item = (u32, Move)>> Against<'w, M> {
    /// A comparison at the beginning of a program of this dialect, whose post writes these words.
    pub fn new(drawn: Drawn<M>, dialect: Dialect, words: &'w PostWords) -> Self {
        Self {
            setup: Setup::new(dialect, words, drawn.clearance, drawn.tool, drawn.spin_up),
            words: WordRules::strict(words, dialect),
            cuts: Cuts::new(drawn.moves, drawn.clearance, dialect),
            problems: Problems::default(),
        }
    }

    /// The next step of the program.
    pub fn step(&mut self, step: &Step) {
        self.words.step(step);
        self.setup.step(step, &mut self.problems);
        if let Action::Move(it) = &step.action {
            self.cuts.take(step.line, it);
        }
    }

    /// What came of it.
    pub fn finish(mut self) -> Agreement {
        self.setup.finish(&mut self.problems);
        let mut differences = self.problems.into_diagnostics();
        differences.extend(self.words.finish());
        let (first, equal) = self.cuts.finish();
        differences.extend(first);
        differences.sort_by_key(|diagnostic| diagnostic.place.line);
        Agreement { differences, equal }
    }
}
