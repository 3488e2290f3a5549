//! Finds all line ends of a stretch of bytes at once.
//!
//! Lines of a DXF file are only a few bytes long, and their lengths vary. A new search for each line would cost more than the line itself
//! and would depend on the search before.

use wide::u8x16;

use crate::code::{CodeEnd, Role};

/// The pairs in a stretch of bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch<'a> {
    /// The bytes whose line ends are known, and room for one more code.
    bytes: &'a [u8; KNOWN + CODE],
    /// Offset of the next pair.
    at: usize,
    /// Bit mask of the line ends from there on: bit n for byte n.
    ends: u64,
}

/// Number of bytes scanned at once.
const KNOWN: usize = 64;

/// Longest line with a code, in bytes.
const CODE: usize = 8;

impl<'a> Stretch<'a> {
    /// A stretch without pairs.
    pub(crate) const EMPTY: Self = Self { bytes: &[0; KNOWN + CODE], at: 0, ends: 0 };

    /// The pairs at the start of these bytes; `None` if the first pair is too long or the bytes are nearly exhausted.
    #[inline]
    pub(crate) fn of(bytes: &'a [u8], line_end: u8) -> Option<Self> {
        let bytes = bytes.first_chunk()?;
        let ends = places(bytes.first_chunk()?, line_end);
        (without_first(ends) != 0).then_some(Self { bytes, at: 0, ends })
    }

    /// Number of bytes consumed so far.
    #[inline]
    pub(crate) fn consumed(&self) -> usize {
        self.at
    }

    /// Whether it is [`Self::EMPTY`].
    pub(crate) fn is_empty(&self) -> bool {
        self.at == 0 && self.ends == 0
    }

    /// Consumes the next pair and returns the role of its code and its value; `None` if the pair is incomplete or its code is written
    /// unusually.
    #[inline]
    pub(crate) fn next(&mut self, code_end: CodeEnd) -> Option<(Role, &'a [u8])> {
        let value_ends = without_first(self.ends);
        if value_ends == 0 {
            return None;
        }
        // `at` is always smaller; the remainder proves it to the compiler.
        let at = self.at % KNOWN;
        let (length, role) = Role::of_line(*self.bytes[at..].first_chunk()?, code_end)?;
        let end = value_ends.trailing_zeros() as usize % KNOWN;
        (self.at, self.ends) = (end + 1, without_first(value_ends));
        // Branches on whether there is a CR cannot be predicted.
        let has_cr = usize::from(end > 0 && self.bytes[end - 1] == b'\r');
        Some((role, self.bytes.get(at + length..end - has_cr).unwrap_or_default()))
    }
}

/// Bit mask of the bytes equal to this one: bit n for byte n.
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
