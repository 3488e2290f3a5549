//! The BLOCKS section: indexed when the first INSERT is met that may bring something wanted, each block read when its first such INSERT is.
//! Most drawings need none of it.

use std::collections::{BTreeMap, HashSet};
use std::rc::Rc;

use crate::Point3;
use crate::by_name::ByName;
use crate::encoding::Decoder;
use crate::entities::{EntityReader, Records, Space};
use crate::faults::{Fatal, not_ended, stopped};
use crate::fields::{Fields, Want};
use crate::groups::Groups;
use crate::item::{Item, Shape};
use crate::layers::LayerId;
use crate::names::Name;
use crate::pairs::{Pair, Pairs, Stop};
use crate::steps::Steps;
use crate::trouble::Trouble;

/// The blocks of a file.
#[derive(Default)]
pub(crate) struct Blocks<'a> {
    by_name: ByName<'a, BlockId>,
    all: Vec<Block<'a>>,
    /// The wanted layers that the insertion of a block on a layer touches.
    wanted: BTreeMap<Inserted, Rc<[LayerId]>>,
}

/// A block on a layer.
type Inserted = (BlockId, LayerId);

/// The number of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct BlockId(usize);

struct Block<'a> {
    base: Result<Point3, Trouble<'a>>,
    /// The pairs behind its own, and the first of its records.
    pairs: Pairs<'a>,
    head: Pair<'a>,
    items: Option<Rc<[Item<'a>]>>,
    layers: LayersOf,
}

/// What is known of the layers of a block's items without these.
#[derive(Clone, Default)]
enum LayersOf {
    /// Nothing yet.
    #[default]
    Unknown,
    /// All of them.
    Known(Rc<[LayerId]>),
    /// They cannot be known without the items.
    Items,
}

impl<'a> Block<'a> {
    fn records(&self) -> Records<'a> {
        Records { groups: Groups::new(self.pairs), head: self.head }
    }
}

/// What ends a block must be its end.
fn ended(records: &Records<'_>) -> Result<(), Fatal> {
    if records.head.is("ENDBLK") { Ok(()) } else { Err(not_ended("BLOCK", &records.head)) }
}

impl<'a> Blocks<'a> {
    /// Finds the blocks of the section that begins here.
    pub(crate) fn index(pairs: Pairs<'a>, reader: &mut EntityReader<'a, '_>) -> Result<Self, Stop<'a>> {
        let EntityReader { fields, decoder, .. } = reader;
        let mut groups = Groups::new(pairs);
        let mut blocks = Self::default();
        let mut head = groups.next_zero()?;
        while !head.is("ENDSEC") {
            if head.is("BLOCK") {
                (head, _) = fields.fill(&mut groups, head.line, 0, |_| Want::Keep)?;
                blocks.add(fields, groups.pairs(), head, decoder);
            } else {
                head = groups.next_zero()?;
            }
        }
        Ok(blocks)
    }

    /// The block of this name, without regard to case.
    pub(crate) fn find(&self, name: &str) -> Option<BlockId> {
        self.by_name.find(&Name::new(name.into())).copied()
    }

    /// Its base point.
    pub(crate) fn base(&self, block: BlockId) -> Result<Point3, Trouble<'a>> {
        self.all[block.0].base.clone()
    }

    /// What is in it, as far as it can be wanted.
    pub(crate) fn items(
        &mut self,
        block: BlockId,
        reader: &mut EntityReader<'a, '_>,
    ) -> Result<Rc<[Item<'a>]>, Fatal> {
        let block = &mut self.all[block.0];
        if let Some(items) = &block.items {
            return Ok(items.clone());
        }
        let mut items = Vec::new();
        let mut records = block.records();
        while let Some(item) =
            reader.next_item(&mut records, Space::Block).map_err(|stop| stopped(stop, "BLOCKS"))?
        {
            items.push(item);
        }
        ended(&records)?;
        let items: Rc<[Item<'a>]> = items.into();
        block.items = Some(items.clone());
        Ok(items)
    }

    /// The wanted layers on which the insertion of a block on a layer puts something, be it that something is wrong there.
    pub(crate) fn wanted_layers(
        &mut self,
        block: BlockId,
        layer: LayerId,
        reader: &mut EntityReader<'a, '_>,
        steps: &mut Steps,
    ) -> Result<Rc<[LayerId]>, Fatal> {
        if let Some(wanted) = self.wanted.get(&(block, layer)) {
            return Ok(wanted.clone());
        }
        let (wanted, seen) = self.look_for_wanted(block, layer, reader, steps)?;
        let wanted: Rc<[LayerId]> = wanted.into();
        if wanted.is_empty() {
            // Then nothing on the way is wanted.
            self.wanted.extend(seen.into_iter().map(|seen| (seen, Rc::clone(&wanted))));
        }
        self.wanted.insert((block, layer), Rc::clone(&wanted));
        Ok(wanted)
    }

    /// Goes through a block, and those that are inserted in it, for wanted layers; and which blocks on which layers these were.
    fn look_for_wanted(
        &mut self,
        block: BlockId,
        layer: LayerId,
        reader: &mut EntityReader<'a, '_>,
        steps: &mut Steps,
    ) -> Result<(Vec<LayerId>, HashSet<Inserted>), Fatal> {
        let (mut wanted, mut known) = (Vec::new(), HashSet::new());
        let mut seen = HashSet::from([(block, layer)]);
        let mut ahead = vec![(block, layer)];
        while let Some((block, inherited)) = ahead.pop() {
            if let Some(layers) = self.wanted.get(&(block, inherited)) {
                steps.take(layers.len())?;
                wanted.extend(layers.iter().filter(|layer| known.insert(**layer)));
                continue;
            }
            if let LayersOf::Known(layers) = self.layers(block, reader)? {
                steps.take(layers.len())?;
                let layers = layers.iter().map(|layer| reader.layers.inherited(*layer, inherited));
                let kept = layers.filter(|layer| reader.layers.is_kept(*layer));
                wanted.extend(kept.filter(|layer| known.insert(*layer)));
                continue;
            }
            let items = self.items(block, reader)?;
            steps.take(items.len())?;
            for item in items.iter() {
                let layer = reader.layers.inherited(item.traits.layer, inherited);
                match self.inserted(item) {
                    Some(inner) => ahead.extend(seen.insert((inner, layer)).then_some((inner, layer))),
                    None if reader.layers.is_kept(layer) && known.insert(layer) => wanted.push(layer),
                    None => {}
                }
            }
        }
        Ok((wanted, seen))
    }

    /// The layers of what is in it, as far as it can be wanted.
    fn layers(&mut self, block: BlockId, reader: &mut EntityReader<'a, '_>) -> Result<LayersOf, Fatal> {
        let block = &mut self.all[block.0];
        if matches!(block.layers, LayersOf::Unknown) {
            let mut records = block.records();
            let layers = reader.layers_ahead(&mut records).map_err(|stop| stopped(stop, "BLOCKS"))?;
            block.layers = match layers {
                Some(layers) => {
                    ended(&records)?;
                    LayersOf::Known(layers.into())
                }
                None => LayersOf::Items,
            };
        }
        Ok(block.layers.clone())
    }

    /// The block that an item inserts, if the file has it.
    fn inserted(&self, item: &Item<'_>) -> Option<BlockId> {
        match &item.shape {
            Ok(Shape::Insert(insert)) => self.find(&insert.block),
            _ => None,
        }
    }

    fn add(&mut self, fields: &Fields<'a>, pairs: Pairs<'a>, head: Pair<'a>, decoder: &mut Decoder<'_>) {
        if let Some(name) = fields.get(2) {
            let name = Name::decoded(name.bytes, name.line, decoder);
            self.by_name.push(name, BlockId(self.all.len()));
        }
        let base = if fields.get(10).is_some() { fields.point(10) } else { Ok(Point3::default()) };
        self.all.push(Block {
            base: base.map_err(Trouble::from),
            pairs,
            head,
            items: None,
            layers: LayersOf::Unknown,
        });
    }
}
