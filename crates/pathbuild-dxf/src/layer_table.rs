//! The LAYER table: the line types of layers, and which of them are frozen or off. (spec/10-drawing.md)
//!
//! Hardly any of a drawing's layers is ever looked for, so records are kept as they stand, and put in an order when the first is looked
//! for.

use std::borrow::Cow;
use std::cell::OnceCell;

use smol_str::SmolStr;

use crate::encoding::Decoder;
use crate::fields::Fields;
use crate::line_types::line_type_name;
use crate::names::{Name, without_xref};
use crate::number::{real, whole};

/// The LAYER table.
#[derive(Debug, Default)]
pub(crate) struct LayerTable<'a> {
    records: Vec<LayerRecord<'a>>,
    /// What records are found by, in order.
    keys: OnceCell<Vec<Key>>,
}

/// A layer of the table.
#[derive(Debug)]
pub(crate) struct LayerRecord<'a> {
    /// With whatever prefix it has.
    name: Name<'a>,
    line_type: Option<Cow<'a, [u8]>>,
    /// Frozen or off.
    pub(crate) is_hidden: bool,
}

/// A name that a record is found by.
#[derive(Clone, Copy, Debug)]
struct Key {
    hash: u64,
    record: usize,
    /// Where it begins in the record's name: 0, or behind the prefix of an external reference.
    begin: usize,
}

impl<'a> LayerTable<'a> {
    /// A table of these records.
    pub(crate) fn new(records: Vec<LayerRecord<'a>>) -> Self {
        Self { records, keys: OnceCell::new() }
    }

    /// The record of a layer by its whole name, or else by that without the prefix of an external reference.
    pub(crate) fn get(&self, full_name: &str) -> Option<&LayerRecord<'a>> {
        let find = |name: &str| self.find(&Name::new(name.into()));
        find(full_name).or_else(|| find(without_xref(full_name)))
    }

    fn find(&self, name: &Name<'_>) -> Option<&LayerRecord<'a>> {
        let hash = name.hash();
        let keys = self.keys.get_or_init(|| self.sorted_keys());
        let place = |key: &Key| key.hash.cmp(&hash).then_with(|| self.name(key).cmp(name));
        let first = keys.get(keys.partition_point(|key| place(key).is_lt()))?;
        place(first).is_eq().then(|| &self.records[first.record])
    }

    fn sorted_keys(&self) -> Vec<Key> {
        let mut keys = Vec::with_capacity(self.records.len());
        for (record, LayerRecord { name, .. }) in self.records.iter().enumerate() {
            let begin = name.xref_prefix();
            keys.push(Key { hash: name.hash(), record, begin: 0 });
            keys.extend((begin > 0).then(|| Key { hash: name.from(begin).hash(), record, begin }));
        }
        // Names are compared only where hashes are the same. Of records with the same name the first counts, and one of exactly the name
        // before one with a prefix.
        keys.sort_unstable_by(|a, b| {
            let same_name = || (a.begin > 0, a.record).cmp(&(b.begin > 0, b.record));
            a.hash.cmp(&b.hash).then_with(|| self.name(a).cmp(&self.name(b))).then_with(same_name)
        });
        keys
    }

    fn name(&self, key: &Key) -> Name<'_> {
        self.records[key.record].name.from(key.begin)
    }
}

impl<'a> LayerRecord<'a> {
    /// A record, unless it has no name.
    pub(crate) fn read(groups: &Fields<'a>, decoder: &mut Decoder<'_>) -> Option<Self> {
        let name = groups.get(2)?;
        Some(Self {
            name: Name::decoded(name.bytes, name.line, decoder),
            line_type: groups.get(6).map(|it| decoder.decode_bytes(it.bytes, it.line)),
            is_hidden: is_off(groups) || is_frozen(groups),
        })
    }

    /// The line type, upper case, if it has one.
    pub(crate) fn line_type(&self) -> Option<SmolStr> {
        let name = String::from_utf8_lossy(self.line_type.as_deref()?);
        Some(line_type_name(&name)).filter(|name| !name.is_empty())
    }
}

fn is_off(groups: &Fields<'_>) -> bool {
    let is_negative = |colour: &[u8]| colour.contains(&b'-') && real(colour).is_ok_and(|number| number < 0.0);
    groups.get(62).is_some_and(|colour| is_negative(colour.bytes))
}

fn is_frozen(groups: &Fields<'_>) -> bool {
    groups.get(70).is_some_and(|flags| whole(flags.bytes).is_ok_and(|bits| bits & 1 != 0))
}
