//! An empty input is not a success. (book: reference/diagnostics, PB513, PB518)

use std::fs;

use crate::support::{Place, Run, dxf};

const PATH: &str = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n";
const REMARKS: &str = "layer remarks\nline 0,0 40,0\n";
const OPTIONS: &str = "--feed 150 --rapid 1000 --sweep-height 20";

fn place(files: &[(&str, &str)]) -> Place {
    let dxf = |text: &str| pathbuild_testkit::sheet(text).unwrap().to_dxf();
    files.iter().fold(Place::new(), |place, (name, text)| match name.strip_suffix(".toml") {
        Some(_) => place.file(name, text),
        None => place.file(name, dxf(text)),
    })
}

/// Returns the exit status, and the codes on stderr.
fn found(run: &Run) -> (Option<i32>, Vec<&str>) {
    let codes = run.stderr.split("[PB").skip(1).map(|rest| &rest[..3]);
    (run.status, codes.collect())
}

#[track_caller]
fn assert_found(place: &Place, arguments: &str, status: i32, codes: &[&str]) {
    // Test with and without a cache.
    for cache in ["", "--no-cache", ""] {
        let run = place.run(&format!("{arguments} {cache} --format concise"));
        assert_eq!(found(&run), (Some(status), codes.to_vec()), "{run}");
    }
}

#[test]
fn a_directory_of_the_configuration_that_is_missing_is_an_error() {
    for key in ["library = [\"parts\", \"gone\"]", "library = [\"parts\"]\nsearch = [\"gone\"]"] {
        let place = place(&[("pathbuild.toml", key), ("parts/1234.1P.dxf", PATH)]);
        for command in ["check".to_owned(), "check parts".to_owned(), format!("emit parts {OPTIONS} --check")]
        {
            assert!(place.run(&command).stderr.contains("names gone, which is not a directory"), "{command}");
            assert_eq!(place.run(&command).status, Some(1));
        }
        let place = place.file("gone/notes.txt", "");
        assert_found(&place, "check", 0, &[]);
    }
}

#[test]
fn a_searched_directory_of_the_command_line_that_is_missing_is_an_error() {
    let place = place(&[("1234.1P.dxf", PATH)]);
    assert_found(&place, "check 1234.1P.dxf --search gone", 1, &["003"]);
    assert_found(&place, "check 1234.1P.dxf --search .", 0, &[]);
    // A drawing is not a valid search directory, although a library may list one.
    assert_found(&place, "check 1234.1P.dxf --search 1234.1P.dxf", 1, &["003"]);
}

#[test]
fn a_missing_directory_is_reported_where_it_is_named() {
    let place = place(&[("pathbuild.toml", "\nsearch = [\"gone\"]"), ("1234.1P.dxf", PATH)]);
    let run = place.run("check 1234.1P.dxf --search lost --format concise");
    let lines: Vec<&str> = run.stderr.lines().filter(|line| line.contains("PB003")).collect();
    assert!(lines.len() == 2 && lines.iter().any(|line| line.starts_with("pathbuild.toml:2:")), "{run}");
    assert!(lines.iter().any(|line| line.starts_with("error[PB003]") && line.contains("lost")), "{run}");
}

/// Every command that takes one path explains, by the pattern, how a path's layer must be named.
#[test]
fn every_command_names_the_pattern_of_paths() {
    let place = place(&[("remarks.dxf", REMARKS), ("pathbuild.toml", "path-pattern = 'X[0-9]+'\n")])
        .file("program.nc", "G21 G90 G17\nG0 X0 Y0 Z5\nM30\n");
    let commands = [
        "check remarks.dxf",
        "emit remarks.dxf",
        "view remarks.dxf -o picture.json",
        "sheet remarks.dxf -o sheet.svg",
        "verify program.nc --against remarks.dxf",
        "q-project remarks.dxf --path-name X1",
    ];
    for command in commands {
        let run = place.run(&format!("{command} {OPTIONS}"));
        let run = if run.status == Some(2) { place.run(command) } else { run };
        assert_eq!(found(&run), (Some(1), vec!["513"]), "{command}: {run}");
        assert!(run.stderr.contains("a name that matches X[0-9]+"), "{command}: {run}");
    }
}

#[test]
fn a_drawing_that_was_named_holds_a_path() {
    let place = place(&[("remarks.dxf", REMARKS), ("1234.1P.dxf", PATH)]);
    assert_found(&place, "check remarks.dxf", 1, &["513"]);
    assert_found(&place, "check remarks.dxf 1234.1P.dxf", 1, &["513"]);
    assert_found(&place, "check 1234.1P.dxf", 0, &[]);
    assert_found(&place, "check remarks.dxf --compatible", 0, &[]);
    // In a directory, drawings without paths are common.
    assert_found(&place, "check .", 0, &[]);
}

#[test]
fn a_drawing_that_cannot_be_read_is_one_error() {
    let place = Place::new().file("1234.dxf", "no drawing");
    assert_found(&place, "check 1234.dxf", 1, &["002"]);
}

#[test]
fn a_directory_without_drawings_is_an_error() {
    let place = place(&[("parts/1234.1P.dxf", PATH), ("empty/notes.toml", ""), ("none/notes.toml", "")]);
    assert_found(&place, "check empty", 1, &["518"]);
    assert_found(&place, "check parts empty none", 1, &["518", "518"]);
    assert_found(&place, &format!("emit empty {OPTIONS}"), 1, &["518"]);
    assert_found(&place, "check .", 0, &[]);
}

/// A new library has no projects yet.
#[test]
fn a_library_needs_one_drawing() {
    let configured = [("pathbuild.toml", "library = [\"parts\", \"new\"]"), ("new/notes.toml", "")];
    let place = place(&configured).file("parts/notes.txt", "");
    assert_found(&place, "check", 1, &["518"]);
    let place = place.file("parts/1234.1P.dxf", pathbuild_testkit::sheet(PATH).unwrap().to_dxf());
    assert_found(&place, "check", 0, &[]);
    fs::write(place.path().join("parts/.ignore"), "*.dxf").unwrap();
    assert_found(&place, "check", 1, &["518"]);
}

/// A share that is not mounted, or a submodule that was not checked out, is an empty directory. The programs of its drawings must stay.
#[test]
fn a_directory_of_the_library_is_not_empty() {
    let configuration = "library = [\"parts\", \"share\"]\nout-dir = \"gcode\"\n[emit]\ntargets = [\"*\"]\n";
    let place = place(&[
        ("pathbuild.toml", configuration),
        ("parts/1234.1P.dxf", PATH),
        ("share/1235.1P.dxf", &PATH.replace("1234", "1235")),
    ]);
    let emit = format!("emit {OPTIONS}");
    assert_found(&place, &emit, 0, &[]);
    let share = place.path().join("share");
    fs::remove_file(share.join("1235.1P.dxf")).unwrap();
    for command in ["check", "list", "stats", "check 1234.1P", &format!("{emit} --remove-stale")] {
        assert_found(&place, command, 1, &["518"]);
    }
    assert!(place.path().join("gcode/1235.1P_Milling.gcode").exists());
    let place = place.file("share/notes.txt", "");
    for command in ["check", "list", "stats", "check 1234.1P", &format!("{emit} --remove-stale")] {
        assert_found(&place, command, 0, &[]);
    }
    assert!(!place.path().join("gcode/1235.1P_Milling.gcode").exists());
    fs::remove_file(place.path().join("parts/1234.1P.dxf")).unwrap();
    assert_found(&place, &format!("{emit} --remove-stale"), 1, &["518"]);
    assert!(place.path().join("gcode/1234.1P_Milling.gcode").exists());
}

#[test]
fn drawings_without_any_path_are_an_error() {
    let place = place(&[("parts/remarks.dxf", REMARKS), ("parts/more.dxf", REMARKS)]);
    assert_found(&place, "check parts", 1, &["518"]);
    assert_found(&place, "check parts --compatible", 0, &[]);
    assert_found(&place, &format!("emit parts {OPTIONS}"), 1, &["518"]);
}

#[test]
fn a_path_that_became_wrong_leaves_an_older_program() {
    let place =
        place(&[("pathbuild.toml", "feed = 150\nrapid = 1000\nsweep-height = 20\n"), ("1234.1P.dxf", PATH)]);
    let emit = |arguments: &str| place.run(&format!("emit {arguments} --format concise"));
    assert_eq!(emit(".").status, Some(0));
    assert!(!emit(".").stderr.contains("PB522"));
    let wrong = PATH.replace("B0", "");
    fs::write(place.path().join("1234.1P.dxf"), pathbuild_testkit::sheet(&wrong).unwrap().to_dxf()).unwrap();
    for arguments in [".", "1234.1P.dxf", "1234.1P", ". --check", ". --no-cache", "."] {
        let run = emit(arguments);
        assert_eq!(run.status, Some(1), "{run}");
        let severity = if arguments.contains("--check") { "error" } else { "warning" };
        let said = format!("1234.1P_Milling.gcode: {severity}[PB522] path 1234.1P was not written");
        assert!(run.stderr.contains(&said), "{run}");
    }
    let compared = emit(". --check").stdout;
    assert_eq!(compared, "1234.1P_Milling.gcode: not current\n");
    // Printing neither writes nor examines files.
    assert!(!emit("1234.1P -o -").stderr.contains("PB522"));
    fs::remove_file(place.path().join("1234.1P_Milling.gcode")).unwrap();
    assert!(!emit(".").stderr.contains("PB522"));
}

/// The drawing is damaged, empty or gone, so that the named path is unknown.
#[test]
fn a_lost_drawing_leaves_an_older_program() {
    let place =
        place(&[("pathbuild.toml", "feed = 150\nrapid = 1000\nsweep-height = 20\n"), ("1234.1P.dxf", PATH)]);
    let emit = |arguments: &str| place.run(&format!("emit {arguments} --format concise"));
    let drawing = place.path().join("1234.1P.dxf");
    let sound = fs::read(&drawing).unwrap();
    let told = "1234.1P_Milling.gcode: warning[PB522] path 1234.1P was not written";
    assert!(emit("1234.1P").status == Some(0) && !emit("1234.1P").stderr.contains("PB522"));
    for damaged in [Some(&b"x"[..]), Some(b""), Some(&sound[..sound.len() / 2]), None] {
        match damaged {
            Some(damaged) => fs::write(&drawing, damaged).unwrap(),
            None => fs::remove_file(&drawing).unwrap(),
        }
        for arguments in ["1234.1P", "1234.1P.dxf", "1234.1P --no-cache"] {
            let run = emit(arguments);
            assert!(run.status == Some(1) && run.stderr.contains(told), "{run}");
        }
        let run = emit("1234.1P --check");
        assert!(run.stderr.contains("1234.1P_Milling.gcode: error[PB522]"), "{run}");
        assert_eq!(run.stdout, "1234.1P_Milling.gcode: not current\n");
        assert!(!emit("1234.2P").stderr.contains("PB522"));
    }
    // Its program may be that of another drawing, which the name does not lead to.
    fs::write(place.path().join("gear.dxf"), &sound).unwrap();
    assert_eq!(emit("gear.dxf").status, Some(0));
    assert!(!emit("1234.1P").stderr.contains("gear_Milling.gcode"));
}

#[test]
fn a_program_of_another_path_is_not_older() {
    let both = format!("{PATH}{}", PATH.replace("1234.1P", "1234.2P").replace(",0", ",20"));
    let place =
        place(&[("pathbuild.toml", "feed = 150\nrapid = 1000\nsweep-height = 20\n"), ("1234.dxf", &*both)]);
    assert_eq!(place.run("emit .").status, Some(0));
    let wrong = both.replacen("B0", "", 1);
    fs::write(place.path().join("1234.dxf"), pathbuild_testkit::sheet(&wrong).unwrap().to_dxf()).unwrap();
    let run = place.run("emit . --format concise");
    assert!(run.stderr.contains("path 1234.1P was not written"), "{run}");
    assert!(!run.stderr.contains("path 1234.2P was not written"), "{run}");
}

#[test]
fn paths_that_cannot_be_joined_leave_an_older_program() {
    let place = place(&[
        ("pathbuild.toml", "feed = 150\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n"),
        ("1234.1P.dxf", PATH),
    ]);
    let emit = || place.run("emit 1234.1P --join all --post grbl --format concise");
    assert_eq!(emit().status, Some(0), "{}", emit());
    let wrong = PATH.replace("B0", "");
    fs::write(place.path().join("1234.1P.dxf"), pathbuild_testkit::sheet(&wrong).unwrap().to_dxf()).unwrap();
    let run = emit();
    assert!(run.stderr.contains("PB522") && run.stderr.contains("all_Milling"), "{run}");
}

#[test]
fn an_empty_program_is_no_program() {
    let place = place(&[]).file("empty.nc", "").file("blank.nc", " \r\n").file("end.nc", "M30\n");
    for name in ["empty.nc", "blank.nc"] {
        assert_found(&place, &format!("verify {name}"), 1, &["701"]);
    }
    assert_found(&place, "verify end.nc", 0, &[]);
    assert!(!place.run("verify empty.nc --format json").stdout.contains("\"line\":0"));
}

#[test]
fn a_pattern_shows_where_its_paths_are() {
    let other = PATH.replace("1234", "1235");
    let place =
        place(&[("pathbuild.toml", "library = [\".\"]\n"), ("1234.1P.dxf", PATH), ("1235.1P.dxf", &other)]);
    let shown = |pattern: &str| place.run_with(&["where", pattern]);
    let files = |pattern: &str| shown(pattern).stdout.matches(".dxf").count();
    assert_eq!([files("123*"), files("*5.1P"), files("1234.1P")], [2, 1, 1]);
    assert_eq!(found(&shown("13*")), (Some(1), vec!["503"]));
    let several = place.run_with(&["view", "123*", "-o", "x.svg"]);
    assert_eq!(found(&several), (Some(1), vec!["512"]), "{several}");
    assert!(several.stderr.contains("1234.1P, 1235.1P"), "{several}");
    assert_eq!(place.run_with(&["view", "*5.1P", "-o", "x.svg", "--feed", "9"]).status, Some(0));
}

/// Names that look alike may consist of different characters.
#[test]
fn a_name_with_other_unicode_characters_is_explained() {
    let [composed, decomposed] = ["M\u{fc}ller.dxf", "Mu\u{308}ller.dxf"];
    for (file, argument, is_explained) in
        [(composed, decomposed, true), (decomposed, composed, true), (composed, "M\u{fc}lller.dxf", false)]
    {
        let run = Place::new().file(file, "").run(&format!("check {argument}"));
        assert!(run.stderr.contains(&format!("did you mean {file}?")), "{run}");
        assert_eq!(run.stderr.contains("NFC or NFD"), is_explained, "{run}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_nowhere_is_not_called_misspelled() {
    let place = place(&[("pathbuild.toml", "library = [\".\"]\n"), ("1234.1P.dxf", PATH)]);
    std::os::unix::fs::symlink("gone.dxf", place.path().join("1235.1P.dxf")).unwrap();
    let run = place.run("check --lang en");
    assert_eq!(found(&run), (Some(1), vec!["001"]), "{run}");
    assert!(
        run.stderr.contains("the file that this link points to") && !run.stderr.contains("did you mean"),
        "{run}"
    );
    let missing = place.run("check 1236.1P.dxf --lang en");
    assert!(missing.stderr.contains("there is no such file"), "{missing}");
}

#[test]
fn a_feed_that_a_program_cannot_state_is_an_error() {
    let with = |feed: &str| PATH.replace("B0", &format!("B0 F{feed}"));
    let drawn = |feed: &str| place(&[("1234.1P.dxf", &with(feed))]);
    assert_found(&drawn("0.0004"), "check 1234.1P.dxf", 1, &["203"]);
    assert_found(&drawn("0.0005"), "check 1234.1P.dxf", 0, &[]);
    let written = drawn("0.0005").run("emit 1234.1P.dxf --rapid 1000 --sweep-height 20 -o -");
    assert_eq!(written.status, Some(0), "{written}");
    for (key, value, status) in [
        ("feed", "0.0009", 2),
        ("feed", "0.001", 0),
        ("rapid", "1e-300", 2),
        ("sweep-height", "1000000", 0),
        ("sweep-height", "1e300", 2),
    ] {
        let place = place(&[("pathbuild.toml", &format!("{key} = {value}\n")), ("1234.1P.dxf", PATH)]);
        let run = place.run("check 1234.1P.dxf");
        assert_eq!(run.status.map(|status| status.min(1)), Some(status.min(1)), "{key} {run}");
    }
}

#[test]
fn a_write_protected_program_stays() {
    let place = place(&[("1234.1P.dxf", PATH)]);
    let emit = || place.run(&format!("emit 1234.1P.dxf {OPTIONS} --format concise --lang en"));
    assert_eq!(emit().status, Some(0));
    let program = place.path().join("1234.1P_Milling.gcode");
    fs::write(&program, "mine").unwrap();
    let mut permissions = fs::metadata(&program).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&program, permissions.clone()).unwrap();
    let refused = emit();
    assert_eq!(found(&refused), (Some(1), vec!["004"]), "{refused}");
    assert!(refused.stderr.contains("write-protected"), "{refused}");
    assert_eq!(fs::read_to_string(&program).unwrap(), "mine");
    #[expect(clippy::permissions_set_readonly_false, reason = "the file is removed with its directory")]
    permissions.set_readonly(false);
    fs::set_permissions(&program, permissions).unwrap();
    assert_eq!(emit().status, Some(0));
}

/// Without a configuration only the working directory is searched, although its subdirectories are known. (PB503)
#[test]
fn a_drawing_that_is_not_searched_is_named_with_the_reason() {
    let path =
        |name: &str| dxf(&format!("layer {name}\nstart 0,0 \"T2 O2 I1 B0\"\nmill 0,0 20,0\nend 20,0\n"));
    let place = Place::new()
        .file("parts/1234.1P.dxf", path("1234.1P"))
        .file("parts/1300.1-1300.2P.dxf", path("1300.2P"))
        .file("parts/1400.1P.dxf", path("1400.2P"));
    let missed = |name: &str, lang: &str| {
        let run = place.run(&format!("emit {name} --lang {lang}"));
        assert_eq!(run.status, Some(1), "{run}");
        run.stderr
    };
    let (en, de) =
        ("defines the path, but its directory is not searched", "aber das Verzeichnis wird nicht durchsucht");
    for (name, file) in [("1234.1P", "parts/1234.1P.dxf"), ("1300.2P", "parts/1300.1-1300.2P.dxf")] {
        let text = missed(name, "en");
        assert!(text.contains(&format!("{file} {en}")), "{text}");
        let text = missed(name, "de");
        assert!(text.contains(de), "{text}");
    }
    let text = missed("1400.2P", "en");
    assert!(text.contains("although its file name does not contain the path's name"), "{text}");
    assert_eq!(place.run("check parts/1234.1P.dxf").status, Some(0));
}
