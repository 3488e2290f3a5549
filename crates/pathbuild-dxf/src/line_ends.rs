//! Some bytes ahead, whose line ends are found all at once.
//!
//! Lines of a DXF file are a few bytes long, and of every length. A search that begins anew on each line costs more than the line itself
//! and waits for the one before; here hardly anything depends on what came before.

use wide::u8x16;

/// The pairs ahead, with the line ends of some of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineEnds<'a> {
    /// From the first byte that was looked at to the end of the file.
    bytes: &'a [u8],
    /// Where the next pair begins in there.
    at: usize,
    /// The line ends behind, of the bytes that were looked at: bit n for byte n.
    ends: u64,
}

/// How many bytes are looked at together.
const LENGTH: usize = 64;

impl<'a> LineEnds<'a> {
    /// Nothing was looked at yet of these bytes, which a pair begins with.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, ends: 0 }
    }

    /// The bytes from the next pair on.
    #[inline]
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// Looks at the bytes from the next pair on. Gives back whether this has told anything new.
    #[inline]
    pub(crate) fn look_ahead(&mut self, line_end: u8) -> bool {
        let rest = self.rest();
        let Some(block) = rest.first_chunk().filter(|_| self.at > 0 || self.ends == 0) else { return false };
        *self = Self { bytes: rest, at: 0, ends: places(block, line_end) };
        true
    }

    /// Passes over the next pair, whose value begins so many bytes on, and gives back the value; unless it ends behind what was looked at.
    #[inline]
    pub(crate) fn next_value(&mut self, begin: usize) -> Option<&'a [u8]> {
        let ends = without_first(self.ends);
        if ends == 0 {
            return None;
        }
        let end = ends.trailing_zeros() as usize;
        let value = self.bytes.get(self.at + begin..end)?;
        (self.at, self.ends) = (end + 1, without_first(ends));
        Some(value)
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
