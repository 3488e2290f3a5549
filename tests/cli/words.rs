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
        (
            "a gap before the corner",
            "start\nsweep 0,0 20,0\nmill 20,0 40,0 40,20 20,20 20,0.2\nsweep 20,0 60,9\nend 60,9",
        ),
        (
            "a gap beside the corner",
            "start\nmill 0,0 20,0 \"N1\"\nmill 20,0 20,20 0.2,0.2\nmill 20,0 60,9\nend 60,9",
        ),
        ("a line that is too long", "start\nmill 0,0 20,0\nmill 19.995,0 19.995,30\nend 19.995,30"),
        (
            "a turn marker beside the tip",
            "start\nmill 0,0 20,0 20,20\nmill 20,0 40,0 \"N9999\"\nturn 20,20.5\nend 40,0",
        ),
        (
            "a helper line at a passed corner",
            "start\nmill 0,0 20,0 \"N1\"\nmill 20,0 40,0 \"N2\"\nmill 20,0 20,20 \"N3\"\nend 40,0",
        ),
        ("a hole beside its sweep", "start\nsweep 0,0 20,0\nsweep 20,0 40,0\ncircle 20,0.005 d 5\nend 40,0"),
        ("a part drawn twice, left", "start\nmill 0,0 20,0\nmill 0,0 10,0\nend 20,0"),
        ("a part drawn twice, past", "start\nmill 0,0 20,0\nmill 5,0 15,0\nend 20,0"),
        ("a part drawn twice, at the end", "start\nmill 0,0 20,0\nmill 10,0 20,0\nend 20,0"),
        ("an end marker beside the end", "start\nmill 0,0 20,0\nend 20.2,0"),
        ("a helper line behind the end marker", "start\nmill 0,0 20,0\nmill 20,0 30,0\nend 20,0"),
        ("the last line missing", "start\nmill 0,0 20,0\nend 40,0"),
        ("an end marker of 1 mm", "start\nmill 0,0 20,0\ncircle PHANTOM 20,0 d 1"),
        (
            "a turn marker of 1 mm",
            "start\nmill 0,0 20,0 20,20\nmill 20,0 60,0\nend 60,0\ncircle PHANTOM 20,20 d 1",
        ),
        (
            "a subpath drawn twice",
            "start\nsubpath 0,0 20,0 \">1234.2P\"\nsubpath 0,0 20,0\nend 20,0\nlayer 1234.2P\nstart 0,0 \"T5 O2 I5 B0 F100 M20x2\"\nmill 0,0 20,0\nend 20,0",
        ),
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

/// What continues the path lies on another layer, for each code that a path ends in.
#[test]
fn what_continues_a_path_is_named_on_another_layer() {
    let said = |layer: &str, own: &str, other: &str| {
        let config = "== pathbuild.toml ==\npart = 'Part'\n";
        let drawing = format!("layer 1234.1P\n{START}\n{own}\nlayer {layer}\n{other}\n");
        Place::of(&format!("{config}== 1234.1P.dxf ==\n{drawing}")).run("check 1234.1P.dxf").stderr
    };
    let branch = "mill 0,0 20,0\nmill 20,0 20,10\nmill 20,0 50,0\nend 50,0";
    for (code, own, [inside, outside], note) in [
        ("PB401", branch, ["turn 20,11", "turn 20,11.01"], "layer Notes has a turn marker at (20, 11), 1 mm"),
        ("PB401", branch, ["mill 20,11 60,60", "mill 20,11.01 60,60"], "LINE ends at (20, 11), 1 mm away"),
        (
            "PB402",
            "mill 0,0 20,0\ncircle 30,5 d 2\nend 20,0",
            ["sweep 60,60 30,6", "sweep 60,60 30,6.01"],
            "on layer Notes, LINE ends at (30, 6), 1 mm away",
        ),
        (
            "PB403",
            "mill 0,0 20,0\nend 40,0",
            ["mill 21,0 60,60", "mill 21.01,0 60,60"],
            "on layer Notes, LINE ends at (21, 0), 1 mm away",
        ),
        (
            "PB404",
            "end 40,0",
            ["mill arc 0,1 to 40,1 centre 20,1", "mill arc 0,1.01 to 40,1.01 centre 20,1.01"],
            "on layer Notes, ARC ends at (0, 1), 1 mm away",
        ),
    ] {
        let found = said("Notes", own, inside);
        assert!(found.contains(code) && found.contains(note), "{found}");
        for found in [said("Notes", own, outside), said("Part", own, inside)] {
            assert!(found.contains(code) && !found.contains("wrong layer"), "{found}");
        }
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
