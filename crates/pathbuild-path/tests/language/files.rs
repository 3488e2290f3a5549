//! Tests which files may define a path. (book: language/embedding)

use pathbuild_path::{FilePattern, PathKey, PathPattern};

fn holds_with(file: &str, path: &str, stem: &str, name: &str) -> bool {
    let key = PathKey::new(name, &PathPattern::new(path).unwrap()).expect("it is a path's name");
    FilePattern::new(file).unwrap().ranges(stem).iter().any(|range| range.holds(&key))
}

fn holds(stem: &str, name: &str) -> bool {
    holds_with(FilePattern::DEFAULT, PathPattern::DEFAULT, stem, name)
}

fn definable_paths<'a>(stem: &str, names: &[&'a str]) -> Vec<&'a str> {
    names.iter().copied().filter(|name| holds(stem, name)).collect()
}

#[test]
fn the_table_of_the_specification_holds() {
    assert_eq!(definable_paths("8000", &["8000.1A", "8001.1A"]), ["8000.1A"]);
    let range = definable_paths("8000-8002", &["8000.0A", "8001.99A", "8002.99A", "8003.1A", "7999.9A"]);
    assert_eq!(range, ["8000.0A", "8001.99A", "8002.99A"]);
    assert_eq!(definable_paths("8000-8002,8004", &["8004.1A", "8003.0A"]), ["8004.1A"]);
    assert_eq!(definable_paths("8000.4-8001,8000.1-8001.3", &["8000.2A", "8000.0A"]), ["8000.2A"]);
    assert_eq!(definable_paths("8000.2-8000.3,8000.5", &["8000.4A", "8000.5A"]), ["8000.5A"]);
    assert_eq!(
        definable_paths("1234.1-1234.10", &["1234.8A", "1234.5B", "1234.40A"]),
        ["1234.8A", "1234.5B"]
    );
}

#[test]
fn both_ends_of_a_range_are_in_it() {
    let names = ["1300.1A", "1300.2A", "1300.5A", "1300.9A", "1300.10A"];
    assert_eq!(definable_paths("1300.2-1300.9", &names), ["1300.2A", "1300.5A", "1300.9A"]);
}

#[test]
fn anything_may_stand_between_and_around_names() {
    let names = ["1234.5A", "1300.1A", "1350.1A"];
    assert_eq!(definable_paths("new 1234.1-1234.10,1300 gears", &names), ["1234.5A", "1300.1A"]);
    assert_eq!(definable_paths("1234.5_1300", &names), ["1234.5A", "1300.1A"]);
    assert_eq!(definable_paths("gears", &names), [""; 0]);
}

#[test]
fn a_range_may_have_blanks_an_en_dash_and_a_letter_behind_either_end() {
    for stem in [
        "8000-8002",
        "8000 - 8002",
        "8000\u{2013}8002",
        "8000  \u{2013} 8002",
        "8000.1P\u{2013}8002.1P",
        "8000P - 8002",
    ] {
        assert!(holds(stem, "8001.1A"), "{stem}");
        assert!(!holds(stem, "8003.1A"), "{stem}");
    }
    for stem in ["8000PQ-8002", "8000_-8002", "8000, 8002", "8000 8002", "8000--8002", "8000 P-8002"] {
        assert!(!holds(stem, "8001.1A"), "{stem}");
        assert!(holds(stem, "8002.1A"), "{stem}");
    }
    let pattern = "([A-Z]+)([0-9]+)";
    assert!(holds_with(pattern, "([A-Z]+)([0-9]+)", "AB1P \u{2013} AB5", "AB3"));
    assert!(!holds_with(pattern, "([A-Z]+)([0-9]+)", "AB1PQ \u{2013} AB5", "AB3"));
}

/// If a group does not participate in a match, the comparison ends there: the name with further groups is greater.
#[test]
fn optional_groups_of_a_custom_pattern_end_the_comparison() {
    let pattern = "([A-Z]+)(?:-([0-9]+))?(?:[.]([0-9]+))?";
    let holds = |stem, name| holds_with(pattern, pattern, stem, name);
    assert!(holds("AB", "AB-1.2"), "all numbers of AB");
    assert!(holds("AB-1", "AB-1.2"));
    assert!(!holds("AB-2", "AB-1.2"));
    assert!(!holds("AB-1", "AB"), "the file has a group more than the path");
    assert!(!holds("AB-1.2", "AB-1"));
    assert!(holds("AB.2", "AB.2"), "an empty group in the middle on both sides");
    assert!(holds("AB.2", "AB-1"), "as many groups are left on both sides");
    assert!(holds("AB-1", "AB.2"), "the same");
}

/// Matches are found from left to right without overlap: the middle name belongs to the first range, so no second range begins with it.
#[test]
fn ranges_do_not_overlap() {
    let names = ["1001.1A", "1002.1A", "1003.1A", "1004.1A", "1005.1A"];
    assert_eq!(definable_paths("1001-1003-1005", &names), ["1001.1A", "1002.1A", "1003.1A", "1005.1A"]);
}

/// A range in the wrong order is not a range, but its ends are names.
#[test]
fn the_ends_of_a_range_are_names_too() {
    assert_eq!(definable_paths("8002-8000", &["8000.1A", "8001.1A", "8002.1A"]), ["8000.1A", "8002.1A"]);
}

#[test]
fn a_name_with_more_groups_than_the_file_is_in_it_and_not_the_other_way_round() {
    let path = "([0-9]{4})(?:[.]([0-9]+))?(?:[.]([A-Z]))?";
    let holds = |stem, name| holds_with(FilePattern::DEFAULT, path, stem, name);
    assert!(holds("1234", "1234.3.A"));
    assert!(holds("1234.3", "1234.3.A"));
    assert!(holds("1234.3", "1234.3"));
    assert!(!holds("1234.3", "1234"));
    // The end of the range has more groups than the path's name, so it is greater.
    assert!(holds("1233-1234.3", "1234"));
    assert!(!holds("1234.3-1235", "1234"));
}

#[test]
fn whole_numbers_compare_by_value() {
    assert!(holds("8999.01", "8999.1A"));
    assert!(!holds("8999.10", "8999.1A"));
    assert_eq!(definable_paths("1234.9-1234.11", &["1234.10A", "1234.100A", "1234.8A"]), ["1234.10A"]);
    let long = format!("1234.{}", "9".repeat(50));
    assert!(holds(&format!("1234.1-{long}"), &format!("{long}A")));
    assert!(!holds(&format!("1234.1-{long}"), &format!("{long}0A")));
}

#[test]
fn texts_compare_without_case() {
    let holds = |stem, name| holds_with("([A-Z]+)(?:[.]([0-9]+))?", "([A-Z]+)[.]([0-9]+)", stem, name);
    assert!(holds("gear.1-GEAR.9", "Gear.5"));
    assert!(holds("axle-Gear", "BOLT.1"));
    assert!(!holds("axle-gear", "HUB.1"));
}

/// "10" and "9" are compared as texts if the other group is not an integer.
#[test]
fn a_number_and_a_text_compare_as_texts() {
    let holds = |stem, name| holds_with("([A-Z0-9]+)", "([A-Z0-9]+)", stem, name);
    assert!(holds("10-9A", "2A"));
    assert!(!holds("3-9A", "2A"));
}

#[test]
fn a_pattern_must_compile_and_match_something() {
    assert!(FilePattern::new("([0-9]").is_err());
    assert!(FilePattern::new("[0-9]*").is_err());
    assert!(FilePattern::new("[0-9]+").is_ok());
}
