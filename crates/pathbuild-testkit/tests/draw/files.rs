//! Tests the bytes of the files: versions, encodings, line ends, omitted parts, and determinism.

use dxf::Drawing;
use dxf::entities::EntityType;
use pathbuild_testkit::{Draft, Entity, Version, sheet};

use crate::records::{Record, dxf, number, records, section, value};

const DRAWING: &str = r#"
layer Maße DASHED
start 0,0 "T2 O3"
mill 0,0 40,0 "Q^J\S1^ 2;{ä\\\P|}"
text 0,20 "Größe %%c5 \U+00E4"
"#;

fn in_version(version: Version) -> String {
    let text = if version < Version::R13 { DRAWING.replace("\\P", "") } else { DRAWING.to_owned() };
    format!("version {}\n{text}", version.name())
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

fn variable(records: &[Record], name: &str) -> Option<String> {
    let pairs: Vec<&(i32, String)> = records.iter().flatten().collect();
    let at = pairs.iter().position(|pair| pair.0 == 9 && pair.1 == name)?;
    Some(pairs[at + 1].1.trim().to_owned())
}

#[test]
fn the_crate_dxf_reads_every_version_back() {
    for version in Version::ALL {
        let sheet = sheet(&in_version(version)).unwrap();
        for bytes in [sheet.to_dxf(), sheet.to_binary_dxf()] {
            let drawing = Drawing::load(&mut bytes.as_slice()).unwrap();
            let entities: Vec<_> = drawing.entities().collect();
            assert_eq!(entities.len(), sheet.entities().len(), "{version:?}");
            for (read, written) in entities.iter().zip(sheet.entities()) {
                assert_eq!(read.common.handle.0, written.handle.unwrap().0, "{version:?}");
            }
            let EntityType::Line(line) = &entities[2].specific else { panic!("{version:?}") };
            assert_eq!((line.p2.x, line.p2.y), (40.0, 0.0), "{version:?}");
        }
    }
}

#[test]
fn binary_and_ascii_say_the_same() {
    for version in Version::ALL {
        let sheet = sheet(&in_version(version)).unwrap();
        let [ascii, binary] = [sheet.to_dxf(), sheet.to_binary_dxf()]
            .map(|bytes| Drawing::load(&mut bytes.as_slice()).unwrap());
        // The crate cannot read texts with backslashes, and decodes those of binary files as Latin-1 from R2007 on.
        let is_text = |kind: &EntityType| matches!(kind, EntityType::Text(_) | EntityType::MText(_));
        let shapes = |drawing: &Drawing| {
            let shapes = drawing.entities().map(|entity| entity.specific.clone());
            shapes.filter(|shape| !is_text(shape)).collect::<Vec<_>>()
        };
        assert_eq!(shapes(&ascii), shapes(&binary), "{version:?}");
        assert_eq!(ascii.layers().count(), binary.layers().count());
    }
    let text = dxf("binary\ntext 0,0 \"T3\\PO2 ö^I\"");
    assert!(contains(&text, b"\x01\0T3\\PO2 \xf6^I\0"));
    assert!(dxf("binary\nline 0,0 1,1").starts_with(b"AutoCAD Binary DXF\r\n\x1a\0"));
}

#[test]
fn characters_are_encoded_as_the_version_demands() {
    let umlauts = |options: &str| dxf(&format!("{options}\ntext 0,0 \"öж\""));
    assert!(contains(&umlauts(""), b"\r\n\xf6\\U+0436\r\n"));
    assert!(contains(&umlauts("codepage ANSI_1251"), b"\r\n\\U+00F6\xe6\r\n"));
    assert!(contains(&umlauts("codepage none"), b"\r\n\xf6\\U+0436\r\n"));
    assert!(contains(&umlauts("version R2007"), "\r\nöж\r\n".as_bytes()));
    assert!(contains(&umlauts("encoding utf-8"), "\r\nöж\r\n".as_bytes()));
    assert!(contains(&umlauts("version R2018\nencoding escaped"), b"\r\n\\U+00F6\\U+0436\r\n"));
    assert!(contains(&dxf("codepage ANSI_932\ntext 0,0 \"ソ\""), b"\r\n\x83\\\r\n"));
    assert!(contains(&dxf("text 0,0 \"😀\""), b"\r\n\\U+D83D\\U+DE00\r\n"));
}

#[test]
fn carets_backslashes_and_escapes_are_written_as_they_are() {
    let value = r"T3\PO2 ^J ^ x \U+00E4 \\ \S1^ 2; %%c";
    assert!(contains(&dxf(&format!("mtext 0,0 \"{value}\"")), format!("\r\n{value}\r\n").as_bytes()));
    let mut draft = Draft::new();
    draft.add(Entity::line((0.0, 0.0), (9.0, 0.0)).note("a\tb\nc"));
    assert!(
        contains(&draft.finish().unwrap().to_dxf(), b"\r\na^Ib^Jc\r\n"),
        "a line end would break the file"
    );
}

#[test]
fn line_ends_and_byte_order_mark() {
    assert!(contains(&dxf("line 0,0 1,1"), b"  0\r\nSECTION\r\n"));
    assert!(contains(&dxf("lineends lf\nline 0,0 1,1"), b"  0\nSECTION\n"));
    assert!(contains(&dxf("lineends cr\nline 0,0 1,1"), b"  0\rSECTION\r"));
    assert!(dxf("bom\nline 0,0 1,1").starts_with(b"\xef\xbb\xbf  0\r\n"));
}

#[test]
fn units_code_page_and_other_variables_are_in_the_header() {
    let header = |text: &str| records(&dxf(text));
    assert_eq!(variable(&header(""), "$INSUNITS").as_deref(), Some("4"));
    assert_eq!(variable(&header("units inch"), "$INSUNITS").as_deref(), Some("1"));
    assert_eq!(variable(&header("units 14"), "$INSUNITS").as_deref(), Some("14"));
    assert_eq!(variable(&header("units missing"), "$INSUNITS"), None);
    assert_eq!(variable(&header(""), "$DWGCODEPAGE").as_deref(), Some("ANSI_1252"));
    assert_eq!(variable(&header("codepage none"), "$DWGCODEPAGE"), None);
    assert_eq!(variable(&header("header $LTSCALE 40 5\nheader $MINE 1 x"), "$LTSCALE").as_deref(), Some("5"));
    assert_eq!(variable(&header("header $LTSCALE 40 5\nheader $MINE 1 x"), "$MINE").as_deref(), Some("x"));
}

#[test]
fn parts_are_left_out() {
    let names = |text: &str| -> Vec<String> {
        let records = records(&dxf(text));
        let named = |record: &Record| match record[0].1.as_str() {
            "SECTION" => Some(record[1].1.clone()),
            "EOF" => Some("EOF".to_owned()),
            _ => None,
        };
        records.iter().filter_map(named).collect()
    };
    assert_eq!(names(""), ["HEADER", "TABLES", "BLOCKS", "ENTITIES", "OBJECTS", "EOF"]);
    assert_eq!(names("no header\nno tables\nno blocks\nno objects\nno eof"), ["ENTITIES"]);
    assert_eq!(names("version R12"), ["HEADER", "TABLES", "BLOCKS", "ENTITIES", "EOF"]);
    let bare = records(&dxf("no handles\npolyline heavy 0,0 1,1\nblock B\nline 0,0 1,1\nendblock"));
    assert!(section(&bare, "ENTITIES").iter().flatten().all(|pair| !matches!(pair.0, 5 | 330)));
}

#[test]
fn layers_are_listed_with_their_states() {
    let records = records(&dxf(
        "layer A frozen\nlayer B off colour 3\nlayer C locked DASHED\nlayer D unlisted\nline 0,0 1,1\nlayer a\nline 0,0 1,1 layer E",
    ));
    let tables = section(&records, "TABLES");
    let layers: Vec<_> = tables.iter().filter(|record| record[0].1 == "LAYER").collect();
    let state =
        |record: &Record| (value(record, 2).unwrap().to_owned(), number(record, 70), number(record, 62));
    let expected = [("0", 0.0, 7.0), ("A", 1.0, 7.0), ("B", 0.0, -3.0), ("C", 4.0, 7.0), ("E", 0.0, 7.0)];
    assert_eq!(
        layers.iter().map(|layer| state(layer)).collect::<Vec<_>>(),
        expected.map(|(n, f, c)| (n.to_owned(), f, c))
    );
    assert_eq!(value(layers[3], 6), Some("DASHED"));
}

#[test]
fn line_types_are_listed_once_with_their_patterns() {
    let records = records(&dxf(
        "line Dashed 0,0 1,1\nline DASHED2 0,0 1,1\nline \"Mein Typ\" 0,0 1,1\nlinetype T 1 -2 0",
    ));
    let tables = section(&records, "TABLES");
    let pattern = |name: &str| -> Vec<Vec<String>> {
        let is_it =
            |record: &&Record| record[0].1 == "LTYPE" && value(record, 2).unwrap().eq_ignore_ascii_case(name);
        let dashes =
            |record: &Record| record.iter().filter(|pair| pair.0 == 49).map(|pair| pair.1.clone()).collect();
        tables.iter().filter(is_it).map(dashes).collect()
    };
    assert_eq!(pattern("DASHED"), [["12.7", "-6.35"]]);
    assert_eq!(pattern("DASHED2"), [["6.35", "-3.175"]]);
    assert_eq!(pattern("T"), [["1.0", "-2.0", "0.0"]]);
    assert_eq!(pattern("Mein Typ").len(), 1);
    for name in [
        "CONTINUOUS",
        "DIVIDE",
        "BORDER",
        "CENTER",
        "HIDDEN",
        "DASHDOT",
        "DOT",
        "PHANTOM",
        "BYLAYER",
        "BYBLOCK",
    ] {
        assert_eq!(pattern(name).len(), 1, "{name}");
    }
}

#[test]
fn every_handle_is_used_once_and_lies_below_the_seed() {
    for version in Version::ALL {
        let text = "block B\nline 0,0 1,1\npolyline heavy 0,0 1,1\nendblock\ninsert B at 0,0\npolyline heavy 0,0 1,1\nline 0,0 1,1 handle 101\nline 0,0 1,1 handle 7FFF";
        let records = records(&dxf(&format!("version {}\n{text}", version.name())));
        let handle = |record: &Record| {
            value(record, if record[0].1 == "DIMSTYLE" { 105 } else { 5 })
                .map(|h| u64::from_str_radix(h, 16).unwrap())
        };
        let body = records.iter().filter(|record| record[0].1 != "SECTION");
        let mut handles: Vec<u64> = body.filter_map(handle).collect();
        let seed = u64::from_str_radix(&variable(&records, "$HANDSEED").unwrap(), 16).unwrap();
        assert!(handles.iter().all(|handle| *handle < seed), "{version:?}");
        let count = handles.len();
        handles.sort_unstable();
        handles.dedup();
        assert_eq!(handles.len(), count, "{version:?}");
    }
}

#[test]
fn entities_have_handles_in_file_order_or_their_own() {
    let sheet = sheet("line 0,0 1,1\nline 0,0 1,1 handle 101\nline 5,5 9,9 \"B0\"").unwrap();
    let handles: Vec<u64> = sheet.entities().iter().map(|entity| entity.handle.unwrap().0).collect();
    assert_eq!(handles, [0x100, 0x101, 0x102, 0x103]);
}

#[test]
fn written_twice_the_bytes_are_equal() {
    for version in Version::ALL {
        let first = dxf(&in_version(version));
        std::thread::sleep(std::time::Duration::from_millis(5));
        assert_eq!(first, dxf(&in_version(version)), "{version:?}");
    }
}

fn fingerprints() -> String {
    let fnv = |bytes: &[u8]| {
        let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
    };
    format!("{:x?}", Version::ALL.map(|version| fnv(&dxf(&in_version(version)))))
}

#[test]
fn fingerprints_for_other_processes() {
    println!("{}", fingerprints());
}

/// Processes differ in date, random numbers, order of hash maps and time zone, none of which may affect the bytes.
#[test]
fn other_processes_write_the_same_bytes() {
    let exe = std::env::current_exe().unwrap();
    let mut child = std::process::Command::new(exe);
    child.args(["--exact", "files::fingerprints_for_other_processes", "--nocapture"]).env("TZ", "Asia/Tokyo");
    let printed = String::from_utf8(child.output().unwrap().stdout).unwrap();
    assert!(printed.contains(&fingerprints()), "{printed}");
}
