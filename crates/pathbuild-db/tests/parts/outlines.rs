//! Tests reading outlines: which elements join, which are dropped, which are doubtful.

use crate::{codes, messages};

/// Returns a path along the lower edge of a plate from (0, 1) to (40, 20), with this outline of the plate.
fn beside(outline: &str) -> String {
    format!("layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 S5\"\nmill 0,0 40,0\nend 40,0\nlayer Part\n{outline}\n")
}

const SIDES: &str = "line 40,1 40,20\nline to 0,20\nline to 0,1";

#[test]
fn curves_join_within_a_hundredth() {
    assert_eq!(codes(&beside(&format!("line 0.009,1 40,1\n{SIDES}"))), [""; 0]);
    let found = messages(&beside(&format!("line 0.011,1 40,1\n{SIDES}")));
    assert!(
        found[0].starts_with("PB219 the outline of the part has a gap")
            && ["(0, 1)", "(0.011, 1)", "0.011 mm"].iter().all(|part| found[0].contains(part)),
        "{found:?}"
    );
}

/// A gap may be up to a tenth of the drawn outline, which is 118 mm less the gap; threads and letters have larger gaps.
#[test]
fn a_gap_is_named_up_to_a_tenth_of_the_outline() {
    let gap = |x: f64| messages(&beside(&format!("line {x},1 40,1\n{SIDES}")));
    for x in [0.49, 0.51, 10.7] {
        let found = gap(x);
        let shown = format!("({x}, 1)");
        assert!(found.len() == 1 && found[0].contains("gap") && found[0].contains(&shown), "{found:?}");
    }
    let far = gap(10.8);
    assert!(far.len() == 1 && far[0].contains("no closed outline"), "{far:?}");
}

const CIRCLE: &str = "circle 20,10 d 5";

/// The hole of an open outline is not a part, so nothing is reported about it.
#[test]
fn a_hole_in_an_open_outline_is_no_part() {
    let with_hole = |lines: &str| messages(&beside(&format!("{lines}\n{SIDES}\n{CIRCLE}")));
    for x in [0.3, 0.51, 5.0, 25.0] {
        let found = with_hole(&format!("line {x},1 40,1"));
        assert!(found.len() == 1 && found[0].starts_with("PB219"), "{x}: {found:?}");
        assert!(
            ["gap", "(0, 1)", &format!("({x}, 1)")].iter().all(|part| found[0].contains(part)),
            "{found:?}"
        );
    }
    let found = with_hole("line 0.3,1 20,1\nline 20.3,1 40,1");
    assert_eq!(found.len(), 2, "both gaps: {found:?}");
    let found = with_hole("line 0,1 40,1");
    assert!(found.len() == 1 && found[0].starts_with("PB220"), "closed: {found:?}");
}

/// A bend line closes one half of a plate that has a gap in its outline. That half is not the part.
#[test]
fn a_line_that_closes_half_of_an_open_outline_makes_no_part() {
    let rest = "line 40,20 0,20\nline to 0,1\nline 0,1 40,1\nline 0,1 40,20";
    let plate =
        |right: &str| messages(&beside(&format!("{rest}\n{right}\ncircle 10,15 d 3\ncircle 30,5 d 3")));
    let whole = plate("line 40,1 40,20");
    assert!(whole.len() == 2 && whole.iter().all(|found| found.starts_with("PB220")), "{whole:?}");
    // A tenth of the open half may be missing.
    for (from, to) in [("9", "9.3"), ("9", "11"), ("5", "10.3"), ("1", "3"), ("18", "20"), ("18", "19.9")] {
        let right = format!("line 40,1 40,{from}\nline 40,{to} 40,20");
        let found = plate(&right.replace("line 40,1 40,1\n", "").replace("\nline 40,20 40,20", ""));
        assert!(found.len() == 1 && found[0].contains("gap"), "{from} {to}: {found:?}");
    }
    let far = plate("line 40,1 40,5\nline 40,11 40,20");
    assert!(!far.iter().any(|found| found.contains("gap")), "{far:?}");
}

/// Lines that end near each other inside a part divide it, and do not bound it.
#[test]
fn a_gap_in_a_line_across_the_part_does_not_matter() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    assert_eq!(codes(&beside(&format!("{whole}\nline 0,1 20,10\nline 22,11 40,20"))), [""; 0]);
    assert_eq!(codes(&beside(&format!("{whole}\nline 0,1 38,19"))), [""; 0]);
}

#[test]
fn a_line_from_an_open_outline_to_its_hole_does_not_close_it() {
    let found = messages(&beside(&format!("line 2,1 40,1\n{SIDES}\n{CIRCLE}\nline 40,20 22.5,10")));
    assert!(found.len() == 1 && found[0].contains("gap"), "{found:?}");
}

#[test]
fn an_open_outline_beside_a_closed_one_leaves_that_alone() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    let other = "polyline 100,0 120,0 120,10 100,10 100,1\ncircle 110,5 d 4";
    let found = messages(&beside(&format!("{whole}\n{CIRCLE}\n{other}")));
    assert!(found.len() == 2 && found[0].contains("(100, 0)") && found[1].starts_with("PB220"), "{found:?}");
    let thread = "arc centre 20,10 r 4 from 0 to 270";
    let found = messages(&beside(&format!("{whole}\n{CIRCLE}\n{thread}")));
    assert!(found.len() == 1 && found[0].starts_with("PB220"), "{found:?}");
}

/// One side of the second outline is missing. Whether the rest is an outline shows in the cuts beside it.
#[test]
fn an_open_outline_that_is_cut_lacks_a_piece() {
    let sides = ["100,20 100,0", "100,0 140,0", "140,0 140,20", "140,20 100,20"];
    let found = |missing: usize, path: &str| {
        let lines = sides.iter().enumerate().filter(|(side, _)| *side != missing);
        let lines: Vec<String> = lines.map(|(_, line)| format!("line {line}")).collect();
        let first = beside(&format!("line 0,1 40,1\n{SIDES}"));
        let mut found = messages(&format!(
            "{first}{}\nlayer 1235.1P\nstart 99,-1 \"T2 O2 I1 B0 S5\"\n{path}",
            lines.join("\n")
        ));
        // The file's name does not include the second path.
        found.retain(|found| !found.starts_with("PB521"));
        found
    };
    let around = |aside: f64| {
        let [left, right, low, high] = [100.0 - aside, 140.0 + aside, -aside, 20.0 + aside];
        format!(
            "sweep 99,-1 {left},{low}\nmill {left},{low} {right},{low}\nmill to {right},{high}\nmill to {left},{high}\nmill to {left},{}\nend {left},{}",
            low + 1.0,
            low + 1.0
        )
    };
    for missing in 0..4 {
        for aside in [1.05, 1.7] {
            let found = found(missing, &around(aside));
            assert!(
                found.len() == 1 && found[0].starts_with("PB219 the outline of the part has a gap"),
                "{missing} {aside}: {found:?}"
            );
        }
        // Nearer to the line, or farther away, than a cut beside the edge of a part.
        for aside in [0.2, 1.8] {
            assert_eq!(found(missing, &around(aside)), [""; 0], "{missing} {aside}");
        }
    }
    // A cut beside one side only.
    assert_eq!(found(3, "mill 99,-1 99,21\nend 99,21"), [""; 0]);
}

/// The arc that closes a lug is missing, so that the line across the gap runs through its hole.
#[test]
fn the_hole_of_a_lug_without_its_arc_is_no_part() {
    let lug = "line 10,19 30,19\nline 30,19 30,1\nline 30,1 10,1\ncircle 10,10 d 5";
    let path = "layer 1234.1P\nstart 31,0 \"T2 O2 I1 B0 S5\"\nmill 31,0 31,20\nmill to 10,20\nmill arc centre 10,10 r 10 from 90 to 270\nmill to 31,0\nsweep 31,0 10,10\nmill circle 10,10 d 5\nend 10,10\n";
    let found = messages(&format!("{path}layer Part\n{lug}\n"));
    assert!(
        found.len() == 1
            && found[0].starts_with("PB219")
            && found[0].contains("(10, 19)")
            && found[0].contains("(10, 1)"),
        "{found:?}"
    );
    let whole = messages(&format!("{path}layer Part\n{lug}\narc centre 10,10 r 9 from 90 to 270\n"));
    assert!(whole.iter().all(|found| found.starts_with("PB217")), "{whole:?}");
}

/// The ends of two sides of a rectangle are too long and cross each other.
#[test]
fn overlong_ends_are_a_crossing_and_no_gap() {
    for over in [0.3, 2.0] {
        let lines = format!("line -{over},1 40,1\nline 40,1 40,20\nline to 0,20\nline to 0,{}", 1.0 - over);
        for hole in ["", CIRCLE] {
            let found = messages(&beside(&format!("{lines}\n{hole}")));
            assert!(
                found.len() == 1
                    && found[0].starts_with("PB219")
                    && found[0].contains("crosses itself at (0, 1)"),
                "{over}: {found:?}"
            );
        }
    }
}

#[test]
fn an_outline_in_the_shape_of_an_eight_crosses_itself() {
    // The two halves of the figure have the same area, or one half is larger.
    for right in ["40,20 40,1", "40,24 40,1"] {
        let found = messages(&beside(&format!("polyline 0,1 {right} 0,20 closed\ncircle 5,10 d 2")));
        assert!(found.len() == 1 && found[0].contains("crosses itself at ("), "{found:?}");
    }
}

/// Ends that touch a curve and arcs that run into lines do not cross.
#[test]
fn outlines_that_touch_themselves_do_not_cross() {
    let slot = "polyline 0,1 40,1 bulge 1 40,11 0,11 bulge 1 closed";
    assert_eq!(codes(&beside(slot)), [""; 0]);
    let touching = "polyline 0,1 40,1 40,20 20,1.02 0,20 closed";
    assert!(!codes(&beside(touching)).contains(&"PB219".to_owned()), "just inside");
    let crossing = messages(&beside(&touching.replace("1.02", "0.98")));
    assert!(crossing.iter().any(|found| found.contains("crosses itself")), "just outside: {crossing:?}");
}

/// A circle as the outer edge needs a path like any other edge.
#[test]
fn a_circle_may_be_a_rim() {
    let rim =
        |diameter: f64| codes(&beside(&format!("circle 20,{} d {diameter}\n{CIRCLE}", 1.0 + diameter / 2.0)));
    assert_eq!(rim(30.0), ["PB215", "PB220"], "the hole");
    let far = messages(&beside("circle 20,40 d 60\ncircle 20,40 d 5"));
    assert_eq!(far.iter().filter(|found| found.starts_with("PB220")).count(), 2, "{far:?}");
}

#[test]
fn a_circle_across_the_rim_is_neither_opening_nor_part() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    let with = |circle: &str| messages(&beside(&format!("{whole}\n{circle}")));
    for circle in ["circle 0,10 d 4", "circle 40,10 d 4"] {
        let found = with(circle);
        assert!(
            found.len() == 1 && found[0].contains("crosses or overlaps the rim of the part at ("),
            "{found:?}"
        );
    }
    let inside = with("circle 2,10 d 4");
    assert!(inside.len() == 1 && inside[0].starts_with("PB220"), "it touches: {inside:?}");
}

/// A copy that slipped along one of its sides overlaps the outline without crossing it. It is the copy that is left out, so nothing else is reported.
#[test]
fn a_copy_that_overlaps_the_outline_is_doubtful() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    let with = |x: f64| {
        let (left, right) = (x, x + 40.0);
        messages(&beside(&format!("{whole}\npolyline {left},1 {right},1 {right},20 {left},20 closed")))
    };
    for x in [0.011, 0.3, -0.3, 20.0] {
        let found = with(x);
        assert!(
            found.len() == 1 && found[0].starts_with("PB219 this outline crosses or overlaps"),
            "{x}: {found:?}"
        );
    }
    assert_eq!(with(0.009), [""; 0]);
    let adjoining = with(40.0);
    assert!(
        !adjoining.iter().any(|found| found.starts_with("PB219")),
        "another part beside it: {adjoining:?}"
    );
    let inside = messages(&beside(&format!("{whole}\npolyline 10,1 30,1 30,10 10,10 closed")));
    assert!(!inside.iter().any(|found| found.starts_with("PB219")), "it touches the rim: {inside:?}");
}

/// A copy of two holes slipped. Where circles overlap, there are no inner corners.
#[test]
fn overlapping_openings_have_no_corners() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    let holes = |x: f64| format!("circle {x},10 d 5\ncircle {},10 d 5", x + 20.0);
    let drawing = beside(&format!("{whole}\n{}\n{}", holes(10.0), holes(10.3))).replace(
        "mill 0,0 40,0",
        "mill 0,0 40,0\nsweep 40,0 10,10\nmill circle 10,10 d 5\nsweep 10,10 30,10\nmill circle 30,10 d 5\n\
         sweep 30,10 40,0",
    );
    let found = codes(&drawing);
    assert!(!found.contains(&"PB216".to_owned()), "{found:?}");
}

#[test]
fn dangling_lines_and_lines_across_the_part_are_dropped() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    assert_eq!(codes(&beside(&format!("{whole}\nline 40,1 60,1\nline 40,20 60,30"))), [""; 0], "dangling");
    assert_eq!(codes(&beside(&format!("{whole}\nline 0,1 40,20"))), [""; 0], "a bend line");
    assert_eq!(codes(&beside(&format!("{whole}\nline 0,1 40,1"))), [""; 0], "drawn twice");
}

#[test]
fn a_line_between_two_rings_is_dropped() {
    let drawing =
        beside(&format!("line 0,1 40,1\n{SIDES}\npolyline 10,5 20,5 20,10 10,10 closed\nline 0,1 10,5"));
    assert_eq!(codes(&drawing), ["PB220"]);
}

#[test]
fn other_line_types_and_texts_do_not_count() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    let others = "line CENTER 10,1 10,20\ncircle HIDDEN 20,10 d 5\ntext 5,5 \"12 H7\"";
    assert_eq!(codes(&beside(&format!("{whole}\n{others}"))), [""; 0]);
    let found = messages(&beside("polyline HIDDEN 0,1 40,1 40,20 0,20 closed"));
    assert!(found.len() == 1 && found[0].contains("no closed outline"), "{found:?}");
}

#[test]
fn curves_that_cannot_be_read_are_doubtful() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    let found = messages(&beside(&format!("{whole}\nellipse centre 20,10 major 5,0 ratio 0.5")));
    assert!(found.len() == 1 && found[0].starts_with("PB219 this ELLIPSE"), "{found:?}");
}

#[test]
fn a_line_type_may_be_that_of_the_layer() {
    let whole = "line BYLAYER 0,1 40,1\nline BYLAYER to 40,20\nline BYLAYER to 0,20\nline BYLAYER to 0,1";
    let other = |line_type: &str| beside(whole).replace("layer Part", &format!("layer Part {line_type}"));
    assert_eq!(messages(&other("CONTINUOUS")), [""; 0]);
    assert!(messages(&other("HIDDEN"))[0].contains("no closed outline"));
}

/// An annotation is ignored, but a curve that cannot be read is doubtful.
#[test]
fn annotations_do_not_count() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    let raw = |kind: &str| format!("{whole}\nraw\n0 {kind}\n8 Part\n10 5\n20 5\n11 9\n21 9\nendraw");
    for kind in ["HATCH", "DIMENSION", "LEADER", "POINT"] {
        assert_eq!(messages(&beside(&raw(kind))), [""; 0], "{kind}");
    }
    assert_eq!(codes(&beside(&raw("REGION"))), ["PB219"]);
}

#[test]
fn blocks_are_expanded() {
    let block = format!("layer Part\nblock Plate\nline 0,0 40,0\n{}\nendblock\n", "line 40,0 40,19 0,19 0,0");
    let drawing = |at: &str| block.clone() + &beside(&format!("insert Plate at {at}"));
    assert_eq!(messages(&drawing("0,1")), [""; 0]);
    assert_eq!(codes(&drawing("0,0.9")), ["PB213"]);
}

/// Four lines that are all too long form an outline between their crossings, unless too much of their length lies beyond the crossings.
#[test]
fn lines_that_overshoot_all_corners_form_an_outline() {
    let with_hole = |over: f64| {
        let [left, right, low, high] = [-over, 40.0 + over, 1.0 - over, 20.0 + over];
        let lines = [
            format!("line {left},1 {right},1"),
            format!("line 40,{low} 40,{high}"),
            format!("line {left},20 {right},20"),
            format!("line 0,{low} 0,{high}"),
        ];
        messages(&beside(&format!("{}\n{CIRCLE}", lines.join("\n"))))
    };
    // The outline is 118 mm long, and eight ends of `over` mm are beyond its corners.
    for over in [0.6, 1.6] {
        let found = with_hole(over);
        assert!(found.len() == 1 && found[0].starts_with("PB219"), "{over}: {found:?}");
        assert!(found[0].contains("crosses itself at ("), "{over}: {found:?}");
    }
    let far = with_hole(1.7);
    assert!(far.len() == 1 && far[0].starts_with("PB220"), "{far:?}");
}

#[test]
fn a_hidden_layer_of_parts_counts() {
    let whole = beside(&format!("line 0,1 40,1\n{SIDES}"));
    assert_eq!(codes(&whole), [""; 0]);
    let found = messages(&whole.replace("layer Part\n", "layer Part frozen\n"));
    assert_eq!(
        found,
        ["PB112 layer Part is frozen or off, but paths are still compared with the parts on it"]
    );
}
