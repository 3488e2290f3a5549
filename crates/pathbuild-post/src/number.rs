//! Formats numbers by patterns of `0` and `#` as in .NET, rounding halves away from zero.

use std::str::FromStr;

/// A number pattern such as `0.0###`: a `0` is a digit that is always shown, and a `#` is one that is shown if needed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct NumberFormat {
    /// Minimum number of digits before the decimal point.
    whole: usize,
    /// Minimum number of digits after the decimal point.
    least: usize,
    /// Maximum number of digits after the decimal point.
    most: usize,
}

/// An option of a definition, for messages: the one that determines how numbers are written, or how far lines may be from the arc that they replace.
#[derive(Debug)]
pub(crate) struct StatedOption {
    pub(crate) name: &'static str,
    /// Value of the option in the file, or its default.
    pub(crate) value: String,
    /// Line and column in the definition's file, if the option is in it.
    pub(crate) line: Option<u32>,
    pub(crate) column: Option<u32>,
}

/// Maximum number of digits on either side of the decimal point. No control reads more, and an `f64` has no more.
const MAX_DIGITS: usize = 15;

impl NumberFormat {
    /// Creates a pattern with at least one digit before the decimal point, and `least` to `most` digits after it.
    pub(crate) const fn decimals(least: usize, most: usize) -> Self {
        Self { whole: 1, least, most }
    }

    pub(crate) fn most_decimals(self) -> u8 {
        u8::try_from(self.most).unwrap_or(u8::MAX)
    }

    /// Whether every number gets a decimal point, whole ones too.
    pub(crate) fn always_has_point(self) -> bool {
        self.least > 0
    }

    /// Formats a number. Zero never has a minus sign.
    pub(crate) fn format(self, value: f64) -> String {
        let digits = digits(value, self.most);
        let digits = format!("{digits:0>width$}", width = self.whole + self.most);
        let (whole, decimals) = digits.split_at(digits.len() - self.most);
        let sign = if value < 0.0 && digits.contains(|digit| digit != '0') { "-" } else { "" };
        let mut text = format!("{sign}{whole}");
        let needed = decimals.trim_end_matches('0').len().max(self.least);
        if needed > 0 {
            text.push('.');
            text.push_str(&decimals[..needed]);
        }
        if text.is_empty() { "0".to_owned() } else { text }
    }

    /// Rounds a number to the value that its formatted text has.
    pub(crate) fn round(self, value: f64) -> f64 {
        self.format(value).parse().unwrap_or(value)
    }
}

impl FromStr for NumberFormat {
    type Err = ();

    fn from_str(pattern: &str) -> Result<Self, ()> {
        let (whole, decimals) = pattern.split_once('.').unwrap_or((pattern, ""));
        let is_pattern =
            |part: &str| part.len() <= MAX_DIGITS && part.chars().all(|c| matches!(c, '0' | '#'));
        if pattern.is_empty() || !is_pattern(whole) || !is_pattern(decimals) {
            return Err(());
        }
        Ok(Self {
            whole: whole.find('0').map_or(0, |first| whole.len() - first),
            least: decimals.rfind('0').map_or(0, |last| last + 1),
            most: decimals.len(),
        })
    }
}

/// Returns the digits of a number up to this many decimals, without leading zeros; empty if they are all zero.
///
/// The number is first limited to fifteen significant digits, so that numbers meant to end in 5 (1.0005) are rounded as such, and the
/// noise of converting between inches and millimetres disappears.
fn digits(value: f64, decimals: usize) -> String {
    let text = format!("{:.14e}", value.abs());
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let mantissa: u64 = mantissa.replace('.', "").parse().unwrap_or(0);
    let places = exponent.parse::<i32>().unwrap_or(0) - 14 + i32::try_from(decimals).unwrap_or(i32::MAX);
    let digits = match u32::try_from(places) {
        Ok(zeros) => format!("{mantissa}{}", "0".repeat(zeros as usize)),
        // If the unit of the last place exceeds a `u64`, all digits are rounded off.
        Err(_) => match 10_u64.checked_pow(places.unsigned_abs()) {
            Some(unit) => ((mantissa + unit / 2) / unit).to_string(),
            None => String::new(),
        },
    };
    digits.trim_start_matches('0').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn format(pattern: &str, value: f64) -> String {
        pattern.parse::<NumberFormat>().unwrap().format(value)
    }

    #[test]
    fn decimals_are_rounded_not_cut() {
        assert_eq!(format("0.0###", 5.669_873), "5.6699");
        assert_eq!(format("0.0###", 5.0), "5.0");
        assert_eq!(format("0.0###", 9.999_96), "10.0");
    }

    #[test]
    fn ties_go_away_from_zero() {
        assert_eq!(format("0.00", 1.375), "1.38");
        assert_eq!(format("0.00", -1.375), "-1.38");
        assert_eq!(format("0.000", 1.0005), "1.001", "although its binary value is below the tie");
        assert_eq!(format("0.000", 1.000_499), "1.000");
    }

    #[test]
    fn zero_is_never_negative() {
        assert_eq!(format("0.0###", -0.000_01), "0.0");
        assert_eq!(format("0.0###", -0.0), "0.0");
        assert_eq!(format("0.0###", -0.000_05), "-0.0001");
    }

    #[test]
    fn zeros_of_the_pattern_are_always_shown() {
        assert_eq!(format("0000", 40.0), "0040");
        assert_eq!(format("0000.00", 1.5), "0001.50");
        assert_eq!(format("0", 12345.0), "12345");
    }

    #[test]
    fn sharps_are_shown_when_needed() {
        assert_eq!(format("#.#0", 0.5), ".50");
        assert_eq!(format("#.#0", 12.345), "12.35");
        assert_eq!(format("#.##", 0.0), "0", "a word without a number would be worse");
        assert_eq!(format("#.##", -0.25), "-.25");
    }

    #[test]
    fn large_and_tiny_numbers_keep_their_magnitude() {
        assert_eq!(format("0.0", 1e20), "100000000000000000000.0");
        assert_eq!(format("0.0##", 1e-30), "0.0");
        assert_eq!(format("0.0##", 0.000_5), "0.001");
    }

    #[test]
    fn a_pattern_of_anything_else_is_refused() {
        for pattern in ["", "0,0", "0.0.0", "+0.0", "0.0000000000000000"] {
            assert_eq!(pattern.parse::<NumberFormat>(), Err(()), "{pattern}");
        }
    }
}
