//! Tests that the heights of a corrected program, as the machine executes them, are compared with clamps, the machine's travel and the measured
//! surface. (book: language/probes)

use super::{drawing, succeed, write};
use crate::support::{Place, Run};

const VALUES: &str = "feed = 150\nrapid = 1000\nspindle = \"manual\"\n";

/// A path of two grooves with a sweep from X20 to X60 between them, which starts at (0, 0) with T2 and this S.
fn grooves(sweep: &str, more: &str) -> Vec<u8> {
    drawing(&format!(
        "layer 1234.1P\nstart 0,0 \"T2 O2 S{sweep} I0.5 B1\"\nmill 0,0 20,0\nsweep 20,0 60,0\nmill 60,0 80,0\nend 80,0\n{more}"
    ))
}

fn emitted(configuration: &str, drawing: Vec<u8>) -> Place {
    let place =
        Place::new().file("a.dxf", drawing).file("pathbuild.toml", format!("{VALUES}{configuration}"));
    succeed(&place.run("emit a.dxf"));
    place
}

/// Enters these heights in the order of the probes, and runs `adjust`.
fn adjust(place: &Place, heights: &[f64]) -> Run {
    let values = place.read("a_Z.txt");
    let line = |(line, height): (&str, &f64)| format!("{}={height:.3}\n", line.rsplit_once('=').unwrap().0);
    assert_eq!(values.lines().count(), heights.len(), "{values}");
    write(place, "a_Z.txt", &values.lines().zip(heights).map(line).collect::<String>());
    place.run("adjust a.dxf --max-correction 3")
}

#[track_caller]
fn assert_refused(place: &Place, run: &Run, code: &str) {
    assert!(run.status == Some(1) && run.stderr.contains(&format!("error[{code}]")), "{run}");
    assert!(!place.path().join("a_Milling.gcode").exists(), "{run}");
}

#[test]
fn sweeps_that_are_lowered_into_a_clamp_are_an_error() {
    const CLAMP: &str =
        "probe 70,20\nlayer clamps\npolyline 35,-5 45,-5 45,5 35,5 closed\ntext 40,0 \"Z25\"\n";
    let place = emitted("keep-out = 'clamps'\n", grooves("25", CLAMP));
    assert_refused(&place, &adjust(&place, &[1.98]), "PB407");
    succeed(&adjust(&place, &[2.0]));
    succeed(&place.run("verify a_Milling.gcode --against a.dxf"));
    // Without the layer of clamps, `adjust` knows none.
    write(&place, "pathbuild.toml", VALUES);
    succeed(&adjust(&place, &[1.98]));
    write(&place, "pathbuild.toml", &format!("{VALUES}keep-out = 'clamps'\n"));
    let run = place.run("verify a_Milling.gcode --against a.dxf");
    assert!(run.status == Some(1) && run.stderr.contains("error[PB407]"), "{run}");
}

#[test]
fn heights_beyond_the_travel_are_an_error_before_the_program_is_written() {
    let place = emitted("[machine]\nz = [0, 20.1]\n", grooves("20", "probe 70,20\n"));
    assert_refused(&place, &adjust(&place, &[2.102]), "PB748");
    succeed(&adjust(&place, &[2.1]));
    succeed(&place.run("verify a_Milling.gcode"));
}

/// Between the triangles' corners, the sweep crosses material that is higher than where the sweep begins.
#[test]
fn sweeps_over_higher_material_are_an_error() {
    const PROBES: &str = "probe 0,5\nprobe 80,5\nprobe 40,5\nprobe 40,-5\n";
    let adjusted = |sweep: &str, middle: f64| {
        let place = emitted("z-model = \"tin\"\n", grooves(sweep, PROBES));
        let order: Vec<bool> = place.read("a_Z.txt").lines().map(|line| line.starts_with("([40.")).collect();
        let heights = order.iter().map(|is_middle| if *is_middle { middle } else { 1.6 });
        let run = adjust(&place, &heights.collect::<Vec<_>>());
        (place, run)
    };
    // The sweep begins 0.35 mm lower than drawn, and the first and the last rapid moves are at S.
    let (place, run) = adjusted("3.64", 3.3);
    assert_refused(&place, &run, "PB602");
    assert!(run.stderr.contains("this rapid move is at Z 3.29, but at (40, 0)"), "{run}");
    let (place, run) = adjusted("3.66", 3.3);
    succeed(&run);
    let run = place.run("verify a_Milling.gcode");
    assert!(run.stderr.contains("errors: 0"), "{run}");
    // Of a program that is at hand, `verify` and `post` report the same.
    let mut lower = place.read("a_Milling.gcode");
    for (from, to) in
        [("Z3.660", "Z3.640"), ("==3.660", "==3.640"), ("Z3.310(", "Z3.290("), ("Z4.110(", "Z4.090(")]
    {
        assert!(lower.contains(from), "{from}: {lower}");
        lower = lower.replace(from, to);
    }
    write(&place, "lower.gcode", &lower);
    for command in ["verify lower.gcode", "post lower.gcode --post grbl -o -"] {
        let run = place.run(command);
        assert!(run.status == Some(1) && run.stderr.contains("error[PB602]"), "{command}: {run}");
    }
}

#[test]
fn a_cut_with_the_correction_of_its_beginning_is_told_from_a_tenth_of_a_millimetre() {
    let told = |configuration: &str, height: f64| {
        let text = "layer 1234.1P\nstart 0,0 \"T2 O2 S20 I1 B1\"\nmill 0,0 100,0\nend 100,0\nprobe 0,10\nprobe 100,10\n";
        let run = adjust(&emitted(configuration, drawing(text)), &[2.0, height]);
        succeed(&run);
        run.stderr.contains("warning[PB606]")
    };
    assert!(!told("", 2.122));
    assert!(told("", 2.123));
    assert!(told("", 1.877));
    assert!(!told("z-split = 20\n", 2.4));
    assert!(!told("z-model = \"tin\"\n", 2.4));
}

#[test]
fn the_surface_of_a_converted_program_is_not_that_of_the_drawing() {
    let place = emitted("", grooves("20", "probe 70,20\n"));
    for height in [1.6, 2.4] {
        succeed(&adjust(&place, &[height]));
        succeed(&place.run("post a_Milling.gcode --post linuxcnc -o a.ngc"));
        let run = place.run("verify a.ngc");
        succeed(&run);
        assert!(
            run.stderr.contains("not checked: rapid moves (the heights were corrected by probes"),
            "{run}"
        );
        let run = place.run("verify a.ngc --require rapids");
        assert!(run.status == Some(1) && run.stderr.contains("error[PB523]"), "{run}");
        // In the material as measured, the groove begins at this height.
        let run = place.run(&format!("verify a.ngc --surface {height}"));
        assert!(run.status == Some(0) && run.stderr.contains("(--surface)"), "{run}");
        let run = place.run(&format!("verify a.ngc --surface {}", height + 0.1));
        assert!(run.status == Some(1) && run.stderr.contains("error[PB74"), "{run}");
        let run = place.run("verify a.ngc --against a.dxf");
        assert!(run.status == Some(1) && run.stderr.contains("corrected by probes"), "{run}");
        succeed(&place.run("verify a_Milling.gcode --against a.dxf"));
    }
}
