//! Tests that reports of `verify` and `emit` name each program, and fail for each one that must not be milled. (book: reference/output, "Programs in
//! reports")

use std::fs;

use serde_json::Value;

use crate::support::{Place, Run};

const SOUND: &str = "(T1 D=6 CR=0 - ZMIN=-2 - flat end mill)\nG21 G90 G94 G17\nT1 M6\nS12000 M3\nG0 Z15\nG0 X0 Y0\nG1 Z-2 F200\nG1 X40 F600\nG0 Z15\nM5\nM30\n";

const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["c"]
out-dir = "gcode"
spindle = "manual"
feed = 150
rapid = 1000
sweep-height = 20
[emit]
targets = ["*"]
== c/1001.1P.dxf ==
layer 1001.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
== c/1002.1P.dxf ==
layer 1002.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 50,0
end 50,0
"#;

const REPORTS: &str = "--report junit=r.xml --report sarif=r.sarif --report gitlab=r.gitlab --report html=r.html --report json=r.json";

/// Creates a library with programs that were just written.
fn emitted() -> Place {
    let place = Place::of(LIBRARY);
    let run = place.run("emit");
    assert_eq!(run.status, Some(0), "{run}");
    place
}

/// Returns the name of each test case of the report r.xml with the type of its failure; empty if it passed.
fn test_cases(place: &Place) -> Vec<(String, String)> {
    let text = place.read("r.xml");
    let document = roxmltree::Document::parse(&text).unwrap();
    let cases = document.descendants().filter(|node| node.has_tag_name("testcase"));
    let case = |node: roxmltree::Node<'_, '_>| {
        let failure = node.children().find(|child| child.has_tag_name("failure"));
        let code = failure.and_then(|failure| failure.attribute("type")).unwrap_or_default();
        (node.attribute("name").unwrap().to_owned(), code.to_owned())
    };
    cases.map(case).collect()
}

/// Returns the files of the report r.json with their states.
fn reported_states(place: &Place) -> Vec<(String, String)> {
    let text = place.read("r.json");
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((&lines[0]["type"], &lines[lines.len() - 1]["type"]), (&"header".into(), &"summary".into()));
    let outputs = lines.iter().filter(|line| line["type"] == "output");
    let text = |line: &Value, key: &str| line[key].as_str().unwrap().to_owned();
    outputs.map(|line| (text(line, "file"), text(line, "state"))).collect()
}

fn cases<const N: usize>(expected: [(&str, &str); N]) -> Vec<(String, String)> {
    expected.iter().map(|(name, code)| ((*name).to_owned(), (*code).to_owned())).collect()
}

/// Asserts that every report and every format has exactly these findings about these programs.
#[track_caller]
fn assert_reported(place: &Place, command: &str, run: &Run, findings: &[(&str, &str)]) {
    let sarif: Value = serde_json::from_str(&place.read("r.sarif")).unwrap();
    let results = sarif["runs"][0]["results"].as_array().unwrap();
    let gitlab: Value = serde_json::from_str(&place.read("r.gitlab")).unwrap();
    let (html, json) = (place.read("r.html"), place.read("r.json"));
    let github = place.run(&format!("{command} --format github")).stdout;
    assert_eq!(results.len(), findings.len(), "{run}");
    assert_eq!(gitlab.as_array().unwrap().len(), findings.len(), "{run}");
    for (code, file) in findings {
        let uri = |result: &Value| {
            result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == **file
                && result["ruleId"] == **code
        };
        assert!(results.iter().any(uri), "{code} {file}: {sarif}");
        let is_at = |issue: &Value| {
            issue["location"]["path"] == **file && issue["description"].as_str().unwrap().starts_with(code)
        };
        assert!(gitlab.as_array().unwrap().iter().any(is_at), "{code} {file}: {gitlab}");
        assert!(html.contains(&format!("<h2>{file}</h2>")) && html.contains(code), "{code} {file}: {html}");
        let line =
            |line: &str| line.contains(&format!("\"{code}\"")) && line.contains(&format!("\"{file}\""));
        assert!(json.lines().any(line), "{code} {file}: {json}");
        let annotation = |line: &str| line.contains(&format!("file={file},")) && line.contains(code);
        assert!(github.lines().any(annotation), "{code} {file}: {github}");
    }
}

#[test]
fn a_verified_program_is_a_test_case() {
    let wrong = SOUND.replace("S12000 M3\n", "");
    let place = Place::new().file("p/a.nc", SOUND).file("p/b.nc", SOUND);
    let run = place.run(&format!("verify p {REPORTS}"));
    assert_eq!(run.status, Some(0), "{run}");
    assert_eq!(test_cases(&place), cases([("p/a.nc", ""), ("p/b.nc", "")]));
    assert!(place.read("r.html").contains("programs: 2"));
    let place = place.file("p/b.nc", wrong);
    let command = format!("verify p {REPORTS}");
    let run = place.run(&command);
    assert_eq!(run.status, Some(1), "{run}");
    assert_eq!(test_cases(&place), cases([("p/a.nc", ""), ("p/b.nc", "PB745")]));
    assert_reported(&place, &command, &run, &[("PB745", "p/b.nc")]);
    // A program that cannot be read is not verified.
    let run = place.run(&format!("verify p/a.nc p/none.nc {REPORTS}"));
    assert_eq!(run.status, Some(1), "{run}");
    assert_eq!(test_cases(&place), cases([("p/a.nc", ""), ("p/none.nc", "PB001")]));
}

#[test]
fn a_warning_about_a_program_does_not_fail_its_test_case() {
    let place = Place::new().file("a.nc", SOUND.replace("F600\n", "F600\nM0\n"));
    let run = place.run("verify a.nc --report junit=r.xml");
    assert!(run.status == Some(0) && run.stderr.contains("warning"), "{run}");
    assert_eq!(test_cases(&place), cases([("a.nc", "")]));
    assert!(place.read("r.xml").contains("<system-out>"));
}

#[test]
fn a_compared_program_is_a_test_case() {
    let place = emitted();
    let command = format!("emit --check {REPORTS}");
    let [first, second] = ["gcode/1001.1P_Milling.gcode", "gcode/1002.1P_Milling.gcode"];
    let run = place.run(&command);
    assert_eq!(run.status, Some(0), "{run}");
    assert_eq!(test_cases(&place), cases([(first, ""), (second, "")]));
    assert_reported(&place, &command, &run, &[]);
    assert_eq!(
        reported_states(&place),
        [(first.into(), "current".into()), (second.into(), "current".into())]
    );

    fs::remove_file(place.path().join(first)).unwrap();
    let place = place.file(second, "M30\n");
    let run = place.run(&command);
    assert_eq!(run.status, Some(1), "{run}");
    assert_eq!(run.stdout, format!("{first}: missing\n{second}: not current\n"));
    assert_eq!(test_cases(&place), cases([(first, "PB528"), (second, "PB528")]));
    assert_reported(&place, &command, &run, &[("PB528", first), ("PB528", second)]);
    assert_eq!(reported_states(&place), [(first.into(), "missing".into()), (second.into(), "stale".into())]);

    let run = place.run("emit --report junit=r.xml");
    assert_eq!(run.status, Some(0), "{run}");
    assert_eq!(test_cases(&place), cases([(first, ""), (second, "")]));
}

/// A program of a path with errors (PB522) is an error of the comparison, even if the configuration ignores the code.
#[test]
fn a_program_that_could_not_be_compared_fails_its_test_case() {
    let place = emitted();
    let broken = LIBRARY
        .replace("start 0,0 \"T5 O2 I1 B4 MPlate\"\nmill 0,0 50", "start 0,0 \"T5 O2 I1\"\nmill 0,0 50");
    let drawing = "c/1002.1P.dxf";
    let bytes = fs::read(Place::of(&broken).path().join(drawing)).unwrap();
    let place = place.file(drawing, bytes);
    let [first, second] = ["gcode/1001.1P_Milling.gcode", "gcode/1002.1P_Milling.gcode"];
    for (severity, code) in [("", "PB522"), ("[severity]\nPB522 = \"ignore\"\n", "PB528")] {
        let place = Place::of(&format!("== pathbuild.toml ==\n{}{severity}", configuration()))
            .file(drawing, fs::read(place.path().join(drawing)).unwrap())
            .file("c/1001.1P.dxf", fs::read(place.path().join("c/1001.1P.dxf")).unwrap())
            .file(first, place.read(first))
            .file(second, place.read(second));
        let run = place.run(&format!("emit --check {REPORTS}"));
        assert_eq!(run.status, Some(1), "{run}");
        assert_eq!(test_cases(&place), cases([("1002.1P", "PB201"), (first, ""), (second, code)]), "{run}");
        // Without --check, the finding is a warning.
        let run = place.run("emit --format concise");
        assert_eq!(run.stderr.contains("warning[PB522]"), code == "PB522", "{run}");
        assert!(!run.stderr.contains("PB528"), "{run}");
    }
}

fn configuration() -> &'static str {
    let text = LIBRARY.trim_start().strip_prefix("== pathbuild.toml ==\n").unwrap();
    text.split_once("== c/").unwrap().0
}

#[test]
fn a_program_of_a_drawing_that_is_gone_is_not_current() {
    let place = emitted();
    fs::remove_file(place.path().join("c/1002.1P.dxf")).unwrap();
    let [first, second] = ["gcode/1001.1P_Milling.gcode", "gcode/1002.1P_Milling.gcode"];
    let command = format!("emit --check {REPORTS}");
    let run = place.run(&command);
    assert_eq!(run.status, Some(1), "{run}");
    assert_eq!(run.stdout, format!("{second}: not current\n"));
    assert!(run.stderr.ends_with("1 current, 1 not current\n"), "{run}");
    assert_eq!(test_cases(&place), cases([(first, ""), (second, "PB520")]));
    assert_reported(&place, &command, &run, &[("PB520", second)]);
    // `emit` itself only warns, and `emit --check` ignores a program whose finding is accepted.
    assert_eq!(place.run("emit").status, Some(0));
    let accepted =
        format!("{}[[severity-in]]\nfiles = [\"{second}\"]\nPB520 = \"ignore\"\n", configuration());
    let place = place.file("pathbuild.toml", accepted);
    let run = place.run("emit --check");
    assert_eq!((run.status, &*run.stdout), (Some(0), ""), "{run}");
    assert!(run.stderr.ends_with("1 current, 0 not current\n"), "{run}");
}

/// A directory outside of the library may contain programs of other libraries.
#[test]
fn a_program_that_may_be_of_another_library_does_not_fail_a_comparison() {
    let shared = LIBRARY.replace("\"gcode\"", "\"../gcode\"").replace("== ", "== here/");
    let place = Place::of(&shared);
    assert_eq!(place.run_in("here", &["emit"]).status, Some(0));
    fs::remove_file(place.path().join("here/c/1002.1P.dxf")).unwrap();
    let run = place.run_in("here", &["emit", "--check"]);
    assert!(run.status == Some(0) && run.stderr.contains("warning[PB520]"), "{run}");
}
