//! Numbers with three decimals, and with up to six.

use std::fmt::Write;

/// "F3" of the specification: three decimals, ties to even on the exact binary value; what rounds to zero has no sign.
pub fn f3(number: f64) -> String {
    let mut text = String::with_capacity(10);
    push_f3(&mut text, number);
    text
}

pub(super) fn push_f3(text: &mut String, number: f64) {
    let start = text.len();
    _ = write!(text, "{number:.3}");
    if &text[start..] == "-0.000" {
        text.remove(start);
    }
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
