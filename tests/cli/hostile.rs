//! Tests files that are not drawings: each gives a clear error, and nothing is written. (book: reference/diagnostics) benches/README.md states the
//! time that a release build takes for 200 MB of each kind of noise.

use std::fs;
use std::time::{Duration, Instant};

use crate::support::{Place, Run};
use pathbuild_testkit::sheet;

const NAME: &str = "1234.1P.dxf";
const OPTIONS: &[&str] = &["--feed=150", "--rapid=1000", "--sweep-height=20", "--format=concise"];

/// Size of the noise in bytes, for which a debug build of the reader takes about a second.
const NOISE: usize = 8_000_000;

/// Returns a complete drawing of one path.
fn drawing() -> Vec<u8> {
    let drawn = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0";
    sheet(drawn).unwrap().to_dxf()
}

/// Returns deterministic pseudo-random bytes (xorshift).
fn noise(alphabet: &[u8]) -> Vec<u8> {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 33) as usize
    };
    (0..NOISE).map(|_| alphabet[next() % alphabet.len()]).collect()
}

/// Returns the error of `emit` and `check` for these bytes, after checking that it is the only one and nothing is written.
#[track_caller]
fn error(bytes: &[u8]) -> String {
    let place = Place::new().file(NAME, bytes);
    let said = one_error(&place, NAME);
    let files: Vec<_> = fs::read_dir(place.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(files, [NAME], "{said}");
    said
}

#[track_caller]
fn one_error(place: &Place, name: &str) -> String {
    let start = Instant::now();
    let emitted = place.run_with(&[&["emit", name], OPTIONS].concat());
    let checked = place.run_with(&["check", name, "--format=concise"]);
    assert!(start.elapsed() < Duration::from_mins(1), "{:?}", start.elapsed());
    let (emitted, checked) = (errors(&emitted), errors(&checked));
    assert_eq!(emitted, checked);
    assert_eq!(emitted.len(), 1, "{emitted:?}");
    emitted.into_iter().next().unwrap()
}

#[track_caller]
fn errors(run: &Run) -> Vec<String> {
    assert_eq!(run.status, Some(1), "{run}");
    let lines = run.stdout.lines().chain(run.stderr.lines());
    lines.filter(|line| line.contains(" error[")).map(str::to_owned).collect()
}

#[track_caller]
fn assert_says(said: &str, code: &str, text: &str) {
    assert!(said.contains(code) && said.contains(text), "{said}");
}

#[test]
fn the_whole_drawing_is_right() {
    let place = Place::new().file(NAME, drawing());
    let run = place.run_with(&[&["emit", NAME], OPTIONS].concat());
    assert_eq!(run.status, Some(0), "{run}");
}

#[test]
fn an_empty_file_is_no_drawing() {
    assert_says(&error(b""), "PB002", "the file is empty");
    assert_says(&error(b"\n \n"), "PB002", "nothing but blanks");
}

#[test]
fn a_text_is_no_drawing() {
    assert_says(&error(b"This is a letter.\n"), "PB002", "not a DXF file");
    // A file is not accepted even if its first lines are those of a drawing.
    assert_says(&error(b"  0\nSECTION\n  2\nENTITIES\nDear Sir,\n"), "PB002", "Dear Sir,");
}

/// The file is cut off at every tenth of its length, and one byte before the entities end.
#[test]
fn a_file_that_is_cut_off_has_no_paths() {
    let whole = drawing();
    let entities = find(&whole, b"ENTITIES");
    let end = entities + find(&whole[entities..], b"ENDSEC");
    for tenth in 1..10 {
        let cut = end * tenth / 10;
        assert_says(&error(&whole[..cut]), "PB002", "");
    }
    assert_says(&error(&whole[..end - 1]), "PB002", "cut off");
}

fn find(bytes: &[u8], part: &[u8]) -> usize {
    bytes.windows(part.len()).position(|window| window == part).unwrap()
}

#[test]
fn noise_is_no_drawing() {
    let every: Vec<u8> = (0..=255).collect();
    assert_says(&error(&noise(&every)), "PB002", "not a DXF file");
    assert_says(&error(&noise(b"\0")), "PB002", "not a DXF file");
    assert_says(&error(&noise(b"0123456789 \n\r.-AELSR")), "PB002", "");
    assert_says(&error(&noise(b"\n")), "PB002", "nothing but blanks");
}

#[test]
fn noise_within_a_drawing_is_found() {
    let start = find(&drawing(), b"ENTITIES") + 10;
    let head = |bytes: &[u8]| [&drawing()[..start], bytes].concat();
    let every: Vec<u8> = (0..=255).collect();
    assert_says(&error(&head(&noise(&every))), "PB002", "");
    assert_says(&error(&head(&noise(b"0\n"))), "PB002", "");
    assert_says(&error(&head(&vec![b' '; NOISE])), "PB002", "");
    let binary = [b"AutoCAD Binary DXF\r\n\x1a\0".as_slice(), &noise(&every)].concat();
    assert_says(&error(&binary), "PB002", "");
}

#[test]
fn a_directory_is_no_drawing() {
    let place = Place::new().file(&format!("{NAME}/inside.txt"), "");
    let run = place.run_with(&[&["emit", NAME], OPTIONS].concat());
    assert_eq!(run.status, Some(1), "{run}");
    assert_says(&errors(&run).join(""), "PB001", "this is a directory");
}

#[test]
fn a_file_that_is_not_there_is_named() {
    assert_says(&one_error(&Place::new(), NAME), "PB001", NAME);
}

/// The file is the beginning of a process's memory, which no user can read. Tests that run as root could read an ordinary file.
#[cfg(target_os = "linux")]
#[test]
fn a_file_that_cannot_be_read_is_an_error_of_its_own() {
    let place = Place::new();
    std::os::unix::fs::symlink("/proc/self/mem", place.path().join(NAME)).unwrap();
    assert_says(&one_error(&place, NAME), "PB001", "cannot read");
}

/// The path has five million passes, so the work is started and cancelled.
#[test]
fn what_takes_too_long_is_given_up() {
    let drawn = "layer 1234.1P\nstart 0,0 \"T5 O2 I0.000001 B0\"\nmill 0,0 40,0\nend 40,0";
    let place = Place::new()
        .file("pathbuild.toml", "[limits]\nseconds-per-path = 0.3\nprogram-memory = \"4 GiB\"\n")
        .file(NAME, sheet(drawn).unwrap().to_dxf());
    let start = Instant::now();
    let run = place.run_with(&[&["emit", NAME], OPTIONS].concat());
    assert!(start.elapsed() < Duration::from_mins(1), "{:?}", start.elapsed());
    assert_says(&errors(&run).join("\n"), "PB005", "the time that this path takes");
}

/// A drawing may have as many paths as layers: each is found without scanning all the others.
#[test]
fn twenty_thousand_paths_in_one_drawing_take_no_square_of_them() {
    let line = |path: u32| {
        let layer = format!("{}.{}P", 1000 + path / 10, path % 10);
        format!("0\nLINE\n8\n{layer}\n10\n0\n20\n{path}\n11\n5\n21\n{path}\n")
    };
    let lines: String = (0..20_000).map(line).collect();
    let place = Place::new().file(NAME, format!("0\nSECTION\n2\nENTITIES\n{lines}0\nENDSEC\n0\nEOF\n"));
    let start = Instant::now();
    let run = place.run_with(&["check", NAME, "--format=concise"]);
    assert!(start.elapsed() < Duration::from_mins(1), "{:?}", start.elapsed());
    // Each of the paths has neither start nor end.
    assert_eq!(errors(&run).len(), 40_000);
}

/// In a library with all of these files, each is reported, and the correct drawings are checked.
#[test]
fn bad_files_hide_nothing() {
    let place = Place::new()
        .file("1.dxf", "")
        .file("2.dxf", "a letter")
        .file("3.dxf", noise(b"0123456789 \n\r.-AELSR"))
        .file("4.dxf", &drawing()[..drawing().len() / 3])
        .file(NAME, drawing());
    let run = place.run("check . --format concise");
    assert_eq!(errors(&run).len(), 4, "{run}");
    assert!(run.stderr.contains("1 path in 5 drawings") && run.stderr.contains("4 errors"), "{run}");
}
