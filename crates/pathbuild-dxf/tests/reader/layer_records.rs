//! Tests that only LAYER records that may belong to a wanted layer are read; problems of all others are ignored. (book: reference/dxf)

use std::time::{Duration, Instant};

use pathbuild_diagnostic::Lang;
use pathbuild_dxf::{Drawing, Options, read};

use crate::support::{file, lines, options, section};

const LTYPE: &str = "0 TABLE\n2 LTYPE\n0 LTYPE\n2 1000.1P\n6 WRONG\n0 ENDTAB\n";
const STYLE: &str = "0 TABLE\n2 STYLE\n0 STYLE\n2 1000.1P\n6 WRONG\n0 ENDTAB\n";

/// Returns a drawing with these tables and a circle on each of these layers.
fn drawing(tables: &str, layers: &[&str]) -> String {
    let circle = |layer: &&str| format!("0 CIRCLE\n8 {layer}\n10 0\n20 0\n40 1\n");
    file("", tables, "", &layers.iter().map(circle).collect::<String>())
}

/// Returns the LAYER table with these records, and further tables around it.
fn table(records: &str) -> String {
    format!("{LTYPE}0 TABLE\n2 LAYER\n70 3\n{records}\n0 ENDTAB\n{STYLE}")
}

fn read_layers_with_1(file: impl AsRef<[u8]>) -> Drawing {
    read(file.as_ref(), &Options { keep_layer: &|name| name.contains('1'), ..options() })
}

/// Returns the line types of the entities, or the findings about the file.
fn line_types(file: impl AsRef<[u8]>) -> String {
    let drawing = read_layers_with_1(file);
    let said = drawing
        .diagnostics
        .iter()
        .map(|it| format!("{} {} {}", it.code(), it.place.line.unwrap_or(0), it.text(Lang::En)));
    said.chain(drawing.entities.iter().map(|it| it.line_type.to_string())).collect::<Vec<_>>().join("; ")
}

#[test]
fn a_name_is_found_in_records_of_layers_only() {
    let records =
        "0 LAYER\n2 0\n6 A\n0 LAYER\n2 1000.1P\n6 DOT\n0 LAYER\n2 1000.1PX\n6 B\n0 LAYER\n2 X1000.1P\n6 C";
    assert_eq!(line_types(drawing(&table(records), &["1000.1P"])), "DOT");
    assert_eq!(
        line_types(drawing(&table(records), &["1000.1p", "x1000.1P", "1000.1q"])),
        "DOT; C; CONTINUOUS"
    );
    assert_eq!(line_types(drawing(&format!("{LTYPE}{STYLE}"), &["1000.1P"])), "CONTINUOUS");
    assert_eq!(line_types(drawing("", &["1000.1P"])), "CONTINUOUS");
}

#[test]
fn a_record_may_follow_in_another_table_or_be_written_in_lower_case() {
    let second = format!("{}{}", table("0 LAYER\n2 0"), table("0 LAYER\n2 1000.1P\n6 DOT"));
    assert_eq!(line_types(drawing(&second, &["1000.1P"])), "DOT");
    let lower_case = table("0 LAYER\n2 0\n0 layer\n2 1000.1P\n6 DOT");
    assert_eq!(line_types(drawing(&lower_case, &["1000.1P"])), "DOT");
}

#[test]
fn it_does_not_matter_how_many_layers_are_wanted() {
    let record = |number: &usize| format!("0 LAYER\n2 A{number}P\n6 T{number}\n");
    let numbers: Vec<usize> = (1000..1050).collect();
    let tables = table(&numbers.iter().map(record).collect::<String>());
    let names: Vec<String> = numbers.iter().map(|number| format!("A{number}p")).collect();
    for count in [1, 2, 3, 4, 5, 6, 50] {
        let layers: Vec<&str> = names[..count].iter().map(String::as_str).collect();
        let expected: Vec<String> = numbers[..count].iter().map(|number| format!("T{number}")).collect();
        assert_eq!(line_types(drawing(&tables, &layers)), expected.join("; "));
    }
}

#[test]
fn names_are_found_whatever_their_letters_and_code_page() {
    for (code_page, record, layer) in [
        ("ANSI_1252", &b"Fr\xE4s 1000.1P"[..], &b"FR\xC4S 1000.1p"[..]),
        ("ANSI_1252", b"Fr\xE4s 1000.1P", b"fr\\U+00E4s 1000.1P"),
        ("ANSI_1252", b"fr\\U+00E4s 1000.1P", b"Fr\xE4s 1000.1P"),
        ("ANSI_932", b"\x83\x5c1000.1P", b"\x83\x5c1000.1p"),
        ("GBK", b"\xB0\xA11000.1P", b"\xB0\xA11000.1p"),
        ("ANSI_1252", b"\\U+0031000.1P", b"1000.1P"),
        ("ANSI_1252", b"ma\xDFe 1", b"MASSE 1"),
        ("ANSI_1252", b" 1 ", b"1"),
        ("ANSI_1252", b"x$0$1000.1P", b"1000.1p"),
        ("ANSI_1252", b"1000.1P", b"x|1000.1p"),
    ] {
        let text = section("HEADER", &format!("9 $DWGCODEPAGE\n3 {code_page}"))
            + &drawing(&table("0 LAYER\n2 RECORD\n6 DOT"), &["ENTITY"]);
        let file = replaced(&replaced(text.as_bytes(), b"RECORD", record), b"ENTITY", layer);
        assert_eq!(line_types(file), "DOT", "{code_page} {}", String::from_utf8_lossy(record));
    }
}

fn replaced(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let at = bytes.windows(from.len()).position(|it| it == from).expect("it is there");
    [&bytes[..at], to, &bytes[at + from.len()..]].concat()
}

#[test]
fn what_is_broken_in_other_records_is_not_said() {
    for broken in ["2 A", "2 A\nx y", "6", "2 2.2Q\n70"] {
        let tables = table(&format!("0 LAYER\n{broken}\n0 LAYER\n2 1000.1P\n6 DOT\n0 LAYER\n{broken}"));
        assert_eq!(line_types(drawing(&tables, &["1000.1P"])), "DOT", "{broken}");
    }
}

#[test]
fn what_is_broken_in_its_own_record_is_an_error() {
    const OWN: &str = "0 LAYER\n5 1A\n2 1000.1P\n70 64\n6 DOT";
    let text = drawing(&table(&format!("0 LAYER\n2 X\n{OWN}\n0 LAYER\n2 Y")), &["1000.1P"]);
    let own = lines(OWN);
    assert_eq!(line_types(&text), "DOT");
    for line in [0, 1, 2, 4, 6, 8] {
        let mut kept: Vec<&str> = own.lines().collect();
        kept.remove(line);
        let broken = text.replacen(&own, &(kept.join("\n") + "\n"), 1);
        let said = line_types(broken);
        assert!(said.starts_with("PB002") && said.contains("expected a group code here"), "{line}: {said}");
    }
}

/// If names contain escapes, all records are read, and damage to them is reported.
#[test]
fn a_record_whose_beginning_is_lost_is_an_error_where_all_are_read() {
    let text =
        drawing(&table("0 LAYER\n2 \\U+00E4\n0 LAYER\n5 1A\n2 1000.1P\n6 DOT\n0 LAYER\n2 Y"), &["1000.1P"]);
    assert_eq!(line_types(&text), "DOT");
    let said = line_types(text.replacen("LAYER\n  5\n1A", "  5\n1A", 1));
    assert!(said.starts_with("PB002") && said.contains("expected a group code here"), "{said}");
}

/// Reading would take hours if any part of the tables were examined twice.
#[test]
fn tables_full_of_the_name_are_read_in_time() {
    let many = |line: &str| line.repeat(100_000);
    let long = format!("3 {}\n", "1000.1P".repeat(100_000));
    let begun = Instant::now();
    for tables in [
        many("2 1000.1P\n") + &table("0 LAYER\n2 1000.1P\n6 DOT"),
        table(&(many("0 LAYER\n2 1000.1PX\n") + "0 LAYER\n2 1000.1P\n6 DOT")),
        table(&format!("0 LAYER\n2 X\n{}0 LAYER\n2 1000.1P\n6 DOT", many("3 1000.1P\n"))),
        table(&format!("0 LAYER\n2 X\n{long}0 LAYER\n2 1000.1P\n6 DOT")),
        long + &table("0 LAYER\n2 1000.1P\n6 DOT"),
    ] {
        assert_eq!(line_types(drawing(&tables, &["1000.1P"])), "DOT");
    }
    let none = table("0 LAYER\n2 X") + &many("2 1000.1P\n");
    assert_eq!(line_types(drawing(&none, &["1000.1P"])), "CONTINUOUS");
    let names: Vec<String> = (10_000..30_000).map(|number| format!("{number}.1P")).collect();
    let layers: Vec<&str> = names.iter().map(String::as_str).collect();
    let records: Vec<String> = names.iter().map(|name| format!("0 LAYER\n2 {name}\n6 DOT")).collect();
    let found = read_layers_with_1(drawing(&table(&records.join("\n")), &layers));
    assert!(found.entities.len() == 20_000 && found.entities.iter().all(|it| it.line_type == "DOT"));
    assert!(begun.elapsed() < Duration::from_mins(1), "it took {:?}", begun.elapsed());
}
