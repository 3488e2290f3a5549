//! Tests `--untrusted` and the user's own configuration: what an untrusted tree may set, read and write. Each rule has one case just inside and one
//! just outside. (book: reference/configuration)
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::time::Duration;

use crate::support::{Place, Run};
use pathbuild_testkit::sheet;
use tempfile::TempDir;

pub(crate) const CONFIGURATION: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\n";

pub(crate) fn dxf(name: &str) -> Vec<u8> {
    let drawn = format!("layer {name}\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0");
    sheet(&drawn).unwrap().to_dxf()
}

/// Creates a repository in the directory `tree` with its configuration in `tree/work`, and drawings inside and outside.
fn repository(more: &str) -> Place {
    Place::new()
        .file("tree/.git/HEAD", "ref: refs/heads/main\n")
        .file("tree/work/pathbuild.toml", format!("{CONFIGURATION}{more}\n"))
        .file("tree/work/1202.1P.dxf", dxf("1202.1P"))
        .file("tree/parts/1203.1P.dxf", dxf("1203.1P"))
        .file("outside/1204.1P.dxf", dxf("1204.1P"))
}

fn run(place: &Place, arguments: &str) -> Run {
    place.run_in("tree/work", &arguments.split_whitespace().collect::<Vec<_>>())
}

/// Asserts that a configuration is valid in trusted and in untrusted trees.
#[track_caller]
fn inside(more: &str) {
    for option in ["", " --untrusted"] {
        let run = run(&repository(more), &format!("config show{option}"));
        assert_eq!(run.status, Some(0), "{more}: {run}");
    }
}

/// Asserts that a configuration is valid in trusted trees only.
#[track_caller]
fn outside(more: &str, expected: &str) {
    assert_eq!(run(&repository(more), "config show").status, Some(0), "{more}");
    let run = run(&repository(more), "check . --untrusted");
    assert_eq!(run.status, Some(2), "{more}: {run}");
    assert!(run.stderr.contains("PB003") && run.stderr.contains(expected), "{more}: {run}");
    assert!(
        run.stderr.contains(more.rsplit(' ').next().unwrap().trim_end_matches([']', '}'])),
        "{more}: {run}"
    );
}

#[test]
fn paths_of_a_strangers_configuration_lie_in_its_repository() {
    let leads_out = "out of the untrusted repository";
    for key in ["library", "search"] {
        inside(&format!("{key} = [\"../parts\"]"));
        outside(&format!("{key} = [\"../../outside\"]"), leads_out);
        outside(&format!("{key} = [\"../parts/../../outside\"]"), leads_out);
        outside(&format!("{key} = [\"/usr\"]"), leads_out);
    }
    inside("out-dir = \"../parts/new\"");
    outside("out-dir = \"../../tree2\"", leads_out);
    inside("post = \"../parts/mine.cbpp\"");
    inside("post = \"grbl\"");
    outside("post = \"../../outside/mine.cbpp\"", leads_out);
    outside("post = { name = \"../../mine.cbpp\" }", leads_out);
}

#[test]
fn without_git_the_configurations_directory_is_the_repository() {
    for (name, status) in [("below", 0), ("../beside", 2)] {
        let place = Place::new()
            .file("tree/pathbuild.toml", format!("{CONFIGURATION}library = [\"{name}\"]\n"))
            .file("tree/below/1202.1P.dxf", dxf("1202.1P"))
            .file("beside/1202.1P.dxf", dxf("1202.1P"));
        let run = place.run_in("tree", &["check", "--untrusted"]);
        assert_eq!(run.status, Some(status), "{run}");
    }
}

#[test]
fn links_of_a_strangers_configuration_lead_into_its_repository() {
    for (target, status) in [("../parts", 0), ("../../outside", 2)] {
        for line in [
            "library = [\"link\"]",
            "search = [\"link\"]",
            "out-dir = \"link/new\"",
            "post = \"link/a.cbpp\"",
        ] {
            let place = repository(line);
            symlink(target, place.path().join("tree/work/link")).unwrap();
            let run = run(&place, "config show --untrusted");
            assert_eq!(run.status, Some(status), "{target}, {line}: {run}");
        }
    }
}

/// A drawing, an ignore file, a program, a post definition and a directory are links.
#[test]
fn links_that_lead_out_are_not_read() {
    let outside = "it leads out of the untrusted repository";
    let cases = [
        ("1203.1P.dxf", "1203.1P.dxf", "check . --untrusted"),
        ("1203.1P.dxf", "1203.1P.dxf", "check 1203.1P.dxf --untrusted"),
        ("1203.1P.dxf", "1203.1P.dxf", "emit . --untrusted"),
        ("link", "", "check ./link --untrusted"),
        (".gitignore", "rules", "check . --untrusted"),
        ("a.gcode", "a.gcode", "import a.gcode --untrusted"),
        ("a.gcode", "a.gcode", "verify a.gcode --untrusted"),
        ("m.toml", "m.toml", "emit 1202.1P --post ./m.toml --untrusted"),
        ("a_Clean.gcode", "a.gcode", "adjust a --max-correction 1 --untrusted"),
        ("b.txt", "b.txt", "check . --baseline b.txt --untrusted"),
    ];
    for (link, target, command) in cases {
        for (beside, is_out) in [("../parts", false), ("../../outside", true)] {
            let place = repository("");
            for directory in ["tree/parts", "outside"] {
                let directory = place.path().join(directory);
                fs::write(directory.join("1203.1P.dxf"), dxf("1203.1P")).unwrap();
                for (name, text) in [
                    ("rules", "#\n"),
                    ("a.gcode", "%\nG00 Z20.000\nM30\n%\n"),
                    ("m.toml", "no post"),
                    ("b.txt", "#\n"),
                ] {
                    fs::write(directory.join(name), text).unwrap();
                }
            }
            symlink(format!("{beside}/{target}"), place.path().join("tree/work").join(link)).unwrap();
            let run = run(&place, command);
            assert_eq!(run.stderr.contains(outside), is_out, "{link} to {beside}: {run}");
            assert!(!is_out || run.status != Some(0), "{link} to {beside}: {run}");
            let trusted = self::run(&place, command.trim_end_matches(" --untrusted"));
            assert!(!trusted.stderr.contains(outside), "{trusted}");
        }
    }
}

/// As in a trusted tree, the path is found by the header of the program.
#[test]
fn programs_that_are_older_than_a_strangers_drawing_are_told() {
    let wrong = "layer 1202.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 50,0";
    for option in ["", " --untrusted"] {
        let place = repository("[emit]\ntargets = [\"*\"]");
        assert_eq!(run(&place, &format!("emit .{option}")).status, Some(0));
        let place = place.file("tree/work/1202.1P.dxf", sheet(wrong).unwrap().to_dxf());
        let told = run(&place, &format!("emit .{option}"));
        assert!(told.stderr.contains("so 1202.1P_Milling.gcode is out of date"), "{option}: {told}");
    }
}

/// The cached result of a trusted run for a linked drawing does not apply to an untrusted run, even if the drawing has not changed for a while and
/// is not read again.
#[test]
fn kept_results_of_a_trusted_run_are_no_ones_of_a_stranger() {
    let place = repository("library = [\".\"]");
    symlink("../../outside/1204.1P.dxf", place.path().join("tree/work/1204.1P.dxf")).unwrap();
    std::thread::sleep(Duration::from_millis(3_500));
    for round in 0..2 {
        assert_eq!(run(&place, "check").status, Some(0), "{round}");
        assert_eq!(run(&place, "check --untrusted").status, Some(1), "{round}");
    }
}

#[test]
fn a_strangers_configuration_that_is_a_link_leads_into_its_repository() {
    for (target, status) in [("../parts/other.toml", 0), ("../../outside/other.toml", 2)] {
        let place = repository("")
            .file("outside/other.toml", CONFIGURATION)
            .file("tree/parts/other.toml", CONFIGURATION);
        let file = place.path().join("tree/work/pathbuild.toml");
        fs::remove_file(&file).unwrap();
        symlink(target, file).unwrap();
        assert_eq!(run(&place, "check . --untrusted").status, Some(status), "{target}");
        assert_eq!(run(&place, "check .").status, Some(0), "{target}");
    }
}

/// Programs are written only inside the repository: a parent directory may be a link that points outside.
#[test]
fn nothing_is_written_through_links_that_lead_out() {
    for (target, status) in [("../parts", 0), ("../../outside", 1)] {
        let place = repository("");
        symlink(target, place.path().join("tree/work/link")).unwrap();
        for command in
            ["emit 1202.1P.dxf --out-dir link --untrusted", "emit 1202.1P.dxf --out-dir link/new --untrusted"]
        {
            let run = run(&place, command);
            assert_eq!(run.status, Some(status), "{target}: {run}");
        }
        let directory = place.path().join("tree/work").join(target);
        assert_eq!(directory.join("1202.1P_Milling.gcode").exists(), status == 0);
        assert_eq!(directory.join("new/1202.1P_Milling.gcode").exists(), status == 0);
        // A link to a file is replaced, not followed.
        let place = repository("").file("outside/precious", "kept");
        symlink("../../outside/precious", place.path().join("tree/work/1202.1P_Milling.gcode")).unwrap();
        run(&place, "emit 1202.1P.dxf --untrusted");
        assert_eq!(place.read("outside/precious"), "kept");
    }
}

/// Paths on the command line are chosen by the user, so they may be anywhere.
#[test]
fn what_the_command_line_names_may_lie_anywhere() {
    let place = repository("").file("own.toml", CONFIGURATION);
    let out = TempDir::new().unwrap();
    let command =
        format!("emit 1202.1P.dxf --untrusted --search ../../outside --out-dir {}", out.path().display());
    assert_eq!(run(&place, &command).status, Some(0));
    assert!(out.path().join("1202.1P_Milling.gcode").exists());
    assert_eq!(run(&place, "check ../../outside/1204.1P.dxf --untrusted").status, Some(0));
}

#[test]
fn limits_of_a_stranger_are_only_lowered() {
    for (key, default, more) in [
        ("file-size", "\"256 MiB\"", "268435457"),
        ("entities", "2_000_000", "2_000_001"),
        ("embedding-moves", "50_000_000", "50_000_001"),
        ("verify-cells", "1_000_000_000", "1_000_000_001"),
        ("verify-pieces", "5_000_000", "5_000_001"),
        ("program-memory", "\"1 GiB\"", "1073741825"),
        ("output-size", "\"256 MiB\"", "268435457"),
        ("embedded-paths", "100_000", "100_001"),
        ("library-entries", "200_000", "200_001"),
        ("ignore-file-size", "\"64 KiB\"", "65537"),
        ("text-length", "65_536", "65_537"),
        ("seconds-per-path", "60", "60.001"),
    ] {
        inside(&format!("[limits]\n{key} = {default}"));
        inside(&format!("[limits]\n{key} = 1"));
        outside(&format!("[limits]\n{key} = {more}"), "above its default");
    }
}

#[test]
fn a_stranger_answers_for_no_program() {
    inside("post = { name = \"grbl\", unchecked = false }");
    outside("post = { name = \"grbl\", unchecked = true }", "only allowed in trusted repositories");
}

#[test]
fn posts_of_strangers_run_no_command() {
    let post = "<PostProcessor><PostBuildCommand>/bin/touch</PostBuildCommand>\
        <PostBuildCommandArgs>ran</PostBuildCommandArgs></PostProcessor>";
    for (option, is_run) in [("", true), (" --untrusted", false)] {
        let place = repository("spindle = \"manual\"\n").file("tree/work/p.cbpp", post);
        let command = format!("emit 1202.1P.dxf --post ./p.cbpp --dialect linuxcnc --run-post-build{option}");
        let run = run(&place, &command);
        assert_eq!(place.path().join("tree/work/ran").exists(), is_run, "{run}");
        assert_eq!(run.stderr.contains("is not run"), !is_run, "{run}");
    }
}

/// Results from a time when the tree was trusted are not used.
#[test]
fn what_is_known_of_ones_own_tree_is_not_known_of_a_strangers() {
    let place = repository("");
    // A file that has not changed for a while is not read again.
    let drawing = crate::support::project().join("fixtures/library/components/2050.1P.dxf");
    symlink(drawing, place.path().join("tree/work/2050.1P.dxf")).unwrap();
    for (option, status) in [("", 0), ("", 0), (" --untrusted", 1), ("", 0)] {
        let run = run(&place, &format!("check 2050.1P.dxf{option}"));
        assert_eq!(run.status, Some(status), "{run}");
    }
}

/// With `[trust] roots`, trees elsewhere are untrusted even without the option.
#[test]
fn trees_that_do_not_lie_below_a_trusted_root_are_strangers() {
    for (root, status) in [("tree", 0), ("", 0), ("outside", 2), ("tree/work", 2)] {
        let place = repository("search = [\"../../outside\"]");
        let root = place.path().canonicalize().unwrap().join(root);
        let place = place.users(&format!("[trust]\nroots = [\"/nowhere\", {:?}]\n", root.to_str().unwrap()));
        assert_eq!(run(&place, "check .").status, Some(status), "{}", root.display());
        // The explicit option applies in trusted trees as well.
        assert_eq!(run(&place, "check . --untrusted").status, Some(2));
    }
}

/// Messages are in the user's language, programs in the tree's.
#[test]
fn a_persons_language_is_said_and_the_trees_is_written() {
    let place = repository("lang = \"en\"").users("lang = \"de\"\n");
    let said = run(&place, "emit 1202.1P.dxf");
    assert!(said.stderr.contains("geschrieben"), "{said}");
    let german = place.read("tree/work/1202.1P_Milling.gcode");
    assert_eq!(run(&repository("lang = \"en\""), "emit 1202.1P.dxf").status, Some(0));
    let english = repository("lang = \"en\"");
    run(&english, "emit 1202.1P.dxf");
    assert_eq!(german, english.read("tree/work/1202.1P_Milling.gcode"));
    let said = run(&place, "emit 1202.1P.dxf --lang en");
    assert!(said.stderr.contains("unchanged"), "{said}");
}

#[test]
fn a_persons_cache_directory_holds_each_tree_by_its_own() {
    let caches = TempDir::new().unwrap();
    let place = repository("").users(&format!("[cache]\ndir = {:?}\n", caches.path().to_str().unwrap()));
    run(&place, "check .");
    let trees = fs::read_dir(caches.path()).unwrap();
    let tree = trees.map(|entry| entry.unwrap().path().join("tree")).next().unwrap();
    assert!(fs::read_to_string(tree).unwrap().ends_with("tree/work"));
}

#[test]
fn faults_of_a_persons_configuration_are_told() {
    for (text, expected) in [
        ("feed = 150\n", "feed"),
        ("lang = \"fr\"\n", "lang"),
        ("[cache]\ndir = \"relative\"\n", "an absolute path"),
        ("[trust]\nroots = [\"relative\"]\n", "a list of absolute paths"),
        ("[trust]\nroot = []\n", "did you mean `roots`"),
        ("lang = \n", "not valid TOML"),
    ] {
        let run = run(&repository("").users(text), "check .");
        assert_eq!(run.status, Some(2), "{text}: {run}");
        assert!(run.stderr.contains("config.toml:") && run.stderr.contains(expected), "{text}: {run}");
    }
}

/// A directory that cannot be listed is reported, and nothing else is affected.
#[test]
fn a_directory_that_cannot_be_listed_is_told() {
    let place = repository("library = [\".\"]");
    symlink("../../outside", place.path().join("tree/work/link")).unwrap();
    let run = run(&place, "check ./link . --untrusted --format concise");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("link") && run.stderr.contains("1 path in 1 drawing"), "{run}");
}
