//! Tests `machine import` with descriptions of machines in every known format, all written according to the formats' documentation.
//! (book: howto/machine)

use std::io::Write;

use crate::support::{Place, Run, runs};
use flate2::Compression;
use flate2::write::DeflateEncoder;
use insta::assert_snapshot;
use rawzip::{CompressionMethod, ZipArchiveWriter};

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

/// Imports a description, with findings in concise form.
fn findings(content: impl AsRef<[u8]>) -> Run {
    Place::new().file("machine.txt", content).run("machine import machine.txt --format concise")
}

#[test]
fn a_byte_order_mark_is_no_part_of_the_first_setting() {
    assert_eq!(findings(format!("\u{feff}{GRBL}")).stdout, findings(GRBL).stdout);
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
fn a_speed_map_has_finite_numbers() {
    let said = |map: &str| {
        let description = FLUIDNC.replace("0=0.000% 1000=0.000% 24000=100.000%", map);
        Place::new().file("a.yaml", description).run("machine import a.yaml --format concise").to_string()
    };
    assert!(said("0=0% 24000=100%").contains("spindle-speeds = [0, 24000]"));
    for map in ["0=0% inf=100%", "0=0% 24000=nan%"] {
        assert!(said(map).contains(&format!("is `{map}`, but a map such as")), "{map}");
    }
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

/// A configuration with tools, one of which has another name in a library.
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

/// A corner radius that no tool can have is an error that names the tool, and nothing is written.
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

/// Returns an archive of these files, compressed or not.
fn archive(files: &[(&str, &[u8])], method: CompressionMethod) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut archive = ZipArchiveWriter::new(&mut bytes);
    for (name, content) in files {
        let (mut entry, config) = archive.new_file(name).compression_method(method).start().unwrap();
        let descriptor = if method == CompressionMethod::DEFLATE {
            let mut writer = config.wrap(DeflateEncoder::new(&mut entry, Compression::default()));
            writer.write_all(content).unwrap();
            let (encoder, descriptor) = writer.finish().unwrap();
            encoder.finish().unwrap();
            descriptor
        } else {
            let mut writer = config.wrap(&mut entry);
            writer.write_all(content).unwrap();
            writer.finish().unwrap().1
        };
        entry.finish(descriptor).unwrap();
    }
    archive.finish().unwrap();
    bytes
}

#[test]
fn the_archive_of_fusion_is_read_like_its_library() {
    let import = |name: &str, content: &[u8]| {
        Place::new().file(name, content).run(&format!("machine import {name} --format concise"))
    };
    let expected = import("fusion.json", FUSION.as_bytes());
    let same = |run: &Run| run.stdout.replace("fusion.tools", "fusion.json") == expected.stdout;
    for method in [CompressionMethod::STORE, CompressionMethod::DEFLATE] {
        let run = import("fusion.tools", &archive(&[("tools.json", FUSION.as_bytes())], method));
        assert!(same(&run) && run.status == expected.status, "{run}");
    }
    // A library of 4 MB is read, whatever its compressed size; a larger one is refused.
    let padded = |length: usize| format!("{FUSION}{}", " ".repeat(length - FUSION.len())).into_bytes();
    let packed = |length| archive(&[("tools.json", &padded(length))], CompressionMethod::DEFLATE);
    let run = import("fusion.tools", &packed(4 << 20));
    assert!(same(&run), "{run}");
    let whole = archive(&[("tools.json", FUSION.as_bytes())], CompressionMethod::DEFLATE);
    let mut altered = whole.clone();
    let middle = altered.len() / 4;
    altered[middle] ^= 1;
    let json = FUSION.as_bytes();
    for refused in [
        packed((4 << 20) + 1),
        archive(&[], CompressionMethod::STORE),
        archive(&[("tools.json", json), ("more.json", json)], CompressionMethod::DEFLATE),
        archive(&[("tools.json", b"\xff")], CompressionMethod::STORE),
        whole[..whole.len() / 2].to_vec(),
        altered,
    ] {
        let run = import("fusion.tools", &refused);
        assert!(run.status == Some(1) && run.stderr.contains("PB612") && run.stdout.is_empty(), "{run}");
    }
}

/// Returns a library of two tools with these numbers and geometries.
fn numbered(third: (u32, &str), fourth: (u32, &str)) -> String {
    let tool = |(number, keys): (u32, &str)| {
        format!(
            "{{\"description\": \"6 mm flat\", \"geometry\": {{{keys}}}, \"post-process\": {{\"number\": {number}}},\n\"type\": \"flat end mill\", \"unit\": \"millimeters\"}}"
        )
    };
    format!("{{\n\"data\": [\n{},\n{}\n], \"version\": 36\n}}\n", tool(third), tool(fourth))
}

#[test]
fn tools_with_one_number_are_not_mixed() {
    let import =
        |library: &str| Place::new().file("a.json", library).run("machine import a.json --format concise");
    let run = import(&numbered((3, "\"DC\": 6, \"NOF\": 2"), (3, "\"DC\": 6, \"LCF\": 20")));
    assert!(
        run.stderr.contains("a.json:5: warning[PB613]") && run.stderr.contains("line 3 of a.json"),
        "{run}"
    );
    assert!(run.status == Some(0) && !run.stdout.contains('+'), "{run}");
    let run = import(&numbered((3, "\"DC\": 6"), (4, "\"DC\": 6")));
    assert!(!run.stderr.contains("PB613"), "{run}");
    assert!(
        run.stdout.contains("[tool.\"6 mm flat\"]") && run.stdout.contains("[tool.\"6 mm flat (T4)\"]"),
        "{run}"
    );
    // Repeating the same tool has no effect.
    let run = import(&numbered((3, "\"DC\": 6"), (3, "\"DC\": 6")));
    assert!(!run.stderr.contains("PB613") && run.stdout.matches("diameter").count() == 1, "{run}");
}

/// Two files may complete each other, but not contradict each other.
#[test]
fn tools_of_several_files_are_combined_by_their_number() {
    let import = |table: &str| {
        let place = Place::new().file("a.json", numbered((3, "\"DC\": 6, \"NOF\": 2"), (4, "\"DC\": 8")));
        place.file("tool.tbl", table).run("machine import a.json tool.tbl --units mm --format concise")
    };
    let run = import("T3 P1 D6 ;flat\n");
    assert!(!run.stderr.contains("PB613") && run.stdout.matches("+ diameter = 6 ").count() == 1, "{run}");
    let run = import("T3 P1 D5 ;flat\n");
    assert!(
        run.stderr.contains("tool.tbl:1: warning[PB613]") && run.stderr.contains("line 3 of a.json"),
        "{run}"
    );
    assert!(!run.stdout.contains("diameter = 6") && run.stdout.contains("+ diameter = 8 "), "{run}");
}

/// Of two lines with the same name, LinuxCNC uses the first one, so another value in the second one is only a warning.
#[test]
fn of_two_lines_the_one_in_force_is_imported() {
    let import =
        |ini: &str| Place::new().file("mill.ini", ini).run("machine import mill.ini --format concise");
    let line = INCH.lines().find(|line| line.starts_with("MAX_LIMIT")).unwrap();
    let travel = |run: &Run| run.stdout.lines().find(|line| line.contains("travel")).map(str::to_owned);
    let once = import(INCH);
    let equal = import(&INCH.replacen(line, &format!("{line}\n{line}"), 1));
    assert!(!equal.stderr.contains("PB613") && travel(&equal) == travel(&once), "{equal}");
    let other = import(&INCH.replacen(line, &format!("{line}\nMAX_LIMIT = 4000"), 1));
    assert!(other.stderr.contains("warning[PB613]") && travel(&other) == travel(&once), "{other}");
    assert!(other.stderr.contains("MAX_LIMIT` is `4000` here"), "{other}");
    let included = import(&format!("{INCH}#INCLUDE traj.inc\n"));
    assert!(included.stderr.contains("warning[PB613]"), "{included}");
}

#[test]
fn units_must_not_contradict_the_ini_file() {
    let place = Place::new().file("mill.ini", INCH).file("tool.tbl", TABLE);
    let import = |options: &str| place.run(&format!("machine import tool.tbl mill.ini {options}"));
    assert_eq!(import("").status, Some(0));
    assert_eq!(import("--units inch").status, Some(0));
    let refused = import("--units mm --write");
    assert!(refused.status == Some(1) && refused.stderr.contains("PB612"), "{refused}");
    assert!(!place.path().join("pathbuild.toml").exists());
}

#[test]
fn comments_within_lists_are_kept() {
    let multi = "[machine]\ntravel = [\n  300, # X, belt\n  200, # Y\n  60, # Z until the clamp\n]\n";
    let place = Place::new().file("pathbuild.toml", multi).file("grbl.txt", GRBL);
    assert_eq!(place.run("machine import grbl.txt --write").status, Some(0));
    let text = place.read("pathbuild.toml");
    for comment in ["# X, belt", "# Y", "# Z until the clamp"] {
        assert!(text.contains(comment), "{text}");
    }
    assert!(!text.contains("300, # X"), "{text}");
    assert!(place.run("machine import grbl.txt --write").stderr.contains("nothing differs"));
}

#[test]
fn a_broken_line_of_a_tool_table_is_named() {
    let import = |table: &str| {
        Place::new().file("tool.tbl", table).run("machine import tool.tbl --units mm --format concise")
    };
    let small = import("T3 P1 D6 ;six\nt4 p2 d3 ;three\n");
    assert!(small.status == Some(0) && small.stdout.contains("diameter = 3"), "{small}");
    let broken = import("T3 P1 D6 ;six\nsix D6\n");
    assert!(broken.status == Some(1) && broken.stderr.contains("tool.tbl:2: error[PB612]"), "{broken}");
}

/// A tool with a measured diameter, or with another description, is still the same tool.
#[test]
fn a_number_that_gets_another_tool_is_a_warning() {
    let import = |line: &str| {
        let tools = "[tool.6mm]\ndiameter = 6\nnumber = 3\nspindle = 9000\n";
        let place = Place::new().file("pathbuild.toml", tools).file("tool.tbl", line);
        let run = place.run("machine import tool.tbl --units mm --format concise");
        assert_eq!(run.status, Some(0), "{run}");
        run.stderr.contains("PB777")
    };
    assert!(import("T3 P1 D2 ;2mm\n"));
    assert!(!import("T3 P1 D5.98 ;6mm\n"));
    assert!(!import("T3 P1 D5.98\n"));
    assert!(!import("T3 P1 D6 ;roughing cutter\n"));
    assert!(!import("T4 P1 D2 ;2mm\n"));
}
