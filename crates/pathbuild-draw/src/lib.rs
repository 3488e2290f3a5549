//! Drawings as lines of text, turned into DXF.
//!
//! A [`Sheet`] is a finished drawing. It is parsed from the text form, which README.md describes, or built as a [`Draft`] in Rust;
//! `Sheet::to_dxf` writes it through the crate `dxf`, always as the same bytes. A [`Fixture`] holds several drawings and other files
//! in one text, with what commands are expected to say about them. Nothing here is shared with the reader in pathbuild-dxf, so that
//! neither hides the other's mistakes. (spec/10-drawing.md; design.md, "Tests")

mod draft;
mod error;
mod fixture;
mod furniture;
pub mod generate;
pub mod model;
mod parse;
mod place;
mod q_project;
mod random;
mod sheet;
mod write;

pub use draft::{Block, Draft};
pub use error::DrawError;
pub use fixture::{Command, Content, Expect, Fixture, FixtureFile};
pub use model::{Entity, Layer, Options, Point, Shape, Version};
pub use place::{TextCircle, text_circle};
pub use q_project::q_project;
pub use sheet::Sheet;

/// The examples of README.md are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
