//! What is found wrong in a file, kept within bounds.

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::gcode::{MORE, ONE_MORE};
use pathbuild_diagnostic::{Diagnostic, Message, Value};

use super::block::{Block, Span};
use super::text;

/// So often one message is said of one file. A program with a doubtful word in each of a million lines is one problem.
const SHOWN: u64 = 20;

/// Where in a file something is.
#[derive(Clone, Copy, Debug)]
pub struct At<'a> {
    /// From 1.
    pub line: u32,
    /// The whole line.
    pub text: &'a [u8],
    /// The faulty part of it.
    pub span: Span,
}

impl<'a> At<'a> {
    /// A part of a block.
    pub fn block(block: &Block<'a>, span: Span) -> Self {
        Self { line: block.line, text: block.text, span }
    }

    /// A block as a whole.
    pub fn line(block: &Block<'a>) -> Self {
        Self::block(block, Span::new(0, block.text.len()))
    }

    fn place(&self, diagnostic: Diagnostic) -> Diagnostic {
        let column = text::column(self.text, self.span.start as usize);
        diagnostic.at_line(self.line, Some(column)).with_text(text::fault(self.text, self.span))
    }
}

/// Diagnostics of one file in the order of finding. Of each message the first few are kept and the others counted.
#[derive(Clone, Debug, Default)]
pub struct Problems {
    found: Vec<Diagnostic>,
    /// By the message's key: how often it was found, and the last one kept.
    counts: BTreeMap<&'static str, (u64, usize)>,
}

impl Problems {
    /// Notes a problem; `values` fills in the message and is asked only if it is kept.
    pub fn add(
        &mut self,
        message: &'static Message,
        at: At<'_>,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        self.push(message, || at.place(values(Diagnostic::new(message))));
    }

    /// Notes a problem of which only the line is known.
    pub fn add_at_line(
        &mut self,
        message: &'static Message,
        line: u32,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        self.push(message, || values(Diagnostic::new(message)).at_line(line, None));
    }

    /// How often a message was found.
    pub fn count(&self, message: &'static Message) -> u64 {
        self.counts.get(message.key).map_or(0, |&(count, _)| count)
    }

    /// Adds those of another stage.
    pub fn append(&mut self, other: Self) {
        for (key, (count, last)) in other.counts {
            let known = self.counts.entry(key).or_default();
            *known = (known.0 + count, self.found.len() + last);
        }
        self.found.extend(other.found);
    }

    /// The diagnostics in the order of lines; the last of many says how many more there were.
    pub fn into_diagnostics(mut self) -> Vec<Diagnostic> {
        for &(count, last) in self.counts.values().filter(|(count, _)| *count > SHOWN) {
            let message = if count - SHOWN == 1 { &ONE_MORE } else { &MORE };
            self.found[last].notes.push(pathbuild_diagnostic::Note {
                message,
                arguments: vec![("count", Value::Count(count - SHOWN))],
            });
        }
        self.found.sort_by_key(|diagnostic| diagnostic.place.line);
        self.found
    }

    fn push(&mut self, message: &'static Message, diagnostic: impl FnOnce() -> Diagnostic) {
        let (count, last) = self.counts.entry(message.key).or_default();
        *count += 1;
        if *count <= SHOWN {
            *last = self.found.len();
            self.found.push(diagnostic());
        }
    }
}
