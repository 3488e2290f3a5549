//! The LAYER table: line types of layers, and which layers are frozen or off. (book: reference/dxf)

use std::borrow::Cow;
use std::cell::OnceCell;

use memchr::memchr;
use smol_str::SmolStr;

use crate::by_name::ByName;
use crate::encoding::Decoder;
use crate::fields::Fields;
use crate::layer_records::Reading;
use crate::line_types::line_type_name;
use crate::names::{Name, without_xref};
use crate::number::{real, whole};
use crate::pairs::{Pairs, Stop};

/// The LAYER table, of which only records of wanted layers are read.
#[derive(Debug, Default)]
pub(crate) struct LayerTable<'a> {
    /// The TABLES section.
    tables: Option<Pairs<'a>>,
    /// Number of lookups so far.
    lookups: usize,
    /// All layers, read after many lookups.
    all: Option<KnownLayers<'a>>,
}

/// Layers by name. Few are ever looked up, so their values are decoded on demand.
#[derive(Debug, Default)]
pub(crate) struct KnownLayers<'a> {
    records: ByName<'a, LayerRecord<'a>>,
    /// Layers with an external-reference prefix, by the rest of their names.
    referenced: OnceCell<ByName<'a, LayerRecord<'a>>>,
}

/// A layer of the table.
#[derive(Clone, Debug)]
pub(crate) struct LayerRecord<'a> {
    line_type: Option<Cow<'a, [u8]>>,
    colour: Option<&'a [u8]>,
    flags: Option<&'a [u8]>,
}

/// Number of layers that are looked up one by one in the tables; most drawings of paths have no more.
const FEW: usize = 4;

/// Shorter texts occur nearly everywhere, so searching for them does not pay.
const SHORTEST: usize = 4;

impl<'a> LayerTable<'a> {
    /// The table of this TABLES section.
    pub(crate) fn new(tables: Option<Pairs<'a>>) -> Self {
        Self { tables, ..Self::default() }
    }

    /// Finds the record of a layer by its full name, else by the name without external-reference prefix.
    pub(crate) fn find(
        &mut self,
        full_name: &str,
        reading: &mut Reading<'_, 'a, '_>,
    ) -> Result<Option<LayerRecord<'a>>, Stop<'a>> {
        let Some(tables) = self.tables else { return Ok(None) };
        self.lookups += 1;
        let certain = part_certain(without_xref(full_name).as_bytes());
        let has_escapes = || memchr(b'\\', &tables.bytes()[tables.consumed()..]).is_some();
        if self.all.is_none() && self.lookups <= FEW && certain.len() >= SHORTEST && !has_escapes() {
            let some = reading.some(tables, certain, &Name::new(full_name.into()))?;
            return Ok(some.get(full_name).cloned());
        }
        let all = match &mut self.all {
            Some(all) => all,
            all => all.insert(reading.all(tables)?),
        };
        Ok(all.get(full_name).cloned())
    }
}

/// The longest part of a name that is the same in any case and code page: ASCII without escapes and letters.
fn part_certain(name: &[u8]) -> &[u8] {
    let is_uncertain = |byte: &u8| !byte.is_ascii() || byte.is_ascii_alphabetic() || *byte == b'\\';
    name.split(is_uncertain).max_by_key(|part| part.len()).unwrap_or_default()
}

impl<'a> KnownLayers<'a> {
    /// Adds a record from its groups, unless it has no name.
    pub(crate) fn add(&mut self, groups: &Fields<'a>, decoder: &mut Decoder<'_>) {
        let Some(name) = groups.get(2) else { return };
        let name = Name::decoded(name.bytes, name.line, decoder);
        let bytes = |code: i32| groups.get(code).map(|value| value.bytes);
        let line_type = groups.get(6).map(|name| decoder.decode_bytes(name.bytes, name.line));
        self.records.push(name, LayerRecord { line_type, colour: bytes(62), flags: bytes(70) });
    }

    /// The name added last.
    pub(crate) fn last_name(&self) -> Option<&Name<'a>> {
        self.records.iter().next_back().map(|(name, _)| name)
    }

    /// Finds a record by its full name, else by the name without external-reference prefix.
    pub(crate) fn get(&self, full_name: &str) -> Option<&LayerRecord<'a>> {
        let find = |name: &str| {
            let name = Name::new(name.into());
            self.records.find(&name).or_else(|| self.referenced().find(&name))
        };
        find(full_name).or_else(|| find(without_xref(full_name)))
    }

    fn referenced(&self) -> &ByName<'a, LayerRecord<'a>> {
        self.referenced.get_or_init(|| {
            let mut referenced = ByName::default();
            for (name, record) in self.records.iter() {
                if let Some(name) = name.behind_xref() {
                    referenced.push(name, record.clone());
                }
            }
            referenced
        })
    }
}

impl LayerRecord<'_> {
    /// The line type in upper case, if set.
    pub(crate) fn line_type(&self) -> Option<SmolStr> {
        let name = String::from_utf8_lossy(self.line_type.as_deref()?);
        Some(line_type_name(&name)).filter(|name| !name.is_empty())
    }

    /// Whether the layer is frozen or off.
    pub(crate) fn is_hidden(&self) -> bool {
        let is_off = self.colour.is_some_and(|colour| real(colour).is_ok_and(|number| number < 0.0));
        is_off || self.flags.is_some_and(|flags| whole(flags).is_ok_and(|bits| bits & 1 != 0))
    }
}
