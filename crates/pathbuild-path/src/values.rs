//! The values in a parameter text, with variables put in. (spec/30-parameters.md)

use std::borrow::Cow;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use crate::letter::{Letter, Letters};
use crate::number::{parse_integer, parse_number};
use crate::text::{ParameterText, Piece};
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
    text: Option<&'t ParameterText>,
    /// All that it has.
    letters: Letters,
    /// Those of them that are numbers.
    given: Letters,
    /// Those whose number was reported.
    faulty: Letters,
    numbers: [f64; Letter::COUNT],
    /// Of text letters; `None` for what was reported.
    texts: Vec<(Letter, Option<Cow<'t, str>>)>,
    /// Values of variables in the order written, with the piece they stand in.
    pub(crate) variables: Vec<(Cow<'t, str>, Piece)>,
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

impl<'t> Values<'t> {
    /// The values of a text; what is not known to the element is not looked at.
    pub(crate) fn of(text: &'t ParameterText, interpolation: &Interpolation<'_>) -> Self {
        Self::of_pieces(text, text.pieces(), interpolation)
    }

    /// The values of a path's own parameters. A definition is no value: its "=" would be taken for a reference.
    pub(crate) fn of_path(text: &'t ParameterText, interpolation: &Interpolation<'_>) -> Self {
        let pieces = text.pieces().filter(|piece| piece.letter != Some(Letter::Variable));
        Self::of_pieces(text, pieces, interpolation)
    }

    fn of_pieces(
        text: &'t ParameterText,
        pieces: impl Iterator<Item = Piece>,
        interpolation: &Interpolation<'_>,
    ) -> Self {
        let mut values = Self { text: Some(text), ..Self::default() };
        for piece in pieces {
            let Some(letter) = piece.letter else { continue };
            // Of several of a letter, which are reported, the first counts.
            let is_first = values.letters.insert(letter);
            match interpolation.fill(text.value(&piece)) {
                Ok(value) => values.add(letter, value, piece, is_first),
                Err(problem) => values.add_faulty(letter, problem.with_text(text.fault(&piece)), is_first),
            }
        }
        values
    }

    /// A letter's number.
    pub(crate) fn number(&self, letter: Letter) -> Given {
        if self.given.contains(letter) {
            Given::Number(self.numbers[letter as usize])
        } else if self.faulty.contains(letter) {
            Given::Faulty
        } else {
            Given::Absent
        }
    }

    /// A letter's text; `None` where it says nothing or something that was reported.
    pub(crate) fn text(&self, letter: Letter) -> Option<&str> {
        self.texts.iter().find(|(known, _)| *known == letter).and_then(|(_, text)| text.as_deref())
    }

    /// Whether the text has the letter at all.
    pub(crate) fn has(&self, letter: Letter) -> bool {
        self.letters.contains(letter)
    }

    /// The text with the letter's piece underlined.
    pub(crate) fn fault(&self, letter: Letter) -> Option<TextFault> {
        if !self.has(letter) {
            return None;
        }
        let text = self.text?;
        text.piece(letter).map(|piece| text.fault(&piece))
    }

    /// The text with a piece underlined.
    pub(crate) fn underlined(&self, piece: &Piece) -> Option<TextFault> {
        self.text.map(|text| text.fault(piece))
    }

    /// A diagnostic about a letter, with its piece underlined where there is one.
    pub(crate) fn underline(&self, letter: Letter, diagnostic: Diagnostic) -> Diagnostic {
        match self.fault(letter) {
            Some(fault) => diagnostic.with_text(fault),
            None => diagnostic,
        }
    }

    fn add(&mut self, letter: Letter, value: Cow<'t, str>, piece: Piece, is_first: bool) {
        if letter == Letter::Variable {
            return self.variables.push((value, piece));
        }
        if letter.is_text() {
            return self.texts.push((letter, Some(value)));
        }
        let is_integer = letter == Letter::N;
        let number = if is_integer { parse_integer(&value).map(|n| n as f64) } else { parse_number(&value) };
        match number {
            Some(number) if is_first => {
                self.given.insert(letter);
                self.numbers[letter as usize] = number;
            }
            Some(_) => {}
            None => {
                let message = if is_integer { &messages::NOT_AN_INTEGER } else { &messages::NOT_A_NUMBER };
                let problem =
                    Diagnostic::new(message).with("letter", letter.as_char()).with("value", &*value);
                let underlined = self.underlined(&piece);
                self.add_faulty(letter, Diagnostic { text: underlined, ..problem }, is_first);
            }
        }
    }

    fn add_faulty(&mut self, letter: Letter, problem: Diagnostic, is_first: bool) {
        self.problems.push(problem);
        if letter.is_text() {
            self.texts.push((letter, None));
        } else if is_first {
            self.faulty.insert(letter);
        }
    }
}
