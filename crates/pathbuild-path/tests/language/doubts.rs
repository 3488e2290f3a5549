//! Tests permitted values that are suspicious to a machinist: PB116 and PB211.

use pathbuild_diagnostic::Lang;
use pathbuild_path::{Bindings, DoubtThresholds, Language, PathTool, PathTools, bind_leniently};

use crate::support::{codes, compile, compile_raw, language, path, raw, read_as};

/// Returns the findings about a path, with their values.
fn findings(drawing: &str, doubts: DoubtThresholds) -> Vec<String> {
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

fn all_codes(drawing: &str, language: &Language) -> Vec<String> {
    let (raw, _) = read_as(drawing, language).paths.into_iter().next().expect("there is a path");
    codes(&compile_raw(&raw, &Bindings::check_values(&raw.definitions), language).found)
}

fn line(start: &str, text: &str) -> Vec<String> {
    let text = if text.is_empty() { String::new() } else { format!(" \"{text}\"") };
    findings(&path(start, &format!("mill 0,0 40,0{text}\nend 40,0")), MACHINE)
}

const MACHINE: DoubtThresholds = DoubtThresholds { maximum_feed: Some(1500.0), ..DoubtThresholds::DEFAULT };

#[test]
fn the_bottom_is_not_far_below_the_plate() {
    assert_eq!(line("T5 O2 I1 B-0.5", ""), [""; 0]);
    assert_eq!(line("T5 O2 I1 B-0.51", ""), ["PB211 B-0.51"]);
    assert_eq!(line("T5 O2 I1 B0", "B-0.5"), [""; 0]);
    assert_eq!(line("T5 O2 I1 B0", "B-0.51"), ["PB211 B-0.51"]);
    let higher = DoubtThresholds { below_plate: 3.0, ..MACHINE };
    assert_eq!(findings(&path("T5 O2 I1 B-3", "mill 0,0 40,0\nend 40,0"), higher), [""; 0]);
}

/// S is a height, and no speed: sweeps stay within the reach of a machine.
#[test]
fn sweeps_are_not_far_above_the_material() {
    assert_eq!(line("T5 O2 I1 B0 S105", ""), [""; 0]);
    assert_eq!(line("T5 O2 I1 B0 S105.01", ""), ["PB211 S105.01"]);
    assert_eq!(line("T5 O2 I1 B0 M3 S12000", ""), ["PB211 S12000"]);
    let sweep = |text: &str| {
        let drawn = format!("mill 0,0 20,0\nsweep 20,0 40,0 \"{text}\"\nend 40,0");
        findings(&path("T5 O2 I1 B0 S20", &drawn), MACHINE)
    };
    assert_eq!(sweep("S105"), [""; 0]);
    assert_eq!(sweep("S105.01"), ["PB211 S105.01"]);
    let said = messages(&path("T2 O2 I0.5 B0 S12000", "mill 0,0 40,0\nend 40,0"), MACHINE);
    assert!(
        said.contains("11998 mm above the material; write") && said.contains("for example S7;"),
        "{said}"
    );
}

/// Bars of 0.1 mm hold nothing, as in the part check.
#[test]
fn support_bars_are_not_too_short() {
    let bars = |start: &str, text: &str| {
        findings(&path(start, &format!("bars 0,0 40,0{text}\nbars 40,0 40,40\nend 40,40")), MACHINE)
    };
    assert_eq!(bars("T5 O2 I1 B0 D1 P0.101 U5", ""), [""; 0]);
    assert_eq!(bars("T5 O2 I1 B0 D1 P0.1 U5", ""), ["PB211 P0.1"]);
    assert_eq!(bars("T5 O2 I1 B0 D1 P1 U5", " \"P0.05\""), ["PB211 P0.05"]);
}

/// With the surface at Z0, the thickness is the only finding: no other value can be compared with it.
#[test]
fn a_surface_at_zero_is_a_single_finding() {
    let found = |start: &str| {
        let drawn = "mill 0,0 40,0 \"B1\"\nbars 40,0 80,0\nmark 80,0 99,0\nend 99,0";
        findings(&path(start, drawn), MACHINE)
    };
    assert_eq!(found("O2 T0 I0.5 F150 B-2 D-1 P4 U10"), ["PB203 T0"]);
    assert_eq!(found("O2 T-2 I0.5 F150 B-2 D-1 P4 U10"), ["PB203 T-2"]);
    assert_eq!(found("O2 T0.0000000011 I0.0000000011 F150 B-2 D-1 P4 U10 S1").len(), 4);
    // What does not depend on T is found all the same.
    assert_eq!(found("O2 T0 I0.5 F150 B-2 D-3 P4 U10"), ["PB203 T0", "PB203 D-3"]);
    let said = messages(&path("O2 T0 I1 B-2", "mill 0,0 40,0\nend 40,0"), MACHINE);
    assert!(said.contains("measured from the plate upwards, not from the surface down"), "{said}");
}

/// Returns the messages about a path, with their help.
fn messages(drawing: &str, doubts: DoubtThresholds) -> String {
    let language = Language { doubts, ..language() };
    let (raw, _) = read_as(drawing, &language).paths.into_iter().next().expect("there is a path");
    let found = compile_raw(&raw, &Bindings::check_values(&raw.definitions), &language).found;
    let message = |found: &pathbuild_diagnostic::Diagnostic| {
        format!("{}; {}", found.text(Lang::En), found.help(Lang::En).unwrap_or_default())
    };
    found.iter().map(message).collect()
}

/// Values that are recommended are accepted.
#[test]
fn recommended_values_are_in_range() {
    let milled = "mill 0,0 40,0\nend 40,0";
    let half = DoubtThresholds { infeed: 0.5, ..MACHINE };
    assert!(
        messages(&path("T5 O2 I3 B0", milled), half).contains("I is 3, more than 2.5 for a thickness T of 5")
    );
    assert!(messages(&path("T5 O2 I6 B0", milled), half).contains("one pass cuts through all"));
    assert!(messages(&path("T0.4 O2 I1 B0", milled), MACHINE).contains("for example I0.4"));
    let bars = |thickness: &str| {
        let start = format!("T{thickness} O2 I0.5 B0 D0.01 P1 U5");
        messages(&path(&start, "bars 0,0 40,0\nend 40,0"), MACHINE)
    };
    assert!(bars("5").contains("for example D1:") && bars("0.8").contains("for example D0.4:"));
    let mark = |thickness: &str| {
        let start = format!("T{thickness} O2 I0.1 D0");
        messages(&path(&start, "mark 0,0 40,0\nend 40,0"), MACHINE)
    };
    assert!(mark("5").contains("such as D4.8 for a depth of 0.2 mm"), "{}", mark("5"));
    assert!(mark("0.3").contains("such as D0.15 for a depth of 0.15 mm"), "{}", mark("0.3"));
    let first = |start: &str| messages(&path(start, milled), MACHINE);
    assert!(first("T5 O2 I1 B0 W6").contains("write W4 "));
    assert!(first("T5 O2 I5 B0 W6").contains("write W2.5 "), "W must be above 0");
}

/// Shims raise the material: a negative H would mill into the plate.
#[test]
fn an_embedded_path_is_not_lowered() {
    let embedding =
        |text: &str| findings(&path("T5 O2 I1", &format!("subpath 0,0 40,0 \"{text}\"\nend 40,0")), MACHINE);
    assert_eq!(embedding(">2050.1P T5 O2 H0"), [""; 0]);
    assert_eq!(embedding(">2050.1P T5 O2 H-0.1"), ["PB211 H-0.1"]);
    let probe = messages(&path("T5 O2 I1 B0", "mill 0,0 40,0\nprobe 20,20 \"H-2\"\nend 40,0"), MACHINE);
    assert!(probe.contains("the probe expects the surface 2 mm below T"), "{probe}");
}

#[test]
fn a_bottom_without_effect_is_no_doubt() {
    assert_eq!(findings(&path("T5 O2 I1 D4", "mark 0,0 40,0 \"B-3\"\nend 40,0"), MACHINE), [""; 0]);
    assert_eq!(findings(&path("T5 O2 I1 B0", "mill 0,0 40,0 \"B-3\"\nend 40,0"), MACHINE), ["PB211 B-3"]);
}

#[test]
fn a_mark_is_not_deeper_than_half_the_material() {
    let mark = |start: &str, text: &str| {
        let texts = [
            format!("mark 0,0 40,0{text}\nend 40,0"),
            format!("sweep 0,0 40,0\ncircle DIVIDE 40,0 d 2{text}\nend 40,0"),
            format!("sweep 0,0 40,0\ncircle DIVIDE 40,0 d 5{text}\nend 40,0"),
        ];
        let [line, hole, ring] = texts.map(|drawing| findings(&path(start, &drawing), MACHINE));
        assert_eq!((&line, &line), (&hole, &ring));
        line
    };
    assert_eq!(mark("T5 O2 I1", " \"D2.5\""), [""; 0]);
    assert_eq!(mark("T5 O2 I1", " \"D2.49\""), ["PB211 D2.49"]);
    assert_eq!(mark("T5 O2 I1", " \"D-0.2\""), ["PB211 D-0.2"]);
    // The D of the path also applies to support bars.
    assert_eq!(mark("T5 O2 I1 D2.5", ""), [""; 0]);
    assert_eq!(mark("T5 O2 I1 D2.49", ""), ["PB211 D2.49"]);
    assert_eq!(mark("T5 O2 I1 D2.49", " \"D4.8\""), [""; 0]);
    // With P or U it was meant for bars, and half of T is usual for these.
    assert_eq!(mark("T5 O2 I1 D2.51 P1", ""), [""; 0]);
    assert_eq!(mark("T5 O2 I1 D2.5 P1", ""), ["PB211 D2.5"]);
    assert_eq!(mark("T5 O2 I1 D2.5 U5", ""), ["PB211 D2.5"]);
    assert_eq!(mark("T5 O2 I1 D2.5 U5", " \"D2.5\""), [""; 0]);
    let through = DoubtThresholds { mark_depth: 1.0, ..MACHINE };
    assert_eq!(findings(&path("T5 O2 I1 D0", "mark 0,0 40,0\nend 40,0"), through), [""; 0]);
}

#[test]
fn the_path_s_depth_of_marks_is_said_once_and_not_of_bars() {
    let marks = "mark 0,0 20,0\nmark 20,0 40,0\nend 40,0";
    assert_eq!(findings(&path("T5 O2 I1 D1", marks), MACHINE), ["PB211 D1"]);
    let bars = "bars 0,0 40,0 \"B0 P2 U5\"\nend 40,0";
    assert_eq!(findings(&path("T5 O2 I1 D1", bars), MACHINE), [""; 0]);
    assert_eq!(findings(&path("T5 O2 I1", &bars.replace("B0", "B0 D1")), MACHINE), [""; 0]);
}

#[test]
fn an_infeed_is_not_above_the_thickness() {
    assert_eq!(line("T5 O2 I5 B0", ""), [""; 0]);
    assert_eq!(line("T5 O2 I5.01 B0", ""), ["PB211 I5.01"]);
    assert_eq!(line("T5 O2 I1 B0", "I5"), [""; 0]);
    assert_eq!(line("T5 O2 I1 B0", "I5.01"), ["PB211 I5.01"]);
    let twice = DoubtThresholds { infeed: 2.0, ..MACHINE };
    assert_eq!(findings(&path("T5 O2 I10 B0", "mill 0,0 40,0\nend 40,0"), twice), [""; 0]);
    assert_eq!(findings(&path("T5 O2 I10.01 B0", "mill 0,0 40,0\nend 40,0"), twice), ["PB211 I10.01"]);
}

#[test]
fn a_feed_is_not_above_the_machines() {
    assert_eq!(line("T5 O2 I1 B0 F1500", ""), [""; 0]);
    assert_eq!(line("T5 O2 I1 B0 F1501", ""), ["PB211 F1501"]);
    assert_eq!(line("T5 O2 I1 B0", "F1500"), [""; 0]);
    assert_eq!(line("T5 O2 I1 B0", "F1501"), ["PB211 F1501"]);
    let unknown = DoubtThresholds { maximum_feed: None, ..MACHINE };
    assert_eq!(findings(&path("T5 O2 I1 B0 F9999", "mill 0,0 40,0\nend 40,0"), unknown), [""; 0]);
}

/// C protects a thin drill, so a single stroke must not come as a surprise.
#[test]
fn a_peck_depth_that_nothing_uses_is_told() {
    let pecks = |start: &str, text: &str, has_cycles| {
        let language = Language { doubts: DoubtThresholds { has_cycles, ..MACHINE }, ..language() };
        let drawing = path(start, &format!("sweep 0,0 40,0\ncircle 40,0 d 2{text}\nend 40,0"));
        all_codes(&drawing, &language)
    };
    for (start, text) in [("T5 O2 B0", " \"C2\""), ("T5 O2 B0 C2", "")] {
        assert_eq!(pecks(start, text, true), [""; 0]);
        assert_eq!(pecks(start, text, false), ["PB210 C"], "once, though the path's C holds for all holes");
    }
    assert_eq!(pecks("T5 O2 B0", "", false), [""; 0]);
    let language = Language { doubts: DoubtThresholds { has_cycles: true, ..MACHINE }, ..language() };
    for (line, more) in [("mill", ""), ("mark", " D4"), ("bars", " D2 P2 U5")] {
        let chain =
            |text: &str| path(&format!("T5 O2 I1 B0{more}"), &format!("{line} 0,0 40,0{text}\nend 40,0"));
        assert_eq!(all_codes(&chain(""), &language), [""; 0], "{line}");
        assert_eq!(all_codes(&chain(" \"C2\""), &language), ["PB210 C"], "{line}");
    }
}

/// Returns the codes for a path with lines or circles and a small text, with a circle of 0.7 mm around it.
fn at_small_text(statements: &str, at: &str) -> Vec<String> {
    texts(&format!("{statements}\nmtext {at} \"B1\" height 1 align middle centre"), 0.1)
}

/// The text is on one line or arc, and would be on the other after a small shift.
#[test]
fn a_text_at_the_joint_of_two_elements_is_doubtful() {
    let lines = "mill 0,0 20,0\nmill 20,0 40,0";
    for (x, is_doubtful) in
        [("19.999", true), ("20", true), ("20.001", true), ("19.7", false), ("20.3", false)]
    {
        assert_eq!(at_small_text(lines, &format!("{x},0.2")) == ["PB116"], is_doubtful, "{x}");
    }
    let text = "mtext 19.999,0.2 \"B1\" height 1 align middle centre";
    let drawing = path("T5 O2 I1 B0", &format!("{lines}\n{text}\nend 40,0"));
    let raw = read_as(&drawing, &Language { doubts: MACHINE, ..language() });
    let found = &raw.paths[0].0.diagnostics;
    assert!(found[0].text(Lang::En).ends_with("only 0.001 mm farther away"), "{found:?}");
    // The text is 0.2 mm away from one line, and 0.29 or 0.31 mm from the end of the other.
    assert_eq!(at_small_text(lines, "19.79,0.2"), ["PB116"]);
    assert_eq!(at_small_text(lines, "19.76,0.2"), [""; 0]);
    let arc = "mill 0,0 20,0\nmill arc centre 20,10 r 10 from 270 to 0";
    for x in ["19.999", "20", "20.001"] {
        assert_eq!(at_small_text(arc, &format!("{x},0.2")), ["PB116"], "{x}");
    }
    let other = format!("{lines}\nmtext 19.999,0.2 \"B2\" height 1 align middle centre");
    assert_eq!(at_small_text(&other, "30,0.2"), [""; 0], "the other line has a text of its own");
}

#[test]
fn an_element_just_out_of_the_texts_reach_is_a_rival() {
    let holes = "circle 20,0 d 2\ncircle 23.4,0 d 2";
    assert_eq!(at_small_text(holes, "21.69,0"), ["PB116"]);
    assert_eq!(at_small_text(holes, "21.64,0"), [""; 0], "1.64 and 1.76 mm");
    let lines = "mill 0,0 40,0\nmill 0,1.36 40,1.36";
    assert_eq!(at_small_text(lines, "20,0.65"), ["PB116"]);
    assert_eq!(at_small_text(lines, "20,0.62"), [""; 0], "0.62 and 0.74 mm");
}

/// A ring takes each text inside it, however far away its edge is.
#[test]
fn a_text_in_a_ring_is_doubtful_if_another_element_is_nearer() {
    let ring = "mill 0,0 30,0\ncircle 30,0 d 40";
    for y in ["0.69", "0.71", "5"] {
        assert_eq!(at_small_text(ring, &format!("20,{y}")), ["PB116"], "{y}");
    }
    // The text is at the ring's centre or edge.
    assert_eq!(at_small_text("mill 0,9 30,9\ncircle 30,0 d 40", "30,1"), [""; 0]);
    assert_eq!(at_small_text("mill 0,9 15,9\ncircle 30,0 d 40", "11,0"), [""; 0]);
    let hole = "circle 20,0 d 2\ncircle 30,0 d 40";
    assert_eq!(at_small_text(hole, "20,1.75"), ["PB116"]);
    let with_text = format!("{hole}\nmtext 20,1 \"B2\" height 1 align middle centre");
    assert_eq!(at_small_text(&with_text, "20,3"), [""; 0], "the hole has its text");
}

/// The second text over a hole or ring belongs to the line that ends at its centre.
#[test]
fn a_second_text_over_a_circle_is_doubtful() {
    let hole = "mill 0,0 20,0\ncircle 20,0 d 2\nmtext 20,0 \"F100\" height 1 align middle centre";
    assert_eq!(at_small_text(hole, "19.9,0.65"), ["PB116"]);
    let ring = "mill 0,0 20,0\ncircle 20,0 d 6\nmtext 20,0 \"F100\" height 1 align middle centre";
    assert_eq!(at_small_text(ring, "17.1,0.5"), ["PB116"]);
    assert_eq!(at_small_text(ring, "15.9,0.5"), [""; 0], "the text is beside the ring");
}

#[test]
fn a_text_whose_place_is_unknown_is_doubtful() {
    let with = |text: &str| texts(&format!("mill 0,0 40,0\nmtext 20,0.3 \"{text}\" height 1 width 9"), 0.1);
    for (text, codes) in [
        (r"B1", &[][..]),
        (r"{\H0.9;B1}", &[]),
        (r"\pxqr,i0;B1", &[]),
        (r"\pi5;B1", &["PB116"]),
        (r"^IB1", &["PB116"]),
        (r"{\H0.9;B1} F100", &["PB116"]),
        (r"\H0.9;\pi5;B1\NF100", &["PB116"]),
    ] {
        assert_eq!(with(text), codes, "{text}");
    }
    let far = r#"mill 0,0 40,0
mtext 20,9 "\pi5;B1" height 1"#;
    assert_eq!(texts(far, 0.1), ["PB107"], "a text without an element");
}

/// Returns the codes for a path with lines or circles and a text.
fn texts(statements: &str, margin: f64) -> Vec<String> {
    let drawing = format!("layer 1234.1P\nstart 500,0 \"T5 O3 I1 B0 D2\"\nend 500,90\n{statements}");
    let language = Language { doubts: DoubtThresholds { text_margin: margin, ..MACHINE }, ..language() };
    codes(&read_as(&drawing, &language).paths[0].0.diagnostics)
}

fn text(y: f64) -> String {
    format!("text 20,{y} \"F100\" height 2 align centre middle")
}

#[test]
fn a_text_is_nearer_to_its_element_than_to_another() {
    let lines = "mill 0,0 40,0\nmill 0,3 40,3";
    // The text is 1.44 mm from one line and 1.56 mm from the other; then 1.46 and 1.54 mm.
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

/// A second text beside an element belongs to its neighbour. The texts are `above` mm away from one line, and 3 mm less from the other.
#[test]
fn a_text_whose_nearest_element_has_another_text_is_doubtful() {
    let second = |above: f64, string: &str| {
        let lines = "mill 0,0 40,0\nmill 0,3 40,3\ntext 10,-0.2 \"F50\" height 2 align centre middle";
        texts(&format!("{lines}\ntext 20,{above} \"{string}\" height 4 align centre middle"), 0.1)
    };
    assert_eq!(second(1.49, "B1"), ["PB116"]);
    assert_eq!(second(0.6, "B1"), ["PB116"]);
    assert_eq!(second(1.51, "B1"), [""; 0]);
    // Neither line takes this letter, which is an error in any case.
    assert_eq!(second(0.6, "L1"), ["PB202 L"]);
    // The nearest element of any kind counts: the text is on the line, and 3.7 mm away from the hole's centre.
    let ring = "mill 0,0 17,0\ncircle 20,0 d 6\ntext 8,0 \"B2\" height 1 align centre middle";
    let of_ring = |y: f64| texts(&format!("{ring}\ntext 16.3,{y} \"B3\" height 1 align centre middle"), 0.1);
    assert_eq!(of_ring(0.0), ["PB116"]);
    assert_eq!(of_ring(-9.0), ["PB107"]);
}

/// Elements with an error of their own keep no text that a finding could quote.
#[test]
fn an_element_with_an_error_is_no_rival() {
    let lines =
        "line \"BREAK\" 0,0 40,0\nline \"BREAK\" 0,3 40,3\ntext 10,-0.2 \"F50\" height 2 align centre middle";
    let found = texts(&format!("{lines}\ntext 20,0.6 \"B1\" height 4 align centre middle"), 0.1);
    assert_eq!(found, ["PB106"]);
}

/// The text says that it is on the same layer as its element, but an element on another layer of the path is nearer.
#[test]
fn a_text_nearer_to_an_element_on_another_layer_is_doubtful() {
    let found = |layers: [&str; 2], above: f64, other: &str| {
        let [first, second] = layers;
        let drawing = format!("layer {first}\n{other}\nlayer {second}\nmill 0,3 40,3");
        texts(&format!("{drawing}\n{}", text(above)), 0.1)
    };
    let line = "mill 0,0 40,0";
    for first in ["1234.1P~A", "1234_1P"] {
        assert_eq!(found([first, "1234.1P"], 1.49, line), ["PB116"], "{first}");
        assert_eq!(found([first, "1234.1P"], 1.51, line), [""; 0], "{first}");
        let with_text = format!("{line}\ntext 10,0.2 \"F50\" height 2 align centre middle");
        assert_eq!(found([first, "1234.1P"], 1.49, &with_text), [""; 0], "{first}");
    }
    // A tilde layer holds a text and its element on purpose.
    assert_eq!(found(["1234.1P", "1234.1P~A"], 1.49, line), [""; 0]);
}

/// The text is on the layer of one path, but on the line of another one.
#[test]
fn a_text_on_an_element_of_another_path_is_doubtful() {
    let found = |layer: &str, above: f64, margin: f64, other: &str| {
        let own = format!(
            "layer 1234.1P\nstart 500,0 \"T5 O3 I1 B0 D2\"\nend 500,90\nlayer {layer}\nmill 0,3 40,3"
        );
        let other = format!("layer 1235.1P\nstart 600,0 \"T5 O3 I1 B0 D2\"\nend 600,90\n{other}");
        let text = format!("text 20,{above} \"F100\" height 6 align centre middle");
        let language = Language { doubts: DoubtThresholds { text_margin: margin, ..MACHINE }, ..language() };
        codes(&read_as(&format!("{own}\n{text}\n{other}"), &language).paths[0].0.diagnostics)
    };
    let line = "mill 0,0 40,0";
    assert_eq!(found("1234.1P", 0.0, 0.1, line), ["PB116"]);
    assert_eq!(found("1234.1P", 0.09, 0.1, line), ["PB116"]);
    assert_eq!(found("1234.1P", 0.11, 0.1, line), [""; 0]);
    assert_eq!(found("1234.1P", 0.11, 0.12, line), ["PB116"]);
    assert_eq!(found("1234.1P", 0.0, 0.0, line), ["PB116"]);
    // Both lie on the same line, the other one has a text, does not take F, or the text is kept apart on purpose.
    assert_eq!(found("1234.1P", 3.0, 0.1, "mill 0,3 40,3"), [""; 0]);
    let with_text = format!("{line}\ntext 10,0.2 \"F50\" height 2 align centre middle");
    assert_eq!(found("1234.1P", 0.0, 0.1, &with_text), [""; 0]);
    assert_eq!(found("1234.1P", 0.0, 0.1, "sweep 0,0 40,0"), [""; 0]);
    assert_eq!(found("1234.1P~A", 0.0, 0.1, line), [""; 0]);
}

#[test]
fn a_feed_has_no_separator_of_thousands() {
    for doubtful in ["F0.100", "F,150", "F1.200", "F1,200", "F12.000", "F99.999"] {
        assert_eq!(line("T5 O2 I1 B0", doubtful), [format!("PB211 {doubtful}")]);
    }
    for usual in ["F0.099", "F100.000", "F1.20", "F1.2000", "F1200"] {
        assert_eq!(line("T5 O2 I1 B0", usual), [""; 0], "{usual}");
    }
    assert_eq!(line("T5 O2 I1 B0", "F0.000"), ["PB203 F0.000"]);
}

#[test]
fn a_length_does_not_begin_with_a_zero() {
    for doubtful in ["I03", "I03.", "B01", "B-00"] {
        let expected: Vec<String> =
            if doubtful == "B-00" { Vec::new() } else { vec![format!("PB211 {doubtful}")] };
        assert_eq!(line("T5 O2 I1 B0", doubtful), expected, "{doubtful}");
    }
    for usual in ["I0.3", "I3", "I0,3", "I00.3", "B0", "N01", "F0150"] {
        assert_eq!(line("T5 O2 I1 B0", usual), [""; 0], "{usual}");
    }
    assert_eq!(line("T05 O2 I1 B0", ""), ["PB211 T05"]);
}

#[test]
fn an_element_that_has_its_text_is_no_rival() {
    let lines = "mill 0,0 40,0\nmill 0,3 40,3\ntext 10,0.5 \"F50\" height 2 align centre middle";
    let found = texts(&format!("{lines}\n{}", text(1.5)), 0.1);
    assert_eq!(found, [""; 0]);
}

/// The text cannot belong to the hole: then the start would have none, which is an error.
#[test]
fn markers_are_no_rivals_of_elements() {
    let (start, hole) = ("start 20,0 \"T5 O3 I1 B0 D2\"", "circle 20,0 d 3\nend 20,0");
    let said = |text: &str| findings(&format!("layer 1234.1P\n{start}\n{hole}{text}"), MACHINE);
    assert_eq!(said(""), [""; 0]);
}

/// The subpath does not accept F, so a text with F cannot belong to it.
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

#[test]
fn a_depth_that_was_meant_from_the_surface_is_named() {
    let messages = |bottom: &str| {
        let language = Language { doubts: MACHINE, ..language() };
        let drawing = path("T4 O2 I1 B0", &format!("mill 0,0 40,0 \"{bottom}\"\nend 40,0"));
        let (raw, _) = read_as(&drawing, &language).paths.into_iter().next().expect("there is a path");
        let compiled = compile_raw(&raw, &Bindings::default(), &language);
        let help = |found: &pathbuild_diagnostic::Diagnostic| found.help(Lang::En);
        compiled.found.iter().filter_map(help).collect::<String>()
    };
    assert!(
        messages("B-2")
            .starts_with("for a depth of 2 mm in T4, write B2: heights are measured from the plate upwards")
    );
    assert!(messages("B-3.99").contains("write B0.01:"));
    assert!(messages("B-4").contains("4 mm in T4, write B0:"), "through");
    assert!(messages("B-4.01").starts_with("check B"));
    assert_eq!(messages("B-0.5"), "");
}

#[test]
fn a_circle_hardly_larger_than_the_cutter_was_meant_to_be_drilled() {
    let circle = |diameter: &str, doubts: DoubtThresholds| {
        findings(
            &path("T5 O3 I1 B0 D2", &format!("circle 0,0 d {diameter}\nmill 0,0 40,0\nend 40,0")),
            doubts,
        )
    };
    // Up to a deviation of 0.001 mm, the circle is drilled.
    for (diameter, is_doubtful) in
        [("3", false), ("3.001", false), ("3.002", true), ("3.05", true), ("3.051", false)]
    {
        assert_eq!(circle(diameter, MACHINE).len(), usize::from(is_doubtful), "{diameter}");
    }
    assert_eq!(circle("3.05", MACHINE), ["PB118 "]);
    assert_eq!(circle("3.05", DoubtThresholds { hole_margin: 0.04, ..MACHINE }), [""; 0]);
    assert_eq!(circle("3.002", DoubtThresholds { hole_margin: 0.0, ..MACHINE }), [""; 0]);
}

/// Returns the findings about a ring of lines in which statements are replaced.
fn ring(start: &str, change: (&str, &str)) -> Vec<String> {
    let ring = "mill 0,0 40,0\nmill 40,0 40,30\nmill 40,30 0,30\nmill 0,30 0,0\nend 0,0";
    findings(&path(start, &ring.replacen(change.0, change.1, 1)), MACHINE)
}

#[test]
fn an_outline_that_has_lost_its_bars_is_doubtful() {
    const BARS: &str = "T5 O2 I1 B-0.3 D2 P3 U15";
    let unchanged = ("mill", "mill");
    assert_eq!(ring(BARS, unchanged), ["PB212 "]);
    assert_eq!(ring("T5 O2 I1 B0 D2 P3", unchanged), ["PB212 "]);
    assert_eq!(ring("T5 O2 I1 B0 D2 U15", unchanged), ["PB212 "]);
    for (start, change) in [
        ("T5 O2 I1 B-0.3 D2", unchanged),
        ("T5 O2 I1 B0.1 D2 P3 U15", unchanged),
        (BARS, ("mill", "bars")),
        (BARS, ("mill 0,0 40,0", "mill 0,0 40,0 \"B0.5\"")),
        (BARS, ("mill 0,0 40,0", "mark 0,0 40,0 \"D4.8\"")),
        (BARS, ("mill 0,0 40,0", "sweep 0,0 40,0")),
        (BARS, ("mill 0,30 0,0\nend 0,0", "mill 0,30 0,2.1\nend 0,2.1")),
    ] {
        let found = ring(start, change);
        assert!(!found.contains(&"PB212 ".to_owned()), "{start} {change:?}: {found:?}");
    }
}

/// Among the outlines are a disc that is cut out along arcs, and an outline with a gap that the cutter closes.
#[test]
fn rims_that_have_lost_their_bars_are_doubtful() {
    const BARS: &str = "T5 O2 I1 B-0.3 D2 P3 U15 A50";
    let found = |start: &str, drawn: &str| findings(&path(start, drawn), MACHINE);
    let arcs = "mill arc 0,0 to 40,0 centre 20,0\nmill arc 40,0 to 0,0 centre 20,0\nend 0,0";
    assert_eq!(found(BARS, arcs), ["PB212 "]);
    let open = |gap: f64| found(BARS, &format!("mill 0,0 40,0 40,30 0,30 0,{gap}\nend 0,{gap}"));
    assert_eq!(open(2.09), ["PB212 "]);
    assert_eq!(open(2.11), [""; 0]);
    // The last line runs over the first one, or ends in its middle.
    assert_eq!(found(BARS, "mill 0,0 25,0 25,20 -5,20 -5,0 10,0\nend 10,0"), ["PB212 "]);
    let t_joint = |end: f64| found(BARS, &format!("mill 0,0 30,0 30,20 10,20 10,{end}\nend 10,{end}"));
    assert_eq!(t_joint(0.0), ["PB212 "]);
    assert_eq!(t_joint(2.09), ["PB212 "]);
    assert_eq!(t_joint(2.11), [""; 0]);
    // Lines that cross at the corners, near one end of each.
    let crossing = |last: &str| {
        let lines = "mill 0,0 0,90\nsweep 0,90 -1,20\nmill -1,20 90,20\nsweep 90,20 21,21\nmill 21,21 21,-90";
        found(BARS, &format!("{lines}\nsweep 21,-90 22,0\nmill {last}"))
    };
    assert_eq!(crossing("22,0 -90,0\nend -90,0"), ["PB212 "]);
    assert_eq!(crossing("22,0 2.2,0\nend 2.2,0"), [""; 0]);
    // The tool mills in both directions, along lines so close that nothing is left between them.
    assert_eq!(found(BARS, "mill 0,0 40,0 40,1.9 0,1.9\nend 0,1.9"), [""; 0]);
    assert_eq!(found(BARS, "mill 0,0 1.5,0\nend 1.5,0"), [""; 0]);
}

#[test]
fn bars_are_thicker_than_nothing() {
    let bars = |start: &str, text: &str| {
        findings(&path(start, &format!("bars 0,0 40,0{text}\nbars 40,0 40,30\nend 40,30")), MACHINE)
    };
    for (top, is_doubtful) in [("-0.2", true), ("0", true), ("0.09", true), ("0.1", false), ("1", false)] {
        let found = bars(&format!("T5 O2 I1 B-0.3 D{top} P3 U9"), "");
        assert_eq!(found.len(), usize::from(is_doubtful), "{top}: {found:?}");
        assert!(found.iter().all(|found| found.starts_with("PB211")), "{top}: {found:?}");
    }
    assert_eq!(bars("T5 O2 I1 B-0.3 D1 P3 U9", " \"D0.05\"").len(), 1);
    assert_eq!(bars("T0.1 O2 I0.05 B-0.3 D0.05 P3 U9", ""), [""; 0], "half of a foil");
}

#[test]
fn the_first_depth_lies_in_the_material_of_the_chain() {
    for (first, is_doubtful) in [("W5", false), ("W5.01", true), ("W1", false), ("W0.99", true)] {
        let codes = line(&format!("T5 O2 I1 B1 {first}"), "");
        assert_eq!(codes.len(), usize::from(is_doubtful), "{first}: {codes:?}");
    }
    assert_eq!(line("T5 O2 I1 B1", "W6"), ["PB211 W6"]);
    // W applies to the whole chain, so it is compared with the lowest bottom of all segments, B1.
    let deeper = path("T5 O2 I1 B3 W1", "mill 0,0 20,0\nmill 20,0 40,0 \"B1\"\nend 40,0");
    let found = findings(&deeper, MACHINE);
    assert!(found.iter().all(|found| !found.contains("W1")), "{found:?}");
    let chains = "mill 0,0 10,0\nsweep 10,0 20,0\nmill 20,0 30,0\nend 30,0";
    assert_eq!(findings(&path("T5 O2 I1 B1 W9", chains), MACHINE), ["PB211 "], "the path's is said once");
}

/// The rapid move up to a higher segment, a mark or the bars breaks a slot cutter.
#[test]
fn a_slot_cutter_stays_at_its_depth() {
    let tool = |is_slot_cutter| PathTool {
        name: "a".into(),
        is_named: false,
        chip_load: None,
        cutting_length: None,
        is_slot_cutter,
        corner_radius: 0.0,
    };
    let doubts = |start: &str, second: &str, tool: Option<PathTool>| {
        let tools = PathTools::new(move |_, _| tool.clone());
        let drawing = path(start, &format!("mill 0,0 20,0\n{second}\nend 40,0"));
        all_codes(&drawing, &Language { tools, ..language() })
    };
    let start = "T5 O2 I1 B1 D2 P3 U9 W4";
    for (second, rises) in [
        ("mill 20,0 40,0", false),
        ("mill 20,0 40,0 \"B1.01\"", true),
        ("mill 20,0 40,0 \"B0.9\"", true),
        ("mark 20,0 40,0 \"D4\"", true),
        ("bars 20,0 40,0", true),
    ] {
        let expected = Vec::from_iter(rises.then_some("PB211"));
        assert_eq!(doubts(start, second, None), expected, "{second}");
        assert_eq!(doubts(start, second, Some(tool(true))), expected, "{second}");
        assert_eq!(doubts(start, second, Some(tool(false))), [""; 0], "{second}");
        assert_eq!(doubts(&start.replace(" W4", ""), second, None), [""; 0], "{second}");
    }
}

#[test]
fn a_first_depth_without_a_chain_has_no_effect() {
    let codes = |statements: &str| {
        let compiled = compile(&path("T5 O2 I1 B0 P3 W4", statements));
        compiled.found.iter().map(|found| found.code().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(codes("circle 0,0 d 2\nsweep 0,0 20,0\ncircle 20,0 d 2\nend 20,0"), ["PB210"]);
    assert_eq!(codes("circle 0,0 d 2\nmill 0,0 20,0\nend 20,0"), [""; 0]);
}

/// Returns the texts of the letters that are reported as without effect.
fn without_effect(drawing: &str) -> Vec<String> {
    let found = compile(drawing).found.into_iter().filter(|found| found.code().to_string() == "PB210");
    let text = found.filter_map(|found| found.text);
    text.map(|it| it.text[it.start as usize..it.end as usize].to_owned()).collect()
}

/// Embedded paths keep their own values, so those of a path that only embeds others hold for nothing.
#[test]
fn letters_of_cuts_have_no_effect_in_a_path_that_only_embeds() {
    const EMBEDDING: &str = "subpath 0,0 40,0 \">2050.1P\"\n";
    let found = |start: &str, statements: &str| {
        without_effect(&path(&format!("T5 O2 Mx {start}"), &format!("{EMBEDDING}{statements}")))
    };
    for letter in ["A9", "B1", "C1", "D1", "F99", "I1", "P3", "U9", "W1", "Z50"] {
        assert_eq!(found(letter, "end 40,0"), [letter]);
        assert_eq!(found(letter, "mill 40,0 80,0 \"B1\"\nend 80,0"), [""; 0], "{letter}");
    }
    assert_eq!(found("S20 E2050 Ra", "end 40,0"), [""; 0]);
    assert_eq!(found("F99 I1 W1", "circle 40,0 d 2 \"B1\"\nend 40,0"), ["W1"], "the path drills a hole");
    // Z of a Z-probe is F of the path if nothing else gives it.
    assert_eq!(found("F99 Z50 I1", "probe 20,20\nend 40,0"), ["I1"]);
    let without_subpath = path("T5 O2 I1 F99", "sweep 0,0 40,0\nend 40,0");
    assert_eq!(without_effect(&without_subpath), [""; 0]);
    // A DASHDOT line that names no path may be meant as a cut.
    assert_eq!(without_effect(&path("T5 O2 I1", "subpath 0,0 40,0 \"2050.1P\"\nend 40,0")), [""; 0]);
    // The letters may be meant for the path that borrows them.
    let borrowed = |text: &str| {
        let lender = path("T5 O2 B1 I1 F99", &format!("{EMBEDDING}end 40,0"));
        without_effect(&format!("{lender}\nlayer 1234.2P\nstart 0,50 \"{text}\"\nmill 0,50 40,50\nend 40,50"))
    };
    assert_eq!(borrowed("@1234.1P"), [""; 0]);
    assert_eq!(borrowed("T5 O2 B1 I1"), ["B1", "F99", "I1"]);
    // A line of an unknown line type may be meant as a cut.
    let unclear = path("T5 O2 I1", &format!("{EMBEDDING}line \"UNKNOWN\" 40,0 80,0\nend 80,0"));
    assert_eq!(without_effect(&unclear), [""; 0]);
}

#[test]
fn a_letter_without_effect_for_two_reasons_is_one_mistake() {
    let language = Language { doubts: MACHINE, ..language() };
    for letter in ["B1", "C1", "F-1"] {
        let raw = raw(&path(&format!("T5 O2 Mx {letter}"), "subpath 0,0 40,0 \">2050.1P\"\nend 40,0"));
        let problems = bind_leniently(&raw, &Bindings::check_values(&[]), &language).problems;
        assert_eq!(raw.findings_except(&problems).len() + problems.len(), 1, "{letter}");
    }
}

#[test]
fn a_nearer_element_of_another_kind_is_a_rival() {
    // The text is 0.7 mm away from the circle; the line is 0 to 3 mm away.
    let ring = "mill 0,0 17,0\ncircle 20,0 d 6";
    let at = |y: f64, string: &str| {
        texts(&format!("{ring}\ntext 16.3,{y} \"{string}\" height 1 align centre middle"), 0.1)
    };
    assert_eq!(at(0.0, "B3"), ["PB116"]);
    assert_eq!(at(0.5, "B3"), ["PB116"]);
    // The line does not take this letter, or is too far away from this text.
    let sweep = ring.replace("mill", "sweep");
    let text = "text 16.3,0 \"B3\" height 1 align centre middle";
    assert_eq!(texts(&format!("{sweep}\n{text}"), 0.1), [""; 0]);
    assert_eq!(texts(&format!("{}\n{text}", ring.replace("mill 0,0 17,0", "mill 0,3 17,3")), 0.1), [""; 0]);
    // The text is nearer to the circle than to the line.
    let inside = "text 19.9,0.2 \"B3\" height 1 align centre middle";
    assert_eq!(texts(&format!("mill 0,0 30,0\ncircle 20,0.2 d 6\n{inside}"), 0.1), [""; 0]);
}

/// A path that is embedded twice in the same place is milled twice. The tool sweeps back between the two.
#[test]
fn a_path_is_embedded_once_at_a_place() {
    let with = |second: &str| {
        let statements = format!(
            "subpath 0,0 20,0 \">1111.1P N1\"\nsweep 20,0 20,9 0,9 0,0\nend 20,0\n\
             layer 1234.1P~A\nsubpath 0,0 20,0 \"{second} N9999\""
        );
        codes(&compile(&path("T5 O3", &statements)).found)
    };
    assert_eq!(with(">1111.1P"), ["PB121"]);
    // The walk runs back along the second segment at once.
    let statements = "subpath 0,0 20,0 \">1111.1P\"\nend 0,0\nlayer 1234.1P~A\nsubpath 0,0 20,0 \">1111.1P\"";
    assert_eq!(codes(&compile(&path("T5 O3", statements)).found), ["PB121"]);
    assert_eq!(with(">1111.2P"), [""; 0], "another path");
    assert_eq!(with(">1111.1P H0.01"), [""; 0], "higher");
    assert_eq!(with(">1111.1P :A5"), [""; 0], "with another value");
}

#[test]
fn each_probe_has_a_place_and_a_name_of_its_own() {
    let two = |one: &str, other: &str| {
        let statements = format!("mill 0,0 40,0\nend 40,0\nprobe {one}\nprobe {other}");
        codes(&compile(&path("T5 O3 I1 B0", &statements)).found)
    };
    assert_eq!(two("10,10 \"LA\"", "20,10 \"LB\""), [""; 0]);
    assert_eq!(two("10,10", "20,10"), [""; 0]);
    assert_eq!(two("10,10 \"LA\"", "20,10 \"LA\""), ["PB211"]);
    assert_eq!(two("10,10", "10,10"), ["PB121"]);
    assert_eq!(two("10,10 \"LA\"", "10.001,10 \"LB\""), [""; 0]);
}
