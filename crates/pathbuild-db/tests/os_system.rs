//! Files of the operating system.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{OsSystem, ReadError, System};
use tempfile::TempDir;

/// A directory with a file of so many bytes.
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

/// What was read before is not seen again, whether that was longer or shorter.
#[test]
fn drawings_are_read_into_the_same_memory() {
    let mut bytes = b"x".repeat(50);
    for size in [100, 1000, 10, 0, 70] {
        let (_directory, path) = file(size);
        OsSystem.read_into(&path, 1000, &mut bytes).unwrap();
        assert_eq!(bytes, b"0123456789".repeat(size / 10));
    }
}
