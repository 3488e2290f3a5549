//! Tests the changes that are found between two versions of a path: each kind of change, and edits without effect. (book: program/comparing)

use pathbuild_diagnostic::{Lang, Value};
use pathbuild_path::{
    Bindings, DrawnChanges, DrawnSide, PathOptions, PathRole, drawn_changes, element_parameters,
};

use crate::support::{language, read};

const PARAMETERS: &str = "O2 T3 I1 B0 F150";
const ROUND: &str = "mill 0,0 40,0\nmill 40,0 40,20\nsweep 40,20 0,20\nend 0,20\n";

fn compared(old: &str, new: &str) -> DrawnChanges {
    let sides = [old, new].map(|drawing| {
        let mut paths = read(drawing).paths;
        assert_eq!(paths.len(), 1, "paths in\n{drawing}");
        let (raw, positions) = paths.remove(0);
        let bindings = Bindings::check_values(&raw.definitions);
        let options = PathOptions { sweep_height: Some(8.0), ..PathOptions::default() };
        let in_force = element_parameters(&raw, &bindings, &options, PathRole::Emitted, &language());
        (raw, positions, in_force)
    });
    let [old, new] =
        sides.each_ref().map(|(raw, positions, in_force)| DrawnSide { raw, positions, parameters: in_force });
    drawn_changes(old, new)
}

fn drawing(parameters: &str, statements: &str) -> String {
    format!("layer 1234.1P\nstart 0,0 \"{parameters}\"\n{statements}")
}

/// Returns the changes between two versions of the elements, in words.
fn changes(old: &str, new: &str) -> Vec<String> {
    in_words(&compared(&drawing(PARAMETERS, old), &drawing(PARAMETERS, new)))
}

fn in_words(changes: &DrawnChanges) -> Vec<String> {
    let words = changes.changes.iter().map(|change| Value::from(change.sentence()).render(Lang::En));
    words.collect()
}

/// Returns the changes after a replacement in a drawing.
#[track_caller]
fn replaced(from: &str, to: &str) -> Vec<String> {
    assert!(ROUND.contains(from), "{from}");
    changes(ROUND, &ROUND.replace(from, to))
}

#[test]
fn texts() {
    let line = "mill 40,0 40,20";
    assert_eq!(replaced(line, &format!("{line} \"B1\"")), ["line from (40, 0) to (40, 20): text B1 added"]);
    let with_text = ROUND.replace(line, &format!("{line} \"F100 B1\""));
    let other = |text: &str| changes(&with_text, &with_text.replace("F100 B1", text));
    assert_eq!(other("F100 B2"), ["line from (40, 0) to (40, 20): text B1 became B2"]);
    assert_eq!(other("B2 F120"), ["line from (40, 0) to (40, 20): text F100 B1 became B2 F120"]);
    assert_eq!(other("B1"), ["line from (40, 0) to (40, 20): text F100 removed"]);
    // The text has the same values in another order, in another form, or with a comment.
    for text in ["B1 F100", "F100.0 B1,0", "F100 B1 QEdge"] {
        assert_eq!(other(text), [""; 0], "{text}");
    }
    // The element's new value is the one that it had from the path.
    assert_eq!(replaced(line, &format!("{line} \"B0\"")), [""; 0]);
}

#[test]
fn letters_without_effect_are_no_change() {
    // I of a chain is taken from its first segment only.
    let [first, second] = ["mill 0,0 40,0", "mill 40,0 40,20"];
    assert_eq!(
        replaced(first, &format!("{first} \"I0.5\"")),
        ["line from (0, 0) to (40, 0): text I0.5 added"]
    );
    assert_eq!(replaced(second, &format!("{second} \"I0.5\"")), [""; 0]);
}

#[test]
fn the_text_of_the_path() {
    let text =
        |parameters: &str| in_words(&compared(&drawing(PARAMETERS, ROUND), &drawing(parameters, ROUND)));
    assert_eq!(text("O2 T3 I1 B1 F150"), ["start marker: text B0 became B1"]);
    assert_eq!(text("O3 T3 I1 B0 F100"), ["start marker: text O2 F150 became O3 F100"]);
    assert_eq!(text("T3 O2 B0 I1 F150 MBrass"), [""; 0]);
    // No element uses D, and every element has its own B.
    assert_eq!(text("O2 T3 I1 B0 F150 D1"), [""; 0]);
    let own = ROUND.replace("mill 0,0 40,0", "mill 0,0 40,0 \"B1\"").replace("40,20\ns", "40,20 \"B1\"\ns");
    let [old, new] = ["B0", "B2"].map(|depth| drawing(&format!("O2 T3 I1 {depth} F150"), &own));
    assert_eq!(in_words(&compared(&old, &new)), [""; 0]);
}

#[test]
fn circles() {
    let circle = "mill 0,0 20,0\nmill circle 20,0 d 6\nmill 20,0 40,0\nend 40,0\n";
    let replaced = |to: &str| changes(circle, &circle.replace("20,0 d 6", to));
    assert_eq!(replaced("20,0 d 8"), ["circle at (20, 0): diameter 6 became 8"]);
    assert_eq!(replaced("20,0 d 6.0001"), [""; 0]);
    assert_eq!(replaced("20,0 d 6.001"), ["circle at (20, 0): diameter 6 became 6.001"]);
}

#[test]
fn places() {
    let moved = ROUND.replace("40,0", "40.5,0").replace("40,20", "40.5,20");
    assert_eq!(
        changes(ROUND, &moved),
        [
            "2 lines, the first at (0, 0): one end moved by (0.5, 0) mm",
            "line from (40.5, 0) to (40.5, 20): moved by (0.5, 0) mm"
        ]
    );
    let shifted = |by: &str| ROUND.replace("40,20", &format!("40.{by},20"));
    assert_eq!(changes(ROUND, &shifted("00008")), [""; 0]);
    assert_eq!(changes(ROUND, &shifted("001")).len(), 1);
}

#[test]
fn a_path_that_was_moved_on_its_sheet() {
    let elsewhere = |[start, second, third, end]: [&str; 4]| {
        format!(
            "layer 1234.1P\nstart {start} \"{PARAMETERS}\"\nmill {start} {second}\nmill {second} {third}\n\
             sweep {third} {end}\nend {end}\n"
        )
    };
    let old = elsewhere(["0,0", "40,0", "40,20", "0,20"]);
    let moved = elsewhere(["100,50", "140,50", "140,70", "100,70"]);
    assert_eq!(in_words(&compared(&old, &moved)), [""; 0]);
    let other = elsewhere(["100,50", "140,50", "140,75", "100,75"]);
    assert_eq!(
        in_words(&compared(&old, &other)),
        [
            "end marker: moved by (0, 5) mm",
            "line from (140, 50) to (140, 75): one end moved by (0, 5) mm",
            "line from (140, 75) to (100, 75): moved by (0, 5) mm"
        ]
    );
    // Everything except the start is shifted, which is reported once for all lines.
    let lines = "mill 10,0 50,0\nmill 50,0 50,20\nmill 50,20 10,20\nend 10,20\n";
    let rest = lines.replace("10,", "15,").replace("50,", "55,");
    assert_eq!(
        changes(lines, &rest),
        ["end marker: moved by (5, 0) mm", "3 lines, the first at (15, 0): moved by (5, 0) mm"]
    );
}

#[test]
fn arcs() {
    let arc = "mill arc centre 10,0 r 10 from 180 to 0\nend 20,0\n";
    let replaced = |to: &str| changes(arc, &arc.replace("10,0 r 10 from 180 to 0", to));
    assert_eq!(replaced("10,0 r 10 from 0 to 180 cw"), [""; 0], "the other way round");
    assert_eq!(replaced("10,5 r 10 from 180 to 0"), ["arc from (0, 5) to (20, 5): moved by (0, 5) mm"]);
    assert_eq!(replaced("10,0 r 12 from 180 to 0"), ["arc from (-2, 0) to (22, 0): radius 10 became 12"]);
    assert_eq!(
        replaced("10,0 r 10 from 180 to 270"),
        ["arc from (0, 0) to (10, -10): one end moved by (-10, -10) mm"]
    );
    assert_eq!(replaced("10,0 r 10 from 0 to 180"), ["arc from (20, 0) to (0, 0): runs differently"]);
    assert_eq!(
        replaced("20,5 r 12 from 90 to 200"),
        ["arc from (20, 17) to (8.724, 0.896): runs differently"]
    );
}

#[test]
fn elements_that_come_and_go() {
    let third = "mill circle 40,20 d 2\n";
    let more = ROUND.replace("sweep", &format!("{third}sweep"));
    assert_eq!(changes(ROUND, &more), ["circle at (40, 20): added"]);
    assert_eq!(changes(&more, ROUND), ["circle at (40, 20): removed"]);
    let turn = format!("{ROUND}turn 40,20\n");
    assert_eq!(changes(ROUND, &turn), ["turn marker at (40, 20): added"]);
}

/// At a corner, two lines have the same start.
#[test]
fn lines_from_one_point_are_told_apart() {
    let lines =
        |across: &str, up: &str| format!("mill 0,0 20,0 \"{across}\"\nmill 0,0 0,10 \"{up}\"\nend 0,10\n");
    let mut found = changes(&lines("N1", "N2"), &lines("N2", "N1"));
    found.sort();
    assert_eq!(
        found,
        ["line from (0, 0) to (0, 10): text N2 became N1", "line from (0, 0) to (20, 0): text N1 became N2"]
    );
}

#[test]
fn line_types() {
    let line = "mill 40,0 40,20";
    assert_eq!(
        replaced(line, "line DASHED 40,0 40,20"),
        ["line from (40, 0) to (40, 20): line type changed from CONTINUOUS to DASHED"]
    );
    assert_eq!(
        replaced(line, "mark 40,0 40,20 \"D2\""),
        [
            "line from (40, 0) to (40, 20): line type changed from CONTINUOUS to DIVIDE",
            "line from (40, 0) to (40, 20): text D2 added"
        ]
    );
}

#[test]
fn order_and_direction_do_not_matter() {
    let turned = "sweep 0,20 40,20\nmill 40,20 40,0\nmill 40,0 0,0\nend 0,20\n";
    let changes = compared(&drawing(PARAMETERS, ROUND), &drawing(PARAMETERS, turned));
    assert_eq!(in_words(&changes), [""; 0]);
    // The order may still decide between lines of equal rank that meet at a point.
    assert!(changes.is_reordered);
    assert!(!compared(&drawing(PARAMETERS, ROUND), &drawing(PARAMETERS, ROUND)).is_reordered);
}

#[test]
fn equal_changes_are_told_once() {
    let holes = |depth: &str, x: &[u32]| {
        let hole = |x: &u32| format!("mill circle {x},5 d 2 \"B{depth}\"\n");
        format!("{}{ROUND}", x.iter().map(hole).collect::<String>())
    };
    let row: Vec<u32> = (1..30).collect();
    assert_eq!(
        changes(&holes("1", &row), &holes("2", &row)),
        ["29 circles, the first at (1, 5): text B1 became B2"]
    );
    let moved: Vec<u32> = row.iter().map(|x| x + 100).collect();
    assert_eq!(
        changes(&holes("1", &row), &holes("1", &moved)),
        ["29 circles, the first at (101, 5): moved by (100, 0) mm"]
    );
    assert_eq!(changes(&holes("1", &row), &holes("1", &row[1..])), ["circle at (1, 5): removed"]);
}

/// Many equal elements at one place are compared quickly, and each is paired with its own counterpart.
#[test]
fn crowds() {
    let crowd = |number: usize, text: &str| {
        let hole = format!("mill circle 5,5 d 2 \"{text}\"\n");
        format!("{}{ROUND}", hole.repeat(number))
    };
    assert_eq!(
        changes(&crowd(200, "B1"), &crowd(190, "B2")),
        ["190 circles, the first at (5, 5): text B1 became B2", "10 circles, the first at (5, 5): removed"]
    );
}

/// A groove that is milled at two depths is drawn twice, in any order.
#[test]
fn elements_at_one_place_are_told_apart_by_their_depths() {
    let lines = |first: &str, second: &str| {
        format!("mill 0,0 40,0 \"{first}\"\nmill 0,0 40,0 \"{second}\"\nend 40,0\n")
    };
    assert_eq!(changes(&lines("B1", "B0.5"), &lines("B0.5", "B1")), [""; 0]);
    assert_eq!(
        changes(&lines("B1", "B0.5"), &lines("B0.5", "B0.8")),
        ["line from (0, 0) to (40, 0): text B1 became B0.8"]
    );
}

/// A line that is inserted at the top of the file, so that hardly any element keeps its handle.
const ADDED: &str = "mill 0,0 0,-30\n";

#[test]
fn a_line_that_was_lengthened_is_the_nearest_one_at_its_end() {
    let longer = format!("{ADDED}{}", ROUND.replace("0,0 40,0", "0,0 41,0"));
    assert_eq!(
        changes(ROUND, &longer),
        ["line from (0, 0) to (41, 0): one end moved by (1, 0) mm", "line from (0, 0) to (0, -30): added"]
    );
}

#[test]
fn a_circle_of_another_diameter_is_known_by_its_centre() {
    let circle = "mill 0,0 20,0\nmill circle 20,0 d 6\nmill 20,0 40,0\nend 40,0\n";
    let larger = format!("{ADDED}{}", circle.replace("d 6", "d 8"));
    assert_eq!(
        changes(circle, &larger),
        ["circle at (20, 0): diameter 6 became 8", "line from (0, 0) to (0, -30): added"]
    );
}

/// The CAD program gave the handle of the third line to a new one. Only an equal role or a common end shows that it is the old line, edited.
#[test]
fn a_handle_that_another_element_has_now_is_no_evidence() {
    let edited = |line: &str| changes(ROUND, &ROUND.replace("sweep 40,20 0,20", line));
    assert_eq!(
        edited("mill 40,21 30,30"),
        ["line from (40, 20) to (0, 20): removed", "line from (40, 21) to (30, 30): added"]
    );
    assert_eq!(
        edited("mill 40,20 30,30"),
        [
            "line from (40, 20) to (30, 30): one end moved by (30, 10) mm",
            "line from (40, 20) to (30, 30): line type changed from HIDDEN to CONTINUOUS"
        ]
    );
    assert_eq!(edited("sweep 40,21 30,30"), ["line from (40, 21) to (30, 30): runs differently"]);
}

/// A line is drawn in the middle of the file, and the CAD program renumbers all elements after it: their handles say nothing.
#[test]
fn handles_of_a_program_that_renumbers_are_not_used() {
    let old = "mill 0,0 10,0\nmill 10,0 20,0\nmill 20,0 30,0\nmill 30,0 40,0\nmill 40,0 50,20\nmill 50,20 60,0\nend 60,0\n";
    let new = old.replace("mill 20,0", "mill 10,0 10,9\nmill 20,0").replace("50,20", "50,30");
    assert_eq!(
        changes(old, &new),
        ["line from (10, 0) to (10, 9): added", "2 lines, the first at (40, 0): one end moved by (0, 10) mm"]
    );
}
