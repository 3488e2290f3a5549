//! Finds arcs with too few decimals in their centres. (book: program/reading)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::MoveShape;

use crate::dialect::Dialect;
use crate::interpret::{Options, interpret_each};
use crate::read::{BlockReader, Problems, Value, Word};

/// Number of decimals that arc centres in millimetres require.
const MIN_CENTRE_DECIMALS: u8 = 3;

/// Tolerance in mm within which radii are equal.
const RADIUS_TOLERANCE: f64 = 1e-4;

/// Reports the first arc of a program in millimetres whose centre has decimals, if no coordinate or centre in the program has three of them and some
/// arc has different radii at its ends. Numbers without decimals are considered to be written by hand and exact.
pub fn coarse_arc_finding(text: &[u8], dialect: Dialect) -> Option<Diagnostic> {
    let mut reader = BlockReader::new(text, dialect.rules());
    let (mut finest, mut first) = (0, None);
    while let Some(block) = reader.next_block() {
        for word in &block.words {
            if is_inch(word) {
                return None;
            }
            let Value::Number(number) = word.value else { continue };
            let is_centre = matches!(word.letter, b'I' | b'J' | b'K');
            if is_centre || matches!(word.letter, b'X' | b'Y' | b'Z') {
                finest = finest.max(number.decimals);
            }
            if finest >= MIN_CENTRE_DECIMALS {
                return None;
            }
            if is_centre && number.decimals > 0 {
                first = first.or(Some(block.line));
            }
        }
    }
    let line = first.filter(|_| has_rounded_arc(text, dialect))?;
    let mut problems = Problems::default();
    let step = if finest == 1 { 0.1 } else { 0.01 };
    problems.add_at_line(&say::COARSE_ARCS, line, |d| d.with("step", step));
    problems.into_diagnostics().pop()
}

/// Whether some arc has different radii at its ends. If all radii match exactly, the numbers were not rounded.
fn has_rounded_arc(text: &[u8], dialect: Dialect) -> bool {
    let mut is_rounded = false;
    interpret_each(text, dialect, &Options::default(), &mut |step| {
        let Some((_, movement)) = step.as_move() else { return };
        let MoveShape::Arc(arc) = movement.shape else { return };
        is_rounded |= libm::fabs(arc.radius(&movement.from) - arc.radius(&movement.to)) > RADIUS_TOLERANCE;
    });
    is_rounded
}

fn is_inch(word: &Word) -> bool {
    let Value::Number(number) = word.value else { return false };
    word.letter == b'G' && (number.value == 20.0 || number.value == 70.0)
}
