//! Finds formulas in a line of a program: `<number>(=<formula>)`.

use std::ops::Range;

/// A number with its formula, as byte ranges of the line.
#[derive(Clone, Debug)]
pub(super) struct Spot {
    /// Digits with an optional sign and decimal point. With several points it is not a valid number.
    pub(super) number: Range<usize>,
    /// The text between `(=` and the closing bracket.
    pub(super) formula: Range<usize>,
    /// Whether there is a closing bracket; otherwise the formula extends to the end of the line.
    pub(super) is_closed: bool,
}

/// The formulas of a line, in order. Formulas within comments are ignored.
pub(super) fn spots(line: &[u8]) -> impl Iterator<Item = Spot> {
    let mut rest = 0;
    std::iter::from_fn(move || {
        loop {
            let open = rest + line[rest..].iter().position(|byte| matches!(byte, b'(' | b';'))?;
            if line[open] == b';' {
                return None;
            }
            let number = number_before(line, open);
            if line.get(open + 1) == Some(&b'=') && !number.is_empty() {
                let closed = closing(line, open);
                let end = closed.unwrap_or(line.len());
                rest = (end + 1).min(line.len());
                return Some(Spot { number, formula: open + 2..end, is_closed: closed.is_some() });
            }
            rest = open + 1 + line[open..].iter().position(|byte| *byte == b')')?;
        }
    })
}

fn number_before(line: &[u8], end: usize) -> Range<usize> {
    let is_digit = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let mut start = end - line[..end].iter().rev().take_while(|byte| is_digit(byte)).count();
    if start < end && start > 0 && matches!(line[start - 1], b'+' | b'-') {
        start -= 1;
    }
    start..end
}

/// Position of the bracket that closes the one at `open`.
fn closing(line: &[u8], open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    line.iter().enumerate().skip(open).find_map(|(at, byte)| {
        match byte {
            b'(' => depth += 1,
            b')' => depth -= 1,
            _ => {}
        }
        (depth == 0).then_some(at)
    })
}
