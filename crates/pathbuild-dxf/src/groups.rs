//! Fast iteration over the pairs of entities. Unusual pairs are left to [`Pairs`], which is careful rather than fast.
//!
//! Lines of a DXF file are only a few bytes long, and their lengths vary. A new search for each line would cost more than reading the line
//! and would have to wait for the previous search, so all line ends of a stretch of bytes are found at once.

use wide::u8x16;

use crate::pairs::{Pair, Pairs, Stop, without_cr};

/// A pair with the role of its code.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group<'a> {
    pub(crate) role: Role,
    /// 1-based line of the code.
    line: u64,
    /// The value, possibly with the CR of its line end.
    pub(crate) raw: &'a [u8],
}

/// Fast iterator over the pairs from a position on.
#[derive(Clone, Copy)]
pub(crate) struct Groups<'a> {
    /// The position where iteration started.
    begin: Pairs<'a>,
    code_end: CodeEnd,
    /// The bytes from the current stretch to the end of the file.
    bytes: &'a [u8],
    ahead: NextPair<'a>,
}

#[derive(Clone, Copy)]
struct NextPair<'a> {
    stretch: ScannedPairs<'a>,
    line: u64,
}

impl<'a> Group<'a> {
    /// 1-based line of the code.
    #[inline]
    pub(crate) fn line(&self) -> u32 {
        diagnostic_line(self.line)
    }

    /// The value without its line end.
    #[inline]
    pub(crate) fn value(&self) -> &'a [u8] {
        without_cr(self.raw)
    }

    /// Returns the group with another role for its value.
    pub(crate) fn with_role(self, role: Role) -> Self {
        Self { role, ..self }
    }

    /// Converts the group to a pair. The pair's code is -1 if the role stands for several codes.
    pub(crate) fn pair(&self) -> Pair<'a> {
        Pair { code: self.role.code().unwrap_or(-1), line: self.line(), value: self.value() }
    }
}

impl<'a> Groups<'a> {
    pub(crate) fn new(begin: Pairs<'a>) -> Self {
        let ahead = NextPair { stretch: ScannedPairs::EMPTY, line: begin.line().into() };
        Self { begin, code_end: CodeEnd::of(&begin), bytes: &begin.bytes()[begin.consumed()..], ahead }
    }

    /// The position of the next pair.
    pub(crate) fn pairs(&self) -> Pairs<'a> {
        self.begin.at(self.begin.bytes().len() - self.rest().len(), diagnostic_line(self.ahead.line))
    }

    /// Passes pairs to `pass` until the role of one satisfies `is_end`, and returns that pair.
    #[inline]
    pub(crate) fn pass_until(
        &mut self,
        is_end: impl Fn(Role) -> bool,
        mut pass: impl FnMut(&Group<'a>),
    ) -> Result<Group<'a>, Stop<'a>> {
        let code_end = self.code_end;
        loop {
            // A local copy stays in registers.
            let mut ahead = self.ahead;
            while let Some(group) = ahead.next(code_end) {
                if is_end(group.role) {
                    self.ahead = ahead;
                    return Ok(group);
                }
                pass(&group);
            }
            self.ahead = ahead;
            if !self.look_ahead() {
                let group = self.next_unusual()?;
                if is_end(group.role) {
                    return Ok(group);
                }
                pass(&group);
            }
        }
    }

    /// Skips to the next pair that starts an entity and returns it.
    pub(crate) fn next_record_head(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        let group = self.pass_until(|role| role == Role::BEGIN, |_| {})?;
        Ok(group.pair())
    }

    /// The bytes from the next pair on.
    #[inline]
    fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.ahead.stretch.consumed()..).unwrap_or_default()
    }

    /// Scans the bytes ahead and returns whether they may contain pairs that [`ScannedPairs`] can read. Where it has already failed to read one, the
    /// scan is not repeated.
    #[inline]
    fn look_ahead(&mut self) -> bool {
        if self.ahead.stretch.consumed() == 0 && !self.ahead.stretch.is_empty() {
            return false;
        }
        let bytes = self.rest();
        let Some(stretch) = ScannedPairs::of(bytes, self.code_end.line_end()) else { return false };
        (self.bytes, self.ahead.stretch) = (bytes, stretch);
        true
    }

    /// Reads the next pair with [`Pairs`], because its code is unusual, the pair is long, or the file ends soon.
    #[cold]
    #[inline(never)]
    fn next_unusual(&mut self) -> Result<Group<'a>, Stop<'a>> {
        let mut pairs = self.pairs();
        let Pair { code, line, value } = pairs.next()?;
        self.bytes = &pairs.bytes()[pairs.consumed()..];
        self.ahead = NextPair { stretch: ScannedPairs::EMPTY, line: pairs.line().into() };
        Ok(Group { role: Role::of(code), line: line.into(), raw: value })
    }
}

/// The records of a section or block. `head` is the `0` pair of the next one.
pub(crate) struct Records<'a> {
    pub(crate) groups: Groups<'a>,
    pub(crate) head: Pair<'a>,
}

impl<'a> Records<'a> {
    /// Creates the records and moves to the first pair with code 0.
    pub(crate) fn new(pairs: Pairs<'a>) -> Result<Self, Stop<'a>> {
        let mut groups = Groups::new(pairs);
        let head = groups.next_record_head()?;
        Ok(Self { groups, head })
    }

    /// Skips the following records of this kind on this layer. Entities of one layer mostly follow each other.
    pub(crate) fn skip_similar_records(&mut self, kind: &[u8], layer: &[u8]) -> Result<(), Stop<'a>> {
        while self.head.value == kind {
            let begin = self.groups;
            let group = self.groups.pass_until(|role| !role.is_plain(), |_| {})?;
            if group.role != Role::LAYER || group.value() != layer {
                self.groups = begin;
                break;
            }
            self.head = self.groups.next_record_head()?;
        }
        Ok(())
    }

    pub(crate) fn skip(&mut self) -> Result<(), Stop<'a>> {
        self.head = self.groups.next_record_head()?;
        Ok(())
    }
}

impl<'a> NextPair<'a> {
    #[inline]
    fn next(&mut self, code_end: CodeEnd) -> Option<Group<'a>> {
        let (role, raw) = self.stretch.next(code_end)?;
        let line = self.line;
        self.line += 2;
        Some(Group { role, line, raw })
    }
}

#[inline]
fn diagnostic_line(line: u64) -> u32 {
    u32::try_from(line).unwrap_or(u32::MAX)
}

/// The pairs in a stretch of bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScannedPairs<'a> {
    /// The bytes with known line ends, followed by as many bytes as one more code may need.
    bytes: &'a [u8; WINDOW_BYTES + MAX_CODE_BYTES],
    /// Offset of the next pair.
    at: usize,
    /// Bit mask of the line ends from `at` on: bit n for byte n.
    ends: u64,
}

/// Number of bytes scanned at once.
const WINDOW_BYTES: usize = 64;

/// Maximum length in bytes of a group code's line, with its end, that the fast path reads.
const MAX_CODE_BYTES: usize = 8;

impl<'a> ScannedPairs<'a> {
    const EMPTY: Self = Self { bytes: &[0; WINDOW_BYTES + MAX_CODE_BYTES], at: 0, ends: 0 };

    /// Finds the pairs at the start of these bytes; `None` if the first pair is too long or the bytes are nearly exhausted.
    #[inline]
    pub(crate) fn of(bytes: &'a [u8], line_end: u8) -> Option<Self> {
        let bytes = bytes.first_chunk()?;
        let ends = matching_bytes(bytes.first_chunk()?, line_end);
        (without_first(ends) != 0).then_some(Self { bytes, at: 0, ends })
    }

    #[inline]
    pub(crate) fn consumed(&self) -> usize {
        self.at
    }

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
        // `at` is always within the window; the remainder proves it to the compiler.
        let at = self.at % WINDOW_BYTES;
        let (length, role) = Role::of_line(*self.bytes[at..].first_chunk()?, code_end)?;
        let end = value_ends.trailing_zeros() as usize % WINDOW_BYTES;
        (self.at, self.ends) = (end + 1, without_first(value_ends));
        // Use no branch: whether a line ends with CR cannot be predicted.
        let has_cr = usize::from(end > 0 && self.bytes[end - 1] == b'\r');
        Some((role, self.bytes.get(at + length..end - has_cr).unwrap_or_default()))
    }
}

/// Returns a bit mask of the bytes equal to `byte`: bit n for byte n.
#[inline]
fn matching_bytes(bytes: &[u8; WINDOW_BYTES], byte: u8) -> u64 {
    let byte = u8x16::splat(byte);
    let (vectors, _) = bytes.as_chunks();
    let equal = |vector: &[u8; 16]| u64::from(u8x16::from(*vector).simd_eq(byte).to_bitmask());
    vectors.iter().rev().fold(0, |bits, vector| bits << 16 | equal(vector))
}

#[inline]
fn without_first(bits: u64) -> u64 {
    bits & bits.wrapping_sub(1)
}

/// The role of a group code: it decides what the reader does with the value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Role(u8);

/// The usual form and end of lines with group codes in this file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CodeEnd {
    /// The byte that ends a line: LF or CR.
    last: u8,
    /// Length of a group-code line of three characters, including its line end.
    length: usize,
    /// The line end, shifted to its place after three characters, and the mask that covers the whole line.
    line_end_after_three: u64,
    mask: u64,
}

impl CodeEnd {
    /// Determines from the first line how group codes are written.
    pub(crate) fn of(pairs: &Pairs<'_>) -> Self {
        let last = pairs.line_end();
        let rest = &pairs.bytes()[pairs.consumed()..];
        let end = rest.iter().take(MAX_CODE_BYTES).position(|byte| *byte == last);
        let has_cr = last != b'\r' && end.is_some_and(|end| rest[..end].ends_with(b"\r"));
        let (end, length) =
            if has_cr { (u64::from(last) << 8 | u64::from(b'\r'), 5) } else { (u64::from(last), 4) };
        Self { last, length, line_end_after_three: end << 24, mask: (1 << (8 * length)) - 1 }
    }

    pub(crate) fn line_end(self) -> u8 {
        self.last
    }
}

impl Role {
    /// A code without any role.
    const WITHOUT_ROLE: Self = Self(84);
    /// Code 0, which starts an entity.
    pub(crate) const BEGIN: Self = Self(85);
    /// Code 8, the entity's layer.
    pub(crate) const LAYER: Self = Self(86);
    /// Code 101, which starts an embedded object.
    pub(crate) const EMBEDDED: Self = Self(87);
    /// Code 102, which opens or closes a group of an application.
    pub(crate) const APPLICATION: Self = Self(88);
    /// Code 304, the text of a multileader.
    pub(crate) const LEADER_TEXT: Self = Self(89);

    pub(crate) const fn of(code: i32) -> Self {
        match code {
            0 => Self::BEGIN,
            8 => Self::LAYER,
            101 => Self::EMBEDDED,
            102 => Self::APPLICATION,
            304 => Self::LEADER_TEXT,
            90 => Self(83),
            210 => Self(80),
            220 => Self(81),
            230 => Self(82),
            #[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "below 80")]
            1..80 => Self(code as u8),
            _ => Self::WITHOUT_ROLE,
        }
    }

    /// Returns the role of the code on the first line of these bytes, and the length of that line with its end. `None` unless the line has at most
    /// seven bytes: blanks, digits, and possibly a CR.
    #[inline]
    fn of_line(line: [u8; 8], code_end: CodeEnd) -> Option<(usize, Self)> {
        let word = u64::from_le_bytes(line);
        #[expect(clippy::cast_possible_truncation, reason = "the first characters")]
        let index = index(word as u32);
        // Nearly all programs pad codes to three characters and use one kind of line end.
        if (word ^ code_end.line_end_after_three) & code_end.mask == u64::from(USUAL_CODES[index]) {
            return Some((code_end.length, ROLES[index]));
        }
        Self::of_unusual_line(line, code_end.last)
    }

    /// Like [`Self::of_line`], for codes of any width that fits, and for other line ends.
    #[inline(never)]
    fn of_unusual_line(line: [u8; 8], line_end: u8) -> Option<(usize, Self)> {
        let word = u64::from_le_bytes(line);
        let other = word ^ (ONE_PER_BYTE * u64::from(line_end));
        // Set the top bit of each byte that is a line end. Bits above the lowest set one may be wrong.
        let ends = other.wrapping_sub(ONE_PER_BYTE) & !other & (ONE_PER_BYTE * 0x80);
        let length = ends.trailing_zeros() as usize / 8;
        let before = *line.get(length.wrapping_sub(1)).filter(|_| length < line.len())?;
        let bits = 8 * (length - usize::from(before == b'\r'));
        if bits == 0 {
            return None;
        }
        // Align the last digit to the last byte and fill with blanks before the first.
        let code = number((word << (64 - bits)) | ((ONE_PER_BYTE * 0x20) >> bits))?;
        Some((length + 1, Self::of(code)))
    }

    /// Returns the slot in which an entity keeps the value. All codes of [`Role::WITHOUT_ROLE`] share one slot; the values of the later roles are not
    /// stored (the slot of code 101 is used for the columns of an embedded object).
    #[inline]
    pub(crate) fn slot(self) -> usize {
        usize::from(self.0)
    }

    /// Whether the value is stored unparsed or ignored.
    #[inline]
    pub(crate) fn is_plain(self) -> bool {
        self.0 <= Self::WITHOUT_ROLE.0
    }

    /// Returns the code with this role, if there is only one.
    pub(crate) fn code(self) -> Option<i32> {
        Some(match self {
            Self::WITHOUT_ROLE => return None,
            Self::BEGIN => 0,
            Self::LAYER => 8,
            Self::EMBEDDED => 101,
            Self::APPLICATION => 102,
            Self::LEADER_TEXT => 304,
            Self(80) => 210,
            Self(81) => 220,
            Self(82) => 230,
            Self(83) => 90,
            Self(slot) => i32::from(slot),
        })
    }
}

/// Parses eight bytes of blanks followed by digits.
fn number(padded: u64) -> Option<i32> {
    // A blank is 0x20, a digit 0x30 to 0x39: bit 4 tells them apart.
    let is_digit = (padded >> 4) & ONE_PER_BYTE;
    let values = padded & (ONE_PER_BYTE * 0x0F);
    let is_blank_or_digit = padded & (ONE_PER_BYTE * 0xE0) == ONE_PER_BYTE * 0x20;
    let is_in_range =
        (is_digit * 9 + ONE_PER_BYTE * 0x80 - values) & (ONE_PER_BYTE * 0x80) == ONE_PER_BYTE * 0x80;
    let has_blank_after_digit = (is_digit << 8) & !is_digit != 0;
    let ends_with_digit = is_digit >> 56 == 1;
    if !is_blank_or_digit || !is_in_range || has_blank_after_digit || !ends_with_digit {
        return None;
    }
    // Combine neighbours: digits to two-digit numbers, these to four-digit numbers, and these to the result. Sums that belong to no
    // pair are masked out or overflow at the top.
    let twos = (values.wrapping_mul(1 + (10 << 8)) >> 8) & 0x00FF_00FF_00FF_00FF;
    let fours = (twos.wrapping_mul(1 + (100 << 16)) >> 16) & 0x0000_FFFF_0000_FFFF;
    i32::try_from(fours.wrapping_mul(1 + (10_000 << 32)) >> 32).ok()
}

const ONE_PER_BYTE: u64 = u64::from_le_bytes([1; 8]);

/// The codes 0 to 999 as three characters, each in the slot that [`index`] gives. Slots without a code match no text.
static USUAL_CODES: [u32; TABLE_SLOTS] = usual_codes().0;

/// The roles of the codes in [`USUAL_CODES`].
static ROLES: [Role; TABLE_SLOTS] = usual_codes().1;

const TABLE_SLOTS: usize = 1 << 12;

const fn usual_codes() -> ([u32; TABLE_SLOTS], [Role; TABLE_SLOTS]) {
    let mut texts = [0; TABLE_SLOTS];
    let mut roles = [Role::WITHOUT_ROLE; TABLE_SLOTS];
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

/// Returns the low nibbles of the first three characters, side by side.
#[inline]
const fn index(text: u32) -> usize {
    // The product shifts each nibble to its place; the mask removes the rest.
    ((text & 0x000F_0F0F).wrapping_mul(1 << 24 | 1 << 12 | 1) >> 16 & 0xFFF) as usize
}
