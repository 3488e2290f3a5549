//! The posts that come with pathbuild.

use pathbuild_post::{
    Arc, BUILT_IN, Coolant, Entry, Hole, HoleKind, Job, Language, PostOptions, Spindle, Step, load,
};

use crate::support::{feed, operation, rapid, texts};

/// Two tools; a line, an arc, a helix, a circle, two holes.
fn sample() -> Job {
    let circle = |to: [f64; 3], from: [f64; 3], clockwise| {
        Step::Arc(Arc { clockwise, from, centre: [20.0, 0.0, 0.0], to, feed: Some(250.0) })
    };
    let hole = |x: f64, kind| {
        Step::Hole(Hole {
            at: [x, 30.0],
            level: 5.0,
            retract: 1.0,
            bottom: -4.0,
            exit: 5.0,
            feed: Some(80.0),
            kind,
        })
    };
    let mut milled = operation(
        "1234.1A",
        1,
        vec![
            Step::Comment("Q:Spannpratze prüfen?".into()),
            rapid(10.0, 0.0, 5.0),
            rapid(10.0, 0.0, 0.0),
            feed(10.0, 0.0, -1.0),
            circle([20.0, 10.0, -1.0], [10.0, 0.0, -1.0], true),
            circle([10.0, 0.0, -2.0], [20.0, 10.0, -1.0], false),
            circle([10.0, 0.0, -2.0], [10.0, 0.0, -2.0], true),
            feed(0.123_45, -0.000_01, -2.0),
            rapid(0.123_45, -0.000_01, 5.0),
        ],
    );
    milled.spindle = Some(Spindle::Clockwise);
    milled.speed = Some(12_000.0);
    milled.coolant = Some(Coolant::Flood);
    let mut drilled =
        operation("1234.1B", 2, vec![hole(0.0, HoleKind::Plain), hole(8.0, HoleKind::Peck { depth: 2.0 })]);
    drilled.spindle = Some(Spindle::Clockwise);
    drilled.speed = Some(3000.0);
    drilled.coolant = Some(Coolant::Off);
    drilled.entry = Entry::At([0.0, 0.0, 5.0]);
    Job {
        name: "8001.1P".into(),
        drawing: "8001.dxf".into(),
        operations: vec![milled, drilled],
        ..Job::default()
    }
}

#[track_caller]
fn written(name: &str, options: &PostOptions<'_>) -> String {
    let post = load(name).unwrap_or_else(|errors| panic!("{name}: {:?}", texts(&errors)));
    let output =
        post.write(&sample(), options).unwrap_or_else(|errors| panic!("{name}: {:?}", texts(&errors)));
    assert_eq!(texts(&output.warnings), [""; 0], "{name}");
    String::from_utf8(output.text).unwrap().replace("\r\n", "\n")
}

#[test]
fn programs() {
    for post in BUILT_IN.iter().filter(|post| post.language != Language::Native) {
        insta::assert_snapshot!(post.name, written(post.name, &PostOptions::default()));
    }
}
