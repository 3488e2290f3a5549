//! Tests diagnostics in every format, rendered by the library. (book: reference/commands)

use camino::Utf8Path;
use insta::assert_snapshot;
use pathbuild::render::Format;
use pathbuild::render::View;
use pathbuild_diagnostic::messages::files;
use pathbuild_diagnostic::{
    Diagnostic, ElementId, EntityKind, Handle, Lang, Point, TextFault, TraceStep, Value,
};
use pathbuild_path::PathName;
use pathbuild_workspace::check::CheckedFile;
use pathbuild_workspace::findings::Findings;

/// Returns one diagnostic with all parts that are possible, and one with as few as possible.
fn findings() -> Findings {
    let mut rich = Diagnostic::new(&files::LIMIT)
        .quoting("what", "the text")
        .quoting("limit", "65536 characters")
        .quoting("key", "text-length")
        .in_file(Utf8Path::new("/work/parts/2913 Ph.dxf"))
        .in_path("2913.1P")
        .at_element(ElementId(7), EntityKind::Line, "2913.1P~A", Point::new(12.5, -30.0))
        .with_text(TextFault::new(">2051.1P Tü B5", 9..12))
        .note(&files::INTERNAL, vec![("reason", Value::quoted("not at all"))]);
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
        .quoting("name", "a\u{1b}[31m.txt")
        .quoting("reason", "two\nlines")
        .in_file(Utf8Path::new("/work/pathbuild.toml"))
        .at_line(12, Some(8))
        .with_text(TextFault::new("feed = \u{1b}x", 7..9));
    config.severity = pathbuild_diagnostic::Severity::Warning;
    Findings {
        checked: vec![
            CheckedFile {
                file: "/work/parts/2913 Ph.dxf".into(),
                paths: vec![PathName::new("2913.1P"), PathName::new("2913.2P")],
            },
            CheckedFile { file: "/work/parts/2914.dxf".into(), paths: vec![] },
        ],
        ..Findings::new(vec![
            config,
            plain.clone(),
            rich,
            plain,
            Diagnostic::new(&files::UNREADABLE).quoting("reason", "no"),
        ])
    }
}

fn render(format: Format, findings: &Findings, view: &View) -> String {
    pathbuild::render::render(format, findings, view).as_str().to_owned()
}

fn shown(format: Format, lang: Lang) -> String {
    render(format, &findings(), &View { lang, color: false, width: None, base: "/work".into(), root: None })
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
    let view = View { lang: Lang::En, color: false, width: Some(60), base: "/work".into(), root: None };
    assert_snapshot!(render(Format::Full, &findings(), &view));
}

#[test]
fn colours_are_escape_sequences_and_nothing_else_is() {
    let view = View { lang: Lang::En, color: true, width: None, base: "/work".into(), root: None };
    assert!(render(Format::Full, &findings(), &view).contains("\u{1b}["));
    for format in [Format::Full, Format::Concise] {
        assert!(!shown(format, Lang::En).contains('\u{1b}'), "{format:?}");
    }
}

#[test]
fn json_has_the_same_keys_on_every_line() {
    let text = shown(Format::Json, Lang::En);
    assert_snapshot!(text);
    let keys =
        "type code name severity message help notes file line path layer handle entity x y text span trace";
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

fn many(count: u32) -> Findings {
    let error =
        |line| Diagnostic::new(&files::EMPTY_FILE).in_file(Utf8Path::new("/work/a.dxf")).at_line(line, None);
    let mut all: Vec<_> = (1..=count).map(error).collect();
    all[0].severity = pathbuild_diagnostic::Severity::Warning;
    Findings::new(all)
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn sarif_is_what_its_schema_says() {
    let text = shown(Format::Sarif, Lang::En);
    assert_snapshot!(text.replace(env!("CARGO_PKG_VERSION"), "VERSION"));
    let schema = json(include_str!("schemas/sarif-2.1.0.json"));
    let errors: Vec<_> = jsonschema::validator_for(&schema)
        .unwrap()
        .iter_errors(&json(&text))
        .map(|it| it.to_string())
        .collect();
    assert_eq!(errors, Vec::<String>::new());
    let empty = render(
        Format::Sarif,
        &Findings::default(),
        &View { lang: Lang::De, color: false, width: None, base: "/".into(), root: None },
    );
    assert!(jsonschema::is_valid(&schema, &json(&empty)));
}

#[test]
fn sarif_has_no_more_results_than_github_takes_and_says_so() {
    let view = View { lang: Lang::En, color: false, width: None, base: "/work".into(), root: None };
    // The findings are counted in the text, since parsing it takes a debug build many seconds.
    let shown = |count| render(Format::Sarif, &many(count), &view);
    let count = |text: &str, part| text.matches(part).count();
    let inside = shown(25_000);
    assert_eq!((count(&inside, "\"ruleId\""), count(&inside, "\"level\": \"warning\"")), (25_000, 1));
    assert!(!inside.contains("toolExecutionNotifications"));
    let outside = shown(25_001);
    assert_eq!(
        (count(&outside, "\"ruleId\""), count(&outside, "\"level\": \"error\"")),
        (25_000, 25_001),
        "warnings go first"
    );
    assert!(outside.contains("\"text\": \"further results left out: 1\""));
}

#[test]
fn github_annotations_are_commands_of_a_workflow() {
    assert_snapshot!(shown(Format::Github, Lang::En));
}

#[test]
fn github_gets_ten_annotations_of_a_severity_and_the_rest_as_lines() {
    let view = View { lang: Lang::En, color: false, width: None, base: "/work".into(), root: None };
    let text = render(Format::Github, &many(12), &view);
    let starts = |start: &str| text.lines().filter(|line| line.starts_with(start)).count();
    assert_eq!(
        (starts("::error "), starts("::warning "), starts("a.dxf:12: error[PB002]"), text.lines().count()),
        (10, 1, 1, 12)
    );
}

/// Tests the requirements of GitLab's page on code quality: these keys, five severities, distinct fingerprints, relative names, lines from 1.
#[test]
fn gitlab_issues_have_what_gitlab_wants() {
    let text = shown(Format::Gitlab, Lang::En);
    assert_snapshot!(text);
    let issues = json(&text);
    let issues = issues.as_array().unwrap();
    let mut fingerprints = std::collections::BTreeSet::new();
    for issue in issues {
        assert!(
            ["info", "minor", "major", "critical", "blocker"].contains(&issue["severity"].as_str().unwrap())
        );
        assert!(
            !issue["description"].as_str().unwrap().is_empty()
                && !issue["check_name"].as_str().unwrap().is_empty()
        );
        let path = issue["location"]["path"].as_str().unwrap();
        assert!(!path.is_empty() && !path.starts_with(['/', '\\']) && !path.starts_with("./"), "{path}");
        assert!(issue["location"]["lines"]["begin"].as_u64().unwrap() >= 1);
        assert!(fingerprints.insert(issue["fingerprint"].as_str().unwrap()));
    }
    assert_eq!(issues.len(), findings().diagnostics.len());
}

/// Tests against the common subset of the schemas in use (Jenkins, Maven Surefire).
#[test]
fn junit_is_xml_with_counts_that_are_right() {
    let text = shown(Format::Junit, Lang::En);
    assert_snapshot!(text);
    let document = roxmltree::Document::parse(&text).unwrap();
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "testsuites");
    let number =
        |node: roxmltree::Node<'_, '_>, name: &str| node.attribute(name).unwrap().parse::<f64>().unwrap();
    let named = |node: roxmltree::Node<'_, '_>, name: &str| {
        node.descendants().filter(|it| it.has_tag_name(name)).count() as f64
    };
    for node in
        root.descendants().filter(|node| node.has_tag_name("testsuites") || node.has_tag_name("testsuite"))
    {
        assert_eq!(number(node, "tests"), named(node, "testcase"));
        assert_eq!(number(node, "failures"), named(node, "failure"));
        assert!(node.attribute("name").is_some());
    }
    for case in root.descendants().filter(|node| node.has_tag_name("testcase")) {
        assert!(case.parent().unwrap().has_tag_name("testsuite"));
        assert!(["name", "classname", "time"].iter().all(|name| case.attribute(*name).is_some()));
        let children: Vec<_> =
            case.children().filter(roxmltree::Node::is_element).map(|it| it.tag_name().name()).collect();
        assert!(
            matches!(&children[..], [] | ["failure" | "system-out"] | ["failure", "system-out"]),
            "{children:?}"
        );
    }
}

#[test]
fn full_shows_only_the_neighbourhood_of_a_fault_in_a_long_text() {
    let of = |text: &str, span: std::ops::Range<usize>| {
        let diagnostic = Diagnostic::new(&files::EMPTY_FILE).with_text(TextFault::new(text, span));
        let view = View { lang: Lang::En, color: false, width: None, base: "/work".into(), root: None };
        render(Format::Full, &Findings::new(vec![diagnostic]), &view)
    };
    let inside = format!("{}FAULT{}", "a".repeat(400), "z".repeat(400));
    assert!(of(&inside, 400..405).contains(&inside));
    let outside = format!("{}FAULT{}", "ä".repeat(100_000), "ü".repeat(100_000));
    let shown = of(&outside, 200_000..200_005);
    assert!(shown.contains(&format!("…{}FAULT{}…", "ä".repeat(200), "ü".repeat(200))), "{shown}");
    assert!(
        shown.lines().any(
            |line| line.trim_start_matches([' ', '·']).starts_with("─────") && line.chars().count() < 250
        )
    );
    assert!(of(&outside, 0..outside.len()).len() < 10_000, "all of it is the fault");
    assert!(of("", 0..0).contains("the file is empty"));
}
