//! Tests PB005 for limits of entities and texts. (book: reference/configuration, `[limits]`)

use pathbuild_dxf::{Drawing, Options, read};

use crate::support::{entities, file_faults, options};

fn limited(pairs: &str, max_entities: usize, max_text: usize) -> Drawing {
    read(
        entities(pairs).as_bytes(),
        &Options { max_entities, max_text, approximate_curves: 0.001, ..options() },
    )
}

fn file_findings(pairs: &str, max_entities: usize, max_text: usize) -> String {
    let drawing = limited(pairs, max_entities, max_text);
    assert!(drawing.diagnostics.is_empty() || drawing.entities.is_empty());
    file_faults(&drawing).join("; ")
}

#[test]
fn entities_are_limited() {
    let sound = "0 CIRCLE\n8 A\n10 0\n20 0\n40 1\n".repeat(3);
    let broken = "0 CIRCLE\n8 A\n10 x\n20 0\n40 1\n".repeat(3);
    let left_out = "0 POLYLINE\n8 A\n70 8\n".repeat(3);
    let parts = "0 LWPOLYLINE\n8 A\n70 1\n10 0\n20 0\n10 1\n20 0\n10 1\n20 1\n";
    for pairs in [&sound, &broken, &left_out, parts] {
        assert_eq!(file_findings(pairs, 3, 100), "");
        assert_eq!(file_findings(pairs, 2, 100), "PB005 0 the number of entities exceeds the limit of 2");
    }
}

/// The first ten thousand faults count as one entity each, all others as twenty.
#[test]
fn many_faults_count_as_more_than_entities() {
    let broken = "0 CIRCLE\n8 A\n10 x\n20 0\n40 1\n";
    let left_out = "0 POLYLINE\n8 A\n70 8\n";
    for pairs in [broken.repeat(10_002), broken.repeat(10_001) + left_out] {
        assert_eq!(file_findings(&pairs, 10_021, 100), "");
        assert_eq!(
            file_findings(&pairs, 10_020, 100),
            "PB005 0 the number of entities exceeds the limit of 10020"
        );
    }
    let first = broken.repeat(10_000) + "0 CIRCLE\n8 A\n10 0\n20 0\n40 1\n";
    assert_eq!(file_findings(&first, 10_001, 100), "");
}

#[test]
fn pieces_of_curves_are_limited() {
    let ellipse = "0 ELLIPSE\n8 A\n10 0\n20 0\n11 100\n21 0\n40 0.3";
    let count = limited(ellipse, 1000, 100).entities.len();
    assert_eq!(file_findings(ellipse, count, 100), "");
    assert_eq!(
        file_findings(ellipse, count - 1, 100),
        format!("PB005 0 the number of entities exceeds the limit of {}", count - 1)
    );
}

#[test]
fn vertices_are_limited_even_if_they_make_no_entity() {
    let polyline = |corners: usize| format!("0 LWPOLYLINE\n8 A\n{}", "10 0\n20 0\n".repeat(corners));
    let pointlike = "PB121 5 LWPOLYLINE has no length: all of its points coincide, so it draws nothing";
    assert_eq!(file_findings(&polyline(20), 10, 10), pointlike);
    assert_eq!(
        file_findings(&polyline(25), 10, 10),
        "PB005 0 the number of entities exceeds the limit of 10"
    );
}

#[test]
fn texts_are_limited() {
    let too_long = "PB005 5 the length of a text in bytes exceeds the limit of 10";
    let text = |length: usize| format!("0 TEXT\n8 A\n10 0\n20 0\n40 1\n1 {}", "x".repeat(length));
    assert_eq!(file_findings(&text(10), 9, 10), "");
    assert_eq!(file_findings(&text(11), 9, 10), too_long);
    let mtext =
        |length: usize| format!("0 MTEXT\n8 A\n10 0\n20 0\n40 1\n3 xxxxx\n1 {}", "x".repeat(length - 5));
    assert_eq!(file_findings(&mtext(10), 9, 10), "");
    assert_eq!(file_findings(&mtext(11), 9, 10), too_long);
    let empty = |chunks: usize| format!("0 MTEXT\n8 A\n10 0\n20 0\n40 1\n{}", "3 \n".repeat(chunks));
    assert_eq!(file_findings(&empty(9), 2, 10), "");
    assert_eq!(file_findings(&empty(20), 2, 10), too_long);
}

#[test]
fn what_is_not_wanted_is_not_limited() {
    let pairs = format!("{}0 TEXT\n8 A\n1 {}", "0 CIRCLE\n8 A\n".repeat(3), "x".repeat(11));
    let options = Options { keep_layer: &|name| name == "B", max_entities: 2, max_text: 10, ..options() };
    assert_eq!(read(entities(&pairs).as_bytes(), &options), Drawing::default());
}
