//! Tests of the files of the operating system.

#[cfg(target_os = "linux")]
use std::io::{Read, Write};
use std::ops::ControlFlow;
#[cfg(target_os = "linux")]
use std::process::{Command, Stdio};

use camino::{Utf8Path, Utf8PathBuf};
#[cfg(target_os = "linux")]
use pathbuild_diagnostic::Value;
#[cfg(target_os = "linux")]
use pathbuild_diagnostic::reasons::NOT_REGULAR;
#[cfg(unix)]
use pathbuild_files::{Entry, EntryKind};
use pathbuild_files::{OsSystem, ReadError, System};
use tempfile::TempDir;

/// Creates a directory with a file of this size in bytes.
fn file(size: usize) -> (TempDir, Utf8PathBuf) {
    let directory = tempfile::tempdir().expect("there is room for a directory");
    let path = Utf8Path::from_path(directory.path()).expect("it is UTF-8").join("drawing.dxf");
    OsSystem.write(&path, &b"0123456789".repeat(size / 10)).expect("it can be written");
    (directory, path)
}

#[test]
fn a_file_may_have_as_many_bytes_as_the_limit() {
    let (_directory, path) = file(1000);
    assert_eq!(OsSystem.read(&path, 1000).map(|bytes| bytes.len()), Ok(1000));
    assert_eq!(OsSystem.read(&path, 999), Err(ReadError::TooLarge { size: 1000 }));
}

/// Files of the kernel report no size, but are read nevertheless. The file in this test contains the environment of a process, and can be read once
/// the process runs.
#[cfg(target_os = "linux")]
#[test]
fn a_file_that_is_longer_than_it_says_is_read_up_to_the_limit() {
    let mut command = Command::new("cat");
    command.env_clear().env("PATH", "/usr/bin:/bin").stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut process = command.env("X", "x".repeat(100_000)).spawn().expect("cat runs");
    process.stdin.as_mut().expect("it is piped").write_all(b"?").expect("it is read");
    process.stdout.as_mut().expect("it is piped").read_exact(&mut [0]).expect("it is written");
    let path = Utf8PathBuf::from(format!("/proc/{}/environ", process.id()));
    let length = "PATH=/usr/bin:/bin".len() + "X=".len() + 100_000 + 2;
    let read = |limit| OsSystem.read(&path, limit).map(|bytes| bytes.len());
    let read = [length as u64, length as u64 - 1, 65_536, 65_535].map(read);
    process.kill().expect("it can be ended");
    process.wait().expect("it has ended");
    assert_eq!(read[0], Ok(length));
    assert!(read[1..].iter().all(|read| matches!(read, Err(ReadError::TooLarge { .. }))), "{read:?}");
}

/// The buffer contains nothing of its old content, whether that was longer or shorter than the new one.
#[test]
fn drawings_are_read_into_the_same_memory() {
    let mut room = b"x".repeat(50);
    for size in [100, 1000, 10, 0, 70, 65_530, 65_540, 200_000, 20] {
        let (_directory, path) = file(size);
        OsSystem.read_into(&path, 1_000_000, &mut room).unwrap();
        assert_eq!(room, b"0123456789".repeat(size / 10));
    }
}

/// A file is read to its end, even if its first part ends as a drawing does.
#[test]
fn what_follows_the_end_of_a_drawing_is_read() {
    let (_directory, path) = file(0);
    let ended = b"  0\nEOF\n".repeat(10_000);
    for size in [8, 16, 65_536, 80_000] {
        OsSystem.write(&path, &ended[..size]).unwrap();
        assert_eq!(OsSystem.read(&path, 1_000_000).map(|bytes| bytes.len()), Ok(size));
    }
}

/// A pipe is refused: reading it would wait for a writer, perhaps for ever.
#[cfg(target_os = "linux")]
#[test]
fn what_is_no_regular_file_is_refused() {
    use std::process::{Command, Stdio};

    let read = |path: &str| OsSystem.read(Utf8Path::new(path), 1_000_000);
    let refused = Err(ReadError::Other(Value::Prose(&NOT_REGULAR)));
    assert_eq!(read("/dev/zero"), refused);
    assert_eq!(read("/dev/null"), refused);
    assert_eq!(read("/dev"), Err(ReadError::IsDirectory));
    let mut sleeper = Command::new("sleep").arg("600").stdout(Stdio::piped()).spawn().unwrap();
    let pipe = read(&format!("/proc/{}/fd/1", sleeper.id()));
    sleeper.kill().unwrap();
    sleeper.wait().unwrap();
    assert_eq!(pipe, refused);
}

#[cfg(unix)]
fn entries(directory: &Utf8Path) -> Vec<(String, bool, EntryKind)> {
    let mut entries = Vec::new();
    let listed = OsSystem.each_entry(directory, &mut |Entry { name, is_exact, kind }| {
        entries.push((name.to_owned(), is_exact, kind));
        ControlFlow::Continue(())
    });
    assert_eq!(listed, Ok(()));
    entries.sort_by(|a, b| a.0.cmp(&b.0));
    entries
}

#[cfg(unix)]
#[test]
fn a_directory_says_what_is_a_file_a_directory_or_a_link() {
    use std::os::unix::fs::symlink;

    let (_guard, file) = file(10);
    let directory = file.parent().unwrap();
    OsSystem.write(&directory.join("below/drawing.dxf"), b"x").unwrap();
    symlink("below", directory.join("to-below")).unwrap();
    symlink("nowhere", directory.join("to-nowhere")).unwrap();
    let expected = [
        ("below", EntryKind::Directory),
        ("drawing.dxf", EntryKind::File),
        ("to-below", EntryKind::Link),
        ("to-nowhere", EntryKind::Link),
    ];
    assert_eq!(entries(directory), expected.map(|(name, kind)| (name.to_owned(), true, kind)));
    assert!(OsSystem.each_entry(&file, &mut |_| ControlFlow::Continue(())).is_err(), "a file has no entries");
}

/// A lossy name opens no file, unless a file really has that name.
#[cfg(target_os = "linux")]
#[test]
#[expect(clippy::disallowed_methods, reason = "System has no names that are no UTF-8")]
fn names_that_are_no_utf_8_are_told_from_what_they_are_shown_as() {
    use std::ffi::OsStr;
    use std::fs::File;
    use std::os::unix::ffi::OsStrExt;

    let (_guard, file) = file(10);
    let directory = file.parent().unwrap();
    let unspeakable = directory.as_std_path().join(OsStr::from_bytes(b"\xff.dxf"));
    File::create(unspeakable).unwrap();
    OsSystem.write(&directory.join("\u{fffe}.dxf"), b"x").unwrap();
    let exact: Vec<(String, bool)> =
        entries(directory).into_iter().map(|(name, is_exact, _)| (name, is_exact)).collect();
    let expected = [("drawing.dxf", true), ("\u{fffd}.dxf", false), ("\u{fffe}.dxf", true)];
    assert_eq!(exact, expected.map(|(name, is_exact)| (name.to_owned(), is_exact)));
}

#[test]
fn entries_end_where_there_are_enough() {
    let (_guard, file) = file(10);
    for name in ["a", "b"] {
        OsSystem.write(&file.with_file_name(name), b"x").unwrap();
    }
    let mut seen = 0;
    let listed = OsSystem.each_entry(file.parent().unwrap(), &mut |_| {
        seen += 1;
        if seen == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!((listed, seen), (Ok(()), 2));
}
