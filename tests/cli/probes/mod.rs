//! Tests Z-probes from the drawing to the adjusted program. (book: language/probes)

mod corrected;
mod current;
mod executed;
mod machine;

use crate::support::{Place, Run};
use machine::{Motion, motions};
use pathbuild_testkit::sheet;

const OPTIONS: &str = "--feed 150 --rapid 1000 --sweep-height 20 --no-cache";

/// The start of the plate's path in the drawing, which is (0, 0) in the program.
const START: [f64; 2] = [0.0, 20.0];

/// A plate of 300 mm x 200 mm with 3 x 3 probes, and a path with a line of 300 mm, bars, an arc of R50, a helical circle and a hole.
const PLATE: &str = r#"
layer 1234.1P
start 0,20 "T5 O3 I2 B0.5 D2 P6 U30"
mill 0,20 300,20
bars 300,20 300,120
sweep to 200,150
mill arc to 150,100 r 50
sweep to 60,150
circle 60,150 d 11
sweep to 220,60
circle 220,60 d 3
sweep to 20,180
end 20,180
"#;

const PROBES: &str = "
probe 0,0
probe 150,0
probe 300,0
probe 0,100
probe 150,100
probe 300,100
probe 0,200
probe 150,200
probe 300,200
";

fn drawing(text: &str) -> Vec<u8> {
    sheet(text).unwrap_or_else(|errors| panic!("{errors:?}")).to_dxf()
}

/// Creates a place with two drawings of the plate: a.dxf with probes, b.dxf without.
fn plate(configuration: &str) -> Place {
    Place::new()
        .file("a.dxf", drawing(&format!("{PLATE}{PROBES}")))
        .file("b.dxf", drawing(PLATE))
        .file("pathbuild.toml", configuration)
}

#[track_caller]
fn succeed(run: &Run) {
    assert_eq!(run.status, Some(0), "{run}");
}

fn emit(place: &Place, drawing: &str) -> Run {
    place.run(&format!("emit {drawing} {OPTIONS}"))
}

/// Enters measured values with three decimals, which `off` computes from the position in the drawing.
fn measure(place: &Place, off: impl Fn(f64, f64) -> f64) {
    let measured = |line: &str| {
        let numbers = line.trim_start_matches("([").split(']').next().unwrap();
        let (x, y) = numbers.split_once(' ').unwrap();
        let (probe, _) = line.rsplit_once('=').unwrap();
        format!("{probe}={:.3}\n", 5.0 + off(x.parse().unwrap(), y.parse().unwrap()))
    };
    let values: String = place.read("a_Z.txt").lines().map(measured).collect();
    write(place, "a_Z.txt", &values);
}

fn write(place: &Place, name: &str, text: &str) {
    std::fs::write(place.path().join(name), text).unwrap();
}

/// Matches the moves of an adjusted program with those of the same program without probes, which has the correct heights for a flat plate. Returns
/// each flat move with the corresponding adjusted moves.
fn pairs(flat: &[Motion], adjusted: &[Motion]) -> Vec<(Motion, Vec<Motion>)> {
    // After a sweep the height may be corrected again, for which the flat program has no move.
    let is_correction = |motion: &Motion| {
        motion.is_corrected && motion.length() == 0.0 && (motion.to[2] - motion.from[2]).abs() < 0.1
    };
    let mut rest = adjusted.iter().filter(|motion| !is_correction(motion)).copied();
    let mut pairs = Vec::new();
    for whole in flat {
        let mut pieces = vec![rest.next().unwrap()];
        while whole.is_milling() && pieces.iter().map(Motion::length).sum::<f64>() < whole.length() - 0.01 {
            pieces.push(rest.next().unwrap());
        }
        let end = pieces[pieces.len() - 1].to;
        assert!(
            libm::hypot(end[0] - whole.to[0], end[1] - whole.to[1]) < 0.0015,
            "{whole:?} ends at {end:?}"
        );
        pairs.push((*whole, pieces));
    }
    assert!(rest.next().is_none());
    pairs
}

/// Returns the maximum errors of the adjusted program, in height and in the plane, sampled every 0.5 mm.
fn largest_error(place: &Place, off: impl Fn(f64, f64) -> f64) -> (f64, f64) {
    let (flat, adjusted) = (motions(&place.read("b_Milling.gcode")), motions(&place.read("a_Milling.gcode")));
    let (mut height, mut way) = (0.0_f64, 0.0_f64);
    for (whole, pieces) in pairs(&flat, &adjusted) {
        let total: f64 = pieces.iter().map(Motion::length).sum();
        let mut before = 0.0;
        for piece in pieces {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred")]
            let samples = (piece.length() / 0.5).ceil().max(1.0) as u32;
            // A vertical move, and the move after it, are only corrected at their ends.
            let first = if whole.is_milling() { 0 } else { samples };
            for sample in first..=samples {
                let part = f64::from(sample) / f64::from(samples);
                let real = piece.at(part);
                let along = if total > 0.0 { (before + piece.length() * part) / total } else { 1.0 };
                let ideal = whole.at(along);
                way = way.max(libm::hypot(real[0] - ideal[0], real[1] - ideal[1]));
                if piece.is_corrected {
                    let truth = ideal_height(&whole, along) + off(ideal[0] + START[0], ideal[1] + START[1]);
                    height = height.max((real[2] - truth).abs());
                }
            }
            before += piece.length();
        }
    }
    (height, way)
}

fn ideal_height(whole: &Motion, along: f64) -> f64 {
    whole.from[2] + (whole.to[2] - whole.from[2]) * along
}

const TILTS: [(f64, f64); 5] = [(0.5, 0.0), (0.0, 0.5), (0.25, 0.25), (-0.333, 0.167), (0.25, -0.25)];

/// Emits, measures and adjusts the plate for all tilts. Returns the maximum errors.
fn errors(configuration: &str) -> (f64, f64) {
    let place = plate(configuration);
    succeed(&emit(&place, "a.dxf"));
    succeed(&emit(&place, "b.dxf"));
    let clean = place.read("a_Clean.gcode");
    assert!(["G01 F", "G02 F", "G03 F"].iter().all(|kind| clean.contains(kind)));
    let mut largest = (0.0_f64, 0.0_f64);
    for (along, across) in TILTS {
        let off = |x: f64, y: f64| along * x / 300.0 + across * y / 200.0;
        measure(&place, off);
        succeed(&place.run("adjust a.dxf --max-correction 1"));
        let (height, way) = largest_error(&place, off);
        largest = (largest.0.max(height), largest.1.max(way));
    }
    largest
}

#[test]
fn a_tilted_plate_is_milled_as_if_it_were_flat() {
    for model in ["plane", "tin"] {
        let (height, way) = errors(&format!("z-model = \"{model}\"\n"));
        println!("{model}: heights off by {height:.5} mm, the way by {way:.5} mm");
        assert!(height <= 0.002, "{model}: {height}");
        assert!(way <= 0.002, "{model}: {way}");
    }
}

#[test]
fn the_compatible_model_and_whole_moves_do_not_come_so_near() {
    let (compatible, _) = errors("");
    let (whole, _) = errors("z-model = \"tin\"\nz-split = 0\n");
    println!("idw4: {compatible:.5} mm; tin without cutting: {whole:.5} mm");
    assert!(compatible > 0.05 && whole > 0.01);
}

#[test]
fn cutting_changes_no_statistics() {
    let statistics = |configuration: &str| {
        let place = plate(configuration);
        succeed(&emit(&place, "a.dxf"));
        let text = place.read("a_Clean.gcode");
        let lines = text.lines().filter(|line| line.contains(" mm ") || line.contains("ount:"));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    let compatible = statistics("");
    assert_eq!(compatible.len(), 5);
    assert_eq!(statistics("z-model = \"tin\"\n"), compatible);
}

#[test]
fn pieces_that_no_machine_tells_apart_are_refused() {
    for (split, status) in [("0", 0), ("0.1", 0), ("0.09", 2), ("-1", 2)] {
        let run = emit(&plate(&format!("z-model = \"tin\"\nz-split = {split}\n")), "a.dxf");
        assert_eq!(run.status, Some(status), "{run}");
    }
}

#[test]
fn too_many_pieces_are_refused() {
    let limited = |moves: u32| {
        emit(
            &plate(&format!("z-model = \"tin\"\nz-split = 0.1\n[limits]\nembedding-moves = {moves}\n")),
            "a.dxf",
        )
    };
    assert_eq!(limited(100_000).status, Some(0));
    let run = limited(1000);
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("PB005") && run.stderr.contains("embedding-moves"), "{run}");
    // The number of pieces in the message does not include comments.
    let (_, count) = run.stderr.split_once("the moves of this path into ").unwrap();
    let pieces: u32 = count.split(' ').next().unwrap().parse().unwrap();
    assert_eq!([limited(pieces).status, limited(pieces - 1).status], [Some(0), Some(1)]);
    let program = plate("z-model = \"tin\"\nz-split = 0.1\n");
    succeed(&emit(&program, "a.dxf"));
    let text = program.read("a_Clean.gcode");
    let moves = text
        .lines()
        .filter(|line| ["G00 ", "G01 ", "G02 ", "G03 "].iter().any(|code| line.starts_with(code)));
    assert_eq!(
        moves.count(),
        pieces as usize + 3,
        "as many lines as moves are counted, and those of head and foot"
    );
}

#[test]
fn milling_outside_the_probes_is_a_warning() {
    let inside = emit(&plate("z-model = \"plane\"\n"), "a.dxf");
    assert!(inside.status == Some(0) && !inside.stderr.contains("PB606"), "{inside}");
    let outer = format!("{PLATE}probe 150,0\nprobe 300,0\nprobe 0,200\n");
    for (configuration, is_warned) in [
        ("z-model = \"plane\"\n", true),
        ("z-model = \"tin\"\n", true),
        ("z-model = \"tin\"\n[severity]\nPB606 = \"ignore\"\n", false),
        ("", false),
    ] {
        let place = plate(configuration).file("a.dxf", drawing(&outer));
        let run = emit(&place, "a.dxf");
        assert_eq!((run.status, run.stderr.contains("PB606")), (Some(0), is_warned), "{run}");
    }
}

#[test]
fn probes_without_a_slope_across_them_are_a_warning() {
    let warned = |model: &str, probes: &str| {
        let place =
            plate(&format!("z-model = \"{model}\"\n")).file("a.dxf", drawing(&format!("{PLATE}{probes}")));
        let run = emit(&place, "a.dxf");
        assert_eq!(run.status, Some(0), "{run}");
        run.stderr.contains("no slope is known")
    };
    for model in ["plane", "tin"] {
        assert!(warned(model, "probe 150,0\n"));
        assert!(warned(model, "probe 0,0\nprobe 300,0\n"));
        assert!(warned(model, "probe 0,0\nprobe 150,0\nprobe 300,0\n"));
        assert!(warned(model, "probe 0,0\nprobe 150,1\nprobe 300,0\n"), "almost on a line");
        assert!(!warned(model, "probe 0,0\nprobe 150,5\nprobe 300,0\n"));
    }
    assert!(!warned("idw4", "probe 150,0\n"));
}

#[test]
fn values_that_were_entered_are_kept() {
    let place = plate("");
    succeed(&emit(&place, "a.dxf"));
    measure(&place, |_, _| 0.1);
    let measured = place.read("a_Z.txt");
    succeed(&emit(&place, "a.dxf"));
    assert_eq!(place.read("a_Z.txt"), measured, "the same probes");

    let before = place.read("a_Clean.gcode");
    write(&place, "a_Clean.gcode", "old");
    let moved = drawing(&format!("{PLATE}{}", PROBES.replace("probe 150,100", "probe 151,100")));
    let place = place.file("a.dxf", moved);
    let refused = emit(&place, "a.dxf");
    assert!(refused.status == Some(1) && refused.stderr.contains("PB605"), "{refused}");
    assert_eq!((place.read("a_Z.txt"), place.read("a_Clean.gcode").as_str()), (measured.clone(), "old"));

    succeed(&place.run(&format!("emit a.dxf --force {OPTIONS}")));
    assert!(place.read("a_Z.txt").contains("([151.000 100.000]/T=5.000 @ [151.000|80.000]) #"));
    assert!(place.read("a_Z.txt").lines().all(|line| line.ends_with('=')), "and no values");
    assert_ne!(place.read("a_Clean.gcode"), before);
}

/// A file of values that an editor saved with a byte order mark or in UTF-16, or that has values in the wrong place.
#[test]
fn values_that_are_entered_differently_are_not_lost() {
    let place = plate("");
    succeed(&emit(&place, "a.dxf"));
    measure(&place, |_, _| 0.1);
    let measured = place.read("a_Z.txt");
    let with_mark = format!("\u{feff}{measured}");
    write(&place, "a_Z.txt", &with_mark);
    succeed(&emit(&place, "a.dxf"));
    assert_eq!(place.read("a_Z.txt"), with_mark);

    let wide: Vec<u8> = with_mark.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let before_probe = |line: &str| {
        let (probe, value) = line.rsplit_once('=').unwrap();
        format!("{}=\n", probe.replace(") #", &format!(") {value} #")))
    };
    let misplaced: String = measured.lines().map(before_probe).collect();
    assert_ne!(misplaced, measured);
    for (file, word) in [(wide, "UTF-16"), (misplaced.into_bytes(), "valid probe line")] {
        std::fs::write(place.path().join("a_Z.txt"), &file).unwrap();
        let refused = emit(&place, "a.dxf");
        assert!(refused.status == Some(1) && refused.stderr.contains("PB605"), "{refused}");
        assert_eq!(std::fs::read(place.path().join("a_Z.txt")).unwrap(), file);
        let refused = place.run("adjust a.dxf --max-correction 0.5");
        assert!(refused.status == Some(1) && refused.stderr.contains(word), "{refused}");
        assert!(!refused.stderr.contains("PB603"), "{refused}");
    }
}

/// Files written by the original program or by older versions lack the positions of probes in the emitted drawing.
#[test]
fn values_without_places_are_kept_and_used() {
    let place = plate("");
    succeed(&emit(&place, "a.dxf"));
    measure(&place, |_, _| 0.1);
    let with_places = place.read("a_Z.txt");
    let line =
        |line: &str| format!("{}){}\n", line.split_once(" @ ").unwrap().0, line.split_once(')').unwrap().1);
    let without: String = with_places.lines().map(line).collect();
    assert_ne!(without, with_places);
    write(&place, "a_Z.txt", &without);
    succeed(&emit(&place, "a.dxf"));
    assert_eq!(place.read("a_Z.txt"), without, "the same probes");
    succeed(&place.run("adjust a.dxf --max-correction 1"));
    // The probe has another position in the emitted drawing, although it was not moved in its own drawing.
    write(&place, "a_Z.txt", &with_places.replace("@ [150.000|80.000]", "@ [150.000|81.000]"));
    let run = place.run("adjust a.dxf --max-correction 1");
    assert!(run.status == Some(1) && run.stderr.contains("PB603"), "{run}");
}

/// A path that is embedded twice has each of its probes twice, under the same name.
#[test]
fn a_probe_that_is_embedded_twice_is_told_apart_by_its_place() {
    let drawings = r#"
== pathbuild.toml ==
feed = 150
rapid = 1000
sweep-height = 15
== 1234.1P.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B0 MPlate"
mill 0,0 40,0
end 40,0
probe 20,10 "LA"
== 8901.1P.dxf ==
layer 8901.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
sweep 40,0 100,0
subpath 100,0 140,0 ">1234.1P"
end 140,0
"#;
    let place = Place::of(drawings);
    succeed(&place.run("emit 8901.1P"));
    let values = "([20.000 10.000]/L:A/T=5.000 @ [20.000|10.000]) #51=\n([20.000 10.000]/L:A/T=5.000 @ [120.000|10.000]) #52=\n";
    assert_eq!(place.read("8901.1P_Z.txt"), values);
    let probing = place.read("8901.1P_Probing.gcode");
    assert!(probing.contains("(Probe #52 [20.000 10.000]/L:A/T=5.000 @ [120.000|10.000])"), "{probing}");
    assert_eq!((probing.matches("\nG38.2 Z0").count(), probing.matches("G38.3").count()), (2, 0));

    let place = Place::of(drawings);
    succeed(&place.run("emit 8901.1P --compatible"));
    let values = "([20.000 10.000]/L:A/T=5.000) #51=\n([20.000 10.000]/L:A/T=5.000) #52=\n";
    assert_eq!(place.read("8901.1P_Z.txt"), values);
    let probing = place.read("8901.1P_Probing.gcode");
    assert_eq!((probing.matches("\nG38.3 Z0").count(), probing.matches(" @ ").count()), (2, 0));
}

#[test]
fn values_of_other_probes_are_not_used() {
    let place = plate("");
    succeed(&emit(&place, "a.dxf"));
    measure(&place, |_, _| 0.1);
    let values = place.read("a_Z.txt").replace("([150.000 100.000]", "([151.000 100.000]");
    write(&place, "a_Z.txt", &values);
    let run = place.run("adjust a.dxf --max-correction 1");
    assert!(run.status == Some(1) && run.stderr.contains("PB603"), "{run}");
    assert!(!place.path().join("a_Milling.gcode").exists());
}

#[test]
fn every_name_of_a_program_is_understood() {
    let place = plate("");
    succeed(&emit(&place, "a.dxf"));
    measure(&place, |_, _| 0.1);
    for name in ["a", "a.dxf", "a.DXF", "a_Clean.gcode", "a_Z.txt", "./a_Z.txt"] {
        let run = place.run(&format!("adjust {name} --max-correction 0,2"));
        succeed(&run);
        assert!(run.stderr.contains("heights corrected by +0.100 to +0.100 mm"), "{run}");
        remove(&place, "a_Milling.gcode");
    }
    let run = place.run("adjust a a.dxf a_Z.txt --max-correction 0.2");
    assert_eq!(run.stderr.matches("written").count(), 1, "{run}");
    assert!(place.run("adjust a --max-correction 0.2").stderr.contains("unchanged"));
}

fn remove(place: &Place, name: &str) {
    std::fs::remove_file(place.path().join(name)).unwrap();
}

#[test]
fn programs_of_drawings_are_in_the_output_directory() {
    let place = plate("out-dir = \"gcode\"\n");
    succeed(&emit(&place, "a.dxf"));
    let values = place.read("gcode/a_Z.txt").replace("=\n", "=5\n").replace("T=5\n", "T=");
    write(&place, "gcode/a_Z.txt", &values);
    for name in ["a.dxf", "a", "gcode/a_Z.txt"] {
        succeed(&place.run(&format!("adjust {name} --max-correction 0.2")));
        remove(&place, "gcode/a_Milling.gcode");
    }
}

#[test]
fn programs_with_more_in_their_names_are_found_by_their_drawing() {
    let with_r = PLATE.replace("U30\"", "U30 R_112\"");
    let place = Place::new()
        .file("a.dxf", drawing(&format!("{with_r}{PROBES}")))
        .file("ab.dxf", drawing(&format!("{}{PROBES}", with_r.replace("1234.1P", "1234.2P"))));
    succeed(&emit(&place, "a.dxf"));
    succeed(&emit(&place, "ab.dxf"));
    let values = place.read("a_112_Z.txt").replace("=\n", "=5\n").replace("T=5\n", "T=");
    write(&place, "a_112_Z.txt", &values);
    for drawing in ["a.dxf", "a"] {
        succeed(&place.run(&format!("adjust {drawing} --max-correction 0.2")));
        assert!(!place.path().join("ab_112_Milling.gcode").exists());
        remove(&place, "a_112_Milling.gcode");
    }
    for (argument, missing) in
        [("ac.dxf", "ac_Clean.gcode"), ("ac", "ac_Clean.gcode"), ("a_Z.txt", "a_Clean.gcode")]
    {
        let run = place.run(&format!("adjust {argument} --max-correction 0.2"));
        assert!(run.status == Some(1) && run.stderr.contains(missing), "{run}");
    }
}

#[test]
fn a_program_with_errors_does_not_stop_the_others() {
    let place = Place::new()
        .file("a_Z.txt", "([0 0]/T=5) #51=5.1\n")
        .file("a_Clean.gcode", "Z1.000(=1.000+1.000*[#51-5.000])\n")
        .file("b_Z.txt", "([0 0]/T=5) #51=\n")
        .file("b_Clean.gcode", "Z1.000(=1.000+1.000*[#51-5.000])\n")
        .file("c_Z.txt", "");
    let run = place.run("adjust b c a --max-correction 1 --format concise");
    assert_eq!(run.status, Some(1), "{run}");
    let codes: Vec<&str> =
        run.stderr.lines().filter_map(|line| line.split("error[").nth(1)?.split(']').next()).collect();
    assert_eq!(codes, ["PB601", "PB001"], "{run}");
    assert_eq!(place.read("a_Milling.gcode"), "Z1.100(==1.000+1.000*[#51-5.000])\n");
    assert!(!place.path().join("b_Milling.gcode").exists());
}

#[test]
fn a_program_that_cannot_be_written_is_an_error() {
    let place = Place::new()
        .file("a_Z.txt", "([0 0]/T=5) #51=5.1\n")
        .file("a_Clean.gcode", "Z1.000(=1.000+1.000*[#51-5.000])\n")
        .file("a_Milling.gcode/occupied", "");
    let run = place.run("adjust a --max-correction 1");
    assert!(run.status == Some(1) && run.stderr.contains("PB004"), "{run}");
}

#[test]
fn lines_that_match_are_shown() {
    let place = Place::new()
        .file("a_Z.txt", "([0 0]/T=5) #51=5.1\n")
        .file("a_Clean.gcode", "G00 X1\r\nG01 Z1.000(=1.000+1.000*[#51-5.000])\nG00 X2\n");
    let run = place.run_with(&["adjust", "a", "--max-correction", "1", "--show", "^G00|#52"]);
    assert_eq!((run.status, run.stdout.as_str()), (Some(0), "G00 X1\nG00 X2\n"));
    assert_eq!(place.run("adjust a --max-correction 1 --show (").status, Some(2));
}

#[test]
fn the_largest_correction_must_be_said() {
    let place = plate("");
    assert_eq!(place.run("adjust a").status, Some(2));
    for wrong in ["0", "-1", "x", "1e3"] {
        assert_eq!(place.run(&format!("adjust a --max-correction={wrong}")).status, Some(2), "{wrong}");
    }
}

/// Returns the positions of the probes in the program, in the order of their numbers: `... @ [8.000|4.000]) #51=`.
fn places_of_probes(values: &str) -> Vec<(f64, f64)> {
    let place = |line: &str| {
        let (x, y) = line.split_once("@ [")?.1.split_once(']')?.0.split_once('|')?;
        Some((x.parse().ok()?, y.parse().ok()?))
    };
    values.lines().filter_map(place).collect()
}

#[test]
fn a_senders_log_replaces_typing() {
    let place = plate("z-model = \"tin\"\n");
    succeed(&emit(&place, "a.dxf"));
    // The machine's zero is elsewhere, and the log does not contain its position.
    let results: Vec<String> = places_of_probes(&place.read("a_Z.txt"))
        .into_iter()
        .zip(0..)
        .map(|((x, y), probe)| {
            let z = 5.1 + 0.01 * f64::from(probe);
            format!("ok\n[PRB:{:.3},{:.3},{z:.3}:1]\n", x - 300.0, y - 200.0)
        })
        .collect();
    let swapped = [&results[1..2], &results[..1], &results[2..]].concat().concat();
    let results = results.concat();
    let place = place.file("sender.log", &results).file("failed.log", results.replacen(":1]", ":0]", 1));
    let typed = (0..9).fold(place.read("a_Z.txt"), |text, probe| {
        text.replace(
            &format!("#{}=", 51 + probe),
            &format!("#{}={:.3}", 51 + probe, 5.1 + 0.01 * f64::from(probe)),
        )
    });
    succeed(&place.run("adjust a --max-correction 1 --log sender.log"));
    let from_log = place.read("a_Milling.gcode");
    let failed = place.run("adjust a --max-correction 1 --log failed.log");
    assert!(failed.status == Some(1) && failed.stderr.contains("failed.log:2:1"), "{failed}");
    assert_eq!(place.run("adjust a --max-correction 1 --log nothing.log").status, Some(1));
    write(&place, "swapped.log", &swapped);
    let elsewhere = place.run("adjust a --max-correction 1 --log swapped.log --format concise");
    assert!(
        elsewhere.status == Some(1) && elsewhere.stderr.contains("swapped.log:4:1: error[PB601]"),
        "{elsewhere}"
    );
    assert_eq!(place.run("adjust a b --max-correction 1 --log sender.log").status, Some(2));
    write(&place, "a_Z.txt", &typed);
    succeed(&place.run("adjust a --max-correction 1"));
    assert_eq!(place.read("a_Milling.gcode"), from_log);
}

#[test]
fn an_odd_probe_is_a_warning() {
    let place = plate("z-model = \"tin\"\n");
    succeed(&emit(&place, "a.dxf"));
    measure(&place, |x, y| if (x, y) == (150.0, 100.0) { 0.5 } else { 0.001 * x });
    let run = place.run("adjust a --max-correction 1");
    assert!(run.status == Some(0) && run.stderr.contains("PB607"), "{run}");
    let place = place.file("pathbuild.toml", "[severity]\nPB607 = \"error\"\n");
    assert_eq!(place.run("adjust a --max-correction 1").status, Some(1));
}
