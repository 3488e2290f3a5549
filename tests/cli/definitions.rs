//! Tests programs of a definition without a dialect: `verify` reads them by means of the definition, and compares them with the text that it
//! writes. (book: program/reading, "Programs of a definition of your own")

use std::fs;

use serde_json::Value;

use crate::support::{Place, Run};

const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["."]
feed = 250
rapid = 1000
sweep-height = 20
[tool.2mm]
diameter = 2
number = 1
spindle = 4000
coolant = "flood"
== own.toml ==
[post]
name = "Workshop"
extension = "nc"
decimals = 3
lift-between-passes = true
[text]
program-start = """
{=LineNumber{10}}
%~PrgName~
G17 G71 G90
"""
tool-change = """
T{#~MachineToolNo~} S{#~MillingSpindleRate~} M06
G00 G40 Z{+~ZClearance~}
"""
contour-start = """
G00 X{+~X1~} Y{+~Y1~}
G00 Z{+~ZWorking~} M03
G01 Z{+~Z1~} F{#~LoweringVel~} M08
"""
line = "G01 X{+~X1~} Y{+~Y1~} Z{+~Z1~} F{#~MovingVel~}"
contour-end = "G00 Z{+~ZClearance~}"
program-end = """
M05 M09
M30
"""
== 1234.dxf ==
layer 1234.1P
start 10,10 "T5 O2 I2 B1 MPlate"
mill 10,10 50,10
sweep 50,10 60,20
mill 60,20 60,40
end 60,40
"#;

const PROGRAM: &str = "1234_Milling.nc";

fn written() -> Place {
    let place = Place::of(LIBRARY);
    let run = place.run("emit 1234.1P --post own.toml");
    assert_eq!(run.status, Some(0), "{run}");
    place
}

fn verify(place: &Place, arguments: &str) -> Run {
    place.run(&format!("verify {PROGRAM} --format concise {arguments}"))
}

#[track_caller]
fn assert_clean(run: &Run) {
    assert_eq!(run.status, Some(0), "{run}");
    assert!(run.stderr.contains("errors: 0, warnings: 0"), "{run}");
}

#[test]
fn a_program_of_a_definition_is_as_drawn() {
    let place = written();
    assert_clean(&verify(&place, "--against 1234.1P --post own.toml"));
    assert_clean(&verify(&place, "--post own.toml"));
    let run = verify(&place, "--against 1234.1P --post own.toml");
    assert!(run.stderr.contains("read as own.toml"), "{run}");
}

#[test]
fn the_configured_definition_reads_programs_without_a_header() {
    let place = written();
    let configuration = place.read("pathbuild.toml");
    fs::write(place.path().join("pathbuild.toml"), format!("post = \"own.toml\"\n{configuration}")).unwrap();
    let run = verify(&place, "--against 1234.1P");
    assert_clean(&run);
    assert!(run.stderr.contains("read as own.toml"), "{run}");
    let run = place.run(&format!("view {PROGRAM} -o shown.json"));
    assert_eq!(run.status, Some(0), "{run}");
    assert!(place.read("shown.json").contains("\"en\":\"own.toml\""), "{run}");
    // The text that the definition makes of a program has no comments: they are read from the program itself.
    let program = format!("(T1 D=2 CR=0 - ZMIN=-1 - flat end mill)\n{}", place.read(PROGRAM));
    fs::write(place.path().join(PROGRAM), program).unwrap();
    place.run(&format!("view {PROGRAM} -o shown.json"));
    let shown: Value = serde_json::from_str(&place.read("shown.json")).unwrap();
    assert_eq!(shown["program"]["cutters"][0]["diameter"], 2.0);
}

#[test]
fn a_program_of_an_unchecked_definition_is_not_called_as_drawn() {
    let place = Place::of(&LIBRARY.replace(r#"line = "G01 X{+~X1~} "#, r#"line = "G01 X{+~PrevX~} "#));
    let configure = |unchecked: &str| {
        let configuration = place.read("pathbuild.toml");
        let rest = configuration.split_once("library").unwrap().1;
        let post = format!("post = {{ name = \"own.toml\", unchecked = {unchecked} }}\nlibrary{rest}");
        fs::write(place.path().join("pathbuild.toml"), post).unwrap();
    };
    configure("true");
    let run = place.run("emit 1234.1P");
    assert_eq!(run.status, Some(0), "{run}");
    let run = verify(&place, "--against 1234.1P");
    assert!(!run.stderr.contains("moves as in path"), "{run}");
    assert!(run.stderr.contains("the moves were not compared with path 1234.1P"), "{run}");
    assert!(run.stderr.contains("errors: 0, warnings: 1"), "{run}");
    assert!(
        run.stderr.contains("not checked:") && !run.stderr.contains("words, moves of the drawing"),
        "{run}"
    );
    let required = verify(&place, "--against 1234.1P --require drawing");
    assert!(required.status == Some(1) && required.stderr.contains("PB523"), "{required}");
    let text = place.read(PROGRAM);
    fs::write(place.path().join(PROGRAM), text.replacen("Y+30", "Y+31", 1)).unwrap();
    let run = verify(&place, "--against 1234.1P");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(!run.stderr.contains("moves as in path"), "{run}");
    configure("false");
    let run = place.run("emit 1234.1P --out-dir elsewhere");
    assert_eq!(run.status, Some(1), "it moves elsewhere than the drawing\n{run}");
}

/// Comments may differ, whatever their form; their lines may be numbered.
#[test]
fn the_comments_of_a_definition_are_no_differences() {
    for (comment, is_numbered) in [
        ("(~CommentText~)", true),
        ("(~CommentText~)", false),
        ("; ~CommentText~", true),
        ("; ~CommentText~", false),
    ] {
        let library = LIBRARY.replace(
            "program-end = \"\"\"\nM05 M09\n",
            &format!("comment = '{comment}'\nprogram-end = \"\"\"\n"),
        );
        let library =
            library.replace("decimals = 3\n", &format!("decimals = 3\nnumber-lines = {is_numbered}\n"));
        let place = Place::of(&library);
        let run = place.run("emit 1234.1P --post own.toml");
        assert_eq!(run.status, Some(0), "{run}");
        let text = place.read(PROGRAM);
        assert!(text.contains("pathbuild 0.") && !text.contains("M05"), "{text}");
        let against = "--against 1234.1P --post own.toml";
        assert_clean(&verify(&place, against));
        for (from, to, is_found) in [
            ("pathbuild 0.", "pathbuild 9.", false),
            ("Path 1234", "Pfad 1234", false),
            ("Y+30", "Y+31", true),
        ] {
            fs::write(place.path().join(PROGRAM), text.replacen(from, to, 1)).unwrap();
            let run = verify(&place, against);
            assert_eq!(run.status, Some(i32::from(is_found)), "{comment} {is_numbered}: {from}\n{run}");
        }
    }
}

/// The spindle may be stopped twice, but not started, after the last cut.
#[test]
fn a_definition_that_starts_the_spindle_at_the_end_has_a_warning() {
    for (end, is_found) in [("M05 M09", false), ("M09", false), ("M05 M09\nM03", true), ("M04 M09", true)] {
        let place = Place::of(&LIBRARY.replace("M05 M09\n", &format!("{end}\n")));
        let run = place.run("emit 1234.1P --post own.toml --format concise");
        assert_eq!(run.status, Some(0), "{end}: {run}");
        assert_eq!(run.stderr.contains("starts the spindle after the last cut"), is_found, "{end}: {run}");
    }
}

/// Lines of the program, each with the text that replaces it and whether `verify` must report the change.
const CHANGES: [(&str, &str, bool); 14] = [
    ("G00 Z+5 M03", "G00 Z+5", true),
    ("G17 G71 G90", "G17 G70 G90", true),
    ("G17 G71 G90", "G17 G71 G91", true),
    ("S4000", "S400", true),
    ("T1 ", "T2 ", true),
    ("X+50 Y+10", "X+50.1 Y+10", true),
    ("Z+20", "Z+19", true),
    ("F250", "F251", true),
    ("M08", "M09", true),
    ("G17 G71 G90", "G17 G71 G90 G68 R10", true),
    ("G17 G71 G90", "G17 G71 G90 G55", true),
    ("M05 M09", "M98 P5", true),
    ("G17 G71 G90", "G17 G71 G90 G40", false),
    ("M05 M09", "(done) M05 M09", false),
];

#[test]
fn a_program_that_differs_from_what_its_definition_writes_has_a_finding() {
    let place = written();
    let text = place.read(PROGRAM);
    for (from, to, is_found) in CHANGES {
        assert!(text.contains(from), "{from}\n{text}");
        fs::write(place.path().join(PROGRAM), text.replacen(from, to, 1)).unwrap();
        let run = verify(&place, "--against 1234.1P --post own.toml");
        assert_eq!(run.status, Some(i32::from(is_found)), "{from} -> {to}\n{run}");
    }
}

/// Tool and speed are given by the definition only, since `[tool]` has none.
#[test]
fn what_the_definition_alone_says_about_tool_and_spindle_is_compared() {
    let table = "[tool.2mm]\ndiameter = 2\nnumber = 1\nspindle = 4000\ncoolant = \"flood\"\n";
    assert!(LIBRARY.contains(table));
    let library = LIBRARY.replace(table, "").replace("S{#~MillingSpindleRate~} M06", "M06\nS4000");
    let place = Place::of(&library);
    let run = place.run("emit 1234.1P --post own.toml");
    assert_eq!(run.status, Some(0), "{run}");
    let text = place.read(PROGRAM);
    for (from, to, is_found) in [
        ("T1 M06", "T1 M06", false),
        ("T1 M06", "T2 M06", true),
        ("T1 M06", "T1", true),
        ("S4000", "S400", true),
        ("M03", "M04", true),
        (" M08\n", " M08\nS1\n", true),
        (" M08\n", " M08\nS4000\n", false),
    ] {
        assert!(text.contains(from), "{from}\n{text}");
        fs::write(place.path().join(PROGRAM), text.replacen(from, to, 1)).unwrap();
        let run = verify(&place, "--against 1234.1P --post own.toml");
        assert_eq!(run.status, Some(i32::from(is_found)), "{from} -> {to}\n{run}");
    }
}

#[test]
fn words_that_the_definition_does_not_write_are_doubtful() {
    let place = written();
    let text = place.read(PROGRAM);
    for (word, is_found) in
        [("G68 R10", true), ("G41 D1", true), ("M98 P5", true), ("G40", false), ("M01", false)]
    {
        fs::write(place.path().join(PROGRAM), text.replacen("G17", &format!("{word} G17"), 1)).unwrap();
        let run = verify(&place, "--post own.toml");
        assert_eq!(run.stderr.contains("PB778"), is_found, "{word}\n{run}");
    }
}

#[test]
fn one_warning_names_the_words_on_which_controls_disagree() {
    let place = Place::of(LIBRARY);
    let run = place.run("emit 1234.1P --post own.toml --format concise");
    assert_eq!(run.stderr.matches("controls disagree on the meaning of G71").count(), 1, "{run}");
    let run = place.run("emit 1234.1P --post own.toml --dialect din --format concise");
    assert!(!run.stderr.contains("controls disagree"), "{run}");

    let program =
        |word: &str| format!("G17 G21 G40 G54 G90 G94 F100\nG0 Z5\nG0 X0 Y0\n{word}\n{word}\nM30\n");
    for (word, is_disputed) in [("G53 G0 Z0", false), ("G4 P1", true), ("G0 Z6", false)] {
        fs::write(place.path().join("a.nc"), program(word)).unwrap();
        let run = place.run("verify a.nc --format concise");
        assert_eq!(run.stderr.matches("PB779").count(), usize::from(is_disputed), "{word}\n{run}");
        let run = place.run("verify a.nc --format concise --dialect linuxcnc");
        assert!(!run.stderr.contains("PB779"), "{word}\n{run}");
    }
}

#[test]
fn a_program_may_go_straight_to_where_it_first_goes_down() {
    let drawing = "== 1235.dxf ==\nlayer 1235.1P\nstart 0,0 \"T5 O2 I4 B1 MPlate\"\nsweep 0,0 10,10\nmill 10,10 50,10\nend 50,10\n";
    let place = Place::of(&format!("{LIBRARY}{drawing}"));
    assert_eq!(place.run("emit 1235.1P --post own.toml").status, Some(0));
    let text = place.read("1235_Milling.nc");
    let verify = |text: &str| {
        fs::write(place.path().join(PROGRAM), text).unwrap();
        verify(&place, "--against 1235.1P --dialect din")
    };
    assert!(text.contains("G00 X+10 Y+10") && !text.contains("X+0 Y+0"), "{text}");
    assert_clean(&verify(&text));
    let low = verify(&text.replacen("G00 G40 Z+20", "G00 G40 Z+15", 1));
    assert!(low.stderr.contains("PB739"), "{low}");
}

#[test]
fn the_program_number_is_the_drawing_s_and_block_numbers_are_free() {
    let place = Place::of(LIBRARY);
    let run = place.run("emit 1234.1P --post fanuc");
    assert_eq!(run.status, Some(0), "{run}");
    let text = place.read(PROGRAM);
    let verify = |text: &str| {
        fs::write(place.path().join(PROGRAM), text).unwrap();
        verify(&place, "--against 1234.1P")
    };
    assert_clean(&verify(&text));
    let other = verify(&text.replacen("O1234", "O1235", 1));
    assert!(other.stderr.contains("PB739") && other.stderr.contains("O1235"), "{other}");
    let numbered = text.replace("\nG", "\nN5 G");
    assert_clean(&verify(&numbered));
    let jump = verify(&text.replacen("\nM5", "\nM99 P5\nM5", 1));
    assert!(jump.stderr.contains("PB721"), "{jump}");
}

const ROTARY: &str = "<PostProcessor><RotaryWrap>true</RotaryWrap><AxisOfSpin>Y</AxisOfSpin><RotaryAxis>A</RotaryAxis></PostProcessor>";

#[test]
fn words_that_are_left_out_are_compared_as_text() {
    for dialect in ["", " --dialect mach3"] {
        let place = Place::of(LIBRARY).file("rotary.cbpp", ROTARY);
        let run = place.run(&format!("emit 1234.1P --post rotary.cbpp{dialect}"));
        assert_eq!(run.status, Some(0), "{run}");
        let text = place.read(PROGRAM);
        let arguments = format!("--against 1234.1P --post rotary.cbpp{dialect}");
        assert_clean(&verify(&place, &arguments));
        let at = text.rfind('A').unwrap() + 1;
        let changed = format!("{}1{}", &text[..at], &text[at..]);
        fs::write(place.path().join(PROGRAM), changed).unwrap();
        let run = verify(&place, &arguments);
        assert!(run.stderr.contains("PB739"), "{run}");
    }
}
