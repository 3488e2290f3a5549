//! Texts of drawings, file names and options in the lines of a program: none of them makes a control do anything.

use pathbuild_gcode::dialect::{is_active_comment, within_comment};
use pathbuild_gcode::native::Charset;

use crate::target::Target;
use crate::words::{CommentMarks, words};

/// How a post's lines tell comments from code.
#[derive(Debug)]
pub(crate) struct Guard<'a> {
    target: Option<&'a Target>,
    marks: CommentMarks,
    charset: Charset,
}

impl<'a> Guard<'a> {
    /// The comments of the target; without one, those of the definition and the usual ones.
    pub(crate) fn new(target: Option<&'a Target>, marks: CommentMarks, charset: Charset) -> Self {
        Self { target, marks, charset }
    }

    /// A text as it may be added to the beginning of a line. `None`: it would stand outside a comment, as words.
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
            // One that begins here would hide the words behind it.
            None if self.open_comment(&format!("{line}{plain}")).is_some() => None,
            None if is_inert(&plain, &self.marks) => Some(plain),
            None => None,
        }
    }

    /// The text of the comment that is open at the end of a line, and the sign that closes it.
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

    /// The length of the sign that opens a comment here, and the sign that closes it.
    fn marks_at(&self, text: &str) -> Option<(usize, &str)> {
        match self.target {
            Some(target) => target.comment_marks(text),
            None => self.marks.at(text).or_else(|| text.starts_with("//").then_some((2, ""))),
        }
    }
}

/// What stands in front of a text that a control would take for a command to itself.
const GUARD: &str = "text: ";

/// A text with nothing of the sign that closes its comment: a definition's own may be any.
fn unclosing(text: &str, close: &str) -> String {
    let instead = if close.contains(' ') { "_" } else { " " };
    text.replace(|c| close.contains(c), instead)
}

/// Whether a text says nothing to a control outside comments either.
fn is_inert(text: &str, marks: &CommentMarks) -> bool {
    words(text, marks).words.is_empty()
        && !text.contains(['#', '[', ']', '%', '$', '{', '}', '"', '<', '>', '='])
}
