//! The query database: inputs, queries, and the system they read from.
//!
//! A drawing is source text; each stage from it to the finished program is a memoized query, keyed by file, path and the values of the
//! path's variables. This is the only crate with salsa's macros, and it does no IO but through [`System`]. (design: ARCHITECTURE.md)
//!
//! Rules that keep it correct: rayon is used only outside queries, over clones of the [`Database`]; clients start at a query keyed by an
//! input ([`Target`], [`SourceFile`], [`Directory`]), since values interned outside queries are never reclaimed; diagnostics are values of
//! queries and refer to elements by number, and [`locate`] fills in lines and handles at the end.

#![expect(missing_docs, reason = "salsa makes constructors and setters, which cannot be documented")]

mod database;
mod inputs;
mod queries;

pub use database::{
    Database, Db, PendingListing, ScratchPool, WorkInProgress, bug, catch_bugs, time_limit_error,
};
pub use inputs::{Directory, Limits, Reading, Role, Settings, SourceFile, Target};
pub use pathbuild_files as system;
pub use pathbuild_files::System;
pub use queries::{
    BoundPath, Closure, Collision, Destination, DrawnPath, Edge, Embedding, FileIndex, Instance,
    MissingOption, NameKey, NameLookup, Outcome, PathIndex, PathPlace, PathSummary, PlacedKeepOut,
    ResolvedPath, SecondDefinition, Trace, TracedProgram, assigned_texts, candidate_files, chains,
    check_file, check_joined_parts, check_target, closure, collisions, combinations, content, content_hash,
    defining_files, direct_embeddings, drawing_names, drawn_path, effective_parameters, embeds_others,
    file_index, has_clamp_layer, has_part_layer, heights_of_shims, keep_outs, likely_file, listing_error,
    locate, may_define, name_table, path, path_index, path_names, path_place, placed_keep_outs, placed_parts,
    prefetch, program, q_project, q_project_findings, raw_file, remaining_layers, resolve_path, search_path,
    second_definitions, summary, trace, traced_program, uncut_rings, unlistable_error,
};
