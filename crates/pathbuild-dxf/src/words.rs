//! Lines eight bytes at a time. Lines of a DXF file are a few bytes long, and of every length: looked at byte by byte, or even by calls
//! of `memchr`, most of the time goes into branches that the processor guesses wrong.

use memchr::memchr;

/// One in each byte.
const ONES: u64 = u64::from_le_bytes([1; 8]);

/// The length of the line that these bytes begin with, without its end.
#[inline]
pub(crate) fn line_length(bytes: &[u8], line_end: u8) -> usize {
    let mut at = 0;
    // Coordinates with all their digits are longer than one chunk.
    while let Some(chunk) = bytes[at..].first_chunk().filter(|_| at < 2 * CHUNK) {
        if let Some(length) = first_in_chunk(*chunk, line_end) {
            return at + length;
        }
        at += CHUNK;
    }
    at + memchr(line_end, &bytes[at..]).unwrap_or(bytes.len() - at)
}

/// How many bytes are looked at together.
const CHUNK: usize = 16;

#[inline]
fn first_in_chunk(chunk: [u8; CHUNK], byte: u8) -> Option<usize> {
    let chunk = u128::from_le_bytes(chunk);
    #[expect(clippy::cast_possible_truncation, reason = "the two halves")]
    let [low, high] = [chunk as u64, (chunk >> 64) as u64].map(|word| first_match(word, byte));
    // Without a branch: where the lower half has none, it counts 64 zeros, and those of the upper half are added.
    let above = u32::from(low == 0).wrapping_neg() & high.trailing_zeros();
    (low | high != 0).then_some((low.trailing_zeros() + above) as usize / 8)
}

/// The number on the line that these bytes begin with, and the length of that line with its end, if it is a usual one: at most seven
/// bytes, blanks and then digits.
#[inline]
pub(crate) fn short_number(bytes: &[u8], line_end: u8) -> Option<(i32, usize)> {
    let chunk = bytes.first_chunk::<8>()?;
    let word = u64::from_le_bytes(*chunk);
    let line_end = first_match(word, line_end);
    if line_end == 0 {
        return None;
    }
    let length = byte_index(line_end);
    let before = *chunk.get(length.wrapping_sub(1))?;
    let bits = 8 * (length - usize::from(before == b'\r'));
    if bits == 0 {
        return None;
    }
    // The last digit in the last byte, and blanks before the first.
    let padded = (word << (64 - bits)) | ((ONES * 0x20) >> bits);
    Some((number(padded)?, length + 1))
}

/// The number written in eight bytes: blanks and then digits.
#[inline]
fn number(padded: u64) -> Option<i32> {
    // A blank is 20, a digit 30 to 39: bit 4 tells which.
    let is_digit = (padded >> 4) & ONES;
    let values = padded & (ONES * 0x0F);
    let is_blank_or_digit = padded & (ONES * 0xE0) == ONES * 0x20;
    let is_in_range = (is_digit * 9 + ONES * 0x80 - values) & (ONES * 0x80) == ONES * 0x80;
    let has_blank_after_digit = (is_digit << 8) & !is_digit != 0;
    let ends_with_digit = is_digit >> 56 == 1;
    if !is_blank_or_digit || !is_in_range || has_blank_after_digit || !ends_with_digit {
        return None;
    }
    // Neighbours are joined, what belongs to no pair falls out at the top: digits to numbers of two, these to numbers of four, these to the whole.
    let twos = (values.wrapping_mul(1 + (10 << 8)) >> 8) & 0x00FF_00FF_00FF_00FF;
    let fours = (twos.wrapping_mul(1 + (100 << 16)) >> 16) & 0x0000_FFFF_0000_FFFF;
    let whole = fours.wrapping_mul(1 + (10_000 << 32)) >> 32;
    i32::try_from(whole).ok()
}

/// The top bit of each byte of a word that is this byte; above the first there may be wrong ones.
#[inline]
fn first_match(word: u64, byte: u8) -> u64 {
    let zero_where_equal = word ^ (ONES * u64::from(byte));
    zero_where_equal.wrapping_sub(ONES) & !zero_where_equal & (ONES * 0x80)
}

/// The index of the first byte with a bit.
#[inline]
fn byte_index(bits: u64) -> usize {
    bits.trailing_zeros() as usize / 8
}
