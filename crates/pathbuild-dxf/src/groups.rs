//! Fast iteration over the pairs of entities. Unusual pairs are left to [`Pairs`], which is careful rather than fast.

use crate::code::{CodeEnd, Role};
use crate::line_ends::Stretch;
use crate::pairs::{Pair, Pairs, Stop, without_cr};

/// A pair with the role of its code.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group<'a> {
    /// The role of the code.
    pub(crate) role: Role,
    /// 1-based line of the code.
    line: u64,
    /// The value, possibly with the CR of its line end.
    pub(crate) raw: &'a [u8],
}

/// Iterator over pairs.
#[derive(Clone, Copy)]
pub(crate) struct Groups<'a> {
    /// The position where iteration started.
    begin: Pairs<'a>,
    code_end: CodeEnd,
    /// The bytes from the current stretch to the end of the file.
    bytes: &'a [u8],
    ahead: NextPair<'a>,
}

/// The position of the next pair.
#[derive(Clone, Copy)]
struct NextPair<'a> {
    stretch: Stretch<'a>,
    /// Line of the next pair.
    line: u64,
}

impl<'a> Group<'a> {
    /// 1-based line of the code.
    #[inline]
    pub(crate) fn line(&self) -> u32 {
        shown(self.line)
    }

    /// The value without its line end.
    #[inline]
    pub(crate) fn value(&self) -> &'a [u8] {
        without_cr(self.raw)
    }

    /// Converts to a pair. A role without a single code has none.
    pub(crate) fn pair(&self) -> Pair<'a> {
        Pair { code: self.role.code().unwrap_or(-1), line: self.line(), value: self.value() }
    }
}

impl<'a> Groups<'a> {
    /// Starts at this position.
    pub(crate) fn new(begin: Pairs<'a>) -> Self {
        let ahead = NextPair { stretch: Stretch::EMPTY, line: begin.line().into() };
        Self { begin, code_end: CodeEnd::of(&begin), bytes: &begin.bytes()[begin.consumed()..], ahead }
    }

    /// The position of the next pair.
    pub(crate) fn pairs(&self) -> Pairs<'a> {
        self.begin.at(self.begin.bytes().len() - self.rest().len(), shown(self.ahead.line))
    }

    /// Returns the next pair that satisfies `is_end` and hands those before it to `pass`.
    #[inline]
    pub(crate) fn pass_until(
        &mut self,
        is_end: impl Fn(Role) -> bool,
        mut pass: impl FnMut(&Group<'a>),
    ) -> Result<Group<'a>, Stop<'a>> {
        let code_end = self.code_end;
        loop {
            // A local copy stays in registers.
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

    /// Skips to the next pair that starts an entity and returns it.
    pub(crate) fn next_zero(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        let group = self.pass_until(|role| role == Role::BEGIN, |_| {})?;
        Ok(group.pair())
    }

    /// The bytes from the next pair on.
    #[inline]
    fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.ahead.stretch.consumed()..).unwrap_or_default()
    }

    /// Scans the bytes ahead, unless that was already tried without success.
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

    /// Reads the next pair carefully: its code is unusual, it is long, or the file ends soon.
    #[cold]
    #[inline(never)]
    fn next_unusual(&mut self) -> Result<Group<'a>, Stop<'a>> {
        let mut pairs = self.pairs();
        let Pair { code, line, value } = pairs.next()?;
        self.bytes = &pairs.bytes()[pairs.consumed()..];
        self.ahead = NextPair { stretch: Stretch::EMPTY, line: pairs.line().into() };
        Ok(Group { role: Role::of(code), line: line.into(), raw: value })
    }
}

impl<'a> NextPair<'a> {
    #[inline]
    fn next(&mut self, code_end: CodeEnd) -> Option<Group<'a>> {
        let (role, raw) = self.stretch.next(code_end)?;
        let line = self.line;
        self.line += 2;
        Some(Group { role, line, raw })
    }
}

/// Converts a line number for diagnostics.
#[inline]
fn shown(line: u64) -> u32 {
    u32::try_from(line).unwrap_or(u32::MAX)
}
