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
        self.begin.after(self.next, self.at())
    }

    /// The next one.
    #[inline]
    pub(crate) fn next(&mut self) -> Result<Group<'a>, Stop<'a>> {
        match self.window.roles().get(self.next) {
            Some(role) if *role != Role::UNUSUAL => Ok(self.take(*role)),
            _ => self.next_carefully(),
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
        let [code_end, value_end] = self.window.line_ends(self.next);
        let group = Group { role, line: self.begin.line_after(self.next), raw: &self.begin.bytes()[code_end + 1..value_end] };
        self.next += 1;
        group
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
            Some(last) => (self.window.line_ends(last)[1] + 1).min(self.begin.bytes().len()),
            None => self.begin.consumed(),
        }
    }
}
