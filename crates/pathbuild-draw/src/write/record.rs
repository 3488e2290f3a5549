use std::borrow::Cow;

use crate::model;

/// A group code with its value, borrowed from the crate's output or the sheet, or created here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pair<'a> {
    pub(crate) code: i32,
    pub(crate) value: Cow<'a, str>,
}

impl<'a> Pair<'a> {
    pub(crate) fn new(code: i32, value: impl Into<Cow<'a, str>>) -> Self {
        Self { code, value: value.into() }
    }

    /// A pair for a handle or a pointer to one.
    pub(crate) fn handle(code: i32, handle: u64) -> Self {
        Self::new(code, format!("{handle:X}"))
    }

    /// A pair for an integer, aligned as CAD programs do.
    pub(crate) fn integer(code: i32, number: i64) -> Self {
        Self::new(code, format!("{number:>6}"))
    }

    /// The pair with its value borrowed.
    pub(crate) fn borrowed(&self) -> Pair<'_> {
        Pair { code: self.code, value: Cow::Borrowed(&self.value) }
    }

    /// The pair with its value cloned.
    pub(crate) fn owned(&self) -> Pair<'static> {
        Pair { code: self.code, value: Cow::Owned(self.value.clone().into_owned()) }
    }
}

impl<'a> From<&'a model::Pair> for Pair<'a> {
    fn from(pair: &'a model::Pair) -> Self {
        Self::new(pair.code, pair.value.as_str())
    }
}

/// The pairs from one group 0 to the next.
pub(crate) type Record<'a> = Vec<Pair<'a>>;

/// Splits DXF into records.
pub(crate) fn records(text: &str) -> Vec<Record<'_>> {
    let mut lines = text.lines();
    let mut records: Vec<Record<'_>> = Vec::new();
    while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
        let pair = Pair::new(code.trim().parse().unwrap_or_default(), value);
        match records.last_mut() {
            Some(record) if pair.code != 0 => record.push(pair),
            _ => records.push(vec![pair]),
        }
    }
    records
}

/// The type of a record: the value of group 0.
pub(crate) fn kind<'r>(record: &'r [Pair<'_>]) -> &'r str {
    record.first().map_or("", |pair| pair.value.as_ref())
}

/// The value of the first pair of a code.
pub(crate) fn value<'r>(record: &'r [Pair<'_>], code: i32) -> Option<&'r str> {
    record.iter().find(|pair| pair.code == code).map(|pair| pair.value.as_ref())
}

/// Sets the first pair of a code, or appends it.
pub(crate) fn set<'a>(record: &mut Record<'a>, pair: Pair<'a>) {
    match record.iter_mut().find(|old| old.code == pair.code) {
        Some(old) => *old = pair,
        None => record.push(pair),
    }
}

/// Removes all pairs of some codes.
pub(crate) fn drop_codes(record: &mut Record<'_>, codes: &[i32]) {
    record.retain(|pair| !codes.contains(&pair.code));
}

/// Inserts the handle, and the owner if there is one, after group 0, in place of those that the crate wrote.
pub(crate) fn identify(record: &mut Record<'_>, code: i32, handle: Option<u64>, owner: Option<u64>) {
    drop_codes(record, &[5, 105, 330]);
    let handle = handle.map(|handle| Pair::handle(code, handle));
    let owner = owner.map(|owner| Pair::handle(330, owner));
    record.splice(1..1, handle.into_iter().chain(owner));
}
