//! Drawings under construction, and finished ones.

use std::collections::BTreeSet;
use std::sync::Arc;

use pathbuild_diagnostic::Handle;

use super::model::{Block, DrawError, Entity, Layer, NoteKind, Options, Shape, Template, Version};
use super::text_positions::{candidates, position_notes};

/// A drawing under construction, in which parameter texts have no positions yet.
#[derive(Clone, Debug)]
pub struct Draft {
    /// Options for writing the drawing.
    pub options: Options,
    /// The layer table. Layers that entities use and that are missing here are added.
    pub layers: Vec<Layer>,
    /// Line types beyond the usual ones: name and pattern in mm (dashes positive, gaps negative, dots 0).
    pub line_types: Vec<(String, Vec<f64>)>,
    /// The block definitions.
    pub blocks: Vec<Block>,
    /// The entities of model and paper space, in file order.
    pub entities: Vec<Entity>,
    current_layer: String,
}

impl Default for Draft {
    fn default() -> Self {
        Self {
            options: Options::default(),
            layers: vec![Layer::new("0")],
            line_types: Vec::new(),
            blocks: Vec::new(),
            entities: Vec::new(),
            current_layer: "0".to_owned(),
        }
    }
}

impl Draft {
    /// Creates an empty drawing with layer 0.
    pub fn new() -> Self {
        Self::default()
    }

    /// Switches to a layer and adds it to the layer table.
    pub fn layer(&mut self, name: &str) -> &mut Self {
        name.clone_into(&mut self.current_layer);
        if !self.layers.iter().any(|layer| layer.name == name) {
            self.layers.push(Layer::new(name));
        }
        self
    }

    /// The layer of entities that do not name one.
    pub fn current_layer(&self) -> &str {
        &self.current_layer
    }

    /// Adds an entity.
    pub fn add(&mut self, mut entity: Entity) -> &mut Self {
        entity.layer.get_or_insert_with(|| self.current_layer.clone());
        self.entities.push(entity);
        self
    }

    /// Adds several entities.
    pub fn extend(&mut self, entities: impl IntoIterator<Item = Entity>) -> &mut Self {
        for entity in entities {
            self.add(entity);
        }
        self
    }

    /// Positions the texts and assigns handles.
    ///
    /// # Errors
    /// Fails if an entity does not exist in the chosen version, a block is unknown, or there is no room for a text.
    pub fn finish(mut self) -> Result<Sheet, Vec<DrawError>> {
        let mut errors = Vec::new();
        for entity in self.blocks.iter().flat_map(|block| &block.entities).chain(&self.entities) {
            errors.extend(self.fault(entity));
        }
        let found = candidates(&self.entities, &self.blocks, &self.layers);
        self.entities = position_notes(self.entities, &found, &self.options, &mut errors);
        let blocks = self.blocks.clone();
        for block in &mut self.blocks {
            let found = candidates(&block.entities, &blocks, &self.layers);
            let entities = std::mem::take(&mut block.entities);
            block.entities = position_notes(entities, &found, &self.options, &mut errors);
        }
        if errors.is_empty() { Ok(Sheet::new(self)) } else { Err(errors) }
    }

    fn fault(&self, entity: &Entity) -> Option<DrawError> {
        let version = self.options.version;
        let needs = |least: Version, what: &str, instead: &str| {
            let name = version.name();
            (version < least)
                .then(|| format!("{what} does not exist in {name}: {instead}, or `version R2000`"))
        };
        let is_mtext = entity.note.as_ref().is_some_and(|note| note.kind == Some(NoteKind::MText));
        let message = match &entity.shape {
            Shape::MText(_) => needs(Version::R13, "MTEXT", "write `text`"),
            Shape::Ellipse(_) => needs(Version::R13, "ELLIPSE", "draw arcs"),
            Shape::Spline(_) => needs(Version::R13, "SPLINE", "draw arcs"),
            Shape::Insert(insert) => {
                let known = self.blocks.iter().any(|block| block.name.eq_ignore_ascii_case(&insert.block));
                (!known).then(|| format!("there is no block {:?} in this drawing", insert.block))
            }
            _ if entity.paper => needs(Version::R12, "paper space", "leave it out"),
            _ if is_mtext => needs(Version::R13, "MTEXT", "write `as text`"),
            _ => None,
        };
        message.map(|message| DrawError::new(entity.line, 0, message))
    }
}

/// A finished drawing, in which every text has a position and every entity a handle. Its DXF output is deterministic.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    options: Options,
    layers: Vec<Layer>,
    line_types: Vec<(String, Vec<f64>)>,
    blocks: Vec<Block>,
    entities: Vec<Entity>,
    /// The template with entities to write before and after those of the sheet, and how many of its last entities to omit.
    template: Option<(Arc<Template>, usize)>,
    next_handle: u64,
}

/// First handle of an entity. The handles of tables and objects follow those of the entities.
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
        sheet.assign_handles();
        sheet
    }

    fn assign_handles(&mut self) {
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

    /// The block definitions.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The entities in file order, without the template. Each text follows the element it belongs to.
    pub fn entities(&self) -> &[Entity] {
        &self.entities
    }

    /// Returns the handles of the entities drawn by a line of the text form; each element's handle is followed by the handle of its text.
    pub fn handles_of_line(&self, line: u32) -> impl Iterator<Item = Handle> + '_ {
        self.entities.iter().filter(move |entity| entity.line == line).filter_map(|entity| entity.handle)
    }

    /// Adds a template's entities before and after those of the sheet, without the template's last `left_out` entities. They do not appear in
    /// [`Sheet::entities`], but the template's layers must be among the sheet's.
    pub fn within(self, template: Arc<Template>, left_out: usize) -> Self {
        Self { template: Some((template, left_out)), ..self }
    }

    pub(crate) fn template(&self) -> Option<(&Template, usize)> {
        self.template.as_ref().map(|(template, left_out)| (&**template, *left_out))
    }

    /// Returns the entities in the order of their tags: those of the drawing, then those of the blocks.
    pub(crate) fn tagged(&self) -> Vec<&Entity> {
        self.entities.iter().chain(self.blocks.iter().flat_map(|block| &block.entities)).collect()
    }

    /// Returns the first handle after those of all entities.
    pub(crate) fn next_handle(&self) -> u64 {
        self.next_handle
    }
}
