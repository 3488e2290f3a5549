//! Formats numbers in the conventions of a language.

use pathbuild_diagnostic::{Lang, in_prose};

/// Formats a count with thousands separators: `2,014`, in German `2.014`.
pub(crate) fn count(number: usize, lang: Lang) -> String {
    let separator = match lang {
        Lang::En => ',',
        Lang::De => '.',
    };
    let digits = number.to_string();
    let mut grouped = String::with_capacity(digits.len() + digits.len() / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            grouped.push(separator);
        }
        grouped.push(digit);
    }
    grouped
}

/// Formats a count with its noun: `1 path`, `2,014 paths`.
pub(crate) fn counted(number: usize, lang: Lang, [one, many]: [&str; 2]) -> String {
    format!("{} {}", count(number, lang), if number == 1 { one } else { many })
}

/// Formats a number with up to `places` decimals and without trailing zeros: `12.5`, in German `12,5`.
pub(crate) fn decimal(number: f64, places: usize, lang: Lang) -> String {
    let text = format!("{number:.places$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    // A small negative number is rounded to -0.
    let text = if text == "-0" { "0" } else { text };
    in_prose(text.to_owned(), lang)
}
