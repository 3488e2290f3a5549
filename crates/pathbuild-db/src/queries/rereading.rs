//! Reading indexed drawings once more, for what their indexes do not tell.

use pathbuild_dxf::Drawing;

use super::index::file_index;
use super::reading::{Fingerprint, entities, read};
use crate::db::Db;
use crate::drift;
use crate::inputs::SourceFile;
use crate::settings::Settings;

/// Works on the bytes of an indexed drawing. They are those of its index: else the drawing counts as changed, and the query is given up. `None` where
/// it cannot be read, which its index says.
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
        Ok(None) | Err(_) => drift::give_up(db, file),
    }
}

/// The entities of an indexed drawing on some of its layers; none where it cannot be read.
pub(super) fn read_layers(db: &dyn Db, file: SourceFile, keep_layer: &dyn Fn(&str) -> bool) -> Drawing {
    let reading = Settings::get(db).reading(db);
    read_again(db, file, |bytes, _| entities(bytes, reading, keep_layer)).unwrap_or_default()
}
