//! Formats numbers with three decimals, or with up to six.

use std::fmt::Write;

/// The format "F3" of the specification: three decimals, rounding the exact binary value with ties to even. Zero has no sign.
pub fn f3(number: f64) -> String {
    let mut text = String::with_capacity(10);
    push_f3(&mut text, number);
    text
}

/// Appends a number. `{:.3}` takes a long division for numbers as close to a thousandth as those of drawings, which was a quarter of the
/// time
/// for compiling a project.
pub(super) fn push_f3(text: &mut String, number: f64) {
    let Some(thousandths) = thousandths(number) else {
        _ = write!(text, "{number:.3}");
        return;
    };
    if number < 0.0 && thousandths > 0 {
        text.push('-');
    }
    let (whole, fraction) = (thousandths / 1000, place(thousandths % 1000));
    if whole < 1000 {
        let digits = 1 + usize::from(whole > 9) + usize::from(whole > 99);
        let end = place(whole) + 4;
        text.push_str(&THOUSANDTHS[end - digits..end]);
    } else {
        _ = write!(text, "{whole}");
    }
    text.push_str(&THOUSANDTHS[fraction..fraction + 4]);
}

/// The number represented by the printed text.
pub(super) fn printed(number: f64) -> f64 {
    let rounded = |thousandths: u64| (thousandths as f64 / 1000.0).copysign(number) + 0.0;
    thousandths(number).map_or(number, rounded)
}

/// `.000.001.002` and so on to `.999`, so that neither the digits after the point nor those before it have to be computed.
static THOUSANDTHS: &str = match str::from_utf8(&all_thousandths()) {
    Ok(text) => text,
    Err(_) => "",
};

#[expect(clippy::cast_possible_truncation, reason = "digits")]
const fn all_thousandths() -> [u8; 4000] {
    let mut text = [b'.'; 4000];
    let mut number = 0;
    while number < 1000 {
        text[4 * number + 1] = b'0' + (number / 100) as u8;
        text[4 * number + 2] = b'0' + (number / 10 % 10) as u8;
        text[4 * number + 3] = b'0' + (number % 10) as u8;
        number += 1;
    }
    text
}

/// Offset of a number below a thousand in that text, with its point.
#[expect(clippy::cast_possible_truncation, reason = "below 4000")]
fn place(number: u64) -> usize {
    4 * number as usize
}

/// The absolute value in thousandths, with ties to even; `None` for 2^53 and above, and if it is not finite.
fn thousandths(number: f64) -> Option<u64> {
    const FRACTION_BITS: u64 = 52;
    let bits = number.abs().to_bits();
    let (exponent, fraction) = (bits >> FRACTION_BITS, bits & ((1 << FRACTION_BITS) - 1));
    // The number is mantissa / 2^shift.
    let mantissa = if exponent == 0 { fraction } else { fraction | 1 << FRACTION_BITS };
    let shift = (1023 + FRACTION_BITS).checked_sub(exponent.max(1)).filter(|shift| *shift > 0)?;
    // The product is less than 2^63.
    let product = mantissa * 1000;
    if shift > 63 {
        return Some(0);
    }
    let (whole, rest, half) = (product >> shift, product & ((1 << shift) - 1), 1_u64 << (shift - 1));
    let is_up = rest > half || rest == half && whole % 2 == 1;
    Some(whole + u64::from(is_up))
}

/// Appends a number with six decimals, without trailing zeros after the third.
pub(crate) fn push_exact(text: &mut String, number: f64) {
    let start = text.len();
    _ = write!(text, "{number:.6}");
    let zeros = text.bytes().rev().take(3).take_while(|byte| *byte == b'0').count();
    text.truncate(text.len() - zeros);
    if &text[start..] == "-0.000" {
        text.remove(start);
    }
}
