//! Is what lies on disk what would be written? (spec/05-command-line.md, `emit --check`)

use pathbuild_db::system::ReadError;
use pathbuild_db::{Database, Db};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{self, Interpretation, interpret};
use pathbuild_gcode::verify::{self, Ends, Tolerance};

use super::deliver::{Output, State, has_same_probes};
use crate::session::OutputKind;

/// Compares a file with what is on disk: byte for byte, or by its moves, so that comments, formulas, line ends, head and foot may be those
/// of another program. Comes with where the moves part, or why they cannot be read.
pub(super) fn compare(db: &Database, output: &Output, moves_only: bool) -> (State, Vec<Diagnostic>) {
    let present = match db.system().read(&output.path, u64::MAX) {
        Ok(bytes) => bytes,
        Err(ReadError::Missing) => return (State::Missing, Vec::new()),
        Err(_) => return (State::Outdated, Vec::new()),
    };
    let is_same =
        present == output.text.as_bytes() || output.kind == OutputKind::Values && has_same_probes(db, output);
    if is_same {
        return (State::Current, Vec::new());
    }
    if !moves_only {
        return (State::Outdated, Vec::new());
    }
    let problems = difference(&present, &output.text);
    let problems = problems.into_iter().map(|problem| problem.in_file(&output.path)).collect::<Vec<_>>();
    (if problems.is_empty() { State::Current } else { State::Outdated }, problems)
}

/// What keeps a program on disk from being read, else where its moves differ first. Numbers that are equal to one unit of their last digit
/// are equal, whatever an interpreter makes of them: an arc so short that it ends, rounded, where it begins is a circle to it. What is
/// written in other lines is compared by what it does.
fn difference(present: &[u8], expected: &str) -> Vec<Diagnostic> {
    if verify::same_move_lines(&String::from_utf8_lossy(present), expected) {
        return Vec::new();
    }
    let found = read(present);
    let errors: Vec<Diagnostic> = found.problems.iter().filter(|it| it.is_error()).cloned().collect();
    if !errors.is_empty() {
        return errors;
    }
    let difference = verify::compare(&found.moves(), &read(expected.as_bytes()).moves(), &TOLERANCE);
    difference.iter().map(verify::Difference::diagnostic).collect()
}

fn read(text: &[u8]) -> Interpretation {
    interpret(text, Dialect::Native, &interpret::Options::default())
}

/// One unit of the last printed digit: two programs may have rounded what lies between two numbers differently.
const TOLERANCE: Tolerance =
    Tolerance { place: 0.001 * (1.0 + 1e-6), feed: 0.001 * (1.0 + 1e-6), chord: 0.0, ends: Ends::All };
