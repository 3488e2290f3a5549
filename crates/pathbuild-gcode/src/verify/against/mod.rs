//! Checks whether a program makes the moves of a drawing, from its first line to its last. (book: program/reading, `verify --against`)
//!
//! The program of the drawing defines where the tool goes, in one coordinate system, in the plane XY, with one tool at one spindle speed. Anything
//! else in a program that could change where, how deep or how fast the tool cuts is a difference. The claims in the program's header are ignored.

mod clamps;
mod cuts;
mod setup;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Coolant, Move, Pace, Position, Spindle, Step, Turning};

use super::tool_state::ToolState;
use super::words::{PostWords, WordRules};
use crate::dialect::Dialect;
use crate::read::Problems;

pub use clamps::Clamps;
use cuts::CutComparison;
use setup::Setup;

/// The program that a drawing and the configuration require.
#[derive(Debug)]
pub struct ExpectedProgram<M> {
    /// The expected moves, beginning at `start`.
    pub moves: M,
    /// Depths in mm of the pecks with which holes must be drilled, each with the number of the move from which it applies; `None` if the tool may go
    /// down in one stroke.
    pub pecks: Vec<(u32, Option<f64>)>,
    /// The position at which the moves begin: above the path's zero at the height `clearance`, unless the definition of the post-processor begins
    /// elsewhere.
    pub start: Position,
    /// The start height S0 of the drawing in mm, slightly above the sweep height S. There are no obstacles at or above it.
    pub clearance: f64,
    /// Whether this is the probing program, which may wait at any height: nothing turns in the material.
    pub is_probing: bool,
    /// Number, spindle and coolant of the cutter on the machine.
    pub tool: ToolUse,
    /// The program number by which a control identifies the program, if the post writes one.
    pub number: Option<u32>,
    /// Time in seconds for the spindle to reach its speed before cutting.
    pub spin_up: f64,
}

/// Number, spindle and coolant with which the cutter of a drawing is used. Unknown properties are not compared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolUse {
    /// Tool number (T).
    pub number: Option<u32>,
    /// State of the spindle while cutting; [`Turning::Unstated`] if the program does not control it.
    pub turning: Option<Turning>,
    /// Spindle speed in 1/min.
    pub speed: Option<f64>,
    /// State of the coolant while cutting.
    pub coolant: Option<Coolant>,
}

impl ToolUse {
    /// Returns the properties that all cuts of a program have in common.
    pub fn of_cuts(steps: &[Step], dialect: Dialect) -> Self {
        let mut tools = ToolState::new(dialect);
        let mut coolant = None;
        let mut common: Option<Self> = None;
        for step in steps {
            tools.step(step);
            if let Action::Coolant(switched) = step.action {
                coolant = switched.is_on().then_some(switched);
            }
            if step.as_move().is_some_and(|(_, movement)| matches!(movement.pace, Pace::Feed(_))) {
                let now = Self { coolant, ..Self::of_state(&tools) };
                common = Some(common.map_or(now, |common| common.common_with(now)));
            }
        }
        common.unwrap_or_default()
    }

    fn of_state(tools: &ToolState) -> Self {
        let Spindle { turning, speed } = tools.spindle();
        let turning = turning.is_on().then_some(turning);
        Self { number: tools.inserted().or(tools.selected()), turning, speed, coolant: None }
    }

    /// Returns the properties in which two uses agree; the others become unknown.
    fn common_with(self, other: Self) -> Self {
        Self {
            number: self.number.filter(|_| self.number == other.number),
            turning: self.turning.filter(|_| self.turning == other.turning),
            speed: self.speed.filter(|_| self.speed == other.speed),
            coolant: self.coolant.filter(|_| self.coolant == other.coolant),
        }
    }

    /// Fills unknown properties from another use.
    #[must_use]
    pub fn filled_from(self, other: Self) -> Self {
        Self {
            number: self.number.or(other.number),
            turning: self.turning.or(other.turning),
            speed: self.speed.or(other.speed),
            coolant: self.coolant.or(other.coolant),
        }
    }
}

/// The result of comparing a program with a drawing.
#[derive(Clone, Debug)]
pub struct ComparisonResult {
    /// All differences, ordered by line. Of the differences between moves, only the first one is included.
    pub differences: Vec<Diagnostic>,
    /// Number of the drawing's moves that the program contains before the first difference between the moves.
    pub equal: usize,
    /// Whether the program switches coolant on although it is unknown whether the program must do so.
    pub has_uncompared_coolant: bool,
}

/// Comparison of a program's steps with a drawing: pass every step, then call [`finish`](Self::finish).
#[derive(Debug)]
pub struct DrawingComparison<'w, M: Iterator<Item = (u32, Move)>> {
    setup: Setup<'w>,
    words: WordRules<'w>,
    cuts: CutComparison<M>,
    number: Option<u32>,
    /// Whether the control requires a program number, which has not occurred yet.
    lacks_number: bool,
    problems: Problems,
}

impl<'w, M: Iterator<Item = (u32, Move)>> DrawingComparison<'w, M> {
    /// Starts a comparison for a program in this dialect, written by a post with these words.
    pub fn new(drawn: ExpectedProgram<M>, dialect: Dialect, words: &'w PostWords) -> Self {
        let lowest_wait = if drawn.is_probing { f64::NEG_INFINITY } else { drawn.clearance };
        Self {
            setup: Setup::new(dialect, words, lowest_wait, drawn.tool, drawn.spin_up),
            words: WordRules::strict(words, dialect),
            cuts: CutComparison::new(drawn.moves, drawn.pecks, drawn.start, drawn.clearance, dialect),
            number: drawn.number,
            lacks_number: matches!(dialect, Dialect::Fanuc | Dialect::Haas) && !words.is_of_definition(),
            problems: Problems::default(),
        }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        self.words.step(step);
        self.setup.step(step);
        self.lacks_number &= !matches!(step.action, Action::ProgramNumber(_));
        if let (Action::ProgramNumber(found), Some(expected)) = (&step.action, self.number)
            && *found != expected
        {
            self.problems.add_at_line(&say::NUMBERS_DIFFER, step.line, |d| {
                d.with("found", u64::from(*found)).with("expected", u64::from(expected))
            });
        }
        if let Action::Move(movement) = &step.action {
            self.cuts.take(step.line, movement);
        }
    }

    /// Checks a word that was omitted when the program was translated by the definition of its post.
    pub fn check_omitted_word(&mut self, line: u32, word: &str) {
        self.words.check_omitted_word(line, word);
    }

    /// Completes the comparison at the end of the program and returns its result.
    pub fn finish(self) -> ComparisonResult {
        let has_uncompared_coolant = self.setup.has_uncompared_coolant();
        let mut problems = self.setup.finish();
        problems.append(self.problems);
        if let Some(expected) = self.number.filter(|_| self.lacks_number) {
            problems.add_at_line(&say::NUMBER_MISSING, 1, |d| d.with("expected", u64::from(expected)));
        }
        let mut differences = problems.into_diagnostics();
        differences.extend(self.words.finish());
        let (found, equal) = self.cuts.finish();
        differences.extend(found);
        differences.sort_by_key(|diagnostic| diagnostic.place.line);
        ComparisonResult { differences, equal, has_uncompared_coolant }
    }
}
