//! Tests the built-in posts.

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_motion::{Coolant, Turning};
use pathbuild_post::{
    BUILT_IN, Entry, Hole, HoleKind, Job, JobStep, Language, Operation, PostMacro, PostOptions, load,
    native_remark,
};

use crate::support::{arc, feed, operation, rapid, read, texts};

/// Returns a job with two tools, a line, an arc, a helix, a circle and two holes.
fn sample() -> Job {
    let circle = |to: [f64; 3], from: [f64; 3], clockwise| arc(clockwise, from, [20.0, 0.0], to, Some(250.0));
    let hole = |x: f64, kind| {
        JobStep::Hole(Hole {
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
            JobStep::Comment("Q:Spannpratze prüfen?".into()),
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
    milled.spindle = Some(Turning::Clockwise);
    milled.speed = Some(12_000.0);
    milled.coolant = Some(Coolant::FLOOD);
    let mut drilled =
        operation("1234.1B", 2, vec![hole(0.0, HoleKind::Plain), hole(8.0, HoleKind::Peck { depth: 2.0 })]);
    drilled.spindle = Some(Turning::Clockwise);
    drilled.speed = Some(3000.0);
    drilled.coolant = Some(Coolant::OFF);
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

/// Returns a job with probing moves onto the face of the material, as in the native probing program.
fn probing_run() -> Job {
    let text = "G17 G21 G90 G94\nT1\nG0 Z15\nG0 X0 Y0\nG0 X192 Y20\nG0 Z4\nG38.3 Z0 F40\nG4 P4\nG0 Z15\nG0 X268 Y20\nG0 Z4\nG38.3 Z0 F40\nG0 Z15\nM30\n";
    let steps = interpret(text.as_bytes(), Dialect::Native, &Options::default()).steps;
    Job::from_steps("8003.1P", &steps, Dialect::Native, &native_remark)
        .unwrap_or_else(|errors| panic!("{:?}", texts(&errors)))
}

#[test]
fn each_control_probes_in_its_own_words() {
    for (name, word) in [
        ("grbl", "G38.2 F40.0 X192.0 Y20.0 Z0.0"),
        ("linuxcnc", "G38.2 F40.0 X192.0 Y20.0 Z0.0"),
        ("mach3", "G31 F40.0 X192.0 Y20.0 Z0.0"),
        ("fanuc", "G31 F40.0 X192.0 Y20.0 Z0.0"),
        ("haas", "G31 F40.0 X192.0 Y20.0 Z0.0"),
        ("marlin", "G38.2 F40.0 X192.0 Y20.0 Z0.0"),
    ] {
        let output = load(name).unwrap().write(&probing_run(), &PostOptions::default());
        let output = output.unwrap_or_else(|errors| panic!("{name}: {:?}", texts(&errors)));
        let text = String::from_utf8(output.text).unwrap().replace("\r\n", "\n");
        let found: Vec<&str> =
            text.lines().filter(|line| line.contains("G3") && line.contains('Z')).collect();
        assert_eq!(found.len(), 2, "{name}: {text}");
        assert_eq!(found[0], word, "{name}");
    }
    let errors = load("xpertmill").unwrap().write(&probing_run(), &PostOptions::default()).unwrap_err();
    assert_eq!(
        texts(&errors),
        [
            "PB759 8003.1P needs the text probe, which the post does not have (add this text to the definition)"
        ]
    );
}

#[test]
fn mach3_dwells_as_its_machine_is_set() {
    let dwell = |milliseconds| {
        let options = PostOptions { milliseconds, spin_up: 2.5, ..PostOptions::default() };
        let text = written("mach3", &options);
        text.lines().find(|line| line.starts_with("G4")).map(str::to_owned)
    };
    assert_eq!(dwell(false).as_deref(), Some("G4 P2.5"));
    assert_eq!(dwell(true).as_deref(), Some("G4 P2500.0"));
    let options = PostOptions { milliseconds: true, spin_up: 2.5, ..PostOptions::default() };
    assert!(written("linuxcnc", &options).contains("\nG4 P2.5\n"), "seconds on every machine");
}

/// P is in milliseconds on Fanuc, and has no decimal point there.
#[test]
fn fanuc_dwells_in_milliseconds() {
    let hole = |seconds| {
        let kind = HoleKind::Dwell { seconds };
        let hole = Hole {
            at: [5.0, 5.0],
            level: 5.0,
            retract: 1.0,
            bottom: -4.0,
            exit: 5.0,
            feed: Some(80.0),
            kind,
        };
        let steps = vec![JobStep::Hole(hole), JobStep::Dwell { seconds: 0.25 }];
        let turning = Some(Turning::Clockwise);
        Operation { spindle: turning, speed: Some(3000.0), ..operation("1234.1P", 1, steps) }
    };
    let dwells = |name: &str, seconds| {
        let job = Job { name: "1.1P".into(), operations: vec![hole(seconds)], ..Job::default() };
        let options = PostOptions { cycles: true, ..PostOptions::default() };
        let output = load(name).unwrap().write(&job, &options);
        let text = output.unwrap_or_else(|errors| panic!("{name}: {:?}", texts(&errors))).text;
        let text = String::from_utf8(text).unwrap();
        let words = text.lines().filter(|line| line.starts_with("G4 ") || line.starts_with("G82 "));
        words
            .filter_map(|line| line.split(' ').rfind(|word| word.starts_with(['P', 'X'])).map(str::to_owned))
            .collect()
    };
    let of_fanuc: Vec<String> = dwells("fanuc", 0.5);
    assert_eq!(of_fanuc, ["P500", "X0.25"]);
    assert_eq!(dwells("haas", 0.5), ["P0.5", "P0.25"], "seconds with a decimal point");
    assert_eq!(dwells("linuxcnc", 0.5), ["P0.5", "P0.25"]);
}

/// After a manual tool change, the tip is on the stock or wherever the tool was changed.
#[test]
fn the_new_tool_moves_up_first_where_it_is_changed_by_hand() {
    for (name, change) in [("grbl", "M0 "), ("marlin", "M0 "), ("estlcam", "T2 M6")] {
        let text = written(name, &PostOptions::default());
        let after = text.lines().skip_while(|line| !line.starts_with(change));
        let first = after.clone().find(|line| line.starts_with("G0")).expect("a rapid move");
        assert!(first.contains("Z5.0") && !first.contains('X') && !first.contains('Y'), "{name}: {first}");
    }
}

#[test]
fn a_tool_is_changed_where_the_owner_says() {
    let change = |name: &str, macros: Vec<PostMacro>| {
        let text = written(name, &PostOptions { macros, ..PostOptions::default() });
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let stop = lines.iter().position(|line| line.starts_with("M0")).expect("a stop");
        [lines[stop - 2].clone(), lines[stop - 1].clone(), lines[stop].clone()]
    };
    let park = |value: &str| vec![PostMacro { name: "park".into(), value: value.into() }];
    assert_eq!(
        change("grbl", Vec::new()),
        ["M5", "M9", "M0 (Insert T2: 3.0 cutter, set Z zero)"],
        "it stays where it is"
    );
    assert_eq!(
        change("grbl", park("G53 G0 X-10 Y-10")),
        ["M9", "G53 G0 X-10 Y-10", "M0 (Insert T2: 3.0 cutter, set Z zero)"]
    );
    assert_eq!(
        change("marlin", park("G0 F1000 X0 Y200")),
        ["G0 F1000 X0 Y200", ";Insert T2: 3.0 cutter", "M0 Insert T2, set Z zero"]
    );
}

#[test]
fn the_spindle_stands_at_m6_of_estlcam() {
    let text = BUILT_IN.iter().find(|post| post.name == "estlcam").unwrap().text;
    let errors = |text: &str| {
        let written = read(text).unwrap().write(&sample(), &PostOptions::default());
        texts(&written.err().unwrap_or_default())
    };
    assert_eq!(errors(text), [""; 0]);
    // The first occurrence is that of the tool change.
    let found = errors(&text.replacen("{$spindle(off)}\n", "", 1));
    assert!(found.len() == 1 && found[0].contains("the spindle still turns"), "{found:?}");
}

#[test]
fn programs_of_several_paths_have_the_number_of_the_first() {
    let head = |name: &str, number: Option<u32>| {
        let job = Job { name: name.into(), ..sample() };
        let options = PostOptions { program_number: number, ..PostOptions::default() };
        let text = load("haas").unwrap().write(&job, &options).map(|output| output.text);
        let text = String::from_utf8(text.unwrap_or_else(|errors| panic!("{:?}", texts(&errors)))).unwrap();
        text.lines().nth(1).unwrap_or_default()[..5].to_owned()
    };
    assert_eq!(head("8001.1P", None), "O8001");
    assert_eq!(head("BOTH", None), "O1234");
    assert_eq!(head("0000.1P", None), "O1234", "0 is no program number");
    assert_eq!(head("BOTH", Some(77)), "O0077");
}
