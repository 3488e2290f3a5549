//! Tests that the program prints about the example library what the fields of `pathbuild-api` contain. The program runs in the library's directory,
//! with its configuration and a cache; the tests open the library by its directory.

use std::fs;

use pathbuild_api::{
    BaselineOptions, CheckOptions, CheckState, EmitOptions, Error, FileState, Finding, Lang, Library,
    LibraryOptions, ListOptions, OutputFile, ProgramState, VerifyOptions,
};
use pathbuild_testkit::sheet;
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

/// Returns the lines of this type in the program's document, which is on stderr if a program is on stdout.
fn rows(place: &Place, kind: &str, arguments: &str) -> Vec<Json> {
    let run = place.run(&format!("{arguments} --format json"));
    let is_printed = arguments.ends_with("-o -");
    let document = if is_printed { run.stderr } else { run.stdout };
    // Besides the document, stderr contains lines about the status of the run.
    let lines = document.lines().filter(|line| !is_printed || line.starts_with('{'));
    let lines = lines.map(|line| serde_json::from_str::<Json>(line).unwrap());
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

/// Entries of the baseline have the same effect as on the command line: they apply up to and including their last day. The library never uses the
/// current date, only the one in its options.
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
            let waived = report.accepted.iter().map(|finding| {
                let mut waived = line(finding);
                waived["type"] = json!("waived");
                waived["reason"] = json!(finding.reason());
                waived["until"] = json!(finding.until());
                waived
            });
            assert_eq!(waived.collect::<Vec<_>>(), rows(&place, "waived", &arguments));
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
    assert_eq!(place.run("emit 8001.1P 2050.1P").status, Some(0));
    for (inputs, post) in [("", ""), ("mistakes", ""), ("80*", ""), ("80*", "grbl")] {
        let arguments: Vec<&str> = inputs.split_whitespace().collect();
        let (options, more) = match post {
            "" => (ListOptions::new(), String::new()),
            post => (ListOptions::new().post(post), format!(" --post {post}")),
        };
        let listing = library.paths_with(&arguments, &options).unwrap();
        let listed = rows(&place, "path", &format!("list {inputs}{more}"));
        assert_eq!(listing.paths.len(), listed.len());
        for (path, row) in listing.paths.iter().zip(listed) {
            let errors = path.findings.iter().filter(|finding| finding.is_error()).count();
            let [x, y, z] = path.cutting_box.map(|ends| ends.map(|(low, high)| [low, high]));
            let expected = json!({
                "path": path.name, "file": path.file, "material": path.material, "thickness": path.thickness,
                "tool": path.tool, "cutting_box": { "x": x, "y": y, "z": z }, "length": path.length,
                "minutes": path.minutes, "errors": errors, "warnings": path.findings.len() - errors,
                "program": match path.program {
                    ProgramState::Current => json!("current"),
                    ProgramState::Stale => json!("stale"),
                    _ => Json::Null,
                },
            });
            for (key, value) in expected.as_object().unwrap() {
                assert_eq!(&row[key], value, "{key} of {}", path.name);
            }
        }
        assert_eq!(lines(&listing.findings), rows(&place, "finding", &format!("list {inputs}{more}")));
    }
}

/// The library and the program write the same baseline.
#[test]
fn the_library_writes_baselines() {
    let [by_program, by_library] = [example(), example()];
    let library = LibraryOptions::new().date("2026-01-01").open(by_library.path()).unwrap();
    let check = |baseline: BaselineOptions| {
        library.check_with(&["mistakes"], &CheckOptions::new().baseline(baseline)).unwrap()
    };
    let found = check(BaselineOptions::new()).findings;
    let code = found[0].code();
    let accept =
        format!("check mistakes --accept {code} --reason known --until 2031-12-31 --date 2026-01-01");
    let update = "check mistakes --baseline pathbuild-baseline.txt --update-baseline";
    for (arguments, baseline) in [
        (&*accept, BaselineOptions::new().accept(&code, "known", Some("2031-12-31"))),
        (update, BaselineOptions::new().file("pathbuild-baseline.txt").update()),
    ] {
        let run = by_program.run(arguments);
        assert_eq!(run.status, Some(0), "{}", run.stderr);
        let report = check(baseline);
        assert!(report.findings.is_empty() && report.accepted.is_empty(), "{report:?}");
        let written = report.baseline.unwrap();
        assert_eq!(std::path::Path::new(&written.file), by_library.path().join("pathbuild-baseline.txt"));
        assert!(
            run.stderr.contains(&format!("pathbuild-baseline.txt: {} ", written.findings)),
            "{}",
            run.stderr
        );
        let texts = [&by_program, &by_library].map(|place| place.read("pathbuild-baseline.txt"));
        assert_eq!(texts[0], texts[1]);
    }
    assert_eq!(check(BaselineOptions::new()).accepted.len(), found.len());
    for refused in [
        BaselineOptions::new().accept("PB9999", "known", None),
        BaselineOptions::new().accept("PB001", "known", None),
        BaselineOptions::new().accept(&code, " ", None),
        BaselineOptions::new().accept(&code, "known", Some("soon")),
        BaselineOptions::new().accept(&code, "known", Some("2025-12-31")),
    ] {
        let result = library.check_with(&["mistakes"], &CheckOptions::new().baseline(refused));
        assert!(matches!(result, Err(Error::Refused(_))), "{result:?}");
    }
    let missing = CheckOptions::new().baseline(BaselineOptions::new().file("missing.txt"));
    assert!(matches!(library.check_with(&["mistakes"], &missing), Err(Error::Baseline(_))));
}

/// A program need not be in a file. Errors of the drawing to compare with are returned as an error of the call, and not as findings of the program.
#[test]
fn a_text_is_verified() {
    let place = example();
    let library = Library::open(place.path()).unwrap();
    let text = place.run("emit 8001.1P -o -").stdout;
    let name = "8001.nc";
    let options = VerifyOptions::new().text(name, text.clone().into_bytes()).against("8001.1P");
    let report = library.verify(&[], &options).unwrap();
    let place = place.file(name, text);
    let run = place.run(&format!("verify {name} --against 8001.1P"));
    let [program] = &*report.programs else { panic!("{report:?}") };
    let comparison = program.comparison.as_ref().unwrap();
    assert!(run.stderr.contains(&format!("read as {}", comparison.read_as)), "{}", run.stderr);
    assert!(run.stderr.contains(&format!("{name}: {}", program.summary)), "{}", run.stderr);
    assert_eq!(comparison.equal, comparison.moves);
    assert!(matches!(library.verify(&[name], &options.clone().post("nothing")), Err(Error::Post(_))));
    let Err(Error::Findings(found)) = library.verify(&[name], &options.against("8001.9P")) else {
        panic!("there is no such path")
    };
    assert_eq!(lines(&found), rows(&place, "finding", &format!("verify {name} --against 8001.9P")));
    // Nothing was verified, so no baseline can make that a success.
    let update = format!("verify {name} --against 8001.9P --baseline known.txt --update-baseline");
    assert_eq!(place.run(&update).status, Some(1));
    assert!(!place.path().join("known.txt").exists());
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
        let row = |check: &pathbuild_api::ProgramCheck| {
            let mut row = json!({ "check": check.name, "outcome": state(check.state) });
            let is_made = check.state != CheckState::NotMade;
            row[if is_made { "with" } else { "reason" }] = json!(check.detail);
            if let Some(advice) = &check.advice {
                row["option"] = json!(advice);
            }
            row
        };
        program.checks.iter().map(row).collect::<Vec<_>>()
    };
    let records = summary["checks"].as_array().unwrap();
    assert_eq!((records.len(), verified.programs.len()), (8, 8));
    for (program, record) in verified.programs.iter().zip(records) {
        assert_eq!(json!(checks(program)), record["checks"], "{}", program.file);
    }
}

/// Returns a library of two paths; a spline on the layer of the first one is not milled.
fn two_paths() -> Place {
    let dxf = |name: &str, more: &str| {
        let text = format!("layer {name}\nstart 0,0 \"T5 O2 I1 B0 MPlate\"\nmill 0,0 40,0\n{more}end 40,0\n");
        sheet(&text).unwrap().to_dxf()
    };
    let configuration =
        "library = [\"\"]\nfeed = 100\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n";
    Place::new()
        .file("pathbuild.toml", configuration)
        .file("1234.1P.dxf", dxf("1234.1P", "spline CONTINUOUS control 10,10 15,20 25,10 30,20\n"))
        .file("1235.1P.dxf", dxf("1235.1P", ""))
        .file(
            "copy.cbpp",
            "<PostProcessor><PostBuildCommand>/bin/cp</PostBuildCommand><PostBuildCommandArgs>{$outfile} \"a copy.nc\"</PostBuildCommandArgs></PostProcessor>",
        )
}

/// Every option of `emit` has the same effect in the library: on the files, and on what is reported about them.
#[test]
fn emit_and_the_library_have_the_same_options() {
    let [by_program, by_library] = [two_paths(), two_paths()];
    let library = LibraryOptions::new().cache(by_library.cache()).open(by_library.path()).unwrap();
    let options = EmitOptions::new;
    let cases = [
        ("1234.1P 1235.1P", options()),
        ("1234.1P 1235.1P --force", options().force()),
        ("1234.1P --check", options().compare()),
        ("1234.1P --check --moves", options().compare_moves()),
        ("1234.1P 1235.1P --check --post grbl", options().compare().post("grbl")),
        ("1234.1P -o -", options().print()),
        (
            "1234.1P 1235.1P --post grbl --join plate --deps out.d",
            options().post("grbl").join("plate").deps("out.d"),
        ),
        (
            "1235.1P --post copy.cbpp --dialect linuxcnc --date 2026-01-02",
            options().post("copy.cbpp").dialect("linuxcnc").date("2026-01-02"),
        ),
    ];
    for (arguments, options) in cases {
        let paths: Vec<&str> = arguments.split_whitespace().take_while(|word| word.ends_with('P')).collect();
        let report = library.emit(&paths, &options).unwrap();
        let stderr = by_program.run(&format!("emit {arguments}")).stderr;
        // The command has already been run, so the files that it wrote are now unchanged.
        let known = rows(&by_program, "output", &format!("emit {arguments}"));
        let state = |file: &OutputFile| match file.state {
            FileState::Written | FileState::Unchanged => "unchanged",
            FileState::Current => "current",
            FileState::Outdated => "stale",
            FileState::Missing => "missing",
            _ => "printed",
        };
        let row = |file: &OutputFile| {
            let (length, minutes) =
                (file.is_program.then_some(file.length), file.is_program.then_some(file.minutes));
            json!({
                "type": "output", "file": file.file, "path": file.path, "state": state(file), "length": length, "minutes": minutes,
            })
        };
        assert_eq!(report.files.iter().map(row).collect::<Vec<_>>(), known, "{arguments}");
        for file in report.files.iter().filter(|file| file.state == FileState::Written) {
            assert_eq!(by_library.read(&file.file), by_program.read(&file.file), "{arguments}");
        }
        let left_out =
            report.left_out.iter().map(|left| format!("{} {} ({})", left.count, left.entity, left.path));
        let left_out: Vec<String> = left_out.collect();
        let shown = stderr.lines().filter_map(|line| line.strip_prefix("not milled: "));
        assert_eq!(shown.collect::<Vec<_>>(), left_out, "{arguments}");
        assert!(report.notes.iter().all(|note| stderr.contains(note)), "{arguments}: {stderr}");
        let printed = report.files.iter().find_map(|file| file.text.clone());
        assert_eq!(printed.is_some(), arguments.ends_with("-o -"));
        if let Some(text) = printed {
            assert_eq!(String::from_utf8(text).unwrap(), by_program.run(&format!("emit {arguments}")).stdout);
        }
    }
    assert_eq!(by_library.read("out.d"), by_program.read("out.d"));
    assert!(matches!(library.emit(&["1234.1P"], &options().date("soon")), Err(Error::Refused(_))));
    assert!(matches!(library.emit(&["1234.1P"], &options().post("nothing")), Err(Error::Post(_))));
}

/// The library runs no command: it names what the post-processor requests.
#[test]
fn commands_of_posts_are_named() {
    let place = two_paths();
    let library = Library::open(place.path()).unwrap();
    let options = EmitOptions::new().post("copy.cbpp").dialect("linuxcnc");
    assert_eq!(library.emit(&["1235.1P"], &options).unwrap().post_builds, []);
    let report = library.emit(&["1235.1P"], &options.clone().post_builds()).unwrap();
    let [build] = &*report.post_builds else { panic!("{report:?}") };
    assert_eq!((&*build.command[0], &build.file), ("/bin/cp", &report.files[0].file));
    assert!(!place.path().join("a copy.nc").exists());
    assert_eq!(library.emit(&["1235.1P"], &options.compare().post_builds()).unwrap().post_builds, []);
}

#[test]
fn stale_programs_are_removed_on_request() {
    let place = two_paths();
    let library = Library::open(place.path()).unwrap();
    let options = EmitOptions::new();
    let written = library.emit(&["."], &options).unwrap().files;
    fs::remove_file(place.path().join("1235.1P.dxf")).unwrap();
    library.refresh().unwrap();
    let stale = &written.iter().find(|file| file.path == "1235.1P").unwrap().file;
    assert_eq!(library.emit(&["."], &options).unwrap().removed, Vec::<String>::new());
    assert!(place.path().join(stale).exists());
    assert_eq!(library.emit(&["."], &options.remove_stale()).unwrap().removed, std::slice::from_ref(stale));
    assert!(!place.path().join(stale).exists());
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
