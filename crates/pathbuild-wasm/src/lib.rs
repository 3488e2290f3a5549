//! The compiler for a page in a browser: files in memory, questions and answers as messages. (book: program/browser)
//!
//! A message is a line of JSON and, behind it, bytes. The page puts files ([`Question::Put`]), opens what they are ([`Question::Open`]), and
//! asks path by path, so that it knows which one took too long or showed a bug: a panic ends WebAssembly. It begins anew then, and names
//! that path among those that were lost; they have PB005 or PB006.
//!
//! The functions that a browser calls are in `exports`; everything else runs anywhere, and is tested as the rest is.

mod compiler;
#[cfg(target_family = "wasm")]
pub mod exports;
mod files;
mod message;
mod opened;

pub use compiler::Compiler;
pub use message::{Lost, Options, Question, Why};
