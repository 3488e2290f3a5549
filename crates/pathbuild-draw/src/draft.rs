use crate::error::DrawError;
use crate::model::{Entity, Layer, NoteKind, Options, Point, Shape, Version};
use crate::place::{candidates, seat_notes};
use crate::sheet::Sheet;

/// A drawing under construction, in which parameter texts have no positions yet.
#[derive(Clone, Debug)]
pub struct Draft {
    /// How the drawing will be written.
    pub options: Options,
    /// The layer table. Layers that entities use and that are missing here are added.
    pub layers: Vec<Layer>,
    /// Line types beyond the usual ones: name and pattern in mm (dashes positive, gaps negative, dots 0).
    pub line_types: Vec<(String, Vec<f64>)>,
    /// The blocks.
    pub blocks: Vec<Block>,
    /// Model and paper space, in file order.
    pub entities: Vec<Entity>,
    current_layer: String,
}

/// A block definition.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// The block's name.
    pub name: String,
    /// The block's base point.
    pub base: Point,
    /// The block's entities.
    pub entities: Vec<Entity>,
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
    /// An empty drawing with layer 0.
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
    /// Fails if an entity does not exist in the chosen version, a block is unknown, or a text has no room.
    pub fn finish(mut self) -> Result<Sheet, Vec<DrawError>> {
        let mut errors = Vec::new();
        for entity in self.blocks.iter().flat_map(|block| &block.entities).chain(&self.entities) {
            errors.extend(self.fault(entity));
        }
        let found = candidates(&self.entities, &self.blocks, &self.layers);
        self.entities = seat_notes(self.entities, &found, &self.options, &mut errors);
        let blocks = self.blocks.clone();
        for block in &mut self.blocks {
            let found = candidates(&block.entities, &blocks, &self.layers);
            let entities = std::mem::take(&mut block.entities);
            block.entities = seat_notes(entities, &found, &self.options, &mut errors);
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
