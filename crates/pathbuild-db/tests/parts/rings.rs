//! Tests support bars of helical circles in turned embeddings: they stand where the program begins its circles, at the point with the least Y.

use pathbuild_diagnostic::{Diagnostic, Lang, Point};
use pathbuild_path::direction;

use crate::PartTest;

/// The distance in mm from the start of the component to the centre of its disc.
const DISTANCE: f64 = 20.0;

fn point([x, y]: [f64; 2]) -> String {
    format!("{x},{y}")
}

/// Returns the point at a distance from the centre of a disc, in a direction in degrees.
fn at([x, y]: [f64; 2], distance: f64, degrees: f64) -> [f64; 2] {
    let way = direction(degrees) * distance;
    [x + way.x, y + way.y]
}

/// Returns a component with a disc of 16 mm, held by a bar below its centre, and with other cuts that begin and end in the path's start.
fn disc(cuts: &str) -> String {
    format!(
        "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 D1 P3 U40 A40 S5 MX\"\n{cuts}sweep 0,0 20,0\nbars circle 20,0 d 20\n\
         sweep 20,0 40,0\nend 40,0\nlayer Part\ncircle 20,0 d 16\n"
    )
}

/// Returns a cut through the plate that runs outwards from the middle of the disc's ring, in a direction in degrees.
fn groove(centre: [f64; 2], degrees: f64) -> [[f64; 2]; 2] {
    [at(centre, 9.2, degrees), at(centre, 13.0, degrees)]
}

/// Returns the findings about a project that embeds the component in a direction in degrees, followed by a groove.
fn found(component: &str, turn: f64, [from, to]: [[f64; 2]; 2]) -> Vec<Diagnostic> {
    let end = point(at([0.0, 0.0], 2.0 * DISTANCE, turn));
    let (start, [from, to]) = ("0,0", [from, to].map(point));
    let project = format!(
        "layer 8001.1P\nstart {start} \"T2 O2 S5 MX\"\nsubpath {start} {end} \">1234.1P\"\n\
         sweep {end} {from}\nsubpath {from} {to} \">1300.1P\"\nend {to}\n"
    );
    let length = 3.8;
    let cut =
        format!("layer 1300.1P\nstart 0,0 \"T2 O2 I1 B0 S5 MX\"\nmill 0,0 {length},0\nend {length},0\n");
    let files = [("8001.1P.dxf", &*project), ("1234.1P.dxf", component), ("1300.1P.dxf", &*cut)];
    let mut found = PartTest::default().diagnostics(&files);
    found.retain(|found| !["PB210", "PB212"].contains(&found.code().to_string().as_str()));
    found
}

fn codes(found: &[Diagnostic]) -> Vec<String> {
    found.iter().map(|found| found.code().to_string()).collect()
}

/// A groove far from everything.
const AWAY: [[f64; 2]; 2] = [[100.0, 100.0], [103.8, 100.0]];

/// A cut takes away the bar that is in the program. Where the bar would be if it turned with the path, there is nothing to take away.
#[test]
fn cuts_take_away_the_bar_that_is_in_the_program() {
    for turn in [0.0, 90.0, 180.0, 270.0] {
        let centre = at([0.0, 0.0], DISTANCE, turn);
        let lost = found(&disc(""), turn, groove(centre, 270.0));
        assert_eq!(codes(&lost), ["PB218"], "{turn}: {lost:?}");
        assert!(!is_about_turning(&lost[0]), "a groove of another path: {lost:?}");
        let [x, y] = at(centre, 9.0, 270.0);
        let place = lost[0].arguments.iter().find(|(name, _)| *name == "point").unwrap().1.clone();
        assert_eq!(place, Point::new(x, y).into(), "{turn}");
        if turn != 0.0 {
            assert_eq!(found(&disc(""), turn, groove(centre, 270.0 + turn)), [], "{turn}");
        }
    }
}

/// The component's own groove, to the left of its disc, is below the disc if the component is turned by a right angle to the left.
#[test]
fn a_component_takes_away_its_own_bar_where_it_is_turned() {
    let [inner, outer] = groove([DISTANCE, 0.0], 180.0).map(point);
    let disc = disc(&format!("sweep 0,0 {outer}\nmill {outer} {inner}\nsweep {inner} 0,0\n"));
    for (turn, is_lost) in [(0.0, false), (90.0, true), (180.0, false), (270.0, false)] {
        let lost = found(&disc, turn, AWAY);
        assert_eq!(codes(&lost), vec!["PB218"; usize::from(is_lost)], "{turn}: {lost:?}");
        assert!(lost.iter().all(is_about_turning), "{lost:?}");
    }
}

/// Whether a finding gives the reason that the bars of a circle do not turn.
fn is_about_turning(found: &Diagnostic) -> bool {
    let help = found.help(Lang::En).unwrap_or_default();
    found.text(Lang::En).contains("turned where it is embedded")
        && help.starts_with("embed the path at another angle")
}

/// A groove behind the place of the bar joins both ends of the ring, without touching the bar.
#[test]
fn a_component_cuts_its_disc_loose_where_it_is_turned() {
    let behind = |distance: f64| {
        let x = DISTANCE - distance;
        disc(&format!("sweep 0,0 {x},-5\nmill {x},-5 {x},5\nsweep {x},5 0,0\n"))
    };
    for (turn, is_loose) in [(0.0, false), (90.0, true), (180.0, false), (270.0, false)] {
        let loose = found(&behind(10.2), turn, AWAY);
        assert_eq!(codes(&loose), vec!["PB217"; usize::from(is_loose)], "{turn}: {loose:?}");
        assert!(loose.iter().all(is_about_turning), "{loose:?}");
        assert_eq!(codes(&found(&behind(11.5), turn, AWAY)), [""; 0], "{turn}: material remains");
    }
}

/// In an opening that a ring cuts, the bar holds the waste until a groove takes away the bar that is in the program.
#[test]
fn the_bar_in_the_program_holds_the_waste_of_an_opening() {
    let frame = "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 D1 P3 U40 A40 S5 MX\"\nsweep 0,0 20,0\nbars circle 20,0 d 20\n\
                 sweep 20,0 40,0\nend 40,0\nlayer Part\npolyline 5,-15 35,-15 35,15 5,15 closed\ncircle 20,0 d 20\n";
    let is_loose = |degrees: f64| {
        let centre = [0.0, DISTANCE];
        // Along the bar, so that the groove joins both ends of the ring, and a later cut in the middle of the waste.
        let beside = at(centre, 8.7, degrees);
        let [from, to] = [-2.6, 2.6].map(|along| point(at(beside, along, degrees + 90.0)));
        let [begin, end] = [[-2.0, DISTANCE], [2.0, DISTANCE]].map(point);
        let project = format!(
            "layer 8001.1P\nstart 0,0 \"T2 O2 S5 MX\"\nsubpath 0,0 0,40 \">1234.1P\"\nsweep 0,40 {from}\n\
             subpath {from} {to} \">1300.1P\"\nsweep {to} {begin}\nsubpath {begin} {end} \">1301.1P\"\nend {end}\n"
        );
        let cut = |name: &str, length: f64| {
            format!("layer {name}\nstart 0,0 \"T2 O2 I1 B0 S5 MX\"\nmill 0,0 {length},0\nend {length},0\n")
        };
        let (across, later) = (cut("1300.1P", 5.2), cut("1301.1P", 4.0));
        let files = [
            ("8001.1P.dxf", &*project),
            ("1234.1P.dxf", frame),
            ("1300.1P.dxf", &*across),
            ("1301.1P.dxf", &*later),
        ];
        codes(&PartTest::default().diagnostics(&files)).contains(&"PB222".to_owned())
    };
    assert!(is_loose(270.0), "the bar is below the centre");
    assert!(!is_loose(0.0), "where it would be if it turned");
}
