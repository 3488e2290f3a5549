//! The stages from a drawing to a program, each a memoized query. Their dependencies:
//!
//! ```text
//! program -> path, chains -> raw_path -> raw_file
//!        \-> closure -> embeds -> summary -> path_index -> file_index
//!                            \-> resolve_path -> name_table
//! ```
//!
//! If drawings have clamps, `program` also asks `keep_out_collisions`, which checks the moves of `traced_program` against `keep_outs`.
//!
//! A check of most drawings asks only for `file_index`; the parsed drawing is dropped as soon as the index exists. `raw_file` reads a
//! drawing again for programs, other values of variables, and the places of findings.

mod closures;
mod definitions;
mod embedding;
mod index;
mod keep_outs;
mod lookup;
mod nearby_ends;
mod neighbours;
mod part;
mod programs;
mod raw;
mod reading;
mod results;

pub use closures::{Closure, Destination, Edge, MissingOption, NameLookup, Trace, closure, trace};
pub use definitions::{SecondDefinition, may_define, second_definitions};
pub use embedding::{Embedding, Outcome, direct_embeddings};
pub use embedding::{Instance, chains, path, summary};
pub use index::{
    FileIndex, NameKey, PathIndex, PathSummary, content, content_hash, file_index, has_clamp_layer,
    has_part_layer, keep_outs, path_index, path_names,
};
pub use keep_outs::{Collision, PlacedKeepOut, collisions, placed_keep_outs};
pub use lookup::{
    ResolvedPath, candidate_files, defining_files, drawing_names, embeds_others, likely_file, listing_error,
    name_table, prefetch, resolve_path, search_path, unlistable_error,
};
pub use neighbours::placed_parts;
pub use part::uncut_rings;
pub use programs::{
    BoundPath, DrawnPath, TracedProgram, drawn_path, effective_parameters, heights_of_shims,
    remaining_layers, traced_program,
};
pub use raw::{PathPlace, assigned_texts, combinations, path_place, raw_file};
pub use results::{
    check_file, check_joined_parts, check_target, locate, program, q_project, q_project_findings,
};
