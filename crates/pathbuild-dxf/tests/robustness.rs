//! Tests that arbitrary bytes cause no panic, no hang and no non-finite numbers, and respect the wanted layers and the limits.
//! (book: reference/reliability)

use std::time::{Duration, Instant};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_dxf::{Drawing, Geometry, Options, Point3, Units, read, read_into};
use proptest::collection::vec;
use proptest::prelude::*;

/// Parts of files, valid and invalid, which are concatenated.
const PIECES: &[&str] = &[
    "  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1015\n  9\n$INSUNITS\n 70\n     1\n  0\nENDSEC\n",
    "  0\nSECTION\n  2\nTABLES\n  0\nTABLE\n  2\nLAYER\n  0\nLAYER\n  2\nA\n 70\n1\n  6\nDOT\n  0\nENDTAB\n  0\nENDSEC\n",
    "  0\nSECTION\n  2\nBLOCKS\n",
    "  0\nSECTION\n  2\nENTITIES\n",
    "  0\nBLOCK\n  2\nB\n 10\n1\n 20\n2\n",
    "  0\nBLOCK\n  2\nC\n",
    "  0\nENDBLK\n",
    "  0\nENDSEC\n",
    "  0\nEOF\n",
    "  0\nLINE\n  5\n1F\n  8\nA\n 10\n1\n 20\n2\n 11\n3\n 21\n4.5\n",
    "  0\nARC\n  8\n0\n 10\n1\n 20\n2\n 40\n3\n 50\n0\n 51\n90\n",
    "  0\nCIRCLE\n  8\nA\n 10\n1e300\n 20\n2\n 40\n1e-300\n",
    "  0\nTEXT\n  8\nA\n 10\n1\n 20\n2\n 40\n3\n  1\nT3 \\U+00E4^IO2\n 72\n4\n 11\n5\n 21\n6\n",
    "  0\nMTEXT\n  8\nA\n 10\n1\n 20\n2\n 40\n3\n  3\n{\\fArial;T3\\\n  1\nPO2\\S1^ 2;\\~}\n 11\n0\n 21\n1\n",
    "  0\nLWPOLYLINE\n  8\n0\n 70\n1\n 10\n0\n 20\n0\n 42\n1\n 10\n1\n 20\n0\n 10\n1\n 20\n1\n",
    "  0\nPOLYLINE\n  8\nA\n 70\n1\n  0\nVERTEX\n 10\n0\n 20\n0\n 42\n-0.5\n  0\nVERTEX\n 10\n1\n 20\n1\n  0\nSEQEND\n",
    "  0\nELLIPSE\n  8\nA\n 10\n0\n 20\n0\n 11\n10\n 21\n5\n 40\n0.3\n 41\n0\n 42\n6\n",
    "  0\nSPLINE\n  8\nA\n 71\n2\n 40\n0\n 40\n0\n 40\n0\n 40\n1\n 40\n1\n 40\n1\n 10\n0\n 20\n0\n 10\n5\n 20\n9\n 10\n9\n 20\n0\n",
    "  0\nINSERT\n  8\nA\n  2\nB\n 10\n5\n 20\n5\n 41\n-2\n 42\n2\n 50\n30\n 70\n3\n 44\n7\n",
    "  0\nINSERT\n  8\n0\n  2\nC\n 10\n5\n 20\n5\n 70\n32767\n 71\n32767\n",
    " 10\n-1e308\n",
    " 41\n1e308\n",
    " 42\n1e200\n",
    " 40\n0\n",
    " 60\n1\n",
    " 67\n1\n",
    "210\n0\n220\n0\n230\n-1\n",
    "101\nEmbedded Object\n",
    "102\n{X\n",
    "999\nremark\n",
    "  1\n\n",
    "  8\nx$0$A\n",
    "  1\n\\",
    "\r",
    "\n",
    "\u{feff}",
];

const MOST: usize = 200;

fn options(layers: &dyn Fn(&str) -> bool, tolerance: f64) -> Options<'_> {
    Options {
        note_text: None,
        keep_layer: layers,
        units: Units::Drawing,
        approximate_curves: tolerance,
        max_entities: MOST,
        max_text: 100,
        compatible: false,
    }
}

/// Reads a file and asserts conditions that hold for any drawing.
fn check(bytes: &[u8]) -> Drawing {
    check_with(bytes, 1e-12);
    check_with(bytes, 0.01)
}

fn check_with(bytes: &[u8], tolerance: f64) -> Drawing {
    let start = Instant::now();
    let drawing = read(bytes, &options(&|name| name == "A", tolerance));
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    let has_error = drawing.diagnostics.iter().any(Diagnostic::is_error);
    assert!(!has_error || drawing.entities.is_empty());
    assert!(drawing.entities.len() + drawing.faults.len() + drawing.left_out.len() <= MOST);
    assert_eq!(drawing.entities.len(), drawing.origins.len());
    assert!(drawing.layers.len() <= 1);
    assert!(drawing.entities.iter().all(|entity| entity.layer == 0 && is_finite(&entity.geometry)));
    assert!(drawing.faults.iter().all(|fault| fault.diagnostic.place.line.is_some()));
    drawing
}

fn is_finite(geometry: &Geometry) -> bool {
    let point = |point: &Point3| point.x.is_finite() && point.y.is_finite() && point.z.is_finite();
    let length = |length: f64| length > 0.0 && length.is_finite();
    match geometry {
        Geometry::Line(it) => point(&it.start) && point(&it.end),
        Geometry::Circle(it) => point(&it.centre) && length(it.radius),
        Geometry::Arc(it) => {
            point(&it.centre) && length(it.radius) && it.start_angle.is_finite() && it.end_angle.is_finite()
        }
        Geometry::Text(it) => point(&it.anchor) && length(it.height) && it.rotation.is_finite(),
        Geometry::MText(it) => point(&it.anchor) && length(it.height) && it.rotation.is_finite(),
    }
}

#[derive(Clone, Debug)]
enum Mutation {
    Cut(prop::sample::Index, usize),
    Overwrite(prop::sample::Index, u8),
    Insert(prop::sample::Index, prop::sample::Index),
    Truncate(prop::sample::Index),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let place = any::<prop::sample::Index>;
    prop_oneof![
        (place(), 1_usize..40).prop_map(|(at, length)| Mutation::Cut(at, length)),
        (place(), any::<u8>()).prop_map(|(at, byte)| Mutation::Overwrite(at, byte)),
        (place(), place()).prop_map(|(at, piece)| Mutation::Insert(at, piece)),
        place().prop_map(Mutation::Truncate),
    ]
}

fn mutate(bytes: &mut Vec<u8>, mutation: &Mutation) {
    let length = bytes.len() + 1;
    match mutation {
        Mutation::Cut(at, count) => {
            let at = at.index(length);
            bytes.drain(at..(at + count).min(length - 1));
        }
        Mutation::Overwrite(at, byte) => {
            if let Some(place) = bytes.get_mut(at.index(length)) {
                *place = *byte;
            }
        }
        Mutation::Insert(at, piece) => {
            let at = at.index(length);
            bytes.splice(at..at, piece.get(PIECES).bytes());
        }
        Mutation::Truncate(at) => bytes.truncate(at.index(length)),
    }
}

/// Returns the file with differently padded codes, so that most are read one by one instead of many at a time. Lines without a code are unchanged.
fn padded_otherwise(file: &[u8], paddings: &[usize]) -> Vec<u8> {
    const PADDINGS: &[(&str, &str)] =
        &[("", ""), (" ", ""), ("    ", ""), ("\t", ""), ("", " "), (" ", "\t ")];
    let lines = file.split(|byte| *byte == b'\n').enumerate().map(|(index, line)| {
        let text = std::str::from_utf8(line).unwrap_or_default().trim_ascii();
        if index % 2 == 1
            || !text.starts_with(|first: char| first.is_ascii_digit())
            || text.parse::<i32>().is_err()
        {
            return line.to_vec();
        }
        let (before, after) = PADDINGS[paddings[index / 2 % paddings.len()]];
        [before, text, after].concat().into_bytes()
    });
    lines.collect::<Vec<_>>().join(&b'\n')
}

/// Returns the file after a comment of this length.
fn behind_a_remark(file: &[u8], length: usize) -> Vec<u8> {
    [b"999\n", &*vec![b'x'; length], b"\n", file].concat()
}

/// Returns a drawing with all features.
fn everything() -> Vec<u8> {
    let content = PIECES[9..19].concat();
    let inner = PIECES[9..15].concat();
    let blocks =
        [PIECES[2], PIECES[4], &inner, PIECES[18], PIECES[6], PIECES[5], &inner, PIECES[6], PIECES[7]]
            .concat();
    [PIECES[0], PIECES[1], &blocks, PIECES[3], &content, PIECES[7], PIECES[8]].concat().into_bytes()
}

#[test]
fn the_drawing_with_everything_is_sound_but_for_what_it_should_not_be() {
    let drawing =
        read(&everything(), &Options { max_entities: 10_000, ..options(&|name| name == "A", 0.01) });
    assert!(drawing.entities.len() > 50, "{drawing:?}");
}

#[test]
fn every_beginning_of_a_file_is_read() {
    let file = everything();
    for length in 0..file.len() {
        check_with(&file[..length], 0.01);
    }
}

/// When a drawing is read into an existing value, nothing of the previous drawing is left.
#[test]
fn a_drawing_is_read_in_the_place_of_another() {
    let whole = everything();
    let file = |length: usize| whole.get(..length).unwrap_or(&whole);
    let mut drawing = Drawing::default();
    for length in [whole.len(), whole.len() / 2, 0, whole.len(), 3, whole.len() - 9, whole.len()] {
        let options = Options { max_entities: 10_000, ..options(&|name| name == "A", 0.01) };
        read_into(&mut drawing, file(length), &options);
        assert!(drawing == read(file(length), &options), "{length}");
    }
}

#[test]
fn where_a_drawing_lies_in_its_file_makes_no_difference() {
    let file = everything();
    let first = check_with(&behind_a_remark(&file, 0), 0.01);
    assert!(!first.entities.is_empty());
    for length in 1..130 {
        assert!(check_with(&behind_a_remark(&file, length), 0.01) == first, "{length}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn any_string_of_pieces_is_read(pieces in vec(prop::sample::select(PIECES), 0..40)) {
        check(pieces.concat().as_bytes());
        check(format!("{}{}{}", PIECES[3], pieces.concat(), PIECES[7]).as_bytes());
    }

    #[test]
    fn any_changed_drawing_is_read(mutations in vec(mutation(), 1..6)) {
        let mut bytes = everything();
        for mutation in &mutations {
            mutate(&mut bytes, mutation);
        }
        check(&bytes);
    }

    #[test]
    fn any_bytes_are_read(bytes in vec(any::<u8>(), 0..300)) {
        check(&bytes);
        check(&[b"AutoCAD Binary DXF\r\n\x1a\0\0\0SECTION\0\x02\0ENTITIES\0", &*bytes].concat());
        check(&[b"AutoCAD Binary DXF\r\n\x1a\0\0SECTION\0\x02ENTITIES\0", &*bytes].concat());
        check(&[PIECES[3].as_bytes(), &*bytes].concat());
    }

    /// The result does not depend on whether codes are read many at a time or one by one.
    #[test]
    fn codes_may_be_padded_in_any_way(
        mutations in vec(mutation(), 0..4),
        paddings in vec(0_usize..6, 1..20),
    ) {
        let mut bytes = everything();
        for mutation in &mutations {
            mutate(&mut bytes, mutation);
        }
        // The first line end determines the line ends of the file.
        prop_assume!(bytes.iter().find(|byte| matches!(byte, b'\r' | b'\n')) == Some(&b'\n'));
        prop_assert!(check(&padded_otherwise(&bytes, &paddings)) == check(&bytes));
    }

    #[test]
    fn line_ends_make_no_difference(pieces in vec(prop::sample::select(&PIECES[..31]), 0..20)) {
        let file = format!("{}{}{}{}", PIECES[3], pieces.concat(), PIECES[7], PIECES[8]);
        prop_assert_eq!(check(file.as_bytes()), check(file.replace('\n', "\r\n").as_bytes()));
        prop_assert_eq!(check(file.as_bytes()), check(file.replace('\n', "\r").as_bytes()));
    }
}
