//! Draws Q-projects and writes them as DXF through the crate `dxf`. (book: language/q-projects)
//!
//! The drawings of tests (pathbuild-testkit) are built on [`geometry`], [`text_positions`] and [`pairs`]. No code is shared with the reader in
//! pathbuild-dxf, so that neither hides the other's mistakes.

pub mod geometry;
pub mod pairs;
mod q_project;
pub mod text_positions;

pub use q_project::{EmbeddingPath, q_project};
