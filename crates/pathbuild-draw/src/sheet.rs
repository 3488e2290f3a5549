use std::collections::BTreeSet;
use std::sync::Arc;

use pathbuild_diagnostic::Handle;

use crate::draft::{Block, Draft};
use crate::model::{Entity, Layer, Options};
use crate::write::{self, Template};

/// A finished drawing: every text has its place, every entity its handle. It can be written as DXF, always as the same bytes.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    options: Options,
    layers: Vec<Layer>,
    line_types: Vec<(String, Vec<f64>)>,
    blocks: Vec<Block>,
    entities: Vec<Entity>,
    /// What stands around it, and how many of the template's last entities are left out.
    template: Option<(Arc<Template>, usize)>,
    next_handle: u64,
}

/// The handles of entities begin here; those of tables and objects come after the last entity.
const FIRST_HANDLE: u64 = 0x100;

impl Sheet {
    pub(crate) fn new(draft: Draft) -> Self {
        let Draft { options, mut layers, line_types, blocks, entities, .. } = draft;
        let inner = blocks.iter().flat_map(|block| &block.entities);
        for name in entities.iter().chain(inner).filter_map(|entity| entity.layer.as_deref()) {
            if !layers.iter().any(|layer| layer.name.eq_ignore_ascii_case(name)) {
                layers.push(Layer::new(name));
            }
        }
        let mut sheet =
            Self { options, layers, line_types, blocks, entities, template: None, next_handle: FIRST_HANDLE };
        sheet.allot_handles();
        sheet
    }

    fn allot_handles(&mut self) {
        let inner = self.blocks.iter_mut().flat_map(|block| &mut block.entities);
        let entities: Vec<&mut Entity> = self.entities.iter_mut().chain(inner).collect();
        let own: BTreeSet<Handle> = entities.iter().filter_map(|entity| entity.handle).collect();
        let mut free = (FIRST_HANDLE..).map(Handle).filter(|handle| !own.contains(handle));
        for entity in entities {
            if entity.handle.is_none() {
                entity.handle = free.next();
            }
        }
        let highest = own.last().map_or(0, |handle| handle.0.saturating_add(1));
        self.next_handle = free.next().map_or(highest, |handle| handle.0.max(highest));
    }

    /// How it is written.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The layer table.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Line types beside the usual ones.
    pub fn line_types(&self) -> &[(String, Vec<f64>)] {
        &self.line_types
    }

    /// The blocks.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The entities in file order, texts behind the elements that they belong to; without the template.
    pub fn entities(&self) -> &[Entity] {
        &self.entities
    }

    /// The handles of what a line of the text form draws: the elements' first, each followed by its text's.
    pub fn handles_of_line(&self, line: u32) -> impl Iterator<Item = Handle> + '_ {
        self.entities.iter().filter(move |entity| entity.line == line).filter_map(|entity| entity.handle)
    }

    /// With a template around it, but for so many of the template's last entities. What is in a template is no part of
    /// [`Sheet::entities`]; its layers are to be among the sheet's.
    pub fn within(self, template: Arc<Template>, left_out: usize) -> Self {
        Self { template: Some((template, left_out)), ..self }
    }

    pub(crate) fn template(&self) -> Option<(&Template, usize)> {
        self.template.as_ref().map(|(template, left_out)| (&**template, *left_out))
    }

    /// The entities in the order in which the writer counts them: those of the drawing, then those of the blocks.
    pub(crate) fn tagged(&self) -> Vec<&Entity> {
        self.entities.iter().chain(self.blocks.iter().flat_map(|block| &block.entities)).collect()
    }

    /// The first handle behind all entities'.
    pub(crate) fn next_handle(&self) -> u64 {
        self.next_handle
    }

    /// The drawing as DXF, ASCII or binary as the options say.
    pub fn to_dxf(&self) -> Vec<u8> {
        if self.options.binary { self.to_binary_dxf() } else { write::ascii(self) }
    }

    /// The drawing as binary DXF.
    pub fn to_binary_dxf(&self) -> Vec<u8> {
        write::binary(self)
    }
}
