//! Builds the books as HTML with mdBook, if available: `PATHBUILD_MDBOOK` names the program.

use std::process::Command;

use pathbuild_testkit::skip;

use crate::support::project;

/// The version of mdBook with which the books are built.
const VERSION: &str = "mdbook v0.4.52";

#[test]
fn the_books_become_html() {
    let program = std::env::var("PATHBUILD_MDBOOK").unwrap_or_else(|_| "mdbook".to_owned());
    let version = Command::new(&program).arg("--version").output();
    let version = version.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    if version.as_deref().ok() != Some(VERSION) {
        return skip("mdbook", &format!("{program} is {version:?}, not {VERSION}: no HTML of the books"));
    }
    let output = tempfile::tempdir().unwrap();
    for lang in ["en", "de"] {
        let book = output.path().join(lang).join("src");
        let source = project().join("docs").join(lang);
        let run = Command::new(&program).arg("build").arg(source).arg("-d").arg(&book).output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        assert!(book.join("introduction.html").exists() && book.join("pictures").is_dir());
    }
}
