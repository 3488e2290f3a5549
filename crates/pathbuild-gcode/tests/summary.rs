//! Tests summaries, including the two XpertMILL examples of the vendor, which describe the same program in two notations.

mod common;

use pathbuild_gcode::dialect::Dialect::{self, LinuxCnc, Native, Xpertmill};
use pathbuild_gcode::interpret::{Interpretation, Options, interpret};
use pathbuild_gcode::statistics::{Summary, is_guess};
use pathbuild_motion::{Action, Pace};

fn read(text: &str, dialect: Dialect) -> Interpretation {
    interpret(text.as_bytes(), dialect, &Options::default())
}

fn summary(text: &str) -> Summary {
    Summary::of(&read(&format!("G17 G21 G90 G94\n{text}\nM30\n"), Native).steps, false)
}

#[test]
fn moves_are_counted_by_what_they_do() {
    let it = summary("G0 X0 Y0 Z10\nG0 Z5\nG1 F60 Z1\nG1 F120 X20\nG2 X20 Y0 I-5\nG1 Z1\nG38.3 Z0 F40");
    let total = it.total;
    let counts = [total.rapid.moves, total.drilling.moves, total.milling.moves, total.probing, total.arcs];
    assert_eq!(counts, [2, 1, 2, 1, 1]);
    let circle = 10.0 * std::f64::consts::PI;
    assert!((total.milling.total.length - (20.0 + circle)).abs() < 1e-9);
    assert!((total.cutting().time - (4.0 / 60.0 + (20.0 + circle) / 120.0)).abs() < 1e-9);
    assert!((total.sum(500.0).time - total.cutting().time - 5.0 / 500.0).abs() < 1e-9);
}

#[test]
fn the_box_is_that_of_all_moves_and_of_those_that_cut() {
    let it = summary("G0 X-3 Y0 Z10\nG0 X10 Y0\nG1 F60 Z1\nG2 X10 Y0 I-10\nG0 Z10\nG0 X50");
    assert_eq!(it.extent, [Some((-10.0, 50.0)), Some((-10.0, 10.0)), Some((1.0, 10.0))]);
    assert_eq!(it.cut, [Some((-10.0, 10.0)), Some((-10.0, 10.0)), Some((1.0, 10.0))]);
    assert_eq!(summary("G0 Z1").extent, [None, None, Some((1.0, 1.0))]);
}

#[test]
fn tools_come_in_order_of_use() {
    let text =
        "G21 G17 G90 G94\nT2 M6\nM3 S1000\nG0 X0 Y0 Z1\nG1 X1 F60\nT1 M6\nM3 S2000\nG1 X2 F70\nX3 F60\nM30\n";
    let it = Summary::of(&read(text, LinuxCnc).steps, false);
    let used: Vec<_> = it.tools.iter().map(|it| (it.tool, &*it.speeds, &*it.feeds)).collect();
    assert_eq!(used, [(Some(2), &[1000.0][..], &[60.0][..]), (Some(1), &[2000.0], &[70.0, 60.0])]);
    assert_eq!((it.tool_changes, it.stops), (2, 0));
}

#[test]
fn what_was_taken_for_granted_is_told_apart_from_what_is_wrong() {
    let guessed = |text: &str| read(text, LinuxCnc).problems.iter().filter(|it| is_guess(it)).count();
    assert_eq!(guessed("G0 X1\nM30\n"), 2);
    assert_eq!(guessed("G21 G90\nG0 X1\nM30\n"), 0);
}

/// Reads the two columns of the listing in the vendor's reference.
#[expect(clippy::disallowed_methods, reason = "foreign data lies beside the project")]
fn vendor_examples() -> Option<[String; 2]> {
    let file = pathbuild_testkit::shared("reference/cad6_xpertmill_gcode.md")?;
    let text = std::fs::read_to_string(file).expect("a test's own file can be read");
    let (_, section) = text.split_once("### 3.3 Clean example files").expect("the section");
    let listing = section.split("```").nth(1).expect("a listing").trim_start_matches('\n');
    let width = listing.lines().next().and_then(|line| line.rfind("//")).expect("two columns");
    let column = |range: fn(&str, usize) -> &str| {
        listing.lines().map(|line| range(line, width).trim_end()).collect::<Vec<_>>().join("\n")
    };
    Some([column(|line, width| &line[..width]), column(|line, width| &line[width..])])
}

/// A cutting move: layer, speed, start, end, feed.
type Cut = (u32, f64, [f64; 3], [f64; 3], f64);

fn cuts(read: &Interpretation) -> Vec<Cut> {
    let (mut layer, mut speed) = (1, 0.0);
    let mut cuts = Vec::new();
    for step in &read.steps {
        match &step.action {
            Action::ChangeTool(number) => (layer, speed) = (number.unwrap_or(0), 0.0),
            Action::Spindle(spindle) => speed = spindle.speed.unwrap_or_default(),
            Action::Move(it) => {
                if let Pace::Feed(feed) = it.pace {
                    cuts.push((layer, speed, it.from.at, it.to.at, feed));
                }
            }
            _ => {}
        }
    }
    cuts
}

#[test]
fn both_of_the_vendors_examples_are_read_to_the_listed_result() {
    let Some(examples) = vendor_examples() else { return };
    let expected: [Cut; 4] = [
        (1, 30000.0, [-1.8, -1.8, 0.0], [-1.8, -1.8, -2.851], 500.0),
        (1, 30000.0, [-1.8, -1.8, -2.851], [12.6, -1.8, -2.851], 1000.0),
        (1, 30000.0, [12.6, -1.8, -2.851], [12.6, -1.2, -2.851], 1000.0),
        (5, 20000.0, [2.0, -1.2, -5.25], [8.5, 2.5, -6.0], 1200.0),
    ];
    for text in examples {
        let read = read(&text, Xpertmill);
        assert!(read.problems.is_empty(), "{}", common::spelled_out(&read.problems));
        assert_eq!(cuts(&read), expected, "{text}");
        let it = Summary::of(&read.steps, true);
        let layers: Vec<_> = it.tools.iter().map(|it| (it.tool, &*it.speeds, it.tally.moves())).collect();
        assert_eq!(layers, [(Some(1), &[30000.0][..], 4), (Some(5), &[20000.0], 2)]);
    }
}
