//! Special or endless files in an untrusted tree are reported, and do not block. (book: reference/configuration)
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::os::unix::net::UnixListener;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::{Place, Run};
use pathbuild_testkit::sheet;

const CONFIGURATION: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\nlibrary = [\".\"]\n";

fn dxf() -> Vec<u8> {
    let drawn = "layer 1202.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0";
    sheet(drawn).unwrap().to_dxf()
}

/// Kinds of special files.
const KINDS: [&str; 4] = ["device", "fifo", "socket", "link to a fifo"];

fn place(kind: &str, name: &str) -> Place {
    let place = Place::new().file("pathbuild.toml", CONFIGURATION).file("1202.1P.dxf", dxf());
    let path = place.path().join(name);
    _ = fs::remove_file(&path);
    let fifo = |path: &Path| {
        assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
    };
    match kind {
        "device" => symlink("/dev/zero", path).unwrap(),
        "fifo" => fifo(&path),
        "socket" => drop(UnixListener::bind(path).unwrap()),
        _ => {
            let beside = place.path().join("beside");
            fifo(&beside);
            symlink(beside, path).unwrap();
        }
    }
    place
}

/// Runs a command on trees in which a name is each kind of special file in turn.
#[track_caller]
fn each(name: &str, command: &str, status: i32, expected: &str) {
    for kind in KINDS {
        let begun = Instant::now();
        let run: Run = place(kind, name).run(command);
        assert!(begun.elapsed() < Duration::from_secs(20), "{kind}: {run}");
        assert_eq!(run.status, Some(status), "{kind}: {run}");
        assert!(run.stderr.contains(expected) || run.stdout.contains(expected), "{kind}: {run}");
    }
}

#[test]
fn a_drawing_must_be_a_file() {
    each("1300.1P.dxf", "check", 1, "PB001");
    each("1300.1P.dxf", "check 1300.1P.dxf", 1, "PB001");
    each("1300.1P.dxf", "emit .", 1, "PB001");
    each("1300.1P.dxf", "texts .", 1, "PB001");
}

#[test]
fn a_file_of_rules_must_be_a_file() {
    each(".gitignore", "check", 1, "not a regular file");
    each(".ignore", "check", 1, "not a regular file");
    each(".gitignore", "emit .", 1, "not a regular file");
}

/// Writing to a pipe without a reader fails at once; an existing reader gets everything.
#[test]
fn a_report_into_a_pipe_has_a_reader_or_is_refused() {
    for (arguments, status, code) in
        [("--report json=pipe", 1, "PB004"), ("--baseline pipe --update-baseline", 2, "PB003")]
    {
        let place = place("fifo", "pipe");
        let run = place.run(&format!("check 1202.1P.dxf {arguments}"));
        assert_eq!((run.status, run.stderr.contains(code)), (Some(status), true), "{run}");
    }
    let place = place("fifo", "pipe");
    let reader =
        Command::new("cat").arg("pipe").current_dir(place.path()).stdout(Stdio::piped()).spawn().unwrap();
    // The process reads from the pipe only after it has started.
    let written = (0..100).any(|_| {
        std::thread::sleep(Duration::from_millis(50));
        place.run("check 1202.1P.dxf --report json=pipe").status == Some(0)
    });
    let read = reader.wait_with_output().unwrap().stdout;
    assert!(
        written && String::from_utf8_lossy(&read).contains("\"exit_status\":0"),
        "{}",
        String::from_utf8_lossy(&read)
    );
}

#[test]
fn a_configuration_that_leads_nowhere_is_none_that_can_be_read() {
    let place = Place::new().file("pathbuild.toml", CONFIGURATION).file("sub/1202.1P.dxf", dxf());
    let check = || place.run_in("sub", &["check", "."]);
    assert_eq!(check().status, Some(0));
    symlink("nowhere.toml", place.path().join("sub/pathbuild.toml")).unwrap();
    let run = check();
    assert_eq!((run.status, run.stderr.contains("PB003")), (Some(2), true), "{run}");
}

#[test]
fn a_configuration_must_be_a_file() {
    each("pathbuild.toml", "check", 2, "PB003");
    each("other.toml", "check --config other.toml", 2, "PB003");
}

#[test]
fn what_is_written_over_must_be_a_file() {
    each("1202.1P_Milling.gcode", "emit .", 1, "PB004");
    each("1202.1P_Milling.gcode", "emit --check .", 1, "not current");
    // Special files that do not have the name of a program are left alone.
    each("x_Milling.gcode", "emit .", 0, "written");
}

#[test]
fn what_else_is_named_must_be_a_file() {
    each("m.cbpp", "emit . --post ./m.cbpp", 1, "PB001");
    each("b.txt", "check . --baseline b.txt", 2, "PB003");
    each("a.gcode", "import a.gcode", 1, "PB001");
    each("a.gcode", "verify a.gcode", 1, "PB001");
    each("a_Z.txt", "adjust a --max-correction 1", 1, "PB001");
    each("out.ngc", "post 1202.1P.dxf --post linuxcnc -o out.ngc", 1, "PB");
}

/// A drawing that cannot be read is an error, since its picture would be empty.
#[test]
fn what_cannot_be_read_is_not_drawn() {
    for extension in ["svg", "html", "json"] {
        each("1202.1P.dxf", &format!("view 1202.1P.dxf -o x.{extension}"), 1, "PB001");
    }
    for kind in KINDS {
        let place = place(kind, "1202.1P.dxf").file("b.svg", "before");
        let run = place.run("view 1202.1P.dxf -o b.svg");
        assert!(run.stderr.contains("PB001") && !run.stderr.contains("b.svg"), "{kind}: {run}");
        assert_eq!(place.read("b.svg"), "before");
        // Now the picture cannot be written.
        let place = self::place(kind, "b.svg");
        let run = place.run("view 1202.1P.dxf -o b.svg");
        assert!(run.stderr.contains("PB004") && !run.stderr.contains("written\n"), "{kind}: {run}");
    }
    for drawing in ["no drawing", "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n"] {
        let place = Place::new().file("a.dxf", drawing).file("b.svg", "before");
        let run = place.run("view a.dxf -o b.svg");
        assert!(run.status == Some(1) && !run.stderr.contains("b.svg"), "{run}");
        assert_eq!(place.read("b.svg"), "before");
    }
}

/// Each limit is tested with one input just inside and one just outside.
#[test]
fn files_have_limits_with_names() {
    let place = |rules: &str| {
        Place::new()
            .file("pathbuild.toml", format!("{CONFIGURATION}[limits]\nignore-file-size = 1000\n"))
            .file("1202.1P.dxf", dxf())
            .file(".ignore", rules)
    };
    let inside = place(&"#".repeat(1000)).run("check");
    assert_eq!(inside.status, Some(0), "{inside}");
    let outside = place(&"#".repeat(1001)).run("check");
    assert_eq!(outside.status, Some(1), "{outside}");
    assert!(outside.stderr.contains("PB005") && outside.stderr.contains("ignore-file-size"), "{outside}");

    let long_line = |length| {
        let place = Place::new().file("pathbuild.toml", CONFIGURATION).file("1202.1P.dxf", dxf());
        place.file(".ignore", format!("{}\n", "x".repeat(length))).run("check")
    };
    assert_eq!(long_line(4096).status, Some(0));
    assert!(long_line(4097).stderr.contains(".ignore:1"), "{}", long_line(4097));

    let configuration = |length: usize| {
        let text = format!("{CONFIGURATION}#{}", " ".repeat(length - CONFIGURATION.len() - 1));
        Place::new().file("pathbuild.toml", text).file("1202.1P.dxf", dxf()).run("check")
    };
    assert_eq!(configuration(4 << 20).status, Some(0));
    assert!(configuration((4 << 20) + 1).stderr.contains("PB003"));
}

/// Tests ignore rules in our own directory walk: names, negation, directories, hidden names, rules of nested repositories.
#[test]
fn rules_say_what_counts() {
    let place = Place::new()
        .file("pathbuild.toml", CONFIGURATION)
        .file(".gitignore", "out/\n*old*\n!1204*\n/top/*.dxf\n!.kept/\n")
        .file(".ignore", "1205*\n")
        .file("sub/.ignore", "!1205.2*\n")
        .file("sub/.gitignore", "# nothing\n1206*\n")
        .file("repository/.git/config", "");
    let names = [
        "1202.1P.dxf",
        "out/1203.1P.dxf",
        "1203.1P old.dxf",
        "1204.1P old.dxf",
        "top/1203.2P.dxf",
        "sub/top/1203.3P.dxf",
        "1205.1P.dxf",
        "sub/1205.1P.dxf",
        "sub/1205.2P.dxf",
        "sub/1206.1P.dxf",
        "1206.1P.dxf",
        ".hidden/1207.1P.dxf",
        ".kept/1208.1P.dxf",
        "repository/1209.1P old.dxf",
        "repository/1205.3P.dxf",
    ];
    let place = names.iter().fold(place, |place, name| place.file(name, "no drawing"));
    let run = place.run("check --format concise");
    let mut found: Vec<&str> =
        run.stderr.lines().filter_map(|line| line.split_once(":1: error").map(|it| it.0)).collect();
    found.sort_unstable();
    assert_eq!(
        found,
        [
            ".kept/1208.1P.dxf",
            "1202.1P.dxf",
            "1204.1P old.dxf",
            "1206.1P.dxf",
            "repository/1209.1P old.dxf",
            "sub/1205.2P.dxf",
            "sub/top/1203.3P.dxf",
        ],
        "{run}"
    );
}

/// A directory whose path is too long for the system cannot be listed. This is reported instead of skipping its content.
#[test]
fn directories_too_deep_for_the_system_are_told() {
    for (depth, status) in [(2, 0), (10, 1)] {
        let place = Place::new().file("1202.1P.dxf", dxf());
        let below = |levels: usize| place.path().join(vec!["d".repeat(200); levels].join("/"));
        fs::create_dir_all(below(depth)).unwrap();
        // The system does not accept the long path at once, so it is built by renaming.
        let aside = place.path().join("aside");
        fs::rename(below(1), &aside).unwrap();
        fs::create_dir_all(below(15)).unwrap();
        fs::rename(aside, below(15).join("aside")).unwrap();
        let run = place.run("check . --format concise");
        assert_eq!(run.status, Some(status), "{run}");
        assert_eq!(run.stderr.contains("PB001"), status == 1, "{run}");
        assert!(run.stderr.contains("1 path in 1 drawing"), "{run}");
    }
}

#[test]
fn globs_and_expressions_that_go_too_deep_are_refused() {
    for targets in [
        "{a,".repeat(200) + "b*" + &"}".repeat(200),
        "[a".repeat(300),
        "{a,".repeat(300) + &"}".repeat(300),
        "x".repeat(1001),
    ] {
        let place = Place::new()
            .file("pathbuild.toml", format!("{CONFIGURATION}[emit]\ntargets = [\"{targets}\"]\n"));
        let run = place.run("config show");
        assert_eq!(run.status, Some(2), "{run}");
        assert!(run.stderr.contains("PB003"), "{run}");
    }
    let place = Place::new()
        .file("pathbuild.toml", format!("{CONFIGURATION}[emit]\ntargets = [\"{}\"]\n", "x".repeat(1000)));
    assert_eq!(place.run("config show").status, Some(0));
}

/// A configuration has many faults, on many lines or on a single one: the cost of each does not grow with the file.
#[test]
fn a_configuration_of_many_faults_takes_no_square_of_them() {
    let entries: Vec<String> = (0..5_000).map(|key| format!("unknown{key} = \"error\"")).collect();
    let keys = entries.join("\n");
    for text in [
        format!("[severity]\n{keys}\n"),
        format!("[limits]\n{keys}\n"),
        format!("severity = {{ {} }}\n", entries.join(", ")),
    ] {
        let begun = Instant::now();
        let run = Place::new().file("pathbuild.toml", text).run("config show --format concise");
        assert_eq!((run.status, run.stderr.lines().count()), (Some(2), 5_000));
        assert!(begun.elapsed() < Duration::from_mins(1), "{:?}", begun.elapsed());
    }
}

/// Work that ends just as it is cancelled does not affect the next query.
#[test]
fn a_time_limit_ends_in_its_code() {
    let drawn = "layer 1202.1P\nstart 0,0 \"T5 O2 I0.0001 B0 MX\"\nmill 0,0 40,0\nend 40,0";
    for seconds in ["0.02", "0.05", "0.1", "0.2", "0.4"] {
        let place = Place::new()
            .file("pathbuild.toml", format!("{CONFIGURATION}[limits]\nseconds-per-path = {seconds}\n"))
            .file("1202.1P.dxf", sheet(drawn).unwrap().to_dxf());
        let run = place.run("emit . --format concise");
        let is_written = place.path().join("1202.1P_Milling.gcode").exists();
        match run.status {
            Some(0) => assert!(is_written, "{run}"),
            _ => assert!(run.status == Some(1) && run.stderr.contains("PB005") && !is_written, "{run}"),
        }
    }
}

/// A killed run holds no lock, so the next run removes the files that it left; files that others are writing stay.
#[test]
fn what_killed_runs_left_goes_with_the_next_run() {
    let place = Place::new()
        .file("pathbuild.toml", CONFIGURATION)
        .file("1202.1P.dxf", dxf())
        .file(".1202.1P_Milling.gcode.4194304-0.tmp", "half")
        .file(".other.1-12.tmp", "half")
        .file(".mine.tmp", "not ours")
        .file(".held.1-0.tmp", "half");
    let held = fs::File::open(place.path().join(".held.1-0.tmp")).unwrap();
    held.lock().unwrap();
    let run = place.run("emit .");
    assert_eq!(run.status, Some(0), "{run}");
    let mut left: Vec<String> = fs::read_dir(place.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| Path::new(name).extension().is_some_and(|it| it == "tmp"))
        .collect();
    left.sort_unstable();
    assert_eq!(left, [".held.1-0.tmp", ".mine.tmp"]);
    drop(held);
}
