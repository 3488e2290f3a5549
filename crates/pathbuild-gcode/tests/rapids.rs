//! Tests rapid moves into material, in programs made from drawings. (book: program/reading)

use pathbuild_gcode::verify::rapids_into_material;
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
