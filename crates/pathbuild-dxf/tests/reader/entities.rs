//! Tests correct and faulty LINE, ARC and CIRCLE entities. (book: reference/dxf)

use crate::support::{entities, faults, file, only, only_geometry, options, read_all};
use pathbuild_diagnostic::{Code, EntityKind, Handle, Lang, Point};
use pathbuild_dxf::{Arc, Circle, Geometry, Line, Options, Origin, Point3, read};

fn point(x: f64, y: f64, z: f64) -> Point3 {
    Point3 { x, y, z }
}

#[test]
fn a_line_has_its_ends() {
    let geometry = only_geometry(entities("0 LINE\n8 A\n10 1\n20 2\n30 3\n11 4.5\n21 -5\n31 6"));
    assert_eq!(geometry, Geometry::Line(Line { start: point(1.0, 2.0, 3.0), end: point(4.5, -5.0, 6.0) }));
}

#[test]
fn groups_come_in_any_order_and_z_may_be_missing() {
    let geometry = only_geometry(entities("0 LINE\n11 3\n10 1\n21 4\n20 2\n8 A"));
    assert_eq!(geometry, Geometry::Line(Line { start: point(1.0, 2.0, 0.0), end: point(3.0, 4.0, 0.0) }));
}

#[test]
fn an_arc_runs_counterclockwise_with_its_angles_as_in_the_file() {
    let geometry = only_geometry(entities("0 ARC\n8 A\n10 1\n20 2\n40 3\n50 350\n51 370"));
    let arc = Arc {
        centre: point(1.0, 2.0, 0.0),
        radius: 3.0,
        start_angle: 350.0,
        end_angle: 370.0,
        clockwise: false,
    };
    assert_eq!(geometry, Geometry::Arc(arc));
}

#[test]
fn a_circle_has_centre_and_radius() {
    let geometry = only_geometry(entities("0 CIRCLE\n8 A\n10 1\n20 2\n40 0.5"));
    assert_eq!(geometry, Geometry::Circle(Circle { centre: point(1.0, 2.0, 0.0), radius: 0.5 }));
}

#[test]
fn origins_hold_line_and_handle() {
    let drawing = read_all(entities(
        "0 LINE\n5 1aF\n8 A\n10 0\n20 0\n11 1\n21 1\n0 POINT\n8 A\n0 LINE\n8 A\n10 0\n20 0\n11 1\n21 1",
    ));
    let expected = [Origin { line: 5, handle: Some(Handle(0x1AF)) }, Origin { line: 23, handle: None }];
    assert_eq!(drawing.origins, expected);
}

#[test]
fn a_handle_that_is_not_hexadecimal_is_none() {
    for (handle, expected) in [
        ("09", Some(0x09)),
        ("aFAf", Some(0xAFAF)),
        ("fedcba9876543210", Some(0xFEDC_BA98_7654_3210)),
        ("0fedcba9876543210", None),
        ("/", None),
        (":", None),
        ("1G", None),
        ("@1", None),
        ("g1", None),
        ("`", None),
        ("1 2", None),
        ("é", None),
    ] {
        let drawing = read_all(entities(&format!("0 CIRCLE\n5 {handle}\n8 A\n10 0\n20 0\n40 1")));
        assert_eq!(drawing.origins, [Origin { line: 5, handle: expected.map(Handle) }], "{handle}");
    }
}

#[test]
fn names_of_entities_count_in_lower_case() {
    only(entities("0 line\n8 A\n10 0\n20 0\n11 1\n21 1"));
}

#[test]
fn a_missing_coordinate_is_a_fault_of_the_layer() {
    let drawing = read_all(entities("0 LINE\n5 1F\n8 A\n10 0\n20 0\n11 1"));
    assert_eq!(faults(&drawing), ["PB002 5 A: LINE: group 21 is missing"]);
    assert_eq!(drawing.faults[0].diagnostic.place.handle, Some(Handle(0x1F)));
    assert!(drawing.entities.is_empty());
}

#[test]
fn a_broken_entity_does_not_hide_the_next() {
    let drawing = read_all(entities("0 CIRCLE\n8 A\n10 x\n20 0\n40 1\n0 CIRCLE\n8 A\n10 0\n20 0\n40 1"));
    assert_eq!(faults(&drawing), ["PB002 10 A: CIRCLE: group 10 must be a number, not \"x\""]);
    assert_eq!(drawing.entities.len(), 1);
}

#[test]
fn numbers_of_unwanted_layers_are_not_looked_at() {
    let text = entities("0 CIRCLE\n8 A\n10 x\n20 0\n40 1\n0 CIRCLE\n8 B\n10 y\n20 0\n40 1");
    let options = Options { keep_layer: &|name| name == "B", ..options() };
    let drawing = read(text.as_bytes(), &options);
    assert_eq!(faults(&drawing), ["PB002 20 B: CIRCLE: group 10 must be a number, not \"y\""]);
    assert_eq!(drawing.layers.len(), 1);
}

#[test]
fn a_radius_must_be_more_than_0() {
    for (radius, fault) in [("0", true), ("-1", true), ("0.001", false)] {
        let drawing = read_all(entities(&format!("0 CIRCLE\n8 A\n10 0\n20 0\n40 {radius}")));
        assert_eq!(!drawing.faults.is_empty(), fault, "{radius}");
    }
}

#[test]
fn line_types_are_resolved() {
    let tables = "0 TABLE\n2 LAYER\n0 LAYER\n2 path\n70 0\n62 7\n6 Dashed\n0 ENDTAB";
    let line = |layer: &str, line_type: &str| {
        let text = file("", tables, "", &format!("0 LINE\n8 {layer}\n{line_type}\n10 0\n20 0\n11 1\n21 1"));
        only(text).line_type
    };
    assert_eq!(&*line("PATH", ""), "DASHED");
    assert_eq!(&*line("Path", "6  ByLayer "), "DASHED");
    assert_eq!(&*line("PATH", "6 ByBlock"), "CONTINUOUS");
    assert_eq!(&*line("PATH", "6 xref$0$center"), "CENTER");
    assert_eq!(&*line("PATH", "6 xref|Hidden"), "HIDDEN");
    assert_eq!(&*line("OTHER", ""), "CONTINUOUS");
}

#[test]
fn what_no_path_consists_of_is_left_out_with_its_name() {
    for (name, kind) in [
        ("REGION", EntityKind::Region),
        ("MLINE", EntityKind::MLine),
        ("HELIX", EntityKind::Helix),
        ("ray", EntityKind::Ray),
        ("XLINE", EntityKind::XLine),
        ("SOLID", EntityKind::Solid),
        ("TRACE", EntityKind::Trace),
        ("3DFACE", EntityKind::Face),
        ("3DSOLID", EntityKind::Solid3D),
        ("ARCALIGNEDTEXT", EntityKind::ArcText),
        ("RTEXT", EntityKind::RText),
        ("ATTRIB", EntityKind::Attrib),
        ("ACAD_PROXY_ENTITY", EntityKind::Proxy),
        ("NEW_IN_2040", EntityKind::Other),
    ] {
        let record = format!("0 {name}\n5 2F\n8 P\n10 7\n20 8\n");
        let drawing = read_all(entities(&record));
        let [left_out] = &drawing.left_out[..] else { panic!("{name}: {drawing:?}") };
        assert_eq!((left_out.kind, left_out.point), (kind, Some(Point::new(7.0, 8.0))), "{name}");
        assert_eq!(left_out.diagnostic.code(), Code::UnsupportedCurve);
        let begin = format!("{} is left out: a path consists of lines", kind.name());
        assert!(left_out.diagnostic.text(Lang::En).starts_with(&begin), "{name}");
        assert_eq!(left_out.diagnostic.place.handle, Some(Handle(0x2F)));

        let in_block = format!("0 BLOCK\n2 B\n10 1\n20 0\n{record}0 ENDBLK");
        let drawing = read_all(file("", "", &in_block, "0 INSERT\n8 0\n2 B\n10 0\n20 0"));
        assert_eq!(drawing.left_out[0].point, Some(Point::new(6.0, 8.0)), "{name} in a block");

        let elsewhere = Options { keep_layer: &|layer| layer != "P", ..options() };
        assert!(read(entities(&record).as_bytes(), &elsewhere).left_out.is_empty(), "{name} elsewhere");
        assert!(read_all(entities(&(record + "67 1"))).left_out.is_empty(), "{name} in paper space");
    }
}

/// In a block, an attribute definition is only a template: each insertion has an ATTRIB instead, unless the attribute is constant (2). An attribute
/// may be invisible (1).
#[test]
fn an_attribute_is_left_out_where_it_is_visible() {
    let record = |name: &str, flags: u8| format!("0 {name}\n8 P\n10 7\n20 8\n1 B2\n2 DEPTH\n70 {flags}\n");
    let drawn = |text: String| {
        let left_out = read_all(text).left_out;
        left_out.iter().map(|left_out| left_out.kind).collect::<Vec<_>>()
    };
    for (flags, is_drawn, is_drawn_in_block) in [
        (0, true, false),
        (1, false, false),
        (2, true, true),
        (3, false, false),
        (4, true, false),
        (6, true, true),
    ] {
        let expected = |kind, is_drawn| if is_drawn { vec![kind] } else { vec![] };
        let (attribute, definition) = (record("ATTRIB", flags), record("ATTDEF", flags));
        assert_eq!(drawn(entities(&attribute)), expected(EntityKind::Attrib, is_drawn), "{flags}");
        assert_eq!(drawn(entities(&definition)), expected(EntityKind::AttDef, is_drawn), "{flags}");
        let in_block = format!("0 BLOCK\n2 B\n10 1\n20 0\n{definition}0 ENDBLK");
        let drawn = drawn(file("", "", &in_block, "0 INSERT\n8 P\n2 B\n10 0\n20 0"));
        assert_eq!(drawn, expected(EntityKind::AttDef, is_drawn_in_block), "{flags}");
    }
}

/// Like the contents of a block, an attribute on layer 0 belongs to the layer of its insertion.
#[test]
fn an_attribute_on_layer_0_belongs_to_the_layer_of_its_insertion() {
    let blocks = "0 BLOCK\n2 B\n10 0\n20 0\n0 ENDBLK\n0 BLOCK\n2 C\n10 0\n20 0\n0 INSERT\n8 X\n2 B\n10 0\n20 0\n\
                  0 ATTRIB\n8 0\n10 7\n20 8\n0 ENDBLK";
    let left_out = |insertions: &str| {
        let text = file("", "", blocks, insertions);
        let drawing = read(text.as_bytes(), &Options { keep_layer: &|layer| layer == "P", ..options() });
        drawing.left_out.iter().filter(|left_out| left_out.kind == EntityKind::Attrib).count()
    };
    let insertion = |layer: &str| {
        format!("0 INSERT\n{layer}\n2 B\n66 1\n10 0\n20 0\n0 ATTRIB\n8 0\n10 7\n20 8\n0 SEQEND\n")
    };
    assert_eq!(left_out(&insertion("8 P")), 1);
    assert_eq!(left_out(&insertion("8 X")), 0);
    assert_eq!(left_out(&(insertion("8 X") + &insertion("8 P") + &insertion("62 1"))), 1);
    assert_eq!(left_out(&insertion("8 P").replace("ATTRIB\n8 0", "ATTRIB\n8 X")), 0);
    // In a block, the attribute belongs to the insertion there.
    assert_eq!(left_out("0 INSERT\n8 P\n2 C\n10 0\n20 0\n"), 0);
}

/// The first point of a hatch is its elevation, and its last points need not lie on its boundary.
#[test]
fn of_a_hatch_a_point_of_its_boundary_is_kept() {
    let boundary = "10 0\n20 0\n30 0\n91 1\n93 2\n10 3\n20 4\n10 5\n20 6\n98 1\n10 0\n20 0";
    let points = |groups: &str| {
        let drawing = read_all(entities(&format!("0 HATCH\n5 A\n8 P\n{groups}")));
        assert_eq!((drawing.entities.len(), drawing.layers.len(), drawing.left_out.len()), (0, 0, 0));
        drawing.hatches.iter().map(|place| place.point).collect::<Vec<_>>()
    };
    assert_eq!(points(boundary), [Some(Point::new(3.0, 4.0))]);
    assert_eq!(points(&format!("{boundary}\n210 0\n220 0\n230 -1")), [Some(Point::new(-3.0, 4.0))]);
    assert_eq!(points("10 0\n20 0\n91 1\n10 x\n20 4"), [None]);
    assert_eq!(read_all(entities(&format!("0 HATCH\n8 P\n67 1\n{boundary}"))).hatches, []);
}

#[test]
fn annotations_are_passed_over() {
    for name in ["DIMENSION", "ARC_DIMENSION", "LEADER", "MULTILEADER", "point", "VIEWPORT"] {
        let drawing = read_all(entities(&format!("0 {name}\n8 P\n10 x\n1 y")));
        assert_eq!(drawing, pathbuild_dxf::Drawing::default(), "{name}");
    }
}

#[test]
fn labels_have_a_text_and_a_tip() {
    let label = |pairs: &str| {
        let drawing = read_all(entities(pairs));
        assert_eq!((drawing.entities.len(), drawing.faults.len(), drawing.left_out.len()), (0, 0, 0));
        drawing.labels.first().map(|label| (label.text.to_string(), label.tip.centre.x, label.tip.radius))
    };
    let leader = "0 MULTILEADER\n8 P\n300 CONTEXT_DATA{\n10 1\n20 1\n41 3\n304 {\\fArial|b0;B2}\n302 LEADER{\n10 2\n20 1\n\
                  304 LEADER_LINE{\n10 7\n20 1\n10 8\n20 1\n305 }\n304 LEADER_LINE{\n10 9\n20 1\n305 }\n303 }\n301 }\n41 0.4";
    assert_eq!(label(leader), Some(("B2".into(), 7.0, 1.5)));
    assert_eq!(label(&format!("{leader}\n60 1")), None, "invisible");
    assert_eq!(
        label(&leader.replace("304 {\\fArial|b0;B2}", "290 0")),
        Some(("LEADER_LINE".into(), 7.0, 1.5)),
        "a block, which never means anything"
    );
    assert_eq!(label("0 DIMENSION\n8 P\n10 3\n20 3\n11 5\n21 3\n1 B2"), Some(("B2".into(), 5.0, 0.0)));
    for pairs in ["10 3\n20 3\n11 5\n21 3", "11 5\n21 3\n1 ", "11 x\n21 3\n1 B2", "67 1\n11 5\n21 3\n1 B2"] {
        assert_eq!(label(&format!("0 DIMENSION\n8 P\n{pairs}")), None, "{pairs}");
    }
}
