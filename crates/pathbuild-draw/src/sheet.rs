use std::collections::BTreeSet;
use std::sync::Arc;

use pathbuild_diagnostic::Handle;

use crate::draft::{Block, Draft};
use crate::model::{Entity, Layer, Options};
use crate::write::{self, Template};

/// A finished drawing, in which every text has a position and every entity a handle. Its DXF output is deterministic.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    options: Options,
    layers: Vec<Layer>,
    line_types: Vec<(String, Vec<f64>)>,
    blocks: Vec<Block>,
    entities: Vec<Entity>,
    /// The surrounding template, and how many of its last entities to omit.
    template: Option<(Arc<Template>, usize)>,
    next_handle: u64,
}

/// First handle of entities; those of tables and objects follow the last entity.
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

    /// The options for writing.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The layer table.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Line types beyond the usual ones.
    pub fn line_types(&self) -> &[(String, Vec<f64>)] {
        &self.line_types
    }

    /// The blocks.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The entities in file order, without the template. Each text follows the element it belongs to.
    pub fn entities(&self) -> &[Entity] {
        &self.entities
    }

    /// The handles of the entities drawn by a line of the text form; each element's handle is followed by that of its text.
    pub fn handles_of_line(&self, line: u32) -> impl Iterator<Item = Handle> + '_ {
        self.entities.iter().filter(move |entity| entity.line == line).filter_map(|entity| entity.handle)
    }

    /// Surrounds the sheet with a template, except for the template's last `left_out` entities. The template's content does not appear in
    /// [`Sheet::entities`], but its layers must be among the sheet's.
    pub fn within(self, template: Arc<Template>, left_out: usize) -> Self {
        Self { template: Some((template, left_out)), ..self }
    }

    pub(crate) fn template(&self) -> Option<(&Template, usize)> {
        self.template.as_ref().map(|(template, left_out)| (&**template, *left_out))
    }

    /// The entities in the order of their tags: those of the drawing, then those of the blocks.
    pub(crate) fn tagged(&self) -> Vec<&Entity> {
        self.entities.iter().chain(self.blocks.iter().flat_map(|block| &block.entities)).collect()
    }

    /// The first handle after those of all entities.
    pub(crate) fn next_handle(&self) -> u64 {
        self.next_handle
    }

    /// Writes the drawing as DXF, ASCII or binary according to the options.
    pub fn to_dxf(&self) -> Vec<u8> {
        if self.options.binary { self.to_binary_dxf() } else { write::ascii(self) }
    }

    /// Writes the drawing as binary DXF.
    pub fn to_binary_dxf(&self) -> Vec<u8> {
        write::binary(self)
    }
}
