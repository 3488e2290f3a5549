//! The LAYER table: the line types of layers, and which of them are frozen or off. (spec/10-drawing.md)

use std::borrow::Cow;
use std::cell::OnceCell;

use smol_str::SmolStr;

use crate::by_name::ByName;
use crate::encoding::Decoder;
use crate::fields::Fields;
use crate::line_types::line_type_name;
use crate::names::{Name, without_xref};
use crate::number::{real, whole};

/// The LAYER table. Hardly any of a drawing's layers is ever looked for, so what is said of them is looked at then.
#[derive(Debug, Default)]
pub(crate) struct LayerTable<'a> {
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

/// How many layers a drawing usually has at most.
const USUAL: usize = 16;

impl<'a> LayerTable<'a> {
    /// A table without layers.
    pub(crate) fn new() -> Self {
        Self { records: ByName::with_capacity(USUAL), referenced: OnceCell::new() }
    }

    /// Adds the record that these are the groups of, unless it has no name.
    pub(crate) fn add(&mut self, groups: &Fields<'a>, decoder: &mut Decoder<'_>) {
        let Some(name) = groups.get(2) else { return };
        let name = Name::decoded(name.bytes, name.line, decoder);
        let bytes = |code: i32| groups.get(code).map(|value| value.bytes);
        let line_type = groups.get(6).map(|it| decoder.decode_bytes(it.bytes, it.line));
        self.records.push(name, LayerRecord { line_type, colour: bytes(62), flags: bytes(70) });
    }

    /// The record of a layer by its whole name, or else by that without the prefix of an external reference.
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
