//! Tests `check --changed-since REV` and `--timings`.

use std::fs;
use std::process::Command;

use crate::support::Place;
use pathbuild_api::{CheckOptions, Error, LibraryOptions};
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

/// Creates a library under Git with everything committed. The project 8003 embeds a missing path.
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

/// Returns the numbers in the summary.
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
fn the_library_of_another_program_checks_what_depends_on_a_change() {
    let place = library();
    let library = pathbuild_api::Library::open(place.path()).unwrap();
    let check = |revision: &str| library.check_with(&[], &CheckOptions::new().changed_since(revision));
    assert_eq!(check("HEAD").unwrap().files, []);
    fs::write(place.path().join("parts/1001.dxf"), dxf("1001.1P", 4, None)).unwrap();
    library.changed("parts/1001.dxf").unwrap();
    let files = check("HEAD").unwrap().files;
    let names = files.iter().map(|drawing| (&*drawing.file, drawing.paths.join(" ")));
    let expected = [
        ("parts/1001.dxf", "1001.1P".to_owned()),
        ("projects/8001.dxf", "8001.1P".to_owned()),
        ("projects/8002.dxf", "8002.1P".to_owned()),
    ];
    assert_eq!(names.collect::<Vec<_>>(), expected);
    assert!(matches!(check("missing"), Err(Error::Refused(_))));
    let in_memory = LibraryOptions::new().open_files([("1001.dxf", dxf("1001.1P", 4, None))]).unwrap();
    let checked = in_memory.check_with(&[], &CheckOptions::new().changed_since("HEAD"));
    assert!(matches!(checked, Err(Error::Refused(_))));
}

/// A Git hook also runs before the first commit.
#[test]
fn before_the_first_commit_everything_has_changed() {
    let place = library();
    fs::remove_dir_all(place.path().join(".git")).unwrap();
    git(&place, &["init", "-q"]);
    assert_eq!(checked(&place, "check --changed-since HEAD"), "5 paths in 5 drawings");
    assert_eq!(place.run("check --changed-since HEAD~1").status, Some(2));
    assert_eq!(place.run("check --changed-since main").status, Some(2));
    git(&place, &["add", "-A"]);
    git(&place, &["commit", "-q", "-m", "all"]);
    assert_eq!(checked(&place, "check --changed-since HEAD"), "0 paths in 0 drawings");
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

/// A few Git objects can name any number of files.
#[test]
fn the_files_of_a_revision_are_counted() {
    for (most, is_right) in [(6, true), (5, false)] {
        let place = library();
        let own = place.read("pathbuild.toml");
        let place = place.file("pathbuild.toml", format!("{own}[limits]\nlibrary-entries = {most}\n"));
        commit(&place);
        for command in ["check --changed-since HEAD", "diff HEAD HEAD"] {
            let run = place.run(command);
            assert_eq!(run.stderr.contains("`library-entries`"), !is_right, "{command}: {run}");
            assert_eq!(run.status == Some(2), !is_right, "{command}: {run}");
        }
    }
}

/// The file has 64 GiB, which Git would read to the end for hours.
#[cfg(unix)]
#[test]
fn a_drawing_that_is_too_large_has_changed() {
    let place = library();
    // A sparse file takes no space on disk.
    let drawing = fs::File::create(place.path().join("parts/1002.dxf")).unwrap();
    drawing.set_len(64 << 30).unwrap();
    let begun = std::time::Instant::now();
    let run = place.run("check --changed-since HEAD --format concise");
    assert!(run.stderr.contains("PB005") && run.stderr.contains("1002.dxf"), "{run}");
    assert!(begun.elapsed() < std::time::Duration::from_mins(1), "{:?}", begun.elapsed());
}

#[test]
fn timings_name_the_phases_and_the_slowest_paths() {
    let place = library();
    let run = place.run("check --timings");
    for phase in [
        "finding drawings",
        "verifying cached results",
        "reading drawings",
        "checking paths",
        "storing results",
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

/// A report without findings would tell that all earlier ones are mended.
#[test]
fn reports_of_a_run_that_did_nothing_say_so() {
    let place = library();
    for format in ["json", "sarif", "gitlab", "junit", "github"] {
        for arguments in ["--changed-since nope", "--changed-since HEAD"] {
            let is_refused = arguments.ends_with("nope");
            let run = place.run(&format!("check {arguments} --format {format}"));
            assert_eq!(run.status, Some(if is_refused { 2 } else { 0 }), "{run}");
            assert_eq!(run.stdout.contains("nothing was done: git: "), is_refused, "{run}");
            assert_eq!(
                run.stdout.contains("\"executionSuccessful\": true"),
                format == "sarif" && !is_refused
            );
        }
        let report = format!("check --changed-since nope --report {format}=report");
        assert_eq!(place.run(&report).status, Some(2));
        assert!(place.read("report").contains("nothing was done: git: "));
    }
}

/// Git names the command that makes it accept a repository of another user.
#[cfg(unix)]
#[test]
fn a_repository_of_another_user_is_named_with_the_remedy() {
    let place = library();
    let Ok(chown) = Command::new("chown").args(["-R", "65534", "."]).current_dir(place.path()).status()
    else {
        return;
    };
    for command in ["check --changed-since HEAD", "diff HEAD"] {
        let run = place.run(command);
        let is_told = run.stderr.contains("git config --global --add safe.directory");
        assert_eq!((run.status == Some(2), is_told), (chown.success(), chown.success()), "{run}");
    }
}

/// A shared configuration does not change the names of files in the repository.
#[test]
fn files_are_named_from_the_root_of_the_repository() {
    let place = Place::new().file("company/x.toml", "").file("outside/pathbuild.toml", "");
    let place =
        place.file("outside/repository/.git/HEAD", "").file("outside/repository/a/1235.1P.dxf", "no drawing");
    for more in [&["--config", "../../company/x.toml"][..], &[]] {
        let run = place.run_in("outside/repository", &[&["check", "a", "--format", "gitlab"], more].concat());
        assert!(run.stdout.contains("\"path\": \"a/1235.1P.dxf\""), "{run}");
    }
}

/// Summaries of `check` for each extent of a change: nothing, one drawing, or everything.
const NOTHING: &str = "0 paths in 0 drawings";
const ONE: &str = "1 path in 1 drawing";
const ALL: &str = "5 paths in 5 drawings";

#[track_caller]
fn since(place: &Place, expected: &str) {
    for cache in ["", " --no-cache"] {
        let run = place.run(&format!("check --changed-since HEAD{cache}"));
        assert!(
            run.stderr.lines().last().is_some_and(|line| line.starts_with(expected)),
            "{expected}: {run}"
        );
        let is_all = expected == ALL;
        assert_eq!(run.stderr.contains("checking everything: "), is_all, "{run}");
    }
}

fn commit(place: &Place) {
    git(place, &["add", "-A"]);
    git(place, &["commit", "-q", "-m", "more"]);
}

/// Git's own exclude lists do not apply to pathbuild.
#[test]
fn drawings_that_git_passes_over_are_checked() {
    let place = library().file(".git/info/exclude", "2*\n");
    since(&place, NOTHING);
    since(&place.file("parts/2001.dxf", dxf("2001.1P", 5, None)), ONE);
    let place = library().file("parts/.gitignore", "2*\n").file("parts/.ignore", "!2*\n");
    commit(&place);
    since(&place, NOTHING);
    since(&place.file("parts/2001.dxf", dxf("2001.1P", 5, None)), ONE);
    // Files that pathbuild ignores are not checked, even if Git lists them.
    let place = library().file("parts/.gitignore", "2*\n");
    commit(&place);
    since(&place.file("parts/2001.dxf", dxf("2001.1P", 5, None)), NOTHING);
}

#[test]
fn drawings_in_a_repository_of_their_own_have_changed() {
    let place = library().file("parts/sub/2001.dxf", dxf("2001.1P", 5, None));
    commit(&place);
    since(&place, NOTHING);
    let place = place.file("parts/other/2002.dxf", dxf("2002.1P", 5, None));
    git(&place, &["init", "-q", "parts/other"]);
    since(&place, ONE);
}

#[test]
fn what_is_checked_and_how_concerns_everything() {
    let configuration = "library = [\"parts\", \"projects\"]\nsearch = [\"parts\"]\n";
    since(&library().file("pathbuild.toml", configuration), NOTHING);
    since(&library().file("pathbuild.toml", format!("{configuration}[limits]\nentities = 10\n")), ALL);
    // An ignore file is added, changed, and removed.
    for name in ["parts/.gitignore", "parts/.ignore"] {
        let place = library().file(name, "# nothing\n");
        since(&place, ALL);
        commit(&place);
        since(&place, NOTHING);
        since(&place, NOTHING);
        let place = place.file(name, "# still nothing\n");
        since(&place, ALL);
        fs::remove_file(place.path().join(name)).unwrap();
        since(&place, ALL);
    }
    let german = library().file("parts/.ignore", "#\n").run("check --changed-since HEAD --lang de");
    assert!(german.stderr.contains("alles wird geprüft: parts/.ignore"), "{german}");
}

#[cfg(unix)]
mod links {
    use std::os::unix::fs::{PermissionsExt, symlink};
    use std::path::Path;

    use super::*;

    /// Creates the library with a link among its drawings, or next to them.
    fn linked(target: &str, link: &str) -> Place {
        let place = library()
            .file("store/a.bin", dxf("2001.1P", 5, None))
            .file("store/b.bin", dxf("2001.1P", 5, None));
        symlink(target, place.path().join(link)).unwrap();
        commit(&place);
        place
    }

    #[test]
    fn a_drawing_that_is_a_link_changes_with_its_file() {
        let place = linked("../store/a.bin", "parts/2001.dxf");
        since(&place, NOTHING);
        since(&place.file("store/b.bin", dxf("2001.1P", 4, None)), NOTHING);
        let place = linked("../store/a.bin", "parts/2001.dxf");
        since(&place.file("store/a.bin", dxf("2001.1P", 4, None)), ONE);
        // The link is new, but points to an old file.
        let place = linked("../store/a.bin", "parts/2001.dxf");
        symlink("../store/b.bin", place.path().join("parts/2002.dxf")).unwrap();
        since(&place, ONE);
    }

    #[test]
    fn a_link_that_leads_elsewhere_concerns_everything() {
        let place = linked("../store/a.bin", "parts/1003.dxf");
        fs::remove_file(place.path().join("parts/1003.dxf")).unwrap();
        symlink("../store/b.bin", place.path().join("parts/1003.dxf")).unwrap();
        let run = place.run("check --changed-since HEAD");
        assert!(run.stderr.contains("checking everything: parts/1003.dxf"), "{run}");
    }

    #[test]
    fn what_is_found_through_a_linked_directory_changes() {
        let place = Place::new()
            .file("pathbuild.toml", "library = [\"projects\"]\nsearch = [\"link\"]\n")
            .file("parts/1001.dxf", dxf("1001.1P", 5, None))
            .file("projects/8001.dxf", dxf("8001.1P", 5, Some("1001.1P")));
        symlink("parts", place.path().join("link")).unwrap();
        git(&place, &["init", "-q"]);
        commit(&place);
        since(&place, NOTHING);
        since(&place.file("parts/1001.dxf", dxf("1001.1P", 4, None)), ONE);
    }

    #[test]
    fn the_repository_is_that_of_the_argument() {
        let place = library();
        let other = Place::new().file("a.txt", "");
        git(&other, &["init", "-q"]);
        commit(&other);
        symlink(place.path(), other.path().join("link")).unwrap();
        let arguments = ["check", "link", "--no-cache", "--changed-since", "HEAD"];
        let run = other.run_in(".", &arguments);
        assert!(!run.stderr.contains(ONE), "{run}");
        let place = place.file("parts/1002.dxf", dxf("1002.1P", 4, None));
        let argument = place.path().to_str().unwrap();
        let run = other.run_in(".", &["check", argument, "--no-cache", "--changed-since", "HEAD"]);
        assert!(run.stderr.contains(ONE) && !run.stderr.contains("everything"), "{run}");
    }

    /// Writes a script that creates a marker file.
    fn script(place: &Place, name: &str, mark: &Path) {
        let file = place.path().join(name);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(&file, format!("#!/bin/sh\ntouch '{}'\nexit 1\n", mark.display())).unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).unwrap();
    }

    /// Runs all commands that call Git.
    fn ask(place: &Place, directory: &str, revision: &str, mark: &Path) {
        for option in [&[][..], &["--untrusted"]] {
            for command in [&["check", ".", "--changed-since", revision][..], &["diff", revision, "."]] {
                let arguments = [command, &["--no-cache"], option].concat();
                let run = place.run_in(directory, &arguments);
                assert!(matches!(run.status, Some(0 | 1)), "{run}");
                assert!(!mark.exists(), "{run}");
            }
        }
    }

    #[test]
    fn nothing_that_a_repository_names_is_run() {
        let place = library().file(".gitattributes", "* filter=mark diff=mark\n");
        commit(&place);
        let outside = Place::new();
        let mark = outside.path().join("mark");
        script(&place, ".git/mark.sh", &mark);
        let names = ["post-checkout", "post-index-change", "reference-transaction", "fsmonitor-watchman"];
        for name in names {
            script(&place, &format!(".git/hooks/{name}"), &mark);
        }
        let own = fs::read_to_string(place.path().join(".git/config")).unwrap();
        let configuration = "[core]\nfsmonitor = .git/mark.sh\nsshCommand = .git/mark.sh\npager = .git/mark.sh\n\
            [filter \"mark\"]\nclean = .git/mark.sh\nsmudge = .git/mark.sh\nprocess = .git/mark.sh\nrequired = true\n\
            [diff \"mark\"]\ncommand = .git/mark.sh\ntextconv = .git/mark.sh\n[diff]\nexternal = .git/mark.sh\n";
        let place = place.file(".git/config", format!("{own}{configuration}"));
        let place = place.file("parts/1001.dxf", dxf("1001.1P", 4, None));
        ask(&place, ".", "HEAD", &mark);
        since(&place, "3 paths in 3 drawings");
        // Unlike pathbuild, Git itself would run the script.
        _ = Command::new("git").args(["diff", "HEAD"]).current_dir(place.path()).output().unwrap();
        assert!(mark.exists());
    }

    /// Nothing is fetched for a partial clone: Git would fetch missing objects with commands from the clone's configuration.
    #[test]
    fn nothing_is_fetched() {
        let place = library();
        let outside = Place::new();
        let mark = outside.path().join("mark");
        script(&place, ".git/mark.sh", &mark);
        let blob =
            Command::new("git").args(["rev-parse", "HEAD:parts/1001.dxf"]).current_dir(place.path()).output();
        let blob = String::from_utf8(blob.unwrap().stdout).unwrap().trim().to_owned();
        let (directory, name) = blob.split_at(2);
        fs::remove_file(place.path().join(".git/objects").join(directory).join(name)).unwrap();
        let own = fs::read_to_string(place.path().join(".git/config")).unwrap();
        let configuration = "[extensions]\npartialClone = a\n[remote \"a\"]\nurl = ssh://nowhere.invalid/a\npromisor = true\n\
            [core]\nsshCommand = .git/mark.sh\nrepositoryformatversion = 1\n[protocol \"ssh\"]\nallow = always\n";
        let place = place.file(".git/config", format!("{own}{configuration}"));
        since(&place, NOTHING);
        assert_eq!(place.run("diff HEAD").status, Some(2));
        assert!(!mark.exists());
        _ = Command::new("git").args(["cat-file", "-p", &blob]).current_dir(place.path()).output().unwrap();
        assert!(mark.exists());
    }

    /// A pull request can contain files in the layout of a bare repository, which Git would recognise as one.
    #[test]
    fn files_of_a_tree_are_no_repository() {
        let place = library().file("cnc/3001.dxf", dxf("3001.1P", 5, None));
        let place = place.file("cnc/pathbuild.toml", "library = [\".\"]\n");
        commit(&place);
        let base =
            Command::new("git").args(["rev-parse", "HEAD"]).current_dir(place.path()).output().unwrap();
        let base = String::from_utf8(base.stdout).unwrap().trim().to_owned();
        let outside = Place::new();
        let mark = outside.path().join("mark");
        script(&place, "cnc/mark.sh", &mark);
        let place = place
            .file("cnc/HEAD", "ref: refs/heads/main\n")
            .file("cnc/objects/info/alternates", "../../.git/objects\n")
            .file("cnc/refs/heads/.keep", "")
            .file("cnc/packed-refs", format!("{base} refs/heads/main\n"))
            .file("cnc/config", "[core]\nbare = false\nworktree = .\nfsmonitor = ./mark.sh\n")
            .file("cnc/3002.dxf", dxf("3002.1P", 5, None));
        git(&place, &["-c", "safe.bareRepository=explicit", "add", "-A"]);
        git(&place, &["commit", "-q", "-m", "pull request"]);
        ask(&place, "cnc", &base, &mark);
        let run = place.run_in("cnc", &["check", "--changed-since", &base]);
        assert!(run.stderr.contains(ONE), "{run}");
    }

    /// A `.git` that points out of an untrusted tree is followed only if `git worktree` created it.
    #[test]
    fn a_strangers_repository_lies_in_its_tree() {
        let place = library();
        git(&place, &["worktree", "add", "-q", "../worktree"]);
        let worktree = place.path().parent().unwrap().join("worktree");
        let run = |place: &Place, directory: &str, option: &str| {
            let arguments = ["check", "--no-cache", "--changed-since", "HEAD", option];
            place.run_in(directory, &arguments[..if option.is_empty() { 4 } else { 5 }])
        };
        let other = Place::new().file("tree/pathbuild.toml", "library = [\".\"]\n");
        for option in ["", "--untrusted"] {
            let run = run(&place, worktree.to_str().unwrap(), option);
            assert_eq!(run.stderr.lines().last().map(|line| line.starts_with(NOTHING)), Some(true), "{run}");
        }
        fs::remove_dir_all(worktree).unwrap();
        let git_directory = place.path().join(".git");
        for is_link in [true, false] {
            let file = other.path().join("tree/.git");
            if is_link {
                symlink(&git_directory, &file).unwrap();
            } else {
                fs::write(&file, format!("gitdir: {}\n", git_directory.display())).unwrap();
            }
            let refused = run(&other, "tree", "--untrusted");
            assert!(refused.status == Some(2) && refused.stderr.contains("leads out"), "{refused}");
            assert_ne!(run(&other, "tree", "").status, Some(2));
            fs::remove_file(file).unwrap();
        }
    }
}

/// The index is not modified: Git would record in it that files only look newer.
#[test]
fn the_index_is_not_touched() {
    let place = library();
    let index = || fs::read(place.path().join(".git/index")).unwrap();
    let before = index();
    let drawing = fs::File::options().write(true).open(place.path().join("parts/1001.dxf")).unwrap();
    drawing
        .set_modified(std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000))
        .unwrap();
    since(&place, NOTHING);
    assert!(before == index());
}

/// Removing an entry takes back that its finding is accepted.
#[test]
fn after_a_change_of_the_baseline_everything_is_checked() {
    for (option, name) in [("", "pathbuild-baseline.txt"), (" --baseline known.txt", "known.txt")] {
        let place = library();
        assert_eq!(place.run(&format!("check --update-baseline{option}")).status, Some(0));
        commit(&place);
        let since = format!("check --changed-since HEAD{option}");
        assert_eq!(checked(&place, &since), "0 paths in 0 drawings");
        let text = place.read(name);
        fs::write(place.path().join(name), text.lines().take(2).collect::<Vec<_>>().join("\n")).unwrap();
        let run = place.run(&since);
        assert!(run.status == Some(1) && run.stderr.contains("PB503"), "{run}");
        assert_eq!(checked(&place, &since), "5 paths in 5 drawings");
        if option.is_empty() {
            fs::remove_file(place.path().join(name)).unwrap();
            assert_eq!(checked(&place, &since), "5 paths in 5 drawings");
        }
    }
}

/// Other results may contain the findings of an unchanged drawing, so only entries for changed ones are known to match nothing.
#[test]
fn entries_that_a_change_made_useless_are_told() {
    let place = library();
    assert_eq!(place.run("check --update-baseline").status, Some(0));
    commit(&place);
    fs::write(place.path().join("projects/8003.dxf"), dxf("8003.1P", 5, Some("1001.1P"))).unwrap();
    let told = || place.run("check --changed-since HEAD").stderr.matches("PB610").count();
    assert_eq!(told(), 1);
    commit(&place);
    assert_eq!(told(), 0);
    fs::write(place.path().join("parts/1001.dxf"), dxf("1001.1P", 5, Some("1002.1P"))).unwrap();
    assert_eq!(checked(&place, "check --changed-since HEAD"), "4 paths in 4 drawings");
    assert_eq!(told(), 0, "8003 has not changed");
}
