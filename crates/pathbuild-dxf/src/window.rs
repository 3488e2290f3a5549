//! Some pairs ahead: where their lines end and what their codes say, found for all of them before the first is looked at.
//!
//! Lines of a DXF file are a few bytes long, and of every length. A search that begins anew behind each line waits for the one before
//! and branches on lengths that the processor guesses wrong; here hardly anything depends on what came before.

use wide::u8x16;

use crate::code::Role;

/// Where lines end and what codes say, for pairs that follow each other.
pub(crate) struct Window {
    /// Of the code and the value of each pair.
    line_ends: [usize; 2 * (MOST_PAIRS + SPARE)],
    roles: [Role; MOST_PAIRS + SPARE],
    /// How many pairs there are.
    pairs: usize,
}

/// How many pairs a window holds at least, where there are so many.
pub(crate) const MOST_PAIRS: usize = 64;

/// Room for the pairs of the last block.
const SPARE: usize = BLOCK / 2;

/// How many bytes are looked at together.
const BLOCK: usize = 64;

impl Window {
    /// An empty one.
    pub(crate) fn new() -> Self {
        Self {
            line_ends: [0; 2 * (MOST_PAIRS + SPARE)],
            roles: [Role::OTHER; MOST_PAIRS + SPARE],
            pairs: 0,
        }
    }

    /// Looks at so many of the pairs that begin here, or at some more.
    pub(crate) fn fill(&mut self, bytes: &[u8], line_end: u8, at: usize, pairs: usize) {
        let lines = self.find_line_ends(bytes, line_end, at, 2 * pairs.min(MOST_PAIRS));
        self.pairs = lines / 2;
        let (line_ends, _) = self.line_ends[..lines].as_chunks();
        let mut code = at;
        for ([end, value_end], role) in line_ends.iter().zip(&mut self.roles) {
            *role = bytes.get(code..).and_then(|rest| Role::of_line(rest, end - code)).unwrap_or(Role::UNUSUAL);
            code = value_end + 1;
        }
    }

    /// What the codes of its pairs say.
    #[inline]
    pub(crate) fn roles(&self) -> &[Role] {
        &self.roles[..self.pairs]
    }

    /// Where the code and the value of a pair end.
    #[inline]
    pub(crate) fn line_ends(&self, pair: usize) -> [usize; 2] {
        [self.line_ends[2 * pair], self.line_ends[2 * pair + 1]]
    }

    /// Finds so many line ends or some more; the end of the bytes is one. Gives back how many there are.
    fn find_line_ends(&mut self, bytes: &[u8], line_end: u8, at: usize, most: usize) -> usize {
        let mut count = 0;
        let mut block = at;
        while count < most && block < bytes.len() {
            let bits = line_ends(&bytes[block..], line_end);
            if let Some(places) = self.line_ends[count..].first_chunk_mut() {
                count += write_places(bits, block, places);
            }
            block += BLOCK;
        }
        let rest = self.line_ends[..count].last().map_or(at, |end| end + 1);
        if block >= bytes.len() && rest < bytes.len() && count < self.line_ends.len() {
            self.line_ends[count] = bytes.len();
            count += 1;
        }
        count
    }
}

/// Writes down where the bits of a block are. More than there are may be written.
#[inline]
fn write_places(mut bits: u64, block: usize, places: &mut [usize; BLOCK]) -> usize {
    const AT_ONCE: usize = 8;
    let count = bits.count_ones() as usize;
    for places in places.chunks_exact_mut(AT_ONCE).take(count.div_ceil(AT_ONCE).max(1)) {
        for place in places {
            *place = block + bits.trailing_zeros() as usize;
            bits &= bits.wrapping_sub(1);
        }
    }
    count
}

/// Those of the first 64 bytes that are this one: bit n for byte n.
#[inline]
fn line_ends(bytes: &[u8], line_end: u8) -> u64 {
    match bytes.first_chunk() {
        Some(block) => in_block(block, line_end),
        None => in_rest(bytes, line_end),
    }
}

#[inline]
fn in_block(block: &[u8; BLOCK], byte: u8) -> u64 {
    let byte = u8x16::splat(byte);
    let (vectors, _) = block.as_chunks();
    let equal = |vector: &[u8; 16]| u64::from(u8x16::from(*vector).simd_eq(byte).to_bitmask());
    vectors.iter().rev().fold(0, |bits, vector| bits << 16 | equal(vector))
}

/// The same where fewer bytes are left.
#[cold]
#[inline(never)]
fn in_rest(bytes: &[u8], line_end: u8) -> u64 {
    let mut block = [!line_end; BLOCK];
    block[..bytes.len()].copy_from_slice(bytes);
    in_block(&block, line_end)
}
