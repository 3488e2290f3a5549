//! Tests which queries run again after an edit, and which must not. (ARCHITECTURE.md, "Queries")
#![allow(clippy::unwrap_used, reason = "a test that cannot set up its files has failed")]

mod drift;
mod embedding;
mod incremental;
mod judged;
mod keep_outs;
mod library;
mod limits;
mod links;
mod listing;
mod memory;
mod one_file;
mod parts;
mod settings;
mod world;
