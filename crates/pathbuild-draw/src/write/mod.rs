//! Writes sheets as DXF through the crate `dxf`.
//!
//! The crate knows which groups an entity has in each version. Its errors and omissions are corrected in its output, pair by pair: it
//! duplicates handles; omits the handles of tables, the owners, and model and paper space; writes an empty group 430; drops alignment
//! points at the origin; does not know frozen layers; escapes carets and umlauts; and puts the time and a random number into each file.
//! Strings are therefore passed as tickets and restored here, and entities carry tags in place of handles.

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
mod template;
mod tickets;
mod tidy;
mod written;

pub use crate_drawing::LINE_TYPES;
pub use template::Template;

use crate::sheet::Sheet;
use tickets::Tickets;
use written::CrateOutput;

/// Writes ASCII DXF.
pub(crate) fn ascii(sheet: &Sheet) -> Vec<u8> {
    with_pairs(sheet, |pairs| bytes::ascii(pairs, sheet.options()))
}

/// Writes binary DXF.
pub(crate) fn binary(sheet: &Sheet) -> Vec<u8> {
    with_pairs(sheet, |pairs| bytes::binary(pairs, sheet.options()))
}

fn with_pairs(sheet: &Sheet, write: impl FnOnce(&[record::Pair<'_>]) -> Vec<u8>) -> Vec<u8> {
    with_written(sheet, |written| write(&assemble::assemble(sheet, written)))
}

/// Lets the crate write a sheet without its template.
fn with_written<T>(sheet: &Sheet, next: impl FnOnce(CrateOutput<'_>) -> T) -> T {
    let mut tickets = Tickets::default();
    let drawing = crate_drawing::drawing(sheet, &mut tickets);
    let mut text = Vec::new();
    // Saving to memory without a thumbnail cannot fail.
    _ = drawing.save(&mut text);
    let text = String::from_utf8_lossy(&text);
    let mut written = CrateOutput::of(&text, &tickets);
    written.tidy(&sheet.tagged(), sheet.options().version);
    next(written)
}
