//! Tests layers and line types: names, tables, and hidden layers. (book: reference/dxf)

use std::cell::RefCell;

use pathbuild_diagnostic::Code;
use pathbuild_dxf::{Drawing, Options, read};

use crate::support::{entities, faults, file, options, read_all};

const CIRCLE: &str = "10 0\n20 0\n40 1";

/// Reads a drawing with a circle on each of these layers.
fn circles(layers: &[&str], tables: &str) -> Drawing {
    let circles: Vec<_> = layers.iter().map(|layer| format!("0 CIRCLE\n8 {layer}\n{CIRCLE}")).collect();
    read_all(file("", tables, "", &circles.join("\n")))
}

fn names(drawing: &Drawing) -> Vec<(&str, bool)> {
    drawing.layers.iter().map(|layer| (&*layer.name, layer.hidden)).collect()
}

fn table(layers: &[&str]) -> String {
    let layers: Vec<_> = layers.iter().map(|layer| format!("0 LAYER\n{layer}")).collect();
    format!(
        "0 TABLE\n2 LTYPE\n0 LTYPE\n2 LAYER\n0 ENDTAB\n0 TABLE\n2 LAYER\n70 3\n{}\n0 ENDTAB",
        layers.join("\n")
    )
}

#[test]
fn layers_are_listed_in_order_of_use_as_first_spelt() {
    let drawing = circles(&["b", "A", "B", " a ", "C"], "");
    assert_eq!(names(&drawing), [("b", false), ("A", false), ("C", false)]);
    let layers: Vec<_> = drawing.entities.iter().map(|entity| entity.layer).collect();
    assert_eq!(layers, [0, 1, 0, 1, 2]);
}

#[test]
fn case_is_that_of_unicode() {
    assert_eq!(circles(&["schlüssel", "SCHLÜSSEL"], "").layers.len(), 1);
    assert_eq!(circles(&["schlussel", "SCHLÜSSEL"], "").layers.len(), 2);
}

#[test]
fn prefixes_of_external_references_are_dropped() {
    let drawing = circles(&["1234_1P", "part$0$1234_1p", "part|1234_1P", "a$12$b|c$3$1234_1P"], "");
    assert_eq!(names(&drawing), [("1234_1P", false)]);
    for kept in ["a$b", "$0$x", "a$x$b", "a$$b", "a$0b"] {
        assert_eq!(names(&circles(&[kept], "")), [(kept, false)]);
    }
}

#[test]
fn frozen_layers_and_those_that_are_off_are_hidden() {
    for (record, hidden) in [
        ("2 A\n70 0\n62 7", false),
        ("2 A\n70 1\n62 7", true),
        ("2 a\n70 65", true),
        ("2 A\n70 4\n62 7", false),
        ("2 A\n70 64", false),
        ("2 A\n62 -7", true),
        ("2 A\n62    -7", true),
        ("2 B\n70 1\n62 -7", false),
        ("2 A\n70 x\n62 y", false),
    ] {
        assert_eq!(names(&circles(&["A"], &table(&[record]))), [("A", hidden)], "{record}");
    }
}

#[test]
fn a_broken_number_of_a_layer_never_means_visible() {
    let found = |record: &str| faults(&circles(&["A"], &table(&[record])));
    for (record, code, value) in
        [("2 A\n70 x", 70, "x"), ("2 A\n70 ", 70, ""), ("2 A\n62 - 7", 62, "- 7"), ("2 A\n62 ", 62, "")]
    {
        let faults = found(record);
        let text = format!("A: LAYER: group {code} must be a number, not \"{value}\"");
        assert!(faults.len() == 1 && faults[0].ends_with(&text), "{record}: {faults:?}");
    }
    for record in ["2 A\n70 1.0\n62 -7.0", "2 A", "2 B\n70 x"] {
        assert_eq!(found(record), [""; 0], "{record}");
    }
}

#[test]
fn the_record_of_exactly_the_name_counts_before_one_with_a_prefix() {
    for records in [["2 x$0$A\n70 1\n6 DOT", "2 A\n6 DASHED"], ["2 A\n6 DASHED", "2 x$0$A\n70 1\n6 DOT"]] {
        let drawing = circles(&["A"], &table(&records));
        assert_eq!((names(&drawing), &*drawing.entities[0].line_type), (vec![("A", false)], "DASHED"));
        let drawing = circles(&["x$0$A"], &table(&records));
        assert_eq!((names(&drawing), &*drawing.entities[0].line_type), (vec![("A", true)], "DOT"));
    }
    let drawing = circles(&["A"], &table(&["2 x$0$A\n70 1\n6 DOT"]));
    assert_eq!((names(&drawing), &*drawing.entities[0].line_type), (vec![("A", true)], "DOT"));
}

#[test]
fn line_types_of_layers_count_whatever_their_case() {
    let drawing = circles(&["frozen"], &table(&["2 FROZEN\n6 Dashed"]));
    assert_eq!(&*drawing.entities[0].line_type, "DASHED");
    let drawing = circles(&["A"], &table(&["2 A\n6 "]));
    assert_eq!(&*drawing.entities[0].line_type, "CONTINUOUS");
}

#[test]
fn a_record_is_found_by_a_name_of_any_length_and_not_by_one_that_is_almost_the_same() {
    let name = |length: usize| "~Layer-1234.5P_".chars().cycle().take(length).collect::<String>();
    let records: Vec<_> = (1..40).map(|length| format!("2 {}\n6 T{length}", name(length))).collect();
    let records: Vec<_> = records.iter().map(String::as_str).collect();
    for length in 1..40 {
        let layer = name(length);
        // These two characters differ in the same bit as upper and lower case.
        for (layer, line_type) in [
            (layer.to_uppercase(), format!("T{length}")),
            (layer.to_lowercase(), format!("T{length}")),
            (layer.replacen('~', "^", 1), "CONTINUOUS".into()),
            (format!("{layer}x"), "CONTINUOUS".into()),
        ] {
            for records in [&records[..], &records[length - 1..length]] {
                let drawing = circles(&[&layer], &table(records));
                assert_eq!(&*drawing.entities[0].line_type, line_type, "{layer}");
            }
        }
    }
}

/// Returns the faults about these two records with many others, before, after and between them.
fn faults_of_records(layers: &[&str], one: &str, other: &str) -> Vec<String> {
    let found = [0, 100].map(|count| {
        let others: Vec<_> = (0..count).map(|number| format!("2 1000.L{number}")).collect();
        let others: Vec<_> = others.iter().map(String::as_str).collect();
        let records = [&others[..], &[one], &others, &[other], &others].concat();
        let faults = faults(&circles(layers, &table(&records)));
        faults.iter().map(|fault| fault.split_once(' ').expect("a code").0.to_owned()).collect::<Vec<_>>()
    });
    assert_eq!(found[0], found[1]);
    found[0].clone()
}

#[test]
fn records_of_a_layer_that_contradict_each_other_are_a_fault() {
    const RECORD: &str = "2 1000.1P\n70 0\n62 7\n6 DOT";
    for other in [
        "2 1000.1P\n70 0\n62 7\n6 HIDDEN",
        "2 1000.1p\n70 0\n62 7\n6 HIDDEN",
        "2 1000.1p\n70 0\n62 7",
        "2 1000.1p\n70 1\n62 7\n6 DOT",
        "2 1000.1P\n70 0\n62 -7\n6 DOT",
    ] {
        for (one, other) in [(RECORD, other), (other, RECORD)] {
            for layers in [&["1000.1P"][..], &["1000.1p"], &["1000.1P", "1000.1p"], &["x|1000.1P"]] {
                assert_eq!(faults_of_records(layers, one, other), ["PB002"], "{one} {other}");
            }
            assert_eq!(faults_of_records(&["1000.2P"], one, other), [""; 0]);
        }
    }
    // These differ in nothing that counts.
    for other in ["2 1000.1P\n70 64\n62 1\n6 dot", "2 1000.1p\n62 7\n6 x$0$DOT", "2 1000.2P\n70 1"] {
        assert_eq!(faults_of_records(&["1000.1P"], RECORD, other), [""; 0], "{other}");
    }
    // A record that belongs to an external reference counts only for a name without a record.
    let references = ("2 x$0$1000.1P\n6 DOT", "2 y$0$1000.1P\n6 DASHED");
    assert_eq!(faults_of_records(&["1000.1P"], references.0, references.1), ["PB002"]);
    assert_eq!(faults_of_records(&["x$0$1000.1P", "y$0$1000.1P"], references.0, references.1), [""; 0]);
    assert_eq!(faults_of_records(&["1000.1P"], references.0, "2 1000.1P\n6 DASHED"), [""; 0]);
}

#[test]
fn a_contradiction_is_reported_once_per_layer_with_the_line_of_its_record() {
    let drawing = circles(&["A", "A", "a"], &table(&["2 A", "2 B", "2 a\n70 1", "2 A\n6 DOT"]));
    assert_eq!(
        faults(&drawing),
        [
            "PB002 37 A: the file defines layer A more than once, with different line types or visibility (upper and lower case make no difference)"
        ]
    );
    assert_eq!(drawing.entities.len(), 3);
}

#[test]
fn a_contradiction_about_the_layer_of_an_insertion_concerns_the_contents() {
    let blocks = "0 BLOCK\n8 0\n2 B\n10 0\n20 0\n0 CIRCLE\n8 A\n6 BYBLOCK\n10 0\n20 0\n40 1\n0 ENDBLK";
    let faults_on = |layer: &str| {
        let tables = table(&["2 X\n6 DOT", "2 X\n6 HIDDEN", "2 Y"]);
        let file = file("", &tables, blocks, &format!("0 INSERT\n8 {layer}\n2 B\n10 0\n20 0"));
        let drawing = read(file.as_bytes(), &Options { keep_layer: &|name| name == "A", ..options() });
        drawing.faults.iter().map(|fault| fault.diagnostic.code()).collect::<Vec<_>>()
    };
    assert_eq!((faults_on("X"), faults_on("Y")), (vec![Code::InvalidDxf], vec![]));
}

#[test]
fn records_are_found_among_thousands_that_are_almost_the_same() {
    const BITS: usize = 11;
    let name = |number: usize| -> String {
        (0..BITS).map(|bit| if number >> bit & 1 == 0 { '~' } else { '^' }).collect()
    };
    let names: Vec<_> = (0..1 << BITS).map(name).collect();
    let records: Vec<_> = (0..).zip(&names).map(|(number, name)| format!("2 {name}\n6 T{number}")).collect();
    let records: Vec<_> = records.iter().map(String::as_str).collect();
    let layers: Vec<_> = names.iter().map(String::as_str).collect();
    let drawing = circles(&layers, &table(&records));
    let found: Vec<_> = drawing.entities.iter().map(|entity| entity.line_type.to_string()).collect();
    assert_eq!(found, (0..1 << BITS).map(|number| format!("T{number}")).collect::<Vec<_>>());
}

#[test]
fn records_of_names_that_are_not_plain_are_found() {
    for (record, layer) in [
        (" A", "a"),
        ("A ", "A"),
        ("ma\u{df}e", "MASSE"),
        ("MA\\U+00C4E", "ma\u{e4}e"),
        ("x$0$\u{e4}", "\u{c4}"),
        ("A\\B", "a\\b"),
    ] {
        let drawing = circles(&[layer], &table(&[&format!("2 {record}\n6 Dot")]));
        assert_eq!(&*drawing.entities[0].line_type, "DOT", "{record}");
    }
}

#[test]
fn a_layer_called_layer_is_no_record() {
    let drawing = circles(&["LAYER"], &table(&["2 LAYER\n70 1"]));
    assert_eq!(names(&drawing), [("LAYER", true)]);
}

#[test]
fn an_entity_without_a_layer_is_on_layer_0() {
    assert_eq!(names(&read_all(entities(&format!("0 CIRCLE\n{CIRCLE}")))), [("0", false)]);
}

#[test]
fn each_spelling_of_a_layer_is_asked_for_once() {
    let asked = RefCell::new(Vec::new());
    let keep_layer = |name: &str| {
        asked.borrow_mut().push(name.to_owned());
        name == "B"
    };
    let layers = ["A", "B", "A", " B", "x|B"].map(|layer| format!("0 CIRCLE\n8 {layer}\n{CIRCLE}"));
    let drawing =
        read(entities(&layers.join("\n")).as_bytes(), &Options { keep_layer: &keep_layer, ..options() });
    assert_eq!(names(&drawing), [("B", false)]);
    assert_eq!(drawing.entities.len(), 3);
    assert_eq!(*asked.borrow(), ["A", "B", "B", "B"]);
}

#[test]
fn layers_that_differ_in_one_character_are_not_the_same() {
    let with_other = |length: usize, place: usize| -> String {
        (0..length).map(|index| if index == place { 'b' } else { 'a' }).collect()
    };
    let of_length = |length: usize| (0..=length).map(move |place| with_other(length, place));
    for lengths in (1..=18).map(|length| length..=length).chain([1..=18]) {
        let layers: Vec<_> = lengths.flat_map(of_length).collect();
        // Each layer occurs a second time, when all of them are already in the cache.
        let twice: Vec<_> = layers.iter().chain(&layers).map(String::as_str).collect();
        let drawing = circles(&twice, "");
        assert_eq!(names(&drawing), layers.iter().map(|layer| (layer.as_str(), false)).collect::<Vec<_>>());
        let expected: Vec<_> = (0..).take(layers.len()).collect();
        let on: Vec<_> = drawing.entities.iter().map(|entity| entity.layer).collect();
        assert_eq!(on, [&expected[..], &expected[..]].concat());
    }
}
