//! Drawings that change while a run goes on.

use std::panic::resume_unwind;

use crate::db::Db;
use crate::inputs::SourceFile;

/// The panic of a query that met other bytes than those that a drawing was indexed by. No result is made of both.
pub(crate) struct Drifted;

/// Notes that a drawing has changed, and gives up the query.
pub(crate) fn give_up(db: &dyn Db, file: SourceFile) -> ! {
    db.note_changed(file);
    // Without the message of a panic: it is not a bug.
    resume_unwind(Box::new(Drifted))
}
