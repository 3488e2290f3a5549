//! Configuration, discovery of drawings, database sessions, results cached between runs, and the requests of `check`, `emit`, `list`, `diff`,
//! `verify`, `post` and `watch`. This crate neither parses arguments nor prints: progress is reported to a [`Reporter`] or a `watch::Listener`. (book:
//! reference/configuration)

pub mod baseline;
pub mod check;
mod common_findings;
pub mod config;
pub mod diff;
pub mod emit;
pub mod files;
pub mod findings;
#[cfg(not(target_family = "wasm"))]
pub mod git;
mod inputs;
pub mod list;
#[cfg(not(target_family = "wasm"))]
pub mod machine;
pub mod memo;
pub mod post_processor;
pub mod program;
pub mod program_view;
pub mod protected_files;
#[cfg(not(target_family = "wasm"))]
pub mod revision;
pub mod rewrite;
pub mod session;
pub mod settle;
pub mod verify;
pub mod waivers;
// In the browser all files come from the page, so there is nothing to watch.
#[cfg(not(target_family = "wasm"))]
pub mod watch;
mod workspace;

pub use pathbuild_cache::CacheLocation as CacheHome;

pub use inputs::{Input, Inputs};
pub use workspace::{Failure, ProgressCounter, Reporter, SilentReporter, Workspace, relative};
