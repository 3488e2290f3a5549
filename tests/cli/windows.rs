//! Tests patterns that Windows shells leave to programs, and the spelling of paths. Runs on all systems; tests/tools/windows.sh runs it on Windows.

use crate::support::Place;

const PARTS: &str = r#"
== pathbuild.toml ==
feed = 150
rapid = 1000
sweep-height = 20
== parts/1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B0 MPlate"
mill 0,0 40,0
end 40,0
== parts/1235.dxf ==
layer 1235.1P
start 0,0 "T5 O2 I1 B0 MPlate"
mill 0,0 40,0
end 40,0
== parts/Größe.dxf ==
layer 1236.1P
start 0,0 "T5 O2 I1 B0 MPlate"
mill 0,0 40,0
end 40,0
== parts/notes.txt ==
no drawing
"#;

/// Returns the number of paths that a check of these arguments finds, all without errors.
fn paths(place: &Place, arguments: &[&str]) -> usize {
    let run = place.run_with(&[&["check", "--no-cache"], arguments].concat());
    assert_eq!(run.status, Some(0), "{run}");
    let count = run.stderr.lines().last().and_then(|line| line.split(' ').next()?.parse().ok());
    count.unwrap_or_else(|| panic!("{run}"))
}

#[test]
fn patterns_that_the_shell_has_left_mean_the_drawings_that_match() {
    let place = Place::of(PARTS);
    for (pattern, count) in [
        ("parts/*.dxf", 3),
        ("parts/*.DXF", 3),
        ("./parts/123?.dxf", 2),
        ("parts/123[45].dxf", 2),
        ("parts/123[!4].dxf", 1),
        ("parts/gr*e.dxf", 1),
        ("./par*", 3),
    ] {
        assert_eq!(paths(&place, &[pattern]), count, "{pattern}");
    }
    assert_eq!(paths(&place, &["parts/*4.dxf", "parts/*5.dxf"]), 2);
}

#[test]
fn a_pattern_that_nothing_matches_is_a_file_that_is_not_there() {
    let place = Place::of(PARTS);
    for pattern in ["*.dxf", "parts/124?.dxf", "parts/*.txt", "nowhere/*.dxf"] {
        let run = place.run_with(&["check", pattern]);
        assert_eq!(run.status, Some(1), "{run}");
        assert!(run.stderr.contains("there is no such file"), "{run}");
    }
}

/// In file names, brackets are ordinary characters, on Windows as well.
#[test]
fn a_file_of_just_that_name_is_meant() {
    let place = Place::of(&PARTS.replace("parts/1235.dxf", "parts/123[4].dxf"));
    let run = place.run_with(&["where", "parts/123[4].dxf"]);
    assert!(run.stdout.starts_with("1235.1P "), "{run}");
    assert_eq!(paths(&place, &["parts/123[4].dxf"]), 1);
    assert_eq!(paths(&place, &["parts/123[4]*.dxf"]), 1, "a pattern again: 1234.dxf");
}

/// Windows limits paths to 260 characters unless a program takes precautions.
#[test]
fn paths_of_more_than_260_characters_are_read_and_written() {
    let deep = ["a directory with a name of so many characters, and a few more"; 5].join("/");
    let place = Place::of(&PARTS.replace("parts/", &format!("{deep}/")));
    let drawing = format!("{deep}/1234.dxf");
    assert!(drawing.len() > 260);
    assert_eq!(paths(&place, &[&drawing]), 1);
    assert_eq!(paths(&place, &[&format!("{deep}/*.dxf")]), 3);
    let run = place.run_with(&["emit", &drawing]);
    assert_eq!(run.status, Some(0), "{run}");
    assert_eq!(place.run_with(&["emit", "--check", &drawing]).status, Some(0));
}

/// The console's code page does not affect piped output, which is UTF-8 like the names of drawings.
#[cfg(windows)]
#[test]
fn what_is_piped_is_utf_8_whatever_the_code_page() {
    use std::process::Command;
    let place = Place::of(PARTS);
    for page in ["850", "1252", "65001"] {
        let program = env!("CARGO_BIN_EXE_pathbuild");
        let line = format!("chcp {page} >nul & {program} where parts\\*.dxf");
        let output = Command::new("cmd").args(["/c", &line]).current_dir(place.path()).output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(said.contains("parts/Größe.dxf"), "{page}: {said}");
    }
}
