//! An error at a position of a control text, before it is known which text that is.

use std::ops::Range;

use pathbuild_diagnostic::{Diagnostic, Message};

/// A diagnostic and the range of the text it is about.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) span: Range<usize>,
    pub(super) diagnostic: Diagnostic,
}

/// Result of reading or evaluating a text.
pub(super) type Evaluated<T> = Result<T, Box<Fault>>;

impl Fault {
    /// Creates a fault whose message has no arguments yet.
    pub(super) fn new(message: &'static Message, span: Range<usize>) -> Box<Self> {
        Box::new(Self { span, diagnostic: Diagnostic::new(message) })
    }

    /// Sets an argument of the message.
    pub(super) fn with(
        mut self: Box<Self>,
        name: &'static str,
        value: impl Into<pathbuild_diagnostic::Value>,
    ) -> Box<Self> {
        self.diagnostic = self.diagnostic.with(name, value);
        self
    }

    /// Sets a value of its message to a name or a piece of the text.
    pub(super) fn quoting(self: Box<Self>, name: &'static str, text: impl AsRef<str>) -> Box<Self> {
        self.with(name, pathbuild_diagnostic::Value::quoted(text))
    }

    /// Moves the fault from a part of a text, which begins at `by`, to the text itself.
    pub(super) fn shifted(mut self: Box<Self>, by: usize) -> Box<Self> {
        self.span = self.span.start + by..self.span.end + by;
        self
    }
}
