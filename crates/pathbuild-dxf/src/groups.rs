//! The pairs of entities, many at a time. What is unusual about one is left to [`Pairs`], which reads pair by pair.

use crate::code::Role;
use crate::pairs::{Pair, Pairs, Stop, without_cr};
use crate::window::{MOST_PAIRS, Window};

/// A pair by what is done with it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group<'a> {
    /// What its code says.
    pub(crate) role: Role,
    /// 1-based line of the code.
    pub(crate) line: u32,
    /// The value, which may still have the CR of its line end.
    pub(crate) raw: &'a [u8],
}

/// Pairs that are gone through from one to the next.
pub(crate) struct Groups<'a> {
    /// Where the window begins.
    begin: Pairs<'a>,
    window: Window,
    /// The number in the window of the next pair.
    next: usize,
    /// How many pairs are looked at together the next time.
    ahead: usize,
}

/// How many pairs are looked at together at first: blocks are often short.
const FIRST: usize = 16;

impl<'a> Group<'a> {
    /// As a pair; one that only has a role has no code.
    pub(crate) fn pair(&self) -> Pair<'a> {
        Pair { code: self.role.code().unwrap_or(-1), line: self.line, value: without_cr(self.raw) }
    }
}

impl<'a> Groups<'a> {
    /// Those that begin here.
    pub(crate) fn new(pairs: Pairs<'a>) -> Self {
        Self { begin: pairs, window: Window::new(), next: 0, ahead: FIRST }
    }

    /// Where the next one begins.
    pub(crate) fn pairs(&self) -> Pairs<'a> {
        self.begin.after(number(self.next), self.at())
    }

    /// The next one.
    #[inline]
    pub(crate) fn next(&mut self) -> Result<Group<'a>, Stop<'a>> {
        match self.window.roles().get(self.next) {
            Some(role) if *role != Role::UNUSUAL => Ok(self.take(*role)),
            _ => self.next_carefully(),
        }
    }

    /// Takes those whose values are only kept, up to one with which more is to be done or one that is read with care.
    #[inline]
    pub(crate) fn take_plain(&mut self, mut keep: impl FnMut(&Group<'a>)) {
        let plain = self.window.ahead(self.next).take_while(|(role, _)| role.is_plain());
        let bytes = self.begin.bytes();
        for (role, value) in plain {
            let line = self.begin.line_after(number(self.next));
            keep(&Group { role, line, raw: &bytes[value] });
            self.next += 1;
        }
    }

    /// Skips those up to the next that begins an entity, and returns that one.
    pub(crate) fn next_zero(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        loop {
            let ahead = &self.window.roles()[self.next..];
            let is_of_interest = |role: &Role| matches!(*role, Role::BEGIN | Role::UNUSUAL);
            self.next += ahead.iter().position(is_of_interest).unwrap_or(ahead.len());
            let group = self.next()?;
            if group.role == Role::BEGIN {
                return Ok(group.pair());
            }
        }
    }

    /// The next one, which is in the window.
    #[inline]
    fn take(&mut self, role: Role) -> Group<'a> {
        let line = self.begin.line_after(number(self.next));
        let raw = &self.begin.bytes()[self.window.value(self.next)];
        self.next += 1;
        Group { role, line, raw }
    }

    /// The next one, be it unusual or behind the window.
    #[cold]
    #[inline(never)]
    fn next_carefully(&mut self) -> Result<Group<'a>, Stop<'a>> {
        if self.next == self.window.roles().len() {
            self.look_ahead();
            if let Some(role) = self.window.roles().first().filter(|role| **role != Role::UNUSUAL) {
                return Ok(self.take(*role));
            }
        }
        let mut pairs = self.pairs();
        let Pair { code, line, value } = pairs.next()?;
        self.next += 1;
        Ok(Group { role: Role::of(code), line, raw: value })
    }

    fn look_ahead(&mut self) {
        self.begin = self.pairs();
        self.next = 0;
        self.window.fill(self.begin.bytes(), self.begin.line_end(), self.begin.consumed(), self.ahead);
        self.ahead = MOST_PAIRS;
    }

    /// Where the next one begins.
    fn at(&self) -> usize {
        match self.next.checked_sub(1) {
            Some(last) => (self.window.end(last) + 1).min(self.begin.bytes().len()),
            None => self.begin.consumed(),
        }
    }
}

/// The number of a pair in a window, which is small.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "it is small")]
fn number(pair: usize) -> u32 {
    pair as u32
}
