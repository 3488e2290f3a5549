//! Tests $INSUNITS. (book: reference/dxf; book: reference/configuration, `units`)

use pathbuild_dxf::{Drawing, Geometry, Options, Units, read};

use crate::support::{file, file_faults, options, read_all};

const ENTITIES: &str = "0 CIRCLE\n8 A\n10 1\n20 2\n30 3\n40 4\n0 TEXT\n8 A\n10 1\n20 2\n40 5\n1 T3\n50 30\n0 LWPOLYLINE\n8 A\n10 0\n20 0\n42 1\n10 2\n20 0\n";

fn drawing(header: &str, units: Units) -> Drawing {
    read(file(header, "", "", ENTITIES).as_bytes(), &Options { units, ..options() })
}

#[test]
fn millimetres_none_and_nothing_are_fine() {
    for header in ["", "9 $INSUNITS\n70 4", "9 $INSUNITS\n70      0"] {
        let drawing = drawing(header, Units::Header);
        assert_eq!((drawing.diagnostics.len(), drawing.entities.len()), (0, 3), "{header}");
        assert_eq!(drawing, self::drawing(header, Units::Drawing));
    }
}

#[test]
fn other_units_are_an_error_of_the_file() {
    for (number, name) in [
        (1, "inches"),
        (5, "centimetres"),
        (6, "metres"),
        (13, "micrometres"),
        (99, "unknown"),
        (-1, "unknown"),
    ] {
        let drawing = drawing(&format!("9 $INSUNITS\n70 {number}"), Units::Header);
        let said = format!("PB113 8 the drawing's units are {name}, not millimetres ($INSUNITS is {number})");
        assert_eq!(file_faults(&drawing), [said]);
        assert!(drawing.entities.is_empty());
    }
}

#[test]
fn the_header_need_not_be_believed() {
    for number in ["1", "6", "99", "x"] {
        let drawing = drawing(&format!("9 $INSUNITS\n70 {number}"), Units::Millimetres);
        assert_eq!(drawing, self::drawing("9 $INSUNITS\n70 4", Units::Header));
    }
}

#[test]
fn all_lengths_are_converted() {
    for (number, factor) in [
        (1, 25.4),
        (2, 304.8),
        (5, 10.0),
        (6, 1000.0),
        (8, 25.4e-6),
        (9, 0.0254),
        (10, 914.4),
        (12, 1e-6),
        (13, 0.001),
        (14, 100.0),
        (21, 1_200_000.0 / 3937.0),
    ] {
        let drawing = drawing(&format!("9 $INSUNITS\n70 {number}"), Units::Drawing);
        assert_eq!(drawing.diagnostics, []);
        let [Geometry::Circle(circle), Geometry::Text(text), Geometry::Arc(arc)] =
            [0, 1, 2].map(|index: usize| drawing.entities[index].geometry.clone())
        else {
            panic!("{drawing:?}")
        };
        assert_eq!(
            [circle.centre.x, circle.centre.y, circle.centre.z, circle.radius],
            [1.0, 2.0, 3.0, 4.0].map(|it| it * factor)
        );
        assert_eq!(
            [text.anchor.x, text.anchor.y, text.height, text.rotation],
            [factor, 2.0 * factor, 5.0 * factor, 30.0]
        );
        assert_eq!([arc.centre.x, arc.radius], [factor, factor]);
    }
}

/// Drawings in miles and kilometres are too far from the origin.
#[test]
fn coordinates_count_in_millimetres() {
    for number in [3, 7] {
        let drawing = drawing(&format!("9 $INSUNITS\n70 {number}"), Units::Drawing);
        assert!(
            drawing.faults.iter().any(|fault| fault.diagnostic.code().to_string() == "PB002"),
            "{number}"
        );
    }
}

#[test]
fn units_without_a_factor_are_an_error_even_then() {
    let drawing = drawing("9 $INSUNITS\n70 99", Units::Drawing);
    assert_eq!(
        file_faults(&drawing),
        ["PB113 8 the drawing's units are unknown, not millimetres ($INSUNITS is 99)"]
    );
}

#[test]
fn a_broken_number_of_units_is_an_error() {
    let drawing = drawing("9 $INSUNITS\n70 x", Units::Header);
    assert_eq!(file_faults(&drawing), ["PB002 8 $INSUNITS: group 70 must be a number, not \"x\""]);
}

#[test]
fn a_text_with_the_name_of_the_variable_is_none() {
    let header = "9 $PROJECTNAME\n1 $INSUNITS\n70 1\n9 $INSUNITSX\n70 1\n9 X$INSUNITS\n70 1";
    assert_eq!(read_all(file(header, "", "", ENTITIES)).diagnostics, []);
}
