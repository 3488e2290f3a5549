//! The compiler for a page in a browser, with files in memory and messages as its interface. (book: program/browser)
//!
//! A message is a line of JSON followed by bytes. The page adds files ([`Question::Put`]), opens them ([`Question::Open`]), and then queries path
//! by path: a panic ends the WebAssembly instance, and the page must know which path took too long or triggered a bug. It then starts a new
//! instance and lists that path as lost; lost paths get PB005 or PB006.
//!
//! The functions called by the browser are in `exports`; everything else is portable and has ordinary tests.

#[cfg(target_family = "wasm")]
pub mod exports;
mod message;
mod open_files;

pub use message::{AbortReason, AbortedItem, Options, Question};
pub use open_files::Compiler;
