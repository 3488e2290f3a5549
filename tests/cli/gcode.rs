//! `import`, `verify` and `post`: programs of any origin. (spec/85-post-processors.md, spec/90-gcode-import.md)

use crate::support::{Place, runs};
use insta::assert_snapshot;

/// A program as other software writes it: two tools, a circle, a dwell; no word on the plane.
const FOREIGN: &str = "\
%
G21 G90 G94
T1 M6
M3 S12000
G0 Z5
G0 X0 Y0
G1 Z-1 F60
G1 X20 F300
G2 X20 Y0 I-5 J0
G4 P1.5
G0 Z5
T2 M6
M3 S8000
G0 X40 Y10
G1 Z-2 F40
G0 Z5
M30
%
";

const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["parts"]
feed = 150
rapid = 1000
sweep-height = 20
[tool.2mm]
diameter = 2
number = 1
spindle = 12000
== parts/1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
== parts/1300.dxf ==
layer 1300.1P
start 0,20 "T5 O2 I1 B4 MPlate"
mill 0,20 40,20
probe 20,20 "LA"
end 40,20
== parts/1400.dxf ==
layer 1400.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 41,0
end 41,0
"#;

#[test]
fn import_says_what_a_program_is() {
    let place = Place::new().file("foreign.nc", FOREIGN);
    assert_snapshot!(runs(
        &place,
        [
            "import foreign.nc",
            "import foreign.nc --rapid 1000 --lang de",
            "import foreign.nc --dialect linuxcnc --format json",
            "import foreign.nc --dialect siemens",
            "import missing.nc",
        ]
    ));
}

#[test]
fn import_reckons_with_what_the_machine_can_do() {
    let machine = "rapid = 3000\n[machine]\naccelerations = [100, 100, 20]\n";
    let place = Place::new().file("foreign.nc", FOREIGN).file("pathbuild.toml", machine);
    let slow = place.run("import foreign.nc").stdout;
    let stronger = machine.replace("[100, 100, 20]", "[2000, 2000, 1000]");
    let fast = place.file("pathbuild.toml", stronger).run("import foreign.nc").stdout;
    let time =
        |text: &str| text.lines().find(|line| line.trim_start().starts_with("time")).unwrap().to_owned();
    assert_snapshot!(format!("{}\n{}", time(&slow), time(&fast)));
}

#[test]
fn import_reads_the_layers_of_xpertmill() {
    let text = "% //Start\r\nG71 //mm\r\nG0 X0 Y0 Z1\r\nG1 Z-1 F500 S30000\r\nM06 05\r\nS20000\r\nG1 X8 F1200\r\nM3\r\nG5 X1\r\nM30\r\n";
    let inch = text.replace("G71", "G70");
    let place = Place::new().file("a.nc", text).file("b.nc", inch);
    assert_snapshot!(runs(
        &place,
        ["import a.nc", "import b.nc --unit-codes table --ignore-feed --format concise"]
    ));
}

#[test]
fn verify_reports_with_the_severities_of_the_configuration() {
    let unsafe_program = "G17 G21 G90 G94\nG0 X0 Y0\nG0 Z5\nG1 Z1\nG1 X10 F100\nM30\n";
    let place = Place::new().file("a.gcode", unsafe_program).file(
        "pathbuild.toml",
        "[severity]\nPB742 = \"ignore\"\nPB743 = \"error\"\nmissing-feed = \"warning\"\n[machine]\nx = [0, 5]\nmax-feed = 90\n",
    );
    assert_snapshot!(runs(
        &place,
        [
            "verify a.gcode --cutter 2 --surface 5",
            "verify a.gcode --format json --surface 5,0 --cutter 2",
            "verify a.gcode --lang de --format concise",
            "verify a.gcode --cutter 0",
        ]
    ));
}

#[test]
fn tools_are_those_of_the_table_where_there_is_one() {
    let place = Place::of(LIBRARY).file("foreign.nc", FOREIGN);
    let verified = place.run("verify foreign.nc --format concise --surface 0 --cutter 2 --dialect linuxcnc");
    assert!(
        verified.stderr.contains("foreign.nc:12:1: warning[PB764] T2 is not in the tool table"),
        "{verified}"
    );
    assert!(!verified.stderr.contains("T1"), "{verified}");
    let elsewhere = Place::new().file("foreign.nc", FOREIGN);
    assert!(!elsewhere.run("verify foreign.nc --format concise").stderr.contains("PB764"));
}

#[test]
fn every_format_of_diagnostics_is_there_for_programs() {
    let place = Place::new().file("a.gcode", "G17 G21 G90 G94\nG0 X1 X2\nM30\n");
    for format in ["full", "concise", "json", "sarif", "github", "gitlab", "junit"] {
        let run = place.run(&format!("verify a.gcode --dialect native --format {format}"));
        assert!(run.stderr.contains("PB723"), "{run}");
        assert_eq!((run.status, run.stdout.as_str()), (Some(1), ""), "{format}");
    }
}

#[test]
fn what_was_emitted_is_what_the_drawing_says() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P 1300.1P").status, Some(0));
    let program = place.read("parts/1234_Milling.gcode");
    let place = place
        .file("moved.gcode", program.replace("X40.000", "X40.002"))
        .file("rounded.gcode", program.replace("X40.000", "X40.001"))
        .file("faster.gcode", program.replace("F150.000", "F151.000"))
        .file("cut off.gcode", program.split_once("G01 F").map_or("", |(head, _)| head));
    assert_snapshot!(runs(
        &place,
        [
            "verify parts/1234_Milling.gcode --against 1234.1P",
            "verify rounded.gcode --against parts/1234.dxf",
            "verify moved.gcode --against 1234.1P",
            "verify faster.gcode --against 1234.1P --format concise",
            "verify parts/1300_Clean.gcode --against 1234.1P --format concise",
            "verify parts/1234_Milling.gcode --against 1400.1P --format concise",
            "verify parts/1300_Clean.gcode --against 1300.1P",
            "verify parts/1234_Milling.gcode --against 9999.1P --format concise",
            "verify parts/1234_Milling.gcode --against parts/ --format concise",
        ]
    ));
    let cut_off = place.run_with(&["verify", "cut off.gcode", "--against", "1234.1P", "--format", "concise"]);
    assert_snapshot!(cut_off);
}

#[test]
fn a_program_that_follows_a_tilted_plate_mills_nothing_by_rapid() {
    let tilted = "== parts/1700.dxf ==\nlayer 1700.1P\nstart 0,0 \"T5 O2 I1 B4 MPlate\"\nmill 0,0 40,0\nsweep 40,0 40,50\nmill 40,50 0,50\nprobe 20,15 \"LA\"\nprobe 20,35 \"LB\"\nend 0,50\n";
    let place = Place::of(&format!("{LIBRARY}{tilted}"));
    assert_eq!(place.run("emit 1700.1P").status, Some(0));
    let values = place.read("parts/1700_Z.txt").replace("#51=", "#51=5.4").replace("#52=", "#52=4.6");
    let place = place.file("parts/1700_Z.txt", values);
    assert_eq!(place.run("adjust parts/1700.dxf --max-correction 1").status, Some(0));
    for against in ["", "--against 1700.1P"] {
        let run = place.run(&format!("verify parts/1700_Milling.gcode --cutter 2 {against}"));
        assert_eq!((run.status, run.stderr.as_str()), (Some(0), "errors: 0, warnings: 0\n"), "{run}");
    }
}

#[test]
fn what_a_post_wrote_is_what_the_drawing_says() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    for (post, dialect) in [("linuxcnc", "linuxcnc"), ("grbl", "grbl"), ("xpertmill", "xpertmill")] {
        let rewritten = place.run(&format!("post parts/1234_Milling.gcode --post {post} -o {post}.nc"));
        assert_eq!(rewritten.status, Some(0), "{rewritten}");
        let verified = place.run(&format!("verify {post}.nc --dialect {dialect} --against 1234.1P"));
        assert_eq!(verified.status, Some(0), "{verified}");
        let moved = place.read(&format!("{post}.nc")).replace("X40", "X39");
        let place = Place::of(LIBRARY).file("moved.nc", moved);
        let verified = place.run(&format!("verify moved.nc --dialect {dialect} --against 1234.1P"));
        assert_eq!(verified.status, Some(1), "{verified}");
        assert!(verified.stderr.contains("PB739"), "{verified}");
    }
}

#[test]
fn a_program_is_written_for_another_machine() {
    let place = Place::of(LIBRARY).file("foreign.nc", FOREIGN).file(
        "mine.cbpp",
        "<PostProcessor><FileExtension>tap</FileExtension><EndOfLine>\\n</EndOfLine></PostProcessor>",
    );
    assert_snapshot!(runs(
        &place,
        [
            "post foreign.nc --post linuxcnc",
            "post foreign.nc --post grbl -o foreign.gcode",
            "post foreign.nc --post grbl -o foreign.gcode",
            "post foreign.nc --post mine.cbpp --date 2026-11-21",
            "post foreign.nc --post mine.cbpp --target grbl",
            "post foreign.nc --post mine.cbpp --target grblx --format concise",
            "post foreign.nc --post native",
            "post foreign.nc --post linuxcn --format concise",
            "post foreign.nc --post missing.cbpp --format concise",
            "post foreign.nc",
        ]
    ));
}

#[test]
fn a_program_with_errors_is_not_rewritten() {
    let place = Place::of(LIBRARY).file("bad.nc", FOREIGN.replace("G1 X20 F300", "G1 X20 X30 F300"));
    assert_snapshot!(place.run("post bad.nc --post grbl -o out.gcode"));
    assert!(!place.path().join("out.gcode").exists());
}

#[test]
fn heights_that_are_still_to_be_corrected_are_not_rewritten() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1300.1P").status, Some(0));
    assert_snapshot!(place.run("post parts/1300_Clean.gcode --post grbl -o out.gcode"));
    let values = place.read("parts/1300_Z.txt").replace("#51=", "#51=5.1");
    let adjusted = place.file("parts/1300_Z.txt", values);
    assert_eq!(adjusted.run("adjust parts/1300.dxf --max-correction 1").status, Some(0));
    let rewritten = adjusted.run("post parts/1300_Milling.gcode --post grbl");
    assert_eq!(rewritten.status, Some(0), "{rewritten}");
    assert!(rewritten.stdout.contains("Z4.1"), "4 above a plate that is 0.1 thicker: {rewritten}");
}

#[test]
fn built_in_posts_are_listed_and_shown() {
    let place = Place::new();
    assert_snapshot!(runs(&place, ["post list", "post show native", "post show gbrl --format concise"]));
    let shown = place.run("post show grbl").stdout;
    let program = "G17 G21 G90 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F60\nG0 Z5\nM30\n";
    let place = place.file("copy.cbpp", shown).file("a.gcode", program);
    let [own, copy] = ["grbl", "copy.cbpp"].map(|post| place.run(&format!("post a.gcode --post {post}")));
    assert_eq!((own.status, own.stdout), (Some(0), copy.stdout));
}
