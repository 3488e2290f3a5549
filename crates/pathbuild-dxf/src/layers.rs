//! The layers of entities. (book: reference/dxf; book: language/layers-and-names)
//!
//! Each spelling of a name is evaluated once per file; entities hold its index.

use std::borrow::Cow;

use smol_str::SmolStr;

use crate::encoding::Decoder;
use crate::layer_records::Reading;
use crate::layer_table::{LayerRecord, LayerTable};
use crate::line_types::CONTINUOUS;
use crate::names::{folded, is_same, without_xref};
use crate::pairs::Stop;
use crate::spellings::Spellings;

/// Index of a spelling of a layer's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct LayerId(u32);

/// The layers that entities have used so far.
pub(crate) struct Layers<'a, 'o> {
    /// The LAYER table of the drawing.
    table: LayerTable<'a>,
    keep: &'o dyn Fn(&str) -> bool,
    by_spelling: Spellings<'a, LayerId>,
    found: Vec<FoundLayer<'a>>,
    last: Option<(&'a [u8], LayerId)>,
}

/// A layer that some entity uses, wanted or not.
struct FoundLayer<'a> {
    /// The decoded spelling.
    full_name: Cow<'a, str>,
    is_kept: bool,
    /// Whether it is layer `0`.
    is_inheriting: bool,
    used: Option<Box<UsedLayer>>,
}

/// A layer that a wanted entity uses.
#[derive(Clone, Debug)]
pub(crate) struct UsedLayer {
    /// The name: trimmed, decoded, without xref prefix.
    pub(crate) name: SmolStr,
    /// The name folded for comparison.
    pub(crate) folded: SmolStr,
    /// The line type in upper case.
    pub(crate) line_type: SmolStr,
    /// Whether the layer is frozen or off.
    pub(crate) hidden: bool,
}

/// Number of layers to reserve room for.
const USUAL: usize = 16;

impl<'a, 'o> Layers<'a, 'o> {
    /// Starts without layers.
    pub(crate) fn new(keep: &'o dyn Fn(&str) -> bool, table: LayerTable<'a>) -> Self {
        let by_spelling = Spellings::default();
        Self { table, keep, by_spelling, found: Vec::with_capacity(USUAL), last: None }
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
            && is_same(last, spelling)
        {
            return id;
        }
        let known = self.by_spelling.get(spelling);
        let id = known.unwrap_or_else(|| self.first_use(spelling, line(), decoder));
        self.last = Some((spelling, id));
        id
    }

    /// The spelling that was looked up last.
    pub(crate) fn last_spelling(&self) -> &'a [u8] {
        self.last.map_or(b"", |(spelling, _)| spelling)
    }

    /// The properties of a wanted layer.
    #[inline]
    pub(crate) fn used(
        &mut self,
        id: LayerId,
        reading: &mut Reading<'_, 'a, '_>,
    ) -> Result<&UsedLayer, Stop<'a>> {
        let FoundLayer { full_name, used, .. } = &mut self.found[id.0 as usize];
        match used {
            Some(used) => Ok(used),
            None => Ok(used.insert(Box::new(UsedLayer::look_up(full_name, &mut self.table, reading)?))),
        }
    }

    /// Whether entities on the layer are wanted.
    #[inline]
    pub(crate) fn is_kept(&self, id: LayerId) -> bool {
        self.found(id).is_kept
    }

    /// The effective layer of an entity in an inserted block: that of the insertion if the entity is on layer `0`.
    pub(crate) fn inherited(&self, layer: LayerId, of_insert: LayerId) -> LayerId {
        if self.is_inheriting(layer) { of_insert } else { layer }
    }

    /// Whether it is layer `0`.
    #[inline]
    pub(crate) fn is_inheriting(&self, layer: LayerId) -> bool {
        self.found(layer).is_inheriting
    }

    #[inline]
    fn found(&self, id: LayerId) -> &FoundLayer<'a> {
        &self.found[id.0 as usize]
    }

    fn first_use(&mut self, spelling: &'a [u8], line: u32, decoder: &mut Decoder<'_>) -> LayerId {
        let full_name = decoder.decode(spelling, line);
        let name = without_xref(&full_name);
        let (is_kept, is_inheriting) = ((self.keep)(name), name == "0");
        let id = LayerId(u32::try_from(self.found.len()).unwrap_or(u32::MAX));
        self.found.push(FoundLayer { full_name, is_kept, is_inheriting, used: None });
        self.by_spelling.insert(spelling, id);
        id
    }
}

impl UsedLayer {
    #[cold]
    fn look_up<'a>(
        full_name: &str,
        table: &mut LayerTable<'a>,
        reading: &mut Reading<'_, 'a, '_>,
    ) -> Result<Self, Stop<'a>> {
        let record = table.find(full_name, reading)?;
        let name = without_xref(full_name);
        let line_type = record.as_ref().and_then(LayerRecord::line_type);
        Ok(Self {
            name: name.into(),
            folded: folded(name),
            line_type: line_type.unwrap_or(CONTINUOUS),
            hidden: record.as_ref().is_some_and(LayerRecord::is_hidden),
        })
    }
}
