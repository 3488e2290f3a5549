use super::crate_drawing::TAG;
use super::record::{Pair, Record, kind, records, value};
use super::tickets::Tickets;
use super::tidy;
use crate::model::{Entity, Version};

/// The output of the crate, section by section.
#[derive(Debug, Default)]
pub(crate) struct CrateOutput<'a> {
    /// Header variables: the pair with the name, and the pairs of its value.
    pub(crate) header: Vec<Record<'a>>,
    /// The records of all tables, without their heads.
    pub(crate) tables: Vec<Record<'a>>,
    pub(crate) blocks: Vec<Record<'a>>,
    pub(crate) entities: Vec<Record<'a>>,
}

impl<'a> CrateOutput<'a> {
    /// Splits the output of the crate and replaces the tickets by their strings.
    pub(crate) fn of(text: &'a str, tickets: &'a Tickets) -> Self {
        let mut written = Self::default();
        let mut section = String::new();
        for mut record in records(text) {
            match kind(&record) {
                "SECTION" => {
                    value(&record, 2).unwrap_or_default().clone_into(&mut section);
                    if section == "HEADER" {
                        written.header = variables(&record[2..]);
                    }
                }
                "ENDSEC" | "EOF" | "TABLE" | "ENDTAB" => {}
                _ => {
                    tickets.redeem_all(&mut record);
                    match section.as_str() {
                        "TABLES" => written.tables.push(record),
                        "BLOCKS" => written.blocks.push(record),
                        "ENTITIES" => written.entities.push(record),
                        _ => {}
                    }
                }
            }
        }
        written
    }

    /// Corrects the entities in the crate's output.
    pub(crate) fn tidy(&mut self, tagged: &[&Entity], version: Version) {
        for record in self.entities.iter_mut().chain(&mut self.blocks) {
            tidy::common(record, version);
            if let Some(entity) = entity_of(record, tagged) {
                tidy::entity(record, entity);
            }
        }
    }
}

fn variables<'a>(pairs: &[Pair<'a>]) -> Vec<Record<'a>> {
    pairs.chunk_by(|_, next| next.code != 9).map(<[Pair<'_>]>::to_vec).collect()
}

/// The entity of a record, by the tag in place of its handle.
pub(crate) fn entity_of<'e>(record: &Record<'_>, tagged: &[&'e Entity]) -> Option<&'e Entity> {
    let tag = u64::from_str_radix(value(record, 5)?, 16).ok()?;
    let index = usize::try_from(tag.checked_sub(TAG)?).ok()?;
    tagged.get(index).copied()
}
