//! Diagnostics as plain values, and the catalogue of their codes, texts and pages in English and German.
//!
//! A [`Diagnostic`] is what a stage found wrong: which [`Message`], the values in it, and where. It holds no text of its own, so it
//! is cheap to compare (query results are compared after every edit) and can be shown in any language and format. Everything that
//! is *said* stands in [`messages`] and in the pages of `explain`; everything that is *shown* (colours, underlining, JSON) is the
//! program's business. This crate prints nothing and does not know miette. (book: reference/diagnostics)

mod code;
mod diagnostic;
mod kept;
mod message;
pub mod messages;
mod number;
mod page;
mod place;
pub mod reasons;
pub mod shown;
pub mod words;

pub use code::{Code, Severity};
pub use diagnostic::{Diagnostic, Note, TraceStep};
pub use message::{Lang, Message, Text, Value, Word};
pub use number::{Number, in_prose};
pub use page::{example, page};
pub use place::{ElementId, EntityKind, Handle, Place, Point, TextFault};
