//! Tests reading clamps, and finding the moves that hit them. (book: language/keep-outs)

use pathbuild_diagnostic::{Code, Diagnostic, Lang};
use pathbuild_dxf::{Options, Units};
use pathbuild_path::{
    Arc, Curve, KeepOut, KeepOutMap, KeepOuts, Language, LayerPattern, Line, TipMove, Xy, keep_outs, raw_file,
};
use pathbuild_testkit::sheet;
use proptest::prelude::*;

use crate::support::language;

fn clamps_of(drawing: &str) -> KeepOuts {
    clamps_among(drawing, "")
}

/// Reads the clamps of a drawing with further entities, which are given as pairs of DXF.
fn clamps_among(drawing: &str, entities: &str) -> KeepOuts {
    let language = Language { keep_out: LayerPattern::new("clamps?|2000[.]1P").ok(), ..language() };
    let is_wanted = |layer: &str| language.is_keep_out(layer);
    let sheet = sheet(drawing).unwrap_or_else(|faults| panic!("{faults:?} in\n{drawing}"));
    let dxf = String::from_utf8(sheet.to_dxf()).expect("the sheet is text");
    let dxf = dxf.replace("\r\n", "\n").replace("\nENTITIES\n", &format!("\nENTITIES\n{entities}"));
    keep_outs(&pathbuild_dxf::read(dxf.as_bytes(), &options(&is_wanted)), &language)
}

fn options(keep_layer: &dyn Fn(&str) -> bool) -> Options<'_> {
    Options {
        keep_layer,
        note_text: None,
        units: Units::Header,
        approximate_curves: 0.0,
        max_entities: 10_000,
        max_text: 65_536,
        compatible: false,
    }
}

/// The clamps' own finding is PB117, an error.
#[test]
fn a_missing_block_among_the_clamps_is_no_finding_of_the_paths() {
    let language = Language { keep_out: LayerPattern::new("clamps").ok(), ..language() };
    let count = |layer: &str| {
        let insert = format!("0\nINSERT\n8\n{layer}\n2\nX\n10\n0\n20\n0\n");
        let dxf = format!("0\nSECTION\n2\nENTITIES\n{insert}0\nENDSEC\n0\nEOF\n");
        let drawing = pathbuild_dxf::read(dxf.as_bytes(), &options(&|_| false));
        raw_file(&drawing, &language).diagnostics.len()
    };
    assert_eq!((count("clamps"), count("notes")), (0, 1));
}

/// Returns the clamps of a drawing that has no findings.
#[track_caller]
fn right(drawing: &str) -> Vec<KeepOut> {
    let KeepOuts { all, problems } = clamps_of(drawing);
    assert!(problems.is_empty(), "{problems:?}");
    all
}

/// Returns the findings about the clamps of a drawing, in short form.
fn wrong(drawing: &str) -> Vec<(Code, String)> {
    let KeepOuts { problems, .. } = clamps_of(drawing);
    problems.iter().map(|problem| (problem.code(), problem.text(Lang::En))).collect()
}

#[track_caller]
fn assert_wrong(drawing: &str, parts: &[&str]) {
    let found = wrong(drawing);
    assert_eq!(found.len(), parts.len(), "{found:?}");
    for ((code, text), part) in found.iter().zip(parts) {
        assert!(*code == Code::InvalidKeepOut && text.contains(part), "{found:?}");
    }
}

fn line(from: [f64; 2], to: [f64; 2]) -> Curve {
    Curve::Line(Line { start: from.into(), end: to.into() })
}

fn flat(curve: Curve, z: f64) -> TipMove {
    TipMove { curve, from_z: z, to_z: z }
}

fn map(clamps: &[KeepOut]) -> KeepOutMap {
    KeepOutMap::new(clamps.iter().map(|clamp| (clamp.height, &*clamp.outline)))
}

/// Whether a tool of 2 mm hits a clamp.
fn enters(clamps: &[KeepOut], way: &TipMove) -> bool {
    !map(clamps).entered_clamps(way, 1.0, 0.0).is_empty()
}

const SQUARE: &str = "layer clamps\nline 10,0 20,0 20,10 10,10 10,0\ntext 12,4 \"Z25\"\n";

#[test]
fn closed_outlines_are_clamps() {
    let outlines = [
        "line 10,0 20,0 20,10 10,10 10,0",
        // The lines are drawn in any order and direction.
        "line 10,0 20,0\nline 10,10 20,10\nline 20,10 20,0\nline 10,10 10,0",
        "polyline 10,0 20,0 20,10 10,10 closed",
        // The outline is closed by its last vertex, or by a line.
        "polyline 10,0 20,0 20,10 10,10 10,0",
        "polyline 20,0 20,10 10,10 10,0\nline 10,0 20,0",
        "circle 15,5 d 10",
        // The outline is a half circle and its diameter.
        "line 10,0 20,0\narc 20,0 to 10,0 centre 15,0",
        "polyline 10,0 20,0 bulge 1 closed",
    ];
    for outline in outlines {
        for text in ["text 13,2 \"Z25\"", "mtext 13,4 \"Z25\""] {
            let found = right(&format!("layer clamps\n{outline}\n{text}\n"));
            assert!(matches!(&found[..], [KeepOut { height: 25.0, .. }]), "{outline}: {found:?}");
            assert!(enters(&found, &flat(line([15.0, 2.0], [15.0, 2.0]), 20.0)), "{outline}");
            assert!(!enters(&found, &flat(line([30.0, 2.0], [30.0, 2.0]), 20.0)), "{outline}");
        }
    }
}

/// The width of a polyline makes the clamp look larger than its outline.
#[test]
fn the_width_of_an_outline_is_reported() {
    let clamp = |width: &str| {
        let corners = "10\n0\n20\n0\n10\n9\n20\n0\n10\n9\n20\n9\n10\n0\n20\n9\n";
        let polyline = format!("0\nLWPOLYLINE\n8\nclamps\n43\n{width}\n90\n4\n70\n1\n{corners}");
        let found = clamps_among("layer clamps\ntext 4,4 \"Z25\"", &polyline);
        (found.all.len(), found.problems.iter().map(Diagnostic::code).collect::<Vec<_>>())
    };
    assert_eq!(clamp("0"), (1, vec![]));
    assert_eq!(clamp("3"), (1, vec![Code::UnsupportedCurve]));
}

#[test]
fn a_name_counts_as_a_whole_and_in_any_case() {
    assert_eq!(right(&SQUARE.replace("clamps", "CLAMP")).len(), 1);
    assert_eq!(right(&SQUARE.replace("clamps", "\"clamps old\"")).len(), 0);
}

#[test]
fn heights_are_numbers_greater_than_0() {
    for (text, height) in [("Z25", 25.0), ("Z1,5", 1.5), (" Z12.25 ", 12.25)] {
        assert_eq!(right(&SQUARE.replace("Z25", text))[0].height, height);
    }
    for text in ["25", "z25", "Z", "Z0", "Z-3", "Z25 B0", "Z25mm", "Z=h", "clamp"] {
        assert_wrong(&SQUARE.replace("Z25", text), &["does not give the height"]);
    }
    for (text, shown) in [("Z25\u{2009}", "\"Z25\u{2423}\""), ("\u{2009}Z25 ", "\"\u{2423}Z25\"")] {
        let text = SQUARE.replace("Z25", text);
        assert_wrong(&text, &[shown]);
        assert_wrong(&text, &["\u{2423} is a special space"]);
    }
}

#[test]
fn each_outline_has_one_text_inside_or_overlapping_it() {
    assert_wrong("layer clamps\ncircle 0,0 d 10\n", &["no text gives the height"]);
    assert_wrong(&format!("{SQUARE}text 12,7 \"Z30\"\n"), &["several texts"]);
    // Three texts are listed, and the others are counted.
    let texts = |count: usize| format!("{SQUARE}{}", "text 12,7 \"Z30\"\n".repeat(count - 1));
    assert_wrong(
        &texts(3),
        &["several texts are inside the outline of this clamp or overlap it: Z25, Z30, Z30"],
    );
    assert_wrong(
        &texts(4),
        &["4 texts are inside the outline of this clamp or overlap it; the first are Z25, Z30, Z30"],
    );
    // The circle of the text, with a radius of 2.57 mm, just touches the outline from outside, or just does not.
    let beside = |x: f64| SQUARE.replace("12,4", &format!("{x},4"));
    assert_eq!(right(&beside(10.0 - 2.25 - 2.57)).len(), 1);
    assert_wrong(
        &beside(10.0 - 2.25 - 2.58),
        &["neither inside an outline nor overlapping one", "no text gives the height"],
    );
    // A text that is near two outlines applies to both.
    let neighbour = "line 20.5,0 30,0 30,10 20.5,10 20.5,0\n";
    let shared =
        right(&format!("layer clamps\nline 10,0 20,0 20,10 10,10 10,0\n{neighbour}text 18,4 \"Z25\"\n"));
    assert_eq!(shared.len(), 2);
}

#[test]
fn an_outline_that_does_not_close_is_an_error() {
    let gap = |to: &str| format!("layer clamps\nline 10,0 20,0 20,10 10,10 {to}\ntext 12,4 \"Z25\"\n");
    assert_eq!(right(&gap("10,0.00003")).len(), 1);
    // The text is inside the bounding box of the outline.
    assert_wrong(&gap("10,0.00004"), &["is not closed"]);
    assert_wrong(&gap("10,1"), &["ends at (10, 1) and at (10, 0), 1 mm apart"]);
    let text = "neither inside an outline nor overlapping one";
    assert_wrong(&gap("10,1").replace("12,4", "40,4"), &["is not closed", text]);
    assert_wrong("layer clamps\narc 5,0 to 0,5 centre 0,0\n", &["is not closed"]);
    assert_wrong(
        &format!("{SQUARE}line 20,0 20,10\n"),
        &["meet at (20, 0)", "meet at (20, 10)", "neither inside an outline nor overlapping one"],
    );
    assert_wrong("layer clamps\nline 0,0 5,0 5,5 0,0\nline 5,5 9,9\n", &["more than two"]);
    // Closed polylines may touch each other.
    let squares = "polyline 0,0 9,0 9,9 0,9 closed\ntext 2,4 \"Z5\"\npolyline 9,0 18,0 18,9 9,9 closed\ntext 11,4 \"Z7\"";
    assert_eq!(right(&format!("layer clamps\n{squares}\n")).len(), 2);
}

#[test]
fn a_curve_that_is_not_understood_is_an_error() {
    let drawing = format!("{SQUARE}spline control 0,0 10,10 20,5 30,0\n");
    assert_wrong(&drawing, &["this SPLINE on a layer with clamps is not read"]);
}

/// The four sides of a polyline give one finding.
#[test]
fn a_clamp_lies_in_the_plane() {
    for (outline, count) in [("circle 0,0 d 20 z 5", 1), ("polyline -5,-5 5,-5 5,5 -5,5 closed z 5", 4)] {
        let found = wrong(&format!("layer clamps\n{outline}\ntext -3,-1 \"Z25\"\n"));
        let [(Code::OffPlane, text)] = &found[..] else { panic!("{found:?}") };
        assert!(text.ends_with(&format!("elements outside of the plane: {count}")), "{text}");
    }
}

#[test]
fn a_layer_is_a_path_or_holds_clamps() {
    let [(code, text)] = &wrong(&SQUARE.replace("clamps", "2000.1P"))[..] else { panic!() };
    assert!(*code == Code::InvalidConfiguration && text.contains("2000.1P"), "{text}");
}

#[test]
fn a_hidden_layer_counts() {
    let KeepOuts { all, problems } = clamps_of(&SQUARE.replace("clamps\n", "clamps frozen\n"));
    assert_eq!(all.len(), 1);
    assert!(matches!(&problems[..], [problem] if problem.code() == Code::LayerNotVisible));
}

#[test]
fn a_hidden_clamp_counts() {
    let found = |drawing: &str| {
        let KeepOuts { all, problems } = clamps_of(drawing);
        let codes: Vec<String> = problems.iter().map(|problem| problem.code().to_string()).collect();
        (all.len(), codes)
    };
    let block = format!("block A\n{SQUARE}endblock\n");
    assert_eq!(found(&format!("{block}layer Notes\ninsert A at 0,0\n")), (1, vec![]));
    assert_eq!(found(&format!("{block}layer Notes frozen\ninsert A at 0,0\n")).0, 1);
    let codes = found(&format!("{block}layer Notes frozen\ninsert A at 0,0\n")).1;
    assert!(!codes.is_empty() && codes.iter().all(|code| code == "PB112"), "{codes:?}");
    let invisible =
        "raw\n0 CIRCLE\n8 clamps\n60 1\n10 0\n20 0\n40 10\nendraw\nlayer clamps\ntext -3,-1 \"Z25\"\n";
    assert_eq!(found(invisible), (1, vec!["PB112".to_owned()]));
    assert_eq!(found(&invisible.replace("60 1", "60 0")), (1, vec![]));
}

/// At each height below the clamp's, the tool must clear the outline by half of O.
#[test]
fn the_tool_keeps_out_by_its_radius() {
    let clamps = right(SQUARE);
    let arc = |x: f64| {
        let (start, end) = (Xy::new(x - 5.0, 0.0), Xy::new(x - 5.0, 10.0));
        let centre = Xy::new(x - 5.0, 5.0);
        Curve::Arc(Arc { centre, radius: 5.0, start, end, clockwise: false, degrees: 180.0 })
    };
    let beside = |x: f64| line([x, -50.0], [x, 50.0]);
    for curve in [arc, beside, |x| line([x, 5.0], [x, 5.0]), |x| line([0.0, 5.0], [x, 5.0])] {
        assert!(enters(&clamps, &flat(curve(9.001), 24.0)));
        assert!(!enters(&clamps, &flat(curve(9.0), 24.0)));
        assert!(!enters(&clamps, &flat(curve(8.999), 24.0)));
    }
    // The tool moves past a corner, and through the middle without coming near the ends of the outline.
    assert!(!enters(&clamps, &flat(line([9.2, -0.61], [9.2, -9.0]), 24.0)));
    assert!(enters(&clamps, &flat(line([9.2, -0.59], [9.2, -9.0]), 24.0)));
    assert!(enters(&clamps, &flat(line([14.0, 5.0], [16.0, 5.0]), 24.0)));
}

#[test]
fn the_tool_may_go_over_a_clamp() {
    let clamps = right(SQUARE);
    let over = line([0.0, 5.0], [30.0, 5.0]);
    assert!(!enters(&clamps, &flat(over, 25.0)));
    assert!(enters(&clamps, &flat(over, 24.999)));
    // The tool moves down beside the clamp, and down into it.
    let down = |x: f64| TipMove { curve: line([x, 5.0], [x, 5.0]), from_z: 30.0, to_z: 0.0 };
    assert!(!enters(&clamps, &down(5.0)));
    assert!(enters(&clamps, &down(15.0)));
}

/// A ramp or helix hits a clamp only where it is lower than the clamp.
#[test]
fn a_slope_counts_below_the_height() {
    let clamps = right(SQUARE);
    let ramp = |to_z| TipMove { curve: line([15.0, 5.0], [35.0, 5.0]), from_z: 35.0, to_z };
    // The tool leaves the clamp at x = 21 mm, 6 mm past the start of the ramp. There, its tip is at 35 - 6 / 20 * 32 = 25.4 mm, or at 24.5 mm.
    assert!(!enters(&clamps, &ramp(3.0)));
    assert!(enters(&clamps, &ramp(0.0)));
    let helix = |from_z: f64, to_z: f64| {
        let (centre, start) = (Xy::new(20.0, 5.0), Xy::new(30.0, 5.0));
        let arc =
            Arc { centre, radius: 10.0, start, end: Xy::new(10.0, 5.0), clockwise: false, degrees: 180.0 };
        TipMove { curve: Curve::Arc(arc), from_z, to_z }
    };
    // The helix reaches the clamp after about 150 degrees.
    assert!(!enters(&clamps, &helix(20.0, 26.5)));
    assert!(enters(&clamps, &helix(26.0, 20.0)));
}

#[test]
fn clamps_are_found_among_many() {
    let clamp = |number: usize| {
        let x = 30.0 * number as f64;
        let at = Xy::new(x, 0.0);
        let outline = vec![Curve::Arc(Arc::from_angles(at, 10.0, 0.0, 360.0, false))];
        KeepOut { layer: "clamps".into(), at, height: 10.0, outline }
    };
    let clamps: Vec<KeepOut> = (0..1000).map(clamp).collect();
    let map = map(&clamps);
    let entered = |curve| map.entered_clamps(&flat(curve, 5.0), 1.0, 0.0);
    assert_eq!(entered(line([100.0, 5.0], [200.0, 5.0])), [4, 5, 6]);
    assert_eq!(entered(line([105.0, -5.0], [105.0, 5.0])), [] as [usize; 0]);
    // Rounding errors are tolerated.
    let touching = flat(line([0.0, 10.9995], [5.0, 10.9995]), 5.0);
    assert_eq!(
        (map.entered_clamps(&touching, 1.0, 0.0).len(), map.entered_clamps(&touching, 1.0, 0.001).len()),
        (1, 0)
    );
    let grazing = |z| map.entered_clamps(&flat(line([0.0, 5.0], [5.0, 5.0]), z), 1.0, 0.001).len();
    assert_eq!([grazing(9.9995), grazing(9.9985)], [0, 1]);
}

fn curve() -> impl Strategy<Value = Curve> {
    let number = || (-20_i32..20).prop_map(|half| f64::from(half) / 2.0);
    let straight = (number(), number(), number(), number()).prop_map(|(a, b, c, d)| line([a, b], [c, d]));
    let angle = || (0..24).prop_map(|step| f64::from(step) * 15.0);
    let round =
        (number(), number(), 1..20, angle(), angle(), any::<bool>()).prop_map(|(x, y, r, from, to, cw)| {
            Curve::Arc(Arc::from_angles(Xy::new(x, y), f64::from(r) / 2.0, from, to, cw))
        });
    prop_oneof![straight, round]
}

/// Returns closely spaced points along a curve.
fn points(curve: &Curve) -> Vec<Xy> {
    let length = curve.length();
    let point = |step: i32| match length {
        0.0 => curve.start(),
        _ => curve.section(0.0, length * f64::from(step) / f64::from(STEPS)).end(),
    };
    (0..=STEPS).map(point).collect()
}

const STEPS: i32 = 240;

proptest! {
    /// The distance between two curves equals that between their nearest sampled points, up to the precision of sampling.
    #[test]
    fn distances_are_exact(one in curve(), other in curve()) {
        let (ones, others) = (points(&one), points(&other));
        let apart = |a: &Xy| others.iter().map(|b| (b - a).norm()).fold(f64::INFINITY, f64::min);
        let sampled = ones.iter().map(apart).fold(f64::INFINITY, f64::min);
        let (exact, step) = (one.distance(&other), (one.length() + other.length()) / f64::from(STEPS));
        prop_assert!(exact <= sampled + 1e-9 && sampled <= exact + step, "{} {}", exact, sampled);
        prop_assert!((exact - other.distance(&one)).abs() < 1e-9);
    }

    /// The inside of a rotated ring of lines and arcs equals that of a polygon with many vertices.
    #[test]
    fn insides_are_those_of_polygons(
        corners in prop::collection::vec((5_u32..20, any::<bool>()), 3..9),
        at in (-25.0..25.0, -25.0..25.0),
        turn in 0.0..360.0,
    ) {
        let count = corners.len();
        let corner = |number: usize| {
            let angle = f64::to_radians(turn + 360.0 * (number % count) as f64 / count as f64);
            let (sin, cos) = libm::sincos(angle);
            let out = f64::from(corners[number % count].0);
            Xy::new(out * cos, out * sin)
        };
        let side = |number: usize| {
            let (start, end) = (corner(number), corner(number + 1));
            if !corners[number].1 {
                return Curve::Line(Line { start, end });
            }
            // The arc is a half circle that bulges outwards.
            let centre = middle(start, end);
            Curve::Arc(Arc { centre, radius: (end - start).norm() / 2.0, start, end, clockwise: false, degrees: 180.0 })
        };
        let outline: Vec<Curve> = (0..count).map(side).collect();
        let point = Xy::new(at.0, at.1);
        let here = line([at.0, at.1], [at.0, at.1]);
        let apart = outline.iter().map(|side| side.distance(&here)).fold(f64::INFINITY, f64::min);
        prop_assume!(apart > 0.1);
        let polygon: Vec<Xy> = outline.iter().flat_map(|side| points(side).into_iter().skip(1)).collect();
        let map = KeepOutMap::new([(10.0, &*outline)]);
        prop_assert_eq!(!map.entered_clamps(&flat(here, 0.0), 0.05, 0.0).is_empty(), winds(&polygon, point));
    }
}

fn middle(start: Xy, end: Xy) -> Xy {
    start + (end - start) / 2.0
}

/// Whether a polygon winds around a point, by the sum of the angles of its sides as seen from the point.
fn winds(polygon: &[Xy], point: Xy) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let angle = |(a, b): (&Xy, &Xy)| {
        let (a, b) = (a - point, b - point);
        libm::atan2(a.perp(&b), a.dot(&b))
    };
    libm::fabs(sides.map(angle).sum::<f64>()) > 1.0
}

/// Returns a hatch with a rectangular boundary, of which two points are read, and a seed point.
fn hatch(layer: &str, x: f64, y: f64) -> String {
    format!(
        "0\nHATCH\n8\n{layer}\n10\n0\n20\n0\n30\n0\n91\n1\n93\n2\n10\n{x}\n20\n{y}\n10\n0\n20\n0\n98\n1\n10\n0\n20\n0\n"
    )
}

#[test]
fn a_hatch_alone_is_an_unclear_clamp() {
    let said = "this HATCH on a layer with clamps is not read, so the position of the clamp is unknown";
    for (drawing, x, is_lone) in [
        (SQUARE, 15.0, false),
        (SQUARE, 20.0, false),
        (SQUARE, 20.01, true),
        ("layer other\nline 10,0 20,0\n", 15.0, true),
    ] {
        let KeepOuts { problems, .. } = clamps_among(drawing, &hatch("clamps", x, 5.0));
        let texts: Vec<_> = problems.iter().map(|problem| problem.text(Lang::En)).collect();
        assert_eq!(texts, if is_lone { vec![said] } else { vec![] }, "{drawing} {x}");
    }
    // The hatch is on a layer without clamps, or beside an outline with an error, to which it may belong.
    assert_eq!(clamps_among(SQUARE, &hatch("other", 50.0, 5.0)).problems, []);
    let open = "layer clamps\nline 10,0 20,0 20,10\n";
    let beside = clamps_among(open, &hatch("clamps", 50.0, 5.0)).problems;
    assert!(beside.len() == 1 && beside[0].text(Lang::En).contains("not closed"), "{beside:?}");
}

#[test]
fn a_block_of_other_layers_is_an_unclear_clamp() {
    let inserted = |layer: &str| {
        format!("block screw\nlayer {layer}\ncircle 0,0 d 10\nendblock\nlayer clamps\ninsert screw at 15,5\n")
    };
    assert_wrong(
        &inserted("parts"),
        &["block screw is inserted on a layer with clamps, but its contents lie on other layers (parts)"],
    );
    assert!(clamps_of(&inserted("parts")).problems[0].is_error());
    // Elements on the layer of a path belong to the path.
    assert_eq!(wrong(&inserted("1000.1P")), []);
    assert_eq!(right(&format!("{}text 15,5 \"Z25\"\n", inserted("0"))).len(), 1);
}

#[test]
fn a_clamp_lower_than_one_millimetre_is_doubted() {
    let low = wrong(&SQUARE.replace("Z25", "Z0.25"));
    assert_eq!(low, [(Code::DoubtfulValue, "this clamp is only 0.25 mm high".to_owned())]);
    assert_eq!(clamps_of(&SQUARE.replace("Z25", "Z0.25")).all.len(), 1);
    assert_eq!(wrong(&SQUARE.replace("Z25", "Z1")), []);
}
