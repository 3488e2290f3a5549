//! Collects the problems found in a file and limits their number.

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::gcode::{MORE, ONE_MORE};
use pathbuild_diagnostic::{Diagnostic, Message, Value};

use super::block::{Block, Span, column, fault};

/// Maximum number of times that a message is reported per file, since a doubtful word in each of a million lines is a single problem.
const MAX_REPORTS_PER_MESSAGE: u64 = 20;

/// A position in a file, with the text of its line.
#[derive(Clone, Copy, Debug)]
pub struct SourcePosition<'a> {
    /// Line number, counted from 1.
    pub line: u32,
    /// The entire line.
    pub text: &'a [u8],
    /// Range of the faulty part.
    pub span: Span,
}

impl<'a> SourcePosition<'a> {
    /// Returns the position of a part of a block.
    pub fn block(block: &Block<'a>, span: Span) -> Self {
        Self { line: block.line, text: block.text, span }
    }

    /// Returns the position of an entire block.
    pub fn line(block: &Block<'a>) -> Self {
        Self::block(block, block.span())
    }

    fn place(&self, diagnostic: Diagnostic) -> Diagnostic {
        let column = column(self.text, self.span.start as usize);
        diagnostic.at_line(self.line, Some(column)).with_text(fault(self.text, self.span))
    }
}

/// Collector for diagnostics of a file in the order in which they are found. The first few of each message are stored, the others only counted.
#[derive(Clone, Debug, Default)]
pub struct Problems {
    found: Vec<Diagnostic>,
    /// Number of times that each message was found, and the index of its last diagnostic that was kept, by the message's key.
    counts: BTreeMap<&'static str, (u64, usize)>,
}

impl Problems {
    /// Adds a problem. `values` sets the arguments of the message; it is only called if the problem is kept.
    pub fn add(
        &mut self,
        message: &'static Message,
        at: SourcePosition<'_>,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        self.push(message, || at.place(values(Diagnostic::new(message))));
    }

    /// Adds a problem for which only the line is known.
    pub fn add_at_line(
        &mut self,
        message: &'static Message,
        line: u32,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        self.push(message, || values(Diagnostic::new(message)).at_line(line, None));
    }

    /// Returns the number of times that a message was found.
    pub fn count(&self, message: &'static Message) -> u64 {
        self.counts.get(message.key).map_or(0, |&(count, _)| count)
    }

    /// Adds the problems of another stage.
    pub fn append(&mut self, other: Self) {
        for diagnostic in other.found {
            let message = diagnostic.message;
            self.push(message, || diagnostic);
        }
        for (key, (count, _)) in other.counts {
            self.counts.entry(key).or_default().0 += count.saturating_sub(MAX_REPORTS_PER_MESSAGE);
        }
    }

    /// Returns the diagnostics in line order. If a message occurred too often to be reported each time, its last diagnostic states how many more there
    /// were.
    pub fn into_diagnostics(mut self) -> Vec<Diagnostic> {
        for &(count, last) in self.counts.values().filter(|(count, _)| *count > MAX_REPORTS_PER_MESSAGE) {
            let message = if count - MAX_REPORTS_PER_MESSAGE == 1 { &ONE_MORE } else { &MORE };
            self.found[last].notes.push(pathbuild_diagnostic::Note {
                message,
                arguments: vec![("count", Value::Count(count - MAX_REPORTS_PER_MESSAGE))],
            });
        }
        self.found.sort_by_key(|diagnostic| diagnostic.place.line);
        self.found
    }

    fn push(&mut self, message: &'static Message, diagnostic: impl FnOnce() -> Diagnostic) {
        let (count, last) = self.counts.entry(message.key).or_default();
        if *count < MAX_REPORTS_PER_MESSAGE {
            let diagnostic = diagnostic();
            // A line that is executed repeatedly reports its problem only once.
            if self.found.contains(&diagnostic) {
                return;
            }
            *last = self.found.len();
            self.found.push(diagnostic);
        }
        *count += 1;
    }
}
