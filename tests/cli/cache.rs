//! The cache gives the same results as a run without it, whatever has changed in between, and damaged files are not trusted.

use std::collections::BTreeMap;
#[cfg(target_os = "linux")]
use std::ffi::OsStr;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use crate::support::{Place, Run};
use camino::Utf8PathBuf;
use pathbuild_testkit::sheet;
use pathbuild_workspace::session::{compare_names, compare_paths};

const CONFIGURATION: &str = "library = [\"library\"]\nsearch = [\"library/parts\", \"spare\"]\n";

/// For each drawing, its paths, each with T and the paths that it embeds.
type Drawings = BTreeMap<&'static str, Vec<(String, u32, Vec<String>)>>;

fn dxf(paths: &[(String, u32, Vec<String>)]) -> Vec<u8> {
    let mut text = String::new();
    for (index, (name, thickness, embeds)) in paths.iter().enumerate() {
        let y = 30 * index;
        let length = 40 * embeds.len().max(1);
        writeln!(text, "layer {name}\nstart 0,{y} \"T{thickness} O2 I1 B0 MPlate\"").unwrap();
        if embeds.is_empty() {
            writeln!(text, "mill 0,{y} 40,{y}").unwrap();
        }
        for (index, embedded) in embeds.iter().enumerate() {
            let (from, to) = (40 * index, 40 * index + 40);
            writeln!(text, "subpath {from},{y} {to},{y} \">{embedded}\"").unwrap();
        }
        writeln!(text, "end {length},{y}").unwrap();
    }
    sheet(&text).unwrap().to_dxf()
}

fn path(name: &str, thickness: u32, embeds: &[&str]) -> (String, u32, Vec<String>) {
    (name.to_owned(), thickness, embeds.iter().map(|&name| name.to_owned()).collect())
}

fn drawings() -> Drawings {
    BTreeMap::from([
        ("library/parts/1001.dxf", vec![path("1001.1P", 5, &[])]),
        ("library/parts/1002-1003.dxf", vec![path("1002.1P", 5, &[]), path("1003.1P", 5, &["1001.1P"])]),
        ("library/projects/8001.dxf", vec![path("8001.1P", 5, &["1001.1P", "1003.1P"])]),
        ("library/projects/8002.dxf", vec![path("8002.1P", 5, &["1002.1P", "1009.1P"])]),
        ("spare/1004.dxf", vec![path("1004.1P", 5, &[])]),
        ("library/projects/8003.dxf", vec![path("8003.1P", 5, &["1004.1P"])]),
    ])
}

fn library() -> Place {
    let place = Place::new().file("pathbuild.toml", CONFIGURATION);
    drawings().iter().fold(place, |place, (file, paths)| place.file(file, dxf(paths)))
}

/// Returns the output of a run, without its duration.
fn output(run: &Run) -> (Option<i32>, String, String) {
    let stderr: Vec<&str> = run.stderr.lines().filter(|line| !line.contains(" paths in ")).collect();
    (run.status, run.stdout.clone(), stderr.join("\n"))
}

#[track_caller]
fn assert_same(place: &Place, what: &str) {
    let without = place.run("check --format json --no-cache");
    assert_eq!(output(&place.run("check --format json")), output(&without), "first after {what}");
    assert_eq!(output(&place.run("check --format json -j 1")), output(&without), "then after {what}");
}

/// Returns the number of drawings whose cached results still hold, with the number of all drawings.
fn reused_drawings(place: &Place) -> String {
    let run = place.run("check -v");
    run.stderr
        .lines()
        .find_map(|line| line.strip_prefix("drawings with valid cached results: "))
        .unwrap()
        .to_owned()
}

/// A fault that is reached through several drawings is shown with the same chain of embeddings in every format, whatever the order of checking.
#[test]
fn the_way_to_a_finding_is_the_same_with_what_was_kept() {
    for library in ["[\"projects\", \"parts\"]", "[\"parts\", \"projects\"]"] {
        let configuration = format!("library = {library}\nsearch = [\"parts\"]\n");
        let broken =
            sheet("layer 1001.1P\nstart 0,0 \"T5 O2 I1 B0 MPlate\"\nmill 0,0 30,0\nend 40,0").unwrap();
        let place = Place::new()
            .file("pathbuild.toml", configuration)
            .file("parts/1001.dxf", broken.to_dxf())
            .file("projects/8001.dxf", dxf(&[path("8001.1P", 5, &["1001.1P"])]))
            .file("projects/8002.dxf", dxf(&[path("8002.1P", 5, &["8001.1P"])]));
        for format in ["json", "full", "concise", "github", "gitlab", "sarif", "junit"] {
            let [without, cold, warm] = ["--no-cache", "", ""]
                .map(|option| output(&place.run(&format!("check --format {format} {option}"))));
            assert!(without.1.contains("PB") || without.2.contains("PB"), "{without:?}");
            assert_eq!(without, cold, "{library}, {format}");
            assert_eq!(without, warm, "{library}, {format}");
        }
    }
}

/// Deterministic pseudo-random numbers.
struct Chance(u64);

impl Chance {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 % bound as u64).unwrap()
    }
}

/// Creates, edits, deletes or renames a file; a third of the edits make a path ambiguous, missing or cyclic. Returns a description.
fn edit(place: &Place, chance: &mut Chance) -> String {
    let names = ["1001.1P", "1002.1P", "1003.1P", "1004.1P", "1009.1P", "8001.1P"];
    let files = [
        "library/parts/1001.dxf",
        "library/parts/1002-1003.dxf",
        "library/parts/1009.dxf",
        "library/projects/8001.dxf",
        "library/projects/8002.dxf",
        "library/projects/8003.dxf",
        "library/projects/1001 copy.dxf",
        "library/deep/er/1004.dxf",
        "spare/1004.dxf",
        "spare/1009.dxf",
        "library/parts/unnamed.dxf",
    ];
    let file = place.path().join(files[chance.below(files.len())]);
    let name = names[chance.below(names.len())];
    let other = names[chance.below(names.len())];
    match chance.below(10) {
        0 | 1 => write(&file, &[path(name, 5, &[])]),
        2 => write(&file, &[path(name, 4, &[])]),
        3 => write(&file, &[path(name, 5, &[other])]),
        4 => write(&file, &[path(name, 5, &[]), path("8009.1P", 5, &[name, other])]),
        5 => {
            _ = fs::remove_file(&file);
            format!("removing {}", file.display())
        }
        6 => {
            let to = place.path().join(files[chance.below(files.len())]);
            _ = fs::create_dir_all(to.parent().unwrap());
            _ = fs::rename(&file, &to);
            format!("renaming {} to {}", file.display(), to.display())
        }
        7 => {
            for (file, paths) in &drawings() {
                write(&place.path().join(file), paths);
            }
            "mending".to_owned()
        }
        8 => write(&place.path().join("spare/1001 and 1002.dxf"), &[path(names[chance.below(2)], 5, &[])]),
        _ => {
            fs::write(&file, "no drawing").ok();
            format!("breaking {}", file.display())
        }
    }
}

/// Findings of `check` after edits are tested in agreement.rs. Here, programs are written, removed and edited by hand as well.
#[test]
fn after_any_edits_programs_are_current_or_not_as_without_the_cache() {
    const OPTIONS: &str = "./library --feed 150 --rapid 1000 --sweep-height 20 --format json";
    let mut chance = Chance(0xE417);
    let place = library();
    let mut programs = Vec::new();
    let mut ambiguous = 0;
    for step in 0..40 {
        let what = match chance.below(6) {
            0 | 1 => {
                place.run(&format!("emit {OPTIONS}"));
                programs = written(&place);
                let run = place.run(&format!("emit --check --no-cache {OPTIONS}"));
                // PB522 reports the program of a path with errors, so it is not current either.
                let is_known = |file: &str| {
                    let of_file = |line: &&str| line.contains(&format!("\"file\":\"{file}\""));
                    run.stderr.lines().filter(of_file).any(|line| line.contains("PB522"))
                };
                let mut old = run.stdout.lines().filter_map(|line| line.split_once(": not current"));
                let is_old = old.any(|(file, _)| !is_known(file)) || run.stdout.contains("missing");
                assert!(!is_old, "step {step}: {run}");
                "emit".to_owned()
            }
            2 if !programs.is_empty() => {
                let program = &programs[chance.below(programs.len())];
                _ = fs::remove_file(program);
                format!("removing {}", program.display())
            }
            3 if !programs.is_empty() => {
                let program = &programs[chance.below(programs.len())];
                fs::write(program, format!("(edited {step})\n")).unwrap();
                format!("editing {}", program.display())
            }
            _ => edit(&place, &mut chance),
        };
        let without = output(&place.run(&format!("emit --check --no-cache {OPTIONS}")));
        ambiguous += usize::from([&without.1, &without.2].iter().any(|text| text.contains("PB504")));
        for time in ["first", "then"] {
            let with = output(&place.run(&format!("emit --check {OPTIONS}")));
            assert_eq!(with, without, "{time} after step {step}: {what}");
        }
    }
    assert!(ambiguous >= 4, "a path is defined twice in {ambiguous} of 40 states");
}

/// Returns the programs on disk.
fn written(place: &Place) -> Vec<PathBuf> {
    let directories = ["library/parts", "library/projects", "library/deep/er"];
    let entries = directories.iter().filter_map(|directory| fs::read_dir(place.path().join(directory)).ok());
    let files = entries.flatten().map(|entry| entry.unwrap().path());
    let mut programs: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|extension| extension == "gcode")).collect();
    programs.sort();
    programs
}

fn write(file: &PathBuf, paths: &[(String, u32, Vec<String>)]) -> String {
    fs::create_dir_all(file.parent().unwrap()).unwrap();
    fs::write(file, dxf(paths)).unwrap();
    format!("writing {} with {paths:?}", file.display())
}

#[test]
fn only_what_depends_on_a_change_is_checked_again() {
    let place = library();
    assert_eq!(reused_drawings(&place), "0 / 5");
    assert_eq!(reused_drawings(&place), "5 / 5");
    write(&place.path().join("library/parts/1001.dxf"), &[path("1001.1P", 4, &[])]);
    // The results of 1001, of 1002-1003, and of 8001, which embeds one of them, no longer hold.
    assert_eq!(reused_drawings(&place), "2 / 5");
    // The name of the new file admits a path that 8002 did not find.
    write(&place.path().join("spare/1009.dxf"), &[path("1009.2P", 5, &[])]);
    assert_eq!(reused_drawings(&place), "4 / 5");
    write(&place.path().join("spare/7000.dxf"), &[path("7000.1P", 5, &[])]);
    assert_eq!(reused_drawings(&place), "5 / 5");
    write(&place.path().join("spare/1004.dxf"), &[path("1004.1P", 4, &[])]);
    assert_eq!(reused_drawings(&place), "4 / 5");
}

#[test]
fn a_drawing_that_was_touched_is_not_checked_again() {
    let place = library();
    assert_eq!(reused_drawings(&place), "0 / 5");
    let file = place.path().join("library/parts/1001.dxf");
    fs::write(&file, fs::read(&file).unwrap()).unwrap();
    assert_eq!(reused_drawings(&place), "5 / 5");
}

/// The path is 0.5 mm too far from the part, so that material is left, unless the tool is a slot cutter.
#[test]
fn the_shape_of_a_cutter_asks_another_question() {
    let drawing = "layer 1234.1S\nstart 0,-0.5 \"T2 O2 I1 B0 S5\"\nmill 0,-0.5 40,-0.5\nend 40,-0.5\n\
                   layer Part\npolyline 0,1 40,1 40,20 0,20 closed\n";
    let drawing = sheet(drawing).unwrap().to_dxf();
    let configured = |place: Place, paths: &str, shape: &str| {
        let tool = format!("[tool.slot]\ndiameter = 2\npaths = '{paths}'\nshape = \"{shape}\"\n");
        place.file("pathbuild.toml", format!("part = 'Part'\n{tool}"))
    };
    let place = configured(Place::new().file("1234.1S.dxf", drawing), "S$", "end-mill");
    assert!(place.run("check .").stderr.contains("PB215"));
    let place = configured(place, "S$", "slot");
    assert!(!place.run("check .").stderr.contains("PB215"));
    let place = configured(place, "L$", "slot");
    assert!(place.run("check .").stderr.contains("PB215"));
}

#[test]
fn settings_that_matter_ask_another_question() {
    let place = library();
    assert_eq!(reused_drawings(&place), "0 / 5");
    let place = place.file("pathbuild.toml", format!("{CONFIGURATION}restrict = [\"8*:9\"]\n"));
    assert_eq!(reused_drawings(&place), "0 / 5");
    assert_same(&place, "forbidding an embedding");
    // The results do not depend on the severity of findings.
    let place = place.file("pathbuild.toml", format!("{CONFIGURATION}[severity]\nPB210 = \"ignore\"\n"));
    assert_eq!(reused_drawings(&place), "5 / 5");
}

/// If a drawing was read in this run, its current content is used, even if earlier results did not depend on it.
#[test]
fn a_drawing_is_known_as_it_was_read_last() {
    let place = library();
    place.run("check ./library/parts");
    write(&place.path().join("library/parts/1001.dxf"), &[path("1001.1P", 5, &[]), path("1001.2P", 5, &[])]);
    place.run("check ./library/projects");
    let again = place.run("check -v ./library/projects");
    assert!(again.stderr.contains("with valid cached results: 3 / 3"), "{again}");
}

/// The path is correct with its example value, but with the other one the tool mills through the table.
#[test]
fn a_check_with_all_values_is_another_question() {
    let drawn = "layer 1001.1P\nstart 0,0 \"T5 O2 I1 MPlate :B0,9\"\nmill 0,0 40,0 \"B=B\"\nend 40,0";
    let place = Place::new().file("pathbuild.toml", "").file("1001.dxf", sheet(drawn).unwrap().to_dxf());
    for (options, status) in [("", 0), (" --all-bindings", 1), ("", 0)] {
        let run = place.run(&format!("check .{options}"));
        assert_eq!(run.status, Some(status), "{run}");
    }
}

fn results(place: &Place) -> Vec<PathBuf> {
    let listed = fs::read_dir(place.cache()).unwrap().map(|entry| entry.unwrap().path());
    let mut results: Vec<PathBuf> =
        listed.filter(|path| path.extension().is_some_and(|it| it == "results")).collect();
    results.sort();
    results
}

#[test]
fn what_is_damaged_cut_short_or_foreign_is_made_anew_with_a_note() {
    let place = library();
    let clean = output(&place.run("check --format json"));
    let [file] = results(&place).try_into().unwrap();
    let whole = fs::read(&file).unwrap();
    let mut damages: Vec<Vec<u8>> =
        vec![Vec::new(), b"nothing of ours".to_vec(), whole[..whole.len() - 1].to_vec()];
    for at in (0..whole.len()).step_by(whole.len() / 40) {
        let mut damaged = whole.clone();
        damaged[at] ^= 1;
        damages.push(damaged);
    }
    for damaged in damages {
        fs::write(&file, &damaged).unwrap();
        let run = place.run("check --format json");
        let (status, stdout, stderr) = output(&run);
        assert_eq!((status, &stdout), (clean.0, &clean.1));
        assert!(stderr.contains("will be rebuilt"), "{stderr}");
        assert_eq!(output(&place.run("check --format json")), clean);
    }
    fs::remove_file(&file).unwrap();
    fs::create_dir(&file).unwrap();
    assert_eq!(place.run("check --format json").stdout, clean.1);
}

#[test]
fn without_a_configuration_or_with_no_cache_nothing_is_kept() {
    let place = library();
    place.run("check --no-cache");
    assert!(!place.cache().exists());
    fs::remove_file(place.path().join("pathbuild.toml")).unwrap();
    place.run("check ./library");
    assert!(!place.cache().exists());
}

#[test]
fn the_cache_says_what_it_is_and_lies_outside_the_tree() {
    let place = library();
    let before = fs::read_dir(place.path()).unwrap().count();
    place.run("check");
    let tag = fs::read_to_string(place.cache().join("CACHEDIR.TAG")).unwrap();
    assert!(tag.starts_with("Signature: 8a477f597d28d172789f06886806bc55"));
    assert_eq!(fs::read_dir(place.path()).unwrap().count(), before);
}

#[test]
fn what_a_repository_brings_is_not_believed_and_is_noted_once() {
    let place = library().file(".pathbuild/anything.results", "forged");
    let first = place.run("check");
    assert!(first.stderr.contains(".pathbuild beside the configuration is no longer used"), "{first}");
    assert!(!place.run("check").stderr.contains(".pathbuild"));
    assert_eq!(place.read(".pathbuild/anything.results"), "forged");
    assert_eq!(fs::read_dir(place.path().join(".pathbuild")).unwrap().count(), 1);
}

#[test]
fn a_named_cache_holds_for_a_copy_of_the_tree() {
    let (place, caches) = (library(), tempfile::TempDir::new().unwrap());
    let cache = caches.path().join("cache").display().to_string();
    let run = |place: &Place| place.run_with(&["check", "-v", "--cache-dir", &cache]).stderr;
    assert!(run(&place).contains("0 / 5"));
    let copy = library();
    assert!(run(&copy).contains("5 / 5"));
    assert!(!copy.cache().exists());
    // The copy contains another drawing of the same name.
    write(&copy.path().join("library/parts/1001.dxf"), &[path("1001.1P", 9, &[])]);
    assert_same(&copy, "a copy that differs");
}

#[cfg(unix)]
#[test]
fn a_cache_that_is_a_link_is_not_used() {
    let place = library().file("other/precious.txt", "precious");
    std::os::unix::fs::symlink("other", place.path().join("cache")).unwrap();
    let run = place.run("check --cache-dir cache");
    assert!(run.stderr.contains("no results are cached there: it is a link"), "{run}");
    assert_eq!(fs::read_dir(place.path().join("other")).unwrap().count(), 1);
}

/// A cache directory with a name that is not UTF-8 is an error: otherwise the cache would silently be in another directory.
#[cfg(target_os = "linux")]
#[test]
fn a_cache_whose_name_is_no_utf_8_is_refused() {
    let place = library();
    let with = |name: &[u8]| {
        let name: &OsStr = std::os::unix::ffi::OsStrExt::from_bytes(name);
        let mut command = crate::support::program();
        command.args(["check"]).current_dir(place.path()).env("PATHBUILD_CACHE_DIR", name);
        let output = command.env("XDG_CACHE_HOME", place.caches()).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (status, stderr) = with(b"caf\xe9");
    assert_eq!(status, Some(2), "{stderr}");
    assert!(stderr.contains("PATHBUILD_CACHE_DIR: it is not UTF-8"), "{stderr}");
    assert!(!place.cache().exists());
    let (status, stderr) = with("café".as_bytes());
    assert_eq!(status, Some(1), "{stderr}");
    assert!(place.path().join("café").exists());
}

#[test]
fn several_processes_at_once_do_each_other_no_harm() {
    let place = library();
    let expected = output(&place.run("check --format json --no-cache"));
    std::thread::scope(|scope| {
        let run = || (0..6).map(|_| output(&place.run("check --format json"))).collect::<Vec<_>>();
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(run)).collect();
        for thread in threads {
            for found in thread.join().unwrap() {
                assert_eq!(found, expected);
            }
        }
    });
    assert_eq!(results(&place).len(), 1);
}

#[test]
fn the_cache_can_be_looked_at_and_removed() {
    let place = library();
    assert_eq!(place.run("cache size").stdout, "0 bytes\n");
    place.run("check");
    assert_eq!(place.run("cache dir").stdout, "<CACHE>\n");
    let [file] = results(&place).try_into().unwrap();
    assert_eq!(place.run("cache size").stdout, format!("{} bytes\n", fs::metadata(&file).unwrap().len()));
    let run = place.run("cache verify");
    assert!(run.stdout.contains(": intact, ") && run.status == Some(0), "{run}");
    assert_eq!(place.run("cache prune").stderr, "removed: 0\n");

    let mut bytes = fs::read(&file).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    fs::write(&file, bytes).unwrap();
    let run = place.run("cache verify");
    assert!(run.stdout.contains(": damaged, ") && run.status == Some(1), "{run}");
    assert_eq!(place.run("cache prune").stderr, "removed: 1\n");

    // If a file cannot be removed, this is reported, and the directory remains a cache.
    fs::create_dir(&file).unwrap();
    let run = place.run("cache clean");
    assert!(run.status == Some(1) && !run.stderr.contains("removed"), "{run}");
    assert!(place.cache().exists());
    fs::remove_dir(&file).unwrap();
    place.run("check");

    assert_eq!(place.run("cache clean").stderr, "removed: 1\n");
    assert!(!place.cache().exists());
    assert_eq!(place.run("cache clean").stderr, "removed: 0\n");
}

#[test]
fn a_directory_that_is_no_cache_is_not_removed() {
    let place = library().file("other/drawing.dxf", "precious");
    let run = place.run("cache clean --cache-dir other");
    assert_eq!(run.status, Some(1), "{run}");
    assert_eq!(place.read("other/drawing.dxf"), "precious");
}

#[test]
fn without_a_configuration_there_is_no_cache_to_look_at() {
    let run = Place::new().run("cache dir");
    assert_eq!(run.status, Some(2), "{run}");
}

#[test]
fn paths_are_ordered_part_by_part() {
    let mut paths: Vec<Utf8PathBuf> = [
        "a", "a/b", "a/b.dxf", "a b", "a-b", "a.dxf", "ab", "a/b/c", "A", "ä", "a/ä", "../a", "/a", "/",
        "/a/b", "a/b c", "a\u{1}",
    ]
    .map(Utf8PathBuf::from)
    .to_vec();
    paths.sort();
    for (index, a) in paths.iter().enumerate() {
        for (other, b) in paths.iter().enumerate() {
            assert_eq!(compare_paths(a, b), index.cmp(&other), "{a} {b}");
        }
    }
}

#[test]
fn names_are_ordered_as_texts() {
    let mut names = [
        "",
        "a",
        "1000.1P",
        "1000.1P.",
        "1000.1P.dxf",
        "1000.11P",
        "1000.11P.dxf",
        "1000.1p.dxf",
        "1000.1Pä",
        "1000.1P\u{1}",
        "ä",
        "Ä1234567",
        "\u{ffff}1234567",
    ];
    names.sort_unstable();
    for (index, a) in names.iter().enumerate() {
        for (other, b) in names.iter().enumerate() {
            assert_eq!(compare_names(a, b), index.cmp(&other), "{a} {b}");
        }
    }
}

/// Directories with ignore files are walked in a different way, which must find the same drawings.
#[test]
fn what_is_hidden_or_linked_is_left_out_with_and_without_rules() {
    let drawing = |name: &str| dxf(&[path(name, 5, &[])]);
    let place = Place::new()
        .file("pathbuild.toml", CONFIGURATION)
        .file("library/parts/notes.txt", "")
        .file("spare/notes.txt", "")
        .file("library/1001.DXF", drawing("1001.1P"))
        .file("library/a/b/1002.dxf", drawing("1002.1P"))
        .file("library/a/b.dxf/1003.dxf", drawing("1003.1P"))
        .file("library/.hidden/1004.dxf", drawing("1004.1P"))
        .file("library/a/.1005.dxf", drawing("1005.1P"))
        .file("elsewhere/1006.dxf", drawing("1006.1P"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../elsewhere", place.path().join("library/linked")).unwrap();
        std::os::unix::fs::symlink("../elsewhere/1006.dxf", place.path().join("library/1006.dxf")).unwrap();
    }
    #[cfg(target_os = "linux")]
    {
        // The name is not UTF-8, so no argument could contain it either.
        let unspeakable: &OsStr = std::os::unix::ffi::OsStrExt::from_bytes(b"library/\xff.dxf");
        fs::write(place.path().join(unspeakable), drawing("1007.1P")).unwrap();
    }
    let summary = |place: &Place| {
        let run = place.run("check --no-cache");
        // No drawing can be read under such a name, which is reported.
        assert_eq!(run.stderr.matches("PB001").count(), usize::from(cfg!(target_os = "linux")), "{run}");
        run.stderr.lines().last().unwrap().split(':').next().unwrap().to_owned()
    };
    let without = summary(&place);
    assert_eq!(without, if cfg!(unix) { "4 paths in 4 drawings" } else { "3 paths in 3 drawings" });
    let place = place.file("library/.ignore", "nothing\n");
    assert_eq!(summary(&place), without);
    let place = place.file("library/.ignore", "b\n");
    assert_ne!(summary(&place), without);
}

/// Returns the number of drawings whose cached results a check uses, and the number of all drawings.
fn known(place: &Place, arguments: &str) -> String {
    let run = place.run(&format!("check -v {arguments}"));
    let line = run.stderr.lines().find(|line| line.starts_with("drawings with valid cached results"));
    line.unwrap_or_default().rsplit(": ").next().unwrap_or_default().to_owned()
}

#[test]
fn paths_and_drawings_that_are_named_are_checked_once() {
    let place = library();
    let named = [
        ("8001.1P", "1 / 1"),
        ("1001.1P 1002.1P 1003.1P", "2 / 2"),
        ("library/projects/8002.dxf", "1 / 1"),
        ("8003", "1 / 1"),
        ("library/parts 8001.1P", "3 / 3"),
        ("", "5 / 5"),
    ];
    for (arguments, all) in named {
        let run = place.run(&format!("check {arguments}"));
        let without = place.run(&format!("check --no-cache {arguments}"));
        assert_eq!(output(&run), output(&without));
        assert_eq!(known(&place, arguments), all, "{arguments}");
        assert_eq!(output(&place.run(&format!("check {arguments}"))), output(&without));
    }
    // The results are for another path of the same drawing.
    assert_eq!(known(&place, "1002.1P"), "0 / 1");
    // A drawing has no effect on a path that its file name does not admit; if the name admits the path, the drawing may define it again.
    let place = place.file("library/parts/1004.dxf", dxf(&[path("1001.1P", 5, &[])]));
    assert_eq!(known(&place, "1001.1P 1002.1P 1003.1P"), "2 / 2");
    let place = place.file("library/parts/1000-1001.dxf", dxf(&[path("1001.1P", 5, &[])]));
    let without = place.run("check --no-cache 1001.1P");
    assert!(without.stderr.contains("PB504"), "{without}");
    assert_eq!(output(&place.run("check 1001.1P")), output(&without));
    assert_eq!(known(&place, "8001.1P"), "0 / 1");
}
