//! Tests messages that readers once misunderstood, in both languages: each test has a drawing or a command, and its output.
//! (book: first/first-part)

use crate::support::{Place, runs};
use insta::assert_snapshot;

const START: &str = "start 0,0 \"T5 O2 I5 B0 F100 M20x2\"";

/// Tests typical mistakes, each with its drawing and the complete output.
#[test]
fn mistakes_of_draughtsmen_are_named() {
    let mistakes = [
        ("the only line drawn twice", "start\nmill 0,0 20,0\nmill 0,0 20,0\nend 40,0"),
        ("a dead end", "start\nmill 0,0 20,0 20,20\nmill 20,0 40,0\nend 40,0"),
        ("a hole in the middle of a line", "start\nmill 0,0 40,0\nmill circle 20,0 d 2 \"B0\"\nend 40,0"),
        ("a gap", "start\nmill 0,0 20,0\nmill 21,0 40,0\nend 40,0"),
        ("a zero for O", "start 0,0 \"02 T5 I5 B0\"\nmill 0,0 20,0\nend 20,0"),
        ("lower case", "start 0,0 \"o2 t5 i0.5 b0\"\nmill 0,0 20,0\nend 20,0"),
        ("a name without >", "start\nsubpath 0,0 20,0 \"2050.1P\"\nend 20,0"),
        ("commas", "start 0,0 \"O2,T5,B0\"\nmill 0,0 20,0\nend 20,0"),
        ("a remark", "start\nmill 0,0 20,0 \"Deckel links\"\nend 20,0"),
        ("F0", "start\nmill 0,0 20,0 \"F0\"\nend 20,0"),
        ("a start marker of 1.002 mm", "start\ncircle PHANTOM 0,0 d 1.002\nmill 0,0 20,0\nend 20,0"),
        ("a non-breaking space", "start 0,0 \"O2\u{a0}T5 I5 B0\"\nmill 0,0 20,0\nend 20,0"),
        ("given twice", "start\nmill 0,0 20,0 \"F100 F200\"\nend 20,0"),
        ("without effect", "start\nsweep 0,0 20,0 \"B0\"\nmill 20,0 40,0\nend 40,0"),
        ("without effect in a chain", "start\nmill 0,0 20,0 \"I2\"\nmill 20,0 40,0 \"I1\"\nend 40,0"),
    ];
    let said = |(name, lines): (&str, &str)| {
        let lines = lines.replacen("start\n", &format!("{START}\n"), 1);
        let place = Place::of(&format!("== 1234.1P.dxf ==\nlayer 1234.1P\n{lines}\n"));
        let in_english = place.run("check 1234.1P.dxf").stderr;
        let in_german = place.run("check 1234.1P.dxf --lang de").stderr;
        format!("== {name} ==\n{in_english}\n{in_german}")
    };
    assert_snapshot!(mistakes.map(said).join("\n"));
}

/// A stray element on a wrong layer is named if the path lacks it, in whichever direction it is drawn.
#[test]
fn elements_on_a_wrong_layer_are_named() {
    let said = |own: &str, other: &str| {
        let place = Place::of(&format!("== 1234.1P.dxf ==\nlayer 1234.1P\n{own}\nlayer Notes\n{other}\n"));
        place.run("check 1234.1P.dxf").stderr
    };
    let groove = "mill 0,0 20,0 \"B0\"\nend 20,0";
    let is_start = |circle: &str| said(groove, circle).contains("has a start marker at (0, 0)");
    assert!(is_start("circle PHANTOM 0,0 d 1"));
    assert!(!is_start("circle PHANTOM 0,0 d 1.2"));
    assert!(!is_start("mill circle 0,0 d 1"));

    let stray = format!("{START}\n{groove}\ntext 50,50 \"B2\" height 2 align centre middle");
    let near = |circle: &str| said(&stray, &format!("mill circle {circle} d 1")).contains("by mistake?");
    for beside in [["53,50", "55,50"], ["47,50", "45,50"], ["50,53", "50,55"], ["50,47", "50,45"]] {
        assert_eq!(beside.map(near), [true, false], "{beside:?}");
    }
}

/// Cutter, thickness or material differ from those of the embedded path: each difference has its own advice.
#[test]
fn what_differs_from_an_embedded_path_has_its_own_advice() {
    let said = |parameters: &str| {
        let place = Place::of(&format!(
            "== 2050.1P.dxf ==\nlayer 2050.1P\n{START}\nmill 0,0 20,0\nend 20,0\n\
             == 8001.1P.dxf ==\nlayer 8001.1P\nstart 0,0 \"{parameters}\"\nsubpath 0,0 20,0 \">2050.1P\"\nend 20,0\n"
        ));
        format!("{}\n{}", place.run("check 8001.1P").stderr, place.run("check 8001.1P --lang de").stderr)
    };
    assert_snapshot!(["T5 O3 M20x2", "T6.5 O2 M20x2", "T5 O2 MWood"].map(said).join("\n"));
}

/// The path is in the library, but not where the command searches.
#[test]
fn a_path_that_is_elsewhere_is_named_with_its_drawing() {
    let place = Place::of(&format!(
        "== pathbuild.toml ==\nlibrary = [\"parts\"]\n== work/note ==\nnothing\n\
         == parts/1234.1P.dxf ==\nlayer 1234.1P\n{START}\nmill 0,0 20,0\nend 20,0\n"
    ));
    let said = ["en", "de"]
        .map(|lang| place.run_in("work", &["where", "1234.1P", "1235.1P", "--lang", lang]).to_string());
    assert_snapshot!(said.join("\n"));
}

/// Tests a missing measured value, a probe without contact, and nested brackets.
#[test]
fn words_of_other_commands() {
    let place = Place::of(&format!(
        "== pathbuild.toml ==\nlibrary = [\".\"]\n\
         == 1234.1P.dxf ==\nlayer 1234.1P\n{START}\nmill 0,0 20,0\nend 20,0\n"
    ));
    let place = place
        .file("a.gcode", "G21 G90 G94\nG0 Z5\nG1 Z0 F100\nM30\n")
        .file("b_Z.txt", "x\n")
        .file("b_Clean.gcode", "M30\n");
    place.run("check");
    let lines = ["why 1234.1P.dxf", "verify a.gcode", "adjust b --max-correction 1", "check --lang de"];
    let lines = lines.iter().flat_map(|line| [(*line).to_owned(), format!("{line} --lang de")]);
    let lines: Vec<String> = lines.filter(|line| !line.ends_with("de --lang de")).collect();
    assert_snapshot!(runs(&place, lines.iter().map(String::as_str)));
}
