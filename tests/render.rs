//! Diagnostics in every format: the same findings, shown by the library. (spec/05-command-line.md)

use std::time::Duration;

use camino::Utf8Path;
use insta::assert_snapshot;
use pathbuild::args::Format;
use pathbuild::render::{View, render};
use pathbuild::report::{CheckedFile, CheckedPath, Findings};
use pathbuild_diagnostic::messages::files;
use pathbuild_diagnostic::{Diagnostic, ElementId, EntityKind, Handle, Lang, Point, TextFault, TraceStep};

/// One with everything that a diagnostic can have, and one with as little as possible.
fn findings() -> Findings {
    let mut rich = Diagnostic::new(&files::LIMIT)
        .with("what", "the text")
        .with("limit", "65536 characters")
        .with("key", "text-length")
        .in_file(Utf8Path::new("/work/parts/2913 Ph.dxf"))
        .in_path("2913.1P")
        .at_element(ElementId(7), EntityKind::Line, "2913.1P~A", Point::new(12.5, -30.0))
        .with_text(TextFault::new(">2051.1P Tü B5", 9..12))
        .note(&files::INTERNAL, vec![("reason", "not at all".into())]);
    rich.locate(1234, Some(Handle(0x4A1)));
    let step = |file: &str, path: &str, x| TraceStep {
        file: file.into(),
        path: path.into(),
        point: Point::new(x, 20.0),
    };
    rich.trace =
        vec![step("/work/projects/8001.dxf", "8001.1P", 1.0), step("/elsewhere/8002.dxf", "8002.1P", 2.0)];
    let plain = Diagnostic::new(&files::EMPTY_FILE).in_file(Utf8Path::new("/work/parts/2914.dxf"));
    let mut config = Diagnostic::new(&files::CANNOT_WRITE)
        .with("name", "a\u{1b}[31m.txt")
        .with("reason", "two\nlines")
        .in_file(Utf8Path::new("/work/pathbuild.toml"))
        .at_line(12, Some(8))
        .with_text(TextFault::new("feed = \u{1b}x", 7..9));
    config.severity = pathbuild_diagnostic::Severity::Warning;
    let path = |name: &str| CheckedPath { name: name.into(), time: Some(Duration::from_millis(1500)) };
    Findings {
        checked: vec![
            CheckedFile {
                file: "/work/parts/2913 Ph.dxf".into(),
                paths: vec![path("2913.1P"), path("2913.2P")],
            },
            CheckedFile { file: "/work/parts/2914.dxf".into(), paths: vec![] },
        ],
        ..Findings::new(vec![
            config,
            plain.clone(),
            rich,
            plain,
            Diagnostic::new(&files::UNREADABLE).with("reason", "no"),
        ])
    }
}

fn shown(format: Format, lang: Lang) -> String {
    render(format, &findings(), &View { lang, color: false, width: None, base: "/work".into() })
}

#[test]
fn concise_is_one_line_each() {
    assert_snapshot!(shown(Format::Concise, Lang::En));
    assert_eq!(shown(Format::Concise, Lang::De).lines().count(), findings().diagnostics.len());
}

#[test]
fn full_underlines_the_text_and_says_where() {
    assert_snapshot!(shown(Format::Full, Lang::En));
}

#[test]
fn full_speaks_german() {
    assert_snapshot!(shown(Format::Full, Lang::De));
}

#[test]
fn full_wraps_at_the_width_of_the_terminal() {
    let view = View { lang: Lang::En, color: false, width: Some(60), base: "/work".into() };
    assert_snapshot!(render(Format::Full, &findings(), &view));
}

#[test]
fn colours_are_escape_sequences_and_nothing_else_is() {
    let view = View { lang: Lang::En, color: true, width: None, base: "/work".into() };
    assert!(render(Format::Full, &findings(), &view).contains("\u{1b}["));
    for format in [Format::Full, Format::Concise] {
        assert!(!shown(format, Lang::En).contains('\u{1b}'), "{format:?}");
    }
}

#[test]
fn json_has_the_same_keys_on_every_line() {
    let text = shown(Format::Json, Lang::En);
    assert_snapshot!(text);
    let keys = "code name severity message help file line path layer handle entity x y text span trace";
    for line in text.lines() {
        let object: serde_json::Map<String, serde_json::Value> = serde_json::from_str(line).unwrap();
        let found: std::collections::BTreeSet<&str> = object.keys().map(String::as_str).collect();
        assert_eq!(found, keys.split(' ').collect(), "{line}");
    }
}

#[test]
fn json_spans_count_characters() {
    let text = shown(Format::Json, Lang::En);
    let line = text.lines().find(|line| line.contains("2051")).unwrap();
    let object: serde_json::Value = serde_json::from_str(line).unwrap();
    assert_eq!(object["span"], serde_json::json!([9, 11]));
}
