//! Tests the output of `check`: streams, formats, reports, baseline, summary, exit status. The findings themselves are tested elsewhere.
//! (book: reference/commands)

use std::fs;

use crate::support::{Place, Run};
use insta::assert_snapshot;
use pathbuild_testkit::sheet;

const GOOD: &str = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n";
const WARNED: &str = "layer 1235.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 20,0 40,0\nturn 20,0\nend 40,0\n";
const WRONG: &str = "layer 1236.1P\nstart 0,0 \"T5 O2 I1\"\nmill 0,0 40,0 \"B6\"\nend 40,0\n";

fn dxf(text: &str) -> Vec<u8> {
    sheet(text).expect("a drawing").to_dxf()
}

/// Creates a library of three drawings: one correct, one with a warning, one with an error.
fn library() -> Place {
    Place::new()
        .file("pathbuild.toml", "library = [\"parts\"]")
        .file("parts/1234.1P.dxf", dxf(GOOD))
        .file("parts/1235.1P.dxf", dxf(WARNED))
        .file("parts/1236.1P.dxf", dxf(WRONG))
}

/// Returns the output without its duration, which varies.
fn timeless(run: &Run) -> String {
    let lines = run.to_string();
    let line = |line: &str| match line.rsplit_once(" (") {
        Some((before, after)) if after.ends_with(" s)") => format!("{before} (TIME)"),
        _ => line.to_owned(),
    };
    lines.lines().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_check_ends_with_one_line() {
    assert_snapshot!(timeless(&library().run("check")));
    assert_snapshot!(timeless(&library().run("check --lang de --format concise")));
}

/// Directories with ignore files are walked in a different way, which must give drawings the same names.
#[test]
fn drawings_are_named_alike_with_and_without_rules() {
    let (plain, ruled) = (library(), library().file("parts/.ignore", "nothing\n"));
    for directory in [".", "parts", "./parts/", "parts/../parts"] {
        let run =
            |place: &Place| timeless(&place.run(&format!("check --no-cache --format concise {directory}")));
        let found = run(&plain);
        assert!(found.lines().any(|line| line.starts_with("parts/1236.1P.dxf:")), "{found}");
        assert_eq!(run(&ruled), found);
    }
}

#[test]
fn the_status_is_that_of_the_worst_finding() {
    let place = library();
    let status = |arguments: &str| place.run(&format!("check {arguments}")).status;
    assert_eq!(status("parts/1234.1P.dxf"), Some(0));
    assert_eq!(status("parts/1235.1P.dxf"), Some(0));
    assert_eq!(status("parts/1234.1P.dxf --error-on-warning"), Some(0));
    assert_eq!(status("parts/1235.1P.dxf --error-on-warning"), Some(1));
    assert_eq!(status("parts/1236.1P.dxf"), Some(1));
    assert_eq!(status(""), Some(1));
}

#[test]
fn machine_formats_are_the_result_and_the_others_are_not() {
    let place = library();
    for format in ["json", "sarif", "github", "gitlab", "junit"] {
        let run = place.run(&format!("check --format {format}"));
        assert!(run.stdout.contains("PB203"), "{run}");
        assert!(!run.stderr.contains("PB203"), "{run}");
    }
    for format in ["full", "concise"] {
        let run = place.run(&format!("check --format {format}"));
        assert_eq!(run.stdout, "");
        assert!(run.stderr.contains("PB203"), "{run}");
    }
}

#[test]
fn quiet_leaves_out_the_summary_and_quieter_the_diagnostics() {
    let place = library();
    let normal = place.run("check");
    let quiet = place.run("check -q");
    assert!(
        normal.stderr.starts_with(&quiet.stderr)
            && normal.stderr.lines().count() == quiet.stderr.lines().count() + 1,
        "{quiet}"
    );
    let silent = place.run("check -qq");
    assert_eq!((silent.status, silent.stdout.as_str(), silent.stderr.as_str()), (Some(1), "", ""));
    assert!(place.run("check -qq --format json").stdout.contains("PB203"), "results are always printed");
}

#[test]
fn several_reports_are_written_beside_what_is_printed() {
    let place = library();
    let run = place
        .run("check --report json=a.json --report sarif=b.sarif --report concise=c.txt --report full=d.txt");
    assert!(run.stderr.contains("PB203") && run.stdout.is_empty(), "{run}");
    assert_eq!(place.read("a.json"), place.run("check --format json").stdout);
    assert_eq!(place.read("b.sarif"), place.run("check --format sarif").stdout);
    assert_eq!(place.read("c.txt").lines().count(), 2);
    assert!(place.read("d.txt").contains("×"));
}

#[test]
fn a_report_that_cannot_be_written_is_an_error() {
    let run = library().run("check parts/1234.1P.dxf -q --format concise --report json=none/a.json");
    assert_snapshot!(run);
}

#[test]
fn a_report_replaces_an_older_one_and_leaves_nothing_beside() {
    let place = library().file("a.json", "old");
    assert_eq!(place.run("check --no-cache --report json=a.json").status, Some(1));
    assert!(place.read("a.json").starts_with('{'));
    let left: Vec<_> = place.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 3, "{left:?}");
}

#[test]
fn a_baseline_holds_back_what_is_known() {
    let place = library();
    let written = place.run("check --baseline known.txt --update-baseline");
    assert_snapshot!(written);
    assert_snapshot!(place.read("known.txt"));
    let checked = place.run("check --baseline known.txt --error-on-warning");
    assert_snapshot!(timeless(&checked));
    let place = place.file("parts/1237.1P.dxf", dxf(&WRONG.replace("1236", "1237")));
    let run = place.run("check --baseline known.txt --format json");
    assert_eq!((run.status, run.stdout.matches(r#""type":"finding""#).count()), (Some(1), 1), "{run}");
    assert!(run.stdout.contains("1237.1P"), "{run}");
}

#[test]
fn a_baseline_survives_a_move_and_a_save_but_not_another_fault() {
    let place = library();
    assert_eq!(place.run("check --baseline known.txt --update-baseline").status, Some(0));
    let moved = place.file("parts/sub/1236.1P.dxf", dxf(&format!("version R2010\nlineends lf\n{WRONG}")));
    fs::remove_file(moved.path().join("parts/1236.1P.dxf")).unwrap();
    assert_eq!(moved.run("check parts/sub/1236.1P.dxf --baseline known.txt").status, Some(0));
    let other = moved.file("parts/1236.1P.dxf", dxf(&WRONG.replace("B6", "B7")));
    assert_eq!(other.run("check --baseline known.txt").status, Some(1));
}

#[test]
fn a_baseline_that_is_missing_or_broken_is_wrong_usage() {
    let place = library()
        .file("broken.txt", "# remark\n\n0123456789abcdef0123456789abcdef fine\n012 not\nnone at all\n");
    assert_snapshot!(place.run("check --baseline none.txt"));
    assert_snapshot!(place.run("check --baseline broken.txt"));
}

#[test]
fn severities_of_the_configuration_decide_over_the_status() {
    let place = library().file("pathbuild.toml", "library = [\"parts\"]\n[severity]\nPB114 = \"error\"\n");
    assert_eq!(place.run("check parts/1235.1P.dxf").status, Some(1));
    let place = place.file("pathbuild.toml", "library = [\"parts\"]\n[severity]\nPB114 = \"ignore\"\n");
    let run = place.run("check parts/1235.1P.dxf --error-on-warning");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(run.stderr.contains("no errors, no warnings"), "{run}");
}

#[test]
fn severities_for_some_drawings_hold_wherever_the_run_begins() {
    let text = "library = [\"parts\"]\n[[severity-in]]\nfiles = [\"parts/*\"]\nPB114 = \"ignore\"\n";
    let place = library().file("pathbuild.toml", text);
    let status = |directory: &str, drawing: &str| {
        place.run_in(directory, &["check", drawing, "--error-on-warning"]).status
    };
    assert_eq!(status(".", "parts/1235.1P.dxf"), Some(0));
    assert_eq!(status("parts", "1235.1P.dxf"), Some(0));
    assert_eq!(status("parts", "../parts/1235.1P.dxf"), Some(0));
    let place = place.file("1235.1P.dxf", dxf(WARNED));
    assert_eq!(place.run("check ./1235.1P.dxf --error-on-warning").status, Some(1), "not below parts");
}

#[test]
fn a_closed_pipe_ends_nothing() {
    use std::process::Stdio;
    let place = library();
    let mut command = crate::support::program();
    command
        .args(["check", "--format=json"])
        .current_dir(place.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "the status is that of the findings");
    assert!(!String::from_utf8_lossy(&output.stderr).contains("cannot write"));
}
