//! Tests turn markers, which mark dead ends. (book: language/order-and-turns)

use crate::support::{compile, items, path, wrong};

const P: &str = "T5 O3 I1 B0 D2 P1 U4 Mx";

fn walked(statements: &str) -> Vec<String> {
    items(&path(P, statements))
}

fn codes_of(statements: &str) -> Vec<String> {
    wrong(&path(P, statements))
}

/// Walks a path from (0, 0) via (20, 0) to (40, 0), with a branch up to (20, 10).
fn branch(statement: &str) -> Vec<String> {
    walked(&format!("mill 0,0 20,0\n{statement}\nmill 20,0 40,0 \"N9999\"\nturn 20,10\nend 40,0"))
}

#[test]
fn what_is_milled_is_milled_back_in_the_same_chain() {
    assert_eq!(branch("mill 20,0 20,10"), ["[0,0 20,0, 20,0 20,10, 20,10 20,0 back, 20,0 40,0]"]);
    assert_eq!(branch("mark 20,0 20,10"), branch("mill 20,0 20,10"));
    assert_eq!(branch("bars 20,0 20,10 \"U9\""), branch("mill 20,0 20,10"));
    assert_eq!(branch("mill 20,0 25,5 20,10").len(), 1);
}

#[test]
fn an_arc_is_run_back_the_other_way() {
    let compiled = compile(&path(
        P,
        "mill 0,0 20,0\nmill arc 20,0 20,10 r 5\nmill 20,0 40,0 \"N9999\"\nturn 20,10\nend 40,0",
    ));
    let clockwise: Vec<bool> = compiled.first_chain()[1..3]
        .iter()
        .map(|curve| matches!(curve, pathbuild_path::Curve::Arc(arc) if arc.clockwise))
        .collect();
    assert_eq!(clockwise, [false, true]);
}

#[test]
fn a_sweep_is_swept_back_at_its_own_height() {
    let statements =
        "mill 0,0 20,0\nline DASHED 20,0 20,10 \"S12\"\nmill 20,0 40,0 \"N9999\"\nturn 20,10\nend 40,0";
    assert_eq!(walked(statements), ["[0,0 20,0]", "sweep 20,0 20,10", "sweep 20,10 20,0", "[20,0 40,0]"]);
    let compiled = compile(&path(P, statements));
    let heights: Vec<Option<f64>> = compiled
        .walked
        .items
        .iter()
        .filter_map(|item| match item {
            pathbuild_path::Item::Sweep(sweep) => Some(sweep.height),
            _ => None,
        })
        .collect();
    assert_eq!(heights, [Some(12.0), Some(12.0)]);
    for silent in ["line HIDDEN 20,0 20,10", "skip 20,0 20,10 \">1111.1P\""] {
        assert_eq!(branch(silent)[1..3], ["sweep 20,0 20,10", "sweep 20,10 20,0"]);
    }
}

#[test]
fn over_a_subpath_the_tool_sweeps_back() {
    assert_eq!(branch("subpath 20,0 20,10 \">1111.1P\"")[1..3], ["subpath 20,0 20,10", "sweep 20,10 20,0"]);
}

#[test]
fn over_a_hole_nothing_is_done_and_a_helical_circle_raises_the_tool() {
    let hole =
        walked("mill 0,0 20,0 20,10\ncircle 20,10 d 3\nmill 20,0 40,0 \"N9999\"\nturn 20,10\nend 40,0");
    assert_eq!(hole, ["[0,0 20,0, 20,0 20,10]", "hole 20,10", "[20,10 20,0 back, 20,0 40,0]"]);
    let helix =
        walked("mill 0,0 20,0 20,10\ncircle 20,10 d 8\nmill 20,0 40,0 \"N9999\"\nturn 20,10\nend 40,0");
    assert_eq!(
        helix,
        ["[0,0 20,0, 20,0 20,10]", "helix 20,10 r4", "sweep 20,10 20,10", "[20,10 20,0 back, 20,0 40,0]"]
    );
}

#[test]
fn a_hole_on_the_way_ends_the_chain_of_the_way_back() {
    let walked =
        walked("mill 0,0 20,0 20,10 20,20\ncircle 20,10 d 3\nmill 20,0 40,0 \"N9999\"\nturn 20,20\nend 40,0");
    assert_eq!(
        walked,
        [
            "[0,0 20,0, 20,0 20,10]",
            "hole 20,10",
            "[20,10 20,20, 20,20 20,10 back]",
            "[20,10 20,0 back, 20,0 40,0]"
        ]
    );
}

/// If the orders were equal, the shorter segment would come first.
#[test]
fn an_unnumbered_dead_end_comes_before_what_has_the_order_9999() {
    let walked = walked("mill 0,0 20,0 20,10\nmill 20,0 25,0 \"N9999\"\nturn 20,10\nend 25,0");
    assert_eq!(walked, ["[0,0 20,0, 20,0 20,10, 20,10 20,0 back, 20,0 25,0]"]);
}

#[test]
fn without_a_marker_a_dead_end_is_an_error() {
    let dead_end = "mill 0,0 20,0 20,10\nmill 20,0 40,0 \"N9999\"\nend 40,0";
    assert_eq!(codes_of(dead_end), ["PB401"]);
    assert_eq!(codes_of(&format!("{dead_end}\nturn 20,10")), [""; 0]);
    assert_eq!(codes_of(&format!("{dead_end}\nturn 20.00003,10")), [""; 0]);
    assert_eq!(codes_of(&format!("{dead_end}\nturn 20.00004,10")), ["PB401"]);
}

/// The tool only returns to the nearest branch, and retraces each segment once.
#[test]
fn each_segment_is_returned_over_once() {
    let comb = "mill 0,0 20,0 20,10\nmill 20,0 40,0 \"N9997\"\nmill 40,0 40,10\nmill 40,0 60,0 \"N9999\"\nturn 20,10\nturn 40,10\nend 60,0";
    let comb = comb
        .replace("mill 0,0 20,0 20,10\n", "mill 0,0 20,0\nmill 20,0 20,10 \"N1\"\n")
        .replace("mill 40,0 40,10", "mill 40,0 40,10 \"N1\"");
    assert_eq!(
        walked(&comb),
        ["[0,0 20,0, 20,0 20,10, 20,10 20,0 back, 20,0 40,0, 40,0 40,10, 40,10 40,0 back, 40,0 60,0]"]
    );
}

#[test]
fn a_dead_end_within_a_dead_end_leads_back_to_the_first() {
    // The path leads from (20, 0) up to (20, 10), where a branch leads to (30, 10), and on to (20, 20); then along to (40, 0).
    let statements = "mill 0,0 20,0\nmill 20,0 20,10 \"N1\"\nmill 20,10 30,10 \"N1\"\nmill 20,10 20,20 \"N2\"\nmill 20,0 40,0 \"N3\"\n\
                      turn 30,10\nturn 20,20\nend 40,0";
    assert_eq!(
        walked(statements),
        [
            "[0,0 20,0, 20,0 20,10, 20,10 30,10, 30,10 20,10 back, 20,10 20,20, 20,20 20,10 back, 20,10 20,0 back, 20,0 40,0]"
        ]
    );
}

#[test]
fn a_marker_has_no_effect_where_something_continues_or_on_the_way_back() {
    assert_eq!(codes_of("mill 0,0 20,0 40,0\nturn 20,0\nend 40,0"), ["PB114"]);
    // The tool passes the marker at (20, 10) when it returns from (20, 20).
    let passed = "mill 0,0 20,0 20,10 20,20\nmill 20,0 40,0 \"N9999\"\nturn 20,20\nturn 20,10\nend 40,0";
    assert_eq!(codes_of(passed), ["PB114"]);
}

#[test]
fn several_markers_at_one_point_are_one() {
    assert_eq!(
        codes_of("mill 0,0 20,0 20,10\nmill 20,0 40,0 \"N9999\"\nturn 20,10\nturn 20,10\nend 40,0"),
        [""; 0]
    );
}

#[test]
fn a_marker_of_a_tilde_layer_belongs_to_the_path() {
    assert_eq!(
        codes_of("mill 0,0 20,0 20,10\nmill 20,0 40,0 \"N9999\"\nend 40,0\nlayer 1234.1P~A\nturn 20,10"),
        [""; 0]
    );
}

#[test]
fn the_way_back_ends_at_the_start() {
    let statements = "mill 0,0 20,0\nmill 50,0 60,0\nturn 20,0\nend 60,0";
    let compiled = compile(&path(P, statements));
    let found = &compiled.found[0];
    assert_eq!(found.code().to_string(), "PB401");
    assert!(
        found
            .text(pathbuild_diagnostic::Lang::En)
            .starts_with("no segment branches off on the way back from this turn marker")
    );
    assert_eq!(
        found.notes[0].text(pathbuild_diagnostic::Lang::En),
        "the nearest open end is at (50, 0), 30 mm away (a milling segment)"
    );
    // A branch at the start is found as well.
    assert_eq!(codes_of("mill 0,0 20,0\nmill 0,0 0,30\nturn 20,0\nend 0,30"), [""; 0]);
}

/// Turn markers take precedence over the end marker.
#[test]
fn at_a_marker_on_the_end_the_tool_goes_back() {
    assert_eq!(codes_of("mill 0,0 20,0 20,10\nmill 20,0 40,0 \"N9999\"\nturn 20,10\nend 20,10"), ["PB403"]);
}

#[test]
fn with_nothing_left_the_tool_goes_back_to_the_end() {
    assert_eq!(
        walked("mill 0,0 20,0 20,10 30,10\nturn 30,10\nend 20,0"),
        ["[0,0 20,0, 20,0 20,10, 20,10 30,10, 30,10 20,10 back, 20,10 20,0 back]"]
    );
    assert_eq!(walked("mill 0,0 20,0\nturn 20,0\nend 0,0"), ["[0,0 20,0, 20,0 0,0 back]"]);
    assert_eq!(codes_of("mill 0,0 20,0\nturn 20,0\nend 90,0"), ["PB403"]);
    assert_eq!(codes_of("mill 0,0 20,0\nend 0,0"), ["PB403"]);
}

/// Returns the notes of the first finding.
fn notes_of(statements: &str) -> Vec<String> {
    let compiled = compile(&path(P, statements));
    compiled.found[0].notes.iter().map(|note| note.text(pathbuild_diagnostic::Lang::En)).collect()
}

#[test]
fn a_turn_marker_beside_the_tip_is_named() {
    let text = |marker: &str| {
        let drawn = format!("mill 0,0 20,0 20,10\nmill 20,0 40,0 \"N9999\"\nturn {marker}\nend 40,0");
        compile(&path(P, &drawn)).found[0].text(pathbuild_diagnostic::Lang::En)
    };
    let tip = "the path breaks off here, at the tip of a dead end";
    let left = "segments not reached: 1";
    assert_eq!(text("20,10.5"), format!("{tip}: the turn marker at (20, 10.5) is 0.5 mm away; {left}"));
    assert_eq!(text("20,11"), format!("{tip}: the turn marker at (20, 11) is 1 mm away; {left}"));
    assert_eq!(text("20,11.01"), format!("{tip}; {left}"));
}

/// The walk turns back at the marker, so that the next mistake is told as well.
#[test]
fn a_turn_marker_beside_the_tip_hides_no_other_mistake() {
    let told = |drawn: &str| {
        let branch = "mill 0,0 20,0\nmill 20,0 20,8 \"N1\"\nturn 20,8.02";
        let found = compile(&path(P, &format!("{branch}\n{drawn}"))).found;
        found.iter().map(|found| found.text(pathbuild_diagnostic::Lang::En)).collect::<Vec<_>>()
    };
    let tip = |left: usize| {
        format!(
            "the path breaks off here, at the tip of a dead end: the turn marker at (20, 8.02) is 0.02 mm away; segments not reached: {left}"
        )
    };
    assert_eq!(told("mill 20,0 50,0\nend 50,0"), [tip(1)]);
    let twice = told("mill 0,0 20,0\nmill 20,0 50,0\nend 50,0");
    assert_eq!(twice[0], tip(2));
    assert!(twice.len() == 2 && twice[1].contains("is drawn twice"), "{twice:?}");
    let gap = told("mill 20,0 50,0\nmill 50.1,0 60,0\nend 60,0");
    assert_eq!(gap, [tip(2), "the path breaks off here; segments not reached: 1".to_owned()]);
}

#[test]
fn a_segment_beside_the_way_back_is_named() {
    let notes = |gap: f64| {
        let x = 20.0 + gap;
        notes_of(&format!("mill 0,0 20,0 20,10\nmill {x},0 40,0\nturn 20,10\nend 40,0"))
    };
    assert_eq!(
        notes(0.25),
        [
            "a milling segment ends at (20.25, 0), 0.25 mm away from the way back, on which the ends must meet exactly: `join-tolerance` does not apply there"
        ]
    );
    assert!(notes(1.25)[0].starts_with("the nearest open end"));
}
