//! Compares a native text with what `emit` would write for its drawing. (book: program/reading, `verify --against`)

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Severity};
use pathbuild_toolpath::{Correction, ProbePoint, Program};

use super::number::f3;
use super::number::{FIRST_PARAMETER, Formulas, height_of};
use crate::adjust::{FormulaText, formula_texts, probe_entries, without_comments};
use crate::provenance::Provenance;

/// The differences between the formulas and probes of a native text and those of the drawing: the first probe and the first formula that
/// differ.
///
/// Applied formulas differ only in their number, so adjusted programs can be compared too.
pub fn formula_differences(text: &[u8], program: &Program, correction: Correction) -> Vec<Diagnostic> {
    let mut found = formula_texts(text);
    let Some(formulas) = Formulas::new(program, correction) else {
        let first = found
            .next()
            .map(|formula| Diagnostic::new(&say::FORMULA_WITHOUT_PROBES).at_line(formula.line, None));
        return first.into_iter().collect();
    };
    let steps = correction.steps(program);
    let mut expected = steps.iter().filter_map(height_of).map(|height| formulas.text(height));
    let difference = loop {
        match (found.next(), expected.next()) {
            (None, None) => break None,
            (Some(found), Some(expected)) if found.text == expected => {}
            (found, expected) => break Some(not_drawn(found, expected)),
        }
    };
    probe_difference(text, &program.probes).into_iter().chain(difference).collect()
}

fn not_drawn(found: Option<FormulaText>, expected: Option<String>) -> Diagnostic {
    let none = || "-".to_owned();
    let line = found.as_ref().map(|found| found.line);
    let problem = Diagnostic::new(&say::FORMULA_NOT_DRAWN)
        .quoting("found", found.map_or_else(none, |found| found.text))
        .quoting("expected", expected.unwrap_or_else(none));
    line.map_or_else(|| problem.clone(), |line| problem.clone().at_line(line, None))
}

/// The first probe that differs between a text and the drawing.
fn probe_difference(text: &[u8], probes: &[ProbePoint]) -> Option<Diagnostic> {
    let mut stated = probe_entries(text).into_iter();
    let mut drawn = (FIRST_PARAMETER..).zip(probes).map(|(number, probe)| {
        let [x, y, at_x, at_y] = [probe.drawn_at.x, probe.drawn_at.y, probe.at.x, probe.at.y].map(f3);
        format!("#{number} [{x} {y}] T={} X{at_x} Y{at_y}", f3(probe.height))
    });
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

/// Reports a text whose formulas were applied with heights that it does not list, as in programs of PathDxf2GCode. Then nothing tells
/// whether the
/// numbers before them are right.
pub fn unstated_heights(text: &[u8]) -> Option<Diagnostic> {
    let is_stated = !probe_entries(text).is_empty() || Provenance::of_head(text).is_some();
    let mut formulas = formula_texts(text).filter(|formula| !is_stated && formula.is_applied);
    let warning = |line| Diagnostic {
        severity: Severity::Warning,
        ..Diagnostic::new(&say::HEIGHTS_NOT_STATED).at_line(line, None)
    };
    formulas.next().map(|formula| warning(formula.line))
}

/// A line of a text that differs from the expected one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OtherLine {
    /// Line number, counted from 1.
    pub line: u32,
    /// The expected line; empty after the end of the expected text.
    pub expected: String,
}

/// Which parts of a program are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// The parts obeyed by the machine and `adjust`: words and formulas.
    Code,
    /// Lines that consist only of comments, regardless of the version that wrote them.
    Comments,
}

/// The first line of a text that differs from the expected one, ignoring blanks and line breaks.
pub fn first_other_line(found: &[u8], expected: &[u8], parts: Parts) -> Option<OtherLine> {
    let (mut found, mut wanted) = (lines(found, parts), lines(expected, parts));
    let mut last = 0;
    loop {
        return match (found.next(), wanted.next()) {
            (None, None) => None,
            (Some((line, found)), Some((_, wanted))) if found == wanted => {
                last = line;
                continue;
            }
            (found, wanted) => Some(OtherLine {
                line: found.map_or(last + 1, |(line, _)| line),
                expected: wanted.map(|(_, text)| text).unwrap_or_default(),
            }),
        };
    }
}

/// The lines to be compared, with their numbers.
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

/// The line without the version, if it is a provenance.
fn without_version(line: &str) -> String {
    let rest = line.strip_prefix("(pathbuild ").and_then(|rest| rest.split_once(' '));
    rest.map_or(line.to_owned(), |(_, rest)| format!("(pathbuild {rest}"))
}
