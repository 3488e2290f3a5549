//! Drawings built in Rust and written as DXF, in each version, as text or binary.
//!
//! A [`Draft`] collects entities; finishing it gives a [`Sheet`], in which each parameter text is positioned so that it belongs to its
//! element. `Sheet::to_dxf` writes the sheet through the crate `dxf`; its output is deterministic. (book: reference/dxf)

mod convert;
mod draft;
pub mod model;
mod text_positions;
mod write;

pub use convert::LINE_TYPES;
pub use draft::{Draft, Sheet};
pub use model::{Block, DrawError, Entity, Layer, Options, Point, Shape, Template, Version};
pub use text_positions::{TextCircle, text_circle};
