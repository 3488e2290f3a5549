//! Tests tool, tool length and spindle in the output of definitions, each with a correct definition and one with a single mistake.

use pathbuild_diagnostic::{Code, Diagnostic, Lang};
use pathbuild_motion::{Coolant, Turning};
use pathbuild_post::{Job, Operation, PostOptions};

use crate::support::{definition, feed, operation, rapid, read, read_toml};

/// A definition for a control with M6 and G43.
const RIGHT: &str = "<Dialect>linuxcnc</Dialect>
<PostFile>G17 {$units} G90 G94 G40 G49 G80
{$mops}
{$clearance}
M5
M30</PostFile>
<ToolChange>{$clearance}
M5
T{$tool.index} M6
G43 H{$tool.index}</ToolChange>
<MOP>{$toolchange}
{$clearance}
{$spindle} {$s}
{$blocks}</MOP>
<EndOfLine>\\n</EndOfLine>";

/// Returns a job for T1 at 9000 1/min and T2 at 3000 1/min.
fn two_tools() -> Job {
    let milled = |tool, x, speed| {
        let steps =
            vec![rapid(x, 0.0, 5.0), feed(x, 0.0, -1.0), feed(x + 9.0, 0.0, -1.0), rapid(x + 9.0, 0.0, 5.0)];
        let (spindle, speed) = (Some(Turning::Clockwise), Some(speed));
        Operation { spindle, speed, ..operation("mill", tool, steps) }
    };
    let second = Operation { entry: pathbuild_post::Entry::Clearance, ..milled(2, 20.0, 3000.0) };
    Job { name: "part".into(), operations: vec![milled(1, 0.0, 9000.0), second], ..Job::default() }
}

/// Returns the findings about the output of a definition.
fn wrong(text: &str, job: &Job) -> Vec<String> {
    let found = read(&definition(text)).unwrap().write(job, &PostOptions::default());
    let text = |problem: &Diagnostic| match problem.notes.first() {
        Some(note) if problem.code().to_string() == "PB767" => note.text(Lang::En),
        _ => format!("{} {}", problem.code(), problem.text(Lang::En)),
    };
    found.err().unwrap_or_default().iter().map(text).collect()
}

#[track_caller]
fn changed(from: &str, to: &str) -> Vec<String> {
    assert!(RIGHT.contains(from));
    wrong(&RIGHT.replace(from, to), &two_tools())
}

const FINE: [&str; 0] = [];

#[test]
fn each_cut_has_its_own_tool() {
    assert_eq!(wrong(RIGHT, &two_tools()), FINE);
    assert_eq!(
        changed("T{$tool.index} M6", "T1 M6")[0],
        "the output makes this cut with T1, but the program uses T2"
    );
    assert_eq!(
        changed("T{$tool.index} M6", "M6")[0],
        "the output has not changed to T1, with which the program makes this cut"
    );
    // Without M6, the program must also stop for the operator, because T alone does not change the tool.
    assert_eq!(changed("T{$tool.index} M6", "T{$tool.index}\nM0\n{$set(z,NaN)}"), FINE);
    let alone = changed("T{$tool.index} M6", "T{$tool.index}");
    assert!(alone[0].starts_with("T alone does not change the tool"), "{alone:?}");
    // A switch at the machine decides whether the program stops at M1, and at a line that begins with `/`.
    for stop in ["M1", "/M0"] {
        let optional = changed("T{$tool.index} M6", &format!("T{{$tool.index}}\n{stop}\n{{$set(z,NaN)}}"));
        assert!(optional[0].starts_with("T alone does not change the tool"), "{stop}: {optional:?}");
        let without_t = changed("T{$tool.index} M6\nG43 H{$tool.index}", &format!("{stop}\n{{$set(z,NaN)}}"));
        assert!(without_t[0].starts_with("the output has not changed to T2"), "{stop}: {without_t:?}");
    }
    let haas = RIGHT.replace("linuxcnc", "haas").replace("T{$tool.index} M6", "T{$tool.index}");
    assert!(wrong(&haas, &two_tools())[0].starts_with("T alone does not change the tool"));
    let turret = RIGHT.replace("linuxcnc", "fanuc").replace("T{$tool.index} M6", "T{$tool.index}");
    assert_eq!(wrong(&turret, &two_tools()), FINE, "a control may change the tool at T");
    // Without any T, the program must stop for the operator.
    let by_hand = |change: &str| changed("T{$tool.index} M6\nG43 H{$tool.index}", change);
    assert_eq!(by_hand("M0\n{$set(z,NaN)}"), FINE);
    assert_eq!(by_hand("")[0], "the output has not changed to T2, with which the program makes this cut");
}

#[test]
fn each_cut_has_the_length_of_its_tool() {
    assert_eq!(changed("H{$tool.index}", "H1"), ["the tool length in effect here is not that of T2"]);
    assert_eq!(changed("G43 H{$tool.index}", "G43"), FINE);
    assert_eq!(changed("G43 H{$tool.index}", ""), FINE);
    // G43 H0 cancels the length that the control needs for the tool.
    let cancelled = ["the tool length in effect here is not that of T1"];
    assert_eq!(changed("H{$tool.index}", "H0"), cancelled);
    assert_eq!(changed("{$clearance}\nM5\nT", "{$clearance}\nG43 H0\nM5\nT"), FINE, "before the change");
    assert_eq!(changed("{$blocks}", "G49\n{$blocks}"), ["the tool length in effect here is not that of T1"]);
}

#[test]
fn each_rapid_move_that_states_z_has_the_length_of_its_tool() {
    let other = "for the Z of this rapid move, the length H2 applies, but T1 is in the spindle";
    let before = "G43 H{$tool.index} G0 Z5.0\nM5\nT{$tool.index} M6";
    let found = changed("M5\nT{$tool.index} M6\nG43 H{$tool.index}", before);
    assert!(found.len() == 1 && found[0].starts_with(other), "{found:?}");
    let later = "T{$tool.index} M6\nG43 H7 G0 Z5.0\nG43 H{$tool.index}";
    assert_eq!(changed("T{$tool.index} M6\nG43 H{$tool.index}", later).len(), 2, "once for each tool");
    let without_z = "G43 H{$tool.index}\nM5\nT{$tool.index} M6";
    assert_eq!(changed("M5\nT{$tool.index} M6\nG43 H{$tool.index}", without_z), FINE);
}

#[test]
fn each_cut_has_the_speed_of_its_tool() {
    let other = |found| [format!("the spindle speed is {found} here, but 3000 in the program")];
    assert_eq!(changed("{$s}", "S9000"), other("9000"));
    let mut job = two_tools();
    job.operations[1].speed = Some(9000.5);
    assert_eq!(wrong(&RIGHT.replace("{$s}", "S9000"), &job), FINE, "rounded to a whole number");
    job.operations[1].speed = Some(9000.6);
    assert_eq!(wrong(&RIGHT.replace("{$s}", "S9000"), &job).len(), 1);
    assert!(changed("{$spindle} {$s}", "M4 {$s}")[0].contains("opposite"));
}

#[test]
fn the_spindle_stands_where_the_operator_changes_the_tool() {
    let by_hand = |change: &str| changed("M5\nT{$tool.index} M6\nG43 H{$tool.index}", change);
    assert_eq!(by_hand("M5\nM0\n{$set(z,NaN)}"), FINE);
    let spinning = "the spindle still turns where the program stops for the tool change";
    assert_eq!(by_hand("M0\n{$set(z,NaN)}"), [spinning]);
    assert!(by_hand("T{$tool.index}\nM0\n{$set(z,NaN)}")[0].contains(spinning));
    // A tool changer stops the spindle itself.
    assert_eq!(changed("M5\nT{$tool.index} M6", "T{$tool.index} M6"), FINE);
    assert_eq!(changed("{$blocks}", "M0\n{$blocks}"), FINE, "a pause after the change");
    // The program pauses, but the tool stays the same.
    let mut job = two_tools();
    job.operations[1].tool = job.operations[0].tool.clone();
    assert_eq!(wrong(&RIGHT.replace("{$blocks}", "M0\n{$blocks}"), &job), FINE);
}

#[test]
fn what_verify_warns_of_is_a_warning_about_the_output() {
    let warnings = |head: &str| {
        let written = read(&definition(&RIGHT.replace("{$mops}", &format!("{head}\n{{$mops}}")))).unwrap();
        let output = written.write(&two_tools(), &PostOptions::default());
        let warnings = output.unwrap_or_else(|errors| panic!("{head}: {errors:?}")).warnings;
        warnings.iter().map(|warning| warning.code().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(warnings("M7"), FINE);
    assert_eq!(warnings("/M7"), ["PB711"], "a warning of the reader");
    assert_eq!(warnings("G53 G0 Z0\nG53 G0 X-9 Y0"), FINE);
    assert_eq!(warnings("G53 G0 X-9 Y0"), ["PB742"], "a rule about the effects of words");
}

#[test]
fn the_height_is_stated_after_a_tool_change_by_hand() {
    let by_hand = |change: &str| changed("T{$tool.index} M6\nG43 H{$tool.index}", change);
    let unstated = "after a stop for a tool change or a new zero, the program moves in X or Y";
    // The operator changes the tool at a stop, with or without a T word beside it.
    for stop in ["M0", "T{$tool.index}\nM0", "M0\nT{$tool.index}"] {
        assert_eq!(by_hand(&format!("{stop}\n{{$set(z,NaN)}}")), FINE, "{stop}");
        let found = by_hand(stop);
        assert!(!found.is_empty() && found.iter().all(|found| found.contains(unstated)), "{stop}: {found:?}");
    }
}

/// Returns the findings about the output of a definition whose rapid moves always state X, Y and Z.
fn aslant(change: &str) -> Vec<String> {
    let text = format!(
        "[post]\ndialect = \"linuxcnc\"\nnumber-lines = false\n[text]\nprogram-start = 'G17 G21 G90 G94 G40 G49 G80'
tool-change = \"\"\"\nM05\n{change}\nS{{#~MillingSpindleRate~}} M03\n\"\"\"
rapid = 'G00 X{{.~X1~}} Y{{.~Y1~}} Z{{.~Z1~}}'
line = 'G01 X{{.~X1~}} Y{{.~Y1~}} Z{{.~Z1~}} F{{#~MovingVel~}}'
program-end = \"\"\"\nM05\nM30\n\"\"\"\n"
    );
    let found = match read_toml(&text).write(&two_tools(), &PostOptions::default()) {
        Ok(output) => output.warnings,
        Err(errors) => errors,
    };
    let text = |found: &Diagnostic| {
        let text = found.notes.first().filter(|_| found.code() == Code::PostDiffers);
        text.map_or_else(|| found.text(Lang::En), |note| note.text(Lang::En))
    };
    found.iter().map(|found| format!("{:?}: {}", found.severity, text(found))).collect()
}

/// A move in X, Y and Z begins at the height of the tool change, or at the unknown one before the program.
#[test]
fn a_move_in_x_y_and_z_needs_a_height_before_it() {
    let change = "T{#~MachineToolNo~} M06";
    assert_eq!(aslant(&format!("{change}\nG00 Z{{.~ZClearance~}}")), FINE);
    let first = aslant(change);
    assert!(first.len() == 1 && first[0].starts_with("Warning: the first move in the plane"), "{first:?}");
    assert_eq!(aslant(&format!("G53 G00 Z0\n{change}")), FINE, "raised to a machine position");
    for stop in ["T{#~MachineToolNo~} M00", "M00"] {
        assert_eq!(aslant(&format!("{stop}\nG00 Z{{.~ZClearance~}}")), FINE, "{stop}");
        let found = aslant(stop);
        let unstated = "Error: after a stop for a tool change or a new zero, the program moves in X or Y";
        assert!(found.len() == 1 && found[0].starts_with(unstated), "{stop}: {found:?}");
    }
}

/// Flood and mist may have the same word, so only whether coolant flows is compared.
#[test]
fn each_cut_has_the_coolant_of_its_tool() {
    let [flood, mist, off] = [Coolant::FLOOD, Coolant::MIST, Coolant::OFF];
    let found = |dialect: &str, coolant: [Coolant; 2], elements: &str, text: &str| {
        let mut job = two_tools();
        job.operations.iter_mut().zip(coolant).for_each(|(operation, coolant)| {
            operation.coolant = Some(coolant);
        });
        let right = RIGHT.replace("<Dialect>linuxcnc</Dialect>", dialect);
        let text = format!("{}{elements}", right.replace("{$blocks}", &format!("{text}{{$blocks}}")));
        let output = read(&definition(&text)).unwrap().write(&job, &PostOptions::default());
        match output {
            Ok(output) => output.warnings.iter().map(|warning| warning.text(Lang::En)).collect(),
            Err(_) => wrong(&text, &job),
        }
    };
    let own = "{$coolant}\n";
    for dialect in ["<Dialect>linuxcnc</Dialect>", ""] {
        let found = |coolant, elements: &str, text: &str| found(dialect, coolant, elements, text);
        assert_eq!(found([flood, mist], "", own), FINE);
        assert_eq!(found([flood, mist], "<CoolantMist>M8</CoolantMist>", own), FINE);
        let dry = found([flood, mist], "<CoolantMist>M9</CoolantMist>", own);
        assert!(dry[0].starts_with("the coolant is off during this cut"), "{dry:?}");
        let never_off = "<CoolantOff></CoolantOff>";
        assert!(found([flood, off], never_off, own)[0].starts_with("the coolant is on during this cut"));
        assert_eq!(found([flood, mist], never_off, own), FINE);
        for flood_word in ["M9", "", "M50"] {
            let elements = format!("<CoolantFlood>{flood_word}</CoolantFlood>");
            let warnings = found([flood, flood], &elements, own);
            assert!(warnings.iter().any(|text| text.contains("neither M7 nor M8")), "{warnings:?}");
        }
        assert_eq!(found([flood, off], "", ""), FINE, "a note says that the post does not follow it");
        assert_eq!(found([flood, flood], "", "M8\n"), FINE);
    }
}

/// S belongs to the layer that M06 has selected before it.
#[test]
fn each_layer_of_xpertmill_has_its_own_speed() {
    let definition = include_str!("../../posts/xpertmill.toml");
    let written = |from: &str, to: &str| {
        assert!(definition.contains(from));
        let found =
            read_toml(&definition.replace(from, to)).write(&two_tools(), &PostOptions::default()).err()?;
        Some(found[0].notes[0].text(Lang::En))
    };
    let speed = "{!MillingSpindleRate {$}{$S{#~MillingSpindleRate~}}}\n";
    let change = format!("M06 {{02d ~MachineToolNo~}}\n{speed}");
    assert_eq!(written(&change, &change), None);
    for wrong in [change.replace(speed, ""), format!("{speed}M06 {{02d ~MachineToolNo~}}\n")] {
        assert!(written(&change, &wrong).unwrap().starts_with("the spindle speed is"), "{wrong}");
    }
    let mut job = two_tools();
    job.operations.iter_mut().for_each(|operation| operation.speed = None);
    let without = read_toml(&definition.replace(speed, "")).write(&job, &PostOptions::default());
    assert!(without.is_ok(), "{:?}", without.err());
}
