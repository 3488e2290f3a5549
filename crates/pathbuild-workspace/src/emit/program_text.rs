//! Text of a program as `emit` would write it, for pages that display it.

use std::slice;

use camino::Utf8PathBuf;
use pathbuild_db::Database;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;

use super::deliver::{JobFiles, OutputSettings, make};
use super::job::{Job, JobBuilder};
use crate::config::types::SheetFormat;
use crate::posting::PostProcessor;
use crate::session::{CheckedTarget, Session};

/// A program file in memory.
pub(crate) struct ProgramText {
    /// Path that `emit` would write it to.
    pub(crate) file: Utf8PathBuf,
    pub(crate) bytes: Vec<u8>,
    /// Dialect to read it in.
    pub(crate) dialect: Dialect,
}

/// Generates the program of a checked path; `None` if the path has errors.
///
/// # Errors
/// Why `emit` would refuse to write it.
pub(crate) fn program_text(
    session: &Session<'_>,
    post_processor: Option<&PostProcessor>,
    checked: &CheckedTarget,
) -> Result<Option<ProgramText>, Vec<Diagnostic>> {
    let builder = JobBuilder { session, post_processor, join: None, sheet: SheetFormat::No };
    let Some(job) = builder.job(slice::from_ref(checked))? else { return Ok(None) };
    let settings = OutputSettings::new(session.workspace(), post_processor);
    let work = |db: &Database, job: &Job| make(db, job, &settings);
    let files =
        session.map_guarded(slice::from_ref(&job), work).pop().unwrap_or_else(|| Ok(JobFiles::default()));
    let files = files.map_err(|problem| vec![*problem])?;
    // Without a known dialect, read the text as generic RS274, as when it is read back.
    let dialect = post_processor
        .map_or(Dialect::Native, |post_processor| post_processor.reader().unwrap_or(Dialect::LinuxCnc));
    match files.outputs.into_iter().find(|output| output.kind.is_program()) {
        Some(output) => Ok(Some(ProgramText { file: output.path, bytes: output.text, dialect })),
        None => Err(files.delivered.problems),
    }
}
