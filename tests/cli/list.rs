//! Tests `list`, `stats`, shell completion, and suggestions of similar names. (book: reference/commands)

use std::fs;

use insta::assert_snapshot;
use serde_json::Value;

use pathbuild_testkit::sheet;

use crate::support::{Place, program, runs};

const LIBRARY: &str = r#"
== pathbuild.toml ==
feed = 100
rapid = 1000
sweep-height = 20
library = ["components", "projects"]
search = ["components"]
== components/1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I5 B0 MPlate"
mill 0,0 40,0
end 40,0
layer 1234.2P
start 0,20 "T5 O3,5 I5 B0 MPlate"
mill 0,20 40,50
end 40,50
== components/2051.dxf ==
layer 2051.1P
start 0,0 "T5 O2 I5 :B0~1"
mill 0,0 40,0 "B=B"
end 40,0
== projects/8001.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
subpath 40,0 80,0 ">2051.1P :B0,5"
end 80,0
== projects/8900.dxf ==
layer 8900.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">9999.1P"
end 40,0
"#;

#[test]
fn paths_are_listed_with_what_a_workshop_asks_of_them() {
    let place = Place::of(LIBRARY);
    assert_snapshot!(runs(
        &place,
        ["list", "list --lang de", "list 1234.* 8900.1p --format json", "list projects 8001*"]
    ));
    assert_snapshot!(runs(&place, ["stats", "stats --lang de", "stats 1234.* --format json"]));
}

/// A pattern after a directory selects paths in that directory. If the path is elsewhere in the library, the message names its drawing.
#[test]
fn a_path_of_another_directory_is_told_with_its_drawing() {
    let place = Place::of(LIBRARY);
    let elsewhere = place.run("list components 8001.1P");
    assert_eq!(elsewhere.status, Some(1), "{elsewhere}");
    assert!(
        elsewhere.stderr.contains("note: the library defines the path in projects/8001.dxf"),
        "{elsewhere}"
    );
    let nowhere = place.run("list components 801.1P");
    assert_eq!(nowhere.status, Some(1), "{nowhere}");
    assert!(!nowhere.stderr.contains("defines the path"), "{nowhere}");
    assert!(nowhere.stderr.contains("note: did you mean 8001.1P?"), "{nowhere}");
    assert_eq!(place.run("list projects 8001.1P").status, Some(0));
}

#[test]
fn a_state_tells_whether_the_program_on_disk_is_that_of_the_drawing() {
    let place = Place::of(LIBRARY);
    let state = |name: &str| {
        let run = place.run(&format!("list {name} --format json"));
        let mut rows = run.stdout.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        let row = rows.rfind(|row| row["path"] == name).unwrap_or_else(|| panic!("{run}"));
        (row["state"].as_str().unwrap().to_owned(), row["program"].as_str().map(str::to_owned))
    };
    let is = |state: &str, program: Option<&str>| (state.to_owned(), program.map(str::to_owned));
    assert_eq!(state("1234.1P"), is("ok", None));
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    assert_eq!(state("1234.1P"), is("current", Some("current")));
    let program = "components/1234.1P_Milling.gcode";
    let by_hand = place.read(program).replace("X40.000", "X41.000");
    fs::write(place.path().join(program), by_hand).unwrap();
    assert_eq!(state("1234.1P"), is("stale", Some("stale")));
    assert_eq!(state("8900.1P"), is("errors", None));
}

/// Findings about the drawing as a whole are counted like those of `emit`: with the configured severities.
#[test]
fn findings_about_a_drawing_count_for_its_paths() {
    let path = sheet("layer 4000.1P\nstart 0,0 \"T5 O2 I5 B0 MPlate\"\nmill 0,0 40,0\nend 40,0\n");
    let path = path.unwrap().to_dxf();
    let place = |name: &str, severity: &str| {
        let configuration = format!("{PLAIN}library = [\".\"]\n[severity]\nPB521 = \"{severity}\"\n");
        Place::new().file("pathbuild.toml", configuration).file(name, path.clone())
    };
    let states = |place: &Place| {
        let run = place.run("list");
        let state = run.stdout.lines().last().unwrap_or_default().rsplit("  ").next().unwrap_or_default();
        state.to_owned()
    };
    assert_eq!(states(&place("4000.dxf", "error")), "ok");
    assert_eq!(states(&place("gear.dxf", "ignore")), "ok");
    let warned = place("gear.dxf", "warning");
    assert_eq!(warned.run("emit .").status, Some(0));
    assert_eq!(states(&warned), "program current, 1 warning");
    let refused = warned.file("pathbuild.toml", format!("{PLAIN}[severity]\nPB521 = \"error\"\n"));
    assert_eq!(refused.run("emit .").status, Some(1));
    let run = refused.run("list . --format json");
    assert!(run.stdout.contains(r#""state":"errors""#) && run.stdout.contains(r#""program":null"#), "{run}");
    let run = refused.run("stats .");
    assert!(run.stdout.contains("  errors: 1\n") && run.stdout.contains("program current: 0"), "{run}");
}

const PLAIN: &str = "feed = 100\nrapid = 1000\nsweep-height = 20\n";

/// Without `rapid`, the moves are compared. Without an option that the moves depend on, it is unknown whether a program is current.
#[test]
fn a_program_on_disk_is_judged_without_options() {
    let drawing = |depth: &str| {
        let start = "layer 4000.1P\nstart 0,0 \"T5 O2 I5 MPlate\"\n";
        sheet(&format!("{start}mill 0,0 40,0 \"B{depth}\"\nend 40,0\n")).unwrap().to_dxf()
    };
    let mut place = Place::new().file("pathbuild.toml", PLAIN).file("4000.dxf", drawing("0"));
    assert_eq!(place.run("emit 4000.1P").status, Some(0));
    for (depth, judged) in [("0", "program current"), ("1", "program not current")] {
        place = place.file("4000.dxf", drawing(depth));
        let without = |option: &str| {
            PLAIN
                .lines()
                .filter(|line| !line.starts_with(option))
                .fold(String::new(), |all, line| all + line + "\n")
        };
        for (option, state) in [
            ("-", judged),
            ("rapid", judged),
            ("feed", "program not compared"),
            ("sweep", "program not compared"),
        ] {
            place = place.file("pathbuild.toml", without(option));
            let run = place.run("list .");
            assert!(run.stdout.contains(&format!("  {state}\n")), "{option} {run}");
            let run = place.run("stats .");
            assert!(run.stdout.contains(&format!("  {state}: 1\n")), "{option} {run}");
        }
    }
    fs::remove_file(place.path().join("4000_Milling.gcode")).unwrap();
    let run = place.run("list .");
    assert!(run.stdout.contains("  ok\n"), "{run}");
}

#[test]
fn a_pattern_that_nothing_matches_is_an_error() {
    let place = Place::of(LIBRARY);
    let run = place.run("list 7*");
    assert_eq!(run.status, Some(1), "{run}");
    assert_eq!(place.run("list [").status, Some(2));
}

/// A library is listed as `check` reads it.
#[test]
fn a_library_is_listed_once_and_only_as_a_whole() {
    let drawing = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n";
    for (library, paths, code) in
        [(r#"["a", "./a", "."]"#, 1, ""), (r#"["a", "gone"]"#, 1, "PB003"), (r#"["b"]"#, 0, "PB518")]
    {
        let place = Place::new().file("pathbuild.toml", format!("library = {library}\nfeed = 150\n"));
        let place = place.file("a/1234.1P.dxf", sheet(drawing).unwrap().to_dxf()).file("b/notes.txt", "");
        let run = place.run("list --format json");
        let expected = (Some(i32::from(!code.is_empty())), paths);
        assert_eq!((run.status, run.stdout.matches("\"path\":\"1234.1P\"").count()), expected, "{run}");
        assert!(run.stdout.contains(code), "{run}");
        let run = place.run("stats");
        assert_eq!((run.status, usize::from(run.stdout.contains("drawings: 1,"))), expected, "{run}");
    }
}

/// Without a library, the drawings below the working directory are listed.
#[test]
fn an_empty_directory_without_a_library_is_an_error() {
    for place in [Place::new(), Place::new().file("pathbuild.toml", "feed = 150\n")] {
        for command in ["list", "stats", "list 1234*"] {
            let run = place.run(command);
            assert!(run.status == Some(1) && run.stderr.contains("PB518"), "{run}");
        }
    }
    let place = Place::new().file("a/1234.1P.dxf", "");
    assert!(!place.run("list").stderr.contains("PB518"), "there is a drawing, although it is damaged");
}

#[test]
fn a_pattern_names_paths_for_every_command() {
    let place = Place::of(LIBRARY);
    let emitted = place.run("emit 12*.?P");
    assert_eq!(emitted.status, Some(0), "{emitted}");
    for name in ["1234.1P", "1234.2P"] {
        assert!(emitted.stderr.contains(&format!("{name}_Milling.gcode: written")), "{emitted}");
    }
    let faulty = place.run("emit 8*.1P");
    for code in ["PB201", "PB503"] {
        assert!(faulty.stderr.contains(code), "{faulty}");
    }
    let checked = |what: &str| place.run(&format!("check {what} --format concise"));
    assert!(checked("123?.1P").stderr.starts_with("1 path in 1 drawing"), "{}", checked("123?.1P"));
    assert!(
        checked("123[4].[12]p").stderr.starts_with("2 paths in 1 drawing"),
        "{}",
        checked("123[4].[12]p")
    );
    for (lang, text) in [("en", "no path matches 7*"), ("de", "kein Pfad entspricht 7*")] {
        let none = place.run(&format!("emit 7* --lang {lang}"));
        assert_eq!(none.status, Some(1), "{none}");
        assert!(none.stderr.contains(text) && !none.stderr.contains("there is no path"), "{none}");
    }
}

#[test]
fn names_that_are_nearly_right_are_named() {
    let place = Place::of(LIBRARY);
    let lines = [
        "check 1234.3P --format concise",
        "check 1234.3P",
        "check conponents/1234.dxf",
        "check components/124.dxf",
        "emit projekts/8001.dxf",
        "check conponents",
        "check somewhere/else",
        "list 8002.1P",
        "list 801.1P",
    ];
    assert_snapshot!(runs(&place, lines));
}

#[test]
fn a_drawing_alone_is_checked() {
    let place = Place::of(LIBRARY);
    let drawing = "components/1234.dxf";
    for line in
        [drawing.to_owned(), format!("--lang de {drawing}"), format!("{drawing} components/2051.dxf -q")]
    {
        let (alone, check) =
            (place.run(&line), place.run(&line.replacen(drawing, &format!("check {drawing}"), 1)));
        assert_eq!(
            (alone.status, &alone.stdout, &alone.stderr),
            (Some(0), &check.stdout, &check.stderr),
            "{line}"
        );
    }
    assert_eq!(place.run("components").status, Some(2), "a directory is no command");
}

#[test]
fn help_of_a_command_is_shown_by_the_command_help() {
    let place = Place::new();
    assert!(place.run("help").stdout.contains("Commands:"));
    assert_eq!(place.run("help check").stdout, place.run("check --help").stdout);
}

/// Returns the completions for the last word.
fn completed(place: &Place, words: &[&str]) -> Vec<String> {
    let mut program = program();
    program.env("PATHBUILD_COMPLETE", "bash").env("_CLAP_COMPLETE_INDEX", words.len().to_string());
    program.env("_CLAP_IFS", "\n").args(["--", "pathbuild"]).args(words).current_dir(place.path());
    let output = program.output().unwrap();
    assert!(output.status.success());
    // Directories are completed by clap, in the spelling of the system.
    let stdout = String::from_utf8(output.stdout).unwrap().replace('\\', "/");
    stdout.lines().map(str::to_owned).collect()
}

#[test]
fn a_shell_completes_names_of_paths_posts_dialects_and_codes() {
    let place = Place::of(LIBRARY);
    assert_eq!(completed(&place, &["check", "12"]), ["1234.1P", "1234.2P"]);
    assert_eq!(completed(&place, &["check", "comp"]), ["components/"]);
    assert_eq!(completed(&place, &["emit", "--post", "linux"]), ["linuxcnc"]);
    assert_eq!(completed(&place, &["verify", "--dialect", "gr"]), ["grbl"]);
    assert_eq!(completed(&place, &["explain", "PB51"]).first().map(String::as_str), Some("PB510"));
    assert_eq!(completed(&place, &["li"]), ["list"]);
    let broken = place.file("pathbuild.toml", "library = 1");
    assert_eq!(completed(&broken, &["check", "12"]), [""; 0], "a configuration with faults has no names");
}

/// Commands that answer questions end with 0 if the drawing has errors but known paths, and name only the error of a drawing that hides its paths.
#[test]
fn errors_of_a_drawing_with_known_paths_keep_no_question_from_being_answered() {
    let options = "library = ['.']\nfeed = 150\nrapid = 1000\nsweep-height = 20\nkeep-out = 'clamps'\n";
    let drawing = "layer 1234.1P\nstart 0,0 \"T5 O2 I5 B0 MPlate\"\nmill 0,0 40,0\nend 40,0\n";
    let clamp = "layer clamps\npolyline 20,10 30,10 30,20 20,20 closed\n";
    let place = |drawing: String| {
        let place = Place::new().file("pathbuild.toml", options);
        place.file("1234.dxf", sheet(&drawing).unwrap().to_dxf())
    };
    let (sound_units, inches) = (place(format!("{drawing}{clamp}")), place(format!("units inch\n{drawing}")));
    assert!(sound_units.run("check .").stderr.contains("PB117"));
    for command in ["list", "stats", "texts", "where", "deps", "rdeps", "graph"] {
        for argument in [".", "1234.1P"] {
            let run = sound_units.run(&format!("{command} {argument}"));
            assert!(run.status == Some(0) && !run.stderr.contains("error["), "{command}: {run}");
        }
        let run = inches.run(&format!("{command} 1234.1P"));
        assert!(run.status == Some(1) && run.stderr.contains("PB113"), "{command}: {run}");
        assert!(!run.stderr.contains("PB503"), "{command}: {run}");
        assert!(inches.run(&format!("{command} 1235.1P")).stderr.contains("PB503"), "{command}");
    }
}
