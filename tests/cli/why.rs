//! Tests `pathbuild why`, which gives the reasons why results of the last check no longer hold. (book: reference/commands)

use std::fmt::Write;

use pathbuild_testkit::sheet;

use crate::support::Place;

const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["."]
== 1111.dxf ==
layer 1111.1P
start 0,0 "T5 O3 I1 B0 Mx"
mill 0,0 20,0
end 20,0
== 1112.dxf ==
layer 1112.1P
start 0,0 "T5 O3 I1 B0 Mx"
mill 0,0 20,0
end 20,0
== 8001.dxf ==
layer 8001.1P
start 0,0 "T5 O3 Mx"
subpath 0,0 20,0 ">1111.1P"
end 20,0
"#;

/// Creates a library that has been checked.
fn checked() -> Place {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("check").status, Some(0));
    place
}

fn why(place: &Place, what: &str) -> String {
    let run = place.run(&format!("why {what}"));
    assert_eq!(run.status, Some(0), "{run}");
    run.stdout
}

#[test]
fn before_a_check_nothing_is_kept() {
    let said = why(&Place::of(LIBRARY), "8001.1P");
    assert!(said.starts_with("8001.dxf: would be compiled: there is no cached result"), "{said}");
}

#[test]
fn without_a_change_everything_holds() {
    let said = why(&checked(), "");
    assert_eq!(said.lines().filter(|line| line.contains("up to date")).count(), 3, "{said}");
}

#[test]
fn a_changed_component_is_named_and_its_sibling_is_not() {
    let place = checked();
    let bytes = std::fs::read_to_string(place.path().join("1111.dxf")).unwrap();
    let place = place.file("1111.dxf", bytes.replacen("B0", "B1", 1));
    assert_eq!(why(&place, "8001.1P"), "8001.dxf: would be compiled again\n  1111.dxf has changed\n");
    assert!(why(&place, "1112.1P").contains("up to date"));
}

#[test]
fn a_component_that_is_gone_is_named() {
    let place = checked();
    std::fs::remove_file(place.path().join("1111.dxf")).unwrap();
    assert_eq!(why(&place, "8001.1P"), "8001.dxf: would be compiled again\n  1111.dxf is gone\n");
}

#[test]
fn a_new_file_that_may_hold_an_embedded_path_is_named_and_another_is_not() {
    let place = checked();
    let bytes = std::fs::read(place.path().join("1112.dxf")).unwrap();
    let place = place.file("1113.dxf", &bytes);
    assert!(why(&place, "8001.dxf").contains("up to date"), "1113 cannot hold 1111.1P");
    let place = place.file("1111 new.dxf", &bytes);
    let expected = "8001.dxf: would be compiled again\n  1111 new.dxf is new and may contain 1111.1P\n";
    assert_eq!(why(&place, "8001.dxf"), expected);
    let json = why(&place, "8001.dxf --format json");
    let reason = r#"{"type":"result","file":"8001.dxf","holds":false,"reasons":[{"file":"1111 new.dxf","change":"new","path":"1111.1P"}]}"#;
    let reason: serde_json::Value = serde_json::from_str(reason).unwrap();
    let line = json.lines().nth(1).unwrap();
    assert_eq!(serde_json::from_str::<serde_json::Value>(line).unwrap(), reason);
}

#[test]
fn without_a_configuration_there_is_nothing_to_ask() {
    let place = Place::of(&LIBRARY.replace("pathbuild.toml", "other.toml"));
    assert_eq!(place.run("why 8001.1P").status, Some(2));
    assert_eq!(checked().run("why 8001.1P --no-cache").status, Some(2));
}

/// The result of work that was cancelled is not cached, because the machine may have been busy.
#[test]
fn what_took_too_long_is_compiled_again() {
    let mut lines = String::new();
    for x in 0..10_000 {
        writeln!(lines, "mill {x},{} {},{}", x % 2, x + 1, (x + 1) % 2).unwrap();
    }
    let drawn = format!("layer 1111.1P\nstart 0,0 \"T5 O3 I1 B0 Mx\"\n{lines}end 10000,0\n");
    let configuration = |seconds| format!("library = [\".\"]\n[limits]\nseconds-per-path = {seconds}\n");
    let place = Place::new().file("1111.dxf", sheet(&drawn).unwrap().to_dxf());
    let place = place.file("pathbuild.toml", configuration("0.001"));
    let run = place.run("check");
    assert!(run.status == Some(1) && run.stderr.contains("seconds-per-path"), "{run}");
    assert!(why(&place, "1111.1P").contains("there is no cached result"));
    let place = place.file("pathbuild.toml", configuration("60"));
    assert_eq!(place.run("check").status, Some(0));
    assert!(why(&place, "1111.1P").contains("up to date"));
}

/// The targets of links are part of a cached result, which holds as long as they and the files are unchanged.
#[cfg(unix)]
#[test]
fn results_hold_in_directories_with_links() {
    use std::fs;
    use std::os::unix::fs::symlink;

    let all_hold = |place: &Place| {
        let said = why(place, "");
        assert!(said.lines().all(|line| line.ends_with(": up to date")), "{said}");
    };
    let link = |target: &str, link: &std::path::Path| {
        _ = fs::remove_file(link);
        symlink(target, link).unwrap();
    };
    let place = Place::of(LIBRARY);
    let component = place.path().join("1111.dxf");
    let bytes = fs::read(&component).unwrap();
    fs::remove_file(&component).unwrap();
    let place = place.file("store/a.bin", &bytes).file("store/b.bin", &bytes).file("store/c.bin", &bytes);
    link("store/a.bin", &component);
    assert_eq!(place.run("check").status, Some(0));
    all_hold(&place);
    // The file to which the link points has changed.
    fs::write(place.path().join("store/a.bin"), [&bytes[..], b"\n"].concat()).unwrap();
    assert_eq!(why(&place, "8001.1P"), "8001.dxf: would be compiled again\n  1111.dxf has changed\n");
    assert_eq!(place.run("check").status, Some(0));
    all_hold(&place);
    // The link points to a file with the same bytes, which may be another drawing.
    link("store/b.bin", &component);
    let said = why(&place, "8001.1P");
    assert!(
        said.contains(". contains a symbolic link, or is reached through one, that leads elsewhere now"),
        "{said}"
    );
    assert_eq!(place.run("check").status, Some(0));
    all_hold(&place);

    // A directory that is searched is a link.
    let configuration = "library = [\"projects\"]\nsearch = [\"parts\"]\n";
    let place = Place::of(LIBRARY).file("pathbuild.toml", configuration);
    for directory in ["projects", "store", "other"] {
        fs::create_dir(place.path().join(directory)).unwrap();
    }
    fs::rename(place.path().join("8001.dxf"), place.path().join("projects/8001.dxf")).unwrap();
    fs::copy(place.path().join("1111.dxf"), place.path().join("other/1111.dxf")).unwrap();
    fs::rename(place.path().join("1111.dxf"), place.path().join("store/1111.dxf")).unwrap();
    link("store", &place.path().join("parts"));
    assert_eq!(place.run("check").status, Some(0));
    all_hold(&place);
    link("other", &place.path().join("parts"));
    assert!(why(&place, "").contains("parts contains a symbolic link, or is reached through one"));
    assert_eq!(place.run("check").status, Some(0));
    all_hold(&place);
}
