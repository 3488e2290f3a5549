//! Tests INSERT: insertions are replaced by the contents of their blocks. (book: language/layers-and-names; book: reference/dxf)

use pathbuild_diagnostic::{Code, EntityKind, Handle, Lang, Point};
use pathbuild_dxf::{Drawing, Geometry, HorizontalAlign, OmittedCurve, Options, Origin, Point3, read};

use crate::support::{faults, file, file_faults, options, read_all, section};

const LAYERS: &str = "0 TABLE\n2 LAYER\n0 LAYER\n2 P\n6 DASHED\n0 LAYER\n2 Q\n6 DOT\n0 ENDTAB";

/// A LINE from (1, 0) to (3, 0) with handle AA.
const LINE: &str = "0 LINE\n5 AA\n8 P\n10 1\n20 0\n11 3\n21 0";

fn block(name: &str, base: &str, content: &str) -> String {
    format!("0 BLOCK\n8 0\n2 {name}\n70 0\n{base}\n3 {name}\n{content}\n0 ENDBLK\n8 0\n")
}

fn drawing(blocks: &str, entities: &str) -> Drawing {
    read_all(file("", LAYERS, blocks, entities))
}

/// Returns the ends of all lines.
fn lines(drawing: &Drawing) -> Vec<[f64; 4]> {
    assert_eq!((faults(drawing), &drawing.left_out), (vec![], &vec![]));
    let ends = |it: &Geometry| match it {
        Geometry::Line(line) => {
            [line.start.x, line.start.y, line.end.x, line.end.y].map(|it| (it * 1e9).round() / 1e9 + 0.0)
        }
        other => panic!("{other:?}"),
    };
    drawing.entities.iter().map(|entity| ends(&entity.geometry)).collect()
}

/// Returns the ends of the line that an insertion with these groups produces.
fn inserted(groups: &str) -> Vec<[f64; 4]> {
    lines(&drawing(
        &block("B", "10 1\n20 0\n30 0", LINE),
        &format!("0 INSERT\n8 X\n2 B\n10 10\n20 20\n{groups}"),
    ))
}

#[test]
fn a_block_is_moved_from_its_base_point_to_its_insertion() {
    assert_eq!(inserted(""), [[10.0, 20.0, 12.0, 20.0]]);
}

#[test]
fn it_is_scaled_turned_and_mirrored() {
    assert_eq!(inserted("41 2\n42 2\n43 2"), [[10.0, 20.0, 14.0, 20.0]]);
    assert_eq!(inserted("50 90"), [[10.0, 20.0, 10.0, 22.0]]);
    assert_eq!(inserted("50 30"), [[10.0, 20.0, 11.732_050_808, 21.0]]);
    assert_eq!(inserted("41 -1"), [[10.0, 20.0, 8.0, 20.0]]);
    assert_eq!(inserted("41 -1\n50 90"), [[10.0, 20.0, 10.0, 18.0]]);
    assert_eq!(inserted("42 -1\n50 90"), [[10.0, 20.0, 10.0, 22.0]]);
    assert_eq!(inserted("41 -2\n42 -2"), [[10.0, 20.0, 6.0, 20.0]]);
    assert_eq!(inserted("210 0\n220 0\n230 -1"), [[-10.0, 20.0, -12.0, 20.0]]);
    assert_eq!(inserted("50 90\n210 0\n220 0\n230 -1"), [[-10.0, 20.0, -10.0, 22.0]]);
}

#[test]
fn rows_and_columns_are_turned_but_not_scaled() {
    let array = inserted("70 2\n71 2\n44 100\n45 1000");
    let expected = [[10.0, 20.0], [110.0, 20.0], [10.0, 1020.0], [110.0, 1020.0]];
    assert_eq!(array, expected.map(|[x, y]| [x, y, x + 2.0, y]));
    assert_eq!(
        inserted("70 2\n44 100\n50 90\n41 2\n42 2"),
        [[10.0, 20.0, 10.0, 24.0], [10.0, 120.0, 10.0, 124.0]]
    );
    assert_eq!(inserted("70 0\n71 0").len(), 1);
}

#[test]
fn arcs_of_a_mirrored_block_run_the_other_way() {
    let arc = "0 ARC\n8 P\n10 1\n20 2\n40 3\n50 10\n51 100";
    let arcs = |groups: &str| match drawing(
        &block("B", "", arc),
        &format!("0 INSERT\n8 X\n2 B\n10 0\n20 0\n{groups}"),
    )
    .entities[0]
        .geometry
    {
        Geometry::Arc(arc) => {
            let angles = [arc.start_angle, arc.end_angle].map(|angle| angle.rem_euclid(360.0));
            (arc.centre, arc.radius, angles, arc.clockwise)
        }
        _ => panic!(),
    };
    let point = |x: f64, y: f64| Point3 { x, y, z: 0.0 };
    assert_eq!(arcs(""), (point(1.0, 2.0), 3.0, [10.0, 100.0], false));
    assert_eq!(arcs("41 2\n42 2\n50 90"), (point(-4.0, 2.0), 6.0, [100.0, 190.0], false));
    assert_eq!(arcs("41 -1"), (point(-1.0, 2.0), 3.0, [170.0, 80.0], true));
    assert_eq!(arcs("42 -1"), (point(1.0, -2.0), 3.0, [350.0, 260.0], true));
    assert_eq!(arcs("41 -1\n230 -1"), (point(1.0, 2.0), 3.0, [10.0, 100.0], false));
}

#[test]
fn texts_are_scaled_turned_and_mirrored_with_their_block() {
    let texts =
        "0 TEXT\n8 P\n10 1\n20 2\n40 3\n1 T3\n50 10\n0 MTEXT\n8 P\n10 1\n20 2\n40 3\n1 T3\n50 10\n71 1";
    let insert = |groups: &str| {
        let drawing = drawing(&block("B", "", texts), &format!("0 INSERT\n8 X\n2 B\n10 0\n20 0\n{groups}"));
        let [Geometry::Text(text), Geometry::MText(mtext)] =
            [0, 1].map(|index: usize| drawing.entities[index].geometry.clone())
        else {
            panic!("{drawing:?}")
        };
        assert_eq!((text.anchor, text.height), (mtext.anchor, mtext.height));
        assert_eq!(mtext.paragraphs, mtext.horizontal);
        assert_eq!(text.rotation.rem_euclid(360.0), mtext.rotation.rem_euclid(360.0));
        (text.anchor.x, text.height, text.rotation.rem_euclid(360.0), text.backwards, mtext.horizontal)
    };
    assert_eq!(insert("41 2\n42 2\n50 90"), (-4.0, 6.0, 100.0, false, HorizontalAlign::Left));
    assert_eq!(insert("41 -1"), (-1.0, 3.0, 350.0, true, HorizontalAlign::Right));
    assert_eq!(insert("42 -1"), (1.0, 3.0, 170.0, true, HorizontalAlign::Right));
}

#[test]
fn layer_0_takes_the_layer_of_the_insertion_and_byblock_its_line_type() {
    let content =
        |layer: &str, line_type: &str| format!("0 LINE\n8 {layer}\n{line_type}\n10 1\n20 0\n11 3\n21 0");
    let seen = |content: &str, insert: &str| {
        let drawing = drawing(&block("B", "", content), &format!("0 INSERT\n2 B\n10 0\n20 0\n{insert}"));
        let entity = &drawing.entities[0];
        (drawing.layers[entity.layer as usize].name.to_string(), entity.line_type.to_string())
    };
    let pair = |layer: &str, line_type: &str| (layer.to_owned(), line_type.to_owned());
    assert_eq!(seen(&content("Q", ""), "8 P"), pair("Q", "DOT"));
    assert_eq!(seen(&content("0", ""), "8 P"), pair("P", "DASHED"));
    assert_eq!(seen(&content("0", "6 CENTER"), "8 P"), pair("P", "CENTER"));
    assert_eq!(seen(&content("Q", "6 BYBLOCK"), "8 P"), pair("Q", "DASHED"));
    assert_eq!(seen(&content("Q", "6 BYBLOCK"), "8 P\n6 HIDDEN"), pair("Q", "HIDDEN"));
    assert_eq!(seen(&content("Q", "6 BYBLOCK"), "8 P\n6 BYBLOCK"), pair("Q", "CONTINUOUS"));
    assert_eq!(seen(&content("0", ""), "8 0"), pair("0", "CONTINUOUS"));
}

#[test]
fn blocks_are_nested() {
    let blocks = block("INNER", "10 1\n20 0", &LINE.replace("8 P", "8 0"))
        + &block(
            "OUTER",
            "",
            "0 INSERT\n8 0\n6 BYBLOCK\n2 inner\n10 5\n20 0\n50 90\n0 INSERT\n8 Q\n2 Inner\n10 0\n20 0",
        );
    let drawing = drawing(&blocks, "0 INSERT\n8 P\n2 outer\n10 100\n20 0\n41 2\n42 2");
    assert_eq!(lines(&drawing), [[110.0, 0.0, 110.0, 4.0], [100.0, 0.0, 104.0, 0.0]]);
    let layers: Vec<_> = drawing.entities.iter().map(|it| &*drawing.layers[it.layer as usize].name).collect();
    assert_eq!(layers, ["P", "Q"]);
}

/// If all blocks use layer 0, everything belongs to the layer of the outermost insertion.
#[test]
fn blocks_on_layer_0_are_nested() {
    let blocks = block("INNER", "", &LINE.replace("8 P", "8 0"))
        + &block("MIDDLE", "", "0 INSERT\n8 0\n2 INNER\n10 0\n20 0")
        + &block("OUTER", "", "0 INSERT\n8 0\n2 MIDDLE\n10 0\n20 0");
    for name in ["MIDDLE", "OUTER"] {
        let text = file("", LAYERS, &blocks, &format!("0 INSERT\n8 P\n2 {name}\n10 0\n20 0"));
        let drawing = read(text.as_bytes(), &Options { keep_layer: &|name| name == "P", ..options() });
        assert_eq!(lines(&drawing), [[1.0, 0.0, 3.0, 0.0]], "{name}");
        assert_eq!(&*drawing.layers[0].name, "P");
    }
}

/// With the extrusion (0, 0, -1), the object coordinates of an insertion, including its columns, are mirrored in x.
#[test]
fn columns_and_rows_of_a_mirrored_insertion_are_mirrored() {
    let copies = |groups: &str| {
        let drawing = drawing(&block("B", "", LINE), &format!("0 INSERT\n8 X\n2 B\n10 0\n20 0\n{groups}"));
        lines(&drawing).into_iter().map(|[x, y, ..]| (x, y)).collect::<Vec<_>>()
    };
    assert_eq!(copies("70 2\n44 10\n71 2\n45 7"), [(1.0, 0.0), (11.0, 0.0), (1.0, 7.0), (11.0, 7.0)]);
    assert_eq!(
        copies("230 -1\n70 2\n44 10\n71 2\n45 7"),
        [(-1.0, 0.0), (-11.0, 0.0), (-1.0, 7.0), (-11.0, 7.0)]
    );
    assert_eq!(copies("230 -1\n50 90\n70 2\n44 10"), [(0.0, 1.0), (0.0, 11.0)]);
    assert_eq!(
        copies("41 -1\n70 2\n44 10"),
        [(-1.0, 0.0), (9.0, 0.0)],
        "scales mirror copies, not their places"
    );
}

#[test]
fn parts_of_a_block_have_its_insertion_as_origin_and_their_own_kind() {
    let drawing = drawing(
        &block("B", "", LINE),
        "0 CIRCLE\n8 P\n10 0\n20 0\n40 1\n0 INSERT\n5 FF\n8 X\n2 B\n10 0\n20 0",
    );
    assert_eq!(drawing.origins[1].handle, Some(Handle(0xFF)));
    assert_eq!(drawing.origins[1], Origin { line: drawing.origins[0].line + 10, handle: Some(Handle(0xFF)) });
    assert_eq!(drawing.entities[1].kind, EntityKind::Line);
}

#[test]
fn polylines_of_each_copy_have_their_own_group() {
    let polyline = "0 LWPOLYLINE\n8 P\n10 0\n20 0\n10 1\n20 0\n10 1\n20 1";
    let drawing = drawing(&block("B", "", polyline), "0 INSERT\n8 X\n2 B\n10 0\n20 0\n70 2\n44 5");
    let groups: Vec<_> = drawing.entities.iter().map(|it| it.group).collect();
    assert_eq!(groups, [Some(0), Some(0), Some(1), Some(1)]);
}

#[test]
fn only_wanted_layers_of_a_block_count() {
    let content = format!(
        "{LINE}\n{}\n{}",
        LINE.replace("8 P", "8 X").replace("10 1", "10 x"),
        LINE.replace("8 P", "8 0")
    );
    let text = file(
        "",
        LAYERS,
        &block("B", "", &content),
        "0 INSERT\n8 X\n2 B\n10 0\n20 0\n0 INSERT\n8 P\n2 B\n10 0\n20 0",
    );
    let drawing = read(text.as_bytes(), &Options { keep_layer: &|name| name == "P", ..options() });
    assert_eq!(drawing.faults, []);
    assert_eq!(drawing.entities.len(), 3);
    assert_eq!(drawing.layers.len(), 1);
}

#[test]
fn blocks_without_anything_wanted_are_not_expanded() {
    let blocks = block("B", "", "0 INSERT\n8 X\n2 C\n10 0\n20 0\n70 30000\n71 30000")
        + &block("C", "", &LINE.replace("8 P", "8 X"));
    let text = file("", "", &blocks, "0 INSERT\n8 X\n2 B\n10 0\n20 0\n70 30000\n71 30000\n41 2");
    let drawing = read(text.as_bytes(), &Options { keep_layer: &|name| name == "P", ..options() });
    assert_eq!(drawing, Drawing::default());
}

#[test]
fn a_block_scaled_differently_is_left_out() {
    for groups in ["41 2", "42 3", "41 2\n42 -3", "41 0\n42 0", "41 2\n42 2.000001"] {
        let drawing =
            drawing(&block("B", "", LINE), &format!("0 INSERT\n5 FF\n8 X\n2 B\n10 7\n20 8\n{groups}"));
        let [left_out] = &drawing.left_out[..] else { panic!("{drawing:?}") };
        assert_eq!((left_out.kind, left_out.point), (EntityKind::Insert, Some(Point::new(7.0, 8.0))));
        let said = "block B is left out: it is inserted with different scales in x and y";
        assert_eq!(
            (left_out.diagnostic.code(), left_out.diagnostic.text(Lang::En)),
            (Code::UnsupportedCurve, said.into())
        );
        assert_eq!(left_out.diagnostic.place.handle, Some(Handle(0xFF)));
        assert_eq!(&*drawing.layers[left_out.layer as usize].name, "P");
        assert!(drawing.entities.is_empty());
    }
    assert_eq!(inserted("41 2\n42 -2.0000000000001\n43 7").len(), 1);
    assert_eq!(inserted("41 1\n42 1.0000001").len(), 1, "the two are shown alike");
}

#[test]
fn a_block_that_the_file_lacks_is_left_out_on_its_layer() {
    let drawing = drawing("", "0 INSERT\n8 P\n2 B\n10 7\n20 8");
    assert_eq!(
        drawing.left_out[0].diagnostic.text(Lang::En),
        "block B is left out: the file does not contain it"
    );
    assert_eq!(drawing.left_out[0].point, Some(Point::new(7.0, 8.0)));
    let text = file("", "", "", "0 INSERT\n8 X\n2 B\n10 7\n20 8");
    let drawing = read(text.as_bytes(), &Options { keep_layer: &|name| name == "P", ..options() });
    assert_eq!(drawing.left_out, []);
    assert_eq!(drawing.diagnostics[0].place.point, Some(Point::new(7.0, 8.0)));
}

#[test]
fn an_inserted_block_is_defined_once() {
    let found = |second: &str, inserted: &str| {
        let blocks = block("B", "", LINE) + &block(second, "", LINE);
        faults(&drawing(&blocks, &format!("0 INSERT\n8 P\n2 {inserted}\n10 0\n20 0")))
    };
    assert_eq!(found("C", "B"), [""; 0]);
    let [fault] = &found("b", "B")[..] else { panic!("a fault") };
    assert!(fault.ends_with("the file defines block B more than once"), "{fault}");
    let others = block("C", "", LINE) + &block("B", "", LINE) + &block("B", "", LINE);
    assert_eq!(faults(&drawing(&others, "0 INSERT\n8 P\n2 C\n10 0\n20 0")), [""; 0], "not inserted");
}

#[test]
fn a_block_that_contains_itself_is_a_fault() {
    let content = |inner: &str| format!("{LINE}\n0 INSERT\n5 EE\n8 0\n2 {inner}\n10 1\n20 0");
    for blocks in
        [block("B", "", &content("B")), block("B", "", &content("C")) + &block("C", "", &content("B"))]
    {
        let drawing = drawing(&blocks, "0 INSERT\n8 X\n2 B\n10 0\n20 0");
        let [fault] = &drawing.faults[..] else { panic!("{drawing:?}") };
        assert_eq!(fault.diagnostic.text(Lang::En), "block B is nested too deeply, or contains itself");
        assert_eq!(fault.diagnostic.code(), Code::InvalidDxf);
    }
}

#[test]
fn blocks_are_nested_up_to_a_limit() {
    let nested = |depth: usize| {
        let inner: String = (1..depth)
            .map(|level| {
                block(&format!("B{level}"), "", &format!("0 INSERT\n8 X\n2 B{}\n10 0\n20 0", level + 1))
            })
            .collect();
        drawing(&(inner + &block(&format!("B{depth}"), "", LINE)), "0 INSERT\n8 X\n2 B1\n10 0\n20 0")
    };
    assert_eq!((nested(64).entities.len(), nested(64).faults.len()), (1, 0));
    assert_eq!((nested(65).entities.len(), nested(65).faults.len()), (0, 1));
}

#[test]
fn expansion_is_limited() {
    let bomb: String = (1..20)
        .map(|level| {
            block(&format!("B{level}"), "", &format!("0 INSERT\n8 X\n2 B{}\n10 0\n20 0\n70 10", level + 1))
        })
        .collect();
    let drawing = drawing(&(bomb + &block("B20", "", LINE)), "0 INSERT\n8 X\n2 B1\n10 0\n20 0");
    assert_eq!(file_faults(&drawing), ["PB005 0 the number of entities exceeds the limit of 100000"]);
    assert!(drawing.entities.is_empty());
}

#[test]
fn a_fault_in_a_block_is_said_once_a_layer() {
    let broken = "0 CIRCLE\n5 CC\n8 0\n10 x\n20 0\n40 1";
    let drawing = drawing(
        &block("B", "", broken),
        "0 INSERT\n8 P\n2 B\n10 0\n20 0\n70 3\n0 INSERT\n8 Q\n2 B\n10 0\n20 0\n0 INSERT\n8 P\n2 B\n10 0\n20 0",
    );
    let layers: Vec<_> =
        drawing.faults.iter().map(|fault| &*drawing.layers[fault.layer as usize].name).collect();
    assert_eq!(layers, ["P", "Q"]);
    assert_eq!(drawing.faults[0].diagnostic.place.handle, Some(Handle(0xCC)));
}

#[test]
fn a_broken_insertion_is_a_fault_where_it_would_have_put_something() {
    let drawing = drawing(&block("B", "", LINE), "0 INSERT\n8 X\n2 B\n10 x\n20 0");
    assert_eq!(drawing.faults.len(), 1);
    assert_eq!(&*drawing.layers[drawing.faults[0].layer as usize].name, "P");
    let unwanted = file("", "", &block("B", "", LINE), "0 INSERT\n8 X\n2 B\n10 x\n20 0");
    assert_eq!(
        read(unwanted.as_bytes(), &Options { keep_layer: &|name| name == "Z", ..options() }),
        Drawing::default()
    );
}

#[test]
fn a_tilted_insertion_is_off_its_plane() {
    let drawing = drawing(&block("B", "", LINE), "0 INSERT\n8 X\n2 B\n10 0\n20 0\n210 0\n220 1\n230 0");
    assert_eq!(drawing.faults[0].diagnostic.code(), Code::OffPlane);
}

#[test]
fn a_block_must_end() {
    let blocks = block("B", "", LINE).replace("0 ENDBLK\n8 0\n", "") + &block("C", "", LINE);
    let drawing = drawing(&blocks, "0 INSERT\n8 X\n2 B\n10 0\n20 0");
    assert_eq!(file_faults(&drawing).len(), 1);
    assert!(file_faults(&drawing)[0].starts_with("PB002"), "{drawing:?}");
    assert!(drawing.entities.is_empty());
}

#[test]
fn heights_of_blocks_add_up() {
    let line = LINE.replace("20 0", "20 0\n30 1");
    let z = |base: &str, insert: &str| match drawing(
        &block("B", base, &line),
        &format!("0 INSERT\n8 X\n2 B\n10 0\n20 0\n{insert}"),
    )
    .entities[0]
        .geometry
    {
        Geometry::Line(line) => line.start.z,
        _ => panic!(),
    };
    assert_eq!(z("10 0\n20 0\n30 0", ""), 1.0);
    assert_eq!(z("10 0\n20 0\n30 1", ""), 0.0);
    assert_eq!(z("10 0\n20 0\n30 0", "30 5\n43 2"), 7.0);
    assert_eq!(z("10 0\n20 0\n30 0", "43 0"), 0.0);
}

/// A damaged BLOCKS section may begin with a layer before its first block. This is not reported if no block draws on a wanted layer.
#[test]
fn a_section_of_blocks_may_begin_with_a_layer() {
    let section = |name: &str, pairs: &str| format!("0\nSECTION\n2\n{name}\n{pairs}0\nENDSEC\n");
    let blocks = "8\nX\n0\nBLOCK\n8\nY\n2\nB\n0\nLINE\n8\nZ\n0\nENDBLK\n";
    let text = [section("BLOCKS", blocks), section("ENTITIES", "0\nINSERT\n8\nU\n2\nB\n"), "0\nEOF\n".into()];
    let drawing = read(text.concat().as_bytes(), &Options { keep_layer: &|layer| layer == "A", ..options() });
    assert!(drawing.entities.is_empty() && drawing.diagnostics.is_empty(), "{drawing:?}");
}

/// CAD programs write an external reference as an empty block with a flag.
#[test]
fn an_empty_external_reference_is_missing() {
    let left_out = |flags: &str, content: &str| {
        let block = block("X", "", content).replace("70 0", flags);
        let drawing = drawing(&block, "0 INSERT\n8 P\n2 X\n10 0\n20 0");
        drawing.left_out.iter().map(|it| it.diagnostic.text(Lang::En)).collect::<Vec<_>>()
    };
    for flags in ["70 4", "70 12", "70 36", "70 8"] {
        assert_eq!(left_out(flags, ""), ["block X is left out: the file does not contain it"], "{flags}");
        assert_eq!(left_out(flags, LINE), [""; 0], "{flags}");
    }
    assert_eq!(left_out("70 0", ""), [""; 0], "an empty block");
    assert_eq!(left_out("70 2", ""), [""; 0]);
}

/// If the layer of its insertion is frozen, a block draws nothing in the CAD program.
#[test]
fn a_block_inserted_on_a_frozen_layer_is_told() {
    let layers =
        |flags: &str| format!("0 TABLE\n2 LAYER\n0 LAYER\n2 P\n6 DASHED\n0 LAYER\n2 X\n{flags}\n0 ENDTAB");
    let found = |flags: &str| {
        let drawing =
            read_all(file("", &layers(flags), &block("B", "", LINE), "0 INSERT\n8 X\n2 B\n10 0\n20 0"));
        assert_eq!(drawing.entities.len(), 1);
        drawing.diagnostics.iter().map(|it| it.text(Lang::En)).collect::<Vec<_>>()
    };
    assert_eq!(
        found("70 1"),
        [
            "LINE belongs to a block that is inserted on the frozen layer X, but is still used; elements like this: 1"
        ]
    );
    assert_eq!(found("70 0"), [""; 0]);
    assert_eq!(found("70 0\n62 -7"), [""; 0], "off: what lies on other layers stays visible");
}

#[test]
fn each_frozen_layer_is_told_with_the_number_of_elements() {
    let layers = "0 TABLE\n2 LAYER\n0 LAYER\n2 X\n70 1\n0 LAYER\n2 Y\n70 1\n0 LAYER\n2 Z\n70 0\n0 ENDTAB";
    let insertions = ["X", "Y", "Z", "X"].map(|layer| format!("0 INSERT\n8 {layer}\n2 B\n10 0\n20 0"));
    let text = "0 TEXT\n8 P\n10 0\n20 0\n40 1\n1 B1";
    let blocks = block("B", "", &format!("{LINE}\n{text}"));
    let drawing = read_all(file("", layers, &blocks, &insertions.join("\n")));
    assert_eq!(drawing.entities.len(), 8);
    let found = |entity: &str, layer: &str, alike: &str| {
        format!(
            "{entity} belongs to a block that is inserted on the frozen layer {layer}, but is still used; {alike}"
        )
    };
    assert_eq!(
        drawing.diagnostics.iter().map(|it| it.text(Lang::En)).collect::<Vec<_>>(),
        [
            found("LINE", "X", "elements like this: 2"),
            found("TEXT", "X", "texts like this: 2"),
            found("LINE", "Y", "elements like this: 1"),
            found("TEXT", "Y", "texts like this: 1")
        ]
    );
}

/// Returns the findings about a block that is inserted on layer P, the only layer that is read, with the layers on which the block draws.
fn left_out_on_p(blocks: &str) -> Vec<(String, Vec<String>)> {
    let text = file("", LAYERS, blocks, "0 INSERT\n8 P\n2 B\n10 7\n20 8");
    let drawing = read(text.as_bytes(), &Options { keep_layer: &|name| name == "P", ..options() });
    let left_out = drawing.left_out.iter().map(|left_out| {
        assert_eq!(left_out.point, Some(Point::new(7.0, 8.0)));
        (left_out.diagnostic.text(Lang::En), left_out.layers.iter().map(ToString::to_string).collect())
    });
    left_out.collect()
}

#[test]
fn hatches_and_blank_texts_do_not_make_a_block_draw_on_a_layer() {
    let line = LINE.replace("8 P", "8 X");
    let text = |string: &str| format!("0 MTEXT\n8 0\n10 0\n20 0\n40 1\n1 {string}");
    let hatch = "0 HATCH\n8 0\n10 0\n20 0";
    for (contents, count) in [
        (format!("{line}\n{hatch}"), 1),
        (format!("{line}\n{}", text(" ")), 1),
        (format!("{line}\n{}", text("B1")), 0),
        (hatch.to_owned(), 0),
    ] {
        assert_eq!(left_out_on_p(&block("B", "", &contents)).len(), count, "{contents}");
    }
}

#[test]
fn a_block_that_draws_on_unread_layers_only_is_left_out() {
    let on = |layer: &str| LINE.replace("8 P", &format!("8 {layer}"));
    let [(text, layers)] = &left_out_on_p(&block("B", "", &format!("{}\n{}", on("X"), on("Y"))))[..] else {
        panic!()
    };
    let said =
        "block B is inserted on this layer, but its contents lie on other layers (X, Y) and are ignored";
    assert_eq!((text.as_str(), &layers[..]), (said, &["X".to_owned(), "Y".to_owned()][..]));
    let nested = block("B", "", "0 INSERT\n8 0\n2 C\n10 0\n20 0\n0 INSERT\n8 Z\n2 D\n10 0\n20 0")
        + &block("C", "", &on("X"))
        + &block("D", "", &on("0"));
    let mut layers = left_out_on_p(&nested).remove(0).1;
    layers.sort();
    assert_eq!(layers, ["X", "Z"]);
}

/// A block is complete if one of its elements is on the layer of the insertion. Texts and annotations may be on any layer.
#[test]
fn a_block_that_draws_on_its_layer_or_nothing_is_complete() {
    let on = |layer: &str| LINE.replace("8 P", &format!("8 {layer}"));
    for content in [
        format!("{}\n{}", on("X"), on("0")),
        format!("{}\n{}", on("X"), on("P")),
        "0 TEXT\n8 X\n10 0\n20 0\n40 1\n1 A".into(),
        "0 DIMENSION\n8 X".into(),
        "0 HATCH\n8 X".into(),
        "0 ATTDEF\n8 X".into(),
        String::new(),
    ] {
        assert_eq!(left_out_on_p(&block("B", "", &content)), [], "{content}");
    }
}

#[test]
fn entities_of_mirrored_insertions_are_marked() {
    let is_mirrored = |groups: &str| {
        let drawing =
            drawing(&block("B", "", LINE), &format!("0 INSERT\n8 X\n2 B\n10 0\n20 0\n{groups}\n{LINE}"));
        drawing.entities.iter().map(|entity| entity.is_mirrored).collect::<Vec<_>>()
    };
    for groups in ["41 -1", "42 -1", "230 -1"] {
        assert_eq!(is_mirrored(groups), [true, false], "{groups}");
    }
    // Mirroring twice is a rotation.
    for groups in ["41 1", "41 -1\n42 -1", "41 -1\n230 -1", "50 90"] {
        assert_eq!(is_mirrored(groups), [false, false], "{groups}");
    }
}

/// Reads an insertion of block B, which contains [`LINE`] and another insertion of C, with an extension dictionary each. The two dictionaries lead to
/// the same filter.
fn clipped(outer: &str, inner: &str, filter: &str) -> Drawing {
    let extended = |dictionary: &str| format!("102 {{ACAD_XDICTIONARY\n360 {dictionary}\n102 }}");
    let nested = format!("0 INSERT\n5 C1\n{}\n8 0\n2 C\n10 0\n20 0", extended(inner));
    let blocks = block("B", "", &format!("{LINE}\n{nested}")) + &block("C", "", LINE);
    let insert = format!("0 INSERT\n5 B1\n{}\n8 X\n2 B\n10 5\n20 6", extended(outer));
    let objects = format!(
        "0 DICTIONARY\n5 D1\n3 ACAD_FILTER\n360 D2\n0 XRECORD\n5 D4\n71 1\n0 DICTIONARY\n5 D3\n3 ACAD_FILTER\n350 D4\n\
         0 DICTIONARY\n5 D2\n3 SPATIAL\n360 F1\n{filter}"
    );
    let text = file("", LAYERS, &blocks, &insert).replace("  0\nEOF\n", "");
    read_all(text + &section("OBJECTS", &objects) + "  0\nEOF\n")
}

/// Returns the number of entities, and what is said about each clipped insertion with its handle.
fn clipping(drawing: &Drawing) -> (usize, Vec<(String, Option<Handle>)>) {
    let said =
        |left_out: &OmittedCurve| (left_out.diagnostic.text(Lang::En), left_out.diagnostic.place.handle);
    (drawing.entities.len(), drawing.left_out.iter().map(said).collect())
}

#[test]
fn a_clipped_block_is_left_out() {
    const FILTER: &str = "0 SPATIAL_FILTER\n5 F1\n70 2\n71 1";
    let said = |block: &str| {
        format!("block {block} is left out: it is clipped (XCLIP), so only a part of it is visible")
    };
    let drawing = clipped("D1", "D3", FILTER);
    assert_eq!(clipping(&drawing), (0, vec![(said("B"), Some(Handle(0xB1)))]));
    assert_eq!(drawing.left_out[0].point, Some(Point::new(5.0, 6.0)));
    assert_eq!(clipping(&clipped("D3", "D1", FILTER)), (1, vec![(said("C"), Some(Handle(0xC1)))]));
    // Other extension dictionaries, other filters, and boundaries that are switched off do not matter.
    assert_eq!(clipping(&clipped("D3", "D3", FILTER)), (2, vec![]));
    assert_eq!(clipping(&clipped("D1", "D1", &FILTER.replace("SPATIAL", "LAYER"))), (2, vec![]));
    assert_eq!(clipping(&clipped("D1", "D1", &FILTER.replace("71 1", "71 0"))), (2, vec![]));
}

#[test]
fn objects_that_cannot_be_read_are_an_error_if_a_block_may_be_clipped() {
    let broken = "0 SPATIAL_FILTER\n5 F1\nx 1";
    assert_eq!(clipped("D1", "D1", broken).diagnostics[0].code(), Code::InvalidDxf);
    let text = file("", LAYERS, &block("B", "", LINE), "0 INSERT\n8 X\n2 B\n10 0\n20 0");
    let text = text.replace("  0\nEOF\n", "") + &section("OBJECTS", broken) + "  0\nEOF\n";
    assert_eq!(read_all(text).diagnostics, []);
}
