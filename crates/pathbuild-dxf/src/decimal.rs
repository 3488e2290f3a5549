//! Plain decimals, which nearly all numbers of a drawing are: eight characters at once, since how many there are and where the point is
//! cannot be foreseen.
//!
//! The value is exactly that of a general parser: digits up to 2^53 and powers of ten up to 10^22 are exact, so one division rounds
//! correctly.

/// `[-]digits[.digits]` with at most 16 characters behind the sign; `None` when it is anything else. A point alone beside one digit is
/// something else.
#[inline]
pub(crate) fn plain_decimal(value: &[u8]) -> Option<f64> {
    // By far the most frequent number: heights and normals.
    if value == b"0.0" {
        return Some(0.0);
    }
    match value.len() {
        3..=WIDTH => short_decimal(value),
        _ => other_decimal(value),
    }
}

/// One of three to eight characters, of which one is a digit in any case. In which of them there is a sign, if there is one, is nothing to branch on.
#[inline]
fn short_decimal(value: &[u8]) -> Option<f64> {
    let is_negative = value.first() == Some(&b'-');
    let sign = u64::from(is_negative) * u64::from(b'-' ^ b'0');
    let digits = Digits::read(value).0 ^ sign << (64 - 8 * value.len());
    let (digits, decimals) = Digits(digits).without_point();
    Some(quotient(digits.number()?, decimals.unwrap_or(0), is_negative))
}

/// One of any other length.
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

/// Eight to sixteen characters as a number without the point, and how many digits are behind that.
fn long_number(text: &[u8]) -> Option<(u64, usize)> {
    let split = text.len().checked_sub(WIDTH).filter(|split| *split <= WIDTH)?;
    let (first, decimals) = Digits::first(*text.first_chunk()?, split).without_point();
    let last = Digits::of(*text.last_chunk()?);
    let (last, scale, decimals) = match (decimals, last.without_point()) {
        (Some(decimals), _) => (last, 100_000_000, decimals + WIDTH),
        (None, (last, Some(decimals))) => (last, 10_000_000, decimals),
        (None, (last, None)) => (last, 100_000_000, 0),
    };
    let number = first.number()? * scale + last.number()?;
    (number <= LARGEST_EXACT).then_some((number, decimals))
}

#[inline]
fn quotient(number: u64, decimals: usize, is_negative: bool) -> f64 {
    let number = number as f64 / POWERS[decimals];
    f64::from_bits(number.to_bits() | u64::from(is_negative) << 63)
}

/// 2^53: up to here all whole numbers have an f64 of their own.
pub(crate) const LARGEST_EXACT: u64 = 1 << 53;

/// How many characters are looked at together.
const WIDTH: usize = 8;

/// The powers of ten that may be needed.
const POWERS: [f64; 2 * WIDTH] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// One in each byte.
const ONES: u64 = u64::from_le_bytes([1; WIDTH]);

/// A zero in each byte.
const ZEROS: u64 = ONES * 0x30;

/// At most eight digits, the last in the highest byte, with zeros before the first. A byte of more than 9 is some other character.
#[derive(Clone, Copy)]
struct Digits(u64);

impl Digits {
    /// Those of three to eight characters.
    #[inline]
    fn read(text: &[u8]) -> Self {
        let half = |characters: [u8; 4]| u64::from(u32::from_le_bytes(characters)) ^ ZEROS >> 32;
        Self(match (text.first_chunk(), text.last_chunk(), text) {
            // Bytes that are in both halves are the same.
            (Some(first), Some(last), _) => half(*first) << (64 - 8 * text.len()) | half(*last) << 32,
            (_, _, [a, b, c]) => half([b'0', *a, *b, *c]) << 32,
            // No number has less.
            _ => u64::MAX,
        })
    }

    /// Those of eight characters.
    #[inline]
    fn of(characters: [u8; WIDTH]) -> Self {
        Self(u64::from_le_bytes(characters) ^ ZEROS)
    }

    /// Those of the first few of eight characters.
    #[inline]
    fn first(characters: [u8; WIDTH], count: usize) -> Self {
        if count == 0 { Self(0) } else { Self(Self::of(characters).0 << (64 - 8 * count)) }
    }

    /// Without the first point, and how many are behind that.
    #[inline]
    fn without_point(self) -> (Self, Option<usize>) {
        let zero_where_point = self.0 ^ (ONES * u64::from(b'.' ^ b'0'));
        // The lowest bit is right, those above may not be.
        let points = zero_where_point.wrapping_sub(ONES) & !zero_where_point & (ONES * 0x80);
        if points == 0 {
            return (self, None);
        }
        let up_to_point = points ^ (points - 1);
        let (before, behind) = (self.0 & up_to_point >> 8, self.0 & !up_to_point);
        (Self(behind | before << 8), Some(WIDTH - 1 - points.trailing_zeros() as usize / 8))
    }

    /// The number that they are.
    #[inline]
    fn number(self) -> Option<u64> {
        let Self(digits) = self;
        let beyond_nine = (digits | digits.wrapping_add(ONES * 0x76)) & (ONES * 0x80);
        // Neighbours are joined, what belongs to no pair falls out at the top: digits to numbers of two, these to numbers of four, these
        // to the whole.
        let twos = (digits.wrapping_mul(1 + (10 << 8)) >> 8) & 0x00FF_00FF_00FF_00FF;
        let fours = (twos.wrapping_mul(1 + (100 << 16)) >> 16) & 0x0000_FFFF_0000_FFFF;
        (beyond_nine == 0).then(|| fours.wrapping_mul(1 + (10_000 << 32)) >> 32)
    }
}
