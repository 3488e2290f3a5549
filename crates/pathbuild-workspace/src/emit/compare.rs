//! Is what lies on disk what would be written? (book: reference/commands, `emit --check`)

use pathbuild_db::System;
use pathbuild_db::system::ReadError;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{self, interpret};
use pathbuild_gcode::verify::{self, Ends, Tolerance};

use super::deliver::{Output, State, has_same_probes};
use crate::posting::PostProcessor;
use crate::session::OutputKind;

/// Compares a file with what is on disk: byte for byte, or by its moves, so that comments, formulas, line ends, head and foot may be those
/// of another program. Comes with where the moves part, or why they cannot be read. What is larger than any program is none.
pub(super) fn compare(
    system: &dyn System,
    output: &Output,
    limit: u64,
    moves_only: bool,
    poster: Option<&PostProcessor>,
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
    // What cannot be read can only be compared byte for byte.
    let Some(reading) = Reading::of(poster) else { return (State::Outdated, Vec::new()) };
    let problems = difference(&present, &output.text, &reading);
    let problems = problems.into_iter().map(|problem| problem.in_file(&output.path)).collect::<Vec<_>>();
    let state = if problems.is_empty() { State::Current } else { State::Outdated };
    (state, problems)
}

/// How programs are read to be compared.
struct Reading {
    dialect: Dialect,
    tolerance: Tolerance,
}

impl Reading {
    fn of(poster: Option<&PostProcessor>) -> Option<Self> {
        let Some(poster) = poster else {
            return Some(Self { dialect: Dialect::Native, tolerance: TOLERANCE });
        };
        let dialect = poster.reader()?;
        Some(Self { dialect, tolerance: Tolerance { ends: Ends::Cutting, ..TOLERANCE } })
    }
}

/// What keeps a program on disk from being read, else where its moves differ first. Numbers that are equal to one unit of their last digit
/// are equal, whatever an interpreter makes of them: an arc so short that it ends, rounded, where it begins is a circle to it. What is
/// written in other lines is compared by what it does.
fn difference(present: &[u8], expected: &[u8], reading: &Reading) -> Vec<Diagnostic> {
    let [found, wanted] = [present, expected].map(String::from_utf8_lossy);
    if verify::same_move_lines(&found, &wanted) {
        return Vec::new();
    }
    let read = |text| interpret(text, reading.dialect, &interpret::Options::default());
    let found = read(present);
    let errors: Vec<Diagnostic> = found.problems.iter().filter(|it| it.is_error()).cloned().collect();
    if !errors.is_empty() {
        return errors;
    }
    let difference = verify::compare(&found.moves(), &read(expected).moves(), &reading.tolerance);
    difference.iter().map(verify::Difference::diagnostic).collect()
}

/// One unit of the last printed digit: two programs may have rounded what lies between two numbers differently.
const TOLERANCE: Tolerance =
    Tolerance { place: 0.001 * (1.0 + 1e-6), feed: 0.001 * (1.0 + 1e-6), chord: 0.0, ends: Ends::All };
