//! Converts programs to short texts, for tests that compare them.

#![allow(dead_code, clippy::format_collect, reason = "each test file uses its part, and none is in a hurry")]

use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::read::{Block, BlockReader, Value};
use pathbuild_motion::{Action, Move, MoveShape, NamedPosition, Pace, Position, Step};

/// Returns the effects of a program, with one text per step.
pub(crate) fn trace(dialect: Dialect, program: &str) -> Vec<String> {
    trace_with(dialect, program, &Options::default())
}

pub(crate) fn trace_with(dialect: Dialect, program: &str, options: &Options) -> Vec<String> {
    let steps = interpret(program.as_bytes(), dialect, options).steps;
    let is_shown =
        |step: &&Step| !matches!(step.action, Action::Change(_) | Action::Word(_) | Action::ProgramNumber(_));
    steps.iter().filter(is_shown).map(step_text).collect()
}

/// Returns the changes that a program makes besides position, spindle, tool and system.
pub(crate) fn changes(dialect: Dialect, program: &str) -> Vec<String> {
    let steps = interpret(program.as_bytes(), dialect, &Options::default()).steps;
    steps.iter().filter(|step| matches!(step.action, Action::Change(_))).map(step_text).collect()
}

/// Returns the problems of a program, as line and name of the code.
pub(crate) fn faults(dialect: Dialect, program: &str) -> Vec<String> {
    faults_with(dialect, program, &Options::default())
}

pub(crate) fn faults_with(dialect: Dialect, program: &str, options: &Options) -> Vec<String> {
    interpret(program.as_bytes(), dialect, options).problems.iter().map(fault_text).collect()
}

/// Formats a problem as line and name of its code, such as `3 missing-feed`.
pub(crate) fn fault_text(diagnostic: &Diagnostic) -> String {
    format!("{} {}", diagnostic.place.line.unwrap_or(0), diagnostic.code().name())
}

/// Returns line, message and marked text of diagnostics, as shown to the user.
pub(crate) fn spelled_out(diagnostics: &[Diagnostic]) -> String {
    diagnostics
        .iter()
        .map(|diagnostic| {
            let place = (diagnostic.place.line, diagnostic.place.column);
            let marked = diagnostic.text.as_ref().map(|fault| fault.text[fault.span()].to_owned());
            format!("{} {place:?} {} {marked:?}\n", diagnostic.code(), diagnostic.text(Lang::En))
        })
        .collect()
}

/// Returns the words of each block, such as `1: G1 X2.5`. Expressions are shown as `[ ]`.
pub(crate) fn words(dialect: Dialect, program: &str) -> Vec<String> {
    let mut reader = BlockReader::new(program.as_bytes(), dialect.rules());
    let mut blocks = Vec::new();
    while let Some(block) = reader.next_block() {
        blocks.push(block_text(&block));
    }
    blocks
}

pub(crate) fn reading_faults(dialect: Dialect, program: &[u8]) -> Vec<String> {
    let mut reader = BlockReader::new(program, dialect.rules());
    while reader.next_block().is_some() {}
    reader.into_problems().into_diagnostics().iter().map(fault_text).collect()
}

fn block_text(block: &Block<'_>) -> String {
    let words = block.words.iter().map(|word| match word.value {
        Value::Number(number) => format!(" {}{}", char::from(word.letter), number.value),
        Value::Expression(_) => format!(" {}[ ]", char::from(word.letter)),
    });
    let comments = block.comments.iter().map(|comment| format!(" ({})", block.text_of(comment.text)));
    format!("{}:{}", block.line, words.chain(comments).collect::<String>())
}

fn step_text(step: &Step) -> String {
    let text = match &step.action {
        Action::Move(it) => move_text(it),
        Action::Dwell(seconds) => format!("dwell {seconds}"),
        Action::SelectTool(tool) => format!("select {tool}"),
        Action::ChangeTool(tool) => format!("tool {}", tool.unwrap_or(0)),
        Action::Spindle(spindle) => {
            format!("spindle {:?} {}", spindle.turning, spindle.speed.unwrap_or_default())
        }
        Action::Coolant(coolant) => format!("coolant mist={} flood={}", coolant.mist, coolant.flood),
        Action::System { system, .. } => format!("system {}", system.name()),
        Action::Word(word) => format!("word {}{}", word.letter, f64::from(word.code) / 10.0),
        Action::ProgramNumber(number) => format!("number {number}"),
        Action::Change(change) => format!("{change:?}"),
        Action::Comment(text) => format!("({text})"),
        Action::Stop { optional } => format!("stop optional={optional}"),
        Action::End => "end".to_owned(),
    };
    format!("{} {text}", step.line)
}

fn move_text(it: &Move) -> String {
    let pace = match it.pace {
        Pace::Rapid => "rapid".to_owned(),
        Pace::Feed(feed) => format!("feed {}", short(feed)),
        Pace::Probe { feed, toward, must_answer } => {
            format!("probe {feed} toward={toward} must={must_answer}")
        }
    };
    let path = match it.shape {
        MoveShape::Line => String::new(),
        MoveShape::Arc(arc) => {
            let way = if arc.clockwise { "cw" } else { "ccw" };
            let degrees = arc.sweep(&it.from, &it.to).to_degrees();
            format!(" {way} round {} {} by {}", short(arc.centre[0]), short(arc.centre[1]), short(degrees))
        }
    };
    let named = it.named.map_or("", |named| match named {
        NamedPosition::Machine(_) => " Machine",
        NamedPosition::Home1(_) => " Home1",
        NamedPosition::Home2(_) => " Home2",
    });
    format!("{pace} to {}{path}{named}", position_text(&it.to))
}

fn position_text(position: &Position) -> String {
    let coordinate = |axis: usize| {
        let known = position.known.has(pathbuild_motion::Axes::of(axis));
        if known { short(position.at[axis]) } else { "?".to_owned() }
    };
    [0, 1, 2].map(coordinate).join(" ")
}

/// Formats a number with at most four decimals and no trailing zeros.
fn short(number: f64) -> String {
    let text = format!("{number:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
