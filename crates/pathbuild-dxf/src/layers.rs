//! The layers and line types of entities. (book: reference/dxf; book: language/layers-and-names; book: language/line-types)
//!
//! Each spelling of a name is evaluated once per file; entities hold its index.

use std::borrow::Cow;
use std::collections::HashMap;

use memchr::memchr;
use memchr::memmem::Finder;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing::LAYER_TWICE;
use smol_str::SmolStr;

use crate::encoding::Decoder;
use crate::faults::{EntityError, bad_value_error};
use crate::fields::{Fields, FillDecision, Value};
use crate::groups::Records;
use crate::names::{Spellings, case_folded, without_xref};
use crate::number::{real, whole_number};
use crate::pairs::{LAYER, Pair, Pairs, Stop};

/// Index of a spelling of a layer's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct LayerId(u32);

/// The layers of the entities read so far.
pub(crate) struct Layers<'a, 'o> {
    table: LayerTable<'a>,
    keep: &'o dyn Fn(&str) -> bool,
    by_spelling: Spellings<'a, LayerId>,
    found: Vec<LayerSpelling<'a>>,
    last: Option<(&'a [u8], LayerId)>,
}

/// A spelling of a layer's name that some entity uses, whether the layer is wanted or not.
struct LayerSpelling<'a> {
    /// The decoded spelling of the name.
    full_name: Cow<'a, str>,
    is_kept: bool,
    /// Whether the layer is layer `0`, which inside a block stands for the layer of the insertion.
    is_layer_zero: bool,
    used: Option<Box<LayerProperties>>,
}

/// The properties of a layer, looked up at the first entity that needs them.
#[derive(Clone, Debug)]
pub(crate) struct LayerProperties {
    /// The name: trimmed, decoded, without xref prefix.
    pub(crate) name: SmolStr,
    /// The name folded for comparison.
    pub(crate) folded: SmolStr,
    /// The line type in upper case.
    pub(crate) line_type: SmolStr,
    /// Whether the layer is frozen or off.
    pub(crate) hidden: bool,
    /// Whether the layer is frozen, so that blocks inserted on it are invisible as a whole.
    pub(crate) is_frozen: bool,
    /// The error of the layer's entities if its records do not tell their line type or visibility.
    fault: Option<Box<Diagnostic>>,
}

/// Number of layers for which memory is reserved in advance.
const RESERVED_LAYERS: usize = 16;

impl<'a, 'o> Layers<'a, 'o> {
    pub(crate) fn new(keep: &'o dyn Fn(&str) -> bool, table: LayerTable<'a>) -> Self {
        let by_spelling = Spellings::default();
        Self { table, keep, by_spelling, found: Vec::with_capacity(RESERVED_LAYERS), last: None }
    }

    /// Returns the layer with this spelling. `line` is called only for new spellings.
    #[inline]
    pub(crate) fn id(
        &mut self,
        spelling: &'a [u8],
        line: impl FnOnce() -> u32,
        decoder: &mut Decoder<'_>,
    ) -> LayerId {
        if let Some((last, id)) = self.last
            && last == spelling
        {
            return id;
        }
        let known = self.by_spelling.get(spelling);
        let id = known.unwrap_or_else(|| self.first_use(spelling, line(), decoder));
        self.last = Some((spelling, id));
        id
    }

    pub(crate) fn last_spelling(&self) -> &'a [u8] {
        self.last.map_or(b"", |(spelling, _)| spelling)
    }

    /// Returns the properties of a layer, which are looked up only once.
    #[inline]
    pub(crate) fn properties(
        &mut self,
        id: LayerId,
        reading: &mut LayerTableReader<'_, 'a, '_>,
    ) -> Result<&LayerProperties, Stop<'a>> {
        let LayerSpelling { full_name, used, .. } = &mut self.found[id.0 as usize];
        match used {
            Some(used) => Ok(used),
            None => Ok(used.insert(Box::new(LayerProperties::look_up(full_name, &mut self.table, reading)?))),
        }
    }

    /// Whether entities on the layer are wanted.
    #[inline]
    pub(crate) fn is_kept(&self, id: LayerId) -> bool {
        self.spelling(id).is_kept
    }

    /// Returns the name of a layer: trimmed, decoded, without xref prefix.
    pub(crate) fn name(&self, id: LayerId) -> &str {
        without_xref(&self.spelling(id).full_name)
    }

    /// Returns the effective layer of an entity in an inserted block: that of the insertion if the entity is on layer `0`.
    pub(crate) fn effective_layer(&self, layer: LayerId, of_insert: LayerId) -> LayerId {
        if self.is_layer_zero(layer) { of_insert } else { layer }
    }

    /// Whether a layer is layer `0`.
    #[inline]
    pub(crate) fn is_layer_zero(&self, layer: LayerId) -> bool {
        self.spelling(layer).is_layer_zero
    }

    #[inline]
    fn spelling(&self, id: LayerId) -> &LayerSpelling<'a> {
        &self.found[id.0 as usize]
    }

    fn first_use(&mut self, spelling: &'a [u8], line: u32, decoder: &mut Decoder<'_>) -> LayerId {
        let full_name = decoder.decode(spelling, line);
        let name = without_xref(&full_name);
        let (is_kept, is_layer_zero) = ((self.keep)(name), name == "0");
        let id = LayerId(u32::try_from(self.found.len()).unwrap_or(u32::MAX));
        self.found.push(LayerSpelling { full_name, is_kept, is_layer_zero, used: None });
        self.by_spelling.insert(spelling, id);
        id
    }
}

impl LayerProperties {
    #[cold]
    fn look_up<'a>(
        full_name: &str,
        table: &mut LayerTable<'a>,
        reading: &mut LayerTableReader<'_, 'a, '_>,
    ) -> Result<Self, Stop<'a>> {
        let record = table.find(full_name, reading)?.unwrap_or_default();
        let name = without_xref(full_name);
        Ok(Self {
            name: name.into(),
            folded: case_folded(name),
            line_type: record.line_type(),
            hidden: record.is_hidden(),
            is_frozen: record.is_frozen(),
            fault: record.fault(name).map(Box::new),
        })
    }

    /// Returns the error of the layer's entities if its records do not tell their line type or visibility.
    pub(crate) fn fault<'a>(&self) -> Option<EntityError<'a>> {
        self.fault.clone().map(EntityError::Layer)
    }
}

/// The LAYER table. Layers are searched one by one while that is cheaper than reading all records.
#[derive(Debug, Default)]
pub(crate) struct LayerTable<'a> {
    tables: Option<Pairs<'a>>,
    lookups: usize,
    /// All layers, once searching them one by one no longer pays.
    all: Option<LayersByName<'a>>,
}

/// Layers by folded name. Few are ever looked up, so their values are parsed on demand.
#[derive(Debug, Default)]
struct LayersByName<'a> {
    records: HashMap<SmolStr, LayerRecord<'a>>,
    /// Layers with an external-reference prefix, by the rest of their names.
    referenced: HashMap<SmolStr, LayerRecord<'a>>,
}

/// A record of the LAYER table. CAD programs disagree on which of several records with the same name counts, and on whether case matters, so records
/// that contradict each other are reported.
#[derive(Clone, Debug, Default)]
pub(crate) struct LayerRecord<'a> {
    line: u32,
    line_type: Option<Cow<'a, [u8]>>,
    colour: Option<Value<'a>>,
    flags: Option<Value<'a>>,
    /// Line of the first further record with this name and other properties.
    contradiction: Option<u32>,
}

/// Maximum number of layers that are looked up one by one in the tables; most drawings of paths have no more.
const MAX_SINGLE_LOOKUPS: usize = 4;

/// Minimum length in bytes of a text to search for: shorter texts occur nearly everywhere, so searching for them does not pay.
const MIN_SEARCHED_BYTES: usize = 4;

impl<'a> LayerTable<'a> {
    pub(crate) fn new(tables: Option<Pairs<'a>>) -> Self {
        Self { tables, ..Self::default() }
    }

    /// Finds the record of a layer by its full name, else by the name without external-reference prefix.
    pub(crate) fn find(
        &mut self,
        full_name: &str,
        reading: &mut LayerTableReader<'_, 'a, '_>,
    ) -> Result<Option<LayerRecord<'a>>, Stop<'a>> {
        let Some(tables) = self.tables else { return Ok(None) };
        self.lookups += 1;
        let certain = case_independent_part(without_xref(full_name).as_bytes());
        let has_escapes = || memchr(b'\\', &tables.bytes()[tables.consumed()..]).is_some();
        if self.all.is_none()
            && self.lookups <= MAX_SINGLE_LOOKUPS
            && certain.len() >= MIN_SEARCHED_BYTES
            && !has_escapes()
        {
            let mut some = LayersByName::default();
            let end = reading.read_with(tables, certain, &mut some);
            // Damage that follows the layer's own record concerns other layers.
            if !some.records.contains_key(&case_folded(full_name)) {
                end?;
            }
            return Ok(some.get(full_name).cloned());
        }
        let all = match &mut self.all {
            Some(all) => all,
            all => all.insert(reading.read_all(tables)?),
        };
        Ok(all.get(full_name).cloned())
    }
}

/// Returns the longest part of a name that is the same in any case and code page: ASCII characters other than letters and backslashes.
fn case_independent_part(name: &[u8]) -> &[u8] {
    let is_uncertain = |byte: &u8| !byte.is_ascii() || byte.is_ascii_alphabetic() || *byte == b'\\';
    name.split(is_uncertain).max_by_key(|part| part.len()).unwrap_or_default()
}

impl<'a> LayersByName<'a> {
    /// Adds a record from its groups, unless it has no name.
    fn add(&mut self, groups: &Fields<'a>, decoder: &mut Decoder<'_>) {
        let Some(name) = groups.get(2) else { return };
        let folded = case_folded(&decoder.decode(name.bytes, name.line));
        let line_type = groups.get(6).map(|name| decoder.decode_bytes(name.bytes, name.line));
        let record = LayerRecord {
            line: name.line,
            line_type,
            colour: groups.get(62),
            flags: groups.get(70),
            contradiction: None,
        };
        let behind_prefix = without_xref(&folded);
        if behind_prefix.len() < folded.len() {
            let known = self.referenced.entry(behind_prefix.into()).or_insert_with(|| record.clone());
            known.compare(&record);
        }
        self.records.entry(folded).or_insert_with(|| record.clone()).compare(&record);
    }

    /// Finds a record by its full name, else by the name without external-reference prefix.
    fn get(&self, full_name: &str) -> Option<&LayerRecord<'a>> {
        let find = |name: &str| {
            let name = case_folded(name);
            self.records.get(&name).or_else(|| self.referenced.get(&name))
        };
        find(full_name).or_else(|| find(without_xref(full_name)))
    }
}

impl LayerRecord<'_> {
    /// Notes a further record with the same name if its properties differ.
    fn compare(&mut self, other: &Self) {
        let properties = |record: &Self| (record.line_type(), record.is_hidden(), record.is_frozen());
        if self.line != other.line && self.contradiction.is_none() && properties(self) != properties(other) {
            self.contradiction = Some(other.line);
        }
    }

    /// Returns the first broken number, or else the contradiction between this record and another one of the layer.
    fn fault(&self, layer: &str) -> Option<Diagnostic> {
        let colour = self.colour.and_then(|value| Some((62, value, real(value.bytes).err()?)));
        let flags = self.flags.and_then(|value| Some((70, value, whole_number(value.bytes).err()?)));
        if let Some((code, value, reason)) = colour.or(flags) {
            let line = value.line.saturating_add(1);
            return Some(bad_value_error("LAYER", code, value.bytes, reason).at_line(line, None));
        }
        Some(Diagnostic::new(&LAYER_TWICE).quoting("layer", layer).at_line(self.contradiction?, None))
    }

    /// Returns the line type in upper case.
    fn line_type(&self) -> SmolStr {
        let name = self.line_type.as_deref().map(|name| line_type_name(&String::from_utf8_lossy(name)));
        name.filter(|name| !name.is_empty()).unwrap_or(CONTINUOUS)
    }

    /// Whether the layer is frozen or off.
    fn is_hidden(&self) -> bool {
        let is_off = self.colour.is_some_and(|colour| real(colour.bytes).is_ok_and(|number| number < 0.0));
        is_off || self.is_frozen()
    }

    fn is_frozen(&self) -> bool {
        self.flags.is_some_and(|flags| whole_number(flags.bytes).is_ok_and(|bits| bits & 1 != 0))
    }
}

/// The state needed to read records of the LAYER table.
pub(crate) struct LayerTableReader<'r, 'a, 'd> {
    pub(crate) fields: &'r mut Fields<'a>,
    pub(crate) decoder: &'r mut Decoder<'d>,
}

impl<'a> LayerTableReader<'_, 'a, '_> {
    fn read_all(&mut self, mut tables: Pairs<'a>) -> Result<LayersByName<'a>, Stop<'a>> {
        let mut layers = LayersByName::default();
        while let Some(head) = tables.find_pair("0", &LAYER) {
            tables.jump_to(head);
            let mut records = Records::new(tables)?;
            while !is_end_of_table(&records.head) {
                self.record(&mut records, &mut layers)?;
            }
            tables = records.groups.pairs();
        }
        Ok(layers)
    }

    /// Reads at least the records that contain the bytes `written`. From a match on, the table is read pair by pair from the start of the record, so
    /// that no broken record is overlooked.
    fn read_with(
        &mut self,
        mut tables: Pairs<'a>,
        written: &[u8],
        layers: &mut LayersByName<'a>,
    ) -> Result<(), Stop<'a>> {
        let mut records = None;
        let begin = tables.consumed();
        for at in Finder::new(written).find_iter(&tables.bytes()[begin..]).map(|at| begin + at) {
            let last = tables.find_last_pair("0", "LAYER", at);
            // Everything before the first record is skipped at once.
            let head = if records.is_none() { last.or_else(|| tables.find_pair("0", &LAYER)) } else { last };
            if let Some(head) = head {
                tables.jump_to(head);
                records = Some(Records::new(tables)?);
            }
            let Some(row) = &mut records else { break };
            while row.groups.pairs().consumed() <= at && !is_end_of_table(&row.head) {
                self.record(row, layers)?;
            }
            tables = row.groups.pairs();
            records = records.filter(|row| !is_end_of_table(&row.head));
        }
        Ok(())
    }

    /// Reads the head record if it is a LAYER.
    fn record(&mut self, records: &mut Records<'a>, layers: &mut LayersByName<'a>) -> Result<(), Stop<'a>> {
        let is_layer = records.head.is("LAYER");
        (records.head, _) =
            self.fields.fill(&mut records.groups, records.head.line, 0, |_| FillDecision::Keep)?;
        if is_layer {
            layers.add(self.fields, self.decoder);
        }
        Ok(())
    }
}

/// Whether the table ends here. A record with a damaged start does not end the table, so that the damage is reported.
fn is_end_of_table(head: &Pair<'_>) -> bool {
    ["ENDTAB", "TABLE", "ENDSEC"].iter().any(|keyword| head.is(keyword))
}

/// The line type of layers that name none, and of BYBLOCK outside of blocks.
pub(crate) const CONTINUOUS: SmolStr = SmolStr::new_static("CONTINUOUS");

/// The line type of an entity as the file states it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineType {
    /// The line type of the entity's layer, which also applies if the entity names none.
    ByLayer,
    /// The line type of the INSERT that places the entity's block.
    ByBlock,
    /// Index of a name in [`LineTypes`].
    Named(u32),
}

/// Number of line types for which memory is reserved in advance.
const USUAL_LINE_TYPES: usize = 8;

/// The names of line types that entities use.
#[derive(Debug)]
pub(crate) struct LineTypes<'a> {
    by_spelling: Spellings<'a, LineType>,
    names: Vec<SmolStr>,
    pub(crate) continuous: SmolStr,
}

impl Default for LineTypes<'_> {
    fn default() -> Self {
        Self {
            by_spelling: Spellings::default(),
            names: Vec::with_capacity(USUAL_LINE_TYPES),
            continuous: CONTINUOUS,
        }
    }
}

impl<'a> LineTypes<'a> {
    /// Returns the line type for this value of group 6.
    #[inline]
    pub(crate) fn get(&mut self, value: Option<Value<'a>>, decoder: &mut Decoder<'_>) -> LineType {
        let Some(value) = value else { return LineType::ByLayer };
        self.by_spelling.get(value.bytes).unwrap_or_else(|| self.first_use(value, decoder))
    }

    /// Returns the name with this index: upper case, without xref prefix.
    pub(crate) fn name(&self, number: u32) -> &SmolStr {
        &self.names[number as usize]
    }

    fn first_use(&mut self, value: Value<'a>, decoder: &mut Decoder<'_>) -> LineType {
        let name = line_type_name(&decoder.decode(value.bytes, value.line));
        let line_type = match &*name {
            "" | "BYLAYER" => LineType::ByLayer,
            "BYBLOCK" => LineType::ByBlock,
            _ => {
                self.names.push(name);
                LineType::Named(u32::try_from(self.names.len() - 1).unwrap_or(u32::MAX))
            }
        };
        self.by_spelling.insert(value.bytes, line_type);
        line_type
    }
}

/// Folds the name of a line type for comparison: trimmed, without xref prefix, upper case.
fn line_type_name(name: &str) -> SmolStr {
    case_folded(without_xref(name))
}
