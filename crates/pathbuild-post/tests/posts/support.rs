//! Jobs, definitions and files for the tests.

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_motion::{Arc, Move, MoveShape, Pace, Plane, Position};
use pathbuild_post::{Entry, Job, JobStep, Operation, Output, PostDefinition, PostOptions, Tool};

/// Reads a file of `../shared` next to the project; returns `None` if it is absent, so that the test is skipped.
pub(crate) fn shared(name: &str) -> Option<String> {
    let path = pathbuild_testkit::shared(name)?;
    #[expect(clippy::disallowed_methods, reason = "a test's own files")]
    Some(std::fs::read_to_string(path).expect("a test's own file can be read"))
}

/// Control texts as in the manual: contours have a start and an end, and there is no text for rapids.
pub(crate) const DIN: &str = r"[post]
number-lines = false
[text]
program-start = 'G17 G21 G90'
comment = '(~CommentText~)'
tool-change = '''
(tool ~ToolName~ ~PathName~ ~SourceFile~ ~PrgName~)
T{#~MachineToolNo~} S{#~MillingSpindleRate~} {?~MillingSpindleDir~{$M04}{$M03}}
G00 Z{+~ZClearance~}'''
contour-start = '''
G00 X{+~X1~} Y{+~Y1~}
G00 Z{+~ZWorking~}
G01 Z{+~Z1~} F{#~LoweringVel~}'''
line = 'G01 X{+~X1~} Y{+~Y1~} Z{+~Z1~} F{#~MovingVel~}'
arc = '{?~ArcDir~{$G03}{$G02}} X{+~X1~} Y{+~Y1~} Z{+~Z1~} I{+~IRel~} J{+~JRel~} F{#~MovingVel~}'
contour-end = 'G00 Z{+~ZClearance~}'
program-end = 'M30'
";

/// Returns real definitions with their names, if ../shared contains them.
pub(crate) fn real_definitions() -> Vec<(String, String)> {
    let names = [
        "default-reconstructed.cbpp",
        "dialog-mei-tech.cbpp",
        "grbl-okkcnc.cbpp",
        "linuxcnc-touchoff-win7.cbpp",
        "linuxcnc-touchoff.cbpp",
        "pastebin-g43-linenumbers.cbpp",
    ];
    names.iter().filter_map(|name| Some(((*name).to_owned(), shared(&format!("posts/{name}"))?))).collect()
}

/// Returns a CamBam definition with these elements.
pub(crate) fn definition(elements: &str) -> String {
    format!("<?xml version=\"1.0\"?>\n<PostProcessor Version=\"0.9.8.0\">\n{elements}\n</PostProcessor>")
}

/// Returns a CamBam definition that writes only the moves.
pub(crate) fn bare(elements: &str) -> String {
    definition(&format!(
        "<PostFile>{{$mops}}</PostFile><MOP>{{$blocks}}</MOP><EndOfLine>\\n</EndOfLine>{elements}"
    ))
}

pub(crate) fn read(text: &str) -> Result<PostDefinition, Vec<Diagnostic>> {
    PostDefinition::read(text.as_bytes(), Utf8Path::new("test.cbpp"))
}

pub(crate) fn read_toml(text: &str) -> PostDefinition {
    PostDefinition::read(text.as_bytes(), Utf8Path::new("test.toml"))
        .unwrap_or_else(|errors| panic!("{:?}", texts(&errors)))
}

pub(crate) fn output(
    definition: &str,
    job: &Job,
    options: &PostOptions<'_>,
) -> Result<Output, Vec<Diagnostic>> {
    unchecked(&read(definition)?, job, options)
}

/// Returns the output for a job. It is read back only if a dialect is declared, for tests of texts that are not entire programs.
pub(crate) fn unchecked(
    post: &PostDefinition,
    job: &Job,
    options: &PostOptions<'_>,
) -> Result<Output, Vec<Diagnostic>> {
    let unchecked = post.dialect().is_none() && options.dialect.is_none();
    post.write(job, &PostOptions { unchecked, ..options.clone() })
}

#[track_caller]
pub(crate) fn lines(definition: &str, job: &Job) -> Vec<String> {
    lines_with(definition, job, &PostOptions::default())
}

#[track_caller]
pub(crate) fn lines_with(definition: &str, job: &Job, options: &PostOptions<'_>) -> Vec<String> {
    match output(definition, job, options) {
        Ok(output) => String::from_utf8(output.text).unwrap().lines().map(str::to_owned).collect(),
        Err(diagnostics) => panic!("{}", texts(&diagnostics).join("\n")),
    }
}

/// Returns the errors that a definition produces for a job, as `line: code text (help)`.
#[track_caller]
pub(crate) fn errors(definition: &str, job: &Job) -> Vec<String> {
    texts(&output(definition, job, &PostOptions::default()).expect_err("the post must fail"))
}

/// Formats diagnostics as `line: code text (help)`.
pub(crate) fn texts(diagnostics: &[Diagnostic]) -> Vec<String> {
    let text = |diagnostic: &Diagnostic| {
        let line = diagnostic.place.line.map_or(String::new(), |line| format!("{line}: "));
        let help = diagnostic.help(Lang::En).map_or(String::new(), |help| format!(" ({help})"));
        format!("{line}{} {}{help}", diagnostic.code(), diagnostic.text(Lang::En))
    };
    diagnostics.iter().map(text).collect()
}

/// Returns a job with one operation that begins at (0, 0, 5), on the clearance plane; the upper face of the material is at 0.
pub(crate) fn job(steps: Vec<JobStep>) -> Job {
    Job { name: "part".into(), operations: vec![operation("mill", 1, steps)], ..Job::default() }
}

pub(crate) fn operation(name: &str, tool: u32, steps: Vec<JobStep>) -> Operation {
    Operation {
        clearance: 5.0,
        retract: 1.0,
        entry: Entry::At([0.0, 0.0, 5.0]),
        steps,
        ..Operation::new(name, Tool::new(tool, 3.0, "cutter"))
    }
}

pub(crate) fn rapid(x: f64, y: f64, z: f64) -> JobStep {
    JobStep::rapid([x, y, z])
}

pub(crate) fn feed(x: f64, y: f64, z: f64) -> JobStep {
    JobStep::feed([x, y, z], Some(100.0))
}

/// Returns a move along an arc in XY.
pub(crate) fn arc(
    clockwise: bool,
    from: [f64; 3],
    centre: [f64; 2],
    to: [f64; 3],
    feed: Option<f64>,
) -> JobStep {
    let arc = Arc { plane: Plane::Xy, centre, clockwise, extra_turns: 0 };
    let pace = Pace::Feed(feed.unwrap_or_default());
    JobStep::Move(Move { from: from.into(), to: to.into(), shape: MoveShape::Arc(arc), pace, named: None })
}

/// Returns steps in which straight moves no longer state where they begin.
pub(crate) fn straight_from_anywhere(steps: &[JobStep]) -> Vec<JobStep> {
    let forget = |step: &JobStep| match step {
        JobStep::Move(it) if it.shape == MoveShape::Line => {
            JobStep::Move(Move { from: Position::default(), ..*it })
        }
        other => other.clone(),
    };
    steps.iter().map(forget).collect()
}
