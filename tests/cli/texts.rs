//! Tests `texts`, which prints a table of the effective parameters of each element, and their origins.

use serde_json::Value as Json;

use crate::support::Place;

/// A path with a chain, a helical circle, a sweep with its own S, a subpath and a probe, and a second path.
const DRAWING: &str = "layer 1234.1P\nstart 0,0 \"T5 O2 B0 F150 M20x2\"\nmill 0,0 20,0 \"I1 B0,5\"\n\
    mill 20,0 40,0\nsweep 40,0 60,0 \"S12\"\nmill circle 60,0 d 6 \"I2\"\nsweep 60,0 80,0\nsubpath 80,0 100,0 \">1234.2P\"\n\
    probe 10,10 \"H1\"\nend 100,0\n\
    layer 1234.2P\nstart 0,50 \"@1234.1P\"\nmill 0,50 20,50 \"I1\"\nend 20,50\n";

fn place(configuration: &str) -> Place {
    let drawing = pathbuild_testkit::sheet(DRAWING).unwrap_or_else(|faults| panic!("{faults:?}"));
    Place::new().file("1234.dxf", drawing.to_dxf()).file("pathbuild.toml", configuration)
}

/// The origin of a value, an option or a line of the configuration, is stated in both languages, in the terminal and on the page.
#[test]
fn a_value_says_whether_an_option_or_the_configuration_gives_it() {
    let place = place("rapid = 1000\nsweep-height = 20\n");
    let run = |lang: &str| place.run(&format!("texts 1234.dxf --probe-feed 40 --lang {lang}")).stdout;
    let (en, de) = (run("en"), run("de"));
    for (shown, source) in [
        (&en, "option --probe-feed"),
        (&en, "`sweep-height` in pathbuild.toml, line 2"),
        (&de, "Option --probe-feed"),
        (&de, "`sweep-height` in pathbuild.toml, Zeile 2"),
    ] {
        assert!(shown.lines().any(|line| line.ends_with(&format!(" {source}"))), "{source} in {shown}");
    }
    place.run("view 1234.1P --probe-feed 40 -o scene.json");
    let scene: Json = serde_json::from_str(&place.read("scene.json")).unwrap();
    let elements = scene["paths"][0]["elements"].as_array().unwrap().iter();
    let parameters = elements.flat_map(|element| element["parameters"].as_array().into_iter().flatten());
    let lines: Vec<_> = parameters
        .filter(|parameter| parameter["from"] == "option")
        .map(|parameter| (parameter["which"].as_str().unwrap(), parameter["line"].as_u64()))
        .collect();
    assert!(lines.contains(&("sweep-height", Some(2))) && lines.contains(&("probe-feed", None)), "{lines:?}");
}

/// Returns the effective parameters of the element at a position: letter, value and origin.
fn in_force(place: &Place, at: [f64; 2], element: &str) -> Vec<String> {
    let run = place.run("texts 1234.dxf --format json");
    assert_eq!(run.status, Some(0), "{run}");
    let objects = run.stdout.lines().map(|line| serde_json::from_str::<Json>(line).unwrap());
    let is_it = |it: &Json| [&it["x"], &it["y"]] == at && it["element"] == element;
    let found = objects.into_iter().find(is_it).unwrap_or_else(|| panic!("no {element} at {at:?} in {run}"));
    let parameters = found["parameters"].as_array().unwrap().iter();
    let text = |it: &Json| it.as_str().unwrap_or_default().to_owned();
    let said = |it: &Json| {
        let which = it["which"].as_str().map(|which| format!(" {which}")).unwrap_or_default();
        format!("{}{} {}{which}", text(&it["letter"]), text(&it["value"]), text(&it["from"]))
    };
    parameters.map(said).collect()
}

#[test]
fn each_parameter_says_where_it_comes_from() {
    let place = place("feed = 99\nsweep-height = 20\nprobe-feed = 40\n");
    let segment = "a milling segment";
    let of_path = ["M20x2 path", "O2 path", "T5 path"];
    assert_eq!(
        in_force(&place, [0.0, 0.0], segment),
        [&["B0.5 own", "F150 path", "I1 own"], &of_path[..]].concat()
    );
    // I of a chain comes from its first segment, and B from each segment.
    assert_eq!(
        in_force(&place, [20.0, 0.0], segment),
        [&["B0 path", "F150 path", "I1 chain"], &of_path[..]].concat()
    );
    assert_eq!(in_force(&place, [40.0, 0.0], "a sweep"), [&of_path[..2], &["S12 own", "T5 path"]].concat());
    let circle = in_force(&place, [60.0, 0.0], "a helical circle");
    assert_eq!(
        circle,
        [
            "A8 default",
            "B0 path",
            "F150 path",
            "I2 own",
            "M20x2 path",
            "O2 path",
            "S20 option sweep-height",
            "T5 path"
        ]
    );
    let subpath = in_force(&place, [80.0, 0.0], "a subpath");
    assert_eq!(subpath, ["H0 default", "M20x2 path", "O2 path", "T5 path", ">1234.2P own"]);
    let probe = in_force(&place, [10.0, 10.0], "a Z-probe");
    assert!(
        probe.contains(&"H1 own".to_owned()) && probe.contains(&"Z40 option probe-feed".to_owned()),
        "{probe:?}"
    );
    let borrowed = in_force(&place, [0.0, 50.0], segment);
    assert_eq!(borrowed[..3], ["B0 lender 1234.1P", "F150 lender 1234.1P", "I1 own"]);
}

#[test]
fn without_options_defaults_hold() {
    let place = place("");
    let circle = in_force(&place, [60.0, 0.0], "a helical circle");
    assert!(circle.contains(&"S7 default".to_owned()), "{circle:?}");
    let probe = in_force(&place, [10.0, 10.0], "a Z-probe");
    assert!(probe.contains(&"Z150 path".to_owned()), "{probe:?}");
}

/// A drawing has the same feeds as its program: with --compatible, probes do not use the path's F.
#[test]
fn probing_feeds_are_those_of_the_program() {
    let feed = |configuration: &str| in_force(&place(configuration), [10.0, 10.0], "a Z-probe").pop();
    assert_eq!(feed("feed = 99\n").as_deref(), Some("Z150 path"));
    assert_eq!(feed("feed = 99\ncompatible = true\n").as_deref(), Some("Z99 option feed"));
    assert_eq!(
        feed("feed = 99\nprobe-feed = 40\ncompatible = true\n").as_deref(),
        Some("Z40 option probe-feed")
    );
}

#[test]
fn the_table_is_for_people_in_both_languages() {
    let place = place("");
    let run = place.run("texts 1234.dxf");
    assert!(run.stdout.contains("1234.dxf: parameters of path 1234.2P"), "{run}");
    assert!(run.stdout.contains("    I 1            first segment of the chain\n"), "{run}");
    assert!(run.stdout.contains("    F 150          text of the path that @ names: 1234.1P\n"), "{run}");
    let run = place.run("texts 1234.dxf --lang de");
    assert!(run.stdout.contains("    A 8            Vorgabe\n"), "{run}");
    // A search for a text shows only that text.
    let run = place.run("texts 1234.dxf --match S12");
    assert!(run.stdout.contains("S12") && !run.stdout.contains("parameters of path"), "{run}");
}
