//! Executes blocks. The words of a block are sorted by kind and executed in the order prescribed by the standard, regardless of their order in
//! the text.

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message, Severity, Text};
use pathbuild_motion::{Action, Axes, Change, Group, Move, Pace, Step};

use super::codes;
use super::codes::{Command, Motion, ValueOwner};
use super::evaluate::{Fault, Parameters, StatedProbes};
use super::half_circles::DoubtfulArcs;
use super::state::{ClearedZero, Heights, Options, State};
use crate::dialect::{MCodeOrder, Percent, Rules, leading_word};
use crate::read::{Block, OWordKind, Problems, SourcePosition, Span};

/// Interpreter of a program, with the modal state of the control and the effects of the last block.
pub(super) struct Interpreter<'i> {
    pub(super) rules: &'static Rules,
    pub(super) options: &'i Options,
    pub(super) state: State,
    pub(super) words: BlockWords,
    pub(super) problems: Problems,
    pub(super) half_circles: DoubtfulArcs,
    pub(super) parameters: Parameters,
    pub(super) stated_probes: StatedProbes,
    /// Steps produced by the last block.
    pub(super) out: Vec<Step>,
    /// Whether M2 or M30 has ended the program.
    pub(super) ended: bool,
    /// The place where execution continues after the last block, if not in the next line.
    pub(super) jump: Option<Jump>,
    /// Position of the block in the order of execution, which is its line until the first jump.
    order: u32,
    pub(super) has_jumped: bool,
    /// Whether the next block is the first one of a subprogram.
    pub(super) begins_subprogram: bool,
    /// The number of the program, from its O word.
    pub(super) main_number: Option<u32>,
}

impl<'i> Interpreter<'i> {
    pub(super) fn new(rules: &'static Rules, options: &'i Options) -> Self {
        Self {
            rules,
            options,
            state: State::new(rules, options.offsets.as_ref()),
            words: BlockWords::default(),
            problems: Problems::default(),
            half_circles: DoubtfulArcs::default(),
            parameters: Parameters::default(),
            stated_probes: StatedProbes::default(),
            out: Vec::new(),
            ended: false,
            jump: None,
            order: 0,
            has_jumped: false,
            begins_subprogram: false,
            main_number: None,
        }
    }

    /// Completes the checks at the end of the file and returns the problems found.
    pub(super) fn finish(mut self, last_line: u32, is_framed: bool) -> Problems {
        if let Some((line, code)) = self.state.referenced.take() {
            self.report_reference(line, code, Severity::Warning);
        }
        if let Some(cleared) = self.state.cleared_zero.take().filter(|cleared| cleared.has_moved) {
            self.report_cleared_zero(cleared, Severity::Warning);
        }
        let has_end = [20, 300].iter().any(|code| self.rules.words.has_m(*code));
        if !self.ended && !is_framed && has_end {
            let words = match self.rules.spelling.percent {
                Percent::Frame => &Text { en: "M2, M30 or %", de: "M2, M30 oder %" },
                Percent::Start | Percent::Title => &Text { en: "M30", de: "M30" },
                Percent::Refused => &Text { en: "M2 or M30", de: "M2 oder M30" },
            };
            self.problems.add_at_line(&say::NO_END, last_line, |d| d.with("words", words));
        }
        self.problems.append(self.half_circles.finish());
        self.problems
    }

    /// Executes a block and appends its steps to `out`.
    pub(super) fn block(&mut self, block: &Block<'_>) {
        self.order = if self.has_jumped { self.order + 1 } else { block.line };
        for comment in &block.comments {
            self.check_active(block, comment.text);
            self.take_stated(block, comment.text);
            self.step(block, Action::Comment(block.text_of(comment.text).into()));
        }
        self.begin_words(block);
        self.words.clear();
        let o_word = block.o_word.map_or(Ok(()), |word| self.o_word(block, word));
        if let Err((fault, span)) = o_word.and_then(|()| self.evaluate_words(block)) {
            self.report(block, &say::NO_VALUE, span, |d| d.with("reason", fault.0));
            return;
        }
        if !self.words.settings.is_empty() {
            self.step(block, Action::Change(Change::Parameter));
            self.set_parameters(block);
        }
        self.check_conflicts(block);
        self.emit_word_steps(block);
        self.execute(block);
        self.report_unused(block);
    }

    /// Reports a comment that the control obeys because of its beginning.
    fn check_active(&mut self, block: &Block<'_>, text: Span) {
        if let Some(word) = leading_word(&block.text_of(text), self.rules.spelling.active_comments) {
            self.report(block, &say::ACTIVE_COMMENT, text, |d| d.quoting("word", word.trim_end_matches(',')));
        }
    }

    pub(super) fn step(&mut self, block: &Block<'_>, action: Action) {
        let (stated, stated_since_stop) = (self.state.stated_axes, self.state.stated_since_stop);
        self.out.push(Step { line: block.line, order: self.order, action, stated, stated_since_stop });
    }

    pub(super) fn emit_move(&mut self, block: &Block<'_>, movement: Move) {
        let begins_lost = movement.from.known != Axes::ALL && movement.pace != Pace::Rapid;
        if let Some((line, code)) = self.state.lost.filter(|_| begins_lost) {
            let word = codes::name('G', code);
            self.problems.add_at_line(&say::POSITION_UNKNOWN, line, |d| d.quoting("word", word));
        }
        if begins_lost || movement.to.known == Axes::ALL {
            self.state.lost = None;
        }
        self.state.is_lifted = match movement.pace {
            Pace::Rapid => self.state.is_lifted || rises(&movement),
            Pace::Feed(_) | Pace::Probe { .. } => false,
        };
        if matches!(movement.pace, Pace::Feed(_)) {
            self.state.has_cut = true;
            self.state.offsets.set_reference_length();
            if let Some((line, code)) = self.state.referenced.take() {
                self.report_reference(line, code, Severity::Error);
            }
        }
        if let Some(cleared) = &mut self.state.cleared_zero {
            let goes_along = |axis: usize| {
                cleared.axes.has(Axes::of(axis)) && movement.to.at[axis] != movement.from.at[axis]
            };
            cleared.has_moved |= movement.named.is_none() && (0..3).any(goes_along);
            if !cleared.axes.is_empty() && matches!(movement.pace, Pace::Feed(_)) {
                let cleared = *cleared;
                self.state.cleared_zero = None;
                self.report_cleared_zero(cleared, Severity::Error);
            }
        }
        self.state.position = movement.to;
        self.step(block, Action::Move(movement));
    }

    /// Reports a word that clears the zero of a touch-off. This is an error if a cut follows, and otherwise only a warning, because the moves may stay
    /// above the material.
    fn report_cleared_zero(&mut self, cleared: ClearedZero, severity: Severity) {
        self.problems.add_at_line(&say::ZERO_CLEARED, cleared.line, |d| Diagnostic {
            severity,
            ..d.quoting("word", codes::name('G', cleared.code))
        });
    }

    /// Reports a move to the reference switches after the first cut. If no other cut follows, the move may only park the machine.
    fn report_reference(&mut self, line: u32, code: u16, severity: Severity) {
        let dialect = self.rules.dialect.name();
        self.problems.add_at_line(&say::REFERENCED, line, |d| {
            let d = d.quoting("word", codes::name('G', code)).quoting("dialect", dialect);
            Diagnostic { severity, ..d }
        });
    }

    pub(super) fn report(
        &mut self,
        block: &Block<'_>,
        message: &'static Message,
        span: Span,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        let dialect = self.rules.dialect.name();
        self.problems
            .add(message, SourcePosition::block(block, span), |d| values(d).quoting("dialect", dialect));
    }

    /// Reports a word or notation that the dialect does not support; as a warning if the control ignores it.
    pub(super) fn report_unknown(
        &mut self,
        block: &Block<'_>,
        message: &'static Message,
        span: Span,
        word: String,
    ) {
        let severity = if self.rules.words.lenient { Severity::Warning } else { Severity::Error };
        self.report(block, message, span, |mut diagnostic| {
            diagnostic.severity = severity;
            diagnostic.quoting("word", word)
        });
    }

    fn execute(&mut self, block: &Block<'_>) {
        if self.rules.program_numbers {
            self.program_number(block);
        }
        let pause = self.dwell_time(block);
        self.set_feed_mode(block);
        self.set_feed(block);
        self.set_speed(block);
        self.apply_tool_words(block);
        let stops_last = match self.rules.m_order {
            MCodeOrder::First => false,
            MCodeOrder::StopsLast => self.words.m_code(&[50, 90]).is_some(),
            MCodeOrder::Last => true,
        };
        if !stops_last {
            self.apply_spindle_and_coolant(block);
        }
        if let Some(seconds) = pause {
            self.step(block, Action::Dwell(seconds));
        }
        self.apply_modes(block);
        self.take_inert(block);
        let was_lifted = self.state.is_lifted;
        let may_move = self.owner_of_values(block) == ValueOwner::Move;
        let has_moved = may_move && (self.execute_coordinate_command(block) || self.motion(block));
        if stops_last {
            self.apply_spindle_and_coolant(block);
        } else if has_moved && !(was_lifted && self.state.is_lifted) {
            self.check_stop_before_motion(block);
        }
        self.apply_stop(block);
        self.execute_subprogram_word(block);
        self.begins_subprogram = false;
    }

    /// Converts a height or coordinate to mm. If the options ask for nominal heights, its correction is subtracted.
    pub(super) fn millimetres(&self, slot: Slot) -> f64 {
        let value = match self.options.heights {
            Heights::Nominal => slot.value - slot.correction,
            Heights::AsWritten => slot.value,
        };
        value * self.state.unit
    }
}

/// Whether a rapid move goes up, which lifts the tool out of the cut.
fn rises(movement: &Move) -> bool {
    let known = movement.from.known.and(movement.to.known);
    movement.homes_z() || known.has(Axes::Z) && movement.to.z() > movement.from.z()
}

/// Converts the number of a tool, a layer or repetitions; `None` if it is negative or not a whole number.
pub(super) fn whole_number(value: f64) -> Option<u32> {
    let nearest = libm::round(value);
    let fits = libm::fabs(value - nearest) < 0.0001 && (0.0..f64::from(u32::MAX)).contains(&nearest);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, and within a u32")]
    fits.then_some(nearest as u32)
}

/// The words of a block: commands in their order in the text, values by letter.
#[derive(Debug, Default)]
pub(super) struct BlockWords {
    pub(super) commands: Vec<(Command, u16, Span)>,
    pub(super) m_codes: Vec<(u16, Span)>,
    pub(super) values: Values,
    pub(super) settings: Vec<(AssignedParameter, f64)>,
}

/// A parameter set by the block. It takes effect after everything in the block has been read.
#[derive(Debug)]
pub(super) enum AssignedParameter {
    Numbered(u32),
    Named(Box<str>),
}

impl BlockWords {
    pub(super) fn clear(&mut self) {
        self.commands.clear();
        self.m_codes.clear();
        self.values.clear();
        self.settings.clear();
    }

    pub(super) fn command_of_group(&self, group: Group) -> Option<(Command, u16, Span)> {
        self.commands.iter().find(|(command, ..)| command.group() == group).copied()
    }

    /// Whether the block has a cycle that the dialect does not know, which has been reported.
    pub(super) fn has_unknown_cycle(&self) -> bool {
        self.commands.iter().any(|(command, ..)| *command == Command::Motion(Motion::Unfollowed))
    }

    pub(super) fn m_code(&self, codes: &[u16]) -> Option<(u16, Span)> {
        self.m_codes.iter().find(|(code, _)| codes.contains(code)).copied()
    }
}

/// The values of the letters in a block, and which of them have been used.
#[derive(Debug, Default)]
pub(super) struct Values {
    given: u32,
    used: u32,
    slots: [Slot; 26],
}

/// The value that a block gives for a letter.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Slot {
    pub(super) value: f64,
    /// Number of digits after the decimal point; for expressions, the largest `u8`.
    pub(super) decimals: u8,
    pub(super) span: Span,
    /// Amount, in the program's unit, that the word's formula adds to the value as a correction.
    pub(super) correction: f64,
}

/// Returns the bit of an upper-case letter in a set of letters.
const fn bit(letter: u8) -> u32 {
    1 << (letter - b'A')
}

impl Values {
    pub(super) const AXES: [u8; 3] = *b"XYZ";
    const COORDINATES: u32 = bit(b'X') | bit(b'Y') | bit(b'Z');

    fn clear(&mut self) {
        self.given = 0;
        self.used = 0;
    }

    /// Sets a letter. Returns false if it was set already.
    pub(super) fn set(&mut self, letter: u8, slot: Slot) -> bool {
        let is_new = self.given & bit(letter) == 0;
        self.given |= bit(letter);
        self.slots[usize::from(letter - b'A')] = slot;
        is_new
    }

    pub(super) fn has(&self, letter: u8) -> bool {
        self.given & bit(letter) != 0
    }

    pub(super) fn has_coordinates(&self) -> bool {
        self.given & Self::COORDINATES != 0
    }

    /// Returns the value and marks it as used.
    pub(super) fn take(&mut self, letter: u8) -> Option<f64> {
        self.take_slot(letter).map(|slot| slot.value)
    }

    /// Like [`take`](Self::take), but also returns the value's decimals, position and correction.
    pub(super) fn take_slot(&mut self, letter: u8) -> Option<Slot> {
        self.used |= bit(letter) & self.given;
        self.peek(letter)
    }

    /// Returns the value without marking it as used.
    pub(super) fn peek(&self, letter: u8) -> Option<Slot> {
        self.has(letter).then(|| self.slots[usize::from(letter - b'A')])
    }

    pub(super) fn discard_coordinates(&mut self) {
        self.given &= !Self::COORDINATES;
    }

    pub(super) fn remove(&mut self, letter: u8) -> Option<Slot> {
        let slot = self.peek(letter);
        self.given &= !bit(letter);
        slot
    }

    pub(super) fn take_coordinates(&mut self) -> [Option<Slot>; 3] {
        Self::AXES.map(|axis| self.take_slot(axis))
    }

    pub(super) fn are_all_used(&self) -> bool {
        self.given & !self.used == 0
    }

    pub(super) fn unused(&self) -> impl Iterator<Item = (u8, Span)> + '_ {
        let remaining = self.given & !self.used;
        (b'A'..=b'Z')
            .filter(move |letter| remaining & bit(*letter) != 0)
            .map(|letter| (letter, self.slots[usize::from(letter - b'A')].span))
    }
}

pub(super) type ValueFault = (Fault, Span);

/// The name by which a control calls a subprogram.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum SubprogramName {
    /// The name in `o100 sub` or `o<name> sub`.
    Subroutine(Box<str>),
    /// The number in `O100`.
    Program(u32),
    /// The block number in `N100`.
    Line(u32),
}

/// The place where execution continues after a block, unless it is the next line.
#[derive(Debug)]
pub(super) enum Jump {
    /// Runs a subprogram several times, with values for its parameters.
    Call(SubprogramName, u32, Vec<f64>),
    /// Runs the lines up to the end of the loop several times.
    Repeat(Box<str>, u32),
    /// Skips the lines up to the O word of this name and kind.
    SkipTo(Box<str>, OWordKind),
    /// Continues with the next branch whose condition holds.
    Branch(Box<str>),
    /// Begins a loop that tests its condition before each pass, or ends a pass through the loop that began with `do`.
    While(Box<str>),
    /// Begins a loop whose condition is tested after each pass.
    Do(Box<str>),
    /// Ends a pass through the loop of this name early.
    Leave(Box<str>, LoopExit),
    Return,
    /// Ends a pass through the innermost loop.
    EndRepeat,
}

/// The word that ends a pass through a loop early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LoopExit {
    Break,
    Continue,
}

impl SubprogramName {
    pub(super) fn display_name(&self) -> String {
        match self {
            Self::Subroutine(name) if name.bytes().all(|byte| byte.is_ascii_digit()) => format!("o{name}"),
            Self::Subroutine(name) => format!("o<{name}>"),
            Self::Program(number) => format!("O{number}"),
            Self::Line(number) => format!("N{number}"),
        }
    }
}

/// Texts of the limits that messages of PB725 contain. (book: reference/diagnostics)
pub(super) mod limits {
    use pathbuild_diagnostic::Text;

    macro_rules! limits {
        ($($key:ident: $en:literal, $de:literal;)*) => {
            $(pub(in crate::interpret) static $key: Text = Text { en: $en, de: $de };)*
        };
    }

    limits! {
        ANY_AXIS: "X, Y or Z", "X, Y oder Z";
        COUNT: "a whole number, 0 or more", "eine ganze Zahl ab 0";
        HOLES: "a whole number of holes, 1 or more", "eine ganze Zahl von Bohrungen ab 1";
        NOT_BELOW_Z: "at least Z", "mindestens Z";
        NOT_NEGATIVE: "0 or more", "0 oder mehr";
        NUMBER_OF_LAYER: "the number of a layer", "die Nummer eines Layers";
        OFFSETS: "0 to 9", "0 bis 9";
        POSITIVE: "more than 0", "größer als 0";
        REFERENCES: "2, 3 or 4", "2, 3 oder 4";
        SECONDS: "0 seconds or more", "0 Sekunden oder mehr";
        SYSTEMS: "the number of a coordinate system", "die Nummer eines Koordinatensystems";
        TURNS: "a whole number of turns from 1 to 100000", "eine ganze Zahl von Umläufen von 1 bis 100000";
    }
}
