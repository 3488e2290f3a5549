//! Name ranges whose groups are short integers, as nearly all are: two numbers that are compared at once, where groups are compared one by
//! one. They say what the groups say.

use crate::group::{Group, Groups};

/// One end of a range: `1234` or `1234.5`, with how many digits they are written with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NumberPart {
    first: Number,
    second: Option<Number>,
}

/// An integer as it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Number {
    value: u32,
    digits: u8,
}

/// A range of path names, or a single one. Ordered by the first name that it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct NumberRange {
    /// The first name that it holds. What has no second group covers all that have one.
    first: NumberKey,
    /// The last name that it holds.
    last: NumberKey,
    /// With how many digits its numbers are written; 0 for one that is not there.
    digits: [u8; 4],
}

/// A path's name among such ranges: its first two groups, one behind the other in one number, which is compared at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct NumberKey(u64);

/// What is after all second groups of a first one.
const LAST: u32 = u32::MAX;

impl NumberPart {
    /// What these digits say; `None` where there are too many of them. The second may be missing.
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
        // Without a branch between: nearly all are looked at in vain, and which of both is why nobody can guess.
        (self.first <= path) & (path <= self.last)
    }

    /// The first group of the first name that it holds, and of the last.
    pub(crate) fn first_groups(self) -> (Group, Group) {
        let [first, _, last, _] = self.digits;
        let group = |key: NumberKey, digits: u8| Number { value: key.groups().0, digits }.group();
        (group(self.first, first), group(self.last, if last == 0 { first } else { last }))
    }

    /// The groups of its ends.
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

/// The key of a path's groups: of an integer, an integer, and whatever follows.
pub(crate) fn number_key(groups: &Groups) -> Option<NumberKey> {
    let [Group::Short { value: first, .. }, Group::Short { value: second, .. }, ..] = &**groups else {
        return None;
    };
    // Larger numbers than that no range has that this key is compared with.
    let second = u32::try_from(*second).unwrap_or(LAST).min(LAST - 1);
    Some(NumberKey::new(u32::try_from(*first).ok()?, second))
}
