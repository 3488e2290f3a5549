//! The pairs of entities, as fast as can be. What is unusual about one is left to [`Pairs`], which reads with care.

use crate::code::{CodeEnd, Role};
use crate::line_ends::Stretch;
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
#[derive(Clone, Copy)]
pub(crate) struct Groups<'a> {
    /// Where they begin.
    begin: Pairs<'a>,
    code_end: CodeEnd,
    /// From where the stretch begins to the end of the file.
    bytes: &'a [u8],
    ahead: Ahead<'a>,
}

/// The next pairs.
#[derive(Clone, Copy)]
struct Ahead<'a> {
    stretch: Stretch<'a>,
    /// The line of the first.
    line: u64,
}

impl<'a> Group<'a> {
    /// 1-based line of the code.
    #[inline]
    pub(crate) fn line(&self) -> u32 {
        shown(self.line)
    }

    /// The value.
    #[inline]
    pub(crate) fn value(&self) -> &'a [u8] {
        without_cr(self.raw)
    }

    /// As a pair; one that only has a role has no code.
    pub(crate) fn pair(&self) -> Pair<'a> {
        Pair { code: self.role.code().unwrap_or(-1), line: self.line(), value: self.value() }
    }
}

impl<'a> Groups<'a> {
    /// Those that begin here.
    pub(crate) fn new(begin: Pairs<'a>) -> Self {
        let ahead = Ahead { stretch: Stretch::EMPTY, line: begin.line().into() };
        Self { begin, code_end: CodeEnd::of(&begin), bytes: &begin.bytes()[begin.consumed()..], ahead }
    }

    /// Where the next one begins.
    pub(crate) fn pairs(&self) -> Pairs<'a> {
        self.begin.at(self.begin.bytes().len() - self.rest().len(), shown(self.ahead.line))
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
            while let Some(group) = ahead.next(code_end) {
                if is_end(group.role) {
                    self.ahead = ahead;
                    return Ok(group);
                }
                pass(&group);
            }
            self.ahead = ahead;
            if !self.look_ahead() {
                let group = self.next_unusual()?;
                if is_end(group.role) {
                    return Ok(group);
                }
                pass(&group);
            }
        }
    }

    /// Skips those up to the next that begins an entity, and returns that one.
    pub(crate) fn next_zero(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        let group = self.pass_until(|role| role == Role::BEGIN, |_| {})?;
        Ok(group.pair())
    }

    /// The bytes from the next one on.
    #[inline]
    fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.ahead.stretch.consumed()..).unwrap_or_default()
    }

    /// Looks at the bytes ahead, unless that was done and has not helped.
    #[inline]
    fn look_ahead(&mut self) -> bool {
        if self.ahead.stretch.consumed() == 0 && !self.ahead.stretch.is_empty() {
            return false;
        }
        let bytes = self.rest();
        let Some(stretch) = Stretch::of(bytes, self.code_end.last()) else { return false };
        (self.bytes, self.ahead.stretch) = (bytes, stretch);
        true
    }

    /// The next one, which is read with care: its code is written in an unusual way, it is long, or the file ends soon.
    #[cold]
    #[inline(never)]
    fn next_unusual(&mut self) -> Result<Group<'a>, Stop<'a>> {
        let mut pairs = self.pairs();
        let Pair { code, line, value } = pairs.next()?;
        self.bytes = &pairs.bytes()[pairs.consumed()..];
        self.ahead = Ahead { stretch: Stretch::EMPTY, line: pairs.line().into() };
        Ok(Group { role: Role::of(code), line: line.into(), raw: value })
    }
}

impl<'a> Ahead<'a> {
    #[inline]
    fn next(&mut self, code_end: CodeEnd) -> Option<Group<'a>> {
        let (role, raw) = self.stretch.next(code_end)?;
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
