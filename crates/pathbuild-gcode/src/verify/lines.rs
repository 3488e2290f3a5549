//! Checks whether two programs have the same moves in the same lines, regardless of anything else.

/// Whether the lines that move the tool are equal in both programs: the same words, with numbers within one unit of the third decimal.
///
/// Comments (including correction formulas), blanks, leading zeros, line breaks, and lines without X, Y or Z are ignored.
pub fn same_move_lines(found: &str, expected: &str) -> bool {
    let (mut found, mut expected) = (moves(found), moves(expected));
    loop {
        match (found.next(), expected.next()) {
            (None, None) => return true,
            (Some(Some(found)), Some(Some(expected))) if same(&found, &expected) => {}
            _ => return false,
        }
    }
}

/// A letter and its number.
type Word = (char, f64);

/// One unit of the last printed digit, plus the error of doubles.
const UNIT: f64 = 0.001 * (1.0 + 1e-6);

/// The words of each line that moves the tool; `None` for a line that cannot be read.
fn moves(text: &str) -> impl Iterator<Item = Option<Vec<Word>>> {
    let is_move = |words: &Option<Vec<Word>>| {
        words.as_ref().is_none_or(|words| words.iter().any(|(letter, _)| matches!(letter, 'X' | 'Y' | 'Z')))
    };
    text.lines().map(words).filter(is_move)
}

fn words(line: &str) -> Option<Vec<Word>> {
    let plain = without_comments(line);
    let mut rest = plain.trim_start_matches('%');
    let mut words = Vec::new();
    while let Some(letter) = rest.chars().next() {
        let digits = &rest[letter.len_utf8()..];
        let end =
            digits.find(|digit: char| !matches!(digit, '0'..='9' | '.' | '+' | '-')).unwrap_or(digits.len());
        words.push((letter.to_ascii_uppercase(), digits[..end].parse().ok()?));
        rest = &digits[end..];
    }
    Some(words)
}

/// A line without blanks, parentheses and text after a semicolon.
fn without_comments(line: &str) -> String {
    let mut plain = String::with_capacity(line.len());
    let mut is_comment = false;
    for character in line.chars() {
        match character {
            '(' => is_comment = true,
            ')' => is_comment = false,
            _ if is_comment => {}
            ';' => break,
            blank if blank.is_whitespace() => {}
            other => plain.push(other),
        }
    }
    plain
}

fn same(found: &[Word], expected: &[Word]) -> bool {
    let same_word = |((a, found), (b, expected)): (&Word, &Word)| {
        let slack = if *a == 'G' { 0.0 } else { UNIT };
        a == b && libm::fabs(found - expected) <= slack
    };
    found.len() == expected.len() && found.iter().zip(expected).all(same_word)
}
