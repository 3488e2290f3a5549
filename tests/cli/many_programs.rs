//! Tests `verify` with many programs: arguments, standard input, and results cached between runs. (book: program/reading)

use std::fs;
use std::io::Write;
use std::process::Stdio;

use crate::support::{Place, Run, program};

/// A program that moves down into the material at full speed, and one that does not.
const BAD: &str = "G21 G90\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG0 Z-1\nG1 X9 F90\nG0 Z5\nM30\n";
const GOOD: &str = "G21 G90\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F90\nG1 X9 F90\nG0 Z5\nM30\n";
const OPTIONS: &str = "--dialect grbl --cutter 2 --surface 0 --format concise";

fn place() -> Place {
    let place = Place::new().file("pathbuild.toml", "library = [\"lib\"]\n");
    let place = place.file("nc/a.nc", BAD).file("nc/b.NGC", GOOD).file("nc/deep/c.tap", BAD);
    place.file("nc/notes.txt", "G0 Z-1").file("nc/.hidden.nc", BAD).file("empty/notes.txt", "")
}

/// Returns the programs with a rapid move into the material, in the order of the output.
fn plunging(run: &Run) -> Vec<&str> {
    let lines = run.stderr.lines().filter(|line| line.contains("[PB741]"));
    lines.filter_map(|line| line.split(':').next()).collect()
}

#[test]
fn directories_and_patterns_stand_for_their_programs() {
    let place = place();
    for (arguments, expected) in [
        ("nc", vec!["nc/a.nc", "nc/deep/c.tap"]),
        ("nc/deep nc/deep/c.tap nc/./deep/c.tap", vec!["nc/deep/c.tap"]),
        ("nc/*.nc nc/d*", vec!["nc/a.nc", "nc/deep/c.tap"]),
        ("nc/b.NGC", vec![]),
    ] {
        for cache in ["", "--no-cache", "", "--jobs 1"] {
            let run = place.run(&format!("verify {arguments} {OPTIONS} {cache}"));
            assert_eq!(plunging(&run), expected, "{run}");
            assert_eq!(run.status, Some(i32::from(!expected.is_empty())), "{run}");
        }
    }
    let run = place.run(&format!("verify nc empty {OPTIONS}"));
    assert!(
        run.status == Some(1) && run.stderr.contains("[PB518] there is no G-code program in empty"),
        "{run}"
    );
}

#[test]
fn standard_input_is_a_program() {
    let place = place();
    let mut command = program();
    command.current_dir(place.path()).args(["verify", "-"]).args(OPTIONS.split(' '));
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(BAD.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(1) && text.starts_with("-:5:1: error[PB741]"), "{text}");
}

/// A result holds until the program, an option, a limit or the machine changes; severities apply afterwards.
#[test]
fn results_are_kept_as_long_as_nothing_they_depend_on_changes() {
    let place = place();
    let run = |arguments: &str| place.run(&format!("verify nc {OPTIONS} -v {arguments}"));
    let known = |run: &Run| {
        let line = run
            .stderr
            .lines()
            .find(|line| line.contains("programs with valid cached results"))
            .map(ToOwned::to_owned);
        line.unwrap_or_default().rsplit(": ").next().unwrap_or_default().to_owned()
    };
    let first = run("");
    assert_eq!(known(&first), "0 / 3", "{first}");
    let again = run("");
    assert_eq!((known(&again).as_str(), plunging(&again)), ("3 / 3", plunging(&first)), "{again}");
    fs::write(place.path().join("nc/a.nc"), GOOD).unwrap();
    let edited = run("");
    assert_eq!((known(&edited).as_str(), plunging(&edited)), ("2 / 3", vec!["nc/deep/c.tap"]), "{edited}");
    assert_eq!(known(&run("--require feeds")), "0 / 3");
    assert_eq!(known(&run("")), "3 / 3");
    let configure = |text: &str| {
        fs::write(place.path().join("pathbuild.toml"), format!("library = [\"lib\"]\n{text}")).unwrap();
    };
    configure("[severity]\nPB741 = \"ignore\"\n");
    let ignored = run("");
    assert_eq!((known(&ignored).as_str(), ignored.status), ("3 / 3", Some(0)), "{ignored}");
    for changed in ["[machine]\nmaximum-feed = 80\n", "[limits]\nverify-cells = 100\n"] {
        configure(changed);
        let run = run("");
        assert_eq!(known(&run), "0 / 3", "{run}");
        assert!(run.stderr.contains("PB747") || run.stderr.contains("too large"), "{run}");
    }
}

/// A baseline applies to cached results of a directory and of a program in it, but no longer after the last day of its entries.
#[test]
fn accepted_findings_hold_for_kept_results_and_directories() {
    let place = place();
    let accept = format!("verify nc {OPTIONS} --accept PB741 --until 2031-12-31 --reason");
    let accept: Vec<&str> = accept.split(' ').chain(["open slot"]).collect();
    assert_eq!(place.run_with(&accept).status, Some(0));
    let run = |arguments: &str| place.run(&format!("verify {arguments} {OPTIONS} -v"));
    for arguments in ["nc", "nc/a.nc", "nc/deep", "nc/*.nc nc/deep"] {
        let run = run(&format!("{arguments} --date 2031-12-31"));
        assert!(run.status == Some(0) && plunging(&run).is_empty(), "{run}");
        assert!(!run.stderr.contains("PB610"), "{run}");
        let all = run.stderr.matches("valid cached results: ").count();
        assert!(all == 1 && !run.stderr.contains("valid cached results: 0"), "{run}");
    }
    let after = run("nc --date 2032-01-01");
    assert_eq!(plunging(&after), ["nc/a.nc", "nc/deep/c.tap"], "{after}");
    // The finding of an accepted entry is fixed: the entry is reported as unused if the run covers the program.
    fs::write(place.path().join("nc/a.nc"), GOOD).unwrap();
    assert!(!run("nc/deep --date 2031-12-31").stderr.contains("PB610"));
    assert!(run("nc --date 2031-12-31").stderr.contains("PB610"));
}

#[test]
fn a_result_depends_on_the_drawing() {
    let drawn = |depth: &str| {
        let text = format!("layer 1234.1P\nstart 0,0 \"T5 O2 I1 B{depth}\"\nmill 0,0 40,0\nend 40,0\n");
        pathbuild_testkit::sheet(&text).unwrap().to_dxf()
    };
    let configuration =
        "library = [\"lib\"]\nfeed = 150\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n";
    let place = Place::new().file("pathbuild.toml", configuration).file("lib/1234.dxf", drawn("0"));
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let verify = || place.run("verify lib --against 1234.1P --format concise");
    let (first, again) = (verify(), verify());
    assert!(first.status == Some(0) && first == again, "{first}{again}");
    fs::write(place.path().join("lib/1234.dxf"), drawn("1")).unwrap();
    assert_eq!(verify().status, Some(1), "{}", verify());
}

/// A limit that is exceeded leaves a check unmade; only `--require` makes that an error.
#[test]
fn what_is_too_large_is_not_checked() {
    let place = Place::new().file("pathbuild.toml", "[limits]\nverify-cells = 100\n").file("a.nc", GOOD);
    let run = place.run(&format!("verify a.nc {OPTIONS}"));
    assert!(run.status == Some(0) && run.stderr.contains("rapid moves (the program is too large"), "{run}");
    let run = place.run(&format!("verify a.nc {OPTIONS} --require rapids"));
    assert!(run.status == Some(1) && run.stderr.contains("PB523"), "{run}");
    assert!(
        run.stderr
            .contains("(the program is too large: higher verify-cells and verify-pieces under [limits])"),
        "{run}"
    );
}
