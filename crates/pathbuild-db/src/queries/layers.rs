//! Reading a drawing once more, for what its paths do not tell: asked rarely, and not kept.

use std::panic::{AssertUnwindSafe, catch_unwind};

use pathbuild_dxf::{Drawing, Options};

use crate::database::Db;
use crate::inputs::SourceFile;
use crate::settings::Settings;

/// The entities on some layers of a drawing; nothing where it cannot be read, which is said by who reads its paths.
pub(super) fn read_layers(db: &dyn Db, file: SourceFile, keep_layer: &dyn Fn(&str) -> bool) -> Drawing {
    // Asked for first: it stands for the bytes that are read behind salsa's back.
    file.revision(db);
    let reading = Settings::get(db).reading(db);
    let Ok(bytes) = db.system().read(file.path(db), reading.file_size) else { return Drawing::default() };
    let options = Options {
        keep_layer,
        units: reading.units,
        approximate_curves: reading.approximate_curves,
        max_entities: reading.entities,
        max_text: reading.text_length,
        compatible: reading.compatible,
    };
    catch_unwind(AssertUnwindSafe(|| pathbuild_dxf::read(&bytes, &options))).unwrap_or_default()
}
