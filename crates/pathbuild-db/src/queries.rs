//! The stages from a drawing to a program, each a memoized query. Who asks whom:
//!
//! ```text
//! program, check_target -> closure -> embeds -> summary -> path, chains -> raw_path -> raw_file
//!                                        \-> find_path -> files_for -> name_table
//! ```
//!
//! A check that goes through a library asks for less: `clear` -> `survey`, and what is above only of paths that are not clear.

mod brief;
mod clear;
mod combinations;
mod edges;
mod embedding;
mod fit;
mod hints;
mod instance;
mod joined;
mod layers;
mod lookup;
mod names;
mod q_projects;
mod raw;
mod reach;
mod reading;
mod report;
mod surveys;
mod texts;
mod traces;

use crate::database::Db;

pub use brief::{Brief, Head, Summary, head, summary};
pub use clear::{Clear, clear};
pub use combinations::combinations;
pub use edges::{Destination, Edge};
pub use embedding::{Embedding, Outcome, embeds};
pub use instance::{Instance, chains, path};
pub use joined::program;
pub use lookup::{Found, find_path, holders, likely_file, search_directories};
pub use names::{drawing_names, name_table};
pub use q_projects::{QProject, QProjectLine, q_project, q_project_findings};
pub use raw::{NameKey, PathPlace, content_hash, has_subpaths, path_names, path_place, raw_file, raw_path};
pub use reach::{Closure, MissingOption, Reached, closure};
pub use report::{check_file, check_target, locate};
pub use surveys::{Survey, survey};
pub use texts::assigned_texts;
pub use traces::{Sought, Trace, trace};

pub(crate) use names::{GatheredNames, NameTable};
pub(crate) use reading::internal_error;

/// Keeps at most so many results of each of the queries whose values are large and can be made again from a file.
pub(crate) fn bound(db: &mut dyn Db, kept: usize) {
    raw::bound(db, kept);
    instance::bound(db, kept);
}
