//! Parses the lines of a post's output into words, and compares the lines of two programs.

/// A letter and its number in a line of output. Lines are parsed leniently: anything that is not a word is skipped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Word {
    /// The letter in upper case.
    pub(crate) letter: char,
    pub(crate) number: f64,
}

#[derive(Debug, Default, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub(crate) struct LineWords {
    pub(crate) words: Vec<Word>,
    /// The first text, up to the next blank, other than words, comments, `%`, `/` and `:`.
    pub(crate) foreign: Option<String>,
    /// Whether the line begins with `/`, possibly after its number, so that a switch at the machine (block delete) can skip it.
    pub(crate) is_optional: bool,
    /// Whether the line begins with `%`, possibly after its number.
    pub(crate) is_percent: bool,
    /// Whether a `%` follows other words than the line's number.
    pub(crate) has_percent_behind_words: bool,
    /// The line number, or the sign or text with which it begins, if that is not N. Some controls read `:` as the letter O.
    pub(crate) unusual_number_prefix: Option<String>,
    /// The first sign of a parameter or an expression: `#` or `[`.
    pub(crate) formula: Option<char>,
    /// The names in front of `=`, as in `Z=-5` or `RNDM=5`, without their numbers.
    pub(crate) assigned: Vec<String>,
    /// Whether a comment that begins with `(` has no `)`.
    pub(crate) is_comment_open: bool,
}

/// The marks that begin and end a comment. If the end mark is empty, comments extend to the end of the line.
#[derive(Clone, Debug, Default)]
pub(crate) struct CommentMarks {
    pub(crate) open: String,
    pub(crate) close: String,
}

pub(crate) fn words(line: &str, marks: &CommentMarks) -> LineWords {
    let mut found = LineWords::default();
    let line = line.trim();
    let mut rest = line;
    while let Some(first) = rest.chars().next() {
        rest = if let Some(after) = after_comment(rest, marks) {
            found.is_comment_open |= first == '(' && !rest.contains(')');
            after
        } else if let Some((word, after)) = word(rest) {
            found.words.push(word);
            after
        } else {
            let is_first = found.foreign.is_none() && found.words.iter().all(|word| word.letter == 'N');
            found.is_optional |= first == '/' && is_first;
            found.is_percent |= first == '%' && is_first;
            found.has_percent_behind_words |= first == '%' && !is_first && found.foreign.is_none();
            if first == ':' && is_first {
                found.unusual_number_prefix = Some(first.to_string());
            }
            let name = if first == '=' { name_at_end(&line[..line.len() - rest.len()]) } else { "" };
            found.assigned.extend((!name.is_empty()).then(|| name.to_owned()));
            found.formula = found.formula.or(Some(first).filter(|sign| matches!(sign, '#' | '[')));
            if found.foreign.is_none() && !matches!(first, '%' | '/' | ':' | ' ' | '\t') {
                found.foreign = rest.split([' ', '\t']).next().map(str::to_owned);
            }
            let after = &rest[first.len_utf8()..];
            // `:10` is a block number.
            if first == ':' { after.trim_start_matches(|c: char| c.is_ascii_digit()) } else { after }
        };
    }
    found
}

/// Returns the letters of the name at the end of a text, as `Z` of `G0 Z` and `R` of `R10 `. A number such as GRBL's `$32` is no name.
fn name_at_end(text: &str) -> &str {
    let text = text.trim_end().trim_end_matches(|c: char| c.is_ascii_digit());
    let start = text.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '_').len();
    &text[start..]
}

impl CommentMarks {
    /// Returns the length of the comment mark at the beginning of a text, and the mark that ends the comment. Both the definition's marks
    /// and the usual ones are recognised.
    pub(crate) fn opening_mark(&self, text: &str) -> Option<(usize, &str)> {
        let own = (self.open.as_str(), self.close.as_str());
        let (open, close) = [own, ("(", ")"), (";", "")]
            .into_iter()
            .find(|(open, _)| !open.is_empty() && text.starts_with(open))?;
        Some((open.len(), close))
    }
}

/// Returns the number, from 1, of the first line in which a program differs from the expected one, and the expected line.
///
/// Empty lines are ignored. Comment lines are ignored too, even if they are numbered, but only if their opening mark also opens a comment line of the expected program, because
/// another control may execute what looks like a comment.
pub(crate) fn first_other_line(found: &[u8], expected: &[u8], marks: &CommentMarks) -> Option<(u32, String)> {
    let (found, expected) = (String::from_utf8_lossy(found), String::from_utf8_lossy(expected));
    let openings: Vec<&str> = expected.lines().filter_map(|line| opening(line, marks)).collect();
    let lines = |text: &str| -> Vec<(u32, String)> {
        let numbered = (1_u32..).zip(text.split('\n').map(str::trim_end));
        let is_code = |line: &str| {
            !line.is_empty() && opening(line, marks).is_none_or(|opening| !openings.contains(&opening))
        };
        numbered.filter(|(_, line)| is_code(line)).map(|(number, line)| (number, line.to_owned())).collect()
    };
    let (found, expected) = (lines(&found), lines(&expected));
    let same =
        found.iter().zip(&expected).take_while(|((_, found), (_, expected))| found == expected).count();
    if same == found.len() && same == expected.len() {
        return None;
    }
    let line = found.get(same).or(found.last()).map_or(1, |(line, _)| *line);
    Some((line, expected.get(same).map(|(_, text)| text.clone()).unwrap_or_default()))
}

/// Returns the opening mark of a line that consists of a comment; `None` for any other line. A line that contains a CR is not a comment,
/// because a control may end the line at the CR.
fn opening<'l>(line: &'l str, marks: &CommentMarks) -> Option<&'l str> {
    let line = without_number(line.trim());
    let found = words(line, marks);
    let is_comment = found.words.is_empty() && found.foreign.is_none() && !line.contains('\r');
    let (length, _) = marks.opening_mark(line).filter(|_| is_comment)?;
    Some(&line[..length])
}

/// Returns a line without the N that numbers it.
fn without_number(line: &str) -> &str {
    match word(line) {
        Some((Word { letter: 'N', .. }, rest)) => rest.trim_start(),
        _ => line,
    }
}

fn after_comment<'a>(text: &'a str, marks: &CommentMarks) -> Option<&'a str> {
    let (open, close) = marks.opening_mark(text)?;
    let inside = &text[open..];
    match inside.find(close).filter(|_| !close.is_empty()) {
        Some(end) => Some(&inside[end + close.len()..]),
        None => Some(""),
    }
}

fn word(text: &str) -> Option<(Word, &str)> {
    let letter = text.chars().next().filter(char::is_ascii_alphabetic)?;
    let after = text[1..].trim_start_matches([' ', '\t']);
    let length = after.find(|c: char| !matches!(c, '0'..='9' | '.' | '+' | '-')).unwrap_or(after.len());
    let number = after[..length].parse().ok()?;
    Some((Word { letter: letter.to_ascii_uppercase(), number }, &after[length..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> (String, Option<String>) {
        let marks = CommentMarks { open: "'".into(), close: String::new() };
        let found = words(line, &marks);
        let text: Vec<String> =
            found.words.iter().map(|word| format!("{}{}", word.letter, word.number)).collect();
        (text.join(" "), found.foreign)
    }

    #[test]
    fn words_need_no_blanks_and_may_have_them() {
        assert_eq!(read("G1X-1.5y 2 Z.5"), ("G1 X-1.5 Y2 Z0.5".into(), None));
        assert_eq!(read("%"), (String::new(), None));
        assert!(words("N10 %1234.1P", &CommentMarks::default()).is_percent);
        assert!(!words("FOO %1234.1P", &CommentMarks::default()).is_percent);
        let is_behind = |line| words(line, &CommentMarks::default()).has_percent_behind_words;
        assert!(is_behind("N10 G1 % X2") && is_behind("G1 X2 %") && is_behind("G1 X2 (50) %"));
        assert!(!is_behind("N10 %") && !is_behind("G1 X2 (50 %)") && !is_behind("MSG(50 %)"));
    }

    #[test]
    fn comments_say_nothing() {
        assert_eq!(read("G0 (X1) Y2 ; Z3"), ("G0 Y2".into(), None));
        assert_eq!(read("G0 'X1"), ("G0".into(), None));
    }

    #[test]
    fn other_text_is_passed_over() {
        let foreign = |text: &str| Some(text.to_owned());
        assert_eq!(read("G0 TOUCHOFF-POINT X1"), ("G0 X1".into(), foreign("TOUCHOFF-POINT")));
        assert_eq!(read("<HEADER>"), (String::new(), foreign("<HEADER>")));
        assert_eq!(read("G1 X#1"), ("G1".into(), foreign("X#1")));
    }

    #[test]
    fn assigned_names_have_no_numbers() {
        let assigned = |line: &str| words(line, &CommentMarks::default()).assigned;
        assert_eq!(assigned("G0 Z=-5 M1=3"), ["Z", "M"]);
        assert_eq!(assigned("R10 = 5"), ["R"]);
        assert_eq!(assigned("$32=0 (Z=5)"), [""; 0]);
    }
}
