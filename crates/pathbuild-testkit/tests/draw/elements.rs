//! Tests the output of each statement of the text form.

use crate::records::{Record, entities, number, value};

fn only(text: &str) -> Record {
    let entities = entities(text);
    assert_eq!(entities.len(), 1, "{text}");
    entities[0].clone()
}

fn kinds(text: &str) -> Vec<String> {
    entities(text).iter().map(|record| record[0].1.clone()).collect()
}

fn line_type(text: &str) -> Option<String> {
    value(&only(text), 6).map(str::to_owned)
}

fn numbers(record: &Record, codes: &[i32]) -> Vec<f64> {
    codes.iter().map(|code| number(record, *code)).collect()
}

#[track_caller]
fn assert_arc(text: &str, centre: [f64; 2], radius: f64, angles: [f64; 2]) {
    let arc = only(text);
    assert_eq!(arc[0].1, "ARC");
    let expected = [centre[0], centre[1], radius, angles[0], angles[1]];
    for (found, expected) in numbers(&arc, &[10, 20, 40, 50, 51]).into_iter().zip(expected) {
        let apart = (found - expected).abs();
        assert!(apart.min((apart - 360.0).abs()) < 1e-9, "{text}: {found} is not {expected}");
    }
}

#[test]
fn markers_are_phantom_circles_of_their_diameters() {
    for (word, radius) in [("start", 0.5), ("end", 1.0), ("turn", 0.75), ("probe", 3.0)] {
        let marker = only(&format!("{word} 10,20"));
        assert_eq!((marker[0].1.as_str(), value(&marker, 6)), ("CIRCLE", Some("PHANTOM")), "{word}");
        assert_eq!(numbers(&marker, &[10, 20, 40]), [10.0, 20.0, radius], "{word}");
    }
    assert_eq!(line_type("probe DASHDOT 0,0").as_deref(), Some("DASHDOT"));
}

#[test]
fn verbs_stand_for_line_types() {
    let verbs = [
        ("mill", "CONTINUOUS"),
        ("mark", "DIVIDE"),
        ("bars", "BORDER"),
        ("subpath", "DASHDOT"),
        ("skip", "DOT"),
    ];
    for (verb, expected) in verbs {
        assert_eq!(line_type(&format!("{verb} 0,0 9,0")).as_deref(), Some(expected));
        assert_eq!(line_type(&format!("{verb} circle 0,0 d 9")).as_deref(), Some(expected));
    }
}

#[test]
fn a_sweep_with_a_text_is_dashed_and_one_without_hidden() {
    assert_eq!(line_type("sweep 0,0 9,0").as_deref(), Some("HIDDEN"));
    let with_text = entities("sweep 0,0 9,0 \"S5\"");
    assert_eq!((value(&with_text[0], 6), with_text[1][0].1.as_str()), (Some("DASHED"), "MTEXT"));
}

#[test]
fn a_line_type_stands_behind_the_shape() {
    assert_eq!(line_type("line 0,0 9,0").as_deref(), Some("CONTINUOUS"));
    assert_eq!(line_type("line Dashed2 0,0 9,0").as_deref(), Some("Dashed2"));
    assert_eq!(line_type("circle CENTERX2 0,0 d 9").as_deref(), Some("CENTERX2"));
    assert_eq!(line_type("line \"K5LT THIN\" 0,0 9,0").as_deref(), Some("K5LT THIN"));
    assert_eq!(line_type("linetype THIN 1 -1\nline THIN 0,0 9,0").as_deref(), Some("THIN"));
    assert_eq!(line_type("line BYLAYER 0,0 9,0"), None);
}

#[test]
fn several_points_give_several_lines() {
    let lines = entities("mill 0,0 9,0 @0,5 to\n".trim_end_matches(" to\n"));
    assert_eq!(lines.len(), 2);
    assert_eq!(numbers(&lines[1], &[10, 20, 11, 21]), [9.0, 0.0, 9.0, 5.0]);
    assert_eq!(kinds("mill 0,0 40,0 40,40 \"B0\""), ["LINE", "MTEXT", "LINE", "MTEXT"]);
}

#[test]
fn to_goes_on_where_the_last_element_ended() {
    let drawn = entities("arc 0,0 20,0 r 10\nline to 30,0\nline to @0,5");
    assert_eq!(numbers(&drawn[1], &[10, 20, 11, 21]), [20.0, 0.0, 30.0, 0.0]);
    assert_eq!(numbers(&drawn[2], &[10, 20, 11, 21]), [30.0, 0.0, 30.0, 5.0]);
}

#[test]
fn arcs_run_counterclockwise_unless_they_say_cw() {
    assert_arc("arc centre 10,0 r 5 from 0 to 90", [10.0, 0.0], 5.0, [0.0, 90.0]);
    assert_arc("arc centre 10,0 r 5 from 90 to 0 cw", [10.0, 0.0], 5.0, [0.0, 90.0]);
    assert_arc("arc 0,0 20,0 centre 10,0", [10.0, 0.0], 10.0, [180.0, 0.0]);
    assert_arc("arc 0,0 20,0 centre 10,0 cw", [10.0, 0.0], 10.0, [0.0, 180.0]);
}

#[test]
fn arcs_by_radius_point_and_bulge() {
    assert_arc("arc 10,0 0,10 r 10", [0.0, 0.0], 10.0, [0.0, 90.0]);
    assert_arc("arc 10,0 0,10 r 10 cw", [10.0, 10.0], 10.0, [180.0, 270.0]);
    assert_arc("arc 10,0 0,10 r 10 large", [10.0, 10.0], 10.0, [270.0, 180.0]);
    assert_arc("arc 0,0 20,0 r 10", [10.0, 0.0], 10.0, [180.0, 0.0]);
    assert_arc("arc 10,0 -10,0 via 0,10", [0.0, 0.0], 10.0, [0.0, 180.0]);
    assert_arc("arc 10,0 -10,0 via 0,-10", [0.0, 0.0], 10.0, [180.0, 0.0]);
    assert_arc("arc 10,0 -10,0 bulge 1", [0.0, 0.0], 10.0, [0.0, 180.0]);
    assert_arc("arc 10,0 -10,0 bulge -1", [0.0, 0.0], 10.0, [180.0, 0.0]);
}

#[test]
fn polylines_are_light_heavy_or_spatial() {
    let light = only("polyline 0,0 9,0 bulge 0.5 9,9 closed");
    assert_eq!((light[0].1.as_str(), number(&light, 70), number(&light, 42)), ("LWPOLYLINE", 1.0, 0.5));
    let heavy = entities("polyline heavy 0,0 9,0 bulge 0.5 9,9 closed");
    assert_eq!(
        heavy.iter().map(|r| r[0].1.as_str()).collect::<Vec<_>>(),
        ["POLYLINE", "VERTEX", "VERTEX", "VERTEX", "SEQEND"]
    );
    assert_eq!((number(&heavy[0], 70), number(&heavy[2], 42)), (1.0, 0.5));
    let spatial = entities("polyline spatial 0,0,1 9,0,2");
    assert_eq!((number(&spatial[0], 70), number(&spatial[2], 30)), (8.0, 2.0));
    assert_eq!(kinds("version R12\npolyline 0,0 9,0"), ["POLYLINE", "VERTEX", "VERTEX", "SEQEND"]);
}

#[test]
fn ellipses_and_splines() {
    let ellipse = only("ellipse centre 1,2 major 0,5 ratio 0.5 from 0 to 180");
    assert_eq!(numbers(&ellipse, &[10, 20, 11, 21, 40, 41]), [1.0, 2.0, 0.0, 5.0, 0.5, 0.0]);
    assert!((number(&ellipse, 42) - std::f64::consts::PI).abs() < 1e-9);
    let spline = only("spline control 0,0 1,1 2,0 3,1 4,0");
    let knots: Vec<&str> = spline.iter().filter(|pair| pair.0 == 40).map(|pair| pair.1.as_str()).collect();
    assert_eq!(knots, ["0.0", "0.0", "0.0", "0.0", "1.0", "2.0", "2.0", "2.0", "2.0"]);
    assert_eq!(numbers(&only("spline fit 0,0 1,1 2,0"), &[74, 73]), [3.0, 0.0]);
}

#[test]
fn a_mirrored_entity_is_written_in_object_coordinates() {
    let arc = only("arc centre 10,5 r 5 from 0 to 60 mirrored");
    assert_eq!(numbers(&arc, &[10, 20, 50, 51, 230]), [-10.0, 5.0, 120.0, 180.0, -1.0]);
    let polyline = only("polyline 1,2 3,2 bulge 0.5 3,4 mirrored");
    assert_eq!(numbers(&polyline, &[10, 20, 42, 230]), [-1.0, 2.0, -0.5, -1.0]);
    let line = only("line 1,2 3,2 mirrored");
    assert_eq!(numbers(&line, &[10, 20, 230]), [1.0, 2.0, -1.0]);
    let text = only("text 1,2 \"x\" rotate 30 mirrored");
    assert_eq!(numbers(&text, &[10, 20, 50, 230]), [-1.0, 2.0, -30.0, -1.0]);
    let insert = &entities("block B\nline 0,0 1,0\nendblock\ninsert B at 5,6 rotate 30 mirrored")[0];
    assert_eq!(numbers(insert, &[10, 20, 41, 50, 230]), [-5.0, 6.0, -1.0, -30.0, -1.0]);
}

#[test]
fn modifiers_hold_for_all_entities_of_the_line() {
    let lines = entities("line 0,0 9,0 9,9 z 3 paper invisible colour 5 layer Other");
    for line in lines {
        assert_eq!(numbers(&line, &[30, 31, 67, 60, 62]), [3.0, 3.0, 1.0, 1.0, 5.0]);
        assert_eq!(value(&line, 8), Some("Other"));
    }
    assert_eq!(numbers(&only("circle 0,0 d 1 normal 0,1,0"), &[210, 220, 230]), [0.0, 1.0, 0.0]);
}

#[test]
fn texts_have_alignment_and_direction() {
    let text = only("text 10,20 \"abc\" height 3 align right top rotate 90");
    assert_eq!(numbers(&text, &[11, 21, 40, 50, 72, 73]), [10.0, 20.0, 3.0, 90.0, 2.0, 3.0]);
    let text = only("text 0,0 \"abc\" align centre");
    assert_eq!(numbers(&text, &[11, 21, 72]), [0.0, 0.0, 1.0], "an anchor at the origin is written as well");
    let text = only("text 0,0 \"abc\" align aligned 10,0 backwards upside-down");
    assert_eq!(numbers(&text, &[10, 11, 72, 71]), [0.0, 10.0, 3.0, 6.0]);
    let mtext = only("mtext 1,2 \"abc\" align bottom right rotate 45");
    assert_eq!((numbers(&mtext, &[10, 20, 71, 50]), value(&mtext, 11)), (vec![1.0, 2.0, 9.0, 45.0], None));
    let mtext = only("mtext 1,2 \"abc\" direction 0,1");
    assert_eq!((numbers(&mtext, &[11, 21]), value(&mtext, 50)), (vec![0.0, 1.0], None));
}

#[test]
fn a_long_mtext_is_split_into_chunks() {
    let chunks = |text: &str| -> Vec<(i32, String)> {
        only(text).into_iter().filter(|pair| matches!(pair.0, 1 | 3)).collect()
    };
    assert_eq!(chunks("mtext 0,0 \"abcde\" chunks 2"), [(3, "ab".into()), (3, "cd".into()), (1, "e".into())]);
    assert_eq!(chunks(&format!("mtext 0,0 \"{}\"", "x".repeat(251)))[1], (1, "x".into()));
    assert_eq!(chunks(&format!("mtext 0,0 \"{}\"", "x".repeat(250))).len(), 1);
}

#[test]
fn set_and_unset_change_the_entity_before() {
    let circle = only("circle 0,0 d 9\nset 10 \"1,5\"\nset 999 remark\nunset 40");
    assert_eq!(
        (value(&circle, 10), value(&circle, 999), value(&circle, 40)),
        (Some("1,5"), Some("remark"), None)
    );
}

#[test]
fn raw_entities_are_written_as_they_stand() {
    let drawn = entities(
        "line 0,0 9,0\nraw\n0 LINE\n  8 1234.1P\n 10 nan # no remark\n 1  two blanks\nendraw\ncircle 0,0 d 1",
    );
    assert_eq!(
        drawn[1],
        [
            (0, "LINE".into()),
            (8, "1234.1P".into()),
            (10, "nan # no remark".into()),
            (1, " two blanks".into())
        ]
    );
    assert_eq!(drawn[2][0].1, "CIRCLE");
}
