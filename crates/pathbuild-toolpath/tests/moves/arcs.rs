//! Tests arcs: direction, centre and ends. ("mill arc")

use pathbuild_toolpath::{PlannedMove, Program, ProgramStep};

use crate::support::{path, program, short};

/// Formats arcs as `G02 I J X Y`.
fn arcs(program: &Program) -> Vec<String> {
    let of_step = |step: &ProgramStep| match step {
        ProgramStep::Move { to: PlannedMove::Arc { clockwise, centre, to, .. }, .. } => Some(format!(
            "{} {} {} {} {}",
            if *clockwise { "G02" } else { "G03" },
            short(centre.x),
            short(centre.y),
            short(to.x),
            short(to.y)
        )),
        _ => None,
    };
    program.steps.iter().filter_map(of_step).collect()
}

fn milled(statement: &str, end: &str) -> Vec<String> {
    arcs(&program(&path("T5 O3 I5 B0", &format!("{statement}\nend {end}"))))
}

#[test]
fn an_arc_is_run_in_its_own_direction() {
    // The arc is drawn counterclockwise, from the left of the centre to the right, below the centre.
    assert_eq!(milled("mill arc centre 10,0 r 10 from 180 to 0", "20,0"), ["G03 10 0 20 0"]);
    // The arc is drawn counterclockwise, from the right to the left, above the centre, and milled from its end.
    assert_eq!(milled("mill arc centre 10,0 r 10 from 0 to 180", "20,0"), ["G02 10 0 20 0"]);
}

#[test]
fn an_arc_that_is_run_from_its_end_turns_the_other_way() {
    assert_eq!(milled("mill arc centre 10,0 r 10 from 0 to 180", "20,0"), ["G02 10 0 20 0"]);
}

/// I and J are relative to the start of the move, even in later passes that start at the other end.
#[test]
fn the_centre_counts_from_where_the_run_begins() {
    let program = program(&path("T5 O3 I2 B0", "mill arc centre 0,10 r 10 from 270 to 0\nend 10,10"));
    assert_eq!(arcs(&program), ["G03 0 10 10 10", "G02 -10 0 0 0", "G03 0 10 10 10"]);
}

#[test]
fn an_arc_over_zero_degrees_is_not_run_the_long_way() {
    let lengths = |statement: &str, end: &str| -> Vec<String> {
        let program = program(&path("T5 O3 I5 B0", &format!("{statement}\nend {end}")));
        let length = |step: &ProgramStep| match step {
            ProgramStep::Move { to: PlannedMove::Arc { .. }, count } => Some(short(count.length)),
            _ => None,
        };
        program.steps.iter().filter_map(length).collect()
    };
    // The arcs are a quarter and three quarters of a circle.
    assert_eq!(lengths("mill arc centre 0,10 r 10 from 270 to 0", "10,10"), ["15.708"]);
    assert_eq!(lengths("mill arc centre 0,10 r 10 from 270 to 180", "-10,10"), ["47.124"]);
    assert_eq!(lengths("arc CONTINUOUS centre 10,0 r 10 from 180 to 180", "0,0"), ["62.832"]);
}

/// The ends of such an arc would be printed 0.001 mm apart. As both are equally near, all passes run the same way, so each would end farther away.
#[test]
fn an_arc_without_length_is_a_line() {
    let passes = |degrees: f64| {
        let statement = format!("mill arc centre -10,0 r 10 from 0 to {degrees:?}");
        arcs(&program(&path("T5 O3 I2 B0", &format!("{statement}\nend 0,0")))).len()
    };
    // 0.9e-9 and 1.7e-9 mm.
    assert_eq!((passes(5e-9), passes(1e-8)), (0, 3));
}
