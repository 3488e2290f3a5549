//! Numbers with three decimals, and with up to six.

use std::fmt::Write;

/// "F3" of the specification: three decimals, ties to even on the exact binary value; what rounds to zero has no sign.
pub fn f3(number: f64) -> String {
    let mut text = String::with_capacity(10);
    push_f3(&mut text, number);
    text
}

/// Not by `{:.3}`: for numbers that lie as near to a thousandth as those of drawings it takes a long division, and that was a quarter of the
/// time of compiling a project.
pub(super) fn push_f3(text: &mut String, number: f64) {
    let Some(thousandths) = thousandths(number) else {
        _ = write!(text, "{number:.3}");
        return;
    };
    if number < 0.0 && thousandths > 0 {
        text.push('-');
    }
    let mut digits = [b'0'; 20];
    let (mut start, mut rest) = (digits.len(), thousandths);
    while rest > 0 || start > digits.len() - 4 {
        start -= 1;
        digits[start] += (rest % 10) as u8;
        rest /= 10;
    }
    let point = digits.len() - 3;
    text.extend(digits[start..point].iter().map(|digit| char::from(*digit)));
    text.push('.');
    text.extend(digits[point..].iter().map(|digit| char::from(*digit)));
}

/// How many thousandths a number is away from zero, ties to even; `None` from 2^53 on, and where it is no number.
fn thousandths(number: f64) -> Option<u64> {
    const FRACTION_BITS: u64 = 52;
    let bits = number.abs().to_bits();
    let (exponent, fraction) = (bits >> FRACTION_BITS, bits & ((1 << FRACTION_BITS) - 1));
    // The number is mantissa / 2^shift.
    let mantissa = if exponent == 0 { fraction } else { fraction | 1 << FRACTION_BITS };
    let shift = (1023 + FRACTION_BITS).checked_sub(exponent.max(1)).filter(|shift| *shift > 0)?;
    // Below 2^63.
    let product = mantissa * 1000;
    if shift > 63 {
        return Some(0);
    }
    let (whole, rest, half) = (product >> shift, product & ((1 << shift) - 1), 1_u64 << (shift - 1));
    let is_up = rest > half || rest == half && whole % 2 == 1;
    Some(whole + u64::from(is_up))
}

/// Six decimals, of which zeros behind the third are left out.
pub(super) fn push_exact(text: &mut String, number: f64) {
    let start = text.len();
    _ = write!(text, "{number:.6}");
    let zeros = text.bytes().rev().take(3).take_while(|byte| *byte == b'0').count();
    text.truncate(text.len() - zeros);
    if &text[start..] == "-0.000" {
        text.remove(start);
    }
}
