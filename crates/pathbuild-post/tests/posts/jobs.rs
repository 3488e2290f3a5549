//! Tests the conversion of finished programs to jobs.

use std::f64::consts::{PI, TAU};

use pathbuild_motion::{Coolant, Pace, Turning};
use pathbuild_post::{Entry, HoleKind, Job, JobStep, ToolEntry, ToolTable};
use pathbuild_toolpath::{
    Comment, Count, ElementKind, Height, MoveClass, Names, PlannedMove, Program, ProgramStep, Xy,
};
use regex::Regex;

use crate::support::{bare, lines, rapid, straight_from_anywhere, texts};

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

fn drill(z: f64) -> ProgramStep {
    go(PlannedMove::Drill { feed: 150.0, z: height(z) })
}

fn line(feed: f64, x: f64, y: f64, z: f64) -> ProgramStep {
    go(PlannedMove::Line { feed, to: Xy::new(x, y), z: height(z) })
}

fn hole(peck: Option<f64>) -> ProgramStep {
    let at = Xy::new(0.0, 0.0);
    ProgramStep::Comment(Comment::Element {
        kind: ElementKind::DrilledHole,
        at,
        bottom: 1.0,
        surface: 5.0,
        cutter: 3.0,
        peck,
    })
}

fn program(steps: Vec<ProgramStep>) -> Program {
    let (path, drawing) = ("8001.1P".into(), "8001.dxf".into());
    Program { path, drawing, tool: 2.0, sweep_height: 20.0, thickness: 5.0, steps, ..Program::default() }
}

fn job_of(steps: Vec<ProgramStep>) -> Job {
    Job::from_programs("8001.1P", &[program(steps)], &ToolTable::default(), false).0
}

#[test]
fn a_program_begins_at_its_start_at_sweep_height_and_ends_there() {
    let job = job_of(vec![lift(20.0), sweep(3.0, 4.0), lift(5.0), drill(1.0), line(200.0, 9.0, 4.0, 1.0)]);
    let operation = &job.operations[0];
    assert_eq!(operation.entry, Entry::At([0.0, 0.0, 20.0]));
    let steps = straight_from_anywhere(&operation.steps);
    let JobStep::Move(first) = steps[2] else { panic!("{steps:?}") };
    assert_eq!(first.pace, Pace::Feed(150.0), "F of the header");
    let cut = JobStep::feed([9.0, 4.0, 1.0], Some(200.0));
    assert_eq!(steps[3..], [cut, rapid(9.0, 4.0, 20.0)]);
    assert_eq!(steps[..2], [rapid(3.0, 4.0, 20.0), rapid(3.0, 4.0, 5.0)], "the first lift goes nowhere");
    assert_eq!((operation.clearance, operation.surface, operation.retract), (20.0, 5.0, 5.0));
    assert_eq!(
        (operation.plunge_feed, operation.cut_feed, operation.target_depth),
        (Some(150.0), Some(200.0), Some(1.0))
    );
}

/// An arc that would be printed as a full circle occurs between support bars whose distance equals the diameter of the cutter.
#[test]
fn an_arc_that_would_be_printed_as_a_full_circle_is_a_line() {
    let arc = |length: f64| {
        let to = PlannedMove::Arc {
            feed: 100.0,
            clockwise: true,
            centre: Xy::new(5.0, 0.0),
            to: Xy::new(0.0, length),
            z: height(1.0),
            is_spiral: false,
        };
        let count = Count { class: MoveClass::Milling, length, feed: Some(100.0) };
        straight_from_anywhere(&job_of(vec![ProgramStep::Move { to, count }]).operations[0].steps)[0].clone()
    };
    for length in [0.0, 1e-9, 0.0019] {
        assert_eq!(arc(length), JobStep::feed([0.0, length, 1.0], Some(100.0)), "{length}");
    }
    assert!(matches!(arc(0.002), JobStep::Move(it) if it.course().is_some()));
}

/// The ends of a full circle that is drawn as an arc come from two elements, so they may differ slightly.
#[test]
fn a_full_circle_ends_where_it_begins() {
    let arc = |by: f64, length: f64| {
        let (feed, clockwise, is_spiral) = (100.0, false, false);
        let (centre, to) = (Xy::new(5.0, 0.0), Xy::new(0.0, by));
        let to = PlannedMove::Arc { feed, clockwise, centre, to, z: height(1.0), is_spiral };
        let count = Count { class: MoveClass::Milling, length, feed: Some(100.0) };
        match job_of(vec![ProgramStep::Move { to, count }]).operations[0].steps[0] {
            JobStep::Move(it) => (it.to.y(), it.course().unwrap().sweep()),
            ref other => panic!("{other:?}"),
        }
    };
    for by in [0.0, 1e-14, -1e-14, 2.4e-6, -2.4e-6, -2.6e-6] {
        let (_, sweep) = arc(by, 10.0 * PI);
        assert!((sweep - TAU).abs() < 1e-6, "{by}: {sweep}");
    }
    assert_eq!(arc(-2.6e-6, 10.0 * PI).0, 0.0, "an end behind the beginning of a circle is put right");
    let (end, sweep) = arc(-0.01, 0.01);
    assert_eq!(end, -0.01, "a short arc stays one");
    assert!(sweep < 0.01);
}

#[test]
fn a_plunge_has_a_feed_of_its_own() {
    let job = job_of(vec![drill(1.0), line(200.0, 9.0, 4.0, 1.0), drill(0.5)]);
    let steps = straight_from_anywhere(&job.operations[0].steps);
    assert_eq!(steps[2], JobStep::feed([9.0, 4.0, 0.5], Some(150.0)));
}

#[test]
fn each_embedded_path_that_moves_the_tool_itself_is_an_operation() {
    let mut names = Names::default();
    let (a, b) = (names.intern("1.1A"), names.intern("2.1B"));
    let start = |name| ProgramStep::Comment(Comment::StartSubpath(name));
    let end = |name| ProgramStep::Comment(Comment::EndSubpath(name));
    let steps = vec![
        start(a),
        start(b),
        line(100.0, 1.0, 0.0, 5.0),
        end(b),
        end(a),
        start(b),
        line(100.0, 2.0, 0.0, 5.0),
        end(b),
        start(a),
        line(100.0, 3.0, 0.0, 5.0),
        end(a),
        line(100.0, 4.0, 0.0, 5.0),
    ];
    let job = Job::from_programs("x", &[Program { names, ..program(steps) }], &ToolTable::default(), false).0;
    let operations: Vec<_> = job.operations.iter().map(|it| (&*it.name, it.steps.len(), it.entry)).collect();
    let at = |x| Entry::At([x, 0.0, 5.0]);
    let expected = [("2.1B", 2, Entry::At([0.0, 0.0, 20.0])), ("1.1A", 1, at(2.0)), ("8001.1P", 2, at(3.0))];
    assert_eq!(operations, expected, "the outer 1.1A moves nothing, and consecutive 2.1B are one");
    assert_eq!(&*job.operations[0].part, "8001.1P");
}

#[test]
fn a_hole_that_is_left_upwards_is_a_hole() {
    let steps = vec![
        sweep(3.0, 4.0),
        hole(Some(2.0)),
        lift(5.0),
        drill(1.0),
        lift(20.0),
        sweep(9.0, 4.0),
        hole(None),
        lift(5.0),
        drill(1.0),
    ];
    let job = job_of(steps.clone());
    let [JobStep::Move(_), JobStep::Hole(first), JobStep::Hole(second)] = &*job.operations[0].steps else {
        panic!("{:?}", job.operations[0].steps)
    };
    assert_eq!(
        (first.at, first.level, first.retract, first.bottom, first.exit),
        ([3.0, 4.0], 20.0, 5.0, 1.0, 20.0)
    );
    assert_eq!((first.kind, first.feed), (HoleKind::Plain, Some(150.0)), "the native program pecks no hole");
    assert_eq!((second.at, second.exit), ([9.0, 4.0], 20.0));
    let pecked = Job::from_programs("x", &[program(steps)], &ToolTable::default(), true).0;
    let JobStep::Hole(first) = pecked.operations[0].steps[1] else { panic!() };
    assert_eq!(first.kind, HoleKind::Peck { depth: 2.0 });
}

#[test]
fn a_hole_that_is_left_otherwise_is_moves() {
    let from_the_bottom = job_of(vec![hole(None), lift(5.0), drill(1.0), line(100.0, 9.0, 0.0, 1.0)]);
    assert!(from_the_bottom.operations[0].holes().next().is_none());
    let from_below = job_of(vec![drill(3.0), hole(None), drill(1.0), lift(20.0)]);
    assert!(from_below.operations[0].holes().next().is_none());
}

#[test]
fn the_moves_of_a_job_are_those_of_the_program() {
    let steps = vec![sweep(3.0, 4.0), hole(None), lift(5.0), drill(1.0), lift(12.0), sweep(9.0, 4.0)];
    let written = lines(&bare(""), &job_of(steps));
    let expected = [
        "G0 Z20.0",
        "G0 X0.0 Y0.0",
        "G0 X3.0 Y4.0",
        "G0 Z5.0",
        "G1 F150.0 Z1.0",
        "G0 Z12.0",
        "G0 X9.0",
        "G0 Z20.0",
    ];
    assert_eq!(written, expected);
}

fn entry(name: &str, diameter: f64, paths: Option<&str>, index: Option<u32>) -> ToolEntry {
    let paths = paths.map(|paths| Regex::new(paths).unwrap());
    let (spindle, coolant) = (Some(Turning::Clockwise), Some(Coolant::OFF));
    ToolEntry { name: name.into(), diameter, paths, index, spindle, speed: Some(9000.0), coolant }
}

#[test]
fn tools_are_found_by_diameter_and_by_the_path_s_letter() {
    let table =
        ToolTable { entries: vec![entry("any", 2.0, None, None), entry("slot", 2.0, Some("T$"), None)] };
    let name = |path: &str, diameter: f64| table.find(path, diameter).map(|entry| &*entry.name);
    assert_eq!(name("8001.1P", 2.0), Some("any"));
    assert_eq!(name("8001.1T", 2.000_001), Some("slot"));
    assert_eq!(name("8001.1T", 2.001), None);
}

#[test]
fn programs_are_joined_with_the_tools_of_the_table() {
    let table =
        ToolTable { entries: vec![entry("two", 2.0, None, Some(1)), entry("three", 3.0, None, None)] };
    let milled = |tool: f64| Program { tool, ..program(vec![line(100.0, 1.0, 0.0, 5.0)]) };
    let (job, warnings) =
        Job::from_programs("x", &[milled(3.0), milled(2.0), milled(3.0), milled(4.0)], &table, false);
    let tools: Vec<_> = job.operations.iter().map(|it| (it.tool.index, &*it.tool.name, it.speed)).collect();
    let expected =
        [(2, "three", Some(9000.0)), (1, "two", Some(9000.0)), (2, "three", Some(9000.0)), (3, "4 mm", None)];
    assert_eq!(tools, expected);
    let expected = "PB764 the tool table has no cutter with O = 4 for 8001.1P; the cutter is written as tool 3 (add the cutter as [tool.NAME] to pathbuild.toml)";
    assert_eq!(texts(&warnings), [expected]);
    assert_eq!(job.operations[0].coolant, Some(Coolant::OFF));
}

#[test]
fn without_a_table_tools_are_numbered_in_order_of_use_without_a_word() {
    let milled = |tool: f64| Program { tool, ..program(vec![line(100.0, 1.0, 0.0, 5.0)]) };
    let (job, warnings) =
        Job::from_programs("x", &[milled(3.0), milled(2.0), milled(3.0)], &ToolTable::default(), false);
    assert_eq!(job.operations.iter().map(|it| it.tool.index).collect::<Vec<_>>(), [1, 2, 1]);
    assert_eq!(warnings, []);
}

#[test]
fn remarks_for_the_machine_stand_where_they_were() {
    let mut names = Names::default();
    let question = ProgramStep::Comment(Comment::Question(names.intern("clamp?")));
    let steps = vec![line(150.0, 1.0, 0.0, 5.0), question, line(150.0, 2.0, 0.0, 5.0)];
    let job = Job::from_programs("x", &[Program { names, ..program(steps) }], &ToolTable::default(), false).0;
    assert_eq!(job.operations[0].steps[1], JobStep::Comment("Q:clamp?".into()));
}
