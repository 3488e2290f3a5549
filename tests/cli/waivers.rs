//! Tests accepted findings: reasons, dates, entries that match nothing any more, and how entries are written. (book: howto/ci)

use std::process::Command;

use crate::support::{Place, Run, program};
use insta::assert_snapshot;
use pathbuild_testkit::sheet;
use serde_json::Value;

const WARNED: &str = "layer 1235.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 20,0 40,0\nturn 20,0\nend 40,0\n";
const GOOD: &str = "layer 1235.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n";
const WRONG: &str = "layer 1236.1P\nstart 0,0 \"T5 O2 I1\"\nmill 0,0 40,0 \"B6\"\nend 40,0\n";
const CODE: &str = "PB114";

fn dxf(text: &str) -> Vec<u8> {
    sheet(text).expect("a drawing").to_dxf()
}

fn place() -> Place {
    Place::new()
        .file("pathbuild.toml", "library = [\"parts\"]")
        .file("parts/1235.1P.dxf", dxf(WARNED))
        .file("parts/1236.1P.dxf", dxf(WRONG))
}

fn accept(place: &Place, more: &[&str]) -> Run {
    let reason = "the first \"one\" is milled by hand";
    let arguments = ["check", "--accept", CODE, "--reason", reason, "parts/1235.1P.dxf"];
    place.run_with(&[&arguments, more].concat())
}

fn entry(reason: &str) -> String {
    format!(
        "library = [\"parts\"]\n\n[[severity-in]]\nfiles = [\"parts/1235.1P.dxf\"]\nPB114 = \"ignore\"\n{reason}"
    )
}

fn strict(place: &Place, more: &str) -> Run {
    place.run(&format!("check parts/1235.1P.dxf --error-on-warning {more}"))
}

fn with_epoch(place: &Place, epoch: &str, more: &[&str]) -> Option<i32> {
    let mut command: Command = program();
    command.args(["check", "parts/1235.1P.dxf", "--error-on-warning", "-q"]).args(more);
    // The time zone of the user must not matter.
    command.current_dir(place.path()).env("SOURCE_DATE_EPOCH", epoch).env("TZ", "Pacific/Kiritimati");
    command.output().unwrap().status.code()
}

#[test]
fn an_accepted_finding_is_written_beside_the_configuration_and_held_back() {
    let place = place();
    assert_eq!(strict(&place, "").status, Some(1));
    assert_snapshot!(accept(&place, &[]));
    assert_snapshot!(place.read("pathbuild-baseline.txt"));
    assert_snapshot!(strict(&place, ""));
    assert_eq!(place.run_in("parts", &["check", "1235.1P.dxf", "--error-on-warning"]).status, Some(0));
    assert_eq!(place.run("check").status, Some(1), "the error in the other drawing is reported");
}

#[test]
fn accepting_again_replaces_the_reason_and_keeps_the_rest() {
    let place = place();
    assert_eq!(accept(&place, &["--baseline", "known.txt"]).status, Some(0));
    let commented = place.read("known.txt") + "# a remark\n";
    let place = place.file("known.txt", commented);
    let arguments = ["check", "--accept", CODE, "--reason", "later", "--until", "2031-01-31", "--baseline"];
    assert_eq!(place.run_with(&[&arguments[..], &["known.txt"]].concat()).status, Some(0));
    let text = place.read("known.txt");
    assert!(
        text.contains("# a remark\n") && text.contains(" until=2031-01-31 reason=\"later\" PB114"),
        "{text}"
    );
    assert_eq!(text.matches(CODE).count(), 1, "{text}");
    let updated = place.run("check --baseline known.txt --update-baseline");
    assert_eq!(updated.status, Some(0), "{updated}");
    let text = place.read("known.txt");
    assert!(text.contains(" until=2031-01-31 reason=\"later\" PB114"), "{text}");
    assert_eq!(text.lines().filter(|line| !line.starts_with('#')).count(), 2, "{text}");
}

/// A comparison of the file shows what was accepted, and nothing else.
#[test]
fn updating_a_part_of_a_baseline_keeps_the_order_of_its_lines() {
    let place = Place::new().file("pathbuild.toml", "library = [\".\"]");
    let place = place.file("a/1235.1P.dxf", dxf(WARNED)).file("b/1236.1P.dxf", dxf(WRONG));
    let update = |arguments: &str| {
        assert_eq!(place.run(&format!("check {arguments} --update-baseline")).status, Some(0));
        place.read("pathbuild-baseline.txt")
    };
    let whole = update("");
    assert!(whole.find("a/1235.1P.dxf").unwrap() < whole.find("b/1236.1P.dxf").unwrap(), "{whole}");
    assert_eq!((update("a"), update("b"), update("")), (whole.clone(), whole.clone(), whole.clone()));
    std::fs::remove_file(place.path().join("pathbuild-baseline.txt")).unwrap();
    let (second, both) = (update("b"), update("a"));
    assert!(both.starts_with(&second) && both.len() == whole.len(), "{both}");
    let marked = format!("\u{feff}{both}");
    std::fs::write(place.path().join("pathbuild-baseline.txt"), marked).unwrap();
    assert_eq!(update(""), both, "editors may begin a file with a byte order mark");
}

/// Its reasons and dates would be lost.
#[test]
fn a_baseline_that_cannot_be_read_is_not_rewritten() {
    let place = place();
    assert_eq!(accept(&place, &["--baseline", "known.txt"]).status, Some(0));
    let ansi = [&place.read("known.txt").into_bytes()[..], b"# gepr\xfcft\n"].concat();
    std::fs::write(place.path().join("known.txt"), &ansi).unwrap();
    let run = place.run("check --baseline known.txt --update-baseline");
    assert!(run.status == Some(2) && run.stderr.contains("known.txt"), "{run}");
    assert_eq!(std::fs::read(place.path().join("known.txt")).unwrap(), ansi);
}

#[test]
fn what_cannot_be_accepted_is_wrong_usage() {
    let place = place();
    let run = |arguments: &[&str]| place.run_with(&[&["check", "parts/1235.1P.dxf"], arguments].concat());
    for arguments in [
        &["--accept", "PB210", "--reason", "why"][..],
        &["--accept", "PB999", "--reason", "why"],
        &["--accept", CODE],
        &["--accept", CODE, "--reason", " "],
        &["--accept", CODE, "--reason", "why", "--until", "2026-02-29"],
        &["--accept", CODE, "--reason", "why", "--until", "2026-11-24", "--date", "2026-11-25"],
    ] {
        let run = run(arguments);
        assert_eq!(run.status, Some(2), "{run}");
        assert_snapshot!(run);
    }
    assert!(!place.path().join("pathbuild-baseline.txt").exists());
    let today = ["--accept", CODE, "--reason", "why", "--until", "2026-11-25", "--date", "2026-11-25"];
    assert_eq!(run(&today).status, Some(0), "the last day counts");
}

#[test]
fn an_entry_holds_on_its_last_day_and_not_on_the_next() {
    let place = place();
    assert_eq!(accept(&place, &["--until", "2031-12-31"]).status, Some(0));
    assert_snapshot!(strict(&place, "--date 2031-12-31"));
    assert_snapshot!(strict(&place, "--date 2032-01-01"));
    assert_snapshot!(strict(&place, "--date 2032-01-01 --lang de"));
}

#[test]
fn a_table_of_the_configuration_holds_on_its_last_day_and_not_on_the_next() {
    for until in ["until = 2031-12-31", "until = \"2031-12-31\""] {
        let place = place().file("pathbuild.toml", entry(&format!("reason = \"by hand\"\n{until}\n")));
        assert_eq!(strict(&place, "--date 2031-12-31").status, Some(0));
        assert_snapshot!("a_table_that_has_ended", strict(&place, "--date 2032-01-01"));
    }
    let raised = entry("reason = \"by hand\"\nuntil = 2031-12-31\n").replace("ignore", "error");
    let place = place().file("pathbuild.toml", raised);
    assert_snapshot!(strict(&place, "--date 2031-12-31"));
    assert_eq!(strict(&place, "--date 2032-01-01").stderr.matches("error:").count(), 0);
}

#[test]
fn an_ended_table_leaves_the_level_of_the_one_before() {
    let two = entry("until = 2031-12-31\n")
        + "\n[[severity-in]]\nfiles = [\"parts/*\"]\nPB114 = \"error\"\nuntil = 2030-12-31\n";
    let place = place().file("pathbuild.toml", two);
    let status = |date: &str| place.run(&format!("check parts/1235.1P.dxf --date {date}")).status;
    assert_eq!(
        [status("2030-12-31"), status("2031-01-01"), status("2032-01-01")],
        [Some(1), Some(0), Some(0)]
    );
    assert!(strict(&place, "--date 2032-01-01").stderr.contains(CODE));
}

#[test]
fn the_date_is_that_of_the_option_else_of_the_variable_in_utc() {
    let place = place();
    assert_eq!(accept(&place, &["--until", "2031-12-31"]).status, Some(0));
    // The times are 2031-12-31 23:59:59 UTC and a second later.
    assert_eq!(with_epoch(&place, "1956527999", &[]), Some(0));
    assert_eq!(with_epoch(&place, "1956528000", &[]), Some(1));
    assert_eq!(
        with_epoch(&place, "1956528000", &["--date", "2031-12-31"]),
        Some(0),
        "the option comes first"
    );
    for epoch in ["soon", "-1", "", "99999999999999"] {
        assert_eq!(with_epoch(&place, epoch, &[]), Some(2), "{epoch}");
    }
    // The dates are a leap day, and the ends of a century.
    let place = place.file("pathbuild.toml", entry("until = 2028-02-29\n"));
    assert_eq!(
        with_epoch(&place, "1835481599", &["--baseline", "none"]),
        Some(2),
        "the named file must exist"
    );
    let place = place.file("none", "");
    assert_eq!(with_epoch(&place, "1835481599", &["--baseline", "none"]), Some(0));
    assert_eq!(with_epoch(&place, "1835481600", &["--baseline", "none"]), Some(1));
}

/// Nothing is known about a file that is missing, so a baseline that accepted it would hide whatever is wrong with the file.
#[test]
fn a_file_that_cannot_be_read_is_never_accepted() {
    let program =
        "G21 G90 G17 G40 G94 G54\nM3 S12000\nG0 Z5\nG0 X0 Y0\nG1 Z-3 F100\nG0 X20\nG0 Z5\nM5\nM30\n";
    let place = Place::new().file("p.nc", program);
    let verify = |more: &[&str]| place.run_with(&[&["verify", "p.nc", "missing.nc"], more].concat());
    for more in [&["--accept", "PB740", "--reason", "wax"][..], &["--update-baseline"]] {
        let run = verify(more);
        assert!(run.status == Some(1) && run.stderr.contains("PB001"), "{run}");
        assert!(run.stderr.contains("missing.nc") && !run.stderr.contains("PB740"), "{run}");
        assert!(!place.path().join("pathbuild-baseline.txt").exists());
    }
    // Earlier versions wrote this line.
    let place = place.file("pathbuild-baseline.txt", "c394c7623e4da6b31b3e47e5b40ed9eb PB001 missing.nc\n");
    let run = place.run("verify missing.nc");
    assert!(run.status == Some(1) && run.stderr.contains("PB001"), "{run}");
}

/// What was not checked cannot be accepted, and the waivers of what is missing stay.
#[test]
fn what_was_not_checked_is_never_accepted() {
    let configuration = "library = [\"parts\", \"share\"]\n";
    let place = Place::new().file("pathbuild.toml", configuration).file("parts/1236.1P.dxf", dxf(GOOD));
    let place = place.file("share/1235.1P.dxf", dxf(WARNED)).file("programs/notes.txt", "");
    assert_eq!(place.run("check --accept PB114 --reason why").status, Some(0));
    let baseline = place.read("pathbuild-baseline.txt");
    let assert_refused = |place: &Place, command: &str, code: &str| {
        for more in [" --update-baseline", &format!(" --accept {code} --reason why"), ""] {
            let run = place.run(&format!("{command}{more}"));
            assert!(run.status == Some(1) && run.stderr.contains(code), "{run}");
            assert!(!run.stderr.contains("PB610"), "{run}");
            assert_eq!(place.read("pathbuild-baseline.txt"), baseline, "{run}");
        }
    };
    std::fs::remove_file(place.path().join("share/1235.1P.dxf")).unwrap();
    assert_refused(&place, "check", "PB518");
    std::fs::remove_dir(place.path().join("share")).unwrap();
    assert_refused(&place, "check", "PB003");
    let place = place.file("share/1235.1P.dxf", dxf(WARNED));
    assert_refused(&place, "check 9*", "PB503");
    assert_refused(&place, "check 9001.1P", "PB503");
    assert_refused(&place, "verify programs", "PB518");
    let place = place.file("a.nc", PROGRAM).file("empty.nc", "").file("letter.nc", "hello world\n");
    assert_refused(&place, "verify a.nc --require clamps", "PB523");
    assert_refused(&place, "verify empty.nc", "PB701");
    assert_refused(&place, "verify letter.nc", "PB701");
    let place = place.file("pathbuild.toml", format!("{configuration}[limits]\nentities = 1\n"));
    assert_eq!(place.run("check --update-baseline").status, Some(1));
    assert_eq!(place.read("pathbuild-baseline.txt"), baseline);
}

/// After an earlier roughing cut is removed, a rapid move that entered the material by 0.05 mm enters it by 3 mm at the same position.
#[test]
fn an_accepted_rapid_move_holds_while_it_is_not_deeper() {
    let program = |head: &str, roughed: &str| {
        format!(
            "{head}G21 G90 G17 G40 G94 G54\nM3 S12000\nG0 Z5\nG0 X0 Y0\nG1 Z{roughed} F100\nG1 X20 F200\nG0 Z5\nG0 X10 Y0\nG0 Z-3\nG1 X30 F200\nG0 Z5\nM5\nM30\n"
        )
    };
    let place = Place::new().file("p.nc", program("", "-2.95"));
    let verify = "verify p.nc --dialect linuxcnc --cutter 2 --surface 0";
    let accept: Vec<&str> = verify.split(' ').chain(["--accept", "PB741", "--reason", "wax"]).collect();
    assert_eq!(place.run_with(&accept).status, Some(0));
    let run = |text: String| {
        std::fs::write(place.path().join("p.nc"), text).unwrap();
        place.run(verify)
    };
    let same = run(program("", "-2.95"));
    assert!(same.status == Some(0) && same.stderr.contains("known: 1"), "{same}");
    let shallower = run(program("(edited)\n", "-2.96"));
    assert!(shallower.status == Some(0) && shallower.stderr.contains("known: 1"), "{shallower}");
    for (roughed, depth) in [("-2.94", "0.06"), ("1", "3")] {
        let deeper = run(program("", roughed));
        let note = format!(
            "pathbuild-baseline.txt:3 accepts this finding only up to 0.05 mm; here it is {depth} mm"
        );
        assert!(deeper.status == Some(1) && deeper.stderr.contains(&note), "{deeper}");
    }
    let baseline = place.path().join("pathbuild-baseline.txt");
    let text = std::fs::read_to_string(&baseline).unwrap();
    std::fs::write(&baseline, text.replace(" depth=0.05", "")).unwrap();
    let old = run(program("", "-2.95"));
    assert!(old.status == Some(1) && old.stderr.contains("does not state the depth"), "{old}");
    std::fs::write(&baseline, text.replace("depth=0.05", "depth=deep")).unwrap();
    let invalid = run(program("", "-2.95"));
    assert!(invalid.status == Some(2) && invalid.stderr.contains("`deep` is not a depth"), "{invalid}");
}

/// Diagonal plunges and moves beyond the travel are only accepted as far as they went at that time.
#[test]
fn slopes_and_moves_beyond_the_machine_are_accepted_up_to_a_depth() {
    let program = "G21 G90 G17 G40 G94 G54\nM3 S12000\nG0 Z5\nG0 X0 Y0\nG1 Z-3 F100\nG1 X20 F200\nG0 Z5\nG0 X10 Z-1\nG0 Z5\nG0 X100.5\nM5\nM30\n";
    let table = |most: f64| format!("[machine]\nx = [-10, {most}]\ny = [-10, 100]\nz = [-10, 50]\n");
    let place = Place::new().file("pathbuild.toml", table(100.0)).file("p.nc", program);
    let verify = |surface: &str| format!("verify p.nc --dialect linuxcnc --cutter 2 --surface {surface}");
    for code in ["PB744", "PB748"] {
        let line = verify("0");
        let accept: Vec<&str> = line.split(' ').chain(["--accept", code, "--reason", "wax"]).collect();
        let run = place.run_with(&accept);
        assert!(run.stderr.contains("1 finding accepted"), "{run}");
    }
    let baseline = place.read("pathbuild-baseline.txt");
    assert!(baseline.contains(" depth=1 ") && baseline.contains(" depth=0.5 "), "{baseline}");
    let notes = |surface: &str, most: f64| {
        std::fs::write(place.path().join("pathbuild.toml"), table(most)).unwrap();
        place.run(&verify(surface)).stderr.matches("accepts this finding only up to").count()
    };
    assert_eq!(notes("0", 100.0), 0);
    assert_eq!(notes("-0.1", 100.1), 0);
    assert_eq!(notes("0.01", 100.0), 1);
    assert_eq!(notes("0", 99.99), 1);
}

#[test]
fn invalid_dates_are_named_with_their_places() {
    let line = "0123456789abcdef0123456789abcdef";
    let text = format!("{line} until=2026-02-30 PB114 a.dxf\n{line} reason=why PB114\n{line} until=soon\n");
    let place = place().file("known.txt", text);
    for word in
        ["until:2031-01-01", "until =2031-01-01", "Until=2031-01-01", "reason:", "Depth=1", "severity=error"]
    {
        std::fs::write(place.path().join("slip.txt"), format!("{line} {word} PB114 a.dxf\n")).unwrap();
        let run = place.run("check --baseline slip.txt");
        assert!(run.status == Some(2) && run.stderr.contains("slip.txt:1"), "{word}: {run}");
    }
    assert_snapshot!(place.run("check --baseline known.txt"));
    assert_snapshot!(place.run("check --baseline known.txt --update-baseline --lang de"));
    for until in ["\"2026-13-01\"", "2026-12-31T00:00:00", "20261231", "\" 2026-12-31\""] {
        let place = Place::new().file("pathbuild.toml", entry(&format!("until = {until}\n")));
        let run = place.run("check");
        assert_eq!(run.status, Some(2), "{run}");
        assert!(
            run.stderr.contains("`severity-in.until`") && run.stderr.contains("pathbuild.toml:6"),
            "{run}"
        );
    }
    assert_snapshot!(place.run("check --date tomorrow"));
    assert_snapshot!(place.run("check --date 2026-11-31 --lang de"));
}

#[test]
fn an_entry_that_matches_nothing_is_a_warning_where_its_file_was_checked() {
    let place = place();
    let arguments = ["check", "--accept", CODE, "--reason", "why", "--baseline", "known.txt"];
    assert_eq!(place.run_with(&arguments).status, Some(0));
    let place = place.file("parts/1235.1P.dxf", dxf(GOOD));
    assert_snapshot!(strict(&place, "--baseline known.txt"));
    assert_snapshot!(strict(&place, "--baseline known.txt --lang de --format concise"));
    let is_told = |arguments: &str| {
        place.run(&format!("check {arguments} --baseline known.txt")).stderr.contains("PB610")
    };
    assert!(is_told("") && is_told("parts"));
    assert!(!is_told("parts/1236.1P.dxf") && !is_told("1235.1P"), "other drawings, or single paths");
    std::fs::remove_file(place.path().join("parts/1235.1P.dxf")).unwrap();
    assert!(is_told("") && is_told("parts"), "the drawing is gone");
    assert!(!is_told("parts/1236.1P.dxf"));
}

#[test]
fn a_table_that_matches_nothing_is_a_warning_where_its_files_were_checked() {
    let is_told =
        |place: &Place, arguments: &str| place.run(&format!("check {arguments}")).stderr.contains("PB610");
    let place = place().file("pathbuild.toml", entry("reason = \"why\"\n"));
    assert!(!is_told(&place, ""), "it matches");
    let place = place.file("parts/1235.1P.dxf", dxf(GOOD));
    assert!(is_told(&place, "") && is_told(&place, "parts/1235.1P.dxf"));
    assert!(!is_told(&place, "parts/1236.1P.dxf") && !is_told(&place, "1235.1P"));
    let wild = entry("reason = \"why\"\n").replace("parts/1235.1P.dxf", "parts/*");
    let place = place.file("pathbuild.toml", wild);
    assert!(is_told(&place, "") && !is_told(&place, "parts/1235.1P.dxf"));
    let mut place = place;
    for (code, is_judged) in [("PB115", true), ("PB606", false)] {
        place = place.file("pathbuild.toml", entry("reason = \"why\"\n").replace("PB114", code));
        assert_eq!(is_told(&place, ""), is_judged, "only `emit` finds PB606");
    }
    let place = place.file("pathbuild.toml", entry(""));
    assert!(!is_told(&place, ""), "a table without a reason is a setting, not a waiver");
}

/// `emit` writes what a waiver accepts on the date of the run, also in native programs, which contain no date.
#[test]
fn emit_accepts_until_the_last_day() {
    let place = place().file("pathbuild.toml", entry("reason = \"why\"\nuntil = 2031-12-31\n"));
    let run = |date: &str| {
        place.run(&format!("emit parts/1235.1P.dxf --feed 100 --rapid 1000 --sweep-height 9 --date {date}"))
    };
    let (last, after) = (run("2031-12-31"), run("2032-01-01"));
    assert!(last.status == Some(0) && !last.stderr.contains("PB114"), "{last}");
    assert!(after.status == Some(0) && after.stderr.contains("warning[PB114]"), "{after}");
}

#[test]
fn reports_carry_the_reason() {
    let place = place();
    assert_eq!(accept(&place, &["--until", "2031-12-31"]).status, Some(0));
    let run = place.run(
        "check parts/1235.1P.dxf --date 2031-01-01 --report json=a.json --report sarif=b.sarif --report html=c.html",
    );
    assert_eq!(run.status, Some(0), "{run}");
    let json = place.read("a.json");
    let waived = json.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let waived: Vec<Value> = waived.filter(|line| line["type"] == "waived").collect();
    assert_eq!(waived.len(), 1, "{json}");
    let schema: Value = serde_json::from_str(include_str!("../../docs/schemas/output.json")).unwrap();
    assert!(jsonschema::validator_for(&schema).unwrap().is_valid(&waived[0]), "{}", waived[0]);
    assert_eq!((&waived[0]["code"], &waived[0]["until"]), (&CODE.into(), &"2031-12-31".into()));
    assert_eq!(waived[0]["reason"], "the first \"one\" is milled by hand");
    let sarif: Value = serde_json::from_str(&place.read("b.sarif")).unwrap();
    let schema: Value = serde_json::from_str(include_str!("schemas/sarif-2.1.0.json")).unwrap();
    assert!(jsonschema::validator_for(&schema).unwrap().is_valid(&sarif));
    let results = sarif["runs"][0]["results"].as_array().unwrap();
    assert_eq!(results.len(), 1);
    assert_eq!(results[0]["suppressions"][0]["justification"], "the first \"one\" is milled by hand");
    let page = place.read("c.html");
    assert!(
        page.contains("Accepted") && page.contains("the first &quot;one&quot; is milled by hand"),
        "{page}"
    );
}

#[test]
fn kept_results_do_not_depend_on_the_date() {
    let place = place().file("pathbuild.toml", entry("reason = \"why\"\nuntil = 2031-12-31\n"));
    let run = |date: &str| place.run(&format!("check -v --date {date}"));
    assert!(run("2031-12-31").stderr.contains("drawings with valid cached results: 0 / 2"));
    let after = run("2032-01-01");
    assert!(after.stderr.contains("drawings with valid cached results: 2 / 2"), "{after}");
    assert!(after.stderr.contains(CODE), "{after}");
    let before = run("2031-12-31");
    assert!(before.stderr.contains("2 / 2") && !before.stderr.contains(CODE), "{before}");
}

const PROGRAM: &str = "G21 G90 G94 G17\nT1 M6\nS12000 M3\nG0 Z15\nG0 X0 Y0\nG1 Z-2 F200\nG1 X40 F600\nG0 Y20\nG1 X0\nG0 Z15\nM5\nM30\n";

/// `--update-baseline` writes the same file as `--accept`.
#[test]
fn the_baseline_beside_the_configuration_is_updated_without_being_named() {
    let place = place();
    assert_eq!(place.run("check").status, Some(1));
    let run = place.run("check --update-baseline");
    assert!(run.status == Some(0) && run.stderr.contains("pathbuild-baseline.txt: "), "{run}");
    assert_eq!(place.run("check").status, Some(0));
}

#[test]
fn findings_of_programs_are_accepted_in_the_same_way() {
    let place = place().file("a.nc", PROGRAM);
    let run = place.run("verify a.nc --cutter 6 --surface 0");
    assert!(run.status == Some(1) && run.stderr.contains("PB740"), "{run}");
    let arguments = [
        "verify",
        "a.nc",
        "--cutter",
        "6",
        "--surface",
        "0",
        "--accept",
        "PB740",
        "--reason",
        "a slot is there",
    ];
    assert_eq!(place.run_with(&[&arguments[..], &["--until", "2031-12-31"]].concat()).status, Some(0));
    let verify = |date: &str| place.run(&format!("verify a.nc --cutter 6 --surface 0 --date {date}"));
    let (last, after) = (verify("2031-12-31"), verify("2032-01-01"));
    assert_eq!([last.status, after.status], [Some(0), Some(1)]);
    assert!(last.stderr.contains("errors: 0, warnings: 0, known: 1"), "{last}");
    assert!(
        last.stderr.contains("2031-12-31 (--date)")
            && after.stderr.contains("the reason was: a slot is there")
    );
    let update = place.run("check --baseline pathbuild-baseline.txt --update-baseline");
    assert_eq!(update.status, Some(0), "{update}");
    assert_eq!(verify("2031-12-31").status, Some(0), "another command keeps the entry");
    assert!(!place.run("check").stderr.contains("PB610"), "`check` does not look at programs");
    let place = place.file("a.nc", PROGRAM.replace("G0 Y20", "G0 Z15\nG0 Y20\nG1 Z-2"));
    let mended = place.run("verify a.nc --cutter 6 --surface 0");
    assert!(mended.status == Some(0) && mended.stderr.contains("PB610"), "{mended}");
}

#[test]
fn tables_of_the_configuration_hold_for_programs() {
    let entry =
        "[[severity-in]]\nfiles = [\"*.nc\"]\nPB781 = \"ignore\"\nreason = \"why\"\nuntil = 2031-12-31\n";
    let place = Place::new().file("pathbuild.toml", entry).file("a.nc", PROGRAM);
    let is_told =
        |date: &str| place.run(&format!("verify a.nc --cutter 6 --date {date}")).stderr.contains("PB781");
    assert_eq!([is_told("2031-12-31"), is_told("2032-01-01")], [false, true]);
}

/// Different programs often have the same name, such as `op1.nc` in the directory of each job.
#[test]
fn an_accepted_finding_of_a_program_holds_for_this_program_only() {
    let program = "( T1 D=6 CR=0 - flat end mill )\nG17 G21 G90 G94\nT1 M6\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X40\nG0 Y20\n\
        G1 X0\nG0 Z5\nM5\nM30\n";
    let place = Place::new().file("pathbuild.toml", "").file("a/s.nc", program).file("b/s.nc", program);
    let place = place.file("s.nc", program);
    let verify = |file: &str, more: &str| {
        place.run(&format!("verify {file} --dialect linuxcnc --surface 0 --format concise {more}"))
    };
    let accept = "--accept PB740 --reason fixture";
    assert_eq!(verify("a/s.nc", accept).status, Some(0));
    assert_eq!(verify("a/s.nc", "").status, Some(0));
    assert_eq!(
        place.run_in("a", &["verify", "s.nc", "--dialect", "linuxcnc", "--surface", "0"]).status,
        Some(0)
    );
    assert_eq!((verify("b/s.nc", "").status, verify("s.nc", "").status), (Some(1), Some(1)));
    let entries = || place.read("pathbuild-baseline.txt").matches("PB740").count();
    assert_eq!(verify("b/s.nc", accept).status, Some(0));
    assert_eq!((verify("a/s.nc", "").status, entries()), (Some(0), 2));
    // Fingerprints of version 0.2.0 contain only the name of the file; an entry holds for the file that its description names.
    let text = place.read("pathbuild-baseline.txt");
    let of_a = text.lines().find(|line| line.contains(" a/s.nc ")).unwrap();
    let earlier = format!("{EARLIER}{}\n", &of_a[32..]);
    std::fs::write(place.path().join("pathbuild-baseline.txt"), earlier).unwrap();
    assert_eq!((verify("a/s.nc", "").status, verify("b/s.nc", "").status), (Some(0), Some(1)));
    assert_eq!(verify("s.nc", "").status, Some(1));
    assert_eq!(verify("a/s.nc", accept).status, Some(0));
    assert_eq!((entries(), place.read("pathbuild-baseline.txt").contains(EARLIER)), (1, false));
}

/// Fingerprint of the finding of this test in the form of version 0.2.0, which contains only the name of the file.
const EARLIER: &str = "15e1045e1edb88cdfa3367c9ccae69a1";

/// Drawings in several directories may have the same name, and are not always checked together.
#[test]
fn an_accepted_finding_of_a_drawing_holds_for_this_drawing_only() {
    let place = Place::new().file("pathbuild.toml", "library = [\".\"]");
    let place = place.file("a/1235.1P.dxf", dxf(WARNED)).file("b/1235.1P.dxf", dxf(WARNED));
    let reported = |arguments: &str| {
        let run = place.run(&format!("check {arguments} --format concise"));
        let of = |directory: &str| {
            let is_reported = |line: &&str| line.contains("PB114") && line.contains(directory);
            run.stderr.lines().filter(is_reported).count()
        };
        (of("a/"), of("b/"), run.stderr.matches("PB610").count())
    };
    let accept = |directory: &str| {
        let run = place.run_with(&["check", directory, "--accept", CODE, "--reason", "why"]);
        assert_eq!(run.status, Some(0), "{run}");
    };
    let write = |file: &str, text: &str| std::fs::write(place.path().join(file), dxf(text)).unwrap();
    accept("b");
    assert_eq!((reported("a"), reported("b"), reported("")), ((1, 0, 0), (0, 0, 0), (1, 0, 0)));
    accept("a");
    assert_eq!((reported("a"), reported("b"), reported("")), ((0, 0, 0), (0, 0, 0), (0, 0, 0)));
    assert_eq!(place.read("pathbuild-baseline.txt").matches(CODE).count(), 2);
    // The entry for b does not cover a once that of a is gone, nor the other way round.
    let both = place.read("pathbuild-baseline.txt");
    let without =
        |name: &str| both.lines().filter(|line| !line.contains(name)).collect::<Vec<_>>().join("\n");
    for (name, expected) in [(" a/", (1, 0, 0)), (" b/", (0, 1, 0))] {
        std::fs::write(place.path().join("pathbuild-baseline.txt"), without(name)).unwrap();
        assert_eq!(reported(""), expected, "{name}");
    }
    write("a/1235.1P.dxf", GOOD);
    assert_eq!(reported(""), (0, 1, 1), "the entry for a is of no use to b");
    std::fs::remove_file(place.path().join("a/1235.1P.dxf")).unwrap();
    assert_eq!(reported(""), (0, 0, 0), "the drawing has been moved from a to b");
}

#[test]
fn an_accepted_hidden_element_holds_for_its_layer_only() {
    let drawing = |first: &str, second: &str| {
        let paths = [("1235.1P", first), ("1236.1P", second)].map(|(layer, state)| {
            format!("layer {layer}\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0 {state}\nend 40,0\n")
        });
        dxf(&paths.concat())
    };
    let place = Place::new().file("pathbuild.toml", "library = [\".\"]");
    let reported = |first: &str, second: &str| {
        std::fs::write(place.path().join("1235.dxf"), drawing(first, second)).unwrap();
        let run = place.run("check 1235.dxf --format concise");
        ["PB112", "PB610"].map(|code| run.stderr.matches(code).count())
    };
    assert_eq!(reported("invisible", ""), [1, 0]);
    let run = place.run_with(&["check", "1235.dxf", "--accept", "PB112", "--reason", "why"]);
    assert_eq!(run.status, Some(0), "{run}");
    assert_eq!(reported("invisible", ""), [0, 0]);
    assert_eq!(reported("", "invisible"), [1, 1]);
}

/// Versions up to 0.2.0 numbered equal findings through all drawings of a run, and accepted some at any depth.
#[test]
fn entries_of_earlier_versions_hold_for_the_drawings_that_they_name() {
    let baseline = "ef36ca83e495babdf9fb45fb810e99f2 PB114 a/1235.1P.dxf 1235.1P (20, 0) this turn marker has no effect\n\
        e3c092cb9195babdf9fb4329695723fd PB114 b/1235.1P.dxf 1235.1P (20, 0) this turn marker has no effect\n";
    let place =
        Place::new().file("pathbuild.toml", "library = [\".\"]").file("pathbuild-baseline.txt", baseline);
    let place = place.file("a/1235.1P.dxf", dxf(WARNED)).file("b/1235.1P.dxf", dxf(WARNED));
    let status = |arguments: &str| place.run(&format!("check {arguments} --error-on-warning")).status;
    assert_eq!((status(""), status("a")), (Some(0), Some(0)));
    assert_eq!(place.run("check --update-baseline").status, Some(0));
    assert_eq!((status(""), status("a"), status("b")), (Some(0), Some(0), Some(0)));
}

/// A plate whose upper edge is at `edge`, while the cutter runs along 20.
fn plate(edge: f64) -> Vec<u8> {
    dxf(&format!(
        "header $LTSCALE 40 0.1\nlayer 1122.1P\nstart 0,-6\nmtext 0,-7 \"O2 T2 M20x2 I0.5 F150 A30\\PB-0.2 D1 P4 U10\" height 1 align middle centre\n\
        line HIDDEN 0,-6 -1,-1\nbars -1,-1 -1,21 41,21 41,-1 -1,-1\nline HIDDEN -1,-1 40,-6\nend 40,-6\nlayer Part\n\
        polyline 0,0 40,0 40,{edge} 0,{edge} closed\n"
    ))
}

#[test]
fn an_accepted_cut_into_the_part_holds_while_it_is_not_deeper() {
    let place =
        Place::new().file("pathbuild.toml", "library = [\".\"]\nfeed = 150\nrapid = 1000\npart = 'Part'\n");
    let place = place.file("1122.1P.dxf", plate(20.05));
    let check = |edge: f64| {
        std::fs::write(place.path().join("1122.1P.dxf"), plate(edge)).unwrap();
        place.run("check --error-on-warning")
    };
    let accept = ["check", "--accept", "PB213", "--reason", "polished off"];
    assert_eq!(place.run_with(&accept).status, Some(0));
    let baseline = place.read("pathbuild-baseline.txt");
    assert!(baseline.contains(" depth=0.05 reason=\"polished off\" severity=warning PB213 "), "{baseline}");
    let write = |text: &str| std::fs::write(place.path().join("pathbuild-baseline.txt"), text).unwrap();
    let deeper = "pathbuild-baseline.txt:3 accepts this finding only up to 0.05 mm; here it is 0.06 mm";
    // Versions up to 0.2.0 wrote neither the depth nor the severity, but described the finding.
    for text in [&baseline, &baseline.replace(" depth=0.05", "").replace(" severity=warning", "")] {
        write(text);
        let (same, more) = (check(20.05), check(20.06));
        assert!(same.status == Some(0) && same.stderr.contains("1 known"), "{same}");
        assert!(more.status == Some(1) && more.stderr.contains(deeper), "{more}");
    }
    // Without any depth, a warning may become deeper, but not an error.
    write(&baseline.replace(" depth=0.05", "").replace("0.05 mm", "a bit"));
    let (warning, error) = (check(20.1), check(20.11));
    assert_eq!(warning.status, Some(0), "{warning}");
    let note = "pathbuild-baseline.txt:3 accepts this finding only as a warning; here it is an error";
    assert!(error.status == Some(1) && error.stderr.contains(note), "{error}");
}

#[test]
fn an_accepted_move_into_a_clamp_holds_while_it_is_not_deeper() {
    let drawing = |s: &str| {
        dxf(&format!(
            "layer 1114.1P\nstart 0,0\nmtext 0,-1 \"O2 T2 S{s} F150 I1 B0\" height 1 align middle centre\nmill 0,0 20,0\nsweep 20,0 40,0\n\
            mill 40,0 60,0\nend 60,0\nlayer Clamps\npolyline 25,-10 35,-10 35,10 25,10 closed\ntext 28.5,5 \"Z25\" height 2\n"
        ))
    };
    let settings = "library = [\".\"]\nfeed = 150\nrapid = 1000\nsweep-height = 10\nkeep-out = 'Clamps'\n";
    let place = Place::new().file("pathbuild.toml", settings).file("1114.1P.dxf", drawing("20"));
    let check = |s: &str| {
        std::fs::write(place.path().join("1114.1P.dxf"), drawing(s)).unwrap();
        place.run("check")
    };
    assert_eq!(place.run_with(&["check", "--accept", "PB407", "--reason", "filed down"]).status, Some(0));
    assert_eq!((check("20").status, check("20.5").status), (Some(0), Some(0)));
    let lower = check("19.99");
    let note = "pathbuild-baseline.txt:3 accepts this finding only up to 5 mm; here it is 5.01 mm";
    assert!(lower.status == Some(1) && lower.stderr.contains(note), "{lower}");
    // Entries of versions up to 0.2.0 do not say how deep.
    let baseline = place.read("pathbuild-baseline.txt").replace(" depth=5", "");
    std::fs::write(place.path().join("pathbuild-baseline.txt"), baseline).unwrap();
    assert_eq!(check("19.99").status, Some(0));
}

/// Elsewhere, `-` is standard input or output.
#[test]
fn files_to_be_named_are_not_called_hyphen() {
    let place = place();
    for arguments in ["check --baseline - --update-baseline", "emit --deps - 1235.1P"] {
        let run = place.run(arguments);
        assert!(run.status == Some(2) && run.stderr.contains("expected the name of a file"), "{run}");
    }
    assert!(!place.path().join("-").exists());
    assert_eq!(place.run("check --baseline ./- --update-baseline").status, Some(0));
}
