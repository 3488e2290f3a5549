//! Tests that entities on unwanted layers are skipped, which is especially fast if many of the same kind and layer follow each other. Entities
//! between them are still read, and errors in the file are reported. (book: reference/dxf: "lines")

use pathbuild_dxf::{Options, Origin, read};

use crate::support::{entities, file_faults, options};

/// Returns a LINE with these groups before its points.
fn line(groups: &str) -> String {
    format!("0 LINE\n{groups}\n10 0\n20 0\n11 1\n21 0\n")
}

fn others(count: usize) -> String {
    line("5 F\n8 OTHERS").repeat(count)
}

/// Returns the origins of the entities on layers P and 0.
fn wanted(pairs: &str) -> Vec<Origin> {
    let options = Options { keep_layer: &|name| matches!(name, "P" | "0"), ..options() };
    let drawing = read(entities(pairs).as_bytes(), &options);
    assert!(drawing.diagnostics.is_empty() && drawing.faults.is_empty(), "{drawing:?}");
    drawing.origins
}

/// Whether an entity is found among others.
fn is_found(groups: &str) -> bool {
    let alone = wanted(&line(groups)).len();
    for before in 0..4 {
        let found = wanted(&(others(before) + &line(groups) + &others(2)));
        assert_eq!(found.len(), alone, "{groups} behind {before}");
    }
    alone == 1
}

#[test]
fn an_entity_between_others_is_found_by_its_layer() {
    assert!(is_found("8 P"));
    assert!(is_found("5 A\n330 1\n100 AcDbEntity\n8 P\n62 7"));
    assert!(!is_found("8 OTHER"));
    assert!(!is_found("8 OTHERS "));
}

#[test]
fn an_entity_that_names_no_layer_is_found_on_layer_0() {
    assert!(is_found("62 7"));
    assert!(is_found("10 0\n20 0\n11 1\n21 0\n101 Embedded Object\n8 OTHERS"));
    assert!(!is_found("8 OTHERS\n101 Embedded Object\n8 P"));
}

#[test]
fn the_group_of_an_application_names_no_layer() {
    assert!(is_found("102 {X\n8 OTHERS\n102 }\n8 P"));
    assert!(!is_found("102 {X\n8 P\n102 }\n8 OTHERS"));
}

#[test]
fn the_first_layer_that_is_not_wanted_counts() {
    assert!(!is_found("8 OTHERS\n8 P"));
    assert!(!is_found("8 P\n8 OTHERS"));
}

#[test]
fn lines_and_handles_are_those_of_the_entity() {
    // Each of these entities has seven pairs, and the first pair is on line 5.
    for before in 0..20_u32 {
        let found = wanted(&(others(before as usize) + &line("5 A\n8 P")));
        assert_eq!(found.iter().map(|origin| origin.line).collect::<Vec<_>>(), [5 + 14 * before]);
        assert_eq!(found[0].handle.map(|handle| handle.0), Some(10));
    }
}

#[test]
fn a_code_that_is_none_is_an_error_on_any_layer() {
    for before in 0..4 {
        for groups in ["x 1\n8 OTHERS", "8 OTHERS\nx 1", "8 OTHERS\n6x 1", "8 OTHERS\n1000x 1"] {
            let pairs = others(before) + &line(groups) + &line("8 P");
            let file = entities(&pairs);
            let bad = 1 + file.lines().position(|line| line.contains('x')).expect("there is one");
            let options = Options { keep_layer: &|name| name == "P", ..options() };
            let drawing = read(file.as_bytes(), &options);
            let said = file_faults(&drawing);
            assert!(drawing.entities.is_empty(), "{pairs}");
            assert!(said.len() == 1 && said[0].starts_with(&format!("PB002 {bad} ")), "{bad}: {said:?}");
        }
    }
}
