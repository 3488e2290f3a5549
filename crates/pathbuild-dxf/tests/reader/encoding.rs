//! Tests the decoding of strings. (book: reference/dxf, "encoding")

use pathbuild_diagnostic::{Code, Lang};
use pathbuild_dxf::{Drawing, Geometry};

use crate::support::{file_codes, read_all, section};

/// Returns a file with a version (such as `AC1015`), a code page, and a TEXT of these bytes.
fn file(version: &str, code_page: &str, text: &[u8]) -> Vec<u8> {
    let variable = |name: &str, value: &str| {
        if value.is_empty() { String::new() } else { format!("9 {name}\n1 {value}\n") }
    };
    let header = variable("$ACADVER", version) + &variable("$DWGCODEPAGE", code_page);
    let mut file = section("HEADER", &header).into_bytes();
    file.extend(b"  0\nSECTION\n  2\nENTITIES\n  0\nTEXT\n  8\nA\n 10\n0\n 20\n0\n 40\n1\n  1\n");
    file.extend(text);
    file.extend(b"\n  0\nENDSEC\n  0\nEOF\n");
    file
}

fn text_of(drawing: &Drawing) -> String {
    match &drawing.entities[0].geometry {
        Geometry::Text(text) => text.string.to_string(),
        Geometry::MText(text) => text.plain.to_string(),
        other => panic!("{other:?}"),
    }
}

/// Returns the string of a file, which must have no findings.
fn decoded(version: &str, code_page: &str, text: &[u8]) -> String {
    let drawing = read_all(file(version, code_page, text));
    assert_eq!(drawing.diagnostics, []);
    text_of(&drawing)
}

/// Returns the string of a file with a doubtful encoding, and the finding about it.
fn doubtful(version: &str, code_page: &str, text: &[u8]) -> (String, String) {
    let drawing = read_all(file(version, code_page, text));
    assert_eq!(file_codes(&drawing), [Code::DoubtfulEncoding]);
    (text_of(&drawing), drawing.diagnostics[0].text(Lang::En))
}

#[test]
fn since_r2007_files_are_utf_8_whatever_they_declare() {
    for version in ["AC1021", "AC1024", "AC1032", "AC1099"] {
        assert_eq!(decoded(version, "ANSI_1251", "Ø".as_bytes()), "Ø", "{version}");
    }
    assert_eq!(decoded("AC1018", "ANSI_1251", "ü".as_bytes()), "Гј");
    assert_eq!(decoded("AC2.21", "ANSI_1251", "ü".as_bytes()), "Гј");
}

#[test]
fn older_files_are_utf_8_if_they_are_valid_and_declare_nothing_or_1252() {
    for code_page in ["", "ANSI_1252", "ansi_1252", "ASCII", "UNDEFINED"] {
        assert_eq!(decoded("AC1009", code_page, "Ø18 – ü".as_bytes()), "Ø18 – ü", "{code_page}");
        assert_eq!(decoded("AC1015", code_page, b"SCHL\xDCSSEL \x80"), "SCHLÜSSEL €", "{code_page}");
    }
    assert_eq!(decoded("", "", "Ø".as_bytes()), "Ø");
}

#[test]
fn one_byte_that_is_not_utf_8_decides_for_the_whole_file() {
    let mut bytes = file("AC1009", "", "Ø".as_bytes());
    bytes.extend(b"999\n\xFC\n");
    assert_eq!(text_of(&read_all(bytes)), "Ã˜");
}

#[test]
fn older_files_are_in_their_code_page() {
    for (code_page, bytes, text) in [
        ("ANSI_1251", &b"\xCE\xF1\xFC"[..], "Ось"),
        ("ansi_1250", b"\xE8", "č"),
        ("ANSI_1253", b"\xD9", "Ω"),
        ("ANSI_1254", b"\xFD", "ı"),
        ("ANSI_1257", b"\xE0", "ą"),
        ("ANSI_874", b"\xA1", "ก"),
        ("ANSI_932", b"\x83\x5C\x95\x5C", "ソ表"),
        ("DOS932", b"\x83\x5C", "ソ"),
        ("ANSI_936", b"\xD6\xD0", "中"),
        ("gb2312", b"\xD6\xD0", "中"),
        ("ANSI_949", b"\xB0\xA1", "가"),
        ("ANSI_950", b"\xA4\xA4", "中"),
        ("BIG5", b"\xA4\xA4", "中"),
        ("dos850", b"\x81\x9B", "üø"),
        ("DOS437", b"\x81\xE3", "üπ"),
        ("DOS852", b"\xE7", "š"),
        ("DOS865", b"\x9B", "ø"),
        ("DOS866", b"\xAE", "о"),
        ("MAC-ROMAN", b"\x8A", "ä"),
        ("8859_2", b"\xB1", "ą"),
        ("UTF-8", "ü".as_bytes(), "ü"),
    ] {
        assert_eq!(decoded("AC1015", code_page, bytes), text, "{code_page}");
    }
}

#[test]
fn bytes_that_the_encoding_does_not_know_are_doubtful_once() {
    let (text, said) = doubtful("AC1021", "", b"T3 \xFC");
    assert_eq!(text, "T3 \u{fffd}");
    assert_eq!(said, "the file is in UTF-8, in which some bytes of this text are invalid");
    assert_eq!(doubtful("AC1015", "ANSI_1253", b"\xD2").0, "\u{fffd}");
    assert_eq!(doubtful("AC1015", "ANSI_1252", b"\x81").0, "\u{81}");
    assert_eq!(doubtful("AC1015", "ANSI_932", b"\x83").0, "\u{fffd}");
    assert_eq!(doubtful("AC1015", "DOS869", b"\x80\xDD").0, "\u{fffd}δ");
    assert_eq!(doubtful("AC1015", "DOS857", b"\x8D\xE7").0, "ı\u{fffd}");
    let mut bytes = file("AC1021", "", b"\xFC");
    let two = b"  0\nTEXT\n  8\n\xFC\n 10\n0\n 20\n0\n 40\n1\n  1\n\xFC\n";
    let end = bytes.windows(8).rposition(|it| it == b"  0\nENDS").expect("it is there");
    bytes.splice(end..end, *two);
    assert_eq!(file_codes(&read_all(bytes)), [Code::DoubtfulEncoding]);
}

/// A file in UTF-8 is not improved by saving it as R2007, because it is one.
#[test]
fn the_advice_depends_on_the_version() {
    let advises_r2007 = |version: &str, code_page: &str| {
        let drawing = read_all(file(version, code_page, b"\xD2"));
        assert_eq!(file_codes(&drawing), [Code::DoubtfulEncoding]);
        drawing.diagnostics[0].help(Lang::En).expect("an advice").contains("R2007")
    };
    assert!(!advises_r2007("AC1021", "ANSI_1253") && advises_r2007("AC1018", "ANSI_1253"));
    assert!(!advises_r2007("AC1021", "JOHAB") && advises_r2007("AC1018", "JOHAB"));
}

#[test]
fn an_unknown_code_page_is_doubtful_where_it_matters() {
    assert_eq!(decoded("AC1015", "JOHAB", b"T3"), "T3");
    let (text, said) = doubtful("AC1015", "JOHAB", b"\xFC");
    assert_eq!(
        (text.as_str(), said.as_str()),
        ("ü", "the code page \"JOHAB\" is not known; texts are read as ANSI_1252")
    );
}

#[test]
fn a_byte_order_mark_means_utf_8() {
    let mut bytes = b"\xEF\xBB\xBF".to_vec();
    bytes.extend(file("AC1009", "ANSI_1251", "Ø".as_bytes()));
    assert_eq!(text_of(&read_all(bytes)), "Ø");
}

#[test]
fn strings_are_not_taken_for_a_byte_order_mark() {
    assert_eq!(decoded("AC1015", "", b"\xFF\xFEab"), "ÿþab");
    assert_eq!(decoded("AC1015", "ANSI_1252", b"\xEF\xBB\xBFab\xFF"), "ï»¿abÿ");
}

#[test]
fn unicode_escapes_are_decoded_anywhere_in_every_version() {
    for version in ["", "AC1009", "AC1015", "AC1021", "AC1032"] {
        for (text, expected) in [
            (r"\U+00E4", "ä"),
            (r"a\U+00fcb\U+2205", "aüb∅"),
            (r"\P\U+00E4\PO2", "\\Pä\\PO2"),
            (r"\~\U+0438", "\\~и"),
            (r"\\U+00E4", "\\ä"),
            (r"\U+D83D\U+DE00", "😀"),
            (r"\U+00E", r"\U+00E"),
            (r"\U+00G4", r"\U+00G4"),
            (r"\U+ 0E4", r"\U+ 0E4"),
            (r"\u+00E4", r"\u+00E4"),
            (r"\U-00E4", r"\U-00E4"),
            (r"\U+", r"\U+"),
            (r"\U+00E4ü", "äü"),
        ] {
            assert_eq!(decoded(version, "", text.as_bytes()), expected, "{version} {text}");
        }
    }
}

#[test]
fn multibyte_escapes_are_decoded() {
    for (text, expected) in [
        (r"\M+1835C", "ソ"),
        (r"\M+2A4A4", "中"),
        (r"\M+3B0A1", "가"),
        (r"\M+5D6D0", "中"),
        (r"\M+10041", "A"),
        (r"\M+6D6D0", r"\M+6D6D0"),
        (r"\M+1835", r"\M+1835"),
        (r"\M+x", r"\M+x"),
    ] {
        assert_eq!(decoded("AC1015", "", text.as_bytes()), expected, "{text}");
    }
}

#[test]
fn escapes_that_are_no_character_are_doubtful() {
    for text in [r"\U+D800", r"\U+DC00\U+D800", r"\M+1FFFF", r"\M+4D6D0"] {
        let (decoded, _) = doubtful("AC1021", "", text.as_bytes());
        assert!(decoded.chars().all(|c| c == '\u{fffd}'), "{text}: {decoded}");
    }
}

/// Returns a file with one MTEXT split into these chunks.
fn chunks(version: &str, chunks: &[(u8, &[u8])]) -> Vec<u8> {
    let mut file = section("HEADER", &format!("9 $ACADVER\n1 {version}")).into_bytes();
    file.extend(b"  0\nSECTION\n  2\nENTITIES\n  0\nMTEXT\n  8\nA\n 10\n0\n 20\n0\n 40\n1\n");
    for (code, bytes) in chunks {
        file.extend(format!("{code:>3}\n").bytes());
        file.extend(*bytes);
        file.push(b'\n');
    }
    file.extend(b"  0\nENDSEC\n  0\nEOF\n");
    file
}

#[test]
fn chunks_are_joined_before_they_are_decoded() {
    for split in
        [[(3, &b"a\\U+0"[..]), (1, b"0E4b")], [(3, b"a\\"), (1, b"U+00E4b")], [(3, b"a\xC3"), (1, b"\xA4b")]]
    {
        assert_eq!(text_of(&read_all(chunks("AC1021", &split))), "aäb");
    }
    let three: [(u8, &[u8]); 3] = [(3, b"T3"), (3, b"\\PO"), (1, b"2")];
    assert_eq!(text_of(&read_all(chunks("AC1015", &three))), "T3\nO2");
}

#[test]
fn names_of_layers_are_decoded() {
    let mut bytes = section("HEADER", "9 $ACADVER\n1 AC1015\n9 $DWGCODEPAGE\n3 ANSI_1252").into_bytes();
    bytes.extend(b"  0\nSECTION\n  2\nENTITIES\n  0\nCIRCLE\n  8\nSCHL\xDCSSEL\\U+00e4\n 10\n0\n 20\n0\n 40\n1\n  0\nENDSEC\n  0\nEOF\n");
    assert_eq!(&*read_all(bytes).layers[0].name, "SCHLÜSSELä");
}

#[test]
fn carets_stand_for_control_characters() {
    for (text, expected) in [
        ("T3^IO2", "T3\tO2"),
        ("T3^JO2", "T3\nO2"),
        ("T3^M^JO2", "T3\nO2"),
        ("a^ b", "a^b"),
        ("a^2", "a^2"),
        ("a^", "a^"),
        ("^ü", "^ü"),
    ] {
        assert_eq!(decoded("AC1021", "", text.as_bytes()), expected, "{text}");
    }
}
