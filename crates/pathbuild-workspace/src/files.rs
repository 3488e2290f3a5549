//! Files that the program itself reads and writes: the configuration, reports, baselines. Drawings and programs go through the
//! database, which has to know every file that a result depends on.
#![expect(clippy::disallowed_methods, reason = "see above")]

use std::fs;
use std::io::{self, Read, Seek, SeekFrom, Write};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::ReadError;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files;

/// Whether it is a file.
pub fn is_file(file: &Utf8Path) -> bool {
    file.as_std_path().is_file()
}

/// The text of a file, in UTF-8.
pub fn read(file: &Utf8Path) -> io::Result<String> {
    fs::read_to_string(file)
}

/// The last bytes of a file, at most so many; `None` where there is none.
pub fn tail(file: &Utf8Path, length: u64) -> Option<Vec<u8>> {
    let mut open = fs::File::open(file).ok()?;
    let size = open.metadata().ok()?.len();
    open.seek(SeekFrom::Start(size.saturating_sub(length))).ok()?;
    let mut tail = Vec::new();
    open.take(length).read_to_end(&mut tail).ok()?;
    Some(tail)
}

/// Writes a file that must not be there yet.
///
/// # Errors
/// A diagnostic that says why it cannot be written.
pub fn create(file: &Utf8Path, text: &str) -> Result<(), Box<Diagnostic>> {
    let written = fs::File::create_new(file).and_then(|mut new| new.write_all(text.as_bytes()));
    written.map_err(|reason| Box::new(cannot_write(file, &reason.to_string())))
}

/// Writes a file whole or not at all: beside it first, then under its name. What is no file, such as a device, is written to as it is.
///
/// # Errors
/// A diagnostic that says why it cannot be written.
pub fn replace(file: &Utf8Path, text: &str) -> Result<(), Box<Diagnostic>> {
    let beside = Utf8PathBuf::from(format!("{file}.{}.tmp", std::process::id()));
    if file.as_std_path().metadata().is_ok_and(|it| !it.is_file() && !it.is_dir()) {
        return fs::write(file, text).map_err(|reason| Box::new(cannot_write(file, &reason.to_string())));
    }
    let written = fs::write(&beside, text).and_then(|()| fs::rename(&beside, file));
    written.map_err(|reason| {
        // It may not even have been made.
        _ = fs::remove_file(&beside);
        Box::new(cannot_write(file, &reason.to_string()))
    })
}

/// Why a file that was named cannot be read; `limit` is that of `[limits] file-size`.
pub fn unreadable(file: &Utf8Path, error: &ReadError, limit: u64) -> Diagnostic {
    let diagnostic = match error {
        ReadError::Missing => Diagnostic::new(&files::MISSING),
        ReadError::IsDirectory => Diagnostic::new(&files::UNREADABLE).with("reason", "it is a directory"),
        ReadError::Other(reason) => Diagnostic::new(&files::UNREADABLE).with("reason", &**reason),
        ReadError::TooLarge { size } => Diagnostic::new(&files::LIMIT)
            .with("what", format!("the file's size of {size} bytes"))
            .with("limit", format!("{limit} bytes"))
            .with("key", "file-size"),
    };
    diagnostic.in_file(file)
}

/// PB004.
pub fn cannot_write(file: &Utf8Path, reason: &str) -> Diagnostic {
    let name = file.file_name().unwrap_or_default();
    Diagnostic::new(&files::CANNOT_WRITE).with("name", name).with("reason", reason).in_file(file)
}
