//! Builds small files around a few pairs of interest.

use std::fmt::Write;

use pathbuild_diagnostic::{Code, Lang};
use pathbuild_dxf::{Drawing, Entity, Geometry, Options, Units, read};

/// Returns options that keep all entities.
pub(crate) fn options() -> Options<'static> {
    Options {
        keep_layer: &|_| true,
        note_text: None,
        units: Units::Header,
        approximate_curves: 0.0,
        max_entities: 100_000,
        max_text: 65_536,
        compatible: false,
    }
}

/// Returns a section with pairs, which are given as `code value` lines.
pub(crate) fn section(name: &str, pairs: &str) -> String {
    format!("  0\nSECTION\n  2\n{name}\n{}  0\nENDSEC\n", lines(pairs))
}

/// Returns pairs in DXF form, given as `code value` lines.
pub(crate) fn lines(pairs: &str) -> String {
    let mut text = String::new();
    for line in pairs.lines().map(str::trim_start).filter(|line| !line.is_empty()) {
        let (code, value) = line.split_once(' ').unwrap_or((line, ""));
        writeln!(text, "{code:>3}\n{value}").expect("strings can be written to");
    }
    text
}

/// Returns a file with these entities and nothing else.
pub(crate) fn entities(pairs: &str) -> String {
    section("ENTITIES", pairs) + "  0\nEOF\n"
}

/// Returns a file with header variables, table records, blocks and entities.
pub(crate) fn file(header: &str, tables: &str, blocks: &str, entities: &str) -> String {
    section("HEADER", header)
        + &section("TABLES", tables)
        + &section("BLOCKS", blocks)
        + &section("ENTITIES", entities)
        + "  0\nEOF\n"
}

pub(crate) fn read_all(file: impl AsRef<[u8]>) -> Drawing {
    read(file.as_ref(), &options())
}

/// Reads a drawing with a single entity and no findings.
pub(crate) fn only(file: impl AsRef<[u8]>) -> Entity {
    let drawing = read_all(file);
    assert_eq!((&drawing.faults, &drawing.left_out, &drawing.diagnostics), (&vec![], &vec![], &vec![]));
    assert_eq!(drawing.entities.len(), 1, "{drawing:?}");
    drawing.entities.into_iter().next().expect("one entity")
}

pub(crate) fn only_geometry(file: impl AsRef<[u8]>) -> Geometry {
    only(file).geometry
}

pub(crate) fn file_codes(drawing: &Drawing) -> Vec<Code> {
    drawing.diagnostics.iter().map(pathbuild_diagnostic::Diagnostic::code).collect()
}

/// Returns faults as code, line and message.
pub(crate) fn faults(drawing: &Drawing) -> Vec<String> {
    let show = |fault: &pathbuild_dxf::Fault| {
        let it = &fault.diagnostic;
        let layer = &drawing.layers[fault.layer as usize].name;
        format!("{} {} {layer}: {}", it.code(), it.place.line.unwrap_or(0), it.text(Lang::En))
    };
    drawing.faults.iter().map(show).collect()
}

/// Returns findings about the file as code, line and message.
pub(crate) fn file_faults(drawing: &Drawing) -> Vec<String> {
    let show = |it: &pathbuild_diagnostic::Diagnostic| {
        format!("{} {} {}", it.code(), it.place.line.unwrap_or(0), it.text(Lang::En))
    };
    drawing.diagnostics.iter().map(show).collect()
}
