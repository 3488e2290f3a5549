//! Tests Q-projects: `pathbuild q-project`, and the findings of `check`. (book: language/q-projects)

use crate::support::{Place, fixture};

/// A drawing with a proxy line, a path with variables, a closed path, and lines and texts that are not proxies.
const DRAWING: &str = r#"
== pathbuild.toml ==
library = ["."]
feed = 150
rapid = 1000
sweep-height = 20
== gear 1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B0 MPlate"
mill 0,0 40,0
end 40,0
layer 1234.2P
start 0,20 "T6 O2 I1 MPlate2 :B0~1 :CA,B"
mill 0,20 40,20 "B=B Q=C"
mill 40,20 40,40 "B=B"
mill 40,40 0,20 "B=B"
end 0,20
layer 1234.3P
start 0,60 "T4 O3 I1 B0 MPlate"
mill 0,60 0.4,60
end 0.4,60
layer 1234.**
subpath 40,0 0,0 ">1234.1P O2 H2"
line DASHDOT 0,60 40,100
mill 50,0 90,0 "look at >1234.9P"
text 100,100 "B-B"
"#;

fn written() -> Place {
    let place = Place::of(DRAWING);
    let run = place.run_with(&["q-project", "gear 1234.dxf"]);
    assert_eq!((run.status, run.stderr.as_str()), (Some(0), "gear 1234_Q.dxf: written, 3 paths\n"), "{run}");
    place
}

#[test]
fn what_is_written_is_right_and_agrees_with_its_drawing() {
    let place = written();
    let run = place.run("check");
    assert!(run.stderr.starts_with("5 paths in 2 drawings: no errors, no warnings"), "{run}");
}

#[test]
fn every_path_is_embedded_as_its_proxy_line_says_else_with_its_own_values() {
    let place = written();
    let run = place.run_with(&["texts", "gear 1234_Q.dxf"]);
    let texts: Vec<&str> = run.stdout.split('"').skip(1).step_by(2).collect();
    assert_eq!(
        texts,
        [
            "T6 O2 MPlate2",
            ">1234.1P O2 H2 MPlate T5",
            ">1234.2P MPlate2 T6 O2 :B0 :CB",
            "T4 O3 MPlate",
            ">1234.3P MPlate T4 O3"
        ]
    );
    for line in ["from (0, 0) to (40, 0)", "from (60, 0) to (60, 0)", "from (0, -60) to (0.4, -60)"] {
        assert!(run.stdout.contains(line), "{line}: {run}");
    }
}

/// A project has a single cutter.
#[test]
fn it_has_a_path_for_each_cutter() {
    let place = written();
    let emitted = ["1234.0Q", "1234.1Q"].map(|path| place.run_with(&["emit", path]).status);
    assert_eq!(emitted, [Some(0); 2]);
    let written = |path| place.run_with(&["emit", path, "-o", "-"]).stdout;
    assert!(written("1234.0Q").contains("START Subpath 1234.2P") && !written("1234.0Q").contains("1234.3P"));
    assert!(written("1234.1Q").contains("START Subpath 1234.3P") && !written("1234.1Q").contains("1234.2P"));
    // A name that the drawing itself contains is skipped.
    let place = Place::of(&DRAWING.replace("1234.2P", "1234.1Q"));
    assert_eq!(place.run_with(&["q-project", "gear 1234.dxf"]).status, Some(0));
    assert_eq!(place.run_with(&["emit", "1234.2Q"]).status, Some(0));
    let lone = DRAWING.replace("== gear", "path-pattern = \"1234[.][0-3][PQ]\"\n== gear");
    let place = Place::of(&lone.replace("library = [\".\"]\n", ""));
    let run = place.run_with(&["q-project", "gear 1234.dxf", "--path-name", "1234.3Q"]);
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("PB004") && run.stderr.contains("1234.3Q"), "{run}");
}

/// Two tools have the same O: the name of the Q-project's path selects the one that mills the embedded paths.
#[test]
fn it_has_a_path_for_each_tool_of_the_same_diameter() {
    let written = |patterns: &str| {
        let path = |name: &str, y: i32| {
            format!("layer {name}\nstart 0,{y} \"T5 O2 I1 B0 MPlate\"\nmill 0,{y} 40,{y}\nend 40,{y}\n")
        };
        let tools = format!(
            "[tool.mill]\ndiameter = 2\n[tool.slot]\ndiameter = 2\nshape = \"slot\"\npaths = '{patterns}'\n"
        );
        let drawing = [path("1234.1S", 0), path("1234.2P", 20), path("1234.3S", 40)].concat();
        let place =
            Place::of(&format!("== pathbuild.toml ==\nlibrary = [\".\"]\n{tools}== 1234.dxf ==\n{drawing}"));
        let run = place.run_with(&["q-project", "1234.dxf"]);
        let check = place.run("check");
        assert!(check.stderr.contains("no errors, no warnings"), "{check}");
        (run, place.run_with(&["list", "1234_Q.dxf"]).stdout)
    };
    let (run, _) = written("S$");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("PB506") && run.stderr.contains("let its `paths` match 1234.0Q"), "{run}");
    // The two paths of the slot cutter are 40 mm long, with a sweep of 20 mm between them.
    for (patterns, slot, other) in [("S$|0Q$", "1234.0Q", "1234.1Q"), ("S$|[.]5Q$", "1234.5Q", "1234.0Q")] {
        let (run, list) = written(patterns);
        assert_eq!(run.status, Some(0), "{run}");
        for (path, length) in [(slot, " 100 x 0"), (other, " 40 x 0")] {
            assert!(list.lines().any(|line| line.starts_with(path) && line.contains(length)), "{list}");
        }
    }
}

/// A material has a single thickness: paths of a thinner sheet of the same M are in a path of their own.
#[test]
fn it_has_a_path_for_each_thickness_of_a_material() {
    let paths = |second: &str, third: &str| {
        let path = |name: &str, y: i32, text: &str| {
            format!("layer {name}\nstart 0,{y} \"O2 I1 B0 {text}\"\nmill 0,{y} 40,{y}\nend 40,{y}\n")
        };
        let drawing =
            [path("1234.1P", 0, "T5 MPlate"), path("1234.2P", 20, second), path("1234.3P", 40, third)];
        let place = Place::of(&format!(
            "== pathbuild.toml ==\nlibrary = [\".\"]\n== 1234.dxf ==\n{}",
            drawing.concat()
        ));
        assert_eq!(place.run_with(&["q-project", "1234.dxf"]).status, Some(0));
        let run = place.run("check");
        assert!(run.stderr.contains("no errors, no warnings"), "{run}");
        let run = place.run_with(&["texts", "1234_Q.dxf"]);
        let texts = run.stdout.split('"').skip(1).step_by(2);
        texts.filter(|text| text.starts_with('T')).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(paths("T6 MPlate", "T5 MPlate"), ["T5 O2 MPlate", "T6 O2 MPlate"]);
    // The path that embeds sheets of several materials has T and M of the thickest.
    assert_eq!(paths("T6 MOther", "T5 MPlate"), ["T6 O2 MOther"]);
    assert_eq!(paths("T4 MOther", "T5 MPlate"), ["T5 O2 MPlate"]);
}

#[test]
fn written_twice_it_has_the_same_bytes() {
    let place = written();
    let bytes = std::fs::read(place.path().join("gear 1234_Q.dxf")).unwrap();
    let again = place.run_with(&["q-project", "gear 1234.dxf"]);
    assert_eq!(again.stderr, "gear 1234_Q.dxf: unchanged, 3 paths\n");
    place.run_with(&["q-project", "gear 1234.dxf", "-o", "other.dxf"]);
    assert_eq!(std::fs::read(place.path().join("other.dxf")).unwrap(), bytes);
}

#[test]
fn its_path_has_the_drawings_first_number_or_the_name_that_is_given() {
    let place = written();
    let name = |file| place.run_with(&["where", file]).stdout;
    assert!(name("gear 1234_Q.dxf").starts_with("1234.0Q "), "{}", name("gear 1234_Q.dxf"));
    place.run_with(&["q-project", "gear 1234.dxf", "--path-name", "8900.7Q", "-o", "other.dxf"]);
    assert!(name("other.dxf").starts_with("8900.7Q "), "{}", name("other.dxf"));
}

#[test]
fn a_name_that_is_none_or_is_taken_is_wrong_usage() {
    let place = Place::of(DRAWING);
    for name in ["8900.Q", "1234.3p"] {
        let run = place.run_with(&["q-project", "gear 1234.dxf", "--path-name", name]);
        assert_eq!(run.status, Some(2), "{run}");
        assert!(run.stderr.contains("--path-name"), "{run}");
    }
    let place = Place::of(&DRAWING.replace("gear 1234.dxf", "gear.dxf"));
    assert_eq!(place.run("q-project gear.dxf").status, Some(2), "its name has no number");
    let run = place.run("q-project gear.dxf --path-name 1234.0Q");
    assert_eq!(run.status, Some(1), "by that name its paths are not found: {run}");
    assert!(run.stderr.contains("PB503"), "{run}");
}

/// A path is found by its drawing's file name: a range of paths in that name does not admit the path of the Q-project. (PB503)
#[test]
fn a_q_project_that_its_file_name_does_not_cover_is_named_with_its_drawing() {
    let place = written();
    let found = place.run("emit 1234.0Q");
    assert_eq!(found.status, Some(0), "{found}");
    let place = Place::of(&DRAWING.replace("gear 1234.dxf", "1234.1-1234.3P.dxf").replace("T4 O3", "T5 O2"));
    assert_eq!(place.run("q-project 1234.1-1234.3P.dxf").status, Some(0));
    for (lang, note) in [
        (
            "en",
            "note: 1234.1-1234.3P_Q.dxf defines the path, although its file name does not contain the path's name",
        ),
        ("de", "1234.1-1234.3P_Q.dxf enthält den Pfad, obwohl der Dateiname ihn nicht nennt"),
    ] {
        for command in ["emit", "check", "where", "deps", "view", "sheet", "texts"] {
            let missed = place.run(&format!("{command} 1234.0Q --lang {lang}"));
            assert_eq!(missed.status, Some(1), "{missed}");
            assert!(missed.stderr.contains(note), "{missed}");
        }
    }
    let nowhere = place.run("emit 1234.9Q");
    assert!(
        !nowhere.stderr.contains("did you mean") && !nowhere.stderr.contains("defines the path"),
        "{nowhere}"
    );
    assert_eq!(place.run("emit 1234.1-1234.3P_Q.dxf").status, Some(0));
}

/// Asserts that nothing is written for a drawing that projects could not embed.
fn is_refused(drawing: &str, code: &str) {
    let place = Place::of(drawing);
    let run = place.run_with(&["--format", "concise", "q-project", "gear 1234.dxf"]);
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains(code), "{run}");
    assert!(!place.path().join("gear 1234_Q.dxf").exists(), "{run}");
}

#[test]
fn a_drawing_with_errors_gets_no_q_project() {
    is_refused(&DRAWING.replace("B0 MPlate\"\nmill 0,0", "MPlate\"\nmill 0,0"), "PB201");
    is_refused(&DRAWING.replace("layer 1234.1P\n", "layer 1234.1P\nmill 0,5 1,5\n"), "PB402");
    is_refused("== gear 1234.dxf ==\nlayer 0\nmill 0,0 40,0", "PB513");
}

#[test]
fn a_path_without_material_cannot_be_embedded() {
    is_refused(&DRAWING.replace("T4 O3 I1 B0 MPlate", "T4 O3 I1 B0"), "PB201");
}

#[test]
fn a_wrong_proxy_line_is_not_copied() {
    is_refused(&DRAWING.replace(">1234.1P O2 H2", ">1234.1P O3 H2"), "PB517");
}

/// The values of the proxy line are those that a project gets.
#[test]
fn a_proxy_line_with_a_wrong_variable_is_not_copied() {
    let drawing = DRAWING.replace("B0 MPlate\"\nmill 0,0 40,0", "MPlate :B0~1\"\nmill 0,0 40,0 \"B=B\"");
    for (variables, code) in [(":B2", "PB517"), (":B0.5 :C1", "PB517"), (":B0.5 F100", "PB202")] {
        is_refused(&drawing.replace("O2 H2", &format!("O2 H2 {variables}")), code);
    }
}

/// A drawing and its Q-project that agree in path, proxy line and subpath.
const PAIR: &str = r#"
$ check .
#! exit 0
== pathbuild.toml ==
library = ["."]
== 1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 MPlate :B0~1"
mill 0,0 40,0 "B=B"
end 40,0
layer 1234.**
subpath 0,0 40,0 ">1234.1P T5 O2 MPlate :B0.5"
== 1234_Q.dxf ==
layer 1234.0Q
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P T5 O2 MPlate :B0,50"
end 40,0
"#;

const PROXY: &str = r#"subpath 0,0 40,0 ">1234.1P T5 O2 MPlate :B0.5""#;
const EMBEDDING: &str = r#"subpath 0,0 40,0 ">1234.1P T5 O2 MPlate :B0,50""#;

fn expect(changes: &[(&str, &str)], exit: u8) {
    let mut text = PAIR.replace("exit 0", &format!("exit {exit}"));
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    let faults = fixture::faults(&text);
    assert!(faults.is_empty(), "{changes:?}:\n{}", faults.join("\n"));
}

#[test]
fn a_pair_that_agrees_is_right() {
    expect(&[], 0);
}

#[test]
fn what_the_text_leaves_open_is_the_paths() {
    expect(&[(EMBEDDING, r#"subpath 0,0 40,0 ">1234.1P :B0.5""#)], 0);
    expect(&[(PROXY, r#"subpath 0,0 40,0 ">1234.1P :B0.5""#)], 0);
}

#[test]
fn each_path_must_be_embedded() {
    let skipped = EMBEDDING.replace("subpath", "skip");
    expect(&[(EMBEDDING, &skipped), ("layer 1234.0Q", "#! PB515 1234.1P\nlayer 1234.0Q")], 0);
}

/// The command that the help names works in the working directory.
#[test]
fn the_help_names_the_drawing_with_its_directory() {
    let skipped = PAIR.replace(EMBEDDING, &EMBEDDING.replace("subpath", "skip"));
    let library = skipped.split_once("\n== ").unwrap().1;
    let help = |name: &str| {
        let place = Place::of(&format!("== {}", library.replace("== 1234", &format!("== parts/{name}"))));
        let run = place.run("check");
        let (_, command) = run.stderr.split_once(": pathbuild ").unwrap_or_else(|| panic!("{run}"));
        command.lines().next().unwrap().to_owned()
    };
    assert_eq!(help("1234"), "q-project parts/1234.dxf");
    assert_eq!(help("1234 gear"), "q-project \"parts/1234 gear.dxf\"");
}

/// A drawing that was renamed leaves its Q-project behind.
#[test]
fn a_q_project_without_its_drawing_is_a_warning() {
    let renamed =
        |to: &str| PAIR.replace("== 1234.dxf", to).replace("layer 1234.0Q", "#! PB515\nlayer 1234.0Q");
    let faults = |text: &str| fixture::faults(text).join("\n");
    assert_eq!(faults(&renamed("== 1234 gear.dxf")), "");
    let of_one = PAIR.replace("$ check .", "$ check 1234_Q.dxf");
    assert_eq!(faults(&of_one), "", "the drawing exists, although it is not checked");
    let component = "$ check .\n#! exit 0\n== pathbuild.toml ==\nlibrary = [\".\"]\n== 1234_Q.dxf ==\n\
                     layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n";
    assert_eq!(faults(component), "", "it embeds nothing");
}

#[test]
fn a_value_other_than_the_proxy_lines_is_a_warning() {
    let other = EMBEDDING.replace(":B0,50", ":B0.6");
    expect(&[(EMBEDDING, &format!("{other} #! PB516 :B"))], 0);
    // A proxy line may leave the value open.
    for open in ["", ":B=B"] {
        expect(&[(PROXY, &PROXY.replace(":B0.5", open))], 0);
    }
}

/// A difference from the path itself is an error of the embedding instead.
#[test]
fn a_text_or_length_other_than_the_proxy_lines_is_a_warning() {
    for (letter, other) in [("T5", "T4"), ("O2", "O3"), ("MPlate", "MPlate2")] {
        let other = EMBEDDING.replace(letter, other);
        expect(&[(EMBEDDING, &format!("{other} #! PB506\n#! PB516"))], 1);
    }
    let raised = |drawn: &str, height: &str| drawn.replace("T5", &format!("T5 {height}"));
    expect(&[(EMBEDDING, &format!("{} #! PB516 H", raised(EMBEDDING, "H2")))], 0);
    expect(&[(PROXY, &raised(PROXY, "H2")), (EMBEDDING, &format!("{EMBEDDING} #! PB516 H"))], 0);
    expect(&[(PROXY, &raised(PROXY, "H2")), (EMBEDDING, &raised(EMBEDDING, "H2"))], 0);
    expect(&[(EMBEDDING, &raised(EMBEDDING, "H0"))], 0);
    let nearly = [
        (PROXY, PROXY.replace("40,0", "40.0007,0")),
        (EMBEDDING, EMBEDDING.replace("0,0 40,0", "0,0 39.9998,0")),
    ];
    let [(a, b), (c, d)] = &nearly;
    let end = ("layer 1234.0Q", "layer 1234.0Q\nsweep 39.9998,0 40,0");
    expect(&[(a, b), (c, d), end], 0);
    let d = format!("{} #! PB516", d.replace("39.9998", "39.9996"));
    expect(&[(a, b), (c, &d), ("layer 1234.0Q", "layer 1234.0Q\nsweep 39.9996,0 40,0")], 0);
}

#[test]
fn any_of_several_proxy_lines_will_do() {
    let two = format!("{}\n{PROXY}", PROXY.replace(":B0.5", ":B1").replace("0,0 40,0", "0,9 40,9"));
    expect(&[(PROXY, &two)], 0);
}

#[test]
fn a_proxy_line_must_agree_with_its_path() {
    for (from, to) in [("T5", "T5.1"), ("O2", "O2.1"), ("MPlate", "MPlat"), ("T5", "T5x")] {
        expect(&[(PROXY, &format!("{} #! PB517", PROXY.replace(from, to)))], 1);
    }
    expect(&[(PROXY, &format!("{} #! PB517", PROXY.replace("1234.1P", "1234.2P")))], 1);
    for (from, to) in [(":B0.5", ":B1.5"), (":B0.5", ":B0.5 :C1")] {
        expect(&[(PROXY, &format!("{} #! PB517", PROXY.replace(from, to)))], 1);
    }
    expect(&[(PROXY, &format!("{} #! PB202", PROXY.replace(":B0.5", ":B0.5 F9")))], 1);
    expect(&[(PROXY, &PROXY.replace("40,0", "40.0009,0"))], 0);
    expect(&[(PROXY, &format!("{} #! PB517", PROXY.replace("40,0", "40.0011,0")))], 1);
    expect(&[(PROXY, &PROXY.replace("subpath 0,0 40,0", "subpath arc 0,30 40,30 r 30"))], 0);
}

/// An umlaut may be one character or two, which look the same.
#[test]
fn materials_that_only_look_the_same_are_told_apart() {
    let library = PAIR.split_once("\n== ").unwrap().1.replace("MPlate", "MBl\u{e4}ch");
    for (drawn, code) in [(PROXY, "PB517"), (EMBEDDING, "PB516")] {
        let drawn = drawn.replace("MPlate", "MBl\u{e4}ch");
        for (material, is_noted) in [("MBla\u{308}ch", true), ("MBlech", false)] {
            let changed = library.replace(&drawn, &drawn.replace("MBl\u{e4}ch", material));
            let run = Place::of(&format!("== {changed}")).run("check --format json");
            let mut lines = run.stdout.lines().filter(|line| line.contains(code));
            assert_eq!(lines.any(|line| line.contains("two characters that look")), is_noted, "{run}");
        }
    }
}

#[test]
fn a_proxy_line_from_start_to_end_of_another_path_has_the_wrong_name() {
    let second =
        "layer 1234.2P\nstart 0,50 \"T5 O2 I1 B0 MPlate\"\nmill 0,50 40,50\nend 40,50\nlayer 1234.**";
    let embeds = format!(
        "{EMBEDDING}\nsweep 40,0 40,50\nsubpath 40,50 0,50 \">1234.2P\"\nsweep 0,50 41,0\nend 41,0\nlayer 0"
    );
    let proxy = |name| format!("{PROXY}\nsubpath 40,50 0,50 \">{name} MPlate\"");
    let base = [("layer 1234.**", second), (EMBEDDING, &embeds)];
    expect(&[&base[..], &[(PROXY, &proxy("1234.2P"))]].concat(), 0);
    expect(&[&base[..], &[(PROXY, &format!("{} #! PB517 1234.2P", proxy("1234.1P")))]].concat(), 1);
}

#[test]
fn a_drawing_without_a_q_project_may_have_any_lines() {
    let (component, _) = PAIR.split_once("== 1234_Q.dxf").unwrap();
    let place = Place::of(&component.replace("O2 MPlate :B0.5", "O9 MPlate"));
    let run = place.run("check");
    assert!(run.stderr.contains("no errors, no warnings"), "{run}");
}

/// If the Q-project has errors, its embeddings are unknown, and only the errors are reported.
#[test]
fn nothing_is_said_against_a_q_project_with_errors() {
    let wrong = EMBEDDING.replace("T5", "T5x");
    expect(&[(EMBEDDING, &format!("{wrong} #! PB205"))], 1);
}

/// Users also draw Q-projects by hand.
#[test]
fn a_drawing_of_the_user_is_not_overwritten() {
    let place = written();
    let name = "gear 1234_Q.dxf";
    let ours = std::fs::read(place.path().join(name)).unwrap();
    // A CAD program drops the comment at the beginning of the file when it saves.
    let ours = String::from_utf8(ours).unwrap();
    let (mark, saved) = ours.split_once("\r\n  0\r\n").unwrap();
    assert!(mark.starts_with("999\r\npathbuild q-project "), "{mark}");
    let saved = format!("  0\r\n{saved}");
    // Earlier versions wrote no hash, and before that no mark. Git may convert line ends.
    let converted = ours.replace("\r\n", "\n");
    for earlier in [format!("999\r\npathbuild q-project\r\n{saved}"), saved.clone(), converted] {
        let place = written().file(name, earlier);
        assert_eq!(place.run_with(&["q-project", "gear 1234.dxf"]).status, Some(0));
        assert_eq!(place.read(name), ours);
    }
    let edited = saved.replacen("gear", "gears", 1).replacen("1234", "1235", 1);
    let place = place.file(name, &edited);
    let run = place.run_with(&["q-project", "gear 1234.dxf"]);
    assert!(run.status != Some(0) && run.stderr.contains("PB004"), "{run}");
    assert_eq!(place.read(name), edited);
    // An editor of texts keeps the mark.
    let edited = ours.replacen("O2", "O3", 1);
    assert_ne!(edited, ours);
    let place = place.file(name, &edited);
    let run = place.run_with(&["q-project", "gear 1234.dxf"]);
    assert!(run.status != Some(0) && run.stderr.contains("PB004"), "{run}");
    assert_eq!(place.read(name), edited);
    let place = place.file(name, &ours);
    assert_eq!(place.run_with(&["q-project", "gear 1234.dxf"]).status, Some(0));
}

#[test]
fn a_drawing_that_is_missing_is_named_before_its_path() {
    let place = Place::of(DRAWING);
    let run = place.run("q-project nope.dxf");
    assert!(run.status == Some(1) && run.stderr.contains("PB001"), "{run}");
    std::fs::rename(place.path().join("gear 1234.dxf"), place.path().join("nope.dxf")).unwrap();
    let run = place.run("q-project nope.dxf");
    assert!(run.status == Some(2) && run.stderr.contains("--path-name"), "{run}");
}

/// The drawing may be named by a pattern or, if it has one path, by that path.
#[test]
fn its_drawing_is_named_as_for_other_commands() {
    let place = Place::of(DRAWING);
    for (argument, status, message) in [
        ("gear*.dxf", 0, "1234_Q.dxf: written"),
        ("1234.1P", 2, "name the drawing instead of 1234.1P"),
        (".", 2, "name the drawing instead of ."),
        ("gaer*.dxf", 1, "PB001"),
    ] {
        let run = place.run(&format!("q-project {argument}"));
        assert!(run.status == Some(status) && run.stderr.contains(message), "{argument}: {run}");
    }
    let lone = Place::of(LONE);
    assert!(lone.run("q-project 5678.1P").stderr.contains("5678_Q.dxf: written"));
}

const LONE: &str =
    "== 5678.dxf ==\nlayer 5678.1P\nstart 0,0 \"T5 O2 I5 B0 F150 S20 MPlate\"\nmill 0,0 40,0\nend 40,0\n";
