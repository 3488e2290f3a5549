//! Reads drawings into entities.

use std::hash::Hasher;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files as messages;
use pathbuild_dxf::{Drawing, Options};
use pathbuild_files::Stamp;
use pathbuild_path::may_be_stray_text;
use rustc_hash::FxHasher;

use crate::database::{Db, catch_bugs};
use crate::inputs::{Reading, Settings, SourceFile};
use crate::system::ReadError;

/// Identifies the bytes that a result was computed from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fingerprint(u64);

impl Fingerprint {
    pub(super) fn of(bytes: &[u8]) -> Self {
        let mut hasher = FxHasher::default();
        hasher.write(bytes);
        Self(hasher.finish())
    }
}

/// Calls `work` with the bytes of a drawing, their stamp, and a scratch drawing. The stamp is unknown unless drawings are hashed.
///
/// # Errors
/// The reason why the file cannot be read, without a place.
pub(super) fn read<R>(
    db: &dyn Db,
    file: SourceFile,
    work: impl FnOnce(&[u8], Stamp, &mut Drawing) -> R,
) -> Result<R, Box<Diagnostic>> {
    // The revision is read before the bytes, so that salsa knows about the dependency.
    file.revision(db);
    let reading = Settings::get(db).reading(db);
    let (path, limit) = (file.path(db), reading.file_size);
    db.scratch().with(|scratch| {
        let stamp =
            catch_bugs(|| db.system().read_into(path, limit, &mut scratch.bytes))?.map_err(|error| {
                Box::new(match error {
                    ReadError::IsDirectory => Diagnostic::new(&messages::IS_DIRECTORY),
                    error => error.diagnostic(limit, "file-size"),
                })
            })?;
        let stamp = if reading.is_hashed { stamp } else { Stamp::UNKNOWN };
        Ok(work(&scratch.bytes, stamp, &mut scratch.drawing))
    })
}

/// Reads the entities on some layers. Empty after a panic.
pub(super) fn entities(bytes: &[u8], reading: &Reading, keep_layer: &dyn Fn(&str) -> bool) -> Drawing {
    let mut drawing = Drawing::default();
    _ = catch_bugs(|| read_entities(bytes, &mut drawing, reading, keep_layer));
    drawing
}

/// Reads the entities on some layers into `drawing`. Panics are not caught.
pub(super) fn read_entities(
    bytes: &[u8],
    drawing: &mut Drawing,
    reading: &Reading,
    keep_layer: &dyn Fn(&str) -> bool,
) {
    let options = Options {
        keep_layer,
        note_text: Some(&may_be_stray_text),
        units: reading.units,
        approximate_curves: reading.approximate_curves,
        max_entities: reading.entities,
        max_text: reading.text_length,
        compatible: reading.compatible,
    };
    pathbuild_dxf::read_into(drawing, bytes, &options);
}
