//! Tests the walk from the start to the end. (book: language/chains-and-passes)

use pathbuild_diagnostic::Lang;

use crate::support::{codes, compile, compile_raw, items, items_of, language, path, raw, wrong};
use pathbuild_path::{Bindings, Curve, Xy};

const P: &str = "T5 O3 I1 B0 D2";

/// Returns the findings about a path with these statements, and the sentences of their help.
fn found(statements: &str) -> (Vec<String>, Vec<String>) {
    let compiled = compile(&path(P, statements));
    let notes = compiled.found.iter().flat_map(|found| &found.notes);
    (codes(&compiled.found), notes.map(|note| note.text(Lang::En)).collect())
}

fn codes_of(statements: &str) -> Vec<String> {
    found(statements).0
}

#[test]
fn segments_follow_each_other_whatever_way_they_are_drawn() {
    let lines = "mill 40,0 40,20\nmill 0,0 20,0\nmill 40,0 20,0\nend 40,20";
    assert_eq!(items(&path(P, lines)), ["[0,0 20,0, 20,0 40,0, 40,0 40,20]"]);
}

#[test]
fn an_arc_is_turned_round_with_its_direction() {
    let arc = |statement: &str| {
        let compiled = compile(&path(P, &format!("{statement}\nend 20,0")));
        let Curve::Arc(arc) = compiled.first_chain()[0] else { panic!() };
        (arc.clockwise, arc.degrees.round())
    };
    assert_eq!(arc("mill arc centre 10,0 r 10 from 180 to 0"), (false, 180.0));
    assert_eq!(arc("mill arc centre 10,0 r 10 from 0 to 180"), (true, 180.0));
}

/// Among equally long segments, lines come before arcs, whatever their places in the file.
#[test]
fn a_line_comes_before_an_equally_long_arc() {
    let is_line = |statements: &str| {
        let compiled = compile(&path(P, &format!("{statements}\nend 0,0")));
        matches!(compiled.first_chain()[0], Curve::Line(_))
    };
    let arc = "mill arc centre 10,0 r 10 from 180 to 0";
    assert!(is_line(&format!("mill 0,0 20,0\n{arc}")));
    assert!(is_line(&format!("{arc}\nmill 0,0 20,0")));
    // A longer line comes after the arc.
    assert!(!is_line("mill arc centre 9.99,0 r 9.99 from 180 to 0\nmill 0,0 20,0\nmill 20,0 19.98,0"));
}

/// Points coincide if the square of their distance is near 0: within 0.0000316 mm.
#[test]
fn ends_that_nearly_meet_do() {
    assert_eq!(codes_of("mill 0,0 20,0\nmill 20.000031,0 40,0\nend 40,0"), [""; 0]);
    assert_eq!(codes_of("mill 0,0 20,0\nmill 20.000032,0 40,0\nend 40,0"), ["PB401"]);
    assert_eq!(codes_of("mill 0.000031,0 20,0\nend 20,0"), [""; 0]);
    assert_eq!(codes_of("mill 0.000032,0 20,0\nend 20,0"), ["PB401"]);
    assert_eq!(codes_of("mill 0,0 20,0\nend 20.000031,0"), [""; 0]);
    assert_eq!(codes_of("mill 0,0 20,0\nend 20.000032,0"), ["PB403"]);
    // The ends differ in X and Y.
    assert_eq!(codes_of("mill 0,0 20,0\nmill 20.00002,0.00002 40,0\nend 40,0"), [""; 0]);
    assert_eq!(codes_of("mill 0,0 20,0\nmill 20.00003,0.00002 40,0\nend 40,0"), ["PB401"]);
}

/// The grid of squares must not separate two ends that nearly meet.
#[test]
fn ends_that_nearly_meet_do_wherever_they_are() {
    for step in 0..510 {
        let (x, y) = (20.0 + 0.00002 * f64::from(step), -5.0 - 0.00002 * f64::from(step));
        let (near_x, near_y) = (x + 0.00002, y - 0.00002);
        let lines = format!("mill 0,0 {x:.5},{y:.5}\nmill {near_x:.5},{near_y:.5} 40,0\nend 40,0");
        assert_eq!(codes_of(&lines), [""; 0], "{lines}");
    }
}

#[test]
fn nothing_continues_names_the_nearest_open_end() {
    let (codes, notes) = found("mill 0,0 20,0\nmill 20.5,0 40,0\nmill 60,0 50,0\nend 40,0");
    assert_eq!(codes, ["PB401", "PB402"]);
    assert_eq!(notes, ["the nearest open end is at (20.5, 0), 0.5 mm away (a milling segment)"]);
}

/// A corner of a closed outline is no open end, but holes and sweeps that meet are, and within 1 mm a corner is as well.
#[test]
fn open_ends_come_before_corners() {
    let nearest = |corner: &str, inner: &str| {
        let outline = format!("bars 50,40 {corner} 60,-9 50,40 \"P4 U10\"");
        let (codes, notes) = found(&format!("{inner}\n{outline}\nend 50,40"));
        assert_eq!(codes[0], "PB401");
        notes[0].clone()
    };
    let inner = "circle 20,10 d 3\nsweep 20,10 50,40";
    assert_eq!(
        nearest("-2,-2", inner),
        "the nearest open end is at (20, 10), 22.361 mm away (a drilled hole)"
    );
    assert_eq!(
        nearest("-2,-2", "sweep 20,10 50,40"),
        "the nearest open end is at (20, 10), 22.361 mm away (a sweep)"
    );
    let corner = nearest("-0.6,-0.6", inner);
    assert!(corner.starts_with("the nearest open end is at (-0.6, -0.6), 0.849 mm away"), "{corner}");
    // Without an open end, the nearest corner is named.
    let corner = nearest("-2,-2", "line HIDDEN 0,0 -4,-2");
    assert!(corner.starts_with("the nearest open end is at (-2, -2), 2 mm away"), "{corner}");
}

/// A path continues only at ends. It is told so where it meets a line in the middle.
#[test]
fn a_path_that_ends_in_the_middle_of_a_segment_must_split_it() {
    let said = |end: &str, drawn: &str| {
        let compiled = compile(&path("T5 O3 I1 B0 D2 P4 U10", &format!("{drawn}\nend {end}")));
        let problem = compiled.found.iter().find(|found| found.is_error()).expect("an error");
        format!("{} {}: {}", problem.code(), problem.text(Lang::En), problem.help(Lang::En).unwrap())
    };
    let outline = "line HIDDEN 0,0 20,20\nbars 20,10 20,30 40,30 40,10 20,10";
    assert!(
        said("20,30", outline)
            .starts_with("PB401 the path breaks off here, in the middle of a segment with support bars")
    );
    assert!(said("20,30", outline).contains("split that line or arc into two at (20, 20)"));
    let at_end = said("20,20", outline);
    assert!(
        at_end.starts_with("PB402 the path ends here, in the middle of a segment with support bars"),
        "{at_end}"
    );
    // Within 1 mm of its end, the path has a gap.
    let near =
        |y: &str| said("20,30", &format!("line HIDDEN 0,0 20,{y}\nbars 20,10 20,30 40,30 40,10 20,10"));
    assert!(near("28.99").contains("in the middle of"), "{}", near("28.99"));
    assert!(near("29").contains("breaks off here; segments not reached"), "{}", near("29"));
    // An arc, and a line that the path misses by more than can be seen.
    let arc = "line HIDDEN 0,0 20,20\nmill arc centre 20,10 r 10 from 0 to 180";
    assert!(said("10,10", arc).contains("in the middle of a milling segment"), "{}", said("10,10", arc));
    let beside = "line HIDDEN 0,0 19.99,20\nbars 20,10 20,30 40,30 40,10 20,10";
    assert!(
        said("20,30", beside).contains("breaks off here; segments not reached"),
        "{}",
        said("20,30", beside)
    );
    // A subpath cannot be split.
    let subpath = "line HIDDEN 0,0 20,20\nsubpath 20,10 20,30 \">1111.1P\"";
    assert!(!said("20,30", subpath).contains("in the middle"), "{}", said("20,30", subpath));
}

#[test]
fn a_duplicate_is_named() {
    let twice = "mill 0,0 20,0\nmill 20,0 40,0\nmill 20,0 0,0\nend 40,0";
    let (codes, notes) = found(twice);
    assert_eq!((codes, notes), (vec!["PB402".to_owned()], Vec::<String>::new()));
    let [problem] = &compile(&path("T5 O3 I1 B0", twice)).found[..] else { panic!() };
    assert!(problem.text(Lang::En).starts_with("a milling segment at (20, 0) is drawn twice"));
    // An arc between the same points is a different segment.
    let (codes, notes) =
        found("mill 0,0 20,0\nmill 20,0 40,0\nmill arc 40,0 60,0 r 10\nmill 60,0 80,0\nend 40,0");
    assert_eq!((codes.len(), notes.len()), (1, 0));
}

#[test]
fn segments_that_are_left_over_at_the_end_are_counted() {
    let compiled = compile(&path(P, "mill 0,0 20,0\nmill 0,40 20,40\nmill 0,60 20,60\nend 20,0"));
    assert_eq!(codes(&compiled.found), ["PB402"]);
    let text = compiled.found[0].text(Lang::En);
    assert_eq!(text, "the path ends here; segments not reached: 2, including a milling segment at (0, 40)");
}

#[test]
fn the_end_must_be_reached() {
    assert_eq!(codes_of("mill 0,0 20,0\nend 20,0"), [""; 0]);
    assert_eq!(codes_of("mill 0,0 20,0\nend 30,0"), ["PB403"]);
    // PB401 has the same cause, so nothing else is reported.
    assert_eq!(codes_of("mill 0,0 20,0\nmill 30,0 40,0\nend 50,0"), ["PB401"]);
}

#[test]
fn the_walk_passes_the_end_as_long_as_something_continues() {
    let lines = "mill 0,0 20,0\nmill 20,0 20,20\nmill 20,20 0,0\nmill 0,0 20,20 \"N9999\"\nend 20,20";
    // Two of the lines coincide.
    assert_eq!(codes_of(lines), ["PB116", "PB121"]);
    assert_eq!(items(&path(P, "mill 0,0 20,0\nmill 20,0 40,0\nmill 40,0 20,0.0\nend 20,0")).len(), 1);
}

#[test]
fn a_path_has_segments() {
    assert_eq!(codes_of("end 20,0"), ["PB404"]);
    assert_eq!(codes_of("probe 20,20\nend 0,0"), ["PB404"]);
    assert_eq!(codes_of("circle 0,0 d 3\nend 0,0"), [""; 0]);
}

#[test]
fn a_closed_path_ends_where_it_starts() {
    assert_eq!(codes_of("mill 0,0 20,0 20,20 0,0\nend 0,0"), [""; 0]);
}

/// Without a tolerance no ends are joined; with one, the nearest ends are, each with a warning.
#[test]
fn ends_within_the_tolerance_are_joined() {
    let raw = raw(&path(P, "mill 0,0 20,0\nmill 20.01,0 40,0\nend 40.01,0"));
    let found = |join_tolerance| {
        let compiled = compile_raw(
            &raw,
            &Bindings::default(),
            &pathbuild_path::Language { join_tolerance, ..language() },
        );
        codes(&compiled.found)
    };
    assert_eq!(found(0.0), ["PB401", "PB403"]);
    assert_eq!(found(0.009), ["PB401", "PB403"]);
    assert_eq!(found(0.011), ["PB115", "PB115"]);
}

/// An arc keeps its centre and radius and gets a short line that leads to it. Lines are extended.
#[test]
fn a_joined_arc_stays_where_it_is() {
    let joined = |drawn: &str| {
        let language = pathbuild_path::Language { join_tolerance: 0.02, ..language() };
        compile_raw(&raw(&path(P, drawn)), &Bindings::default(), &language)
    };
    let compiled =
        joined("mill 0,0 20,0\nmill arc centre 25.01,0 r 5 from 90 to 180\nmill 25.01,5 40,5\nend 40,5");
    assert_eq!(codes(&compiled.found), ["PB115"]);
    let chain = compiled.first_chain();
    let [Curve::Line(line), Curve::Line(lead), Curve::Arc(arc), Curve::Line(_)] = chain[..] else {
        panic!("{chain:?}")
    };
    assert_eq!((line.end, lead.start, lead.end), (Xy::new(20.0, 0.0), Xy::new(20.0, 0.0), arc.start));
    assert_eq!((arc.centre, arc.radius, arc.end), (Xy::new(25.01, 0.0), 5.0, Xy::new(25.01, 5.0)));
    // The arc is retraced from a dead end.
    let compiled = joined("mill 0,0 20,0\nmill arc centre 25.01,0 r 5 from 90 to 180\nturn 25.01,5\nend 0,0");
    let ends: Vec<Xy> = compiled.first_chain().iter().map(Curve::end).collect();
    let tip = Xy::new(25.01, 5.0);
    let begin = Xy::new(20.01, 0.0);
    assert_eq!(ends.len(), 6, "{ends:?}");
    assert!((ends[2] - tip).norm() < 1e-9 && (ends[3] - begin).norm() < 1e-9, "{ends:?}");
    assert_eq!([ends[4], ends[5]], [Xy::new(20.0, 0.0), Xy::new(0.0, 0.0)]);
}

/// The line that leads into an arc is not a separate segment: the arc is the chain's first segment, which gives its letters.
#[test]
fn a_joined_arc_may_begin_a_chain() {
    let drawn = "sweep 0,0 20,0\nmill arc centre 25.01,0 r 5 from 90 to 180 \"I1\"\nend 25.01,5";
    let language = pathbuild_path::Language { join_tolerance: 0.02, ..language() };
    let compiled = compile_raw(&raw(&path("T5 O3 B0", drawn)), &Bindings::default(), &language);
    assert_eq!(codes(&compiled.found), ["PB115"]);
}

/// Returns the items of a path whose ends are joined within 0.05 mm, and the places of the joins.
fn joined_items(drawn: &str) -> (Vec<String>, Vec<String>) {
    let language = pathbuild_path::Language { join_tolerance: 0.05, ..language() };
    let compiled = compile_raw(&raw(&path(P, drawn)), &Bindings::default(), &language);
    let place = |found: &pathbuild_diagnostic::Diagnostic| {
        let point = found.place.point.expect("joins have a place");
        format!("{} {},{}", found.code(), point.x.0, point.y.0)
    };
    (items_of(&compiled), compiled.found.iter().map(place).collect())
}

/// Holes, circles and subpaths are not moved to the end of the line before them.
#[test]
fn joined_holes_circles_and_subpaths_stay_where_they_are() {
    let between =
        |drawn: &str| joined_items(&format!("line HIDDEN 0,0 10,0\n{drawn}\nmill 10.03,0 20,0\nend 20,0"));
    let (items, joins) = between("circle 10.03,0 d 3");
    assert_eq!(items, ["sweep 0,0 10,0", "sweep 10,0 10.03,0", "hole 10.03,0", "[10.03,0 20,0]"]);
    assert_eq!(joins, ["PB115 10.03,0"]);
    let (items, _) = between("circle 10.03,0 d 8");
    assert_eq!(items[1..3], ["sweep 10,0 10.03,0", "helix 10.03,0 r4"]);
    let (items, _) =
        joined_items("mill 0,0 10,0\nsubpath 10.03,0 15,0 \">1111.1P\"\nmill 15,0 20,0\nend 20,0");
    assert_eq!(items[1..3], ["sweep 10,0 10.03,0", "subpath 10.03,0 15,0"]);
    // A hole on the line's end needs no sweep.
    let (items, joins) = joined_items("mill 0,0 10,0\ncircle 10,0 d 3\nmill 10,0 20,0\nend 20,0");
    assert_eq!(items, ["[0,0 10,0]", "hole 10,0", "[10,0 20,0]"]);
    assert!(joins.is_empty(), "{joins:?}");
    let (_, joins) = joined_items("mill 0,0 10,0\ncircle 10.051,0 d 3\nend 10.051,0");
    assert_eq!(joins[0], "PB401 10,0");
}

/// Each hole of a row is drilled at its own place.
#[test]
fn joins_do_not_add_up() {
    let (items, joins) =
        joined_items("mill 0,0 10,0\ncircle 10.04,0 d 3\ncircle 10.08,0 d 3\nmill 10.08,0 20,0\nend 20.04,0");
    assert_eq!(
        items,
        [
            "[0,0 10,0]",
            "sweep 10,0 10.04,0",
            "hole 10.04,0",
            "sweep 10.04,0 10.08,0",
            "hole 10.08,0",
            "[10.08,0 20,0]",
            "sweep 20,0 20.04,0"
        ]
    );
    assert_eq!(joins, ["PB115 10.04,0", "PB115 10.08,0", "PB115 20.04,0"]);
}

#[test]
fn a_curve_that_was_left_out_is_pointed_at() {
    let (codes, notes) = found(
        "mill 0,0 20,0\nellipse CONTINUOUS centre 30,0 major 10,0 ratio 0.5 from 180 to 360\nmill 40,0 60,0\nend 60,0",
    );
    assert_eq!(codes, ["PB111", "PB401"]);
    let is_pointed_at = |note: &String| note.starts_with("there is a curve at") && note.contains("(ELLIPSE)");
    assert!(notes.iter().any(is_pointed_at), "{notes:?}");
}

#[test]
fn a_path_is_walked_where_its_values_are_wrong() {
    assert_eq!(wrong(&path("T5 O3 I1", "mill 0,0 20,0\nend 90,0")), ["PB201 B", "PB403"]);
    assert_eq!(wrong(&path("T5 O3 I1", "mill 0,0 20,0\nend 20,0")), ["PB201 B"]);
}

/// A small gap leaves no doubt where the path continues.
#[test]
fn a_gap_does_not_hide_another_mistake() {
    let two = |gap: f64| {
        found(&format!("mill 0,0 20,0\nmill {x},0 40,0\nmill 41,0 60,0\nend 60,0", x = 20.0 + gap)).0
    };
    assert_eq!(two(0.5), ["PB401", "PB401"]);
    assert_eq!(two(1.0), ["PB401", "PB401"]);
    assert_eq!(two(1.01), ["PB401"]);
    assert_eq!(found("mill 0,0 20,0\nmill 20.5,0 40,0\ncircle 30,50 d 3\nend 40,0").0, ["PB401", "PB402"]);
    assert_eq!(found("mill 0,0 20,0\nmill 20.5,0 40,0\nend 60,0").0, ["PB401", "PB403"]);
    assert_eq!(found("mill 0,0 20,0\nmill 20.5,0 40,0\nend 40,0").0, ["PB401"]);
    // A line that is drawn in hundreds of pieces with gaps is one mistake.
    let pieces: Vec<String> = (0..200).map(|at| format!("mill {at},0 {at}.5,0\n")).collect();
    assert_eq!(found(&format!("{}end 199.5,0", pieces.concat())).0.len(), 11);
}

/// Returns code, text and help of the first finding about a path with these statements.
fn first(statements: &str) -> String {
    let compiled = compile(&path(P, statements));
    let found = &compiled.found[0];
    format!("{} {}; {}", found.code(), found.text(Lang::En), found.help(Lang::En).unwrap_or_default())
}

#[track_caller]
fn assert_first(statements: &str, begin: &str) {
    let first = first(statements);
    assert!(first.starts_with(begin), "{first}");
}

const DEAD_END: &str = "PB401 the path breaks off here, at the tip of a dead end; segments not reached: 1; draw the segment that is missing here; or, if";

/// The outline 20,0 40,0 40,20 20,20 20,0 that does not close is no dead end: nothing is to be milled there and back.
#[test]
fn a_gap_in_a_closed_outline_is_to_be_closed() {
    let outline = |last: &str| {
        format!("sweep 0,0 20,0\nmill 20,0 40,0 40,20 20,20 {last}\nsweep 20,0 60,-9\nend 60,-9")
    };
    let gap = "PB401 the path breaks off here; segments not reached: 1; close the gap";
    for last in ["20,0.2", "20,1", "20.0004,0", "20,0.00004"] {
        assert_first(&outline(last), gap);
    }
    assert_first(&outline("20,1.01"), DEAD_END);
    assert_first(&outline("20,15"), DEAD_END);
    // The path goes on elsewhere: only the beginning of the outline is near.
    let elsewhere = |gap: f64| {
        let last = 20.0 + gap;
        format!(
            "sweep 0,0 20,0\nmill 20,0 40,0 \"N1\"\nmill 40,0 40,20 20,20 20,{gap} {last},{gap}\nsweep 40,0 60,-9\nend 60,-9"
        )
    };
    assert_first(
        &elsewhere(0.5).replace("20,0.5 20.5,0.5", "20,0.5"),
        "PB401 the path breaks off here, 0.5 mm from (20, 0), where a sweep ends; segments not reached: 1; close the gap",
    );
    assert_first(&elsewhere(1.01).replace("20,1.01 21.01,1.01", "20,1.01"), DEAD_END);
}

/// The point where a short dead end begins is near its tip, but there is no gap.
#[test]
fn a_short_dead_end_is_no_gap() {
    let branch = |tip: &str| format!("mill 0,0 20,0\nmill 20,0 {tip}\nmill 20,0 40,0 \"N9999\"\nend 40,0");
    for tip in ["20,0.5", "20,1", "20,1.01"] {
        assert_first(&branch(tip), DEAD_END);
    }
}

/// A helper line at a corner is longer than a gap; its other end may be nearer to an end that the path has not reached yet.
#[test]
fn a_helper_line_is_a_dead_end_wherever_the_next_end_is() {
    assert_first(
        "mill 0,0 20,0\nmill 20,0 30,12\nmill 20,0 50,0 50,20\nend 50,20",
        &DEAD_END.replace('1', "2").replace("PB402", "PB401"),
    );
    // Without a branch that was passed, something is missing.
    assert_first(
        "mill 0,0 20,0\nmill 40,0 60,0\nend 60,0",
        "PB401 the path breaks off here; segments not reached: 1; close the gap, draw the missing segment",
    );
}

#[test]
fn a_line_that_is_too_long_is_to_end_at_the_next() {
    let next = |x: &str| format!("mill 0,0 20,0\nsubpath {x},0 {x},30 \">1111.1P\"\nend {x},30");
    for (x, distance) in [("19.998", "0.002"), ("19.995", "0.005"), ("19", "1")] {
        assert_first(
            &next(x),
            &format!(
                "PB401 the path breaks off here, {distance} mm past ({x}, 0), where a subpath begins; segments"
            ),
        );
    }
    assert_first(
        &next("18.99"),
        "PB401 the path breaks off here: a subpath begins at (18.99, 0), in the middle of",
    );
    // On the screen, both are at one point: a gap.
    assert_first(&next("19.9995"), "PB401 the path breaks off here; segments not reached: 1; close the gap");
    // It begins in the middle of the line before the last one.
    let beside = "mill 0,0 20,0\nmill 20,0 20,0.5\nmill 19.9,0 19.9,-30\nend 19.9,-30";
    assert_first(beside, "PB401 the path breaks off here; segments not reached: 1; close the gap");
}

/// A hole beside the ends of two sweeps, and on one of them.
#[test]
fn a_hole_beside_its_sweep_is_told_with_the_distance() {
    let hole = |at: &str| format!("sweep 0,0 20,0\nsweep 20,0 40,0\ncircle {at} d 8\nend 40,0");
    assert_eq!(codes_of(&hole("20.00003,0")), [""; 0]);
    for (at, point, distance) in [
        ("20,0.00004", "(20, 0.00004)", "0.00004"),
        ("20.0001,0", "(20.0001, 0)", "0.0001"),
        ("20,0.005", "(20, 0.005)", "0.005"),
        ("20,1", "(20, 1)", "1"),
        ("20.5,0", "(20.5, 0)", "0.5"),
    ] {
        let first = first(&hole(at));
        let text = format!(
            "is {distance} mm away from (20, 0), where a sweep ends; snap one of these ends to the other"
        );
        assert!(first.starts_with("PB402 segments not reached: 1; a helical circle at "), "{first}");
        assert!(first.contains(&text), "{point}: {first}");
    }
    assert_first(
        &hole("20,1.01"),
        "PB402 the path ends here; segments not reached: 1, including a helical circle",
    );
    assert_first(
        &hole("21.01,0"),
        "PB402 segments not reached: 1; a helical circle at (21.01, 0) touches a sweep",
    );
}

/// The tip of a short branch is near the path because it begins there.
#[test]
fn a_branch_that_is_passed_is_no_gap_however_short() {
    let branch =
        |tip: &str| format!("mill 0,0 20,0 \"N1\"\nmill 20,0 40,0 \"N2\"\nmill 20,0 {tip} \"N3\"\nend 40,0");
    for tip in ["20,0.5", "20,1", "20,5"] {
        assert_first(&branch(tip), "PB402 segments not reached: 1; the path went past (20, 0), where");
    }
    assert_first(
        &branch("40,0.5"),
        "PB402 segments not reached: 1; a milling segment at (40, 0.5) is 0.5 mm away from (40, 0)",
    );
}

#[test]
fn an_end_marker_beside_the_last_end_is_told_with_the_distance() {
    let ends = |x: &str| format!("mill 0,0 20,0\nend {x},0");
    for (x, distance) in [("20.00004", "0.00004"), ("20.2", "0.2"), ("21", "1"), ("19", "1")] {
        assert!(first(&ends(x)).contains(&format!(", {distance} mm away from its end marker")), "{x}");
    }
    assert_first(&ends("21.01"), "PB403 the path stops at (20, 0), but its end marker is at (21.01, 0)");
    // A short helper line behind the end marker.
    assert_first(
        "mill 0,0 20,0\nmill 20,0 20.5,0\nend 20,0",
        "PB403 the path runs past its end marker at (20, 0)",
    );
    // A closed outline with a gap.
    assert_first("mill 0,0 20,0 20,20 0,0.2\nend 0,0", "PB403 the path stops at (0, 0.2), 0.2 mm away");
}

/// A line or arc that lies on part of another one is neither a dead end nor a wrong end.
#[test]
fn a_part_that_is_drawn_twice_is_named() {
    let part =
        |code: &str, point: &str| format!("{code} a milling segment at {point} lies on part of a longer one");
    assert_first("mill 0,0 20,0\nmill 0,0 10,0\nend 20,0", &part("PB401", "(0, 0)"));
    assert_first("mill 0,0 20,0\nmill 5,0 15,0\nend 20,0", &part("PB402", "(5, 0)"));
    let back = first("mill 0,0 20,0\nmill 10,0 20,0\nend 20,0");
    assert!(back.starts_with("PB403 ") && back.contains("(10, 0) lies on part of a longer one"), "{back}");
    let arcs = "mill arc 0,0 to 20,0 centre 10,0\nmill arc 0,0 to 10,-10 centre 10,0\nend 20,0";
    assert_first(arcs, &part("PB401", "(0, 0)"));
    // Both have a text: that part is cut twice on purpose.
    assert_first("mill 0,0 20,0 \"B0\"\nmill 0,0 10,0 \"B1\"\nend 20,0", DEAD_END);
    // Beside it, on another kind of segment, and in another direction.
    assert_first("mill 0,0 20,0\nmill 0,0 10,0.001\nend 20,0", DEAD_END);
    assert_first("mill 0,0 20,0\nmill 0,0 10,0.0009\nend 20,0", &part("PB401", "(0, 0)"));
    assert_first("sweep 0,0 20,0\nmill 0,0 10,0\nend 20,0", DEAD_END);
    assert_first("mill 0,0 20,0\nmill 0,0 -10,0\nend 20,0", DEAD_END);
}

/// A path that stops beside its end marker does not break off. What is left over is told as it is at an exact end.
#[test]
fn an_end_marker_beside_the_end_is_named_together_with_leftovers() {
    let told = |end: f64, tolerance: f64, leftover: &str| {
        let language = pathbuild_path::Language { join_tolerance: tolerance, ..language() };
        let drawn = format!("mill 0,0 20,0\nmill 20,0 30,0\n{leftover}\nend 30,{end}");
        let compiled = compile_raw(&raw(&path(P, &drawn)), &Bindings::default(), &language);
        compiled
            .found
            .iter()
            .map(|found| format!("{} {}", found.code(), found.text(Lang::En)))
            .collect::<Vec<_>>()
    };
    let beside = "PB403 the path stops at (30, 0), 0.02 mm away from its end marker at (30, 0.02)";
    let leftovers = [
        (
            "mill 5,-20 8,-20",
            "PB402 the path ends here; segments not reached: 1, including a milling segment at (5, -20)",
        ),
        (
            "mill 0,0 20,0",
            "PB402 a milling segment at (0, 0) is drawn twice, but the path runs along only one of the two; segments not reached: 1",
        ),
        (
            "circle 20,0.01 d 3",
            "PB402 segments not reached: 1; a drilled hole at (20, 0.01) is 0.01 mm away from (20, 0), where a milling segment ends",
        ),
    ];
    for (leftover, problem) in leftovers {
        assert_eq!(told(0.02, 0.0, leftover), [beside, problem]);
        assert_eq!(told(0.0, 0.0, leftover), [problem]);
        let joined = told(0.02, 0.05, leftover);
        assert!(joined.len() == 2 && joined[0] == problem && joined[1].starts_with("PB115 "), "{joined:?}");
    }
    let breaks_off = "PB401 the path breaks off here; segments not reached: 1";
    assert!(told(1.0, 0.0, leftovers[0].0)[0].starts_with("PB403 "));
    assert_eq!(told(1.01, 0.0, leftovers[0].0), [breaks_off]);
    // The next segment is nearer than the end marker, or begins there.
    for end in [0.2, 0.5] {
        assert_eq!(told(end, 0.0, "mill 30,0.2 30,9")[0], breaks_off);
    }
}
