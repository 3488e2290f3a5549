//! Tests, without a browser, how the compiler answers the messages of the page. The page itself is tested by crates/pathbuild-view/page/web-test.mjs.

#![allow(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test's own files, and answers of a known form"
)]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Role;
use pathbuild_db::system::OsSystem;
use pathbuild_testkit::sheet;
use pathbuild_wasm::Compiler;
use pathbuild_workspace::config::{self, Overrides};
use pathbuild_workspace::emit::WrittenPrograms;
use pathbuild_workspace::session::Session;
use pathbuild_workspace::{Inputs, SilentReporter, Workspace};
use serde_json::{Value, json};

/// The page that sends messages to the compiler.
#[derive(Default)]
struct Page(Compiler);

impl Page {
    fn put(&mut self, file: &str, bytes: &[u8]) {
        let mut message = format!("{}\n", json!({ "ask": "put", "file": file })).into_bytes();
        message.extend(bytes);
        self.0.answer(&message);
    }

    fn ask(&mut self, question: &Value) -> (Value, Vec<u8>) {
        self.ask_with(question, b"")
    }

    fn ask_with(&mut self, question: &Value, bytes: &[u8]) -> (Value, Vec<u8>) {
        let message = [question.to_string().as_bytes(), b"\n", bytes].concat();
        let answer = self.0.answer(&message);
        let end = answer.iter().position(|byte| *byte == b'\n').unwrap();
        (serde_json::from_slice(&answer[..end]).unwrap(), answer[end + 1..].to_vec())
    }

    fn head(&mut self, question: &Value) -> Value {
        self.ask(question).0
    }

    fn open(&mut self, options: &Value) -> Value {
        self.head(&json!({ "ask": "open", "options": options }))
    }

    /// Returns the row of each path, by file and name.
    fn rows(&mut self, drawings: &Value) -> BTreeMap<(String, String), Value> {
        let mut rows = BTreeMap::new();
        for file in drawings.as_array().unwrap() {
            let index = self.head(&json!({ "ask": "index", "file": file }));
            for row in index["rows"].as_array().unwrap().iter().filter(|row| !row["path"].is_null()) {
                let checked = self.head(&json!({ "ask": "check", "file": file, "path": row["path"] }));
                let key = (file.as_str().unwrap().to_owned(), row["path"].as_str().unwrap().to_owned());
                rows.insert(key, checked["row"].clone());
            }
        }
        rows
    }

    /// Returns the programs by file name, and the codes of the problems.
    fn emit(&mut self, places: &[(&str, &str)]) -> (BTreeMap<String, Vec<u8>>, Vec<String>) {
        let places: Vec<Value> =
            places.iter().map(|(file, path)| json!({ "file": file, "path": path })).collect();
        let (head, bytes) = self.ask(&json!({ "ask": "emit", "places": places }));
        let (mut programs, mut rest) = (BTreeMap::new(), &bytes[..]);
        for file in head["files"].as_array().unwrap() {
            let size = usize::try_from(file["size"].as_u64().unwrap()).unwrap();
            programs.insert(file["name"].as_str().unwrap().to_owned(), rest[..size].to_vec());
            rest = &rest[size..];
        }
        assert!(rest.is_empty());
        let codes = head["problems"].as_array().unwrap().iter();
        (programs, codes.map(|found| found["code"].as_str().unwrap().to_owned()).collect())
    }
}

fn library() -> Utf8PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/library");
    Utf8PathBuf::from_path_buf(folder.canonicalize().unwrap()).unwrap()
}

/// Adds all files below a folder, with their relative paths.
fn put_all(page: &mut Page, root: &Utf8Path, folder: &Utf8Path) {
    for entry in folder.read_dir_utf8().unwrap() {
        let path = entry.unwrap().into_path();
        // Programs that a user has emitted into the library do not belong to it.
        if path.is_dir() && path.file_name() != Some("gcode") {
            put_all(page, root, &path);
        } else if path.is_file() {
            page.put(path.strip_prefix(root).unwrap().as_str(), &fs::read(&path).unwrap());
        }
    }
}

fn library_page() -> Page {
    let mut page = Page::default();
    put_all(&mut page, &library(), &library());
    page
}

const LINE: &str = "layer 1000.1P\nstart 0,0 \"T2 O2 I1 B0 MX\"\nmill 0,0 20,0\nend 20,0\n";

fn dxf(text: &str) -> Vec<u8> {
    sheet(text).unwrap().to_dxf()
}

fn full() -> Value {
    json!({ "feed": "150", "sweep-height": "20", "rapid": "1000", "probe-feed": "40" })
}

/// The example library has the states shown by `list`, and its programs equal those that `emit` writes to the file system.
#[test]
fn a_library_has_the_programs_that_are_written_from_files() {
    let mut page = library_page();
    let opened = page.open(&json!({}));
    assert_eq!(opened["problems"], json!([]));
    let rows = page.rows(&opened["drawings"]);
    assert!(rows.len() > 30, "{}", rows.len());
    assert!(rows.values().all(|row| row["state"] == "ok"), "{rows:?}");
    let statistics = page.head(&json!({ "ask": "statistics" }));
    assert_eq!(statistics["statistics"]["paths"], rows.len());
    let place = tempfile_directory();
    let root = library();
    let configuration = Some(root.join("pathbuild.toml"));
    let settings = [("out-dir", vec![place.1.to_string()])].into_iter().collect();
    let given = Overrides { settings, config: configuration, ..Overrides::default() };
    let (settings, faults) = config::load(&OsSystem::shared(), &given, &Inputs::default(), Utf8Path::new(""));
    assert!(faults.is_empty(), "{faults:?}");
    let workspace = Workspace {
        settings,
        system: OsSystem::shared(),
        own_lang: None,
        system_lang: None,
        working_directory: Utf8PathBuf::new(),
        jobs: None,
        cache: None,
        reporter: Arc::new(SilentReporter),
        is_date_decisive: Arc::default(),
    };
    let mut session = Session::new(&workspace);
    let mut compared = 0;
    for (drawing, path) in rows.keys() {
        let file = session.file(&root.join(drawing));
        let name = pathbuild_path::PathName::new(path);
        let target = session.db().target(file, name.as_str(), Role::Emitted);
        let (Ok(_), _) = WrittenPrograms::default().write(&mut session, None, &[file], &[target]) else {
            continue;
        };
        let (programs, _) = page.emit(&[(drawing, path)]);
        for (name, text) in programs {
            let written = place.1.join(Utf8Path::new(&name).file_name().unwrap());
            let expected = fs::read(&written).unwrap_or_else(|error| panic!("{written}: {error}"));
            assert!(expected == text, "{name}");
            compared += 1;
        }
    }
    assert!(compared > 30, "{compared}");
}

fn tempfile_directory() -> (tempfile::TempDir, Utf8PathBuf) {
    let place = tempfile::TempDir::new().unwrap();
    let path = Utf8PathBuf::from_path_buf(place.path().to_owned()).unwrap();
    (place, path)
}

/// Each built-in post can write a path of the library.
#[test]
fn every_post_can_be_chosen() {
    let mut page = library_page();
    let manual = fs::read_to_string(library().join("pathbuild.toml")).unwrap();
    page.put("pathbuild.toml", format!("spindle = \"manual\"\n{manual}").as_bytes());
    let posts = page.open(&json!({}))["posts"].clone();
    let posts = posts.as_array().unwrap();
    assert_eq!(posts.len(), pathbuild_post::BUILT_IN.len());
    let mut texts = Vec::new();
    for post in posts {
        assert_eq!(page.open(&json!({ "post": post["name"] }))["halted"], Value::Null);
        let (programs, problems) = page.emit(&[("projects/8001.1P.dxf", "8001.1P")]);
        assert_eq!(programs.len(), 1, "{post}: {problems:?}");
        texts.extend(programs.into_values());
    }
    let count = texts.len();
    texts.sort_unstable();
    texts.dedup();
    assert_eq!(texts.len(), count, "two posts write the same");
}

/// A path with errors reports them and yields no program; the other paths yield theirs.
#[test]
fn drawings_without_a_configuration_ask_for_values() {
    let mut page = Page::default();
    page.put("1000.1P.dxf", &dxf(LINE));
    page.put("1001.1P.dxf", &dxf(&LINE.replace("1000", "1001").replace("20,0\nend", "19,0\nend")));
    page.put("wrong.dxf", b"no drawing");
    let opened = page.open(&json!({}));
    assert_eq!(opened["drawings"], json!(["1000.1P.dxf", "1001.1P.dxf", "wrong.dxf"]));
    let (refused, _) =
        page.ask(&json!({ "ask": "emit", "places": [{ "file": "1000.1P.dxf", "path": "1000.1P" }] }));
    assert!(refused["refused"].as_str().unwrap().contains("feed"), "{refused}");
    page.open(&full());
    assert_eq!(
        page.head(&json!({ "ask": "check", "file": "1000.1P.dxf", "path": "1000.1P" }))["row"]["state"],
        "ok"
    );
    assert_eq!(
        page.head(&json!({ "ask": "check", "file": "1001.1P.dxf", "path": "1001.1P" }))["row"]["state"],
        "errors"
    );
    let rows = page.head(&json!({ "ask": "index", "file": "wrong.dxf" }));
    assert_eq!(rows["rows"][0]["state"], "errors");
    let (programs, problems) = page.emit(&[("1000.1P.dxf", "1000.1P"), ("1001.1P.dxf", "1001.1P")]);
    assert_eq!(programs.keys().collect::<Vec<_>>(), ["1000.1P_Milling.gcode"]);
    assert!(!problems.is_empty());
    // Files that were handed over do not exist on the visitor's disk.
    let row = page.head(&json!({ "ask": "check", "file": "1000.1P.dxf", "path": "1000.1P" }))["row"].clone();
    assert_eq!((&row["state"], &row["program"]), (&json!("ok"), &Value::Null));
    for (text, state) in [(&programs["1000.1P_Milling.gcode"][..], "current"), (b"G0 X0\n", "stale")] {
        page.put("1000.1P_Milling.gcode", text);
        page.open(&full());
        let row = page.head(&json!({ "ask": "check", "file": "1000.1P.dxf", "path": "1000.1P" }));
        assert_eq!(row["row"]["state"], state);
        assert_eq!(page.emit(&[("1000.1P.dxf", "1000.1P")]).0, programs);
    }
    let (scene, bytes) = page.ask(&json!({ "ask": "scene", "file": "1001.1P.dxf", "path": "1001.1P" }));
    assert_eq!(scene["seen"], true);
    let scene: Value = serde_json::from_slice(&bytes).unwrap();
    assert!(!scene["findings"].as_array().unwrap().is_empty());
    assert_eq!(page.head(&json!({ "ask": "scene", "file": "1000.1P.dxf", "path": "1.1P" }))["seen"], false);
}

/// A page has no date, so a waiver with an end does not hold there, and the finding says so; a waiver without an end holds.
#[test]
fn a_waiver_that_ends_does_not_hold_without_a_date() {
    let drawing = "layer 1000.1P\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 20,0 40,0\nturn 20,0\nend 40,0\n";
    let messages = |end: &str| {
        let mut page = Page::default();
        page.put("1000.1P.dxf", &dxf(drawing));
        let waiver =
            format!("[[severity-in]]\nfiles = [\"*.dxf\"]\nPB114 = \"ignore\"\nreason = \"by hand\"\n{end}");
        page.put("pathbuild.toml", waiver.as_bytes());
        assert_eq!(page.open(&full())["halted"], Value::Null);
        let (_, scene) = page.ask(&json!({ "ask": "scene", "file": "1000.1P.dxf", "path": "1000.1P" }));
        let scene: Value = serde_json::from_slice(&scene).unwrap();
        scene["findings"].as_array().unwrap().iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(messages(""), Vec::<String>::new());
    let [finding] = &messages("until = 2999-12-31\n")[..] else { panic!("one finding") };
    assert!(finding.contains("PB114") && finding.contains("because this run has no date"), "{finding}");
}

/// A path that ended the compiler has PB005 or PB006 in every answer; the other paths are unaffected.
#[test]
fn what_was_lost_is_told() {
    let mut page = Page::default();
    page.put("1000.1P.dxf", &dxf(LINE));
    page.put("1001.1P.dxf", &dxf(&LINE.replace("1000", "1001")));
    page.put("1002.1P.dxf", &dxf(&LINE.replace("1000", "1002")));
    let place = |number| (format!("{number}.1P.dxf"), format!("{number}.1P"));
    let lost = json!([
        { "file": place(1000).0, "path": place(1000).1, "why": "time" },
        { "file": place(1001).0, "path": place(1001).1, "why": "bug", "reason": "index out of bounds" },
        { "file": place(1002).0, "path": null, "why": "bug", "reason": "unreachable" },
    ]);
    page.head(&json!({ "ask": "open", "options": full(), "lost": lost }));
    for (number, code, words) in [(1000, "PB005", "60 s"), (1001, "PB006", "index out of bounds")] {
        let (file, path) = place(number);
        let row = page.head(&json!({ "ask": "check", "file": file, "path": path }))["row"].clone();
        assert_eq!((&row["state"], &row["errors"]), (&json!("errors"), &json!(1)));
        let (_, scene) = page.ask(&json!({ "ask": "scene", "file": file, "path": path }));
        let scene: Value = serde_json::from_slice(&scene).unwrap();
        assert_eq!(scene["findings"][0]["code"], code);
        assert!(scene["findings"][0]["message"]["en"].as_str().unwrap().contains(words), "{scene}");
        assert_eq!(page.emit(&[(&file, &path)]).0, BTreeMap::new());
    }
    let rows = page.head(&json!({ "ask": "index", "file": place(1002).0 }))["rows"].clone();
    assert_eq!((&rows[0]["path"], &rows[0]["state"]), (&Value::Null, &json!("errors")));
    assert_eq!(page.emit(&[(&place(1002).0, &place(1002).1)]).0.len(), 1);
}

/// Two paths with the same output file yield no program, as with `emit`.
#[test]
fn two_paths_never_become_one_file() {
    let mut page = Page::default();
    page.put("pathbuild.toml", b"out-dir = \"out\"\n");
    page.put("a/1000.1P.dxf", &dxf(LINE));
    page.put("b/1000.1P.dxf", &dxf(LINE));
    page.open(&full());
    let both = [("a/1000.1P.dxf", "1000.1P"), ("b/1000.1P.dxf", "1000.1P")];
    let (programs, problems) = page.emit(&both);
    assert_eq!((programs.len(), problems), (0, vec!["PB514".to_owned()]));
    for place in both {
        assert_eq!(page.emit(&[place]).0.into_keys().collect::<Vec<_>>(), ["out/1000.1P_Milling.gcode"]);
    }
}

#[test]
fn what_is_wrong_with_the_configuration_halts() {
    let mut page = Page::default();
    page.put("1000.1P.dxf", &dxf(LINE));
    page.put("pathbuild.toml", b"feed = \"fast\"\n");
    let opened = page.open(&json!({}));
    assert_eq!((&opened["halted"], opened["problems"].as_array().unwrap().len()), (&json!(""), 1));
    assert_eq!(page.head(&json!({ "ask": "statistics" }))["wrong"], "nothing is open");
    page.put("pathbuild.toml", b"feed = 150\n");
    assert_eq!(page.open(&json!({ "rapid": "-1" }))["halted"], "");
    assert_eq!(page.open(&json!({ "post": "teletype" }))["halted"], "");
    assert_eq!(page.open(&json!({ "post": "grbl" }))["halted"], Value::Null);
}

/// A malformed message does not end the compiler.
#[test]
fn what_cannot_be_understood_is_said() {
    let mut page = Page::default();
    for message in [&b""[..], b"{}", b"\xff\n", b"{\"ask\":\"dance\"}\n", b"{\"ask\":\"statistics\"}"] {
        let answer = page.0.answer(message);
        assert!(answer.starts_with(b"{\"wrong\":"), "{}", String::from_utf8_lossy(&answer));
    }
}

/// Returns the scene of a program that is read with these assumptions.
fn program(page: &mut Page, text: &str, assumptions: &Value) -> Value {
    let mut question = json!({ "ask": "program", "name": "dir/a.nc" });
    question.as_object_mut().unwrap().extend(assumptions.as_object().unwrap().clone());
    let (head, scene) = page.ask_with(&question, text.as_bytes());
    assert_eq!(head["seen"], true);
    serde_json::from_slice(&scene).unwrap()
}

fn codes(scene: &Value) -> Vec<&str> {
    scene["findings"].as_array().unwrap().iter().map(|finding| finding["code"].as_str().unwrap()).collect()
}

const TWO_TOOLS: &str = "(TOOL/MILL, 6, 0, 20, 0)
G21 G90 G94 G17
T1 M6
S9000 M3
G0 Z5
G0 X0 Y0
G1 Z-2 F100
G1 X20
G0 X40
G1 X60
G0 Z5
(TOOL/MILL, 3, 0, 20, 0)
T2 M6
S9000 M3
G0 X0 Y20
G1 Z-1 F100
G1 X20
G0 Z5
M30
";

#[test]
fn a_program_is_verified_with_what_is_assumed() {
    let mut page = Page::default();
    page.open(&json!({}));
    let scene = program(&mut page, TWO_TOOLS, &json!({}));
    assert_eq!(codes(&scene), ["PB781"]);
    assert_eq!(scene["findings"][0]["line"], 9);
    assert_eq!(scene["title"], "a.nc");
    let known = &scene["program"];
    assert_eq!(known["surface"], Value::Null);
    assert_eq!(known["checks"][0]["outcome"], "not-made");
    assert!(known["dialects"].as_array().unwrap().contains(&json!("grbl")));
    // Each cutter is shown from the line in which it is selected.
    assert_eq!(scene["paths"][0]["tools"][1]["diameter"], 3.0);
    assert_eq!(scene["paths"][0]["tool"], Value::Null);

    let scene = program(&mut page, TWO_TOOLS, &json!({ "surface": "0", "cutter": "4" }));
    assert!(codes(&scene).contains(&"PB740"), "{:?}", codes(&scene));
    assert_eq!(scene["program"]["checks"][0]["outcome"], "made");
    assert_eq!(scene["paths"][0]["tool"], 4.0);
    let scene = program(&mut page, TWO_TOOLS, &json!({ "surface": "-2.5" }));
    assert!(!codes(&scene).contains(&"PB740"), "{:?}", codes(&scene));
    let scene = program(&mut page, TWO_TOOLS, &json!({ "dialect": "grbl" }));
    assert_eq!(scene["program"]["dialect"], "grbl");
    // A wrong value of an assumption is a finding, and an unknown dialect is guessed.
    let scene = program(&mut page, TWO_TOOLS, &json!({ "cutter": "wide", "dialect": "none" }));
    assert!(codes(&scene).contains(&"PB003"), "{:?}", codes(&scene));
}
