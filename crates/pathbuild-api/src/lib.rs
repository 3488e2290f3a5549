//! pathbuild as a library: checks drawings of milling paths and compiles them to G-code.
//!
//! A [`Library`] is a directory of drawings with the `pathbuild.toml` that applies there. It offers what the command-line program does; the program's
//! own commands `check`, `emit`, `list` and `verify` use it. It checks the drawings ([`check`](Library::check)), lists their paths
//! ([`paths`](Library::paths)), returns the moves of a path ([`path`](Library::path)) and its G-code ([`program`](Library::program)), writes programs
//! ([`emit`](Library::emit)), tells which path embeds which ([`embedders`](Library::embedders)), verifies programs of any origin
//! ([`verify`](Library::verify)), and checks again whenever a drawing changes ([`watch`](Library::watch)).
//!
//! ```
//! use pathbuild_api::{Error, Lang, Library};
//!
//! # fn main() -> Result<(), Error> {
//! let library = Library::open("../../fixtures/library")?;
//! for finding in library.check(&[])?.findings {
//!     println!("{} {}", finding.code(), finding.message(Lang::En));
//! }
//! let path = library.path("8001.1P")?;
//! let fastest = path.moves.iter().filter_map(|movement| movement.feed).fold(0.0, f64::max);
//! println!("{}: {} moves, at most {fastest} mm/min", path.name, path.moves.len());
//! # assert!(fastest > 0.0);
//! # Ok(())
//! # }
//! ```
//!
//! Lengths are in mm, feeds in mm/min, angles in degrees, times in minutes. File names in results are relative to the directory that was
//! opened if the files lie below it, otherwise absolute; file names in requests are relative to it or absolute. The letters of parameters
//! (M for the material, T, O, F) and the rest of the drawing language are described in the book that comes with pathbuild;
//! "(book: language/letters)" is its page `docs/en/src/language/letters.md`.
//!
//! A [`Finding`] is a result, like an error message of a compiler; an [`Error`] is the reason why a request has no result. No drawing makes
//! this crate panic.
//!
//! Three programs in `examples/` show more: a report of feeds, moves as CSV, and a custom check.
//!
//! # Stability
//!
//! This is the only crate of pathbuild whose public items keep their meaning between versions; types that may grow are
//! `#[non_exhaustive]`. `public-items.txt` lists all public items. The crates that this one uses may change in any version.

mod baseline;
mod finding;
mod library;
mod options;
mod path;
mod report;
mod verify;
mod watch;

pub use baseline::{BaselineOptions, WrittenBaseline};
pub use finding::{Embedding, Error, Finding};
pub use library::Library;
pub use options::{CheckOptions, EmitOptions, LibraryOptions, ListOptions};
pub use path::{Arc, Element, Move, MoveKind, Parameter, Path, Statistics};
pub use pathbuild_diagnostic::Lang;
pub use report::{
    CheckReport, CheckedDrawing, EmitReport, FileState, GraphEdge, GraphReport, LeftOutElements, OutputFile,
    PathListing, PathSummary, PostBuild, ProgramState, ProgramText,
};
pub use verify::{CheckState, DrawingComparison, ProgramCheck, VerifiedProgram, VerifyOptions, VerifyReport};
pub use watch::{WatchEnd, WatchReport};
