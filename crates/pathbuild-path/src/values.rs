//! The values in a parameter text, with variables put in. (spec/30-parameters.md)

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use crate::letter::Letter;
use crate::number::{parse_integer, parse_number};
use crate::text::ParameterText;
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
pub(crate) struct Values {
    numbers: Vec<(Letter, Given)>,
    texts: Vec<(Letter, Option<Box<str>>)>,
    faults: Vec<(Letter, TextFault)>,
    /// Values of variables in the order written, with the piece they stand in.
    pub(crate) variables: Vec<(Box<str>, TextFault)>,
    /// PB205, PB303, PB305 and PB005, without places.
    pub(crate) problems: Vec<Diagnostic>,
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

impl Values {
    /// The values of a text; what is not known to the element is not looked at.
    pub(crate) fn of(text: &ParameterText, interpolation: &Interpolation<'_>) -> Self {
        let mut values = Self::default();
        for piece in text.pieces() {
            let Some(letter) = piece.letter else { continue };
            let fault = text.fault(piece);
            match interpolation.fill(text.value(piece)) {
                Ok(value) => values.add(letter, &value, &fault),
                Err(problem) => values.add_faulty(letter, problem.with_text(fault.clone())),
            }
            values.faults.push((letter, fault));
        }
        values
    }

    /// A letter's number.
    pub(crate) fn number(&self, letter: Letter) -> Given {
        self.numbers.iter().find(|(known, _)| *known == letter).map_or(Given::Absent, |(_, given)| *given)
    }

    /// A letter's text; `None` where it says nothing or something that was reported.
    pub(crate) fn text(&self, letter: Letter) -> Option<&str> {
        self.texts.iter().find(|(known, _)| *known == letter).and_then(|(_, text)| text.as_deref())
    }

    /// Whether the text has the letter at all.
    pub(crate) fn has(&self, letter: Letter) -> bool {
        self.faults.iter().any(|(known, _)| *known == letter)
    }

    /// The text with the letter's piece underlined.
    pub(crate) fn fault(&self, letter: Letter) -> Option<TextFault> {
        self.faults.iter().find(|(known, _)| *known == letter).map(|(_, fault)| fault.clone())
    }

    /// A diagnostic about a letter, with its piece underlined where there is one.
    pub(crate) fn underline(&self, letter: Letter, diagnostic: Diagnostic) -> Diagnostic {
        match self.fault(letter) {
            Some(fault) => diagnostic.with_text(fault),
            None => diagnostic,
        }
    }

    fn add(&mut self, letter: Letter, value: &str, fault: &TextFault) {
        if letter == Letter::Variable {
            return self.variables.push((value.into(), fault.clone()));
        }
        if letter.is_text() {
            return self.texts.push((letter, Some(value.into())));
        }
        let is_integer = letter == Letter::N;
        let number = if is_integer { parse_integer(value).map(|n| n as f64) } else { parse_number(value) };
        if let Some(number) = number {
            return self.numbers.push((letter, Given::Number(number)));
        }
        let message = if is_integer { &messages::NOT_AN_INTEGER } else { &messages::NOT_A_NUMBER };
        let problem = Diagnostic::new(message).with("letter", letter.as_char()).with("value", value);
        self.add_faulty(letter, problem.with_text(fault.clone()));
    }

    fn add_faulty(&mut self, letter: Letter, problem: Diagnostic) {
        self.problems.push(problem);
        if letter.is_text() {
            self.texts.push((letter, None));
        } else {
            self.numbers.push((letter, Given::Faulty));
        }
    }
}
