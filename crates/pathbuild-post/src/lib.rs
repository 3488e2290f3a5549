//! Post-processors, which write programs in the words of a machine's control. (book: program/posts)
//!
//! A [`Job`] is the input of a post; it is made from finished programs or from a parsed one. A [`PostDefinition`] is written in the language
//! of CamBam or of CAD6; [`PostDefinition::write`] produces the text. This crate does no IO.

/// Declares an enum whose variants have a description for the book, in both languages.
macro_rules! words {
    ($(#[$doc:meta])* $type:ident: $($variant:ident $(($value:ty))? $en:literal, $de:literal;)*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum $type {
            $(#[doc = $en] $variant $(($value))?,)*
        }

        impl $type {
            /// Description for the book.
            pub(super) fn word(self) -> pathbuild_diagnostic::Text {
                match self {
                    $(Self::$variant { .. } => pathbuild_diagnostic::Text { en: $en, de: $de },)*
                }
            }
        }
    };
}

mod ambiguous;
mod arcs;
mod built_in;
mod cad6;
mod cambam;
mod definition;
mod dwells;
mod findings;
mod from_program;
mod from_steps;
mod job;
mod line_words;
mod number;
mod options;
mod read_back;
mod read_back_options;
mod rs274_translation;
mod target;
mod tools;
mod traverse;

pub use built_in::{BUILT_IN, BuiltIn, load, samples};
pub use definition::{Language, Output, PostDefinition, reference_table};
pub use from_program::{NativeCutter, ToolEntry, ToolTable};
pub use from_steps::{Remark, altered_word_warnings, is_head_comment, native_remark};
pub use job::{Entry, Hole, HoleKind, Job, JobStep, Operation, Tool, Units, VelocityMode, program_number};
pub use options::{PostFiles, PostMacro, PostOptions, RefusedFiles};
pub use rs274_translation::{Doubt, DoubtfulWord, TranslatedText};

/// Parses the extension of a file name and removes its dot; `None` if it is not a valid extension.
fn extension(text: &str) -> Option<Box<str>> {
    let text = text.trim_start_matches('.');
    let is_extension =
        !text.is_empty() && text.len() <= 16 && text.chars().all(|c| c.is_ascii_alphanumeric());
    is_extension.then(|| text.into())
}

/// The cells of a row of a reference table, in Markdown.
pub type Row = Vec<String>;

/// Formats a text as code. Line breaks are shown as `\n`.
pub(crate) fn code(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("`{}`", text.replace('\n', "\\n")) }
}
