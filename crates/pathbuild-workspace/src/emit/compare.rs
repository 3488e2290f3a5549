//! Compares files on disk with what would be written. (book: reference/commands, `emit --check`)

use pathbuild_db::System;
use pathbuild_db::system::ReadError;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{self, interpret};
use pathbuild_gcode::verify::{self, Ends, Tolerance};

use super::deliver::{Output, State, has_same_probes};
use crate::posting::PostProcessor;
use crate::session::OutputKind;

/// Compares a file on disk with the generated one: byte for byte, or by its moves only, ignoring comments, formulas, line ends, head and
/// foot. Also returns where the moves differ first, or why they cannot be read. A file larger than `limit` counts as different.
pub(super) fn compare(
    system: &dyn System,
    output: &Output,
    limit: u64,
    moves_only: bool,
    post_processor: Option<&PostProcessor>,
) -> (State, Vec<Diagnostic>) {
    let present = match system.read(&output.path, limit) {
        Ok(bytes) => bytes,
        Err(ReadError::Missing) => return (State::Missing, Vec::new()),
        Err(_) => return (State::Outdated, Vec::new()),
    };
    let is_same =
        present == output.text || output.kind == OutputKind::Values && has_same_probes(system, output);
    if is_same {
        return (State::Current, Vec::new());
    }
    if !moves_only {
        return (State::Outdated, Vec::new());
    }
    // Without a reader for the dialect, only bytes can be compared.
    let Some(reading) = ComparisonSettings::of(post_processor) else { return (State::Outdated, Vec::new()) };
    let problems = difference(&present, &output.text, &reading);
    let problems = problems.into_iter().map(|problem| problem.in_file(&output.path)).collect::<Vec<_>>();
    let state = if problems.is_empty() { State::Current } else { State::Outdated };
    (state, problems)
}

/// How programs are read for comparison.
struct ComparisonSettings {
    dialect: Dialect,
    tolerance: Tolerance,
}

impl ComparisonSettings {
    fn of(post_processor: Option<&PostProcessor>) -> Option<Self> {
        let Some(post_processor) = post_processor else {
            return Some(Self { dialect: Dialect::Native, tolerance: TOLERANCE });
        };
        let dialect = post_processor.reader()?;
        Some(Self { dialect, tolerance: Tolerance { ends: Ends::Cutting, ..TOLERANCE } })
    }
}

/// Returns why a program on disk cannot be read, or else where its moves differ first. Lines are compared before moves: numbers that differ
/// by one unit of their last digit are equal however they are interpreted, even where rounding turns a very short arc into a full circle.
/// Only programs with different lines are interpreted.
fn difference(present: &[u8], expected: &[u8], reading: &ComparisonSettings) -> Vec<Diagnostic> {
    let [found_text, expected_text] = [present, expected].map(String::from_utf8_lossy);
    if verify::same_move_lines(&found_text, &expected_text) {
        return Vec::new();
    }
    let read = |text| interpret(text, reading.dialect, &interpret::Options::default());
    let found = read(present);
    let errors: Vec<Diagnostic> =
        found.problems.iter().filter(|problem| problem.is_error()).cloned().collect();
    if !errors.is_empty() {
        return errors;
    }
    let difference = verify::compare(&found.moves(), &read(expected).moves(), &reading.tolerance);
    difference.iter().map(verify::Difference::diagnostic).collect()
}

/// One unit of the last printed digit: two programs may have rounded a value between two such numbers differently.
const TOLERANCE: Tolerance =
    Tolerance { place: 0.001 * (1.0 + 1e-6), feed: 0.001 * (1.0 + 1e-6), chord: 0.0, ends: Ends::All };
