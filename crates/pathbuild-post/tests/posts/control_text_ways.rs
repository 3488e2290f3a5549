//! Tests rapid moves, small arcs and holes in control texts: moves that a text cannot express are retracted, written as a line, or refused.

use pathbuild_motion::Turning;
use pathbuild_post::{Entry, Hole, HoleKind, Job, JobStep, Operation, PostOptions, load};

use crate::support::{self, DIN, feed, job, operation, rapid, read_toml, texts};

/// Returns the output of a definition for a job, read back in a dialect.
#[track_caller]
fn written(definition: &str, job: &Job) -> Vec<String> {
    let options = PostOptions { dialect: Some("rs274".into()), ..PostOptions::default() };
    let output = read_toml(definition).write(job, &options);
    let output = output.unwrap_or_else(|errors| panic!("{:?}", texts(&errors)));
    String::from_utf8(output.text).unwrap().lines().map(str::to_owned).collect()
}

fn refused(definition: &str, job: &Job) -> Vec<String> {
    texts(&read_toml(definition).write(job, &PostOptions::default()).expect_err("it must be refused"))
}

fn high(steps: Vec<JobStep>) -> Job {
    let mut job = job(steps);
    job.operations[0].clearance = 25.0;
    job.operations[0].entry = Entry::At([0.0, 0.0, 25.0]);
    job.operations[0].speed = Some(1000.0);
    job
}

/// Returns the heights of rapid moves in Z alone.
fn lifts(lines: &[String]) -> Vec<&str> {
    lines.iter().filter_map(|line| line.strip_prefix("G00 Z")).collect()
}

#[test]
fn a_way_round_something_goes_over_it_or_point_for_point() {
    let round =
        [rapid(10.0, 0.0, 4.0), rapid(10.0, 40.0, 4.0), rapid(60.0, 40.0, 4.0), rapid(60.0, 0.0, 4.0)];
    let mut steps = vec![rapid(0.0, 0.0, 2.0), feed(0.0, 0.0, -1.0), feed(10.0, 0.0, -1.0)];
    steps.extend(round);
    steps.extend([feed(60.0, 0.0, -1.0), feed(70.0, 0.0, -1.0), rapid(70.0, 0.0, 25.0)]);
    let lines = written(DIN, &high(steps.clone()));
    let over = lines.iter().position(|line| line == "G00 X+60 Y+0").expect("the second contour");
    assert_eq!(lines[over - 1], "G00 Z+25", "{lines:?}");
    // A rapid move above the path's clearance is made at the height given in the program.
    steps[4] = rapid(10.0, 40.0, 30.0);
    let lines = written(DIN, &high(steps));
    let over = lines.iter().position(|line| line == "G00 X+60 Y+0").expect("the second contour");
    assert_eq!(lines[over - 1], "G00 Z+30", "{lines:?}");
    // The tool is also retracted if the rapid moves lead beyond their end or back behind their beginning, in X or in Y.
    for (beyond, end) in [
        ([70.0, 0.0], [60.0, 0.0]),
        ([5.0, 0.0], [60.0, 0.0]),
        ([10.0, 70.0], [10.0, 60.0]),
        ([10.0, -5.0], [10.0, 60.0]),
    ] {
        let steps = vec![
            rapid(0.0, 0.0, 2.0),
            feed(0.0, 0.0, -1.0),
            feed(10.0, 0.0, -1.0),
            rapid(10.0, 0.0, 4.0),
            rapid(beyond[0], beyond[1], 4.0),
            rapid(end[0], end[1], 4.0),
            feed(end[0], end[1], -1.0),
            rapid(end[0], end[1], 25.0),
        ];
        let lines = written(DIN, &high(steps));
        let there = format!("G00 X+{} Y+{}", end[0], end[1]);
        let over = lines.iter().position(|line| *line == there).expect("the second contour");
        assert_eq!(lines[over - 1], "G00 Z+25", "{beyond:?} {lines:?}");
    }
    // A straight move at the same height needs no retract.
    let straight = vec![
        rapid(0.0, 0.0, 2.0),
        feed(0.0, 0.0, -1.0),
        feed(10.0, 0.0, -1.0),
        rapid(10.0, 0.0, 4.0),
        rapid(60.0, 0.0, 4.0),
        feed(60.0, 0.0, -1.0),
        rapid(60.0, 0.0, 25.0),
    ];
    let lines = written(DIN, &high(straight));
    let over = lines.iter().position(|line| line == "G00 X+60 Y+0").expect("the second contour");
    assert_eq!(lines[over - 1], "G00 Z+4", "{lines:?}");
}

fn hole(x: f64, level: f64, kind: HoleKind) -> JobStep {
    JobStep::Hole(Hole {
        at: [x, 10.0],
        level,
        retract: 2.0,
        bottom: -0.2,
        exit: level,
        feed: Some(150.0),
        kind,
    })
}

/// Returns the definition with a text for holes.
fn with_point() -> String {
    DIN.replace(
        "contour-end =",
        "point = '''\nG00 X{+~X1~} Y{+~Y1~}\nG00 Z{+~ZWorking~}\nG01 Z{+~Z1~} F{#~LoweringVel~}\nG00 Z{+~ZClearance~}'''\ncontour-end =",
    )
}

#[test]
fn the_way_between_holes_is_as_high_as_the_program_s() {
    let steps = vec![
        rapid(20.0, 10.0, 25.0),
        rapid(20.0, 10.0, 4.0),
        hole(20.0, 4.0, HoleKind::Plain),
        rapid(20.0, 10.0, 25.0),
        rapid(110.0, 10.0, 25.0),
        rapid(110.0, 10.0, 4.0),
        hole(110.0, 4.0, HoleKind::Plain),
        rapid(110.0, 10.0, 25.0),
    ];
    let lines = written(&with_point(), &high(steps));
    let second = lines.iter().position(|line| line == "G00 X+110 Y+10").expect("the second hole");
    assert_eq!(lines[second - 1], "G00 Z+25", "{lines:?}");
}

#[test]
fn a_hole_is_left_as_high_as_the_way_behind_it() {
    let first = [rapid(20.0, 10.0, 25.0), rapid(20.0, 10.0, 4.0), hole(20.0, 4.0, HoleKind::Plain)];
    let holes = || {
        let near = [rapid(40.0, 10.0, 4.0), hole(40.0, 4.0, HoleKind::Plain)];
        first.iter().cloned().chain(near).collect::<Vec<_>>()
    };
    let mut steps = holes();
    steps.extend([rapid(40.0, 10.0, 25.0), rapid(110.0, 10.0, 25.0), rapid(110.0, 10.0, 4.0)]);
    steps.extend([hole(110.0, 4.0, HoleKind::Plain), rapid(110.0, 10.0, 25.0)]);
    let lines = written(&with_point(), &high(steps));
    let third = lines.iter().position(|line| line == "G00 X+110 Y+10").expect("the third hole");
    assert_eq!(lines[third - 1], "G00 Z+25", "{lines:?}");
    let mut steps = holes();
    steps.push(rapid(40.0, 10.0, 25.0));
    let lines = written(&with_point(), &high(steps));
    assert_eq!(lifts(&lines).last(), Some(&"+25"), "at the end too: {lines:?}");
    let near = holes();
    let mut high_exit = near.clone();
    if let Some(JobStep::Hole(last)) = high_exit.last_mut() {
        last.exit = 25.0;
    }
    for (steps, end) in [(near, "+4"), (high_exit, "+25")] {
        let lines = written(&with_point(), &high(steps));
        assert_eq!(lifts(&lines).last(), Some(&end), "where the hole itself ends: {lines:?}");
    }
}

#[test]
fn pecks_and_dwells_that_the_text_does_not_name_are_moves_or_errors() {
    let at = || rapid(20.0, 10.0, 25.0);
    let pecked = written(&with_point(), &high(vec![at(), hole(20.0, 25.0, HoleKind::Peck { depth: 0.8 })]));
    let depths: Vec<&str> = pecked.iter().filter_map(|line| line.strip_prefix("G01 Z")).collect();
    assert!(depths.len() >= 3, "each peck is written: {pecked:?}");
    let dwelling = high(vec![at(), hole(20.0, 25.0, HoleKind::Dwell { seconds: 0.5 })]);
    assert_eq!(
        refused(&with_point(), &dwelling),
        ["PB759 mill needs the text dwell, which the post does not have (add this text to the definition)"]
    );
}

fn arc(from: [f64; 3], centre: [f64; 2], to: [f64; 3]) -> JobStep {
    support::arc(false, from, centre, to, Some(100.0))
}

#[test]
fn an_arc_that_rounding_closes_is_no_circle() {
    let end = [10.0 * libm::cos(0.000_05), 10.0 * libm::sin(0.000_05), -1.0];
    let steps =
        |to| vec![rapid(10.0, 0.0, 25.0), feed(10.0, 0.0, -1.0), arc([10.0, 0.0, -1.0], [0.0; 2], to)];
    let lines = written(DIN, &high(steps(end)));
    assert!(lines.iter().all(|line| !line.starts_with("G03")), "{lines:?}");
    let lines = written(DIN, &high(steps([10.0, 0.0, -1.0])));
    assert_eq!(
        lines.iter().filter(|line| line.starts_with("G03")).count(),
        1,
        "a whole turn stays: {lines:?}"
    );
}

#[test]
fn an_arc_whose_rounded_centre_is_elsewhere_is_an_error() {
    let (sin, cos) = libm::sincos(1.0);
    let radius = 3.766;
    let from = [radius * cos + 5.0, radius * sin + 5.0, -1.0];
    let to = [5.0 - radius, 5.0, -1.0];
    let steps = vec![rapid(from[0], from[1], 25.0), feed(from[0], from[1], -1.0), arc(from, [5.0; 2], to)];
    let one_decimal = DIN.replace("[text]", "decimals = 1\n[text]");
    let found = refused(&one_decimal, &high(steps.clone()));
    assert!(found[0].starts_with("PB756 "), "{found:?}");
    written(DIN, &high(steps));
}

#[test]
fn a_tool_is_changed_above_where_the_tool_is() {
    let mill = |tool, top| {
        let steps = vec![rapid(1.0, 0.0, top), feed(1.0, 0.0, -1.0), rapid(1.0, 0.0, top)];
        Operation { clearance: top, speed: Some(1000.0), ..operation("m", tool, steps) }
    };
    let job = Job { operations: vec![mill(1, 25.0), mill(2, 5.0)], ..job(vec![]) };
    let lines = written(DIN, &job);
    let change = lines.iter().position(|line| line.starts_with("T2")).expect("a tool change");
    assert_eq!(lines[change + 1], "G00 Z+25", "{lines:?}");
    assert_eq!(lifts(&lines[..change]).last(), Some(&"+25"), "{lines:?}");
    // Even if the program itself descends first, the text begins at the height at which the text of the contour ended.
    let mut job = job;
    job.operations[0].steps.push(rapid(1.0, 0.0, 4.0));
    let lines = written(DIN, &job);
    let change = lines.iter().position(|line| line.starts_with("T2")).expect("a tool change");
    assert_eq!(lines[change + 1], "G00 Z+25", "{lines:?}");
}

#[test]
fn between_operations_the_tool_is_as_high_as_the_higher_of_them() {
    let without_contours =
        DIN.replace("contour-start = '''", "_").replace("contour-end = 'G00 Z{+~ZClearance~}'\n", "");
    let (before, after) = without_contours.split_once('_').expect("the start of contours");
    let (_, after) = after.split_once("'''").expect("its end");
    let definition = format!("{before}rapid = 'G00 X{{+~X1~}} Y{{+~Y1~}} Z{{+~Z1~}}'{after}");
    let mill = |tool, x, top| {
        let steps = vec![feed(x, 0.0, -1.0), rapid(x, 0.0, top)];
        let entry = Entry::At([x, 0.0, top]);
        Operation { clearance: top, entry, speed: Some(1000.0), ..operation("m", tool, steps) }
    };
    for (second, first_top, second_top) in [(1, 25.0, 5.0), (2, 25.0, 5.0), (2, 5.0, 25.0)] {
        let operations = vec![mill(1, 1.0, first_top), mill(second, 60.0, second_top)];
        let job = Job { operations, ..job(vec![]) };
        let lines = written(&definition, &job);
        let over = lines.iter().find(|line| line.starts_with("G00 X+60")).expect("the way over");
        assert_eq!(over, "G00 X+60 Y+0 Z+25", "{lines:?}");
        let change = lines.iter().rposition(|line| line.starts_with('T')).expect("a tool");
        assert_eq!(lines[change + 1], "G00 Z+25", "{lines:?}");
    }
}

#[test]
fn xpertmill_has_one_speed_for_each_layer() {
    let mill = |tool, speed| {
        let steps = vec![rapid(1.0, 0.0, 5.0), feed(1.0, 0.0, -1.0), rapid(1.0, 0.0, 5.0)];
        let spindle = Some(Turning::Clockwise);
        Operation { speed, spindle, ..operation("1111.1P", tool, steps) }
    };
    let write = |second, speed| {
        let job = Job { operations: vec![mill(1, Some(12_000.0)), mill(second, speed)], ..job(vec![]) };
        load("xpertmill").unwrap().write(&job, &PostOptions::default())
    };
    for (speed, expected) in [
        (Some(6000.0), "PB765 T1 runs at 12000 and, in 1111.1P, at 6000"),
        (None, "PB765 T1 runs at 12000 1/min, but for 1111.1P no speed is known"),
    ] {
        let problems = texts(&write(1, speed).unwrap_err());
        assert!(problems[0].starts_with(expected), "{problems:?}");
    }
    for (tool, speed) in [(1, 12_000.0), (2, 6000.0)] {
        let text = write(tool, Some(speed)).map(|it| String::from_utf8(it.text).unwrap());
        let text = text.unwrap_or_else(|errors| panic!("{:?}", texts(&errors)));
        assert!(text.contains(&format!("S{speed}")), "{text}");
    }
}

#[test]
fn a_program_that_ends_with_the_spindle_turning_is_refused() {
    let mut job = high(vec![rapid(0.0, 0.0, 2.0), feed(0.0, 0.0, -1.0), rapid(0.0, 0.0, 25.0)]);
    job.operations[0].spindle = Some(Turning::CounterClockwise);
    let with = |end: &str| {
        let options = PostOptions { dialect: Some("linuxcnc".into()), ..PostOptions::default() };
        read_toml(&DIN.replace("'M30'", end)).write(&job, &options)
    };
    for end in ["'M30'", "'M05'", "'M2'"] {
        assert!(with(end).is_ok(), "{end}");
    }
    let left_on = with("''").expect_err("nothing stops the spindle");
    assert!(texts(&left_on)[0].contains("PB770"), "{:?}", texts(&left_on));
    let switched_on = with("'M05 M09\nM04'".replace('\'', "'''").as_str());
    assert!(texts(&switched_on.expect_err("it is switched on again"))[0].contains("PB770"));
}

/// The tool returns from a helix within the material at feed, at the end as well as between two cuts.
#[test]
fn a_program_may_end_with_a_helical_hole() {
    let half = |from: [f64; 3], to: [f64; 3]| arc(from, [0.0; 2], to);
    let mut steps = vec![rapid(10.0, 0.0, 25.0), rapid(10.0, 0.0, 2.0), feed(10.0, 0.0, 0.0)];
    steps.extend([half([10.0, 0.0, 0.0], [-10.0, 0.0, -1.0]), half([-10.0, 0.0, -1.0], [10.0, 0.0, -2.0])]);
    steps.extend([half([10.0, 0.0, -2.0], [10.0, 0.0, -2.0])]);
    steps.extend([rapid(0.0, 0.0, -2.0), rapid(0.0, 0.0, 25.0)]);
    let lines = written(DIN, &high(steps.clone()));
    assert!(lines.contains(&"G01 X+0 Y+0 Z-2 F100".to_owned()), "{lines:?}");
    // The text of the program's end makes a cut that the job does not have.
    let more = DIN.replace("program-end = 'M30'", "program-end = '''\nG01 X+50 F100\nM30'''");
    let found = read_toml(&more)
        .write(&high(steps), &PostOptions { dialect: Some("linuxcnc".into()), ..PostOptions::default() });
    assert!(texts(&found.expect_err("a cut too many"))[0].starts_with("PB767"));
}

/// The first tool change leaves the tool at the clearance plane, above an unknown place.
#[test]
fn the_first_way_down_begins_above_its_place() {
    let rapids = |z: f64| {
        let mut job = high(vec![rapid(5.0, 3.0, z), feed(5.0, 3.0, -1.0), rapid(5.0, 3.0, 25.0)]);
        job.operations[0].entry = Entry::At([0.0, 0.0, z]);
        let output = load("xpertmill").unwrap().write(&job, &PostOptions::default());
        let output = output.unwrap_or_else(|errors| panic!("{:?}", texts(&errors)));
        let text = String::from_utf8(output.text).unwrap();
        text.lines().filter(|line| line.starts_with("G00")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(rapids(25.0)[..3], ["G00 Z25", "G00 X0 Y0 Z25", "G00 X5 Y3 Z25"]);
    assert_eq!(rapids(24.9)[..4], ["G00 Z25", "G00 X0 Y0 Z25", "G00 X0 Y0 Z24.9", "G00 X5 Y3 Z24.9"]);
}
