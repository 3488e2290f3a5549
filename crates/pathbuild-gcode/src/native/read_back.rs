//! Reads a native text back and compares its moves with those of the program it was made from. (book: program/reading)

use pathbuild_diagnostic::messages::files;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_motion as motion;
use pathbuild_motion::{Axes, Pace};
use pathbuild_toolpath::{LAST_DIGIT, PlannedMove, ProbePoint, Program, ProgramStep, is_doubtful};

use crate::dialect::Dialect;
use crate::interpret::{Heights, Options, interpret_each, interpret_parts};
use crate::verify::{Checks, Difference, Rules, Tolerance, compare, is_near, is_same_move};

/// Number of decimals.
const DECIMALS: i32 = 3;

/// Checks that the text of a program makes the machine do what the program says. Heights are compared before correction.
///
/// # Errors
/// PB006 if they differ, which is a bug.
pub fn read_back(text: &str, program: &Program) -> Result<(), Box<Diagnostic>> {
    if is_read_back([text], program) {
        return Ok(());
    }
    let exactly = Tolerance::of_decimals(DECIMALS);
    check_rules(text)?;
    let (found, expected) = (moves(text)?, program.moves().collect::<Vec<_>>());
    let difference = |tolerance: &Tolerance| compare(&found, &expected, tolerance);
    match difference(&exactly) {
        Some(_) if has_doubtful_arcs(program) => {
            let place = exactly.place + LAST_DIGIT;
            difference(&Tolerance { place, ..exactly }).map_or(Ok(()), |found| Err(differs(&found)))
        }
        found => found.map_or(Ok(()), |found| Err(differs(&found))),
    }
}

/// Checks the rules of `verify` that do not depend on the material.
fn check_rules(text: &str) -> Result<(), Box<Diagnostic>> {
    let mut rules = Rules::new(&Checks::default());
    interpret_each(text.as_bytes(), Dialect::Native, &nominal(), &mut |step| rules.step(&step));
    let broken = rules.finish().into_iter().find(Diagnostic::is_error);
    broken.map_or(Ok(()), |broken| Err(told(&broken)))
}

/// Whether the text of a program, given in parts of whole lines, contains exactly the moves of the program. If not, [`read_back`] may still
/// find them equivalent.
pub fn is_read_back(parts: impl IntoIterator<Item = impl AsRef<[u8]>>, program: &Program) -> bool {
    let mut abreast = Abreast::new(program.moves(), Tolerance::of_decimals(DECIMALS));
    let mut rules = Rules::new(&Checks::default());
    let mut each = |step: motion::Step| {
        rules.step(&step);
        if let Some((_, it)) = step.as_move() {
            abreast.step(&it);
        }
    };
    let (problems, _) = interpret_parts(parts, Dialect::Native, &nominal(), &mut each);
    let is_fine = |problems: &[Diagnostic]| !problems.iter().any(Diagnostic::is_error);
    is_fine(&problems) && is_fine(&rules.finish()) && abreast.end_together()
}

/// Checks that the text of a probing program probes at the positions of the program's probes, in their order.
///
/// # Errors
/// PB006 if they differ, which is a bug.
pub fn read_probing_back(text: &str, probes: &[ProbePoint]) -> Result<(), Box<Diagnostic>> {
    let slack = Tolerance::of_decimals(DECIMALS).place;
    let mut found = moves(text)?;
    found.retain(|(_, it)| matches!(it.pace, Pace::Probe { .. }));
    let is_at = |((_, it), probe): (&(u32, motion::Move), &ProbePoint)| {
        (it.to.x() - probe.at.x).abs() <= slack && (it.to.y() - probe.at.y).abs() <= slack
    };
    let is_same = found.len() == probes.len() && found.iter().zip(probes).all(is_at);
    if is_same { Ok(()) } else { Err(internal("the probing run probes elsewhere")) }
}

/// Compares the moves found with those expected, one by one. Nearly all programs are as expected, and building both lists for comparison
/// takes as
/// long as reading the program.
struct Abreast<E> {
    expected: E,
    tolerance: Tolerance,
    has_begun: bool,
    is_same: bool,
}

impl<E: Iterator<Item = (u32, motion::Move)>> Abreast<E> {
    fn new(expected: E, tolerance: Tolerance) -> Self {
        Self { expected, tolerance, has_begun: false, is_same: true }
    }

    fn step(&mut self, found: &motion::Move) {
        // The position becomes known axis by axis, on the way to the start of the program.
        if !self.is_same || found.from.known != Axes::ALL && !self.has_begun {
            return;
        }
        let begins_there = |expected: &motion::Move| {
            self.has_begun || is_near(&found.from.at, &expected.from.at, self.tolerance.place)
        };
        self.is_same = self.expected.next().is_some_and(|(_, expected)| {
            found.to.known == Axes::ALL
                && begins_there(&expected)
                && is_same_move(found, &expected, &self.tolerance)
        });
        self.has_begun = true;
    }

    /// Whether all moves were equal. If not, they may still be equivalent but divided into different parts.
    fn end_together(mut self) -> bool {
        self.is_same && self.expected.next().is_none()
    }
}

/// The moves of a text, with their lines.
fn moves(text: &str) -> Result<Vec<(u32, motion::Move)>, Box<Diagnostic>> {
    let mut moves = Vec::with_capacity(text.len() / SHORT_LINE);
    each_move(text, |line, it| moves.push((line, it)))?;
    Ok(moves)
}

fn each_move(text: &str, mut take: impl FnMut(u32, motion::Move)) -> Result<(), Box<Diagnostic>> {
    let mut each = |step: motion::Step| {
        if let Some((line, it)) = step.as_move() {
            take(line, it);
        }
    };
    let problems = interpret_each(text.as_bytes(), Dialect::Native, &nominal(), &mut each);
    problems.iter().find(|problem| problem.is_error()).map_or(Ok(()), |problem| Err(told(problem)))
}

fn nominal() -> Options {
    Options { heights: Heights::Nominal, ..Options::default() }
}

/// Most lines have at least this number of bytes.
const SHORT_LINE: usize = 20;

/// Whether the writer may have moved the printed end of an arc.
fn has_doubtful_arcs(program: &Program) -> bool {
    let is_one = |step: &ProgramStep| match step {
        ProgramStep::Move { to: PlannedMove::Arc { centre, .. }, count } => {
            is_doubtful(*centre, count.length)
        }
        _ => false,
    };
    program.steps.iter().any(is_one)
}

fn differs(found: &Difference) -> Box<Diagnostic> {
    told(&found.diagnostic())
}

/// Reports a problem in the text as an error of pathbuild.
fn told(problem: &Diagnostic) -> Box<Diagnostic> {
    let line = problem.place.line.map(|line| format!(" (line {line})")).unwrap_or_default();
    let message = problem.text(pathbuild_diagnostic::Lang::En);
    internal(&format!("the program, read back, is not what it was made from: {message}{line}"))
}

fn internal(reason: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::new(&files::INTERNAL).with("reason", Value::foreign(reason)))
}
