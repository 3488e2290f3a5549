//! Numbers in parameter texts. (book: language/letters)

/// Parses a number: an optional sign, digits, and at most one decimal point or comma. `None` for anything else, including exponents, and
/// for numbers that are too large.
pub fn parse_number(text: &str) -> Option<f64> {
    let (is_negative, digits) = match text.as_bytes() {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] | digits => (false, digits),
    };
    let (mut value, mut count, mut point) = (0_u64, 0, None);
    for byte in digits {
        match byte {
            b'0'..=b'9' => {
                value = value.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
                count += 1;
            }
            b'.' | b',' if point.is_none() => point = Some(count),
            _ => return None,
        }
    }
    if count == 0 {
        return None;
    }
    if count <= MOST_DIGITS {
        // Both operands are exact, so the quotient is the number nearest to the decimal notation.
        let decimals = point.map_or(0, |before| count - before);
        let number = value as f64 / POWERS_OF_TEN[decimals];
        return Some(if is_negative { -number } else { number });
    }
    let number: f64 = text.replace(',', ".").parse().ok()?;
    number.is_finite().then_some(number)
}

/// Maximum number of digits for the fast path: whole numbers of this length are exact in f64.
const MOST_DIGITS: usize = 15;

const POWERS_OF_TEN: [f64; MOST_DIGITS + 1] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// Parses an integer: an optional sign and digits.
pub fn parse_integer(text: &str) -> Option<i64> {
    text.parse().ok()
}
