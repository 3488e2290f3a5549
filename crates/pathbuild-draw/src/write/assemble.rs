use super::objects::Objects;
use super::record::{Pair, Record, identify, kind, value};
use super::tables::{Owners, Tables};
use super::written::{CrateOutput, entity_of};
use super::{header, tidy};
use crate::model::{Entity, Part, Shape, Version};
use crate::sheet::Sheet;

/// Joins the sections: assigns unique handles and owners, and omits the parts that the options exclude.
pub(crate) fn assemble<'a>(sheet: &'a Sheet, mut written: CrateOutput<'a>) -> Vec<Pair<'a>> {
    let options = sheet.options();
    let is_in = |part: Part| !options.left_out.contains(&part);
    if let Some((template, left_out)) = sheet.template() {
        template.add_to(&mut written, left_out);
    }
    let objects = Objects::from(sheet.next_handle());
    let mut counter = objects.end()..;
    let mut next = || counter.next().filter(|_| is_in(Part::Handles));
    let tables = Tables { sheet, plot_style: objects.plot_style(), layouts: objects.layouts() };
    let (table_pairs, owners) = tables.pairs(written.tables, &mut next);
    let entities = Entities::new(sheet, &owners, is_in(Part::Handles));
    let block_pairs = entities.blocks(written.blocks, &mut next);
    let entity_pairs = entities.entities(written.entities, None, &mut next);
    let has_objects = options.version >= Version::R13 && is_in(Part::Objects);
    let seed = next().unwrap_or(objects.end());
    let sections = [
        ("HEADER", is_in(Part::Header), header::pairs(sheet, written.header, seed)),
        ("TABLES", is_in(Part::Tables), table_pairs),
        ("BLOCKS", is_in(Part::Blocks), block_pairs),
        ("ENTITIES", true, entity_pairs),
        ("OBJECTS", has_objects, objects.pairs(options.version, entities.spaces)),
    ];
    let mut pairs: Vec<Pair<'a>> = Vec::new();
    for (name, _, content) in sections.into_iter().filter(|(_, is_wanted, _)| *is_wanted) {
        pairs.extend([Pair::new(0, "SECTION"), Pair::new(2, name)]);
        pairs.extend(content);
        pairs.push(Pair::new(0, "ENDSEC"));
    }
    pairs.extend(is_in(Part::Eof).then(|| Pair::new(0, "EOF")));
    pairs
}

/// Assigns handles and owners to blocks and entities.
struct Entities<'a, 'o> {
    /// The entities in the order of their tags.
    tagged: Vec<&'a Entity>,
    version: Version,
    has_handles: bool,
    owners: &'o Owners,
    /// The handles of the block records of model and paper space.
    spaces: [u64; 2],
}

impl<'a, 'o> Entities<'a, 'o> {
    fn new(sheet: &'a Sheet, owners: &'o Owners, has_handles: bool) -> Self {
        let space =
            |wanted: &str| owners.iter().find(|(name, _)| name == wanted).map_or(0, |(_, handle)| *handle);
        let spaces = [space("*Model_Space"), space("*Paper_Space")];
        Self { tagged: sheet.tagged(), version: sheet.options().version, has_handles, owners, spaces }
    }

    fn owner(&self, owner: Option<u64>) -> Option<u64> {
        owner.filter(|_| self.has_handles && self.version >= Version::R2000)
    }

    /// Blocks: BLOCK and ENDBLK get handles of their own, and everything between them is owned by the block.
    fn blocks(&self, records: Vec<Record<'a>>, next: &mut impl FnMut() -> Option<u64>) -> Vec<Pair<'a>> {
        let mut pairs = Vec::new();
        let mut owner = None;
        let mut inner = Vec::new();
        for mut record in records {
            let is_begin = kind(&record) == "BLOCK";
            if is_begin {
                let name = value(&record, 2).unwrap_or_default();
                owner = self.owners.iter().find(|(owner, _)| owner == name).map(|(_, handle)| *handle);
            } else if kind(&record) != "ENDBLK" {
                inner.push(record);
                continue;
            }
            pairs.extend(self.entities(std::mem::take(&mut inner), owner, next));
            identify(&mut record, 5, next(), self.owner(owner));
            pairs.extend(record);
        }
        pairs
    }

    /// The entities of a block, or of model and paper space.
    fn entities(
        &self,
        records: Vec<Record<'a>>,
        block: Option<u64>,
        next: &mut impl FnMut() -> Option<u64>,
    ) -> Vec<Pair<'a>> {
        let mut pairs = Vec::new();
        let mut whole = None;
        for mut record in records {
            if let Some(entity) = entity_of(&record, &self.tagged) {
                let space = self.spaces[usize::from(entity.paper)];
                whole = entity.handle.map(|handle| handle.0).filter(|_| self.has_handles);
                if let Shape::Raw(raw) = &entity.shape {
                    record = raw.iter().map(Pair::from).collect();
                } else {
                    identify(&mut record, 5, whole, self.owner(block.or(Some(space))));
                }
                tidy::change(&mut record, &entity.changes);
            } else if matches!(kind(&record), "VERTEX" | "SEQEND") {
                identify(&mut record, 5, next(), self.owner(whole));
            } else {
                whole = next();
                identify(&mut record, 5, whole, self.owner(block.or(Some(self.spaces[0]))));
            }
            pairs.extend(record);
        }
        pairs
    }
}
