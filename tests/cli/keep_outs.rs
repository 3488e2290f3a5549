//! Tests clamps on the table: hitting one is an error in each command that examines moves. (book: language/keep-outs)

use std::fs;

use crate::support::{Place, Run, dxf};

const OPTIONS: &str =
    "feed = 150\nrapid = 1000\nsweep-height = 20\nkeep-out = 'clamps?'\nspindle = \"manual\"\n";

/// A clamp with the corners (20, 10) and (30, 20) and a height of 20 mm.
const CLAMP: &str = "layer clamps\npolyline 20,10 30,10 30,20 20,20 closed\ntext 21,14 \"Z20\"\n";

/// Returns a path with these statements, which starts at (0, 0) with O2 and S `sweep`, and a clamp.
fn path(sweep: &str, statements: &str) -> String {
    format!("layer 1234.1P\nstart 0,0 \"T5 O2 I5 B0 S{sweep} MAl\"\n{statements}\n{CLAMP}")
}

fn place(drawing: &str) -> Place {
    Place::new().file("pathbuild.toml", OPTIONS).file("1234.1P.dxf", dxf(drawing))
}

fn codes(run: &Run) -> Vec<String> {
    let found = run.stdout.split("[PB").skip(1).chain(run.stderr.split("[PB").skip(1));
    found.map(|rest| rest[..3].to_owned()).collect()
}

/// Checks the findings of `check` and `emit`, with and without a cache; with an error, `emit` must write nothing.
#[track_caller]
fn assert_found(place: &Place, expected: &[&str]) {
    for command in
        ["check .", "check . --no-cache", "check 1234.1P.dxf", "emit .", "emit . --no-cache", "emit 1234.1P"]
    {
        let run = place.run(&format!("{command} --format concise"));
        assert_eq!(codes(&run), expected, "{command}: {run}");
        assert_eq!(run.status, Some(i32::from(!expected.is_empty())), "{run}");
    }
    assert_eq!(place.path().join("1234.1P_Milling.gcode").exists(), expected.is_empty());
}

#[track_caller]
fn assert_hits(drawing: &str, what: &str) {
    let place = place(drawing);
    let run = place.run("check . --format concise");
    assert_found(&place, &codes(&run).iter().map(String::as_str).collect::<Vec<_>>());
    assert!(codes(&run).contains(&"407".to_owned()) && run.stderr.contains(what), "{run}");
}

#[track_caller]
fn assert_passes(drawing: &str) {
    assert_found(&place(drawing), &[]);
}

#[test]
fn cuts_keep_half_of_o_away() {
    let cut = |y: &str| path("21", &format!("mill 0,0 0,{y}\nmill 0,{y} 50,{y}\nend 50,{y}"));
    assert_passes(&cut("9"));
    assert_hits(&cut("9.01"), "cut, lowest Z 0, moves: 1");
}

#[test]
fn rapids_are_above_or_beside() {
    let rapid =
        |sweep: &str, y: &str| path(sweep, &format!("mill 0,0 0,{y}\nsweep 0,{y} 50,{y}\nend 50,{y}"));
    assert_hits(&rapid("19.99", "15"), "rapid move, lowest Z 19.99, moves: 1");
    assert_passes(&rapid("20", "15"));
    assert_passes(&rapid("10", "9"));
    assert_hits(&rapid("10", "9.01"), "rapid move");
}

/// No sweep height leads the tool down into a clamp: the cut or the clamp must move.
#[test]
fn a_higher_s_is_advised_only_for_rapids_along_the_plate() {
    let advice = |sweep: &str| {
        let drawing = path(sweep, "sweep 0,0 25,15\nmill 25,15 60,15\nend 60,15");
        let run = place(&drawing).run("check .");
        assert!(run.stderr.contains("rapid move, lowest Z 5"), "{run}");
        run.stderr.contains("raise S to 20 or more")
    };
    assert!(advice("19.99"));
    assert!(!advice("20"));
}

#[test]
fn arcs_are_arcs() {
    // The half circle bulges up towards the clamp, which begins at Y10; its chord at Y0 is far from it.
    let arc = |radius: f64| {
        let (left, right) = (25.0 - radius, 25.0 + radius);
        path(
            "21",
            &format!("sweep 0,0 {left},0\nmill arc {left},0 to {right},0 centre 25,0 cw\nend {right},0"),
        )
    };
    assert_passes(&arc(9.0));
    assert_hits(&arc(9.01), "cut");
}

#[test]
fn holes_and_helical_circles_count() {
    let circle = |x: &str, diameter: &str| {
        path(
            "21",
            &format!("sweep 0,0 {x},15\nmill circle {x},15 d {diameter}\nsweep {x},15 50,15\nend 50,15"),
        )
    };
    assert_passes(&circle("19", "2"));
    assert_hits(&circle("19.01", "2"), "plunge");
    assert_passes(&circle("17", "6"));
    assert_hits(&circle("17.01", "6"), "cut");
}

/// The probing program is checked like the milling program.
#[test]
fn probes_and_the_ways_between_them_count() {
    let probes =
        |sweep: &str, probes: &str| path(sweep, &format!("mill 0,0 0,2\nmill 0,2 50,2\n{probes}\nend 50,2"));
    let assert_probing = |probes: &str, what: &[&str]| {
        let place = place(probes);
        assert_found(&place, &vec!["407"; what.len()]);
        let run = place.run("check . --format concise");
        for what in what {
            assert!(run.stderr.contains("in the probing program") && run.stderr.contains(what), "{run}");
        }
    };
    // The rapid move from (0, 0) to the probe is at S, which is above the clamp.
    for beside in ["probe 19,15", "probe 25,9"] {
        let place = place(&probes("21", beside));
        assert_eq!(codes(&place.run("check . --format concise")), Vec::<String>::new(), "{beside}");
    }
    for inside in ["probe 19.01,15", "probe 25,9.01"] {
        assert_probing(
            &probes("21", inside),
            &["probing move, lowest Z 0, moves: 1", "rapid move, lowest Z 0, moves: 2"],
        );
    }
    // The tool moves from probe to probe, and back.
    let across = "probe 0,15\nprobe 40,15";
    let place = place(&probes("20", across));
    assert_eq!(codes(&place.run("check . --format concise")), Vec::<String>::new());
    assert_probing(&probes("19.99", across), &["rapid move, lowest Z 19.99, moves: 2"]);
}

/// Each element has one finding, regardless of the number of its passes.
#[test]
fn passes_are_counted() {
    let drawing = path("21", "mill 0,0 0,15\nmill 0,15 50,15\nend 50,15").replace("I5", "I1");
    let place = place(&drawing);
    let run = place.run("check . --format concise");
    assert_eq!(codes(&run), ["407"], "{run}");
    assert!(run.stderr.contains("cut, lowest Z 0, moves: 5"), "{run}");
}

#[test]
fn without_the_setting_nothing_is_looked_at() {
    let place = place(&path("21", "mill 0,0 0,15\nmill 0,15 50,15\nend 50,15"));
    assert_eq!(codes(&place.run("check . --format concise")), ["407"]);
    fs::write(place.path().join("pathbuild.toml"), OPTIONS.replace("clamps?", "other")).unwrap();
    let run = place.run("check . --format concise");
    assert_eq!((run.status, codes(&run)), (Some(0), vec!["119".to_owned()]), "{run}");
    fs::write(place.path().join("pathbuild.toml"), OPTIONS).unwrap();
    for command in ["check .", "emit .", "emit . --check"] {
        assert_eq!(codes(&place.run(&format!("{command} --format concise")))[0], "407");
    }
}

/// An edit of the clamp alone is detected, both when it adds an error and when it removes one.
#[test]
fn an_edited_clamp_is_a_change() {
    let drawing = path("21", "mill 0,0 0,8\nmill 0,8 50,8\nend 50,8");
    let place = place(&drawing);
    assert_found(&place, &[]);
    for (clamp, found) in [("20,8 30,8", 1), ("20,10 30,10", 0)] {
        let edited = drawing.replace("20,10 30,10", clamp);
        fs::write(place.path().join("1234.1P.dxf"), dxf(&edited)).unwrap();
        for command in ["check .", "emit ."] {
            let run = place.run(&format!("{command} --format concise"));
            let hits = codes(&run).iter().filter(|code| *code == "407").count();
            assert_eq!(hits, found, "{run}");
        }
    }
}

#[test]
fn a_clamp_that_is_not_clear_stops_its_paths() {
    let drawing = path("21", "mill 0,0 9,0\nend 9,0");
    assert_found(&place(&drawing.replace("Z20", "20")), &["117"]);
    assert_found(&place(&drawing.replace(" closed", "")), &["117"]);
    assert_found(&place(&drawing.replace("layer clamps", "layer clamp")), &[]);
    // Neither the drawing nor a project that embeds it is written.
    let project = "layer 8001.1P\nstart 0,0 \"T5 O2 S21 MAl\"\nsubpath 0,0 9,0 \">1234.1P\"\nend 9,0\n";
    let place = place(&drawing.replace("Z20", "20")).file("8001.1P.dxf", dxf(project));
    assert_eq!(codes(&place.run("emit 8001.1P.dxf --search . --format concise")), ["117", "511"]);
    assert!(!place.path().join("8001.1P_Milling.gcode").exists());
}

#[test]
fn a_layer_that_is_both_is_a_wrong_configuration() {
    let place = place(&path("21", "mill 0,0 9,0\nend 9,0"));
    fs::write(place.path().join("pathbuild.toml"), OPTIONS.replace("clamps?", "1234.*")).unwrap();
    assert_found(&place, &["003", "119"]);
    fs::write(place.path().join("pathbuild.toml"), OPTIONS.replace("clamps?", "(")).unwrap();
    assert!(place.run("check .").stderr.contains("PB003"));
}

/// A component that mills 9 mm, with a clamp beside it from (2, 3) to (7, 8).
const COMPONENT: &str = "layer 1234.1P\nstart 0,0 \"T5 O2 I5 B0 S21 MAl\"\nmill 0,0 9,0\nend 9,0\nlayer clamps\n\
    polyline 2,3 7,3 7,8 2,8 closed\ntext 2.5,4 \"Z20\" height 2\n";

fn embedding(project: &str) -> Place {
    let cut = if project.contains("mill ") { " I5 B0" } else { "" };
    Place::new()
        .file("pathbuild.toml", OPTIONS)
        .file("1234.1P.dxf", dxf(COMPONENT))
        .file("8001.1P.dxf", dxf(&format!("layer 8001.1P\nstart 0,0 \"T5 O2{cut} S22 MAl\"\n{project}")))
}

/// The clamps of a component are moved, rotated and raised with it, and affect the whole program.
#[test]
fn clamps_of_components_lie_where_they_are_embedded() {
    // The component is embedded upwards from (20, 0), so its clamp is from (12, 2) to (17, 7).
    let project = |y: &str, more: &str| {
        format!(
            "sweep 0,0 20,0\nsubpath 20,0 20,9 \">1234.1P{more}\"\nsweep 20,9 30,9\nsweep 30,9 30,{y}\n\
             mill 30,{y} 0,{y}\nend 0,{y}\n"
        )
    };
    for (project, expected) in
        [(project("1", ""), 0), (project("1.01", ""), 1), (project("8", ""), 0), (project("7.99", ""), 1)]
    {
        let place = embedding(&project);
        for command in ["check . ", "check 8001.1P.dxf", "emit 8001.1P"] {
            let run = place.run(&format!("{command} --format concise"));
            assert_eq!(codes(&run).len(), expected, "{run}");
            assert!(codes(&run).iter().all(|code| code == "407"), "{run}");
            let place = "8001.1P.dxf:";
            assert!(expected == 0 || format!("{run}").contains(place), "{run}");
            let clamp =
                "the clamp of layer clamps from 1234.1P.dxf at (17, 2) of this drawing, which is 20 mm high";
            assert!(expected == 0 || format!("{run}").contains(clamp), "{run}");
        }
    }
    // Raised by 2 mm, the clamp is higher than S.
    let over = |height: &str| {
        project("8", height)
            .replace("mill 30,8 0,8", "sweep 30,8 30,5\nsweep 30,5 0,5")
            .replace("end 0,8", "end 0,5")
    };
    assert_eq!(codes(&embedding(&over(" H2")).run("check 8001.1P.dxf --format concise")), [] as [&str; 0]);
    assert_eq!(codes(&embedding(&over(" H2.01")).run("check 8001.1P.dxf --format concise")), ["407"]);
}

/// A component that hits its own clamp is reported once, however often it is embedded.
#[test]
fn a_fault_within_a_component_is_said_once() {
    let project = "sweep 0,0 20,0\nsubpath 20,0 20,9 \">1234.1P\"\nsweep 20,9 50,9\nsubpath 50,9 50,18 \">1234.1P\"\nend 50,18\n";
    let place = embedding(project).file("1234.1P.dxf", dxf(&COMPONENT.replace("2,3 7,3", "2,0.5 7,0.5")));
    let run = place.run("check . --format concise");
    assert_eq!(codes(&run), ["407"], "{run}");
    assert!(run.stderr.contains("1234.1P.dxf:"), "{run}");
}

/// Heights refer to the drawing that the finding names, regardless of H.
#[test]
fn a_fault_within_a_component_has_the_components_heights() {
    let place = embedding("sweep 0,0 20,0\nsubpath 20,0 20,9 \">1234.1P H1\"\nend 20,9\n")
        .file("1234.1P.dxf", dxf(&COMPONENT.replace("2,3 7,3", "2,0.5 7,0.5")));
    let run = place.run("check 8001.1P.dxf --format concise");
    assert!(run.stderr.contains("which is 20 mm high: cut, lowest Z 0, moves: 1"), "{run}");
    assert_eq!(codes(&run), ["407"], "{run}");
}

/// A component has a sweep height of its own, whatever that of the project.
#[test]
fn the_path_that_must_sweep_higher_is_named() {
    let component = "layer 1235.1P\nstart 0,0 \"T5 O2 I5 B0 MAl\"\nmill 0,0 5,0\nsweep 5,0 15,0\n\
        mill 15,0 20,0\nend 20,0\n";
    let help = |height: &str, own: &str| {
        let project = format!(
            "sweep 0,0 20,0\nsubpath 20,0 40,0 \">1235.1P{height}\"\nend 40,0\nlayer clamps\n\
             polyline 29,-1 31,-1 31,1 29,1 closed\ntext 30,0 \"Z20\" height 0.5\n"
        );
        let component = component.replace("MAl", &format!("MAl{own}"));
        let place = embedding(&project).file("1235.1P.dxf", dxf(&component));
        let run = place.run("check 8001.1P.dxf");
        run.stderr.lines().find(|line| line.contains("help: ")).map(str::to_owned)
    };
    for (height, own, expected) in
        [("", "", Some("20")), (" H2", "", Some("18")), ("", " S20", None), (" H2", " S17.9", Some("18"))]
    {
        let expected = expected.map(|height| format!("give path 1235.1P an S of {height} or more"));
        let help = help(height, own);
        assert_eq!(help.is_some(), expected.is_some(), "{height} {own}: {help:?}");
        assert!(help.unwrap_or_default().contains(&expected.unwrap_or_default()), "{height} {own}");
    }
}

/// The emitted path may have a greater O than the paths that it embeds.
#[test]
fn the_largest_cutter_of_a_program_keeps_away() {
    let component = "layer 1235.1P\nstart 0,0 \"T5 O6 I5 B0 S21 MAl\"\nmill 0,0 40,0\nend 40,0\n";
    let found = |y: &str| {
        let project = format!("sweep 0,0 0,{y}\nsubpath 0,{y} 40,{y} \">1235.1P O6\"\nend 40,{y}\n{CLAMP}");
        // Only a program in compatible mode may have two cutters.
        let place = embedding(&project)
            .file("1235.1P.dxf", dxf(component))
            .file("pathbuild.toml", format!("compatible = true\n{OPTIONS}"));
        let run = place.run("check 8001.1P.dxf --format concise");
        let is_met = run.stderr.contains("the tool, O6, hits");
        assert!(run.stderr.contains("PB506") && is_met == run.stderr.contains("PB407"), "{run}");
        is_met
    };
    assert!(!found("7"));
    assert!(found("7.01"));
}

/// Polylines, which PathDxf2GCode ignores in paths, are nevertheless outlines of clamps.
#[test]
fn clamps_are_of_all_curves_in_compatible_mode_too() {
    let place = place(&path("21", "mill 0,0 0,15\nmill 0,15 50,15\nend 50,15"));
    fs::write(place.path().join("pathbuild.toml"), format!("compatible = true\n{OPTIONS}")).unwrap();
    assert_found(&place, &["407"]);
}

/// A program that is written through a post is checked for clamps like the native one, by `emit` and by `verify`.
#[test]
fn posts_and_verify_know_clamps() {
    let drawing = path("21", "mill 0,0 0,8\nmill 0,8 50,8\nend 50,8");
    let place = place(&drawing);
    for options in ["", "--post grbl"] {
        let program = "1234.1P_Milling.gcode";
        let emitted = place.run(&format!("emit 1234.1P {options}"));
        assert_eq!(emitted.status, Some(0), "{emitted}");
        let verified = place.run(&format!("verify {program} --against 1234.1P.dxf --format concise"));
        assert_eq!(verified.status, Some(0), "{verified}");
        // One line of the program now goes through the clamp.
        let moved = place.read(program).replace("Y8.0", "Y12.0");
        fs::write(place.path().join("moved.nc"), moved).unwrap();
        let verified = place.run("verify moved.nc --against 1234.1P.dxf --format concise");
        assert!(codes(&verified).contains(&"407".to_owned()), "{verified}");
    }
    fs::write(place.path().join("1234.1P.dxf"), dxf(&drawing.replace(" 50,8", " 50,12"))).unwrap();
    for options in ["", "--post grbl", "-o -"] {
        let refused = place.run(&format!("emit 1234.1P {options} --format concise"));
        assert!(refused.status == Some(1) && codes(&refused).contains(&"407".to_owned()), "{refused}");
    }
}

/// Joined paths are milled in one set-up, so all clamps are on the table.
#[test]
fn clamps_of_one_drawing_hold_for_joined_paths_of_others() {
    let cut = |y: &str, sweep: &str, thickness: &str| {
        dxf(&format!(
            "layer 1300.1P\nstart 0,0 \"T{thickness} O2 I5 B0 S{sweep} MAl\"\nmill 0,0 0,{y}\nmill 0,{y} 50,{y}\nend 50,{y}"
        ))
    };
    let emit = |y: &str, sweep: &str, thickness: &str| {
        let place =
            place(&path("21", "mill 0,0 10,0\nend 10,0")).file("1300.1P.dxf", cut(y, sweep, thickness));
        let run = place.run("emit 1234.1P 1300.1P --join both --post linuxcnc --format concise");
        assert_eq!(place.path().join("both_Milling.ngc").exists(), run.status == Some(0), "{run}");
        run
    };
    let hit = emit("9.01", "21", "5");
    assert_eq!(codes(&hit), ["407"], "{hit}");
    assert!(hit.stderr.contains("in 1234.1P.dxf, which lies at (20, 10) in the program and is 20 mm high: cut, lowest Z 0, moves: 1"), "{hit}");
    assert_eq!(codes(&emit("9", "21", "5")), [""; 0]);
    // All rapid moves between the paths are at the greater S.
    assert_eq!(codes(&emit("9", "10", "5")), [""; 0]);
    let thicker = emit("9", "21", "6");
    // In the thicker sheet, the rapid moves down to the thinner one go into the material.
    assert_eq!(codes(&thicker), ["741", "211"], "{thicker}");
    assert!(thicker.stderr.contains("1300.1P.dxf") && thicker.stderr.contains("path 1300.1P"), "{thicker}");
}

#[test]
fn joined_paths_of_different_materials_are_doubtful() {
    let emit = |material: &str, paths: &str| {
        let other = format!("layer 1300.1P\nstart 0,0 \"T5 O2 I5 B0 S21{material}\"\nmill 0,0 9,0\nend 9,0");
        let place = place(&path("21", "mill 0,0 10,0\nend 10,0")).file("1300.1P.dxf", dxf(&other));
        place.run(&format!("emit {paths} --join both --post linuxcnc --format concise"))
    };
    assert_eq!(codes(&emit(" MAl", "1234.1P 1300.1P")), [""; 0]);
    assert_eq!(codes(&emit("", "1234.1P 1300.1P")), [""; 0]);
    let differing = emit(" MSteel", "1234.1P 1300.1P");
    assert_eq!(codes(&differing), ["211"], "{differing}");
    assert!(differing.stderr.contains("M is Steel here, but Al in path 1234.1P"), "{differing}");
    let twice = emit(" MAl", "1300.1P 1234.1P 1300.1P");
    assert_eq!(codes(&twice), ["211"], "{twice}");
    assert!(twice.stderr.contains("path 1300.1P is joined with itself"), "{twice}");
}

#[test]
fn rapids_between_joined_paths_avoid_clamps() {
    let emit = |sweep: &str| {
        let first = path(sweep, "mill 0,0 0,15\nmill 0,15 -5,15\nend -5,15");
        let far = format!(
            "layer 1300.1P\nstart 0,0 \"T5 O2 I5 B0 S{sweep} MAl\"\nmill 0,0 0,-5\nmill 0,-5 50,-5\nmill 50,-5 50,30\nend 50,30"
        );
        let place = place(&first).file("1300.1P.dxf", dxf(&far));
        place.run("emit 1300.1P 1234.1P --join both --post linuxcnc --format concise")
    };
    let hit = emit("19.99");
    assert_eq!(codes(&hit), ["407"], "{hit}");
    assert!(hit.stderr.contains("rapid move, lowest Z 19.99, moves: 1"), "{hit}");
    assert_eq!(codes(&emit("20")), [""; 0]);
}

/// Without `keep-out`, clamps are not searched for, so a script that requires this check must not pass.
#[test]
fn clamps_are_checked_only_if_their_layers_are_configured() {
    let drawing = path("20", "mill 0,0 10,0\nend 10,0");
    let run = |options: &str| {
        let place = Place::new().file("pathbuild.toml", options).file("1234.1P.dxf", dxf(&drawing));
        assert_eq!(place.run("emit 1234.1P").status, Some(0));
        place.run("verify 1234.1P_Milling.gcode --against 1234.1P --require clamps")
    };
    let with_key = run(OPTIONS);
    assert!(with_key.status == Some(0) && with_key.stderr.contains(", clamps"), "{with_key}");
    let without = run(&OPTIONS.replace("keep-out = 'clamps?'\n", ""));
    assert!(without.status == Some(1) && codes(&without) == ["523"], "{without}");
    assert!(without.stderr.contains("clamps (keep-out in pathbuild.toml)"), "{without}");
}

/// The comparison stopped at a move whose difference is accepted, so the remaining moves were not compared.
#[test]
fn a_comparison_that_stopped_does_not_count_as_made() {
    let options = format!("{OPTIONS}[severity]\nPB739 = \"ignore\"\n");
    let drawing = path("20", "mill 0,0 10,0\nmill 10,0 10,5\nend 10,5");
    let place = Place::new().file("pathbuild.toml", options).file("1234.1P.dxf", dxf(&drawing));
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let verify = "verify 1234.1P_Milling.gcode --against 1234.1P --require drawing";
    assert_eq!(place.run(verify).status, Some(0));
    let text = place.read("1234.1P_Milling.gcode");
    let place = place.file("1234.1P_Milling.gcode", text.replace("X10.000", "X11.000"));
    let run = place.run(verify);
    assert!(run.status == Some(1) && codes(&run).contains(&"523".to_owned()), "{run}");
}

/// A single drawing need not have clamps, but a pattern that matches no layer of the whole library is probably wrong.
#[test]
fn a_pattern_that_matches_no_layer_of_the_library_is_doubtful() {
    let path = |name: &str, others: &str| {
        dxf(&format!("layer {name}\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n{others}"))
    };
    let clamp = "layer Spanner\nmill circle 90,90 d 9\ntext 90,90 \"Z25\" height 2 align centre middle";
    let place = |configuration: &str, others: &str| {
        Place::new()
            .file("pathbuild.toml", format!("library = [\".\"]\n{configuration}"))
            .file("1234.1P.dxf", path("1234.1P", "layer Other\nmill circle 90,90 d 9"))
            .file("1234.2P.dxf", path("1234.2P", others))
    };
    let found = |place: &Place, arguments: &str| {
        let run = place.run(&format!("{arguments} --format concise"));
        let found = run.stderr.lines().filter(|line| line.contains("[PB527]"));
        found.map(|line| line.split('`').nth(1).unwrap().to_owned()).collect::<Vec<_>>()
    };
    let both = "keep-out = 'Spanner'\npart = 'Teil'\n";
    let without = place(both, "");
    let with_clamps = place(both, clamp);
    for arguments in ["check --no-cache", "check", "check"] {
        assert_eq!(found(&without, arguments), ["keep-out", "part"], "{arguments}");
        assert_eq!(found(&with_clamps, arguments), ["part"], "{arguments}");
    }
    assert_eq!(found(&without, "check ."), [""; 0], "a directory");
    assert_eq!(found(&without, "check 1234.1P.dxf"), [""; 0], "a drawing");
    assert_eq!(found(&place("", ""), "check"), [""; 0], "no patterns");
    let unread = place(both, "").file("1234.3P.dxf", "nothing");
    assert_eq!(found(&unread, "check"), [""; 0], "another drawing may have such layers");
}
