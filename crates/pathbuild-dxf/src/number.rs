//! Parses numbers as CAD programs write them. (book: reference/dxf: "numbers")

use crate::decimal::{LARGEST_EXACT, plain_decimal};

/// Why a value is not a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotANumber {
    /// Empty or malformed.
    Invalid,
    /// It has a comma where a decimal point belongs.
    Comma,
    /// NaN, infinite or too large.
    NotFinite,
}

/// Parses a real number. Surrounding blanks and `D` as exponent letter are accepted.
#[inline]
pub(crate) fn real(value: &[u8]) -> Result<f64, NotANumber> {
    match plain_decimal(value) {
        Some(number) => Ok(number),
        None => unusual(value),
    }
}

/// Parses an integer. One written as a real number (`5.0`) is accepted.
pub(crate) fn whole(value: &[u8]) -> Result<i64, NotANumber> {
    // Nearly all integers are padded and have one digit.
    if let [blanks @ .., digit @ b'0'..=b'9'] = value
        && blanks.iter().all(|byte| *byte == b' ')
    {
        return Ok(i64::from(digit - b'0'));
    }
    let number = real(value)?;
    // Up to 2^53 every integer has an exact f64.
    let is_whole = libm::trunc(number) == number && number.abs() <= LARGEST_EXACT as f64;
    #[expect(clippy::cast_possible_truncation, reason = "whole and within range")]
    is_whole.then_some(number as i64).ok_or(NotANumber::Invalid)
}

#[cold]
#[inline(never)]
fn unusual(value: &[u8]) -> Result<f64, NotANumber> {
    let value = value.trim_ascii();
    plain_decimal(value).map_or_else(|| general(value), Ok)
}

fn general(value: &[u8]) -> Result<f64, NotANumber> {
    let text = std::str::from_utf8(value).map_err(|_| NotANumber::Invalid)?;
    let number = match value.iter().position(|byte| matches!(byte, b'd' | b'D')) {
        Some(exponent) => format!("{}E{}", &text[..exponent], &text[exponent + 1..]).parse(),
        None => text.parse(),
    };
    match number {
        Ok(number) if f64::is_finite(number) => Ok(number),
        Ok(_) => Err(NotANumber::NotFinite),
        Err(_) if is_with_comma(text) => Err(NotANumber::Comma),
        Err(_) => Err(NotANumber::Invalid),
    }
}

fn is_with_comma(text: &str) -> bool {
    text.matches(',').count() == 1 && text.replace(',', ".").parse::<f64>().is_ok_and(f64::is_finite)
}
