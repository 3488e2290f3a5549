//! Tests path names and the layers of paths. (book: language/layers-and-names)

use std::collections::BTreeSet;

use pathbuild_path::{PathLayer, PathName, PathPattern};

use crate::support::{codes, read};

fn layer(name: &str) -> Option<PathLayer> {
    PathPattern::default().layer(name)
}

fn path_of(name: &str) -> Option<String> {
    layer(name).map(|layer| layer.path.as_str().to_owned())
}

#[test]
fn a_path_layer_matches_the_pattern_as_a_whole() {
    assert_eq!(path_of("2913.2P").as_deref(), Some("2913.2P"));
    for other in
        ["12913.2P", "913.2P", "2913.2PP", "2913.2", "2913.P", "2913,2P", "A2913.2P", "2913.2P ", "0"]
    {
        assert_eq!(path_of(other), None, "{other}");
    }
}

#[test]
fn case_does_not_count_and_is_kept() {
    assert_eq!(path_of("2913.2p").as_deref(), Some("2913.2p"));
    assert_eq!(PathName::new("2913.2p"), PathName::new("2913.2P"));
    let names = BTreeSet::from(["8000.1p", "8000.1P"].map(PathName::new));
    assert_eq!(names.len(), 1);
}

#[test]
fn underscores_of_a_layer_are_points() {
    assert_eq!(path_of("2913_2P").as_deref(), Some("2913.2P"));
    assert_eq!(path_of("2913-2P"), None);
}

#[test]
fn names_are_the_same_when_their_texts_are() {
    assert_ne!(PathName::new("8999.01P"), PathName::new("8999.1P"));
}

#[test]
fn a_tilde_and_letters_are_no_part_of_the_name() {
    let tilde = layer("2916.1P~A").unwrap();
    assert_eq!((tilde.path.as_str(), tilde.is_tilde), ("2916.1P", true));
    assert_eq!(path_of("2916.1P~ab").as_deref(), Some("2916.1P"));
    assert!(!layer("2916.1P").unwrap().is_tilde);
    for other in ["2916.1P~1", "2916.1P~A1", "2916.1P~A~1", "2916.1P~A B"] {
        assert_eq!(path_of(other), None, "{other}");
    }
}

#[test]
fn a_path_is_on_all_layers_of_its_name() {
    let file = read("layer 1234.1P\nstart 0,0 \"T5 O3 I1 B0\"\nend 20,0\nlayer 1234_1p~B\nmill 0,0 20,0");
    assert_eq!(file.paths.len(), 1);
    let (path, _) = &file.paths[0];
    assert_eq!((path.name.as_str(), path.layer(), path.drawn.elements.len()), ("1234.1P", "1234.1P", 1));
    assert_eq!(codes(&path.diagnostics), [""; 0]);
}

#[test]
fn paths_are_in_the_order_in_which_they_appear() {
    let file = read("layer 2000.1P\nend 20,0\nlayer 1000.1P\nstart 0,0\nlayer 2000.1P\nstart 0,0");
    let names: Vec<&str> = file.paths.iter().map(|(path, _)| path.name.as_str()).collect();
    assert_eq!(names, ["2000.1P", "1000.1P"]);
}

#[test]
fn another_pattern_holds_in_place_of_the_default() {
    let pattern = PathPattern::new("[a-z]+|x([0-9]+)").unwrap();
    for name in ["gear", "GEAR", "x12"] {
        assert!(pattern.layer(name).is_some(), "{name}");
    }
    // Either alternative must match the whole name: the pattern does not mean `^[a-z]+` or `x([0-9]+)$`.
    for name in ["gear1", "yx12", "2913.2P"] {
        assert!(pattern.layer(name).is_none(), "{name}");
    }
}

#[test]
fn a_pattern_must_compile_and_match_something() {
    assert!(PathPattern::new("([0-9]").is_err());
    assert!(PathPattern::new("[0-9]*").is_err());
    assert!(PathPattern::new("[0-9]+").is_ok());
}

#[test]
fn the_first_match_in_a_text_is_its_name() {
    let find = |text: &str| {
        PathPattern::default().first_in(text).map(|(name, range)| (name.as_str().to_owned(), range))
    };
    assert_eq!(find("2051.3P"), Some(("2051.3P".to_owned(), 0..7)));
    assert_eq!(find("8003.1LS"), Some(("8003.1L".to_owned(), 0..7)));
    assert_eq!(find("x8003.1L,8004.1L"), Some(("8003.1L".to_owned(), 1..8)));
    assert_eq!(find("803.1L"), None);
}
