//! Model space: the entities of ENTITIES with insertions replaced by the contents of their blocks.

#![expect(
    clippy::inline_always,
    reason = "an entity is made where it ends up, without copies from function to function"
)]

use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

use pathbuild_diagnostic::messages::drawing::{BLOCK_ELSEWHERE, BLOCK_MISSING, INSERT_CLIPPED};
use pathbuild_diagnostic::{Handle, Message, Point};
use smol_str::SmolStr;

use crate::Origin;
use crate::block_prefilter::may_have_wanted_entities;
use crate::blocks::{BlockId, Blocks, StepBudget};
use crate::clips::clipping_dictionaries;
use crate::collect::{Collector, PlacedEntity};
use crate::entities::{CommonProperties, EntityReader, Item, Shape, Space};
use crate::faults::{EntityError, FatalError, stop_error};
use crate::groups::Records;
use crate::layers::{LayerId, LayerTableReader, LineType};
use crate::pairs::Pairs;
use crate::placement::Placement;
use crate::shapes::{Array, Insert};

/// A reader of a drawing's model space.
pub(crate) struct Model<'r, 'a, 'o> {
    reader: &'r mut EntityReader<'a, 'o>,
    collector: Collector<'r>,
    /// The BLOCKS section, until it is indexed.
    section: Option<Pairs<'a>>,
    blocks: Blocks<'a>,
    /// The pairs from ENTITIES on, which OBJECTS follows.
    entities: Pairs<'a>,
    /// The extension dictionaries with a clipping boundary, once they are looked up.
    clipping: Option<HashSet<Handle>>,
    /// Damage to the BLOCKS section, which is an error only if the blocks matter.
    damage: Option<FatalError>,
    /// Whether insertions on unwanted layers may draw on wanted ones, or insert missing blocks.
    blocks_matter: bool,
    /// The insertions in progress, outermost first.
    open: Vec<BlockId>,
    steps: StepBudget,
}

/// The context of an entity: model space or an insertion.
struct EntityContext {
    placement: Option<Placement>,
    insertion: Option<Insertion>,
    is_invisible: bool,
    /// Frozen layer that one of the insertions is on, if any.
    frozen: Option<SmolStr>,
}

/// Properties that the contents of a block inherit from their insertion.
struct Insertion {
    layer: LayerId,
    line_type: SmolStr,
    /// The place of the outermost insertion.
    origin: Origin,
}

/// An insertion of a block.
struct InsertionSite<'s, 'a> {
    traits: &'s CommonProperties,
    layer: LayerId,
    insert: &'s Insert<'a>,
    around: &'s EntityContext,
}

/// Maximum nesting of blocks, in levels. A deeper insertion is an error.
const MAX_BLOCK_DEPTH: usize = 64;

impl<'r, 'a, 'o> Model<'r, 'a, 'o> {
    pub(crate) fn new(
        reader: &'r mut EntityReader<'a, 'o>,
        collector: Collector<'r>,
        blocks: Option<Pairs<'a>>,
        entities: Pairs<'a>,
    ) -> Self {
        let steps = StepBudget::new(reader.options.max_entities);
        Self {
            reader,
            collector,
            section: blocks,
            blocks: Blocks::default(),
            entities,
            clipping: None,
            damage: None,
            blocks_matter: false,
            open: Vec::new(),
            steps,
        }
    }

    /// Adds all entities of the section. `placement` scales model space to millimetres.
    pub(crate) fn add_all(
        &mut self,
        records: &mut Records<'a>,
        placement: Option<Placement>,
    ) -> Result<(), FatalError> {
        let around = EntityContext { placement, insertion: None, is_invisible: false, frozen: None };
        while let Some(item) =
            self.reader.next_item(records, Space::Model).map_err(|stop| stop_error(stop, "ENTITIES"))?
        {
            self.add_item(item, &around)?;
        }
        self.collector.fill_in_counts();
        Ok(())
    }

    #[inline(always)]
    fn add_item(&mut self, item: Item<'a>, around: &EntityContext) -> Result<(), FatalError> {
        let layer = match &around.insertion {
            Some(insertion) => self.reader.layers.effective_layer(item.traits.layer, insertion.layer),
            None => item.traits.layer,
        };
        match item.shape {
            Ok(Shape::Insert(insert)) => {
                self.insert(&InsertionSite { traits: &item.traits, layer, insert: &insert, around })
            }
            Ok(Shape::Hatch(point)) if self.reader.layers.is_kept(layer) => {
                let placed = place_entity(self.reader, &item.traits, layer, around)?;
                self.collector.add_hatch(&placed, point)
            }
            Ok(Shape::Label(label)) => {
                let Some((text, tip)) =
                    label.map(|label| *label).filter(|_| self.reader.layers.is_kept(layer))
                else {
                    return Ok(());
                };
                let placed = place_entity(self.reader, &item.traits, layer, around)?;
                self.collector.add_label(&placed, text, tip)
            }
            shape if self.reader.layers.is_kept(layer) => {
                let is_compatible = self.reader.options.compatible;
                let placed = place_entity(self.reader, &item.traits, layer, around)?;
                let is_plain = around.insertion.is_none() && matches!(shape, Ok(Shape::Plain(_)));
                if is_compatible && shape.is_ok() && !is_plain {
                    self.collector.ignore(&placed);
                    return Ok(());
                }
                self.collector.add(&placed, shape)
            }
            _ => Ok(()),
        }
    }

    fn insert(&mut self, site: &InsertionSite<'_, 'a>) -> Result<(), FatalError> {
        self.index_blocks();
        let is_kept = self.reader.layers.is_kept(site.layer);
        if let Some(damage) = &self.damage {
            return if is_kept || self.blocks_matter { Err(damage.clone()) } else { Ok(()) };
        }
        let Some(block) = self.blocks.find(&site.insert.block) else {
            if !is_kept {
                return self.note_missing(site);
            }
            return self.refuse_insertion(
                site,
                &[site.layer],
                &site.omission_error(&BLOCK_MISSING, Arc::default()),
            );
        };
        if !is_kept && !self.blocks_matter {
            return Ok(());
        }
        let wanted = self.blocks.wanted_layers(block, site.layer, self.reader, &mut self.steps)?;
        let namesakes = self.blocks.namesakes(block);
        if !namesakes.is_empty() && !self.reader.options.compatible {
            self.steps.spend(namesakes.len())?;
            let mut layers = BTreeSet::from([site.layer]);
            layers.extend(wanted.iter());
            for namesake in namesakes {
                let wanted = self.blocks.wanted_layers(namesake, site.layer, self.reader, &mut self.steps)?;
                layers.extend(wanted.iter());
            }
            let trouble = EntityError::DefinedTwice(site.insert.block.as_str().into());
            return self.refuse_insertion(site, &Vec::from_iter(layers), &trouble);
        }
        let has_wanted = wanted.iter().any(|layer| self.reader.layers.is_kept(*layer));
        if !has_wanted {
            self.check_drawn_on_other_layers(site, block)?;
        }
        if wanted.is_empty() {
            return Ok(());
        }
        if let Some(trouble) = self.fault_of_insertion(site, block)? {
            return self.refuse_insertion(site, &wanted, &trouble);
        }
        match site.insert.array.clone().and_then(|array| Ok(array.copies(self.blocks.base(block)?))) {
            Ok(copies) => {
                let before = self.collector.drawn;
                self.add_copies(site, block, copies)?;
                if has_wanted && self.collector.drawn == before {
                    self.check_drawn_on_other_layers(site, block)?;
                }
                Ok(())
            }
            Err(trouble) => self.refuse_insertion(site, &wanted, &trouble),
        }
    }

    /// Returns the reason why a block cannot be drawn: it contains itself or is nested too deep, the layer of its insertion is faulty, or only a part
    /// of it is visible.
    fn fault_of_insertion(
        &mut self,
        site: &InsertionSite<'_, 'a>,
        block: BlockId,
    ) -> Result<Option<EntityError<'a>>, FatalError> {
        if self.open.contains(&block) || self.open.len() >= MAX_BLOCK_DEPTH {
            return Ok(Some(EntityError::Nested(site.insert.block.as_str().into())));
        }
        if let Some(trouble) = site.place(self.reader)?.layer.fault() {
            return Ok(Some(trouble));
        }
        let is_clipped = self.is_clipped(site.insert.dictionary)?;
        Ok(is_clipped.then(|| site.omission_error(&INSERT_CLIPPED, Arc::default())))
    }

    /// Whether an insertion with this extension dictionary has a clipping boundary, so that only a part of its block is visible.
    fn is_clipped(&mut self, dictionary: Option<Handle>) -> Result<bool, FatalError> {
        let Some(dictionary) = dictionary else { return Ok(false) };
        if self.clipping.is_none() {
            let found = clipping_dictionaries(&self.entities);
            self.clipping = Some(found.map_err(|stop| stop_error(stop, "OBJECTS"))?);
        }
        Ok(self.clipping.as_ref().is_some_and(|clipping| clipping.contains(&dictionary)))
    }

    /// Indexes the BLOCKS section at the first insertion.
    fn index_blocks(&mut self) {
        let Some(section) = self.section.take() else { return };
        self.blocks_matter =
            may_have_wanted_entities(&section, &mut self.reader.layers, &mut self.reader.decoder);
        match Blocks::index(section, self.reader) {
            Ok(blocks) => {
                self.blocks_matter |= blocks.has_missing;
                self.blocks = blocks;
            }
            Err(stop) => self.damage = Some(stop_error(stop, "BLOCKS")),
        }
    }

    /// Adds the contents of a block at each of these placements.
    fn add_copies(
        &mut self,
        site: &InsertionSite<'_, 'a>,
        block: BlockId,
        copies: impl Iterator<Item = Placement>,
    ) -> Result<(), FatalError> {
        let placed = site.place(self.reader)?;
        let insertion =
            Insertion { layer: site.layer, line_type: placed.line_type.clone(), origin: placed.origin };
        let frozen = placed.frozen.or(placed.layer.is_frozen.then_some(&placed.layer.name)).cloned();
        let is_invisible = placed.is_invisible;
        let mut inside = EntityContext { placement: None, insertion: Some(insertion), is_invisible, frozen };
        let items = self.blocks.items(block, self.reader)?;
        self.open.push(block);
        for copy in copies {
            inside.placement = Some(site.around.placement.map_or(copy, |outer| outer.composed_after(&copy)));
            for item in items.iter() {
                self.steps.spend(1)?;
                self.add_item(item.clone(), &inside)?;
            }
        }
        self.open.pop();
        Ok(())
    }

    /// Reports PB111 for an insertion on a wanted layer whose block draws elements on other layers, but nothing visible, except for hatches, on
    /// wanted ones.
    fn check_drawn_on_other_layers(
        &mut self,
        site: &InsertionSite<'_, 'a>,
        block: BlockId,
    ) -> Result<(), FatalError> {
        if !self.reader.layers.is_kept(site.layer) {
            return Ok(());
        }
        let layers = self.blocks.drawn_layers(block, self.reader, &mut self.steps)?;
        if layers.is_empty() {
            return Ok(());
        }
        if self.reader.options.compatible {
            let placed = site.place(self.reader)?;
            self.collector.ignore(&placed);
            return Ok(());
        }
        self.refuse_insertion(site, &[site.layer], &site.omission_error(&BLOCK_ELSEWHERE, layers))
    }

    /// Reports a missing block that is inserted on a layer that is not read, unless that layer or the layer of an enclosing insertion is frozen. In
    /// compatible mode, nothing is reported.
    fn note_missing(&mut self, site: &InsertionSite<'_, 'a>) -> Result<(), FatalError> {
        let is_compatible = self.reader.options.compatible;
        let placed = site.place(self.reader)?;
        if !is_compatible && !placed.layer.is_frozen && placed.frozen.is_none() {
            self.collector.note_missing_block(&placed, &site.insert.block, site.point());
        }
        Ok(())
    }

    /// Reports a faulty insertion once for each wanted layer on which it draws.
    fn refuse_insertion(
        &mut self,
        site: &InsertionSite<'_, 'a>,
        layers: &[LayerId],
        trouble: &EntityError<'a>,
    ) -> Result<(), FatalError> {
        for layer in layers {
            if self.reader.layers.is_kept(*layer) {
                let placed = place_entity(self.reader, site.traits, *layer, site.around)?;
                self.collector.add(&placed, Err(trouble.clone()))?;
            }
        }
        Ok(())
    }
}

impl<'a> InsertionSite<'_, 'a> {
    fn point(&self) -> Option<Point> {
        self.insert.array.as_ref().ok().map(Array::insertion_point)
    }

    fn omission_error(&self, message: &'static Message, layers: Arc<[SmolStr]>) -> EntityError<'a> {
        let block = Some(self.insert.block.as_str().into());
        EntityError::LeftOut { message, point: self.point(), block, layers }
    }

    fn place<'p>(&'p self, reader: &'p mut EntityReader<'_, '_>) -> Result<PlacedEntity<'p>, FatalError> {
        place_entity(reader, self.traits, self.layer, self.around)
    }
}

/// Combines an entity with its layer and with the properties that it inherits.
#[inline(always)]
fn place_entity<'p>(
    reader: &'p mut EntityReader<'_, '_>,
    traits: &CommonProperties,
    layer_id: LayerId,
    around: &'p EntityContext,
) -> Result<PlacedEntity<'p>, FatalError> {
    let EntityReader { layers, line_types, fields, decoder, .. } = reader;
    let layer = layers.properties(layer_id, &mut LayerTableReader { fields, decoder });
    let layer = layer.map_err(|stop| stop_error(stop, "TABLES"))?;
    let insertion = around.insertion.as_ref();
    Ok(PlacedEntity {
        kind: traits.kind,
        layer_id,
        layer,
        line_type: match traits.line_type {
            LineType::ByLayer => &layer.line_type,
            LineType::ByBlock => insertion.map_or(&line_types.continuous, |insertion| &insertion.line_type),
            LineType::Named(number) => line_types.name(number),
        },
        own: traits.origin,
        origin: insertion.map_or(traits.origin, |insertion| insertion.origin),
        is_invisible: traits.is_invisible || around.is_invisible,
        frozen: around.frozen.as_ref(),
        placement: around.placement.as_ref(),
    })
}
