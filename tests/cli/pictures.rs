//! Tests pictures of findings: `--report html=FILE` and `check --pictures DIR`. (book: reference/output)

use std::collections::BTreeMap;
use std::fs;

use insta::assert_snapshot;
use serde_json::Value;

use crate::support::{self, Place, dxf};

/// The drawing of a path with a gap of 1 mm.
const GAP: &str = "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 F150\"\nmill 0,0 20,0\nmill 21,0 40,0\nend 40,0\n";

fn findings(place: &Place, inputs: &str) -> Vec<Value> {
    let rows = place.run(&format!("check {inputs} --format json --no-cache")).stdout;
    let rows = rows.lines().map(|row| serde_json::from_str::<Value>(row).unwrap());
    rows.filter(|row| row["type"] == "finding" || !row["code"].is_null()).collect()
}

fn pictures(place: &Place, directory: &str) -> BTreeMap<String, String> {
    let Ok(entries) = fs::read_dir(place.path().join(directory)) else { return BTreeMap::new() };
    let read = |entry: fs::DirEntry| {
        let text = fs::read_to_string(entry.path()).unwrap();
        (entry.file_name().into_string().unwrap(), text)
    };
    entries.map(|entry| read(entry.unwrap())).collect()
}

/// Creates a place with all drawings of the folder of mistakes.
fn mistakes() -> Place {
    let folder = support::project().join("fixtures/library/mistakes");
    let mut place = Place::new().file("pathbuild.toml", "feed = 150\nsweep-height = 20\n");
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        if entry.path().extension().is_some_and(|it| it == "dxf") {
            place = place.file(entry.file_name().to_str().unwrap(), fs::read(entry.path()).unwrap());
        }
    }
    place
}

#[test]
fn every_finding_with_a_place_has_a_picture() {
    let place = mistakes();
    let found = findings(&place, ".");
    let placed = found.iter().filter(|it| !it["x"].is_null()).count();
    assert!(placed > 5, "{found:?}");
    place.run("check . --pictures seen --report html=page.html --no-cache");
    let seen = pictures(&place, "seen");
    assert_eq!(seen.len(), placed);
    let page = place.read("page.html");
    assert_eq!(page.matches("<svg ").count(), placed);
    assert_eq!(page.matches("<article").count(), found.len());
    for it in &found {
        assert!(page.contains(it["code"].as_str().unwrap()), "{it}");
    }
    // Another run, with another order of threads, gives the same names and bytes.
    place.run("check . --pictures again -j 1 --no-cache");
    assert_eq!(pictures(&place, "again"), seen);
    // Pictures of other runs are named: none in the same directory, and all of them after the finding is gone.
    assert!(!place.run("check . --pictures again --no-cache").stderr.contains("of other runs"));
    let place = place.file("again/notes-PB105-12345678.txt", "").file("again/PB105-12345678.svg", "");
    let run = place.run("check 3001.1P.dxf --pictures again --no-cache");
    let others = seen.keys().filter(|name| !name.starts_with("3001.1P-")).collect::<Vec<_>>();
    let named = format!("{} pictures of other runs in again: ", others.len());
    assert!(run.stderr.contains(&named) && run.stderr.contains(others[0].as_str()), "{run}");
    // Pictures do not depend on the directory.
    for (name, text) in seen {
        assert!(text.starts_with("<svg ") && name.contains("-PB"), "{name}");
    }
}

#[test]
fn a_gap_is_circled_with_the_nearest_open_end() {
    let place = Place::new().file("1234.1P.dxf", dxf(GAP));
    place.run("check . --pictures seen");
    let seen = pictures(&place, "seen");
    let gap = seen.iter().find(|(name, _)| name.contains("PB401")).unwrap_or_else(|| panic!("{seen:?}"));
    let finding = gap.1.split_once("id=\"finding\"").unwrap().1.split_once("</g>").unwrap().0;
    // The circles mark the finding, its centre, and the nearby end.
    assert_eq!((finding.matches("<circle").count(), finding.matches("<line").count()), (3, 1), "{finding}");
    assert_snapshot!(gap.1);
}

#[test]
fn a_text_that_is_nobodys_has_its_circle() {
    let place = Place::new().file("1234.1P.dxf", dxf(&format!("{GAP}mtext 20,12 \"B1\" height 2\n")));
    place.run("check . --pictures seen");
    let seen = pictures(&place, "seen");
    let text = seen.iter().find(|(name, _)| name.contains("PB107")).unwrap_or_else(|| panic!("{seen:?}")).1;
    let finding = text.split_once("id=\"finding\"").unwrap().1.split_once("</g>").unwrap().0;
    assert!(finding.contains("stroke-dasharray=\"3 3\"") && finding.contains("<line"), "{finding}");
    assert_snapshot!(text);
}

/// The circle encloses the wrong text, even if there is a long text beside it.
#[test]
fn a_wrong_text_stands_in_its_circle() {
    let place = mistakes();
    place.run("check 3004.1P.dxf --pictures seen");
    let seen = pictures(&place, "seen");
    let is_of = |name: &&String| name.starts_with("3004.1P-PB202");
    let picture = &seen[seen.keys().find(is_of).unwrap()];
    let value = |line: &str, name: &str| -> f64 {
        line.split_once(&format!(" {name}=\"")).unwrap().1.split_once('"').unwrap().0.parse().unwrap()
    };
    let text = picture.lines().find(|line| line.ends_with(">b0.5</text>")).unwrap();
    let circle = picture.lines().find(|line| line.contains("r=\"17\"")).unwrap();
    let (across, down) = (value(text, "x") - value(circle, "cx"), value(text, "y") - value(circle, "cy"));
    assert!(across.abs() < 1.0 && (0.0..8.0).contains(&down), "{text}\n{circle}");
}

#[test]
fn a_clamp_in_the_way_is_seen() {
    let options = "feed = 150\nrapid = 1000\nsweep-height = 20\nkeep-out = 'Clamps'\n";
    let place = mistakes().file("pathbuild.toml", options);
    place.run("check 3011.1P.dxf --pictures seen");
    let seen = pictures(&place, "seen");
    let clamp = seen.iter().find(|(name, _)| name.contains("PB407")).unwrap_or_else(|| panic!("{seen:?}"));
    assert_snapshot!(clamp.1);
}

/// A path cuts 0.5 mm into its part at the lower edge, and leaves 0.5 mm at the upper edge. Both are shown, although no program is written.
#[test]
fn cuts_into_a_part_are_shown_with_it() {
    let drawing = "layer 1234.1P\nstart 0,-9 \"T2 O2 I1 B0 S5 F150\"\nsweep 0,-9 -1,-0.5\nmill -1,-0.5 41,-0.5 41,21.5 -1,21.5 -1,-0.5\nsweep -1,-0.5 0,-9\nend 0,-9\nlayer Part\npolyline 0,0 40,0 40,20 0,20 closed\n";
    let options = "rapid = 1000\npart = 'Part'\npart-held = \"otherwise\"\n";
    let place = Place::new().file("pathbuild.toml", options).file("1234.1P.dxf", dxf(drawing));
    place.run("view 1234.1P -o scene.json");
    let scene: Value = serde_json::from_str(&place.read("scene.json")).unwrap();
    let path = &scene["paths"][0];
    assert!(path["moves"].as_array().unwrap().len() > 5, "{path}");
    assert_eq!(scene["through"], 0.001_001);
    let part = &path["parts"][0];
    assert_eq!(part["rings"][0].as_array().unwrap().len(), 4, "{part}");
    assert_eq!((&part["top"], &part["tolerance"]), (&2.0.into(), &0.02.into()));
    assert_eq!(part["left"].as_array().unwrap().len(), 1, "{part}");
    assert_eq!(part["left"][0]["reach"], 0.5);
    assert_eq!(part["left"][0]["outline"][0]["from"], serde_json::json!([39.98, 29.0]));
    assert!(place.run("emit 1234.1P").stderr.contains("PB213"));
    assert!(!place.path().join("1234.1P_Milling.gcode").exists());
}

#[test]
fn what_a_drawing_says_is_no_markup_in_pages() {
    let hostile = format!("{GAP}text 20,12 \"Q<script>alert(1)</script>&\"\n");
    // Names with `<` do not exist on Windows.
    let (name, shown) =
        if cfg!(windows) { ("x&b.dxf", "x&amp;b.dxf") } else { ("x&<b>.dxf", "x&amp;&lt;b&gt;.dxf") };
    let place = Place::new().file("1234.1P.dxf", dxf(&hostile)).file(name, dxf(GAP));
    place.run("check . --report html=page.html --pictures seen --untrusted");
    let page = place.read("page.html");
    assert!(page.contains("&lt;script&gt;") && !page.contains("<script") && !page.contains("<b>"), "{page}");
    assert!(page.contains("default-src 'none'") && page.contains(shown));
    let without_names = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!without_names.contains("http:") && !without_names.contains("https:"));
    for (name, text) in pictures(&place, "seen") {
        assert!(!name.contains(['<', '&']) && !text.contains("<script"), "{name}");
    }
}

/// The length of a file name is limited in bytes.
#[test]
fn long_names_of_drawings_are_cut_in_those_of_pictures() {
    let name = format!("{}1234.1P.dxf", "\u{20000}".repeat(56));
    let place = Place::new().file(&name, dxf(GAP)).file("1235.1P.dxf", dxf(GAP));
    let run = place.run("check . --pictures seen");
    assert!(!run.stderr.contains("PB004"), "{run}");
    let names: Vec<String> = pictures(&place, "seen").into_keys().collect();
    let beginning = "\u{20000}".repeat(20);
    assert!(names.iter().any(|name| name.starts_with(&format!("{beginning}-PB"))), "{names:?}");
    assert!(names.iter().any(|name| name.starts_with("1235.1P-PB")), "{names:?}");
}

#[test]
fn pages_are_files_for_people_in_their_language() {
    let place = Place::new().file("1234.1P.dxf", dxf(GAP));
    let run = place.run("check . --format html");
    assert!(run.status == Some(2) && run.stderr.contains("give --report html=FILE"), "{run}");
    let run = place.run("check . --report html=page.html --lang de");
    assert_eq!(run.status, Some(1), "{run}");
    let page = place.read("page.html");
    assert!(page.contains("<html lang=\"de\">") && page.contains("Fehler: "), "{page}");
    let run_file = place.run("check . --pictures 1234.1P.dxf");
    assert!(run_file.status == Some(1) && run_file.stderr.contains("[PB004]"), "{run_file}");
    // Other commands have findings too.
    place.run("emit . --report html=emitted.html");
    assert!(place.read("emitted.html").contains("PB401"));
}

/// A finding about a part shows the stock, with the wrong region filled. A deviation just inside of the tolerance is not a finding.
#[test]
fn regions_of_findings_about_a_part_are_filled() {
    let drawn = |name: &str, elements: &str, outline: &str| {
        let text = format!(
            "layer {name}\nstart 0,0 \"T2 O2 I1 B0 S5 F100\"\n{elements}\nend 30,0\nlayer Part\n{outline}\n"
        );
        dxf(&text)
    };
    let plate = |low: f64| format!("polyline 0,{low} 30,{low} 30,20 0,20 closed");
    let place = Place::new()
        .file("pathbuild.toml", "part = 'Part'\nrapid = 900\npart-held = \"otherwise\"\n")
        .file("1001.1P.dxf", drawn("1001.1P", "mill 0,0 30,0", &plate(0.5)))
        .file("1002.1P.dxf", drawn("1002.1P", "mill 0,0 30,0", &plate(1.4)))
        .file("1003.1P.dxf", drawn("1003.1P", "mill 0,0 30,0", &plate(0.985)))
        .file("1004.1P.dxf", drawn("1004.1P", "mill 0,0 30,0", &plate(1.015)));
    place.run("check . --pictures seen --no-cache");
    let seen = pictures(&place, "seen");
    let colours = |code: &str| {
        let (_, picture) = seen.iter().find(|(name, _)| name.contains(code)).unwrap();
        ["#e50d1a", "#9628c8"].map(|colour| picture.contains(&format!("stroke=\"{colour}\"")))
    };
    assert_eq!((colours("PB213"), colours("PB215")), ([true, false], [false, true]));
    assert_eq!(seen.keys().filter(|name| name.contains("-PB21")).count(), 2, "{:?}", seen.keys());
}

/// The message of a cut into the part of another path has the program's coordinates: the picture is the same wherever the project is drawn.
#[test]
fn places_in_the_program_are_marked_in_the_drawing() {
    let component = "layer 1111.1P\nstart 0,0 \"T2 O2 I1 B0 F100 M20x2\"\nmill 0,0 20,0\nend 20,0\n";
    let picture = |[x, y]: [i32; 2]| {
        let at = |right: i32, up: i32| format!("{},{}", x + right, y + up);
        let (start, from, to, end) = (at(0, 0), at(10, 10), at(30, 10), at(50, 10));
        let [a, b, c, d] = [at(5, 10), at(35, 10), at(35, 30), at(5, 30)];
        let project = format!(
            "layer 8111.1P\nstart {start} \"T2 O2 M20x2\"\nsweep {start} {from}\nsubpath {from} {to} \">1111.1P\"\nsweep {to} {end}\nend {end}\nlayer Part\npolyline {a} {b} {c} {d} closed\n"
        );
        let options = "part = 'Part'\nrapid = 900\nsweep-height = 9\n";
        let place = Place::new().file("pathbuild.toml", options);
        let place = place.file("1111.1P.dxf", dxf(component)).file("8111.1P.dxf", dxf(&project));
        let run = place.run("check 8111.1P.dxf --pictures seen --no-cache");
        let mut seen = pictures(&place, "seen").into_iter().filter(|(name, _)| name.contains("PB214"));
        seen.next().unwrap_or_else(|| panic!("{run}")).1
    };
    assert_eq!(picture([0, 0]), picture([30, -20]));
}

/// The second path of a drawing takes away the plate to which the support bars of the first lead, without touching the part. Its picture shows the
/// part, and marks where the part's outline begins.
#[test]
fn a_part_that_another_path_makes_loose_is_filled() {
    let picture = |[x, y]: [i32; 2]| {
        let at = |right: i32, up: i32| format!("{},{}", x + right, y + up);
        let [start, end, low, right, high, left] =
            [at(-5, -5), at(50, -5), at(0, 0), at(42, 0), at(42, 27), at(0, 27)];
        let [a, b, c, d] = [at(1, 1), at(41, 1), at(41, 26), at(1, 26)];
        let (from, to) = (at(-3, -2), at(45, -2));
        let drawing = format!(
            "layer 1234.1P\nstart {start} \"T2 O2 I1 B0 D1 P3 U8 F100\"\nsweep {start} {low}\nbars {low} {right}\n\
             mill {right} {high} {left} {low}\nsweep {low} {end}\nend {end}\n\
             layer 1234.2P\nstart {start} \"T2 O2 I1 B0 F100\"\nsweep {start} {from}\nmill {from} {to}\n\
             sweep {to} {end}\nend {end}\nlayer Part\npolyline {a} {b} {c} {d} closed\n"
        );
        let options = "part = 'Part'\nrapid = 900\nsweep-height = 9\n";
        let place = Place::new().file("pathbuild.toml", options).file("1234.dxf", dxf(&drawing));
        let run = place.run("check 1234.dxf --pictures seen --no-cache");
        let mut seen = pictures(&place, "seen").into_iter().filter(|(name, _)| name.contains("PB217"));
        seen.next().unwrap_or_else(|| panic!("{run}")).1
    };
    let here = picture([0, 0]);
    assert_eq!(here, picture([30, -20]));
    assert!(here.contains("fill=\"#e69f00\""), "{here}");
}

/// Returns the pictures of findings about a component whose support bar, and whose part, is cut by another component, by their codes. `shims` is the
/// H of the other component, whose cut has the given length. The last argument is the place of the project's start marker.
fn cuts_by_a_neighbour(length: i32, shims: &str, [x, y]: [i32; 2]) -> BTreeMap<String, String> {
    let folder = support::project().join("docs/drawings/part");
    let groove = format!(
        "layer 1129.1P\nstart 0,0 \"O2 T2 M20x2 I0.5 F150 B-0.2\"\nmill 0,0 0,-{length}\nend 0,-{length}\n"
    );
    let at = |right: i32, up: i32| format!("{},{}", x + right, y + up);
    let (start, right, top, end) = (at(0, 0), at(40, 0), at(13, 32), at(13, 32 - length));
    let project = format!(
        "layer 8122.1P\nstart {start} \"O2 T2 M20x2 S10\"\nsubpath {start} {right} \">1121.1P\"\n\
         sweep {right} {top}\nsubpath {top} {end} \">1129.1P{shims}\"\nend {end}\n"
    );
    let place = Place::new().file("pathbuild.toml", fs::read(folder.join("pathbuild.toml")).unwrap());
    let place = place.file("1121.1P.dxf", fs::read(folder.join("1121.1P.dxf")).unwrap());
    let place = place.file("1129.1P.dxf", dxf(&groove)).file("8122.1P.dxf", dxf(&project));
    let run = place.run("check 8122.1P --pictures seen --no-cache");
    let seen = pictures(&place, "seen").into_iter();
    let code = |name: String| name.split('-').nth(1).unwrap().to_owned();
    let seen: BTreeMap<String, String> = seen.map(|(name, picture)| (code(name), picture)).collect();
    assert!(!seen.is_empty(), "{run}");
    seen
}

#[test]
fn a_bar_of_a_neighbour_is_marked_in_the_drawing() {
    let [here, there] = [[0, 0], [30, -20]].map(|start| cuts_by_a_neighbour(5, "", start));
    assert_eq!(here["PB218"], there["PB218"]);
    // The bar is circled, so the circle is in the middle of the picture.
    assert!(here["PB218"].contains("<circle cx=\"210\" cy=\"140\" r=\"17\""), "{}", here["PB218"]);
}

/// The groove of a component on shims goes through its own plate, and part of the way into the part of the other one.
#[test]
fn a_cut_from_shims_into_a_neighbour_is_filled() {
    let picture = &cuts_by_a_neighbour(20, " H0.3", [0, 0])["PB214"];
    let inside = picture.split_once("-inside-0)\"").unwrap_or_else(|| panic!("{picture}")).1;
    assert!(inside.split("</g>").next().unwrap().contains("stroke=\"#e50d1a\""), "{picture}");
}

/// The regions are corners that the cutter does not reach, an outline without a path, and a support bar that another path of a project cuts away.
#[test]
fn regions_that_no_cut_or_another_path_makes_are_filled() {
    let folder = support::project().join("docs/drawings/part");
    let mut place = Place::new().file("pathbuild.toml", fs::read(folder.join("pathbuild.toml")).unwrap());
    for name in ["1121.1P.dxf", "1125.1P.dxf", "1127.1P.dxf"] {
        place = place.file(name, fs::read(folder.join(name)).unwrap());
    }
    let groove = "layer 1129.1P\nstart 0,0 \"O2 T2 M20x2 I0.5 F150 B-0.2\"\nmill 0,0 0,-5\nend 0,-5\n";
    let project = "layer 8122.1P\nstart 0,-6 \"O2 T2 M20x2 S10\"\nsubpath 0,-6 40,-6 \">1121.1P\"\n\
                   sweep 40,-6 13,26\nsubpath 13,26 13,21 \">1129.1P\"\nend 13,21\n";
    let place = place.file("1129.1P.dxf", dxf(groove)).file("8122.1P.dxf", dxf(project));
    let run = place.run("check . --pictures seen --no-cache");
    let seen = pictures(&place, "seen");
    let has = |drawing: &str, code: &str, attribute: &str| {
        let mut found = seen.iter().filter(|(name, _)| name.starts_with(drawing) && name.contains(code));
        found.next().is_some_and(|(_, picture)| picture.contains(attribute))
    };
    assert!(has("1125.1P", "PB216", "fill=\"#9628c8\""), "{run}");
    assert!(has("1127.1P", "PB220", "fill=\"#9628c8\""), "{run}");
    assert!(has("8122.1P", "PB218", "stroke=\"#e50d1a\""), "{run}");
    assert!(!seen.keys().any(|name| name.starts_with("1121.1P")), "{:?}", seen.keys());
}

/// A project's element embeds a whole path, and the element of a contour may be long: the damage is elsewhere. The project begins at (-6, 0), where
/// its program has X0 Y0.
#[test]
fn findings_about_parts_are_placed_at_the_damage() {
    let folder = support::project().join("docs/drawings/part");
    let mut place = Place::new();
    for name in ["pathbuild.toml", "1121.1P.dxf", "1122.1P.dxf", "1123.1P.dxf", "1126.1P.dxf", "8121.1P.dxf"]
    {
        place = place.file(name, fs::read(folder.join(name)).unwrap());
    }
    for (drawing, expected) in [
        ("1122.1P", vec![[0.223, 20.5]]),
        ("1123.1P", vec![[10.324, 20.0]]),
        ("1126.1P", vec![[13.0, 21.0]]),
        ("8121.1P", vec![[0.223, 27.0], [2.0, 26.5]]),
    ] {
        let run = place.run(&format!("view {drawing}.dxf -o {drawing}.json"));
        let scene: Value = serde_json::from_str(&place.read(&format!("{drawing}.json"))).unwrap();
        let places: Vec<[f64; 2]> = scene["findings"]
            .as_array()
            .unwrap()
            .iter()
            .map(|found| serde_json::from_value(found["at"].clone()).unwrap())
            .collect();
        assert_eq!(places.len(), expected.len(), "{run}");
        for (at, expected) in places.iter().zip(expected) {
            assert!((0..2).all(|axis| (at[axis] - expected[axis]).abs() < 1e-3), "{drawing}: {places:?}");
        }
    }
}
