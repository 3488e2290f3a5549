//! Tests that a stored catalogue is loaded unchanged, and that its results hold as long as their inputs are unchanged.

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
    CacheFault, CacheLocation, Catalogue, DirectoryFact, FileFact, FileState, Key, Listing, Listings, Lookup,
    Record, TreeStore, Verdict, VerifyContext, decode, encode,
};
use pathbuild_diagnostic::messages::{self, parameters};
use pathbuild_diagnostic::{
    Diagnostic, EntityKind, Handle, Number, Point, TextFault, TraceStep, Value, words,
};
use pathbuild_files::{FileSystemTime, Stamp};
use tempfile::TempDir;

fn place() -> (TempDir, Utf8PathBuf) {
    let directory = TempDir::new().unwrap();
    let path = Utf8PathBuf::from_path_buf(directory.path().to_owned()).unwrap();
    (directory, path)
}

/// Returns a catalogue with one result, which depends on one drawing and on a lookup of 1234.1P.
fn catalogue(base: &Utf8Path, stamp: Stamp, bytes: &[u8]) -> Catalogue {
    let record = Record {
        subject: "a.dxf".into(),
        files: vec![0],
        lookups: vec![0],
        payload: b"result".to_vec(),
        ..Record::default()
    };
    let hash = Some(*blake3::hash(bytes).as_bytes());
    Catalogue {
        files: vec![FileFact { path: base.join("a.dxf"), stamp, hash }],
        directories: vec![DirectoryFact::read_current(base, base)],
        directory_lists: vec![vec![0]],
        lookups: vec![Lookup { directories: 0, name: "1234.1P".into() }],
        records: vec![record],
    }
}

fn stored(catalogue: &Catalogue) -> Catalogue {
    let (_directory, base) = place();
    let place = cache(&base);
    let key = Key::new("build", "question");
    place.store(&key, catalogue.clone()).unwrap();
    place.load(&key).unwrap().unwrap()
}

fn verify(catalogue: &Catalogue, base: &Utf8Path, covers: pathbuild_cache::CoversFn<'_>) -> Verdict {
    pathbuild_cache::verify(&stored(catalogue), context(base, covers), Listings::new())
}

fn covers(file: &str, path: &str) -> bool {
    file.get(..4).is_some_and(|begin| path.starts_with(begin))
}

/// Returns a context in which everything is verified and output files are hashed as a whole.
fn context<'a>(base: &'a Utf8Path, covers: pathbuild_cache::CoversFn<'a>) -> VerifyContext<'a> {
    let hash_output = &|_: &Utf8Path, bytes: &[u8]| *blake3::hash(bytes).as_bytes();
    VerifyContext { base, covers, is_requested: &|_| true, is_allowed: &|_| true, read: &read, hash_output }
}

fn cache(base: &Utf8Path) -> TreeStore {
    let place = TreeStore::of_tree(&CacheLocation::Named(base.join("cache")), base);
    place.create().unwrap();
    place
}

#[test]
fn every_message_comes_back_with_all_its_values() {
    for message in messages::all() {
        let mut diagnostic = Diagnostic::new(message)
            .quoting("text", "ä\n\"")
            .with("number", -0.1)
            .with("count", 7_u64)
            .with("point", Point::new(1.5, -2.0))
            .with("list", ["a", "b"].iter().collect::<Value>())
            .with("word", &words::SWEEP)
            .note(&parameters::MISSING_MATERIAL, vec![("where", Value::quoted("here"))])
            .in_file(Utf8Path::new("a/b.dxf"))
            .in_path("1234.1P")
            .with_text(TextFault::new("T5 O2", 3..5));
        diagnostic.place.line = Some(7);
        diagnostic.place.handle = Some(Handle(0x1AF));
        diagnostic.place.entity = Some(EntityKind::Arc);
        diagnostic.place.point = Some(Point { x: Number(0.0), y: Number(1e300) });
        diagnostic.trace =
            vec![TraceStep { file: "c.dxf".into(), path: "8001.1P".into(), point: Point::new(1.0, 2.0) }];
        let bytes = encode(&diagnostic).unwrap();
        assert_eq!(decode(&bytes), Ok(diagnostic));
        let is_refused = |bytes: &[u8]| decode::<Diagnostic>(bytes).is_err();
        assert!((0..bytes.len()).all(|length| is_refused(&bytes[..length])));
        assert!(is_refused(&[&bytes[..], &[0]].concat()), "it goes on");
    }
}

#[test]
fn a_catalogue_is_found_under_its_key_and_build_only() {
    let (_directory, base) = place();
    let place = cache(&base);
    let snapshot = catalogue(&base, Stamp::MISSING, b"");
    let key = Key::new("build", "question");
    assert_eq!(place.load(&key), Ok(None));
    place.store(&key, snapshot.clone()).unwrap();
    assert_eq!(place.load(&key), Ok(Some(snapshot)));
    assert_eq!(place.load(&Key::new("build", "other")), Ok(None));
    assert_eq!(place.load(&Key::new("other", "question")), Err(CacheFault::Foreign));
}

/// Writes a file and waits for `rest`. Returns the file, and the time at which a run begins afterwards.
fn written(base: &Utf8Path, rest: Duration) -> (Utf8PathBuf, FileSystemTime) {
    let file = base.join("a.dxf");
    fs::write(&file, "one").unwrap();
    sleep(rest);
    (file, cache(base).clock().unwrap())
}

fn read(file: &Utf8Path, _: bool) -> Option<(Vec<u8>, Stamp)> {
    Some((fs::read(file).ok()?, Stamp::of(file)))
}

#[test]
fn a_file_that_has_not_rested_is_compared_by_its_bytes() {
    let (_directory, base) = place();
    let (file, begun) = written(&base, Duration::ZERO);
    let stamp = Stamp::of(&file).for_storing(begun);
    assert_eq!(stamp, Stamp::UNKNOWN);
    let snapshot = catalogue(&base, stamp, b"one");
    let verdict = verify(&snapshot, &base, &covers);
    let expected = (FileState::Touched(Stamp::of(&file)), true, false);
    assert_eq!((verdict.files[0], verdict.is_valid[0], verdict.is_current), expected);
    // The new content has the same size, and is perhaps written within the same tick of the clock.
    fs::write(&file, "two").unwrap();
    assert_eq!(verify(&snapshot, &base, &covers).is_valid, [false]);
}

#[test]
fn a_file_that_has_rested_is_known_by_its_stamp() {
    let (_directory, base) = place();
    // The pause is longer than a tick of the coarsest clock plus a second.
    let (file, begun) = written(&base, Duration::from_millis(3200));
    let stamp = Stamp::of(&file).for_storing(begun);
    assert_ne!(stamp, Stamp::UNKNOWN);
    let snapshot = catalogue(&base, stamp, b"one");
    assert!(verify(&snapshot, &base, &covers).is_current);
    fs::write(&file, "two").unwrap();
    assert_eq!(verify(&snapshot, &base, &covers).files, [FileState::Changed]);
    fs::write(&file, "one").unwrap();
    assert_eq!(verify(&snapshot, &base, &covers).files, [FileState::Touched(Stamp::of(&file))]);
    fs::remove_file(&file).unwrap();
    assert_eq!(verify(&snapshot, &base, &covers).is_valid, [false]);
}

/// Setting a file's time back must not make a new file look old: the stamp belongs to the bytes that were read.
#[test]
fn the_stamp_that_bytes_were_read_under_is_what_they_rest_under() {
    let (_directory, base) = place();
    let (file, begun) = written(&base, Duration::ZERO);
    let set = |seconds_ago| {
        let time = std::time::SystemTime::now() - Duration::from_secs(seconds_ago);
        fs::File::options().write(true).open(&file).unwrap().set_modified(time).unwrap();
        Stamp::of(&file).for_storing(begun)
    };
    // On Unix, the time of the last change of the file's metadata reveals that the time was set back.
    assert_eq!(set(10) == Stamp::UNKNOWN, cfg!(unix));
    assert_eq!(set(2), Stamp::UNKNOWN);
    // An open file and its name have the same stamp. Windows does not replace an open file.
    let of_open = Stamp::of_open(&fs::File::open(&file).unwrap());
    assert_eq!(of_open, Stamp::of(&file));
    fs::write(base.join("b"), "one").unwrap();
    fs::rename(base.join("b"), &file).unwrap();
    assert_ne!(of_open, Stamp::of(&file));
    assert_eq!(
        (Stamp::MISSING.for_storing(begun), Stamp::UNKNOWN.for_storing(begun)),
        (Stamp::MISSING, Stamp::UNKNOWN)
    );
}

#[test]
fn only_names_that_may_hold_what_was_looked_for_are_an_answer() {
    let (_directory, base) = place();
    fs::write(base.join("a.dxf"), "one").unwrap();
    let snapshot = catalogue(&base, Stamp::UNKNOWN, b"one");
    fs::write(base.join("5678.dxf"), "").unwrap();
    fs::write(base.join("1234.txt"), "").unwrap();
    assert_eq!(verify(&snapshot, &base, &covers).is_valid, [true]);
    fs::write(base.join("1234 gear.DXF"), "").unwrap();
    assert_eq!(verify(&snapshot, &base, &covers).is_valid, [false]);
}

#[cfg(unix)]
#[test]
fn where_links_decide_what_is_what_everything_is_asked_again() {
    let (_directory, base) = place();
    fs::write(base.join("a.dxf"), "one").unwrap();
    let snapshot = catalogue(&base, Stamp::UNKNOWN, b"one");
    std::os::unix::fs::symlink("a.dxf", base.join("5678.dxf")).unwrap();
    assert_eq!(verify(&snapshot, &base, &covers).is_valid, [false]);
}

/// A result holds even if its output files have changed. Files of results that are not requested are not verified.
#[test]
fn outputs_are_looked_at_with_the_records_that_are_asked_for() {
    let (_directory, base) = place();
    for name in ["a.dxf", "a.gcode", "b.dxf"] {
        fs::write(base.join(name), "one").unwrap();
    }
    let file = |name| FileFact {
        path: base.join(name),
        stamp: Stamp::UNKNOWN,
        hash: Some(*blake3::hash(b"one").as_bytes()),
    };
    let record = |subject: &str, file, outputs| Record {
        subject: subject.into(),
        files: vec![file],
        outputs,
        ..Record::default()
    };
    let snapshot = stored(&Catalogue {
        files: vec![file("a.dxf"), file("a.gcode"), file("b.dxf")],
        records: vec![record("a", 0, vec![1]), record("b", 2, Vec::new())],
        ..Catalogue::default()
    });
    let context = VerifyContext { is_requested: &|subject| subject == "a", ..context(&base, &covers) };
    let states = || pathbuild_cache::verify(&snapshot, context, Listings::new());
    let restored = |name: &str| FileState::Touched(Stamp::of(&base.join(name)));
    assert_eq!(states().files, [restored("a.dxf"), restored("a.gcode"), FileState::Unchecked]);
    assert_eq!(states().is_valid, [true, false]);
    fs::write(base.join("a.gcode"), "two").unwrap();
    assert_eq!((states().files[1], states().is_valid[0]), (FileState::Changed, true));
    let people = VerifyContext { hash_output: &|_, _| *blake3::hash(b"one").as_bytes(), ..context };
    assert_eq!(pathbuild_cache::verify(&snapshot, people, Listings::new()).files[1], restored("a.gcode"));
}

/// Returns a larger catalogue: unsorted, several results per file, and texts that have common prefixes and are not ASCII.
fn larger(base: &Utf8Path) -> Catalogue {
    let names = ["b.dxf", "a.dxf", "ä.dxf", "a.dxf.dxf", "c/a.dxf"];
    let file = |(index, name): (u8, &&str)| FileFact {
        path: Utf8PathBuf::from(*name),
        stamp: if index == 1 { Stamp::UNKNOWN } else { Stamp::MISSING },
        hash: (index != 2).then_some([index; 32]),
    };
    let record = |(index, name): (usize, &&str)| Record {
        subject: (*name).into(),
        files: vec![index, 0],
        lookups: (0..index % 3).collect(),
        payload: vec![7; index],
        outputs: (0..index).collect(),
    };
    let lookup = |directories, name: &str| Lookup { directories, name: name.into() };
    let directory = |path: &str, names: &[&str]| DirectoryFact {
        path: path.into(),
        names: names.iter().map(|name| (*name).into()).collect(),
        canonical: base.join(path).as_str().into(),
        is_doubtful: path.is_empty(),
    };
    Catalogue {
        files: (0..).zip(&names).map(file).collect(),
        directories: vec![directory("", &["a.dxf", "b.dxf"]), directory("c", &[])],
        directory_lists: vec![vec![1, 0], Vec::new(), vec![1]],
        lookups: vec![lookup(0, "1234.1P"), lookup(2, "1234.1P")],
        records: names.iter().enumerate().map(record).collect(),
    }
}

#[test]
fn what_is_kept_is_found_by_its_name() {
    let (_directory, base) = place();
    let catalogue = larger(&base);
    let stored = stored(&catalogue);
    for record in &catalogue.records {
        for hint in 0..6 {
            assert_eq!(stored.records[stored.find(&record.subject, hint).unwrap()], *record);
        }
    }
    for nothing in ["", "a", "a.dxf.", "z", "b.dxe"] {
        assert_eq!(stored.find(nothing, 0), None);
    }
    assert_eq!(Catalogue { records: Vec::new(), ..stored }, Catalogue { records: Vec::new(), ..catalogue });
    assert_eq!(Catalogue::default().find("a.dxf", 0), None);
}

/// Tests files with a flipped bit, a missing part, or additional bytes.
#[test]
fn a_file_that_is_not_whole_is_not_used() {
    let (_directory, base) = place();
    let place = cache(&base);
    let key = Key::new("build", "question");
    place.store(&key, larger(&base)).unwrap();
    let file = place.directory().join(key.file_name());
    let whole = fs::read(&file).unwrap();
    let load = |bytes: &[u8]| {
        fs::write(&file, bytes).unwrap();
        place.load(&key)
    };
    for at in 0..whole.len() {
        let mut flipped = whole.clone();
        flipped[at] ^= 1 << (at % 8);
        assert!(load(&flipped).is_err(), "a bit of byte {at} flipped");
        assert_eq!(load(&whole[..at]), Err(CacheFault::Damaged), "cut at {at}");
    }
    assert!(load(&[&*whole, b"0"].concat()).is_err());
    assert!(load(&whole).is_ok());
}

/// Size in bytes of the beginning of a file: the magic, the key and the checksum.
const HEAD: usize = 16 + 64 + 32;

/// Numbers out of bounds are refused even if the checksum is correct.
#[test]
fn numbers_out_of_bounds_are_refused() {
    let (_directory, base) = place();
    let place = cache(&base);
    let key = Key::new("build", "question");
    place.store(&key, larger(&base)).unwrap();
    let file = place.directory().join(key.file_name());
    let whole = fs::read(&file).unwrap();
    let mut refused = 0;
    for at in HEAD..whole.len() {
        for number in [1, 7, 0x7F, 0x80, 0xFF] {
            let mut forged = whole.clone();
            forged[at] = number;
            let checksum = *blake3::hash(&forged[HEAD..]).as_bytes();
            forged[HEAD - 32..HEAD].copy_from_slice(&checksum);
            fs::write(&file, forged).unwrap();
            match place.load(&key) {
                // The facts of the catalogue may be wrong, but verifying them must not panic.
                Ok(catalogue) => {
                    let catalogue = catalogue.unwrap();
                    let verdict =
                        pathbuild_cache::verify(&catalogue, context(&base, &covers), Listings::new());
                    assert_eq!(verdict.is_valid.len(), catalogue.records.len());
                    for record in 0..catalogue.records.len() {
                        pathbuild_cache::reasons(&catalogue, &verdict, record, &covers);
                    }
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(refused > 100);
}

#[test]
fn a_directory_that_was_listed_is_not_listed_again() {
    let (_directory, base) = place();
    fs::write(base.join("a.dxf"), "one").unwrap();
    let snapshot = stored(&catalogue(&base, Stamp::UNKNOWN, b"one"));
    let holds = |names: &[&str], is_doubtful| {
        let names = names.iter().map(|name| (*name).into()).collect();
        let listings = Listings::from([(base.clone(), Listing { names, is_doubtful, ..Listing::default() })]);
        pathbuild_cache::verify(&snapshot, context(&base, &covers), listings).is_valid[0]
    };
    assert!(holds(&["a.dxf"], false));
    assert!(holds(&["5678.dxf", "a.dxf"], false));
    assert!(!holds(&["1234.dxf", "a.dxf"], false));
    assert!(!holds(&["a.dxf"], true));
}
