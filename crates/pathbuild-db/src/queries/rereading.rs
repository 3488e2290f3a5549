//! Reads indexed drawings again for details that the index lacks.

use pathbuild_dxf::Drawing;

use super::index::file_index;
use super::reading::{Fingerprint, entities, read};
use crate::db::Db;
use crate::drift;
use crate::inputs::SourceFile;
use crate::settings::Settings;

/// Calls `work` with the bytes of an indexed drawing. If they no longer match the index, the drawing is marked as changed and the query
/// abandoned. `None` if it cannot be read, which the index reports.
pub(super) fn read_again<R>(
    db: &dyn Db,
    file: SourceFile,
    work: impl FnOnce(&[u8], &mut Drawing) -> R,
) -> Option<R> {
    let indexed = file_index(db, file).fingerprint();
    let result = read(db, file, |bytes, _, drawing| {
        (Some(Fingerprint::of(bytes)) == indexed).then(|| work(bytes, drawing))
    });
    match result {
        Ok(Some(result)) => Some(result),
        Err(_) if indexed.is_none() => None,
        Ok(None) | Err(_) => drift::abandon_query(db, file),
    }
}

/// The entities of an indexed drawing on some of its layers. Empty if it cannot be read.
pub(super) fn read_layers(db: &dyn Db, file: SourceFile, keep_layer: &dyn Fn(&str) -> bool) -> Drawing {
    let reading = Settings::get(db).reading(db);
    read_again(db, file, |bytes, _| entities(bytes, reading, keep_layer)).unwrap_or_default()
}
