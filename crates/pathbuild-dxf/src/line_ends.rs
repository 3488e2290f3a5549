//! Some bytes ahead, whose line ends are found all at once.
//!
//! Lines of a DXF file are a few bytes long, and of every length. A search that begins anew on each line costs more than the line itself
//! and waits for the one before; here hardly anything depends on what came before.

use wide::u8x16;

use crate::code::{CodeEnd, Role};

/// The pairs ahead, with the line ends of some of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineEnds<'a> {
    /// From the first byte that was looked at to the end of the file.
    bytes: &'a [u8],
    /// As many of them as were looked at, and some more.
    block: &'a [u8; LENGTH + CODE],
    /// Where the next pair begins in there.
    at: usize,
    /// The line ends behind, of the bytes that were looked at: bit n for byte n.
    ends: u64,
}

/// How many bytes are looked at together.
const LENGTH: usize = 64;

/// How many bytes the line of a code has at most.
const CODE: usize = 8;

impl<'a> LineEnds<'a> {
    /// Nothing was looked at yet of these bytes, which a pair begins with.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, block: &[0; LENGTH + CODE], at: 0, ends: 0 }
    }

    /// The bytes from the next pair on.
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// Passes over the next pair, and gives back the role of its code, and its value. Not if it is long, if its code is written in an
    /// unusual way, or if the bytes end soon.
    #[inline]
    pub(crate) fn next_pair(&mut self, code_end: CodeEnd) -> Option<(Role, &'a [u8])> {
        let mut value_ends = without_first(self.ends);
        if value_ends == 0 {
            self.look_ahead(code_end.last())?;
            value_ends = without_first(self.ends);
            if value_ends == 0 {
                return None;
            }
        }
        // Two line ends are behind it, so this is no other place; but like that it shows.
        let at = self.at % LENGTH;
        let (length, role) = Role::of_line(*self.block[at..].first_chunk()?, code_end)?;
        let end = value_ends.trailing_zeros() as usize;
        // Whether there is a CR is nothing to branch on.
        let has_cr = usize::from(self.block[end - 1] == b'\r');
        let value = self.block.get(at + length..end - has_cr)?;
        (self.at, self.ends) = (end + 1, without_first(value_ends));
        Some((role, value))
    }

    /// Looks for line ends from the next pair on.
    #[inline]
    fn look_ahead(&mut self, line_end: u8) -> Option<()> {
        let bytes = self.rest();
        let block = bytes.first_chunk()?;
        let (seen, _) = block.split_first_chunk()?;
        *self = Self { bytes, block, at: 0, ends: places(seen, line_end) };
        Some(())
    }
}

/// Those of the bytes of a block that are this one: bit n for byte n.
#[inline]
fn places(block: &[u8; LENGTH], byte: u8) -> u64 {
    let byte = u8x16::splat(byte);
    let (vectors, _) = block.as_chunks();
    let equal = |vector: &[u8; 16]| u64::from(u8x16::from(*vector).simd_eq(byte).to_bitmask());
    vectors.iter().rev().fold(0, |bits, vector| bits << 16 | equal(vector))
}

#[inline]
fn without_first(bits: u64) -> u64 {
    bits & bits.wrapping_sub(1)
}
