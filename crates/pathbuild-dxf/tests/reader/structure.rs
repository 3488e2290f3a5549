//! Tests sections, the end of the file, and files that are not DXF. (book: reference/dxf; book: reference/diagnostics, PB002 and PB007)

use crate::support::{entities, file_faults, read_all, section};

const CIRCLE: &str = "0 CIRCLE\n8 A\n10 1\n20 2\n40 3";

/// Returns the findings about a file as a whole.
fn file_findings(file: impl AsRef<[u8]>) -> String {
    let drawing = read_all(file);
    assert!(
        drawing.diagnostics.is_empty() || drawing.entities.is_empty() || !drawing.diagnostics[0].is_error()
    );
    file_faults(&drawing).join("; ")
}

#[test]
fn pointers_of_git_lfs_are_named() {
    let pointer =
        |address: &str| file_findings(format!("version https://{address}\noid sha256:4d7a\nsize 12345\n"));
    assert_eq!(
        pointer("git-lfs.github.com/spec/v1"),
        "PB002 1 this is not the drawing, but a Git LFS pointer to it"
    );
    assert_eq!(pointer("example.com/spec/v1"), "PB002 1 this is not a DXF file: a text without sections");
}

#[test]
fn files_without_structure_are_no_dxf() {
    assert_eq!(file_findings(""), "PB002 0 the file is empty");
    assert_eq!(file_findings("   \r\n\n "), "PB002 1 this is not a DXF file: nothing but blanks");
    assert_eq!(
        file_findings("Dear Sir,\nthis is no drawing\n"),
        "PB002 1 this is not a DXF file: a text without sections"
    );
    assert_eq!(file_findings(b"AC1032\0\0\0\0\0\0rest"), "PB002 1 this is not a DXF file: a DWG drawing");
    assert_eq!(
        file_findings([0x89, b'P', b'N', b'G', 0, 1, 2, 3]),
        "PB002 1 this is not a DXF file: binary data"
    );
    assert_eq!(
        file_findings("  0\nLINE\n  8\nA\n"),
        "PB002 1 this is not a DXF file: a text without sections"
    );
}

#[test]
fn noise_is_refused_in_no_time() {
    let noise: Vec<u8> =
        (0..20_000_000_u32).map(|index| (index.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let blanks = vec![b' '; 20_000_000];
    let start = std::time::Instant::now();
    assert!(file_findings(noise).starts_with("PB002"));
    assert!(file_findings(blanks).starts_with("PB002"));
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}

#[test]
fn a_file_of_other_sections_is_an_empty_drawing_if_it_ends() {
    let header = section("HEADER", "9 $ACADVER\n1 AC1015");
    assert_eq!(file_findings(format!("{header}  0\nEOF\n")), "");
    assert_eq!(file_findings(&header), "PB002 11 the file ends before its ENTITIES section");
    assert_eq!(file_findings("  0\nSECTION\n"), "PB002 3 the file ends before its ENTITIES section");
}

#[test]
fn the_end_of_file_must_be_there() {
    let sound = entities(CIRCLE);
    let without = sound.strip_suffix("  0\nEOF\n").expect("it ends so");
    assert_eq!(file_findings(&sound), "");
    assert_eq!(file_findings(sound.trim_end()), "");
    assert_eq!(file_findings(without), "PB007 0 the file does not end with EOF");
    assert_eq!(read_all(without).entities.len(), 1);
    assert_eq!(file_findings(format!("{without}  1\nEOF\n")), "PB007 0 the file does not end with EOF");
    assert_eq!(file_findings(format!("{without}  0\nEOFX\n")), "PB007 0 the file does not end with EOF");
}

#[test]
fn bytes_after_the_end_of_file_are_ignored() {
    assert_eq!(file_findings(format!("{}\u{1a}\0\0rest", entities(CIRCLE))), "");
}

#[test]
fn nothing_behind_the_entities_is_looked_at() {
    let sound = entities(CIRCLE);
    let objects = "  0\nSECTION\n  2\nOBJECTS\nnonsense\n  0\nENTITIES\nx\n";
    assert_eq!(file_findings(sound.replace("  0\nEOF", &format!("{objects}  0\nEOF"))), "");
}

#[test]
fn truncation_inside_entities_is_an_error_with_its_line() {
    let sound = entities(CIRCLE);
    let end = sound.find("  0\nENDSEC").expect("it is there");
    assert_eq!(file_findings(&sound[..end]), "PB002 15 the file is cut off in section ENTITIES");
    let in_a_pair = sound.find(" 40\n3").expect("it is there");
    assert_eq!(file_findings(&sound[..in_a_pair + 3]), "PB002 14 the file is cut off in section ENTITIES");
    assert_eq!(file_findings(&sound[..in_a_pair + 4]), "PB002 14 the file is cut off in section ENTITIES");
    let in_the_end = sound.find("SEC\n  0\nEOF").expect("it is there");
    assert_eq!(file_findings(&sound[..in_the_end]), "PB002 17 the file is cut off in section ENTITIES");
}

#[test]
fn truncation_of_another_section_is_an_error() {
    assert_eq!(
        file_findings("  0\nSECTION\n  2\nBLOCKS\n  0\nBLOCK\n"),
        "PB002 7 the file is cut off in section BLOCKS"
    );
}

#[test]
fn a_section_must_end_before_the_next() {
    let text = section("TABLES", "").replace("  0\nENDSEC\n", "") + &entities(CIRCLE);
    assert_eq!(
        file_findings(text),
        "PB002 5 section TABLES has no end: ENDSEC is missing before \"SECTION\""
    );
    let text = entities(CIRCLE).replace("  0\nENDSEC\n", "");
    assert_eq!(file_findings(text), "PB002 15 section ENTITIES has no end: ENDSEC is missing before \"EOF\"");
}

#[test]
fn a_section_ends_with_a_pair_and_not_with_a_word() {
    let blocks = section("BLOCKS", "1 ENDSEC\n0 XENDSEC\n0 ENDSECX\n10 ENDSEC\n0 BLOCK");
    assert_eq!(file_findings(format!("{blocks}{}", entities(CIRCLE))), "");
}

#[test]
fn only_sections_follow_each_other() {
    let text = entities(CIRCLE).replacen("  0\nSECTION", "  0\nLINE\n  0\nSECTION", 1);
    assert_eq!(file_findings(&text), "PB002 1 this is not a DXF file: a text without sections");
    assert_eq!(
        file_findings(section("HEADER", "") + &text),
        "PB002 7 expected a section or the end of the file here, not \"LINE\""
    );
}

#[test]
fn variables_behind_the_header_count() {
    // The section has the form that dxflib 2.0 writes.
    let header = section("HEADER", "9 $ACADVER\n1 AC1015") + "  9\n$INSUNITS\n 70\n     1\n  0\nENDSEC\n";
    let drawing = read_all(format!("{header}{}", entities(CIRCLE)));
    assert_eq!(
        file_faults(&drawing),
        ["PB113 14 the drawing's units are inches, not millimetres ($INSUNITS is 1)"]
    );
}

/// Nothing after ENTITIES is read, so a section that is needed must not be there.
#[test]
fn a_section_that_is_read_may_not_follow_the_entities() {
    let behind = |name: &str| {
        file_findings(entities(CIRCLE).replace("  0\nEOF", &format!("{}  0\nEOF", section(name, "9 x"))))
    };
    for name in ["HEADER", "TABLES", "BLOCKS", "ENTITIES"] {
        let expected =
            format!("PB002 19 the section {name} comes after ENTITIES, where its contents would be ignored");
        assert_eq!(behind(name), expected);
    }
    assert_eq!(behind("OBJECTS"), "");
    assert_eq!(behind("ENTITIESX"), "");
    let text = "0 SECTION\n1 TABLES";
    assert_eq!(
        file_findings(entities(CIRCLE).replace("  0\nEOF", &format!("{}  0\nEOF", section("OBJECTS", text)))),
        ""
    );
}

#[test]
fn a_section_comes_once() {
    for name in ["TABLES", "BLOCKS"] {
        let twice = section(name, "") + &section(name, "") + &entities(CIRCLE);
        assert_eq!(
            file_findings(&twice),
            format!("PB002 9 this is a second section {name}; only one is allowed")
        );
    }
    assert_eq!(file_findings(section("CLASSES", "") + &section("CLASSES", "") + &entities(CIRCLE)), "");
}
