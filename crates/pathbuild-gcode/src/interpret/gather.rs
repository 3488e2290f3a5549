//! The words of one block, sorted by what they are.

use pathbuild_motion::Group;

use super::codes::Command;
use super::evaluate::Fault;
use crate::read::Span;

/// The words of a block: commands in the order of the text, values by letter.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    pub(super) commands: Vec<(Command, u16, Span)>,
    pub(super) m_codes: Vec<(u16, Span)>,
    pub(super) values: Values,
    pub(super) settings: Vec<(Setting, f64)>,
}

/// A parameter that the block sets, once everything in it has been read.
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

    /// The block's command of a group.
    pub(super) fn of_group(&self, group: Group) -> Option<(Command, u16, Span)> {
        self.commands.iter().find(|(command, ..)| command.group() == group).copied()
    }

    /// The block's M code among these.
    pub(super) fn m_code(&self, codes: &[u16]) -> Option<(u16, Span)> {
        self.m_codes.iter().find(|(code, _)| codes.contains(code)).copied()
    }
}

/// The values of a block's letters, and which of them something has used.
#[derive(Debug, Default)]
pub(super) struct Values {
    given: u32,
    used: u32,
    slots: [Slot; 26],
}

/// A letter's value.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Slot {
    pub(super) value: f64,
    /// Digits behind the point; of expressions as many as a double has.
    pub(super) decimals: u8,
    pub(super) span: Span,
    /// How much of the value is the correction of the word's formula.
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

    /// Sets a letter; false if it was there already.
    pub(super) fn set(&mut self, letter: u8, slot: Slot) -> bool {
        let is_new = self.given & bit(letter) == 0;
        self.given |= bit(letter);
        self.slots[usize::from(letter - b'A')] = slot;
        is_new
    }

    pub(super) fn has(&self, letter: u8) -> bool {
        self.given & bit(letter) != 0
    }

    /// Whether there is an X, Y or Z.
    pub(super) fn has_coordinates(&self) -> bool {
        self.given & Self::COORDINATES != 0
    }

    /// The value, which counts as used from now on.
    pub(super) fn take(&mut self, letter: u8) -> Option<f64> {
        self.take_slot(letter).map(|slot| slot.value)
    }

    /// The same with everything known of it.
    pub(super) fn take_slot(&mut self, letter: u8) -> Option<Slot> {
        self.used |= bit(letter) & self.given;
        self.peek(letter)
    }

    /// The value, without using it.
    pub(super) fn peek(&self, letter: u8) -> Option<Slot> {
        self.has(letter).then(|| self.slots[usize::from(letter - b'A')])
    }

    /// Takes X, Y and Z out of the block.
    pub(super) fn discard_coordinates(&mut self) {
        self.given &= !Self::COORDINATES;
    }

    /// Takes a letter out of the block.
    pub(super) fn remove(&mut self, letter: u8) -> Option<Slot> {
        let slot = self.peek(letter);
        self.given &= !bit(letter);
        slot
    }

    /// X, Y and Z, used from now on.
    pub(super) fn take_coordinates(&mut self) -> [Option<Slot>; 3] {
        Self::AXES.map(|axis| self.take_slot(axis))
    }

    pub(super) fn are_all_used(&self) -> bool {
        self.given & !self.used == 0
    }

    /// Letters that nothing has used.
    pub(super) fn unused(&self) -> impl Iterator<Item = (u8, Span)> + '_ {
        let left = self.given & !self.used;
        (b'A'..=b'Z')
            .filter(move |letter| left & bit(*letter) != 0)
            .map(|letter| (letter, self.slots[usize::from(letter - b'A')].span))
    }
}

/// A value's fault, with the part of the line that it is in.
pub(super) type ValueFault = (Fault, Span);
