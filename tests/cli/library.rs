//! Tests the example library: its drawings, including frames and title blocks, are generated from their text form, and the README's first command
//! works on them. `PATHBUILD_UPDATE=1 cargo test --locked --test cli library::` regenerates them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use pathbuild_testkit::sheet;

const FOLDERS: [&str; 3] = ["components", "projects", "mistakes"];

fn library() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/library")
}

/// Returns the files in text form of a folder, sorted by name.
fn sources(folder: &str) -> Vec<PathBuf> {
    let listed = fs::read_dir(library().join("sources").join(folder)).expect("the library has its sources");
    let mut files: Vec<PathBuf> = listed.map(|entry| entry.expect("it can be listed").path()).collect();
    files.sort();
    files
}

fn drawing(source: &Path) -> Vec<u8> {
    let text = fs::read_to_string(source).expect("a source can be read");
    let sheet = sheet(&text).unwrap_or_else(|errors| panic!("{}: {errors:?}", source.display()));
    sheet.to_dxf()
}

#[test]
fn drawings_are_what_their_text_form_says() {
    let is_update = std::env::var_os("PATHBUILD_UPDATE").is_some();
    for folder in FOLDERS {
        for source in sources(folder) {
            let name = source.file_stem().expect("a source has a name").to_string_lossy().into_owned();
            let file = library().join(folder).join(format!("{name}.dxf"));
            let made = drawing(&source);
            if is_update {
                fs::create_dir_all(library().join(folder)).expect("folders can be made");
                fs::write(&file, &made).expect("drawings can be written");
            }
            let present = fs::read(&file).unwrap_or_default();
            assert!(
                present == made,
                "{} is not what its source says; see the first lines of this test",
                file.display()
            );
        }
    }
}

/// Runs the program in the library's folder. Returns the exit status and the output.
fn pathbuild(arguments: &[&str]) -> (Option<i32>, String) {
    let output = output(arguments);
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

fn output(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pathbuild"))
        .args(arguments)
        .args(["--color", "never", "--no-cache"])
        .current_dir(library())
        .output()
        .expect("the program runs")
}

#[test]
fn the_library_is_right() {
    let (status, said) = pathbuild(&["check", "--format", "concise"]);
    assert_eq!(status, Some(0), "{said}");
    assert!(said.starts_with("34 paths in 31 drawings: no errors, no warnings"), "{said}");
}

/// The Q-project in the library equals the one that the program writes.
#[test]
fn its_q_project_is_that_of_its_drawing() {
    let (status, said) = pathbuild(&["q-project", "components/2057.1-2057.2P.dxf"]);
    assert_eq!((status, said.as_str()), (Some(0), "components/2057.1-2057.2P_Q.dxf: unchanged, 2 paths\n"));
}

#[test]
fn its_projects_are_emitted() {
    let directory = tempfile::tempdir().expect("there is a place for temporary files");
    let out = directory.path().to_str().expect("its name is UTF-8");
    let (status, said) = pathbuild(&["emit", "--out-dir", out]);
    assert_eq!(status, Some(0), "{said}");
    let written = fs::read_dir(directory.path()).expect("it can be listed").count();
    assert_eq!(written, 9, "six programs, and three files of the one with probes: {said}");
}

/// The expected findings for each faulty drawing are in a file next to it.
#[test]
fn mistakes_are_named() {
    let (status, said) = pathbuild(&["check", "mistakes", "--format", "concise"]);
    assert_eq!(status, Some(1), "{said}");
    let findings: String =
        said.lines().filter(|line| line.starts_with("mistakes")).flat_map(|line| [line, "\n"]).collect();
    let file = library().join("mistakes/expected.txt");
    if std::env::var_os("PATHBUILD_UPDATE").is_some() {
        fs::write(&file, &findings).expect("it can be written");
    }
    assert_eq!(findings, fs::read_to_string(&file).expect("it is there").replace("\r\n", "\n"));
}

/// Drawings are checked as a whole, or path by path if the time of each is measured; on one thread or several; one by one or all at once. The
/// findings are the same.
#[test]
fn what_is_found_does_not_depend_on_how_drawings_are_gone_through() {
    let check = |arguments: &[&str]| {
        let found = output(&[&["check", "--format", "json"], arguments].concat()).stdout;
        let found = String::from_utf8(found).expect("JSON is UTF-8");
        let found = found.lines().filter(|line| line.starts_with(r#"{"type":"finding""#));
        found.collect::<Vec<_>>().join("\n")
    };
    let everything = ["mistakes", "components", "projects"];
    let whole = check(&everything);
    assert!(whole.lines().count() > 10, "{whole}");
    for how in [&["--timings"][..], &["-j1"], &["-j1", "--timings"], &["-j3"]] {
        assert_eq!(check(&[&everything, how].concat()), whole, "{how:?}");
    }
    let mut found: Vec<String> = Vec::new();
    for source in sources("mistakes") {
        let name = source.file_stem().expect("a source has a name").to_string_lossy().into_owned();
        found.extend(check(&[&format!("mistakes/{name}.dxf")]).lines().map(without_trace));
    }
    found.sort();
    found.dedup();
    let mut mistakes: Vec<String> = check(&["mistakes"]).lines().map(without_trace).collect();
    mistakes.sort();
    assert_eq!(found, mistakes);
}

/// Returns a finding without the chain of embeddings that led to it: if there are several chains, a run shows only one of them.
fn without_trace(line: &str) -> String {
    let mut finding: serde_json::Value = serde_json::from_str(line).expect("each line is a finding");
    finding["trace"].take();
    finding.to_string()
}
