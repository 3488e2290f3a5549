//! The pairs of entities, as fast as can be. What is unusual about one is left to [`Pairs`], which reads with care.

use crate::code::{CodeEnd, Role};
use crate::line_ends::LineEnds;
use crate::pairs::{Pair, Pairs, Stop, without_cr};

/// A pair by what is done with it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group<'a> {
    /// What its code says.
    pub(crate) role: Role,
    /// 1-based line of the code.
    line: u64,
    /// The value, which may still have the CR of its line end.
    pub(crate) raw: &'a [u8],
}

/// Pairs that are gone through from one to the next.
pub(crate) struct Groups<'a> {
    /// Where they begin.
    begin: Pairs<'a>,
    code_end: CodeEnd,
    ahead: Ahead<'a>,
}

/// Where the next pair is.
#[derive(Clone, Copy)]
struct Ahead<'a> {
    line_ends: LineEnds<'a>,
    line: u64,
}

impl<'a> Group<'a> {
    /// 1-based line of the code.
    #[inline]
    pub(crate) fn line(&self) -> u32 {
        shown(self.line)
    }

    /// As a pair; one that only has a role has no code.
    pub(crate) fn pair(&self) -> Pair<'a> {
        Pair { code: self.role.code().unwrap_or(-1), line: self.line(), value: without_cr(self.raw) }
    }
}

impl<'a> Groups<'a> {
    /// Those that begin here.
    pub(crate) fn new(begin: Pairs<'a>) -> Self {
        Self { begin, code_end: CodeEnd::of(&begin), ahead: Ahead::new(&begin) }
    }

    /// Where the next one begins.
    pub(crate) fn pairs(&self) -> Pairs<'a> {
        self.begin.at(self.begin.bytes().len() - self.ahead.line_ends.rest().len(), shown(self.ahead.line))
    }

    /// The next one for which `is_end`; those before are handed to `pass`.
    #[inline]
    pub(crate) fn pass_until(
        &mut self,
        is_end: impl Fn(Role) -> bool,
        mut pass: impl FnMut(&Group<'a>),
    ) -> Result<Group<'a>, Stop<'a>> {
        let code_end = self.code_end;
        loop {
            // A copy, which nobody else knows, is kept in registers.
            let mut ahead = self.ahead;
            let end = loop {
                match ahead.next(code_end) {
                    Some(group) if !is_end(group.role) => pass(&group),
                    end => break end,
                }
            };
            self.ahead = ahead;
            let group = end.map_or_else(|| self.next_unusual(), Ok)?;
            if is_end(group.role) {
                return Ok(group);
            }
            pass(&group);
        }
    }

    /// Skips those up to the next that begins an entity, and returns that one.
    pub(crate) fn next_zero(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        let group = self.pass_until(|role| role == Role::BEGIN, |_| {})?;
        Ok(group.pair())
    }

    #[cold]
    #[inline(never)]
    fn next_unusual(&mut self) -> Result<Group<'a>, Stop<'a>> {
        let mut pairs = self.pairs();
        let Pair { code, line, value } = pairs.next()?;
        self.ahead = Ahead::new(&pairs);
        Ok(Group { role: Role::of(code), line: line.into(), raw: value })
    }
}

impl<'a> Ahead<'a> {
    fn new(pairs: &Pairs<'a>) -> Self {
        Self { line_ends: LineEnds::new(&pairs.bytes()[pairs.consumed()..]), line: pairs.line().into() }
    }

    /// The next pair, unless it is to be read with care: its code is written in an unusual way, its value is long, or the file ends.
    #[inline]
    fn next(&mut self, code_end: CodeEnd) -> Option<Group<'a>> {
        let (role, raw) = self.line_ends.next_pair(code_end)?;
        let line = self.line;
        self.line += 2;
        Some(Group { role, line, raw })
    }
}

/// The number of a line as it is said.
#[inline]
fn shown(line: u64) -> u32 {
    u32::try_from(line).unwrap_or(u32::MAX)
}
