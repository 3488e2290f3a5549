//! What is allowed, and what a machinist would look at twice: PB116 and PB211.

use pathbuild_path::{Bindings, Doubts, Language};

use crate::support::{codes, compile_raw, language, path, read_as};

/// What is said of a path, by the messages' words of value.
fn said(drawing: &str, doubts: Doubts) -> Vec<String> {
    let language = Language { doubts, ..language() };
    let (raw, _) = read_as(drawing, &language).paths.into_iter().next().expect("there is a path");
    let compiled = compile_raw(&raw, &Bindings::check_values(&raw.definitions), &language);
    let letter = |found: &pathbuild_diagnostic::Diagnostic| {
        let text = found.text.as_ref().map_or("", |it| &it.text[it.start as usize..it.end as usize]);
        format!("{} {text}", found.code())
    };
    let found = compiled.found.iter().map(letter).filter(|said| !said.starts_with("PB210"));
    found.collect()
}

fn line(start: &str, text: &str) -> Vec<String> {
    let text = if text.is_empty() { String::new() } else { format!(" \"{text}\"") };
    said(&path(start, &format!("mill 0,0 40,0{text}\nend 40,0")), MACHINE)
}

const MACHINE: Doubts =
    Doubts { below_plate: 0.5, infeed: 1.0, mark_depth: 0.5, maximum_feed: Some(1500.0), text_margin: 0.1 };

#[test]
fn the_bottom_is_not_far_below_the_plate() {
    assert_eq!(line("T5 O2 I1 B-0.5", ""), [""; 0]);
    assert_eq!(line("T5 O2 I1 B-0.51", ""), ["PB211 B-0.51"]);
    assert_eq!(line("T5 O2 I1 B0", "B-0.5"), [""; 0]);
    assert_eq!(line("T5 O2 I1 B0", "B-0.51"), ["PB211 B-0.51"]);
    let higher = Doubts { below_plate: 3.0, ..MACHINE };
    assert_eq!(said(&path("T5 O2 I1 B-3", "mill 0,0 40,0\nend 40,0"), higher), [""; 0]);
}

#[test]
fn a_bottom_without_effect_is_no_doubt() {
    assert_eq!(said(&path("T5 O2 I1 D4", "mark 0,0 40,0 \"B-3\"\nend 40,0"), MACHINE), [""; 0]);
    assert_eq!(said(&path("T5 O2 I1 B0", "mill 0,0 40,0 \"B-3\"\nend 40,0"), MACHINE), ["PB211 B-3"]);
}

#[test]
fn a_mark_is_not_deeper_than_half_the_material() {
    let mark = |start: &str, text: &str| {
        let texts = [
            format!("mark 0,0 40,0{text}\nend 40,0"),
            format!("sweep 0,0 40,0\ncircle DIVIDE 40,0 d 2{text}\nend 40,0"),
            format!("sweep 0,0 40,0\ncircle DIVIDE 40,0 d 5{text}\nend 40,0"),
        ];
        let [line, hole, ring] = texts.map(|drawing| said(&path(start, &drawing), MACHINE));
        assert_eq!((&line, &line), (&hole, &ring));
        line
    };
    assert_eq!(mark("T5 O2 I1", " \"D2.5\""), [""; 0]);
    assert_eq!(mark("T5 O2 I1", " \"D2.49\""), ["PB211 D2.49"]);
    assert_eq!(mark("T5 O2 I1", " \"D-0.2\""), ["PB211 D-0.2"]);
    // The path's D, which is that of support bars too.
    assert_eq!(mark("T5 O2 I1 D2.5", ""), [""; 0]);
    assert_eq!(mark("T5 O2 I1 D2.49", ""), ["PB211 D2.49"]);
    assert_eq!(mark("T5 O2 I1 D2.49", " \"D4.8\""), [""; 0]);
    let through = Doubts { mark_depth: 1.0, ..MACHINE };
    assert_eq!(said(&path("T5 O2 I1 D0", "mark 0,0 40,0\nend 40,0"), through), [""; 0]);
}

#[test]
fn the_path_s_depth_of_marks_is_said_once_and_not_of_bars() {
    let marks = "mark 0,0 20,0\nmark 20,0 40,0\nend 40,0";
    assert_eq!(said(&path("T5 O2 I1 D1", marks), MACHINE), ["PB211 D1"]);
    let bars = "bars 0,0 40,0 \"B0 P2 U5\"\nend 40,0";
    assert_eq!(said(&path("T5 O2 I1 D1", bars), MACHINE), [""; 0]);
    assert_eq!(said(&path("T5 O2 I1", &bars.replace("B0", "B0 D1")), MACHINE), [""; 0]);
}

#[test]
fn an_infeed_is_not_above_the_thickness() {
    assert_eq!(line("T5 O2 I5 B0", ""), [""; 0]);
    assert_eq!(line("T5 O2 I5.01 B0", ""), ["PB211 I5.01"]);
    assert_eq!(line("T5 O2 I1 B0", "I5"), [""; 0]);
    assert_eq!(line("T5 O2 I1 B0", "I5.01"), ["PB211 I5.01"]);
    let twice = Doubts { infeed: 2.0, ..MACHINE };
    assert_eq!(said(&path("T5 O2 I10 B0", "mill 0,0 40,0\nend 40,0"), twice), [""; 0]);
    assert_eq!(said(&path("T5 O2 I10.01 B0", "mill 0,0 40,0\nend 40,0"), twice), ["PB211 I10.01"]);
}

#[test]
fn a_feed_is_not_above_the_machines() {
    assert_eq!(line("T5 O2 I1 B0 F1500", ""), [""; 0]);
    assert_eq!(line("T5 O2 I1 B0 F1501", ""), ["PB211 F1501"]);
    assert_eq!(line("T5 O2 I1 B0", "F1500"), [""; 0]);
    assert_eq!(line("T5 O2 I1 B0", "F1501"), ["PB211 F1501"]);
    let unknown = Doubts { maximum_feed: None, ..MACHINE };
    assert_eq!(said(&path("T5 O2 I1 B0 F9999", "mill 0,0 40,0\nend 40,0"), unknown), [""; 0]);
}

/// The codes of a path with lines or circles and a text in the middle of nothing else.
fn texts(statements: &str, margin: f64) -> Vec<String> {
    let drawing = format!("layer 1234.1P\nstart 500,0 \"T5 O3 I1 B0 D2\"\nend 500,90\n{statements}");
    let language = Language { doubts: Doubts { text_margin: margin, ..MACHINE }, ..language() };
    codes(&read_as(&drawing, &language).paths[0].0.diagnostics)
}

fn text(y: f64) -> String {
    format!("text 20,{y} \"F100\" height 2 align centre middle")
}

#[test]
fn a_text_is_nearer_to_its_element_than_to_another() {
    let lines = "mill 0,0 40,0\nmill 0,3 40,3";
    // 1.44 mm from one line and 1.56 from the other; 1.46 and 1.54.
    assert_eq!(texts(&format!("{lines}\n{}", text(1.44)), 0.1), [""; 0]);
    assert_eq!(texts(&format!("{lines}\n{}", text(1.46)), 0.1), ["PB116"]);
    assert_eq!(texts(&format!("{lines}\n{}", text(1.44)), 0.2), ["PB116"]);
    assert_eq!(texts(&format!("{lines}\n{}", text(1.46)), 0.0), [""; 0]);
    assert_eq!(texts(&format!("{lines}\n{}", text(1.5)), 0.0), ["PB116"], "the order decides");
}

#[test]
fn only_elements_of_the_same_kind_are_rivals() {
    let both = "mill 0,0 40,0\ncircle 20,3 d 6";
    assert_eq!(texts(&format!("{both}\n{}", text(1.5)), 0.1), [""; 0]);
    let circles = "circle 20,0 d 6\ncircle 20,0 d 9";
    assert_eq!(texts(&format!("{circles}\n{}", text(1.5)), 0.1), ["PB116"]);
    let arcs = "mill arc centre 20,0 r 10 from 0 to 180\nmill arc centre 20,0 r 13 from 0 to 180";
    assert_eq!(texts(&format!("{arcs}\n{}", text(11.5)), 0.1), ["PB116"]);
}

#[test]
fn an_element_that_has_its_text_is_no_rival() {
    let lines = "mill 0,0 40,0\nmill 0,3 40,3\ntext 10,0.5 \"F50\" height 2 align centre middle";
    let found = texts(&format!("{lines}\n{}", text(1.5)), 0.1);
    assert_eq!(found, [""; 0]);
}

/// If the hole had the start's text, the start would have none, which is an error.
#[test]
fn markers_are_no_rivals_of_elements() {
    let (start, hole) = ("start 20,0 \"T5 O3 I1 B0 D2\"", "circle 20,0 d 3\nend 20,0");
    let said = |text: &str| said(&format!("layer 1234.1P\n{start}\n{hole}{text}"), MACHINE);
    assert_eq!(said(""), [""; 0]);
}

/// With such a text the subpath would be an error.
#[test]
fn an_element_that_does_not_know_the_letters_is_no_rival() {
    let both = "mill 0,0 40,0\nsubpath 0,3 40,3";
    let said =
        |string: &str| texts(&format!("{both}\ntext 20,1.5 \"{string}\" height 2 align centre middle"), 0.1);
    assert_eq!(said("F100"), [""; 0]);
    assert_eq!(said("N100"), ["PB116"]);
}

#[test]
fn a_tilde_layer_settles_it() {
    let lines = "mill 0,0 40,0\nlayer 1234.1P~A\nmill 0,3 40,3";
    assert_eq!(texts(&format!("{lines}\n{}", text(1.5)), 0.1), [""; 0]);
}
