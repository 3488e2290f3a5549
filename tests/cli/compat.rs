//! Tests command lines of `PathDxf2GCode` and `PathGCodeAdjustZ`. (book: howto/from-pathdxf2gcode)

use crate::support::{Place, Run};
use insta::assert_snapshot;

fn compat(arguments: &[&str]) -> Run {
    Place::new().run_with(&[&["compat"], arguments].concat())
}

/// Returns the translation of a command line of the original programs.
fn translated(arguments: &[&str]) -> String {
    let run = compat(&[&["--print"], arguments].concat());
    assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""), "{run}");
    run.stdout.trim_end().to_owned()
}

#[test]
fn every_option_has_its_counterpart() {
    let all = "/f150 /v1000 /s15 /z40 /dparts /n[0-9] /p[0-9]+ /eP$:L$ /lde";
    assert_eq!(
        translated(&all.split(' ').chain(["2913.dxf"]).collect::<Vec<_>>()),
        "pathbuild emit --feed=150 --rapid=1000 --sweep-height=15 --probe-feed=40 --search=parts \
         '--path-pattern=[0-9]' '--file-pattern=[0-9]+' '--restrict=P$:L$' --lang=de --compatible -- 2913.dxf"
    );
}

#[test]
fn values_are_glued_or_follow() {
    let glued = translated(&["/f150", "/v1000", "/s15,5", "/dparts", "/dmore", "a.dxf", "b.dxf"]);
    let apart =
        translated(&["/f", "150", "/v", "1000", "a.dxf", "/s", "15,5", "/d", "parts", "/d", "more", "b.dxf"]);
    assert_eq!(glued, apart);
    assert_eq!(
        glued,
        "pathbuild emit --feed=150 --rapid=1000 --sweep-height=15,5 --search=parts --search=more --compatible -- a.dxf b.dxf"
    );
}

#[test]
fn the_command_is_told_by_the_options() {
    assert_eq!(translated(&["/c", "a.dxf"]), "pathbuild check --compatible -- a.dxf");
    assert_eq!(translated(&["/C", "a.dxf"]), "pathbuild check --compatible -- a.dxf");
    assert_eq!(
        translated(&["/x", "O2", "a.dxf"]),
        "pathbuild texts --match=O2 --compatible -- a.dxf\npathbuild emit --compatible -- a.dxf"
    );
    assert_eq!(
        translated(&["/xO2", "/c", "a.dxf"]).lines().last(),
        Some("pathbuild check --compatible -- a.dxf")
    );
    assert_eq!(
        translated(&["a_Clean.gcode", "--max-correction", "1"]),
        "pathbuild adjust --max-correction 1 --compatible -- a_Clean.gcode"
    );
    assert_eq!(
        translated(&["/m0,5", "a_Z.txt"]),
        "pathbuild adjust --max-correction=0,5 --compatible -- a_Z.txt"
    );
    assert_eq!(
        translated(&["/m", "1", "/xG01", "a"]),
        "pathbuild adjust --max-correction=1 --show=G01 --compatible -- a"
    );
}

#[cfg(unix)]
#[test]
fn names_of_files_take_backslashes() {
    assert_eq!(
        translated(&["/c", r"/d..\Parts", r"sub\2913 Ph.DXF"]),
        "pathbuild check --search=../Parts --compatible -- 'sub/2913 Ph.DXF'"
    );
    assert_eq!(
        translated(&[r"/n\d+", "a"]),
        r"pathbuild emit '--path-pattern=\d+' --compatible -- a",
        "patterns keep theirs"
    );
}

#[test]
fn a_drawing_named_from_the_root_is_no_option() {
    assert_eq!(translated(&["/c", "/home/me/a.dxf"]), "pathbuild check --compatible -- /home/me/a.dxf");
    assert_eq!(translated(&["/c", "-odd.dxf"]), "pathbuild check --compatible -- -odd.dxf");
}

#[test]
fn wrong_command_lines_are_refused() {
    for arguments in
        [&["/k3", "a.dxf"][..], &["a.dxf", "/f"], &["/c"], &["/"], &["/f=", "a.dxf"], &["a_Clean.gcode"]]
    {
        let run = compat(arguments);
        assert_eq!((run.status, run.stdout.as_str()), (Some(2), ""), "{run}");
    }
    assert_snapshot!(compat(&["/k3", "a.dxf"]));
    assert_snapshot!("no_correction", compat(&["a_Clean.gcode"]));
    assert_snapshot!(compat(&["/fx", "/c", "a.dxf"]));
}

#[test]
fn their_help_is_this_table() {
    assert_snapshot!(compat(&["/f150", "/h"]));
    assert_eq!(compat(&["/?"]).stdout, compat(&["/h"]).stdout);
}

#[test]
fn options_of_ours_stand_before_compat() {
    let run = Place::new().run("--format json compat /fx /c a.dxf");
    assert_eq!(run.status, Some(2));
    assert!(run.stdout.contains(r#""code":"PB003""#), "{run}");
    let run = Place::new().run("-v --lang compat compat /c a.dxf");
    assert_eq!(run.status, Some(2), "{run}");
    let run = Place::new().run("-v compat /fx /c a.dxf");
    assert!(run.stderr.starts_with("pathbuild check --feed=x --compatible -- a.dxf\n"), "{run}");
}

#[test]
fn options_with_a_hyphen_are_theirs_and_with_two_ours() {
    assert_eq!(
        translated(&["-f150", "-v", "1000", "-s15", "a.dxf", "--format", "concise", "--force"]),
        "pathbuild emit --feed=150 --rapid=1000 --sweep-height=15 --format concise --force --compatible -- a.dxf"
    );
    assert_eq!(
        translated(&["-c", "/l", "de-AT", "a.dxf"]),
        "pathbuild check --lang=de --compatible -- a.dxf"
    );
}

#[test]
fn options_are_written_as_people_write_them() {
    let plain = "pathbuild emit --feed=150 --rapid=1000 --sweep-height=15 --lang=de --compatible -- a.dxf";
    for line in [
        "/f150 /v1000 /s15 /lde a.dxf",
        "-f150 -v1000 -s15 -lde a.dxf",
        "/F 150 /V 1000 /S 15 /L DE a.dxf",
        "-F 150 -V 1000 -S 15 -L de-AT a.dxf",
        "/f=150 /v:1000 -s=15 /l=de_AT a.dxf",
        "a.dxf -f 150 -v 1000 -s 15 -l de",
    ] {
        assert_eq!(translated(&line.split(' ').collect::<Vec<_>>()), plain, "{line}");
    }
    let one = |line: &str| translated(&line.split(' ').collect::<Vec<_>>());
    assert_eq!(
        one("-v 1000 a.dxf"),
        "pathbuild emit --rapid=1000 --compatible -- a.dxf",
        "not our --verbose"
    );
    assert_eq!(
        one("-x B1 -c a.dxf").lines().next(),
        Some("pathbuild texts --match=B1 --compatible -- a.dxf")
    );
    assert_eq!(
        one("/x=51 /m=1 a").lines().next(),
        Some("pathbuild adjust --max-correction=1 --show==51 --compatible -- a")
    );
    assert_eq!(compat(&["-h"]).stdout, compat(&["/?"]).stdout);
    assert!(compat(&["--help"]).stdout.contains("Usage: pathbuild compat"));
}

#[test]
fn the_path_that_is_called_compat_is_a_path() {
    let run = Place::new().run("check compat -v --lang en");
    assert!(!run.stderr.contains("unexpected argument"), "{run}");
    let run = Place::new().run("-q compat --lang de -v 1000 /k3");
    assert!(run.stderr.contains("unbekannte Option /k3"), "{run}");
}

#[test]
fn their_help_is_in_the_language_that_is_named() {
    let place = Place::new();
    let is_german = |line: &str| place.run(line).stdout.contains("DATEIEN");
    for line in
        ["compat /h /lde", "compat /lde /h", "compat /? /l=de-AT", "compat /h /l de", "compat -h -lDE"]
    {
        assert!(is_german(line), "{line}");
    }
    for line in ["compat /h", "compat /h /len", "compat /h /lfr", "--lang de compat /h /len"] {
        assert!(!is_german(line), "{line}");
    }
    assert!(is_german("--lang de compat /h"));
}
