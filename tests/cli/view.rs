//! Tests `view`: scenes, and pictures of them. (docs: "Pictures")

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Heights, Options, interpret};
use pathbuild_gcode::statistics::Summary;
use pathbuild_motion::Move;
use pathbuild_testkit::sheet;
use rayon::prelude::*;
use serde_json::Value;

use crate::conformance::recorded::{self, Form, What};
use crate::growth::drawings;
use crate::support::{self, Place, Run};

/// Tolerance for values in a scene, which are not rounded, unlike statistics in a program's text.
const EXACT: f64 = 1e-4;

fn scene(run: &Run) -> Value {
    assert!(run.stderr.contains(".json: written"), "{run}");
    serde_json::from_str(&fs::read_to_string(run.arguments.rsplit(' ').next().unwrap()).unwrap()).unwrap()
}

/// A warning that is configured as an error keeps `emit` from writing the program, so no file is named.
#[test]
fn a_path_with_a_raised_warning_has_no_program_file() {
    let path = "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 C0.2 F150 S10 MX\"\nmill 0,0 10,0\nend 10,0\n";
    for (severity, written) in [("warning", Value::from("1234.1P_Milling.gcode")), ("error", Value::Null)] {
        let configuration = format!("rapid = 1000\n[severity]\nPB210 = \"{severity}\"\n");
        let place = Place::new().file("1234.1P.dxf", sheet(path).unwrap().to_dxf());
        let place = place.file("pathbuild.toml", configuration);
        let run = place.run("view 1234.1P -o x.json");
        assert_eq!(run.status, Some(i32::from(written.is_null())), "{run}");
        let seen: Value = serde_json::from_str(&place.read("x.json")).unwrap();
        let path = &seen["paths"][0];
        assert_eq!((&path["written"], &path["refusal"]), (&written, &Value::Null), "{run}");
        assert!(!path["moves"].as_array().unwrap().is_empty(), "{run}");
    }
}

/// Elements far away on other layers, or in texts and clamps, are not drawn, and must not take memory either.
#[test]
#[cfg(all(target_os = "linux", feature = "pictures"))]
fn a_png_takes_little_memory_wherever_things_lie() {
    const MOST: u64 = 100 << 20;
    let path = "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 F150\"\nmill 0,0 10,0\nend 10,0\n";
    for far in [
        "layer FRAME\nmill 0,0 50,0\n",
        "layer FRAME\nmill -90000,-70000 90000,80000\nmill circle 0,0 d 150000\n",
        "layer FRAME\nmill circle 0,0 d 3\nmill -40,-4000 40,4000\ntext 4000,3000 \"far\" height 900\n",
    ] {
        let place = Place::new().file("1234.1P.dxf", sheet(&format!("{path}{far}")).unwrap().to_dxf());
        let arguments = "view 1234.1P --no-cache --rapid 900 --sweep-height 5 -o x.png";
        let (is_written, peak) = place.peak_memory(arguments);
        assert!(is_written && (1 << 20..MOST).contains(&peak), "{peak} bytes with {far}");
    }
}

#[test]
fn scenes_add_up_to_the_statistics() {
    let fixtures = support::project().join("fixtures/conformance");
    let mut folders = ["cases", "turns"].map(|name| fixtures.join(name)).to_vec();
    folders.extend(support::shared("conformance/foreign"));
    let runs = recorded::runs(&folders);
    let emits = |arguments: &[String]| arguments.first().is_some_and(|command| command == "emit");
    let compiles = |run: &&recorded::Run| matches!(&run.what, What::Compile(arguments) if emits(arguments));
    let mut seen = Vec::new();
    let runs: Vec<&recorded::Run> = runs
        .iter()
        .filter(|run| run.form == Form::Recorded)
        .filter(compiles)
        .filter(|run| {
            let What::Compile(arguments) = &run.what else { return false };
            let key = (run.case.clone(), arguments.clone());
            let is_new = !seen.contains(&key);
            seen.push(key);
            is_new
        })
        .collect();
    let paths: usize = runs.par_iter().map(|run| adds_up(&run.case, &run.what)).sum();
    assert!(paths > 150, "{paths} paths with programs only");
}

/// Views the programs that a recorded run emits. Returns their number.
fn adds_up(case: &Path, what: &What) -> usize {
    let What::Compile(arguments) = what else { return 0 };
    let output = tempfile::tempdir().unwrap();
    let is_input = |argument: &&String| !argument.starts_with('-');
    let rest: Vec<&String> = arguments[1..].iter().collect();
    let inputs: Vec<&&String> =
        rest.iter().filter(|argument| is_input(argument) && has_drawing(case, argument)).collect();
    let options: Vec<&String> =
        rest.iter().copied().filter(|argument| !inputs.iter().any(|input| **input == *argument)).collect();
    let mut programs = 0;
    for (number, input) in inputs.iter().enumerate() {
        let file = output.path().join(format!("{number}.json"));
        let mut line =
            vec!["view".to_owned(), (**input).clone(), "-o".to_owned(), file.to_str().unwrap().to_owned()];
        line.extend(options.iter().filter(|option| !is_of_emit(option)).map(|option| (*option).clone()));
        let ran = support::program().args(&line).current_dir(case).output().unwrap();
        let Ok(text) = fs::read_to_string(&file) else {
            // If the program cannot be shown, a reason was printed.
            assert!(!ran.stderr.is_empty(), "{}: {line:?}", case.display());
            continue;
        };
        let scene: Value = serde_json::from_str(&text).unwrap();
        for path in scene["paths"].as_array().unwrap() {
            programs += usize::from(agrees(path, &format!("{} {line:?}", case.display())));
        }
    }
    programs
}

fn has_drawing(case: &Path, argument: &str) -> bool {
    case.join(argument).exists() || case.join(format!("{argument}.dxf")).exists()
}

fn is_of_emit(option: &str) -> bool {
    option.starts_with("--out-dir") || option == "--force"
}

/// Whether a path has a program. Asserts that the moves match the lengths of the statistics and the bounding box of the G-code.
fn agrees(path: &Value, name: &str) -> bool {
    let moves = path["moves"].as_array().unwrap();
    if moves.is_empty() {
        return false;
    }
    let sum = |kinds: &[&str], length: &dyn Fn(&Value) -> f64| -> f64 {
        moves.iter().filter(|it| kinds.contains(&it["kind"].as_str().unwrap())).map(length).sum()
    };
    let totals = &path["totals"];
    let total = |name: &str| totals[name].as_f64().unwrap();
    // The length that is drawn equals the one that is counted and the one that is stated.
    let drawn = |it: &Value| in_plane(it).hypot(number(it, "from", 2) - number(it, "to", 2));
    let said = |it: &Value| it["length"].as_f64().unwrap();
    let kinds: [(&[&str], &str); 3] =
        [(&["mill", "mark"], "milling"), (&["plunge"], "drilling"), (&["sweep", "lift"], "sweeps")];
    for (kinds, label) in kinds {
        near(sum(kinds, &drawn), total(label), name, label);
        near(sum(kinds, &said), total(label), name, label);
    }
    boxes_agree(path, moves, name);
    true
}

fn near(found: f64, expected: f64, name: &str, what: &str) {
    let slack = EXACT * (1.0 + expected.abs() / 100.0);
    assert!((found - expected).abs() <= slack, "{name}: {what} {found}, not {expected}");
}

fn number(it: &Value, end: &str, axis: usize) -> f64 {
    it[end][axis].as_f64().unwrap()
}

fn in_plane(it: &Value) -> f64 {
    let away = |from: [f64; 2]| (number(it, "from", 0) - from[0]).hypot(number(it, "from", 1) - from[1]);
    match it["arc"].as_object() {
        None => away([number(it, "to", 0), number(it, "to", 1)]),
        Some(arc) => {
            let centre = [0, 1].map(|axis| arc["centre"][axis].as_f64().unwrap());
            away(centre) * arc["degrees"].as_f64().unwrap().to_radians()
        }
    }
}

/// Tolerance in mm for numbers with three decimals, and for arcs in pieces of half a degree.
const DIGITS: f64 = 0.005;

/// Returns the ends of a move and, for an arc, many points along it.
fn points(it: &Value) -> Vec<[f64; 3]> {
    let place = |end: &str| [0, 1, 2].map(|axis| number(it, end, axis));
    let (from, to) = (place("from"), place("to"));
    let Some(arc) = it["arc"].as_object() else { return vec![from, to] };
    assert_eq!(arc["axes"], serde_json::json!([0, 1]));
    let centre = [0, 1].map(|axis| arc["centre"][axis].as_f64().unwrap());
    let (x, y, degrees) = (from[0] - centre[0], from[1] - centre[1], arc["degrees"].as_f64().unwrap());
    let way = if arc["clockwise"].as_bool().unwrap() { -degrees } else { degrees };
    let inner = (0..=720).map(|piece| {
        let (sin, cos) = (way * f64::from(piece) / 720.0).to_radians().sin_cos();
        [centre[0] + x * cos - y * sin, centre[1] + x * sin + y * cos, from[2]]
    });
    inner.chain([from, to]).collect()
}

/// Checks that the bounding box of a path's moves equals that of its G-code, up to the written digits.
fn boxes_agree(path: &Value, moves: &[Value], name: &str) {
    let text = path["gcode"].as_str().unwrap();
    let options = Options { heights: Heights::Nominal, ..Options::default() };
    let read = interpret(text.as_bytes(), Dialect::Native, &options);
    let of_text = Summary::of(&read.steps, false).cut;
    let is_cut = |it: &&Value| ["mill", "mark", "plunge"].contains(&it["kind"].as_str().unwrap());
    let points: Vec<[f64; 3]> = moves.iter().filter(is_cut).flat_map(points).collect();
    for (axis, expected) in of_text.iter().enumerate() {
        let Some((expected_low, expected_high)) = *expected else { continue };
        let along = || points.iter().map(|at| at[axis]);
        let (low, high) = (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
        let is_same = |a: f64, b: f64| (a - b).abs() <= DIGITS;
        assert!(
            is_same(low, expected_low) && is_same(high, expected_high),
            "{name}: axis {axis}: {low} to {high}"
        );
    }
    let lines = text.lines().count() as u64;
    for it in moves {
        let line = it["line"].as_u64().unwrap_or_else(|| panic!("{name}: a move without a line"));
        let text = text.lines().nth(usize::try_from(line - 1).unwrap()).unwrap();
        assert!(line <= lines && text.starts_with('G'), "{name}: line {line} is {text:?}");
    }
}

fn library() -> Place {
    let place = Place::new();
    let library = support::project().join("fixtures/library");
    for folder in ["components", "projects", "mistakes"] {
        for entry in fs::read_dir(library.join(folder)).unwrap() {
            let file = entry.unwrap().path();
            if file.extension().is_some_and(|extension| extension == "dxf") {
                let name = format!("{folder}/{}", file.file_name().unwrap().to_str().unwrap());
                fs::create_dir_all(place.path().join(folder)).unwrap();
                fs::copy(&file, place.path().join(name)).unwrap();
            }
        }
    }
    fs::copy(library.join("pathbuild.toml"), place.path().join("pathbuild.toml")).unwrap();
    place
}

/// The posts whose programs are read in the dialect of the same name.
const POSTS: [&str; 7] = ["grbl", "linuxcnc", "mach3", "fanuc", "haas", "marlin", "xpertmill"];

#[test]
fn the_text_is_the_file_that_emit_writes_and_each_cut_has_its_line() {
    let place = library();
    let configuration = fs::read_to_string(place.path().join("pathbuild.toml")).unwrap();
    let configuration = configuration.replace("cycles = true", "");
    for post in ["native"].iter().chain(&POSTS) {
        for (name, cycles) in [("8001.1P", true), ("8002.1P", false)] {
            let manual =
                format!("post = \"{post}\"\nspindle = \"manual\"\ncycles = {cycles}\n{configuration}");
            fs::write(place.path().join("pathbuild.toml"), manual).unwrap();
            let file = place.path().join("x.json").to_str().unwrap().to_owned();
            let scene = scene(&place.run_with(&["view", name, "-o", &file]));
            let path = &scene["paths"][0];
            let emitted =
                place.run_with(&["emit", name, "--no-cache", "-o", "-"]).stdout.replace("\r\n", "\n");
            assert_eq!(path["gcode"].as_str().unwrap(), emitted, "{post}");
            assert!(path["written"].as_str().unwrap().contains("_Milling."), "{post}");
            assert_eq!(path["native"].is_null(), *post == "native", "{post}");
            lines_lead_to_moves(path, &emitted, post.parse().unwrap());
        }
    }
}

/// Lines are looked up while the text is read, in a window of some thousand moves.
#[test]
fn the_cuts_of_a_long_program_have_their_lines() {
    for post in ["native", "grbl"] {
        let configuration =
            format!("post = \"{post}\"\nspindle = \"manual\"\nfeed = 150\nrapid = 900\nsweep-height = 9\n");
        let place =
            Place::new().file("pathbuild.toml", configuration).file("1202.1P.dxf", drawings::chain(9000));
        let file = place.path().join("x.json").to_str().unwrap().to_owned();
        let path = &scene(&place.run_with(&["view", "1202.1P", "-o", &file]))["paths"][0];
        assert!(path["moves"].as_array().unwrap().len() > 9000, "{post}");
        lines_lead_to_moves(path, path["gcode"].as_str().unwrap(), post.parse().unwrap());
    }
}

/// Checks that the line of each milling move starts where the move does, in a text read in this dialect, and that plunges have a line as well.
fn lines_lead_to_moves(path: &Value, text: &str, dialect: Dialect) {
    let options = Options { heights: Heights::Nominal, ..Options::default() };
    let mut read: BTreeMap<u64, Vec<Move>> = BTreeMap::new();
    for (line, way) in interpret(text.as_bytes(), dialect, &options).moves() {
        read.entry(line.into()).or_default().push(way);
    }
    for (index, it) in path["moves"].as_array().unwrap().iter().enumerate() {
        let line = it["line"].as_u64().unwrap_or_else(|| panic!("{dialect}: no line for {it}"));
        // The first moves are rapid moves, which posts write in various ways, but the tool ends where each of them does.
        if index < 4 && it["kind"] != "mill" {
            let ends = |at: [f64; 3]| (0..3).all(|axis| (at[axis] - number(it, "to", axis)).abs() < 0.006);
            let is_there = read.get(&line).is_some_and(|ways| ways.iter().any(|way| ends(way.to.at)));
            assert!(is_there, "{dialect}: line {line} does not end {it}");
        }
        if it["kind"] == "mill" || it["kind"] == "mark" {
            let begins =
                |at: [f64; 3]| (0..3).all(|axis| (at[axis] - number(it, "from", axis)).abs() < 0.006);
            let is_there = read.get(&line).is_some_and(|ways| ways.iter().any(|way| begins(way.from.at)));
            assert!(is_there, "{dialect}: line {line} does not begin {it}");
        }
    }
}

#[test]
fn a_refused_program_is_shown_as_preview_with_the_reason() {
    let place = library();
    let configuration = fs::read_to_string(place.path().join("pathbuild.toml")).unwrap();
    fs::write(place.path().join("pathbuild.toml"), format!("post = \"fanuc\"\n{configuration}")).unwrap();
    let file = place.path().join("x.json").to_str().unwrap().to_owned();
    let ran = place.run_with(&["view", "8001.1P", "-o", &file]);
    let scene = scene(&ran);
    let path = &scene["paths"][0];
    assert!(path["written"].is_null() && path["gcode"].as_str().unwrap().contains("(Sum:"));
    assert!(path["refusal"]["en"].as_str().unwrap().contains("spindle"), "{path}");
    assert!(path["refusal"]["de"].as_str().unwrap().contains("Spindel"), "{path}");
}

#[test]
fn values_that_nothing_gives_are_examples_and_times_without_them_are_left_out() {
    let drawing = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B4 MX\"\nmill 0,0 40,0\nend 40,0\n";
    let place = Place::of(&format!("== 1234.1P.dxf ==\n{drawing}"));
    let file = place.path().join("x.json").to_str().unwrap().to_owned();
    let seen = |arguments: &[&str]| {
        let scene = scene(&place.run_with(&[&["view", "1234.1P.dxf"], arguments, &["-o", &file]].concat()));
        let path = &scene["paths"][0];
        let text = path["gcode"].as_str().unwrap().to_owned();
        assert!(!text.contains("inf") && !text.contains("NaN"), "{text}");
        (path["examples"].to_string(), path["totals"]["minutes"].clone(), path["written"].is_null(), text)
    };
    let (examples, minutes, is_preview, text) = seen(&[]);
    assert_eq!(
        examples,
        r#"[{"name":"S","value":"7"},{"name":"feed","value":null},{"name":"rapid","value":null}]"#
    );
    assert!(minutes.is_null() && is_preview && !text.contains(" min)"), "{text}");
    let (examples, minutes, is_preview, text) = seen(&["--feed", "100", "--sweep-height", "9"]);
    assert_eq!(examples, r#"[{"name":"rapid","value":null}]"#);
    assert!(
        minutes.is_null() && is_preview && text.contains("(Milling length:    40 mm   ca.  1 min)"),
        "{text}"
    );
    assert!(text.lines().any(|line| line.starts_with("(Sum:") && !line.contains("min")), "{text}");
    let (examples, minutes, is_preview, _) =
        seen(&["--feed", "100", "--sweep-height", "9", "--rapid", "1000"]);
    assert!(examples == "null" && minutes == 1.0 && !is_preview);
}

/// The shown program of a path with variables has the S that its moves and example values have: T + O if the path gives none.
#[test]
fn a_path_with_variables_has_one_sweep_height() {
    let drawing = |start: &str| {
        format!(
            "layer 1234.1P\nstart 0,0 \"T5 O2 I1 F100 MX :X-0.2~1 B=X {start}\"\nmill 0,0 40,0\nend 40,0\n"
        )
    };
    for (start, sweep_height, expected, is_example) in [
        ("", "", 7.0, true),
        ("", "sweep-height = 20\n", 7.0, true),
        ("S9", "sweep-height = 20\n", 9.0, false),
    ] {
        let place = Place::of(&format!("== 1234 Pv.dxf ==\n{}", drawing(start)))
            .file("pathbuild.toml", format!("rapid = 1000\n{sweep_height}"));
        let file = place.path().join("x.json").to_str().unwrap().to_owned();
        let scene = scene(&place.run_with(&["view", "1234 Pv.dxf", "-o", &file]));
        let path = &scene["paths"][0];
        assert_eq!(path["sweep_height"], expected, "{start} {sweep_height}");
        let text = path["gcode"].as_str().unwrap();
        assert!(text.contains(&format!("G00 Z{expected:.3}\n")), "{text}");
        assert_eq!(path["examples"].to_string().contains(r#""name":"S""#), is_example, "{path}");
        lines_lead_to_moves(path, text, Dialect::Native);
    }
}

/// After a tool change, moves count only from where X, Y and Z are stated again: the time to each move ends with the stated time.
#[test]
fn lengths_of_moves_add_up_to_the_totals() {
    let program = "G17 G21 G90 G94\nT1 M6\nG0 X0 Y0\nG0 Z9\nG1 Z-1 F100\nG1 X50\nG0 Z9\n\
                   T2 M6\nG0 X70 Y0\nG0 Z9\nG1 Z-1\nG1 X20\nG0 Z9\nM30\n";
    let place = Place::new().file("a.nc", program);
    let file = place.path().join("x.json").to_str().unwrap().to_owned();
    let path = &scene(&place.run_with(&["view", "a.nc", "--dialect", "linuxcnc", "-o", &file]))["paths"][0];
    let lengths = path["moves"].as_array().unwrap().iter().map(|it| it["length"].as_f64().unwrap());
    let lengths: Vec<f64> = lengths.collect();
    assert_eq!(lengths, [0.0, 0.0, 10.0, 50.0, 10.0, 0.0, 0.0, 10.0, 50.0, 10.0]);
    let totals = ["milling", "drilling", "sweeps"].map(|kind| path["totals"][kind].as_f64().unwrap());
    assert_eq!(totals, [100.0, 20.0, 20.0]);
}

#[test]
fn line_ends_are_no_part_of_lines() {
    let text = "G17 G21 G90 G94\nG0 X0 Y0\nG0 Z5\nG1 Z1 F100\nM30\n";
    for ends in ["\n", "\r\n", "\r"] {
        let place = Place::new().file("a.nc", text.replace('\n', ends));
        let file = place.path().join("x.json").to_str().unwrap().to_owned();
        let scene = scene(&place.run_with(&["view", "a.nc", "-o", &file]));
        assert_eq!(scene["paths"][0]["gcode"].as_str().unwrap(), text, "{ends:?}");
        assert_eq!(scene["paths"][0]["moves"][2]["line"], 4, "{ends:?}");
    }
}

#[test]
fn a_project_shows_what_it_embeds_and_where_moves_come_from() {
    let place = library();
    let file = place.path().join("x.json").to_str().unwrap().to_owned();
    let scene = scene(&place.run_with(&["view", "8001.1P", "-o", &file]));
    assert_eq!((scene["schema"].as_str(), scene["version"].as_u64()), (Some("pathbuild-scene"), Some(1)));
    let path = &scene["paths"][0];
    let names: Vec<&str> =
        path["embedded"].as_array().unwrap().iter().map(|it| it["name"].as_str().unwrap()).collect();
    assert_eq!(names[..3], ["8001.1P", "2050.1P", "2050.2P"]);
    let elements = path["elements"].as_array().unwrap();
    for it in path["moves"].as_array().unwrap().iter().filter(|it| it["kind"] == "mill") {
        let element = &elements[usize::try_from(it["element"].as_u64().unwrap()).unwrap()];
        assert!(["mill", "support", "mark"].contains(&element["kind"].as_str().unwrap()), "{it}: {element}");
        assert_ne!(element["path"], 0, "everything is milled by embedded paths");
    }
    let bars = path["bars"].as_array().unwrap();
    assert!(
        bars.iter()
            .all(|bar| elements[usize::try_from(bar["element"].as_u64().unwrap()).unwrap()]["kind"]
                == "support")
    );
    assert!(!bars.is_empty() && !scene["other_layers"].as_array().unwrap().is_empty());
    let owners = |text: &Value| text["elements"].as_array().unwrap().len();
    assert!(path["texts"].as_array().unwrap().iter().all(|text| owners(text) > 0));
}

#[test]
fn findings_have_their_places() {
    let place = library();
    let file = place.path().join("x.json").to_str().unwrap().to_owned();
    let run = place.run_with(&["view", "mistakes/3001.1P.dxf", "-o", &file]);
    assert_eq!(run.status, Some(1), "{run}");
    let scene = scene(&run);
    let finding = &scene["findings"][0];
    assert_eq!((finding["number"].as_u64(), finding["code"].as_str()), (Some(1), Some("PB401")));
    assert_eq!(finding["at"], serde_json::json!([20.0, 0.0]));
    assert!(scene["paths"][0]["moves"].as_array().unwrap().is_empty());
    assert_eq!(scene["paths"][0]["elements"].as_array().unwrap().len(), 4);
}

/// A finding about a parameter text is circled at the text; one about the order of milling is circled where the chain breaks off.
#[test]
fn a_wrong_text_is_circled_itself() {
    let drawing = |text: &str, end: &str| {
        format!("layer 1234.1P\nstart 5,5 \"T2 O2 I1 B0 F150\"\nmill 5,5 25,5 {text}\nend {end}\n")
    };
    for (drawing, code, expected) in [
        (drawing("\"B1mm\"", "25,5"), "PB205", None),
        (drawing("\"B1\"", "45,5"), "PB403", Some([45.0, 5.0])),
    ] {
        let place = Place::new().file("1234.1P.dxf", sheet(&drawing).unwrap().to_dxf());
        let out = place.path().join("scene.json");
        let scene = scene(&place.run(&format!("view 1234.1P --no-cache -o {}", out.display())));
        let [finding] = scene["findings"].as_array().unwrap().as_slice() else { panic!("{scene}") };
        assert_eq!(finding["code"], code);
        let point = |at: &Value| [0, 1].map(|axis| at[axis].as_f64().unwrap());
        let texts = scene["paths"][0]["texts"].as_array().unwrap();
        let text = texts.iter().find(|text| text["text"] == "B1mm").map(|text| point(&text["at"]));
        let (at, expected) = (point(&finding["at"]), expected.or(text).unwrap());
        assert!((0..2).all(|axis| (at[axis] - expected[axis]).abs() < 1e-5), "{at:?} {expected:?}");
    }
}

/// A line with a line type that has no meaning is drawn, and the finding is at the line's middle instead of the start marker.
#[test]
fn an_element_is_circled_at_its_middle() {
    let place = library();
    place.run("view mistakes/3010.1P.dxf --no-cache -o x.json");
    let scene: Value = serde_json::from_str(&place.read("x.json")).unwrap();
    assert_eq!(scene["findings"][0]["code"], "PB106");
    let elements = scene["paths"][0]["elements"].as_array().unwrap();
    let shape = &elements.iter().find(|element| element["kind"] == "unclear").unwrap()["shape"];
    let middle = [0, 1].map(|axis| {
        f64::midpoint(shape["from"][axis].as_f64().unwrap(), shape["to"][axis].as_f64().unwrap())
    });
    assert_eq!(scene["findings"][0]["at"], serde_json::json!(middle));
    // The path breaks off at a position that is also the start of an element.
    let drawing = "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 F150\"\nmill 20,0 0,0\nmill 21,0 30,0\nend 30,0\n";
    let place = Place::new().file("1234.1P.dxf", sheet(drawing).unwrap().to_dxf());
    place.run("view 1234.1P --no-cache -o x.json");
    let scene: Value = serde_json::from_str(&place.read("x.json")).unwrap();
    let finding = &scene["findings"][0];
    assert_eq!((finding["code"].as_str(), &finding["at"]), (Some("PB401"), &serde_json::json!([20.0, 0.0])));
}

/// A full circle keeps its centre: SVG computes it from the ends of arcs, which are rounded.
#[test]
fn circles_keep_their_centres() {
    let program = "G21 G90 G17\nG0 Z5\nG0 X10 Y0\nG1 Z-1 F100\nG2 X10 Y0 I3.37 J1.11 F100\nG0 Z5\nM30\n";
    let place = Place::new().file("a.nc", program);
    let run = place.run("view a.nc -o x.svg");
    assert_eq!(run.status, Some(0), "{run}");
    let svg = place.read("x.svg");
    let numbers = |text: &str| -> Vec<f64> {
        text.split(|letter: char| letter != '.' && letter != '-' && !letter.is_ascii_digit())
            .filter_map(|number| number.parse().ok())
            .collect()
    };
    let mut seen = 0;
    for data in svg.split(" d=\"").skip(1).map(|text| text.split_once('"').unwrap().0) {
        let pieces: Vec<Vec<f64>> = data.split('A').map(numbers).collect();
        let ends: Vec<[f64; 2]> =
            pieces.iter().map(|piece| [piece[piece.len() - 2], piece[piece.len() - 1]]).collect();
        if pieces.len() < 2 || ends[0] != ends[ends.len() - 1] {
            continue;
        }
        seen += 1;
        // The angle between neighbouring ends, seen from the centre, determines how far the rounding of the ends moves the centre.
        let radius = pieces[1][0];
        let is_apart = |pair: &[[f64; 2]]| {
            let [[x, y], [a, b]] = [pair[0], pair[1]];
            (a - x).hypot(b - y) < 1.8 * radius
        };
        assert!(ends.windows(2).all(is_apart), "{data}");
    }
    assert_eq!(seen, 1, "{svg}");
}

/// Texts of one height have one size, whether they are TEXT or MTEXT, short or long.
#[test]
fn texts_of_one_height_have_one_size() {
    let place = library();
    place.run("view mistakes/3004.1P.dxf --no-cache -o x.svg");
    let svg = place.read("x.svg");
    let size = |text: &str| {
        let line = svg.lines().find(|line| line.ends_with(&format!(">{text}</text>"))).unwrap();
        line.split_once("font-size=\"").unwrap().1.split_once('"').unwrap().0.to_owned()
    };
    assert_eq!(size("O2 T2 M20x2 F150 I0.5 B-0.2"), size("b0.5"));
}

#[test]
fn a_program_is_seen_without_elements() {
    let place =
        Place::new().file("a.nc", "G21 G90 G17\nG0 Z5\nG0 X0 Y0\nG1 F100 Z-1\nG2 F200 X10 Y0 I5 J0\nM30\n");
    let file = place.path().join("x.json").to_str().unwrap().to_owned();
    let scene = scene(&place.run_with(&["view", "a.nc", "-o", &file]));
    let path = &scene["paths"][0];
    assert!(path["elements"].as_array().unwrap().is_empty());
    let arc = path["moves"].as_array().unwrap().iter().find(|it| it["arc"].is_object()).unwrap();
    assert_eq!((arc["arc"]["degrees"].as_f64(), arc["line"].as_u64()), (Some(180.0), Some(5)));
    assert_eq!(place.run("view a.nc -o a.svg").status, Some(0));
}

/// A program is checked as by `verify`, with the cutters and the material that it assumes.
#[test]
fn a_program_is_shown_with_its_findings_and_checks() {
    let slots = |between: &str| {
        format!(
            "(T1 D=6 CR=0 - ZMIN=-2 - flat end mill)\n(T2 D=3 CR=0 - ZMIN=-1 - flat end mill)\nG21 G90 G17 G94 G54\nT1 M6\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-2 F100\nG1 X40 F300\n{between}G0 Y20\nG1 X0\nG0 Z5\nT2 M6\nM3 S9000\nG4 P2\nG0 X0 Y40\nG1 Z-1 F100\nG1 X40\nG0 Z5\nM30\n"
        )
    };
    let place = Place::new().file("low.nc", slots("")).file("lifted.nc", slots("G0 Z5\n"));
    let place = place.file("short.nc", slots("G0 Z5\nM30\n"));
    let view = |file: &str, options: &str| {
        let json = place.path().join("x.json").to_str().unwrap().to_owned();
        let words = format!("view {file} --dialect linuxcnc {options}");
        let arguments: Vec<&str> = words.split_whitespace().chain(["-o", &json]).collect();
        let run = place.run_with(&arguments);
        let status = run.status;
        (scene(&run), status)
    };
    let (low, status) = view("low.nc", "--surface 0");
    assert_eq!((&low["findings"][0]["code"], status), (&"PB740".into(), Some(1)));
    let (lifted, status) = view("lifted.nc", "--surface 0");
    assert_eq!((lifted["findings"].as_array().map(Vec::len), status), (Some(0), Some(0)));
    let diameters: Vec<_> =
        lifted["paths"][0]["tools"].as_array().unwrap().iter().map(|it| &it["diameter"]).collect();
    assert_eq!(diameters, [6.0, 3.0]);
    let program = &lifted["program"];
    assert_eq!(
        (&program["surface"], &program["waits"]["en"]),
        (&0.0.into(), &"2.0 s dwelling, 2 tool changes".into())
    );
    assert_eq!(
        (&program["checks"][0]["check"], &program["checks"][0]["outcome"]),
        (&"rapids".into(), &"assumed".into())
    );
    let run = place.run("import short.nc --dialect linuxcnc");
    assert!(run.stdout.contains("waits      1 tool change\n"), "{run}");
    let (unknown, _) = view("lifted.nc", "");
    assert_eq!(
        (&unknown["program"]["surface"], &unknown["program"]["checks"][0]["outcome"]),
        (&Value::Null, &"not-made".into())
    );
}

/// Without the diameter of one of the tools there is no stock; the given surface is shown all the same.
#[test]
fn a_tool_of_unknown_diameter_is_not_shown_with_another_one() {
    let program = |second: &str| {
        format!(
            "(T1 D=6 CR=0 - ZMIN=-2 - flat end mill)\n{second}G21 G90 G17 G94 G54\nT1 M6\nM3 S9000\nG0 Z15\nG0 X0 Y0\n\
             G1 Z-2 F100\nG1 X40\nG0 Z15\nT2 M6\nM3 S9000\nG0 X0 Y40\nG1 Z-1 F100\nG1 X40\nG0 Z15\nM30\n"
        )
    };
    let place = Place::new()
        .file("known.nc", program("(T2 D=3 CR=0 - ZMIN=-1 - flat end mill)\n"))
        .file("unknown.nc", program(""));
    let view = |file: &str| {
        let json = place.path().join("x.json").to_str().unwrap().to_owned();
        let options = ["--dialect", "linuxcnc", "--surface", "5", "-o", &json];
        let scene = scene(&place.run_with(&[&["view", file], &options[..]].concat()));
        let path = &scene["paths"][0];
        let tools = path["tools"].as_array().map_or(0, Vec::len);
        (path["tool"].clone(), tools, scene["program"]["surface"].clone())
    };
    assert_eq!(view("known.nc"), (Value::Null, 2, 5.0.into()));
    assert_eq!(view("unknown.nc"), (Value::Null, 0, 5.0.into()));
}

/// A probing move ends at an unknown height, where the probe makes contact.
#[test]
fn the_end_of_a_probing_move_is_unknown() {
    let place = Place::new().file("a.nc", "G21 G90 G17 G94\nG0 X1 Y2 Z5\nG38.2 Z-10 F50\nG0 X3\nM30\n");
    let json = place.path().join("x.json").to_str().unwrap().to_owned();
    let scene = scene(&place.run_with(&["view", "a.nc", "--dialect", "linuxcnc", "-o", &json]));
    let moves = scene["paths"][0]["moves"].as_array().unwrap();
    let probe = moves.iter().find(|it| it["kind"] == "probe").unwrap();
    assert_eq!(probe["from"], serde_json::json!([1.0, 2.0, 5.0]));
    assert_eq!(probe["to"], serde_json::json!([1.0, 2.0, null]));
}

/// A finding is placed at the first move of its line; a line without moves is only named.
#[test]
fn still_pictures_of_programs_show_where_findings_are() {
    let place = Place::new().file("a.nc", "G21 G90 G17 G94\nG0 Z5\nG0 X3 Y7\nG1 Z-1\nM77\nG0 Z5\nM2\n");
    let json = place.path().join("x.json").to_str().unwrap().to_owned();
    let scene = scene(&place.run_with(&["view", "a.nc", "--dialect", "linuxcnc", "-o", &json]));
    let findings = scene["findings"].as_array().unwrap();
    let found: Vec<_> = findings.iter().map(|finding| (&finding["line"], &finding["at"])).collect();
    assert_eq!(found, [(&4.into(), &serde_json::json!([3.0, 7.0])), (&5.into(), &Value::Null)]);
    for (lang, line) in [("en", "line"), ("de", "Zeile")] {
        place.run(&format!("view a.nc --dialect linuxcnc --lang {lang} -o a.svg"));
        let svg = fs::read_to_string(place.path().join("a.svg")).unwrap();
        assert!(
            svg.contains(&format!("1 · {line} 4 · PB")) && svg.contains(&format!("2 · {line} 5 · PB")),
            "{svg}"
        );
    }
}

/// The scale of depths reaches the lowest point of an arc in a vertical plane, not only its ends.
#[test]
fn the_depth_of_an_arc_is_that_of_its_lowest_point() {
    let place = Place::new()
        .file("a.nc", "G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG18 G2 X10 Z-1 I5 K0\nG0 Z5\nM30\n");
    place.run("view a.nc --dialect linuxcnc -o a.svg");
    let svg = fs::read_to_string(place.path().join("a.svg")).unwrap();
    assert!(svg.contains("-6"), "{svg}");
}

/// A page is sent to others, so it names files relative to the shown file and does not reveal where they are on this machine.
#[test]
fn absolute_names_are_not_in_a_scene() {
    let place = library().file("else/a.nc", "G21 G90 G17\nG0 X0 Y0 Z5\nG1 F100 Z-1\nM30\n");
    let root = place.path().to_str().unwrap();
    for (file, expected) in [
        ("else/a.nc", "a.nc"),
        ("mistakes/3008.1P.dxf", "3008.1P.dxf"),
        ("projects/8001.1P.dxf", "../components/2050.1P.dxf"),
    ] {
        let file = format!("{root}/{file}");
        let run = place.run_in("else", &["view", &file, "-o", "x.json", "--no-cache"]);
        assert!(run.stderr.contains("x.json: written"), "{run}");
        let scene = place.read("else/x.json");
        assert!(!scene.contains(root) && scene.contains(&format!("\"{expected}\"")), "{scene}");
        // The terminal shows the names as they were given.
        assert_eq!(run.stderr.contains("<PLACE>/mistakes"), file.contains("3008"), "{run}");
    }
}

/// Tests cases without pictures in the book: a drawing with an erroneous path, and a program of another origin.
#[test]
fn without_a_program_and_without_elements() {
    let broken = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B4 MPlate\"\nmill 0,0 20,0 \"B3\"\nmark 20,0 20,10\nsweep 20,10 30,10\nbars 31,10 40,10\nprobe 5,5 \"LA\"\nturn 20,0\nend 40,10\n";
    let program = "G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG2 X10 Y0 I5 J0 F200\nG3 X10 Y0 I-5 J0\nG1 X20 Y5 Z-2\nG0 Z5\nG0 X25 Y5\nG1 Z-1 F50\nG0 Z5\nM30\n";
    let place = Place::new()
        .file("pathbuild.toml", "sweep-height = 9\nfeed = 150\nrapid = 900\n")
        .file("1234.1P.dxf", sheet(broken).unwrap().to_dxf())
        .file("a.nc", program);
    let run = place.run("view 1234.1P.dxf -o a.svg --lang de");
    assert_eq!(run.status, Some(1), "{run}");
    assert_snapshot!("of_a_drawing_with_errors", place.read("a.svg"));
    let run = place.run("view a.nc -o a.svg");
    assert_eq!(run.status, Some(0), "{run}");
    assert_snapshot!("of_a_program", place.read("a.svg"));
}

#[test]
fn a_line_has_the_colour_of_its_deepest_pass_whichever_way_it_goes() {
    let fro = "G0 Y0\nG0 X0\nG1 Z2 F100\nG1 X10\nG1 Z1\nG1 X0\nG0 Z5\n";
    let once = "G0 X0 Y5\nG1 Z1\nG1 X10\nG0 Z5\n";
    let arcs = "G0 Y10\nG1 Z2\nG2 X20 I5 J0\nG1 Z1\nG3 X10 I-5 J0\nG0 Z5\n";
    let circle = "G0 Y30\nG1 Z2\nG2 I5 J0\nG1 Z1\nG3 I5 J0\nG0 Z5\n";
    let program = format!("G21 G90 G17 G94 G91.1\nG0 Z5\n{fro}{once}{arcs}{circle}M2\n");
    let place = Place::new().file("a.gcode", program);
    let run = place.run("view a.gcode -o a.svg");
    let svg = place.read("a.svg");
    let cuts = svg.split("id=\"cuts\"").nth(1).unwrap().split("</g>").next().unwrap();
    let strokes: Vec<&str> = cuts.split("stroke=\"").skip(1).map(|text| &text[..7]).collect();
    assert!(strokes.iter().all(|colour| *colour == "#2a1454"), "{run}\n{cuts}");
    assert_eq!(cuts.matches('M').count(), 4, "{cuts}");
}

#[test]
fn pictures_are_the_same_bytes_on_every_run() {
    let place = library();
    for file in ["a.svg", "b.svg"] {
        let run = place.run(&format!("view 8001.1P -o {file}"));
        assert_eq!(run.status, Some(0), "{run}");
    }
    let picture = place.read("a.svg");
    assert_eq!(picture, place.read("b.svg"));
    assert!(place.run("view 8001.1P -o a.svg").stderr.contains("unchanged"));
    for part in ["id=\"kerf\"", "id=\"rapids\"", "id=\"bars\"", "2052.1P", "start X0 Y0", "20 mm"] {
        assert!(picture.contains(part), "{part}");
    }
    // Texts lie above the width of the cutter, and below its path.
    let layers = ["kerf", "texts", "cuts"].map(|layer| picture.find(&format!("id=\"{layer}\"")).unwrap());
    assert!(layers.is_sorted(), "{layers:?}");
    assert!(place.run("view 8001.1P -o a.svg --lang de").stderr.contains("geschrieben"));
    assert!(place.read("a.svg").contains("Stützsteg"));
}

const RAPID_THROUGH_MATERIAL: &str = "rapid move through material";

#[test]
fn the_stock_is_the_same_bytes_on_every_run() {
    let place = library();
    for file in ["a.svg", "b.svg"] {
        let run = place.run(&format!("view 8001.1P --stock -o {file}"));
        assert_eq!(run.status, Some(0), "{run}");
    }
    let picture = place.read("a.svg");
    assert_eq!(picture, place.read("b.svg"));
    assert!(picture.contains("cut through") && !picture.contains(RAPID_THROUGH_MATERIAL), "{picture}");
}

/// Returns the horizontal moves of a picture with a stroke of this colour: left and right end, and width of the stroke.
fn swept(svg: &str, color: &str) -> Vec<[f64; 3]> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let strokes = document.descendants().filter(|node| node.attribute("stroke") == Some(color));
    let lines = strokes.flat_map(|node| {
        let width: f64 = node.attribute("stroke-width").unwrap().parse().unwrap();
        node.attribute("d").unwrap().split('M').skip(1).map(move |data| {
            let numbers = data.split(['L', ' ']).map(|number| number.parse().unwrap()).collect::<Vec<f64>>();
            [numbers[0].min(numbers[2]), numbers[0].max(numbers[2]), width]
        })
    });
    lines.collect()
}

/// The time for the pixels of a path grows with the square of its strokes.
#[test]
fn strokes_of_the_stock_are_painted_in_groups() {
    // One of the strokes belongs to the plunge.
    for (lines, paths) in [(511, 1), (512, 2)] {
        let configuration = "feed = 150\nrapid = 900\nsweep-height = 9\n";
        let place =
            Place::new().file("pathbuild.toml", configuration).file("1202.1P.dxf", drawings::chain(lines));
        let run = place.run("view 1202.1P --stock -o a.svg");
        assert_eq!(run.status, Some(0), "{run}");
        let is_through = |line: &&str| line.contains("stroke=\"#ccd6e0\"");
        assert_eq!(place.read("a.svg").lines().filter(is_through).count(), paths, "{lines}");
    }
}

/// The cutter stays above a bar over a length of P plus O, so that a length of P remains standing.
#[test]
fn bars_have_their_true_width() {
    let drawn = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 S9 F100 P3 U12 D3\"\nbars 0,0 40,0\nend 40,0";
    let place = Place::new().file("1234.1P.dxf", sheet(drawn).unwrap().to_dxf());
    let run = place.run("view 1234.1P.dxf --stock -o a.svg --rapid 900");
    let picture = place.read("a.svg");
    let scale = swept(&picture, "#ccd6e0")[0][2] / 2.0;
    let on_bar = swept(&picture, "#9f7848").into_iter().map(|[from, to, _]| (to - from) / scale);
    assert!(on_bar.into_iter().any(|length| (length - 5.0).abs() < 0.01), "{run}\n{picture}");
}

/// Bars of a ring, and those that a groove takes away, are shown where the program leaves them, however the ring's component is turned.
#[test]
fn bars_of_a_turned_ring_are_at_its_lowest_point() {
    let component = "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 D1 P3 U40 A40 MX\"\nsweep 0,0 20,0\nbars circle 20,0 d 20\nsweep 20,0 40,0\nend 40,0\n\
                     layer Part\ncircle 20,0 d 16\n";
    let groove = "layer 1300.1P\nstart 0,0 \"T2 O2 I1 B0 MX\"\nmill 0,0 4,0\nend 4,0\n";
    for (end, [x, y]) in [("0,40", [0.0, 20.0]), ("-40,0", [-20.0, 0.0])] {
        let lowest = [x, y - 9.0];
        let (from, to) = (format!("{x},{}", y - 9.2), format!("{x},{}", y - 13.2));
        let project = format!(
            "layer 8001.1P\nstart 0,0 \"T2 O2 MX\"\nsubpath 0,0 {end} \">1234.1P\"\nsweep {end} {from}\n\
             subpath {from} {to} \">1300.1P\"\nend {to}\n"
        );
        let options = "part = 'Part'\nfeed = 100\nrapid = 900\nsweep-height = 9\n";
        let drawings = [("8001.1P.dxf", &*project), ("1234.1P.dxf", component), ("1300.1P.dxf", groove)];
        let place = drawings
            .into_iter()
            .fold(Place::new(), |place, (name, drawn)| place.file(name, sheet(drawn).unwrap().to_dxf()));
        let place = place.file("pathbuild.toml", options);
        let run = place.run("view 8001.1P -o a.json");
        let scene: Value = serde_json::from_str(&place.read("a.json")).unwrap();
        let path = &scene["paths"][0];
        let ends = |bars: &Value, name: &str| {
            bars.as_array().unwrap().iter().map(|bar| bar[name].clone()).collect::<Vec<_>>()
        };
        let bars: Value = ends(&path["bars"], "shape").into();
        for bars in [&bars, &path["parts"][0]["lost_bars"]] {
            assert_eq!(
                (&ends(bars, "from")[0], &ends(bars, "to")[1]),
                (&lowest.into(), &lowest.into()),
                "{run}\n{bars}"
            );
        }
        // No cut through the plate comes near the bar.
        let through = path["moves"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|way| way["kind"] == "mill" && way["element"] == path["bars"][0]["element"]);
        let through = through.filter(|way| way["from"][2] == 0.0 && way["to"][2] == 0.0);
        let near = |at: &Value| {
            libm::hypot(at[0].as_f64().unwrap() - lowest[0], at[1].as_f64().unwrap() - lowest[1])
        };
        let nearest = through.flat_map(|way| [near(&way["from"]), near(&way["to"])]).fold(f64::MAX, f64::min);
        assert!((2.5..9.0).contains(&nearest), "{nearest}");
    }
}

#[test]
fn rapid_moves_through_material_are_red() {
    let program = |z: &str| {
        format!("G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20\nG0 Z{z}\nG0 X0 Y10\nG0 Z5\nM30\n")
    };
    let place = Place::new().file("deep.nc", program("-0.01")).file("high.nc", program("0"));
    for (file, is_through) in [("deep", true), ("high", false)] {
        let run = place.run(&format!("view {file}.nc --stock --cutter 2 --surface 0 -o {file}.svg"));
        assert_eq!(run.status, Some(i32::from(is_through)), "{run}");
        assert_eq!(place.read(&format!("{file}.svg")).contains(RAPID_THROUGH_MATERIAL), is_through, "{file}");
    }
    // Far from all cuts there is material as well.
    let program = |z: &str| {
        format!(
            "G21 G90 G17 G94\nS9000 M3\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20\nG0 Z5\nG0 X40 Y30\nG0 Z{z}\nG0 X50\nG0 Z5\nM5\nM30\n"
        )
    };
    let place = Place::new().file("deep.nc", program("-0.01")).file("high.nc", program("0"));
    for (file, is_through) in [("deep", true), ("high", false)] {
        place.run(&format!("view {file}.nc --stock --cutter 2 --surface 0 -o {file}.svg"));
        assert_eq!(place.read(&format!("{file}.svg")).contains(RAPID_THROUGH_MATERIAL), is_through, "{file}");
    }
    // A rapid move back along a cut does not hit material.
    let along = "G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20\nG0 X0\nG0 Z5\nM30\n";
    let place = Place::new().file("a.nc", along);
    place.run("view a.nc --stock --cutter 2 --surface 0 -o a.svg");
    assert!(!place.read("a.svg").contains(RAPID_THROUGH_MATERIAL));
}

/// Returns the widths of the strokes of cuts in a picture of the stock in px, from wide to narrow.
fn widths_of_cuts(picture: &str) -> Vec<f64> {
    let cuts = picture.split_once("clip-path=\"url(#stock)\"").unwrap().1.split_once("</g>").unwrap().0;
    let lines = cuts.lines().filter(|line| line.contains("stroke=\"#") && !line.contains("#4a3012"));
    let width = |line: &str| line.split_once("stroke-width=\"")?.1.split_once('"')?.0.parse().ok();
    let mut widths: Vec<f64> = lines.filter_map(width).collect();
    widths.sort_by(|one, other| other.total_cmp(one));
    widths.dedup();
    widths
}

/// A ball and a bull nose leave a round bottom. The bottom that a cutter of unknown shape leaves is unknown, which the legend says.
#[test]
fn the_stock_shows_the_section_of_the_configured_cutter() {
    let drawn = |bottom: &str| {
        let text =
            format!("layer 1234.1P\nstart 0,0 \"T5 O3 I9 B{bottom} S9 F100\"\nmill 0,0 40,0\nend 40,0");
        sheet(&text).unwrap().to_dxf()
    };
    let widths = |tool: &str, bottom: &str, view: &str| {
        let configuration = format!("rapid = 900\n[tool.a]\ndiameter = 3\n{tool}\n");
        let place = Place::new().file("pathbuild.toml", configuration).file("1234.1P.dxf", drawn(bottom));
        place.run("emit 1234.1P");
        let run = place.run(&format!("view {view} --stock -o a.svg"));
        assert_eq!(run.status, Some(0), "{run}");
        let picture = place.read("a.svg");
        (widths_of_cuts(&picture), picture.contains("cutter of unknown shape, drawn with a flat bottom"))
    };
    for view in ["1234.1P", "1234.1P_Milling.gcode"] {
        let (flat, is_unknown) = widths("", "2", view);
        assert!(flat.len() == 1 && !is_unknown, "{view}: {flat:?}");
        let scale = flat[0] / 3.0;
        let is_near = |width: f64, expected: f64| (width / scale - expected).abs() < 0.01;
        // As wide as the cutter where the cut is deeper than the radius, and narrower where it is not.
        for (bottom, expected) in [("2", 3.0), ("4.5", 2.0 * libm::sqrt(1.5 * 1.5 - 1.0))] {
            let (round, is_unknown) = widths("corner-radius = 1.5", bottom, view);
            assert!(round.len() >= 30 && is_near(round[0], expected) && !is_unknown, "{view}: {round:?}");
        }
        let (bull, _) = widths("corner-radius = 0.5", "2", view);
        assert!(is_near(bull[0], 3.0) && is_near(bull[bull.len() - 1], 2.0), "{view}: {bull:?}");
        assert_eq!(widths("shape = \"other\"", "2", view), (flat, true), "{view}");
    }
}

#[test]
fn without_cutter_or_surface_there_is_no_stock() {
    let program = "G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20\nG0 Z5\nM30\n";
    let place = Place::new().file("a.nc", program);
    for (line, said) in [
        ("view a.nc --stock --surface 0 -o a.svg", "give --cutter and --surface"),
        ("view a.nc --stock --cutter 2 -o a.svg", "give --cutter and --surface"),
        ("view a.nc --stock --cutter 0 --surface 0 -o a.svg", "PB"),
        ("view a.nc --stock --cutter 2 --surface 0 -o a.json", "the name must end in .svg, .png or .pdf"),
        ("view a.nc --stock", "--output"),
    ] {
        let run = place.run(line);
        assert!(run.status != Some(0) && run.stderr.contains(said), "{run}");
    }
    // The reason is also given beside errors; a drawing needs no options.
    let broken = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 F100\"\nmill 0,0 40,0 \"X\"\nend 40,0";
    let place = place
        .file("b.nc", format!("(a (b))\n{program}"))
        .file("1234.1P.dxf", sheet(broken).unwrap().to_dxf());
    for (what, gives_advice) in [("b.nc", true), ("1234.1P", false)] {
        let run = place.run(&format!("view {what} --stock -o b.svg"));
        assert_eq!(run.status, Some(1), "{run}");
        assert!(run.stderr.contains("nothing is cut"), "{run}");
        assert_eq!(run.stderr.contains("give --cutter"), gives_advice, "{run}");
    }
}

/// Whether a plate is cut through follows only from its thickness: it is known if the material lies on Z 0.
#[test]
fn cuts_go_through_material_that_lies_on_zero() {
    let drawn = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 F100\"\nmill 0,0 40,0\nend 40,0";
    let program = "G21 G90 G17 G94\nG0 Z9\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20\nG0 Z9\nM30\n";
    let place = Place::new().file("1234.1P.dxf", sheet(drawn).unwrap().to_dxf()).file("a.nc", program);
    place.run("emit 1234.1P --rapid 1000 --sweep-height 20");
    for (view, is_through) in [
        ("1234.1P", true),
        ("1234.1P_Milling.gcode", true),
        ("1234.1P_Milling.gcode --surface 5", true),
        ("1234.1P_Milling.gcode --surface 0", false),
        ("a.nc --cutter 2 --surface 5", true),
        ("a.nc --cutter 2 --surface 0", false),
    ] {
        let run = place.run(&format!("view {view} --stock -o a.svg"));
        assert_eq!(place.read("a.svg").contains("cut through"), is_through, "{view}: {run}");
    }
}

/// Cuts into a part are red in the picture of the stock: a slot in the middle of a part, which begins with a plunge, and the cut of a component
/// into a part that is drawn in its project.
#[test]
fn cuts_into_parts_are_red() {
    let slot = "layer 1234.1P\nstart 0,10 \"T2 O2 I1 B0 F100\"\nsweep 0,10 10,10\nmill 10,10 30,10\nsweep 30,10 50,10\nend 50,10\nlayer Part\npolyline 0,0 40,0 40,20 0,20 closed";
    let component = "layer 1111.1P\nstart 0,0 \"T2 O2 I1 B0 F100 M20x2\"\nmill 0,0 20,0\nend 20,0";
    let project = "layer 8111.1P\nstart 0,0 \"T2 O2 M20x2\"\nsweep 0,0 10,10\nsubpath 10,10 30,10 \">1111.1P\"\nsweep 30,10 50,10\nend 50,10\nlayer Part\npolyline 5,10.5 35,10.5 35,30 5,30 closed";
    let mut place = Place::new().file("pathbuild.toml", "part = 'Part'\n");
    for (name, drawn) in [("1234.1P", slot), ("1111.1P", component), ("8111.1P", project)] {
        place = place.file(&format!("{name}.dxf"), sheet(drawn).unwrap().to_dxf());
    }
    for name in ["1234.1P", "8111.1P"] {
        let run = place.run(&format!("view {name} --stock --sweep-height 9 -o {name}.svg"));
        let picture = place.read(&format!("{name}.svg"));
        assert!(picture.contains("cut into the part") && picture.contains("outline of the part"), "{run}");
        assert!(!picture.contains("NaN"), "{name}: {run}");
    }
}

/// Of the corners that turn inwards, only those that the message means are filled: of the opening, not of the outline in it.
#[test]
fn only_corners_out_of_reach_are_violet() {
    let drawn = "layer 1234.1P\nstart -5,-5 \"T2 O2 I1 B0 D1 P4 U8 F100 S5\"\nsweep -5,-5 6,6\nmill 6,6 44,6 44,44 6,44 6,6\n\
                 sweep 6,6 31,19\nbars 31,19 31,31\nbars to 19,31 19,19 31,19\nsweep 31,19 60,-5\nend 60,-5\n\
                 layer Part\npolyline 0,0 50,0 50,50 0,50 closed\npolyline 5,5 45,5 45,45 5,45 closed\n\
                 polyline 20,20 30,20 30,30 20,30 closed";
    let place = Place::new().file("pathbuild.toml", "part = 'Part'\n");
    let place = place.file("1234.1P.dxf", sheet(drawn).unwrap().to_dxf());
    let run = place.run("view 1234.1P --stock -o a.svg");
    let picture = place.read("a.svg");
    let corners = picture.split_once("-corners-0)\" fill=\"#9628c8\">").unwrap_or_else(|| panic!("{run}")).1;
    let (corners, _) = corners.split_once("</g>").unwrap();
    assert_eq!(corners.matches("<circle").count(), 4, "{corners}");
}

/// A drawing states its cutter and material itself.
#[test]
fn options_for_programs_are_refused_for_drawings() {
    let drawn = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 F100\"\nmill 0,0 40,0\nend 40,0";
    let place = Place::new().file("1234.1P.dxf", sheet(drawn).unwrap().to_dxf());
    for option in ["--cutter 2", "--surface 5", "--dialect grbl", "--ignore-feed"] {
        for what in ["1234.1P", "1234.1P.dxf"] {
            let run = place.run(&format!("view {what} --stock -o a.svg {option}"));
            assert!(run.status == Some(2) && run.stderr.contains("only for G-code programs"), "{run}");
        }
    }
    assert_eq!(place.run("view 1234.1P --stock -o a.svg").status, Some(0));
}

/// As in `verify`, an option that differs from the header is reported. The picture shows the larger cutter.
#[test]
fn a_cutter_other_than_that_of_the_header_is_a_warning() {
    let drawn = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 F100\"\nmill 0,0 40,0\nend 40,0";
    let place = Place::new().file("1234.1P.dxf", sheet(drawn).unwrap().to_dxf());
    place.run("emit 1234.1P --rapid 1000 --sweep-height 20");
    let view = |options: &str| {
        let run = place.run(&format!("view 1234.1P_Milling.gcode --stock -o a.svg {options}"));
        assert_eq!(run.status, Some(0), "{run}");
        run.stderr.matches("[PB777]").count()
    };
    assert_eq!(view(""), 0);
    assert_eq!(view("--cutter 2 --surface 5"), 0);
    assert_eq!(view("--cutter 6"), 1);
    assert_eq!(view("--surface 4"), 1);
}

#[test]
fn hostile_names_are_escaped() {
    let drawn = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 F100\"\nmill 0,0 40,0 \"Q<script>&\"\nend 40,0";
    let place = Place::new().file("a.dxf", sheet(drawn).unwrap().to_dxf());
    let run = place.run("view a.dxf -o a.svg");
    let picture = place.read("a.svg");
    let document = roxmltree::Document::parse(&picture).unwrap_or_else(|error| panic!("{error}: {run}"));
    assert!(!document.descendants().any(|node| node.has_tag_name("script")), "{picture}");
    assert!(picture.contains("&lt;script&gt;"), "{picture}");
}

#[cfg(feature = "pictures")]
#[test]
fn png_and_pdf_have_their_sizes() {
    let place = library();
    for file in ["a.png", "a.pdf", "a.html"] {
        let run = place.run(&format!("view 2050.1P -o {file}"));
        assert_eq!(run.status, Some(0), "{run}");
    }
    let png = fs::read(place.path().join("a.png")).unwrap();
    assert_eq!(&png[1..4], b"PNG");
    let size = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    assert_eq!(size(16), 2320);
    assert!(place.read("a.html").starts_with("<!doctype html>"));
    assert!(fs::read(place.path().join("a.pdf")).unwrap().starts_with(b"%PDF"));
}

#[test]
fn what_cannot_be_shown_says_so() {
    let place = Place::new().file("a.dxf", "");
    for (line, said) in [
        ("view a.dxf -o a.bmp", "the name must end in"),
        ("view ./ -o a.svg", "is a directory"),
        ("view 1.1P -o a.svg", "PB"),
    ] {
        let run = place.run(line);
        assert!(run.status != Some(0) && run.stderr.contains(said), "{run}");
    }
}

/// Returns the approximate rectangles of the texts in some layers of a picture, as left, top, right and bottom in px, with their content.
fn texts_of(svg: &str) -> Vec<([f64; 4], String)> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let layers = ["texts", "order", "ends", "probes", "embedded", "findings", "keep-outs"];
    let is_label = |node: &roxmltree::Node<'_, '_>| {
        let layer = node.ancestors().find_map(|it| it.attribute("id")).unwrap_or_default();
        node.has_tag_name("text") && layers.contains(&layer)
    };
    let label = |node: roxmltree::Node<'_, '_>| {
        let number = |name: &str| node.attribute(name).unwrap().parse::<f64>().unwrap();
        let (text, size) = (node.text().unwrap_or_default().to_owned(), number("font-size"));
        // The rectangles are narrower than the texts, so that adjoining texts do not count as overlapping.
        let width = 0.5 * size * text.chars().count() as f64;
        let left =
            if node.attribute("text-anchor").is_some() { number("x") - width / 2.0 } else { number("x") };
        ([left, number("y") - 0.6 * size, left + width, number("y")], text)
    };
    document.descendants().filter(is_label).map(label).collect()
}

/// A text of another layer is shown as a whole above the legend, if its centre is there.
#[test]
fn the_legend_does_not_cut_texts_of_other_layers() {
    let path = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 F100\"\nmill 0,0 40,0\nend 40,0\nlayer REMARKS\n";
    let text = |row: u32| format!("text 10,-{}.{} \"remark\" height 2", 4 + row / 4, row % 4 * 25);
    let texts = (0..20).map(text).collect::<Vec<_>>().join("\n");
    let place = Place::new().file("1234.1P.dxf", sheet(&format!("{path}{texts}")).unwrap().to_dxf());
    place.run("view 1234.1P -o a.svg --rapid 900 --sweep-height 9");
    let svg = place.read("a.svg");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let number =
        |node: roxmltree::Node<'_, '_>, name: &str| node.attribute(name).unwrap().parse::<f64>().unwrap();
    let mut rectangles = document.descendants().filter(|node| node.has_tag_name("rect"));
    let legend =
        rectangles.find(|node| node.attribute("width") == Some("1160") && node.has_attribute("y")).unwrap();
    let legend = number(legend, "y");
    let remarks = document.descendants().filter(|node| node.text() == Some("remark") && node.is_element());
    let rows: Vec<[f64; 2]> = remarks.map(|node| [number(node, "y"), number(node, "font-size")]).collect();
    assert_eq!(rows.len(), 20);
    let lower_edges = rows.iter().filter(|[y, _]| *y < legend).map(|[y, size]| y + size / 2.0);
    assert!(lower_edges.clone().all(|edge| edge < legend + 0.01), "{legend}: {rows:?}");
    assert!(lower_edges.filter(|edge| (edge - legend).abs() < 0.01).count() > 1, "{legend}: {rows:?}");
    assert!(rows.iter().any(|[y, _]| *y > legend), "{legend}: {rows:?}");
}

/// Texts are shown as in a CAD program: with line breaks and the characters that codes stand for.
#[test]
fn texts_are_shown_as_in_a_cad_program() {
    let path = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 F100\"\nmill 0,0 40,0 \"%%uB1%%u\"\nend 40,0\nlayer REMARKS\n";
    let texts =
        "text 10,-9 \"%%c10 %%d45 %%p0.1\" height 2\nmtext 20,-9 \"first\\Psecond^Icolumn\" height 2\n";
    let place = Place::new().file("1234.1P.dxf", sheet(&format!("{path}{texts}")).unwrap().to_dxf());
    place.run("view 1234.1P -o a.svg --rapid 900 --sweep-height 9");
    let svg = place.read("a.svg");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let line = |text: &str| {
        let found = document.descendants().find(|node| node.is_element() && node.text() == Some(text));
        let node = found.unwrap_or_else(|| panic!("no {text} in {svg}"));
        ["y", "font-size"].map(|name| node.attribute(name).unwrap().parse::<f64>().unwrap())
    };
    line("B1");
    line("\u{2300}10 \u{b0}45 \u{b1}0.1");
    let ([first, size], [second, _]) = (line("first"), line("second column"));
    assert!((second - first - size).abs() < 0.02, "{first} {second} {size}");
}

/// A picture of a program with several tools shows the width of each, and drilled holes as wide as their drill.
#[test]
fn each_tool_of_a_program_has_its_width() {
    let cut = |x: u32, y: u32, end: &str| format!("G0 X{x} Y{y}\nG1 Z-1 F100\n{end}G0 Z5\n");
    let tools = "(T1 D=6. CR=0. - FLAT END MILL)\n(T2 D=3. CR=0. - FLAT END MILL)\nG21 G90 G94 G17\n";
    let first = cut(0, 0, "G1 X40\n");
    let second = cut(0, 20, "G1 X40\n") + &cut(20, 10, "");
    let program = format!("{tools}T1 M6\nG0 Z5\n{first}T2 M6\n{second}M30\n");
    let place = Place::new().file("a.ngc", program);
    place.run("view a.ngc --dialect linuxcnc -o a.svg");
    let svg = place.read("a.svg");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let kerf = document.descendants().find(|node| node.attribute("id") == Some("kerf")).unwrap();
    let values = |name: &str| -> Vec<f64> {
        kerf.children().filter_map(|node| node.attribute(name)?.parse().ok()).collect()
    };
    let (widths, radii) = (values("stroke-width"), values("r"));
    assert!(widths.len() == 2 && (widths[0] - 2.0 * widths[1]).abs() < 0.05, "{svg}");
    assert!(radii.len() == 3 && (2.0 * radii[0] - widths[0]).abs() < 0.05, "{svg}");
    assert!(radii[1..].iter().all(|radius| (2.0 * radius - widths[1]).abs() < 0.05), "{svg}");
}

/// Numbers, start, parameters and names are legible: they do not overlap.
#[test]
fn texts_of_a_picture_are_apart() {
    let mut place = Place::new().file("pathbuild.toml", "sweep-height = 9\nfeed = 150\nrapid = 900\n");
    let everything_at_one_place = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B4 MPlate\"\nmill 0,0 3,0\nprobe 0,0 \"LA\"\nmill 3,0 40,20 \"B3\"\nmill 40,20 0,20\nend 0,20\n";
    place = place.file("own/1234.1P.dxf", sheet(everything_at_one_place).unwrap().to_dxf());
    place = place.file("own/1235.1P.dxf", sheet(&crowded()).unwrap().to_dxf());
    let mut drawings = vec!["own/1234.1P.dxf".to_owned(), "own/1235.1P.dxf".to_owned()];
    let [book, library] = ["docs/drawings", "fixtures/library"].map(|it| support::project().join(it));
    for folder in [&book, &library]
        .into_iter()
        .flat_map(|it| fs::read_dir(it).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|it| it.is_dir())
    {
        let name = folder.file_name().unwrap().to_str().unwrap();
        for file in fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
            if file.extension().is_some_and(|it| it == "dxf") {
                let drawing = format!("{name}/{}", file.file_name().unwrap().to_str().unwrap());
                place = place.file(&drawing, fs::read(&file).unwrap());
                drawings.push(drawing);
            }
        }
    }
    let mut pictures = 0;
    for drawing in &drawings {
        let seen = place.run_with(&["view", drawing, "-o", "picture.svg"]);
        assert!(seen.stderr.contains("picture.svg: written"), "{seen}");
        let texts = texts_of(&place.read("picture.svg"));
        for (number, (a, text)) in texts.iter().enumerate() {
            for (b, other) in &texts[..number] {
                let meets = a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
                assert!(!meets, "{drawing}: {text:?} over {other:?}");
            }
            assert!(a[0] >= 0.0 && a[2] <= 1160.0 && a[1] >= 0.0, "{drawing}: {text:?} is cut off");
        }
        pictures += usize::from(!texts.is_empty());
        fs::remove_file(place.path().join("picture.svg")).unwrap();
    }
    assert!(pictures > 50, "{pictures}");
}

/// Returns a drawing of short lines close together, each with its own parameters.
fn crowded() -> String {
    use std::fmt::Write;

    let mut text = "layer 1235.1P\nstart 0,0 \"T5 O0.2 I1 B4 MPlate\"\n".to_owned();
    let corner = |number: u32| {
        (
            f64::from(number / 12) * 0.8,
            f64::from([number % 12, 11 - number % 12][number as usize / 12 % 2]) * 0.8,
        )
    };
    for number in 0..119 {
        let ((x, y), (to_x, to_y)) = (corner(number), corner(number + 1));
        let (bottom, feed) = (1 + number % 3, 100 + number);
        _ = writeln!(text, "mill {x},{y} {to_x},{to_y} \"B{bottom} F{feed}\"");
    }
    let (x, y) = corner(119);
    text + &format!("end {x},{y}\n")
}

/// Even if the tool is as wide as the drawing is long, the picture is not cropped, and a drilled hole is a disc.
#[test]
fn what_the_cutter_takes_is_whole_in_a_picture() {
    let drawing = "layer 1236.1P\nstart 0,0 \"T5 O12 I1 B0 MPlate\"\nmill 0,0 30,0\nsweep 30,0 15,40\nmill circle 15,40 d 12\nsweep 15,40 30,0\nend 30,0\n";
    let place = Place::new()
        .file("pathbuild.toml", "sweep-height = 9\nfeed = 150\nrapid = 900\n")
        .file("1236.1P.dxf", sheet(drawing).unwrap().to_dxf());
    let run = place.run("view 1236.1P.dxf -o a.svg");
    assert_eq!(run.status, Some(0), "{run}");
    let svg = place.read("a.svg");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let below = |id: &str, tag: &'static str| {
        let layer = document.descendants().find(|node| node.attribute("id") == Some(id)).unwrap();
        let number =
            |node: roxmltree::Node<'_, '_>, name: &str| node.attribute(name).unwrap_or("0").parse().unwrap();
        let numbers = move |node| ["cx", "cy", "r", "stroke-width"].map(|name| number(node, name));
        layer
            .descendants()
            .filter(move |it| it.has_tag_name(tag))
            .map(move |it| (it.attribute("d").unwrap_or("").to_owned(), numbers(it)))
            .collect::<Vec<(String, [f64; 4])>>()
    };
    let (line, [.., width]) = below("kerf", "path")[0].clone();
    let numbers: Vec<f64> = line.split(['M', 'L', ' ']).filter_map(|number| number.parse().ok()).collect();
    let [left, y, right, _] = numbers[..] else { panic!("{line}") };
    assert!(left - width / 2.0 >= 0.0 && right + width / 2.0 <= 1160.0, "{line} {width}");
    // The legend's white background covers what is lower.
    let mut rectangles = document.descendants().filter(|node| node.has_tag_name("rect"));
    let background =
        rectangles.find(|node| node.attribute("width") == Some("1160") && node.has_attribute("y"));
    let bottom: f64 = background.unwrap().attribute("y").unwrap().parse().unwrap();
    assert!(y + width / 2.0 <= bottom, "{line} {width}: {bottom}");
    // The disc is as wide as the cutter, and its number is next to it.
    let [x, y, radius, _] =
        below("kerf", "circle").into_iter().map(|it| it.1).find(|it| it[2] > 5.0).unwrap();
    assert!((2.0 * radius - width).abs() < 0.02, "{radius} {width}");
    let numbers = below("order", "circle");
    assert_eq!(numbers.len(), 2);
    assert!(numbers.iter().all(|(_, [a, b, r, _])| (a - x).hypot(b - y) >= radius + r), "{numbers:?}");
}

#[test]
fn a_misspelled_drawing_gets_a_hint() {
    let place =
        Place::of("== 1234.dxf ==\nlayer 1234.1P\nstart 0,0 \"T5 O2 I5 B0\"\nmill 0,0 40,0\nend 40,0\n");
    let run = place.run("view ./1243.dxf -o picture.svg");
    assert!(run.status == Some(1) && run.stderr.contains("did you mean 1234.dxf?"), "{run}");
}
