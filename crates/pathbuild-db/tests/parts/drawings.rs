//! Tests drawings that just comply with each rule, and drawings that just do not.

use pathbuild_diagnostic::{Lang, Point, Severity};

use pathbuild_path::direction;

use crate::{PartTest, codes, messages, number};

const START: &str = "layer 1234.1P\nstart -5,-5 \"T2 O2 I0.5 B-0.2 D0.8 P3 U8 A20 S5\"\n";

/// Returns a plate of 40 x 25 mm with two round openings. The contour is drawn with `verb`.
fn plate(verb: &str) -> String {
    format!(
        "{START}sweep -5,-5 11,13\nmill circle 11,13 d 10\nsweep 11,13 31,13\nmill circle 31,13 d 6\n\
         sweep 31,13 0,0\n{verb} 0,0 42,0\n{verb} to 42,27 0,27 0,0\nsweep 0,0 50,-5\nend 50,-5\n{PLATE}"
    )
}

const PLATE: &str = "layer Part\npolyline 1,1 41,1 41,26 1,26 closed\ncircle 11,13 d 10\ncircle 31,13 d 6\n";

#[test]
fn a_plate_with_bars_is_as_drawn() {
    assert_eq!(messages(&plate("bars")), [""; 0]);
}

#[test]
fn a_plate_without_bars_is_loose_unless_something_else_holds_it() {
    let drawing = plate("mill");
    assert_eq!(codes(&drawing), ["PB212", "PB217"]);
    let held = PartTest { is_held_otherwise: true, ..PartTest::default() };
    assert_eq!(held.codes(&[("1234.1P.dxf", &drawing)]), [""; 0]);
}

/// With B-0.2, a corner radius of 0.3 mm narrows the cut by 0.017 mm at the lower face, and one of 0.4 mm by 0.054 mm.
#[test]
fn a_round_tip_leaves_a_foot() {
    let feet = |corner_radius: f64, drawing: &str| {
        let test = PartTest { corner_radius, ..PartTest::default() };
        let found = test.diagnostics(&[("1234.1P.dxf", drawing)]);
        assert!(found.iter().all(|found| found.text(Lang::En).starts_with("the round tip")), "{found:?}");
        found.iter().map(|found| (number(found, "thickness") * 1000.0).round()).collect::<Vec<_>>()
    };
    for corner_radius in [0.0, 0.2, 0.3] {
        assert_eq!(feet(corner_radius, &plate("bars")), [0.0; 0], "{corner_radius}");
    }
    // The holes and the four sides.
    assert_eq!(feet(0.4, &plate("bars")), [54.0; 6]);
    assert_eq!(feet(1.0, &plate("bars")), [400.0; 6]);
    assert_eq!(feet(1.0, &plate("bars").replace("B-0.2", "B0")), [1000.0; 6]);
    assert_eq!(feet(0.5, &plate("bars").replace("B-0.2", "B-0.5")), [0.0; 0]);
}

/// A ring in an opening encloses waste, which needs no support bars, unless the opening belongs to a part of another path.
#[test]
fn a_ring_in_an_opening_needs_no_bars() {
    let drawing = |part: &str, window: &str| {
        let window = format!("polyline {window} closed\n");
        format!(
            "{START}sweep -5,-5 11,6\nmill 11,6 31,6 31,21 11,21 11,6\nsweep 11,6 50,-5\nend 50,-5\n\
             layer 1234.2P\nstart 60,-5 \"T2 O2 I0.5 B-0.2 D0.8 P3 U8 A20 S5\"\nsweep 60,-5 42,0\n\
             bars 42,0 42,27 0,27 0,0 42,0\nsweep 42,0 50,-9\nend 50,-9\n\
             layer \"{part}\"\npolyline 1,1 41,1 41,26 1,26 closed\n{window}"
        )
    };
    let is_reported = |part: &str, window: &str| {
        let test = PartTest { pattern: Some("Part ?([0-9_]*)"), ..PartTest::default() };
        test.codes(&[("1234.dxf", &drawing(part, window))]).contains(&"PB212".to_owned())
    };
    let opening = "10,5 32,5 32,22 10,22";
    assert!(!is_reported("Part", opening));
    assert!(!is_reported("Part", "10.99,5 32,5 32,22 10.99,22"));
    assert!(is_reported("Part", "11.01,5 32,5 32,22 11.01,22"), "the ring begins in the part");
    assert!(!is_reported("Part 1234_1", opening));
    assert!(is_reported("Part 1234_2", opening), "the part of the other path");
}

/// Without an outline around them, the circles of holes are taken for outlines of parts.
#[test]
fn a_hole_without_an_outline_around_it_is_named() {
    let said = |hole: &str, outline: &str| {
        let drawing = format!(
            "{START}sweep -5,-5 11,13\nmill {hole}\nsweep 11,13 50,-5\nend 50,-5\nlayer Part\n{outline}"
        );
        let found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
        let gouges = found.into_iter().filter(|found| found.code().to_string() == "PB213");
        gouges.map(|found| found.text(Lang::En)).collect::<Vec<_>>()
    };
    let missing =
        "the circle of this hole is taken for the outline of a part: layer Part has no outline around it";
    for hole in ["circle 11,13 d 2", "circle 11,13 d 5"] {
        assert_eq!(said(hole, hole), [missing], "{hole}");
        assert_eq!(
            said(hole, &format!("{hole}\npolyline HIDDEN 1,1 41,1 41,26 1,26 closed")),
            [missing],
            "{hole}"
        );
        assert_eq!(said(hole, &format!("{hole}\npolyline 1,1 41,1 41,26 1,26 closed")), [""; 0], "{hole}");
        // A disc that is a little larger is a part.
        let [found] = &said(hole, "circle 11,13 d 5.1")[..] else { panic!("{hole}") };
        assert!(!found.contains("taken for the outline"), "{found}");
    }
}

/// A helical circle is drawn as the outer edge of the cut, so around a disc it is larger than the disc by 2 O.
#[test]
fn a_circle_around_a_disc_is_no_hole() {
    let start = START.replace("A20", "A40");
    let gouges = |circle: &str, outlines: &str| {
        let drawing = format!(
            "{start}sweep -5,-5 20,20\n{circle}\nsweep 20,20 50,-5\nend 50,-5\nlayer Part\n{outlines}\n"
        );
        let mut found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
        found.retain(|found| found.code().to_string() == "PB213");
        found
    };
    let disc = "circle 20,20 d 20";
    for (line_type, diameter) in [("bars", 20.0), ("bars", 22.0), ("bars", 23.9), ("mill", 22.0)] {
        let found = gouges(&format!("{line_type} circle 20,20 d {diameter}"), disc);
        let [found] = &found[..] else { panic!("{line_type} {diameter}: {found:?}") };
        assert!((number(found, "depth") - (12.0 - diameter / 2.0)).abs() < 1e-6, "{found:?}");
    }
    assert_eq!(gouges("bars circle 20,20 d 24", disc), []);
    let is_hole =
        |outlines: &str| gouges("mill circle 20,20 d 20", outlines)[0].text(Lang::En).contains("this hole");
    assert!(is_hole(disc));
    assert!(!is_hole(&format!("{disc}\ncircle 20,20 d 8")), "a washer");
}

/// A contour 0.5 mm too far outside leaves material all round. Without bars, the part is still loose.
#[test]
fn a_contour_too_far_outside_leaves_material_all_round() {
    let contour = |verb: &str| {
        plate(verb)
            .replace(&format!("{verb} 0,0 42,0"), &format!("{verb} -0.5,-0.5 42.5,-0.5"))
            .replace("to 42,27 0,27 0,0", "to 42.5,27.5 -0.5,27.5 -0.5,-0.5")
            .replace("13 0,0", "13 -0.5,-0.5")
            .replace("sweep 0,0", "sweep -0.5,-0.5")
    };
    assert_eq!(codes(&contour("mill")), ["PB212", "PB215", "PB217"]);
    let left = PartTest::default().diagnostics(&[("1234.1P.dxf", &contour("bars"))]);
    assert_eq!(left.len(), 4, "{left:?}");
    for found in &left {
        assert!((number(found, "thickness") - 0.5).abs() < 0.01, "{}", found.text(Lang::En));
    }
}

/// One side of the contour is too far away. It is named, even if it is farther than O away and another side is nearer to the middle of the stretch.
#[test]
fn material_left_names_the_side_that_is_too_far_away() {
    let upper_side = |[width, height]: [f64; 2], distance: f64| {
        let (right, top) = (width + 2.0, height + 1.0 + distance);
        let drawing = format!(
            "{START}sweep -5,-5 0,0\nbars 0,0 {right},0\nbars to {right},{top} 0,{top} 0,0\nsweep 0,0 50,-5\nend 50,-5\n\
             layer Part\npolyline 1,1 {x},1 {x},{y} 1,{y} closed\n",
            x = width + 1.0,
            y = height + 1.0
        );
        let mut found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
        found.retain(|found| found.code().to_string() == "PB215");
        assert_eq!(found[0].place.point, Some(Point::new(right, top)), "{width} {distance}: {found:?}");
    };
    for distance in [1.5, 1.9, 2.1, 2.5, 4.0, 11.0] {
        upper_side([40.0, 20.0], distance);
        upper_side([10.0, 60.0], distance);
    }
}

/// The contour passes the mouth of a notch. If the contour is closed, material is left in the notch; if not, the notch may be in the plate's edge.
#[test]
fn a_notch_that_a_closed_contour_passes_is_left() {
    let with = |contour: &str, notch: &str| {
        let notched = contour.replace("1,1 41,1 41,26", &format!("1,1 41,1 {notch} 41,26"));
        codes(&notched)
    };
    let (closed, wide) = (plate("bars"), "41,10 36,10 36,14 41,14");
    let open = closed.replace("bars to 42,27 0,27 0,0", "bars to 42,27 0,27\nsweep 0,27 0,0");
    assert_eq!(with(&closed, wide), ["PB215", "PB216"], "its corners are sharp");
    assert_eq!(with(&open, wide), [""; 0]);
    assert_eq!(with(&closed, "41,10 36,10 36,11.9 41,11.9"), ["PB216"], "narrower than the cutter");
    // A cut that ends within its own width of the next one, or leaves a bridge of up to 0.1 mm, still closes the ring.
    let gap =
        |x: f64| closed.replace("42,27 0,27 0,0", &format!("42,27 {x},27\nsweep {x},27 0,27\nbars to 0,0"));
    assert_eq!(with(&gap(2.09), wide), ["PB215", "PB216"]);
    assert_eq!(with(&gap(2.11), wide), [""; 0]);
    let notched = closed.replace("1,1 41,1 41,26", &format!("1,1 41,1 {wide} 41,26"));
    let mut left = PartTest::default().diagnostics(&[("1234.1P.dxf", &notched)]);
    left.retain(|found| found.code().to_string() == "PB215");
    // The finding is at one of the notch's long sides, except for its last millimetre, which the cutter cannot reach. The stretch ends 4 mm from the
    // cut; the samples are nearer.
    let (thickness, length) = (number(&left[0], "thickness"), number(&left[0], "length"));
    assert!((3.7..4.0).contains(&thickness), "{}", left[0].text(Lang::En));
    assert!((length - 4.0).abs() < 0.01, "{}", left[0].text(Lang::En));
}

/// Two cuts in line leave a bridge of more than 0.1 mm between them, even if the rotation of the drawing makes their coordinates inexact.
#[test]
fn a_bridge_holds_a_part_at_any_angle() {
    let turned = |degrees: f64, gap: f64| {
        let way = direction(degrees);
        let turned = |(x, y): &(f64, f64)| format!("{},{}", x * way.x - y * way.y, x * way.y + y * way.x);
        let points = |points: &[(f64, f64)]| points.iter().map(turned).collect::<Vec<_>>();
        let [before, after] = [20.0 - gap / 2.0, 20.0 + gap / 2.0];
        let corners = [(-1.0, 21.0), (-1.0, -1.0), (41.0, -1.0), (41.0, 21.0)];
        let contour = points(&[&[(before, 21.0)][..], &corners, &[(after, 21.0)]].concat());
        let part = points(&[(0.0, 0.0), (40.0, 0.0), (40.0, 20.0), (0.0, 20.0)]);
        format!(
            "layer 1234.1P\nstart {} \"T2 O2 I2 B0 S5\"\nmill {}\nend {}\nlayer Part\npolyline {} closed\n",
            contour[0],
            contour.join(" "),
            contour[5],
            part.join(" ")
        )
    };
    let is_loose = |degrees: f64, gap: f64| codes(&turned(degrees, gap)).contains(&"PB217".to_owned());
    for number in 0..60 {
        let degrees = f64::from(number) * 6.1;
        assert!(!is_loose(degrees, 2.11), "{degrees}");
        assert!(is_loose(degrees, 2.09), "{degrees}");
    }
}

const EDGE: &str = "layer Part\npolyline 0,1 40,1 40,20 0,20 closed\n";

#[test]
fn an_edge_may_be_off_by_the_tolerance() {
    let shifted = |y: f64| {
        format!("{START}sweep -5,-5 0,{y}\nmill 0,{y} 40,{y}\nsweep 40,{y} 50,-5\nend 50,-5\n{EDGE}")
    };
    for (y, expected) in
        [(0.0, None), (0.019, None), (0.021, Some("PB213")), (-0.019, None), (-0.021, Some("PB215"))]
    {
        let found: Vec<String> = codes(&shifted(y)).into_iter().filter(|code| code != "PB212").collect();
        assert_eq!(found, expected.into_iter().collect::<Vec<_>>(), "{y}");
    }
    let depth = |y: f64| {
        let found = PartTest::default().diagnostics(&[("1234.1P.dxf", &shifted(y))]);
        let found = found.into_iter().find(|found| found.code().to_string() == "PB213").unwrap();
        (number(&found, "depth"), number(&found, "length"), found.severity)
    };
    let (shallow, length, severity) = depth(0.099);
    assert!((shallow - 0.099).abs() < 1e-6 && length > 39.0, "{shallow} {length}");
    assert_eq!(severity, Severity::Warning);
    // 1 - (1 - 0.1) is slightly more than 0.1 in binary.
    assert_eq!(depth(0.1).2, Severity::Warning);
    assert_eq!(depth(0.101).2, Severity::Error);
}

#[test]
fn compatible_programs_get_warnings_only() {
    let drawing = format!(
        "{START}sweep -5,-5 0,0.5\nmill 0,0.5 40,0.5\nsweep 40,0.5 50,-5\nend 50,-5\n\
         layer Part\npolyline 0,1 40,1 40,20 0,20 closed\n"
    );
    let compatible = PartTest { is_compatible: true, ..PartTest::default() };
    let found = compatible.diagnostics(&[("1234.1P.dxf", &drawing)]);
    assert!(found.iter().any(|found| found.code().to_string() == "PB213"));
    assert!(found.iter().all(|found| found.severity == Severity::Warning), "{found:?}");
}

/// In compatible programs, the tool plunges to B at the start of a segment and thus cuts through the half bar there.
#[test]
fn compatible_programs_lose_half_bars_at_corners() {
    let compatible = PartTest { is_compatible: true, ..PartTest::default() };
    assert!(compatible.codes(&[("1234.1P.dxf", &plate("bars"))]).contains(&"PB218".to_owned()));
    assert!(!codes(&plate("bars")).contains(&"PB218".to_owned()));
}

/// The arc enters the straight edge between its ends, which are both clear of the edge.
#[test]
fn an_arc_that_bulges_into_an_edge_is_found_between_its_ends() {
    let bulge = |height: f64| {
        let bulge = 2.0 * height / 40.0;
        format!(
            "{START}sweep -5,-5 40,0\nmill arc 40,0 0,0 bulge {bulge}\nsweep 0,0 50,-5\nend 50,-5\n\
             layer Part\npolyline 0,1 40,1 40,20 0,20 closed\n"
        )
    };
    assert!(!codes(&bulge(0.019)).contains(&"PB213".to_owned()));
    let found = PartTest::default().diagnostics(&[("1234.1P.dxf", &bulge(0.03))]);
    let found = found.iter().find(|found| found.code().to_string() == "PB213").expect("a gouge");
    assert!((number(found, "depth") - 0.03).abs() < 1e-4, "{found:?}");
}

#[test]
fn grooves_and_marks_above_the_plate_may_cross_the_part() {
    let with = |cut: &str| {
        format!(
            "{START}sweep -5,-5 0,0\nmill 0,0 40,0\nsweep 40,0 20,5\n{cut}\nsweep 20,15 50,-5\nend 50,-5\n\
             layer Part\npolyline 0,1 40,1 40,20 0,20 closed\n"
        )
    };
    let codes = |cut: &str| codes(&with(cut)).into_iter().filter(|code| code != "PB212").collect::<Vec<_>>();
    assert_eq!(codes("mill 20,5 20,15 \"B0.5\""), [""; 0], "a groove");
    assert_eq!(codes("mark 20,5 20,15 \"D1.5\""), [""; 0], "a mark");
    assert_eq!(codes("mill 20,5 20,15 \"B0.002\""), [""; 0], "just above the plate");
    assert_eq!(codes("mill 20,5 20,15 \"B0.001\""), ["PB213"], "through");
}

/// A segment with support bars that goes through the plate between them is part of an outline, so nothing of it may enter the part.
#[test]
fn segments_with_bars_must_not_enter_the_part() {
    let gouges = |from: f64, y: f64, letters: &str| {
        let drawing = format!(
            "{}layer 1234.1L\nstart -8,-8 \"T2 O2 I0.5 P3 U8 {letters} S5\"\nsweep -8,-8 {from},{y}\nbars {from},{y} 19,{y}\n\
             sweep 19,{y} 60,-5\nend 60,-5\n",
            plate("bars")
        );
        let mut found = PartTest::default().diagnostics(&[("1234.1.dxf", &drawing)]);
        found.retain(|found| found.code().to_string() == "PB213");
        let numbers = found.iter().map(|found| ["depth", "length"].map(|name| number(found, name)));
        numbers.map(|numbers| numbers.map(|number| (1000.0 * number).round() / 1000.0)).collect::<Vec<_>>()
    };
    assert_eq!(gouges(23.0, 26.97, "B0 D0.8"), [[0.03, 4.0]], "no gap");
    assert_eq!(gouges(23.0, 26.99, "B0 D0.8"), [[0.0; 2]; 0], "within the tolerance");
    assert_eq!(gouges(39.0, 26.97, "B0 D0.8"), [[0.03, 20.0]], "gaps, slopes and bars");
    assert_eq!(gouges(23.0, 26.97, "B0 D1.98"), [[0.03, 4.0]]);
    assert_eq!(gouges(23.0, 26.97, "B0 D1.995"), [[0.0; 2]; 0], "at the upper face");
    assert_eq!(gouges(23.0, 20.0, "B0.001 D0.8").len(), 1);
    assert_eq!(gouges(23.0, 20.0, "B0.002 D0.8"), [[0.0; 2]; 0], "a groove");
}

#[test]
fn corners_that_no_cutter_reaches_are_one_remark() {
    let corner = |outline: &str| {
        format!(
            "layer 1234.1P\nstart 0,0 \"T2 O4 I1 B0 S5\"\nmill 0,0 20,0\nmill to 20,10\nend 20,10\n\
             layer Part\n{outline}\nline 22,10 40,10\nline to 40,-20\nline to 0,-20\nline to 0,-2\n"
        )
    };
    let fillet = |radius: f64| {
        let (x, y) = (22.0 - radius, -2.0 + radius);
        corner(&format!("line 0,-2 {x},-2\narc {x},-2 22,{y} centre {x},{y}\nline 22,{y} 22,10"))
    };
    let sharp = corner("line 0,-2 22,-2\nline 22,-2 22,10");
    assert_eq!(codes(&sharp), ["PB216"]);
    assert_eq!(codes(&fillet(1.5)), ["PB216"], "smaller than half of O");
    assert_eq!(codes(&fillet(2.0)), [""; 0], "equal");
    // The path has a sharp corner where the part has a larger radius.
    assert_eq!(codes(&fillet(4.0)), ["PB213"], "larger");
}

/// The end of a slot has the radius of the cutter, so the cutter reaches it from one point only.
#[test]
fn a_cutter_reaches_an_arc_of_its_own_radius() {
    let slot = |end: f64| {
        let drawing = format!(
            "{START}sweep -5,-5 10,10\nmill 10,10 {end},10\nsweep {end},10 50,-5\nend 50,-5\nlayer Part\n\
             polyline 1,1 41,1 41,26 1,26 closed\npolyline 10,9 20,9 bulge 1 20,11 10,11 bulge 1 closed\n"
        );
        PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)])
    };
    let left = |end: f64| {
        let found = slot(end);
        assert!(found.iter().all(|found| found.code().to_string() != "PB216"), "{found:?}");
        let left = found.iter().find(|found| found.code().to_string() == "PB215");
        left.map_or(0.0, |found| number(found, "thickness"))
    };
    assert_eq!((left(20.0), left(19.981)), (0.0, 0.0));
    // The point of the edge that is farthest from the cut lies between two samples.
    for missing in [0.03, 0.5] {
        assert!((left(20.0 - missing) - missing).abs() < 0.01, "{missing}: {}", left(20.0 - missing));
    }
}

#[test]
fn a_bar_that_another_path_cuts_is_lost() {
    let second = |x: f64, bottom: f64| {
        format!(
            "{}layer 1234.1L\nstart -8,-8 \"T2 O2 I0.5 B{bottom} S5\"\nsweep -8,-8 {x},-3\n\
             mill {x},-3 {x},0\nsweep {x},0 60,-5\nend 60,-5\n",
            plate("bars")
        )
    };
    let codes = |drawing: &str| PartTest::default().codes(&[("1234.1.dxf", drawing)]);
    // The length of 42 mm gives three bars (42 / 11), of which the inner ones are at 14 and 28.
    assert_eq!(codes(&second(14.0, -0.2)), ["PB218"]);
    assert_eq!(codes(&second(14.0, 0.79)), [""; 0], "it ends as high as the bar");
    assert_eq!(codes(&second(21.0, -0.2)), [""; 0], "between the bars");
    assert_eq!(codes(&second(0.0, -0.2)), ["PB218"], "half bars at a corner");
    // The bar from 12.5 to 15.5 loses 0.12 and 0.18 of its 3 mm.
    assert_eq!(codes(&second(11.64, -0.2)), [""; 0], "4 % of a bar");
    assert_eq!(codes(&second(11.7, -0.2)), ["PB218"], "6 % of a bar");
}

/// The bar, between 24 and 29, is longer than P. Each cut removes 1.96 mm of it.
#[test]
fn a_bar_of_which_p_remains_is_not_lost() {
    let codes = |length: f64, cuts: &[f64]| {
        let mut drawing = plate("mill").replace(
            "mill to 42,27 0,27 0,0",
            &format!("mill to 42,27 30,27\nbars to 23,27 \"P{length} U50\"\nmill to 0,27 0,0"),
        );
        for (number, x) in cuts.iter().enumerate() {
            drawing += &format!(
                "layer 1234.{}P\nstart -8,-8 \"T2 O2 I0.5 B0 S5\"\nsweep -8,-8 {x},32\nmill {x},32 {x},27\n\
                 sweep {x},27 60,-5\nend 60,-5\n",
                number + 2
            );
        }
        let mut codes = PartTest::default().codes(&[("1234.dxf", &drawing)]);
        codes.retain(|code| code != "PB408");
        codes
    };
    assert_eq!(codes(3.1, &[26.5]), [""; 0]);
    assert_eq!(codes(3.3, &[26.5]), ["PB218"]);
    assert_eq!(codes(3.1, &[25.2]), [""; 0]);
    assert_eq!(codes(3.1, &[25.2, 27.8]), ["PB218"], "both together");
}

#[test]
fn a_contour_whose_bars_a_second_path_cuts_is_loose() {
    let drawing = format!(
        "{}layer 1234.1L\nstart -8,-8 \"T2 O2 I0.5 B-0.2 S5\"\nsweep -8,-8 0,0\n\
         mill 0,0 42,0\nmill to 42,27 0,27 0,0\nsweep 0,0 60,-5\nend 60,-5\n",
        plate("bars")
    );
    assert_eq!(PartTest::default().codes(&[("1234.1.dxf", &drawing)]), ["PB217", "PB218"]);
}

/// Returns the plate with bars on its lower side only, and a second path.
fn plate_with_bars_below(second: &str) -> String {
    let plate = plate("mill").replace("mill 0,0 42,0", "bars 0,0 42,0");
    format!("{plate}layer 1234.2P\nstart -8,-8 \"T2 O2 I0.5 B-0.2 S5\"\n{second}\nend 60,-5\n")
}

/// The bars are between Y-1 and 1. The second path separates the bars from the plate without removing them.
#[test]
fn a_cut_beside_all_bars_separates_them_from_the_plate() {
    let cut = |y: f64, end: f64| {
        let second = format!("sweep -8,-8 -3,{y}\nmill -3,{y} {end},{y}\nsweep {end},{y} 60,-5");
        plate_with_bars_below(&second)
    };
    let codes = |drawing: &str| PartTest::default().codes(&[("1234.dxf", drawing)]);
    assert_eq!(codes(&cut(-1.5, 45.0)), ["PB217"]);
    assert_eq!(codes(&cut(-2.09, 45.0)), ["PB217"], "what is left between the cuts holds nothing");
    assert_eq!(codes(&cut(-2.11, 45.0)), [""; 0], "it just holds");
    assert_eq!(codes(&cut(-1.5, 39.9)), [""; 0], "it ends 0.1 mm before the contour's right side");
    let held = PartTest { is_held_otherwise: true, ..PartTest::default() };
    assert_eq!(held.codes(&[("1234.dxf", &cut(-1.5, 45.0))]), [""; 0]);
    let grouped = PartTest { pattern: Some("Part ([0-9_]+)"), ..PartTest::default() };
    let drawing = cut(-1.5, 45.0).replace("layer Part", "layer \"Part 1234_1\"");
    let found = grouped.diagnostics(&[("1234.dxf", &drawing)]);
    let [found] = &found[..] else { panic!("{found:?}") };
    assert_eq!((found.code().to_string().as_str(), found.path.as_deref()), ("PB217", Some("1234.2P")));
}

/// A second path closes a ring that cuts off all bars, on whichever sides of the plate they are. With `sweep`, the left side of the ring is open.
#[test]
fn bars_on_any_sides_lead_nowhere_within_a_ring() {
    for sides in 1..16 {
        let verb = |side: u32| if sides & 1 << side == 0 { "mill" } else { "bars" };
        let contour =
            format!("{} 0,0 42,0\n{} to 42,27\n{} to 0,27\n{} to 0,0\n", verb(0), verb(1), verb(2), verb(3));
        let found = |last: &str| {
            let drawing = format!(
                "{START}sweep -5,-5 0,0\n{contour}sweep 0,0 50,-5\nend 50,-5\nlayer Part\npolyline 1,1 41,1 41,26 1,26 closed\n\
                 layer 1234.2P\nstart -8,-8 \"T2 O2 I0.5 B-0.2 S5\"\nsweep -8,-8 -1,-1\n\
                 mill -1,-1 43,-1 43,28 -1,28\n{last} to -1,-1\nsweep -1,-1 60,-5\nend 60,-5\n"
            );
            PartTest::default().codes(&[("1234.dxf", &drawing)])
        };
        assert!(found("mill").contains(&"PB217".to_owned()), "sides {sides:04b}: {:?}", found("mill"));
        let is_held = sides & 0b1000 != 0;
        assert_eq!(!found("sweep").contains(&"PB217".to_owned()), is_held, "sides {sides:04b}");
    }
}

/// A cut farther from the part than twice the cutter diameter may be made in another plate, or after the part was taken out.
#[test]
fn cuts_of_other_paths_count_within_twice_the_cutter_diameter() {
    let codes = |y: f64| {
        let second = format!("sweep -8,-8 -1.5,5\nmill -1.5,5 -1.5,{y} 43.5,{y} 43.5,5\nsweep 43.5,5 60,-5");
        PartTest::default().codes(&[("1234.dxf", &plate_with_bars_below(&second))])
    };
    assert_eq!(codes(-2.99), ["PB217"]);
    assert_eq!(codes(-3.01), [""; 0]);
}

/// Both components have bars on their lower sides only. If the lower component is near, its upper cut leaves no material that the bars of the upper
/// component could hold to.
#[test]
fn bars_between_components_need_material_to_hold_to() {
    let component = component().replace("bars to 27,12 3,12 3,-12", "mill to 27,12 3,12 3,-12");
    let found = |distance: f64, test: &PartTest<'_>| {
        let project = project(distance, 0.0);
        let found = test.diagnostics(&[("8001.1P.dxf", &project), ("1234.1P.dxf", &component)]);
        found.into_iter().filter(|found| found.code().to_string() != "PB210").collect::<Vec<_>>()
    };
    let test = PartTest::default();
    for distance in [3.1, 4.09] {
        let found = found(distance, &test);
        let [found] = &found[..] else { panic!("{distance}: {found:?}") };
        assert_eq!((found.code().to_string().as_str(), found.path.as_deref()), ("PB217", Some("8001.1P")));
    }
    assert_eq!(found(4.11, &test), []);
    assert_eq!(found(3.5, &PartTest { is_held_otherwise: true, ..PartTest::default() }), []);
}

/// Returns the codes for a plate with this opening, without those about its sharp corners and its rim, which is not cut. Each path has a
/// cutter, and elements that begin at (5, 5).
fn in_opening(paths: &[(&str, &str)], opening: &str) -> Vec<String> {
    let mut drawing = String::new();
    for (number, (tool, elements)) in paths.iter().enumerate() {
        drawing += &format!(
            "layer 1234.{}P\nstart 5,5 \"T2 O{tool} I0.5 B-0.2 D0.8 P3 U5 S5\"\n{elements}\n",
            number + 1
        );
    }
    let drawing = format!("{drawing}layer Part\npolyline -9,-9 50,-9 50,40 -9,40 closed\n{opening}");
    let held = PartTest { is_held_otherwise: true, ..PartTest::default() };
    let mut codes = held.codes(&[("1234.dxf", &drawing)]);
    codes.retain(|code| !["PB216", "PB220"].contains(&&**code));
    codes
}

#[test]
fn a_stretch_of_an_opening_that_a_ring_of_cuts_passes_is_left() {
    const WINDOW: &str = "polyline 0,0 30,0 30,20 0,20 closed\n";
    let ring = |verb: &str, x: f64| {
        format!(
            "sweep 5,5 1,1\n{verb} 1,1 {x},1\n{verb} {x},1 {x},19\n{verb} {x},19 1,19\n{verb} 1,19 1,1\nsweep 1,1 60,50\nend 60,50"
        )
    };
    for verb in ["mill", "bars"] {
        let with = |x: f64| in_opening(&[("2", &ring(verb, x))], WINDOW);
        assert_eq!(with(29.0), [""; 0], "{verb}");
        for x in [28.9, 27.1, 26.9, 24.0, 14.0] {
            assert_eq!(with(x), ["PB215"], "{verb} {x}");
        }
    }
    // A ring with a gap is none: the window may have been there before.
    let gap = |y: f64| {
        let side = format!("mill 24,1 24,10\nsweep 24,10 24,{y}\nmill 24,{y} 24,19");
        in_opening(&[("2", &ring("mill", 24.0).replace("mill 24,1 24,19", &side))], WINDOW)
    };
    assert_eq!(gap(12.09), ["PB215"]);
    assert_eq!(gap(12.11), [""; 0]);
    // Another cutter mills what the ring leaves.
    let rest = "sweep 5,5 23.5,0.75\nmill 23.5,0.75 29.25,0.75\nmill 29.25,0.75 29.25,19.25\nmill 29.25,19.25 23.5,19.25\nend 23.5,19.25";
    assert_eq!(in_opening(&[("2", &ring("mill", 24.0)), ("1.5", rest)], WINDOW), [""; 0]);
    assert_eq!(
        in_opening(&[("2", &ring("mill", 24.0)), ("1.5", "mill 5,5 28,5\nend 28,5")], WINDOW),
        ["PB215"]
    );
    // Of an outline around another one, it is not known which is to be cut.
    assert_eq!(in_opening(&[("2", &ring("mill", 24.0))], &format!("{WINDOW}circle 8,10 d 6\n")), [""; 0]);
}

/// The cutter does not come within O of the tip of a sharp corner.
#[test]
fn a_sharp_corner_of_an_opening_is_no_material_left() {
    let triangle = "polyline 0,0 30,-5 30,5 closed\n";
    // The sides are inclined by 9.46 degrees, so the path's tip is 1 mm / sin(9.46 degrees) from that of the outline.
    let ring = "sweep 5,5 6.0828,0\nmill 6.0828,0 29,-3.8196\nmill 29,-3.8196 29,3.8196\nmill 29,3.8196 6.0828,0\nsweep 6.0828,0 60,0\nend 60,0";
    assert_eq!(in_opening(&[("2", ring)], triangle), [""; 0]);
}

/// A line too short for a gap between bars (P + U) is left standing as a whole, as one bar.
#[test]
fn a_whole_segment_may_be_a_bar() {
    let drawing =
        plate("mill").replace("mill to 42,27 0,27 0,0", "mill to 42,27\nbars to 0,27 \"U50\"\nmill to 0,0");
    assert_eq!(codes(&drawing), [""; 0]);
}

/// The cuts on both sides of a short line with line type BORDER reach 1 mm into it.
#[test]
fn a_bar_as_short_as_the_cutter_does_not_stand() {
    let with = |lengths: &[f64]| {
        let mut upper = String::from("mill to 42,27\n");
        let mut x = 42.0;
        for length in lengths {
            x -= 4.0;
            upper += &format!("mill to {x},27\n");
            x -= length;
            upper += &format!("bars to {x},27\n");
        }
        let drawing = plate("mill").replace("mill to 42,27 0,27 0,0", &format!("{upper}mill to 0,27 0,0"));
        let found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
        assert!(found.iter().all(|found| found.severity == Severity::Warning), "{found:?}");
        let mut codes: Vec<_> = found.iter().map(|found| found.code().to_string()).collect();
        codes.sort();
        codes.dedup();
        codes
    };
    assert_eq!(with(&[2.0]), ["PB217", "PB218"]);
    assert_eq!(with(&[2.09]), ["PB217", "PB218"]);
    assert_eq!(with(&[2.11]), [""; 0]);
    assert_eq!(with(&[2.09, 12.0]), ["PB218"], "another bar holds the part");
    assert_eq!(with(&[2.11, 12.0]), [""; 0]);
}

fn project(distance: f64, height: f64) -> String {
    let y = 2.0 * 11.0 + distance;
    format!(
        "layer 8001.1P\nstart -10,0 \"T2 O2 MX\"\nsweep -10,0 0,0\nsubpath 0,0 30,0 \">1234.1P H{height}\"\n\
         sweep 30,0 0,{y}\nsubpath 0,{y} 30,{y} \">1234.1P\"\nend 30,{y}\n"
    )
}

/// Returns a component with a square of 22 x 22 mm around the line from start to end, milled on all sides.
fn component() -> String {
    "layer 1234.1P\nstart 0,0 \"T2 O2 I0.5 B0 D0.8 P3 U8 MX\"\nsweep 0,0 3,-12\nbars 3,-12 27,-12\n\
     bars to 27,12 3,12 3,-12\nsweep 3,-12 30,0\nend 30,0\nlayer Part\npolyline 4,-11 26,-11 26,11 4,11 closed\n"
        .to_owned()
}

#[test]
fn neighbours_in_a_project_need_room_for_the_cutter() {
    let component = component();
    let found = |distance: f64| {
        let project = project(distance, 0.0);
        let found =
            PartTest::default().diagnostics(&[("8001.1P.dxf", &project), ("1234.1P.dxf", &component)]);
        found.into_iter().filter(|found| found.code().to_string() != "PB210").collect::<Vec<_>>()
    };
    assert_eq!(found(2.0), [], "they touch");
    let both = found(1.5);
    assert_eq!(both.len(), 2, "{both:?}");
    for found in &both {
        assert_eq!(found.code().to_string(), "PB214");
        assert!((number(found, "depth") - 0.5).abs() < 1e-6, "{found:?}");
        assert!(
            found.help(Lang::En).is_some_and(|help| help.starts_with("place the two parts")),
            "{found:?}"
        );
    }
}

/// A path that cuts no part of its own may be meant for the part.
#[test]
fn a_path_without_a_part_may_mill_an_opening() {
    let cut = "layer 1300.1P\nstart 0,0 \"T2 O2 I1 B0 S5 MX\"\nmill 0,0 5,0\nend 5,0\n";
    let project = "layer 8001.1P\nstart 0,0 \"T2 O2 S5 MX\"\nsubpath 0,0 30,0 \">1234.1P\"\nsweep 30,0 10,0\n\
                   subpath 10,0 15,0 \">1300.1P\"\nend 15,0\n";
    let files = [("8001.1P.dxf", project), ("1234.1P.dxf", &*component()), ("1300.1P.dxf", cut)];
    let found = PartTest::default().diagnostics(&files);
    let gouge = found.iter().find(|found| found.code().to_string() == "PB214");
    let help = gouge.and_then(|gouge| gouge.help(Lang::En)).unwrap_or_default();
    assert!(help.contains("draw the opening on the layer of the part's outline"), "{found:?}");
}

/// No side of the components has a gap, and the upper edge of their bars is at 0.8. The lower component is 2 mm thick.
#[test]
fn bars_of_a_component_must_not_enter_a_neighbour() {
    let component = component().replace("U8", "U50");
    let found = |distance: f64, height: f64| {
        let files = [("8001.1P.dxf", &*project(distance, height)), ("1234.1P.dxf", &*component)];
        let found = PartTest::default().diagnostics(&files);
        found.iter().filter(|found| found.code().to_string() == "PB214").count()
    };
    assert_eq!(found(2.0, 0.0), 0, "they touch");
    assert_eq!(found(1.5, 0.0), 2);
    assert_eq!(found(1.5, 1.18), 2);
    assert_eq!(found(1.5, 1.2), 1, "above the lower component");
}

/// The values of a project decide whether its component is cut through, and thus whether material is left and whether the part is loose. The
/// component alone is checked with the first value only.
#[test]
fn components_are_checked_with_the_values_of_the_project() {
    let found = |verb: &str, values: &str, value: &str| {
        let component = component()
            .replace("B0 D0.8 P3 U8 MX", &format!("B0 D0.8 P3 U8 MX :A{values}"))
            .replace("bars 3,-12 27,-12", &format!("{verb} 3,-12 27,-12"))
            .replace("bars to 27,12 3,12", &format!("{verb} to 27,12 3,12"))
            .replace(" 3,-12\nsweep", &format!("\n{verb} to 3,-12 \"B=A\"\nsweep"));
        let project = format!(
            "layer 8001.1P\nstart -10,0 \"T2 O2 MX\"\nsweep -10,0 0,0\nsubpath 0,0 30,0 \">1234.1P :A{value}\"\nend 30,0\n"
        );
        let files = [("8001.1P.dxf", &*project), ("1234.1P.dxf", &*component)];
        let found = PartTest::default().diagnostics(&files);
        let codes = found.iter().map(|found| found.code().to_string());
        codes.filter(|code| ["PB215", "PB217"].contains(&code.as_str())).collect::<Vec<_>>()
    };
    assert_eq!(found("bars", "0,0.5", "0"), [""; 0]);
    assert_eq!(found("bars", "0,0.001", "0.001"), [""; 0], "just deep enough");
    assert_eq!(found("bars", "0,0.002", "0.002"), ["PB215"], "just not");
    assert_eq!(found("bars", "0,0.5", "0.5"), ["PB215"]);
    assert_eq!(found("mill", "0.5,0", "0.5"), ["PB215", "PB215"], "of the project and of the component");
    assert_eq!(found("mill", "0.5,0", "0"), ["PB217", "PB215"], "of the project, and of the component");
    assert_eq!(found("mill", "0,0.5", "0.5"), ["PB215", "PB217"], "of the project, and of the component");
}

/// A path that only engraves leaves the outline to others; if there are none, the outline is not cut. A path with a through cut or support bars
/// anywhere should also cut through along the outline: bars hold nothing where the plate is whole.
#[test]
fn only_paths_with_through_cuts_or_bars_leave_material() {
    let path = |other: &str| {
        format!(
            "{START}sweep -5,-5 0,0\nmill 0,0 40,0 \"B0.5\"\nsweep 40,0 0,-10\nmill 0,-10 20,-10 \"B{other}\"\n\
             sweep 20,-10 50,-5\nend 50,-5\n{EDGE}"
        )
    };
    let left = |other: &str| codes(&path(other)).contains(&"PB215".to_owned());
    assert_eq!(codes(&path("0.5")), ["PB220"], "it only engraves");
    let other = "layer 1234.1L\nstart 0,0 \"T2 O2 I1 B0 S5\"\nmill 0,0 40,0\nend 40,0\n";
    let both = PartTest::default().codes(&[("1234.1.dxf", &(path("0.5") + other))]);
    assert_eq!(both, [""; 0], "another path cuts the outline");
    assert!(left("0"), "it goes through elsewhere");
    let with_bars = path("0.5").replace("mill 0,-10 20,-10", "bars 0,-10 20,-10");
    assert!(codes(&with_bars).contains(&"PB215".to_owned()), "it has support bars elsewhere");
    // A minus sign was forgotten: nothing is cut out.
    let contour = |bottom: &str| {
        format!(
            "layer 1234.1P\nstart -1,-1 \"T2 O2 I0.5 B{bottom} D1 P3 U8 MX\"\nbars -1,-1 41,-1\nbars to 41,21 -1,21 -1,-1\n\
             sweep -1,-1 50,-1\nend 50,-1\nlayer Part\npolyline 0,0 40,0 40,20 0,20 closed\n"
        )
    };
    assert_eq!(codes(&contour("-0.2")), [""; 0]);
    assert_eq!(codes(&contour("0.2")), ["PB215"]);
}

/// A neighbour's contour that meets the cuts beside the support bars separates the bars from the plate, though it does not cut the bars.
#[test]
fn neighbours_leave_the_plate_behind_support_bars() {
    let component = "layer 1234.1P\nstart 0,0 \"T2 O2 I0.5 B0 D0.8 P2 U8 MX\"\nsweep 0,0 -1,-1\n\
                     bars -1,-1 41,-1\nmill to 41,20 -1,20 -1,-1\nsweep -1,-1 50,0\nend 50,0\n\
                     layer Part\npolyline 0,0 40,0 40,19 0,19 closed\n";
    let loose = |gap: f64| {
        let y = -19.0 - gap;
        let project = format!(
            "layer 8001.1P\nstart 0,0 \"T2 O2 MX\"\nsubpath 0,0 50,0 \">1234.1P\"\n\
             sweep 50,0 0,{y}\nsubpath 0,{y} 50,{y} \">1234.1P\"\nend 50,{y}\n"
        );
        let found = PartTest::default().diagnostics(&[("8001.1P.dxf", &project), ("1234.1P.dxf", component)]);
        let found = found.iter().filter(|found| found.code().to_string() != "PB210");
        found.map(|found| format!("{} {}", found.code(), found.text(Lang::En))).collect::<Vec<_>>()
    };
    assert_eq!(loose(4.11), [""; 0], "some plate remains between the cuts");
    let found = loose(4.09);
    assert!(found.len() == 1 && found[0].starts_with("PB217 after this cut"), "{found:?}");
}

/// A cut of another component beside the part does not enter the part, but removes the part's bars if it goes deeper than their upper sides.
#[test]
fn bars_must_not_be_cut_by_other_components() {
    let plate = format!(
        "{}sweep -5,-5 0,0\nbars 0,0 42,0\nbars to 42,27 0,27 0,0\nsweep 0,0 50,-5\nend 50,-5\n\
         layer Part\npolyline 1,1 41,1 41,26 1,26 closed\n",
        START.replace("T2", "T2 Mx")
    );
    let cut = |bottom: f64| {
        format!("layer 1300.1P\nstart 0,0 \"T2 O2 Mx I1 B{bottom} S5\"\nmill 0,0 42,0\nend 42,0\n")
    };
    let project = "layer 8001.1P\nstart 0,0 \"T2 O2 S20\"\nsubpath 0,0 55,0 \">1234.1P Mx\"\n\
                   sweep 55,0 5,5\nsubpath 5,5 47,5 \">1300.1P Mx\"\nend 47,5\n";
    let lost = |bottom: f64| {
        let files = [("8001.1P.dxf", project), ("1234.1P.dxf", &plate), ("1300.1P.dxf", &cut(bottom))];
        let mut found = PartTest::default().diagnostics(&files);
        found.retain(|found| ["PB214", "PB218"].contains(&found.code().to_string().as_str()));
        found
    };
    assert_eq!(lost(0.8), [], "at D of the bars");
    let found = lost(0.77);
    let [found] = &found[..] else { panic!("once for all bars: {found:?}") };
    assert!((number(found, "count") - 4.0).abs() < 1e-9, "two corners, and two bars between: {found:?}");
    let text = found.text(Lang::En);
    assert!(text.contains("3 of the 3 mm") && text.contains("in the program"), "{text}");
}

/// Half bars that meet at a corner are one bar, which stands at the corner.
#[test]
fn a_bar_round_a_corner_is_one_bar() {
    let lost = |ways: &str| {
        let drawing = format!(
            "{}layer 1234.1L\nstart -8,-8 \"T2 O2 I0.5 B-0.2 S5\"\nsweep -8,-8 -3,0\n{ways}\nend 60,-5\n",
            plate("bars")
        );
        let found = PartTest::default().diagnostics(&[("1234.1.dxf", &drawing)]);
        let bars = found.into_iter().filter(|found| found.code().to_string() == "PB218");
        let numbers = |found: &pathbuild_diagnostic::Diagnostic| {
            ["lost", "length", "count"].map(|name| (number(found, name) * 100.0).round() / 100.0)
        };
        bars.map(|found| (numbers(&found), found.argument("point").cloned())).collect::<Vec<_>>()
    };
    let corner = lost("mill -3,0 0,0\nsweep 0,0 60,-5");
    let at = |x: f64| Some(pathbuild_diagnostic::Value::Point(Point::new(x, 0.0)));
    assert_eq!(corner, [([1.96, 3.0, 1.0], at(0.0))]);
    // Two elements that take the same bar are one finding, at the element that takes most of it.
    assert_eq!(lost("mill -3,0 -0.5,0\nmill to 1,0\nsweep 1,0 60,-5"), [([2.48, 3.0, 1.0], at(0.0))]);
    // The second element cuts away three bars: the two between the corners, and the one at the far corner.
    let side = lost("mill -3,0 5,0\nmill to 45,0\nsweep 45,0 60,-5");
    assert_eq!(side.iter().map(|(numbers, _)| numbers[2]).collect::<Vec<_>>(), [1.0, 3.0], "{side:?}");
}

/// A raised component is on a raised plate, through which the cuts of the other component go. The raised component's own cuts enter the other plate
/// only if they end below that plate's upper face at Z2.
#[test]
fn heights_of_embeddings_raise_the_plate() {
    let component = component();
    let count = |height: f64| {
        let project = project(1.5, height);
        let found =
            PartTest::default().diagnostics(&[("8001.1P.dxf", &project), ("1234.1P.dxf", &component)]);
        found.iter().filter(|found| found.code().to_string() == "PB214").count()
    };
    assert_eq!(count(0.0), 2);
    assert_eq!(count(0.3), 2, "nearly through the lower plate");
    assert_eq!(count(1.98), 2, "0.02 mm deep");
    assert_eq!(count(1.995), 1, "it hardly touches the lower plate");
    assert_eq!(count(2.5), 1);
}

#[test]
fn chords_instead_of_an_arc_are_as_exact_as_their_sagitta() {
    let disc = |sagitta: f64| {
        let radius: f64 = 20.0;
        let count = (std::f64::consts::PI / (2.0 * sagitta / radius).sqrt()).ceil();
        let point = |number: f64| {
            let at = direction(number / count * 360.0) * radius;
            format!("{},{}", at.x, at.y)
        };
        let first = point(0.0);
        let mut way = format!("{START}sweep -5,-5 {first}\nmill {first}");
        for number in 1..=count as u32 {
            way += &format!(" {}", point(f64::from(number)));
        }
        format!("{way}\nsweep {first} 50,-5\nend 50,-5\nlayer Part\ncircle 0,0 d 38\n")
    };
    assert_eq!(codes(&disc(0.01)), ["PB212", "PB217"]);
    assert_eq!(codes(&disc(0.03)), ["PB212", "PB213", "PB217"]);
}

#[test]
fn what_is_milled_twice_or_not_moved_at_all_changes_nothing() {
    let twice =
        plate("bars").replace("sweep 0,0 50,-5", "sweep 0,0 11,13\nmill circle 11,13 d 8\nsweep 11,13 50,-5");
    assert_eq!(messages(&twice), [""; 0]);
}

#[test]
fn an_opening_may_be_cleared_in_a_zigzag() {
    let mut way = "sweep 31,13 6,6\nmill 6,6".to_owned();
    for row in 0..8 {
        let y = 6 + 2 * row;
        let to = if row % 2 == 0 { 16 } else { 6 };
        way += &format!(" {to},{y}");
        if row < 7 {
            way += &format!(" {to},{}", y + 2);
        }
    }
    let drawing = plate("bars")
        .replace("sweep -5,-5 11,13\nmill circle 11,13 d 10\nsweep 11,13 31,13", "sweep -5,-5 31,13")
        .replace("sweep 31,13 0,0", &format!("{way}\nmill 6,6 6,20\nmill 16,6 16,20\nsweep 6,20 0,0"))
        .replace("circle 11,13 d 10\n", "polyline 5,5 17,5 17,21 5,21 closed\n");
    let found: Vec<String> = codes(&drawing);
    assert!(
        !found.contains(&"PB213".to_owned()) && !found.contains(&"PB215".to_owned()),
        "{:?}",
        messages(&drawing)
    );
}

#[test]
fn a_hole_that_the_part_lacks_is_a_gouge() {
    let drawing =
        plate("bars").replace("sweep 31,13 0,0", "sweep 31,13 21,13\nmill circle 21,13 d 2\nsweep 21,13 0,0");
    let found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
    let [found] = &found[..] else { panic!("{found:?}") };
    // The centre is 5 mm from the edge of the larger opening, and the radius is 1 mm.
    assert!((number(found, "depth") - 6.0).abs() < 1e-6, "{found:?}");
}

/// If one circle is inside another, as for a hole and its thread, the path must cut only one of them, whichever it is.
#[test]
fn of_rings_in_each_other_one_must_be_cut() {
    let drawing = plate("bars") + "circle 31,13 d 5\n";
    assert_eq!(messages(&drawing), [""; 0]);
    let drawing = plate("bars") + "circle 31,13 d 7\n";
    assert_eq!(messages(&drawing), [""; 0]);
    let drawing = plate("bars") + "circle 21,13 d 5\n";
    assert_eq!(codes(&drawing), ["PB220"]);
}

/// A hole of 6 mm with a thread of 8.4 mm round it is milled with other diameters: neither outline is cut.
#[test]
fn of_rings_in_each_other_the_one_that_is_cut_must_be_met() {
    let milled = |diameter: f64| {
        let drawing = plate("bars") + "circle 31,13 d 8.4\n";
        messages(&drawing.replace("mill circle 31,13 d 6", &format!("mill circle 31,13 d {diameter}")))
    };
    let left = |found: &[String], thickness: &str| {
        found.len() == 1 && found[0].starts_with(&format!("PB215 up to {thickness} mm"))
    };
    assert_eq!(milled(5.97), [""; 0], "within the tolerance");
    assert!(left(&milled(5.8), "0.1"), "{:?}", milled(5.8));
    assert_eq!(milled(6.03), [""; 0], "within the tolerance");
    let gouged = |found: &[String], depth: &str| {
        found.len() == 1 && found[0].starts_with(&format!("PB213 the cutter goes {depth} mm"))
    };
    assert!(gouged(&milled(6.2), "0.1"), "nearer to the hole: {:?}", milled(6.2));
    assert!(gouged(&milled(7.15), "0.575"), "{:?}", milled(7.15));
    assert!(left(&milled(7.25), "0.575"), "nearer to the thread: {:?}", milled(7.25));
    assert!(left(&milled(7.9), "0.25"), "{:?}", milled(7.9));
    assert_eq!(milled(8.4), [""; 0]);
}

/// The edge of a pocket or of a chamfer lies around a hole that is cut, but is not cut itself: it is a line on the part.
#[test]
fn outlines_around_openings_are_lines_on_the_part_unless_they_are_cut() {
    let with = |outlines: &str, cut: &str| {
        let end = cut.lines().last().and_then(|line| line.split(' ').nth(2)).unwrap_or_default();
        let way = format!("sweep 31,13 20,6\n{cut}\nsweep {end} 0,0");
        codes(&(plate("bars").replace("sweep 31,13 0,0", &way) + outlines))
    };
    let (groove, through) = ("mill 20,6 24,6 \"B1\"", "mill 20,6 24,6");
    let chamfer = "polyline 1.5,1.5 40.5,1.5 40.5,25.5 1.5,25.5 closed\n";
    let pasted = "polyline 1.015,1 41.015,1 41.015,26 1.015,26 closed\n";
    let pocket = "polyline 19,5 37,5 37,19 19,19 closed\n";
    assert_eq!(with(pasted, groove), ["PB219"]);
    assert_eq!(with(pasted, through), ["PB213", "PB219"]);
    for outlines in [chamfer, pocket, &format!("{chamfer}{pocket}")] {
        assert_eq!(with(outlines, groove), [""; 0], "{outlines}");
        assert_eq!(with(outlines, through), ["PB213"], "{outlines}");
        assert_eq!(
            with(&format!("{outlines}circle 23,13 d 3\n"), groove),
            ["PB220"],
            "a second hole: {outlines}"
        );
    }
    // One side is cut through the plate, and then all of them.
    assert_eq!(with(pocket, "mill 20,6 36,6"), ["PB213"]);
    let all = "mill 20,6 36,6\nmill 36,6 36,18\nmill 36,18 20,18\nmill 20,18 20,6";
    assert_eq!(with(pocket, all), [""; 0], "an opening");
}

/// A hole is 2.9 or 3.1 mm from the edge, along which a cutter of 6 mm runs: material of the part lies between the two, so the cut is not for the
/// hole.
#[test]
fn cuts_behind_the_material_of_the_part_do_not_cut_a_hole() {
    let with = |web: f64| {
        codes(&format!(
            "layer 1234.1P\nstart -9,-9 \"T2 O6 I0.5 B-0.2 D0.8 P3 U12 S5\"\nsweep -9,-9 -2,-2\nbars -2,-2 44,-2\n\
             bars to 44,29 -2,29 -2,-2\nsweep -2,-2 50,-9\nend 50,-9\nlayer Part\n\
             polyline 1,1 41,1 41,26 1,26 closed\ncircle {},13 d 8\n",
            5.0 + web
        ))
    };
    assert_eq!(with(2.9), ["PB220"]);
    assert_eq!(with(3.1), ["PB220"]);
    // A cut through the material beside a hole is an error itself, so the hole is not reported as well.
    let beside =
        plate("bars").replace("sweep 31,13 0,0", "sweep 31,13 21,13\nmill circle 21,13 d 2\nsweep 21,13 0,0");
    assert_eq!(codes(&(beside + "circle 21,15.5 d 2\n")), ["PB213"]);
}

#[test]
fn a_group_in_the_expression_names_the_path() {
    let part = |layer: &str| plate("bars").replace("layer Part", &format!("layer \"{layer}\""));
    let test = PartTest { pattern: Some("Part ([0-9_]+)"), ..PartTest::default() };
    assert_eq!(test.codes(&[("1234.1P.dxf", &part("Part 1234_1"))]), [""; 0]);
    let found = test.diagnostics(&[("1234.1P.dxf", &part("Part 1234_2"))]);
    let [found] = &found[..] else { panic!("once for all outlines: {found:?}") };
    let text = "layer Part 1234_2 names path 1234.2, which this drawing does not have, so this part is only checked for cuts into it";
    assert_eq!((found.code().to_string(), found.text(Lang::En)), ("PB220".to_owned(), text.to_owned()));
    assert_eq!(test.codes(&[("1234.1P.dxf", &part("Part 1234_"))]), ["PB220"], "digits follow");
    let test = PartTest { pattern: Some("Part ?([0-9_]*)"), ..PartTest::default() };
    assert_eq!(test.codes(&[("1234.1P.dxf", &part("Part"))]), [""; 0], "an empty group");
}

/// The second path is more than O away from all outlines of the part.
#[test]
fn a_path_that_cuts_through_the_inside_of_a_part_is_found() {
    let second = |from: &str, to: &str, bottom: f64| {
        let drawing = format!(
            "{}layer 1234.1L\nstart -8,-8 \"T2 O2 I0.5 B{bottom} S5\"\nsweep -8,-8 {from}\nmill {from} {to}\n\
             sweep {to} 60,-5\nend 60,-5\n",
            plate("bars")
        );
        PartTest::default().diagnostics(&[("1234.1.dxf", &drawing)])
    };
    let found = second("16,21", "26,21", 0.0);
    let [found] = &found[..] else { panic!("{found:?}") };
    assert_eq!((found.code().to_string().as_str(), found.path.as_deref()), ("PB213", Some("1234.1L")));
    assert!((number(found, "length") - 10.0).abs() < 1e-6, "{found:?}");
    assert_eq!(second("16,21", "26,21", 0.002), [], "a groove");
    assert_eq!(second("10,13", "12,13", 0.0), [], "in an opening");
    assert_eq!(second("16,31", "26,31", 0.0), [], "outside");
}

/// The second path runs along the upper side between two bars.
#[test]
fn a_group_hides_no_cut_into_the_part_by_other_paths() {
    let second = |y: f64| {
        let drawing = format!(
            "{}layer 1234.2P\nstart -8,-8 \"T2 O2 I0.5 B0 S5\"\nsweep -8,-8 23,{y}\nmill 23,{y} 19,{y}\n\
             sweep 19,{y} 60,-5\nend 60,-5\n",
            plate("bars").replace("layer Part", "layer \"Part 1234_1\"")
        );
        let test = PartTest { pattern: Some("Part ([0-9_]+)"), ..PartTest::default() };
        test.codes(&[("1234.dxf", &drawing)])
    };
    assert_eq!(second(26.97), ["PB213"], "into the part");
    assert_eq!(second(26.99), [""; 0], "within the tolerance");
    assert_eq!(second(27.5), [""; 0], "what it leaves is not its own");
}

/// The findings are the same far from the origin, rotated, and with three decimals.
#[test]
fn places_and_directions_do_not_matter() {
    for degrees in [0.0_f64, 33.3, 180.0] {
        let (cos, sin) = (direction(degrees).x, direction(degrees).y);
        let at =
            |x: f64, y: f64| format!("{:.3},{:.3}", 1600.0 + x * cos - y * sin, 700.0 + x * sin + y * cos);
        let drawing = |y: f64| {
            format!(
                "layer 1234.1P\nstart {} \"T2 O2 I1 B0 S5\"\nmill {} {}\nend {}\nlayer Part\n\
                 polyline {} {} {} {} closed\n",
                at(0.0, y),
                at(0.0, y),
                at(40.0, y),
                at(40.0, y),
                at(0.0, 1.0),
                at(40.0, 1.0),
                at(40.0, 20.0),
                at(0.0, 20.0)
            )
        };
        assert_eq!(codes(&drawing(0.0)), [""; 0], "{degrees}");
        assert_eq!(codes(&drawing(0.018)), [""; 0], "{degrees}");
        assert_eq!(codes(&drawing(0.022)), ["PB213"], "{degrees}");
        assert_eq!(codes(&drawing(-0.022)), ["PB215"], "{degrees}");
    }
}

#[test]
fn a_part_belongs_to_paths_within_the_cutter_diameter() {
    let beside = |y: f64| {
        let found = codes(&format!(
            "{START}sweep -5,-5 0,{y}\nmill 0,{y} 40,{y}\nsweep 40,{y} 50,-5\nend 50,-5\n{EDGE}"
        ));
        found.into_iter().filter(|code| code == "PB215" || code == "PB220").collect::<Vec<_>>()
    };
    assert_eq!(beside(-0.99), ["PB215"]);
    assert_eq!(beside(-1.01), ["PB220"]);
}

/// A path that is too far outside leaves no material where another path cuts. Material that both leave is reported once.
#[test]
fn what_paths_leave_is_judged_on_their_union() {
    let path = |letter: &str, y: f64| {
        format!(
            "layer 1234.1{letter}\nstart -5,-5 \"T2 O2 I0.5 B-0.2 S5\"\nsweep -5,-5 0,{y}\n\
             mill 0,{y} 40,{y}\nsweep 40,{y} 50,-5\nend 50,-5\n"
        )
    };
    let left = |drawing: &str| {
        let found = PartTest::default().diagnostics(&[("1234.1.dxf", drawing)]);
        found.iter().filter(|found| found.code().to_string() == "PB215").count()
    };
    assert_eq!(left(&format!("{}{EDGE}", path("L", -0.5))), 1, "alone");
    assert_eq!(left(&format!("{}{}{EDGE}", path("P", 0.0), path("L", -0.5))), 0, "beside a right one");
    assert_eq!(left(&format!("{}{}{EDGE}", path("P", -0.6), path("L", -0.5))), 1, "beside a worse one");
}

/// A mark half of O beside an outline is a line type that was chosen by mistake: it touches nothing but waste.
#[test]
fn a_mark_along_an_outline_does_not_cut_it() {
    let along = |verb: &str, y: f64, depth: &str| {
        let drawing = format!(
            "{START}sweep -5,-5 0,{y}\n{verb} 0,{y} 40,{y} \"{depth}\"\nsweep 40,{y} 0,-10\n\
             mill 0,-10 20,-10 \"B0\"\nsweep 20,-10 50,-5\nend 50,-5\n{EDGE}"
        );
        codes(&drawing).contains(&"PB215".to_owned())
    };
    for (verb, depth) in [("mark", "D1.5"), ("mill", "B1.5")] {
        assert!(along(verb, 0.0, depth));
        assert!(along(verb, -0.019, depth));
        assert!(!along(verb, -0.021, depth), "farther outside than the tolerance");
        assert!(along(verb, 0.019, depth));
        assert!(!along(verb, 0.021, depth), "a groove in the part");
    }
}

/// A cut with the whole cutter inside the part is meant as a groove, or as a sweep.
#[test]
fn a_cut_inside_the_part_is_told_to_state_b_or_to_be_a_sweep() {
    let names_b = |y: f64| {
        let drawing =
            format!("{START}sweep -5,-5 5,{y}\nmill 5,{y} 35,{y}\nsweep 35,{y} 50,-5\nend 50,-5\n{EDGE}");
        let found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
        let gouge = found.iter().find(|found| found.code().to_string() == "PB213").unwrap();
        gouge.help(Lang::En).unwrap().contains("write B")
    };
    assert!(names_b(2.001));
    assert!(!names_b(1.999), "the cutter touches the edge");
}

/// The contour is O or a little more or less away from the outline.
#[test]
fn an_outline_is_either_not_cut_or_has_material_left() {
    let contour = |distance: f64| {
        let (low, right, high) = (1.0 - distance, 41.0 + distance, 26.0 + distance);
        let sides =
            format!("bars {low},{low} {right},{low}\nbars to {right},{high} {low},{high} {low},{low}");
        let drawing = plate("bars")
            .replace("bars 0,0 42,0\nbars to 42,27 0,27 0,0", &sides)
            .replace("13 0,0", &format!("13 {low},{low}"))
            .replace("sweep 0,0", &format!("sweep {low},{low}"));
        codes(&drawing)
    };
    assert_eq!(contour(1.99), ["PB215"]);
    assert_eq!(contour(2.0), ["PB215"]);
    assert_eq!(contour(2.01), ["PB220"]);
}

/// The upper side of the contour is a sweep by mistake.
#[test]
fn a_sweep_in_place_of_one_side_of_the_contour_leaves_that_side() {
    let with = |upper: &str| {
        let drawing = plate("bars").replace(
            "bars to 42,27 0,27 0,0",
            &format!("bars to 42,27\nsweep 42,27 {upper} 0,27\nbars 0,27 0,0"),
        );
        messages(&drawing).into_iter().filter(|found| found.starts_with("PB215")).collect::<Vec<_>>()
    };
    let found = with("");
    assert!(found.len() == 1 && found[0].contains("only a sweep runs along the outline"), "{found:?}");
    assert_eq!(with("42,27.019 0,27.019").len(), 1, "within the tolerance");
    assert_eq!(with("42,27.021 0,27.021"), [""; 0], "farther outside");
    assert_eq!(with("42,26.979 0,26.979"), [""; 0], "farther inside");
    assert_eq!(with("20,40"), [""; 0], "leads away");
    assert_eq!(with("39,27 38,40"), [""; 0], "beside a short stretch only");
}

/// Only a short piece of the contour is a sweep. The cuts at its ends leave two rounded pieces, which join in the middle if the sweep is short.
#[test]
fn a_sweep_longer_than_the_cutter_leaves_a_piece_of_the_contour() {
    let with = |length: f64| {
        let upper =
            format!("mill 42,27 30,27\nsweep 30,27 {x},27\nmill {x},27 0,27\nbars to 0,0", x = 30.0 - length);
        let drawing = plate("bars").replace("bars to 42,27 0,27 0,0", &format!("bars to 42,27\n{upper}"));
        let mut found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
        found.retain(|found| found.code().to_string() == "PB215");
        let [found] = &found[..] else { panic!("{length}: {found:?}") };
        (found.text(Lang::En).contains("only a sweep"), number(found, "length"))
    };
    // A cut reaches the outline up to 0.2 mm beyond its end, and comes within O of it up to 1.73 mm beyond.
    for (length, is_swept) in [(3.4, false), (3.48, true), (3.5, true), (3.55, true), (3.7, true)] {
        let (swept, uncut) = with(length);
        assert_eq!(swept, is_swept, "{length}");
        assert!((uncut - (length - 0.4)).abs() < 0.01, "{length}: {uncut}");
    }
}

/// The ends of a flat bar are cut, and a sweep along one of its edges leads from one cut to the other.
#[test]
fn a_sweep_along_the_edge_of_a_flat_bar_is_no_missing_cut() {
    let flat_bar = |right: &str| {
        format!(
            "{START}sweep -5,-5 0,0\nmill 0,0 0,27\nsweep 0,27 42,27\nmill 42,27 42,0\n{right}\nend 50,-5\n\
             layer Part\npolyline 1,1 41,1 41,26 1,26 closed\n"
        )
    };
    let is_found = |right: &str| codes(&flat_bar(right)).contains(&"PB215".to_owned());
    assert!(!is_found("sweep 42,0 50,-5"));
    assert!(is_found("mill 42,0 0,0\nsweep 0,0 50,-5"), "three sides are cut");
    let other =
        "layer 1234.1L\nstart -5,40 \"T2 O2 I0.5 B-0.2 S5\"\nsweep -5,40 0,27\nmill 0,27 42,27\nend 42,27\n";
    let both = format!("{}{other}", flat_bar("mill 42,0 0,0\nsweep 0,0 50,-5"));
    assert!(!codes(&both).contains(&"PB215".to_owned()), "another path cuts the fourth");
}

/// Both holes have the diameter of the cutter, and one of them is only marked.
#[test]
fn a_marked_hole_is_not_made() {
    let drawing = |mark: &str| {
        let holes =
            format!("sweep 31,13 20,20\ncircle 20,20 d 2\nsweep 20,20 24,20\n{mark}\nsweep 24,20 0,0");
        plate("bars").replace("sweep 31,13 0,0", &holes) + "circle 20,20 d 2\ncircle 24,20 d 2\n"
    };
    assert_eq!(codes(&drawing("circle 24,20 d 2")), [""; 0]);
    assert_eq!(codes(&drawing("mark circle 24,20 d 2 \"D1.8\"")), ["PB215"]);
}

/// The outline that the project draws round an embedded part is the sheet. The embedded path may cut across it, but the project itself must not.
#[test]
fn outlines_of_a_project_round_components_are_for_its_own_cuts() {
    let component = component();
    let drawing = |own: &str| {
        let layer = "layer Part\npolyline 2,-14 28,-14 28,14 2,14 closed\n";
        let project = project(2.0, 0.0).replace("end 30,24", own) + layer;
        PartTest::default().codes(&[("8001.1P.dxf", &project), ("1234.1P.dxf", &component)])
    };
    assert!(!drawing("end 30,24").contains(&"PB220".to_owned()), "what is embedded may cut it");
    let gouged = |codes: Vec<String>| codes.iter().any(|code| code == "PB213" || code == "PB214");
    assert!(!gouged(drawing("end 30,24")));
    assert!(gouged(drawing("sweep 30,24 2,0\nmill 2,0 28,0 \"I1 B0\"\nsweep 28,0 30,24\nend 30,24")));
}

/// A part in the project's drawing that is neither a component's nor the sheet around one must not be cut by components. The contour of the lower
/// component covers y from -13 to -11.
#[test]
fn components_do_not_cut_into_parts_of_the_project() {
    let component = component();
    let found = |outline: &str| {
        let project = project(2.0, 0.0) + &format!("layer Part\npolyline {outline} closed\n");
        let found =
            PartTest::default().diagnostics(&[("8001.1P.dxf", &project), ("1234.1P.dxf", &component)]);
        found.into_iter().filter(|found| found.code().to_string() == "PB214").collect::<Vec<_>>()
    };
    let below = |top: f64| found(&format!("5,-20 25,-20 25,{top} 5,{top}"));
    assert_eq!(below(-12.99), [], "within the tolerance");
    let gouged = below(-12.5);
    let [gouge] = &gouged[..] else { panic!("{gouged:?}") };
    assert!((number(gouge, "depth") - 0.5).abs() < 1e-6, "{gouge:?}");
    assert_eq!(gouge.path.as_deref(), Some("8001.1P"));
    // A copy of the component's outline is the component's part, even if rounding moved it.
    assert_eq!(found("4,-11 26,-11 26,11 4,11"), []);
    assert_eq!(found("26,11.009 4,11.009 4,-11 26,-11"), []);
    assert!(!found("4,-10.9 26,-10.9 26,11.1 4,11.1").is_empty(), "neither equal nor around it");
}

#[test]
fn nothing_is_compared_without_the_key() {
    let drawing = plate("mill").replace("mill 0,0 42,0", "mill 0,0 42,0.5") + "line 50,50 60,60\n";
    assert!(codes(&drawing).contains(&"PB213".to_owned()));
    let unset = PartTest { pattern: None, ..PartTest::default() };
    assert_eq!(unset.codes(&[("1234.1P.dxf", &drawing)]), ["PB212"]);
}

#[test]
fn a_gouge_names_the_element_that_cuts() {
    let drawing = plate("bars").replace("bars to 42,27 0,27 0,0", "bars to 41.5,27 0,27 0,0");
    let found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
    let gouges: Vec<_> = found.iter().filter(|found| found.code().to_string() == "PB213").collect();
    let [gouge] = gouges[..] else { panic!("{found:?}") };
    let point = gouge.place.point.as_ref().unwrap();
    assert_eq!((point.x.0, point.y.0), (42.0, 0.0), "{gouge:?}");
}

/// The ring runs 10 mm away from the part. The path belongs to the part because of the part's lower edge.
#[test]
fn a_part_is_loose_wherever_the_ring_runs() {
    let drawing = |last: &str| {
        format!(
            "{START}sweep -5,-5 0,0\nmill 0,0 40,0\nsweep 40,0 -10,-10\nmill -10,-10 50,-10 50,30 -10,30\n\
             {last} -10,30 -10,-10\nsweep -10,-10 -20,-20\nend -20,-20\n{EDGE}"
        )
    };
    assert!(codes(&drawing("mill")).contains(&"PB217".to_owned()));
    assert!(!codes(&drawing("bars")).contains(&"PB217".to_owned()));
    assert!(!codes(&drawing("sweep")).contains(&"PB217".to_owned()));
}

/// Bars within a ring that is milled all round connect the part only to material that comes loose itself, however far away the ring is.
#[test]
fn bars_within_a_closed_ring_hold_nothing() {
    let drawing = |last: &str| {
        format!(
            "{START}sweep -5,-5 0,0\nbars 0,0 40,0\nsweep 40,0 -60,-60\n\
             mill -60,-60 100,-60 100,80 -60,80\n\
             {last} -60,80 -60,-60\nsweep -60,-60 -70,-70\nend -70,-70\n{EDGE}"
        )
    };
    assert!(codes(&drawing("mill")).contains(&"PB217".to_owned()));
    assert!(!codes(&drawing("bars")).contains(&"PB217".to_owned()));
}

/// The lines of the contour pass each other at the corners. The last one ends `height` mm above the first one; both are 2 mm wide.
#[test]
fn cuts_that_cross_or_overlap_close_a_ring() {
    let is_loose = |height: f64| {
        codes(&format!(
            "{START}sweep -5,-5 -5,0\nmill -5,0 47,0\nsweep 47,0 42,-5\nmill 42,-5 42,32\nsweep 42,32 47,27\n\
             mill 47,27 -5,27\nsweep -5,27 0,32\nmill 0,32 0,{height}\nsweep 0,{height} 50,-8\nend 50,-8\n{PLATE}"
        ))
        .contains(&"PB217".to_owned())
    };
    assert!(is_loose(-5.0), "the lines cross");
    assert!(is_loose(1.99), "they overlap");
    assert!(is_loose(2.09), "a bridge too weak to hold the part");
    assert!(!is_loose(2.11), "a bridge that holds");
}

/// Another cut ends near the outline, and its box contains the outline's side, but the side's own cut is nearer.
#[test]
fn material_left_is_as_thick_as_the_distance_to_the_nearest_cut() {
    let thickness = |end: &str| {
        let drawing = format!(
            "layer 1234.1P\nstart -20,-10 \"T2 O3 I1 B0 S5\"\nsweep -20,-10 -3.02,-3.02\n\
             mill -3.02,-3.02 21.02,-3.02\nmill to 21.02,23.02 -3.02,23.02 -3.02,-3.02\n\
             sweep -3.02,-3.02 -1.9,18\nmill -1.9,18 {end}\nsweep {end} -10,-12\nend -10,-12\n\
             layer Part\npolyline 0,0 18,0 18,20 0,20 closed\n"
        );
        let mut found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
        found.retain(|found| found.code().to_string() == "PB215");
        found.iter().map(|found| number(found, "thickness")).fold(0.0, f64::max)
    };
    for end in ["-1.9,17", "-5,-3"] {
        assert!((thickness(end) - 1.52).abs() < 0.01, "{end}: {}", thickness(end));
    }
}

/// A cut that gradually approaches the edge leaves a wedge, in whichever direction it is milled.
#[test]
fn a_wedge_is_as_thick_in_both_directions() {
    let thickness = |from: f64, to: f64| {
        let drawing = format!(
            "{START}sweep -5,-5 0,{from}\nmill 0,{from} 40,{to}\nsweep 40,{to} 50,-5\nend 50,-5\n{EDGE}"
        );
        let found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
        number(found.iter().find(|found| found.code().to_string() == "PB215").expect("a wedge"), "thickness")
    };
    let [rising, falling] = [thickness(-2.0, 0.0), thickness(0.0, -2.0)];
    assert!((rising - falling).abs() < 1e-6 && (0.9..=1.0).contains(&rising), "{rising} {falling}");
}

/// The axis of the 2 mm cutter passes 0.6 mm below a corner of the part.
#[test]
fn a_gouge_at_a_corner_is_as_deep_as_the_corner_is_overlapped() {
    for corner in [17.0, 17.3, 17.45, 17.8] {
        let found = PartTest::default().diagnostics(&[(
            "1234.1P.dxf",
            &format!(
                "{START}sweep -5,-5 0,0\nmill 0,0 40,0\nsweep 40,0 50,-5\nend 50,-5\n\
                 layer Part\npolyline 0,2 {corner},0.6 40,8 40,20 0,20 closed\n"
            ),
        )]);
        let gouge = found.iter().find(|found| found.code().to_string() == "PB213").expect("a gouge");
        assert!((number(gouge, "depth") - 0.4).abs() < 1e-4, "{corner}: {gouge:?}");
    }
}

/// The name and O of the path select a slot cutter, which cuts beside the drawn line: it leaves nothing, cuts nothing out, and suppresses no
/// finding about material that others leave.
#[test]
fn slot_cutters_are_searched_for_gouges_only() {
    let path = |letter: &str, tool: u32, y: f64| {
        format!(
            "layer 1234.1{letter}\nstart -5,-5 \"T2 O{tool} I0.5 B-0.2 S5\"\nsweep -5,-5 0,{y}\n\
             mill 0,{y} 40,{y}\nsweep 40,{y} 50,-5\nend 50,-5\n"
        )
    };
    let codes = |drawing: &str| PartTest::default().codes(&[("1234.1.dxf", drawing)]);
    assert_eq!(codes(&format!("{}{EDGE}", path("P", 2, -0.5))), ["PB215"]);
    assert_eq!(codes(&format!("{}{EDGE}", path("S", 2, -0.5))), [""; 0]);
    assert_eq!(codes(&format!("{}{EDGE}", path("S", 3, -1.0))), ["PB215"], "another cutter");
    assert_eq!(codes(&format!("{}{EDGE}", path("S", 2, 0.5))), ["PB213"]);
    let both = format!("{}{}{EDGE}", path("P", 2, -0.5), path("S", 2, 0.0));
    assert_eq!(codes(&both), ["PB215"], "what the slot cutter takes");

    let ring = |letter: &str| plate("mill").replace("layer 1234.1P", &format!("layer 1234.1{letter}"));
    assert_eq!(codes(&ring("L")), ["PB212", "PB217"]);
    assert_eq!(codes(&ring("S")), ["PB212"]);
}

/// A cutter of 2 mm beside an edge cuts 0.2 mm beyond the end of its line.
#[test]
fn stretches_below_a_tenth_are_no_leftover() {
    let gap = |to: f64| {
        codes(&format!(
            "{START}sweep -5,-5 0,0\nmill 0,0 20,0\nsweep 20,0 {to},0\nmill {to},0 40,0\nsweep 40,0 50,-5\n\
             end 50,-5\n{EDGE}"
        ))
    };
    assert!(!gap(20.49).contains(&"PB215".to_owned()));
    assert!(gap(20.52).contains(&"PB215".to_owned()));
}

/// A groove across the edge does not count as milling the edge; one along the edge does, so the material that it leaves is reported.
#[test]
fn a_groove_across_the_rim_leaves_nothing() {
    let groove = |way: &str, end: &str| {
        let drawing = format!(
            "{START}sweep -5,-5 0,0\nmill 0,0 40,0\nsweep 40,0 {way}\nsweep {end} 80,-5\nend 80,-5\n{EDGE}"
        );
        codes(&drawing).contains(&"PB215".to_owned())
    };
    assert!(!groove("60,10\nmill 60,10 38,10 \"B0.5\"", "38,10"));
    assert!(groove("41,5\nmill 41,5 41,15 \"B0.5\"", "41,15"));
}

/// The cuts of a path with errors are unknown, so leftover material is not reported; cuts into the part are found nevertheless.
#[test]
fn beside_a_path_with_errors_only_gouges_are_found() {
    let path = |y: f64, other: &str| {
        let found = PartTest::default().codes(&[(
            "1234.1.dxf",
            &format!(
                "layer 1234.1P\nstart -5,-5 \"T2 O2 I0.5 B-0.2 S5\"\nsweep -5,-5 0,{y}\n\
                 mill 0,{y} 40,{y}\nsweep 40,{y} 50,-5\nend 50,-5\n{other}{EDGE}"
            ),
        )]);
        found.into_iter().filter(|code| code.starts_with("PB21")).collect::<Vec<_>>()
    };
    let other = |infeed: &str| {
        format!("layer 1234.1L\nstart 0,40 \"T2 O2 I{infeed} B-0.2 S5\"\nmill 0,40 40,40\nend 40,40\n")
    };
    assert_eq!(path(-0.5, &other("0.5")), ["PB215"]);
    assert_eq!(path(-0.5, &other("x")), [""; 0]);
    assert_eq!(path(0.5, &other("x")), ["PB213"]);
}

/// A helix, the circle below it and the passes that leave bars run along the same circle. Its length counts once, as seen from above.
#[test]
fn the_length_of_a_circle_in_the_part_counts_once() {
    let length = |text: &str, verb: &str, [cut, drawn]: [f64; 2]| {
        let drawing = format!(
            "layer 1234.1P\nstart -15,-15 \"{text}\"\nsweep -15,-15 11,13\n{verb} circle 11,13 d {cut}\n\
             sweep 11,13 50,-5\nend 50,-5\nlayer Part\npolyline -20,-20 41,-20 41,46 -20,46 closed\n\
             circle 11,13 d {drawn}\n"
        );
        let found = PartTest::default().diagnostics(&[("1234.1P.dxf", &drawing)]);
        let gouge = found.iter().find(|found| found.code().to_string() == "PB213");
        number(gouge.unwrap_or_else(|| panic!("{found:?}")), "length")
    };
    let turn = std::f64::consts::TAU;
    for bottom in ["0", "-0.2", "-0.9"] {
        for infeed in ["1", "0.7"] {
            let text = format!("T3 O2 I{infeed} B{bottom} D1.2 P3 U9 A40 S5");
            let helix = length(&text, "mill", [6.0, 5.6]);
            assert!((helix - 2.0 * turn).abs() < 1e-6, "{text}: {helix}");
            let with_bars = length(&text, "bars", [22.0, 21.6]);
            assert!((with_bars - 10.0 * turn).abs() < 1e-6, "{text}: {with_bars}");
        }
    }
}

#[test]
fn a_hole_in_the_part_is_told_without_a_length() {
    let found = messages(
        &plate("bars").replace("sweep 31,13 0,0", "sweep 31,13 25,20\ncircle 25,20 d 2\nsweep 25,20 0,0"),
    );
    assert_eq!(found, ["PB213 the hole, O2, goes 7 mm into the part at (25, 20)"]);
}

/// A text without an element hides no other finding, unless it may be the depth of the cut.
#[test]
fn a_stray_text_hides_no_cut_into_the_part() {
    let with = |text: &str| {
        let cut = "sweep 31,13 0,0.5\nmill 0,0.5 42,0.5\nmill to 42,27 0,27 0,0.5\nsweep 0,0.5 50,-5";
        let drawing = plate("mill");
        let begin = drawing.find("sweep 31,13").unwrap();
        let end = drawing.find("end 50,-5").unwrap();
        codes(&format!("{}{cut}\n{text}\n{}", &drawing[..begin], &drawing[end..]))
    };
    let cut = ["PB212", "PB213", "PB217"];
    assert_eq!(with(""), cut);
    assert_eq!(with("text 80,80 \"Deckel links\""), [&["PB107"], &cut[..]].concat());
    assert_eq!(with("text 80,80 \"F90\""), [&["PB107"], &cut[..]].concat());
    assert_eq!(with("text 80,80 \"B0.5\""), ["PB107", "PB212"], "it may be a groove");
}
