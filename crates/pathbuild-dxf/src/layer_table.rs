//! The LAYER table: the line types of layers, and which of them are frozen or off. (spec/10-drawing.md)
//!
//! Hardly any of a drawing's layers is ever looked for, so records are kept as they stand, in the order of their names.

use std::borrow::Cow;
use std::cmp::Ordering;

use crate::encoding::Decoder;
use crate::fields::Fields;
use crate::line_types::line_type_name;
use crate::names::{compare_ascii, folded, without_xref};
use crate::number::{real, whole};

/// The LAYER table.
#[derive(Debug, Default)]
pub(crate) struct LayerTable<'a> {
    records: Vec<LayerRecord<'a>>,
    /// What records are found by, in order.
    names: Vec<Name>,
}

/// A layer of the table.
#[derive(Debug)]
pub(crate) struct LayerRecord<'a> {
    /// Trimmed, with whatever prefix it has; upper case unless it is ASCII.
    name: Cow<'a, str>,
    line_type: Option<Cow<'a, str>>,
    /// Of the colour and the flags, the bytes of their numbers.
    colour: Option<&'a [u8]>,
    flags: Option<&'a [u8]>,
}

/// A name that a record is found by.
#[derive(Clone, Copy, Debug)]
struct Name {
    record: usize,
    /// Where it begins in the record's name: 0, or behind the prefix of an external reference.
    begin: usize,
}

impl<'a> LayerTable<'a> {
    /// A table of these records.
    pub(crate) fn new(records: Vec<LayerRecord<'a>>) -> Self {
        let mut names = Vec::with_capacity(records.len());
        for (record, LayerRecord { name, .. }) in records.iter().enumerate() {
            names.push(Name { record, begin: 0 });
            let begin = name.len() - without_xref(name).len();
            names.extend((begin > 0).then_some(Name { record, begin }));
        }
        let mut table = Self { records, names: Vec::new() };
        // Of records with the same name the first counts, and one of exactly the name before one with a prefix.
        names.sort_unstable_by(|a, b| {
            let same_name = || (a.begin > 0, a.record).cmp(&(b.begin > 0, b.record));
            compare_ascii(table.name(*a), table.name(*b)).then_with(same_name)
        });
        table.names = names;
        table
    }

    /// The record of a layer by its whole name, or else by that without the prefix of an external reference.
    pub(crate) fn get(&self, full_name: &str) -> Option<&LayerRecord<'a>> {
        let name = comparable(Cow::Borrowed(full_name));
        self.find(&name).or_else(|| self.find(without_xref(&name)))
    }

    fn find(&self, name: &str) -> Option<&LayerRecord<'a>> {
        let is_before = |other: &Name| compare_ascii(self.name(*other), name) == Ordering::Less;
        let first = self.names.get(self.names.partition_point(is_before))?;
        compare_ascii(self.name(*first), name).is_eq().then(|| &self.records[first.record])
    }

    fn name(&self, name: Name) -> &str {
        &self.records[name.record].name[name.begin..]
    }
}

impl<'a> LayerRecord<'a> {
    /// A record, unless it has no name.
    pub(crate) fn read(groups: &Fields<'a>, decoder: &mut Decoder<'_>) -> Option<Self> {
        let name = groups.get(2)?;
        Some(Self {
            name: comparable(decoder.decode(name.bytes, name.line)),
            line_type: groups.get(6).map(|it| decoder.decode(it.bytes, it.line)),
            colour: groups.get(62).map(|it| it.bytes),
            flags: groups.get(70).map(|it| it.bytes),
        })
    }

    /// The line type, upper case, if it has one.
    pub(crate) fn line_type(&self) -> Option<Box<str>> {
        self.line_type.as_deref().map(line_type_name).filter(|name| !name.is_empty())
    }

    /// Whether it is frozen or off.
    pub(crate) fn is_hidden(&self) -> bool {
        let is_off = self.colour.is_some_and(|colour| real(colour).is_ok_and(|number| number < 0.0));
        let is_frozen = self.flags.is_some_and(|flags| whole(flags).is_ok_and(|bits| bits & 1 != 0));
        is_off || is_frozen
    }
}

/// A name that [`compare_ascii`] compares as all names are compared.
fn comparable(name: Cow<'_, str>) -> Cow<'_, str> {
    match name {
        Cow::Borrowed(name) if name.is_ascii() => Cow::Borrowed(name.trim()),
        name => Cow::Owned(folded(name.trim())),
    }
}
