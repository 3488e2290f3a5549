//! Files that the program reads and writes for itself: configuration, reports, baselines. Drawings and programs go through the database,
//! which must know every file that a result depends on.
#![expect(clippy::disallowed_methods, reason = "see above")]

use std::fs;
use std::io::Write;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_diagnostic::reasons::{IS_THERE, LEADS_OUT, NO_DIRECTORY, NOT_UTF_8, cannot_write, reason};
use pathbuild_diagnostic::{Diagnostic, Value};

use crate::workspace::Workspace;

/// A file other than a drawing that a result depends on.
#[derive(Clone, Debug)]
pub struct ExtraInput {
    /// Path of the file.
    pub path: Utf8PathBuf,
    /// Hash of the bytes that were read; `None` if reading failed.
    pub hash: Option<[u8; 32]>,
}

/// Maximum number of symbolic links that are followed in a row, as on Linux.
#[cfg(not(target_family = "wasm"))]
pub(crate) const MAX_LINKS: usize = 40;

/// Whether this name exists and is not a directory. Also true for an unreadable file: the attempt to read it reports the error.
pub fn is_file_name_taken(file: &Utf8Path) -> bool {
    file.as_std_path().metadata().is_ok_and(|data| !data.is_dir())
}

/// Whether the name exists, even as a dangling symbolic link.
pub fn is_named(file: &Utf8Path) -> bool {
    file.as_std_path().symlink_metadata().is_ok()
}

/// Returns the size of a file in bytes; `None` if it cannot be determined.
pub fn size(file: &Utf8Path) -> Option<u64> {
    file.as_std_path().metadata().ok().map(|data| data.len())
}

/// Reads a file as UTF-8 text.
///
/// # Errors
/// The reason why it cannot be read. It must be a regular file of at most `limit` bytes.
pub fn read(system: &dyn System, file: &Utf8Path, limit: u64) -> Result<String, Value> {
    decode_utf8(system.read(file, limit).map_err(|error| error.reason(limit))?)
}

pub(crate) fn decode_utf8(bytes: Vec<u8>) -> Result<String, Value> {
    String::from_utf8(bytes).map_err(|_| Value::Prose(&NOT_UTF_8))
}

/// Creates files together with their missing parent directories. If one of them exists already or cannot be written, none is created. In an
/// untrusted tree, files outside the tree are refused.
///
/// # Errors
/// A diagnostic for each file that cannot be written.
pub fn create(context: &Workspace, files: &[(Utf8PathBuf, &[u8])]) -> Result<(), Vec<Diagnostic>> {
    let confined = context.settings.confined.as_ref();
    let leads_out =
        |(file, _): &&(Utf8PathBuf, &[u8])| confined.is_some_and(|confined| !confined.allows(file));
    let outside: Vec<Diagnostic> =
        files.iter().filter(leads_out).map(|(file, _)| write_error(file, &LEADS_OUT)).collect();
    if !outside.is_empty() {
        return Err(outside);
    }
    let is_there = |(file, _): &&(Utf8PathBuf, &[u8])| file.as_std_path().symlink_metadata().is_ok();
    let old: Vec<Diagnostic> =
        files.iter().filter(is_there).map(|(file, _)| write_error(file, &IS_THERE)).collect();
    if !old.is_empty() {
        return Err(old);
    }
    for (index, (file, content)) in files.iter().enumerate() {
        if let Err(error) = create_new(file, content) {
            // Undo the creation, so that the next attempt does not find these files.
            files[..index].iter().for_each(|(created, _)| _ = fs::remove_file(created));
            return Err(vec![write_error(file, reason(&error))]);
        }
    }
    Ok(())
}

/// Creates a file and writes its content; removes the file again if writing fails.
fn create_new(file: &Utf8Path, content: &[u8]) -> std::io::Result<()> {
    file.parent().map_or(Ok(()), fs::create_dir_all)?;
    let created = fs::File::create_new(file)?;
    write_whole(created, content).inspect_err(|_| _ = fs::remove_file(file))
}

/// Writes the content, and closes the file on return: it is passed by value because Windows does not remove open files.
fn write_whole(mut file: fs::File, content: &[u8]) -> std::io::Result<()> {
    file.write_all(content)
}

/// File name of a configuration.
pub const FILE_NAME: &str = "pathbuild.toml";

/// Names that a configuration has by mistake: Windows hides extensions, and other systems distinguish upper and lower case.
pub(crate) const MISTAKEN_NAMES: [&str; 6] = [
    "pathbuild.toml.txt",
    "pathbuild.toml.toml",
    "pathbuild.txt",
    "Pathbuild.toml",
    "PathBuild.toml",
    "PATHBUILD.TOML",
];

/// The file extensions of G-code programs; the first is for native programs. A post definition may choose another extension.
pub(crate) const PROGRAM_EXTENSIONS: [&str; 6] = ["gcode", "nc", "ngc", "tap", "cnc", "din"];

pub(crate) fn is_program(path: &Utf8Path) -> bool {
    path.extension().is_some_and(|own| PROGRAM_EXTENSIONS.iter().any(|known| own.eq_ignore_ascii_case(known)))
}

/// Atomically replaces a file. A device or a pipe cannot be replaced and is written to directly.
///
/// # Errors
/// A diagnostic with the reason why the file cannot be written.
pub fn replace(context: &Workspace, file: &Utf8Path, text: &str) -> Result<(), Box<Diagnostic>> {
    if !file.parent().is_none_or(|parent| parent.as_str().is_empty() || parent.as_std_path().is_dir()) {
        return Err(Box::new(write_error(file, &NO_DIRECTORY)));
    }
    let is_stream = file.as_std_path().metadata().is_ok_and(|data| !data.is_file() && !data.is_dir());
    let is_allowed = context.settings.confined.as_ref().is_none_or(|confined| confined.allows(file));
    let written = if is_stream && is_allowed {
        let written = open_stream(file).and_then(|stream| write_whole(stream, text.as_bytes()));
        written.map_err(|error| reason(&error))
    } else {
        context.system.write(file, text.as_bytes()).map(|_| ())
    };
    written.map_err(|reason| Box::new(write_error(file, reason)))
}

/// Opens a device or a pipe for writing. Fails if the pipe has no reader, but waits for a slow reader.
#[cfg(unix)]
fn open_stream(path: &Utf8Path) -> std::io::Result<fs::File> {
    use rustix::fs::{Mode, OFlags};

    let flags = OFlags::WRONLY | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
    let stream = rustix::fs::open(path.as_str(), flags, Mode::empty())?;
    rustix::fs::fcntl_setfl(&stream, OFlags::empty())?;
    Ok(stream.into())
}

#[cfg(not(unix))]
fn open_stream(path: &Utf8Path) -> std::io::Result<fs::File> {
    fs::File::options().write(true).open(path)
}

/// Returns PB004 for a file that cannot be written.
pub fn write_error(file: &Utf8Path, reason: impl Into<Value>) -> Diagnostic {
    let name = file.file_name().unwrap_or_default();
    cannot_write(name, reason).in_file(file)
}
