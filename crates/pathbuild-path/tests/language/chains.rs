//! Tests milling chains. (book: language/chains-and-passes)

use pathbuild_path::{Chain, Item};

use crate::support::{compile, items, path, wrong};

const P: &str = "T5 O3 I1 B0 D2 P1 U4 Mx";

fn chains(statements: &str) -> Vec<Chain> {
    let of_item = |item| match item {
        Item::Chain(chain) => Some(chain),
        _ => None,
    };
    compile(&path(P, statements)).walked.items.into_iter().filter_map(of_item).collect()
}

#[test]
fn milling_marking_and_support_segments_are_one_chain() {
    let lines = "mill 0,0 20,0\nmark 20,0 40,0\nbars 40,0 60,0\nmill arc 60,0 80,0 r 10\nend 80,0";
    assert_eq!(items(&path(P, lines)), ["[0,0 20,0, 20,0 40,0, 40,0 60,0, 60,0 80,0]"]);
}

#[test]
fn every_other_segment_ends_a_chain() {
    for (between, item) in [
        ("line DASHED 20,0 40,0", "sweep 20,0 40,0"),
        ("line HIDDEN 20,0 40,0", "sweep 20,0 40,0"),
        ("skip 20,0 40,0", "sweep 20,0 40,0"),
        ("subpath 20,0 40,0 \">1111.1P\"", "subpath 20,0 40,0"),
    ] {
        assert_eq!(
            items(&path(P, &format!("mill 0,0 20,0\n{between}\nmill 40,0 60,0\nend 60,0"))),
            ["[0,0 20,0]", item, "[40,0 60,0]"]
        );
    }
    for (circle, item) in [("circle 20,0 d 3", "hole 20,0"), ("circle 20,0 d 8", "helix 20,0 r4")] {
        assert_eq!(
            items(&path(P, &format!("mill 0,0 20,0\n{circle}\nmill 20,0 60,0\nend 60,0"))),
            ["[0,0 20,0]", item, "[20,0 60,0]"]
        );
    }
}

/// The first segment is the first in walking order, not in file order.
#[test]
fn infeed_and_first_depth_are_those_of_the_first_segment() {
    let own = |statements: &str| {
        let chain = &chains(statements)[0];
        (chain.infeed, chain.first_depth)
    };
    assert_eq!(own("mill 0,0 20,0\nmill 20,0 40,0\nend 40,0"), (1.0, None));
    assert_eq!(own("mill 0,0 20,0 \"I2 W4\"\nmill 20,0 40,0\nend 40,0"), (2.0, Some(4.0)));
    assert_eq!(own("mill 20,0 40,0 \"I2 W4\"\nmill 0,0 20,0\nend 40,0"), (1.0, None));
}

#[test]
fn letters_of_a_chain_have_no_effect_on_later_segments() {
    for letter in ["I2", "W4"] {
        let second = format!("mill 0,0 20,0\nmill 20,0 40,0 \"{letter}\"\nend 40,0");
        assert_eq!(wrong(&path(P, &second)), [format!("PB210 {}", &letter[..1])]);
        let first = format!("mill 0,0 20,0 \"{letter}\"\nmill 20,0 40,0\nend 40,0");
        assert_eq!(wrong(&path(P, &first)), [""; 0]);
    }
}

#[test]
fn each_chain_needs_an_infeed() {
    let without = "T5 O3 B0";
    let two = |first: &str, second: &str| {
        wrong(&path(
            without,
            &format!("mill 0,0 20,0 {first}\nsweep 20,0 40,0\nmill 40,0 60,0 {second}\nend 60,0"),
        ))
    };
    assert_eq!(two("\"I1\"", "\"I1\""), [""; 0]);
    assert_eq!(two("\"I1\"", ""), ["PB201 I"]);
    // Two chains without I are one mistake.
    assert_eq!(two("", ""), ["PB201 I"]);
}

/// A chain that begins by retracing a segment uses I and W of that segment.
#[test]
fn a_chain_that_begins_with_a_return_has_its_values() {
    let statements = "mill 0,0 20,0 \"I2\"\nmill 20,0 20,10 \"I3\"\ncircle 20,10 d 3\nmill 20,0 40,0 \"N9999\"\nturn 20,10\nend 40,0";
    let infeeds: Vec<f64> = chains(statements).iter().map(|chain| chain.infeed).collect();
    assert_eq!(infeeds, [2.0, 3.0]);
}

/// The letter has no effect where the segment is milled or where it is retraced, which is reported once.
#[test]
fn a_letter_without_effect_is_not_reported_for_a_return() {
    let statements = "mill 0,0 20,0\nmill 20,0 20,10 \"N1\"\nmill 20,0 40,0 \"N9999\"\nturn 20,10\nend 40,0";
    assert_eq!(wrong(&path(P, statements)), [""; 0]);
    let with = statements.replace("\"N1\"", "\"N1 I2\"");
    assert_eq!(wrong(&path(P, &with)), ["PB210 I"]);
}
