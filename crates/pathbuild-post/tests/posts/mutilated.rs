//! Removes, empties and reverses each text of each definition, one at a time. Every program that is still written must contain all moves.

use std::io::Write;

use camino::Utf8Path;
use pathbuild_motion::Turning;
use pathbuild_post::{BUILT_IN, Hole, HoleKind, Job, JobStep, Language, PostDefinition, PostOptions};

use crate::support::{DIN, arc, feed, operation, rapid, real_definitions};

/// Returns a program with every kind of move, for two tools.
pub(crate) fn program() -> Job {
    let arc = |clockwise, from, [x, y, _]: [f64; 3], to| arc(clockwise, from, [x, y], to, Some(100.0));
    let hole = Hole {
        at: [40.0, 0.0],
        level: 5.0,
        retract: 1.0,
        bottom: -3.0,
        exit: 5.0,
        feed: Some(60.0),
        kind: HoleKind::Plain,
    };
    let first = vec![
        JobStep::Comment("Q: first".into()),
        rapid(0.0, 0.0, 1.0),
        feed(0.0, 0.0, -1.0),
        feed(10.0, 0.0, -1.0),
        arc(false, [10.0, 0.0, -1.0], [10.0, 10.0, 0.0], [20.0, 10.0, -1.0]),
        arc(true, [20.0, 10.0, -1.0], [30.0, 10.0, 0.0], [30.0, 20.0, -1.0]),
        rapid(30.0, 20.0, 5.0),
        rapid(40.0, 0.0, 5.0),
        JobStep::Hole(hole),
    ];
    let second = vec![
        rapid(50.0, 0.0, 5.0),
        rapid(50.0, 0.0, 1.0),
        feed(50.0, 0.0, -2.0),
        feed(50.0, 30.0, -2.0),
        rapid(50.0, 30.0, 5.0),
    ];
    let mut job = Job {
        name: "8001.1P".into(),
        operations: vec![operation("1001.1A", 1, first), operation("1002.1B", 2, second)],
        ..Job::default()
    };
    for operation in &mut job.operations {
        operation.spindle = Some(Turning::Clockwise);
        operation.speed = Some(8000.0);
        operation.plunge_feed = Some(60.0);
        operation.cut_feed = Some(100.0);
    }
    job
}

/// End points of the cuts of the program.
const CUTS: [[f64; 3]; 7] = [
    [0.0, 0.0, -1.0],
    [10.0, 0.0, -1.0],
    [20.0, 10.0, -1.0],
    [30.0, 20.0, -1.0],
    [40.0, 0.0, -3.0],
    [50.0, 0.0, -2.0],
    [50.0, 30.0, -2.0],
];

#[test]
fn no_definition_however_wrong_loses_a_move() {
    let mut definitions: Vec<(String, String)> = BUILT_IN
        .iter()
        .filter(|post| post.language != Language::Native)
        .map(|post| (format!("{}.{}", post.name, post.language.extension()), post.text.to_owned()))
        .collect();
    definitions.push(("din.toml".into(), DIN.into()));
    let built_in = definitions.len();
    definitions.extend(real_definitions());
    let (mut tried, mut written) = (0, 0);
    for (index, (name, text)) in definitions.iter().enumerate() {
        let own = output(name, text);
        assert!(own.is_some() || index >= built_in, "{name} itself");
        let is_control = Utf8Path::new(name).extension() == Some("toml");
        let variants = if is_control { texts_changed(text) } else { elements_changed(text) };
        for variant in &variants {
            tried += 1;
            let Some(text) = output(name, variant) else { continue };
            written += 1;
            assert!(has_all_cuts(&text), "{name}:\n{variant}\nwrites\n{text}");
        }
    }
    writeln!(std::io::stderr(), "{tried} variants of {} definitions, {written} written", definitions.len())
        .unwrap();
    assert!(tried >= 300 && written >= 50, "{tried} variants, {written} written");
}

fn output(name: &str, text: &str) -> Option<String> {
    let post = PostDefinition::read(text.as_bytes(), Utf8Path::new(name)).ok()?;
    let output = post.write(&program(), &PostOptions::default()).ok()?;
    Some(String::from_utf8(output.text).unwrap())
}

const SECTIONS: [&str; 55] = [
    "PostFile",
    "Header",
    "Footer",
    "ToolTableItem",
    "ToolChange",
    "MOP",
    "Rapid",
    "FeedMove",
    "ArcCW",
    "ArcCCW",
    "Drill",
    "DrillDwell",
    "DrillPeck",
    "CannedCycleStart",
    "CannedCycleEnd",
    "G0",
    "G1",
    "G2",
    "G3",
    "G81",
    "G82",
    "G83",
    "UnitsInches",
    "UnitsMM",
    "DistanceAbsolute",
    "DistanceIncremental",
    "ArcCenterAbsolute",
    "ArcCenterIncremental",
    "VelocityModeExactStop",
    "VelocityModeConstantVelocity",
    "WorkPlaneXY",
    "WorkPlaneXZ",
    "WorkPlaneYZ",
    "CutterCompOff",
    "CutterCompLeft",
    "CutterCompRight",
    "XModeDiameter",
    "XModeRadius",
    "SpindleCW",
    "SpindleCCW",
    "SpindleOff",
    "Stop",
    "Repeat",
    "EndRewind",
    "Comment",
    "EndComment",
    "StartCut",
    "EndCut",
    "CoolantFlood",
    "CoolantMist",
    "CoolantOff",
    "Dwell",
    "Probe",
    "NumberFormat",
    "Dialect",
];

/// Returns variants in which one element is removed, emptied or has its parts reversed; elements that are absent are added without content.
fn elements_changed(text: &str) -> Vec<String> {
    let mut variants = Vec::new();
    for name in SECTIONS {
        let (open, close) = (format!("<{name}>"), format!("</{name}>"));
        match (text.find(&open), text.find(&close)) {
            (Some(start), Some(end)) => {
                let inside = &text[start + open.len()..end];
                let around = |inside: &str| format!("{}{open}{inside}{}", &text[..start], &text[end..]);
                variants.push(format!("{}{}", &text[..start], &text[end + close.len()..]));
                variants.push(around(""));
                variants.push(around(&reversed(inside)));
            }
            _ => {
                variants
                    .push(text.replace("</PostProcessor>", &format!("<{name}></{name}></PostProcessor>")));
            }
        }
    }
    variants
}

/// Returns variants of a definition with control texts, in each of which one text is removed, emptied or reversed.
fn texts_changed(text: &str) -> Vec<String> {
    let mut variants = Vec::new();
    let begin = text.find("[text]").unwrap();
    for line in text[begin..].lines().filter(|line| line.contains(" = '")) {
        let name = line.split(" = ").next().unwrap();
        let start = begin + text[begin..].find(line).unwrap();
        let quotes = if line.contains("'''") { "'''" } else { "'" };
        let inside = start + name.len() + 3 + quotes.len();
        let end = inside + text[inside..].find(quotes).unwrap();
        let around = |new: &str| format!("{}{new}{}", &text[..inside], &text[end..]);
        variants.push(format!("{}{}", &text[..start], &text[end + quotes.len()..]));
        variants.push(around(""));
        variants.push(around(&reversed(&text[inside..end])));
    }
    variants
}

/// Returns the words of a text in reverse order.
fn reversed(text: &str) -> String {
    let parts: Vec<&str> = text.split_inclusive([' ', '\n']).collect();
    parts.into_iter().rev().flat_map(|part| [part.trim_end(), " "]).collect()
}

/// Whether the cuts are in order, according to a reader that knows only G0 to G3, X, Y and Z and shares no code with the program.
fn has_all_cuts(text: &str) -> bool {
    let (mut at, mut motion) = ([f64::NAN; 3], 0.0);
    let mut left = CUTS.iter().peekable();
    for line in text.lines() {
        let code = line.split(['(', ';']).next().unwrap().split("//").next().unwrap().to_uppercase();
        let words: Vec<(char, f64)> = words(&code);
        let g = |number: f64| words.contains(&('G', number));
        if let Some((_, code)) =
            words.iter().find(|(letter, code)| *letter == 'G' && (0.0..=3.0).contains(code))
        {
            motion = *code;
        }
        if g(4.0) || g(28.0) || g(53.0) {
            continue;
        }
        for (letter, number) in &words {
            if let Some(axis) = "XYZ".find(*letter) {
                at[axis] = *number;
            }
        }
        let is_near = |cut: &&[f64; 3]| (0..3).all(|axis| (at[axis] - cut[axis]).abs() < 0.01);
        if motion > 0.0 && left.peek().is_some_and(is_near) {
            left.next();
        }
    }
    left.next().is_none()
}

fn words(code: &str) -> Vec<(char, f64)> {
    let mut words = Vec::new();
    let mut rest = code;
    while let Some(at) = rest.find(|c: char| c.is_ascii_alphabetic()) {
        let letter = rest[at..].chars().next().unwrap();
        rest = &rest[at + 1..];
        let end = rest.find(|c: char| !matches!(c, '0'..='9' | '.' | '-' | '+')).unwrap_or(rest.len());
        if let Ok(number) = rest[..end].parse() {
            words.push((letter, number));
        }
    }
    words
}
