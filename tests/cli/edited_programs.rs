//! Tests what `verify` finds without a drawing in programs of pathbuild that were edited afterwards. (book: program/reading)

use crate::support::{Place, dxf};

/// A groove and a hole through material of `thickness`, for a cutter of O mm.
fn path(name: &str, cutter: u32, thickness: u32) -> Vec<u8> {
    let y = 4 * thickness;
    dxf(&format!(
        "layer {name}\nstart 0,0 \"T{thickness} O{cutter} I0.5 F150 B-0.2\"\nsweep 0,0 10,{y}\nmill 10,{y} 30,{y} \"B1\"\n\
         sweep 30,{y} 40,20\ncircle 40,20 d {cutter}\nsweep 40,20 50,20\nend 50,20\n"
    ))
}

/// A library whose paths need tool 1 (2 mm) or tool 2 (1 mm).
fn library() -> Place {
    Place::new()
        .file(
            "pathbuild.toml",
            "rapid = 1000\nsweep-height = 10\n[tool.2mm]\nnumber = 1\ndiameter = 2\nspindle = 12000\n\
             [tool.1mm]\nnumber = 2\ndiameter = 1\nspindle = 12000\n",
        )
        .file("1234.1P.dxf", path("1234.1P", 2, 2))
        .file("1300.1P.dxf", path("1300.1P", 1, 2))
        .file("1400.1P.dxf", path("1400.1P", 2, 5))
}

/// Emits paths and returns the program.
#[track_caller]
fn emitted(arguments: &str, file: &str) -> String {
    let place = library();
    let run = place.run(&format!("emit {arguments}"));
    assert_eq!(run.status, Some(0), "{run}");
    place.read(file)
}

/// Returns the findings of `verify` about a program, as `line:code`, without and with the configuration beside it.
fn found(program: &str, file: &str) -> [Vec<String>; 2] {
    let codes = |place: Place| {
        let run = place.file(file, program).run(&format!("verify {file} --format concise"));
        let finding = |line: &str| {
            let (place, text) = line.split_once(": ")?;
            let code = text.split(['[', ']']).nth(1)?;
            Some(format!("{}:{code}", place.split(':').nth(1)?))
        };
        run.stderr.lines().filter_map(finding).collect()
    };
    [codes(Place::new()), codes(library())]
}

#[track_caller]
fn assert_found(program: &str, file: &str, expected: &[&str]) {
    for found in found(program, file) {
        assert_eq!(found, expected, "{file}\n{program}");
    }
}

/// Returns the number of the last line that begins with a text.
fn last_line(program: &str, beginning: &str) -> usize {
    program.lines().count() - program.lines().rev().position(|line| line.starts_with(beginning)).unwrap()
}

fn without_line(program: &str, number: usize) -> String {
    let mut lines: Vec<&str> = program.split_inclusive('\n').collect();
    lines.remove(number - 1);
    lines.concat()
}

#[test]
fn a_tool_change_that_was_removed_is_found() {
    for (post, extension) in [("grbl", "gcode"), ("linuxcnc", "ngc"), ("mach3", "tap")] {
        let file = format!("both_Milling.{extension}");
        let program = emitted(&format!("1234.1P 1300.1P --join both --post {post}"), &file);
        assert_found(&program, &file, &[]);
        // GRBL stops for the operator, the others have M6.
        let unchanged = match post {
            "grbl" => without_line(&program, last_line(&program, "M0")),
            _ => program.replace(" M6", "").replace("M6\n", ""),
        };
        let at = format!("{}:PB777", last_line(&unchanged, "T2"));
        assert_found(&unchanged, &file, &[&at]);
        // The head lists T2.
        let unselected = without_line(&unchanged, last_line(&unchanged, "T2"));
        let listed = (1..).zip(unselected.lines()).find(|(_, line)| line.starts_with("(T2: ")).unwrap().0;
        let found = found(&unselected, &file);
        assert!(
            found.iter().all(|found| found.contains(&format!("{listed}:PB777"))),
            "{found:?}\n{unselected}"
        );
    }
}

#[test]
fn programs_put_together_by_hand_are_compared() {
    let program = |path: &str| emitted(&format!("{path} --post grbl"), &format!("{path}_Milling.gcode"));
    let [thin, other, thick] = ["1234.1P", "1300.1P", "1400.1P"].map(program);
    let joined = |first: &str, second: &str| format!("{}{second}", first.replace("M30\n", ""));
    assert_found(&joined(&thin, &thin), "a.gcode", &[]);
    let both = joined(&thick, &thin);
    let header = format!("{}:PB780", last_line(&both, "(pathbuild "));
    for found in found(&both, "a.gcode") {
        assert!(found.contains(&header) && found.iter().any(|code| code.ends_with("PB741")), "{found:?}");
    }
    let both = joined(&thin, &thick);
    for found in found(&both, "a.gcode") {
        assert!(found.iter().any(|code| code.ends_with("PB780")), "{found:?}");
    }
    // Another tool needs a stop.
    let both = joined(&thin, &other);
    assert_found(&both, "a.gcode", &[&format!("{}:PB777", last_line(&both, "T2"))]);
    let stopped = both.replacen("\nT2\n", "\nM0\nT2\n", 1);
    assert_found(&stopped, "a.gcode", &[]);
}

#[test]
fn cuts_deep_below_the_plate_and_inches_are_doubtful() {
    for (post, extension) in [("grbl", "gcode"), ("linuxcnc", "ngc"), ("native", "gcode")] {
        let file = format!("1234.1P_Milling.{extension}");
        let program = emitted(&format!("1234.1P --post {post}"), &file);
        assert_found(&program, &file, &[]);
        let digits = if post == "native" { "00" } else { "" };
        let (before, after) = program.rsplit_once(&format!("Z-0.2{digits}")).unwrap();
        let deeper = |z: &str| format!("{before}Z{z}{digits}{after}");
        assert_found(&deeper("-0.5"), &file, &[]);
        for z in ["-0.6", "-2.0", "-20.0"] {
            let program = deeper(z);
            let number = before.lines().count();
            let codes = found(&program, &file);
            let at = format!("{number}:PB777");
            assert!(codes.iter().all(|codes| codes.contains(&at)), "{post} {z}: {codes:?}\n{program}");
        }
        let inches = program.replacen("G21", "G20", 1);
        let number = inches.lines().position(|line| line.contains("G20")).unwrap() + 1;
        let codes = found(&inches, &file);
        let at = format!("{number}:PB777");
        assert!(codes.iter().all(|codes| codes.contains(&at)), "{post}: {codes:?}");
        // Other programs have Z 0 wherever they like.
        let foreign = |program: &str| program.replace("(pathbuild ", "(").replace("native", "");
        if post != "native" {
            assert_found(&foreign(&deeper("-20.0")), &file, &[]);
        }
    }
}

#[test]
fn the_limit_below_the_plate_is_that_of_the_configuration() {
    let program = emitted("1234.1P --post grbl", "1234.1P_Milling.gcode").replacen("Z-0.2", "Z-0.8", 1);
    let verify = |limit: f64| {
        let place = Place::new()
            .file("a.gcode", &program)
            .file("pathbuild.toml", format!("[warnings]\nbelow-plate = {limit}\n"));
        place.run("verify a.gcode --format concise").stderr.contains("PB777")
    };
    assert!(verify(0.79) && !verify(0.8));
}

#[test]
fn heights_that_are_still_to_be_corrected_are_told() {
    let text = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 F150 B1\"\nmill 0,0 40,0\nend 40,0\nprobe 0,10\nprobe 40,10\nprobe 20,20\n";
    let place = Place::new()
        .file("pathbuild.toml", "rapid = 1000\nsweep-height = 20\n")
        .file("1234.1P.dxf", dxf(text));
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let verify = |file: &str| {
        let run = place.run(&format!("verify {file} --format concise"));
        (run.status, run.stderr.contains("warning[PB769]"), run)
    };
    let (status, is_told, run) = verify("1234.1P_Clean.gcode");
    assert!(status == Some(0) && is_told, "{run}");
    let (_, is_told, run) = verify("1234.1P_Clean.gcode --against 1234.1P");
    assert!(is_told, "{run}");
    let values = place.read("1234.1P_Z.txt").replace('=', "=5.1").replace("T=5.1", "T=");
    let place = place.file("1234.1P_Z.txt", values);
    let run = place.run("adjust 1234.1P --max-correction 0.5");
    assert_eq!(run.status, Some(0), "{run}");
    for file in ["1234.1P_Milling.gcode", "1234.1P_Probing.gcode"] {
        let run = place.run(&format!("verify {file} --format concise"));
        assert!(!run.stderr.contains("PB769"), "{run}");
    }
}

/// The edits are lost, so `emit` says so once.
#[test]
fn writing_over_an_edited_program_is_told() {
    for (post, extension) in [("grbl", "gcode"), ("native", "gcode"), ("estlcam", "nc")] {
        let file = format!("1234.1P_Milling.{extension}");
        let place = library();
        let emit = |place: &Place, options: &str| {
            let run = place.run(&format!("emit 1234.1P --post {post} {options}"));
            assert_eq!(run.status, Some(0), "{run}");
            run.stderr.lines().find(|line| line.starts_with(&file)).map(str::to_owned).unwrap_or_default()
        };
        assert!(emit(&place, "").starts_with(&format!("{file}: written, ")), "{post}");
        let program = place.read(&file);
        let edited = program.replacen("Y20.0", "Y21.0", 1);
        assert_ne!(edited, program);
        let place = place.file(&file, &edited);
        let line = emit(&place, "");
        assert!(line.starts_with(&format!("{file}: written over an edited file (")), "{line}");
        assert!(emit(&place, "").starts_with(&format!("{file}: unchanged, ")), "{post}");
        let place = place.file(&file, &edited);
        let line = emit(&place, "--lang de");
        assert!(line.starts_with(&format!("{file}: über eine bearbeitete Datei geschrieben (")), "{line}");
        // Other comments are no edit that changes a move, and another drawing makes another program.
        let place = place.file(&file, program.replacen("(Path", "(PATH", 1));
        assert!(emit(&place, "").starts_with(&format!("{file}: written, ")), "{post}");
        let place = place.file("1234.1P.dxf", path("1234.1P", 2, 3));
        assert!(emit(&place, "").starts_with(&format!("{file}: written, ")), "{post}");
    }
}

/// After a tool change by hand, only the operator knows where the tool is.
#[test]
fn a_move_in_the_plane_after_a_tool_change_needs_a_height() {
    for (post, change) in [("marlin", "M0 Insert T2"), ("grbl", "M0")] {
        let place = library();
        let run = place.run(&format!("emit 1234.1P 1300.1P --join both --post {post} --out-dir g"));
        assert_eq!(run.status, Some(0), "{run}");
        let file = std::fs::read_dir(place.path().join("g")).unwrap().next().unwrap().unwrap().file_name();
        let file = format!("g/{}", file.to_str().unwrap());
        let program = place.read(&file);
        let at = program.find(change).unwrap();
        let (before, after) = program.split_at(at);
        let lift = after.lines().find(|line| line.contains("Z10.")).unwrap();
        let unraised = format!("{before}{}", after.replacen(&format!("{lift}\n"), "", 1));
        let place = place.file("x.nc", program).file("y.nc", unraised);
        for (name, is_found) in [("x.nc", false), ("y.nc", true)] {
            let run = place.run(&format!("verify {name}"));
            assert_eq!(run.stderr.contains("warning[PB742]"), is_found, "{post}: {run}");
        }
    }
}

/// Notepad's "Unicode" is UTF-16, and its "UTF-8 with BOM" has three bytes before the first line.
#[test]
fn the_encoding_of_an_editor_is_named() {
    let place = library();
    assert_eq!(place.run("emit 1234.1P --post linuxcnc").status, Some(0));
    let program = place.read("1234.1P_Milling.ngc");
    let little: Vec<u8> = program.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = program.encode_utf16().flat_map(u16::to_be_bytes).collect();
    let place = place
        .file("marked.ngc", [&[0xFF, 0xFE], &*little].concat())
        .file("1234.1P_Clean.gcode", [&[0xFF, 0xFE], &*little].concat())
        .file("1234.1P_Z.txt", "")
        .file("little.ngc", little)
        .file("big.ngc", big)
        .file("bom.ngc", format!("\u{feff}{program}"));
    for command in [
        "verify marked.ngc",
        "verify little.ngc --against 1234.1P",
        "verify big.ngc --against 1234.1P",
        "post marked.ngc --post grbl",
        "diff marked.ngc 1234.1P_Milling.ngc",
        "view little.ngc -o page.html",
        "adjust 1234.1P --max-correction 1",
    ] {
        let run = place.run(command);
        assert!(run.status != Some(0) && run.stderr.contains("this file is in UTF-16"), "{run}");
        assert!(run.stderr.matches("PB").count() == 1 && !run.stderr.contains("checked:"), "{run}");
    }
    for (command, status) in [("verify bom.ngc", 0), ("verify bom.ngc --against 1234.1P", 1)] {
        let run = place.run(command);
        assert_eq!(run.status, Some(status), "{run}");
        assert_eq!(
            [run.stderr.matches("[PB").count(), run.stderr.matches("[PB707]").count()],
            [1, 1],
            "{run}"
        );
    }
    let run = place.run("post bom.ngc --post linuxcnc -o again.ngc");
    assert!(run.status == Some(0) && !run.stderr.contains("PB707"), "{run}");
    assert_eq!(place.run("verify again.ngc --against 1234.1P").stderr.matches("[PB").count(), 0);
}
