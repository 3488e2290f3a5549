//! Runs the scripts of examples/gate as CAM programs do: a program with errors is moved away. (book: howto/any-program)

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use pathbuild_testkit::skip;

use crate::support::Place;

const SOUND: &str = "(T1 D=6 CR=0 - ZMIN=-2 - flat end mill)\nG21 G90 G94 G17\nT1 M6\nS12000 M3\nG0 Z15\nG0 X0 Y0\nG1 Z-2 F200\nG1 X40 F600\nG0 Z15\nM5\nM30\n";

fn wrong() -> String {
    SOUND.replace("S12000 M3\n", "")
}

fn example(name: &str) -> PathBuf {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/gate").join(name);
    // The shell of Windows takes a slash for the beginning of an option, so its own separator is used.
    file.components().collect()
}

/// Returns a command that runs in the place and finds pathbuild.
fn command(place: &Place, name: &str) -> Command {
    let program = Path::new(env!("CARGO_BIN_EXE_pathbuild")).parent().unwrap();
    let others = std::env::var_os("PATH").unwrap_or_default();
    let path = [program.to_owned()].into_iter().chain(std::env::split_paths(&others));
    let mut command = Command::new(name);
    command.current_dir(place.path()).env("PATH", std::env::join_paths(path).unwrap());
    command.env("XDG_CACHE_HOME", place.caches()).env("XDG_CONFIG_HOME", place.configurations());
    command.env("LC_ALL", "C").env_remove("PATHBUILD_GATE").env_remove("PATHBUILD_LANG");
    command
}

fn gate(place: &Place, arguments: &[&str], options: &str) -> Output {
    let script = example(if cfg!(windows) { "gate.cmd" } else { "gate.sh" });
    let mut command = if cfg!(windows) {
        let mut command = command(place, "cmd");
        command.arg("/c").arg(script);
        command
    } else {
        let mut command = command(place, "sh");
        command.arg(script);
        command
    };
    command.args(arguments).env("PATHBUILD_GATE", options).output().unwrap()
}

fn has(place: &Place, name: &str) -> bool {
    place.path().join(name).exists()
}

#[test]
fn a_program_passes_or_is_kept_out_of_the_way() {
    let place = Place::new().file("a sound (1).nc", SOUND).file("a wrong & (2).nc", wrong());
    let run = gate(&place, &["a sound (1).nc", "a wrong & (2).nc"], "");
    assert_eq!(run.status.code(), Some(1), "{run:?}");
    assert_eq!(place.read("a sound (1).nc"), SOUND);
    assert!(!has(&place, "a sound (1).nc.rejected") && !has(&place, "a sound (1).nc.rejected.txt"));
    assert!(!has(&place, "a wrong & (2).nc"));
    assert_eq!(place.read("a wrong & (2).nc.rejected"), wrong());
    assert!(place.read("a wrong & (2).nc.rejected.txt").contains("PB"), "{run:?}");
    // The CAM program writes the file again, without the mistake.
    let place = place.file("a wrong & (2).nc", SOUND);
    let run = gate(&place, &["a wrong & (2).nc"], "");
    assert_eq!(run.status.code(), Some(0), "{run:?}");
    assert!(has(&place, "a wrong & (2).nc") && !has(&place, "a wrong & (2).nc.rejected"));
}

/// If a script's variable is not set, the command names no program, or the directory.
#[test]
fn nothing_and_a_directory_do_not_pass() {
    let place = Place::new().file("jobs/a.nc", wrong());
    assert_eq!(gate(&place, &[], "").status.code(), Some(2));
    assert_eq!(gate(&place, &["jobs"], "").status.code(), Some(1));
    assert!(has(&place, "jobs/a.nc"));
}

#[test]
fn options_reach_verify_and_what_was_not_checked_is_kept_out_of_the_way() {
    let place = Place::new().file("a.nc", SOUND);
    assert_eq!(gate(&place, &["a.nc"], "--surface 0 --require rapids=assumed").status.code(), Some(0));
    assert_eq!(gate(&place, &["a.nc"], "--require rapids").status.code(), Some(1));
    assert!(place.read("a.nc.rejected.txt").contains("PB523"));
}

/// Z 0 is on the table, but `--surface` says that it is on the stock.
#[test]
fn a_program_whose_cuts_all_end_above_the_surface_is_not_checked() {
    let verify = |z: &str| {
        let place = Place::new().file("a.nc", SOUND.replace("Z-2", &format!("Z{z}")));
        place.run("verify a.nc --cutter 6 --surface 0 --require rapids")
    };
    assert_eq!(verify("0").status, Some(0), "{}", verify("0"));
    let above = verify("0.1");
    assert!(above.stderr.contains("PB777") && above.stderr.contains("PB523"), "{above}");
}

/// The file beside the programs has the limits of their machine. A directory with drawings alone has none.
#[test]
fn programs_below_a_configuration_of_their_own_are_not_passed_without_it() {
    let place = Place::new()
        .file("small/pathbuild.toml", "[machine]\nx = [0, 30]\n")
        .file("small/a.nc", SOUND)
        .file("parts/pathbuild.toml", "feed = 100\n")
        .file("parts/1234.1P.dxf", "");
    let verify = "verify . --dialect grbl --cutter 6 --surface 0";
    let without = place.run(verify);
    assert_eq!(without.status, Some(1), "{without}");
    assert_eq!(without.stderr.matches("error[PB526]").count(), 1, "{without}");
    let place = place.file("pathbuild.toml", "[machine]\nx = [0, 300]\n");
    let with_another = place.run(verify);
    assert_eq!(with_another.status, Some(1), "{with_another}");
    assert!(with_another.stderr.contains("error[PB526]"), "{with_another}");
    let own = place.run("verify small --dialect grbl --cutter 6 --surface 0");
    assert!(own.stderr.contains("[PB748]") && !own.stderr.contains("PB526"), "{own}");
}

/// The configuration lowers the severity of the error, but the moves are still unknown.
#[test]
fn moves_after_a_word_that_is_not_followed_do_not_count_as_checked() {
    let verify = |word: &str| {
        let configuration = "[severity]\nPB721 = \"warning\"\n[machine]\ntravel = [400, 300, 80]\n";
        let program = SOUND.replace("G1 X40", &format!("{word}\nG1 X40"));
        let place = Place::new().file("pathbuild.toml", configuration).file("a.nc", program);
        place.run("verify a.nc --dialect fanuc --cutter 6 --surface 0 --require rapids,envelope")
    };
    assert_eq!(verify("M8").status, Some(0), "{}", verify("M8"));
    let unknown = verify("G65 P9000 X10. Z-50.");
    assert_eq!(unknown.stderr.matches("[PB523]").count(), 2, "{unknown}");
}

/// Fanuc's block end, printed as a character, hides the moves of its line.
#[test]
fn moves_of_a_line_that_is_ignored_do_not_count_as_checked() {
    let verify = |end: &str| {
        let program = SOUND.replace("G1 X40 F600\n", &format!("G1 X40 F600{end}\n"));
        let place =
            Place::new().file("pathbuild.toml", "severity.PB702 = \"ignore\"\n").file("a.nc", program);
        place.run("verify a.nc --dialect fanuc --cutter 6 --surface 0 --require rapids")
    };
    assert_eq!(verify("").status, Some(0), "{}", verify(""));
    let hidden = verify(";");
    assert!(hidden.stderr.contains("[PB523]"), "{hidden}");
}

/// `O0000` is the default number of Mastercam.
#[test]
fn a_wrong_program_number_leaves_the_moves_known() {
    let verify = |words: &str| {
        let program = SOUND.replace("G21 G90", &format!("{words}\nG21 G90"));
        let place = Place::new().file("a.nc", program);
        place.run("verify a.nc --dialect fanuc --cutter 6 --surface 0 --require rapids")
    };
    let numbered = verify("O0000");
    assert!(numbered.stderr.contains("[PB725]") && !numbered.stderr.contains("[PB523]"), "{numbered}");
    let hidden = verify("O1\nG4 P-1");
    assert!(hidden.stderr.contains("[PB725]") && hidden.stderr.contains("[PB523]"), "{hidden}");
}

/// A program that moves by distances from beginning to end may begin anywhere.
#[test]
fn moves_from_a_place_that_is_never_stated_do_not_count_as_checked() {
    let verify = |mode: &str| {
        let program = format!(
            "G21 {mode} G94 G17\nS12000 M3\nG0 Z5\nG0 X10 Y10\nG1 Z-7 F200\nG1 X40 F600\nG0 Z7\nG0 Y20\nM5\nM30\n"
        );
        let configuration = "[machine]\ntravel = [400, 300, 80]\n";
        let place = Place::new().file("pathbuild.toml", configuration).file("a.nc", program);
        place.run("verify a.nc --dialect grbl --cutter 6 --surface 0 --require rapids,envelope")
    };
    assert_eq!(verify("G90").status, Some(0), "{}", verify("G90"));
    let unknown = verify("G91");
    assert_eq!(unknown.stderr.matches("[PB523]").count(), 2, "{unknown}");
}

/// Whether the surface is stated makes no difference if the cutter is unknown.
#[test]
fn a_rapid_move_far_from_all_cuts_is_doubted_with_a_surface_too() {
    let verify = |y: &str| {
        let program = format!(
            "G21 G90 G94 G17\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-2 F200\nG1 X40\nG0 Y{y}\nG1 X0\nG0 Z5\nM5\nM30\n"
        );
        Place::new().file("a.nc", program).run("verify a.nc --dialect grbl --surface 0")
    };
    assert!(verify("200").stderr.contains("PB781"), "{}", verify("200"));
    assert!(!verify("20").stderr.contains("PB781"), "{}", verify("20"));
}

/// A rapid move begins at a position that only the machine knows, and goes down below the surface.
#[test]
fn a_rapid_move_on_an_unknown_way_does_not_count_as_checked() {
    let program = |start: &str| {
        format!(
            "G17 G21 G40 G54 G90 G94 F100\nM3 S9000\n{start}\nG1 X90\nG0 Z5\nG0 X0 Y0\nG1 Z-1\nG0 Z5\nM5\nM30\n"
        )
    };
    let verify = |start: &str, arguments: &str| {
        let place = Place::new().file("a.nc", program(start));
        place.run(&format!(
            "verify a.nc --dialect linuxcnc --cutter 2 --surface 0 --require rapids {arguments}"
        ))
    };
    for start in ["G53 G0 Z0\nG0 X80 Y80\nG0 Z5", "G28\nG0 X80 Y80\nG43 H1 G0 Z5", "G0 X80 Y80 Z5"] {
        let run = verify(start, "");
        assert_eq!(run.status, Some(0), "{start}\n{run}");
        assert!(run.stderr.contains("checked: words, rapid moves against"), "{start}\n{run}");
    }
    let low = "G0 X80 Y80 Z-2\nG0 X85\nG0 Z5";
    let run = verify(low, "--format concise");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("a.nc:3:1: error[PB523]"), "{run}");
    assert!(
        run.stderr
            .contains("not checked: 1 rapid move from an unknown position to below the surface, in line 3 ("),
        "{run}"
    );
    let german = verify(low, "--lang de");
    assert!(
        german
            .stderr
            .contains("nicht geprüft: 1 Eilgang von unbekannter Position unter die Oberfläche, in Zeile 3 ("),
        "{german}"
    );
    let json = verify(low, "--format json");
    assert!(json.stdout.contains("\"moves\":1") || json.stdout.contains("\"moves\": 1"), "{json}");
}

#[test]
fn a_program_that_nothing_checks_does_not_pass() {
    let place = Place::new().file("a.nc", SOUND);
    assert_eq!(gate(&place, &["none.nc"], "").status.code(), Some(1));
    assert_eq!(gate(&place, &["a.nc"], "--no-such-option").status.code(), Some(1));
    assert!(!has(&place, "a.nc") && has(&place, "a.nc.rejected"));
}

/// The post for FreeCAD is tested with a stand-in for FreeCAD's own post.
#[test]
fn the_post_for_freecad_writes_only_what_passes() {
    let name = if cfg!(windows) { "python" } else { "python3" };
    if !Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success()) {
        return skip("python3", "the post for FreeCAD is not tried");
    }
    let stand_in = "TOOLTIP = ''\nTOOLTIP_ARGS = ''\ndef export(objects, filename, arguments):\n    assert filename == '-'\n    return objects\n";
    let post = std::fs::read_to_string(example("pathbuild_gate_post.py")).unwrap();
    let run = "import sys, pathbuild_gate_post\npathbuild_gate_post.export(open(sys.argv[1]).read(), sys.argv[2], '')\n";
    let place = Place::new()
        .file("Path/Post/scripts/grbl_post.py", stand_in)
        .file(
            "pathbuild_gate_post.py",
            post.replace("[\"--require\", \"rapids=assumed\"]", "[\"--surface\", \"0\"]"),
        )
        .file("run.py", run)
        .file("sound", SOUND)
        .file("wrong", wrong());
    let export = |gcode: &str| command(&place, name).args(["run.py", gcode, "out.nc"]).output().unwrap();
    let refused = export("wrong");
    assert!(!refused.status.success() && !has(&place, "out.nc"), "{refused:?}");
    assert!(String::from_utf8_lossy(&refused.stderr).contains("the program was not written"));
    let written = export("sound");
    assert!(written.status.success(), "{written:?}");
    assert_eq!(place.read("out.nc"), SOUND);
    // The configuration beside the program applies, and nothing else is left there.
    let place = place.file("machine/pathbuild.toml", "[machine]\ntravel = [30, 30, 30]\n");
    let run = |gcode: &str, out: &str| command(&place, name).args(["run.py", gcode, out]).output().unwrap();
    let refused = run("sound", "machine/out.nc");
    assert!(!refused.status.success(), "{refused:?}");
    assert!(String::from_utf8_lossy(&refused.stderr).contains("PB748"), "{refused:?}");
    assert_eq!(std::fs::read_dir(place.path().join("machine")).unwrap().count(), 1);
}

/// If pathbuild had to assume a probed height, it has not checked the moves that the machine makes.
#[test]
fn rapid_moves_by_values_of_the_machine_are_checked_by_assumption() {
    let program = |height: &str| {
        format!(
            "G17 G21 G40 G54 G90 G94 F100\nG0 Z5\nG0 X20 Y0\nG38.2 Z-10\nG0 Z{height}\nG0 X0\nG1 Z-1\nG1 X20\nG0 Z5\nM30\n"
        )
    };
    let verify = |height: &str, arguments: &str| {
        let place = Place::new().file("a.nc", program(height));
        place.run(&format!("verify a.nc --dialect linuxcnc --cutter 2 --surface 0 {arguments}"))
    };
    assert_eq!(verify("5", "--require rapids").status, Some(0));
    let run = verify("[#5063+5]", "--require rapids");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(
        run.stderr.contains("PB523") && run.stderr.contains("values that only the machine knows"),
        "{run}"
    );
    let run = verify("[#5063+5]", "--require rapids=assumed");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(run.stderr.contains("(values that only the machine knows are assumed)"), "{run}");
    let run = verify("[#5063+5]", "--lang de");
    assert!(run.stderr.contains("(Werte, die nur die Maschine kennt, sind angenommen)"), "{run}");
}

/// Programs are generated files, which .gitignore often excludes.
#[test]
fn programs_that_git_ignores_are_verified() {
    let place = Place::new()
        .file(".gitignore", "gcode/\n*.tap\n")
        .file("gcode/wrong.nc", wrong())
        .file("gcode/old/.ignore", "*.nc\n")
        .file("gcode/old/left.nc", wrong())
        .file("other.tap", wrong())
        .file("ok/sound.nc", SOUND);
    let run = place.run("verify . --format concise");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("gcode/wrong.nc:") && run.stderr.contains("other.tap:"), "{run}");
    assert!(!run.stderr.contains("left.nc"), "{run}");
}

/// If the tool table has the direction of a tool, or the program a spindle speed, the program must start the spindle.
#[test]
fn a_spindle_that_is_never_started_is_found() {
    let program = |speed: &str| {
        format!("G21 G90 G94 G17\n{speed}\nG0 Z15\nG0 X0 Y0\nG1 Z-2 F200\nG1 X40 F600\nG0 Z15\nM30\n")
    };
    let verify = |table: &str, speed: &str| {
        let place = Place::new().file("pathbuild.toml", table).file("a.nc", program(speed));
        let run = place.run("verify a.nc --dialect linuxcnc --format concise");
        let found = run.stderr.lines().find(|line| line.contains("PB745")).map(str::to_owned);
        found.map(|line| line.split("PB745").next().unwrap_or_default().to_owned())
    };
    let table = "[tool.a]\ndiameter = 2\nnumber = 1\nspindle = 12000\n";
    assert_eq!(verify(table, "T1 M6").as_deref(), Some("a.nc:5:1: error["));
    assert_eq!(verify(table, "T1 M6 M3 S900"), None);
    assert_eq!(verify(&table.replace("spindle = 12000\n", ""), "T1 M6"), None);
    assert_eq!(verify(&format!("spindle = \"manual\"\n{table}"), "T1 M6"), None);
    assert_eq!(verify("", "T1 M6"), None);
    assert_eq!(verify("", "S12000").as_deref(), Some("a.nc:5:1: warning["));
    assert_eq!(verify("", "S0"), None);
}
