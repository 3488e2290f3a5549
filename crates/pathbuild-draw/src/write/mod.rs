//! A sheet as DXF, through the crate `dxf`.
//!
//! The crate knows which groups an entity has in which version. What it gets wrong or lacks is put right on its output, pair by pair:
//! it doubles handles, forgets the handles of tables, the owners, model and paper space, writes group 430 empty, drops alignment
//! points at the origin, does not know frozen layers, escapes carets and umlauts, and stamps each file with the time and a random
//! number. So strings are handed to it as tickets and put back here, and entities carry tags in place of handles.

mod assemble;
mod bytes;
mod crate_drawing;
mod crate_entity;
mod crate_text;
mod encoding;
mod header;
mod objects;
mod record;
mod tables;
mod tickets;
mod tidy;

pub(crate) use crate_drawing::LINE_TYPES;

use crate::model::Pair;
use crate::sheet::Sheet;

/// ASCII DXF.
pub(crate) fn ascii(sheet: &Sheet) -> Vec<u8> {
    bytes::ascii(&pairs(sheet), sheet.options())
}

/// Binary DXF.
pub(crate) fn binary(sheet: &Sheet) -> Vec<u8> {
    bytes::binary(&pairs(sheet), sheet.options())
}

fn pairs(sheet: &Sheet) -> Vec<Pair> {
    let mut tickets = tickets::Tickets::default();
    let drawing = crate_drawing::drawing(sheet, &mut tickets);
    let mut written = record::Written::of(&drawing);
    written.redeem(&tickets);
    assemble::assemble(sheet, written)
}
