//! Tests `--untrusted` with several trees, links between them, and a cache in one of them. (book: reference/configuration)
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::time::Duration;

use crate::support::{Place, Run};
use crate::untrusted::{CONFIGURATION, dxf};

/// Creates two repositories, `one` and `two`, and a drawing outside of both, to which a link in `two` points.
fn trees() -> Place {
    let place = Place::new()
        .file("one/.git/HEAD", "")
        .file("one/1201.1P.dxf", dxf("1201.1P"))
        .file("two/.git/HEAD", "")
        .file("two/1202.1P.dxf", dxf("1202.1P"))
        .file("own/pathbuild.toml", CONFIGURATION)
        .file("outside/1204.1P.dxf", dxf("1204.1P"));
    symlink("../outside/1204.1P.dxf", place.path().join("two/1204.1P.dxf")).unwrap();
    place
}

#[track_caller]
fn assert_status(run: &Run, status: i32, code: &str) {
    assert_eq!((run.status, run.stderr.contains(code)), (Some(status), !code.is_empty()), "{run}");
}

/// The user's own configuration does not make the tree of another argument trusted.
#[test]
fn each_argument_is_confined_to_its_own_repository() {
    for arguments in ["check one two", "check two one", "check two", "--config own/pathbuild.toml check two"]
    {
        let run = trees().run(&format!("--untrusted {arguments}"));
        assert_eq!(run.status, Some(1), "{arguments}: {run}");
        assert!(run.stderr.contains("PB001") && run.stderr.contains("1204.1P.dxf"), "{arguments}: {run}");
        // In a trusted tree, the link is followed like any other.
        let run = trees().run(arguments);
        assert_eq!(run.status, Some(0), "{arguments}: {run}");
    }
}

#[test]
fn one_tree_that_is_not_trusted_makes_the_run_untrusted() {
    let trusting = |trusted: &[&str]| {
        let place = trees();
        let roots: Vec<String> = trusted.iter().map(|it| format!("{:?}", place.path().join(it))).collect();
        place.users(&format!("[trust]\nroots = [{}]\n", roots.join(", "))).run("check one two")
    };
    assert_eq!(trusting(&["one", "two"]).status, Some(0));
    assert_status(&trusting(&["one"]), 1, "PB001");
    assert_status(&trusting(&["two"]), 1, "PB001");
}

/// A link inside a repository does not decide which tree is read and written.
#[test]
fn a_link_in_a_repository_leads_to_no_other_one() {
    let place = || {
        let place = Place::new()
            .file("tree/.git/HEAD", "")
            .file("tree/pathbuild.toml", CONFIGURATION)
            .file("other/.git/HEAD", "")
            .file("other/pathbuild.toml", CONFIGURATION)
            .file("other/1204.1P.dxf", dxf("1204.1P"));
        symlink("../other", place.path().join("tree/components")).unwrap();
        // The user's own link points to a tree and is outside of any repository.
        symlink("other", place.path().join("mine")).unwrap();
        place
    };
    let program = |place: &Place| place.path().join("other/1204.1P_Milling.gcode").exists();
    let led = place();
    let run = led.run_in("tree", &["--untrusted", "emit", "components"]);
    assert!(run.status != Some(0) && !program(&led), "{run}");
    let own = place();
    assert_eq!(own.run("--untrusted emit mine").status, Some(0));
    assert!(program(&own));
}

/// A pull request may contain cached results that do not match its drawings.
#[test]
fn a_cache_in_a_strangers_tree_is_not_used() {
    for (cache, is_used) in [
        ("../cache", true),
        (".cache", false),
        ("link/cache", false),
        // These links are outside and point into the tree.
        ("../alias/.cache", false),
        ("../outside/inner/deep/.cache", false),
        ("../alias/../cache", true),
    ] {
        let place = Place::new()
            .file("tree/.git/HEAD", "")
            .file("tree/pathbuild.toml", CONFIGURATION)
            .file("tree/1202.1P.dxf", dxf("1202.1P"))
            .file("outside/file", "");
        symlink("../outside", place.path().join("tree/link")).unwrap();
        symlink("tree", place.path().join("alias")).unwrap();
        symlink("../tree", place.path().join("outside/inner")).unwrap();
        let run = |options: &str| {
            let options: Vec<&str> = options.split_whitespace().collect();
            place.run_in("tree", &[&["--cache-dir", cache, "check", "."], &*options].concat())
        };
        let found = run("--untrusted");
        assert_eq!(found.status, Some(0), "{cache}: {found}");
        assert_eq!(found.stderr.contains("in an untrusted directory tree"), !is_used, "{cache}: {found}");
        assert_eq!(place.path().join("tree").join(cache).exists(), is_used, "{cache}");
        // In a trusted tree, the cache is used wherever it is.
        run("");
        assert!(place.path().join("tree").join(cache).exists(), "{cache}");
    }
}

/// The user's cache directory may also be a link into an untrusted tree.
#[test]
fn a_persons_cache_directory_in_a_strangers_tree_is_not_used() {
    let place = Place::new()
        .file("tree/.git/HEAD", "")
        .file("tree/pathbuild.toml", CONFIGURATION)
        .file("tree/1202.1P.dxf", dxf("1202.1P"));
    symlink("tree", place.path().join("alias")).unwrap();
    let mut program = crate::support::program();
    program.env("XDG_CACHE_HOME", place.path().join("alias/xdg")).current_dir(place.path().join("tree"));
    assert!(program.args(["--untrusted", "check", "."]).status().unwrap().success());
    assert!(!place.path().join("tree/xdg").exists());
}

#[test]
fn an_example_is_not_written_out_of_a_strangers_tree() {
    for (options, is_written) in [("--untrusted", false), ("--quiet", true)] {
        let place = Place::new().file("tree/.git/HEAD", "").file("outside/file", "");
        symlink("../outside", place.path().join("tree/components")).unwrap();
        let run = place.run_in("tree", &["init", "--example", options]);
        assert_eq!(
            (run.status, run.stderr.contains("PB004")),
            (Some(i32::from(!is_written)), !is_written),
            "{run}"
        );
        assert_eq!(place.path().join("outside/2001.1P.dxf").exists(), is_written, "{run}");
        assert_eq!(place.path().join("tree/pathbuild.toml").exists(), is_written, "{run}");
    }
    // Without the link, all files of the example are within the tree.
    let place = Place::new().file("tree/.git/HEAD", "");
    let run = place.run_in("tree", &["init", "--example", "--untrusted"]);
    assert_eq!(run.status, Some(0), "{run}");
    assert!(place.path().join("tree/components/2001.1P.dxf").exists(), "{run}");
}

/// A file has the same bytes and stamp if it is reached by a link, so its cached result must not be used.
#[test]
fn what_is_known_of_a_drawing_is_not_known_of_it_behind_a_link() {
    let place = Place::new()
        .file("tree/.git/HEAD", "")
        .file("tree/pathbuild.toml", CONFIGURATION)
        .file("tree/sub/1202.1P.dxf", dxf("1202.1P"));
    // The stamp of the file is cached only after it has not changed for a while.
    std::thread::sleep(Duration::from_secs(4));
    let check = || place.run_in("tree", &["--untrusted", "check", "sub/1202.1P.dxf"]);
    assert_eq!(check().status, Some(0));
    assert_eq!(check().status, Some(0));
    let sub = place.path().join("tree/sub");
    fs::rename(&sub, place.path().join("outside")).unwrap();
    symlink("../outside", &sub).unwrap();
    assert_status(&check(), 1, "PB001");
}
