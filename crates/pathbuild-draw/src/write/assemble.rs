use super::crate_drawing::TAG;
use super::objects::Objects;
use super::record::{Record, Written, identify, value};
use super::tables::{Owners, Tables};
use super::{header, tidy};
use crate::model::{Entity, Pair, Part, Shape, Version};
use crate::sheet::Sheet;

/// Puts the sections together: with one handle for each thing, owners, and without what the options leave out.
pub(crate) fn assemble(sheet: &Sheet, written: Written) -> Vec<Pair> {
    let options = sheet.options();
    let is_in = |part: Part| !options.left_out.contains(&part);
    let objects = Objects::from(sheet.next_handle());
    let mut counter = objects.end()..;
    let mut next = || counter.next().filter(|_| is_in(Part::Handles));
    let tables = Tables { sheet, plot_style: objects.plot_style(), layouts: objects.layouts() };
    let (table_pairs, owners) = tables.pairs(&written.tables, &mut next);
    let entities = Entities::new(sheet, &owners, is_in(Part::Handles));
    let block_pairs = entities.mend_blocks(written.blocks, &mut next);
    let entity_pairs = entities.mend(written.entities, None, &mut next);
    let has_objects = options.version >= Version::R13 && is_in(Part::Objects);
    let seed = next().unwrap_or(objects.end());
    let sections = [
        ("HEADER", is_in(Part::Header), header::pairs(sheet, written.header, seed)),
        ("TABLES", is_in(Part::Tables), table_pairs),
        ("BLOCKS", is_in(Part::Blocks), block_pairs),
        ("ENTITIES", true, entity_pairs),
        ("OBJECTS", has_objects, objects.pairs(options.version, entities.spaces)),
    ];
    let mut pairs: Vec<Pair> = Vec::new();
    for (name, _, content) in sections.into_iter().filter(|(_, wanted, _)| *wanted) {
        pairs.extend([Pair::new(0, "SECTION"), Pair::new(2, name)]);
        pairs.extend(content);
        pairs.push(Pair::new(0, "ENDSEC"));
    }
    pairs.extend(is_in(Part::Eof).then(|| Pair::new(0, "EOF")));
    pairs
}

struct Entities<'a> {
    /// In the order of their tags.
    tagged: Vec<&'a Entity>,
    version: Version,
    handles: bool,
    owners: &'a Owners,
    /// The block records of model and paper space.
    spaces: [u64; 2],
}

impl<'a> Entities<'a> {
    fn new(sheet: &'a Sheet, owners: &'a Owners, handles: bool) -> Self {
        let inner = sheet.blocks().iter().flat_map(|block| &block.entities);
        let space =
            |wanted: &str| owners.iter().find(|(name, _)| name == wanted).map_or(0, |(_, handle)| *handle);
        Self {
            tagged: sheet.entities().iter().chain(inner).collect(),
            version: sheet.options().version,
            handles,
            owners,
            spaces: [space("*Model_Space"), space("*Paper_Space")],
        }
    }

    /// BLOCK and ENDBLK get handles of their own; what lies between them belongs to the block.
    fn mend_blocks(&self, records: Vec<Record>, next: &mut impl FnMut() -> Option<u64>) -> Vec<Pair> {
        let mut pairs = Vec::new();
        let mut owner = None;
        let mut inner = Vec::new();
        for mut record in records {
            match record[0].value.as_str() {
                "BLOCK" => {
                    let name = value(&record, 2).unwrap_or_default();
                    owner = self.owners.iter().find(|(owner, _)| owner == name).map(|(_, handle)| *handle);
                    tidy::common(&mut record, self.version);
                    identify(&mut record, 5, next(), self.owner(owner));
                    pairs.extend(record);
                }
                "ENDBLK" => {
                    pairs.extend(self.mend(std::mem::take(&mut inner), owner, next));
                    tidy::common(&mut record, self.version);
                    identify(&mut record, 5, next(), self.owner(owner));
                    pairs.extend(record);
                }
                _ => inner.push(record),
            }
        }
        pairs
    }

    fn owner(&self, owner: Option<u64>) -> Option<u64> {
        owner.filter(|_| self.handles && self.version >= Version::R2000)
    }

    /// Entities of one block, or of model and paper space.
    fn mend(
        &self,
        records: Vec<Record>,
        block: Option<u64>,
        next: &mut impl FnMut() -> Option<u64>,
    ) -> Vec<Pair> {
        let mut pairs = Vec::new();
        let mut whole = 0;
        for mut record in records {
            if let Some(entity) = self.tagged(&record) {
                whole = entity.handle.map_or(0, |handle| handle.0);
                let owner = block.unwrap_or(self.spaces[usize::from(entity.paper)]);
                tidy::entity(&mut record, entity, self.version);
                if !matches!(entity.shape, Shape::Raw(_)) {
                    identify(&mut record, 5, Some(whole).filter(|_| self.handles), self.owner(Some(owner)));
                }
                tidy::change(&mut record, &entity.changes);
            } else {
                // A part of the entity before it: VERTEX or SEQEND.
                tidy::common(&mut record, self.version);
                identify(&mut record, 5, next(), self.owner(Some(whole)));
            }
            pairs.extend(record);
        }
        pairs
    }

    fn tagged(&self, record: &Record) -> Option<&'a Entity> {
        let tag = u64::from_str_radix(value(record, 5)?, 16).ok()?;
        let index = usize::try_from(tag.checked_sub(TAG)?).ok()?;
        self.tagged.get(index).copied()
    }
}
