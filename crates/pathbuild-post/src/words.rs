//! Words of a written line, read leniently: whatever is no word is passed over.

/// A letter and its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Word {
    /// Upper case.
    pub(crate) letter: char,
    pub(crate) number: f64,
}

/// What a line says to the machine.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Words {
    pub(crate) words: Vec<Word>,
    /// Something in the line is neither a word nor a comment.
    pub(crate) has_more: bool,
}

/// How comments begin and end. An empty end is the end of the line.
#[derive(Clone, Debug, Default)]
pub(crate) struct CommentMarks {
    pub(crate) open: String,
    pub(crate) close: String,
}

/// The words of a line.
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
    /// The length of the sign that opens a comment here, and the sign that closes it: the definition's own, or a usual one.
    pub(crate) fn at(&self, text: &str) -> Option<(usize, &str)> {
        let own = (self.open.as_str(), self.close.as_str());
        let (open, close) = [own, ("(", ")"), (";", "")]
            .into_iter()
            .find(|(open, _)| !open.is_empty() && text.starts_with(open))?;
        Some((open.len(), close))
    }
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
