//! Layers: the LAYER table, and the layers that entities are on. (spec/10-drawing.md; spec/20-paths-and-files.md)
//!
//! Each spelling of a layer's name is looked at once a file; entities only hold its number.

use std::collections::HashMap;
use std::sync::Arc;

use crate::encoding::Decoder;
use crate::fields::Fields;
use crate::names::{folded, without_xref};
use crate::number::{real, whole};

/// What is taken where nothing is said.
pub(crate) const CONTINUOUS: &str = "CONTINUOUS";

/// The LAYER table.
#[derive(Debug, Default)]
pub(crate) struct LayerTable {
    /// By name, compared without case, and by name without xref prefix where no layer has exactly that name.
    records: HashMap<String, LayerRecord>,
}

#[derive(Clone, Debug)]
struct LayerRecord {
    line_type: Box<str>,
    hidden: bool,
    is_exact: bool,
}

/// The number of a spelling of a layer's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct LayerId(u32);

/// The layers that entities were found on so far.
pub(crate) struct Layers<'a, 'o> {
    table: LayerTable,
    keep: &'o dyn Fn(&str) -> bool,
    by_spelling: HashMap<&'a [u8], LayerId>,
    used: Vec<UsedLayer>,
    last: Option<(&'a [u8], LayerId)>,
}

/// A layer as it is spelt on some entity.
#[derive(Clone, Debug)]
pub(crate) struct UsedLayer {
    /// Trimmed, decoded, without xref prefix.
    pub(crate) name: Box<str>,
    /// What it is compared by.
    pub(crate) folded: Box<str>,
    /// Whether entities on it are wanted.
    pub(crate) is_kept: bool,
    /// Its line type, upper case.
    pub(crate) line_type: Arc<str>,
    /// Frozen or off.
    pub(crate) hidden: bool,
}

impl LayerTable {
    /// Adds a record of the table.
    pub(crate) fn add(&mut self, record: &Fields<'_>, decoder: &mut Decoder<'_>) {
        let Some(name) = record.get(2) else { return };
        let name = folded(decoder.decode(name.bytes, name.line).trim());
        let line_type = record.get(6).map(|it| line_type_name(&decoder.decode(it.bytes, it.line)));
        let is_off = record.get(62).is_some_and(|colour| real(colour.bytes).is_ok_and(|number| number < 0.0));
        let is_frozen =
            record.get(70).is_some_and(|flags| whole(flags.bytes).is_ok_and(|bits| bits & 1 != 0));
        let line_type = line_type.filter(|name| !name.is_empty()).unwrap_or_else(|| CONTINUOUS.into());
        let layer = LayerRecord { line_type, hidden: is_off || is_frozen, is_exact: true };
        let short = without_xref(&name);
        if short.len() < name.len() {
            self.records.entry(short.to_owned()).or_insert(LayerRecord { is_exact: false, ..layer.clone() });
        }
        let record = self.records.entry(name).or_insert_with(|| layer.clone());
        if !record.is_exact {
            *record = layer;
        }
    }

    fn get(&self, full_name: &str) -> Option<&LayerRecord> {
        self.records.get(full_name).or_else(|| self.records.get(without_xref(full_name)))
    }
}

impl<'a, 'o> Layers<'a, 'o> {
    /// No layer is used yet.
    pub(crate) fn new(table: LayerTable, keep: &'o dyn Fn(&str) -> bool) -> Self {
        Self { table, keep, by_spelling: HashMap::new(), used: Vec::new(), last: None }
    }

    /// The layer of an entity that names it so.
    #[inline]
    pub(crate) fn id(&mut self, spelling: &'a [u8], line: u32, decoder: &mut Decoder<'_>) -> LayerId {
        if let Some((last, id)) = self.last
            && last == spelling
        {
            return id;
        }
        let id = match self.by_spelling.get(spelling) {
            Some(id) => *id,
            None => self.first_use(spelling, line, decoder),
        };
        self.last = Some((spelling, id));
        id
    }

    /// What is known of it.
    #[inline]
    pub(crate) fn get(&self, id: LayerId) -> &UsedLayer {
        &self.used[id.0 as usize]
    }

    /// Whether entities on it are wanted.
    #[inline]
    pub(crate) fn is_kept(&self, id: LayerId) -> bool {
        self.get(id).is_kept
    }

    /// The layer that an entity of a block is on when the block is inserted on a layer: that one, if the entity is on layer `0`.
    pub(crate) fn inherited(&self, layer: LayerId, of_insert: LayerId) -> LayerId {
        if self.is_inheriting(layer) { of_insert } else { layer }
    }

    /// Whether it is layer `0`.
    pub(crate) fn is_inheriting(&self, layer: LayerId) -> bool {
        &*self.get(layer).folded == "0"
    }

    fn first_use(&mut self, spelling: &'a [u8], line: u32, decoder: &mut Decoder<'_>) -> LayerId {
        let decoded = decoder.decode(spelling, line);
        let name = without_xref(&decoded);
        let record = self.table.get(&folded(decoded.trim()));
        self.used.push(UsedLayer {
            name: name.into(),
            folded: folded(name).into(),
            is_kept: (self.keep)(name),
            line_type: record.map_or(CONTINUOUS, |record| &record.line_type).into(),
            hidden: record.is_some_and(|record| record.hidden),
        });
        let id = LayerId(u32::try_from(self.used.len() - 1).unwrap_or(u32::MAX));
        self.by_spelling.insert(spelling, id);
        id
    }
}

/// A line type's name as it is compared: trimmed, without xref prefix, upper case.
pub(crate) fn line_type_name(name: &str) -> Box<str> {
    folded(without_xref(name)).into()
}
