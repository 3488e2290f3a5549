//! Executes blocks. The words of a block are executed in the order prescribed by the standard, regardless of their order in the text.

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message, Severity};
use pathbuild_motion::{Action, Axes, Change, Move, Pace, Step};

use super::codes;
use super::evaluate::{Parameters, StatedProbes};
use super::gather::{Gathered, Jump, Slot};
use super::state::State;
use super::state::{Heights, Options};
use crate::dialect::{Acceptance, Percent, Rules, beginning_of};
use crate::read::{At, Block, Problems, Span};

/// The state of a program, and the effects of its blocks.
pub(super) struct Interpreter<'i> {
    pub(super) rules: &'static Rules,
    pub(super) options: &'i Options,
    pub(super) state: State,
    pub(super) words: Gathered,
    pub(super) problems: Problems,
    pub(super) parameters: Parameters,
    pub(super) stated: StatedProbes,
    /// The steps of the last block.
    pub(super) out: Vec<Step>,
    pub(super) ended: bool,
    /// Where the program goes on after the last block, unless in the next line.
    pub(super) jump: Option<Jump>,
    /// Whether the next block is the first one of a subprogram.
    pub(super) begins_subprogram: bool,
    /// O, the number of the program.
    pub(super) main_number: Option<u32>,
}

impl<'i> Interpreter<'i> {
    pub(super) fn new(rules: &'static Rules, options: &'i Options) -> Self {
        Self {
            rules,
            options,
            state: State::new(rules, options.offsets.as_ref()),
            words: Gathered::default(),
            problems: Problems::default(),
            parameters: Parameters::default(),
            stated: StatedProbes::default(),
            out: Vec::new(),
            ended: false,
            jump: None,
            begins_subprogram: false,
            main_number: None,
        }
    }

    /// Whether M2 or M30 has ended the program.
    pub(super) fn has_ended(&self) -> bool {
        self.ended
    }

    /// Returns the problems found, if the file ends in this line.
    pub(super) fn finish(mut self, last_line: u32, is_framed: bool) -> Problems {
        let has_end = [20, 300].iter().any(|code| self.rules.words.m(*code) == Acceptance::Taken);
        if !self.ended && !is_framed && has_end {
            let words = match self.rules.spelling.percent {
                Percent::Frame => "M2, M30, %",
                Percent::Start | Percent::Title => "M30",
                Percent::Refused => "M2, M30",
            };
            self.problems.add_at_line(&say::NO_END, last_line, |d| d.quoting("words", words));
        }
        self.problems
    }

    /// Executes a block.
    pub(super) fn block(&mut self, block: &Block<'_>) {
        for comment in block.comments {
            self.check_active(block, comment.text);
            self.take_stated(block, comment.text);
            self.step(block, Action::Comment(block.text_of(comment.text).into()));
        }
        self.begin_words(block);
        self.words.clear();
        let o_word = block.o_word.map_or(Ok(()), |word| self.o_word(block, word));
        if let Err((fault, span)) = o_word.and_then(|()| self.gather(block)) {
            self.report(block, &say::NO_VALUE, span, |d| d.with("reason", fault.0));
            return;
        }
        if !self.words.settings.is_empty() {
            self.step(block, Action::Change(Change::Parameter));
            self.set_parameters();
        }
        self.check_conflicts(block);
        self.state_words(block);
        self.execute(block);
        self.report_unused(block);
    }

    /// Reports a comment that the control obeys because of its beginning.
    fn check_active(&mut self, block: &Block<'_>, text: Span) {
        if let Some(word) = beginning_of(&block.text_of(text), self.rules.spelling.active_comments) {
            self.report(block, &say::ACTIVE_COMMENT, text, |d| d.quoting("word", word.trim_end_matches(',')));
        }
    }

    pub(super) fn step(&mut self, block: &Block<'_>, action: Action) {
        self.out.push(Step { line: block.line, action, stated: self.state.stated_axes });
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
        self.state.position = movement.to;
        self.step(block, Action::Move(movement));
    }

    pub(super) fn report(
        &mut self,
        block: &Block<'_>,
        message: &'static Message,
        span: Span,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        let dialect = self.rules.dialect.name();
        self.problems.add(message, At::block(block, span), |d| values(d).quoting("dialect", dialect));
    }

    /// Reports what the dialect does not know; as a warning if it ignores such things.
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
        self.feed_mode(block);
        self.set_feed(block);
        self.set_speed(block);
        self.tool(block);
        let stops_last = self.rules.stops_last && self.words.m_code(&[50, 90]).is_some();
        if !stops_last {
            self.spindle_and_coolant(block);
        }
        self.dwell(block);
        self.modes(block);
        let has_moved = self.coordinates_taken(block) || self.motion(block);
        if stops_last {
            self.spindle_and_coolant(block);
        } else if has_moved {
            self.check_stop_before_motion(block);
        }
        self.stop(block);
        self.subprogram(block);
        self.begins_subprogram = false;
    }

    /// Converts a height or coordinate to mm.
    pub(super) fn millimetres(&self, slot: Slot) -> f64 {
        let value = match self.options.heights {
            Heights::Nominal => slot.value - slot.correction,
            Heights::AsWritten => slot.value,
        };
        value * self.state.unit
    }
}

/// Converts the number of a tool, a layer or repetitions.
pub(super) fn whole(value: f64) -> Option<u32> {
    let nearest = libm::round(value);
    let fits = libm::fabs(value - nearest) < 0.0001 && (0.0..f64::from(u32::MAX)).contains(&nearest);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, and within a u32")]
    fits.then_some(nearest as u32)
}
