//! Tests the rules for tool lengths, each with a program that violates the rule and one that just does not.

mod common;

use common::fault_text;
use pathbuild_diagnostic::Severity;
use pathbuild_gcode::dialect::Dialect::{self, Fanuc, Grbl, Haas, LinuxCnc, Mach3, Rs274};
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::verify::{LengthRules, Stock};

const FINE: [&str; 0] = [];

/// Controls with M6 and G43.
const CONTROLS: [Dialect; 4] = [LinuxCnc, Rs274, Fanuc, Haas];

/// Returns the problems of a program on material up to Z 0; warnings end with a question mark.
#[track_caller]
fn wrong(dialect: Dialect, program: &str) -> Vec<String> {
    let text = format!("G17 G21 G90 G94 F100.\n{program}\nM30\n");
    let read = interpret(text.as_bytes(), dialect, &Options::default());
    assert!(read.problems.iter().all(|problem| !problem.is_error()), "{dialect}: {:?}", read.problems);
    let stock = Stock::uniform(0.0, 3.0);
    let mut rules = LengthRules::new(dialect, Some(&stock));
    read.steps.iter().for_each(|step| rules.step(step));
    let text = |problem: &pathbuild_diagnostic::Diagnostic| {
        let mark = if problem.severity == Severity::Warning { "?" } else { "" };
        format!("{}{mark}", fault_text(problem))
    };
    rules.finish().iter().map(text).collect()
}

/// Returns the problems of a program, after asserting that they are the same on every control.
#[track_caller]
fn wrong_everywhere(program: &str) -> Vec<String> {
    let all = CONTROLS.map(|dialect| wrong(dialect, program));
    assert!(all.iter().all(|found| *found == all[0]), "{all:?}");
    all[0].clone()
}

/// Returns moves that go down to a cut at X and up again, starting and ending above the material.
fn cut(x: u8) -> String {
    format!("G0 X{x}.0 Y0.0\nG1 Z-1.0\nG0 Z5.0\n")
}

#[test]
fn every_tool_has_its_own_length() {
    let program = |length: &str| format!("T1 M6\nG0 G43 H1 Z5.0\n{}T2 M6\n{length}{}", cut(0), cut(9));
    assert_eq!(wrong_everywhere(&program("G0 G43 H2 Z5.0\n")), FINE);
    assert_eq!(wrong_everywhere(&program("")), ["9 wrong-tool-length"]);
    assert_eq!(wrong_everywhere(&program("G0 G43 H1 Z5.0\n")), ["8 wrong-tool-length"]);
}

#[test]
fn the_same_tool_keeps_its_length() {
    let program = |tool: &str| format!("T1 M6\nG0 G43 H1 Z5.0\n{}{tool} M6\n{}", cut(0), cut(9));
    assert_eq!(wrong_everywhere(&program("T1")), FINE);
    assert_eq!(wrong_everywhere(&program("T3")), ["9 wrong-tool-length"]);
    // A length set before the first tool change may belong to the tool of that change.
    assert_eq!(wrong_everywhere(&format!("G43 H1\nT1 M6\nG0 Z5.0\n{}", cut(0))), FINE);
    assert_eq!(wrong_everywhere(&format!("G43 H1\nT2 M6\nG0 Z5.0\n{}", cut(0))), ["6 wrong-tool-length"]);
}

#[test]
fn another_number_is_a_custom_of_the_shop() {
    let program = |h: &str| format!("T1 M6\nG0 G43 {h} Z5.0\n{}", cut(0));
    assert_eq!(wrong_everywhere(&program("H1")), FINE);
    assert_eq!(wrong_everywhere(&program("H51")), ["3 wrong-tool-length?"]);
    let both = |h: &str| format!("{}T2 M6\nG0 G43 {h} Z5.0\n{}", program("H2"), cut(9));
    assert_eq!(wrong_everywhere(&both("H3")), ["3 wrong-tool-length?", "8 wrong-tool-length?"]);
    assert_eq!(wrong_everywhere(&both("H2")), ["3 wrong-tool-length"]);
}

#[test]
fn a_length_stays_on() {
    let program =
        |word: &str| format!("T1 M6\nG0 G43 H1 Z5.0\nG0 X0.0 Y0.0\nG1 Z-1.0\n{word}\nG1 X9.0\nG0 Z5.0\n");
    assert_eq!(wrong_everywhere(&program("M8")), FINE);
    assert_eq!(wrong_everywhere(&program("G49")), ["7 wrong-tool-length"]);
    assert_eq!(wrong(Fanuc, &program("G43 H0")), ["7 wrong-tool-length"]);
    // The length is switched off after the last cut and above the material.
    let end = |words: &str| wrong_everywhere(&format!("T1 M6\nG0 G43 H1 Z5.0\n{}{words}\n", cut(0)));
    assert_eq!(end("G0 Z9.0\nG49\nG1 X5.0"), FINE);
    assert_eq!(end("G49\nG0 Z9.0\nG1 X5.0"), ["8 wrong-tool-length?"], "the spindle nose goes to Z 9");
    assert_eq!(
        wrong_everywhere(&format!("T1 M6\nG0 G43 H1 Z5.0\n{}G49\nG1 Z-0.5\n", cut(0))),
        ["8 wrong-tool-length"]
    );
}

#[test]
fn all_tools_have_a_length_or_none() {
    let program = |length: &str| format!("G49\nT1 M6\nG0 Z5.0\n{}T2 M6\n{length}G0 Z5.0\n{}", cut(0), cut(9));
    assert_eq!(wrong_everywhere(&program("")), FINE);
    assert_eq!(wrong_everywhere(&program("G43 H2\n")), ["6 wrong-tool-length?"]);
}

#[test]
fn g43_without_h_means_what_the_control_makes_of_it() {
    let program = format!("T1 M6\nG0 G43 Z5.0\n{}", cut(0));
    assert_eq!(wrong(LinuxCnc, &program), FINE);
    // The H of the previous program is not known.
    assert_eq!(wrong(Fanuc, &program), FINE);
    let second = format!("T1 M6\nG0 G43 H1 Z5.0\n{}T2 M6\nG0 G43 Z5.0\n{}", cut(0), cut(9));
    assert_eq!(wrong(LinuxCnc, &second), FINE);
    assert_eq!(wrong(Fanuc, &second), ["8 wrong-tool-length"]);
    assert_eq!(wrong(Haas, &second), ["8 wrong-tool-length"]);
}

/// Without M6, GRBL, LinuxCNC and Mach3 change no tool at T, and only a stop lets the operator change it.
#[test]
fn a_tool_that_is_only_selected_needs_a_stop() {
    let program = |change: &str| format!("T1\nG0 Z5.0\nM3 S900\n{}{change}\nG0 Z5.0\n{}", cut(0), cut(9));
    for dialect in [Grbl, LinuxCnc, Mach3] {
        assert_eq!(wrong(dialect, &program("M0\nT2")), FINE, "{dialect}");
        assert_eq!(wrong(dialect, &program("T2\nM0")), FINE, "{dialect}");
        assert_eq!(wrong(dialect, &program("T1")), FINE, "{dialect}");
        assert_eq!(wrong(dialect, &program("T2")), ["8 disagreement?"], "{dialect}");
        assert_eq!(wrong(dialect, &program("G4 P1\nT2")), ["9 disagreement?"], "{dialect}");
        // The stop is before the last cut with the previous tool.
        let early = program("T2").replace("M3 S900", "M0\nM3 S900");
        assert_eq!(wrong(dialect, &early), ["9 disagreement?"], "{dialect}");
        // The next tool cuts nothing, or cuts the air.
        assert_eq!(wrong(dialect, &format!("T1\nG0 Z5.0\n{}T2", cut(0))), FINE, "{dialect}");
        assert_eq!(wrong(dialect, &format!("T1\nG0 Z5.0\n{}T2\nG1 X1.0", cut(0))), FINE, "{dialect}");
    }
    // The second tool is only prepared, because M6 changes it later; GRBL has no M6.
    let later = format!("{}T2\nM6\nG0 Z5.0\n{}", program("T2"), cut(0));
    assert_eq!(wrong(LinuxCnc, &later), FINE);
    // The changer of such a control may obey T alone.
    assert_eq!(wrong(Fanuc, &program("T2")), FINE);
}
