//! Compares what we read from files of many CAD programs with what ezdxf 1.4.5 reads. (book: reference/dxf)
//!
//! The files belong to others and are not part of the project: without them the test is skipped, unless `PATHBUILD_REQUIRE` names `shared`.

#![expect(clippy::disallowed_methods, reason = "the corpus is not where System could find it")]

mod oracle;
mod seen;

use std::path::PathBuf;

use oracle::{Expected, expected};
use pathbuild_dxf::{Drawing, Options, Units, read};
use seen::{layers_of, of_drawing};

fn corpus() -> Option<PathBuf> {
    pathbuild_testkit::shared("corpus")
}

fn read_all(bytes: &[u8]) -> Drawing {
    let options = Options {
        keep_layer: &|_| true,
        note_text: None,
        units: Units::Millimetres,
        approximate_curves: 0.01,
        max_entities: 1_000_000,
        max_text: 65_536,
        compatible: false,
    };
    read(bytes, &options)
}

/// Files that we read differently from ezdxf, each with the number of differences and the reason why our result is right.
const KNOWN: &[(&str, usize, &str)] = &[
    ("0b94b2f2ceaf.dxf", 1, UTF_8),
    ("0e3b61bf4451.dxf", 1, UTF_8),
    ("6b5755e29ec7.dxf", 1, UTF_8),
    ("95aa1e67e7bc.dxf", 1, UTF_8),
    ("9853e39408df.dxf", 1, UTF_8),
    ("9f80e5909b6d.dxf", 1, UTF_8),
    ("9fc07ec22518.dxf", 1, UTF_8),
    ("350ee9cad40d.dxf", 1, "a caret before a command is a caret, and the command a command"),
    ("3985d7f791b7.dxf", 1, "3DLINE is a LINE that ezdxf does not count as one"),
    ("3dd45fb5f61a.dxf", 1, "13 arcs with a radius of 0 are faults"),
    ("3e0dff76dc32.dxf", 1, STACKED),
    ("6627e2b8e4b9.dxf", 1, STACKED),
    ("6b7f78ff37f7.dxf", 1, "\\N is a line break; ezdxf drops it"),
    ("93d76a6e226b.dxf", 1, "an MTEXT attached at 0, which there is not, is attached at the top left"),
];

const UTF_8: &str = "R12 with UTF-8, which ezdxf takes for ANSI_1252";
const STACKED: &str = "`^ ` in a stacked text is dropped (book: reference/dxf)";

#[test]
fn every_file_is_read_as_ezdxf_reads_it() {
    let Some(corpus) = corpus() else { return };
    let expected = expected(&corpus);
    assert_eq!(expected.len(), 669);
    let mut wrong = Vec::new();
    for expected in &expected {
        let bytes = std::fs::read(corpus.join("files").join(&expected.file)).expect("a file of the corpus");
        let drawing = read_all(&bytes);
        let differences =
            if expected.is_strict { differences(expected, &drawing, &bytes) } else { Vec::new() };
        let known = KNOWN.iter().find(|(file, ..)| *file == expected.file).map_or(0, |(_, count, _)| *count);
        if differences.len() != known {
            wrong.push(format!("{}:\n{}", expected.file, differences.join("\n")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn differences(expected: &Expected, drawing: &Drawing, bytes: &[u8]) -> Vec<String> {
    let lines: Vec<&[u8]> = bytes.split(|byte| *byte == b'\n').collect();
    let is_inserted =
        |line: u32| lines.get(line as usize).is_some_and(|value| value.trim_ascii() == b"INSERT");
    let ours = of_drawing(drawing, is_inserted);
    if ours.len() != expected.entities.len() {
        return vec![format!("  {} entities, not {}", ours.len(), expected.entities.len())];
    }
    let pairs = ours.iter().zip(&expected.entities);
    let entities = pairs.filter_map(|(ours, theirs)| {
        ours.difference(theirs).map(|what| format!("  {what}: {ours:?}\n        {theirs:?}"))
    });
    let is_other =
        |(name, hidden): &(String, bool)| expected.layers.get(name).is_some_and(|theirs| theirs != hidden);
    let layers = layers_of(drawing)
        .into_iter()
        .filter(is_other)
        .map(|(name, hidden)| format!("  {name} hidden: {hidden}"));
    entities.chain(layers).collect()
}
