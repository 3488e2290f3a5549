//! `machine import`: descriptions of machines in every known form, all written to the forms that their documentation describes. (book:
//! howto/machine)

use crate::support::{Place, Run, runs};
use insta::assert_snapshot;

const GRBL: &str = include_str!("machine_import/grbl.txt");
const GRBLHAL: &str = include_str!("machine_import/grblhal.txt");
const FLUIDNC: &str = include_str!("machine_import/fluidnc.yaml");
const INCH: &str = include_str!("machine_import/inch.ini");

const TABLE: &str = include_str!("machine_import/tool.tbl");
const FUSION: &str = include_str!("machine_import/fusion.json");
const LIBRARY: &str = include_str!("machine_import/Library/Default.fctl");
const ENDMILL: &str = include_str!("machine_import/Bit/5mm_Endmill.fctb");
const BULLNOSE: &str = include_str!("machine_import/Bit/6mm_Bullnose.fctb");

const CONFIGURED: &str = "# The workshop's router.
feed = 150

[machine]
travel = [300, 200, 60] # measured
accelerations = [200, 200.0, 50]
# rates = [1, 1, 1]

[severity]
PB210 = \"ignore\" # as agreed
";

/// The concise findings about a description.
fn findings(content: impl AsRef<[u8]>) -> Run {
    Place::new().file("machine.txt", content).run("machine import machine.txt --format concise")
}

#[test]
fn every_form_is_compared_with_the_configuration() {
    let place = Place::new()
        .file("pathbuild.toml", CONFIGURED)
        .file("grbl.txt", GRBL)
        .file("grblhal.txt", GRBLHAL)
        .file("config.yaml", FLUIDNC)
        .file("mill.ini", INCH);
    let lines = [
        "machine import grbl.txt",
        "machine import grbl.txt --lang de",
        "machine import grbl.txt --format json",
        "machine import grblhal.txt",
        "machine import config.yaml",
        "machine import mill.ini",
    ];
    assert_snapshot!(runs(&place, lines));
    assert_eq!(place.read("pathbuild.toml"), CONFIGURED);
}

#[test]
fn writing_keeps_comments_and_order() {
    let place = Place::new().file("pathbuild.toml", CONFIGURED).file("grbl.txt", GRBL);
    let run = place.run("machine import grbl.txt --write");
    assert_eq!(run.status, Some(0), "{run}");
    assert_snapshot!(place.read("pathbuild.toml"));
    let again = place.run("machine import grbl.txt --write");
    assert!(again.stderr.contains("nothing differs") && !again.stdout.contains('+'), "{again}");
}

#[test]
fn writing_keeps_the_line_ends_of_windows() {
    let place = Place::new().file("pathbuild.toml", CONFIGURED.replace('\n', "\r\n")).file("grbl.txt", GRBL);
    place.run("machine import grbl.txt --write");
    let text = place.read("pathbuild.toml");
    assert_eq!(text.matches('\n').count(), text.matches("\r\n").count(), "{text}");
}

#[test]
fn without_a_configuration_one_is_created() {
    let place = Place::new().file("grbl.txt", GRBL.replace('\n', "\r\n"));
    assert_eq!(place.run("machine import grbl.txt --write").status, Some(0));
    assert!(place.read("pathbuild.toml").starts_with("[machine]\nrates = [3000, 3000, 1000]\n"));
    assert_eq!(place.run("config show").status, Some(0));
}

#[test]
fn values_that_no_key_can_take_are_said() {
    let place = Place::new()
        .file("laser.txt", GRBL.replace("$32=0", "$32=1"))
        .file("zero.txt", GRBL.replace("$132=100.000", "$132=0.000"))
        .file("missing.txt", GRBL.replace("$122=50.000\n", "").replace("$110=3000.000", "$110=fast"))
        .file("speeds.txt", GRBL.replace("$31=6000", "$31=24000"))
        .file("twice.yaml", format!("{FLUIDNC}\n10V:\n  speed_map: 0=0% 1=1%\n"))
        .file("map.yaml", FLUIDNC.replace("speed_map: 0=0.000%", "speed_map: 0:0"))
        .file("no-unit.ini", INCH.replace("LINEAR_UNITS = inch\n", ""))
        .file("unit.ini", INCH.replace("LINEAR_UNITS = inch", "LINEAR_UNITS = furlong"))
        .file("endless.ini", INCH.replace("MAX_LIMIT = 5", "MAX_LIMIT = 1e99"));
    let lines = [
        "machine import laser.txt --format concise",
        "machine import zero.txt --format concise",
        "machine import missing.txt --format concise",
        "machine import speeds.txt --format concise",
        "machine import twice.yaml --format concise",
        "machine import map.yaml --format concise",
        "machine import no-unit.ini --format concise",
        "machine import unit.ini --format concise",
        "machine import endless.ini --format concise",
    ];
    assert_snapshot!(runs(&place, lines));
}

#[test]
fn nothing_is_written_if_a_file_cannot_be_read() {
    let place = Place::new().file("grbl.txt", GRBL).file("other.txt", "M3 S1000\n");
    let run = place.run("machine import grbl.txt other.txt --write");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(!place.path().join("pathbuild.toml").exists(), "{run}");
}

#[test]
fn hostile_descriptions_are_refused_with_a_reason() {
    let bomb = (0..40).fold("a0: &a0 [x, x]\n".to_owned(), |text, level| {
        format!("{text}a{}: &a{} [*a{level}, *a{level}]\n", level + 1, level + 1)
    });
    let deep = format!("axes:\n  x: {}1{}\n", "[".repeat(5000), "]".repeat(5000));
    let nested = format!("{{\"data\": {}{}}}", "[".repeat(100_000), "]".repeat(100_000));
    let hostile: [(&[u8], &str); 13] = [
        (b"", "PB612"),
        (b"\0\x01\x02$110=5", "PB612"),
        (b"$110=\xff\xfe\n", "PB612"),
        (b"PK\x03\x04", "PB612"),
        (b"axes:\n  x: [1, 2\n", "PB612"),
        (b"axes:\n\t- : : {\n", "PB612"),
        (b"[TRAJ\nLINEAR_UNITS = mm\n[EMC]\n", "PB612"),
        (deep.as_bytes(), "PB612"),
        (nested.as_bytes(), "PB612"),
        (b"{\"data\": [{\"geometry\": {\"DC\": 1e999}}]}", "PB612"),
        (b"{\"tools\": 5}", "PB612"),
        (b"T1 P1 D0.125\n", "PB612"),
        (&vec![b'$'; (4 << 20) + 1], "PB612"),
    ];
    for (content, code) in hostile {
        let run = findings(content);
        assert_eq!(run.status, Some(1), "{run}");
        assert!(run.stderr.contains(code) || run.stdout.contains(code), "{run}");
    }
    let run = findings(format!("{bomb}\naxes:\n  x:\n    max_travel_mm: 1\n"));
    assert_eq!(run.status, Some(0), "{run}");
}

/// A configuration with tools, one of which a library knows under another name.
const TOOLS: &str = "[tool.\"my 6\"]
diameter = 6.0 # worn to 5.9
number = 3

[tool.small]
diameter = 1
spindle = 9000
";

#[test]
fn tool_libraries_become_tools() {
    let place = Place::new()
        .file("pathbuild.toml", TOOLS)
        .file("tool.tbl", TABLE)
        .file("mill.ini", "[EMC]\n[TRAJ]\nLINEAR_UNITS = inch\n")
        .file("fusion.json", FUSION)
        .file("lib/Library/Default.fctl", LIBRARY)
        .file("lib/Bit/5mm_Endmill.fctb", ENDMILL)
        .file("lib/Bit/6mm_Bullnose.fctb", BULLNOSE)
        .file("secret.fctb", ENDMILL);
    let lines = [
        "machine import tool.tbl",
        "machine import tool.tbl --units inch",
        "machine import tool.tbl mill.ini",
        "machine import fusion.json --format concise",
        "machine import lib/Library/Default.fctl --format concise",
        "machine import lib/Bit/6mm_Bullnose.fctb --format concise",
    ];
    assert_snapshot!(runs(&place, lines));
    place.run("machine import fusion.json --write");
    assert_snapshot!(place.read("pathbuild.toml"));
    let again = place.run("machine import fusion.json");
    assert!(again.stderr.contains("nothing differs"), "{again}");
    assert_eq!(place.run("config show").status, Some(0));
}

/// A tool whose tip no tool has is an error that names it, and nothing is written.
#[test]
fn a_corner_radius_above_half_of_the_diameter_is_refused() {
    let library =
        |radius: &str| FUSION.replace("\"NOF\": 4, \"RE\": 0.03", &format!("\"NOF\": 4, \"RE\": {radius}"));
    let import =
        |radius: &str| Place::new().file("fusion.json", library(radius)).run("machine import fusion.json");
    assert_eq!(import("0.125").status, Some(0));
    let run = import("0.126");
    assert!(run.status == Some(1) && run.stderr.contains("tool 4 (1/4 bull nose)"), "{run}");
    assert!(run.stdout.is_empty() || !run.stdout.contains("corner-radius"), "{run}");
}
