//! Programs with subprograms and loops, which are not followed: nothing is claimed of their lengths and times. (book: program/reading)

use crate::support::Place;

const O_WORDS: &str =
    "G21 G90\nG0 Z5\nG0 X0 Y0\no100 sub\nG1 Z-1 F100\nG1 X10\no100 endsub\no100 call\no100 call\nM2\n";
const M98: &str = "%\nO1000\nG21 G90\nG0 Z5.\nG0 X0. Y0.\nG1 Z-1. F100.\nM98 P2000 L3\nG0 Z5.\nM30\n%\n";
const PLAIN: &str = "%\nO1000\nG21 G90\nG0 Z5.\nG0 X0. Y0.\nG1 Z-1. F100.\nG0 Z5.\nM30\n%\n";

fn place() -> Place {
    Place::new().file("o.ngc", O_WORDS).file("m98.nc", M98).file("plain.nc", PLAIN)
}

#[test]
fn lengths_and_times_are_not_known() {
    let place = place();
    for (file, line) in [("o.ngc", 4), ("m98.nc", 7)] {
        let run = place.run(&format!("import {file} --rapid 1000"));
        assert_eq!(
            run.stdout.matches(&format!("not known: line {line} is not followed")).count(),
            2,
            "{run}"
        );
        assert!(!run.stdout.contains(" mm") && !run.stdout.contains(" min"), "{run}");
        let json = place.run(&format!("import {file} --format json"));
        assert!(json.stdout.contains("\"minutes\":null"), "{json}");
        assert!(json.stdout.contains(&format!("\"unfollowed_line\":{line}")), "{json}");
    }
    let run = place.run("import plain.nc --rapid 1000");
    assert!(!run.stdout.contains("not known") && run.stdout.contains(" mm cutting"), "{run}");
}

#[test]
fn a_comparison_claims_no_lengths() {
    let place = place();
    assert!(!place.run("diff plain.nc m98.nc").stdout.contains("cutting:"));
}
