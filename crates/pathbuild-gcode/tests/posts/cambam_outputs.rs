//! Programs that CamBam wrote, read and written again with our engine, come out byte for byte. (/work/shared/cambam-output)

use camino::Utf8Path;
use pathbuild_gcode::post::{
    Arc, Hole, HoleKind, Job, Operation, Position, Post, PostOptions, Spindle, Step, Tool, Units,
    VelocityMode,
};

use crate::support::shared;

/// A reader for the few forms that CamBam's programs have: one move a line, coordinates as they change.
struct Reader {
    job: Job,
    /// In mm.
    unit: f64,
    at: [Option<f64>; 3],
    feed: Option<f64>,
    retract: f64,
    velocity: VelocityMode,
    tools: Vec<Tool>,
    /// Behind the last operation's end comment; what follows is the footer's.
    is_over: bool,
}

fn read(text: &str, name: &str) -> Job {
    let unit = if text.contains("\nG20 ") { 25.4 } else { 1.0 };
    let job = Job { name: name.into(), ..Job::default() };
    let velocity = VelocityMode::ConstantVelocity;
    let (at, tools) = ([None; 3], Vec::new());
    let mut reader = Reader { job, unit, at, feed: None, retract: 0.0, velocity, tools, is_over: false };
    if unit > 1.0 {
        reader.job.units = Units::Inches;
    }
    text.lines().for_each(|line| reader.line(line.trim()));
    reader.job
}

impl Reader {
    fn line(&mut self, line: &str) {
        match line.strip_prefix('(') {
            Some(comment) => self.comment(comment.trim_end_matches(')').trim()),
            None => self.code(line),
        }
    }

    fn comment(&mut self, text: &str) {
        if let Some((index, diameter)) = tool_comment(text) {
            self.tools.push(Tool::new(index, diameter * self.unit, ""));
        } else if text.starts_with("MOP End") {
            self.is_over = true;
        } else if let Some(clearance) = self.at[2] {
            self.is_over = false;
            let tool = self.tools.last().unwrap().clone();
            let mut operation = Operation::new(text.trim_start_matches("MOP Start: "), tool);
            operation.clearance = self.job.operations.last().map_or(clearance, |last| last.clearance);
            operation.velocity = self.velocity;
            operation.spindle = Some(Spindle::Clockwise);
            self.job.operations.push(operation);
        }
    }

    fn code(&mut self, line: &str) {
        let number =
            |letter: char| line.split(' ').find_map(|word| word.strip_prefix(letter)?.parse::<f64>().ok());
        if line.contains("G61") {
            self.velocity = VelocityMode::ExactStop;
        }
        let before = self.at;
        let unit = self.unit;
        let length = |letter| number(letter).map(|value| value * unit);
        self.at = [length('X').or(before[0]), length('Y').or(before[1]), length('Z').or(before[2])];
        self.feed = length('F').or(self.feed);
        self.retract = length('R').unwrap_or(self.retract);
        let (to, feed, level) = (Position::from(self.at), self.feed, before[2]);
        let arc = |clockwise| {
            let from = before.map(Option::unwrap);
            let centre = [from[0] + length('I').unwrap(), from[1] + length('J').unwrap(), 0.0];
            Step::Arc(Arc { clockwise, from, centre, to: self.at.map(Option::unwrap), feed })
        };
        let step = match line.split(' ').next() {
            Some("G0") => Step::Rapid { to },
            Some("G1") => Step::Feed { to, feed },
            Some("G2") => arc(true),
            Some("G3") => arc(false),
            Some("G81") => self.hole(level.unwrap()),
            _ => return self.machine(number('T'), number('S')),
        };
        if let Some(operation) = self.job.operations.last_mut().filter(|_| !self.is_over) {
            operation.steps.push(step);
        }
    }

    fn hole(&mut self, level: f64) -> Step {
        let [x, y, bottom] = self.at.map(Option::unwrap);
        self.at[2] = Some(level);
        let (at, retract) = ([x, y], self.retract);
        Step::Hole(Hole { at, level, retract, bottom, exit: level, feed: self.feed, kind: HoleKind::Plain })
    }

    fn machine(&mut self, tool: Option<f64>, speed: Option<f64>) {
        let Some(operation) = self.job.operations.last_mut() else { return };
        if let Some(tool) = tool {
            operation.tool =
                self.tools.iter().rev().find(|known| f64::from(known.index) == tool).unwrap().clone();
            // What was moved so far was the way to the tool change.
            operation.steps.clear();
        }
        operation.speed = speed.or(operation.speed);
    }
}

fn tool_comment(text: &str) -> Option<(u32, f64)> {
    let (index, diameter) = text.strip_prefix('T')?.split_once(" : ")?;
    Some((index.parse().ok()?, diameter.parse().ok()?))
}

/// The program as CamBam wrote it, and as our engine writes it; nothing where /work/shared is absent.
fn both(output: &str, definition: &str, name: &str, date: &str) -> Option<(Vec<String>, Vec<String>)> {
    let original = shared(&format!("cambam-output/{output}"))?;
    let definition = shared(&format!("posts/{definition}"))?;
    let post = Post::read(definition.as_bytes(), Utf8Path::new("post.cbpp")).unwrap();
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
    // Newer versions have one more line in the header; its macro is not documented.
    assert_eq!(original.remove(2), "( Post processor: Default )");
    assert_same(&original, &written);
}

#[test]
fn grbl_without_tool_change() {
    let file = "grbl-okkcnc-cb_simple_test.ngc";
    let Some((original, mut written)) = both(file, "grbl-okkcnc.cbpp", "simple_test", "1/9/2020 12:39:24 PM")
    else {
        return;
    };
    // The definition that is public is a little older than the one that wrote this file: it says these lines differently.
    assert_eq!(written[1..3], ["( Grbl Post Processor v 1.1)", "( modified by onekk )"]);
    written.splice(1..3, original[1..3].to_vec());
    assert_same(&original, &written);
}

#[test]
fn a_definition_with_tool_lengths() {
    let Some(default) = shared("posts/default-reconstructed.cbpp") else { return };
    let Some(original) = shared("cambam-output/g43-custom-two-tools-2012.nc") else { return };
    // The definition that wrote it is not known. It is Default with tool lengths in the tool change.
    let change = "{$clearance}\nG43 H0\n{$comment} T{$tool.index} : {$tool.diameter} {$endcomment}\nT{$tool.index} M6\nG43 H{$tool.index}</ToolChange>";
    let (before, rest) = default.split_once("<ToolChange>").unwrap();
    let (_, after) = rest.split_once("</ToolChange>").unwrap();
    let definition = format!("{before}<ToolChange>{change}{after}");
    let post = Post::read(definition.as_bytes(), Utf8Path::new("g43.cbpp")).unwrap();
    let options = PostOptions { date: Some("10/6/2012 2:48:24 AM".into()), ..PostOptions::default() };
    let written = post.write(&read(&original, "Untitled"), &options).unwrap();
    let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    assert_same(&lines(&original), &lines(std::str::from_utf8(&written.text).unwrap()));
}
