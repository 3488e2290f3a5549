//! Tests programs that are generated while files change or the machine is busy.

use std::fs;
use std::sync::Arc;
use std::sync::atomic::AtomicI64;

use camino::Utf8PathBuf;
use pathbuild_db::System;
use pathbuild_db::system::OsSystem;
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_workspace::Inputs;
use pathbuild_workspace::emit::{DrawingComparison, compare_with_drawing};
use pathbuild_workspace::session::Session;

use crate::mischief::{Event, Mischief};
use crate::on_disk::{EMITTING, OnDisk, long};

const DRAWING: &str = "lib/8001.1P.dxf";
const PROGRAM: &str = "lib/8001.1P_Milling.gcode";

fn place() -> OnDisk {
    let drawn = "layer 8001.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0";
    OnDisk::configured(EMITTING, &[(DRAWING, drawn)])
}

/// If another process changes a program after it was written but before the result is cached, the changed program is not considered up to date.
#[test]
fn a_program_that_another_changes_meanwhile_is_written_again() {
    for event in [Event::Change, Event::Replace, Event::Vanish] {
        let place = place();
        let program = place.path().join(PROGRAM);
        let meanwhile = Mischief {
            trigger: PROGRAM.to_owned(),
            countdown: AtomicI64::new(1),
            lasts: false,
            is_before: false,
            event,
            victim: program.clone(),
            bytes: b"(another's)\n".to_vec(),
        };
        place.emit(Arc::new(meanwhile), true, false);
        let of_another = fs::read_to_string(&program);
        assert!(of_another.is_err() || of_another.is_ok_and(|it| it == "(another's)\n"), "{event:?}");
        place.emit(Arc::new(OsSystem), true, false);
        let written = fs::read_to_string(&program);
        assert!(written.is_ok_and(|it| it.contains("8001.1P")), "{event:?}");
    }
}

/// A file that a post inserts changes between two programs: the cached result of the first one belongs to the old bytes. The change happens
/// at each possible time.
#[test]
fn an_inserted_file_that_changes_meanwhile_is_noticed() {
    const POST: &str = "[post]\nname = \"mine\"\nextension = \"nc\"\n[text]\ncomment = '(~CommentText~)'\n\
        line = 'G01 X{.~X1~} Y{.~Y1~} Z{.~Z1~} F{.~MovingVel~}'\nrapid = 'G00 X{.~X1~} Y{.~Y1~} Z{.~Z1~}'\n\
        program-start = '\\\\\\~*~Head~*'\n";
    let drawn = |name: &str| format!("layer {name}\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0");
    let mut outdated = 0;
    for time in 1..6 {
        let drawings = [("lib/8001.1P.dxf", drawn("8001.1P")), ("lib/8002.1P.dxf", drawn("8002.1P"))];
        let drawings = drawings.each_ref().map(|(file, text)| (*file, text.as_str()));
        let configuration = format!("post = \"my.toml\"\n{EMITTING}");
        let place = OnDisk::configured(&configuration, &drawings);
        fs::write(place.path().join("my.toml"), POST).unwrap();
        let with_macro = format!("{configuration}[macros]\nHead = \"head.nc\"\n");
        fs::write(place.path().join("pathbuild.toml"), with_macro).unwrap();
        let head = place.path().join("head.nc");
        fs::write(&head, "(old)\n").unwrap();
        let meanwhile = Mischief {
            trigger: "head.nc".to_owned(),
            countdown: AtomicI64::new(time),
            lasts: false,
            is_before: false,
            event: Event::Change,
            victim: head.clone(),
            bytes: b"(new)\n".to_vec(),
        };
        place.emit(Arc::new(meanwhile), true, false);
        if fs::read_to_string(&head).unwrap() != "(new)\n" {
            continue;
        }
        place.emit(Arc::new(OsSystem), true, false);
        for program in ["lib/8001.1P_Milling.nc", "lib/8002.1P_Milling.nc"] {
            let text = fs::read_to_string(place.path().join(program)).unwrap();
            assert!(text.contains("(new)"), "time {time}: {program}: {text}");
        }
        outdated += 1;
    }
    assert!(outdated >= 2, "the file changed {outdated} times");
}

/// Returns a file system on a busy machine: work that begins with the n-th query of the clock appears to have taken too long.
fn busy(time: i64) -> Arc<Mischief> {
    Arc::new(Mischief {
        trigger: String::new(),
        countdown: AtomicI64::new(time),
        lasts: false,
        is_before: false,
        event: Event::Busy,
        victim: Utf8PathBuf::new(),
        bytes: Vec::new(),
    })
}

/// The machine is busy once, at each possible time: a path is walked for its check and again for its program.
#[test]
fn no_program_lacks_what_took_too_long() {
    let drawn = long("8001.1P");
    let emitted = |system: Arc<dyn System>| {
        let place = OnDisk::configured(EMITTING, &[(DRAWING, &drawn)]);
        let made = place.emit(system, false, false);
        let codes: Vec<Code> = made.diagnostics.iter().map(Diagnostic::code).collect();
        (codes, fs::read_to_string(place.path().join(PROGRAM)).ok())
    };
    let expected = emitted(Arc::new(OsSystem));
    assert!(expected.0.is_empty() && expected.1.is_some());
    let is_given_up = |time: &i64| {
        let found = emitted(busy(*time));
        let is_given_up = found == (vec![Code::LimitReached], None);
        assert!(is_given_up || found == expected, "the clock is looked at for the {time}th time: {found:?}");
        is_given_up
    };
    assert!((1..10).filter(is_given_up).count() >= 2);
}

/// The machine is busy once while a program on disk is compared with its drawing.
#[test]
fn no_program_is_held_against_what_took_too_long() {
    let place = OnDisk::configured(EMITTING, &[(DRAWING, &long("8001.1P"))]);
    place.emit(Arc::new(OsSystem), false, false);
    let program = fs::read(place.path().join(PROGRAM)).unwrap();
    let is_given_up = |time: &i64| {
        let workspace = place.workspace(&Inputs::default(), busy(*time), false);
        let beside = place.path().join("lib");
        match compare_with_drawing(&mut Session::new(&workspace), &program, &beside, None) {
            DrawingComparison::Same(_) => false,
            DrawingComparison::Wrong(found) if matches!(&*found, [one] if one.code() == Code::LimitReached) => {
                true
            }
            other => panic!("the clock is looked at for the {time}th time: {other:?}"),
        }
    };
    assert!((1..10).filter(is_given_up).count() >= 2);
}
