//! Inserts texts from drawings, file names and options into the lines of a program in such a way that no control acts on them.

use pathbuild_gcode::dialect::{Charset, is_active_comment, within_comment};

use crate::shadow::{CommentMarks, words};
use crate::target::Target;

/// Knows how the lines of a post mark comments.
#[derive(Debug)]
pub(crate) struct Guard<'a> {
    target: Option<&'a Target>,
    marks: CommentMarks,
    charset: Charset,
}

impl<'a> Guard<'a> {
    /// Uses the comment marks of the target; without a target those of the definition and the usual ones.
    pub(crate) fn new(target: Option<&'a Target>, marks: CommentMarks, charset: Charset) -> Self {
        Self { target, marks, charset }
    }

    /// Returns the text in a form that may be appended to a line. Returns `None` if it would be outside a comment and be read as words.
    pub(crate) fn put(&self, line: &str, text: &str) -> Option<String> {
        let plain = within_comment(text, self.target.map(|target| target.reader), self.charset);
        let is_title = line.trim_start().starts_with('%');
        match self.open_comment(line) {
            Some((before, close)) => {
                let plain = unclosing(&plain, close);
                let all = format!("{before}{plain}");
                let guard = if is_active_comment(&all) && !is_active_comment(before) { GUARD } else { "" };
                Some(format!("{guard}{plain}"))
            }
            None if is_title => Some(plain),
            // A comment that begins here would hide the words after it.
            None if self.open_comment(&format!("{line}{plain}")).is_some() => None,
            None if is_inert(&plain, &self.marks) => Some(plain),
            None => None,
        }
    }

    /// The text of the comment that is open at the end of a line, and the mark that closes it.
    fn open_comment<'l>(&self, line: &'l str) -> Option<(&'l str, &str)> {
        let mut at = 0;
        while let Some(c) = line[at..].chars().next() {
            match self.marks_at(&line[at..]) {
                None => at += c.len_utf8(),
                Some((open, close)) => {
                    let inside = &line[at + open..];
                    match inside.find(close).filter(|_| !close.is_empty()) {
                        Some(end) => at += open + end + close.len(),
                        None => return Some((inside, close)),
                    }
                }
            }
        }
        None
    }

    /// Length of the mark that opens a comment here, and the mark that closes it.
    fn marks_at(&self, text: &str) -> Option<(usize, &str)> {
        match self.target {
            Some(target) => target.comment_marks(text),
            None => self.marks.at(text).or_else(|| text.starts_with("//").then_some((2, ""))),
        }
    }
}

/// Prefix for texts that a control would take for commands.
const GUARD: &str = "text: ";

/// Removes the closing mark from a comment text. Definitions may use any mark.
fn unclosing(text: &str, close: &str) -> String {
    let instead = if close.contains(' ') { "_" } else { " " };
    text.replace(|c| close.contains(c), instead)
}

/// Whether a text is harmless even outside a comment.
fn is_inert(text: &str, marks: &CommentMarks) -> bool {
    words(text, marks).words.is_empty()
        && !text.contains(['#', '[', ']', '%', '$', '{', '}', '"', '<', '>', '='])
}
