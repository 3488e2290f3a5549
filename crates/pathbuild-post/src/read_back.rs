//! Reads the text of a post back and compares it with the job: the moves, and at each cut the tool, its length and the spindle.
//! (book: program/posts, "Before a program is written")

use std::borrow::Cow;

use pathbuild_diagnostic::messages::{gcode, posts};
use pathbuild_diagnostic::{Diagnostic, Message, Note, Severity, TextFault, Value};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{self, Interpretation, Options, code_name};
use pathbuild_gcode::verify::{
    BentRapidRules, CornerRules, Cutter, LengthRules, MachineRules, ProgramStart, Rules, Stock, StockSpan,
    Tolerance, coarse_arc_finding,
};
use pathbuild_motion::{
    Action, Axes, Change, Coolant, Move, MoveShape, NamedPosition, Pace, Position, Step, ToolLength, Turning,
    WorkSystem,
};

use crate::findings::LineOrigin;
use crate::job::{Entry, Job, JobStep, Operation};
use crate::line_words::{CommentMarks, Word, words};
use crate::read_back_options::{ReadBackOptions, Wording};
use crate::rs274_translation::{Doubt, TranslatedText};
use crate::target::Target;
use crate::traverse::{self, MatchedCut};
use crate::{ambiguous, dwells, tools};

/// Checks a text. Returns the errors: those reported by the reader of the target, or else the first deviation from the job and violations of the
/// rules of `verify`. If there are no errors, returns warnings about doubtful constructs.
pub(super) fn check(
    text: &[u8],
    job: &Job,
    expected: &ReadBackOptions<'_>,
) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
    let ReadBackOptions { wording, tolerance, .. } = expected;
    let (reader, control) = (wording.reader(), wording.control());
    let options = Options { milliseconds: expected.milliseconds, ..Options::default() };
    let mut read = interpret::interpret(text, reader, &options);
    mark_skippable_stops(&mut read.steps, text);
    if control.is_some() {
        let errors: Vec<Diagnostic> =
            read.problems.iter().filter(|problem| problem.is_error()).cloned().collect();
        if !errors.is_empty() {
            let errors = errors.into_iter().map(as_finding_of_post).collect();
            return if tolerance.is_some() { Err(errors) } else { Ok(Vec::new()) };
        }
        if let Some(problem) = first_of(&read.problems, &gcode::NO_DECIMAL_POINT)
            && tolerance.is_some()
        {
            return Err(vec![problem]);
        }
    }
    let mut errors = Vec::new();
    let (broken, mut doubts) = broken_rules(&read.steps, job, expected);
    doubts.extend(work_offset_warnings(&read.steps));
    doubts.extend(
        control.filter(|control| control.has_probe_alarm()).and_then(|_| lenient_probe_warning(&read.steps)),
    );
    if let Some(tolerance) = tolerance {
        errors.extend(line_errors(text, &read, *wording));
        errors.extend(move_errors(&read, job, expected, tolerance, &broken)?);
        if let Wording::Translated(translated) = wording {
            let (wrong, doubtful) = translation_findings(translated, &read.problems);
            errors.extend(wrong.into_iter().map(as_finding_of_post));
            doubts.extend(doubtful);
        }
        doubts.extend(late_spindle_start_warning(&read.steps));
        let needs_coolant = |operation: &Operation| operation.coolant.is_some_and(Coolant::is_on);
        if expected.follows_coolant
            && job.operations.iter().any(needs_coolant)
            && !tools::switches_coolant_on(&read.steps)
        {
            doubts.push(Diagnostic::new(&posts::COOLANT_NEVER_ON));
        }
        let shortest = tolerance.place.max(DWELL_TOLERANCE);
        errors
            .extend(dwells::check(&read.steps, wording.translation(), job, shortest).map(as_finding_of_post));
        if control.is_some() {
            doubts.extend(coarse_arc_finding(text, reader));
            doubts.extend(read.problems);
        }
    }
    errors.extend(broken);
    if errors.is_empty() { Ok(doubts) } else { Err(errors) }
}

/// Returns errors about lines that controls may understand in different ways, skip, or ignore.
fn line_errors(text: &[u8], read: &Interpretation, wording: Wording<'_>) -> Vec<Diagnostic> {
    let mut errors = ambiguous::errors(&read.problems, text);
    errors.extend(first_of(&read.problems, &gcode::NO_MOTION));
    if wording.translation().is_some() {
        // Some controls run these lines.
        errors.extend(first_of(&read.problems, &gcode::AFTER_END));
    }
    errors.extend(skippable_line_error(text, &read.steps));
    errors
}

/// Compares the moves of a text with those of the job and, if they agree, the tools of the cuts. Returns the errors that `broken`, those of the rules
/// of `verify`, do not contain.
///
/// # Errors
/// A hole of the job that cannot be divided into moves.
fn move_errors(
    read: &Interpretation,
    job: &Job,
    expected: &ReadBackOptions<'_>,
    tolerance: &Tolerance,
    broken: &[Diagnostic],
) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
    let mut errors = Vec::new();
    let mut wanted = moves(job).map_err(|error| vec![*error])?;
    let mut clearance =
        job.operations.iter().map(|operation| operation.clearance).fold(f64::NEG_INFINITY, f64::max);
    let mut found: Vec<(u32, Move)> = read.moves().into_iter().map(with_equal_probes).collect();
    if expected.is_for_beam {
        (wanted, found, clearance) = (moves_in_plane(&wanted), moves_in_plane(&found), 0.0);
        errors.extend(check_beam(&read.steps).map(as_finding_of_post));
    }
    match traverse::check(&found, &wanted, clearance, tolerance) {
        Ok(cuts) => {
            let of_changes = [&gcode::SPINNING_AT_CHANGE, &gcode::CHANGE_NOT_RAISED];
            let is_reported = |problem: &Diagnostic| {
                of_changes.contains(&problem.message)
                    && broken.iter().any(|reported| reported.message == problem.message)
            };
            let tools = tools::check(&read.steps, job, &cuts, expected).into_iter();
            errors.extend(tools.filter(|problem| !is_reported(problem)).map(as_finding_of_post));
            errors.extend(rapids_with_other_length(&read.steps, expected.wording.reader()));
            let control = expected.wording.control().into_iter();
            errors.extend(control.flat_map(|control| bent_rapids(&read.steps, job, &cuts, control)));
        }
        Err(movement) => {
            // A line that RS274 refuses, such as G83 without Q, may be the reason.
            let is_translated = expected.wording.translation().is_some();
            let cause = read.problems.iter().find(|problem| is_translated && problem.is_error());
            errors.extend(cause.cloned().map(as_finding_of_post));
            errors.push(as_finding_of_post(*movement));
        }
    }
    Ok(errors)
}

/// Returns the errors and the warnings about the words of a translation. `problems` are those of its reader.
fn translation_findings(
    translated: &TranslatedText,
    problems: &[Diagnostic],
) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let doubtful = translated.doubtful.iter().map(|word| {
        let (message, is_dangerous) = match word.doubt {
            Doubt::Dangerous => (&gcode::NOT_FOLLOWED, true),
            Doubt::Unknown => (&posts::WORD_NOT_FOLLOWED, false),
        };
        let found = Diagnostic::new(message).quoting("word", &*word.word).at_line(word.line, None);
        (found, is_dangerous)
    });
    let is_low = |problem: &&Diagnostic| problem.message == &gcode::LOW_MACHINE_HEIGHT;
    let others = unused_words(problems)
        .into_iter()
        .chain(problems.iter().filter(is_low).cloned())
        .chain(disputed_words_warning(translated))
        .map(|doubt| (doubt, false));
    let stated = translated.problems.iter().map(|problem| (problem.clone(), problem.is_error()));
    let (wrong, doubts): (Vec<_>, Vec<_>) =
        doubtful.chain(others).chain(stated).partition(|(_, is_wrong)| *is_wrong);
    let found = |findings: Vec<(Diagnostic, bool)>| findings.into_iter().map(|(found, _)| found).collect();
    (found(wrong), found(doubts))
}

/// Returns the first of the problems with this message as a finding about the post. Further ones are not reported.
fn first_of(problems: &[Diagnostic], message: &'static Message) -> Option<Diagnostic> {
    problems.iter().find(|problem| problem.message == message).cloned().map(as_finding_of_post)
}

/// Returns a finding about the first line that a switch at the machine (block delete) can skip although it moves, changes the tool, its
/// length, or offsets, switches the spindle, or states a mode or a feed for the lines that follow.
fn skippable_line_error(text: &[u8], steps: &[Step]) -> Option<Diagnostic> {
    let is_needed = |action: &Action| match action {
        Action::Move(_) | Action::SelectTool(_) | Action::ChangeTool(_) | Action::Spindle(_) => true,
        Action::Change(change) => matches!(change, Change::ToolLength(_) | Change::Offsets { .. }),
        _ => false,
    };
    let mut needed = steps.iter().filter(|step| is_needed(&step.action)).map(|step| step.line).peekable();
    for (number, line) in (1_u32..).zip(text.split(|byte| *byte == b'\n')) {
        while needed.next_if(|needed| *needed < number).is_some() {}
        if begins_with_slash(line) && (needed.peek() == Some(&number) || has_mode_word(line)) {
            return Some(Diagnostic::new(&posts::LINE_SKIPPABLE).at_line(number, None));
        }
    }
    None
}

/// Whether a line begins with `/`, possibly after its number.
fn begins_with_slash(line: &[u8]) -> bool {
    let line = line.trim_ascii_start();
    let after_number = match line.split_first() {
        Some((b'N' | b'n', rest)) => {
            let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
            rest[digits..].trim_ascii_start()
        }
        _ => line,
    };
    after_number.starts_with(b"/") && !after_number.starts_with(b"//")
}

/// Makes stops optional in lines that block delete can skip.
fn mark_skippable_stops(steps: &mut [Step], text: &[u8]) {
    let mut stops = steps.iter_mut().filter(|step| matches!(step.action, Action::Stop { .. })).peekable();
    for (number, line) in (1_u32..).zip(text.split(|byte| *byte == b'\n')) {
        while let Some(stop) = stops.next_if(|stop| stop.line <= number) {
            if begins_with_slash(line) {
                stop.action = Action::Stop { optional: true };
            }
        }
    }
}

/// Whether a line has an F, or a G word other than G4.
fn has_mode_word(line: &[u8]) -> bool {
    let words = words(&String::from_utf8_lossy(line), &CommentMarks::default()).words;
    let is_dwell = |word: &Word| word.letter == 'G' && word.number == 4.0;
    let has_mode = words.iter().any(|word| word.letter == 'G' && !is_dwell(word));
    has_mode || words.iter().any(|word| word.letter == 'F') && !words.iter().any(is_dwell)
}

/// Permitted deviation of dwells in seconds: half a millisecond and a margin for rounding.
const DWELL_TOLERANCE: f64 = 0.000_501;

/// Returns errors about the rapid moves of a text that lead through material because the control does not move in a straight line. These moves are
/// examined only if all cutters and the surface are known.
fn bent_rapids(steps: &[Step], job: &Job, cuts: &[MatchedCut], target: &Target) -> Vec<Diagnostic> {
    let Some(stock) = stock(job, cuts) else { return Vec::new() };
    let Some(mut rules) = BentRapidRules::new(target.reader, &stock) else { return Vec::new() };
    for step in steps {
        rules.step(step);
    }
    rules.finish(steps).into_iter().map(Diagnostic::as_error).collect()
}

/// Returns errors about rapid moves with the length of another tool than the one in the spindle. Lengths of cuts are compared with the job.
fn rapids_with_other_length(steps: &[Step], reader: Dialect) -> impl Iterator<Item = Diagnostic> {
    let mut rules = LengthRules::new(reader, None);
    for step in steps {
        rules.step(step);
    }
    let found = rules.finish().into_iter();
    found.filter(|problem| problem.message == &gcode::RAPID_WITH_OTHER_LENGTH).map(as_finding_of_post)
}

/// Returns the stock of a text with these cuts, whose order is that of the lines; `None` if a cutter or the surface is unknown.
fn stock(job: &Job, cuts: &[MatchedCut]) -> Option<Stock> {
    let operations = job.operations_by_step();
    let mut pieces: Vec<StockSpan> = Vec::new();
    for (line, number) in cuts.iter().filter(|_| !job.has_no_surface) {
        let operation = operations.get(usize::try_from(*number).ok()?.checked_sub(1)?)?;
        let (surface, diameter) = (operation.surface, operation.tool.diameter);
        if diameter <= 0.0 {
            return None;
        }
        let is_same = |last: &StockSpan| last.surface == surface && last.cutter.diameter == diameter;
        if !pieces.last().is_some_and(is_same) {
            pieces.push(StockSpan { order: *line, surface, cutter: Cutter::flat(diameter) });
        }
    }
    pieces.first_mut()?.order = 0;
    Some(Stock::of_pieces(pieces))
}

/// Projects moves to the plane and drops those that do not move in it.
fn moves_in_plane(moves: &[(u32, Move)]) -> Vec<(u32, Move)> {
    let level = |mut at: Position| {
        at.at[2] = 0.0;
        at.known = at.known.with(Axes::Z);
        at
    };
    let seen = moves.iter().map(|(line, movement)| {
        (*line, Move { from: level(movement.from), to: level(movement.to), ..*movement })
    });
    seen.filter(|(_, movement)| !movement.is_standstill() || movement.from.known != movement.to.known)
        .collect()
}

/// Returns one warning for each letter that nothing in its line uses, because other controls may use it.
fn unused_words(problems: &[Diagnostic]) -> Vec<Diagnostic> {
    let mut doubts: Vec<Diagnostic> = Vec::new();
    for problem in problems.iter().filter(|problem| problem.message == &gcode::UNUSED) {
        let Some(letter) = problem.argument("word") else { continue };
        let is_reported = doubts.iter().any(|doubt| doubt.argument("word") == Some(letter));
        if !is_reported {
            let doubt = Diagnostic::new(&posts::WORD_NOT_FOLLOWED).with("word", letter.clone());
            doubts.push(doubt.at_line(problem.place.line, None));
        }
    }
    doubts
}

/// Returns one warning for all words on which dialects disagree; `None` if there are none.
fn disputed_words_warning(translated: &TranslatedText) -> Option<Diagnostic> {
    let (line, names) = translated.disputed.as_ref()?;
    let doubt = Diagnostic::new(&posts::DIALECTS_DISAGREE).quoting("words", names.join(", "));
    Some(doubt.at_line(*line, None))
}

/// Warns about words that select a work offset other than G54, set a zero, or select a tool length other than that of a tool (G43.1), because
/// the job specifies none of them.
fn work_offset_warnings(steps: &[Step]) -> Vec<Diagnostic> {
    let mut doubts: Vec<Diagnostic> = Vec::new();
    for step in steps {
        let doubt = match &step.action {
            Action::System { system, .. } if *system != WorkSystem::default() => {
                Diagnostic::new(&posts::OFFSET_CHOSEN).quoting("word", system.name())
            }
            // G10 overwrites a stored zero even if this program does not use it.
            Action::Change(Change::Offsets { code, is_followed, .. }) if *code == 100 || !is_followed => {
                Diagnostic::new(&posts::ZERO_SET).quoting("word", code_name('G', *code))
            }
            Action::Change(Change::ToolLength(ToolLength::Other(code))) => {
                Diagnostic::new(&posts::LENGTH_CHOSEN).quoting("word", code_name('G', *code))
            }
            _ => continue,
        };
        if doubts.len() < MAX_OFFSET_WARNINGS {
            doubts.push(doubt.at_line(step.line, None));
        }
    }
    doubts
}

const MAX_OFFSET_WARNINGS: usize = 5;

/// Checks the rules of `verify` that need to know at most the upper face of the material. Returns the errors and the warnings. (book:
/// program/reading)
fn broken_rules(
    steps: &[Step],
    job: &Job,
    expected: &ReadBackOptions<'_>,
) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let stock = job.lowest_surface().map(|surface| Stock::uniform(surface, 1.0));
    let mut rules = Rules::new(stock.as_ref());
    let control = expected.wording.control();
    if let Some(control) = control {
        rules = rules.in_dialect(control.reader);
    }
    let mut limits = expected.machine.map(MachineRules::new);
    let mut corners = CornerRules::new(expected.part_tolerance);
    let (mut start, mut aslant) = (ProgramStart::default(), None);
    for step in steps {
        aslant = aslant.or(start.step(step));
        if let Some(limits) = &mut limits {
            limits.step(step);
        }
        rules.step(step);
        corners.step(step);
    }
    // Warnings about the machine's limits are given for the program that the post writes.
    let mut found = limits.map(MachineRules::finish).unwrap_or_default();
    found.retain(Diagnostic::is_error);
    found.extend(rules.finish());
    found.extend(aslant);
    found.sort_by_key(|problem| problem.place.line);
    // A beam has no height. If the dialect is unknown and the user takes responsibility for the moves, words may mean anything.
    let is_known = control.is_some() || expected.tolerance.is_some();
    let is_followed = !expected.is_for_beam && is_known;
    let (mut broken, mut doubts) = (Vec::new(), Vec::from_iter(corners.finish()));
    for mut problem in found {
        // Programs that were not written by pathbuild only get a warning for these problems; a program that is about to be written must
        // not have them.
        let unwanted = [
            &gcode::SPINDLE_LEFT_ON,
            &gcode::SPINDLE_WITHOUT_SPEED,
            &gcode::SPINNING_AT_CHANGE,
            &gcode::CHANGE_NOT_RAISED,
        ];
        if unwanted.contains(&problem.message) {
            problem.severity = Severity::Error;
        }
        if problem.is_error() {
            broken.push(problem);
        } else if is_followed || problem.message == &gcode::OFFSET_LEFT_ON {
            doubts.push(problem);
        }
    }
    let is_spindle_started = is_spindle_started(steps) || !expected.is_manual && job.starts_spindle();
    if control.is_none() && (expected.tolerance.is_none() || !is_spindle_started) {
        // The text's words may mean something other than the spindle, or the operator switches the spindle and the final M5 is only for safety.
        broken.retain(|problem| !is_rule_of_spindle(problem));
    }
    if expected.is_for_beam || !is_known {
        broken.retain(|problem| problem.message != &gcode::CHANGE_NOT_RAISED);
    }
    (broken, doubts)
}

/// Adds the line of the output and the part of the definition that produced it to a problem, because no file is written after an error.
pub(super) fn in_output(mut problem: Diagnostic, output: &[u8], origins: &[LineOrigin]) -> Diagnostic {
    let Some(number) = problem.place.line.take() else { return problem };
    let index = usize::try_from(number).unwrap_or(usize::MAX).saturating_sub(1);
    if problem.text.is_none()
        && let Some(line) = line_of(output, number)
    {
        problem.text = Some(TextFault::new(&line, 0..line.len()));
    }
    if problem.argument("line").is_none() {
        let arguments = vec![("line", u64::from(number).into())];
        problem.notes.push(Note { message: &posts::IN_OUTPUT, arguments });
    }
    if let Some(LineOrigin { section, line }) = origins.get(index) {
        let mut arguments = vec![("section", Value::quoted(section))];
        let message = if *line > 0 { &posts::WRITTEN_BY_LINE } else { &posts::WRITTEN_BY };
        arguments.extend((*line > 0).then(|| ("at", u64::from(*line).into())));
        problem.notes.push(Note { message, arguments });
    }
    problem
}

/// Returns a line of the output by its number, counted from 1.
pub(super) fn line_of(output: &[u8], number: u32) -> Option<Cow<'_, str>> {
    let index = usize::try_from(number).ok()?.checked_sub(1)?;
    let line = output.split(|byte| *byte == b'\n').nth(index)?;
    Some(String::from_utf8_lossy(line.trim_ascii_end()))
}

/// Returns a warning about the first probing move that goes on if the probe touches nothing. Probes of jobs stop with an error.
fn lenient_probe_warning(steps: &[Step]) -> Option<Diagnostic> {
    let is_lenient = |step: &&Step| {
        matches!(&step.action, Action::Move(Move { pace: Pace::Probe { must_answer: false, .. }, .. }))
    };
    let step = steps.iter().find(is_lenient)?;
    Some(Diagnostic::new(&posts::PROBE_WITHOUT_ALARM).at_line(step.line, None))
}

/// Makes all probing moves equal. Probing words differ between controls in whether a missing contact is an error, but the move is the
/// same.
fn with_equal_probes((line, mut movement): (u32, Move)) -> (u32, Move) {
    if let Pace::Probe { must_answer, .. } = &mut movement.pace {
        *must_answer = true;
    }
    (line, movement)
}

fn as_finding_of_post(found: Diagnostic) -> Diagnostic {
    if found.message.code == posts::POST_DIFFERS.code && found.place.line.is_none() {
        return found;
    }
    let line = u64::from(found.place.line.unwrap_or(0));
    let mut diagnostic = Diagnostic::new(&posts::POST_DIFFERS).with("line", line);
    diagnostic.place.line = found.place.line;
    diagnostic.text = found.text;
    diagnostic.notes.push(Note { message: found.message, arguments: found.arguments });
    diagnostic
}

/// Returns the moves of a job, each with the number of its step (from 1).
fn moves(job: &Job) -> Result<Vec<(u32, Move)>, Box<Diagnostic>> {
    let mut mover = MoveBuilder { at: Position::default(), moves: Vec::new(), number: 0 };
    for operation in &job.operations {
        mover.enter(operation);
        for step in &operation.steps {
            mover.number += 1;
            mover.step(step)?;
        }
    }
    Ok(mover.moves.into_iter().map(with_equal_probes).collect())
}

struct MoveBuilder {
    at: Position,
    moves: Vec<(u32, Move)>,
    number: u32,
}

impl MoveBuilder {
    /// Adds the moves to the start of an operation, unless the tool is already there.
    fn enter(&mut self, operation: &Operation) {
        match operation.entry {
            Entry::At([x, y, z]) => {
                let is_there = self.at == Position::known(x, y, z);
                if !is_there {
                    self.rapid([None, None, Some(operation.clearance)]);
                    self.rapid([Some(x), Some(y), None]);
                    self.rapid([None, None, Some(z)]);
                }
            }
            Entry::Clearance => self.rapid([None, None, Some(operation.clearance)]),
        }
    }

    fn rapid(&mut self, to: [Option<f64>; 3]) {
        self.go(to, MoveShape::Line, Pace::Rapid);
    }

    fn go(&mut self, to: [Option<f64>; 3], shape: MoveShape, pace: Pace) {
        let from = self.at;
        for (axis, target) in to.into_iter().enumerate() {
            if let Some(target) = target {
                self.at.at[axis] = target;
                self.at.known = self.at.known.with(Axes::of(axis));
            }
        }
        let named: Option<NamedPosition> = None;
        self.moves.push((self.number, Move { from, to: self.at, shape, pace, named }));
    }

    fn step(&mut self, step: &JobStep) -> Result<(), Box<Diagnostic>> {
        match step {
            JobStep::Move(movement) => {
                self.go(movement.to.axes(), movement.shape, movement.pace);
                if matches!(movement.pace, Pace::Probe { .. }) {
                    // Only the machine knows where the probe stops.
                    self.at.known = Axes::NONE;
                }
            }
            JobStep::Hole(hole) => {
                for step in hole.moves()? {
                    self.step(&step)?;
                }
            }
            JobStep::Dwell { .. } | JobStep::Stop | JobStep::SpindleOff { .. } | JobStep::Comment(_) => {}
        }
        Ok(())
    }
}

/// Finds the first rapid during which the beam may be on. The spindle words switch the beam.
pub(super) fn check_beam(steps: &[Step]) -> Option<Diagnostic> {
    let mut is_on = false;
    for step in steps {
        match &step.action {
            Action::Spindle(spindle) => {
                is_on = spindle.turning.is_on();
            }
            Action::Move(movement) if is_on && movement.pace == Pace::Rapid && !movement.is_standstill() => {
                return Some(Diagnostic::new(&posts::BEAM_ON).at_line(step.line, None));
            }
            _ => {}
        }
    }
    None
}

pub(super) fn is_spindle_started(steps: &[Step]) -> bool {
    steps.iter().any(|step| match step.action {
        Action::Spindle(spindle) => spindle.turning.is_on(),
        _ => false,
    })
}

/// Warns about a spindle that is started, or reversed, after the last cut.
fn late_spindle_start_warning(steps: &[Step]) -> Option<Diagnostic> {
    let is_cut = |step: &Step| matches!(&step.action, Action::Move(movement) if matches!(movement.pace, Pace::Feed(_)));
    let last_cut = steps.iter().rposition(is_cut)?;
    let turnings = steps.iter().enumerate().filter_map(|(index, step)| match step.action {
        Action::Spindle(spindle) => Some((index, step.line, spindle.turning)),
        _ => None,
    });
    let mut before = Turning::Unstated;
    for (index, line, turning) in turnings {
        if index > last_cut && turning.is_on() && turning != before {
            return Some(Diagnostic::new(&posts::SPINDLE_STARTED_AT_END).at_line(line, None));
        }
        before = turning;
    }
    None
}

/// Whether a problem violates one of `verify`'s rules about the spindle.
pub(super) fn is_rule_of_spindle(problem: &Diagnostic) -> bool {
    let rules = [
        &gcode::SPINDLE_OFF,
        &gcode::SPINDLE_AT_ZERO,
        &gcode::SPINDLE_WITHOUT_SPEED,
        &gcode::SPINDLE_LEFT_ON,
    ];
    rules.contains(&problem.message)
}
