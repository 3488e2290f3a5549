//! Diagnostics as plain values, and the catalogue of their codes, texts and pages in English and German.
//!
//! A [`Diagnostic`] is a finding of a stage: a [`Message`], the values in it, and its place. It contains no text of its own, so it is
//! cheap to compare (query results are compared after every edit) and can be rendered in any language and format. All texts are in
//! [`messages`] and in the pages of `explain`; the program decides about presentation (colours, underlining, JSON). This crate prints
//! nothing and does not depend on miette. (book: reference/diagnostics)

mod code;
mod diagnostic;
pub mod drawn_changes;
pub mod escaping;
pub mod limits;
mod location;
mod message;
pub mod messages;
mod nearest;
pub mod reasons;
pub mod words;

pub use code::{Code, Severity};
pub use diagnostic::{Diagnostic, Note, TraceStep};
pub use location::{ElementId, EntityKind, Handle, Number, Place, Point, TextFault, with_decimal_separator};
pub use message::{Message, Sentence, Value};
pub use nearest::{is_typo, nearest};
pub use words::{Lang, Noun, Text, counted, format_count};

/// Returns all texts of this crate that can be arguments of messages.
pub fn texts() -> impl Iterator<Item = &'static Text> {
    let texts =
        [words::TEXTS, reasons::TEXTS, limits::TEXTS, messages::configuration::TEXTS, drawn_changes::TEXTS];
    texts.into_iter().flatten().copied()
}
