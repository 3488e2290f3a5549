//! Numbers as CADs write them. (spec/10-drawing.md: "numbers")
//!
//! Plain decimals of moderate length, nearly all there are, take a way that needs neither UTF-8 validation nor a general parser and
//! gives exactly the same value: digits below 2^53 and powers of ten up to 10^22 are exact, so one division rounds correctly.

/// Why a value is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotANumber {
    /// Empty, or something else.
    Invalid,
    /// It would be one with a decimal point for the comma.
    Comma,
    /// Not a number, infinite, or too large.
    NotFinite,
}

/// Reads a real number; blanks around it and a `D` exponent are fine.
#[inline]
pub(crate) fn real(value: &[u8]) -> Result<f64, NotANumber> {
    plain_decimal(value).map_or_else(|| unusual(value.trim_ascii()), Ok)
}

/// Reads a whole number; one written as a real (`5.0`) is fine.
pub(crate) fn whole(value: &[u8]) -> Result<i64, NotANumber> {
    let number = real(value)?;
    // Up to 2^53 every whole f64 is exactly that number.
    let is_whole = libm::trunc(number) == number && number.abs() <= LARGEST_EXACT as f64;
    #[expect(clippy::cast_possible_truncation, reason = "whole and within range")]
    is_whole.then_some(number as i64).ok_or(NotANumber::Invalid)
}

/// 2^53: up to here all whole numbers have an f64 of their own.
const LARGEST_EXACT: u64 = 1 << 53;

/// The powers of ten that are exact.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// `[-]digits[.digits]` with at most 19 characters; `None` when it is anything else.
#[inline]
fn plain_decimal(value: &[u8]) -> Option<f64> {
    let (negative, digits) = match value {
        [b'-', digits @ ..] => (true, digits),
        digits => (false, digits),
    };
    if digits.len() > 19 {
        return None;
    }
    let mut mantissa = 0_u64;
    let mut point = None;
    for (index, byte) in digits.iter().enumerate() {
        match byte.wrapping_sub(b'0') {
            digit @ 0..=9 => mantissa = mantissa * 10 + u64::from(digit),
            _ if *byte == b'.' && point.is_none() => point = Some(index),
            _ => return None,
        }
    }
    let decimals = point.map_or(0, |index| digits.len() - index - 1);
    let has_digits = digits.len() > usize::from(point.is_some());
    if !has_digits || mantissa > LARGEST_EXACT {
        return None;
    }
    let number = mantissa as f64 / POWERS[decimals];
    Some(if negative { -number } else { number })
}

fn unusual(value: &[u8]) -> Result<f64, NotANumber> {
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
