//! Tests reading as PathDxf2GCode does: nothing but lines, arcs, circles and texts outside of blocks. (book: language/layers-and-names)

use pathbuild_dxf::{Drawing, Geometry, HorizontalAlign, Options, read};

use crate::support::{file, file_faults, options, read_all};

const LINE: &str = "0 LINE\n8 P\n10 0\n20 0\n11 3\n21 0\n";
const POLYLINE: &str = "0 LWPOLYLINE\n8 P\n90 2\n10 0\n20 0\n10 5\n20 5\n";
const OLD_POLYLINE: &str =
    "0 POLYLINE\n8 P\n0 VERTEX\n8 P\n10 0\n20 0\n0 VERTEX\n8 P\n10 1\n20 0\n0 SEQEND\n";
const INSERT: &str = "0 INSERT\n8 0\n2 B\n10 0\n20 0\n";
const BLOCK: &str = "0 BLOCK\n2 B\n10 0\n20 0\n0 CIRCLE\n8 P\n10 0\n20 0\n40 1\n0 ENDBLK";
const MTEXT: &str = "0 MTEXT\n8 P\n10 0\n20 0\n40 1\n41 6\n1 B1\n";

fn compatible(entities: &str) -> Drawing {
    read(file("", "", BLOCK, entities).as_bytes(), &Options { compatible: true, ..options() })
}

#[test]
fn polylines_and_blocks_are_left_out_with_one_warning() {
    let drawing = compatible(&[LINE, POLYLINE, OLD_POLYLINE, INSERT, POLYLINE, LINE].concat());
    assert_eq!(drawing.entities.len(), 2);
    assert!(drawing.faults.is_empty() && drawing.left_out.is_empty());
    let said = file_faults(&drawing);
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].starts_with("PB111") && said[0].ends_with("the first is LWPOLYLINE"), "{said:?}");
    for (only, first) in [(OLD_POLYLINE, "POLYLINE"), (INSERT, "CIRCLE")] {
        let said = file_faults(&compatible(only));
        assert!(said[0].ends_with(&format!("the first is {first}")), "{said:?}");
    }
}

#[test]
fn what_counts_has_no_warning() {
    assert_eq!(compatible(&[LINE, MTEXT].concat()).diagnostics, []);
    assert_eq!(
        compatible("0 INSERT\n8 0\n2 NOTHING\n10 0\n20 0\n").diagnostics,
        [],
        "blocks on no path layer"
    );
    let all = read_all(file("", "", BLOCK, &[LINE, POLYLINE, INSERT].concat()));
    assert_eq!((all.entities.len(), &all.diagnostics), (3, &vec![]));
}

#[test]
fn formatting_and_blanks_have_no_effect_on_the_place_of_a_text() {
    let formatted = MTEXT.replace("B1", r"\pxqr,i5;{\H0.5;B1 }^IF1");
    let drawing = compatible(&[&formatted, "0 TEXT\n8 P\n10 0\n20 0\n40 1\n1 B1 \n"].concat());
    let [Geometry::MText(mtext), Geometry::Text(text)] =
        [0, 1].map(|number| drawing.entities[number].geometry.clone())
    else {
        panic!("{drawing:?}")
    };
    assert_eq!((mtext.height, mtext.paragraphs, mtext.obstacle), (1.0, HorizontalAlign::Left, None));
    assert!(mtext.counts_invisible && text.counts_invisible);
}

#[test]
fn an_mtext_has_no_width() {
    let width = |drawing: Drawing| match &drawing.entities[0].geometry {
        Geometry::MText(text) => text.width,
        other => panic!("{other:?}"),
    };
    assert_eq!(width(compatible(MTEXT)), None);
    assert_eq!(width(read_all(file("", "", "", MTEXT))), Some(6.0));
    assert_eq!(width(read_all(file("", "", "", &MTEXT.replace("41 6", "41 0")))), None);
}
