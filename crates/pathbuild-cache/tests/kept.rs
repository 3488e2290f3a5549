//! What is kept comes back as it was, and holds as long as what it was made from is as it was.

#![allow(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot set up its files has failed"
)]

use std::fs;
use std::thread::sleep;
use std::time::Duration;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{
    Catalogue, Decoder, DirectoryFact, Encoder, FileFact, FileState, Key, ListingKind, Lookup, Place, Record,
    Stamp, Unusable, decode_diagnostic, encode_diagnostic, verify,
};
use pathbuild_diagnostic::messages::{self, parameters};
use pathbuild_diagnostic::{
    Diagnostic, EntityKind, Handle, Number, Point, TextFault, TraceStep, Value, words,
};
use tempfile::TempDir;

fn place() -> (TempDir, Utf8PathBuf) {
    let directory = TempDir::new().unwrap();
    let path = Utf8PathBuf::from_path_buf(directory.path().to_owned()).unwrap();
    (directory, path)
}

/// A result made from one drawing, and from the question which files may hold 1234.1P.
fn catalogue(base: &Utf8Path, stamp: Stamp, bytes: &[u8]) -> Catalogue {
    let record = Record {
        of: "a.dxf".into(),
        files: vec![0],
        lookups: vec![Lookup { directory: 0, name: "1234.1P".into() }],
        payload: b"result".to_vec(),
    };
    let hash = Some(*blake3::hash(bytes).as_bytes());
    Catalogue {
        files: vec![FileFact { path: base.join("a.dxf"), stamp, hash }],
        directories: vec![DirectoryFact::now(base, ListingKind::Drawings, base)],
        records: vec![record],
    }
}

fn covers(file: &str, path: &str) -> bool {
    path.starts_with(&file[..4])
}

#[test]
fn every_message_comes_back_with_all_its_values() {
    for message in messages::all() {
        let mut diagnostic = Diagnostic::new(message)
            .with("text", "ä\n\"")
            .with("number", -0.1)
            .with("count", 7_u64)
            .with("point", Point::new(1.5, -2.0))
            .with("list", ["a", "b"].iter().collect::<Value>())
            .with("word", &words::SWEEP)
            .note(&parameters::MISSING_MATERIAL, vec![("where", "here".into())])
            .in_file(Utf8Path::new("a/b.dxf"))
            .in_path("1234.1P")
            .with_text(TextFault::new("T5 O2", 3..5));
        diagnostic.place.line = Some(7);
        diagnostic.place.handle = Some(Handle(0x1AF));
        diagnostic.place.entity = Some(EntityKind::Arc);
        diagnostic.place.point = Some(Point { x: Number(0.0), y: Number(1e300) });
        diagnostic.trace =
            vec![TraceStep { file: "c.dxf".into(), path: "8001.1P".into(), point: Point::new(1.0, 2.0) }];
        let mut encoder = Encoder::default();
        encode_diagnostic(&mut encoder, &diagnostic);
        let bytes = encoder.finish();
        assert_eq!(decode_diagnostic(&mut Decoder::new(&bytes)), Ok(diagnostic));
        assert!(
            (0..bytes.len()).all(|length| decode_diagnostic(&mut Decoder::new(&bytes[..length])).is_err())
        );
    }
}

#[test]
fn a_catalogue_is_found_under_its_key_and_build_only() {
    let (_directory, base) = place();
    let place = Place::beside(&base);
    let kept = catalogue(&base, Stamp::MISSING, b"");
    let key = Key::new("build", "question");
    assert_eq!(place.load(&key), Ok(None));
    place.store(&key, &kept).unwrap();
    assert_eq!(place.load(&key), Ok(Some(kept)));
    assert_eq!(place.load(&Key::new("build", "other")), Ok(None));
    assert_eq!(place.load(&Key::new("other", "question")), Err(Unusable::Foreign));
}

#[test]
fn a_file_that_has_not_rested_is_compared_by_its_bytes() {
    let (_directory, base) = place();
    let file = base.join("a.dxf");
    fs::write(&file, "one").unwrap();
    let begun = Place::beside(&base).clock().unwrap();
    let stamp = Stamp::settled(&file, begun);
    assert_eq!(stamp, Stamp::UNKNOWN);
    let kept = catalogue(&base, stamp, b"one");
    let verdict = verify(&kept, &base, &covers);
    assert_eq!((verdict.files[0], verdict.holds[0], verdict.is_current), (FileState::Restored, true, false));
    // Of the same size, and perhaps within the same tick of the clock.
    fs::write(&file, "two").unwrap();
    assert_eq!(verify(&kept, &base, &covers).holds, [false]);
}

#[test]
fn a_file_that_has_rested_is_known_by_its_stamp() {
    let (_directory, base) = place();
    let file = base.join("a.dxf");
    fs::write(&file, "one").unwrap();
    // A tick of the coarsest clock, and what a clock that counts seconds may hide.
    sleep(Duration::from_millis(3200));
    let begun = Place::beside(&base).clock().unwrap();
    let stamp = Stamp::settled(&file, begun);
    assert_ne!(stamp, Stamp::UNKNOWN);
    let kept = catalogue(&base, stamp, b"one");
    assert!(verify(&kept, &base, &covers).is_current);
    fs::write(&file, "two").unwrap();
    assert_eq!(verify(&kept, &base, &covers).files, [FileState::Changed]);
    fs::write(&file, "one").unwrap();
    assert_eq!(verify(&kept, &base, &covers).files, [FileState::Restored]);
    fs::remove_file(&file).unwrap();
    assert_eq!(verify(&kept, &base, &covers).holds, [false]);
}

#[test]
fn only_names_that_may_hold_what_was_looked_for_are_an_answer() {
    let (_directory, base) = place();
    fs::write(base.join("a.dxf"), "one").unwrap();
    let kept = catalogue(&base, Stamp::UNKNOWN, b"one");
    fs::write(base.join("5678.dxf"), "").unwrap();
    fs::write(base.join("1234.txt"), "").unwrap();
    assert_eq!(verify(&kept, &base, &covers).holds, [true]);
    fs::write(base.join("1234 gear.DXF"), "").unwrap();
    assert_eq!(verify(&kept, &base, &covers).holds, [false]);
}

#[cfg(unix)]
#[test]
fn where_links_decide_what_is_what_everything_is_asked_again() {
    let (_directory, base) = place();
    fs::write(base.join("a.dxf"), "one").unwrap();
    let kept = catalogue(&base, Stamp::UNKNOWN, b"one");
    std::os::unix::fs::symlink("a.dxf", base.join("5678.dxf")).unwrap();
    assert_eq!(verify(&kept, &base, &covers).holds, [false]);
}
