//! Tests programs that are older than their drawing, which their provenance reveals. (book: program/gcode, book: language/probes)

use super::{OPTIONS, drawing, emit, measure, plate, succeed, write};
use crate::support::Place;

const WITHOUT: &str = r#"
layer 8001.1P
start 0,0 "T5 O2 I1 B1 F150 S10 Z50"
mill 0,0 40,0
end 40,0
"#;

fn with_probes(text: &str) -> String {
    format!("{text}probe 10,10\nprobe 30,10\n")
}

fn save(place: &Place, text: &str) {
    std::fs::write(place.path().join("a.dxf"), drawing(text)).unwrap();
}

/// Creates a place with a program with probes that has been emitted, measured and adjusted.
fn adjusted() -> Place {
    let place = Place::new().file("a.dxf", drawing(&with_probes(WITHOUT)));
    succeed(&emit(&place, "a.dxf"));
    measure(&place, |_, _| 0.1);
    succeed(&place.run("adjust a.dxf --max-correction 0.9"));
    place
}

#[track_caller]
fn names_milling(place: &Place, inputs: &str, is_stale: bool) {
    let run = emit(place, inputs);
    let is_told = run.stderr.contains("PB520") && run.stderr.contains("a_Milling.gcode");
    assert_eq!(is_told, is_stale, "{run}");
    let run = emit(place, &format!("{inputs} --check"));
    assert_eq!(run.stdout.contains("a_Milling.gcode: not current"), is_stale, "{run}");
    assert_eq!(run.status, Some(i32::from(is_stale)), "{run}");
    let run = place.run(&format!("list . {OPTIONS}"));
    let state = if is_stale { "program not current" } else { "program current" };
    assert!(run.stdout.contains(state), "{run}");
}

/// The heights without the corrections are not exact, and are compared as rounded.
#[test]
fn an_adjusted_program_is_that_of_its_drawing() {
    let place = Place::new().file("a.dxf", drawing(&with_probes(WITHOUT)));
    succeed(&emit(&place, "a.dxf"));
    measure(&place, |x, _| 0.0037 * x);
    succeed(&place.run("adjust a.dxf --max-correction 0.9"));
    // `diff` looks the path up by its name.
    let place = place.file("8001.1P.dxf", drawing(&with_probes(WITHOUT)));
    let run = place.run(&format!("diff a_Milling.gcode 8001.1P {OPTIONS}"));
    assert!(run.status == Some(0) && run.stdout.contains("0 of 1 path changed"), "{run}");
    let place = place.file("8001.1P.dxf", drawing(&with_probes(&WITHOUT.replace("S10", "S11"))));
    let run = place.run(&format!("diff a_Milling.gcode 8001.1P {OPTIONS}"));
    assert!(run.status == Some(0) && run.stdout.contains("other rapid moves"), "{run}");
    let run = place.run(&format!("diff a_Probing.gcode 8001.1P {OPTIONS}"));
    assert!(run.status == Some(1) && run.stderr.contains("the program only probes"), "{run}");
}

#[test]
fn an_uncorrected_program_from_before_the_probes_is_stale() {
    for inputs in ["a.dxf", "."] {
        let place = Place::new().file("a.dxf", drawing(WITHOUT));
        succeed(&emit(&place, "a.dxf"));
        save(&place, &with_probes(WITHOUT));
        names_milling(&place, inputs, true);
        let run = emit(&place, &format!("{inputs} --remove-stale"));
        assert!(run.stderr.contains("a_Milling.gcode: stale, removed"), "{run}");
        assert!(!place.path().join("a_Milling.gcode").exists());
        names_milling(&place, inputs, false);
    }
}

#[test]
fn an_adjusted_program_is_stale_once_its_drawing_gives_other_moves() {
    for inputs in ["a.dxf", "."] {
        let place = adjusted();
        names_milling(&place, inputs, false);
        save(&place, &with_probes(WITHOUT).replace("B1 ", "B0 "));
        names_milling(&place, inputs, true);
        succeed(&place.run("adjust a.dxf --max-correction 0.9"));
        names_milling(&place, inputs, false);
    }
}

/// The programs that `post` makes for the machine lie beside the native ones.
#[test]
fn programs_converted_from_current_ones_are_not_stale() {
    let place = adjusted().file("pathbuild.toml", "rapid = 1000\nfeed = 150\nspindle = \"manual\"\n");
    for kind in ["Milling", "Probing"] {
        succeed(&place.run(&format!("post a_{kind}.gcode --post linuxcnc -o a_{kind}.ngc")));
    }
    let check = || emit(&place, ". --check --format concise");
    assert_eq!(check().status, Some(0), "{}", check());
    succeed(&emit(&place, ". --remove-stale"));
    assert!(place.path().join("a_Milling.ngc").exists() && place.path().join("a_Probing.ngc").exists());
    // The converted program has the heights of an earlier measurement.
    measure(&place, |_, _| 0.2);
    succeed(&place.run("adjust a.dxf --max-correction 0.9"));
    let run = check();
    assert!(run.stderr.contains("a_Milling.ngc: error[PB520]"), "{run}");
    assert!(run.stderr.contains("other measured heights") && !run.stderr.contains("a_Probing.ngc"), "{run}");
    succeed(&place.run("post a_Milling.gcode --post linuxcnc -o a_Milling.ngc"));
    assert_eq!(check().status, Some(0), "{}", check());
    // Without the native program beside it, it may be anything.
    std::fs::remove_file(place.path().join("a_Milling.gcode")).unwrap();
    assert!(check().stderr.contains("a_Milling.ngc: error[PB520]"), "{}", check());
}

/// Stale programs are detected from cached results as well.
#[test]
fn what_is_known_of_a_program_tells_stale_ones_as_well() {
    let place = adjusted().file("pathbuild.toml", "rapid = 1000\nfeed = 150\nsweep-height = 20\n");
    let run = || place.run("emit . --check");
    assert!(run().status == Some(0) && run().status == Some(0));
    let text = place.read("a_Milling.gcode");
    let (head, rest) = text.split_once('-').unwrap();
    let (head, digit) = head.split_at(head.len() - 1);
    let other = if digit == "0" { "1" } else { "0" };
    write(&place, "a_Milling.gcode", &format!("{head}{other}-{rest}"));
    for run in [run(), run()] {
        assert!(run.status == Some(1) && run.stderr.contains("PB520"), "{run}");
    }
}

#[test]
fn programs_with_probes_are_stale_when_the_probes_are_gone() {
    let place = adjusted();
    save(&place, WITHOUT);
    let run = emit(&place, "a.dxf");
    for name in ["a_Clean.gcode", "a_Probing.gcode"] {
        assert!(run.stderr.contains(&format!("{name} was written earlier")), "{run}");
    }
    let run = emit(&place, "a.dxf --check");
    assert!(run.status == Some(1) && run.stderr.contains("1 current, 2 not current"), "{run}");
}

/// Files of other paths are left alone, whatever their names.
#[test]
fn a_program_of_another_path_is_not_stale() {
    let place = adjusted();
    let other = place.read("a_Milling.gcode").replace("drawing a.dxf", "drawing b.dxf").replace('-', "0-");
    write(&place, "a_Milling.gcode", &other);
    names_milling(&place, "a.dxf", false);
}

#[test]
fn adjust_refuses_a_program_whose_drawing_gives_other_moves() {
    let place = adjusted();
    let before = place.read("a_Milling.gcode");
    save(&place, &with_probes(WITHOUT).replace("B1 ", "B0 "));
    for name in ["a.dxf", "a", "a_Clean.gcode", "a_Z.txt"] {
        let run = place.run(&format!("adjust {name} --max-correction 0.9 --format concise"));
        assert!(run.status == Some(1) && run.stderr.contains("a_Clean.gcode: error[PB608]"), "{run}");
    }
    assert_eq!(place.read("a_Milling.gcode"), before);
    // Saving the drawing again with the same moves makes no difference.
    save(&place, &format!("{}layer REMARKS\nmill 90,90 95,90\n", with_probes(WITHOUT)));
    succeed(&place.run("adjust a.dxf --max-correction 0.9"));
    save(&place, "layer 8001.1P\nmill 0,0 40,0\n");
    let run = place.run("adjust a.dxf --max-correction 0.9 --format concise");
    assert!(run.status == Some(1) && run.stderr.contains("a.dxf:"), "its errors are reported: {run}");
}

#[test]
fn adjust_says_where_it_cannot_compare() {
    let place = adjusted();
    std::fs::remove_file(place.path().join("a.dxf")).unwrap();
    let run = place.run("adjust a_Clean.gcode --max-correction 0.9");
    assert!(run.status == Some(0) && run.stderr.contains("not compared with its drawing: a.dxf"), "{run}");
    let place = Place::new().file("a.dxf", drawing(&with_probes(WITHOUT).replace("F150 S10 ", "")));
    succeed(&place.run(&format!("emit a.dxf {OPTIONS}")));
    measure(&place, |_, _| 0.1);
    let run = place.run("adjust a.dxf --max-correction 0.9");
    assert!(run.status == Some(0) && run.stderr.contains("give --feed --sweep-height"), "{run}");
    succeed(&place.run(&format!("adjust a.dxf --max-correction 0.9 {OPTIONS}")));
    let run = place.run(&format!("adjust a.dxf --max-correction 0.9 {OPTIONS}").replace("150", "151"));
    assert!(run.status == Some(1) && run.stderr.contains("PB608"), "{run}");
}

/// If the programs are not beside the drawing, the drawing is found by the path's name.
#[test]
fn adjust_finds_the_drawing_in_the_library() {
    let settings = "library = [\"drawings\"]\nout-dir = \"out\"\n";
    let place = Place::new()
        .file("drawings/8001.dxf", drawing(&with_probes(WITHOUT)))
        .file("pathbuild.toml", settings);
    std::fs::create_dir(place.path().join("out")).unwrap();
    succeed(&place.run(&format!("emit 8001.1P {OPTIONS}")));
    let values =
        place.read("out/8001_Z.txt").replace('=', "=5.1\n").replace("T=5.1\n", "T=").replace("\n\n", "\n");
    write(&place, "out/8001_Z.txt", &values);
    let changed = drawing(&with_probes(WITHOUT).replace("B1 ", "B0 "));
    succeed(&place.run("adjust out/8001_Clean.gcode --max-correction 0.9"));
    std::fs::write(place.path().join("drawings/8001.dxf"), changed).unwrap();
    let run = place.run("adjust out/8001_Clean.gcode --max-correction 0.9");
    assert!(run.status == Some(1) && run.stderr.contains("PB608"), "{run}");
}

/// All options but one are those with which the program was written. (PB608)
#[test]
fn a_program_of_the_other_mode_says_so() {
    let options = "--feed 150 --rapid 1000 --sweep-height 20";
    for (written, adjusted, said) in [
        ("--compatible", "", Some("was written with --compatible")),
        ("", "--compatible", Some("was written without --compatible")),
        ("", "", None),
        ("--compatible", "--compatible", None),
    ] {
        let place = plate("");
        succeed(&place.run(&format!("emit a.dxf {options} {written}")));
        measure(&place, |_, _| 0.1);
        let adjust = format!("adjust a.dxf --max-correction 1 {options}");
        let run = place.run(&format!("{adjust} {adjusted}"));
        match said {
            None => succeed(&run),
            Some(said) => {
                assert!(run.status == Some(1) && run.stderr.contains("PB608"), "{run}");
                assert!(run.stderr.contains(said) && !run.stderr.contains("sweep-height"), "{run}");
                // If the mode is not the only reason, it is not reported.
                let run = place
                    .run(&format!("{adjust} {adjusted} --sweep-height 25").replace(" --sweep-height 20", ""));
                assert!(run.stderr.contains("PB608") && !run.stderr.contains(said), "{run}");
            }
        }
    }
}
