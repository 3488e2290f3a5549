//! Detects drawings that change during a run.

use std::panic::resume_unwind;

use crate::db::Db;
use crate::inputs::SourceFile;

/// Panic payload of a query that read other bytes than those the drawing was indexed by. No result may mix the two.
pub(crate) struct DriftPanic;

/// Records that a drawing has changed and abandons the query.
pub(crate) fn abandon_query(db: &dyn Db, file: SourceFile) -> ! {
    db.note_changed(file);
    // Bypasses the panic hook: this is not a bug.
    resume_unwind(Box::new(DriftPanic))
}
