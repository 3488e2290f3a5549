//! The LAYER table: the line types of layers, and which of them are frozen or off. (book: reference/dxf)

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

/// The LAYER table, of which only what concerns wanted layers is looked at.
#[derive(Debug, Default)]
pub(crate) struct LayerTable<'a> {
    /// The TABLES section.
    tables: Option<Pairs<'a>>,
    /// How often a layer was looked for.
    asked: usize,
    /// All layers, where many are looked for.
    all: Option<KnownLayers<'a>>,
}

/// Layers by their names. Of most hardly anything is asked, so what is said of them is looked at then.
#[derive(Debug, Default)]
pub(crate) struct KnownLayers<'a> {
    records: ByName<'a, LayerRecord<'a>>,
    /// Those whose names have the prefix of an external reference, by what follows it.
    referenced: OnceCell<ByName<'a, LayerRecord<'a>>>,
}

/// A layer of the table.
#[derive(Clone, Debug)]
pub(crate) struct LayerRecord<'a> {
    line_type: Option<Cow<'a, [u8]>>,
    colour: Option<&'a [u8]>,
    flags: Option<&'a [u8]>,
}

/// So many layers are looked for one by one, each in all tables: a drawing of paths has hardly more.
const FEW: usize = 4;

/// What has fewer characters is written nearly everywhere.
const SHORTEST: usize = 4;

impl<'a> LayerTable<'a> {
    /// That of these tables.
    pub(crate) fn new(tables: Option<Pairs<'a>>) -> Self {
        Self { tables, ..Self::default() }
    }

    /// The record of a layer by its whole name, or else by that without the prefix of an external reference.
    pub(crate) fn find(
        &mut self,
        full_name: &str,
        reading: &mut Reading<'_, 'a, '_>,
    ) -> Result<Option<LayerRecord<'a>>, Stop<'a>> {
        let Some(tables) = self.tables else { return Ok(None) };
        self.asked += 1;
        let certain = part_certain(without_xref(full_name).as_bytes());
        let has_escapes = || memchr(b'\\', &tables.bytes()[tables.consumed()..]).is_some();
        if self.all.is_none() && self.asked <= FEW && certain.len() >= SHORTEST && !has_escapes() {
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

/// The longest part of a name that is written so wherever the name is, in whatever case and code page, but for escapes: ASCII without letters. Only
/// letters are other characters in other cases, and whatever is ASCII without being part of an escape is the same in all code pages.
fn part_certain(name: &[u8]) -> &[u8] {
    let is_uncertain = |byte: &u8| !byte.is_ascii() || byte.is_ascii_alphabetic() || *byte == b'\\';
    name.split(is_uncertain).max_by_key(|part| part.len()).unwrap_or_default()
}

impl<'a> KnownLayers<'a> {
    /// Adds the record that these are the groups of, unless it has no name.
    pub(crate) fn add(&mut self, groups: &Fields<'a>, decoder: &mut Decoder<'_>) {
        let Some(name) = groups.get(2) else { return };
        let name = Name::decoded(name.bytes, name.line, decoder);
        let bytes = |code: i32| groups.get(code).map(|value| value.bytes);
        let line_type = groups.get(6).map(|it| decoder.decode_bytes(it.bytes, it.line));
        self.records.push(name, LayerRecord { line_type, colour: bytes(62), flags: bytes(70) });
    }

    /// The name of the one that was added last.
    pub(crate) fn last_name(&self) -> Option<&Name<'a>> {
        self.records.iter().next_back().map(|(name, _)| name)
    }

    /// By its whole name, or else by that without the prefix of an external reference.
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
    /// The line type, upper case, if it has one.
    pub(crate) fn line_type(&self) -> Option<SmolStr> {
        let name = String::from_utf8_lossy(self.line_type.as_deref()?);
        Some(line_type_name(&name)).filter(|name| !name.is_empty())
    }

    /// Whether it is frozen or off.
    pub(crate) fn is_hidden(&self) -> bool {
        let is_off = self.colour.is_some_and(|colour| real(colour).is_ok_and(|number| number < 0.0));
        is_off || self.flags.is_some_and(|flags| whole(flags).is_ok_and(|bits| bits & 1 != 0))
    }
}
