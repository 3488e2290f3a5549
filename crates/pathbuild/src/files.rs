//! Files that the program itself reads and writes: the configuration, reports, baselines. Drawings and programs go through the
//! database, which has to know every file that a result depends on.
#![expect(clippy::disallowed_methods, reason = "see above")]

use std::fs;
use std::io::{self, Write};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files;

/// Whether it is a file.
pub(crate) fn is_file(file: &Utf8Path) -> bool {
    file.as_std_path().is_file()
}

/// The text of a file, in UTF-8.
pub(crate) fn read(file: &Utf8Path) -> io::Result<String> {
    fs::read_to_string(file)
}

/// Writes a file that must not be there yet.
///
/// # Errors
/// A diagnostic that says why it cannot be written.
pub(crate) fn create(file: &Utf8Path, text: &str) -> Result<(), Box<Diagnostic>> {
    let written = fs::File::create_new(file).and_then(|mut new| new.write_all(text.as_bytes()));
    written.map_err(|reason| cannot_write(file, &reason))
}

/// Writes a file whole or not at all: beside it first, then under its name. What is no file, such as a device, is written to as it is.
///
/// # Errors
/// A diagnostic that says why it cannot be written.
pub(crate) fn replace(file: &Utf8Path, text: &str) -> Result<(), Box<Diagnostic>> {
    let beside = Utf8PathBuf::from(format!("{file}.{}.tmp", std::process::id()));
    if file.as_std_path().metadata().is_ok_and(|it| !it.is_file() && !it.is_dir()) {
        return fs::write(file, text).map_err(|reason| cannot_write(file, &reason));
    }
    let written = fs::write(&beside, text).and_then(|()| fs::rename(&beside, file));
    written.map_err(|reason| {
        // It may not even have been made.
        _ = fs::remove_file(&beside);
        cannot_write(file, &reason)
    })
}

fn cannot_write(file: &Utf8Path, reason: &io::Error) -> Box<Diagnostic> {
    let diagnostic = Diagnostic::new(&files::CANNOT_WRITE).in_file(file);
    let diagnostic = diagnostic.with("name", file.file_name().unwrap_or_default());
    Box::new(diagnostic.with("reason", reason.to_string()))
}
