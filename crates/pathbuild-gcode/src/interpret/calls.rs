//! Executes subprograms, loops and branches. (book: program/reading, "Subprograms")
//!
//! Subprograms must be in the same file: `o100 sub`, `O100`, or, for M97, the lines from a block number on.

use std::collections::HashMap;
use std::ops::ControlFlow;

use pathbuild_diagnostic::Message;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, StatedWord, Step, WordEffect};

use super::codes;
use super::evaluate::name_of;
use super::execute::{Interpreter, Jump, LoopExit, SubprogramName, ValueFault, limits, whole_number};
use super::switches::CALLS;
use crate::read::{Block, BlockReader, Code, OWord, OWordKind, Place, Value};

/// Maximum depth of calls and loops, as in LinuxCNC.
const MAX_CALL_DEPTH: usize = 10;

/// Maximum number of lines executed by all calls and loops of a file, so that a few bytes cannot describe hours of work.
const MAX_REPEATED_LINES: u32 = 1_000_000;

/// The way in which executing or skipping lines has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RunEnd {
    Returned,
    /// A pass through a loop is complete, or the jump has been executed: the next line follows.
    Repeated,
    /// A `break` or `continue` ended a pass of the loop that [`Runner::left_loop`] names.
    Left(LoopExit),
    /// The file has no more lines.
    NoLines,
    /// The program has ended, or the caller wants no more steps, or too many lines have been executed.
    Ended,
}

/// Runner that executes the lines of a file, with the subprograms that they call.
pub(super) struct Runner<'r, 'i> {
    interpreter: &'r mut Interpreter<'i>,
    each: &'r mut dyn FnMut(Step) -> ControlFlow<()>,
    /// The start of each subprogram of the file; determined at the first call.
    definitions: Option<HashMap<SubprogramName, Definition>>,
    active: Vec<SubprogramName>,
    /// The `while` and `do` loops that the current subprogram is executing.
    loops: Vec<OpenLoop>,
    /// The name of the loop that `break` or `continue` leaves.
    left_loop: Box<str>,
    /// Flags of earlier `break` and `continue` words that LinuxCNC has not cleared yet.
    stale: StaleFlags,
    depth: usize,
    /// Number of lines that calls and loops have executed.
    lines: u32,
    pub(super) has_words: bool,
}

/// The start of a subprogram.
#[derive(Clone, Copy, Debug)]
struct Definition {
    place: Place,
    /// The line of a second definition with the same name. Which of the two the control runs depends on its settings.
    second: Option<u32>,
}

/// A `while` or `do` loop that is being executed.
#[derive(Debug)]
struct OpenLoop {
    name: Box<str>,
    /// Whether the loop tests its condition after each pass.
    is_do: bool,
}

/// Two flags of LinuxCNC: one notes that a loop was left by `break`, the other that a pass was left by `continue`. Only the end of a `do` loop
/// clears the first one, and only the end of a `while` or `repeat` loop the second one. Until then, a flag affects other loops as well: the
/// next `do` loop ends after its first pass, and the next `repeat` loop, or `while` loop left by `break`, runs again.
#[derive(Clone, Copy, Debug, Default)]
struct StaleFlags {
    /// The line of a `break` that left a `while` loop.
    break_line: Option<u32>,
    /// The line of a `continue` in a `do` loop.
    continue_line: Option<u32>,
}

impl<'r, 'i> Runner<'r, 'i> {
    pub(super) fn new(
        interpreter: &'r mut Interpreter<'i>,
        each: &'r mut dyn FnMut(Step) -> ControlFlow<()>,
    ) -> Self {
        Self {
            interpreter,
            each,
            definitions: None,
            active: Vec::new(),
            loops: Vec::new(),
            left_loop: Box::default(),
            stale: StaleFlags::default(),
            depth: 0,
            lines: 0,
            has_words: false,
        }
    }

    pub(super) fn run_file(&mut self, reader: &mut BlockReader<'_>) {
        while self.run(reader) == RunEnd::Ended {
            reader.end_program();
        }
    }

    fn run(&mut self, reader: &mut BlockReader<'_>) -> RunEnd {
        loop {
            let before = reader.place();
            let Some(block) = reader.next_block() else { return RunEnd::NoLines };
            self.has_words |= !block.words.is_empty() || !block.settings.is_empty() || block.o_word.is_some();
            self.interpreter.block(&block);
            let line = block.line;
            let is_unwanted = self.interpreter.out.drain(..).try_for_each(&mut *self.each).is_break();
            if is_unwanted || self.interpreter.ended {
                return RunEnd::Ended;
            }
            if self.depth > 0 {
                self.lines += 1;
                if self.lines > MAX_REPEATED_LINES {
                    self.report(&say::CALLS_TOO_LONG, line, "", u64::from(MAX_REPEATED_LINES));
                    return RunEnd::Ended;
                }
            }
            self.interpreter.has_jumped |= self.interpreter.jump.is_some();
            let outcome = match self.interpreter.jump.take() {
                None => continue,
                Some(Jump::Return | Jump::EndRepeat) if self.depth == 0 => {
                    self.report(&say::END_WITHOUT_CALL, line, "", 0);
                    continue;
                }
                Some(Jump::Return) => return RunEnd::Returned,
                Some(Jump::EndRepeat) => return RunEnd::Repeated,
                Some(Jump::SkipTo(name, end)) => self.skip_to_end(reader, &name, end, line),
                Some(Jump::Branch(name)) => self.skip_to_branch(reader, &name, line),
                Some(Jump::Call(name, times, values)) => self.call(reader, name, times, &values, line),
                Some(Jump::Repeat(name, times)) => self.repeat(reader, &name, times, line),
                Some(Jump::While(name)) if self.is_end_of_do(&name) => return RunEnd::Repeated,
                Some(Jump::While(name)) => self.repeat_while(reader, name, before, line),
                Some(Jump::Do(name)) => self.repeat_do(reader, name, line),
                Some(Jump::Leave(name, exit)) => {
                    if let Some(open) = self.loops.iter().find(|open| open.name == name) {
                        match (exit, open.is_do) {
                            (LoopExit::Continue, true) => self.stale.continue_line = Some(line),
                            (LoopExit::Break, false) => self.stale.break_line = Some(line),
                            (LoopExit::Continue, false) | (LoopExit::Break, true) => {}
                        }
                        self.left_loop = name;
                        return RunEnd::Left(exit);
                    }
                    self.report(&say::LEFT_WITHOUT_LOOP, line, &format!("o{name}"), 0);
                    continue;
                }
            };
            if outcome != RunEnd::Repeated {
                return outcome;
            }
        }
    }

    fn is_end_of_do(&self, name: &str) -> bool {
        self.loops.last().is_some_and(|open| open.is_do && *open.name == *name)
    }

    /// Runs a subprogram. If the result is `Repeated`, execution continues after the call.
    fn call(
        &mut self,
        reader: &mut BlockReader<'_>,
        name: SubprogramName,
        times: u32,
        values: &[f64],
        line: u32,
    ) -> RunEnd {
        let shown = name.display_name();
        let Some((name, Definition { place, second }, times)) = self.definition(reader, name, times) else {
            self.report(&say::CALLED_ELSEWHERE, line, &shown, 0);
            return RunEnd::Repeated;
        };
        if let Some(second) = second {
            self.report(&say::DEFINED_TWICE, second, &name.display_name(), 0);
        }
        let is_main =
            matches!(name, SubprogramName::Program(number) if self.interpreter.main_number == Some(number));
        if is_main || self.active.contains(&name) {
            self.report(&say::CALLED_BY_ITSELF, line, &shown, 0);
            return RunEnd::Repeated;
        }
        if !self.enter(line) {
            return RunEnd::Repeated;
        }
        if reader.is_before(place) {
            reader.allow_subprograms();
        }
        let is_local = matches!(name, SubprogramName::Subroutine(_));
        self.active.push(name);
        let saved = is_local.then(|| self.interpreter.parameters.enter(values));
        let loops = std::mem::take(&mut self.loops);
        let mut outcome = RunEnd::Returned;
        for _ in 0..times {
            self.interpreter.begins_subprogram = true;
            outcome = self.run_body(reader, place);
            if outcome != RunEnd::Returned {
                break;
            }
        }
        if let Some(saved) = saved {
            self.interpreter.parameters.leave(saved);
        }
        self.active.pop();
        self.loops = loops;
        self.depth -= 1;
        match outcome {
            RunEnd::Ended => RunEnd::Ended,
            RunEnd::Returned => RunEnd::Repeated,
            RunEnd::NoLines | RunEnd::Repeated | RunEnd::Left(_) => {
                self.report(&say::CALLED_WITHOUT_END, line, &shown, 0);
                RunEnd::Repeated
            }
        }
    }

    fn repeat(&mut self, reader: &mut BlockReader<'_>, name: &str, times: u32, line: u32) -> RunEnd {
        let start = reader.place();
        let outcome = self.skip_to_end(reader, name, OWordKind::EndRepeat, line);
        if outcome != RunEnd::Repeated || !self.enter(line) {
            return outcome;
        }
        let mut outcome = RunEnd::Repeated;
        for _ in 0..times {
            outcome = self.run_body(reader, start);
            if outcome != RunEnd::Repeated {
                break;
            }
        }
        match outcome {
            RunEnd::Repeated if times > 0 => self.end_after_continue(name, line),
            // `repeat [0]`: LinuxCNC restarts the loop because of an earlier `continue`, but there is no pass to run.
            RunEnd::Repeated => self.stale.continue_line = None,
            _ => {}
        }
        self.depth -= 1;
        outcome
    }

    /// Runs the lines up to the end of a `while` loop as long as its condition holds. The condition is in the line that follows `condition`.
    fn repeat_while(
        &mut self,
        reader: &mut BlockReader<'_>,
        name: Box<str>,
        condition: Place,
        line: u32,
    ) -> RunEnd {
        let start = reader.place();
        match self.find_end(reader, &name, OWordKind::EndWhile, line) {
            Some(_) => self.run_loop(reader, OpenLoop { name, is_do: false }, start, condition, line),
            None => RunEnd::NoLines,
        }
    }

    fn repeat_do(&mut self, reader: &mut BlockReader<'_>, name: Box<str>, line: u32) -> RunEnd {
        let start = reader.place();
        match self.find_end(reader, &name, OWordKind::While, line) {
            Some(condition) => self.run_loop(reader, OpenLoop { name, is_do: true }, start, condition, line),
            None => RunEnd::NoLines,
        }
    }

    /// Runs the lines from `start` on as long as the condition holds. A `do` loop tests its condition only after the first pass.
    fn run_loop(
        &mut self,
        reader: &BlockReader<'_>,
        open: OpenLoop,
        start: Place,
        condition: Place,
        line: u32,
    ) -> RunEnd {
        if !self.enter(line) {
            return RunEnd::Repeated;
        }
        let (name, is_do) = (open.name.clone(), open.is_do);
        let mut is_first = true;
        self.loops.push(open);
        let outcome = loop {
            let is_tested = !(std::mem::take(&mut is_first) && is_do);
            if is_tested && !self.loop_continues(reader, &name, is_do, condition) {
                break RunEnd::Repeated;
            }
            match self.run_body(reader, start) {
                RunEnd::Repeated => {}
                RunEnd::Left(LoopExit::Continue) if self.left_loop == name => {
                    if !is_do {
                        self.stale.continue_line = None;
                    }
                }
                RunEnd::Left(LoopExit::Break) if self.left_loop == name => {
                    if is_do {
                        self.stale.break_line = None;
                    } else {
                        self.end_after_continue(&name, line);
                    }
                    break RunEnd::Repeated;
                }
                outcome => break outcome,
            }
        };
        self.loops.pop();
        self.depth -= 1;
        outcome
    }

    /// Tests the condition in the line that follows the place `condition`. Returns true if another pass of the loop follows.
    fn loop_continues(
        &mut self,
        reader: &BlockReader<'_>,
        name: &str,
        is_do: bool,
        condition: Place,
    ) -> bool {
        let mut reader = reader.reader_from(condition);
        let Some(block) = reader.next_block() else { return false };
        let holds = self.interpreter.condition(&block);
        if is_do {
            if let Some(earlier) = self.stale.break_line.take().filter(|_| holds) {
                self.report_stale(&say::ENDED_BY_EARLIER_BREAK, block.line, name, earlier);
            }
        } else if !holds {
            // Because of the flag, LinuxCNC tests the condition once more, with the same result.
            self.stale.continue_line = None;
        }
        holds
    }

    /// Reports a loop that LinuxCNC restarts at its end because of an earlier `continue`.
    fn end_after_continue(&mut self, name: &str, line: u32) {
        if let Some(left) = self.stale.continue_line.take() {
            self.report_stale(&say::REPEATED_BY_EARLIER_CONTINUE, line, name, left);
        }
    }

    fn report_stale(&mut self, message: &'static Message, line: u32, name: &str, earlier: u32) {
        self.interpreter.problems.add_at_line(message, line, |d| {
            d.quoting("name", format!("o{name}")).with("earlier", u64::from(earlier))
        });
    }

    /// Skips the lines up to the next branch whose condition holds, or to the end of the branches.
    fn skip_to_branch(&mut self, reader: &mut BlockReader<'_>, name: &str, line: u32) -> RunEnd {
        while let Some(block) = reader.next_block() {
            let word = block.o_word.filter(|word| &*name_of_o_word(&block, *word) == name);
            match word.map(|word| word.kind) {
                Some(OWordKind::Else | OWordKind::EndIf) => return RunEnd::Repeated,
                Some(OWordKind::ElseIf) if self.interpreter.condition(&block) => return RunEnd::Repeated,
                _ => {}
            }
        }
        self.report(&say::CALLED_WITHOUT_END, line, &format!("o{name}"), 0);
        RunEnd::NoLines
    }

    fn run_body(&mut self, reader: &BlockReader<'_>, place: Place) -> RunEnd {
        let mut body = reader.reader_from(place);
        let outcome = self.run(&mut body);
        self.interpreter.problems.append(body.into_problems());
        outcome
    }

    fn skip_to_end(&mut self, reader: &mut BlockReader<'_>, name: &str, end: OWordKind, line: u32) -> RunEnd {
        self.find_end(reader, name, end, line).map_or(RunEnd::NoLines, |_| RunEnd::Repeated)
    }

    /// Skips the lines up to the end of a subroutine, a loop or an `if`, and returns the place before that end.
    fn find_end(
        &mut self,
        reader: &mut BlockReader<'_>,
        name: &str,
        end: OWordKind,
        line: u32,
    ) -> Option<Place> {
        loop {
            let before = reader.place();
            let Some(block) = reader.next_block() else { break };
            let is_end = |word: OWord| word.kind == end && &*name_of_o_word(&block, word) == name;
            if block.o_word.is_some_and(is_end) {
                return Some(before);
            }
        }
        self.report(&say::CALLED_WITHOUT_END, line, &format!("o{name}"), 0);
        None
    }

    /// Enters a call or loop. Reports an error and returns false if calls and loops are nested too deeply.
    fn enter(&mut self, line: u32) -> bool {
        if self.depth >= MAX_CALL_DEPTH {
            self.report(&say::CALLS_TOO_DEEP, line, "", MAX_CALL_DEPTH as u64);
            return false;
        }
        self.depth += 1;
        true
    }

    /// Finds the definition of a subprogram. If there is no O30100, `P30100` calls O100 three times.
    fn definition(
        &mut self,
        reader: &BlockReader<'_>,
        name: SubprogramName,
        times: u32,
    ) -> Option<(SubprogramName, Definition, u32)> {
        let definitions = self.definitions.get_or_insert_with(|| definitions(reader.reader_from_start()));
        if let Some(definition) = definitions.get(&name) {
            return Some((name, *definition, times));
        }
        let SubprogramName::Program(packed) = name else { return None };
        let name = SubprogramName::Program(packed % 10_000);
        let definition = definitions.get(&name).filter(|_| packed >= 10_000 && times == 1)?;
        Some((name, *definition, packed / 10_000))
    }

    fn report(&mut self, message: &'static Message, line: u32, name: &str, most: u64) {
        self.interpreter.problems.add_at_line(message, line, |d| match most {
            0 => d.quoting("name", name),
            most => d.with("most", most),
        });
    }
}

/// Returns the name of an O word, or its number without leading zeros.
fn name_of_o_word(block: &Block<'_>, word: OWord) -> Box<str> {
    let name = name_of(block, word.name);
    if name.bytes().all(|byte| byte.is_ascii_digit()) { name.trim_start_matches('0').into() } else { name }
}

fn definitions(mut reader: BlockReader<'_>) -> HashMap<SubprogramName, Definition> {
    let mut found: HashMap<SubprogramName, Definition> = HashMap::new();
    let mut add = |name, place, line| {
        let repeat = |known: &mut Definition| _ = known.second.get_or_insert(line);
        found.entry(name).and_modify(repeat).or_insert(Definition { place, second: None });
    };
    loop {
        let before = reader.place();
        let Some(block) = reader.next_block() else { return found };
        if let Some(word) = block.o_word.filter(|word| word.kind == OWordKind::Sub) {
            let name = SubprogramName::Subroutine(name_of_o_word(&block, word));
            let line = block.line;
            add(name, reader.place(), line);
            continue;
        }
        let first = block.words.first().filter(|word| word.letter == b'O');
        let program = first.and_then(|word| match word.value {
            Value::Number(number) => whole_number(number.value).map(SubprogramName::Program),
            Value::Expression(_) => None,
        });
        let number = block.number.and_then(|number| whole_number(number.value)).map(SubprogramName::Line);
        for name in program.into_iter().chain(number) {
            add(name, before, block.line);
        }
    }
}

impl Interpreter<'_> {
    /// Executes an O word, or reports it if its keyword is not supported.
    pub(super) fn o_word(&mut self, block: &Block<'_>, word: OWord) -> Result<(), ValueFault> {
        let call = StatedWord { letter: 'O', code: 0, group: None, effect: WordEffect::Call };
        self.step(block, Action::Word(call));
        let name = name_of_o_word(block, word);
        self.jump = match word.kind {
            OWordKind::Sub => Some(Jump::SkipTo(name, OWordKind::EndSub)),
            OWordKind::Call => {
                Some(Jump::Call(SubprogramName::Subroutine(name), 1, self.arguments(block, word)?))
            }
            OWordKind::Return | OWordKind::EndSub => Some(Jump::Return),
            OWordKind::Repeat => self.repetitions(block, word, name)?,
            OWordKind::If => (!self.condition(block)).then_some(Jump::Branch(name)),
            // The preceding branch was executed, so this one is skipped.
            OWordKind::ElseIf | OWordKind::Else => Some(Jump::SkipTo(name, OWordKind::EndIf)),
            OWordKind::EndIf => None,
            OWordKind::While => Some(Jump::While(name)),
            OWordKind::Do => Some(Jump::Do(name)),
            OWordKind::Break => Some(Jump::Leave(name, LoopExit::Break)),
            OWordKind::Continue => Some(Jump::Leave(name, LoopExit::Continue)),
            OWordKind::EndRepeat | OWordKind::EndWhile => Some(Jump::EndRepeat),
            OWordKind::Other => {
                self.report(block, &say::O_WORD, word.span, |d| d);
                None
            }
        };
        Ok(())
    }

    fn repetitions(
        &mut self,
        block: &Block<'_>,
        word: OWord,
        name: Box<str>,
    ) -> Result<Option<Jump>, ValueFault> {
        let times = self.arguments(block, word)?.first().copied().and_then(whole_number);
        if times.is_none() {
            self.report(block, &say::O_WORD, word.span, |d| d);
        }
        Ok(times.map(|times| Jump::Repeat(name, times)))
    }

    fn arguments(&mut self, block: &Block<'_>, word: OWord) -> Result<Vec<f64>, ValueFault> {
        let value = |argument: &Code| Ok(self.value(block, Value::Expression(*argument), word.span)?.0);
        block.arguments.iter().map(value).collect()
    }

    /// Evaluates the condition of a block's O word. A missing value is reported and treated as false.
    fn condition(&mut self, block: &Block<'_>) -> bool {
        let Some(word) = block.o_word else { return false };
        match self.arguments(block, word) {
            Ok(values) if values.is_empty() => {
                self.report(block, &say::O_WORD, word.span, |d| d);
                false
            }
            Ok(values) => values[0] != 0.0,
            Err((fault, span)) => {
                self.report(block, &say::NO_VALUE, span, |d| d.with("reason", fault.0));
                false
            }
        }
    }

    /// Executes M97, M98 and M99.
    pub(super) fn execute_subprogram_word(&mut self, block: &Block<'_>) {
        let Some((code, span)) = self.words.m_code(CALLS).filter(|(code, _)| self.is_subprogram_code(*code))
        else {
            return;
        };
        let place = self.words.values.take_slot(b'P');
        match (code, place) {
            (990, None) => self.jump = Some(Jump::Return),
            (990, Some(_)) => self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", "M99 P")),
            (_, None) => self.report(block, &say::NEEDS, span, |d| {
                d.quoting("word", codes::name('M', code)).quoting("missing", "P")
            }),
            (_, Some(place)) => {
                let repeats = self.words.values.take_slot(b'L');
                match (whole_number(place.value), repeats.map_or(Some(1), |slot| whole_number(slot.value))) {
                    (Some(number), Some(times)) => {
                        let name = if code == 970 {
                            SubprogramName::Line(number)
                        } else {
                            SubprogramName::Program(number)
                        };
                        self.jump = Some(Jump::Call(name, times, Vec::new()));
                    }
                    (None, _) => self.report_out_of_range(block, "P", place, &limits::COUNT),
                    (_, None) => {
                        self.report_out_of_range(block, "L", repeats.unwrap_or(place), &limits::COUNT);
                    }
                }
            }
        }
    }
}
