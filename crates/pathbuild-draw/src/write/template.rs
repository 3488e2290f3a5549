use super::record::{Pair, Record, drop_codes, kind, value};
use super::with_written;
use super::written::CrateOutput;
use crate::sheet::Sheet;

/// A frame around a drawing, as written by the crate, without handles: created once and shared by many drawings.
#[derive(Clone, Debug, PartialEq)]
pub struct Template {
    tables: Vec<Record<'static>>,
    blocks: Vec<Record<'static>>,
    early: Vec<Record<'static>>,
    late: Vec<Record<'static>>,
}

impl Template {
    /// Creates a template from a sheet without parameter texts. Its first `early` entities precede those of the surrounded drawing.
    pub fn new(sheet: &Sheet, early: usize) -> Self {
        with_written(sheet, |written| {
            let is_block = |record: &&Record<'_>| kind(record) == "BLOCK_RECORD" && !is_space(record);
            let tables = written.tables.iter().filter(is_block).map(owned).collect();
            let mut space = false;
            let is_inside = |record: &&Record<'_>| {
                if kind(record) == "BLOCK" {
                    space = is_space(record);
                }
                !space
            };
            let blocks = written.blocks.iter().filter(is_inside).map(owned).collect();
            let mut entities: Vec<_> = written.entities.iter().map(owned).collect();
            let is_entity = |record: &Record<'_>| !matches!(kind(record), "VERTEX" | "SEQEND");
            let mut starts = (0..entities.len()).filter(|at| is_entity(&entities[*at]));
            let begin = starts.nth(early).unwrap_or(entities.len());
            let late = entities.split_off(begin);
            Self { tables, blocks, early: entities, late }
        })
    }

    /// Adds the template to the records of a sheet, without its last `left_out` records.
    pub(crate) fn add_to<'a>(&'a self, written: &mut CrateOutput<'a>, left_out: usize) {
        written.tables.extend(borrowed(&self.tables));
        written.blocks.extend(borrowed(&self.blocks));
        written.entities.splice(0..0, borrowed(&self.early));
        written.entities.extend(borrowed(&self.late[..self.late.len().saturating_sub(left_out)]));
    }
}

fn borrowed<'a>(records: &'a [Record<'static>]) -> impl Iterator<Item = Record<'a>> {
    records.iter().map(|record| record.iter().map(Pair::borrowed).collect())
}

fn is_space(record: &Record<'_>) -> bool {
    matches!(value(record, 2), Some("*Model_Space" | "*Paper_Space"))
}

fn owned(record: &Record<'_>) -> Record<'static> {
    let mut record: Record<'static> = record.iter().map(Pair::owned).collect();
    drop_codes(&mut record, &[5]);
    record
}
