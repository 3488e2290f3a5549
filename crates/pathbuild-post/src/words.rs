//! Parses the words of a written line leniently: anything that is not a word is skipped.

/// A letter and its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Word {
    /// In upper case.
    pub(crate) letter: char,
    pub(crate) number: f64,
}

/// The words of a line.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Words {
    pub(crate) words: Vec<Word>,
    /// Whether the line contains something that is neither a word nor a comment.
    pub(crate) has_more: bool,
}

/// The marks that begin and end a comment. An empty end mark is the end of the line.
#[derive(Clone, Debug, Default)]
pub(crate) struct CommentMarks {
    pub(crate) open: String,
    pub(crate) close: String,
}

/// Parses the words of a line.
pub(crate) fn words(line: &str, marks: &CommentMarks) -> Words {
    let mut found = Words::default();
    let mut rest = line.trim_start();
    while let Some(first) = rest.chars().next() {
        rest = if let Some(after) = after_comment(rest, marks) {
            after
        } else if let Some((word, after)) = word(rest) {
            found.words.push(word);
            after
        } else {
            found.has_more |= !matches!(first, '%' | '/' | ':' | ' ' | '\t');
            &rest[first.len_utf8()..]
        };
    }
    found
}

impl CommentMarks {
    /// Length of the mark that opens a comment here, and the mark that closes it: those of the definition, or usual ones.
    pub(crate) fn at(&self, text: &str) -> Option<(usize, &str)> {
        let own = (self.open.as_str(), self.close.as_str());
        let (open, close) = [own, ("(", ")"), (";", "")]
            .into_iter()
            .find(|(open, _)| !open.is_empty() && text.starts_with(open))?;
        Some((open.len(), close))
    }
}

/// The first line, from 1, in which a program differs from another one, and that one's line. Lines that are only a comment count in neither;
/// what opens a comment is what opens one in the other program, because a control may execute lines that look like comments elsewhere.
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

/// The sign that opens the comment of a line that is nothing else. A control may end a line at a CR.
fn opening<'l>(line: &'l str, marks: &CommentMarks) -> Option<&'l str> {
    let line = line.trim();
    let found = words(line, marks);
    let is_comment = found.words.is_empty() && !found.has_more && !line.contains('\r');
    let (length, _) = marks.at(line).filter(|_| is_comment)?;
    Some(&line[..length])
}

fn after_comment<'a>(text: &'a str, marks: &CommentMarks) -> Option<&'a str> {
    let (open, close) = marks.at(text)?;
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

    fn read(line: &str) -> (String, bool) {
        let marks = CommentMarks { open: "'".into(), close: String::new() };
        let found = words(line, &marks);
        let text: Vec<String> =
            found.words.iter().map(|word| format!("{}{}", word.letter, word.number)).collect();
        (text.join(" "), found.has_more)
    }

    #[test]
    fn words_need_no_blanks_and_may_have_them() {
        assert_eq!(read("G1X-1.5y 2 Z.5"), ("G1 X-1.5 Y2 Z0.5".into(), false));
        assert_eq!(read("%"), (String::new(), false));
    }

    #[test]
    fn comments_say_nothing() {
        assert_eq!(read("G0 (X1) Y2 ; Z3"), ("G0 Y2".into(), false));
        assert_eq!(read("G0 'X1"), ("G0".into(), false));
    }

    #[test]
    fn other_text_is_passed_over() {
        assert_eq!(read("G0 TOUCHOFF-POINT"), ("G0".into(), true));
        assert_eq!(read("<HEADER>"), (String::new(), true));
        assert_eq!(read("G1 X#1"), ("G1".into(), true));
    }
}
