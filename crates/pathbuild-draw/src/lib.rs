//! Drawings built in Rust and written as DXF: the Q-projects that the program draws, and the drawings of its tests (pathbuild-testkit).
//!
//! A [`Draft`] collects entities; finishing it gives a [`Sheet`], in which each parameter text is positioned so that it belongs to its
//! element. `Sheet::to_dxf` writes the sheet through the crate `dxf`; its output is deterministic. No code is shared with the reader in
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
