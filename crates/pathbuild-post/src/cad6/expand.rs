//! The first phase of a call: replaces every variable of the control text by its value. (book: reference/post-definitions)

use camino::{Utf8Component, Utf8PathBuf};
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::reasons::NOT_BELOW_POST;

use super::term::{Evaluated, Fault};
use super::variables::{UNDEFINED_MARK, VARIABLE_MARK, Variables, is_mark};
use crate::PostFiles;

/// Maximum nesting depth of variables that refer to each other.
const MAX_DEPTH: usize = 32;
/// Maximum number of variables resolved per call.
const MAX_VARIABLES: usize = 10_000;
/// Maximum length in bytes to which the values of variables may expand the text of one call. Lines of real programs are much shorter.
const MAX_TEXT_BYTES: usize = 1 << 16;

/// A control text with its variables replaced.
#[derive(Debug, Default)]
pub(super) struct Expanded {
    pub(super) text: String,
    /// The parts of the expanded text, in order. A part is either copied from the control text or the value of a variable.
    pieces: Vec<ExpandedPart>,
    /// Variables that do not exist, each with the offset in the expanded text at which its name was used.
    undefined: Vec<(usize, String)>,
    resolved: usize,
}

#[derive(Clone, Copy, Debug)]
struct ExpandedPart {
    /// Offset at which the part begins in the expanded text.
    expanded_start: usize,
    /// Offset in the control text at which the copied part or the name of the variable begins.
    source_start: usize,
    /// Whether the part is the value of a variable, so that all of it corresponds to a single position of the control text.
    is_variable: bool,
}

impl Expanded {
    pub(super) fn new(text: &str, variables: &Variables) -> Evaluated<Self> {
        let mut expanded = Self::default();
        let mut rest = text;
        while let Some((before, name, after)) =
            split_at_next_variable(rest).map_err(|fault| fault.shifted(text.len() - rest.len()))?
        {
            let start = text.len() - rest.len() + before.len();
            let span = start..text.len() - after.len();
            expanded.begin(text.len() - rest.len(), false);
            expanded.text.push_str(before);
            expanded.begin(start, true);
            expanded.text.push(VARIABLE_MARK);
            expanded.variable(name, variables, 0).map_err(|mut fault| {
                fault.span = span;
                fault
            })?;
            rest = after;
        }
        expanded.begin(text.len() - rest.len(), false);
        expanded.text.push_str(rest);
        Ok(expanded)
    }

    fn begin(&mut self, source_start: usize, is_variable: bool) {
        self.pieces.push(ExpandedPart { expanded_start: self.text.len(), source_start, is_variable });
    }

    fn variable(&mut self, name: &str, variables: &Variables, depth: usize) -> Evaluated<()> {
        if depth == MAX_DEPTH {
            return Err(Fault::new(&posts::VARIABLE_DEPTH, 0..0)
                .quoting("name", name)
                .with("limit", MAX_DEPTH));
        }
        self.resolved += 1;
        if self.resolved > MAX_VARIABLES {
            return Err(Fault::new(&posts::VARIABLE_COUNT, 0..0).with("limit", MAX_VARIABLES));
        }
        let Some(value) = variables.get(name) else {
            self.undefined.push((self.text.len(), name.to_owned()));
            self.text.push(UNDEFINED_MARK);
            return Ok(());
        };
        let mut rest = value;
        while let Some((before, inner, after)) = split_at_next_variable(rest)? {
            self.push(before)?;
            self.variable(inner, variables, depth + 1)?;
            rest = after;
        }
        self.push(rest)
    }

    fn push(&mut self, text: &str) -> Evaluated<()> {
        if self.text.len() + text.len() > MAX_TEXT_BYTES {
            return Err(Fault::new(&posts::TEXT_LENGTH, 0..0).with("limit", MAX_TEXT_BYTES));
        }
        self.text.push_str(text);
        Ok(())
    }

    /// Converts an offset in the expanded text to one in the control text.
    pub(super) fn origin(&self, offset: usize) -> usize {
        let after = self.pieces.partition_point(|piece| piece.expanded_start <= offset);
        match after.checked_sub(1).map(|index| self.pieces[index]) {
            Some(piece) if piece.is_variable => piece.source_start,
            Some(piece) => piece.source_start + (offset - piece.expanded_start),
            None => offset,
        }
    }

    /// Returns the name of the non-existent variable that was used at an offset of the expanded text.
    pub(super) fn undefined_at(&self, offset: usize) -> &str {
        self.undefined.iter().find(|(at, _)| *at == offset).map_or("", |(_, name)| name)
    }
}

/// Splits a text at its next variable into the text before it, its name and the rest. Escape sequences are skipped.
pub(super) fn split_at_next_variable(text: &str) -> Evaluated<Option<(&str, &str, &str)>> {
    let mut at = 0;
    while let Some(found) = text[at..].find(['~', '\\']) {
        at += found;
        if let Some(length) = escape_length(&text[at..]) {
            at += length;
            continue;
        }
        if text[at..].starts_with('\\') {
            at += 1;
            continue;
        }
        let inside = &text[at + 1..];
        let length = inside.find(|c: char| !is_name_character(c)).unwrap_or(inside.len());
        if !is_name(&inside[..length]) || !inside[length..].starts_with('~') {
            return Err(Fault::new(&posts::LONE_TILDE, at..at + 1));
        }
        return Ok(Some((&text[..at], &inside[..length], &inside[length + 1..])));
    }
    Ok(None)
}

/// Returns the length of the escape sequence at the beginning of a text; `None` if there is none. A `~` in it does not start a variable.
fn escape_length(text: &str) -> Option<usize> {
    ["\\\\\\~", "\\~", "\\{", "\\}", "\\\\"]
        .iter()
        .find(|escape| text.starts_with(**escape))
        .map(|escape| escape.len())
}

fn is_name_character(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Whether a text is a valid name: a letter followed by letters, digits and underscores.
pub(super) fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic()) && text.chars().all(is_name_character)
}

/// Mark that introduces the name of an inserted file. The name ends with a `*`.
pub(super) const INSERTION: &str = r"\\\~*";

/// Returns the names of the files that an expanded text inserts.
pub(super) fn names(text: &str) -> Vec<String> {
    let names = text.split(INSERTION).skip(1).filter_map(|rest| Some(rest.split_once('*')?.0));
    names
        .filter(|name| !name.contains(UNDEFINED_MARK))
        .map(|name| name.chars().filter(|c| !is_mark(*c)).collect())
        .collect()
}

/// Returns the content of a file without its last line break, or the reason why it cannot be read. Only files below the directory of the
/// post are read.
pub(super) fn read(name: &str, files: &dyn PostFiles) -> Result<Vec<u8>, Value> {
    let path = path_below(name).ok_or(Value::Prose(&NOT_BELOW_POST))?;
    let mut content = files.read(&path)?;
    for end in [b'\n', b'\r'] {
        if content.last() == Some(&end) {
            content.pop();
        }
    }
    Ok(content)
}

/// Returns the path of a file name that is relative and does not contain `..`; `None` for any other. Backslashes are separators, as on Windows.
pub(super) fn path_below(name: &str) -> Option<Utf8PathBuf> {
    let path = Utf8PathBuf::from(name.replace('\\', "/"));
    let is_drive = name.contains(':');
    let is_down =
        path.components().all(|part| matches!(part, Utf8Component::Normal(_) | Utf8Component::CurDir));
    (is_down && !is_drive && path.file_name().is_some()).then_some(path)
}

#[cfg(test)]
mod tests {
    use super::path_below;

    #[test]
    fn only_ways_down_are_gone() {
        for inside in ["head.nc", "sub/head.nc", r"sub\head.nc", "./head.nc"] {
            assert!(path_below(inside).is_some(), "{inside}");
        }
        for outside in [
            "",
            ".",
            "../head.nc",
            r"sub\..\..\head.nc",
            "/etc/passwd",
            r"\\server\x",
            r"C:\head.nc",
            "C:head.nc",
        ] {
            assert!(path_below(outside).is_none(), "{outside}");
        }
    }
}
