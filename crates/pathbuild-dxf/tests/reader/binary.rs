//! Tests that binary files give the same drawing as their ASCII form.

use pathbuild_dxf::{Drawing, Geometry};

use crate::support::{file, file_faults, lines, read_all, section};

const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

#[derive(Clone, Copy, Debug)]
enum Codes {
    OneByte,
    TwoBytes,
}

fn binary(ascii: &str, codes: Codes) -> Vec<u8> {
    let mut bytes = SENTINEL.to_vec();
    let lines: Vec<&str> = ascii.lines().collect();
    for pair in lines.chunks(2) {
        let code: i16 = pair[0].trim().parse().expect("a code");
        match codes {
            Codes::TwoBytes => bytes.extend(code.to_le_bytes()),
            Codes::OneByte if code < 255 => bytes.push(u8::try_from(code).expect("a small code")),
            Codes::OneByte => {
                bytes.push(255);
                bytes.extend(code.to_le_bytes());
            }
        }
        let number = || pair[1].trim().parse::<f64>().expect("a number");
        #[expect(clippy::cast_possible_truncation, reason = "small whole numbers")]
        match code {
            10..=59 | 210..=239 | 1040 => bytes.extend(number().to_le_bytes()),
            60..=79 | 370 | 1070 => bytes.extend((number() as i16).to_le_bytes()),
            90..=99 | 420 | 1071 => bytes.extend((number() as i32).to_le_bytes()),
            160 => bytes.extend((number() as i64).to_le_bytes()),
            290 => bytes.push(u8::from(number() != 0.0)),
            310 | 1004 => {
                bytes.push(u8::try_from(pair[1].len()).expect("a short chunk"));
                bytes.extend(pair[1].bytes());
            }
            _ => {
                bytes.extend(pair[1].bytes());
                bytes.push(0);
            }
        }
    }
    bytes
}

const HEADER: &str = "9 $ACADVER\n1 AC1021\n9 $INSUNITS\n70 4";
const TABLES: &str = "0 TABLE\n2 LAYER\n0 LAYER\n2 A\n70 1\n62 7\n6 DASHED\n290 1\n370 -3\n0 ENDTAB";
const BLOCKS: &str = "0 BLOCK\n2 B\n10 1\n20 0\n0 CIRCLE\n8 A\n10 1\n20 0\n40 1\n0 ENDBLK";
const ENTITIES: &str = "0 LINE\n5 1F\n8 A\n420 16711680\n10 0.1\n20 -1e-7\n11 1e5\n21 3\n1001 APP\n1070 5\n1071 70000\n1040 1.5\n1004 abc\n0 TEXT\n8 A\n10 0\n20 0\n40 2.5\n1 T3 94°\n160 5\n310 xyz\n0 INSERT\n8 A\n2 B\n10 5\n20 5\n";

#[test]
fn clipping_boundaries_after_the_entities_are_read() {
    let insert = "0 INSERT\n102 {ACAD_XDICTIONARY\n360 D1\n102 }\n8 A\n2 B\n10 5\n20 5";
    let objects = "0 DICTIONARY\n5 D1\n3 ACAD_FILTER\n360 D2\n0 DICTIONARY\n5 D2\n3 SPATIAL\n360 F1\n0 SPATIAL_FILTER\n5 F1\n71 1";
    let before = file(HEADER, TABLES, BLOCKS, insert).replace("  0\nEOF\n", "");
    let ascii = before + &section("OBJECTS", objects) + "  0\nEOF\n";
    let expected = read_all(&ascii);
    assert_eq!((expected.entities.len(), expected.left_out.len()), (0, 1));
    assert_eq!(expected.diagnostics, []);
    for codes in [Codes::OneByte, Codes::TwoBytes] {
        assert_eq!(read_all(binary(&ascii, codes)), expected, "{codes:?}");
    }
}

#[test]
fn both_kinds_are_read_like_ascii() {
    let ascii = file(HEADER, TABLES, BLOCKS, ENTITIES);
    let expected = read_all(&ascii);
    assert_eq!((expected.entities.len(), &expected.diagnostics), (3, &vec![]));
    for codes in [Codes::OneByte, Codes::TwoBytes] {
        assert_eq!(read_all(binary(&ascii, codes)), expected, "{codes:?}");
    }
}

#[test]
fn remarks_may_come_first() {
    let ascii = format!("999\nremark\n{}", file(HEADER, TABLES, BLOCKS, ENTITIES));
    for codes in [Codes::OneByte, Codes::TwoBytes] {
        assert_eq!(read_all(binary(&ascii, codes)), read_all(&ascii), "{codes:?}");
    }
}

#[test]
fn line_ends_in_strings_are_no_line_ends() {
    let ascii = file("", "", "", "0 TEXT\n8 A\n10 0\n20 0\n40 2.5\n1 T3~O2");
    let mut bytes = binary(&ascii, Codes::TwoBytes);
    let at = bytes.iter().position(|byte| *byte == b'~').expect("it is there");
    bytes[at] = b'\n';
    let Geometry::Text(text) = &read_all(bytes).entities[0].geometry else { panic!() };
    assert_eq!(&*text.string, "T3\nO2");
}

#[test]
fn numbers_that_are_not_finite_are_faults() {
    let ascii = file("", "", "", "0 CIRCLE\n8 A\n10 1.5\n20 0\n40 2.5");
    let mut bytes = binary(&ascii, Codes::TwoBytes);
    let at = bytes.windows(8).position(|it| it == 1.5_f64.to_le_bytes()).expect("it is there");
    bytes[at..at + 8].copy_from_slice(&f64::NAN.to_le_bytes());
    assert_eq!(read_all(bytes).faults.len(), 1);
}

#[test]
fn the_end_of_file_must_be_there() {
    for codes in [Codes::OneByte, Codes::TwoBytes] {
        let mut bytes = binary(&file("", "", "", ENTITIES), codes);
        assert_eq!(read_all(&bytes).diagnostics, []);
        bytes.extend([0; 20]);
        assert_eq!(read_all(&bytes).diagnostics, []);
        let end = bytes.windows(4).rposition(|it| it == b"EOF\0").expect("it is there");
        bytes.truncate(end);
        assert_eq!(file_faults(&read_all(&bytes)), ["PB007 0 the file does not end with EOF"]);
    }
}

#[test]
fn truncation_is_an_error() {
    for codes in [Codes::OneByte, Codes::TwoBytes] {
        let bytes = binary(&file("", "", "", ENTITIES), codes);
        let end = bytes.windows(7).rposition(|it| it == b"ENDSEC\0").expect("it is there");
        for length in 0..end {
            let drawing = read_all(&bytes[..length]);
            assert!(drawing.diagnostics[0].is_error(), "{length}");
            assert_eq!(drawing.entities, []);
        }
    }
}

#[test]
fn a_code_of_unknown_type_is_an_error() {
    let ascii =
        file("", "", "", "0 CIRCLE\n8 A\n10 1\n20 0\n40 2.5\n600 x\n0 CIRCLE\n8 A\n10 1\n20 0\n40 2.5");
    let drawing = read_all(binary(&ascii, Codes::TwoBytes));
    assert!(file_faults(&drawing)[0].starts_with("PB002 35 expected a group code here"), "{drawing:?}");
}

#[test]
fn an_empty_binary_file_is_none() {
    assert!(read_all(SENTINEL).diagnostics[0].is_error());
    assert!(read_all(&SENTINEL[..20]).diagnostics[0].is_error());
    assert_eq!(read_all(binary(&lines("0 EOF"), Codes::TwoBytes)), Drawing::default());
}
