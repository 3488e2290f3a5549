//! The handwritten matchers of the default patterns agree with the regular expressions. (book: language/layers-and-names)

use std::sync::LazyLock;

use pathbuild_path::{FilePattern, PathKey, PathPattern};
use proptest::prelude::*;

/// Equivalent patterns that are not recognised as the defaults, so that they are compiled.
static FILE: LazyLock<FilePattern> =
    LazyLock::new(|| FilePattern::new(&format!("(?:{})", FilePattern::DEFAULT)).unwrap());
static PATH: LazyLock<PathPattern> =
    LazyLock::new(|| PathPattern::new(&format!("(?:{})", PathPattern::DEFAULT)).unwrap());

/// Generates parts of names and similar characters: ſ and K count as letters of A-Z if case is ignored.
fn text() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        4 => "[0-9]{4}",
        2 => "[0-9]{1,6}",
        3 => Just(".".to_owned()),
        2 => "( ?- ?|[A-Za-zſ]? {0,2}[-–] {0,2})",
        2 => "[A-Za-z]",
        1 => "[ſ\u{212a}é,~_ \u{ff11}]",
        1 => ".",
    ];
    prop::collection::vec(piece, 0..9).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_ranges_of_a_file_name_are_those_of_the_regular_expression(stem in text()) {
        prop_assert_eq!(FilePattern::default().ranges(&stem), FILE.ranges(&stem));
    }

    #[test]
    fn path_names_are_those_of_the_regular_expression(text in text(), letter in "[A-Za-zſ\u{212a}]") {
        let (pattern, regex) = (PathPattern::default(), &*PATH);
        let found = pattern.first_in(&text);
        prop_assert_eq!(&found, &regex.first_in(&text));
        let near = found.map_or_else(|| format!("1234.5{letter}"), |(name, _)| name.as_str().to_owned());
        for name in [&text, &near, &format!("{near}{letter}")] {
            prop_assert_eq!(pattern.matches(name), regex.matches(name), "{}", name);
            prop_assert_eq!(pattern.layer(name), regex.layer(name), "{}", name);
            prop_assert_eq!(pattern.is_layer(name), regex.layer(name).is_some(), "{}", name);
            prop_assert_eq!(PathKey::new(name, &pattern), PathKey::new(name, regex), "{}", name);
        }
    }
}

/// Some texts of the property tests match, so the tests are not void.
#[test]
fn letters_that_are_s_and_k_without_case_are_letters_of_paths() {
    for name in ["1234.5ſ", "1234.5\u{212a}", "1234.5k"] {
        assert!(PathPattern::default().matches(name), "{name}");
    }
    assert!(!PathPattern::default().matches("1234.5é"));
}
