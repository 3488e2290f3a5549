//! Tests support bars. ("Support bars")

use crate::support::{COMPATIBLE, estimate, moves, path, program_with, shown};

/// A line of 40 mm with these parameters has four bars of 2 mm: 2.5 mm on a bar, 1 mm down, 3 mm between, 1 mm up, 5 mm on a bar, and so on.
const FOUR: &str = "T5 O3 D2 B0 P2 U8";

/// Returns the points along a line of 40 mm, up to the first repetition.
fn milled(parameters: &str) -> Vec<String> {
    moves(&path(parameters, "bars 0,0 40,0\nend 40,0"))
}

const SECTIONS: [&str; 17] = [
    "M 2.5,0 2",
    "M 3.5,0 0",
    "M 6.5,0 0",
    "M 7.5,0 2",
    "M 12.5,0 2",
    "M 13.5,0 0",
    "M 16.5,0 0",
    "M 17.5,0 2",
    "M 22.5,0 2",
    "M 23.5,0 0",
    "M 26.5,0 0",
    "M 27.5,0 2",
    "M 32.5,0 2",
    "M 33.5,0 0",
    "M 36.5,0 0",
    "M 37.5,0 2",
    "M 40,0 2",
];

#[test]
fn gaps_and_bars_follow_each_other() {
    let milled = milled(&format!("{FOUR} I5"));
    assert_eq!(milled[..2], ["L 5", "D 2"]);
    assert_eq!(milled[2..19], SECTIONS);
    assert_eq!(milled[19..], ["L 10"]);
}

/// Each of six passes has the moves in [`SECTIONS`] and a move down.
#[test]
fn moves_over_bars_are_estimated() {
    assert_eq!(estimate(&path(&format!("{FOUR} I1"), "bars 0,0 40,0\nend 40,0")), 6 * (17 + 1));
}

#[test]
fn bars_matter_only_below_their_top() {
    let milled = milled(&format!("{FOUR} I1"));
    assert_eq!(milled[..7], ["L 5", "D 4", "M 40,0 4", "D 3", "M 0,0 3", "D 2", "M 40,0 2"]);
    // The next pass is milled backwards. It also begins with a bar, at the height of the tool.
    assert_eq!(milled[7..11], ["M 37.5,0 2", "M 36.5,0 1", "M 33.5,0 1", "M 32.5,0 2"]);
    let last = milled.len();
    assert_eq!(milled[last - 5..], ["M 33.5,0 0", "M 36.5,0 0", "M 37.5,0 2", "M 40,0 2", "L 10"]);
}

#[test]
fn the_number_of_bars_is_what_has_room() {
    let gaps = |length: &str, parameters: &str| {
        let drawing =
            path(&format!("T5 O3 D2 B0 I5 {parameters}"), &format!("bars 0,0 {length},0\nend {length},0"));
        moves(&drawing).iter().filter(|step| step.ends_with(" 0")).count() / 2
    };
    assert_eq!(gaps("40", "P2 U8"), 4);
    assert_eq!(gaps("39.99997", "P2 U8"), 4, "rounded");
    assert_eq!(gaps("39.9999", "P2 U8"), 3);
    assert_eq!(gaps("40", "P2 U38"), 1);
    assert_eq!(gaps("40", "P2 U38.001"), 0);
}

/// The length of a line that is not parallel to an axis is a multiple of U + P only up to rounding. With U = O, bars leave exactly room for the
/// cutter.
#[test]
fn the_number_of_bars_does_not_depend_on_the_direction() {
    for (length, parameters, expected) in [(30.0, "P2 U8", 3), (10.0, "P2 U8", 1), (25.0, "P2 U3", 5)] {
        for step in 0..200 {
            let (sin, cos) = libm::sincos(f64::from(step) * 0.0314);
            let end = format!("{},{}", length * cos, length * sin);
            let drawing =
                path(&format!("T5 O3 D2 B0 I5 {parameters}"), &format!("bars 0,0 {end}\nend {end}"));
            let milled = moves(&drawing);
            let downs = milled.windows(2).filter(|pair| pair[0].ends_with(" 2") && pair[1].ends_with(" 0"));
            assert_eq!(downs.count(), expected, "{length} mm, step {step}: {milled:?}");
        }
    }
}

/// Without gaps, the segment remains at the height of the bars.
#[test]
fn without_room_for_a_gap_nothing_below_d_is_milled() {
    assert_eq!(
        milled("T5 O3 D2 B0 P50 U50 I2"),
        ["L 5", "D 3", "M 40,0 3", "D 2", "M 0,0 2", "M 40,0 2", "L 10"]
    );
}

/// A slope is at most as long as half a bar, and is limited by the distance between the bars.
#[test]
fn slopes_are_as_long_as_there_is_room() {
    let slope = |parameters: &str| {
        let milled = milled(&format!("T5 O3 I5 {parameters}"));
        (milled[2].clone(), milled[3].clone())
    };
    let step = |text: &str| text.to_owned();
    // The slope is at 45 degrees, so its length is D - B.
    assert_eq!(slope("D0.5 B0 P2 U8"), (step("M 2.5,0 0.5"), step("M 3,0 0")));
    // The length of the slope is P / 2.
    assert_eq!(slope("D3 B0 P2 U8"), (step("M 2.5,0 3"), step("M 3.5,0 0")));
    // The length of the slope is (L / n - P - O) / 2, for six bars of 3 mm with 3.667 mm between them.
    assert_eq!(slope("D3 B0 P3 U3.6"), (step("M 3,0 3"), step("M 3.333,0 0")));
}

/// The cutter just fits between the bars, so there are no slopes, and no move at the bottom.
#[test]
fn bars_may_be_a_cutters_diameter_apart() {
    let milled = milled("T5 O3 I5 D2 B0 P2 U3");
    assert_eq!(milled[..5], ["L 5", "D 2", "M 2.5,0 2", "M 2.5,0 0", "M 2.5,0 0"]);
}

#[test]
fn bars_stand_on_arcs_too() {
    // A half circle of 31.416 mm has three bars, one every 60 degrees.
    let arc = moves(&path("T5 O3 I5 D2 B0 P2 U8", "bars arc centre 10,0 r 10 from 180 to 0\nend 20,0"));
    assert_eq!(arc[..3], ["L 5", "D 2", "A 0.311,-2.474 2"]);
    assert_eq!(arc.iter().filter(|step| step.starts_with('A')).count(), 13);
    assert_eq!(arc[arc.len() - 2..], ["A 20,0 2", "L 10"]);
}

/// Three decimals cannot tell an arc of almost no length from a full turn. Between two slopes, the tool stays where it is.
#[test]
fn slopes_of_almost_no_length_are_lines() {
    // On an arc of 20 mm radius, three gaps that are wider than the cutter by `room`.
    let slopes = |room: f64| {
        let degrees = (3.0 * (4.0 + room) / 20.0_f64).to_degrees();
        let [sin, cos] = [libm::sin, libm::cos].map(|of| 20.0 * of(degrees.to_radians()));
        let statements = format!("bars arc centre -20,0 r 20 from 0 to {degrees}\nend {},{sin}", cos - 20.0);
        let moves = moves(&path("T4 O2 I5 D3.15 B0 P2 U2", &statements));
        moves
            .into_iter()
            .filter(|step| step.ends_with(" 0"))
            .map(|step| step[..1].to_owned())
            .collect::<String>()
    };
    assert_eq!(slopes(0.000_000_1), "MAMAMA");
    assert_eq!(slopes(0.001_9), "MAMAMA");
    assert_eq!(slopes(0.002_1), "AAAAAA");
    assert_eq!(slopes(0.02), "AAAAAA");
}

/// Bars are calculated in the path's own drawing and raised together with it.
#[test]
fn bars_are_raised_by_h() {
    let drawing = format!(
        "layer 8001.1P\nstart 0,0 \"T9 O3 S20\"\nsubpath 0,0 40,0 \">1234.1P T5 H1\"\nend 40,0\n{}",
        path(&format!("{FOUR} I5"), "bars 0,0 40,0\nend 40,0")
    );
    assert_eq!(moves(&drawing)[..6], ["L 6", "D 3", "M 2.5,0 3", "M 3.5,0 1", "M 6.5,0 1", "M 7.5,0 3"]);
}

#[test]
fn the_original_tool_drills_into_the_bar_where_a_segment_begins() {
    let drawing = path(&format!("{FOUR} I5"), "bars 0,0 40,0\nend 40,0");
    let compatible = shown(&program_with(&drawing, COMPATIBLE), false);
    assert_eq!(compatible[..3], ["L 5", "D 0", "L 2"]);
    assert_eq!(compatible[3..20], SECTIONS);
    let drawing = path("T5 O3 D2 B0 P2 U38 I5 W5", "bars 0,0 40,0\nend 40,0");
    let sweepless = shown(&program_with(&drawing, COMPATIBLE), false);
    assert_eq!(sweepless[3..6], ["D 0", "L 2", "M 2.5,0 2"]);
}

/// Sweepless passes also begin and end with a bar.
#[test]
fn sweepless_runs_spare_bars() {
    let drawing = path("T5 O3 D2 B0 P2 U38 I5 W5", "bars 0,0 40,0\nend 40,0");
    assert_eq!(
        moves(&drawing),
        [
            "L 5",
            "M 40,0 5",
            "M 0,0 5",
            "D 2",
            "M 2.5,0 2",
            "M 3.5,0 0",
            "M 36.5,0 0",
            "M 37.5,0 2",
            "M 40,0 2"
        ]
    );
}
