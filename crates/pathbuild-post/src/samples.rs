//! Small programs, each with a single feature that a post may have words for.

use pathbuild_motion::{Arc, Coolant, Move, MoveShape, Pace, Plane, Turning};

use super::job::{Job, Operation, Tool};
use crate::job::{Hole, HoleKind, JobStep};

/// Programs that reveal which words a post writes. The first one is the simplest. A post that has no text for a feature refuses the
/// corresponding program.
pub fn samples() -> Vec<Job> {
    let hole = |kind| {
        JobStep::Hole(Hole {
            at: [0.0, 0.0],
            level: 5.0,
            retract: 1.0,
            bottom: -4.0,
            exit: 5.0,
            feed: Some(80.0),
            kind,
        })
    };
    let down = || vec![line(0.0, -1.0), line(10.0, -1.0)];
    let circle = Arc { plane: Plane::Xy, centre: [5.0, 0.0], clockwise: true, extra_turns: 0 };
    let arc = JobStep::Move(Move {
        from: [0.0, 0.0, -1.0].into(),
        to: [10.0, 0.0, -1.0].into(),
        shape: MoveShape::Arc(circle),
        pace: Pace::Feed(100.0),
        named: None,
    });
    let probe = JobStep::probe([None, None, Some(0.0)], Some(40.0));
    let plain = || operation(1, Coolant::FLOOD, down());
    vec![
        job(vec![plain()]),
        job(vec![plain(), operation(2, Coolant::MIST, down()), operation(1, Coolant::OFF, down())]),
        job(vec![Operation { spindle: Some(Turning::CounterClockwise), ..plain() }]),
        job(vec![operation(1, Coolant::OFF, vec![line(0.0, -1.0), arc])]),
        job(vec![operation(1, Coolant::OFF, vec![hole(HoleKind::Plain)])]),
        job(vec![operation(1, Coolant::OFF, vec![hole(HoleKind::Peck { depth: 2.0 })])]),
        job(vec![operation(1, Coolant::OFF, vec![probe])]),
        job(vec![operation(1, Coolant::OFF, [vec![JobStep::Dwell { seconds: 1.0 }], down()].concat())]),
    ]
}

fn job(operations: Vec<Operation>) -> Job {
    Job { name: "1.1P".into(), drawing: "1.dxf".into(), operations, ..Job::default() }
}

/// Moves to the clearance plane, and along it to X.
fn rapid(x: Option<f64>) -> JobStep {
    JobStep::rapid([x, x, Some(5.0)])
}

fn line(x: f64, z: f64) -> JobStep {
    JobStep::feed([x, 0.0, z], Some(100.0))
}

fn operation(tool: u32, coolant: Coolant, steps: Vec<JobStep>) -> Operation {
    let operation = Operation::new("1.1P", Tool::new(tool, 3.0, "cutter"));
    Operation {
        part: "1.1P".into(),
        spindle: Some(Turning::Clockwise),
        speed: Some(1000.0),
        coolant: Some(coolant),
        clearance: 5.0,
        retract: 1.0,
        steps: [vec![rapid(Some(0.0))], steps, vec![rapid(None)]].concat(),
        ..operation
    }
}
