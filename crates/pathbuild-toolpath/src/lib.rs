//! The moves of a path, and the fold that places, joins and merges them into a program.
//!
//! A path becomes *operations* in its own coordinates; operations of a path and of all it embeds become one [`Program`]: the steps of
//! the machine in order, every one with its numbers. Nothing here formats text. (spec/60-gcode.md, spec/70-z-probes.md)

mod program;

pub use program::{Class, Comment, Count, ElementKind, Height, Move, NameId, Names, Program, Step, Xy};
