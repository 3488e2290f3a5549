//! Tests how heights between probes are calculated, where moves are corrected, and how they are split for that. (book: language/probes)
#![allow(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot set up its files has failed"
)]

use pathbuild_diagnostic::Lang;
use pathbuild_gcode::dialect::Charset;
use pathbuild_gcode::native::{self, WriteOptions};
use pathbuild_gcode::statistics::statistics;
use pathbuild_toolpath::{
    Correction, Count, Height, MoveClass, PlannedMove, ProbePoint, Program, ProgramStep, Surface, Xy, ZModel,
};

const TIN: Correction = Correction { model: ZModel::Tin, longest: 20.0 };

fn places(points: &[(f64, f64)]) -> Vec<Xy> {
    points.iter().map(|(x, y)| Xy::new(*x, *y)).collect()
}

/// Returns nine probes on a plate of 300 mm x 200 mm.
fn grid() -> Vec<(f64, f64)> {
    let point = |number: u32| (f64::from(number % 3) * 150.0, f64::from(number / 3) * 100.0);
    (0..9).map(point).collect()
}

fn weights(model: ZModel, points: &[(f64, f64)], at: (f64, f64)) -> Vec<f64> {
    let mut all = vec![0.0; points.len()];
    for (probe, weight) in Surface::new(model, &places(points)).weights(Xy::new(at.0, at.1)) {
        all[probe] += weight;
    }
    all
}

/// Returns the value of a model at a point, for measured values given as a function of the position.
fn modelled(model: ZModel, points: &[(f64, f64)], measured: impl Fn(f64, f64) -> f64, at: (f64, f64)) -> f64 {
    let weights = weights(model, points, at);
    weights.iter().zip(points).map(|(weight, (x, y))| weight * measured(*x, *y)).sum()
}

#[track_caller]
fn assert_near(a: &[f64], b: &[f64]) {
    assert_eq!(a.len(), b.len());
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9), "{a:?} is not {b:?}");
}

fn tilted(x: f64, y: f64) -> f64 {
    0.3 - 0.001 * x + 0.0025 * y
}

#[test]
fn plane_and_tin_are_exact_on_planes() {
    for model in [ZModel::Plane, ZModel::Tin] {
        for at in [(0.0, 0.0), (300.0, 200.0), (1.0, 0.0), (149.999, 100.0), (77.0, 33.0), (222.0, 150.5)] {
            let off = modelled(model, &grid(), tilted, at) - tilted(at.0, at.1);
            assert!(off.abs() < 1e-12, "{model:?} at {at:?}: {off}");
        }
    }
    let bent = modelled(ZModel::Idw4, &grid(), tilted, (77.0, 33.0)) - tilted(77.0, 33.0);
    assert!(bent.abs() > 0.01, "the compatible model is not: {bent}");
}

#[test]
fn weights_sum_to_one() {
    let scattered = [(0.0, 0.0), (10.0, 1.0), (3.0, 8.0), (-5.0, 4.0), (2.0, -7.0)];
    for model in [ZModel::Idw4, ZModel::Plane, ZModel::Tin] {
        for count in 1..=scattered.len() {
            for at in [(0.0, 0.0), (1.5, 2.5), (100.0, -40.0)] {
                let sum: f64 = weights(model, &scattered[..count], at).iter().sum();
                assert!((sum - 1.0).abs() < 1e-12, "{model:?} {count} {at:?}: {sum}");
            }
        }
    }
}

#[test]
fn tin_is_linear_in_each_triangle() {
    let triangle = [(0.0, 0.0), (10.0, 0.0), (0.0, 10.0)];
    assert_near(&weights(ZModel::Tin, &triangle, (2.0, 3.0)), &[0.5, 0.2, 0.3]);
    assert_near(&weights(ZModel::Tin, &triangle, (10.0, 0.0)), &[0.0, 1.0, 0.0]);
    assert_near(&weights(ZModel::Tin, &triangle, (4.0, 0.0)), &[0.6, 0.4, 0.0]);
}

#[test]
fn tin_triangles_are_those_of_delaunay() {
    // Of the two ways to divide this kite, the one with the shorter diagonal is used.
    let kite = [(0.0, -1.0), (10.0, 0.0), (0.0, 1.0), (-10.0, 0.0)];
    assert_near(&weights(ZModel::Tin, &kite, (0.0, 0.0)), &[0.5, 0.0, 0.5, 0.0]);
}

#[test]
fn tin_is_outside_as_on_the_nearest_edge() {
    let triangle = [(0.0, 0.0), (10.0, 0.0), (0.0, 10.0)];
    assert_near(&weights(ZModel::Tin, &triangle, (4.0, -50.0)), &[0.6, 0.4, 0.0]);
    assert_near(&weights(ZModel::Tin, &triangle, (-5.0, -5.0)), &[1.0, 0.0, 0.0]);
    assert_near(&weights(ZModel::Tin, &triangle, (20.0, 20.0)), &[0.0, 0.5, 0.5]);
    assert_near(&weights(ZModel::Tin, &triangle, (30.0, -1.0)), &[0.0, 1.0, 0.0]);
}

#[test]
fn one_probe_raises_everything() {
    for model in [ZModel::Plane, ZModel::Tin] {
        assert_near(&weights(model, &[(3.0, 4.0)], (100.0, -7.0)), &[1.0]);
    }
}

#[test]
fn probes_on_a_line_say_nothing_across_it() {
    let line = [(0.0, 0.0), (10.0, 10.0), (20.0, 20.0)];
    for (model, beyond) in [(ZModel::Plane, 45.0), (ZModel::Tin, 20.0)] {
        for points in [&line[..], &[line[0], line[2]]] {
            let along = |x: f64, _: f64| x;
            assert_near(&[modelled(model, points, along, (5.0, 5.0))], &[5.0]);
            assert_near(&[modelled(model, points, along, (8.0, 2.0))], &[5.0]);
            assert_near(&[modelled(model, points, along, (45.0, 45.0))], &[beyond]);
        }
    }
}

#[test]
fn a_line_of_probes_may_run_in_any_direction() {
    for (x, y) in [(1.0, 0.0), (0.0, 1.0), (3.0, 1.0), (1.0, 3.0), (-1.0, 3.0), (3.0, -1.0), (0.1, -7.0)] {
        let line = [(0.0, 0.0), (10.0 * x, 10.0 * y), (20.0 * x, 20.0 * y)];
        let along = |at: (f64, f64)| (at.0 * x + at.1 * y) / (x * x + y * y);
        for (part, aside) in [(5.0, 0.0), (5.0, 4.0), (17.0, -3.0)] {
            let at = (part * x - aside * y, part * y + aside * x);
            assert_near(&[modelled(ZModel::Plane, &line, |x, y| along((x, y)), at)], &[part]);
        }
    }
}

#[test]
fn probes_within_a_hundredth_of_a_line_are_on_it_for_the_plane() {
    // The probes are 100 mm from the centre along the line, and d from it across the line.
    let across = |d: f64| {
        modelled(ZModel::Plane, &[(-100.0, 0.0), (100.0, 0.0), (0.0, d), (0.0, -d)], |_, y| y, (0.0, 50.0))
    };
    assert_near(&[across(0.99), across(1.01)], &[0.0, 50.0]);
}

#[test]
fn probes_at_one_place_share_its_weight() {
    let points = [(0.0, 0.0), (10.0, 0.0), (0.0, 10.0), (0.0002, 0.0)];
    assert_near(&weights(ZModel::Tin, &points, (-1.0, -1.0)), &[0.5, 0.0, 0.0, 0.5]);
    assert_near(&weights(ZModel::Tin, &[(1.0, 1.0), (1.0, 1.0)], (9.0, 9.0)), &[0.5, 0.5]);
    assert_near(&weights(ZModel::Plane, &[(1.0, 1.0), (1.0, 1.0)], (9.0, 9.0)), &[0.5, 0.5]);
    let apart = [(0.0, 0.0), (10.0, 0.0), (0.0, 10.0), (-0.0008, 0.0)];
    assert_near(&weights(ZModel::Tin, &apart, (-1.0, 0.0)), &[0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn places_far_out_do_no_harm() {
    for far in [1e9, 1e60, 1e155, 1e300] {
        let points = [(0.0, 0.0), (far, 0.0), (0.0, far), (-far, -far), (5.0, 5.0)];
        for model in [ZModel::Plane, ZModel::Tin] {
            assert_eq!(weights(model, &points, (1.0, 2.0)).len(), 5);
        }
    }
    assert!(Surface::new(ZModel::Tin, &[]).weights(Xy::origin()).is_empty());
}

fn line(to: (f64, f64), z: f64, from: (f64, f64)) -> ProgramStep {
    let (to, from) = (Xy::new(to.0, to.1), Xy::new(from.0, from.1));
    let count = Count { class: MoveClass::Milling, length: (to - from).norm(), feed: Some(200.0) };
    ProgramStep::Move { to: PlannedMove::Line { feed: 200.0, to, z: Height { z, at: from } }, count }
}

/// Returns an arc whose centre is relative to its start.
fn arc(centre: (f64, f64), to: (f64, f64), z: f64, (clockwise, angle): (bool, f64)) -> ProgramStep {
    let (centre, to) = (Xy::new(centre.0, centre.1), Xy::new(to.0, to.1));
    let length = centre.coords.norm() * angle.to_radians();
    let count = Count { class: MoveClass::Milling, length, feed: Some(200.0) };
    let z = Height { z, at: Xy::origin() };
    ProgramStep::Move {
        to: PlannedMove::Arc { feed: 200.0, clockwise, centre, to, z, is_spiral: angle == 180.0 },
        count,
    }
}

fn upright(step: PlannedMove, length: f64) -> ProgramStep {
    ProgramStep::Move { to: step, count: Count { class: MoveClass::Sweep, length, feed: None } }
}

fn program(points: &[(f64, f64)], steps: Vec<ProgramStep>) -> Program {
    let probe = |at: Xy| ProbePoint { at, drawn_at: at, height: 5.0, feed: 40.0, label: None };
    let probes = places(points).into_iter().map(probe).collect();
    Program {
        path: "1234.1P".into(),
        sweep_height: 20.0,
        thickness: 5.0,
        steps,
        probes,
        ..Program::default()
    }
}

fn written(program: &Program, correction: Correction) -> String {
    let options = WriteOptions { lang: Lang::En, charset: Charset::Ascii, rapid: 1000.0, correction };
    native::write_program(program, "", &options, usize::MAX).unwrap()
}

/// Returns the lines of moves, without those that every program begins and ends with.
fn moves(program: &Program, correction: Correction) -> Vec<String> {
    let text = written(program, correction);
    let body =
        text.split("G00 X0.000 Y0.000\n").nth(1).unwrap().split("G00 Z20.000\n(Milling").next().unwrap();
    body.lines().map(str::to_owned).collect()
}

/// Returns the moves without their formulas.
fn plain(program: &Program, correction: Correction) -> Vec<String> {
    moves(program, correction).iter().map(|line| line.split("(=").next().unwrap().to_owned()).collect()
}

#[test]
fn the_compatible_model_stays_as_it_is() {
    let steps = vec![line((40.0, 0.0), 1.0, (0.0, 0.0))];
    let expected = "G01 F200.000 X40.000 Y0.000 Z1.000(=1.000+0.708*[#51-5.000]+0.292*[#52-5.000])";
    let program = program(&[(0.0, 10.0), (0.0, 24.25)], steps);
    assert_eq!(moves(&program, Correction::default()), [expected]);
}

#[test]
fn better_models_correct_a_move_at_its_own_end() {
    let steps = vec![
        line((10.0, 0.0), 1.0, (0.0, 0.0)),
        upright(PlannedMove::Lift { z: Height { z: 20.0, at: Xy::new(0.0, 0.0) } }, 19.0),
        upright(PlannedMove::Sweep { to: Xy::new(5.0, 0.0) }, 5.0),
        upright(PlannedMove::Drill { feed: 150.0, z: Height { z: 2.5, at: Xy::new(5.0, 0.0) } }, 17.5),
        arc((-5.0, 0.0), (0.0, 5.0), 0.25, (false, 90.0)),
    ];
    let program = program(&[(0.0, 0.0), (10.0, 0.0), (0.0, 10.0)], steps);
    let uncut = |model| Correction { model, longest: 0.0 };
    let expected = [
        "G01 F200.000 X10.000 Y0.000 Z1.000(=1.000+1.000*[#52-5.000])",
        "G00 Z20.000(=20.000+1.000*[#52-5.000])",
        "G00 X5.000 Y0.000",
        "G01 F150.000 Z2.500(=2.500+0.500*[#51-5.000]+0.500*[#52-5.000])",
        "G03 F200.000 I-5.000 J0.000 X0.000 Y5.000 Z0.250(=0.250+0.500*[#51-5.000]+0.500*[#53-5.000])",
    ];
    assert_eq!(moves(&program, uncut(ZModel::Tin)), expected);
    assert_eq!(moves(&program, uncut(ZModel::Plane)), expected);
}

#[test]
fn what_is_milled_right_after_a_sweep_begins_at_its_own_height() {
    let steps = vec![
        upright(PlannedMove::Lift { z: Height { z: 8.0, at: Xy::origin() } }, 12.0),
        upright(PlannedMove::Sweep { to: Xy::new(10.0, 0.0) }, 10.0),
        arc((-5.0, 0.0), (0.0, 0.0), 5.0, (true, 180.0)),
        upright(PlannedMove::Sweep { to: Xy::new(10.0, 0.0) }, 10.0),
        upright(PlannedMove::Lift { z: Height { z: 20.0, at: Xy::origin() } }, 12.0),
    ];
    let program = program(&[(0.0, 0.0), (10.0, 0.0)], steps);
    let whole = Correction { model: ZModel::Tin, longest: 0.0 };
    let expected = [
        "G00 Z8.000(=8.000+1.000*[#51-5.000])",
        "G00 X10.000 Y0.000",
        "G00 Z8.000(=8.000+1.000*[#52-5.000])",
        "G02 F200.000 I0 J0.000 X0.000 Y0.000 Z5.000(=5.000+1.000*[#51-5.000])",
        "G00 X10.000 Y0.000",
        "G00 Z20.000(=20.000+1.000*[#52-5.000])",
    ];
    assert_eq!((moves(&program, whole), whole.count(&program)), (expected.map(str::to_owned).to_vec(), 6));
    assert_eq!(statistics(&program, 1000.0).commands, 6);
}

#[test]
fn a_model_that_is_cut_is_corrected_at_its_own_ends_whichever_it_is() {
    let steps = vec![line((10.0, 0.0), 1.0, (0.0, 0.0))];
    let program = program(&[(0.0, 0.0), (10.0, 0.0)], steps);
    let cut = moves(&program, Correction { model: ZModel::Idw4, longest: 5.0 });
    assert_eq!(cut[0], "G01 F200.000 X5.000 Y0.000 Z10.500(=10.50002+0.500*[#51-5.000]+0.500*[#52-5.000])");
    assert_eq!(cut[1], "G01 F200.000 X10.000 Y0.000 Z1.000(=1.000+0.9999*[#52-5.000]+0.0001*[#51-5.000])");
}

#[test]
fn weights_have_up_to_six_decimals_and_their_own_sign() {
    let steps = vec![line((-10.0, 0.0), 1.0, (0.0, 0.0)), line((-4.0, 0.0), -0.2, (-10.0, 0.0))];
    let program = program(&[(0.0, 0.0), (30.0, 0.0), (60.0, 0.0)], steps);
    let expected = [
        "G01 F200.000 X-10.000 Y0.000 Z1.000(=1.000+1.000*[#51-5.000]+0.333333*[#52-5.000]-0.333333*[#53-5.000])",
        "G01 F200.000 X-4.000 Y0.000 Z-0.200(=-0.200+0.900*[#51-5.000]+0.333333*[#52-5.000]-0.233333*[#53-5.000])",
    ];
    assert_eq!(moves(&program, Correction { model: ZModel::Plane, longest: 0.0 }), expected);
}

#[test]
fn programs_without_probes_are_not_cut() {
    let program = program(&[], vec![line((100.0, 0.0), 1.0, (0.0, 0.0))]);
    assert_eq!(moves(&program, TIN), ["G01 F200.000 X100.000 Y0.000 Z1.000"]);
    assert_eq!((TIN.count(&program), TIN.farthest_unprobed_point(&program)), (1, None));
}

#[test]
fn lines_are_cut_into_equal_pieces_not_longer_than_the_split() {
    for (length, pieces) in [(20.0, 1), (20.001, 2), (40.0, 2), (300.0, 15), (300.1, 16)] {
        let program = program(&grid(), vec![line((length, 0.0), 1.0, (0.0, 0.0))]);
        let lines = plain(&program, TIN);
        assert_eq!((lines.len(), TIN.count(&program)), (pieces, pieces as u64), "{length}");
        assert!(lines.last().unwrap().starts_with(&format!("G01 F200.000 X{length:.3} Y0.000 Z1.000")));
    }
}

#[test]
fn heights_change_evenly_along_a_cut_move() {
    let steps = vec![line((0.0, 0.0), 2.0, (0.0, 0.0)), line((30.0, 40.0), 1.0, (0.0, 0.0))];
    let expected = [
        "G01 F200.000 X0.000 Y0.000 Z2.000",
        "G01 F200.000 X10.000 Y13.333 Z1.667",
        "G01 F200.000 X20.000 Y26.667 Z1.333",
        "G01 F200.000 X30.000 Y40.000 Z1.000",
    ];
    let program = program(&grid(), steps);
    assert_eq!(plain(&program, TIN), expected);
    assert!(moves(&program, TIN)[1].contains("Z1.667(=1.666667+"));
}

#[test]
fn arcs_stay_arcs_and_pieces_end_on_the_circle() {
    let steps = vec![line((50.0, 0.0), 2.0, (0.0, 0.0)), arc((-50.0, 0.0), (0.0, 50.0), 1.0, (false, 90.0))];
    let program = program(&grid(), steps);
    let cut = TIN.steps(&program);
    let mut at = Xy::new(50.0, 0.0);
    let mut arcs = 0;
    for step in cut.iter().skip(3) {
        let ProgramStep::Move { to: PlannedMove::Arc { clockwise, centre, to, z, .. }, count } = step else {
            panic!("{step:?}")
        };
        assert!(!clockwise);
        assert!((at + centre.coords).coords.norm() < 1e-9, "the centre stays where it is");
        assert!((to.coords.norm() - 50.0).abs() < 1e-9);
        let turned = libm::atan2(to.y, to.x) / std::f64::consts::FRAC_PI_2;
        assert!((z.z - (2.0 - turned)).abs() < 1e-9 && z.at == *to);
        assert!(count.length <= 20.0);
        at = *to;
        arcs += 1;
    }
    assert_eq!((arcs, at), (9, Xy::new(0.0, 50.0)));
}

#[test]
fn a_piece_of_an_arc_departs_from_its_chord_by_a_hundredth_of_the_split_at_most() {
    // 0.2 mm at a radius of 5 mm corresponds to an angle of 32.4 degrees.
    for (angle, pieces) in [(32.3, 1), (32.5, 2), (180.0, 6), (360.0, 12)] {
        let (sin, cos) = libm::sincos(f64::to_radians(angle));
        let program =
            program(&grid(), vec![arc((-5.0, 0.0), (5.0 * cos - 5.0, 5.0 * sin), 1.0, (false, angle))]);
        assert_eq!(TIN.count(&program), pieces, "{angle}");
        assert_eq!(plain(&program, TIN).len() as u64, pieces, "{angle}");
    }
}

#[test]
fn half_circles_of_helical_circles_are_cut_too() {
    let steps = vec![
        line((50.0, 45.0), 5.0, (50.0, 45.0)),
        arc((0.0, 5.0), (50.0, 55.0), 4.4, (true, 180.0)),
        arc((0.0, -5.0), (50.0, 45.0), 3.8, (true, 180.0)),
    ];
    let program = program(&grid(), steps);
    let whole = plain(&program, Correction { model: ZModel::Tin, longest: 0.0 });
    assert_eq!(whole[1], "G02 F200.000 I0 J5.000 X50.000 Y55.000 Z4.400");
    let cut = plain(&program, TIN);
    let arcs: Vec<&String> = cut.iter().filter(|line| line.starts_with("G02")).collect();
    assert_eq!(arcs.len(), 12);
    assert_eq!(arcs[0], "G02 F200.000 I0.000 J5.000 X47.500 Y45.670 Z4.900");
    assert_eq!(arcs[2], "G02 F200.000 I4.330 J2.500 X45.000 Y50.000 Z4.700");
    assert_eq!(arcs[5], "G02 F200.000 I2.500 J-4.330 X50.000 Y55.000 Z4.400");
    assert_eq!(arcs[11], "G02 F200.000 I-2.500 J4.330 X50.000 Y45.000 Z3.800");
}

#[test]
fn a_split_of_zero_never_cuts() {
    let steps = vec![line((300.0, 0.0), 1.0, (0.0, 0.0)), arc((-5.0, 0.0), (300.0, 0.0), 1.0, (true, 360.0))];
    let program = program(&grid(), steps);
    assert_eq!(plain(&program, Correction { model: ZModel::Tin, longest: 0.0 }).len(), 2);
}

#[test]
fn statistics_count_a_cut_move_once() {
    let steps =
        vec![line((300.0, 0.0), 1.0, (0.0, 0.0)), arc((-50.0, 0.0), (250.0, 50.0), 1.0, (false, 90.0))];
    let program = program(&grid(), steps);
    let lines = |correction| {
        let text = written(&program, correction);
        text.lines()
            .filter(|line| line.contains(" mm ") || line.contains("count"))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(lines(TIN), lines(Correction::default()));
    assert_eq!(statistics(&program, 1000.0).commands, 3);
    assert_eq!(lines(TIN).last().unwrap(), "(Command count: 3)");
}

#[test]
fn the_header_says_what_the_program_was_made_with() {
    let mut program = program(&[(12.0, 3.0)], Vec::new());
    program.probes[0].drawn_at = Xy::new(5.0, -15.0);
    assert!(written(&program, TIN).contains("\n(Probe #51: [5.000 -15.000] T=5.000 X12.000 Y3.000)\n"));
}

#[test]
fn milling_outside_the_probes_is_found() {
    let outside = |model, steps: Vec<ProgramStep>| {
        let found = Correction { model, longest: 20.0 }.farthest_unprobed_point(&program(&grid(), steps));
        found.map(|outside| (outside.at.x, outside.at.y, outside.distance))
    };
    for model in [ZModel::Plane, ZModel::Tin] {
        assert_eq!(outside(model, vec![line((300.0, 200.0005), 1.0, (0.0, 0.0))]), None);
        let found = outside(model, vec![line((300.0, 200.002), 1.0, (0.0, 0.0))]).unwrap();
        assert!(found.0 == 300.0 && (found.2 - 0.002).abs() < 1e-9);
        let two = vec![line((-3.0, -4.0), 1.0, (0.0, 0.0)), line((301.0, 100.0), 1.0, (-3.0, -4.0))];
        assert_eq!(outside(model, two), Some((-3.0, -4.0, 5.0)));
        let drilled =
            upright(PlannedMove::Drill { feed: 150.0, z: Height { z: 1.0, at: Xy::origin() } }, 4.0);
        let beside = upright(PlannedMove::Sweep { to: Xy::new(-7.0, 0.0) }, 7.0);
        assert_eq!(outside(model, vec![beside, drilled]), Some((-7.0, 0.0, 7.0)));
        assert_eq!(
            outside(
                model,
                vec![beside, upright(PlannedMove::Lift { z: Height { z: 9.0, at: Xy::origin() } }, 1.0)]
            ),
            None
        );
        // The ends of the arc are inside the area of the probes.
        let bow =
            vec![line((100.0, 0.0), 1.0, (0.0, 0.0)), arc((50.0, 0.0), (200.0, 0.0), 1.0, (false, 180.0))];
        let (.., distance) = outside(model, bow).unwrap();
        assert!((distance - 50.0).abs() < 0.3);
    }
    assert_eq!(outside(ZModel::Idw4, vec![line((-30.0, 0.0), 1.0, (0.0, 0.0))]), None);
}

#[test]
fn fewer_than_three_probes_have_nothing_inside() {
    let distance = |points: &[(f64, f64)], to| {
        let program = program(points, vec![line(to, 1.0, (0.0, 0.0))]);
        TIN.farthest_unprobed_point(&program).map(|outside| outside.distance)
    };
    assert_eq!(distance(&[(0.0, 0.0)], (0.0, 10.0)), Some(10.0));
    assert_eq!(distance(&[(0.0, 0.0), (0.0, 20.0)], (0.0, 10.0)), None);
    assert_eq!(distance(&[(0.0, 0.0), (0.0, 20.0)], (3.0, 10.0)), Some(3.0));
}

#[test]
fn as_many_pieces_as_nobody_can_store_are_counted_without_making_them() {
    let program = program(&grid(), vec![line((1e300, 0.0), 1.0, (0.0, 0.0)); 3]);
    assert_eq!(TIN.count(&program), u64::MAX);
}

/// Returns reproducible random points.
fn scattered(count: usize, mut seed: u64) -> Vec<(f64, f64)> {
    let mut coordinate = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((seed >> 40) as u32 % 4000) / 16.0 - 100.0
    };
    (0..count).map(|_| (coordinate(), coordinate())).collect()
}

/// The four nearest probes found by position are those found by comparing all; if several are equally near, the first ones are taken.
#[test]
fn the_four_nearest_are_found_wherever_they_lie() {
    for (points, seed) in
        [(grid(), 1), (scattered(300, 2), 3), (vec![(5.0, 5.0); 9], 4), (scattered(3, 5), 6)]
    {
        let model = Surface::new(ZModel::Idw4, &places(&points));
        for at in points.iter().copied().chain(scattered(200, seed)) {
            let weight = |(x, y): &(f64, f64)| 1.0 / ((Xy::new(*x, *y) - Xy::new(at.0, at.1)).norm() + 0.001);
            let mut all: Vec<(usize, f64)> = points.iter().map(weight).enumerate().collect();
            all.sort_by(|(_, a), (_, b)| b.total_cmp(a));
            all.truncate(4);
            let sum: f64 = all.iter().map(|(_, weight)| weight).sum();
            let expected: Vec<(usize, f64)> =
                all.iter().map(|(probe, weight)| (*probe, weight / sum)).collect();
            assert_eq!(model.weights(Xy::new(at.0, at.1)), expected, "{at:?}");
        }
    }
}
