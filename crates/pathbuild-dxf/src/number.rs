//! Parses numbers as CAD programs write them. (book: reference/dxf: "numbers")
//!
//! Nearly all numbers of a drawing are plain decimals. Their parser works on eight characters at a time, because branches on the number of digits or
//! the place of the point cannot be predicted. The value is exactly that of a general parser: up to 15 digits and powers of ten up to 10^22 are
//! exact, so a single division rounds correctly; a number of 16 digits has no point and is rounded only once, by the conversion to f64.

/// The reason why a value is not a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotANumber {
    /// The value is empty or malformed.
    Invalid,
    /// The value has a comma instead of a decimal point.
    Comma,
    /// The value is NaN, infinite or too large.
    NotFinite,
}

/// Parses a real number. Surrounding blanks and `D` as exponent letter are accepted.
#[inline]
pub(crate) fn real(value: &[u8]) -> Result<f64, NotANumber> {
    match plain_decimal(value) {
        Some(number) => Ok(number),
        None => parse_unusual(value),
    }
}

/// Parses an integer. One written as a real number (`5.0`) is accepted.
pub(crate) fn whole_number(value: &[u8]) -> Result<i64, NotANumber> {
    let number = real(value)?;
    // Up to 2^53 every integer has an exact f64.
    let is_whole = libm::trunc(number) == number && number.abs() <= LARGEST_EXACT;
    #[expect(clippy::cast_possible_truncation, reason = "whole and within range")]
    is_whole.then_some(number as i64).ok_or(NotANumber::Invalid)
}

#[cold]
#[inline(never)]
fn parse_unusual(value: &[u8]) -> Result<f64, NotANumber> {
    let value = value.trim_ascii();
    plain_decimal(value).map_or_else(|| parse_general(value), Ok)
}

fn parse_general(value: &[u8]) -> Result<f64, NotANumber> {
    let text = std::str::from_utf8(value).map_err(|_| NotANumber::Invalid)?;
    let number = match value.iter().position(|byte| matches!(byte, b'd' | b'D')) {
        Some(exponent) => format!("{}E{}", &text[..exponent], &text[exponent + 1..]).parse(),
        None => text.parse(),
    };
    match number {
        Ok(number) if f64::is_finite(number) => Ok(number),
        Ok(_) => Err(NotANumber::NotFinite),
        Err(_) if has_decimal_comma(text) => Err(NotANumber::Comma),
        Err(_) => Err(NotANumber::Invalid),
    }
}

fn has_decimal_comma(text: &str) -> bool {
    text.matches(',').count() == 1 && text.replace(',', ".").parse::<f64>().is_ok_and(f64::is_finite)
}

/// Parses digits with an optional minus sign and an optional point, at most 16 characters after the sign. `None` for any other form, and for
/// a point with a single digit and no sign.
#[inline]
fn plain_decimal(value: &[u8]) -> Option<f64> {
    // By far the most frequent number: most heights and components of normals are 0.
    if value == b"0.0" {
        return Some(0.0);
    }
    match value.len() {
        3..=WIDTH => short_decimal(value),
        _ => other_decimal(value),
    }
}

/// Parses three to eight characters, at least one of which is a digit. The sign is handled without a branch.
#[inline]
fn short_decimal(value: &[u8]) -> Option<f64> {
    let is_negative = value.first() == Some(&b'-');
    let sign = u64::from(is_negative) * u64::from(b'-' ^ b'0');
    let digits = Digits::read(value).0 ^ sign << (64 - 8 * value.len());
    let (digits, decimals) = Digits(digits).without_point();
    Some(quotient(digits.number()?, decimals.unwrap_or(0), is_negative))
}

/// Parses a decimal of any other length.
fn other_decimal(value: &[u8]) -> Option<f64> {
    let (is_negative, text) = match value {
        [b'-', text @ ..] => (true, text),
        text => (false, text),
    };
    let (number, decimals) = match text {
        [a @ b'0'..=b'9'] => (u64::from(a - b'0'), 0),
        [a @ b'0'..=b'9', b @ b'0'..=b'9'] => (u64::from(a - b'0') * 10 + u64::from(b - b'0'), 0),
        _ => long_number(text)?,
    };
    Some(quotient(number, decimals, is_negative))
}

/// Parses eight to sixteen characters. Returns their digits as one number, and how many of them follow the point.
fn long_number(text: &[u8]) -> Option<(u64, usize)> {
    let split = text.len().checked_sub(WIDTH).filter(|split| *split <= WIDTH)?;
    let (first, decimals) = Digits::first(*text.first_chunk()?, split).without_point();
    let last = Digits::of(*text.last_chunk()?);
    let (last, scale, decimals) = match (decimals, last.without_point()) {
        (Some(decimals), _) => (last, 100_000_000, decimals + WIDTH),
        (None, (last, Some(decimals))) => (last, 10_000_000, decimals),
        (None, (last, None)) => (last, 100_000_000, 0),
    };
    Some((first.number()? * scale + last.number()?, decimals))
}

#[inline]
fn quotient(number: u64, decimals: usize, is_negative: bool) -> f64 {
    let number = number as f64 / POWERS[decimals];
    f64::from_bits(number.to_bits() | u64::from(is_negative) << 63)
}

/// 2^53, up to which every whole number is an exact f64.
const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;

/// Number of characters processed at once.
const WIDTH: usize = 8;

/// The powers of ten that a division may need.
const POWERS: [f64; 2 * WIDTH] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

const ONE_PER_BYTE: u64 = u64::from_le_bytes([1; WIDTH]);

/// The character `0` in each byte.
const ZEROS: u64 = ONE_PER_BYTE * 0x30;

/// Up to eight digits, the last in the highest byte, padded with zeros. A byte above 9 is some other character.
#[derive(Clone, Copy)]
struct Digits(u64);

impl Digits {
    /// Loads three to eight characters.
    #[inline]
    fn read(text: &[u8]) -> Self {
        let half = |characters: [u8; 4]| u64::from(u32::from_le_bytes(characters)) ^ ZEROS >> 32;
        Self(match (text.first_chunk(), text.last_chunk(), text) {
            // The halves overlap; bytes in both are equal.
            (Some(first), Some(last), _) => half(*first) << (64 - 8 * text.len()) | half(*last) << 32,
            (_, _, [a, b, c]) => half([b'0', *a, *b, *c]) << 32,
            // An empty text is not a number.
            _ => u64::MAX,
        })
    }

    /// Loads eight characters.
    #[inline]
    fn of(characters: [u8; WIDTH]) -> Self {
        Self(u64::from_le_bytes(characters) ^ ZEROS)
    }

    /// Loads the first `count` of eight characters.
    #[inline]
    fn first(characters: [u8; WIDTH], count: usize) -> Self {
        if count == 0 { Self(0) } else { Self(Self::of(characters).0 << (64 - 8 * count)) }
    }

    /// Removes the first point and returns how many digits follow it.
    #[inline]
    fn without_point(self) -> (Self, Option<usize>) {
        let zero_where_point = self.0 ^ (ONE_PER_BYTE * u64::from(b'.' ^ b'0'));
        // The lowest bit is right; those above it may be wrong.
        let points = zero_where_point.wrapping_sub(ONE_PER_BYTE) & !zero_where_point & (ONE_PER_BYTE * 0x80);
        if points == 0 {
            return (self, None);
        }
        let up_to_point = points ^ (points - 1);
        let (before, behind) = (self.0 & up_to_point >> 8, self.0 & !up_to_point);
        (Self(behind | before << 8), Some(WIDTH - 1 - points.trailing_zeros() as usize / 8))
    }

    /// Returns the value of the digits; `None` if some byte is not a digit.
    #[inline]
    fn number(self) -> Option<u64> {
        let Self(digits) = self;
        let beyond_nine = (digits | digits.wrapping_add(ONE_PER_BYTE * 0x76)) & (ONE_PER_BYTE * 0x80);
        // Combine neighbours: digits to two-digit numbers, these to four-digit numbers, and these to the result. Sums that belong to no
        // pair are masked out or overflow at the top.
        let twos = (digits.wrapping_mul(1 + (10 << 8)) >> 8) & 0x00FF_00FF_00FF_00FF;
        let fours = (twos.wrapping_mul(1 + (100 << 16)) >> 16) & 0x0000_FFFF_0000_FFFF;
        (beyond_nine == 0).then(|| fours.wrapping_mul(1 + (10_000 << 32)) >> 32)
    }
}
