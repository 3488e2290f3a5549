//! Shared support for tests, benchmarks and the examples of `explain`. It is not part of the product.
//!
//! [`sheet`] parses a drawing in the text form that README.md describes; a [`Fixture`] contains several drawings and other files in one
//! text, with commands and their expected results; [`generate`] creates libraries of any size; [`draw`] builds drawings in Rust.

pub mod draw;
mod fixture;
mod furniture;
pub mod generate;
pub mod naive;
mod oracle;
mod parse;
mod random;
mod workshop;

pub use crate::draw::{
    Block, Draft, DrawError, Entity, Layer, Options, Point, Shape, Sheet, TextCircle, Version, model,
    text_circle,
};

pub use fixture::{Command, Content, Expect, Fixture, FixtureFile};
pub use oracle::{is_required, project, shared, skip};
pub use parse::sheet;
pub use workshop::Workshop;

/// Compiles the examples of README.md as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
