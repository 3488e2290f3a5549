//! Tests what `verify` reads from the comments of programs that other CAM programs wrote. (book: program/reading)
//!
//! All programs here follow the format of the CAM program that is named, but are not copied from it.

use crate::support::{Place, Run, runs};
use insta::assert_snapshot;

/// Returns a program with two slots of 20 mm, and the given moves between them.
fn slots(head: &str, between: &str) -> String {
    format!(
        "{head}S12000 M3\nG54\nG0 Z15\nG0 X0 Y0\nG0 Z5\nG1 Z-2 F200\nG1 X20 F600\n{between}\nG1 Z-2 F200\nG1 X0 F600\nG0 Z5\nM5\nM30\n"
    )
}

const OVER: &str = "G0 Z5\nG0 Y20\nG0 Z1";
const THROUGH: &str = "G0 Y20";

fn fusion(kind: &str) -> String {
    format!("(bracket)\n(T1 D=6 CR=0 - ZMIN=-2 - {kind})\nG90 G94 G17\nG21\nG53 G0 Z0\nT1 M6\n")
}

const CARBIDE_CREATE: &str = "(stockMin:0.00mm, 0.00mm, -6.00mm)\n(stockMax:100.00mm, 100.00mm, 0.00mm)\n(STOCK/BLOCK,100.00, 100.00, 6.00,0.00, 0.00, 6.00)\nG90\nG21\nG53G0Z-5.000\n(TOOL/MILL,3.17, 0.00, 12.70, 0.00)\nM6T102\n";

const FREECAD: &str = "(Exported by FreeCAD)\n(Post Processor: grbl_post)\nG17 G90\nG21\n(TC: 6mm Endmill)\n( M6 T3.0 )\n(Compensated Tool Path. Diameter: 6.0)\n";

/// Returns the codes of the findings that `verify` reports for a program with this text, in line order.
fn codes(text: &str, options: &str) -> Vec<String> {
    let place = Place::new().file("a.nc", text);
    codes_of(&place.run(&format!("verify a.nc --dialect linuxcnc --format concise {options}")))
}

fn codes_of(run: &Run) -> Vec<String> {
    let code = |line: &str| {
        line.split(|c: char| !c.is_ascii_alphanumeric()).find(|word| is_code(word)).map(String::from)
    };
    run.stdout.lines().chain(run.stderr.lines()).filter_map(code).collect()
}

fn is_code(word: &str) -> bool {
    word.strip_prefix("PB")
        .is_some_and(|digits| digits.len() == 3 && digits.bytes().all(|byte| byte.is_ascii_digit()))
}

#[test]
fn the_cutter_of_the_header_is_that_of_the_check() {
    let heads = [
        fusion("flat end mill"),
        fusion("ball end mill"),
        "(1 = End Mill {6 mm})\nG21\nG90\nT1 M6\n".into(),
        "(Made using CamBam - http://www.cambam.co.uk)\nG21 G90\n( T1 : 6.0 )\nT1 M6\n".into(),
        "; tool#=1 flute=6 len=20 unit=metric\nG21\nG90\nM6 T1\n".into(),
        "G21 G90\nT1\n(MSG, Change tool bit to cutter diameter 6.00000mm)\nM6\n".into(),
        FREECAD.into(),
    ];
    for head in heads {
        assert_eq!(codes(&slots(&head, OVER), "--surface 0"), [""; 0], "{head}");
        assert!(codes(&slots(&head, THROUGH), "--surface 0").contains(&"PB740".into()), "{head}");
    }
}

#[test]
fn without_a_surface_a_rapid_move_at_cutting_depth_is_doubtful() {
    for head in [fusion("flat end mill"), fusion("ball end mill"), FREECAD.into(), CARBIDE_CREATE.into()] {
        assert_eq!(codes(&slots(&head, OVER), ""), [""; 0], "{head}");
        let expected = if head == CARBIDE_CREATE { "PB740" } else { "PB781" };
        assert_eq!(codes(&slots(&head, THROUGH), ""), [expected], "{head}");
    }
    // A comment that claims a surface below the cuts does not hide the error.
    let low = CARBIDE_CREATE
        .replace("0.00, 6.00)", "0.00, 16.00)")
        .replace("-6.00mm", "-16.00mm")
        .replace("100.00mm, 0.00mm", "100.00mm, -10.00mm");
    assert_eq!(codes(&slots(&low, THROUGH), ""), ["PB781"]);
}

#[test]
fn an_error_on_another_line_hides_no_doubtful_move() {
    let program = slots("G90 G21\nT1 M6\n", "G0 Y35");
    let stopped = program.replace("G0 Z5\nM5\n", "G0 Z5\nM5\nG1 Z-2\nG0 Z5\n");
    assert_eq!(codes(&stopped, ""), ["PB781", "PB745"]);
}

/// If no cutter is known, one of 50 mm may have cleared the material between two slots.
#[test]
fn without_a_cutter_only_what_no_cutter_can_have_cleared_is_doubtful() {
    let head = "G90 G21\nT1 M6\n";
    assert_eq!(codes(&slots(head, "G0 Y25"), ""), [""; 0]);
    assert_eq!(codes(&slots(head, "G0 Y35"), ""), ["PB781"]);
    assert_eq!(codes(&slots(head, "G0 Z5\nG0 Y35\nG0 Z1"), ""), [""; 0]);
    assert_eq!(codes(&slots(head, "G0 Y25"), "--cutter 6"), ["PB781"]);
    assert_eq!(codes(&slots(head, "G0 Y35"), "--cutter 70"), [""; 0]);
}

/// The surface is the higher of those in the header and in `--surface`.
#[test]
fn a_surface_that_the_program_contradicts_is_told() {
    let plunge = |z: &str| format!("G0 Z5\nG0 Y20\nG0 Z{z}");
    assert_eq!(codes(&slots(CARBIDE_CREATE, &plunge("0")), "--surface 0"), [""; 0]);
    assert_eq!(codes(&slots(CARBIDE_CREATE, &plunge("0")), "--surface -0.5"), ["PB777"]);
    assert_eq!(codes(&slots(CARBIDE_CREATE, &plunge("-0.1")), "--surface -0.5"), ["PB777", "PB741"]);
    assert_eq!(codes(&slots(CARBIDE_CREATE, &plunge("0.4")), "--surface 0.5"), ["PB777", "PB741"]);
    assert_eq!(codes(&slots(CARBIDE_CREATE, &plunge("0.5")), "--surface 0.5"), ["PB777"]);
}

/// The header of this native program names no T, because it mills a path with T2 and one with T4. The greater T is used.
#[test]
fn a_surface_below_the_plunges_of_a_native_program_is_told() {
    let slot = |t: &str, y: &str| {
        format!("G00 Z{t}\nG01 F150.000 Z1.000\nG01 F150.000 X40.000 Y{y} Z1.000\nG00 Z20.000\n")
    };
    let head = "%\n(pathbuild 0.1.0 0123456789abcdef-01234567 native O2)\n(Path 1234.1P, drawing 1234.1P.dxf)\nG17 G21 G40 G49 G54 G80 G90 G94\nT1\nG00 Z20.000\n";
    let low = slot("2.000", "0.000");
    let high = slot("4.000", "9.000");
    let text = format!(
        "{head}G00 X0.000 Y0.000\n{low}(START Subpath 1234.2P)\nG00 X0.000 Y9.000\n{high}(END Subpath 1234.2P)\nM30\n%\n"
    );
    let place = Place::new().file("a_Milling.gcode", text);
    let told = |surface: &str| {
        let run = place.run(&format!("verify . --surface {surface} --format concise"));
        codes_of(&run).contains(&"PB777".into())
    };
    assert!(told("0") && told("2") && !told("4") && told("5"));
}

#[test]
fn a_stock_block_gives_the_surface() {
    assert_eq!(codes(&slots(CARBIDE_CREATE, OVER), ""), [""; 0]);
    assert_eq!(codes(&slots(CARBIDE_CREATE, THROUGH), ""), ["PB740"]);
    // The rapid move goes down into the stock, which begins at Z 0.
    assert_eq!(codes(&slots(CARBIDE_CREATE, "G0 Z5\nG0 Y20\nG0 Z0"), ""), [""; 0]);
    assert_eq!(codes(&slots(CARBIDE_CREATE, "G0 Z5\nG0 Y20\nG0 Z-0.1"), ""), ["PB741"]);
}

/// If a program is too large for the map, its rapid moves at cutting depth cannot be checked, which is reported. If there is no such move,
/// nothing needs to be checked.
#[test]
fn what_is_too_large_to_doubt_is_told() {
    let head = fusion("flat end mill");
    for (between, expected) in [(THROUGH, "too large"), (OVER, "only rapid moves at")] {
        let place = Place::new().file("pathbuild.toml", "[limits]\nverify-cells = 100\n");
        let place = place.file("a.nc", slots(&head, between));
        let run = place.run("verify a.nc --dialect linuxcnc --format concise");
        assert!(run.status == Some(0) && run.stderr.contains(expected), "{run}");
        assert_eq!(codes_of(&run).contains(&"PB005".into()), expected == "too large", "{run}");
    }
}

/// Carbide Create states the width of the point as the diameter of a V-bit.
#[test]
fn a_tiny_point_exceeds_no_limit() {
    let engraved = |diameter: &str, angle: &str| {
        let tool = format!("(TOOL/MILL,{diameter}, 0.00, 10.00, {angle})");
        let head = CARBIDE_CREATE.replace("(TOOL/MILL,3.17, 0.00, 12.70, 0.00)", &tool);
        slots(&head, "G0 Z5\nG0 Y20\nG0 Z1\nG1 Z-2\nG1 X-900\nG1 Y900\nG1 X0 Y0\nG0 Z5\nG0 Z1")
    };
    assert_eq!(codes(&engraved("0.03", "45.00"), ""), [""; 0]);
    // The point is too small for the map, so the check is not made, which is an error only if it is required.
    let place = Place::new().file("a.nc", engraved("0.03", "0.00"));
    let run = place.run("verify a.nc --dialect linuxcnc --format concise");
    assert!(run.status == Some(0) && codes_of(&run) == ["PB005"], "{run}");
    let run = place.run("verify a.nc --dialect linuxcnc --format concise --require rapids=assumed");
    assert!(run.status == Some(1), "{run}");
    let run = place.run("verify a.nc --dialect linuxcnc --format concise --cutter 0.03 --surface 0");
    assert!(run.status == Some(0) && codes_of(&run) == ["PB005"], "{run}");
}

#[test]
fn a_drill_fits_into_its_own_hole() {
    let drill = "(T1 D=5 CR=0 TAPER=118deg - ZMIN=-6 - drill)\nG90\nG21\nT1 M6\nS9000 M3\nG54\nG0 Z15\nG0 X0 Y0\nG0 Z5\nG1 Z-2 F90\nG0 Z2\nG0 Z-1.5\nG1 Z-6\nG0 Z5\n";
    assert_eq!(codes(&format!("{drill}M5\nM30\n"), "--surface 0"), [""; 0]);
    assert_eq!(codes(&format!("{drill}G0 X2\nG0 Z-1\nG0 Z5\nM5\nM30\n"), "--surface 0"), ["PB741"]);
}

#[test]
fn where_sources_disagree_the_smaller_removes_and_the_larger_collides() {
    // The program mills a second slot beside the first one, then makes a rapid move back into the first one.
    let beside = |y: &str| {
        let moves = format!("G0 Z5\nG0 Y{y}\nG0 Z-2\nG0 X0\nG0 Z5\nG0 Y0\nG0 X20\nG0 Z0");
        slots(&fusion("flat end mill"), &moves)
    };
    // The diameter in the header and that of `--cutter` may differ by a rounding error.
    assert_eq!(codes(&beside("0"), "--surface 0 --cutter 6"), [""; 0]);
    assert_eq!(codes(&beside("0"), "--surface 0 --cutter 6.01"), [""; 0]);
    assert_eq!(codes(&beside("0"), "--surface 0 --cutter 6.02"), ["PB777"]);
    for cutter in [3, 9] {
        let found = codes(&beside("0"), &format!("--surface 0 --cutter {cutter}"));
        assert!(found.contains(&"PB741".into()) && found.contains(&"PB777".into()), "{cutter}: {found:?}");
    }
}

#[test]
fn disagreements_are_told() {
    let place = Place::new()
        .file("pathbuild.toml", "[tool.8mm]\nnumber = 1\ndiameter = 8\n")
        .file("a.nc", slots(&fusion("flat end mill"), OVER))
        .file(
            "b.nc",
            slots(
                &fusion("flat end mill").replace("(bracket)", "(T1 D=3 CR=0 - ZMIN=-5 - flat end mill)"),
                OVER,
            ),
        );
    assert_snapshot!(runs(
        &place,
        [
            "verify a.nc --dialect linuxcnc --surface 0",
            "verify a.nc --dialect linuxcnc --surface 0 --cutter 6 --lang de",
            "verify b.nc --dialect linuxcnc --surface 0 --lang de",
        ]
    ));
}

#[test]
fn a_required_check_that_was_not_made_is_an_error() {
    let plain = slots("G90 G21\nT1 M6\n", OVER);
    let carbide_create = slots(CARBIDE_CREATE, OVER);
    let required = |text: &str, options: &str| codes(text, &format!("--require {options}"));
    assert_eq!(required(&plain, "rapids"), ["PB523"]);
    assert_eq!(required(&plain, "rapids --cutter 6"), ["PB523"]);
    assert_eq!(required(&plain, "rapids --cutter 6 --surface 0"), [""; 0]);
    // Values from comments do not suffice, unless the option permits them.
    assert_eq!(required(&carbide_create, "rapids"), ["PB523"]);
    assert_eq!(required(&carbide_create, "rapids=assumed"), [""; 0]);
    assert_eq!(required(&plain, "rapids=assumed"), ["PB523"]);
    assert_eq!(required(&plain, "envelope,feeds,spindle,drawing,clamps").len(), 5);
}

#[test]
fn speeds_are_checked_only_if_the_spindle_starts() {
    let codes = |text: &str| {
        let place = Place::new().file("a.nc", text);
        let place = place.file("pathbuild.toml", "[machine]\nspindle-speeds = [5000, 24000]\n");
        codes_of(&place.run("verify a.nc --dialect linuxcnc --format concise --require spindle"))
    };
    let program =
        |spindle: &str| format!("G17 G21 G90 G94\n{spindle}\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG0 Z5\nM30\n");
    assert_eq!(codes(&program("S12000 M3")), [""; 0]);
    assert_eq!(codes(&program("")), ["PB523"]);
    assert_eq!(codes(&program("S12000")), ["PB523", "PB745"]);
    // The first cut has the speed that the control has kept.
    let late = program("M3").replace("G0 Z5\nM30", "S12000\nG1 X9\nG0 Z5\nM5\nM30");
    assert_eq!(codes(&late), ["PB523", "PB745"]);
    assert_eq!(codes(&late.replace("M3\n", "M3 S9000\n")), [""; 0]);
    assert_eq!(codes("G17 G21 G90 G94\nG0 Z5\nG0 X0 Y0\nG38.2 Z-1 F100\nG0 Z5\nM30\n"), [""; 0], "no cut");
}

#[test]
fn rounding_of_corners_is_checked_where_the_program_can_limit_it() {
    let codes = |dialect: &str, corners: &str, configuration: &str| {
        let text = format!("G17 G21 G90 G94\n{corners}\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG0 Z5\nM30\n");
        let place = Place::new().file("a.nc", text).file("pathbuild.toml", configuration);
        codes_of(&place.run(&format!("verify a.nc --dialect {dialect} --format concise --require corners")))
    };
    assert_eq!(codes("linuxcnc", "G64 P0.02", ""), [""; 0]);
    assert_eq!(codes("linuxcnc", "G64 P0.03", ""), ["PB787"]);
    assert_eq!(codes("linuxcnc", "G64 P0.03", "part-tolerance = 0.03\n"), [""; 0]);
    assert_eq!(codes("linuxcnc", "G64", ""), ["PB523"]);
    assert_eq!(codes("linuxcnc", "", ""), ["PB523"]);
    assert_eq!(codes("mach3", "G64", ""), [""; 0], "no limit can be written");
}

#[test]
fn the_configuration_may_require_checks() {
    let limits = "[machine]\ntravel = [300, 200, 60]\nmaximum-feed = 2000\n";
    let place = |configuration: &str| {
        let place = Place::new().file("a.nc", slots("G90 G21\nT1 M6\n", OVER));
        place.file("pathbuild.toml", configuration)
    };
    let codes = |configuration: &str, options: &str| {
        codes_of(
            &place(configuration).run(&format!("verify a.nc --dialect linuxcnc --format concise {options}")),
        )
    };
    let required = "[verify]\nrequire = [\"envelope\", \"feeds\"]\n";
    assert_eq!(codes(required, ""), ["PB523", "PB523"]);
    assert_eq!(codes(&format!("{limits}{required}"), ""), [""; 0]);
    // The command line adds to the list of the configuration.
    assert_eq!(codes(&format!("{limits}{required}"), "--require spindle"), ["PB523"]);
    assert_eq!(codes(required, "--require spindle"), ["PB523", "PB523", "PB523"]);
    assert_eq!(codes(required, "--require envelope"), ["PB523", "PB523"]);
    // Values from comments do not suffice if either source requires better ones.
    let cam = |configuration: &str, options: &str| {
        let place = Place::new().file("a.nc", slots(CARBIDE_CREATE, OVER));
        let place = place.file("pathbuild.toml", format!("[verify]\nrequire = [{configuration}]\n"));
        codes_of(&place.run(&format!("verify a.nc --dialect linuxcnc --format concise {options}")))
    };
    assert_eq!(cam("\"rapids\"", "--require rapids=assumed"), ["PB523"]);
    assert_eq!(cam("\"rapids=assumed\"", "--require rapids"), ["PB523"]);
    assert_eq!(cam("\"rapids=assumed\"", "--require rapids=assumed"), [""; 0]);
    assert_eq!(cam("\"rapids\", \"rapids=assumed\"", ""), [""; 0]);
    assert_eq!(codes("[verify]\nrequire = [\"rapid\"]\n", ""), ["PB003"]);
}

/// Only the machine knows where G55 lies, and whether the moves in G54 and in G55 fit into its travel together.
#[test]
fn the_travel_of_several_work_offsets_is_not_checked() {
    let program =
        |more: &str| format!("G21 G90 G17 G54\nM3 S9000\nG0 Z5\nG0 X0 Y0\n{more}\nG0 Z5\nM5\nM30\n");
    let place = Place::new()
        .file("pathbuild.toml", "[machine]\ntravel = [400, 300, 80]\n")
        .file("one.nc", program("G0 X300"))
        .file("two.nc", program("G0 X300\nG55\nG0 X0\nG0 X300"))
        .file(
            "stated.nc",
            program("G0 X300\nG55\nG0 X300")
                .replace("G54\n", "G54\nG10 L2 P1 X0 Y0 Z0\nG10 L2 P2 X90 Y0 Z0\n"),
        );
    let verify = |name: &str| {
        place.run(&format!("verify {name}.nc --dialect linuxcnc --require envelope --format concise"))
    };
    assert_eq!(verify("one").status, Some(0));
    assert_eq!(verify("stated").status, Some(0), "{}", verify("stated"));
    let run = verify("two");
    assert!(run.status == Some(1) && run.stderr.contains("error[PB523]"), "{run}");
    assert!(run.stderr.contains("only the machine knows where the work offsets of the program lie"), "{run}");
}

/// The moves between two positions that the program has not stated are in no box that is compared with the travel.
#[test]
fn the_travel_of_moves_from_an_unknown_position_is_not_checked() {
    let run = |moves: &str| {
        let text = format!("G17 G21 G90 G94\nG0 Z20\n{moves}\nG90\nG0 X0 Y0\nM30\n");
        let place = Place::new().file("a.nc", text);
        let place = place.file("pathbuild.toml", "[machine]\ntravel = [400, 300, 80]\n");
        place.run("verify a.nc --dialect linuxcnc --require envelope --format concise")
    };
    let (lost, long) = (run("G91\nG0 X390"), run("G91\nG0 X5000"));
    assert_eq!(codes_of(&lost), ["PB523"]);
    assert!(lost.stderr.contains("from a position that it has not stated"), "{lost}");
    assert_eq!(codes_of(&long), ["PB523", "PB748"]);
    for lift in ["G91 G0 Z5", "G91 G28 Z0", "G53 G0 Z-1"] {
        assert_eq!(run(lift).status, Some(0), "{lift}: {}", run(lift));
    }
}

#[test]
fn the_last_line_says_what_was_checked() {
    let place = Place::new()
        .file("a.nc", slots(&fusion("flat end mill"), OVER))
        .file("b.nc", slots(&fusion("flat end mill"), OVER))
        .file("c.nc", slots(CARBIDE_CREATE, OVER))
        .file("d.nc", slots("G90 G21\nT1 M6\n", OVER));
    assert_snapshot!(runs(
        &place,
        [
            "verify a.nc b.nc --dialect linuxcnc",
            "verify c.nc d.nc --dialect linuxcnc",
            "verify a.nc --dialect linuxcnc --surface 0 --lang de",
            "verify d.nc --dialect linuxcnc --require rapids,envelope --lang de",
            "verify c.nc --dialect linuxcnc --format json",
        ]
    ));
}
