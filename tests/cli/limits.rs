//! Tests the limits of programs in `[limits]`: each has an input just inside and one just outside. Other inputs would expand to gigabytes without
//! limits. (docs/reliability.md)

use std::fs;
use std::time::{Duration, Instant};

use crate::growth::drawings::{entities, line};
use crate::support::{Place, Run};
use pathbuild_testkit::sheet;

const CONFIGURATION: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n";

/// File name of a definition in CamBam's language, which writes the native moves in its own way.
const CAMBAM: &str = "m.cbpp";

fn place(limits: &str, parameters: &str) -> Place {
    let drawn = format!("layer 1202.1P\nstart 0,0 \"{parameters}\"\nmill 0,0 40,0\nend 40,0");
    let post = "<PostProcessor><PostFile>{$mops}</PostFile><MOP>{$blocks}</MOP><Rapid>{$_g0} {$_x} {$_y} {$_z}</Rapid>\
        <FeedMove>{$_g1} {$_f} {$_x} {$_y} {$_z}</FeedMove></PostProcessor>";
    Place::new()
        .file("pathbuild.toml", format!("{CONFIGURATION}[limits]\n{limits}\n"))
        .file("1202.1P.dxf", sheet(&drawn).unwrap().to_dxf())
        .file(CAMBAM, post)
}

fn programs(place: &Place) -> Vec<u64> {
    let files = fs::read_dir(place.path()).unwrap().map(|entry| entry.unwrap());
    let programs = files.filter(|file| file.file_name().to_string_lossy().contains("_Milling"));
    programs.map(|file| file.metadata().unwrap().len()).collect()
}

#[track_caller]
fn assert_exceeds(run: &Run, key: &str) {
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("PB005") && run.stderr.contains(&format!("`{key}`")), "{run}");
}

/// Checks that an input passes with this limit, and that with a limit that is one less it fails and nothing is written.
#[track_caller]
fn assert_limited(key: &str, most: u64, parameters: &str, commands: &[&str]) {
    for command in commands {
        let inside = place(&format!("{key} = {most}"), parameters);
        let run = inside.run(command);
        assert_eq!(run.status, Some(0), "{run}");
        assert_eq!(programs(&inside).len(), usize::from(command.starts_with("emit")), "{run}");
        let outside = place(&format!("{key} = {}", most - 1), parameters);
        assert_exceeds(&outside.run(command), key);
        assert_eq!(programs(&outside), [0; 0]);
    }
}

#[test]
fn the_memory_of_a_program_is_limited() {
    let parameters = "T5 O2 I0.01 B0 MX";
    let asked = place("program-memory = 1", parameters).run("check 1202.1P.dxf --no-cache");
    assert_exceeds(&asked, "program-memory");
    let (_, rest) = asked.stderr.split_once("about ").unwrap();
    let size = rest.split(' ').next().unwrap().parse().unwrap();
    let commands = ["check 1202.1P.dxf", "emit 1202.1P.dxf", "emit 1202.1P.dxf --post linuxcnc"];
    assert_limited("program-memory", size, parameters, &commands);
}

#[test]
fn what_is_written_is_limited() {
    let control_text = format!("--post ./{CAMBAM} --dialect linuxcnc");
    for options in ["", "--post linuxcnc", "--post xpertmill", &control_text] {
        let command = format!("emit 1202.1P.dxf {options}");
        let parameters = "T5 O2 I0.1 B0 MX";
        let whole = place("", parameters);
        let run = whole.run(&command);
        assert_eq!(run.status, Some(0), "{run}");
        let [size] = programs(&whole)[..] else { panic!("{run}") };
        let inside = place(&format!("output-size = {size}"), parameters);
        let run = inside.run(&command);
        assert_eq!((run.status, programs(&inside)), (Some(0), vec![size]), "{run}");
        let outside = place(&format!("output-size = {}", size - 1), parameters);
        assert_exceeds(&outside.run(&command), "output-size");
        assert_eq!(programs(&outside), [0; 0]);
    }
}

/// Moves are counted before they are generated.
#[test]
fn the_moves_of_a_program_are_limited() {
    let parameters = "T5 O2 I1 B0 MX";
    let asked = place("embedding-moves = 1", parameters).run("check 1202.1P.dxf --no-cache");
    assert_exceeds(&asked, "embedding-moves");
    let (before, _) = asked.stderr.split_once(" moves").unwrap();
    let count = before.rsplit(' ').next().unwrap().parse().unwrap();
    assert_limited("embedding-moves", count, parameters, &["check 1202.1P.dxf", "emit 1202.1P.dxf"]);
}

/// Each drawing has a few hundred bytes; checking or emitting it fails immediately.
#[test]
fn few_bytes_do_not_become_gigabytes() {
    for parameters in ["T5 O2 I1 B-10000000 MX", "T5 O2 I0.0000001 B0 MX", "T5 O2 I0.0000001 B0 W4 MX"] {
        for command in [
            "check 1202.1P.dxf",
            "emit 1202.1P.dxf",
            "emit 1202.1P.dxf --post grbl",
            "view 1202.1P.dxf -o v.svg",
        ] {
            let place = place("", parameters);
            let begun = Instant::now();
            let run = place.run(command);
            assert_exceeds(
                &run,
                if run.stderr.contains("memory") { "program-memory" } else { "embedding-moves" },
            );
            assert!(begun.elapsed() < Duration::from_secs(20), "{parameters} {command}");
            assert_eq!(programs(&place), [0; 0]);
        }
    }
}

/// A comment is repeated in every pass of a program. A picture does not contain it.
#[test]
fn a_comment_does_not_fill_the_disk() {
    let drawn = format!(
        "layer 1202.1P\nstart 0,0 \"T5 O2 I0.05 B0 MX\"\nmill 0,0 40,0 \"Q{}\"\nend 40,0",
        "x".repeat(20_000)
    );
    let drawing = sheet(&drawn).unwrap().to_dxf();
    let place = || place("output-size = \"1 MiB\"", "T5 O2 I1 B0 MX").file("1202.1P.dxf", &drawing);
    for command in ["emit 1202.1P.dxf", "emit 1202.1P.dxf --post linuxcnc"] {
        let place = place();
        assert_exceeds(&place.run(command), "output-size");
        assert_eq!(programs(&place), [0; 0]);
    }
    let place = place();
    assert_eq!(place.run("view 1202.1P.dxf -o v.svg").status, Some(0));
    assert!(place.read("v.svg").len() < 100_000);
}

/// A line that could not be read back is not written.
#[test]
fn the_lines_of_a_program_are_limited() {
    // `rest` is the two brackets, and the word before the comment's text.
    let rest = "(Q:)".len();
    for (length, is_right) in [(65_536 - rest, true), (65_537 - rest, false)] {
        let drawn = format!(
            "layer 1202.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0 \"Q{}\"\nend 40,0",
            "x".repeat(length)
        );
        let place = place("text-length = 100_000", "T5 O2 I1 B0 MX")
            .file("1202.1P.dxf", sheet(&drawn).unwrap().to_dxf());
        let run = place.run("emit 1202.1P.dxf");
        assert_eq!(
            (run.status, run.stderr.contains("PB005")),
            (Some(i32::from(!is_right)), !is_right),
            "{length}: {run}"
        );
        assert_eq!(programs(&place).len(), usize::from(is_right));
        let refused = place.run("emit 1202.1P.dxf --post fanuc");
        assert!(is_right || refused.stderr.contains("PB763"), "{refused}");
    }
}

/// Ignore rules take much memory, so all files together are limited to 16 times the limit of a single file.
#[test]
fn ignore_files_are_limited_together() {
    let rules = "*a*b*c*d\n".repeat(100);
    for (count, is_right) in [(16, true), (17, false)] {
        let place = place(&format!("ignore-file-size = {}", rules.len()), "T5 O2 I1 B0 MX");
        let place = (0..count).fold(place, |place, index| place.file(&format!("{index}/.gitignore"), &rules));
        for options in ["", "-j 1", "--no-cache"] {
            let run = place.run(&format!("check . {options}"));
            assert_eq!(
                (run.status, run.stderr.contains("PB005")),
                (Some(i32::from(!is_right)), !is_right),
                "{run}"
            );
        }
    }
}

/// For a thousand faults in one text, the text is not stored a thousand times.
#[test]
fn faults_of_a_long_text_take_no_square_of_it() {
    let words = "X ".repeat(20_000);
    let drawing = format!(
        "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n1202.1P\n6\nPHANTOM\n10\n0\n20\n0\n40\n0.5\n\
         0\nTEXT\n8\n1202.1P\n10\n0\n20\n0\n40\n1\n1\nT5 O2 {words}\n0\nENDSEC\n0\nEOF\n"
    );
    let place = Place::new().file("1202.1P.dxf", drawing);
    let begun = Instant::now();
    let run = place.run("check 1202.1P.dxf --format json");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
    assert!(run.stdout.lines().all(|line| line.len() < 20_000));
}

/// `entities` also limits the entities visited in blocks, to 16 for each entity of the limit. Here, each of 40 blocks is inserted in the next one
/// and, from the outermost on, also directly: finding their content and then placing it visits 40 + 39 + ... + 1 insertions, twice.
#[test]
fn what_is_looked_at_in_blocks_is_limited() {
    const DEPTH: usize = 40;
    let steps = DEPTH * (DEPTH + 1);
    let insert = |block: usize| format!("0\nINSERT\n8\n1202.1P\n2\nB{block}\n10\n0\n20\n0\n");
    let block = |number: usize| {
        let inside = number.checked_sub(1).map_or_else(|| line((0.0, 0.0), (40.0, 0.0)), insert);
        format!("0\nBLOCK\n8\n0\n2\nB{number}\n10\n0\n20\n0\n{inside}0\nENDBLK\n")
    };
    let blocks: String = (0..DEPTH).map(block).collect();
    let inserted: String = (0..DEPTH).rev().map(insert).collect();
    let drawing = format!("0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n{}", entities(&inserted, (40.0, 0.0)));
    let check = |most: usize| {
        let limits = format!("entities = {most}");
        place(&limits, "T5 O2 I1 B0 MX").file("1202.1P.dxf", &drawing).run("check 1202.1P.dxf")
    };
    let most = steps.div_ceil(16);
    assert!(!check(most).stderr.contains("PB005"), "{}", check(most));
    assert_exceeds(&check(most - 1), "entities");
}

/// `verify-pieces` limits the number of pieces into which arcs and ramps are divided.
#[test]
fn arcs_that_are_followed_are_limited() {
    let circles = "G2 X0 Y0 I50 J0\n".repeat(4);
    let program = format!("G17 G21 G90\nF500\nG0 Z20\nG0 X0 Y0\nG1 Z-1\n{circles}G0 Z20\nM30\n");
    let verify = |most: u64| {
        let place = Place::new()
            .file("pathbuild.toml", format!("[limits]\nverify-pieces = {most}\n"))
            .file("a.gcode", &program);
        place.run("verify a.gcode --cutter 2 --surface 0 --dialect linuxcnc --require rapids")
    };
    let asked = verify(1);
    assert_exceeds(&asked, "verify-pieces");
    let (_, rest) = asked.stderr.split_once("divided into ").unwrap();
    let count: u64 = rest.split(' ').next().unwrap().parse().unwrap();
    assert!(!verify(count).stderr.contains("PB005"), "{}", verify(count));
    assert_exceeds(&verify(count - 1), "verify-pieces");
}
