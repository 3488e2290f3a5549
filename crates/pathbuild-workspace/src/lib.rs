//! What a `pathbuild.toml` describes: the configuration, finding drawings, sessions over the database, results kept between runs, the jobs
//! of `check` and `emit`, the watch loop. It parses no arguments and prints nothing: what somebody who waits may want to hear goes to a
//! [`Reporter`] or a `watch::Listener`. (book: reference/configuration)

pub mod check;
pub mod config;
pub mod diff;
pub mod emit;
pub mod files;
pub mod findings;
mod inputs;
pub mod list;
pub mod machine;
pub mod posting;
mod reporter;
pub mod session;
// Nobody else changes what a page in a browser was given.
#[cfg(not(target_family = "wasm"))]
pub mod watch;
mod workspace;

pub use pathbuild_cache::Home as CacheHome;

pub use inputs::{Input, Inputs};
pub use reporter::{Advance, Reporter, Silent};
pub use workspace::Workspace;
