//! Tests `emit --check` with a cache: the answers are the same as without, whatever has changed in between, and no drawing is read if nothing has.
//! (book: reference/commands, `emit --check`)

use std::fs;
use std::time::Duration;

use crate::support::{Place, Run};

/// A library of two components, each of which is embedded by a project.
const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["components", "projects"]
search = ["components"]
spindle = "manual"
feed = 150
rapid = 1000
sweep-height = 20
[emit]
targets = ["8*"]
== components/1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
== components/1300.dxf ==
layer 1300.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
== projects/8001.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
end 40,0
== projects/8002.dxf ==
layer 8002.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1300.1P"
probe 20,20 "LA"
end 40,0
"#;

const ALL_CURRENT: &str = "4 current, 0 not current
";

/// Creates a library with programs that were just written.
fn emitted() -> Place {
    let place = Place::of(LIBRARY);
    let run = place.run("emit");
    assert_eq!(run.status, Some(0), "{run}");
    place
}

/// Replaces a part of a file of the library.
fn with(place: Place, file: &str, from: &str, to: &str) -> Place {
    let drawn = Place::of(&LIBRARY.replace(from, to));
    let bytes = fs::read(drawn.path().join(file)).unwrap();
    assert_ne!(fs::read(place.path().join(file)).unwrap(), bytes, "nothing was exchanged");
    place.file(file, bytes)
}

fn output(run: &Run) -> (Option<i32>, &str, &str) {
    (run.status, &run.stdout, &run.stderr)
}

/// Returns the output of a check, after asserting that it is the same with the current cache, with the cache of that run, and without a cache.
#[track_caller]
fn consistent_output(place: &Place, arguments: &str) -> Run {
    let without = place.run(&format!("emit --check --no-cache {arguments}"));
    for _ in 0..2 {
        assert_eq!(output(&place.run(&format!("emit --check {arguments}"))), output(&without));
    }
    assert!(is_known(place, arguments), "what was found was not kept");
    without
}

/// Whether a check reads no drawing.
fn is_known(place: &Place, arguments: &str) -> bool {
    let (paths, drawings) = known(&place.run(&format!("emit --check -v {arguments}")));
    paths.0 == paths.1 && drawings.0 == drawings.1
}

/// Returns the numbers of cached and of all paths, and the numbers of cached and of all drawings.
fn known(run: &Run) -> ((u32, u32), (u32, u32)) {
    let count = |phrase: &str| {
        let line =
            run.stderr.lines().find_map(|line| line.strip_prefix(phrase)).unwrap_or_else(|| panic!("{run}"));
        let (known, all) = line.trim_start_matches(": ").split_once(" / ").unwrap();
        (known.parse().unwrap(), all.parse().unwrap())
    };
    (count("paths with valid cached results"), count("drawings known from the cache"))
}

#[track_caller]
fn assert_outdated(place: &Place, file: &str) {
    let run = consistent_output(place, "");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stdout.contains(&format!("{file}: not current\n")), "{run}");
}

#[test]
fn after_emit_or_a_check_no_drawing_is_read() {
    let place = emitted();
    assert!(is_known(&place, ""));
    let run = consistent_output(&place, "");
    assert_eq!((run.status, &*run.stdout), (Some(0), ""), "{run}");
    for part in ["./projects", "projects", "--moves"] {
        assert!(is_known(&place, part), "{part}");
    }
    assert_eq!(consistent_output(&place, "projects").stderr, ALL_CURRENT);
    assert_eq!(consistent_output(&place, "--moves").stderr, ALL_CURRENT.replace('4', "3"));
}

#[test]
fn an_edited_drawing_is_noticed_and_its_mending_too() {
    let place = with(
        emitted(),
        "projects/8001.dxf",
        "layer 8001.1P\nstart 0,0 \"T5",
        "layer 8001.1P\nstart 0,0 \"T6",
    );
    assert!(!is_known(&place, ""));
    // The component is thinner than the plate, which is an error, so its program is now older than the drawing.
    let run = consistent_output(&place, "");
    assert_eq!(run.status, Some(1), "{run}");
    let rows = place.run("emit --check --format json").stdout;
    let row = rows.lines().find(|row| row.contains("8001_Milling.gcode")).unwrap_or_default();
    assert!(row.contains("\"path\":\"8001.1P\""), "{rows}");
    assert!(run.stdout.contains("8001_Milling.gcode: not current"), "{run}");
    let place = with(
        place,
        "projects/8001.dxf",
        "subpath 0,0 40,0 \">1234.1P\"\nend 40,0",
        "subpath 0,0 40,0 \">1234.1P\"\nend 40,0\nlayer 8001.2P\nstart 0,50 \"T5 O2 MPlate I1 B4\"\nmill 0,50 40,50\nend 40,50",
    );
    // The drawing now has two paths, so the program has another name.
    let run = consistent_output(&place, "");
    assert!(run.stdout.contains("missing"), "{run}");
}

#[test]
fn an_edited_embedded_component_is_noticed() {
    let place = with(
        emitted(),
        "components/1234.dxf",
        "mill 0,0 40,0\nend 40,0\n== components/1300",
        "mill 0,0 40,1\nmill 40,1 40,0\nend 40,0\n== components/1300",
    );
    assert_outdated(&place, "projects/8001_Milling.gcode");
}

#[test]
fn a_file_that_makes_a_path_ambiguous_is_noticed() {
    let place = emitted();
    let bytes = fs::read(place.path().join("components/1234.dxf")).unwrap();
    let place = place.file("components/1230-1240.dxf", bytes);
    assert!(!is_known(&place, ""));
    let run = consistent_output(&place, "");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("1230-1240.dxf"), "{run}");
    assert!(run.stdout.contains("8001_Milling.gcode: not current"), "{run}");
    fs::remove_file(place.path().join("components/1230-1240.dxf")).unwrap();
    assert_eq!(consistent_output(&place, "").stderr, ALL_CURRENT);
}

#[test]
fn a_changed_setting_is_noticed() {
    let place = emitted();
    let configuration = place.read("pathbuild.toml");
    let place = place.file("pathbuild.toml", configuration.replace("feed = 150", "feed = 160"));
    assert_outdated(&place, "projects/8001_Milling.gcode");
    let place = place.file("pathbuild.toml", configuration.replace("\"8*\"", "\"8*\", \"9*\""));
    let run = consistent_output(&place, "");
    assert!(run.stderr.contains("9*") && run.status == Some(1), "{run}");
    // The line numbers in messages about the configuration have changed.
    let moved = format!("\n{}", place.read("pathbuild.toml"));
    let place = place.file("pathbuild.toml", moved);
    consistent_output(&place, "");
    let place = place.file("pathbuild.toml", configuration);
    assert_eq!(consistent_output(&place, "").stderr, ALL_CURRENT);
}

#[test]
fn a_program_edited_by_hand_is_noticed_and_one_of_the_same_bytes_is_current() {
    let place = emitted();
    let program = place.read("projects/8001_Milling.gcode");
    // The edited program has the same size.
    let place = place.file("projects/8001_Milling.gcode", program.replacen("150", "151", 1));
    assert_outdated(&place, "projects/8001_Milling.gcode");
    let place = place.file("projects/8001_Milling.gcode", program);
    assert_eq!(consistent_output(&place, "").stderr, ALL_CURRENT);
}

#[test]
fn a_removed_program_is_noticed_and_one_that_comes_back_too() {
    let place = emitted();
    let program = place.read("projects/8002_Probing.gcode");
    fs::remove_file(place.path().join("projects/8002_Probing.gcode")).unwrap();
    let run = consistent_output(&place, "");
    assert!(run.stdout.contains("projects/8002_Probing.gcode: missing\n"), "{run}");
    let place = place.file("projects/8002_Probing.gcode", program);
    assert_eq!(consistent_output(&place, "").stderr, ALL_CURRENT);
}

#[test]
fn measured_values_are_current_as_long_as_the_probes_are_the_same() {
    let place = emitted();
    let values = place.read("projects/8002_Z.txt");
    let place = place.file("projects/8002_Z.txt", values.replace("=\n", "=0.25\n"));
    assert_eq!(consistent_output(&place, "").stderr, ALL_CURRENT);
    let place = place.file("projects/8002_Z.txt", "#1 = 0.1\n#2 = 0.2\n");
    assert_outdated(&place, "projects/8002_Z.txt");
    assert_eq!(
        consistent_output(&place, "--moves").stderr,
        ALL_CURRENT.replace('4', "3"),
        "values are no moves"
    );
}

/// The program of a drawing that cannot be read is named like that of a drawing with errors, and is not removed.
#[test]
fn the_program_of_an_unreadable_drawing_is_out_of_date() {
    let place = emitted().file("projects/8001.dxf", "");
    let run = consistent_output(&place, "");
    assert!(run.status == Some(1) && run.stderr.contains("error[PB522]"), "{run}");
    assert_eq!(run.stdout, "projects/8001_Milling.gcode: not current\n", "{run}");
    let run = place.run("emit --remove-stale --lang de");
    assert!(run.stderr.contains("8001_Milling.gcode wurde für 8001.dxf geschrieben"), "{run}");
    assert!(place.path().join("projects/8001_Milling.gcode").exists(), "{run}");
}

#[test]
fn a_program_that_nothing_would_write_is_noticed_and_its_removal_too() {
    let place = emitted();
    let program = place.read("projects/8001_Milling.gcode").replace("8001", "8009");
    let place = place.file("projects/8009_Milling.gcode", program);
    let run = consistent_output(&place, "");
    assert!(run.stderr.contains("PB520") && run.status == Some(1), "{run}");
    assert!(run.stdout == "projects/8009_Milling.gcode: not current\n", "{run}");
    fs::remove_file(place.path().join("projects/8009_Milling.gcode")).unwrap();
    assert!(!consistent_output(&place, "").stderr.contains("PB520"));
}

#[test]
fn a_new_drawing_and_one_that_is_gone_are_noticed() {
    let place = emitted();
    let bytes = fs::read(place.path().join("projects/8001.dxf")).unwrap();
    let place = place.file("projects/deep/8005.dxf", bytes);
    assert!(!is_known(&place, ""));
    let run = consistent_output(&place, "");
    assert!(run.stdout.contains("projects/deep/8005_Milling.gcode: missing"), "{run}");
    fs::remove_file(place.path().join("projects/deep/8005.dxf")).unwrap();
    fs::remove_file(place.path().join("projects/8002.dxf")).unwrap();
    let run = consistent_output(&place, "");
    assert!(
        run.stderr.contains("PB520") && run.stdout.contains("projects/8002_Clean.gcode: not current"),
        "{run}"
    );
    assert!(!run.stdout.contains("missing"), "{run}");
}

#[test]
fn an_edited_post_is_noticed() {
    let post = |who: &str| {
        format!(
            "<PostProcessor><PostFile>({who})\n{{$mops}}</PostFile>\
             <PostBuildCommand>/bin/cp</PostBuildCommand></PostProcessor>"
        )
    };
    let library = LIBRARY.replace("probe 20,20 \"LA\"\n", "");
    let place = Place::of(&library).file("my.cbpp", post("bert"));
    let run = place.run("emit --post my.cbpp");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(is_known(&place, "--post my.cbpp"));
    assert!(!is_known(&place, ""));
    let run = consistent_output(&place, "--post my.cbpp");
    assert!(run.stderr.contains(" 0 not current\n") && run.stderr.contains("was not run"), "{run}");
    let place = place.file("my.cbpp", post("anna"));
    assert!(!is_known(&place, "--post my.cbpp"));
    let run = consistent_output(&place, "--post my.cbpp");
    assert!(run.stdout.contains(": not current\n") && run.status == Some(1), "{run}");
}

/// A file inserted by a post is an input of the programs like the post itself, however the post spells its name, even if a macro contains the name.
#[test]
fn an_edited_file_that_a_post_inserts_is_noticed() {
    let library = LIBRARY.replace("probe 20,20 \"LA\"\n", "");
    for name in ["head.nc", "he\\u0061d.nc", "~Head~"] {
        let texts = "comment = '(~CommentText~)'\nline = 'G01 X{.~X1~} Y{.~Y1~} Z{.~Z1~} F{.~MovingVel~}'\n\
            rapid = 'G00 X{.~X1~} Y{.~Y1~} Z{.~Z1~}'\n";
        let start = format!("program-start = \"\\\\\\\\\\\\~*{name}*\"\n");
        let post = format!("[post]\nname = \"mine\"\nextension = \"nc\"\n[text]\n{texts}{start}");
        let place = Place::of(&library).file("my.toml", post).file("head.nc", "(a)\n");
        let configuration = place.read("pathbuild.toml") + "[macros]\nHead = 'head.nc'\n";
        let place = place.file("pathbuild.toml", configuration);
        let run = place.run("emit --post my.toml");
        assert_eq!(run.status, Some(0), "{run}");
        assert!(consistent_output(&place, "--post my.toml").stderr.contains(" 0 not current\n"));
        let place = place.file("head.nc", "(b)\n");
        let run = consistent_output(&place, "--post my.toml");
        assert!(run.stdout.contains(": not current\n") && run.status == Some(1), "{run}");
        let place = place.file("head.nc", "(a)\n");
        assert!(consistent_output(&place, "--post my.toml").stderr.contains(" 0 not current\n"));
    }
}

/// A fault is cached with its file: an identical post has the fault in its own file.
#[test]
fn a_fault_of_a_post_is_in_its_own_file() {
    let post = "<PostProcessor><PostFile>{$mops}{$nothing}</PostFile></PostProcessor>";
    let place = Place::of(LIBRARY).file("a.cbpp", post).file("b.cbpp", post);
    for (name, is_known) in [("a", 0), ("a", 1), ("b", 0), ("b", 1)] {
        let run = place.run(&format!("emit 8001.1P --post {name}.cbpp --format concise -v"));
        assert_eq!(known(&run).0, (is_known, 1), "{run}");
        assert!(
            run.status == Some(1) && run.stderr.contains(&format!("{name}.cbpp:1: error[PB751]")),
            "{run}"
        );
    }
}

/// Results name files relative to the working directory. The copy of a drawing in a subdirectory has the same name there, but another program.
#[test]
fn results_hold_where_they_were_asked_for() {
    let configuration =
        "feed = 150\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\nout-dir = \"out\"\n";
    let drawn = "layer 1202.1P\nstart 0,0 \"T5 O2 I1 B4 MX\"\nmill 0,0 10,0\nend 10,0\n";
    let place = Place::of(&format!(
        "== pathbuild.toml ==\n{configuration}== a/1202.dxf ==\n{drawn}== a/a/1202.dxf ==\n{drawn}\
         == a/a/a/1202.dxf ==\n{drawn}"
    ));
    for directory in [".", "a"] {
        assert_eq!(place.run_in(directory, &["emit", "a/1202.dxf"]).status, Some(0));
    }
    for (directory, is_known) in [(".", 1), ("a", 1), ("a/a", 0)] {
        let run = place.run_in(directory, &["emit", "--check", "-v", "a/1202.dxf"]);
        assert_eq!((run.status, known(&run).0), (Some(0), (is_known, 1)), "{directory}: {run}");
    }
}

/// A timeout is not cached, because the machine may have been busy. One path has many passes, the other one so many lines that the walk takes time.
#[test]
fn what_took_too_long_is_asked_again() {
    let lines: Vec<String> =
        (0..10_000).map(|x| format!("mill {x},{} {},{}\n", x % 2, x + 1, (x + 1) % 2)).collect();
    for (seconds, bottom, drawn) in
        [("0.1", "-2000000", "mill 0,0 10000,0\n"), ("0.001", "0", &*lines.concat())]
    {
        let configuration = "feed = 150\nrapid = 1000\nsweep-height = 20\n[limits]\nseconds-per-path = ";
        let place = Place::of(&format!(
            "== pathbuild.toml ==\n{configuration}{seconds}\n== 1202.1P.dxf ==\n\
             layer 1202.1P\nstart 0,0 \"T5 O2 I1 B{bottom} MX\"\n{drawn}end 10000,0\n"
        ));
        for _ in 0..3 {
            let run = place.run("emit ./1202.1P.dxf -v");
            assert!(run.status == Some(1) && run.stderr.contains("seconds-per-path"), "{run}");
            assert_eq!(known(&run).0, (0, 1), "{run}");
        }
    }
}

fn programs(place: &Place) -> Vec<(std::path::PathBuf, std::time::SystemTime, Vec<u8>)> {
    let listed = fs::read_dir(place.path().join("projects")).unwrap().map(|entry| entry.unwrap().path());
    let mut programs: Vec<_> = listed
        .filter(|path| path.extension().is_none_or(|extension| extension != "dxf"))
        .map(|path| {
            (path.clone(), fs::metadata(&path).unwrap().modified().unwrap(), fs::read(&path).unwrap())
        })
        .collect();
    programs.sort();
    programs
}

#[test]
fn an_emit_with_nothing_changed_writes_nothing_and_says_the_same() {
    let place = emitted();
    let before = programs(&place);
    let without = place.run("emit --no-cache");
    assert!(without.stderr.contains("projects/8001_Milling.gcode: unchanged, "), "{without}");
    let run = place.run("emit");
    assert_eq!(output(&run), output(&without));
    assert_eq!(known(&place.run("emit -v")), ((2, 2), (4, 4)));
    assert_eq!(programs(&place), before);
}

#[test]
fn only_what_depends_on_an_edit_is_made_again() {
    let place = with(
        emitted(),
        "components/1234.dxf",
        "mill 0,0 40,0\nend 40,0\n== components/1300",
        "mill 0,0 40,1\nmill 40,1 40,0\nend 40,0\n== components/1300",
    );
    let before = programs(&place);
    let run = place.run("emit -v");
    assert_eq!(known(&run), ((1, 2), (3, 4)), "{run}");
    assert!(
        run.stderr.contains("8001_Milling.gcode: written")
            && !run.stderr.contains("8002_Clean.gcode: written")
    );
    let changed = programs(&place).iter().zip(&before).filter(|(now, before)| now != before).count();
    assert_eq!(changed, 1);
    assert!(is_known(&place, ""));
}

#[test]
fn a_program_that_was_changed_or_removed_by_hand_is_made_again() {
    let place = emitted();
    let before: Vec<_> = programs(&place).into_iter().map(|(path, _, bytes)| (path, bytes)).collect();
    for hand in [true, false] {
        for (path, bytes) in &before {
            // The edited file has the same size.
            let edited: Vec<u8> = bytes.iter().map(|byte| if *byte == b'1' { b'2' } else { *byte }).collect();
            if hand {
                fs::write(path, edited).unwrap();
            } else {
                fs::remove_file(path).unwrap();
            }
            // If the probes differ, the user's measured values would be lost.
            let run = place.run("emit");
            if run.stderr.contains("PB605") {
                fs::write(path, bytes).unwrap();
            }
            let now: Vec<_> = programs(&place).into_iter().map(|(path, _, bytes)| (path, bytes)).collect();
            assert_eq!(now, before, "{}: {run}", path.display());
        }
    }
}

#[test]
fn errors_are_kept_and_no_old_program_hides_them() {
    let place = with(
        emitted(),
        "projects/8001.dxf",
        "layer 8001.1P\nstart 0,0 \"T5",
        "layer 8001.1P\nstart 0,0 \"T6",
    );
    let without = place.run("emit --no-cache");
    assert_eq!(without.status, Some(1), "{without}");
    for _ in 0..2 {
        assert_eq!(output(&place.run("emit")), output(&without));
    }
    assert_eq!(known(&place.run("emit -v")).0, (2, 2));
}

#[test]
fn two_paths_that_claim_one_file_are_refused_though_one_is_known() {
    let place = emitted();
    let bytes = fs::read(place.path().join("projects/8001.dxf")).unwrap();
    let configuration = format!("out-dir = \"out\"\n{}", place.read("pathbuild.toml"));
    let place = place.file("pathbuild.toml", configuration);
    assert_eq!(place.run("emit").status, Some(0));
    let place = place.file("projects/deep/8001.dxf", bytes);
    for _ in 0..2 {
        let run = place.run("emit");
        assert!(run.stderr.contains("PB514") && !run.stderr.contains("8001_Milling.gcode: "), "{run}");
    }
}

#[test]
fn the_results_of_some_directories_leave_those_of_others() {
    let place = emitted();
    let configuration = place.read("pathbuild.toml").replace("\"8*\"", "\"*\"");
    let place = place.file("pathbuild.toml", configuration);
    place.run("emit");
    let place = with(
        place,
        "components/1300.dxf",
        "mill 0,0 40,0\nend 40,0\n== projects",
        "mill 0,0 40,1\nmill 40,1 40,0\nend 40,0\n== projects",
    );
    let run = place.run("emit projects -v");
    assert_eq!(known(&run), ((1, 2), (2, 2)), "{run}");
    // The component itself was not emitted, so its result is still outdated.
    assert_eq!(known(&place.run("emit -v")), ((3, 4), (3, 4)));
}

#[test]
fn a_program_that_cannot_be_read_is_not_current() {
    let place = emitted();
    fs::remove_file(place.path().join("projects/8001_Milling.gcode")).unwrap();
    fs::create_dir(place.path().join("projects/8001_Milling.gcode")).unwrap();
    for arguments in ["emit --check --no-cache", "emit --check", "emit --check"] {
        let run = place.run(arguments);
        assert_eq!(run.status, Some(1), "{run}");
        assert!(run.stdout.contains("projects/8001_Milling.gcode: not current\n"), "{run}");
    }
}

#[test]
fn programs_of_the_same_moves_are_not_taken_for_those_that_would_be_written() {
    let tasks = [("--moves", "3 current, 0 not current\n"), ("", "3 current, 1 not current\n")];
    let places = tasks.map(|_| {
        let place = Place::of(LIBRARY);
        place.run("emit --no-cache");
        let program = place.read("projects/8001_Milling.gcode").replace("M30", "(mine)\nM30");
        place.file("projects/8001_Milling.gcode", program)
    });
    // Stamps are cached only for files that have not changed for a while.
    std::thread::sleep(Duration::from_millis(3_500));
    for (place, (task, said)) in places.iter().zip(tasks) {
        let run = place.run(&format!("emit --check {task}"));
        assert!(run.stderr.ends_with(said) && run.stderr.contains("PB528") == task.is_empty(), "{run}");
        assert_eq!(place.run("emit --check").status, Some(1), "{task}");
        assert!(place.run("emit").stderr.contains("8001_Milling.gcode: written"), "{task}");
        assert!(!place.read("projects/8001_Milling.gcode").contains("mine"), "{task}");
    }
}

#[test]
fn a_copy_with_a_restored_cache_reads_no_drawing() {
    let caches = tempfile::TempDir::new().unwrap();
    let cache = caches.path().join("cache").display().to_string();
    let place = Place::of(LIBRARY);
    place.run_with(&["emit", "--cache-dir", &cache]);
    let copy = Place::of(LIBRARY);
    let copy = programs(&place).into_iter().fold(copy, |copy, (path, _, bytes)| {
        copy.file(&format!("projects/{}", path.file_name().unwrap().to_str().unwrap()), bytes)
    });
    let before = programs(&copy);
    let run = copy.run_with(&["emit", "-v", "--cache-dir", &cache]);
    assert_eq!(known(&run), ((2, 2), (4, 4)), "{run}");
    assert_eq!(programs(&copy), before);
}

#[test]
fn severities_are_those_of_the_run_that_shows_them() {
    let place = emitted();
    let program = place.read("projects/8001_Milling.gcode").replace("8001", "8009");
    let place = place.file("projects/8009_Milling.gcode", program);
    assert_eq!(consistent_output(&place, "").status, Some(1));
    let configuration = place.read("pathbuild.toml");
    let place = place.file("pathbuild.toml", format!("{configuration}[severity]\nPB520 = \"warning\"\n"));
    assert!(is_known(&place, ""));
    assert_eq!(consistent_output(&place, "").status, Some(0));
}

#[test]
fn without_a_configuration_nothing_is_kept() {
    let place = emitted();
    fs::remove_dir_all(place.cache()).unwrap();
    fs::remove_file(place.path().join("pathbuild.toml")).unwrap();
    place.run("emit --check ./projects --search components --feed 150 --rapid 1000 --sweep-height 20");
    assert!(!place.cache().exists());
}

/// Returns the output of repeated `emit` runs, after asserting that it is the same as without a cache, and that from the second run on no drawing
/// is read and no file written.
#[track_caller]
fn settles(place: &Place, arguments: &str) -> Run {
    place.run(&format!("emit {arguments}"));
    let before = programs(place);
    let without = place.run(&format!("emit --no-cache {arguments}"));
    for _ in 0..2 {
        assert_eq!(output(&place.run(&format!("emit {arguments}"))), output(&without));
        let (paths, drawings) = known(&place.run(&format!("emit -v {arguments}")));
        assert_eq!((paths.0, drawings.0), (paths.1, drawings.1), "{arguments}");
    }
    assert_eq!(programs(place), before, "{arguments}");
    without
}

/// Returns the numbers of cached and of all paths in the next `emit`.
fn paths_known(place: &Place, arguments: &str) -> (u32, u32) {
    known(&place.run(&format!("emit -v {arguments}"))).0
}

const POST: &str = "<PostProcessor><PostFile>{$mops}</PostFile></PostProcessor>";

/// Creates a library with two paths that can be joined.
fn joinable() -> Place {
    Place::of(&LIBRARY.replace("probe 20,20 \"LA\"\n", "")).file("my.cbpp", POST)
}

#[test]
fn whatever_is_named_is_made_once() {
    let place = Place::of(LIBRARY);
    let all =
        ["8001.1P", "8001", "projects/8002.dxf", "projects", ".", "8002.1P 8001", "projects 1300.1P", ""];
    for arguments in all {
        settles(&place, arguments);
    }
    // Each run can use the results of the others, whichever paths it names.
    for arguments in all {
        let (known, all) = paths_known(&place, arguments);
        assert_eq!(known, all, "{arguments}");
    }
    let place = joinable();
    for arguments in
        ["--post my.cbpp", "8001 8002 --join both --post my.cbpp", "8002 8001 --join both --post my.cbpp"]
    {
        settles(&place, arguments);
    }
}

#[test]
fn errors_of_what_is_named_are_known() {
    let place = with(
        emitted(),
        "projects/8001.dxf",
        "layer 8001.1P\nstart 0,0 \"T5",
        "layer 8001.1P\nstart 0,0 \"T6",
    );
    for arguments in ["8001.1P", "projects/8001.dxf", "projects"] {
        assert_eq!(settles(&place, arguments).status, Some(1));
    }
    // Programs with probes cannot be posted: the path is correct, but yields no program.
    let place = Place::of(LIBRARY).file("my.cbpp", POST);
    for arguments in ["8002.1P --post my.cbpp", "8001 8002 --join both --post my.cbpp"] {
        assert_eq!(settles(&place, arguments).status, Some(1));
    }
}

#[test]
fn a_new_definition_of_a_name_is_noticed_and_another_drawing_is_not() {
    let place = emitted();
    settles(&place, "8001.1P");
    let bytes = fs::read(place.path().join("projects/8001.dxf")).unwrap();
    let place = place.file("components/9000.dxf", bytes.clone());
    assert_eq!(paths_known(&place, "8001.1P"), (1, 1));
    let place = place.file("components/8001-8009.dxf", bytes);
    let run = settles(&place, "8001.1P");
    assert!(run.stderr.contains("PB504") && run.stderr.contains("8001-8009.dxf"), "{run}");
    fs::remove_file(place.path().join("components/8001-8009.dxf")).unwrap();
    assert_eq!(settles(&place, "8001.1P").status, Some(0));
}

#[test]
fn a_drawing_in_the_search_path_that_may_define_what_is_embedded_is_noticed() {
    let place = emitted();
    settles(&place, "8001.1P");
    let bytes = fs::read(place.path().join("components/1234.dxf")).unwrap();
    let place = place.file("components/1235-1240.dxf", bytes.clone());
    assert_eq!(paths_known(&place, "8001.1P"), (1, 1));
    let place = place.file("components/1230-1240.dxf", bytes);
    assert_eq!(paths_known(&place, "8001.1P"), (0, 1));
    assert!(settles(&place, "8001.1P").stderr.contains("1230-1240.dxf"));
}

#[test]
fn options_and_posts_of_what_is_named_count() {
    let place = joinable();
    for arguments in ["8001", "8001 8002 --join both --post my.cbpp"] {
        settles(&place, arguments);
        assert_eq!(
            paths_known(&place, &format!("{arguments} --feed 150")).0,
            paths_known(&place, arguments).1
        );
        assert_eq!(paths_known(&place, &format!("{arguments} --feed 160")).0, 0, "{arguments}");
        settles(&place, arguments);
    }
    let arguments = "8001 8002 --join both --post my.cbpp";
    let place = place.file("my.cbpp", POST.replace("{$mops}", "(other)\n{$mops}"));
    assert_eq!(paths_known(&place, arguments), (0, 2));
    settles(&place, arguments);
    // Another name, or another order of paths, gives another program.
    assert_eq!(paths_known(&place, "8001 8002 --join other --post my.cbpp"), (0, 2));
    assert_eq!(paths_known(&place, "8002 8001 --join both --post my.cbpp"), (0, 2));
    assert_eq!(paths_known(&place, arguments), (0, 2), "the file is of the paths in another order");
}

#[test]
fn a_joined_program_is_made_again_where_one_of_its_paths_or_its_file_changed() {
    let arguments = "8001 8002 --join both --post my.cbpp";
    let place = joinable();
    settles(&place, arguments);
    let program = place.read("projects/both_Milling.nc");
    fs::remove_file(place.path().join("projects/both_Milling.nc")).unwrap();
    assert_eq!(paths_known(&place, arguments), (0, 2));
    assert_eq!(place.read("projects/both_Milling.nc"), program);
    let place = place.file("projects/both_Milling.nc", program.replacen("40", "41", 1));
    settles(&place, arguments);
    assert_eq!(place.read("projects/both_Milling.nc"), program);
    let drawing = fs::read(place.path().join("components/1300.dxf")).unwrap();
    let edited = String::from_utf8(drawing).unwrap().replace("I1 B4", "I1 B3");
    let place = place.file("components/1300.dxf", edited);
    assert_eq!(paths_known(&place, arguments), (0, 2));
    assert_ne!(place.read("projects/both_Milling.nc"), program);
    settles(&place, arguments);
}

#[test]
fn a_path_that_gives_its_files_another_name_leaves_a_stale_program_on_every_run() {
    let place = emitted();
    settles(&place, "8001.1P");
    let drawing = String::from_utf8(fs::read(place.path().join("projects/8001.dxf")).unwrap()).unwrap();
    let place = place.file("projects/8001.dxf", drawing.replace("T5 O2 MPlate", "T5 O2 MPlate R_x"));
    assert!(settles(&place, "projects").stderr.contains("PB520"));
    assert!(place.path().join("projects/8001_x_Milling.gcode").exists());
}

#[test]
fn paths_that_claim_one_file_are_known_to_do_so_and_made_when_they_no_longer_do() {
    let place = emitted();
    let bytes = fs::read(place.path().join("projects/8001.dxf")).unwrap();
    let configuration = format!("out-dir = \"projects\"\n{}", place.read("pathbuild.toml"));
    let place = place.file("pathbuild.toml", configuration).file("components/8001.dxf", bytes);
    let run = settles(&place, "");
    assert!(run.stderr.contains("PB514"), "{run}");
    fs::remove_file(place.path().join("projects/8001_Milling.gcode")).unwrap();
    fs::remove_file(place.path().join("components/8001.dxf")).unwrap();
    let run = place.run("emit");
    assert!(run.stderr.contains("projects/8001_Milling.gcode: written"), "{run}");
    settles(&place, "");
}

#[test]
fn records_of_drawings_that_were_not_looked_at_stay_unless_they_are_of_other_bytes() {
    let place = emitted();
    settles(&place, "");
    // The changed component is read by a run that names a single project.
    let drawing = String::from_utf8(fs::read(place.path().join("components/1234.dxf")).unwrap()).unwrap();
    let place = place.file("components/1234.dxf", drawing.replace("I1 B4", "I1 B3"));
    settles(&place, "8001.1P");
    // The component itself was not checked; its cached result refers to other bytes.
    assert_eq!(known(&place.run("emit -v")), ((2, 2), (3, 4)));
}

#[test]
fn a_program_that_may_not_be_written_is_not_made_again() {
    let place = Place::of(
        &LIBRARY
            .replace("mill 0,0 40,0", "sweep 0,0 40,0 \"S1\"\nmill 40,0 80,0")
            .replace("end 40,0", "end 80,0"),
    );
    let run = settles(&place, "components");
    assert_eq!(run.status, Some(1), "{run}");
}

/// A program of another version that is replaced by an equivalent one of this version stays current, because a colleague may have written it.
#[test]
fn a_program_of_this_version_takes_the_place_of_another_ones() {
    let place = emitted();
    let program = "projects/8001_Milling.gcode";
    let own = place.read(program);
    let place = place
        .file(program, own.replacen(concat!("pathbuild ", env!("CARGO_PKG_VERSION")), "pathbuild 0.0.9", 1));
    assert_ne!(place.read(program), own);
    // The program was just written, so its stamp is not trusted and it is compared again each time.
    assert_eq!(place.run("emit --check").status, Some(0));
    let place = place.file(program, own);
    assert_eq!(place.run("emit --check").status, Some(0));
    let place = place.file(program, "(another's)\n");
    assert_eq!(place.run("emit --check").status, Some(1));
}

/// Comments are in the language of messages, unless a key sets another. The cache therefore depends on whether the key is set, not only on its
/// value.
#[test]
fn a_language_that_is_no_longer_set_is_noticed() {
    let place = Place::of(&LIBRARY.replace("feed = 150", "feed = 150\nlang = \"de\"\ncomment-lang = \"en\""));
    assert_eq!(place.run("emit").status, Some(0));
    let configuration = place.read("pathbuild.toml").replace("comment-lang = \"en\"\n", "");
    let place = place.file("pathbuild.toml", configuration);
    let run = place.run("emit --check");
    assert_eq!(run.status, Some(1), "{run}");
}

/// A post that rejects an inserted file, or does not find it, succeeds as soon as the file is corrected.
#[test]
fn a_refusal_for_an_inserted_file_passes_with_it() {
    let texts = "comment = '(~CommentText~)'\nline = 'G01 X{.~X1~} Y{.~Y1~} Z{.~Z1~} F{.~MovingVel~}'\n\
        rapid = 'G00 X{.~X1~} Y{.~Y1~} Z{.~Z1~}'\nprogram-start = '\\\\\\~*~Head~*'\n";
    let post = format!("[post]\nname = \"mine\"\nextension = \"nc\"\n[text]\n{texts}");
    let place = Place::of(&LIBRARY.replace("probe 20,20 \"LA\"\n", "")).file("my.toml", post);
    let configuration = place.read("pathbuild.toml") + "[macros]\nHead = 'head.nc'\n";
    let mut place = place.file("pathbuild.toml", configuration);
    assert_eq!(place.run("emit --post my.toml").status, Some(1), "there is none");
    for (head, status) in [("(a)\n", 0), ("G01 X900 F1\n", 1), ("(b)\n", 0)] {
        place = place.file("head.nc", head);
        let run = place.run("emit --post my.toml");
        assert_eq!(run.status, Some(status), "{head}: {run}");
    }
}

/// The limit for drawings does not apply to programs.
#[test]
fn a_program_may_be_larger_than_a_drawing() {
    let place = Place::of(LIBRARY);
    let largest = ["projects/8001.dxf", "components/1234.dxf"].map(|it| place.read(it).len());
    let limit = largest.into_iter().max().unwrap() + 4096;
    let deep = Place::of(&LIBRARY.replace("I1 B4", "I0.001 B4"));
    let configuration = deep.read("pathbuild.toml") + &format!("[limits]\nfile-size = \"{limit} B\"\n");
    let deep = deep.file("pathbuild.toml", configuration);
    assert_eq!(deep.run("emit").status, Some(0));
    assert!(deep.read("projects/8001_Milling.gcode").len() > limit);
    assert!(consistent_output(&deep, "").stderr.contains(" 0 not current\n"));
}

/// Moves can be compared without the rapid feed, but the cached result does not suffice for a run that reports times.
#[test]
fn a_value_that_is_missing_is_missing_though_moves_are_known() {
    let place = Place::of(&LIBRARY.replace("rapid = 1000\n", ""));
    assert_eq!(place.run("emit --rapid 1000").status, Some(0));
    assert_eq!(place.run("emit --check --moves").status, Some(0));
    let run = place.run("emit --check");
    assert!(run.status == Some(2) && run.stderr.contains("--rapid"), "{run}");
}

/// The program is a symbolic link to itself: it exists, but cannot be read.
#[cfg(unix)]
#[test]
fn a_program_that_leads_to_itself_is_not_missing() {
    let place = emitted();
    let program = place.path().join("projects/8001_Milling.gcode");
    fs::remove_file(&program).unwrap();
    std::os::unix::fs::symlink("8001_Milling.gcode", &program).unwrap();
    let run = consistent_output(&place, "");
    assert!(run.stdout.contains("8001_Milling.gcode: not current\n"), "{run}");
}

/// Another drawing yields the same program: with cached results, too, the program on disk is out of date, and is listed once.
#[test]
fn a_program_that_a_second_drawing_yields_is_outdated() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit --out-dir gcode").status, Some(0));
    let bytes = fs::read(place.path().join("projects/8001.dxf")).unwrap();
    let place = place.file("projects/more/8001.dxf", bytes);
    for command in ["emit --check --out-dir gcode", "emit --out-dir gcode"] {
        let cached = place.run(command);
        let anew = place.run(&format!("{command} --no-cache"));
        assert_eq!((cached.status, output(&cached)), (Some(1), output(&anew)));
        assert!(cached.to_string().contains("PB514") && cached.to_string().contains("PB522"), "{cached}");
        let lines = cached.stdout.lines().filter(|line| line.contains("8001_Milling.gcode: not current"));
        assert_eq!(lines.count(), usize::from(command.contains("--check")), "{cached}");
    }
}
