//! The groups of names, by which paths and files are compared. (book: language/layers-and-names)

use std::borrow::Cow;
use std::cmp::Ordering;

use smol_str::SmolStr;

/// The groups that a pattern matched in a name. Two or three groups are stored inline, since they are computed for every embedded path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Groups(List);

#[derive(Clone, Debug, PartialEq, Eq)]
enum List {
    Two([Group; 2]),
    Three([Group; 3]),
    Any(Box<[Group]>),
}

/// A group. Short integers and short texts, the usual case, are also stored inline.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Group {
    /// Digits of a number below 2^64.
    Short {
        /// The number.
        value: u64,
        /// The number of digits.
        digits: usize,
    },
    /// Anything else: longer integers, texts, or an empty group.
    Other(SmolStr),
}

impl<'t> FromIterator<&'t str> for Groups {
    fn from_iter<I: IntoIterator<Item = &'t str>>(groups: I) -> Self {
        let groups: Vec<Group> = groups.into_iter().map(Group::new).collect();
        let few = <[Group; 2]>::try_from(groups).map(List::Two);
        let few = few.or_else(|groups| <[Group; 3]>::try_from(groups).map(List::Three));
        Self(few.unwrap_or_else(|groups| List::Any(groups.into())))
    }
}

impl From<[&str; 2]> for Groups {
    fn from(groups: [&str; 2]) -> Self {
        Self(List::Two(groups.map(Group::new)))
    }
}

impl From<[Option<Group>; 2]> for Groups {
    fn from(groups: [Option<Group>; 2]) -> Self {
        Self(List::Two(groups.map(Option::unwrap_or_default)))
    }
}

impl From<[&str; 3]> for Groups {
    fn from(groups: [&str; 3]) -> Self {
        Self(List::Three(groups.map(Group::new)))
    }
}

impl std::ops::Deref for Groups {
    type Target = [Group];

    fn deref(&self) -> &[Group] {
        match &self.0 {
            List::Two(groups) => groups,
            List::Three(groups) => groups,
            List::Any(groups) => groups,
        }
    }
}

impl Default for Group {
    fn default() -> Self {
        Self::Other(SmolStr::default())
    }
}

impl Group {
    fn new(text: &str) -> Self {
        let value = if is_integer(text) { text.parse().ok() } else { None };
        match value {
            Some(value) => Self::Short { value, digits: text.len() },
            None => Self::Other(text.into()),
        }
    }

    /// Whether the group did not participate.
    pub(crate) fn is_empty(&self) -> bool {
        matches!(self, Self::Other(text) if text.is_empty())
    }

    /// Whether it consists of digits only.
    pub(crate) fn is_integer(&self) -> bool {
        match self {
            Self::Short { .. } => true,
            Self::Other(text) => is_integer(text),
        }
    }

    /// Compares two integers of any length by value, and anything else as texts, ignoring case.
    pub(crate) fn compare(&self, other: &Self) -> Ordering {
        if let (Self::Short { value: a, .. }, Self::Short { value: b, .. }) = (self, other) {
            return a.cmp(b);
        }
        let (a, b) = (self.text(), other.text());
        if self.is_integer() && other.is_integer() {
            let (a, b) = (a.trim_start_matches('0'), b.trim_start_matches('0'));
            return a.len().cmp(&b.len()).then_with(|| a.cmp(b));
        }
        a.chars().flat_map(char::to_uppercase).cmp(b.chars().flat_map(char::to_uppercase))
    }

    /// The group as written.
    pub(crate) fn text(&self) -> Cow<'_, str> {
        match self {
            Self::Short { value, digits } => Cow::Owned(format!("{value:0digits$}")),
            Self::Other(text) => Cow::Borrowed(text),
        }
    }
}

fn is_integer(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}
