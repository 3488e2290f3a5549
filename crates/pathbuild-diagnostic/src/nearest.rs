//! Suggestions for misspelt names. The distance between two names is that of optimal string alignment: the number of letters to change,
//! insert, remove or swap with a neighbour.

use strsim::osa_distance;

/// Maximum length in bytes of a name that is compared. All known names are shorter, and the cost of a comparison is the product of both
/// lengths.
const MAX_NAME_BYTES: usize = 200;

/// Minimum number of digits of a number in which a typing error is considered. Shorter numbers are mere counters: `3101.2P` follows
/// `3101.1P` and is not a misspelling of it.
const MIN_DIGITS_FOR_TYPO: usize = 3;

/// Returns the known name most similar to a misspelt one: at most a third of its letters (rounded up) differ, and its numbers are the same except
/// for a single typing error. Of several equally similar names, the first is returned.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > MAX_NAME_BYTES {
        return None;
    }
    let numbers = Numbers::of(name);
    let name = name.to_lowercase();
    let length = name.chars().count();
    let (most, own) = (length.div_ceil(3), letters(&name));
    let near = |candidate: &'a str| {
        // Each additional or missing letter is at least one difference.
        if candidate.chars().count().abs_diff(length) > most {
            return None;
        }
        let other = candidate.to_lowercase();
        let others = letters(&other);
        // Each letter that only one of the names contains is at least one difference. This cheap test rejects nearly all names.
        if (own & !others).count_ones().max((others & !own).count_ones()) as usize > most {
            return None;
        }
        let distance = osa_distance(&name, &other);
        (distance <= most && numbers.match_except_for_typo(&Numbers::of(candidate)))
            .then_some((distance, candidate))
    };
    known.into_iter().filter_map(near).min_by_key(|(distance, _)| *distance).map(|(_, candidate)| candidate)
}

/// Whether two names differ by a single typing error: a character changed, added, left out or swapped with its neighbour. Case and leading zeros are
/// ignored. A changed digit does not count as a typing error, because names with different numbers are different names.
pub fn is_typo(name: &str, other: &str) -> bool {
    let plain = |name: &str| {
        let name = name.to_lowercase();
        let parts: Vec<&str> = name.split('.').map(|part| part.trim_start_matches('0')).collect();
        parts.join(".")
    };
    name.len().max(other.len()) <= MAX_NAME_BYTES
        && osa_distance(&plain(name), &plain(other)) <= 1
        && Numbers::of(name).match_except_for_typo(&Numbers::of(other))
}

/// The numbers in a name, in order and without leading zeros.
struct Numbers(Vec<String>);

impl Numbers {
    /// Extracts the numbers from a name. The letter O is read as the digit 0 if it is next to a digit: `31O1` gives 3101.
    fn of(name: &str) -> Self {
        let mut numbers = vec![String::new()];
        let mut letters = name.chars().peekable();
        while let Some(letter) = letters.next() {
            let is_beside_digit = numbers.last().is_some_and(|number| !number.is_empty())
                || letters.peek().is_some_and(char::is_ascii_digit);
            let digit = match letter {
                '0'..='9' => Some(letter),
                'o' | 'O' if is_beside_digit => Some('0'),
                _ => None,
            };
            match (digit, numbers.last_mut()) {
                (Some(digit), Some(number)) => number.push(digit),
                _ => numbers.push(String::new()),
            }
        }
        numbers.retain(|number| !number.is_empty());
        Self(numbers.iter().map(|number| number.trim_start_matches('0').to_owned()).collect())
    }

    /// Whether the numbers are the same, except for a single typing error in one of them.
    fn match_except_for_typo(&self, others: &Self) -> bool {
        if self.0.len() != others.0.len() {
            return self.0.concat() == others.0.concat();
        }
        let mut different = self.0.iter().zip(&others.0).filter(|(number, other)| number != other);
        match (different.next(), different.next()) {
            (None, _) => true,
            (Some((number, other)), None) => is_misspelt(number, other),
            (Some(_), Some(_)) => false,
        }
    }
}

/// Whether two numbers, at least one of them long, differ by one additional digit or by two neighbouring digits that are swapped.
fn is_misspelt(number: &str, other: &str) -> bool {
    let (long, short) = if number.len() < other.len() { (other, number) } else { (number, other) };
    if long.len() < MIN_DIGITS_FOR_TYPO {
        return false;
    }
    let same = long.bytes().zip(short.bytes()).take_while(|(a, b)| a == b).count();
    let (long, short) = (&long.as_bytes()[same..], &short.as_bytes()[same..]);
    match (long, short) {
        ([a, b, rest @ ..], [c, d, other @ ..]) if long.len() == short.len() => (a, b, rest) == (d, c, other),
        ([_, rest @ ..], short) => rest == short,
        ([], _) => false,
    }
}

/// Returns the set of letters in a name as bits. Several letters may share a bit.
fn letters(name: &str) -> u32 {
    name.chars().fold(0, |found, letter| found | 1 << (u32::from(letter) % 32))
}

#[cfg(test)]
mod tests {
    use super::{is_typo, nearest};

    #[test]
    fn a_slip_finds_the_word() {
        let known = ["toolchange", "tooltable", "spindle"];
        assert_eq!(nearest("toolchnage", known), Some("toolchange"));
        assert_eq!(nearest("Spindel", known), Some("spindle"));
        assert_eq!(nearest("coolant", known), None);
    }

    #[test]
    fn a_neighbour_in_a_numbering_is_no_slip() {
        for other in ["3101.1P", "3101.22P", "3102.2P", "3111.2P", "31011.1P"] {
            assert!(!is_typo("3101.2P", other), "{other}");
            assert_eq!(nearest("3101.2P", [other]), None, "{other}");
        }
        for other in [
            "3101.02P", "3101.2Q", "3101.2p", "311.2P", "3011.2P", "31101.2P", "31O1.2P", "31012P", "3101,2P",
        ] {
            assert!(is_typo("3101.2P", other), "{other}");
            assert_eq!(nearest("3101.2P", [other]), Some(other));
        }
        assert_eq!(nearest("PB599", ["PB509", "PB590"]), None);
        assert_eq!(nearest("PB5O9", ["PB509", "PB590"]), Some("PB509"));
    }
}
