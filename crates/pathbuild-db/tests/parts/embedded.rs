//! Tests how components of a project lie to each other: halves of one part, parts in openings, and parts drawn in openings.

use pathbuild_db::{Role, Target, check_joined_parts};
use pathbuild_diagnostic::{Diagnostic, Lang, Point, Value};

use crate::{PartTest, codes, number};

/// Returns a drawing with the left and the right half of a contour round a plate of 40 x 20 mm. The right half starts at `start`.
fn halves(start: &str) -> String {
    format!(
        "layer 1234.1L\nstart 21,0 \"T2 O2 I1 B0 D1 P4 U10 S5 MX\"\nbars 21,0 0,0\nbars to 0,22 21,22\nend 21,22\n\
         layer 1234.1R\nstart {start} \"T2 O2 I1 B0 D1 P4 U10 S5 MX\"\nsweep {start} 21,22\nbars 21,22 42,22\n\
         bars to 42,0 21,0\nsweep 21,0 30,-8\nend 30,-8\nlayer Part\npolyline 1,1 41,1 41,21 1,21 closed\n"
    )
}

/// Returns a project with copies of the left and the right half, each from the start to the end of its line.
fn project(embedded: &[(char, [f64; 4])]) -> String {
    let mut text = "layer 8001.1P\nstart -50,-50 \"T2 O2 S5 MX\"\n".to_owned();
    let mut at = [-50.0, -50.0];
    for (half, [x, y, next_x, next_y]) in embedded {
        text += &format!(
            "sweep {},{} {x},{y}\nsubpath {x},{y} {next_x},{next_y} \">1234.1{half}\"\n",
            at[0], at[1]
        );
        at = [*next_x, *next_y];
    }
    text + &format!("end {},{}\n", at[0], at[1])
}

/// Returns the findings with a code about a project with these drawings.
fn found(code: &str, test: &PartTest<'_>, files: &[(&str, &str)]) -> Vec<Diagnostic> {
    let mut found = test.diagnostics(files);
    found.retain(|found| found.code().to_string() == code);
    found
}

fn displaced(embedded: &[(char, [f64; 4])]) -> Vec<Diagnostic> {
    let (project, halves) = (project(embedded), halves("30,30"));
    let files = [("8001.1P.dxf", &*project), ("1234.1L-1234.1R.dxf", &*halves)];
    found("PB221", &PartTest::default(), &files)
}

const LEFT: (char, [f64; 4]) = ('L', [21.0, 0.0, 21.0, 22.0]);

fn right(x: f64, y: f64) -> (char, [f64; 4]) {
    ('R', [30.0 + x, 30.0 + y, 30.0 + x, y - 8.0])
}

#[test]
fn halves_of_a_part_lie_as_in_their_drawing() {
    for (x, is_displaced) in [
        (0.0, false),
        (0.019, false),
        (0.021, true),
        (-0.021, true),
        (1.0, true),
        (1.99, true),
        (2.01, false),
    ] {
        let found = displaced(&[LEFT, right(x, 0.0)]);
        assert_eq!(found.len(), usize::from(is_displaced), "{x}: {found:?}");
        if is_displaced {
            assert!((number(&found[0], "distance") - x.abs()).abs() < 1e-6, "{x}: {found:?}");
            assert_eq!(found[0].place.point, Some(Point::new(30.0 + x, 30.0)), "the second line");
        }
    }
    assert_eq!(displaced(&[LEFT]), [], "without the other half");
    assert_eq!(displaced(&[right(0.0, 0.0), LEFT]), [], "in the other order");
}

/// The part lies at one height, so its halves must not be raised differently.
#[test]
fn halves_of_a_part_lie_at_one_height() {
    let found = |raised: f64| {
        let project = project(&[LEFT, right(0.0, 0.0)]).replace(">1234.1R", &format!(">1234.1R H{raised}"));
        let files = [("8001.1P.dxf", &*project), ("1234.1L-1234.1R.dxf", &*halves("30,30"))];
        found("PB221", &PartTest::default(), &files)
    };
    assert_eq!(found(0.019), []);
    let raised = found(0.021);
    assert_eq!(raised.len(), 1, "{raised:?}");
    assert!((number(&raised[0], "distance") - 0.021).abs() < 1e-9, "{raised:?}");
    assert_eq!(raised[0].place.point, Some(Point::new(30.0, 30.0)), "the second line");
    assert_eq!(found(2.0).len(), 1);
}

/// A path that only engraves the part may be raised to any height.
#[test]
fn an_engraving_may_be_raised() {
    let engraving = halves("30,30").replace(
        "layer 1234.1R\nstart 30,30 \"T2 O2 I1 B0 D1 P4 U10",
        "layer 1234.1R\nstart 30,30 \"T2 O2 I1 B1.5",
    );
    let engraving = engraving.replace("bars 21,22 42,22\nbars to", "mill 21,22 42,22\nmill to");
    let project = project(&[LEFT, right(0.0, 0.0)]).replace(">1234.1R", ">1234.1R H0.3");
    let files = [("8001.1P.dxf", &*project), ("1234.1L-1234.1R.dxf", &*engraving)];
    assert_eq!(found("PB221", &PartTest::default(), &files), []);
}

/// The message names where both paths place the part, in the program, which begins at the start marker.
#[test]
fn both_places_of_the_part_are_named() {
    let found = displaced(&[LEFT, right(0.5, 0.25)]);
    let point = |name: &str| found[0].argument(name).cloned();
    // The start marker is at (-50, -50), and the outline begins at the same corner with both.
    let [Some(Value::Point(at)), Some(Value::Point(other))] = [point("point"), point("place")] else {
        panic!("{found:?}")
    };
    assert_eq!([at.x.0 - other.x.0, at.y.0 - other.y.0], [0.5, 0.25], "{}", found[0].text(Lang::En));
}

#[test]
fn each_copy_of_a_part_is_compared_with_its_own_half() {
    let moved =
        |(half, [x, y, end_x, end_y]): (char, [f64; 4]), by: f64| (half, [x, y + by, end_x, end_y + by]);
    let second = |x: f64| [LEFT, right(0.0, 0.0), moved(LEFT, 40.0), moved(right(x, 0.0), 40.0)];
    assert_eq!(displaced(&second(0.0)), []);
    assert_eq!(displaced(&second(0.5)).len(), 1);
    // A copy without its other half is left alone, unless it is near another one.
    assert_eq!(displaced(&[LEFT, right(0.0, 0.0), moved(LEFT, 40.0)]), []);
    assert_eq!(displaced(&[LEFT, right(0.0, 0.0), moved(LEFT, 0.5)]).len(), 1);
}

/// Joined programs begin at the same place, so the halves must begin at the same point of their drawing.
#[test]
fn joined_halves_begin_at_the_same_point() {
    let found = |start: &str| {
        let halves = halves(start);
        let db = PartTest::default().database(&[("1234.1L-1234.1R.dxf", &halves)]);
        let file = pathbuild_db::Db::file(&db, "1234.1L-1234.1R.dxf".into());
        let target = |name: &str| Target::new(&db, file, name.into(), Role::Checked);
        let mut found = check_joined_parts(&db, &["1234.1L", "1234.1R"].map(target));
        found.retain(|found| found.code().to_string() == "PB221");
        found.len()
    };
    assert_eq!(found("21,0"), 0);
    assert_eq!(found("21.5,0"), 1);
    assert_eq!(found("24,0"), 0, "far away");
}

/// Returns a frame of 50 x 50 mm with an opening from (10, 10) to (40, 40), cut along `opening`.
fn frame(opening: &str) -> String {
    format!(
        "layer 1234.1P\nstart -5,-5 \"T2 O2 I1 B-0.2 D1 P4 U10 S5 MX\"\n{opening}\
         bars -1,-1 51,-1\nbars to 51,51 -1,51 -1,-1\nsweep -1,-1 55,-5\nend 55,-5\n\
         layer Part\npolyline 0,0 50,0 50,50 0,50 closed\npolyline 10,10 40,10 40,40 10,40 closed\n"
    )
}

/// Returns cuts round the opening whose last side ends at this x.
fn opening(verb: &str, end: f64) -> String {
    format!("sweep -5,-5 11,11\n{verb} 11,11 11,39\n{verb} to 39,39 39,11 {end},11\nsweep {end},11 -1,-1\n")
}

/// Returns a plate of 10 x 10 mm with bars, embedded by a line of 16 mm.
fn insert() -> String {
    "layer 1235.1P\nstart -2,-2 \"T2 O2 I1 B-0.2 D1 P2 U4 S5 MX\"\nsweep -2,-2 0,0\nbars 0,0 12,0\n\
     bars to 12,12 0,12 0,0\nsweep 0,0 14,-2\nend 14,-2\nlayer Part\npolyline 1,1 11,1 11,11 1,11 closed\n"
        .to_owned()
}

/// Returns PB222 for a project that embeds these paths, each with the start and the end of its line.
fn in_waste(frame: &str, insert: &str, lines: [[&str; 3]; 2], test: &PartTest<'_>) -> Vec<Diagnostic> {
    let [[start, end, first], [next_start, next_end, second]] = lines;
    let project = format!(
        "layer 8001.1P\nstart -60,-60 \"T2 O2 S5 MX\"\nsweep -60,-60 {start}\nsubpath {start} {end} \"{first}\"\n\
         sweep {end} {next_start}\nsubpath {next_start} {next_end} \"{second}\"\nend {next_end}\n"
    );
    found("PB222", test, &[("8001.1P.dxf", &project), ("1234.1P.dxf", frame), ("1235.1P.dxf", insert)])
}

const FRAME: [&str; 3] = ["-5,-5", "55,-5", ">1234.1P"];
const INSERT: [&str; 3] = ["17,17", "33,17", ">1235.1P"];
const BESIDE: [&str; 3] = ["60,0", "76,0", ">1235.1P"];

#[test]
fn nothing_is_milled_in_loose_waste() {
    let count =
        |frame: &str, lines: [[&str; 3]; 2]| in_waste(frame, &insert(), lines, &PartTest::default()).len();
    let closed = frame(&opening("mill", 11.0));
    let found = in_waste(&closed, &insert(), [FRAME, INSERT], &PartTest::default());
    assert_eq!(found.len(), 1, "once for all cuts: {found:?}");
    assert_eq!(found[0].place.point, Some(Point::new(17.0, 17.0)), "the later line");
    assert_eq!(count(&closed, [INSERT, FRAME]), 0, "the insert is milled first");
    assert_eq!(count(&closed, [FRAME, BESIDE]), 0, "beside the frame");
    assert_eq!(count(&frame(&opening("bars", 11.0)), [FRAME, INSERT]), 0, "bars hold the waste");
    let held = PartTest { is_held_otherwise: true, ..PartTest::default() };
    assert_eq!(in_waste(&closed, &insert(), [FRAME, INSERT], &held), []);
}

/// Elements of the project itself are milled between the paths that it embeds.
#[test]
fn a_project_cuts_nothing_in_loose_waste_itself() {
    let count = |opening: &str, cut: &str, is_after: bool| {
        let frame = frame(opening);
        let embedded = "subpath -5,-5 55,-5 \">1234.1P\"\n";
        let elements = if is_after {
            format!("{embedded}sweep 55,-5 20,20\n{cut}sweep 30,30 60,60\n")
        } else {
            format!("sweep -5,-5 20,20\n{cut}sweep 30,30 -5,-5\n{embedded}sweep 55,-5 60,60\n")
        };
        let project = format!("layer 8001.1P\nstart -5,-5 \"T2 O2 I1 S5 MX\"\n{elements}end 60,60\n");
        let files = [("8001.1P.dxf", &*project), ("1234.1P.dxf", &*frame)];
        found("PB222", &PartTest::default(), &files).len()
    };
    let cut = "mill 20,20 30,30 \"B0\"\n";
    assert_eq!(count(&opening("mill", 11.0), cut, true), 1);
    assert_eq!(count(&opening("mill", 11.0), cut, false), 0, "the opening is cut afterwards");
    assert_eq!(count(&opening("bars", 11.0), cut, true), 0, "bars hold the waste");
    assert_eq!(count(&opening("mill", 11.0), "sweep 20,20 30,30\n", true), 0, "no cut");
}

/// Two cuts in a row leave a bridge that holds if it is more than 0.1 mm wide.
#[test]
fn a_bridge_holds_the_waste_of_an_opening() {
    let count = |end: f64| {
        in_waste(&frame(&opening("mill", end)), &insert(), [FRAME, INSERT], &PartTest::default()).len()
    };
    assert_eq!(count(13.09), 1);
    assert_eq!(count(13.11), 0);
}

/// A component may embed a path in its own opening. Only the cuts that it makes before count.
#[test]
fn the_order_within_a_component_counts() {
    let count = |elements: &str| {
        let frame = frame(elements);
        let project =
            "layer 8001.1P\nstart -5,-5 \"T2 O2 S5 MX\"\nsubpath -5,-5 55,-5 \">1234.1P\"\nend 55,-5\n";
        let files = [("8001.1P.dxf", project), ("1234.1P.dxf", &*frame), ("1235.1P.dxf", &*insert())];
        let mut found = PartTest::default().diagnostics(&files);
        assert!(found.iter().all(|found| !found.is_error()), "{found:?}");
        found.retain(|found| found.code().to_string() == "PB222");
        found.len()
    };
    let cut = "mill 11,11 11,39\nmill to 39,39 39,11 11,11\n";
    let embedded = "subpath 17,17 33,17 \">1235.1P\"\n";
    let after = format!("sweep -5,-5 11,11\n{cut}sweep 11,11 17,17\n{embedded}sweep 33,17 -1,-1\n");
    let before = format!("sweep -5,-5 17,17\n{embedded}sweep 33,17 11,11\n{cut}sweep 11,11 -1,-1\n");
    assert_eq!((count(&after), count(&before)), (1, 0));
}

/// A groove in loose waste counts, a cut above the plate does not.
#[test]
fn cuts_of_any_depth_count_in_loose_waste() {
    let count = |height: &str| {
        let insert = insert().replace("B-0.2 D1 P2 U4", "B1").replace("bars", "mill");
        let path = format!(">1235.1P {height}");
        let lines = [FRAME, ["17,17", "33,17", &path]];
        in_waste(&frame(&opening("mill", 11.0)), &insert, lines, &PartTest::default()).len()
    };
    assert_eq!(count(""), 1);
    assert_eq!(count("H0.98"), 1);
    assert_eq!(count("H1"), 0);
}

/// Where the waste has been removed, there is nothing that could come loose. A path may clear its own opening.
#[test]
fn a_cleared_opening_has_no_waste() {
    let hole = "layer 1235.1P\nstart -2,-2 \"T2 O2 I1 B-0.2 S5 MX\"\nsweep -2,-2 8,8\nmill circle 8,8 d 2\n\
                sweep 8,8 14,-2\nend 14,-2\n";
    let frame = |diameter: f64| {
        frame(&format!("sweep -5,-5 25,25\nmill circle 25,25 d {diameter}\nsweep 25,25 -1,-1\n"))
            .replace("polyline 10,10 40,10 40,40 10,40 closed", &format!("circle 25,25 d {diameter}"))
    };
    // The line of the hole's path puts the hole into the middle of the opening.
    let count = |diameter: f64| {
        let lines = [FRAME, ["15,15", "31,15", ">1235.1P"]];
        in_waste(&frame(diameter), hole, lines, &PartTest::default()).len()
    };
    assert_eq!(count(3.9), 0);
    assert_eq!(count(4.1), 1);
    let zigzag = opening("mill", 11.0).replace("sweep 11,11 -1,-1", "mill 11,11 39,25\nsweep 39,25 -1,-1");
    let itself = in_waste(&self::frame(&zigzag), &insert(), [FRAME, BESIDE], &PartTest::default());
    assert_eq!(itself, []);
}

/// Returns a plate with a round opening, and in it an outline with a contour at this distance.
fn plate_in_opening(verb: &str, distance: f64) -> String {
    let (low, high) = (20.0 - distance, 30.0 + distance);
    format!(
        "layer 1234.1P\nstart -5,-5 \"T2 O2 I1 B0 A40 D1 P2 U4 S5\"\nsweep -5,-5 {high},{low}\n\
         {verb} {high},{low} {high},{high}\n{verb} to {low},{high} {low},{low} {high},{low}\n\
         sweep {high},{low} 25,25\nmill circle 25,25 d 36\nsweep 25,25 -1,-1\n\
         bars -1,-1 51,-1\nbars to 51,51 -1,51 -1,-1\nsweep -1,-1 55,-5\nend 55,-5\n\
         layer Part\npolyline 0,0 50,0 50,50 0,50 closed\ncircle 25,25 d 36\npolyline 20,20 30,20 30,30 20,30 closed\n"
    )
}

#[test]
fn an_outline_in_an_opening_is_no_part() {
    let is_found =
        |verb: &str, distance: f64| codes(&plate_in_opening(verb, distance)).contains(&"PB223".to_owned());
    assert!(is_found("bars", 1.0));
    assert!(is_found("bars", 0.5) && is_found("bars", 1.95), "wrong distances");
    assert!(!is_found("bars", 2.05), "O or more away");
    assert!(!is_found("bars", -1.0), "an opening in the opening");
    assert!(is_found("mill", 1.0), "cut out without bars");
    assert!(is_found("mill", 0.05) && is_found("mill", 1.95), "wrong distances");
    assert!(!is_found("mill", 0.0) && !is_found("mill", 2.05), "on the outline, and O or more away");
}

/// A ring that is cleared in turns is no part, even if one of the turns runs half of O beside a circle in it. A hole in a part does not matter.
#[test]
fn a_part_without_bars_is_left_whole() {
    let is_found = |cut: &str, outlines: &str| {
        let drawing = plate_in_opening("mill", 1.0)
            .replace("sweep 31,19 25,25\n", &format!("sweep 31,19 25,25\n{cut}"))
            + outlines;
        codes(&drawing).contains(&"PB223".to_owned())
    };
    assert!(is_found("", ""));
    assert!(!is_found("mill circle 25,25 d 6\n", ""), "cleared");
    assert!(is_found("mill circle 25,25 d 6\n", "circle 25,25 d 6\n"), "a hole in the part");
    assert!(is_found("mill circle 25,25 d 6 \"B1\"\n", ""), "a groove");
}

/// The opening of 20 mm is milled `short` mm too small on each side. A cut that is nearer to where the opening would be cut than to where the circle
/// in it would be is meant for the opening.
#[test]
fn a_cut_between_two_outlines_belongs_to_the_nearer_one() {
    let is_found = |inner: f64, short: f64| {
        let drawing = format!(
            "layer 1234.1P\nstart -5,-5 \"T2 O2 I0.5 A40 B-0.2 S5\"\nsweep -5,-5 20,13\nmill circle 20,13 d {}\nsweep 20,13 50,-5\nend 50,-5\nlayer Part\n\
             polyline 1,1 41,1 41,26 1,26 closed\ncircle 20,13 d 20\ncircle 20,13 d {inner}\n",
            20.0 - 2.0 * short
        );
        codes(&drawing).contains(&"PB223".to_owned())
    };
    // The cuts for the two outlines would run 1 mm apart.
    assert!(!is_found(14.0, 0.0) && !is_found(14.0, 0.48));
    assert!(is_found(14.0, 0.52) && is_found(14.0, 1.0));
}

/// A part in an opening may stay in the drawing if the layer names its path.
#[test]
fn an_outline_in_an_opening_with_a_layer_of_its_own_is_a_part() {
    let drawing = plate_in_opening("bars", 1.0);
    let drawing = drawing.replace("polyline 20,20", "layer Part_1234.2\npolyline 20,20");
    let test = PartTest { pattern: Some("Part_?(.*)"), ..PartTest::default() };
    assert_eq!(
        found("PB223", &test, &[("1234.dxf", &drawing.replace("layer Part\n", "layer Part_1234.1\n"))]),
        []
    );
}

/// Bars at the edge of a hole hold its waste, even if the circle of a thread lies beside them.
#[test]
fn circles_round_a_hole_and_in_it_are_no_parts() {
    for others in [&[7.0][..], &[8.0], &[12.0], &[7.0, 12.0]] {
        let circles = others.iter().map(|diameter| format!("circle 20,13 d {diameter}\n"));
        let circles = circles.collect::<Vec<_>>().concat();
        let drawing = format!(
            "layer 1234.1P\nstart -5,-5 \"T2 O2 I1 B0 D1 P2 U8 S5\"\nsweep -5,-5 20,13\nbars circle 20,13 d 10\n\
             sweep 20,13 50,-5\nend 50,-5\nlayer Part\npolyline 1,1 41,1 41,26 1,26 closed\ncircle 20,13 d 10\n{circles}"
        );
        assert!(!codes(&drawing).contains(&"PB223".to_owned()), "{others:?}: {:?}", codes(&drawing));
    }
}
