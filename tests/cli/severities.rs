//! Configured severities decide whether a program is written: a raised warning stops it, and a lowered error stops it with a reason.
//! (book: reference/diagnostics)

use crate::support::{Place, Run};

/// A component with a letter that has no effect (PB210), and a project that embeds it.
const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["."]
spindle = "manual"
feed = 150
rapid = 1000
sweep-height = 20
== 1234.1P.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0 "B3 D1"
end 40,0
== 8001.1P.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
end 40,0
"#;

/// A post definition that writes the length of each tool, which is not configured (PB754).
const POST: &str = "<PostProcessor><PostFile>({$tool.length})\n{$mops}</PostFile></PostProcessor>";

/// Adds a table at the end of the library's configuration.
fn with(place: Place, table: &str) -> Place {
    let configuration = place.read("pathbuild.toml");
    let own = configuration.split("\n[").next().unwrap_or_default().trim_end();
    place.file("pathbuild.toml", format!("{own}\n{table}\n"))
}

fn codes(run: &Run) -> Vec<&str> {
    let codes = run.stderr.lines().chain(run.stdout.lines()).filter_map(|line| line.split_once("[PB"));
    codes.map(|(_, rest)| &rest[..3]).collect()
}

#[track_caller]
fn assert_stopped(place: &Place, arguments: &str, expected: &[&str]) {
    let run = place.run(arguments);
    assert_eq!((run.status, codes(&run)), (Some(1), expected.to_vec()), "{arguments}: {run}");
    let outputs = ["1234.1P_Milling.gcode", "8001.1P_Milling.gcode", "1234.1P_Milling.nc", "x.html", "x.nc"];
    let is_there = |name: &&str| place.path().join(name).exists();
    assert_eq!(outputs.into_iter().find(is_there), None, "{arguments}");
}

#[test]
fn a_raised_warning_stops_every_program_that_it_concerns() {
    let place = with(Place::of(LIBRARY), "[severity]\nPB210 = \"error\"");
    for arguments in [
        "emit 1234.1P",
        "emit 8001.1P",
        "emit 1234.1P --post linuxcnc",
        "emit 1234.1P --post linuxcnc --join x",
        "emit 1234.1P -o -",
        "emit 1234.1P --no-cache",
        "sheet 1234.1P -o x.html",
    ] {
        assert_stopped(&place, arguments, &["210"]);
    }
    let place = with(place, "[severity]\nPB210 = \"warning\"");
    let run = place.run("emit 8001.1P");
    assert_eq!((run.status, codes(&run)), (Some(0), vec!["210"]), "{run}");
}

#[test]
fn a_glob_that_matches_no_file_is_named() {
    let configuration = |globs: &str| {
        format!(
            "library = [\".\"]\nout-dir = \"gcode\"\n[[severity-in]]\nfiles = {globs}\nPB521 = \"error\"\n"
        )
    };
    let fixture =
        LIBRARY.replace("== 1234.1P", "== old/1234.1P").replace("== pathbuild.toml", "== unused.toml");
    let place = Place::of(&fixture);
    let named = |place: Place, globs: &str, arguments: &str| {
        let place = place.file("pathbuild.toml", configuration(globs));
        let run = place.run(&format!("{arguments} --format concise"));
        let is_named = run.stderr.contains("pathbuild.toml:4:1: warning[PB529]");
        assert_eq!(is_named, run.stderr.contains("PB529"), "{run}");
        (place, is_named)
    };
    let matching = [
        "['old/**']",
        "['OLD/*']",
        "['old/1234.1P.dxf']",
        "['**/*.dxf']",
        "['*']",
        "['**/old/**']",
        "['{old,new}/**']",
    ];
    let others = [
        "['old']",
        "['old/']",
        "['./old/**']",
        "['/old/**']",
        "['old\\1234.1P.dxf']",
        "[' old/**']",
        "['']",
        "['../old/**']",
        "['old/**', 'new/**']",
        "['1234*']",
    ];
    // Globs for programs are only checked once there are programs.
    let programs = ["['gcode/**']", "['*.nc']", "['gcode/*.ngc']"];
    let mut place = place;
    let mut is_named;
    for (globs, expected) in
        matching.map(|globs| (globs, false)).into_iter().chain(others.map(|globs| (globs, true)))
    {
        for arguments in ["check", "check --no-cache"] {
            (place, is_named) = named(place, globs, arguments);
            assert_eq!(is_named, expected, "{globs} {arguments}");
        }
    }
    for globs in programs {
        (place, is_named) = named(place, globs, "check");
        assert!(!is_named, "{globs}");
    }
    place = place.file("gcode/a.nc", "M30\n").file(".gitignore", "gcode\n");
    for (globs, expected) in programs.into_iter().zip([false, true, true]) {
        (place, is_named) = named(place, globs, "check");
        assert_eq!(is_named, expected, "{globs}");
    }
    (place, is_named) = named(place, "['new/**']", "check old");
    assert!(!is_named, "a directory is not the library");
    let place = place.file("pathbuild.toml", configuration("[]"));
    let run = place.run("check");
    assert!(run.status == Some(2) && run.stderr.contains("PB003"), "{run}");
}

#[test]
fn a_warning_that_is_raised_later_leaves_the_earlier_program_and_names_it() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit .").status, Some(0));
    let before = place.read("1234.1P_Milling.gcode");
    let place = with(place, "[[severity-in]]\nfiles = [\"1234*\"]\nPB210 = \"error\"");
    let run = place.run("emit . --remove-stale");
    assert_eq!((run.status, codes(&run)), (Some(1), vec!["210", "522", "522"]), "{run}");
    assert_eq!(place.read("1234.1P_Milling.gcode"), before);
    let place = with(place, "");
    let run = place.run("emit .");
    assert_eq!((run.status, codes(&run)), (Some(0), vec!["210"]), "{run}");
}

#[test]
fn a_raised_warning_of_a_post_stops_the_program() {
    let tool = "[tool.other]\ndiameter = 3\nspindle = 9000";
    let place =
        with(Place::of(LIBRARY), &format!("{tool}\n[severity]\nPB210 = \"ignore\"\nPB764 = \"error\""));
    for _ in 0..2 {
        assert_stopped(&place, "emit 1234.1P --post linuxcnc", &["764"]);
    }
    let place = with(place, &format!("{tool}\n[severity]\nPB210 = \"ignore\""));
    for _ in 0..2 {
        let run = place.run("emit 1234.1P --post linuxcnc");
        assert_eq!((run.status, codes(&run)), (Some(0), vec!["764"]), "{run}");
    }
    let place = with(place, &format!("{tool}\n[severity]\nPB210 = \"ignore\"\nPB764 = \"error\""));
    let run = place.run("emit 1234.1P --post linuxcnc");
    assert_eq!((run.status, codes(&run)), (Some(1), vec!["764", "522"]), "{run}");
}

#[test]
fn a_lowered_error_stops_the_program_and_says_so() {
    for level in ["ignore", "warning"] {
        let table = format!("[severity]\nPB210 = \"ignore\"\nPB754 = \"{level}\"");
        let place = with(Place::of(LIBRARY).file("my.cbpp", POST), &table);
        let expected: &[&str] = if level == "ignore" { &["524"] } else { &["754", "524"] };
        for arguments in [
            "emit 1234.1P --post my.cbpp",
            "emit 1234.1P --post my.cbpp",
            "emit 1234.1P --post my.cbpp -o -",
            "sheet 1234.1P --post my.cbpp -o x.html",
        ] {
            let run = place.run(arguments);
            let mut found = codes(&run);
            found.sort_by_key(|code| *code == "524");
            assert_eq!((run.status, &found[..]), (Some(1), expected), "{arguments}: {run}");
        }
    }
}

#[test]
fn severities_hold_for_rewritten_programs_too() {
    let place = Place::of(LIBRARY)
        .file("p.nc", "G21 G90 G17\nM3 S9000\nG0 Z5\nT4\nG0 X0 Y0\nG1 Z-1 F100\nG0 Z5\nM5\nM30\n");
    let run = place.run("post p.nc --dialect linuxcnc --surface 0 --post my.cbpp -o x.nc");
    assert_ne!(run.status, Some(0), "there is no such definition: {run}");
    let place = with(place.file("my.cbpp", POST), "[severity]\nPB754 = \"ignore\"");
    assert_stopped(&place, "post p.nc --dialect linuxcnc --surface 0 --post my.cbpp -o x.nc", &["524"]);
}

/// Each command whose result depends on a waiver with an end date reports the date with which the end date was compared.
#[test]
fn commands_name_the_date_that_decided_a_waiver() {
    let place = |until: &str| {
        let table =
            format!("[[severity-in]]\nfiles = [\"*\"]\nPB210 = \"ignore\"\nreason = \"later\"\n{until}");
        with(Place::of(LIBRARY), &table)
    };
    for command in ["check", "emit 1234.1P", "list", "sheet 1234.1P", "view 1234.1P -o x.svg"] {
        let mentions = |until: &str| {
            let run = place(until).run(command);
            assert!(!run.stderr.contains("[PB210]"), "{run}");
            run.stderr.matches("waivers with an end were compared with").count()
        };
        assert_eq!((mentions("until = 2031-12-31"), mentions("")), (1, 0), "{command}");
    }
}
