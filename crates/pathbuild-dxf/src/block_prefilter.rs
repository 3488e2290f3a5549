//! A fast test of whether any block may draw on a wanted layer: it scans for layer names without parsing the blocks.

use wide::u8x16;

use crate::encoding::Decoder;
use crate::layers::Layers;
use crate::pairs::{Pairs, line_length, without_cr};

/// Whether any entity in these blocks may itself be on a wanted layer; the layers on which the blocks are inserted are not considered.
/// `false` is definitive, however codes are padded and however broken the section is, because every line after a possible code 8 counts as
/// a layer name.
pub(crate) fn may_have_wanted_entities<'a>(
    blocks: &Pairs<'a>,
    layers: &mut Layers<'a, '_>,
    decoder: &mut Decoder<'_>,
) -> bool {
    let (line_end, begin) = (blocks.line_end(), blocks.consumed());
    let bytes = &blocks.bytes()[begin..];
    // Lines are counted on from the previous new layer, not from the start, since a file may name a million layers.
    let mut counted = *blocks;
    any_digit(b'8', bytes, |eight| {
        let Some(at) = line_after_code(bytes, eight, line_end) else { return false };
        let name = line_from(&bytes[at..], line_end);
        let line = || {
            counted.jump_to(begin + at);
            counted.line()
        };
        let layer = layers.id(name, line, decoder);
        layers.is_kept(layer)
    })
}

/// Whether any text (code 1) in these blocks satisfies `is_noted`. Texts in records on a wanted layer are left out.
pub(crate) fn has_noted_text_in<'a>(
    blocks: &Pairs<'a>,
    is_noted: &dyn Fn(&[u8]) -> bool,
    layers: &mut Layers<'a, '_>,
    decoder: &mut Decoder<'_>,
) -> bool {
    let line_end = blocks.line_end();
    let bytes = &blocks.bytes()[blocks.consumed()..];
    any_digit(b'1', bytes, |one| {
        let after = line_after_code(bytes, one, line_end);
        if !after.is_some_and(|at| is_noted(line_from(&bytes[at..], line_end))) {
            return false;
        }
        let layer = layer_before(&bytes[..one], line_end);
        !layer.is_some_and(|layer| {
            let id = layers.id(layer, || blocks.line(), decoder);
            layers.is_kept(id)
        })
    })
}

/// Returns the layer of the record at the end of these bytes, if its group (code 8) is among them.
fn layer_before(bytes: &[u8], line_end: u8) -> Option<&[u8]> {
    let mut lines = bytes.rsplit(|byte| *byte == line_end).skip(1).map(without_cr);
    while let (Some(value), Some(code)) = (lines.next(), lines.next()) {
        match code.trim_ascii() {
            b"8" => return Some(value),
            b"0" => return None,
            _ => {}
        }
    }
    None
}

/// Whether `is_match` holds for any position at which the digit may be a whole group code.
fn any_digit(digit: u8, bytes: &[u8], mut is_match: impl FnMut(usize) -> bool) -> bool {
    // Positions ascend, since the caller counts lines on the way.
    if bytes.first() == Some(&digit) && is_match(0) {
        return true;
    }
    let mut begin = 0;
    while let Some(window) = bytes.get(begin..).and_then(<[u8]>::first_chunk) {
        let mut places = digits(digit, window);
        while places != 0 {
            if is_match(begin + 1 + places.trailing_zeros() as usize) {
                return true;
            }
            places &= places - 1;
        }
        begin += VECTOR_BYTES;
    }
    (begin + 1..bytes.len()).any(|at| bytes.get(at) == Some(&digit) && is_match(at))
}

/// Number of bytes compared at once.
const VECTOR_BYTES: usize = 16;

/// Returns a bit mask of the inner bytes that hold this digit between neighbours that a group code may have: bit n for byte n + 1.
#[inline]
fn digits(digit: u8, window: &[u8; VECTOR_BYTES + 2]) -> u32 {
    let bytes =
        |begin: usize| window[begin..].first_chunk().map_or(u8x16::splat(0), |bytes| u8x16::from(*bytes));
    let is = |bytes: u8x16, byte: u8| bytes.simd_eq(u8x16::splat(byte));
    let is_blank = |bytes: u8x16| bytes.simd_le(u8x16::splat(b' '));
    let before = bytes(0);
    let is_padding = is_blank(before) | is(before, b'0') | is(before, b'+');
    (is_padding & is(bytes(1), digit) & is_blank(bytes(2))).to_bitmask()
}

/// Returns the start of the line after the one with the byte at `digit`; `None` if the line with that byte contains more than a group code.
fn line_after_code(bytes: &[u8], digit: usize, line_end: u8) -> Option<usize> {
    let length = rest_of_code(&bytes[digit + 1..], line_end)?;
    is_begin_of_code(&bytes[..digit], line_end).then_some(digit + 1 + length)
}

/// Returns the length of the padding and the line end at the start of these bytes; `None` if no line end follows the padding, so that no group code
/// ends just before these bytes.
#[inline]
fn rest_of_code(after: &[u8], line_end: u8) -> Option<usize> {
    let length = after.iter().position(|byte| *byte == line_end || *byte > b' ')?;
    (after[length] == line_end).then_some(length + 1)
}

/// Whether a line that ends with these bytes and a digit may be a one-digit code.
#[inline]
fn is_begin_of_code(before: &[u8], line_end: u8) -> bool {
    let is_padding = |byte: u8| byte <= b' ' || matches!(byte, b'0' | b'+');
    let other = before.iter().rev().find(|byte| **byte == line_end || !is_padding(**byte));
    other.is_none_or(|byte| *byte == line_end)
}

fn line_from(bytes: &[u8], line_end: u8) -> &[u8] {
    without_cr(&bytes[..line_length(line_end, bytes)])
}

#[cfg(test)]
mod tests {
    use std::iter;

    use proptest::prelude::*;

    use super::*;
    use crate::header::Header;
    use crate::layers::LayerTable;

    /// Returns the answer of [`may_have_wanted_entities`], found by reading pair by pair.
    fn holds_wanted(mut pairs: Pairs<'_>, is_wanted: impl Fn(&[u8]) -> bool) -> bool {
        iter::from_fn(|| pairs.next().ok()).any(|pair| pair.code == 8 && is_wanted(pair.value))
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// The prefilter misses no wanted entity, wherever its code lies within the bytes that are compared at once.
        #[test]
        fn what_reading_finds_the_prefilter_finds(
            pairs in prop::collection::vec(("[ 0]{0,3}(8|18|80|1)", "[AB8 ]{0,9}"), 0..30), end in "\r?\n",
        ) {
            let lines: Vec<&str> = pairs.iter().flat_map(|(code, value)| [&**code, &*end, &**value, &*end]).collect();
            let text = lines.concat();
            let mut decoder = Decoder::new(text.as_bytes(), &Header::default(), false);
            let mut layers = Layers::new(&|layer| layer == "A", LayerTable::new(None));
            let blocks = Pairs::new(text.as_bytes());
            let found = may_have_wanted_entities(&blocks, &mut layers, &mut decoder);
            prop_assert!(found || !holds_wanted(blocks, |layer| layer.trim_ascii() == b"A"), "{:?}", text);
        }
    }
}
