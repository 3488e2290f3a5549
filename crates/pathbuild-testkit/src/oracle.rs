//! External references that tests compare with. If one is absent, the test is skipped, which is reported and recorded.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The project's directory.
pub fn project() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Test data that is not ours to publish, in ../shared beside the project; `None` if it is absent, in which case the test is skipped.
#[expect(clippy::disallowed_methods, reason = "test data lies beside the project")]
pub fn shared(name: &str) -> Option<PathBuf> {
    let path = project().join("../shared").join(name);
    if path.exists() {
        return Some(path);
    }
    skip("shared", &format!("{} is missing", path.display()));
    None
}

/// Reports that a test is skipped, and why: on standard error, and in the file named by `PATHBUILD_SKIPPED`, since test runners hide the
/// output of passing tests.
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
