use super::record::{Record, drop_codes, set, value};
use crate::model::{Change, Direction, Entity, Pair, Shape, Version};

/// Groups of MTEXT that are written; the crate adds those of columns and of a background, which no older program reads.
const MTEXT: [i32; 22] = [0, 5, 330, 100, 67, 8, 6, 62, 48, 60, 10, 20, 30, 40, 41, 71, 72, 3, 1, 7, 73, 44];

/// Puts one entity right as the crate wrote it.
pub(crate) fn entity(record: &mut Record, entity: &Entity, version: Version) {
    common(record, version);
    match &entity.shape {
        Shape::Text(_) => text(record),
        Shape::MText(mtext) => {
            let direction: &[i32] = match mtext.direction {
                Direction::Rotation(_) => &[50],
                Direction::Vector(_) => &[11, 21, 31],
            };
            let mut seen_rotation = false;
            record.retain(|pair| {
                let first = !(pair.code == 50 && std::mem::replace(&mut seen_rotation, true));
                first
                    && (MTEXT.contains(&pair.code) || direction.contains(&pair.code) || pair.code / 10 == 21)
            });
        }
        Shape::Spline(spline) if spline.fit.is_empty() => drop_codes(record, &[12, 22, 32, 13, 23, 33]),
        Shape::Raw(pairs) => record.clone_from(pairs),
        _ => {}
    }
}

/// Drops what the crate writes without being asked.
pub(crate) fn common(record: &mut Record, version: Version) {
    record.retain(|pair| match pair.code {
        100 => version >= Version::R13,
        347 | 390 | 430 | 440 | 284 => false,
        370 => pair.value.trim() != "-1",
        _ => true,
    });
}

/// Restores an alignment point at the origin, and puts the vertical alignment where it belongs.
fn text(record: &mut Record) {
    let aligned = value(record, 72).or(value(record, 73)).is_some();
    if aligned && value(record, 11).is_none() {
        let behind = record.iter().position(|pair| pair.code == 72).map_or(record.len(), |at| at + 1);
        record.splice(behind..behind, [11, 21, 31].map(|code| Pair::new(code, "0.0")));
    }
    if let Some(at) = record.iter().position(|pair| pair.code == 73) {
        let vertical = record.remove(at);
        record.push(vertical);
    }
}

/// Makes the changes that the drawing asks for.
pub(crate) fn change(record: &mut Record, changes: &[Change]) {
    for change in changes {
        match change {
            Change::Set(pair) => set(record, pair.clone()),
            Change::Unset(code) => drop_codes(record, &[*code]),
        }
    }
}
