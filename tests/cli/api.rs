//! The library `pathbuild-api` and the program give the same answers about the example library.

use std::fs;

use pathbuild_api::{
    CheckState, EmitOptions, FileState, Finding, Lang, Library, LibraryOptions, VerifyOptions,
};
use serde_json::{Value as Json, json};

use crate::support::{Place, project};

/// Creates a copy of the example library, outside of any repository.
fn example() -> Place {
    let library = project().join("fixtures/library");
    let mut place = Place::new().file("pathbuild.toml", fs::read(library.join("pathbuild.toml")).unwrap());
    for folder in ["components", "projects", "mistakes"] {
        for entry in fs::read_dir(library.join(folder)).unwrap() {
            let entry = entry.unwrap();
            let name = format!("{folder}/{}", entry.file_name().to_str().unwrap());
            place = place.file(&name, fs::read(entry.path()).unwrap());
        }
    }
    place
}

/// Returns the lines of this type in the program's output.
fn rows(place: &Place, kind: &str, arguments: &str) -> Vec<Json> {
    let run = place.run(&format!("{arguments} --format json"));
    let lines = run.stdout.lines().map(|line| serde_json::from_str::<Json>(line).unwrap());
    lines.filter(|line| line["type"] == kind).collect()
}

/// Returns the line that the program prints for a finding.
fn line(finding: &Finding) -> Json {
    let [x, y] = finding.position().map_or([None; 2], |point| point.map(Some));
    let trace = finding.trace().into_iter().map(
        |step| json!({ "file": step.file, "path": step.path, "x": step.position[0], "y": step.position[1] }),
    );
    let span = finding
        .text()
        .zip(finding.span())
        .map(|(text, span)| [span.start, span.end].map(|end| text[..end].chars().count()));
    json!({
        "type": "finding",
        "code": finding.code(),
        "name": finding.name(),
        "severity": if finding.is_error() { "error" } else { "warning" },
        "message": finding.message(Lang::En),
        "help": finding.help(Lang::En),
        "notes": finding.notes(Lang::En),
        "file": finding.file(),
        "line": finding.line(),
        "path": finding.path(),
        "layer": finding.layer(),
        "handle": finding.handle(),
        "entity": finding.entity(),
        "x": x,
        "y": y,
        "text": finding.text(),
        "span": span,
        "trace": trace.collect::<Vec<_>>(),
    })
}

fn lines(findings: &[Finding]) -> Vec<Json> {
    findings.iter().map(line).collect()
}

#[test]
fn check_and_the_library_have_the_same_findings() {
    let place = example();
    let library = Library::open(place.path()).unwrap();
    for inputs in ["", "mistakes", "projects/8001.1P.dxf", "3003.1P"] {
        let arguments: Vec<&str> = inputs.split_whitespace().collect();
        let report = library.check(&arguments).unwrap();
        assert_eq!(lines(&report.findings), rows(&place, "finding", &format!("check {inputs}")), "{inputs}");
        let [summary] = &*rows(&place, "summary", &format!("check {inputs}")) else { panic!("one summary") };
        assert_eq!(
            (&json!(report.paths), &json!(report.drawings)),
            (&summary["paths"], &summary["drawings"])
        );
    }
    assert!(library.check(&["mistakes"]).unwrap().findings.len() > 10);
}

/// Entries of the baseline have the same effect as in the program: they hold until their last day. The library knows no date but the one that it is
/// given.
#[test]
fn accepted_findings_are_those_of_the_program() {
    const ACCEPT: &str = "check --accept PB203 --reason known --until 2031-12-31 mistakes";
    let place = example();
    let all = Library::open(place.path()).unwrap().check(&["mistakes"]).unwrap().findings;
    let code = all[0].code();
    assert_eq!(place.run(&ACCEPT.replace("PB203", &code)).status, Some(0));
    for (date, is_held) in [(Some("2031-12-31"), true), (Some("2032-01-01"), false), (None, false)] {
        let options = date.map_or_else(LibraryOptions::new, |date| LibraryOptions::new().date(date));
        let report = options.open(place.path()).unwrap().check(&["mistakes"]).unwrap();
        assert!(report.accepted.iter().all(|finding| finding.code() == code), "{report:?}");
        assert_eq!(report.accepted.is_empty(), !is_held);
        assert_eq!(report.findings.len() + report.accepted.len(), all.len());
        if let Some(date) = date {
            let arguments = format!("check mistakes --date {date}");
            assert_eq!(lines(&report.findings), rows(&place, "finding", &arguments));
            assert_eq!(report.accepted.len(), rows(&place, "waived", &arguments).len());
        }
    }
    assert!(LibraryOptions::new().date("soon").open(place.path()).is_err());
    let place = place.file("pathbuild-baseline.txt", "no fingerprint\n");
    assert!(Library::open(place.path()).unwrap().check(&[]).is_err());
}

#[test]
fn list_and_the_library_have_the_same_figures() {
    let place = example();
    let library = Library::open(place.path()).unwrap();
    for inputs in ["", "mistakes", "80*"] {
        let arguments: Vec<&str> = inputs.split_whitespace().collect();
        let listing = library.paths(&arguments).unwrap();
        let listed = rows(&place, "path", &format!("list {inputs}"));
        assert_eq!(listing.paths.len(), listed.len());
        for (path, row) in listing.paths.iter().zip(listed) {
            let errors = path.findings.iter().filter(|finding| finding.is_error()).count();
            let [x, y, z] = path.cutting_box.map(|ends| ends.map(|(low, high)| [low, high]));
            let expected = json!({
                "path": path.name, "file": path.file, "material": path.material, "thickness": path.thickness,
                "tool": path.tool, "cutting_box": { "x": x, "y": y, "z": z }, "length": path.length,
                "minutes": path.minutes, "errors": errors, "warnings": path.findings.len() - errors,
            });
            for (key, value) in expected.as_object().unwrap() {
                assert_eq!(&row[key], value, "{key} of {}", path.name);
            }
        }
        assert_eq!(lines(&listing.findings), rows(&place, "finding", &format!("list {inputs}")));
    }
}

#[test]
fn emit_verify_and_the_library_write_and_check_the_same_programs() {
    let place = example();
    let library = Library::open(place.path()).unwrap();
    let written = rows(&place, "output", "emit");
    let report = library.emit(&[], &EmitOptions::new().compare()).unwrap();
    let names = |row: &Json| (row["file"].clone(), row["path"].clone());
    let files = report.files.iter().map(|file| (json!(file.file), json!(file.path)));
    assert_eq!(files.collect::<Vec<_>>(), written.iter().map(names).collect::<Vec<_>>());
    assert!(report.files.iter().all(|file| file.state == FileState::Current), "{report:?}");
    assert_eq!(lines(&report.findings), rows(&place, "finding", "emit --check"));
    let options = VerifyOptions::new().require("feeds");
    let verified = library.verify(&["gcode"], &options).unwrap();
    let arguments = "verify gcode --require feeds";
    assert_eq!(lines(&verified.findings), rows(&place, "finding", arguments));
    let [summary] = &*rows(&place, "summary", arguments) else { panic!("one summary") };
    let checks = |program: &pathbuild_api::VerifiedProgram| {
        let state = |state| match state {
            CheckState::Made => "made",
            CheckState::Assumed => "assumed",
            _ => "not-made",
        };
        program.checks.iter().map(|check| (json!(check.name), json!(state(check.state)))).collect::<Vec<_>>()
    };
    let records = summary["checks"].as_array().unwrap();
    assert_eq!((records.len(), verified.programs.len()), (8, 8));
    for (program, record) in verified.programs.iter().zip(records) {
        let known = record["checks"].as_array().unwrap();
        let known = known.iter().map(|check| (check["check"].clone(), check["outcome"].clone()));
        assert_eq!(checks(program), known.collect::<Vec<_>>(), "{}", program.file);
    }
}

/// The edges of the library's graph are the pairs of paths in the program's graph.
#[test]
fn the_graph_of_the_library_is_that_of_the_program() {
    let place = example();
    let library = Library::open(place.path()).unwrap();
    for (command, report) in
        [("deps 8001.1P", library.embedded(&["8001.1P"])), ("rdeps 2050.1P", library.embedders(&["2050.1P"]))]
    {
        let report = report.unwrap();
        let [graph] = &*rows(&place, "graph", command) else { panic!("one graph") };
        let paths = &graph["paths"];
        let end = |index: &Json| {
            let path = &paths[usize::try_from(index.as_u64().unwrap()).unwrap()];
            (path["file"].clone(), path["path"].clone())
        };
        let edges = graph["embeddings"].as_array().unwrap().iter().filter(|edge| !edge["to"].is_null());
        let mut known: Vec<_> = edges.map(|edge| (end(&edge["from"]), end(&edge["to"]))).collect();
        let order = |pair: &((Json, Json), (Json, Json))| format!("{pair:?}");
        known.sort_by_key(order);
        known.dedup();
        let mut found: Vec<_> = report
            .edges
            .iter()
            .map(|edge| {
                let embedded = (json!(edge.embedded_file), json!(edge.embedded_path));
                ((json!(edge.file), json!(edge.path)), embedded)
            })
            .collect();
        found.sort_by_key(order);
        assert!(!found.is_empty(), "{command}");
        assert_eq!(found, known, "{command}");
        assert_eq!(lines(&report.findings), rows(&place, "finding", command));
    }
}
