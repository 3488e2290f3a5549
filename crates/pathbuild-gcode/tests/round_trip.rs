//! Tests that the reader reads back what the native writer writes: the same moves, without problems.

mod common;

use common::spelled_out;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_gcode::dialect::Dialect::{LinuxCnc, Native};
use pathbuild_gcode::dialect::{Charset, ascii, is_active_comment};
use pathbuild_gcode::interpret::{Options, guess, interpret};
use pathbuild_gcode::native::{self, WriteOptions};
use pathbuild_gcode::verify::{Tolerance, compare};
use pathbuild_motion::MoveShape;
use pathbuild_toolpath::{
    Comment, Count, Height, MoveClass, PlannedMove, ProbePoint, Program, ProgramStep, Xy,
};
use proptest::prelude::*;

/// A move as numbers that do not depend on the position of the tool.
#[derive(Clone, Debug)]
enum Sketch {
    Sweep(f64, f64),
    Lift(f64),
    Drill(f64),
    Line(f64, f64, f64, f64),
    /// An arc: radius, direction of the centre, angle, whether it is clockwise, height, feed.
    Arc(f64, f64, f64, bool, f64, f64),
}

fn sketches() -> impl Strategy<Value = Vec<Sketch>> {
    let place = || -50.0..50.0;
    let height = || -5.0..5.0;
    let feed = || 1.0..2000.0;
    let angle = prop_oneof![Just(std::f64::consts::TAU), 0.0..std::f64::consts::TAU, 0.0..0.001];
    let radius = prop_oneof![0.05..1.0, 1.0..100.0];
    let sketch = prop_oneof![
        (place(), place()).prop_map(|(x, y)| Sketch::Sweep(x, y)),
        height().prop_map(Sketch::Lift),
        height().prop_map(Sketch::Drill),
        (place(), place(), height(), feed()).prop_map(|(x, y, z, f)| Sketch::Line(x, y, z, f)),
        (radius, 0.0..7.0, angle, any::<bool>(), height(), feed())
            .prop_map(|(r, d, a, c, z, f)| Sketch::Arc(r, d, a, c, z, f)),
    ];
    proptest::collection::vec(sketch, 1..30)
}

fn program(sketches: &[Sketch]) -> Program {
    let mut at = Xy::new(0.0, 0.0);
    let mut height_now = 20.0;
    let mut steps = Vec::new();
    for sketch in sketches {
        let height = |z| Height { z, at };
        let mut length = 0.0;
        let to = match *sketch {
            Sketch::Sweep(x, y) => PlannedMove::Sweep { to: Xy::new(x, y) },
            Sketch::Lift(z) => PlannedMove::Lift { z: height(z) },
            Sketch::Drill(z) => PlannedMove::Drill { feed: 80.0, z: height(z) },
            Sketch::Line(x, y, z, feed) => PlannedMove::Line { feed, to: Xy::new(x, y), z: height(z) },
            Sketch::Arc(radius, direction, angle, clockwise, z, feed) => {
                length = radius * angle;
                let spoke =
                    |direction: f64| Xy::new(radius * libm::cos(direction), radius * libm::sin(direction));
                let centre = spoke(direction);
                let turned = spoke(if clockwise { direction - angle } else { direction + angle });
                let is_full = angle == std::f64::consts::TAU;
                // Arcs of less than 0.01 mm do not descend, because no slope is that steep.
                let z = if length < 0.01 { height_now } else { z };
                let to = if is_full { at } else { at + centre.coords - turned.coords };
                PlannedMove::Arc { feed, clockwise, centre, to, z: height(z), is_spiral: false }
            }
        };
        if let PlannedMove::Lift { z }
        | PlannedMove::Drill { z, .. }
        | PlannedMove::Line { z, .. }
        | PlannedMove::Arc { z, .. } = to
        {
            height_now = z.z;
        }
        if let PlannedMove::Sweep { to } | PlannedMove::Line { to, .. } | PlannedMove::Arc { to, .. } = to {
            at = to;
        }
        let count = Count { class: MoveClass::Milling, length, feed: None };
        steps.push(ProgramStep::Move { to, count });
        if matches!(to, PlannedMove::Arc { .. }) && length < 0.01 {
            // Arcs as short as this are beside support bars, so another part of the edge always follows.
            at += Xy::new(0.5, 0.5).coords;
            steps.push(ProgramStep::Move {
                to: PlannedMove::Line { feed: 100.0, to: at, z: Height { z: height_now, at } },
                count,
            });
        }
    }
    Program {
        path: "8001.1P".into(),
        drawing: "8001.1P.dxf".into(),
        sweep_height: 20.0,
        thickness: 5.0,
        tool: 2.0,
        steps,
        ..Program::default()
    }
}

fn options() -> WriteOptions {
    WriteOptions {
        lang: Lang::En,
        charset: Charset::Ascii,
        rapid: 1000.0,
        correction: pathbuild_toolpath::Correction::default(),
    }
}

fn text_of(program: &Program) -> String {
    native::write_program(program, "pathbuild 0.1.0", &options(), usize::MAX)
        .expect("a program within the limit")
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 500, ..ProptestConfig::default() })]

    #[test]
    fn a_written_program_is_read_back(sketches in sketches()) {
        let program = program(&sketches);
        let text = text_of(&program);
        let read = interpret(text.as_bytes(), Native, &Options::default());
        prop_assert!(!read.problems.iter().any(Diagnostic::is_error), "{}", spelled_out(&read.problems));
        let difference = compare(&read.moves(), &program.moves().collect::<Vec<_>>(), &Tolerance::of_decimals(3));
        prop_assert_eq!(difference, None, "{}", text);
    }
}

/// Returns the lines of a text without comments, and asserts that no comment is active, nested or unclosed.
fn code_of(text: &str, compatible: bool) -> Vec<String> {
    let code = |line: &str| {
        let (mut code, mut rest) = (String::new(), line);
        while let Some((before, inside)) = rest.split_once('(') {
            let (comment, after) = inside.split_once(')').unwrap_or_else(|| panic!("open: {line:?}"));
            assert!(compatible || !comment.contains('('), "nested: {line:?}");
            assert!(!is_active_comment(comment), "active: {line:?}");
            code.push_str(before);
            rest = after;
        }
        code + rest
    };
    text.lines().map(code).collect()
}

/// Tests every byte and every known active text, in each text that comes from a drawing, a file name or an option.
#[test]
fn no_text_of_others_leaves_its_comment() {
    let hostile = [
        "LOGOPEN,x",
        "MSG,x",
        "M S G,x",
        "DEBUG,#1",
        "PY,x",
        "PYRUN,x",
        "##[add-mask]x",
        "a###[x",
        "PYRELOAD",
        "preview, hide",
        ") G1 Z-99 (",
        "(",
        ")",
        "a\r\nG1 Z-99",
        "; G1 Z-99",
        "% G1 Z-99",
        "\u{2028}G1 Z-99",
        "\u{202e}G1",
        "\u{c4}\u{d6}(\u{dc}",
        "\\",
    ];
    let bytes = (0..=255_u8).map(|byte| format!("a{}G1 Z-99", char::from(byte)));
    let texts: Vec<String> = bytes.chain(hostile.map(str::to_owned)).collect();
    for compatible in [false, true] {
        let all_of = |text: &str| {
            let mut program = program(&[Sketch::Line(1.0, 2.0, -1.0, 100.0)]);
            let name = program.names.intern(text);
            let comments = [Comment::Question(name), Comment::StartSubpath(name), Comment::EndSubpath(name)];
            program.steps.splice(0..0, comments.map(ProgramStep::Comment));
            (program.path, program.drawing, program.compatible) = (text.into(), text.into(), compatible);
            let (at, label) = (Xy::new(3.0, 4.0), Some(text.into()));
            program.probes = vec![ProbePoint { at, drawn_at: at, height: 5.0, feed: 40.0, label }];
            let (provenance, options) = (format!("pathbuild {text}"), options());
            let milling = native::write_program(&program, &provenance, &options, usize::MAX).unwrap();
            milling + &native::probing_program(&program, &provenance, &options)
        };
        let expected = code_of(&all_of("x"), compatible);
        for text in &texts {
            let found = all_of(text);
            assert!(found.is_ascii() && !found.contains(|c: char| c.is_control() && c != '\n'), "{text:?}");
            assert!(!found.contains("##"), "{text:?}");
            assert_eq!(code_of(&found, compatible), expected, "{text:?}");
        }
    }
}

/// Returns the move of a single arc from this position, and the program that contains it.
fn arc_from(
    at: [f64; 2],
    radius: f64,
    direction: f64,
    clockwise: bool,
    length: f64,
) -> (PlannedMove, Program) {
    let angle = length / radius;
    let program = program(&[
        Sketch::Lift(1.0),
        Sketch::Line(at[0], at[1], 1.0, 100.0),
        Sketch::Arc(radius, direction, angle, clockwise, 1.0, 100.0),
    ]);
    let is_arc = |step: &ProgramStep| match step {
        ProgramStep::Move { to: to @ PlannedMove::Arc { .. }, .. } => Some(*to),
        _ => None,
    };
    (program.steps.iter().find_map(is_arc).expect("an arc"), program)
}

/// Distances in mm between the ends of arcs: within rounding, one or two units of the last digit, and just inside and outside of the range that is
/// checked.
const GAPS: [f64; 12] =
    [0.0, 1e-9, 0.0004, 0.0006, 0.001, 0.0014, 0.002, 0.003, 0.009_99, 0.010_01, 0.012, 0.02];

/// Start points on, beside and between numbers that can be printed exactly.
const BEGINNINGS: [[f64; 2]; 5] =
    [[0.0, 0.0], [3.0005, -2.0005], [0.000_499_9, 0.000_500_1], [-7.123_45, 1.0004], [12.0002, 0.0005]];

/// Calls a function for arcs whose ends are [`GAPS`] apart, with small and large radii in all directions.
fn for_arcs_with_gaps(mut each: impl FnMut([f64; 2], f64, f64, bool, f64)) {
    for gap in GAPS {
        for radius in [0.05, 0.0731, 0.4, 5.0, 80.0, 5000.0] {
            for eighth in 0_u32..8 {
                let direction = f64::from(eighth) * (std::f64::consts::FRAC_PI_4 + 0.002);
                for at in BEGINNINGS {
                    each(at, radius, direction, false, gap);
                    each(at, radius, direction, true, gap);
                }
            }
        }
    }
}

/// Returns the end of the arc in a text, and its angle in radians; `None` if there is no arc.
fn arc_in(text: &str) -> Option<([f64; 3], f64)> {
    let read = interpret(text.as_bytes(), Native, &Options::default());
    let moves = read.moves();
    moves.iter().find_map(|(_, it)| match it.shape {
        MoveShape::Arc(arc) => Some((it.to.at, arc.sweep(&it.from, &it.to))),
        MoveShape::Line => None,
    })
}

#[test]
fn an_arc_just_short_of_a_whole_turn_stays_one() {
    use std::f64::consts::{PI, TAU};
    for_arcs_with_gaps(|at, radius, direction, clockwise, gap| {
        let (arc, program) = arc_from(at, radius, direction, clockwise, TAU * radius - gap);
        let text = text_of(&program);
        native::read_back(&text, &program).unwrap_or_else(|problem| panic!("{problem:?}\n{text}"));
        let PlannedMove::Arc { to, .. } = arc else { unreachable!() };
        let (end, sweep) = arc_in(&text).unwrap_or_else(|| panic!("{text}"));
        assert!(sweep > PI, "{sweep}: {text}");
        let is_beside = |printed: f64, drawn: f64| (printed - drawn).abs() <= 0.001 + 1e-9;
        assert!(is_beside(end[0], to.x) && is_beside(end[1], to.y), "{gap} {to:?}: {text}");
        if gap > 0.003 {
            assert!(sweep < TAU - 1e-6, "a full circle: {text}");
        }
        let said = program.moves().find_map(|(_, it)| match it.shape {
            MoveShape::Arc(_) => Some(it.to),
            MoveShape::Line => None,
        });
        let said = said.unwrap_or_else(|| panic!("{text}"));
        // The expected arc is the one that was drawn, and not a full circle.
        assert!((said.x() - to.x).abs() < 1e-8 && (said.y() - to.y).abs() < 1e-8, "{said:?}, {to:?}");
    });
}

#[test]
fn an_arc_of_next_to_nothing_never_goes_round() {
    for_arcs_with_gaps(|at, radius, direction, clockwise, length| {
        let (_, program) = arc_from(at, radius, direction, clockwise, length);
        let text = text_of(&program);
        native::read_back(&text, &program).unwrap_or_else(|problem| panic!("{problem:?}\n{text}"));
        // An arc whose printed ends are in the same direction from the centre is a line.
        let sweep = arc_in(&text).map_or(0.0, |(_, sweep)| sweep);
        assert!(sweep < std::f64::consts::PI, "{sweep}: {text}");
        assert!(
            sweep > 0.0 || radius > 1000.0 && (length - 0.001) / radius < 5e-7,
            "a line instead of an arc: {text}"
        );
    });
}

#[test]
fn half_a_tiny_circle_stays_half() {
    for radius in [0.001, 0.002, 0.003] {
        // The arc is slightly longer than half a circle.
        let length = 1.0001 * std::f64::consts::PI * radius;
        for (angle, clockwise) in [(0.0, false), (0.7, true), (2.0, false), (4.1, true)] {
            let (arc, program) = arc_from([0.0, 0.0], radius, angle, clockwise, length);
            let PlannedMove::Arc { to, .. } = arc else { unreachable!() };
            let is_there = |it: &pathbuild_motion::Move| {
                matches!(it.shape, MoveShape::Arc(_))
                    && (it.to.x() - to.x).abs() < 1e-9
                    && (it.to.y() - to.y).abs() < 1e-9
            };
            assert!(program.moves().any(|(_, it)| is_there(&it)), "{radius} {angle}");
        }
    }
}

/// Returns a text with one of its numbers changed by some thousandths.
fn with_another_number(text: &str, which: usize, thousandths: i32) -> String {
    let lines =
        text.find("G00 X0.000 Y0.000").map_or(0, |at| at + 18)..text.find("(Milling").unwrap_or(text.len());
    let words: Vec<usize> = text[lines.clone()].match_indices('.').map(|(at, _)| at + lines.start).collect();
    let Some(point) = words.get(which % words.len().max(1)) else { return text.to_owned() };
    let begin = text[..*point].rfind(char::is_alphabetic).map_or(0, |at| at + 1);
    let end = point + 4;
    let number: f64 = text[begin..end].parse().expect("a number with three decimals");
    format!("{}{:.3}{}", &text[..begin], number + f64::from(thousandths) / 1000.0, &text[end..])
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 500, ..ProptestConfig::default() })]

    /// Comparing moves while reading accepts nothing that a comparison of the complete lists would reject.
    #[test]
    fn reading_back_says_what_the_comparison_says(
        sketches in sketches(),
        which in any::<usize>(),
        thousandths in prop_oneof![-2..3_i32, -2000..2000_i32],
    ) {
        let program = program(&sketches);
        let text = with_another_number(&text_of(&program), which, thousandths);
        let read = interpret(text.as_bytes(), Native, &Options::default());
        let expected: Vec<_> = program.moves().collect();
        // An arc that would become a full circle may be longer by one unit of the last digit when it is read back.
        let differs = |place: f64| {
            let exactly = Tolerance::of_decimals(3);
            compare(&read.moves(), &expected, &Tolerance { place: exactly.place + place, ..exactly }).is_some()
        };
        let has_errors = read.problems.iter().any(Diagnostic::is_error);
        if !has_errors && !differs(0.0) {
            prop_assert!(native::read_back(&text, &program).is_ok(), "{}", text);
        } else if has_errors || differs(0.001) {
            prop_assert!(native::read_back(&text, &program).is_err(), "{}", text);
        }
    }
}

#[test]
fn a_written_program_is_recognised() {
    let text = text_of(&program(&[Sketch::Lift(5.0), Sketch::Drill(1.0)]));
    assert_eq!(guess(text.as_bytes()).dialect, Native);
    let as_is = interpret(text.as_bytes(), LinuxCnc, &Options::default());
    assert!(!as_is.problems.iter().any(Diagnostic::is_error), "{:?}", as_is.problems);
}

/// Returns a program with a line, an arc and a hole.
fn small() -> Program {
    program(&[
        Sketch::Lift(5.0),
        Sketch::Drill(1.0),
        Sketch::Line(10.0, 20.0, 1.0, 120.0),
        Sketch::Arc(4.0, 0.5, 2.0, true, 0.5, 130.0),
    ])
}

#[test]
fn what_is_not_what_the_program_says_is_found_when_read_back() {
    let program = small();
    let text = text_of(&program);
    native::read_back(&text, &program).expect("as written");
    let head = text.find("G00 X0.000 Y0.000").expect("the head") + 18;
    let digits = text.char_indices().filter(|(at, c)| *at > head && c.is_ascii_digit()).map(|(at, _)| at);
    let end = text.find("(Milling").expect("the statistics");
    let mut changed = 0;
    for at in digits.filter(|at| *at < end) {
        let digit = if &text[at..=at] == "9" { "7" } else { "9" };
        let other = format!("{}{digit}{}", &text[..at], &text[at + 1..]);
        // The last digit of a centre moves an arc by less than the rounding of its ends, and a changed G word may have the same effect.
        let may_be_the_same =
            text[..at].rsplit([' ', '\n']).next().is_some_and(|word| word.starts_with(['G', 'I', 'J']));
        if !may_be_the_same {
            let problem = native::read_back(&other, &program).expect_err(&other);
            assert_eq!(problem.code().to_string(), "PB006");
            changed += 1;
        }
    }
    assert!(changed > 50, "{changed}");
    let (without, _) = text.split_once("G02").expect("an arc");
    assert!(native::read_back(without, &program).is_err(), "cut off");
    // The moves are the same, but the spindle turns without a speed.
    let turning = text.replacen("G00 X0.000 Y0.000", "M03\nG00 X0.000 Y0.000", 1);
    assert!(native::read_back(&turning, &program).is_err(), "{turning}");
}

#[test]
fn a_probing_run_is_read_back() {
    use pathbuild_toolpath::ProbePoint;
    let probe = |x: f64| ProbePoint {
        at: Xy::new(x, 3.0),
        drawn_at: Xy::new(0.0, 0.0),
        height: 5.0,
        feed: 40.0,
        label: None,
    };
    let program = Program { probes: vec![probe(0.0), probe(7.0)], ..small() };
    let options = WriteOptions {
        lang: Lang::En,
        charset: Charset::Ascii,
        rapid: 1000.0,
        correction: pathbuild_toolpath::Correction::default(),
    };
    let text = native::probing_program(&program, "", &options);
    native::read_probing_back(&text, &program.probes).expect("as written");
    let elsewhere = text.replace("G00 X7.000 Y3.000", "G00 X7.001 Y3.000");
    assert!(elsewhere != text && native::read_probing_back(&elsewhere, &program.probes).is_err());
    assert!(native::read_probing_back(&text, &program.probes[..1]).is_err());
}

/// Each letter of Latin 1 becomes similar ASCII letters of the same case.
#[test]
fn letters_are_transliterated() {
    let all: String = "äöüÄÖÜß àáâãå èéêë ìíîï òóôõø ùúû ÀÁÂÃÅ ÈÉÊË ÌÍÎÏ ÒÓÔÕØ ÙÚÛ çÇñÑ"
        .chars()
        .map(|character| ascii(&character.to_string()))
        .collect();
    assert_eq!(all, "aeoeueAeOeUess aaaaa eeee iiii ooooo uuu AAAAA EEEE IIII OOOOO UUU cCnN");
}
