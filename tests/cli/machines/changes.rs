//! Checks that `verify --against` finds every dangerous change of a program, and nothing in an unchanged one. (book: program/reading)
//!
//! The programs of all cases are written by every post and then changed: words are inserted before the first move and between moves, numbers are
//! changed by 0.1 and more, lines are removed and swapped. A change is dangerous if the tool cuts elsewhere, deeper, faster or at another spindle
//! speed, or makes a different move below S.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use pathbuild_diagnostic::messages::gcode::RETURN_IN_LINE;
use pathbuild_diagnostic::{Diagnostic, Severity};
use pathbuild_gcode::dialect::{Charset, Dialect};
use pathbuild_gcode::interpret::{Heights, Options, guess, interpret, interpret_each};
use pathbuild_gcode::native::{self, WriteOptions};
use pathbuild_gcode::verify::{
    DrawingComparison, ExpectedProgram, PostWords, Rules, Stock, ToolUse, coarse_arc_finding,
};
use pathbuild_motion::{Action, Change, Corners, Move, Pace, Position, Spindle, Step, Turning};
use pathbuild_post::{BUILT_IN, Job, Language, PostOptions, ToolEntry, ToolTable, load, samples};
use pathbuild_toolpath::{Correction, Program};
use rayon::prelude::*;

use super::programs::{Named, programs};
use super::{say, shown, texts};

/// A program that a post has written.
struct Written {
    name: String,
    dialect: Dialect,
    text: String,
}

const SPEED: f64 = 12_000.0;

/// Number of changes per program and post, unless `PATHBUILD_CHANGES` sets another.
const CHANGES: usize = 4;

fn changes() -> usize {
    let count = std::env::var("PATHBUILD_CHANGES").ok().and_then(|count| count.parse().ok());
    count.unwrap_or(CHANGES)
}

/// Offsets by which numbers are changed.
const STEPS: [f64; 8] = [0.1, 0.25, 1.0, 7.5, -0.1, -0.3, -2.0, -12.0];

#[test]
fn no_dangerous_change_passes_and_no_program_has_a_finding() {
    let mut tried: BTreeMap<&str, usize> = BTreeMap::new();
    let mut faults = Vec::new();
    for post in BUILT_IN {
        let results: Vec<(usize, Vec<String>)> = programs()
            .par_iter()
            .enumerate()
            .map(|(seed, it)| of_program(post.name, post.language, it, seed))
            .collect();
        tried.insert(post.name, results.iter().map(|(count, _)| count).sum());
        faults.extend(results.into_iter().flat_map(|(_, faults)| faults));
    }
    say(&format!("dangerous changes tried: {tried:?}"));
    assert!(faults.is_empty(), "{}\n{}", faults.len(), shown(&faults));
    assert!(tried.values().sum::<usize>() >= 5_000, "{tried:?}");
    assert!(tried.values().all(|count| *count >= 300), "{tried:?}");
}

/// Returns the number of dangerous changes, and the failures.
fn of_program(post: &str, language: Language, it: &Named, seed: usize) -> (usize, Vec<String>) {
    let written = match written(post, language, it) {
        Ok(written) => written,
        Err(errors) => return (0, vec![format!("{} {post}: {}", it.name, texts(&errors))]),
    };
    let found = findings(&written.text, written.dialect, &it.program);
    if !found.is_empty() {
        return (0, vec![format!("{} {post}: unchanged: {}", it.name, texts(&found))]);
    }
    let before = effects(&written.text, written.dialect, &it.program);
    let mut dice = Dice::new(seed as u64);
    let (mut count, mut faults) = (0, Vec::new());
    for _ in 0..changes() {
        let Some((what, changed)) = change(&written, &mut dice) else { continue };
        if is_alike(&effects(&changed, written.dialect, &it.program), &before) {
            continue;
        }
        count += 1;
        let found = findings(&changed, written.dialect, &it.program);
        if !found.iter().any(Diagnostic::is_error) {
            faults.push(format!("{} {post}: {what}: {}", written.name, texts(&found)));
        }
    }
    (count, faults)
}

fn written(post: &str, language: Language, it: &Named) -> Result<Written, Vec<Diagnostic>> {
    let text = if language == Language::Native {
        let options = WriteOptions {
            correction: Correction::default(),
            lang: pathbuild_diagnostic::Lang::En,
            charset: Charset::Ascii,
            rapid: 1000.0,
        };
        native::write_program(&it.program, "", &options, usize::MAX).unwrap()
    } else {
        let tools = ToolTable { entries: vec![entry(it.program.tool)] };
        let (job, _) =
            Job::from_programs(&it.program.path, std::slice::from_ref(&*it.program), &tools, false);
        let output = load(post)?.write(&job, &PostOptions::default())?;
        String::from_utf8(output.text).unwrap()
    };
    let dialect = post.parse().unwrap();
    Ok(Written { name: it.name.clone(), dialect, text })
}

fn entry(diameter: f64) -> ToolEntry {
    ToolEntry {
        name: "cutter".into(),
        diameter,
        paths: None,
        index: Some(1),
        spindle: Some(Turning::Clockwise),
        speed: Some(SPEED),
        coolant: None,
    }
}

/// Returns all findings of `verify --against`.
fn findings(text: &str, dialect: Dialect, program: &Program) -> Vec<Diagnostic> {
    let options = Options { heights: Heights::Nominal, ..Options::default() };
    // As in the command, doubts about words that the drawing's program does not contain are errors.
    let mut found = Vec::new();
    let stock = Stock::uniform(program.thickness, program.tool);
    let mut rules = Rules::new(Some(&stock));
    let drawn = ExpectedProgram {
        moves: program.moves(),
        pecks: Vec::new(),
        start: Position::known(0.0, 0.0, program.start_height()),
        clearance: program.start_height(),
        is_probing: false,
        tool: ToolUse {
            number: Some(1),
            turning: Some(Turning::Clockwise),
            speed: Some(SPEED),
            coolant: None,
        },
        number: None,
        spin_up: 0.0,
    };
    let words = known_words();
    let mut against = DrawingComparison::new(drawn, dialect, &words[&dialect]);
    found.extend(interpret_each(text.as_bytes(), dialect, &options, &mut |step| {
        rules.step(&step);
        against.step(&step);
    }));
    for it in &mut found {
        it.severity = Severity::Error;
    }
    found.extend(rules.finish());
    found.extend(coarse_arc_finding(text.as_bytes(), dialect));
    found.extend(against.finish().differences);
    found
}

fn known_words() -> &'static BTreeMap<Dialect, PostWords> {
    static WORDS: OnceLock<BTreeMap<Dialect, PostWords>> = OnceLock::new();
    WORDS.get_or_init(|| Dialect::ALL.iter().map(|dialect| (*dialect, words_of(*dialect))).collect())
}

fn words_of(dialect: Dialect) -> PostWords {
    let Ok(post) = load(dialect.name()) else { return PostWords::native(dialect) };
    let written = samples().into_iter().filter_map(|job| post.write(&job, &PostOptions::default()).ok());
    PostWords::of_programs(written.map(|output| output.text), dialect)
}

/// An effect of a program that makes a change dangerous if it differs: a cut with the spindle's state, or a rapid move below S.
type Effect = (Move, Option<Spindle>);

/// Returns the effects of a program: each cut with the spindle's state, and rapid moves below S.
fn effects(text: &str, dialect: Dialect, program: &Program) -> Vec<Effect> {
    let options = Options { heights: Heights::Nominal, ..Options::default() };
    let mut spindle = Spindle::UNSTATED;
    let low = program.start_height() - 0.05;
    let mut effects = Vec::new();
    let mut has_length = false;
    for Step { action, .. } in interpret(text.as_bytes(), dialect, &options).steps {
        // A tool length takes effect with the next move. Several before the move are a single effect.
        if matches!(&action, Action::Move(it) if !it.is_standstill()) && std::mem::take(&mut has_length) {
            effects.push((nothing(), None));
        }
        match action {
            Action::Change(Change::ToolLength(_)) => has_length = true,
            Action::Spindle(now) => spindle = now,
            Action::Move(it) if it.is_standstill() => {}
            Action::Move(it) if it.pace != Pace::Rapid => effects.push((it, Some(spindle))),
            Action::Move(it) if it.to.z() < low || it.from.z() < low => effects.push((it, None)),
            Action::Change(Change::Corners(Corners::Exact) | Change::RapidFeed(_)) => {}
            Action::Change(Change::Corners(Corners::Rounded(Some(most)))) if most <= 0.01 => {}
            // Tool length, offsets and the like change the machine's coordinates, not the program's.
            Action::Change(Change::Corners(Corners::Rounded(None))) => effects.push((nothing(), None)),
            Action::Change(_) | Action::System { .. } => effects.push((nothing(), Some(spindle))),
            _ => {}
        }
    }
    effects
}

/// Whether the effects are equal up to rounding: very short moves are ignored, and ends may differ slightly.
fn is_alike(one: &[Effect], other: &[Effect]) -> bool {
    let counting = |all: &[Effect]| -> Vec<Effect> {
        all.iter().filter(|(it, _)| it.length() == 0.0 || it.length() > ROUNDING).copied().collect()
    };
    let is_near = |a: &Position, b: &Position| {
        a.known == b.known && a.at.iter().zip(b.at).all(|(a, b)| (a - b).abs() <= ROUNDING)
    };
    let (one, other) = (counting(one), counting(other));
    let is_same = |((a, spindle), (b, other)): (&Effect, &Effect)| {
        let ends = is_near(&a.from, &b.from) && is_near(&a.to, &b.to);
        ends && a.pace == b.pace && a.shape == b.shape && spindle == other
    };
    one.len() == other.len() && one.iter().zip(&other).all(is_same)
}

/// Tolerance in mm, which is several units of the last digit.
const ROUNDING: f64 = 0.006;

fn nothing() -> Move {
    let nowhere = Position::default();
    Move {
        from: nowhere,
        to: nowhere,
        shape: pathbuild_motion::MoveShape::Line,
        pace: Pace::Rapid,
        named: None,
    }
}

/// Words that are dangerous anywhere before the last cut.
pub(super) const ANYWHERE: &[&str] = &[
    "G10 L2 P1 Z-5",
    "G92 Z3",
    "G52 X3",
    "G43.1 Z-6.0",
    "G43 H9",
    "G55",
    "G59",
    "#5221=3",
    "M48",
    "M98 P5",
    "G51 X2.0",
    "G68 R10.0",
    "G64 P2",
    "M220 S300",
];

/// Words that are dangerous between cuts.
pub(super) const BETWEEN: &[&str] = &[
    "G91",
    "G20",
    "G93",
    "G95",
    "M4 S1",
    "M5",
    "M3 S1",
    "G0 X20.123 Y0.5 Z-9.0",
    "G0 Z-9.0",
    "G28",
    "G53 G0 Z-50.0",
    "G1 X-50.0 F100",
    "G0 X1.234 Y5.678 Z0.5",
];

fn change(written: &Written, dice: &mut Dice) -> Option<(String, String)> {
    let mut lines: Vec<String> = written.text.lines().map(str::to_owned).collect();
    let is_move = |line: &String| {
        let words = words(line);
        words.iter().any(|(at, _)| matches!(line.as_bytes()[*at], b'X' | b'Y' | b'Z'))
    };
    let is_cut = |line: &String| {
        is_move(line) && ["G1 ", "G01", "G2 ", "G02", "G3 ", "G03"].iter().any(|g| line.contains(g))
    };
    let first = lines.iter().position(is_cut)?;
    let last = lines.iter().rposition(is_cut)?;
    let what = match dice.below(6) {
        0 => {
            let at = 1 + dice.below(last);
            let word = ANYWHERE[dice.below(ANYWHERE.len())];
            lines.insert(at, word.to_owned());
            format!("`{word}` put in as line {}", at + 1)
        }
        1 => {
            let at = first + 1 + dice.below((last - first).max(1));
            let word = BETWEEN[dice.below(BETWEEN.len())];
            lines.insert(at.min(last), word.to_owned());
            format!("`{word}` put in as line {}", at.min(last) + 1)
        }
        2 | 3 => {
            let at = dice.below(lines.len());
            let words = words(&lines[at]);
            let &(begins, ends) = words.get(dice.below(words.len().max(1)))?;
            let letter = lines[at].as_bytes()[begins];
            if matches!(letter, b'N' | b'O') {
                return None;
            }
            let number: f64 = lines[at][begins + 1..ends].parse().ok()?;
            let by = STEPS[dice.below(STEPS.len())];
            let changed = format!("{:.3}", number + by);
            let was = lines[at].clone();
            lines[at].replace_range(begins + 1..ends, &changed);
            format!("`{was}` became `{}`", lines[at])
        }
        4 => {
            // After the last cut the tool is only retracted. In a helix that is written as chords, removing one chord is within the tolerance.
            let at = dice.below(last + 1);
            if is_cut(&lines[at]) && !written.dialect.rules().arcs.helix {
                return None;
            }
            format!("`{}` was removed", lines.remove(at))
        }
        _ => {
            let at = dice.below(lines.len() - 1);
            lines.swap(at, at + 1);
            format!("`{}` and `{}` were swapped", lines[at + 1], lines[at])
        }
    };
    Some((what, lines.join("\n") + "\n"))
}

/// Returns the byte ranges of words outside of comments.
pub(super) fn words(line: &str) -> Vec<(usize, usize)> {
    let bytes = line.as_bytes();
    let (mut found, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        match bytes[at] {
            b'(' => at += line[at..].find(')').unwrap_or(line.len() - at) + 1,
            b';' | b'/' | b'%' => break,
            letter if letter.is_ascii_uppercase() => {
                let begins = at;
                at += 1;
                while at < bytes.len() && matches!(bytes[at], b'0'..=b'9' | b'.' | b'-' | b'+') {
                    at += 1;
                }
                if at > begins + 1 {
                    found.push((begins, at));
                }
            }
            _ => at += 1,
        }
    }
    found
}

/// A deterministic pseudo-random number generator. (Knuth's MMIX)
pub(super) struct Dice(u64);

impl Dice {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed * 7919 + 1)
    }

    /// Returns a random multiple of a hundredth between two bounds.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        let hundredths = self.below(10_000);
        ((low + (high - low) * hundredths as f64 / 10_000.0) * 100.0).round() / 100.0
    }

    pub(super) fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % most.max(1)
    }
}

#[test]
fn programs_that_name_their_dialect_are_read_in_it() {
    for post in BUILT_IN {
        let header = format!("(pathbuild 0.1.0 3f2a-09c1 {} O2 T5)\nG0 X1\n", post.name);
        assert_eq!(guess(header.as_bytes()).dialect.name(), post.name);
    }
}

/// Changes to one text of a program, by post: dangerous ones, which must be found, and harmless neighbours, which must not.
const TEXTS: &[(&str, &str, &str, bool)] = &[
    ("linuxcnc", " G54", "", true),
    ("mach3", " G54", "", true),
    ("fanuc", " G54", "", true),
    ("haas", " G54", "", true),
    ("grbl", " G54", "", true),
    ("native", " G54", "", true),
    ("linuxcnc", " G40", "", true),
    ("haas", " G94", " g94.0", false),
    ("linuxcnc", " G80", "", false),
    ("linuxcnc", "G43 H1 ", "", true),
    ("linuxcnc", "G43 H1 ", "G49 ", true),
    ("linuxcnc", "G43 H1 ", "g43 H 01.0 ", false),
    ("linuxcnc", "G43 H1 ", "G43 H01.0 ", false),
    ("linuxcnc", "G64 P0.01", "", true),
    ("linuxcnc", "G64 P0.01", "G64", true),
    ("linuxcnc", "G64 P0.01", "G64 P0", true),
    ("linuxcnc", "G64 P0.01", "G64 P0.01 Q1", true),
    ("linuxcnc", "G64 P0.01", "G64 P0.011", true),
    ("linuxcnc", "G64 P0.01", "G64 P0.005", false),
    ("linuxcnc", "T1 M6", "", true),
    ("linuxcnc", "G49", "G49 G97", true),
    ("linuxcnc", "G49", "g 4 9", true),
    ("mach3", "G49", "G49 G50", true),
    ("mach3", "G49", "G49 g069.0", true),
    ("fanuc", "G17", "G28 G17", true),
    ("grbl", "T1", "T1 M8", false),
    ("native", "T1", "", true),
    ("native", "T1", "T1 M6", true),
    ("native", "T1", "T01", false),
    ("marlin", "G90", "G90\nG54", true),
    ("marlin", "G90", "G90\nG53", true),
    ("marlin", "G90", "G90\nG61", true),
    ("marlin", "G90", "g90", true),
    ("marlin", "G90", "G090", false),
    ("marlin", "G0 F1000", "G0 F1001", true),
    ("marlin", "G0 F1000", "G0", true),
    ("marlin", "G0 F1000", "G0 F999", false),
    ("xpertmill", "M06 01\nS12000", "S12000\nM06 01", false),
    ("xpertmill", "M06 01\nS12000", "M06 02\nS12000\nM06 01", true),
    ("xpertmill", "M06 01", "", true),
    ("xpertmill", "M06 01", "M06 02", true),
    ("xpertmill", "G71", "G71\nG91", true),
    ("xpertmill", "G71", "G71\nG51 P2", true),
    ("xpertmill", "M30", "M2\nM30", true),
    ("din", " G40", "", true),
    ("din", " G71", "", true),
    ("din", " G71", " G70", true),
    ("din", " G40", " g040.0", false),
    ("din", " G40", " G40 G53", true),
    ("din", " M06", "", true),
    ("estlcam", "G17", "", true),
    ("estlcam", "G17", "G17\nG54", true),
    ("estlcam", "G17", "G17\nM10", true),
    ("estlcam", "G17", "G17 G90", true),
    ("estlcam", "G21", "g 21.0", false),
    ("estlcam", "T1 M6", "", true),
];

#[test]
fn words_are_known_just_inside_and_not_just_outside() {
    let it = &programs()[0];
    let mut wrong = Vec::new();
    for &(name, from, to, is_found) in TEXTS {
        let post = BUILT_IN.iter().find(|post| post.name == name).unwrap();
        let written = written(name, post.language, it).unwrap_or_else(|errors| panic!("{}", texts(&errors)));
        let text = written.text.replace("\r\n", "\n");
        assert!(text.contains(from), "{name} {from}: {text}");
        let found = findings(&text.replacen(from, to, 1), written.dialect, &it.program);
        let has_error = found.iter().any(Diagnostic::is_error);
        if has_error != is_found {
            wrong.push(format!("{name}: `{from}` became `{to}`: {}", texts(&found)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// After a lone carriage return, pathbuild ignores the rest of the line, but some controllers do not.
#[test]
fn a_carriage_return_within_a_line_is_found_in_every_dialect() {
    let is_found = |text: &str, dialect| {
        let problems = interpret(text.as_bytes(), dialect, &Options::default()).problems;
        problems.iter().any(|it| it.message.key == RETURN_IN_LINE.key)
    };
    for &dialect in Dialect::ALL {
        for open in ["; x", "(x", "// x", ""] {
            let close = if open == "(x" { ")" } else { "" };
            let line = |end: &str| format!("G21 G90\n{open}\rG0 Z-5{end}{close}\nG0 Z5\n");
            assert!(is_found(&line(""), dialect), "{dialect} {open}");
            assert!(is_found(&line("\r"), dialect), "{dialect} {open}");
        }
        for end in ["\r\n", "\r\r\n", "\r \r\n", "\r"] {
            let text = format!("G21 G90{end}G0 Z5{end}");
            assert!(!is_found(&text, dialect), "{dialect} {end:?}");
        }
    }
}
