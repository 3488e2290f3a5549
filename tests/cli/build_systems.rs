//! Tests that the examples in examples/ninja and examples/bazel work as their page describes: an edit rebuilds its dependents, and nothing else.
//! (book: howto/build-systems)

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use pathbuild_testkit::skip;
use serde_json::Value;

use crate::support::{Place, project};

/// A library of two projects, a component that both embed, one that only the first embeds, one that none embeds, a drawing whose name admits an
/// embedded path that it does not define, and a Q-project, which is found only through its drawing.
const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["components", "projects"]
search = ["components"]
feed = 150
rapid = 1000
sweep-height = 20
out-dir = "gcode"
[emit]
targets = ["8*", "*Q"]
== components/1234.1P.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
== components/1300.dxf ==
layer 1300.1P
start 0,20 "T5 O2 I1 B4 MPlate"
mill 0,20 40,20
end 40,20
layer 1300.2P
start 0,50 "T5 O2 I1 B4 MPlate"
mill 0,50 40,50
end 40,50
== components/1400.1P.dxf ==
layer 1400.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 20,0
end 20,0
== components/1200-1299.dxf ==
layer 1299.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 10,0
end 10,0
== projects/8001 a b.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
subpath 40,0 80,0 ">1300.1P"
end 80,0
== projects/8002.dxf ==
layer 8002.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
probe 20,20 "LA"
end 40,0
"#;

#[test]
fn ninja_makes_again_what_depends_on_an_edit() {
    let Some(tree) = Tree::with("ninja", &["ninja", "python3"]) else { return };
    tree.configure();
    let all = ["CHECKSUMS", "CONFIGURE", "EMIT 1300.0Q", "EMIT 8001.1P", "EMIT 8002.1P", "NAMES"];
    assert_eq!(tree.ninja().made(), all);
    tree.holds_programs("gcode");
    assert_eq!(tree.ninja().made(), [""; 0], "nothing changed");

    // A CAD program writes a temporary file and renames it: the directory changes, but not the names in it.
    tree.edit("components/1300.dxf", "B4", "B3");
    assert_eq!(tree.ninja().made(), ["CHECKSUMS", "EMIT 1300.0Q", "EMIT 8001.1P", "NAMES"]);
    tree.holds_programs("gcode");
    tree.edit("components/1400.1P.dxf", "B4", "B3");
    assert_eq!(tree.ninja().made(), ["NAMES"], "no program has it");
    tree.save_again("components/1234.1P.dxf");
    assert_eq!(tree.ninja().made(), ["EMIT 8001.1P", "EMIT 8002.1P", "NAMES"], "with the same moves");
    assert_eq!(tree.ninja().made(), [""; 0], "what was saved again is known");

    fs::remove_file(tree.place.path().join("gcode/8001 a b_Milling.gcode")).unwrap();
    assert_eq!(tree.ninja().made(), ["CHECKSUMS", "EMIT 8001.1P"], "a program was deleted");
    tree.edit("pathbuild.toml", "sweep-height = 20", "sweep-height = 21");
    assert_eq!(
        tree.ninja().made(),
        ["CHECKSUMS", "CONFIGURE", "EMIT 1300.0Q", "EMIT 8001.1P", "EMIT 8002.1P"]
    );
    tree.holds_programs("gcode");
}

#[test]
fn ninja_notices_second_definitions() {
    let Some(tree) = Tree::with("ninja", &["ninja", "python3"]) else { return };
    tree.configure();
    tree.ninja().made();
    // The path is now also defined in a drawing in which it was searched for before.
    tree.edit("components/1200-1299.dxf", "1299.1P", "1234.1P");
    let failed = tree.ninja();
    assert!(!failed.is_success && failed.text.contains("PB504"), "{}", failed.text);
    tree.edit("components/1200-1299.dxf", "1234.1P", "1299.1P");
    assert_eq!(tree.ninja().made(), ["EMIT 8001.1P", "EMIT 8002.1P", "NAMES"]);
    // The path is now also defined in a new drawing.
    for name in ["1234-1235.dxf", "1234-1235.DXF"] {
        let file = tree.place.path().join("components").join(name);
        fs::copy(tree.place.path().join("components/1234.1P.dxf"), &file).unwrap();
        let failed = tree.ninja();
        assert!(!failed.is_success && failed.text.contains("fix the errors first"), "{}", failed.text);
        fs::remove_file(file).unwrap();
        let all = ["CONFIGURE", "EMIT 1300.0Q", "EMIT 8001.1P", "EMIT 8002.1P", "NAMES"];
        assert_eq!(tree.ninja().made(), all);
    }
}

#[test]
fn bazel_makes_again_what_depends_on_an_edit() {
    let Some(tree) = Tree::with("bazel", &["bazel", "python3"]) else { return };
    tree.configure();
    let bazel = Bazel::of(&tree);
    let all = [
        "Checksums //:checksums",
        "Programs of path 1300.0Q",
        "Programs of path 8001.1P",
        "Programs of path 8002.1P",
    ];
    assert_eq!(bazel.build(":checksums").made(), all);
    tree.holds_programs("bazel-bin/gcode");
    assert_eq!(bazel.build(":checksums").made(), [""; 0], "nothing changed");

    tree.edit("components/1300.dxf", "B4", "B3");
    assert_eq!(bazel.build(":checksums").made(), all[..3]);
    tree.holds_programs("bazel-bin/gcode");
    tree.edit("components/1400.1P.dxf", "B4", "B3");
    assert_eq!(bazel.build(":checksums").made(), [""; 0], "no program has it");
    tree.save_again("components/1234.1P.dxf");
    assert_eq!(bazel.build(":checksums").made(), all[2..], "with the same moves");
    tree.edit("components/1300.dxf", "B3", "B4");
    assert_eq!(bazel.build(":checksums").made(), all[2..3], "the rest is as in the cache: {all:?}");

    bazel.run(&["clean"]);
    assert_eq!(bazel.build(":checksums").made(), [""; 0], "everything is in the disk cache");
    tree.holds_programs("bazel-bin/gcode");

    assert_eq!(bazel.build(":programs_check").made(), ["Checking all drawings"]);
    tree.edit("components/1200-1299.dxf", "1299.1P", "1234.1P");
    let failed = bazel.build(":programs_check");
    assert!(!failed.is_success && failed.text.contains("PB504"), "{}", failed.text);
    tree.edit("components/1200-1299.dxf", "1234.1P", "1299.1P");
    let copy = tree.place.path().join("components/1234-1235.DXF");
    fs::copy(tree.place.path().join("components/1234.1P.dxf"), &copy).unwrap();
    let failed = bazel.build(":programs_check");
    assert!(!failed.is_success && failed.text.contains("PB504"), "{}", failed.text);
    fs::remove_file(copy).unwrap();
    tree.edit("projects/8002.dxf", ">1234.1P", ">1300.2P");
    for target in [":programs", ":programs_check"] {
        let failed = bazel.build(target);
        assert!(!failed.is_success, "{target} passes though it embeds what is not declared: {}", failed.text);
    }
    tree.configure();
    assert!(bazel.build(":programs_check").is_success);
    assert_eq!(bazel.build(":checksums").made(), [all[0], all[3]]);
    tree.holds_programs("bazel-bin/gcode");
}

/// The library, with an example build next to it.
struct Tree {
    place: Place,
}

impl Tree {
    /// Creates the tree; returns `None`, and reports that the test is skipped, if a program that the example needs is missing.
    fn with(example: &str, needed: &[&str]) -> Option<Self> {
        let is_there =
            |name: &&&str| Command::new(name).arg("--version").output().is_ok_and(|it| it.status.success());
        if let Some(missing) = needed.iter().find(|name| !is_there(name)) {
            skip(
                example,
                &format!("{missing} is missing (apt-get install ninja-build bazel-bootstrap python3)"),
            );
            return None;
        }
        let place = Place::of(LIBRARY);
        for file in fs::read_dir(project().join("examples").join(example)).unwrap() {
            let file = file.unwrap();
            fs::copy(file.path(), place.path().join(file.file_name())).unwrap();
        }
        let made = place.run("q-project components/1300.dxf");
        assert_eq!(made.status, Some(0), "{made}");
        Some(Self { place })
    }

    /// Runs another program, which finds `pathbuild` in its search path.
    fn run(&self, program: &str, arguments: &[&str]) -> Output {
        let ours = Path::new(env!("CARGO_BIN_EXE_pathbuild")).parent().unwrap().to_owned();
        let path = std::env::var_os("PATH").unwrap_or_default();
        let path: OsString =
            std::env::join_paths([ours].into_iter().chain(std::env::split_paths(&path))).unwrap();
        let mut command = Command::new(program);
        command.args(arguments).current_dir(self.place.path()).env("PATH", path);
        command
            .env("XDG_CACHE_HOME", self.place.caches())
            .env("XDG_CONFIG_HOME", self.place.configurations());
        command.output().unwrap()
    }

    fn configure(&self) {
        let output = self.run("python3", &["configure.py"]);
        assert!(output.status.success(), "{}", text(&output));
    }

    fn ninja(&self) -> Build {
        let output = self.run("ninja", &["-k", "0"]);
        let text = text(&output);
        let lines = text.lines().filter(|line| line.starts_with('['));
        let made = lines.filter_map(|line| Some(line.split_once("] ")?.1.to_owned())).collect();
        Build { is_success: output.status.success(), made, text }
    }

    /// Writes a file as a CAD program does: through a temporary file that is renamed.
    fn save(&self, name: &str, content: &[u8]) {
        let file = self.place.path().join(name);
        let beside = file.with_extension("tmp");
        fs::write(&beside, content).unwrap();
        fs::rename(beside, file).unwrap();
    }

    fn edit(&self, name: &str, from: &str, to: &str) {
        let text = fs::read_to_string(self.place.path().join(name)).unwrap();
        assert!(text.contains(from), "{name} has no {from}");
        self.save(name, text.replace(from, to).as_bytes());
    }

    /// Writes the same drawing with different bytes.
    fn save_again(&self, name: &str) {
        let content = fs::read(self.place.path().join(name)).unwrap();
        self.save(name, &[b"999\nsaved again\n", &*content].concat());
    }

    /// Checks that all programs in a directory are current.
    fn holds_programs(&self, directory: &str) {
        let run = self.place.run(&format!("emit --check -v --out-dir {directory}"));
        assert_eq!((run.status, run.stdout.as_str()), (Some(0), ""), "{run}");
    }
}

struct Build {
    is_success: bool,
    made: BTreeSet<String>,
    text: String,
}

impl Build {
    /// Returns the rebuilt targets, sorted by name.
    fn made(&self) -> Vec<&str> {
        assert!(self.is_success, "{}", self.text);
        self.made.iter().map(String::as_str).collect()
    }
}

/// Bazel with its own server and disk cache, both of which are removed when this is dropped.
struct Bazel<'t> {
    tree: &'t Tree,
    place: tempfile::TempDir,
}

impl<'t> Bazel<'t> {
    fn of(tree: &'t Tree) -> Self {
        fs::copy(env!("CARGO_BIN_EXE_pathbuild"), tree.place.path().join("pathbuild")).unwrap();
        Self { tree, place: tempfile::tempdir().unwrap() }
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let root = format!("--output_user_root={}/root", self.place.path().display());
        let startup = [&*root, "--max_idle_secs=60", "--nohome_rc"];
        self.tree.run("bazel", &[&startup, arguments].concat())
    }

    fn build(&self, target: &str) -> Build {
        let [log, cache] = ["log", "cache"].map(|name| self.place.path().join(name).display().to_string());
        _ = fs::remove_file(&log);
        let options = [format!("--execution_log_json_file={log}"), format!("--disk_cache={cache}")];
        let output =
            self.run(&["build", "--color=no", "--nosandbox_debug", &options[0], &options[1], target]);
        let log = fs::read_to_string(&log).unwrap_or_default();
        let actions = serde_json::Deserializer::from_str(&log).into_iter::<Value>().map(Result::unwrap);
        let made = actions.filter(|action| action["remoteCacheHit"] == false);
        let made = made.map(|action| action["progressMessage"].as_str().unwrap().to_owned()).collect();
        Build { is_success: output.status.success(), made, text: text(&output) }
    }
}

impl Drop for Bazel<'_> {
    fn drop(&mut self) {
        self.run(&["clean", "--expunge"]);
    }
}

fn text(output: &Output) -> String {
    [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned()).concat()
}
