//! Group codes: what the reader does with the groups of each.
//!
//! A code is looked up as its three characters, which is much less work than to make a number of them.

/// What is done with a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Role(u8);

/// How the lines of codes usually end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineEnd {
    /// With its last byte.
    last: u8,
    /// The length of a line of three characters with its end.
    length: usize,
    /// The end behind three characters, and the bits of such a line.
    behind_three: u64,
    mask: u64,
}

impl LineEnd {
    /// With this byte, before which there may be a CR.
    pub(crate) fn new(last: u8, has_cr: bool) -> Self {
        let (end, length) =
            if has_cr { (u64::from(last) << 8 | u64::from(b'\r'), 5) } else { (u64::from(last), 4) };
        Self { last, length, behind_three: end << 24, mask: (1 << (8 * length)) - 1 }
    }
}

impl Default for Role {
    fn default() -> Self {
        Self::UNUSUAL
    }
}

impl Role {
    /// Nothing is known of it.
    pub(crate) const OTHER: Self = Self(83);
    /// It begins an entity: 0.
    pub(crate) const BEGIN: Self = Self(84);
    /// The entity's layer: 8.
    pub(crate) const LAYER: Self = Self(85);
    /// It begins an embedded object: 101.
    pub(crate) const EMBEDDED: Self = Self(86);
    /// It begins or ends what an application holds: 102.
    pub(crate) const APPLICATION: Self = Self(87);
    /// Its line must be read with care.
    pub(crate) const UNUSUAL: Self = Self(88);

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

    /// The role of the code on the line that these bytes begin with, and the length of that line with its end. Only if it is a usual
    /// one: at most three bytes, blanks and then digits, and maybe a CR.
    #[inline]
    pub(crate) fn of_line(line: [u8; 8], line_end: LineEnd) -> Option<(usize, Self)> {
        let word = u64::from_le_bytes(line);
        #[expect(clippy::cast_possible_truncation, reason = "the first characters")]
        let entry = USUAL[index(word as u32)];
        // Nearly all programs pad their codes to three characters, and end all lines in the same way.
        let usual = u64::from(entry & THREE) | line_end.behind_three;
        if (word ^ usual) & line_end.mask == 0 {
            return Some((line_end.length, Self((entry >> 24) as u8)));
        }
        Self::of_unusual_line(line, line_end.last)
    }

    /// The same for less than three characters, or another end of the line.
    #[inline(never)]
    fn of_unusual_line(line: [u8; 8], line_end: u8) -> Option<(usize, Self)> {
        let length = line[..5].iter().position(|byte| *byte == line_end)?;
        let digits = line[..length].strip_suffix(b"\r").unwrap_or(&line[..length]);
        // The last digit in the last byte, and blanks before the first.
        let mut padded = *b"   ";
        padded.get_mut(3_usize.checked_sub(digits.len())?..)?.copy_from_slice(digits);
        let [first, second, third] = padded;
        let text = u32::from_le_bytes([first, second, third, 0]);
        let entry = USUAL[index(text)];
        (entry & THREE == text).then_some((length + 1, Self((entry >> 24) as u8)))
    }

    /// Where the group of an entity is kept. All but [`Role::OTHER`] and those beyond it are kept.
    #[inline]
    pub(crate) fn slot(self) -> usize {
        usize::from(self.0)
    }

    /// Whether its value is only kept, or not even that.
    #[inline]
    pub(crate) fn is_plain(self) -> bool {
        self.0 <= Self::OTHER.0
    }

    /// Its code, unless it has several.
    pub(crate) fn code(self) -> Option<i32> {
        Some(match self {
            Self::OTHER | Self::UNUSUAL => return None,
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

/// The bytes of three characters.
const THREE: u32 = 0x00FF_FFFF;

/// Each code from 0 to 999 as three characters in the lower bytes, with its role in the highest. What is no code is found at no place.
static USUAL: [u32; 1 << 12] = usual();

const fn usual() -> [u32; 1 << 12] {
    let mut table = [0; 1 << 12];
    let mut code = 0;
    while code < 1000 {
        let text = three_characters(code);
        table[index(text)] = text | (Role::of(code).0 as u32) << 24;
        code += 1;
    }
    table
}

#[expect(clippy::cast_sign_loss, reason = "0 to 999")]
const fn three_characters(code: i32) -> u32 {
    let hundreds = if code < 100 { b' ' as u32 } else { b'0' as u32 + (code / 100) as u32 };
    let tens = if code < 10 { b' ' as u32 } else { b'0' as u32 + (code / 10 % 10) as u32 };
    hundreds | tens << 8 | (b'0' as u32 + (code % 10) as u32) << 16
}

/// The lower halves of the first three characters, side by side.
#[inline]
const fn index(text: u32) -> usize {
    // Each is multiplied to its place; what goes to other places is cut off.
    ((text & 0x000F_0F0F).wrapping_mul(1 << 24 | 1 << 12 | 1) >> 16 & 0xFFF) as usize
}
