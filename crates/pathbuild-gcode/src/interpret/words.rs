//! Reads the words of a block: determines the kind of each, and whether the dialect accepts it. (book: program/reading)

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Message, Severity};
use pathbuild_motion::{Action, Group, StatedWord, WordEffect};

use super::codes::{self, Command, Motion, ValueOwner};
use super::evaluate::{Scope, name_of, parameter_number};
use super::execute::{AssignedParameter, Interpreter, Slot, ValueFault, Values, limits};
use super::switches::{COOLANT, SPINDLE, STOPS, TOOL, is_executed_m};
use crate::dialect::MCodeLimit;
use crate::read::{Block, Span, Target, Value, Word};

/// Number of decimals that marks the value of an expression, which has no decimals of its own.
const EXPRESSION_DECIMALS: u8 = u8::MAX;

impl Interpreter<'_> {
    /// Sorts the words of a block and evaluates them.
    pub(super) fn evaluate_words(&mut self, block: &Block<'_>) -> Result<(), ValueFault> {
        if self.rules.one_command {
            self.check_command(block);
        }
        if self.rules.one_word_each {
            self.check_one_word_each(block);
        }
        for (index, word) in block.words.iter().enumerate() {
            let (value, decimals) = self.value(block, word.value, word.span)?;
            match word.letter {
                b'G' => self.g_word(block, word, value),
                b'M' => self.m_word(block, word, value),
                _ if self.owner_of_values(block) == ValueOwner::NotFollowed => {}
                letter => {
                    let correction = match block.formula(index) {
                        Some(formula) => self.correction(block, formula, value),
                        None if letter == b'Z' => {
                            self.height_without_formula(block, word.span, value);
                            0.0
                        }
                        None => 0.0,
                    };
                    self.letter(block, letter, Slot { value, decimals, span: word.span, correction });
                }
            }
        }
        for setting in &block.settings {
            let (value, _) = self.value(block, setting.value, setting.span)?;
            let target = match setting.target {
                Target::Numbered(code) => {
                    let (number, _) = self.value(block, Value::Expression(code), setting.span)?;
                    let number = parameter_number(number, self.max_parameters());
                    AssignedParameter::Numbered(number.map_err(|fault| (fault, setting.span))?)
                }
                Target::Named(name) => AssignedParameter::Named(name_of(block, name)),
            };
            self.words.settings.push((target, value));
        }
        Ok(())
    }

    pub(super) fn value(
        &mut self,
        block: &Block<'_>,
        value: Value,
        span: Span,
    ) -> Result<(f64, u8), ValueFault> {
        let code = match value {
            Value::Number(number) => return Ok((number.value, number.decimals)),
            Value::Expression(code) => code,
        };
        let has_names = self.rules.spelling.grammar.as_ref().is_some_and(|grammar| grammar.has_names);
        let scope = Scope { most: self.max_parameters(), has_names, state: &self.state };
        let value = self.parameters.evaluate(block, code, &scope).map_err(|fault| (fault, span))?;
        for parameter in std::mem::take(&mut self.parameters.machine_values) {
            self.report(block, &say::MACHINE_VALUE, span, |d| {
                d.quoting("parameter", parameter).with("value", value)
            });
        }
        Ok((value, EXPRESSION_DECIMALS))
    }

    fn max_parameters(&self) -> u32 {
        self.rules.spelling.grammar.as_ref().map_or(0, |grammar| grammar.parameters)
    }

    /// Returns the word to which the values of a block belong. A line without a command is read as a move.
    pub(super) fn owner_of_values(&self, block: &Block<'_>) -> ValueOwner {
        if !self.rules.one_command {
            return ValueOwner::Move;
        }
        let command = self.words.commands.first().map(|(command, ..)| *command);
        match block.words.first().map(|word| word.letter) {
            Some(b'M') if self.words.m_codes.first().is_some_and(|(code, _)| is_executed_m(*code)) => {
                ValueOwner::Command
            }
            Some(b'M') => ValueOwner::NotFollowed,
            Some(b'G') => match command {
                None => ValueOwner::NotFollowed,
                Some(Command::NotFollowed(group)) if group != Group::Motion => ValueOwner::NotFollowed,
                Some(command) if command.may_move() => ValueOwner::Move,
                Some(_) => ValueOwner::Command,
            },
            Some(b'T') => ValueOwner::Command,
            _ => ValueOwner::Move,
        }
    }

    /// Checks that the first word is a command, because the control obeys only the first word and takes the others as its values.
    fn check_command(&mut self, block: &Block<'_>) {
        let is_command = |word: &Word| matches!(word.letter, b'G' | b'M' | b'T');
        if let Some(first) = block.words.first().filter(|word| !is_command(word)) {
            let name = block.text_of(first.span).into_owned();
            self.report(block, &say::NO_COMMAND, first.span, |d| d.quoting("word", name));
        }
        // T is a value of an M word, as in `M204 T500`.
        let has_m = block.words.first().is_some_and(|word| word.letter == b'M');
        let is_value = |word: &Word| has_m && word.letter == b'T';
        let mut commands = block.words.iter().filter(|word| is_command(word) && !is_value(word));
        if let (Some(first), Some(second)) = (commands.next(), commands.next()) {
            let [first, name] = [first, second].map(|word| block.text_of(word.span).into_owned());
            self.report(block, &say::SECOND_COMMAND, second.span, |d| {
                d.quoting("first", first).quoting("word", name)
            });
        }
    }

    /// Checks that there is only one G word and one M word, because the control obeys only one of each per line.
    fn check_one_word_each(&mut self, block: &Block<'_>) {
        for letter in [b'G', b'M'] {
            let mut words = block.words.iter().filter(|word| word.letter == letter);
            if let (Some(first), Some(second)) = (words.next(), words.next()) {
                let [first, name] = [first, second].map(|word| block.text_of(word.span).into_owned());
                let letter = char::from(letter);
                self.report(block, &say::SECOND_WORD, second.span, |d| {
                    d.with("letter", letter).quoting("first", first).quoting("word", name)
                });
            }
        }
    }

    /// Reports lengths without a decimal point: `X10` is 10 mm on one machine and 0.010 mm on another of the same manufacturer.
    fn check_point(&mut self, block: &Block<'_>, letter: u8, slot: Slot) {
        let is_length = matches!(letter, b'X' | b'Y' | b'Z' | b'I' | b'J' | b'R' | b'Q')
            || letter == b'K' && self.rules.repeats != b'K';
        let has_point = block.slice(slot.span).contains(&b'.');
        let is_of =
            |code: u16| self.rules.words.inert('G', code).is_some_and(|word| word.values.contains(&letter));
        if self.words.commands.iter().any(|(_, code, _)| is_of(*code)) {
            return;
        }
        if is_length && !has_point && slot.value != 0.0 {
            let name = block.text_of(slot.span).into_owned();
            self.report(block, &say::NO_DECIMAL_POINT, slot.span, |d| d.quoting("word", name));
        }
    }

    fn letter(&mut self, block: &Block<'_>, letter: u8, slot: Slot) {
        if self.rules.least_increments {
            self.check_point(block, letter, slot);
        }
        // The number of a layer is a T without the letter.
        let has_letter = block.slice(slot.span).first().is_some_and(u8::is_ascii_alphabetic);
        if has_letter && !self.rules.words.letters.contains(letter) && !self.words.has_unknown_cycle() {
            return self.report_unknown(
                block,
                &say::LETTER_NOT_KNOWN,
                slot.span,
                char::from(letter).to_string(),
            );
        }
        if matches!(letter, b'A' | b'B' | b'C' | b'U' | b'V' | b'W' | b'@' | b'^' | b'$') {
            let word = char::from(letter);
            return self.report(block, &say::AXIS_NOT_FOLLOWED, slot.span, |d| d.with("word", word));
        }
        if letter == b'F' && slot.value < 0.0 {
            return self.report_out_of_range(block, "F", slot, &limits::NOT_NEGATIVE);
        }
        let is_number = slot.decimals != EXPRESSION_DECIMALS;
        if is_number && matches!(letter, b'X' | b'Y' | b'Z' | b'I' | b'J' | b'K' | b'R') {
            self.half_circles.add_length(slot.decimals);
        }
        if !self.words.values.set(letter, slot) {
            self.report(block, &say::LETTER_TWICE, slot.span, |d| d.with("letter", char::from(letter)));
        }
    }

    pub(super) fn report_out_of_range(
        &mut self,
        block: &Block<'_>,
        word: &'static str,
        slot: Slot,
        limits: &'static pathbuild_diagnostic::Text,
    ) {
        self.report(block, &say::OUT_OF_RANGE, slot.span, |d| {
            d.quoting("word", word).with("value", slot.value).with("limits", limits)
        });
    }

    fn g_word(&mut self, block: &Block<'_>, word: &Word, value: f64) {
        let Some(code) = self.code(block, word, value) else { return };
        let words = self.rules.words;
        if words.has_g(code) {
            let command = match self.unit_word(code) {
                Some(unit) => unit,
                None if self.rules.reference.g.contains(&code) => Command::Reference,
                None if words.inert('G', code).is_some() => Command::NoEffect(Group::LookAhead),
                None if words.g_own.contains(&code) => Command::NotFollowed(Group::NonModal),
                None => Command::of(code),
            };
            self.words.commands.push((command, code, word.span));
            if self.rules.unusual.g.contains(&code) {
                self.report(block, &say::OFF_IN_BUILDS, word.span, |d| {
                    d.quoting("word", codes::name('G', code))
                });
            }
        } else if words.lenient && codes::is_cycle(code) {
            let name = codes::name('G', code);
            self.words.commands.push((Command::Motion(Motion::Unfollowed), code, word.span));
            self.report(block, &say::UNKNOWN_CYCLE, word.span, |d| d.quoting("word", name));
        } else {
            if codes::is_cycle(code) {
                self.words.commands.push((Command::Motion(Motion::Unfollowed), code, word.span));
            }
            self.report_unknown(block, &say::CODE_NOT_KNOWN, word.span, codes::name('G', code));
        }
    }

    /// Returns the number of a G or M word, times ten. Reports a number that cannot be a code.
    fn code(&mut self, block: &Block<'_>, word: &Word, value: f64) -> Option<u16> {
        let code = code_of(value);
        if code.is_none() {
            let name = block.text_of(word.span).into_owned();
            self.report_unknown(block, &say::CODE_NOT_KNOWN, word.span, name);
        }
        code
    }

    fn unit_word(&self, code: u16) -> Option<Command> {
        let [inch, mm] = self.options.unit_words(self.rules);
        let [other_inch, other_mm] = self.rules.unit_synonyms.unwrap_or([inch, mm]);
        let is_inch = code == inch || code == other_inch;
        (is_inch || code == mm || code == other_mm).then_some(Command::Inches(is_inch))
    }

    fn m_word(&mut self, block: &Block<'_>, word: &Word, value: f64) {
        let Some(code) = self.code(block, word, value) else { return };
        let (words, name) = (self.rules.words, || codes::name('M', code));
        if words.has_m(code) {
            self.words.m_codes.push((code, word.span));
        } else if words.m_ignored.contains(&code) {
            self.report(block, &say::IGNORED, word.span, |d| d.quoting("word", name()));
        } else {
            self.report_unknown(block, &say::CODE_NOT_KNOWN, word.span, name());
        }
    }

    /// Adds a step for each G or M word of the block, except for G0 to G3.
    pub(super) fn emit_word_steps(&mut self, block: &Block<'_>) {
        let moves_beside = self.words.values.has_coordinates();
        for index in 0..self.words.commands.len() {
            let (command, code, _) = self.words.commands[index];
            let is_move = matches!(code, 0..=30) && matches!(command, Command::Motion(_));
            let is_lone = command == Command::MachineCoordinates && !moves_beside;
            let effect = if is_lone { WordEffect::NotFollowed } else { command.effect() };
            if !is_move {
                let word = StatedWord { letter: 'G', code, group: Some(command.group()), effect };
                self.step(block, Action::Word(word));
            }
        }
        for index in 0..self.words.m_codes.len() {
            let (code, _) = self.words.m_codes[index];
            let effect = match code {
                _ if self.is_subprogram_code(code) => WordEffect::Call,
                _ if is_executed_m(code) && self.rules.words.inert('M', code).is_none() => {
                    WordEffect::Followed
                }
                _ => WordEffect::NotFollowed,
            };
            self.step(block, Action::Word(StatedWord { letter: 'M', code, group: None, effect }));
        }
    }

    pub(super) fn set_parameters(&mut self, block: &Block<'_>) {
        for (target, value) in std::mem::take(&mut self.words.settings) {
            match target {
                AssignedParameter::Numbered(number) => {
                    if MACHINE_POSITION_PARAMETERS.contains(&number) {
                        self.report(block, &say::NOT_FOLLOWED, block.span(), |d| {
                            d.quoting("word", format!("#{number}="))
                        });
                    }
                    self.parameters.set(number, value);
                }
                AssignedParameter::Named(name) => self.parameters.set_named(name, value),
            }
        }
    }
}

/// Parameters in which RS274 controls store the positions of G28, G30, G92 and the coordinate systems.
const MACHINE_POSITION_PARAMETERS: std::ops::RangeInclusive<u32> = 5161..=5390;

/// Converts a G or M number to ten times its value; `None` if it has more than one decimal. Controls disagree whether `G0.9999` is G0 or G1.
fn code_of(value: f64) -> Option<u16> {
    let tenths = value * 10.0;
    let nearest = libm::round(tenths);
    let fits = libm::fabs(tenths - nearest) < 1e-6 && (0.0..f64::from(u16::MAX)).contains(&nearest);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, and within a u16")]
    fits.then_some(nearest as u16)
}

/// Groups of M codes; a line may contain only one code of each group.
const M_GROUPS: [&[u16]; 4] = [STOPS, TOOL, SPINDLE, COOLANT];

impl Interpreter<'_> {
    pub(super) fn check_conflicts(&mut self, block: &Block<'_>) {
        let ends_cycles = |command: &Command| *command == Command::Motion(Motion::None);
        let is_motion = |command: &Command| matches!(command, Command::Motion(_)) && !ends_cycles(command);
        let has_motion = || self.words.commands.iter().any(|(command, ..)| is_motion(command));
        if self.rules.ends_cycles_beside_motion && has_motion() {
            self.words.commands.retain(|(command, ..)| !ends_cycles(command));
        }
        for (index, &(command, code, span)) in self.words.commands.iter().enumerate().skip(1) {
            let earlier =
                self.words.commands[..index].iter().find(|(other, ..)| other.group() == command.group());
            if let Some(&(_, first, _)) = earlier {
                self.report_conflict(block, &say::SAME_GROUP, 'G', [first, code], span);
                break;
            }
        }
        for (index, &(code, span)) in self.words.m_codes.iter().enumerate().skip(1) {
            let excludes =
                |other: u16| M_GROUPS.iter().any(|group| group.contains(&other) && group.contains(&code));
            if let Some(&(first, _)) = self.words.m_codes[..index].iter().find(|(other, _)| excludes(*other))
            {
                self.report_conflict(block, &say::SAME_GROUP, 'M', [first, code], span);
                break;
            }
        }
        self.check_m_limit(block);
        let takers = || self.words.commands.iter().filter(|(command, ..)| command.takes_coordinates());
        let uses_axes = |first: Command, second: Command| {
            let groups = [first.group(), second.group()];
            self.words.values.has_coordinates()
                || self.rules.refuses_idle_words
                    && [Group::Motion, Group::NonModal].iter().all(|group| groups.contains(group))
        };
        if let (Some(&(first_command, first, _)), Some(&(second_command, second, span))) =
            (takers().next(), takers().nth(1))
            && first_command.group() != second_command.group()
            && uses_axes(first_command, second_command)
        {
            self.report_conflict(block, &say::AXES_WANTED_TWICE, 'G', [first, second], span);
        }
    }

    /// Reports a second M code that the control refuses or, on some machines, loses. Codes that exclude each other are reported already.
    fn check_m_limit(&mut self, block: &Block<'_>) {
        let [(first, _), (second, span), ..] = *self.words.m_codes else { return };
        let message = match self.rules.m_limit {
            MCodeLimit::Unlimited => return,
            MCodeLimit::OneOnSome => &say::SECOND_M_LOST,
            MCodeLimit::One => &say::SECOND_M_REFUSED,
        };
        if M_GROUPS.iter().any(|group| group.contains(&first) && group.contains(&second)) {
            return;
        }
        self.report_conflict(block, message, 'M', [first, second], span);
    }

    fn report_conflict(
        &mut self,
        block: &Block<'_>,
        message: &'static Message,
        letter: char,
        words: [u16; 2],
        span: Span,
    ) {
        let [first, second] = words.map(|code| codes::name(letter, code));
        self.report(block, message, span, |d| d.quoting("first", first).quoting("second", second));
    }

    /// Marks the values of inert words as used. Reports missing values, and values that are not known to be harmless.
    pub(super) fn take_inert(&mut self, block: &Block<'_>) {
        let words = self.rules.words;
        if words.inert.is_empty() {
            return;
        }
        let codes = self.words.commands.iter().map(|(_, code, span)| ('G', *code, *span));
        let codes = codes.chain(self.words.m_codes.iter().map(|(code, span)| ('M', *code, *span)));
        let found: Vec<_> =
            codes.filter_map(|(letter, code, span)| Some((words.inert(letter, code)?, span))).collect();
        for (word, span) in found {
            let first = word.values.first().and_then(|letter| self.words.values.peek(*letter));
            if !word.needs.is_empty() && word.needs.iter().all(|letter| !self.words.values.has(*letter)) {
                let name = codes::name(word.letter, word.code);
                let needed = word.needs.iter().map(|letter| char::from(*letter).to_string());
                let needed = needed.collect::<Vec<_>>().join(", ");
                self.report(block, &say::NEEDS, span, |d| d.quoting("word", name).quoting("missing", needed));
            }
            let is_harmless =
                word.harmless.is_empty() || first.is_some_and(|slot| word.harmless.contains(&slot.value));
            for letter in word.values {
                if Values::AXES.contains(letter) {
                    self.words.values.remove(*letter);
                } else {
                    self.words.values.take(*letter);
                }
            }
            if !is_harmless {
                let name = codes::name(word.letter, word.code);
                self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", name));
            }
        }
    }

    pub(super) fn report_unused(&mut self, block: &Block<'_>) {
        if self.words.values.are_all_used() {
            return;
        }
        let severity = if self.rules.words.lenient { Severity::Warning } else { Severity::Error };
        let unused: Vec<(u8, Span)> = self.words.values.unused().collect();
        for (letter, span) in unused {
            self.report(block, &say::UNUSED, span, |mut diagnostic| {
                diagnostic.severity = severity;
                diagnostic.with("word", char::from(letter))
            });
        }
    }
}
