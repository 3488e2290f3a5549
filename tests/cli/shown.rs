//! Tests untrusted names, layers and texts in every command and format: no output controls a terminal or begins a command of a CI runner.
//! (book: reference/commands)
#![cfg(unix)]

use crate::support::{Place, Run};
use pathbuild_diagnostic::escaping;

const FORMATS: [&str; 9] =
    ["full", "concise", "json", "sarif", "github", "gitlab", "junit", "dot", "mermaid"];

/// A hostile name: a colour, a window title, C1's escape, reversed text, and lines that begin commands of GitHub's and Azure's runners.
const HOSTILE: &str =
    "\u{1b}[31m\u{1b}]0;x\u{7}\u{9b}2J\u{202e}\u{2066}\r\u{2028}\u{85}##[add-mask]b\n::add-mask::e";

/// Returns a drawing with hostile names on layers and line types and in texts: one without an element, faulty parameters and values, and
/// names of missing paths.
fn drawing(path: &str) -> String {
    let hostile = HOSTILE.replace('\n', "\\P").replace('\r', "^M");
    let text = |layer: &str, x: u32, content: &str| {
        format!("0\nTEXT\n8\n{layer}\n10\n{x}\n20\n0\n40\n1\n1\n{content}\n")
    };
    let line = |layer: &str, from: u32, line_type: &str| {
        format!("0\nLINE\n8\n{layer}\n6\n{line_type}\n10\n{from}\n20\n0\n11\n{}\n21\n0\n", from + 100)
    };
    let circle =
        |x: u32, radius: f64| format!("0\nCIRCLE\n8\n{path}\n6\nPHANTOM\n10\n{x}\n20\n0\n40\n{radius}\n");
    let one_line = hostile.replace(['\u{85}', '\u{2028}'], "");
    let entities = [
        circle(0, 0.5),
        text(path, 0, "T5 O2 I1 B0 MX"),
        line(path, 0, "CONTINUOUS"),
        text(path, 40, &format!("X{one_line} F{one_line} N:{one_line}")),
        line(path, 100, "DASHDOT"),
        text(path, 140, &format!(">9999.1P{one_line} E[{one_line} :A{one_line}")),
        line(path, 200, &one_line),
        text(&format!("{path}~{one_line}"), 240, &one_line),
        format!("0\nMTEXT\n8\n{path}\n10\n900\n20\n900\n40\n1\n71\n5\n1\n{hostile}\n"),
        circle(300, 1.0),
    ];
    format!("0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n", entities.concat())
}

fn right_drawing(path: &str) -> String {
    let circle = |x, radius| format!("0\nCIRCLE\n8\n{path}\n6\nPHANTOM\n10\n{x}\n20\n0\n40\n{radius}\n");
    let line = format!("0\nLINE\n8\n{path}\n6\nCONTINUOUS\n10\n0\n20\n0\n11\n100\n21\n0\n");
    let text = format!("0\nTEXT\n8\n{path}\n10\n0\n20\n0\n40\n1\n1\nT5 O2 I1 B0 M{HOSTILE}\n")
        .replace('\r', "")
        .replace("\n::", "");
    format!(
        "0\nSECTION\n2\nENTITIES\n{}{line}{text}{}0\nENDSEC\n0\nEOF\n",
        circle(0, "0.5"),
        circle(100, "1.0")
    )
}

fn place() -> Place {
    Place::new()
        .file("pathbuild.toml", "feed = 150\nrapid = 1000\nsweep-height = 20\nlibrary = [\".\"]\n")
        .file(&format!("a{HOSTILE}/1301.1P.dxf"), drawing("1301.1P"))
        .file(&format!("::stop-commands::{HOSTILE}1302.1P.dxf"), drawing("1302.1P"))
        .file(&format!("::stop-commands::{HOSTILE}1303.1P.dxf"), right_drawing("1303.1P"))
        .file(&format!("##vso[x]{HOSTILE}1304.1P.dxf"), HOSTILE)
        .file(&format!("{HOSTILE}.gcode"), format!("%\n({HOSTILE})\nG0 X{HOSTILE}\nM30\n%\n"))
        .file(&format!("{HOSTILE}_Clean.gcode"), "%\n(a)\nG00 Z20.000\nM30\n%\n")
        .file(&format!("{HOSTILE}_Z.txt"), format!("{HOSTILE}\n"))
        .file("faulty/pathbuild.toml", format!("\"{}\" = 1\nlang = \"{0}\"\n", toml_text()))
        .file("faulty/1305.1P.dxf", right_drawing("1305.1P"))
        .file("baseline.txt", format!("{HOSTILE}\n"))
        .file("post/post.toml", format!("{HOSTILE} = 1"))
}

fn toml_text() -> String {
    HOSTILE
        .chars()
        .map(|c| if c.is_control() { format!("\\u{:04x}", u32::from(c)) } else { c.into() })
        .collect()
}

#[track_caller]
fn assert_harmless(run: &Run, is_github: bool) {
    for text in [&run.stdout, &run.stderr] {
        let acting: Vec<char> = text.chars().filter(|it| *it != '\n' && escaping::is_active(*it)).collect();
        assert!(acting.is_empty(), "{acting:?} in {:?}\n{text:?}", run.arguments);
        assert!(!text.contains("##[") && !text.contains("##vso["), "{:?}\n{text}", run.arguments);
        for line in text.lines() {
            let line = line.trim_start();
            let is_ours = is_github && (line.starts_with("::error ") || line.starts_with("::warning "));
            assert!(!line.starts_with("::") || is_ours, "{:?}\n{text}", run.arguments);
        }
    }
    assert!(matches!(run.status, Some(0..=2)), "{run}");
}

/// Returns every command that reads drawings or programs, with names as arguments and with names found in directories.
fn commands() -> Vec<Vec<String>> {
    let drawings = [
        format!("a{HOSTILE}/1301.1P.dxf"),
        format!("./::stop-commands::{HOSTILE}1302.1P.dxf"),
        format!("./::stop-commands::{HOSTILE}1303.1P.dxf"),
    ];
    let one = |command: &str, arguments: &[&str]| {
        std::iter::once(command).chain(arguments.iter().copied()).map(str::to_owned).collect::<Vec<String>>()
    };
    let mut commands = Vec::new();
    for command in ["check", "emit", "texts", "where", "why", "graph", "deps", "rdeps", "list", "stats"] {
        commands.push(one(command, &["."]));
        commands.push(one(command, &[&drawings[0], &drawings[1], &drawings[2]]));
        commands.push(one(command, &[HOSTILE]));
    }
    commands.push(one("check", &[]));
    commands.push(one("check", &["-v"]));
    commands.push(one("check", &["--baseline", "baseline.txt"]));
    commands.push(one("check", &["--report", &format!("json=no{HOSTILE}/where")]));
    commands.push(one("check", &["faulty"]));
    commands.push(one("check", &["--timings"]));
    commands.push(one("emit", &["--check", "."]));
    commands.push(one("emit", &["--remove-stale", "."]));
    commands.push(one("emit", &["--out-dir", &format!("out{HOSTILE}"), "."]));
    commands.push(one("emit", &["--post", "linuxcnc", "."]));
    commands.push(one("emit", &["--post", "post/post.toml", "."]));
    commands.push(one("emit", &["--post", HOSTILE, "."]));
    commands.push(one("q-project", &[&drawings[0]]));
    commands.push(one("q-project", &[&drawings[2]]));
    let program = format!("{HOSTILE}.gcode");
    commands.push(one("import", &[&program]));
    commands.push(one("verify", &[&program]));
    commands.push(one("verify", &[&program, "--against", HOSTILE]));
    commands.push(one("post", &[&program, "--post", "linuxcnc", "-o", &format!("{HOSTILE}.ngc")]));
    commands.push(one("adjust", &[HOSTILE, "--max-correction", "1", "--show", "."]));
    commands.push(one("explain", &[HOSTILE]));
    commands.push(one("config", &["show", "--origin"]));
    commands.push(one("cache", &["dir"]));
    commands.push(one("cache", &["verify"]));
    commands.push(one(HOSTILE, &[]));
    commands.push(one("check", &[&format!("--{HOSTILE}")]));
    commands
}

#[test]
fn hostile_names_act_on_nobody() {
    let place = place();
    for command in commands() {
        let arguments: Vec<&str> = command.iter().map(String::as_str).collect();
        for format in FORMATS {
            let run = place.run_with(&[&arguments[..], &["--format", format]].concat());
            assert_harmless(&run, format == "github");
        }
        assert_harmless(&place.run_with(&[&arguments[..], &["--lang", "de"]].concat()), false);
    }
}

/// Machine-readable output stays valid and contains the exact names.
#[test]
fn json_of_hostile_names_is_whole() {
    let place = place();
    let run = place.run("check . --format json");
    let files: Vec<String> = run
        .stdout
        .lines()
        .map(|line| serde_json::from_str::<serde_json::Value>(line).unwrap())
        .filter_map(|object| object["file"].as_str().map(str::to_owned))
        .collect();
    assert!(files.iter().any(|file| *file == format!("a{HOSTILE}/1301.1P.dxf")), "{files:?}");
    for format in ["sarif", "gitlab"] {
        let run = place.run(&format!("check . --format {format}"));
        serde_json::from_str::<serde_json::Value>(&run.stdout).unwrap();
    }
    let run = place.run("check . --format junit");
    roxmltree::Document::parse(&run.stdout).unwrap();
}

/// Reports in files contain no characters with special effects, because other programs display them.
#[test]
fn reports_of_hostile_names_act_on_nobody() {
    for format in ["full", "concise", "json", "sarif", "gitlab", "junit", "html"] {
        let place = place();
        let run = place.run(&format!("check . --report {format}=report"));
        let report = Run { stdout: place.read("report"), ..run };
        assert_harmless(&report, false);
    }
    let place = place();
    let run = place.run("check . --baseline known --update-baseline");
    assert_harmless(&Run { stdout: place.read("known"), ..run }, false);
}

/// Pictures, pages and scenes contain no characters with special effects.
#[test]
fn what_is_seen_of_hostile_names_acts_on_nobody() {
    let place = place();
    let drawing = format!("./::stop-commands::{HOSTILE}1303.1P.dxf");
    for output in ["seen.json", "seen.svg", "seen.html"] {
        let run = place.run_with(&["view", &drawing, "-o", output]);
        assert_harmless(&run, false);
        // The page's own script is left out of the comparison.
        let text = place.read(output).replace(pathbuild_view::SCRIPT, "");
        let acting: Vec<char> =
            text.chars().filter(|it| !matches!(it, '\n' | '\t') && escaping::is_active(*it)).collect();
        assert!(
            acting.is_empty() && !text.contains("##[") && text.contains("1303.1P"),
            "{output}: {acting:?}"
        );
    }
}

/// Texts from drawings never become links, numbers, mentions or directives.
#[test]
fn graphs_hold_no_directive_of_mermaid() {
    let place = Place::new().file("%%{init: {}}%%1303.1P.dxf", right_drawing("1303.1P"));
    let run = place.run("graph . --format mermaid");
    assert!(run.stdout.contains("#37;#37;{init") && !run.stdout.contains("%%"), "{run}");
}

/// The displayed configuration is equivalent TOML.
#[test]
fn a_shown_configuration_says_the_same() {
    let text = "\u{e0041}b\\c ##[d]";
    let configuration = format!("[macros]\na = '{text}'\n");
    let place = Place::new().file("a\nfeed = 9 #/pathbuild.toml", configuration);
    let run = place.run_with(&["config", "show", "--config", "a\nfeed = 9 #/pathbuild.toml"]);
    assert_harmless(&run, false);
    let table: toml::Table = run.stdout.parse().unwrap();
    assert_eq!(table["macros"]["a"].as_str(), Some(text), "{run}");
    assert!(!table.contains_key("feed"), "{run}");
}
