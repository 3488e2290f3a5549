//! Tests nested embedding, rotated and raised at every level. (book: language/embedding)

use std::fmt::Write;

use crate::support::Place;
use pathbuild_testkit::{Point, sheet};

/// A component from (0, 0) to (10, 0): a ring of two half circles, with sweeps to it and back.
const COMPONENT: &str = "layer 1000.1P
start 0,0 \"T5 O2 I1 B3 MX\"
sweep 0,0 20,0
mill arc 20,0 40,0 r 10
mill arc 40,0 20,0 r 10
sweep 20,0 10,0
end 10,0
";

/// Returns a path of 10 mm that embeds the previous one, rotated by an angle and raised by a millimetre, still below S.
fn level(level: usize, degrees: f64) -> String {
    let (from, to) = (Point::new(100.0, 50.0), Point::new(100.0, 50.0).polar(10.0, degrees));
    let mut text = format!("layer {}.1P\nstart 0,0 \"T5 O2 S20 MX\"\n", 1000 + level);
    writeln!(text, "sweep 0,0 {},{}", from.x, from.y).unwrap();
    writeln!(text, "subpath {},{} {},{} \">{}.1P H1\"", from.x, from.y, to.x, to.y, 999 + level).unwrap();
    writeln!(text, "sweep {},{} 10,0\nend 10,0", to.x, to.y).unwrap();
    text
}

/// At these angles, rounding may make half circles slightly larger or smaller than half.
/// A rapid move into raised material is reported where it is drawn.
#[test]
fn a_sweep_into_raised_material_names_its_element() {
    let place = |height: &str| {
        Place::of(&format!(
            "== pathbuild.toml ==\nfeed = 150\nrapid = 1000\n== 8001.dxf ==\nlayer 8001.1P\nstart 500,500 \"O2 T2 Mx S20\"\n\
             sweep 500,500 500,510\nsubpath 500,510 560,510 \">2101.1P\"\nsweep 560,510 530,510.5\n\
             subpath 530,510.5 530,530.5 \">2001.1P H{height}\"\nsweep 530,530.5 490,490\nend 490,490\n\
             == 2101.dxf ==\nlayer 2101.1P\nstart 0,0 \"O2 T2 Mx I1\"\nmill 0,0 10,0 \"B0.5\"\nsweep 10,0 50,0\n\
             mill 50,0 60,0 \"B0.5\"\nend 60,0\n== 2001.dxf ==\nlayer 2001.1P\nstart 0,0 \"O2 T2 Mx I1\"\n\
             mill 0,0 20,0 \"B0.5\"\nend 20,0\n"
        ))
    };
    let run = place("12").run("emit 8001.1P --format json");
    assert_eq!(run.status, Some(1), "{run}");
    let found: serde_json::Value = run
        .stdout
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .find(|found: &serde_json::Value| found["code"] == "PB740")
        .unwrap();
    assert_eq!((&found["file"], &found["path"]), (&"2101.dxf".into(), &"2101.1P".into()), "{found}");
    assert_eq!((&found["x"], &found["y"]), (&10.0.into(), &0.0.into()), "{found}");
    assert_eq!(found["trace"][0]["path"], "8001.1P", "{found}");
    assert!(found["help"].as_str().unwrap().contains("an S above 14"), "{found}");
    assert_eq!(place("1.9").run("emit 8001.1P").status, Some(0));
}

/// Two grooves that cross, one of them in a sheet that lies 3 mm higher: the other one would be milled through that sheet, whichever comes first.
#[test]
fn what_is_milled_through_raised_material_names_its_element() {
    let emit = |first: &str, second: &str| {
        let place = Place::of(&format!(
            "== pathbuild.toml ==\nfeed = 150\nrapid = 1000\n== 8001.dxf ==\nlayer 8001.1P\nstart 0,0 \"O2 T2 Mx S20\"\n\
             sweep 0,0 10,10\nsubpath 10,10 30,10 \"{first}\"\nsweep 30,10 20,10\nsubpath 20,10 20,50 \"{second}\"\n\
             end 20,50\n== 2001.dxf ==\nlayer 2001.1P\nstart 0,0 \"O2 T2 Mx I1\"\nmill 0,0 20,0 \"B0.5\"\nend 20,0\n\
             == 2002.dxf ==\nlayer 2002.1P\nstart 0,0 \"O2 T2 Mx I1\"\nmill 0,0 40,0 \"B0.5\"\nend 40,0\n",
        ));
        let run = place.run("emit 8001.1P --format concise");
        let found = run.stderr.lines().filter_map(|line| Some(line.split_once("[PB")?.1.to_owned()));
        (run.status, found.collect::<Vec<_>>())
    };
    let plunge = emit(">2001.1P H3", ">2002.1P");
    assert!(plunge.1[0].starts_with("741] the rapid move down to Z 2 at this element"), "{plunge:?}");
    let cut = emit(">2001.1P", ">2002.1P H3");
    assert!(
        cut.1[0].starts_with("793] this cut at Z 1 goes through material that still reaches up to Z 5"),
        "{cut:?}"
    );
    assert_eq!((plunge.0, plunge.1.len(), cut.0, cut.1.len()), (Some(1), 1, Some(0), 1));
}

#[test]
fn half_circles_are_milled_however_they_are_turned() {
    let place = Place::new().file("pathbuild.toml", "feed = 150\nrapid = 1000\nsweep-height = 20\n");
    let place = place.file("1000.1.dxf", sheet(COMPONENT).unwrap().to_dxf());
    let angles = [2.8, 33.3, 90.0, 123.456, 271.0, 7.77, 301.2, 45.0];
    let place = (1..).zip(angles).fold(place, |place, (number, degrees)| {
        let drawing = sheet(&level(number, degrees)).unwrap().to_dxf();
        place.file(&format!("{}.1.dxf", 1000 + number), drawing)
    });
    for number in 1..=8 {
        let run = place.run(&format!("emit {}.1P --no-cache", 1000 + number));
        assert_eq!(run.status, Some(0), "{run}");
        let program = place.read(&format!("{}.1_Milling.gcode", 1000 + number));
        let arcs: Vec<&str> = program.lines().filter(|line| line.starts_with("G03 ")).collect();
        assert_eq!(arcs.len(), 4, "{program}");
        let lowest = format!("Z{}.000", 3 + number);
        assert_eq!(
            arcs.iter().filter(|arc| arc.ends_with(&lowest)).count(),
            2,
            "raised at every level: {program}"
        );
    }
}
