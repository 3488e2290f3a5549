//! The values in a parameter text, with variables substituted. (book: language/letters)

use std::borrow::Cow;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use crate::letter::{Letter, Letters};
use crate::matrix::{ElementClass, Use};
use crate::mistakes;
use crate::text::{LetterValue, ParameterText, ValueKind};
use crate::variables::Interpolation;

/// The value that a text gives a letter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum GivenNumber {
    /// None.
    #[default]
    Absent,
    /// A value with a reported problem; consequences are not reported.
    Faulty,
    /// A valid number.
    Number(f64),
}

/// The values of a text.
#[derive(Clone, Debug, Default)]
pub(crate) struct Values<'t> {
    text: ParameterText<'t>,
    /// The values of its pieces with variables substituted; empty if all values are literal.
    filled: Vec<FilledValue<'t>>,
    /// Letters missing from the text that a faulty piece of it may stand for.
    pub(crate) unread: Letters,
    /// PB205, PB303, PB305 and PB005, without places.
    pub(crate) problems: Vec<Diagnostic>,
}

/// The value of a piece with variables substituted.
#[derive(Clone, Debug)]
enum FilledValue<'t> {
    Value(ValueKind, Cow<'t, str>),
    /// No value, because of a reported problem or because the piece is ignored.
    Nothing,
}

impl GivenNumber {
    /// The number, if it is valid.
    pub(crate) fn number(self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(number),
            Self::Absent | Self::Faulty => None,
        }
    }

    /// This value, or another one if this is absent.
    pub(crate) fn or(self, other: Self) -> Self {
        if self == Self::Absent { other } else { self }
    }
}

impl<'t> Values<'t> {
    /// The values of the text of an element of this class. Pieces with problems found by [`ParameterText::problems`] have no value.
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
            values.filled.resize_with(text.pieces().len(), || FilledValue::Nothing);
            values.unread = misreading.unread;
            return values;
        }
        values.unread = text.unread_letters();
        // A definition is not a value: its "=" is not a reference.
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
                Some(letter) if letter.is_literal() && text.value(piece).contains('=') => {
                    FilledValue::Nothing
                }
                // The number is separated from its letter, which is reported there.
                Some(_) if is_apart(piece) => FilledValue::Nothing,
                Some(letter) => values.fill(letter, piece, interpolation),
                None => FilledValue::Nothing,
            });
        }
        values.filled = filled;
        values
    }

    fn fill(
        &mut self,
        letter: Letter,
        piece: &LetterValue,
        interpolation: &Interpolation<'_>,
    ) -> FilledValue<'t> {
        match interpolation.fill(self.text.value(piece)) {
            Ok(value) => match ValueKind::of(letter, &value) {
                ValueKind::NoNumber => self.report(piece, no_number(letter, &value)),
                written => return FilledValue::Value(written, value),
            },
            Err(Some(problem)) => {
                let problem =
                    mistakes::equals_sign(letter, self.text.value(piece), &problem).unwrap_or(*problem);
                self.report(piece, problem);
            }
            Err(None) => {}
        }
        FilledValue::Nothing
    }

    fn report(&mut self, piece: &LetterValue, problem: Diagnostic) {
        self.problems.push(problem.with_text(self.text.fault(piece)));
    }

    /// The number of a letter. If the letter is repeated, which is reported, there is none.
    pub(crate) fn number(&self, letter: Letter) -> GivenNumber {
        let Some(index) = self.text.index(letter) else {
            return if self.unread.contains(letter) { GivenNumber::Faulty } else { GivenNumber::Absent };
        };
        let written = match self.filled.get(index) {
            None => self.text.pieces()[index].written,
            Some(FilledValue::Value(written, _)) => *written,
            Some(FilledValue::Nothing) => return GivenNumber::Faulty,
        };
        match written {
            ValueKind::Number(number) => GivenNumber::Number(number),
            ValueKind::NoNumber => GivenNumber::Faulty,
            ValueKind::Text | ValueKind::Reference => GivenNumber::Absent,
        }
    }

    /// The text value of a letter; `None` if it is absent or has a reported problem.
    pub(crate) fn text(&self, letter: Letter) -> Option<&str> {
        self.value(self.text.index(letter)?)
    }

    /// Whether the text may give the letter, but with an unknown value.
    pub(crate) fn is_unknown(&self, letter: Letter) -> bool {
        match self.text.index(letter) {
            Some(index) => self.value(index).is_none(),
            None => self.unread.contains(letter),
        }
    }

    /// The values of variables in the order written, each with its piece.
    pub(crate) fn variables(&self) -> impl Iterator<Item = (&str, &'t LetterValue)> {
        let pieces = self.text.pieces().iter().enumerate();
        let variables = pieces.filter(|(_, piece)| piece.letter == Some(Letter::Variable));
        variables.filter_map(|(index, piece)| Some((self.value(index)?, piece)))
    }

    fn value(&self, index: usize) -> Option<&str> {
        match self.filled.get(index) {
            None => Some(self.text.value(&self.text.pieces()[index])),
            Some(FilledValue::Value(_, value)) => Some(value),
            Some(FilledValue::Nothing) => None,
        }
    }

    /// Whether the text contains the letter.
    pub(crate) fn has(&self, letter: Letter) -> bool {
        self.text.letters.contains(letter)
    }

    /// Whether the text contains the letter, or a faulty piece that may stand for it.
    pub(crate) fn may_give(&self, letter: Letter) -> bool {
        self.has(letter) || self.unread.contains(letter)
    }

    /// All letters in the text.
    pub(crate) fn letters(&self) -> Letters {
        self.text.letters
    }

    /// The text with the piece of the letter underlined.
    pub(crate) fn fault(&self, letter: Letter) -> Option<TextFault> {
        self.text.fault_of(letter)
    }

    /// The text with a piece underlined.
    pub(crate) fn underlined(&self, piece: &LetterValue) -> TextFault {
        self.text.fault(piece)
    }

    /// Adds the text with the letter's piece underlined to a diagnostic, if the text contains the letter.
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
    Diagnostic::new(message).with("letter", letter.as_char()).quoting("value", visible)
}
