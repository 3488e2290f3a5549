//! Reads numbers in G-code notation: sign, digits and one decimal point, but no exponent.

use super::block::{Number, decode};
use crate::dialect::{Blanks, Spelling};

/// Powers of ten that a double represents exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// Maximum number of digits of an integer that a double represents exactly, so that one division gives the nearest double.
const EXACT_DIGITS: usize = 15;

#[derive(Clone, Copy, Debug)]
pub(super) struct ScannedNumber {
    pub(super) number: Number,
    /// Offset of the first byte after the number.
    pub(super) end: usize,
    pub(super) oddity: Option<UnusualNotation>,
}

/// Notations that are read with a warning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum UnusualNotation {
    BlankInside,
    DecimalComma,
}

/// Error for text that is not a valid number; `end` is the offset after it.
#[derive(Clone, Copy, Debug)]
pub(super) struct MalformedNumber {
    pub(super) end: usize,
}

/// Whether a number can begin with this byte.
pub(super) fn begins(byte: u8) -> bool {
    byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.')
}

pub(super) fn scan(line: &[u8], start: usize, spelling: &Spelling) -> Result<ScannedNumber, MalformedNumber> {
    let digits = Digits::scan(line, start);
    match line.get(digits.end) {
        Some(b'.') => Err(MalformedNumber { end: run_end(line, digits.end, begins) }),
        Some(b' ' | b'\t')
            if spelling.blanks == Blanks::Ignored && continues_after_blanks(line, digits.end) =>
        {
            scan_unusual(line, start, UnusualNotation::BlankInside)
        }
        Some(b',') if spelling.decimal_comma && !digits.point && is_digit(line, digits.end + 1) => {
            scan_unusual(line, start, UnusualNotation::DecimalComma)
        }
        _ => digits.number(line, start).map(|number| ScannedNumber { number, end: digits.end, oddity: None }),
    }
}

/// Reads a number in the simplest notation; anything else is left to [`scan`].
///
/// Nearly all numbers in programs are of this form, and reading them is most of the work of the reader.
#[inline]
pub(super) fn scan_plain(line: &[u8], start: usize) -> Option<(Number, usize)> {
    let mut at = start;
    let negative = line.get(at) == Some(&b'-');
    at += usize::from(negative);
    let mut mantissa = 0_i64;
    let mut point = None;
    let mut follows = b'\n';
    while let Some(&byte) = line.get(at) {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(i64::from(digit));
        } else if byte == b'.' && point.is_none() {
            point = Some(at + 1);
        } else {
            follows = byte;
            break;
        }
        at += 1;
    }
    let decimals = point.map_or(0, |point| at - point);
    let digits = at - start - usize::from(negative) - usize::from(point.is_some());
    let is_plain = match follows {
        b' ' => !line.get(at + 1).is_some_and(|byte| matches!(byte, b'0'..=b'9' | b'.' | b' ' | b'\t')),
        b'.' | b',' | b'\t' => false,
        _ => true,
    };
    if !is_plain || digits == 0 || digits > EXACT_DIGITS {
        return None;
    }
    // Applying the sign to the integer avoids a branch, which would be mispredicted often.
    let signed = if negative { -mantissa } else { mantissa };
    let value = signed as f64 / POWERS[decimals];
    Some((Number { value, decimals: u8::try_from(decimals).unwrap_or(u8::MAX) }, at))
}

/// The sign, digits and decimal point that follow an offset, as far as they have the form of a plain number.
struct Digits {
    negative: bool,
    mantissa: u64,
    count: usize,
    decimals: usize,
    point: bool,
    end: usize,
}

impl Digits {
    fn scan(line: &[u8], start: usize) -> Self {
        let negative = line.get(start) == Some(&b'-');
        let mut digits = Self { negative, mantissa: 0, count: 0, decimals: 0, point: false, end: start };
        if matches!(line.get(start), Some(b'+' | b'-')) {
            digits.end += 1;
        }
        digits.run(line);
        if line.get(digits.end) == Some(&b'.') {
            digits.point = true;
            digits.end += 1;
            let whole = digits.count;
            digits.run(line);
            digits.decimals = digits.count - whole;
        }
        digits
    }

    fn run(&mut self, line: &[u8]) {
        let from = self.end;
        while let Some(digit) =
            line.get(self.end).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10)
        {
            self.mantissa = self.mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            self.end += 1;
        }
        self.count += self.end - from;
    }

    fn number(&self, line: &[u8], start: usize) -> Result<Number, MalformedNumber> {
        if self.count == 0 {
            return Err(MalformedNumber { end: self.end });
        }
        let value = if self.count <= EXACT_DIGITS {
            let value = self.mantissa as f64 / POWERS[self.decimals];
            if self.negative { -value } else { value }
        } else {
            decode(&line[start..self.end]).parse().map_err(|_| MalformedNumber { end: self.end })?
        };
        if value.is_finite() {
            Ok(Number { value, decimals: u8::try_from(self.decimals).unwrap_or(u8::MAX) })
        } else {
            Err(MalformedNumber { end: self.end })
        }
    }
}

/// Reads a number with blanks inside or a decimal comma by converting it to the usual notation.
fn scan_unusual(
    line: &[u8],
    start: usize,
    oddity: UnusualNotation,
) -> Result<ScannedNumber, MalformedNumber> {
    let end = match oddity {
        UnusualNotation::BlankInside => last_digit(line, start),
        UnusualNotation::DecimalComma => run_end(line, start, |byte| begins(byte) || byte == b','),
    };
    let usual: Vec<u8> = line[start..end]
        .iter()
        .filter(|byte| !matches!(byte, b' ' | b'\t'))
        .map(|&byte| if byte == b',' { b'.' } else { byte })
        .collect();
    let digits = Digits::scan(&usual, 0);
    if digits.end < usual.len() {
        return Err(MalformedNumber { end });
    }
    let number = digits.number(&usual, 0).map_err(|_| MalformedNumber { end })?;
    Ok(ScannedNumber { number, end, oddity: Some(oddity) })
}

/// Returns the offset after the last digit or point of a number that contains blanks.
fn last_digit(line: &[u8], start: usize) -> usize {
    let mut end = run_end(line, start, begins);
    while continues_after_blanks(line, end) {
        let next = run_end(line, end, |byte| matches!(byte, b' ' | b'\t'));
        end = run_end(line, next, |byte| byte.is_ascii_digit() || byte == b'.');
    }
    end
}

/// Whether blanks follow, and after them more of the number.
fn continues_after_blanks(line: &[u8], at: usize) -> bool {
    let next = run_end(line, at, |byte| matches!(byte, b' ' | b'\t'));
    next > at && line.get(next).is_some_and(|byte| byte.is_ascii_digit() || *byte == b'.')
}

fn is_digit(line: &[u8], at: usize) -> bool {
    line.get(at).is_some_and(u8::is_ascii_digit)
}

fn run_end(line: &[u8], start: usize, belongs: impl Fn(u8) -> bool) -> usize {
    line[start.min(line.len())..]
        .iter()
        .position(|&byte| !belongs(byte))
        .map_or(line.len(), |length| start + length)
}
