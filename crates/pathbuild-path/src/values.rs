//! The values in a parameter text, with variables put in. (book: language/letters)

use std::borrow::Cow;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use crate::letter::{Letter, Letters};
use crate::matrix::{ElementClass, Use};
use crate::mistakes;
use crate::text::{LetterValue, ParameterText, Written};
use crate::variables::Interpolation;

/// What a text says of a letter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Given {
    /// Nothing.
    #[default]
    Absent,
    /// Something that was reported already: nothing that follows from it is.
    Faulty,
    /// A number.
    Number(f64),
}

/// A text's values.
#[derive(Clone, Debug, Default)]
pub(crate) struct Values<'t> {
    text: ParameterText<'t>,
    /// What its pieces say with variables put in; nothing where they say that as they are written.
    filled: Vec<Filled<'t>>,
    /// Letters that the text lacks, but that something in it that is at fault may stand for.
    pub(crate) unread: Letters,
    /// PB205, PB303, PB305 and PB005, without places.
    pub(crate) problems: Vec<Diagnostic>,
}

/// What a piece says with variables put in.
#[derive(Clone, Debug)]
enum Filled<'t> {
    Value(Written, Cow<'t, str>),
    /// Something that was reported, or that is not looked at.
    Nothing,
}

impl Given {
    /// The number.
    pub(crate) fn number(self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(number),
            Self::Absent | Self::Faulty => None,
        }
    }

    /// This, or another where this says nothing.
    pub(crate) fn or(self, other: Self) -> Self {
        if self == Self::Absent { other } else { self }
    }
}

impl<'t> Values<'t> {
    /// The values of the text of an element of this class. A piece that [`ParameterText::problems`] finds at fault has no value.
    pub(crate) fn of(
        text: ParameterText<'t>,
        class: ElementClass,
        interpolation: &Interpolation<'_>,
    ) -> Self {
        let mut values = Self { text, ..Self::default() };
        if text.is_plain {
            return values;
        }
        if let Some(misreading) = mistakes::in_text(text, class) {
            values.filled.resize_with(text.pieces().len(), || Filled::Nothing);
            values.unread = misreading.unread;
            return values;
        }
        values.unread = text.unread_letters();
        // A definition is no value: its "=" would be taken for a reference.
        let is_definition = |letter| class == ElementClass::PathStart && letter == Letter::Variable;
        let is_value = |letter: &Letter| {
            !matches!(class.use_of(*letter), Use::Unknown | Use::PathOnly)
                && !is_definition(*letter)
                && (*letter == Letter::Variable || !text.repeats(*letter))
        };
        let has_unread = values.unread != Letters::default();
        let is_apart = |piece: &LetterValue| has_unread && mistakes::is_without_value(text, piece);
        let mut filled = Vec::with_capacity(text.pieces().len());
        for piece in text.pieces() {
            filled.push(match piece.letter.filter(is_value) {
                Some(letter) if letter.is_literal() && text.value(piece).contains('=') => Filled::Nothing,
                // Its number stands apart from it, which is reported there.
                Some(_) if is_apart(piece) => Filled::Nothing,
                Some(letter) => values.fill(letter, piece, interpolation),
                None => Filled::Nothing,
            });
        }
        values.filled = filled;
        values
    }

    fn fill(&mut self, letter: Letter, piece: &LetterValue, interpolation: &Interpolation<'_>) -> Filled<'t> {
        match interpolation.fill(self.text.value(piece)) {
            Ok(value) => match Written::of(letter, &value) {
                Written::NoNumber => self.report(piece, no_number(letter, &value)),
                written => return Filled::Value(written, value),
            },
            Err(Some(problem)) => {
                let problem =
                    mistakes::equals_sign(letter, self.text.value(piece), &problem).unwrap_or(*problem);
                self.report(piece, problem);
            }
            Err(None) => {}
        }
        Filled::Nothing
    }

    fn report(&mut self, piece: &LetterValue, problem: Diagnostic) {
        self.problems.push(problem.with_text(self.text.fault(piece)));
    }

    /// A letter's number. Of several of a letter, which are reported, none counts.
    pub(crate) fn number(&self, letter: Letter) -> Given {
        let Some(index) = self.text.index(letter) else {
            return if self.unread.contains(letter) { Given::Faulty } else { Given::Absent };
        };
        let written = match self.filled.get(index) {
            None => self.text.pieces()[index].written,
            Some(Filled::Value(written, _)) => *written,
            Some(Filled::Nothing) => return Given::Faulty,
        };
        match written {
            Written::Number(number) => Given::Number(number),
            Written::NoNumber => Given::Faulty,
            Written::Text | Written::Reference => Given::Absent,
        }
    }

    /// A letter's text; `None` where it says nothing or something that was reported.
    pub(crate) fn text(&self, letter: Letter) -> Option<&str> {
        self.value(self.text.index(letter)?)
    }

    /// Whether the text may give the letter, but it is not known with which value.
    pub(crate) fn is_unknown(&self, letter: Letter) -> bool {
        match self.text.index(letter) {
            Some(index) => self.value(index).is_none(),
            None => self.unread.contains(letter),
        }
    }

    /// Values of variables in the order written, with the piece they stand in.
    pub(crate) fn variables(&self) -> impl Iterator<Item = (&str, &'t LetterValue)> {
        let pieces = self.text.pieces().iter().enumerate();
        let variables = pieces.filter(|(_, piece)| piece.letter == Some(Letter::Variable));
        variables.filter_map(|(index, piece)| Some((self.value(index)?, piece)))
    }

    fn value(&self, index: usize) -> Option<&str> {
        match self.filled.get(index) {
            None => Some(self.text.value(&self.text.pieces()[index])),
            Some(Filled::Value(_, value)) => Some(value),
            Some(Filled::Nothing) => None,
        }
    }

    /// Whether the text has the letter at all.
    pub(crate) fn has(&self, letter: Letter) -> bool {
        self.text.letters.contains(letter)
    }

    /// Whether the text has the letter, or something in it that is at fault may stand for it.
    pub(crate) fn may_give(&self, letter: Letter) -> bool {
        self.has(letter) || self.unread.contains(letter)
    }

    /// All letters that the text has.
    pub(crate) fn letters(&self) -> Letters {
        self.text.letters
    }

    /// The text with the letter's piece underlined.
    pub(crate) fn fault(&self, letter: Letter) -> Option<TextFault> {
        self.text.fault_of(letter)
    }

    /// The text with a piece underlined.
    pub(crate) fn underlined(&self, piece: &LetterValue) -> TextFault {
        self.text.fault(piece)
    }

    /// A diagnostic about a letter, with its piece underlined where there is one.
    pub(crate) fn underline(&self, letter: Letter, diagnostic: Diagnostic) -> Diagnostic {
        match self.fault(letter) {
            Some(fault) => diagnostic.with_text(fault),
            None => diagnostic,
        }
    }
}

fn no_number(letter: Letter, value: &str) -> Diagnostic {
    if let Some(problem) = mistakes::unit(letter, value) {
        return problem;
    }
    let is_integer = letter == Letter::N;
    let message = match is_integer {
        _ if value.contains('\u{a0}') => &messages::NON_BREAKING_SPACE,
        true => &messages::NOT_AN_INTEGER,
        false => &messages::NOT_A_NUMBER,
    };
    let visible = value.replace('\u{a0}', "\u{2423}");
    Diagnostic::new(message).with("letter", letter.as_char()).with("value", visible)
}
