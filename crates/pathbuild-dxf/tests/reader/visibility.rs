//! Tests which invisible entities are read, and which are not. (book: reference/dxf)

use pathbuild_diagnostic::{Code, Severity};

use crate::support::{entities, faults, file_codes, file_faults, read_all};

const CIRCLE: &str = "0 CIRCLE\n8 A\n10 0\n20 0\n40 1";

#[test]
fn paper_space_is_skipped() {
    for (groups, count) in [("67 1", 0), ("67      1", 0), ("67 0", 1), ("", 1)] {
        assert_eq!(read_all(entities(&format!("{CIRCLE}\n{groups}"))).entities.len(), count, "{groups}");
    }
    let broken = read_all(entities("0 CIRCLE\n67 1\n8 A\n10 x\n20 0\n40 1"));
    assert_eq!((broken.faults.len(), broken.layers.len()), (0, 0));
}

#[test]
fn invisible_entities_count_with_a_warning_for_each_layer() {
    let hidden = format!("{CIRCLE}\n60 1");
    let drawing =
        read_all(entities(&format!("{CIRCLE}\n60 0\n{hidden}\n{hidden}\n{}", hidden.replace("8 A", "8 B"))));
    assert_eq!(drawing.entities.len(), 4);
    assert_eq!(file_codes(&drawing), [Code::LayerNotVisible, Code::LayerNotVisible]);
    assert_eq!(drawing.diagnostics[0].severity, Severity::Warning);
    let found = |line: u32, count: u32| {
        format!("PB112 {line} CIRCLE is marked invisible, but is still used; elements like this: {count}")
    };
    assert_eq!(file_faults(&drawing), [found(17, 2), found(41, 1)]);
}

/// A text that is overlooked changes a visible element.
#[test]
fn invisible_texts_count_apart_from_elements() {
    let text = "0 TEXT\n8 A\n60 1\n10 0\n20 0\n40 1\n1 B1";
    let drawing = read_all(entities(&format!("{CIRCLE}\n60 1\n{text}\n{text}\n{CIRCLE}\n60 1")));
    assert_eq!(
        file_faults(&drawing),
        [
            "PB112 5 CIRCLE is marked invisible, but is still used; elements like this: 2",
            "PB112 17 TEXT is marked invisible, but is still used; texts like this: 2"
        ]
    );
}

#[test]
fn a_broken_number_never_means_visible_or_in_model_space() {
    for code in [60, 67] {
        for value in ["x", ""] {
            let drawing = read_all(entities(&format!("{CIRCLE}\n{code} {value}")));
            let fault = format!("PB002 16 A: CIRCLE: group {code} must be a number, not \"{value}\"");
            assert_eq!((drawing.entities.len(), faults(&drawing)), (0, vec![fault]));
        }
        let drawing = read_all(entities(&format!("{CIRCLE}\n{code} 0.0")));
        assert_eq!((drawing.entities.len(), faults(&drawing)), (1, vec![]));
    }
}

#[test]
fn an_invisible_element_that_is_left_out_or_broken_has_one_finding() {
    for (entity, found) in [
        ("0 SOLID\n8 A\n10 0\n20 0\n60 1", (1, 0)),
        ("0 SPLINE\n8 A\n10 0\n20 0\n60 1", (1, 0)),
        ("0 CIRCLE\n8 A\n10 0\n20 0\n40 x\n60 1", (0, 1)),
    ] {
        let drawing = read_all(entities(entity));
        assert_eq!((drawing.left_out.len(), drawing.faults.len()), found, "{entity}");
        assert_eq!(drawing.diagnostics, [], "{entity}");
    }
}

#[test]
fn an_attribute_and_its_end_are_no_entities() {
    let drawing =
        read_all(entities(&format!("0 ATTRIB\n8 A\n10 1\n20 1\n40 1\n1 x\n0 SEQEND\n8 A\n{CIRCLE}")));
    assert_eq!((drawing.entities.len(), faults(&drawing).len(), drawing.left_out.len()), (1, 0, 1));
}
