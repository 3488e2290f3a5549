//! Tests the header line that identifies the origin of programs. (book: program/gcode)

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::provenance::{Provenance, is_same_program};

fn provenance() -> Provenance {
    Provenance {
        version: "0.1.0".into(),
        moves: "3f2a9c0d41b7e685".into(),
        options: "09c1d2e3".into(),
        dialect: Some(Dialect::Grbl),
        cutter: Some(2.5),
        thickness: Some(-1.0),
    }
}

#[test]
fn what_is_shown_is_read() {
    let shown = provenance().to_string();
    assert_eq!(shown, "pathbuild 0.1.0 3f2a9c0d41b7e685-09c1d2e3 grbl O2.5 T-1");
    assert_eq!(shown.parse(), Ok(provenance()));
    assert_eq!(shown.to_uppercase().parse::<Provenance>().map(|read| read.cutter), Ok(Some(2.5)));
    let bare = Provenance { dialect: None, cutter: None, thickness: None, ..provenance() };
    assert_eq!(bare.to_string().parse(), Ok(bare));
}

#[test]
fn anything_else_is_none() {
    for text in [
        "",
        "pathbuild",
        "pathbuild 0.1.0",
        "pathbuild 0.1.0 3f2a",
        "pathbuild 0.1.0 3f2x-09c1",
        "pathbuild 0.1.0 3f2a-",
        "pathbuild 0.1.0 3f2a-09c1 nodialect",
        "pathbuild 0.1.0 3f2a-09c1 Oinf",
        "pathbuild 0.1.0 3f2a-09c1 T",
        "camcam 0.1.0 3f2a-09c1",
    ] {
        assert_eq!(text.parse::<Provenance>(), Err(()), "{text}");
    }
}

#[test]
fn it_is_found_in_the_head_of_a_program_in_any_comment() {
    for (open, close) in [("(", ")"), ("; ", ""), ("// ", ""), ("N20 (", ")"), ("( ", " )")] {
        let head = format!("%\nO1000\n{open}{}{close}\r\n{open}title: 1.1{close}\r\nG21\n", provenance());
        let (found, title) = Provenance::of_head(head.as_bytes()).expect("a provenance");
        assert_eq!((found, &*title), (provenance(), "title: 1.1"), "{head}");
    }
    let late = format!("{}({})\n", "G0 X0\n".repeat(40), provenance());
    assert_eq!(Provenance::of_head(late.as_bytes()), None);
    assert_eq!(Provenance::of_head(b"G0 X1\n"), None);
}

#[test]
fn only_the_version_may_differ_between_files_of_the_same_program() {
    let program = |before: &str, version: &str, after: &str| {
        let written = Provenance { version: version.into(), ..provenance() };
        format!("%\n{before}({written})\n{after}\nM30\n")
    };
    let is_same =
        |other: &str| is_same_program(program("O1\n", "0.1.0", "G0 X1").as_bytes(), other.as_bytes());
    assert!(is_same(&program("O1\n", "0.1.0", "G0 X1")));
    assert!(is_same(&program("O1\n", "0.12.0", "G0 X1")), "another version");
    assert!(!is_same(&program("O2\n", "0.1.0", "G0 X1")), "a line before the version");
    assert!(!is_same(&program("O1\n", "0.1.0", "G0 X2")), "a line after the version");
    assert!(!is_same("%\nO1\nG0 X1\nM30\n"), "no version");
}
