//! Programs that CamBam wrote are read, written by our engine, and reproduced byte for byte. (../shared/cambam-output)

use camino::Utf8Path;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_motion::Pace;
use pathbuild_post::{Job, JobStep, PostDefinition, PostOptions, Remark, Units, VelocityMode};

use crate::support::shared;

/// Converts a program of CamBam to a job. Properties that are not in its moves (diameters, units, G61) are taken from its comments.
fn read(text: &str, name: &str) -> Job {
    let interpretation = interpret(text.as_bytes(), Dialect::LinuxCnc, &Options::default());
    assert_eq!(interpretation.problems.iter().filter(|problem| problem.is_error()).count(), 0);
    let header: Vec<&str> = text.lines().map_while(comment).collect();
    let job = Job::from_steps(name, &interpretation.steps, Dialect::LinuxCnc, &|text| match text.trim() {
        text if header.contains(&text) || tool(text).is_some() => Remark::Goes,
        text if text.starts_with("MOP End: ") => Remark::End,
        text => Remark::Operation(text.trim_start_matches("MOP Start: ")),
    });
    let mut job = job.unwrap();
    if text.contains("\nG20 ") {
        job.units = Units::Inches;
    }
    let unit = if job.units == Units::Inches { 25.4 } else { 1.0 };
    for operation in &mut job.operations {
        let index = operation.tool.index;
        let of_tool = text.lines().filter_map(comment).filter_map(tool).find(|(known, _)| *known == index);
        operation.tool.diameter = of_tool.unwrap().1 * unit;
        if text.contains(" G61 ") {
            operation.velocity = VelocityMode::ExactStop;
        }
    }
    job
}

/// Returns the text of a comment line.
fn comment(line: &str) -> Option<&str> {
    line.trim().strip_prefix('(').map(|text| text.trim_end_matches(')').trim())
}

/// Returns index and diameter from a comment about a tool.
fn tool(text: &str) -> Option<(u32, f64)> {
    let (index, diameter) = text.strip_prefix('T')?.split_once(" : ")?;
    Some((index.parse().ok()?, diameter.parse().ok()?))
}

/// Returns the program as written by CamBam and as written by our engine; `None` if ../shared is absent.
fn both(output: &str, definition: &str, name: &str, date: &str) -> Option<(Vec<String>, Vec<String>)> {
    let original = shared(&format!("cambam-output/{output}"))?;
    let definition = shared(&format!("posts/{definition}"))?;
    let post = PostDefinition::read(definition.as_bytes(), Utf8Path::new("post.cbpp")).unwrap();
    let options = PostOptions { date: Some(date.into()), cycles: true, ..PostOptions::default() };
    let written = post.write(&read(&original, name), &options).unwrap();
    assert_eq!(written.warnings, []);
    let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    Some((lines(&original), lines(std::str::from_utf8(&written.text).unwrap())))
}

#[track_caller]
fn assert_comes_out_whole(output: &str, name: &str, date: &str) {
    if let Some((original, written)) = both(output, "default-reconstructed.cbpp", name, date) {
        assert_same(&original, &written);
    }
}

#[track_caller]
fn assert_same(original: &[String], written: &[String]) {
    if let Some(first) =
        (0..original.len().max(written.len())).find(|&line| original.get(line) != written.get(line))
    {
        panic!(
            "line {}: CamBam wrote {:?}, we write {:?}",
            first + 1,
            original.get(first),
            written.get(first)
        );
    }
}

#[test]
fn drilling_and_profile() {
    assert_comes_out_whole("default-drill-profile-2012.nc", "test", "6/13/2012 11:46:48 PM");
}

#[test]
fn inches() {
    assert_comes_out_whole("default-inch-engrave-2012.nc", "Untitled", "2/13/2012 2:54:50 PM");
}

#[test]
fn a_large_pocket() {
    assert_comes_out_whole("default-pine-logo-2013.nc", "inventables_logo_svg", "1/29/2013 8:10:35 PM");
}

#[test]
fn several_tools_and_exact_stop() {
    let file = "default-v1-links-new-2026.nc";
    let Some((mut original, written)) =
        both(file, "default-reconstructed.cbpp", "links-new", "9/23/2026 10:22:10 PM")
    else {
        return;
    };
    // Newer versions have an additional line in the header, whose macro is not documented.
    assert_eq!(original.remove(2), "( Post processor: Default )");
    assert_same(&original, &written);
}

#[test]
fn grbl_without_tool_change() {
    let file = "grbl-okkcnc-cb_simple_test.ngc";
    let Some((mut original, mut written)) =
        both(file, "grbl-okkcnc.cbpp", "simple_test", "1/9/2020 12:39:24 PM")
    else {
        return;
    };
    // The last retract, by the footer there, is a move of the operation here.
    let end = original.iter().position(|line| line.starts_with("(MOP End")).unwrap();
    original.swap(end, end + 1);
    // The published definition is slightly older than the one that produced this file; these lines differ.
    assert_eq!(written[1..3], ["( Grbl Post Processor v 1.1)", "( modified by onekk )"]);
    written.splice(1..3, original[1..3].to_vec());
    assert_same(&original, &written);
}

#[test]
fn a_definition_with_tool_lengths() {
    let Some(default) = shared("posts/default-reconstructed.cbpp") else { return };
    let Some(original) = shared("cambam-output/g43-custom-two-tools-2012.nc") else { return };
    // The definition that produced this file is unknown. It equals Default with tool lengths in the tool change.
    let change = "{$clearance}\nG43 H0\n{$comment} T{$tool.index} : {$tool.diameter} {$endcomment}\nT{$tool.index} M6\nG43 H{$tool.index}</ToolChange>";
    let (before, rest) = default.split_once("<ToolChange>").unwrap();
    let (_, after) = rest.split_once("</ToolChange>").unwrap();
    let definition = format!("{before}<ToolChange>{change}{after}");
    let post = PostDefinition::read(definition.as_bytes(), Utf8Path::new("g43.cbpp")).unwrap();
    let options = PostOptions { date: Some("10/6/2012 2:48:24 AM".into()), ..PostOptions::default() };
    let written = post.write(&read(&original, "Untitled"), &options).unwrap();
    let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    assert_same(&lines(&original), &lines(std::str::from_utf8(&written.text).unwrap()));
}

/// The tool is below the surface, so it must not move up and to the hole in one move.
#[test]
fn a_cycle_below_its_level_rises_in_a_move_of_its_own() {
    let before_hole = |z: &str| {
        let text =
            format!("G17 G21 G90 G94\nG0 X0 Y0 Z5\nG1 Z{z} F100\nG81 X50 Y30 Z-2 R1 F80\nG80\nG0 Z5\n");
        let steps = interpret(text.as_bytes(), Dialect::LinuxCnc, &Options::default()).steps;
        let job = Job::from_steps("a", &steps, Dialect::LinuxCnc, &|_| Remark::Stays).unwrap();
        let steps: Vec<JobStep> = job.operations.into_iter().flat_map(|operation| operation.steps).collect();
        let hole = steps.iter().position(|step| matches!(step, JobStep::Hole(_))).expect("a hole");
        match &steps[hole - 1] {
            JobStep::Move(movement) => (movement.to.at, movement.pace == Pace::Rapid),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(before_hole("-1"), ([0.0, 0.0, 1.0], true));
    assert_eq!(before_hole("1"), ([0.0, 0.0, 1.0], false), "it is at R already");
}
