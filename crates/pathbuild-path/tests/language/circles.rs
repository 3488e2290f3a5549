//! Tests special circles, holes and helical circles, and elements outside the plane. (book: language/markers)

use pathbuild_diagnostic::Lang;
use pathbuild_path::SegmentKind;

use crate::support::{compile, path, raw, read, wrong};

/// Returns the meaning of a PHANTOM circle with this diameter.
fn special(diameter: &str) -> String {
    let raw = raw(&format!("layer 1234.1P\nmill 0,0 20,0\ncircle PHANTOM 50,50 d {diameter}"));
    let is = [
        (raw.start.is_some(), "start"),
        (raw.end.is_some(), "end"),
        (!raw.turns.is_empty(), "turn"),
        (!raw.probes.is_empty(), "probe"),
        (raw.diagnostics.iter().any(|found| found.code().to_string() == "PB105"), "PB105"),
    ];
    is.iter().filter(|(is, _)| *is).map(|(_, what)| *what).collect::<Vec<_>>().join(" ")
}

#[test]
fn special_circles_are_told_apart_by_their_diameters() {
    let known =
        [("1", "start"), ("1.5", "turn"), ("2", "end"), ("6", "probe"), ("3", "PB105"), ("0.5", "PB105")];
    for (diameter, what) in known {
        assert_eq!(special(diameter), what, "{diameter}");
    }
}

/// Markers of a drawing in another unit are still recognised, and nothing follows from its lengths.
#[test]
fn markers_in_another_unit_are_named() {
    let said = |factor: f64| {
        let [start, end, hole] = [1.0, 2.0, 2.0].map(|diameter| diameter / factor);
        let [x, y] = [40.0, 20.0].map(|length| length / factor);
        let compiled = compile(&format!(
            "layer 1234.1P\ncircle PHANTOM 0,0 d {start}\ntext 0,0 \"T2 O2 I0.5 B0 D1 P4 U10\" height {start} align centre middle\n\
             bars 0,0 {x},0 {x},{y}\ncircle {x},{y} d {hole}\ncircle PHANTOM {x},{y} d {end}"
        ));
        let texts = compiled.found.iter().map(|found| format!("{} {}", found.code(), found.text(Lang::En)));
        texts.collect::<Vec<_>>()
    };
    for (factor, unit) in [(25.4, "inches"), (10.0, "centimetres"), (1000.0, "metres")] {
        let found = said(factor);
        assert_eq!(found.len(), 2, "{found:?}");
        for (found, meant) in found.iter().zip(["1", "2"]) {
            let expected = format!("times {factor}, it would be {meant} mm: is the drawing in {unit}?");
            assert!(found.starts_with("PB105") && found.ends_with(&expected), "{found}");
        }
    }
    let is_named = |diameter: &str| {
        let raw = raw(&format!("layer 1234.1P\nmill 0,0 20,0\ncircle PHANTOM 50,50 d {diameter}"));
        raw.diagnostics.iter().any(|found| found.text(Lang::En).contains("is the drawing in"))
    };
    assert!(is_named("0.0397") && !is_named("0.0398"), "1 % above 1 mm");
    assert!(is_named("0.2362") && is_named("0.0591") && !is_named("0.5"));
}

/// As with holes, the tolerance is 0.001 mm: drawings in inches have rounded diameters.
#[test]
fn diameters_compare_approximately() {
    let edges = [
        ("1.00099", "start"),
        ("1.00101", "start PB105"),
        ("0.99901", "start"),
        ("0.99899", "start PB105"),
        ("1.50099", "turn"),
        ("1.50101", "PB105"),
        ("2.00099", "end"),
        ("2.00101", "end PB105"),
        ("6.00099", "probe"),
        ("6.00101", "PB105"),
    ];
    for (diameter, what) in edges {
        assert_eq!(special(diameter), what, "{diameter}");
    }
}

#[test]
fn a_path_has_one_start_and_one_end() {
    let good = "mill 0,0 20,0\nend 20,0";
    assert_eq!(wrong(&path("T5 O3 I1 B0", good)), [""; 0]);
    assert_eq!(wrong(&path("T5 O3 I1 B0", &format!("{good}\nstart 50,50"))), ["PB103"]);
    assert_eq!(wrong(&path("T5 O3 I1 B0", &format!("{good}\nend 50,50"))), ["PB104"]);
    assert_eq!(wrong(&path("T5 O3 I1 B0", "mill 0,0 20,0")), ["PB102"]);
    assert_eq!(wrong("layer 1234.1P\nmill 0,0 20,0 \"B0\"\nend 20,0"), ["PB101"]);
}

/// The message shows enough digits to explain the problem.
#[test]
fn a_diameter_that_means_nothing_is_shown_with_its_digits() {
    let said = |diameter: &str| {
        let raw = raw(&format!("layer 1234.1P\nmill 0,0 20,0\ncircle PHANTOM 50,50 d {diameter}"));
        raw.diagnostics.iter().map(|found| found.text(Lang::En)).next().unwrap()
    };
    assert_eq!(said("1.0011"), "a PHANTOM circle with a diameter of 1.0011 mm has no meaning");
    assert_eq!(said("1.25"), "a PHANTOM circle with a diameter of 1.25 mm has no meaning");
    assert_eq!(said("5"), "a PHANTOM circle with a diameter of 5 mm has no meaning");
}

/// A DASHDOT circle may have been meant to embed a closed path.
#[test]
fn an_arc_is_recommended_instead_of_a_dashdot_circle() {
    let is_recommended = |circle: &str| {
        let raw = raw(&format!("layer 1234.1P\nmill 0,0 20,0\ncircle {circle} 50,50 d 10"));
        let help = raw.diagnostics.iter().filter(|found| found.code().to_string() == "PB105");
        help.filter_map(|found| found.help(Lang::En))
            .any(|help| help.contains("an arc from 270 to 270 degrees"))
    };
    assert!(is_recommended("DASHDOT"));
    assert!(!is_recommended("PHANTOM") && !is_recommended("DOT"));
}

/// Two start markers on different layers of one path are two starts of that path.
#[test]
fn markers_are_counted_over_all_layers_of_a_path() {
    let tilde = path("T5 O3 I1 B0", "mill 0,0 20,0\nend 20,0\nlayer 1234.1P~A\nstart 50,50");
    assert_eq!(wrong(&tilde), ["PB103"]);
}

#[test]
fn other_paths_of_the_file_are_read_all_the_same() {
    let good = "layer 1234.2P\nstart 0,50 \"T5 O3 I1 B0\"\nmill 0,50 20,50\nend 20,50";
    let file = read(&format!("layer 1234.1P\nmill 0,0 20,0\nend 20,0\n{good}"));
    let sound: Vec<bool> = file.paths.iter().map(|(raw, _)| raw.is_sound()).collect();
    assert_eq!(sound, [false, true]);
}

#[test]
fn elements_lie_in_the_plane() {
    for statement in ["mill 0,0 20,0", "mill arc 0,0 20,0 r 15", "circle 20,0 d 3", "circle 20,0 d 8"] {
        let drawing = |z: &str| path("T5 O3 I1 B0", &format!("sweep 0,0 20,0\n{statement} z {z}\nend 20,0"));
        let off_plane = |z| wrong(&drawing(z)).contains(&"PB110".to_owned());
        assert!(!off_plane("0.000000001"), "{statement}");
        assert!(off_plane("0.00000001"), "{statement}");
    }
    assert_eq!(wrong(&path("T5 O3 I1 B0", "mill 0,0 20,0\nend 20,0 z 1")), ["PB110"]);
}

/// Returns the meaning of a circle with this diameter for O3.
fn drilled_or_milled(diameter: &str) -> String {
    let statements = format!("sweep 0,0 20,0\ncircle 20,0 d {diameter}\nend 20,0");
    let compiled = compile(&path("T5 O3 I1 B0", &statements));
    match (&compiled.path, compiled.found.first()) {
        (_, Some(found)) => found.code().to_string(),
        (Some(path), None) => match path.segments[0].kind {
            SegmentKind::Hole(_) => "hole".to_owned(),
            SegmentKind::Helix(_) => "helix".to_owned(),
            _ => "something else".to_owned(),
        },
        (None, None) => "nothing".to_owned(),
    }
}

#[test]
fn a_circle_of_the_cutters_diameter_is_a_hole_a_larger_one_helical_a_smaller_one_wrong() {
    let edges = [
        ("3", "hole"),
        ("3.001", "hole"),
        ("3.0010001", "helix"),
        ("2.999", "hole"),
        ("2.9989999", "PB109"),
        ("12", "helix"),
    ];
    for (diameter, what) in edges {
        assert_eq!(drilled_or_milled(diameter), what, "{diameter}");
    }
}

#[test]
fn a_helical_circle_is_no_larger_than_a() {
    let helix = |parameters: &str, diameter: &str| {
        wrong(&path(
            &format!("T5 O3 I1 B0 {parameters}"),
            &format!("sweep 0,0 20,0\ncircle 20,0 d {diameter}\nend 20,0"),
        ))
    };
    assert_eq!(helix("", "12"), [""; 0]);
    assert_eq!(helix("", "12.0001"), ["PB405"]);
    assert_eq!(helix("A20", "20"), [""; 0]);
    assert_eq!(helix("A20", "20.0001"), ["PB405"]);
    assert_eq!(helix("A7", "8"), ["PB405"]);
}

/// O decides which circles are drilled, so it must not be a variable.
#[test]
fn holes_are_of_the_paths_o() {
    assert_eq!(wrong(&path("T5 O=X I1 B0 :X1~3", "sweep 0,0 20,0\ncircle 20,0 d 3\nend 20,0")), ["PB206 O"]);
}

/// Returns three holes in a row and a milled line, each with its text.
fn row(texts: [&str; 4]) -> String {
    let [first, second, third, line] = texts.map(|text| format!("\"{text}\""));
    let statements = format!(
        "sweep 0,0 20,0\ncircle 20,0 d 3 {first}\nsweep 20,0 40,0\ncircle 40,0 d 3 {second}\nsweep 40,0 60,0\n\
         circle 60,0 d 3 {third}\nmill 60,0 90,0 {line}\nend 90,0"
    );
    path("T5 O3 I1 B0 F100", &statements)
}

#[test]
fn what_is_wrong_with_a_hole_is_said_of_each() {
    assert_eq!(wrong(&row(["B6", "B6", "B1", "B1"])), ["PB203 B", "PB203 B"]);
}

/// For a cutter of 3 mm, the axis moves on a circle of 7 mm inside the drawn one of 10 mm. Bars are counted along the circle of the axis.
#[test]
fn the_axis_of_the_cutter_moves_inside_the_drawn_circle() {
    let compiled = compile(&path("T5 O3 I1 B0 Mx", "sweep 0,0 20,0\ncircle 20,0 d 10\nend 20,0"));
    let helix = &compiled.path.unwrap().helices[0];
    assert_eq!((helix.radius, helix.axis_radius(3.0)), (5.0, 3.5));
    // The axis moves 22 mm, which is enough for two bars at a distance of 9.9 mm, but not of 10.1 mm. The drawn circle, 31.4 mm long, would be enough
    // for both.
    let bars = |distance: f64| {
        let text = format!("circle CENTER 20,0 d 10 \"D2 P1 U{distance}\"");
        let compiled = compile(&path("T5 O3 I1 B0 Mx", &format!("sweep 0,0 20,0\n{text}\nend 20,0")));
        let path = compiled.path.unwrap();
        let (_, bars) = path.helices[0].bars.unwrap();
        bars.count(std::f64::consts::TAU * path.helices[0].axis_radius(3.0))
    };
    assert_eq!([bars(9.9), bars(10.1)], [2.0, 1.0]);
}
