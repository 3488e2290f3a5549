//! Tests of systems that replace the operating system: files in memory, an overlay, and relative paths from a directory.
#![allow(clippy::unwrap_used, reason = "a test that cannot set up its files has failed")]

use std::ops::ControlFlow;
use std::sync::Arc;

use camino::Utf8Path;
use pathbuild_files::{
    Entry, FileKind, FixedDirectorySystem, MemorySystem, OverlaySystem, ReadError, System, WriteOutcome,
};
#[cfg(unix)]
use pathbuild_files::{FileLink, OsSystem};

const NEW: &str = "parts/1002.dxf";

/// Returns an overlay with a drawing that is not written yet, over a directory with `1001.dxf`.
fn overlay(new: &str) -> OverlaySystem {
    let below = MemorySystem::default();
    below.put("parts/1001.dxf", "old");
    OverlaySystem::new(Arc::new(below), new.into(), b"0123456789".to_vec())
}

fn names(system: &dyn System, directory: &str) -> Vec<String> {
    let listing = system.list(Utf8Path::new(directory)).unwrap_or_default();
    let mut names: Vec<String> = listing.files.iter().map(ToString::to_string).collect();
    names.sort();
    names
}

#[test]
fn a_drawing_that_is_not_written_yet_is_read_up_to_the_limit() {
    let path = Utf8Path::new(NEW);
    assert_eq!(overlay(NEW).read(path, 10).as_deref(), Ok(&b"0123456789"[..]));
    assert_eq!(overlay(NEW).read(path, 9), Err(ReadError::TooLarge { size: 10 }));
    assert_eq!(overlay(NEW).read(Utf8Path::new("parts/1001.dxf"), 9).as_deref(), Ok(&b"old"[..]));
}

#[test]
fn a_drawing_that_is_not_written_yet_is_listed_once_where_it_will_lie() {
    assert_eq!(names(&overlay(NEW), "parts"), ["1001.dxf", "1002.dxf"]);
    assert_eq!(names(&overlay("parts/1001.dxf"), "parts"), ["1001.dxf"]);
    assert_eq!(names(&overlay("new/1002.dxf"), "parts"), ["1001.dxf"]);
    assert_eq!(names(&overlay("new/1002.dxf"), "new"), ["1002.dxf"]);
}

#[test]
fn a_file_in_memory_is_unchanged_by_writing_its_own_content() {
    let (system, path) = (MemorySystem::default(), Utf8Path::new(NEW));
    let write = |bytes: &[u8]| system.write(path, bytes).unwrap();
    assert_eq!(write(b"old"), WriteOutcome::Changed);
    assert_eq!(write(b"old"), WriteOutcome::Unchanged);
    assert_eq!(write(b"new"), WriteOutcome::Changed);
    assert_eq!(system.read(path, 9).as_deref(), Ok(&b"new"[..]));
}

#[test]
fn there_are_systems_without_a_clock() {
    assert!(MemorySystem::without_clock().now().is_none());
    assert!(MemorySystem::default().now().is_some());
}

/// Each function resolves a relative path against the directory, and leaves an absolute one as it is.
#[test]
fn relative_paths_begin_at_a_directory() {
    let below = Arc::new(MemorySystem::without_clock());
    below.put("/library/parts/1001.dxf", "drawing");
    below.put("/other/1002.dxf", "another");
    let system = FixedDirectorySystem::new(below.clone(), "/library".into());
    let (inside, outside) = (Utf8Path::new("parts/1001.dxf"), Utf8Path::new("/other/1002.dxf"));
    assert_eq!(system.read(inside, 99).as_deref(), Ok(&b"drawing"[..]));
    assert_eq!(system.read(outside, 99).as_deref(), Ok(&b"another"[..]));
    assert_eq!(system.read_head(inside, 4).as_deref(), Ok(&b"draw"[..]));
    assert_eq!(system.read_tail(inside, 3).as_deref(), Ok(&b"ing"[..]));
    assert_eq!(system.kind(inside), FileKind::File);
    assert_eq!(system.kind(Utf8Path::new("")), FileKind::Directory);
    assert_eq!(names(&system, "parts"), ["1001.dxf"]);
    let mut entries = Vec::new();
    let each = &mut |entry: Entry<'_>| {
        entries.push(entry.name.to_owned());
        ControlFlow::Continue(())
    };
    system.each_entry(Utf8Path::new("parts"), each).unwrap();
    assert_eq!(entries, ["1001.dxf"]);
    assert_eq!(system.canonical(inside), below.canonical(Utf8Path::new("/library/parts/1001.dxf")));
    assert!(system.now().is_none());
    system.write(Utf8Path::new("parts/1003.dxf"), b"new").unwrap();
    assert_eq!(names(&*below, "/library/parts"), ["1001.dxf", "1003.dxf"]);
    system.remove(inside).unwrap();
    assert_eq!(names(&*below, "/library/parts"), ["1003.dxf"]);
}

#[cfg(unix)]
#[test]
fn links_are_found_from_a_directory() {
    let directory = tempfile::TempDir::new().unwrap();
    let root = Utf8Path::from_path(directory.path()).unwrap();
    std::os::unix::fs::symlink("1001.dxf", root.join("1002.dxf")).unwrap();
    let system = FixedDirectorySystem::new(OsSystem::shared(), root.to_owned());
    assert_eq!(system.link(Utf8Path::new("1002.dxf")), Some(FileLink::Symbolic("1001.dxf".into())));
}
