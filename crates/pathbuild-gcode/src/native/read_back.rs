//! Reads a native text back and compares its moves with those of the program it was made from, and compares a text with what `emit` would
//! write for its drawing. (book: program/reading, `verify --against`)

use std::ops::ControlFlow;

use pathbuild_diagnostic::messages::{files, gcode as say};
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_motion as motion;
use pathbuild_motion::{Axes, Pace};
use pathbuild_toolpath::{
    Correction, LAST_DIGIT, PlannedMove, ProbePoint, Program, ProgramStep, is_doubtful_arc,
};

use crate::adjust::{FormulaText, formula_texts, probe_entries, without_comments};
use crate::dialect::Dialect;
use crate::interpret::{Heights, Options, interpret_each, interpret_parts};
use crate::native::ProgramProbe;
use crate::native::number::{FIRST_PARAMETER, Formulas};
use crate::provenance::Provenance;
use crate::verify::{Difference, Rules, Tolerance, compare, is_near, is_same_move};

/// Number of decimals of coordinates in native programs.
const DECIMALS: i32 = 3;

/// Checks that the text of a program makes the machine perform the steps of the program. Heights are compared before correction.
///
/// # Errors
/// PB006 if the moves differ, which is a bug in pathbuild.
pub fn read_back(text: &str, program: &Program) -> Result<(), Box<Diagnostic>> {
    if contains_exact_moves([text], program) {
        return Ok(());
    }
    let exactly = Tolerance::of_decimals(DECIMALS);
    check_rules(text)?;
    let (found, expected) = (moves(text)?, program.moves().collect::<Vec<_>>());
    let difference = |tolerance: &Tolerance| compare(&found, &expected, tolerance);
    match difference(&exactly) {
        Some(_) if has_doubtful_arcs(program) => {
            let place = exactly.place + LAST_DIGIT;
            difference(&Tolerance { place, ..exactly }).map_or(Ok(()), |found| Err(difference_error(&found)))
        }
        found => found.map_or(Ok(()), |found| Err(difference_error(&found))),
    }
}

/// Checks that the text follows those rules of `verify` that do not depend on the material.
fn check_rules(text: &str) -> Result<(), Box<Diagnostic>> {
    let mut rules = Rules::new(None);
    interpret_each(text.as_bytes(), Dialect::Native, &nominal_options(), &mut |step| rules.step(&step));
    let broken = rules.finish().into_iter().find(is_broken);
    broken.map_or(Ok(()), |broken| Err(read_back_error(&broken)))
}

/// Whether a finding of the rules shows that the text does not match its program, which never starts the spindle without a speed.
fn is_broken(problem: &Diagnostic) -> bool {
    problem.is_error() || problem.message == &say::SPINDLE_WITHOUT_SPEED
}

/// Whether the text of a program, given in parts of whole lines, contains exactly the moves of the program. If not, [`read_back`] may still
/// find them equivalent.
pub fn contains_exact_moves(parts: impl IntoIterator<Item = impl AsRef<[u8]>>, program: &Program) -> bool {
    let mut comparison = LockstepComparison::new(program.moves(), Tolerance::of_decimals(DECIMALS));
    let mut rules = Rules::new(None);
    let mut each = |step: motion::Step| {
        rules.step(&step);
        if let Some((_, movement)) = step.as_move() {
            comparison.step(&movement);
        }
        ControlFlow::Continue(())
    };
    let (problems, _) = interpret_parts(parts, Dialect::Native, &nominal_options(), &mut each);
    let is_fine = |problems: &[Diagnostic]| !problems.iter().any(is_broken);
    is_fine(&problems) && is_fine(&rules.finish()) && comparison.are_all_equal()
}

/// Checks that the text of a probing program probes at the positions of the program's probes, in their order.
///
/// # Errors
/// PB006 if the positions differ, which is a bug in pathbuild.
pub fn read_probing_back(text: &str, probes: &[ProbePoint]) -> Result<(), Box<Diagnostic>> {
    let slack = Tolerance::of_decimals(DECIMALS).place;
    let mut found = moves(text)?;
    found.retain(|(_, movement)| matches!(movement.pace, Pace::Probe { .. }));
    let is_at = |((_, movement), probe): (&(u32, motion::Move), &ProbePoint)| {
        (movement.to.x() - probe.at.x).abs() <= slack && (movement.to.y() - probe.at.y).abs() <= slack
    };
    let is_same = found.len() == probes.len() && found.iter().zip(probes).all(is_at);
    if is_same { Ok(()) } else { Err(internal_error("the probing run probes elsewhere")) }
}

/// Comparison of the moves found with the expected ones, one by one. Nearly all programs are as expected, and building both lists for comparison
/// takes as long as reading the program.
struct LockstepComparison<E> {
    expected: E,
    tolerance: Tolerance,
    has_begun: bool,
    is_same: bool,
}

impl<E: Iterator<Item = (u32, motion::Move)>> LockstepComparison<E> {
    fn new(expected: E, tolerance: Tolerance) -> Self {
        Self { expected, tolerance, has_begun: false, is_same: true }
    }

    fn step(&mut self, found: &motion::Move) {
        // The position becomes known axis by axis, until the tool has reached the start of the program.
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

    /// Whether all moves were equal. Unequal moves may still be equivalent but divided into different parts.
    fn are_all_equal(mut self) -> bool {
        self.is_same && self.expected.next().is_none()
    }
}

fn moves(text: &str) -> Result<Vec<(u32, motion::Move)>, Box<Diagnostic>> {
    let mut moves = Vec::with_capacity(text.len() / SHORT_LINE);
    each_move(text, |line, movement| moves.push((line, movement)))?;
    Ok(moves)
}

fn each_move(text: &str, mut take: impl FnMut(u32, motion::Move)) -> Result<(), Box<Diagnostic>> {
    let mut each = |step: motion::Step| {
        if let Some((line, movement)) = step.as_move() {
            take(line, movement);
        }
    };
    let problems = interpret_each(text.as_bytes(), Dialect::Native, &nominal_options(), &mut each);
    problems.iter().find(|problem| problem.is_error()).map_or(Ok(()), |problem| Err(read_back_error(problem)))
}

fn nominal_options() -> Options {
    Options { heights: Heights::Nominal, ..Options::default() }
}

/// Length in bytes that most lines reach, for estimating the number of moves in a text.
const SHORT_LINE: usize = 20;

/// Whether the program has arcs whose printed end the writer may have moved.
fn has_doubtful_arcs(program: &Program) -> bool {
    let is_one = |step: &ProgramStep| match step {
        ProgramStep::Move { to: PlannedMove::Arc { centre, .. }, count } => {
            is_doubtful_arc(*centre, count.length)
        }
        _ => false,
    };
    program.steps.iter().any(is_one)
}

fn difference_error(found: &Difference) -> Box<Diagnostic> {
    read_back_error(&found.diagnostic())
}

/// Converts a problem in the text to an error of pathbuild itself (PB006).
fn read_back_error(problem: &Diagnostic) -> Box<Diagnostic> {
    let line = problem.place.line.map(|line| format!(" (line {line})")).unwrap_or_default();
    let message = problem.text(pathbuild_diagnostic::Lang::En);
    internal_error(&format!("the program, read back, is not what it was made from: {message}{line}"))
}

fn internal_error(reason: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::new(&files::INTERNAL).with("reason", Value::foreign(reason)))
}

/// Returns the differences between the formulas and probes of a native text and those of the drawing: the first probe and the first formula that
/// differ.
///
/// Applying a formula changes only the number before it, so adjusted programs can be compared too.
pub fn formula_differences(text: &[u8], program: &Program, correction: Correction) -> Vec<Diagnostic> {
    let mut found = formula_texts(text);
    let Some(formulas) = Formulas::new(program, correction) else {
        let first = found
            .next()
            .map(|formula| Diagnostic::new(&say::FORMULA_WITHOUT_PROBES).at_line(formula.line, None));
        return first.into_iter().collect();
    };
    let steps = correction.steps(program);
    let mut expected = steps.iter().filter_map(ProgramStep::height).map(|height| formulas.text(height));
    let difference = loop {
        match (found.next(), expected.next()) {
            (None, None) => break None,
            (Some(found), Some(expected)) if found.text == expected => {}
            (found, expected) => break Some(formula_not_drawn_error(found, expected)),
        }
    };
    probe_difference(text, &program.probes).into_iter().chain(difference).collect()
}

fn formula_not_drawn_error(found: Option<FormulaText>, expected: Option<String>) -> Diagnostic {
    let none = || "-".to_owned();
    let line = found.as_ref().map(|found| found.line);
    let problem = Diagnostic::new(&say::FORMULA_NOT_DRAWN)
        .quoting("found", found.map_or_else(none, |found| found.text))
        .quoting("expected", expected.unwrap_or_else(none));
    line.map_or_else(|| problem.clone(), |line| problem.clone().at_line(line, None))
}

/// Reports the first probe that differs between a text and the drawing.
fn probe_difference(text: &[u8], probes: &[ProbePoint]) -> Option<Diagnostic> {
    let mut stated = probe_entries(text).into_iter();
    let mut drawn = (FIRST_PARAMETER..)
        .zip(probes)
        .map(|(number, probe)| format!("#{number} {}", ProgramProbe::from(probe)));
    let problem = |found: &str, expected: &str| {
        let problem = Diagnostic::new(&say::PROBE_NOT_DRAWN).quoting("found", found);
        problem.quoting("expected", expected)
    };
    loop {
        return match (stated.next(), drawn.next()) {
            (None, None) => None,
            (Some(stated), Some(drawn)) if stated.text == drawn => continue,
            (Some(stated), drawn) => {
                Some(problem(&stated.text, drawn.as_deref().unwrap_or("-")).at_line(stated.line, None))
            }
            (None, Some(drawn)) => Some(problem("-", &drawn)),
        };
    }
}

/// Reports a text whose formulas were applied with heights that it does not list, as in programs of PathDxf2GCode. Such a text does not
/// allow checking the numbers before the formulas.
pub fn unstated_heights(text: &[u8]) -> Option<Diagnostic> {
    let is_stated = !probe_entries(text).is_empty() || Provenance::of_head(text).is_some();
    let mut formulas = formula_texts(text).filter(|formula| !is_stated && formula.is_applied);
    formulas.next().map(|formula| Diagnostic::new(&say::HEIGHTS_NOT_STATED).at_line(formula.line, None))
}

/// A line of a text that differs from the expected one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OtherLine {
    /// Line number, counted from 1.
    pub line: u32,
    /// The expected line; empty after the end of the expected text.
    pub expected: String,
}

/// The parts of a program that are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// The parts obeyed by the machine and `adjust`: words and formulas.
    Code,
    /// Lines that consist only of comments, regardless of the version of pathbuild that they state.
    Comments,
}

/// Returns the first line of a text that differs from the expected one, ignoring blanks and line breaks.
pub fn first_other_line(found: &[u8], expected: &[u8], parts: Parts) -> Option<OtherLine> {
    let (mut found, mut expected) = (lines(found, parts), lines(expected, parts));
    let mut last = 0;
    loop {
        return match (found.next(), expected.next()) {
            (None, None) => None,
            (Some((line, found)), Some((_, expected))) if found == expected => {
                last = line;
                continue;
            }
            (found, expected) => Some(OtherLine {
                line: found.map_or(last + 1, |(line, _)| line),
                expected: expected.map(|(_, text)| text).unwrap_or_default(),
            }),
        };
    }
}

/// Returns the lines to be compared, with their numbers.
fn lines(text: &[u8], parts: Parts) -> impl Iterator<Item = (u32, String)> {
    let text = String::from_utf8_lossy(text).into_owned();
    let plain = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let part = |line: &str| {
        let code = plain(&without_comments(line));
        match parts {
            Parts::Code => code,
            Parts::Comments if code.is_empty() => without_version(&plain(line)),
            Parts::Comments => String::new(),
        }
    };
    let all: Vec<(u32, String)> =
        (1..).zip(text.lines()).map(|(number, line)| (number, part(line))).collect();
    all.into_iter().filter(|(_, line)| !line.is_empty())
}

/// Removes the version from a line that states the provenance; other lines are returned unchanged.
fn without_version(line: &str) -> String {
    let rest = line.strip_prefix("(pathbuild ").and_then(|rest| rest.split_once(' '));
    rest.map_or(line.to_owned(), |(_, rest)| format!("(pathbuild {rest}"))
}
