//! Name ranges whose groups are short integers, which is nearly always the case. They are compared as two packed numbers instead of group
//! by group, with the same result.

use crate::group::{Group, Groups};

/// An end of a range, `1234` or `1234.5`, with the numbers of digits as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NumberPart {
    first: Number,
    second: Option<Number>,
}

/// An integer as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Number {
    value: u32,
    digits: u8,
}

/// A range of path names, or a single name. Ordered by the first name in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct NumberRange {
    /// The first name in the range. A part without a second group covers all names with one.
    first: NumberKey,
    /// The last name in the range.
    last: NumberKey,
    /// The numbers of digits as written; 0 for a missing number.
    digits: [u8; 4],
}

/// The key of a path name for such ranges: its first two groups packed into one number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct NumberKey(u64);

/// Greater than every second group.
const LAST: u32 = u32::MAX;

impl NumberPart {
    /// Parses the digits of both groups, of which the second may be empty. `None` if there are too many digits.
    pub(crate) fn new(first: &[u8], second: &[u8]) -> Option<Self> {
        let second = if second.is_empty() { None } else { Some(Number::parse(second)?) };
        Some(Self { first: Number::parse(first)?, second })
    }

    pub(crate) fn of(groups: &Groups) -> Option<Self> {
        let [first, rest @ ..] = &**groups else { return None };
        let second = match rest {
            [] => None,
            [second, rest @ ..] if rest.iter().all(Group::is_empty) => {
                Some(second).filter(|group| !group.is_empty())
            }
            _ => return None,
        };
        let second = match second {
            Some(group) => Some(Number::of(group)?),
            None => None,
        };
        Some(Self { first: Number::of(first)?, second })
    }

    pub(crate) fn groups(self) -> Groups {
        [Some(self.first), self.second].map(|number| number.map(Number::group)).into()
    }

    fn key(self, missing: u32) -> NumberKey {
        let second = self.second.map_or(missing, |second| second.value);
        NumberKey::new(self.first.value, second)
    }

    fn from_key(key: NumberKey, digits: [u8; 2]) -> Option<Self> {
        let number = |value, digits| (digits > 0).then_some(Number { value, digits });
        let (first, second) = key.groups();
        Some(Self { first: number(first, digits[0])?, second: number(second, digits[1]) })
    }

    fn digits(self) -> [u8; 2] {
        [self.first.digits, self.second.map_or(0, |second| second.digits)]
    }
}

impl NumberRange {
    pub(crate) fn new(from: NumberPart, to: Option<NumberPart>) -> Self {
        let ([a, b], [c, d]) = (from.digits(), to.map_or([0; 2], NumberPart::digits));
        Self { first: from.key(0), last: to.unwrap_or(from).key(LAST), digits: [a, b, c, d] }
    }

    #[expect(clippy::needless_bitwise_bool, reason = "without a branch it is twice as fast")]
    pub(crate) fn holds(self, path: NumberKey) -> bool {
        // Without a branch: most comparisons fail, and which of the two fails is unpredictable.
        (self.first <= path) & (path <= self.last)
    }

    /// The first groups of the first and the last name.
    pub(crate) fn first_groups(self) -> (Group, Group) {
        let [first, _, last, _] = self.digits;
        let group = |key: NumberKey, digits: u8| Number { value: key.groups().0, digits }.group();
        (group(self.first, first), group(self.last, if last == 0 { first } else { last }))
    }

    /// The groups of both ends.
    pub(crate) fn groups(self) -> (Groups, Option<Groups>) {
        let [a, b, c, d] = self.digits;
        let from = NumberPart::from_key(self.first, [a, b]).expect("a range has a first number");
        (from.groups(), NumberPart::from_key(self.last, [c, d]).map(NumberPart::groups))
    }
}

impl NumberKey {
    fn new(first: u32, second: u32) -> Self {
        Self(u64::from(first) << 32 | u64::from(second))
    }

    #[expect(clippy::cast_possible_truncation, reason = "each is one half")]
    fn groups(self) -> (u32, u32) {
        ((self.0 >> 32) as u32, self.0 as u32)
    }
}

impl Number {
    fn parse(digits: &[u8]) -> Option<Self> {
        const SURELY_FIT: usize = 9;
        let add = |value: u32, digit: &u8| value.checked_mul(10)?.checked_add(u32::from(digit - b'0'));
        let value = if digits.len() <= SURELY_FIT {
            digits.iter().fold(0, |value, digit| 10 * value + u32::from(digit - b'0'))
        } else {
            digits.iter().try_fold(0, add).filter(|value| *value < LAST - 1)?
        };
        Some(Self { value, digits: u8::try_from(digits.len()).ok()? })
    }

    fn of(group: &Group) -> Option<Self> {
        let Group::Short { value, digits } = group else { return None };
        let value = u32::try_from(*value).ok().filter(|value| *value < LAST - 1)?;
        Some(Self { value, digits: u8::try_from(*digits).ok()? })
    }

    fn group(self) -> Group {
        Group::Short { value: self.value.into(), digits: self.digits.into() }
    }
}

/// The key of a path name whose first two groups are integers.
pub(crate) fn number_key(groups: &Groups) -> Option<NumberKey> {
    let [Group::Short { value: first, .. }, Group::Short { value: second, .. }, ..] = &**groups else {
        return None;
    };
    // No range has larger numbers, so they can be capped.
    let second = u32::try_from(*second).unwrap_or(LAST).min(LAST - 1);
    Some(NumberKey::new(u32::try_from(*first).ok()?, second))
}
