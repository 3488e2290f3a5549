//! Tests chip loads outside the limits of `[tool]` (PB790) and cuts deeper than its cutting edges (PB792), in drawings and programs, and the shape of
//! a tool in `verify`.

use crate::support::{Place, Run};
use pathbuild_testkit::sheet;

const TOOL: &str = "[tool.mill]\ndiameter = 2\nnumber = 4\nspindle = 10000\nflutes = 2\n";

/// Returns the output of `check` for a path with F on its start and on a line. The limits of 0.01 to 0.03 mm per tooth permit F200 to F600.
fn check(start: &str, line: &str, options: &str) -> String {
    let drawing =
        format!("layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 MX {start}\"\nmill 0,0 40,0{line}\nend 40,0\n");
    let place = Place::new()
        .file("pathbuild.toml", format!("rapid = 1000\nsweep-height = 8\n{TOOL}chip-load = [0.01, 0.03]\n"))
        .file("1234.1P.dxf", sheet(&drawing).unwrap().to_dxf());
    let run = place.run(&format!("{options} 1234.1P.dxf --format concise"));
    assert_eq!(run.status, Some(0), "{run}");
    run.stdout.lines().chain(run.stderr.lines()).filter(|line| line.contains("PB790")).collect()
}

#[test]
fn f_of_a_drawing_is_compared_with_the_limits_of_the_tool() {
    assert_eq!([check("F200", "", "check"), check("F600", "", "check")], ["", ""]);
    assert!(check("F199", "", "check").contains("is below 0.01: feed 199 mm/min, 10000 1/min, flutes: 2"));
    assert!(check("F601", "", "check").contains("is above 0.03: feed 601 mm/min, 10000 1/min, flutes: 2"));
    assert!(check("F300", " \"F700\"", "check").contains("0.035 mm per tooth is above 0.03"));
    assert!(check("", "", "emit --feed 700").contains("0.035 mm per tooth is above 0.03"));
    assert_eq!(check("", "", "emit --feed 600"), "");
}

/// Verifies a program, with findings in concise form.
fn verify(configuration: &str, program: &str, options: &str) -> Run {
    let place = Place::new().file("pathbuild.toml", configuration).file("a.nc", program);
    place.run(&format!("verify a.nc --dialect linuxcnc --format concise {options}"))
}

/// Returns the lines with a chip load outside the limits.
fn loads(feed: &str, speed: &str, limits: &str) -> Vec<String> {
    let program = format!(
        "G17 G21 G90 G94\nT4 M6\nM3 {speed}\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F20\nG1 X10 {feed}\nG1 X20\nG0 Z5\nM5\nM30\n"
    );
    let run = verify(&format!("{TOOL}{limits}"), &program, "");
    run.stderr
        .lines()
        .chain(run.stdout.lines())
        .filter(|line| line.contains("PB790"))
        .map(str::to_owned)
        .collect()
}

#[test]
fn feeds_of_a_program_are_compared_by_its_own_speed() {
    const LIMITS: &str = "chip-load = [0.01, 0.03]\n";
    assert_eq!(loads("F1200", "S20000", LIMITS), [""; 0]);
    let found = loads("F1201", "S20000", LIMITS);
    assert!(found.len() == 1 && found[0].starts_with("a.nc:7:"), "{found:?}");
    assert_eq!(loads("F400", "S20000", LIMITS), [""; 0]);
    assert_eq!(loads("F399", "S20000", LIMITS).len(), 1);
    assert_eq!(loads("F9999", "S20000", ""), [""; 0]);
}

#[test]
fn each_feed_of_a_program_is_compared() {
    let configuration = format!("{TOOL}chip-load = [0.01, 0.03]\n");
    let lines = |cuts: &str| {
        let program = format!(
            "G17 G21 G90 G94\nT4 M6\nM3 S10000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F20\n{cuts}\nG0 Z5\nM5\nM30\n"
        );
        let run = verify(&configuration, &program, "");
        let found = run.stderr.lines().filter(|line| line.contains("PB790"));
        found.filter_map(|line| line.split(':').nth(1)?.parse().ok()).collect::<Vec<u32>>()
    };
    assert_eq!(lines("G1 X10 F700\nG1 X20\nG1 X30 F800\nG1 X40 F600"), [7, 9]);
    assert_eq!(lines("G1 X10 F700\nG1 X20 F600\nG1 X30 F700"), [7], "the same feed again");
    assert_eq!(lines("G1 X10 F600\nS9000\nG1 X20"), [9], "the same feed at another speed");
}

/// A native program always selects T1, so its tool is determined by its path and its O.
#[test]
fn feeds_of_a_native_program_are_compared() {
    let drawing = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 MX F600\"\nmill 0,0 40,0\nend 40,0\n";
    let other = "[tool.other]\ndiameter = 6\nnumber = 1\nspindle = 10000\nflutes = 2\nchip-load = [1, 2]\n";
    let place = Place::new()
        .file(
            "pathbuild.toml",
            format!("rapid = 1000\nsweep-height = 8\n{other}{TOOL}chip-load = [0.01, 0.03]\n"),
        )
        .file("1234.1P.dxf", sheet(drawing).unwrap().to_dxf());
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let program = place.read("1234.1P_Milling.gcode");
    assert!(!place.run("verify 1234.1P_Milling.gcode").stderr.contains("PB790"));
    let faster = Place::new()
        .file("pathbuild.toml", place.read("pathbuild.toml"))
        .file("a.gcode", program.replace("F600.000 X", "F601.000 X"));
    let run = faster.run("verify a.gcode --format concise");
    assert!(run.stderr.contains("0.0301 mm per tooth is above 0.03: feed 601 mm/min"), "{run}");
}

/// Returns the findings of `check` about cuts deeper than the tool's edges of 5.2 mm, in a plate of 5 mm.
fn too_deep(start: &str, elements: &str, tool: &str) -> Vec<String> {
    let drawing = format!("layer 1234.1P\nstart 0,0 \"T5 O2 I1 F150 MX {start}\"\n{elements}\nend 40,0\n");
    let configuration = format!("rapid = 1000\nsweep-height = 8\n{TOOL}length = 5.2\n{tool}");
    let place = Place::new()
        .file("pathbuild.toml", configuration)
        .file("1234.1P.dxf", sheet(&drawing).unwrap().to_dxf());
    let run = place.run("check 1234.1P.dxf --format concise");
    run.stderr
        .lines()
        .chain(run.stdout.lines())
        .filter(|line| line.contains("PB792"))
        .map(str::to_owned)
        .collect()
}

#[test]
fn cuts_of_a_drawing_are_no_deeper_than_the_edges_of_the_tool() {
    const LINES: &str = "mill 0,0 20,0\nmill 20,0 40,0";
    assert_eq!(too_deep("B-0.2", LINES, ""), [""; 0], "as deep as the edges are long");
    let found = too_deep("B-0.21", LINES, "");
    assert!(found.len() == 1 && found[0].contains("5.21 mm deep"), "once for the path: {found:?}");
    assert!(found[0].contains("only 5.2 mm long"), "{found:?}");
    let own = too_deep("B0", "mill 0,0 20,0\nmill 20,0 40,0 \"B-0.3\"", "");
    assert!(own.len() == 1 && own[0].contains("Z-0.3 is 5.3 mm deep"), "{own:?}");
    assert_eq!(too_deep("B-0.3 D4", "mark 0,0 40,0", ""), [""; 0], "marks go down to D");
    assert_eq!(too_deep("B-0.3", LINES, "shape = \"slot\"\n"), [""; 0]);
}

#[test]
fn cuts_of_a_program_are_no_deeper_than_the_edges_of_the_tool() {
    let found = |z: &str, options: &str| {
        let program = format!(
            "G17 G21 G90 G94\nT4 M6\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F20\nG1 X20\nG1 Z{z}\nG1 X0\nG0 Z5\nM5\nM30\n"
        );
        let run = verify(&format!("{TOOL}length = 4\n"), &program, options);
        let found = run.stderr.lines().filter(|line| line.contains("PB792"));
        found.map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(found("-4.005", "--surface 0"), [""; 0], "within rounding");
    let deep = found("-4.01", "--surface 0");
    assert!(deep.len() == 1 && deep[0].starts_with("a.nc:8:"), "{deep:?}");
    assert_eq!(found("-4.01", "--surface -0.1"), [""; 0]);
    assert_eq!(found("-4.01", ""), [""; 0], "the surface is unknown");
}

/// Whether `verify` reports a rapid move back along a cut, at its depth and `offset` mm beside its centre line.
fn rapid_beside_a_cut(tool: &str, offset: f64) -> bool {
    let program = format!(
        "G17 G21 G90 G94\nT4 M6\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X40\nG1 Y{offset}\nG0 X10\nG0 Z5\nM5\nM30\n"
    );
    let run = verify(tool, &program, "--surface 0");
    run.stderr.contains("PB740") || run.stdout.contains("PB740") || run.status == Some(1)
}

#[test]
fn a_rounded_corner_clears_less() {
    let tool = |more: &str| format!("[tool.mill]\ndiameter = 6\nnumber = 4\n{more}");
    assert!(!rapid_beside_a_cut(&tool(""), 0.0));
    assert!(rapid_beside_a_cut(&tool(""), 3.0));
    assert!(!rapid_beside_a_cut(&tool("corner-radius = 2\n"), 0.0));
    assert!(rapid_beside_a_cut(&tool("corner-radius = 2\n"), 1.5));
    assert!(!rapid_beside_a_cut(&tool("shape = \"other\"\n"), 0.0));
}

/// Whether `verify` reports a rapid move from the middle of a cut to a parallel one, at their depth.
fn rapid_between_cuts(tool: &str, distance: f64) -> bool {
    let program = format!(
        "G17 G21 G90 G94\nT4 M6\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X40\nG0 Z5\nG0 Y{distance}\n\
         G1 Z-1\nG1 X10\nG0 X20\nG0 Y0\nG0 Z5\nM5\nM30\n"
    );
    verify(tool, &program, "--surface 0").stderr.contains("PB740")
}

/// Between cuts that are farther apart than the flat part of the tip, a ridge remains.
#[test]
fn a_round_tip_leaves_a_ridge_between_cuts() {
    let tool = |radius: u32| format!("[tool.mill]\ndiameter = 6\nnumber = 4\ncorner-radius = {radius}\n");
    assert!(rapid_between_cuts(&tool(2), 4.0));
    assert!(!rapid_between_cuts(&tool(2), 2.0));
    assert!(!rapid_between_cuts(&tool(0), 4.0));
    // `tool(3)` is a ball-nose cutter.
    assert!(rapid_between_cuts(&tool(3), 2.0));
    assert!(!rapid_between_cuts(&tool(3), 0.5));
}

#[test]
fn a_corner_is_not_rounder_than_the_tool() {
    let found = |diameter: &str, radius: &str| {
        let tool = format!("[tool.mill]\ndiameter = {diameter}\ncorner-radius = {radius}\n");
        Place::new().file("pathbuild.toml", tool).run("config show --format concise")
    };
    for (diameter, radius) in [("6", "3"), ("3.175", "1.5875"), ("6.35", "3.175001")] {
        assert_eq!(found(diameter, radius).status, Some(0), "{radius}");
    }
    assert!(found("6", "0.5").stdout.contains("corner-radius = 0.5"));
    assert!(!found("6", "0").stdout.contains("corner-radius"));
    let run = found("6", "3.00001");
    let shown = format!("{}{}", run.stdout, run.stderr);
    assert!(run.status == Some(2) && shown.contains("pathbuild.toml:3:"), "{run}");
    assert!(shown.contains("at most half of `diameter`"), "{run}");
}
