//! Some pairs ahead: where their values are and what their codes say, found for all of them before the first is looked at.
//!
//! Lines of a DXF file are a few bytes long, and of every length. A search that begins anew behind each line waits for the one before
//! and branches on lengths that the processor guesses wrong; here hardly anything depends on what came before.

use std::ops::Range;

use wide::u8x16;

use crate::code::{LineEnd, Role};

/// Where values are and what codes say, for pairs that follow each other.
pub(crate) struct Window {
    value_ends: [usize; MOST_PAIRS + SPARE],
    value_begins: [usize; MOST_PAIRS + SPARE],
    roles: [Role; MOST_PAIRS + SPARE],
    /// How many pairs there are.
    pairs: usize,
}

/// How many pairs a window holds at least, where there are so many.
pub(crate) const MOST_PAIRS: usize = 64;

/// Room for the pairs of the last block, and for a value that no line end follows.
const SPARE: usize = BLOCK + 1;

/// How many bytes are looked at together.
const BLOCK: usize = 64;

impl Window {
    /// An empty one.
    pub(crate) fn new() -> Self {
        Self {
            value_ends: [0; MOST_PAIRS + SPARE],
            value_begins: [0; MOST_PAIRS + SPARE],
            roles: [Role::OTHER; MOST_PAIRS + SPARE],
            pairs: 0,
        }
    }

    /// Looks at so many of the pairs that begin here, or at some more.
    pub(crate) fn fill(&mut self, bytes: &[u8], line_end: u8, at: usize, pairs: usize) {
        self.pairs = self.find_value_ends(bytes, line_end, at, pairs.min(MOST_PAIRS));
        let line_end = LineEnd::new(line_end, has_cr(bytes, at, line_end));
        let mut code = at;
        let places = self.value_ends.iter().zip(&mut self.value_begins).zip(&mut self.roles);
        for ((value_end, value_begin), role) in places.take(self.pairs) {
            let line = bytes.get(code..).and_then(<[u8]>::first_chunk);
            let (length, found) = line.and_then(|line| Role::of_line(*line, line_end)).unwrap_or_default();
            (*value_begin, *role) = (code + length, found);
            code = value_end + 1;
        }
    }

    /// What the codes of its pairs say.
    #[inline]
    pub(crate) fn roles(&self) -> &[Role] {
        &self.roles[..self.pairs]
    }

    /// Where the value of a pair is that is not unusual.
    #[inline]
    pub(crate) fn value(&self, pair: usize) -> Range<usize> {
        self.value_begins[pair]..self.value_ends[pair]
    }

    /// The pairs from this one on: what their codes say and where their values are.
    #[inline]
    pub(crate) fn ahead(&self, pair: usize) -> impl Iterator<Item = (Role, Range<usize>)> {
        let values = self.value_begins[pair..self.pairs].iter().zip(&self.value_ends[pair..self.pairs]);
        let pairs = self.roles[pair..self.pairs].iter().zip(values);
        pairs.map(|(role, (begin, end))| (*role, *begin..*end))
    }

    /// Where a pair ends, without its line end.
    pub(crate) fn end(&self, pair: usize) -> usize {
        self.value_ends[pair]
    }

    /// Finds the ends of so many values or some more; the end of the bytes may be one. Gives back how many there are.
    fn find_value_ends(&mut self, bytes: &[u8], line_end: u8, at: usize, most: usize) -> usize {
        let mut count = 0;
        let mut is_in_value = 0;
        let (blocks, rest) = bytes[at..].as_chunks();
        let mut block_at = at;
        for block in blocks {
            if count >= most {
                return count;
            }
            let ends = every_second(bits_of(block, line_end), &mut is_in_value);
            count += self.write_places(count, block_at, ends);
            block_at += BLOCK;
        }
        if count >= most {
            return count;
        }
        let ends = every_second(bits_of_rest(rest, line_end), &mut is_in_value);
        count += self.write_places(count, block_at, ends);
        // A value may be the last line, without an end.
        if is_in_value != 0 && bytes.last() != Some(&line_end) {
            self.value_ends[count] = bytes.len();
            count += 1;
        }
        count
    }

    /// Writes down where the bits of a block are, behind so many others, and gives back how many there are. More may be written.
    #[inline]
    fn write_places(&mut self, behind: usize, block: usize, mut bits: u64) -> usize {
        const AT_ONCE: usize = 8;
        let count = bits.count_ones() as usize;
        let (places, _) = self.value_ends[behind..behind + BLOCK].as_chunks_mut::<AT_ONCE>();
        for places in places {
            for place in places {
                *place = block + bits.trailing_zeros() as usize;
                bits &= bits.wrapping_sub(1);
            }
            if bits == 0 {
                break;
            }
        }
        count
    }
}

/// Whether the first line ends with a CR and then this byte.
fn has_cr(bytes: &[u8], at: usize, line_end: u8) -> bool {
    let first = bytes[at..].iter().take(BLOCK).position(|byte| *byte == line_end);
    line_end != b'\r' && first.is_some_and(|end| bytes[at..at + end].ends_with(b"\r"))
}

/// Of these line ends those of values: every second. `is_in_value` has all bits if the first line is a value, or none, and is brought
/// up to the next block.
#[inline]
fn every_second(line_ends: u64, is_in_value: &mut u64) -> u64 {
    // Bit n becomes the number of line ends up to there, if it is odd.
    let odd =
        [1, 2, 4, 8, 16, 32].iter().fold(line_ends, |bits, distance| bits ^ bits << distance) ^ *is_in_value;
    *is_in_value = (odd >> 63).wrapping_neg();
    line_ends & !odd
}

/// Those of the bytes of a block that are this one: bit n for byte n.
#[inline]
fn bits_of(block: &[u8; BLOCK], byte: u8) -> u64 {
    let byte = u8x16::splat(byte);
    let (vectors, _) = block.as_chunks();
    let equal = |vector: &[u8; 16]| u64::from(u8x16::from(*vector).simd_eq(byte).to_bitmask());
    vectors.iter().rev().fold(0, |bits, vector| bits << 16 | equal(vector))
}

/// The same for what is no whole block.
#[cold]
#[inline(never)]
fn bits_of_rest(rest: &[u8], byte: u8) -> u64 {
    let mut block = [!byte; BLOCK];
    block[..rest.len()].copy_from_slice(rest);
    bits_of(&block, byte)
}
