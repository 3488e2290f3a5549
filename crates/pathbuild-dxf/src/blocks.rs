//! The BLOCKS section. It is indexed at the first INSERT; each block is read at its first INSERT that may draw on a wanted layer. Most drawings
//! need neither.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;
use std::sync::Arc;

use smol_str::SmolStr;

use crate::Point3;
use crate::collect::too_many_entities;
use crate::encoding::Decoder;
use crate::entities::{EntityReader, Item, Shape, Space};
use crate::faults::{EntityError, FatalError, missing_end_error, stop_error};
use crate::fields::{Fields, FillDecision};
use crate::groups::{Groups, Records};
use crate::layers::LayerId;
use crate::names::case_folded;
use crate::pairs::{Pair, Pairs, Stop};

#[derive(Default)]
pub(crate) struct Blocks<'a> {
    /// Blocks by folded name: of several with the same name, the first.
    by_name: HashMap<SmolStr, BlockId>,
    /// Further blocks with the same name, by the first block of that name.
    namesakes: BTreeMap<BlockId, Vec<BlockId>>,
    all: Vec<Block<'a>>,
    /// The wanted layers on which an insertion draws, by the inserted block and the layer of the insertion.
    wanted: BTreeMap<BlockOnLayer, Rc<[LayerId]>>,
    /// Whether some block inserts a block that the file does not contain.
    pub(crate) has_missing: bool,
}

type BlockOnLayer = (BlockId, LayerId);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct BlockId(usize);

struct Block<'a> {
    base: Result<Point3, EntityError<'a>>,
    /// The pairs after `head`.
    pairs: Pairs<'a>,
    /// The first pair of the first record in the block, or of its ENDBLK.
    head: Pair<'a>,
    items: Option<Rc<[Item<'a>]>>,
    layers: BlockLayers,
    /// The layers that [`Blocks::drawn_layers`] returns; `None` until they are determined.
    drawn_layers: Option<Arc<[SmolStr]>>,
    /// Whether the block stands for the content of another file.
    is_reference: bool,
}

/// The flags of a block that stands for another file: an external reference, attached or overlaid.
const REFERENCE_FLAGS: i64 = 4 | 8;

/// The layers used by the contents of a block.
#[derive(Clone, Default)]
enum BlockLayers {
    /// The layers have yet to be determined.
    #[default]
    Unknown,
    /// The layers of all entities in the block that may be drawn on a wanted layer.
    Known(Rc<[LayerId]>),
    /// The layers are not known in advance: the contents must be read item by item.
    Items,
}

impl<'a> Block<'a> {
    fn is_missing_reference(&self) -> bool {
        self.is_reference && self.head.is("ENDBLK")
    }

    fn records(&self) -> Records<'a> {
        Records { groups: Groups::new(self.pairs), head: self.head }
    }
}

/// Checks that the record after a block's contents is its ENDBLK.
fn check_ended(records: &Records<'_>) -> Result<(), FatalError> {
    if records.head.is("ENDBLK") { Ok(()) } else { Err(missing_end_error("BLOCK", &records.head)) }
}

impl<'a> Blocks<'a> {
    /// Indexes the blocks of the section that starts here.
    pub(crate) fn index(pairs: Pairs<'a>, reader: &mut EntityReader<'a, '_>) -> Result<Self, Stop<'a>> {
        let EntityReader { fields, decoder, .. } = reader;
        let mut groups = Groups::new(pairs);
        let (mut blocks, mut inserted) = (Self::default(), HashSet::new());
        let mut head = groups.next_record_head()?;
        while !head.is("ENDSEC") {
            let is_block = head.is("BLOCK");
            if !is_block && !head.is("INSERT") {
                head = groups.next_record_head()?;
                continue;
            }
            (head, _) = fields.fill(&mut groups, head.line, 0, |_| FillDecision::Keep)?;
            if is_block {
                blocks.add(fields, groups.pairs(), head, decoder);
            } else if let Some(name) = fields.get(2) {
                inserted.insert(case_folded(&decoder.decode(name.bytes, name.line)));
            }
        }
        blocks.has_missing = inserted.iter().any(|name| blocks.find(name).is_none());
        Ok(blocks)
    }

    /// Finds a block by name, ignoring case. An external reference without contents in the file is treated as missing.
    pub(crate) fn find(&self, name: &str) -> Option<BlockId> {
        self.by_name
            .get(&case_folded(name))
            .copied()
            .filter(|block| !self.all[block.0].is_missing_reference())
    }

    /// Returns the further blocks with the name of this one.
    pub(crate) fn namesakes(&self, block: BlockId) -> Vec<BlockId> {
        self.namesakes.get(&block).cloned().unwrap_or_default()
    }

    pub(crate) fn base(&self, block: BlockId) -> Result<Point3, EntityError<'a>> {
        self.all[block.0].base.clone()
    }

    /// Returns the items in a block that may be drawn on a wanted layer.
    pub(crate) fn items(
        &mut self,
        block: BlockId,
        reader: &mut EntityReader<'a, '_>,
    ) -> Result<Rc<[Item<'a>]>, FatalError> {
        let block = &mut self.all[block.0];
        if let Some(items) = &block.items {
            return Ok(items.clone());
        }
        let mut items = Vec::new();
        let mut records = block.records();
        while let Some(item) =
            reader.next_item(&mut records, Space::Block).map_err(|stop| stop_error(stop, "BLOCKS"))?
        {
            items.push(item);
        }
        check_ended(&records)?;
        let items: Rc<[Item<'a>]> = items.into();
        block.items = Some(items.clone());
        Ok(items)
    }

    /// Returns the wanted layers on which an insertion of this block on this layer draws something or reports a fault, and the layers, wanted or not,
    /// on which it inserts a missing block.
    pub(crate) fn wanted_layers(
        &mut self,
        block: BlockId,
        layer: LayerId,
        reader: &mut EntityReader<'a, '_>,
        steps: &mut StepBudget,
    ) -> Result<Rc<[LayerId]>, FatalError> {
        if let Some(wanted) = self.wanted.get(&(block, layer)) {
            return Ok(wanted.clone());
        }
        let (wanted, seen) = self.collect_wanted_layers(block, layer, reader, steps)?;
        let wanted: Rc<[LayerId]> = wanted.into();
        if wanted.is_empty() {
            // The nested blocks draw on no wanted layer either, so all visited insertions share the result.
            self.wanted.extend(seen.into_iter().map(|seen| (seen, Rc::clone(&wanted))));
        }
        self.wanted.insert((block, layer), Rc::clone(&wanted));
        Ok(wanted)
    }

    /// Returns the names of the layers, wanted or not, on which a block and the blocks nested in it draw more than texts, hatches and
    /// annotations. Layer `0`, which stands for the layer of the insertion, is left out.
    pub(crate) fn drawn_layers(
        &mut self,
        block: BlockId,
        reader: &mut EntityReader<'a, '_>,
        steps: &mut StepBudget,
    ) -> Result<Arc<[SmolStr]>, FatalError> {
        if let Some(layers) = &self.all[block.0].drawn_layers {
            return Ok(layers.clone());
        }
        let (mut layers, mut seen, mut ahead) = (Vec::new(), HashSet::from([block]), vec![block]);
        while let Some(next) = ahead.pop() {
            let mut records = self.all[next.0].records();
            while let Some((layer, inserted)) =
                reader.next_element(&mut records).map_err(|stop| stop_error(stop, "BLOCKS"))?
            {
                steps.spend(1)?;
                let inner = inserted.and_then(|name| self.find(&name));
                ahead.extend(inner.filter(|inner| seen.insert(*inner)));
                let name = reader.layers.name(layer);
                if !reader.layers.is_layer_zero(layer) && !layers.iter().any(|known| known == name) {
                    layers.push(SmolStr::new(name));
                }
            }
        }
        let layers: Arc<[SmolStr]> = layers.into();
        self.all[block.0].drawn_layers = Some(layers.clone());
        Ok(layers)
    }

    /// Collects the wanted layers of a block and of all blocks nested in it, and the insertions that were visited.
    fn collect_wanted_layers(
        &mut self,
        block: BlockId,
        layer: LayerId,
        reader: &mut EntityReader<'a, '_>,
        steps: &mut StepBudget,
    ) -> Result<(Vec<LayerId>, HashSet<BlockOnLayer>), FatalError> {
        let (mut wanted, mut known) = (Vec::new(), HashSet::new());
        let mut seen = HashSet::from([(block, layer)]);
        let mut ahead = vec![(block, layer)];
        while let Some((block, inherited)) = ahead.pop() {
            if let Some(layers) = self.wanted.get(&(block, inherited)) {
                steps.spend(layers.len())?;
                wanted.extend(layers.iter().filter(|layer| known.insert(**layer)));
                continue;
            }
            if let BlockLayers::Known(layers) = self.layers(block, reader)? {
                steps.spend(layers.len())?;
                let layers = layers.iter().map(|layer| reader.layers.effective_layer(*layer, inherited));
                let kept = layers.filter(|layer| reader.layers.is_kept(*layer));
                wanted.extend(kept.filter(|layer| known.insert(*layer)));
                continue;
            }
            let items = self.items(block, reader)?;
            steps.spend(items.len())?;
            for item in items.iter() {
                let layer = reader.layers.effective_layer(item.traits.layer, inherited);
                if let Some(inner) = self.inserted_block(item) {
                    ahead.extend(seen.insert((inner, layer)).then_some((inner, layer)));
                    continue;
                }
                let is_missing = matches!(item.shape, Ok(Shape::Insert(_)));
                let is_wanted = is_missing || reader.layers.is_kept(layer);
                wanted.extend((is_wanted && known.insert(layer)).then_some(layer));
            }
        }
        Ok((wanted, seen))
    }

    /// Determines the layers of those contents of a block that may be drawn on a wanted layer.
    fn layers(
        &mut self,
        block: BlockId,
        reader: &mut EntityReader<'a, '_>,
    ) -> Result<BlockLayers, FatalError> {
        let block = &mut self.all[block.0];
        if matches!(block.layers, BlockLayers::Unknown) {
            let mut records = block.records();
            let layers = reader.layers_ahead(&mut records).map_err(|stop| stop_error(stop, "BLOCKS"))?;
            block.layers = match layers {
                Some(layers) => {
                    check_ended(&records)?;
                    BlockLayers::Known(layers.into())
                }
                None => BlockLayers::Items,
            };
        }
        Ok(block.layers.clone())
    }

    /// Returns the block that an item inserts; `None` if the file does not define it.
    fn inserted_block(&self, item: &Item<'_>) -> Option<BlockId> {
        match &item.shape {
            Ok(Shape::Insert(insert)) => self.find(&insert.block),
            _ => None,
        }
    }

    fn add(&mut self, fields: &Fields<'a>, pairs: Pairs<'a>, head: Pair<'a>, decoder: &mut Decoder<'_>) {
        if let Some(name) = fields.get(2) {
            let name = case_folded(&decoder.decode(name.bytes, name.line));
            let block = BlockId(self.all.len());
            let first = *self.by_name.entry(name).or_insert(block);
            if first != block {
                self.namesakes.entry(first).or_default().push(block);
            }
        }
        let base = if fields.get(10).is_some() { fields.point(10) } else { Ok(Point3::default()) };
        self.all.push(Block {
            base: base.map_err(EntityError::from),
            pairs,
            head,
            items: None,
            layers: BlockLayers::Unknown,
            drawn_layers: None,
            is_reference: fields
                .whole_number(70)
                .is_ok_and(|flags| flags.is_some_and(|bits| bits & REFERENCE_FLAGS != 0)),
        });
    }
}

/// The number of block entities that may still be visited.
pub(crate) struct StepBudget {
    left: usize,
    most_entities: usize,
}

/// Number of block entities, wanted or not, that may be visited per entity that the limit allows.
const STEPS_PER_ENTITY: usize = 16;

impl StepBudget {
    pub(crate) fn new(most_entities: usize) -> Self {
        Self { left: most_entities.saturating_mul(STEPS_PER_ENTITY), most_entities }
    }

    /// Spends some of the budget.
    ///
    /// # Errors
    /// PB005 if it is exhausted.
    pub(crate) fn spend(&mut self, count: usize) -> Result<(), FatalError> {
        self.left = self.left.checked_sub(count).ok_or_else(|| too_many_entities(self.most_entities))?;
        Ok(())
    }
}
