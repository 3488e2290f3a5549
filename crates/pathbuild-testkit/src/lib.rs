//! What tests, benchmarks and the examples of `explain` share. The product does not ship it.
//!
//! [`sheet`] reads a drawing in the text form that README.md describes; a [`Fixture`] holds several drawings and other files in one
//! text, with what commands are expected to say about them; [`generate`] makes libraries of any size. Drawings made in Rust are those of
//! pathbuild-draw, which stand here again.

mod fixture;
mod furniture;
pub mod generate;
pub mod naive;
mod oracle;
mod parse;
mod random;
mod workshop;

pub use pathbuild_draw::{
    Block, Draft, DrawError, Entity, Layer, Options, Point, Shape, Sheet, TextCircle, Version, model,
    text_circle,
};

pub use fixture::{Command, Content, Expect, Fixture, FixtureFile};
pub use oracle::{is_required, project, shared, skip};
pub use parse::sheet;
pub use workshop::Workshop;

/// The examples of README.md are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
