//! Plain decimals, which nearly all numbers of a drawing are: eight characters at once, since how many there are and where the point is
//! cannot be foreseen.
//!
//! The value is exactly that of a general parser: digits up to 2^53 and powers of ten up to 10^22 are exact, so one division rounds
//! correctly.

/// `[-]digits[.digits]` with at most 16 characters behind the sign; `None` when it is anything else.
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
    let is_negative = u64::from(value.first() == Some(&b'-'));
    let sign = (is_negative * u64::from(b'-' ^ b'0')) << (64 - 8 * value.len());
    let (digits, decimals) = without_point(right_aligned(value) ^ sign);
    let number = eight_digits(digits)? as f64 / POWERS[decimals.unwrap_or(0)];
    Some(f64::from_bits(number.to_bits() | is_negative << 63))
}

/// One of any other length.
fn other_decimal(value: &[u8]) -> Option<f64> {
    let (is_negative, text) = match value {
        [b'-', text @ ..] => (true, text),
        text => (false, text),
    };
    let Digits { number, decimals } = match text.len() {
        // A point alone is no number.
        1 if text == b"." => return None,
        1..=WIDTH => Digits::read(text)?,
        _ => Digits::read_long(text)?,
    };
    let number = number as f64 / POWERS[decimals.unwrap_or(0)];
    Some(if is_negative { -number } else { number })
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

/// What some digits say, among which there may be a point.
#[derive(Clone, Copy)]
struct Digits {
    /// The number without the point.
    number: u64,
    /// How many are behind the point.
    decimals: Option<usize>,
}

impl Digits {
    /// Reads at most eight characters.
    #[inline]
    fn read(text: &[u8]) -> Option<Self> {
        let (digits, decimals) = without_point(right_aligned(text));
        Some(Self { number: eight_digits(digits)?, decimals })
    }

    /// Reads nine to sixteen characters.
    fn read_long(text: &[u8]) -> Option<Self> {
        let split = text.len().checked_sub(WIDTH).filter(|split| (1..=WIDTH).contains(split))?;
        let (first, last) = (Self::read(&text[..split])?, Self::read(&text[split..])?);
        let (scale, decimals) = match (first.decimals, last.decimals) {
            (None, None) => (100_000_000, None),
            (Some(decimals), None) => (100_000_000, Some(decimals + WIDTH)),
            (None, Some(decimals)) => (10_000_000, Some(decimals)),
            (Some(_), Some(_)) => return None,
        };
        let number = first.number * scale + last.number;
        (number <= LARGEST_EXACT).then_some(Self { number, decimals })
    }
}

/// At most eight characters, the last in the highest byte, with zeros before the first.
#[inline]
fn right_aligned(text: &[u8]) -> u64 {
    let bits = 8 * text.len();
    // Bytes that are in both halves are the same.
    let word = match (text.first_chunk::<4>().zip(text.last_chunk::<4>()), text) {
        (Some((first, last)), _) => {
            u64::from(u32::from_le_bytes(*first)) << (64 - bits) | u64::from(u32::from_le_bytes(*last)) << 32
        }
        (None, [a, b, c]) => u64::from(*a) << 40 | u64::from(*b) << 48 | u64::from(*c) << 56,
        (None, [a, b]) => u64::from(*a) << 48 | u64::from(*b) << 56,
        (None, [a]) => u64::from(*a) << 56,
        _ => 0,
    };
    word | (ONES * 0x30).checked_shr(u32::try_from(bits).unwrap_or(64)).unwrap_or(0)
}

/// The characters without the first point, and how many are behind it.
#[inline]
fn without_point(text: u64) -> (u64, Option<usize>) {
    let zero_where_point = text ^ (ONES * u64::from(b'.'));
    // The lowest bit is right, those above may not be.
    let points = zero_where_point.wrapping_sub(ONES) & !zero_where_point & (ONES * 0x80);
    if points == 0 {
        return (text, None);
    }
    let bits = points.trailing_zeros() & !7;
    let before = text & ((1 << bits) - 1);
    let behind = text & (!0xFF << bits);
    (behind | before << 8 | u64::from(b'0'), Some(WIDTH - 1 - bits as usize / 8))
}

/// The number that these characters are, if all are digits.
#[inline]
fn eight_digits(text: u64) -> Option<u64> {
    let digits = text ^ (ONES * 0x30);
    let beyond_nine = (digits | digits.wrapping_add(ONES * 0x76)) & (ONES * 0x80);
    // Neighbours are joined, what belongs to no pair falls out at the top: digits to numbers of two, these to numbers of four, these to
    // the whole.
    let twos = (digits.wrapping_mul(1 + (10 << 8)) >> 8) & 0x00FF_00FF_00FF_00FF;
    let fours = (twos.wrapping_mul(1 + (100 << 16)) >> 16) & 0x0000_FFFF_0000_FFFF;
    (beyond_nine == 0).then(|| fours.wrapping_mul(1 + (10_000 << 32)) >> 32)
}
