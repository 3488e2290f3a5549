//! Drawings made in Rust, written as DXF: the Q-projects that the program draws, and what its tests draw (pathbuild-testkit).
//!
//! A [`Draft`] collects entities; finished, it is a [`Sheet`], in which each parameter text has a place where it belongs to its
//! element. `Sheet::to_dxf` writes it through the crate `dxf`, always as the same bytes. Nothing here is shared with the reader in
//! pathbuild-dxf, so that neither hides the other's mistakes. (book: reference/dxf)

mod draft;
mod error;
pub mod model;
mod place;
mod q_project;
mod sheet;
mod write;

pub use draft::{Block, Draft};
pub use error::DrawError;
pub use model::{Entity, Layer, Options, Point, Shape, Version};
pub use place::{TextCircle, text_circle};
pub use q_project::{EmbeddingPath, q_project};
pub use sheet::Sheet;
pub use write::{LINE_TYPES, Template};
