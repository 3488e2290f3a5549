//! Some bytes ahead, whose line ends are found all at once.
//!
//! Lines of a DXF file are a few bytes long, and of every length. A search that begins anew on each line costs more than the line itself
//! and waits for the one before; here hardly anything depends on what came before.

use wide::u8x16;

use crate::code::{CodeEnd, Role};

/// The pairs of a stretch of bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch<'a> {
    /// The bytes whose line ends are known, and some more.
    bytes: &'a [u8; KNOWN + CODE],
    /// Where the next pair begins.
    at: usize,
    /// The line ends behind: bit n for byte n.
    ends: u64,
}

/// How many bytes are looked at together.
const KNOWN: usize = 64;

/// How many bytes the line of a code has at most.
const CODE: usize = 8;

impl<'a> Stretch<'a> {
    /// One without pairs.
    pub(crate) const EMPTY: Self = Self { bytes: &[0; KNOWN + CODE], at: 0, ends: 0 };

    /// That which these bytes begin with. Not if the first pair is long, or if they end soon.
    #[inline]
    pub(crate) fn of(bytes: &'a [u8], line_end: u8) -> Option<Self> {
        let bytes = bytes.first_chunk()?;
        let ends = places(bytes.first_chunk()?, line_end);
        (without_first(ends) != 0).then_some(Self { bytes, at: 0, ends })
    }

    /// How many bytes its pairs had so far.
    #[inline]
    pub(crate) fn consumed(&self) -> usize {
        self.at
    }

    /// Whether it never had any.
    pub(crate) fn is_empty(&self) -> bool {
        self.at == 0 && self.ends == 0
    }

    /// Passes over the next pair, and gives back the role of its code, and its value. Not if that does not end here, or if the code is
    /// written in an unusual way.
    #[inline]
    pub(crate) fn next(&mut self, code_end: CodeEnd) -> Option<(Role, &'a [u8])> {
        let value_ends = without_first(self.ends);
        if value_ends == 0 {
            return None;
        }
        // Line ends are behind it, so this is no other place; but like that it shows.
        let at = self.at % KNOWN;
        let (length, role) = Role::of_line(*self.bytes[at..].first_chunk()?, code_end)?;
        let end = value_ends.trailing_zeros() as usize % KNOWN;
        (self.at, self.ends) = (end + 1, without_first(value_ends));
        // Whether there is a CR is nothing to branch on.
        let has_cr = usize::from(end > 0 && self.bytes[end - 1] == b'\r');
        Some((role, self.bytes.get(at + length..end - has_cr).unwrap_or_default()))
    }
}

/// Those of the bytes that are this one: bit n for byte n.
#[inline]
fn places(bytes: &[u8; KNOWN], byte: u8) -> u64 {
    let byte = u8x16::splat(byte);
    let (vectors, _) = bytes.as_chunks();
    let equal = |vector: &[u8; 16]| u64::from(u8x16::from(*vector).simd_eq(byte).to_bitmask());
    vectors.iter().rev().fold(0, |bits, vector| bits << 16 | equal(vector))
}

#[inline]
fn without_first(bits: u64) -> u64 {
    bits & bits.wrapping_sub(1)
}
