//! The machine executes the number before a formula, and both must agree. (book: language/probes, program/reading)

use regex::Regex;

use super::{PLATE, PROBES, drawing, measure, succeed, write};
use crate::support::{Place, Run};

const VALUES: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\n";

/// Creates a place with a program with probes that has been emitted, measured and adjusted.
fn adjusted(configuration: &str) -> Place {
    let place = Place::new()
        .file("a.dxf", drawing(&format!("{PLATE}{PROBES}")))
        .file("pathbuild.toml", format!("{VALUES}{configuration}"));
    succeed(&place.run("emit a.dxf"));
    measure(&place, |x, y| 0.5 * x / 300.0 - 0.3 * y / 200.0);
    succeed(&place.run("adjust a.dxf --max-correction 1"));
    place
}

fn verify(place: &Place, program: &str) -> [Run; 2] {
    [place.run(&format!("verify {program}")), place.run(&format!("verify {program} --against a.dxf"))]
}

fn line_of(text: &str, part: &str) -> usize {
    text.lines().position(|line| line.contains(part)).unwrap_or_else(|| panic!("no {part}"))
}

fn with_line(text: &str, number: usize, change: impl Fn(&str) -> String) -> String {
    let line = |(index, line): (usize, &str)| if index == number { change(line) } else { line.to_owned() };
    text.lines().enumerate().map(line).collect::<Vec<_>>().join("\n") + "\n"
}

fn number_changed(line: &str, by: f64) -> String {
    let (before, formula) = line.split_once("(=").unwrap();
    let (words, number) = before.rsplit_once('Z').unwrap();
    format!("{words}Z{:.3}(={formula}", number.parse::<f64>().unwrap() + by)
}

fn without_formulas(text: &str) -> String {
    let line = |line: &str| line.split_once("(=").map_or(line, |(before, _)| before).to_owned();
    text.lines().map(line).collect::<Vec<_>>().join("\n") + "\n"
}

#[test]
fn sound_programs_have_no_finding() {
    for configuration in ["", "z-model = \"plane\"\n", "z-model = \"tin\"\n", "compatible = true\n"] {
        let place = adjusted(configuration);
        assert!(place.read("a_Milling.gcode").contains(" X0.000 Y180.000 Z4.700)"), "{configuration}");
        for program in ["a_Clean.gcode", "a_Milling.gcode", "a_Probing.gcode"] {
            for run in verify(&place, program) {
                // The heights of a_Clean.gcode are still to be corrected.
                let is_clean = program == "a_Clean.gcode";
                let warnings = format!("errors: 0, warnings: {}", u32::from(is_clean));
                assert!(run.stderr.contains(&warnings), "{configuration}: {run}");
                assert_eq!(run.stderr.contains("warning[PB769]"), is_clean, "{configuration}: {run}");
            }
        }
        succeed(&place.run("emit a.dxf --check"));
    }
}

#[test]
fn every_changed_height_or_formula_of_an_adjusted_program_is_an_error() {
    let place = adjusted("");
    let good = place.read("a_Milling.gcode");
    let cut = line_of(&good, "G01 F");
    let probe = line_of(&good, "(Probe #55:");
    let changed_numbers: String = good
        .lines()
        .map(|line| match line.split_once("(==") {
            Some((before, formula)) => {
                let (words, _) = before.rsplit_once('Z').unwrap();
                format!("{words}Z-2.000(=={formula}\n")
            }
            None => format!("{line}\n"),
        })
        .collect();
    let changes = [
        ("every number", changed_numbers, "PB775"),
        ("one number", with_line(&good, cut, |line| number_changed(line, -0.002)), "PB775"),
        ("a coefficient", with_line(&good, cut, |line| line.replace("+0.", "+1.")), "PB775"),
        (
            "the drawn height in a formula",
            with_line(&good, cut, |line| line.replace("-5.000]", "-9.000]")),
            "PB775",
        ),
        ("a measured height", with_line(&good, probe, |line| line.replace(" Z", " Z1")), "PB775"),
        (
            "no measured height",
            with_line(&good, probe, |line| format!("{})", line.rsplit_once(' ').unwrap().0)),
            "PB776",
        ),
        ("no probe", with_line(&good, probe, |_| String::new()), "PB776"),
        ("one formula not worked out", with_line(&good, cut, |line| line.replace("(==", "(=")), "PB776"),
        (
            "one formula less",
            with_line(&good, cut, |line| line.split('(').next().unwrap().to_owned()),
            "PB776",
        ),
        ("no formulas", without_formulas(&good), "PB776"),
    ];
    for (what, text, code) in changes {
        assert_ne!(text, good, "{what}");
        write(&place, "a_Milling.gcode", &text);
        for run in verify(&place, "a_Milling.gcode") {
            assert!(run.status == Some(1) && run.stderr.contains(&format!("error[{code}]")), "{what}: {run}");
        }
        let run = place.run("emit a.dxf --check");
        assert!(run.status == Some(1) && run.stderr.contains("PB520"), "{what}: {run}");
    }
    // A difference of less than one unit of the last digit is rounding.
    write(&place, "a_Milling.gcode", &with_line(&good, cut, |line| number_changed(line, 0.0004)));
    succeed(&place.run("verify a_Milling.gcode"));
}

#[test]
fn consistent_changes_are_found_with_the_drawing() {
    let place = adjusted("");
    let good = place.read("a_Milling.gcode");
    // The line has another formula, and the number that this formula gives.
    let constant = with_line(&good, line_of(&good, "G01 F"), |line| {
        let (before, _) = line.split_once("(==").unwrap();
        let number = before.rsplit_once('Z').unwrap().1;
        format!("{before}(=={number})")
    });
    write(&place, "a_Milling.gcode", &constant);
    let run = place.run("verify a_Milling.gcode --against a.dxf");
    assert!(run.status == Some(1) && run.stderr.contains("error[PB775]"), "{run}");
    // A changed comment does not change moves, so it is a warning.
    for (from, to) in [
        ("native O3 T5)", "native O3 T5x)"),
        ("(Milling chain", "(Chain"),
        ("(Command count:", "(Commands:"),
        ("X150.000 Y-20.000 Z", "X150.000 Y-20.000 Z"),
    ] {
        let text = good.replacen(from, to, 1);
        write(&place, "a_Milling.gcode", &text);
        let run = place.run("verify a_Milling.gcode --against a.dxf");
        succeed(&run);
        assert_eq!(run.stderr.contains("PB777"), text != good, "{from}: {run}");
    }
}

#[test]
fn a_changed_clean_program_is_found_and_not_adjusted() {
    let place = adjusted("");
    let good = place.read("a_Clean.gcode");
    let cut = line_of(&good, "G01 F150.000 X");
    let changes = [
        ("no formulas", without_formulas(&good), true),
        ("one formula less", with_line(&good, cut, |line| line.split('(').next().unwrap().to_owned()), true),
        ("a coefficient", with_line(&good, cut, |line| line.replace("+0.", "+1.")), false),
        ("a number", with_line(&good, cut, |line| number_changed(line, 0.002)), true),
        ("a line less", with_line(&good, cut, |_| String::new()), false),
        ("a feed", with_line(&good, cut, |line| line.replace("F150", "F950")), false),
        ("a Y", with_line(&good, cut, |line| line.replace(" Y", " Y1")), false),
    ];
    for (what, text, is_found_alone) in changes {
        assert_ne!(text, good, "{what}");
        write(&place, "a_Clean.gcode", &text);
        let [alone, against] = verify(&place, "a_Clean.gcode");
        assert_eq!(alone.status, Some(i32::from(is_found_alone)), "{what}: {alone}");
        assert_eq!(against.status, Some(1), "{what}: {against}");
        let before = place.read("a_Milling.gcode");
        let run = place.run("adjust a.dxf --max-correction 1");
        assert!(run.status == Some(1) && run.stderr.contains("error[PB608]"), "{what}: {run}");
        assert_eq!(place.read("a_Milling.gcode"), before);
    }
    // Comments, spaces and line ends have no effect.
    let other = good.replace("(Milling chain", "(Chain").replace('\n', "\r\n");
    write(&place, "a_Clean.gcode", &other);
    succeed(&place.run("adjust a.dxf --max-correction 1"));
}

#[test]
fn probes_without_formulas_are_an_error_without_the_drawing_too() {
    let place = adjusted("");
    write(&place, "a_Clean.gcode", &without_formulas(&place.read("a_Clean.gcode")));
    std::fs::remove_file(place.path().join("a.dxf")).unwrap();
    let run = place.run("adjust a_Clean.gcode --max-correction 1");
    assert!(run.status == Some(1) && run.stderr.contains("error[PB609]"), "{run}");
}

#[test]
fn a_height_without_its_formula_is_an_error_without_the_drawing_too() {
    let place = adjusted("");
    std::fs::remove_file(place.path().join("a.dxf")).unwrap();
    succeed(&place.run("adjust a_Clean.gcode --max-correction 1"));
    let good = place.read("a_Clean.gcode");
    let line = good.lines().find(|line| line.starts_with("G01") && line.contains("(=")).unwrap();
    let without_number = Regex::new(r"Z[-.0-9]+\(=").unwrap().replace(line, "Z(=").into_owned();
    for other in [without_formulas(line), without_number] {
        assert_ne!(other, line);
        write(&place, "a_Clean.gcode", &good.replace(line, &other));
        let run = place.run("adjust a_Clean.gcode --max-correction 1");
        assert!(run.status == Some(1) && run.stderr.contains("error[PB7"), "{run}");
    }
}

/// The four nearest probes correct a height; a fifth one that is never among them is measured in vain.
#[test]
fn a_probe_that_corrects_nothing_is_told_when_the_program_is_written() {
    let text = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B1\"\nmill 0,0 40,0\nend 40,0\nprobe 0,10\nprobe 40,10\nprobe 0,20\nprobe 40,20\n";
    let run = |far: &str, configuration: &str| {
        let place = Place::new()
            .file("a.dxf", drawing(&format!("{text}{far}")))
            .file("pathbuild.toml", format!("{VALUES}{configuration}"));
        let run = place.run("emit a.dxf");
        succeed(&run);
        run.stderr.contains("warning[PB609]")
    };
    assert!(!run("", "") && !run("probe 20,10\n", ""));
    assert!(run("probe 20,200\n", ""));
    assert!(!run("probe 20,200\n", "z-model = \"plane\"\n"));
}

#[test]
fn a_changed_probing_run_is_found() {
    let place = adjusted("");
    let good = place.read("a_Probing.gcode");
    for (from, to) in [
        ("G38.2 Z0", "G38.2 Z-9"),
        ("G04 P4\n", ""),
        ("G00 X150.000", "G00 X151.000"),
        ("F150.000", "F950.000"),
        ("G38.2 Z0", "G38.3 Z0"),
        ("G38.2 Z0", "G38.4 Z0"),
        ("G38.2 Z0", "G01 Z0"),
    ] {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good, "{from}");
        write(&place, "a_Probing.gcode", &text);
        let run = place.run("verify a_Probing.gcode --against a.dxf");
        assert!(run.status == Some(1) && run.stderr.contains("error[PB739]"), "{from}: {run}");
    }
}

/// The sheet is 5 mm thick, and the drawing need not be at hand.
#[test]
fn heights_of_a_probing_program_are_checked_without_the_drawing_too() {
    let place = adjusted("");
    let good = place.read("a_Probing.gcode");
    let descent = Regex::new(r"G00 Z[0-9.]+\nG38").unwrap().find(&good).unwrap().as_str().to_owned();
    let probe = |changed: &str| {
        write(&place, "x.gcode", changed);
        place.run("verify x.gcode")
    };
    for (from, to, code) in [
        (descent.as_str(), "G00 Z4.900\nG38", "error[PB741]"),
        ("G04 P4\nG00 Z20.000\n", "G04 P4\nG00 Z4.900\n", "error[PB74"),
        ("G38.2 Z0", "G38.2 Z-0.6", "warning[PB777]"),
    ] {
        let changed = good.replacen(from, to, 1);
        assert_ne!(changed, good, "{from}");
        let run = probe(&changed);
        assert!(run.stderr.contains(code), "{from}: {run}");
    }
    write(&place, "x.gcode", &good.replacen(&descent, "G00 Z4.900\nG38", 1));
    let refused = place.run("post x.gcode --post linuxcnc -o x.ngc");
    assert!(refused.status == Some(1) && refused.stderr.contains("PB741"), "{refused}");
    for (from, to) in [(descent.as_str(), "G00 Z5.000\nG38"), ("G38.2 Z0", "G38.2 Z-0.5")] {
        let run = probe(&good.replacen(from, to, 1));
        assert!(run.stderr.contains("errors: 0, warnings: 0"), "{to}: {run}");
    }
}

/// A move that does not stop at the touch plate, in place of one or of all probing moves.
#[test]
fn a_missing_probe_is_found_without_the_drawing_too() {
    let place = adjusted("");
    write(&place, "1234.gcode", &place.read("a_Probing.gcode"));
    succeed(&place.run("post 1234.gcode --post fanuc -o fanuc.nc"));
    for (file, probe, others) in [
        ("a_Probing.gcode", "G38.2 Z0", ["G01 Z0", "G38.4 Z0", "(no move)"]),
        ("fanuc.nc", "G31", ["G1", "G0", "(NO MOVE)"]),
    ] {
        let good = place.read(file);
        let count = good.matches(probe).count();
        for (other, times) in others.into_iter().flat_map(|other| [(other, 1), (other, count)]) {
            write(&place, "x.gcode", &good.replacen(probe, other, times));
            for options in ["", "--against a.dxf"] {
                let run = place.run(&format!("verify x.gcode {options}"));
                assert_eq!(run.status, Some(1), "{run}");
                assert_eq!(run.stderr.matches("error[PB777]").count(), times, "{run}");
                // Nothing is said about the spindle or the dwell of the probe, which follows from that.
                assert!(!run.stderr.contains("PB745") && !run.stderr.contains("G4 is not"), "{run}");
            }
        }
    }
}

#[test]
fn a_converted_probing_program_is_compared_with_the_drawing() {
    let place = adjusted("");
    write(&place, "1234.gcode", &place.read("a_Probing.gcode"));
    for post in ["linuxcnc", "grbl", "mach3", "marlin", "fanuc", "haas"] {
        succeed(&place.run(&format!("post 1234.gcode --post {post} -o x.nc")));
        let good = place.read("x.nc");
        for options in ["", "--against a.dxf"] {
            let run = place.run(&format!("verify x.nc {options} --dialect {post}"));
            assert!(run.stderr.contains("errors: 0, warnings: 0"), "{run}");
            assert!(!run.stderr.contains("unknown positions"), "{run}");
        }
        let lenient = good.contains("G38.2").then_some(("G38.2", "G38.3"));
        for (from, to) in
            [("Z0.0", "Z-3.0"), ("X150.0", "X151.0"), ("F150.0", "F950.0")].into_iter().chain(lenient)
        {
            let changed = good.replacen(from, to, 1);
            assert_ne!(changed, good, "{from}");
            write(&place, "x.nc", &changed);
            let run = place.run(&format!("verify x.nc --against a.dxf --dialect {post}"));
            assert!(run.stderr.contains("error[PB739]"), "{run}");
        }
    }
}

/// The output of a definition of the user's own is compared as text with what the definition writes, which is a milling program.
#[test]
fn a_probing_program_of_an_own_definition_is_not_compared() {
    let place = adjusted("");
    write(&place, "own.cbpp", &place.run("post show grbl").stdout);
    succeed(&place.run("post a_Probing.gcode --post own.cbpp -o x.nc"));
    let run = place.run("verify x.nc --against a.dxf --post own.cbpp");
    assert!(
        run.stderr.contains("error[PB739]") && run.stderr.contains("a definition of your own wrote it"),
        "{run}"
    );
    assert!(run.stderr.contains("errors: 1, warnings: 0"), "{run}");
    let native = place.run("verify a_Probing.gcode --against a.dxf --post own.cbpp --dialect native");
    assert!(native.stderr.contains("errors: 0, warnings: 0"), "{native}");
}

#[test]
fn formulas_in_a_program_without_probes_are_an_error() {
    let place = Place::new().file("a.dxf", drawing(PLATE)).file("pathbuild.toml", VALUES);
    succeed(&place.run("emit a.dxf"));
    let good = place.read("a_Milling.gcode");
    let line = |line: &str| match line.rsplit_once(" Z") {
        Some((words, height)) if line.starts_with("G01") => format!("{words} Z-9.000(=={height})\n"),
        _ => format!("{line}\n"),
    };
    write(&place, "a_Milling.gcode", &good.lines().map(line).collect::<String>());
    for run in verify(&place, "a_Milling.gcode") {
        assert!(run.status == Some(1) && run.stderr.contains("error[PB776]"), "{run}");
    }
}

/// Every command that reads a program reports the difference.
#[test]
fn other_commands_tell_of_a_formula_that_lies() {
    let place = adjusted("");
    let good = place.read("a_Milling.gcode");
    let bad = with_line(&good, line_of(&good, "G01 F"), |line| number_changed(line, -3.0));
    let place = place.file("b_Milling.gcode", bad);
    for command in [
        "import b_Milling.gcode",
        "view b_Milling.gcode -o b.svg",
        "post b_Milling.gcode --post grbl -o b.nc",
        "diff a_Milling.gcode b_Milling.gcode",
    ] {
        let run = place.run(command);
        assert!(run.stderr.contains("PB775"), "{command}: {run}");
    }
}

/// A native program always contains T1, regardless of the cutter's number in the tool table.
#[test]
fn the_headers_cutter_decides() {
    let text = "layer 1234.1P\nstart 0,0 \"T2 O2 I5 B0\"\nmill 0,0 40,0\nmill 40,0 40,10\nend 40,10\n";
    let place = |diameter: &str| {
        let tool = format!("{VALUES}[tool.a]\nnumber = 1\ndiameter = {diameter}\n");
        let place = Place::new().file("a.dxf", drawing(text)).file("pathbuild.toml", tool);
        succeed(&place.run("emit a.dxf"));
        place
    };
    for (diameter, is_told) in [("12", true), ("0.5", true), ("2", false)] {
        let place = place(diameter);
        let run = place.run("verify a_Milling.gcode");
        succeed(&run);
        assert_eq!(run.stderr.contains("warning[PB777]"), is_told, "{diameter}: {run}");
        // The rapid move is 3 mm beside the groove of the 2 mm cutter.
        let good = place.read("a_Milling.gcode");
        let lines: Vec<&str> = good.lines().collect();
        let end = lines.iter().rposition(|line| line.starts_with("G00 Z")).unwrap() - 1;
        let bad = with_line(&good, end, |line| format!("G00 X37.000 Y10.000\n{line}"));
        write(&place, "a_Milling.gcode", &bad);
        let run = place.run("verify a_Milling.gcode");
        assert!(run.status == Some(1) && run.stderr.contains("error[PB740]"), "{diameter}: {run}");
    }
    let place = place("2");
    let text = place.read("a_Milling.gcode").replace("native O2", "native O3");
    write(&place, "a_Milling.gcode", &text);
    let run = place.run("verify a_Milling.gcode --against a.dxf");
    assert!(run.status == Some(1) && run.stderr.contains("error[PB777]"), "{run}");
    let run = place.run("verify a_Milling.gcode --cutter 2");
    assert!(run.status == Some(0) && run.stderr.contains("warning[PB777]"), "{run}");
}

#[test]
fn statistics_are_held_against_the_moves() {
    for lang in ["en", "de"] {
        let configuration = format!("{VALUES}comment-lang = \"{lang}\"\n");
        let place = Place::new().file("a.dxf", drawing(PLATE)).file("pathbuild.toml", configuration);
        succeed(&place.run("emit a.dxf"));
        let good = place.read("a_Milling.gcode");
        let run = place.run("verify a_Milling.gcode");
        assert!(run.stderr.contains("errors: 0, warnings: 0"), "{run}");
        let (line, text) = good.lines().enumerate().find(|(_, line)| line.contains(" mm   ca.")).unwrap();
        let length: f64 = text.split(':').nth(1).unwrap().trim().split(' ').next().unwrap().parse().unwrap();
        for (by, is_told) in [(10.0, false), (20.0, true)] {
            let stated = |line: &str| line.replace(&format!("{length}"), &format!("{}", length + by));
            write(&place, "a_Milling.gcode", &with_line(&good, line, stated));
            let run = place.run("verify a_Milling.gcode");
            assert_eq!((run.status, run.stderr.contains("warning[PB777]")), (Some(0), is_told), "{run}");
        }
    }
}

#[test]
fn a_native_program_names_neither_a_speed_nor_places_of_the_machine() {
    let place = Place::new().file("a.dxf", drawing(PLATE)).file("pathbuild.toml", VALUES);
    succeed(&place.run("emit a.dxf"));
    let good = place.read("a_Milling.gcode");
    let (start, cut) = (line_of(&good, "G00 Z"), line_of(&good, "G01 F"));
    for (line, word) in [(cut, "S0"), (start, "G28"), (start, "G30"), (start, "G53 G00 Z0")] {
        write(&place, "a_Milling.gcode", &with_line(&good, line, |line| format!("{word}\n{line}")));
        let run = place.run("verify a_Milling.gcode --against a.dxf");
        assert_eq!(run.status, Some(1), "{word}: {run}");
    }
}

#[test]
fn verify_finds_heights_of_a_corrected_program_in_the_material_and_in_the_plate() {
    let place = adjusted("");
    let good = place.read("a_Milling.gcode");
    let measured = |height: &str| good.replace("Z20.000\n", &format!("Z{height}\n"));
    let highest =
        good.lines().filter_map(|line| line.strip_prefix("(Probe ")?.rsplit_once(" Z")).map(|(_, z)| z);
    let highest = highest.map(|z| z.trim_end_matches(')').parse::<f64>().unwrap()).fold(0.0, f64::max);
    let cases = [(highest + 0.001, false), (highest, true)];
    for (height, is_found) in cases {
        write(&place, "edited.gcode", &measured(&format!("{height:.3}")));
        let run = place.run("verify edited.gcode");
        assert_eq!(run.stderr.contains("error[PB602]"), is_found, "{run}");
    }
    measure(&place, |_, _| -1.0);
    succeed(&place.run("adjust a.dxf --max-correction 1"));
    for (limit, is_found) in [("0.51", false), ("0.49", true)] {
        write(&place, "pathbuild.toml", &format!("{VALUES}[warnings]\nbelow-plate = {limit}\n"));
        for run in verify(&place, "a_Milling.gcode") {
            assert_eq!(run.stderr.contains("warning[PB602]"), is_found, "{limit}: {run}");
        }
    }
}
