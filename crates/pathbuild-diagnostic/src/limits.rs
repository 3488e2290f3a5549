//! Diagnostics about limits of the configuration that are exceeded. (PB005; book: reference/configuration)

use std::time::Duration;

use crate::Diagnostic;
use crate::message::{Sentence, Value};
use crate::messages::files;
use crate::words::words;

words! {
    /// `entities`.
    ENTITIES: "the number of entities", "die Zahl der Elemente";
    /// `text-length`, of a text as it is drawn.
    TEXT_LENGTH: "the length of a text in bytes", "die Länge eines Textes in Bytes";
    /// `text-length`, of a text with its variables replaced.
    TEXT_WITH_VALUES: "a text with its variables' values", "ein Text mit den Werten seiner Variablen";
    /// `seconds-per-path`.
    TIME_OF_PATH: "the time that this path takes", "die Zeit, die dieser Pfad braucht";
    /// `embedding-moves`, of a program that `z-split` cuts.
    MOVES_CUT: "the number of moves, cut by z-split ({moves}),", "die Zahl der Bewegungen, die z-split teilt ({moves}),";
    /// `file-size` and the like.
    FILE_SIZE: "the file's size of {size} bytes", "die Dateigröße von {size} Bytes";
    /// The same limit, as the reason why a file cannot be read.
    TOO_MANY_BYTES: "it has {size} bytes, the limit is {limit}", "sie hat {size} Bytes, die Grenze ist {limit}";
    /// A line of a text that is read line by line.
    LONG_LINE: "a line is longer than {limit} bytes", "eine Zeile ist länger als {limit} Bytes";
    /// A pattern of names.
    LONG_TEXT: "it is longer than {limit} bytes", "es ist länger als {limit} Bytes";
    /// The limit itself.
    BYTES: "{count} bytes", "{count} Bytes";
    /// A limit that is a time.
    SECONDS: "{count} s", "{count} s";
}

/// PB005 for what exceeds the limit that this key of `[limits]` sets.
pub fn exceeded(what: impl Into<Value>, limit: impl Into<Value>, key: &str) -> Diagnostic {
    Diagnostic::new(&files::LIMIT).with("what", what).with("limit", limit).quoting("key", key)
}

/// PB005 for a file of `size` bytes.
pub fn file_too_large(size: u64, limit: u64, key: &str) -> Diagnostic {
    exceeded(Sentence::new(&FILE_SIZE).with("size", size), bytes(limit), key)
}

/// The moves of a program after `z-split` has cut them.
pub fn moves_cut(moves: u64) -> Sentence {
    Sentence::new(&MOVES_CUT).with("moves", moves)
}

/// The reason why a file of `size` bytes is not read.
pub fn too_many_bytes(size: u64, limit: u64) -> Sentence {
    Sentence::new(&TOO_MANY_BYTES).with("size", size).with("limit", limit)
}

/// The reason why a file with a line of more than `limit` bytes is not read.
pub fn line_too_long(limit: usize) -> Sentence {
    Sentence::new(&LONG_LINE).with("limit", limit)
}

/// The reason why a text of more than `limit` bytes is refused.
pub fn text_too_long(limit: usize) -> Sentence {
    Sentence::new(&LONG_TEXT).with("limit", limit)
}

/// A number of bytes.
pub fn bytes(count: u64) -> Sentence {
    Sentence::new(&BYTES).with("count", count)
}

/// A number of seconds.
pub fn seconds(duration: Duration) -> Sentence {
    Sentence::new(&SECONDS).with("count", duration.as_secs_f64())
}
