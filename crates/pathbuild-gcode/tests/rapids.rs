//! Tests rapid moves into material, in programs made from drawings. (book: program/reading)

use std::sync::Arc;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::verify::{rapids_into_joined_material, rapids_into_material};
use pathbuild_toolpath::{
    Comment, Count, ElementKind, Height, MoveClass, PlannedMove, Program, ProgramStep, Xy,
};

fn go(to: PlannedMove) -> ProgramStep {
    ProgramStep::Move { to, count: Count { class: MoveClass::Sweep, length: 0.0, feed: None } }
}

fn sweep(x: f64, y: f64) -> ProgramStep {
    go(PlannedMove::Sweep { to: Xy::new(x, y) })
}

fn height(z: f64) -> Height {
    Height { z, at: Xy::new(0.0, 0.0) }
}

fn lift(z: f64) -> ProgramStep {
    go(PlannedMove::Lift { z: height(z) })
}

fn mill(x: f64, y: f64, z: f64) -> ProgramStep {
    go(PlannedMove::Line { feed: 150.0, to: Xy::new(x, y), z: height(z) })
}

/// Returns half a circle clockwise, to a position straight above or below.
fn half_circle(x: f64, y: f64, radius: f64, z: f64) -> ProgramStep {
    let (to, centre) = (Xy::new(x, y), Xy::new(0.0, radius));
    go(PlannedMove::Arc { feed: 150.0, clockwise: true, centre, to, z: height(z), is_spiral: true })
}

/// Returns a step that sets the upper face and the cutter's diameter of the following cuts.
fn element(surface: f64, cutter: f64) -> ProgramStep {
    let (kind, at) = (ElementKind::MillingChain, Xy::new(0.0, 0.0));
    ProgramStep::Comment(Comment::Element { kind, at, bottom: 0.0, surface, cutter, peck: None })
}

/// Returns the codes of the problems in a program on a plate of 5 mm, with a cutter of 3 mm.
fn found(steps: Vec<ProgramStep>) -> Vec<String> {
    let program = Program { tool: 3.0, sweep_height: 20.0, thickness: 5.0, steps, ..Program::default() };
    rapids_into_material(&program).iter().map(|it| it.code().to_string()).collect()
}

/// Returns a helical circle around (30, 30), from whose bottom the tool moves to the centre.
fn circle(radius: f64, cutter: f64) -> Vec<ProgramStep> {
    let (low, high) = (30.0 - radius, 30.0 + radius);
    let turn = |z: f64| [half_circle(30.0, high, radius, z), half_circle(30.0, low, -radius, z)];
    let mut steps = vec![lift(7.0), element(5.0, cutter), sweep(30.0, low), lift(5.0)];
    steps.extend([4.0, 2.0, 0.0, 0.0].into_iter().flat_map(turn));
    steps.extend([sweep(30.0, 30.0), lift(20.0)]);
    steps
}

#[test]
fn the_middle_of_a_helical_circle_is_free_where_no_core_stands() {
    assert_eq!(found(circle(1.5, 3.0)), [""; 0]);
    assert_eq!(found(circle(2.0, 3.0)), ["PB740"]);
}

#[test]
fn an_embedded_path_is_cut_by_its_own_cutter() {
    assert_eq!(found(circle(2.0, 4.0)), [""; 0]);
    assert_eq!(found(circle(1.5, 2.0)), ["PB740"]);
}

#[test]
fn material_elsewhere_is_no_obstacle() {
    let plates = |way: [ProgramStep; 2]| {
        let thin = [lift(3.0), element(2.0, 3.0), mill(10.0, 0.0, 1.0), lift(3.0)];
        let thick =
            [lift(20.0), sweep(50.0, 0.0), lift(5.0), element(5.0, 3.0), mill(60.0, 0.0, 1.0), lift(20.0)];
        let over_thin = [sweep(10.0, 0.0), lift(3.0)];
        thin.into_iter().chain(thick).chain(over_thin).chain(way).collect()
    };
    assert_eq!(found(plates([sweep(0.0, 0.0), lift(20.0)])), [""; 0]);
    assert_eq!(found(plates([sweep(55.0, 10.0), sweep(55.0, 4.9)])), [""; 0]);
    assert_eq!(found(plates([sweep(55.0, 10.0), sweep(55.0, 4.0)])), ["PB740"]);
}

#[test]
fn a_milled_slot_is_free_and_what_is_beside_it_is_not() {
    let back = |to: ProgramStep| vec![lift(5.0), mill(0.0, 0.0, 2.0), mill(20.0, 0.0, 2.0), to, lift(20.0)];
    assert_eq!(found(back(sweep(0.0, 0.0))), [""; 0]);
    assert_eq!(found(back(sweep(0.0, 0.8))), ["PB740"]);
    // A slope removes material down to its own depth, and everything above its highest point is free.
    let slope = |z: f64| vec![lift(5.0), mill(20.0, 0.0, 2.0), lift(z), sweep(0.0, 0.0), lift(20.0)];
    assert_eq!(found(slope(5.0)), [""; 0]);
    assert_eq!(found(slope(2.5)), ["PB740"]);
}

#[test]
fn a_hole_is_not_drilled_by_rapid_moves() {
    let dip = |z: f64| vec![sweep(10.0, 10.0), lift(6.0), lift(z), lift(20.0)];
    assert_eq!(found(dip(5.0)), [""; 0]);
    assert_eq!(found(dip(4.9)), ["PB741"]);
}

#[test]
fn a_slot_is_not_milled_by_rapid_moves() {
    let slot = |z: f64| {
        vec![sweep(10.0, 10.0), lift(6.0), lift(z), sweep(90.0, 10.0), sweep(90.0, 90.0), lift(20.0)]
    };
    assert_eq!(found(slot(5.0)), [""; 0]);
    assert_eq!(found(slot(4.9)), ["PB741"]);
    // A cut far from the descent shows that the tool came down beside the stock.
    let mut beside = slot(4.9);
    beside.insert(5, mill(90.0, 91.0, 4.9));
    assert_eq!(found(beside), ["PB740"]);
}

#[test]
fn old_cuts_are_remembered_by_the_map() {
    let mut steps = vec![lift(5.0), mill(0.0, 0.0, 2.0), mill(20.0, 0.0, 2.0)];
    steps.extend((0..100).map(|turn| mill(20.0 + f64::from(turn % 2), 0.0, 2.0)));
    steps.extend([sweep(20.0, 0.0), sweep(0.0, 0.0), lift(20.0)]);
    assert_eq!(found(steps), [""; 0]);
}

#[test]
fn each_rapid_move_into_material_is_told_however_many_there_are() {
    for count in [16_u8, 17] {
        let dip = |number: u8| [sweep(10.0 * f64::from(number), 10.0), lift(6.0), lift(4.9), lift(20.0)];
        assert_eq!(found((0..count).flat_map(dip).collect()), vec!["PB741"; usize::from(count)]);
    }
}

/// Returns a groove of 20 mm from (0, `y`), of 2 mm width, in material up to `surface`.
fn groove(surface: f64, y: f64, bottom: f64) -> Vec<ProgramStep> {
    let way = [sweep(0.0, y), lift(surface), mill(0.0, y, bottom), mill(20.0, y, bottom), lift(20.0)];
    std::iter::once(element(surface, 2.0)).chain(way).collect()
}

#[test]
fn the_highest_surface_counts_in_the_way_of_every_cut() {
    for is_high_first in [false, true] {
        let both = |y: f64, bottom: f64| {
            let (high, low) = (groove(5.0, 0.0, bottom), groove(2.0, y, 1.5));
            found(if is_high_first { [high, low].concat() } else { [low, high].concat() })
        };
        assert_eq!(both(1.9, 4.5), ["PB741"], "{is_high_first}: the cuts behind it follow from it");
        assert_eq!(both(2.1, 4.5), [""; 0], "{is_high_first}");
        let is_cleared = both(0.0, 2.0).is_empty();
        assert_eq!(is_cleared, is_high_first, "what the higher one has milled is free");
    }
}

#[test]
fn a_cut_does_not_go_through_a_higher_surface() {
    // The lower groove begins `x` mm before the higher one, which crosses it.
    let crossing = |x: f64| {
        let way = [sweep(x, -20.0), lift(5.0), mill(x, -20.0, 4.5), mill(x, 20.0, 4.5), lift(20.0)];
        std::iter::once(element(5.0, 2.0)).chain(way).collect::<Vec<_>>()
    };
    for (x, expected) in [(21.9, Some("PB793")), (22.1, None), (-2.1, None), (10.0, Some("PB793"))] {
        for parts in [[groove(2.0, 0.0, 1.5), crossing(x)], [crossing(x), groove(2.0, 0.0, 1.5)]] {
            assert_eq!(found(parts.concat()), Vec::from_iter(expected), "{x}");
        }
    }
}

#[test]
fn a_higher_sheet_elsewhere_is_no_obstacle_in_any_order() {
    let (high, sweep_at) =
        (groove(5.0, 80.0, 4.5), |z| vec![sweep(0.0, 0.0), lift(z), sweep(10.0, 0.0), lift(20.0)]);
    let low = groove(2.0, 10.0, 1.5);
    for z in [4.0, 2.0] {
        assert_eq!(found([high.clone(), sweep_at(z), low.clone()].concat()), [""; 0]);
        assert_eq!(found([sweep_at(z), low.clone(), high.clone()].concat()), [""; 0]);
    }
    assert_eq!(found([high, sweep_at(1.9), low].concat()), ["PB741"]);
}

#[test]
fn joined_programs_share_their_material() {
    let program = |steps, thickness, sweep_height| {
        Arc::new(Program { tool: 2.0, sweep_height, thickness, steps, ..Program::default() })
    };
    let raised = program(groove(12.0, 5.0, 11.0), 2.0, 20.0);
    let crossing = |height: f64| program(vec![sweep(10.0, -20.0), sweep(10.0, 20.0)], 2.0, height);
    for (height, expected) in [(12.0, None), (11.9, Some("PB740"))] {
        for (first, programs) in [(1, [&raised, &crossing(height)]), (0, [&crossing(height), &raised])] {
            let found = rapids_into_joined_material(&programs.map(Arc::clone));
            let code = found.first().map(|(_, problem)| problem.code().to_string());
            assert_eq!(code.as_deref(), expected);
            let is_at_crossing =
                |(program, problem): &(usize, Diagnostic)| *program == first && problem.place.line == Some(2);
            assert!(found.iter().all(is_at_crossing), "{found:?}");
        }
    }
}
