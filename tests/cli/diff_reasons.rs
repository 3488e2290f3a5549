//! Tests that `diff` explains changed moves by changes in the drawings. (book: program/comparing)

use std::fs;

use pathbuild_testkit::sheet;
use serde_json::Value;

use crate::support::{Place, Run};

fn dxf(text: &str) -> Vec<u8> {
    sheet(text).unwrap().to_dxf()
}

fn part(name: &str, parameters: &str, elements: &str) -> Vec<u8> {
    dxf(&format!("layer {name}\nstart 0,0 \"T5 O2 I9 MPlate {parameters}\"\n{elements}\nend 40,0\n"))
}

const LINE: &str = "mill 0,0 40,0";
const CONFIGURATION: &str = "rapid = 1000\nsweep-height = 10\nlibrary = [\"parts\"]\n";

/// Creates two libraries from their drawings.
fn two(old: &[(&str, Vec<u8>)], new: &[(&str, Vec<u8>)]) -> Place {
    let mut place = Place::new();
    for (side, files) in [("old", old), ("new", new)] {
        place = place.file(&format!("{side}/pathbuild.toml"), CONFIGURATION);
        for (name, bytes) in files {
            place = place.file(&format!("{side}/parts/{name}.dxf"), bytes.clone());
        }
    }
    place
}

/// Returns the lines that explain the changes of each path.
fn explanations(run: &Run) -> Vec<String> {
    assert_eq!(run.status, Some(0), "{run}");
    let lines = run.stdout.lines().map(str::to_owned);
    let is_intro = |line: &str| ["explained by:", "Ursache:"].contains(&line.trim());
    let starts = |line: &str| line.contains(" · ") || is_intro(line) || line.contains("explains this");
    let mut is_within = false;
    let within = lines.filter(|line| {
        if starts(line) {
            is_within = !line.contains(" · ");
        }
        is_within && line.starts_with(' ') && !is_intro(line)
    });
    within.map(|line| line.trim_end().to_owned()).collect()
}

#[track_caller]
fn explained(old: Vec<u8>, new: Vec<u8>, expected: &[&str]) -> Place {
    let place = two(&[("1001.1P", old)], &[("1001.1P", new)]);
    assert_eq!(explanations(&place.run("diff old new")), expected);
    place
}

#[test]
fn what_was_drawn_explains_the_moves() {
    let old = || part("1001.1P", "B1 F200", LINE);
    explained(old(), part("1001.1P", "B0.5 F200", LINE), &["    start marker: text B1 became B0.5"]);
    explained(
        old(),
        part("1001.1P", "B1 F200", "mill 0,0 40,0 \"F300\""),
        &["    line from (0, 0) to (40, 0): text F300 added"],
    );
    let place = explained(
        part("1001.1P", "B1 F200", "mill circle 0,0 d 6\nmill 0,0 40,0"),
        part("1001.1P", "B1 F200", "mill circle 0,0 d 8\nmill 0,0 40,0"),
        &["    circle at (0, 0): diameter 6 became 8"],
    );
    let german = place.run("diff old new --lang de");
    assert_eq!(explanations(&german), ["    Kreis bei (0, 0): aus Durchmesser 6 wurde 8"]);
    assert!(german.stdout.contains("\n  Ursache:\n"), "{german}");
}

/// If the line type changes to one that takes no text, or back, the change of the text is not reported; otherwise it is.
#[test]
fn a_line_type_without_texts_is_told_instead_of_the_text() {
    let part = |sweep: &str| part("1001.1P", "B1 F200", &format!("{sweep}\nmill 20,0 40,0"));
    let dashed = |text: &str| part(&format!("sweep 0,0 20,0 \"{text}\""));
    explained(
        dashed("S12"),
        part("sweep 0,0 20,0"),
        &["    line from (0, 0) to (20, 0): line type changed from DASHED to HIDDEN"],
    );
    explained(
        part("sweep 0,0 20,0"),
        dashed("S12"),
        &["    line from (0, 0) to (20, 0): line type changed from HIDDEN to DASHED"],
    );
    explained(dashed("S12"), dashed("S14"), &["    line from (0, 0) to (20, 0): text S12 became S14"]);
}

#[test]
fn what_changes_no_move_explains_nothing() {
    // The comment changes as well, but only the depth changes moves.
    let drawing = |depth: &str, comment: &str| {
        part("1001.1P", &format!("B{depth} F200"), &format!("mill 0,0 40,0 \"Q{comment}\""))
    };
    explained(drawing("1", "one"), drawing("2", "two"), &["    start marker: text B1 became B2"]);
    // A changed comment alone does not change the moves.
    let place = two(&[("1001.1P", drawing("1", "one"))], &[("1001.1P", drawing("1", "two"))]);
    assert_eq!(place.run("diff old new").stdout, "0 of 1 path changed\n");
}

#[test]
fn embedded_paths_are_followed_level_by_level() {
    let all = |depth: &str| {
        let project = "layer 8001.1P\nstart 0,0 \"T5 O2 I9 MPlate B1 F200\"\nsubpath 0,0 40,0 \">1002.1P\"\n\
                       subpath 40,0 80,0 \">1001.1P\"\nend 80,0\n";
        [
            ("1001.1P", part("1001.1P", &format!("B{depth} F200"), LINE)),
            ("1002.1P", part("1002.1P", "B1 F200", "subpath 0,0 40,0 \">1001.1P\"")),
            ("8001.1P", dxf(project)),
        ]
    };
    let place = two(&all("1"), &all("0.5"));
    let run = place.run("diff old new");
    assert_eq!(
        explanations(&run),
        [
            "    start marker: text B1 became B0.5",
            "    embedded path 1001.1P changed",
            "      start marker: text B1 became B0.5",
            "    embedded path 1002.1P changed",
            "      embedded path 1001.1P changed",
            "        start marker: text B1 became B0.5",
            "    embedded path 1001.1P changed, as above",
        ],
        "{run}"
    );
    let json = place.run("diff old new --format json");
    let rows: Vec<Value> = json.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let project = rows.iter().find(|row| row["path"] == "8001.1P").unwrap();
    let embedded = &project["explained_by"][0]["explained_by"][0];
    assert_eq!((&embedded["kind"], &embedded["path"]), (&"embedded".into(), &"1001.1P".into()));
    let text = &embedded["explained_by"][0];
    assert_eq!((&text["kind"], &text["was"], &text["now"]), (&"text".into(), &"B1".into(), &"B0.5".into()));
}

/// A path that is embedded with several sets of values has the same reasons for each of them, unless a value differs.
#[test]
fn the_reasons_of_an_embedded_path_are_listed_once_for_all_values() {
    let all = |feed: &str, last: &str| {
        let project = format!(
            "layer 8001.1P\nstart 0,0 \"T5 O2 I9 MPlate B1 F200\"\nsubpath 0,0 40,0 \">1001.1P :A1\"\n\
             subpath 40,0 80,0 \">1001.1P :A2\"\nsubpath 80,0 120,0 \">1002.1P\"\nsubpath 120,0 160,0 \">1001.1P :A{last}\"\nend 160,0\n"
        );
        [
            ("1001.1P", part("1001.1P", &format!("B=A F{feed} :A0~2"), LINE)),
            ("1002.1P", part("1002.1P", "B1 F200", "subpath 0,0 40,0 \">1001.1P :A1.5\"")),
            ("8001.1P", dxf(&project)),
        ]
    };
    let text = "start marker: text F200 became F120";
    let run = two(&all("200", "0.5"), &all("120", "0.5")).run("diff old new --lang en");
    let (listed, again) = (format!("      {text}"), "      embedded path 1001.1P changed, as above");
    let of_project = |run: &Run| explanations(run).split_off(explanations(run).len() - 5);
    let expected = ["    embedded path 1001.1P changed", &listed, "    embedded path 1002.1P changed", again];
    assert!(explanations(&run).ends_with(&expected.map(str::to_owned)), "{run}");
    // Another value is a reason of its own.
    let run = two(&all("200", "0.5"), &all("120", "0.8")).run("diff old new --lang en");
    let other = ["    embedded path 1001.1P changed", "      variable A: 0.5 became 0.8", &listed];
    assert_eq!(of_project(&run)[2..], other.map(str::to_owned), "{run}");
}

#[test]
fn variables_and_settings_are_named() {
    let leaf = || part("1001.1P", "B=A F200 :A0~2", LINE);
    let project = |value: &str| part("8001.1P", "F200", &format!("subpath 0,0 40,0 \">1001.1P :A{value}\""));
    let all = |value: &str| [("1001.1P", leaf()), ("8001.1P", project(value))];
    assert_eq!(
        explanations(&two(&all("1"), &all("2")).run("diff old new")),
        [
            "    line from (0, 0) to (40, 0): text :A1 became :A2",
            "    embedded path 1001.1P changed",
            "      variable A: 1 became 2"
        ]
    );
    let same = [("1001.1P", part("1001.1P", "B1 S20", LINE)), ("1002.1P", part("1002.1P", "B1 F200", LINE))];
    let place = two(&same, &same);
    for (side, feed) in [("old", 100), ("new", 120)] {
        let configuration = format!("{CONFIGURATION}feed = {feed}\n");
        fs::write(place.path().join(side).join("pathbuild.toml"), configuration).unwrap();
    }
    let run = place.run("diff old new");
    assert_eq!(explanations(&run), ["    feed in pathbuild.toml: 100 became 120"], "{run}");
    assert!(run.stdout.contains("1 of 2 paths changed"), "{run}");
}

/// The configuration decides how a drawing is read. The same file may then have other elements, which is not a change of the drawing.
#[test]
fn a_drawing_that_is_read_otherwise_was_not_changed() {
    let same = [("1001.1P", part("1001.1P", "B1 F200", "line \"EDGE\" 0,0 40,0"))];
    let place = two(&same, &same);
    for (side, line_type) in [("old", "CONTINUOUS"), ("new", "DASHED")] {
        let configuration = format!("{CONFIGURATION}[line-types]\nEDGE = \"{line_type}\"\n");
        fs::write(place.path().join(side).join("pathbuild.toml"), configuration).unwrap();
    }
    let run = place.run("diff old new");
    let explained = explanations(&run);
    assert!(explained.len() == 1 && explained[0].starts_with("    line-types in pathbuild.toml: "), "{run}");
}

/// Two lines of equal rank start at one point: their order in the file decides which is milled first.
#[test]
fn the_order_in_the_file_is_named_if_nothing_else_differs() {
    let star = |elements: &str| {
        dxf(&format!("layer 1001.1P\nstart 0,0 \"T5 O2 I9 MPlate B1 F200\"\n{elements}end 0,0\n"))
    };
    let [one_way, other_way] = [[0, 1, 2, 3], [3, 2, 1, 0]].map(|order| {
        let square = ["mill 0,0 20,0\n", "mill 20,0 20,20\n", "mill 20,20 0,20\n", "mill 0,20 0,0\n"];
        order.map(|line| square[line]).concat()
    });
    explained(star(&one_way), star(&other_way), &["    the same elements, in another order in the file"]);
}

#[test]
fn the_page_and_markdown_explain_as_well() {
    let place = two(
        &[("1001.1P", part("1001.1P", "B1 F200", LINE))],
        &[("1001.1P", part("1001.1P", "B1 F200", "mill 0,0 40,0 \"B0.5 Q<b>\""))],
    );
    for name in ["d.md", "d.html"] {
        assert_eq!(place.run(&format!("diff old new -o {name}")).status, Some(0));
    }
    assert!(
        place.read("d.html").contains(
            "<p>explained by:</p>\n<ul>\n<li>line from (0, 0) to (40, 0): text B0.5 added</li></ul>"
        )
    );
    assert!(place.read("d.md").contains("explained by"));
}

/// A program is not explained by a drawing: the post has rounded it, and the drawing from which it was written is unknown.
#[test]
fn programs_are_not_explained() {
    let place = two(
        &[("1001.1P", part("1001.1P", "B1 F200", LINE))],
        &[("1001.1P", part("1001.1P", "B2 F200", LINE))],
    );
    let emit = place.run("emit ./old/parts/1001.1P.dxf --config old/pathbuild.toml --out-dir programs");
    assert_eq!(emit.status, Some(0), "{emit}");
    let diff = place.run("diff programs/1001.1P_Milling.gcode 1001.1P --config new/pathbuild.toml");
    assert!(diff.stdout.contains("1 mm higher") && !diff.stdout.contains("expl"), "{diff}");
}
