//! Formats numbers in statements. (book: reference/post-definitions)

use std::str::FromStr;

use pathbuild_diagnostic::Text;

use crate::number::NumberFormat;

/// A number format, selected by the character after the brace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// All decimals that the number has, and no more.
    Shortest,
    /// `'`: two decimals and a thousands separator.
    Currency,
    /// `%`, `.`: rounded to the definition's decimals.
    Rounded,
    /// `,`: rounded, with a decimal comma.
    Comma,
    /// `+`: rounded, always with a sign.
    Signed,
    /// `&`: rounded, always with a sign and with a decimal comma.
    SignedComma,
    /// `#`: an integer.
    Whole,
    /// The C formats `f`, `g`, `d`, `x`, `b` and `s`.
    C(CForm),
}

/// A C format. Flags, width and precision are an extension of pathbuild, because their notation in CAD6 is unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CForm {
    /// Whether blanks are added on the right instead of the left.
    left: bool,
    /// Whether zeros are added instead of blanks.
    zeros: bool,
    width: usize,
    precision: Option<usize>,
    letter: char,
}

macro_rules! forms {
    ($($sign:literal $form:ident $en:literal, $de:literal;)*) => {
        /// The format characters with their meanings, for the book.
        pub(super) static FORMS: &[(char, Form, Text)] = &[$(($sign, Form::$form, Text { en: $en, de: $de }),)*];
    };
}

forms! {
    '\'' Currency "two decimals, with a thousands separator", "zwei Nachkommastellen, mit Tausendertrennzeichen";
    '%' Rounded "rounded to `decimals`", "gerundet auf `decimals`";
    '.' Rounded "rounded to `decimals`", "gerundet auf `decimals`";
    ',' Comma "rounded, with a decimal comma", "gerundet, mit Dezimalkomma";
    '+' Signed "rounded, always with a sign", "gerundet, immer mit Vorzeichen";
    '&' SignedComma "rounded, always with a sign, with a decimal comma", "gerundet, immer mit Vorzeichen, mit Dezimalkomma";
    '#' Whole "whole", "ganze Zahl";
}

/// Maximum width and precision of a C format in characters. Greater numbers are taken for typing errors.
const MAX_WIDTH: usize = 64;

impl Form {
    pub(super) fn of(character: char) -> Option<Self> {
        FORMS.iter().find(|(sign, ..)| *sign == character).map(|(_, form, _)| *form)
    }

    /// Formats a finite number, rounding it to `decimals` where the format requires it. Returns `None` if the format does not apply to the
    /// number, as hexadecimal digits do not apply to a fraction.
    pub(super) fn write(self, value: f64, decimals: usize) -> Option<String> {
        let rounded = || NumberFormat::decimals(0, decimals).format(value);
        Some(match self {
            Self::Shortest => shortest_text(value),
            Self::Currency => currency(value),
            Self::Rounded => rounded(),
            Self::Comma => rounded().replace('.', ","),
            Self::Signed => signed(rounded()),
            Self::SignedComma => signed(rounded()).replace('.', ","),
            Self::Whole => NumberFormat::decimals(0, 0).format(value),
            Self::C(form) => return form.write(value),
        })
    }
}

/// Converts the value to an integer; `None` unless it is an integer of at most 2^53, up to which an `f64` is exact.
pub(super) fn bits(value: f64) -> Option<i64> {
    #[expect(clippy::cast_possible_truncation, reason = "the range is checked")]
    (value.fract() == 0.0 && value.abs() <= 9_007_199_254_740_992.0).then_some(value as i64)
}

/// Returns the shortest text that parses to the same number.
pub(super) fn shortest_text(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { value.to_string() }
}

fn signed(text: String) -> String {
    if text.starts_with('-') { text } else { format!("+{text}") }
}

fn currency(value: f64) -> String {
    let text = NumberFormat::decimals(2, 2).format(value);
    let (sign, digits) = text.strip_prefix('-').map_or(("", text.as_str()), |digits| ("-", digits));
    let (whole, decimals) = digits.split_once('.').unwrap_or((digits, "00"));
    let mut grouped = String::new();
    for (index, digit) in whole.chars().enumerate() {
        if index > 0 && (whole.len() - index) % 3 == 0 {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    format!("{sign}{grouped}.{decimals}")
}

impl CForm {
    fn write(self, value: f64) -> Option<String> {
        let precision = self.precision.unwrap_or(6);
        let text = match self.letter {
            'f' => NumberFormat::decimals(precision, precision).format(value),
            'g' => format!("{value:.precision$e}"),
            'd' => NumberFormat::decimals(0, 0).format(value),
            'x' => format!("{:x}", u64::try_from(bits(value)?).ok()?),
            'b' => format!("{:b}", u64::try_from(bits(value)?).ok()?),
            _ => shortest_text(value),
        };
        Some(self.pad(&text))
    }

    /// Returns the number of blanks to write before and after a text of `length` characters, or `None` if this is not a format for texts.
    pub(super) fn blanks(self, length: usize) -> Option<[usize; 2]> {
        let fill = self.width.saturating_sub(length);
        (self.letter == 's').then_some(if self.left { [0, fill] } else { [fill, 0] })
    }

    fn pad(self, text: &str) -> String {
        let fill = self.width.saturating_sub(text.len());
        match (self.left, self.zeros, text.strip_prefix('-')) {
            (true, ..) => format!("{text}{}", " ".repeat(fill)),
            (_, true, Some(digits)) => format!("-{}{digits}", "0".repeat(fill)),
            (_, true, None) => format!("{}{text}", "0".repeat(fill)),
            (_, false, _) => format!("{}{text}", " ".repeat(fill)),
        }
    }
}

/// Parses `[-][0][width][.precision]letter`.
impl FromStr for CForm {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let letter =
            text.chars().next_back().filter(|c| matches!(c, 'f' | 'g' | 'd' | 'x' | 'b' | 's')).ok_or(())?;
        let rest = &text[..text.len() - 1];
        let (left, rest) = rest.strip_prefix('-').map_or((false, rest), |rest| (true, rest));
        let (zeros, rest) = rest.strip_prefix('0').map_or((false, rest), |rest| (true, rest));
        let (width, precision) = match rest.split_once('.') {
            Some((width, precision)) => (width, Some(precision)),
            None => (rest, None),
        };
        let count = |text: &str| text.parse().ok().filter(|count| *count <= MAX_WIDTH).ok_or(());
        let width = if width.is_empty() { 0 } else { count(width)? };
        Ok(Self { left, zeros, width, precision: precision.map(count).transpose()?, letter })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(form: char, value: f64) -> String {
        Form::of(form).unwrap().write(value, 2).unwrap()
    }

    #[test]
    fn rounding_drops_trailing_zeros() {
        assert_eq!(write('.', 50.0), "50");
        assert_eq!(write('%', 1.005), "1.01");
        assert_eq!(write(',', -160.508_6), "-160,51");
    }

    #[test]
    fn signs_are_always_written_on_demand() {
        assert_eq!(write('+', 50.0), "+50");
        assert_eq!(write('&', 1.5), "+1,5");
        assert_eq!(write('+', -0.001), "+0", "never minus zero");
    }

    #[test]
    fn whole_numbers_are_rounded_half_away_from_zero() {
        assert_eq!(write('#', 2.5), "3");
        assert_eq!(write('#', -2.5), "-3");
        assert_eq!(write('#', -0.4), "0");
    }

    #[test]
    fn money_has_two_decimals_and_groups() {
        assert_eq!(write('\'', 1_234_567.5), "1,234,567.50");
        assert_eq!(write('\'', -999.0), "-999.00");
    }

    #[test]
    fn forms_as_in_c() {
        let write = |form: &str, value| Form::C(form.parse().unwrap()).write(value, 2);
        assert_eq!(write("f", 1.5).unwrap(), "1.500000");
        assert_eq!(write("8.2f", -1.5).unwrap(), "   -1.50");
        assert_eq!(write("05d", -42.4).unwrap(), "-0042");
        assert_eq!(write("-5d", 42.0).unwrap(), "42   ");
        assert_eq!(write(".2g", 1234.0).unwrap(), "1.23e3");
        assert_eq!(write("x", 255.0).unwrap(), "ff");
        assert_eq!(write("b", 5.0).unwrap(), "101");
        assert_eq!(write("s", 0.1).unwrap(), "0.1");
        assert_eq!(write("x", 1.5), None);
        assert_eq!("65f".parse::<CForm>(), Err(()));
        assert_eq!("q".parse::<CForm>(), Err(()));
    }
}
