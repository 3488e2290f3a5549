//! Tests elements that are drawn for a path but do not belong to it: PB119 and PB120.

use pathbuild_diagnostic::{Lang, Point};
use pathbuild_dxf::{Drawing, Options, Units};
use pathbuild_path::{Language, LayerPattern, PartSettings, may_be_stray_text, stray_findings};
use pathbuild_testkit::sheet;

use crate::support::{codes, language};

fn drawn(drawing: &str) -> Drawing {
    let sheet = sheet(drawing).unwrap_or_else(|faults| panic!("{faults:?} in\n{drawing}"));
    let options = Options {
        keep_layer: &|_| true,
        note_text: None,
        units: Units::Header,
        approximate_curves: 0.0,
        max_entities: 10_000,
        max_text: 65_536,
        compatible: false,
    };
    pathbuild_dxf::read(&sheet.to_dxf(), &options)
}

/// Returns the codes for a path with a groove and a hole, and elements on other layers.
fn strays(others: &str) -> Vec<String> {
    strays_with("mill 0,0 40,0\nsweep 40,0 60,0\nmark 60,0 80,0 \"D4\"\nend 80,0", others)
}

fn strays_with(path: &str, others: &str) -> Vec<String> {
    let drawing = format!("layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 D4\"\n{path}\n{others}");
    let language = Language { keep_out: LayerPattern::new("Clamps.*").ok(), ..language() };
    codes(&stray_findings(&drawn(&drawing), &language))
}

fn text(layer: &str, string: &str, at: &str) -> String {
    format!("layer \"{layer}\"\ntext {at} \"{string}\" height 2 align centre middle")
}

#[test]
fn a_parameter_text_over_an_element_on_another_layer_has_no_effect() {
    for string in ["B2", "F120 B-0.3", "B2,5", "I0.5", "W4", "N1 B2", "B=D", " B2 ", "B2 Qgroove"] {
        assert_eq!(strays(&text("Notes", string, "20,0")), ["PB119"], "{string}");
    }
    // On the layer of the path, the other letters are errors or have no effect.
    for string in ["B1 D1.5", "B1 C1", "B1 S20", "B1 T2", "I0.5 U12"] {
        assert_eq!(strays(&text("Notes", string, "20,0")), ["PB119"], "{string}");
    }
    for mistyped in [
        "b2",
        "B 2",
        "B 0,5",
        "b  0.5",
        "B1,F100",
        "b1, f 100",
        "B1;F100",
        "n1 b2",
        "B1mm",
        "B 1 mm",
        "B1mm F100",
        "B:1",
        "B = 1",
        "B=1",
        "B0.5F120",
        "I1B0.5",
        "B\u{2212}1",
        "B\u{2013}0.2",
        "B1/F100",
        "B1 (F100)",
        "(B1)",
        "'B1'",
        "B1\u{a0}F100",
        "B1 - F100",
        "B1 F100!",
        "%%uB1",
        "%%OB1%%O",
        "B - 0.5",
        "B- 0.5",
        "B1.F100",
        "B1+F100",
        "B1 & F100",
        "B 1F 100",
        "b1f100",
        "F100 mm/min",
        "F100/min",
        "B1 mm, F100 mm/min",
        "B1.5.",
        "B1 mm.",
        "„B1“",
    ] {
        assert_eq!(strays(&text("Notes", mistyped, "20,0")), ["PB119"], "{mistyped}");
    }
    for string in [
        "R5",
        "M6",
        "Maßstab",
        "B",
        "Bohrung",
        "N1",
        "B2 x",
        "B2 >1",
        "D1",
        "P3",
        "B2x4",
        "T5",
        "Qgroove",
        "S20",
        "D1 T2",
        "b",
        "B 2 m",
        "B2 (tief)",
        "(B)",
        "1mm",
        "B1 - 2",
        "B, 2",
        "ab 2",
        "b2 tief",
        "F",
        "n 3",
        "d 5",
        "B2x4F",
        "2B3",
        "R5F",
        "D8",
        "D8H7",
        "B1-3",
        "F - Seite",
        "B. 3",
        "i.O.",
        "Freistich F 1x0.2",
        "F100 m/min",
        "Raum B1",
    ] {
        assert_eq!(strays(&text("Notes", string, "20,0")), [""; 0], "{string}");
    }
}

#[test]
fn only_an_element_without_a_text_that_would_get_it_counts() {
    let note = |at: &str| strays(&text("Notes", "F50", at));
    assert_eq!(note("20,0"), ["PB119"]);
    assert_eq!(note("20,1.5"), ["PB119"]);
    // Its circle has a radius of 2.06 mm.
    assert_eq!(note("20,4.1"), ["PB119"], "it misses the line by less than that");
    assert_eq!(note("20,4.2"), [""; 0]);
    assert_eq!(note("70,3"), [""; 0], "the mark beside it has its text");
    assert_eq!(note("50,3"), [""; 0], "the sweep beside it knows no F");
    assert_eq!(note("50,0"), [""; 0], "a sweep knows no F");
    assert_eq!(note("70,0"), [""; 0], "the mark has its text");
}

/// The cutter has 2 mm, so the smaller circle is drilled and takes no I, and the larger one is milled.
#[test]
fn the_cutter_decides_whether_a_circle_would_take_a_letter() {
    let circle = |diameter: u32| {
        let path = format!("mill 0,0 40,0\nsweep 40,0 60,0\nmill circle 60,0 d {diameter}\nend 60,0");
        strays_with(&path, &text("Notes", "I0.5", "60,2"))
    };
    assert_eq!(circle(4), ["PB119"]);
    assert_eq!(circle(2), [""; 0]);
}

#[test]
fn clamps_hidden_layers_and_layers_of_paths_are_excepted() {
    assert_eq!(strays(&text("Clamps 2", "B2", "20,0")), [""; 0]);
    assert_eq!(strays(&text("1234.1P", "B2", "20,0")), [""; 0]);
}

#[test]
fn texts_of_several_lines_count_as_well() {
    let mtext = |string: &str| format!("layer Notes\nmtext 20,0 \"{string}\" height 2 align middle centre");
    assert_eq!(strays(&mtext("B2")), ["PB119"]);
    assert_eq!(strays(&mtext("Deckel")), [""; 0]);
    for string in ["\\LB1\\l", "{\\LB1}", "\\OB1\\o", "{\\C1;B1}"] {
        assert_eq!(strays(&mtext(string)), ["PB119"], "{string}");
    }
}

#[test]
fn a_layer_that_is_nearly_a_path_s_is_named() {
    let circle = |layer: &str| strays(&format!("layer \"{layer}\"\ncircle 20,40 d 2"));
    for layer in [
        "1234.1P~A1",
        "1234.1P ~a",
        "1234.1PP",
        "1234.1p-2",
        "1234_1P~A1",
        "1234,1P",
        "1234.1P A",
        "1234.1P~Aß1",
        "12 34.1P",
        "1234-1P",
        "12341P",
        "1234.lP",
        "1234.1_P",
        "1234.1P_~A",
        "1234.1P alt",
        "1234.1P_neu",
        "1234.1P old",
        "1234.1P copy",
        "1234.1\u{420}",
        "1234.1P(2)",
        "1234\u{b7}1P",
        "\u{ff11}23\u{ff14}.1P",
        "1234.1",
        "Kopie von 1234.1P",
        "copy of 1234.1P",
        "alt_1234.1P",
        "1234.P",
        "124.1P",
    ] {
        assert_eq!(circle(layer), ["PB120"], "{layer}");
    }
    for layer in [
        "1234",
        "1234.1P (23)x",
        "1234.1P Text",
        "Text 1234.1P",
        "12.1P",
        "1234.1P alter",
        "1235.1P alt",
        "alt",
        "1234.1PXYZ",
        "Kontur",
        "1235.1Q~A",
        "0",
        "1234.1P~A",
    ] {
        assert_eq!(circle(layer), [""; 0], "{layer}");
    }
}

#[test]
fn a_layer_is_named_once_however_much_is_on_it() {
    let other = "layer \"1234.1P~A1\"\ncircle 20,40 d 2\nmill 0,40 20,40\ntext 20,0 \"B2\" height 2";
    assert_eq!(strays(other), ["PB120"]);
}

#[test]
fn elements_that_a_path_leaves_out_count_on_a_layer_with_a_similar_name() {
    for element in ["ellipse centre 20,40 major 5,0 ratio 0.5", "spline control 0,40 10,50 20,40 30,50"] {
        assert_eq!(strays(&format!("layer \"1234.1PP\"\n{element}")), ["PB120"], "{element}");
        assert_eq!(strays(&format!("layer Notes\n{element}")), [""; 0], "{element}");
        assert_eq!(strays(&format!("layer \"1234.1PP\"\ncircle 20,40 d 2\n{element}")), ["PB120"]);
    }
}

/// The templates keep a circle of a probe on a layer of their own, where a copy may be left.
#[test]
fn a_probe_with_a_text_on_another_layer_is_told() {
    let probe = |string: &str, diameter: &str, at: &str| {
        strays(&format!(
            "layer markers PHANTOM\ncircle BYLAYER 20,40 d {diameter}\n{}",
            text("markers", string, at)
        ))
    };
    for string in ["LA", "T2.5", "L1 H3"] {
        assert_eq!(probe(string, "6", "20,43"), ["PB119"], "{string}");
    }
    assert_eq!(probe("LA", "6", "20,46"), [""; 0], "the text is beside the circle");
    assert_eq!(probe("LA", "6.01", "20,43"), [""; 0]);
    assert_eq!(probe("probe", "6", "20,43"), [""; 0]);
    assert_eq!(
        strays(&format!("layer x PHANTOM\ncircle BYLAYER 20,40 d 6\n{}", text("y", "LA", "20,43"))),
        [""; 0]
    );
}

#[test]
fn the_text_of_a_probe_on_another_layer_has_no_effect() {
    let probe = |own: &str, string: &str, at: &str| {
        let path = format!("mill 0,0 40,0\nend 40,0\nprobe 20,40{own}");
        strays_with(&path, &text("Notes", string, at))
    };
    for string in ["T1.5", "LA T1.5", "H1", "LA"] {
        assert_eq!(probe("", string, "20,43"), ["PB119"], "{string}");
    }
    assert_eq!(probe("", "T1.5", "20,46"), [""; 0], "the text is beside the circle");
    assert_eq!(probe(" \"T2\"", "T1.5", "20,43"), [""; 0], "the probe has its text");
    assert_eq!(probe("", "probe", "20,43"), [""; 0]);
    assert_eq!(probe("", "F100", "20,43"), [""; 0], "a probe knows no F");
}

#[test]
fn a_layer_that_begins_with_a_path_s_name_and_holds_parameters_is_named() {
    let hole = |layer: &str, string: &str| {
        strays(&format!("layer \"{layer}\"\ncircle 20,40 d 3\ntext 20,40 \"{string}\" height 2"))
    };
    for layer in ["1234.1P holes", "1234.1P_BAK", "1234.1PABC", "1234.1P Bohrungen"] {
        assert_eq!(hole(layer, "B1"), ["PB120"], "{layer}");
        assert_eq!(hole(layer, "M6"), [""; 0], "{layer}");
    }
    for layer in ["1235.1P holes", "holes", "Notes 1234.1P"] {
        assert_eq!(hole(layer, "B1"), [""; 0], "{layer}");
    }
    // Without an element, the texts of such a layer are those of others.
    assert_eq!(strays(&text("1234.1P notes", "B1", "20,0")), ["PB119"]);
    assert_eq!(strays(&text("1234.1P notes", "B1", "20,40")), [""; 0]);
}

/// The preliminary test of undecoded bytes must not miss these texts.
#[test]
fn the_first_look_at_bytes_is_certain() {
    for text in [
        "B2",
        "F120 B-0.3",
        " B2",
        "B=D",
        "N1 B.5",
        "{\\fArial|b0|i0;B2}",
        "N1\\PB2",
        "Z25",
        "{\\fArial;Z2.5}",
        "b2",
        "z25",
        "B 2",
        "b  0,5",
        "x,F100",
        "LA",
        "T2.5",
        "L1 T=d H.5",
        "LABCDEFGHIJKLMNOPQRSTUVW",
        "%%uB1",
        "\\LB1\\l",
        "{\\OB1}",
        "B:1",
        "B = 1",
        "B\u{2212}1",
        "B\\U+22121",
        "B - 0.5",
        "N1B2",
        "1.5B2",
    ] {
        assert!(may_be_stray_text(text.as_bytes()), "{text}");
    }
    for text in [
        "R5",
        "M6",
        "Maßstab 1:1",
        "AB2",
        ">1234.1P :D0.5",
        "\\W0.8;Text",
        "{\\fArial|b0|i0|c0;Text}",
        "Bohrung",
        "Tief 2",
        "b ",
        "z",
        "L",
        "Links",
        "T",
        "LA and more",
        "LABCDEFGHIJKLMNOPQRSTUVWX",
        "",
    ] {
        assert!(!may_be_stray_text(text.as_bytes()), "{text}");
    }
}

/// Returns the findings about a drawing with layers other than those of paths.
fn strays_beside(keep_out: &str, part: Option<&str>, others: &str) -> Vec<String> {
    let drawing = format!("layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n{others}");
    let part = part.map(|pattern| PartSettings {
        pattern: LayerPattern::new(pattern).expect("a pattern"),
        tolerance: 0.01,
        is_held_otherwise: false,
    });
    let language = Language { keep_out: LayerPattern::new(keep_out).ok(), part, ..language() };
    codes(&stray_findings(&drawn(&drawing), &language))
}

#[test]
fn a_layer_that_keep_out_nearly_matches_is_named() {
    let circle = |keep_out: &str, layer: &str| {
        strays_beside(keep_out, None, &format!("layer \"{layer}\"\ncircle 20,40 d 9"))
    };
    for (keep_out, layer) in [
        ("Clamps", "Clamps 1"),
        ("Clamps", "Clamps0"),
        ("Clamps", "Clamp"),
        ("Clamps", "Clamps~A"),
        ("Clamps", "clamps_1"),
        ("Clamp", "Clamps"),
        ("Clamps|Vise", "Vises"),
        ("Spanneisen", "Spann eisen"),
        ("Spannmittel", "Spаnnmittel"),
        ("Clamps", "Сlamps"),
        ("Klamps", "\u{212a}lamp"),
        ("X?Clamps", "Clamp"),
        ("X{0,1}Clamps", "Clamp"),
        ("Xs*|Clamps", "Clamp"),
        ("[CK]lamps", "Clamp"),
        ("Clamps", "Clamps old"),
        ("Clamps", "Clamps_COPY"),
        ("Clamps", "Clamps (alt)"),
        ("Clamps", "Clmaps"),
        ("Clamps", "Clmps"),
        ("CLAX", "CLA"),
        ("Clamps.*", "Clmps"),
        ("Clamps", "old Clamps"),
        ("Clamps", "Kopie von Clamps"),
    ] {
        assert_eq!(circle(keep_out, layer), ["PB120"], "{keep_out} {layer}");
    }
    for (keep_out, layer) in [
        ("Clamps", "Clamps"),
        ("Clamps.*", "Clamps 1"),
        ("Clamps", "Clamps gold"),
        ("Clamps", "Clamps older"),
        ("Clamps", "old"),
        ("Clamps", "gold Clamps"),
        ("Clamps", "Clps"),
        ("CLA", "CL"),
        ("Clamp.*", "Clamboards"),
        ("Clamps", "Calpms"),
        ("Clamps", "Frame"),
        ("Clamps", "0"),
        // A short name resembles too many others.
        ("CL", "CLX"),
        ("CLA", "CLAX"),
    ] {
        assert_eq!(circle(keep_out, layer), [""; 0], "{keep_out} {layer}");
    }
}

#[test]
fn a_layer_that_part_nearly_matches_is_named() {
    let circle = |layer: &str| {
        strays_beside("Clamps", Some("Outline"), &format!("layer \"{layer}\"\ncircle 20,40 d 9"))
    };
    assert_eq!(circle("Outlines"), ["PB120"]);
    assert_eq!(circle("Kopie von Outline"), ["PB120"]);
    assert_eq!(circle("Outlin"), ["PB120"]);
    assert_eq!(circle("Outline"), [""; 0]);
    assert_eq!(circle("Contours"), [""; 0]);
    // The number that the pattern requires is forgotten.
    let numbered = |layer: &str| {
        strays_beside(
            "Clamps",
            Some("Part ([0-9_]+)"),
            &format!("layer \"{layer}\"\npolyline 0,40 9,40 9,49 closed"),
        )
    };
    assert_eq!(numbered("Part"), ["PB120"]);
    assert_eq!(numbered("Part 1234_1"), [""; 0]);
    // The space before the number is forgotten.
    assert_eq!(numbered("Part1234_1"), ["PB120"]);
    assert_eq!(numbered("Plate1234_1"), [""; 0]);
    assert_eq!(numbered("Plates"), [""; 0]);
}

/// A polyline is one element, whatever the number of its pieces.
#[test]
fn a_polyline_on_a_nearly_named_layer_counts_once() {
    let others = "layer 1234.1PX\npolyline 0,40 9,40 9,49 closed\npolyline 20,40 29,40\nline 0,60 9,60\nline 0,70 9,70";
    let drawing = format!("layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n{others}");
    let found = stray_findings(&drawn(&drawing), &language());
    let elements = found[0].arguments.iter().find(|(name, _)| *name == "elements").expect("elements");
    assert_eq!(elements.1.render(Lang::En), "2 LINE, 2 LWPOLYLINE");
}

#[test]
fn a_height_in_an_outline_on_an_unread_layer_is_told() {
    let clamp =
        |layer: &str, text: &str, at: &str| format!("layer {layer}\ncircle 20,40 d 9\ntext {at} \"{text}\"");
    let found = |others: &str| strays_beside("Clamps", Some("Outline"), others);
    assert_eq!(found(&clamp("Vise", "Z25", "20,40")), ["PB119"]);
    assert_eq!(found(&clamp("Clamps", "Z25", "20,40")), [""; 0]);
    assert_eq!(found(&clamp("Outline", "Z25", "20,40")), [""; 0]);
    assert_eq!(found(&clamp("Vise", "Z25", "20,60")), [""; 0], "outside of the outline");
    for text in ["z25", "Z25mm", "Z = 25", "Clamp Z25", "Z25 (Pratze 2)"] {
        assert_eq!(found(&clamp("Vise", text, "20,40")), ["PB119"], "{text}");
    }
    for text in ["Z25 Z1", "Z25 B1", "Z-25", "Z", "Clamp 25", "Zone 25"] {
        assert_eq!(found(&clamp("Vise", text, "20,40")), [""; 0], "{text} is no height");
    }
    let open = "layer Vise\nline 10,40 20,40 20,50\ntext 15,40 \"Z25\"";
    assert_eq!(found(open), [""; 0]);
    // There is one finding for each layer, and none about the layer's name in addition.
    let two = format!("{}\ncircle 60,40 d 9\ntext 60,40 \"Z30\"", clamp("Vise", "Z25", "20,40"));
    assert_eq!(found(&two), ["PB119"]);
    assert_eq!(found(&clamp("Clamp", "Z25", "20,40")), ["PB120"]);
    // Without `keep-out`, no layer contains clamps.
    assert_eq!(strays_beside("(", None, &clamp("Vise", "Z25", "20,40")), [""; 0]);
}

/// Returns a multileader on this layer whose arrow points at (20, `y`) from (26, 8).
fn multileader(layer: &str, text: &str, y: f64) -> String {
    format!(
        "raw\n0 MULTILEADER\n5 AA\n8 {layer}\n100 AcDbMLeader\n300 CONTEXT_DATA{{\n40 1\n10 28\n20 8\n30 0\n41 2\n304 {text}\n12 28\n22 8\n\
         302 LEADER{{\n290 1\n10 26\n20 8\n30 0\n304 LEADER_LINE{{\n10 20\n20 {y}\n30 0\n305 }}\n303 }}\n301 }}\n41 0.36\nendraw"
    )
}

fn dimension(layer: &str, text: &str) -> String {
    format!(
        "raw\n0 DIMENSION\n5 AA\n8 {layer}\n2 *D1\n10 0\n20 3\n11 20\n21 3\n1 {text}\n13 0\n23 0\n14 40\n24 0\nendraw"
    )
}

#[test]
fn a_multileader_or_dimension_gives_no_parameters() {
    for text in ["B2.5", "b2,5", "{\\fArial|b0|i0;B2.5}", "F120 B-0.3"] {
        assert_eq!(
            strays(&multileader("1234.1P", text, 30.0)),
            ["PB119"],
            "{text}: wherever the arrow points"
        );
        assert_eq!(strays(&dimension("1234.1P", text)), ["PB119"], "{text}");
        assert_eq!(strays(&multileader("Notes", text, 0.2)), ["PB119"], "{text}");
        assert_eq!(strays(&multileader("Notes", text, 2.1)), [""; 0], "{text}: the arrow points at nothing");
        assert_eq!(strays(&dimension("Notes", text)), [""; 0], "{text}");
        assert_eq!(strays(&multileader("Clamps", text, 0.2)), [""; 0], "{text}");
    }
    for text in ["", "<>", "25", "25 H7", "groove B2.5", "S20", "R5", "deep"] {
        assert_eq!(strays(&multileader("1234.1P", text, 0.2)), [""; 0], "{text}");
        assert_eq!(strays(&dimension("1234.1P", text)), [""; 0], "{text}");
    }
    // A text of the path that says the same is what counts.
    let with = |text: &str| {
        strays_with(&format!("mill 0,0 40,0 \"{text}\"\nend 40,0"), &multileader("1234.1P", "B2.5", 0.0))
    };
    assert_eq!(with("B2.5"), [""; 0]);
    assert_eq!(with("B2"), ["PB119"]);
    let path = "mill 0,0 40,0 \"B2\"\nend 40,0";
    assert_eq!(strays_with(path, &multileader("Notes", "B2.5", 0.0)), [""; 0], "the line has a text");
}

#[test]
fn a_label_names_its_kind_and_place() {
    let drawing = format!(
        "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n{}",
        multileader("1234.1P", "B2.5", 0.0)
    );
    let found = stray_findings(&drawn(&drawing), &language());
    let [found] = &found[..] else { panic!("{found:?}") };
    assert_eq!(found.place.point, Some(Point::new(20.0, 0.0)));
    assert!(
        found.text(Lang::En).starts_with("the text \"B2.5\" of this MULTILEADER has no effect"),
        "{found:?}"
    );
}
