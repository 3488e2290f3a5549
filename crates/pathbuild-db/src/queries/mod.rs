//! The stages from a drawing to a program, each a memoized query. Their dependencies:
//!
//! ```text
//! program -> path, chains -> raw_path -> raw_file
//!        \-> closure -> embeds -> summary -> path_index -> file_index
//!                            \-> resolve_path -> name_table
//! ```
//!
//! If drawings have clamps, `program` also asks `entered_keep_outs`, which checks the moves of `traced_program` against `keep_outs`.
//!
//! A check of most drawings asks only for `file_index`; the parsed drawing is dropped as soon as the index exists. `raw_file` reads a
//! drawing again for programs, other values of variables, and the places of findings.

mod binding;
mod closures;
mod combinations;
mod edges;
mod embedding;
mod index;
mod instance;
mod keep_outs;
mod lookup;
mod names;
mod nearby_ends;
mod prefetch;
mod programs;
mod q_projects;
mod raw;
mod reading;
mod report;
mod rereading;
mod summary;
mod texts;
mod traces;
mod views;

pub use closures::{Closure, MissingOption, ReachedPath, closure};
pub use combinations::combinations;
pub use edges::{Destination, Edge};
pub use embedding::{Embedding, Outcome, embeds};
pub use index::{FileIndex, NameKey, PathIndex, content, content_hash, file_index, path_index, path_names};
pub use instance::{Instance, chains, path, summary};
pub use keep_outs::{PlacedKeepOut, keep_outs, placed_keep_outs};
pub use lookup::{ResolvedPath, holders, may_hold, resolve_path, search_path};
pub use names::{drawing_names, name_table, unlistable, unlisted};
pub use prefetch::{embeds_others, likely_file, prefetch};
pub use programs::program;
pub use q_projects::{q_project, q_project_findings};
pub use raw::{PathPlace, path_place, raw_file};
pub use report::{check_file, check_target, locate};
pub use summary::PathSummary;
pub use texts::assigned_texts;
pub use traces::{NameLookup, Trace, trace};
pub use views::{DrawnPath, Part, TracedProgram, drawn_path, in_force, other_layers, traced_program};
