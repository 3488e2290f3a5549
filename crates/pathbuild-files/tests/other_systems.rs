//! Systems that replace the operating system: files in memory, and an overlay.
#![allow(clippy::unwrap_used, reason = "a test that cannot set up its files has failed")]

use std::sync::Arc;

use camino::Utf8Path;
use pathbuild_files::{MemorySystem, OverlaySystem, ReadError, System};

const NEW: &str = "parts/1002.dxf";

/// A drawing that is not written yet, over a directory with `1001.dxf`.
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
fn there_are_systems_without_a_clock() {
    assert!(MemorySystem::without_clock().now().is_none());
    assert!(MemorySystem::default().now().is_some());
}
