//! Tests parsed programs as jobs, and built-in posts against the native program.

use pathbuild_diagnostic::Lang;
use pathbuild_gcode::dialect::{Charset, Dialect};
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::native::{self, WriteOptions};
use pathbuild_gcode::verify::{Ends, Tolerance, compare};
use pathbuild_motion::{Coolant, Turning};
use pathbuild_post::{
    BUILT_IN, Entry, Hole, HoleKind, Job, JobStep, Language, PostDefinition, PostOptions, Remark, ToolTable,
    altered_word_warnings, load, native_remark,
};
use pathbuild_toolpath::{
    Comment, Count, ElementKind, Height, MoveClass, Names, PlannedMove, Program, ProgramStep, Xy,
};

use crate::support::{rapid, straight_from_anywhere, texts};

fn read(text: &str) -> Job {
    let steps = interpret(text.as_bytes(), Dialect::LinuxCnc, &Options::default()).steps;
    match Job::from_steps("job", &steps, Dialect::LinuxCnc, &|_| Remark::Stays) {
        Ok(job) => job,
        Err(errors) => panic!("{}", texts(&errors).join("\n")),
    }
}

#[test]
fn a_program_without_tools_is_one_operation() {
    let job = read("G21 G90\nG0 Z5\nG0 X1 Y2\nG1 Z-1 F60\nG1 X9 F200\nG0 Z5\nM2\nG0 X99");
    let [operation] = &*job.operations else { panic!("{:?}", job.operations) };
    let known_in_part = JobStep::rapid([None, None, Some(5.0)]);
    let cut = |to: [f64; 3], feed| JobStep::feed(to, Some(feed));
    let down = cut([1.0, 2.0, -1.0], 60.0);
    let expected =
        [known_in_part, rapid(1.0, 2.0, 5.0), down, cut([9.0, 2.0, -1.0], 200.0), rapid(9.0, 2.0, 5.0)];
    assert_eq!(straight_from_anywhere(&operation.steps), expected, "nothing is read behind the end");
    assert_eq!((operation.clearance, operation.entry), (5.0, Entry::Clearance));
    assert_eq!(
        (operation.plunge_feed, operation.cut_feed, operation.target_depth),
        (Some(60.0), Some(200.0), Some(-1.0))
    );
}

#[test]
fn tools_spindle_and_coolant_divide_operations() {
    let job = read(
        "G21 G90 G0 X0 Y0 Z5\nT2 M6\nM3 S900\nG1 Z-1 F60\nG0 Z5\nT3\nG1 X1 F60\nG0 X0 Y0\nT3 M6\nM3\nM8\nG1 Z-1\nM4\nG1 X5\nG0 Z5\nM5\nM9",
    );
    let found: Vec<_> =
        job.operations.iter().map(|it| (it.tool.index, it.spindle, it.speed, it.coolant)).collect();
    let (cw, ccw, flood) = (Some(Turning::Clockwise), Some(Turning::CounterClockwise), Some(Coolant::FLOOD));
    let speed = Some(900.0);
    assert_eq!(
        found,
        [(2, cw, speed, None), (3, cw, speed, flood), (3, ccw, speed, flood)],
        "T alone only preselects"
    );
    assert_eq!(
        job.operations[1].entry,
        Entry::At([0.0, 0.0, 5.0]),
        "the way to the tool change is the post's"
    );
}

#[test]
fn t_alone_changes_the_tool_where_there_is_no_m6() {
    let job = read("G21 G90 G0 X0 Y0 Z5\nT2\nG1 Z-1 F60\nG0 Z5\nT3\nG1 Z-2\n");
    assert_eq!(job.operations.iter().map(|it| it.tool.index).collect::<Vec<_>>(), [2, 3]);
}

#[test]
fn remarks_say_where_operations_begin_and_end() {
    let text = "G21 G90\nG0 X0 Y0 Z5\n(START Subpath A)\n(Q:a)\nG1 Z-1 F60\n(START Subpath B)\nG1 X1\n(END Subpath B)\nG1 X2\n(END Subpath A)\nG1 X3\nG0 Z5\nM30";
    let steps = interpret(text.as_bytes(), Dialect::Native, &Options::default()).steps;
    let job = Job::from_steps("outer", &steps, Dialect::Native, &native_remark).unwrap();
    let names: Vec<_> = job.operations.iter().map(|it| (&*it.name, it.steps.len())).collect();
    assert_eq!(names, [("A", 3), ("B", 1), ("A", 1), ("outer", 2)]);
    assert_eq!(job.operations[0].steps[1], JobStep::Comment("Q:a".into()));
}

#[test]
fn waits_stay() {
    let job = read("G21 G90 G0 X0 Y0 Z5\nG1 Z-1 F60\nG4 P2.5\nM0\nG1 X1");
    assert_eq!(job.operations[0].steps[2..4], [JobStep::Dwell { seconds: 2.5 }, JobStep::Stop]);
}

fn holes(cycles: &str) -> Vec<Hole> {
    read(&format!("G21 G90 G0 X0 Y0 Z5\n{cycles}\nG80\nG0 Z9")).operations[0].holes().copied().collect()
}

#[test]
fn cycles_are_holes() {
    let hole = |x, exit, kind| Hole {
        at: [x, 0.0],
        level: 5.0,
        retract: 1.0,
        bottom: -3.0,
        exit,
        feed: Some(60.0),
        kind,
    };
    let plain = HoleKind::Plain;
    let two = [hole(2.0, 5.0, plain), hole(4.0, 5.0, plain)];
    assert_eq!(holes("G98 G81 X2 Z-3 R1 F60\nX4"), two);
    assert_eq!(holes("G98 G81 X0 Z-3 R1 F60")[0].at, [0.0, 0.0], "also where the tool is");
    assert_eq!(holes("G98 G82 X2 Z-3 R1 P1.5 F60"), [hole(2.0, 5.0, HoleKind::Dwell { seconds: 1.5 })]);
    assert_eq!(holes("G98 G83 X2 Z-3 R1 Q1.5 F60"), [hole(2.0, 5.0, HoleKind::Peck { depth: 1.5 })]);
    assert_eq!(holes("G98 G81 X2 Z-3 R1 F60\nG80\nG0 X9\nG1 X12 F100"), two[..1], "and what comes behind it");
    let next = Hole { level: 1.0, ..hole(4.0, 1.0, plain) };
    assert_eq!(holes("G99 G81 X2 Z-3 R1 F60\nX4"), [hole(2.0, 1.0, plain), next]);
}

#[test]
fn cycles_of_other_kinds_are_moves() {
    assert_eq!(holes("G98 G73 X2 Z-3 R1 Q1 F60"), [], "it does not leave the hole");
    assert_eq!(holes("G98 G85 X2 Z-3 R1 F60"), [], "it comes out by feed");
    assert_eq!(holes("G1 Z-3 F60\nG0 Z5"), []);
}

#[test]
fn what_a_job_cannot_say_is_an_error_with_its_line() {
    let errors = |text: &str| {
        let steps = interpret(text.as_bytes(), Dialect::LinuxCnc, &Options::default()).steps;
        texts(&Job::from_steps("job", &steps, Dialect::LinuxCnc, &|_| Remark::Stays).unwrap_err())
    };
    let start = "G21 G90 G54 G0 X0 Y0 Z5\n";
    assert!(
        errors(&format!("{start}G28"))[0]
            .starts_with("2: PB765 a move to a position that only the machine knows")
    );
    assert!(
        errors(&format!("{start}G55 G0 X1"))[0]
            .starts_with("2: PB765 G55 selects a work offset, which a post does not write")
    );
    assert!(errors("G21 G90 G57 G0 X0 Y0 Z5\n")[0].starts_with("1: PB765 G57 selects"), "a single one");
    assert!(errors(&format!("{start}G2 X0 Y0 I5 P2 F60"))[0].starts_with("2: PB765 a move of this kind"));
}

/// Returns the job of a program in a dialect, or the errors that prevent it.
fn job_of(text: &str, dialect: Dialect) -> Result<Job, Vec<String>> {
    let steps = interpret(text.as_bytes(), dialect, &Options::default()).steps;
    Job::from_steps("job", &steps, dialect, &|_| Remark::Stays).map_err(|errors| texts(&errors))
}

#[track_caller]
fn is_zero_refused(text: &str, dialect: Dialect, line: u32, word: &str) {
    let errors = job_of(text, dialect).expect_err(text);
    let expected = format!("{line}: PB765 {word} sets a zero or a tool length at the machine");
    assert!(errors[0].starts_with(&expected), "{text}: {errors:?}");
}

const HEAD: &str = "G21 G90 G17 G94 G54\n";
const CUT: &str = "M3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20\n";

#[test]
fn a_zero_that_a_probe_has_found_is_an_error() {
    let probe = format!("{HEAD}G0 Z30\nG0 X50 Y50\nG38.2 Z-20 F50\n");
    for (word, name) in [("G10 L20 P1 Z15", "G10"), ("G10 L20 P0 Z15", "G10"), ("G92 Z15", "G92")] {
        for dialect in [Dialect::LinuxCnc, Dialect::Grbl] {
            is_zero_refused(&format!("{probe}{word}\nG0 Z30\n{CUT}"), dialect, 5, name);
            // A program that only sets a zero is refused as well, because a post would not write that.
            is_zero_refused(&format!("{probe}{word}\nM30"), dialect, 5, name);
            // The probe was along Z, and after an absolute height Z is known again.
            let known = word.replace("Z15", "X50");
            assert!(job_of(&format!("{probe}{known}\nG0 Z30\n{CUT}"), dialect).is_ok(), "{known}");
            assert!(job_of(&format!("{probe}G0 Z30\n{word}\n{CUT}"), dialect).is_ok(), "{word}");
        }
    }
}

#[test]
fn a_zero_that_the_program_sets_before_its_first_move_is_an_error() {
    for (word, name) in [
        ("G10 L2 P1 X50 Y60 Z-70", "G10"),
        ("G10 L2 P0 X0", "G10"),
        ("G10 L20 P1 X0 Y0 Z0", "G10"),
        ("G92 X0 Y0 Z0", "G92"),
        ("G92 Z2", "G92"),
    ] {
        is_zero_refused(&format!("{HEAD}{word}\n{CUT}"), Dialect::LinuxCnc, 2, name);
        is_zero_refused(&format!("{HEAD}{word}\n{CUT}"), Dialect::Grbl, 2, name);
    }
    is_zero_refused(&format!("{HEAD}G52 X10 Y0\n{CUT}"), Dialect::Fanuc, 2, "G52");
    assert!(job_of(&format!("{HEAD}G52 X0 Y0 Z0\n{CUT}"), Dialect::Fanuc).is_ok());
    assert!(job_of(&format!("{HEAD}G92.1\n{CUT}"), Dialect::LinuxCnc).is_ok());
    // A system that the program does not use keeps its zero only if the output sets it too.
    is_zero_refused(&format!("{HEAD}{CUT}G10 L20 P2 X0\n"), Dialect::LinuxCnc, 7, "G10");
}

#[test]
fn a_zero_set_where_the_tool_is_known_to_be_is_followed() {
    for word in ["G92 X0", "G10 L20 P1 X0", "G52 X20"] {
        let job = job_of(&format!("{HEAD}{CUT}{word}\nG1 X5\n"), Dialect::LinuxCnc);
        let job = job.unwrap_or_else(|errors| panic!("{word}: {errors:?}"));
        let last = job.operations[0].steps.last();
        assert!(matches!(last, Some(JobStep::Move(movement)) if movement.to.x() == 25.0), "{word}: {last:?}");
    }
    // G10 L2 is relative to the machine's zero, and the tool's position in the machine is unknown.
    is_zero_refused(&format!("{HEAD}{CUT}G10 L2 P1 X0\n"), Dialect::LinuxCnc, 7, "G10");
    // At a stop and at a tool change, the axes may be moved.
    for stop in ["M0", "T2 M6"] {
        is_zero_refused(&format!("{HEAD}{CUT}G0 Z5\n{stop}\nG92 Z0\n"), Dialect::LinuxCnc, 9, "G92");
        let stated = format!("{HEAD}{CUT}G0 Z5\n{stop}\nG0 Z6\nG92 Z0\nG0 Z5\n");
        assert!(job_of(&stated, Dialect::LinuxCnc).is_ok(), "{stop}");
    }
}

#[test]
fn a_length_that_the_program_states_before_its_first_cut_is_an_error() {
    for dialect in [Dialect::Grbl, Dialect::LinuxCnc] {
        is_zero_refused(&format!("{HEAD}G43.1 Z7\n{CUT}"), dialect, 2, "G43.1");
        let job = job_of(&format!("{HEAD}G49\n{CUT}G43.1 Z7\nG1 Z-1\n"), dialect).expect("followed");
        let last = job.operations[0].steps.last();
        assert!(matches!(last, Some(JobStep::Move(movement)) if movement.to.z() == 6.0), "{last:?}");
        // Another tool has another length.
        is_zero_refused(&format!("{HEAD}G49\n{CUT}M0\nG43.1 Z7\nG0 Z5\n{CUT}"), dialect, 9, "G43.1");
    }
}

#[test]
fn a_lift_from_where_a_probe_has_stopped_is_an_error() {
    let probe = format!("{HEAD}G0 Z30\nG0 X50 Y50\nG38.2 Z-20 F50\n");
    let errors = job_of(&format!("{probe}G91 G0 Z30\nG90\n{CUT}"), Dialect::Grbl).unwrap_err();
    assert!(errors[0].starts_with("5: PB765 this move counts from a position that only"), "{errors:?}");
    for known in ["G0 Z30", "G91 G0 X5", "G91 G0 Z0"] {
        assert!(job_of(&format!("{probe}{known}\nG90\n{CUT}"), Dialect::Grbl).is_ok(), "{known}");
    }
    // At the start, too, the program does not know where the tool is.
    let errors = job_of(&format!("{HEAD}G91 G0 Z5\nG90\n{CUT}"), Dialect::Grbl).unwrap_err();
    assert!(errors[0].starts_with("2: PB765 this move counts"), "{errors:?}");
}

/// Returns the words of the spindle, of the coolant, and of stops and dwells in the output of a post.
#[track_caller]
fn switches(text: &str, post: &str) -> Vec<String> {
    let lines = posted(text, Dialect::LinuxCnc, post).unwrap_or_else(|errors| panic!("{text}{errors:?}"));
    let is_switch = |line: &String| line.starts_with(['M', 'S']) || line.starts_with("G4 ");
    lines
        .into_iter()
        .filter(is_switch)
        .map(|line| line.split(" (").next().unwrap_or_default().to_owned())
        .collect()
}

#[test]
fn the_spindle_stands_still_at_stops_where_it_does_in_the_source() {
    let around = |stop: &str| {
        format!(
            "G21 G90 G17\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X9\nG0 Z5\n{stop}\nG0 X0 Y20\nG1 Z-1\nG0 Z5\nM5\nM30\n"
        )
    };
    for post in ["linuxcnc", "grbl", "mach3"] {
        for stop in ["M0", "M1", "M60"] {
            let found = switches(&around(&format!("M5\n{stop}\nM3")), post);
            assert_eq!(found[..4], ["M3 S9000", "M5", "M0", "M3 S9000"], "{post} {stop}: {found:?}");
            let found = switches(&around(&format!("M5\n{stop}\nM3 S8000")), post);
            assert_eq!(found[..4], ["M3 S9000", "M5", "M0", "M3 S8000"], "{post} {stop}: {found:?}");
        }
        let found = switches(&around("M0"), post);
        assert_eq!(found[..3], ["M3 S9000", "M0", "M5"], "{post}: as in the source");
        let found = switches(&around("M5\nM3"), post);
        assert_eq!(found[..2], ["M3 S9000", "M5"], "{post}: nothing waits for it");
        let found = switches(&around("M5\nG4 P30\nM3\nG4 P2"), post);
        assert_eq!(found[..5], ["M3 S9000", "M5", "G4 P30.0", "M3 S9000", "G4 P2.0"], "{post}: {found:?}");
        let found = switches(&around("M5 M9\nM0\nM3").replace("S9000", "S9000\nM8"), post);
        assert_eq!(found[..5], ["M3 S9000", "M8", "M5", "M9", "M0"], "{post}: {found:?}");
        // If a stop comes before M3, the spindle starts after that stop.
        let found = switches(&around("M0").replace("M3 S9000", "M0\nM3 S9000"), post);
        assert_eq!(found[..4], ["M5", "M9", "M0", "M3 S9000"], "{post}: {found:?}");
    }
}

#[test]
fn a_definition_whose_spindle_turns_at_such_a_stop_is_refused() {
    let built_in = BUILT_IN.iter().find(|post| post.name == "linuxcnc").expect("a built-in post");
    let text = "G21 G90 G17\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG0 Z5\nM5\nM0\nM3\nG0 X9\nG1 Z-1\nG0 Z5\nM5\nM30\n";
    let written = |stop: &str, text: &str| {
        let definition = built_in.text.replace("<Footer>", &format!("<Stop>{stop}</Stop>\n<Footer>"));
        let definition = PostDefinition::read(definition.as_bytes(), "x.cbpp".into()).expect("a definition");
        let output = definition.write(&read(text), &PostOptions::default());
        output.map_err(|errors| format!("{} {}", errors[0].code(), errors[0].notes[0].text(Lang::En)))
    };
    assert!(written("M0", text).is_ok());
    let found = written("M3\nM0", text).unwrap_err();
    assert!(found.starts_with("PB767 the spindle turns at this stop"), "{found}");
    assert!(written("M3\nM0", &text.replace("M5\nM0", "M0")).is_ok(), "it turns in the source too");
}

#[test]
fn the_cutter_is_raised_before_the_spindle_is_switched_off() {
    let text = |z: &str, wait: &str| {
        format!(
            "G21 G90 G17\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z{z} F100\nG1 X10\n{wait}\nM3\nG1 X20\nG0 Z5\nM5\nM30\n"
        )
    };
    for post in ["linuxcnc", "grbl", "mach3"] {
        for wait in ["M5\nM0", "M5\nG4 P2"] {
            let errors = posted(&text("-1", wait), Dialect::LinuxCnc, post).unwrap_err();
            assert!(
                errors[0].starts_with("PB765 1001 goes on at Z -1, below the surface at 0"),
                "{errors:?}"
            );
            assert!(posted(&text("0", wait), Dialect::LinuxCnc, post).is_ok());
            let raised = text("-1", wait).replace("G1 X20", "G0 Z5\nG0 X20\nG1 Z-1");
            assert!(posted(&raised, Dialect::LinuxCnc, post).is_ok());
        }
        assert!(posted(&text("-1", "M0"), Dialect::LinuxCnc, post).is_ok(), "the spindle turns");
    }
}

#[test]
fn a_post_that_cannot_switch_the_spindle_off_refuses_such_a_wait() {
    let text = |wait: &str| {
        format!(
            "G21 G90 G17\nT1 M6\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG0 Z5\n{wait}\nG0 X9\nG1 Z-1\nG0 Z5\nM5\nM30\n"
        )
    };
    let errors = posted(&text("M5\nG4 P30\nM3"), Dialect::LinuxCnc, "din").unwrap_err();
    assert!(errors[0].starts_with("PB765 1001 switches the spindle off"), "{errors:?}");
    assert!(posted(&text("G4 P30"), Dialect::LinuxCnc, "din").is_ok());
}

#[test]
fn each_tool_has_one_length_with_its_own_number() {
    let head = "G21 G90 G17\n";
    let is_refused = |text: &str, line: u32| {
        let errors = job_of(&format!("{head}{text}"), Dialect::LinuxCnc).expect_err(text);
        let start =
            format!("{line}: PB765 cuts after this line use a tool length (H) that a post cannot write");
        assert!(errors[0].starts_with(&start), "{text}: {errors:?}");
    };
    is_refused(&format!("T1 M6\nG43 H5\n{CUT}"), 3);
    is_refused(&format!("G43\n{CUT}"), 2);
    is_refused(&format!("T1 M6\nG43 H1\n{CUT}G43 H2\nG1 X9\n"), 9);
    is_refused(&format!("T1 M6\nG43 H1\n{CUT}G49\nG1 X9\n"), 9);
    is_refused(&format!("T1 M6\nG49\n{CUT}G43\nG1 X9\n"), 9);
    is_refused(&format!("T1 M6\nG43 H1\n{CUT}M0\nG49\nG1 X9\n"), 10);
    for fine in [
        format!("T1 M6\nG43\n{CUT}"),
        format!("T1 M6\nG43 H1\n{CUT}G0 Z5\nG49\nT2 M6\nG43 H2\n{CUT}"),
        format!("T1 M6\nG49\n{CUT}G0 Z5\nM30"),
        format!("T1 M6\nG43 H1\n{CUT}G0 Z5\nG49\nM30"),
    ] {
        assert!(job_of(&format!("{head}{fine}"), Dialect::LinuxCnc).is_ok(), "{fine}");
    }
}

#[test]
fn words_that_posts_replace_are_told_once() {
    let told = |text: &str| {
        let steps = interpret(text.as_bytes(), Dialect::LinuxCnc, &Options::default()).steps;
        texts(&altered_word_warnings(&steps)).join("\n")
    };
    assert_eq!(told("G21 G90\nM0\nM7\nM9\nM8\nG38.2 Z-1 F9"), "");
    let found = told("G21 G90\nM1\nM1\nM60\nM7\nM8\nG38.3 Z-1 F9");
    let lines: Vec<&str> = found.lines().collect();
    for (line, start) in lines.iter().zip([
        "2: PB778 M1 is written as M0",
        "4: PB778 M60 is written as M0",
        "6: PB778 M7 M8 is written as M8",
        "7: PB778 G38.3 is written as G38.2",
    ]) {
        assert!(line.starts_with(start), "{found}");
    }
    assert_eq!(lines.len(), 4, "{found}");
}

/// Returns a step that makes a move. The length stated for it has no effect, as long as it exceeds the length of arcs that become lines.
fn go(to: PlannedMove) -> ProgramStep {
    ProgramStep::Move { to, count: Count { class: MoveClass::Milling, length: 99.0, feed: None } }
}

fn height(z: f64) -> Height {
    Height { z, at: Xy::new(0.0, 0.0) }
}

/// Returns a program with lines, bars, arcs, a helical circle and holes, in two embedded paths.
fn program() -> Program {
    let mut names = Names::default();
    let (a, b, clamp) = (names.intern("1234.1A"), names.intern("1234.2B"), names.intern("Spannpratze?"));
    let sweep = |x: f64, y: f64| go(PlannedMove::Sweep { to: Xy::new(x, y) });
    let lift = |z| go(PlannedMove::Lift { z: height(z) });
    let drill = |z| go(PlannedMove::Drill { feed: 150.0, z: height(z) });
    let line = |x: f64, y: f64, z| go(PlannedMove::Line { feed: 220.5, to: Xy::new(x, y), z: height(z) });
    let arc = |clockwise, centre: [f64; 2], to: [f64; 2], z, is_spiral| {
        let (centre, to) = (Xy::new(centre[0], centre[1]), Xy::new(to[0], to[1]));
        // The arc covers one radian at a radius of 10 mm, or half a circle with a radius of 5 mm.
        let length = if is_spiral { 5.0 * std::f64::consts::PI } else { 10.0 };
        let to = PlannedMove::Arc { feed: 180.0, clockwise, centre, to, z: height(z), is_spiral };
        ProgramStep::Move { to, count: Count { class: MoveClass::Milling, length, feed: None } }
    };
    let hole = |peck| {
        let at = Xy::new(0.0, 0.0);
        ProgramStep::Comment(Comment::Element {
            kind: ElementKind::DrilledHole,
            at,
            bottom: 1.0,
            surface: 6.0,
            cutter: 3.0,
            peck,
        })
    };
    let steps = vec![
        lift(20.0),
        ProgramStep::Comment(Comment::StartSubpath(a)),
        sweep(10.0 / 3.0, -7.123_456),
        lift(6.0),
        drill(4.5),
        ProgramStep::Comment(Comment::Question(clamp)),
        line(30.0, -7.123_456, 4.5),
        line(31.5, -7.123_456, 6.0),
        line(33.0, -7.123_456, 4.5),
        arc(
            false,
            [0.0, 10.0],
            [33.0 + 10.0 * libm::sin(1.0), 2.876_544 - 10.0 * libm::cos(1.0)],
            4.5,
            false,
        ),
        drill(3.0),
        lift(11.0),
        ProgramStep::Comment(Comment::EndSubpath(a)),
        ProgramStep::Comment(Comment::StartSubpath(b)),
        lift(20.0),
        sweep(50.0, 45.0),
        lift(6.0),
        arc(true, [0.0, 5.0], [50.0, 55.0], 5.0, true),
        arc(true, [0.0, -5.0], [50.0, 45.0], 4.0, true),
        arc(true, [0.0, 5.0], [50.0, 55.0], 4.0, true),
        arc(true, [0.0, -5.0], [50.0, 45.0], 4.0, true),
        sweep(50.0, 50.0),
        lift(20.0),
        sweep(70.0, 0.0),
        hole(Some(2.0)),
        lift(6.0),
        drill(1.0),
        lift(20.0),
        sweep(80.0, 0.0),
        hole(None),
        lift(6.0),
        drill(1.0),
        ProgramStep::Comment(Comment::EndSubpath(b)),
    ];
    let (path, drawing) = ("8001.1P".into(), "8001.dxf".into());
    Program {
        path,
        drawing,
        tool: 2.0,
        sweep_height: 20.0,
        thickness: 6.0,
        names,
        steps,
        ..Program::default()
    }
}

/// Returns the dialect in which the output of a built-in post is read.
fn reader(post: &str) -> Dialect {
    match post {
        "grbl" | "marlin" => Dialect::Grbl,
        "xpertmill" => Dialect::Xpertmill,
        _ => Dialect::LinuxCnc,
    }
}

#[track_caller]
fn assert_moves_alike(name: &str, text: &[u8], program: &Program) {
    let read = interpret(text, reader(name), &Options::default());
    // The native program has three decimals, and XpertMILL's post writes a helix as chords.
    let tolerance = Tolerance { chord: 0.01, ends: Ends::Cutting, ..Tolerance::of_decimals(3) };
    if let Some(difference) = compare(&read.moves(), &program.moves().collect::<Vec<_>>(), &tolerance) {
        panic!("{name}: {}\n{}", difference.diagnostic().text(Lang::En), String::from_utf8_lossy(text));
    }
}

fn definitions() -> impl Iterator<Item = &'static str> {
    BUILT_IN.iter().filter(|post| post.language != Language::Native).map(|post| post.name)
}

#[test]
fn built_in_posts_move_as_the_native_program() {
    let program = program();
    let (job, _) =
        Job::from_programs("8001.1P", std::slice::from_ref(&program), &ToolTable::default(), false);
    let mut compared = 0;
    for name in definitions() {
        let options = PostOptions { manual_spindle: true, ..PostOptions::default() };
        let output = load(name).unwrap().write(&job, &options);
        let output = output.unwrap_or_else(|errors| panic!("{name}: {}", texts(&errors).join("\n")));
        assert_moves_alike(name, &output.text, &program);
        compared += 1;
    }
    assert_eq!(compared, 9);
}

#[test]
fn built_in_posts_with_cycles_move_as_the_native_program() {
    let program = program();
    let (job, _) =
        Job::from_programs("8001.1P", std::slice::from_ref(&program), &ToolTable::default(), false);
    let options = PostOptions { cycles: true, manual_spindle: true, ..PostOptions::default() };
    for name in ["linuxcnc", "mach3", "fanuc", "haas"] {
        let output = load(name).unwrap().write(&job, &options);
        let output = output.unwrap_or_else(|errors| panic!("{name}: {}", texts(&errors).join("\n")));
        assert!(String::from_utf8(output.text.clone()).unwrap().contains("G81 X"), "{name}");
        assert_moves_alike(name, &output.text, &program);
    }
}

#[test]
fn a_native_program_that_is_read_comes_out_of_every_post_with_the_same_moves() {
    let program = program();
    let options = WriteOptions {
        lang: Lang::En,
        charset: Charset::Ascii,
        rapid: 1000.0,
        correction: pathbuild_toolpath::Correction::default(),
    };
    let text = native::write_program(&program, "", &options, usize::MAX).unwrap();
    let read = interpret(text.as_bytes(), Dialect::Native, &Options::default());
    let job = Job::from_steps("8001.1P", &read.steps, Dialect::Native, &native_remark).unwrap();
    assert_eq!(job.operations.iter().map(|it| &*it.name).collect::<Vec<_>>(), ["1234.1A", "1234.2B"]);
    for name in definitions() {
        let options = PostOptions { manual_spindle: true, ..PostOptions::default() };
        let output = load(name).unwrap().write(&job, &options);
        let output = output.unwrap_or_else(|errors| panic!("{name}: {}", texts(&errors).join("\n")));
        assert_moves_alike(name, &output.text, &program);
    }
}

/// Returns the output of a built-in post for a program in a dialect.
fn posted(text: &str, dialect: Dialect, post: &str) -> Result<Vec<String>, Vec<String>> {
    let steps = interpret(text.as_bytes(), dialect, &Options::default()).steps;
    let mut job =
        Job::from_steps("1001", &steps, dialect, &|_| Remark::Stays).map_err(|errors| texts(&errors))?;
    job.set_surface(0.0);
    let output =
        load(post).unwrap().write(&job, &PostOptions { needs_speed: true, ..PostOptions::default() });
    let output = output.map_err(|errors| texts(&errors))?;
    Ok(String::from_utf8(output.text).unwrap().lines().map(str::to_owned).collect())
}

/// A helix in G18 with its centre beside both ends in Z. Posts that write no plane replace it by chords.
#[test]
fn arcs_in_other_planes_are_written() {
    let text = "G21 G90 G17\nT1 M6\nS1000 M3\nG0 Z5\nG0 X0 Y0\nG1 Z-2 F100\nG18 G3 X4 Y1 Z-2 I2 K1\nG17 G1 X9\nG0 Z5\nM5\nM30";
    for post in definitions().filter(|post| *post != "din") {
        let lines = posted(text, Dialect::LinuxCnc, post);
        let lines = lines.unwrap_or_else(|errors| panic!("{post}: {errors:?}"));
        let has_arc = lines.iter().any(|line| line.starts_with("G3 ") && line.ends_with(" I2.0 K1.0"));
        let has_plane = !matches!(post, "marlin" | "estlcam" | "xpertmill");
        assert_eq!(has_arc, has_plane, "{post}: {lines:#?}");
    }
}

/// In a native program, the last retract follows the end of the last path.
#[test]
fn the_last_retract_of_a_native_program_is_written() {
    let last_height = |post: &str, tail: &str| {
        let text = format!(
            "G17 G21 G90\nT1\nM3 S9000\nG00 Z30\nG00 X0 Y0\n(START Subpath 1.1P)\nG00 Z4\nG01 F150 Z-1\nG01 F150 X9\nG00 Z4\nG00 X20 Y0\n(END Subpath 1.1P)\n{tail}M5\nM30\n"
        );
        let steps = interpret(text.as_bytes(), Dialect::Native, &Options::default()).steps;
        let mut job = Job::from_steps("1001", &steps, Dialect::Native, &native_remark).expect("a job");
        job.set_surface(0.0);
        let output = load(post).unwrap().write(&job, &PostOptions::default());
        let text = String::from_utf8(output.unwrap_or_else(|errors| panic!("{:?}", texts(&errors))).text);
        let text = text.unwrap();
        let (_, height) = text.rsplit_once('Z').expect("a height");
        height.split_whitespace().next().unwrap_or_default().parse::<f64>().expect("a number")
    };
    for post in ["din", "xpertmill", "grbl"] {
        assert_eq!(last_height(post, "G00 Z30\n"), 30.0, "{post}");
        assert_eq!(last_height(post, "G00 X30 Y0\nG00 Z30\n"), 30.0, "{post}");
    }
    for post in ["din", "xpertmill"] {
        assert_eq!(last_height(post, ""), 4.0, "{post} writes only what the program says");
    }
}

/// Returns the lines after the second tool change.
fn after_change(lines: &[String]) -> &[String] {
    let change = lines.iter().rposition(|line| line.starts_with("M3 ")).expect("the spindle starts again");
    &lines[change + 1..]
}

const TWO_TOOLS: &str =
    "G21 G90 G17\nT1 M6\nS1000 M3\nG0 Z5\nG0 X0 Y0\nG1 Z-2 F100\nG1 X10\nT5 M6\nS2000 M3\n";

#[test]
fn a_new_tool_never_goes_down_where_the_old_one_ended() {
    for post in ["grbl", "linuxcnc", "mach3", "fanuc", "haas", "marlin"] {
        let lines = posted(&format!("{TWO_TOOLS}G0 X20 Y20 Z5\nG1 Z-1\nG0 Z5\nM30"), Dialect::LinuxCnc, post);
        let lines = lines.unwrap_or_else(|errors| panic!("{post}: {errors:?}"));
        let first = after_change(&lines).iter().find(|line| line.starts_with('G')).expect("a move");
        let is_over = first.contains("X20") && first.contains("Y20") && !first.contains('Z');
        assert!(first.starts_with("G0 ") && is_over, "{post}: {first}");
    }
    let errors =
        |rest: &str| posted(&format!("{TWO_TOOLS}{rest}\nG0 Z5\nM30"), Dialect::LinuxCnc, "linuxcnc");
    for deep in ["G1 X20", "G1 Z-3", "G0 X20\nG1 Z-3"] {
        let found = errors(deep).expect_err(deep);
        assert!(
            found[0].starts_with("PB765 1001 continues at Z -2, below the surface at 0"),
            "{deep}: {found:?}"
        );
    }
    // At the surface, the tool hits nothing. In the other cases, a rapid move of the program itself first leads to another height.
    for fine in ["G0 X20 Z0\nG1 Z-3", "G0 Z5\nG0 X20\nG1 Z-3", "G0 X20 Z-1\nG1 Z-3"] {
        let lines = errors(fine).unwrap_or_else(|errors| panic!("{fine}: {errors:?}"));
        assert!(!after_change(&lines).iter().any(|line| line.contains("Z-2.0")), "{fine}: {lines:?}");
    }
}

#[test]
fn a_cut_from_or_to_an_unknown_place_is_an_error() {
    let head = "G21 G90 G17 S1000 M3\nG0 Z5\n";
    for (cut, is_known) in [
        ("G91\nG2 X5 Y-9 R-8 F100\nG90", false),
        ("G91\nG1 X5 F100\nG90", false),
        ("G1 Z-1 F100", false),
        ("G0 X1\nG1 Z-1 F100", false),
        ("G1 X0 Y0 F100", false),
        ("G0 X1 Y1\nG91\nG1 X5 F100\nG90", true),
        ("G0 X1 Y1\nG1 Z-1 F100", true),
    ] {
        let written = posted(&format!("{head}{cut}\nG0 X7 Y7 Z5\nM5\nM30"), Dialect::LinuxCnc, "grbl");
        match written {
            Ok(_) => assert!(is_known, "{cut}"),
            Err(errors) => {
                assert!(
                    !is_known && errors[0].contains("PB765 a cut from or to an unknown position"),
                    "{errors:?}"
                );
            }
        }
    }
}

#[test]
fn a_program_that_names_no_tool_is_written_without_a_change() {
    let text = "G21 G90 G17\nS1000 M3\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X10\nG0 Z5\nM5\nM30";
    for post in ["grbl", "linuxcnc", "mach3", "fanuc", "haas", "marlin", "din"] {
        let lines =
            posted(text, Dialect::LinuxCnc, post).unwrap_or_else(|errors| panic!("{post}: {errors:?}"));
        let is_change = |line: &&String| line.contains("T0") || line.contains("M6") || line.contains("H0");
        assert_eq!(lines.iter().find(is_change), None, "{post}");
    }
    // M6 alone at the start of a program changes nothing; later it would hide a manual change.
    assert!(posted(&text.replace("S1000", "M6\nS1000"), Dialect::LinuxCnc, "grbl").is_ok());
    let by_hand = posted(&text.replace("G1 X10", "M6\nG1 X10"), Dialect::LinuxCnc, "grbl").unwrap_err();
    assert!(by_hand[0].contains("PB765 the tool is changed here"), "{by_hand:?}");
}

#[test]
fn xpertmill_s_first_layer_is_1_and_its_speeds_make_the_spindle_turn() {
    let text = "G71\nG00 X0 Y0 Z1\nG01 X0 Y0 Z-2 F500 S30000\nG01 X9 Y0 Z-2\nM06 05\nS20000\nG00 X2 Y2 Z1\nG01 X2 Y2 Z-3\nM30";
    let lines = posted(text, Dialect::Xpertmill, "linuxcnc").unwrap_or_else(|errors| panic!("{errors:?}"));
    let switches: Vec<&String> =
        lines.iter().filter(|line| line.contains("M6") || line.starts_with("M3 ")).collect();
    assert_eq!(switches, ["T1 M6", "M3 S30000", "T5 M6", "M3 S20000"]);
    let lines = posted(text, Dialect::Xpertmill, "xpertmill").unwrap_or_else(|errors| panic!("{errors:?}"));
    assert!(lines.contains(&"M06 01".to_owned()) && lines.contains(&"M06 05".to_owned()), "{lines:?}");
}

/// The job was written for a control whose rapid moves are straight: the tool returns rapidly along the slot that it has just cut, which is parallel
/// to no axis.
#[test]
fn a_rapid_move_that_the_target_bends_into_material_is_not_written() {
    let written = |post: &str, end: &str, diameter: f64| {
        let mut job = read(&format!(
            "G21 G90 G0 Z5\nT1 M6\nM3 S900\nG0 X0 Y0\nG1 Z-1 F60\nG1 {end} F200\nG0 X0 Y0\nG0 Z5\nM5\nM2"
        ));
        job.name = "1234".into();
        job.set_surface(0.0);
        job.operations.iter_mut().for_each(|operation| operation.tool.diameter = diameter);
        let written = load(post).unwrap().write(&job, &PostOptions::default());
        written.map_or_else(|errors| texts(&errors).join("\n"), |_| String::new())
    };
    for post in ["fanuc", "haas"] {
        assert!(written(post, "X20 Y50", 2.0).contains("does not move in a straight line"), "{post}");
        assert_eq!(written(post, "X20 Y20", 2.0), "", "{post}");
        assert_eq!(written(post, "X20 Y50", 0.0), "", "{post}: the cutter is unknown");
    }
    assert_eq!(written("linuxcnc", "X20 Y50", 2.0), "");
}
