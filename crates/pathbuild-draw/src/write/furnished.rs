use std::sync::OnceLock;

use super::record::{Pair, Record, drop_codes, kind, value};
use super::with_written;
use crate::furniture::{Furniture, HATCH_LINES, VARIANTS};
use crate::model::Version;

/// The furniture as the crate writes it, without handles.
#[derive(Debug)]
pub(crate) struct Furnished {
    tables: Vec<Record<'static>>,
    blocks: Vec<Record<'static>>,
    early: Vec<Record<'static>>,
    late: Vec<Record<'static>>,
}

/// Kept, because even a library of thousands of drawings has but few different ones.
static KEPT: [[OnceLock<Furnished>; VARIANTS]; Version::ALL.len()] =
    [const { [const { OnceLock::new() }; VARIANTS] }; Version::ALL.len()];

/// Adds the furniture to the records of a sheet.
pub(crate) fn furnish<'a>(
    furniture: Furniture,
    version: Version,
    tables: &mut Vec<Record<'a>>,
    blocks: &mut Vec<Record<'a>>,
    entities: &mut Vec<Record<'a>>,
) {
    let kept = KEPT[version as usize][furniture.variant()].get_or_init(|| make(furniture, version));
    tables.extend(borrowed(&kept.tables));
    blocks.extend(borrowed(&kept.blocks));
    // A CAD writes in the order of drawing: the frame first, then the path, then what was added to it.
    entities.splice(0..0, borrowed(&kept.early));
    let unwanted = HATCH_LINES.saturating_sub(furniture.hatch_lines());
    entities.extend(borrowed(&kept.late[..kept.late.len().saturating_sub(unwanted)]));
}

fn borrowed<'a>(records: &'a [Record<'static>]) -> impl Iterator<Item = Record<'a>> {
    records.iter().map(|record| record.iter().map(Pair::borrowed).collect())
}

fn make(furniture: Furniture, version: Version) -> Furnished {
    with_written(&furniture.sheet(version), |written| {
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
        let mut early: Vec<_> = written.entities.iter().map(owned).collect();
        let late = early.split_off((early.len() - HATCH_LINES) / 3);
        Furnished { tables, blocks, early, late }
    })
}

fn is_space(record: &Record<'_>) -> bool {
    matches!(value(record, 2), Some("*Model_Space" | "*Paper_Space"))
}

fn owned(record: &Record<'_>) -> Record<'static> {
    let mut record: Record<'static> = record.iter().map(Pair::owned).collect();
    drop_codes(&mut record, &[5]);
    record
}
