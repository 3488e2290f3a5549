//! Shared support for tests, benchmarks and the examples of `explain`. It is not part of the product.
//!
//! [`sheet`] parses a drawing in the text form that README.md describes; a [`Fixture`] contains several drawings and other files in one
//! text, with commands and their expected results; [`generate`] creates libraries of any size; [`draw`] builds drawings in Rust.

pub mod draw;
mod fixture;
pub mod generate;
pub mod naive;
mod parse;
mod random;
mod random_library;
mod surroundings;
pub use crate::draw::{
    Block, Draft, DrawError, Entity, Layer, Options, Point, Shape, Sheet, TextCircle, Version, model,
    text_circle,
};
pub use fixture::{Command, Content, Expect, Fixture, FixtureFile};
pub use parse::sheet;
pub use random_library::RandomLibrary;

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Compiles the examples of README.md as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;

/// Returns the project's directory.
pub fn project() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Returns the path of test data in ../shared beside the project, which is not ours to publish. If it is absent, reports that the test is skipped
/// and returns `None`.
#[expect(clippy::disallowed_methods, reason = "test data lies beside the project")]
pub fn shared(name: &str) -> Option<PathBuf> {
    let path = project().join("../shared").join(name);
    if path.exists() {
        return Some(path);
    }
    skip("shared", &format!("{} is missing", path.display()));
    None
}

/// Reports that a test is skipped because an oracle (a program or data set to compare with) is missing, and why: on standard error, and in the
/// file named by `PATHBUILD_SKIPPED`, since test runners hide the output of passing tests.
///
/// # Panics
/// If `PATHBUILD_REQUIRE` names the oracle.
pub fn skip(oracle: &str, reason: &str) {
    assert!(!is_required(oracle), "PATHBUILD_REQUIRE has {oracle}: {reason}");
    let test = std::thread::current().name().unwrap_or("a test").to_owned();
    let line = format!("skipped: {test}: {reason}\n");
    _ = std::io::stderr().write_all(line.as_bytes());
    if let Some(file) = std::env::var_os("PATHBUILD_SKIPPED") {
        let noted = File::options().create(true).append(true).open(&file);
        noted.and_then(|mut file| file.write_all(line.as_bytes())).expect("skips can be noted");
    }
}

/// Whether the absence of an oracle fails the test.
#[expect(clippy::disallowed_methods, reason = "the environment says which oracles there are")]
pub fn is_required(oracle: &str) -> bool {
    std::env::var("PATHBUILD_REQUIRE").is_ok_and(|names| names.split(',').any(|name| name == oracle))
}
