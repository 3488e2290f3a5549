//! Reading drawings: a file to its raw paths, whatever is in it.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files as messages;
use pathbuild_dxf::{Drawing, Options};
use pathbuild_path::{RawPath, SourceMap};

use super::raw::FileReport;
use crate::database::Db;
use crate::inputs::SourceFile;
use crate::settings::{Reading, Settings};
use crate::system::ReadError;

/// The paths of a drawing with where their elements are in the file, and what is known of it as a whole.
pub(super) fn read(db: &dyn Db, file: SourceFile) -> (Vec<(RawPath, SourceMap)>, FileReport) {
    // Asked for first: it stands for the bytes that are read behind salsa's back.
    file.revision(db);
    let settings = Settings::get(db);
    let reading = settings.reading(db);
    let mut hash = None;
    let read = with_bytes(db, file, reading.file_size, |bytes, drawing| {
        // Of these bytes, not of what a second look would find: they are what is compiled.
        hash = reading.is_hashed.then(|| *blake3::hash(bytes).as_bytes());
        parse(bytes, drawing, reading, settings.language(db))
    });
    let read = read.unwrap_or_else(|error| Err(Box::new(unreadable(error, reading))));
    let raw = read
        .unwrap_or_else(|problem| pathbuild_path::RawFile { paths: Vec::new(), diagnostics: vec![*problem] });
    let in_this_file = |diagnostic: Diagnostic| diagnostic.in_file(file.path(db));
    let diagnostics = raw.diagnostics.into_iter().map(in_this_file).collect();
    (raw.paths, FileReport { diagnostics, hash })
}

thread_local! {
    /// What one drawing after the other is read into.
    static ROOM: Cell<Room> = Cell::default();
}

/// Memory for a drawing.
#[derive(Default)]
struct Room {
    bytes: Vec<u8>,
    drawing: Drawing,
}

/// Memory for so many bytes, and for so many entities, is kept for the next drawing; few have more.
const KEPT: usize = 1 << 20;
const KEPT_ENTITIES: usize = 1 << 12;

/// Works on the bytes of a drawing, with room for what is drawn.
fn with_bytes<R>(
    db: &dyn Db,
    file: SourceFile,
    limit: u64,
    work: impl FnOnce(&[u8], &mut Drawing) -> R,
) -> Result<R, ReadError> {
    let Room { mut bytes, mut drawing } = ROOM.take();
    let read = db.system().read_into(file.path(db), limit, &mut bytes);
    let result = read.map(|bytes| work(bytes, &mut drawing));
    if bytes.len() <= KEPT && drawing.entities.capacity() <= KEPT_ENTITIES {
        ROOM.set(Room { bytes, drawing });
    }
    result
}

/// A panic in here is a bug that one file shows: it must not keep the others from being read.
fn parse(
    bytes: &[u8],
    drawing: &mut Drawing,
    reading: &Reading,
    language: &pathbuild_path::Language,
) -> Result<pathbuild_path::RawFile, Box<Diagnostic>> {
    let read = || {
        let options = Options {
            keep_layer: &|layer| language.path_pattern.is_layer(layer),
            units: reading.units,
            approximate_curves: reading.approximate_curves,
            max_entities: reading.entities,
            max_text: reading.text_length,
            compatible: reading.compatible,
        };
        pathbuild_dxf::read_into(drawing, bytes, &options);
        pathbuild_path::raw_file(drawing, language)
    };
    catch_unwind(AssertUnwindSafe(read)).map_err(|payload| Box::new(internal_error(&*payload)))
}

/// PB006 for a panic that is not salsa's own way of cancelling.
pub(crate) fn internal_error(payload: &(dyn std::any::Any + Send)) -> Diagnostic {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let reason = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
    Diagnostic::new(&messages::INTERNAL).with("reason", reason)
}

fn unreadable(error: ReadError, reading: &Reading) -> Diagnostic {
    match error {
        ReadError::Missing => Diagnostic::new(&messages::MISSING),
        ReadError::IsDirectory => Diagnostic::new(&messages::IS_DIRECTORY),
        ReadError::Other(reason) => Diagnostic::new(&messages::UNREADABLE).with("reason", &*reason),
        ReadError::TooLarge { size } => Diagnostic::new(&messages::LIMIT)
            .with("what", format!("the file's size of {size} bytes"))
            .with("limit", format!("{} bytes", reading.file_size))
            .with("key", "file-size"),
    }
}
