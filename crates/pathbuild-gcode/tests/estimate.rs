//! Tests estimated times against the laws of motion.

use pathbuild_gcode::dialect::Dialect::Native;
use pathbuild_gcode::estimate::{Kinematics, seconds};
use pathbuild_gcode::interpret::{Options, interpret};

/// A machine whose X and Y axes reach 6000 mm/min, which is 100 mm/s.
const MACHINE: Kinematics = Kinematics {
    rates: [6000.0, 6000.0, 600.0],
    accelerations: [100.0, 100.0, 20.0],
    junction_deviation: 0.0,
};

fn time(program: &str, machine: &Kinematics) -> f64 {
    let text = format!("G17 G21 G90 G94\n{program}\nM30\n");
    seconds(&interpret(text.as_bytes(), Native, &Options::default()).steps, machine)
}

#[track_caller]
fn takes(program: &str, machine: &Kinematics, expected: f64) {
    let found = time(&format!("G0 X0 Y0 Z0\n{program}"), machine);
    assert!((found - expected).abs() < 1e-9, "{found}, not {expected}");
}

#[test]
fn a_long_way_is_ramps_and_a_stretch_at_full_speed() {
    // The tool accelerates to 100 mm/s in 1 s over 50 mm, travels 100 mm at full speed, then decelerates.
    takes("G0 X200", &MACHINE, 3.0);
    takes("G1 F6000 X200", &MACHINE, 3.0);
}

#[test]
fn a_short_way_never_reaches_its_speed() {
    // At 100 mm/s², the tool reaches the middle at 25 mm after sqrt(2 * 25 / 100) s, and takes the same time to the end.
    takes("G0 X50", &MACHINE, 2.0 * libm::sqrt(0.5));
}

#[test]
fn a_slow_feed_takes_nearly_its_length() {
    // The tool reaches 1 mm/s in 10 ms over 5 µm.
    takes("G1 F60 X10", &MACHINE, 0.02 + (10.0 - 0.01));
}

#[test]
fn the_weakest_axis_decides() {
    // Z alone reaches 10 mm/s in 0.5 s over 2.5 mm.
    takes("G0 Z10", &MACHINE, 1.0 + 0.5);
    // At 45 degrees both X and Y move at 100 mm/s.
    takes("G0 X200 Y200", &MACHINE, 3.0);
    takes("G0 X10 Z10", &MACHINE, 1.0 + 0.5);
}

#[test]
fn a_straight_way_in_pieces_is_one() {
    let whole = time("G0 X0 Y0 Z0\nG1 F6000 X200", &MACHINE);
    let pieces: Vec<String> = (1..=200).map(|x| format!("X{x}")).collect();
    let pieces = time(&format!("G0 X0 Y0 Z0\nG1 F6000 X0.5\n{}", pieces.join("\n")), &MACHINE);
    assert!((whole - pieces).abs() < 1e-6, "{whole} {pieces}");
}

#[test]
fn corners_are_taken_as_fast_as_the_deviation_allows() {
    let corner = "G1 F6000 X200\nY200";
    takes(corner, &MACHINE, 6.0);
    let soft = Kinematics { junction_deviation: 0.01, ..MACHINE };
    // GRBL's formula is v² = a d sin(θ/2) / (1 - sin(θ/2)), where θ is the angle between the moves.
    let half_sine = libm::sqrt(0.5);
    let corner_speed = libm::sqrt(100.0 * 0.01 * half_sine / (1.0 - half_sine));
    let saved_each = {
        let ramp = (100.0 - corner_speed) / 100.0;
        let ramp_length = f64::midpoint(100.0, corner_speed) * ramp;
        3.0 - (1.0 + ramp + (150.0 - ramp_length) / 100.0)
    };
    takes(corner, &soft, 6.0 - 2.0 * saved_each);
    // A reversal requires a full stop.
    takes("G1 F6000 X200\nX0", &soft, 6.0);
}

#[test]
fn a_small_circle_is_not_taken_at_full_speed() {
    // At a radius of 1 mm, the speed is limited to sqrt(100 * 1) = 10 mm/s.
    let circumference = 2.0 * std::f64::consts::PI;
    takes("G2 F6000 X0 Y0 I1", &MACHINE, 0.2 + (circumference - 1.0) / 10.0);
    let large = time("G0 X0 Y0 Z0\nG2 F6000 X0 Y0 I200", &MACHINE);
    assert!((large - (2.0 + (200.0 * circumference - 100.0) / 100.0)).abs() < 1e-9, "{large}");
}

#[test]
fn dwells_add_and_stop_the_tool() {
    takes("G1 F6000 X100\nG4 P2.5\nX200", &MACHINE, 2.0 + 2.5 + 2.0);
}

#[test]
fn more_acceleration_and_faster_corners_never_take_longer() {
    let program = "G0 X0 Y0 Z5\nG1 F3000 X10 Y3\nX20 Y-4\nG3 X30 Y-4 I5\nG1 Z0\nX0 Y0";
    let mut last = f64::INFINITY;
    for deviation in [0.0, 0.001, 0.01, 0.1, 1.0] {
        let found = time(program, &Kinematics { junction_deviation: deviation, ..MACHINE });
        assert!(found <= last, "{deviation}: {found} {last}");
        last = found;
    }
    let stronger = Kinematics { accelerations: [1000.0; 3], junction_deviation: 1.0, ..MACHINE };
    assert!(time(program, &stronger) < last);
}

#[test]
fn nothing_takes_no_time() {
    assert_eq!(time("", &MACHINE), 0.0);
    assert_eq!(time("G0 X0 Y0\nG0 X0 Y0", &MACHINE), 0.0);
}
