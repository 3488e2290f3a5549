//! Tests which element each text is assigned to. (book: language/parameter-texts)

use pathbuild_path::{Curve, RawPath, Shape};

use crate::support::{codes, raw, read};

/// Reads a path whose start, end and their texts are far from everything else.
fn drawing(statements: &str) -> RawPath {
    raw(&format!("layer 1234.1P\nstart 500,0 \"T5 O3 I1 B0 D2\"\nend 500,90\n{statements}"))
}

/// Returns the elements in the order of segments, with their texts.
fn owners(statements: &str) -> Vec<String> {
    let raw = drawing(statements);
    let found = codes(&raw.diagnostics).into_iter().filter(|code| code != "PB116");
    assert_eq!(found.collect::<Vec<_>>(), [""; 0], "{statements}");
    let owner = |element: &pathbuild_path::Element| {
        let text = raw.drawn.text(element.text).map_or("-", |text| text.as_str());
        let shape = match element.shape {
            Shape::Circle { .. } => "circle",
            Shape::Curve(Curve::Line(_)) => "line",
            Shape::Curve(Curve::Arc(_)) => "arc",
        };
        format!("{shape} {text}")
    };
    raw.drawn.elements.iter().map(owner).collect()
}

fn finds(statements: &str, text: &str) -> bool {
    !codes(&drawing(&format!("{statements}\n{text}")).diagnostics).contains(&"PB107".to_owned())
}

/// Returns a text of four characters with a height of 2 mm, whose circle has its centre at this point and a radius of 2.6 mm.
fn text(at: &str, string: &str) -> String {
    assert_eq!(string.len(), 4);
    format!("text {at} \"{string}\" height 2 align centre middle")
}

/// Returns a text whose circle has its centre at this point and a radius of exactly 1.4 mm.
fn mtext(at: &str, string: &str) -> String {
    assert!(string.len() >= 2);
    format!("mtext {at} \"{string}\" height 2 align middle centre")
}

#[test]
fn a_circle_comes_before_an_arc_and_an_arc_before_a_line() {
    let (line, arc, circle) =
        ("mill 0,0 40,0", "mill arc centre 20,0 r 10 from 0 to 180", "circle 20,18 d 12");
    let at = text("20,10.5", "F100");
    assert_eq!(owners(&format!("{line}\n{arc}\n{circle}\n{at}")), ["circle F100", "line -", "arc -"]);
    let near_the_line = "mill 0,10.4 40,10.4";
    assert_eq!(owners(&format!("{near_the_line}\n{arc}\n{at}")), ["line -", "arc F100"]);
    assert_eq!(owners(&format!("{near_the_line}\n{at}")), ["line F100"]);
}

/// The text belongs to the element with the nearest centre, even if it overlaps a larger circle more.
#[test]
fn the_nearest_circle_is_that_of_the_nearest_centre() {
    let circles = "circle 0,0 d 20\ncircle 16,0 d 12";
    assert_eq!(owners(&format!("{circles}\n{}", text("8.1,3", "F100"))), ["circle -", "circle F100"]);
    assert_eq!(owners(&format!("{circles}\n{}", text("7.9,3", "F100"))), ["circle F100", "circle -"]);
}

#[test]
fn the_nearest_arc_or_line_is_that_of_the_least_distance() {
    let lines = "mill 0,0 40,0\nmill 0,3 40,3";
    assert_eq!(owners(&format!("{lines}\n{}", text("20,1.4", "F100"))), ["line F100", "line -"]);
    assert_eq!(owners(&format!("{lines}\n{}", text("20,1.6", "F100"))), ["line -", "line F100"]);
    let arcs = "mill arc centre 0,0 r 10 from 0 to 180\nmill arc centre 0,0 r 13 from 0 to 180";
    assert_eq!(owners(&format!("{arcs}\n{}", text("0,11.4", "F100"))), ["arc F100", "arc -"]);
    assert_eq!(owners(&format!("{arcs}\n{}", text("0,11.6", "F100"))), ["arc -", "arc F100"]);
}

/// Only the distance matters, not the lengths of the lines.
#[test]
fn long_lines_are_as_near_as_short_ones() {
    let lines = "mill 0,0 400,0\nmill 190,3 210,3";
    assert_eq!(owners(&format!("{lines}\n{}", text("200,1.4", "F100"))), ["line F100", "line -"]);
}

#[test]
fn a_tie_goes_to_the_first_in_the_file() {
    let between = text("20,1", "F100");
    assert_eq!(owners(&format!("mill 0,0 40,0\nmark 0,2 40,2\n{between}")), ["line F100", "line -"]);
    assert_eq!(owners(&format!("mark 0,2 40,2\nmill 0,0 40,0\n{between}")), ["line F100", "line -"]);
    assert_eq!(owners(&format!("circle 16,1 d 8\ncircle 24,1 d 8\n{between}")), ["circle F100", "circle -"]);
    // The order of segments is circles, lines, arcs, but texts are assigned before the segments are ordered.
    assert_eq!(
        owners(&format!("mill 0,0 40,0\ncircle 20,90 d 8\nmark 0,2 40,2\n{between}"))[1..],
        ["line F100", "line -"]
    );
}

#[test]
fn circles_must_overlap() {
    let circle = "circle 50,50 d 8";
    assert!(finds(circle, &text("56.5999,50", "F100")));
    assert!(!finds(circle, &text("56.6001,50", "F100")));
    assert!(finds(circle, &text("50,50", "F100")));
    let circle = "circle 0,0 d 8";
    assert!(finds(circle, &mtext("5.399999,0", "F100")));
    assert!(!finds(circle, &mtext("5.4,0", "F100")), "circles that touch do not overlap");
}

#[test]
fn a_line_must_be_nearer_than_the_texts_radius() {
    let line = "mill 0,0 40,0";
    assert!(finds(line, &mtext("20,1.399999", "F100")));
    assert!(!finds(line, &mtext("20,1.4", "F100")));
    assert!(finds(line, &mtext("20,-1.399999", "F100")));
}

#[test]
fn a_text_finds_its_element_also_where_coordinates_are_large() {
    let line = "mill 900000.3,0 900000.3,40";
    assert!(finds(line, &mtext("900001.699999,20", "F100")));
    assert!(!finds(line, &mtext("900001.700001,20", "F100")));
    assert!(finds(line, &mtext("899998.900001,20", "F100")));
    assert!(!finds(line, &mtext("899998.899999,20", "F100")));
}

#[test]
fn an_arc_may_be_as_far_as_the_texts_radius() {
    let arc = "mill arc centre 0,0 r 1 from 0 to 180";
    assert!(finds(arc, &mtext("0,2.4", "F100")));
    assert!(!finds(arc, &mtext("0,2.400001", "F100")));
    // A text on the inside of the arc finds it as well.
    let arc = "mill arc centre 0,0 r 20 from 0 to 180";
    assert!(finds(arc, &mtext("0,18.600001", "F100")));
    assert!(!finds(arc, &mtext("0,18.599999", "F100")));
}

#[test]
fn the_foot_of_the_perpendicular_lies_on_the_line() {
    let line = "mill 0,0 40,0";
    for (x, is_found) in [("0", true), ("-0.001", false), ("40", true), ("40.001", false)] {
        assert_eq!(finds(line, &mtext(&format!("{x},1"), "F100")), is_found, "{x}");
    }
}

#[test]
fn the_projection_lies_on_the_arc() {
    for arc in ["mill arc centre 0,0 r 10 from 0 to 90", "mill arc centre 0,0 r 10 from 90 to 0 cw"] {
        for (at, is_found) in
            [("10.5,0.001", true), ("10.5,-0.001", false), ("0.001,10.5", true), ("-0.001,10.5", false)]
        {
            assert_eq!(finds(arc, &mtext(at, "F100")), is_found, "{arc} {at}");
        }
    }
    assert!(
        finds("mill arc centre 0,0 r 10 from 0 to 90", &mtext("10.5,0", "F100")),
        "the arc's start is on it"
    );
    let across_zero = "mill arc centre 0,0 r 10 from 270 to 90";
    assert!(finds(across_zero, &mtext("10.5,0", "F100")));
    assert!(!finds(across_zero, &mtext("-10.5,0", "F100")));
}

#[test]
fn an_element_takes_one_text() {
    let lines = "mill 0,0 40,0\nmill 0,2 40,2";
    let texts = format!("{}\n{}", text("20,0.5", "F100"), text("20,0.6", "F200"));
    assert_eq!(owners(&format!("{lines}\n{texts}")), ["line F100", "line F200"]);
    assert_eq!(codes(&drawing(&format!("mill 0,0 40,0\n{texts}")).diagnostics), ["PB107"]);
}

/// Texts are assigned in file order, but single-line texts before all others.
#[test]
fn all_text_comes_before_all_mtext() {
    let (one, other) = (text("20,0.5", "F100"), mtext("20,0.5", "F200"));
    let lines = "mill 0,0 40,0\nmill 0,1.5 40,1.5";
    for texts in [format!("{one}\n{other}"), format!("{other}\n{one}")] {
        assert_eq!(owners(&format!("{lines}\n{texts}")), ["line F100", "line F200"]);
    }
    let (first, second) = (mtext("20,0.5", "F100"), mtext("20,0.5", "F200"));
    assert_eq!(owners(&format!("{lines}\n{second}\n{first}")), ["line F200", "line F100"]);
}

#[test]
fn markers_of_the_end_and_turns_and_hidden_lines_take_no_text() {
    for silent in ["line HIDDEN 0,0 40,0", "turn 20,0"] {
        assert!(!finds(silent, &text("20,0.5", "F100")), "{silent}");
        assert_eq!(
            owners(&format!("{silent}\nmill 0,1 40,1\n{}", text("20,0.4", "F100"))).last().unwrap(),
            "line F100"
        );
    }
    let raw = raw(&format!(
        "layer 1234.1P\nstart 500,0 \"T5 O3 I1 B0\"\nmill 0,9 40,9\nend 20,0\n{}",
        text("20,0.5", "F100")
    ));
    assert_eq!(codes(&raw.diagnostics), ["PB107"]);
}

/// The text of a DOT line is assigned but ignored, so that the line can be enabled again. The same is true of a DOT probe.
#[test]
fn skipped_elements_take_their_text() {
    assert_eq!(owners(&format!("skip 0,0 40,0\n{}", text("20,0.5", "%x9="))), ["line %x9="]);
    assert!(finds("mill 0,90 40,90\nprobe DOT 20,0", &text("20,0.5", "%x9=")));
}

/// Faulty elements take their text, so that the text is not reported as well.
#[test]
fn faulty_elements_take_their_text() {
    for faulty in ["line PHANTOM 0,0 40,0", "circle PHANTOM 20,0 d 9", "circle DASHED 20,0 d 9", "start 20,0"]
    {
        let raw = drawing(&format!("mill 0,90 40,90\n{faulty}\n{}", text("20,0.5", "F100")));
        let found = codes(&raw.diagnostics);
        assert!(found.len() == 1 && found[0] != "PB107", "{faulty}: {found:?}");
    }
}

#[test]
fn probes_and_the_start_take_texts() {
    let raw = raw(&format!(
        "layer 1234.1P\nstart 0,0\nend 90,90\nmill 90,0 90,90\nprobe 50,50\n{}\n{}",
        text("0,0.5", "T5O3"),
        text("50,50.5", "T4.5")
    ));
    assert_eq!(raw.drawn.text(raw.start.as_ref().unwrap().text).unwrap().as_str(), "T5O3");
    assert_eq!(raw.drawn.text(raw.probes[0].text).unwrap().as_str(), "T4.5");
}

#[test]
fn text_and_element_are_on_exactly_the_same_layer() {
    let on = |element: &str, label: &str| {
        let raw =
            drawing(&format!("layer {element}\nmill 0,0 40,0\nlayer {label}\n{}", text("20,0.5", "F100")));
        codes(&raw.diagnostics)
    };
    for layer in ["1234.1P", "1234.1P~A"] {
        assert_eq!(on(layer, layer), [""; 0]);
    }
    assert_eq!(on("1234.1P", "1234.1P~A"), ["PB107"]);
    assert_eq!(on("1234.1P~A", "1234.1P"), ["PB107"]);
    assert_eq!(on("1234.1P~A", "1234.1P~B"), ["PB107"]);
    // Layer names ignore case.
    assert_eq!(on("1234.1P~A", "1234.1P~a"), [""; 0]);
}

/// A text near two elements belongs to the one on its own tilde layer, even if the other is nearer.
#[test]
fn tilde_layers_keep_texts_apart() {
    let raw = drawing(&format!("mill 0,0 40,0\nlayer 1234.1P~A\nmill 0,2 40,2\n{}", text("20,0.1", "F100")));
    let texts: Vec<bool> = raw.drawn.elements.iter().map(|element| element.text.is_some()).collect();
    assert_eq!(texts, [false, true]);
}

#[test]
fn a_polylines_text_belongs_to_all_its_parts() {
    let polyline = "polyline CONTINUOUS 0,0 40,0 bulge 0.5 40,30 0,30";
    assert_eq!(
        owners(&format!("{polyline}\n{}", text("20,0.5", "F100"))),
        ["line F100", "line F100", "arc F100"]
    );
    let two = format!("{polyline}\npolyline CONTINUOUS 0,60 40,60 40,90\n{}", text("20,0.5", "F100"));
    assert_eq!(owners(&two), ["line F100", "line F100", "line -", "line -", "arc F100"]);
}

#[test]
fn a_text_without_element_names_the_nearest_and_how_far_it_is() {
    let raw = drawing(&format!("mill 0,0 40,0\n{}", text("20,4", "F100")));
    let [found] = raw.diagnostics.as_slice() else { panic!("{:?}", raw.diagnostics) };
    let lang = pathbuild_diagnostic::Lang::En;
    assert_eq!(
        found.text(lang),
        "the text \"F100\" belongs to no element: the circle around the text is at (20, 4) with a diameter of 5.2 mm"
    );
    let notes: Vec<String> = found.notes.iter().map(|note| note.text(lang)).collect();
    assert_eq!(notes, ["the nearest element is a line at (0, 0), 1.4 mm away from the text's circle"]);
}

/// The note says why the element under the text does not take it, and names no other element.
#[test]
fn a_text_on_an_element_that_takes_none_is_explained() {
    let notes = |silent: &str, at: &str| {
        let raw = drawing(&format!("mill 0,9 40,9\n{silent}\n{}", text(at, "F100")));
        let notes = raw.diagnostics.iter().flat_map(|found| &found.notes);
        notes.map(|note| note.text(pathbuild_diagnostic::Lang::En)).collect::<Vec<_>>().concat()
    };
    for (silent, start) in [
        ("line HIDDEN 0,0 40,0", "the HIDDEN element at (0, 0)"),
        ("turn 20,0", "the turn marker at (20, 0)"),
        ("end 20,0", "the end marker at (20, 0)"),
    ] {
        assert!(notes(silent, "20,2.5").starts_with(start), "{}", notes(silent, "20,2.5"));
        assert!(notes(silent, "20,-5").starts_with("the nearest element is a line at (0, 9)"), "{silent}");
        let elsewhere = format!("layer 1234.1P~A\n{silent}\nlayer 1234.1P");
        assert!(notes(&elsewhere, "20,2.5").starts_with("the nearest element is"), "{silent}");
    }
}

/// A start text belongs to the start marker, even if a HIDDEN sweep that begins there is nearer.
#[test]
fn a_start_text_beside_the_start_marker_is_not_for_a_hidden_sweep() {
    let note = |string: &str| {
        let text = mtext("10,1.2", string);
        let drawn =
            format!("layer 1234.1P\nstart 0,0\nline HIDDEN 0,0 40,0\nmill 40,0 40,60\nend 40,60\n{text}");
        let raw = raw(&drawn);
        let found = raw.diagnostics.iter().find(|found| found.code().to_string() == "PB107");
        found.expect("a text without element").notes[0].text(pathbuild_diagnostic::Lang::En)
    };
    assert!(
        note("O2 T5 I1").starts_with("the nearest element is a path start at (0, 0)"),
        "{}",
        note("O2 T5 I1")
    );
    for other in ["O2 I1", "T5 I1", ">1.1P O2 T5"] {
        assert!(note(other).starts_with("the HIDDEN element at (0, 0)"), "{}", note(other));
    }
}

#[test]
fn a_text_without_element_says_on_which_layer_it_would_have_one() {
    let raw = drawing(&format!(
        "mill 0,90 40,90\nlayer 1234.1P~A\nmill 0,0 40,0\nlayer 1234.1P\n{}",
        text("20,1", "F100")
    ));
    let notes = raw.diagnostics[0].notes.iter().map(|note| note.text(pathbuild_diagnostic::Lang::En));
    assert!(
        notes
            .into_iter()
            .any(|note| note.contains("on layer 1234.1P~A, the text would belong to a line at (0, 0)"))
    );
}

/// Writes a number in letters, because names of layers have no digits after the tilde.
fn letters(number: usize) -> String {
    [number / 676, number / 26 % 26, number % 26]
        .map(|digit| (b'A'..=b'Z').nth(digit).map_or('A', char::from))
        .iter()
        .collect()
}

/// The message lists the first three layers, and at most a hundred are searched.
#[test]
fn a_text_without_element_names_a_few_layers() {
    let layers = |empty: usize, full: usize| {
        let each = |count: usize, name: char, line: &str| {
            let layers =
                (0..count).map(|number| format!("layer 1234.1P~{name}{}\n{line}\n", letters(number)));
            layers.collect::<Vec<_>>().concat()
        };
        let (empty, full) = (each(empty, 'A', "mill 0,90 40,90"), each(full, 'B', "mill 0,0 40,0"));
        let raw = drawing(&format!("{empty}{full}layer 1234.1P\n{}", text("20,1", "F100")));
        let notes = raw.diagnostics.iter().flat_map(|found| &found.notes);
        let notes = notes.map(|note| note.text(pathbuild_diagnostic::Lang::En));
        let named = notes.filter_map(|note| {
            Some(note.strip_prefix("on layer 1234.1P~")?.split(' ').next()?.trim_end_matches(',').to_owned())
        });
        named.collect::<Vec<_>>()
    };
    assert_eq!(layers(0, 3), ["BAAA", "BAAB", "BAAC"]);
    assert_eq!(layers(0, 4), ["BAAA", "BAAB", "BAAC"]);
    assert_eq!(layers(99, 2), ["BAAA"]);
    assert_eq!(layers(100, 2), [""; 0]);
}

/// A layer that contains only texts is not a path: the texts are reported as lost.
#[test]
fn a_text_on_a_layer_without_elements_belongs_to_nothing() {
    let file = read(
        "layer 1235.1P\ntext 20,0.5 \"F100\"\nlayer 1234.1P\nstart 0,0 \"T5 O3 I1 B0\"\nmill 0,0 40,0\nend 40,0",
    );
    assert_eq!((codes(&file.diagnostics), file.paths.len()), (vec!["PB107".to_owned()], 1));
}
