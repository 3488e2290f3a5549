use std::fmt;
use std::hash::{Hash, Hasher};

use serde::{Deserialize, Serialize};

use crate::Lang;

/// An `f64` that can be compared exactly and hashed, so that values containing it are `Eq`.
///
/// Equality is bitwise, except that -0 equals 0. It is deliberately exact: whether two coordinates of a drawing coincide is decided by the
/// approximate comparisons of book: reference/glossary, never by this type.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Number(pub f64);

impl Number {
    fn bits(self) -> u64 {
        if self.0 == 0.0 { 0 } else { self.0.to_bits() }
    }
}

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        Self(value)
    }
}

impl Number {
    /// The number with enough decimals to distinguish it from the other numbers in a sentence, to avoid "8 mm is greater than 8".
    pub(crate) fn apart_from(self, others: impl Iterator<Item = Self>) -> String {
        let shown = self.to_string();
        let equal: Vec<Self> = others.filter(|other| *other != self && other.to_string() == shown).collect();
        let with = |number: Self, decimals: usize| format!("{:.decimals$}", number.0);
        let is_apart =
            |decimals: &usize| equal.iter().all(|other| with(*other, *decimals) != with(self, *decimals));
        let decimals = (4..=MOST_DECIMALS).find(is_apart).filter(|_| !equal.is_empty());
        decimals.map_or(shown, |decimals| trimmed(&with(self, decimals)).to_owned())
    }

    /// The number in a sentence: `0.5`, or `0,5` in German.
    pub fn prose(self, lang: Lang) -> String {
        in_prose(self.to_string(), lang)
    }
}

/// Maximum number of decimals; smaller differences have no practical meaning.
const MOST_DECIMALS: usize = 9;

/// Decimals without trailing zeros.
fn trimmed(decimals: &str) -> &str {
    decimals.trim_end_matches('0').trim_end_matches('.')
}

/// A number in a sentence or table. Coordinates, parameters and G-code keep their decimal point in any language, since they are typed back.
pub fn in_prose(number: String, lang: Lang) -> String {
    match lang {
        Lang::En => number,
        Lang::De => number.replace('.', ","),
    }
}

impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.bits() == other.bits()
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.bits().hash(state);
    }
}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Number {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        f64::from_bits(self.bits()).total_cmp(&f64::from_bits(other.bits()))
    }
}

/// Displays at most three decimals without trailing zeros, the precision of a drawing. Very small values that would appear as 0, such as a
/// gap of 0.0004 mm, are displayed with two significant digits.
impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.0;
        if value != 0.0 && value.abs() < 0.0005 {
            let mut scaled = value.abs();
            let first_digit = (1..MOST_DECIMALS).find(|_| {
                scaled *= 10.0;
                scaled >= 1.0
            });
            return match first_digit {
                Some(places) => f.write_str(trimmed(&format!("{value:.*}", places + 1))),
                None => write!(f, "{value:.1e}"),
            };
        }
        let text = format!("{value:.3}");
        let text = trimmed(&text);
        f.write_str(if text == "-0" { "0" } else { text })
    }
}
