//! The words of a block, sorted by kind.

use pathbuild_motion::Group;

use super::codes::Command;
use super::evaluate::Fault;
use crate::read::Span;

/// The words of a block: commands in their order in the text, values by letter.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    pub(super) commands: Vec<(Command, u16, Span)>,
    pub(super) m_codes: Vec<(u16, Span)>,
    pub(super) values: Values,
    pub(super) settings: Vec<(Setting, f64)>,
}

/// A parameter set by the block. It takes effect after everything in the block has been read.
#[derive(Debug)]
pub(super) enum Setting {
    Numbered(u32),
    Named(Box<str>),
}

impl Gathered {
    pub(super) fn clear(&mut self) {
        self.commands.clear();
        self.m_codes.clear();
        self.values.clear();
        self.settings.clear();
    }

    /// The command of the block that belongs to a group.
    pub(super) fn of_group(&self, group: Group) -> Option<(Command, u16, Span)> {
        self.commands.iter().find(|(command, ..)| command.group() == group).copied()
    }

    /// The M code of the block that is one of these.
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

/// The value of a letter.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Slot {
    pub(super) value: f64,
    /// Number of digits after the decimal point; for expressions as many as a double has.
    pub(super) decimals: u8,
    pub(super) span: Span,
    /// The part of the value that is correction by the formula of the word.
    pub(super) correction: f64,
}

/// The bit of a letter.
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

    /// Whether X, Y or Z is set.
    pub(super) fn has_coordinates(&self) -> bool {
        self.given & Self::COORDINATES != 0
    }

    /// Returns the value and marks it as used.
    pub(super) fn take(&mut self, letter: u8) -> Option<f64> {
        self.take_slot(letter).map(|slot| slot.value)
    }

    /// Like [`take`](Self::take), but returns everything known about the value.
    pub(super) fn take_slot(&mut self, letter: u8) -> Option<Slot> {
        self.used |= bit(letter) & self.given;
        self.peek(letter)
    }

    /// Returns the value without marking it as used.
    pub(super) fn peek(&self, letter: u8) -> Option<Slot> {
        self.has(letter).then(|| self.slots[usize::from(letter - b'A')])
    }

    /// Removes X, Y and Z from the block.
    pub(super) fn discard_coordinates(&mut self) {
        self.given &= !Self::COORDINATES;
    }

    /// Removes a letter from the block.
    pub(super) fn remove(&mut self, letter: u8) -> Option<Slot> {
        let slot = self.peek(letter);
        self.given &= !bit(letter);
        slot
    }

    /// Returns X, Y and Z and marks them as used.
    pub(super) fn take_coordinates(&mut self) -> [Option<Slot>; 3] {
        Self::AXES.map(|axis| self.take_slot(axis))
    }

    pub(super) fn are_all_used(&self) -> bool {
        self.given & !self.used == 0
    }

    /// Letters that have not been used.
    pub(super) fn unused(&self) -> impl Iterator<Item = (u8, Span)> + '_ {
        let remaining = self.given & !self.used;
        (b'A'..=b'Z')
            .filter(move |letter| remaining & bit(*letter) != 0)
            .map(|letter| (letter, self.slots[usize::from(letter - b'A')].span))
    }
}

/// An error in a value, with its position in the line.
pub(super) type ValueFault = (Fault, Span);

/// How a control names a subprogram.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Name {
    /// `o100 sub`, `o<name> sub`.
    Subroutine(Box<str>),
    /// `O100`.
    Program(u32),
    /// `N100`.
    Line(u32),
}

/// Which line is executed after a block, unless it is the next one.
#[derive(Debug)]
pub(super) enum Jump {
    /// Runs a subprogram several times, with values for its parameters.
    Call(Name, u32, Vec<f64>),
    /// Runs the lines up to the end of the loop several times.
    Repeat(Box<str>, u32),
    /// Passes over the definition of a subroutine.
    Pass(Box<str>),
    /// Ends the subprogram.
    Return,
    /// Ends a pass through the loop.
    EndRepeat,
}

impl Name {
    pub(super) fn shown(&self) -> String {
        match self {
            Self::Subroutine(name) if name.bytes().all(|byte| byte.is_ascii_digit()) => format!("o{name}"),
            Self::Subroutine(name) => format!("o<{name}>"),
            Self::Program(number) => format!("O{number}"),
            Self::Line(number) => format!("N{number}"),
        }
    }
}
