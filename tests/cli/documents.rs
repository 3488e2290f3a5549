//! Tests machine-readable output: every command prints a single document on stdout and nothing else. Also tests reports and file names.
//! (book: reference/output)

use insta::assert_snapshot;
use serde_json::Value;

use crate::support::{Place, Run, runs};

const LIBRARY: &str = r#"
== work/pathbuild.toml ==
feed = 100
rapid = 1000
sweep-height = 20
library = ["parts"]
== work/parts/1234.1P.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I5 B0 MPlate"
mill 0,0 40,0
end 40,0
== work/parts/1235.1P.dxf ==
layer 1235.1P
start 0,0 "T5 O2 I5 B9 MPlate"
mill 0,0 40,0
end 40,0
== work/parts/8001.1P.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
end 40,0
"#;

/// Creates a repository that contains pathbuild's directory.
fn place() -> Place {
    Place::of(LIBRARY).file(".git/HEAD", "ref: refs/heads/main\n")
}

fn run(place: &Place, line: &str) -> Run {
    place.run_in("work", &line.split_whitespace().collect::<Vec<_>>())
}

const COMMANDS: [&str; 27] = [
    "check",
    "check 1235.1P --lang de",
    "check nothing.dxf",
    "check --feed x",
    "emit 8001.1P",
    "emit . --check",
    "emit 1234.1P --check",
    "list",
    "stats",
    "diff . parts",
    "where 1234.1P",
    "graph",
    "deps 8001.1P",
    "rdeps 1234.1P",
    "why",
    "q-project parts/1234.1P.dxf",
    "import parts/8001.1P_Milling.gcode",
    "verify parts/8001.1P_Milling.gcode --against 8001.1P",
    "post list",
    "post parts/8001.1P_Milling.gcode --post grbl -o grbl.nc",
    "config show",
    "cache size",
    "cache verify",
    "cache dir",
    "view 1234.1P -o a.svg",
    "sheet 1234.1P -o sheet.svg",
    "texts",
];

#[test]
fn json_of_every_command_is_as_the_schema_says() {
    let schema: Value = serde_json::from_str(include_str!("../../docs/schemas/output.json")).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    let place = place();
    for line in COMMANDS {
        let run = run(&place, &format!("{line} --format json"));
        let objects: Vec<Value> = run.stdout.lines().map(|it| serde_json::from_str(it).unwrap()).collect();
        for object in &objects {
            let errors: Vec<_> = schema.iter_errors(object).map(|error| error.to_string()).collect();
            assert_eq!(errors, Vec::<String>::new(), "{line}: {object}");
        }
        let types: Vec<&str> = objects.iter().map(|it| it["type"].as_str().unwrap()).collect();
        assert!(types.len() >= 2, "{run}");
        assert_eq!((types[0], types[types.len() - 1]), ("header", "summary"), "{run}");
        assert!(
            !types[1..types.len() - 1].contains(&"header") && !types[..types.len() - 1].contains(&"summary")
        );
        assert_eq!(objects[objects.len() - 1]["exit_status"], run.status.unwrap(), "{run}");
        let errors = objects.iter().filter(|it| it["severity"] == "error").count();
        assert_eq!(objects[objects.len() - 1]["errors"], errors, "{run}");
    }
}

#[test]
fn other_formats_are_one_document_of_findings() {
    let sarif: Value = serde_json::from_str(include_str!("schemas/sarif-2.1.0.json")).unwrap();
    let sarif = jsonschema::validator_for(&sarif).unwrap();
    let place = place();
    for line in COMMANDS {
        let of = |format: &str| run(&place, &format!("{line} --format {format}"));
        let text = of("sarif").stdout;
        let json: Value =
            serde_json::from_str(&text).unwrap_or_else(|error| panic!("{line}: {error}\n{text}"));
        assert!(sarif.is_valid(&json), "{line}: {text}");
        let issues: Value = serde_json::from_str(&of("gitlab").stdout).unwrap();
        assert!(issues.is_array(), "{line}");
        let junit = of("junit").stdout;
        roxmltree::Document::parse(&junit).unwrap_or_else(|error| panic!("{line}: {error}\n{junit}"));
        let github = of("github").stdout;
        assert!(
            github.lines().all(|it| it.starts_with("::error ") || it.starts_with("::warning ")),
            "{line}: {github}"
        );
    }
}

#[test]
fn every_command_says_what_it_said_in_every_form() {
    let place = place();
    let formats = ["full", "concise", "json", "sarif", "github", "gitlab", "junit"];
    for line in ["check parts/1235.1P.dxf", "emit 1235.1P", "list 1235*", "verify nothing.gcode"] {
        for format in formats {
            let lines = ["en", "de"].map(|lang| format!("{line} --format {format} --lang {lang}"));
            let said = lines
                .iter()
                .map(|line| run(&place, line).to_string().replace(env!("CARGO_PKG_VERSION"), "VERSION"));
            let said: Vec<String> = said.collect();
            assert_snapshot!(said.join("\n"));
        }
    }
}

#[test]
fn files_are_named_from_the_root_of_the_repository() {
    let place = place();
    let named = |line: &str, name: &str| {
        let run = run(&place, line);
        assert!(run.stdout.contains(name), "{run}");
    };
    named("check --format json", r#""file":"work/parts/1235.1P.dxf""#);
    named("check --format github", "file=work/parts/1235.1P.dxf,");
    named("check --format gitlab", r#""path": "work/parts/1235.1P.dxf""#);
    named("check --format sarif", r#""uri": "work/parts/1235.1P.dxf""#);
    named("where 1234.1P --format json", r#""file":"work/parts/1234.1P.dxf""#);
    let concise = run(&place, "check --format concise");
    assert!(concise.stderr.starts_with("parts/1235.1P.dxf:"), "people are where they are: {concise}");
    std::fs::remove_dir_all(place.path().join(".git")).unwrap();
    named("check --format json", r#""file":"parts/1235.1P.dxf""#);
}

#[test]
fn every_command_with_findings_writes_reports() {
    let place = place();
    for line in ["check 1235.1P", "emit 1235.1P", "verify none.gcode", "where none.dxf", "list none"] {
        let run = run(&place, &format!("{line} --report json=../a.json --report junit=../b.xml"));
        assert_eq!(run.status, Some(1), "{run}");
        let json = place.read("a.json");
        assert!(json.starts_with(r#"{"type":"header","schema_version":2"#), "{line}: {json}");
        assert!(
            json.contains(r#""type":"finding""#) && json.trim_end().ends_with(r#""warnings":0}"#),
            "{line}: {json}"
        );
        roxmltree::Document::parse(&place.read("b.xml")).unwrap();
    }
    let run = run(&place, "list --report sarif=-");
    serde_json::from_str::<Value>(&run.stdout).unwrap();
    assert!(run.stderr.contains("1234.1P"), "people read the list elsewhere: {run}");
}

#[test]
fn standard_output_holds_one_document() {
    let lines = [
        "check --format json --report sarif=-",
        "check --report json=- --report sarif=-",
        "emit 1234.1P -o - --report json=-",
        "explain PB203 --format sarif",
        "init --report json=a.json",
        "watch --format sarif",
        "check --report json=a --report sarif=./b/../a",
    ];
    assert_snapshot!(runs(&place(), lines));
    let place = place();
    let printed = run(&place, "emit 1234.1P -o - --format json");
    assert!(
        printed.stdout.starts_with('%') && printed.stderr.starts_with(r#"{"type":"header""#),
        "{printed}"
    );
}

#[test]
fn emit_check_prints_what_is_not_current() {
    let place = place();
    assert_eq!(run(&place, "emit 8001.1P 1234.1P").status, Some(0));
    std::fs::remove_file(place.path().join("work/parts/1234.1P_Milling.gcode")).unwrap();
    let lines = ["emit 8001.1P 1234.1P --check", "emit 8001.1P --check", "emit 8001.1P --check -v --lang de"];
    let said: Vec<String> = lines.iter().map(|line| run(&place, line).to_string()).collect();
    assert_snapshot!(said.join("\n"));
}

/// Creates a drawing with this number of erroneous paths.
fn many(count: usize) -> Place {
    let path = |number: usize| {
        format!(
            "layer {number}.1P\nstart 0,{number} \"T5 O2 I5 B9 MPlate\"\nmill 0,{number} 40,{number}\nend 40,{number}\n"
        )
    };
    let paths: String = (1001..1001 + count).map(path).collect();
    Place::of(&format!("== a.dxf ==\n{paths}"))
}

#[test]
fn many_findings_are_counted_by_code_and_may_be_cut_short() {
    let table = |count| many(count).run("check a.dxf --format concise").stderr;
    let (few, more) = (table(50), table(51));
    assert!(!few.contains("count"), "{few}");
    let last: Vec<&str> = more.lines().rev().take(4).collect();
    assert!(last[3].starts_with("count") || last[2].starts_with("count"), "{more}");
    let run = many(5).run("check a.dxf --format concise --max-errors 2");
    assert_snapshot!(run);
    let json = many(5).run("check a.dxf --format json --max-errors 2");
    assert_eq!(
        json.stdout.matches(r#""type":"finding""#).count(),
        many(5).run("check a.dxf --format json").stdout.matches(r#""type":"finding""#).count()
    );
}
