//! Group codes and what the reader does with their values.
//!
//! A code is looked up by its three characters, which costs much less than parsing it as a number.

use crate::pairs::Pairs;

/// What the reader does with a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Role(u8);

/// How lines with group codes usually end in this file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CodeEnd {
    /// The byte that ends a line: LF or CR.
    last: u8,
    /// Length of a line of three characters with its line end.
    length: usize,
    /// The line end after three characters, and the mask of such a line.
    behind_three: u64,
    mask: u64,
}

/// Longest line with a code that the fast path reads.
const LONGEST: usize = 8;

impl CodeEnd {
    /// Determines from the first line how group codes are written.
    pub(crate) fn of(pairs: &Pairs<'_>) -> Self {
        let last = pairs.line_end();
        let rest = &pairs.bytes()[pairs.consumed()..];
        let end = rest.iter().take(LONGEST).position(|byte| *byte == last);
        let has_cr = last != b'\r' && end.is_some_and(|end| rest[..end].ends_with(b"\r"));
        let (end, length) =
            if has_cr { (u64::from(last) << 8 | u64::from(b'\r'), 5) } else { (u64::from(last), 4) };
        Self { last, length, behind_three: end << 24, mask: (1 << (8 * length)) - 1 }
    }

    /// The byte that ends a line.
    pub(crate) fn last(self) -> u8 {
        self.last
    }
}

impl Role {
    /// A code without any role.
    pub(crate) const OTHER: Self = Self(83);
    /// Code 0, which starts an entity.
    pub(crate) const BEGIN: Self = Self(84);
    /// The entity's layer: 8.
    pub(crate) const LAYER: Self = Self(85);
    /// Code 101, which starts an embedded object.
    pub(crate) const EMBEDDED: Self = Self(86);
    /// Code 102, which opens or closes a group of an application.
    pub(crate) const APPLICATION: Self = Self(87);

    /// The role of a code.
    pub(crate) const fn of(code: i32) -> Self {
        match code {
            0 => Self::BEGIN,
            8 => Self::LAYER,
            101 => Self::EMBEDDED,
            102 => Self::APPLICATION,
            210 => Self(80),
            220 => Self(81),
            230 => Self(82),
            #[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "below 80")]
            1..80 => Self(code as u8),
            _ => Self::OTHER,
        }
    }

    /// The role of the code on the first line of these bytes, and the length of that line with its end. `None` unless the line has at most
    /// seven bytes: blanks, digits, and possibly a CR.
    #[inline]
    pub(crate) fn of_line(line: [u8; 8], code_end: CodeEnd) -> Option<(usize, Self)> {
        let word = u64::from_le_bytes(line);
        #[expect(clippy::cast_possible_truncation, reason = "the first characters")]
        let index = index(word as u32);
        // Nearly all programs pad codes to three characters and use one kind of line end.
        if (word ^ code_end.behind_three) & code_end.mask == u64::from(USUAL[index]) {
            return Some((code_end.length, ROLES[index]));
        }
        Self::of_unusual_line(line, code_end.last)
    }

    /// Like [`Self::of_line`], for codes of any width that fits, and for other line ends.
    #[inline(never)]
    fn of_unusual_line(line: [u8; 8], line_end: u8) -> Option<(usize, Self)> {
        let word = u64::from_le_bytes(line);
        let other = word ^ (ONES * u64::from(line_end));
        // Sets the top bit of each byte that is a line end. Bits above the lowest may be wrong.
        let ends = other.wrapping_sub(ONES) & !other & (ONES * 0x80);
        let length = ends.trailing_zeros() as usize / 8;
        let before = *line.get(length.wrapping_sub(1)).filter(|_| length < line.len())?;
        let bits = 8 * (length - usize::from(before == b'\r'));
        if bits == 0 {
            return None;
        }
        // Aligns the last digit to the last byte and fills with blanks before the first.
        let code = number((word << (64 - bits)) | ((ONES * 0x20) >> bits))?;
        Some((length + 1, Self::of(code)))
    }

    /// The slot in which an entity keeps the value. [`Role::OTHER`] and the roles after it have none.
    #[inline]
    pub(crate) fn slot(self) -> usize {
        usize::from(self.0)
    }

    /// Whether the value is stored unparsed or ignored.
    #[inline]
    pub(crate) fn is_plain(self) -> bool {
        self.0 <= Self::OTHER.0
    }

    /// The code with this role, if there is only one.
    pub(crate) fn code(self) -> Option<i32> {
        Some(match self {
            Self::OTHER => return None,
            Self::BEGIN => 0,
            Self::LAYER => 8,
            Self::EMBEDDED => 101,
            Self::APPLICATION => 102,
            Self(80) => 210,
            Self(81) => 220,
            Self(82) => 230,
            Self(slot) => i32::from(slot),
        })
    }
}

/// Parses eight bytes of blanks followed by digits.
fn number(padded: u64) -> Option<i32> {
    // A blank is 0x20, a digit 0x30 to 0x39: bit 4 tells them apart.
    let is_digit = (padded >> 4) & ONES;
    let values = padded & (ONES * 0x0F);
    let is_blank_or_digit = padded & (ONES * 0xE0) == ONES * 0x20;
    let is_in_range = (is_digit * 9 + ONES * 0x80 - values) & (ONES * 0x80) == ONES * 0x80;
    let has_blank_after_digit = (is_digit << 8) & !is_digit != 0;
    let ends_with_digit = is_digit >> 56 == 1;
    if !is_blank_or_digit || !is_in_range || has_blank_after_digit || !ends_with_digit {
        return None;
    }
    // Combines neighbours: digits to two-digit numbers, these to four-digit numbers, and these to the result. Everything that belongs to
    // no pair overflows at the top.
    let twos = (values.wrapping_mul(1 + (10 << 8)) >> 8) & 0x00FF_00FF_00FF_00FF;
    let fours = (twos.wrapping_mul(1 + (100 << 16)) >> 16) & 0x0000_FFFF_0000_FFFF;
    i32::try_from(fours.wrapping_mul(1 + (10_000 << 32)) >> 32).ok()
}

/// 0x01 in each byte.
const ONES: u64 = u64::from_le_bytes([1; 8]);

/// The codes 0 to 999 as three characters, by hash. Slots without a code match no text.
static USUAL: [u32; PLACES] = usual().0;

/// The roles of the codes in [`USUAL`].
static ROLES: [Role; PLACES] = usual().1;

const PLACES: usize = 1 << 12;

const fn usual() -> ([u32; PLACES], [Role; PLACES]) {
    let mut texts = [0; PLACES];
    let mut roles = [Role::OTHER; PLACES];
    let mut code = 0;
    while code < 1000 {
        let text = three_characters(code);
        texts[index(text)] = text;
        roles[index(text)] = Role::of(code);
        code += 1;
    }
    (texts, roles)
}

#[expect(clippy::cast_sign_loss, reason = "0 to 999")]
const fn three_characters(code: i32) -> u32 {
    let hundreds = if code < 100 { b' ' as u32 } else { b'0' as u32 + (code / 100) as u32 };
    let tens = if code < 10 { b' ' as u32 } else { b'0' as u32 + (code / 10 % 10) as u32 };
    hundreds | tens << 8 | (b'0' as u32 + (code % 10) as u32) << 16
}

/// The low nibbles of the first three characters, side by side.
#[inline]
const fn index(text: u32) -> usize {
    // The product shifts each nibble to its place; the mask removes the rest.
    ((text & 0x000F_0F0F).wrapping_mul(1 << 24 | 1 << 12 | 1) >> 16 & 0xFFF) as usize
}
