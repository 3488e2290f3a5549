//! `check --changed-since REV` and `--timings`.

use std::fs;
use std::process::Command;

use crate::support::Place;
use pathbuild_testkit::sheet;

fn dxf(name: &str, thickness: u32, embeds: Option<&str>) -> Vec<u8> {
    let element = embeds.map_or("mill 0,0 40,0".to_owned(), |name| format!("subpath 0,0 40,0 \">{name}\""));
    let text = format!("layer {name}\nstart 0,0 \"T{thickness} O2 I1 B0 MPlate\"\n{element}\nend 40,0\n");
    sheet(&text).unwrap().to_dxf()
}

fn git(place: &Place, arguments: &[&str]) {
    let identity =
        ["-c", "user.name=a", "-c", "user.email=a@example.invalid", "-c", "init.defaultBranch=main"];
    let run = Command::new("git").args(identity).args(arguments).current_dir(place.path()).output().unwrap();
    assert!(run.status.success(), "git {arguments:?}: {}", String::from_utf8_lossy(&run.stderr));
}

/// A library under Git, of which everything is committed. The project 8003 looks for something that is not there.
fn library() -> Place {
    let place = Place::new()
        .file("pathbuild.toml", "library = [\"parts\", \"projects\"]\nsearch = [\"parts\"]\n")
        .file("parts/1001.dxf", dxf("1001.1P", 5, None))
        .file("parts/1002.dxf", dxf("1002.1P", 5, None))
        .file("projects/8001.dxf", dxf("8001.1P", 5, Some("1001.1P")))
        .file("projects/8002.dxf", dxf("8002.1P", 5, Some("8001.1P")))
        .file("projects/8003.dxf", dxf("8003.1P", 5, Some("1009.1P")));
    git(&place, &["init", "-q"]);
    git(&place, &["add", "-A"]);
    git(&place, &["commit", "-q", "-m", "all"]);
    place
}

/// What the summary says of how much was checked.
fn checked(place: &Place, arguments: &str) -> String {
    let run = place.run(arguments);
    let summary = run.stderr.lines().last().unwrap_or_default().to_owned();
    summary.split(':').next().unwrap_or_default().to_owned()
}

#[test]
fn what_depends_on_a_change_is_checked_and_nothing_else() {
    for cache in ["", " --no-cache"] {
        let place = library();
        let since = format!("check --changed-since HEAD{cache}");
        assert_eq!(checked(&place, &since), "0 paths in 0 drawings");
        fs::write(place.path().join("parts/1001.dxf"), dxf("1001.1P", 4, None)).unwrap();
        assert_eq!(checked(&place, &since), "3 paths in 3 drawings");
        assert!(place.run(&since).stderr.contains("PB506"));
        git(&place, &["commit", "-q", "-a", "-m", "thinner"]);
        assert_eq!(checked(&place, &since), "0 paths in 0 drawings");
        assert_eq!(checked(&place, &format!("check --changed-since HEAD~1{cache}")), "3 paths in 3 drawings");
    }
}

#[test]
fn files_that_came_or_went_concern_what_looked_for_them() {
    let place = library();
    fs::write(place.path().join("parts/1009.dxf"), dxf("1009.1P", 5, None)).unwrap();
    assert_eq!(checked(&place, "check --changed-since HEAD"), "2 paths in 2 drawings");
    git(&place, &["add", "-A"]);
    git(&place, &["commit", "-q", "-m", "found"]);
    fs::remove_file(place.path().join("parts/1009.dxf")).unwrap();
    let run = place.run("check --changed-since HEAD --format concise");
    assert!(run.stderr.contains("8003.dxf") && run.stderr.contains("PB503"), "{run}");
}

#[test]
fn it_is_told_from_a_directory_below_as_well() {
    let place = library().file("projects/deep/8004.dxf", dxf("8004.1P", 5, Some("1002.1P")));
    let run = place.run_in("projects", &["check", ".", "--changed-since", "HEAD"]);
    assert!(
        run.stderr.starts_with("1 path in 1 drawing") || run.stderr.contains("\n1 path in 1 drawing"),
        "{run}"
    );
}

#[test]
fn what_git_cannot_tell_is_wrong_usage() {
    let place = library();
    let run = place.run("check --changed-since no-such-revision");
    assert_eq!(run.status, Some(2), "{run}");
    let run = place.run("check --changed-since=--output=x");
    assert_eq!(run.status, Some(2), "{run}");
    assert!(!place.path().join("x").exists());
    let run = place.run("check projects/8001.dxf --changed-since HEAD");
    assert_eq!(run.status, Some(2), "{run}");
}

#[test]
fn timings_name_the_phases_and_the_slowest_paths() {
    let place = library();
    let run = place.run("check --timings");
    for phase in [
        "finding drawings",
        "looking at kept results",
        "reading drawings",
        "checking paths",
        "keeping results",
    ] {
        assert!(run.stderr.contains(phase), "{phase}: {run}");
    }
    assert!(run.stderr.contains(" ms  8002.1P (projects/8002.dxf)"), "{run}");
    assert!(!place.run("check").stderr.contains(" ms "));
}

#[test]
fn a_clone_that_does_not_reach_the_revision_is_called_shallow() {
    let place = library();
    let revision =
        Command::new("git").args(["rev-parse", "HEAD"]).current_dir(place.path()).output().unwrap();
    let revision = String::from_utf8(revision.stdout).unwrap().trim().to_owned();
    git(&place, &["commit", "-q", "--allow-empty", "-m", "later"]);
    git(&place, &["clone", "-q", "--depth", "1", &format!("file://{}", place.path().display()), "clone"]);
    let run = place.run_in("clone", &["check", "--changed-since", &revision]);
    assert_eq!(run.status, Some(2), "{run}");
    assert!(run.stderr.contains("too shallow") && run.stderr.contains("fetch-depth"), "{run}");
    let run = place.run(&format!("check --changed-since {}", "0".repeat(40)));
    assert_eq!(run.status, Some(2), "{run}");
    assert!(!run.stderr.contains("shallow"), "a whole clone is not: {run}");
}
