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
