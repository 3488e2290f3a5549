//! Tests that the name of a file is compared with the paths in the file. (book: language/layers-and-names)

use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::{
    FilePattern, PathName, PathPattern, check_file_name, is_q_project, q_project_name, tested_by_q_project,
};

/// Returns the codes and names of the findings for a file with this name and these paths.
fn findings(stem: &str, held: &[&str]) -> Vec<String> {
    findings_with(FilePattern::DEFAULT, PathPattern::DEFAULT, stem, held)
}

fn findings_with(file: &str, path: &str, stem: &str, held: &[&str]) -> Vec<String> {
    let (files, paths) = (FilePattern::new(file).unwrap(), PathPattern::new(path).unwrap());
    let held: Vec<PathName> = held.iter().map(|name| PathName::new(name)).collect();
    let found = check_file_name(stem, &held, &files, &paths);
    let name = |found: &Diagnostic| match &found.arguments[0].1 {
        Value::Quoted(name) => name.to_string(),
        other => format!("{other:?}"),
    };
    let said = |found: &Diagnostic| format!("{} {}", found.code(), name(found));
    found.iter().map(said).collect()
}

#[test]
fn a_full_name_promises_its_path() {
    assert_eq!(findings("1234.1P", &["1234.1P"]), [""; 0]);
    assert_eq!(findings("1234.1p gears", &["1234.1P"]), [""; 0]);
    assert_eq!(findings("1234.1P", &[]), ["PB519 1234.1P"]);
    assert_eq!(findings("1234.1P", &["1234.1S"]), ["PB519 1234.1P"]);
    assert_eq!(findings("1234.1P,1234.2P old", &["1234.2P"]), ["PB519 1234.1P"]);
}

#[test]
fn numbers_are_compared_as_numbers() {
    assert_eq!(findings("1234.01P", &["1234.1P"]), [""; 0]);
    assert_eq!(findings("1234.01P", &["1234.10P"]), ["PB519 1234.01P", "PB521 1234.10P"]);
}

#[test]
fn a_part_of_a_name_promises_nothing() {
    for stem in ["1234", "1234.1", "2024 gears", "91234.1P", "1234.1Pins", "gears"] {
        assert!(!findings(stem, &[]).iter().any(|said| said.starts_with("PB519")), "{stem}");
    }
}

#[test]
fn the_ends_of_a_range_promise_nothing() {
    for stem in ["1234.1P-1234.4P", "1234.1P \u{2013} 1234.4P", "1234.1-1234.4P"] {
        assert_eq!(findings(stem, &["1234.2P"]), [""; 0], "{stem}");
    }
    assert_eq!(findings("1234.1P-gears", &[]), ["PB519 1234.1P"]);
    assert_eq!(findings("1300.1P,1234.1P-1234.4P", &["1234.2P"]), ["PB519 1300.1P"]);
}

#[test]
fn a_path_beside_the_name_is_a_stray() {
    assert_eq!(findings("1234.1P", &["1234.1P", "1235.1P"]), ["PB521 1235.1P"]);
    assert_eq!(findings("1234", &["1234.1P", "1234.99S"]), [""; 0]);
    assert_eq!(findings("1234.1-1234.3", &["1234.3P", "1234.4P"]), ["PB521 1234.4P"]);
    assert_eq!(findings("gears", &["1234.1P"]), ["PB521 1234.1P"]);
}

#[test]
fn a_q_project_is_named_after_another_drawing() {
    assert_eq!(findings("1234.1P_Q", &["1234.0Q"]), [""; 0]);
    assert_eq!(findings("1234.1P_R", &["1234.0Q"]), ["PB519 1234.1P", "PB521 1234.0Q"]);
}

#[test]
fn other_patterns_say_what_names_are() {
    let (file, path) = ("([A-Z]+)(?:[.]([0-9]+))?", "([A-Z]+)[.]([0-9]+)");
    assert_eq!(findings_with(file, path, "GEAR.1-GEAR.9", &["GEAR.4"]), [""; 0]);
    assert_eq!(findings_with(file, path, "GEAR.1", &["GEAR.2"]), ["PB519 GEAR.1", "PB521 GEAR.2"]);
}

#[test]
fn a_q_project_is_named_after_its_drawing() {
    for (name, drawing) in [("1234_Q", "1234"), ("1234_q", "1234"), ("1234.1P gears_Q", "1234.1P gears")] {
        assert!(is_q_project(name));
        assert_eq!(tested_by_q_project(name), Some(drawing));
    }
    for name in ["1234Q", "1234_Q1", "1234-Q", "1234"] {
        assert!(!is_q_project(name) && tested_by_q_project(name).is_none(), "{name}");
    }
    assert_eq!(tested_by_q_project(&q_project_name("1234")), Some("1234"));
}
