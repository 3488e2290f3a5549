//! Tests programs with subprograms and loops: those in the same file are run wherever they are called. If a program calls any others, its lengths
//! and times are not reported. (book: program/reading, "Subprograms")

use crate::support::Place;

const SUBROUTINE: &str = "G21 G90\nG0 Z5\nG0 X0 Y0\no100 sub\nG91 G1 X10 F100\nG90\no100 endsub\nG1 Z-1 F100\no100 call\no100 call\nM2\n";
const M98: &str = "%\nO1000\nG21 G90\nG0 Z5.\nG0 X0. Y0.\nG1 Z-1. F100.\nM98 P2000 L3\nG0 Z5.\nM30\n";
const BODY: &str = "O2000\nG91 G1 X10. F100.\nG90\nM99\n%\n";
const LOOP: &str = "#1=0\nG21 G90\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\no1 while [#1 LT 2]\no2 if [#1 GE 0]\nG91 G1 X10 F100\nG90\no2 endif\n#1=[#1+1]\no1 endwhile\nM2\n";
const CALCULATED: &str = "G21 G90\nG0 Z5\nG0 X0 Y0\no[99+1] call\nG1 Z-1 F100\nM2\n";
const PLAIN: &str = "%\nO1000\nG21 G90\nG0 Z5.\nG0 X0. Y0.\nG1 Z-1. F100.\nG0 Z5.\nM30\n%\n";

fn place() -> Place {
    Place::new()
        .file("sub.ngc", SUBROUTINE)
        .file("same.nc", format!("{M98}{BODY}"))
        .file("elsewhere.nc", format!("{M98}%\n"))
        .file("loop.ngc", LOOP)
        .file("calculated.ngc", CALCULATED)
        .file("plain.nc", PLAIN)
}

#[test]
fn subprograms_and_loops_of_the_same_file_count_wherever_they_run() {
    let place = place();
    for (file, dialect, cut) in [
        ("sub.ngc", "linuxcnc", "26.0"),
        ("loop.ngc", "linuxcnc", "26.0"),
        ("same.nc", "fanuc", "36.0"),
        ("same.nc", "haas", "36.0"),
    ] {
        let run = place.run(&format!("import {file} --dialect {dialect} --rapid 1000"));
        assert_eq!(run.status, Some(0), "{run}");
        assert!(run.stdout.contains(&format!(" {cut} mm cutting")), "{run}");
        assert!(run.stderr.is_empty(), "{run}");
        let run = place.run(&format!("verify {file} --dialect {dialect} --format concise"));
        assert!(run.stderr.contains("errors: 0, warnings: 0"), "{run}");
    }
}

#[test]
fn lengths_and_times_of_what_is_not_followed_are_not_known() {
    let place = place();
    for (file, dialect, line) in [("calculated.ngc", "linuxcnc", 4), ("elsewhere.nc", "fanuc", 7)] {
        let run = place.run(&format!("import {file} --dialect {dialect} --rapid 1000"));
        assert_eq!(
            run.stdout.matches(&format!("not known: line {line} is not followed")).count(),
            2,
            "{run}"
        );
        assert!(!run.stdout.contains(" mm") && !run.stdout.contains(" min"), "{run}");
        let json = place.run(&format!("import {file} --dialect {dialect} --format json"));
        assert!(json.stdout.contains("\"minutes\":null"), "{json}");
        assert!(json.stdout.contains(&format!("\"unfollowed_line\":{line}")), "{json}");
    }
    let run = place.run("import elsewhere.nc --dialect fanuc --lang de");
    assert!(run.stderr.contains("das Unterprogramm O2000 steht nicht in dieser Datei"), "{run}");
    let run = place.run("import plain.nc --rapid 1000");
    assert!(!run.stdout.contains("not known") && run.stdout.contains(" mm cutting"), "{run}");
}

#[test]
fn a_comparison_claims_no_lengths() {
    let place = place();
    assert!(!place.run("diff plain.nc elsewhere.nc").stdout.contains("cutting:"));
}

#[test]
fn a_program_of_a_drawing_calls_nothing() {
    let place = Place::of(
        "== pathbuild.toml ==\nfeed = 150\nrapid = 1000\nsweep-height = 20\npost = \"linuxcnc\"\n\
         [tool.a]\ndiameter = 2\nnumber = 1\nspindle = 9000\n\
         == 1234.dxf ==\nlayer 1234.1P\nstart 0,0 \"T4 O2 B1 I2 MPlate\"\nmill 0,0 40,0\nend 40,0\n",
    );
    let run = place.run("emit 1234.1P --out-dir out");
    assert_eq!(run.status, Some(0), "{run}");
    let good = place.read("out/1234_Milling.ngc");
    let cut = good.lines().find(|line| line.contains("X40")).unwrap();
    // The moves are the same, but the control may find another subroutine of that name.
    let called = good.replacen(cut, &format!("o7 sub\n{cut}\no7 endsub\no7 call"), 1);
    let place = place.file("good.ngc", good).file("called.ngc", called);
    let run = place.run("verify good.ngc --against 1234.1P");
    assert_eq!(run.status, Some(0), "{run}");
    let run = place.run("verify called.ngc --against 1234.1P --format concise");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("moves as in path") && run.stderr.contains("PB778"), "{run}");
}

/// The lines of a subprogram say nothing about the tool in the spindle: it may stand above the tool change that comes before its call.
#[test]
fn a_subprogram_is_checked_with_the_only_tool_wherever_it_stands() {
    let body = |rapid: &str| format!("o100 sub\nG1 X40 F300\nG1 Y8\n{rapid}\nG0 Y8\no100 endsub\n");
    let program = |rapid: &str| {
        let change =
            "T2 M6\nS6000 M3\nG43 H2\nG0 Z30\nG0 X0 Y0\nZ2\nG1 Z-2 F100\no100 call\nG0 Z20\nM5\nM30\n";
        format!("(T2 D=6. CR=0. - FLAT END MILL)\nG21 G90 G94 G17\n{}{change}", body(rapid))
    };
    let place = Place::new().file("sound.ngc", program("G0 Y1")).file("crash.ngc", program("G0 Y30"));
    let verify =
        |file: &str| place.run(&format!("verify {file} --dialect linuxcnc --surface 0 --format concise"));
    let (sound, crash) = (verify("sound.ngc"), verify("crash.ngc"));
    assert!(sound.stderr.contains("errors: 0") && sound.stderr.contains("a cutter of 6 mm"), "{sound}");
    assert!(crash.stderr.contains("PB740"), "{crash}");
}

/// A program in which two tools cut in O2000 and move back in O3000, the second one beside the middle of the first one's groove.
fn two_tools([first, second]: [&str; 2], beside: &str, is_linuxcnc: bool) -> String {
    let change = |tool: &str| format!("T{tool} M6\nS6000 M3\nG43 H{tool}\nG0 Z30\n");
    let subs = "O2000\nG91 G1 X40 F300\nG90\nM99\nO3000\nG91 G0 X-40\nG90\nM99\n";
    let main = format!(
        "{}G0 X0 Y0\nZ2\nG1 Z-2 F100\nM98 P2000\nM98 P3000\nG0 Z30\n{}G0 X40 Y{beside}\nZ2\nG1 Z-2 F100\n\
         M98 P3000\nG0 Z30\nG0 X0 Y30\nZ2\nG1 Z-2 F100\nM98 P2000\nG0 Z30\nM5\nM30\n",
        change(first),
        change(second)
    );
    let head = "(T2 D=6. CR=0. - FLAT END MILL)\n(T5 D=2. CR=0. - FLAT END MILL)\nG21 G90 G94 G17\n";
    if !is_linuxcnc {
        return format!("%\nO1000\n{head}{main}{subs}%\n");
    }
    let subs = subs.replace("M99", "endsub").replace("O2000", "o2000 sub").replace("O3000", "o3000 sub");
    let (cut, back) = subs.split_once("endsub\n").unwrap();
    let back = back.replace("endsub", "o3000 endsub");
    let main = main.replace("M98 P2000", "o2000 call").replace("M98 P3000", "o3000 call");
    format!("{head}{cut}o2000 endsub\n{back}{main}")
}

/// The tool of a move in a subprogram is the one that is in the spindle during the call.
#[test]
fn a_subprogram_is_checked_with_the_tool_of_each_call() {
    let cases = [(["2", "5"], "2", 0), (["2", "5"], "2.1", 1), (["5", "2"], "0", 1)];
    for (dialect, is_linuxcnc) in [("haas", false), ("linuxcnc", true)] {
        for (tools, beside, status) in cases {
            let place = Place::new().file("a.nc", two_tools(tools, beside, is_linuxcnc));
            let run = place.run(&format!("verify a.nc --dialect {dialect} --surface 0 --format concise"));
            assert_eq!((run.status, run.stderr.contains("PB740")), (Some(status), status == 1), "{run}");
            assert!(run.stderr.contains("rapid moves against a cutter of"), "{run}");
        }
    }
}

/// Each tool is compared with its own limits. A line of a subprogram is reported once, a tool change for each use of the tool.
#[test]
fn limits_of_tools_apply_to_their_own_calls() {
    let config = |flutes: u32, direction: &str| {
        format!(
            "[tool.a]\ndiameter = 6\nnumber = 2\nflutes = 2\nchip-load = [0.01, 0.1]\n\
             [tool.b]\ndiameter = 2\nnumber = 5\nflutes = {flutes}\nchip-load = [0.01, 0.1]\ndirection = \"{direction}\"\n"
        )
    };
    let found = |flutes, direction| {
        let program = two_tools(["2", "5"], "2", false);
        let twice =
            program.replace("M5\n", &program[program.find("T5 M6").unwrap()..program.find("M5\n").unwrap()]);
        let place =
            Place::of(&format!("== pathbuild.toml ==\n{}", config(flutes, direction))).file("a.nc", twice);
        let run = place.run("verify a.nc --dialect haas --surface 0 --format concise");
        ["PB790", "PB783"].map(|code| run.stderr.matches(code).count())
    };
    assert_eq!(found(2, "cw"), [0, 0]);
    assert_eq!(found(6, "ccw"), [1, 2]);
}

#[test]
fn a_page_shows_each_call_of_a_subprogram_with_its_own_tool() {
    let place = Place::new().file("a.nc", two_tools(["2", "5"], "2", false));
    let run = place.run("view a.nc --dialect haas --surface 0 -o a.json");
    assert_eq!(run.status, Some(0), "{run}");
    let scene: serde_json::Value = serde_json::from_str(&place.read("a.json")).unwrap();
    let path = &scene["paths"][0];
    let diameter = |movement: &serde_json::Value| {
        path["tools"][usize::try_from(movement["tool"].as_u64()?).ok()?]["diameter"].as_f64()
    };
    let cuts = path["moves"].as_array().unwrap().iter().filter(|movement| movement["kind"] == "mill");
    assert_eq!(cuts.map(diameter).collect::<Vec<_>>(), [Some(6.0), Some(2.0)]);
}
