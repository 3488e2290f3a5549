//! Reads the numbers of parameter texts. (book: language/parameter-texts)

/// Parses a number: an optional sign, digits, and at most one decimal point or comma. `None` for anything else, including exponents, and
/// for numbers that are too large.
pub fn parse_number(text: &str) -> Option<f64> {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    // `parse` would also accept exponents, `inf` and `nan`.
    if !digits.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'.' | b',')) {
        return None;
    }
    let number: f64 = text.replace(',', ".").parse().ok()?;
    number.is_finite().then_some(number)
}

/// Parses an integer: an optional sign and digits.
pub fn parse_integer(text: &str) -> Option<i64> {
    text.parse().ok()
}
