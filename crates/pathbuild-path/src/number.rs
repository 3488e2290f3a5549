//! Numbers in parameter texts. (spec/30-parameters.md)

/// A number: an optional sign, digits, at most one decimal point or comma. `None` for anything else, exponents included, and for what
/// is too large to be finite.
pub fn parse_number(text: &str) -> Option<f64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let mut marks = 0;
    let mut count = 0;
    for byte in digits.bytes() {
        match byte {
            b'0'..=b'9' => count += 1,
            b'.' | b',' => marks += 1,
            _ => return None,
        }
    }
    if count == 0 || marks > 1 {
        return None;
    }
    let number: f64 = text.replace(',', ".").parse().ok()?;
    number.is_finite().then_some(number)
}

/// A whole number: an optional sign and digits.
pub fn parse_integer(text: &str) -> Option<i64> {
    parse_number(text).filter(|_| !text.contains(['.', ',']))?;
    text.parse().ok()
}
