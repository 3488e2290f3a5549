//! Reading outlines: what joins, what is dropped, what is doubtful.

use crate::{codes, messages};

/// A path along the lower edge of the plate from (0, 1) to (40, 20).
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

#[test]
fn a_gap_is_named_up_to_half_a_millimetre() {
    let gap = |x: f64| messages(&beside(&format!("line {x},1 40,1\n{SIDES}")));
    assert!(gap(0.49).iter().any(|found| found.contains("gap")));
    let far = gap(0.51);
    assert!(far.iter().all(|found| !found.contains("gap")), "{far:?}");
    assert!(far.iter().any(|found| found.contains("no closed outline")), "{far:?}");
}

#[test]
fn dangling_lines_and_lines_across_the_part_are_dropped() {
    let whole = format!("line 0,1 40,1\n{SIDES}");
    assert_eq!(codes(&beside(&format!("{whole}\nline 40,1 60,1\nline 40,20 60,30"))), [""; 0], "dangling");
    assert_eq!(codes(&beside(&format!("{whole}\nline 0,1 40,20"))), [""; 0], "a bend line");
    assert_eq!(codes(&beside(&format!("{whole}\nline 0,1 40,1"))), [""; 0], "drawn twice");
}

/// A line from the rim to an opening belongs to neither.
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

/// An annotation says nothing, but a curve that cannot be read is doubtful.
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
