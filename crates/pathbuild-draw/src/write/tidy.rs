use super::record::{Pair, Record, drop_codes, set, value};
use crate::model::{Change, Direction, Entity, Shape, Version};

/// Groups of MTEXT to keep. The crate adds groups for columns and a background, which older programs cannot read.
const MTEXT: [i32; 25] =
    [0, 5, 330, 100, 67, 8, 6, 62, 48, 60, 10, 20, 30, 40, 41, 71, 72, 3, 1, 7, 73, 44, 210, 220, 230];

/// Removes unwanted output of the crate: empty names, dangling pointers, and subclasses in versions without them.
pub(crate) fn common(record: &mut Record<'_>, version: Version) {
    record.retain(|pair| match pair.code {
        100 => version >= Version::R13,
        347 | 390 | 430 | 440 | 284 => false,
        370 => pair.value.trim() != "-1",
        _ => true,
    });
}

/// Corrects an entity in the crate's output.
pub(crate) fn entity(record: &mut Record<'_>, entity: &Entity) {
    match &entity.shape {
        Shape::Text(_) => text(record),
        Shape::MText(mtext) => match mtext.direction {
            Direction::Rotation(_) => reduce(record, &[50]),
            Direction::Vector(_) => reduce(record, &[11, 21, 31]),
        },
        Shape::Spline(spline) if spline.fit.is_empty() => drop_codes(record, &[12, 22, 32, 13, 23, 33]),
        _ => {}
    }
}

/// Reduces an MTEXT to its usual groups and those of its direction. The crate's second group 50 counts columns.
fn reduce(record: &mut Record<'_>, direction: &[i32]) {
    let mut is_first = true;
    record.retain(|pair| {
        let is_count = pair.code == 50 && !std::mem::take(&mut is_first);
        !is_count && (MTEXT.contains(&pair.code) || direction.contains(&pair.code))
    });
}

/// Restores an alignment point at the origin, and moves the vertical alignment to its place.
fn text(record: &mut Record<'_>) {
    let is_aligned = value(record, 72).or(value(record, 73)).is_some();
    if is_aligned && value(record, 11).is_none() {
        let behind = record.iter().position(|pair| pair.code == 72).map_or(record.len(), |at| at + 1);
        record.splice(behind..behind, [11, 21, 31].map(|code| Pair::new(code, "0.0")));
    }
    if let Some(at) = record.iter().position(|pair| pair.code == 73) {
        let vertical = record.remove(at);
        record.push(vertical);
    }
}

/// Applies the changes that the drawing requests.
pub(crate) fn change<'a>(record: &mut Record<'a>, changes: &'a [Change]) {
    for change in changes {
        match change {
            Change::Set(pair) => set(record, pair.into()),
            Change::Unset(code) => drop_codes(record, &[*code]),
        }
    }
}
