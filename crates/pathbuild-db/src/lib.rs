//! The query database: inputs, queries, and the system they read from.
//!
//! A drawing is source text; each stage from it to the finished program is a memoized query, keyed by file, path and the values of the
//! path's variables. This is the only crate with salsa's macros, and it does no IO but through [`System`]. (design: ARCHITECTURE.md)
//!
//! Rules that keep it right: rayon only outside queries, over clones of the [`Database`]; whoever asks from outside begins at a query
//! keyed by an input ([`Target`], [`SourceFile`], [`Directory`]), since what is interned outside queries is never reclaimed;
//! diagnostics are values of queries, and know elements by number, not by line: [`locate`] fills in lines and handles at the end.

#![expect(missing_docs, reason = "salsa makes constructors and setters, which cannot be documented")]

mod arrivals;
mod database;
mod guard;
mod inputs;
mod queries;
mod settings;
pub mod system;

pub use arrivals::{Arrivals, Lister};
pub use database::{Database, Db};
pub use guard::Underway;
pub use inputs::{Directory, Insight, Role, SourceFile, Target};
pub use queries::{
    Brief, Clear, Closure, Destination, Edge, Embedding, Found, Head, Instance, MissingOption, NameKey,
    Outcome, PathPlace, QProject, QProjectLine, Reached, Sought, Summary, Survey, Trace, assigned_texts,
    chains, check_file, check_target, clear, closure, combinations, content_hash, drawing_names, embeds,
    find_path, has_subpaths, head, holders, likely_file, locate, name_table, path, path_names, path_place,
    program, q_project, q_project_findings, raw_file, raw_path, search_directories, summary, survey, trace,
};
pub use settings::{Limits, Lookup, Reading, Restriction, Settings};
pub use system::System;
