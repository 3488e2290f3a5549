//! Diagnostics about exceeded limits of the configuration. (PB005; book: reference/configuration)

use std::time::Duration;

use crate::Diagnostic;
use crate::message::{Sentence, Value};
use crate::messages::files;
use crate::words::words;

words! {
    /// The quantity that the limit `entities` bounds.
    ENTITIES: "the number of entities", "die Zahl der Elemente";
    /// The quantity that the limit `text-length` bounds, for a text as drawn.
    TEXT_LENGTH: "the length of a text in bytes", "die Länge eines Textes in Bytes";
    /// The quantity that the limit `text-length` bounds, for a text with its variables replaced by their values.
    TEXT_WITH_VALUES: "the length of a text with the values of its variables", "die Länge eines Textes mit den Werten seiner Variablen";
    /// The quantity that the limit `seconds-per-path` bounds.
    TIME_OF_PATH: "the time that this path takes", "die Zeit, die dieser Pfad braucht";
    /// The quantity that `file-size` and other limits of sizes bound.
    FILE_SIZE: "the file's size of {size} bytes", "die Dateigröße von {size} Bytes";
    /// Reason why a file is not read: it is larger than a limit such as `file-size`.
    TOO_MANY_BYTES: "it has {size} bytes, the limit is {limit}", "sie hat {size} Bytes, die Grenze ist {limit}";
    /// Reason why a text such as a pattern of names is refused: it is too long.
    LONG_TEXT: "it is longer than {limit} bytes", "es ist länger als {limit} Bytes";
    /// A limit that is a number of bytes.
    BYTES: "{count} bytes", "{count} Bytes";
    /// A limit that is a number of seconds.
    SECONDS: "{count} s", "{count} s";
}

/// Returns PB005: `what` exceeds the limit that the key `key` of `[limits]` sets.
pub fn limit_error(what: impl Into<Value>, limit: impl Into<Value>, key: &str) -> Diagnostic {
    Diagnostic::new(&files::LIMIT).with("what", what).with("limit", limit).quoting("key", key)
}

/// Returns PB005 for a file of `size` bytes.
pub fn file_too_large(size: u64, limit: u64, key: &str) -> Diagnostic {
    limit_error(Sentence::new(&FILE_SIZE).with("size", size), bytes(limit), key)
}

/// Returns the reason why a file of `size` bytes is not read.
pub fn too_many_bytes(size: u64, limit: u64) -> Sentence {
    Sentence::new(&TOO_MANY_BYTES).with("size", size).with("limit", limit)
}

/// Returns the reason why a text of more than `limit` bytes is refused.
pub fn text_too_long(limit: usize) -> Sentence {
    Sentence::new(&LONG_TEXT).with("limit", limit)
}

/// Formats a number of bytes in either language.
pub fn bytes(count: u64) -> Sentence {
    Sentence::new(&BYTES).with("count", count)
}

/// Formats a duration in seconds in either language.
pub fn seconds(duration: Duration) -> Sentence {
    Sentence::new(&SECONDS).with("count", duration.as_secs_f64())
}
