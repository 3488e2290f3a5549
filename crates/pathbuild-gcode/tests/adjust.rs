//! Tests adjusting programs, including everything that must be rejected. (book: language/probes)
#![allow(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot set up its files has failed"
)]

use std::fmt::Write;
use std::fs;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_diagnostic::{Code, Diagnostic, Lang};
use pathbuild_gcode::adjust::{AdjustedProgram, Inputs, Source, adjust};
use pathbuild_gcode::native::{self, Parts};
use pathbuild_toolpath::ZModel;

/// A file with the value of one probe, whose drawn thickness is 2 mm.
const VALUES: &str = "([1.000 2.000]/T=2.000) #51=2.100\n";

fn run(program: impl AsRef<[u8]>, values: impl AsRef<[u8]>) -> Result<AdjustedProgram, Vec<Diagnostic>> {
    adjust(&inputs(program.as_ref(), values.as_ref()))
}

fn inputs<'a>(program: &'a [u8], values: &'a [u8]) -> Inputs<'a> {
    Inputs {
        program: Source { file: Utf8Path::new("a_Clean.gcode"), bytes: program },
        values: Source { file: Utf8Path::new("a_Z.txt"), bytes: values },
        log: None,
        max_correction: 1.0,
        below_plate: 0.5,
        model: ZModel::default(),
        shims: &[],
    }
}

fn run_with_log(program: &str, values: &str, log: &str) -> Result<AdjustedProgram, Vec<Diagnostic>> {
    let log = Some(Source { file: Utf8Path::new("sender.log"), bytes: log.as_bytes() });
    adjust(&Inputs { log, ..inputs(program.as_bytes(), values.as_bytes()) })
}

#[track_caller]
fn adjusted(program: impl AsRef<[u8]>, values: impl AsRef<[u8]>) -> String {
    let adjusted = run(program, values).unwrap_or_else(|problems| panic!("{:?}", placed_codes(&problems)));
    String::from_utf8(adjusted.program).unwrap()
}

/// Returns each problem as `file:line:column code`.
fn placed_codes(problems: &[Diagnostic]) -> Vec<String> {
    let place = |it: &Diagnostic| match (it.place.line, it.place.column) {
        (Some(line), Some(column)) => format!(":{line}:{column}"),
        _ => String::new(),
    };
    let file = |it: &Diagnostic| it.file.as_ref().unwrap().to_string();
    problems.iter().map(|it| format!("{}{} {}", file(it), place(it), it.code())).collect()
}

#[track_caller]
fn refused(result: Result<AdjustedProgram, Vec<Diagnostic>>) -> Vec<String> {
    placed_codes(&result.expect_err("it was adjusted"))
}

#[track_caller]
fn value(formula: &str) -> String {
    let program = adjusted(format!("X0.000(={formula})"), VALUES);
    program.strip_prefix('X').unwrap().split('(').next().unwrap().to_owned()
}

/// Returns the column of an error in a formula, relative to the formula.
#[track_caller]
fn column(formula: &str) -> u32 {
    let problems = run(format!("X0.000(={formula})"), VALUES).expect_err("it has a value");
    assert_eq!((problems.len(), problems[0].code()), (1, Code::InvalidFormula), "{formula}");
    problems[0].place.column.unwrap() - 8
}

fn recorded() -> Vec<Utf8PathBuf> {
    let directory = Utf8Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/conformance/adjust");
    let mut cases: Vec<Utf8PathBuf> =
        directory.read_dir_utf8().unwrap().map(|case| case.unwrap().into_path()).collect();
    cases.sort();
    cases
}

#[test]
fn recorded_programs_come_out_byte_for_byte() {
    let mut equal = 0;
    for case in recorded() {
        let ending = |suffix: &str| {
            let mut files = case.read_dir_utf8().unwrap().map(|file| file.unwrap().into_path());
            fs::read(files.find(|file| file.as_str().ends_with(suffix)).unwrap()).unwrap()
        };
        let expected = case.join("expected").read_dir_utf8().unwrap().map(|file| file.unwrap().into_path());
        let expected = expected.into_iter().find(|file| file.as_str().ends_with("_Milling.gcode"));
        let result = run(ending("_Clean.gcode"), ending("_Z.txt"));
        match expected {
            Some(expected) => {
                let without_cr = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap().replace("\r\n", "\n");
                assert_eq!(
                    without_cr(result.unwrap().program),
                    without_cr(fs::read(expected).unwrap()),
                    "{case}"
                );
                equal += 1;
            }
            None => assert!(result.is_err(), "{case}"),
        }
    }
    assert_eq!(equal, 6);
}

#[test]
fn a_height_becomes_its_value_and_everything_else_stays_to_the_byte() {
    let program =
        b"\xef\xbb\xbf%\r\n(\xfcber Z1(=2))\n G01  X1 Z1.800(=1.800+1.000*[#51-2.000]) F9 \r\nM30\n%";
    let adjusted = run(program, VALUES).unwrap();
    let expected =
        b"\xef\xbb\xbf%\r\n(\xfcber Z1(=2))\n G01  X1 Z1.900(==1.800+1.000*[#51-2.000]) F9 \r\nM30\n%";
    assert_eq!(adjusted.program, expected);
    assert_eq!(adjusted.heights, 1);
    assert!((adjusted.corrections.0 - 0.1).abs() < 1e-9 && (adjusted.corrections.1 - 0.1).abs() < 1e-9);
}

#[test]
fn a_line_may_have_several_formulas() {
    assert_eq!(adjusted("X1(=1+1)Y2(=3) X5(=#51)", VALUES), "X2.000(==1+1)Y3.000(==3) X2.100(==#51)");
}

#[test]
fn what_is_no_number_with_a_formula_stays() {
    for line in
        ["(=1+1)", "Z (=1+1)", "Z5(1+1)", "(Q:X5(=#99])", ";X5(=#99)", "(a) ; X5(=#99)", "Z5(", "Z5)", ""]
    {
        assert_eq!(adjusted(line, VALUES), line);
    }
    assert_eq!(adjusted("(a)X5(=1)(b", VALUES), "(a)X1.000(==1)(b");
}

#[test]
fn comments_around_a_formula_belong_neither_to_it_nor_to_the_code() {
    let program = |before: &str, after: &str| format!("G1 {before}Z-1.000(=[#51-2.000]-1.000){after} F9\n");
    let commented = program("(up)", "(down (=#99)");
    assert_eq!(adjusted(&commented, VALUES), commented.replace("-1.000(=[", "-0.900(==["));
    let other = |found: &str, expected: &str| {
        native::first_other_line(found.as_bytes(), expected.as_bytes(), Parts::Code).is_some()
    };
    for comment in ["(down)", "(=#51)", "(a)(b)"] {
        assert!(!other(&program("", comment), &program(comment, "")), "{comment}");
        assert!(other(&program("", &format!("{comment}X1")), &program("", comment)), "{comment}");
    }
}

#[test]
fn numbers_may_have_a_sign_and_no_decimals() {
    assert_eq!(adjusted("X-.5(=-2) Y+3(=4) U7.(=8)", VALUES), "X-2.000(==-2) Y4.000(==4) U8.000(==8)");
    assert_eq!(refused(run("X1.2.3(=4)", VALUES)), ["a_Clean.gcode:1:2 PB604"]);
    assert_eq!(refused(run("X.(=4)", VALUES)), ["a_Clean.gcode:1:2 PB604"]);
}

#[test]
fn what_rounds_to_zero_has_no_sign() {
    assert_eq!((value("0-0.0004"), value("0-0.0006")), ("0.000".to_owned(), "-0.001".to_owned()));
}

#[test]
fn formulas_follow_the_rules_of_arithmetic() {
    let cases = [
        ("1+2*3", "7.000"),
        ("(1+2)*3", "9.000"),
        ("[1+2]*3", "9.000"),
        ("8/4/2", "1.000"),
        ("8-4-2", "2.000"),
        ("2*-3", "-6.000"),
        ("--3", "3.000"),
        ("-2-3", "-5.000"),
        ("-(2-[3*#51])", "4.300"),
        (" 1 +\t2 ", "3.000"),
        (".5+1.", "1.500"),
        ("#51", "2.100"),
        ("#0051", "2.100"),
    ];
    for (formula, expected) in cases {
        assert_eq!(value(formula), expected, "{formula}");
    }
}

#[test]
fn a_malformed_formula_is_told_at_its_column() {
    let cases = [
        ("", 1),
        ("1+", 3),
        ("1+*2", 3),
        ("+1", 1),
        ("1 2", 3),
        ("1e3", 2),
        ("1,5", 2),
        ("(1]", 3),
        ("[1)", 3),
        ("1]", 2),
        ("#", 1),
        ("#x", 1),
        ("#-51", 1),
        ("#99999999999", 1),
        ("1..2", 1),
        ("=1", 1),
        ("1/0", 2),
        ("1/(2-2)", 2),
        ("\u{b2}", 1),
    ];
    for (formula, expected) in cases {
        assert_eq!(column(formula), expected, "{formula}");
    }
}

#[test]
fn columns_count_characters() {
    let problems = run("(\u{fc}\u{df}) Z5(=1+)", VALUES).unwrap_err();
    assert_eq!(placed_codes(&problems), ["a_Clean.gcode:1:12 PB604"]);
    let text = problems[0].text.as_ref().unwrap();
    assert_eq!(&text.text[text.span()], ")");
}

#[test]
fn a_formula_ends_in_its_own_line() {
    assert_eq!(refused(run("G01 X5(=1+(2)\nX1)", VALUES)), ["a_Clean.gcode:1:7 PB604"]);
    assert_eq!(adjusted("X5(=1+(2))\nX1)", VALUES), "X3.000(==1+(2))\nX1)");
}

#[test]
fn a_program_is_adjusted_once() {
    let problems = run("Z5.000(==5.000+0.1)", VALUES).unwrap_err();
    assert_eq!(problems[0].message, &messages::ADJUSTED_BEFORE);
}

#[test]
fn brackets_in_each_other_are_limited() {
    let nested = |depth: usize| format!("{}1{}", "[(".repeat(depth / 2), ")]".repeat(depth / 2));
    assert_eq!(value(&nested(100)), "1.000");
    assert_eq!(column(&nested(102)), 101);
    assert_eq!(column(&"(".repeat(1_000_000)), 101);
}

#[test]
fn signs_and_terms_are_not_limited() {
    assert_eq!(value(&format!("{}1", "-".repeat(1_000_001))), "-1.000");
    assert_eq!(value(&format!("1{}", "+1".repeat(99_999))), "100000.000");
}

#[test]
fn values_that_are_no_numbers_any_more_are_refused() {
    let huge = "9".repeat(300);
    assert_eq!(refused(run(format!("X1(={huge}*{huge})"), VALUES)), ["a_Clean.gcode:1:5 PB604"]);
    assert_eq!(refused(run(format!("X1(={}*0)", "9".repeat(400)), VALUES)), ["a_Clean.gcode:1:5 PB604"]);
    assert_eq!(
        refused(run(format!("X1(={huge}*{huge}-{huge}*{huge})"), VALUES)),
        ["a_Clean.gcode:1:5 PB604"]
    );
}

#[test]
fn of_a_line_only_the_first_fault_is_told_and_of_each_line_one() {
    let program = "Z1(=1+) Z1(=2+)\nZ1(=3)\nZ1(=4+)\n";
    assert_eq!(refused(run(program, VALUES)), ["a_Clean.gcode:1:7 PB604", "a_Clean.gcode:3:7 PB604"]);
}

#[test]
fn values_are_written_as_people_write_them() {
    for value in ["2.1", "2,1", "+2.1", "  2.100\t", "\t2,1 \r", "2.1000"] {
        let values = format!("\u{feff}\n([1.000 2.000]/L:A/T=2.000) #51={value}\n  \n");
        assert_eq!(adjusted("X1.000(=#51)", values), "X2.100(==#51)", "{value:?}");
    }
}

#[test]
fn labels_may_hold_anything() {
    for label in ["L", "/T=9.000] #99=1", "#51=", "\u{dc}n", "", "/T=9.000 @ [9.000|9.000]"] {
        let values = format!("([1.000 2.000]/L:{label}/T=2.000) #51=2.1");
        assert_eq!(adjusted("X1.000(=#51)", values), "X2.100(==#51)", "{label}");
    }
    assert!(run("X1.000(=#51)", b"([1.000 2.000]/L:\xdcn/T=2.000) #51=2.1").is_ok());
}

#[test]
fn a_line_without_a_right_value_is_refused() {
    let cases = [
        ("", 32),
        ("   ", 35),
        ("abc", 32),
        (" 2.1 mm", 33),
        ("2.1.0", 32),
        ("2e0", 32),
        ("=2", 32),
        ("\u{b2}", 32),
    ];
    for (value, column) in cases {
        let values = format!("\n([-1.000 2.000]/L:A/T=2.0) #51={value}\n");
        assert_eq!(refused(run("X1(=#51)", values)), [format!("a_Z.txt:2:{column} PB601")], "{value:?}");
    }
}

#[test]
fn a_line_that_is_of_no_probe_is_refused() {
    for line in [
        "#51=2",
        "([1.000 2.000]) #51=2",
        "([1.000]/T=2.000) #51=2",
        "([1.000 2.000]/T=2.000) 51=2",
        "([1.000 2.000]/T=2.000) #51 2",
        "([1.000 2.000]/T=2.000) #99999999999=2",
        "x ([1.000 2.000]/T=2.000) #51=2",
        "(comment)",
    ] {
        assert_eq!(refused(run("X1(=2)", line)), ["a_Z.txt:1:1 PB601"], "{line}");
    }
}

#[test]
fn a_probe_has_one_line() {
    let values = format!("{VALUES}{VALUES}");
    assert_eq!(refused(run("X1(=#51)", values)), ["a_Z.txt:2:1 PB601"]);
}

#[test]
fn a_value_may_be_off_by_the_largest_correction_and_no_more() {
    for (value, is_right) in
        [("3.000", true), ("3.001", false), ("1.000", true), ("0.999", false), ("1,0", true)]
    {
        let result = run("Z1.000(=1.000+0.000*[#51-2.000])", format!("([1.000 2.000]/T=2.000) #51={value}"));
        assert_eq!(result.is_ok(), is_right, "{value}");
        if let Err(problems) = result {
            assert_eq!(placed_codes(&problems), ["a_Z.txt:1:29 PB602"]);
        }
    }
}

#[test]
fn a_height_that_is_extrapolated_too_far_is_refused() {
    let values = "([0.000 0.000]/T=2.000) #51=2.900\n([1.000 0.000]/T=2.000) #52=2.000\n";
    let formula = |weight: &str| format!("Z1.000(=1.000+{weight}*[#51-2.000]-0.5*[#52-2.000])");
    assert!(run(formula("1.114"), values).is_ok());
    assert_eq!(refused(run(formula("1.120"), values)), ["a_Clean.gcode:1:2 PB602"]);
    // Negative corrections have the same limit.
    let down = "([0.000 0.000]/T=2.000) #51=1.100\n([1.000 0.000]/T=2.000) #52=2.000\n";
    assert!(run(formula("1.114"), down).is_ok());
    assert_eq!(refused(run(formula("1.120"), down)), ["a_Clean.gcode:1:2 PB602"]);
    // Weights with three decimals may sum to slightly more than 1.
    assert!(run("Z1.000(=1.000+1.002*[#51-2.000])", "([1 2]/T=2) #51=3").is_ok());
    // The limit only applies to heights.
    assert!(run("F1.000(=1.000+9*#51)", values).is_ok());
}

#[test]
fn a_probe_that_formulas_use_needs_a_line() {
    let program = "X1.000(=#51)\nX1.000(=#51+#52)\nX1.000(=#52+#53)\n";
    assert_eq!(refused(run(program, VALUES)), ["a_Clean.gcode:2:13 PB603", "a_Clean.gcode:3:13 PB603"]);
    let unused = format!("{VALUES}([5 5]/T=2.0) #60=2.5");
    assert!(run("X1.000(=#51)", unused).is_ok());
}

#[test]
fn the_older_form_is_held_against_the_heights_in_formulas() {
    let program = "Z5.000(=5.000+0.5*[#2001-5.000]+0.5*(#2002 - 5.5))";
    let values = |first: &str| format!("@ [138.000|299.000] #2001={first}\n@ [1.000|-2.000] #2002=5.5\n");
    assert_eq!(adjusted(program, values("5,1")), "Z5.050(==5.000+0.5*[#2001-5.000]+0.5*(#2002 - 5.5))");
    assert!(run(program, values("6.0")).is_ok());
    assert_eq!(refused(run(program, values("6.001"))), ["a_Z.txt:1:27 PB602"]);
}

#[test]
fn an_older_line_whose_height_no_formula_says_is_refused() {
    for formula in
        ["#2001-5.000", "[5.000-#2001]", "[#2001-5.000*2]", "[#2001-5.000-1]", "[-#2001-5]", "[#2001-(5)]"]
    {
        let result = run(format!("X5.000(={formula})"), "@ [138.000|299.000] #2001=5,1");
        assert_eq!(refused(result), ["a_Z.txt:1:27 PB601"], "{formula}");
    }
    // A parameter that no formula refers to is harmless.
    assert!(run("X5.000(=5)", "@ [138.000|299.000] #2001=5,1").is_ok());
}

#[test]
fn an_older_line_must_fit_every_formula() {
    let program = "Z5.000(=5.000+0.5*[#2001-5.000])\nZ5.000(=5.000+0.5*[#2001-4.000])";
    assert!(run(program, "@ [1|2] #2001=5,0").is_ok());
    assert_eq!(refused(run(program, "@ [1|2] #2001=5,1")), ["a_Z.txt:1:15 PB602"]);
}

/// A program whose header lists the probe with which it was made.
const MADE: &str = "%\n(pathbuild)\n(Probe #51: [5.000 -15.000] T=2.000 X12.000 Y3.000)\nG01 X1.000(=#51)\n";

#[test]
fn a_value_file_must_be_of_the_same_probes_as_the_program() {
    for (line, is_right) in [
        ("([5.000 -15.000]/L:A/T=2.000) #51=2", true),
        ("([5 -15]/T=2) #51=2", true),
        ("([5.001 -15.000]/T=2.000) #51=2", false),
        ("([5.000 -15.001]/T=2.000) #51=2", false),
        ("([5.000 -15.000]/T=2.001) #51=2", false),
        ("([5.000 -15.000]/L:A/T=2.000 @ [12.000|3.000]) #51=2", true),
        ("([5 -15]/T=2 @ [12|3] ) #51=2", true),
        ("([5.000 -15.000]/T=2.000 @ [12.001|3.000]) #51=2", false),
        ("([5.000 -15.000]/T=2.000 @ [12.000|2.999]) #51=2", false),
        ("([5.001 -15.000]/T=2.000 @ [12.000|3.000]) #51=2", false),
        ("@ [5.000|-15.000] #51=2", true),
        ("@ [5.000|-14.000] #51=2", false),
    ] {
        let result = run(MADE, line);
        assert_eq!(result.is_ok(), is_right, "{line}");
        if let Err(problems) = result {
            assert_eq!(placed_codes(&problems), ["a_Z.txt:1:1 PB603"], "{line}");
        }
    }
}

#[test]
fn a_probe_that_the_program_was_made_without_is_refused() {
    let values = "([5.000 -15.000]/T=2.000) #51=2\n([6.000 -15.000]/T=2.000) #52=2\n";
    assert_eq!(refused(run(MADE, values)), ["a_Z.txt:2:1 PB603"]);
    assert!(run("G01 X1.000(=#51)\n", values).is_ok(), "programs of the original tool do not say");
}

#[test]
fn only_the_header_says_what_a_program_was_made_with() {
    let later = "%\nG00 X1.000(=#51)\n(Probe #51: [5.000 -15.000] T=2.000)\n";
    assert!(run(later, VALUES).is_ok());
    assert!(run("%\n(Probe #51: [5.000 -15.000] T=2.000)\nG00 X1.000(=#51)\n", VALUES).is_err());
}

const TWO: &str = "([0.000 0.000]/T=2.000) #51=\n([1.000 0.000]/T=2.000) #52=\n";
const USES_TWO: &str = "X1.000(=#51*10+#52)";

#[test]
fn a_log_gives_the_values_in_order() {
    let log = "ok\n>>> [PRB:0.000,0.000,0.150:1]\nok\n[PRB:1.0,0.0,0.250,0.0:1] [MSG:x]\n";
    let result = run_with_log("X1.000(=#51*10+#52)", &TWO.replace("2.000", "0.000"), log).unwrap();
    assert_eq!(result.program, b"X1.750(==#51*10+#52)");
}

#[test]
fn the_order_is_that_of_the_numbers() {
    let swapped = "([1.000 0.000]/T=2.000) #52=\n([0.000 0.000]/T=2.000) #51=\n";
    let log = "[PRB:0,0,2.1:1][PRB:0,0,2.2:1]";
    assert_eq!(run_with_log("X1.000(=#51*10+#52)", swapped, log).unwrap().program, b"X23.200(==#51*10+#52)");
}

#[test]
fn the_offset_of_the_workpiece_is_taken_off() {
    let log = "<Idle|MPos:0,0,0|WCO:-5.000,-5.000,-50.000>\n[PRB:-5,-5,-47.900:1]\n\
               <Idle|MPos:0,0,0|FS:0,0>\n[PRB:-4,-5,-47.800:1]\n";
    assert_eq!(run_with_log("X1.000(=#51*10+#52)", TWO, log).unwrap().program, b"X23.200(==#51*10+#52)");
    let without = log.replace("|WCO:-5.000,-5.000,-50.000", "");
    let problems = refused(run_with_log(USES_TWO, TWO, &without));
    assert_eq!(problems, ["sender.log:2:1 PB602", "sender.log:4:1 PB602"]);
}

/// Setting the zero again between two probes would tilt the plane.
#[test]
fn all_results_of_a_log_have_the_same_zero() {
    let with_second = |offset: &str| {
        let log = format!(
            "<Idle|WCO:-5.000,-5.000,-50.000>\n[PRB:-5,-5,-47.900:1]\n<Idle|WCO:{offset}>\n[PRB:-4,-5,-47.800:1]\n"
        );
        run_with_log(USES_TWO, TWO, &log)
    };
    assert!(with_second("-5.000,-5.000,-50.000").is_ok());
    assert_eq!(refused(with_second("-5.000,-5.000,-49.999")), ["sender.log:4:1 PB601"]);
}

/// A log need not state the offset of the workpiece, so all results may be shifted by the same amount, but not relative to each other.
#[test]
fn the_results_of_a_log_are_at_the_places_of_the_probes() {
    let values =
        "([0.000 0.000]/T=2.000 @ [8.000|4.000]) #51=\n([1.000 0.000]/T=2.000 @ [8.000|18.000]) #52=\n";
    let places = |second: &str| {
        let log = format!("[PRB:-292.000,-196.000,2.1:1]\n[PRB:{second},2.2:1]\n");
        run_with_log(USES_TWO, values, &log)
    };
    assert!(places("-292.000,-182.000").is_ok());
    assert!(places("-292.090,-182.090").is_ok());
    for elsewhere in ["-292.110,-182.000", "-292.000,-181.890", "-292.000,-196.000"] {
        assert_eq!(refused(places(elsewhere)), ["sender.log:2:1 PB601"], "{elsewhere}");
    }
}

#[test]
fn a_failed_probe_is_an_error() {
    let log = "[PRB:0,0,2.1:1]\n ok [PRB:0,0,0.0:0]\n";
    assert_eq!(refused(run_with_log(USES_TWO, TWO, log)), ["sender.log:2:5 PB601"]);
}

#[test]
fn a_broken_result_is_an_error() {
    for broken in ["[PRB:0,0,2.1]", "[PRB:0,0:1]", "[PRB:0,0,x:1]", "[PRB:0,0,2.1:2]", "[PRB:]"] {
        let log = format!("[PRB:0,0,2.1:1]\n{broken}\n");
        assert_eq!(refused(run_with_log(USES_TWO, TWO, &log)), ["sender.log:2:1 PB601"], "{broken}");
    }
}

#[test]
fn a_log_has_one_result_for_each_probe() {
    let one = "[PRB:0,0,2.1:1]\n";
    for count in [0, 1, 3] {
        assert_eq!(refused(run_with_log(USES_TWO, TWO, &one.repeat(count))), ["sender.log PB601"]);
    }
    assert!(run_with_log("X1(=#51)", TWO, &one.repeat(2)).is_ok());
}

#[test]
fn a_value_that_was_entered_must_be_that_of_the_log() {
    let values = |entered: &str| TWO.replace("#52=", &format!("#52={entered}"));
    let log = "[PRB:0,0,2.1:1][PRB:0,0,2.2:1]";
    assert!(run_with_log("X1(=#51)", &values("2,2"), log).is_ok());
    assert_eq!(refused(run_with_log("X1(=#51)", &values("2.201"), log)), ["a_Z.txt:2:29 PB601"]);
    assert_eq!(refused(run_with_log("X1(=#51)", &values("x"), log)), ["a_Z.txt:2:29 PB601"]);
}

/// Returns nine probes on a grid of 100 mm, as the header of a program and as a file of values. Each value deviates by the result of `off`.
fn grid(off: impl Fn(f64, f64) -> f64) -> (String, String) {
    let (mut program, mut values) = (String::new(), String::new());
    for probe in 0..9 {
        let (x, y) = (f64::from(probe % 3) - 1.0, f64::from(probe / 3) - 1.0);
        let place = format!("[{:.3} {:.3}]", x * 100.0, y * 100.0);
        let at = format!("X{:.3} Y{:.3}", x * 100.0, y * 100.0);
        writeln!(program, "(Probe #{}: {place} T=5.000 {at})", 51 + probe).unwrap();
        writeln!(values, "({place}/T=5.000) #{}={:.3}", 51 + probe, 5.0 + off(x, y)).unwrap();
    }
    (program + "G01 X1.000(=#51)\n", values)
}

#[track_caller]
fn odd(off: impl Fn(f64, f64) -> f64) -> Vec<String> {
    let (program, values) = grid(off);
    let adjusted = run(program, values).unwrap_or_else(|problems| panic!("{:?}", placed_codes(&problems)));
    adjusted.warnings.iter().map(|it| format!("{} {}", it.code(), it.text(Lang::En))).collect()
}

#[test]
fn a_probe_that_does_not_fit_its_neighbours_is_told() {
    let bump = |at: (f64, f64), height: f64| {
        move |x: f64, y: f64| 0.2 * x - 0.1 * y + if (x, y) == at { height } else { 0.0 }
    };
    assert_eq!(
        odd(bump((0.0, 0.0), 0.102)),
        ["PB607 #55 is 0.102 mm higher than expected from its neighbours"]
    );
    assert_eq!(odd(bump((0.0, 0.0), 0.098)), [""; 0]);
    assert_eq!(odd(bump((1.0, 1.0), -0.5)), ["PB607 #59 is 0.5 mm lower than expected from its neighbours"]);
}

#[test]
fn tilted_and_bent_plates_have_no_odd_probes() {
    assert_eq!(odd(|x, y| 0.4 * x + 0.3 * y), [""; 0]);
    assert_eq!(odd(|x, y| -0.5 * (1.0 - f64::midpoint(x * x, y * y))), [""; 0]);
    assert_eq!(odd(|x, y| 0.5 * x * y), [""; 0]);
}

/// The corners of a twisted plate are 0.1 mm from the plane through all probes. Eight probes minus three for the plane leave five degrees of
/// freedom for their scatter, which at the middle one is 0.1 * sqrt(4/5 * 9/8).
#[test]
fn a_probe_is_odd_beyond_four_times_the_scatter_of_the_others() {
    let raised = |middle: f64| odd(|x, y| if (x, y) == (0.0, 0.0) { middle } else { 0.1 * x * y });
    assert_eq!(raised(0.379), [""; 0]);
    assert_eq!(raised(0.380), ["PB607 #55 is 0.38 mm higher than expected from its neighbours"]);
}

#[test]
fn programs_that_do_not_say_where_probes_are_have_none_either() {
    let (program, values) = grid(|x, y| if (x, y) == (0.0, 0.0) { 0.9 } else { 0.0 });
    let without: String =
        program.lines().filter(|line| !line.starts_with("(Probe #59")).collect::<Vec<_>>().join("\n");
    assert_eq!(run(&program, &values).unwrap().warnings.len(), 1);
    assert!(run(without, &values).is_err());
    let nowhere: String =
        program.lines().map(|line| line.split(" X").next().unwrap().to_owned() + ")\n").collect();
    let nowhere = nowhere.replace("))", ")").replace("G01 X1.000(=#51)\n", "G01 X1.000(=#51)");
    assert_eq!(run(nowhere, &values).unwrap().warnings, []);
}

#[test]
fn hostile_files_take_neither_time_nor_memory_beyond_their_size() {
    let line = format!("X1{}\n", "(=".repeat(500_000));
    assert_eq!(refused(run(line, VALUES)).len(), 1);
    let many = "X1.000(=#51) ".repeat(200_000);
    assert_eq!(run(&many, VALUES).unwrap().heights, 200_000);
    let unknown = (100..100_100).map(|probe| format!("+#{probe}")).collect::<Vec<_>>().concat();
    assert_eq!(refused(run(format!("X1(=1{unknown})"), VALUES)).len(), 1);
    let zeros = vec![0_u8; 1_000_000];
    assert_eq!(run(&zeros, VALUES).unwrap().program, zeros);
    assert!(run(MADE, &zeros).is_err());
}

/// Returns the warnings about cuts that do not end where the plate is, after a correction of each height by the same amount.
fn plate_warnings(heights: &[&str], correction: f64) -> Vec<String> {
    let lines: Vec<String> = heights.iter().map(|z| format!("G01 Z{z}(={z}+1.000*[#51-2.000])\n")).collect();
    let values = format!("([1.000 2.000]/T=2.000) #51={}\n", 2.0 + correction);
    let warnings = run(lines.concat(), values).unwrap().warnings;
    assert!(warnings.iter().all(|warning| !warning.is_error()));
    placed_codes(&warnings)
}

#[test]
fn cuts_that_no_longer_go_through_are_told_once() {
    let heights = ["1.000", "-0.200", "0.000", "-0.200"];
    assert_eq!(plate_warnings(&heights, 0.0), [""; 0]);
    assert_eq!(plate_warnings(&["-0.200"], 0.201), [""; 0], "as in `check`, 0.001 mm is through");
    assert_eq!(plate_warnings(&["-0.200"], 0.202), ["a_Clean.gcode:1:6 PB602"]);
    assert_eq!(plate_warnings(&["0.001"], 0.001), ["a_Clean.gcode:1:6 PB602"]);
    assert_eq!(plate_warnings(&["0.002"], 0.3), [""; 0], "drawn above the plate");
    assert_eq!(plate_warnings(&heights, 0.3), ["a_Clean.gcode:3:6 PB602"], "the highest");
}

/// Returns the warnings about a program with these moves, each as its coordinates and its height, after a correction by the same amount.
fn warnings_of_cuts(cuts: &[(&str, &str)], correction: f64, shims: &[f64]) -> Vec<String> {
    let line = |(words, z): &(&str, &str)| match *words {
        "START" => format!("(START Subpath {z})\n"),
        "END" => format!("(END Subpath {z})\n"),
        words => format!("G01 {words} Z{z}(={z}+1.000*[#51-2.000])\n"),
    };
    let program = format!("G00 X0 Y0 Z9\n{}", cuts.iter().map(line).collect::<String>());
    let values = format!("([1.000 2.000]/T=2.000) #51={}\n", 2.0 + correction);
    placed_codes(
        &adjust(&Inputs { shims, ..inputs(program.as_bytes(), values.as_bytes()) }).unwrap().warnings,
    )
}

#[test]
fn cuts_above_deeper_ones_need_not_go_through() {
    let passes = |last: &str| {
        let cuts = [("X0", "1.000"), ("X9", "0.000"), ("X20", "0.000"), ("X20", last), ("X9", last)];
        warnings_of_cuts(&cuts, 0.1, &[])
    };
    assert_eq!(passes("-0.200"), ["a_Clean.gcode:3:9 PB602"], "nothing deeper between X0 and X9");
    let back = |to: &str| {
        let cuts = [("X0", "0.000"), ("X9", "0.000"), ("X9", "-0.200"), (to, "-0.200")];
        warnings_of_cuts(&cuts, 0.1, &[])
    };
    assert_eq!(back("X0"), [""; 0]);
    assert_eq!(back("X0.001").len(), 1, "another move");
    assert_eq!(passes("0.000"), ["a_Clean.gcode:3:9 PB602"], "the last pass");
}

#[test]
fn cuts_on_shims_end_at_the_shims() {
    let raised = |z: &str, correction: f64, shims: &[f64]| {
        let cuts = [
            ("START", "1.1P"),
            ("END", "1.1P"),
            ("START", "2.1P"),
            ("X9", z),
            ("END", "2.1P"),
            ("X20", "1.000"),
        ];
        warnings_of_cuts(&cuts, correction, shims)
    };
    assert_eq!(raised("0.800", 0.201, &[0.0, 1.0]), [""; 0]);
    assert_eq!(raised("0.800", 0.202, &[0.0, 1.0]), ["a_Clean.gcode:5:9 PB602"]);
    assert_eq!(raised("0.800", 0.202, &[1.0, 0.0]), [""; 0], "the other path lies on shims");
    assert_eq!(raised("0.800", 0.202, &[]), [""; 0], "unknown");
    assert_eq!(raised("0.800", -0.3, &[0.0, 1.0]), [""; 0]);
    assert_eq!(raised("0.800", -0.301, &[0.0, 1.0]), ["a_Clean.gcode:5:9 PB602"]);
}

#[test]
fn cuts_lowered_deep_below_the_plate_are_told_once() {
    let heights = ["1.000", "-0.200", "0.000", "-0.300"];
    assert_eq!(plate_warnings(&["-0.200"], -0.3), [""; 0]);
    assert_eq!(plate_warnings(&["-0.200"], -0.301), ["a_Clean.gcode:1:6 PB602"]);
    assert_eq!(plate_warnings(&heights, -0.4), ["a_Clean.gcode:4:6 PB602"], "the lowest");
    assert_eq!(plate_warnings(&["-0.800"], 0.1), [""; 0], "drawn so deep");
}

#[test]
fn a_height_that_is_not_corrected_must_be_above_the_measured_surface() {
    let program = |words: &str| {
        format!("(Z1)\nG00 {words} (Z1) ;Z1\nG01 Z1.000(=1.000+1.000*[#51-2.000])\nG00 {words}\n")
    };
    assert_eq!(run(program("X1 Z2.101"), VALUES).unwrap().warnings, []);
    assert_eq!(refused(run(program("X1 Z2.100"), VALUES)), ["a_Clean.gcode:2:9 PB602"]);
    assert_eq!(refused(run(program("z 2"), VALUES)), ["a_Clean.gcode:2:7 PB602"]);
}
