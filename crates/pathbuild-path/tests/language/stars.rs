//! Tests the order of segments that meet at a point. (book: language/chains-and-passes)

use crate::support::{items, path, wrong};

const P: &str = "T5 O3 I1 B0 D2 Mx";

fn walked(statements: &str) -> Vec<String> {
    items(&path(P, statements))
}

/// At (40, 0), the hole comes first, then the helical circles from the inside out, then the line.
#[test]
fn holes_come_before_helical_circles_and_those_from_the_inside_out() {
    let statements =
        "sweep 0,0 40,0\ncircle 40,0 d 10\ncircle 40,0 d 8\ncircle 40,0 d 3\nmill 40,0 60,0\nend 60,0";
    assert_eq!(walked(statements)[1..], ["hole 40,0", "helix 40,0 r4", "helix 40,0 r5", "[40,0 60,0]"]);
}

/// A hole has the order -1000000, which is below any practical N; a smaller N comes first.
#[test]
fn orders_decide_first() {
    let star = |first: &str, second: &str| {
        let statements = format!(
            "mill 40,0 60,0 60,20 40,0 {first}\nsubpath 40,0 20,20 {second}\nsweep 20,20 40,0\nsweep 0,0 40,0\nsweep 40,0 90,0 \"N9999\"\nend 90,0"
        );
        walked(&statements)[1].split(' ').next().unwrap().to_owned()
    };
    assert_eq!(star("", "\">1111.1P N2\""), "subpath");
    assert_eq!(star("\"N1\"", "\">1111.1P N2\""), "[40,0");
    assert_eq!(star("\"N2\"", "\">1111.1P N2\""), "subpath");
    assert_eq!(star("\"N3\"", "\">1111.1P N2\""), "subpath");
}

/// The default order is 9998: before 9999, after 9997.
#[test]
fn unnumbered_segments_have_the_order_9998() {
    let first = |statements: &str| {
        walked(&format!("{statements}\nend 0,0"))[0].split(", ").next().unwrap().to_owned()
    };
    // With equal orders, shorter segments would come first, and milled ones before sweeps.
    assert_eq!(first("mill 0,0 40,0 0,0 \"N9997\"\nmill 0,0 20,20 0,0"), "[0,0 40,0");
    assert_eq!(first("mill 0,0 10,0 0,0 \"N9999\"\nmill 0,0 20,20 0,0"), "[0,0 20,20");
    assert_eq!(first("mill 0,0 10,0 0,0 \"N9999\"\nline HIDDEN 0,0 20,20 0,0"), "sweep 0,0 20,20");
}

#[test]
fn subpaths_come_before_what_is_milled_and_that_before_sweeps() {
    let loops = "line DASHED 0,0 0,10 0,0\nmill 0,0 10,0 0,0\nsubpath 0,0 30,0 \">1111.1P\"\nline HIDDEN 30,0 0,0\nend 0,0";
    let walked = walked(loops);
    assert_eq!(walked[0], "subpath 0,0 30,0");
    assert!(walked[2].starts_with("[0,0 10,0"), "{walked:?}");
    assert!(walked[3].starts_with("sweep 0,0 0,10"), "{walked:?}");
    // Marks and bars are milled like other segments.
    let marks = "line DASHED 0,0 0,10 0,0\nmark 0,0 10,0 0,0\nend 0,0";
    assert!(self::walked(marks)[0].starts_with("[0,0 10,0"));
}

#[test]
fn the_shorter_comes_first_and_the_first_on_a_tie() {
    let first = |statements: &str| {
        walked(&format!("{statements}\nend 0,0"))[0].split(", ").next().unwrap().to_owned()
    };
    assert_eq!(first("mill 0,0 20,0 0,0\nmill 0,0 0,19.9 0,0"), "[0,0 0,19.9");
    assert_eq!(first("mill 0,0 20,0 0,0\nmill 0,0 0,20.1 0,0"), "[0,0 20,0");
    // Lengths that differ by at most one part in a million are equal.
    assert_eq!(first("mill 0,0 20,0 0,0\nmill 0,0 0,19.99999 0,0"), "[0,0 20,0");
    assert_eq!(first("mill 0,0 20,0 0,0\nmill 0,0 0,19.9999 0,0"), "[0,0 0,19.9999");
}

#[test]
fn the_length_of_an_arc_is_its_chord() {
    let statements = "mill arc 0,0 20,0 r 10\nmill 20,0 0,0\nmill 0,0 0,25 0,0\nend 0,0";
    assert!(walked(statements)[0].starts_with("[0,0 20,0"));
}

/// Equal segments are ordered as circles, lines, arcs, and not in file order.
#[test]
fn lines_come_before_arcs_on_a_tie() {
    let statements = "mill arc 0,0 20,0 r 10 cw\nmill 20,0 0,0 \"F7\"\nend 0,0";
    let compiled = crate::support::compile(&path(P, statements));
    let pathbuild_path::Item::Chain(chain) = &compiled.walked.items[0] else { panic!() };
    assert_eq!(compiled.walked.members(chain)[0].cut(compiled.path.as_ref().unwrap()).feed, Some(7.0));
}

/// A single candidate is always taken, whatever its order.
#[test]
fn a_number_matters_only_at_a_star() {
    assert_eq!(walked("mill 0,0 20,0 \"N9\"\nmill 20,0 40,0 \"N1\"\nend 40,0"), ["[0,0 20,0, 20,0 40,0]"]);
    assert_eq!(wrong(&path(P, "mill 0,0 20,0 \"N9\"\nmill 20,0 40,0 \"N1\"\nend 40,0")), [""; 0]);
}

/// N is compared exactly: with a tolerance, orders at the limit of precision would be equal.
#[test]
fn orders_compare_exactly() {
    let star = |number: &str| {
        let statements =
            format!("mill 0,0 40,0 0,0 \"N1000000000000\"\nmill 0,0 20,20 0,0 \"N{number}\"\nend 0,0");
        walked(&statements)[0].split(", ").next().unwrap().to_owned()
    };
    assert_eq!(star("1000000000001"), "[0,0 40,0");
    assert_eq!(star("999999999999"), "[0,0 20,20");
}
